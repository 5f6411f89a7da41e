//! Units of answers: what a number in SI is in the unit of the question, and what a student's quantity is in it.

use super::misfit::Misfit;
use crate::formula::{Plain, display};
use crate::model::AnswerUnit;
use crate::units::{Dimension, Quantity, Unit, parse_unit, si_label, si_label_ru};
use std::f64::consts::TAU;
use words::Text;

/// The SI value of one unit of the answer for a quantity whose SI unit is `label`: an angular rate in Hz is divided by 2 pi.
///
/// # Errors
/// The dimensions differ, or it cannot be told whether a value in 1/s counts periods or radians.
pub fn scale(label: &str, unit: &AnswerUnit) -> Result<f64, Misfit> {
    let of = if label.is_empty() { Dimension::NONE } else { parse_unit(label).map_or(Dimension::NONE, |u| u.dimension) };
    if !of.same(&unit.dimension) {
        return Err(differ(&of, &unit.dimension));
    }
    if let Some(factor) = turned(&of, unit) {
        return Ok(factor);
    }
    let (factor, fault) = display(&of, &whole(unit), None, Plain::Doubtful);
    fault.map_or(Ok(factor), |fault| Err(Misfit { what: fault.what.clone(), help: fault.help.clone() }))
}

/// The SI value of one unit of the answer where periods meet radians: 1 Hz is 2 pi rad/s.
pub(crate) fn turned(of: &Dimension, unit: &AnswerUnit) -> Option<f64> {
    let counts = |d: &Dimension| d.lacks_radians();
    match (counts(of), counts(&unit.dimension)) {
        (true, false) if unit.dimension.has_radians() && of.pi() <= 0 => Some(unit.factor / TAU),
        // k/(2π) counts periods already
        (false, true) if of.has_radians() && of.pi() >= 0 => Some(unit.factor * TAU),
        _ => None,
    }
}

/// A quantity in the unit of the answer; none where its dimension is another one.
pub fn in_unit(quantity: &Quantity, unit: &AnswerUnit) -> Option<f64> {
    let own = quantity.unit.dimension;
    if !own.same(&unit.dimension) {
        return None;
    }
    Some(quantity.to_f64() / turned(&own, unit).unwrap_or(unit.factor))
}

fn whole(unit: &AnswerUnit) -> Unit {
    parse_unit(&unit.label).unwrap_or(Unit { dimension: unit.dimension, ..Unit::ONE })
}

fn differ(got: &Dimension, wanted: &Dimension) -> Misfit {
    let label =
        |d: &Dimension| (if d.is_none() { "1".to_owned() } else { si_label(d) }, if d.is_none() { "1".to_owned() } else { si_label_ru(d) });
    let (got, wanted) = (label(got), label(wanted));
    Misfit {
        what: Text::new(
            format!("the number is in {}, the unit of the answer in {}", got.0, wanted.0),
            format!("число имеет размерность {}, а единица ответа — {}", got.1, wanted.1),
        ),
        help: Text::new(format!("write unit = \"{}\"", got.0), format!("напишите unit = \"{}\"", got.1)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::parse_number_or_quantity;

    /// A few products and quotients of numbers that are not dyadic.
    const ROUNDING: f64 = 1e-12;

    fn unit(label: &str) -> AnswerUnit {
        let unit = parse_unit(label).unwrap();
        AnswerUnit { label: label.to_owned(), factor: unit.factor.to_f64(), dimension: unit.dimension }
    }

    #[test]
    fn periods_and_radians_are_converted_both_ways() {
        for (written, label, wanted) in [
            ("1 Hz", "rad/s", TAU),
            ("6.283185307179586 rad/s", "Hz", 1.0),
            ("60 rpm", "Hz", 1.0),
            ("1 Hz", "rpm", 60.0),
            ("2 1/s", "rad/s", 2.0),
            ("5 kN", "N", 5000.0),
        ] {
            let found = in_unit(&parse_number_or_quantity(written).unwrap(), &unit(label)).unwrap();
            assert!((found / wanted - 1.0).abs() < ROUNDING, "{written} in {label}: {found}");
        }
        assert_eq!(in_unit(&parse_number_or_quantity("5 kg").unwrap(), &unit("N")), None);
        // 3 Hz are 6 pi rad/s, 3 rad/s are 3/(2 pi) Hz
        assert!((3.0 / scale("Hz", &unit("rad/s")).unwrap() - 3.0 * TAU).abs() < ROUNDING);
        assert!((3.0 / scale("rad/s", &unit("Hz")).unwrap() - 3.0 / TAU).abs() < ROUNDING);
        assert!(scale("1/s", &unit("Hz")).is_err() && scale("m", &unit("Hz")).is_err());
    }
}
