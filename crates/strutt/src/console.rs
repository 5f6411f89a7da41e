//! Where words go: data to stdout in one piece, talk to stderr; colours only on terminals.

use crate::args::Global;
use report::formats::{self, Format, Tree};
use serde_json::json;
use std::cell::RefCell;
use std::ffi::OsString;
use std::io::{IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use strutt::diagnostics::{self, Style};
use strutt::system;
use strutt::wording::{Word, say};
use studies::watch::Lap;
use studies::{Failure, Source, Watch};
use words::{Language, Notice, Text};

/// Set by Ctrl+C and by requests to end (SIGTERM, SIGHUP).
pub static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Whether a calculation is under way.
static CALCULATING: AtomicBool = AtomicBool::new(false);

/// Signals so near to one another are one request: `timeout` and job schedulers send theirs to the program and to its group.
const ONE_REQUEST: Duration = Duration::from_millis(200);

/// How long an interrupted calculation may take to come back with what it has.
const GRACE: Duration = Duration::from_millis(1500);
/// Between lines on the progress where no terminal shows it.
const BETWEEN_LINES: Duration = Duration::from_secs(10);
/// Between changes of what a terminal shows.
const BETWEEN_SPINS: Duration = Duration::from_millis(100);
/// A calculation shows its progress when it takes longer.
const PATIENCE: Duration = Duration::from_secs(1);

/// The terminal, or the pipes in its place.
pub struct Console {
    pub language: Language,
    /// What data look like on stdout.
    pub format: Format,
    /// What a page looks like, where the command line says so.
    pub page: Option<Format>,
    /// Whether the command line says what stdout is.
    asked: bool,
    pub quiet: bool,
    /// Whether a person reads stdout.
    pub terminal: bool,
    /// Phases of the calculation, when they are to be shown.
    laps: Option<Vec<(Word, Duration)>>,
    started: Instant,
}

impl Console {
    pub fn new(global: &Global, language: Language) -> Console {
        let format = match (global.json, global.csv) {
            (true, _) => formats::json::FORMAT,
            (_, true) => formats::csv::FORMAT,
            _ => formats::text::FORMAT,
        };
        let laps = global.timings.then(Vec::new);
        let terminal = std::io::stdout().is_terminal();
        Console {
            language,
            format,
            page: None,
            asked: global.json || global.csv,
            quiet: global.quiet,
            terminal,
            laps,
            started: Instant::now(),
        }
    }

    /// What `--format` names: a page has figures with it, other formats are for stdout.
    pub fn choose(&mut self, format: &Format) {
        if format.is_paged() {
            self.page = Some(*format);
        } else {
            (self.format, self.asked) = (*format, true);
        }
    }

    /// The format of a page where the command line asks for one; what else it asks for has no figures.
    pub fn paged(&self) -> Result<Option<Format>, Format> {
        if self.page.is_none() && self.asked { Err(self.format) } else { Ok(self.page) }
    }

    /// Whether stdout is for people.
    pub fn is_text(&self) -> bool {
        self.format.page().is_some()
    }

    /// How trees are written, where stdout is for programs.
    pub fn tree(&self) -> Option<Tree> {
        self.format.tree()
    }

    pub fn say(&self, word: Word) -> &'static str {
        say(self.language, word)
    }

    pub fn pick(&self, en: impl Into<String>, ru: impl Into<String>) -> String {
        self.language.pick(en.into(), ru.into())
    }

    /// Data.
    pub fn out(&self, data: impl AsRef<[u8]>) -> Result<(), Failure> {
        self.out_by(&mut |stdout| stdout.write_all(data.as_ref()))
    }

    /// Data that are written piece by piece.
    pub fn out_by(&self, write: &mut dyn FnMut(&mut dyn Write) -> std::io::Result<()>) -> Result<(), Failure> {
        let mut stdout = std::io::stdout().lock();
        match write(&mut stdout).and_then(|()| stdout.flush()) {
            Ok(()) => Ok(()),
            Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Err(Failure::ClosedPipe),
            Err(error) => {
                let cause = system::cause(&error);
                let elsewhere = Text::new("send the output elsewhere", "направьте вывод в другое место");
                let help = system::remedy(&error, &elsewhere);
                let en = format!("cannot write to standard output: {}", cause.en);
                let ru = format!("не удаётся писать в стандартный вывод: {}", cause.ru);
                Err(Notice::new("C005", en, ru).help(help.en, help.ru).into())
            }
        }
    }

    /// Talk, unless the user wants quiet.
    pub fn talk(&self, words: &str) {
        if !self.quiet {
            complain(&format!("{words}\n"));
        }
    }

    /// The command that a user is likely to want now.
    pub fn next(&self, command: &str) {
        self.talk(&format!("{} {command}", self.say(Word::Next)));
    }

    /// What is said even to those who want quiet.
    pub fn complain(&self, words: &str) {
        complain(words);
    }

    /// Characters on a line.
    pub fn width(&self) -> usize {
        let columns = std::env::var("COLUMNS").ok().and_then(|c| c.parse().ok());
        let asked = || ::console::Term::stdout().size_checked().map(|(_, columns)| usize::from(columns));
        columns.or_else(|| if self.terminal { asked() } else { None }).unwrap_or(120).clamp(60, 200)
    }

    fn style(&self) -> Style {
        let wanted = std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty()) && std::env::var_os("TERM").is_none_or(|t| t != "dumb");
        Style { language: self.language, colour: wanted && std::io::stderr().is_terminal() }
    }

    /// Warnings of the reader.
    pub fn warn(&self, warnings: &[Notice], source: &Source) {
        if !warnings.is_empty() && !self.quiet && self.tree().is_none() {
            complain(&diagnostics::render(warnings, source, self.style()));
        }
    }

    /// A trouble that does not end the command at once.
    pub fn trouble(&self, trouble: &Notice) {
        complain(&diagnostics::render_trouble(trouble, self.style()));
    }

    /// Shows what ended the command; returns the exit code.
    pub fn fail(&self, failure: &Failure) -> u8 {
        let language = self.language;
        let value = match failure {
            Failure::Findings { source, diagnostics } => {
                json!({"ok": false, "file": source.path, "findings": diagnostics::to_json(diagnostics, source, language)})
            }
            Failure::Trouble(t) | Failure::Misuse(t) => json!({"ok": false, "findings": [studies::results::trouble_to_json(t, language)]}),
            Failure::ClosedPipe => return failure.exit_code(),
        };
        if let Some(tree) = self.tree() {
            // nothing is left to tell when even this cannot be written
            let _ = self.out((tree.value)(&value));
            return failure.exit_code();
        }
        match failure {
            Failure::Findings { source, diagnostics } => complain(&diagnostics::render(diagnostics, source, self.style())),
            Failure::Trouble(t) | Failure::Misuse(t) => complain(&diagnostics::render_trouble(t, self.style())),
            Failure::ClosedPipe => {}
        }
        failure.exit_code()
    }

    /// How progress is told.
    fn form(&self) -> Form {
        match (self.quiet, std::io::stderr().is_terminal()) {
            (true, _) => Form::Silent,
            (false, true) => Form::Bar,
            (false, false) => Form::Lines,
        }
    }

    /// Runs a calculation under watch: Ctrl+C stops it, a bar shows its progress, its phases are timed.
    pub fn watched<T>(&mut self, calculate: impl FnOnce(&mut Watch) -> T) -> T {
        let bar = RefCell::new(Bar::new(self.form(), self.language));
        let mut tell = |share: f64| bar.borrow_mut().tell(share);
        let mut say = |words: Text| bar.borrow_mut().say(&words);
        let (mut laps, mut last) = (Vec::new(), Instant::now());
        let mut note = |lap: Lap| {
            let now = Instant::now();
            add(&mut laps, word_of(lap), now - last);
            last = now;
        };
        let mut watch = Watch {
            interrupt: Some(&INTERRUPTED),
            progress: Some(&mut tell),
            doing: Some(&mut say),
            ended: Some(&mut note),
            ..Watch::default()
        };
        CALCULATING.store(true, Ordering::Relaxed);
        let result = calculate(&mut watch);
        CALCULATING.store(false, Ordering::Relaxed);
        if let Some(all) = &mut self.laps {
            all.extend(laps);
        }
        bar.into_inner().end();
        result
    }

    /// Times the rest of the work, which needs no watching.
    pub fn timed<T>(&mut self, phase: Word, work: impl FnOnce(&Console) -> T) -> T {
        let start = Instant::now();
        let result = work(self);
        if let Some(laps) = &mut self.laps {
            laps.push((phase, start.elapsed()));
        }
        result
    }

    /// The phases and the total, when asked for.
    pub fn timings(&self) {
        let Some(laps) = &self.laps else { return };
        let line = |phase: &str, time: Duration| format!("{phase:<24}{:>10.3} ms\n", 1e3 * time.as_secs_f64());
        let mut out: String = laps.iter().map(|(phase, time)| line(self.say(*phase), *time)).collect();
        out.push_str(&line(self.say(Word::TimeTotal), self.started.elapsed()));
        complain(&out);
    }
}

/// Adds the time of a phase; equal phases are one.
fn add(laps: &mut Vec<(Word, Duration)>, phase: Word, time: Duration) {
    match laps.iter_mut().find(|(p, _)| *p == phase) {
        Some((_, sum)) => *sum += time,
        None => laps.push((phase, time)),
    }
}

fn word_of(lap: Lap) -> Word {
    match lap {
        Lap::Read => Word::TimeRead,
        Lap::Derive => Word::TimeDerive,
        Lap::Lower => Word::TimeLower,
        Lap::Run => Word::TimeRun,
    }
}

/// From now on Ctrl+C, SIGTERM and SIGHUP ask for the results so far; a second one ends at once, and so does the first where the calculation under way
/// does not hear it: whatever loop it is in, it is not waited for longer than [`GRACE`].
pub fn listen_to_interrupts(language: Language) {
    // without the handler Ctrl+C ends the program as usual
    let mut first: Option<Instant> = None;
    let _ = ctrlc::set_handler(move || {
        if let Some(first) = first {
            if first.elapsed() > ONE_REQUEST {
                std::process::exit(130);
            }
            return;
        }
        first = Some(Instant::now());
        INTERRUPTED.store(true, Ordering::Relaxed);
        std::thread::spawn(move || {
            std::thread::sleep(GRACE);
            if CALCULATING.load(Ordering::Relaxed) {
                complain(&format!("{}\n", say(language, Word::InterruptedDeaf)));
                std::process::exit(130);
            }
        });
    });
}

/// For calculations that have nothing to keep before their end: a request to end is obeyed at once, with the code of an interruption.
pub fn end_on_interrupts() {
    // without the handler such a request ends the program as usual
    let _ = ctrlc::set_handler(|| std::process::exit(130));
}

/// How far a long calculation has come: a bar on a terminal, elsewhere a line now and then.
struct Bar {
    started: Instant,
    /// When the last line was written.
    told: Instant,
    shown: Option<indicatif::ProgressBar>,
    form: Form,
    language: Language,
    /// The share told last, and how often the shares began anew: a motion is computed twice where its digits are asked for.
    share: f64,
    pass: usize,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Silent,
    Bar,
    Lines,
}

impl Bar {
    fn new(form: Form, language: Language) -> Bar {
        let now = Instant::now();
        Bar { started: now, told: now, shown: None, form, language, share: 0.0, pass: 1 }
    }

    fn tell(&mut self, share: f64) {
        if share < self.share {
            (self.pass, self.started) = (self.pass + 1, Instant::now());
        }
        self.share = share;
        match self.form {
            Form::Bar if self.started.elapsed() >= PATIENCE => self.draw(share),
            Form::Lines if self.told.elapsed() >= BETWEEN_LINES => self.line(share),
            _ => {}
        }
    }

    /// What a search of unknown length does, and for how long.
    fn say(&mut self, words: &Text) {
        let elapsed = self.started.elapsed();
        match self.form {
            Form::Lines if self.told.elapsed() >= BETWEEN_LINES => {
                self.told = Instant::now();
                let unit = self.language.pick("s", "с");
                complain(&format!("{} ({:.0} {unit})\n", self.language.text(words), elapsed.as_secs_f64()));
            }
            Form::Bar if elapsed >= PATIENCE => self.spin(words),
            _ => {}
        }
    }

    /// The same on a terminal.
    fn spin(&mut self, words: &Text) {
        let bar = self.shown.get_or_insert_with(|| {
            let style = indicatif::ProgressStyle::with_template("{elapsed}  {msg}").ok();
            let bar = indicatif::ProgressBar::new_spinner();
            if let Some(style) = style { bar.with_style(style) } else { bar }
        });
        if self.told.elapsed() >= BETWEEN_SPINS {
            self.told = Instant::now();
            bar.set_message(self.language.text(words).to_owned());
        }
    }

    /// What is done, how long it took, how long the rest takes at the same pace.
    fn line(&mut self, share: f64) {
        self.told = Instant::now();
        let elapsed = self.started.elapsed().as_secs_f64();
        let (done, left) = (100.0 * share, elapsed * (1.0 - share) / share.max(f64::MIN_POSITIVE));
        let pass = match self.pass {
            1 => String::new(),
            pass => format!("{} {pass}: ", self.language.pick("pass", "проход")),
        };
        complain(&match self.language {
            Language::Ru => format!("{pass}выполнено {done:.1} % за {elapsed:.0} с, осталось около {left:.0} с\n").replace('.', ","),
            _ => format!("{pass}{done:.1} % done in {elapsed:.0} s, about {left:.0} s left\n"),
        });
    }

    fn draw(&mut self, share: f64) {
        let bar = self.shown.get_or_insert_with(|| {
            let style = indicatif::ProgressStyle::with_template("{bar:40} {percent:>3} %  {elapsed}  −{eta}").ok();
            let bar = indicatif::ProgressBar::new(1000);
            if let Some(style) = style { bar.with_style(style) } else { bar }
        });
        bar.set_position((1000.0 * share.clamp(0.0, 1.0)) as u64);
    }

    fn end(self) {
        if let Some(bar) = self.shown {
            bar.finish_and_clear();
        }
    }
}

/// A file's name as a shell takes it: in quotes where it holds more than letters, digits and the usual marks.
pub fn quoted(file: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || matches!(c, '/' | '\\' | '.' | '-' | '_' | ':' | '+' | ',' | '@' | '%' | '~');
    match !file.is_empty() && file.chars().all(plain) {
        true => file.to_owned(),
        false => format!("'{}'", file.replace('\'', "'\\''")),
    }
}

/// Writes to stderr; when nobody listens there, nobody is to be told.
fn complain(words: &str) {
    let _ = std::io::stderr().lock().write_all(words.as_bytes());
}

/// `--lang` wherever it stands, otherwise the locale. Needed before the arguments are parsed, since help is in that language too.
pub fn language_of(arguments: impl Iterator<Item = OsString>) -> Language {
    let arguments: Vec<String> = arguments.map(|a| a.to_string_lossy().into_owned()).collect();
    let mut chosen = None;
    for (i, argument) in arguments.iter().enumerate() {
        let value = match argument.strip_prefix("--lang") {
            Some("") => arguments.get(i + 1).map(String::as_str),
            Some(rest) => rest.strip_prefix('='),
            None => None,
        };
        match value {
            Some("ru") => chosen = Some(Language::Ru),
            Some("en") => chosen = Some(Language::En),
            _ => {}
        }
    }
    chosen.unwrap_or_else(of_environment)
}

fn of_environment() -> Language {
    let variables = ["LC_ALL", "LC_MESSAGES", "LANG"];
    let locale = variables.iter().find_map(|v| std::env::var(v).ok().filter(|l| !l.is_empty()));
    locale.map_or(Language::En, |l| Language::of_locale(&l))
}
