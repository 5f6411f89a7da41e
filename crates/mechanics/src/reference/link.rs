//! Headings of tables and the links to them.

use crate::fields::{CHAPTERS, Chapter, TableSpec, Words};
use words::Language;

/// Name of the index and of the folder of the chapters.
pub const INDEX: &str = "model-file";

/// A word in a language.
pub fn pick(language: Language, words: Words) -> &'static str {
    language.pick(words.0, words.1)
}

/// Ending of the files of a language.
pub fn ending(language: Language) -> &'static str {
    language.pick(".md", ".ru.md")
}

/// File of a chapter.
pub fn file(name: &str, language: Language) -> String {
    format!("{name}{}", ending(language))
}

/// Heading of a table: as it is written in a model file.
pub fn heading(table: &TableSpec, language: Language) -> String {
    let name = table.name;
    match name {
        "" => pick(language, ("Top level", "Верхний уровень")).to_owned(),
        "text" => pick(language, ("Text in two languages", "Текст на двух языках")).to_owned(),
        "study" | "phases" | "claims" | "answers" => format!("`[[{name}]]`"),
        "parameters" | "coordinates" | "points" | "outputs" | "regimes" | "variants" | "report" | "structure" => format!("`[{name}]`"),
        "inertia" | "plot" | "wound" | "circle" | "parts" => format!("{} `{name}`", pick(language, ("Table", "Таблица"))),
        _ => format!("`[{name}.{}]`", pick(language, ("NAME", "ИМЯ"))),
    }
}

/// Path of the section of a table from the folder of the chapters: `bodies.md#bodiesname`.
pub fn path(place: &Place, language: Language) -> String {
    format!("{}#{}", file(place.chapter.file, language), slug(&heading(place.table, language)))
}

/// A table in its chapter.
#[derive(Clone, Copy)]
pub struct Place {
    pub chapter: &'static Chapter,
    pub table: &'static TableSpec,
}

/// Every table, in the order of the reference.
pub fn places() -> impl Iterator<Item = Place> {
    CHAPTERS.iter().flat_map(|chapter| chapter.tables.iter().map(move |table| Place { chapter, table }))
}

/// Anchor that Markdown viewers give a heading.
fn slug(heading: &str) -> String {
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c }).flat_map(char::to_lowercase).collect()
}
