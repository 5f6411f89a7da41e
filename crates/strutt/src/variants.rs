//! `--variant NAME`: a row of the table that the model file names, as values that replace those of the file.

use mechanics::Model;
use mechanics::model::{VariantTable, Variants};
use std::path::Path;
use studies::Source;
use studies::failure::Failure;
use studies::failure::Misuse;
use words::{Notice, Place, Severity, nearest};

/// A table of variants.
struct Sheet {
    /// As messages name it.
    place: String,
    /// Name and unit of each column.
    header: Vec<(String, Option<String>)>,
    /// Rows, as many cells as columns.
    rows: Vec<Vec<String>>,
    /// Line of each row, from 1.
    lines: Vec<usize>,
    /// Column of the names of variants.
    key: usize,
}

/// What a variant replaces, as with `--set`.
///
/// # Errors
/// The file has no variants (C020), not this one (C021), the table cannot be read (C001 ... C004) or does not fit (C022).
pub fn overrides(model: &Model, source: &Source, name: &str) -> Result<Vec<(String, String)>, Failure> {
    let variants = model.variants.as_ref().ok_or_else(|| none(source))?;
    let sheet = sheet(variants, source)?;
    let at = only_row(&sheet, name)?;
    let row = &sheet.rows[at];
    let used = used_columns(variants, &sheet, model)?;
    named_once(&sheet, &used)?;
    let mut found = Vec::new();
    if let Some(parameter) = variants.number.as_ref().filter(|p| !used.iter().any(|i| sheet.header[*i].0 == **p)) {
        let number: f64 = row[sheet.key].parse().map_err(|_| {
            misfit(
                &sheet,
                (format!("`{name}` is no number, which {parameter} needs"), format!("`{name}` — не число, а оно нужно для {parameter}")),
            )
        })?;
        found.push((parameter.clone(), number.to_string()));
    }
    for i in used {
        let (column, unit) = &sheet.header[i];
        let cell = &row[i];
        if !cell.is_empty() {
            let bare = cell.chars().all(|c| c.is_ascii_digit() || ".,+-eE".contains(c));
            let value = match unit {
                Some(unit) if bare => format!("{cell} {unit}"),
                _ => cell.clone(),
            };
            let pair = (column.clone(), value);
            cell_fits(&sheet, sheet.lines[at], &pair, source)?;
            found.push(pair);
        }
    }
    Ok(found)
}

/// The table when it is a file of its own, as a path.
pub fn file(model: &Model, source: &Source) -> Option<String> {
    match &model.variants.as_ref()?.table {
        VariantTable::Text(_) => None,
        VariantTable::File(file) => Some(beside(source, file)),
    }
}

fn beside(source: &Source, file: &str) -> String {
    let folder = Path::new(&source.path).parent().unwrap_or(Path::new(""));
    folder.join(file).to_string_lossy().into_owned()
}

/// The row of a variant: two rows of one name would let their order decide.
fn only_row(sheet: &Sheet, name: &str) -> Result<usize, Failure> {
    let mut found = (0..sheet.rows.len()).filter(|i| same(&sheet.rows[*i][sheet.key], name));
    let first = found.next().ok_or_else(|| unknown(sheet, name))?;
    match found.next() {
        None => Ok(first),
        Some(second) => {
            let (a, b) = (sheet.lines[first], sheet.lines[second]);
            Err(misfit(
                sheet,
                (format!("lines {a} and {b} are both variant `{name}`"), format!("строки {a} и {b} задают один вариант `{name}`")),
            ))
        }
    }
}

/// Two columns of one quantity contradict each other.
fn named_once(sheet: &Sheet, used: &[usize]) -> Result<(), Failure> {
    for i in used.iter().chain([&sheet.key]) {
        let name = &sheet.header[*i].0;
        let mut twins = (0..sheet.header.len()).filter(|j| sheet.header[*j].0 == *name);
        if let (Some(a), Some(b)) = (twins.next(), twins.next()) {
            let (a, b) = (a + 1, b + 1);
            return Err(misfit(
                sheet,
                (format!("columns {a} and {b} are both `{name}`"), format!("столбцы {a} и {b} называются одинаково: `{name}`")),
            ));
        }
    }
    Ok(())
}

/// A cell is read as --set would read it; what is wrong with it is said of its place in the table.
fn cell_fits(sheet: &Sheet, line: usize, pair: &(String, String), source: &Source) -> Result<(), Failure> {
    let Err(found) = studies::read(source, std::slice::from_ref(pair)) else { return Ok(()) };
    let own = found.into_iter().find(|d| d.severity == Severity::Error && matches!(d.place, Place::Override { .. }));
    let Some(wrong) = own else { return Ok(()) };
    let (place, column, what) = (&sheet.place, &pair.0, &wrong.what);
    let mut trouble = Notice::new(
        "C022",
        format!("{place}, line {line}, column `{column}`: {}", what.en),
        format!("{place}, строка {line}, столбец `{column}`: {}", what.ru),
    );
    (trouble.why, trouble.help) = (wrong.why.clone(), wrong.help.clone());
    Err(trouble.into())
}

/// The names of all variants, in the order of the table; none when the file has no table.
///
/// # Errors
/// The table cannot be read (C001 ... C004) or is none (C022).
pub fn names(model: &Model, source: &Source) -> Result<Vec<String>, Failure> {
    let Some(variants) = &model.variants else { return Ok(Vec::new()) };
    let sheet = sheet(variants, source)?;
    Ok(sheet.rows.iter().map(|row| row[sheet.key].clone()).collect())
}

/// `3`, `03` and `3.0` are one variant.
fn same(cell: &str, name: &str) -> bool {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    cell == name.trim() || number(cell).is_some_and(|n| number(name) == Some(n))
}

fn sheet(variants: &Variants, source: &Source) -> Result<Sheet, Failure> {
    let (place, text) = match &variants.table {
        VariantTable::Text(text) => (source.path.clone(), text.clone()),
        VariantTable::File(file) => {
            let path = beside(source, file);
            (path.clone(), crate::source::open(&path)?.text)
        }
    };
    parse(place, &text, variants.key.as_deref())
}

fn parse(place: String, text: &str, key: Option<&str>) -> Result<Sheet, Failure> {
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty() && !line.trim_start().starts_with('#'));
    let mut sheet = Sheet { place, header: Vec::new(), rows: Vec::new(), lines: Vec::new(), key: 0 };
    let Some((_, first)) = lines.next() else {
        return Err(misfit(&sheet, ("the table of variants is empty".into(), "таблица вариантов пуста".into())));
    };
    let separator = [';', '\t'].into_iter().find(|c| first.contains(*c)).unwrap_or(',');
    sheet.header = cells(first, separator).iter().map(|cell| name_and_unit(cell)).collect();
    for (number, line) in lines {
        let row = cells(line, separator);
        if row.len() != sheet.header.len() {
            let (line, n, m) = (number + 1, row.len(), sheet.header.len());
            return Err(uneven(&sheet.place, line, (n, m)));
        }
        sheet.rows.push(row);
        sheet.lines.push(number + 1);
    }
    if let Some(key) = key {
        let found = sheet.header.iter().position(|(name, _)| name == key);
        sheet.key = found.ok_or_else(|| no_column(&sheet, key))?;
    }
    Ok(sheet)
}

/// The cells of a line; quotes protect separators, two quotes inside quotes are one.
fn cells(line: &str, separator: char) -> Vec<String> {
    let mut found = vec![String::new()];
    let mut quoted = false;
    for c in line.trim_end_matches('\r').chars() {
        match c {
            '"' => quoted = !quoted,
            c if c == separator && !quoted => found.push(String::new()),
            c => found.iter_mut().last().into_iter().for_each(|cell| cell.push(c)),
        }
    }
    found.iter().map(|cell| cell.trim().to_owned()).collect()
}

/// `m [g]` is m in g.
fn name_and_unit(cell: &str) -> (String, Option<String>) {
    match cell.strip_suffix(']').and_then(|c| c.split_once('[')) {
        Some((name, unit)) => (name.trim().to_owned(), Some(unit.trim().to_owned())),
        None => (cell.to_owned(), None),
    }
}

/// The columns whose values are taken.
fn used_columns(variants: &Variants, sheet: &Sheet, model: &Model) -> Result<Vec<usize>, Failure> {
    let position = |name: &String| sheet.header.iter().position(|(column, _)| column == name).ok_or_else(|| no_column(sheet, name));
    if let Some(columns) = &variants.columns {
        return columns.iter().map(position).collect();
    }
    let known = |name: &str| {
        let base = name.strip_suffix('\'').unwrap_or(name);
        model.parameters.iter().any(|p| p.name == name) || model.coordinates.iter().any(|c| c.name == base)
    };
    let others = (0..sheet.header.len()).filter(|i| *i != sheet.key);
    let (used, foreign): (Vec<usize>, Vec<usize>) = others.partition(|i| known(&sheet.header[*i].0));
    match foreign.first() {
        None => Ok(used),
        Some(i) => Err(foreign_column(sheet, &sheet.header[*i].0, model)),
    }
}

fn none(source: &Source) -> Failure {
    let path = &source.path;
    Notice::new("C020", format!("`{path}` has no variants"), format!("в `{path}` нет вариантов"))
        .help(
            "add [variants] and table = \"variants.csv\", or leave --variant out",
            "добавьте [variants] и table = \"variants.csv\" или не задавайте --variant",
        )
        .misuse()
}

fn unknown(sheet: &Sheet, name: &str) -> Failure {
    let names = || sheet.rows.iter().map(|row| row[sheet.key].as_str());
    let place = &sheet.place;
    let list = names().take(60).collect::<Vec<_>>().join(", ");
    let trouble = Notice::new("C021", format!("there is no variant `{name}` in {place}"), format!("нет варианта `{name}` в {place}"));
    let trouble = match sheet.rows.is_empty() {
        true => trouble.why("the table has no rows", "в таблице нет строк"),
        false => trouble.why(format!("the table has: {list}"), format!("в таблице есть: {list}")),
    };
    match nearest(name, names()).filter(|_| name.trim().parse::<f64>().is_err()) {
        Some(near) => trouble.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
        None => trouble,
    }
    .misuse()
}

fn misfit(sheet: &Sheet, (en, ru): (String, String)) -> Failure {
    Notice::new("C022", format!("{}: {en}", sheet.place), format!("{}: {ru}", sheet.place)).into()
}

fn uneven(place: &str, line: usize, (cells, columns): (usize, usize)) -> Failure {
    Notice::new(
        "C022",
        format!("{place}: line {line} has {cells} cells, the header has {columns}"),
        format!("{place}: в строке {line} клеток {cells}, а столбцов {columns}"),
    )
    .help(
        "give each line one cell a column; a cell that holds a separator stands in quotes",
        "задайте в каждой строке по клетке на столбец; клетку с разделителем внутри берут в кавычки",
    )
    .into()
}

fn no_column(sheet: &Sheet, name: &str) -> Failure {
    let columns = sheet.header.iter().map(|h| h.0.as_str()).collect::<Vec<_>>().join(", ");
    misfit(sheet, (format!("there is no column `{name}`; there are {columns}"), format!("нет столбца `{name}`; есть {columns}")))
}

fn foreign_column(sheet: &Sheet, name: &str, model: &Model) -> Failure {
    let names = model.parameters.iter().map(|p| p.name.as_str()).chain(model.coordinates.iter().map(|c| c.name.as_str()));
    let near = nearest(name, names);
    let (what, place) = (
        (format!("the column `{name}` is no parameter or coordinate"), format!("столбец `{name}` — не параметр и не координата")),
        &sheet.place,
    );
    let trouble = Notice::new("C022", format!("{place}: {}", what.0), format!("{place}: {}", what.1));
    match near {
        Some(near) => trouble.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
        None => trouble.help(
            "name the columns that count: columns = [\"m\", \"c\"] under [variants]",
            "перечислите нужные столбцы: columns = [\"m\", \"c\"] в [variants]",
        ),
    }
    .into()
}

#[cfg(test)]
mod tests {
    use super::*;

    const MODEL: &str = "[parameters]\nm = \"1 kg\"\nF = \"5 N\"\nN = 0\n[coordinates]\nx = \"m\"\n[bodies.b]\norigin = [\"x\", 0]\nmass = \"m\"\n[variants]\n";

    fn of(rows: &str, keys: &str, name: &str) -> Result<Vec<(String, String)>, &'static str> {
        let text = format!("{MODEL}rows = \"\"\"\n{rows}\n\"\"\"\n{keys}\n");
        let model = mechanics::read(&text, "m.toml", &[]).unwrap().model;
        overrides(&model, &Source::new("m.toml", &text), name).map_err(|failure| match failure {
            Failure::Trouble(t) | Failure::Misuse(t) => t.code,
            _ => "",
        })
    }
    fn pairs(list: &[(&str, &str)]) -> Vec<(String, String)> {
        list.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect()
    }

    #[test]
    fn a_row_becomes_values_with_units() {
        let rows = "# remark\nvariant,m [g],x',F\n1,200,0.5,\n2,1 kg,0,\"7 N\"";
        assert_eq!(of(rows, "", "1").unwrap(), pairs(&[("m", "200 g"), ("x'", "0.5")]));
        assert_eq!(of(rows, "number = \"N\"", "02").unwrap(), pairs(&[("N", "2"), ("m", "1 kg"), ("x'", "0"), ("F", "7 N")]));
        assert_eq!(of("m;name\n1,5;a", "key = \"name\"", "a").unwrap(), pairs(&[("m", "1,5")]));
        assert_eq!(of("variant,m,x_published\n1,2,3", "columns = [\"m\"]", "1").unwrap(), pairs(&[("m", "2")]));
    }

    #[test]
    fn what_does_not_fit_is_named() {
        assert_eq!(of("variant,m\n1,2", "", "3"), Err("C021"));
        assert_eq!(of("variant,m\n1,2,3", "", "1"), Err("C022"));
        assert_eq!(of("variant,mass\n1,2", "", "1"), Err("C022"));
        assert_eq!(of("variant,m\n1,2", "columns = [\"F\"]", "1"), Err("C022"));
        assert_eq!(of("variant,m\n1,2", "key = \"name\"", "1"), Err("C022"));
        assert_eq!(of("variant,m\na,2", "number = \"N\"", "a"), Err("C022"));
        assert_eq!(of("# nothing", "", "a"), Err("C022"));
        assert_eq!(of("variant,m", "", "a"), Err("C021"));
    }

    #[test]
    fn a_table_that_contradicts_itself_or_holds_no_number_is_refused() {
        assert_eq!(of("variant,m\n1,2\n1.0,3", "", "1"), Err("C022"));
        assert_eq!(of("variant,m,m\n1,2,3", "", "1"), Err("C022"));
        assert_eq!(of("variant,variant,m\n1,2,3", "columns = [\"m\"]", "1"), Err("C022"));
        // the other variants are not asked for, nor are columns that do not count
        assert_eq!(of("variant,m\n1,2\n1,3\n2,5", "", "2").unwrap(), pairs(&[("m", "5")]));
        assert_eq!(of("variant,m,note,note\n1,2,a,b", "columns = [\"m\"]", "1").unwrap(), pairs(&[("m", "2")]));
        for cell in ["nan", "1e999", "2 s"] {
            assert_eq!(of(&format!("variant,m\n1,{cell}"), "", "1"), Err("C022"), "{cell}");
        }
    }
}
