//! What the tutorials show is what the program prints.
//!
//! A fenced block `toml` that begins with the line `# NAME.toml` is that file. A block `console` holds commands, each after `$ `, and
//! below it what it prints on both streams; `...` stands for anything, within a line or for whole lines. The commands of a page run one
//! after the other in one folder, those of a Russian page with a Russian locale.

use crate::common;

use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};

/// Full digits differ in the last places from machine to machine; everything shorter is compared as text.
const ROUNDING: f64 = 1e-11;

/// Spaces that keep a number and its unit on one line; a page shows them as spaces.
const NARROW: [char; 2] = ['\u{a0}', '\u{202f}'];

/// A command with the lines that are shown below it.
struct Shown {
    command: String,
    lines: Vec<String>,
}

#[derive(Default)]
struct Page {
    files: Vec<(String, String)>,
    commands: Vec<Shown>,
}

fn page(text: &str) -> Page {
    let mut page = Page::default();
    for block in text.split("\n```").skip(1).step_by(2) {
        let (kind, body) = block.split_once('\n').unwrap_or_default();
        match kind {
            "toml" => page.files.extend(file(body)),
            "console" => page.commands.extend(format!("\n{body}").split("\n$ ").skip(1).map(shown)),
            _ => {}
        }
    }
    page
}

/// The file of a block, named in its first line.
fn file(body: &str) -> Option<(String, String)> {
    let name = body.lines().next()?.strip_prefix("# ")?;
    name.ends_with(".toml").then(|| (name.to_owned(), format!("{body}\n")))
}

fn shown(text: &str) -> Shown {
    let mut lines = text.lines().map(str::to_owned);
    Shown { command: lines.next().unwrap_or_default(), lines: lines.collect() }
}

/// The arguments of a command line; double quotes keep spaces.
fn arguments(command: &str) -> Vec<String> {
    let mut found = vec![String::new()];
    for (i, piece) in command.split('"').enumerate() {
        let mut words = if i % 2 == 0 { piece.split(' ').collect::<Vec<_>>() } else { vec![piece] }.into_iter();
        if let (Some(last), Some(first)) = (found.last_mut(), words.next()) {
            last.push_str(first);
        }
        found.extend(words.map(str::to_owned));
    }
    found.retain(|word| !word.is_empty());
    found
}

/// What a command prints on both streams, in the order of printing, and whether it succeeded.
fn run(command: &str, folder: &Path, locale: &str) -> (String, bool) {
    let words = arguments(command);
    assert_eq!(words[0], "strutt", "{command}");
    let (mut reader, writer) = std::io::pipe().unwrap();
    let mut child = Command::new(assert_cmd::cargo::cargo_bin!("strutt"))
        .args(&words[1..])
        .current_dir(folder)
        .env("LC_ALL", locale)
        .env_remove("NO_COLOR")
        .env_remove("COLUMNS")
        .stdin(Stdio::null())
        .stdout(writer.try_clone().unwrap())
        .stderr(writer)
        .spawn()
        .unwrap();
    let mut printed = String::new();
    reader.read_to_string(&mut printed).unwrap();
    (printed.replace(NARROW, " "), child.wait().unwrap().success())
}

/// The first shown line that was not printed where it should be.
fn missing<'a>(shown: &'a [String], printed: &str) -> Option<&'a str> {
    let printed: Vec<&str> = printed.trim_matches('\n').lines().collect();
    let mut at = 0;
    let mut anywhere = false;
    for line in shown {
        if line == "..." {
            anywhere = true;
            continue;
        }
        let reach = if anywhere { printed.len() } else { printed.len().min(at + 1) };
        let found = (at..reach).find(|i| same(line, printed[*i]));
        let Some(found) = found else { return Some(line) };
        (at, anywhere) = (found + 1, false);
    }
    (!anywhere && at < printed.len()).then_some("the end")
}

/// Whether a line was printed as it is shown: as text up to `...`, full digits up to rounding.
fn same(shown: &str, printed: &str) -> bool {
    if let Some(begin) = shown.strip_suffix("...") {
        return printed.starts_with(begin);
    }
    let cells = |line: &str| line.trim_end().split(',').map(str::to_owned).collect::<Vec<_>>();
    let (a, b) = (cells(shown), cells(printed));
    a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| a == b || near(a, b))
}

fn near(a: &str, b: &str) -> bool {
    let full = |x: &str| if x.len() > 17 && x.contains('e') { x.parse::<f64>().ok() } else { None };
    matches!((full(a), full(b)), (Some(a), Some(b)) if (a - b).abs() <= ROUNDING * b.abs())
}

fn verify(document: &str, locale: &str) {
    let text = read(document);
    let page = page(&text);
    let folder = common::folder(&format!("tutorial-{locale}"));
    for (name, content) in &page.files {
        std::fs::write(folder.join(name), content).unwrap();
    }
    for shown in &page.commands {
        let (printed, done) = run(&shown.command, &folder, locale);
        let fails = shown.lines.iter().any(|l| l.starts_with("error[") || l.starts_with("ошибка["));
        assert_eq!(done, !fails, "{document}: {}\n{printed}", shown.command);
        if let Some(line) = missing(&shown.lines, &printed) {
            panic!("{document}: {}\nnot printed there: {line}\n\n{printed}", shown.command);
        }
    }
}

fn read(document: &str) -> String {
    let path = format!("{}/../../{document}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"))
}

#[test]
fn the_english_tutorial_shows_what_is_printed() {
    verify("docs/tutorial.md", "C");
}

#[test]
fn the_russian_tutorial_shows_what_is_printed() {
    verify("docs/tutorial.ru.md", "ru_RU.UTF-8");
}

#[test]
fn the_readme_shows_what_is_printed() {
    verify("README.md", "en_GB.UTF-8");
}

#[test]
fn both_tutorials_run_the_same_commands() {
    let verbs = |document: &str| -> Vec<Vec<String>> {
        page(&read(document)).commands.iter().map(|s| arguments(&s.command).into_iter().take(3).collect()).collect()
    };
    let english = verbs("docs/tutorial.md");
    assert!(english.len() > 8, "the tutorial has its commands: {english:?}");
    assert_eq!(english, verbs("docs/tutorial.ru.md"));
}

#[test]
fn a_line_that_is_not_printed_is_found() {
    let lines = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
    let of = |shown: &str, printed: &str| missing(&lines(shown), printed).map(str::to_owned);
    assert_eq!(of("a\n...\nd", "a\nb\nc\nd\n"), None);
    assert_eq!(of("a\n...\nx", "a\nb\nc\nd\n").as_deref(), Some("x"));
    assert_eq!(of("a\nc", "a\nb\nc\n").as_deref(), Some("c"));
    assert_eq!(of("a", "a\nb\n").as_deref(), Some("the end"));
    assert_eq!(of("size: ...", "size: 3\n"), None);
    assert_eq!(of("1.0000000000000000e0,b", "1.0000000000000002e0,b\n"), None);
    assert!(of("1.0000000000000000e0,b", "1.0000000001000000e0,b\n").is_some());
    assert!(of("1.047", "1.048\n").is_some());
}
