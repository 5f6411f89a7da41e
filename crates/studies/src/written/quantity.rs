//! One line of the calculation: name = formula = the same with its numbers = value with its unit.

use super::Work;
use mechanics::model::Class;
use report::document::Formula;
use report::formula::{Layout, Printer, Relation, value};
use symbolic::{Expr, Graph, SymbolId};
use words::Language;

/// Significant digits of a result.
const DIGITS: usize = 6;

/// A value in print with its unit.
pub(super) fn with_unit(x: f64, unit: &str, language: Language) -> Layout {
    let unit = report::unit::print(unit, language);
    let number = value(x, DIGITS, language);
    if unit.is_empty() { number } else { Layout::Row(vec![number, Layout::Words(format!("\u{a0}{unit}"))]) }
}

/// left = a = b = ...; what repeats the part before it is left out.
pub(super) fn chain(printer: &Printer, parts: Vec<Layout>) -> Formula {
    let mut distinct: Vec<Layout> = Vec::with_capacity(parts.len());
    for part in parts {
        if distinct.last() != Some(&part) {
            distinct.push(part);
        }
    }
    let joined = distinct.into_iter().reduce(|left, right| Layout::Related(Box::new(left), Relation::Equal, Box::new(right)));
    printer.block(joined.unwrap_or(Layout::Row(Vec::new())))
}

/// name = formula = substitution = value unit, the numbers those of the parameters.
pub(super) fn line(work: &Work, (name, unit): (Layout, &str), (graph, formula): (&Graph, Expr)) -> Formula {
    line_at(work, (name, unit), (graph, formula), &values(work))
}

/// The same with these numbers of the symbols.
pub(super) fn line_at(work: &Work, (name, unit): (Layout, &str), (graph, formula): (&Graph, Expr), values: &[(SymbolId, f64)]) -> Formula {
    let known = |s: SymbolId| values.iter().find(|(known, _)| *known == s).map_or(f64::NAN, |(_, value)| *value);
    let number = graph.evaluate(&[formula], &known)[0];
    let result = with_unit(number, unit, work.language);
    let mut parts = vec![name, work.printer.layout(graph, formula)];
    if graph.as_symbol(formula).is_none() {
        parts.push(work.printer.clone().with_values(values.to_vec()).layout(graph, formula));
    }
    // a substitution that is the result already takes its unit
    if parts.last().is_some_and(|last| *last == value(number, DIGITS, work.language)) {
        parts.pop();
    }
    parts.push(result);
    chain(&work.printer, parts)
}

/// The number of a formula over parameters; none where something else is in it.
pub(super) fn number(work: &Work, (graph, formula): (&Graph, Expr)) -> Option<f64> {
    let values = values(work);
    let known = |s: SymbolId| values.iter().find(|(known, _)| *known == s).map_or(f64::NAN, |(_, value)| *value);
    Some(graph.evaluate(&[formula], &known)[0]).filter(|v| v.is_finite())
}

/// Parameters with their numbers, those given by formulas too.
fn values(work: &Work) -> Vec<(SymbolId, f64)> {
    let mut known: Vec<(SymbolId, f64)> = work.equations.parameters.iter().map(|p| (p.symbol, p.value)).collect();
    for p in work.model.parameters.iter().filter(|p| p.class == Class::Constant) {
        if let Some(number) = p.number.filter(|_| !known.iter().any(|(symbol, _)| *symbol == p.symbol)) {
            known.push((p.symbol, number));
        }
    }
    known
}
