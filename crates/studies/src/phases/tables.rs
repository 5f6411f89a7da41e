//! Tables of a closed-form motion: states at the switches, modes.

use analysis::studies::transient::Phase;
use analysis::studies::transient::constants::Listed;
use report::table::Column;
use report::{Cell, Table};
use symbolic::Equations;
use words::Language;

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

/// One row a mode: frequency, damping, constants, displacement under the constant part of its load.
pub fn mode_table(modes: &[Listed], letter: &str, language: Language) -> Table {
    let standing = modes.iter().any(|m| m.standing().is_some());
    let constant = language.pick("st", "ст");
    let mut heads = vec![("i".to_owned(), ""), ("k".into(), "rad/s"), ("n".into(), "1/s"), ("C1".into(), ""), ("C2".into(), "")];
    heads.extend(standing.then(|| (format!("{letter}_{constant}"), "")));
    let mut table = Table::new(columns(heads, language));
    for (i, mode) in modes.iter().enumerate() {
        let (o, c) = (&mode.mode.oscillator, &mode.constants);
        let mut cells = vec![Cell::words((i + 1).to_string())];
        cells.extend([o.k2.max(0.0).sqrt(), o.n, c.free[0], c.free[1]].map(|v| Cell::number(v, DIGITS, language)));
        cells.extend(standing.then(|| Cell::number(mode.standing().unwrap_or(0.0), DIGITS, language)));
        table.row(cells);
    }
    table
}

/// One row a harmonic of a mode: h sin(pt + δ) forces D sin(pt + δ - ε). None without harmonic loads.
pub fn harmonic_table(modes: &[Listed], language: Language) -> Option<Table> {
    let heads = [("i", ""), ("p", "rad/s"), ("h", ""), ("D", ""), ("epsilon", "rad")];
    let mut table = Table::new(columns(heads.map(|(name, unit)| (name.to_owned(), unit)).into(), language));
    let number = |v: f64| Cell::number(v, DIGITS, language);
    for (i, mode) in modes.iter().enumerate() {
        for f in &mode.forcing {
            let h = &f.harmonic;
            let forced = h.amplitude.map_or([Cell::Empty, Cell::Empty], |d| [number(d), number(h.lag)]);
            table.row([Cell::words((i + 1).to_string()), number(h.p), number(h.h)].into_iter().chain(forced).collect());
        }
    }
    (!table.rows.is_empty()).then_some(table)
}

fn columns(heads: Vec<(String, &'static str)>, language: Language) -> Vec<Column> {
    heads.into_iter().map(|(name, unit)| Column::with_unit(report::document::Rich::symbol(name), unit, language)).collect()
}
