//! From multipliers to exponents and a verdict.

use super::diagram::TRACE;
use crate::studies::periodic::{Multiplier, NEUTRAL};
use algebra::elementary;

/// Distance of multipliers below which they are not told apart: a double root moves by the root of an error.
const APART: f64 = 1e-4;
/// Error up to which two multipliers are reciprocal.
const RECIPROCAL: f64 = 1e-7;

/// Damping over a period below which it is none: a multiplier that it makes differs from the circle by some hundred roundings, as the mean of a damping that is as often negative does.
pub(super) const UNDAMPED: f64 = 1e-13;

/// What linear equations with periodic coefficients say of disturbances.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// They die out, or stay bounded.
    Stable,
    /// Some grow.
    Unstable,
    /// A limiting case: multipliers on the unit circle that are not simple, or not known well enough.
    Limit,
}

impl Verdict {
    /// Name in files.
    pub fn key(self) -> &'static str {
        match self {
            Verdict::Stable => "stable",
            Verdict::Unstable => "unstable",
            Verdict::Limit => "limit",
        }
    }
    /// From the trace of y'' + ψ y = 0 and the damping over its period, q = y exp(-∫h dt): disturbances of q grow where |tr M| > 2 ch hT.
    pub fn of_trace([trace, damping]: [f64; 2]) -> Verdict {
        // negative damping: the product of the multipliers is larger than 1
        if damping < -UNDAMPED {
            Verdict::Unstable
        } else {
            Verdict::of_excess(trace.abs() - 2.0 * elementary::cosh(damping), TRACE * trace.abs().max(1.0))
        }
    }
    /// From a quantity that is negative where disturbances do not grow, known to `error`.
    pub fn of_excess(excess: f64, error: f64) -> Verdict {
        match excess {
            x if x > error => Verdict::Unstable,
            x if x < -error => Verdict::Stable,
            _ => Verdict::Limit,
        }
    }
}

/// An exponent s = σ + iν, the imaginary part within half of the frequency of the coefficients.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Exponent {
    /// σ, 1/s.
    pub growth: f64,
    /// ν, rad/s.
    pub frequency: f64,
    /// By how much it may be wrong, 1/s.
    pub error: f64,
}

/// ln μ / T of each multiplier that is no shift along the motion; none for a multiplier that is 0.
pub fn exponents(multipliers: &[Multiplier], period: f64) -> Vec<Option<Exponent>> {
    let exponent = |m: &Multiplier| {
        let log = m.log_abs.unwrap_or_else(|| elementary::ln(m.abs()));
        let error = if m.log_abs.is_some() { 0.0 } else { m.error / m.abs() };
        log.is_finite().then(|| Exponent { growth: log / period, frequency: elementary::atan2(m.im, m.re) / period, error: error / period })
    };
    multipliers.iter().map(exponent).collect()
}

/// The greatest growth of multipliers that are no shift along the motion, 1/s.
pub fn growth(multipliers: &[Multiplier], period: f64) -> Option<f64> {
    let own: Vec<Multiplier> = multipliers.iter().filter(|m| !m.trivial).copied().collect();
    exponents(&own, period).into_iter().flatten().map(|s| s.growth).reduce(f64::max)
}

/// The multipliers without those of `count` states that are functions of time alone, which are 1.
pub fn without_clocks(multipliers: &[Multiplier], count: usize) -> Vec<Multiplier> {
    let mut kept = multipliers.to_vec();
    for _ in 0..count {
        let off = |m: &Multiplier| elementary::hypot(m.re - 1.0, m.im);
        let nearest = (0..kept.len()).min_by(|a, b| {
            let rank = |k: &usize| (!kept[*k].trivial, off(&kept[*k]));
            rank(a).partial_cmp(&rank(b)).unwrap_or(std::cmp::Ordering::Equal)
        });
        if let Some(nearest) = nearest {
            kept.remove(nearest);
        }
    }
    kept
}

/// What multipliers say. Those on the unit circle let disturbances stay bounded only where they are simple and cannot leave it: reciprocal in pairs.
pub fn verdict(multipliers: &[Multiplier]) -> Verdict {
    let own: Vec<&Multiplier> = multipliers.iter().filter(|m| !m.trivial).collect();
    let margin = |m: &Multiplier| m.error.max(NEUTRAL);
    if own.iter().any(|m| m.abs() - 1.0 > margin(m)) {
        return Verdict::Unstable;
    }
    if own.iter().all(|m| 1.0 - m.abs() > margin(m)) {
        return Verdict::Stable;
    }
    let lone = own.len() < multipliers.len();
    if !lone && stay(&own) { Verdict::Stable } else { Verdict::Limit }
}

/// Whether all lie on the unit circle, apart from one another, none at ±1.
fn stay(own: &[&Multiplier]) -> bool {
    let on_circle = |m: &&&Multiplier| (m.abs() - 1.0).abs() <= m.error.min(RECIPROCAL);
    let distance = |a: &Multiplier, b: &Multiplier| elementary::hypot(a.re - b.re, a.im - b.im);
    let apart = |i: usize| own[..i].iter().all(|other| distance(own[i], other) > APART.max(2.0 * own[i].error));
    own.iter().filter(on_circle).count() == own.len() && (0..own.len()).all(apart) && own.iter().all(|m| m.im != 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Some hundred roundings of numbers about 1.
    const EXACT: f64 = 1e-13;

    fn multiplier(re: f64, im: f64) -> Multiplier {
        Multiplier { re, im, error: 1e-12, ..Multiplier::default() }
    }

    #[test]
    fn verdicts_follow_the_unit_circle() {
        let (s, c) = elementary::sin_cos(0.7);
        let pair = [multiplier(c, s), multiplier(c, -s)];
        assert_eq!(verdict(&pair), Verdict::Stable);
        assert_eq!(verdict(&[multiplier(2.0, 0.0), multiplier(0.5, 0.0)]), Verdict::Unstable);
        assert_eq!(verdict(&[multiplier(-0.9, 0.0), multiplier(0.5, 0.0)]), Verdict::Stable);
        assert_eq!(verdict(&[multiplier(-1.0, 0.0), multiplier(-1.0, 0.0)]), Verdict::Limit);
        // hardly any damping of the wrong sign: outside by more than its error, by less than decides
        let growth = 1.0 + 0.5 * NEUTRAL;
        assert_eq!(verdict(&[multiplier(growth * c, growth * s), multiplier(growth * c, -growth * s)]), Verdict::Limit);
        // two equal pairs may grow with time
        assert_eq!(verdict(&[pair, pair].concat()), Verdict::Limit);
        // nothing holds a pair on the circle beside one that dies out
        assert_eq!(verdict(&[&pair[..], &[multiplier(0.5, 0.0)]].concat()), Verdict::Limit);
        let shift = Multiplier { trivial: true, ..multiplier(1.0, 0.0) };
        assert_eq!(verdict(&[shift, multiplier(0.2, 0.0)]), Verdict::Stable);
    }

    #[test]
    fn exponents_are_logarithms_over_the_period() {
        let found = exponents(&[multiplier(-elementary::exp(0.3), 0.0)], 2.0)[0].unwrap();
        assert!((found.growth - 0.15).abs() < EXACT && (found.frequency - std::f64::consts::FRAC_PI_2).abs() < EXACT);
        assert_eq!(exponents(&[multiplier(0.0, 0.0)], 2.0), [None]);
        assert_eq!(without_clocks(&[multiplier(1.0, 0.0), multiplier(0.3, 0.0)], 1), [multiplier(0.3, 0.0)]);
    }
}
