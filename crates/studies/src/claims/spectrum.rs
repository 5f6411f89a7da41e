//! Frequency equations: they vanish at the natural frequencies of the machine, also at those with other values of its parameters, and at no other frequency.
//!
//! With L(ω) = Σ T_k(ω) for left - right, every natural frequency ω_j of the machine gives a row Σ α_k T_k(ω_j) = 0. Values of the parameters are drawn, so that
//! terms with the same power of ω are told apart; the factors α_k name the term that is wrong. An equation with too many or too few roots is found by
//! Π (ω² - ω_j²) / L(ω), which is then no polynomial in ω, or vanishes at a root; where L has quotients it is the product of their denominators.

use super::laid::{MOST_TERMS, apart};
use super::terms::of_term;
use super::verdict::Verdict;
use crate::machine::Machine;
use crate::small::asked::Modes;
use crate::watch::Watch;
use algebra::elementary;
use algebra::qr::Qr;
use algebra::random::Random;
use analysis::studies::claims::{Fit, Sum, fit};
use mechanics::asked::Asked;
use mechanics::model::{ClaimDecl, ClaimKind, Class, Values};
use mechanics::variants::{Given, symbols};
use symbolic::{Expr, Graph, Node, Rational, SymbolId};
use words::Text;

/// Values of parameters are drawn between these shares of their own; nearer to them where no machine comes to rest that far away: a linkage that does not close, a
/// rope that would push.
const SPREADS: [[f64; 2]; 3] = [[0.8, 1.25], [0.98, 1.02], [0.999, 1.001]];
const SEED: u64 = 73;
/// A frequency below this share of the largest is zero.
const RIGID: f64 = 1e-6;
/// The product of the roots divided by a right equation, at several frequencies, beside a polynomial: rounding of the roots.
const SAME: f64 = 1e-6;
/// Number of frequencies at which both are compared.
const PLACES: usize = 96;
/// Shares of the mean root between which they lie: another root that is meant is no further off than a factor of a hundred.
const WIDEST: [f64; 2] = [1e-2, 1e2];
/// Highest power of ω by which an equation may have been multiplied.
const LOWER: i32 = 4;

/// The equation as a sum, and what its letters mean.
struct Published {
    terms: Vec<Expr>,
    frequency: SymbolId,
    unknown: Option<(SymbolId, Expr)>,
}

/// Compares a frequency equation with the natural frequencies.
pub fn judge(machine: &mut Machine, claim: &ClaimDecl, verdict: &mut Verdict, watch: &mut Watch) {
    let ClaimKind::FrequencyEquation { left, right, frequency, unknown } = &claim.kind else { return };
    let graph = &mut machine.equations.graph;
    let whole = graph.sub(*left, *right);
    let published = Published { terms: flat(graph, whole), frequency: *frequency, unknown: *unknown };
    let own = match frequencies(machine, watch) {
        Ok(own) => own,
        Err(words) => return verdict.words = words,
    };
    let (rows, laid) = rows(machine, &published, &own, watch);
    let values: Vec<Vec<f64>> = (0..published.terms.len()).map(|k| rows.iter().map(|row| row[k]).collect()).collect();
    let anchors: Vec<usize> = (0..published.terms.len()).collect();
    let found = fit(Sum { terms: &values, target: None, anchors: &anchors, others: &[] });
    (verdict.value, verdict.published) = found.worst;
    verdict.deviation = found.deviation;
    let vanishes = found.holds(claim.tolerance);
    let roots = if vanishes { roots(machine, &published, &own) } else { Roots::Others };
    verdict.ok = vanishes && roots == Roots::These;
    if verdict.ok {
        verdict.published = verdict.value;
        if let Laid::AtOwnValues = laid {
            verdict.words = only_here();
        }
    } else {
        verdict.words = match roots {
            Roots::Fewer => fewer_roots(&own),
            _ if vanishes => other_roots(&own),
            _ => words(machine, (&published, &own), &found, claim.tolerance),
        };
    }
}

/// The summands, powers of sums multiplied out: such a power is rounding at its root, and nothing beside it would say of what.
fn flat(graph: &mut Graph, whole: Expr) -> Vec<Expr> {
    let terms = apart(graph, whole);
    let is_power = |(base, exponent): &(Expr, Rational)| exponent.to_f64() > 1.0 && matches!(graph.node(*base), Node::Sum { .. });
    let folded = |e: &Expr| matches!(graph.node(*e), Node::Product { factors, .. } if factors.iter().any(is_power));
    if !terms.iter().any(folded) {
        return terms;
    }
    graph.expanded(whole, MOST_TERMS).map_or(terms, |whole| apart(graph, whole))
}

/// Natural circular frequencies without damping, the smallest first; rigid motions are zero.
fn frequencies(machine: &mut Machine, watch: &mut Watch) -> Result<Vec<f64>, Text> {
    let found = crate::modes::natural(machine, &Modes::of(&Asked::new(crate::modes::KIND.name)), watch);
    if let Some(trouble) = &found.trouble {
        return Err(trouble.what.clone());
    }
    let modes = found.own.get("modes").and_then(serde_json::Value::as_array).cloned().unwrap_or_default();
    let number = |mode: &serde_json::Value, key: &str| mode.get(key).and_then(serde_json::Value::as_f64);
    if modes.iter().any(|m| number(m, "damping_ratio").is_some_and(|d| d != 0.0)) {
        return Err(Text::new(
            "the machine has damping: a frequency equation is that of the machine without it (set its damping to zero)",
            "в машине есть сопротивление: частотное уравнение составляют без него (задайте сопротивление равным нулю)",
        ));
    }
    let mut own: Vec<f64> = modes.iter().filter_map(|m| number(m, "omega")).filter(|w| w.is_finite()).collect();
    own.sort_by(f64::total_cmp);
    let least = RIGID * own.last().copied().unwrap_or(0.0);
    own.iter_mut().filter(|w| **w < least).for_each(|w| *w = 0.0);
    let none = || Text::new("there are no natural frequencies", "собственных частот нет");
    if own.is_empty() { Err(none()) } else { Ok(own) }
}

/// The terms at each natural frequency, with the values of the file and with drawn ones, and whether there are any of these.
fn rows(machine: &mut Machine, published: &Published, own: &[f64], watch: &mut Watch) -> (Vec<Vec<f64>>, Laid) {
    let mut rows: Vec<Vec<f64>> = own.iter().map(|w| terms_at(machine, published, *w)).collect();
    let of_frame: Vec<SymbolId> = machine.equations.mounted.as_ref().map(|m| m.numbers().to_vec()).unwrap_or_default();
    let named: Vec<(String, f64)> = machine
        .model
        .parameters
        .iter()
        // numbers of a frame are none of the file: they follow from the others
        .filter(|p| p.class == Class::Constant && !of_frame.contains(&p.symbol))
        .filter_map(|p| Some((p.name.clone(), p.number.filter(|v| *v != 0.0)?)))
        .collect();
    let draws = (2 * published.terms.len() + 6) / own.len() + 1;
    let mut random = Random::new(SEED);
    for [low, high] in SPREADS {
        let known = rows.len();
        for _ in 0..draws {
            let values: Vec<(&str, f64)> = named.iter().map(|(name, v)| (name.as_str(), v * random.between(low, high))).collect();
            let Ok(mut other) = machine.with_values(&values) else { continue };
            // formulas of the claim are those of the graph above
            let known = constants(&other);
            if let Ok(list) = frequencies(&mut other, watch) {
                rows.extend(list.iter().map(|w| evaluated(machine, published, (*w, known.clone()))));
            }
        }
        if rows.len() > known || named.is_empty() {
            return (rows, Laid::Anywhere);
        }
    }
    (rows, Laid::AtOwnValues)
}

/// With which values of the parameters an equation was compared.
enum Laid {
    /// Also with drawn ones.
    Anywhere,
    /// With those of the file: with none of the others the machine has natural frequencies.
    AtOwnValues,
}

fn constants(machine: &Machine) -> Values {
    symbols(&machine.model, None, &Given::default())
}

fn terms_at(machine: &Machine, published: &Published, frequency: f64) -> Vec<f64> {
    evaluated(machine, published, (frequency, constants(machine)))
}

/// Every term at a frequency with these values of the parameters.
fn evaluated(machine: &Machine, published: &Published, (frequency, mut known): (f64, Values)) -> Vec<f64> {
    let graph = &machine.equations.graph;
    known.insert(published.frequency, frequency);
    let value = |list: &[Expr], known: &Values| graph.evaluate(list, &|s| known.get(&s).copied().unwrap_or(f64::NAN));
    if let Some((symbol, meaning)) = published.unknown {
        let unknown = value(&[meaning], &known)[0];
        known.insert(symbol, unknown);
    }
    value(&published.terms, &known)
}

/// Whether L has the natural frequencies for roots and no others: Π (ω² - ω_j²) / L is then a polynomial in ω, of quotients in L their denominators, but for a power
/// of ω. Another root would be a pole of it, a missing one leaves a factor that the polynomial has anyway and that vanishes at the root.
fn roots(machine: &Machine, published: &Published, own: &[f64]) -> Roots {
    let mean = own.iter().sum::<f64>() / own.len() as f64;
    let mean = if mean > 0.0 { mean } else { 1.0 };
    let quotient = |u: f64| {
        let sum: f64 = terms_at(machine, published, u * mean).iter().sum();
        let roots: f64 = own.iter().map(|r| u * u - (r / mean) * (r / mean)).product();
        roots / sum
    };
    let powers: Vec<i32> = (-LOWER..=2 * own.len() as i32).collect();
    let places: Vec<f64> =
        (0..PLACES).map(|k| WIDEST[0] * elementary::pow(WIDEST[1] / WIDEST[0], (k as f64 + 0.5) / PLACES as f64)).collect();
    let values: Vec<f64> = places.iter().map(|u| quotient(*u)).collect();
    if values.iter().any(|v| !v.is_finite() || *v == 0.0) {
        return Roots::Others;
    }
    // each row relative to its own value, so that four decades count alike
    let entries = |(u, v): (&f64, &f64)| powers.iter().map(|p| elementary::powi(*u, *p) / v).collect::<Vec<f64>>();
    let matrix: Vec<f64> = places.iter().zip(&values).flat_map(entries).collect();
    let (factors, off) = Qr::new(&matrix, PLACES, powers.len()).least_squares(&vec![1.0; PLACES]);
    let value = |u: f64| factors.iter().zip(&powers).map(|(c, p)| c * elementary::powi(u, *p)).sum::<f64>();
    let size = |u: f64| factors.iter().zip(&powers).map(|(c, p)| (c * elementary::powi(u, *p)).abs()).sum::<f64>();
    let missing = own.iter().any(|r| value(r / mean).abs() <= SAME * size(r / mean));
    match (off <= SAME * (PLACES as f64).sqrt(), missing) {
        (false, _) => Roots::Others,
        (true, true) => Roots::Fewer,
        (true, false) => Roots::These,
    }
}

/// The roots of an equation beside the natural frequencies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Roots {
    /// The same, each as often.
    These,
    /// One is missing, or counted too few times.
    Fewer,
    /// There are more, or others.
    Others,
}

fn only_here() -> Text {
    Text::new(
        "compared at the values of the file only: with none of the values drawn beside them does the machine come to rest and oscillate, so how the terms depend on the parameters is not checked",
        "сравнено только при значениях из файла: ни при одном наборе соседних значений машина не приходит в положение равновесия с колебаниями около него, поэтому зависимость слагаемых от параметров не проверена",
    )
}

/// Natural frequencies for a sentence.
fn listed(own: &[f64], language: words::Language) -> String {
    own.iter().map(|w| report::number::short(*w, 5, language)).collect::<Vec<_>>().join("; ")
}

fn fewer_roots(own: &[f64]) -> Text {
    let of = |language| listed(own, language);
    Text::new(
        format!(
            "the equation lacks a root: the natural frequencies are {} rad/s, each as many times as it stands here",
            of(words::Language::En)
        ),
        format!("в уравнении не хватает корня: собственные частоты {} рад/с, каждая с указанной кратностью", of(words::Language::Ru)),
    )
}

fn other_roots(own: &[f64]) -> Text {
    let of = |language| listed(own, language);
    Text::new(
        format!("the equation has other roots besides the natural frequencies {} rad/s", of(words::Language::En)),
        format!("уравнение имеет и другие корни, кроме собственных частот {} рад/с", of(words::Language::Ru)),
    )
}

/// Which terms differ; where that cannot be told, the natural frequencies.
fn words(machine: &mut Machine, (published, own): (&Published, &[f64]), found: &Fit, tolerance: f64) -> Text {
    let mut list: Vec<Text> = Vec::new();
    if let Some(factors) = &found.factors {
        for group in found.groups.iter().filter(|g| (factors[g[0]] - 1.0).abs() > tolerance) {
            let parts: Vec<Expr> = group.iter().map(|k| published.terms[*k]).collect();
            let whole = machine.equations.graph.sum(&parts);
            list.push(of_term(machine, whole, factors[group[0]]));
        }
    }
    if list.is_empty() {
        let of = |language| listed(own, language);
        return Text::new(
            format!("the equation does not hold at the natural frequencies {} rad/s", of(words::Language::En)),
            format!("уравнение не выполняется при собственных частотах {} рад/с", of(words::Language::Ru)),
        );
    }
    let joined = |pick: fn(&Text) -> &str| list.iter().map(pick).collect::<Vec<_>>().join("; ");
    Text::new(joined(|t| &t.en), joined(|t| &t.ru))
}
