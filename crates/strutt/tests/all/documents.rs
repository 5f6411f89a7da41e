//! Documents that follow from the code or from each other stay true.
//!
//! `UPDATE_DOCS=1 cargo test -p strutt --test all documents` writes the generated ones anew.

use crate::common;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn read(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|e| panic!("{path}: {e}"))
}

/// Names of the folders of the gallery.
fn machines() -> Vec<String> {
    let folders = |of: &str| -> Vec<String> {
        let entries = std::fs::read_dir(root().join("gallery").join(of)).expect("the gallery exists").flatten();
        entries.filter(|e| e.path().is_dir()).map(|e| e.file_name().to_string_lossy().into_owned()).collect()
    };
    let courses = folders("courses").into_iter().map(|name| format!("courses/{name}"));
    let mut names: Vec<String> = folders("").into_iter().filter(|name| name != "courses").chain(courses).collect();
    names.sort();
    names
}

/// The pages of the reference; written anew first when `UPDATE_DOCS` asks for it, once for all tests.
fn reference() -> &'static [mechanics::reference::Page] {
    static PAGES: std::sync::OnceLock<Vec<mechanics::reference::Page>> = std::sync::OnceLock::new();
    PAGES.get_or_init(|| {
        let pages: Vec<_> = [words::Language::En, words::Language::Ru]
            .into_iter()
            .flat_map(|language| mechanics::reference::pages(language, studies::kinds()))
            .collect();
        if std::env::var_os("UPDATE_DOCS").is_some() {
            write(&pages);
        }
        pages
    })
}

fn write(pages: &[mechanics::reference::Page]) {
    let docs = root().join("docs");
    let _ = std::fs::remove_dir_all(docs.join("model-file"));
    std::fs::create_dir_all(docs.join("model-file")).expect("docs can be written");
    pages.iter().for_each(|p| std::fs::write(docs.join(&p.path), &p.text).expect("docs can be written"));
}

#[test]
fn model_file_reference_is_the_one_of_the_field_tables() {
    let docs = root().join("docs");
    for page in reference() {
        let written = std::fs::read_to_string(docs.join(&page.path)).unwrap_or_default();
        assert!(written == page.text, "docs/{} is not current: UPDATE_DOCS=1 cargo test -p strutt --test all documents", page.path);
    }
    for file in std::fs::read_dir(docs.join("model-file")).expect("docs/model-file exists").flatten() {
        let name = format!("model-file/{}", file.file_name().to_string_lossy());
        assert!(reference().iter().any(|p| p.path == name), "docs/{name} belongs to no chapter");
    }
}

#[test]
fn every_machine_of_the_gallery_has_its_pages() {
    let list = read("gallery/README.md");
    for name in machines() {
        assert!(root().join("gallery").join(&name).join("model.toml").is_file(), "gallery/{name} has no model.toml");
        assert!(root().join("gallery").join(&name).join("README.md").is_file(), "gallery/{name} has no README.md");
        assert!(list.contains(&format!("({name}/README.md)")), "gallery/README.md does not list {name}");
    }
}

/// Every Markdown file of the repository that is written for readers.
fn documents() -> Vec<PathBuf> {
    reference();
    let mut found = Vec::new();
    let mut folders = vec![root()];
    while let Some(folder) = folders.pop() {
        let mut entries: Vec<PathBuf> = std::fs::read_dir(&folder).expect("folder exists").flatten().map(|e| e.path()).collect();
        entries.sort();
        for path in entries {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if path.is_dir() && !name.starts_with('.') && !["target", "out"].contains(&name.as_str()) {
                folders.push(path);
            } else if name.ends_with(".md") {
                found.push(path);
            }
        }
    }
    found
}

/// The anchors that viewers of Markdown give to headings: letters, digits, `-` and `_` in lower case, spaces as `-`; a number at repetitions.
fn anchors(text: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    let outside = text.split("```").step_by(2).collect::<String>();
    for heading in outside.lines().filter(|l| l.starts_with('#')) {
        let kept = heading.trim_start_matches('#').trim().chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
        let slug = kept.map(|c| if c == ' ' { '-' } else { c }).collect::<String>().to_lowercase();
        let repeated = found.iter().filter(|f| **f == slug || f.strip_prefix(&slug).is_some_and(|r| r.starts_with('-'))).count();
        let taken = found.contains(&slug);
        found.push(if taken { format!("{slug}-{repeated}") } else { slug });
    }
    found
}

/// Why a link from a page leads nowhere.
fn broken(page: &Path, link: &str) -> Option<String> {
    if link.contains("://") || link.contains(' ') {
        return None;
    }
    let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
    let target = if file.is_empty() { page.to_path_buf() } else { page.parent()?.join(file) };
    if !target.exists() {
        return Some(format!("{} -> {link}: no such file", page.display()));
    }
    let known = anchor.is_empty() || std::fs::read_to_string(&target).is_ok_and(|t| anchors(&t).iter().any(|a| a == anchor));
    (!known).then(|| format!("{} -> {link}: no such heading", page.display()))
}

#[test]
fn links_inside_the_repository_lead_somewhere() {
    let mut wrong = Vec::new();
    for page in documents() {
        let text = std::fs::read_to_string(&page).unwrap_or_else(|e| panic!("{}: {e}", page.display()));
        let links = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        wrong.extend(links.filter_map(|link| broken(&page, link)));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn files_that_messages_and_comments_name_exist() {
    reference();
    let mut wrong = Vec::new();
    for source in sources() {
        let text = std::fs::read_to_string(&source).unwrap_or_else(|e| panic!("{}: {e}", source.display()));
        for (start, _) in text.match_indices("docs/") {
            let named: String = text[start..].chars().take_while(|c| c.is_ascii_alphanumeric() || "/-_.".contains(*c)).collect();
            let named = named.trim_end_matches(['.', '/']);
            if named.ends_with(".md") && !root().join(named).is_file() {
                wrong.push(format!("{}: {named}", source.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Every source file of the crates, and the models of the gallery.
fn sources() -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![root().join("crates"), root().join("gallery")];
    while let Some(folder) = folders.pop() {
        for path in std::fs::read_dir(&folder).expect("folder exists").flatten().map(|e| e.path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "rs" || e == "toml") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// Codes in the form of a diagnostic: one of its letters and three digits.
fn codes(text: &str) -> Vec<&str> {
    let starts = text.char_indices().filter(|(_, c)| "MSPC".contains(*c)).map(|(i, _)| i);
    starts.filter_map(|i| code_at(text, i)).collect()
}

fn code_at(text: &str, start: usize) -> Option<&str> {
    let word = |c: char| c.is_alphanumeric() || c == '_';
    let code = text.get(start..start + 4)?;
    let alone = !text[..start].ends_with(word) && !text[start + 4..].starts_with(word);
    (alone && code[1..].chars().all(|c| c.is_ascii_digit())).then_some(code)
}

#[test]
fn every_code_that_is_named_is_explained() {
    let known: Vec<&str> = strutt::explain::all().map(|e| e.code).collect();
    let mut wrong = Vec::new();
    for path in documents().into_iter().chain(sources()) {
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let unknown = codes(&text).into_iter().filter(|c| !known.contains(c));
        wrong.extend(unknown.map(|code| format!("{}: {code}", path.display())));
    }
    assert!(wrong.is_empty(), "codes that `strutt explain` does not know:\n{}", wrong.join("\n"));
}

#[test]
fn every_code_of_a_diagnostic_is_in_the_book() {
    let own = mechanics::elements::TABLE.iter().map(|row| read(&format!("tests/book/{}.md", row.chapter)));
    let errors: String = std::iter::once(read("tests/book/errors.md")).chain(own).collect();
    let missing: Vec<&str> =
        mechanics::explain::TABLES.iter().flat_map(|t| t.iter()).map(|e| e.code).filter(|c| !errors.contains(c)).collect();
    assert!(missing.is_empty(), "the book shows nothing for {}", missing.join(", "));
}

/// The command lines that a text names: what follows `strutt ` after a backtick or a prompt.
fn commands(text: &str) -> Vec<&str> {
    let starts = text.match_indices("strutt ").map(|(i, _)| i).filter(|i| text[..*i].ends_with('`') || text[..*i].ends_with("$ "));
    let lines = starts.map(|i| text[i + "strutt ".len()..].split(['`', '\n']).next().unwrap_or_default());
    // `help` is of the command line itself and has no help of its own
    lines.filter(|line| line.starts_with(|c: char| c.is_ascii_lowercase()) && !line.starts_with("help")).collect()
}

/// What of a command line the program does not know: its verb or an option.
fn unknown<'a>(line: &'a str, helps: &mut BTreeMap<String, Option<String>>) -> Option<&'a str> {
    let verb = line.split(|c: char| !c.is_ascii_lowercase()).next().unwrap_or_default();
    // `variants` has commands of its own
    let words: Vec<&str> = line.split(' ').take(if verb == "variants" { 2 } else { 1 }).collect();
    let words: Vec<&str> =
        words.iter().map(|w| w.trim_end_matches(|c: char| !c.is_ascii_lowercase())).filter(|w| !w.is_empty() && *w != "...").collect();
    let help = helps.entry(words.join(" ")).or_insert_with(|| {
        let output = common::strutt().args(words).arg("--help").output().ok()?;
        output.status.success().then(|| String::from_utf8_lossy(&output.stdout).into_owned())
    });
    let Some(help) = help else { return Some(verb) };
    let options = line.split(' ').filter(|word| word.starts_with("--"));
    let mut names = options.map(|word| word.split(|c: char| c != '-' && !c.is_ascii_lowercase()).next().unwrap_or(word));
    names.find(|name| !help.split_whitespace().any(|word| word.trim_end_matches(',') == *name))
}

#[test]
fn every_command_that_is_named_exists() {
    let mut helps = BTreeMap::new();
    let mut wrong = Vec::new();
    // what has changed may name what is no more
    for path in documents().into_iter().filter(|p| !p.ends_with("CHANGELOG.md")).chain(sources()) {
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let unknown = commands(&text).into_iter().filter_map(|line| unknown(line, &mut helps).map(|what| (line, what)));
        wrong.extend(unknown.map(|(line, what)| format!("{}: `{what}` of `strutt {line}`", path.display())));
    }
    assert!(helps.len() > 8, "commands are found: {:?}", helps.keys());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
