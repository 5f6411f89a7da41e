//! Machines with connections: assembly, long runs, contacts and friction on lowered equations.

#[path = "common/linkage.rs"]
mod linkage;

use analysis::Machine;
use analysis::studies::simulate::{Grid, Outcome, Simulate, simulate};
use analysis::taylor::{Flow, Options};
use linkage::*;

fn assembled(b: &Build) -> Result<Machine, analysis::Fault> {
    Machine::assembled(&b.e, &[], &|_| vec![])
}

fn run(b: &Build, until: f64, grid: Grid) -> Outcome {
    let mut machine = assembled(b).unwrap();
    let start = machine.start().unwrap();
    let outcome = simulate(&mut machine, &start, Simulate { grid, ..Simulate::until(until) });
    assert!(outcome.fault.is_none(), "{:?}", outcome.fault);
    outcome
}

#[test]
fn slider_crank_is_assembled_from_its_crank() {
    let b = slider_crank(5.0);
    let x = assembled(&b).unwrap().start().unwrap();
    let (phi, w): (f64, f64) = (0.3, 5.0);
    let psi = -(0.1 / 0.3 * phi.sin()).asin();
    assert_eq!((x[0], x[3]), (phi, w));
    assert!((x[1] - psi).abs() < 1e-15 && (x[2] - (0.1 * phi.cos() + 0.3 * psi.cos())).abs() < 1e-15, "{x:?}");
    let psi_rate = -w * 0.1 * phi.cos() / (0.3 * psi.cos());
    assert!((x[4] - psi_rate).abs() < 1e-13, "{x:?}");
    assert!((x[5] - (-0.1 * w * phi.sin() - 0.3 * psi_rate * psi.sin())).abs() < 1e-13);
}

/// Runs so many revolutions of the crank and returns the largest violation at the ends of steps, and the drift of energy.
fn revolve(b: &Build, turns: f64, place: impl Fn(&[f64]) -> f64) -> (f64, f64, f64) {
    let mut machine = assembled(b).unwrap();
    let start = machine.start().unwrap();
    let energy = |machine: &mut Machine, x: &[f64]| {
        use analysis::System;
        let index = machine.outputs().iter().position(|o| o.name == "E").unwrap();
        machine.show(&[index]).unwrap();
        let mut values = vec![0.0; machine.outputs().len()];
        machine.observe(0.0, x, &[], &mut values).unwrap();
        values[index]
    };
    let before = energy(&mut machine, &start);
    let kinetic = before.abs();
    let mut flow = Flow::start(&mut machine, 0.0, &start, &Options::default()).unwrap();
    let end = start[0] + turns * 2.0 * std::f64::consts::PI;
    let mut worst: f64 = 0.0;
    while flow.state()[0] < end {
        flow.advance(1e9).unwrap();
        worst = worst.max(place(flow.state()));
    }
    let (x, drift) = (flow.state().to_vec(), flow.drift());
    println!("steps {} projections {}", flow.work().steps, flow.work().projections);
    let after = energy(&mut machine, &x);
    (worst, (after - before).abs() / kinetic, drift)
}

#[test]
fn slider_crank_runs_1e4_revolutions_closed_and_conservative() {
    let (gap, energy, drift) = revolve(&slider_crank(20.0), 1e4, |x| {
        let (px, py) = (0.1 * x[0].cos() + 0.3 * x[1].cos() - x[2], 0.1 * x[0].sin() + 0.3 * x[1].sin());
        px.hypot(py) / 0.4
    });
    println!("gap {gap:e} energy {energy:e} drift {drift:e}");
    assert!(gap < 1e-12 && energy < 1e-10);
}

#[test]
fn four_bar_runs_1e4_revolutions_closed_and_conservative() {
    let (gap, energy, drift) = revolve(&four_bar(20.0), 1e4, |x| {
        let (px, py) =
            (0.1 * x[0].cos() + 0.35 * x[1].cos() - 0.3 - 0.3 * x[2].cos(), 0.1 * x[0].sin() + 0.35 * x[1].sin() - 0.3 * x[2].sin());
        px.hypot(py) / 0.4
    });
    println!("gap {gap:e} energy {energy:e} drift {drift:e}");
    assert!(gap < 1e-12 && energy < 1e-10);
}

/// Pendulum of length 1 in x, y: the rod force is m (g y-part + v²).
#[test]
fn rod_of_a_pendulum_has_the_force_of_the_closed_form() {
    let mut b = Build::new();
    let [x, vx] = b.coordinate("x", "m", Start::Given(0.6), Start::Guess(0.0));
    let [y, vy] = b.coordinate("y", "m", Start::Guess(-0.5), Start::Guess(0.0));
    let point = kinetic(&mut b, 2.0, [x, y]);
    let weight = b.times(2.0 * 9.81, y);
    b.lagrange(point, weight, &[]);
    let (xx, yy) = (b.square(x), b.square(y));
    let minus = b.number(-1.0);
    let sum = b.add(&[xx, yy, minus]);
    let half = b.times(0.5, sum);
    b.ideal("rod", half);
    let _ = (vx, vy);
    let data = run(&b, 20.0, Grid::Auto).dataset;
    let column = |name: &str| data.column(name).unwrap().values.clone();
    let (x, y, e, rod) = (column("x"), column("y"), column("E"), column("rod"));
    for i in 0..x.len() {
        // E = m v²/2 + m g y from rest at y = -0.8; force along the rod = m v²/l - m g y... with J = (x, y): λ = -(m v² - m g y)
        let v2 = 2.0 * 9.81 * (-0.8 - y[i]);
        assert!((x[i].hypot(y[i]) - 1.0).abs() < 1e-13);
        assert!((e[i] - e[0]).abs() < 1e-11 * 16.0);
        assert!((rod[i] + 2.0 * v2 - 2.0 * 9.81 * y[i]).abs() < 1e-9, "{i}: {}", rod[i]);
    }
    assert!(y[0] == -0.8 || (y[0] + 0.8).abs() < 1e-15);
}
