//! Faults of small motions.

use words::{Message, Text};

use super::Fault;

/// S092.
pub(crate) fn refused(why: Text) -> Fault {
    Fault::new(Message {
        code: "S092",
        what: Text::new("no linear equations of small motions here", "линейных уравнений малых движений здесь нет"),
        why,
        help: Text::new(
            "leave out conditions that repeat others, or use `simulate` or `periodic`",
            "уберите связи, повторяющие другие, либо примените `simulate` или `periodic`",
        ),
    })
}

/// S066.
pub(crate) fn rounded_away(what: Text) -> Fault {
    Fault::new(Message {
        code: "S066",
        what,
        why: Text::new(
            "stiffnesses, dampings or masses lie more than some 10^13 apart, so that their sums keep too few digits of the small ones",
            "жёсткости, сопротивления или массы различаются более чем в 10^13 раз, и в их суммах остаётся слишком мало цифр меньших",
        ),
        help: Text::new(
            "replace the strong part by a rigid connection, or leave out the weak one",
            "замените жёсткую часть жёсткой связью или исключите слабую",
        ),
    })
}

/// A fault of a formula as that of an output that has no slope at a place of rest.
pub fn no_slope(output: &str, fault: &Fault) -> Fault {
    let what = &fault.message.what;
    Fault::new(Message {
        code: fault.code,
        what: Text::new(
            format!("the output `{output}` has no slope at the place of rest: {}", what.en),
            format!("у величины `{output}` в положении равновесия нет производных: {}", what.ru),
        ),
        why: Text::new(
            "small motions show what is smooth there; a distance from the place itself, or an angle about it, is not",
            "малые движения показывают лишь гладкие величины; расстояние от самого положения и угол вокруг него таковыми не являются",
        ),
        help: Text::new(
            "leave it out of `outputs`, or use `simulate` or `periodic`",
            "исключите её из `outputs` либо примените `simulate` или `periodic`",
        ),
    })
}
