//! Textbook form: what a teacher would write.
//!
//! [`Textbook::tidy`] multiplies out products only where that lets sines and cosines contract, collects terms with the same dependence
//! on motion, groups their constant coefficients with common factors in front, `(m1 + m2) l^2`, and recognises groups to which the
//! user has given a name, `M = M_h + M_r + m`.

use crate::build::rational_gcd;
use crate::polynomial::{Monomial, Polynomial, expand};
use crate::trigonometry::{contract, has_wave};
use crate::{Expr, Graph, Node, Rational, SymbolId};
use rustc_hash::{FxHashMap, FxHashSet};

/// Sums longer than this are not multiplied out.
const LARGEST_SUM: usize = 4000;

/// Sums longer than this are not tried in expanded form.
const LARGEST_SHORTENED: usize = 40;

/// The simplifier; remembers what it has simplified.
#[derive(Debug, Default)]
pub struct Textbook {
    constants: FxHashSet<SymbolId>,
    names: Vec<NamedSum>,
    constant_memo: FxHashMap<Expr, bool>,
    memo: FxHashMap<Expr, Expr>,
}

/// A name of the user's for a sum of constants.
#[derive(Debug)]
struct NamedSum {
    symbol: Expr,
    /// the sum divided by its common monomial, its first coefficient 1
    shape: Expr,
    /// sum = front·shape
    front: Expr,
}

impl Textbook {
    /// `constants` are the symbols that do not change with the motion; `names` are constant symbols with their formulas.
    pub fn new(graph: &mut Graph, constants: impl IntoIterator<Item = SymbolId>, names: &[(SymbolId, Expr)]) -> Textbook {
        let mut textbook = Textbook { constants: constants.into_iter().collect(), ..Textbook::default() };
        for (symbol, formula) in names {
            let Some(sum) = expand(graph, *formula, LARGEST_SUM, &|_, _| true) else { continue };
            let terms: Vec<_> = sum.terms().map(|(m, c)| (m.clone(), c.clone())).collect();
            if terms.len() < 2 {
                continue;
            }
            let (front, shape) = common_front(graph, &terms);
            let (front, shape) = unit_shape(graph, front, shape);
            let symbol = graph.symbol(*symbol);
            textbook.names.push(NamedSum { symbol, shape, front });
        }
        textbook
    }

    /// The textbook form of `e`: equal to it for all values of its symbols.
    pub fn tidy(&mut self, graph: &mut Graph, e: Expr) -> Expr {
        if let Some(&known) = self.memo.get(&e) {
            return known;
        }
        let tidied = self.tidy_new(graph, e);
        self.memo.insert(e, tidied);
        self.memo.insert(tidied, tidied);
        tidied
    }

    fn tidy_new(&mut self, graph: &mut Graph, e: Expr) -> Expr {
        if !matches!(graph.node(e), Node::Sum { .. } | Node::Product { .. }) {
            return e;
        }
        let Some(mut polynomial) = expand(graph, e, LARGEST_SUM, &has_wave) else { return e };
        contract(graph, &mut polynomial);
        self.group(graph, &polynomial)
    }

    /// [`Textbook::tidy`], and all sums without waves multiplied out as well where that leaves fewer terms: c (a - x) - c a is -c x, but
    /// c (a - x) stays.
    pub fn shortest(&mut self, graph: &mut Graph, e: Expr) -> Expr {
        let tidied = self.tidy(graph, e);
        let Node::Sum { terms, constant } = graph.node(tidied) else { return tidied };
        let length = terms.len() + usize::from(!constant.is_zero());
        if length > LARGEST_SHORTENED {
            return tidied;
        }
        let Some(mut polynomial) = expand(graph, tidied, LARGEST_SUM, &|_, _| true) else { return tidied };
        contract(graph, &mut polynomial);
        let opened = self.group(graph, &polynomial);
        let (count, zero) = match graph.node(opened) {
            Node::Sum { terms, constant } => (terms.len() + usize::from(!constant.is_zero()), false),
            Node::Number(r) => (1, r.is_zero()),
            _ => (1, false),
        };
        if zero || count < length { opened } else { tidied }
    }

    /// Collects terms with equal varying part; their constants become one grouped coefficient.
    fn group(&mut self, graph: &mut Graph, polynomial: &Polynomial) -> Expr {
        let mut groups: Vec<(Monomial, Vec<(Monomial, Rational)>)> = Vec::new();
        let mut index: FxHashMap<Monomial, usize> = FxHashMap::default();
        for (monomial, coefficient) in polynomial.terms() {
            let (constant, varying) = self.split(graph, monomial);
            let i = *index.entry(varying.clone()).or_insert_with(|| {
                groups.push((varying, Vec::new()));
                groups.len() - 1
            });
            groups[i].1.push((constant, coefficient.clone()));
        }
        let mut terms = Vec::with_capacity(groups.len());
        for (varying, constants) in &groups {
            let coefficient = self.coefficient(graph, constants);
            let varying = joined(graph, varying);
            terms.push(graph.mul(coefficient, varying));
        }
        graph.sum(&terms)
    }

    /// monomial = constant·varying.
    fn split(&mut self, graph: &Graph, monomial: &Monomial) -> (Monomial, Monomial) {
        let (constant, varying): (Vec<_>, Vec<_>) = monomial.iter().cloned().partition(|(base, _)| self.is_constant(graph, *base));
        (constant.into(), varying.into())
    }

    /// `e` with the constants common to all its terms in front: m/2 (x'^2 + y'^2).
    pub fn factored(&mut self, graph: &mut Graph, e: Expr) -> Expr {
        let Some(sum) = expand(graph, e, LARGEST_SUM, &|_, _| false) else { return e };
        let terms: Vec<(Monomial, Rational)> = sum.terms().map(|(m, c)| (m.clone(), c.clone())).collect();
        if terms.len() < 2 {
            return e;
        }
        let constants: Vec<Monomial> = terms.iter().map(|(m, _)| self.split(graph, m).0).collect();
        let mut common: Vec<(Expr, Rational)> = constants[0].to_vec();
        common.retain(|(base, exponent)| constants.iter().all(|m| m.iter().any(|(b, x)| b == base && x == exponent)));
        let content = terms.iter().fold(Rational::ZERO, |g, (_, c)| rational_gcd(&g, c));
        let inverse = common.iter().map(|(b, x)| (*b, -x));
        let rest: Vec<(Expr, Rational)> = terms
            .iter()
            .map(|(m, c)| {
                let items: Vec<_> = m.iter().cloned().chain(inverse.clone()).collect();
                (graph.monomial(Rational::ONE, &items), c / &content)
            })
            .collect();
        let rest = graph.linear(Rational::ZERO, &rest);
        common.push((rest, Rational::ONE));
        graph.monomial(content, &common)
    }

    /// Whether only constant symbols occur in `e`.
    pub fn is_constant(&mut self, graph: &Graph, e: Expr) -> bool {
        for e in graph.pending(&[e], &self.constant_memo) {
            let mut constant = graph.as_symbol(e).is_none_or(|s| self.constants.contains(&s));
            graph.for_each_child(e, |c| constant &= self.constant_memo[&c]);
            self.constant_memo.insert(e, constant);
        }
        self.constant_memo[&e]
    }

    /// Σ of constant monomials: common factors in front of a sum, or the user's name for it.
    fn coefficient(&mut self, graph: &mut Graph, terms: &[(Monomial, Rational)]) -> Expr {
        if let [(monomial, coefficient)] = terms {
            let has_sum = !self.names.is_empty() && monomial.iter().any(|(b, _)| matches!(graph.node(*b), Node::Sum { .. }));
            if !has_sum {
                return graph.monomial(coefficient.clone(), monomial);
            }
        }
        let plain = self.plain_terms(graph, terms);
        let (front, shape) = common_front(graph, &plain);
        let (unit_front, unit_shape) = if self.names.is_empty() { (front, shape) } else { unit_shape(graph, front, shape) };
        for named in &self.names {
            if named.shape == unit_shape {
                // front·shape = (front / named.front)·symbol
                let items = [(unit_front, Rational::ONE), (named.front, Rational::MINUS_ONE), (named.symbol, Rational::ONE)];
                return graph.monomial(Rational::ONE, &items);
            }
        }
        graph.mul(front, shape)
    }

    /// Sums that are factors of constants, `(m1 + m2) g l + m3 g l`, are opened so that they can join.
    fn plain_terms(&self, graph: &mut Graph, terms: &[(Monomial, Rational)]) -> Vec<(Monomial, Rational)> {
        let opened = terms.iter().any(|(m, _)| m.iter().any(|(b, _)| matches!(graph.node(*b), Node::Sum { .. })));
        if !opened {
            return terms.to_vec();
        }
        let items: Vec<(Expr, Rational)> = terms.iter().map(|(m, c)| (graph.monomial(Rational::ONE, m), c.clone())).collect();
        let mut sum = Polynomial::default();
        for (e, c) in &items {
            match expand(graph, *e, LARGEST_SUM, &|_, _| true) {
                Some(part) => part.terms().for_each(|(m, f)| sum.push(m.clone(), &(f * c))),
                None => return terms.to_vec(),
            }
        }
        sum.terms().map(|(m, c)| (m.clone(), c.clone())).collect()
    }
}

/// Deepest chain of cases that is joined.
const DEEPEST: usize = 8;

/// The monomial, switches of the same cases multiplied case by case: {a, g > 0; b}·{c, g > 0; d} is {a c, g > 0; b d}.
fn joined(graph: &mut Graph, monomial: &Monomial) -> Expr {
    let is_switch = |(base, exponent): &&(Expr, Rational)| matches!(graph.node(*base), Node::Switch { .. }) && exponent == &Rational::ONE;
    let (switches, mut rest): (Vec<_>, Vec<_>) = monomial.iter().cloned().partition(|f| is_switch(&f));
    let mut kept: Vec<Expr> = Vec::new();
    for (switch, _) in switches {
        let fitting = kept.iter().enumerate().find_map(|(i, other)| Some((i, merged(graph, [*other, switch], DEEPEST)?)));
        match fitting {
            Some((i, product)) => kept[i] = product,
            None => kept.push(switch),
        }
    }
    rest.extend(kept.into_iter().map(|e| (e, Rational::ONE)));
    graph.monomial(Rational::ONE, &rest)
}

/// The product of two switches of one guard.
fn merged(graph: &mut Graph, [a, b]: [Expr; 2], depth: usize) -> Option<Expr> {
    let cases = |e: Expr| match graph.node(e) {
        Node::Switch { guard, edge, then, otherwise } => Some(((*guard, *edge), [*then, *otherwise])),
        _ => None,
    };
    let (((guard, edge), [t, o]), (other, [u, p])) = (cases(a)?, cases(b)?);
    if (guard, edge) != other || depth == 0 {
        return None;
    }
    let mut multiplied = |x: Expr, y: Expr| {
        merged(graph, [x, y], depth - 1).unwrap_or_else(|| {
            let product = graph.mul(x, y);
            graph.expanded(product, LARGEST_SHORTENED).unwrap_or(product)
        })
    };
    let (then, otherwise) = (multiplied(t, u), multiplied(o, p));
    Some(graph.switch(guard, edge, then, otherwise))
}

/// Σ terms = front·shape: front is the common monomial times the first coefficient.
fn common_front(graph: &mut Graph, terms: &[(Monomial, Rational)]) -> (Expr, Expr) {
    let Some((first, scale)) = terms.first() else {
        return (graph.one(), graph.zero());
    };
    let scale = common_number(terms, scale);
    let mut common: Vec<(Expr, Rational)> = Vec::new();
    for (base, exponent) in first.iter() {
        let exponents: Option<Vec<&Rational>> = terms.iter().map(|(m, _)| m.iter().find(|(b, _)| b == base).map(|(_, x)| x)).collect();
        let Some(exponents) = exponents else { continue };
        let smallest = exponents.iter().min_by_key(|x| x.abs()).copied().unwrap_or(exponent);
        if exponents.iter().all(|x| x.is_negative() == smallest.is_negative()) {
            common.push((*base, smallest.clone()));
        }
    }
    let inverse: Vec<(Expr, Rational)> = common.iter().map(|(b, x)| (*b, -x)).collect();
    let rest: Vec<(Expr, Rational)> = terms
        .iter()
        .map(|(m, c)| {
            let items: Vec<_> = m.iter().cloned().chain(inverse.iter().cloned()).collect();
            (graph.monomial(Rational::ONE, &items), c / &scale)
        })
        .collect();
    (graph.monomial(scale.clone(), &common), graph.linear(Rational::ZERO, &rest))
}

/// Moves the number of the first term of `shape` to the front, so that proportional sums have one shape.
fn unit_shape(graph: &mut Graph, front: Expr, shape: Expr) -> (Expr, Expr) {
    let Node::Sum { terms, .. } = graph.node(shape) else { return (front, shape) };
    let number = terms[0].1.clone();
    let Some(inverse) = number.recip() else { return (front, shape) };
    (graph.scale(front, &number), graph.scale(shape, &inverse))
}

/// The number to take out: the common one when all coefficients have the same size, else none (but the sign of an all-negative sum).
fn common_number(terms: &[(Monomial, Rational)], first: &Rational) -> Rational {
    if terms.iter().all(|(_, c)| c.abs() == first.abs()) {
        let negative = terms.iter().all(|(_, c)| c.is_negative());
        return if negative { first.clone() } else { first.abs() };
    }
    let halves = terms.iter().all(|(_, c)| (c * &Rational::from(2)).is_integer()) && terms.iter().any(|(_, c)| !c.is_integer());
    if halves && terms.iter().all(|(_, c)| !c.is_integer()) { Rational::HALF } else { Rational::ONE }
}

impl Graph {
    /// Multiplies everything out; `None` when the result would have more than `limit` terms.
    pub fn expanded(&mut self, e: Expr, limit: usize) -> Option<Expr> {
        expand(self, e, limit, &|_, _| true).map(|p| p.to_expression(self))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Edge, Function};

    struct Desk {
        g: Graph,
        t: Textbook,
    }
    impl Desk {
        fn new(constants: &[&str]) -> Desk {
            let mut g = Graph::new();
            let ids: Vec<_> = constants.iter().map(|c| g.symbol_id(c, 0)).collect();
            let t = Textbook::new(&mut g, ids, &[]);
            Desk { g, t }
        }
        fn cos(&mut self, x: Expr) -> Expr {
            self.g.call(Function::Cos, &[x])
        }
        fn sin(&mut self, x: Expr) -> Expr {
            self.g.call(Function::Sin, &[x])
        }
    }

    #[test]
    fn addition_theorems_run_backwards() {
        let mut d = Desk::new(&["l"]);
        let (a, b, l) = (d.g.var("a"), d.g.var("b"), d.g.var("l"));
        let (ca, cb, sa, sb) = (d.cos(a), d.cos(b), d.sin(a), d.sin(b));
        let (cc, ss) = (d.g.product(&[l, ca, cb]), d.g.product(&[l, sa, sb]));
        let sum = d.g.add(cc, ss);
        let expected = {
            let x = d.g.sub(a, b);
            let c = d.cos(x);
            d.g.mul(l, c)
        };
        assert_eq!(d.t.tidy(&mut d.g, sum), expected);
        let difference = d.g.sub(cc, ss);
        let expected = {
            let x = d.g.add(a, b);
            let c = d.cos(x);
            d.g.mul(l, c)
        };
        assert_eq!(d.t.tidy(&mut d.g, difference), expected);
        let (sc, cs) = (d.g.mul(sa, cb), d.g.mul(ca, sb));
        let e = d.g.sub(cs, sc);
        let expected = {
            let x = d.g.sub(b, a);
            d.sin(x)
        };
        assert_eq!(d.t.tidy(&mut d.g, e), expected);
    }

    #[test]
    fn a_sum_without_waves_stays_a_factor() {
        let mut d = Desk::new(&["m", "l0", "k"]);
        let (m, l0, k, x, phi) = (d.g.var("m"), d.g.var("l0"), d.g.var("k"), d.g.var("x"), d.g.var("phi"));
        let kx = d.g.mul(k, x);
        let l = d.g.sub(l0, kx);
        let (c, s) = (d.cos(phi), d.sin(phi));
        let (u, v) = (d.g.mul(l, c), d.g.mul(l, s));
        let (uu, vv) = (d.g.square(u), d.g.square(v));
        let length = d.g.add(uu, vv);
        let e = d.g.mul(m, length);
        let expected = {
            let ll = d.g.square(l);
            d.g.mul(m, ll)
        };
        assert_eq!(d.t.tidy(&mut d.g, e), expected);
    }

    /// The force of a spring with play: c g g' with g and g' of the same three cases.
    #[test]
    fn switches_of_the_same_cases_multiply_case_by_case() {
        let mut d = Desk::new(&["c", "h"]);
        let (c, h, x) = (d.g.var("c"), d.g.var("h"), d.g.var("x"));
        let (zero, one) = (d.g.zero(), d.g.one());
        let minus = d.g.neg(one);
        let (above, below) = (d.g.sub(x, h), d.g.add(x, h));
        let low = d.g.neg(below);
        let chain = |d: &mut Desk, a: Expr, b: Expr| {
            let inner = d.g.switch(low, Edge::Open, b, zero);
            d.g.switch(above, Edge::Open, a, inner)
        };
        let (gap, slope) = (chain(&mut d, above, low), chain(&mut d, one, minus));
        let force = d.g.product(&[c, gap, slope]);
        let expected = {
            let cases = chain(&mut d, above, below);
            d.g.mul(c, cases)
        };
        assert_eq!(d.t.tidy(&mut d.g, force), expected);
        // other cases stay a product
        let other = d.g.switch(x, Edge::Open, one, zero);
        let mixed = d.g.product(&[gap, other]);
        assert_eq!(d.t.tidy(&mut d.g, mixed), mixed);
    }

    #[test]
    fn masses_group_and_take_the_users_name() {
        let mut g = Graph::new();
        let (m1, m2, l, y) = (g.var("m1"), g.var("m2"), g.var("l"), g.var("y"));
        let ids: Vec<SymbolId> = ["m1", "m2", "l", "M"].iter().map(|n| g.symbol_id(n, 0)).collect();
        let total = g.add(m1, m2);
        let mut plain = Textbook::new(&mut g, ids.clone(), &[]);
        let (a, b) = (g.product(&[m1, l, y]), g.product(&[m2, l, y]));
        let e = g.add(a, b);
        let grouped = g.product(&[total, l, y]);
        assert_eq!(plain.tidy(&mut g, e), grouped);
        let mut named = Textbook::new(&mut g, ids.clone(), &[(ids[3], total)]);
        let big = g.var("M");
        let folded = g.product(&[big, l, y]);
        assert_eq!(named.tidy(&mut g, e), folded);
    }

    #[test]
    fn product_of_rotations_is_one_rotation() {
        // (cos a, sin a) turned by b and back: the square of the length is 1 whatever the order of operations
        let mut d = Desk::new(&[]);
        let (a, b) = (d.g.var("a"), d.g.var("b"));
        let (ca, sa, cb, sb) = (d.cos(a), d.sin(a), d.cos(b), d.sin(b));
        let (p, q) = (d.g.mul(ca, cb), d.g.mul(sa, sb));
        let x = d.g.sub(p, q);
        let (p, q) = (d.g.mul(sa, cb), d.g.mul(ca, sb));
        let y = d.g.add(p, q);
        let (xx, yy) = (d.g.square(x), d.g.square(y));
        let e = d.g.add(xx, yy);
        let tidied = d.t.tidy(&mut d.g, e);
        assert!(d.g.is_one(tidied));
    }
}
