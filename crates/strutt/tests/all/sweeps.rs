//! Sweeps that are shared out, killed, resumed, divided and put together: the same bytes every time.

use crate::common::{folder, stderr, stdout, strutt};
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

/// A pendulum whose rate has no value for one of the lengths.
const MODEL: &str = r#"
[parameters]
l = "1 m"
k = "0.1 1/s"
[coordinates]
phi = { unit = "rad", start = "0.5 rad", rate = "1 rad/s" }
[bodies.bob]
angle = "phi"
mass = "1 kg"
center = ["0", "-l"]
[outputs]
far = "sqrt(l - 0.55 [m])*phi"
[[study]]
kind = "simulate"
until = "3 s"
"#;
const SWEEP: [&str; 7] =
    ["sweep", "m.toml", "--over", "l=linspace(0.5 m, 1.5 m, 41)", "--observe", "mean(phi', 1 s, 2 s),max(far)", "--csv"];

fn here(name: &str) -> std::path::PathBuf {
    let here = folder(name);
    fs::write(here.join("m.toml"), MODEL).unwrap();
    here
}

fn table(folder: &Path) -> Vec<u8> {
    fs::read(folder.join("sweep.csv")).unwrap()
}

#[test]
fn rows_are_the_same_for_any_number_of_threads_and_failures_are_rows_with_their_reason() {
    let here = here("threads");
    let run = |threads: &str| strutt().current_dir(&here).args(SWEEP).args(["--threads", threads]).output().unwrap();
    let one = run("1");
    // a value without a result is told by the exit code
    assert_eq!(one.status.code(), Some(1));
    for threads in ["2", "5"] {
        assert_eq!(run(threads).stdout, one.stdout, "{threads} threads");
    }
    let text = String::from_utf8(one.stdout).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines.len() == 42 && lines[0].ends_with(",reason"), "{text}");
    // lengths of 0.5 m and 0.525 m have no root, 0.55 m has
    assert!(lines[1..3].iter().all(|line| line.contains(",,") && line.contains("[S144]")), "{text}");
    assert!(lines[3..].iter().all(|line| line.ends_with(',') && !line.contains(",,")), "{text}");
}

#[test]
fn a_sweep_cut_anywhere_goes_on_to_the_same_bytes() {
    let here = here("cut");
    let part = |out: &str, more: &[&str]| {
        let done = strutt().current_dir(&here).args(SWEEP).args(["--shard", "1/1", "--out", out]).args(more).output().unwrap();
        (done.status.code(), String::from_utf8(done.stderr).unwrap())
    };
    assert_eq!(part("whole", &[]).0, Some(1));
    let rows = fs::read(here.join("whole/sweep.rows")).unwrap();
    let lengths = (0..rows.len()).step_by(1 + rows.len() / 17).chain([rows.len() - 1, rows.len()]);
    for length in lengths {
        fs::create_dir_all(here.join("again")).unwrap();
        fs::write(here.join("again/sweep.rows"), &rows[..length]).unwrap();
        if length > 0 {
            let (code, said) = part("again", &[]);
            assert!(code == Some(2) && said.contains("C074"), "{said}");
        }
        assert_eq!(part("again", &["--resume", "--threads", "2"]).0, Some(1), "cut at {length}");
        assert_eq!(table(&here.join("again")), table(&here.join("whole")), "cut at {length}");
        assert_eq!(fs::read(here.join("again/sweep.rows")).unwrap(), rows, "cut at {length}");
    }
    // a byte in the middle, and another model: nothing is touched
    let mut damaged = rows.clone();
    damaged[rows.len() / 2] ^= 1;
    fs::write(here.join("again/sweep.rows"), &damaged).unwrap();
    assert!(part("again", &["--resume"]).1.contains("S149"));
    assert_eq!(fs::read(here.join("again/sweep.rows")).unwrap(), damaged);
    fs::write(here.join("again/sweep.rows"), &rows).unwrap();
    assert!(part("again", &["--resume", "--set", "k=0.2"]).1.contains("S148"));
    assert_eq!(fs::read(here.join("again/sweep.rows")).unwrap(), rows);
}

#[test]
fn a_killed_sweep_is_resumed() {
    let here = here("killed");
    let long = ["sweep", "m.toml", "--over", "l=linspace(0.6 m, 1.5 m, 400)", "--observe", "last(phi)", "--until", "60 s", "--csv"];
    let whole = stdout(strutt().current_dir(&here).args(long));
    for wait in [20, 60, 150] {
        let _ = fs::remove_dir_all(here.join("out"));
        let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin!("strutt"));
        command.current_dir(&here).args(long).args(["--out", "out"]).stdout(Stdio::null()).stderr(Stdio::null());
        let mut child = command.spawn().unwrap();
        std::thread::sleep(Duration::from_millis(wait));
        // SIGKILL
        child.kill().unwrap();
        child.wait().unwrap();
        stdout(strutt().current_dir(&here).args(long).args(["--out", "out", "--resume"]));
        assert_eq!(String::from_utf8(table(&here.join("out"))).unwrap(), whole, "killed after {wait} ms");
        assert!(!here.join("out/sweep.rows").exists());
    }
}

#[test]
fn parts_make_the_whole() {
    let here = here("parts");
    let whole = strutt().current_dir(&here).args(SWEEP).output().unwrap().stdout;
    for part in ["1/3", "2/3", "3/3"] {
        let out = format!("part{}", &part[..1]);
        strutt().current_dir(&here).args(SWEEP).args(["--shard", part, "--out", &out]).output().unwrap();
    }
    let said = stderr(strutt().current_dir(&here).args(["merge", "part1", "part3", "--out", "all"]), 1);
    assert!(said.contains("S160"), "{said}");
    assert!(!here.join("all/sweep.csv").exists());
    let said = stderr(strutt().current_dir(&here).args(["merge", "part1", "none", "--out", "all"]), 1);
    assert!(said.contains("C076"), "{said}");
    strutt().current_dir(&here).args(["merge", "part3", "part1", "part2", "--out", "all"]).assert().code(1);
    assert_eq!(table(&here.join("all")), whole);
    // the rows of the whole are those that a run of the whole would have kept
    strutt().current_dir(&here).args(SWEEP).args(["--resume", "--out", "all"]).assert().code(1);
    assert_eq!(table(&here.join("all")), whole);
}

#[test]
fn what_is_no_part_is_refused() {
    let here = here("no-part");
    for part in ["0/3", "4/3", "1", "a/b"] {
        let said = stderr(strutt().current_dir(&here).args(SWEEP).args(["--shard", part, "--out", "out"]), 2);
        assert!(said.contains("C009"), "{said}");
    }
}
