//! Numbers have reasons.

use super::{STREET, read, root};
use std::fs;
use std::path::Path;

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

/// Thresholds of the sources that stand bare in a line: what is left of them. One more fails, one fewer asks for a smaller number here.
const UNEXPLAINED: usize = 0;

/// A threshold of the sources (a literal like 1e-9) is a constant with a sentence, or has a remark on its line or above it.
#[test]
fn thresholds_have_reasons() {
    let mut found = Vec::new();
    for name in STREET {
        let mut folders = vec![root().join("crates").join(name).join("src")];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(&folder).expect("a folder").map(|e| e.expect("an entry").path()) {
                if entry.is_dir() {
                    folders.push(entry);
                } else if entry.extension().is_some_and(|e| e == "rs") {
                    found.extend(bare_thresholds(&entry));
                }
            }
        }
    }
    found.sort();
    assert!(found.len() == UNEXPLAINED, "{} thresholds without a reason, {UNEXPLAINED} are known:\n{}", found.len(), found.join("\n"));
}

/// Lines of a file outside its tests with a small number that nobody explains.
fn bare_thresholds(file: &Path) -> Vec<String> {
    if file.components().any(|part| part.as_os_str() == "tests") || file.ends_with("tests.rs") {
        return Vec::new();
    }
    let text = read(file);
    let text = &text[..text.find("#[cfg(test)]\nmod tests {").unwrap_or(text.len())];
    let lines: Vec<&str> = text.lines().collect();
    let remark = |line: &str| line.trim_start().starts_with("//");
    let above = |i: usize| i > 0 && remark(lines[i - 1]);
    let inside_words = |i: usize| i > 0 && lines[i - 1].ends_with('\\');
    let bare = |i: &usize| has_threshold(lines[*i]) && !inside_words(*i) && !lines[*i].contains("// ") && !above(*i);
    let found = (0..lines.len()).filter(bare);
    found.map(|i| format!("{}:{}: {}", file.display(), i + 1, lines[i].trim())).collect()
}

/// Whether code of a line has a number below 1 with an exponent, outside of its strings.
fn has_threshold(line: &str) -> bool {
    let code = line.split("//").next().unwrap_or_default();
    let outside: String = code.split('"').step_by(2).collect::<Vec<_>>().join("\"\"");
    outside.match_indices("e-").any(|(i, _)| {
        let before = outside[..i].trim_end_matches(|c: char| c.is_ascii_digit() || c == '.');
        let digits = &outside[before.len()..i];
        let name = before.ends_with(|c: char| c.is_alphanumeric() || c == '_');
        digits.starts_with(|c: char| c.is_ascii_digit()) && !name && outside[i + 2..].starts_with(|c: char| c.is_ascii_digit())
    })
}

#[test]
fn a_bare_threshold_is_seen() {
    // lines of sources
    assert!(has_threshold("if x < 1e-9 * size {") && has_threshold("clamp(2.5e-12, 1.0)"));
    assert!(!has_threshold("let e = base-1e2;") && !has_threshold("\"1e-15 ... 1e-3\"") && !has_threshold("x // 1e-9"));
}
