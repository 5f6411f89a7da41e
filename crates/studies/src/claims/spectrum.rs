//! Frequency equations: they vanish at the natural frequencies of the machine, also at those with other values of its parameters, and at no other frequency.
//!
//! With L(ω) = Σ T_k(ω) for left - right, every natural frequency ω_j of the machine gives a row Σ α_k T_k(ω_j) = 0. Values of the parameters are drawn, so that
//! terms with the same power of ω are told apart; the factors α_k name the term that is wrong. An equation with too many or too few roots is found by
//! Π (ω² - ω_j²) / L(ω), which is then no polynomial in ω, or vanishes at a root; where L has quotients it is the product of their denominators.

use super::laid::flat;
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
use symbolic::{Expr, SymbolId};
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

/// The equation at a natural frequency.
struct Row {
    frequency: f64,
    terms: Vec<f64>,
    /// The largest term there.
    largest_beside: f64,
    /// The larger of |L| a tenth below and above: what an equation of one term is measured by.
    beside: f64,
}

impl Row {
    /// Whether a term has a pole there, as the stiffness of one body has in a motion in which that body rests.
    fn is_pole(&self) -> bool {
        self.terms.iter().any(|t| t.abs() > POLE * self.largest_beside)
    }

    /// |L| relative to its largest term.
    fn deviation(&self) -> f64 {
        let sum: f64 = self.terms.iter().sum();
        let largest = self.terms.iter().fold(0.0_f64, |m, t| m.max(t.abs()));
        let size = if self.terms.len() > 1 { largest } else { self.beside };
        if size > 0.0 { sum.abs() / size } else { 0.0 }
    }
}

/// Compares a frequency equation with the natural frequencies. Free motions may be left out, and so may those of a part that nothing couples to the rest: then
/// other values of the parameters leave them out too.
pub fn judge(machine: &mut Machine, claim: &ClaimDecl, verdict: &mut Verdict, watch: &mut Watch) {
    let ClaimKind::FrequencyEquation { left, right, frequency, unknown } = &claim.kind else { return };
    let graph = &mut machine.equations.graph;
    let whole = graph.sub(*left, *right);
    let published = Published { terms: flat(graph, whole), frequency: *frequency, unknown: *unknown };
    let all = match frequencies(machine, watch) {
        Ok(all) => all,
        Err(words) => return verdict.words = words,
    };
    let (sets, laid) = sets(machine, &published, &all, watch);
    let is_root = |row: &Row| row.deviation() <= claim.tolerance;
    let held: Vec<f64> = sets[0].iter().filter(|row| is_root(row)).map(|row| row.frequency).collect();
    let own: Vec<f64> = sets[0].iter().map(|row| row.frequency).collect();
    let as_many = |set: &Vec<Row>| set.iter().filter(|row| is_root(row)).count() == held.len();
    if !held.is_empty() && held.len() < own.len() && sets.iter().all(as_many) {
        // of two parts that have one frequency the equation may be that of one
        let once = if parts(machine) > 1 { distinct(&held) } else { held.clone() };
        if let Some(meant) = [&held, &once].into_iter().find(|list| roots(machine, &published, list) == Roots::These) {
            let rows: Vec<&Row> = sets.iter().flatten().filter(|row| is_root(row)).collect();
            verdict.deviation = rows.iter().fold(0.0, |m, row| m.max(row.deviation()));
            (verdict.value, verdict.published, verdict.ok) = (0.0, 0.0, true);
            verdict.words = of_a_part(meant, &without(&all, meant));
            return;
        }
    }
    let rows: Vec<&Row> = sets.iter().flatten().collect();
    let found = compared(&published, &rows);
    (verdict.value, verdict.published) = found.worst;
    verdict.deviation = found.deviation;
    let vanishes = found.holds(claim.tolerance);
    let roots = if vanishes { roots(machine, &published, &own) } else { Roots::Others };
    verdict.ok = vanishes && roots == Roots::These;
    if verdict.ok {
        verdict.published = verdict.value;
        let mut left = without(&all, &own);
        left.retain(|w| *w > 0.0 || row(machine, &published, (0.0, constants(machine))).deviation() > claim.tolerance);
        verdict.words = match laid {
            Laid::AtOwnValues => only_here(),
            Laid::Anywhere if !left.is_empty() => of_a_part(&own, &left),
            Laid::Anywhere => std::mem::take(&mut verdict.words),
        };
    } else {
        verdict.words = match roots {
            Roots::Fewer => fewer_roots(&own),
            _ if vanishes => other_roots(&own),
            _ => words(machine, &published, (&own, &held), &found, claim.tolerance),
        };
    }
}

/// Each number once; equal frequencies of parts are equal to the digits that roots have.
fn distinct(list: &[f64]) -> Vec<f64> {
    let mut found: Vec<f64> = Vec::new();
    for value in list {
        if !found.iter().any(|known| (known - value).abs() <= SAME * value.abs()) {
            found.push(*value);
        }
    }
    found
}

/// Parts of the machine that no coefficient and no condition couples.
fn parts(machine: &Machine) -> usize {
    let equations = &machine.equations;
    let graph = &equations.graph;
    let n = equations.coordinates.len();
    let mut part: Vec<usize> = (0..n).collect();
    let join = |part: &mut Vec<usize>, i: usize, j: usize| {
        let (from, to) = (part[i].max(part[j]), part[i].min(part[j]));
        part.iter_mut().filter(|p| **p == from).for_each(|p| *p = to);
    };
    for i in 0..n {
        let row: Vec<Expr> = (0..n).filter(|j| *j != i).map(|j| equations.mass.get(i, j)).collect();
        let masses: Vec<usize> = (0..n).filter(|j| *j != i).zip(row).filter(|(_, e)| !graph.is_zero(*e)).map(|(j, _)| j).collect();
        let mut formulas = vec![equations.force[i], equations.mass.get(i, i)];
        formulas.extend(equations.definitions.iter().filter(|d| graph.contains(equations.force[i], |s| s == d.symbol)).map(|d| d.formula));
        let seen = |j: usize| formulas.iter().any(|e| graph.contains(*e, |s| equations.coordinates[j].symbols.contains(&s)));
        let coupled: Vec<usize> = masses.into_iter().chain((0..n).filter(|j| *j != i && seen(*j))).collect();
        coupled.into_iter().for_each(|j| join(&mut part, i, j));
    }
    for condition in &equations.conditions {
        let list: Vec<usize> = condition.columns.iter().map(|(j, _)| *j).collect();
        list.windows(2).for_each(|pair| join(&mut part, pair[0], pair[1]));
    }
    (0..n).filter(|i| part[*i] == *i).count()
}

/// The sum of the terms over all rows; an equation of one term by what it is beside its roots.
fn compared(published: &Published, rows: &[&Row]) -> Fit {
    let n = published.terms.len();
    if n == 1 {
        let worst = rows.iter().max_by(|a, b| a.deviation().total_cmp(&b.deviation()));
        let (deviation, value) = worst.map_or((f64::NAN, f64::NAN), |row| (row.deviation(), row.terms[0]));
        return Fit { deviation, worst: (0.0, value), ..Fit::default() };
    }
    let values: Vec<Vec<f64>> = (0..n).map(|k| rows.iter().map(|row| row.terms[k]).collect()).collect();
    fit(Sum { terms: &values, target: None, anchors: &(0..n).collect::<Vec<_>>(), others: &[] })
}

/// Numbers of a list that are not in another, each as often as it stands there more.
fn without(all: &[f64], taken: &[f64]) -> Vec<f64> {
    let mut left = all.to_vec();
    for value in taken {
        if let Some(at) = left.iter().position(|v| v == value) {
            left.remove(at);
        }
    }
    left
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

/// The rows of the natural frequencies, those of the file first, then of drawn values of its parameters, and whether there are any of these. Free motions have no
/// row where there are others: a factor k² more or less is no mistake.
fn sets(machine: &mut Machine, published: &Published, own: &[f64], watch: &mut Watch) -> (Vec<Vec<Row>>, Laid) {
    let set = |machine: &Machine, list: &[f64], known: &Values| -> Vec<Row> {
        let moving = list.iter().filter(|w| **w > 0.0).count();
        let kept = list.iter().filter(|w| moving == 0 || **w > 0.0);
        let rows: Vec<Row> = kept.map(|w| row(machine, published, (*w, known.clone()))).collect();
        let poles = rows.iter().filter(|r| r.is_pole()).count();
        rows.into_iter().filter(|r| poles == moving || !r.is_pole()).collect()
    };
    let mut sets = vec![set(machine, own, &constants(machine))];
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
        let known = sets.len();
        for _ in 0..draws {
            let values: Vec<(&str, f64)> = named.iter().map(|(name, v)| (name.as_str(), v * random.between(low, high))).collect();
            let Ok(mut other) = machine.with_values(&values) else { continue };
            // formulas of the claim are those of the graph above
            let known = constants(&other);
            if let Ok(list) = frequencies(&mut other, watch) {
                sets.push(set(machine, &list, &known));
            }
        }
        if sets.len() > known || named.is_empty() {
            return (sets, Laid::Anywhere);
        }
    }
    (sets, Laid::AtOwnValues)
}

/// Share of a frequency at which an equation is looked at beside it.
const BESIDE: f64 = 0.1;

/// A term this many times as large as beside it has a pole: no polynomial of a machine's equation falls so fast within a tenth.
const POLE: f64 = 1e8;

fn row(machine: &Machine, published: &Published, (frequency, known): (f64, Values)) -> Row {
    let terms = |w: f64| evaluated(machine, published, (w, known.clone()));
    let sides = [1.0 - BESIDE, 1.0 + BESIDE].map(|share| terms(frequency * share));
    let beside = sides.iter().map(|side| side.iter().sum::<f64>().abs()).fold(0.0, f64::max);
    let largest_beside = sides.iter().flatten().fold(0.0_f64, |m, t| m.max(t.abs()));
    Row { frequency, beside, largest_beside, terms: terms(frequency) }
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
    match roots_of(machine, published, own, |v| v) {
        // magnitudes have no signs
        Roots::Others => roots_of(machine, published, own, f64::abs),
        found => found,
    }
}

fn roots_of(machine: &Machine, published: &Published, own: &[f64], sign: fn(f64) -> f64) -> Roots {
    let mean = own.iter().sum::<f64>() / own.len() as f64;
    let mean = if mean > 0.0 { mean } else { 1.0 };
    let quotient = |u: f64| {
        let sum: f64 = terms_at(machine, published, u * mean).iter().sum();
        let roots: f64 = own.iter().map(|r| u * u - (r / mean) * (r / mean)).product();
        sign(roots / sum)
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

/// The equation is right for some of the frequencies.
fn of_a_part(held: &[f64], left: &[f64]) -> Text {
    let free = left.iter().all(|w| *w == 0.0);
    let of = |language| [listed(held, language), listed(left, language)];
    let ([en, en_left], [ru, ru_left]) = (of(words::Language::En), of(words::Language::Ru));
    if free {
        return Text::new(
            format!("its roots are {en} rad/s; the free motion (0 rad/s) is left out, as is usual"),
            format!("его корни {ru} рад/с; свободное движение (0 рад/с) опущено, как это принято"),
        );
    }
    if left.iter().any(|w| held.iter().any(|h| (h - w).abs() <= SAME * h)) {
        return Text::new(
            format!("its roots are {en} rad/s; {en_left} rad/s belong to parts of the machine that the equation leaves out"),
            format!("его корни {ru} рад/с; {ru_left} рад/с относятся к частям машины, которые уравнение не описывает"),
        );
    }
    Text::new(
        format!(
            "its roots are {en} rad/s; {en_left} rad/s are no roots: they belong to a part of the machine that the equation leaves out"
        ),
        format!("его корни {ru} рад/с; {ru_left} рад/с — не корни: они относятся к части машины, которую уравнение не описывает"),
    )
}

/// Which terms differ; where that cannot be told, the natural frequencies at which the equation does not hold.
fn words(machine: &mut Machine, published: &Published, (own, held): (&[f64], &[f64]), found: &Fit, tolerance: f64) -> Text {
    let mut list: Vec<Text> = Vec::new();
    if let Some(factors) = &found.factors {
        for group in found.groups.iter().filter(|g| (factors[g[0]] - 1.0).abs() > tolerance) {
            let parts: Vec<Expr> = group.iter().map(|k| published.terms[*k]).collect();
            let whole = machine.equations.graph.sum(&parts);
            list.push(of_term(machine, whole, factors[group[0]]));
        }
    }
    let fails = without(own, held);
    if list.is_empty() || !(fails.is_empty() || held.is_empty()) {
        return does_not_hold(&fails, held);
    }
    let joined = |pick: fn(&Text) -> &str| list.iter().map(pick).collect::<Vec<_>>().join("; ");
    Text::new(joined(|t| &t.en), joined(|t| &t.ru))
}

fn does_not_hold(fails: &[f64], held: &[f64]) -> Text {
    let of = |list: &[f64]| [words::Language::En, words::Language::Ru].map(|language| listed(list, language));
    let ([en, ru], [en_held, ru_held]) = (of(fails), of(held));
    if fails.is_empty() {
        return Text::new(
            format!(
                "the equation holds at the natural frequencies {en_held} rad/s for the values of the file alone: with other values of the parameters it does not"
            ),
            format!(
                "уравнение выполняется при собственных частотах {ru_held} рад/с только для значений из файла, при других значениях параметров — нет"
            ),
        );
    }
    let [more_en, more_ru] = match held {
        [] => [String::new(), String::new()],
        _ => [format!("; it holds at {en_held} rad/s"), format!("; при {ru_held} рад/с оно выполняется")],
    };
    Text::new(
        format!("the equation does not hold at the natural frequencies {en} rad/s{more_en}"),
        format!("уравнение не выполняется при собственных частотах {ru} рад/с{more_ru}"),
    )
}
