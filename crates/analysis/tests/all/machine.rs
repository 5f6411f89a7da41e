//! The integrator on a lowered machine.

use crate::shaft;

use analysis::integrate::stiff::Method;
use analysis::integrate::taylor::{Flow, Options};
use analysis::studies::equilibrium::{Equilibrium, equilibrium};
use analysis::studies::simulate::{Grid, Outcome, Simulate, simulate};
use symbolic::{Edge, Expr, Function, Graph, Rational};

/// Values and instants of a few operations: units of the last place.
const ROUNDING: f64 = 1e-14;
/// A place of rest found at the start, and a decay of 1e-9 beside 1.
const MOVED: f64 = 1e-12;
/// A square root near the end of the motion, where its slope grows.
const STEEP: f64 = 1e-11;
/// Digits of the reference value.
const PUBLISHED: f64 = 1e-7;

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
        assert!((phi - TURNED).abs() < PUBLISHED + 1e3 * tolerance, "{tolerance}: {phi}");
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
        assert!((t - (2 * i + 1) as f64).abs() < ROUNDING * t);
    }
    assert_eq!(data.column("a").unwrap().values, vec![-1.0, 1.0, -1.0]);
    assert_eq!(data.events[0].outputs, [vec![-1.0], vec![1.0]]);
    assert_eq!(data.events[0].what.en, "sign(x) changes from plus to minus");
    for key in ["two_derivations", "power_balance"] {
        assert!(data.audit(key).unwrap().ok, "{:?}", data.audit(key));
    }
}

fn number(g: &mut Graph, n: i64, d: i64) -> Expr {
    g.number(Rational::new(n, d).unwrap())
}

/// -k x + F where |x| has a dead zone: F = 1, k = 100 beyond |x| = 0.1.
#[test]
fn equilibrium_lies_on_the_active_branch_of_a_switch() {
    let mut machine = shaft::single(|g, [x, _, _]| {
        let (gap, hundred, one) = (number(g, 1, 10), number(g, -100, 1), g.one());
        let beyond = g.sub(x, gap);
        let pull = g.mul(hundred, beyond);
        let zero = g.zero();
        let spring = g.switch(beyond, Edge::Open, pull, zero);
        (one, g.add(spring, one))
    });
    // from beyond the gap Newton finds 0.1 + 1/100; inside the gap nothing resists
    let outcome = equilibrium(&mut machine, &[0.5, 0.0], &Equilibrium::default());
    assert!(outcome.fault.is_none(), "{:?}", outcome.fault);
    assert!((outcome.dataset.column("x").unwrap().values[0] - 0.11).abs() < ROUNDING);
    assert_eq!(outcome.dataset.column("stable").unwrap().values[0], 1.0);
    let inside = equilibrium(&mut machine, &[0.05, 0.0], &Equilibrium::default());
    assert!(inside.fault.is_some() && inside.dataset.columns.iter().all(|c| c.values.is_empty()));
}

#[test]
fn pendulum_on_shaft_hangs_where_the_moments_balance() {
    let mut machine = shaft::shaft(0.01);
    let outcome = equilibrium(&mut machine, &[1e-3, -2e-3, 0.7, 0.0, 0.0, 0.0], &Equilibrium::default());
    assert!(outcome.fault.is_none(), "{:?}", outcome.fault);
    for name in ["x", "y", "phi"] {
        // at t = 0 the shaft stands still and the supports are counted from static equilibrium
        assert!(outcome.dataset.column(name).unwrap().values[0].abs() < MOVED);
    }
}

fn failing(machine: &mut analysis::Machine, start: &[f64], until: f64) -> (Outcome, &'static str) {
    let outcome = simulate(machine, start, Simulate { grid: Grid::Every(until / 100.0), ..Simulate::until(until) });
    let fault = outcome.fault.clone().expect("a fault");
    assert!(outcome.dataset.partial && !fault.what.ru.is_empty() && fault.what.ru != fault.what.en, "{fault}");
    (outcome, fault.code)
}

/// x^2 x'' = -x x'^2, that is (x^2)'' = 0: x = sqrt(1 - 2 t) loses its mass at t = 1/2.
#[test]
fn mass_that_vanishes_on_the_way_ends_the_run_there() {
    let mut machine = shaft::single(|g, [x, v, _]| {
        let (mass, square) = (g.square(x), g.square(v));
        let force = g.mul(x, square);
        (mass, g.neg(force))
    });
    let (outcome, code) = failing(&mut machine, &[1.0, -1.0], 1.0);
    assert!(["S003", "P005", "P001"].contains(&code), "{code}");
    let times = &outcome.dataset.columns[0].values;
    assert!((50..=51).contains(&times.len()), "{}", times.len());
    let x = &outcome.dataset.column("x").unwrap().values;
    assert!((x[40] - (1.0_f64 - 0.8).sqrt()).abs() < STEEP);
}

#[test]
fn start_on_a_singularity_is_named() {
    // a spring of rest length 1 to the origin, along the distance sqrt(x^2): no direction at x = 0
    let mut machine = shaft::single(|g, [x, _, _]| {
        let square = g.square(x);
        let distance = g.sqrt(square);
        let one = g.one();
        let inverse = g.div(one, distance);
        let (stretch, direction) = (g.sub(one, distance), g.mul(x, inverse));
        (one, g.mul(stretch, direction))
    });
    let (outcome, code) = failing(&mut machine, &[0.0, 0.0], 1.0);
    assert!(code.starts_with('P'), "{code}");
    assert!(outcome.dataset.columns.iter().all(|c| c.values.is_empty()));
}

/// x'' = -1e12 x' beside a run of 1e3 s: 1e14 steps.
#[test]
fn hopelessly_stiff_run_of_taylor_steps_is_given_up() {
    let mut machine = shaft::single(|g, [x, v, _]| {
        let (drag, one) = (number(g, -1_000_000_000_000, 1), g.one());
        let (damping, spring) = (g.mul(drag, v), g.neg(x));
        (one, g.add(damping, spring))
    });
    let run = |machine: &mut analysis::Machine, method| {
        let options = Simulate { grid: Grid::At(vec![1e3]), method, ..Simulate::until(1e3) };
        simulate(machine, &[1.0, 0.0], options)
    };
    let outcome = run(&mut machine, Method::Taylor);
    assert_eq!(outcome.fault.map(|fault| fault.code), Some("S010"));
    // x = e^(-1e-12 t) is no trouble for the implicit method
    let outcome = run(&mut machine, Method::Auto);
    assert!(outcome.fault.is_none(), "{:?}", outcome.fault);
    assert!((outcome.dataset.column("x").unwrap().values[0] - (-1e-9_f64).exp()).abs() < MOVED);
}

/// A block under a small drive with friction by sign(v) sticks: the switch has no direction.
#[test]
fn friction_by_sign_under_a_small_drive_chatters() {
    let mut machine = shaft::single(|g, [_, v, t]| {
        let (sign, one, half) = (g.call(Function::Sign, &[v]), g.one(), number(g, 1, 2));
        let wave = g.call(Function::Sin, &[t]);
        let drive = g.mul(half, wave);
        (one, g.sub(drive, sign))
    });
    let (outcome, code) = failing(&mut machine, &[0.0, 1.0], 10.0);
    assert_eq!(code, "S001");
    assert!(outcome.dataset.columns[0].values.len() > 5);
}

/// Only what is shown is evaluated: an output without a value elsewhere does not stop the run.
#[test]
fn outputs_that_are_not_asked_for_are_not_evaluated() {
    let mut machine = shaft::shaft(0.01);
    let start = machine.start().unwrap();
    let options = || Simulate { grid: Grid::At(vec![0.5]), ..Simulate::until(1.0) };
    let all = simulate(&mut machine, &start, options()).dataset;
    let one = simulate(&mut machine, &start, Simulate { outputs: Some(vec!["phi".into()]), ..options() }).dataset;
    let again = simulate(&mut machine, &start, options()).dataset;
    assert_eq!(one.columns.len(), 2);
    assert_eq!(one.column("phi"), all.column("phi"));
    assert_eq!(all.columns, again.columns);
}

/// Let go with both rods level, the double pendulum has three coefficients in four zero at the start: no order may be misled by that.
#[test]
fn runs_of_zero_coefficients_mislead_no_order() {
    let quarter = std::f64::consts::FRAC_PI_2;
    for tolerance in [1e-3, 1e-6, 1e-9] {
        for order in 6..=40 {
            let mut machine = shaft::double_pendulum();
            let options = Options { tolerance, order: Some(order), span: 5.0, ..Options::default() };
            let mut flow = Flow::start(&mut machine, 0.0, &[quarter, quarter, 0.0, 0.0], &options).unwrap();
            while !flow.reached(5.0) {
                flow.advance(5.0).unwrap();
                assert!(flow.work().steps < 20_000, "order {order}, {tolerance}");
            }
            let [a, b, u, v] = *flow.state() else { panic!() };
            let kinetic = u * u + 0.5 * v * v + u * v * (a - b).cos();
            let energy = kinetic - 9.81 * (2.0 * a.cos() + b.cos());
            // E is of order 30; a step errs by about p tolerances of the change in it
            assert!(energy.abs() < 2e3 * tolerance, "order {order}, {tolerance}: {energy}");
        }
    }
}
