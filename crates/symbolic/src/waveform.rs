//! Periodic functions of time that are no finite sums of harmonics: sign(sin p t), |cos p t|, if(sin p t > 0.5, F, 0), 1/(2 + cos p t).
//!
//! Time may stand only in sines, cosines and tangents of arguments affine in time whose rates are rational multiples of one another. Then
//! the function repeats with θ = ν t after 2π, ν being the largest rate of which all others are whole multiples.

use crate::{Expr, Function, Graph, Node, Rational, Substitution, SymbolId};

/// A function of the phase θ = ν t with the period 2π.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Waveform {
    /// ν, free of time.
    pub rate: Expr,
    /// The function; the symbol of time stands for θ.
    pub shape: Expr,
}

/// Largest whole multiple of ν among the rates: beyond it the rates count as foreign to one another.
const MOST: i64 = 1000;

/// `e` as a waveform; none when time occurs in another way.
pub fn waveform(graph: &mut Graph, time: SymbolId, e: Expr) -> Option<Waveform> {
    let mut rates: Vec<Expr> = Vec::new();
    for part in graph.reachable(&[e]) {
        if let Some(rate) = rate_of(graph, time, part)
            && !rates.contains(&rate)
        {
            rates.push(rate);
        }
    }
    let first = *rates.first()?;
    let (mut bottoms, mut ratios) = (1_i64, Vec::new());
    for rate in &rates {
        let ratio = graph.div(*rate, first);
        let (top, bottom) = fraction(graph.as_number(ratio)?)?;
        bottoms = common(bottoms, bottom)?;
        ratios.push((top, bottom));
    }
    // ν = first·g/bottoms with g the common divisor of all numerators over that denominator
    let tops: Vec<i64> = ratios.iter().map(|(top, bottom)| (top * (bottoms / bottom)).abs()).collect();
    let divisor = tops.iter().copied().fold(0, gcd);
    if divisor == 0 || tops.iter().any(|t| t / divisor > MOST) {
        return None;
    }
    let rate = graph.scale(first, &Rational::new(divisor, bottoms)?);
    let theta = graph.symbol(time);
    let instant = graph.div(theta, rate);
    let shape = Substitution::new([(time, instant)]).apply(graph, e);
    (!outside(graph, time, shape)).then_some(Waveform { rate, shape })
}

/// The rate of a sine whose argument is affine in time.
fn rate_of(graph: &mut Graph, time: SymbolId, e: Expr) -> Option<Expr> {
    let Node::Call { function: Function::Sin | Function::Cos | Function::Tan, arguments } = graph.node(e).clone() else { return None };
    if !graph.contains(arguments[0], |s| s == time) {
        return None;
    }
    let rate = graph.derivative(arguments[0], time);
    (!graph.contains(rate, |s| s == time) && !graph.is_zero(rate)).then_some(rate)
}

/// Whether the phase stands anywhere but in sines of whole multiples of it.
fn outside(graph: &mut Graph, time: SymbolId, shape: Expr) -> bool {
    let mut open = vec![shape];
    let mut seen = std::collections::BTreeSet::new();
    while let Some(e) = open.pop() {
        if !seen.insert(e) || !graph.contains(e, |s| s == time) {
            continue;
        }
        match rate_of(graph, time, e) {
            Some(rate) if graph.as_number(rate).is_some_and(Rational::is_integer) => {}
            _ if graph.as_symbol(e) == Some(time) => return true,
            _ => open.extend(graph.children(e)),
        }
    }
    false
}

fn fraction(r: &Rational) -> Option<(i64, i64)> {
    let (top, bottom) = r.digits();
    let top: i64 = top.parse().ok()?;
    Some((top, bottom.parse().ok()?))
}

fn common(a: i64, b: i64) -> Option<i64> {
    Some(a / gcd(a, b) * b).filter(|c| *c <= MOST)
}

fn gcd(a: i64, b: i64) -> i64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_wave_has_the_rate_of_its_sine() {
        let mut g = Graph::new();
        let [t, p] = ["t", "p"].map(|n| g.var(n));
        let time = g.symbol_id("t", 0);
        let pt = g.mul(p, t);
        let two = g.scale(pt, &Rational::from(2));
        let three = g.scale(pt, &Rational::from(3));
        let (s, c) = (g.call(Function::Sin, &[two]), g.call(Function::Cos, &[three]));
        let (square, other) = (g.call(Function::Sign, &[s]), g.call(Function::Abs, &[c]));
        let e = g.add(square, other);
        let found = waveform(&mut g, time, e).expect("periodic");
        assert_eq!(found.rate, p);
        let value = |_: SymbolId| 0.9;
        let wanted = (2.0_f64 * 0.9).sin().signum() + (3.0_f64 * 0.9).cos().abs();
        // units of the last place
        assert!((g.evaluate(&[found.shape], &value)[0] - wanted).abs() < 1e-15);
    }

    #[test]
    fn time_outside_of_sines_is_no_waveform() {
        let mut g = Graph::new();
        let t = g.var("t");
        let time = g.symbol_id("t", 0);
        let s = g.call(Function::Sin, &[t]);
        let square = g.call(Function::Sign, &[s]);
        let e = g.mul(t, square);
        assert_eq!(waveform(&mut g, time, e), None);
    }
}
