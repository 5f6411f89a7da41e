//! What an addition touches: the files of the sources that know of it, counted for a study and an element that were added as trials, and for all others by their imports.

use super::imports::{Crate, Module};
use super::{STREET, read, root};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Two additions, and every file of the sources that names them with what it says there.
const ADDED: [(&str, &[(&str, &str)]); 2] = [
    (
        "poincare",
        &[
            ("analysis/src/studies/poincare.rs", "the algorithm"),
            ("analysis/src/studies/mod.rs", "its `pub mod`, and its line of the map"),
            ("analysis/src/made.rs", "it is generic in what moves: compiled once"),
            ("studies/src/poincare.rs", "the study"),
            ("studies/src/lib.rs", "its `pub mod` and its row"),
        ],
    ),
    (
        "torsion_bars",
        &[
            ("mechanics/src/elements/torsion_bars.rs", "the element"),
            ("mechanics/src/elements/mod.rs", "its `mod` and its row"),
            ("mechanics/src/explain/axes.rs", "an example of a code"),
            ("studies/src/shown.rs", "its symbol, letter and name"),
        ],
    ),
];

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder").map(|e| e.expect("an entry").path()) {
        if entry.is_dir() {
            sources(&entry, found);
        } else if entry.extension().is_some_and(|e| e == "rs") {
            found.push(entry);
        }
    }
}

/// Whether a text has a name as a word of its own.
fn names(text: &str, name: &str) -> bool {
    let part = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(name).any(|(i, _)| !text[..i].ends_with(part) && !text[i + name.len()..].starts_with(part))
}

/// No file of the sources but those that are listed names a study or an element that was added.
#[test]
fn an_addition_touches_the_files_that_the_recipe_names() {
    let crates = root().join("crates");
    let mut files = Vec::new();
    STREET.iter().for_each(|name| sources(&crates.join(name).join("src"), &mut files));
    for (name, listed) in ADDED {
        let found: BTreeSet<String> = files
            .iter()
            .filter(|file| names(&read(file), name))
            .map(|file| file.strip_prefix(&crates).expect("a file of a crate").to_string_lossy().replace('\\', "/"))
            .collect();
        assert_eq!(found, listed.iter().map(|(file, _)| (*file).to_owned()).collect(), "{name}");
    }
}

/// Studies of which other files of `studies` take something, besides the table, and why. All others can be taken out with their files and their row.
const STOOD_ON: [(&str, &str); 8] = [
    ("simulate", "whatever is repeated, sought or cut is a motion"),
    ("periodic", "branches, verdicts and sweeps are those of its regimes"),
    ("equilibrium", "small motions, branches and pictures are about its places"),
    ("stability", "maps and branches take its verdicts and its periods"),
    ("statics", "its reactions are repeated, told and graded"),
    ("modes", "published frequencies are laid against them"),
    ("response", "a student's answer in it needs frequencies below the range"),
    ("transient", "answers of phases are taken from it"),
];

/// The study that a file belongs to.
fn of_study<'a>(file: &Module, studies: &[&'a str]) -> Option<&'a str> {
    file.first().and_then(|first| studies.iter().find(|name| **name == first.as_str()).copied())
}

/// A study is known by the table and by itself; where another stands on it, it is listed with the reason.
#[test]
fn a_study_is_known_by_its_row() {
    let files: Vec<&str> = studies::TABLE.iter().map(|study| super::rows::file_of(study.kind().name)).collect();
    let house = Crate::open("studies");
    let mut known: Vec<(String, String)> = Vec::new();
    for (from, to) in house.arrows() {
        let (user, used) = (of_study(&from, &files), of_study(&to, &files));
        if let Some(used) = used.filter(|used| user != Some(used) && !from.is_empty()) {
            known.push((used.to_owned(), from.join("::")));
        }
    }
    let mut wrong: Vec<String> = known
        .iter()
        .filter(|(used, _)| !STOOD_ON.iter().any(|row| row.0 == used))
        .map(|(used, user)| format!("{user} knows the study {used}"))
        .collect();
    wrong.extend(
        STOOD_ON.iter().filter(|row| !known.iter().any(|(used, _)| used == row.0)).map(|row| format!("nobody stands on {}", row.0)),
    );
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// Who takes something of an element besides the table, and why.
const TAKEN: [(&str, &str, &str); 1] = [("read::connections::distributed", "forces", "a distributed load is read as equivalent forces")];

/// The same for elements: in `mechanics` the table alone names their files.
#[test]
fn an_element_is_known_by_its_row() {
    let house = Crate::open("mechanics");
    let elements: Vec<&str> = mechanics::elements::TABLE.iter().map(|row| row.keys.name).collect();
    let is_one = |file: &Module| matches!(file.as_slice(), [room, name] if room == "elements" && elements.contains(&name.as_str()));
    let table: Module = vec!["elements".to_owned()];
    let strangers = house.arrows().into_iter().filter(|(from, to)| is_one(to) && *from != table && from != to);
    let found: BTreeSet<(String, String)> = strangers.map(|(from, to)| (from.join("::"), to[1].clone())).collect();
    let listed: BTreeSet<(String, String)> = TAKEN.iter().map(|row| (row.0.to_owned(), row.1.to_owned())).collect();
    let wrong: Vec<_> = found.symmetric_difference(&listed).collect();
    assert!(wrong.is_empty(), "{wrong:?}");
}
