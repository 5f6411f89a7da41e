//! Harmonics at the nodes of a turn, one after the other by multiplication.

use crate::studies::modes::Complex;
use algebra::elementary;

/// exp ikx at the nodes for k = 1, 2, ...
pub(super) struct Turn {
    one: Vec<Complex>,
    pub(super) now: Vec<Complex>,
}

impl Turn {
    pub(super) fn new(nodes: &[f64]) -> Turn {
        let one: Vec<Complex> = nodes.iter().map(|x| (elementary::cos(*x), elementary::sin(*x))).collect();
        Turn { now: one.clone(), one }
    }

    pub(super) fn next(&mut self) {
        for (a, b) in self.now.iter_mut().zip(&self.one) {
            *a = (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0);
        }
    }

    /// Adds Re(z exp ikx).
    pub(super) fn add(&self, row: &mut [f64], z: Complex) {
        row.iter_mut().zip(&self.now).for_each(|(v, (c, s))| *v += z.0 * c - z.1 * s);
    }
}
