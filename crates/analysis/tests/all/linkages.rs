//! Machines with connections: assembly, long runs, contacts and friction on lowered equations.

use crate::linkage;

use analysis::Machine;
use analysis::integrate::taylor::{Flow, Options};
use analysis::studies::simulate::{Grid, Outcome, Simulate, simulate};
use linkage::*;

/// A closed form of a few operations: units of the last place.
const ROUNDING: f64 = 1e-15;
/// An instant as the root of a series: units of the last place of times up to ten, and of the slope there.
const INSTANT: f64 = 1e-14;
/// What projection on the surface of the conditions leaves: rounding times the condition of a small system.
const PROJECTED: f64 = 1e-13;
/// A state behind some steps: each step adds units of the last place.
const MOVED: f64 = 1e-12;
/// Energy of a long motion: the rounding of each step walks.
const ENERGY: f64 = 1e-11;
/// The same over hundreds of turns, and losses as differences of energies.
const LASTING: f64 = 1e-10;
/// A force from accelerations: the errors of velocities times twice the velocity, over a long motion.
const FORCE: f64 = 1e-9;

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
    assert!((x[1] - psi).abs() < ROUNDING && (x[2] - (0.1 * phi.cos() + 0.3 * psi.cos())).abs() < ROUNDING, "{x:?}");
    let psi_rate = -w * 0.1 * phi.cos() / (0.3 * psi.cos());
    assert!((x[4] - psi_rate).abs() < PROJECTED, "{x:?}");
    assert!((x[5] - (-0.1 * w * phi.sin() - 0.3 * psi_rate * psi.sin())).abs() < PROJECTED);
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
    assert!(gap < MOVED && energy < LASTING);
}

#[test]
fn four_bar_runs_1e4_revolutions_closed_and_conservative() {
    let (gap, energy, drift) = revolve(&four_bar(20.0), 1e4, |x| {
        let (px, py) =
            (0.1 * x[0].cos() + 0.35 * x[1].cos() - 0.3 - 0.3 * x[2].cos(), 0.1 * x[0].sin() + 0.35 * x[1].sin() - 0.3 * x[2].sin());
        px.hypot(py) / 0.4
    });
    println!("gap {gap:e} energy {energy:e} drift {drift:e}");
    assert!(gap < MOVED && energy < LASTING);
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
        assert!((x[i].hypot(y[i]) - 1.0).abs() < PROJECTED);
        assert!((e[i] - e[0]).abs() < ENERGY * 16.0);
        assert!((rod[i] + 2.0 * v2 - 2.0 * 9.81 * y[i]).abs() < FORCE, "{i}: {}", rod[i]);
    }
    assert!(y[0] == -0.8 || (y[0] + 0.8).abs() < ROUNDING);
}

mod switching {
    use super::*;
    use analysis::integrate::taylor::Options;

    /// Switches until the end: (t, guard, before, after) and the final state.
    fn follow(b: &Build, end: f64) -> (Vec<analysis::integrate::crossings::Switch>, Vec<f64>) {
        let mut machine = assembled(b).unwrap();
        let start = machine.start().unwrap();
        let options = Options { span: end, ..Options::default() };
        let mut flow = Flow::start(&mut machine, 0.0, &start, &options).unwrap();
        let mut switches = flow.switches().to_vec();
        while !flow.reached(end) {
            flow.advance(end).unwrap();
            switches.extend_from_slice(flow.switches());
        }
        (switches, flow.state().to_vec())
    }

    /// Body of mass m on a spring and a belt, as the card has it.
    fn belt(m: f64, c: f64, belt: f64, fixed: f64, kinetic: f64) -> Build {
        let mut b = Build::new();
        let [x, v] = b.coordinate("x", "m", Start::Given(0.0), Start::Given(belt));
        let square = b.square(v);
        let t = b.times(0.5 * m, square);
        let square = b.square(x);
        let p = b.times(0.5 * c, square);
        b.lagrange(t, p, &[]);
        let speed = b.number(belt);
        let sliding = b.sub(v, speed);
        b.friction("friction", sliding, fixed, kinetic);
        b
    }

    #[test]
    fn belt_oscillator_keeps_its_period() {
        let exact = 5.0 + std::f64::consts::PI + 2.0 * 0.4_f64.atan();
        let (switches, _) = follow(&belt(1.0, 1.0, 0.2, 1.0, 0.5), 100.0);
        let breaks: Vec<f64> = switches.iter().filter(|s| s.before == analysis::Mode::Zero).map(|s| s.t).collect();
        assert_eq!(breaks.len(), 11);
        for pair in breaks.windows(2) {
            assert!((pair[1] - pair[0] - exact).abs() < MOVED, "{:e}", pair[1] - pair[0] - exact);
        }
    }

    /// Scotch yoke x = 0.1 cos φ of mass 2 on a crank of inertia 0.05, friction 10 N in its guide and a torque of friction at the crank.
    fn yoke(torque: f64) -> Build {
        let mut b = Build::new();
        let [phi, w] = b.coordinate("phi", "rad", Start::Given(0.0), Start::Given(20.0));
        let c = b.cos(phi);
        let x = b.times(0.1, c);
        let v = b.rate(x);
        let (w2, slider) = (b.square(w), b.square(v));
        let crank = b.times(0.025, w2);
        let t = b.add(&[crank, slider]);
        let zero = b.e.graph.zero();
        b.lagrange(t, zero, &[]);
        b.friction("guide", v, 10.0, 10.0);
        if torque > 0.0 {
            b.friction("bearing", w, torque, torque);
        }
        b
    }

    /// 10 J less 10 N times the way of the slider and the torque times the angle: dead centres, that of the start included, take nothing.
    #[test]
    fn rubbing_slider_runs_through_its_dead_centres() {
        use std::f64::consts::PI;
        for (torque, end) in [(0.0, 0.3), (0.2, 0.3), (0.0, 20.0)] {
            let (_, x) = follow(&yoke(torque), end);
            let (phi, w) = (x[0], x[1]);
            let halves = (phi / PI).floor();
            let way = 0.1 * (2.0 * halves + 1.0 - (phi - halves * PI).cos());
            let left = 10.0 - 10.0 * way - torque * phi;
            let kinetic = 0.025 * w * w + (0.1 * w * phi.sin()).powi(2);
            assert!((kinetic - left).abs() < ENERGY, "{phi} {w}: {kinetic} against {left}");
            assert_eq!(w == 0.0, end > 1.0);
        }
    }

    /// Block on an incline of angle a in coordinates x, y of the ground: the plane is a condition, its force the normal force of the friction.
    fn incline(a: f64, fixed: f64, kinetic: f64, rates: [f64; 2]) -> Build {
        let mut b = Build::new();
        let [x, vx] = b.coordinate("x", "m", Start::Given(0.3), Start::Given(rates[0]));
        let [y, vy] = b.coordinate("y", "m", Start::Guess(0.0), Start::Guess(rates[1]));
        let t = kinetic_energy(&mut b, 0.7, [x, y]);
        let p = b.times(0.7 * 9.81, y);
        b.lagrange(t, p, &[]);
        // n = (-sin a, cos a): n·r = 0; t = (cos a, sin a)
        let (up, along) = (b.times(a.cos(), y), b.times(-a.sin(), x));
        let place = b.add(&[up, along]);
        let normal = b.ideal("normal", place);
        let (cx, cy) = (b.times(a.cos(), vx), b.times(a.sin(), vy));
        let sliding = b.add(&[cx, cy]);
        let friction = b.friction("friction", sliding, fixed, kinetic);
        b.press(friction, normal);
        b
    }

    #[test]
    fn block_on_a_rough_incline_stands_for_1e6_seconds_to_the_last_bit() {
        let b = incline(0.4, 0.5, 0.45, [0.0, 0.0]);
        let start = assembled(&b).unwrap().start().unwrap();
        let (switches, x) = follow(&b, 1e6);
        assert!(switches.is_empty(), "{switches:?}");
        assert_eq!(x, start);
        assert_eq!(&x[2..], &[0.0, 0.0]);
    }

    #[test]
    fn block_slides_up_stops_and_stays_or_returns() {
        let (a, g) = (0.4_f64, 9.81);
        let u = 2.0;
        let stop = u / (g * (a.sin() + 0.45 * a.cos()));
        let rates = [u * a.cos(), u * a.sin()];
        let (switches, x) = follow(&incline(a, 0.5, 0.45, rates), 100.0);
        assert_eq!(switches.len(), 1);
        assert!((switches[0].t - stop).abs() < INSTANT, "{} {stop}", switches[0].t);
        assert_eq!(&x[2..], &[0.0, 0.0]);
        let way = u * stop / 2.0;
        assert!((x[0] - 0.3 - way * a.cos()).abs() < INSTANT);
        // a smaller coefficient does not hold it: back with g (sin a - mu cos a)
        let mu = 0.2;
        let stop = u / (g * (a.sin() + mu * a.cos()));
        let (switches, x) = follow(&incline(a, mu, mu, rates), stop + 1.0);
        assert_eq!(switches.len(), 1);
        let back = -g * (a.sin() - mu * a.cos());
        assert!((switches[0].t - stop).abs() < INSTANT && (x[2] - back * a.cos()).abs() < MOVED, "{x:?}");
    }

    /// Two blocks on one another and on the ground; the lower one is pulled by a growing force F = 2 t.
    fn stacked() -> Build {
        let mut b = Build::new();
        let [x, v] = b.coordinate("x", "m", Start::Given(0.0), Start::Given(0.0));
        let [y, w] = b.coordinate("y", "m", Start::Given(0.0), Start::Given(0.0));
        let (v2, w2) = (b.square(v), b.square(w));
        let (t1, t2) = (b.times(0.5 * 2.0, v2), b.times(0.5 * 1.0, w2));
        let t = b.add(&[t1, t2]);
        let zero = b.e.graph.zero();
        let time = b.e.graph.symbol(b.e.time);
        let pull = b.times(2.0, time);
        let _ = (x, y);
        b.lagrange(t, zero, &[(0, pull)]);
        b.friction("ground", v, 6.0, 5.0);
        let sliding = b.sub(w, v);
        b.friction("between", sliding, 3.0, 2.0);
        b
    }

    #[test]
    fn two_frictions_break_away_one_after_the_other() {
        // ground breaks at 2 t = 6; together a = (2t - 5)/3; the upper block needs a <= 3: 2 t = 14; then 2 against 3 m/s²
        let (switches, x) = follow(&stacked(), 8.0);
        assert_eq!(switches.len(), 2, "{switches:?}");
        assert!((switches[0].t - 3.0).abs() < INSTANT && (switches[1].t - 7.0).abs() < INSTANT, "{switches:?}");
        let together = (49.0 - 9.0 - 5.0 * 4.0) / 3.0;
        assert!((x[3] - (together + 2.0)).abs() < MOVED, "{x:?}");
        assert!((x[2] - (together + (64.0 - 49.0 - 7.0) / 2.0)).abs() < MOVED, "{x:?}");
    }

    /// Pendulum of length 1 as x, y with a rod that hits a wall at x = 0.3 with restitution e and leans on it in the end.
    fn striking(e: f64) -> Build {
        let mut b = Build::new();
        let [x, _] = b.coordinate("x", "m", Start::Given(0.8), Start::Given(0.0));
        let [y, _] = b.coordinate("y", "m", Start::Guess(-0.5), Start::Guess(0.0));
        let t = kinetic_energy(&mut b, 2.0, [x, y]);
        let p = b.times(2.0 * 9.81, y);
        b.lagrange(t, p, &[]);
        let (xx, yy, minus) = (b.square(x), b.square(y), b.number(-1.0));
        let sum = b.add(&[xx, yy, minus]);
        let half = b.times(0.5, sum);
        b.ideal("rod", half);
        let wall = b.number(-0.3);
        let gap = b.add(&[x, wall]);
        b.contact("wall", gap, e);
        b
    }

    #[test]
    fn pendulum_bounces_off_a_wall_and_comes_to_rest_at_it() {
        let mut machine = assembled(&striking(0.5)).unwrap();
        let start = machine.start().unwrap();
        let outcome = simulate(&mut machine, &start, Simulate { grid: Grid::At(vec![10.0]), ..Simulate::until(10.0) });
        assert!(outcome.fault.is_none(), "{:?}", outcome.fault);
        let data = outcome.dataset;
        let low = 0.91_f64.sqrt();
        let speed = low * (2.0 * 9.81 * (low - 0.6)).sqrt();
        let first = &data.events[0];
        assert!(first.what.en.contains("impact") && first.what.en.contains("J lost"), "{}", first.what.en);
        assert!((first.states[0][2] + speed).abs() < MOVED && (first.states[1][2] - 0.5 * speed).abs() < MOVED, "{first:?}");
        let last = data.events.last().unwrap();
        assert!(last.what.en.contains("infinitely many impacts"), "{}", last.what.en);
        assert!((data.column("x").unwrap().values[0] - 0.3).abs() < ROUNDING);
        assert_eq!(data.column("x'").unwrap().values, vec![0.0]);
        // the whole energy above the place at the wall is lost
        assert!((data.counter("impact_loss").unwrap() - 2.0 * 9.81 * (low - 0.6)).abs() < LASTING);
        assert!(data.audits.iter().all(|a| a.ok), "{:?}", data.audits);
        // the rod carries the weight
        assert!((data.column("rod").unwrap().values[0] + 2.0 * 9.81 / low).abs() < MOVED);
    }

    #[test]
    fn block_on_the_ground_is_hit_from_above() {
        // a hammer falls on the block, which rests
        let mut b = Build::new();
        let [y, v] = b.coordinate("y", "m", Start::Given(0.0), Start::Given(0.0));
        let [z, w] = b.coordinate("z", "m", Start::Given(1.0), Start::Given(0.0));
        let (v2, w2) = (b.square(v), b.square(w));
        let (t1, t2) = (b.times(0.5 * 3.0, v2), b.times(0.5 * 1.0, w2));
        let t = b.add(&[t1, t2]);
        let p = b.times(9.81, z);
        b.lagrange(t, p, &[]);
        b.contact("ground", y, 0.5);
        let gap = b.sub(z, y);
        b.contact("hammer", gap, 0.5);
        let (switches, x) = follow(&b, 0.7);
        let fall = (2.0_f64 / 9.81).sqrt();
        // in sequence, u the speed of the fall, e = 1/2: hammer and block leave with u/8 and -3u/8; the ground turns the block round, 3u/16; it closes on the
        // hammer with u/16, which gives it e u/16 and takes 1.5 u/64 from the block
        let speed = 9.81 * fall;
        let rates: Vec<[f64; 2]> =
            (switches.iter().filter(|s| (s.t - fall).abs() < ROUNDING))
                .map(|s| {
                    if let analysis::integrate::crossings::Change::Impact { rates, .. } = s.change { rates } else { panic!("{switches:?}") }
                })
                .collect();
        let wanted = [[0.0, 3.0 / 16.0 - 1.5 / 64.0], [-1.0, 1.0 / 32.0]];
        for (rates, wanted) in rates.iter().flatten().zip(wanted.iter().flatten()) {
            assert!((rates - wanted * speed).abs() < MOVED, "{switches:?}");
        }
        assert_eq!(rates.len(), 2);
        assert!(x[0] > 0.0);
    }

    /// Free flight of a load on a slack rope: x and y are polynomials of time, the slack is none.
    #[test]
    fn rope_catches_a_load_thrown_sideways() {
        let mut b = Build::new();
        let [x, _] = b.coordinate("x", "m", Start::Given(0.2), Start::Given(0.5));
        let [y, _] = b.coordinate("y", "m", Start::Given(-0.3), Start::Given(1.0));
        let t = kinetic_energy(&mut b, 1.5, [x, y]);
        let p = b.times(1.5 * 9.81, y);
        b.lagrange(t, p, &[]);
        let (xx, yy, one) = (b.square(x), b.square(y), b.number(1.0));
        let sum = b.add(&[xx, yy]);
        let distance = b.e.graph.sqrt(sum);
        let gap = b.sub(one, distance);
        b.contact("rope", gap, 0.0);
        let (switches, state) = follow(&b, 5.0);
        // 0.2 + t/2, -0.3 + t - 4.905 t²: distance 1
        let place = |t: f64| (0.2 + 0.5 * t, -0.3 + t - 4.905 * t * t);
        let (mut low, mut high) = (0.3, 1.0);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            let (x, y) = place(middle);
            if x.hypot(y) < 1.0 { low = middle } else { high = middle }
        }
        assert!((switches[0].t - low).abs() < INSTANT, "{} {low}", switches[0].t);
        // the radial speed is lost at once; the pendulum swings on with what is left
        let (x, y) = place(low);
        let (vx, vy) = (0.5, 1.0 - 9.81 * low);
        let along = (x * vy - y * vx) / x.hypot(y);
        let energy = 0.5 * along * along + 9.81 * y;
        let now = 0.5 * (state[2].powi(2) + state[3].powi(2)) + 9.81 * state[1];
        assert!((energy - now).abs() < LASTING, "{energy} {now} {switches:?}");
    }

    /// Load on a thread of length 1.
    #[test]
    fn thrown_load_on_a_thread_goes_slack_at_once_and_is_caught() {
        let mut b = Build::new();
        let [y, v] = b.coordinate("y", "m", Start::Given(-1.0), Start::Given(3.0));
        let square = b.square(v);
        let t = b.times(0.5 * 4.0, square);
        let p = b.times(4.0 * 9.81, y);
        b.lagrange(t, p, &[]);
        let one = b.number(1.0);
        let gap = b.add(&[one, y]);
        b.contact("rope", gap, 0.0);
        let (switches, x) = follow(&b, 2.0);
        assert_eq!(switches.len(), 1);
        assert!((switches[0].t - 6.0 / 9.81).abs() < ROUNDING);
        assert_eq!(x, vec![-1.0, 0.0]);
    }
}
