//! The study that is repeated, at one place.

use super::repeated::Repeated;
use crate::failure::in_words;
use crate::machine::Machine;
use crate::machine::bind::Binding;
use crate::watch::{Kept, Watch};
use crate::{Finds, Results};
use mechanics::asked::Asked;
use words::Notice;

/// Where a study is repeated: the machine that is given other values. Nothing else is left of the places before: what is found at a place does not depend on the way there.
#[derive(Clone, Debug)]
pub struct At {
    /// The machine; it has the values of the last place.
    pub machine: Machine,
    /// How often the file was read again.
    pub anew: usize,
}

impl At {
    /// From a machine as the file gives it.
    pub fn of(machine: &Machine) -> At {
        At { machine: machine.clone(), anew: 0 }
    }

    /// The same with the values of a first place, so that others only change numbers.
    pub fn given(machine: &Machine, values: &[(String, f64)]) -> At {
        let mut at = At::of(machine);
        let values: Vec<(&str, f64)> = values.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        // values that the machine refuses are told by the row that they belong to
        at.anew += usize::from(matches!(at.machine.bind(&values), Ok(Binding::Anew)));
        at
    }
}

/// The study at one place.
///
/// # Errors
/// What the machine or the study objects to these values.
pub fn one(at: &mut At, repeated: &Repeated, values: &[(String, f64)], watch: &mut Watch) -> Result<Results, Notice> {
    let values: Vec<(&str, f64)> = values.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    at.anew += usize::from(at.machine.bind(&values).map_err(in_words)? == Binding::Anew);
    let machine = &mut at.machine;
    let base = &repeated.at(machine)?;
    // what is tuned is not the machine of the next place
    let mut own = base.has("wanted_period").then(|| machine.clone());
    let machine = own.as_mut().unwrap_or(machine);
    let mut inner = Watch { interrupt: watch.interrupt, kept: Kept::Numbers, ..Watch::default() };
    let Some(finding) = run(machine, base, &mut inner) else {
        return Err(Notice::new("C032", "this study cannot be repeated", "этот расчёт повторять нельзя"));
    };
    match &finding.trouble {
        Some(trouble) => Err(trouble.clone()),
        None => Ok(finding),
    }
}

/// A motion as a command carries it out, once: what a repetition confirms, and rows for plots, nobody asks for here.
fn run(machine: &mut Machine, base: &Asked, watch: &mut Watch) -> Option<Results> {
    let study = machine.origin.studies.find(base.kind)?;
    match study.finds() {
        Finds::Motion => study.command(machine, base, watch),
        _ => study.run(machine, base, watch),
    }
}
