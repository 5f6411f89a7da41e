//! Putting a machine together: starts, loops, conditions that contradict each other.

use crate::fault::codes;
use words::{Message, Text};

use super::Fault;
use words::digits::{rounded, ten_digits};

pub(super) const START_EN: &str = "A machine with connections needs as many start values as it has degrees of freedom; the others follow. Values that are given are kept, so \
    redundant ones must agree with the connections to ten digits. The message prints the value that closes the loop when each given value is \
    released alone.";
pub(super) const START_RU: &str = "Машине со связями нужно столько начальных значений, сколько у неё степеней свободы; остальные вычисляются. Заданные значения сохраняются, поэтому \
    лишние должны согласовываться со связями в десяти знаках. В сообщении указано значение, замыкающее контур, если освободить каждое из заданных \
    по отдельности.";
pub(super) const LOOP_EN: &str = "From the given start and from guesses around it no configuration was found that fulfils all conditions. The message names the condition \
    that stays open and the smallest gap.";
pub(super) const LOOP_RU: &str = "Ни из заданного начала, ни из приближений вокруг него не найдено положения, удовлетворяющего всем условиям. В сообщении указано незамкнутое условие \
    и наименьший зазор.";
pub(super) const CONTRADICTION_EN: &str =
    "Conditions that act on the same motion must agree: a repeated one is left out with a note, a contradictory one is an error.";
pub(super) const CONTRADICTION_RU: &str = "Условия, действующие на одно и то же движение, должны быть согласованы: повторяющее условие отбрасывается с примечанием, противоречивое - ошибка.";
pub(super) const SINGULAR_EN: &str = "Conditions that are independent near this position depend on each other in it: a flat parallelogram, a toggle at its dead centre. The equations do \
    not decide which way the motion goes on. A linkage that passes such a position with speed is followed through it.";
pub(super) const SINGULAR_RU: &str = "Условия, независимые вблизи этого положения, в нём самом зависимы: сложенный параллелограмм, рычаги в мёртвой точке. Уравнения не решают, как \
    продолжится движение. Механизм, проходящий такое положение со скоростью, рассчитывается насквозь.";
pub(super) const MOVED_EN: &str = "`rest = \"start\"` of a spring and the default lengths of rods and ropes are those of the start. A coordinate with a `guess` has its place there after the \
    connections have closed; one with neither `start` nor `guess` has 0. Here connections move it all the same, and the length would belong to another configuration. Give the coordinate \
    a start or a guess, or the length a number.";
pub(super) const MOVED_RU: &str = "`rest = \"start\"` пружины и длины стержней и канатов по умолчанию относятся к началу движения. Координата с `guess` имеет там значение, найденное при замыкании связей; \
    координата без `start` и `guess` – нуль. Здесь связи всё же сдвигают её, и длина относилась бы к другому положению. Задайте координате `start` или `guess` или длину числом.";

impl Fault {
    /// Given start values that contradict the connections. `each` closes the loop alone, or `together` all of them: (name, value, unit).
    pub fn inconsistent_start(condition: &Text, each: &[(String, f64, String)], together: &[(String, f64, String)]) -> Fault {
        let said = |list: &[(String, f64, String)], ru: bool, joint: &str| {
            let one = |(name, value, unit): &(String, f64, String)| {
                let (n, unit) = (ten_digits(*value), Text::unit(unit));
                if ru { format!("{name} = {} {}", n.ru, unit.ru) } else { format!("{name} = {} {}", n.en, unit.en) }
            };
            list.iter().map(one).collect::<Vec<_>>().join(joint)
        };
        let help = if each.is_empty() {
            Text::new(
                format!("{} close it together; leave out the start values that are to be found", said(together, false, ", ")),
                format!("вместе замыкают её {}; уберите начальные значения, которые нужно найти", said(together, true, ", ")),
            )
        } else {
            Text::new(
                format!("{} closes it; or leave this start value out, and it is found", said(each, false, ", or ")),
                format!("замыкает её {}; или уберите это начальное значение, и оно будет найдено", said(each, true, " или ")),
            )
        };
        Fault::new(Message {
            code: "S015",
            what: Text::new(
                format!("the given start values do not fit the connection `{}`", condition.en),
                format!("заданные начальные значения не согласуются со связью `{}`", condition.ru),
            ),
            why: Text::new(
                "more start values are given than the machine has degrees of freedom, and one of them is inaccurate or wrong",
                "задано больше начальных значений, чем степеней свободы у машины, и одно из них неточно или неверно",
            ),
            help,
        })
    }

    /// Loops that no configuration closes.
    pub fn cannot_close(condition: &Text, gap: f64, places: &Text) -> Fault {
        let n = rounded(gap);
        Fault::new(Message {
            code: "S016",
            what: Text::new(
                format!("the connection `{}` cannot be closed: at best {} is left over, at {}", condition.en, n.en, places.en),
                format!("связь `{}` не замыкается: в лучшем случае остаётся {}, при {}", condition.ru, n.ru, places.ru),
            ),
            why: Text::new(
                "the lengths do not reach, or the bodies would have to overlap",
                "длин не хватает, или тела должны были бы пересечься",
            ),
            help: Text::new(
                "check lengths and positions; give start values nearer to a configuration that exists",
                "проверьте длины и положения; задайте начальные значения ближе к существующей конфигурации",
            ),
        })
    }

    /// Conditions that hold the same motion and disagree.
    pub fn contradiction(conditions: &Text, places: &Text) -> Fault {
        Fault::new(Message {
            code: codes::CONTRADICTION,
            what: Text::new(
                format!("these conditions contradict each other: {}, at {}", conditions.en, places.en),
                format!("эти условия противоречат друг другу: {}, при {}", conditions.ru, places.ru),
            ),
            why: Text::new("they hold the same motion in different ways", "они удерживают одно и то же движение по-разному"),
            help: Text::new("remove one of them, or make their numbers agree", "уберите одно из них или согласуйте числа"),
        })
    }

    /// A start from which no motion follows.
    pub fn singular_start(conditions: &Text, places: &Text) -> Fault {
        Fault::new(Message {
            code: "S018",
            what: Text::new(
                format!("the machine starts in a singular configuration, {}: {}", places.en, conditions.en),
                format!("машина начинает движение из особого положения, {}: {}", places.ru, conditions.ru),
            ),
            why: Text::new(
                "these conditions depend on each other here and nowhere near: a dead centre, a stretched or flat linkage, from which the motion can go on in two ways",
                "эти условия зависимы здесь и независимы рядом: мёртвая точка, вытянутый или сложенный механизм, из которого движение может продолжиться двояко",
            ),
            help: Text::new("start a little beside this position", "начните немного в стороне от этого положения"),
        })
    }

    /// A length that is measured at the start, where a coordinate has moved since.
    pub fn moved_start(user: &str, coordinate: &str, [measured, found]: [f64; 2], unit: &str) -> Fault {
        let (old, new, unit) = (rounded(measured), rounded(found), Text::unit(unit));
        Fault::new(Message {
            code: "S121",
            what: Text::new(
                format!(
                    "`{user}` is measured at the start with {coordinate} = {} {}, but the machine starts with {} {}",
                    old.en, unit.en, new.en, unit.en
                ),
                format!(
                    "`{user}` измеряется в начале движения при {coordinate} = {} {}, но машина начинает движение при {} {}",
                    old.ru, unit.ru, new.ru, unit.ru
                ),
            ),
            why: Text::new(
                "other connections have moved this coordinate from its value, and the length would be that of another configuration",
                "другие связи сдвинули эту координату с её значения, и длина относилась бы к другому положению",
            ),
            help: Text::new(
                format!("give `{coordinate}` its `start`, a `guess` nearer to the closed configuration, or give the length as a number"),
                format!("задайте для `{coordinate}` значение `start`, более близкое приближение `guess` или саму длину числом"),
            ),
        })
    }
}
