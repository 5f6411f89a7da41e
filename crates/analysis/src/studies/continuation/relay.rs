//! A branch by whichever equations do: whole turns, and a mesh from where these are too sensitive.

use super::curve::{Bounds, Curve, End, closes, lingers, winds};
use super::locate::Special;
use super::zeros::{Finer, Place, Zeros};

/// Points on one mesh: a motion changes its shape on the way, and its mesh with it.
const ON_ONE_MESH: usize = 12;

/// Follows a branch; where whole turns end or grow too sensitive it goes on by finer equations to its end.
pub(super) fn walk(zeros: &mut dyn Zeros, start: Place, bounds: Bounds<'_>, known: &dyn Fn(&Special) -> bool) -> Curve {
    let mut curve = super::curve::walk(zeros, start, bounds, known);
    loop {
        let fails = matches!(curve.ends[1], Some(End::Outgrown | End::Stuck(..)));
        let Some(last) = curve.places.last().cloned().filter(|_| fails) else { return curve };
        if let Some((mut finer, begin)) = zeros.finer(&last) {
            return along(finer.as_mut(), begin, curve, (bounds, known));
        }
        if curve.ends[1] != Some(End::Outgrown) {
            return curve;
        }
        // there are none: on by whole turns, as far as they lead
        zeros.stay();
        let rest = Bounds { points: bounds.points.saturating_sub(curve.places.len() - 1), ..bounds };
        curve = curve.then(super::curve::walk(zeros, last, rest, known));
    }
}

/// The rest of a branch by finer equations.
fn along(finer: &mut dyn Finer, begin: Place, mut curve: Curve, (bounds, known): (Bounds<'_>, &dyn Fn(&Special) -> bool)) -> Curve {
    let home = curve.places.first().cloned();
    let (mut start, mut first) = (begin, bounds.first);
    loop {
        let left = bounds.points.saturating_sub(curve.places.len() - 1);
        let leg = super::curve::walk(finer.zeros(), start, Bounds { points: ON_ONE_MESH.min(left), first, ..bounds }, known);
        let (count, end) = (leg.places.len(), leg.ends[1].clone());
        first = length(&leg).unwrap_or(first);
        let last = leg.places.last().cloned();
        let before = curve.places.len();
        curve = curve.then(shorter(finer, leg));
        let pairs = curve.places.windows(2).enumerate().skip(before.max(2) - 1);
        let at = home.as_ref().and_then(|home| pairs.into_iter().find(|(_, pair)| closes(home, &pair[0], &pair[1])).map(|(k, _)| k));
        if let (Some(k), Some(home)) = (at, home.clone()) {
            curve.places.truncate(k + 1);
            curve.places.push(home);
            curve.special.retain(|(place, _)| *place <= k + 1);
            curve.ends[1] = Some(End::Closed);
            return curve;
        }
        if let Some(limit) = winds(&curve, bounds.ranges.len()) {
            curve.ends[1] = Some(End::Winds(limit));
            return curve;
        }
        let goes_on = matches!(end, Some(End::Points | End::Outgrown)) && curve.places.len() < bounds.points && count > 1;
        let Some(last) = last.filter(|_| goes_on) else {
            if curve.places.last().is_some_and(|a| matches!(end, Some(End::Stuck(..))) && lingers(a, bounds.ranges.len())) {
                curve.ends[1] = Some(End::Lingers);
            }
            return curve;
        };
        match finer.remesh(&last) {
            Ok(Some(next)) => start = next,
            found => {
                curve.ends[1] = Some(End::Stuck(first, found.err()));
                return curve;
            }
        }
    }
}

/// Length of the last step.
fn length(leg: &Curve) -> Option<f64> {
    let [a, b] = leg.places.last_chunk::<2>()?;
    let way: Vec<f64> = b.y.iter().zip(&a.y).map(|(b, a)| b - a).collect();
    Some(a.dot(&way, &way).sqrt())
}

/// A part of a branch with the unknowns of the coarser equations.
fn shorter(finer: &dyn Finer, leg: Curve) -> Curve {
    let places = leg.places.into_iter().map(|place| finer.shortened(place)).collect();
    let short = |(k, special): (usize, Special)| (k, Special { place: finer.shortened(special.place), ..special });
    Curve { places, special: leg.special.into_iter().map(short).collect(), ..leg }
}
