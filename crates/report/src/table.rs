//! Tables: columns with heads, cells, and the alignment on the decimal mark that both writers share.

use crate::number::Format;
use crate::rich::Rich;
use crate::unit;
use words::Language;

/// A table. All rows have as many cells as there are columns; missing cells are empty.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// Words behind "Table N – "; none for a table without number.
    pub caption: Option<String>,
    /// Heads.
    pub columns: Vec<Column>,
    /// Rows of cells.
    pub rows: Vec<Vec<Cell>>,
}

/// Head of a column.
#[derive(Clone, Debug, Default)]
pub struct Column {
    /// What stands in the column.
    pub head: Rich,
    /// Unit in print, shown behind a comma; empty for none.
    pub unit: String,
}

impl Column {
    /// A column without unit.
    pub fn new(head: impl Into<Rich>) -> Column {
        Column { head: head.into(), unit: String::new() }
    }

    /// A column of numbers in a unit given by its ASCII label.
    pub fn with_unit(head: impl Into<Rich>, label: &str, language: Language) -> Column {
        Column { head: head.into(), unit: unit::print(label, language) }
    }
}

/// A cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// Nothing.
    Empty,
    /// Words, symbols, formulas; set from the left.
    Rich(Rich),
    /// A number in print, aligned on its decimal mark.
    Number(String),
    /// Whether a check was passed.
    Verdict(Verdict),
}

/// The outcome of a check.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// What was found is within what is allowed.
    Passed,
    /// It is not.
    Failed,
}

impl Verdict {
    /// The outcome of an audit.
    pub fn of(audit: &analysis::dataset::Audit) -> Verdict {
        if audit.ok { Verdict::Passed } else { Verdict::Failed }
    }
}

impl Cell {
    /// Words.
    pub fn words(words: impl Into<String>) -> Cell {
        Cell::Rich(Rich::from(words.into()))
    }

    /// A name of the model, shown as a symbol.
    pub fn symbol(name: impl Into<String>) -> Cell {
        Cell::Rich(Rich::symbol(name))
    }

    /// A number by itself with this many significant digits.
    pub fn number(x: f64, digits: usize, language: Language) -> Cell {
        Cell::Number(Format::Significant(digits).show(x, language))
    }

    /// The cells of a whole column, with equal decimals.
    pub fn column(values: &[f64], digits: usize, language: Language) -> Vec<Cell> {
        let format = Format::of_column(values, digits);
        values.iter().map(|&x| Cell::Number(format.show(x, language))).collect()
    }

    /// The same for a column whose values are quantities of their own, frequencies of a machine say: one that is small beside the largest has its own digits.
    pub fn column_apart(values: &[f64], digits: usize, language: Language) -> Vec<Cell> {
        let format = Format::of_column(values, digits);
        let largest = values.iter().filter(|x| x.is_finite()).fold(0.0_f64, |m, x| m.max(x.abs()));
        let own = |x: f64| if x != 0.0 && x.abs() < APART * largest { Format::Significant(digits) } else { format };
        values.iter().map(|&x| Cell::Number(own(x).show(x, language))).collect()
    }

    /// The same for a column whose signs decide: a value that these decimals would show as zero stands with its own first digits.
    pub fn column_of_signs(values: &[f64], digits: usize, language: Language) -> Vec<Cell> {
        let format = Format::of_column(values, digits);
        let zero = format.show(0.0, language);
        let rounding = ROUNDING * values.iter().filter(|x| x.is_finite()).fold(0.0_f64, |m, x| m.max(x.abs()));
        let shown = |x: f64| match format.show(x, language) {
            lost if x.abs() > rounding && lost == zero => Format::Significant(SIGN_DIGITS).show(x, language),
            shown => shown,
        };
        values.iter().map(|&x| Cell::Number(shown(x))).collect()
    }
}

/// Share of the largest value of a column below which equal decimals leave less than half of six digits.
const APART: f64 = 1e-3;
/// Digits of a number that is shown for its sign.
const SIGN_DIGITS: usize = 2;
/// Share of the largest value of a column below which a sign is that of rounding.
const ROUNDING: f64 = 1e-12;

impl Table {
    /// An empty table with these columns.
    pub fn new(columns: Vec<Column>) -> Table {
        Table { caption: None, columns, rows: Vec::new() }
    }

    /// The same table with a caption.
    pub fn with_caption(mut self, caption: impl Into<String>) -> Table {
        self.caption = Some(caption.into());
        self
    }

    /// Adds a row.
    pub fn row(&mut self, cells: Vec<Cell>) {
        self.rows.push(cells);
    }

    /// Characters before and behind the decimal mark that the numbers of a column need; the mark counts as behind.
    pub fn number_width(&self, i_column: usize) -> (usize, usize) {
        let numbers = self.rows.iter().filter_map(|row| match row.get(i_column) {
            Some(Cell::Number(number)) => Some(split_number(number)),
            _ => None,
        });
        numbers.fold((0, 0), |(w, d), (whole, decimals)| (w.max(whole.chars().count()), d.max(decimals.chars().count())))
    }
}

/// A printed number cut before its decimal mark, or before its power of ten when it has no mark.
pub fn split_number(number: &str) -> (&str, &str) {
    number.split_at(number.find([',', '.', '·']).unwrap_or(number.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sign_that_decides_is_never_rounded_away() {
        let shown = |cells: Vec<Cell>| -> Vec<String> {
            cells.into_iter().map(|c| if let Cell::Number(n) = c { n } else { String::new() }).collect()
        };
        assert_eq!(shown(Cell::column_of_signs(&[12.5, -4.529e-5, 0.0], 4, Language::En)), ["12.50", "−4.5·10⁻⁵", "0.00"]);
        assert_eq!(shown(Cell::column(&[12.5, -4.529e-5], 4, Language::En)), ["12.50", "0.00"]);
    }
}
