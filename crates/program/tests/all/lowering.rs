//! Lowering against direct evaluation of the graph, the text form, guards, definitions.

use crate::common;
use common::*;
use program::{Bound, Evaluator, Mode, Operation, Point, Tape, lower, text};
use proptest::prelude::*;
use std::sync::Arc;
use symbolic::{Edge, Expr, Function, Graph, SymbolId};

/// Residuals with terms about ten: rounding.
const ROUNDING: f64 = 1e-13;
/// Sums in another order, relative to the value, besides ten times what a change of the last place of the inputs gives.
const REORDERED: f64 = 1e-11;
/// Central differences: step² and rounding over step.
const DIFFERENCE: f64 = 1e-8;

/// A recipe for a random expression over p (parameter), t, x, y.
#[derive(Clone, Debug)]
enum Recipe {
    Leaf(u8),
    Number(i64, i64),
    Add(Box<Recipe>, Box<Recipe>),
    Multiply(Box<Recipe>, Box<Recipe>),
    Divide(Box<Recipe>, Box<Recipe>),
    Power(Box<Recipe>, i64, i64),
    Raise(Box<Recipe>, Box<Recipe>),
    Call(usize, Box<Recipe>, Box<Recipe>),
    If(Box<Recipe>, bool, Box<Recipe>, Box<Recipe>),
}

fn recipe() -> impl Strategy<Value = Recipe> {
    let leaf = prop_oneof![(0u8..5).prop_map(Recipe::Leaf), (-5i64..6, 1i64..5).prop_map(|(n, d)| Recipe::Number(n, d))];
    leaf.prop_recursive(5, 40, 3, |r| {
        let b = || r.clone().prop_map(Box::new);
        prop_oneof![
            3 => (b(), b()).prop_map(|(x, y)| Recipe::Add(x, y)),
            3 => (b(), b()).prop_map(|(x, y)| Recipe::Multiply(x, y)),
            1 => (b(), b()).prop_map(|(x, y)| Recipe::Divide(x, y)),
            1 => (b(), -3i64..4, 1i64..4).prop_map(|(x, n, d)| Recipe::Power(x, n, d)),
            1 => (b(), b()).prop_map(|(x, y)| Recipe::Raise(x, y)),
            3 => (0usize..16, b(), b()).prop_map(|(f, x, y)| Recipe::Call(f, x, y)),
            1 => (b(), any::<bool>(), b(), b()).prop_map(|(g, s, x, y)| Recipe::If(g, s, x, y)),
        ]
    })
}

fn build(g: &mut Graph, symbols: &[SymbolId], r: &Recipe) -> Expr {
    match r {
        Recipe::Leaf(i) => match symbols.get(*i as usize) {
            Some(s) => g.symbol(*s),
            None => g.pi(),
        },
        Recipe::Number(n, d) => g.number(ratio(*n, *d)),
        Recipe::Add(x, y) => {
            let (x, y) = (build(g, symbols, x), build(g, symbols, y));
            g.sub(x, y)
        }
        Recipe::Multiply(x, y) => {
            let (x, y) = (build(g, symbols, x), build(g, symbols, y));
            g.mul(x, y)
        }
        Recipe::Divide(x, y) => {
            let (x, y) = (build(g, symbols, x), build(g, symbols, y));
            g.div(x, y)
        }
        Recipe::Power(x, n, d) => {
            let x = build(g, symbols, x);
            g.pow(x, &ratio(*n, *d))
        }
        Recipe::Raise(x, y) => {
            let (x, y) = (build(g, symbols, x), build(g, symbols, y));
            g.power(x, y)
        }
        Recipe::Call(f, x, y) => {
            let (x, y) = (build(g, symbols, x), build(g, symbols, y));
            let f = Function::ALL[*f].0;
            g.call(f, &[x, y][..f.arity()])
        }
        Recipe::If(c, s, x, y) => {
            let (c, x, y) = (build(g, symbols, c), build(g, symbols, x), build(g, symbols, y));
            g.switch(c, if *s { Edge::Open } else { Edge::Closed }, x, y)
        }
    }
}

/// Value by the definition of each node, with the sum of absolute values of all parts as the scale of rounding.
fn direct(g: &Graph, values: &[f64], e: Expr) -> f64 {
    use symbolic::Node;
    let at = |e: &Expr| direct(g, values, *e);
    let power = |b: f64, p: &symbolic::Rational| match p.to_i64() {
        Some(n) => b.powi(n as i32),
        None => b.powf(p.to_f64()),
    };
    match g.node(e) {
        Node::Number(r) => r.to_f64(),
        Node::Pi => std::f64::consts::PI,
        Node::Symbol(s) => values[s.index()],
        Node::Sum { constant, terms } => terms.iter().fold(constant.to_f64(), |s, (t, f)| s + f.to_f64() * at(t)),
        Node::Product { coefficient, factors } => factors.iter().fold(coefficient.to_f64(), |p, (b, x)| p * power(at(b), x)),
        Node::Power { base, exponent } => at(base).powf(at(exponent)),
        Node::Switch { guard, edge, then, otherwise } => {
            let v = at(guard);
            if v.is_nan() {
                return v;
            }
            if v > 0.0 || *edge == symbolic::Edge::Closed && v == 0.0 { at(then) } else { at(otherwise) }
        }
        Node::Call { function, arguments } => {
            let x = at(&arguments[0]);
            let y = || at(&arguments[1]);
            match function {
                Function::Sin => x.sin(),
                Function::Cos => x.cos(),
                Function::Tan => x.tan(),
                Function::Asin => x.asin(),
                Function::Acos => x.acos(),
                Function::Atan => x.atan(),
                Function::Atan2 => x.atan2(y()),
                Function::Sinh => x.sinh(),
                Function::Cosh => x.cosh(),
                Function::Tanh => x.tanh(),
                Function::Asinh => x.asinh(),
                Function::Acosh => x.acosh(),
                Function::Atanh => x.atanh(),
                Function::Exp => x.exp(),
                Function::Log => x.ln(),
                Function::Abs => x.abs(),
                Function::Sign => {
                    if x == 0.0 {
                        0.0
                    } else {
                        x.signum()
                    }
                }
                Function::Min => {
                    if x.is_nan() || y().is_nan() {
                        f64::NAN
                    } else {
                        x.min(y())
                    }
                }
                Function::Max => {
                    if x.is_nan() || y().is_nan() {
                        f64::NAN
                    } else {
                        x.max(y())
                    }
                }
            }
        }
    }
}

fn inputs(symbols: &[SymbolId]) -> lower::Inputs {
    lower::Inputs { parameters: vec![symbols[0]], time: Some(symbols[1]), states: symbols[2..].to_vec(), ..Default::default() }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    /// The tape reassociates sums and gathers factors, so values agree to rounding, amplified by cancellation: the spread of the direct
    /// value under relative changes of the inputs by 1e-13 measures it.
    #[test]
    fn tape_agrees_with_the_graph(r in recipe(), v in proptest::array::uniform4(-2.0f64..2.0)) {
        let mut g = Graph::new();
        let symbols: Vec<SymbolId> = ["p", "t", "x", "y"].iter().map(|n| g.symbol_id(n, 0)).collect();
        let e = build(&mut g, &symbols, &r);
        let want = direct(&g, &v, e);
        let nudged = [1.0 - 1e-13, 1.0 + 1e-13, 1.0 + 3e-13].map(|f| direct(&g, &v.map(|x| x * f), e));
        let spread = nudged.iter().fold(0.0_f64, |s, n| s.max((n - want).abs()));
        // formulas that magnify the last place of their inputs a million times prove nothing
        prop_assume!(want.is_finite() && spread < 1e-9 * want.abs().max(1.0));
        let tape = lower::expressions(&g, "random", &inputs(&symbols), &[("e".to_owned(), e)]).unwrap();
        program::verify(&tape).unwrap();
        let mut evaluator = Evaluator::new(&Arc::new(tape), &v[..1]).unwrap();
        let got = evaluator.evaluate(&Point { time: v[1], states: &v[2..], ..Point::default() }).map(|v| v[0]);
        if let Ok(got) = got {
            prop_assert!((got - want).abs() <= 10.0 * spread + REORDERED * want.abs().max(1.0), "{got} against {want}");
        }
    }

    #[test]
    fn text_reads_back_as_the_same_tape(r in recipe()) {
        let mut g = Graph::new();
        let symbols: Vec<SymbolId> = ["p", "t", "x", "y"].iter().map(|n| g.symbol_id(n, 0)).collect();
        let e = build(&mut g, &symbols, &r);
        let tape = lower::expressions(&g, "random", &inputs(&symbols), &[("e".to_owned(), e)]).unwrap();
        let again = text::parse(&tape.to_string()).unwrap();
        prop_assert_eq!(again.to_string(), tape.to_string());
        let bare = |t: &Tape| { let mut t = t.clone(); t.prologue.iter_mut().chain(&mut t.body).for_each(|i| i.origin = None); t };
        prop_assert_eq!(again, bare(&tape));
    }
}

#[test]
fn chain_tapes_read_back() {
    let p = lower::equations(&pendulum_chain(3)).unwrap();
    for tape in [&p.dynamics, &p.outputs, &p.energy, &p.second, &p.statics, &p.start] {
        program::verify(tape).unwrap();
        assert_eq!(text::parse(&tape.to_string()).unwrap().to_string(), tape.to_string());
    }
}

#[test]
fn everything_over_parameters_is_in_the_prologue() {
    // k x / m + g has one body operation
    let mut e = empty(Graph::new());
    let (k, m, g) = (parameter(&mut e, "k", 3.0), parameter(&mut e, "m", 2.0), parameter(&mut e, "g", 9.81));
    let x = {
        let id = e.graph.symbol_id("s", 0);
        e.graph.symbol(id)
    };
    let top = e.graph.mul(k, x);
    let ratio = e.graph.div(top, m);
    let rate = e.graph.add(ratio, g);
    auxiliary(&mut e, "s", rate);
    let p = lower::equations(&e).unwrap();
    assert_eq!(p.dynamics.body.len(), 2, "{}", p.dynamics);
    assert!(matches!(p.dynamics.body[1].operation, Operation::Linear { .. }));
}

#[test]
fn guards_are_shared_up_to_sign_and_scale() {
    // sign(x) + if(-2x > 0, 1, 2) + |x|: one guard
    let mut e = empty(Graph::new());
    let s = {
        let id = e.graph.symbol_id("s", 0);
        e.graph.symbol(id)
    };
    let sign = e.graph.call(Function::Sign, &[s]);
    let abs = e.graph.call(Function::Abs, &[s]);
    let minus = e.graph.scale(s, &ratio(-2, 1));
    let (one, two) = (e.graph.int(1), e.graph.int(2));
    let branch = e.graph.switch(minus, Edge::Open, one, two);
    let rate = e.graph.sum(&[sign, abs, branch]);
    auxiliary(&mut e, "s", rate);
    output(&mut e, "o", rate);
    let p = Arc::new(lower::equations(&e).unwrap());
    assert_eq!(p.guards.len(), 1);
    let mut bound = Bound::new(&p, &[]).unwrap();
    for (x, want) in [(-3.0, -1.0 + 3.0 + 1.0), (0.0, 2.0), (3.0, 1.0 + 3.0 + 2.0)] {
        let modes = bound.modes(0.0, &[x]).unwrap();
        assert_eq!(bound.rates(0.0, &[x], &modes).unwrap(), [want]);
    }
    // outputs take the mode given, even against the value: one-sided values at a jump
    let mut outputs = bound.evaluator(&p.outputs).unwrap();
    let value = outputs.evaluate(&Point { states: &[0.0], modes: Some(&[Mode::Negative]), ..Point::default() }).unwrap()[0];
    assert_eq!(value, -1.0 - 0.0 + 1.0);
}

#[test]
fn nested_guard_is_active_only_in_its_branch() {
    // if(t >= 1, sign(s), 0)
    let mut e = empty(Graph::new());
    let t = e.graph.symbol(e.time);
    let s = {
        let id = e.graph.symbol_id("s", 0);
        e.graph.symbol(id)
    };
    let (one, zero) = (e.graph.one(), e.graph.zero());
    let outer = e.graph.sub(t, one);
    let sign = e.graph.call(Function::Sign, &[s]);
    let rate = e.graph.switch(outer, Edge::Closed, sign, zero);
    auxiliary(&mut e, "s", rate);
    let p = Arc::new(lower::equations(&e).unwrap());
    let bound = Bound::new(&p, &[]).unwrap();
    let (guard_t, guard_s) = if p.guards[0].left == outer { (0, 1) } else { (1, 0) };
    let mut modes = [Mode::Positive; 2];
    assert_eq!(bound.active(&modes), [true, true]);
    modes[guard_t] = Mode::Negative;
    assert!(bound.active(&modes)[guard_t] && !bound.active(&modes)[guard_s]);
    assert_eq!(bound.scheduled(), vec![(guard_t, 1.0)]);
}

#[test]
fn definitions_are_lowered_and_cycles_are_refused() {
    let mut e = empty(Graph::new());
    let t = e.graph.symbol(e.time);
    let w = definition(&mut e, "w", t);
    let square = e.graph.square(w);
    auxiliary(&mut e, "s", square);
    let p = Arc::new(lower::equations(&e).unwrap());
    assert_eq!(Bound::new(&p, &[]).unwrap().rates(3.0, &[0.0], &[]).unwrap(), [9.0]);
    e.definitions[0].formula = square;
    assert_eq!(lower::equations(&e).unwrap_err().code, "P011");
    e.definitions.clear();
    assert_eq!(lower::equations(&e).unwrap_err().code, "P010");
}

#[test]
fn statics_give_the_force_at_rest_and_its_jacobian() {
    let e = pendulum_chain(2);
    let p = Arc::new(lower::equations(&e).unwrap());
    let bound = Bound::new(&p, &p.values.clone()).unwrap();
    let mut statics = bound.evaluator(&p.statics).unwrap();
    let mut at = |a: f64, b: f64| statics.evaluate(&Point { states: &[a, b, 7.0, 8.0], ..Point::default() }).unwrap().to_vec();
    let (here, step) = (at(0.3, -0.4), 1e-5);
    let columns = [(step, 0.0), (0.0, step)].map(|(a, b)| {
        let (plus, minus) = (at(0.3 + a, -0.4 + b), at(0.3 - a, -0.4 - b));
        [0, 1].map(|i| (plus[i] - minus[i]) / (2.0 * step))
    });
    for i in 0..2 {
        for (j, column) in columns.iter().enumerate() {
            assert!((here[2 + 2 * i + j] - column[i]).abs() < DIFFERENCE, "{i} {j}");
        }
    }
}

#[test]
fn residuals_of_the_first_derivation_vanish_at_the_solution() {
    let p = Arc::new(lower::equations(&pendulum_chain(3)).unwrap());
    let mut bound = Bound::new(&p, &p.values.clone()).unwrap();
    let x = [0.1, 0.9, -0.4, 1.0, 2.0, -0.5];
    let rates = bound.rates(0.0, &x, &[]).unwrap().to_vec();
    let mut second = bound.evaluator(&p.second).unwrap();
    let residuals = second.evaluate(&Point { states: &x, accelerations: &rates[3..], ..Point::default() }).unwrap();
    assert!(residuals.iter().all(|r| r.abs() < ROUNDING), "{residuals:?}");
}

#[test]
fn faults_name_the_rule_and_the_result() {
    let mut g = Graph::new();
    let symbols: Vec<SymbolId> = ["p", "t", "x", "y"].iter().map(|n| g.symbol_id(n, 0)).collect();
    let x = g.symbol(symbols[2]);
    let one = g.one();
    let cases = [
        (g.div(one, x), 0.0, "P001"),
        (g.sqrt(x), -1.0, "P002"),
        (g.pow(x, &ratio(1, 3)), -1.0, "P002"),
        (g.call(Function::Log, &[x]), 0.0, "P003"),
        (g.call(Function::Asin, &[x]), 2.0, "P004"),
        (g.call(Function::Exp, &[x]), 1e4, "P006"),
    ];
    for (e, value, code) in cases {
        let tape = lower::expressions(&g, "one", &inputs(&symbols), &[("answer".to_owned(), e)]).unwrap();
        let mut evaluator = Evaluator::new(&Arc::new(tape), &[0.0]).unwrap();
        let fault = evaluator.evaluate(&Point { states: &[value, 0.0], ..Point::default() }).unwrap_err();
        assert_eq!(fault.code, code);
        assert!(fault.what.en.contains("answer") && fault.what.ru.contains("answer") && fault.expression.is_some());
        assert!(program::EXPLANATIONS.iter().any(|row| row.code == code));
    }
}

/// A hundred thousand nested calls neither overflow the stack nor take long.
#[test]
fn deep_graphs_lower_iteratively() {
    let mut g = Graph::new();
    let symbols: Vec<SymbolId> = ["p", "t", "x", "y"].iter().map(|n| g.symbol_id(n, 0)).collect();
    let mut e = g.symbol(symbols[2]);
    for _ in 0..100_000 {
        e = g.call(Function::Atan, &[e]);
    }
    let tape = lower::expressions(&g, "deep", &inputs(&symbols), &[("e".to_owned(), e)]).unwrap();
    assert_eq!(tape.body.len(), 100_001);
}
