//! Curves of folds, period doublings, Hopf and torus points in the plane of two parameters, from what was found on the branches.

use super::corrector;
use super::curve::{Bounds, Curve, End, FIRST, Of, walk};
use super::diagram::{Crease, Diagram, Options, Second};
use super::locate::{Special, What};
use super::turning::Turning;
use super::zeros::{Place, Zeros};

/// Share of a step by which the first parameter moves in a cusp: in exact numbers it rests there, as the second one does, and anywhere else on a curve of folds only one of them can.
const RESTS: f64 = 1e-3;
/// Values of the first parameter that are one, as a share of its range: a cubic over a step is as good as that.
const SAME: f64 = 1e-5;
/// Extents that are one, as a share of their scale: a chord over a step is as good as that.
const ALIKE: f64 = 0.02;
/// Halvings of a step.
const HALVINGS: usize = 50;

/// Follows the folds, period doublings, Hopf and torus points among the special points of a diagram, from the k-th on, over the second parameter.
pub(super) fn follow(zeros: &mut dyn Zeros, k: usize, (options, diagram): (&Options<'_>, &mut Diagram)) {
    let Some(second) = options.second else { return };
    for k in k..diagram.special.len() {
        if options.is_interrupted() {
            break;
        }
        let (which, _, special) = diagram.special[k].clone();
        let of = diagram.curves[which].of;
        let lies = |crease: &Crease| crease.curve.of == of && crease.what == special.what && passes(crease, &special, second);
        let hopf = special.what == What::Hopf && of == Of::Rest && !special.place.signs.paired;
        if !(hopf || matches!(special.what, What::Fold | What::Doubling | What::Torus)) || diagram.creases.iter().any(lies) {
            continue;
        }
        if let Of::Orbits(periods) = of {
            zeros.repeat(periods);
        }
        match one(zeros, &special, (options, second)) {
            Some(curve) => diagram.creases.push(Crease { what: special.what, from: k, curve: Curve { of, ..curve } }),
            None => diagram.lone.push(k),
        }
    }
    zeros.hold(second.here);
}

/// The curve through a special point, in both directions; none where it has no direction there.
fn one(zeros: &mut dyn Zeros, special: &Special, (options, second): (&Options<'_>, Second)) -> Option<Curve> {
    let range = second.to - second.from;
    let ranges = [[options.from, options.to], [second.from, second.to]];
    let bounds = Bounds { ranges: &ranges, points: options.points, interrupt: options.interrupt, first: FIRST };
    let mut y = special.place.y.clone();
    y.push(second.here);
    let last = y.len() - 1;
    let mut whole: Option<Curve> = None;
    for sign in [-1.0, 1.0] {
        if whole.as_ref().is_some_and(|c| c.ends[0] == Some(End::Closed)) {
            continue;
        }
        let mut turning = Turning::new(zeros, special.what, range);
        let direction: Vec<f64> = (0..=last).map(|i| if i == last { sign * range } else { 0.0 }).collect();
        let start = corrector::place(&mut turning, y.clone(), &direction).ok().flatten()?;
        let mut curve = walk(&mut turning, start, bounds, &|point| special.what != What::Fold && meets(point.what));
        as_one(&mut curve, &ranges);
        if let (Some(End::Joins), Some((_, point))) = (&curve.ends[1], curve.special.last()) {
            let (what, place) = (point.what, point.place.clone());
            if let Some(end) = curve.places.last_mut() {
                *end = place;
            }
            curve.ends[1] = Some(End::Meets(what));
        }
        for (_, point) in &mut curve.special {
            point.what = named(point, special.what);
        }
        whole = Some(match whole {
            None => Curve { ends: [None, curve.ends[1].clone()], ..curve }.turned(),
            Some(before) => before.then(curve),
        });
    }
    whole
}

/// Keeps one event where the second parameter is extreme just where both of a pair become real, as it is where no place of rest is left beyond: the other is the same point, and rounding apart.
fn as_one(curve: &mut Curve, ranges: &[[f64; 2]; 2]) {
    let met: Vec<[f64; 2]> =
        curve.special.iter().filter(|(_, point)| meets(point.what)).map(|(_, point)| Crease::plane(&point.place)).collect();
    let same = |at: [f64; 2], other: &[f64; 2]| (0..2).all(|i| (at[i] - other[i]).abs() <= SAME * (ranges[i][1] - ranges[i][0]).abs());
    curve.special.retain(|(_, point)| point.what != What::Fold || !met.iter().any(|other| same(Crease::plane(&point.place), other)));
}

/// Whether both of a pair become real there: beyond it the curve is one of saddles.
fn meets(what: What) -> bool {
    matches!(what, What::BogdanovTakens | What::Resonance(1 | 2))
}

/// What a special point of a curve is.
fn named(point: &Special, of: What) -> What {
    let place = &point.place;
    let first = place.y.len() - 2;
    let moves = (place.tangent[first] / place.local.scales[first]).abs() / place.dot(&place.tangent, &place.tangent).sqrt();
    match point.what {
        What::Fold if of == What::Fold && moves <= RESTS => What::Cusp,
        What::Fold => What::Turn,
        other => other,
    }
}

/// Whether a curve passes through a special point of the diagram, which has the second parameter of the diagram.
fn passes(crease: &Crease, special: &Special, second: Second) -> bool {
    let level = |place: &Place| Crease::plane(place)[1] - second.here;
    let range = special.place.local.scales.last().copied().unwrap_or(1.0);
    crease.curve.places.windows(2).any(|pair| {
        let (a, b) = (&pair[0], &pair[1]);
        if level(a) * level(b) > 0.0 {
            return false;
        }
        let way: Vec<f64> = b.y.iter().zip(&a.y).map(|(b, a)| b - a).collect();
        let length = a.dot(&way, &way).sqrt();
        let last = a.y.len() - 1;
        let cubic = |s: f64, i: usize| {
            let [u, v] = [a, b].map(|place| length * place.tangent[i] / place.dot(&place.tangent, &place.tangent).sqrt());
            (1.0 + 2.0 * s) * (1.0 - s) * (1.0 - s) * a.y[i] + s * s * (3.0 - 2.0 * s) * b.y[i] + s * (1.0 - s) * ((1.0 - s) * u - s * v)
        };
        let (mut low, mut high) = (0.0, 1.0);
        let rises = level(a) < 0.0 || level(b) > 0.0;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if (cubic(middle, last) < second.here) == rises { low = middle } else { high = middle }
        }
        let share = 0.5 * (low + high);
        let alike = |((u, v), w): ((&[f64; 2], &[f64; 2]), &[f64; 2])| {
            (0..2).all(|end| {
                (u[end] + share * (v[end] - u[end]) - w[end]).abs() <= ALIKE * (w[1] - w[0]).abs().max(w[0].abs()).max(w[1].abs())
            })
        };
        let mut extremes = a.local.facts.extremes.iter().zip(&b.local.facts.extremes).zip(&special.place.local.facts.extremes);
        (cubic(share, last - 1) - special.place.parameter()).abs() <= SAME * range && extremes.all(alike)
    })
}
