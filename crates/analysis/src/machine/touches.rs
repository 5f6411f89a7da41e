//! Contacts and frictions in numbers, for audits: from the tape `touches`, which goes by values where the dynamics go by modes.

use algebra::elementary;
use program::{Point, TouchRoots};

use super::Machine;
use super::switches::Switches;
use super::touching::Place;
use crate::system::{Touch, TouchLaw};

/// Rates by which the ratio of sliding speeds is found: those of no motion in particular.
const IRREGULAR: f64 = 0.618_033_988_749_894_9;

/// Values of the tape.
struct Values<'v>(&'v [f64]);

impl Values<'_> {
    fn of(&self, place: &Place, root: TouchRoots) -> f64 {
        self.0.get(place.root + root as usize).copied().unwrap_or(f64::NAN)
    }
    fn sized(&self, place: &Place, value: TouchRoots, size: TouchRoots) -> [f64; 2] {
        [self.of(place, value), self.of(place, size).sqrt()]
    }
}

impl Machine {
    /// All contacts and frictions with the accelerations and reactions in `inputs`; `idle` are the normal forces that count as none.
    pub(super) fn touches_with(&mut self, (t, x): (f64, &[f64]), inputs: &[f64], idle: &[[f64; 2]]) -> Option<Vec<Touch>> {
        let ratios = self.ratios(t, x, inputs)?;
        let n = self.bound.program().coordinates;
        let Switches { modes, active, .. } = &self.observing;
        let point = Point { time: t, states: x, accelerations: inputs, modes: Some(modes), active: Some(active) };
        let values = Values(self.touches.evaluate(&point).ok()?);
        let touch = |(i, place): (usize, &Place)| {
            let law = if place.friction {
                let [along, across] = idle.get(i).copied().unwrap_or_default();
                let normal =
                    elementary::hypot(values.of(place, TouchRoots::Leading) - along, values.of(place, TouchRoots::Across) - across);
                let limits = [TouchRoots::Back, TouchRoots::Forth, TouchRoots::Fixed].map(|root| normal * values.of(place, root));
                TouchLaw::Friction { limits, ratio: ratios[i] }
            } else {
                TouchLaw::Contact { gap: values.sized(place, TouchRoots::Leading, TouchRoots::PlaceSize) }
            };
            Touch {
                guard: place.guard,
                law,
                force: inputs.get(n + place.reaction).copied().unwrap_or(f64::NAN),
                rate: values.sized(place, TouchRoots::Rate, TouchRoots::RateSize),
                acceleration: values.sized(place, TouchRoots::Acceleration, TouchRoots::AccelerationSize),
                restitution: values.of(place, TouchRoots::Restitution),
            }
        };
        Some(self.touching.iter().enumerate().map(touch).collect())
    }

    /// Normal forces of frictions, by components, with the reactions in `inputs`.
    pub(super) fn normals(&mut self, (t, x): (f64, &[f64]), inputs: &[f64]) -> Option<Vec<[f64; 2]>> {
        let Switches { modes, active, .. } = &self.observing;
        let point = Point { time: t, states: x, accelerations: inputs, modes: Some(modes), active: Some(active) };
        let values = Values(self.touches.evaluate(&point).ok()?);
        let both = |place: &Place| [TouchRoots::Leading, TouchRoots::Across].map(|root| values.of(place, root));
        Some(self.touching.iter().map(both).collect())
    }

    /// Sliding speeds by those of the leaders, at rates at which none vanishes.
    fn ratios(&mut self, t: f64, x: &[f64], inputs: &[f64]) -> Option<Vec<f64>> {
        if self.touching.iter().enumerate().all(|(i, place)| place.leader == i) {
            return Some(vec![1.0; self.touching.len()]);
        }
        let n = self.bound.program().coordinates;
        let mut moved = x.to_vec();
        (0..n).for_each(|i| moved[n + i] = 1.0 + (IRREGULAR * (i + 1) as f64).fract());
        let Switches { modes, active, .. } = &self.observing;
        let point = Point { time: t, states: &moved, accelerations: inputs, modes: Some(modes), active: Some(active) };
        let values = Values(self.touches.evaluate(&point).ok()?);
        let rate = |i: usize| values.of(&self.touching[i], TouchRoots::Rate);
        let ratio = |(i, place): (usize, &Place)| if place.leader == i { 1.0 } else { rate(i) / rate(place.leader) };
        Some(self.touching.iter().enumerate().map(ratio).collect())
    }
}
