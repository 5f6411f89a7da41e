//! Periodic regimes against closed forms: period, start, multipliers.

use crate::common;

use analysis::Mode;
use analysis::studies::periodic::{Multiplier, Outcome, Periodic, Return, periodic};
use common::*;
use std::f64::consts::{PI, TAU};

/// A period that is known beforehand: units of the last place.
const ROUNDING: f64 = 1e-14;
/// A period by Newton on a section: the last step leaves the rounding of one turn.
const PERIOD: f64 = 1e-13;
/// A start of the regime: the rounding of one turn over 1 less the multiplier.
const START: f64 = 1e-12;
/// Variations along one turn, integrated beside the motion.
const MULTIPLIER: f64 = 1e-11;
/// Strongly attracting regimes: the variation is small beside the rounding of what it multiplies; starts that a damped mode alone fixes.
const STIFF: f64 = 1e-9;
/// The same backwards in time, where that rounding grows by the inverse multiplier.
const BACKWARDS: f64 = 1e-6;

fn solved(outcome: Outcome) -> analysis::studies::periodic::Regime {
    assert!(outcome.fault.is_none(), "{:?}", outcome.fault.map(|f| f.to_string()));
    let regime = outcome.regime;
    for audit in &regime.dataset.audits {
        assert!(audit.ok, "{}: {:e}", audit.key, audit.value);
    }
    regime
}

fn own(multipliers: &[Multiplier]) -> Vec<f64> {
    multipliers.iter().filter(|m| !m.trivial).map(|m| m.re).collect()
}

fn constant(value: f64, k: usize) -> f64 {
    if k == 0 { value } else { 0.0 }
}

/// x'' = mu (1 - x^2) x' - x, seen from a frame at rest while all moves with the velocity v: x = u + v t.
fn van_der_pol(mu: f64, v: f64) -> Hand {
    Hand::new(&["m", "m/s"], 1, move |s, k| {
        let u = s.x[0][k] - v * s.time(k);
        s.aux[0].push(u);
        let square = Work::product(&s.aux[0], &s.aux[0], k);
        s.aux[1].push(constant(mu, k) - mu * square);
        s.aux[2].push(s.x[1][k] - constant(v, k));
        vec![s.x[1][k], Work::product(&s.aux[1], &s.aux[2], k) - u]
    })
    .aux(3)
}

#[test]
fn van_der_pol_has_its_known_period() {
    // 6.66328685932313018969678... for mu = 1 (integration with 30 digits in truth/); multiplier exp of the mean divergence
    let regime = solved(periodic(&mut van_der_pol(1.0, 0.0), &[0.5, 0.0], &Periodic::default()));
    assert!((regime.period - 6.663_286_859_323_13).abs() < PERIOD, "{}", regime.period);
    let multiplier = own(&regime.multipliers)[0];
    // Liouville's formula along the found cycle, by the trapezoidal rule, exact for periodic functions
    let x = &regime.dataset.column("x0").unwrap().values;
    let n = x.len() - 1;
    let mean: f64 = x[..n].iter().map(|x| 1.0 - x * x).sum::<f64>() / n as f64;
    let expected = (mean * regime.period).exp();
    assert!((multiplier / expected - 1.0).abs() < STIFF, "{multiplier} {expected}");
    assert_eq!(regime.stable, Some(true));
}

#[test]
fn a_cycle_carried_along_has_the_same_period() {
    let still = solved(periodic(&mut van_der_pol(1.0, 0.0), &[0.5, 0.0], &Periodic::default()));
    let moving = solved(periodic(&mut van_der_pol(1.0, 0.7), &[0.5, 0.7], &Periodic::default()));
    assert!((moving.period - still.period).abs() < START, "{}", moving.period - still.period);
    assert!((moving.gain[0] - 0.7 * moving.period).abs() < MULTIPLIER);
    assert!((own(&moving.multipliers)[0] - own(&still.multipliers)[0]).abs() < MULTIPLIER);
}

#[test]
fn unstable_cycle_is_found_too() {
    // the cycle of mu < 0 is the same, run backwards: reciprocal multiplier
    let start = [2.0085, 0.0];
    let forward = solved(periodic(&mut van_der_pol(1.0, 0.0), &start, &Periodic::default()));
    let backward = solved(periodic(&mut van_der_pol(-1.0, 0.0), &start, &Periodic::default()));
    assert!((backward.period - forward.period).abs() < STIFF);
    assert_eq!(backward.stable, Some(false));
    assert!((own(&backward.multipliers)[0] * own(&forward.multipliers)[0] - 1.0).abs() < BACKWARDS);
}

#[test]
fn forced_oscillator_settles_on_its_closed_form() {
    // x'' + 2 b x' + x = cos(p t)
    let (b, p) = (0.05_f64, 1.3_f64);
    let system = || {
        Hand::new(&["m", "m/s"], 1, move |s, k| {
            let turned = [1.0, p, p * p, p.powi(3)][0] * [(p * s.t).cos(), -(p * s.t).sin(), -(p * s.t).cos(), (p * s.t).sin()][k % 4];
            let force = (1..=k).fold(turned, |f, j| f * p / j as f64);
            vec![s.x[1][k], force - 2.0 * b * s.x[1][k] - s.x[0][k]]
        })
    };
    let options = Periodic { by: Return::Period(TAU / p), ..Periodic::default() };
    let regime = solved(periodic(&mut system(), &[3.0, -1.0], &options));
    let (d, e) = (1.0 - p * p, 2.0 * b * p);
    let size = d * d + e * e;
    assert!((regime.start[0] - d / size).abs() < START && (regime.start[1] - p * e / size).abs() < START, "{:?}", regime.start);
    let w = (1.0 - b * b).sqrt();
    for m in &regime.multipliers {
        let (re, im) = ((-b * regime.period).exp() * (w * regime.period).cos(), (-b * regime.period).exp() * (w * regime.period).sin());
        assert!((m.re - re).abs() < MULTIPLIER && (m.im.abs() - im.abs()).abs() < MULTIPLIER, "{m:?} {re} {im}");
    }
    let missing = periodic(&mut system(), &[0.0, 0.0], &Periodic::default());
    assert_eq!(missing.fault.unwrap().code, "S043");
    let wrong = periodic(&mut system(), &[0.0, 0.0], &Periodic { by: Return::Period(1.0), ..Periodic::default() });
    assert_eq!(wrong.fault.unwrap().code, "S043");
}

#[test]
fn switches_enter_the_multiplier() {
    // x'' + 2 b x' + x = sign(x'): half a period is pi/w, amplitude A = (1 + e)/(1 - e), e = exp(-b pi/w); dA shrinks by e each half
    let b = 0.1_f64;
    let w = (1.0 - b * b).sqrt();
    let e = (-b * PI / w).exp();
    let mut system = Hand::new(&["m", "m/s"], 1, move |s, k| vec![s.x[1][k], constant(s.modes[0], k) - 2.0 * b * s.x[1][k] - s.x[0][k]])
        .guarded(1, |s, k| vec![s.x[1][k]]);
    let regime = solved(periodic(&mut system, &[2.0, 1.0], &Periodic::default()));
    assert!((regime.period - TAU / w).abs() < PERIOD);
    assert!((own(&regime.multipliers)[0] - e * e).abs() < MULTIPLIER, "{:?}", regime.multipliers);
    let amplitude = regime.dataset.events.iter().map(|e| e.states[1][0].abs()).fold(0.0, f64::max);
    assert!((amplitude - (1.0 + e) / (1.0 - e)).abs() < MULTIPLIER, "{amplitude}");
    assert_eq!(regime.dataset.events.len(), 2);
    // the same with the switch as the section
    let rate = |_: f64, x: &[f64]| x[1];
    let again = solved(periodic(&mut system, &[2.0, 1.0], &Periodic { begin: Some(&rate), ..Periodic::default() }));
    assert!((again.period - TAU / w).abs() < PERIOD);
    assert!((own(&again.multipliers)[0] - e * e).abs() < MULTIPLIER, "{:?}", again.multipliers);
    assert!((again.start[0] + amplitude).abs() < MULTIPLIER && again.start[1].abs() < PERIOD);
}

#[test]
fn a_rotor_turns_through_its_angle() {
    // phi'' = 1 - 0.5 phi' + 0.3 cos(phi): one turn of phi is a period, Liouville's formula gives exp(-0.5 T)
    let mut system = Hand::new(&["rad", "rad/s"], 1, move |s, k| {
        // c' = -s phi', s' = c phi'
        let (c, d) = if k == 0 {
            (s.x[0][0].cos(), s.x[0][0].sin())
        } else {
            let sum = |a: &[f64]| (1..=k).map(|j| j as f64 * s.x[0][j] * a[k - j]).sum::<f64>() / k as f64;
            (-sum(&s.aux[1]), sum(&s.aux[0]))
        };
        s.aux[0].push(c);
        s.aux[1].push(d);
        vec![s.x[1][k], constant(1.0, k) - 0.5 * s.x[1][k] + 0.3 * c]
    })
    .aux(2);
    let regime = solved(periodic(&mut system, &[0.3, 1.0], &Periodic::default()));
    assert!((regime.gain[0] - TAU).abs() < PERIOD);
    assert!((own(&regime.multipliers)[0] - (-0.5 * regime.period).exp()).abs() < MULTIPLIER);
    assert_eq!(regime.start[0], 0.3);
}

#[test]
fn steady_rotation_has_one_trivial_multiplier() {
    let mut system = Hand::new(&["rad", "rad/s"], 1, |s, k| vec![s.x[1][k], constant(1.0, k) - 0.5 * s.x[1][k]]);
    let regime = solved(periodic(&mut system, &[0.0, 1.0], &Periodic::default()));
    assert!((regime.period - PI).abs() < PERIOD, "{}", regime.period);
    assert!((own(&regime.multipliers)[0] - (-0.5 * PI).exp()).abs() < START);
}

#[test]
fn a_decaying_motion_is_no_regime() {
    let mut system = Hand::new(&["m", "m/s"], 1, |s, k| vec![s.x[1][k], -s.x[0][k] - 3.0 * s.x[1][k]]);
    let outcome = periodic(&mut system, &[1.0, 0.5], &Periodic::default());
    assert!(matches!(outcome.fault.unwrap().code, "S041" | "S042"));
}

#[test]
fn conservative_oscillation_keeps_its_amplitude() {
    let regime = solved(periodic(&mut oscillator(2.0), &[1.0, 0.0], &Periodic::default()));
    assert!((regime.period - PI).abs() < ROUNDING && regime.stable.is_none());
    assert!((regime.start[0] - 1.0).abs() < STIFF);
    let _ = Mode::Zero;
}
