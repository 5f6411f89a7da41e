//! Modes and responses as tables, figures and sentences.

use crate::small::modes::{Found, ModesFound, columns};
use analysis::Dataset;
use report::document::Rich;
use report::table::Column;
use report::{Block, Cell, Figure, Language, Table, Word};

/// Significant digits.
const DIGITS: usize = 6;

/// A dataset as a table, column for column.
pub fn plain_table(data: &[analysis::dataset::Column], language: Language) -> Table {
    let heads = data.iter().map(|c| {
        let unit = if c.quantity.unit == "1/s" && c.quantity.name == "f" { "Hz" } else { &c.quantity.unit };
        Column::with_unit(Rich::symbol(symbol(&c.quantity)), unit, language)
    });
    let mut table = Table::new(heads.collect());
    let n = data.first().map_or(0, |c| c.values.len());
    let cells: Vec<Vec<Cell>> = data.iter().map(|c| cells(&c.quantity.name, &c.values, language)).collect();
    for i in 0..n {
        table.row(cells.iter().map(|column| column[i].clone()).collect());
    }
    table
}

/// The printed symbol of a column.
fn symbol(quantity: &analysis::Quantity) -> String {
    match quantity.name.as_str() {
        "mode" => "№".into(),
        "omega" => "ω".into(),
        "omega_d" => "ω_d".into(),
        "damping_ratio" => "ζ".into(),
        "decrement" => "δ".into(),
        "growth" => "Re λ".into(),
        _ => quantity.symbol.clone(),
    }
}

fn cells(name: &str, values: &[f64], language: Language) -> Vec<Cell> {
    if name == "mode" {
        return values.iter().map(|v| Cell::words(format!("{v}"))).collect();
    }
    let finite: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    let mut shown = Cell::column(&finite, DIGITS, language).into_iter();
    values.iter().map(|v| if v.is_finite() { shown.next().unwrap_or(Cell::Empty) } else { Cell::words("–") }).collect()
}

/// The equilibrium about which the motions are small, in one line.
pub fn place(found: &Found, language: Language) -> String {
    let value = |(q, v): (&analysis::Quantity, &f64)| {
        let unit = report::unit::print(&q.unit, language);
        let number = report::number::short(*v, 4, language);
        format!("{} = {}", report::symbol::plain(&q.symbol, language), report::number::with_unit(&number, &unit))
    };
    let list: Vec<String> = found.small.machine.coordinates().iter().zip(&found.small.place.q).map(value).collect();
    format!("{}: {}", language.word(Word::Equilibrium), list.join(", "))
}

/// Everything about modes.
pub fn modes(found: &ModesFound, language: Language, page: bool) -> Vec<Block> {
    let Some(f) = &found.found else { return Vec::new() };
    let mut blocks = vec![Block::paragraph(place(f, language))];
    blocks.push(Block::Table(plain_table(&columns(f), language)));
    if let Some(equation) = &f.equation {
        let of = language.pick("Frequency equation", "Частотное уравнение");
        let meaning = match &found.study.variable {
            Some(_) => String::new(),
            None => ", z = ω²".to_owned(),
        };
        blocks.push(Block::paragraph(format!("{of}: {}{meaning}", equation.text)));
    }
    if let Some(tracks) = &f.tracks {
        blocks.push(Block::Table(plain_table(&thinned(&tracks.data), language)));
        for c in &tracks.critical {
            let value = report::number::short(c.value, DIGITS, language);
            let words = language.pick("Critical speed", "Критическая скорость");
            let mode = language.pick("mode", "форма");
            blocks.push(Block::paragraph(format!("{words}: {value} ({mode} {})", c.mode + 1)));
        }
        if page {
            blocks.extend(campbell(&found.data, language).map(Block::Figure));
        }
    }
    for note in &found.data.notes {
        blocks.push(Block::paragraph(language.text(note)));
    }
    blocks
}

/// Frequencies over the parameter.
pub fn campbell(data: &Dataset, language: Language) -> Option<Figure> {
    let names: Vec<&str> = data.columns.iter().map(|c| c.quantity.name.as_str()).filter(|n| n.starts_with("omega_")).collect();
    let mut figure = Figure::over_axis(data, &names, language)?;
    figure.name = "campbell".into();
    figure.y.log = false;
    Some(figure)
}

/// At most a dozen rows of a long dataset, the ends among them.
fn thinned(data: &Dataset) -> Vec<analysis::dataset::Column> {
    let n = data.columns.first().map_or(0, |c| c.values.len());
    let rows = 11.min(n);
    let pick = |k: usize| if rows > 1 { k * (n - 1) / (rows - 1) } else { k };
    let thin = |c: &analysis::dataset::Column| analysis::dataset::Column {
        quantity: c.quantity.clone(),
        values: (0..rows).map(|k| c.values[pick(k)]).collect(),
    };
    data.columns.iter().map(thin).collect()
}
