//! Motion and reactions together, against closed forms.

use crate::common;
use common::mechanisms::*;
use common::*;
use program::lower::{Selection, equations_with};
use program::{Bound, Construct, Evaluator, Mode, Operation, Point, Program, lower, text};
use std::sync::Arc;
use symbolic::connections::{Law, Normal};
use symbolic::{Equations, Function, Graph};

/// Closed forms of a dozen operations on numbers about 1 to 10: units of the last place.
const ROUNDING: f64 = 1e-15;
/// Elimination in a system of a few rows: rounding times the growth of its entries.
const ELIMINATED: f64 = 1e-14;
/// A textbook equation whose terms, up to some forty, cancel: their rounding.
const CANCELLED: f64 = 1e-13;
/// Systems of dozens of rows and series of dozens of terms: rounding of some thousand operations, relative to the largest.
const SUMMED: f64 = 1e-12;

fn bind(e: &Equations) -> Bound {
    let program = Arc::new(lower::equations(e).unwrap());
    let values = program.values.clone();
    Bound::new(&program, &values).unwrap()
}

fn number(program: &Program, wanted: impl Fn(Construct) -> bool) -> usize {
    program.guards.iter().position(|g| wanted(g.kind)).unwrap()
}

fn close(have: &[f64], want: &[f64], tolerance: f64) {
    assert_eq!(have.len(), want.len());
    for (h, w) in have.iter().zip(want) {
        assert!((h - w).abs() <= tolerance * w.abs().max(1.0), "{have:?} against {want:?}");
    }
}

/// T = m v²/l + m g cos φ, accelerations from φ'' = -g/l sin φ.
#[test]
fn rod_of_a_pendulum_pulls_as_the_angle_formulation_says() {
    let mut bound = bind(&cartesian_pendulum());
    let (m, g, l) = (0.7, 9.81, 0.6);
    for (a, w) in [(0.3, 1.1), (2.5, -4.0), (-1.2, 0.0), (std::f64::consts::FRAC_PI_2, 2.0)] {
        let (s, c) = f64::sin_cos(a);
        let x = [l * s, -l * c, l * w * c, l * w * s];
        let turn = -g / l * s;
        let want = [x[2], x[3], l * (turn * c - w * w * s), l * (turn * s + w * w * c), m * l * w * w + m * g * c];
        close(bound.rates(0.0, &x, &[]).unwrap(), &want, ELIMINATED);
    }
}

/// Chains of rods against the same chains in angles: accelerations, and the last tension from the last point alone.
#[test]
fn chains_of_rods_move_as_chains_in_angles() {
    for n in [1, 2, 3, 5, 8] {
        let (mut rods, mut angles) = (bind(&rod_chain(n)), bind(&pendulum_chain(n)));
        let states: Vec<f64> = (0..2 * n).map(|i| (1.3 * i as f64 + 0.4).sin() * if i < n { 2.0 } else { 3.0 }).collect();
        let rates = angles.rates(0.0, &states, &[]).unwrap();
        let (mut places, mut speeds, mut wanted) = (Vec::new(), Vec::new(), Vec::new());
        let (mut at, mut v, mut w) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        for i in 0..n {
            let l = 0.5 + i as f64 * 0.003;
            let (s, c) = states[i].sin_cos();
            let (turn, change) = (states[n + i], rates[n + i]);
            for (k, (along, across)) in [(s, c), (-c, s)].into_iter().enumerate() {
                at[k] += l * along;
                v[k] += l * turn * across;
                w[k] += l * (change * across - turn * turn * along);
            }
            places.extend(at);
            speeds.extend(v);
            wanted.extend(w);
        }
        let (s, c) = states[n - 1].sin_cos();
        let (ax, ay) = (wanted[2 * n - 2], wanted[2 * n - 1]);
        // m a = weight + T towards the point before, (-sin, cos)
        let tension = (1.0 + (n - 1) as f64 * 0.01) * (-ax * s + (ay + 9.81) * c);
        let have = rods.rates(0.0, &[places, speeds].concat(), &[]).unwrap();
        let size = wanted.iter().fold(1.0, |m: f64, a| m.max(a.abs()));
        close(&have[2 * n..4 * n], &wanted, SUMMED * size);
        close(&have[5 * n - 1..], &[tension], SUMMED * size);
    }
}

/// A rod whose ends meet has no direction: the division is told, not a singular system.
#[test]
fn lost_direction_of_a_rod_is_a_division_by_zero() {
    let mut bound = bind(&cartesian_pendulum());
    assert_eq!(bound.rates(0.0, &[0.0; 4], &[]).unwrap_err().code, "P001");
    assert_eq!(bound.jets(5).expand(0.0, &[0.0; 4], &[], 5).unwrap_err().code, "P001");
}

#[test]
fn atwood_machine_moves_and_pulls_as_the_formula_says() {
    let mut bound = bind(&atwood(3.0, 2.0));
    let want = [0.5, -0.5, 9.81 / 5.0, -9.81 / 5.0, 2.0 * 6.0 * 9.81 / 5.0];
    close(bound.rates(0.0, &[1.0, 2.0, 0.5, -0.5], &[]).unwrap(), &want, ROUNDING);
    let rest = bind(&atwood(1.3, 1.3)).rates(0.0, &[1.0, 2.0, 0.0, 0.0], &[]).unwrap().to_vec();
    assert_eq!(rest, [0.0, 0.0, 0.0, 0.0, 1.3 * 9.81]);
}

/// The sum of the series a little later meets the equations there, reactions included, and the conditions still hold.
#[test]
fn series_of_a_slider_crank_meet_equations_and_conditions_later() {
    let e = slider_crank();
    for special in [false, true] {
        let mut bound = bind(&e);
        if special {
            bound = bound.specialised().unwrap();
        }
        let (order, h) = (30, 0.01);
        let mut jets = bound.jets(order);
        for (phi, w) in [(0.4, 8.0), (2.0, -15.0), (0.0, 3.0), (std::f64::consts::PI, 1.0)] {
            let x = slider_crank_state(phi, w);
            jets.expand(0.7, &x, &[], order).unwrap();
            let later: Vec<f64> = (0..6).map(|i| horner(jets.state(i), h)).collect();
            let direct = bound.rates(0.7 + h, &later, &[]).unwrap().to_vec();
            for (i, direct) in direct[..6].iter().enumerate() {
                let slopes: Vec<f64> = (1..=order).map(|k| k as f64 * jets.state(i)[k]).collect();
                assert!((horner(&slopes, h) - direct).abs() < SUMMED * direct.abs().max(1.0), "rate {i}");
            }
            for i in 0..2 {
                assert_eq!(jets.reaction(i).len(), order);
                let force = horner(jets.reaction(i), h);
                assert!((force - direct[6 + i]).abs() < SUMMED * direct[6 + i].abs().max(1.0), "{force} against {}", direct[6 + i]);
            }
            let mut conditions = bound.evaluator(&bound.program().connections).unwrap();
            let roots = bound.program().connection_roots();
            let values = conditions.evaluate(&Point { time: 0.7 + h, states: &later, ..Point::default() }).unwrap();
            assert!(values[roots.places].iter().all(|v| v.abs() < ROUNDING));
            // rates up to w r = 1.5 with a few hundred roundings
            assert!(values[roots.rates.clone()].iter().all(|v| v.abs() < CANCELLED), "{:?}", &values[roots.rates]);
        }
    }
}

/// Eliminating psi and x by hand: J phi'' and all other inertia forces do the power of the torque.
#[test]
fn reactions_of_a_slider_crank_satisfy_each_body() {
    let e = slider_crank();
    let mut bound = bind(&e);
    let x = slider_crank_state(1.1, 7.0);
    let t = 0.7;
    let rates = bound.rates(t, &x, &[]).unwrap().to_vec();
    let [_, _, _, eps, turn, along, up, axial] = rates[..] else { panic!() };
    // crank: J ε = M sin t - ω + r cos φ Y - r sin φ X;  rod: about the slider pin; slider and rod along x
    let (sf, cf) = x[0].sin_cos();
    let (sp, cp) = x[1].sin_cos();
    close(&[0.02 * eps], &[2.0 * f64::sin(t) - x[3] + 0.1 * cf * up - 0.1 * sf * axial], CANCELLED);
    let half = 0.175;
    close(&[(0.004 + 0.8 * half * half) * turn + 0.8 * half * sp * along], &[-0.35 * cp * up - 0.35 * sp * axial], CANCELLED);
    close(&[2.1 * along + 0.8 * half * sp * turn], &[-0.8 * half * cp * x[4] * x[4] - 40.0 * x[2] - axial], CANCELLED);
    // conditions twice differentiated
    close(&[0.1 * (cf * eps - sf * x[3] * x[3])], &[0.35 * (cp * turn - sp * x[4] * x[4])], CANCELLED);
}

#[test]
fn block_below_the_limit_of_friction_does_not_move_at_any_order() {
    let mut bound = bind(&block()).specialised().unwrap();
    let program = bound.program().clone();
    let weight = 1.7 * 9.81 * f64::sin(0.3);
    let sliding = number(&program, |k| matches!(k, Construct::Sliding { .. }));
    let Construct::Sliding { reaction: 0, limits } = program.guards[sliding].kind else { panic!() };
    let mut modes = bound.modes(0.0, &[0.2, 0.0]).unwrap();
    assert_eq!(modes[sliding], Mode::Zero);
    let mut jets = bound.jets(12);
    jets.expand(0.0, &[0.2, 0.0], &modes, 12).unwrap();
    assert!(jets.state(0)[1..].iter().chain(jets.state(1)).all(|c| *c == 0.0));
    close(&[jets.reaction(0)[0]], &[weight], ROUNDING);
    close(&[jets.guard(limits[0])[0], jets.guard(limits[1])[0]], &[6.0 + weight, 6.0 - weight], ROUNDING);
    assert!(bound.active(&modes).iter().all(|a| *a));
    // sliding: the limits count no longer, the force is kinetic
    for (mode, s) in [(Mode::Positive, 1.0), (Mode::Negative, -1.0)] {
        modes[sliding] = mode;
        let active = bound.active(&modes);
        assert!(active[sliding] && !active[limits[0]] && !active[limits[1]]);
        let rates = bound.rates(0.0, &[0.2, s], &modes).unwrap();
        close(rates, &[s, (weight - s * 4.0) / 1.7, s * 4.0], ROUNDING);
    }
    let exits = limits.map(|l| match program.guards[l].kind {
        Construct::Limit { exit, of, .. } if of == sliding => exit,
        other => panic!("{other:?}"),
    });
    assert_eq!(exits, [Mode::Negative, Mode::Positive]);
}

/// Two blocks tied to each other, the first one held: nothing moves, exactly, and the rope's force is what the second needs.
#[test]
fn held_parts_pass_their_rest_on_exactly() {
    let mut e = atwood(3.0, 2.0);
    let v = e.graph.symbol(e.coordinates[1].symbols[1]);
    let fifty = e.graph.int(50);
    friction(&mut e, "brake", v, ([fifty, fifty], fifty), None);
    let mut bound = bind(&e);
    let modes = bound.modes(0.0, &[1.0, 2.0, 0.0, 0.0]).unwrap();
    let rates = bound.rates(0.0, &[1.0, 2.0, 0.0, 0.0], &modes).unwrap();
    assert_eq!(rates[..4], [0.0; 4]);
    close(&rates[4..], &[3.0 * 9.81, -9.81], ROUNDING);
}

/// Two coordinates made to follow given motions by two motors, one of which acts on both: inverse dynamics.
#[test]
fn motors_give_what_prescribed_motions_need() {
    let mut e = empty(Graph::new());
    let (m, k) = (parameter(&mut e, "m", 2.0), parameter(&mut e, "k", 5.0));
    let ((x, _), (y, _)) = (coordinate(&mut e, "x"), coordinate(&mut e, "y"));
    masses(&mut e, &[m, k]);
    let spring = e.graph.product(&[k, x]);
    e.force = vec![e.graph.neg(spring), e.graph.zero()];
    let time = e.graph.symbol(e.time);
    let sine = e.graph.call(Function::Sin, &[time]);
    let square = e.graph.square(time);
    let (along, across) = (e.graph.sub(x, sine), e.graph.sub(y, square));
    condition(&mut e, "x", along);
    condition(&mut e, "y", across);
    let (one, minus) = (e.graph.one(), e.graph.int(-1));
    reaction(&mut e, "M_B", vec![(0, one), (1, minus)], Law::Motor);
    reaction(&mut e, "M_D", vec![(1, one)], Law::Motor);
    let bound = bind(&e);
    let t = 0.4_f64;
    let mut jets = bound.jets(6);
    jets.expand(t, &[t.sin(), t * t, t.cos(), 2.0 * t], &[], 6).unwrap();
    // M_B = m x'' + k x = (k - m) sin t; M_D = k y'' + M_B
    let fact = [1.0, 1.0, 2.0, 6.0, 24.0, 120.0];
    let sine = [t.sin(), t.cos(), -t.sin(), -t.cos(), t.sin(), t.cos()];
    for i in 0..6 {
        let first = 3.0 * sine[i] / fact[i];
        let rest = if i == 0 { 10.0 } else { 0.0 };
        close(&[jets.reaction(0)[i], jets.reaction(1)[i]], &[first, first + rest], 2.0 * ROUNDING);
    }
}

/// A block on a floor with coordinates x and y: the floor's force presses the friction. Above a pull of m g the floor must pull: |N| counts.
fn pressed(pull: f64) -> Equations {
    let mut e = empty(Graph::new());
    let values = [("m", 2.0), ("g", 10.0), ("mu", 0.3), ("mu_0", 0.4), ("P", pull), ("F", 5.0)];
    let [m, g, mu, mu_0, p, f] = values.map(|(name, v)| parameter(&mut e, name, v));
    let ((_, v), (y, _)) = (coordinate(&mut e, "x"), coordinate(&mut e, "y"));
    masses(&mut e, &[m, m]);
    let weight = e.graph.mul(m, g);
    e.force = vec![f, e.graph.sub(p, weight)];
    let floor = connection(&mut e, "floor", y, 1);
    let normal = Normal { constant: e.graph.zero(), terms: vec![(floor, e.graph.one())] };
    friction(&mut e, "floor", v, ([mu, mu], mu_0), Some(normal));
    e
}

#[test]
fn friction_follows_the_computed_normal_force_of_either_sign() {
    for (pull, normal) in [(3.0, 17.0), (30.0, -10.0), (20.0, 0.0)] {
        let e = pressed(pull);
        let mut bound = bind(&e);
        let program = bound.program().clone();
        let sliding = number(&program, |k| matches!(k, Construct::Sliding { .. }));
        let sign = number(&program, |k| matches!(k, Construct::Normal { .. }));
        for v in [1.0, -1.0, 0.0_f64] {
            let x = [0.0, 0.0, v, 0.0];
            let modes = bound.modes(0.0, &x).unwrap();
            assert_eq!((modes[sliding], modes[sign]), (Mode::of(v), Mode::of(normal)));
            assert!(bound.active(&modes)[sign]);
            let s = if v == 0.0 { 0.0 } else { v.signum() };
            let force = if v == 0.0 { 5.0 } else { s * 0.3 * normal.abs() };
            close(bound.rates(0.0, &x, &modes).unwrap(), &[v, 0.0, (5.0 - force) / 2.0, 0.0, normal, force], ROUNDING);
            let Construct::Sliding { limits, .. } = program.guards[sliding].kind else { panic!() };
            let mut jets = bound.jets(4);
            jets.expand(0.0, &x, &modes, 4).unwrap();
            assert_eq!(jets.guard(sign)[0], normal);
            if v == 0.0 {
                close(&[jets.guard(limits[1])[0]], &[0.4 * normal.abs() - 5.0], ROUNDING);
            }
        }
    }
}

/// The same with y no coordinate: the floor is a support, its force follows from a balance, and the friction joins both.
#[test]
fn friction_pressed_by_a_support_joins_the_balances() {
    let mut e = empty(Graph::new());
    let values = [("m", 2.0), ("g", 10.0), ("mu", 0.3)];
    let [m, g, mu] = values.map(|(name, v)| parameter(&mut e, name, v));
    let (_, v) = coordinate(&mut e, "x");
    masses(&mut e, &[m]);
    e.force = vec![e.graph.zero()];
    let floor = reaction(&mut e, "force_y(floor)", vec![], Law::Support);
    let wall = reaction(&mut e, "force_z(floor)", vec![], Law::Support);
    let one = e.graph.one();
    let normal = Normal { constant: e.graph.zero(), terms: vec![(floor, one)] };
    friction(&mut e, "floor", v, ([mu, mu], mu), Some(normal));
    let weight = e.graph.mul(m, g);
    let rest = e.graph.neg(weight);
    let (half, zero) = (e.graph.number(ratio(1, 2)), e.graph.zero());
    balance(&mut e, "block, along y", vec![], rest, &[(floor, one), (wall, half)]);
    balance(&mut e, "block, along z", vec![(0, m)], zero, &[(wall, one)]);
    let mut bound = bind(&e);
    assert_eq!(bound.program().solved, [0, 1, 2]);
    let modes = bound.modes(0.0, &[0.0, 1.0]).unwrap();
    // m a = -μ N, Z = m a, N = m g - Z/2 = m g + μ N/2
    let normal = 20.0 / (1.0 - 0.15);
    let push = -0.3 * normal;
    close(bound.rates(0.0, &[0.0, 1.0], &modes).unwrap(), &[1.0, push / 2.0, normal, push, -push], ROUNDING);
    // the forces tape gives the same
    let mut forces = bound.evaluator(&bound.program().forces).unwrap();
    let have = forces.evaluate(&Point { states: &[0.0, 1.0], modes: Some(&modes), ..Point::default() }).unwrap();
    close(have, &[push / 2.0, normal, push, -push], ROUNDING);
}

#[test]
fn supports_follow_after_the_motion() {
    let mut e = block();
    let [m, g, a] = [0, 1, 2].map(|i| e.graph.symbol(e.parameters[i].symbol));
    let normal = reaction(&mut e, "force_y(plane)", vec![], Law::Support);
    let (cosine, one) = (e.graph.call(Function::Cos, &[a]), e.graph.one());
    let weight = e.graph.product(&[m, g, cosine]);
    let rest = e.graph.neg(weight);
    balance(&mut e, "block, across", vec![(0, m)], rest, &[(normal, one), (0, one)]);
    let symbol = e.graph.symbol(e.reactions[1].symbol);
    let double = e.graph.scale(symbol, &ratio(2, 1));
    output(&mut e, "twice", double);
    let mut bound = bind(&e);
    let program = bound.program().clone();
    assert_eq!((&program.solved[..], &program.known[..]), (&[0][..], &[0, 1][..]));
    let x = [0.0, 2.0];
    let modes = bound.modes(0.0, &x).unwrap();
    let mut forces = bound.evaluator(&program.forces).unwrap();
    let roots = forces.evaluate(&Point { states: &x, modes: Some(&modes), ..Point::default() }).unwrap().to_vec();
    let (weight, slope) = (1.7 * 9.81, (0.3_f64).sin());
    let acceleration = (weight * slope - 4.0) / 1.7;
    // N = m a + m g cos - F
    let want = [acceleration, 4.0, 1.7 * acceleration + weight * (0.3_f64).cos() - 4.0];
    close(&roots, &want, ELIMINATED);
    let mut accelerations = Vec::new();
    program.spread(&roots, &mut accelerations);
    let mut outputs = bound.evaluator(&program.outputs).unwrap();
    let point = Point { states: &x, accelerations: &accelerations, modes: Some(&modes), ..Point::default() };
    close(outputs.evaluate(&point).unwrap(), &[2.0 * want[2]], ELIMINATED);
    let mut second = bound.evaluator(&program.second).unwrap();
    let residuals = second.evaluate(&Point { modes: None, ..point }).unwrap();
    assert_eq!(residuals.len(), 2);
    assert!(residuals.iter().all(|r| r.abs() < CANCELLED));
}

#[test]
fn a_ball_falls_while_the_gap_is_open_and_rests_while_it_is_closed() {
    let mut e = empty(Graph::new());
    let (m, g) = (parameter(&mut e, "m", 2.0), parameter(&mut e, "g", 9.81));
    let (y, _) = coordinate(&mut e, "y");
    masses(&mut e, &[m]);
    let weight = e.graph.mul(m, g);
    e.force = vec![e.graph.neg(weight)];
    contact(&mut e, "floor", y);
    let mut bound = bind(&e);
    let program = bound.program().clone();
    let gap = number(&program, |k| matches!(k, Construct::Gap { .. }));
    let Construct::Gap { force, reaction: 0 } = program.guards[gap].kind else { panic!() };
    let open = bound.modes(0.0, &[1.0, 0.0]).unwrap();
    assert!(open[gap] == Mode::Positive && !bound.active(&open)[force]);
    assert_eq!(bound.rates(0.0, &[1.0, 0.5], &open).unwrap(), [0.5, -9.81, 0.0]);
    for y in [0.0, -1e-17] {
        let closed = bound.modes(0.0, &[y, 0.0]).unwrap();
        assert!(closed[gap] == Mode::Zero && bound.active(&closed)[force]);
        assert_eq!(bound.rates(0.0, &[0.0, 0.0], &closed).unwrap(), [0.0, 0.0, 2.0 * 9.81]);
        let mut jets = bound.jets(5);
        jets.expand(0.0, &[0.0, 0.0], &closed, 5).unwrap();
        assert_eq!(jets.guard(force), [2.0 * 9.81, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(jets.state(0), [0.0; 6]);
    }
    let roots = program.connection_roots();
    let mut connections = bound.evaluator(&program.connections).unwrap();
    let values = connections.evaluate(&Point { states: &[1.5, -3.0], ..Point::default() }).unwrap();
    assert_eq!((values.len(), roots.forces.end), (8, 8));
    assert_eq!(values, [1.5, -3.0, 1.0, 2.0, 1.5, 0.5, 0.5, 1.0]);
}

/// Two brakes on one block: they stick up to the sum of their limits, in shares, and slide each with its own force.
#[test]
fn frictions_of_one_speed_stick_and_slide_together() {
    for (fixed, load) in [([6.0, 2.0], 7.0), ([0.0, 0.0], 0.0), ([0.0, 9.0], -7.0)] {
        let mut e = empty(Graph::new());
        let [m, f, a, b, k] = [("m", 2.0), ("F", load), ("a", fixed[0]), ("b", fixed[1]), ("k", 1.5)].map(|(n, v)| parameter(&mut e, n, v));
        let (_, v) = coordinate(&mut e, "x");
        masses(&mut e, &[m]);
        e.force = vec![f];
        friction(&mut e, "first", v, ([k, k], a), None);
        friction(&mut e, "second", v, ([k, a], b), None);
        for special in [false, true] {
            let mut bound = bind(&e);
            if special {
                bound = bound.specialised().unwrap();
            }
            assert_eq!(bound.program().switches, [Some(0), Some(0)]);
            let Construct::Sliding { reaction: 0, limits } = bound.program().guards[0].kind else { panic!() };
            let modes = bound.modes(0.0, &[0.0, 0.0]).unwrap();
            assert_eq!(modes[0], Mode::Zero);
            let sum = fixed[0] + fixed[1];
            let share = if sum > 0.0 { fixed.map(|f| load * f / sum) } else { [load, 0.0] };
            close(bound.rates(0.0, &[0.0, 0.0], &modes).unwrap(), &[0.0, 0.0, share[0], share[1]], ROUNDING);
            let mut jets = bound.jets(2);
            jets.expand(0.0, &[0.0, 0.0], &modes, 2).unwrap();
            close(&limits.map(|l| jets.guard(l)[0]), &[sum + load, sum - load], ROUNDING);
            let modes = bound.modes(0.0, &[0.0, 1.0]).unwrap();
            close(bound.rates(0.0, &[0.0, 1.0], &modes).unwrap(), &[1.0, (load - 1.5 - fixed[0]) / 2.0, 1.5, fixed[0]], ROUNDING);
        }
    }
}

/// A drum with brake shoes at its rim and hub, one measured against the turn: v = ω, R ω, -r ω. All stick and slide as one torque would.
#[test]
fn brakes_of_different_radii_stick_and_slide_together() {
    let (inertia, torque, rim, hub) = (0.5, 2.2, 0.4, 0.1);
    let mut e = empty(Graph::new());
    let values = [("J", inertia), ("M", torque), ("R", rim), ("r", hub), ("T", 1.0), ("A", 3.0), ("B", 5.0), ("k", 0.5)];
    let [inertia, moment, big, small, own, a, b, k] = values.map(|(n, v)| parameter(&mut e, n, v));
    let (_, w) = coordinate(&mut e, "phi");
    masses(&mut e, &[inertia]);
    e.force = vec![moment];
    let (fast, slow) = (e.graph.mul(big, w), e.graph.mul(small, w));
    let back = e.graph.neg(slow);
    let (half_a, half_b) = (e.graph.mul(k, a), e.graph.mul(k, b));
    friction(&mut e, "bearing", w, ([own, own], own), None);
    friction(&mut e, "rim", fast, ([half_a, a], a), None);
    friction(&mut e, "hub", back, ([half_b, b], b), None);
    for special in [false, true] {
        let mut bound = bind(&e);
        if special {
            bound = bound.specialised().unwrap();
        }
        assert_eq!(bound.program().switches, [Some(0); 3]);
        let Construct::Sliding { limits, .. } = bound.program().guards[0].kind else { panic!() };
        let modes = bound.modes(0.0, &[0.0, 0.0]).unwrap();
        // capacity 1 + 0.4·3 + 0.1·5 = 2.7; each takes 2.2/2.7 of its limit, the hub's in its own direction
        let part = 2.2 / 2.7;
        close(bound.rates(0.0, &[0.0, 0.0], &modes).unwrap(), &[0.0, 0.0, part, 3.0 * part, -5.0 * part], ROUNDING);
        let mut jets = bound.jets(1);
        jets.expand(0.0, &[0.0, 0.0], &modes, 1).unwrap();
        close(&limits.map(|l| jets.guard(l)[0]), &[2.7 + 2.2, 2.7 - 2.2], ROUNDING);
        for (w, forces) in [(1.0, [1.0, 3.0, -2.5]), (-1.0, [-1.0, -1.5, 5.0])] {
            let modes = bound.modes(0.0, &[0.0, w]).unwrap();
            let turn = (2.2 - forces[0] - 0.4 * forces[1] + 0.1 * forces[2]) / 0.5;
            close(bound.rates(0.0, &[0.0, w], &modes).unwrap(), &[w, turn, forces[0], forces[1], forces[2]], ROUNDING);
        }
    }
}

/// Where the modes by value cannot hold together, each is still told.
#[test]
fn modes_are_known_where_the_reactions_are_not() {
    let mut e = atwood(1.0, 1.0);
    let fifty = e.graph.int(50);
    for i in 0..2 {
        let v = e.graph.symbol(e.coordinates[i].symbols[1]);
        friction(&mut e, &format!("brake {i}"), v, ([fifty, fifty], fifty), None);
    }
    let mut bound = bind(&e);
    let modes = bound.modes(0.0, &[1.0, 2.0, 0.0, 0.0]).unwrap();
    let sliding = |i: &usize| matches!(bound.program().guards[*i].kind, Construct::Sliding { .. });
    let stuck: Vec<Mode> = (0..modes.len()).filter(sliding).map(|i| modes[i]).collect();
    assert_eq!(stuck, [Mode::Zero, Mode::Zero]);
    assert_eq!(bound.rates(0.0, &[1.0, 2.0, 0.0, 0.0], &modes).unwrap_err().code, "P013");
}

/// A formula that switches on the sliding speed goes by the friction's own guard, with the sign of its own.
#[test]
fn formulas_share_the_guard_of_sliding() {
    let mut e = block();
    let v = e.graph.symbol(e.coordinates[0].symbols[1]);
    let minus = e.graph.scale(v, &ratio(-2, 1));
    let sign = e.graph.call(Function::Sign, &[minus]);
    e.force[0] = e.graph.add(e.force[0], sign);
    let mut bound = bind(&e);
    assert_eq!(bound.program().guards.len(), 3);
    let modes = bound.modes(0.0, &[0.0, 1.0]).unwrap();
    let rates = bound.rates(0.0, &[0.0, 1.0], &modes).unwrap();
    close(&rates[1..2], &[(1.7 * 9.81 * f64::sin(0.3) - 1.0 - 4.0) / 1.7], ROUNDING);
}

/// Two equal ropes: one is dropped, its force is no number, the motion is not affected.
#[test]
fn dropped_reaction_is_refused_where_it_is_asked_for() {
    let mut e = atwood(3.0, 2.0);
    let place = e.conditions[0].place.unwrap();
    connection(&mut e, "second", place, -1);
    let outputs = [0, 1].map(|i| e.graph.symbol(e.reactions[i].symbol));
    let x = e.graph.symbol(e.coordinates[0].symbols[2]);
    output(&mut e, "a", x);
    output(&mut e, "T_1", outputs[0]);
    output(&mut e, "T_2", outputs[1]);
    let bound = bind(&e);
    let fault = bound.jets(3).expand(0.0, &[1.0, 2.0, 0.0, 0.0], &[], 3).unwrap_err();
    let singular = fault.singular.unwrap();
    assert_eq!((fault.code, &bound.program().rows[singular.row].en[..]), ("P013", "second"));
    assert!(bound.program().unknowns[singular.unknown].starts_with("force("));
    let selection = Selection { conditions: vec![true, false], reactions: vec![true, false], balances: vec![], repeated: None };
    let program = Arc::new(equations_with(&e, &selection).unwrap());
    let mut forces = Evaluator::new(&program.forces, &program.values).unwrap();
    let roots = forces.evaluate(&Point { states: &[1.0, 2.0, 0.0, 0.0], ..Point::default() }).unwrap();
    let mut accelerations = Vec::new();
    program.spread(roots, &mut accelerations);
    close(&accelerations[..3], &[1.962, -1.962, 23.544], ROUNDING);
    assert!(accelerations[3].is_nan());
    let mut observed = Evaluator::new(&program.outputs, &program.values).unwrap();
    let fault = observed.evaluate(&Point { states: &[0.0; 4], accelerations: &accelerations, ..Point::default() }).unwrap_err();
    assert!(fault.code == "P014" && fault.what.en.contains("T_2"), "{fault}");
    let wrong = Selection { reactions: vec![true, true], ..selection };
    assert_eq!(equations_with(&e, &wrong).unwrap_err().code, "P012");
}

/// A pendulum whose point also runs in a horizontal guide at its lowest level: there both conditions say y'' = 0.
#[test]
fn singular_position_names_a_condition() {
    let mut e = cartesian_pendulum();
    let (y, l) = (e.graph.symbol(e.coordinates[1].symbols[0]), e.graph.symbol(e.parameters[2].symbol));
    let place = e.graph.add(y, l);
    connection(&mut e, "guide", place, 1);
    let mut bound = bind(&e);
    let x = [0.0, -0.6, 0.0, 0.0];
    let fault = bound.rates(0.0, &x, &[]).unwrap_err();
    let singular = fault.singular.unwrap();
    assert_eq!((fault.code, &bound.program().rows[singular.row].en[..]), ("P013", "guide"));
    assert_eq!(bound.program().unknowns[singular.unknown], "force(guide)");
    assert_eq!(bound.jets(4).expand(0.0, &x, &[], 4).unwrap_err().singular, Some(singular));
}

/// No coordinates: a beam on two supports.
#[test]
fn statics_without_coordinates_give_supports() {
    let mut e = empty(Graph::new());
    let p = parameter(&mut e, "P", 12.0);
    let supports = ["A", "B"].map(|name| reaction(&mut e, name, vec![], Law::Support));
    let (one, two) = (e.graph.one(), e.graph.int(2));
    let half = e.graph.scale(p, &ratio(-1, 2));
    let down = e.graph.neg(p);
    balance(&mut e, "up", vec![], down, &[(supports[0], one), (supports[1], one)]);
    balance(&mut e, "about A", vec![], half, &[(supports[1], two)]);
    let bound = bind(&e);
    let program = bound.program();
    let mut forces = bound.evaluator(&program.forces).unwrap();
    assert_eq!(forces.evaluate(&Point::default()).unwrap(), [9.0, 3.0]);
    assert_eq!(bound.dimension(), 0);
    bound.jets(3).expand(0.0, &[], &[], 3).unwrap();
    let mut balances = bound.evaluator(&program.balances).unwrap();
    assert_eq!(balances.evaluate(&Point::default()).unwrap(), [1.0, 1.0, 0.0, 2.0]);
}

#[test]
fn tapes_of_connected_machines_read_back() {
    for e in [pressed(3.0), slider_crank(), block(), atwood(1.0, 2.0)] {
        let p = lower::equations(&e).unwrap();
        for tape in [&p.dynamics, &p.forces, &p.outputs, &p.second, &p.connections, &p.balances] {
            program::verify(tape).unwrap();
            let again = text::parse(&tape.to_string()).unwrap();
            assert_eq!(again.to_string(), tape.to_string());
            assert_eq!(again.bounds, tape.bounds);
        }
        assert!(p.dynamics.body.iter().any(|i| matches!(i.operation, Operation::System { .. })));
        assert!(p.dynamics.census().contains(&("solve-general", 1)));
    }
}
