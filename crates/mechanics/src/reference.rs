//! The reference of the model file, generated from the tables of fields: `docs/model-file.md`, an index, and `docs/model-file/`, a page
//! a chapter; each in two languages.

mod formulas;
mod index;
mod link;
mod tables;

use crate::asked::Kinds;
use crate::fields::{self, Chapter, Words};
use link::{INDEX, file, heading, pick};
use std::fmt::Write;
use words::Language;

/// A page of the reference.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Page {
    /// Its path below `docs`.
    pub path: String,
    /// Markdown.
    pub text: String,
}

/// Every page, with the studies of these kinds: the index first, then the chapters.
pub fn pages(language: Language, studies: &Kinds) -> Vec<Page> {
    let mut pages = vec![Page { path: format!("{INDEX}{}", link::ending(language)), text: index::text(language, studies) }];
    pages.extend(fields::CHAPTERS.iter().map(|chapter| of_tables(chapter, studies, language)));
    pages.extend(formulas::CHAPTERS.iter().map(|chapter| of_formulas(chapter, language)));
    pages
}

fn of_tables(chapter: &Chapter, studies: &Kinds, language: Language) -> Page {
    let mut text = head(chapter.file, chapter.title, chapter.about, language);
    for table in chapter.tables {
        let _ = writeln!(text, "## {}\n", heading(table, language));
        tables::section(&mut text, table, language);
        if table.name == "study" {
            tables::kinds(&mut text, studies, language);
        }
    }
    page(chapter.file, text, language)
}

fn of_formulas(chapter: &formulas::Chapter, language: Language) -> Page {
    let mut text = head(chapter.file, chapter.title, chapter.about, language);
    (chapter.write)(&mut text, language);
    page(chapter.file, text, language)
}

/// Title, the way back and to the other language, what it is about.
fn head(name: &str, title: Words, about: Words, language: Language) -> String {
    let (index, other) = (format!("../{INDEX}{}", link::ending(language)), language.pick(Language::Ru, Language::En));
    let (back, across) = language.pick(("The model file", "По-русски"), ("Файл модели", "In English"));
    let (title, about) = (pick(language, title), pick(language, about));
    format!("# {title}\n\n[{back}]({index}) · [{across}]({})\n\n{about}\n\n", file(name, other))
}

fn page(name: &str, text: String, language: Language) -> Page {
    Page { path: format!("{INDEX}/{}", file(name, language)), text: format!("{}\n", text.trim_end()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whole(language: Language) -> String {
        pages(language, &Kinds::new(Vec::new(), Vec::new())).into_iter().map(|p| p.text).collect()
    }

    #[test]
    fn every_key_unit_and_function_is_in_both_references() {
        for language in [Language::En, Language::Ru] {
            let text = whole(language);
            for table in fields::all() {
                let known = |key: &str| text.contains(&format!("| `{key}` |")) || text.contains(&format!("| [`{key}`]("));
                assert!(table.fields.iter().all(|f| known(f.key)), "{}", table.name);
            }
            assert!(text.contains("`rpm`") && text.contains("`кгс`") && text.contains("`vx(A)`"));
        }
    }

    #[test]
    fn units_are_written_in_the_letters_of_the_language() {
        let text = whole(Language::Ru);
        for piece in ["| м/с² |", "| кг·м² |", "| Н·с/м |", "| время |", "0,001 кг", "π/30 рад/с", "| 0,01 |"] {
            assert!(text.contains(piece), "{piece}");
        }
        let chapters = pages(Language::Ru, &Kinds::new(Vec::new(), Vec::new())).into_iter().skip(1).map(|p| p.text).collect::<String>();
        let tables: String = chapters.lines().filter(|l| l.starts_with("| `")).filter_map(|l| l.split('|').nth(3)).collect();
        assert!(!tables.chars().any(|c| c.is_ascii_alphabetic()), "{tables}");
    }

    #[test]
    fn every_table_that_the_top_level_names_has_a_section() {
        let inside = |name: &str| fields::all().any(|t| t.name == name);
        // the keys of these two are names of the file
        let free = ["unknowns", "impending"];
        for field in fields::TOP.fields.iter().filter(|f| matches!(f.ty, fields::Type::Table | fields::Type::Array)) {
            assert!(inside(field.key) || free.contains(&field.key), "{} has no chapter", field.key);
        }
    }
}
