//! The coordinates that stand for a frame in the machine, and whether the model is more than its frame.

use super::bind::Bound;
use super::figures::components;
use analysis::studies::structure_modes::{self, Modes};
use mechanics::Model;
use mechanics::model::{Class, CoordinateDecl};
use mechanics::structure as file;
use structures::equilibrium::stands_undivided;
use structures::reduced::Condensation;
use structures::substructure::{Substructure, Wish, substructure};
use structures::{Assembly, Load};
use words::Text;

/// Largest number of freedoms of a frame without named displacements that becomes part of the machine.
const NAMELESS: usize = 100;
/// Largest number of freedoms of a frame that becomes part of the machine.
const MOUNTED: usize = 20_000;
/// Amplitudes without another wish.
const AMPLITUDES: usize = 8;

/// Whether the coordinates of the frame are used by a study that says nothing about their division itself.
pub(super) fn speaks(model: &Model) -> bool {
    let quiet = |asked: &mechanics::asked::Asked| matches!(asked.kind, "modes" | "statics");
    !is_bare(model) || model.studies.is_empty() || !model.studies.iter().all(quiet)
}

/// Whether the model is a frame and nothing else.
pub fn is_bare(model: &Model) -> bool {
    let bodies = model.frames.iter().any(|f| f.mass.is_some());
    let coupled = !model.connections.is_empty() || model.elements.iter().any(|e| e.law.couples());
    let own = |c: &CoordinateDecl| !is_of_frame(model, &c.name);
    model.structure.is_some() && !bodies && !coupled && !model.coordinates.iter().any(own)
}

fn is_of_frame(model: &Model, name: &str) -> bool {
    let named = model.structure.as_ref().is_some_and(|s| s.displacements.iter().any(|d| d.name == name));
    named || name.strip_prefix("eta_").is_some_and(|n| n.chars().all(|c| c.is_ascii_digit()))
}

pub(super) fn condensation(structure: &file::Structure) -> Condensation {
    match structure.options.condense {
        None => Condensation::Automatic,
        Some(true) => Condensation::Turns,
        Some(false) => Condensation::Massless,
    }
}

fn options(structure: &file::Structure) -> Modes {
    let count = structure.options.modes.unwrap_or(AMPLITUDES);
    Modes { count, condensation: condensation(structure), accuracy: structure.options.accuracy, ..Modes::default() }
}

/// What a finer division says about a frame of whose accuracy nothing is said.
pub(super) fn coarse(structure: &file::Structure, bound: &Bound) -> Option<Text> {
    let options = options(structure);
    let light = Assembly::of(&bound.frame).mass(&bound.frame).entries.iter().all(|e| e.2 == 0.0);
    if !light && options.accuracy.is_some() {
        return None;
    }
    structure_modes::modes_alone(&bound.frame, &options).and_then(|modes| structure_modes::coarse(&bound.frame, &options, &modes))
}

/// The coordinates of the frame, divided as its wanted accuracy needs.
///
/// # Errors
/// A mechanism, loose nodes, or an accuracy that is not reached.
pub fn coordinates(model: &Model, structure: &file::Structure, bound: &mut Bound) -> Result<Option<Substructure>, analysis::Fault> {
    stands_undivided(&bound.frame, bound.exact.as_ref())?;
    let assembly = Assembly::of(&bound.frame);
    // nobody can speak of the displacements of a large frame without their names
    let nameless = structure.displacements.is_empty() && assembly.n() > NAMELESS;
    if nameless || assembly.n() == 0 || assembly.n() > MOUNTED {
        return Ok(None);
    }
    let light = assembly.mass(&bound.frame).entries.iter().all(|e| e.2 == 0.0);
    if light && !structure.displacements.iter().any(|d| d.loaded) {
        return Ok(None);
    }
    let options = options(structure);
    let loads = units(model, structure, bound, |load| moves(model, load));
    let acting = units(model, structure, bound, |_| true);
    let wish = Wish { condensation: options.condensation, count: options.count, loads, acting };
    if light || options.accuracy.is_none() {
        return Ok(Some(substructure(&bound.frame, &assembly, &wish)?));
    }
    let refined = structure_modes::modes(&bound.frame, None, &options)?;
    let failed = |refinement: bool| refined.dataset.audits.iter().find(|a| !a.ok && (a.key == "refinement") == refinement);
    if let Some(audit) = failed(true).filter(|_| speaks(model)) {
        return Err(structures::faults::not_reached(audit.value, audit.limit).into());
    }
    if let Some(audit) = failed(false) {
        return Err(structures::faults::unconfirmed(audit.value, 0.0).into());
    }
    *bound = Bound { frame: refined.frame, exact: None };
    Ok(Some(substructure(&bound.frame, &refined.assembly, &wish)?))
}

/// Unit loads in the places of the components of some loads, in the order of [`super::figures::Figures`].
fn units(model: &Model, structure: &file::Structure, bound: &Bound, wanted: impl Fn(&file::Load) -> bool) -> Vec<Load<f64>> {
    let loads = structure.loads.iter().zip(&bound.frame.loads).filter(|(load, _)| wanted(load));
    let units = loads.flat_map(|(load, numbers)| components(load, numbers).into_iter().filter(|c| !model.graph.is_zero(c.0)));
    units.map(|(_, action)| Load { name: String::new(), action }).collect()
}

/// Whether a load depends on time.
pub fn moves(model: &Model, load: &file::Load) -> bool {
    let values: Vec<symbolic::Expr> = match &load.action {
        file::Action::Point { value, .. } => value.to_vec(),
        file::Action::Distributed { value, .. } => value.concat(),
    };
    let mut symbols = model.graph.symbols_in(&values);
    // parameters may be formulas of time
    let formulas = model.parameters.iter().filter(|p| symbols.contains(&p.symbol) && p.class == Class::Time);
    symbols.extend(formulas.map(|_| model.time).collect::<Vec<_>>());
    symbols.contains(&model.time)
}
