//! Canonical constructors: the only way to make expressions.
//!
//! Rules applied on construction: numbers fold exactly; sums and products are flattened, like terms and equal bases are collected and
//! sorted; a number times a sum is distributed; inside a product a sum carries no common numeric factor and its first term is
//! positive; odd and even functions carry no leading minus; multiples of π/2 are shifted out of sines and cosines. Nothing else is
//! expanded: `k (a - b)` and `(l - x)^2` stay as the user wrote them.

use crate::{Edge, Expr, Function, Graph, Node, Rational, SymbolId};

impl Graph {
    /// An exact number.
    pub fn number(&mut self, value: Rational) -> Expr {
        self.intern(Node::Number(value))
    }
    /// A whole number.
    pub fn int(&mut self, value: i64) -> Expr {
        self.number(value.into())
    }
    /// Zero.
    pub fn zero(&mut self) -> Expr {
        self.number(Rational::ZERO)
    }
    /// One.
    pub fn one(&mut self) -> Expr {
        self.number(Rational::ONE)
    }
    /// π.
    pub fn pi(&mut self) -> Expr {
        self.intern(Node::Pi)
    }
    /// The number that `e` is, if it is one.
    pub fn as_number(&self, e: Expr) -> Option<&Rational> {
        match self.node(e) {
            Node::Number(r) => Some(r),
            _ => None,
        }
    }
    /// The symbol that `e` is, if it is one.
    pub fn as_symbol(&self, e: Expr) -> Option<SymbolId> {
        match self.node(e) {
            Node::Symbol(s) => Some(*s),
            _ => None,
        }
    }
    /// Whether `e` is the number 0.
    pub fn is_zero(&self, e: Expr) -> bool {
        self.as_number(e).is_some_and(Rational::is_zero)
    }
    /// Whether `e` is the number 1.
    pub fn is_one(&self, e: Expr) -> bool {
        self.as_number(e).is_some_and(Rational::is_one)
    }

    /// a + b.
    pub fn add(&mut self, a: Expr, b: Expr) -> Expr {
        if self.is_zero(a) {
            return b;
        }
        if self.is_zero(b) {
            return a;
        }
        self.linear(Rational::ZERO, &[(a, Rational::ONE), (b, Rational::ONE)])
    }
    /// a - b.
    pub fn sub(&mut self, a: Expr, b: Expr) -> Expr {
        if self.is_zero(b) {
            return a;
        }
        self.linear(Rational::ZERO, &[(a, Rational::ONE), (b, Rational::MINUS_ONE)])
    }
    /// -a.
    pub fn neg(&mut self, a: Expr) -> Expr {
        self.scale(a, &Rational::MINUS_ONE)
    }
    /// Σ items.
    pub fn sum(&mut self, items: &[Expr]) -> Expr {
        let items: Vec<_> = items.iter().map(|e| (*e, Rational::ONE)).collect();
        self.linear(Rational::ZERO, &items)
    }
    /// factor·a.
    pub fn scale(&mut self, a: Expr, factor: &Rational) -> Expr {
        if factor.is_one() {
            return a;
        }
        self.linear(Rational::ZERO, &[(a, factor.clone())])
    }

    /// constant + Σ factor·item, in canonical form.
    pub fn linear(&mut self, mut constant: Rational, items: &[(Expr, Rational)]) -> Expr {
        let mut terms: Vec<(Expr, Rational)> = Vec::with_capacity(items.len());
        for (e, factor) in items {
            self.push_term(*e, factor, &mut constant, &mut terms);
        }
        collect_like(&mut terms);
        match (&terms[..], constant.is_zero()) {
            ([], _) => self.number(constant),
            ([(e, factor)], true) => {
                let (e, factor) = (*e, factor.clone());
                self.with_coefficient(e, factor)
            }
            _ => self.intern(Node::Sum { constant, terms: terms.into() }),
        }
    }

    fn push_term(&mut self, e: Expr, factor: &Rational, constant: &mut Rational, terms: &mut Vec<(Expr, Rational)>) {
        if factor.is_zero() {
            return;
        }
        match self.node(e) {
            Node::Number(r) => *constant = &*constant + &(r * factor),
            Node::Sum { constant: c, terms: inner } => {
                *constant = &*constant + &(c * factor);
                terms.extend(inner.iter().map(|(t, f)| (*t, f * factor)));
            }
            Node::Product { coefficient, factors } if !coefficient.is_one() => {
                let (scaled, factors) = (coefficient * factor, factors.clone());
                let bare = self.bare_product(&factors);
                terms.push((bare, scaled));
            }
            _ => terms.push((e, factor.clone())),
        }
    }

    /// The product of canonical factors with coefficient 1. A lone sum cannot occur: a number times a sum is distributed.
    fn bare_product(&mut self, factors: &[(Expr, Rational)]) -> Expr {
        match factors {
            [(base, exponent)] if exponent.is_one() => *base,
            _ => self.intern(Node::Product { coefficient: Rational::ONE, factors: factors.into() }),
        }
    }

    /// coefficient·e for a canonical term e (not a number, not a sum, coefficient 1).
    fn with_coefficient(&mut self, e: Expr, coefficient: Rational) -> Expr {
        if coefficient.is_one() {
            return e;
        }
        let factors = match self.node(e) {
            Node::Product { factors, .. } => factors.clone(),
            _ => Box::from([(e, Rational::ONE)]),
        };
        self.intern(Node::Product { coefficient, factors })
    }

    /// a·b.
    pub fn mul(&mut self, a: Expr, b: Expr) -> Expr {
        if self.is_one(a) {
            return b;
        }
        if self.is_one(b) {
            return a;
        }
        self.monomial(Rational::ONE, &[(a, Rational::ONE), (b, Rational::ONE)])
    }
    /// a/b.
    pub fn div(&mut self, a: Expr, b: Expr) -> Expr {
        self.monomial(Rational::ONE, &[(a, Rational::ONE), (b, Rational::MINUS_ONE)])
    }
    /// Π items.
    pub fn product(&mut self, items: &[Expr]) -> Expr {
        let items: Vec<_> = items.iter().map(|e| (*e, Rational::ONE)).collect();
        self.monomial(Rational::ONE, &items)
    }
    /// base^exponent for a rational exponent.
    pub fn pow(&mut self, base: Expr, exponent: &Rational) -> Expr {
        self.monomial(Rational::ONE, &[(base, exponent.clone())])
    }
    /// base².
    pub fn square(&mut self, base: Expr) -> Expr {
        self.pow(base, &Rational::from(2))
    }
    /// √base.
    pub fn sqrt(&mut self, base: Expr) -> Expr {
        self.pow(base, &Rational::HALF)
    }
    /// base^exponent.
    pub fn power(&mut self, base: Expr, exponent: Expr) -> Expr {
        if let Some(r) = self.as_number(exponent) {
            let r = r.clone();
            return self.pow(base, &r);
        }
        if self.is_one(base) {
            return base;
        }
        self.intern(Node::Power { base, exponent })
    }

    /// coefficient·Π base^exponent, in canonical form.
    pub fn monomial(&mut self, coefficient: Rational, items: &[(Expr, Rational)]) -> Expr {
        let mut coefficient = coefficient;
        let mut factors: Vec<(Expr, Rational)> = Vec::with_capacity(items.len());
        for (base, exponent) in items {
            self.push_factor(*base, exponent, &mut coefficient, &mut factors);
        }
        collect_like(&mut factors);
        self.settle_factors(&mut coefficient, &mut factors);
        if coefficient.is_zero() {
            return self.zero();
        }
        match &factors[..] {
            [] => self.number(coefficient),
            [(base, exponent)] if exponent.is_one() => {
                let base = *base;
                self.scale(base, &coefficient)
            }
            _ => self.intern(Node::Product { coefficient, factors: factors.into() }),
        }
    }

    fn push_factor(&mut self, base: Expr, exponent: &Rational, coefficient: &mut Rational, factors: &mut Vec<(Expr, Rational)>) {
        if exponent.is_zero() {
            return;
        }
        match self.node(base) {
            Node::Number(r) => match number_power(r, exponent) {
                Some(value) => *coefficient = &*coefficient * &value,
                None => factors.push((base, exponent.clone())),
            },
            Node::Product { coefficient: c, factors: inner } if exponent.is_integer() => {
                let (c, inner) = (c.clone(), inner.clone());
                for (b, e) in inner.iter() {
                    factors.push((*b, e * exponent));
                }
                if !c.is_one() {
                    let c = self.number(c);
                    self.push_factor(c, exponent, coefficient, factors);
                }
            }
            // (c x)^(1/2) = c^(1/2) x^(1/2) holds for positive c; the rest stays together under the root
            Node::Product { coefficient: c, factors: inner } if !c.is_negative() && !c.is_one() => {
                let (c, inner) = (c.clone(), inner.clone());
                let (c, bare) = (self.number(c), self.bare_product(&inner));
                self.push_factor(c, exponent, coefficient, factors);
                factors.push((bare, exponent.clone()));
            }
            Node::Call { function: Function::Exp, arguments } => {
                let argument = self.scale(arguments[0], exponent);
                let folded = self.call(Function::Exp, &[argument]);
                factors.push((folded, Rational::ONE));
            }
            _ => factors.push((base, exponent.clone())),
        }
    }

    /// After like bases are collected: numbers whose collected exponent became whole fold, roots of numbers keep exponents in (0, 1),
    /// products under a root that became a whole power open up, and sums give their common number to the coefficient.
    fn settle_factors(&mut self, coefficient: &mut Rational, factors: &mut Vec<(Expr, Rational)>) {
        let mut reopened = false;
        let mut settled: Vec<(Expr, Rational)> = Vec::with_capacity(factors.len());
        let alone = factors.len() == 1 && factors[0].1.is_one();
        for (base, exponent) in factors.drain(..) {
            match self.node(base) {
                Node::Number(r) if !r.is_zero() => {
                    let (r, whole) = (r.clone(), exponent.floor());
                    let fraction = &exponent - &whole;
                    match whole.to_i64().and_then(|n| r.pow(n)) {
                        Some(value) => {
                            *coefficient = &*coefficient * &value;
                            if !fraction.is_zero() {
                                settled.push((base, fraction));
                            }
                        }
                        None => settled.push((base, exponent)),
                    }
                }
                Node::Product { .. } if exponent.is_integer() => {
                    reopened = true;
                    self.push_factor(base, &exponent, coefficient, &mut settled);
                }
                Node::Sum { constant, terms } if exponent.is_integer() && !alone => {
                    let content = sum_content(constant, terms);
                    match exponent.to_i64().and_then(|n| content.pow(n)) {
                        Some(value) if !content.is_one() => {
                            *coefficient = &*coefficient * &value;
                            let inverse = &Rational::ONE / &content;
                            let base = self.scale(base, &inverse);
                            reopened |= true;
                            settled.push((base, exponent));
                        }
                        _ => settled.push((base, exponent)),
                    }
                }
                _ => settled.push((base, exponent)),
            }
        }
        if reopened {
            collect_like(&mut settled);
        }
        *factors = settled;
    }

    /// Whether the expression is written with a leading minus: a negative number, a product with negative coefficient, or a sum whose
    /// first term is negative.
    pub fn is_negative(&self, e: Expr) -> bool {
        match self.node(e) {
            Node::Number(r) => r.is_negative(),
            Node::Product { coefficient, .. } => coefficient.is_negative(),
            Node::Sum { terms, .. } => terms[0].1.is_negative(),
            _ => false,
        }
    }

    /// function(arguments).
    ///
    /// The number of arguments must be [`Function::arity`]; missing ones count as 0.
    pub fn call(&mut self, function: Function, arguments: &[Expr]) -> Expr {
        use Function::{Abs, Acos, Acosh, Asin, Asinh, Atan, Atan2, Atanh, Cos, Cosh, Exp, Log, Max, Min, Sign, Sin, Sinh, Tan, Tanh};
        let zero = self.zero();
        let x = arguments.first().copied().unwrap_or(zero);
        let y = arguments.get(1).copied().unwrap_or(zero);
        match function {
            Sin | Cos => return self.sine(function, x),
            Tan | Asin | Atan | Sinh | Tanh | Asinh | Atanh | Sign if self.is_negative(x) => {
                let positive = self.neg(x);
                let value = self.call(function, &[positive]);
                return self.neg(value);
            }
            Cosh | Abs if self.is_negative(x) => {
                let positive = self.neg(x);
                return self.call(function, &[positive]);
            }
            Tan | Asin | Atan | Sinh | Tanh | Asinh | Atanh | Sign | Abs if self.is_zero(x) => return zero,
            Cosh | Exp if self.is_zero(x) => return self.one(),
            Log | Acos | Acosh if self.is_one(x) => return zero,
            Abs | Sign => {
                if let Some(value) = self.fold_sign(function, x) {
                    return value;
                }
            }
            Min | Max => {
                if x == y {
                    return x;
                }
                if let (Some(a), Some(b)) = (self.as_number(x), self.as_number(y)) {
                    return if (a < b) == (function == Min) { x } else { y };
                }
                let (first, second) = if x < y { (x, y) } else { (y, x) };
                return self.intern(Node::Call { function, arguments: [first, second].into() });
            }
            Atan2 => return self.intern(Node::Call { function, arguments: [x, y].into() }),
            _ => {}
        }
        self.intern(Node::Call { function, arguments: [x].into() })
    }

    /// |x| and sign x of numbers and of numeric multiples.
    fn fold_sign(&mut self, function: Function, x: Expr) -> Option<Expr> {
        match self.node(x) {
            Node::Number(r) => {
                let value = if function == Function::Abs { r.abs() } else { Rational::ONE };
                Some(self.number(value))
            }
            Node::Pi => Some(if function == Function::Abs { x } else { self.one() }),
            Node::Product { coefficient, factors } if !coefficient.is_one() => {
                let (c, factors) = (coefficient.abs(), factors.clone());
                let bare = self.bare_product(&factors);
                let value = self.call(function, &[bare]);
                Some(if function == Function::Abs { self.scale(value, &c) } else { value })
            }
            _ => None,
        }
    }

    /// sin x and cos x: the multiple of π in x is reduced, whole multiples of π/2 are shifted out, and the leading minus too.
    fn sine(&mut self, function: Function, x: Expr) -> Expr {
        let (turns, rest) = self.split_pi(x);
        // x = rest + turns·π; quarter = round(2 turns) and what remains of turns lies in [-1/4, 1/4)
        let double = &turns * &Rational::from(2);
        let quarter = (&double + &Rational::HALF).floor();
        let left = &turns - &(&quarter * &Rational::HALF);
        let Some(quarter) = quarter.to_i64() else {
            return self.intern(Node::Call { function, arguments: [x].into() });
        };
        let pi = self.pi();
        let mut argument = self.linear(Rational::ZERO, &[(rest, Rational::ONE), (pi, left.clone())]);
        // cos x = sin(x + π/2)
        let phase = (quarter + i64::from(function == Function::Cos)).rem_euclid(4);
        let mut negative = phase >= 2;
        let base = if phase % 2 == 0 { Function::Sin } else { Function::Cos };
        if self.is_negative(argument) {
            argument = self.neg(argument);
            negative ^= base == Function::Sin;
        }
        let value = match self.special_sine(base, argument) {
            Some(value) => value,
            None => self.intern(Node::Call { function: base, arguments: [argument].into() }),
        };
        if negative { self.neg(value) } else { value }
    }

    /// x = rest + turns·π.
    fn split_pi(&mut self, x: Expr) -> (Rational, Expr) {
        let pi = self.pi();
        let turns = match self.node(x) {
            Node::Pi => Rational::ONE,
            Node::Product { coefficient, factors } if factors[..] == [(pi, Rational::ONE)] => coefficient.clone(),
            Node::Sum { terms, .. } => terms.iter().find(|(t, _)| *t == pi).map_or(Rational::ZERO, |(_, f)| f.clone()),
            _ => Rational::ZERO,
        };
        let rest = self.linear(Rational::ZERO, &[(x, Rational::ONE), (pi, -&turns)]);
        (turns, rest)
    }

    /// sin and cos of 0, π/6, π/4.
    fn special_sine(&mut self, function: Function, x: Expr) -> Option<Expr> {
        if self.is_zero(x) {
            return Some(if function == Function::Sin { self.zero() } else { self.one() });
        }
        let (turns, rest) = self.split_pi(x);
        if !self.is_zero(rest) {
            return None;
        }
        let half = self.number(Rational::HALF);
        match (turns.abs().digits().1.as_str(), function) {
            ("6", Function::Sin) => Some(half),
            ("6", _) => {
                let three = self.int(3);
                let root = self.sqrt(three);
                Some(self.mul(half, root))
            }
            ("4", _) => {
                let two = self.int(2);
                let root = self.sqrt(two);
                Some(self.mul(half, root))
            }
            _ => None,
        }
    }

    /// `then` on the side of the guard above its edge, else `otherwise`.
    pub fn switch(&mut self, guard: Expr, edge: Edge, then: Expr, otherwise: Expr) -> Expr {
        if then == otherwise {
            return then;
        }
        if let Some(r) = self.as_number(guard) {
            return if r.is_negative() || edge == Edge::Open && r.is_zero() { otherwise } else { then };
        }
        self.intern(Node::Switch { guard, edge, then, otherwise })
    }
}

/// r^exponent when that is an exact number.
fn number_power(r: &Rational, exponent: &Rational) -> Option<Rational> {
    if let Some(n) = exponent.to_i64() {
        return r.pow(n);
    }
    let (numerator, denominator) = exponent.digits();
    let root = r.root(denominator.parse().ok().filter(|d| *d <= 64)?)?;
    root.pow(numerator.parse().ok()?)
}

/// Sorts by expression, adds the numbers of equal ones, drops zeros.
fn collect_like(pairs: &mut Vec<(Expr, Rational)>) {
    if pairs.windows(2).any(|w| w[0].0 >= w[1].0) {
        pairs.sort_by_key(|p| p.0);
        pairs.dedup_by(|later, earlier| {
            let same = later.0 == earlier.0;
            if same {
                earlier.1 = &earlier.1 + &later.1;
            }
            same
        });
    }
    pairs.retain(|p| !p.1.is_zero());
}

/// The common number of a sum with the sign of its first term, so that sum/content has coprime whole factors, the first positive.
fn sum_content(constant: &Rational, terms: &[(Expr, Rational)]) -> Rational {
    let mut content = terms[0].1.abs();
    for factor in terms.iter().map(|t| &t.1).chain((!constant.is_zero()).then_some(constant)) {
        // sums of many masses have factors of one
        if content != *factor && !(content.is_one() && factor.is_integer()) {
            content = rational_gcd(&content, factor);
        }
    }
    if terms[0].1.is_negative() { -&content } else { content }
}

/// Greatest common divisor of two rationals, gcd(a/b, c/d) = gcd(ad, cb)/(bd).
pub(crate) fn rational_gcd(a: &Rational, b: &Rational) -> Rational {
    let (mut a, mut b) = (a.abs(), b.abs());
    if a == b || a == Rational::ONE && b.is_integer() {
        return a;
    }
    while !b.is_zero() {
        let quotient = (&a / &b).floor();
        (a, b) = (b.clone(), &a - &(&quotient * &b));
    }
    a
}
