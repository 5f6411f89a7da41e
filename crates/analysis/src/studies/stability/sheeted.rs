//! Hill's equation of a machine over two of its parameters: its Fourier coefficients are smooth functions of them, known from few places.
//!
//! ```text
//! q'' + 2h q' + k q = 0      T² ψ(τT) = m + Σ c_j cos 2πjτ + s_j sin 2πjτ,   h̄ T        τ = t/T
//! ```
//!
//! In the measure of its period the equation is told by these coefficients alone, so that a period which depends on the parameters is nothing special.

use super::diagram::{Damped, Equations};
use super::floquet::UNDAMPED;
use super::scalar::Scalar;
use algebra::hill::Hill;
use algebra::sheet::Sheet;

/// Error of the coefficients, as a share of the largest: harmonics of ψ below it are rounding of samples.
const COEFFICIENTS: f64 = 1e-11;
/// Share of the largest coefficient below which a harmonic is not there anywhere: rounding of polynomials.
const ABSENT: f64 = 1e-12;
/// Functions before the harmonics: the damping over the period, and the mean.
const BEFORE: usize = 2;

/// Hill's equation over a rectangle of two parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheeted {
    sheet: Sheet,
    /// How many least periods of ψ the given one holds.
    times: usize,
}

impl Sheeted {
    /// From the equations at places of a rectangle; none where one is not there, or the coefficients are no smooth functions of both parameters.
    pub fn of([x, y]: [[f64; 2]; 2], mut scalar: impl FnMut(f64, f64) -> Option<Scalar>) -> Option<Sheeted> {
        let sheet = Sheet::of(x, y, COEFFICIENTS, |x, y| scalar(x, y).as_ref().map(coefficients))?;
        let bounds = sheet.bounds();
        let largest = bounds.iter().fold(0.0_f64, |l, v| l.max(*v));
        let there = |k: usize| [0, 1].iter().any(|part| bounds.get(BEFORE + 2 * (k - 1) + part).is_some_and(|v| *v > ABSENT * largest));
        let harmonics = (bounds.len() - BEFORE.min(bounds.len())) / 2;
        let times = (1..=harmonics).filter(|k| there(*k)).fold(0, common).max(1);
        Some(Sheeted { sheet, times })
    }

    /// An equation in the same measure, as it is: without polynomials.
    pub fn exact(&self, scalar: &Scalar) -> Damped {
        self.damped(&coefficients(scalar))
    }

    /// Places at which the machine gave its equation.
    pub fn places(&self) -> usize {
        self.sheet.places
    }

    fn damped(&self, values: &[f64]) -> Damped {
        let times = self.times as f64;
        let (damping, mean) = (values.first().copied().unwrap_or(0.0), values.get(1).copied().unwrap_or(0.0));
        let damping = if damping.abs() <= UNDAMPED { 0.0 } else { damping };
        let harmonics = values.get(BEFORE..).unwrap_or_default().chunks_exact(2).skip(self.times - 1).step_by(self.times);
        let waves = harmonics.map(|w| [w[0] / (times * times), w[1] / (times * times)]).collect();
        Damped { hill: Hill { period: 1.0, mean: mean / (times * times), waves }, damping: damping / times }
    }
}

impl Equations for Sheeted {
    fn at(&self, x: f64, y: f64) -> Damped {
        self.damped(&self.sheet.at(x, y))
    }
}

/// h̄T, T²m, T²c_1, T²s_1, ... over the given period.
fn coefficients(scalar: &Scalar) -> Vec<f64> {
    let period = scalar.hill.period * scalar.parts as f64;
    let mut all = vec![0.0; BEFORE + 2 * scalar.parts * scalar.hill.waves.len()];
    (all[0], all[1]) = (scalar.decay * period, scalar.hill.mean * period * period);
    for (k, wave) in scalar.hill.waves.iter().enumerate() {
        let first = BEFORE + 2 * ((k + 1) * scalar.parts - 1);
        (all[first], all[first + 1]) = (wave[0] * period * period, wave[1] * period * period);
    }
    all
}

/// Greatest common divisor.
fn common(mut a: usize, mut b: usize) -> usize {
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a
}

#[cfg(test)]
mod tests {
    use super::super::diagram::Diagram;
    use super::*;
    use algebra::elementary;
    use algebra::mathieu;
    use std::f64::consts::PI;

    /// q'' + 2h q' + (d + h² - 2e cos wt) q = 0 over d and w, told over three periods 2π/w each: Mathieu's equation with 4d/w², 4e/w² in each of them.
    #[test]
    fn a_period_that_depends_on_a_parameter_is_nothing_special() {
        let (e, h) = (0.6, 0.05);
        let scalar = |d: f64, w: f64| Scalar::of(6.0 * PI / w, |t| Some(d + h * h - 2.0 * e * elementary::cos(w * t)), |_| Some(h));
        let ends = [[0.5, 6.0], [1.5, 3.0]];
        let sheeted = Sheeted::of(ends, scalar).unwrap();
        assert_eq!(sheeted.times, 3);
        let diagram = Diagram::of(sheeted, ends, [300, 300]);
        for (d, w) in [(0.5, 1.5), (3.3, 2.2), (6.0, 3.0), (1.7, 2.9)] {
            let [trace, damping] = diagram.trace(d, w);
            let own = mathieu::trace(4.0 * d / (w * w), 4.0 * e / (w * w));
            // what is promised of traces
            assert!((trace - own).abs() < 1e-10 * own.abs().max(1.0), "{d} {w}: {trace} {own}");
            // that of the coefficients
            assert!((damping - h * 2.0 * PI / w).abs() < 1e-11);
            let [exact, _] = diagram.equations.exact(&scalar(d, w).unwrap()).trace();
            // steps of a period
            assert!((exact - own).abs() < 1e-11 * own.abs().max(1.0));
        }
    }

    #[test]
    fn jumps_over_a_parameter_have_no_sheet() {
        let scalar =
            |d: f64, e: f64| Scalar::of(PI, |t| Some(if d < 0.3 { d } else { d + 1.0 } - e * elementary::cos(2.0 * t)), |_| Some(0.0));
        assert_eq!(Sheeted::of([[0.0, 1.0], [0.0, 1.0]], scalar), None);
    }
}
