//! What is noted of a study that is repeated.

use super::number::nothing_observed;
use crate::Finds;
use crate::machine::Machine;
use crate::observable::{Observable, Reduced};
use crate::periodic;
use analysis::reduce::Reduction;
use analysis::{GuardKind, Quantity, System};
use symbolic::equations::Output;
use words::{Notice, Text};

/// A number that is noted, and the quantity that its column shows.
pub type Noted = (Quantity, Observable);

/// What the names in `observe` mean, with the columns they fill.
///
/// # Errors
/// No such output (C008), no such window (M377), nothing to note (S085).
pub fn noted(machine: &Machine, observe: &[String], of: Option<&str>) -> Result<Vec<Noted>, Notice> {
    let outputs = &machine.equations.outputs;
    let quantity = |observable: &Observable, output: &Output| {
        let shown = machine.system.outputs().iter().find(|q| q.name == output.name).map_or(output.name.as_str(), |q| q.symbol.as_str());
        Quantity {
            // the index of a mean is that of ω_m in both languages
            symbol: format!("{shown}_{}", if observable.word() == "mean" { "m" } else { observable.word() }),
            label: output.label.clone(),
            display: output.display.clone(),
            ..Quantity::new(&observable.to_string(), &output.unit)
        }
    };
    let mut found = Vec::new();
    for text in observe {
        for observable in Observable::read(text, &|name| outputs.iter().any(|o| o.name == name))? {
            let described = match &observable {
                Observable::Events => {
                    Quantity { label: Text::new("number of events", "число событий"), ..Quantity::new("events", "1") }
                }
                Observable::EventsOf(name) => {
                    has_events(name, machine)?;
                    let label = Text::new(format!("number of events of {name}"), format!("число событий: {name}"));
                    Quantity { label, ..Quantity::new(&observable.to_string(), "1") }
                }
                Observable::Field(_) => of_field(&observable.to_string(), outputs),
                Observable::Reduced(Reduced { of, .. }) => {
                    quantity(&observable, outputs.iter().find(|o| o.name == *of).ok_or_else(|| unknown(of, machine))?)
                }
            };
            found.push((described, observable));
        }
    }
    if found.is_empty() && of.is_some_and(|of| machine.origin.studies.finds(of) == Finds::Verdict) {
        return Ok(found);
    }
    if let Some(of) = of.filter(|of| found.is_empty() && *of != periodic::KIND.name) {
        return Err(nothing_observed(of));
    }
    if found.is_empty() {
        found.push((Quantity::new("period", "1"), Observable::field("period")));
    }
    Ok(found)
}

/// A number among the named ones of a study: `start.x`, `gain.x` and `range.x.1` have the unit of x.
fn of_field(name: &str, outputs: &[Output]) -> Quantity {
    let steps: Vec<&str> = name.split('.').collect();
    let of_output = steps.windows(2).filter(|pair| ["start", "gain", "range"].contains(&pair[0]));
    let output = of_output.filter_map(|pair| outputs.iter().find(|output| output.name == pair[1])).next();
    output.map_or_else(
        || Quantity::new(name, "1"),
        |output| Quantity { display: output.display.clone(), ..Quantity::new(name, &output.unit) },
    )
}

/// That means of forces leave out what strikes, where one is noted and something can strike.
pub fn without_impulses(machine: &Machine, noted: &[Noted]) -> Option<Text> {
    let strikes = machine.system.guards().iter().any(|guard| matches!(guard.kind, GuardKind::Contact { .. }));
    let equations = &machine.equations;
    let is_force = |name: &str| {
        let of_reactions = |formula| equations.graph.contains(formula, |s| equations.reactions.iter().any(|r| r.symbol == s));
        equations.outputs.iter().any(|output| output.name == name && of_reactions(output.formula))
    };
    let mut names: Vec<&str> = Vec::new();
    for (_, observable) in noted.iter().filter(|_| strikes) {
        match observable {
            Observable::Reduced(Reduced { reduction: Reduction::Mean, of, .. }) if is_force(of) && !names.contains(&of.as_str()) => {
                names.push(of);
            }
            _ => {}
        }
    }
    let list = names.join(", ");
    (!names.is_empty()).then(|| {
        Text::new(
            format!("the mean of {list} is that of the force between impacts: impulses are no part of it and stand in the events of each motion"),
            format!("среднее {list} — это среднее силы между ударами: ударные импульсы в него не входят, они указаны в событиях каждого движения"),
        )
    })
}

/// Whether something of that name can change: a named event, a contact, a rope, a friction.
fn has_events(name: &str, machine: &Machine) -> Result<(), Notice> {
    let model = &machine.model;
    let names = || {
        let connections = model.connections.iter().map(|c| c.name.as_str());
        model.events.iter().map(|event| event.name.as_str()).chain(connections).chain(model.elements.iter().map(|e| e.name.as_str()))
    };
    if names().any(|own| own == name) {
        return Ok(());
    }
    let trouble = Notice::new("C008", format!("there is no event `{name}`"), format!("нет события `{name}`"));
    Err(match words::nearest(name, names()) {
        Some(near) => trouble.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
        None => trouble
            .help("name an event of [events], a contact, a rope or a friction", "назовите событие из [events], контакт, нить или трение"),
    })
}

fn unknown(name: &str, machine: &Machine) -> Notice {
    let trouble = Notice::new("C008", format!("there is no output `{name}`"), format!("нет выходной величины `{name}`"));
    match words::nearest(name, machine.equations.outputs.iter().map(|o| o.name.as_str())) {
        Some(near) => trouble.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
        None => trouble,
    }
}
