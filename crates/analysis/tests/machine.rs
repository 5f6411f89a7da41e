//! The integrator on a lowered machine.

#[path = "common/shaft.rs"]
mod shaft;

use analysis::studies::simulate::{Grid, Simulate, simulate};

/// phi(30 s) of card P3 at m = 0.01 kg.
const TURNED: f64 = 5133.26080494;

#[test]
fn pendulum_on_shaft_reaches_the_true_angle() {
    for tolerance in [1e-9, 1e-12, 1e-15] {
        let mut machine = shaft::shaft(0.01);
        let start = machine.start().unwrap();
        let options = Simulate { grid: Grid::At(vec![30.0]), tolerance, ..Simulate::until(30.0) };
        let outcome = simulate(&mut machine, &start, options);
        assert!(outcome.fault.is_none(), "{:?}", outcome.fault);
        let phi = outcome.dataset.column("phi").unwrap().values[0];
        println!("{tolerance:e}: {phi:.9} steps {:?}", outcome.dataset.counters.iter().map(|c| (c.key, c.value)).collect::<Vec<_>>());
        // the card's reference was computed to about 1e-11; runs at all tolerances agree with one another to 2e-12
        assert!((phi - TURNED).abs() < 1e-7 + 1e3 * tolerance, "{tolerance}: {phi}");
        // the end of the run-up is an event at exactly 10 s
        assert_eq!(outcome.dataset.events.len(), 1);
        assert_eq!(outcome.dataset.events[0].t, 10.0);
    }
}

#[test]
fn relay_machine_switches_and_passes_its_audits() {
    // from x = 1/2 at rest: crossings at 1, 3, 5, ...
    let mut machine = shaft::relay();
    let options = Simulate { grid: Grid::At(vec![0.5, 2.0, 4.5]), ..Simulate::until(10.0) };
    let outcome = simulate(&mut machine, &[0.5, 0.0], options);
    assert!(outcome.fault.is_none(), "{:?}", outcome.fault);
    let data = outcome.dataset;
    let times: Vec<f64> = data.events.iter().map(|e| e.t).collect();
    assert_eq!(times.len(), 5);
    for (i, t) in times.iter().enumerate() {
        assert!((t - (2 * i + 1) as f64).abs() < 1e-14 * t);
    }
    assert_eq!(data.column("a").unwrap().values, vec![-1.0, 1.0, -1.0]);
    assert_eq!(data.events[0].outputs, [vec![-1.0], vec![1.0]]);
    assert_eq!(data.events[0].what.en, "sign(x) changes from plus to minus");
    for key in ["two_derivations", "power_balance"] {
        assert!(data.audit(key).unwrap().ok, "{:?}", data.audit(key));
    }
}
