//! Named events of a regime: as many as a period has, wherever it begins.
//!
//! A period is a circle: what passes zero where it begins does so where it ends, once. Rounding may show that passage at both ends, at one or at none; the
//! signs inside the period say whether there is one. A formula that a period does not bring back (an angle that turns) has the passages of this one.

use super::found::Found;
use super::orbit::ONE;
use crate::dataset::{Dataset, Event};
use crate::marks::named::{Direction, Named, passed};
use crate::{Fault, System};
use algebra::arrange::Arrange;

/// Share of its largest value along the turn by which a formula that comes back may differ: that of states which close.
const BACK: f64 = 1e-8;

/// The events to be watched over a period: in both directions, which tell the sign on both sides of its ends, and none of which ends it.
pub(super) fn watched(events: &[Named]) -> Vec<Named> {
    events.iter().map(|event| Named { direction: Direction::Both, stop: false, ..event.clone() }).collect()
}

/// Leaves of what was listed over a period what one of many has.
///
/// *Errors*: those of the formulas.
pub(super) fn once_a_period<S: System + ?Sized>(
    system: &mut S,
    found: &Found<'_>,
    events: &[Named],
    dataset: &mut Dataset,
) -> Result<(), Fault> {
    for event in events {
        if comes_back(system, found, event)? {
            join(system, found, event, dataset)?;
        }
        dataset.events.retain(|own| own.name != event.name || event.direction.counts(own.sides[1]));
    }
    dataset.events.arrange_by(|a, b| a.t.total_cmp(&b.t));
    Ok(())
}

/// Whether the formula is at the end of the turn what it is at its start.
fn comes_back<S: System + ?Sized>(system: &mut S, found: &Found<'_>, event: &Named) -> Result<bool, Fault> {
    let (orbit, mut all) = (&found.orbit, vec![0.0; system.outputs().len()]);
    let (mut largest, mut x) = (0.0_f64, vec![0.0; orbit.first.len()]);
    for step in &orbit.steps {
        step.state_after(0.0, &mut x);
        system.observe(step.start.high, &x, &step.modes, &mut all)?;
        largest = largest.max(all[event.output].abs());
    }
    system.observe(0.0, &orbit.first, &orbit.modes[0], &mut all)?;
    let first = all[event.output];
    system.observe(orbit.period, &orbit.last, &orbit.modes[1], &mut all)?;
    Ok((all[event.output] - first).abs() <= BACK * largest)
}

/// Makes one passage, or none, of what is listed within rounding of the ends of the period.
fn join<S: System + ?Sized>(system: &mut S, found: &Found<'_>, event: &Named, dataset: &mut Dataset) -> Result<(), Fault> {
    let period = found.orbit.period;
    let at_ends = |own: &Event| own.t <= ONE * period || own.t >= (1.0 - ONE) * period;
    let inside = || dataset.events.iter().filter(|own| own.name == event.name && !at_ends(own));
    let signs = inside().next().zip(inside().next_back()).map(|(first, last)| [last.sides[1], first.sides[0]]);
    // a formula of one sign inside is touched at the ends at most
    let passes = signs.filter(|[before, after]| before != after);
    let listed = dataset.events.iter().position(|own| own.name == event.name && at_ends(own));
    let kept = listed.map(|k| dataset.events[k].clone());
    dataset.events.retain(|own| own.name != event.name || !at_ends(own));
    let Some(sides) = passes else { return Ok(()) };
    let known = kept.filter(|own| own.sides == sides);
    let passage = match known {
        Some(passage) => passage,
        None => at_end(system, found, (event, sides), dataset)?,
    };
    dataset.events.push(passage);
    Ok(())
}

/// A passage at the end of the period that rounding has hidden.
fn at_end<S: System + ?Sized>(
    system: &mut S,
    found: &Found<'_>,
    (event, sides): (&Named, [f64; 2]),
    dataset: &Dataset,
) -> Result<Event, Fault> {
    let (orbit, mut all) = (&found.orbit, vec![0.0; system.outputs().len()]);
    system.observe(orbit.period, &orbit.last, &orbit.modes[1], &mut all)?;
    let columns = dataset.columns.iter().enumerate().filter(|(i, _)| Some(*i) != dataset.axis);
    let value = |name: &str| system.outputs().iter().position(|q| q.name == name).map_or(f64::NAN, |i| all[i]);
    let outputs: Vec<f64> = columns.map(|(_, column)| value(&column.quantity.name)).collect();
    Ok(Event {
        t: orbit.period,
        name: event.name.clone(),
        what: passed(&event.name, sides[1]),
        guard: usize::MAX,
        sides,
        states: [orbit.last.clone(), orbit.last.clone()],
        outputs: [outputs.clone(), outputs],
        ..Event::default()
    })
}
