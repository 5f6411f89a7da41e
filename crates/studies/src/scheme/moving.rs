//! A machine in motion: the scheme of its first place with room for all others, and the tracks of what carries its items. Places come from the states of the
//! motion by the formulas of the derivation, so that the picture cannot move otherwise than the machine.

use super::numbers::{ALIKE, Pose, STILL, V3, cross, dot, minus};
use super::shafts::{self, MARK};
use super::sketch::{Carrier, Sketch, draw_moving};
use super::{course::Course, ends::Ends};
use crate::machine::Machine;
use analysis::dataset::Trail;
use mechanics::model::PointRef;
use report::scheme::moving::{Clock, Track};
use report::scheme::{Moving, P, Rides, Via};
use std::f64::consts::{PI, TAU};
use words::Language;

/// Places of the course that must be in the picture.
const SEEN: usize = 60;

/// The machine along a trail; none where nothing moves that is drawn.
pub fn along(machine: &Machine, (trail, clock): (&Trail, Clock), language: Language) -> Option<Moving> {
    let course = Course::new(machine, trail)?;
    let start = course.instants.first()?;
    let n = course.frames.len();
    let seen: Vec<Vec<Pose>> = (0..SEEN.min(n)).map(|i| course.frames[i * (n - 1) / (SEEN.min(n) - 1).max(1)].clone()).collect();
    let mut sketch = draw_moving(machine, (start, &seen), language);
    if mechanics::is_spatial(&machine.model) {
        bind(&mut sketch);
    }
    let tracks = tracks(&sketch, &course);
    let title = language.pick("Motion", "Движение");
    let mut scheme = std::mem::replace(&mut sketch.scheme, report::Scheme::new("motion", title.into()));
    (scheme.name, scheme.title) = ("motion".into(), title.into());
    Moving::new(scheme, (course.times, tracks), clock)
}

/// The tracks of the groups, then of the other carriers.
fn tracks(sketch: &Sketch, course: &Course) -> Vec<Track> {
    let still = Track::default;
    // bodies of a torsional line stand in the picture; what moves is their marks
    let line = shafts::is_line(sketch);
    let n = sketch.groups.all.len();
    let mut out: Vec<Track> = (0..n).map(|i| if i == 0 || line { still() } else { group(sketch, course, i) }).collect();
    for carrier in &sketch.more {
        let track = match carrier {
            Carrier::Driven { act, direction, of } => driven(sketch, course, (*act, *direction, out.get(*of))),
            Carrier::Rim { group, half } => rim(sketch, course, (*group, *half)),
            Carrier::Point { group, at } => {
                let places = course.frames.iter().map(|frames| sketch.stage.place(*group, carried(sketch, frames, (*group, *at))));
                Track { at: places.collect(), turn: Vec::new() }
            }
            Carrier::Lean { group, center, axis, at } => {
                let lean = |frames: &Vec<Pose>| leaned(sketch, frames, (*group, *center), (*axis, *at));
                Track { at: course.frames.iter().map(lean).collect(), turn: Vec::new() }
            }
        };
        out.push(track);
    }
    out.into_iter().map(resting).collect()
}

/// A track along which nothing is seen to move is none.
fn resting(track: Track) -> Track {
    let same = |p: &P| track.at.first().is_some_and(|q| (p[0] - q[0]).abs() < ALIKE && (p[1] - q[1]).abs() < ALIKE);
    let still = track.at.iter().all(same) && track.turn.iter().all(|a| (a - track.turn[0]).abs() < STILL);
    if still { Track::default() } else { track }
}

/// Where a point of a group is that the sketch has at `p`.
fn carried(sketch: &Sketch, frames: &[Pose], (group, p): (usize, V3)) -> V3 {
    let root = sketch.groups.all[group].root.index();
    frames[root].carried(&sketch.numbers.frames[0][root], p)
}

/// Where a point of a rim is when the axis of its wheel leans otherwise: v' = v + s × v + s × (s × v) / (1 + c) with the sine vector s = n × n' and the cosine c
/// of the lean (Rodrigues).
fn leaned(sketch: &Sketch, frames: &[Pose], (group, center): (usize, V3), (axis, at): (V3, V3)) -> P {
    let root = sketch.groups.all[group].root.index();
    let now = frames[root].shown(sketch.numbers.frames[0][root].seen(axis));
    let (v, sine, cosine) = (minus(at, center), cross(axis, now), dot(axis, now));
    let first = cross(sine, v);
    let second = cross(sine, first).map(|c| c / (1.0 + cosine).max(STILL));
    let turned = [0, 1, 2].map(|k| v[k] + first[k] + second[k]);
    let there = carried(sketch, frames, (group, center));
    sketch.stage.place(group, [0, 1, 2].map(|k| there[k] + turned[k]))
}

/// The origin of a group and its turn in the plane of the picture.
fn group(sketch: &Sketch, course: &Course, i: usize) -> Track {
    let root = sketch.groups.all[i].root.index();
    let at = course.frames.iter().map(|frames| sketch.stage.place(i, frames[root].origin)).collect();
    let flat = !mechanics::is_spatial(&sketch.machine.model);
    Track { at, turn: if flat { turns(course, root) } else { Vec::new() } }
}

/// The angle of a frame along the course, without jumps: between two states nothing turns by half a turn.
fn turns(course: &Course, root: usize) -> Vec<f64> {
    let mut sum = 0.0;
    let mut before: Option<f64> = None;
    let angles = course.frames.iter().map(|frames| {
        let angle = frames[root].angle();
        sum += before.map_or(0.0, |b| (angle - b + PI).rem_euclid(TAU) - PI);
        before = Some(angle);
        sum
    });
    angles.collect()
}

/// The far end of a spring or damper whose pathway is a place less a given motion.
fn driven(sketch: &Sketch, course: &Course, (act, direction, of): (usize, V3, Option<&Track>)) -> Track {
    let Some(act) = sketch.acts.get(act) else { return Track::default() };
    let (Ends::Along { on, from, .. }, Some(values)) = (&act.ends, course.pathways.get(&act.path)) else { return Track::default() };
    let place = |frames: &[Pose], p: PointRef| carried(sketch, frames, (sketch.group_of(p), sketch.numbers.at(0, p)));
    let reach = |frames: &[Pose]| {
        let near = place(frames, *on);
        dot(direction, from.map_or(near, |f| minus(near, place(frames, f))))
    };
    let far: Vec<f64> = course.frames.iter().zip(values).map(|(frames, value)| reach(frames) - value).collect();
    let base = |k: usize| of.and_then(|t| t.at.get(k).map(|p| [p[0] - t.at[0][0], p[1] - t.at[0][1]])).unwrap_or_default();
    let shift = |(k, s): (usize, &f64)| {
        let by = direction.map(|c| c * (s - far[0]));
        let ([x, y], [u, v]) = (base(k), sketch.stage.axes.map(|a| sketch.stage.scale * dot(a, by)));
        [x + u, y - v]
    };
    Track { at: far.iter().enumerate().map(shift).collect(), turn: Vec::new() }
}

/// The mark of a disc that is seen from the side.
fn rim(sketch: &Sketch, course: &Course, (group, half): (usize, f64)) -> Track {
    let angles = turns(course, sketch.groups.all[group].root.index());
    Track { at: angles.iter().map(|a| [0.0, -half * (MARK + a).sin()]).collect(), turn: Vec::new() }
}

/// In space a body does not turn in the plane of the picture: each of its points goes its own way.
fn bind(sketch: &mut Sketch) {
    let mut items = std::mem::take(&mut sketch.scheme.items);
    for item in items.iter_mut().filter(|i| !i.rides.is_still() && i.rides.path.is_empty()) {
        let own = [item.rides.at, item.rides.to];
        let (at, to) = (item.place.at, item.place.to);
        let path = item.place.path.clone();
        let runs = item.rides.runs;
        item.rides = match path.is_empty() {
            true => {
                let near = follow(sketch, at, own[0]);
                let far = if to == [0.0; 2] { near } else { follow(sketch, to, own[1]) };
                Rides { turn: 0, ..Rides::between(near, far) }
            }
            false => {
                let path = path.iter().map(|p| Via { track: follow(sketch, *p, own[0]), drum: None }).collect();
                Rides { path, ..Rides::along(own[0]) }
            }
        };
        item.rides.runs = runs;
    }
    sketch.scheme.items = items;
    let mut labels = std::mem::take(&mut sketch.scheme.labels);
    for label in &mut labels {
        if let Some(rides) = label.rides.as_mut().filter(|r| r.at != 0 || r.to != 0) {
            *rides = Rides::along(follow(sketch, label.at, rides.at));
        }
    }
    sketch.scheme.labels = labels;
}

/// The carrier of the point that is drawn at a place; of none, that of the group.
fn follow(sketch: &mut Sketch, place: P, group: usize) -> usize {
    let near = || sketch.stage.nearest(place, group).map(|at| (group, at));
    let Some((group, at)) = sketch.stage.point(place, group).or_else(near).filter(|known| known.0 > 0) else { return group };
    let same = |c: &Carrier| matches!(c, Carrier::Point { group: g, at: p } if *g == group && *p == at);
    match sketch.more.iter().position(same) {
        Some(i) => sketch.groups.all.len() + i,
        None => sketch.carrier(Carrier::Point { group, at }),
    }
}
