//! Bodies: blocks, balls, discs, carts.

use super::{Symbol, middle};
use crate::scheme::ink::{Local, polar};
use crate::scheme::{Fill, Fit, Ink, Place, S, Weight};
use std::f64::consts::{FRAC_PI_2, TAU};

pub(super) const ROWS: &[Symbol] = &[
    Symbol {
        name: "block",
        words: ("block, load", "груз"),
        fit: Fit::Rigid,
        draw: block,
        sample: || Place { size: 1.1 * S, other: 0.8 * S, ..middle() },
    },
    Symbol {
        name: "cart",
        words: ("block on rollers", "груз на катках"),
        fit: Fit::Rigid,
        draw: cart,
        sample: || Place { size: 1.1 * S, other: 0.7 * S, ..middle() },
    },
    Symbol { name: "ball", words: ("point mass", "точечная масса"), fit: Fit::Rigid, draw: ball, sample: middle },
    Symbol {
        name: "disc",
        words: ("disc with a mark", "диск с меткой"),
        fit: Fit::Rigid,
        draw: disc,
        sample: || Place { size: 1.5 * S, turn: 0.7, ..middle() },
    },
    Symbol {
        name: "ring",
        words: ("ring", "кольцо"),
        fit: Fit::Rigid,
        draw: ring,
        sample: || Place { size: 1.5 * S, other: 1.15 * S, turn: 0.7, ..middle() },
    },
    Symbol {
        name: "rotor",
        words: ("rotor with unbalance", "ротор с дисбалансом"),
        fit: Fit::Rigid,
        draw: rotor,
        sample: || Place { size: 1.4 * S, to: polar([0.0; 2], 0.8 * S, 0.7), ..middle() },
    },
    Symbol {
        name: "bar",
        words: ("homogeneous rod", "однородный стержень"),
        fit: Fit::Rigid,
        draw: bar,
        sample: || Place { size: 50.0, other: 4.0, ..middle() },
    },
    Symbol { name: "center", words: ("mass centre", "центр масс"), fit: Fit::Rigid, draw: center, sample: middle },
    Symbol {
        name: "section_side",
        words: ("disc seen from the side", "диск, вид сбоку"),
        fit: Fit::Rigid,
        draw: block,
        sample: || Place { size: 0.3 * S, other: 1.5 * S, ..middle() },
    },
];

/// A rectangle about `at`: half width `size` along `turn`, half height `other`.
fn block(place: &Place, ink: &mut Ink) {
    ink.outline(Weight::Part, Fill::Tint, &Local::new(place.at, place.turn).block(place.size, place.other));
}

/// The same on two rollers below.
fn cart(place: &Place, ink: &mut Ink) {
    block(place, ink);
    let axis = Local::new(place.at, place.turn);
    for x in [-0.55, 0.55] {
        ink.circle(Weight::Part, Fill::Paper, (axis.at(x * place.size, -place.other - 0.17 * S), 0.17 * S));
    }
}

fn ball(place: &Place, ink: &mut Ink) {
    let r = if place.size > 0.0 { place.size } else { 0.34 * S };
    ink.circle(Weight::Part, Fill::Ink, (place.at, r));
}

/// A circle of radius `size` with a mark at its rim in the direction `turn`.
fn disc(place: &Place, ink: &mut Ink) {
    ink.circle(Weight::Part, Fill::Tint, (place.at, place.size));
    mark(place, ink);
}

fn mark(place: &Place, ink: &mut Ink) {
    if place.size > 0.4 * S {
        let (inner, outer) = (place.size - 0.3 * S.min(place.size), place.size);
        ink.way(Weight::Part, &[polar(place.at, inner, place.turn), polar(place.at, outer, place.turn)]);
    }
}

/// Circles of radii `size` and `other`.
fn ring(place: &Place, ink: &mut Ink) {
    ink.circle(Weight::Part, Fill::Tint, (place.at, place.size));
    ink.circle(Weight::Part, Fill::Paper, (place.at, place.other));
    mark(&Place { turn: place.turn, ..place.clone() }, ink);
}

/// A circle of radius `size` about `at`, its unbalance at `to`.
fn rotor(place: &Place, ink: &mut Ink) {
    ink.circle(Weight::Part, Fill::Tint, (place.at, place.size));
    ink.way(Weight::Thin, &[place.at, place.to]);
    ink.circle(Weight::Part, Fill::Ink, (place.to, 0.22 * S));
}

/// A thin rectangle about `at`, half length `size` along `turn`.
fn bar(place: &Place, ink: &mut Ink) {
    ink.outline(Weight::Part, Fill::Tint, &Local::new(place.at, place.turn).block(place.size, place.other));
}

/// A circle with two black quarters.
fn center(place: &Place, ink: &mut Ink) {
    let r = 0.24 * S;
    ink.circle(Weight::Thin, Fill::Paper, (place.at, r));
    for from in [0.0, TAU / 2.0] {
        let arc = (0..=6).map(|i| polar(place.at, r, from + FRAC_PI_2 * f64::from(i) / 6.0));
        let quarter: Vec<_> = std::iter::once(place.at).chain(arc).collect();
        ink.outline(Weight::Thin, Fill::Ink, &quarter);
    }
}
