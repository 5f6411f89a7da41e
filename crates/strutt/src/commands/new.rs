//! `strutt new NAME`: a model file to start from. Nothing is ever overwritten.

use super::{Exit, examples};
use crate::args;
use crate::console::{Console, quoted};
use std::path::{Path, PathBuf};
use strutt::wording::Word;
use strutt::{chain, files, gallery};
use studies::Failure;
use studies::failure::Misuse;
use words::Notice;

/// What a name that is no example begins with.
const STARTER: &str = include_str!("starter.toml");

pub fn run(args: &args::New, console: &mut Console) -> Result<Exit, Failure> {
    let path = path_of(&args.name)?;
    let text = text(args, &path)?;
    let tables = tables(args, &path);
    if let Some((table, text)) = tables.iter().find(|(table, _)| table.exists()) {
        // refused before anything is written
        files::write_new(table, text.as_bytes())?;
    }
    files::write_new(&path, text.as_bytes())?;
    console.talk(&format!("{} {}", console.say(Word::Written), path.display()));
    for (table, text) in &tables {
        files::write_new(table, text.as_bytes())?;
        console.talk(&format!("{} {}", console.say(Word::Written), table.display()));
    }
    console.next(&format!("strutt run {}", quoted(&operand(&path))));
    Ok(Exit::Done)
}

/// With .toml behind it.
fn path_of(name: &str) -> Result<PathBuf, Failure> {
    let last = name.rsplit(std::path::is_separator).next().unwrap_or_default().trim();
    let stem = last.strip_suffix(".toml").unwrap_or(last);
    if stem.chars().all(|c| c == '.') {
        return Err(nameless(name).misuse());
    }
    let path = PathBuf::from(name);
    Ok(if path.extension().is_some_and(|e| e == "toml") { path } else { PathBuf::from(format!("{name}.toml")) })
}

/// The path as a command takes it: what begins with a dash would be an option.
fn operand(path: &Path) -> String {
    let text = path.to_string_lossy();
    if text.starts_with('-') { format!("./{text}") } else { text.into_owned() }
}

fn nameless(name: &str) -> Notice {
    Notice::new("C053", format!("`{name}` is no name for a file"), format!("`{name}` не годится как имя файла"))
        .help("strutt new crane", "strutt new crane")
}

fn text(args: &args::New, path: &Path) -> Result<String, Failure> {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let from = args.from.as_deref().unwrap_or(&stem);
    if let Some(count) = args.count {
        return links(from, count);
    }
    match (&args.from, gallery::find(from)) {
        (_, Some(example)) => Ok(example.text.to_owned()),
        (Some(from), None) => examples::find(from).map(|e| e.text.to_owned()),
        (None, None) => Ok(STARTER.to_owned()),
    }
}

/// The tables of the example that are not there already.
fn tables(args: &args::New, path: &Path) -> Vec<(PathBuf, &'static str)> {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let from = args.from.as_deref().unwrap_or(&stem);
    let beside = gallery::tables(from).map(|(file, text)| (path.with_file_name(file), text));
    beside.filter(|(table, text)| std::fs::read(table).ok().as_deref() != Some(text.as_bytes())).collect()
}

fn links(from: &str, count: usize) -> Result<String, Failure> {
    let limit = chain::LONGEST;
    if from != "n-pendulum" {
        let trouble = Notice::new("C009", "--count belongs to n-pendulum only", "ключ --count относится только к n-pendulum");
        return Err(trouble.help("strutt new n-pendulum --count 10", "strutt new n-pendulum --count 10").misuse());
    }
    if !(1..=limit).contains(&count) {
        let (en, ru) =
            (format!("--count {count}: 1 ... {limit} pendulums"), format!("--count {count}: маятников может быть 1 ... {limit}"));
        return Err(Notice::new("C009", en, ru).misuse());
    }
    Ok(chain::model(count))
}
