//! Resonances and antiresonances: largest and smallest values of an amplitude over the frequency.
//!
//! Candidates come from a grid that is dense about the natural frequencies; each is refined where the derivative of |Y|² vanishes
//! (differences of fourth order over a few thousandths of the width of the peak, so that the place has about 11 digits). Without damping a
//! resonance is the natural frequency itself and an antiresonance a change of sign between two resonances.

use algebra::golden::{self, Section};

/// A largest or smallest value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Where.
    pub omega: f64,
    /// |Y|; infinite at a resonance without damping, zero at an exact antiresonance.
    pub amplitude: f64,
    /// Width √(|P/P''|) of P = |Y|²; zero where |Y| is infinite or zero.
    pub width: f64,
}

/// Narrowings by golden section: to 3e-13 of the interval at most.
const SECTIONS: i32 = 60;

/// Refines the largest (`sign` 1) or smallest (-1) value of P = |Y|² between `low` and `high`.
pub fn refine(power: &mut dyn FnMut(f64) -> f64, low: f64, high: f64, sign: f64) -> Peak {
    let mut left = SECTIONS;
    let section = golden::narrowest([low, high], &mut |x| sign * power(x), &mut |now| {
        left -= 1;
        // golden section sees no more than the root of rounding; the derivative goes on
        left >= 0 && now.length() > 1e-6 * now.ends[1].abs()
    });
    let coarse = 0.5 * (section.ends[0] + section.ends[1]);
    let width = curvature_width(power, coarse, 0.25 * (high - low));
    let omega = stationary(power, coarse, width, low, high);
    Peak { omega, amplitude: power(omega).max(0.0).sqrt(), width }
}

/// Where a function with one hump between the ends is largest, by golden section: to the square root of rounding.
pub fn highest(function: &mut dyn FnMut(f64) -> f64, low: f64, high: f64) -> f64 {
    // golden section sees no more than the root of rounding
    let wide = |now: &Section<f64>| now.length() > 1e-9 * (high - low) && now.places[0] > now.ends[0] && now.places[1] < now.ends[1];
    let [a, b] = golden::narrowest([low, high], function, &mut |now| wide(now)).ends;
    0.5 * (a + b)
}

/// √|P/P''|, with a step that shrinks until the three values lie on a parabola.
fn curvature_width(power: &mut dyn FnMut(f64) -> f64, at: f64, first: f64) -> f64 {
    let middle = power(at);
    let mut step = first;
    for _ in 0..60 {
        let bend = (2.0 * middle - power(at - step) - power(at + step)).abs();
        let width = step * (middle / bend).sqrt();
        if bend > 0.0 && step <= 0.05 * width {
            return width;
        }
        step *= 0.5;
    }
    step
}

/// Root of the derivative of P by the secant method.
fn stationary(power: &mut dyn FnMut(f64) -> f64, at: f64, width: f64, low: f64, high: f64) -> f64 {
    // near zero a flat top changes its shape over the frequency itself, sooner than over its width
    let width = width.min(at.abs());
    let h = 0.003 * width;
    let mut slope = |x: f64| 8.0 * (power(x + h) - power(x - h)) - (power(x + 2.0 * h) - power(x - 2.0 * h));
    let (mut x0, mut x1) = (at - 0.02 * width, at + 0.02 * width);
    let (mut f0, mut f1) = (slope(x0), slope(x1));
    let first = f0.abs().max(f1.abs());
    for _ in 0..30 {
        // below this the differences are rounding, and a secant through them leads anywhere
        if f1 == f0 || f1.abs() <= 1e-13 * first {
            break;
        }
        let next = x1 - f1 * (x1 - x0) / (f1 - f0);
        if !next.is_finite() || next < low || next > high {
            // left through an end of the bracket: six digits of the slope gone is a peak
            return if f1.abs() <= 1e-6 * first { x1 } else { at };
        }
        (x0, f0) = (x1, f1);
        (x1, f1) = (next, slope(next));
        // some ten units of the last place
        if (x1 - x0).abs() <= 1e-14 * x1.abs() {
            break;
        }
    }
    x1
}

/// Local extremes of values over a grid: positions k with neighbours on both sides, where P is largest (1) or smallest (-1). What stands out from the
/// values around it by no more than rounding of P is none.
pub fn candidates(values: &[f64], sign: f64) -> Vec<usize> {
    let v = |k: usize| sign * values[k];
    let local = |k: &usize| v(*k) > v(k - 1) && v(*k) >= v(k + 1) && values[*k].is_finite();
    (1..values.len().saturating_sub(1)).filter(local).filter(|&k| stands_out(values, k, sign)).collect()
}

/// Share of P by which an extreme must stand out from the values on both sides, up to where one is beyond it.
const ROUNDING: f64 = 1e-11;

fn stands_out(values: &[f64], k: usize, sign: f64) -> bool {
    let v = |k: usize| sign * values[k];
    let far = |j: &usize| v(k) - v(*j) > ROUNDING * values[k].abs().max(values[*j].abs());
    let side = |list: &mut dyn Iterator<Item = usize>| list.take_while(|j| v(*j) <= v(k) || values[*j].is_nan()).any(|j| far(&j));
    side(&mut (0..k).rev()) && side(&mut (k + 1..values.len()))
}

/// A change of sign to rounding: false position that halves the value at an end which stays (Illinois), bisection where that shrinks too little.
pub fn zero(function: &mut dyn FnMut(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let (mut at_low, mut at_high) = (function(low), function(high));
    // the end that moved last, and widths before
    let (mut moved, mut before) = (0, high - low);
    for step in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        let slow = step % 3 == 2 && high - low > 0.5 * std::mem::replace(&mut before, high - low);
        let chord = low - at_low * (high - low) / (at_high - at_low);
        let at = if slow || !(chord > low && chord < high) { middle } else { chord };
        let value = function(at);
        if value == 0.0 {
            return at;
        }
        if (value > 0.0) == (at_low > 0.0) {
            at_high = if moved == -1 { 0.5 * at_high } else { at_high };
            (low, at_low, moved) = (at, value, -1);
        } else {
            at_low = if moved == 1 { 0.5 * at_low } else { at_low };
            (high, at_high, moved) = (at, value, 1);
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// β² = 1/((1 - x²)² + 4 ν² x²) is largest at x = √(1 - 2 ν²), where β = 1/(2 ν √(1 - ν²)).
    #[test]
    fn resonance_of_the_oscillator_has_ten_digits() {
        for nu in [0.001, 0.01, 0.05, 0.1, 0.3, 0.5, 0.7] {
            let mut power = |x: f64| 1.0 / ((1.0 - x * x).powi(2) + 4.0 * nu * nu * x * x);
            let exact = (1.0_f64 - 2.0 * nu * nu).sqrt();
            let peak = refine(&mut power, 0.8 * exact, 1.3 * exact, 1.0);
            // a peak is flat: its place is known to less than its height
            assert!((peak.omega - exact).abs() < 2e-10 * exact, "{nu}: {} {exact}", peak.omega);
            let height = 1.0 / (2.0 * nu * (1.0 - nu * nu).sqrt());
            // the height at a flat place: rounding of the solution
            assert!((peak.amplitude - height).abs() < 1e-12 * height, "{nu}");
        }
    }
}
