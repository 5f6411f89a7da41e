//! Tables of results: what became of each quantity, places of rest side by side, all rows.

use crate::wording::{Word as Say, say};
use analysis::Dataset;
use analysis::dataset::Extreme;
use analysis::rest::sizes::NOISE;
use report::table::Column;
use report::{Cell, Table, Word};
use words::Language;

/// Share of the largest value of its unit below which a whole column is rounding.
const ROUNDING: f64 = 1e-14;
/// Significant digits of numbers in tables.
pub const DIGITS: usize = 4;
/// Significant digits where all rows are shown.
const TABLE_DIGITS: usize = 6;
/// Rows of a table that are shown; all are in the files.
const ROWS: usize = 60;

/// What became of each quantity: at the start, least, largest, at the end. Least and greatest values are those of the motion, with their places on the
/// axis; a quantity that could not be followed between the rows has none.
pub fn results(data: &Dataset, language: Language) -> Table {
    let heads = [Word::Symbol, Word::Unit].map(|w| Column::new(language.word(w)));
    let axis = data.axis.and_then(|a| data.columns.get(a)).map(|c| &c.quantity);
    let timed = !data.extremes.is_empty();
    let mut columns: Vec<Column> = heads.into();
    columns.push(Column::new(say(language, Say::AtStart)));
    for word in [Word::Minimum, Word::Maximum] {
        columns.push(Column::new(language.word(word)));
        columns.extend(timed.then(|| taken_at(axis, language)));
    }
    columns.push(Column::new(language.word(Word::Final)));
    columns.push(Column::new(language.word(Word::Description)));
    let mut table = Table::new(columns);
    for (i, column) in data.columns.iter().enumerate() {
        if Some(i) == data.axis || column.values.is_empty() {
            continue;
        }
        let [first, last] = ends_of(data, i);
        let known = extreme_of(data, i);
        if known.is_none() && !column.values.iter().any(|v| v.is_finite()) {
            continue;
        }
        let none = Extreme { min: f64::NAN, t_min: f64::NAN, max: f64::NAN, t_max: f64::NAN, column: i };
        let e = known.unwrap_or(none);
        let size = [first, e.min, e.max, last].iter().filter(|v| v.is_finite()).fold(0.0_f64, |m, v| m.max(v.abs()));
        let held = data.digits.as_ref().and_then(|d| d.columns.iter().find(|h| h.column == i));
        // what is rounding alone is a zero
        let noise = held.map_or(0.0, |h| h.noise).max(beside(data, &column.quantity.unit, size));
        let scale = scale(&column.quantity, if size <= noise { 0.0 } else { size });
        let shown = [first, e.min, e.max, last].map(|v| if v.abs() <= noise { 0.0 } else { v / scale.size });
        let mut cells = with_digits(&shown, held.map(|h| h.deviations.map(|d| d / scale.size)), language).into_iter();
        let nothing = e.min.abs().max(e.max.abs()) <= noise && noise > 0.0;
        let instants = if nothing { [f64::NAN; 2] } else { [e.t_min, e.t_max] };
        let mut instants = with_digits(&instants, held.map(|h| h.instants), language).into_iter();
        let mut row = vec![Cell::symbol(&column.quantity.symbol), Cell::words(scale.print(language))];
        row.extend(cells.next());
        for _ in 0..2 {
            row.extend(cells.next());
            row.extend(instants.next().filter(|_| timed));
        }
        row.extend(cells);
        row.push(Cell::words(language.text(&column.quantity.label)));
        table.row(row);
    }
    table
}

/// Values where a motion begins and ends, whatever rows are asked for; of other results those of the list.
fn ends_of(data: &Dataset, i: usize) -> [f64; 2] {
    let values = &data.columns[i].values;
    let listed = [values[0], values[values.len() - 1]];
    let timed = data.axis.is_some_and(|a| data.columns[a].quantity.name == "t");
    match data.overall.iter().find(|o| o.column == i).filter(|_| timed) {
        Some(o) => [(o.first, listed[0]), (o.last, listed[1])].map(|(v, row)| if v.is_finite() { v } else { row }),
        None => listed,
    }
}

/// The size of a column that is nothing but rounding beside another of its unit: 0 where it is more.
fn beside(data: &Dataset, unit: &str, size: f64) -> f64 {
    let alike = data.extremes.iter().filter(|e| data.columns[e.column].quantity.unit == unit);
    let largest = alike.fold(0.0_f64, |m, e| m.max(e.min.abs()).max(e.max.abs()));
    if size <= ROUNDING * largest { size } else { 0.0 }
}

/// Head of the column of places: "at, s" over time, the driven coordinate otherwise.
fn taken_at(axis: Option<&analysis::Quantity>, language: Language) -> Column {
    match axis.filter(|q| q.name != "t") {
        None => Column::with_unit(say(language, Say::WhenTaken), "s", language),
        Some(q) => {
            Column::with_unit(format!("{} {}", language.pick("at", "при"), report::symbol::plain(&q.symbol, language)), &q.unit, language)
        }
    }
}

/// Least and greatest value of a column: those of the motion; of results that stand beside one another, those of the list.
fn extreme_of(data: &Dataset, i: usize) -> Option<Extreme> {
    if let Some(found) = data.extremes.iter().find(|e| e.column == i) {
        return Some(found.clone());
    }
    let finite = data.columns[i].values.iter().copied().filter(|v| v.is_finite() && data.axis.is_none());
    let (min, max) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    (min <= max).then_some(Extreme { column: i, min, max, ..Extreme::default() })
}

/// Cells of a row of numbers. Where a repetition deviates, only the digits that it confirms; a dash where not even the first holds.
fn with_digits<const N: usize>(values: &[f64; N], deviations: Option<[f64; N]>, language: Language) -> Vec<Cell> {
    let held = deviations.map(|d| std::array::from_fn::<i32, N, _>(|k| analysis::audits::digits::digits(values[k].abs(), d[k])));
    let few = |k: usize| held.is_some_and(|h| h[k] < DIGITS as i32 && values[k] != 0.0);
    if !(0..N).any(few) {
        let finite: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
        let mut printed = Cell::column(&finite, DIGITS, language).into_iter();
        return values.iter().map(|v| if v.is_finite() { printed.next().unwrap_or(Cell::Empty) } else { Cell::Empty }).collect();
    }
    let cell = |k: usize| match held {
        Some(h) if few(k) && h[k] < 1 => Cell::words("–"),
        Some(h) if few(k) => Cell::number(values[k], h[k] as usize, language),
        _ => Cell::number(values[k], DIGITS, language),
    };
    (0..N).map(cell).collect()
}

/// The user's unit of display, otherwise SI with a prefix.
pub fn scale(quantity: &analysis::Quantity, largest: f64) -> report::unit::Scale {
    match &quantity.display {
        Some((label, size)) => report::unit::Scale { size: *size, label: label.clone() },
        None => report::unit::Scale::of_column(&quantity.unit, largest),
    }
}

/// One row per quantity, one column per equilibrium.
pub fn equilibria(data: &Dataset, language: Language) -> Table {
    let n = data.columns.first().map_or(0, |c| c.values.len());
    let mut columns = vec![Column::new(language.word(Word::Symbol)), Column::new(language.word(Word::Unit))];
    columns.extend((1..=n).map(|i| if n == 1 { language.word(Word::Value).to_owned() } else { i.to_string() }).map(Column::new));
    columns.push(Column::new(language.word(Word::Description)));
    let mut table = Table::new(columns);
    for column in &data.columns {
        if column.quantity.name == "stable" {
            let verdict = |v: &f64| match v {
                v if v.is_nan() => Say::Undecided,
                v if *v == 0.0 => Say::Unstable,
                _ => Say::Stable,
            };
            let mut row = vec![Cell::words(say(language, Say::Stability)), Cell::Empty];
            row.extend(column.values.iter().map(|v| Cell::words(say(language, verdict(v)))));
            table.row(row);
            continue;
        }
        if matches!(column.quantity.name.as_str(), "residual" | "negative_directions") {
            continue;
        }
        let alike = data.columns.iter().filter(|c| c.quantity.unit == column.quantity.unit && !c.quantity.unit.is_empty());
        let noise = NOISE * alike.flat_map(|c| &c.values).fold(0.0_f64, |m, v| m.max(v.abs()));
        let values: Vec<f64> = column.values.iter().map(|v| if v.abs() <= noise { 0.0 } else { *v }).collect();
        let largest = values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let scale = scale(&column.quantity, largest);
        let shown: Vec<f64> = values.iter().map(|v| v / scale.size).collect();
        let decides = column.quantity.name == "growth";
        let symbol = if decides { Cell::words("Re λ") } else { Cell::symbol(&column.quantity.symbol) };
        let mut row = vec![symbol, Cell::words(scale.print(language))];
        row.extend(if decides { Cell::column_of_signs(&shown, DIGITS, language) } else { Cell::column(&shown, DIGITS, language) });
        row.push(Cell::words(language.text(&column.quantity.label)));
        table.row(row);
    }
    table
}

/// All columns side by side.
pub fn row_by_row(data: &Dataset, language: Language) -> Table {
    let mut columns = Vec::new();
    let mut cells: Vec<Vec<Cell>> = Vec::new();
    let count = data.columns.iter().map(|c| c.values.len()).max().unwrap_or(0);
    let shown = count.min(ROWS);
    for column in &data.columns {
        let values = &column.values[..shown.min(column.values.len())];
        let largest = values.iter().filter(|v| v.is_finite()).fold(0.0_f64, |m, v| m.max(v.abs()));
        let scale = scale(&column.quantity, largest);
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
