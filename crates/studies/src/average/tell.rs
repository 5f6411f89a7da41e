//! The balance over the speeds, and the speeds of steady turning, with the numbers of the file.

use super::formulas::{Formulas, refused};
use super::motions::Motions;
use crate::machine::Machine;
use crate::provenance;
use crate::results::{Fact, Results};
use crate::watch::Watch;
use analysis::dataset::{Column, Missing};
use analysis::studies::average::{Branch, Course, Steady, Turn, steady, turns};
use analysis::{Dataset, Quantity};
use mechanics::asked::{Asked, Named};
use mechanics::model::Plot;
use serde_json::{Value, json};
use words::{Notice, Text};

/// Speeds without a wish.
const POINTS: usize = 201;

/// The angle, and the speeds that are looked at.
pub(super) fn asked_for(asked: &Asked, default: usize) -> Result<(Named, Vec<f64>, f64), Notice> {
    let angle = asked.coordinate("angle").cloned();
    let (Some(angle), Some(slowest), Some(fastest)) = (angle, asked.number("slowest"), asked.number("fastest")) else {
        return Err(refused(("`angle`, `slowest` and `fastest` are needed", "нужны ключи `angle`, `slowest` и `fastest`")));
    };
    let count = asked.count("points").unwrap_or(default);
    let speeds = (0..count).map(|k| if k + 1 == count { fastest } else { slowest + (fastest - slowest) * k as f64 / (count - 1) as f64 });
    Ok((angle, speeds.collect(), asked.number("instant").unwrap_or(0.0)))
}

/// Fills in the results.
pub(super) fn single(machine: &mut Machine, asked: &Asked, results: &mut Results, watch: &mut Watch) -> Result<(), Notice> {
    let (angle, speeds, instant) = asked_for(asked, POINTS)?;
    let formulas = Formulas::of(machine, &angle, instant)?;
    let found = turns(&formulas, &speeds);
    if found.iter().all(Option::is_none) {
        return Err(nothing_repeats());
    }
    let course = steady(&formulas, &speeds, &found);
    let list = &course.steady;
    results.words.extend(several(&course));
    results.own.insert("answers".into(), answers(&course));
    results.data = provenance::stamp(table(&speeds, &found), &machine.equations, &machine.model_hash);
    results.plots = vec![Plot { title: Text::default(), x: None, y: vec!["own".into(), "vibration".into()] }];
    for (k, s) in list.iter().enumerate() {
        results.facts.push(speed(k, s));
    }
    if let Some(ripple) = list.iter().map(|s| s.turn.ripple).reduce(f64::max) {
        let label =
            Text::new("bound of the departure of the angle from uniform turning", "оценка сверху отклонения угла от равномерного вращения");
        results.facts.push(Fact::new("ripple", "ε", "rad", ripple, label));
    }
    results.own.insert("speeds".into(), list.iter().map(json_of).collect());
    let (en, ru) = (
        "The moments balance at no speed of this range. Formulas of time stand at `instant`, 0 s without another wish.",
        "В этом промежутке скоростей баланса моментов нет. Формулы времени взяты в момент `instant`, по умолчанию 0 с.",
    );
    results.words.push(if list.is_empty() { Text::new(en, ru) } else { balance_words() });
    results.words.extend(gaps(found.iter().filter(|turn| turn.is_none()).count() + course.unseen));
    if let Some(until) = asked.number("runs") {
        let own = Motions::new(machine, &angle.name, until)?.speed(&[], watch)?;
        let label = Text::new("mean speed of the motion itself at its end", "средняя скорость самого движения в его конце");
        results.facts.push(Fact::new("motion", "ω", "rad/s", own, label));
        let nearest = list.iter().filter(|s| s.stable).map(|s| (s.turn.speed - own).abs()).reduce(f64::min);
        if let Some(off) = nearest {
            let label = Text::new(
                "its relative distance from the nearest stable speed",
                "её относительное отличие от ближайшей устойчивой скорости",
            );
            results.facts.push(Fact::new("off", "δ", "1", off / own.abs(), label));
        }
    }
    Ok(())
}

/// Branches of answers in JSON.
fn answers(course: &Course) -> Value {
    let of = |branch: &Branch| {
        let rows = |turn: &Turn| json!({"speed": turn.speed, "own": turn.own, "vibration": turn.vibration, "ripple": turn.ripple});
        json!({"folds": branch.folds(), "broken": branch.broken, "points": branch.turns().map(rows).collect::<Vec<Value>>()})
    };
    course.branches.iter().map(of).collect()
}

/// What is known of the answers of a rest that is not linear.
pub(super) fn several(course: &Course) -> Option<Text> {
    let (starts, count) = (course.starts?, course.branches.len());
    let folds: usize = course.branches.iter().map(Branch::folds).sum();
    let broken: usize = course.branches.iter().map(|branch| branch.broken).sum();
    let (en, ru) = match broken {
        0 => (String::new(), String::new()),
        _ => (
            format!(" Branches that end within the range (an undamped resonance, or an answer that is not smooth): {broken}."),
            format!(" Ветвей, обрывающихся внутри диапазона (резонанс без сопротивления или негладкое движение): {broken}."),
        ),
    };
    Some(Text::new(
        format!(
            "The rest of the machine is not linear and may answer one speed by several motions. Branches of such motions followed over the speed: {count}, with {folds} folds; the balances on all of them are given. Others were sought from {starts} starts; that there are none is not guaranteed.{en}"
        ),
        format!(
            "Остальная машина нелинейна, и одной скорости могут отвечать несколько её движений. Прослежено по скорости ветвей таких движений: {count}, складок на них: {folds}; приведены балансы на всех ветвях. Другие ветви искались из начальных приближений (их {starts}); что других нет, не гарантируется.{ru}"
        ),
    ))
}

/// What the numbers are.
pub(super) fn balance_words() -> Text {
    Text::new(
        "Averaged over a turn: N is what turns the angle by itself, V the vibrational moment, which the answer of the rest takes; the speeds are those at which N = V, stable where N − V falls. The theory errs by the order of the ripple ε.",
        "Осреднение за оборот: N — средний момент, который вращал бы угол при неподвижной остальной машине, V — вибрационный момент, расходуемый на её колебания; установившимся скоростям отвечает N = V, устойчивым — там, где N − V убывает. Погрешность теории — порядка ε, отклонения от равномерного вращения.",
    )
}

/// Speeds without a turn.
pub(super) fn gaps(count: usize) -> Option<Text> {
    let words = || {
        Text::new(
            format!(
                "At {count} of the speeds looked at the rest has no motion that repeats after a turn (an undamped resonance, or one that is not smooth): a balance beside them is not seen."
            ),
            format!(
                "При некоторых из рассмотренных скоростей ({count}) остальная машина не имеет движения, повторяющегося через оборот (резонанс без сопротивления или негладкое движение): баланс рядом с ними не виден."
            ),
        )
    };
    (count > 0).then(words)
}

/// S161 for a range without any motion that repeats.
pub(super) fn nothing_repeats() -> Notice {
    refused((
        "at none of the speeds the rest has a motion that repeats after a turn",
        "ни при одной из скоростей остальная машина не имеет движения, повторяющегося через оборот",
    ))
}

fn speed(k: usize, s: &Steady) -> Fact {
    let label = if s.stable {
        Text::new("stable speed", "устойчивая скорость")
    } else {
        Text::new("unstable speed", "неустойчивая скорость")
    };
    Fact::new(&format!("speed_{}", k + 1), &format!("Ω_{}", k + 1), "rad/s", s.turn.speed, label)
}

/// A speed of steady turning in JSON.
pub(super) fn json_of(s: &Steady) -> Value {
    json!({"speed": s.turn.speed, "stable": s.stable, "branch": s.branch + 1, "moment": s.turn.vibration, "ripple": s.turn.ripple})
}

fn table(speeds: &[f64], found: &[Option<Turn>]) -> Dataset {
    let column = |name: &str, (symbol, unit): (&str, &str), label: Text, value: &dyn Fn(&Turn) -> f64| Column {
        quantity: Quantity { symbol: symbol.into(), label, ..Quantity::new(name, unit) },
        values: found.iter().map(|turn| turn.as_ref().map_or(f64::NAN, value)).collect(),
    };
    let label = Text::new("speed", "скорость");
    let first = Column { quantity: Quantity { symbol: "Ω".into(), label, ..Quantity::new("speed", "rad/s") }, values: speeds.to_vec() };
    let columns = vec![
        first,
        column("own", ("N", "N m"), Text::new("own moment", "собственный момент"), &|turn| turn.own),
        column("vibration", ("V", "N m"), Text::new("vibrational moment", "вибрационный момент"), &|turn| turn.vibration),
        column("ripple", ("ε", "rad"), Text::new("departure from uniform turning", "неравномерность вращения"), &|turn| turn.ripple),
    ];
    let mut data = Dataset { axis: Some(0), columns, ..Dataset::default() };
    if found.iter().any(Option::is_none) {
        let words = Text::new(
            "at this speed the rest has no motion that repeats after a turn",
            "при этой скорости остальная машина не имеет движения, повторяющегося через оборот",
        );
        ["own", "vibration", "ripple"].iter().for_each(|name| data.state(name, Missing::Absent, words.clone()));
    }
    data
}
