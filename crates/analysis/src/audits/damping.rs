//! Power of the parts of the accelerations that are proportional to the rates, or to the places, all taken by size.
//!
//! A single load may hold terms that cancel, as (μ (1 − x²) x' − x) does on the slow branches of a relaxation oscillation, and so do strong dampers between
//! bodies that move together: what passes through them is the scale of rounding, not what is left of it.

use crate::{Jacobian, Mode, System};
use std::ops::Range;

/// Σ_ij |∂x''_i/∂x'_j x'_j| as a power, W; zero where the system gives no Jacobian or no powers.
///
/// *Shapes*: `x` is a state (q, q', s).
pub fn damping_alone<S: System + ?Sized>(system: &mut S, t: f64, x: &[f64], modes: &[Mode]) -> f64 {
    let n = system.n_coordinates();
    parts_alone(system, t, (x, n..2 * n), modes)
}

/// Σ_ij |∂x''_i/∂q_j q_j| as a power, W: its share ε is what the rounding of the places alone makes of the powers. Zero as above.
pub fn places_alone<S: System + ?Sized>(system: &mut S, t: f64, x: &[f64], modes: &[Mode]) -> f64 {
    let n = system.n_coordinates();
    parts_alone(system, t, (x, 0..n), modes)
}

fn parts_alone<S: System + ?Sized>(system: &mut S, t: f64, (x, columns): (&[f64], Range<usize>), modes: &[Mode]) -> f64 {
    let (n, width) = (system.n_coordinates(), x.len());
    let mut jacobian = vec![0.0; width * width];
    if !matches!(system.jacobian(t, x, modes, &mut jacobian), Ok(Jacobian::Given)) {
        return 0.0;
    }
    let part = |i: usize| {
        let terms: f64 = columns.clone().map(|j| (jacobian[(n + i) * width + j] * x[j]).abs()).sum();
        terms.copysign(x[n + i])
    };
    let parts: Vec<f64> = (0..n).map(part).collect();
    let still = vec![0.0; n];
    let (Some(moved), Some(still)) = (system.powers(t, x, &parts, modes), system.powers(t, x, &still, modes)) else { return 0.0 };
    (moved.rate - still.rate).abs()
}
