//! Every back-end against the interpreter on one corpus of random systems.

mod common;
use common::*;
use program::{Bound, lower};
use proptest::prelude::*;
use std::sync::Arc;
use symbolic::{Expr, Function, Graph, Matrix};

/// Smooth random formulas: a list of steps over a growing stack of expressions.
fn grow(g: &mut Graph, stack: &mut Vec<Expr>, steps: &[(u8, usize, usize)]) -> Expr {
    for (kind, i, j) in steps {
        let (a, b) = (stack[i % stack.len()], stack[j % stack.len()]);
        let bounded = g.call(Function::Sin, &[a]);
        let three = g.int(3);
        let positive = g.add(three, bounded);
        let small = g.scale(bounded, &ratio(1, 3));
        stack.push(match kind % 16 {
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
            _ => g.square(bounded),
        });
    }
    stack[stack.len() - 1]
}

/// Two coordinates with a full, changing mass matrix, and one auxiliary state.
fn system(steps: &[(u8, usize, usize)]) -> Bound {
    let mut e = empty(Graph::new());
    let p = parameter(&mut e, "p", 0.7);
    let (x, u) = coordinate(&mut e, "x");
    let (y, v) = coordinate(&mut e, "y");
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
    auxiliary(&mut e, "s", r);
    let program = Arc::new(lower::equations(&e).unwrap());
    Bound::new(&program, &[0.7]).unwrap()
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
            prop_assert!((slope - direct).abs() < 1e-11 * scale, "{}: {} against {}", i, slope, direct);
        }
    }
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
            prop_assert!((have - want).abs() <= 1e-11 * size, "{} against {}", have, want);
        }
    }
}
