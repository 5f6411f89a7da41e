//! Where a branch ends because a switch is only touched there.
//!
//! A motion that comes to a guard from the side on which it does not switch is one like others until it touches it: the branch is followed there, and a motion a little further
//! ahead switches. A motion that does switch has derivatives that grow like 1/v, v the rate of the guard as it is met, and no step comes to v = 0. But the instant of the switch and v as
//! unknowns instead of the start make the equations regular there, so that the branch is a smooth function of v, and its value at v = 0 that of a polynomial through its last points
//! (Neville).
//!
//! *Source*: A. B. Nordmark, J. Sound and Vibration 145 (1991) 279-297; M. di Bernardo, C. J. Budd, A. R. Champneys, P. Kowalczyk, Piecewise-smooth Dynamical Systems, 6.

use super::locate::{Special, What};
use super::zeros::{Place, Zeros};
use crate::studies::periodic::Meeting;

/// Steps beyond the end of a branch at which the motion is looked at: from what corrections resolve to what a straight way is good for.
const BEYOND: [f64; 4] = [1e-8, 1e-7, 1e-6, 1e-4];
/// Points of the polynomial: more only add the farther ones, which say less.
const NODES: usize = 10;
/// Rates of its points differ by this ratio at least: of points close together differences are rounding.
const APART: f64 = 1.15;
/// Points with which the last of its corrections tells something of the next one.
const LEAST: usize = 4;
/// How many times its last correction a limit may be moved by one point more: by more than that the point is off.
const SPREAD: f64 = 3.0;
/// Share of the way to v = 0 that the last correction may be: it is to be one digit less than the way at least, or v does not tend to 0.
const SURE: f64 = 0.1;

/// What happens at the end of a branch, where it is that a switch is touched.
pub(super) fn end(zeros: &mut dyn Zeros, places: &[Place]) -> Option<Special> {
    let a = places.last().filter(|a| !a.is_at_edge())?;
    if let Some(found) = vanishing(places)
        && is_border(zeros, a, &found.place)
    {
        return Some(found);
    }
    let ahead = |h: f64| -> Vec<f64> { a.y.iter().zip(&a.tangent).map(|(y, t)| y + h * t).collect() };
    let h = BEYOND.into_iter().find(|h| is_other(zeros, a, &ahead(*h)))?;
    let last = a.y.len() - 1;
    // the end of the way that was found, and what the last point is off by
    Some(Special { what: What::Grazing, place: a.clone(), within: (2.0 * h * a.tangent[last]).abs().max(left(places)) })
}

/// How far the parameter is from where the slowest switch of the last two points is only touched, by a straight line and no farther than they are from each other; 0 where it does not grow slower.
fn left(places: &[Place]) -> f64 {
    let Some([before, a]) = places.last_chunk::<2>() else { return 0.0 };
    let rates = before.local.facts.slowest.zip(a.local.facts.slowest).filter(|(u, v)| u.guard == v.guard && v.rate < u.rate);
    rates.map_or(0.0, |(u, v)| ((a.parameter() - before.parameter()) * (v.rate / (u.rate - v.rate)).min(1.0)).abs())
}

/// Directions in which motions beside a point are looked at: along the branch, and along the parameter alone. SI, of unit length in scales.
pub(super) fn beside(a: &Place) -> [Vec<f64>; 2] {
    let last = a.y.len() - 1;
    [a.tangent.clone(), (0..=last).map(|i| if i == last { a.local.scales[i] } else { 0.0 }).collect()]
}

/// Whether motions right beside a place switch otherwise than that of a point: on which side they do does not follow from the branch.
fn is_border(zeros: &mut dyn Zeros, a: &Place, at: &Place) -> bool {
    let ways = beside(a);
    let tries = BEYOND.iter().flat_map(|h| [*h, -h]).flat_map(|h| ways.iter().map(move |way| (h, way)));
    let mut places = tries.map(|(h, way)| at.y.iter().zip(way).map(|(y, t)| y + h * t).collect::<Vec<f64>>());
    places.any(|y| is_other(zeros, a, &y))
}

/// Whether the motion from y switches otherwise than that of a point.
fn is_other(zeros: &mut dyn Zeros, a: &Place, y: &[f64]) -> bool {
    zeros.switches(y).is_some_and(|switches| switches != a.local.facts.switches)
}

/// The point in which the slowest switch of the last points is only touched.
fn vanishing(places: &[Place]) -> Option<Special> {
    let a = places.last()?;
    let slowest = a.local.facts.slowest?;
    let rate = |place: &Place| {
        let facts = &place.local.facts;
        let is_same = |other: &Meeting| other.guard == slowest.guard && facts.switches == a.local.facts.switches;
        facts.slowest.filter(is_same).map(|meeting| meeting.rate)
    };
    tending(places, &rate, What::Grazing)
}

/// Extent, as a share of the largest on the branch, below which a motion has shrunk, and below which the parameter, which changes by its square, is rounding beside that of rest.
const SHRUNK: [f64; 2] = [0.02, 1e-4];

/// The place of rest to which the free motions of a branch shrink at its end, and how many of its points lead there. Where all shrinks in one ratio each step is a part of what is left, and none leads across.
pub(super) fn shrunk(places: &[Place]) -> Option<(Special, usize)> {
    let a = places.last().filter(|a| a.local.phase.is_some())?;
    let extent = |place: &Place| {
        let each = place.local.facts.extremes.iter().zip(&a.local.scales);
        each.map(|([low, high], scale)| (high - low) / scale).fold(0.0, f64::max)
    };
    let largest = places.iter().map(extent).fold(0.0, f64::max);
    if extent(a) > SHRUNK[0] * largest {
        return None;
    }
    let count = places.iter().rposition(|place| extent(place) > SHRUNK[1] * largest)? + 1;
    tending(&places[..count], &|place| Some(extent(place)), What::Hopf).map(|special| (special, count))
}

/// The point of a branch in which a number of its last points vanishes; none where the number stops falling, or the parameter has no limit.
fn tending(places: &[Place], value: &dyn Fn(&Place) -> Option<f64>, what: What) -> Option<Special> {
    let a = places.last()?;
    let mut nodes: Vec<(f64, &Place)> = vec![(value(a)?, a)];
    for place in places.iter().rev().skip(1) {
        let Some(v) = value(place) else { break };
        let (before, _) = nodes[nodes.len() - 1];
        if v <= before {
            break;
        }
        if v >= APART * before {
            nodes.push((v, place));
        }
        if nodes.len() == NODES {
            break;
        }
    }
    // the nearest points know their rate least: it is the root of a depth that is rounding there
    (0..nodes.len().saturating_sub(LEAST)).find_map(|skipped| {
        let points = &nodes[skipped..];
        let [whole, rest] = [points, &points[1..]].map(|points| at_zero(points, &Place::parameter));
        let within = (whole.0 - rest.0).abs().max(whole.1);
        let tends = within <= SPREAD * rest.1 && within <= SURE * (whole.0 - points[0].1.parameter()).abs();
        tends.then(|| Special { what, place: place_at_zero(points, a), within })
    })
}

/// The point at v = 0; its multipliers are infinite.
fn place_at_zero(points: &[(f64, &Place)], a: &Place) -> Place {
    let y = (0..a.y.len()).map(|i| at_zero(points, &|place| place.y[i]).0).collect();
    let mut place = Place { y, ..a.clone() };
    let facts = &mut place.local.facts;
    for (i, ends) in facts.extremes.iter_mut().enumerate() {
        *ends = [0, 1].map(|end| at_zero(points, &|place| place.local.facts.extremes[i][end]).0);
    }
    (facts.multipliers, facts.stable) = (None, None);
    place
}

/// Limit of a number of the points, and its last correction.
fn at_zero(points: &[(f64, &Place)], of: &dyn Fn(&Place) -> f64) -> (f64, f64) {
    limit(&points.iter().map(|(v, place)| (*v, of(place))).collect::<Vec<_>>())
}

/// Value at 0 of the polynomial through points, nearest to 0 first, and its last correction.
fn limit(points: &[(f64, f64)]) -> (f64, f64) {
    let mut row: Vec<f64> = points.iter().map(|(_, y)| *y).collect();
    let mut correction = f64::INFINITY;
    for order in 1..row.len() {
        let before = row[0];
        for i in 0..row.len() - order {
            let (near, far) = (points[i].0, points[i + order].0);
            row[i] += near * (row[i] - row[i + 1]) / (far - near);
        }
        correction = (row[0] - before).abs();
    }
    (row[0], correction)
}

#[cfg(test)]
mod tests {
    use super::limit;

    #[test]
    fn limit_of_a_smooth_function() {
        // cos v - 3 sin v at v = 0 from points that stay away from it
        let points: Vec<(f64, f64)> = (0..8).map(|k| 0.02 * 1.3_f64.powi(k)).map(|v| (v, v.cos() - 3.0 * v.sin())).collect();
        let (value, within) = limit(&points);
        // eight points within a tenth of the length over which the function changes
        assert!((value - 1.0).abs() <= within && within < 1e-9, "{value} {within}");
    }
}
