//! Who imports whom in a crate, and the circles of that.

use super::{read, root};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// The path of a module, `["derive", "loads"]`; empty for the crate's root.
pub type Module = Vec<String>;

/// Which imports of a file are meant.
#[derive(Clone, Copy, PartialEq)]
pub enum Which {
    All,
    /// Those that the file hands on.
    HandedOn,
}

/// Imports of the files of one crate.
pub struct Crate {
    /// What each file says, without comments and tests.
    pub files: BTreeMap<Module, String>,
    /// Names that a module hands on, and what they are.
    pub handed: BTreeMap<Module, BTreeMap<String, Module>>,
}

impl Crate {
    pub fn open(name: &str) -> Crate {
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
    pub fn imports(&self, from: &Module, which: Which) -> Vec<(Module, String)> {
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

    pub fn arrows(&self) -> BTreeSet<(Module, Module)> {
        let of = |from: &Module| {
            let imported = self.imports(from, Which::All).into_iter().map(|(path, _)| path);
            let to: Vec<Module> = imported.chain(self.mentions(from)).filter_map(|path| self.home(&path, 0)).collect();
            to.into_iter().filter(|to| to != from).map(|to| (from.clone(), to)).collect::<Vec<_>>()
        };
        self.files.keys().flat_map(of).collect()
    }
}

pub fn module(source: &Path, file: &Path) -> Module {
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
pub fn bare(text: &str) -> String {
    // a single item for tests hides nothing behind it
    let text = &text[..text.find("#[cfg(test)]\nmod tests {").unwrap_or(text.len())];
    text.lines().map(|line| line.find("//").map_or(line, |i| &line[..i])).collect::<Vec<_>>().join("\n")
}

/// Without `use ...;`, over one line or several.
pub fn without_imports(text: &str) -> String {
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
pub fn leaves(tree: &str) -> Vec<(Module, String)> {
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
pub fn circles(arrows: &BTreeSet<(Module, Module)>) -> Vec<BTreeSet<Module>> {
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
pub fn circles_of_folders(house: &Crate, arrows: &BTreeSet<(Module, Module)>) -> Vec<BTreeSet<Module>> {
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
pub fn hold(name: &str, found: &[BTreeSet<Module>], known: &[(&str, &str, usize)]) -> Vec<String> {
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
