//! Whether dry friction can hold a machine around a place of rest.
//!
//! At a place where the machine rests without friction, one whose limit is above zero there, and which resists a motion that is left, holds the machine in a whole
//! neighbourhood of it. A friction that nothing presses at rest (an open stop, a slack rope, a formula c x at x = 0), or whose law has no value at rest, holds nothing there.

use crate::Fault;
use crate::rest::newton::relative;
use crate::rest::places::{Place, tangents_of};
use crate::rest::system::{Parts, RestSystem};
use algebra::vectors::{dot, norm};
use symbolic::Equations;
use words::Text;

/// Share of the terms of a limit or a normal force that is their rounding, and of a friction's levers along the motions that are left.
const NOTHING: f64 = 1e-12;

/// Whether a friction holds the machine around a place.
fn holds(equations: &Equations, parameters: &[f64], place: &Place) -> Result<bool, Fault> {
    let mut system = RestSystem::new(equations, Parts::holding(equations, |r| place.closed.contains(&r)), parameters)?;
    let (mut z, n) = (system.z(&place.q), system.n);
    for (value, r) in z[n..].iter_mut().zip(&system.reactions) {
        // what rest leaves open may press
        *value = place.reactions[*r].unwrap_or(1.0);
    }
    let rows = system.at(&z)?;
    let tangents = tangents_of(&rows, n);
    let resists = |r: &usize| {
        let column = system.reactions.iter().position(|own| own == r);
        let levers: Vec<f64> = column.map_or(Vec::new(), |c| rows.forces.iter().map(|row| row.slopes[n + c]).collect());
        tangents.iter().any(|t| dot(&levers, t).abs() > NOTHING * norm(&levers))
    };
    let limited = system.frictions.iter().zip(&rows.limits);
    Ok(limited.into_iter().any(|(r, (fixed, normal))| {
        let is_there = |row| relative(row, &z) > NOTHING;
        is_there(fixed) && is_there(normal) && resists(r)
    }))
}

/// What is said of places of rest that were found without dry friction.
pub(super) fn remark(equations: &Equations, parameters: &[f64], places: &[&Place]) -> Text {
    let held = places.iter().filter(|place| holds(equations, parameters, place).unwrap_or(true)).count();
    match held {
        0 => Text::new(
            "these are the places of rest without dry friction, which holds nothing there (its limit is zero, or it resists no motion that is left)",
            "это положения равновесия без сухого трения; в них оно ничего не удерживает (предельная сила равна нулю или движению она не препятствует)",
        ),
        n if n == places.len() => Text::new(
            "these are the places of rest without dry friction; with it the machine also rests around them",
            "это положения равновесия без сухого трения; с ним машина покоится и в их окрестности",
        ),
        _ => Text::new(
            "these are the places of rest without dry friction; with it the machine also rests around those of them at which a friction has a limit above zero",
            "это положения равновесия без сухого трения; с ним машина покоится и в окрестности тех из них, где предельная сила трения отлична от нуля",
        ),
    }
}
