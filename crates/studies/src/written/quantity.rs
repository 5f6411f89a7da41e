//! One line of the calculation: name = formula = the same with its numbers = value with its unit.

use super::Work;
use mechanics::model::Class;
use report::document::Formula;
use report::formula::{Bracket, Layout, Printer, Relation, Sign, value};
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

/// A formula on a line of its own; a fraction over a long sum, which no line break could part, is written term by term.
pub(super) fn fitted(printer: &Printer, layout: Layout) -> Formula {
    let formula = printer.block(layout);
    let room = formula.width.unwrap_or(usize::MAX);
    if formula.text().lines().all(|line| line.chars().count() <= room) {
        return formula;
    }
    printer.block(term_by_term(formula.layout))
}

fn term_by_term(layout: Layout) -> Layout {
    match layout {
        Layout::Related(left, relation, right) => Layout::Related(left, relation, Box::new(term_by_term(*right))),
        Layout::Fraction(above, below) => {
            let parts = if let Layout::Product(factors) = *above { factors } else { vec![*above] };
            distributed(parts, &|term| Layout::Fraction(Box::new(term), below.clone()))
        }
        Layout::Product(factors) => distributed(factors, &|term| term),
        other => other,
    }
}

/// The factors over the terms of the one sum among them.
fn distributed(mut factors: Vec<Layout>, finish: &dyn Fn(Layout) -> Layout) -> Layout {
    let bracket =
        |f: &Layout| matches!(f, Layout::Fence(Bracket::Round, inner) if matches!(**inner, Layout::Sum(_))) || matches!(f, Layout::Sum(_));
    let Some(at) = factors.iter().position(bracket) else { return finish(product(factors)) };
    let terms = match factors.remove(at) {
        Layout::Sum(terms) => terms,
        Layout::Fence(_, inner) => match *inner {
            Layout::Sum(terms) => terms,
            other => vec![(Sign::Plus, other)],
        },
        other => vec![(Sign::Plus, other)],
    };
    let one = |term: Layout| {
        let more = if let Layout::Product(inner) = term { inner } else { vec![term] };
        // the number of a term stands before everything else
        let (numbers, letters): (Vec<_>, Vec<_>) = more.into_iter().partition(|f| matches!(f, Layout::Number { .. }));
        finish(product(numbers.into_iter().chain(factors.iter().cloned()).chain(letters).collect()))
    };
    Layout::Sum(terms.into_iter().map(|(sign, term)| (sign, one(term))).collect())
}

fn product(mut factors: Vec<Layout>) -> Layout {
    if factors.len() == 1 { factors.remove(0) } else { Layout::Product(factors) }
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
