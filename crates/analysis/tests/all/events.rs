//! Events: nothing missed, nothing invented, located to rounding.

use crate::common;

use analysis::Mode;
use common::*;

/// Units of the last place of instants about 1e-5.
const SMALL: f64 = 1e-17;
/// Instants and states by a few operations: units of the last place.
const ROUNDING: f64 = 1e-15;
/// The same, beside slopes of ten.
const SLOPED: f64 = 1e-14;
/// States about thirty, and instants of the n-th root: units of their last place.
const LEVEL: f64 = 1e-13;
/// A state behind dozens of switches, each of which adds units of the last place.
const MOVED: f64 = 1e-12;
/// Instants behind a thousand steps.
const LASTING: f64 = 1e-11;
/// The integral of an oscillation over the whole motion, by the sum of its pieces.
const QUADRATURE: f64 = 1e-8;

/// Switch instants of guard 0 of a clocked polynomial, and the final counters.
fn clock(polynomials: &[(f64, &[f64])], end: f64) -> (Vec<(usize, f64)>, Vec<f64>) {
    let mut x = vec![0.0; polynomials.len() + 1];
    x[0] = 0.0;
    let (x, switches) = run(&mut clocked(polynomials), &x, end, 1e-12).unwrap();
    (switches.iter().map(|s| (s.guard, s.t)).collect(), x[1..].to_vec())
}

#[test]
fn pair_of_roots_in_one_step_is_not_missed() {
    for gap in [1e-2, 1e-4, 1e-6] {
        let (switches, y) = clock(&[(1.0, &[0.5, 0.5 + gap])], 1.0);
        assert_eq!(switches.len(), 2, "{gap}");
        // each root of a close pair moves by rounding / gap
        assert!((switches[0].1 - 0.5).abs() < ROUNDING / gap && (switches[1].1 - 0.5 - gap).abs() < ROUNDING / gap);
        assert!((y[0] - (1.0 - 2.0 * gap)).abs() < SLOPED / gap);
    }
}

#[test]
fn grazing_does_not_switch() {
    let (switches, y) = clock(&[(1.0, &[0.5, 0.5])], 1.0);
    assert_eq!(switches, vec![]);
    assert_eq!(y, vec![1.0]);
    let (switches, _) = clock(&[(-1.0, &[0.3, 0.3, 2.0])], 1.0);
    assert_eq!(switches, vec![]);
}

#[test]
fn simultaneous_guards_switch_together() {
    // 0.1 + 0.2 and 0.3 differ by rounding
    let (switches, y) = clock(&[(1.0, &[0.1 + 0.2]), (-7.0, &[0.3]), (1.0, &[0.3, 0.9])], 0.6);
    let guards: Vec<usize> = switches.iter().map(|s| s.0).collect();
    assert_eq!(guards, vec![0, 1, 2]);
    assert!(switches.iter().all(|s| (s.1 - 0.3).abs() < ROUNDING));
    assert!(y[0].abs() < ROUNDING && y[1].abs() < ROUNDING && y[2].abs() < ROUNDING);
}

#[test]
fn start_on_a_switch_follows_the_flow() {
    for (factor, roots, sign) in [
        (1.0, &[0.0][..], 1.0),
        (-2.0, &[0.0][..], -1.0),
        (1.0, &[0.0, 0.0][..], 1.0),
        (-1.0, &[0.0, 0.0, 0.0][..], -1.0),
        (1.0, &[0.0, 5.0][..], -1.0),
    ] {
        let (switches, y) = clock(&[(factor, roots)], 1.0);
        assert_eq!((switches.len(), y[0]), (0, sign));
    }
}

#[test]
fn first_switch_microseconds_after_the_start_is_found() {
    let (switches, y) = clock(&[(1.0, &[3e-5])], 30.0);
    assert!((switches[0].1 - 3e-5).abs() < SMALL);
    assert!((y[0] - (30.0 - 6e-5)).abs() < LEVEL);
    // leaves its surface at 0 and comes back at once
    let (switches, _) = clock(&[(1.0, &[0.0, 3e-5])], 30.0);
    assert_eq!(switches.len(), 1);
    assert!((switches[0].1 - 3e-5).abs() < SMALL);
    // and right after a switch of its own
    let (switches, _) = clock(&[(1.0, &[0.5, 0.501, 0.501001])], 30.0);
    assert_eq!(switches.len(), 3);
}

#[test]
fn relay_oscillator_makes_1e5_switches_on_time() {
    let (a, amplitude) = (2.0_f64, 0.5_f64);
    let quarter = (2.0 * amplitude / a).sqrt();
    let n = 100_000;
    let (_, switches) = run(&mut relay_oscillator(a), &[amplitude, 0.0], 2.0 * quarter * n as f64, 1e-12).unwrap();
    assert_eq!(switches.len(), n);
    let last = switches[n - 1].t;
    let exact = quarter * (2 * n - 1) as f64;
    println!("relay: off by {:e} of {exact}", last - exact);
    // the speed at a switch is rounded each time: a random walk of 1e-16 sqrt(1e5) in speed, 1e5 times that in time at most
    assert!((last - exact).abs() < QUADRATURE);
    for (i, s) in switches.iter().enumerate().take(1000) {
        assert!((s.t - quarter * (2 * i + 1) as f64).abs() < LASTING);
    }
}

#[test]
fn dry_friction_by_sign_loses_its_amplitude_and_ends_in_a_named_fault() {
    // amplitude falls by 2 mu / w^2 each half period pi / w; rest within mu / w^2
    let (w, mu) = (3.0_f64, 0.9);
    let mut system = dry_oscillator(w, mu);
    let options = analysis::integrate::taylor::Options::default();
    let mut flow = analysis::integrate::taylor::Flow::start(&mut system, 0.0, &[1.05, 0.0], &options).unwrap();
    let mut turns = vec![];
    let fault = loop {
        if let Err(fault) = flow.advance(100.0) {
            break fault;
        }
        for s in flow.switches() {
            turns.push((s.t, flow.state()[0]));
        }
    };
    assert_eq!(turns.len(), 4);
    for (i, (t, x)) in turns.iter().enumerate() {
        let n = (i + 1) as f64;
        let sign = if i % 2 == 0 { -1.0 } else { 1.0 };
        assert!((t - n * std::f64::consts::PI / w).abs() < LEVEL * n, "{t}");
        assert!((x - sign * (1.05 - 0.2 * n)).abs() < MOVED, "{x}");
    }
    assert_eq!(fault.code, "S001");
    assert!((flow.time() - 5.0 * std::f64::consts::PI / w).abs() < MOVED);
}

/// x'' = f - a sign(x) - b sign(v): for f = 0 swings shrink by r = sqrt((a - b)/(a + b)), and their times with them.
fn spiral(f: f64, a: f64, b: f64) -> Hand {
    Hand::new(&["m", "m/s"], 1, move |s, k| {
        let force = if k == 0 { f - a * s.modes[0] - b * s.modes[1] } else { 0.0 };
        vec![s.x[1][k], force]
    })
    .guarded(2, |s, k| vec![s.x[0][k], s.x[1][k]])
}

#[test]
fn infinitely_many_switches_that_lead_to_rest_are_followed_to_rest() {
    let (a, b) = (2.0_f64, 1.0_f64);
    let r = ((a - b) / (a + b)).sqrt();
    let end = (1.0 / (a + b) + 1.0 / (a * a - b * b).sqrt()) / (1.0 - r);
    let (x, switches) = run(&mut spiral(0.0, a, b), &[0.0, 1.0], 10.0, 1e-12).unwrap();
    // sign(0) = 0: the centre is a state of rest of this model
    assert!(x[0].abs() < 1e-20 && x[1] == 0.0, "{x:?}");
    assert!((switches.last().unwrap().t - end).abs() < MOVED);
}

#[test]
fn accumulating_switches_are_a_named_fault() {
    // with a constant force the centre is no state of rest, and there is no motion after the accumulation
    let fault = run(&mut spiral(0.2, 2.0, 1.0), &[0.0, 1.0], 10.0, 1e-12).unwrap_err();
    assert!(fault.code == "S002" || fault.code == "S001", "{fault}");
}

#[test]
fn scheduled_instant_is_hit_exactly() {
    let at = 0.1 + 0.2;
    let mut system = Hand::new(&["1"], 0, |s, k| vec![if k == 0 { if s.modes[0] > 0.0 { -2.0 } else { 1.0 } } else { 0.0 }])
        .guarded(1, move |s, k| vec![s.time(k) - if k == 0 { at } else { 0.0 }])
        .scheduled(0, at);
    let (x, switches) = run(&mut system, &[0.0], 1.0, 1e-9).unwrap();
    assert_eq!(switches.len(), 1);
    assert_eq!(switches[0].t, at);
    assert_eq!((switches[0].before, switches[0].after), (Mode::Negative, Mode::Positive));
    assert!((x[0] - (0.3 - 1.4)).abs() < ROUNDING);
}

#[test]
fn body_at_rest_stays_until_a_scheduled_push() {
    // v' = F(t) - mu sign(v), F = 0 before t = 1 and 3 after
    let mut system = Hand::new(&["m", "m/s"], 1, |s, k| {
        let push = if s.modes[1] > 0.0 { 3.0 } else { 0.0 };
        vec![s.x[1][k], if k == 0 { push - s.modes[0] } else { 0.0 }]
    })
    .guarded(2, |s, k| vec![s.x[1][k], s.time(k) - if k == 0 { 1.0 } else { 0.0 }])
    .scheduled(1, 1.0);
    let (x, switches) = run(&mut system, &[0.5, 0.0], 2.0, 1e-12).unwrap();
    assert_eq!(x, vec![0.5 + 1.0, 2.0]);
    assert_eq!(switches.len(), 2);
    assert!(switches.iter().any(|s| s.guard == 0 && s.before == Mode::Zero && s.after == Mode::Positive));
}

#[test]
fn guard_that_jumps_with_another_switch_is_followed() {
    // g1 = sign(g0) - 0.5 changes sign because g0 does
    let mut system = Hand::new(&["s", "1"], 0, |s, k| {
        let one = if k == 0 { 1.0 } else { 0.0 };
        vec![one, one * s.modes[1]]
    })
    .guarded(2, |s, k| {
        let jump = if k == 0 { s.modes[0] - 0.5 } else { 0.0 };
        vec![s.x[0][k] - if k == 0 { 0.25 } else { 0.0 }, jump]
    });
    let (x, switches) = run(&mut system, &[0.0, 0.0], 1.0, 1e-12).unwrap();
    assert_eq!(switches.len(), 2);
    assert!((x[1] - 0.5).abs() < ROUNDING);
}

#[test]
fn dither_faster_than_the_motion_is_no_accumulation() {
    // z' = sign(u), u a tone of 100 kHz: z is a triangle wave of height pi / w
    let w = 2.0e5 * std::f64::consts::PI;
    let mut system =
        Hand::new(&["V", "V/s", "m"], 1, move |s, k| vec![s.x[1][k], -w * w * s.x[0][k], if k == 0 { s.modes[0] } else { 0.0 }])
            .guarded(1, |s, k| vec![s.x[0][k]]);
    let (x, switches) = run(&mut system, &[0.0, 1.0, 0.0], 0.0100025, 1e-12).unwrap();
    assert_eq!(switches.len(), 2000);
    assert!((x[2] - 0.25e-5).abs() < LEVEL, "{x:?}");
    for (i, s) in switches.iter().enumerate() {
        assert!((s.t - 0.5e-5 * (i + 1) as f64).abs() < LEVEL);
    }
}

/// Roots of prod (t - r): the clock must switch at every one of them, pairs inside one step included, and nowhere else.
mod random {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    /// Coefficients of prod (t - root).
    fn product(roots: &[f64]) -> Vec<f64> {
        let mut c = vec![1.0];
        for r in roots {
            c.push(0.0);
            for k in (0..c.len()).rev() {
                c[k] = if k > 0 { c[k - 1] } else { 0.0 } - r * c[k];
            }
        }
        c
    }

    /// How far a root of the polynomial moves when its value is known to rounding of its terms.
    fn blur(c: &[f64], t: f64) -> f64 {
        let terms: f64 = c.iter().enumerate().map(|(k, c)| (c * t.powi(k as i32)).abs()).sum();
        let slope: f64 = c.iter().enumerate().skip(1).map(|(k, c)| k as f64 * c * t.powi(k as i32 - 1)).sum();
        16.0 * f64::EPSILON * terms / slope.abs() + 1e-15
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn every_root_of_a_polynomial_is_a_switch(
            pairs in proptest::collection::vec((0.1f64..0.4, prop_oneof![Just(0.0), 1e-3f64..1e-2]), 1..4),
        ) {
            // single roots and close pairs, far from each other: a closer cluster lies below the rounding of the polynomial
            let mut roots: Vec<f64> = vec![];
            for (way, gap) in pairs {
                roots.push(roots.last().unwrap_or(&0.0) + way);
                if gap > 0.0 {
                    roots.push(roots[roots.len() - 1] + gap);
                }
            }
            let c = product(&roots);
            let (switches, _) = clock(&[(1.0, &roots)], 4.0);
            prop_assert_eq!(switches.len(), roots.len(), "{:?} {:?}", roots, switches);
            for ((_, t), r) in switches.iter().zip(&roots) {
                prop_assert!((t - r).abs() <= blur(&c, *r), "{} against {}", t, r);
            }
        }

        /// cos t - threshold along x'' = -x; close to the extremes two roots lie in one step.
        #[test]
        fn oscillation_crosses_a_threshold_at_the_arc_cosine(threshold in prop_oneof![-0.95f64..0.95, 0.9f64..0.999_999]) {
            let mut system = oscillator(1.0).guarded(1, move |s, k| vec![s.x[0][k] - if k == 0 { threshold } else { 0.0 }]);
            let (_, switches) = run(&mut system, &[1.0, 0.0], 10.0 * PI, 1e-13).unwrap();
            let first = threshold.acos();
            let exact: Vec<f64> = (0..5).flat_map(|n| [first, 2.0 * PI - first].map(|t| t + 2.0 * PI * n as f64)).collect();
            prop_assert_eq!(switches.len(), 10);
            for (switch, t) in switches.iter().zip(&exact) {
                // the motion errs by some 1e-13 a step; a flat crossing turns an error of x into one of t by 1/|x'|
                prop_assert!((switch.t - t).abs() < 5.0 * MOVED / first.sin(), "{} against {}", switch.t, t);
            }
        }
    }
}
