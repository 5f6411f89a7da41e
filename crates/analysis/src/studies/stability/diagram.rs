//! The diagram of Ince and Strutt: Hill's equation over two of its coefficients.
//!
//! ```text
//! q'' + 2h q' + (a + b p(t)) q = 0      q = y e^(-ht):  y'' + (a - h² + b p) y = 0,  disturbances grow where |tr M| > 2 ch hT
//! ```
//!
//! tr M is an entire function of a and b, whatever p is, so that polynomials on patches give it everywhere ([`algebra::surface`]); values of the equation itself are their nodes. *Source*:
//! W. Magnus, S. Winkler, Hill's Equation, 1966, ch. II; E. L. Ince, Proc. R. Soc. Edinburgh 46 (1925); M. J. O. Strutt, Ergebn. Math. 1 (1932).

use algebra::hill::Hill;
use algebra::surface::{Rectangle, Surface};

/// Error of a trace, beside the larger of it and 1.
pub const TRACE: f64 = 1e-10;

/// q'' + 2h(t) q' + k(t) q = 0 with q = y exp(-∫h dt): y'' + ψ y = 0 over a period.
#[derive(Clone, Debug, PartialEq)]
pub struct Damped {
    /// ψ.
    pub hill: Hill,
    /// Mean of h times the period.
    pub damping: f64,
}

/// Equations that differ by two parameters, on which they depend smoothly.
pub trait Equations {
    /// The equation at (x, y).
    fn at(&self, x: f64, y: f64) -> Damped;
}

/// Equations that differ in a and b.
#[derive(Clone, Debug, PartialEq)]
pub struct Family {
    /// p over its least period.
    shape: Hill,
    /// h.
    decay: f64,
}

/// The traces of equations over a rectangle.
#[derive(Clone, Debug)]
pub struct Diagram<E> {
    /// The equations.
    pub equations: E,
    /// tr M and the damping over the period.
    surface: Surface<2>,
}

impl Damped {
    /// tr M of y and the damping over the period.
    pub fn trace(&self) -> [f64; 2] {
        [self.hill.monodromy().trace(), self.damping]
    }
}

impl Family {
    /// From p and from h >= 0.
    pub fn new(shape: &Hill, decay: f64) -> Family {
        Family { shape: shape.least().0, decay }
    }
}

impl Equations for Family {
    fn at(&self, a: f64, b: f64) -> Damped {
        let waves = self.shape.waves.iter().map(|[c, s]| [b * c, b * s]).collect();
        let hill = Hill { period: self.shape.period, mean: a - self.decay * self.decay + b * self.shape.mean, waves };
        Damped { damping: self.decay * hill.period, hill }
    }
}

impl<E: Equations> Diagram<E> {
    /// Over a rectangle of both parameters, for so many points of each. The error of a trace is `TRACE` at most.
    pub fn of(equations: E, [x, y]: [[f64; 2]; 2], points: [usize; 2]) -> Diagram<E> {
        // what the nodes err by is far less: the rest is for the polynomials
        let asked = Rectangle { x, y, points, tolerance: 0.1 * TRACE };
        let surface = Surface::of(&asked, |x, y| Some(equations.at(x, y).trace()));
        Diagram { equations, surface }
    }

    /// tr M and the damping over the period.
    pub fn trace(&self, x: f64, y: f64) -> [f64; 2] {
        self.surface.at(x, y).unwrap_or_else(|| self.equations.at(x, y).trace())
    }

    /// The same at the points of a grid, those of each x together.
    pub fn traces(&self, xs: &[f64], ys: &[f64]) -> Vec<[f64; 2]> {
        let value =
            |(k, found): (usize, Option<[f64; 2]>)| found.unwrap_or_else(|| self.equations.at(xs[k / ys.len()], ys[k % ys.len()]).trace());
        self.surface.grid(xs, ys).into_iter().enumerate().map(value).collect()
    }

    /// Estimate of the error of a trace, beside the larger of it and 1.
    pub fn error(&self) -> f64 {
        self.surface.error
    }

    /// Solutions of the equation that were made.
    pub fn values(&self) -> usize {
        self.surface.values
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use algebra::elementary;
    use std::f64::consts::{PI, TAU};

    /// y'' + (a - 2 q cos 2t) y = 0, b = q.
    fn mathieu(decay: f64) -> Family {
        Family::new(&Hill { period: PI, mean: 0.0, waves: vec![[-2.0, 0.0]] }, decay)
    }

    /// Points of a grid that are not those of another grid.
    fn line([low, high]: [f64; 2], count: usize) -> Vec<f64> {
        (0..count).map(|k| low + (high - low) * (k as f64 + 0.5) / count as f64).collect()
    }

    /// 500 times 500 traces cost some thousand solutions, and err by what is said: against the equation itself on a grid of its own.
    #[test]
    fn traces_keep_their_error() {
        let (a, b) = ([-5.0, 20.0], [0.0, 10.0]);
        let diagram = Diagram::of(mathieu(0.0), [a, b], [500, 500]);
        let (xs, ys) = (line(a, 41), line(b, 37));
        let mut worst = 0.0_f64;
        for (k, [trace, _]) in diagram.traces(&xs, &ys).into_iter().enumerate() {
            let own = algebra::mathieu::trace(xs[k / 37], ys[k % 37]);
            worst = worst.max((trace - own).abs() / own.abs().max(1.0));
        }
        assert!(worst <= TRACE && diagram.error() <= TRACE, "{worst:e}, said {:e}", diagram.error());
        assert!(diagram.values() <= 500 * 500 / 20, "{} solutions", diagram.values());
    }

    /// y = exp(∫ cos t) solves the equation with ψ = sin t - cos² t: at a = 0, b = 1 of this p the trace is 2. Beside it the equation itself tells.
    #[test]
    fn several_harmonics_are_as_exact() {
        let p = |t: f64| {
            let (sin, cos) = elementary::sin_cos(t);
            Some(sin - cos * cos)
        };
        let family = Family::new(&Hill::of(TAU, p).unwrap(), 0.0);
        let diagram = Diagram::of(family, [[-1.0, 4.0], [-2.0, 2.0]], [500, 500]);
        assert!((diagram.trace(0.0, 1.0)[0] - 2.0).abs() <= TRACE, "{:?}", diagram.trace(0.0, 1.0));
        for (a, b) in line([-1.0, 4.0], 17).into_iter().zip(line([-2.0, 2.0], 17)) {
            let [own, _] = diagram.equations.at(a, b).trace();
            assert!((diagram.trace(a, b)[0] - own).abs() <= TRACE * own.abs().max(1.0), "{a} {b}");
        }
    }
}
