//! The frequency equation as text: a polynomial in the user's variable with coprime whole coefficients when the data are rational.

use crate::frame::bind::Factor;
use symbolic::Rational;

/// `504 z^3 - 729 z^2 + 94 z - 1 = 0` from coefficients by rising powers of λ = k², with z = factor·k².
pub fn exact(coefficients: &[Rational], variable: Option<&(String, Factor)>) -> Option<String> {
    let (name, factor, per_lambda) = match variable {
        Some((name, factor)) => (name.as_str(), factor.exact.clone()?, 1),
        None => ("z", Rational::ONE, 1),
    };
    let mut list = Vec::new();
    let mut divisor = Rational::ONE;
    for c in coefficients {
        list.push(c / &divisor);
        divisor = &divisor * &factor;
    }
    let whole = coprime(&list)?;
    let terms = whole.iter().enumerate().rev().filter(|(_, c)| !c.is_zero());
    Some(write(terms.map(|(i, c)| (i as u32 * per_lambda, c.abs().to_string(), c.is_negative())), name))
}

/// The same with decimal coefficients, the highest 1, from the squares of the frequencies.
pub fn decimal(squares: &[f64], variable: Option<&(String, Factor)>) -> String {
    let (name, factor, per_lambda) = match variable {
        Some((name, factor)) => (name.as_str(), factor.value, 1),
        None => ("z", 1.0, 1),
    };
    let mut list = vec![1.0];
    for square in squares {
        // times (z - z_i), falling powers
        let root = square * factor;
        list.push(0.0);
        for i in (1..list.len()).rev() {
            list[i] -= root * list[i - 1];
        }
    }
    let n = list.len() as u32 - 1;
    let terms = list.iter().enumerate().map(|(i, c)| ((n - i as u32) * per_lambda, format!("{:.12e}", c.abs()), *c < 0.0));
    write(terms.map(|(p, c, negative)| (p, if p == n * per_lambda { "1".to_owned() } else { shorter(&c) }, negative)), name)
}

fn shorter(text: &str) -> String {
    text.parse::<f64>().map_or_else(|_| text.to_owned(), |v| format!("{v}"))
}

fn write(terms: impl Iterator<Item = (u32, String, bool)>, name: &str) -> String {
    let mut out = String::new();
    for (power, coefficient, negative) in terms {
        match (out.is_empty(), negative) {
            (true, true) => out.push('-'),
            (true, false) => {}
            (false, true) => out.push_str(" - "),
            (false, false) => out.push_str(" + "),
        }
        let variable = match power {
            0 => String::new(),
            1 => name.to_owned(),
            p => format!("{name}^{p}"),
        };
        if coefficient != "1" || power == 0 {
            out.push_str(&coefficient);
            if power > 0 {
                out.push(' ');
            }
        }
        out.push_str(&variable);
    }
    out + " = 0"
}

/// The same ratios as whole numbers without a common divisor, the last positive.
fn coprime(list: &[Rational]) -> Option<Vec<Rational>> {
    let denominator = |c: &Rational| c.digits().1.parse_rational();
    let common = list.iter().try_fold(Rational::ONE, |m, c| {
        let d = denominator(c)?;
        Some(&(&m / &gcd(&m, &d)) * &d)
    })?;
    let whole: Vec<Rational> = list.iter().map(|c| c * &common).collect();
    let content = whole.iter().fold(Rational::ZERO, |g, c| gcd(&g, &c.abs()));
    let content = if whole.last()?.is_negative() { -&content } else { content };
    if content.is_zero() {
        return None;
    }
    Some(whole.iter().map(|c| c / &content).collect())
}

trait ParseRational {
    fn parse_rational(&self) -> Option<Rational>;
}
impl ParseRational for String {
    fn parse_rational(&self) -> Option<Rational> {
        // digits beyond the limit of a literal belong to no equation that anybody reads
        Rational::parse_decimal(self)
    }
}

/// Greatest common divisor of whole numbers >= 0.
fn gcd(a: &Rational, b: &Rational) -> Rational {
    let (mut a, mut b) = (a.clone(), b.clone());
    while !b.is_zero() {
        let rest = &a - &(&(&a / &b).floor() * &b);
        (a, b) = (b, rest);
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coefficients_become_coprime_whole_numbers() {
        // 1 - 94 z + 729 z² - 504 z³ with z = λ/72
        let r = |n: i64, d: i64| Rational::new(n, d).unwrap();
        let list = [r(1, 1), r(-94, 72), r(729, 72 * 72), r(-504, 72 * 72 * 72)];
        let z = ("z".to_owned(), Factor { value: 1.0 / 72.0, exact: Some(r(1, 72)) });
        assert_eq!(exact(&list, Some(&z)).unwrap(), "504 z^3 - 729 z^2 + 94 z - 1 = 0");
        assert_eq!(exact(&[r(1, 1), r(-1, 4)], None).unwrap(), "z - 4 = 0");
    }

    #[test]
    fn decimal_coefficients_have_the_roots() {
        assert_eq!(decimal(&[1.0, 4.0], None), "z^2 - 5 z + 4 = 0");
    }
}
