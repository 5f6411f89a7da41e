//! Numbers as people read them, and numbers as machines read them.
//!
//! People: 3-4 significant digits, equal decimals inside a column, decimal mark of the language, true minus, `1,2·10⁻³` instead of
//! `1.2e-03`, thousands by a thin space from five digits on, `∞`, and a dash for what is not a number.
//! Machines: 17 significant digits ([`push_exact`]), which name every `f64` exactly.

use std::fmt::Write;
use words::Language;

/// No-break space, between a number and its unit.
pub const NO_BREAK_SPACE: char = '\u{a0}';
/// Narrow no-break space, between thousands.
const THOUSANDS: char = '\u{202f}';
const MINUS: char = '−';

/// Appends `x` with 17 significant digits, `1.2345678901234567e-3`; `nan`, `inf`, `-inf` as the `csv` readers of Rust and Python accept.
pub fn push_exact(out: &mut Vec<u8>, x: f64) {
    use std::io::Write;
    if x.is_nan() {
        out.extend_from_slice(b"nan");
    } else if x.is_infinite() {
        out.extend_from_slice(if x > 0.0 { b"inf" } else { b"-inf" });
    } else {
        // writing into memory cannot fail
        let _ = write!(out, "{x:.16e}");
    }
}

/// `x` with this many significant digits: plain between 10⁻³ and 10⁵, otherwise as `1,2·10⁻³`.
pub fn significant(x: f64, digits: usize, language: Language) -> String {
    let x = normal(x);
    let Some(exponent) = decimal_exponent(x, digits) else { return special(x) };
    if (-3..5).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        fixed(x, decimals, language)
    } else {
        scientific(x, digits.saturating_sub(1), language)
    }
}

/// Like [`significant`], without zeros at the end of the decimals: for numbers that stand alone.
pub fn short(x: f64, digits: usize, language: Language) -> String {
    let text = significant(x, digits, language);
    let mark = language.decimal_mark();
    let (mantissa, power) = match text.find('·') {
        Some(at) => text.split_at(at),
        None => (text.as_str(), ""),
    };
    if !mantissa.contains(mark) {
        return text;
    }
    let trimmed = mantissa.trim_end_matches('0').trim_end_matches(mark);
    format!("{trimmed}{power}")
}

/// Zero for what lies below the smallest number with all its digits: such a remainder of an underflow has none to show.
fn normal(x: f64) -> f64 {
    if x.is_subnormal() { 0.0 } else { x }
}

/// `x` with this many decimals.
pub fn fixed(x: f64, decimals: usize, language: Language) -> String {
    if !x.is_finite() {
        return special(x);
    }
    localized(&format!("{x:.decimals$}"), language)
}

/// `x` as mantissa with this many decimals times a power of ten: `1,20·10⁻³`.
pub fn scientific(x: f64, decimals: usize, language: Language) -> String {
    let x = normal(x);
    if !x.is_finite() {
        return special(x);
    }
    let ascii = format!("{x:.decimals$e}");
    let (mantissa, exponent) = ascii.split_once('e').unwrap_or((&ascii, "0"));
    let mantissa = localized(mantissa, language);
    if exponent == "0" { mantissa } else { format!("{mantissa}·10{}", superscript(exponent)) }
}

/// Digits, signs and letters raised, as far as Unicode has them: `-3` gives `⁻³`.
pub fn superscript(ascii: &str) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    ascii
        .chars()
        .map(|c| match c {
            '0'..='9' => DIGITS[c as usize - '0' as usize],
            '-' | MINUS => '⁻',
            '+' => '⁺',
            other => other,
        })
        .collect()
}

/// How the numbers of one column are written, so that they line up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// This many decimals.
    Fixed(usize),
    /// Mantissa with this many decimals and a power of ten.
    Scientific(usize),
    /// This many significant digits, each cell by itself: for columns of unlike quantities.
    Significant(usize),
}

impl Format {
    /// The format in which the largest value of a column shows `digits` significant digits and all cells have equal decimals.
    pub fn of_column(values: &[f64], digits: usize) -> Format {
        let largest = normal(values.iter().filter(|x| x.is_finite()).fold(0.0_f64, |m, x| m.max(x.abs())));
        let Some(exponent) = decimal_exponent(largest, digits) else { return Format::Fixed(0) };
        if values.iter().all(|x| x.fract() == 0.0) && largest < 1e9 {
            return Format::Fixed(0);
        }
        match exponent {
            -2..6 => Format::Fixed((digits as i32 - 1 - exponent).max(0) as usize),
            _ => Format::Scientific(digits.saturating_sub(1)),
        }
    }

    /// `x` in this format.
    pub fn show(self, x: f64, language: Language) -> String {
        match self {
            Format::Fixed(decimals) => fixed(x, decimals, language),
            Format::Scientific(_) if normal(x) == 0.0 => "0".into(),
            Format::Scientific(decimals) => scientific(x, decimals, language),
            Format::Significant(digits) => short(x, digits, language),
        }
    }
}

/// A number and a printed unit: no-break space between, none before `°`.
pub fn with_unit(number: &str, unit: &str) -> String {
    match unit {
        "" => number.into(),
        "°" | "′" | "″" => format!("{number}{unit}"),
        _ => format!("{number}{NO_BREAK_SPACE}{unit}"),
    }
}

/// A circular frequency with the frequency it means: `ω = 18,8 рад/с (f = 3,00 Гц)`.
pub fn frequency_pair(omega: f64, digits: usize, language: Language) -> String {
    let f = omega / std::f64::consts::TAU;
    let omega = with_unit(&significant(omega, digits, language), language.pick("rad/s", "рад/с"));
    let f = with_unit(&significant(f, digits, language), language.pick("Hz", "Гц"));
    format!("ω{NO_BREAK_SPACE}={NO_BREAK_SPACE}{omega} (f{NO_BREAK_SPACE}={NO_BREAK_SPACE}{f})")
}

/// Exponent of ten of `x` after rounding to `digits` significant digits; none for what has none. Zero counts as 10⁰.
fn decimal_exponent(x: f64, digits: usize) -> Option<i32> {
    if !x.is_finite() {
        return None;
    }
    if x == 0.0 {
        return Some(0);
    }
    let decimals = digits.saturating_sub(1);
    let ascii = format!("{x:.decimals$e}");
    ascii.split_once('e').and_then(|(_, exponent)| exponent.parse().ok())
}

fn special(x: f64) -> String {
    if x.is_nan() {
        "–".into()
    } else if x > 0.0 {
        "∞".into()
    } else {
        format!("{MINUS}∞")
    }
}

/// From Rust's plain digits to the language: mark, minus, thousands; a zero loses its sign.
fn localized(ascii: &str, language: Language) -> String {
    let (negative, digits) = match ascii.strip_prefix('-') {
        Some(rest) => (rest.bytes().any(|b| (b'1'..=b'9').contains(&b)), rest),
        None => (false, ascii),
    };
    let (whole, decimals) = digits.split_once('.').map_or((digits, None), |(w, d)| (w, Some(d)));
    let mut out = String::with_capacity(ascii.len() + 8);
    if negative {
        out.push(MINUS);
    }
    for (i, c) in whole.chars().enumerate() {
        if i > 0 && whole.len() >= 5 && (whole.len() - i) % 3 == 0 {
            out.push(THOUSANDS);
        }
        out.push(c);
    }
    if let Some(decimals) = decimals {
        // writing into memory cannot fail
        let _ = write!(out, "{}{decimals}", language.decimal_mark());
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use Language::{En, Ru};

    #[test]
    fn what_is_left_of_an_underflow_is_zero() {
        for x in [-1.7e-322, 5e-324, -f64::MIN_POSITIVE / 2.0] {
            assert_eq!(short(x, 6, En), "0", "{x}");
            assert_eq!(scientific(x, 2, Ru), "0,00");
            let format = Format::of_column(&[x, 0.0], 4);
            assert!(!format.show(x, En).contains(['−', '·']), "{format:?}");
            assert_eq!(Format::Scientific(3).show(x, En), "0");
        }
        // the smallest number with all its digits stays
        assert_eq!(short(f64::MIN_POSITIVE, 3, En), "2.23·10⁻³⁰⁸");
    }

    #[test]
    fn significant_digits_in_both_languages() {
        for (x, digits, en, ru) in [
            (0.0, 3, "0.00", "0,00"),
            (-0.0, 3, "0.00", "0,00"),
            (1.5, 3, "1.50", "1,50"),
            (-12.345, 4, "−12.35", "−12,35"),
            (0.0012, 2, "0.0012", "0,0012"),
            (0.00012, 2, "1.2·10⁻⁴", "1,2·10⁻⁴"),
            (99999.0, 5, "99\u{202f}999", "99\u{202f}999"),
            (1234.0, 4, "1234", "1234"),
            (123456.0, 3, "1.23·10⁵", "1,23·10⁵"),
            (9.9996, 4, "10.00", "10,00"),
            (-3.2e-12, 3, "−3.20·10⁻¹²", "−3,20·10⁻¹²"),
            (f64::INFINITY, 3, "∞", "∞"),
            (f64::NEG_INFINITY, 3, "−∞", "−∞"),
            (f64::NAN, 3, "–", "–"),
            (5e-324, 3, "0.00", "0,00"),
            (f64::MIN_POSITIVE, 3, "2.23·10⁻³⁰⁸", "2,23·10⁻³⁰⁸"),
            (f64::MAX, 3, "1.80·10³⁰⁸", "1,80·10³⁰⁸"),
        ] {
            assert_eq!(significant(x, digits, En), en, "{x:e}");
            assert_eq!(significant(x, digits, Ru), ru, "{x:e}");
        }
    }

    #[test]
    fn lone_numbers_lose_trailing_zeros_only() {
        for (x, expected) in [(1.5, "1,5"), (300.0, "300"), (0.05, "0,05"), (4e5, "4·10⁵"), (1.25e-7, "1,25·10⁻⁷"), (0.0, "0")] {
            assert_eq!(short(x, 4, Ru), expected);
        }
    }

    #[test]
    fn columns_have_equal_decimals() {
        let shown = |values: &[f64]| {
            let format = Format::of_column(values, 3);
            values.iter().map(|&x| format.show(x, Ru)).collect::<Vec<_>>()
        };
        assert_eq!(shown(&[1.5, 1.75, 2.0]), ["1,50", "1,75", "2,00"]);
        assert_eq!(shown(&[100.0, -2.0, 17.0]), ["100", "−2", "17"]);
        assert_eq!(shown(&[1.5e-5, 2e-6, 0.0]), ["1,50·10⁻⁵", "2,00·10⁻⁶", "0"]);
        assert_eq!(shown(&[0.5, f64::NAN]), ["0,500", "–"]);
        assert_eq!(shown(&[]), [] as [&str; 0]);
    }

    #[test]
    fn units_stand_after_a_no_break_space_except_degrees() {
        assert_eq!(with_unit("30", "°"), "30°");
        assert_eq!(with_unit("3,0", "м"), "3,0\u{a0}м");
        assert_eq!(with_unit("3,0", ""), "3,0");
    }

    #[test]
    fn frequency_is_shown_as_a_pair() {
        assert_eq!(frequency_pair(std::f64::consts::TAU * 3.0, 3, Ru).replace('\u{a0}', " "), "ω = 18,8 рад/с (f = 3,00 Гц)");
    }

    #[test]
    fn seventeen_digits_name_every_number() {
        let mut bits = 1_u64;
        for _ in 0..20_000 {
            // a plain linear congruential generator covers all exponents
            bits = bits.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let x = f64::from_bits(bits);
            let mut out = Vec::new();
            push_exact(&mut out, x);
            let back: f64 = String::from_utf8(out).unwrap().parse().unwrap();
            assert!(back.to_bits() == x.to_bits() || x.is_nan() && back.is_nan());
        }
    }
}
