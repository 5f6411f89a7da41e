//! The values of one variant: cells of a row, then formulas of the file over them.

use super::misfit::Misfit;
use super::table::Table;
use crate::model::{Class, EmptyCell, Helper, Model, ParameterValue, Values, Variants};
use crate::units::{Dimension, parse_number_or_quantity, parse_quantity, parse_unit};
use symbolic::{Expr, SymbolId};

/// Words for a part that a variant does not have.
const ABSENT: [&str; 8] = ["absent", "none", "отсутствует", "отсутств.", "нет", "-", "–", "—"];

/// What a row says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    /// Values of parameters, starts and rates as `--set` takes them, with their column and as the table has them.
    pub cells: Vec<(String, String)>,
    /// Columns that only formulas use, SI.
    pub helpers: Vec<(SymbolId, f64)>,
    /// Number of the variant: its name where that is a number, else its place.
    pub number: f64,
}

/// What a variant begins with, SI.
#[derive(Clone, Debug, Default)]
pub struct Given {
    /// Values of parameters, starts and rates.
    pub values: Vec<(String, f64)>,
    /// Columns that only formulas use.
    pub helpers: Vec<(SymbolId, f64)>,
    /// n.
    pub group: Option<f64>,
    /// N.
    pub number: f64,
}

/// The cells of a row that count. An empty cell of a quantity of the model keeps the value of the file unless the file says otherwise.
///
/// # Errors
/// The table does not fit the model, a cell is no number.
pub fn row(model: &Model, variants: &Variants, table: &Table, at: usize) -> Result<Row, Misfit> {
    let used = table.used(model)?;
    let cells = &table.rows[at];
    let number = cells[table.key].replace(',', ".").parse().unwrap_or((at + 1) as f64);
    let mut row = Row { number, ..Row::default() };
    for i in used {
        let (name, unit) = &table.header[i];
        let unit = unit.as_ref().or_else(|| variants.units.iter().find(|(n, _)| n == name).map(|(_, unit)| unit));
        row.cells.extend(cell(&cells[i], unit, variants.empty).map(|text| (name.clone(), text)));
    }
    for helper in &variants.helpers {
        let i = table.column(&helper.name)?;
        let value = number_of(helper, &cells[i], (table.header[i].1.as_deref(), variants.empty));
        let place = |misfit: Misfit| Misfit {
            what: words::Text::new(
                format!("line {}, column `{}`: {}", table.lines[at], helper.name, misfit.what.en),
                format!("строка {}, столбец `{}`: {}", table.lines[at], helper.name, misfit.what.ru),
            ),
            ..misfit
        };
        row.helpers.push((helper.symbol, value.map_err(place)?));
    }
    Ok(row)
}

/// A cell as `--set` takes it; none where the value of the file stays.
fn cell(text: &str, unit: Option<&String>, empty: EmptyCell) -> Option<String> {
    if is_absent(text, empty) {
        return Some("0".to_owned());
    }
    let bare = text.chars().all(|c| c.is_ascii_digit() || ".,+-−eE".contains(c));
    match unit {
        _ if text.is_empty() => None,
        Some(unit) if bare => Some(format!("{text} {unit}")),
        _ => Some(text.to_owned()),
    }
}

fn is_absent(text: &str, empty: EmptyCell) -> bool {
    let word = text.to_lowercase();
    ABSENT.contains(&word.as_str()) || text.is_empty() && empty == EmptyCell::Absent
}

fn number_of(helper: &Helper, text: &str, (unit, empty): (Option<&str>, EmptyCell)) -> Result<f64, Misfit> {
    if is_absent(text, empty) {
        return Ok(0.0);
    }
    if text.is_empty() {
        return Err(Misfit::new("the cell is empty", "клетка пуста").help(
            "write the number, or empty = \"absent\" under [variants] where empty cells mean that there is no such part",
            "впишите число или задайте empty = \"absent\" в [variants], если пустая клетка значит, что детали нет",
        ));
    }
    let misfit = |fault: words::Notice| Misfit { what: fault.what.clone(), help: fault.help.clone() };
    let quantity = parse_number_or_quantity(text).map_err(misfit)?;
    if quantity.has_unit {
        return parse_quantity(text, &helper.dimension).map_err(misfit);
    }
    let factor = match unit.map(parse_unit) {
        None => helper.factor,
        Some(Ok(unit)) if unit.dimension.same(&helper.dimension) => unit.factor.to_f64(),
        Some(Ok(_)) => return Err(Misfit::new("the unit of the column has another dimension", "единица столбца имеет другую размерность")),
        Some(Err(fault)) => return Err(misfit(fault)),
    };
    Ok(quantity.to_f64() * factor)
}

/// The value of a cell for a quantity of the model, SI; none where it is a formula.
pub fn si(model: &Model, name: &str, text: &str) -> Option<f64> {
    let base = name.trim_end_matches('\'');
    let parameter = model.parameters.iter().find(|p| p.name == name).map(|p| &p.unit);
    let coordinate = || model.coordinates.iter().find(|c| c.name == base).and_then(|c| c.units.get(name.len() - base.len()));
    let label = parameter.or_else(coordinate)?;
    let dimension = parse_unit(label).map_or(Dimension::NONE, |unit| unit.dimension);
    parse_quantity(text, &dimension).ok().filter(|v| v.is_finite())
}

/// Numbers of all constants, n, N and helper columns where parameters have these values.
pub fn symbols(model: &Model, variants: Option<&Variants>, given: &Given) -> Values {
    let mut known = Values::default();
    if let Some(variants) = variants {
        known.extend(given.group.map(|n| (variants.symbols[0], n)));
        known.insert(variants.symbols[1], given.number);
        known.extend(given.helpers.iter().copied());
    }
    constants(model, &given.values, &mut known);
    known
}

fn constants(model: &Model, values: &[(String, f64)], known: &mut Values) {
    for p in model.parameters.iter().filter(|p| p.class == Class::Constant) {
        let set = values.iter().rev().find(|(name, _)| *name == p.name).map(|(_, value)| *value);
        let value = match (set, p.value) {
            (Some(value), _) => value,
            (None, ParameterValue::Number { .. }) => p.number.unwrap_or(f64::NAN),
            (None, ParameterValue::Formula(formula)) => at(model, formula, known),
        };
        known.insert(p.symbol, value);
    }
}

fn at(model: &Model, formula: Expr, known: &Values) -> f64 {
    let value = |s: SymbolId| known.get(&s).copied().unwrap_or(f64::NAN);
    model.graph.evaluate(&[formula], &value)[0]
}

/// The values that formulas of the file give, SI, in the order of their use.
///
/// # Errors
/// A formula has no finite value.
pub fn after_formulas(model: &Model, variants: &Variants, given: &Given) -> Result<Vec<(String, f64)>, Misfit> {
    let mut all = given.clone();
    let mut found = Vec::new();
    for formula in &variants.formulas {
        let value = at(model, formula.value, &symbols(model, Some(variants), &all));
        if !value.is_finite() {
            let (name, number) = (&formula.name, given.number);
            return Err(Misfit::new(
                format!("the formula of `{name}` has no value for N = {number}"),
                format!("формула `{name}` не имеет значения при N = {number}"),
            ));
        }
        all.values.push((formula.name.clone(), value));
        found.push((formula.name.clone(), value));
    }
    Ok(found)
}
