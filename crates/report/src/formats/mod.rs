//! The table of formats: one file and one row each. A row says what the format can hold and how it is written; whoever has something to show
//! asks the row and never the name.

pub mod csv;
pub mod docx;
mod fit;
pub mod html;
pub mod json;
pub mod latex;
pub mod markdown;
mod paper;
mod row;
mod signs;
pub mod text;
pub mod typst;

pub use row::{Drawing, Format, Holds, Package, Page, Pictures, Press, Sheet, Table, Tree};
pub(crate) use row::{RASTER, VECTOR};

/// Every format; the first is that of the terminal.
pub const TABLE: [Format; 8] =
    [text::FORMAT, html::FORMAT, markdown::FORMAT, latex::FORMAT, typst::FORMAT, docx::FORMAT, csv::FORMAT, json::FORMAT];

/// The row of a name.
pub fn find(name: &str) -> Option<&'static Format> {
    const { &TABLE }.iter().find(|format| format.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_has_its_name_and_its_help_in_both_languages() {
        for format in &TABLE {
            assert_eq!(find(format.name).map(|f| f.extension), Some(format.extension));
            assert_eq!(TABLE.iter().filter(|f| f.name == format.name).count(), 1, "{}", format.name);
            let (en, ru) = format.help;
            assert!(!en.is_empty() && ru.chars().any(|c| ('а'..='я').contains(&c)), "{}", format.name);
        }
    }
}
