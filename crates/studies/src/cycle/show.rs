//! What is told of a cycle: numbers of the balance, irregularity of the motion from the start.

use super::asked::Cycle;
use super::tried::{pulling, turned};
use crate::machine::Machine;
use crate::results::{Fact, Results};
use analysis::fault::codes;
use analysis::studies::cycle::{Balance, Running};
use serde_json::json;
use words::{Notice, Text};

/// The work over the cycle; zero where rounding of its parts is left.
fn own_work(balance: &Balance) -> f64 {
    // some hundred units of the last place of what passes
    if balance.work.abs() <= 1e-13 * balance.size { 0.0 } else { balance.work }
}

pub(super) fn facts(results: &mut Results, machine: &Machine, balance: &Balance, speed: f64, values: &[(String, f64)]) {
    for (name, value) in values {
        let declared = machine.model.parameters.iter().find(|p| p.name == *name);
        let symbol = machine.model.notation.iter().find(|(n, _)| n == name).map_or(name.as_str(), |(_, s)| s.as_str());
        let label = declared.map(|p| p.label.clone()).filter(|l| !l.en.is_empty());
        let label = label.unwrap_or_else(|| Text::new("value found from the cycle", "значение, найденное из цикла"));
        results.facts.push(Fact::new(name, symbol, declared.map_or("1", |p| p.unit.as_str()), *value, label));
    }
    let text = Text::new;
    results.facts.push(Fact::new("omega", "ω", "rad/s", speed, text("uniform rate of the shaft", "равномерная угловая скорость вала")));
    results.facts.push(Fact::new(
        "work",
        "A",
        "J",
        own_work(balance),
        text("work of all forces over the cycle", "работа всех сил за цикл"),
    ));
    results.facts.push(Fact::new(
        "J_mean",
        "J_m",
        "kg m^2",
        balance.inertia,
        text("mean reduced moment of inertia", "средний приведённый момент инерции"),
    ));
    let label = text("largest excess work within the cycle", "наибольшая избыточная работа внутри цикла");
    results.facts.push(Fact::new("excess_work", "ΔA", "J", balance.excess, label));
    results.own.insert("values".into(), json!(values.iter().map(|(n, v)| (n.clone(), json!(v))).collect::<serde_json::Map<_, _>>()));
}

fn of_the_start(note: &Text) -> Text {
    Text::new(format!("the motion from the start: {}", note.en), format!("движение из заданного начала: {}", note.ru))
}

/// The motion from the start begins with another rate than the one given.
fn begins_struck(rate: f64) -> Text {
    let rate = words::digits::rounded(rate);
    Text::new(
        format!("A contact is struck at the start: this motion begins with ω = {} rad/s.", rate.en),
        format!("В начале происходит удар в контакте: это движение начинается с ω = {} рад/с.", rate.ru),
    )
}

/// Irregularity of the true motion over the cycle.
pub(super) fn running(results: &mut Results, machine: &mut Machine, study: &Cycle) -> Result<(), Notice> {
    match pulling(&mut machine.clone(), study) {
        Ok(notes) => results.data.notes.extend(notes.into_iter().map(|note| of_the_start(&note))),
        Err(fault) if fault.code == codes::STRAND_PUSHES => {
            results.words.push(of_the_start(&fault.message.what));
            results.words.push(Text::new(
                "Nothing is said of the irregularity of that motion.",
                "О неравномерности хода этого движения ничего не сказано.",
            ));
            return Ok(());
        }
        // told where the motion itself is computed
        Err(_) => {}
    }
    let Running { greatest: high, least: low, mean, struck, .. } = match turned(machine, study) {
        Err(trouble) if trouble.code == codes::STANDS => {
            results.words.push(Text::new(
                "The motion from the start does not turn through the cycle: nothing is said of its irregularity.",
                "Движение из заданного начала не проходит весь цикл: о неравномерности хода ничего не сказано.",
            ));
            return Ok(());
        }
        found => found?,
    };
    results.words.extend(struck.map(begins_struck));
    // of a shaft that turns backwards the largest rate is that of the largest speed
    let (high, low) = if mean < 0.0 { (low, high) } else { (high, low) };
    let by_max = (high - low) / high;
    let text = Text::new;
    results.facts.push(Fact::new(
        "omega_max",
        "ω_max",
        "rad/s",
        high,
        text("largest rate over the cycle from the start", "наибольшая угловая скорость за цикл от начала"),
    ));
    results.facts.push(Fact::new("omega_min", "ω_min", "rad/s", low, text("least rate", "наименьшая угловая скорость")));
    let label = text(
        "mean rate over time: angle of the cycle over its duration",
        "средняя по времени угловая скорость: угол цикла, делённый на его длительность",
    );
    results.facts.push(Fact::new("omega_mean", "ω_m", "rad/s", mean, label));
    results.facts.push(Fact::new(
        "irregularity",
        "δ",
        "1",
        (high - low) / mean,
        text(
            "irregularity (ω_max − ω_min)/ω_m of the first cycle, by the mean over time",
            "неравномерность хода (ω_max − ω_min)/ω_m первого цикла, по среднему по времени",
        ),
    ));
    results.facts.push(Fact::new(
        "irregularity_max",
        "δ_max",
        "1",
        by_max,
        text("the same over the largest rate, (ω_max − ω_min)/ω_max", "то же по наибольшей скорости, (ω_max − ω_min)/ω_max"),
    ));
    Ok(())
}
