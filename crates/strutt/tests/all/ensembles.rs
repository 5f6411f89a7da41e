//! Motions in lanes against the same motions by themselves.

use analysis::studies::simulate::{Grid, Kept, Made, Outcome, Simulate, Wanted};
use studies::pipeline::{self, Machine};
use studies::{Source, Watch};

/// Two integrations at 1e-10 of some ten seconds of a regular motion: their errors grow with time.
const ALIKE: f64 = 1e-6;
const TOLERANCE: f64 = 1e-10;
const UNTIL: f64 = 5.0;

fn machine(name: &str) -> Machine {
    let text = strutt::gallery::find(name).expect("an example").text;
    pipeline::build(&Source::new(&format!("{name}.toml"), text), &[], &mut Watch::default()).expect("a machine")
}

fn options(machine: &Machine) -> Simulate<'static> {
    let outputs = machine.equations.coordinates.iter().map(|q| machine.equations.graph.symbol_info(q.symbols[0]).name.clone()).collect();
    Simulate { grid: Grid::At(Vec::new()), tolerance: TOLERANCE, outputs: Some(outputs), kept: Kept::Numbers, ..Simulate::until(UNTIL) }
}

/// The machine with values of a parameter about its own.
fn machines(name: &str, parameter: &str, count: usize) -> Vec<Machine> {
    let base = machine(name);
    let own = base.model.parameters.iter().find(|p| p.name == parameter).and_then(|p| p.number).expect("a number");
    (0..count).map(|k| base.with_values(&[(parameter, own * (0.83 + 0.031 * k as f64))]).expect("a machine")).collect()
}

fn in_lanes(machines: &[&Machine]) -> Vec<Made> {
    let of =
        |machine: &&Machine| Wanted { machine: machine.system.clone(), start: machine.system.start().unwrap(), options: options(machine) };
    let mut wanted: Vec<Wanted<'_>> = machines.iter().map(of).collect();
    (analysis::made::ABREAST)(&mut wanted, None)
}

fn by_itself(machine: &Machine) -> Outcome {
    let mut system = machine.system.clone();
    let start = system.start().unwrap();
    (analysis::made::SIMULATE)(&mut system, &start, options(machine))
}

fn keys(outcome: &Outcome) -> Vec<String> {
    let mut keys: Vec<String> = outcome.dataset.audits.iter().map(|audit| audit.key.clone()).collect();
    keys.sort_unstable();
    keys
}

/// Smooth machines and one whose drive switches in time: least, greatest and mean values, and the same checks.
#[test]
fn motions_in_lanes_are_the_motions_of_the_scalar_path() {
    let cases = [
        ("pendulum-on-shaft", "m"),
        ("double-pendulum", "m1"),
        ("duffing", "c"),
        ("parametric-pendulum", "l"),
        ("van-der-pol", "mu"),
        ("spherical-pendulum", "l"),
        ("basic-oscillator", "m"),
    ];
    let mut compared = 0;
    for (name, parameter) in cases {
        let base = machine(name);
        let known = base.model.parameters.iter().filter(|p| p.number.is_some_and(|v| v != 0.0)).map(|p| p.name.clone());
        let known: Vec<String> = known.collect();
        let parameter = if known.iter().any(|own| own == parameter) { parameter } else { &known[0] };
        let machines = machines(name, parameter, 11);
        for (machine, made) in machines.iter().zip(in_lanes(&machines.iter().collect::<Vec<_>>())) {
            let alone = by_itself(machine);
            let Made::Found(outcome) = made else {
                println!("{name}: {made:?}");
                continue;
            };
            assert!(alone.fault.is_none(), "{name}");
            assert_eq!(keys(&outcome), keys(&alone), "{name}");
            for (own, other) in outcome.dataset.extremes.iter().zip(&alone.dataset.extremes) {
                let scale = other.min.abs().max(other.max.abs());
                let near = |a: f64, b: f64| (a - b).abs() <= ALIKE * scale;
                assert!(near(own.min, other.min) && near(own.max, other.max), "{name}: {own:?} {other:?}");
            }
            for (own, other) in outcome.dataset.overall.iter().zip(&alone.dataset.overall) {
                let scale = alone.dataset.extremes[other.column - 1].max.abs().max(alone.dataset.extremes[other.column - 1].min.abs());
                assert!((own.integral - other.integral).abs() <= ALIKE * scale * UNTIL, "{name}: {own:?} {other:?}");
                assert!((own.last - other.last).abs() <= ALIKE * scale, "{name}: {own:?} {other:?}");
            }
            compared += 1;
        }
    }
    assert!(compared >= 5 * 11, "only {compared} went in lanes");
}

/// The same bits whatever runs beside a motion, and in whatever lane it is.
#[test]
fn a_motion_does_not_see_what_runs_beside_it() {
    let machines = machines("pendulum-on-shaft", "m", 11);
    let all: Vec<&Machine> = machines.iter().collect();
    let together = in_lanes(&all);
    let mut reversed = in_lanes(&all.iter().rev().copied().collect::<Vec<_>>());
    reversed.reverse();
    for (k, (one, other)) in together.iter().zip(&reversed).enumerate() {
        let alone = in_lanes(&[&machines[k]]);
        assert_eq!(format!("{one:?}"), format!("{other:?}"));
        assert_eq!(format!("{one:?}"), format!("{:?}", alone[0]));
        assert!(matches!(one, Made::Found(_)), "{one:?}");
    }
}

/// What lanes do not have is said.
#[test]
fn machines_that_lanes_do_not_take_are_left_with_a_reason() {
    for name in ["stick-slip", "four-bar", "bouncing-ball"] {
        let machine = machine(name);
        let made = in_lanes(&[&machine]);
        assert!(matches!(&made[0], Made::Left(why) if !why.en.is_empty() && why.ru != why.en), "{name}: {:?}", made[0]);
    }
}
