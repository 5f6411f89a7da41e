//! Branches that part from others.
//!
//! ```text
//! branch point         | J  | v = 0       v beside the tangent t: y = y* ± ε v + ...
//!                      | t' |
//! period doubling      (Φ + 1) v = 0       x = x* + ε v over two periods
//! Hopf point           A v = i ω v         x = x* + ε Re v, T = 2π/ω
//! grazing              J' v = 0            v of the equations on the other side of the switch that is touched
//! ```
//!
//! The first point of a new branch is sought in the plane y = y* + ε v + ..., across v, with derivatives taken at its guess: at the point itself they say nothing.

use super::corrector::{self, Plane, correct};
use super::crease;
use super::curve::{Curve, Of};
use super::diagram::{Diagram, Options, followed};
use super::locate::{Special, What};
use super::neutral::Even;
use super::orbits::{By, Orbits};
use super::touching;
use super::zeros::{Family, Place, Sort, Zeros};
use crate::studies::periodic::{Periodic, Shooting};
use crate::{Fault, System};
use algebra::complex::Complex;
use algebra::eigen::general;
use algebra::lu::Lu;
use algebra::vectors::norm;
use std::f64::consts::TAU;
use words::{Message, Text};

/// How far from a special point the first point of a new branch is sought, in scales.
const AWAY: [f64; 5] = [1e-2, 3e-3, 3e-2, 1e-3, 1e-4];
/// The same where several branches part: beside such a point the square of the distance is rounding.
const CLEAR: [f64; 5] = [1e-2, 3e-2, 0.1, 0.3, 1.0];
/// The first point may lie this share of its distance from its guess.
const BESIDE: f64 = 1.0;
/// It must be away from the known branch by this share of what its guess is.
const BESIDE_OLD: f64 = 0.3;
/// Most periods of a motion that is followed: cascades of doublings go on without end, and their turns are sensitive by the product of all.
const DEEPEST: usize = 4;
/// Cosine of the angle below which two directions of parting branches are one: a sixth of that between those that are looked in.
const ALIKE: f64 = 0.998;
/// A component of a unit vector below this is rounding of the interpolation at a branch point.
const NONE: f64 = 1e-6;

/// Follows the branches that part at branch points of a set of branches, from the k-th special point on.
pub(super) fn at_branch_points(zeros: &mut dyn Zeros, mut k: usize, options: &Options<'_>, diagram: &mut Diagram) {
    while k < diagram.special.len() && !options.is_interrupted() {
        let (which, _, special) = diagram.special[k].clone();
        if special.what == What::Branch {
            let of = diagram.curves[which].of;
            both_ways(zeros, (k, &special), of, (options, diagram));
        }
        k += 1;
    }
}

/// Follows the branches that part from periodic motions, from the k-th special point on.
///
/// *Errors*: those of eigenvalues.
pub(super) fn of_orbits(orbits: &mut Orbits<'_, '_>, mut k: usize, options: &Options<'_>, diagram: &mut Diagram) {
    while k < diagram.special.len() && !options.is_interrupted() {
        let (which, behind, special) = diagram.special[k].clone();
        let Of::Orbits(periods) = diagram.curves[which].of else {
            k += 1;
            continue;
        };
        orbits.repeat(periods);
        match special.what {
            // located by collocation: shooting has no equations there
            What::Branch | What::Doubling if special.place.local.jacobian.is_empty() => diagram.unmet += 1,
            What::Branch => both_ways(orbits, (k, &special), Of::Orbits(periods), (options, diagram)),
            What::Grazing if diagram.curves[which].grazes_at(behind) => {
                if let Some(v) = other_side(orbits, &special) {
                    part(orbits, (k, &special), &[v.clone(), turned(&v, -1.0)], Of::Orbits(periods), (options, diagram));
                }
            }
            What::Doubling if 2 * periods.max(1) > DEEPEST => diagram.deeper += 1,
            What::Doubling => {
                let mut doubled = special.clone();
                let n = orbits.shooting.scales().len();
                if periods == 0 {
                    doubled.place.y[n] *= 2.0;
                }
                orbits.returns = 2 * periods.max(1);
                // the other direction is the same motion a period later; a branch that has come here is the one that parts here
                let v = flipped(&special.place).filter(|_| diagram.joined.iter().all(|(other, _)| *other != k));
                if let Some(v) = v {
                    part(orbits, (k, &doubled), &[v], Of::Orbits(2 * periods), (options, diagram));
                }
            }
            _ => {}
        }
        k += 1;
    }
}

/// Periodic motions that part from places of rest at the Hopf points among the special points up to `count`.
pub(super) fn from_rest(family: &mut dyn Family, count: usize, options: &Options<'_>, diagram: &mut Diagram) -> Result<(), Fault> {
    for k in 0..count {
        let (which, behind, special) = diagram.special[k].clone();
        if special.what != What::Hopf || options.is_interrupted() {
            continue;
        }
        if diagram.curves[which].places.get(behind).is_some_and(|place| place.signs.paired) {
            diagram.families += 1;
            continue;
        }
        if diagram.curves.len() >= options.branches {
            diagram.left_out += 1;
            continue;
        }
        let last = special.place.y.len() - 1;
        let x = &special.place.y[..last];
        let (machine, _) = family.at(special.place.y[last])?;
        let Some((shapes, omega)) = oscillating(machine, x, &special.place)? else { continue };
        let period = TAU / omega;
        let scales = special.place.local.scales[..last].to_vec();
        let periodic = Periodic { tolerance: 1e-13, ..Periodic::default() }; // turns are differentiated: they are followed more closely than they are shown
        let shooting = Shooting::beside(machine, x, (&scales, period), &periodic)?;
        let first = diagram.special.len();
        let mut orbits =
            Orbits { family: &mut *family, shooting, returns: 1, range: options.to - options.from, work: [0; 2], by: By::default() };
        let mut there = special.clone();
        there.place.y = x.iter().copied().chain([period, special.place.y[last]]).collect();
        there.place.local.scales = scales.iter().copied().chain([period, options.to - options.from]).collect();
        let directions: Vec<Vec<f64>> = shapes.into_iter().map(|v| v.into_iter().chain([0.0, 0.0]).collect()).collect();
        match directions.as_slice() {
            [_] => part(&mut orbits, (k, &there), &directions, Of::Orbits(0), (options, diagram)),
            _ => at_once(&mut orbits, (k, &there), &directions, Of::Orbits(0), (options, diagram)),
        }
        of_orbits(&mut orbits, first, options, diagram);
        crease::follow(&mut orbits, first, (options, diagram));
        let [turns, variations] = orbits.turns();
        diagram.work.turns += turns;
        diagram.work.variations += variations;
    }
    Ok(())
}

fn turned(v: &[f64], sign: f64) -> Vec<f64> {
    v.iter().map(|v| sign * v).collect()
}

/// Both directions of the branch that crosses at a branch point, but those from which a known branch has come.
fn both_ways(zeros: &mut dyn Zeros, (k, special): (usize, &Special), of: Of, (options, diagram): (&Options<'_>, &mut Diagram)) {
    let several = special.place.parting(zeros.sort());
    if !several.is_empty() {
        return at_once(zeros, (k, special), &several, of, (options, diagram));
    }
    let ways = across(&special.place);
    for sign in [1.0, -1.0] {
        let ways: Vec<Vec<f64>> = ways.iter().map(|v| turned(v, sign)).collect();
        let came = |(other, from): &(usize, Vec<f64>)| *other == k && ways.first().is_some_and(|v| special.place.dot(v, from) > 0.0);
        if !diagram.joined.iter().any(came) {
            part(zeros, (k, special), &ways, of, (options, diagram));
        }
    }
}

/// Follows a branch that parts in one of these directions (SI, of unit length in scales); nothing where there is none.
fn part(
    zeros: &mut dyn Zeros,
    (k, special): (usize, &Special),
    ways: &[Vec<f64>],
    of: Of,
    (options, diagram): (&Options<'_>, &mut Diagram),
) {
    if diagram.curves.len() >= options.branches {
        diagram.left_out += 1;
        return;
    }
    let tries = ways.iter().flat_map(|v| AWAY.map(|away| (v, away)));
    let start = tries.into_iter().find_map(|(v, away)| first(zeros, special, v, away).ok().flatten().map(|start| (v, start)));
    // so near that more than the machine's own symmetry changes nothing: farther on
    let start = start.map(|(v, start)| match start.signs.neutral {
        0 => start,
        n => clear_of(zeros, special, v).filter(|other| other.signs.neutral < n).unwrap_or(start),
    });
    let Some(start) = start else {
        diagram.unmet += 1;
        return;
    };
    let curve = followed(zeros, start, options, diagram);
    let kept = Curve { parent: Some(k), of, ..curve };
    diagram.take(kept);
}

/// Follows the branches that part where several directions vanish at once, each once: of those that a symmetry turns into one another all along, one.
fn at_once(
    zeros: &mut dyn Zeros,
    (k, special): (usize, &Special),
    ways: &[Vec<f64>],
    of: Of,
    (options, diagram): (&Options<'_>, &mut Diagram),
) {
    let mut begun: Vec<Place> = Vec::new();
    let came: Vec<Vec<f64>> = diagram.joined.iter().filter(|(other, _)| *other == k).map(|(_, from)| from.clone()).collect();
    let origin = &special.place;
    let leaves = |start: &Place| -> Vec<f64> { start.y.iter().zip(&origin.y).map(|(y, o)| y - o).collect() };
    let alike = |a: &[f64], b: &[f64]| origin.dot(a, b) > ALIKE * (origin.dot(a, a) * origin.dot(b, b)).sqrt();
    for v in ways {
        if came.iter().any(|from| alike(from, v)) {
            continue;
        }
        let Some(start) = clear_of(zeros, special, v) else { continue };
        let image = |other: &Place| {
            let (a, b) = (&other.signs, &start.signs);
            let turned = a.neutral > 0 && a.neutral == b.neutral && a.outside == b.outside;
            turned || alike(&leaves(other), &leaves(&start))
        };
        if begun.iter().any(image) {
            continue;
        }
        if diagram.curves.len() >= options.branches {
            diagram.left_out += 1;
            continue;
        }
        begun.push(start.clone());
        let curve = followed(zeros, start, options, diagram);
        diagram.take(Curve { parent: Some(k), of, ..curve });
    }
    diagram.unmet += usize::from(begun.is_empty() && came.is_empty());
}

/// The first point of a branch beside a special point in a direction (SI, of unit length in scales), at whichever distance there is one.
pub(super) fn first_of(zeros: &mut dyn Zeros, special: &Special, v: &[f64]) -> Option<Place> {
    AWAY.into_iter().find_map(|away| first(zeros, special, v, away).ok().flatten())
}

/// The same where several directions vanish at once: so far that no more of them are rounding than farther on.
fn clear_of(zeros: &mut dyn Zeros, special: &Special, v: &[f64]) -> Option<Place> {
    let found: Vec<Place> =
        CLEAR.into_iter().filter_map(|away| first(zeros, special, v, away).ok().flatten()).filter(Place::lies).collect();
    let least = found.iter().map(|place| place.signs.neutral).min()?;
    found.into_iter().find(|place| place.signs.neutral == least)
}

/// The first point of a branch in a direction; none where corrections lead elsewhere, or back to the branch that is known.
fn first(zeros: &mut dyn Zeros, special: &Special, v: &[f64], away: f64) -> Result<Option<Place>, Fault> {
    let origin = &special.place;
    let guess: Vec<f64> = origin.y.iter().zip(v).map(|(y, v)| y + away * v).collect();
    let near = zeros.local(&guess)?;
    let Some(found) = correct(zeros, &near, &guess, &Plane { through: &guess, normal: v })? else { return Ok(None) };
    let between = |a: &[f64], b: &[f64]| -> Vec<f64> { a.iter().zip(b).map(|(a, b)| a - b).collect() };
    let off = between(&found.y, &guess);
    let beside = |y: &[f64]| {
        let way = between(y, &origin.y);
        let along = origin.dot(&way, &origin.tangent) / origin.dot(&origin.tangent, &origin.tangent);
        let rest: Vec<f64> = way.iter().zip(&origin.tangent).map(|(w, t)| w - along * t).collect();
        origin.dot(&rest, &rest).sqrt()
    };
    let same = special.what == What::Branch && beside(&found.y) < BESIDE_OLD * beside(&guess);
    if origin.dot(&off, &off).sqrt() > BESIDE * away || same {
        return Ok(None);
    }
    let found = corrector::place(zeros, found.y, v)?;
    Ok(found.filter(|found| special.what != What::Grazing || found.local.facts.switches != origin.local.facts.switches))
}

/// The direction of the branch on the other side of a switch that is touched, of unit length in scales; none where there is no motion.
fn other_side(zeros: &mut dyn Zeros, special: &Special) -> Option<Vec<f64>> {
    let origin = &special.place;
    // a motion that has just ceased to strike may still strike ahead of the branch: beside the parameter it does not
    let ways = touching::beside(origin);
    let tries = ways.iter().flat_map(|way| AWAY.into_iter().flat_map(move |away| [(way, away), (way, -away)]));
    tries.into_iter().find_map(|(way, away)| {
        let y: Vec<f64> = origin.y.iter().zip(way).map(|(y, t)| y + away * t).collect();
        let local = zeros.local(&y).ok().filter(|local| local.facts.switches != origin.local.facts.switches)?;
        corrector::on(local, y, way, zeros).map(|place| place.tangent)
    })
}

/// A solution of A v = r of unit length: of an all but singular A the direction that it takes away.
pub(super) fn null(matrix: &[f64], n: usize) -> Option<Vec<f64>> {
    // a right side that no symmetry of a machine knows
    let right: Vec<f64> = (0..n).map(|i| 1.0 + 0.37 * i as f64).collect();
    let once = match Lu::exact(matrix, n) {
        Some(lu) => lu.solve(&right)?,
        None => Lu::new(matrix, n).null_direction()?,
    };
    let length = norm(&once);
    (length > 0.0 && length.is_finite()).then(|| once.iter().map(|v| v / length).collect())
}

/// Local directions as a change of all unknowns.
fn spread(place: &Place, c: &[f64]) -> Vec<f64> {
    let mut v = vec![0.0; place.y.len()];
    for (c, column) in c.iter().zip(&place.local.basis) {
        v.iter_mut().zip(column).zip(&place.local.scales).for_each(|((v, b), s)| *v += c * b * s);
    }
    v
}

/// Directions at a branch point, across the branch: that along which the parameter rests (the branches of a symmetric machine part so), and that at right angles
/// to the branch.
fn across(place: &Place) -> Vec<Vec<f64>> {
    match null(&place.bordered(), place.local.basis.len()) {
        Some(c) => place.beside(spread(place, &c)),
        None => Vec::new(),
    }
}

impl Place {
    /// Directions in which several branches may part at once.
    fn parting(&self, sort: Sort) -> Vec<Vec<f64>> {
        let found = Even::new(&self.bordered(), &self.local, sort).parting();
        found.iter().filter_map(|c| self.beside(spread(self, c)).into_iter().next()).collect()
    }

    /// A direction beside the branch: with the parameter at rest, and at right angles to the branch.
    fn beside(&self, mut v: Vec<f64>) -> Vec<Vec<f64>> {
        let place = self;
        let without = |v: &mut [f64], amount: f64| v.iter_mut().zip(&place.tangent).for_each(|(v, t)| *v -= amount * t);
        let along = place.dot(&v, &place.tangent) / place.dot(&place.tangent, &place.tangent);
        without(&mut v, along);
        let last = v.len() - 1;
        let mut level = v.clone();
        let moves = (place.tangent[last] / place.local.scales[last]).abs() > NONE;
        if moves {
            without(&mut level, v[last] / place.tangent[last]);
            level[last] = 0.0;
        }
        let unit = |v: Vec<f64>| {
            let length = place.dot(&v, &v).sqrt();
            (length > 0.0 && length.is_finite()).then(|| v.iter().map(|v| v / length).collect::<Vec<f64>>())
        };
        [Some(level).filter(|_| moves), Some(v)].into_iter().flatten().filter_map(unit).collect()
    }
}

/// The direction that a turn reverses.
fn flipped(place: &Place) -> Option<Vec<f64>> {
    let (k, columns) = (place.local.states.len(), place.local.basis.len());
    let matrix: Vec<f64> =
        (0..k * k).map(|e| place.local.jacobian[e / k * columns + e % k] + if e / k == e % k { 2.0 } else { 0.0 }).collect();
    let c = null(&matrix, k)?;
    let v = spread(place, &c);
    let length = place.dot(&v, &v).sqrt();
    (length > 0.0).then(|| v.iter().map(|v| v / length).collect())
}

/// Real parts of roots that leave the axis together, as a share of their size: a double root is known to the root of a rounding.
const TOGETHER: f64 = 1e-6;

/// Shapes of one frequency, rad/s.
type Oscillations = (Vec<Vec<f64>>, f64);

/// Shapes and frequency of the oscillation that neither grows nor decays; where several do at once also their sums, in phase and a quarter of a period apart.
fn oscillating(machine: &mut crate::Machine, x: &[f64], place: &Place) -> Result<Option<Oscillations>, Fault> {
    let n = x.len();
    let modes = machine.modes_by_value(0.0, x).unwrap_or_default();
    let mut rows = Vec::new();
    machine.slopes(0.0, x, &modes, &mut rows)?;
    let scales = &place.local.scales;
    let matrix: Vec<f64> = (0..n * n).map(|e| rows[e / n * (n + 1) + e % n] * scales[e % n] / scales[e / n]).collect();
    let found = general(n, &matrix)?;
    let off = |j: &usize| (found.values[*j].re / found.values[*j].im).abs();
    let mut pairs: Vec<usize> = (0..n).filter(|j| found.values[*j].im > 0.0).collect();
    pairs.sort_by(|a, b| off(a).total_cmp(&off(b)));
    let Some(&nearest) = pairs.first() else { return Ok(None) };
    let omega = found.values[nearest].im;
    let one = |j: &usize| *j == nearest || off(j) <= TOGETHER && (found.values[*j].im - omega).abs() <= TOGETHER * omega;
    let shapes: Vec<Vec<Complex>> = pairs.iter().filter(|j| one(j)).map(|j| found.vector(*j).to_vec()).collect();
    let mut sums: Vec<Vec<Complex>> = shapes.clone();
    for (i, a) in shapes.iter().enumerate() {
        for b in &shapes[i + 1..] {
            for (re, im) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
                sums.push(a.iter().zip(b).map(|(a, b)| *a + *b * Complex { re, im }).collect());
            }
        }
    }
    let unit = |z: &Vec<Complex>| {
        let v: Vec<f64> = z.iter().zip(scales).map(|(z, s)| z.re * s).collect();
        let length = v.iter().zip(scales).map(|(v, s)| (v / s) * (v / s)).sum::<f64>().sqrt();
        (length > 0.0).then(|| v.iter().map(|v| v / length).collect::<Vec<f64>>())
    };
    let shapes: Vec<Vec<f64>> = sums.iter().filter_map(unit).collect();
    Ok((!shapes.is_empty()).then_some((shapes, omega)))
}

/// The motion repeats only in a frame that moves.
pub(super) fn drifts() -> Fault {
    Fault::new(Message {
        code: "S151",
        what: Text::new(
            "the motion repeats only in a frame that moves along with it, and cannot be followed over a parameter",
            "движение повторяется лишь в подвижной системе отсчёта и не прослеживается по параметру",
        ),
        why: Text::new(
            "a coordinate runs on with a speed that is part of the motion",
            "одна из координат растёт со скоростью, которая сама определяется движением",
        ),
        help: Text::new(
            "describe the motion by coordinates that come back, relative to what runs",
            "опишите движение координатами, которые возвращаются, — относительно того, что движется равномерно",
        ),
    })
}

/// The branch has no direction at its start.
pub(super) fn no_direction() -> Fault {
    Fault::new(Message {
        code: "S152",
        what: Text::new("the branch has no direction where it begins", "ветвь не имеет направления в начальной точке"),
        why: Text::new(
            "neighbouring motions close there as well: a machine without damping, or a fold or branch point at the very start",
            "соседние движения там тоже замыкаются: в машине нет сопротивления или ветвь начинается в точке поворота либо ветвления",
        ),
        help: Text::new(
            "begin at another value of the parameter, or give the machine some damping",
            "начните с другого значения параметра или введите сопротивление",
        ),
    })
}
