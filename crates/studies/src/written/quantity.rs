//! One line of the calculation: name = formula = the same with its numbers = value with its unit.

use super::work::Work;
use algebra::arrange::Arrange;
use mechanics::model::Class;
use report::document::Formula;
use report::formula::{Bracket, Layout, Printer, Relation, Sign, value};
use symbolic::{Expr, Graph, SymbolId};
use words::Language;

/// Significant digits of a result.
const DIGITS: usize = 6;
/// Terms that a bracket before an acceleration may have on a line that is too long.
const KEPT: usize = 3;

/// A value in print with its unit.
pub(super) fn with_unit(x: f64, unit: &str, language: Language) -> Layout {
    // an arc over a frequency is a time: nobody writes rad·s
    let unit = if matches!(unit, "rad s" | "s rad") { "s" } else { unit };
    let unit = report::unit::print(unit, language);
    let number = value(x, DIGITS, language);
    if unit.is_empty() { number } else { Layout::Row(vec![number, Layout::Words(format!("\u{a0}{unit}"))]) }
}

/// name = {4; 8; 0} with the unit of the name, where the values are numbers; other formulas have it in their letters.
pub(super) fn cases_with_unit(layout: Layout, unit: &str, language: Language) -> Layout {
    let unit = report::unit::print(unit, language);
    let number = |value: &Layout| match value {
        Layout::Number { mantissa, .. } => Some(mantissa != "0"),
        Layout::Sum(terms) => matches!(&terms[..], [(_, Layout::Number { .. })]).then_some(true),
        _ => None,
    };
    let in_numbers = |right: &Layout| match right {
        Layout::Cases(rows) => {
            let found: Vec<Option<bool>> = rows.iter().map(|row| number(&row.value)).collect();
            found.iter().all(Option::is_some) && found.contains(&Some(true))
        }
        other => number(other) == Some(true),
    };
    match layout {
        Layout::Related(left, relation, right) if !unit.is_empty() && in_numbers(&right) => {
            let right = Layout::Row(vec![*right, Layout::Words(format!("\u{a0}{unit}"))]);
            Layout::Related(left, relation, Box::new(right))
        }
        other => other,
    }
}

/// A sum with its unit behind the last term, so that the lines may break between the terms.
pub(super) fn sum_with_unit(layout: Layout, unit: &str, language: Language) -> Layout {
    let unit = report::unit::print(unit, language);
    match layout {
        other if unit.is_empty() => other,
        Layout::Sum(mut terms) => {
            if let Some((sign, last)) = terms.pop() {
                terms.push((sign, Layout::Row(vec![last, Layout::Words(format!(",\u{a0}{unit}"))])));
            }
            Layout::Sum(terms)
        }
        other => Layout::Row(vec![other, Layout::Words(format!("\u{a0}{unit}"))]),
    }
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
    // 0,01 m (50 a + 13 b) is no number times an energy: each term has its own
    if leads_decimal(&layout) {
        return fitted(printer, term_by_term(layout));
    }
    let formula = printer.block(layout);
    let room = formula.width.unwrap_or(usize::MAX);
    if formula.text().lines().all(|line| line.chars().count() <= room) {
        return formula;
    }
    printer.block(term_by_term(formula.layout))
}

/// Whether the right side is a decimal number times a sum.
fn leads_decimal(layout: &Layout) -> bool {
    let decimal = |f: &Layout| matches!(f, Layout::Number { mantissa, exponent: None } if mantissa.contains([',', '.']));
    let sum = |f: &Layout| matches!(f, Layout::Fence(Bracket::Round, inner) if matches!(**inner, Layout::Sum(_)));
    match layout {
        Layout::Related(_, _, right) => leads_decimal(right),
        Layout::Product(factors) => factors.first().is_some_and(decimal) && factors.iter().any(sum),
        Layout::Fraction(above, _) => leads_decimal(above),
        _ => false,
    }
}

/// Numbers as one; none where it is 1.
fn multiplied(numbers: Vec<Layout>) -> Vec<Layout> {
    let parsed = |n: &Layout| match n {
        Layout::Number { mantissa, exponent: None } => mantissa.replace(',', ".").parse::<f64>().ok(),
        _ => None,
    };
    let values: Option<Vec<f64>> = numbers.iter().map(parsed).collect();
    let Some(values) = values.filter(|values| values.len() > 1) else { return numbers };
    let language = if numbers.iter().any(|n| matches!(n, Layout::Number { mantissa, .. } if mantissa.contains(','))) {
        Language::Ru
    } else {
        Language::En
    };
    let whole: f64 = values.iter().product();
    if (whole - 1.0).abs() <= f64::EPSILON { Vec::new() } else { vec![value(whole, DIGITS, language)] }
}

fn term_by_term(layout: Layout) -> Layout {
    match layout {
        Layout::Related(left, relation, right) => Layout::Related(Box::new(opened(*left)), relation, Box::new(term_by_term(*right))),
        Layout::Fraction(above, below) => {
            let parts = if let Layout::Product(factors) = *above { factors } else { vec![*above] };
            distributed(parts, &|term| reduced(term, &below))
        }
        Layout::Product(factors) => distributed(factors, &|term| term),
        other => other,
    }
}

/// A left side whose brackets of many terms, which no line break could part, are opened: (a + b + ...) x'' as a x'' + b x'' + ...
fn opened(left: Layout) -> Layout {
    let long =
        |f: &Layout| matches!(f, Layout::Fence(Bracket::Round, inner) if matches!(&**inner, Layout::Sum(terms) if terms.len() > KEPT));
    let terms = if let Layout::Sum(terms) = left { terms } else { vec![(Sign::Plus, left)] };
    let mut out = Vec::with_capacity(terms.len());
    for (sign, term) in terms {
        match term {
            Layout::Product(factors) if factors.iter().any(long) => match distributed(factors, &|part| part) {
                Layout::Sum(parts) => {
                    out.extend(parts.into_iter().map(|(own, part)| (if own == sign { Sign::Plus } else { Sign::Minus }, part)));
                }
                other => out.push((sign, other)),
            },
            other => out.push((sign, other)),
        }
    }
    match &out[..] {
        [(Sign::Plus, _)] => out.remove(0).1,
        _ => Layout::Sum(out),
    }
}

/// above/below with the whole numbers in front as small as they can be: 6 m/2 is 3 m.
fn reduced(above: Layout, below: &Layout) -> Layout {
    let whole = |layout: &Layout| match layout {
        Layout::Number { mantissa, exponent: None } => mantissa.parse::<u64>().ok().filter(|n| *n > 0),
        _ => None,
    };
    let digits = |n: u64| Layout::Number { mantissa: n.to_string(), exponent: None };
    // a fraction over a number is a fraction over the product
    if let (Layout::Fraction(inner, under), Some(d)) = (&above, whole(below)) {
        if let Some(more) = whole(under) {
            return reduced((**inner).clone(), &digits(d * more));
        }
        let listed = |layout: &Layout| match layout {
            Layout::Product(list) => list.clone(),
            other => vec![other.clone()],
        };
        let (above, under) = match reduced((**inner).clone(), &digits(d)) {
            // what a number is put before needs its bracket
            Layout::Fraction(above, left) => (*above, std::iter::once(*left).chain(listed(under).into_iter().map(fenced)).collect()),
            above => (above, listed(under)),
        };
        return Layout::Fraction(Box::new(above), Box::new(product(multiplied_first(under))));
    }
    let mut factors = if let Layout::Product(factors) = above { factors } else { vec![above] };
    let (Some(n), Some(d)) = (factors.first().and_then(whole), whole(below)) else {
        return Layout::Fraction(Box::new(product(factors)), Box::new(below.clone()));
    };
    let common = (1..=n.min(d)).rev().find(|k| n % k == 0 && d % k == 0).unwrap_or(1);
    match n / common {
        1 if factors.len() > 1 => drop(factors.remove(0)),
        rest => factors[0] = digits(rest),
    }
    match d / common {
        1 => product(factors),
        rest => Layout::Fraction(Box::new(product(factors)), Box::new(digits(rest))),
    }
}

/// A sum in its bracket, as a factor has it.
fn fenced(factor: Layout) -> Layout {
    match factor {
        sum @ Layout::Sum(_) => Layout::Fence(Bracket::Round, Box::new(sum)),
        other => other,
    }
}

/// 2·3 √a as 6 √a: whole numbers at the front of a product as one.
fn multiplied_first(factors: Vec<Layout>) -> Vec<Layout> {
    let numbers = factors.iter().take_while(|f| matches!(f, Layout::Number { .. })).count();
    let mut head = factors;
    let tail = head.split_off(numbers);
    multiplied(head).into_iter().chain(tail).collect()
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
    let one = |term: Layout| match parted(term) {
        (above, Some(below)) => finish(Layout::Fraction(Box::new(joined(&factors, above)), Box::new(below))),
        (above, None) => finish(joined(&factors, above)),
    };
    Layout::Sum(terms.into_iter().map(|(sign, term)| (sign, one(term))).collect())
}

/// The factors of a term, and what they stand over.
fn parted(term: Layout) -> (Vec<Layout>, Option<Layout>) {
    let factors = |layout: Layout| if let Layout::Product(inner) = layout { inner } else { vec![layout] };
    match term {
        Layout::Fraction(above, below) => (factors(*above), Some(*below)),
        // a fraction with functions behind it
        Layout::Product(mut inner) if matches!(inner.first(), Some(Layout::Fraction(..))) => match inner.remove(0) {
            Layout::Fraction(above, below) => (factors(*above).into_iter().chain(inner).collect(), Some(*below)),
            other => (std::iter::once(other).chain(inner).collect(), None),
        },
        other => (factors(other), None),
    }
}

/// Common factors and those of a term in the order of print: the number, constants, rates, functions.
fn joined(common: &[Layout], own: Vec<Layout>) -> Layout {
    let rank = |f: &Layout| match f {
        Layout::Number { .. } => 0,
        Layout::Symbol(symbol) => 1 + u8::from(symbol.primes > 0),
        Layout::Power(base, _) => match &**base {
            Layout::Symbol(symbol) => 1 + u8::from(symbol.primes > 0),
            _ => 1,
        },
        Layout::Call { .. } => 3,
        _ => 1,
    };
    let mut all: Vec<Layout> = common.iter().cloned().chain(own).collect();
    all.arrange_by_key(rank);
    let letters = all.split_off(all.iter().take_while(|f| rank(f) == 0).count());
    product(multiplied(all).into_iter().chain(letters).collect())
}

fn product(mut factors: Vec<Layout>) -> Layout {
    match factors.len() {
        0 => Layout::Number { mantissa: "1".into(), exponent: None },
        1 => factors.remove(0),
        _ => Layout::Product(factors),
    }
}

/// name = formula = substitution = value unit, the numbers those of the parameters.
pub(super) fn line(work: &Work, (name, unit): (Layout, &str), (graph, formula): (&Graph, Expr)) -> Formula {
    line_at(work, (name, unit), (graph, formula), &values(work))
}

/// The same with these numbers of the symbols.
pub(super) fn line_at(work: &Work, (name, unit): (Layout, &str), (graph, formula): (&Graph, Expr), values: &[(SymbolId, f64)]) -> Formula {
    let known = |s: SymbolId| values.iter().find(|(known, _)| *known == s).map_or(f64::NAN, |(_, value)| *value);
    let number = graph.evaluate(&[formula], &known)[0];
    let mut parts = vec![name, work.printer.layout(graph, formula)];
    // what changes with time has no number
    if !number.is_finite() {
        return chain(&work.printer, parts);
    }
    let result = with_unit(number, unit, work.language);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fraction_written_term_by_term_is_in_its_lowest_terms() {
        let number = |n: &str| Layout::Number { mantissa: n.into(), exponent: None };
        let letter = |name: &str| Layout::Symbol(Printer::new(Language::En).named(name));
        let shown = |n: &str, d: &str| Formula::inline(reduced(Layout::Product(vec![number(n), letter("m")]), &number(d))).text();
        assert_eq!(shown("6", "2"), "3 m");
        assert_eq!(shown("9", "2"), "9 m/2");
        assert_eq!(shown("2", "2"), "m");
        assert_eq!(shown("4", "6"), "2 m/3");
        let nested = Layout::Fraction(Box::new(Layout::Product(vec![letter("m"), letter("r")])), Box::new(number("2")));
        assert_eq!(Formula::inline(reduced(nested, &number("2"))).text(), "m r/4");
        let over = |n: &str, under: Layout| {
            let above = Layout::Product(vec![number(n), letter("m"), letter("r")]);
            Formula::inline(reduced(Layout::Fraction(Box::new(above), Box::new(under)), &number("2"))).text()
        };
        assert_eq!(over("2", letter("l")), "m r/l");
        assert_eq!(over("3", letter("l")), "3 m r/(2 l)");
        assert_eq!(over("3", Layout::Product(vec![number("5"), letter("l")])), "3 m r/(10 l)");
        let sum = || Layout::Sum(vec![(Sign::Plus, letter("l")), (Sign::Minus, letter("b"))]);
        assert_eq!(over("3", sum()), "3 m r/(2 (l − b))");
        assert_eq!(over("2", sum()), "m r/(l − b)");
    }

    #[test]
    fn brackets_of_many_terms_are_opened_on_the_left() {
        let printer = Printer::new(Language::En);
        let letter = |name: &str| Layout::Symbol(printer.named(name));
        let left = |names: &[&str]| {
            let sum = names.iter().map(|name| (if *name == "c" { Sign::Minus } else { Sign::Plus }, letter(name))).collect();
            let product = Layout::Product(vec![Layout::Fence(Bracket::Round, Box::new(Layout::Sum(sum))), letter("x")]);
            Layout::Sum(vec![(Sign::Minus, product), (Sign::Plus, letter("y"))])
        };
        let shown = |layout: Layout| Formula::inline(layout).text();
        assert_eq!(shown(opened(left(&["a", "b", "c", "d"]))), "−x a − x b + x c − x d + y");
        assert_eq!(shown(opened(left(&["a", "b", "c"]))), "−(a + b − c) x + y");
    }

    #[test]
    fn a_decimal_before_a_sum_goes_into_its_terms() {
        let number = |n: &str| Layout::Number { mantissa: n.into(), exponent: None };
        let printer = Printer::new(Language::Ru);
        let letter = |name: &str| Layout::Symbol(printer.named(name));
        let sum = Layout::Sum(vec![
            (Sign::Plus, Layout::Product(vec![number("50"), letter("a")])),
            (Sign::Minus, Layout::Product(vec![number("13"), letter("b")])),
        ]);
        let right = Layout::Product(vec![number("0,01"), letter("m"), Layout::Fence(Bracket::Round, Box::new(sum))]);
        let layout = Layout::Related(Box::new(letter("T")), Relation::Equal, Box::new(right));
        assert_eq!(fitted(&printer, layout).text(), "T = 0,5 m a − 0,13 m b");
    }

    #[test]
    fn constants_over_a_switch_carry_the_unit_and_formulas_do_not() {
        let number = |n: &str| Layout::Number { mantissa: n.into(), exponent: None };
        let letter = |name: &str| Layout::Symbol(Printer::new(Language::En).named(name));
        let cases = |values: [Layout; 2]| {
            let rows = values.map(|value| report::formula::Row { value, condition: letter("t") });
            Layout::Related(Box::new(letter("M")), Relation::Equal, Box::new(Layout::Cases(rows.to_vec())))
        };
        let shown = |layout: Layout| Formula::inline(cases_with_unit(layout, "N m", Language::Ru)).text();
        assert!(shown(cases([number("4"), number("0")])).ends_with("Н·м"));
        assert!(!shown(cases([letter("a"), number("0")])).contains("Н·м"));
        assert!(!shown(cases([number("0"), number("0")])).contains("Н·м"));
    }
}
