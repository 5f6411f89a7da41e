//! CSV tables of a [`Dataset`]: `t [s],phi [rad],...`, SI values with 17 significant digits.

use super::row::pass_on;
use super::{Format, Holds, Table};
use crate::number::push_exact;
use analysis::Dataset;
use analysis::dataset::Column;
use std::io::{self, Write};
use words::Language;

/// The row of the table.
pub const FORMAT: Format = Format {
    name: "csv",
    extension: "csv",
    help: ("columns of numbers on standard output, 17 digits", "столбцы чисел в стандартный вывод, 17 знаков"),
    holds: Holds::Table(NUMBERS),
};

/// Columns of numbers as this format writes them.
pub const NUMBERS: Table =
    Table { data: |data, to| write_to(data, Dialect::Plain, to), events: |data, language| write_events(data, Dialect::Plain, language) };

/// Flavour of CSV.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Dialect {
    /// Comma between cells, decimal point, no byte order mark.
    #[default]
    Plain,
    /// For Russian spreadsheet programs: semicolon between cells, decimal comma, byte order mark.
    Ru,
}

/// The table as bytes: see [`write_to`].
pub fn write(data: &Dataset, dialect: Dialect) -> Vec<u8> {
    let mut out = Vec::new();
    // memory takes everything
    let written = write_to(data, dialect, &mut out);
    debug_assert!(written.is_ok());
    out
}

/// Writes the table, piece by piece.
///
/// 17 significant digits name every `f64`: reading the plain dialect gives back the same bits. Where there is no such quantity the cell is
/// empty (the result says why, [`Dataset::stated`]); what grows beyond all bounds is `inf` or `-inf`.
///
/// # Errors
/// The place refuses it.
pub fn write_to(data: &Dataset, dialect: Dialect, to: &mut dyn Write) -> io::Result<()> {
    let n_rows = data.columns.iter().map(|c| c.values.len()).max().unwrap_or(0);
    let mut out = Vec::new();
    let separator = match dialect {
        Dialect::Plain => b',',
        Dialect::Ru => {
            out.extend_from_slice("\u{feff}".as_bytes());
            b';'
        }
    };
    for (i, (column, name)) in data.columns.iter().zip(data.names()).enumerate() {
        if i > 0 {
            out.push(separator);
        }
        push_cell(&mut out, &format!("{name} [{}]", column.quantity.unit), separator);
    }
    for labels in &data.labels {
        out.push(separator);
        push_cell(&mut out, &labels.name, separator);
    }
    // why a row has no numbers; in English, as names are
    if !data.reasons.is_empty() {
        out.push(separator);
        push_cell(&mut out, "reason", separator);
    }
    out.push(b'\n');
    let mut reasons = data.reasons.iter().peekable();
    for i_row in 0..n_rows {
        for (i, column) in data.columns.iter().enumerate() {
            if i > 0 {
                out.push(separator);
            }
            if let Some(&x) = column.values.get(i_row) {
                push_number(&mut out, x, dialect);
            }
        }
        for labels in &data.labels {
            out.push(separator);
            if let Some(word) = labels.rows.get(i_row).and_then(|k| labels.words.get(*k)) {
                push_cell(&mut out, word, separator);
            }
        }
        if !data.reasons.is_empty() {
            out.push(separator);
            if let Some((_, words)) = reasons.next_if(|(row, _)| *row == i_row) {
                push_cell(&mut out, &words.en, separator);
            }
        }
        out.push(b'\n');
        pass_on(&mut out, to)?;
    }
    to.write_all(&out)
}

/// A table of what happened: `event,side,t [s],phi [rad],...`. A named event has one row, a switch two, `before` and `after` it; its first cell is what
/// switched, in words.
pub fn write_events(data: &Dataset, dialect: Dialect, language: Language) -> Vec<u8> {
    let head = Dataset { columns: data.columns.iter().map(|c| Column { values: Vec::new(), ..c.clone() }).collect(), ..Dataset::default() };
    let titles = write(&head, dialect);
    let separator = if dialect == Dialect::Ru { b';' } else { b',' };
    let mark = if dialect == Dialect::Ru { "\u{feff}" } else { "" };
    let mut out = mark.as_bytes().to_vec();
    out.extend_from_slice(b"event");
    out.push(separator);
    out.extend_from_slice(b"side");
    out.push(separator);
    out.extend_from_slice(&titles[mark.len()..]);
    for event in &data.events {
        let named = !event.name.is_empty();
        let sides: &[(&str, usize)] = if named { &[("at", 1)] } else { &[("before", 0), ("after", 1)] };
        for (word, side) in sides {
            push_cell(&mut out, if named { &event.name } else { language.text(&event.what) }, separator);
            out.push(separator);
            out.extend_from_slice(word.as_bytes());
            let mut values = event.outputs[*side].iter();
            for i in 0..data.columns.len() {
                out.push(separator);
                if let Some(x) = if Some(i) == data.axis { Some(&event.t) } else { values.next() } {
                    push_number(&mut out, *x, dialect);
                }
            }
            out.push(b'\n');
        }
    }
    out
}

fn push_number(out: &mut Vec<u8>, x: f64, dialect: Dialect) {
    if x.is_nan() {
        return;
    }
    let start = out.len();
    push_exact(out, x);
    if dialect == Dialect::Ru {
        out[start..].iter_mut().filter(|b| **b == b'.').for_each(|b| *b = b',');
    }
}

/// A text cell, quoted where needed.
fn push_cell(out: &mut Vec<u8>, text: &str, separator: u8) {
    let quoted = text.bytes().any(|b| b == separator || matches!(b, b'"' | b'\n' | b'\r'));
    if quoted {
        out.push(b'"');
        out.extend_from_slice(text.replace('"', "\"\"").as_bytes());
        out.push(b'"');
    } else {
        out.extend_from_slice(text.as_bytes());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use analysis::Quantity;

    fn sample(values: Vec<f64>) -> Dataset {
        let t = (0..values.len()).map(|i| i as f64 * 0.1).collect();
        let columns =
            vec![Column { quantity: Quantity::new("t", "s"), values: t }, Column { quantity: Quantity::new("phi'", "rad/s"), values }];
        Dataset { axis: Some(0), columns, ..Dataset::default() }
    }

    #[test]
    fn the_plain_dialect_reads_back_bit_for_bit() {
        let values = vec![0.1, -0.0, 1.0 / 3.0, 5e-324, f64::MAX, f64::MIN_POSITIVE, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
        let bytes = write(&sample(values.clone()), Dialect::Plain);
        let mut reader = ::csv::Reader::from_reader(bytes.as_slice());
        assert_eq!(reader.headers().unwrap().iter().collect::<Vec<_>>(), ["t [s]", "phi' [rad/s]"]);
        let read = |cell: &str| if cell.is_empty() { f64::NAN } else { cell.parse().unwrap() };
        let back: Vec<f64> = reader.records().map(|r| read(&r.unwrap()[1])).collect();
        assert_eq!(back.len(), values.len());
        for (a, b) in values.iter().zip(&back) {
            assert!(a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan(), "{a:e} {b:e}");
        }
    }

    #[test]
    fn the_russian_dialect_has_semicolons_commas_and_a_mark() {
        let text = String::from_utf8(write(&sample(vec![0.5]), Dialect::Ru)).unwrap();
        assert_eq!(text, "\u{feff}t [s];phi' [rad/s]\n0,0000000000000000e0;5,0000000000000000e-1\n");
    }

    #[test]
    fn awkward_names_are_quoted() {
        let mut data = sample(vec![]);
        data.columns[1].quantity.name = "a,\"b\"".into();
        assert_eq!(write(&data, Dialect::Plain), b"t [s],\"a,\"\"b\"\" [rad/s]\"\n");
    }

    #[test]
    fn events_have_a_row_and_switches_have_two() {
        let mut data = sample(vec![0.5]);
        let both = [vec![1.0], vec![-1.0]];
        data.events.push(analysis::dataset::Event { t: 0.25, name: "top".into(), outputs: both.clone(), ..Default::default() });
        data.events.push(analysis::dataset::Event { t: 0.5, what: words::Text::same("stop, hit"), outputs: both, ..Default::default() });
        let text = String::from_utf8(write_events(&data, Dialect::Plain, Language::En)).unwrap();
        let rows: Vec<&str> = text.lines().collect();
        assert_eq!(rows[0], "event,side,t [s],phi' [rad/s]");
        assert!(rows[1].starts_with("top,at,2.5") && rows[2].starts_with("\"stop, hit\",before,5.0") && rows[3].contains(",after,5.0"));
        assert_eq!(rows.len(), 4);
        data.events[1].what = words::Text::new("stop, hit", "упор: удар");
        let russian = String::from_utf8(write_events(&data, Dialect::Plain, Language::Ru)).unwrap();
        assert!(russian.lines().nth(2).unwrap().starts_with("упор: удар,before,5.0"), "{russian}");
    }

    #[test]
    fn a_dataset_without_columns_is_an_empty_line() {
        assert_eq!(write(&Dataset::default(), Dialect::Plain), b"\n");
    }
}
