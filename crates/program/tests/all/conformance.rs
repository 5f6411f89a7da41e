//! Every back-end against the interpreter on one corpus of random systems.

use crate::common;
use common::mechanisms::{connection, friction};
use common::*;
use program::{ABREAST, Abreast, Bound, Construct, Evaluator, Lanes, Mode, Places, Point, lower};
use proptest::prelude::*;
use std::sync::Arc;
use symbolic::connections::Normal;
use symbolic::{Equations, Expr, Function, Graph, Matrix};

/// Random systems with conditions up to a thousand: rounding of some hundred operations.
const RANDOM: f64 = 1e-11;
/// The same through series, whose terms grow before they fall.
const SERIES: f64 = 1e-10;

/// Smooth random formulas: a list of steps over a growing stack of expressions.
fn grow(g: &mut Graph, stack: &mut Vec<Expr>, steps: &[(u8, usize, usize)]) -> Expr {
    for (kind, i, j) in steps {
        let (a, b) = (stack[i % stack.len()], stack[j % stack.len()]);
        let bounded = g.call(Function::Sin, &[a]);
        let three = g.int(3);
        let positive = g.add(three, bounded);
        let small = g.scale(bounded, &ratio(1, 3));
        stack.push(match kind % 19 {
            0 => g.add(a, b),
            1 => g.mul(a, bounded),
            2 => g.div(b, positive),
            3 => g.sqrt(positive),
            4 => g.pow(positive, &ratio(-5, 3)),
            5 => g.call(Function::Cos, &[a]),
            6 => g.call(Function::Exp, &[bounded]),
            7 => g.call(Function::Log, &[positive]),
            8 => g.call(Function::Asin, &[small]),
            9 => g.call(Function::Acos, &[small]),
            10 => g.call(Function::Atan, &[a]),
            11 => g.call(Function::Atan2, &[bounded, positive]),
            12 => g.call(Function::Tanh, &[a]),
            13 => g.call(Function::Sinh, &[bounded]),
            14 => g.call(Function::Tan, &[small]),
            15 => g.call(Function::Asinh, &[a]),
            16 => g.call(Function::Acosh, &[positive]),
            17 => g.call(Function::Atanh, &[small]),
            _ => g.square(bounded),
        });
    }
    stack[stack.len() - 1]
}

/// Two coordinates with a full, changing mass matrix, and one auxiliary state.
fn system(steps: &[(u8, usize, usize)]) -> Bound {
    let mut e = empty(Graph::new());
    plain(&mut e, steps);
    let program = Arc::new(lower::equations(&e).unwrap());
    Bound::new(&program, &[0.7]).unwrap()
}

/// Leaves and formulas of the system.
fn plain(e: &mut Equations, steps: &[(u8, usize, usize)]) -> Vec<Expr> {
    let p = parameter(e, "p", 0.7);
    let (x, u) = coordinate(e, "x");
    let (y, v) = coordinate(e, "y");
    let s = {
        let id = e.graph.symbol_id("s", 0);
        e.graph.symbol(id)
    };
    let t = e.graph.symbol(e.time);
    let mut stack = vec![p, t, x, y, u, v, s];
    let third = steps.len() / 3;
    let f = grow(&mut e.graph, &mut stack, &steps[..third]);
    let h = grow(&mut e.graph, &mut stack, &steps[third..2 * third]);
    let r = grow(&mut e.graph, &mut stack, &steps[2 * third..]);
    let g = &mut e.graph;
    let off = g.call(Function::Cos, &[y]);
    let (three, last) = (g.int(3), g.int(2));
    let bounded = g.call(Function::Sin, &[x]);
    let first = g.add(three, bounded);
    e.mass = Matrix::from_rows(&[vec![first, off], vec![off, last]]);
    e.force = vec![f, h];
    auxiliary(e, "s", r);
    stack
}

/// The same on a curved rail, whose force presses a friction that acts on one coordinate. Outputs are what must vanish: the condition of the rail,
/// the condition of the friction, the laws of its slip back and forth with a positive normal force, and the last with a negative one.
fn connected(steps: &[(u8, usize, usize)]) -> (Bound, usize) {
    let mut e = empty(Graph::new());
    let stack = plain(&mut e, steps);
    let pick = |k: usize| stack[stack.len() - 1 - k % stack.len()];
    let g = &mut e.graph;
    let bounded = |g: &mut Graph, a: Expr| g.call(Function::Sin, &[a]);
    let [a, b, c] = [0, 1, 2].map(|k| bounded(g, pick(k)));
    let (two, half) = (g.int(2), ratio(1, 2));
    let [kinetic, fixed, factor] = [a, b, c].map(|v| g.linear(ratio(2, 1), &[(v, half.clone())]));
    // place = 2 x + sin(...)/4 over coordinates; sliding = y' + x'/4
    let (x, y) = (stack[2], stack[3]);
    let (u, v) = (stack[4], stack[5]);
    let wave = g.mul(x, y);
    let wave = bounded(g, wave);
    let double = g.mul(two, x);
    let wave = g.scale(wave, &ratio(1, 4));
    let place = g.add(double, wave);
    let quarter = g.scale(u, &ratio(1, 4));
    let sliding = g.add(v, quarter);
    let rail = connection(&mut e, "rail", place, 1);
    let normal = Normal { constant: a, terms: vec![(rail, factor)] };
    let rubbing = friction(&mut e, "rail", sliding, ([kinetic, fixed], fixed), Some(normal));
    for (i, c) in e.conditions.clone().iter().enumerate() {
        let mut terms = vec![c.remainder];
        for (j, entry) in &c.columns {
            let acceleration = e.graph.symbol(e.coordinates[*j].symbols[2]);
            terms.push(e.graph.mul(*entry, acceleration));
        }
        let residual = e.graph.sum(&terms);
        output(&mut e, &format!("condition {i}"), residual);
    }
    let [n, f] = [rail, rubbing].map(|r| e.graph.symbol(e.reactions[r].symbol));
    let pressure = e.graph.mul(factor, n);
    let pressure = e.graph.add(a, pressure);
    for (name, kinetic, sign) in [("back", kinetic, -1), ("forth", fixed, 1), ("lifted back", kinetic, 1), ("lifted forth", fixed, -1)] {
        let law = e.graph.product(&[kinetic, pressure]);
        let law = e.graph.scale(law, &ratio(sign, 1));
        let residual = e.graph.sub(f, law);
        output(&mut e, name, residual);
    }
    let program = Arc::new(lower::equations(&e).unwrap());
    let sliding = program.guards.iter().position(|g| matches!(g.kind, Construct::Sliding { .. })).unwrap();
    (Bound::new(&program, &[0.7]).unwrap(), sliding)
}

/// What must vanish in these modes, at the solution of the interpreter.
fn residuals(bound: &mut Bound, t: f64, x: &[f64], modes: &[Mode], sliding: usize) -> Option<Vec<f64>> {
    let program = bound.program().clone();
    let rates = bound.rates(t, x, modes).ok()?.to_vec();
    let accelerations: Vec<f64> = rates[2..4].iter().chain(&rates[5..]).copied().collect();
    let mut forces = bound.evaluator(&program.forces).unwrap();
    assert_eq!(forces.evaluate(&Point { time: t, states: x, modes: Some(modes), ..Point::default() }).unwrap(), accelerations);
    let point = Point { time: t, states: x, accelerations: &accelerations, ..Point::default() };
    let mut second = bound.evaluator(&program.second).unwrap();
    let mut values = second.evaluate(&point).ok()?.to_vec();
    let mut outputs = bound.evaluator(&program.outputs).unwrap();
    let laws = outputs.evaluate(&Point { modes: Some(modes), ..point }).ok()?;
    let lifted = modes[sliding + 3] == Mode::Negative;
    values.push(laws[0]);
    values.push(match (modes[sliding], lifted) {
        (Mode::Zero, _) => laws[1],
        (Mode::Negative, false) => laws[2],
        (Mode::Positive, false) => laws[3],
        (Mode::Negative, true) => laws[4],
        (Mode::Positive, true) => laws[5],
    });
    Some(values)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    /// Motion and reactions by the general system satisfy the equations that it was made of, in every combination of modes; series and the
    /// specialised tape follow it. The friction may resonate with its own normal force (a factor near -1): such systems are left out.
    #[test]
    fn connected_systems_satisfy_their_equations(
        steps in proptest::collection::vec((any::<u8>(), 0usize..50, 0usize..50), 3..24),
        x in proptest::array::uniform5(-1.5f64..1.5),
        slide in 0usize..3,
        lifted in any::<bool>(),
    ) {
        let (mut bound, sliding) = connected(&steps);
        let mut modes = vec![Mode::Positive; bound.program().guards.len()];
        modes[sliding] = [Mode::Negative, Mode::Zero, Mode::Positive][slide];
        modes[sliding + 3] = if lifted { Mode::Negative } else { Mode::Positive };
        let t = 0.3;
        let Some(zeros) = residuals(&mut bound, t, &x, &modes, sliding) else { return Ok(()) };
        let rates = bound.rates(t, &x, &modes).unwrap().to_vec();
        let size = rates.iter().fold(1.0, |m: f64, v| m.max(v.abs()));
        prop_assume!(size < 1e4);
        prop_assert!(zeros.iter().all(|z| z.abs() < RANDOM * size), "{:?}", zeros);
        let order = 20;
        let mut jets = bound.jets(order);
        jets.expand(t, &x, &modes, order).unwrap();
        for i in 0..5 {
            prop_assert_eq!((jets.state(i)[0], jets.state(i)[1]), (x[i], rates[i]));
        }
        prop_assert_eq!([jets.reaction(0)[0], jets.reaction(1)[0]], [rates[5], rates[6]]);
        let mut special = bound.specialised().unwrap();
        for (have, want) in special.rates(t, &x, &modes).unwrap().iter().zip(&rates) {
            prop_assert!((have - want).abs() <= SERIES * size);
        }
        let rows = (0..5).map(|i| jets.state(i)).chain((0..2).map(|i| jets.reaction(i)));
        let radius = rows
            .flat_map(|row| row.iter().enumerate().skip(2).map(|(k, c)| c.abs().max(1e-300).powf(-1.0 / k as f64)).collect::<Vec<_>>())
            .fold(1.0, f64::min);
        let h = radius / 8.0;
        let moved: Vec<f64> = (0..5).map(|i| horner(jets.state(i), h)).collect();
        let direct = bound.rates(t + h, &moved, &modes).unwrap().to_vec();
        let scale = direct.iter().fold(size, |m: f64, v| m.max(v.abs()));
        for i in 0..2 {
            let force = horner(jets.reaction(i), h);
            prop_assert!((force - direct[5 + i]).abs() < SERIES * scale, "{}: {} against {}", i, force, direct[5 + i]);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    /// Orders 0 and 1 are the same operations, hence the same bits. The sum of the series a little later satisfies x' = f there; the
    /// bound is rounding of the terms plus the first neglected one, estimated by the last kept.
    #[test]
    fn jets_conform_to_the_interpreter(
        steps in proptest::collection::vec((any::<u8>(), 0usize..50, 0usize..50), 3..24),
        x in proptest::array::uniform5(-1.5f64..1.5),
    ) {
        let mut bound = system(&steps);
        let order = 20;
        let mut jets = bound.jets(order);
        let Ok(rates) = bound.rates(0.3, &x, &[]).map(<[f64]>::to_vec) else { return Ok(()) };
        jets.expand(0.3, &x, &[], order).unwrap();
        for i in 0..5 {
            prop_assert_eq!((jets.state(i)[0], jets.state(i)[1]), (x[i], rates[i]));
        }
        // a step at which the terms fall at least like 1/8^k
        let radius = (0..5)
            .flat_map(|i| (2..=order).map(move |k| (i, k)))
            .map(|(i, k)| jets.state(i)[k].abs().max(1e-300).powf(-1.0 / k as f64))
            .fold(1.0, f64::min);
        let h = radius / 8.0;
        let moved: Vec<f64> = (0..5).map(|i| horner(jets.state(i), h)).collect();
        let direct = bound.rates(0.3 + h, &moved, &[]).unwrap();
        for (i, direct) in direct.iter().enumerate() {
            let slopes: Vec<f64> = (1..=order).map(|k| k as f64 * jets.state(i)[k]).collect();
            let slope = horner(&slopes, h);
            let scale = slopes.iter().zip(0..).map(|(c, k)| (c * h.powi(k)).abs()).fold(1.0, f64::max);
            prop_assert!((slope - direct).abs() < RANDOM * scale, "{}: {} against {}", i, slope, direct);
        }
    }
}

/// Outputs of the system, one of them with a switch.
fn observed(steps: &[(u8, usize, usize)]) -> (Bound, Evaluator) {
    let mut e = empty(Graph::new());
    let mut stack = plain(&mut e, steps);
    let last = grow(&mut e.graph, &mut stack, &steps[..1]);
    let folded = e.graph.call(Function::Abs, &[last]);
    for (i, formula) in stack.iter().chain([&folded]).enumerate() {
        output(&mut e, &format!("f{i}"), *formula);
    }
    let program = Arc::new(lower::equations(&e).unwrap());
    let bound = Bound::new(&program, &[0.7]).unwrap();
    let outputs = bound.evaluator(&bound.program().outputs).unwrap();
    (bound, outputs)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    /// Several points at once against one after the other: the same operations, hence the same bits. Where one point has no value, nothing is told.
    #[test]
    fn points_abreast_have_the_bits_of_single_ones(
        steps in proptest::collection::vec((any::<u8>(), 0usize..50, 0usize..50), 3..24),
        states in proptest::collection::vec(proptest::array::uniform5(-1.5f64..1.5), 1..=ABREAST),
        side in 0usize..3,
        holds in any::<bool>(),
    ) {
        // roots and powers go point by point
        let steps: Vec<_> = steps.into_iter().map(|(kind, i, j)| (if matches!(kind % 19, 3 | 4) { 0 } else { kind }, i, j)).collect();
        let (bound, mut single) = observed(&steps);
        let mut abreast = Abreast::new(&single).unwrap();
        let modes = vec![[Mode::Negative, Mode::Zero, Mode::Positive][side]; bound.program().guards.len()];
        let active = vec![holds; modes.len()];
        let count = states.len();
        let lanes = |of: &dyn Fn(usize) -> f64| -> Lanes { std::array::from_fn(|lane| of(lane.min(count - 1))) };
        let times = lanes(&|lane| 0.1 * lane as f64);
        let by_state: Vec<Lanes> = (0..5).map(|i| lanes(&|lane| states[lane][i])).collect();
        let places = Places { count, times: &times, states: &by_state, accelerations: &[[0.5; ABREAST]; 2], modes: &modes, active: &active };
        let known = abreast.evaluate(&places);
        for (lane, x) in states.iter().enumerate() {
            let point = Point { time: times[lane], states: x, accelerations: &[0.5; 2], modes: Some(&modes), active: Some(&active) };
            let Ok(values) = single.evaluate(&point) else {
                prop_assert!(!known);
                return Ok(());
            };
            for (i, value) in values.iter().enumerate().filter(|_| known) {
                prop_assert_eq!(value.to_bits(), abreast.root(i)[lane].to_bits());
            }
        }
        prop_assert!(known);
    }
}

#[test]
fn what_depends_on_points_before_goes_point_by_point() {
    // 3: a square root
    let (_, single) = observed(&[(3, 1, 1), (0, 0, 0), (0, 0, 0)]);
    assert!(Abreast::new(&single).is_none());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    /// The specialised tape against the tape it came from: equal up to the rounding of constants added in another order.
    #[test]
    fn specialised_tape_conforms_to_its_origin(
        steps in proptest::collection::vec((any::<u8>(), 0usize..50, 0usize..50), 3..24),
        x in proptest::array::uniform5(-1.5f64..1.5),
        p in prop_oneof![Just(0.0), Just(1.0), -2.0f64..2.0],
    ) {
        let general = system(&steps);
        let mut bound = Bound::new(general.program(), &[p]).unwrap();
        let mut special = bound.specialised().unwrap();
        program::verify(&special.program().dynamics).unwrap();
        prop_assert!(special.program().dynamics.body.len() <= bound.program().dynamics.body.len());
        prop_assert!(special.program().dynamics.instructions().all(|i| !matches!(i.operation, program::Operation::Parameter(_))));
        let Ok(want) = bound.rates(0.3, &x, &[]).map(<[f64]>::to_vec) else { return Ok(()) };
        let have = special.rates(0.3, &x, &[]).unwrap();
        let size = want.iter().fold(1.0, |m: f64, v| m.max(v.abs()));
        for (have, want) in have.iter().zip(&want) {
            // a few hundred operations, amplified by products of sums
            prop_assert!((have - want).abs() <= RANDOM * size, "{} against {}", have, want);
        }
    }
}
