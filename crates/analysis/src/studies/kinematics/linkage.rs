//! The conditions of a linkage at a place: how far it is open, the direction in which it is driven, the second derivative along the way.
//!
//! With the driven coordinate s = q_over as the parameter of the way, time t = (s - s_0)/w at the uniform rate w, conditions g(q, t) = 0 with rates
//! J q' + r = 0 and J q'' + γ(q, q', t) = 0, and further driven coordinates q_i = d_i(s):
//!
//! ```text
//! | J | b = | -r/w |      | J | c = | -γ(q, w b, t)/w² |      b = dq/ds, c = d²q/ds²
//! | E |     |  d'  |      | E |     |       d''        |
//! ```
//!
//! Rows and columns are scaled, so that metres and radians can be compared: an angle stands for its arm.

use algebra::elementary;
use std::sync::Arc;

use program::lower::{Drive, LinkageRoots};
use program::{Evaluator, Point};
use symbolic::connections::{Condition, Law};
use symbolic::{Equations, Graph};

use crate::Fault;
use algebra::qr::Qr;
use algebra::random::Random;

/// What is left of a column after the others below this share of itself: so near a singular position rounding costs half of the digits, and the places
/// beside it tell more.
const DEPENDENT: f64 = 1e-5;
/// Positions around the start at which arms are measured.
const AROUND: usize = 6;

/// A place of the linkage: coordinates, then auxiliary states.
pub(super) type Spot = Vec<f64>;

/// d²q/ds², and the derivatives of the auxiliary states by s.
pub(super) type Second = (Vec<f64>, Vec<f64>);

/// The conditions with the drives.
pub(super) struct Linkage<'e> {
    pub(super) equations: &'e Equations,
    evaluator: Evaluator,
    roots: LinkageRoots,
    pub(super) conditions: Vec<&'e Condition>,
    pub(super) n: usize,
    pub(super) over: usize,
    /// Further driven coordinates.
    pub(super) with: Vec<usize>,
    from: f64,
    rate: f64,
    approach: Option<Approach>,
    pub(super) angles: Vec<bool>,
    /// Length by which an angle is compared with a length.
    pub(super) arm: f64,
    /// Largest length that each scaled row has had: in some positions all levers of a condition vanish.
    reach: Vec<f64>,
    values: Vec<f64>,
    x: Vec<f64>,
}

/// The way from the start to the first place, s = 0 ... 1: all driven coordinates move evenly and time stands still.
struct Approach {
    /// Driven coordinates: first and last value.
    ends: Vec<(usize, [f64; 2])>,
}

/// The linear system at a place.
pub(super) struct Rows {
    qr: Qr,
    columns: Vec<f64>,
    scales: Vec<f64>,
    n: usize,
}

/// What follows from a linkage: formulas of the drives, the uniform rate.
pub(super) struct Drives<'d> {
    pub(super) over: usize,
    pub(super) with: Vec<(usize, Drive)>,
    pub(super) graph: &'d Graph,
    pub(super) from: f64,
    pub(super) rate: f64,
}

impl<'e> Linkage<'e> {
    pub(super) fn new(equations: &'e Equations, start: &[f64], drives: &Drives) -> Result<Linkage<'e>, Fault> {
        let lasting = |c: &&Condition| match c.reaction {
            None => true,
            Some(r) => equations.reactions[r].law.holds(),
        };
        let conditions: Vec<&Condition> = equations.conditions.iter().filter(lasting).collect();
        let gaps: Vec<_> = equations.reactions.iter().filter_map(|r| gap(&r.law)).collect();
        let formulas: Vec<Drive> = drives.with.iter().map(|(_, d)| *d).collect();
        let (tape, roots) = program::lower::linkage(equations, drives.graph, &conditions, &formulas, &gaps)?;
        let parameters: Vec<f64> = equations.parameters.iter().map(|p| p.value).collect();
        let mut linkage = Linkage {
            equations,
            evaluator: Evaluator::new(&Arc::new(tape), &parameters)?,
            roots,
            conditions,
            n: equations.coordinates.len(),
            over: drives.over,
            with: drives.with.iter().map(|(i, _)| *i).collect(),
            from: drives.from,
            rate: drives.rate,
            approach: None,
            angles: equations.coordinates.iter().map(|c| c.unit == "rad").collect(),
            arm: 1.0,
            reach: Vec::new(),
            values: Vec::new(),
            x: start.to_vec(),
        };
        linkage.measure(&spot(start, linkage.n))?;
        Ok(linkage)
    }

    /// The largest arm of an angle, or the largest length; the reach of the conditions in positions around the start.
    fn measure(&mut self, at: &Spot) -> Result<(), Fault> {
        self.evaluate(self.from, at, None)?;
        let arms = (0..self.conditions.len()).flat_map(|k| self.row(k).iter().zip(&self.angles).filter(|(_, a)| **a).map(|(j, _)| j.abs()));
        let arm = arms.fold(0.0_f64, f64::max);
        let length = at[..self.n].iter().zip(&self.angles).filter(|(_, a)| !**a).fold(0.0_f64, |m, (q, _)| m.max(q.abs()));
        self.arm = [arm, length].into_iter().find(|l| *l > 0.0).unwrap_or(1.0);
        self.reach = vec![0.0; self.conditions.len()];
        let mut random = Random::new(7);
        for trial in 0..AROUND {
            let mut near = at.clone();
            for i in (0..self.n).filter(|_| trial > 0) {
                near[i] += random.between(-1.0, 1.0) * if self.angles[i] { 1.0 } else { 0.5 * near[i] };
            }
            if self.evaluate(self.from, &near, None).is_ok() {
                self.remember();
            }
        }
        Ok(())
    }

    /// Length of a condition's scaled row.
    fn length(&self, k: usize) -> f64 {
        self.row(k).iter().enumerate().fold(0.0_f64, |l, (i, j)| elementary::hypot(l, j * self.scale(i)))
    }

    fn remember(&mut self) {
        for k in 0..self.conditions.len() {
            let length = self.length(k);
            if length.is_finite() {
                self.reach[k] = self.reach[k].max(length);
            }
        }
    }

    /// Time at s.
    pub(super) fn time(&self, s: f64) -> f64 {
        if self.approach.is_some() { 0.0 } else { (s - self.from) / self.rate }
    }

    /// Evaluates all formulas at s, with the rates w b when `b` is given, else at rest.
    fn evaluate(&mut self, s: f64, at: &Spot, b: Option<&[f64]>) -> Result<(), Fault> {
        let (n, time) = (self.n, self.time(s));
        self.x[..n].copy_from_slice(&at[..n]);
        match b {
            Some(b) => self.x[n..2 * n].iter_mut().zip(b).for_each(|(v, b)| *v = self.rate * b),
            None => self.x[n..2 * n].fill(0.0),
        }
        self.x[2 * n..].copy_from_slice(&at[n..]);
        let values = self.evaluator.evaluate(&Point { time, states: &self.x, ..Point::default() })?;
        self.values.clear();
        self.values.extend_from_slice(values);
        Ok(())
    }

    fn row(&self, k: usize) -> &[f64] {
        let start = self.roots.jacobian.start + k * self.n;
        &self.values[start..start + self.n]
    }

    /// Driven coordinates with value and derivatives at s; the leading one first.
    fn driven(&self, s: f64) -> Vec<(usize, [f64; 3])> {
        let formulas = self.with.iter().enumerate().map(|(k, &i)| {
            let d = &self.values[self.roots.drives.start + 3 * k..][..3];
            (i, [d[0], d[1], d[2]])
        });
        match &self.approach {
            None => [(self.over, [s, 1.0, 0.0])].into_iter().chain(formulas).collect(),
            Some(approach) => approach.ends.iter().map(|&(i, [a, b])| (i, [a + s * (b - a), b - a, 0.0])).collect(),
        }
    }

    /// From here to [`Linkage::arrived`] the drives lead from `start` to the place at `s`.
    pub(super) fn approach(&mut self, start: &Spot, s: f64) -> Result<(), Fault> {
        let mut first = start.clone();
        first[self.over] = s;
        self.evaluate(s, &first, None)?;
        let ends = self.driven(s).into_iter().map(|(i, d)| (i, [start[i], d[0]])).collect();
        self.approach = Some(Approach { ends });
        Ok(())
    }

    /// The first place is reached: the drives follow their formulas.
    pub(super) fn arrived(&mut self) {
        self.approach = None;
    }

    /// How large the terms are that meet in a condition's place: arms times angles of one radian, or the lengths themselves; at least what they are elsewhere, as the
    /// arms of a condition that repeats others may all vanish here.
    fn size(&self, k: usize, at: &Spot) -> f64 {
        let largest = at[..self.n].iter().zip(&self.angles).filter(|(_, a)| !**a).fold(0.0_f64, |m, (q, _)| m.max(q.abs()));
        let terms: f64 = self.row(k).iter().zip(&self.angles).map(|(j, angle)| j.abs() * if *angle { 1.0 } else { largest }).sum();
        terms.max(self.reach[k]).max(f64::MIN_POSITIVE)
    }

    /// Scales of the coordinates: 1 for lengths, 1/arm for angles.
    pub(super) fn scale(&self, i: usize) -> f64 {
        if self.angles[i] { 1.0 } else { self.arm }
    }

    /// The rows of conditions and drives at the place evaluated last, with `extra` columns by row.
    fn rows(&self, driven: &[(usize, [f64; 3])], extra: Option<&[f64]>) -> Rows {
        let (n, m) = (self.n, self.conditions.len());
        let width = n + usize::from(extra.is_some());
        let mut matrix = Vec::with_capacity((m + driven.len()) * width);
        let mut scales = Vec::with_capacity(m + driven.len());
        for k in 0..m + driven.len() {
            let mut row = vec![0.0; width];
            if k < m {
                row.iter_mut().zip(self.row(k)).enumerate().for_each(|(i, (r, j))| *r = j * self.scale(i));
            } else {
                row[driven[k - m].0] = self.scale(driven[k - m].0);
            }
            if let Some(extra) = extra {
                row[n] = extra[k];
            }
            let length = if k < m { self.reach[k].max(self.length(k)) } else { self.scale(driven[k - m].0) };
            let scale = if length > 0.0 { 1.0 / length } else { 1.0 };
            row.iter_mut().for_each(|r| *r *= scale);
            scales.push(scale);
            matrix.extend(row);
        }
        let count = m + driven.len();
        // each column is compared with itself: a wheel geared down a million times is no singular position
        let columns: Vec<f64> = (0..width)
            .map(|i| {
                let length = (0..count).fold(0.0_f64, |l, k| elementary::hypot(l, matrix[k * width + i]));
                if length > 0.0 { 1.0 / length } else { 1.0 }
            })
            .collect();
        (0..count * width).for_each(|k| matrix[k] *= columns[k % width]);
        let columns = columns.iter().enumerate().map(|(i, c)| if i < n { c * self.scale(i) } else { *c }).collect();
        Rows { qr: Qr::alike(&matrix, count, width, DEPENDENT), columns, scales, n: width }
    }

    /// Newton's step that closes the linkage at s: change of the coordinates, largest relative gap before it. None in a singular position.
    pub(super) fn closing(&mut self, s: f64, at: &Spot) -> Result<Option<(Vec<f64>, f64)>, Fault> {
        let lead = self.with_lead(s, at);
        self.evaluate(s, &lead, None)?;
        let driven = self.driven(s);
        let rows = self.rows(&driven, None);
        let gaps = self.gaps_of_places(at);
        let off = driven.iter().map(|(i, d)| d[0] - at[*i]);
        let right: Vec<f64> = self.values[self.roots.places.clone()].iter().map(|g| -g).chain(off.clone()).collect();
        let worst = driven.iter().zip(off).fold(gaps, |m, ((i, d), off)| m.max(off.abs() / d[0].abs().max(self.scale(*i))));
        Ok(rows.solve(&right).map(|(change, _)| (change, worst)))
    }

    fn gaps_of_places(&self, at: &Spot) -> f64 {
        (0..self.conditions.len()).fold(0.0_f64, |m, k| {
            let place = self.values[self.roots.places.start + k].abs();
            if place == 0.0 { m } else { m.max(place / self.size(k, at)) }
        })
    }

    /// The place with the leading coordinate where the formulas of the drives want it.
    fn with_lead(&self, s: f64, at: &Spot) -> Spot {
        let mut at = at.clone();
        if self.approach.is_none() {
            at[self.over] = s;
        }
        at
    }

    /// b = dq/ds; none in a singular position. The second number is the relative residual of the conditions: above rounding when drives contradict.
    pub(super) fn first(&mut self, s: f64, at: &Spot) -> Result<Option<(Vec<f64>, f64)>, Fault> {
        self.evaluate(s, at, None)?;
        let driven = self.driven(s);
        let rows = self.rows(&driven, None);
        let right = self.rates_wanted(&driven);
        let exactly = |(mut b, residual): (Vec<f64>, f64)| {
            driven.iter().for_each(|(i, d)| b[*i] = d[1]);
            (b, residual)
        };
        Ok(rows.solve(&right).map(exactly))
    }

    fn rates_wanted(&self, driven: &[(usize, [f64; 3])]) -> Vec<f64> {
        let explicit = |r: &f64| if self.approach.is_some() { 0.0 } else { -r / self.rate };
        self.values[self.roots.rates.clone()].iter().map(explicit).chain(driven.iter().map(|d| d.1[1])).collect()
    }

    /// c = d²q/ds² and the derivatives of the auxiliary states by s, for the direction b.
    pub(super) fn second(&mut self, s: f64, at: &Spot, b: &[f64]) -> Result<Option<Second>, Fault> {
        self.evaluate(s, at, Some(b))?;
        let driven = self.driven(s);
        let rows = self.rows(&driven, None);
        let w = self.rate;
        let right: Vec<f64> =
            self.values[self.roots.remainders.clone()].iter().map(|r| -r / (w * w)).chain(driven.iter().map(|d| d.1[2])).collect();
        let still = self.approach.is_some();
        let slow = |r: &f64| if still { 0.0 } else { r / w };
        let auxiliaries = self.values[self.roots.auxiliaries.clone()].iter().map(slow).collect();
        let Some((mut c, _)) = rows.solve(&right) else { return Ok(None) };
        driven.iter().for_each(|(i, d)| c[*i] = d[2]);
        Ok(Some((c, auxiliaries)))
    }

    /// Directions of (q, s) along which the linkage can go.
    pub(super) fn directions(&mut self, s: f64, at: &Spot) -> Result<Vec<Vec<f64>>, Fault> {
        let lead = self.with_lead(s, at);
        self.evaluate(s, &lead, None)?;
        let driven = self.driven(s);
        let extra: Vec<f64> = self.rates_wanted(&driven).iter().map(|r| -r).collect();
        Ok(self.rows(&driven, Some(&extra)).null_space())
    }

    /// Directions of q in which the linkage can move while the drives stand still.
    pub(super) fn freedoms(&mut self, s: f64, at: &Spot) -> Result<Vec<Vec<f64>>, Fault> {
        self.evaluate(s, at, None)?;
        let driven = self.driven(s);
        Ok(self.rows(&driven, None).null_space())
    }

    /// Values of the driven coordinates at s.
    pub(super) fn driven_at(&mut self, s: f64, at: &Spot) -> Result<Vec<(usize, f64)>, Fault> {
        let lead = self.with_lead(s, at);
        self.evaluate(s, &lead, None)?;
        Ok(self.driven(s).into_iter().map(|(i, d)| (i, d[0])).collect())
    }

    /// Derivatives of the auxiliary states by s; zero where they have no value.
    pub(super) fn auxiliary_slopes(&mut self, s: f64, at: &Spot) -> Vec<f64> {
        let slow = if self.approach.is_some() { 0.0 } else { 1.0 / self.rate };
        match self.evaluate(s, at, None) {
            Ok(()) => self.values[self.roots.auxiliaries.clone()].iter().map(|r| r * slow).collect(),
            Err(_) => vec![0.0; at.len() - self.n],
        }
    }

    /// Largest relative violation of places, rates and accelerations of all conditions.
    pub(super) fn violations(&mut self, s: f64, at: &Spot, b: &[f64], c: &[f64]) -> Result<[f64; 3], Fault> {
        let w = self.rate;
        self.evaluate(s, at, Some(b))?;
        let unit = |i: usize| if self.angles[i] { 1.0 } else { self.arm };
        let fastest = |by: &[f64]| by.iter().enumerate().fold(0.0_f64, |m, (i, d)| m.max(d.abs() / unit(i)));
        let (rate, acceleration) = (fastest(b), fastest(c));
        let mut worst = [self.gaps_of_places(at), 0.0, 0.0];
        for k in 0..self.conditions.len() {
            // the condition's arms at the rates of the fastest link: one that stands for an instant has rounding of its own only; one whose arms all vanish
            // here (it repeats others, as the height of a point that circles a pole) has those of other places
            let arms: f64 = self.row(k).iter().enumerate().map(|(i, j)| j.abs() * unit(i)).sum();
            let arms = arms.max(self.reach[k]);
            let off = self.values[self.roots.rates.start + k];
            worst[1] = f64::max(worst[1], share(off, (w * rate).abs() * arms));
            let sum: f64 = self.row(k).iter().zip(c).map(|(j, c)| j * c * w * w).sum();
            let off = sum + self.values[self.roots.remainders.start + k];
            worst[2] = f64::max(worst[2], share(off, w * w * (acceleration + rate * rate) * arms));
        }
        Ok(worst)
    }

    /// Gaps of contacts and ropes.
    pub(super) fn gaps(&mut self, s: f64, at: &Spot) -> Result<Vec<f64>, Fault> {
        self.evaluate(s, at, None)?;
        Ok(self.values[self.roots.gaps.clone()].to_vec())
    }
}

impl Rows {
    /// The solution and the norm of the scaled residual; none when a column depends on the others.
    fn solve(&self, right: &[f64]) -> Option<(Vec<f64>, f64)> {
        if self.qr.rank() < self.n {
            return None;
        }
        let scaled: Vec<f64> = right.iter().zip(&self.scales).map(|(r, s)| r * s).collect();
        let (x, residual) = self.qr.least_squares(&scaled);
        let size = x.iter().fold(f64::MIN_POSITIVE, |l, x| elementary::hypot(l, *x));
        Some((x.iter().zip(&self.columns).map(|(x, c)| x * c).collect(), residual / size))
    }

    /// Unscaled directions.
    fn null_space(&self) -> Vec<Vec<f64>> {
        self.qr.null_space().iter().map(|v| v.iter().zip(&self.columns).map(|(v, c)| v * c).collect()).collect()
    }
}

/// Gap of a contact that is no rope: ropes are followed taut.
fn gap(law: &Law) -> Option<symbolic::Expr> {
    match law {
        Law::Contact { gap, tie: false, .. } => Some(*gap),
        _ => None,
    }
}

fn share(value: f64, size: f64) -> f64 {
    if value == 0.0 { 0.0 } else { (value / size).abs() }
}

/// Coordinates and auxiliary states of a state.
pub(super) fn spot(x: &[f64], n: usize) -> Spot {
    [&x[..n], &x[2 * n..]].concat()
}
