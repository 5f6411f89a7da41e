//! One command with one mutant.

use super::mutate::Dice;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A calculation may take longer, but must then listen to an interruption.
const PATIENCE: Duration = Duration::from_secs(20);
/// Within which an interrupted calculation ends.
const OBEDIENCE: Duration = Duration::from_secs(10);

/// A binary, a folder of its own, a model and what to do with it.
pub struct Trial<'a> {
    pub binary: &'a Path,
    pub folder: PathBuf,
    pub text: &'a str,
    pub arguments: Vec<String>,
}

/// What came of it.
pub enum Verdict {
    Well,
    Bad(String),
}

/// A command with options.
pub fn command(dice: &mut Dice) -> Vec<String> {
    const COMMANDS: &[&str] = &[
        "check",
        "run",
        "equations --steps",
        "equations --latex",
        "simulate --json",
        "simulate --csv --until 1",
        "simulate --until 0.5 --events",
        "simulate --check --until 0.2",
        "simulate --method stiff --until 1",
        "equilibrium --json",
        "modes --json",
        "modes",
        "response --csv",
        "response --json",
        "transient --json",
        "statics --json",
        "statics",
        "section --json",
        "kinematics --csv",
        "kinematics --json",
        "inverse --json",
        "inverse --csv",
        "periodic --json",
        "cycle --json",
        "sweep --csv",
        "sweep --json",
        "check --lang ru",
        "run --lang ru",
        "modes --lang ru",
        "statics --lang ru",
    ];
    dice.pick(COMMANDS).split(' ').map(str::to_owned).collect()
}

impl Trial<'_> {
    /// Runs it; the folder stays only where something is wrong.
    pub fn run(&self) -> Verdict {
        match self.attempt() {
            Ok(None) => {
                // what was good leaves nothing; a rest of it harms nobody
                let _ = fs::remove_dir_all(&self.folder);
                Verdict::Well
            }
            Ok(Some(what)) => Verdict::Bad(what),
            Err(error) => Verdict::Bad(format!("cannot try: {error}")),
        }
    }

    fn attempt(&self) -> std::io::Result<Option<String>> {
        fs::create_dir_all(&self.folder)?;
        let (model, out, err) = (self.folder.join("model.toml"), self.folder.join("stdout"), self.folder.join("stderr"));
        fs::write(&model, self.text)?;
        fs::write(self.folder.join("command"), self.arguments.join(" "))?;
        let mut command = Command::new(self.binary);
        command.arg(&self.arguments[0]).arg(&model).args(&self.arguments[1..]).env("LC_ALL", "C");
        if self.arguments[0] == "run" {
            command.arg("--out").arg(self.folder.join("out"));
        }
        let child = command.stdin(Stdio::null()).stdout(File::create(&out)?).stderr(File::create(&err)?).spawn()?;
        let code = patiently(child)?;
        let (out, err) = (String::from_utf8_lossy(&fs::read(&out)?).into_owned(), String::from_utf8_lossy(&fs::read(&err)?).into_owned());
        Ok(complaint(code, &out, &err).filter(|what| !(what.starts_with(UNREAL) && no_number(self.text).is_some())))
    }
}

/// Waits; after [`PATIENCE`] interrupts. The exit code, none where the program was deaf or killed by a signal.
fn patiently(mut child: Child) -> std::io::Result<Option<i32>> {
    if let Some(code) = within(&mut child, PATIENCE)? {
        return Ok(code);
    }
    Command::new("kill").args(["-INT", &child.id().to_string()]).status()?;
    if let Some(code) = within(&mut child, OBEDIENCE)? {
        return Ok(code);
    }
    child.kill()?;
    child.wait()?;
    Ok(None)
}

fn within(child: &mut Child, limit: Duration) -> std::io::Result<Option<Option<i32>>> {
    let start = Instant::now();
    while start.elapsed() < limit {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status.code()));
        }
        std::thread::sleep(Duration::from_millis(3));
    }
    Ok(None)
}

/// A number that is none; a label of the model may hold such a word as well.
const UNREAL: &str = "exit code 0 with";

/// What is wrong with an answer.
fn complaint(code: Option<i32>, out: &str, err: &str) -> Option<String> {
    if err.contains("panicked") || code == Some(101) {
        return Some("panic".to_owned());
    }
    match code {
        None => Some("deaf to an interruption, or killed".to_owned()),
        Some(0) => no_number(out).map(|line| format!("{UNREAL} `{line}`")),
        Some(1 | 2) if err.trim().is_empty() && out.trim().is_empty() => Some("failed without a word".to_owned()),
        Some(1 | 2 | 130) => None,
        Some(other) => Some(format!("exit code {other}")),
    }
}

/// The first line that shows a number that is none. Infinity is a result at an undamped resonance, nowhere else.
fn no_number(out: &str) -> Option<&str> {
    let words = |line: &str| line.split(|c: char| !(c.is_alphanumeric() || c == '_')).any(|w| matches!(w, "nan" | "NaN" | "inf"));
    out.lines().find(|line| words(line)).map(|line| &line[..line.len().min(160)])
}
