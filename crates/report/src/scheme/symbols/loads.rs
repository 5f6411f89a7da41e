//! Forces, moments, distributed loads, given motions, gravity.

use super::{Symbol, across, middle};
use crate::scheme::ink::{Local, between, direction, distance, polar};
use crate::scheme::{Fit, Ink, Place, S, Weight};
use std::f64::consts::FRAC_PI_2;

pub(super) const ROWS: &[Symbol] = &[
    Symbol { name: "force", words: ("force", "сила"), fit: Fit::Rigid, draw: force, sample: across },
    Symbol { name: "reaction", words: ("reaction", "реакция связи"), fit: Fit::Rigid, draw: reaction, sample: across },
    Symbol {
        name: "moment",
        words: ("moment", "момент"),
        fit: Fit::Rigid,
        draw: moment,
        sample: || Place { size: 1.3 * S, turn: FRAC_PI_2, ..middle() },
    },
    Symbol {
        name: "moment_negative",
        words: ("moment, clockwise", "момент по часовой стрелке"),
        fit: Fit::Rigid,
        draw: moment_negative,
        sample: || Place { size: 1.3 * S, turn: FRAC_PI_2, ..middle() },
    },
    Symbol {
        name: "distributed",
        words: ("distributed load", "распределённая нагрузка"),
        fit: Fit::Rigid,
        draw: distributed,
        sample: || Place { at: [-50.0, 18.0], to: [50.0, 18.0], size: 30.0, other: 30.0, turn: -FRAC_PI_2, ..middle() },
    },
    Symbol { name: "motion", words: ("given motion", "заданное движение"), fit: Fit::Rigid, draw: motion, sample: across },
    Symbol {
        name: "motion_turn",
        words: ("given rotation", "заданное вращение"),
        fit: Fit::Rigid,
        draw: motion_turn,
        sample: || Place { size: 1.3 * S, turn: FRAC_PI_2, ..middle() },
    },
    Symbol {
        name: "gravity",
        words: ("gravity", "сила тяжести"),
        fit: Fit::Static,
        draw: gravity,
        sample: || Place { at: [0.0, -20.0], to: [0.0, 20.0], ..middle() },
    },
];

/// An arrow with its tip at `to`.
fn force(place: &Place, ink: &mut Ink) {
    let turn = direction(place.at, place.to);
    let short = between(place.to, place.at, 5.0 / distance(place.at, place.to).max(5.0));
    ink.way(Weight::Link, &[place.at, short]);
    ink.head(place.to, turn, 12.0);
}

/// A thinner arrow with its tip at `to`.
fn reaction(place: &Place, ink: &mut Ink) {
    ink.way(Weight::Part, &[place.at, place.to]);
    ink.head(place.to, direction(place.at, place.to), 10.0);
}

fn bow(place: &Place, ink: &mut Ink, (weight, sense): (Weight, f64)) {
    let (r, half) = (place.size, 1.15);
    let (from, to) = (place.turn - sense * half, place.turn + sense * half);
    ink.arc(weight, (place.at, r), [from, to]);
    let back = (10.0 / r.max(10.0)) * 0.5;
    ink.head(polar(place.at, r, to + sense * back), to + sense * (FRAC_PI_2 + back), 11.0);
}

/// An arrow about `at` at the radius `size`, its middle in the direction `turn`, counter-clockwise.
fn moment(place: &Place, ink: &mut Ink) {
    bow(place, ink, (Weight::Part, 1.0));
}

fn moment_negative(place: &Place, ink: &mut Ink) {
    bow(place, ink, (Weight::Part, -1.0));
}

/// The same with a second head.
fn motion_turn(place: &Place, ink: &mut Ink) {
    bow(place, ink, (Weight::Part, 1.0));
    let back = 0.95;
    ink.head(polar(place.at, place.size, place.turn + back), place.turn + back + FRAC_PI_2, 11.0);
}

/// Arrows onto `at`-`to` in the direction `turn`, `size` long at the start, `other` at the end.
fn distributed(place: &Place, ink: &mut Ink) {
    let n = (distance(place.at, place.to) / 14.0).round().clamp(2.0, 60.0) as usize;
    let tail = |share: f64| {
        let long = place.size + (place.other - place.size) * share;
        polar(between(place.at, place.to, share), -long, place.turn)
    };
    for i in 0..=n {
        let share = i as f64 / n as f64;
        let (foot, top) = (between(place.at, place.to, share), tail(share));
        if distance(foot, top) > 7.0 {
            ink.way(Weight::Thin, &[top, foot]);
            ink.head(foot, direction(top, foot), 6.0);
        }
    }
    ink.way(Weight::Thin, &[tail(0.0), tail(1.0)]);
}

/// An arrow with two heads at `to`.
fn motion(place: &Place, ink: &mut Ink) {
    let turn = direction(place.at, place.to);
    ink.way(Weight::Part, &[place.at, place.to]);
    ink.head(place.to, turn, 10.0);
    ink.head(Local::new(place.to, turn).at(-9.0, 0.0), turn, 10.0);
}

/// An arrow from `at` to `to`.
fn gravity(place: &Place, ink: &mut Ink) {
    ink.way(Weight::Thin, &[place.at, place.to]);
    ink.head(place.to, direction(place.at, place.to), 9.0);
}
