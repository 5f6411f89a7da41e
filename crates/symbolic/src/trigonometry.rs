//! Trigonometric contraction of sums of monomials.
//!
//! With any common factor R and equal (or opposite) coefficients:
//!
//! ```text
//! R sin²a + R cos²a           -> R                R - R sin²a -> R cos²a
//! R cos a cos b ± R sin a sin b -> R cos(a ∓ b)     (a = b: cos²a - sin²a -> cos 2a)
//! R sin a cos b ± R cos a sin b -> R sin(a ± b)
//! ```
//!
//! Each rule removes a term, so repetition ends.

use crate::polynomial::{Monomial, Polynomial, factors_of};
use crate::{Expr, Function, Graph, Node, Rational};

/// Contracts until no rule applies.
pub(crate) fn contract(graph: &mut Graph, polynomial: &mut Polynomial) {
    let mut changed = true;
    while changed {
        changed = false;
        let mut i = 0;
        while i < polynomial.slots() {
            while let Some((monomial, coefficient)) = polynomial.slot(i).map(|(m, c)| (m.clone(), c.clone())) {
                if !contract_term(graph, polynomial, &monomial, &coefficient) {
                    break;
                }
                changed = true;
            }
            i += 1;
        }
    }
}

/// A sine or cosine in a monomial.
#[derive(Clone, Copy)]
struct Wave {
    position: usize,
    function: Function,
    angle: Expr,
    exponent: i64,
}

fn waves(graph: &Graph, monomial: &Monomial) -> Vec<Wave> {
    let wave = |(position, (base, exponent)): (usize, &(Expr, Rational))| match graph.node(*base) {
        Node::Call { function: function @ (Function::Sin | Function::Cos), arguments } => {
            let exponent = exponent.to_i64().filter(|n| *n > 0)?;
            Some(Wave { position, function: *function, angle: arguments[0], exponent })
        }
        _ => None,
    };
    monomial.iter().enumerate().filter_map(wave).collect()
}

/// Applies the first rule that fits this term; tells whether one did.
fn contract_term(graph: &mut Graph, polynomial: &mut Polynomial, monomial: &Monomial, coefficient: &Rational) -> bool {
    let waves = waves(graph, monomial);
    for w in waves.iter().filter(|w| w.exponent >= 2) {
        if square_rule(graph, polynomial, (monomial, coefficient), *w) {
            return true;
        }
    }
    for (k, a) in waves.iter().enumerate() {
        for b in &waves[k + 1..] {
            if angle_rule(graph, polynomial, (monomial, coefficient), (*a, *b)) {
                return true;
            }
        }
    }
    false
}

fn other(function: Function) -> Function {
    if function == Function::Sin { Function::Cos } else { Function::Sin }
}

/// The monomial with factors at some positions divided out and others multiplied in.
fn exchange(graph: &mut Graph, monomial: &Monomial, out: &[(usize, i64)], extra: &[(Expr, i64)]) -> (Monomial, Rational) {
    let mut items = monomial.to_vec();
    for (position, power) in out {
        items[*position].1 = &items[*position].1 - &Rational::from(*power);
    }
    items.extend(extra.iter().map(|(e, n)| (*e, Rational::from(*n))));
    let e = graph.monomial(Rational::ONE, &items);
    factors_of(graph, e)
}

/// sin² + cos² and 1 - sin².
fn square_rule(graph: &mut Graph, polynomial: &mut Polynomial, (monomial, coefficient): (&Monomial, &Rational), w: Wave) -> bool {
    let partner_wave = graph.call(other(w.function), &[w.angle]);
    let (partner, _) = exchange(graph, monomial, &[(w.position, 2)], &[(partner_wave, 2)]);
    let (rest, _) = exchange(graph, monomial, &[(w.position, 2)], &[]);
    if polynomial.coefficient(&partner) == *coefficient {
        polynomial.remove(monomial);
        polynomial.remove(&partner);
        polynomial.push(rest, coefficient);
        return true;
    }
    if polynomial.coefficient(&rest) == -coefficient {
        polynomial.remove(monomial);
        polynomial.remove(&rest);
        polynomial.push(partner, &-coefficient);
        return true;
    }
    if w.exponent == 2 && w.function == Function::Cos && polynomial.coefficient(&partner) == -coefficient {
        let double = graph.scale(w.angle, &Rational::from(2));
        let wave = graph.call(Function::Cos, &[double]);
        polynomial.remove(monomial);
        polynomial.remove(&partner);
        push_product(graph, polynomial, &rest, wave, coefficient);
        return true;
    }
    false
}

/// Sums and differences of angles.
fn angle_rule(
    graph: &mut Graph,
    polynomial: &mut Polynomial,
    (monomial, coefficient): (&Monomial, &Rational),
    (a, b): (Wave, Wave),
) -> bool {
    if a.angle == b.angle {
        return false;
    }
    let (partner_a, partner_b) = (graph.call(other(a.function), &[a.angle]), graph.call(other(b.function), &[b.angle]));
    let out = [(a.position, 1), (b.position, 1)];
    let (partner, _) = exchange(graph, monomial, &out, &[(partner_a, 1), (partner_b, 1)]);
    let found = polynomial.coefficient(&partner);
    let same = found == *coefficient;
    if !same && found != -coefficient || found.is_zero() {
        return false;
    }
    let (sum, difference) = (graph.add(a.angle, b.angle), graph.sub(a.angle, b.angle));
    let (wave, negative) = match (a.function, b.function) {
        (Function::Cos, Function::Cos) => (graph.call(Function::Cos, &[if same { difference } else { sum }]), false),
        // written from the sine's side the opposite sign is -(cos a cos b - sin a sin b)
        (Function::Sin, Function::Sin) => (graph.call(Function::Cos, &[if same { difference } else { sum }]), !same),
        (Function::Sin, _) => (graph.call(Function::Sin, &[if same { sum } else { difference }]), false),
        _ => (graph.call(Function::Sin, &[if same { sum } else { difference }]), !same),
    };
    let (rest, _) = exchange(graph, monomial, &out, &[]);
    let coefficient = if negative { -coefficient } else { coefficient.clone() };
    polynomial.remove(monomial);
    polynomial.remove(&partner);
    push_product(graph, polynomial, &rest, wave, &coefficient);
    true
}

/// Adds coefficient·monomial·e; `e` may carry a sign or be a number.
fn push_product(graph: &mut Graph, polynomial: &mut Polynomial, monomial: &Monomial, e: Expr, coefficient: &Rational) {
    let mut items = monomial.to_vec();
    items.push((e, Rational::ONE));
    let product = graph.monomial(Rational::ONE, &items);
    let (monomial, factor) = factors_of(graph, product);
    polynomial.push(monomial, &(&factor * coefficient));
}

/// Whether a sine or cosine is a factor of some summand of `e`, so that multiplying the sum out can lead to a contraction.
pub(crate) fn has_wave(graph: &Graph, e: Expr) -> bool {
    let wave = |e: Expr| matches!(graph.node(e), Node::Call { function: Function::Sin | Function::Cos, .. });
    let factor = |e: Expr| match graph.node(e) {
        Node::Product { factors, .. } => factors.iter().any(|(b, _)| wave(*b)),
        _ => wave(e),
    };
    match graph.node(e) {
        // a sum below a product is opened on a later turn
        Node::Sum { terms, .. } => terms.iter().any(|(t, _)| factor(*t) || nested_wave(graph, *t)),
        _ => factor(e),
    }
}

fn nested_wave(graph: &Graph, e: Expr) -> bool {
    match graph.node(e) {
        Node::Product { factors, .. } => {
            factors.iter().any(|(b, x)| matches!(graph.node(*b), Node::Sum { .. }) && x.is_integer() && has_wave(graph, *b))
        }
        _ => false,
    }
}
