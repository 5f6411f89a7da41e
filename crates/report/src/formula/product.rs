//! Products: signs, fractions, powers, functions.

use super::classes::SymbolClass;
use super::compose::Composer;
use super::language;
use super::layout::{Bare, Bracket, Layout, Sign};
use super::numeral::Numeral;
use super::order::Side;
use super::text;
use symbolic::{Expr, Function, Node, Rational};

/// A factor on its way to print.
struct Factor {
    base: Expr,
    exponent: Rational,
    /// A minus: the base (or the argument of a function) is printed with the opposite sign; the sign of the product accounts for it.
    sign: Sign,
    /// A sum is printed multiplied by this; the coefficient of the product accounts for it.
    scale: Rational,
    /// How the base is taken.
    taken: Taken,
}

/// How the base of a factor is taken.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Taken {
    /// As it is.
    Whole,
    /// Without its sign: the root of its square.
    Size,
    /// Its sign alone: what is left of it over its size.
    Sign,
}

impl Factor {
    fn new(base: Expr, exponent: &Rational) -> Factor {
        Factor { base, exponent: exponent.clone(), sign: Sign::Plus, scale: Rational::ONE, taken: Taken::Whole }
    }
    fn is_even(&self) -> bool {
        self.exponent.to_i64().is_some_and(|n| n % 2 == 0)
    }
}

/// Factors of one base as one power: what roots left beside what stood there.
fn merge_equal(factors: &mut Vec<Factor>) {
    let mut i = 0;
    while i < factors.len() {
        let alike = |f: &Factor| f.base == factors[i].base && f.taken == Taken::Whole;
        let other = factors[i + 1..].iter().position(alike).filter(|_| factors[i].taken == Taken::Whole);
        match other {
            Some(k) => {
                let exponent = factors.remove(i + 1 + k).exponent;
                factors[i].exponent = &factors[i].exponent + &exponent;
            }
            None => i += 1,
        }
    }
    factors.retain(|f| !f.exponent.is_zero());
}

impl Composer<'_> {
    /// coefficient·Π base^exponent as a sign and a positive body.
    pub fn product(&mut self, coefficient: &Rational, factors: &[(Expr, Rational)]) -> (Sign, Layout) {
        let (coefficient, mut factors) = self.without_roots_of_squares(coefficient, factors);
        let coefficient = self.spread(&coefficient, &mut factors);
        let mut negative = coefficient.is_negative();
        factors.sort_by_cached_key(|f| self.survey.factor_key(f.base));
        for factor in &mut factors {
            negative ^= self.settle_sign(factor);
        }
        let body = self.assemble(&coefficient, &factors);
        (if negative { Sign::Minus } else { Sign::Plus }, body)
    }

    /// The factors with √(x²) written as |x|, as x where its sign is known, and x/|x| as sign x.
    fn without_roots_of_squares(&self, coefficient: &Rational, factors: &[(Expr, Rational)]) -> (Rational, Vec<Factor>) {
        let mut coefficient = coefficient.clone();
        let mut found: Vec<Factor> = Vec::with_capacity(factors.len());
        for (base, exponent) in factors {
            match self.square_under(*base, exponent) {
                Some((front, inner)) => {
                    coefficient = &coefficient * &front;
                    found.extend(inner);
                }
                None => found.push(Factor::new(*base, exponent)),
            }
        }
        merge_equal(&mut found);
        for i in 0..found.len() {
            if found[i].taken != Taken::Size || !found[i].exponent.abs().is_one() {
                continue;
            }
            let (base, inverse) = (found[i].base, -&found[i].exponent);
            let whole = |f: &Factor| f.base == base && f.taken == Taken::Whole && f.exponent == inverse;
            if let Some(other) = found.iter().position(whole) {
                (found[i].taken, found[i].exponent) = (Taken::Sign, Rational::ONE);
                found.remove(other);
                return (coefficient, found);
            }
        }
        (coefficient, found)
    }

    /// base^exponent with an odd multiple of 1/2 as exponent where the base is a square: the number in front, and what is left of the root.
    fn square_under(&self, base: Expr, exponent: &Rational) -> Option<(Rational, Vec<Factor>)> {
        let twice = (exponent * &Rational::from(2)).to_i64().filter(|n| n % 2 != 0)?;
        let Node::Product { coefficient, factors } = self.graph.node(base) else { return None };
        let mut front = if coefficient.is_one() { Rational::ONE } else { coefficient.root(2)?.pow(twice)? };
        if !factors.iter().all(|(_, e)| e.to_i64().is_some_and(|n| n % 2 == 0)) {
            return None;
        }
        let mut inner = Vec::with_capacity(factors.len());
        for (b, e) in factors {
            let exponent = e * exponent;
            let even = exponent.to_i64().is_some_and(|n| n % 2 == 0);
            let known = self.printer.sign_of(*b);
            if !even && known == Some(Sign::Minus) {
                front = -&front;
            }
            let taken = if even || known.is_some() || self.is_positive(*b) { Taken::Whole } else { Taken::Size };
            inner.push(Factor { taken, ..Factor::new(*b, &exponent) });
        }
        Some((front, inner))
    }

    /// Whether a formula of parameters is positive by their numbers.
    fn is_positive(&self, e: Expr) -> bool {
        match self.graph.node(e) {
            Node::Number(r) => !r.is_negative() && !r.is_zero(),
            Node::Pi => true,
            Node::Symbol(s) => self.printer.is_positive(*s),
            Node::Sum { constant, terms } => !constant.is_negative() && terms.iter().all(|(t, c)| !c.is_negative() && self.is_positive(*t)),
            Node::Product { coefficient, factors } => !coefficient.is_negative() && factors.iter().all(|(b, _)| self.is_positive(*b)),
            _ => false,
        }
    }

    /// Moves a common denominator back into a sum of inertias: (2 I + m R²) φ''/2 is written (I + m R²/2) φ'', and in an energy, where
    /// rates are squared, one half stays outside. Returns the coefficient that remains.
    fn spread(&mut self, coefficient: &Rational, factors: &mut [Factor]) -> Rational {
        let denominator = coefficient.digits().1.parse::<i64>().unwrap_or(1);
        let class = |composer: &mut Self, e: Expr| composer.survey.traits(e).class;
        let mut rates = Rational::ZERO;
        for factor in factors.iter() {
            if class(self, factor.base) == SymbolClass::Rate && !factor.exponent.is_negative() {
                rates = &rates + &factor.exponent;
            }
        }
        let available = if rates.to_i64() == Some(2) && denominator % 2 == 0 { denominator / 2 } else { denominator };
        for factor in factors.iter_mut().filter(|f| f.exponent.is_one() && f.taken == Taken::Whole) {
            let Node::Sum { terms, .. } = self.graph.node(factor.base) else { continue };
            if class(self, factor.base) >= SymbolClass::Rate {
                continue;
            }
            let divides = |k: &i64| available % k == 0 && terms.iter().any(|(_, c)| (c / &Rational::from(*k)).is_integer());
            if let Some(k) = (2..=available.min(64)).rev().find(divides) {
                factor.scale = &Rational::ONE / &Rational::from(k);
                return coefficient * &Rational::from(k);
            }
        }
        coefficient.clone()
    }

    /// Turns a sum (as a factor or as the argument of an odd or even function) so that its first term in print order is positive:
    /// −k (φ' − ω) becomes k (ω − φ'), and a length stays a length in −m (l₀ − λ x). Returns whether the product changes sign by that.
    fn settle_sign(&mut self, factor: &mut Factor) -> bool {
        let (sum, odd, side) = match self.graph.node(factor.base) {
            Node::Sum { .. } if factor.taken == Taken::Size => (factor.base, false, Side::Plain),
            Node::Sum { .. } if factor.exponent.is_integer() => (factor.base, !factor.is_even(), Side::Plain),
            Node::Call { function, arguments } => match parity(*function) {
                Some(odd) => (arguments[0], odd && !factor.is_even(), argument_side(*function)),
                None => return false,
            },
            _ => return false,
        };
        let free = factor.exponent.is_integer() || !odd;
        if !free || !self.leads_negative(sum, side) {
            return false;
        }
        factor.sign = Sign::Minus;
        odd
    }

    fn assemble(&mut self, coefficient: &Rational, factors: &[Factor]) -> Layout {
        let (mut above, mut below) = (vec![], vec![]);
        match self.numeral(coefficient) {
            Numeral::Plain(number) if number != Layout::digits("1") => above.push(number),
            Numeral::Plain(_) => {}
            Numeral::Ratio(n, d) => {
                if n != Layout::digits("1") {
                    above.push(n);
                }
                below.push(d);
            }
        }
        // functions follow a simple fraction, (m g l/2) cos φ, and stand above the bar of a fraction over a sum
        let mut functions = vec![];
        for factor in factors {
            if factor.exponent.is_negative() {
                below.push(self.factor(factor, &factor.exponent.abs()));
                continue;
            }
            let layout = self.factor(factor, &factor.exponent);
            if factor.taken == Taken::Sign || matches!(self.graph.node(factor.base), Node::Call { .. } | Node::Switch { .. }) {
                functions.push(layout);
            } else {
                above.push(layout);
            }
        }
        merge_roots(&mut above);
        merge_roots(&mut below);
        if below.is_empty() {
            above.append(&mut functions);
            return if above.is_empty() { Layout::digits("1") } else { Layout::product(above) };
        }
        if above.is_empty() || below.iter().any(Layout::has_sum) {
            above.append(&mut functions);
        }
        if above.is_empty() {
            above.push(Layout::digits("1"));
        }
        let fraction = Layout::Fraction(Box::new(unfenced(above)), Box::new(unfenced(below)));
        functions.insert(0, fraction);
        Layout::product(functions)
    }

    fn factor(&mut self, factor: &Factor, exponent: &Rational) -> Layout {
        let graph = self.graph;
        match factor.taken {
            Taken::Whole => {}
            Taken::Size => return self.call(Function::Abs, &[factor.base], factor.sign, exponent),
            Taken::Sign => return self.call(Function::Sign, &[factor.base], factor.sign, exponent),
        }
        if let Node::Call { function, arguments } = graph.node(factor.base) {
            return self.call(*function, arguments, factor.sign, exponent);
        }
        if let Some(degree) = root_degree(exponent) {
            let radicand = Box::new(self.compose(factor.base, factor.sign, Side::Plain));
            return Layout::Root { degree, radicand };
        }
        if !exponent.is_one() {
            let base = self.base(factor.base, factor.sign);
            return Layout::Power(Box::new(base), Box::new(exponent_layout(exponent)));
        }
        match graph.node(factor.base) {
            Node::Symbol(id) => self.symbol(*id),
            Node::Pi => Layout::Symbol(self.printer.pi()),
            Node::Number(r) => self.number(r),
            Node::Power { base, exponent } => {
                let base = self.base(*base, Sign::Plus);
                let exponent = self.compose(*exponent, Sign::Plus, Side::Plain);
                Layout::Power(Box::new(base), Box::new(exponent))
            }
            Node::Switch { .. } => self.switch(factor.base),
            Node::Sum { constant, terms } if !factor.scale.is_one() => {
                let terms: Vec<(Expr, Rational)> = terms.iter().map(|(t, c)| (*t, c * &factor.scale)).collect();
                self.sum((&(constant * &factor.scale), &terms), factor.sign, Side::Plain).fenced()
            }
            _ => self.compose(factor.base, factor.sign, Side::Plain).fenced(),
        }
    }

    fn call(&mut self, function: Function, arguments: &[Expr], sign: Sign, exponent: &Rational) -> Layout {
        let power = exponent.to_i64().filter(|n| *n > 1).map(|n| n.to_string());
        let simple = exponent.is_one();
        let whole = match function {
            Function::Abs => Layout::Fence(Bracket::Bar, Box::new(self.compose(arguments[0], sign, Side::Plain))),
            Function::Exp if !self.printer.e_is_taken => Layout::Exponential(Box::new(self.compose(arguments[0], Sign::Plus, Side::Plain))),
            _ => {
                let named_power = if simple { None } else { power };
                let inner = self.named_call(function, arguments, sign, named_power.clone());
                if simple || named_power.is_some() {
                    return inner;
                }
                inner.fenced()
            }
        };
        if simple {
            return whole;
        }
        if let Some(degree) = root_degree(exponent) {
            let radicand = match whole {
                Layout::Fence(Bracket::Round, inner) => inner,
                other => Box::new(other),
            };
            return Layout::Root { degree, radicand };
        }
        Layout::Power(Box::new(whole), Box::new(exponent_layout(exponent)))
    }

    fn named_call(&mut self, function: Function, arguments: &[Expr], sign: Sign, power: Option<String>) -> Layout {
        let name = language::function(self.printer.language, function);
        let (argument, bare) = match arguments {
            [x] => {
                let argument = self.compose(*x, sign, argument_side(function));
                let phase = self.survey.traits(*x).class == SymbolClass::Time && is_plain_product(&argument);
                let phase = phase && !self.reads_as_name(&argument);
                let bare = if phase { Bare::Always } else { bareness(&argument) };
                (argument, bare)
            }
            _ => {
                let items = arguments.iter().map(|x| self.compose(*x, Sign::Plus, Side::Plain)).collect();
                (Layout::List(items, language::list_mark(self.printer.language)), Bare::Never)
            }
        };
        Layout::Call { name, power, argument: Box::new(argument), bare }
    }
}

impl Composer<'_> {
    /// Whether letters of a product, set close together, read as a name of the model: k·t beside a parameter `kt`.
    fn reads_as_name(&self, product: &Layout) -> bool {
        let Layout::Product(factors) = product else { return false };
        let letters: Vec<String> =
            factors.iter().filter_map(|f| if let Layout::Symbol(s) = f { Some(text::label(s)) } else { None }).collect();
        let runs = (0..letters.len()).flat_map(|i| (i + 2..=letters.len()).map(move |j| i..j));
        runs.into_iter().any(|run| self.printer.is_word(&letters[run].concat()))
    }
}

/// `Some(true)` for odd functions, `Some(false)` for even ones.
fn parity(function: Function) -> Option<bool> {
    use Function::{Abs, Asin, Asinh, Atan, Atanh, Cos, Cosh, Sign, Sin, Sinh, Tan, Tanh};
    match function {
        Sin | Tan | Asin | Atan | Sinh | Tanh | Asinh | Atanh | Sign => Some(true),
        Cos | Cosh | Abs => Some(false),
        _ => None,
    }
}

/// Angles end with their constants: `sin(ω t + α)`, `cos(φ − π/6)`.
fn argument_side(function: Function) -> Side {
    match function {
        Function::Sin | Function::Cos | Function::Tan => Side::Angle,
        _ => Side::Plain,
    }
}

/// Numbers and letters that may stand close together without being read as one name: `cos 2ωt`.
fn is_plain_product(layout: &Layout) -> bool {
    let Layout::Product(factors) = layout else { return false };
    factors.len() <= 3
        && factors.iter().enumerate().all(|(i, f)| match f {
            Layout::Number { exponent: None, .. } => i == 0,
            Layout::Symbol(s) => s.primes == 0 && s.base.chars().count() == 1 && s.has_plain_index(),
            _ => false,
        })
}

/// `cos φ`, `cos 2φ`; a fraction is bare only under its bar.
fn bareness(argument: &Layout) -> Bare {
    match argument {
        Layout::Symbol(_) => Bare::Always,
        Layout::Product(factors) => match &factors[..] {
            [Layout::Number { exponent: None, .. }, Layout::Symbol(_)] => Bare::Always,
            _ => Bare::Never,
        },
        Layout::Fraction(n, d) if is_short(n) && is_short(d) => Bare::Raised,
        _ => Bare::Never,
    }
}

fn is_short(layout: &Layout) -> bool {
    !matches!(layout, Layout::Sum(_) | Layout::Call { .. } | Layout::Fraction(..))
}

/// √2 √(g/l) is written √(2 g/l): the square root of a number goes under the root of a formula.
fn merge_roots(factors: &mut Vec<Layout>) {
    let place = |number: bool| {
        let wanted =
            |f: &Layout| matches!(f, Layout::Root { degree: 2, radicand } if matches!(**radicand, Layout::Number { .. }) == number);
        let mut found = factors.iter().enumerate().filter(|(_, f)| wanted(f)).map(|(i, _)| i);
        found.next().filter(|_| found.next().is_none())
    };
    let (Some(number), Some(formula)) = (place(true), place(false)) else { return };
    let under = |factor: &Layout| match factor {
        Layout::Root { radicand, .. } => (**radicand).clone(),
        other => other.clone(),
    };
    let (number_under, formula_under) = (under(&factors[number]), under(&factors[formula]));
    let radicand = match formula_under {
        Layout::Fraction(above, below) => Layout::Fraction(Box::new(times(number_under, *above)), below),
        other => times(number_under, other),
    };
    factors[formula] = Layout::Root { degree: 2, radicand: Box::new(radicand) };
    factors.remove(number);
}

/// A number before a formula that starts with none; a sum gets brackets.
fn times(number: Layout, formula: Layout) -> Layout {
    match formula {
        one if one == Layout::digits("1") => number,
        Layout::Product(mut factors) => {
            factors.insert(0, number);
            Layout::Product(factors)
        }
        sum @ Layout::Sum(_) => Layout::Product(vec![number, sum.fenced()]),
        other => Layout::Product(vec![number, other]),
    }
}

/// n of the exponent 1/n.
fn root_degree(exponent: &Rational) -> Option<u32> {
    match exponent.digits() {
        (n, d) if n == "1" && d != "1" => d.parse().ok().filter(|d| *d <= 9),
        _ => None,
    }
}

/// Exponents stay on one line: `x^{3/2}`.
fn exponent_layout(exponent: &Rational) -> Layout {
    Layout::digits(exponent.to_string())
}

/// The product of the factors; a lone sum sheds its brackets.
fn unfenced(factors: Vec<Layout>) -> Layout {
    match Layout::product(factors) {
        Layout::Fence(Bracket::Round, inner) => *inner,
        other => other,
    }
}
