//! The integrator against closed forms.

use crate::common;

use std::f64::consts::PI;

use analysis::System;
use analysis::integrate::taylor::{Flow, Options};
use common::*;

/// Units of the last place.
const ROUNDING: f64 = 1e-15;
/// A place about five behind some steps.
const FALLEN: f64 = 1e-13;
/// Instants about a hundred behind a thousand steps.
const LATE: f64 = 1e-11;
/// The phase after ten thousand turns: a walk of rounding.
const PHASE: f64 = 1e-10;
/// A motion with the tolerance 1e-9 through dozens of steps.
const LOOSE: f64 = 1e-7;

#[test]
fn decay_is_exponential_at_every_tolerance() {
    for digits in 3..=15 {
        let tolerance = (10.0_f64).powi(-digits);
        let (x, _) = run(&mut decay(), &[1.0], 5.0, tolerance).unwrap();
        let error = (x[0] / (-5.0_f64).exp() - 1.0).abs();
        // local errors are relative to the largest term of the series, up to e^2 changes; e^5 turns the first change into relative error
        assert!(error < 20.0 * tolerance + ROUNDING, "{tolerance}: {error}");
    }
}

/// x'' = -x over 1e5 periods in steps of at most `longest`: energy drift, phase error, number of steps.
fn long_run(order: Option<usize>, longest: f64) -> (f64, f64, f64) {
    let mut system = oscillator(1.0);
    let options = Options { tolerance: 1e-15, order, ..Default::default() };
    let end = 2.0 * PI * 1e5;
    let mut flow = Flow::start(&mut system, 0.0, &[1.0, 0.0], &options).unwrap();
    while !flow.reached(end) {
        flow.advance(end.min(flow.time() + longest)).unwrap();
    }
    let (x, v) = (flow.state()[0], flow.state()[1]);
    println!("energy {:e}, phase {:e}, {:?}", x * x + v * v - 1.0, v.atan2(x), flow.work());
    ((x * x + v * v - 1.0).abs(), v.atan2(x).abs(), flow.work().steps as f64)
}

#[test]
fn oscillator_keeps_energy_and_phase_over_1e5_periods() {
    let (energy, phase, steps) = long_run(None, f64::INFINITY);
    // truncation keeps one sign and adds up; the tolerance allows a hundred times as much
    assert!(energy < 0.01 * 1e-15 * steps, "{energy}");
    assert!(phase < PHASE, "{phase}");
}

/// Steps of 2 at order 30 truncate at 2^31/31! = 3e-25: what is left is rounding, and it must be a random walk, since the state sum carries
/// its rounding error along. A bias of eps/2 per step would give 3e-11; a walk of eps per step gives eps sqrt(N) = 1e-13.
#[test]
fn rounding_of_a_long_run_has_no_bias() {
    let (energy, _, steps) = long_run(Some(30), 2.0);
    assert!(energy < 4.0 * f64::EPSILON * steps.sqrt(), "{energy}");
}

/// Fixed order p with steps of length h: the error of the sum falls as h^p.
#[test]
fn observed_order_is_the_order_asked_for() {
    for p in [4, 6, 8, 11] {
        let error = |parts: usize| {
            let mut system = kepler();
            let mut x = vec![0.8, 0.0, 0.0, (1.2_f64 / 0.8).sqrt()];
            let h = 1.0 / parts as f64;
            for i in 0..parts {
                // expand at every grid point, evaluate the polynomial at its end: one step of the method, of fixed length
                system.expand(i as f64 * h, &x, &[], p).unwrap();
                x = (0..4).map(|i| system.state(i).iter().rev().fold(0.0, |sum, c| sum * h + c)).collect();
            }
            let exact = kepler_position(0.2, 1.0);
            (x[0] - exact.0).hypot(x[1] - exact.1)
        };
        let parts = if p < 8 { 32 } else { 8 };
        let observed = (error(parts) / error(2 * parts)).log2();
        // the next term of the error is smaller by a factor of order h
        assert!((observed - p as f64).abs() < 0.6, "order {p}: {observed}");
    }
}

/// A tenth of the tolerance gives about a tenth of the error. Seven decades; the ratio of neighbours scatters, their trend does not.
#[test]
fn error_is_proportional_to_the_tolerance() {
    let e = 0.5;
    let start = [1.0 - e, 0.0, 0.0, ((1.0_f64 + e) / (1.0 - e)).sqrt()];
    let exact = kepler_position(e, 2.0);
    let mut slopes = Vec::new();
    let errors: Vec<f64> = (4..=11)
        .map(|digits| {
            let (x, _) = run(&mut kepler(), &start, 2.0, (10.0_f64).powi(-digits)).unwrap();
            (x[0] - exact.0).hypot(x[1] - exact.1).log10()
        })
        .collect();
    for pair in errors.windows(2) {
        slopes.push(pair[0] - pair[1]);
    }
    let mean = slopes.iter().sum::<f64>() / slopes.len() as f64;
    assert!((mean - 1.0).abs() < 0.25, "{mean}: {errors:?}");
}

#[test]
fn kepler_with_eccentricity_0_9_returns() {
    let e: f64 = 0.9;
    for (tolerance, limit) in [(1e-6, 1e-3), (1e-9, 1e-6), (1e-12, 1e-9), (1e-15, 2e-11)] {
        let start = [1.0 - e, 0.0, 0.0, ((1.0 + e) / (1.0 - e)).sqrt()];
        let end = 2.0 * PI * 10.25;
        let (x, _) = run(&mut kepler(), &start, end, tolerance).unwrap();
        let exact = kepler_position(e, end % (2.0 * PI));
        let error = (x[0] - exact.0).hypot(x[1] - exact.1);
        println!("{tolerance:e} {error:e}");
        assert!(error < limit, "{tolerance}: {error}");
    }
}

#[test]
fn relay_oscillator_switches_at_its_period() {
    let (a, amplitude) = (2.0_f64, 0.5_f64);
    let quarter = (2.0 * amplitude / a).sqrt();
    let n = 1000.0;
    let (_, switches) = run(&mut relay_oscillator(a), &[amplitude, 0.0], 2.0 * quarter * n, 1e-12).unwrap();
    assert_eq!(switches.len(), 1000);
    for (i, s) in switches.iter().enumerate() {
        let exact = quarter * (2 * i + 1) as f64;
        assert!((s.t - exact).abs() < LATE, "{i}: {} {exact}", s.t);
    }
}

#[test]
fn block_that_stops_under_a_small_force_chatters() {
    let fault = run(&mut pushed_block(0.5, 1.0), &[0.0, -3.0], 10.0, 1e-12).unwrap_err();
    assert_eq!(fault.code, "S001", "{fault}");
    assert!(fault.what.en.contains("g0") && fault.help.en.contains("friction"), "{fault}");
}

#[test]
fn block_without_force_stops_and_rests() {
    let (x, switches) = run(&mut pushed_block(0.0, 1.0), &[0.0, -3.0], 10.0, 1e-12).unwrap();
    assert!((x[0] + 4.5).abs() < FALLEN && x[1].abs() < ROUNDING, "{x:?}");
    assert_eq!(switches.len(), 1);
    assert!((switches[0].t - 3.0).abs() < ROUNDING * 3.0);
}

#[test]
fn premature_zero_coefficients_are_taken_back() {
    // x' = 12 t^11 / (1 + t^12)^2 has a Taylor series in t^12: at t = 0 most coefficients vanish; x = t^12 / (1 + t^12)
    // with u = 1 / (1 + c^12), c' = 1: u = 1 - x, series of the clock written out
    let mut system = Hand::new(&["s", "1"], 0, |s, k| {
        let clock = s.x[0].clone();
        let power = |n: i32, k: usize| -> f64 {
            // coefficient k of (c_0 + tau)^n
            let mut binomial = 1.0;
            for j in 0..k as i32 {
                binomial *= f64::from(n - j) / f64::from(j + 1);
            }
            if k as i32 > n { 0.0 } else { binomial * clock[0].powi(n - k as i32) }
        };
        // 1 - x as the second factor: x' = 12 c^11 (1 - x)^2
        let rest: Vec<f64> = (0..=k).map(|j| if j == 0 { 1.0 - s.x[1][0] } else { -s.x[1][j] }).collect();
        let square: Vec<f64> = (0..=k).map(|j| Work::product(&rest, &rest, j)).collect();
        let rate = (0..=k).map(|j| 12.0 * power(11, j) * square[k - j]).sum();
        vec![if k == 0 { 1.0 } else { 0.0 }, rate]
    });
    let (x, _) = run(&mut system, &[0.0, 0.0], 2.0, 1e-9).unwrap();
    let exact = 4096.0 / 4097.0;
    assert!((x[1] - exact).abs() < LOOSE, "{}", x[1] - exact);
}

/// A push by swelling pulses: steps, lowest and highest order of a step, mean order, work, largest relative error, bits of the last state.
struct Push {
    steps: u64,
    orders: (usize, usize),
    mean: f64,
    /// Sum of the costs of the steps by the formula at the head of `length.rs`.
    cost: f64,
    error: f64,
    last: Vec<u64>,
}

fn push(tolerance: f64, order: Option<usize>) -> Push {
    // the share of the pulses grows from ten tolerances to 30
    let (a, r, end) = (10.0 * tolerance, 0.5_f64, 300.0_f64);
    let b = (30.0 / a).ln() / end;
    // integral of a e^(b t) (1 + 2 sum r^n cos(n t))
    let primitive = |t: f64| {
        let term = |n: f64| r.powf(n) * (b * (n * t).cos() + n * (n * t).sin()) / (b * b + n * n);
        a * (b * t).exp() * (1.0 / b + 2.0 * (1..=60).map(|n| term(f64::from(n))).sum::<f64>())
    };
    let mut system = swelling(a, b, r);
    let options = Options { tolerance, order, span: end, ..Default::default() };
    let mut flow = Flow::start(&mut system, 0.0, &[0.0], &options).unwrap();
    let (mut orders, mut cost, mut error) = ((usize::MAX, 0), 0.0, 0.0_f64);
    while !flow.reached(end) {
        flow.advance(end).unwrap();
        let order = flow.step().order;
        cost += 3.0 + order as f64 + (order * order) as f64 / 160.0;
        orders = (orders.0.min(order), orders.1.max(order));
        let t = flow.time();
        error = error.max((flow.state()[0] / (t + primitive(t) - primitive(0.0)) - 1.0).abs());
    }
    let work = flow.work();
    assert_eq!(work.highest_order, orders.1);
    println!("{tolerance:e} {order:?}: {work:?}, {orders:?}, cost {cost}, error {error:e}");
    let last = flow.state().iter().map(|x| x.to_bits()).collect();
    Push { steps: work.steps, orders, mean: work.orders as f64 / work.steps as f64, cost, error, last }
}

/// While the pulses are a ripple on the uniform motion a low order suffices, when they prevail a high one pays.
#[test]
fn order_follows_the_motion() {
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let (free, again) = (push(tolerance, None), push(tolerance, None));
        let start = (2.0 - 2.1 * tolerance.log10()).round().min(26.0) as usize;
        let fixed = push(tolerance, Some(start));
        assert_eq!((free.last, free.steps), (again.last, again.steps));
        assert!(free.orders.0 + 4 <= free.orders.1, "{:?}", free.orders);
        assert!((free.orders.0 as f64) < free.mean && free.mean < free.orders.1 as f64, "{}", free.mean);
        assert!(free.error <= fixed.error.max(tolerance), "{:e} {:e}", free.error, fixed.error);
        assert!(free.cost < fixed.cost, "{} {}", free.cost, fixed.cost);
        assert_eq!((fixed.orders, fixed.mean), ((start, start), start as f64));
    }
}
