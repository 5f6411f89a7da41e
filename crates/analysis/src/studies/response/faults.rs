//! What forced oscillations refuse.

use crate::Fault;
use crate::fault::small::refused;
use words::digits::rounded;
use words::explain::{Explanation, plain};
use words::{Message, Text};

/// S066.
pub const ROUNDED: Explanation =
    plain("S066", ("a result that hangs on rounding", "результат, определяемый округлением"), (ROUNDED_EN, ROUNDED_RU));

const ROUNDED_EN: &str = "Where one spring or damper is more than some 10^13 times as strong as another, their sum in the stiffness matrix keeps few or no digits of the weak \
    one, and slow roots and amplitudes follow from rounding. Refinement puts right what elimination loses, but not what the sums have lost. Wrong: two masses joined by 1e17 N/m on a \
    support of 100 N/m. Right: one body, or a weld between them.";
const ROUNDED_RU: &str = "Если одна пружина или демпфер более чем в 10^13 раз сильнее другой, в их сумме в матрице жёсткости почти или совсем не остаётся цифр слабой, и амплитуды \
    и медленные корни определяет округление. Уточнение исправляет потери при исключении, но не потери в суммах. Неверно: две массы, соединённые пружиной 1e17 N/m, на опоре 100 N/m. Верно: \
    одно тело или жёсткое соединение.";

pub(super) fn no_load() -> Fault {
    Fault::new(Message {
        code: "S032",
        what: Text::new("nothing excites the machine harmonically", "гармонической нагрузки нет"),
        why: Text::new(
            "no force, torque or base motion of the form A sin(p*t) or A cos(p*t) acts along a coordinate (one that supports alone bear moves nothing), or its amplitude is zero",
            "вдоль координат не действует ни сила, ни момент, ни движение основания вида A sin(p*t) или A cos(p*t) (нагрузка, целиком воспринимаемая опорами, ничего не движет), либо амплитуда равна нулю",
        ),
        help: Text::new(
            "name a load: load = \"x\" puts a unit load on the coordinate x; a reaction that bears the load alone is shown when it is named in outputs",
            "укажите нагрузку: load = \"x\" — единичная нагрузка по координате x; реакция, целиком воспринимающая нагрузку, приводится, если указана в outputs",
        ),
    })
}

/// The loads are not periodic.
pub fn no_period() -> Fault {
    Fault::new(Message {
        code: "S076",
        what: Text::new("the load is not periodic", "нагрузка непериодична"),
        why: Text::new(
            "time stands outside of sines and cosines, or their frequencies have no whole ratios, so there is no steady response at a frequency; or it stands in a sine inside another function of \
             a coordinate (a body on a base that turns by r*sin(p*t)), which is not taken apart",
            "время входит не только в синусы и косинусы, либо их частоты несоизмеримы, поэтому установившегося отклика на частоте нет; либо оно стоит в синусе внутри другой функции от \
             координаты (тело на основании, поворачивающемся на r*sin(p*t)), а такие функции не разлагаются",
        ),
        help: Text::new(
            "write the load with sin and cos of p*t (also inside sign, abs, if, min, max), name another one with load, or use periodic or simulate",
            "запишите нагрузку через sin и cos от p*t (также внутри sign, abs, if, min, max), укажите другую ключом load или примените periodic либо simulate",
        ),
    })
}

/// Several parameters could be the frequency.
pub fn ambiguous(names: &[String]) -> Fault {
    let list = names.join(", ");
    Fault::new(Message {
        code: "S033",
        what: Text::new(format!("which is the frequency: {list}?"), format!("что является частотой: {list}?")),
        why: Text::new(
            "the loads oscillate with several of these parameters",
            "нагрузки колеблются с частотами, зависящими от этих параметров",
        ),
        help: Text::new("name it: over = \"p\"", "укажите: over = \"p\""),
    })
}

pub(super) fn not_proportional(name: &str) -> Fault {
    Fault::new(Message {
        code: "S033",
        what: Text::new(
            format!("the frequency of the load is not proportional to `{name}`"),
            format!("частота нагрузки не пропорциональна `{name}`"),
        ),
        why: Text::new(
            "the response is taken over the frequency, which this parameter must set",
            "отклик строится по частоте, а её должен задавать этот параметр",
        ),
        help: Text::new(
            "name another parameter, or write the load as A*sin(p*t)",
            "укажите другой параметр или запишите нагрузку как A*sin(p*t)",
        ),
    })
}

/// A frequency that nothing can change.
pub(super) fn written_as_number(rate: f64) -> Fault {
    let n = rounded(rate);
    Fault::new(Message {
        code: "S033",
        what: Text::new(
            format!(
                "the frequency of the load, {} rad/s, does not change with ω: it is a number in its formula, or the load moves no coordinate",
                n.en
            ),
            format!(
                "частота нагрузки {} рад/с не меняется вместе с ω: она записана в формуле числом, либо нагрузка не движет ни одну координату",
                n.ru
            ),
        ),
        why: Text::new(
            "a reaction that bears the load, a point of a moving base, and the inertia or damping force of a motion given in time keep the number",
            "реакция, воспринимающая нагрузку, точка движущегося основания, сила инерции или сопротивления заданного во времени движения сохраняют это число",
        ),
        help: Text::new(
            "make the frequency a parameter, p = \"7 rad/s\", write cos(p*t), and name it: over = \"p\"; that shows what bears a load that moves nothing, too",
            "сделайте частоту параметром, p = \"7 рад/с\", запишите cos(p*t) и укажите его: over = \"p\"; так видна и реакция на нагрузку, которая ничего не движет",
        ),
    })
}

/// A connection that changes with time moves the machine.
pub fn through_connections() -> Fault {
    refused(Text::new(
        "a connection changes with time: it moves the machine through reactions, which the loads of the linear equations do not hold",
        "связь меняется со временем: она движет машину через реакции, которых нет среди нагрузок линейных уравнений",
    ))
}

/// A range of frequencies that cannot be used.
pub fn bad_range(from: f64, to: f64) -> Fault {
    let (a, b) = (rounded(from), rounded(to));
    Fault::new(Message {
        code: "S034",
        what: Text::new(
            format!("the range of frequencies {} ... {} has no meaning", a.en, b.en),
            format!("диапазон частот {} ... {} не имеет смысла", a.ru, b.ru),
        ),
        why: Text::new(
            "frequencies are positive and ascend; a logarithmic axis begins above zero",
            "частоты положительны и возрастают; логарифмическая ось начинается выше нуля",
        ),
        help: Text::new("give for example 1,100 (rad/s)", "задайте, например, 1,100 (рад/с)"),
    })
}
