//! From place to place: the rates are integrated, then the conditions closed by Newton's method.
//!
//! Conditions on places hold to rounding by closing; conditions on rates (gears, rolling, belts) by the integral, to a few units of rounding a step.
//! Where the driven coordinate stops leading, the way goes on along its length (`turning.rs`), which tells a hard spot from a dead point.

use super::extrapolation;
use super::linkage::{Linkage, Spot};
use super::stand::Stand;
use crate::Fault;
use crate::fault::codes;

/// Error of a step of the integral, relative to a radian or to the arm.
const TOLERANCE: f64 = 1e-14;
/// Newton's method may move a place by this, rad or arms: more would be another way of assembly.
const CLOSE: f64 = 1e-4;
/// Relative gap of a closed linkage.
const CLOSED: f64 = 1e-12;
const NEWTON: usize = 8;
/// Parts into which the way to the next place is divided before the linkage counts as stuck.
const SHORTEST: f64 = 1.0 / 4096.0;

/// Distance of places around a singular position, rad or arms.
const STRIDE: f64 = 0.02;
/// Places before a leap; its polynomial has one degree less.
const NODES: usize = 9;
/// The first of them stands so many strides before the hard spot, the landing so many behind the first.
const BEFORE: f64 = 2.0;
const AHEAD: f64 = 4.0;

/// Largest disagreements met on the way.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Doubts {
    /// Places by integral against places by closing.
    pub(super) places: f64,
}

impl Linkage<'_> {
    /// Error scales of (q, auxiliaries, b).
    fn tolerances(&self, auxiliaries: usize) -> Vec<f64> {
        let lengths = (0..self.n).map(|i| if self.angles[i] { 1.0 } else { self.arm });
        let rates = lengths.clone();
        lengths.chain(vec![1.0; auxiliaries]).chain(rates).collect()
    }

    /// d/ds of (q, auxiliaries, b).
    fn field(&mut self, s: f64, z: &[f64], auxiliaries: usize) -> Option<Vec<f64>> {
        let at = z[..self.n + auxiliaries].to_vec();
        let (b, _) = self.first(s, &at).ok()??;
        let (c, rest) = self.second(s, &at, &b).ok()??;
        Some([b, rest, c].concat())
    }

    /// One step of the integral with closing; none when it does not succeed at this length.
    fn hop(&mut self, from: &Stand, to: f64, doubts: &mut Doubts) -> Option<Stand> {
        let auxiliaries = from.at.len() - self.n;
        let z = [&from.at[..], &from.integrated[..]].concat();
        let scales = self.tolerances(auxiliaries);
        let n = self.n;
        let mut field = |s: f64, z: &[f64]| self.field(s, z, auxiliaries);
        let z = extrapolation::step(&mut field, (from.s, to - from.s), &z, &scales, TOLERANCE)?;
        let (at, moved) = self.closed(to, &z[..n + auxiliaries])?;
        doubts.places = doubts.places.max(moved);
        Some(Stand { s: to, at, integrated: z[n + auxiliaries..].to_vec() })
    }

    /// The closed place nearest to `at`, and how far it is; none when there is none near.
    pub(super) fn closed(&mut self, s: f64, at: &[f64]) -> Option<(Spot, f64)> {
        let mut place = at.to_vec();
        for (i, d) in self.driven_at(s, &place).ok()? {
            place[i] = d;
        }
        let mut best: Option<(f64, Spot)> = None;
        for _ in 0..NEWTON {
            let (change, gap) = self.closing(s, &place).ok()??;
            if gap.is_nan() || best.as_ref().is_some_and(|(least, _)| gap >= *least) {
                break;
            }
            best = Some((gap, place.clone()));
            place.iter_mut().zip(&change).for_each(|(q, d)| *q += d);
        }
        let (gap, place) = best?;
        let moved = (0..self.n).fold(0.0_f64, |m, i| m.max((place[i] - at[i]).abs() / if self.angles[i] { 1.0 } else { self.arm }));
        (gap <= CLOSED && moved <= CLOSE).then_some((place, moved))
    }

    /// From a place to that at `to`.
    ///
    /// *Errors*: what has no value, a dead point, a singular position.
    pub(super) fn advance(&mut self, from: &Stand, to: f64, doubts: &mut Doubts) -> Result<Stand, Fault> {
        let mut here = from.clone();
        while here.s != to {
            match self.approach_by_hops(&here, to, doubts) {
                Ok(stand) => return Ok(stand),
                Err(stuck) => here = stuck,
            }
            here = match self.turn(&here, to) {
                Err(fault) if fault.code == codes::BRANCHING => self.leap(&here, to, doubts).ok_or(fault)?,
                other => other?,
            };
        }
        Ok(here)
    }

    /// As far as hops lead: the end, or the last place before a hard spot.
    fn approach_by_hops(&mut self, from: &Stand, to: f64, doubts: &mut Doubts) -> Result<Stand, Stand> {
        let whole = to - from.s;
        let mut here = from.clone();
        let mut part = whole;
        while here.s != to {
            // no last hop of rounding alone
            let last = (to - here.s).abs() <= part.abs() * (1.0 + 1e-9);
            let next = if last { to } else { here.s + part };
            match self.hop(&here, next, doubts) {
                Some(stand) => {
                    here = stand;
                    part *= 2.0;
                }
                // no simple ratio: nodes of later steps must not fall on the same hard spot
                None if part.abs() > SHORTEST * whole.abs() => part *= 0.37,
                None => return Err(here),
            }
        }
        Ok(here)
    }

    /// Over a position that branches, along the smooth continuation of the way: a polynomial through places before it leads to one behind it, which is
    /// closed there. None when it does not lead to `to` or the linkage does not close.
    fn leap(&mut self, here: &Stand, to: f64, doubts: &mut Doubts) -> Option<Stand> {
        let unit = self.stride() * (to - here.s).signum();
        let mut stand = here.clone();
        let mut places: Vec<Spot> = Vec::new();
        for k in 0..NODES {
            let s = here.s - (BEFORE + k as f64) * unit;
            stand = self.approach_by_hops(&stand, s, doubts).ok()?;
            places.push(stand.at.clone());
        }
        let guess: Spot = (0..here.at.len()).map(|i| extrapolated(&places.iter().map(|p| p[i]).collect::<Vec<_>>())).collect();
        let s = here.s + (AHEAD - BEFORE) * unit;
        let (at, _) = self.closed(s, &guess)?;
        let (integrated, _) = self.first(s, &at).ok()??;
        let landed = Stand { s, at, integrated };
        // the end of the way may lie within the leap
        if (to - s) * unit < 0.0 { self.approach_by_hops(&landed, to, doubts).ok() } else { Some(landed) }
    }

    /// A short way of the leading coordinate, for interpolation around singular positions.
    pub(super) fn stride(&self) -> f64 {
        STRIDE * if self.angles[self.over] { 1.0 } else { self.arm }
    }
}

/// Value of the polynomial through values at 0, -1, -2, ... at the place `AHEAD`.
fn extrapolated(values: &[f64]) -> f64 {
    let weight = |j: usize| {
        let others = (0..values.len()).filter(|k| *k != j);
        others.map(|k| (AHEAD + k as f64) / (k as f64 - j as f64)).product::<f64>()
    };
    values.iter().enumerate().map(|(j, v)| weight(j) * v).sum()
}
