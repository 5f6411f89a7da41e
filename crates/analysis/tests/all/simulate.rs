//! The study: grids, one-sided values, early ends.

use crate::common;

use std::sync::atomic::AtomicBool;

use analysis::studies::simulate::{Grid, Simulate, simulate};
use common::*;

/// A state behind some steps, each of which adds units of the last place.
const MOVED: f64 = 1e-12;
/// The same where the motion grows with time.
const GROWN: f64 = 1e-11;
/// What a motion with the tolerance 1e-9 leaves in its own audit.
const LOOSE: f64 = 1e-7;

#[test]
fn asked_times_are_exact_and_keep_their_order() {
    let times = vec![0.7, 0.1, 2.0, 0.0, 0.1];
    let options = Simulate { grid: Grid::At(times.clone()), ..Simulate::until(2.0) };
    let outcome = simulate(&mut oscillator(3.0), &[1.0, 0.0], options);
    assert!(outcome.fault.is_none());
    let data = outcome.dataset;
    assert_eq!(data.columns[0].values, times);
    for (t, x) in times.iter().zip(&data.column("x0").unwrap().values) {
        assert!((x - (3.0 * t).cos()).abs() < MOVED);
    }
}

#[test]
fn grid_has_no_accumulated_rounding() {
    let options = Simulate { grid: Grid::Every(0.1), ..Simulate::until(1.0) };
    let data = simulate(&mut decay(), &[1.0], options).dataset;
    assert_eq!(data.columns[0].values, vec![0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]);
    let options = Simulate { grid: Grid::Every(0.3), ..Simulate::until(1.0) };
    assert_eq!(simulate(&mut decay(), &[1.0], options).dataset.columns[0].values.len(), 4);
    assert_eq!(simulate(&mut decay(), &[1.0], Simulate::until(5.0)).dataset.columns[0].values.len(), 1001);
}

#[test]
fn value_at_an_event_is_the_one_after_it() {
    // slope of y jumps from -1 to 1 at 0.5
    let options = Simulate { grid: Grid::At(vec![0.25, 0.5, 0.75]), ..Simulate::until(1.0) };
    let outcome = simulate(&mut clocked(&[(1.0, &[0.5])]), &[0.0, 0.0], options);
    let data = outcome.dataset;
    assert_eq!(data.column("x1").unwrap().values, vec![-0.25, -0.5, -0.25]);
    assert_eq!(data.events.len(), 1);
    assert_eq!(data.events[0].t, 0.5);
    assert_eq!(data.events[0].sides, [-1.0, 1.0]);
    assert_eq!(data.events[0].what.en, "g0 changes from minus to plus");
}

#[test]
fn fault_keeps_what_is_done() {
    let options = Simulate { grid: Grid::Every(0.5), ..Simulate::until(10.0) };
    let outcome = simulate(&mut pushed_block(0.5, 1.0), &[0.0, -3.0], options);
    assert_eq!(outcome.fault.unwrap().code, "S001");
    assert!(outcome.dataset.partial);
    // it stops at t = 3 / 1.5 = 2
    assert_eq!(outcome.dataset.columns[0].values, vec![0.0, 0.5, 1.0, 1.5]);
}

#[test]
fn singularity_is_a_fault_that_keeps_what_is_done() {
    // x' = x^2, x = 1 / (1 - t)
    let mut system = Hand::new(&["1"], 0, |s, k| vec![Work::product(&s.x[0], &s.x[0], k)]);
    let options = Simulate { grid: Grid::Every(0.25), ..Simulate::until(2.0) };
    let outcome = simulate(&mut system, &[1.0], options);
    let fault = outcome.fault.unwrap();
    assert!(fault.code == "S003" || fault.code == "S004", "{fault}");
    let x = &outcome.dataset.column("x0").unwrap().values;
    // t = 1 itself may lie on this side of the singularity by rounding
    assert!(x.len() == 4 || (x.len() == 5 && x[4] > 1e12), "{x:?}");
    assert!((x[3] - 4.0).abs() < GROWN);
}

#[test]
fn unusable_options_are_faults() {
    let run = |options: Simulate<'_>| simulate(&mut decay(), &[1.0], options).fault.map(|f| f.code);
    assert_eq!(run(Simulate { tolerance: 0.0, ..Simulate::until(1.0) }), Some("S006"));
    assert_eq!(run(Simulate { tolerance: f64::NAN, ..Simulate::until(1.0) }), Some("S006"));
    assert_eq!(run(Simulate::until(-1.0)), Some("S006"));
    assert_eq!(run(Simulate::until(f64::INFINITY)), Some("S006"));
    assert_eq!(run(Simulate { grid: Grid::Every(0.0), ..Simulate::until(1.0) }), Some("S006"));
    assert_eq!(run(Simulate { grid: Grid::Every(1e-12), ..Simulate::until(1.0) }), Some("S005"));
    assert_eq!(run(Simulate { grid: Grid::At(vec![0.5, 1.5]), ..Simulate::until(1.0) }), Some("S006"));
    assert_eq!(run(Simulate { outputs: Some(vec!["nothing".into()]), ..Simulate::until(1.0) }), Some("S009"));
    assert_eq!(run(Simulate::until(0.0)), None);
    let nan = simulate(&mut decay(), &[f64::NAN], Simulate::until(1.0));
    assert_eq!(nan.fault.unwrap().code, "S004");
}

#[test]
fn interrupted_run_returns_what_is_done() {
    let stop = AtomicBool::new(true);
    let options = Simulate { interrupt: Some(&stop), ..Simulate::until(1.0) };
    let outcome = simulate(&mut decay(), &[1.0], options);
    assert!(outcome.fault.is_none() && outcome.dataset.partial);
    assert!(outcome.dataset.columns[0].values.is_empty());
}

#[test]
fn halving_the_tolerance_is_reported() {
    let options = Simulate { tolerance_halving: true, tolerance: 1e-9, ..Simulate::until(20.0) };
    let data = simulate(&mut oscillator(2.0), &[1.0, 0.0], options).dataset;
    let audit = data.audit("tolerance_halving").unwrap();
    assert!(audit.ok && audit.value < LOOSE && audit.value > 0.0, "{audit:?}");
}

#[test]
fn same_input_same_bytes() {
    let run = || simulate(&mut kepler(), &[0.5, 0.0, 0.0, 1.2], Simulate::until(30.0)).dataset;
    assert_eq!(run(), run());
}
