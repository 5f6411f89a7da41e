//! From what is asked to the options of `analysis`: columns, times, events, ranges.

use crate::failure::{Failure, Misuse};
use analysis::marks::named::{Direction, Named};
use analysis::marks::pushes::{Beyond, Push};
use mechanics::Model;
use mechanics::derive::{event_output, push_output, strand_output};
use mechanics::model::{EventDecl, EventDirection, Plot};
use symbolic::equations::Role;
use symbolic::{Equations, SymbolId};
use words::{Notice, nearest};

/// Coordinates, their rates, then the outputs of the file.
pub fn usual_columns(equations: &Equations) -> Vec<String> {
    let of = |role| equations.outputs.iter().filter(move |o| o.role == role).map(|o| o.name.clone());
    of(Role::Coordinate).chain(of(Role::Rate)).chain(of(Role::Named)).collect()
}

/// The wanted columns, or the usual ones, and every column that the plots need.
pub fn columns_with_plots(wanted: &[String], plots: &[Plot], equations: &Equations) -> Vec<String> {
    let mut columns = if wanted.is_empty() { usual_columns(equations) } else { wanted.to_vec() };
    let drawn = plots.iter().flat_map(|p| p.x.iter().chain(&p.y)).filter(|n| *n != "t");
    for name in drawn {
        if !columns.contains(name) {
            columns.push(name.clone());
        }
    }
    columns
}

/// Whether every column that is asked for exists.
///
/// # Errors
/// A column that does not (C008).
pub fn known_columns(names: &[String], equations: &Equations) -> Result<(), Failure> {
    names.iter().try_for_each(|name| known(name, equations))
}

/// Whether the model offers an output.
///
/// # Errors
/// It does not (C008).
pub fn known(name: &str, equations: &Equations) -> Result<(), Failure> {
    let names = || equations.outputs.iter().filter(|o| o.role != Role::Event).map(|o| o.name.as_str());
    if names().any(|n| n == name) {
        return Ok(());
    }
    let trouble = Notice::new("C008", format!("there is no output `{name}`"), format!("нет выходной величины `{name}`"));
    let list = names().take(60).collect::<Vec<_>>().join(", ");
    let trouble = trouble.why(format!("the model offers: {list}"), format!("в модели есть: {list}"));
    Err(match nearest(name, names()) {
        Some(near) => trouble.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
        None => trouble.help(
            "correct the name, or define it in [outputs] of the model file",
            "исправьте имя или определите величину в [outputs] файла модели",
        ),
    }
    .misuse())
}

/// The named events of the file, by the outputs that hold their formulas.
pub fn events(model: &Model, equations: &Equations) -> Vec<Named> {
    let named = |event: &EventDecl| {
        let holder = event_output(&event.name);
        let output = equations.outputs.iter().position(|o| o.name == holder)?;
        let direction = match event.direction {
            EventDirection::Rising => Direction::Rising,
            EventDirection::Falling => Direction::Falling,
            EventDirection::Both => Direction::Both,
        };
        Some(Named { name: event.name.clone(), output, direction, stop: event.stop })
    };
    model.events.iter().filter_map(named).collect()
}

/// Normal forces that only push and strands that only pull, among the outputs.
pub fn pushes(model: &Model, equations: &Equations) -> Vec<Push> {
    let watched = |name: &str| {
        let holder = push_output(name);
        let output = equations.outputs.iter().position(|o| o.name == holder)?;
        let label = equations.outputs[output].label.clone();
        Some(Push { name: format!("normal({name})"), label, output, beyond: Beyond::Noted, impulse: only_reaction(equations, &holder) })
    };
    let strand = |name: &str, k: usize| {
        let holder = strand_output(name, k);
        let output = equations.outputs.iter().position(|o| o.name == holder)?;
        let label = equations.outputs[output].label.clone();
        Some(Push { name: format!("slack_side({name})"), label, output, beyond: Beyond::Ends, impulse: only_reaction(equations, &holder) })
    };
    let of = |name: &str| watched(name).into_iter().chain((0..2).filter_map(|k| strand(name, k))).collect::<Vec<_>>();
    model.connections.iter().flat_map(|c| of(&c.name)).collect()
}

/// The only reaction in a force that only pushes, or in the tension of a strand, and the sign that it has there: in an impact nothing else counts, the pretension of a belt included.
fn only_reaction(equations: &Equations, holder: &str) -> Option<(String, f64)> {
    let output = equations.outputs.iter().find(|o| o.name == holder)?;
    let mut inside = equations.reactions.iter().filter(|r| equations.graph.contains(output.formula, |s| s == r.symbol));
    let (reaction, None) = (inside.next()?, inside.next()) else { return None };
    let force = |of: f64| equations.graph.evaluate(&[output.formula], &|s| if s == reaction.symbol { of } else { 0.0 })[0];
    let slope = force(1.0) - force(0.0);
    (slope.is_finite() && slope != 0.0).then(|| (reaction.name.clone(), slope.signum()))
}

/// The start of the motion with some coordinates replaced, as a place to search from.
pub fn guesses(equations: &Equations, start: &[f64], guess: &[(SymbolId, f64)]) -> analysis::studies::equilibrium::Equilibrium {
    let guesses = if guess.is_empty() { Vec::new() } else { vec![guessed(equations, start, guess)] };
    analysis::studies::equilibrium::Equilibrium { guesses, ..Default::default() }
}

/// The start with some coordinates replaced; where connections close chains, the others follow if they can.
pub fn guessed(equations: &Equations, start: &[f64], guess: &[(SymbolId, f64)]) -> Vec<f64> {
    let position = |symbol: SymbolId| equations.coordinates.iter().position(|c| c.symbols[0] == symbol);
    let held: Vec<(usize, f64)> = guess.iter().filter_map(|(symbol, value)| Some((position(*symbol)?, *value))).collect();
    let mut place = start[..equations.coordinates.len().min(start.len())].to_vec();
    if !equations.conditions.is_empty() && held.len() < place.len() {
        let parameters: Vec<f64> = equations.parameters.iter().map(|p| p.value).collect();
        if let Some(closed) = analysis::connections::closed_guess(equations, &parameters, &held) {
            return closed;
        }
    }
    held.iter().for_each(|(j, value)| place[*j] = *value);
    place
}
