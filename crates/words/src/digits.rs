//! Numbers in messages, in both languages.

use crate::Text;

/// A number in both languages: decimal point and decimal comma, a true minus, `9.61·10⁻⁵`.
pub fn number(value: f64) -> Text {
    let plain = value == 0.0 || (1e-4..1e6).contains(&value.abs());
    let typed = if plain { format!("{value}") } else { format!("{value:e}") };
    let (mantissa, exponent) = typed.split_once('e').map_or((typed.as_str(), None), |(m, e)| (m, Some(e)));
    let power = exponent.map_or_else(String::new, |e| format!("·10{}", e.chars().map(raised).collect::<String>()));
    let en = format!("{}{power}", mantissa.replace('-', "−"));
    Text { ru: en.replace('.', ","), en }
}

fn raised(c: char) -> char {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    c.to_digit(10).map_or('⁻', |d| DIGITS[d as usize])
}

/// Three digits, for estimates.
pub fn rounded(value: f64) -> Text {
    let short: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    number(short)
}

/// Seven digits: enough to recognise a place.
pub fn seven_digits(value: f64) -> Text {
    let short: f64 = format!("{value:.6e}").parse().unwrap_or(value);
    number(short)
}

/// Ten digits, as they are typed in again.
pub fn ten_digits(value: f64) -> Text {
    let short: f64 = format!("{value:.9e}").parse().unwrap_or(value);
    let plain = short == 0.0 || (1e-4..1e6).contains(&short.abs());
    let en = if plain { format!("{short}") } else { format!("{short:e}") };
    Text { ru: en.replace('.', ","), en }
}
