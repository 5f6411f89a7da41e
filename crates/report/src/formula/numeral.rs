//! Exact numbers as a reader expects them: `1/2`, `9.81`, `2·10¹¹`.

use super::{Layout, Sign};
use symbolic::Rational;
use words::Language;

/// Significant digits of numbers that stand for symbols.
const VALUE_DIGITS: usize = 6;

/// A machine number, rounded to a number of significant digits.
pub fn value(x: f64, digits: usize, language: Language) -> Layout {
    let text = crate::number::short(x.abs(), digits, language).replace(['\u{202f}', '\u{a0}'], "");
    let (mantissa, power) = text.split_once("·10").unwrap_or((&text, ""));
    let size = Layout::Number { mantissa: mantissa.to_owned(), exponent: power.chars().map(lowered).collect::<String>().parse().ok() };
    Layout::signed(if x < 0.0 && mantissa != "0" { Sign::Minus } else { Sign::Plus }, size)
}

/// |x|, rounded for a reader.
pub(super) fn size(x: f64, language: Language) -> Layout {
    value(x.abs(), VALUE_DIGITS, language)
}

/// The same as a factor: a negative one in brackets.
pub(super) fn factor(x: f64, language: Language) -> Layout {
    match value(x, VALUE_DIGITS, language) {
        negative @ Layout::Sum(_) => negative.fenced(),
        size => size,
    }
}

/// A raised digit or sign as it stands on the line.
fn lowered(c: char) -> char {
    match c {
        '⁻' => '-',
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        '⁰' | '⁴'..='⁹' => char::from_digit(c as u32 - '⁰' as u32, 10).unwrap_or(c),
        other => other,
    }
}

/// How a positive number is written.
pub(super) enum Numeral {
    /// Digits, possibly with a power of ten.
    Plain(Layout),
    /// A fraction of whole numbers.
    Ratio(Layout, Layout),
}

/// Fractions become decimals of at most so many significant digits.
const DECIMAL_DIGITS: usize = 6;
/// Numbers that can only have been typed as decimals keep so many.
const TYPED_DIGITS: usize = 15;
/// Longer numerators and denominators are cut.
const RATIO_DIGITS: usize = 9;
/// Digits left of a number that is cut.
const CUT_DIGITS: usize = 6;

/// The written form of |value|.
///
/// Denominators up to 12 stay fractions (1/2, 2/5, π/12), except 10, which only decimals produce; other numbers are decimals when
/// six digits give them exactly (15 with a denominator over 10 000), else fractions, with a decimal below the line where that takes
/// zeros away from above it (1/0.123). What is still too long is cut to six digits and an ellipsis.
pub(super) fn numeral(value: &Rational, language: Language) -> Numeral {
    let (n, d) = value.abs().digits();
    if d == "1" && n.trim_end_matches('0').len() <= TYPED_DIGITS {
        return Numeral::Plain(decimal(&n, 0, language));
    }
    let small = d.parse::<u32>().is_ok_and(|d| d <= 12 && d != 10) && n.len() <= 2;
    if !small && let Some(shown) = exact_decimal(&n, &d, language) {
        return Numeral::Plain(shown);
    }
    // r/0.123 was written with a decimal below the line: 1000 r/123 is nobody's hand
    let short = n.trim_end_matches('0');
    let zeros = n.len() - short.len();
    if d.len() >= 2 && zeros >= d.len() && zeros < RATIO_DIGITS {
        return Numeral::Ratio(Layout::digits(short), decimal(&d, zeros, language));
    }
    if d != "1" && n.len() <= RATIO_DIGITS && d.len() <= RATIO_DIGITS {
        return Numeral::Ratio(Layout::digits(n), Layout::digits(d));
    }
    Numeral::Plain(cut(&n, &d, language))
}

/// n/d as digits when d divides a power of ten and few enough are needed.
fn exact_decimal(n: &str, d: &str, language: Language) -> Option<Layout> {
    let mut numerator: u128 = n.parse().ok()?;
    let mut denominator: u128 = d.parse().ok()?;
    let limit = if denominator > 10_000 { TYPED_DIGITS } else { DECIMAL_DIGITS };
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
    (digits.trim_end_matches('0').len() <= limit).then(|| decimal(&digits, shift, language))
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

/// The first digits of n/d with an ellipsis.
fn cut(n: &str, d: &str, language: Language) -> Layout {
    let (above, below) = (leading(n), leading(d));
    // 0 < quotient, at least 20 digits
    let quotient = (above.0 * 10u128.pow(20) / below.0.max(1)).to_string();
    let shown = &quotient[..CUT_DIGITS.min(quotient.len())];
    let shift = 20 + below.1 - above.1 - (quotient.len() - shown.len()) as i64;
    let scaled = match usize::try_from(shift) {
        Ok(shift) => decimal(shown, shift, language),
        Err(_) => decimal(&format!("{shown}{}", "0".repeat(shift.unsigned_abs().min(20_000) as usize)), 0, language),
    };
    match scaled {
        Layout::Number { mantissa, exponent } => Layout::Number { mantissa: mantissa + "…", exponent },
        other => other,
    }
}

/// Eighteen leading digits as a number, and how many digits follow (negative when zeros were appended).
fn leading(digits: &str) -> (u128, i64) {
    let kept = digits.len().min(18);
    let padded = format!("{:0<18}", &digits[..kept]);
    (padded.parse().unwrap_or(0), digits.len() as i64 - 18)
}
