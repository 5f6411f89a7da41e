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
