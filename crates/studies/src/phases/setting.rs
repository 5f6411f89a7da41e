//! Small pieces of formulas with numbers in them: what [`steps`](super::steps) sets its lines from.

use report::document::Formula;
use report::formula::{Bracket, Layout, Printer, Relation, Sign};
use words::Language;

/// Significant digits of substituted numbers and results.
const DIGITS: usize = 6;

/// Sets formulas in a language.
pub struct Setting {
    pub printer: Printer,
    pub language: Language,
    /// Letters of the textbooks that the file uses for something else.
    pub taken: Vec<String>,
}

impl Setting {
    /// A letter, `C1` being C with the index 1.
    pub fn letter(&self, name: &str) -> Layout {
        let other = self.language.pick("lin", "лин");
        match self.taken.iter().any(|taken| taken == name) {
            // an index of its own, behind that of the letter
            true => Layout::Symbol(self.printer.named(&format!("{name}_{other}"))),
            false => Layout::Symbol(self.printer.named(name)),
        }
    }

    /// |x|.
    pub fn size(&self, x: f64) -> Layout {
        let text = report::number::short(x.abs(), DIGITS, Language::En);
        let (mantissa, power) = text.split_once("·10").unwrap_or((&text, ""));
        let exponent: String = power.chars().filter_map(lowered).collect();
        let mantissa = if self.language == Language::Ru { mantissa.replace('.', ",") } else { mantissa.to_owned() };
        Layout::Number { mantissa, exponent: exponent.parse().ok() }
    }

    /// A number with its sign, alone.
    pub fn number(&self, x: f64) -> Layout {
        if x < 0.0 { Layout::Sum(vec![(Sign::Minus, self.size(x))]) } else { self.size(x) }
    }

    /// A number as a factor: brackets around a negative one.
    pub fn factor(&self, x: f64) -> Layout {
        if x < 0.0 { fence(self.number(x)) } else { self.size(x) }
    }

    /// A result with its unit.
    pub fn result(&self, x: f64, unit: &str) -> Layout {
        let unit = report::unit::print(unit, self.language);
        if unit.is_empty() { self.number(x) } else { Layout::Row(vec![self.number(x), Layout::Words(format!("\u{a0}{unit}"))]) }
    }

    /// A chain left = a = b = ...
    pub fn chain(&self, parts: Vec<Layout>) -> Formula {
        let mut parts = parts.into_iter();
        let first = parts.next().unwrap_or(Layout::Row(vec![]));
        let whole = parts.fold(first, |left, right| Layout::Related(Box::new(left), Relation::Equal, Box::new(right)));
        self.printer.block(whole)
    }

    /// sin or cos of an argument that needs brackets when it is a sum.
    pub fn wave(&self, name: &'static str, argument: Layout) -> Layout {
        let bare = if matches!(argument, Layout::Sum(_)) { report::formula::Bare::Never } else { report::formula::Bare::Always };
        Layout::Call { name, power: None, argument: Box::new(argument), bare }
    }

    /// Factor · rest with the sign of the factor in front, as a term of a sum; a factor that prints as 1 is not written.
    pub fn term(&self, factor: f64, rest: Vec<Layout>) -> (Sign, Layout) {
        let sign = if factor < 0.0 { Sign::Minus } else { Sign::Plus };
        let unit = !rest.is_empty() && report::number::short(factor.abs(), DIGITS, Language::En) == "1";
        let mut factors = if unit { Vec::new() } else { vec![self.size(factor)] };
        factors.extend(rest);
        (sign, if factors.len() == 1 { factors.remove(0) } else { Layout::Product(factors) })
    }

    /// x + shift, without the shift when it is zero.
    pub fn shifted(&self, x: Layout, shift: f64) -> Layout {
        if shift == 0.0 { x } else { Layout::Sum(vec![(Sign::Plus, x), self.term(shift, vec![])]) }
    }
}

fn lowered(c: char) -> Option<char> {
    match c {
        '⁻' => Some('-'),
        '⁰' => Some('0'),
        '¹' => Some('1'),
        '²' => Some('2'),
        '³' => Some('3'),
        '⁴'..='⁹' => char::from_digit(c as u32 - '⁰' as u32, 10),
        _ => None,
    }
}

pub fn fence(x: Layout) -> Layout {
    Layout::Fence(Bracket::Round, Box::new(x))
}
pub fn product(factors: Vec<Layout>) -> Layout {
    Layout::Product(factors)
}
pub fn fraction(above: Layout, below: Layout) -> Layout {
    Layout::Fraction(Box::new(above), Box::new(below))
}
pub fn square(x: Layout) -> Layout {
    power(x, 2)
}
pub fn power(x: Layout, n: u32) -> Layout {
    Layout::Power(Box::new(x), Box::new(whole(n)))
}
pub fn root(x: Layout) -> Layout {
    Layout::Root { degree: 2, radicand: Box::new(x) }
}
pub fn whole(n: u32) -> Layout {
    Layout::Number { mantissa: n.to_string(), exponent: None }
}
pub fn plus(terms: Vec<Layout>) -> Layout {
    Layout::Sum(terms.into_iter().map(|t| (Sign::Plus, t)).collect())
}
pub fn minus(a: Layout, b: Layout) -> Layout {
    Layout::Sum(vec![(Sign::Plus, a), (Sign::Minus, b)])
}
/// e^argument.
pub fn exponential(argument: Layout) -> Layout {
    Layout::Exponential(Box::new(argument))
}
pub fn negative(x: Layout) -> Layout {
    Layout::Sum(vec![(Sign::Minus, x)])
}
