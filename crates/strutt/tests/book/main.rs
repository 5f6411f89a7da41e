//! Runs the verification book: every expectation of every chapter in tests/book is one test.

mod chapter;
mod claim;
mod run;

use libtest_mimic::{Arguments, Trial};
use std::path::{Path, PathBuf};

fn main() -> std::process::ExitCode {
    let arguments = Arguments::from_args();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut chapters: Vec<PathBuf> = std::fs::read_dir(root.join("tests/book"))
        .expect("the book stands in tests/book")
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|x| x == "md") && !path.ends_with("README.md"))
        .collect();
    chapters.sort();
    let trials = chapters.iter().flat_map(|file| chapter::read(&root, file));
    let tests = trials.map(|trial| Trial::test(trial.name.clone(), move || run::check(&trial).map_err(Into::into))).collect();
    libtest_mimic::run(&arguments, tests).exit_code()
}
