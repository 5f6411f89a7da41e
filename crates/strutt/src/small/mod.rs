//! Small motions about an equilibrium: what the studies `modes` and `response` share.

pub mod equation;
pub mod modes;
pub mod response;
pub mod show;

use crate::pipeline::Machine;
use analysis::linear::{LinearMachine, Place};
use analysis::{Fault, System};
use mechanics::model::StudyKind;
use std::sync::Arc;
use symbolic::linear::About;
use symbolic::{SymbolId, Text};

/// A machine linearised about a place.
#[derive(Clone, Debug)]
pub struct Small {
    /// The linear machine.
    pub machine: LinearMachine,
    /// About where.
    pub place: Place,
}

/// Linearises a machine about the equilibrium that is meant.
///
/// # Errors
/// No equilibrium is found, or formulas have no value there.
pub fn about_rest(machine: &Machine, guess: &[(SymbolId, f64)]) -> Result<Small, Fault> {
    let mut linear = LinearMachine::new(&Arc::new(machine.equations.clone()), About::Rest)?;
    let place = rest(machine, &mut linear, guess)?;
    Ok(Small { machine: linear, place })
}

/// From the guess of the study, else from that of the file's equilibrium, the start and zero: the first stable equilibrium, or the first.
fn rest(machine: &Machine, linear: &mut LinearMachine, guess: &[(SymbolId, f64)]) -> Result<Place, Fault> {
    let start = machine.system.start()?;
    let n = machine.system.n_coordinates();
    let symbols: Vec<SymbolId> = machine.equations.coordinates.iter().map(|c| c.symbols[0]).collect();
    let from = |guess: &[(SymbolId, f64)]| -> Vec<f64> {
        let value = |(s, q): (&SymbolId, &f64)| guess.iter().find(|(g, _)| g == s).map_or(*q, |(_, v)| *v);
        symbols.iter().zip(&start[..n]).map(value).collect()
    };
    let candidates: Vec<Vec<f64>> = if guess.is_empty() {
        let guesses = machine.model.studies.iter().filter_map(|s| match &s.kind {
            StudyKind::Equilibrium { guess } if !guess.is_empty() => Some(from(guess)),
            _ => None,
        });
        guesses.chain([start[..n].to_vec(), vec![0.0; n]]).collect()
    } else {
        vec![from(guess)]
    };
    let (mut first, mut fault) = (None, None);
    for candidate in &candidates {
        match linear.settle(candidate) {
            Ok(place) => {
                if stable(linear, &place) {
                    return Ok(place);
                }
                first.get_or_insert(place);
            }
            Err(error) => {
                fault.get_or_insert(error);
            }
        }
    }
    match (first, fault) {
        (Some(place), _) => Ok(place),
        (None, Some(fault)) => Err(fault),
        (None, None) => Ok(Place::rest(&start[..n])),
    }
}

/// Whether no direction of C is negative.
fn stable(linear: &mut LinearMachine, place: &Place) -> bool {
    let Ok(found) = linear.at(place) else { return false };
    let found = found.allowed().map_or(found.clone(), |(z, k)| found.reduced(&z, k));
    let (even, _) = analysis::linear::parts(&found.stiffness, found.n);
    analysis::numerics::lu::positive_definite(&even, found.n) != Some(false)
}

/// Remarks on how time was treated.
pub fn timing_notes(machine: &LinearMachine) -> Vec<Text> {
    let timing = machine.timing();
    let mut notes = Vec::new();
    if timing.frozen {
        notes.push(Text::new(
            "the loads are no sums of harmonics: everything that depends on time is taken at t = 0",
            "нагрузки не являются суммой гармоник: всё, что зависит от времени, взято при t = 0",
        ));
    }
    if timing.settled {
        notes.push(Text::new(
            "formulas that switch with time are taken as they stand just after t = 0",
            "формулы, переключающиеся по времени, взяты такими, каковы они сразу после t = 0",
        ));
    }
    if timing.smoothed {
        notes.push(Text::new(
            "dry friction and one-sided contacts are left out of small motions",
            "сухое трение и односторонние связи в малых движениях не учтены",
        ));
    }
    if timing.driven {
        notes.push(Text::new("conditions that change with time are taken at t = 0", "связи, меняющиеся со временем, взяты при t = 0"));
    }
    if timing.varying {
        notes.push(Text::new(
            "the coefficients oscillate in time (parametric excitation); their means are taken, which says nothing about parametric resonance",
            "коэффициенты колеблются во времени (параметрическое возбуждение); взяты их средние, о параметрическом резонансе это ничего не говорит",
        ));
    }
    notes
}
