//! What all who tell of branches say: what happens, why a branch ends, where a point is.

use super::asked::coordinates;
use crate::machine::{Machine, explained};
use analysis::System;
use analysis::studies::continuation::{End, Place, What};
use serde_json::{Map, Value, json};
use words::{Language, Text};

/// What happens, in words.
pub(super) fn name(what: What) -> Text {
    match what {
        What::Fold => Text::new("fold: the branch turns", "поворот ветви (складка)"),
        What::Branch => Text::new("branch point: another branch crosses", "точка ветвления: пересечение с другой ветвью"),
        What::Hopf => Text::new("Hopf point: oscillations set in", "бифуркация Хопфа: возникают колебания"),
        What::Doubling => Text::new("period doubling", "удвоение периода"),
        What::Torus => Text::new("torus: beats set in", "рождение тора: возникают биения"),
        What::Grazing => Text::new("grazing: a switch is only touched", "касание: переключение едва достигается"),
        What::Extreme => Text::new(
            "extreme of energy: neighbours along the curve have one energy, and a multiplier passes 1",
            "экстремум энергии: у соседних движений ветви она одинакова, мультипликатор проходит через 1",
        ),
        What::Cusp => Text::new("cusp: two folds meet and vanish", "точка сборки: две складки сливаются и исчезают"),
        What::Turn => Text::new(
            "turn: the second parameter is extreme on the curve, and two points of it at other values meet there",
            "поворот кривой: второй параметр на ней экстремален, здесь сливаются две её точки",
        ),
        What::BogdanovTakens => Text::new(
            "Bogdanov-Takens point: the frequency falls to zero, two roots are 0",
            "точка Богданова — Такенса: частота обращается в нуль, два корня равны 0",
        ),
        What::Bautin => Text::new(
            "generalised Hopf point (Bautin): the motions that part change from stable to unstable ones",
            "точка Баутина (вырожденная бифуркация Хопфа): отходящие движения из устойчивых становятся неустойчивыми",
        ),
        What::Resonance(order) => resonance(order),
    }
}

/// Order of a strong resonance.
fn resonance(order: usize) -> Text {
    Text::new(
        format!("strong resonance 1:{order}: the pair is e^(±2πi/{order})"),
        format!("сильный резонанс 1:{order}: пара мультипликаторов e^(±2πi/{order})"),
    )
}

/// Why a curve ends, at its beginning and at its end; one that closes has one reason.
pub(super) fn ends_in_words(machine: &Machine, ends: &[Option<End>; 2]) -> Vec<Text> {
    let count = if ends[0] == Some(End::Closed) { 1 } else { 2 };
    ends[..count].iter().flatten().map(|end| end_in_words(machine, end)).collect()
}

/// Why a branch ends.
pub(super) fn end_in_words(machine: &Machine, end: &End) -> Text {
    let text = Text::new;
    match end {
        End::Left => text("the range ends", "конец промежутка"),
        End::Closed => text("it closes", "ветвь замыкается"),
        End::Joins => text("it joins another branch", "ветвь приходит на другую ветвь"),
        End::Meets(what) => {
            let met = name(*what);
            Text::new(format!("{}; beyond it the pair is real", met.en), format!("{}; за ней пара действительна", met.ru))
        }
        End::Points => text("the number of points is used up (`points`)", "исчерпано число точек (`points`)"),
        End::Interrupted => text("interrupted", "прервано"),
        End::Rests => text("the motion shrinks to a place of rest", "движение стягивается к положению равновесия"),
        End::Grazes => text(
            "a switch is only touched there (grazing), and what lies beyond does not follow from it",
            "переключение там лишь едва достигается (касание), и продолжение из него не следует",
        ),
        End::Lingers => text(
            "its period grows without bound: the motion comes ever nearer to an unstable place of rest (a homoclinic or heteroclinic motion)",
            "период неограниченно растёт: движение подходит всё ближе к неустойчивому положению равновесия (гомоклиническое или гетероклиническое движение)",
        ),
        End::Winds(limit) => {
            let en = report::number::short(*limit, 9, Language::En);
            let ru = en.replace('.', ",");
            Text::new(
                format!(
                    "the parameter winds towards {en} while the period grows: folds without end lead to a homoclinic motion of a place of rest that oscillates (Shilnikov)"
                ),
                format!(
                    "параметр, колеблясь, приближается к {ru}, а период растёт: бесконечная последовательность складок ведёт к гомоклиническому движению положения равновесия с колебаниями (Шильников)"
                ),
            )
        }
        End::Outgrown => text("another method goes on from there", "далее прослеживается другим способом"),
        End::Stuck(step, fault) => {
            let en = report::number::short(*step, 2, Language::En);
            let ru = en.replace('.', ",");
            let said = match fault {
                Some(fault) => {
                    let notice = explained(fault.clone(), &machine.equations);
                    Text::new(format!("{} [{}]", notice.what.en, notice.code), format!("{} [{}]", notice.what.ru, notice.code))
                }
                None => text(
                    "the corrections do not settle: the branch ends in a corner, or the motion has no derivative by its start there",
                    "поправки не сходятся: ветвь кончается изломом или движение не имеет там производной по началу",
                ),
            };
            Text::new(
                format!("no step of {en} of the range leads on: {}", said.en),
                format!("дальше не ведёт и шаг в {ru} промежутка: {}", said.ru),
            )
        }
    }
}

/// Where a point is, apart from parameters.
pub(super) fn state(machine: &Machine, place: &Place) -> Map<String, Value> {
    let facts = place.facts();
    let mut fields = Map::new();
    if facts.period > 0.0 {
        fields.insert("period".into(), json!(facts.period));
    }
    if let Some(energy) = facts.energy {
        fields.insert("energy".into(), json!(energy));
    }
    let extremes = coordinates(machine).iter().zip(&facts.extremes).map(|(q, e)| (q.name.clone(), json!(e))).collect::<Map<_, _>>();
    fields.insert("range".into(), extremes.into());
    let start = machine.system.states().iter().zip(place.unknowns()).map(|(q, x)| (q.name.clone(), json!(x))).collect::<Map<_, _>>();
    fields.insert("start".into(), start.into());
    fields
}
