//! What a pathway given by a formula measures: the shift of a place along a direction, or a turn. It is found by comparison of numbers: a formula that changes
//! in all states as a place does is that place, up to a constant.

use super::groups::Groups;
use super::numbers::{ALIKE, Numbers, STILL, V3, dot, minus, norm};
use crate::machine::Machine;
use mechanics::model::{FrameId, Pathway, PointId, PointRef};
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

/// Candidates for places.
const MANY: usize = 60;

/// Finds the ends of a pathway.
pub fn ends(machine: &Machine, (numbers, groups): (&Numbers, &Groups), (name, pathway): (&str, Pathway)) -> Ends {
    match pathway {
        Pathway::Distance(a, b) => return Ends::Points(a, b),
        Pathway::RelativeAngle(a, b) => return Ends::Turn { on: b, from: a, sense: 1.0 },
        Pathway::Along(..) => {}
    }
    let Some(values) = numbers.pathway(name) else { return Ends::Unknown };
    let finder = Finder { machine, numbers, groups, values };
    finder.turn().or_else(|| finder.shift()).unwrap_or(Ends::Unknown)
}

struct Finder<'a> {
    machine: &'a Machine,
    numbers: &'a Numbers,
    groups: &'a Groups,
    values: &'a [f64],
}

impl Finder<'_> {
    /// The factor by which the pathway changes as this does, in all states at one instant.
    fn factor(&self, series: &dyn Fn(usize) -> f64) -> Option<f64> {
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
            // quotients of movements of STEP and of its square: five digits at least
            if factor.is_some_and(|f| (f - k).abs() > 1e-5 * f.abs()) {
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
        (self.numbers.frames[state][frame.index()].angle() - first + PI).rem_euclid(TAU) - PI
    }

    fn turn(&self) -> Option<Ends> {
        let frames: Vec<FrameId> = self.groups.all.iter().filter(|g| g.turns).map(|g| g.root).take(MANY).collect();
        let mut found: Option<(f64, Ends)> = None;
        for on in &frames {
            for from in std::iter::once(FrameId::GROUND).chain(frames.iter().copied()).filter(|f| f != on) {
                let series = |s: usize| self.angle(*on, s) - self.angle(from, s);
                let Some(k) = self.factor(&series) else { continue };
                let ends = Ends::Turn { on: *on, from, sense: k.signum() };
                if (k.abs() - 1.0).abs() < ALIKE {
                    return Some(ends);
                }
                found = found.or(Some((k, ends)));
            }
        }
        found.map(|f| f.1)
    }

    /// Places by which bodies are taken: mass centres, origins, named points.
    fn places(&self) -> Vec<PointRef> {
        let model = &self.machine.model;
        let bodies = (1..model.frames.len()).map(FrameId).filter(|f| self.groups.of(*f) > 0);
        let centers = bodies.clone().filter(|f| model.frames[f.index()].mass.is_some()).map(PointRef::Center);
        let points = (0..model.points.len()).map(|i| PointRef::Point(PointId(i)));
        let points = points.filter(|p| self.groups.of_point(model, *p) > 0);
        centers.chain(bodies.map(PointRef::Origin)).chain(points).take(MANY).collect()
    }

    fn shift(&self) -> Option<Ends> {
        let places = self.places();
        let mut found: Option<(f64, Ends)> = None;
        for from in std::iter::once(None).chain(places.iter().copied().map(Some)) {
            for on in places.iter().copied().filter(|p| Some(*p) != from) {
                for direction in self.directions(on, from) {
                    let away = |s: usize| from.map_or(0.0, |f| dot(direction, self.numbers.at(s, f)));
                    let series = |s: usize| dot(direction, self.numbers.at(s, on)) - away(s);
                    let Some(k) = self.factor(&series) else { continue };
                    let driven = self.driven(&series, k);
                    let ends = Ends::Along { on, from, direction: direction.map(|c| c * k.signum()), driven };
                    if (k.abs() - 1.0).abs() < ALIKE {
                        return Some(ends);
                    }
                    found = found.or(Some((k, ends)));
                }
            }
            if from.is_none() && found.is_some() {
                break;
            }
        }
        found.map(|f| f.1)
    }

    /// Axes of the ground, and the way of the place itself.
    fn directions(&self, on: PointRef, from: Option<PointRef>) -> Vec<V3> {
        let mut all = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let ways = [Some(on), from].into_iter().flatten().filter_map(|p| {
            let first = self.numbers.at(0, p);
            let way = self.numbers.still().skip(1).map(|s| minus(self.numbers.at(s, p), first)).find(|w| norm(*w) > STILL)?;
            super::numbers::unit(way)
        });
        all.extend(ways.filter(|w| w.iter().filter(|c| c.abs() > STILL).count() > 1).collect::<Vec<_>>());
        all
    }
}
