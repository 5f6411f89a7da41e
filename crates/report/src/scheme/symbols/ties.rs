//! Threads and ropes, contacts: stops, friction, rolling.

use super::{Symbol, across, middle};
use crate::scheme::ink::{Local, direction, distance};
use crate::scheme::{Fill, Fit, Ink, Place, S, Weight};

pub(super) const ROWS: &[Symbol] = &[
    Symbol {
        name: "thread",
        words: ("thread, rope", "нить, канат"),
        fit: Fit::Wrap,
        draw: thread,
        sample: || Place { path: vec![[-45.0, 25.0], [-10.0, -20.0], [45.0, 10.0]], ..middle() },
    },
    Symbol {
        name: "ring_eye", words: ("ring of a thread", "кольцо для нити"), fit: Fit::Rigid, draw: ring_eye, sample: middle
    },
    Symbol {
        name: "drum",
        words: ("drum", "барабан"),
        fit: Fit::Rigid,
        draw: drum,
        sample: || Place { size: 1.2 * S, turn: 0.7, ..middle() },
    },
    Symbol { name: "stop", words: ("stop", "упор"), fit: Fit::Static, draw: stop, sample: || Place { turn: 0.0, ..middle() } },
    Symbol { name: "friction", words: ("dry friction", "сухое трение"), fit: Fit::Rigid, draw: friction, sample: across },
    Symbol {
        name: "slip_mark",
        words: ("friction in a joint", "трение в шарнире"),
        fit: Fit::Rigid,
        draw: slip_mark,
        sample: || Place { size: 0.5 * S, ..middle() },
    },
];

/// Along `path`.
fn thread(place: &Place, ink: &mut Ink) {
    ink.way(Weight::Thin, &place.path);
}

fn ring_eye(place: &Place, ink: &mut Ink) {
    ink.circle(Weight::Part, Fill::None, (place.at, 0.18 * S));
}

/// A drum of radius `size` with a hub.
fn drum(place: &Place, ink: &mut Ink) {
    ink.circle(Weight::Part, Fill::Tint, (place.at, place.size));
    let [a, b] = [0.66, 0.9].map(|share| crate::scheme::ink::polar(place.at, share * place.size, place.turn));
    ink.way(Weight::Part, &[a, b]);
}

/// A buffer on a wall: what comes in the direction `turn` meets it at `at`.
fn stop(place: &Place, ink: &mut Ink) {
    let axis = Local::new(place.at, place.turn);
    ink.outline(
        Weight::Part,
        Fill::Ink,
        &[axis.at(0.0, -0.22 * S), axis.at(0.35 * S, -0.38 * S), axis.at(0.35 * S, 0.38 * S), axis.at(0.0, 0.22 * S)],
    );
    ink.hatched(axis.at(0.35 * S, -0.75 * S), axis.at(0.35 * S, 0.75 * S));
}

/// Rough teeth along `at`-`to`.
fn friction(place: &Place, ink: &mut Ink) {
    let length = distance(place.at, place.to);
    let axis = Local::new(place.at, direction(place.at, place.to));
    let n = (length / 6.0).floor().clamp(2.0, 200.0) as usize;
    let step = length / n as f64;
    let way: Vec<_> = (0..=2 * n).map(|i| axis.at(step * i as f64 / 2.0, if i % 2 == 0 { 0.0 } else { 3.6 })).collect();
    ink.way(Weight::Part, &way);
}

/// Short strokes about a joint.
fn slip_mark(place: &Place, ink: &mut Ink) {
    for i in 0..8 {
        let out = Local::new(place.at, std::f64::consts::FRAC_PI_4 * f64::from(i));
        ink.way(Weight::Thin, &[out.at(place.size * 0.6, 0.0), out.at(place.size, 3.0)]);
    }
}
