//! Torsional lines: bodies that turn about one axis, seen from the side, as discs on shafts; stages of gears stand above one another.

use super::ends::Ends;
use super::groups::Joint;
use super::numbers::{ALIKE, Numbers, STILL, minus, norm};
use super::sketch::{Act, Carrier, Sketch};
use crate::connections::pairs;
use crate::shown::{Role, role};
use algebra::arrange::Arrange;
use mechanics::model::Site;
use report::scheme::{LabelText, P, Place, Rides, S, between, polar};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Distance of discs on a shaft.
const STEP: f64 = 5.2 * S;
/// Half of the height of a disc.
const DISC: f64 = 1.6 * S;

/// Where the mark of a disc stands at the start, rad from the side that is seen.
pub(super) const MARK: f64 = 0.7;

/// A disc of a line.
#[derive(Clone, Copy, Debug)]
struct Disc {
    group: usize,
    at: P,
    /// Half of its height.
    half: f64,
    gear: bool,
}

/// Two discs that turn in a fixed ratio.
#[derive(Clone, Copy, Debug)]
struct Stage {
    discs: [usize; 2],
    /// Speed of the second over that of the first.
    ratio: f64,
}

/// Whether a machine is nothing but bodies that turn about one axis, at least two of them.
pub(super) fn is_line(sketch: &Sketch) -> bool {
    let groups = &sketch.groups.all[1..];
    let origin = |g: usize| sketch.numbers.frames[0][sketch.groups.all[g].root.index()].origin;
    let alone = |i: usize| sketch.looks[i].spots.iter().all(|s| norm(minus(s.at, origin(i))) < STILL);
    groups.len() >= 2
        && sketch.machine.model.structure.is_none()
        && (1..=groups.len()).all(|i| sketch.groups.all[i].joint == Joint::Turns && alone(i) && norm(minus(origin(i), origin(1))) < STILL)
        && sketch
            .acts
            .iter()
            .any(|a| matches!(a.ends, Ends::Turn { on, from, .. } if sketch.groups.of(on) > 0 && sketch.groups.of(from) > 0))
}

/// Draws the line.
pub(super) fn draw(sketch: &mut Sketch) {
    let stages = stages(sketch);
    let discs = places(sketch, &stages);
    for disc in &discs {
        sketch.origins.push((disc.group, disc.at));
    }
    shafts(sketch, &discs);
    for disc in &discs {
        let path = sketch.groups.all[disc.group].path.clone();
        let symbol = if disc.gear { "gear_side" } else { "section_side" };
        sketch.put(symbol, &path, Place { at: disc.at, size: 0.32 * S, other: disc.half, ..Place::default() });
        // a disc that is seen from the side stands; its mark goes up and down
        if let Some(item) = sketch.scheme.items.last_mut() {
            item.rides = Rides::default();
        }
        let rim = sketch.carrier(Carrier::Rim { group: disc.group, half: 0.9 * disc.half });
        sketch.rides = Rides::along(rim);
        sketch.put(
            "mark_side",
            &format!("marks.{}", disc.group),
            Place { at: [disc.at[0], disc.at[1] - 0.9 * disc.half * MARK.sin()], size: 0.32 * S, ..Place::default() },
        );
        sketch.rides = Rides::default();
    }
    loads(sketch, &discs);
    letters(sketch, &discs);
}

fn angle(numbers: &Numbers, frame: usize, state: usize) -> f64 {
    (numbers.frames[state][frame].angle() - numbers.frames[0][frame].angle() + PI).rem_euclid(TAU) - PI
}

/// Gears of the file, and bodies whose angles are multiples of one another.
fn stages(sketch: &Sketch) -> Vec<Stage> {
    let mut out: Vec<Stage> = Vec::new();
    for (_, pair) in pairs(&sketch.machine.model) {
        let r = pair.radii.map(|e| sketch.numbers.value(sketch.machine, e));
        let sign = if pair.opposite { -1.0 } else { 1.0 };
        out.push(Stage { discs: pair.between.map(|f| sketch.groups.of(f)), ratio: sign * r[0] / r[1] });
    }
    let n = sketch.groups.all.len();
    let turned = |g: usize, s: usize| angle(&sketch.numbers, sketch.groups.all[g].root.index(), s);
    for a in 1..n {
        for b in a + 1..n {
            let ratios = sketch.numbers.still().skip(1).map(|s| (turned(a, s), turned(b, s)));
            let mut ratio = None;
            let fixed = ratios.filter(|(x, y)| x.abs() > STILL || y.abs() > STILL).all(|(x, y)| {
                let k = y / x;
                let same = ratio.is_none_or(|r: f64| (r - k).abs() < ALIKE * r.abs());
                ratio = Some(k);
                same && k.is_finite() && k != 0.0
            });
            if let (true, Some(ratio)) = (fixed, ratio) {
                out.push(Stage { discs: [a, b], ratio });
            }
        }
    }
    out
}

fn elastic(sketch: &Sketch) -> Vec<(usize, usize)> {
    let pair = |a: &Act| match a.ends {
        Ends::Turn { on, from, .. } => Some((sketch.groups.of(from), sketch.groups.of(on))).filter(|(a, b)| *a > 0 && *b > 0),
        _ => None,
    };
    sketch.acts.iter().filter_map(pair).collect()
}

/// Places of all discs: along a shaft in the order of its springs; a stage leads to the next shaft below.
fn places(sketch: &Sketch, stages: &[Stage]) -> Vec<Disc> {
    let edges = elastic(sketch);
    let n = sketch.groups.all.len();
    let mut discs: Vec<Disc> = Vec::new();
    let degree = |g: usize| edges.iter().filter(|e| e.0 == g || e.1 == g).count();
    // an end of a shaft comes first
    let mut order: Vec<usize> = (1..n).collect();
    order.arrange_by_key(|g| (degree(*g) != 1, *g));
    for first in order {
        if discs.iter().any(|d| d.group == first) {
            continue;
        }
        let below = discs.iter().map(|d| d.at[1] + 4.0 * DISC).fold(0.0, f64::max);
        discs.push(Disc { group: first, at: [0.0, below], half: DISC, gear: false });
        let mut i = discs.len() - 1;
        while i < discs.len() {
            let here = discs[i];
            for next in neighbours(&edges, here.group) {
                if discs.iter().all(|d| d.group != next) {
                    let right = discs.iter().filter(|d| d.at[1] == here.at[1]).map(|d| d.at[0]).fold(f64::NEG_INFINITY, f64::max);
                    discs.push(Disc { group: next, at: [right + STEP, here.at[1]], half: DISC, gear: false });
                }
            }
            for stage in stages.iter().filter(|s| s.discs.contains(&here.group)) {
                let (other, ratio) =
                    if stage.discs[0] == here.group { (stage.discs[1], stage.ratio) } else { (stage.discs[0], 1.0 / stage.ratio) };
                if discs.iter().all(|d| d.group != other) {
                    let (own, its) = radii(ratio.abs());
                    discs[i].half = own;
                    discs[i].gear = true;
                    discs.push(Disc { group: other, at: [here.at[0], here.at[1] + own + its], half: its, gear: true });
                }
            }
            i += 1;
        }
    }
    discs
}

/// Half heights of a wheel and of one that turns faster by a ratio.
fn radii(ratio: f64) -> (f64, f64) {
    let least = 0.7 * S;
    if ratio >= 1.0 { (DISC, (DISC / ratio).max(least)) } else { ((DISC * ratio).max(least), DISC) }
}

fn neighbours(edges: &[(usize, usize)], group: usize) -> Vec<usize> {
    let mut out: Vec<usize> = Vec::new();
    for (a, b) in edges {
        let other = if *a == group {
            *b
        } else if *b == group {
            *a
        } else {
            continue;
        };
        if !out.contains(&other) {
            out.push(other);
        }
    }
    out
}

/// Shafts between discs, with the springs and dampers on them, and their bearings.
fn shafts(sketch: &mut Sketch, discs: &[Disc]) {
    let mut levels: Vec<f64> = discs.iter().map(|d| d.at[1]).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    for y in levels {
        let on: Vec<&Disc> = discs.iter().filter(|d| d.at[1] == y).collect();
        let (low, high) = on.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), d| (l.min(d.at[0]), h.max(d.at[0])));
        let ends = [[low - 1.6 * S, y], [high + 1.6 * S, y]];
        for (end, disc) in ends.into_iter().zip([low, high]) {
            sketch.put("shaft", "ground", Place { at: end, to: [disc, y], ..Place::default() });
            sketch.put("bearing", "ground", Place { at: between(end, [disc, y], 0.35), ..Place::default() });
        }
    }
    let acts = sketch.acts.clone();
    for act in &acts {
        let Ends::Turn { on, from, .. } = act.ends else { continue };
        let find = |f| discs.iter().find(|d| d.group == sketch.groups.of(f)).copied();
        let letter = sketch.letter(act);
        match (find(from), find(on), role(act.table)) {
            (Some(a), Some(b), Role::Spring) => {
                let (a, b) = if a.at[0] <= b.at[0] { (a, b) } else { (b, a) };
                let symbol = if sketch.has_play(act) { "backlash" } else { "torsion_bar" };
                sketch.put(symbol, &act.path, Place { at: a.at, to: b.at, ..Place::default() });
                sketch.note(letter, between(a.at, b.at, 0.5), 0.7 * S, Some(FRAC_PI_2));
            }
            (Some(a), Some(b), _) => {
                let (a, b) = ([a.at[0], a.at[1] + 1.15 * S], [b.at[0], b.at[1] + 1.15 * S]);
                sketch.put("damper", &act.path, Place { at: a, to: b, ..Place::default() });
                sketch.note(letter, between(a, b, 0.5), 0.55 * S, Some(-FRAC_PI_2));
            }
            (None, Some(b), role) => grounded(sketch, (act, role), (b, letter)),
            (Some(a), None, role) => grounded(sketch, (act, role), (a, letter)),
            _ => {}
        }
    }
}

/// A spring or damper to the ground, a moment on one disc.
fn grounded(sketch: &mut Sketch, (act, role): (&Act, Role), (disc, letter): (Disc, LabelText)) {
    let foot = [disc.at[0] - 0.9 * S, disc.at[1] + disc.half + 2.6 * S];
    let rim = [foot[0], disc.at[1] + 0.8 * disc.half];
    match role {
        Role::Damper | Role::Spring => {
            let symbol = if role == Role::Damper { "damper" } else { "spring" };
            sketch.put("shaft", &act.path, Place { at: rim, to: [disc.at[0], rim[1]], ..Place::default() });
            sketch.put(symbol, &act.path, Place { at: foot, to: rim, ..Place::default() });
            sketch.put("wall", "ground", Place { at: [foot[0] - 0.7 * S, foot[1]], to: [foot[0] + 0.7 * S, foot[1]], ..Place::default() });
            sketch.note(letter, between(foot, rim, 0.5), 0.55 * S, Some(PI));
        }
        _ => moment(sketch, &act.path, (disc, letter), ("moment", FRAC_PI_2)),
    }
}

fn moment(sketch: &mut Sketch, path: &str, (disc, letter): (Disc, LabelText), (symbol, turn): (&str, f64)) {
    let taken = sketch.scheme.items.iter().filter(|i| i.symbol.name.starts_with("moment") && i.place.at == disc.at).count() as f64;
    let size = disc.half + (0.5 + 0.6 * taken) * S;
    sketch.put(symbol, path, Place { at: disc.at, size, turn, ..Place::default() });
    sketch.note(letter, polar(disc.at, size, turn), 6.0, Some(turn));
}

fn loads(sketch: &mut Sketch, discs: &[Disc]) {
    let machine = sketch.machine;
    for element in &machine.model.elements {
        let Site::Turns { on, value, .. } = element.law.sketch().site else { continue };
        let Some(disc) = discs.iter().find(|d| d.group == sketch.groups.of(on)) else { continue };
        let (sense, letter) = sketch.signed(value[2], &element.path);
        moment(sketch, &element.path, (*disc, letter), (if sense < 0.0 { "moment_negative" } else { "moment" }, FRAC_PI_2));
    }
}

/// Numbers, moments of inertia, coordinates.
fn letters(sketch: &mut Sketch, discs: &[Disc]) {
    let model = &sketch.machine.model;
    let mut coordinates = Vec::new();
    for (j, c) in model.coordinates.iter().enumerate() {
        if let Some(disc) = sketch.moved_with(j).and_then(|g| discs.iter().find(|d| d.group == g)) {
            coordinates.push((c.name.clone(), *disc));
        }
    }
    sketch.signing = true;
    for (name, disc) in coordinates {
        let size = disc.half + 0.4 * S;
        let (at, text) = (disc.at, sketch.letters.named(&name));
        sketch.put("angle", &format!("coordinates.{name}"), Place { at, size, turn: -FRAC_PI_2 - 0.45, other: 0.9, ..Place::default() });
        sketch.note(text, polar(at, size, -FRAC_PI_2), 5.0, Some(-FRAC_PI_2));
    }
    sketch.signing = false;
    for disc in discs {
        let frames = sketch.groups.all[disc.group].frames.clone();
        let inertia = frames.iter().find_map(|f| model.frames[f.index()].mass.as_ref()).and_then(|m| match m.inertia {
            mechanics::model::Inertia::Planar(e) => sketch.letters.symbol(e),
            _ => sketch.letters.symbol(m.mass),
        });
        if let Some(text) = inertia {
            sketch.note(text, [disc.at[0] + 0.3 * S, disc.at[1] - disc.half], 5.0, Some(0.9));
        }
        sketch.number(disc.group, [disc.at[0] - 0.3 * S, disc.at[1] - disc.half], 4.0);
    }
}
