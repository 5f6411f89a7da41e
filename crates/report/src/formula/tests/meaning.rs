//! A printed formula means what the expression means: the layout is evaluated as a reader would and compared.

use super::book::shaft;
use super::random::{Dice, NAMES, grow};
use crate::formula::{Bracket, Identifier, Layout, Printer, Relation, Sign};
use symbolic::{Expr, Function, Graph};

/// The value of a symbol, from what is printed of it.
fn symbol(identifier: &Identifier) -> f64 {
    if identifier.base == "π" {
        return std::f64::consts::PI;
    }
    let index = identifier.subscript.iter().flat_map(|i| i.text.bytes());
    let sum = identifier.base.bytes().chain(index).fold(u64::from(identifier.primes) * 7, |sum, b| sum * 31 + u64::from(b));
    0.3 + (sum % 1009) as f64 / 800.0
}

/// `None` where digits were cut.
fn value(layout: &Layout) -> Option<f64> {
    Some(match layout {
        Layout::Number { mantissa, exponent } => {
            let (n, d) = mantissa.split_once('/').unwrap_or((mantissa, "1"));
            n.parse::<f64>().ok()? / d.parse::<f64>().ok()? * 10f64.powi(exponent.unwrap_or(0))
        }
        Layout::Symbol(identifier) => symbol(identifier),
        Layout::Words(_) | Layout::Row(_) | Layout::List(..) => return None,
        Layout::Sum(terms) => {
            let mut sum = 0.0;
            for (sign, body) in terms {
                sum += if *sign == Sign::Minus { -value(body)? } else { value(body)? };
            }
            sum
        }
        Layout::Product(factors) => factors.iter().map(value).product::<Option<f64>>()?,
        Layout::Fraction(above, below) => value(above)? / value(below)?,
        Layout::Power(base, exponent) => value(base)?.powf(value(exponent)?),
        Layout::Exponential(argument) => value(argument)?.exp(),
        Layout::Root { degree, radicand } => value(radicand)?.powf(1.0 / f64::from(*degree)),
        Layout::Fence(Bracket::Round, inner) => value(inner)?,
        Layout::Fence(Bracket::Bar, inner) => value(inner)?.abs(),
        Layout::Call { name, power, argument, .. } => {
            let (x, y) = match &**argument {
                Layout::List(items, _) => (value(&items[0])?, value(&items[1])?),
                one => (value(one)?, 0.0),
            };
            let plain = match *name {
                "arcsin" => "asin",
                "arccos" => "acos",
                "arctan" => "atan",
                "ln" => "log",
                "arsinh" => "asinh",
                "arcosh" => "acosh",
                "artanh" => "atanh",
                other => other,
            };
            let exponent = power.as_ref().map_or(1, |p| p.parse().unwrap());
            Function::from_name(plain).unwrap().value(x, y).powi(exponent)
        }
        Layout::Related(left, relation, right) => {
            let (left, right) = (value(left)?, value(right)?);
            f64::from(match relation {
                Relation::Equal => left == right,
                Relation::Less => left < right,
                Relation::LessEqual => left <= right,
                Relation::Greater => left > right,
                Relation::GreaterEqual => left >= right,
            })
        }
        Layout::Cases(rows) => {
            let last = rows.len() - 1;
            for (i, row) in rows.iter().enumerate() {
                if i == last || value(&row.condition)? == 1.0 {
                    return value(&row.value);
                }
            }
            return None;
        }
    })
}

/// Number of comparisons made (0 or 1).
fn compare(graph: &Graph, printer: &Printer, e: Expr) -> usize {
    let expected = graph.evaluate(&[e], &|id| symbol(&printer.identifier(graph.symbol_info(id))))[0];
    let Some(shown) = value(&printer.layout(graph, e)) else { return 0 };
    if !expected.is_finite() || expected.abs() > 1e9 || !shown.is_finite() {
        return 0;
    }
    // the two sums are taken in different orders; an ill-conditioned one may lose half of the digits
    let close = (shown - expected).abs() <= 1e-7 * (1.0 + expected.abs());
    assert!(close, "{shown} instead of {expected}: {}", printer.expression(graph, e, crate::formula::Form::Text));
    1
}

#[test]
fn printing_keeps_the_value() {
    let mut dice = Dice(0xfeed);
    let mut compared = 0;
    for _ in 0..150 {
        let (mut graph, printer) = shaft();
        let mut pool = vec![graph.one()];
        for name in NAMES {
            pool.push(graph.var(name));
        }
        for _ in 0..25 {
            let e = grow(&mut graph, &mut dice, &pool);
            pool.push(e);
            compared += compare(&graph, &printer, e);
        }
    }
    assert!(compared > 2000, "only {compared} of 3750 values were finite");
}
