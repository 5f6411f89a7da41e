//! Numbers in messages, in both languages.

use crate::Text;

/// A number in both languages: decimal point and decimal comma, a true minus, `9.61·10⁻⁵`.
pub fn number(value: f64) -> Text {
    // three zeros behind the point and six digits before it are still read at a glance
    let plain = value == 0.0 || (1e-4..1e6).contains(&value.abs());
    let typed = if plain { value.to_string() } else { format!("{value:e}") };
    let mut en = String::with_capacity(typed.len() + 16);
    let mut digits = typed.chars();
    for c in digits.by_ref() {
        match c {
            '-' => en.push('−'),
            'e' => {
                en.push_str("·10");
                break;
            }
            c => en.push(c),
        }
    }
    en.extend(digits.map(raised));
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
    // as in [`number`]
    let plain = short == 0.0 || (1e-4..1e6).contains(&short.abs());
    let en = if plain { format!("{short}") } else { format!("{short:e}") };
    Text { ru: en.replace('.', ","), en }
}

/// As it is typed in again: all digits, `-0.3` and `-0,3`.
pub fn typed(value: f64) -> Text {
    let en = format!("{value}");
    Text { ru: en.replace('.', ","), en }
}

/// A value with its SI unit, as it is typed in again; `1` is no unit.
pub fn quantity(value: f64, unit: &str) -> Text {
    let (value, unit) = (typed(value), Text::unit(unit));
    if unit.en.is_empty() || unit.en == "1" {
        return value;
    }
    Text::new(format!("{} {}", value.en, unit.en), format!("{} {}", value.ru, unit.ru))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_mark_of_the_language() {
        assert_eq!(quantity(-0.5, "N m/rad"), Text::new("-0.5 N m/rad", "-0,5 Н м/рад"));
        assert_eq!(quantity(2.5, "1"), Text::new("2.5", "2,5"));
        assert_eq!(rounded(1.2345e-7), Text::new("1.23·10⁻⁷", "1,23·10⁻⁷"));
        assert_eq!(ten_digits(-0.25), Text::new("-0.25", "-0,25"));
    }
}
