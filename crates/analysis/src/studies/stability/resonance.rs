//! Which natural frequencies a parametric excitation couples.
//!
//! ```text
//! Ω_j + Ω_i ≈ k ω    combination resonance of sum type; i = j: parametric resonance of order k, k = 1 the principal one
//! Ω_j - Ω_i ≈ k ω    of difference type
//! ```
//!
//! Ω are the frequencies of the equations averaged over the period; inside a tongue disturbances of sum type have the frequencies
//! (k ω + Ω_j - Ω_i)/2 and (k ω - Ω_j + Ω_i)/2 up to multiples of ω. *Source*: V. A. Yakubovich, V. M. Starzhinskii, 1975, ch. VI; A. H. Nayfeh,
//! D. T. Mook, Nonlinear Oscillations, 1979, 5.4.

use super::floquet::Exponent;
use crate::Fault;
use algebra::eigen::general;
use std::f64::consts::TAU;

/// Largest order that is named.
const ORDERS: usize = 8;
/// Share of ω by which the frequency of the growing disturbance may miss that of the tongue.
const NEAR: f64 = 0.05;
/// What an order more must gain, in shares of ω: low orders are strong.
const ORDER: f64 = 0.01;

/// Kinds of tongues.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tongue {
    /// 2Ω = ω.
    Principal,
    /// 2Ω = kω.
    Parametric,
    /// Ω_j + Ω_i = kω.
    Sum,
    /// Ω_j - Ω_i = kω.
    Difference,
    /// The averaged equations are unstable themselves.
    Averaged,
}

impl Tongue {
    /// Name in files.
    pub fn key(self) -> &'static str {
        match self {
            Tongue::Principal => "principal",
            Tongue::Parametric => "parametric",
            Tongue::Sum => "combination sum",
            Tongue::Difference => "combination difference",
            Tongue::Averaged => "averaged",
        }
    }
}

/// What makes disturbances grow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resonance {
    /// Its kind.
    pub tongue: Tongue,
    /// k.
    pub order: usize,
    /// i, j: which of the frequencies of the averaged equations, from the least on, counted from 1.
    pub pair: [usize; 2],
    /// Ω_i, Ω_j, rad/s.
    pub frequencies: [f64; 2],
    /// ω, rad/s.
    pub forcing: f64,
    /// Ω_j ± Ω_i - kω, rad/s.
    pub detuning: f64,
}

impl Resonance {
    /// Where its tongue opens: ω ≈ 2Ω₁/3, ω ≈ (Ω₁ + Ω₂)/2; none where the averaged equations are unstable.
    pub fn name(&self) -> Option<String> {
        let [i, j] = self.pair.map(|k| format!("Ω{}", lowered(k)));
        let over = |text: String| if self.order == 1 { text } else { format!("({text})/{}", self.order) };
        let frequency = match (self.tongue, self.order) {
            (Tongue::Averaged, _) => return None,
            (Tongue::Sum, _) => over(format!("{i} + {j}")),
            (Tongue::Difference, _) => over(format!("{j} − {i}")),
            (_, 1) => format!("2{j}"),
            (_, 2) => j,
            (_, order) if order.is_multiple_of(2) => format!("{j}/{}", order / 2),
            (_, order) => format!("2{j}/{order}"),
        };
        Some(format!("ω ≈ {frequency}"))
    }
}

/// A number as an index.
fn lowered(number: usize) -> String {
    number.to_string().chars().map(|digit| digit.to_digit(10).and_then(|d| char::from_u32(0x2080 + d)).unwrap_or(digit)).collect()
}

/// The resonance that a growing disturbance belongs to; none where no combination of low order has its frequency. The coefficients are given at equally spaced instants.
///
/// *Errors*: an eigenproblem that does not settle.
pub fn resonance(period: f64, rows: &[Vec<f64>], growing: Exponent) -> Result<Option<Resonance>, Fault> {
    let Some(first) = rows.first() else { return Ok(None) };
    let n = (first.len() as f64).sqrt().round() as usize;
    let mean: Vec<f64> = (0..n * n).map(|e| rows.iter().map(|a| a[e]).sum::<f64>() / rows.len() as f64).collect();
    let values = general(n, &mean)?.values;
    let forcing = TAU / period;
    if values.iter().any(|s| s.re > 0.5 * growing.growth && s.re > 0.0) {
        return Ok(Some(Resonance { tongue: Tongue::Averaged, order: 0, pair: [0; 2], frequencies: [0.0; 2], forcing, detuning: 0.0 }));
    }
    let mut own: Vec<f64> = values.iter().map(|s| s.im).filter(|w| *w > 0.0).collect();
    own.sort_by(f64::total_cmp);
    let found = combinations(&own, forcing).filter(|c| miss(c, growing) <= NEAR * forcing);
    let cost = |c: &Resonance| c.detuning.abs() + miss(c, growing) + ORDER * forcing * c.order as f64;
    Ok(found.min_by(|a, b| cost(a).total_cmp(&cost(b))))
}

fn combinations(own: &[f64], forcing: f64) -> impl Iterator<Item = Resonance> + '_ {
    let pairs = (0..own.len()).flat_map(move |j| (0..=j).map(move |i| (i, j)));
    pairs.flat_map(move |(i, j)| {
        let of = move |sign: f64, order: usize| {
            let tongue = match (i == j, sign > 0.0, order) {
                (true, true, 1) => Tongue::Principal,
                (true, true, _) => Tongue::Parametric,
                (_, true, _) => Tongue::Sum,
                (_, false, _) => Tongue::Difference,
            };
            let detuning = own[j] + sign * own[i] - order as f64 * forcing;
            Resonance { tongue, order, pair: [i + 1, j + 1], frequencies: [own[i], own[j]], forcing, detuning }
        };
        (1..=ORDERS).flat_map(move |k| [of(1.0, k)].into_iter().chain((i != j).then(|| of(-1.0, k))))
    })
}

/// By how much the frequency of a disturbance misses that of the tongue, up to multiples of ω and the sign.
fn miss(c: &Resonance, growing: Exponent) -> f64 {
    let [i, j] = c.frequencies;
    let locked = 0.5 * (c.order as f64 * c.forcing + if c.tongue == Tongue::Difference { j + i } else { j - i });
    let other = locked - c.order as f64 * c.forcing;
    let distance = |a: f64| {
        let off = a / c.forcing;
        (off - off.round()).abs() * c.forcing
    };
    let nu = growing.frequency;
    [nu - locked, nu + locked, nu - other, nu + other].into_iter().map(distance).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What roundings become in the steps of a period, or in the matrix of a collocation.
    const STEPS: f64 = 1e-11;

    /// x_i'' + Ω_i² x_i with constant coefficients: only the frequencies and the growing exponent decide.
    fn rows(own: &[f64]) -> Vec<Vec<f64>> {
        let n = own.len();
        let mut a = vec![0.0; 4 * n * n];
        for (i, w) in own.iter().enumerate() {
            a[i * 2 * n + n + i] = 1.0;
            a[(n + i) * 2 * n + i] = -w * w;
        }
        vec![a; 4]
    }

    fn named(own: &[f64], forcing: f64, frequency: f64) -> Resonance {
        let growing = Exponent { growth: 0.1, frequency, error: 0.0 };
        resonance(TAU / forcing, &rows(own), growing).unwrap().unwrap()
    }

    #[test]
    fn tongues_are_named_by_their_frequencies() {
        assert_eq!(named(&[1.0], 2.05, 1.025).tongue, Tongue::Principal);
        assert_eq!(named(&[1.0], 2.05, 1.025).name().as_deref(), Some("ω ≈ 2Ω₁"));
        let second = named(&[1.0], 1.02, 0.0);
        assert_eq!(second.name().as_deref(), Some("ω ≈ Ω₁"));
        assert_eq!((second.tongue, second.order), (Tongue::Parametric, 2));
        // Ω₁ + Ω₂ = 1 + 1.7; the disturbance has (ω + Ω₂ - Ω₁)/2 less ω
        let sum = named(&[1.0, 1.7], 2.7, -1.0);
        assert!(sum.tongue == Tongue::Sum && sum.order == 1 && sum.detuning.abs() < STEPS, "{sum:?}");
        assert_eq!(sum.name().as_deref(), Some("ω ≈ Ω₁ + Ω₂"));
        let half = Resonance { order: 2, ..sum };
        assert_eq!(half.name().as_deref(), Some("ω ≈ (Ω₁ + Ω₂)/2"));
        let difference = named(&[1.0, 1.7], 0.7, 0.3);
        assert_eq!((difference.tongue, difference.order), (Tongue::Difference, 1));
    }

    #[test]
    fn an_averaged_system_that_falls_is_no_resonance() {
        let growing = Exponent { growth: 1.0, frequency: 0.0, error: 0.0 };
        let found = resonance(1.0, &[vec![0.0, 1.0, 1.0, 0.0]], growing).unwrap().unwrap();
        assert_eq!(found.tongue, Tongue::Averaged);
    }
}
