//! Faults of formulas of places with kinks and steps.

use words::{Message, Text};

use super::Fault;
use words::digits::number;
use words::explain::{Explanation, plain};

/// Rows of such formulas.
pub const EXPLANATIONS: &[Explanation] = &[
    plain("S137", ("a place that a formula bends", "излом формулы положения"), (BENT_EN, BENT_RU)),
    plain("S138", ("a connection that a formula bends", "излом формулы связи"), (CONDITION_EN, CONDITION_RU)),
    plain("S139", ("a place that jumps", "скачок положения"), (BROKEN_EN, BROKEN_RU)),
    plain("S140", ("a pathway that jumps", "скачок координаты элемента"), (PATHWAY_EN, PATHWAY_RU)),
];

const BENT_EN: &str = "Where a formula of coordinates that places a body has a kink (max, min, abs, if), the body would change its velocity in no time as the machine goes over \
    it. In truth something strikes or catches there, and whether the blow is plastic or elastic, and what takes the impulse, no formula of places says. Give the body a coordinate of \
    its own and say what acts: a stop, a rope, a spring with backlash. A smooth formula has no kink, and velocities may jump by formulas of time.";
const BENT_RU: &str = "Если у формулы через координаты, задающей положение тела, есть излом (max, min, abs, if), при его прохождении скорость тела изменилась бы мгновенно. На деле там \
    происходит удар или захват, и формула положения не говорит ни о том, упругий он или нет, ни о том, что воспринимает импульс. Дайте телу собственную координату и укажите, что на него \
    действует: упор, нить, пружина с зазором. У гладкой формулы излома нет; скорости, заданные формулами времени, изменяться скачком могут.";
const CONDITION_EN: &str = "A connection that holds by a formula with a kink would turn the velocities of the machine in no time as it goes over the kink: a blow that no law \
    describes. Make the formula smooth (a fillet), or give each branch of it a connection of its own: two stops, one for each side of a corner, strike by their restitution.";
const CONDITION_RU: &str = "Связь, заданная формулой с изломом, при его прохождении мгновенно повернула бы скорости машины: это удар, не описанный никаким законом. Сгладьте формулу \
    (скругление) или задайте каждой её ветви свою связь: два упора по сторонам угла ударяют со своими коэффициентами восстановления.";
const BROKEN_EN: &str = "A formula that places a body, or that a connection holds, has a step: the machine would have to be elsewhere in no time. Let it run there within a time \
    (a ramp), or begin a new motion from the new place. A stop that jumps away from what lies on it lets it fall; one that jumps into it is refused.";
const BROKEN_RU: &str = "Формула, задающая положение тела или связь, имеет скачок: машине пришлось бы мгновенно оказаться в другом месте. Задайте переход за конечное время или начните новое \
    движение из нового положения. Упор, скачком отошедший от лежащего на нём тела, отпускает его; скачок упора внутрь тела недопустим.";

const PATHWAY_EN: &str = "The potential energy jumps as the machine goes over a switch of a formula of coordinates: the pathway of a spring has a step there, as an angle by atan2 \
    has on the negative axis, where it falls by a whole turn. The step would do work in no time, and no force stands for it. Let the body have its angle as a coordinate (with a constraint \
    that turns it), or write the pathway without a step. Stiffnesses may jump with the time.";
const PATHWAY_RU: &str = "Потенциальная энергия изменяется скачком при прохождении переключения формулы через координаты: у координаты пружины там разрыв, как у угла atan2 на отрицательной \
    полуоси, где он уменьшается на целый оборот. Такой скачок совершил бы работу мгновенно, и никакой силы ему не отвечает. Сделайте угол тела обобщённой координатой (со связью, которая \
    его поворачивает) или запишите координату пружины без разрыва. Жёсткости могут изменяться скачком по времени.";

fn at(switch: &Text, t: f64) -> Text {
    let n = number(t);
    Text::new(
        format!("at t = {} s, where `{}` changes its side", n.en, switch.en),
        format!("при t = {} с, где `{}` меняет знак", n.ru, switch.ru),
    )
}

/// S137: momenta jump with the formula that places a body.
pub(crate) fn bent_place(switch: &Text, t: f64) -> Fault {
    let at = at(switch, t);
    Fault::new(Message {
        code: "S137",
        what: Text::new(
            format!("a body would change its velocity in no time {}", at.en),
            format!("скорость тела изменилась бы мгновенно {}", at.ru),
        ),
        why: Text::new(
            "the formula of coordinates that places it has a kink there; what strikes the body, and with which restitution, it does not say",
            "у формулы через координаты, задающей его положение, там излом; что ударяет тело и с каким восстановлением, она не говорит",
        ),
        help: Text::new(
            "give the body a coordinate of its own and a stop, a rope or a spring, or place it by a smooth formula",
            "дайте телу собственную координату и упор, нить или пружину либо задайте положение гладкой формулой",
        ),
    })
}

/// S138: a condition in force has a kink.
pub(crate) fn bent_condition(condition: &Text, (switch, t): (&Text, f64)) -> Fault {
    let at = at(switch, t);
    Fault::new(Message {
        code: "S138",
        what: Text::new(format!("`{}` has a kink {}", condition.en, at.en), format!("у связи `{}` излом {}", condition.ru, at.ru)),
        why: Text::new(
            "going over it the machine would be struck; a connection by a formula has no law of impact",
            "при его прохождении машина испытала бы удар, а у связи, заданной формулой, закона удара нет",
        ),
        help: Text::new(
            "make the formula smooth, or give each side of the kink a stop of its own",
            "сгладьте формулу или задайте каждой стороне излома свой упор",
        ),
    })
}

/// S139: a condition, or a gap, has a step that the machine would have to follow.
pub(crate) fn broken_condition(condition: &Text, (switch, t): (&Text, f64)) -> Fault {
    let at = at(switch, t);
    broken(Text::new(
        format!("the formula of `{}` jumps {}", condition.en, at.en),
        format!("формула связи `{}` изменяется скачком {}", condition.ru, at.ru),
    ))
}

/// S139: a body would stand elsewhere.
pub(crate) fn broken_place(switch: &Text, t: f64) -> Fault {
    let at = at(switch, t);
    broken(Text::new(format!("the place of a body jumps {}", at.en), format!("положение тела изменяется скачком {}", at.ru)))
}

/// S140: the potential energy jumps at a switch of places.
pub(crate) fn broken_pathway(switch: &Text, t: f64) -> Fault {
    let at = at(switch, t);
    Fault::new(Message {
        code: "S140",
        what: Text::new(format!("the potential energy jumps {}", at.en), format!("потенциальная энергия изменяется скачком {}", at.ru)),
        why: Text::new(
            "the pathway of a spring has a step there (atan2 falls by a turn, an `if` over a coordinate): it would do work in no time",
            "у координаты пружины там разрыв (atan2 уменьшается на оборот, `if` через координату): работа совершилась бы мгновенно",
        ),
        help: Text::new(
            "make the angle a coordinate, or write the pathway without a step",
            "сделайте угол обобщённой координатой или запишите координату пружины без разрыва",
        ),
    })
}

fn broken(what: Text) -> Fault {
    Fault::new(Message {
        code: "S139",
        what,
        why: Text::new("no force moves a body in no time", "никакая сила не переместит тело мгновенно"),
        help: Text::new(
            "let it run to the new place within a time, or begin a new motion there",
            "задайте переход за конечное время или начните новое движение оттуда",
        ),
    })
}
