//! Strands that only pull and tracks that only push, over a cycle of a shaft.

use super::cycle::{Cycle, place, turn};
use crate::fault::connections::Since;
use crate::marks::Along;
use crate::marks::pushes::{Push, Pushes};
use crate::{Fault, System};
use words::Text;

/// Remarks on tracks that would have to pull while the shaft goes through its cycle from `start`.
///
/// *Errors*: S116 a strand would have to push, S046 and every fault of a motion.
pub fn over_cycle<S: System>(system: &mut S, start: &[f64], options: &Cycle, pushes: &[Push]) -> Result<Vec<Text>, Fault> {
    let known: Vec<Push> = pushes.iter().filter(|push| system.refusal(push.output).is_none()).cloned().collect();
    if known.is_empty() {
        return Ok(Vec::new());
    }
    system.show(&known.iter().map(|push| push.output).collect::<Vec<_>>())?;
    let name = system.states()[options.angle].name.clone();
    let steps = turn(system, start, options, 1.0)?.steps;
    let mut pushes = Pushes::new(&known);
    for (step, length) in &steps {
        pushes.look(&mut Along::new(step, system, *length));
        if let Some((push, t)) = pushes.broken() {
            return Err(Fault::strand_pushes(&push.label, Since::Angle(&name, place(step, options.angle, t - step.start.high))));
        }
    }
    let angle = |t: f64| {
        let step = steps.iter().rev().find(|(step, _)| step.start.high <= t);
        Since::Angle(&name, step.map_or(f64::NAN, |(step, _)| place(step, options.angle, t - step.start.high)))
    };
    Ok(pushes.notes(angle))
}
