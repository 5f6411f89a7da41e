//! What a pathway given by a formula measures: the shift of a place along a direction, or a turn. It is found by comparison of numbers: a formula that changes
//! in all states as a place does is that place, up to a constant.

use super::groups::{Groups, Joint};
use super::numbers::{ALIKE, Numbers, STILL, V3, dot, minus, norm, plus, unit};
use crate::machine::Machine;
use mechanics::model::{FrameId, Measure, Pathway, PointId, PointRef};
use std::f64::consts::{PI, TAU};

/// What a pathway lies between.
#[derive(Clone, Copy, Debug)]
pub enum Ends {
    /// Two places; it grows with their distance.
    Points(PointRef, PointRef),
    /// A place that moves along a direction against another one (none: the ground).
    Along {
        /// The place on which a positive force acts forwards.
        on: PointRef,
        /// What it moves against.
        from: Option<PointRef>,
        /// Forwards.
        direction: V3,
        /// The rate sign with which the far end moves in a given way; 0 where it stands.
        driven: f64,
        /// Where on a lever it acts, when no place of the file is there.
        arm: Option<V3>,
    },
    /// A body that turns against another one.
    Turn {
        /// The body on which a positive moment acts counter-clockwise when `sense` is positive.
        on: FrameId,
        /// What it turns against.
        from: FrameId,
        /// Sign.
        sense: f64,
    },
    /// Nothing that can be drawn.
    Unknown,
}

/// Quotients of movements of the steps of states and of their squares carry five digits at least.
const EXACT: f64 = 1e-5;
/// What is linear in its coordinates differs from a place that turns by a sixth of the square of the step, 0.06 rad, and from its mean by no more.
const SMALL_MOTIONS: f64 = 1e-3;

/// Candidates for places.
const MANY: usize = 60;

/// Finds the ends of a pathway.
pub fn ends(machine: &Machine, (numbers, groups): (&Numbers, &Groups), (name, pathway): (&str, Pathway)) -> Ends {
    match pathway {
        Pathway::Distance(a, b) => Ends::Points(a, b),
        Pathway::RelativeAngle(a, b) => Ends::Turn { on: b, from: a, sense: 1.0 },
        Pathway::Along(_, measure) => {
            let Some(values) = numbers.pathway(name) else { return Ends::Unknown };
            Finder::new(machine, (numbers, groups), values).ends(measure)
        }
    }
}

/// Places by which bodies are taken: mass centres, origins, named points.
pub(super) fn places(machine: &Machine, groups: &Groups) -> Vec<PointRef> {
    let model = &machine.model;
    let bodies = (1..model.frames.len()).map(FrameId).filter(|f| groups.of(*f) > 0);
    let centers = bodies.clone().filter(|f| model.frames[f.index()].mass.is_some()).map(PointRef::Center);
    let points = (0..model.points.len()).map(|i| PointRef::Point(PointId(i)));
    let points = points.filter(|p| groups.of_point(model, *p) > 0);
    centers.chain(bodies.map(PointRef::Origin)).chain(points).take(MANY).collect()
}

/// A difference of angles between -π and π.
pub(super) fn turned(by: f64) -> f64 {
    (by + PI).rem_euclid(TAU) - PI
}

pub(super) struct Finder<'a> {
    machine: &'a Machine,
    numbers: &'a Numbers,
    groups: &'a Groups,
    values: &'a [f64],
}

impl<'a> Finder<'a> {
    /// Of a pathway with its values in all states.
    pub(super) fn new(machine: &'a Machine, (numbers, groups): (&'a Numbers, &'a Groups), values: &'a [f64]) -> Finder<'a> {
        Finder { machine, numbers, groups, values }
    }

    /// What it lies between. A length is the shift of a place where one shifts by it, at least to first order as machines of small motions are written; else that
    /// of the end of a lever.
    pub(super) fn ends(&self, measure: Measure) -> Ends {
        if measure != Measure::Length {
            return self.turn().or_else(|| self.shift(EXACT)).map_or(Ends::Unknown, |found| found.1);
        }
        let exact = self.shift(EXACT);
        let own = |found: &Option<(f64, Ends)>| found.as_ref().is_some_and(|f| (f.0.abs() - 1.0).abs() < SMALL_MOTIONS);
        let near = if own(&exact) { None } else { self.shift(SMALL_MOTIONS).filter(|f| (f.0.abs() - 1.0).abs() < SMALL_MOTIONS) };
        let found = if own(&exact) { exact } else { near.or_else(|| self.lever()).or(exact) };
        found.or_else(|| self.turn()).map_or(Ends::Unknown, |found| found.1)
    }

    /// The factor by which the pathway changes as this does, in all states at one instant.
    fn factor(&self, series: &dyn Fn(usize) -> f64, within: f64) -> Option<f64> {
        let (zero, start) = (series(0), self.values[0]);
        let mut factor: Option<f64> = None;
        for s in self.numbers.still().skip(1) {
            let (have, want) = (series(s) - zero, self.values[s] - start);
            if !have.is_finite() || !want.is_finite() {
                return None;
            }
            if have.abs() < STILL {
                // it moves where this does not: ten times what counts as standing still
                if want.abs() > 1e-8 {
                    return None;
                }
                continue;
            }
            let k = want / have;
            if factor.is_some_and(|f| (f - k).abs() > within * f.abs()) {
                return None;
            }
            factor = factor.or(Some(k));
        }
        factor.filter(|k| k.abs() > ALIKE)
    }

    /// Sign of what the pathway grows by later besides.
    fn driven(&self, series: &dyn Fn(usize) -> f64, factor: f64) -> f64 {
        let late = self.numbers.later();
        let change = self.values[late] - self.values[0] - factor * (series(late) - series(0));
        if change.abs() > STILL { change.signum() } else { 0.0 }
    }

    fn angle(&self, frame: FrameId, state: usize) -> f64 {
        let first = self.numbers.frames[0][frame.index()].angle();
        turned(self.numbers.frames[state][frame.index()].angle() - first)
    }

    fn turn(&self) -> Option<(f64, Ends)> {
        let frames: Vec<FrameId> = self.groups.all.iter().filter(|g| g.turns).map(|g| g.root).take(MANY).collect();
        let mut found: Option<(f64, Ends)> = None;
        for on in &frames {
            for from in std::iter::once(FrameId::GROUND).chain(frames.iter().copied()).filter(|f| f != on) {
                let series = |s: usize| self.angle(*on, s) - self.angle(from, s);
                let Some(k) = self.factor(&series, EXACT) else { continue };
                let ends = Ends::Turn { on: *on, from, sense: k.signum() };
                if (k.abs() - 1.0).abs() < ALIKE {
                    return Some((k, ends));
                }
                found = found.or(Some((k, ends)));
            }
        }
        found
    }

    /// The end of a lever of a body that turns about a standing axis: r φ is the way of its point at the distance r.
    fn lever(&self) -> Option<(f64, Ends)> {
        let model = &self.machine.model;
        self.groups.all.iter().enumerate().skip(1).filter(|(_, g)| g.joint == Joint::Turns && g.carrier == 0).find_map(|(i, group)| {
            let k = self.factor(&|s: usize| self.angle(group.root, s), EXACT)?;
            let pivot = self.numbers.frames[0][group.root.index()].origin;
            let away = |p: &PointRef| minus(self.numbers.at(0, *p), pivot);
            let mine = places(self.machine, self.groups).into_iter().filter(|p| self.groups.of_point(model, *p) == i);
            // along the place of the body that is about as far
            let far = |p: &PointRef| (norm(away(p)) - k.abs()).abs();
            let ray = mine.filter(|p| norm(away(p)) > STILL).min_by(|a, b| far(a).total_cmp(&far(b))).and_then(|p| unit(away(&p)));
            let ray = ray.unwrap_or_else(|| self.numbers.frames[0][group.root.index()].shown([0.0, 1.0, 0.0]));
            let direction = [-ray[1] * k.signum(), ray[0] * k.signum(), 0.0];
            let arm = Some(plus(pivot, k.abs(), ray));
            let series = |s: usize| self.angle(group.root, s);
            Some((1.0, Ends::Along { on: PointRef::Origin(group.root), from: None, direction, driven: self.driven(&series, k), arm }))
        })
    }

    fn shift(&self, within: f64) -> Option<(f64, Ends)> {
        let places = places(self.machine, self.groups);
        let mut found: Option<(f64, Ends)> = None;
        for from in std::iter::once(None).chain(places.iter().copied().map(Some)) {
            for on in places.iter().copied().filter(|p| Some(*p) != from) {
                for direction in self.directions(on, from) {
                    let away = |s: usize| from.map_or(0.0, |f| dot(direction, self.numbers.at(s, f)));
                    let series = |s: usize| dot(direction, self.numbers.at(s, on)) - away(s);
                    let Some(k) = self.factor(&series, within) else { continue };
                    let driven = self.driven(&series, k);
                    let ends = Ends::Along { on, from, direction: direction.map(|c| c * k.signum()), driven, arm: None };
                    if (k.abs() - 1.0).abs() < if within > EXACT { within } else { ALIKE } {
                        return Some((k, ends));
                    }
                    found = found.or(Some((k, ends)));
                }
            }
            if from.is_none() && found.is_some() {
                break;
            }
        }
        found
    }

    /// Axes of the ground, and the way of the place itself.
    fn directions(&self, on: PointRef, from: Option<PointRef>) -> Vec<V3> {
        let mut all = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let ways = [Some(on), from].into_iter().flatten().filter_map(|p| {
            let first = self.numbers.at(0, p);
            let way = self.numbers.still().skip(1).map(|s| minus(self.numbers.at(s, p), first)).find(|w| norm(*w) > STILL)?;
            unit(way)
        });
        all.extend(ways.filter(|w| w.iter().filter(|c| c.abs() > STILL).count() > 1).collect::<Vec<_>>());
        all
    }
}
