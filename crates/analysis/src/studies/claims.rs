//! A published formula against a machine, by numbers.
//!
//! A formula is a sum of terms T_k. At random states that keep all connections (and, where these are conditions on rates, that a motion leads to), with the accelerations and reactions that the machine has there, the
//! published equation says Σ T_k = 0, the published formula of a quantity V says Σ T_k = V. Where that fails, the factors α_k of
//!
//! ```text
//! Σ α_k T_k = 0   or   Σ α_k T_k = V
//! ```
//!
//! are found by least squares over the states; an equation may be multiplied by anything, so one of its terms with an acceleration keeps α = 1, the
//! one that leaves most of the others alone. A factor other than 1 names the term that is wrong and what it should be; terms that are proportional to
//! each other at all states (3 x and 2 x) count as one, but for an equation that has no others: there all keep one factor beside the acceleration. Where no factors fit, a term is missing: terms of the machine's own equations are tried one by one.

use crate::studies::simulate::{Grid, Simulate, simulate};
use crate::system::GuardKind;
use crate::{Fault, Mode, System};
use algebra::elementary;
use algebra::qr::Qr;
use algebra::random::Random;

/// What remains of a sum that fits, relative to its terms: rounding of the accelerations.
const ROUNDING: f64 = 1e-9;
const TRIES: usize = 60;
/// The same where each try is a motion.
const FEW_TRIES: usize = 6;
/// States with other rates at the end of one motion.
const RATES: usize = 4;
/// A gap below this is none.
const CLOSED: f64 = 1e-9;

/// How states are drawn.
#[derive(Clone, Copy, Debug)]
pub struct Draw {
    /// Times lie in [0, end], s.
    pub end: f64,
    /// Number of states.
    pub count: usize,
    /// Where their places come from.
    pub places: Places,
    /// Of the random numbers.
    pub seed: u64,
}

/// Where the places of random states come from.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Places {
    /// Anywhere on the surface of the connections.
    Anywhere,
    /// Carried there by a motion from the start: a condition on rates (rolling) says nothing of places, and yet only those are reached that
    /// lie at the end of a motion.
    Carried,
}

/// All outputs at random states; one row a state, fewer rows than asked for where states are hard to find.
///
/// *Errors*: the machine has no regular state nearby.
pub fn samples<S: System + ?Sized>(system: &mut S, start: &[f64], draw: Draw) -> Result<Vec<Vec<f64>>, Fault> {
    let Draw { end, count, places, seed } = draw;
    let mut random = Random::new(seed);
    let (mut rows, mut last) = (Vec::new(), None);
    let wanted: Vec<usize> = (0..system.outputs().len()).collect();
    system.show(&wanted)?;
    let held = held(system, start);
    let tries = if places == Places::Carried { FEW_TRIES } else { TRIES };
    for k in 0..tries * count {
        if rows.len() >= count {
            break;
        }
        // wide first, then nearer to the start, where connections can be met
        let reach = [1.0, 0.3, 0.1][k % 3];
        let found = match places {
            Places::Anywhere => state(system, start, (end, reach, &held), &mut random).map(Vec::from_iter),
            Places::Carried => carried(system, start, &held, &mut random),
        };
        match found {
            Ok(found) => rows.extend(found),
            Err(fault) => last = Some(fault),
        }
    }
    match (rows.is_empty(), last) {
        (true, Some(fault)) => Err(fault),
        _ => Ok(rows),
    }
}

fn state<S: System + ?Sized>(
    system: &mut S,
    start: &[f64],
    (end, reach, held): (f64, f64, &[usize]),
    random: &mut Random,
) -> Result<Option<Vec<f64>>, Fault> {
    let t = random.between(0.0, end);
    let draw = |(quantity, start): (&crate::Quantity, &f64)| {
        let unit = random.between(-1.0, 1.0);
        let size = if quantity.unit == "rad" { std::f64::consts::PI } else { start.abs().max(0.1) };
        start + reach * unit * size
    };
    let mut x: Vec<f64> = system.states().iter().zip(start).map(draw).collect();
    let Some(sides) = modes(system, t, &x, held) else { return Ok(None) };
    system.project(t, &mut x, &sides)?;
    shown(system, (t, held), &x)
}

/// All outputs at a state.
fn shown<S: System + ?Sized>(system: &mut S, (t, held): (f64, &[usize]), x: &[f64]) -> Result<Option<Vec<f64>>, Fault> {
    let Some(sides) = modes(system, t, x, held) else { return Ok(None) };
    let mut values = vec![0.0; system.outputs().len()];
    system.observe(t, x, &sides, &mut values)?;
    Ok(Some(values))
}

/// Contacts and ropes that are closed at the start: a published formula is of the machine as it stands there.
fn held<S: System + ?Sized>(system: &mut S, start: &[f64]) -> Vec<usize> {
    let contacts: Vec<usize> =
        system.guards().iter().enumerate().filter(|(_, g)| matches!(g.kind, GuardKind::Contact { .. })).map(|(i, _)| i).collect();
    if contacts.is_empty() {
        return contacts;
    }
    let all = modes(system, 0.0, start, &contacts);
    let known = all.is_some_and(|all| system.expand(0.0, start, &all, 0).is_ok());
    contacts.into_iter().filter(|i| known && system.guard(*i).first().is_none_or(|gap| gap.abs() <= CLOSED)).collect()
}

/// Modes by the values of the guards, with these contacts closed.
fn modes<S: System + ?Sized>(system: &mut S, t: f64, x: &[f64], held: &[usize]) -> Option<Vec<Mode>> {
    let mut modes = system.modes_by_value(t, x)?;
    for &i in held {
        modes[i] = Mode::Zero;
        if let GuardKind::Contact { force } = system.guards()[i].kind {
            modes[force] = Mode::Positive;
        }
    }
    Some(modes)
}

/// States at the end of a short motion with random rates at its start, each with other random rates there.
fn carried<S: System + ?Sized>(system: &mut S, start: &[f64], held: &[usize], random: &mut Random) -> Result<Vec<Vec<f64>>, Fault> {
    let (n, t) = (system.n_coordinates(), random.between(0.1, 1.0));
    let mut x = start.to_vec();
    if !shaken(system, (0.0, n, held), &mut x, random)? {
        return Ok(Vec::new());
    }
    let names: Vec<String> = system.states().iter().map(|q| q.name.clone()).collect();
    let options = Simulate { grid: Grid::At(vec![t]), ..Simulate::until(t) };
    let data = simulate(system, &x, options).dataset;
    let last = |name: &String| data.column(name).and_then(|c| c.values.last().copied());
    let Some(reached) = names.iter().map(last).collect::<Option<Vec<f64>>>() else { return Ok(Vec::new()) };
    if !reached.iter().all(|v| v.is_finite()) {
        return Ok(Vec::new());
    }
    let wanted: Vec<usize> = (0..system.outputs().len()).collect();
    system.show(&wanted)?;
    let mut found = Vec::new();
    for _ in 0..RATES {
        let mut x = reached.clone();
        // a rope that went slack on the way is drawn taut by moving places: those are not reached
        let stays = |x: &[f64]| x[..n].iter().zip(&reached).all(|(a, b)| (a - b).abs() <= CLOSED * b.abs().max(1.0));
        if shaken(system, (t, n, held), &mut x, random)? && stays(&x) {
            found.extend(shown(system, (t, held), &x)?);
        }
    }
    Ok(found)
}

/// Random rates that keep the connections.
fn shaken<S: System + ?Sized>(
    system: &mut S,
    (t, n, held): (f64, usize, &[usize]),
    x: &mut [f64],
    random: &mut Random,
) -> Result<bool, Fault> {
    x[n..2 * n].iter_mut().for_each(|v| *v += random.between(-1.0, 1.0) * v.abs().max(0.5));
    let Some(sides) = modes(system, t, x, held) else { return Ok(false) };
    system.project(t, x, &sides)?;
    Ok(true)
}

/// How a sum of terms stands to what it should be.
#[derive(Clone, Debug, Default)]
pub struct Fit {
    /// Largest difference at a state, relative to the largest term there.
    pub deviation: f64,
    /// At the state of the largest difference: what it should be, and what the sum says.
    pub worst: (f64, f64),
    /// Factors that make the sum right, one a term; none when they are not unique or none fit.
    pub factors: Option<Vec<f64>>,
    /// Terms that are proportional to each other at all states.
    pub groups: Vec<Vec<usize>>,
    /// The number of a missing term, and its factor.
    pub missing: Option<(usize, f64)>,
}

impl Fit {
    /// Whether the sum is right to this tolerance. A small term that is wrong does not hide behind large ones where the factors are known.
    pub fn holds(&self, tolerance: f64) -> bool {
        match &self.factors {
            Some(factors) => factors.iter().all(|a| (a - 1.0).abs() <= tolerance),
            None => self.deviation <= tolerance,
        }
    }
}

/// What a formula is laid against.
#[derive(Clone, Copy, Debug)]
pub struct Sum<'a> {
    /// Values of its terms: a row a term, a column a state.
    pub terms: &'a [Vec<f64>],
    /// What the sum should be at each state; zero in an equation.
    pub target: Option<&'a [f64]>,
    /// Terms of an equation that may keep their factor.
    pub anchors: &'a [usize],
    /// Values of terms that may be missing.
    pub others: &'a [Vec<f64>],
}

/// Compares a sum with what it should be, and finds the factors that set it right.
pub fn fit(sum: Sum) -> Fit {
    let states = usable(&sum);
    let mut fit = deviation(&sum, &states);
    let groups = groups(sum.terms, &states);
    let weight: Vec<f64> = states.iter().map(|s| 1.0 / scale(&sum, *s).max(f64::MIN_POSITIVE)).collect();
    let columns: Vec<Vec<f64>> = groups.iter().map(|g| weighted(|s| g.iter().map(|k| sum.terms[*k][s]).sum(), &states, &weight)).collect();
    let target = sum.target.map(|v| weighted(|s| v[s], &states, &weight));
    let anchors: Vec<usize> = (0..groups.len()).filter(|i| groups[*i].iter().any(|k| sum.anchors.contains(k))).collect();
    let solve = |columns: &[Vec<f64>]| match &target {
        Some(target) => least_squares(columns, target),
        None => best_anchor(columns, &anchors),
    };
    fit.groups.clone_from(&groups);
    let spread = |factors: &[f64]| {
        let mut all = vec![1.0; sum.terms.len()];
        groups.iter().zip(factors).for_each(|(group, a)| group.iter().for_each(|k| all[*k] = *a));
        all
    };
    if let Some(factors) = solve(&columns) {
        fit.factors = Some(spread(&factors));
        return fit;
    }
    if let Some((anchor, factor)) = (groups.len() == 1 && sum.target.is_none()).then(|| ratio(&sum, &states)).flatten() {
        let (own, others): (Vec<usize>, Vec<usize>) = (0..sum.terms.len()).partition(|k| *k == anchor);
        fit.factors = Some((0..sum.terms.len()).map(|k| if k == anchor { 1.0 } else { factor }).collect());
        fit.groups = vec![own, others];
        return fit;
    }
    fit.missing = missing(&sum, (&columns, &states, &weight), &solve);
    fit
}

/// In an equation whose terms are all proportional to each other (of a single oscillator: x'' follows x) a term that keeps its factor, and that of all others.
fn ratio(sum: &Sum, states: &[usize]) -> Option<(usize, f64)> {
    sum.anchors.iter().find_map(|anchor| {
        let rest = |s: usize| (0..sum.terms.len()).filter(|k| k != anchor).map(|k| sum.terms[k][s]).sum::<f64>();
        let (across, square) = states.iter().fold((0.0, 0.0), |(a, b), s| (a + sum.terms[*anchor][*s] * rest(*s), b + rest(*s) * rest(*s)));
        let factor = -across / square;
        let left = |s: &usize| (sum.terms[*anchor][*s] + factor * rest(*s)).abs() <= ROUNDING * scale(sum, *s);
        (factor.is_finite() && factor != 0.0 && states.iter().all(left)).then_some((*anchor, factor))
    })
}

/// Factors of columns that make a sum right.
type Solve<'a> = dyn Fn(&[Vec<f64>]) -> Option<Vec<f64>> + 'a;

/// The term whose addition makes the sum right and leaves most of the other terms alone, with its factor.
fn missing(sum: &Sum, (columns, states, weight): (&[Vec<f64>], &[usize], &[f64]), solve: &Solve) -> Option<(usize, f64)> {
    let mut best: Option<(usize, (usize, f64))> = None;
    for (number, other) in sum.others.iter().enumerate() {
        let mut more = columns.to_vec();
        more.push(weighted(|s| other[s], states, weight));
        let Some(factors) = solve(&more).filter(|f| f.iter().all(|a| a.is_finite())) else { continue };
        let changed = changed(&factors[..columns.len()]);
        if best.as_ref().is_none_or(|(fewest, _)| changed < *fewest) {
            best = Some((changed, (number, factors[columns.len()])));
        }
    }
    best.map(|(_, found)| found)
}

fn changed(factors: &[f64]) -> usize {
    // six digits: published numbers have fewer
    factors.iter().filter(|a| (*a - 1.0).abs() > 1e-6).count()
}

/// States at which everything has a value.
fn usable(sum: &Sum) -> Vec<usize> {
    let count = sum.terms.first().map_or(0, Vec::len);
    let finite = |s: &usize| sum.terms.iter().all(|t| t[*s].is_finite()) && sum.target.is_none_or(|v| v[*s].is_finite());
    (0..count).filter(finite).collect()
}

/// The largest term at a state.
fn scale(sum: &Sum, s: usize) -> f64 {
    let terms = sum.terms.iter().fold(0.0f64, |m, t| m.max(t[s].abs()));
    terms.max(sum.target.map_or(0.0, |v| v[s].abs()))
}

fn deviation(sum: &Sum, states: &[usize]) -> Fit {
    let mut fit = Fit::default();
    for &s in states {
        let total: f64 = sum.terms.iter().map(|t| t[s]).sum();
        let wanted = sum.target.map_or(0.0, |v| v[s]);
        let size = scale(sum, s);
        let relative = if size > 0.0 { (total - wanted).abs() / size } else { 0.0 };
        if relative >= fit.deviation {
            fit.deviation = relative;
            fit.worst = (wanted, total);
        }
    }
    if states.is_empty() {
        fit.deviation = f64::NAN;
    }
    fit
}

fn weighted(value: impl Fn(usize) -> f64, states: &[usize], weight: &[f64]) -> Vec<f64> {
    states.iter().zip(weight).map(|(s, w)| value(*s) * w).collect()
}

/// Terms that are proportional to each other at all states.
fn groups(terms: &[Vec<f64>], states: &[usize]) -> Vec<Vec<usize>> {
    let dot = |a: usize, b: usize| -> f64 {
        let length = |k: usize| states.iter().fold(0.0f64, |m, s| m.max(terms[k][*s].abs())).max(f64::MIN_POSITIVE);
        let (la, lb) = (length(a), length(b));
        states.iter().map(|s| terms[a][*s] / la * (terms[b][*s] / lb)).sum()
    };
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for k in 0..terms.len() {
        // squares of products over the states: some hundred units of the last place
        let alike = |g: &&mut Vec<usize>| elementary::powi(dot(g[0], k), 2) >= dot(g[0], g[0]) * dot(k, k) * (1.0 - 1e-13);
        match groups.iter_mut().find(alike) {
            Some(group) => group.push(k),
            None => groups.push(vec![k]),
        }
    }
    groups
}

/// Factors with Σ α_k column_k = target, when they are unique and fit.
fn least_squares(columns: &[Vec<f64>], target: &[f64]) -> Option<Vec<f64>> {
    let (rows, n) = (target.len(), columns.len());
    if rows < n + 2 {
        return None;
    }
    let matrix: Vec<f64> = (0..rows * n).map(|k| columns[k % n][k / n]).collect();
    let qr = Qr::new(&matrix, rows, n);
    if qr.rank() < n {
        return None;
    }
    let factors = qr.least_squares(target).0;
    let left = |r: usize| (target[r] - columns.iter().zip(&factors).map(|(c, a)| c[r] * a).sum::<f64>()).abs();
    ((0..rows).all(|r| left(r) <= ROUNDING)).then_some(factors)
}

/// Factors of an equation: the anchor that leaves most terms alone keeps 1.
fn best_anchor(columns: &[Vec<f64>], anchors: &[usize]) -> Option<Vec<f64>> {
    let mut best: Option<(usize, Vec<f64>)> = None;
    for &anchor in anchors {
        let others: Vec<Vec<f64>> = (0..columns.len()).filter(|k| *k != anchor).map(|k| columns[k].clone()).collect();
        let target: Vec<f64> = columns[anchor].iter().map(|v| -v).collect();
        let Some(mut factors) = least_squares(&others, &target) else { continue };
        factors.insert(anchor, 1.0);
        let changed = changed(&factors);
        if best.as_ref().is_none_or(|(fewest, _)| changed < *fewest) {
            best = Some((changed, factors));
        }
    }
    best.map(|(_, factors)| factors)
}

#[cfg(test)]
mod tests {
    use super::{Sum, fit};

    fn columns(functions: &[fn(f64, f64) -> f64]) -> Vec<Vec<f64>> {
        let states: Vec<(f64, f64)> = (1..30).map(|i| ((f64::from(i) * 0.7).sin(), (f64::from(i) * 1.3).cos())).collect();
        functions.iter().map(|f| states.iter().map(|(x, y)| f(*x, *y)).collect()).collect()
    }

    #[test]
    fn a_wrong_term_is_named_with_its_factor() {
        // the machine: a = -2 x - 3 y
        let a: fn(f64, f64) -> f64 = |x, y| -2.0 * x - 3.0 * y;
        let terms = columns(&[|x, y| 5.0 * (-2.0 * x - 3.0 * y), |x, _| 10.0 * x, |_, y| 12.0 * y]);
        let found = fit(Sum { terms: &terms, target: None, anchors: &[0], others: &[] });
        let factors = found.factors.as_ref().unwrap();
        // least squares over some points: rounding; the claim is wrong by a quarter
        assert!((factors[2] - 1.25).abs() < 1e-12 && (factors[1] - 1.0).abs() < 1e-12 && !found.holds(1e-6));
        let right = columns(&[a, |x, _| 2.0 * x, |_, y| 3.0 * y]);
        assert!(fit(Sum { terms: &right, target: None, anchors: &[0], others: &[] }).holds(1e-9));
    }

    #[test]
    fn a_missing_term_is_found_and_proportional_terms_are_one() {
        let terms = columns(&[|x, y| -2.0 * x - 3.0 * y, |x, _| x, |x, _| 0.5 * x + 0.5 * x]);
        let others = columns(&[|x, y| x * y, |_, y| 7.0 * y]);
        let found = fit(Sum { terms: &terms, target: None, anchors: &[0], others: &others });
        let (number, factor) = found.missing.unwrap();
        // least squares over some points: rounding
        assert!(number == 1 && (factor - 3.0 / 7.0).abs() < 1e-12);
    }
}
