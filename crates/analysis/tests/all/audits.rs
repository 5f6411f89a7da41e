//! Every audit of a motion sees the law broken on purpose, and passes where the law holds.

use crate::common;

use analysis::audits::impacts::{ImpactEnergy, drift, relative};
use analysis::marks::named::{Direction, Named};
use analysis::studies::simulate::{Grid, Simulate, simulate};
use analysis::system::BlowWork;
use analysis::{Dataset, Fault, Guard, Mode, Powers, Quantity, System};
use common::*;

/// Records of a few operations: units of the last place.
const ROUNDING: f64 = 1e-15;
/// An instant of a closed form: units of the last place.
const INSTANT: f64 = 1e-14;
/// A named instant, relative to times above 1.
const NAMED: f64 = 1e-13;
/// The value at an extreme or an event: flat or steep once, rounding of the series.
const VALUE: f64 = 1e-12;
/// What a law that holds leaves in its audit: the rounding of the motion, relative to its scale.
const FAIR: f64 = 1e-11;
/// A ratio of two audits, each known to rounding of its terms.
const RATIO: f64 = 1e-10;
/// The instant of an extreme: there the value is flat, so half the digits would be expected; its series gives more.
const FLAT: f64 = 1e-9;

/// x'' = -x with a ledger of its own: what it says of its powers may be false.
struct Told {
    hand: Hand,
    /// Power said to be supplied, by (t, v).
    loads: fn(f64, f64) -> f64,
    /// dE/dt as told, beyond the true one.
    excess: f64,
    /// Power that a friction takes, by v.
    friction: Option<fn(f64) -> f64>,
    /// Residual of a balance beside terms of size 1.
    residual: Option<f64>,
}

impl Told {
    fn new() -> Told {
        Told { hand: oscillator(1.0), loads: |_, _| 0.0, excess: 0.0, friction: None, residual: None }
    }
}

impl System for Told {
    fn states(&self) -> &[Quantity] {
        self.hand.states()
    }
    fn n_coordinates(&self) -> usize {
        1
    }
    fn guards(&self) -> &[Guard] {
        self.hand.guards()
    }
    fn outputs(&self) -> &[Quantity] {
        self.hand.outputs()
    }
    fn expand(&mut self, t: f64, x: &[f64], modes: &[Mode], order: usize) -> Result<(), Fault> {
        self.hand.expand(t, x, modes, order)
    }
    fn state(&self, i: usize) -> &[f64] {
        self.hand.state(i)
    }
    fn guard(&self, i: usize) -> &[f64] {
        self.hand.guard(i)
    }
    fn observe(&mut self, t: f64, x: &[f64], modes: &[Mode], values: &mut [f64]) -> Result<(), Fault> {
        self.hand.observe(t, x, modes, values)
    }
    fn powers(&mut self, t: f64, x: &[f64], accelerations: &[f64], _: &[Mode]) -> Option<Powers> {
        let rate = x[1] * (accelerations[0] + x[0]) + self.excess * accelerations[0];
        Some(Powers { rate, loads: (self.loads)(t, x[1]), ..Powers::default() })
    }
    fn energies(&mut self, _: f64, x: &[f64], _: &[Mode]) -> Option<[f64; 2]> {
        Some([0.5 * x[1] * x[1], 0.5 * x[0] * x[0]])
    }
    fn n_frictions(&self) -> usize {
        usize::from(self.friction.is_some())
    }
    fn frictions(&mut self, _: f64, x: &[f64], _: &[Mode]) -> Option<Vec<Option<f64>>> {
        self.friction.map(|power| vec![Some(power(x[1]))])
    }
    fn balances(&mut self, _: f64, _: &[f64], _: &[f64], _: &[Mode]) -> Option<Vec<[f64; 2]>> {
        self.residual.map(|r| vec![[r, 1.0]])
    }
}

fn run(mut system: Told, tolerance: f64, until: f64) -> Dataset {
    simulate(&mut system, &[1.0, 0.0], Simulate { tolerance, ..Simulate::until(until) }).dataset
}

#[test]
fn ledger_sees_work_that_nobody_did() {
    let honest = run(Told::new(), 1e-12, 20.0);
    let audit = honest.audit("energy_ledger").unwrap();
    // some ten steps, each off by about the tolerance of its change
    assert!(audit.ok && audit.value < FAIR, "{audit:?}");
    // a thousandth of the power that flows between the energies
    let told = run(Told { loads: |_, v| 1e-3 * v * v, ..Told::new() }, 1e-12, 20.0);
    assert!(!told.audit("energy_ledger").unwrap().ok);
    // a pulse of 1e-4 J between the points of the rule
    let pulse = |t: f64, _: f64| 1e-4 / (0.02 * 3.0_f64.sqrt()) * (-((t - 7.0) / 0.02).powi(2)).exp();
    assert!(!run(Told { loads: pulse, ..Told::new() }, 1e-12, 20.0).audit("energy_ledger").unwrap().ok);
}

#[test]
fn ledger_integrates_a_power_to_its_last_digits() {
    // x = cos t with a load that is said to give v² / 1000, or 1/1000 at all times: what is open is its work, (t/2 - sin(2 t)/4)/1000 J or t/1000 J, beside the
    // same energy
    let open = |loads| run(Told { loads, ..Told::new() }, 1e-12, 20.0).audit("energy_ledger").unwrap().value;
    let ratio = open(|_, v| 1e-3 * v * v) / open(|_, _| 1e-3);
    let exact = (10.0 - 40.0_f64.sin() / 4.0) / 20.0;
    // the steps err by 1e-12 each, the quadrature by no more than what its halving asks for
    assert!((ratio - exact).abs() < RATIO, "{ratio} {exact}");
}

#[test]
fn ledger_sees_the_drift_of_a_long_run_whatever_the_tolerance() {
    let data = run(Told::new(), 1e-3, 1000.0);
    let audit = data.audit("energy_ledger").unwrap();
    // the limit of the audit, not of the test: a break of a hundredth is far beyond it
    assert!(!audit.ok && audit.limit <= 1e-3 && audit.value > 0.01, "{audit:?}");
    // the power balance at instants cannot: it is local
    assert!(data.audit("power_balance").unwrap().ok);
}

#[test]
fn power_balance_sees_a_wrong_inertia_force() {
    assert!(run(Told::new(), 1e-12, 5.0).audit("power_balance").unwrap().ok);
    assert!(!run(Told { excess: 1e-6, ..Told::new() }, 1e-12, 5.0).audit("power_balance").unwrap().ok);
}

#[test]
fn friction_that_drives_is_seen_and_friction_that_brakes_passes() {
    let brakes = run(Told { friction: Some(|v| 0.3 * v.abs()), ..Told::new() }, 1e-12, 5.0);
    assert!(brakes.audit("friction_work").unwrap().ok);
    // one side only: a branch with the wrong sign
    let drives = run(Told { friction: Some(|v| 0.3 * v), ..Told::new() }, 1e-12, 5.0);
    assert!(!drives.audit("friction_work").unwrap().ok);
    assert!(run(Told::new(), 1e-12, 5.0).audit("friction_work").is_none());
}

#[test]
fn body_balance_sees_a_missing_reaction() {
    assert!(run(Told { residual: Some(1e-13), ..Told::new() }, 1e-12, 5.0).audit("body_balance").unwrap().ok);
    assert!(!run(Told { residual: Some(1e-3), ..Told::new() }, 1e-12, 5.0).audit("body_balance").unwrap().ok);
}

#[test]
fn drift_of_connections_is_seen() {
    assert!(drift(1e-13, 5, 1e-12).unwrap().ok && !drift(1e-6, 5, 1e-12).unwrap().ok);
    assert!(drift(0.0, 0, 1e-12).is_none());
}

#[test]
fn an_impact_on_a_moving_table_may_gain_energy_but_not_beside_the_table() {
    // ball at -0.2 m/s, table rising at 0.4 m/s, e = 1/2: rate after 0.4 + 0.3 = 0.7 m/s, from 0.02 to 0.245 J
    let mut ball = Told::new();
    let of = |system: &mut Told, after: f64| relative(system, 0.0, [&[0.0, -0.2], &[0.0, after]], &[0.0, 0.4], &[]).unwrap();
    let [before, after] = of(&mut ball, 0.7);
    assert!((before - 0.18).abs() < ROUNDING && (after - 0.045).abs() < ROUNDING);
    let mut fair = ImpactEnergy::default();
    assert!((fair.record([before, after]) - 0.135).abs() < ROUNDING);
    assert!(fair.audit().unwrap().ok);
    // 0.401 + 0.6: more than it came with
    let [before, after] = of(&mut ball, 1.001);
    let mut foul = ImpactEnergy::default();
    foul.record([before, after]);
    assert!(!foul.audit().unwrap().ok);
}

#[test]
fn extremes_are_those_of_the_motion_and_not_of_the_rows() {
    for until in [1.0, 20.0, 500.0] {
        let options = Simulate { grid: Grid::At(vec![0.3]), ..Simulate::until(until) };
        let data = simulate(&mut oscillator(3.0), &[0.0, 3.0], options).dataset;
        let x = data.extreme("x0").unwrap();
        let top = std::f64::consts::PI / 6.0;
        assert!((x.max - 1.0).abs() < VALUE && (x.t_max - top).abs() < FLAT, "{x:?}");
        let low = if until < 2.0 { 3.0_f64.sin() } else { -1.0 };
        // sin 3 > 0: the least value of the first second is at the start
        assert!((x.min - low.min(0.0)).abs() < FAIR, "{x:?}");
        assert!(until < 2.0 || (x.t_min - 3.0 * top).abs() < FLAT, "{x:?}");
    }
}

#[test]
fn named_events_are_found_and_do_not_touch_the_motion() {
    let named = |direction, stop| Named { name: "zero".into(), output: 0, direction, stop };
    let with = |events: Vec<Named>| simulate(&mut oscillator(2.0), &[1.0, 0.0], Simulate { events, ..Simulate::until(10.0) }).dataset;
    let (plain, watched) = (with(vec![]), with(vec![named(Direction::Rising, false)]));
    assert_eq!(plain.columns, watched.columns);
    let pi = std::f64::consts::PI;
    // cos 2t rises at 3π/4, 7π/4, 11π/4
    let expected = [0.75 * pi, 1.75 * pi, 2.75 * pi];
    assert_eq!(watched.events.len(), 3);
    for (event, t) in watched.events.iter().zip(expected) {
        assert!((event.t - t).abs() < NAMED * t.max(1.0), "{} {t}", event.t);
        assert!((event.outputs[1][1] - 2.0).abs() < VALUE);
    }
    assert_eq!(with(vec![named(Direction::Both, false)]).events.len(), 6);
    let stopped = with(vec![named(Direction::Falling, true)]);
    assert!((stopped.columns[0].values.last().unwrap() - 0.25 * pi).abs() < INSTANT);
    assert_eq!(stopped.extreme("x1").unwrap().t_min, *stopped.columns[0].values.last().unwrap());
    assert!(!stopped.partial);
}

#[test]
fn digits_fall_where_the_motion_parts_from_its_repetition() {
    let run = |tolerance: f64, until: f64| {
        let options = Simulate { check: true, tolerance, ..Simulate::until(until) };
        simulate(&mut oscillator(1.0), &[1.0, 0.0], options).dataset
    };
    let good = run(1e-12, 20.0);
    assert!(good.digits.as_ref().unwrap().columns.iter().all(|c| c.digits >= 11), "{:?}", good.digits);
    let poor = run(1e-3, 1000.0);
    let held = poor.digits.as_ref().unwrap();
    assert!(held.columns.iter().all(|c| c.digits <= 2 && c.lost.is_some()), "{held:?}");
    assert!(poor.notes.iter().any(|n| n.en.contains("digits only")));
}

/// A grain takes 1.5e-6 J from a machine of 1e9 J: the work tells it, and the energies say whether it can be.
#[test]
fn works_of_impulses_are_checked_by_the_energies() {
    let work = |done: f64| BlowWork { done, met: 4.5e-6, rounding: 1e-17 };
    let mut fair = ImpactEnergy::default();
    assert_eq!(fair.record_work(work(-1.5e-6), Some([1e9, 1e9])), 1.5e-6);
    assert!(fair.audit().is_some_and(|a| a.ok) && fair.audit_of_work().is_some_and(|a| a.ok));
    // an elastic blow takes nothing, whatever rounding leaves of it
    assert_eq!(ImpactEnergy::default().record_work(work(1e-19), None), 0.0);
    let mut gaining = ImpactEnergy::default();
    gaining.record_work(work(1e-9), None);
    assert!(gaining.audit().is_some_and(|a| !a.ok));
    let mut other = ImpactEnergy::default();
    other.record_work(work(-1.5e-6), Some([1.0, 0.5]));
    assert!(other.audit_of_work().is_some_and(|a| !a.ok));
}
