//! Coordinates, dimensions, axes of frames, conditions given by formulas.

use super::{Symbol, across, middle};
use crate::scheme::ink::{Local, direction, distance, polar};
use crate::scheme::{Fill, Fit, Ink, Place, S, Weight};
use std::f64::consts::FRAC_PI_2;

pub(super) const ROWS: &[Symbol] = &[
    Symbol { name: "coordinate", words: ("coordinate", "координата"), fit: Fit::Sign, draw: coordinate, sample: across },
    Symbol {
        name: "angle",
        words: ("angle", "угол"),
        fit: Fit::Sign,
        draw: angle,
        sample: || Place { size: 1.8 * S, turn: 0.0, other: 1.2, at: [-15.0, 15.0], ..middle() },
    },
    Symbol {
        name: "dimension",
        words: ("dimension", "размер"),
        fit: Fit::Sign,
        draw: dimension,
        sample: || Place { size: 14.0, ..across() },
    },
    Symbol { name: "radius", words: ("radius", "радиус"), fit: Fit::Sign, draw: radius, sample: across },
    Symbol {
        name: "axes",
        words: ("axes of a frame", "оси системы отсчёта"),
        fit: Fit::Rigid,
        draw: axes,
        sample: || Place { path: vec![[34.0, 0.0], [0.0, -34.0]], ..middle() },
    },
    Symbol {
        name: "reference", words: ("direction of reference", "направление отсчёта"), fit: Fit::Sign, draw: reference, sample: across
    },
    Symbol {
        name: "condition",
        words: ("condition by a formula", "связь, заданная формулой"),
        fit: Fit::Stretch,
        draw: condition,
        sample: across,
    },
    Symbol {
        name: "field",
        words: ("energy or resistance by a formula", "энергия или сопротивление по формуле"),
        fit: Fit::Rigid,
        draw: field,
        sample: middle,
    },
    Symbol { name: "cut", words: ("section of a rod", "сечение стержня"), fit: Fit::Rigid, draw: cut, sample: middle },
];

/// A thin arrow from a tick at `at` to `to`.
fn coordinate(place: &Place, ink: &mut Ink) {
    let turn = direction(place.at, place.to);
    let axis = Local::new(place.at, turn);
    ink.way(Weight::Thin, &[axis.at(0.0, 0.3 * S), axis.at(0.0, -0.3 * S)]);
    ink.way(Weight::Thin, &[place.at, place.to]);
    ink.head(place.to, turn, 9.0);
}

/// A thin arrow about `at` at the radius `size` from the direction `turn` to `turn` + `other`.
fn angle(place: &Place, ink: &mut Ink) {
    let (from, to) = (place.turn, place.turn + place.other);
    ink.arc(Weight::Thin, (place.at, place.size), [from, to]);
    if (to - from).abs() * place.size > 9.0 {
        let sense = (to - from).signum();
        let back = sense * 4.0 / place.size.max(4.0);
        ink.head(polar(place.at, place.size, to), to + sense * FRAC_PI_2 - back, 8.0);
    }
}

/// The distance of `at` and `to`, written `size` beside them (to the left for positive values).
fn dimension(place: &Place, ink: &mut Ink) {
    let axis = Local::new(place.at, direction(place.at, place.to));
    let (l, h) = (distance(place.at, place.to), place.size);
    if h != 0.0 {
        for x in [0.0, l] {
            ink.way(Weight::Thin, &[axis.at(x, h.signum() * 3.0), axis.at(x, h + h.signum() * 4.0)]);
        }
    }
    ink.way(Weight::Thin, &[axis.at(0.0, h), axis.at(l, h)]);
    let (size, turn) = ((l * 0.3).min(8.0), direction(place.at, place.to));
    ink.head(axis.at(l, h), turn, size);
    ink.head(axis.at(0.0, h), turn + std::f64::consts::PI, size);
}

/// From a centre `at` to the rim `to`.
fn radius(place: &Place, ink: &mut Ink) {
    ink.way(Weight::Thin, &[place.at, place.to]);
    ink.head(place.to, direction(place.at, place.to), 7.0);
}

/// Arrows from `at` to each point of `path`.
fn axes(place: &Place, ink: &mut Ink) {
    for tip in &place.path {
        ink.way(Weight::Thin, &[place.at, *tip]);
        ink.head(*tip, direction(place.at, *tip), 8.0);
    }
}

fn reference(place: &Place, ink: &mut Ink) {
    ink.dashes(Weight::Thin, &[place.at, place.to]);
}

/// A dashed tie with a knot in the middle.
fn condition(place: &Place, ink: &mut Ink) {
    ink.dashes(Weight::Part, &[place.at, place.to]);
    let middle = crate::scheme::ink::between(place.at, place.to, 0.5);
    ink.outline(Weight::Part, Fill::Paper, &Local::new(middle, std::f64::consts::FRAC_PI_4).block(0.28 * S, 0.28 * S));
}

/// Waves about `at`.
fn field(place: &Place, ink: &mut Ink) {
    for r in [0.5, 0.75, 1.0] {
        ink.arc(Weight::Thin, (place.at, r * S), [0.4, 1.2]);
        ink.arc(Weight::Thin, (place.at, r * S), [0.4 + std::f64::consts::PI, 1.2 + std::f64::consts::PI]);
    }
}

/// A short double stroke across a rod.
fn cut(place: &Place, ink: &mut Ink) {
    let axis = Local::new(place.at, place.turn);
    for x in [-2.0, 2.0] {
        ink.way(Weight::Thin, &[axis.at(x - 2.0, -0.4 * S), axis.at(x + 2.0, 0.4 * S)]);
    }
}
