//! What a study found, in a form that the terminal, the page, CSV and JSON all understand.

use crate::document;
use analysis::{Dataset, Quantity};
use mechanics::model::Plot;
use report::figure::Pen;
use report::table::Column;
use report::{Block, Cell, Figure, Table, Word};
use serde_json::{Map, Value, json};
use words::{Language, Notice, Text};

/// Significant digits of a fact: it stands alone and is compared.
const DIGITS: usize = 8;
/// Significant digits in tables.
const TABLE_DIGITS: usize = 6;
/// Rows of a table that are shown; all are in the files.
const ROWS: usize = 60;

/// A single number that a study found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fact {
    /// Name in JSON, symbol, unit, what it is.
    pub quantity: Quantity,
    /// The number, SI.
    pub value: f64,
    /// Words in its place or behind it.
    pub words: Text,
}

impl Fact {
    /// A number with its name in files, symbol, unit and meaning.
    pub fn new(name: &str, symbol: &str, unit: &str, value: f64, label: Text) -> Fact {
        let quantity = Quantity { symbol: symbol.into(), label, ..Quantity::new(name, unit) };
        Fact { quantity, value, words: Text::default() }
    }
    /// The same with words.
    pub fn with_words(mut self, words: Text) -> Fact {
        self.words = words;
        self
    }
}

/// How the columns are shown on terminal and page.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rows {
    /// Least and largest of each column.
    #[default]
    Summary,
    /// Row by row.
    All,
    /// Not at all: the facts say everything.
    Hidden,
}

/// What a study found.
#[derive(Clone, Debug, Default)]
pub struct Results {
    /// Name of the study: `periodic`. Also the stem of its files.
    pub kind: &'static str,
    /// Heading of its section.
    pub heading: Text,
    /// Single numbers.
    pub facts: Vec<Fact>,
    /// Paragraphs, before the tables.
    pub words: Vec<Text>,
    /// Columns, audits, events.
    pub data: Dataset,
    /// How the columns are shown.
    pub rows: Rows,
    /// Fields of JSON besides the facts.
    pub own: Map<String, Value>,
    /// Published results, when these are the study.
    pub claims: Vec<crate::claims::Verdict>,
    /// Plots.
    pub plots: Vec<Plot>,
    /// How their points are joined.
    pub pen: Pen,
    /// What ended the study early.
    pub trouble: Option<Notice>,
}

impl Results {
    /// The fields of JSON that are not common to all studies.
    pub fn fields(&self) -> Map<String, Value> {
        let mut fields = Map::new();
        fields.insert("study".into(), json!(self.kind));
        for fact in &self.facts {
            fields.insert(fact.quantity.name.clone(), json!(fact.value));
        }
        fields.extend(self.own.clone());
        fields
    }

    /// The single numbers as a table.
    pub fn facts_table(&self, language: Language) -> Option<Table> {
        let shown: Vec<&Fact> = self.facts.iter().filter(|f| !f.quantity.label.en.is_empty()).collect();
        if shown.is_empty() {
            return None;
        }
        let heads = [Word::Symbol, Word::Value, Word::Unit, Word::Description];
        let mut table = Table::new(heads.map(|w| Column::new(language.word(w))).into());
        for fact in shown {
            let words = language.text(&fact.words);
            let label = language.text(&fact.quantity.label);
            let label = if words.is_empty() { label.to_owned() } else { format!("{label}: {words}") };
            let number = if fact.value.is_nan() { Cell::Empty } else { Cell::number(fact.value, DIGITS, language) };
            table.row(vec![
                Cell::symbol(&fact.quantity.symbol),
                number,
                Cell::words(report::unit::print(&fact.quantity.unit, language)),
                Cell::words(label),
            ]);
        }
        Some(table)
    }

    /// The columns as a table.
    pub fn columns_table(&self, language: Language) -> Option<Table> {
        match self.rows {
            _ if self.data.columns.is_empty() => None,
            Rows::Hidden => None,
            Rows::Summary => Some(document::results(&self.data, language)),
            Rows::All => Some(row_by_row(&self.data, language)),
        }
    }

    /// Everything but plots.
    pub fn blocks(&self, captions: bool, language: Language) -> Vec<Block> {
        let title = language.text(&self.heading);
        let mut blocks = vec![Block::heading(1, title)];
        blocks.extend(self.words.iter().map(|words| Block::paragraph(language.text(words))));
        let captioned = |table: Table, caption: &str| Block::Table(if captions { table.with_caption(caption) } else { table });
        if !self.claims.is_empty() {
            blocks.push(captioned(crate::claims::table(&self.claims, language), title));
        }
        blocks.extend(self.facts_table(language).map(|table| captioned(table, title)));
        blocks.extend(self.columns_table(language).map(|table| captioned(table, language.word(Word::Results))));
        blocks
    }

    /// The plots that the file asks for.
    pub fn figures(&self, language: Language) -> Vec<Figure> {
        let mut figures = document::plots(&self.plots, &self.data, language);
        figures.iter_mut().flat_map(|figure| &mut figure.series).for_each(|series| series.pen = self.pen);
        figures
    }
}

/// All columns side by side.
fn row_by_row(data: &Dataset, language: Language) -> Table {
    let mut columns = Vec::new();
    let mut cells: Vec<Vec<Cell>> = Vec::new();
    let count = data.columns.iter().map(|c| c.values.len()).max().unwrap_or(0);
    let shown = count.min(ROWS);
    for column in &data.columns {
        let values = &column.values[..shown.min(column.values.len())];
        let largest = values.iter().filter(|v| v.is_finite()).fold(0.0_f64, |m, v| m.max(v.abs()));
        let scale = document::scale(&column.quantity, largest);
        let scaled: Vec<f64> = values.iter().map(|v| v / scale.size).collect();
        columns.push(Column::with_unit(report::document::Rich::symbol(&column.quantity.symbol), &scale.label, language));
        let finite: Vec<f64> = scaled.iter().copied().filter(|v| v.is_finite()).collect();
        let mut printed = Cell::column(&finite, TABLE_DIGITS, language).into_iter();
        cells.push(scaled.iter().map(|v| if v.is_finite() { printed.next().unwrap_or(Cell::Empty) } else { Cell::Empty }).collect());
    }
    let mut table = Table::new(columns);
    for row in 0..shown {
        table.row(cells.iter().map(|column| column.get(row).cloned().unwrap_or(Cell::Empty)).collect());
    }
    table
}
