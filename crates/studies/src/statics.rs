//! The study `statics` of bodies: reactions, equations of equilibrium, what is open or free.

mod conditions;

use super::{Conclusion, Fact, Found, Repeats, Results, Study};
use crate::machine::Machine;
use crate::provenance;
use crate::results::finite::checked;
use crate::watch::Watch;
use analysis::Dataset;
use analysis::dataset::Audit;
use analysis::rest::mean::Resting;
use analysis::studies::statics::{Statics as Rest, statics};
use mechanics::asked::{Asked, Kind, Words};
use serde_json::{Value, json};
use words::{Language, Notice, Text};

/// Largest relative remainder of an equation of equilibrium.
const LIMIT: f64 = 1e-10;

/// The study.
pub struct Statics;

/// Reactions that a conclusion names.
const HELD: usize = 10;

/// Its name and its keys.
pub static KIND: Kind =
    Kind::new(crate::structure::statics::NAME, ("Find reactions and internal forces at rest", "Найти реакции и внутренние усилия в покое"));

impl Study for Statics {
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn wanted(&self) -> Words {
        ("find the reactions and the internal forces", "найти реакции опор и внутренние усилия")
    }
    fn chapter(&self) -> &'static str {
        "reactions"
    }
    fn concludes(&self, _: &Machine, results: &Results, language: Language) -> Vec<Conclusion> {
        let unique = results.facts.iter().filter(|f| f.value.is_finite() && !f.quantity.name.contains(' '));
        let found = unique.take(HELD).map(|f| crate::results::shown(&f.quantity, f.value, language)).collect();
        vec![Conclusion::Held { found }]
    }
    /// Of a frame or truss where there are nodes, otherwise of bodies with supports and joints.
    fn run(&self, machine: &mut Machine, _: &Asked, _: &mut Watch) -> Found {
        crate::structure::statics(machine).or_else(|| Some(of_bodies(machine)))
    }
    fn repeats(&self) -> Repeats {
        Repeats::Rest
    }
}

fn of_bodies(machine: &mut Machine) -> Results {
    let judged = at_rest(machine).and_then(|found| {
        let of = |name: &str| found.reactions.iter().filter(|r| r.quantity.name == name).filter_map(|r| r.value).collect();
        crate::strands::pushing(machine, of).map_or(Ok(found), Err)
    });
    let results = match judged {
        Ok(found) => results(machine, &found),
        Err(fault) => Results::failed(KIND.name, heading(), Notice::from(fault)),
    };
    checked(results)
}

/// At t = 0; where unknowns were found for which the machine rests under the means of its loads, under these means.
fn at_rest(machine: &Machine) -> Result<Rest, analysis::Fault> {
    if machine.model.unknowns.is_empty() {
        return statics(&machine.equations);
    }
    let resting = Resting::new(&machine.equations)?;
    let mut found = statics(resting.equations())?;
    found.notes.extend(crate::small::timing_notes(resting.timing));
    Ok(found)
}

fn heading() -> Text {
    Text::new("Statics", "Статика")
}

fn results(machine: &Machine, found: &Rest) -> Results {
    let open = Text::new("not determined by equilibrium", "из условий равновесия не определяется");
    let fact = |r: &analysis::studies::statics::Reaction| {
        let q = &r.quantity;
        let fact = Fact::new(&q.name, &q.symbol, &q.unit, r.value.unwrap_or(f64::NAN), q.label.clone());
        if r.value.is_none() { fact.with_words(open.clone()) } else { fact }
    };
    let name = Text::new("equations of equilibrium: largest relative remainder", "уравнения равновесия: наибольшая относительная невязка");
    let audits = vec![Audit::at_most("equilibrium", name, found.remainder, LIMIT)];
    let mut notes = found.notes.clone();
    notes.extend(crate::small::unknown_notes(machine));
    let data = Dataset { audits, notes, ..Dataset::default() };
    let ends = found.reactions.iter().filter(|r| r.value.is_none()).flat_map(ends);
    let facts = found.reactions.iter().map(fact).chain(ends).collect();
    let mut results = Results { kind: KIND.name, heading: heading(), facts, words: words(machine, found), ..Results::default() };
    results.data = provenance::stamp(data, &machine.equations, &machine.model_hash);
    let reaction = |r: &analysis::studies::statics::Reaction| {
        json!({"name": r.quantity.name, "symbol": r.quantity.symbol, "value": r.value, "unit": r.quantity.unit,
            "least": finite(r.range[0]), "greatest": finite(r.range[1])})
    };
    let reactions: Vec<Value> = found.reactions.iter().map(reaction).collect();
    let share = |(name, share): &(Text, f64)| json!({"displacement": name.en, "share": share});
    let free: Vec<Value> = found.free.iter().map(|motion| motion.iter().map(share).collect()).collect();
    results.own.insert("reactions".into(), json!(reactions));
    let lines: Vec<Value> = conditions::told(machine, found).iter().map(|line| json!(line.en)).collect();
    results.own.insert("conditions".into(), json!(lines));
    results.own.insert("indeterminacy".into(), json!(found.indeterminacy));
    results.own.insert("mobility".into(), json!(found.free.len()));
    results.own.insert("free_motions".into(), json!(free));
    results
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// Least and greatest value of a reaction that is not unique, where something limits it.
fn ends(reaction: &analysis::studies::statics::Reaction) -> Vec<Fact> {
    let words =
        [("least", Text::new("least value", "наименьшее значение")), ("greatest", Text::new("greatest value", "наибольшее значение"))];
    let q = &reaction.quantity;
    let one = |(end, (word, label)): (f64, (&str, Text))| Fact::new(&format!("{word} {}", q.name), &q.symbol, &q.unit, end, label);
    reaction.range.into_iter().zip(words).filter(|(end, _)| end.is_finite()).map(one).collect()
}

/// Equations and limits of equilibrium, then the degree of indeterminacy and free motions.
fn words(machine: &Machine, found: &Rest) -> Vec<Text> {
    let mut words = conditions::told(machine, found);
    words.push(match found.indeterminacy {
        0 => Text::new("Statically determinate.", "Статически определимо."),
        n => Text::new(format!("Statically indeterminate, degree {n}."), format!("Статически неопределимо, степень {n}.")),
    });
    for motion in &found.free {
        let list = |pick: fn(&Text) -> &str| {
            let parts: Vec<String> = motion.iter().map(|(name, share)| format!("{}: {share:.4}", as_displacement(pick(name)))).collect();
            parts.join("; ")
        };
        words.push(Text::new(
            format!("A mechanism: nothing prevents {}.", list(|t| &t.en)),
            format!("Механизм: ничто не препятствует перемещению {}.", list(|t| &t.ru).replace('.', ",")),
        ));
    }
    words
}

/// A balance in a displacement, as the displacement: "beam, shift along y".
fn as_displacement(balance: &str) -> String {
    let words = [
        ("moments about", "turn about"),
        ("forces along", "shift along"),
        ("моменты относительно оси", "поворот вокруг оси"),
        ("моменты относительно", "поворот вокруг"),
        ("силы вдоль", "перемещение вдоль"),
    ];
    words.iter().fold(balance.to_owned(), |text, (of_force, of_place)| text.replace(of_force, of_place))
}
