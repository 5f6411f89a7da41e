//! Faults of small motions.

use words::explain::{Explanation, plain};
use words::{Message, Text};

use super::Fault;

/// What `strutt explain` says of these codes.
pub(crate) const EXPLANATIONS: &[Explanation] =
    &[plain("S096", ("a frame that cannot be followed", "раму нельзя проследить"), (FOLLOWED_EN, FOLLOWED_RU))];

const FOLLOWED_EN: &str = "A frame under a machine enters its equations by numbers: inertias, stiffnesses and shares of loads over its coordinates. A study that follows a     parameter of the frame takes these numbers anew for every value. Here the frame is represented in another way at that value (other coordinates, or more     amplitudes for the wanted accuracy), or it is sought beside connections. Run the study once for each value: `sweep` or --set make the frame anew.";
const FOLLOWED_RU: &str = "Рама под машиной входит в уравнения числами: инерциями, жёсткостями и долями нагрузок по её координатам. Расчёт, который идёт вдоль параметра     рамы, находит эти числа заново при каждом значении. Здесь при этом значении раму представляют иначе (другие координаты или больше амплитуд для     нужной точности), либо величину рамы ищут при наличии связей. Повторите расчёт для каждого значения: `sweep` и --set составляют раму заново.";

/// S092.
pub(crate) fn refused(why: Text) -> Fault {
    let help = Text::new(
        "leave out conditions that repeat others, or use `simulate` or `periodic`",
        "уберите связи, повторяющие другие, либо примените `simulate` или `periodic`",
    );
    not_linear(why, help)
}

fn not_linear(why: Text, help: Text) -> Fault {
    Fault::new(Message {
        code: "S092",
        what: Text::new("no linear equations of small motions here", "линейных уравнений малых движений здесь нет"),
        why,
        help,
    })
}

/// S092 where contacts only touch at the place of rest.
pub fn one_sided(labels: &[Text]) -> Fault {
    let list = |pick: fn(&Text) -> &str| labels.iter().map(pick).collect::<Vec<_>>().join(", ");
    let (en, ru) = (list(|t| &t.en), list(|t| &t.ru));
    let why = Text::new(
        format!(
            "a one-sided contact is closed at the place of rest and presses with no force ({en}): it only touches, and small motions are one-sided"
        ),
        format!(
            "односторонняя связь в положении равновесия замкнута, но не нагружена ({ru}): она лишь касается, и малые движения односторонние"
        ),
    );
    let help = Text::new(
        "leave the contact out if it takes no part, or load it so that it presses; `simulate` and `periodic` follow the motion with the contact",
        "уберите эту связь, если она не участвует, или нагрузите её; движение с нею рассчитывают `simulate` и `periodic`",
    );
    not_linear(why, help)
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
