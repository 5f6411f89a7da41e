//! Units of answers: what a number in SI is in the unit of the question, and what a student's quantity is in it.

use super::Misfit;
use crate::formula::{Plain, display};
use crate::model::AnswerUnit;
use crate::units::{Dimension, Quantity, Unit, parse_unit, si_label, si_label_ru};
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
    let (factor, fault) = display(&of, &whole(unit), None, Plain::Doubtful);
    fault.map_or(Ok(factor), |fault| Err(Misfit { what: fault.what.clone(), help: fault.help.clone() }))
}

/// A quantity in the unit of the answer; none where its dimension is another one.
pub fn in_unit(quantity: &Quantity, unit: &AnswerUnit) -> Option<f64> {
    let own = quantity.unit.dimension;
    if !own.same(&unit.dimension) {
        return None;
    }
    let (factor, _) = display(&own, &whole(unit), None, Plain::Periods);
    Some(quantity.to_f64() / factor)
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
