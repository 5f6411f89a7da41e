//! Values of a sweep from a column of a file: `m=column("masses.csv","m")` becomes `m=0.002 kg; 0.003 kg; ...`.
//!
//! The head of the column is its name, or its name with the unit of its numbers, as tables of strutt have it: `m [kg]`.

use crate::system;
use mechanics::variants::cells;
use std::fs;
use std::path::PathBuf;
use studies::Failure;
use studies::failure::Misuse;
use words::{Notice, Text};

/// A range with the values of the column that it names; other ranges stay.
///
/// # Errors
/// The file cannot be read, has no such column, or a cell of it is no number (C077).
pub fn expanded(range: &str) -> Result<String, Failure> {
    let Some((name, file, column)) = named(range) else { return Ok(range.to_owned()) };
    let bytes = fs::read(&file).map_err(|error| {
        let cause = system::cause(&error);
        refused((format!("no values from `{file}`: {}", cause.en), format!("нет значений из `{file}`: {}", cause.ru)))
    })?;
    let text = crate::letters::decoded(&bytes);
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let head = lines.next().map_or("", |(_, line)| line);
    let separator = if head.contains(';') { ';' } else { ',' };
    let titles = cells(head, separator);
    let (at, unit) = titles.iter().enumerate().find_map(|(k, title)| Some((k, fits(title, &column)?))).ok_or_else(|| {
        let list = titles.join(", ");
        refused((format!("`{file}` has no column `{column}`; it has: {list}"), format!("в `{file}` нет столбца `{column}`; есть: {list}")))
    })?;
    let mut values = Vec::new();
    for (line, row) in lines {
        let cell = cells(row, separator).get(at).map(|cell| if separator == ';' { cell.replace(',', ".") } else { cell.clone() });
        let number = cell.as_deref().filter(|cell| cell.parse::<f64>().is_ok_and(f64::is_finite)).ok_or_else(|| {
            let (shown, line) = (cell.as_deref().unwrap_or_default(), line + 1);
            refused((
                format!("line {line} of `{file}`: `{shown}` is no number"),
                format!("строка {line} файла `{file}`: `{shown}` — не число"),
            ))
        })?;
        values.push(if unit.is_empty() { number.to_owned() } else { format!("{number} {unit}") });
    }
    if values.is_empty() {
        return Err(refused((format!("`{file}` has no rows"), format!("в `{file}` нет строк"))));
    }
    Ok(format!("{name}={}", values.join("; ")))
}

/// The file that a range takes its values from; none of other ranges.
pub fn table(range: &str) -> Option<PathBuf> {
    named(range).map(|(_, file, _)| file.into())
}

/// `m=column("masses.csv","m")`: what is changed, the file, the column.
fn named(range: &str) -> Option<(String, String, String)> {
    let (name, rest) = range.split_once('=')?;
    let inner = rest.trim().strip_prefix("column")?.trim().strip_prefix('(')?.strip_suffix(')')?;
    let parts = cells(inner, if inner.contains(';') { ';' } else { ',' });
    let plain = |text: &String| text.trim().to_owned();
    match &parts[..] {
        [file, column] => Some((name.trim().to_owned(), plain(file), plain(column))),
        _ => None,
    }
}

/// The unit of a column that has this name; empty for none.
fn fits(title: &str, column: &str) -> Option<String> {
    let (name, unit) = match title.strip_suffix(']').and_then(|title| title.rsplit_once('[')) {
        Some((name, unit)) => (name.trim(), unit.trim()),
        None => (title, ""),
    };
    (title == column || name == column).then(|| if unit == "1" { String::new() } else { unit.to_owned() })
}

fn refused((en, ru): (String, String)) -> Failure {
    let help = Text::new(
        "write --over 'm=column(\"masses.csv\",\"m\")': a table with a line of heads, numbers below them",
        "напишите --over 'm=column(\"masses.csv\",\"m\")': таблица со строкой заголовков и числами под ними",
    );
    Notice::new("C077", en, ru).cure(help).misuse()
}

#[cfg(test)]
mod tests {
    use super::{expanded, fits, named};

    #[test]
    fn columns_are_named_with_and_without_units() {
        let parts = |a: &str, b: &str, c: &str| Some((a.to_owned(), b.to_owned(), c.to_owned()));
        assert_eq!(named("m=column(\"a b.csv\",\"m\")"), parts("m", "a b.csv", "m"));
        assert_eq!(named("phi' = column(a.csv; phi')"), parts("phi'", "a.csv", "phi'"));
        assert_eq!(named("m=1 kg, 2 kg"), None);
        assert_eq!(fits("m [kg]", "m").as_deref(), Some("kg"));
        assert_eq!(fits("m [1]", "m").as_deref(), Some(""));
        assert_eq!(fits("mass", "m"), None);
        assert_eq!(expanded("m=linspace(1 kg, 2 kg, 3)").ok().as_deref(), Some("m=linspace(1 kg, 2 kg, 3)"));
    }
}
