//! What conditions on rates keep: the places that their integral from another state of the same motion gives.
//!
//! A gear, a belt, rolling in the plane, a prescribed rate: Σ J_j(q, t) q_j' + r(q, t) = 0 is the derivative of something that has not changed since the machine was assembled,
//!
//! ```text
//! c(q, t) = ∫ (Σ J_j (q_j - q₀_j) + r (t - t₀)) ds = 0     along the straight way from (q₀, t₀) to (q, t), s = 0 ... 1
//! ```
//!
//! Whoever looks for another motion of the same machine has to keep it: wheels mounted otherwise are another machine. A condition that is the derivative of nothing (a skate, a ball)
//! keeps nothing. Which it is, the integral around triangles tells.

use program::{Evaluator, Point};

use super::switches::Switches;
use crate::Fault;
use crate::connections::way;
use algebra::random::Random;

/// Integral around a triangle, relative to its terms, that counts as none: quadrature leaves some units of the last place of terms that cancel.
const CLOSED: f64 = 1e-9;
/// Triangles that are gone around.
const TRIANGLES: usize = 3;
/// How far from a state corners of triangles lie: radians, seconds, shares of a length.
const BESIDE: f64 = 0.3;

/// Time and coordinates.
pub(super) type Instant = (f64, Vec<f64>);

/// Conditions on rates that are derivatives, and the state from which they are counted.
#[derive(Clone, Debug, Default)]
pub(super) struct Kept {
    /// By row; unknown until asked for.
    pub(super) forms: Option<Vec<Form>>,
    /// Time and coordinates of a state that keeps them; none while they are not counted.
    pub(super) from: Option<Instant>,
    /// c of each row at the last state.
    pub(super) places: Vec<f64>,
}

/// What a row keeps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Form {
    /// Its place stands in the equations, or it keeps none.
    None,
    /// Σ J_j q_j with constant J, and a function of time.
    Constant,
    /// A place that only its integral gives.
    Integral,
}

/// The numbers of rows at an instant without motion.
pub(super) struct Rows<'a> {
    pub(super) evaluator: &'a mut Evaluator,
    pub(super) sides: &'a Switches,
    /// J of the first condition, r of the first, condition by condition.
    pub(super) at: [usize; 2],
    pub(super) n: usize,
}

impl Rows<'_> {
    /// J of one condition, then r.
    pub(super) fn of(&mut self, condition: usize, (t, q): (f64, &[f64])) -> Result<(Vec<f64>, f64), Fault> {
        let mut x = q.to_vec();
        x.resize(2 * self.n, 0.0);
        let point = Point { time: t, states: &x, modes: Some(&self.sides.modes), active: Some(&self.sides.active), ..Point::default() };
        let values = self.evaluator.evaluate(&point)?;
        let first = self.at[0] + condition * self.n;
        Ok((values[first..first + self.n].to_vec(), values[self.at[1] + condition]))
    }

    /// c along a straight way, and the size of its terms.
    pub(super) fn along(&mut self, condition: usize, (from, to): (&Instant, &Instant)) -> Result<(f64, f64), Fault> {
        let (time, way) = (to.0 - from.0, to.1.iter().zip(&from.1).map(|(a, b)| a - b).collect::<Vec<f64>>());
        if time == 0.0 && way.iter().all(|d| *d == 0.0) {
            return Ok((0.0, 0.0));
        }
        let found = way::integrals(to.0, |s| {
            let at: Vec<f64> = from.1.iter().zip(&way).map(|(a, d)| a + s * d).collect();
            let (levers, rest) = self.of(condition, (from.0 + s * time, &at))?;
            Ok(vec![way::sum(levers.iter().zip(&way).map(|(j, d)| j * d).chain([rest * time]))])
        })?;
        Ok((found[0][0], found[0][1]))
    }

    /// What a condition keeps, by its numbers around an instant.
    ///
    /// *Errors*: a formula without a value there.
    pub(super) fn form(&mut self, condition: usize, base: &Instant) -> Result<Form, Fault> {
        let mut random = Random::new(43);
        let mut beside = || -> Instant {
            let near = |v: &f64| v + BESIDE * random.between(-1.0, 1.0) * v.abs().max(1.0);
            let corner: Vec<f64> = base.1.iter().map(near).collect();
            (base.0 + BESIDE * random.between(-1.0, 1.0), corner)
        };
        let (levers, rest) = self.of(condition, (base.0, &base.1))?;
        let (mut constant, mut looks) = (true, Looks { closed: 0, open: 0 });
        for _ in 0..TRIANGLES {
            let corners = [base.clone(), beside(), beside()];
            // a formula may have no value beside the state
            let Ok((there, _)) = self.of(condition, (corners[1].0, &corners[1].1)) else { continue };
            let Ok((_, other)) = self.of(condition, (base.0, &corners[1].1)) else { continue };
            constant &= there == levers && other == rest;
            if constant {
                continue;
            }
            let sides = (0..3).map(|k| self.along(condition, (&corners[k], &corners[(k + 1) % 3]))).collect::<Result<Vec<_>, _>>();
            let Ok(sides) = sides else { continue };
            let (sum, terms) = sides.iter().fold((0.0, 0.0), |(sum, terms), (s, t)| (sum + s, terms + t));
            if f64::abs(sum) <= CLOSED * terms { looks.closed += 1 } else { looks.open += 1 }
        }
        Ok(match (constant, looks) {
            (true, _) => Form::Constant,
            (false, Looks { open: 0, closed: 1.. }) => Form::Integral,
            (false, _) => Form::None,
        })
    }
}

/// Triangles around which a condition gains nothing, and something.
struct Looks {
    closed: usize,
    open: usize,
}
