//! A branch from one of its points on: steps along the tangent, each held against what lies on its way.

use super::corrector::{self, Plane, settle};
use super::ground::passes_the_start;
use super::locate::{self, Located, Special, What, flagged, located};
use super::neutral;
use super::signs;
use super::touching;
use super::zeros::{Local, Place, Sort, Zeros};
use crate::Fault;
use crate::interrupt::is_set;
use std::sync::atomic::AtomicBool;

/// First step, as a share of the range of the parameter.
pub(super) const FIRST: f64 = 0.01;
/// Longest step, of scaled length: a branch over the whole range has twenty points at least, and its picture no corners.
const LONGEST: f64 = 0.05;
/// A step below this share of the range cannot be told from rounding of the corrections.
const SHORTEST: f64 = 1e-9;
/// Cosine of the angle between the tangents at both ends of a step: beyond some 25 degrees a chord says nothing of the way.
const STRAIGHT: f64 = 0.9;
/// The angle that a step aims at, rad.
const AIM: f64 = 0.15;
/// A point may lie this share of the step from its guess.
const BESIDE: f64 = 0.3;
/// Corrections that are few, and many.
const FEW: usize = 3;
const MANY: usize = 6;
/// Share of its distance from where it would decide something by which a multiplier may move in a step.
const NEARER: f64 = 0.6;
/// A distance that is resolved anyway: tests see what is farther apart.
const RESOLVED: f64 = 0.05;
/// Below this step what the count of multipliers tells is located by the count itself.
const BY_COUNT: f64 = 1e-3;

/// Why a branch ends.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// The parameter has left its range.
    Left,
    /// The branch has come back to where it began.
    Closed,
    /// It joins another branch, which is known from there on.
    Joins,
    /// Both of the pair that is followed become real there.
    Meets(What),
    /// It has as many points as were asked for.
    Points,
    /// The motion shrinks to a place of rest.
    Rests,
    /// A switch is only touched there, and what lies beyond does not follow from it.
    Grazes,
    /// The period of a free motion grows without bound: it comes ever nearer to a place of rest that it leaves again.
    Lingers,
    /// Folds follow one another ever more closely while the period grows: the parameter winds towards a value at which the motion is homoclinic.
    Winds(f64),
    /// No step leads further: how small the last one was, and why, where the equations say so.
    Stuck(f64, Option<Fault>),
    /// The user has interrupted.
    Interrupted,
    /// Another method goes on from here.
    Outgrown,
}

/// A branch.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Its points in order.
    pub places: Vec<Place>,
    /// What happens on it, each with the index of the point behind it.
    pub special: Vec<(usize, Special)>,
    /// Why it begins and ends where it does; a branch that parts from another begins there.
    pub ends: [Option<End>; 2],
    /// The special point of another branch that it parts from.
    pub parent: Option<usize>,
    /// What its points are.
    pub of: Of,
}

/// What the points of a branch are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Of {
    /// Places of rest.
    #[default]
    Rest,
    /// Motions that repeat after so many periods of the loads; 0 where the period is their own.
    Orbits(usize),
}

impl Curve {
    /// Ends at its last special point, at which a motion shrinks to a place of rest: what seems to go on there are the same motions again.
    fn rest_there(&mut self) {
        if let Some((_, special)) = self.special.last_mut() {
            special.what = What::Hopf;
            self.places.push(special.place.clone());
        }
        self.ends[1] = Some(End::Rests);
    }

    /// Whether a switch is only touched at its end that the special point before this one of its points is.
    pub(super) fn grazes_at(&self, place: usize) -> bool {
        let [begin, end] = &self.ends;
        *begin == Some(End::Grazes) && place <= 1 || *end == Some(End::Grazes) && place + 1 >= self.places.len()
    }

    /// Whether its motions can be turned or moved over all along it without a change.
    pub fn is_neutral(&self) -> bool {
        neutral::all_along(&self.places)
    }

    /// The points before which small disturbances begin or cease to grow although nothing was found on the step, nor on one beside it that leaves the change over.
    pub(super) fn unnamed(&self) -> Vec<usize> {
        let grows = |k: usize| self.places.get(k)?.signs.outside.map(|outside| outside > 0);
        let changes = |k: usize| k.checked_sub(1).and_then(grows).zip(grows(k)).is_some_and(|(before, after)| before != after);
        let named = |k: usize| self.special.iter().any(|(place, _)| *place == k);
        // so near to a special point a multiplier is on the circle as far as its error tells
        let late = |k: usize| named(k) && !changes(k);
        (1..self.places.len()).filter(|&k| changes(k) && !(named(k) || late(k - 1) || late(k + 1))).collect()
    }

    /// The same from its end to its beginning.
    pub(super) fn turned(mut self) -> Curve {
        let last = self.places.len();
        self.places.reverse();
        self.places.iter_mut().flat_map(|place| &mut place.tangent).for_each(|t| *t = -*t);
        self.special.reverse();
        self.special.iter_mut().for_each(|(place, _)| *place = last - *place);
        self.ends.reverse();
        self
    }

    /// A branch from its last point on: that of another direction from the same start.
    pub(super) fn then(mut self, other: Curve) -> Curve {
        let shift = self.places.len() - 1;
        self.places.extend(other.places.into_iter().skip(1));
        self.special.extend(other.special.into_iter().map(|(place, special)| (place + shift, special)));
        let [_, end] = other.ends;
        self.ends[1] = end;
        self
    }
}

/// Where and how far a branch is followed.
#[derive(Clone, Copy)]
pub(super) struct Bounds<'a> {
    /// Ranges of the last unknowns, the last one's last.
    pub(super) ranges: &'a [[f64; 2]],
    pub(super) points: usize,
    pub(super) interrupt: Option<&'a AtomicBool>,
    /// First step.
    pub(super) first: f64,
}

impl Bounds<'_> {
    fn interrupted(&self) -> bool {
        is_set(self.interrupt)
    }

    /// The first bound on the way from a that b lies beyond.
    fn passed(&self, a: &[f64], b: &[f64]) -> Option<Bound> {
        let first = b.len() - self.ranges.len();
        let share = |bound: &Bound| (bound.value - a[bound.unknown]) / (b[bound.unknown] - a[bound.unknown]);
        let beyond = |(i, [from, to]): (usize, &[f64; 2])| {
            let unknown = first + i;
            let value = b[unknown].clamp(*from, *to);
            (value != b[unknown]).then_some(Bound { unknown, value })
        };
        self.ranges.iter().enumerate().filter_map(beyond).min_by(|u, v| share(u).total_cmp(&share(v)))
    }
}

/// An end of the range of an unknown.
#[derive(Clone, Copy)]
struct Bound {
    unknown: usize,
    value: f64,
}

/// What a step came to.
enum Tried {
    Done(Box<Place>, Vec<Located>, usize, Side),
    Refused(Option<Fault>),
}

/// Where the end of a step lies.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    Within,
    AtBound,
}

/// Follows a branch; `known` says of a special point whether another branch has it.
pub(super) fn walk(zeros: &mut dyn Zeros, start: Place, bounds: Bounds<'_>, known: &dyn Fn(&Special) -> bool) -> Curve {
    let mut curve = Curve { places: vec![start.clone()], special: Vec::new(), ends: [None, Some(End::Points)], parent: None, of: Of::Rest };
    let mut h = bounds.first;
    while curve.places.len() < bounds.points {
        if bounds.interrupted() {
            curve.ends[1] = Some(End::Interrupted);
            return curve;
        }
        let Some(a) = curve.places.last().cloned() else { break };
        let before = curve.places.len().checked_sub(2).map(|i| &curve.places[i]);
        match attempt(zeros, &Way::on(before, &a, h), bounds) {
            Tried::Refused(fault) => {
                h *= 0.5;
                if h < SHORTEST {
                    if !shrinks(&mut curve) && !grazes(zeros, &mut curve) {
                        let fault = if a.is_at_edge() { Some(passes_the_start()) } else { fault };
                        curve.ends[1] = Some(if lingers(&a, bounds.ranges.len()) { End::Lingers } else { End::Stuck(h, fault) });
                    }
                    return curve;
                }
            }
            Tried::Done(b, ..) if b.is_blurred() && grazes(zeros, &mut curve) => return curve,
            Tried::Done(b, mut events, steps, side) => {
                let place = curve.places.len();
                if let Some(first) = events.iter().position(|e| rests(&e.special.place, [&a, &b])) {
                    events.truncate(first + 1);
                    curve.special.extend(events.into_iter().map(|e| (place, e.special)));
                    curve.rest_there();
                    return curve;
                }
                let joins = events.iter().any(|e| known(&e.special));
                curve.special.extend(events.into_iter().map(|e| (place, e.special)));
                let closed = curve.places.len() > 3 && closes(&start, &a, &b);
                h = next_step(h, &a, &b, steps, zeros.sort());
                let outgrown = zeros.outgrown(&b);
                curve.places.push(if closed { start.clone() } else { *b });
                let end = if closed {
                    Some(End::Closed)
                } else if joins {
                    Some(End::Joins)
                } else if side == Side::AtBound {
                    Some(End::Left)
                } else {
                    winds(&curve, bounds.ranges.len()).map(End::Winds).or(outgrown.then_some(End::Outgrown))
                };
                if end.is_some() {
                    curve.ends[1] = end;
                    return curve;
                }
            }
        }
    }
    curve
}

/// Ends a branch where its motions shrink to a place of rest, and no step leads across it.
fn shrinks(curve: &mut Curve) -> bool {
    let Some((special, count)) = touching::shrunk(&curve.places) else { return false };
    curve.places.truncate(count);
    curve.special.retain(|(place, _)| *place < count);
    curve.special.push((count, special));
    curve.rest_there();
    true
}

/// Ends a branch where a switch is only touched at its end.
fn grazes(zeros: &mut dyn Zeros, curve: &mut Curve) -> bool {
    let Some(special) = touching::end(zeros, &curve.places) else { return false };
    curve.special.push((curve.places.len() - 1, special));
    curve.ends[1] = Some(End::Grazes);
    true
}

/// Extent of a motion, as a share of what it is at the ends of a step, that is none. Through rest the extent falls to 0 and grows again in a straight line, and the place of a branch
/// point on a step is known to some thousandth of it; anywhere else the extent changes by a part of itself.
const SHRUNK: f64 = 0.02;

/// Whether a free motion has shrunk to a place of rest between the ends of a step.
fn rests(place: &Place, ends: [&Place; 2]) -> bool {
    let extents = |place: &Place| -> Vec<f64> { place.local.facts.extremes.iter().map(|[low, high]| high - low).collect() };
    let [here, a, b] = [place, ends[0], ends[1]].map(extents);
    place.local.phase.is_some() && here.iter().zip(a.iter().zip(&b)).all(|(here, (a, b))| *here <= SHRUNK * a.max(*b))
}

/// Share of the change of the period by which the parameter changes where a motion comes near to rest, both in their scales: it falls like exp(-λT), and no other end of a branch has the
/// period alone grow.
const STILL: f64 = 1e-5;

/// The same of the start of the motion, which comes to rest beside the parameter. Where the shape goes on changing while the parameter stands still (the explosion of a canard) the branch has no end.
const SHAPED: f64 = 1e-2;

/// Whether the period alone grows from a point on; it stands before the parameters.
pub(super) fn lingers(a: &Place, parameters: usize) -> bool {
    let Some((rates, _)) = &a.local.phase else { return false };
    let n = a.y.len() - 1 - parameters;
    let share = |i: usize| a.tangent[i] / a.local.scales[i];
    let states = rates.len();
    (n + 1..a.y.len()).all(|i| share(i).abs() <= STILL * share(n)) && (0..states).all(|i| share(i).abs() <= SHAPED * share(n))
}

/// Ratio of the distances of folds that follow one another below which they have a limit.
const NEARER_EACH: f64 = 0.7;
/// Distance of the last two folds, as a share of the range, at which the limit is told: no diagram shows the rest.
const WOUND: f64 = 1e-5;

/// The value towards which the parameter of a branch of free motions winds, where it does: near to a homoclinic motion of a place of rest with a pair of roots every half turn of the pair
/// is one fold more, exp(-πδ/ω) times as far from the last one as that from the one before.
///
/// *Source*: P. Glendinning, C. Sparrow, J. Statistical Physics 35 (1984) 645-696.
pub(super) fn winds(curve: &Curve, parameters: usize) -> Option<f64> {
    if parameters != 1 || curve.places.last()?.local.phase.is_none() {
        return None;
    }
    let folds: Vec<&Place> = curve.special.iter().filter(|(_, s)| s.what == What::Fold).map(|(_, s)| &s.place).collect();
    let last = folds.last_chunk::<4>()?;
    let range = last[3].local.scales.last()?;
    let way: Vec<f64> = last.windows(2).map(|pair| pair[1].parameter() - pair[0].parameter()).collect();
    let nearer = way.windows(2).all(|pair| pair[0] * pair[1] < 0.0 && pair[1].abs() <= NEARER_EACH * pair[0].abs());
    let longer = last.windows(2).all(|pair| pair[1].local.facts.period > pair[0].local.facts.period);
    // the rest of an alternating geometric series
    let rest = way[2] * way[2] / (way[1] - way[2]);
    (nearer && longer && way[2].abs() <= WOUND * range).then(|| last[3].parameter() + rest)
}

/// One step; refused where it is too long for what lies on it.
fn attempt(zeros: &mut dyn Zeros, way: &Way<'_>, bounds: Bounds<'_>) -> Tried {
    match step(zeros, way, bounds) {
        Ok(tried) => tried,
        Err(fault) => Tried::Refused(Some(fault)),
    }
}

/// A step ahead: where it is likely to lead, and the derivatives that are likely there.
struct Way<'a> {
    a: &'a Place,
    h: f64,
    guess: Vec<f64>,
    near: Local,
}

/// Steps of more than this multiple of the last one are not extrapolated by it.
const REACH: f64 = 2.5;

impl<'a> Way<'a> {
    /// By the tangent, or by Hermite's cubic over the last step, and derivatives that go on as they did over it.
    fn on(before: Option<&Place>, a: &'a Place, h: f64) -> Way<'a> {
        let straight = || a.y.iter().zip(&a.tangent).map(|(y, t)| y + h * t).collect();
        let length = before.map_or(0.0, |b| {
            let way: Vec<f64> = a.y.iter().zip(&b.y).map(|(a, b)| a - b).collect();
            a.dot(&way, &way).sqrt()
        });
        let Some(b) = before.filter(|b| h <= REACH * length && b.local.states == a.local.states) else {
            return Way { a, h, guess: straight(), near: a.local.clone() };
        };
        let (u, s) = (1.0 + h / length, h / length);
        let weights = [(1.0 + 2.0 * u) * s * s, u * s * s, u * u * (3.0 - 2.0 * u), u * u * s];
        let at = |i: usize| weights[0] * b.y[i] + weights[2] * a.y[i] + length * (weights[1] * b.tangent[i] + weights[3] * a.tangent[i]);
        let guess = (0..a.y.len()).map(at).collect();
        let mut near = a.local.clone();
        near.jacobian.iter_mut().zip(&b.local.jacobian).for_each(|(j, old)| *j += s * (*j - old));
        Way { a, h, guess, near }
    }
}

fn step(zeros: &mut dyn Zeros, way: &Way<'_>, bounds: Bounds<'_>) -> Result<Tried, Fault> {
    let refused = Ok(Tried::Refused(None));
    let (a, h) = (way.a, way.h);
    let mut guess = way.guess.clone();
    let mut reached = None;
    let mut beyond = bounds.passed(&a.y, &guess);
    if let Some(bound) = beyond {
        guess = towards(&a.y, &guess, bound);
    } else {
        let plane = Plane { through: &guess, normal: &a.tangent };
        let Some(found) = settle(zeros, &way.near, &guess, &plane)? else { return refused };
        beyond = bounds.passed(&a.y, &found.y);
        match beyond {
            Some(bound) => guess = towards(&a.y, &found.y, bound),
            None => reached = Some(found),
        }
    }
    let found = match (reached, beyond) {
        (Some(found), _) => found,
        (None, None) => return refused,
        (None, Some(bound)) => {
            let across: Vec<f64> = (0..a.y.len()).map(|i| if i == bound.unknown { a.local.scales[i] } else { 0.0 }).collect();
            let Some(mut found) = settle(zeros, &way.near, &guess, &Plane { through: &guess, normal: &across })? else { return refused };
            found.y[bound.unknown] = bound.value;
            found
        }
    };
    let side = if beyond.is_some() { Side::AtBound } else { Side::Within };
    let y = found.y;
    let between = |u: &[f64], v: &[f64]| -> Vec<f64> { u.iter().zip(v).map(|(u, v)| u - v).collect() };
    let off = between(&y, &guess);
    if a.dot(&off, &off).sqrt() > BESIDE * h {
        return refused;
    }
    let Some(b) = corrector::place(zeros, y, &a.tangent)?.filter(Place::lies) else { return refused };
    let chord = between(&b.y, &a.y);
    let straight = a.dot(&a.tangent, &b.tangent) / a.dot(&b.tangent, &b.tangent).sqrt();
    // a step of no length has no direction: the branch begins at the bound
    if straight < STRAIGHT || a.dot(&chord, &a.tangent) < 0.0 || turns_twice(a, &b) {
        return refused;
    }
    let events = located(zeros, a, &b, &flagged(a, &b))?;
    if locate::unexplained(a, &b, &events) {
        if h > BY_COUNT {
            return refused;
        }
        let events = locate::one_by_one(zeros, a, &b)?;
        return Ok(Tried::Done(Box::new(b), events, found.steps, side));
    }
    Ok(Tried::Done(Box::new(b), events, found.steps, side))
}

/// The point of a chord at a bound.
fn towards(a: &[f64], b: &[f64], bound: Bound) -> Vec<f64> {
    let i = bound.unknown;
    let share = (bound.value - a[i]) / (b[i] - a[i]);
    let mut y: Vec<f64> = a.iter().zip(b).map(|(a, b)| a + share * (b - a)).collect();
    y[i] = bound.value;
    y
}

/// Whether the parameter, a cubic between both ends, turns twice: two folds, of which the signs at the ends tell nothing.
fn turns_twice(a: &Place, b: &Place) -> bool {
    let last = a.y.len() - 1;
    let way: Vec<f64> = b.y.iter().zip(&a.y).map(|(b, a)| b - a).collect();
    let length = a.dot(&way, &way).sqrt();
    let (d0, d1, chord) = (a.tangent[last] * length, b.tangent[last] * length, way[last]);
    let level = [d0, d1, chord].iter().all(|d| d.abs() <= locate::LEVEL * length * a.local.scales[last]);
    if d0 * d1 <= 0.0 || level {
        return false;
    }
    // p'(s) = d0 (1 - s)(1 - 3 s) + d1 s (3 s - 2) + 6 s (1 - s) chord: its middle, where it is least or greatest
    let curvature = 3.0 * (d0 + d1) - 6.0 * chord;
    let slope = 6.0 * chord - 4.0 * d0 - 2.0 * d1;
    let s = if curvature == 0.0 { 0.0 } else { -0.5 * slope / curvature };
    (0.0..1.0).contains(&s) && (d0 + slope * s + curvature * s * s) * d0 <= 0.0
}

/// Whether the branch has come back to its start on the way from a to b.
pub(super) fn closes(start: &Place, a: &Place, b: &Place) -> bool {
    let between = |u: &Place, v: &Place| -> Vec<f64> { u.y.iter().zip(&v.y).map(|(u, v)| u - v).collect() };
    let (way, there) = (between(b, a), between(start, a));
    let length = a.dot(&way, &way);
    let share = a.dot(&there, &way) / length;
    let off: Vec<f64> = there.iter().zip(&way).map(|(t, w)| t - share * w).collect();
    let same_way =
        a.dot(&start.tangent, &b.tangent) > STRAIGHT * a.dot(&b.tangent, &b.tangent).sqrt() * a.dot(&start.tangent, &start.tangent).sqrt();
    // a chord of a step leaves the branch by less than a twentieth of itself
    (0.0..=1.0).contains(&share) && a.dot(&off, &off).sqrt() <= 0.05 * length.sqrt() && same_way
}

/// The step behind one: longer where the corrections were few and the branch is straight, shorter where multipliers come near to what they decide.
fn next_step(h: f64, a: &Place, b: &Place, steps: usize, sort: Sort) -> f64 {
    let cosine = a.dot(&a.tangent, &b.tangent) / a.dot(&b.tangent, &b.tangent).sqrt();
    let angle = (2.0 * (1.0 - cosine).max(0.0)).sqrt();
    let way: Vec<f64> = b.y.iter().zip(&a.y).map(|(b, a)| b - a).collect();
    let done = a.dot(&way, &way).sqrt();
    let mut factor = if steps <= FEW {
        2.0
    } else if steps >= MANY {
        0.6
    } else {
        1.2
    };
    if angle > 0.0 {
        factor = f64::min(factor, AIM / angle);
    }
    if let (Some(before), Some(now)) = (&a.local.facts.multipliers, &b.local.facts.multipliers) {
        let moved = signs::moved(before, now);
        let near = signs::distance(now, sort).max(RESOLVED);
        if moved > 0.0 {
            factor = f64::min(factor, NEARER * near / moved * (done / h));
        }
    }
    (h * factor.clamp(0.2, 2.0)).min(LONGEST)
}
