//! What the loads of a part of a rod displace inside it when both its ends are held: the part of the deflection that the displacements of the
//! ends do not know.
//!
//! With B w'''' = q, w = w' = 0 at both ends, q going linearly from q0 to q1; a force F across and a couple C at a, b = l - a, for x <= a:
//!
//! ```text
//! w = x² (l - x)² ((3l - x) q0 + (2l + x) q1)/(120 B l)
//! w = F b² x² (3 a l - 2 a x - l x)/(6 B l³),   w = C x² (b² (3l - 2x) - 2 b (3 a l - 2 a x - l x))/(6 B l³)
//! ```
//!
//! and beyond a the same seen from the other end, a couple then turning the other way. Along the rod, with A u'' = -p:
//!
//! ```text
//! u = x (l - x)((2l - x) p0 + (l + x) p1)/(6 A l),   u = F b x/(A l) for x <= a
//! ```
//!
//! *Source*: each satisfies its equation, the conditions at both ends and the jump at a, which the tests verify.

use crate::loads::Carried;
use crate::{Rod, RodKind};
use algebra::elementary;

/// Displacements along and across at the distance `x` from the start of a part of the length `l` with held ends.
///
/// *Units*: m. Rods that do not stretch or bend give zero; bars have no stiffness against bending that could be known.
pub fn own(rod: &Rod<f64>, l: f64, carried: &Carried<f64>, x: f64) -> [f64; 2] {
    let axial = rod.axial().map_or(0.0, |a| along(l, carried, x) / a);
    let bent = match &rod.kind {
        RodKind::Beam { bending, .. } => across(l, carried, x) / bending,
        RodKind::Rigid | RodKind::Bar(_) => 0.0,
    };
    [axial, bent]
}

/// A u.
fn along(l: f64, carried: &Carried<f64>, x: f64) -> f64 {
    let spread = |[p0, p1]: [f64; 2]| x * (l - x) * ((2.0 * l - x) * p0 + (l + x) * p1) / (6.0 * l);
    let point = |a: f64, f: f64| f * if x <= a { (l - a) * x } else { a * (l - x) } / l;
    let loads: f64 = carried.distributed.iter().map(|q| spread([q[0][0], q[1][0]])).sum();
    loads + carried.points.iter().map(|(a, f)| point(*a, f[0])).sum::<f64>()
}

/// B w.
fn across(l: f64, carried: &Carried<f64>, x: f64) -> f64 {
    let spread = |[q0, q1]: [f64; 2]| elementary::powi(x * (l - x), 2) * ((3.0 * l - x) * q0 + (2.0 * l + x) * q1) / (120.0 * l);
    let loads: f64 = carried.distributed.iter().map(|q| spread([q[0][1], q[1][1]])).sum();
    let point = |a: f64, f: &[f64; 3]| {
        if x <= a { before(l, a, x, [f[1], f[2]]) } else { before(l, l - a, l - x, [f[1], -f[2]]) }
    };
    loads + carried.points.iter().map(|(a, f)| point(*a, f)).sum::<f64>()
}

/// B w of a force across and a couple at `a`, not beyond it.
fn before(l: f64, a: f64, x: f64, [force, couple]: [f64; 2]) -> f64 {
    let b = l - a;
    let g = 3.0 * a * l - 2.0 * a * x - l * x;
    x * x * (force * b * b * g + couple * (b * b * (3.0 * l - 2.0 * x) - 2.0 * b * g)) / (6.0 * elementary::powi(l, 3))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Polynomials of a few terms: units of the last place.
    const ROUNDING: f64 = 1e-15;
    /// Second differences of polynomials of low degree: rounding over the square of the step.
    const DIFFERENCE: f64 = 1e-9;
    /// Slopes with the step 1e-5 on both sides of a load: step² and rounding over step.
    const SLOPE: f64 = 1e-8;
    /// Third and fourth differences: rounding over that power of the step.
    const THIRD: f64 = 1e-7;
    /// The slope of a held end with the step 1e-6, half of it beyond the rod: step times curvature.
    const END_SLOPE: f64 = 1e-6;

    const L: f64 = 1.7;

    fn spread(q0: f64, q1: f64) -> Carried<f64> {
        Carried { distributed: vec![[[q0, q0], [q1, q1]]], points: Vec::new() }
    }

    fn point(a: f64, f: [f64; 3]) -> Carried<f64> {
        Carried { distributed: Vec::new(), points: vec![(a, f)] }
    }

    /// The n-th derivative from one side by differences of step d, exact for the polynomials here up to rounding.
    fn derivative(f: &dyn Fn(f64) -> f64, n: u32, x: f64, d: f64) -> f64 {
        if n == 0 { f(x) } else { (derivative(f, n - 1, x + d, d) - derivative(f, n - 1, x, d)) / d }
    }

    #[test]
    fn ends_are_held() {
        for c in [spread(2.0, -3.0), point(0.6, [1.0, 1.0, 0.0]), point(0.6, [0.0, 0.0, 1.0])] {
            for x in [0.0, L] {
                assert!(across(L, &c, x).abs() < ROUNDING && along(L, &c, x).abs() < ROUNDING);
                let slope = (across(L, &c, x + 1e-6) - across(L, &c, x - 1e-6)) / 2e-6;
                assert!(slope.abs() < END_SLOPE, "{slope}");
            }
        }
    }

    #[test]
    fn the_fourth_derivative_is_the_load_across_and_the_second_the_load_along() {
        let (q0, q1) = (2.0, -3.0);
        let c = spread(q0, q1);
        for x in [0.2, 0.9, 1.4] {
            // differences of step d belong to x + 2d and x + d; the load is linear, so that they are exact there
            let d = 0.02;
            let w4 = derivative(&|x| across(L, &c, x), 4, x, d);
            let u2 = derivative(&|x| along(L, &c, x), 2, x, d);
            let q = |x: f64| q0 + (q1 - q0) * x / L;
            assert!((w4 - q(x + 2.0 * d)).abs() < THIRD, "{w4}");
            assert!((u2 + q(x + d)).abs() < DIFFERENCE, "{u2}");
        }
    }

    /// B w''' jumps by F at a force, B w'' by -C at a couple; deflection and slope do not jump.
    #[test]
    fn jumps_are_the_concentrated_loads() {
        let (a, d) = (0.6, 0.01);
        for (force, couple) in [(1.5, 0.0), (0.0, 0.7), (1.5, 0.7)] {
            let c = point(a, [0.0, force, couple]);
            let left = |x: f64| before(L, a, x, [force, couple]);
            let right = |x: f64| before(L, L - a, L - x, [force, -couple]);
            assert!((left(a) - right(a)).abs() < ROUNDING);
            let slope = |f: &dyn Fn(f64) -> f64| (f(a + 1e-5) - f(a - 1e-5)) / 2e-5;
            assert!((slope(&left) - slope(&right)).abs() < SLOPE);
            let second = |f: &dyn Fn(f64) -> f64| (f(a + d) - 2.0 * f(a) + f(a - d)) / (d * d);
            // the third derivative of a cubic is one number
            let third = |f: &dyn Fn(f64) -> f64| derivative(f, 3, a, d);
            assert!((third(&right) - third(&left) - force).abs() < THIRD);
            assert!((second(&right) - second(&left) + couple).abs() < DIFFERENCE);
            assert!((across(L, &c, 0.3) - left(0.3)).abs() < ROUNDING && (across(L, &c, 1.2) - right(1.2)).abs() < ROUNDING);
        }
    }

    #[test]
    fn known_deflections_in_the_middle() {
        let middle = across(L, &spread(1.0, 1.0), 0.5 * L);
        assert!((middle - L.powi(4) / 384.0).abs() < ROUNDING);
        let force = across(L, &point(0.5 * L, [0.0, 1.0, 0.0]), 0.5 * L);
        assert!((force - L.powi(3) / 192.0).abs() < ROUNDING);
    }
}
