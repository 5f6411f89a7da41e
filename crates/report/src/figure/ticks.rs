//! Where the ticks of an axis stand and what is written at them.

use crate::number::{fixed, scientific, superscript};
use words::Language;

/// A tick: value in shown units, and its label (empty for a tick without words).
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// Where.
    pub at: f64,
    /// What is written.
    pub label: String,
}

/// Ticks at multiples of 1, 2 or 5 times a power of ten inside [low, high], about `wanted` of them, with equal decimals.
pub fn linear(low: f64, high: f64, wanted: usize, language: Language) -> Vec<Tick> {
    let span = high - low;
    if !(span.is_finite() && span > 0.0) {
        return Vec::new();
    }
    let raw = span / wanted.max(1) as f64;
    let power = raw.log10().floor();
    let base = 10_f64.powf(power);
    let step = [1.0, 2.0, 5.0, 10.0].iter().map(|m| m * base).find(|s| *s >= raw * 0.999).unwrap_or(10.0 * base);
    // ends that are ticks themselves, but for the rounding of the quotient
    let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
    if !(step > 0.0 && last - first < 1000.0 && first.abs() < 1e12) {
        return Vec::new();
    }
    let values: Vec<f64> = (0..=(last - first) as usize).map(|i| (first + i as f64) * step).collect();
    let largest = low.abs().max(high.abs());
    // the logarithm of a power of ten is rounded
    let decimals = (-(step.log10() + 1e-9).floor()).max(0.0) as usize;
    // numbers with more than three zeros in front or six digits are read as powers
    let far = !(1e-3..1e6).contains(&largest);
    // enough decimals of the mantissa that neighbours differ
    let mantissa = (largest.log10().floor() - (step.log10() + 1e-9).floor()).clamp(0.0, 15.0) as usize;
    let label = |v: f64| match far {
        true if v == 0.0 => "0".into(),
        true => scientific(v, mantissa, language),
        false => fixed(v, decimals, language),
    };
    values.into_iter().map(|at| Tick { at, label: label(at) }).collect()
}

/// Ticks of a logarithmic axis: decades have labels (thinned to about `wanted`), 2 and 5 only if there are fewer than two decades.
pub fn logarithmic(low: f64, high: f64, wanted: usize, language: Language) -> Vec<Tick> {
    if !(low > 0.0 && high > low && high.is_finite()) {
        return Vec::new();
    }
    let (first, last) = (low.log10().floor() as i32, high.log10().ceil() as i32);
    let stride = ((last - first) as usize / wanted.max(1) + 1) as i32;
    let few = high / low < 100.0;
    let mut ticks = Vec::new();
    for power in first..=last {
        for m in [1.0, 2.0, 5.0] {
            let at = m * 10_f64.powi(power);
            // ends that are ticks themselves, but for rounding
            if at < low * (1.0 - 1e-9) || at > high * (1.0 + 1e-9) || (m != 1.0 && stride > 1) {
                continue;
            }
            let label = if m == 1.0 && power.rem_euclid(stride) == 0 {
                decade(power, language)
            } else if few {
                crate::number::short(at, 1, language)
            } else {
                String::new()
            };
            ticks.push(Tick { at, label });
        }
    }
    ticks
}

fn decade(power: i32, language: Language) -> String {
    match power {
        0 => "1".into(),
        1 => "10".into(),
        2 => "100".into(),
        -1 => fixed(0.1, 1, language),
        -2 => fixed(0.01, 2, language),
        _ => format!("10{}", superscript(&power.to_string())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Language::Ru;

    fn labels(ticks: &[Tick]) -> Vec<&str> {
        ticks.iter().map(|t| t.label.as_str()).collect()
    }

    #[test]
    fn linear_ticks_are_round_with_equal_decimals() {
        assert_eq!(labels(&linear(0.0, 1.0, 5, Ru)), ["0,0", "0,2", "0,4", "0,6", "0,8", "1,0"]);
        assert_eq!(labels(&linear(-150.0, 320.0, 5, Ru)), ["−100", "0", "100", "200", "300"]);
        assert_eq!(labels(&linear(0.0, 4e-5, 4, Ru)), ["0", "1·10⁻⁵", "2·10⁻⁵", "3·10⁻⁵", "4·10⁻⁵"]);
        assert_eq!(labels(&linear(1e7, 1.002e7, 2, Ru)), ["1,000·10⁷", "1,001·10⁷", "1,002·10⁷"]);
    }

    #[test]
    fn ticks_of_nothing_are_none() {
        for (low, high) in [(0.0, 0.0), (1.0, 0.0), (f64::NAN, 1.0), (0.0, f64::INFINITY), (1e300, 1.0000001e300)] {
            assert!(linear(low, high, 5, Ru).len() < 12);
        }
        assert!(logarithmic(0.0, 1.0, 5, Ru).is_empty());
    }

    #[test]
    fn logarithmic_ticks_label_decades() {
        let ticks = logarithmic(0.01, 1000.0, 8, Ru);
        let named: Vec<&str> = labels(&ticks).into_iter().filter(|l| !l.is_empty()).collect();
        assert_eq!(named, ["0,01", "0,1", "1", "10", "100", "10³"]);
        assert!(logarithmic(1e-300, 1e300, 6, Ru).len() < 700);
    }
}
