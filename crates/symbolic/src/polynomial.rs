//! Sums of monomials, the working form of textbook simplification.
//!
//! A monomial is a list of (base, exponent) as in [`Node::Product`]; bases are anything that is not multiplied out. Terms keep the
//! order in which they were met, so results do not depend on hashing.

use crate::{Expr, Graph, Node, Rational};
use rustc_hash::FxHashMap;

/// (base, exponent), sorted by base: the factors of a product without its number.
pub(crate) type Monomial = Box<[(Expr, Rational)]>;

/// Σ coefficient·monomial.
#[derive(Clone, Debug, Default)]
pub(crate) struct Polynomial {
    terms: Vec<(Monomial, Rational)>,
    index: FxHashMap<Monomial, usize>,
}

impl Polynomial {
    /// Adds coefficient·monomial.
    pub fn push(&mut self, monomial: Monomial, coefficient: &Rational) {
        match self.index.get(&monomial) {
            Some(&i) => self.terms[i].1 = &self.terms[i].1 + coefficient,
            None => {
                self.index.insert(monomial.clone(), self.terms.len());
                self.terms.push((monomial, coefficient.clone()));
            }
        }
    }

    /// The coefficient of a monomial, zero when it does not occur.
    pub fn coefficient(&self, monomial: &[(Expr, Rational)]) -> Rational {
        self.index.get(monomial).map_or(Rational::ZERO, |&i| self.terms[i].1.clone())
    }

    /// Removes a monomial.
    pub fn remove(&mut self, monomial: &[(Expr, Rational)]) {
        if let Some(&i) = self.index.get(monomial) {
            self.terms[i].1 = Rational::ZERO;
        }
    }

    /// Number of slots, including vanished terms.
    pub fn slots(&self) -> usize {
        self.terms.len()
    }
    /// The term in a slot, unless it has vanished.
    pub fn slot(&self, i: usize) -> Option<(&Monomial, &Rational)> {
        let (monomial, coefficient) = &self.terms[i];
        (!coefficient.is_zero()).then_some((monomial, coefficient))
    }
    /// The terms that have not vanished.
    pub fn terms(&self) -> impl Iterator<Item = (&Monomial, &Rational)> {
        (0..self.slots()).filter_map(|i| self.slot(i))
    }

    /// As an expression.
    pub fn to_expression(&self, graph: &mut Graph) -> Expr {
        let terms: Vec<(Expr, Rational)> = self
            .terms()
            .map(|(m, c)| (m.clone(), c.clone()))
            .collect::<Vec<_>>()
            .into_iter()
            .map(|(m, c)| (graph.monomial(Rational::ONE, &m), c))
            .collect();
        graph.linear(Rational::ZERO, &terms)
    }
}

/// e = coefficient·monomial.
pub(crate) fn factors_of(graph: &Graph, e: Expr) -> (Monomial, Rational) {
    match graph.node(e) {
        Node::Number(r) => (Box::default(), r.clone()),
        Node::Product { coefficient, factors } => (factors.clone(), coefficient.clone()),
        _ => (Box::from([(e, Rational::ONE)]), Rational::ONE),
    }
}

/// Multiplies out the sums for which `open` holds, as long as the result has at most `limit` terms; `None` beyond.
pub(crate) fn expand(graph: &mut Graph, e: Expr, limit: usize, open: &dyn Fn(&Graph, Expr) -> bool) -> Option<Polynomial> {
    let mut out = Polynomial::default();
    let mut work: Vec<(Expr, Rational)> = vec![(e, Rational::ONE)];
    while let Some((e, scale)) = work.pop() {
        if let Node::Sum { constant, terms } = graph.node(e) {
            if !constant.is_zero() {
                out.push(Box::default(), &(constant * &scale));
            }
            work.extend(terms.iter().rev().map(|(t, f)| (*t, f * &scale)));
            continue;
        }
        let (monomial, coefficient) = factors_of(graph, e);
        let scale = &scale * &coefficient;
        let opening = monomial.iter().position(|(base, exponent)| {
            exponent.to_i64().is_some_and(|n| (1..=8).contains(&n)) && matches!(graph.node(*base), Node::Sum { .. }) && open(graph, *base)
        });
        let Some(i) = opening else {
            out.push(monomial, &scale);
            if out.slots() > limit {
                return None;
            }
            continue;
        };
        let (base, exponent) = monomial[i].clone();
        let mut rest = monomial.to_vec();
        rest[i].1 = &exponent - &Rational::ONE;
        let rest = graph.monomial(Rational::ONE, &rest);
        let Node::Sum { constant, terms } = graph.node(base).clone() else { continue };
        if work.len() + terms.len() > limit {
            return None;
        }
        for (t, f) in terms.iter().rev() {
            work.push((graph.mul(rest, *t), f * &scale));
        }
        if !constant.is_zero() {
            work.push((rest, &constant * &scale));
        }
    }
    Some(out)
}
