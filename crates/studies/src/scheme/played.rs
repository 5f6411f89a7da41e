//! Which studies have moving pictures: motions, linkages, periodic regimes along their trails; small motions along their shapes.

use super::moving::along;
use crate::Finds;
use crate::machine::Machine;
use crate::results::{Results, contacts};
use analysis::System;
use analysis::dataset::Trail;
use report::figure::bands::{State, Stretch};
use report::scheme::moving::{Clock, Stay};
use report::scheme::{Fit, Item, Moving};
use std::f64::consts::TAU;
use words::Language;

/// Shapes that a page plays.
const MOST_SHAPES: usize = 6;
/// States of a contact that a picture shows.
const MOST_STATES: usize = 1000;
/// Frames of a swing.
const FRAMES: usize = 48;
/// A swing is played in this time, s.
const SWING: f64 = 2.0;
/// What a shape moves farthest goes as far, pixels.
const REACH: f64 = 34.0;
/// It turns at most as far, rad.
const WIDEST: f64 = 0.4;

/// The moving pictures of what a study found.
pub fn of(machine: &Machine, results: &Results, language: Language) -> Vec<Moving> {
    match machine.origin.studies.finds(results.kind) {
        Finds::Shapes => shapes(machine, results, language),
        _ => motion(machine, results, language).into_iter().collect(),
    }
}

fn motion(machine: &Machine, results: &Results, language: Language) -> Option<Moving> {
    let data = &results.data;
    let axis = &data.columns.get(data.axis?)?.quantity;
    let repeats = matches!(machine.origin.studies.finds(results.kind), Finds::Regime | Finds::Positions);
    let clock = Clock { symbol: axis.symbol.clone(), unit: axis.unit.clone(), repeats };
    let mut moving = along(machine, (&data.trail, clock), language)?;
    for (contact, stretches) in contacts::courses(data) {
        let own = format!(".{contact}");
        let items = moving.scheme.items.iter().enumerate().filter(|(_, item)| item.path.ends_with(&own));
        let states: Vec<Stay> = stretches.iter().take(MOST_STATES).filter_map(stay).collect();
        // a stop looks the same whether something touches it or not
        let shown = |item: &Item| states.iter().copied().filter(|s| s.look != "open" || item.symbol.fit == Fit::Wrap).collect::<Vec<_>>();
        moving.states.extend(items.map(|(i, item)| (i, shown(item))).filter(|s| !s.1.is_empty()));
    }
    Some(moving)
}

/// What is seen of a state: a thread that hangs or a contact that is open, a friction that sticks, one that slides.
fn stay(stretch: &Stretch) -> Option<Stay> {
    let look = match stretch.state {
        State::Open => "open",
        State::Sticks => "sticks",
        State::Forward | State::Backward => "slips",
        State::Closed => return None,
    };
    Some(Stay { from: stretch.from, to: stretch.to, look })
}

/// A picture for each shape: the grey place of rest, the machine swinging about it.
fn shapes(machine: &Machine, results: &Results, language: Language) -> Vec<Moving> {
    let data = &results.data;
    let names: Vec<&str> = machine.model.coordinates.iter().map(|c| c.name.as_str()).collect();
    let rest: Option<Vec<f64>> = names.iter().map(|n| results.own.get("equilibrium")?.get(*n)?.as_f64()).collect();
    let (Some(rest), Some(omega)) = (rest, data.column("omega")) else { return Vec::new() };
    let rows = omega.values.len().min(MOST_SHAPES);
    let part = |name: &str, row: usize| data.column(name).and_then(|c| c.values.get(row)).copied().unwrap_or(0.0);
    let shape = |row: usize| -> Vec<[f64; 2]> { names.iter().map(|n| [part(n, row), part(&format!("{n}_im"), row)]).collect() };
    let swinging = (0..rows).filter(|row| omega.values[*row] > 0.0);
    swinging.filter_map(|row| swing(machine, (&rest, &shape(row)), (row, omega.values[row]), language)).collect()
}

fn swing(machine: &Machine, (rest, shape): (&[f64], &[[f64; 2]]), (row, omega): (usize, f64), language: Language) -> Option<Moving> {
    let clock = || Clock { symbol: "t".into(), unit: "s".into(), repeats: true };
    // small enough to be straight, large beside rounding: only its size in the picture counts
    let small = 1e-4;
    let tried = along(machine, (&trail(machine, (rest, shape), small), clock()), language)?;
    let (mut far, mut wide) = (0.0_f64, 0.0_f64);
    for track in &tried.tracks {
        far = track.at.iter().map(|p| (p[0] - track.at[0][0]).hypot(p[1] - track.at[0][1])).fold(far, f64::max);
        wide = track.turn.iter().map(|a| (a - track.turn[0]).abs()).fold(wide, f64::max);
    }
    // a shape that moves nothing is shown as large as any: no quotient by nothing
    let size = (REACH / far.max(1e-12)).min(WIDEST / wide.max(1e-12));
    let mut moving = along(machine, (&trail(machine, (rest, shape), small * size), clock()), language)?;
    moving.rest = true;
    let number = report::number::short(omega, 4, language);
    let unit = report::unit::print("rad/s", language);
    let words = language.pick(format!("mode {}, ω = {number} {unit}", row + 1), format!("форма {}, ω = {number} {unit}", row + 1));
    moving.scheme.title = words.into();
    moving.scheme.name = format!("mode-{}", row + 1);
    Some(moving)
}

/// A swing that begins at rest: q = rest + size Im(shape e^(i φ)), brought back to where the connections close.
fn trail(machine: &Machine, (rest, shape): (&[f64], &[[f64; 2]]), size: f64) -> Trail {
    let names: Vec<String> = machine.model.coordinates.iter().map(|c| c.name.clone()).collect();
    let mut system = machine.system.clone();
    let start = system.start().ok();
    let modes = start.as_ref().and_then(|x| system.modes_by_value(0.0, x));
    let mut out = Trail { names, ..Trail::default() };
    for k in 0..=FRAMES {
        let (s, c) = (TAU * k as f64 / FRAMES as f64).sin_cos();
        let mut q: Vec<f64> = rest.iter().zip(shape).map(|(q, [re, im])| q + size * (re * s + im * c)).collect();
        if let (Some(start), Some(modes)) = (&start, &modes) {
            let mut x = start.clone();
            let n = q.len();
            x[..n].copy_from_slice(&q);
            if system.project(0.0, &mut x, modes).is_ok() {
                q.copy_from_slice(&x[..n]);
            }
        }
        out.times.push(SWING * k as f64 / FRAMES as f64);
        out.states.extend(q);
    }
    out
}
