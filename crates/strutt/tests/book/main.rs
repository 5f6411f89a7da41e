//! Runs the verification book: every expectation of every chapter in tests/book, and of every page of the gallery, is one test.

mod chapter;
mod claim;
mod command;
mod drawn;
mod motion;
mod outcome;
mod printed;
mod run;

use libtest_mimic::{Arguments, Trial};
use std::path::{Path, PathBuf};

fn main() -> std::process::ExitCode {
    let arguments = Arguments::from_args();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut chapters: Vec<PathBuf> = entries(&root.join("tests/book"))
        .into_iter()
        .filter(|path| path.extension().is_some_and(|x| x == "md") && !path.ends_with("README.md"))
        .collect();
    chapters.extend(entries(&root.join("gallery")).into_iter().map(|folder| folder.join("README.md")).filter(|page| page.is_file()));
    chapters
        .extend(entries(&root.join("gallery/courses")).into_iter().map(|folder| folder.join("README.md")).filter(|page| page.is_file()));
    chapters.sort();
    let trials = chapters.iter().flat_map(|file| chapter::read(&root, file));
    let tests = trials.map(|trial| Trial::test(trial.name.clone(), move || run::check(&trial).map_err(Into::into))).collect();
    libtest_mimic::run(&arguments, tests).exit_code()
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    entries.flatten().map(|entry| entry.path()).collect()
}
