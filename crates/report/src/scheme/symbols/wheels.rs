//! Wheels that turn each other: gears, racks, belts, chains.

use super::{Symbol, across, middle};
use crate::scheme::ink::{Local, direction, distance, polar};
use crate::scheme::{Fill, Fit, Ink, P, Place, S, Weight};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Step of teeth along a pitch circle.
const TOOTH: f64 = 8.0;

pub(super) const ROWS: &[Symbol] = &[
    Symbol {
        name: "gear",
        words: ("gear wheel", "зубчатое колесо"),
        fit: Fit::Rigid,
        draw: gear,
        sample: || Place { size: 1.5 * S, ..middle() },
    },
    Symbol {
        name: "gear_internal",
        words: ("wheel with inner teeth", "колесо с внутренними зубьями"),
        fit: Fit::Rigid,
        draw: gear_internal,
        sample: || Place { size: 1.5 * S, ..middle() },
    },
    Symbol { name: "rack", words: ("rack", "зубчатая рейка"), fit: Fit::Rigid, draw: rack, sample: across },
    Symbol { name: "belt", words: ("belt", "ремень"), fit: Fit::Wrap, draw: belt, sample: pair },
    Symbol {
        name: "belt_crossed", words: ("crossed belt", "перекрёстный ремень"), fit: Fit::Wrap, draw: belt_crossed, sample: pair
    },
    Symbol { name: "chain", words: ("chain", "цепь"), fit: Fit::Wrap, draw: chain, sample: pair },
    Symbol {
        name: "pulley",
        words: ("pulley", "блок, шкив"),
        fit: Fit::Rigid,
        draw: pulley,
        sample: || Place { size: 1.3 * S, turn: 0.7, ..middle() },
    },
];

fn pair() -> Place {
    Place { size: 1.2 * S, other: 0.7 * S, at: [-30.0, 0.0], to: [38.0, 0.0], ..middle() }
}

/// A circle of teeth about `at`; the pitch circle has the radius `size`.
fn gear(place: &Place, ink: &mut Ink) {
    ink.circle(Weight::Part, Fill::Tint, (place.at, (place.size - 3.0).max(1.0)));
    ink.outline(Weight::Part, Fill::None, &teeth(place, 3.0));
    ink.pitch_circle((place.at, place.size));
}

fn gear_internal(place: &Place, ink: &mut Ink) {
    ink.circle(Weight::Part, Fill::None, (place.at, place.size + 8.0));
    ink.outline(Weight::Part, Fill::None, &teeth(place, 3.0));
    ink.pitch_circle((place.at, place.size));
}

fn teeth(place: &Place, half: f64) -> Vec<P> {
    let r = place.size.max(1.0);
    let n = (r * TAU / TOOTH).round().clamp(8.0, 400.0);
    let tooth = |i: usize| {
        let a = place.turn + TAU * i as f64 / n;
        let step = TAU / n;
        let low = (r - half).max(0.5);
        [
            polar(place.at, low, a),
            polar(place.at, r + half, a + 0.2 * step),
            polar(place.at, r + half, a + 0.5 * step),
            polar(place.at, low, a + 0.7 * step),
        ]
    };
    (0..n as usize).flat_map(tooth).collect()
}

/// Teeth on the left of `at`-`to`.
fn rack(place: &Place, ink: &mut Ink) {
    let length = distance(place.at, place.to);
    let axis = Local::new(place.at, direction(place.at, place.to));
    let n = (length / TOOTH).floor().clamp(1.0, 400.0);
    let step = length / n;
    let mut way = vec![axis.at(0.0, -9.0), axis.at(0.0, -3.0)];
    for i in 0..n as usize {
        let x = i as f64 * step;
        way.extend([axis.at(x, -3.0), axis.at(x + 0.2 * step, 3.0), axis.at(x + 0.5 * step, 3.0), axis.at(x + 0.7 * step, -3.0)]);
    }
    way.extend([axis.at(length, -3.0), axis.at(length, -9.0)]);
    ink.outline(Weight::Part, Fill::Tint, &way);
}

/// Outer tangents of the circles about `at` (radius `size`) and `to` (radius `other`), with the arcs on which the belt lies.
fn belt(place: &Place, ink: &mut Ink) {
    strands(place, ink, (Weight::Part, 1.0));
}

fn belt_crossed(place: &Place, ink: &mut Ink) {
    strands(place, ink, (Weight::Part, -1.0));
}

/// As an open belt, with links.
fn chain(place: &Place, ink: &mut Ink) {
    strands(place, ink, (Weight::Thin, 1.0));
    let wider = Place { size: place.size + 3.0, other: place.other + 3.0, ..place.clone() };
    strands(&wider, ink, (Weight::Thin, 1.0));
    for side in [1.0, -1.0] {
        let [a, b] = tangent(place, 1.0, side);
        let axis = Local::new(a, direction(a, b));
        let n = (distance(a, b) / 7.0).floor().clamp(1.0, 200.0) as usize;
        for i in 1..n {
            ink.way(Weight::Thin, &[axis.at(7.0 * i as f64, 0.0), axis.at(7.0 * i as f64, side * 3.0)]);
        }
    }
}

/// A tangent on one side; `kind` 1 for outer ones, -1 for inner ones.
fn tangent(place: &Place, kind: f64, side: f64) -> [P; 2] {
    // wheels about one centre have no direction: no quotient by nothing, in pixels
    let (along, d) = (direction(place.at, place.to), distance(place.at, place.to).max(1e-9));
    let sine = ((place.size - kind * place.other) / d).clamp(-1.0, 1.0);
    let normal = along + side * (FRAC_PI_2 - sine.asin());
    let second = if kind > 0.0 { normal } else { normal + PI };
    [polar(place.at, place.size, normal), polar(place.to, place.other, second)]
}

fn strands(place: &Place, ink: &mut Ink, (weight, kind): (Weight, f64)) {
    // wheels about one centre have no direction: no quotient by nothing, in pixels
    let (along, d) = (direction(place.at, place.to), distance(place.at, place.to).max(1e-9));
    let slope = ((place.size - kind * place.other) / d).clamp(-1.0, 1.0).asin();
    for side in [1.0, -1.0] {
        ink.way(weight, &tangent(place, kind, side));
    }
    let first = FRAC_PI_2 - slope;
    ink.arc(weight, (place.at, place.size), [along + first, along + TAU - first]);
    let second = if kind > 0.0 { first } else { PI - first };
    ink.arc(weight, (place.to, place.other), [along - second, along + second]);
}

/// A wheel with a groove: circles of radii `size` and a little less, a mark in the direction `turn`.
fn pulley(place: &Place, ink: &mut Ink) {
    ink.circle(Weight::Part, Fill::Tint, (place.at, place.size));
    ink.circle(Weight::Thin, Fill::None, (place.at, (place.size - 4.0).max(0.6 * place.size)));
    let [a, b] = [0.62, 0.8].map(|share| polar(place.at, share * place.size, place.turn));
    ink.way(Weight::Part, &[a, b]);
}
