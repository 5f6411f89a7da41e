//! Variants of a model file: `--variant NAME` takes one, as values that replace those of the file; `strutt variants` takes all of them.

use mechanics::Model;
use mechanics::model::{VariantTable, Variants};
use mechanics::variants::{Misfit, Row, Table, row};
use std::ops::RangeInclusive;
use std::path::Path;
use studies::Source;
use studies::failure::Failure;
use studies::failure::Misuse;
use studies::variants::Member;
use words::{Notice, Place, Severity, nearest};

/// What a variant replaces, as with `--set`; the group is that of the command line.
///
/// # Errors
/// The file has no variants (C020), not this one (C021), the table cannot be read (C001 ... C004) or does not fit (C022), a formula needs the group (C068).
pub fn overrides(model: &Model, source: &Source, (name, group): (&str, Option<u32>)) -> Result<Vec<(String, String)>, Failure> {
    let variants = model.variants.as_ref().ok_or_else(|| none(source))?;
    let Some((place, table)) = table(variants, source)? else {
        let number = name.trim().parse::<u32>().ok().filter(|n| numbers(variants).contains(n));
        let number = number.ok_or_else(|| unknown(&source.path, name, numbers(variants).map(|n| n.to_string()).collect()))?;
        return Ok(of_number(model, variants, number, group)?.overrides);
    };
    let misfit = |fault| misfit(&place, fault);
    let at = table.only_row(name).map_err(misfit)?;
    let at = at.ok_or_else(|| unknown(&place, name, table.names().map(str::to_owned).collect()))?;
    let row = row(model, variants, &table, at).map_err(misfit)?;
    numbered(variants, &table, (at, &place))?;
    for cell in &row.cells {
        cell_fits(&place, table.lines[at], cell, source)?;
    }
    Ok(member(model, variants, name, (row, group))?.overrides)
}

fn member(model: &Model, variants: &Variants, name: &str, (row, group): (Row, Option<u32>)) -> Result<Member, Notice> {
    Member::new(model, variants, name, (row.cells, row.helpers, row.number), group)
}

fn of_number(model: &Model, variants: &Variants, number: u32, group: Option<u32>) -> Result<Member, Notice> {
    member(model, variants, &number.to_string(), (Row { number: f64::from(number), ..Row::default() }, group))
}

/// The numbers of variants that formulas alone make.
fn numbers(variants: &Variants) -> std::ops::RangeInclusive<u32> {
    variants.range.map_or(RangeInclusive::new(1, 0), |[first, last]| first..=last)
}

/// A parameter that gets the number of the variant needs one.
fn numbered(variants: &Variants, table: &Table, (at, place): (usize, &str)) -> Result<(), Failure> {
    let name = &table.rows[at][table.key];
    match variants.number.as_ref().filter(|p| !table.header.iter().any(|(column, _)| column == *p)) {
        Some(parameter) if name.replace(',', ".").parse::<f64>().is_err() => Err(misfit(
            place,
            Misfit::new(
                format!("`{name}` is no number, which {parameter} needs"),
                format!("`{name}` — не число, а оно нужно для {parameter}"),
            ),
        )),
        _ => Ok(()),
    }
}

/// Variants by name, each computed or with what prevents it.
pub type Members = Vec<(String, Result<Member, Notice>)>;

/// Every variant of a file, in its order: what it replaces, or why it cannot be made. A file without variants is one variant.
///
/// # Errors
/// The table cannot be read (C001 ... C004) or is none (C022).
pub fn members(model: &Model, source: &Source, group: Option<u32>) -> Result<Members, Failure> {
    let Some(variants) = &model.variants else {
        return Ok(vec![("1".to_owned(), Ok(Member { name: "1".to_owned(), ..Member::default() }))]);
    };
    let Some((place, table)) = table(variants, source)? else {
        return Ok(numbers(variants).map(|n| (n.to_string(), of_number(model, variants, n, group))).collect());
    };
    let one = |at: usize| {
        let name = table.rows[at][table.key].as_str();
        let fits = || -> Result<Member, Failure> {
            table.only_row(name).map_err(|fault| misfit(&place, fault))?;
            numbered(variants, &table, (at, &place))?;
            let row = row(model, variants, &table, at).map_err(|fault| misfit(&place, fault))?;
            Ok(member(model, variants, name, (row, group))?)
        };
        (name.to_owned(), fits().map_err(studies::variants::solve::reason))
    };
    Ok((0..table.rows.len()).map(one).collect())
}

/// The table when it is a file of its own, as a path.
pub fn file(model: &Model, source: &Source) -> Option<String> {
    match model.variants.as_ref()?.table.as_ref()? {
        VariantTable::Text(_) => None,
        VariantTable::File(file) => Some(beside(source, file)),
    }
}

fn beside(source: &Source, file: &str) -> String {
    let folder = Path::new(&source.path).parent().unwrap_or(Path::new(""));
    folder.join(file).to_string_lossy().into_owned()
}

/// A cell is read as --set would read it; what is wrong with it is said of its place in the table.
fn cell_fits(place: &str, line: usize, pair: &(String, String), source: &Source) -> Result<(), Failure> {
    let Err(found) = studies::read(source, std::slice::from_ref(pair)) else { return Ok(()) };
    let own = found.into_iter().find(|d| d.severity == Severity::Error && matches!(d.place, Place::Override { .. }));
    let Some(wrong) = own else { return Ok(()) };
    let (column, what) = (&pair.0, &wrong.what);
    let mut trouble = Notice::new(
        "C022",
        format!("{place}, line {line}, column `{column}`: {}", what.en),
        format!("{place}, строка {line}, столбец `{column}`: {}", what.ru),
    );
    (trouble.why, trouble.help) = (wrong.why.clone(), wrong.help.clone());
    Err(trouble.into())
}

/// The names of all variants, in their order; none when the file has none.
///
/// # Errors
/// The table cannot be read (C001 ... C004) or is none (C022).
pub fn names(model: &Model, source: &Source) -> Result<Vec<String>, Failure> {
    let Some(variants) = &model.variants else { return Ok(Vec::new()) };
    Ok(match table(variants, source)? {
        Some((_, table)) => table.names().map(str::to_owned).collect(),
        None => numbers(variants).map(|n| n.to_string()).collect(),
    })
}

/// The table of a file and what messages call it.
fn table(variants: &Variants, source: &Source) -> Result<Option<(String, Table)>, Failure> {
    let (place, text) = match &variants.table {
        None => return Ok(None),
        Some(VariantTable::Text(text)) => (source.path.clone(), text.clone()),
        Some(VariantTable::File(file)) => {
            let path = beside(source, file);
            (path.clone(), crate::source::open(&path)?.text)
        }
    };
    let table = Table::parse(&text, variants.key.as_deref()).map_err(|fault| misfit(&place, fault))?;
    Ok(Some((place, table)))
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

fn unknown(place: &str, name: &str, names: Vec<String>) -> Failure {
    let list = names.iter().take(60).cloned().collect::<Vec<_>>().join(", ");
    let trouble = Notice::new("C021", format!("there is no variant `{name}` in {place}"), format!("нет варианта `{name}` в {place}"));
    let trouble = match names.is_empty() {
        true => trouble.why("the table has no rows", "в таблице нет строк"),
        false => trouble.why(format!("there are: {list}"), format!("есть: {list}")),
    };
    match nearest(name, names.iter().map(String::as_str)).filter(|_| name.trim().parse::<f64>().is_err()) {
        Some(near) => trouble.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
        None => trouble,
    }
    .misuse()
}

fn misfit(place: &str, fault: Misfit) -> Failure {
    let mut trouble = Notice::new("C022", format!("{place}: {}", fault.what.en), format!("{place}: {}", fault.what.ru));
    trouble.help = fault.help;
    trouble.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    const MODEL: &str = "[parameters]\nm = \"1 kg\"\nF = \"5 N\"\nN = 0\n[coordinates]\nx = \"m\"\n[bodies.b]\norigin = [\"x\", 0]\nmass = \"m\"\n[variants]\n";

    fn of(rows: &str, keys: &str, name: &str) -> Result<Vec<(String, String)>, &'static str> {
        let text = format!("{MODEL}rows = \"\"\"\n{rows}\n\"\"\"\n{keys}\n");
        let model = mechanics::read(&text, "m.toml", &[]).unwrap().model;
        overrides(&model, &Source::new("m.toml", &text), (name, None)).map_err(|failure| match failure {
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
