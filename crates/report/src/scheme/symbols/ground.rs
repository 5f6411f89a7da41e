//! What stands still: walls, guides, supports.

use super::{Symbol, across, middle};
use crate::scheme::ink::{Local, direction, distance};
use crate::scheme::{Fill, Fit, Ink, P, Place, S, Weight};
use std::f64::consts::FRAC_PI_2;

pub(super) const ROWS: &[Symbol] = &[
    Symbol { name: "wall", words: ("ground, wall", "неподвижная опора"), fit: Fit::Static, draw: wall, sample: across },
    Symbol {
        name: "guides",
        words: ("guides", "направляющие"),
        fit: Fit::Static,
        draw: guides,
        sample: || Place { other: S * 0.45, ..across() },
    },
    Symbol {
        name: "pin_fixed",
        words: ("fixed hinge", "неподвижный шарнир"),
        fit: Fit::Static,
        draw: pin_fixed,
        sample: || Place { turn: -FRAC_PI_2, ..middle() },
    },
    Symbol {
        name: "support_roller",
        words: ("movable support", "подвижная опора"),
        fit: Fit::Static,
        draw: support_roller,
        sample: || Place { turn: -FRAC_PI_2, ..middle() },
    },
    Symbol {
        name: "clamp", words: ("clamp", "заделка"), fit: Fit::Static, draw: clamp, sample: || Place { turn: -FRAC_PI_2, ..middle() }
    },
    Symbol {
        name: "clamp_guided",
        words: ("support against turning", "опора, исключающая поворот"),
        fit: Fit::Static,
        draw: clamp_guided,
        sample: || Place { turn: -FRAC_PI_2, ..middle() },
    },
    Symbol {
        name: "track_circle",
        words: ("circular track", "круговая опора"),
        fit: Fit::Static,
        draw: track_circle,
        sample: || Place { size: 36.0, ..middle() },
    },
];

/// From `at` to `to`, hatched on the right.
fn wall(place: &Place, ink: &mut Ink) {
    ink.hatched(place.at, place.to);
}

/// Along `at`-`to`, at the distance `other` on both sides.
fn guides(place: &Place, ink: &mut Ink) {
    let axis = Local::new(place.at, direction(place.at, place.to));
    let (l, h) = (distance(place.at, place.to), place.other);
    ink.hatched(axis.at(0.0, -h), axis.at(l, -h));
    ink.hatched(axis.at(l, h), axis.at(0.0, h));
}

/// A hinge at `at`, its stand in the direction `turn`.
fn pin_fixed(place: &Place, ink: &mut Ink) {
    stand(place, ink, 0.95 * S);
    let axis = Local::new(place.at, place.turn);
    ink.hatched(axis.at(0.95 * S, -0.8 * S), axis.at(0.95 * S, 0.8 * S));
    ink.circle(Weight::Part, Fill::Paper, (place.at, 0.2 * S));
}

/// A triangle from a hinge to its base.
fn stand(place: &Place, ink: &mut Ink, deep: f64) {
    let axis = Local::new(place.at, place.turn);
    ink.outline(Weight::Part, Fill::Paper, &[place.at, axis.at(deep, -0.5 * S), axis.at(deep, 0.5 * S)]);
}

/// A hinge on rollers that run across `turn`.
fn support_roller(place: &Place, ink: &mut Ink) {
    stand(place, ink, 0.72 * S);
    let axis = Local::new(place.at, place.turn);
    for y in [-0.3 * S, 0.3 * S] {
        ink.circle(Weight::Part, Fill::Paper, (axis.at(0.86 * S, y), 0.13 * S));
    }
    ink.hatched(axis.at(1.0 * S, -0.8 * S), axis.at(1.0 * S, 0.8 * S));
    ink.circle(Weight::Part, Fill::Paper, (place.at, 0.2 * S));
}

/// A wall across `turn`, behind `at`.
fn clamp(place: &Place, ink: &mut Ink) {
    let half = if place.size > 0.0 { place.size } else { 0.8 * S };
    let axis = Local::new(place.at, place.turn);
    let ends: [P; 2] = [axis.at(0.0, -half), axis.at(0.0, half)];
    ink.way(Weight::Link, &ends);
    ink.hatching(ends[0], ends[1]);
}

/// Two walls, between which it slides without turning.
fn clamp_guided(place: &Place, ink: &mut Ink) {
    let axis = Local::new(place.at, place.turn);
    ink.way(Weight::Part, &[axis.at(0.0, -0.6 * S), axis.at(0.0, 0.6 * S)]);
    for y in [-0.35 * S, 0.35 * S] {
        ink.circle(Weight::Part, Fill::Paper, (axis.at(0.16 * S, y), 0.13 * S));
    }
    ink.hatched(axis.at(0.32 * S, -0.8 * S), axis.at(0.32 * S, 0.8 * S));
}

/// A circle of radius `size` with short hatching outside.
fn track_circle(place: &Place, ink: &mut Ink) {
    ink.circle(Weight::Part, Fill::None, (place.at, place.size));
    let n = (place.size * std::f64::consts::TAU / 7.0).clamp(8.0, 300.0) as usize;
    for i in 0..n {
        let a = std::f64::consts::TAU * i as f64 / n as f64;
        let out = Local::new(place.at, a);
        ink.way(Weight::Thin, &[out.at(place.size, 0.0), out.at(place.size + 5.5, 5.0)]);
    }
}
