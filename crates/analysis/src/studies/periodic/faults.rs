//! What the search for a regime says when it fails, and how far it closes.

use super::options::{Periodic, Return};
use crate::Fault;
use crate::dataset::Audit;
use crate::fault::codes;
use words::digits::{number, rounded};
use words::{Message, Text};

pub(super) fn interrupted(options: &Periodic<'_>) -> bool {
    options.listener.is_interrupted()
}

/// The motion does not come back to the section.
pub(super) fn no_return(name: &Text, options: &Periodic<'_>) -> Fault {
    let n = rounded(options.longest);
    let help = match options.by {
        Return::Period(_) => Text::new(
            "time does not occur in the equations, so a period cannot be given: name what returns, for example section = \"x'\", and begin nearer to the regime",
            "время в уравнения не входит, и период задать нельзя: назовите то, что возвращается, например section = \"x'\", и начните ближе к режиму",
        ),
        _ => Text::new(
            "name what turns or returns (section = \"phi\" or section = \"x'\"), or let the motion settle first (settle = \"20 s\")",
            "назовите то, что совершает оборот или возвращается (section = \"phi\" или section = \"x'\"), или дайте движению установиться (settle = \"20 s\")",
        ),
    };
    Fault::new(Message {
        code: codes::NEVER_BACK,
        what: Text::new(
            format!("{} does not come back within {} s", name.en, n.en),
            format!("{} не возвращается в течение {} с", name.ru, n.ru),
        ),
        why: Text::new(
            "the machine comes to rest, runs away, or needs another section",
            "машина останавливается, уходит неограниченно далеко или нужно другое сечение",
        ),
        help,
    })
}

/// Newton's method and the iteration of turns came to no end.
pub(super) fn unsettled(residual: f64, turns: usize) -> Fault {
    let n = rounded(residual);
    Fault::new(Message {
        code: codes::NO_REGIME,
        what: Text::new(
            format!("no periodic regime was found in {turns} turns; the motion still misses its start by {} of its range", n.en),
            format!("за {turns} оборотов периодический режим не найден; движение не возвращается в начало на {} своего размаха", n.ru),
        ),
        why: Text::new(
            "the start is far from a regime, the motion is not periodic (beats, chaos), or it repeats only after several returns",
            "начало далеко от режима, движение не периодическое (биения, хаос) или повторяется только через несколько возвращений",
        ),
        help: Text::new(
            "begin nearer to the regime (settle = \"20 s\"), name another section, or give a period that holds all returns",
            "начните ближе к режиму (settle = \"20 s\"), выберите другое сечение или задайте период, охватывающий все возвращения",
        ),
    })
}

/// Time occurs in the equations, so the period is that of the forcing.
pub(super) fn driven(given: Option<f64>) -> Fault {
    let what = match given {
        None => Text::new("time occurs in the equations, and no period is given", "время входит в уравнения явно, а период не задан"),
        Some(period) => {
            let n = number(period);
            Text::new(format!("{} s is not a period of the forces", n.en), format!("{} с – не период вынуждающих сил", n.ru))
        }
    };
    Fault::new(Message {
        code: codes::FORCED,
        what,
        why: Text::new(
            "a forced motion can repeat only after whole periods of its forcing",
            "вынужденное движение может повторяться только через целое число периодов возмущения",
        ),
        help: Text::new(
            "give the period of the forcing, for example period = \"2*pi/p\"",
            "задайте период возмущения, например period = \"2*pi/p\"",
        ),
    })
}

/// The formula that begins a period has no zero on the regime.
pub(super) fn never_passed() -> Fault {
    Fault::new(Message {
        code: "S044",
        what: Text::new(
            "the periodic motion never passes the section from below",
            "периодическое движение ни разу не проходит сечение снизу вверх",
        ),
        why: Text::new("the formula of the section keeps its sign over the whole period", "формула сечения сохраняет знак на всём периоде"),
        help: Text::new(
            "choose a section that the motion crosses, for example a rate: section = \"x'\"",
            "выберите сечение, которое движение пересекает, например скорость: section = \"x'\"",
        ),
    })
}

/// A machine without states.
pub(super) fn nothing_moves() -> Fault {
    Fault::new(Message {
        code: "S056",
        what: Text::new("nothing can move, so nothing can repeat", "двигаться нечему, и повторяться нечему"),
        why: Text::new("the model has no coordinates", "в модели нет координат"),
        help: Text::new(
            "ask for statics or modes of a structure; a machine needs [coordinates]",
            "для конструкции запросите statics или modes; машине нужны [coordinates]",
        ),
    })
}

/// The rates have no derivative by the state.
pub(super) fn no_derivative(t: f64) -> Fault {
    let n = rounded(t);
    Fault::new(Message {
        code: codes::NO_DERIVATIVE,
        what: Text::new(
            format!("at t = {} s the equations have no derivative by the state", n.en),
            format!("при t = {} с уравнения не имеют производной по состоянию", n.ru),
        ),
        why: Text::new(
            "a root, a fractional power or a similar formula is at its zero there",
            "корень, дробная степень или подобная формула обращается там в нуль",
        ),
        help: Text::new(
            "replace the formula near its zero by a smooth one; the period and the start hold without it",
            "замените формулу вблизи нуля гладкой; период и начало верны и без этого",
        ),
    })
}

/// The variational equations cannot be followed.
pub(super) fn too_quick(t: f64) -> Fault {
    let n = rounded(t);
    Fault::new(Message {
        code: codes::NO_VARIATIONS,
        what: Text::new(
            format!("the variations cannot be followed beyond t = {} s", n.en),
            format!("решения в вариациях не удаётся продолжить дальше t = {} с", n.ru),
        ),
        why: Text::new(
            "a disturbance moves too quickly beside the regime, or the equations are singular there",
            "возмущение изменяется слишком быстро по сравнению с режимом, или уравнения там вырождены",
        ),
        help: Text::new(
            "replace what is all but rigid by a connection; the period and the start hold without it",
            "замените почти жёсткое звено связью; период и начало верны и без этого",
        ),
    })
}

/// A forced motion begins where its forces begin.
pub fn section_of_forced() -> Fault {
    Fault::new(Message {
        code: "S057",
        what: Text::new("a forced motion cannot begin at a section", "вынужденное движение не может начинаться с сечения"),
        why: Text::new(
            "time occurs in the equations: the period begins at t = 0, where the state is what the forces make it",
            "время входит в уравнения: период начинается при t = 0, где состояние определяют силы",
        ),
        help: Text::new("keep `period` and drop `section`", "оставьте `period` и уберите `section`"),
    })
}

/// Checks of a regime.
pub(super) fn closure(value: f64) -> Audit {
    let name = Text::new(
        "the motion comes back to its start: largest relative difference",
        "движение возвращается в начало: наибольшее относительное расхождение",
    );
    // Newton ends at 1e-12 and less; the motion repeats to ten digits
    Audit::at_most("closure", name, value, 1e-10)
}
