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
