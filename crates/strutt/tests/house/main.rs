//! The rules of the house (ARCHITECTURE.md), held against the sources: arrows between crates run down the street, no import circle ties folders or files of a
//! crate but those that are listed, and every chapter, code and example that a table promises is there.

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

/// The path of a module, `["derive", "loads"]`; empty for the crate's root.
type Module = Vec<String>;

/// Which imports of a file are meant.
#[derive(Clone, Copy, PartialEq)]
enum Which {
    All,
    /// Those that the file hands on.
    HandedOn,
}

/// Imports of the files of one crate.
struct Crate {
    /// What each file says, without comments and tests.
    files: BTreeMap<Module, String>,
    /// Names that a module hands on, and what they are.
    handed: BTreeMap<Module, BTreeMap<String, Module>>,
}

impl Crate {
    fn open(name: &str) -> Crate {
        let source = root().join("crates").join(name).join("src");
        let mut files = BTreeMap::new();
        let mut folders = vec![source.clone()];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(&folder).expect("a folder").map(|e| e.expect("an entry").path()) {
                if entry.is_dir() {
                    folders.push(entry);
                } else if entry.extension().is_some_and(|e| e == "rs") {
                    files.insert(module(&source, &entry), bare(&read(&entry)));
                }
            }
        }
        let mut found = Crate { files, handed: BTreeMap::new() };
        let names: Vec<Module> = found.files.keys().cloned().collect();
        for name in names {
            let handed = found.imports(&name, Which::HandedOn).into_iter().map(|(path, alias)| (alias, path)).collect();
            found.handed.insert(name, handed);
        }
        found
    }

    /// What a file imports: the path from the crate's root and the name it gets; of what it hands on alone, or of all.
    fn imports(&self, from: &Module, which: Which) -> Vec<(Module, String)> {
        let mut found = Vec::new();
        let mut lines = self.files[from].lines();
        while let Some(line) = lines.next() {
            let line = line.trim_start();
            let visible = ["pub ", "pub(crate) ", "pub(super) "].into_iter().find_map(|word| line.strip_prefix(word));
            let Some(tree) = visible.unwrap_or(line).strip_prefix("use ") else { continue };
            if which == Which::HandedOn && visible.is_none() {
                continue;
            }
            let mut tree = tree.to_owned();
            while !tree.contains(';') {
                let Some(more) = lines.next() else { break };
                tree += more;
            }
            let tree = tree.split(';').next().unwrap_or_default();
            if tree.matches('{').count() == tree.matches('}').count() {
                found.extend(leaves(tree).into_iter().filter_map(|(path, alias)| Some((self.absolute(from, &path)?, alias))));
            }
        }
        found
    }

    /// Paths written out in a file outside its imports: `crate::a::b`, `super::b`, and `child::b` of a file within its folder.
    fn mentions(&self, from: &Module) -> Vec<Module> {
        // `pub(in crate::a)` says who may see, not what is used
        let text = without_imports(&self.files[from]).replace("(in crate::", "(");
        let words = text.split(|c: char| !c.is_alphanumeric() && c != '_' && c != ':');
        let paths = words.filter(|word| word.trim_matches(':').contains("::"));
        let path = |word: &str| -> Module { word.trim_matches(':').split("::").map(str::to_owned).collect() };
        paths.filter_map(|word| self.absolute(from, &path(word))).collect()
    }

    /// A path from the crate's root; none into other crates.
    fn absolute(&self, from: &Module, path: &[String]) -> Option<Module> {
        let mut at = match path.first()?.as_str() {
            "crate" => Vec::new(),
            "self" | "super" => from.clone(),
            own => {
                let child: Module = from.iter().cloned().chain([own.to_owned()]).collect();
                return self.files.contains_key(&child).then(|| from.iter().cloned().chain(path.iter().cloned()).collect());
            }
        };
        for step in path {
            match step.as_str() {
                "crate" | "self" => {}
                "super" => {
                    at.pop();
                }
                name => at.push(name.to_owned()),
            }
        }
        Some(at)
    }

    /// The file in which a path ends, through names that are handed on.
    fn home(&self, path: &Module, depth: usize) -> Option<Module> {
        let known = (0..=path.len()).rev().find(|k| self.files.contains_key(&path[..*k]))?;
        let (file, rest) = (&path[..known], &path[known..]);
        match rest.first().and_then(|name| self.handed.get(file)?.get(name)) {
            Some(next) if depth < 8 && next != path => {
                let next: Module = next.iter().cloned().chain(rest[1..].iter().cloned()).collect();
                self.home(&next, depth + 1)
            }
            _ => Some(file.to_vec()),
        }
    }

    fn arrows(&self) -> BTreeSet<(Module, Module)> {
        let of = |from: &Module| {
            let imported = self.imports(from, Which::All).into_iter().map(|(path, _)| path);
            let to: Vec<Module> = imported.chain(self.mentions(from)).filter_map(|path| self.home(&path, 0)).collect();
            to.into_iter().filter(|to| to != from).map(|to| (from.clone(), to)).collect::<Vec<_>>()
        };
        self.files.keys().flat_map(of).collect()
    }
}

fn module(source: &Path, file: &Path) -> Module {
    let mut path: Module = file
        .strip_prefix(source)
        .expect("a file of the crate")
        .with_extension("")
        .iter()
        .map(|p| p.to_string_lossy().into_owned())
        .collect();
    path.pop_if(|last| ["mod", "lib", "main"].contains(&last.as_str()));
    path
}

/// Without comments and without the tests at the end.
fn bare(text: &str) -> String {
    // a single item for tests hides nothing behind it
    let text = &text[..text.find("#[cfg(test)]\nmod tests {").unwrap_or(text.len())];
    text.lines().map(|line| line.find("//").map_or(line, |i| &line[..i])).collect::<Vec<_>>().join("\n")
}

/// Without `use ...;`, over one line or several.
fn without_imports(text: &str) -> String {
    let mut kept = String::new();
    let mut inside = false;
    for line in text.lines() {
        let words = line.trim_start();
        let visible = ["pub ", "pub(crate) ", "pub(super) "].into_iter().find_map(|word| words.strip_prefix(word));
        inside |= visible.unwrap_or(words).starts_with("use ");
        if !inside {
            kept += line;
            kept.push('\n');
        }
        inside &= !line.contains(';');
    }
    kept
}

/// The paths of `a::{b, c::{d as e}}`, each with the name it gets.
fn leaves(tree: &str) -> Vec<(Module, String)> {
    let tree = tree.trim();
    let Some(open) = tree.find('{') else {
        let (path, alias) = tree.split_once(" as ").unwrap_or((tree, ""));
        let mut path: Module = path.split("::").map(|p| p.trim().to_owned()).filter(|p| !p.is_empty()).collect();
        path.pop_if(|last| last == "self");
        let last = path.last().cloned().unwrap_or_default();
        return if path.is_empty() { Vec::new() } else { vec![(path, if alias.is_empty() { last } else { alias.trim().to_owned() })] };
    };
    let head: Module = tree[..open].split("::").map(|p| p.trim().to_owned()).filter(|p| !p.is_empty()).collect();
    let inner = &tree[open + 1..tree.rfind('}').unwrap_or(tree.len())];
    let (mut depth, mut from, mut parts) = (0_i32, 0, Vec::new());
    for (i, c) in inner.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&inner[from..i]);
                from = i + 1;
            }
            _ => {}
        }
    }
    parts.push(&inner[from..]);
    let joined = |(path, alias): (Module, String)| (head.iter().cloned().chain(path).collect(), alias);
    parts.into_iter().flat_map(leaves).map(joined).collect()
}

/// Sets of nodes that reach one another, with two members at least.
fn circles(arrows: &BTreeSet<(Module, Module)>) -> Vec<BTreeSet<Module>> {
    let mut next: BTreeMap<&Module, Vec<&Module>> = BTreeMap::new();
    arrows.iter().for_each(|(a, b)| next.entry(a).or_default().push(b));
    let reach = |from: &Module| -> BTreeSet<Module> {
        let (mut seen, mut stack) = (BTreeSet::new(), vec![from]);
        while let Some(at) = stack.pop() {
            for to in next.get(at).into_iter().flatten() {
                if seen.insert((*to).clone()) {
                    stack.push(to);
                }
            }
        }
        seen
    };
    let reached: BTreeMap<&Module, BTreeSet<Module>> = next.keys().map(|node| (*node, reach(node))).collect();
    let mut found: Vec<BTreeSet<Module>> = Vec::new();
    for (node, to) in &reached {
        let both: BTreeSet<Module> =
            to.iter().filter(|other| reached.get(other).is_some_and(|back| back.contains(*node))).cloned().collect();
        if both.len() > 1 && !found.contains(&both) {
            found.push(both);
        }
    }
    found
}

/// Circles among the rooms of a folder that have rooms of their own in them, folders of all levels. What the file of the folder itself hands on is for those outside.
fn circles_of_folders(house: &Crate, arrows: &BTreeSet<(Module, Module)>) -> Vec<BTreeSet<Module>> {
    let folders: BTreeSet<Module> = house.files.keys().flat_map(|file| (0..file.len()).map(|k| file[..k].to_vec())).collect();
    let within = |folder: &Module| {
        let room = |file: &Module| (file.len() > folder.len() && file.starts_with(folder)).then(|| file[..=folder.len()].to_vec());
        let between = arrows.iter().filter_map(|(a, b)| Some((room(a)?, room(b)?))).filter(|(a, b)| a != b).collect();
        circles(&between)
    };
    // one of files alone is found among files
    folders.iter().flat_map(within).filter(|circle| circle.iter().any(|room| folders.contains(room))).collect()
}

/// Compares circles with those that are known to stand.
fn hold(name: &str, found: &[BTreeSet<Module>], known: &[(&str, &str, usize)]) -> Vec<String> {
    let shown = |circle: &BTreeSet<Module>| circle.iter().map(|m| m.join("::")).collect::<Vec<_>>().join(", ");
    let known: Vec<_> = known.iter().filter(|k| k.0 == name).collect();
    let is_in = |circle: &BTreeSet<Module>, member: &str| circle.iter().any(|m| m.join("::") == member);
    let mut wrong: Vec<String> = Vec::new();
    for circle in found {
        match known.iter().find(|k| is_in(circle, k.1)) {
            None => wrong.push(format!("{name}: a circle of {}: {}", circle.len(), shown(circle))),
            Some(k) if circle.len() > k.2 => {
                wrong.push(format!("{name}: the circle of {} has grown to {}: {}", k.1, circle.len(), shown(circle)))
            }
            Some(k) if circle.len() < k.2 => {
                wrong.push(format!("{name}: the circle of {} has only {} members: say so here", k.1, circle.len()))
            }
            Some(_) => {}
        }
    }
    let gone = known.iter().filter(|k| !found.iter().any(|circle| is_in(circle, k.1)));
    wrong.extend(gone.map(|k| format!("{name}: the circle of {} is gone: take it off the list", k.1)));
    wrong
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

/// An element is one file, one row, one chapter: the row has its chapter in the book, its table and its functions in the reference in both languages, and a
/// chapter with a model of it.
#[test]
fn every_row_of_elements_has_its_pages() {
    let pages = |ending: &str| -> String {
        let files = fs::read_dir(root().join("docs/model-file")).expect("the reference").map(|e| e.expect("an entry").path());
        let of_language = |f: &PathBuf| f.to_string_lossy().ends_with(".ru.md") == (ending == ".ru.md");
        files.filter(of_language).map(|f| read(&f)).collect()
    };
    let reference = [".md", ".ru.md"].map(pages);
    for row in mechanics::elements::TABLE {
        let name = row.keys.name;
        let chapter = root().join("tests/book").join(row.chapter).with_extension("md");
        assert!(read(&chapter).contains(&format!("[{name}.")), "{} has no model with [{name}.NAME]", chapter.display());
        assert!(root().join(format!("crates/mechanics/src/elements/{name}.rs")).exists(), "{name} has no file of its own");
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
        for ending in [".md", ".ru.md"] {
            let pages = ["connections", "contacts"].map(|page| read(&root().join("docs/model-file").join(format!("{page}{ending}"))));
            for table in std::iter::once(&row.keys).chain(row.within) {
                let heading = if table.name == name { format!("[{name}.") } else { format!("`{}`", table.name) };
                assert!(pages.iter().any(|page| page.contains(&heading)), "the reference lacks {heading}");
            }
        }
    }
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

/// Every file of the library begins with what it is.
#[test]
fn every_file_says_what_it_is() {
    for name in STREET {
        let crate_ = root().join("crates").join(name).join("src");
        let mut folders = vec![crate_];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(&folder).expect("a folder").map(|e| e.expect("an entry").path()) {
                if entry.is_dir() {
                    folders.push(entry);
                } else if entry.extension().is_some_and(|e| e == "rs") {
                    assert!(read(&entry).starts_with("//! "), "{} does not say what it is", entry.display());
                }
            }
        }
    }
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

/// Whether a line of a test compares with a bare small number: `< 1e-9`, `<= 2.5e-12`.
fn compares_barely(line: &str) -> bool {
    let small = |text: &str| {
        let number = text.trim_start_matches("= ").trim_start();
        let length = number.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(number.len());
        length > 0 && number[length..].starts_with("e-")
    };
    !line.contains("const ") && line.match_indices("< ").chain(line.match_indices("<= ")).any(|(i, m)| small(&line[i + m.len()..]))
}

/// A tolerance says where its size comes from: a constant with a sentence, or a remark.
#[test]
fn tolerances_of_tests_have_reasons() {
    let mut found = Vec::new();
    for name in STREET {
        let mut folders = vec![root().join("crates").join(name).join("src"), root().join("crates").join(name).join("tests")];
        while let Some(folder) = folders.pop() {
            let Ok(entries) = fs::read_dir(&folder) else { continue };
            for entry in entries.map(|e| e.expect("an entry").path()) {
                if entry.is_dir() {
                    folders.push(entry);
                } else if entry.extension().is_some_and(|e| e == "rs") {
                    found.extend(bare_comparisons(&entry));
                }
            }
        }
    }
    assert!(found.is_empty(), "{} tolerances without a reason:\n{}", found.len(), found.join("\n"));
}

/// Lines of the tests of a file that compare with a bare small number and have no remark.
fn bare_comparisons(file: &Path) -> Vec<String> {
    let text = read(file);
    let inside = file.components().any(|part| part.as_os_str() == "tests") || file.ends_with("tests.rs");
    let from = if inside { 0 } else { text.find("#[cfg(test)]").unwrap_or(text.len()) };
    let first = text[..from].lines().count();
    let lines: Vec<&str> = text[from..].lines().collect();
    let remarked = |i: usize| lines[i].contains("//") || i > 0 && lines[i - 1].trim_start().starts_with("//");
    let found = (0..lines.len()).filter(|&i| compares_barely(lines[i]) && !remarked(i));
    found.map(|i| format!("{}:{}: {}", file.display(), first + i + 1, lines[i].trim())).collect()
}
