//! Exact numbers as a reader expects them: `1/2`, `9.81`, `2·10¹¹`.

use super::{Language, Layout};
use symbolic::Rational;

/// How a positive number is written.
pub(super) enum Numeral {
    /// Digits, possibly with a power of ten.
    Plain(Layout),
    /// A fraction of whole numbers.
    Ratio(Layout, Layout),
}

/// More significant digits than this are not shown as a decimal.
const DECIMAL_DIGITS: usize = 6;
/// Longer numerators and denominators are shown as a rounded decimal.
const RATIO_DIGITS: usize = 9;

/// The written form of |value|.
///
/// Denominators up to 12 stay fractions (1/2, 2/5, π/12), except 10, which only decimals produce; other numbers are decimals when
/// six digits give them exactly, else fractions; fractions of more than nine digits are rounded to six.
pub(super) fn numeral(value: &Rational, language: Language) -> Numeral {
    let value = value.abs();
    let (n, d) = value.digits();
    if d == "1" {
        return Numeral::Plain(decimal(&n, 0, language));
    }
    let small = d.parse::<u32>().is_ok_and(|d| d <= 12 && d != 10) && n.len() <= 2;
    if !small && let Some(shown) = exact_decimal(&n, &d, language) {
        return Numeral::Plain(shown);
    }
    if n.len() <= RATIO_DIGITS && d.len() <= RATIO_DIGITS {
        return Numeral::Ratio(Layout::digits(n), Layout::digits(d));
    }
    Numeral::Plain(rounded(value.to_f64(), language))
}

/// n/d as digits when d divides a power of ten and at most [`DECIMAL_DIGITS`] are needed.
fn exact_decimal(n: &str, d: &str, language: Language) -> Option<Layout> {
    let mut numerator: u128 = n.parse().ok()?;
    let mut denominator: u128 = d.parse().ok()?;
    let mut shift = 0;
    while denominator > 1 {
        let missing = if denominator.is_multiple_of(10) {
            1
        } else if denominator.is_multiple_of(2) {
            5
        } else if denominator.is_multiple_of(5) {
            2
        } else {
            return None;
        };
        numerator = numerator.checked_mul(missing)?;
        denominator = denominator.checked_mul(missing)? / 10;
        shift += 1;
    }
    let digits = numerator.to_string();
    (digits.trim_end_matches('0').len() <= DECIMAL_DIGITS).then(|| decimal(&digits, shift, language))
}

/// digits·10^-shift; powers of ten are split off beyond five leading or trailing zeros.
fn decimal(digits: &str, shift: usize, language: Language) -> Layout {
    let significant = digits.trim_end_matches('0');
    if significant.is_empty() {
        return Layout::digits("0");
    }
    // the value is 0.significant · 10^point
    let point = digits.len() as i64 - shift as i64;
    let zeros_after = point - significant.len() as i64;
    if point < -3 || zeros_after > 4 {
        let (first, rest) = significant.split_at(1);
        let mantissa = if rest.is_empty() { first.to_owned() } else { format!("{first}{}{rest}", language.decimal_mark()) };
        return Layout::Number { mantissa, exponent: i32::try_from(point - 1).ok() };
    }
    let mantissa = if point <= 0 {
        format!("0{}{}{significant}", language.decimal_mark(), "0".repeat(-point as usize))
    } else if zeros_after >= 0 {
        format!("{significant}{}", "0".repeat(zeros_after as usize))
    } else {
        let (whole, fraction) = significant.split_at(point as usize);
        format!("{whole}{}{fraction}", language.decimal_mark())
    };
    Layout::digits(mantissa)
}

fn rounded(value: f64, language: Language) -> Layout {
    let text = format!("{value:.5e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: i64 = exponent.parse().unwrap_or(0);
    let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
    // mantissa has five decimals: value = digits · 10^(exponent - 5)
    let shift = 5 - exponent;
    if shift >= 0 {
        decimal(&digits, shift as usize, language)
    } else {
        decimal(&format!("{digits}{}", "0".repeat((-shift) as usize)), 0, language)
    }
}
