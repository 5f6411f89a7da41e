//! What happens on a branch between two of its points, and where.
//!
//! The point at a share σ of the way is that of the branch in a plane across the chord. A test function that changes its sign between σ = 0 and 1 has its zero
//! found by secants within a bracket; at a branch point, where corrections have no unique solution, by interpolation over points on both sides of it.

use super::corrector::{self, Plane, settle};
use super::signs::{self, leaves_as_pair, leaving};
use super::zeros::{Place, Sort, Zeros};
use crate::Fault;
use crate::studies::periodic::Multiplier;
use algebra::elementary;

/// What happens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// The branch turns.
    Fold,
    /// Another branch crosses it.
    Branch,
    /// A place of rest begins to oscillate.
    Hopf,
    /// A regime of the double period parts from it.
    Doubling,
    /// A pair of multipliers leaves the unit circle.
    Torus,
    /// A switch is only touched: from there on it happens, or happens no more.
    Grazing,
    /// The energy of free motions without losses is extreme.
    Extreme,
    /// Two curves of folds in the plane of two parameters meet in a point.
    Cusp,
    /// The second parameter is extreme on a curve of folds or period doublings.
    Turn,
    /// The frequency on a curve of Hopf points falls to 0: two roots are 0 there.
    BogdanovTakens,
    /// On a curve of Hopf points the first Lyapunov coefficient is 0: motions that part there are stable on one side of it and unstable on the other.
    Bautin,
    /// On a curve of torus points the pair is a root of 1 of this order, up to the fourth (strong resonance).
    Resonance(usize),
}

impl What {
    /// Name in files.
    pub fn key(self) -> &'static str {
        match self {
            What::Fold => "fold",
            What::Branch => "branch",
            What::Hopf => "hopf",
            What::Doubling => "period doubling",
            What::Torus => "torus",
            What::Grazing => "grazing",
            What::Extreme => "extreme of energy",
            What::Cusp => "cusp",
            What::Turn => "turn",
            What::BogdanovTakens => "bogdanov-takens",
            What::Bautin => "generalised hopf",
            What::Resonance(1) => "resonance 1:1",
            What::Resonance(2) => "resonance 1:2",
            What::Resonance(3) => "resonance 1:3",
            What::Resonance(_) => "resonance 1:4",
        }
    }
}

/// A point at which something happens.
#[derive(Clone, Debug)]
pub struct Special {
    /// What.
    pub what: What,
    /// The point.
    pub place: Place,
    /// Half of the interval of the parameter in which it is known to lie, SI; of a branch point the last change of its interpolation.
    pub within: f64,
}

/// The same with its place on the way between two points.
#[derive(Clone, Debug)]
pub(super) struct Located {
    pub(super) special: Special,
    pub(super) share: f64,
}

impl Located {
    /// One of a part of the way on the whole of it.
    fn within(self, [low, high]: [f64; 2]) -> Located {
        Located { share: low + (high - low) * self.share, ..self }
    }
}

/// A test function that changes its sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Test {
    Fold,
    Branch,
    Doubling,
    Pair,
    Switches,
    Count,
    /// Π (1 - μ) of free motions.
    Ones,
    /// How both parameters move along a curve of folds.
    Cusp,
    /// ω² of a pair of roots.
    Frequency,
    /// The first Lyapunov coefficient.
    Lyapunov,
    /// The product of the roots beside the 0 of a fold.
    Rest,
    /// The cosine of a pair of multipliers less that of the root of 1 of this order.
    Angle(usize),
}

/// Evaluations of a test function.
const MOST: usize = 60;
/// Share of the way to which a zero is located: steps are some hundredths of the range, so that twelve digits of the parameter are known.
const EXACT: f64 = 1e-11;
/// The same of a fold, on both sides of which the parameter is the same.
const OF_FOLD: f64 = 1e-8;
/// The same of a change of the count of multipliers, and of the switches.
const OF_COUNT: f64 = 1e-10;
/// Share of the way around a branch point that is left out: its corrections are too uncertain.
const AROUND: [f64; 2] = [0.04, 0.005];

/// Slope of the parameter along a branch, in scales, that is rounding: the frequency of a linear machine is one for all amplitudes.
pub(super) const LEVEL: f64 = 1e-9;

fn changes(a: f64, b: f64) -> bool {
    a * b < 0.0
}

/// Cosines of the roots of 1 of the first four orders.
const COSINES: [f64; 4] = [1.0, -1.0, -0.5, 0.0];

/// What is told of the pair of a curve of Hopf or torus points.
fn turned(place: &Place, test: Test) -> Option<f64> {
    match test {
        Test::Lyapunov => return place.local.facts.lyapunov,
        Test::Rest => return place.local.facts.rest,
        _ => {}
    }
    let (sort, value) = place.local.facts.pair?;
    match (test, sort) {
        (Test::Frequency, Sort::Roots) => Some(value),
        (Test::Angle(order), Sort::Multipliers) => Some(value - COSINES[(order - 1).min(3)]),
        _ => None,
    }
}

/// The tests whose functions change their sign between two points.
pub(super) fn flagged(a: &Place, b: &Place) -> Vec<Test> {
    let (s, t) = (&a.signs, &b.signs);
    let mut list = Vec::new();
    // determinants in other coordinates cannot be compared
    let regular = s.neutral == 0 && t.neutral == 0;
    let branch = regular && a.local.states == b.local.states && changes(s.branch, t.branch);
    if branch {
        list.push(Test::Branch);
    }
    let both = |x: Option<f64>, y: Option<f64>| x.zip(y).is_some_and(|(x, y)| changes(x, y));
    let alike = regular && a.local.states == b.local.states;
    if !branch && alike && both(s.ones, t.ones) {
        list.push(Test::Ones);
    }
    let cusp = alike && both(s.cusp, t.cusp);
    if cusp {
        list.push(Test::Cusp);
    }
    // in a cusp both parameters rest
    if changes(s.fold, t.fold) && (s.fold - t.fold).abs() > LEVEL && !branch && !cusp {
        list.push(Test::Fold);
    }
    if both(s.doubling, t.doubling) {
        list.push(Test::Doubling);
    }
    if both(s.pair, t.pair) && !(s.paired && t.paired) {
        list.push(Test::Pair);
    }
    let pairs = [Test::Frequency, Test::Lyapunov, Test::Rest].into_iter().chain((1..=4).map(Test::Angle));
    // without damping roots come in opposite pairs, and what is beside the 0 of a fold is rounding all along
    let rounding = |test: &Test| *test == Test::Rest && turned(a, *test).zip(turned(b, *test)).is_some_and(|(x, y)| (x - y).abs() <= LEVEL);
    list.extend(pairs.filter(|test| both(turned(a, *test), turned(b, *test)) && !rounding(test)));
    if a.local.facts.switches != b.local.facts.switches {
        list.push(Test::Switches);
    }
    list
}

/// Whether the number of multipliers outside changes by more than what happens explains.
pub(super) fn unexplained(a: &Place, b: &Place, events: &[Located]) -> bool {
    let Some((before, after)) = a.signs.outside.zip(b.signs.outside) else { return false };
    let by: usize = events
        .iter()
        .map(|e| match e.special.what {
            What::Hopf | What::Torus => 2,
            What::Grazing => usize::MAX / 8,
            _ => 1,
        })
        .sum();
    before.abs_diff(after) > by
}

/// Where each of the tests changes its sign, in order. A step on which the switches change is parted there, and each part has its own: what a test function does as a switch comes or
/// goes is a jump, and no zero.
///
/// *Errors*: those of the equations.
pub(super) fn located(zeros: &mut dyn Zeros, a: &Place, b: &Place, tests: &[Test]) -> Result<Vec<Located>, Fault> {
    let (mut list, mut from, mut passed) = (Vec::new(), a.clone(), 0.0);
    let mut tests = tests.to_vec();
    for _ in 0..TOGETHER {
        if !tests.contains(&Test::Switches) {
            break;
        }
        let Some(touch) = touch(zeros, &from, b)? else { break };
        let Bracket { shares: [low, high], places: [before, after] } = touch;
        let at = |share: f64| passed + (1.0 - passed) * share;
        let part = [passed, at(low)];
        list.extend(smooth(zeros, &from, &before, &flagged(&from, &before))?.into_iter().map(|event| event.within(part)));
        let within = 0.5 * (after.parameter() - before.parameter()).abs();
        if !before.is_at_edge() && !after.is_at_edge() {
            let special = Special { what: What::Grazing, within, place: after.clone() };
            list.push(Located { special, share: at(0.5 * (low + high)) });
        }
        (from, passed) = (after, at(high));
        tests = flagged(&from, b);
    }
    let rest = smooth(zeros, &from, b, &tests)?;
    list.extend(rest.into_iter().map(|event| event.within([passed, 1.0])));
    Ok(list)
}

/// Where the switches change first.
fn touch(zeros: &mut dyn Zeros, a: &Place, b: &Place) -> Result<Option<Bracket>, Fault> {
    let value = |place: &Place| if place.local.facts.switches == a.local.facts.switches { 1.0 } else { -1.0 };
    bracket(zeros, (a, b), Test::Switches, [1.0, -1.0], &value)
}

/// The same of tests that have zeros.
fn smooth(zeros: &mut dyn Zeros, a: &Place, b: &Place, tests: &[Test]) -> Result<Vec<Located>, Fault> {
    let mut list = Vec::new();
    for test in tests.iter().filter(|test| **test != Test::Switches) {
        list.extend(one(zeros, a, b, *test)?);
    }
    list.sort_by(|x, y| x.share.total_cmp(&y.share));
    Ok(list)
}

/// Changes of the switches, and of the number of multipliers outside, that are told apart on a step.
const TOGETHER: usize = 8;

/// Where several things happen on a step: test functions that change their signs twice tell nothing, so the step is parted where the number of multipliers outside
/// changes, and each part has its own.
///
/// *Errors*: those of the equations.
pub(super) fn one_by_one(zeros: &mut dyn Zeros, a: &Place, b: &Place) -> Result<Vec<Located>, Fault> {
    let (mut list, mut from, mut passed) = (Vec::new(), a.clone(), 0.0);
    for _ in 0..TOGETHER {
        if from.signs.outside == b.signs.outside {
            break;
        }
        let Some(change) = one(zeros, &from, b, Test::Count)? else { break };
        let after = change.special.place.clone();
        let fine = located(zeros, &from, &after, &flagged(&from, &after))?;
        let change = change.within([passed, 1.0]);
        let part = [passed, change.share];
        passed = change.share;
        // a fold in the same part explains one of them, and not the rest
        if unexplained(&from, &after, &fine) {
            list.push(change);
        }
        list.extend(fine.into_iter().map(|event| event.within(part)));
        from = after;
    }
    let rest = located(zeros, &from, b, &flagged(&from, b))?;
    list.extend(rest.into_iter().map(|event| event.within([passed, 1.0])));
    Ok(list)
}

/// The branch at a share of the way from a to b.
fn inside(zeros: &mut dyn Zeros, a: &Place, b: &Place, (share, test): (f64, Test)) -> Result<Option<Place>, Fault> {
    let way: Vec<f64> = b.y.iter().zip(&a.y).map(|(b, a)| b - a).collect();
    let length = a.dot(&way, &way).sqrt();
    let s = share;
    // Hermite's cubic
    let weights = [(1.0 + 2.0 * s) * (1.0 - s) * (1.0 - s), s * (1.0 - s) * (1.0 - s), s * s * (3.0 - 2.0 * s), s * s * (s - 1.0)];
    let guess: Vec<f64> = (0..a.y.len())
        .map(|i| weights[0] * a.y[i] + weights[2] * b.y[i] + length * (weights[1] * a.tangent[i] + weights[3] * b.tangent[i]))
        .collect();
    // where derivatives vanish somewhere, those of both ends drive away from the branch
    let fresh = if test == Test::Branch { Some(zeros.local(&guess)?) } else { None };
    let near = fresh.as_ref().unwrap_or(if share < 0.5 { &a.local } else { &b.local });
    let Some(found) = settle(zeros, near, &guess, &Plane { through: &guess, normal: &way })? else { return Ok(None) };
    corrector::place(zeros, found.y, &way)
}

fn one(zeros: &mut dyn Zeros, a: &Place, b: &Place, test: Test) -> Result<Option<Located>, Fault> {
    let sort = zeros.sort();
    let value = |place: &Place| match test {
        Test::Fold => place.signs.fold,
        Test::Branch => place.signs.branch,
        Test::Doubling => place.signs.doubling.unwrap_or(f64::NAN),
        Test::Pair => place.signs.pair.unwrap_or(f64::NAN),
        Test::Ones => place.signs.ones.unwrap_or(f64::NAN),
        Test::Cusp => place.signs.cusp.unwrap_or(f64::NAN),
        Test::Frequency | Test::Lyapunov | Test::Rest | Test::Angle(_) => turned(place, test).unwrap_or(f64::NAN),
        // located by itself
        Test::Switches => f64::NAN,
        Test::Count => {
            if place.signs.outside == a.signs.outside {
                1.0
            } else {
                -1.0
            }
        }
    };
    let ends = [value(a), value(b)];
    let Some(bracket) = bracket(zeros, (a, b), test, ends, &value)? else { return Ok(None) };
    let Bracket { shares: [low, high], places: [before, after], .. } = &bracket;
    let crossed = match test {
        Test::Branch => crossing(zeros, a, b, 0.5 * (low + high))?,
        _ => None,
    };
    let within = crossed.as_ref().map_or(0.5 * (after.parameter() - before.parameter()).abs(), |(_, within)| *within);
    let within = if test == Test::Pair { within + unsure(a, b, sort) } else { within };
    let place = crossed.map(|(place, _)| place);
    let place = place.unwrap_or_else(|| if test == Test::Count { after.clone() } else { nearest(before, after, &value) });
    let numbers = place.local.facts.multipliers.clone().unwrap_or_default();
    let what = match test {
        Test::Fold => What::Fold,
        Test::Branch => What::Branch,
        Test::Doubling => What::Doubling,
        Test::Switches => What::Grazing,
        Test::Pair if !leaves_as_pair(&numbers, sort) => return Ok(None),
        Test::Pair => of_pair(sort),
        Test::Count => of_count(&place, sort),
        Test::Ones => What::Extreme,
        Test::Cusp => What::Cusp,
        Test::Frequency | Test::Rest => What::BogdanovTakens,
        Test::Lyapunov => What::Bautin,
        Test::Angle(order) => What::Resonance(order),
    };
    if what == What::Branch && sort == Sort::Multipliers && hardly_known(&numbers) {
        return Ok(None);
    }
    Ok(Some(Located { share: 0.5 * (low + high), special: Special { what, within, place } }))
}

/// Error of a multiplier 1 beyond which its point is none: special points are told to eight digits.
const KNOWN: f64 = 1e-8;

/// Whether the multiplier next to 1 is known too badly to cross it. Where oscillations set in, both 1 - μ and what the parameter changes vanish with the amplitude, and the sign of the
/// determinant is rounding, and so is whether the multiplier is outside. Without damping it meets its reciprocal there: of a double root each is known to the root of what
/// their sum is, and (1 - μ)(1 - 1/μ) = 2 - (μ + 1/μ) crosses 0 with all digits of the sum.
fn hardly_known(numbers: &[Multiplier]) -> bool {
    let off = |m: &Multiplier| elementary::hypot(m.re - 1.0, m.im);
    let mut own: Vec<&Multiplier> = numbers.iter().filter(|m| !m.trivial).collect();
    own.sort_by(|a, b| off(a).total_cmp(&off(b)));
    let error = match own[..] {
        [first, second, ..] if signs::are_reciprocal(first, second) => first.error * second.error,
        [first, ..] => first.error,
        [] => 0.0,
    };
    error > KNOWN
}

/// By how much the parameter is not known where a pair crosses slowly: its error over the slope of its way from a to b.
fn unsure(a: &Place, b: &Place, sort: Sort) -> f64 {
    let of = |place: &Place| place.local.facts.multipliers.as_deref().and_then(|numbers| leaving(numbers, sort));
    let Some(([from, error_from], [to, error_to])) = of(a).zip(of(b)) else { return 0.0 };
    let share = error_from.max(error_to) / (to - from).abs();
    share.min(1.0) * (b.parameter() - a.parameter()).abs()
}

fn of_pair(sort: Sort) -> What {
    match sort {
        Sort::Multipliers => What::Torus,
        Sort::Roots => What::Hopf,
    }
}

/// What has left the circle or come back, by the multiplier that is nearest to it.
fn of_count(place: &Place, sort: Sort) -> What {
    let numbers = place.local.facts.multipliers.as_deref().unwrap_or_default();
    let own = numbers.iter().filter(|m| !m.trivial);
    let first = own.min_by(|a, b| signs::off(a, sort).abs().total_cmp(&signs::off(b, sort).abs()));
    match (first, sort) {
        (Some(m), _) if m.im != 0.0 => of_pair(sort),
        (Some(m), Sort::Multipliers) if m.re < 0.0 => What::Doubling,
        _ => What::Branch,
    }
}

fn nearest(a: &Place, b: &Place, value: &dyn Fn(&Place) -> f64) -> Place {
    if value(a).abs() < value(b).abs() { a.clone() } else { b.clone() }
}

/// Shares of the way on both sides of a zero, with the points there.
struct Bracket {
    shares: [f64; 2],
    places: [Place; 2],
}

/// Secants within a bracket (Illinois): superlinear, and never outside.
fn bracket(
    zeros: &mut dyn Zeros,
    (a, b): (&Place, &Place),
    test: Test,
    mut values: [f64; 2],
    value: &dyn Fn(&Place) -> f64,
) -> Result<Option<Bracket>, Fault> {
    let smooth = !matches!(test, Test::Switches | Test::Count);
    let enough = match test {
        Test::Fold => OF_FOLD,
        Test::Branch => AROUND[0],
        Test::Switches | Test::Count => OF_COUNT,
        _ => EXACT,
    };
    let mut found = Bracket { shares: [0.0, 1.0], places: [a.clone(), b.clone()] };
    let mut kept: Option<usize> = None;
    for _ in 0..MOST {
        let [low, high] = found.shares;
        let small = values.contains(&0.0);
        if small || high - low <= enough {
            break;
        }
        let secant = (low * values[1] - high * values[0]) / (values[1] - values[0]);
        // a little off the zero, so that both ends of the bracket come in
        let nudged = if secant - low < high - secant { secant + 0.2 * enough } else { secant - 0.2 * enough };
        let share = if smooth && nudged > low && nudged < high { nudged } else { 0.5 * (low + high) };
        let place = match inside(zeros, a, b, (share, test)) {
            Ok(place) => place,
            // beyond a switch that is touched there may be no motion nearby
            Err(_) if test == Test::Switches => None,
            Err(fault) => return Err(fault),
        };
        let Some(place) = place else {
            if smooth {
                return Ok((high - low < 1.0).then_some(found));
            }
            found.shares[1] = share;
            continue;
        };
        let v = value(&place);
        if v.is_nan() {
            return Ok(None);
        }
        let side = usize::from(v * values[0] < 0.0);
        if kept == Some(side) {
            values[1 - side] *= 0.5;
        }
        kept = Some(side);
        (found.shares[side], found.places[side], values[side]) = (share, place, v);
    }
    Ok(Some(found))
}

/// The branch point near a share of the way: the test function and the branch itself by cubics through points on both sides. With it the last change of its
/// parameter.
fn crossing(zeros: &mut dyn Zeros, a: &Place, b: &Place, near: f64) -> Result<Option<(Place, f64)>, Fault> {
    let mut root = near;
    let mut found: Option<(Place, f64)> = None;
    for around in AROUND {
        let shares = [-2.0, -1.0, 1.0, 2.0].map(|k| root + k * around);
        let mut places = Vec::new();
        for share in shares {
            let Some(place) = inside(zeros, a, b, (share, Test::Branch))? else { return Ok(found) };
            places.push(place);
        }
        let at = |s: f64, of: &dyn Fn(&Place) -> f64| -> f64 {
            let weight = |i: usize| (0..4).filter(|j| *j != i).map(|j| (s - shares[j]) / (shares[i] - shares[j])).product::<f64>();
            (0..4).map(|i| weight(i) * of(&places[i])).sum()
        };
        let turns = changes(a.signs.fold, b.signs.fold);
        let test = |s: f64| at(s, &|place| if turns { place.signs.branch } else { place.signs.square });
        let (mut low, mut high) = (shares[0], shares[3]);
        if !changes(test(low), test(high)) {
            return Ok(found);
        }
        for _ in 0..MOST {
            let middle = 0.5 * (low + high);
            if changes(test(low), test(middle)) { high = middle } else { low = middle }
        }
        root = 0.5 * (low + high);
        let y: Vec<f64> = (0..a.y.len()).map(|i| at(root, &|place| place.y[i])).collect();
        let tangent = (0..a.y.len()).map(|i| at(root, &|place| place.tangent[i])).collect();
        let local = zeros.local(&y)?;
        let place = Place { y, tangent, local, signs: places[1].signs.clone() };
        let before = found.map_or_else(|| a.parameter(), |(place, _)| place.parameter());
        let change = (place.parameter() - before).abs();
        found = Some((place, change));
    }
    Ok(found)
}
