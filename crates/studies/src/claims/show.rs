//! The table of claims, and their JSON.

use super::verdict::Verdict;
use crate::results::{Results, Show, View, events};
use report::table::Column;
use report::{Block, Cell, Table};
use serde_json::{Value, json};
use words::Language;

const DIGITS: usize = 7;

/// All claims of a file, told by a table.
#[derive(Debug)]
pub struct Verdicts(pub Vec<Verdict>);

impl Show for Verdicts {
    fn blocks(&self, results: &Results, view: &View) -> Vec<Block> {
        let language = view.language;
        let table = table(&self.0, language);
        let table = if view.is_page() { table.with_caption(language.text(&results.heading)) } else { table };
        let mut blocks: Vec<Block> = results.words.iter().map(|words| Block::paragraph(language.text(words))).collect();
        blocks.push(Block::Table(table));
        blocks.extend(events::notes(&results.data, language));
        blocks
    }
}

/// A row a claim: name and source, what is published, what strutt finds, the deviation, whether it holds.
fn table(verdicts: &[Verdict], language: Language) -> Table {
    let heads = match language {
        Language::En => ["Claim", "Published", "Found", "Unit", "Deviation", "Verdict"],
        Language::Ru => ["Результат", "Опубликовано", "Найдено", "Ед.", "Расхождение", "Вывод"],
    };
    let mut table = Table::new(heads.map(Column::new).into());
    let number = |x: f64| if x.is_finite() { Cell::number(x, DIGITS, language) } else { Cell::Empty };
    for v in verdicts {
        let source = language.text(&v.source);
        let name = language.text(&v.name);
        let name = if source.is_empty() { name.to_owned() } else { format!("{name} ({source})") };
        let unit = Cell::words(report::unit::print(&v.unit, language));
        let deviation = if v.deviation.is_finite() { Cell::words(report::number::short(v.deviation, 2, language)) } else { Cell::Empty };
        table.row(vec![Cell::words(name), number(v.published), number(v.value), unit, deviation, Cell::words(holds(v, language))]);
    }
    table
}

/// Whether the machine confirms what is published.
fn holds(verdict: &Verdict, language: Language) -> &'static str {
    match verdict.ok {
        true => language.pick("✓ confirmed", "✓ подтверждено"),
        false => language.pick("✗ not confirmed", "✗ не подтверждено"),
    }
}

/// `[{name, value, published, deviation, ok}]`, with source, unit and the words on what differs.
pub fn to_json(verdicts: &[Verdict]) -> Value {
    let finite = |x: f64| x.is_finite().then_some(x);
    let one = |v: &Verdict| {
        json!({"name": v.name.en, "source": v.source.en, "unit": v.unit, "value": finite(v.value), "published": finite(v.published),
            "deviation": finite(v.deviation), "ok": v.ok, "differs": v.words.en})
    };
    verdicts.iter().map(one).collect()
}
