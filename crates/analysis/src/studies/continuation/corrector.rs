//! From a guess to a point of the branch in a plane across it: Newton's method with the derivatives of a point nearby, which learns from its steps.
//!
//! ```text
//! | J      |       | R(y)        |
//! | n' B   | d = - | n·(y - y0)  |,      J <- J + R(y + B d) d'/(d'd)
//! ```
//!
//! *Source*: C. G. Broyden, Mathematics of Computation 19 (1965) 577-593.

use super::neutral::Even;
use super::zeros::{Local, Place, Signs, Zeros};
use crate::Fault;
use algebra::vectors::norm;

/// Behind a step below this, in scales, is a point: steps fall by some three digits each, and the point is held against Newton's own correction afterwards.
const ENOUGH: f64 = 1e-10;
/// What is small beside the scales goes on to that share of the motion's own sizes, as long as corrections fall by this: then they are rounding.
const FALLS: f64 = 0.5;
/// Steps above this are those that tell how far the guess was.
const TELLING: f64 = 1e-7;
/// Where steps end to fall, a point is known to this.
const ROUGH: f64 = 1e-9;
/// A correction that grows by this is none.
const AWAY: f64 = 2.0;
/// Corrections of a point.
const MOST: usize = 12;
/// A last correction below this is rounding of turns, amplified by what the branch is sensitive to.
const ROUNDED: f64 = 1e-10;
/// A last correction above this shows that the derivatives mean nothing there.
const FAR: f64 = 1e-3;
/// Last corrections of a point.
const POLISHED: usize = 3;

/// A plane across a branch.
pub(super) struct Plane<'a> {
    /// A point of it.
    pub(super) through: &'a [f64],
    /// Its normal, SI.
    pub(super) normal: &'a [f64],
}

/// A point of the branch, and how much it took.
pub(super) struct Corrected {
    pub(super) y: Vec<f64>,
    /// Corrections that were more than a polish.
    pub(super) steps: usize,
}

/// The point of the branch in a plane; none where the corrections do not settle.
///
/// *Errors*: those of the equations.
pub(super) fn correct(zeros: &mut dyn Zeros, near: &Local, guess: &[f64], plane: &Plane<'_>) -> Result<Option<Corrected>, Fault> {
    let (m, mut jacobian) = (near.rows(), near.jacobian.clone());
    let k = m + 1;
    let inner = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).zip(&near.scales).map(|((a, b), s)| a / s * (b / s)).sum() };
    let in_scales = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).zip(&near.scales).map(|((a, b), s)| a / s * b).sum() };
    let row: Vec<f64> = near.basis.iter().map(|column| in_scales(plane.normal, column)).collect();
    let mut y = guess.to_vec();
    let mut residual = zeros.residual(&y, near)?;
    let (mut last, mut before, mut steps) = (f64::INFINITY, f64::INFINITY, 0);
    for _ in 0..MOST {
        let mut matrix = jacobian.clone();
        matrix.extend(&row);
        let off: Vec<f64> = y.iter().zip(plane.through).map(|(a, b)| a - b).collect();
        let right: Vec<f64> = residual.iter().map(|r| -r).chain([-inner(plane.normal, &off)]).collect();
        let Some(change) = Even::new(&matrix, near, zeros.sort()).solve(&right) else { return Ok(None) };
        let size = norm(&change);
        if !size.is_finite() || size > AWAY * last {
            return Ok((last <= ROUGH).then_some(Corrected { y, steps }));
        }
        if size >= last && last <= ROUGH {
            return Ok(Some(Corrected { y, steps }));
        }
        steps += usize::from(size > TELLING);
        y = zeros.moved(&y, &change, near)?;
        let own = near.change(&change);
        if size <= ENOUGH && (own <= ENOUGH || own >= FALLS * before) {
            return Ok(Some(Corrected { y, steps }));
        }
        residual = zeros.residual(&y, near)?;
        let square = size * size;
        for (i, r) in residual.iter().enumerate() {
            (0..k).for_each(|j| jacobian[i * k + j] += r * change[j] / square);
        }
        (last, before) = (size, own);
    }
    Ok((last <= ROUGH).then_some(Corrected { y, steps }))
}

/// The same; where the derivatives nearby lead nowhere, with those at the guess: beyond a branch point the old ones drive away from the branch.
///
/// *Errors*: those of the equations.
pub(super) fn settle(zeros: &mut dyn Zeros, near: &Local, guess: &[f64], plane: &Plane<'_>) -> Result<Option<Corrected>, Fault> {
    if let Some(found) = correct(zeros, near, guess, plane)? {
        return Ok(Some(found));
    }
    let fresh = zeros.local(guess)?;
    correct(zeros, &fresh, guess, plane)
}

/// The point of the branch in the plane through a guess across a direction, with derivatives taken at the guess.
///
/// *Errors*: those of the equations.
pub(super) fn reached(zeros: &mut dyn Zeros, guess: Vec<f64>, direction: &[f64]) -> Result<Option<Place>, Fault> {
    let near = zeros.local(&guess)?;
    let Some(found) = correct(zeros, &near, &guess, &Plane { through: &guess, normal: direction })? else { return Ok(None) };
    place(zeros, found.y, direction)
}

/// The equations at a point with the tangent of the branch, which goes on in a direction. The point is held against Newton's own correction with the derivatives
/// there, and moved by it while that is more than rounding.
///
/// *Errors*: those of the equations.
pub(super) fn place(zeros: &mut dyn Zeros, mut y: Vec<f64>, direction: &[f64]) -> Result<Option<Place>, Fault> {
    let mut local = zeros.local(&y)?;
    let mut before = f64::INFINITY;
    for polish in 0..=POLISHED {
        let mut matrix = local.jacobian.clone();
        matrix.extend(local.basis.iter().map(|c| direction.iter().zip(c).zip(&local.scales).map(|((d, c), s)| d / s * c).sum::<f64>()));
        let right: Vec<f64> = local.residual.iter().map(|r| -r).chain([0.0]).collect();
        let Some(change) = Even::new(&matrix, &local, zeros.sort()).solve(&right) else { break };
        let (size, own) = (norm(&change), local.change(&change));
        let rounded = size <= ROUNDED && own >= FALLS * before;
        local.facts.miss = if rounded { size } else { own };
        before = own;
        // a guess is no point yet, and what cannot be corrected stays what it is: between two pieces of the equations corrections lead to and fro
        if own <= ROUNDED || rounded || !size.is_finite() || size > FAR || polish == POLISHED {
            break;
        }
        y = zeros.moved(&y, &change, &local)?;
        local = zeros.local(&y)?;
    }
    Ok(on(local, y, direction, zeros))
}

/// The same from equations that are known.
pub(super) fn on(local: Local, y: Vec<f64>, direction: &[f64], zeros: &dyn Zeros) -> Option<Place> {
    let k = local.basis.len();
    let along: Vec<f64> =
        local.basis.iter().map(|c| direction.iter().zip(c).zip(&local.scales).map(|((d, c), s)| d / s * c).sum()).collect();
    let mut matrix = local.jacobian.clone();
    matrix.extend(&along);
    let unit: Vec<f64> = (0..k).map(|i| if i + 1 == k { 1.0 } else { 0.0 }).collect();
    let c = Even::new(&matrix, &local, zeros.sort()).solve(&unit)?;
    let mut tangent = vec![0.0; y.len()];
    for (c, column) in c.iter().zip(&local.basis) {
        tangent.iter_mut().zip(column).zip(&local.scales).for_each(|((t, b), s)| *t += c * b * s);
    }
    let mut place = Place { y, tangent, local, signs: Signs::default() };
    let length = place.dot(&place.tangent, &place.tangent).sqrt();
    if !(length > 0.0 && length.is_finite()) {
        return None;
    }
    place.tangent.iter_mut().for_each(|t| *t /= length);
    place.signs = super::signs::at(&place, zeros.sort());
    Some(place)
}
