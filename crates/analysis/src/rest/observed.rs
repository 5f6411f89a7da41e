//! What else is known where a machine rests: reactions that its coordinates hide, and the outputs of the file.
//!
//! A reaction without a coordinate follows from the balances of released bodies, with rates and accelerations zero
//!
//! ```text
//! Σ_hidden released_k λ_k = -rest - Σ_known released_k λ_k
//! ```
//!
//! and has a number only where that is the same in all solutions. Reactions that hold the same coordinates together (a rope and a support whose point it
//! moves) are unknown like these: Newton's method finds one of their solutions, and only the balances may say which.

use symbolic::connections::Reaction;
use symbolic::equations::Role;
use symbolic::linear::Timing;
use symbolic::{Equations, Expr, SymbolId};
use words::Text;

use super::admissible::Hold;
use super::numbers::Numbers;
use super::places::Place;
use super::sizes::NOISE;
use super::system::Parts;
use crate::dataset::{Column, Dataset, Missing};
use crate::{Fault, Quantity};

/// Remainder of the balances, relative, above which nothing of them is believed.
const BALANCED: f64 = 1e-9;

/// Completes the reactions of a place (one for each of the equations; none: open) by those that the balances determine.
pub fn complete(equations: &Equations, (parameters, q): (&[f64], &[f64]), reactions: &mut [Option<f64>]) {
    complete_with(equations, &Numbers::at_rest(equations, parameters, q), reactions);
}

/// The same of a place.
pub fn complete_place(equations: &Equations, parameters: &[f64], place: &mut Place) {
    complete_with(equations, &Numbers::at_rest(equations, parameters, &place.q).below(&place.below), &mut place.reactions);
}

/// Reactions that differ by less than this share of the largest at several instants stand still.
const STILL: f64 = 1e-9;

/// The same from the equations of motion, for machines that stand still in a turning frame: means of balances in ground axes say nothing there, because the
/// directions of the reactions turn with the loads. What is the same at all instants is taken.
pub fn complete_turning(motion: &Equations, (parameters, q): (&[f64], &[f64]), reactions: &mut [Option<f64>]) {
    if reactions.iter().all(Option::is_some) || !motion.auxiliaries.iter().any(|a| !motion.graph.is_zero(a.rate)) {
        return;
    }
    let own = &parameters[..motion.parameters.len()];
    let at = |time: &f64| {
        let mut list = reactions.to_vec();
        complete_with(motion, &Numbers::at(motion, (own, q), *time), &mut list);
        list
    };
    let instants: Vec<Vec<Option<f64>>> = LATER.iter().map(at).collect();
    let largest = instants.iter().flatten().flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
    for (r, reaction) in reactions.iter_mut().enumerate().filter(|(_, value)| value.is_none()) {
        let first = instants[0][r];
        let same = |list: &Vec<Option<f64>>| list[r].zip(first).is_some_and(|(a, b)| (a - b).abs() <= STILL * largest);
        *reaction = first.filter(|_| instants.iter().all(same));
    }
}

fn complete_with(equations: &Equations, numbers: &Numbers, reactions: &mut [Option<f64>]) {
    let unknown: Vec<usize> = (0..reactions.len()).filter(|r| reactions[*r].is_none()).collect();
    if unknown.is_empty() || equations.balances.is_empty() {
        return;
    }
    let n = equations.coordinates.len();
    let rows = n + equations.balances.len();
    let mut right: Vec<f64> = equations
        .force
        .iter()
        .copied()
        .chain(equations.balances.iter().map(|b| b.rest))
        .collect::<Vec<Expr>>()
        .chunks(1)
        .map(|e| -numbers.evaluate(e)[0])
        .collect();
    let mut matrix = vec![0.0; rows * unknown.len()];
    for (r, reaction) in equations.reactions.iter().enumerate() {
        let acting = reaction.forces.iter().map(|(j, e)| (*j, *e)).chain(reaction.released.iter().map(|(i, e)| (n + i, *e)));
        let (places, list): (Vec<usize>, Vec<Expr>) = acting.unzip();
        let column = unknown.iter().position(|u| *u == r);
        for (row, factor) in places.into_iter().zip(numbers.evaluate(&list)) {
            match (column, reactions[r]) {
                (Some(k), _) => matrix[row * unknown.len() + k] += factor,
                (None, known) => right[row] -= factor * known.unwrap_or(0.0),
            }
        }
    }
    let hold = Hold::new(&matrix, &right, unknown.len());
    if hold.remainder > BALANCED {
        return;
    }
    let unit = |k: usize| &equations.reactions[unknown[k]].unit;
    let largest = |k: usize| (0..unknown.len()).filter(|j| unit(*j) == unit(k)).fold(0.0_f64, |m, j| m.max(hold.some[j].abs()));
    for k in (0..unknown.len()).filter(|k| hold.is_unique(*k)) {
        let value = hold.some[k];
        reactions[unknown[k]] = Some(if value.abs() <= NOISE * largest(k) { 0.0 } else { value });
    }
}

/// Leaves open the reactions that share the holding of coordinates with others, and with them what follows from their values, unless the balances of
/// released bodies determine them. Contacts that are closed there take part even where the place was found without them.
///
/// *Errors*: a formula has no value there.
pub fn open_shared(equations: &Equations, parameters: &[f64], place: &mut Place) -> Result<(), Fault> {
    let mut closed = super::closed_contacts(equations, &place.q, parameters)?;
    closed.extend(&place.closed);
    let acting = Parts::holding(equations, |r| closed.contains(&r)).smooth(equations).reactions;
    let numbers = Numbers::at_rest(equations, parameters, &place.q);
    let mut matrix = vec![0.0; place.q.len() * acting.len()];
    for (k, r) in acting.iter().enumerate() {
        let (rows, list): (Vec<usize>, Vec<Expr>) = equations.reactions[*r].forces.iter().map(|(j, e)| (*j, *e)).unzip();
        rows.into_iter().zip(numbers.evaluate(&list)).for_each(|(row, factor)| matrix[row * acting.len() + k] += factor);
    }
    let hold = Hold::new(&matrix, &vec![0.0; place.q.len()], acting.len());
    let shared: Vec<usize> = (0..acting.len()).filter(|k| !hold.is_unique(*k)).map(|k| acting[k]).collect();
    if shared.is_empty() {
        return Ok(());
    }
    let unknown = |r: &usize| equations.reactions[*r].law.is_hidden() || shared.contains(r);
    (0..equations.reactions.len()).filter(unknown).for_each(|r| place.reactions[r] = None);
    complete_place(equations, parameters, place);
    Ok(())
}

/// Which reactions without a value call for a remark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Left {
    /// Those that the coordinates hide.
    Hidden,
    /// All, where one is among them that acts on coordinates.
    Shared,
}

/// Names the reactions that the equations of rest do not determine.
pub fn left_open(equations: &Equations, reactions: &[Option<f64>], which: Left) -> Option<Text> {
    let open = || equations.reactions.iter().zip(reactions).filter(|(r, value)| value.is_none() && r.law.is_reaction()).map(|(r, _)| r);
    let named = |r: &&Reaction| which == Left::Shared || r.law.is_hidden();
    let names: Vec<&str> = open().filter(named).map(|r| r.name.as_str()).collect();
    let silent = names.is_empty() || which == Left::Shared && open().all(|r| r.law.is_hidden());
    let list = names.join(", ");
    (!silent)
        .then(|| Text::new(format!("the equations of rest do not determine {list}"), format!("уравнениями покоя не определяются {list}")))
}

/// Whether a formula changes with time by itself, and not through coordinates and reactions.
fn depends_on_time(equations: &Equations, formula: Expr) -> bool {
    let turns = |s: SymbolId| s == equations.time || equations.auxiliaries.iter().any(|a| a.symbol == s);
    let mut moving: Vec<SymbolId> = Vec::new();
    for d in &equations.definitions {
        if equations.graph.contains(d.formula, |s| turns(s) || moving.contains(&s)) {
            moving.push(d.symbol);
        }
    }
    equations.graph.contains(formula, |s| turns(s) || moving.contains(&s))
}

/// Times at which a formula is looked at to see whether it stands still, s.
const LATER: [f64; 3] = [0.0, 0.731, 17.39];

/// Whether a formula has the same value at all times, because the rates in it are zero for these numbers.
fn still(later: &[Vec<Numbers>], formula: Expr) -> bool {
    later.iter().all(|times| {
        let values: Vec<f64> = times.iter().map(|numbers| numbers.evaluate(&[formula])[0]).collect();
        values.iter().all(|v| *v == values[0])
    })
}

/// Adds the outputs of the file at each place of the result, one row of which is a place: columns of coordinates and reactions by their names.
/// Outputs that change with time by themselves have no value at rest unless all loads stand still at t = 0.
/// `below` has what the coordinates and reactions of each place have below their last digits, where that is known.
pub fn add(equations: &Equations, (parameters, below): (&[f64], &[Vec<f64>]), timing: Timing, data: &mut Dataset) {
    let symbol_of = |name: &str| {
        let coordinate = equations.coordinates.iter().map(|c| c.symbols[0]).find(|s| equations.graph.symbol_info(*s).name == name);
        coordinate.or_else(|| equations.reactions.iter().find(|r| r.name == name).map(|r| r.symbol))
    };
    let places = data.columns.first().map_or(0, |c| c.values.len());
    let known: Vec<(SymbolId, usize)> =
        data.columns.iter().enumerate().filter_map(|(i, c)| Some((symbol_of(&c.quantity.name)?, i))).collect();
    let open = equations.reactions.iter().map(|r| (r.symbol, f64::NAN));
    let values_at = |row: usize, time: f64| {
        let at = |s: SymbolId| known.iter().find(|(own, _)| *own == s).map(|(_, i)| data.columns[*i].values[row]);
        let q: Vec<f64> = equations.coordinates.iter().map(|c| at(c.symbols[0]).unwrap_or(f64::NAN)).collect();
        let reactions: Vec<(SymbolId, f64)> = open.clone().map(|(s, none)| (s, at(s).unwrap_or(none))).collect();
        Numbers::at(equations, (parameters, &q), time).with(reactions).below(below.get(row).map_or(&[], Vec::as_slice))
    };
    let rows: Vec<Numbers> = (0..places).map(|row| values_at(row, 0.0)).collect();
    let later: Vec<Vec<Numbers>> = (0..places).map(|row| LATER.map(|time| values_at(row, time)).into()).collect();
    let mut columns = Vec::new();
    for output in equations.outputs.iter().filter(|o| o.role == Role::Named) {
        let moves = !timing.frozen && depends_on_time(equations, output.formula) && !still(&later, output.formula);
        let value = |numbers: &Numbers| if moves { f64::NAN } else { numbers.settled(output.formula) };
        let symbol = equations.graph.symbol_info(output.symbol).name.clone();
        let display = output.display.clone();
        let quantity = Quantity { symbol, display, label: output.label.clone(), ..Quantity::new(&output.name, &output.unit) };
        let held = |s: SymbolId| equations.reactions.iter().any(|r| r.symbol == s);
        let why = match () {
            () if moves => Text::new("changes with time by itself", "само зависит от времени"),
            () if equations.graph.contains(output.formula, held) => {
                Text::new("not determined by the equations of rest", "уравнениями покоя не определяется")
            }
            () => Text::new("has no value at rest", "в покое не имеет значения"),
        };
        columns.push((Column { quantity, values: rows.iter().map(value).collect() }, why));
    }
    for (column, why) in columns {
        let name = column.quantity.name.clone();
        data.columns.push(column);
        data.state(&name, Missing::Absent, why);
        data.state(&name, Missing::Unbounded, Text::new("has no finite value at rest", "в покое не имеет конечного значения"));
    }
}
