//! Units as they are printed: from the ASCII labels of data columns (`kg m^2`, `rad/s`, `1`) to `kg·m²` or `кг·м²`, and SI prefixes
//! for a whole column or axis. A unit that the user typed is never changed here.

use crate::number::superscript;
use words::Language;
use words::unit::{self, PREFIXES};

/// The unit in print; the dimensionless unit `1` prints as nothing. What is not known is printed as it is.
pub fn print(label: &str, language: Language) -> String {
    let label = label.trim();
    if label == "1" {
        return String::new();
    }
    let mut out = String::new();
    let mut rest = label;
    while let Some(c) = rest.chars().next() {
        if c.is_alphabetic() || matches!(c, '%' | '°') {
            let end = rest.find(|c: char| !(c.is_alphabetic() || matches!(c, '%' | '°'))).unwrap_or(rest.len());
            out.push_str(&unit::print(&rest[..end], language));
            rest = &rest[end..];
        } else if let Some(power) = rest.strip_prefix('^') {
            let end = power.find(|c: char| !(c.is_ascii_digit() || c == '-')).unwrap_or(power.len());
            out.push_str(&superscript(&power[..end]));
            rest = &power[end..];
        } else {
            out.push(if matches!(c, ' ' | '*' | '·') { '·' } else { c });
            rest = &rest[c.len_utf8()..];
        }
    }
    out
}

/// How a column or an axis is shown: shown value = SI value / `size`, in the unit `label`.
#[derive(Clone, Debug, PartialEq)]
pub struct Scale {
    /// SI size of the shown unit (0.001 for mm).
    pub size: f64,
    /// ASCII label of the shown unit.
    pub label: String,
}

impl Scale {
    /// Values shown as they are.
    pub fn plain(label: &str) -> Scale {
        Scale { size: 1.0, label: label.into() }
    }

    /// The unit in print.
    pub fn print(&self, language: Language) -> String {
        print(&self.label, language)
    }

    /// The SI prefix with which the largest absolute value of a column reads as 0.1 ... 10000 without powers of ten.
    ///
    /// Only the first factor takes a prefix, and only if it is a metre, newton, pascal, joule, watt or a second of a short time:
    /// angles, masses, rates and squares keep their unit.
    pub fn of_column(label: &str, largest: f64) -> Scale {
        let plain = Scale::plain(label);
        let first = label.find([' ', '/', '^']).unwrap_or(label.len());
        let (name, tail) = label.split_at(first);
        let prefixable = matches!(name, "m" | "N" | "Pa" | "J" | "W" | "Hz") || (name == "s" && tail.is_empty() && largest < 0.1);
        if !prefixable || tail.starts_with('^') || !largest.is_finite() || largest == 0.0 || (0.1..1e4).contains(&largest) {
            return plain;
        }
        // what no prefix reaches is rounding noise: a unit such as nN m would only dress it up
        let power = (largest.log10() / 3.0).floor() as i32 * 3;
        match PREFIXES.iter().find(|row| row.3 == power && (-9..=9).contains(&power)) {
            Some((ascii, ..)) => Scale { size: 10_f64.powi(power), label: format!("{ascii}{label}") },
            None => plain,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Language::{En, Ru};

    #[test]
    fn units_print_in_both_alphabets() {
        for (label, en, ru) in [
            ("1", "", ""),
            ("m", "m", "м"),
            ("kg m^2", "kg·m²", "кг·м²"),
            ("rad/s", "rad/s", "рад/с"),
            ("m/s^2", "m/s²", "м/с²"),
            ("N m s/rad", "N·m·s/rad", "Н·м·с/рад"),
            ("kN/m", "kN/m", "кН/м"),
            ("mm", "mm", "мм"),
            ("min", "min", "мин"),
            ("rpm", "rpm", "об/мин"),
            ("deg", "°", "°"),
            ("um", "µm", "мкм"),
            ("s^-1", "s⁻¹", "с⁻¹"),
            ("MPa", "MPa", "МПа"),
            ("kg/(m s)", "kg/(m·s)", "кг/(м·с)"),
            ("кг", "кг", "кг"),
        ] {
            assert_eq!(print(label, En), en);
            assert_eq!(print(label, Ru), ru);
        }
    }

    #[test]
    fn prefixes_are_chosen_for_the_column() {
        for (label, largest, expected, size) in [
            ("m", 0.05, "mm", 1e-3),
            ("m", 0.5, "m", 1.0),
            ("m", 2e-6, "um", 1e-6),
            ("N", 27_000.0, "kN", 1e3),
            ("N m", 5e6, "MN m", 1e6),
            ("rad", 1e-4, "rad", 1.0),
            ("kg", 1e6, "kg", 1.0),
            ("m^2", 1e-4, "m^2", 1.0),
            ("s", 30.0, "s", 1.0),
            ("s", 1e5, "s", 1.0),
            ("s", 0.02, "ms", 1e-3),
            ("m/s", 0.02, "mm/s", 1e-3),
            ("m", 0.0, "m", 1.0),
            ("m", 1e-300, "m", 1.0),
            ("N m", 2e-12, "N m", 1.0),
        ] {
            assert_eq!(Scale::of_column(label, largest), Scale { size, label: expected.into() });
        }
    }
}
