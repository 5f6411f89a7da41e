//! One thing, one file, one row: every row of a table of the house has what belongs to it, and nobody else knows it by its name.

use super::imports::Crate;
use super::{read, root};
use std::fs;
use std::path::PathBuf;

/// The reference in one language.
fn reference(ending: &str) -> String {
    let files = fs::read_dir(root().join("docs/model-file")).expect("the reference").map(|e| e.expect("an entry").path());
    let of_language = |f: &PathBuf| f.to_string_lossy().ends_with(".ru.md") == (ending == ".ru.md");
    files.filter(of_language).map(|f| read(&f)).collect()
}

/// What stands beside the row of an element or connection for figures and sentences.
fn is_shown(name: &str, listed: mechanics::asked::Words) {
    let row = studies::shown::find(name).unwrap_or_else(|| panic!("{name} has no row in studies::shown"));
    assert!(!row.symbols.is_empty(), "{name} has no symbol");
    for symbol in row.symbols {
        assert!(report::scheme::symbols::find(symbol).is_some(), "{name}: there is no symbol {symbol}");
    }
    assert!(!listed.0.is_empty() && listed.1.chars().any(|c| ('а'..='я').contains(&c)), "{name} is not explained in the list of tables");
}

/// An element is one file, one row, one chapter: the row has its chapter in the book, its table and its functions in the reference in both languages, and a
/// chapter with a model of it.
#[test]
fn every_row_of_elements_has_its_pages() {
    let reference = [".md", ".ru.md"].map(reference);
    for row in mechanics::elements::TABLE {
        let name = row.keys.name;
        let chapter = root().join("tests/book").join(row.chapter).with_extension("md");
        assert!(read(&chapter).contains(&format!("[{name}.")), "{} has no model with [{name}.NAME]", chapter.display());
        assert!(root().join(format!("crates/mechanics/src/elements/{name}.rs")).exists(), "{name} has no file of its own");
        is_shown(name, row.listed);
        let called = studies::shown::find(name).map_or(("", ""), |row| row.called);
        assert!(!called.0.is_empty() && !called.1.is_empty(), "the calculation has no name for [{name}]");
        for pages in &reference {
            assert!(pages.contains(&format!("[{name}.")), "the reference lacks [{name}]");
            row.functions.iter().for_each(|f| assert!(pages.contains(&format!("`{}(", f.name)), "the reference lacks {}", f.name));
        }
    }
}

/// The same for connections: one file, one row, one chapter.
#[test]
fn every_row_of_connections_has_its_pages() {
    for row in mechanics::connections::TABLE {
        let name = row.keys.name;
        let chapter = root().join("tests/book").join(row.chapter).with_extension("md");
        assert!(read(&chapter).contains(&format!("[{name}.")), "{} has no model with [{name}.NAME]", chapter.display());
        assert!(root().join(format!("crates/mechanics/src/connections/{name}.rs")).exists(), "{name} has no file of its own");
        is_shown(name, row.listed);
        for ending in [".md", ".ru.md"] {
            let pages = ["connections", "contacts"].map(|page| read(&root().join("docs/model-file").join(format!("{page}{ending}"))));
            for table in std::iter::once(&row.keys).chain(row.within) {
                let heading = if table.name == name { format!("[{name}.") } else { format!("`{}`", table.name) };
                assert!(pages.iter().any(|page| page.contains(&heading)), "the reference lacks {heading}");
            }
        }
    }
}

/// Studies without an algorithm of their own on a `System`, and why.
const NO_ALGORITHM: [(&str, &str); 3] = [
    ("equations", "they are derived when a file is read"),
    ("inverse", "a motion whose drives are reactions: `simulate`"),
    ("sweep", "it repeats other studies"),
];
/// Studies whose chapter has another name.
const CHAPTERS: [(&str, &str); 1] = [("simulate", "pendulum")];

/// Studies whose files have another name.
const FILES: [(&str, &str); 1] = [("continue", "continuation")];

/// The name of the files of a study.
pub fn file_of(study: &str) -> &str {
    FILES.iter().find(|row| row.0 == study).map_or(study, |row| row.1)
}

/// A study is an algorithm, a file, a row, a chapter; the reference and the calculation tell it.
#[test]
fn every_row_of_studies_has_what_belongs_to_it() {
    let reference = [".md", ".ru.md"].map(reference);
    for study in studies::TABLE {
        let name = study.kind().name;
        let algorithm = root().join("crates/analysis/src/studies").join(file_of(name));
        let has_one = algorithm.with_extension("rs").exists() || algorithm.join("mod.rs").exists();
        assert!(has_one != NO_ALGORITHM.iter().any(|row| row.0 == name), "{name}: an algorithm of its own, or a reason why not");
        assert!(root().join(format!("crates/studies/src/{}.rs", file_of(name))).exists(), "{name} has no file of its own");
        let chapter = CHAPTERS.iter().find(|row| row.0 == name).map_or(name, |row| row.1);
        // a study of the file, a command, or a claim of the book
        let told = read(&root().join("tests/book").join(chapter).with_extension("md"));
        let ways = [format!("kind = \"{name}\""), format!("strutt {name}")];
        let claimed = told.split("```expect\n").skip(1).filter_map(|block| block.split("```").next()).flat_map(str::lines);
        let claimed = claimed.filter_map(|line| line.split(' ').next()).any(|first| first == name);
        assert!(claimed || ways.iter().any(|way| told.contains(way)), "tests/book/{chapter}.md has no {name}");
        for pages in &reference {
            assert!(pages.contains(&format!("`kind = \"{name}\"`")), "the reference lacks {name}");
        }
        let words = [study.kind().about, study.wanted()];
        let said = |words: &(&str, &str)| !words.0.is_empty() && words.1.chars().any(|c| ('а'..='я').contains(&c));
        assert!(words.iter().all(said), "{name} has no words in both languages");
        for key in study.kind().keys {
            assert!(said(&key.about), "{name}: `{}` is not explained", key.name);
        }
    }
}

/// Where the name of a study stands outside its files, and why.
const STUDY_NAMES: [(&str, &str, &str); 11] = [
    ("strutt", "localize", "commands of their own that are no studies: `strutt equations`"),
    ("strutt", "commands::scheme", "`--at equilibrium` is a word for an instant"),
    ("studies", "keys", "the motion that commands of motions share"),
    ("studies", "written::wording", "chapters of a calculation, two of which have names of studies"),
    ("studies", "equilibrium", "the chapter of equations tells it"),
    ("studies", "small::modes", "its own room, shared with response"),
    ("studies", "small::response", "its own room"),
    ("studies", "structure::statics", "its own room"),
    ("studies", "phases", "a case of the calculation by phases, by normal modes"),
    ("studies", "statics", "the audit of the equations of equilibrium"),
    ("studies", "frame::coordinates", "below the studies: the two that divide a frame themselves"),
];

/// What others do with a study goes by what it finds (`studies::Finds`) and by its own methods, not by its name.
#[test]
fn names_of_studies_stand_in_their_own_files() {
    let names: Vec<&str> = studies::TABLE.iter().map(|study| study.kind().name).collect();
    let own = |crate_: &str, file: &str, name: &str| crate_ == "studies" && file.split("::").next() == Some(file_of(name));
    stray(&["report", "studies", "strutt"], &names, own, &STUDY_NAMES);
}

/// Where names of elements and connections stand outside their files and `studies::shown`, and why.
const TABLE_NAMES: [(&str, &str, &str); 14] = [
    ("mechanics", "connections::common::pair", "what belts, chains and gears share: how each of them turns its wheels"),
    ("mechanics", "connections::common::tracks", "what racks and rolling share"),
    ("mechanics", "connections::frictions::places", "what a friction may rub at"),
    ("mechanics", "connections::ropes", "a rope and a thread have one reading"),
    ("mechanics", "fields::structures", "rods and supports of a frame are tables of their own with the same names"),
    ("mechanics", "read::structures", "the same"),
    ("mechanics", "read::structures::loads", "loads on its nodes and rods"),
    ("mechanics", "read::structures::owner", "whose a row of such a table is"),
    ("mechanics", "read::plane", "the weight of a rod of a frame"),
    ("mechanics", "read::parameters", "tables with which a file needs no coordinate"),
    ("mechanics", "formula::scope", "the force of a slider is its normal force"),
    ("studies", "scheme::structure", "loads of a frame that stand in its nodes and rods"),
    ("studies", "shown", "their rows"),
    ("studies", "variants::resting", "fields of JSON of a frame"),
];

/// How an element or connection is drawn and told follows from its rows.
#[test]
fn names_of_elements_and_connections_stand_in_their_own_files() {
    let elements = mechanics::elements::TABLE.iter().map(|row| row.keys.name);
    let names: Vec<&str> = elements.chain(mechanics::connections::TABLE.iter().map(|row| row.keys.name)).collect();
    let own = |crate_: &str, file: &str, name: &str| {
        crate_ == "mechanics" && [format!("elements::{name}"), format!("connections::{name}")].iter().any(|home| file == home)
    };
    stray(&["mechanics", "report", "studies"], &names, own, &TABLE_NAMES);
}

/// Fails for a quoted name outside its own file and the exceptions, and for an exception that is none.
fn stray(crates: &[&str], names: &[&str], own: impl Fn(&str, &str, &str) -> bool, but: &[(&str, &str, &str)]) {
    let mut wrong = Vec::new();
    let mut used = vec![false; but.len()];
    for crate_ in crates {
        for (file, text) in Crate::open(crate_).files {
            if file.iter().any(|part| part == "tests") {
                continue;
            }
            let file = file.join("::");
            for name in names {
                let quoted = format!("\"{name}\"");
                if own(crate_, &file, name) || !text.lines().any(|line| says(line, &quoted)) {
                    continue;
                }
                match but.iter().position(|row| row.0 == *crate_ && row.1 == file) {
                    Some(k) => used[k] = true,
                    None => wrong.push(format!("{crate_}, {file}: {quoted}")),
                }
            }
        }
    }
    let idle = but.iter().zip(used).filter(|(row, used)| crates.contains(&row.0) && !used);
    wrong.extend(idle.map(|(row, _)| format!("{}, {}: no exception any more", row.0, row.1)));
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// Whether a line has a quoted name that is no key of JSON.
fn says(line: &str, quoted: &str) -> bool {
    line.match_indices(quoted).any(|(i, _)| {
        let key = ["insert(", "get(", "entry("].iter().any(|before| line[..i].ends_with(before));
        !key && !line[i + quoted.len()..].starts_with(':')
    })
}

/// What figures and sentences need of a kind of connection stands in its file of `studies::connections`: nobody else there looks at what kind one is.
#[test]
fn kinds_of_connections_are_told_apart_in_one_place() {
    for (file, text) in Crate::open("studies").files {
        let file = file.join("::");
        assert!(file == "connections" || !text.contains("ConnectionKind"), "studies, {file}: a question for `studies::connections`");
    }
}
