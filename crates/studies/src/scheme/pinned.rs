//! Hinges that follow from formulas of places: two groups that turn against one another about a point which both hold are joined there, however the file writes it.

use super::groups::{Groups, Joint};
use super::numbers::{Numbers, Pose, STILL, V3, minus, norm, plus};
use mechanics::Model;
use mechanics::model::{PointId, PointRef};
use std::f64::consts::{PI, TAU};

/// Two groups turn against one another when they do so by more, rad: what turns at all turns by some hundredth of the steps of the states.
const TURNED: f64 = 1e-4;
/// Groups among which hinges are looked for.
const MANY: usize = 30;

/// A hinge that no table of the file has.
#[derive(Clone, Copy, Debug)]
pub struct Pin {
    /// The groups that it joins, the first is earlier in the file or the ground.
    pub groups: [usize; 2],
    /// Where it is.
    pub at: V3,
    /// The way that the ground moves it in the course of time; none where it stands.
    pub driven: Option<V3>,
}

/// All hinges that follow from formulas.
pub fn pins(model: &Model, numbers: &Numbers, groups: &Groups) -> Vec<Pin> {
    let n = groups.all.len();
    if mechanics::is_spatial(model) || n > MANY || model.structure.is_some() {
        return Vec::new();
    }
    let mut found: Vec<Pin> = Vec::new();
    for b in 1..n {
        for a in 0..b {
            let pair = [a, b];
            let Some(pin) = turning(numbers, groups, pair).or_else(|| named(model, numbers, (groups, pair))) else { continue };
            // three bodies on one axle have one hinge each with the first
            let known = |p: &Pin| norm(minus(p.at, pin.at)) < STILL && p.groups[1] == b;
            if !is_known(groups, pair) && !found.iter().any(known) {
                found.push(pin);
            }
        }
    }
    found
}

/// Whether the coordinates have that hinge already.
fn is_known(groups: &Groups, [a, b]: [usize; 2]) -> bool {
    let of = |x: usize, y: usize| groups.all[x].carrier == y && matches!(groups.all[x].joint, Joint::Turns | Joint::Held);
    of(a, b) && a != 0 || of(b, a)
}

fn pose(numbers: &Numbers, state: usize, groups: &Groups, group: usize) -> Pose {
    numbers.frames[state][groups.all[group].root.index()]
}

/// The point about which one group turns against another in all states at one instant.
fn turning(numbers: &Numbers, groups: &Groups, [a, b]: [usize; 2]) -> Option<Pin> {
    let seen = |s: usize| {
        let (p, q) = (pose(numbers, s, groups, a), pose(numbers, s, groups, b));
        (p.seen(minus(q.origin, p.origin)), (q.angle() - p.angle() + PI).rem_euclid(TAU) - PI)
    };
    let (first, angle) = seen(0);
    let by = |s: usize| (seen(s).1 - angle + PI).rem_euclid(TAU) - PI;
    let most = numbers.still().skip(1).max_by(|s, t| by(*s).abs().total_cmp(&by(*t).abs()))?;
    let turn = by(most);
    if turn.abs() < TURNED || numbers.still().skip(1).filter(|s| by(*s).abs() > TURNED).count() < 2 {
        return None;
    }
    // o_s + R(turn) p = o_0 + p: the point that stands, counted from the origin of the second group in the axes of the first
    let shift = minus(seen(most).0, first);
    let half = 0.5 / (0.5 * turn).tan();
    let p = [0.5 * shift[0] - half * shift[1], half * shift[0] + 0.5 * shift[1], 0.0];
    let size = 1.0 + norm(p);
    let stands = |s: usize| {
        let (o, turn) = (seen(s).0, by(s));
        let moved = [o[0] + turn.cos() * p[0] - turn.sin() * p[1], o[1] + turn.sin() * p[0] + turn.cos() * p[1], o[2]];
        norm(minus(moved, plus(first, 1.0, p))) < STILL * size
    };
    let base = pose(numbers, 0, groups, a);
    let at = plus(base.origin, 1.0, base.shown(plus(first, 1.0, p)));
    numbers.still().all(stands).then(|| Pin { groups: [a, b], at, driven: driven(numbers, groups, ([a, b], at)) })
}

/// How the ground moves a hinge with time.
fn driven(numbers: &Numbers, groups: &Groups, ([a, b], at): ([usize; 2], V3)) -> Option<V3> {
    let late = numbers.later();
    let moved = minus(pose(numbers, late, groups, b).carried(&pose(numbers, 0, groups, b), at), at);
    (a == 0).then(|| super::numbers::unit(moved).filter(|_| norm(moved) > STILL)).flatten()
}

/// Two named points at one place that stay together but for what is small of second order.
fn named(model: &Model, numbers: &Numbers, (groups, [a, b]): (&Groups, [usize; 2])) -> Option<Pin> {
    let of = |group: usize| {
        let points = (0..model.points.len()).map(|i| PointRef::Point(PointId(i)));
        points.filter(|p| groups.of_point(model, *p) == group).collect::<Vec<_>>()
    };
    let turns = groups.all[a].turns || groups.all[b].turns;
    let arm = |group: usize, p: PointRef| norm(minus(numbers.at(0, p), pose(numbers, 0, groups, group).origin));
    let turn = |group: usize, s: usize| {
        let by = pose(numbers, s, groups, group).angle() - pose(numbers, 0, groups, group).angle();
        (by + PI).rem_euclid(TAU) - PI
    };
    // a machine of small motions is written with what is linear in its coordinates: r (1 - cos φ) and r (φ - sin φ) are less than r φ²
    let bends = |(group, p): (usize, PointRef), s: usize| arm(group, p) * turn(group, s).powi(2);
    of(a).into_iter().flat_map(|p| of(b).into_iter().map(move |q| (p, q))).find_map(|(p, q)| {
        let apart = |s: usize| norm(minus(numbers.at(s, p), numbers.at(s, q)));
        let together = apart(0) < STILL && numbers.still().all(|s| apart(s) <= bends((a, p), s) + bends((b, q), s) + STILL);
        (turns && together).then(|| Pin { groups: [a, b], at: numbers.at(0, q), driven: None })
    })
}
