//! Tables of a closed-form motion: states at the switches, modes.

use analysis::studies::transient::Phase;
use analysis::studies::transient::constants::Listed;
use report::table::Column;
use report::{Cell, Language, Table};
use symbolic::Equations;

/// Digits of states and constants.
const DIGITS: usize = 6;

/// (q, q') at the start of every phase and at the end.
pub fn state_table(equations: &Equations, phases: &[Phase], names: &[String], language: Language) -> Table {
    let mut columns = vec![Column::with_unit("t", "s", language)];
    let outputs = &equations.outputs;
    columns.extend(names.iter().map(|n| {
        let unit = outputs.iter().find(|o| &o.name == n).map_or("", |o| o.unit.as_str());
        Column::with_unit(report::document::Rich::symbol(n.clone()), unit, language)
    }));
    let mut table = Table::new(columns);
    let mut row = |t: f64, state: &[f64]| {
        let mut cells = vec![Cell::number(t, DIGITS, language)];
        cells.extend(state.iter().map(|v| Cell::number(*v, DIGITS, language)));
        table.row(cells);
    };
    phases.iter().for_each(|p| row(p.start, &p.state_at_start));
    if let Some(last) = phases.last() {
        row(last.end, &last.state_at_end);
    }
    table
}

/// One row a mode: frequency, constants, shape.
pub fn mode_table(modes: &[Listed], names: &[String], language: Language) -> Table {
    let single = modes.iter().all(|m| m.forcing.len() <= 1);
    let mut heads = vec![("", ""), ("k", "rad/s"), ("n", "1/s"), ("C1", ""), ("C2", "")];
    if single {
        heads.extend([("h", ""), ("p", "rad/s"), ("D", ""), ("epsilon", "rad")]);
    }
    let mut columns: Vec<Column> =
        heads.into_iter().map(|(name, unit)| Column::with_unit(report::document::Rich::symbol(name), unit, language)).collect();
    columns.extend(names.iter().take(modes.len()).map(|n| Column::new(report::document::Rich::symbol(n.clone()))));
    let mut table = Table::new(columns);
    for (i, mode) in modes.iter().enumerate() {
        let named = mode.named();
        let value = |key: &str| named.iter().find(|(k, _)| *k == key).map(|(_, v)| *v);
        let cell = |key: &str| value(key).map_or(Cell::Empty, |v| Cell::number(v, DIGITS, language));
        let mut cells = vec![Cell::words((i + 1).to_string())];
        let keys = ["k", "n", "C1", "C2", "h", "p", "D", "epsilon"];
        cells.extend(keys.iter().take(if single { 8 } else { 4 }).map(|k| cell(k)));
        cells.extend(mode.mode.shape.iter().map(|s| Cell::number(*s, 4, language)));
        table.row(cells);
    }
    table
}
