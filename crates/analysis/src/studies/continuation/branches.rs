//! The whole diagram: the branch of the motion or the place of rest that the file gives, in both directions, and those that part from it.

use super::corrector;
use super::crease;
use super::curve::{Curve, End, Of};
use super::diagram::{Diagram, Options, SAME, Work, followed};
use super::orbits::{By, Orbits};
use super::places::Rests;
use super::switching;
use super::zeros::{Family, Place, Zeros};
use crate::Fault;
use crate::fault::codes;
use crate::studies::periodic::{Periodic, Shooting};
use algebra::elementary;

/// Periodic motions along a parameter, from the one that `start` leads to at the value where the diagram begins.
///
/// *Errors*: there is no regime to begin with, S151 where it repeats in a moving frame only, and those of the family.
pub fn regimes(family: &mut dyn Family, start: &[f64], periodic: &Periodic<'_>, options: &Options<'_>) -> Result<Diagram, Fault> {
    let (machine, _) = family.at(options.start)?;
    let mut shooting = Shooting::new(machine, start, periodic)?;
    let assembled = machine.start()?;
    shooting.assembled(machine, &assembled)?;
    if shooting.drifts() {
        return Err(switching::drifts());
    }
    let (x, period) = shooting.regime();
    let mut y = x.to_vec();
    if !shooting.is_driven() {
        y.push(period);
    }
    y.push(options.start);
    let mut orbits = Orbits { family, shooting, returns: 1, range: options.to - options.from, work: [0; 2], by: By::default() };
    let mut diagram = Diagram::default();
    let of = Of::Orbits(usize::from(orbits.shooting.is_driven()));
    whole(&mut orbits, y, of, (options, &mut diagram))?;
    switching::of_orbits(&mut orbits, 0, options, &mut diagram);
    crease::follow(&mut orbits, 0, (options, &mut diagram));
    let [turns, variations] = orbits.turns();
    diagram.work = Work { turns, variations };
    Ok(diagram)
}

/// Places of rest along a parameter, from the one that `start` leads to at the value where the diagram begins; periodic motions that part from them.
///
/// *Errors*: S154 where time occurs in the equations, S153 where nothing rests near the start, and those of the family.
pub fn rests(family: &mut dyn Family, start: &[f64], options: &Options<'_>) -> Result<Diagram, Fault> {
    let mut diagram = Diagram::default();
    let n = crate::System::n_coordinates(family.at(options.start)?.0);
    let mut rests = Rests::new(family, start, options.start, options.to - options.from)?;
    let y = rests.settled(Rests::unknowns(start, n, options.start))?;
    whole(&mut rests, y, Of::Rest, (options, &mut diagram))?;
    switching::at_branch_points(&mut rests, 0, options, &mut diagram);
    crease::follow(&mut rests, 0, (options, &mut diagram));
    let [turns, variations] = rests.turns();
    diagram.work = Work { turns, variations };
    let count = diagram.special.len();
    switching::from_rest(family, count, options, &mut diagram)?;
    Ok(diagram)
}

/// Distance from 1 at which a multiplier is 1: half of the digits of a turn, for a double root.
const FAMILY: f64 = 1e-7;

/// Whether a multiplier besides that of the shift is 1: neighbouring motions close as well.
fn one_of_a_family(place: &Place) -> bool {
    let numbers = place.facts().multipliers.iter().flatten();
    let mut own = numbers.filter(|m| !m.trivial);
    own.any(|m| elementary::hypot(m.re - 1.0, m.im) <= m.error.max(FAMILY))
}

/// The branch through a point, in both directions.
pub(super) fn whole(zeros: &mut dyn Zeros, y: Vec<f64>, of: Of, (options, diagram): (&Options<'_>, &mut Diagram)) -> Result<(), Fault> {
    let last = y.len() - 1;
    let mut known: Option<Curve> = None;
    for sign in [-1.0, 1.0] {
        let outwards = if sign > 0.0 { options.to - y[last] } else { y[last] - options.from };
        // where the range ends there is nothing to follow
        if outwards <= SAME * (options.to - options.from) || known.as_ref().is_some_and(|c| c.ends[0] == Some(End::Closed)) {
            continue;
        }
        let direction: Vec<f64> = (0..=last).map(|i| if i == last { sign * (options.to - options.from) } else { 0.0 }).collect();
        let start = corrector::place(zeros, y.clone(), &direction)?.ok_or_else(switching::no_direction)?;
        if of != Of::Rest && one_of_a_family(&start) {
            return Err(switching::no_direction());
        }
        // both directions together have so many points
        let used = known.as_ref().map_or(0, |c| c.places.len().saturating_sub(1));
        let options = &Options { points: options.points.saturating_sub(used).max(1), ..*options };
        let curve = followed(zeros, start, options, diagram);
        // what the file says of the period is wrong, and not the branch
        if let Some(End::Stuck(_, Some(fault))) = &curve.ends[1]
            && fault.code == codes::NO_PERIOD
        {
            return Err(fault.clone());
        }
        known = Some(match known {
            Some(before) => before.then(curve),
            // a curve that closes has no other end
            None => {
                let begin = if curve.ends[1] == Some(End::Closed) { End::Closed } else { End::Left };
                let curve = Curve { ends: [Some(begin), curve.ends[1].clone()], ..curve };
                if sign < 0.0 { curve.turned() } else { curve }
            }
        });
    }
    if let Some(curve) = known {
        diagram.take(Curve { of, ..curve });
    }
    Ok(())
}
