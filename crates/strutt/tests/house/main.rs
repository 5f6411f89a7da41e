//! The rules of the house (ARCHITECTURE.md), held against the sources: arrows between crates run down the street, no import circle ties folders or files of a
//! crate but those that are listed, and every chapter, code and example that a table promises is there.

mod additions;
mod imports;
mod numbers;
mod rows;

use imports::{Crate, Module, Which, circles, circles_of_folders, hold};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The street, ground floor first: a crate may use those before it.
const STREET: [&str; 10] =
    ["words", "algebra", "symbolic", "structures", "mechanics", "program", "analysis", "report", "studies", "strutt"];
/// Arrows that the street would allow and the house does not: who must not know whom.
const STRANGERS: [(&str, &str); 9] = [
    ("algebra", "words"),
    ("program", "structures"),
    ("structures", "program"),
    ("program", "mechanics"),
    ("analysis", "mechanics"),
    ("report", "mechanics"),
    ("report", "program"),
    ("mechanics", "analysis"),
    ("mechanics", "report"),
];
/// Circles of folders that stand: crate, a member of it, and how many members at most. One that is gone or smaller must be taken off.
const FOLDER_CIRCLES: &[(&str, &str, usize)] = &[];
/// The same for files.
const FILE_CIRCLES: &[(&str, &str, usize)] = &[
    // a study runs on a machine, and a machine knows the studies that its file may ask for
    ("studies", "machine::study", 2),
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

#[test]
fn arrows_between_crates_run_down_the_street() {
    let crates: BTreeSet<String> = fs::read_dir(root().join("crates"))
        .expect("crates")
        .map(|e| e.expect("a crate").file_name().to_string_lossy().into_owned())
        .collect();
    assert_eq!(crates, STREET.iter().map(|s| (*s).to_owned()).collect(), "the street and the folder `crates`");
    for (floor, name) in STREET.iter().enumerate() {
        let manifest = read(&root().join("crates").join(name).join("Cargo.toml"));
        let own = manifest.split("[dependencies]").nth(1).unwrap_or_default();
        let own = own.split("\n[").next().unwrap_or_default();
        for used in own.lines().filter_map(|line| line.split(['.', ' ', '=']).next()) {
            let Some(other) = STREET.iter().position(|s| *s == used) else { continue };
            assert!(other < floor, "{name} uses {used}, which stands above it");
            assert!(!STRANGERS.contains(&(*name, used)), "{name} must not know {used}");
        }
    }
}

#[test]
fn no_circle_ties_folders_or_files() {
    let mut wrong = Vec::new();
    for name in STREET {
        let house = Crate::open(name);
        let arrows = house.arrows();
        wrong.extend(hold(name, &circles_of_folders(&house, &arrows), FOLDER_CIRCLES));
        let inner: BTreeSet<(Module, Module)> = arrows.into_iter().filter(|(a, b)| !a.is_empty() && !b.is_empty()).collect();
        wrong.extend(hold(name, &circles(&inner), FILE_CIRCLES));
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// The head of a crate names its rooms; a study has its own file and needs no mention.
#[test]
fn every_room_stands_in_the_head_of_its_crate() {
    let mut missing = Vec::new();
    for name in STREET {
        let source = root().join("crates").join(name).join("src");
        let lib = read(&source.join("lib.rs"));
        let head: String = lib.lines().take_while(|line| line.starts_with("//!")).collect();
        for line in lib.lines() {
            let Some(room) = line.trim_start_matches("pub ").strip_prefix("mod ").and_then(|rest| rest.strip_suffix(';')) else { continue };
            let is_study = fs::read_to_string(source.join(format!("{room}.rs"))).is_ok_and(|text| text.contains("\nimpl Study for "));
            if !is_study && !head.contains(&format!("`{room}`")) && !head.contains(&format!("`mod@{room}`")) {
                missing.push(format!("{name}: {room}"));
            }
        }
    }
    assert!(missing.is_empty(), "rooms that no head names: {missing:?}");
}

/// The studies of `analysis` are so many that their folder has a map of its own.
#[test]
fn every_algorithm_stands_in_the_map_of_the_studies() {
    let text = read(&root().join("crates/analysis/src/studies/mod.rs"));
    let head: String = text.lines().take_while(|line| line.starts_with("//!")).collect();
    let rooms = text.lines().filter_map(|line| line.split_once("mod ")?.1.strip_suffix(';'));
    let missing: Vec<&str> = rooms.filter(|room| !head.contains(&format!("`{room}`"))).collect();
    assert!(text.contains("pub mod simulate;") && missing.is_empty(), "rooms that the map does not name: {missing:?}");
}

/// What only the command line has: terminals, signals, and pictures made of pixels, which `report` draws when it is asked to.
const TERMINALS: [&str; 6] = ["clap", "clap_complete", "indicatif", "console", "ctrlc", "annotate-snippets"];
/// What reaches outside the process.
const OUTSIDE: [&str; 6] = ["std::time", "std::fs", "std::env", "std::process", "std::thread", "std::net"];

/// Everything below `strutt` can run in a browser and in Python.
#[test]
fn below_the_command_line_nothing_reaches_outside() {
    for name in STREET.iter().filter(|name| **name != "strutt") {
        let manifest = read(&root().join("crates").join(name).join("Cargo.toml"));
        let own = manifest.split("[dependencies]").nth(1).unwrap_or_default().split("\n[").next().unwrap_or_default();
        for line in own.lines() {
            let used = line.split(['.', ' ', '=']).next().unwrap_or_default();
            assert!(!TERMINALS.contains(&used), "{name} uses {used}");
            assert!(used != "resvg" || line.contains("optional = true"), "{name} cannot do without resvg");
            assert!(!line.contains("\"png\""), "{name} asks {used} for pictures made of pixels");
        }
        for (file, text) in Crate::open(name).files {
            let found = OUTSIDE.iter().find(|word| text.contains(**word));
            assert!(found.is_none(), "{name}, {}: {}", file.join("::"), found.unwrap_or(&""));
        }
    }
}

/// The map of the house is read in one sitting.
#[test]
fn the_map_of_the_house_is_short() {
    assert!(read(&root().join("ARCHITECTURE.md")).lines().count() <= 80);
}

/// A crate begins with what it must not know and with its rooms in order of reading.
#[test]
fn every_crate_says_its_rooms() {
    for name in STREET {
        let text = read(&root().join("crates").join(name).join("src/lib.rs"));
        let head: String = text.lines().take_while(|line| line.starts_with("//!")).collect::<Vec<_>>().join(" ").to_lowercase();
        assert!(head.contains("order of reading"), "{name} does not name its rooms");
        let strange = ["know", "no physics", "does not evaluate"].iter().any(|word| head.contains(word));
        assert!(strange, "{name} does not say what it must not know");
    }
}

/// All Rust files below a folder.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder").map(|e| e.expect("an entry").path()) {
            if entry.is_dir() {
                folders.push(entry);
            } else if entry.extension().is_some_and(|e| e == "rs") {
                found.push(entry);
            }
        }
    }
    found
}

/// Every file of the library begins with what it is.
#[test]
fn every_file_says_what_it_is() {
    for file in STREET.iter().flat_map(|name| sources(&root().join("crates").join(name).join("src"))) {
        assert!(read(&file).starts_with("//! "), "{} does not say what it is", file.display());
    }
}

/// Files of more than 600 lines, each with its reason; 800 are split whatever the reason is (STYLE.md).
const LONG: &[(&str, &str)] = &[];

#[test]
fn a_file_is_short_or_says_why_not() {
    let mut long = BTreeSet::new();
    for file in STREET.iter().flat_map(|name| sources(&root().join("crates").join(name).join("src"))) {
        let lines = read(&file).lines().count();
        assert!(lines < 800, "{}: {lines} lines", file.display());
        if lines > 600 {
            long.insert(file.strip_prefix(root().join("crates")).expect("a file of a crate").to_string_lossy().into_owned());
        }
    }
    let listed: BTreeSet<String> = LONG.iter().map(|(file, _)| (*file).to_owned()).collect();
    assert_eq!(long, listed, "files of more than 600 lines, and those that have a reason for it");
}

/// Who goes by a code takes it from where it is raised: a code that changes there must not leave a comparison behind that nothing meets any more.
#[test]
fn no_code_is_compared_by_its_letters() {
    let mut bare = Vec::new();
    let mut named = 0;
    let files = STREET.iter().flat_map(|name| sources(&root().join("crates").join(name).join("src")));
    for file in files.filter(|file| !file.ends_with("tests.rs")) {
        let text = read(&file);
        for line in text.split("#[cfg(test)]\nmod ").next().unwrap_or_default().lines() {
            let Some((_, other)) = line.split_once("code == ").or_else(|| line.split_once("code != ")) else { continue };
            named += 1;
            if other.starts_with('"') {
                bare.push(format!("{}: {}", file.display(), line.trim()));
            }
        }
    }
    assert!(named > 15 && bare.is_empty(), "{named} comparisons, of them with letters:\n{}", bare.join("\n"));
}

/// Whoever calls a room from above reads there when it fails; commands fail with what the user reads.
#[test]
fn what_can_fail_says_when() {
    let mut silent = Vec::new();
    let mut seen = 0;
    for file in STREET.iter().filter(|name| **name != "strutt").flat_map(|name| sources(&root().join("crates").join(name).join("src"))) {
        let text = read(&file);
        let code = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
        let lines: Vec<&str> = code.lines().collect();
        for (i, line) in lines.iter().enumerate().filter(|(_, line)| line.trim_start().starts_with("pub fn ")) {
            // no head has as many lines
            let head = lines[i..lines.len().min(i + 20)].join(" ");
            let result = head.split('{').next().unwrap_or_default().split_once("->").map_or("", |(_, result)| result);
            let about = lines[..i].iter().rev().take_while(|above| above.trim_start().starts_with(['/', '#']));
            seen += usize::from(result.contains("Result<"));
            if result.contains("Result<") && !about.into_iter().any(|above| above.contains("Errors")) {
                silent.push(format!("{}: {}", file.display(), line.trim()));
            }
        }
    }
    assert!(seen > 200 && silent.is_empty(), "no word of errors:\n{}", silent.join("\n"));
}

/// The lint against bool arguments does not look into tuples.
#[test]
fn no_tuple_of_arguments_hides_a_bool() {
    let mut hidden = Vec::new();
    let mut seen = 0;
    for file in STREET.iter().flat_map(|name| sources(&root().join("crates").join(name).join("src"))) {
        for line in read(&file).lines() {
            let Some((_, types)) = line.split_once("): (").filter(|_| !line.trim_start().starts_with("let ")) else { continue };
            seen += 1;
            if types.split(')').next().is_some_and(|types| types.split(", ").any(|one| one == "bool")) {
                hidden.push(format!("{}: {}", file.display(), line.trim()));
            }
        }
    }
    assert!(seen > 100 && hidden.is_empty(), "\n{}", hidden.join("\n"));
}

/// The compiler tells of private functions that nobody calls; of public ones it does not know. What clippy.toml offers in place of a forbidden function is called by name there.
#[test]
fn what_is_public_is_named_somewhere_else() {
    let texts: Vec<String> =
        ["crates", "benches"].iter().flat_map(|folder| sources(&root().join(folder))).map(|file| read(&file)).collect();
    let clippy = read(&root().join("clippy.toml"));
    let code = || texts.iter().chain([&clippy]).flat_map(|text| text.lines()).map(|line| line.split("//").next().unwrap_or_default());
    let mut times: BTreeMap<&str, usize> = BTreeMap::new();
    let words = code().flat_map(|line| line.split(|c: char| !c.is_alphanumeric() && c != '_'));
    words.for_each(|word| *times.entry(word).or_default() += 1);
    let declared = code().filter_map(|line| {
        let rest = line.trim_start().strip_prefix("pub ")?;
        let kinds = ["fn ", "const fn ", "static ", "const ", "struct ", "enum ", "trait ", "type "];
        let name = kinds.iter().find_map(|kind| rest.strip_prefix(kind))?;
        name.split(|c: char| !c.is_alphanumeric() && c != '_').next()
    });
    let dead: BTreeSet<&str> = declared.filter(|name| times.get(name) == Some(&1)).collect();
    assert!(times.len() > 10_000 && dead.is_empty(), "nobody names {dead:?}");
}

/// The circles are found at all: a small house with one.
#[test]
fn a_circle_is_seen() {
    let mut small = Crate { files: BTreeMap::new(), handed: BTreeMap::new() };
    let file = |name: &str| -> Module { vec![name.to_owned()] };
    small.files.insert(file("a"), "use crate::b::{B, self as other};\n".into());
    small.files.insert(file("b"), "pub use crate::c::C;\n".into());
    small.files.insert(file("c"), "fn f() { super::a::g() }\n".into());
    small.files.insert(file("d"), "use crate::a::A;\n".into());
    // a file and one within its folder, called by its path
    small.files.insert(file("e"), "mod child;\nfn f() { child::g() }\n".into());
    small.files.insert(vec!["e".into(), "child".into()], "use super::{\n    E,\n};\n".into());
    // two rooms of a folder, one of them a folder
    let deep = |name: &str| -> Module { name.split("::").map(str::to_owned).collect() };
    small.files.insert(deep("f"), "mod g;\nmod h;\n".into());
    small.files.insert(deep("f::g::one"), "use super::super::h::H;\n".into());
    small.files.insert(deep("f::g::two"), String::new());
    small.files.insert(deep("f::h"), "use crate::f::g::two::T;\n".into());
    let names: Vec<Module> = small.files.keys().cloned().collect();
    for name in names {
        let handed = small.imports(&name, Which::HandedOn).into_iter().map(|(path, alias)| (alias, path)).collect();
        small.handed.insert(name, handed);
    }
    let nested: BTreeSet<Module> = [file("e"), vec!["e".to_owned(), "child".to_owned()]].into();
    let arrows = small.arrows();
    assert_eq!(circles(&arrows), [["a", "b", "c"].iter().map(|n| file(n)).collect::<BTreeSet<_>>(), nested]);
    assert_eq!(circles_of_folders(&small, &arrows), [BTreeSet::from([deep("f::g"), deep("f::h")])]);
}
