//! Rayleigh's method for a rod: with the deflection w(s) q(t), T = m_r q'²/2 and Π = c_r q²/2 at the place where w = 1,
//!
//! ```text
//! m_r = ∫ ρA w² ds / w(s₀)²      c_r = ∫ EI w''² ds / w(s₀)²      ω² = c_r/(m_r + masses of the nodes)
//! ```
//!
//! The integrals are Gaussian sums of 16 points on 8 pieces: exact for polynomial shapes up to rounding.

use crate::frame::bind::Numbers;
use mechanics::Model;
use mechanics::structure::{AssumedShape, Structure};
use words::Text;

/// The rod as one degree of freedom.
#[derive(Clone, Debug, PartialEq)]
pub struct Reduced {
    /// Name of the shape.
    pub name: String,
    /// What it is.
    pub label: Text,
    /// Name of the rod.
    pub rod: String,
    /// m_r of the rod alone.
    pub mass: f64,
    /// m_r as a share of the mass of the rod.
    pub share: f64,
    /// c_r; NaN without EI.
    pub stiffness: f64,
    /// Masses and moments of inertia of the nodes at its ends and the rotary inertia of the rod, reduced to the same place.
    pub lumped: f64,
    /// Stiffness of the springs of the nodes at its ends, reduced to the same place.
    pub springs: f64,
    /// ω; NaN without EI.
    pub omega: f64,
}

const PIECES: usize = 8;

/// All assumed shapes of a structure.
pub fn all(model: &Model, structure: &Structure) -> Vec<Reduced> {
    structure.rayleigh.iter().map(|shape| one(model, structure, shape)).collect()
}

fn one(model: &Model, structure: &Structure, assumed: &AssumedShape) -> Reduced {
    let rod = &structure.rods[assumed.rod];
    let mut numbers = Numbers::of(model);
    let length = numbers.value(rod.length);
    let line = numbers.value(rod.mass);
    let bending = rod.bending.map_or(f64::NAN, |e| numbers.value(e));
    let at = numbers.value(assumed.at);
    let place = |s: f64, e| numbers.at(e, assumed.distance, s);
    let unit = place(at, assumed.shape);
    let (nodes, weights) = gauss();
    let (mut squares, mut slopes, mut curvatures) = (0.0, 0.0, 0.0);
    let piece = length / PIECES as f64;
    for k in 0..PIECES {
        for (x, w) in nodes.iter().zip(&weights) {
            let s = piece * (k as f64 + 0.5 * (1.0 + x));
            let (deflection, curvature) = (place(s, assumed.shape) / unit, place(s, assumed.curvature) / unit);
            let slope = place(s, assumed.slope) / unit;
            squares += 0.5 * piece * w * deflection * deflection;
            slopes += 0.5 * piece * w * slope * slope;
            curvatures += 0.5 * piece * w * curvature * curvature;
        }
    }
    let (mut lumped, mut springs) = (0.0, 0.0);
    let corners = rod.ends.map(|i| structure.nodes[i].at.map(|e| numbers.value(e)));
    // across the rod; its own length is that between its nodes
    let across = [0, 1].map(|i| (corners[1][1 - i] - corners[0][1 - i]) / length);
    for (i, s) in rod.ends.iter().zip([0.0, length]) {
        let node = &structure.nodes[*i];
        let [deflection, slope] = [assumed.shape, assumed.slope].map(|e| numbers.at(e, assumed.distance, s) / unit);
        let [x, y, turn] = node.springs.map(|e| numbers.value(e));
        lumped += numbers.value(node.mass) * deflection * deflection + numbers.value(node.inertia) * slope * slope;
        springs += (x * across[0] * across[0] + y * across[1] * across[1]) * deflection * deflection + turn * slope * slope;
    }
    lumped += numbers.value(rod.rotary) * slopes;
    let (mass, stiffness) = (line * squares, bending * curvatures);
    let omega = ((stiffness + springs) / (mass + lumped)).sqrt();
    let (name, label) = (assumed.name.clone(), assumed.label.clone());
    Reduced { name, label, rod: rod.name.clone(), mass, share: squares / length, stiffness, lumped, springs, omega }
}

/// Abscissas and weights of 16 points by Newton's method on Legendre's polynomial. *Source*: M. Abramowitz, I. A. Stegun, 25.4.29.
fn gauss() -> (Vec<f64>, Vec<f64>) {
    let n = 16;
    let point = |i: usize| {
        let mut x = algebra::elementary::cos(std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5));
        let mut slope = 1.0;
        for _ in 0..20 {
            let (mut p, mut q) = (1.0, 0.0);
            for k in 1..=n {
                let k = k as f64;
                (p, q) = (((2.0 * k - 1.0) * x * p - (k - 1.0) * q) / k, p);
            }
            slope = n as f64 * (x * p - q) / (x * x - 1.0);
            x -= p / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..n).map(point).unzip()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gauss_integrates_powers_exactly() {
        let (x, w) = gauss();
        for power in 0..=31 {
            let sum: f64 = x.iter().zip(&w).map(|(x, w)| w * algebra::elementary::powi(*x, power)).sum();
            let exact = if power % 2 == 0 { 2.0 / f64::from(power + 1) } else { 0.0 };
            // sums of a dozen weights
            assert!((sum - exact).abs() < 1e-14, "{power}: {sum}");
        }
    }
}
