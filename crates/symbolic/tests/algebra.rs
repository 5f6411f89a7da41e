//! Rewriting never changes a value: random expressions, built through the canonical constructors, against plain arithmetic.

use proptest::prelude::*;
use symbolic::{Derivation, Edge, Expr, Function, Graph, Rational, Substitution, Textbook};

/// A recipe for an expression, evaluated once by plain arithmetic and once through the graph.
#[derive(Clone, Debug)]
enum Recipe {
    Number(i64, i64),
    Symbol(usize),
    Add(Box<Recipe>, Box<Recipe>),
    Sub(Box<Recipe>, Box<Recipe>),
    Mul(Box<Recipe>, Box<Recipe>),
    Power(Box<Recipe>, i64),
    Wave(bool, Box<Recipe>),
    Quarter(i64, Box<Recipe>),
    Exp(Box<Recipe>),
    Atan(Box<Recipe>),
    Abs(Box<Recipe>),
    If(Box<Recipe>, Box<Recipe>, Box<Recipe>),
}
use Recipe::*;

const NAMES: [&str; 4] = ["a", "b", "x", "y"];

fn recipe() -> impl Strategy<Value = Recipe> {
    let leaf = prop_oneof![(-6i64..7, 1i64..5).prop_map(|(n, d)| Number(n, d)), (0..NAMES.len()).prop_map(Symbol)];
    leaf.prop_recursive(6, 60, 3, |inner| {
        let two = (inner.clone(), inner.clone()).prop_map(|(a, b)| (Box::new(a), Box::new(b)));
        prop_oneof![
            3 => two.clone().prop_map(|(a, b)| Add(a, b)),
            2 => two.clone().prop_map(|(a, b)| Sub(a, b)),
            4 => two.clone().prop_map(|(a, b)| Mul(a, b)),
            2 => (inner.clone(), 1i64..4).prop_map(|(a, n)| Power(Box::new(a), n)),
            4 => (any::<bool>(), inner.clone()).prop_map(|(s, a)| Wave(s, Box::new(a))),
            1 => (-5i64..6, inner.clone()).prop_map(|(k, a)| Quarter(k, Box::new(a))),
            1 => inner.clone().prop_map(|a| Exp(Box::new(Wave(true, Box::new(a))))),
            1 => inner.clone().prop_map(|a| Atan(Box::new(a))),
            1 => inner.clone().prop_map(|a| Abs(Box::new(a))),
            1 => (inner.clone(), inner.clone(), inner).prop_map(|(a, b, c)| If(Box::new(a), Box::new(b), Box::new(c))),
        ]
    })
}

fn build(g: &mut Graph, r: &Recipe) -> Expr {
    match r {
        Number(n, d) => g.number(Rational::new(*n, *d).unwrap()),
        Symbol(i) => g.var(NAMES[*i]),
        Add(a, b) => {
            let (a, b) = (build(g, a), build(g, b));
            g.add(a, b)
        }
        Sub(a, b) => {
            let (a, b) = (build(g, a), build(g, b));
            g.sub(a, b)
        }
        Mul(a, b) => {
            let (a, b) = (build(g, a), build(g, b));
            g.mul(a, b)
        }
        Power(a, n) => {
            let a = build(g, a);
            g.pow(a, &Rational::from(*n))
        }
        Wave(sine, a) => {
            let a = build(g, a);
            g.call(if *sine { Function::Sin } else { Function::Cos }, &[a])
        }
        Quarter(k, a) => {
            let a = build(g, a);
            let pi = g.pi();
            let quarter = g.scale(pi, &Rational::new(*k, 2).unwrap());
            let x = g.add(a, quarter);
            g.call(Function::Cos, &[x])
        }
        Exp(a) => {
            let a = build(g, a);
            g.call(Function::Exp, &[a])
        }
        Atan(a) => {
            let a = build(g, a);
            g.call(Function::Atan, &[a])
        }
        Abs(a) => {
            let a = build(g, a);
            g.call(Function::Abs, &[a])
        }
        If(a, b, c) => {
            let (a, b, c) = (build(g, a), build(g, b), build(g, c));
            g.switch(a, Edge::Closed, b, c)
        }
    }
}

/// Value and a bound of what rounding may have done to it: the largest intermediate magnitude.
fn value(r: &Recipe, v: &[f64; 4]) -> (f64, f64) {
    let join = |x: f64, parts: &[(f64, f64)]| (x, parts.iter().fold(x.abs(), |m, p| m.max(p.1)));
    match r {
        Number(n, d) => join(*n as f64 / *d as f64, &[]),
        Symbol(i) => join(v[*i], &[]),
        Add(a, b) => {
            let (a, b) = (value(a, v), value(b, v));
            join(a.0 + b.0, &[a, b])
        }
        Sub(a, b) => {
            let (a, b) = (value(a, v), value(b, v));
            join(a.0 - b.0, &[a, b])
        }
        Mul(a, b) => {
            let (a, b) = (value(a, v), value(b, v));
            let x = a.0 * b.0;
            (x, x.abs().max(a.1 * b.1.max(1.0)).max(b.1 * a.1.max(1.0)))
        }
        Power(a, n) => {
            let a = value(a, v);
            (a.0.powi(*n as i32), a.1.max(1.0).powi(*n as i32))
        }
        Wave(sine, a) => {
            let a = value(a, v);
            join(if *sine { a.0.sin() } else { a.0.cos() }, &[a])
        }
        Quarter(k, a) => {
            let a = value(a, v);
            join((a.0 + *k as f64 * std::f64::consts::FRAC_PI_2).cos(), &[a, (0.0, 8.0)])
        }
        Exp(a) => {
            let a = value(a, v);
            join(a.0.exp(), &[a])
        }
        Atan(a) => {
            let a = value(a, v);
            join(a.0.atan(), &[a])
        }
        Abs(a) => {
            let a = value(a, v);
            join(a.0.abs(), &[a])
        }
        If(a, b, c) => {
            let (a, b, c) = (value(a, v), value(b, v), value(c, v));
            join(if a.0 >= 0.0 { b.0 } else { c.0 }, &[a, b, c])
        }
    }
}

/// Switches whose guard is within rounding of zero have no definite value in machine numbers.
fn near_switch(r: &Recipe, v: &[f64; 4]) -> bool {
    match r {
        If(a, b, c) => {
            let g = value(a, v);
            // values this close to a switch are decided by rounding of random formulas
            g.0.abs() <= 1e-9 * g.1.max(1.0) || [a, b, c].iter().any(|r| near_switch(r, v))
        }
        Abs(a) => {
            let g = value(a, v);
            // the step of the difference below must not pass a switch
            g.0.abs() <= 1e-3 * g.1.max(1.0) || near_switch(a, v)
        }
        Add(a, b) | Sub(a, b) | Mul(a, b) => near_switch(a, v) || near_switch(b, v),
        Power(a, _) | Wave(_, a) | Quarter(_, a) | Exp(a) | Atan(a) => near_switch(a, v),
        Number(..) | Symbol(_) => false,
    }
}

fn evaluate(g: &mut Graph, roots: &[Expr], v: [f64; 4]) -> Vec<f64> {
    let ids = NAMES.map(|n| g.symbol_id(n, 0));
    g.evaluate(roots, &|s| ids.iter().position(|i| *i == s).map_or(f64::NAN, |i| v[i]))
}

fn close(a: f64, b: f64, scale: f64) -> bool {
    // some 60 operations of relative error 1e-16 each, on numbers up to `scale`
    (a - b).abs() <= 1e-12 * scale.max(1.0) || !a.is_finite() || !b.is_finite() || scale > 1e9
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn canonical_form_keeps_the_value(r in recipe(), v in prop::array::uniform4(-1.5f64..1.5)) {
        prop_assume!(!near_switch(&r, &v));
        let mut g = Graph::new();
        let e = build(&mut g, &r);
        let found = evaluate(&mut g, &[e], v)[0];
        let (expected, scale) = value(&r, &v);
        prop_assert!(close(found, expected, scale), "{found} against {expected} (scale {scale})");
    }

    #[test]
    fn textbook_form_keeps_the_value(r in recipe(), v in prop::array::uniform4(-1.5f64..1.5)) {
        prop_assume!(!near_switch(&r, &v));
        let mut g = Graph::new();
        let e = build(&mut g, &r);
        let constants = [g.symbol_id("a", 0), g.symbol_id("b", 0)];
        let mut textbook = Textbook::new(&mut g, constants, &[]);
        let tidied = textbook.tidy(&mut g, e);
        let factored = textbook.factored(&mut g, tidied);
        let shortest = textbook.shortest(&mut g, e);
        let values = evaluate(&mut g, &[e, tidied, factored, shortest], v);
        let (_, scale) = value(&r, &v);
        // multiplying out adds magnitudes of up to the product of the sums
        prop_assert!(close(values[0], values[1], 1e2 * scale) && close(values[0], values[2], 1e2 * scale) && close(values[0], values[3], 1e2 * scale), "{values:?}");
    }

    /// Sums of products of few waves with coefficients ±1: almost every one has pairs that contract.
    #[test]
    fn contraction_keeps_the_value(
        terms in prop::collection::vec((any::<bool>(), prop::array::uniform3((any::<bool>(), 0usize..3))), 2..14),
        v in prop::array::uniform4(-3.0f64..3.0),
    ) {
        let mut g = Graph::new();
        let parts: Vec<(Expr, Rational)> = terms
            .iter()
            .map(|(minus, waves)| {
                let factors: Vec<Expr> = waves
                    .iter()
                    .map(|(sine, i)| {
                        let x = g.var(NAMES[*i]);
                        g.call(if *sine { Function::Sin } else { Function::Cos }, &[x])
                    })
                    .collect();
                (g.product(&factors), Rational::from(if *minus { -1 } else { 1 }))
            })
            .collect();
        let e = g.linear(Rational::ZERO, &parts);
        let mut textbook = Textbook::new(&mut g, [], &[]);
        let tidied = textbook.tidy(&mut g, e);
        let values = evaluate(&mut g, &[e, tidied], v);
        // 14 products of numbers below 1
        prop_assert!((values[0] - values[1]).abs() < 1e-13, "{values:?}");
    }

    #[test]
    fn same_recipe_same_node_in_any_order(a in recipe(), b in recipe(), c in recipe()) {
        let mut g = Graph::new();
        let (a, b, c) = (build(&mut g, &a), build(&mut g, &b), build(&mut g, &c));
        let (ab, bc) = (g.add(a, b), g.add(b, c));
        let left = g.add(ab, c);
        let right = g.add(a, bc);
        prop_assert_eq!(left, right);
        let (ab, cb) = (g.mul(a, b), g.mul(c, b));
        let left = g.mul(ab, c);
        let right = g.mul(a, cb);
        prop_assert_eq!(left, right);
        let zero = g.sub(ab, ab);
        prop_assert!(g.is_zero(zero));
    }

    #[test]
    fn derivative_is_the_slope(r in recipe(), v in prop::array::uniform4(-1.0f64..1.0)) {
        let h = 1e-5;
        prop_assume!(!near_switch(&r, &v));
        let mut g = Graph::new();
        let e = build(&mut g, &r);
        let x = g.symbol_id("x", 0);
        let d = Derivation::partial(&mut g, x).apply(&mut g, e);
        let at = |g: &mut Graph, dx: f64| {
            let mut w = v;
            w[2] += dx;
            evaluate(g, &[e], w)[0]
        };
        // Richardson extrapolation of central differences: error O(h^4) + rounding/h
        let (c1, c2) = ((at(&mut g, h) - at(&mut g, -h)) / (2.0 * h), (at(&mut g, 2.0 * h) - at(&mut g, -2.0 * h)) / (4.0 * h));
        let slope = (4.0 * c1 - c2) / 3.0;
        let found = evaluate(&mut g, &[d], v)[0];
        let (_, scale) = value(&r, &v);
        let near = [-2.0 * h, 2.0 * h].iter().any(|dx| { let mut w = v; w[2] += dx; near_switch(&r, &w) });
        // two differences with other steps agree: the function is smooth enough for the test
        prop_assume!(!near && scale < 1e3 && found.abs() < 1e3 && (c1 - c2).abs() < 1e-6 * (1.0 + c1.abs()));
        // central differences of smooth formulas, as the two above
        prop_assert!((found - slope).abs() <= 1e-6 * (1.0 + slope.abs()), "{found} against {slope}");
    }

    #[test]
    fn substitution_commutes_with_evaluation(r in recipe(), s in recipe(), v in prop::array::uniform4(-1.0f64..1.0)) {
        let mut g = Graph::new();
        let (e, s) = (build(&mut g, &r), build(&mut g, &s));
        let x = g.symbol_id("x", 0);
        let replaced = Substitution::new([(x, s)]).apply(&mut g, e);
        let inner = evaluate(&mut g, &[s], v)[0];
        let mut w = v;
        w[2] = inner;
        prop_assume!(inner.abs() < 1e2 && !near_switch(&r, &w));
        let (_, scale) = value(&r, &w);
        let expected = evaluate(&mut g, &[e], w)[0];
        let found = evaluate(&mut g, &[replaced], v)[0];
        prop_assert!(close(found, expected, 1e3 * scale), "{found} against {expected}");
    }
}
