//! What is noted of a study that is repeated.

use super::number::nothing_observed;
use crate::machine::Machine;
use crate::observable::{Observable, Reduced};
use crate::periodic;
use analysis::{Quantity, System};
use words::{Notice, Text};

/// A number that is noted, and the quantity that its column shows.
pub type Noted = (Quantity, Observable);

/// What the names in `observe` mean, with the columns they fill.
///
/// # Errors
/// No such output (C008), no such window (M377), nothing to note (S085).
pub fn noted(machine: &Machine, observe: &[String], of: Option<&str>) -> Result<Vec<Noted>, Notice> {
    let outputs = &machine.equations.outputs;
    let quantity = |observable: &Observable, output: &symbolic::equations::Output| {
        let shown = machine.system.outputs().iter().find(|q| q.name == output.name).map_or(output.name.as_str(), |q| q.symbol.as_str());
        Quantity {
            symbol: format!("{shown}_{}", observable.word()),
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
                Observable::Field(_) => Quantity::new(&observable.to_string(), "1"),
                Observable::Reduced(Reduced { of, .. }) => {
                    quantity(&observable, outputs.iter().find(|o| o.name == *of).ok_or_else(|| unknown(of, machine))?)
                }
            };
            found.push((described, observable));
        }
    }
    if let Some(of) = of.filter(|of| found.is_empty() && *of != periodic::KIND.name) {
        return Err(nothing_observed(of));
    }
    if found.is_empty() {
        found.push((Quantity::new("period", "1"), Observable::field("period")));
    }
    Ok(found)
}

fn unknown(name: &str, machine: &Machine) -> Notice {
    let trouble = Notice::new("C008", format!("there is no output `{name}`"), format!("нет выходной величины `{name}`"));
    match words::nearest(name, machine.equations.outputs.iter().map(|o| o.name.as_str())) {
        Some(near) => trouble.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
        None => trouble,
    }
}
