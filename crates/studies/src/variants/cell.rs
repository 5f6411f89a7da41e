//! A number as a student wrote it.

use mechanics::model::AnswerUnit;
use mechanics::units::{parse_number_or_quantity, parse_unit};
use mechanics::variants::in_unit;

/// A cell of the file with the answers.
#[derive(Clone, Debug, PartialEq)]
pub enum Written {
    /// Nothing.
    Missing,
    /// No number.
    Unreadable,
    /// A number of another dimension; the unit as written.
    Foreign(String),
    /// A number.
    Number {
        /// In the unit of the question.
        value: f64,
        /// Half a unit of the last written place, in the unit of the question.
        half: f64,
    },
}

/// Reads a cell: decimal comma or point, with or without a unit; a bare number is in the unit of the head of the column, else in that of the question.
pub fn read(cell: &str, head: Option<&str>, unit: &AnswerUnit) -> Written {
    let text = cell.trim().trim_start_matches(['=', '≈', '~']).trim();
    if text.is_empty() || ["-", "–", "—"].contains(&text) {
        return Written::Missing;
    }
    let Ok(mut quantity) = parse_number_or_quantity(text) else { return Written::Unreadable };
    if let (false, Some(head)) = (quantity.has_unit, head) {
        match parse_unit(head) {
            Ok(unit) => (quantity.unit, quantity.has_unit) = (unit, true),
            Err(_) => return Written::Foreign(head.to_owned()),
        }
    }
    let number = quantity.number.to_f64();
    let value = match quantity.has_unit {
        false => number,
        true => match in_unit(&quantity, unit) {
            Some(value) => value,
            None => return Written::Foreign(text.trim_start_matches(|c: char| !c.is_alphabetic()).to_owned()),
        },
    };
    if !value.is_finite() {
        return Written::Unreadable;
    }
    let scale = if number == 0.0 { 1.0 } else { (value / number).abs() };
    Written::Number { value, half: 0.5 * last_place(text) * scale }
}

/// One unit of the last written place: 0.01 of `1,23`, 10 of `1,2e2`.
fn last_place(text: &str) -> f64 {
    let text = text.replace(',', ".");
    let digits: String = text.chars().take_while(|c| c.is_ascii_digit() || "+-−. \u{a0}\u{202f}".contains(*c)).collect();
    let decimals = digits.trim_end().split_once('.').map_or(0, |(_, after)| after.trim().len() as i32);
    let behind = text[digits.len()..].trim_start();
    let power = behind.strip_prefix(['e', 'E']).and_then(|rest| {
        let end = rest.find(|c: char| !(c.is_ascii_digit() || c == '-' || c == '+')).unwrap_or(rest.len());
        rest[..end].parse::<i32>().ok()
    });
    let ten = behind.strip_prefix(['·', '*', '×']).and_then(|rest| rest.trim_start().strip_prefix("10^")).and_then(|rest| {
        let end = rest.find(|c: char| !(c.is_ascii_digit() || c == '-')).unwrap_or(rest.len());
        rest[..end].parse::<i32>().ok()
    });
    algebra::elementary::powi(10.0, power.or(ten).unwrap_or(0) - decimals)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(label: &str) -> AnswerUnit {
        let unit = parse_unit(label).unwrap();
        AnswerUnit { label: label.into(), factor: unit.factor.to_f64(), dimension: unit.dimension }
    }
    fn value(cell: &str, head: Option<&str>, label: &str) -> (f64, f64) {
        match read(cell, head, &unit(label)) {
            Written::Number { value, half } => (value, half),
            other => panic!("{cell}: {other:?}"),
        }
    }
    /// A few products and quotients of numbers that are not dyadic.
    const ROUNDING: f64 = 1e-12;

    fn near(a: f64, b: f64) -> bool {
        (a - b).abs() <= ROUNDING * b.abs()
    }

    #[test]
    fn numbers_are_read_with_comma_or_point_and_any_unit() {
        for (cell, head, label, wanted, half) in [
            ("12,5", None, "mm", 12.5, 0.05),
            ("12.50", None, "mm", 12.5, 0.005),
            ("0,0125 м", None, "mm", 12.5, 0.05),
            ("1,25", Some("см"), "mm", 12.5, 0.05),
            ("≈ 13", None, "mm", 13.0, 0.5),
            ("1,2e2", None, "N", 120.0, 5.0),
            ("1,2·10^2 Н", None, "N", 120.0, 5.0),
            ("−3", None, "N", -3.0, 0.5),
            ("2 Гц", None, "rad/s", 4.0 * std::f64::consts::PI, std::f64::consts::PI),
            ("60 об/мин", None, "Hz", 1.0, 1.0 / 120.0),
        ] {
            let (found, place) = value(cell, head, label);
            assert!(near(found, wanted) && near(place, half), "{cell}: {found} {place}");
        }
    }

    #[test]
    fn what_is_no_number_is_said() {
        let read = |cell: &str| read(cell, None, &unit("mm"));
        assert_eq!(read(" "), Written::Missing);
        assert_eq!(read("много"), Written::Unreadable);
        assert_eq!(read("5 кг"), Written::Foreign("кг".into()));
        assert_eq!(unit("mm").dimension, unit("m").dimension);
    }
}
