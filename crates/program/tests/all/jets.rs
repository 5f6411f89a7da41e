//! Taylor coefficients against closed forms and against the interpreter.

use crate::common;
use common::*;
use program::{Bound, Mode, lower};
use std::sync::Arc;
use symbolic::{Edge, Equations, Expr, Function, Graph};

/// A sum of a series against the function: units of the last place.
const SERIES: f64 = 4e-15;
/// A coefficient of high order in closed form: rounding of its recurrence.
const COEFFICIENT: f64 = 1e-14;
/// Slopes through a system of equations, relative to the largest.
const SOLVED: f64 = 1e-12;

fn bind(e: &Equations) -> Bound {
    let program = Arc::new(lower::equations(e).unwrap());
    let values = program.values.clone();
    Bound::new(&program, &values).unwrap()
}

/// Coefficients of f(t) about t0 for a formula of time, read off s' = f.
fn series(build: impl Fn(&mut Graph, Expr) -> Expr, t0: f64, order: usize) -> (Vec<f64>, Bound) {
    let mut e = empty(Graph::new());
    let t = e.graph.symbol(e.time);
    let f = build(&mut e.graph, t);
    auxiliary(&mut e, "s", f);
    let bound = bind(&e);
    let mut jets = bound.jets(order + 1);
    // an angle has guards; right of the origin and above it nothing is chosen
    let modes = vec![Mode::Positive; bound.program().guards.len()];
    jets.expand(t0, &[0.0], &modes, order + 1).unwrap();
    let f = (0..=order).map(|k| jets.state(0)[k + 1] * (k + 1) as f64).collect();
    (f, bound)
}

fn call(f: Function) -> impl Fn(&mut Graph, Expr) -> Expr {
    move |g, x| g.call(f, &[x])
}

#[test]
fn elementary_series_at_zero_have_their_textbook_coefficients() {
    let fact = |n: u32| (1..=n).map(f64::from).product::<f64>();
    let close = |got: &[f64], want: &dyn Fn(u32) -> f64| {
        for (k, g) in (0..).zip(got) {
            let w = want(k);
            assert!((g - w).abs() <= COEFFICIENT * w.abs().max(1e-16), "order {k}: {g} against {w}");
        }
    };
    close(&series(call(Function::Exp), 0.0, 20).0, &|k| 1.0 / fact(k));
    let sign = |k: u32| if k % 4 < 2 { 1.0 } else { -1.0 };
    close(&series(call(Function::Sin), 0.0, 20).0, &|k| if k % 2 == 1 { sign(k) / fact(k) } else { 0.0 });
    close(&series(call(Function::Cos), 0.0, 20).0, &|k| if k % 2 == 0 { sign(k) / fact(k) } else { 0.0 });
    close(&series(call(Function::Sinh), 0.0, 20).0, &|k| if k % 2 == 1 { 1.0 / fact(k) } else { 0.0 });
    close(&series(call(Function::Cosh), 0.0, 20).0, &|k| if k % 2 == 0 { 1.0 / fact(k) } else { 0.0 });
    close(&series(call(Function::Atan), 0.0, 20).0, &|k| if k % 2 == 1 { sign(k) / f64::from(k) } else { 0.0 });
    // log(1 + t), about t = 0 by expanding log at 1
    close(&series(call(Function::Log), 1.0, 20).0, &|k| match k {
        0 => 0.0,
        k => -(-1.0_f64).powi(k as i32) / f64::from(k),
    });
    // tan t = t + t³/3 + 2t⁵/15 + 17t⁷/315 + 62 t⁹/2835
    let tan = [0.0, 1.0, 0.0, 1.0 / 3.0, 0.0, 2.0 / 15.0, 0.0, 17.0 / 315.0, 0.0, 62.0 / 2835.0];
    close(&series(call(Function::Tan), 0.0, 9).0, &|k| tan[k as usize]);
    close(&series(call(Function::Tanh), 0.0, 9).0, &|k| sign(k) * tan[k as usize]);
    // asin t = Σ (2m)!/(4^m m!² (2m+1)) t^(2m+1)
    close(&series(call(Function::Asin), 0.0, 15).0, &|k| match k % 2 {
        0 => 0.0,
        _ => fact(k - 1) / (4.0_f64.powi(k as i32 / 2) * fact(k / 2).powi(2) * f64::from(k)),
    });
    // asinh t: the same with the signs of sin, atanh t = Σ t^(2m+1)/(2m+1)
    close(&series(call(Function::Asinh), 0.0, 15).0, &|k| match k % 2 {
        0 => 0.0,
        _ => sign(k) * fact(k - 1) / (4.0_f64.powi(k as i32 / 2) * fact(k / 2).powi(2) * f64::from(k)),
    });
    close(&series(call(Function::Atanh), 0.0, 20).0, &|k| if k % 2 == 1 { 1.0 / f64::from(k) } else { 0.0 });
    // (1 + t)^p has binomial coefficients
    for (n, d) in [(1, 2), (-1, 2), (7, 3), (-5, 3), (-3, 1), (4, 1), (5, 2)] {
        let p = n as f64 / d as f64;
        let got = series(|g, t| g.pow(t, &ratio(n, d)), 1.0, 20).0;
        close(&got, &|k| (0..k).map(|j| (p - f64::from(j)) / (f64::from(j) + 1.0)).product());
    }
}

type Formula = Box<dyn Fn(&mut Graph, Expr) -> Expr>;

/// The polynomial must reproduce f at t0 ± h; h^24 is below rounding only at the very end, so a wrong coefficient shows.
#[test]
fn compound_series_sum_to_the_direct_value() {
    let cases: Vec<(&str, Formula)> = vec![
        (
            "sin of a quadratic",
            Box::new(|g, t| {
                let s = g.square(t);
                g.call(Function::Sin, &[s])
            }),
        ),
        (
            "exp sin",
            Box::new(|g, t| {
                let s = g.call(Function::Sin, &[t]);
                g.call(Function::Exp, &[s])
            }),
        ),
        (
            "sinh cos",
            Box::new(|g, t| {
                let s = g.call(Function::Cos, &[t]);
                g.call(Function::Sinh, &[s])
            }),
        ),
        (
            "acos",
            Box::new(|g, t| {
                let s = g.call(Function::Sin, &[t]);
                let h = g.scale(s, &ratio(1, 3));
                g.call(Function::Acos, &[h])
            }),
        ),
        (
            "acosh",
            Box::new(|g, t| {
                let s = g.call(Function::Sin, &[t]);
                let three = g.int(3);
                let h = g.add(three, s);
                g.call(Function::Acosh, &[h])
            }),
        ),
        (
            "asin",
            Box::new(|g, t| {
                let s = g.call(Function::Cos, &[t]);
                let h = g.scale(s, &ratio(1, 3));
                g.call(Function::Asin, &[h])
            }),
        ),
        (
            "atan2",
            Box::new(|g, t| {
                let s = g.call(Function::Sin, &[t]);
                let e = g.call(Function::Exp, &[t]);
                g.call(Function::Atan2, &[e, s])
            }),
        ),
        (
            "tan of a quarter",
            Box::new(|g, t| {
                let h = g.scale(t, &ratio(1, 4));
                g.call(Function::Tan, &[h])
            }),
        ),
        (
            "tanh",
            Box::new(|g, t| {
                let h = g.scale(t, &ratio(1, 4));
                g.call(Function::Tanh, &[h])
            }),
        ),
        (
            "quotient",
            Box::new(|g, t| {
                let s = g.call(Function::Sin, &[t]);
                let three = g.int(3);
                let d = g.add(three, s);
                g.div(t, d)
            }),
        ),
        (
            "root of a sum",
            Box::new(|g, t| {
                let s = g.square(t);
                let two = g.int(2);
                let d = g.add(two, s);
                g.sqrt(d)
            }),
        ),
        (
            "variable power",
            Box::new(|g, t| {
                let three = g.int(3);
                let b = g.add(three, t);
                let s = g.call(Function::Sin, &[t]);
                g.power(b, s)
            }),
        ),
        (
            "log of a quadratic",
            Box::new(|g, t| {
                let s = g.square(t);
                let two = g.int(2);
                let d = g.add(two, s);
                g.call(Function::Log, &[d])
            }),
        ),
        (
            "atan of exp",
            Box::new(|g, t| {
                let h = g.scale(t, &ratio(1, 2));
                let e = g.call(Function::Exp, &[h]);
                g.call(Function::Atan, &[e])
            }),
        ),
    ];
    let t0 = 0.3;
    for (name, build) in cases {
        let (f, mut bound) = series(build, t0, 28);
        for h in [-0.2, -0.05, 0.0, 0.07, 0.2] {
            let modes = vec![Mode::Positive; bound.program().guards.len()];
            let direct = bound.rates(t0 + h, &[0.0], &modes).unwrap()[0];
            let sum = horner(&f, h);
            assert!((sum - direct).abs() < SERIES * direct.abs().max(1.0), "{name} at {h}: {sum} against {direct}");
        }
    }
}

#[test]
fn first_two_coefficients_equal_the_interpreter_exactly() {
    for n in [1, 2, 3, 7] {
        let mut bound = bind(&pendulum_chain(n));
        let x: Vec<f64> = (0..2 * n).map(|i| (i as f64 * 1.7).sin()).collect();
        let mut jets = bound.jets(4);
        jets.expand(0.0, &x, &[], 4).unwrap();
        let rates = bound.rates(0.0, &x, &[]).unwrap();
        for i in 0..2 * n {
            assert_eq!((jets.state(i)[0], jets.state(i)[1]), (x[i], rates[i]), "state {i} of {n}");
        }
    }
}

/// The series must satisfy x' = f along the polynomial, M q'' = h included.
#[test]
fn series_of_a_chain_satisfies_its_equations() {
    let n = 3;
    let mut bound = bind(&pendulum_chain(n));
    let x: Vec<f64> = (0..2 * n).map(|i| (i as f64 * 1.7).sin()).collect();
    let order = 24;
    let mut jets = bound.jets(order);
    jets.expand(0.0, &x, &[], order).unwrap();
    let h = 0.02;
    let moved: Vec<f64> = (0..2 * n).map(|i| horner(jets.state(i), h)).collect();
    let slopes: Vec<f64> = (0..2 * n).map(|i| horner(&(1..=order).map(|k| k as f64 * jets.state(i)[k]).collect::<Vec<_>>(), h)).collect();
    let rates = bound.rates(h, &moved, &[]).unwrap();
    for i in 0..2 * n {
        assert!((slopes[i] - rates[i]).abs() < SOLVED * rates[i].abs().max(1.0), "{i}: {} against {}", slopes[i], rates[i]);
    }
}

/// Rates first, the rest when a step has been accepted: the same bits as in one go, whatever the buffer held, and another point is no continuation.
#[test]
fn continued_expansions_are_those_made_at_once() {
    for n in [1, 2, 7] {
        let bound = bind(&pendulum_chain(n));
        let x: Vec<f64> = (0..2 * n).map(|i| (i as f64 * 1.7).sin()).collect();
        let (mut whole, mut continued) = (bound.jets(16), bound.jets(16));
        continued.expand(0.5, &vec![0.1; 2 * n], &[], 16).unwrap();
        whole.expand(0.5, &x, &[], 16).unwrap();
        for from in [1, 4, 16] {
            continued.expand(0.5, &x, &[], from).unwrap();
            continued.extend(0.5, &x, &[], 16).unwrap();
            for i in 0..2 * n {
                assert_eq!(whole.state(i), continued.state(i), "state {i} of {n} from order {from}");
            }
        }
        continued.expand(0.5, &vec![0.2; 2 * n], &[], 1).unwrap();
        continued.extend(0.5, &x, &[], 12).unwrap();
        assert_eq!((continued.state(0), continued.order()), (&whole.state(0)[..13], 12));
    }
}

/// A buffer that held a longer or a faulty expansion gives the same bits as a fresh one.
#[test]
fn expansions_do_not_depend_on_what_the_buffer_held() {
    let bound = bind(&pendulum_chain(2));
    let x = [0.4, -0.3, 1.0, 2.0];
    let mut fresh = bound.jets(16);
    fresh.expand(0.0, &x, &[], 9).unwrap();
    let mut used = bound.jets(16);
    used.expand(0.0, &[1.0, 2.0, 3.0, 4.0], &[], 16).unwrap();
    assert!(used.expand(0.0, &[f64::NAN; 4], &[], 16).is_err());
    used.expand(0.0, &x, &[], 9).unwrap();
    for i in 0..4 {
        assert_eq!(fresh.state(i), used.state(i));
    }
}

#[test]
fn inactive_branch_does_not_poison_and_guard_polynomial_is_exact() {
    // s' = if(1 - t >= 0, sqrt(1 - t), 0)
    let mut e = empty(Graph::new());
    let t = e.graph.symbol(e.time);
    let one = e.graph.one();
    let zero = e.graph.zero();
    let rest = e.graph.sub(one, t);
    let root = e.graph.sqrt(rest);
    let rate = e.graph.switch(rest, Edge::Closed, root, zero);
    auxiliary(&mut e, "s", rate);
    let mut bound = bind(&e);
    assert_eq!(bound.scheduled(), vec![(0, 1.0)]);
    assert_eq!(bound.modes(2.0, &[0.0]).unwrap(), [Mode::Negative]);
    let mut jets = bound.jets(8);
    jets.expand(2.0, &[5.0], &[Mode::Negative], 8).unwrap();
    assert_eq!(jets.state(0), [5.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    jets.expand(0.0, &[0.0], &[Mode::Positive], 8).unwrap();
    assert_eq!(jets.guard(0), [1.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    // at the very edge the root is kept at its value, outside it has none
    jets.expand(1.0, &[0.0], &[Mode::Positive], 8).unwrap();
    assert_eq!(jets.state(0)[1..], [0.0; 8]);
    // nothing beyond the edge can be believed: no step worth the name
    assert!(jets.faithful(1.0, 1e-12) < 1e-6);
    assert_eq!(jets.expand(1.5, &[0.0], &[Mode::Positive], 8).unwrap_err().code, "P002");
}

#[test]
fn singular_mass_names_the_acceleration() {
    let mut e = pendulum_chain(2);
    e.parameters.iter_mut().filter(|p| e.graph.symbol_info(p.symbol).name == "m_1").for_each(|p| p.value = 0.0);
    let bound = bind(&e);
    let fault = bound.jets(5).expand(0.0, &[0.0; 4], &[], 5).unwrap_err();
    assert_eq!(fault.code, "P005");
    assert!(fault.what.en.contains("phi_1''"), "{}", fault.what.en);
}

/// s' = sign(s) + |s| + max(s, t): each mode selects its smooth piece, zero included.
#[test]
fn modes_select_pieces_and_guards_follow_the_state() {
    let mut e = empty(Graph::new());
    let t = e.graph.symbol(e.time);
    let id = e.graph.symbol_id("s", 0);
    let s = e.graph.symbol(id);
    let sign = e.graph.call(Function::Sign, &[s]);
    let abs = e.graph.call(Function::Abs, &[s]);
    let max = e.graph.call(Function::Max, &[s, t]);
    let rate = e.graph.sum(&[sign, abs, max]);
    auxiliary(&mut e, "s", rate);
    let bound = bind(&e);
    let guards = &bound.program().guards;
    let (own, other) = if guards[0].right.is_none() { (0, 1) } else { (1, 0) };
    let mut jets = bound.jets(3);
    let mut modes = [Mode::Positive; 2];
    let mut expand = |own_mode: Mode, other_mode: Mode, x: f64| {
        modes[own] = own_mode;
        modes[other] = other_mode;
        jets.expand(0.0, &[x], &modes, 3).unwrap();
        (jets.state(0).to_vec(), jets.guard(own).to_vec(), jets.guard(other).to_vec())
    };
    // the second guard is t - s: arguments of max have one order
    assert_eq!(bound.program().guards[other].right, Some(s));
    // s' = 1 + s + s, s = (e^{2t}(2 s0 + 1) - 1)/2
    let (state, guard, difference) = expand(Mode::Positive, Mode::Negative, 0.5);
    assert_eq!(state, [0.5, 2.0, 2.0, 4.0 / 3.0]);
    assert_eq!(guard, state);
    assert_eq!(difference, [-0.5, -1.0, -2.0, -4.0 / 3.0]);
    // s' = -1 - s + t
    assert_eq!(expand(Mode::Negative, Mode::Positive, -1.0).0, [-1.0, 0.0, 0.5, -0.5 / 3.0]);
    // held at zero: s' = 0 + 0 + t
    assert_eq!(expand(Mode::Zero, Mode::Positive, 0.0).0, [0.0, 0.0, 0.5, 0.0]);
}

/// A stiff scale of coefficients overflows: a fault, not a number.
#[test]
fn overflow_is_a_fault() {
    let mut e = empty(Graph::new());
    let id = e.graph.symbol_id("s", 0);
    let s = e.graph.symbol(id);
    let rate = e.graph.square(s);
    auxiliary(&mut e, "s", rate);
    let bound = bind(&e);
    assert_eq!(bound.jets(20).expand(0.0, &[1e100], &[], 20).unwrap_err().code, "P006");
    assert_eq!(bound.jets(20).expand(0.0, &[1.0, 2.0], &[], 20).unwrap_err().code, "P008");
}
