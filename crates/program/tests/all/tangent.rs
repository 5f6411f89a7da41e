//! The Jacobian of the tape against differences of the interpreter, for every operation and for systems of both kinds.

use crate::common;
use common::*;
use program::{Bound, Mode, Point, Tangent, lower};
use std::sync::Arc;
use symbolic::{Equations, Expr, Function, Graph};

/// Central differences with extrapolation: step⁴ and rounding over step.
const DIFFERENCE: f64 = 1e-9;

fn bind(e: &Equations) -> Bound {
    let program = Arc::new(lower::equations(e).unwrap());
    let values = program.values.clone();
    Bound::new(&program, &values).unwrap()
}

/// Largest difference of ∂x'/∂x from central differences of fourth order, relative to the largest derivative; their own error is 1e-11.
fn deviation(bound: &mut Bound, x: &[f64], modes: &[Mode]) -> f64 {
    let n = x.len();
    let mut tangent = Tangent::new(bound);
    let exact = tangent.evaluate(&Point { time: 0.3, states: x, modes: Some(modes), ..Point::default() }).unwrap().to_vec();
    let (mut worst, mut largest): (f64, f64) = (0.0, 0.0);
    for j in 0..n {
        let h = 1e-3;
        let mut at = |factor: f64| {
            let mut x = x.to_vec();
            x[j] += factor * h;
            bound.rates(0.3, &x, modes).unwrap()[..n].to_vec()
        };
        let (a, b, c, d) = (at(-2.0), at(-1.0), at(1.0), at(2.0));
        let difference = |i: usize| (8.0 * (c[i] - b[i]) - (d[i] - a[i])) / (12.0 * h);
        for i in 0..n {
            worst = worst.max((difference(i) - exact[i * (n + 1) + j]).abs());
            largest = largest.max(exact[i * (n + 1) + j].abs());
        }
    }
    worst / largest
}

/// s' = f(s), u' = f(s u): one and two arguments of each function.
#[test]
fn every_function_is_differentiated() {
    use Function::*;
    for f in [Sin, Cos, Tan, Asin, Acos, Atan, Sinh, Cosh, Tanh, Asinh, Atanh, Exp, Log] {
        let mut e = empty(Graph::new());
        let (s, u) = (e.graph.symbol_id("s", 0), e.graph.symbol_id("u", 0));
        let (s, u) = (e.graph.symbol(s), e.graph.symbol(u));
        let product = e.graph.mul(s, u);
        let one = e.graph.call(f, &[s]);
        let two = e.graph.call(f, &[product]);
        let quotient = e.graph.div(two, s);
        auxiliary(&mut e, "s", one);
        auxiliary(&mut e, "u", quotient);
        let off = deviation(&mut bind(&e), &[0.61, 0.83], &[]);
        assert!(off < DIFFERENCE, "{f:?}: {off:e}");
    }
}

#[test]
fn powers_and_angles_are_differentiated() {
    let build: [fn(&mut Graph, Expr, Expr) -> Expr; 4] = [
        |g, s, _| g.pow(s, &ratio(7, 3)),
        |g, s, u| {
            let power = g.pow(u, &ratio(-3, 2));
            g.mul(power, s)
        },
        |g, s, u| g.call(Function::Atan2, &[s, u]),
        |g, s, u| {
            let sum = g.add(s, u);
            g.square(sum)
        },
    ];
    for (k, f) in build.iter().enumerate() {
        let mut e = empty(Graph::new());
        let (s, u) = (e.graph.symbol_id("s", 0), e.graph.symbol_id("u", 0));
        let (s, u) = (e.graph.symbol(s), e.graph.symbol(u));
        let (one, two) = (f(&mut e.graph, s, u), f(&mut e.graph, u, s));
        auxiliary(&mut e, "s", one);
        auxiliary(&mut e, "u", two);
        let mut bound = bind(&e);
        // an angle has guards: this point is right of the origin and above it
        let modes = vec![Mode::Positive; bound.program().guards.len()];
        let off = deviation(&mut bound, &[0.61, 0.83], &modes);
        assert!(off < DIFFERENCE, "{k}: {off:e}");
    }
}
