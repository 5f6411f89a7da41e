//! Remarks beside a result, and what happened, when.

use super::contacts;
use super::tables::{DIGITS, scale};
use super::view::Extent;
use crate::wording::{Word as Say, say};
use analysis::Dataset;
use analysis::dataset::Event;
use report::table::Column;
use report::{Block, Cell, Table, Word};
use words::Language;

/// Rows of events that are listed.
const EVENTS: usize = 50;

/// Remarks beside a result.
pub fn notes(data: &Dataset, language: Language) -> Vec<Block> {
    data.notes.iter().map(|note| Block::paragraph(language.text(note))).collect()
}

/// What happened, and when.
pub fn events(data: &Dataset, extent: Extent, language: Language) -> Vec<Block> {
    let mut blocks = named_events(data, extent, language);
    let switches: Vec<&Event> = data.events.iter().filter(|e| e.name.is_empty()).collect();
    if switches.is_empty() {
        return blocks;
    }
    let [time, event] = [Column::with_unit(language.word(Word::Time), "s", language), Column::new(language.word(Word::Event))];
    let listed = &switches[..switches.len().min(EVENTS)];
    // a terminal has no room for columns that say again what the words do
    let with_contacts = extent == Extent::Page && listed.iter().any(|e| e.contact.is_some());
    let mut table = if with_contacts { contacts::table(time, event, listed, language) } else { Table::new(vec![time, event]) };
    let between = if with_contacts { contacts::cells(listed, language) } else { vec![Vec::new(); listed.len()] };
    let times: Vec<f64> = listed.iter().map(|e| e.t).collect();
    for ((time, event), between) in Cell::column(&times, 6, language).into_iter().zip(listed).zip(between) {
        let what = Cell::words(language.text(&event.what));
        table.row(std::iter::once(time).chain(between).chain(std::iter::once(what)).collect());
    }
    blocks.push(Block::Table(if extent == Extent::Page { table.with_caption(language.word(Word::Events)) } else { table }));
    blocks.extend(more_events(switches.len() - listed.len(), language));
    blocks
}

fn more_events(more: usize, language: Language) -> Option<Block> {
    let (en, ru) = (format!("and {more} more events: see the JSON file"), format!("и ещё событий: {more}, см. файл JSON"));
    (more > 0).then(|| Block::paragraph(language.pick(en, ru)))
}

/// The events that the file names, with the quantities at their instants.
fn named_events(data: &Dataset, extent: Extent, language: Language) -> Vec<Block> {
    let named: Vec<&Event> = data.events.iter().filter(|e| !e.name.is_empty()).collect();
    let listed = &named[..named.len().min(EVENTS)];
    if listed.is_empty() {
        return Vec::new();
    }
    let quantities: Vec<_> = data.columns.iter().enumerate().filter(|(i, _)| Some(*i) != data.axis).map(|(_, c)| &c.quantity).collect();
    let mut columns = vec![Column::new(language.word(Word::Event)), Column::with_unit(language.word(Word::Time), "s", language)];
    let times: Vec<f64> = listed.iter().map(|e| e.t).collect();
    let mut cells = vec![Cell::column(&times, 6, language)];
    for (j, quantity) in quantities.iter().enumerate() {
        let values: Vec<f64> = listed.iter().map(|e| e.outputs[1].get(j).copied().unwrap_or(f64::NAN)).collect();
        let scale = scale(quantity, values.iter().fold(0.0, |m: f64, v| m.max(v.abs())));
        columns.push(Column { head: report::document::Rich::symbol(&quantity.symbol), unit: scale.print(language) });
        cells.push(Cell::column(&values.iter().map(|v| v / scale.size).collect::<Vec<_>>(), DIGITS, language));
    }
    let mut table = Table::new(columns);
    for (k, event) in listed.iter().enumerate() {
        let row = std::iter::once(Cell::words(&event.name)).chain(cells.iter().map(|column| column[k].clone()));
        table.row(row.collect());
    }
    let table = Block::Table(if extent == Extent::Page { table.with_caption(say(language, Say::NamedEvents)) } else { table });
    std::iter::once(table).chain(more_events(named.len() - listed.len(), language)).collect()
}
