//! Equations and formulas at random states, and the words for the term that differs.

use super::laid::{Laid, Terms, output_name};
use super::verdict::Verdict;
use crate::machine::Machine;
use analysis::System;
use analysis::made;
use analysis::studies::claims::{Draw, Fit, Places, Sum, fit};
use mechanics::model::ClaimDecl;
use report::formula::{Form, Printer};
use symbolic::{Expr, Node, Rational};
use words::{Language, Text};

/// Times at which a machine is tried lie within this many seconds: loads that depend on time take part.
const SPAN: f64 = 10.0;
const SEED: u64 = 41;
/// A deviation below this is rounding.
const SAME: f64 = 1e-12;

/// All outputs at random states, enough for the longest of the claims.
///
/// # Errors
/// The machine has no regular state nearby.
pub fn drawn(laid: &mut Laid) -> Result<Vec<Vec<f64>>, Text> {
    let longest = laid.claims.iter().map(|terms| terms.terms.len()).max().unwrap_or(0);
    let count = 3 * (longest + 1) + 12;
    let of_rates = laid.machine.equations.conditions.iter().any(|c| c.place.is_none());
    let places = if of_rates { Places::Carried } else { Places::Anywhere };
    let system = &mut laid.machine.system;
    let rows = system.start().and_then(|start| (made::SAMPLES)(system, &start, Draw { end: SPAN, count, places, seed: SEED }));
    rows.map_err(|fault| fault.what.clone())
}

/// Compares a claim with the machine at these states.
pub fn judge(laid: &mut Laid, (number, claim): (usize, &ClaimDecl), rows: &[Vec<f64>], verdict: &mut Verdict) {
    let terms = laid.claims[number].clone();
    let system = &laid.machine.system;
    let names: Vec<&str> = system.outputs().iter().map(|q| q.name.as_str()).collect();
    let place = |k: usize| names.iter().position(|n| *n == output_name(number, k));
    let column = |k: usize| -> Vec<f64> {
        let i = place(k);
        rows.iter().map(|row| i.and_then(|i| row.get(i)).copied().unwrap_or(f64::NAN)).collect()
    };
    let n = terms.terms.len();
    let values: Vec<Vec<f64>> = (0..n).map(column).collect();
    let target = terms.of.map(|_| column(n));
    // an inertia that stands in the claim with another factor is not missing: taken away, the equation would lose it
    let accelerates = |e: Expr| {
        let equations = &laid.machine.equations;
        equations.graph.contains(e, |s| equations.coordinates.iter().any(|c| c.symbols[2] == s))
    };
    let inertias: Vec<&Vec<f64>> = values.iter().zip(&terms.terms).filter(|(_, e)| accelerates(**e)).map(|(column, _)| column).collect();
    let (numbers, others): (Vec<usize>, Vec<Vec<f64>>) = (n..n + terms.others.len())
        .map(|k| (k - n, column(k)))
        .filter(|(k, other)| !accelerates(terms.others[*k]) || !inertias.iter().any(|own| proportional(own, other)))
        .unzip();
    let mut found = fit(Sum { terms: &values, target: target.as_deref(), anchors: &terms.anchors, others: &others });
    found.missing = found.missing.map(|(k, factor)| (numbers[k], factor));
    (verdict.value, verdict.published) = found.worst;
    verdict.deviation = found.deviation;
    verdict.ok = found.holds(claim.tolerance);
    // what is rounding is the same number
    if verdict.ok && found.deviation < SAME {
        verdict.published = verdict.value;
    }
    if !verdict.ok {
        verdict.words = words(&mut laid.machine, &terms, &found, claim.tolerance);
    }
}

/// Whether two terms have one ratio at all states where they have values.
fn proportional(a: &[f64], b: &[f64]) -> bool {
    let pairs = || a.iter().zip(b).filter(|(a, b)| a.is_finite() && b.is_finite());
    let Some((p, q)) = pairs().max_by(|x, y| x.1.abs().total_cmp(&y.1.abs())).filter(|(_, q)| **q != 0.0) else { return false };
    pairs().all(|(a, b)| (a * q - b * p).abs() <= SAME * ((a * q).abs() + (b * p).abs()))
}

/// Which terms differ, and by how much.
fn words(machine: &mut Machine, terms: &Terms, found: &Fit, tolerance: f64) -> Text {
    let mut list: Vec<Text> = Vec::new();
    if let (Some(factors), groups) = (&found.factors, &found.groups) {
        for group in groups.iter().filter(|g| (factors[g[0]] - 1.0).abs() > tolerance) {
            let parts: Vec<Expr> = group.iter().map(|k| terms.terms[*k]).collect();
            let whole = machine.equations.graph.sum(&parts);
            let told = of_term(machine, whole, factors[group[0]]);
            // like terms that the graph joins are one term to the reader
            let several = matches!(machine.equations.graph.node(whole), Node::Sum { .. });
            list.push(if several { alike(&told) } else { told });
        }
    }
    if let Some((k, factor)) = found.missing {
        let scaled = scaled(machine, terms.others[k], factor);
        let [en, ru] = printed(machine, scaled);
        list.push(Text::new(format!("the term {en} is missing on the left"), format!("в левой части нет слагаемого {ru}")));
    }
    if list.is_empty() {
        return Text::new("no single term explains the difference", "расхождение не сводится к отдельным слагаемым");
    }
    let joined = |pick: fn(&Text) -> &str| list.iter().map(pick).collect::<Vec<_>>().join("; ");
    Text::new(joined(|t| &t.en), joined(|t| &t.ru))
}

/// What is said of terms that are proportional to each other at all states: the states do not tell them apart.
fn alike(told: &Text) -> Text {
    Text::new(
        format!("{}; which of these terms differs the motions do not tell: they are proportional to each other", told.en),
        format!("{}; какое из этих слагаемых неверно, по движениям не различить: они пропорциональны друг другу", told.ru),
    )
}

/// `published 20.6 cos φ, here 18.2466 cos φ: 0.885757 of it`.
pub(super) fn of_term(machine: &mut Machine, term: Expr, factor: f64) -> Text {
    let [en, ru] = printed(machine, term);
    // fitted at random states: nine digits are left of sixteen
    if factor.abs() < 1e-9 {
        return Text::new(format!("the term {en} does not exist here"), format!("слагаемого {ru} здесь нет"));
    }
    // as above
    if (factor + 1.0).abs() < 1e-9 {
        return Text::new(format!("the term {en} has the opposite sign here"), format!("слагаемое {ru} здесь имеет обратный знак"));
    }
    let difference = scaled(machine, term, 1.0 - factor);
    let [more_en, more_ru] = printed(machine, difference);
    let share = |language| report::number::short(factor, 6, language);
    Text::new(
        format!("the term {en} is to be multiplied by {}: published less derived is {more_en}", share(Language::En)),
        format!("слагаемое {ru} нужно умножить на {}: разность опубликованного и выведенного равна {more_ru}", share(Language::Ru)),
    )
}

/// factor · e, the factor with six digits.
fn scaled(machine: &mut Machine, e: Expr, factor: f64) -> Expr {
    let factor = Rational::parse_decimal(&format!("{factor:.5e}")).unwrap_or(Rational::ONE);
    machine.equations.graph.scale(e, &factor)
}

fn printed(machine: &Machine, e: Expr) -> [String; 2] {
    [Language::En, Language::Ru].map(|language| Printer::of(&machine.equations, language).inline(&machine.equations.graph, e, Form::Text))
}
