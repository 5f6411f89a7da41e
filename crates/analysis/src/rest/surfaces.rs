//! Frictions whose surface moves while the machine rests: a belt, a drum that is turned. They slide, F = ∓μ N by the sign of the sliding speed, and no limit of standing friction holds for
//! them.

use program::lower::{self, Inputs};
use program::{Evaluator, Point};
use symbolic::Equations;
use symbolic::connections::Law;
use words::explain::{Explanation, plain};
use words::{Message, Text};

use super::formulas::{at_rest, definitions};
use crate::Fault;

/// S167.
pub const MOVING: Explanation = plain(
    "S167",
    ("rest on a surface that moves", "покой на движущейся поверхности"),
    (
        "Equilibrium and statics know dry friction that stands: any force up to its limit. Where the surface itself moves (a belt with a speed, a drum with `spin`, a pathway with time in it), the friction \
         slides although the machine rests, and its force is that of sliding. `simulate` and `periodic` follow such machines; for a place of rest write the sliding force as a load.",
        "Равновесие и статика знают сухое трение покоя: любую силу до предела. Если движется сама поверхность (лента со скоростью, барабан со `spin`, путь, зависящий от времени), то при покоящейся машине \
         трение скользит, и сила его – сила трения скольжения. Такие машины рассчитывают `simulate` и `periodic`; для положения покоя задайте силу трения скольжения нагрузкой.",
    ),
);

/// The refusal of a machine with a friction that slides at rest; none without.
///
/// *Errors*: formulas outside their domain.
pub(crate) fn moving(equations: &Equations, parameters: &[f64], q: &[f64]) -> Result<Option<Fault>, Fault> {
    let mut graph = equations.graph.clone();
    let mut list = Vec::new();
    for reaction in &equations.reactions {
        let Law::Friction(friction) = &reaction.law else { continue };
        let speed = at_rest(equations, &mut graph, friction.sliding);
        if !graph.is_zero(speed) {
            list.push((reaction, speed));
        }
    }
    if list.is_empty() {
        return Ok(None);
    }
    let inputs = Inputs {
        parameters: equations.parameters.iter().map(|p| p.symbol).collect(),
        states: equations.coordinates.iter().map(|c| c.symbols[0]).collect(),
        zeros: equations.coordinates.iter().flat_map(|c| [c.symbols[1], c.symbols[2]]).chain([equations.time]).collect(),
        definitions: definitions(equations),
        ..Inputs::default()
    };
    let named: Vec<_> = list.iter().map(|(reaction, speed)| (reaction.name.clone(), *speed)).collect();
    let tape = std::sync::Arc::new(lower::expressions(&graph, "sliding", &inputs, &named)?);
    let mut evaluator = Evaluator::new(&tape, parameters)?;
    let speeds = evaluator.evaluate(&Point { states: q, ..Point::default() })?;
    let first = list.iter().zip(speeds).find(|(_, speed)| **speed != 0.0);
    Ok(first.map(|((reaction, _), speed)| refused(&reaction.label, *speed)))
}

fn refused(name: &Text, speed: f64) -> Fault {
    let speed = words::digits::rounded(speed.abs());
    Fault::new(Message {
        code: "S167",
        what: Text::new(
            format!("{}: its surface moves, so it slides while the machine rests", name.en),
            format!("{}: поверхность движется, при покое машины оно скользит", name.ru),
        ),
        why: Text::new(
            format!("with all rates zero its sliding speed is {} (SI); limits of standing friction say nothing of it", speed.en),
            format!(
                "при нулевых скоростях координат скорость скольжения равна {} (СИ); пределы трения покоя к нему не относятся",
                speed.ru
            ),
        ),
        help: Text::new(
            "follow the motion with `simulate`, or write the force of sliding as a load",
            "рассчитайте движение в `simulate` или задайте силу трения скольжения нагрузкой",
        ),
    })
}
