//! Faults of rest: friction that is too weak, loads that friction leaves open.

use crate::fault::codes;
use symbolic::Equations;
use symbolic::connections::Law;
use words::{Message, Text};

use crate::Fault;
use words::digits::rounded;
use words::explain::{Explanation, plain};

/// S093.
pub const SLIPS: Explanation = plain("S093", ("friction is too weak to hold", "трения недостаточно для покоя"), (SLIPS_EN, SLIPS_RU));
/// S094.
pub const OPEN: Explanation =
    plain("S094", ("friction leaves an unknown open", "трение оставляет неизвестное неопределённым"), (OPEN_EN, OPEN_RU));

/// S127.
pub const NO_LIMIT: Explanation =
    plain("S127", ("no limiting equilibrium in the range", "в диапазоне нет предельного равновесия"), (NO_LIMIT_EN, NO_LIMIT_RU));
const NO_LIMIT_EN: &str = "With `over`, `range` and [impending] the study `equilibrium` looks for places of rest in which the named frictions are at their limits in the given \
    directions: the ends of the ranges in which dry friction holds the machine. In this range there are none. Directions are those of the sliding that is about to begin, along the \
    friction's own path; at the other end of a range of rest they are the opposite ones.";
const NO_LIMIT_RU: &str = "С ключами `over`, `range` и таблицей [impending] расчёт `equilibrium` ищет положения покоя, в которых названные трения на пределе в указанных \
    направлениях: границы областей, где машину удерживает сухое трение. В этом диапазоне их нет. Направление – сторона скольжения, готового начаться, по пути самого трения; на \
    другой границе области покоя оно противоположное.";

/// S082.
pub const JOURNAL: Explanation = plain("S082", ("statics with a journal", "статика с трением в цапфе"), (JOURNAL_EN, JOURNAL_RU));

const JOURNAL_EN: &str = "Whether friction holds a machine at rest is decided by linear inequalities in the reactions. The limit of a journal, mu r times the whole force of its \
    pin, is not linear: `equilibrium` and `statics` refuse it. Follow the motion with `simulate`, which takes it exactly and shows whether the machine stays; or leave the \
    friction out for the places of rest without it.";
const JOURNAL_RU: &str = "Удерживает ли трение машину в покое, решают линейные неравенства для реакций. Предел трения в цапфе, mu r, умноженное на полную реакцию шарнира, нелинеен: \
    `equilibrium` и `statics` его не принимают. Рассчитайте движение в `simulate`, где оно учитывается точно и видно, остаётся ли машина в покое; или уберите трение, \
    чтобы найти положения равновесия без него.";

/// The refusal of a machine with a journal; none without.
pub(crate) fn journal(equations: &Equations) -> Option<Fault> {
    let help = Text::new(
        "follow the motion with `simulate`, or leave this friction out",
        "рассчитайте движение в `simulate` или уберите это трение",
    );
    nonlinear(equations, help)
}

/// The same where unknowns were to be found with it.
pub(crate) fn journal_with_unknowns(equations: &Equations) -> Option<Fault> {
    let help = Text::new(
        "give the [unknowns] values in [parameters] and see with `simulate` on which side of the limit they are",
        "задайте неизвестным из [unknowns] значения в [parameters] и проверьте в `simulate`, по какую сторону от предела они лежат",
    );
    nonlinear(equations, help)
}

fn nonlinear(equations: &Equations, help: Text) -> Option<Fault> {
    let two = |law: &Law| matches!(law, Law::Friction(friction) if friction.across.is_some());
    let reaction = equations.reactions.iter().find(|r| two(&r.law))?;
    let (en, ru) = (&reaction.label.en, &reaction.label.ru);
    Some(Fault::new(Message {
        code: "S082",
        what: Text::new(
            format!("{en}: its limit at rest is not linear in the reactions"),
            format!("{ru}: его предел при покое нелинеен по реакциям"),
        ),
        why: Text::new(
            "the force of the pin has two components, and their magnitude presses",
            "реакция шарнира имеет две составляющие, и прижимает её модуль",
        ),
        help,
    }))
}

/// S065.
pub const WANDERING: Explanation = plain(
    "S065",
    ("a connection of rates that leads to no place", "связь скоростей, не определяющая положения"),
    (WANDERING_EN, WANDERING_RU),
);

const WANDERING_EN: &str = "A connection that is given in rates only and is not integrable (a skate, rolling in space, a `zero_rate` whose factors are no gradient) restrains \
    how the machine moves and not where it can be: from one start it reaches different places on different ways, and places of rest form a continuum. Only the start, or \
    a guess at which the machine rests already, can be reported. Wrong: equilibrium with a skate and a start that does not rest. Right: give such a place as the start, \
    or follow the damped motion with `simulate`.";
const WANDERING_RU: &str = "Связь, заданная только скоростями и неинтегрируемая (конёк, качение в пространстве, `zero_rate`, множители которого не образуют градиента), \
    ограничивает движение, но не положение: из одного начала разными путями машина приходит в разные места, и положения покоя образуют континуум. Можно указать лишь \
    начальное положение или приближение, в котором машина уже покоится. Неверно: equilibrium с коньком из положения, где машина не покоится. Верно: задайте положение \
    покоя началом или проследите затухающее движение в `simulate`.";

/// A connection that leads to no place.
pub(crate) fn wandering(name: &Text) -> Fault {
    Fault::new(Message {
        code: "S065",
        what: Text::new(
            format!("where the machine rests depends on the way there: {} restrains rates only", name.en),
            format!("положение покоя зависит от пути к нему: связь «{}» ограничивает только скорости", name.ru),
        ),
        why: Text::new("the connection is not integrable (nonholonomic)", "связь неинтегрируема (неголономна)"),
        help: Text::new(
            "give the place of rest as the start or the guess, or follow the damped motion with `simulate`",
            "задайте положение покоя началом или приближением либо проследите затухающее движение в `simulate`",
        ),
    })
}

/// A place of rest that others surround.
pub(crate) fn one_of_many(name: &Text) -> Text {
    Text::new(
        format!("{} restrains rates only: this place rests, and places around it may, too", name.en),
        format!("связь «{}» ограничивает только скорости: в этом положении машина покоится, как, возможно, и в соседних", name.ru),
    )
}

const SLIPS_EN: &str = "Equilibrium needs a friction force beyond its static limit for every choice of the reactions that the equations leave open: the machine \
    sets itself in motion. The message says how many times as large all limits of friction would have to be.";
const SLIPS_RU: &str = "При любом выборе реакций, которые оставляют открытыми уравнения, для равновесия нужна сила трения больше предельной: машина приходит в \
    движение. В сообщении указано, во сколько раз должны быть больше все предельные силы трения.";
const OPEN_EN: &str = "With dry friction a machine rests under a range of loads, so that statics alone gives no number for the unknown. The ends of the range belong to \
    impending motion: name the frictions that are about to slide, and in which direction of their path, in [impending].";
const OPEN_RU: &str = "При сухом трении машина покоится в некотором диапазоне нагрузок, и статика не определяет неизвестное однозначно. Границы диапазона соответствуют \
    предельному равновесию: укажите в [impending], какие трения на пределе и в какую сторону по своему пути готово начаться скольжение.";

/// A share by which limits are too small that three digits of their multiple do not show.
const LITTLE: f64 = 5e-3;

/// Friction that would have to be so many times as strong.
pub(crate) fn slips(frictions: &str, times: f64) -> Fault {
    let n = rounded(times);
    let why = if times - 1.0 < LITTLE {
        let n = rounded(times - 1.0);
        Text::new(
            format!("it would rest with limits of friction larger by {} of their size", n.en),
            format!("покой был бы возможен при предельных силах трения, больших на {} их величины", n.ru),
        )
    } else if times.is_finite() {
        Text::new(
            format!("it would rest with limits of friction {} times as large", n.en),
            format!("покой был бы возможен при предельных силах трения, в {} раза больших", n.ru),
        )
    } else {
        Text::new("no friction holds here, however large", "здесь не удержит никакое трение")
    };
    Fault::new(Message {
        code: "S093",
        what: Text::new(
            format!("friction does not hold the machine at rest: {frictions}"),
            format!("трение не удерживает машину в покое: {frictions}"),
        ),
        why,
        help: Text::new(
            "raise the coefficients, change the loads, or ask for the limiting load with [unknowns] and [impending]",
            "увеличьте коэффициенты, измените нагрузки или найдите предельную нагрузку с помощью [unknowns] и [impending]",
        ),
    })
}

/// Directions of impending sliding in which no load of the asked kind holds the machine.
pub(crate) fn never_impending(unknowns: &str, frictions: &str) -> Fault {
    Fault::new(Message {
        code: "S093",
        what: Text::new(
            format!("no value of {unknowns} lets the machine rest with {frictions} about to slide in the directions of [impending]"),
            format!(
                "ни при каком значении {unknowns} машина не покоится на пределе скольжения {frictions} в направлениях, указанных в [impending]"
            ),
        ),
        why: Text::new(
            "with these frictions at their limits the equations ask another friction for more than its limit, or a contact for a pull",
            "когда эти трения на пределе, уравнения требуют от другого трения силы больше предельной либо от контакта – притяжения",
        ),
        help: Text::new(
            "turn round a direction in [impending], or name other frictions there",
            "измените направление в [impending] или укажите там другие трения",
        ),
    })
}

/// No place in a range at which these frictions are about to slide; ends in SI.
pub(crate) fn no_limit(frictions: &str, coordinate: &str, [from, to]: [f64; 2]) -> Fault {
    let (a, b) = (rounded(from), rounded(to));
    Fault::new(Message {
        code: "S127",
        what: Text::new(
            format!(
                "with `{coordinate}` between {} and {} there is no place of rest with {frictions} about to slide as [impending] says",
                a.en, b.en
            ),
            format!(
                "при `{coordinate}` от {} до {} нет положения покоя, в котором {frictions} на пределе, как указано в [impending]",
                a.ru, b.ru
            ),
        ),
        why: Text::new(
            "friction holds the machine everywhere there, or nowhere, or slides the other way at the end of its range",
            "там трение удерживает машину везде или нигде, либо на границе начинается скольжение в другую сторону",
        ),
        help: Text::new(
            "widen the range, or turn round a direction in [impending]",
            "расширьте диапазон или измените направление в [impending]",
        ),
    })
}

/// An unknown that friction at rest leaves open.
pub(crate) fn open(unknown: &str, friction: &str) -> Fault {
    Fault::new(Message {
        code: "S094",
        what: Text::new(
            format!("`{unknown}` may lie in a range while friction holds: statics do not determine it"),
            format!("пока держит трение, `{unknown}` может лежать в диапазоне: статика его не определяет"),
        ),
        why: Text::new(
            "dry friction at rest takes any value up to its limit",
            "сила сухого трения в покое принимает любое значение до предельного",
        ),
        help: Text::new(
            format!("ask for an end of the range: [impending] {friction} = \"+\" (about to slide forward) or \"-\""),
            format!("найдите границу диапазона: [impending] {friction} = \"+\" (готово скользить вперёд) или \"-\""),
        ),
    })
}

/// S007 where ropes are slack or contacts open at the guess.
pub(crate) fn with_open(names: &str) -> Fault {
    Fault::new(Message {
        code: codes::NO_REST,
        what: Text::new(
            format!("no equilibrium found from this guess, where {names} carries nothing"),
            format!("из этого приближения положение равновесия не найдено; усилия там нет: {names}"),
        ),
        why: Text::new("a rope is slack there or a contact open", "канат там не натянут или контакт разомкнут"),
        help: Text::new(
            "begin where it is taut or closed: set the start, or give a `guess` there",
            "начните с положения, где он натянут или замкнут: измените начальное значение или задайте там `guess`",
        ),
    })
}

pub(crate) fn undetermined(name: &str) -> Fault {
    Fault::new(Message {
        code: "S036",
        what: Text::new(format!("the equations of statics do not determine `{name}`"), format!("уравнения статики не определяют `{name}`")),
        why: Text::new(
            "changing it changes no force here, or another unknown does the same",
            "его изменение не меняет здесь ни одной силы, либо то же делает другое неизвестное",
        ),
        help: Text::new("give it a value in [parameters]", "задайте его значение в [parameters]"),
    })
}

/// The unit of the force along a coordinate, where it has a name.
pub(crate) fn force_unit(coordinate: &str) -> &'static str {
    match coordinate {
        "m" => " N",
        "rad" => " N m",
        _ => "",
    }
}

pub(crate) fn unbalanced(name: &str, force: f64, unit: &str) -> Fault {
    let (f, unit) = (rounded(force), Text::unit(unit));
    Fault::new(Message {
        code: "S036",
        what: Text::new(
            format!("no value of the unknowns makes the start a place of rest: along `{name}` a force of {}{} stays", f.en, unit.en),
            format!(
                "начальное положение не станет положением равновесия ни при каких значениях неизвестных: по `{name}` остаётся сила {}{}",
                f.ru, unit.ru
            ),
        ),
        why: Text::new(
            "there are fewer unknowns than forces to balance, or none of them acts along this coordinate",
            "неизвестных меньше, чем неуравновешенных сил, либо ни одно не действует по этой координате",
        ),
        help: Text::new(
            "start in a place that can be at rest, or add an unknown",
            "начните с положения, возможного в покое, либо добавьте неизвестное",
        ),
    })
}

/// Not every choice of closed contacts was tried.
pub(super) fn some_contacts() -> Text {
    Text::new(
        "the contacts are so many that not every choice of closed ones was tried: there may be more places of rest",
        "контактов слишком много, чтобы перебрать все сочетания закрытых: возможны и другие положения равновесия",
    )
}
