//! Stable places beside an unstable one: where a machine comes to rest that is let go a little off it.
//!
//! ```text
//! q₀ ± δ v,      v: shapes of the motions that grow from q₀ without oscillation,      then downhill ([`super::fall`])
//! ```

use algebra::arrange::Arrange;
use std::f64::consts::TAU;

use super::branch::diverging;
use super::fall::fall;
use crate::linear::{LinearMachine, Place};
use crate::rest::sizes::Sizes;

/// How far off it is let go, of the coordinate that moves most, relative to its size.
const OFF: f64 = 1e-4;
/// Distance of places that are one, relative to the sizes.
const ONE: f64 = 1e-6;
/// Shapes that are tried, those that grow fastest.
const SHAPES: usize = 2;

/// The stable places, each once; whole turns of angles do not tell places apart.
pub fn beside(machine: &mut LinearMachine, place: &Place) -> Vec<Place> {
    let Ok(mut growing) = diverging(machine, place) else { return Vec::new() };
    growing.arrange_by(|a, b| b.root.0.total_cmp(&a.root.0));
    let units: Vec<String> = machine.coordinates().iter().map(|c| c.unit.clone()).collect();
    let sizes = Sizes::new(units.iter().map(String::as_str));
    let mut found: Vec<Place> = Vec::new();
    for mode in growing.iter().take(SHAPES) {
        let shape: Vec<f64> = mode.shape.iter().map(|z| z.0).collect();
        let most = (0..shape.len()).max_by(|i, j| shape[*i].abs().total_cmp(&shape[*j].abs())).unwrap_or(0);
        let away = OFF * sizes.at(&[&place.q])[most] / shape[most].abs();
        for sign in [1.0, -1.0] {
            let guess: Vec<f64> = place.q.iter().zip(&shape).map(|(q, v)| q + sign * away * v).collect();
            let Some(there) = fall(machine, &guess).and_then(|q| machine.settle(&q).ok()) else { continue };
            let known = |other: &Place| same(&sizes, &units, [&other.q, &there.q]);
            let stands = diverging(machine, &there).is_ok_and(|list| list.is_empty());
            if stands && !known(place) && !found.iter().any(known) {
                found.push(there);
            }
        }
    }
    found
}

fn same(sizes: &Sizes, units: &[String], [a, b]: [&[f64]; 2]) -> bool {
    let turned = |((a, b), unit): ((&f64, &f64), &String)| if unit == "rad" { a + TAU * ((b - a) / TAU).round() } else { *a };
    let a: Vec<f64> = a.iter().zip(b).zip(units).map(turned).collect();
    sizes.same([&a, b], b, ONE)
}
