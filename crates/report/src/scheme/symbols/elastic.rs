//! Springs and dampers.

use super::{Symbol, across, middle};
use crate::scheme::ink::{Local, between, direction, distance, polar};
use crate::scheme::{Fill, Fit, Ink, P, Place, S, Weight};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

pub(super) const ROWS: &[Symbol] = &[
    Symbol { name: "spring", words: ("spring", "пружина"), fit: Fit::Stretch, draw: spring, sample: across },
    Symbol {
        name: "torsion_spring",
        words: ("torsion spring", "спиральная пружина"),
        fit: Fit::Rigid,
        draw: torsion_spring,
        sample: || Place { size: 1.1 * S, ..middle() },
    },
    Symbol { name: "damper", words: ("damper", "демпфер"), fit: Fit::Stretch, draw: damper, sample: across },
    Symbol {
        name: "torsion_damper",
        words: ("rotary damper", "вращательный демпфер"),
        fit: Fit::Rigid,
        draw: torsion_damper,
        sample: || Place { size: 1.1 * S, turn: 0.6, ..middle() },
    },
    Symbol {
        name: "backlash", words: ("spring with backlash", "пружина с зазором"), fit: Fit::Stretch, draw: backlash, sample: across
    },
    Symbol { name: "torsion_bar", words: ("torsion bar", "торсион"), fit: Fit::Stretch, draw: torsion_bar, sample: across },
];

/// Coils between `at` and `to`; the leads keep their length.
fn spring(place: &Place, ink: &mut Ink) {
    ink.way(Weight::Part, &coils(place.at, place.to));
}

/// Seven peaks between two ends.
fn coils(a: P, b: P) -> Vec<P> {
    let length = distance(a, b);
    let axis = Local::new(a, direction(a, b));
    let lead = (0.4 * S).min(length * 0.2);
    let (pitch, high) = ((length - 2.0 * lead) / 14.0, 0.34 * S);
    let mut points = vec![a, axis.at(lead, 0.0)];
    points.extend((0..7).flat_map(|i| {
        let x = lead + pitch * f64::from(2 * i);
        [axis.at(x + 0.5 * pitch, high), axis.at(x + 1.5 * pitch, -high)]
    }));
    points.extend([axis.at(length - lead, 0.0), b]);
    points
}

/// A spiral about `at`, its outer end at the radius `size` in the direction `turn`.
fn torsion_spring(place: &Place, ink: &mut Ink) {
    let (turns, outer) = (2.25, if place.size > 0.0 { place.size } else { S });
    let inner = 0.34 * outer;
    let n = 72;
    let points: Vec<P> = (0..=n)
        .map(|i| {
            let share = f64::from(i) / f64::from(n);
            polar(place.at, inner + (outer - inner) * share, place.turn - turns * TAU * (1.0 - share))
        })
        .collect();
    ink.way(Weight::Part, &points);
}

/// A cylinder at `at`, a piston on a rod from `to`; the piston moves in it by what the length exceeds that at rest, `other`.
fn damper(place: &Place, ink: &mut Ink) {
    let length = distance(place.at, place.to);
    let axis = Local::new(place.at, direction(place.at, place.to));
    let (half, bore) = ((0.62 * S).min(length * 0.3), 0.36 * S);
    let (bottom, open) = (length / 2.0 - half, length / 2.0 + half);
    ink.way(Weight::Part, &[place.at, axis.at(bottom, 0.0)]);
    ink.way(Weight::Part, &[axis.at(open, bore), axis.at(bottom, bore), axis.at(bottom, -bore), axis.at(open, -bore)]);
    let stroke = if place.other > 0.0 { 0.35 * (length - place.other) } else { 0.0 };
    let piston = length / 2.0 + 0.1 * half + stroke.clamp(-0.8 * half, 0.7 * half);
    ink.way(Weight::Link, &[axis.at(piston, 0.78 * bore), axis.at(piston, -0.78 * bore)]);
    ink.way(Weight::Part, &[axis.at(piston, 0.0), place.to]);
}

/// Two shoes about the axis `at`, a plate between them.
fn torsion_damper(place: &Place, ink: &mut Ink) {
    let r = if place.size > 0.0 { place.size } else { S };
    for radius in [0.74 * r, 1.1 * r] {
        ink.arc(Weight::Part, (place.at, radius), [place.turn - 0.55, place.turn + 0.55]);
    }
    ink.way(Weight::Part, &[polar(place.at, 0.74 * r, place.turn - 0.55), polar(place.at, 1.1 * r, place.turn - 0.55)]);
    ink.way(Weight::Link, &[polar(place.at, 0.8 * r, place.turn), polar(place.at, 1.04 * r, place.turn)]);
    ink.arc(Weight::Part, (place.at, 0.92 * r), [place.turn, place.turn + 0.9]);
}

/// A spring that ends in a fork with play.
fn backlash(place: &Place, ink: &mut Ink) {
    let length = distance(place.at, place.to);
    let axis = Local::new(place.at, direction(place.at, place.to));
    let (fork, jaw, h) = (length * 0.66, (0.9 * S).min(length * 0.26), 0.42 * S);
    ink.way(Weight::Part, &coils(place.at, axis.at(fork, 0.0)));
    ink.way(
        Weight::Part,
        &[
            axis.at(fork + jaw, 0.45 * h),
            axis.at(fork + jaw, h),
            axis.at(fork, h),
            axis.at(fork, -h),
            axis.at(fork + jaw, -h),
            axis.at(fork + jaw, -0.45 * h),
        ],
    );
    let knob = fork + jaw / 2.0;
    ink.way(Weight::Link, &[axis.at(knob, 0.6 * h), axis.at(knob, -0.6 * h)]);
    ink.way(Weight::Part, &[axis.at(knob, 0.0), place.to]);
}

/// A thin shaft with a twist.
fn torsion_bar(place: &Place, ink: &mut Ink) {
    let length = distance(place.at, place.to);
    let axis = Local::new(place.at, direction(place.at, place.to));
    for y in [-2.2, 2.2] {
        ink.way(Weight::Part, &[axis.at(0.0, y), axis.at(length, y)]);
    }
    let middle = between(place.at, place.to, 0.5);
    let twist: Vec<P> = (0..=16)
        .map(|i| {
            let a = FRAC_PI_2 - PI * 1.3 * f64::from(i) / 16.0;
            Local::new(middle, direction(place.at, place.to)).at(0.16 * S * a.cos(), 0.5 * S * a.sin())
        })
        .collect();
    ink.way(Weight::Thin, &twist);
    ink.outline(Weight::Thin, Fill::Ink, &arrow(&twist));
}

fn arrow(way: &[P]) -> Vec<P> {
    let (Some(&tip), Some(&before)) = (way.last(), way.get(way.len().saturating_sub(3))) else { return Vec::new() };
    let axis = Local::new(tip, direction(before, tip));
    vec![axis.at(3.0, 0.0), axis.at(-4.0, 2.4), axis.at(-4.0, -2.4)]
}
