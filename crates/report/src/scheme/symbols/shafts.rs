//! Shafts seen from the side.

use super::{Symbol, across, middle};
use crate::scheme::ink::{Local, direction, distance};
use crate::scheme::{Fill, Fit, Ink, Place, S, Weight};

pub(super) const ROWS: &[Symbol] = &[
    Symbol { name: "shaft", words: ("shaft", "вал"), fit: Fit::Rigid, draw: shaft, sample: across },
    Symbol { name: "bearing", words: ("bearing", "подшипник"), fit: Fit::Static, draw: bearing, sample: middle },
    Symbol {
        name: "gear_side",
        words: ("gear seen from the side", "зубчатое колесо, вид сбоку"),
        fit: Fit::Rigid,
        draw: gear_side,
        sample: || Place { size: 0.35 * S, other: 1.3 * S, ..middle() },
    },
    Symbol {
        name: "motor", words: ("motor", "двигатель"), fit: Fit::Rigid, draw: motor, sample: || Place { size: 0.75 * S, ..middle() }
    },
    Symbol {
        name: "mark_side",
        words: ("mark of a disc seen from the side", "метка диска, вид сбоку"),
        fit: Fit::Static,
        draw: mark_side,
        sample: || Place { size: 0.32 * S, ..middle() },
    },
    Symbol { name: "spoke", words: ("mark of a wheel", "метка колеса"), fit: Fit::Rigid, draw: spoke, sample: across },
    Symbol { name: "axis_line", words: ("axis", "ось"), fit: Fit::Static, draw: axis_line, sample: across },
];

/// From `at` to `to`.
fn shaft(place: &Place, ink: &mut Ink) {
    ink.way(Weight::Link, &[place.at, place.to]);
}

/// Two hatched shells about a shaft along `turn`.
fn bearing(place: &Place, ink: &mut Ink) {
    let axis = Local::new(place.at, place.turn);
    let (half, h) = (0.42 * S, 0.24 * S);
    ink.hatched(axis.at(-half, -h), axis.at(half, -h));
    ink.hatched(axis.at(half, h), axis.at(-half, h));
}

/// A rectangle with crossed lines: half width `size` along the shaft, half height `other`.
fn gear_side(place: &Place, ink: &mut Ink) {
    let axis = Local::new(place.at, place.turn);
    let (w, h) = (place.size, place.other);
    ink.outline(Weight::Part, Fill::Tint, &axis.block(w, h));
    let tooth = (0.3 * h).min(5.0);
    for side in [1.0, -1.0] {
        ink.dashes(Weight::Thin, &[axis.at(-w - 3.0, side * (h - tooth)), axis.at(w + 3.0, side * (h - tooth))]);
    }
}

/// A circle of radius `size`; its letter stands beside it.
fn motor(place: &Place, ink: &mut Ink) {
    ink.circle(Weight::Part, Fill::Paper, (place.at, place.size));
    let axis = Local::new(place.at, 0.0);
    let (w, h) = (0.45 * place.size, 0.4 * place.size);
    ink.way(Weight::Part, &[axis.at(-w, -h), axis.at(-w, h), axis.at(0.0, -0.2 * h), axis.at(w, h), axis.at(w, -h)]);
}

/// A stroke across the rim, `size` to both sides.
fn mark_side(place: &Place, ink: &mut Ink) {
    let [x, y] = place.at;
    ink.way(Weight::Link, &[[x - place.size, y], [x + place.size, y]]);
}

/// A thin line from a centre `at` to the rim `to`.
fn spoke(place: &Place, ink: &mut Ink) {
    ink.way(Weight::Thin, &[place.at, place.to]);
}

fn axis_line(place: &Place, ink: &mut Ink) {
    let axis = Local::new(place.at, direction(place.at, place.to));
    ink.dashes(Weight::Thin, &[axis.at(-6.0, 0.0), axis.at(distance(place.at, place.to) + 6.0, 0.0)]);
}
