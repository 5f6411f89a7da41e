//! What conditions on rates keep: the places that their integral from another state of the same motion gives.
//!
//! A gear, a belt, rolling in the plane, a prescribed rate: Σ J_j(q, t) q_j' + r(q, t) = 0 is the derivative of something that has not changed since the machine was assembled,
//!
//! ```text
//! c(q, t) = ∫ (Σ J_j (q_j - q₀_j) + r (t - t₀)) ds = 0     along the straight way from (q₀, t₀) to (q, t), s = 0 ... 1
//! ```
//!
//! Whoever looks for another motion of the same machine has to keep it: wheels mounted otherwise are another machine. So does what rolls on a contact that has not opened since,
//! and what has been sticking since. A condition that is the derivative of nothing (a skate, a ball)
//! keeps nothing. Which it is, the integral around triangles tells. Rolling on a circle in x, y and an angle is the derivative of something only on the circle: there triangles lie
//! on the surface of the conditions on places, and ways, too (`connections::surface`).

use program::{Evaluator, Point};

use super::switches::Switches;
use crate::Fault;
use crate::connections::surface::{Instant, Slopes, Ways};
use crate::connections::way;
use algebra::random::Random;

/// Integral around a triangle, relative to its terms, that counts as none: quadrature leaves some units of the last place of terms that cancel.
const CLOSED: f64 = 1e-9;
/// Triangles that are gone around.
const TRIANGLES: usize = 3;
/// How far from a state corners of triangles lie: radians, seconds, shares of a length.
const BESIDE: f64 = 0.3;
/// Shares of that at which triangles on a surface are tried: a large one may go around a hole of it (a circle is one), and what it gains is a turn then; what a small one
/// gains of a condition that keeps nothing is that share of its terms, far above [`CLOSED`].
const SMALLER: [f64; 4] = [1.0, 0.1, 0.01, 0.001];

/// Conditions on rates that are derivatives, and the state from which they are counted.
#[derive(Clone, Debug, Default)]
pub(super) struct Kept {
    /// By row; unknown until asked for.
    pub(super) forms: Option<Vec<Form>>,
    /// Conditions on places that hold all along.
    pub(super) surface: Vec<usize>,
    /// Contacts and frictions, by guard, whose conditions hold all along.
    pub(super) closed: Vec<usize>,
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
    /// The same along ways on which the conditions on places hold.
    Within,
}

/// The numbers of rows at an instant without motion.
pub(super) struct Rows<'a> {
    pub(super) evaluator: &'a mut Evaluator,
    pub(super) sides: &'a Switches,
    /// J of the first condition, r of the first, place of the first, condition by condition.
    pub(super) at: [usize; 3],
    /// Conditions on places that always hold.
    pub(super) surface: &'a [usize],
    pub(super) n: usize,
}

impl Rows<'_> {
    fn values(&mut self, (t, q): (f64, &[f64])) -> Result<&[f64], Fault> {
        let mut x = q.to_vec();
        x.resize(2 * self.n, 0.0);
        let point = Point { time: t, states: &x, modes: Some(&self.sides.modes), active: Some(&self.sides.active), ..Point::default() };
        Ok(self.evaluator.evaluate(&point)?)
    }

    /// J of one condition, then r.
    pub(super) fn of(&mut self, condition: usize, at: (f64, &[f64])) -> Result<(Vec<f64>, f64), Fault> {
        let (n, [first, rest, _]) = (self.n, self.at);
        let values = self.values(at)?;
        let first = first + condition * n;
        Ok((values[first..first + n].to_vec(), values[rest + condition]))
    }

    /// Along ways on which the conditions on places hold: c, and the size of its terms.
    pub(super) fn within(&mut self, condition: usize, (from, to): (&Instant, &Instant)) -> Result<(f64, f64), Fault> {
        let mut at = |instant: &Instant| self.slopes(condition, instant);
        let found = Ways { at: &mut at }.integrals(from, to)?;
        Ok((found[0][0], found[0][1]))
    }

    fn slopes(&mut self, condition: usize, (t, q): &Instant) -> Result<Slopes, Fault> {
        let (n, [jacobian, rates, places], surface) = (self.n, self.at, self.surface);
        let values = self.values((*t, q))?;
        let row = |c: usize| values[jacobian + c * n..jacobian + (c + 1) * n].to_vec();
        let rows = vec![[row(condition), vec![values[rates + condition]]].concat()];
        let of = |c: &usize| values[places + c];
        Ok(Slopes { rows, places: surface.iter().map(of).collect(), gradients: surface.iter().flat_map(|c| row(*c)).collect() })
    }

    /// Whether a condition gains nothing around triangles on the surface of the conditions on places.
    fn closes_within(&mut self, condition: usize, base: &Instant) -> bool {
        let mut random = Random::new(47);
        SMALLER.iter().filter(|_| !self.surface.is_empty()).any(|share| {
            let mut looks = Looks { closed: 0, open: 0 };
            for _ in 0..TRIANGLES {
                let mut at = |instant: &Instant| self.slopes(condition, instant);
                let mut ways = Ways { at: &mut at };
                let mut corner = || ways.onto(&beside(base, share * BESIDE, &mut random)).map(|(corner, _)| corner);
                let (Ok(second), Ok(third)) = (corner(), corner()) else { continue };
                let corners = [base.clone(), second, third];
                looks.add((0..3).map(|k| self.within(condition, (&corners[k], &corners[(k + 1) % 3]))));
            }
            looks.is_closed()
        })
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
        let (levers, rest) = self.of(condition, (base.0, &base.1))?;
        let (mut constant, mut looks) = (true, Looks { closed: 0, open: 0 });
        for _ in 0..TRIANGLES {
            let corners = [base.clone(), beside(base, BESIDE, &mut random), beside(base, BESIDE, &mut random)];
            // a formula may have no value beside the state
            let Ok((there, _)) = self.of(condition, (corners[1].0, &corners[1].1)) else { continue };
            let Ok((_, other)) = self.of(condition, (base.0, &corners[1].1)) else { continue };
            constant &= there == levers && other == rest;
            if !constant {
                looks.add((0..3).map(|k| self.along(condition, (&corners[k], &corners[(k + 1) % 3]))));
            }
        }
        Ok(match constant {
            true => Form::Constant,
            false if looks.is_closed() => Form::Integral,
            false if self.closes_within(condition, base) => Form::Within,
            false => Form::None,
        })
    }
}

/// An instant beside another.
fn beside((t, q): &Instant, by: f64, random: &mut Random) -> Instant {
    let corner = q.iter().map(|v| v + by * random.between(-1.0, 1.0) * v.abs().max(1.0)).collect();
    (t + by * random.between(-1.0, 1.0), corner)
}

/// Triangles around which a condition gains nothing, and something.
struct Looks {
    closed: usize,
    open: usize,
}

impl Looks {
    /// One more triangle, by c of its sides with the sizes of their terms; one on which a formula has no value says nothing.
    fn add(&mut self, sides: impl Iterator<Item = Result<(f64, f64), Fault>>) {
        let Ok(sides) = sides.collect::<Result<Vec<_>, _>>() else { return };
        let (sum, terms) = sides.iter().fold((0.0, 0.0), |(sum, terms), (s, t)| (sum + s, terms + t));
        if f64::abs(sum) <= CLOSED * terms { self.closed += 1 } else { self.open += 1 }
    }

    fn is_closed(&self) -> bool {
        self.open == 0 && self.closed > 0
    }
}
