//! What is said of places of rest that are all unstable: the stable ones to which the machine goes when it is let go beside them.

use crate::machine::Machine;
use analysis::Dataset;
use analysis::linear::{LinearMachine, Place};
use analysis::studies::rest::beside::beside;
use analysis::studies::rest::changes;
use analysis::studies::rest::contacts::{Contacts, SLACK};
use analysis::studies::rest::stability::with_closed;
use serde_json::{Value, json};
use std::sync::Arc;
use symbolic::connections::Law;
use symbolic::linear::About;
use words::Text;

/// Unstable places of which this is said.
const MOST: usize = 3;

/// A stable place beside an unstable one.
pub struct Beside {
    /// The unstable one.
    from: Vec<f64>,
    to: Vec<f64>,
}

/// Beside the places of a study of equilibrium; nothing where one of them is stable already, and where dry friction holds the machine anywhere.
pub fn found(machine: &Machine, data: &Dataset) -> Vec<Beside> {
    let equations = &machine.equations;
    let stable = data.column("stable").map(|c| c.values.as_slice()).unwrap_or_default();
    let rubs = equations.reactions.iter().any(|r| matches!(r.law, Law::Friction(_)));
    if rubs || stable.contains(&1.0) || equations.conditions.iter().any(|c| c.reaction.is_none()) {
        return Vec::new();
    }
    let unstable = (0..stable.len()).filter(|row| stable[*row] == 0.0).take(MOST);
    unstable.flat_map(|row| of_row(machine, data, row).unwrap_or_default()).collect()
}

fn of_row(machine: &Machine, data: &Dataset, row: usize) -> Option<Vec<Beside>> {
    let equations = &machine.equations;
    let value = |name: &str| data.column(name).and_then(|c| c.values.get(row).copied());
    let names = equations.coordinates.iter().map(|c| &equations.graph.symbol_info(c.symbols[0]).name);
    let from: Vec<f64> = names.map(|name| value(name)).collect::<Option<_>>()?;
    let forces: Vec<f64> = equations.reactions.iter().map(|r| value(&r.name).unwrap_or(0.0)).collect();
    let largest = forces.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
    let pressed = |r: &usize| matches!(equations.reactions[*r].law, Law::Contact { .. }) && forces[*r] > SLACK * largest;
    let closed: Vec<usize> = (0..forces.len()).filter(pressed).collect();
    let mut linear = LinearMachine::new(&Arc::new(with_closed(equations, &closed)), About::Rest).ok()?;
    let mut contacts = Contacts::new(equations, &closed).ok()?;
    let place = linear.settle(&from).ok()?;
    let list = beside(&mut linear, &place);
    let admitted = |linear: &mut LinearMachine, place: &Place, contacts: &mut Option<Contacts>| match contacts {
        Some(contacts) => contacts.margins(linear, place).is_ok_and(|list| !list.iter().any(|m| m.is_violated())),
        None => true,
    };
    Some(list.into_iter().filter(|p| admitted(&mut linear, p, &mut contacts)).map(|p| Beside { from: from.clone(), to: p.q }).collect())
}

/// In words, one sentence for each unstable place.
pub fn notes(machine: &Machine, list: &[Beside]) -> Vec<Text> {
    let n = machine.equations.coordinates.len();
    let coordinates = &analysis::System::states(&machine.system)[..n];
    let one = |group: &[Beside]| {
        let from = changes::place(&group[0].from, &group[0].to, coordinates);
        let to: Vec<Text> = group.iter().map(|b| changes::place(&b.to, &b.from, coordinates)).collect();
        let join = |pick: fn(&Text) -> &str, or: &str| to.iter().map(|t| format!("({})", pick(t))).collect::<Vec<_>>().join(or);
        Text::new(
            format!(
                "the place of rest ({}) is unstable: let go beside it, the machine goes to the stable place {}",
                from.en,
                join(|t| &t.en, " or ")
            ),
            format!(
                "положение равновесия ({}) неустойчиво: отпущенная рядом с ним машина переходит в устойчивое положение {}",
                from.ru,
                join(|t| &t.ru, " или ")
            ),
        )
    };
    list.chunk_by(|a, b| a.from == b.from).map(one).collect()
}

/// `[{from: {phi: 0}, to: {phi: 1.2}}]`.
pub fn json(machine: &Machine, list: &[Beside]) -> Value {
    let names: Vec<&String> =
        machine.equations.coordinates.iter().map(|c| &machine.equations.graph.symbol_info(c.symbols[0]).name).collect();
    let place = |q: &[f64]| names.iter().zip(q).map(|(name, v)| ((*name).clone(), json!(v))).collect::<serde_json::Map<_, _>>();
    list.iter().map(|b| json!({"from": place(&b.from), "to": place(&b.to)})).collect()
}
