//! Functions with the sign of a guard, without its poles and without its roots of fractional order.
//!
//! Of a guard only the sign counts. tan x > 0 changes its side through a pole, which no step leads over, although the sign there is that of sin x cos x; and
//! |x|^2.5 sign x leaves zero so flat that no series tells when. So
//!
//! - a product is the product of functions with the signs of its factors: a power counts by its parity, a fractional power (of what is not negative) once,
//!   |u|^p sign u as u;
//! - a sum over denominators that may vanish is one fraction N/Π Dᵖ, and has the sign of N times the D with odd p. A pole of even order changes no sign.
//!
//! Denominators over parameters only are left where they are: they do not move.

use super::expressions::{Lowering, Source};
use super::forms::Value;
use symbolic::{Expr, Function, Node, Rational};

/// Deepest nesting that is looked into: quotients of quotients by hand have a few levels, and what lies deeper stays as it is written.
const DEPTH: u32 = 16;

/// What stands in a denominator.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Divisor {
    /// The numerator of this formula.
    Formula(Expr),
    /// The cosine under a tangent.
    Cosine(Expr),
}

/// top/Π Dᵖ.
struct Fraction {
    top: Value,
    bottom: Vec<(Divisor, i64)>,
}

impl Lowering<'_, '_> {
    /// A value with the sign of left − right whose way through zero can be followed; none where the difference itself is one. Both are lowered already.
    pub(super) fn sign_of(&mut self, left: Expr, right: Option<Expr>) -> Option<Value> {
        let Some(right) = right else {
            return self.is_awkward(left, DEPTH).then(|| self.signed(left, DEPTH));
        };
        if ![left, right].iter().any(|e| self.is_fraction(*e, DEPTH)) {
            return None;
        }
        let terms = [(left, 1.0), (right, -1.0)].map(|(e, factor)| (factor, self.fraction(e, DEPTH)));
        let whole = self.added(0.0, &terms);
        Some(self.cleared(whole))
    }

    /// Whether the sign of a formula is better found from another one.
    fn is_awkward(&self, e: Expr, depth: u32) -> bool {
        if depth == 0 {
            return false;
        }
        match self.graph().node(e) {
            Node::Symbol(s) => self.definition(*s).is_some_and(|formula| self.is_awkward(formula, depth - 1)),
            Node::Product { factors, .. } => {
                let fractional = factors.iter().any(|(base, p)| !p.is_integer() && !self.is_still(*base));
                fractional && factors.iter().any(|(_, p)| p.is_integer()) || self.is_fraction(e, depth)
            }
            _ => self.is_fraction(e, depth),
        }
    }

    /// Whether a formula has a denominator that may vanish.
    fn is_fraction(&self, e: Expr, depth: u32) -> bool {
        if depth == 0 || self.is_still(e) {
            return false;
        }
        match self.graph().node(e) {
            Node::Symbol(s) => self.definition(*s).is_some_and(|formula| self.is_fraction(formula, depth - 1)),
            Node::Sum { terms, .. } => terms.iter().any(|(term, _)| self.is_fraction(*term, depth - 1)),
            Node::Product { factors, .. } => factors
                .iter()
                .any(|(base, p)| p.is_integer() && (p.is_negative() && !self.is_still(*base) || self.is_fraction(*base, depth - 1))),
            Node::Call { function: Function::Tan, .. } => true,
            _ => false,
        }
    }

    /// A value with the sign of a formula.
    fn signed(&mut self, e: Expr, depth: u32) -> Value {
        if depth == 0 {
            return self.known(e);
        }
        match self.graph().node(e) {
            Node::Symbol(s) => match self.definition(*s) {
                Some(formula) => self.signed(formula, depth - 1),
                None => self.known(e),
            },
            Node::Product { coefficient, factors } => {
                let sign = if coefficient.is_negative() { -1.0 } else { 1.0 };
                let factors = factors.clone();
                let first = self.literal(sign);
                factors.iter().fold(first, |product, (base, p)| self.with_sign_of(product, (*base, p), &factors, depth))
            }
            _ => {
                let whole = self.fraction(e, depth);
                self.cleared(whole)
            }
        }
    }

    /// A product and one more factor by its sign.
    fn with_sign_of(&mut self, product: Value, (base, p): (Expr, &Rational), among: &[(Expr, Rational)], depth: u32) -> Value {
        let has = |function: Function, of: Expr| {
            let mut inside = among.iter().map(|(other, _)| *other);
            inside.any(|other| self.argument(other, function) == Some(of))
        };
        if self.argument(base, Function::Abs).is_some_and(|u| has(Function::Sign, u)) {
            return product;
        }
        let one = match self.argument(base, Function::Sign) {
            Some(u) if has(Function::Abs, u) => self.known(u),
            _ if p.is_integer() => self.signed(base, depth - 1),
            _ => self.known(base),
        };
        let once = self.times(product, one);
        if p.to_i64().is_some_and(|p| p % 2 == 0) { self.times(once, one) } else { once }
    }

    /// The argument of a call of that function.
    fn argument(&self, e: Expr, wanted: Function) -> Option<Expr> {
        match self.graph().node(e) {
            Node::Call { function, arguments } if *function == wanted => arguments.first().copied(),
            _ => None,
        }
    }

    fn fraction(&mut self, e: Expr, depth: u32) -> Fraction {
        if !self.is_fraction(e, depth) {
            return Fraction { top: self.known(e), bottom: Vec::new() };
        }
        match self.graph().node(e).clone() {
            Node::Symbol(s) => match self.definition(s) {
                Some(formula) => self.fraction(formula, depth - 1),
                None => Fraction { top: self.known(e), bottom: Vec::new() },
            },
            Node::Sum { constant, terms } => {
                let terms: Vec<_> = terms.iter().map(|(term, factor)| (factor.to_f64(), self.fraction(*term, depth - 1))).collect();
                self.added(constant.to_f64(), &terms)
            }
            Node::Product { coefficient, factors } => self.multiplied(coefficient.to_f64(), &factors, depth),
            // the tangent: nothing else is a fraction
            Node::Call { arguments, .. } => {
                let u = self.known(arguments[0]);
                Fraction { top: self.smooth(Function::Sin, u), bottom: vec![(Divisor::Cosine(arguments[0]), 1)] }
            }
            _ => Fraction { top: self.known(e), bottom: Vec::new() },
        }
    }

    /// coefficient·Π base^p as one fraction.
    fn multiplied(&mut self, coefficient: f64, factors: &[(Expr, Rational)], depth: u32) -> Fraction {
        let mut whole = Fraction { top: self.literal(coefficient), bottom: Vec::new() };
        for (base, p) in factors {
            let value = self.known(*base);
            let Some(power) = p.to_i64().filter(|_| !self.is_still(*base)) else {
                let factor = self.power(value, p);
                whole.top = self.times(whole.top, factor);
                continue;
            };
            let inner = self.fraction(*base, depth - 1);
            let above = if power > 0 { inner.top } else { self.divisors(&inner.bottom) };
            let above = self.power(above, &p.abs());
            whole.top = self.times(whole.top, above);
            match power > 0 {
                true => inner.bottom.iter().for_each(|(divisor, n)| put(&mut whole.bottom, *divisor, n * power)),
                false => put(&mut whole.bottom, Divisor::Formula(*base), -power),
            }
        }
        whole
    }

    /// constant + Σ factor·fraction over the common denominator.
    fn added(&mut self, constant: f64, terms: &[(f64, Fraction)]) -> Fraction {
        let mut common: Vec<(Divisor, i64)> = Vec::new();
        for (divisor, n) in terms.iter().flat_map(|(_, fraction)| &fraction.bottom) {
            match common.iter_mut().find(|(other, _)| other == divisor) {
                Some((_, most)) => *most = (*most).max(*n),
                None => common.push((*divisor, *n)),
            }
        }
        let all = self.divisors(&common);
        let mut items = vec![(constant, all)];
        for (factor, fraction) in terms {
            let own = |divisor: Divisor| fraction.bottom.iter().find(|(other, _)| *other == divisor).map_or(0, |(_, n)| *n);
            let missing: Vec<_> = common.iter().map(|(divisor, n)| (*divisor, n - own(*divisor))).filter(|(_, n)| *n > 0).collect();
            let missing = self.divisors(&missing);
            items.push((*factor, self.times(fraction.top, missing)));
        }
        Fraction { top: self.sum(&items), bottom: common }
    }

    /// A value with the sign of a fraction.
    fn cleared(&mut self, fraction: Fraction) -> Value {
        let odd: Vec<_> = fraction.bottom.iter().filter(|(_, n)| n % 2 != 0).map(|(divisor, _)| (*divisor, 1)).collect();
        let odd = self.divisors(&odd);
        self.times(fraction.top, odd)
    }

    /// Π Dᵖ.
    fn divisors(&mut self, list: &[(Divisor, i64)]) -> Value {
        let mut product = self.literal(1.0);
        for (divisor, n) in list {
            let value = match *divisor {
                Divisor::Formula(e) => self.fraction(e, DEPTH).top,
                Divisor::Cosine(e) => {
                    let u = self.known(e);
                    self.smooth(Function::Cos, u)
                }
            };
            for _ in 0..*n {
                product = self.times(product, value);
            }
        }
        product
    }

    /// The formula that a symbol stands for.
    fn definition(&self, s: symbolic::SymbolId) -> Option<Expr> {
        match self.source(s) {
            Some(Source::Definition(formula)) => Some(formula),
            _ => None,
        }
    }
}

fn put(bottom: &mut Vec<(Divisor, i64)>, divisor: Divisor, n: i64) {
    match bottom.iter_mut().find(|(other, _)| *other == divisor) {
        Some((_, all)) => *all += n,
        None => bottom.push((divisor, n)),
    }
}
