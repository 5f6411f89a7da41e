//! Joints and links.

use super::{Symbol, across, middle};
use crate::scheme::ink::{Local, between, direction, distance};
use crate::scheme::{Fill, Fit, Ink, Place, S, Weight};

pub(super) const ROWS: &[Symbol] = &[
    Symbol { name: "pin", words: ("hinge", "шарнир"), fit: Fit::Rigid, draw: pin, sample: middle },
    Symbol { name: "link", words: ("link", "звено"), fit: Fit::Rigid, draw: link, sample: across },
    Symbol {
        name: "rigid", words: ("rod that does not deform", "недеформируемый стержень"), fit: Fit::Rigid, draw: rigid, sample: across
    },
    Symbol { name: "rod", words: ("massless rod", "невесомый стержень"), fit: Fit::Stretch, draw: rod, sample: across },
    Symbol {
        name: "plate",
        words: ("link of three joints", "звено с тремя шарнирами"),
        fit: Fit::Rigid,
        draw: plate,
        sample: || Place { path: vec![[-45.0, 18.0], [45.0, 18.0], [0.0, -28.0]], ..middle() },
    },
    Symbol { name: "slider", words: ("slider", "ползун"), fit: Fit::Rigid, draw: slider, sample: middle },
    Symbol { name: "slot", words: ("slot of a yoke", "паз кулисы"), fit: Fit::Rigid, draw: slot, sample: across },
    Symbol {
        name: "weld",
        words: ("rigid joint", "жёсткое соединение"),
        fit: Fit::Rigid,
        draw: weld,
        sample: || Place { size: 1.4 * S, ..middle() },
    },
    Symbol {
        name: "outline",
        words: ("body of any outline", "тело произвольной формы"),
        fit: Fit::Rigid,
        draw: outline,
        sample: || Place { path: vec![[-40.0, 20.0], [30.0, 24.0], [44.0, -6.0], [8.0, -26.0], [-34.0, -14.0]], ..middle() },
    },
    Symbol { name: "point", words: ("point", "точка"), fit: Fit::Rigid, draw: point, sample: middle },
];

fn pin(place: &Place, ink: &mut Ink) {
    ink.circle(Weight::Part, Fill::Paper, (place.at, 0.2 * S));
}

fn point(place: &Place, ink: &mut Ink) {
    ink.circle(Weight::Thin, Fill::Ink, (place.at, 2.2));
}

/// From `at` to `to`.
fn link(place: &Place, ink: &mut Ink) {
    ink.way(Weight::Link, &[place.at, place.to]);
}

/// A bar with a thickness, among rods that bend.
fn rigid(place: &Place, ink: &mut Ink) {
    let (turn, half) = (direction(place.at, place.to), distance(place.at, place.to) / 2.0);
    let middle = between(place.at, place.to, 0.5);
    ink.outline(Weight::Part, Fill::Ink, &Local::new(middle, turn).block(half, 0.14 * S));
}

fn rod(place: &Place, ink: &mut Ink) {
    ink.way(Weight::Part, &[place.at, place.to]);
    for end in [place.at, place.to] {
        ink.circle(Weight::Part, Fill::Paper, (end, 0.2 * S));
    }
}

/// A plate with the corners `path`.
fn plate(place: &Place, ink: &mut Ink) {
    ink.outline(Weight::Link, Fill::Tint, &place.path);
}

fn outline(place: &Place, ink: &mut Ink) {
    ink.outline(Weight::Part, Fill::Tint, &place.path);
}

/// A block at `at` along `turn`.
fn slider(place: &Place, ink: &mut Ink) {
    let axis = Local::new(place.at, place.turn);
    ink.outline(Weight::Part, Fill::Paper, &axis.block(0.62 * S, 0.4 * S));
}

/// A slot along `at`-`to`, closed at its ends.
fn slot(place: &Place, ink: &mut Ink) {
    let axis = Local::new(place.at, direction(place.at, place.to));
    let (l, h) = (distance(place.at, place.to), 0.3 * S);
    ink.outline(Weight::Part, Fill::Paper, &[axis.at(0.0, -h), axis.at(l, -h), axis.at(l, h), axis.at(0.0, h)]);
}

/// A filled triangle in the corner of two links.
fn weld(place: &Place, ink: &mut Ink) {
    let axis = Local::new(place.at, place.turn);
    if place.size > 0.0 {
        ink.way(Weight::Link, &[axis.at(-place.size, 0.0), place.at, axis.at(0.0, place.size)]);
    }
    let middle = between(axis.at(-0.5 * S, 0.0), axis.at(0.0, 0.5 * S), 0.5);
    ink.outline(Weight::Thin, Fill::Ink, &[place.at, axis.at(-0.5 * S, 0.0), middle, axis.at(0.0, 0.5 * S)]);
}
