//! TOML: parsing with recovery, and its errors in our words.

use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};
use words::{Notice, Text};

pub(crate) type Table<'a> = DeTable<'a>;
pub(crate) type Value<'a> = Spanned<DeValue<'a>>;

/// Findings that a lost line of the file would cause: not reported when the file has syntax errors.
pub(crate) const FOLLOW_UPS: [&str; 12] = ["M006", "M013", "M014", "M015", "M025", "M041", "M057", "M059", "M062", "M066", "M081", "M082"];

/// Most parts of a dotted key.
const MAX_KEY_PARTS: usize = 32;

/// The table of a file as far as it can be read, and the syntax errors. No table when reading on would be unsafe.
pub(crate) fn parse(text: &str) -> (Option<DeTable<'_>>, Vec<Notice>) {
    if let Some(at) = deep_key(text) {
        let d = Notice::file(
            "M009",
            boundaries(text, at..at + 1),
            Text::new(format!("a key has more than {MAX_KEY_PARTS} parts"), format!("в ключе больше {MAX_KEY_PARTS} частей")),
        );
        return (None, vec![d]);
    }
    let (root, errors) = DeTable::parse_recoverable(text);
    let mut findings: Vec<Notice> = Vec::new();
    let mut lines: Vec<usize> = Vec::new();
    for error in errors.iter().take(1000) {
        let span = boundaries(text, error.span().unwrap_or(text.len()..text.len()));
        let start = text[..span.start].rfind('\n').map_or(0, |i| i + 1);
        let first_of_line = lines.last() != Some(&start);
        lines.push(start);
        if let Some(key) = bare_key(text, start) {
            if first_of_line {
                findings.push(unquoted(text, key));
            }
        } else if first_of_line || error.message().contains("duplicate") {
            findings.push(translate(text, span, error.message()));
        }
    }
    (Some(root.into_inner()), findings)
}

/// The place of a key with too many parts: nested tables that deep would exhaust the stack when dropped.
fn deep_key(text: &str) -> Option<usize> {
    let mut parts = 0;
    let mut quote: Option<u8> = None;
    for (i, b) in text.bytes().enumerate() {
        match (quote, b) {
            (Some(q), b) if b == q || b == b'\n' => quote = None,
            (Some(_), _) => {}
            (None, b'"' | b'\'') => quote = Some(b),
            (None, b'.') => parts += 1,
            (None, b'=' | b',' | b'\n' | b'[' | b']' | b'{' | b'}' | b'#') => parts = 0,
            _ => {}
        }
        // a text over several lines may look like a key; nobody writes this many points in one either
        if parts > MAX_KEY_PARTS {
            return Some(i);
        }
    }
    None
}

/// The key at the start of a line when it is written with letters that TOML wants quoted.
fn bare_key(text: &str, start: usize) -> Option<Range<usize>> {
    let line = text[start..].lines().next().unwrap_or_default();
    let head = match line.trim_start().strip_prefix('[') {
        Some(header) => header.trim_start_matches('[').split(']').next()?,
        None => line.split_once('=')?.0,
    };
    if head.contains(['"', '\'', '#', '{']) {
        return None;
    }
    for part in head.split('.') {
        let part = part.trim();
        if !part.is_ascii() && part.chars().all(|c| c.is_alphanumeric() || "_-'".contains(c)) {
            let from = part.as_ptr() as usize - text.as_ptr() as usize;
            return Some(from..from + part.len());
        }
    }
    None
}

fn unquoted(text: &str, key: Range<usize>) -> Notice {
    let name = &text[key.clone()];
    Notice::file("M003", key.clone(), Text::new(format!("the key `{name}` needs quotes"), format!("ключ `{name}` нужно взять в кавычки")))
        .why(
            "TOML allows only Latin letters, digits, - and _ in keys without quotes",
            "без кавычек TOML допускает в ключах только латинские буквы, цифры, - и _",
        )
        .help(format!("write \"{name}\""), format!("напишите \"{name}\""))
}

fn translate(text: &str, span: Range<usize>, message: &str) -> Notice {
    if message.contains("duplicate key") {
        let key = text.get(span.clone()).unwrap_or_default().to_owned();
        return Notice::file("M004", span, Text::new(format!("`{key}` is given twice"), format!("`{key}` задано дважды")))
            .help("remove or rename one of them", "удалите или переименуйте одно из двух");
    }
    let span = if span.is_empty() { visible(text, span.start) } else { span };
    let ru = super::toml_words::russian(message);
    let found = Notice::file("M002", span, Text::new(format!("TOML: {message}"), format!("TOML: {ru}")));
    if message.contains("recursion") {
        return found;
    }
    if message.contains("string values must be quoted") || message.contains("invalid") {
        return found.help(
            "quantities and formulas are strings in quotes: mass = \"20 g\"",
            "величины и формулы — строки в кавычках: mass = \"20 g\"",
        );
    }
    found
}

/// The range widened to whole characters and cut to the text.
pub(crate) fn boundaries(text: &str, span: Range<usize>) -> Range<usize> {
    let mut start = span.start.min(text.len());
    let mut end = span.end.clamp(start, text.len());
    while !text.is_char_boundary(start) {
        start -= 1;
    }
    while !text.is_char_boundary(end) {
        end += 1;
    }
    start..end
}

/// The character at or before a place, so that there is something to point at.
fn visible(text: &str, at: usize) -> Range<usize> {
    match text[at..].chars().next().filter(|c| *c != '\n' && *c != '\r') {
        Some(c) => at..at + c.len_utf8(),
        None => {
            let start = text[..at].char_indices().next_back().map_or(at, |(i, _)| i);
            if text[start..].starts_with(['\n', '\r']) { at..at } else { start..at }
        }
    }
}
