//! Impulses of supports: reactions that no equation of motion contains, from the balances of the released bodies.
//!
//! Integrated over the instant of an impact a balance is
//!
//! ```text
//! Σ inertia_j Δq'_j + Δcarried = Σ_k released_k Λ_k
//! ```
//!
//! where `carried` is the momentum that prescribed motions give the body at rates of zero: a jump of their velocities changes it.

use program::Point;

use super::Machine;
use super::impact::balances;
use super::leap::Leap;
use super::ties::RATE;
use crate::Blow;

/// The balances of released bodies on both sides of an instant, and the change of what they carry.
pub(super) struct Beside {
    /// Rows after it.
    rows: Vec<f64>,
    /// Momenta at rates of zero before and after it, by row.
    momenta: [Vec<f64>; 2],
    /// Their change.
    pub carried: Vec<f64>,
}

impl Machine {
    /// None where nothing is released, or the balances have no values.
    pub(super) fn balances_beside(&mut self, times: [f64; 2], x: &[f64]) -> Option<Beside> {
        let [Some(before), Some(after)] = times.map(|t| self.rows_of_balances(t, x)) else { return None };
        let (was, is) = (self.momenta(&before), self.momenta(&after));
        let carried: Vec<f64> = was.iter().zip(&is).map(|(was, is)| is - was).collect();
        Some(Beside { rows: after, momenta: [was, is], carried })
    }

    /// What the balances carry on both sides of an instant.
    pub(super) fn leap_of_balances(&mut self, times: [f64; 2], x: &[f64]) -> Option<Leap> {
        let mut side = |times: [f64; 2]| {
            let [near, far] = times.map(|t| self.rows_of_balances(t, x));
            Some([self.momenta(&near?), self.momenta(&far?)])
        };
        let [before, after] = Leap::instants(times);
        Some(Leap { before: side(before)?, after: side(after)? })
    }

    /// Row by row: inertia, factors of the reactions, momentum at rates of zero.
    fn rows_of_balances(&mut self, t: f64, x: &[f64]) -> Option<Vec<f64>> {
        let program = self.bound.program();
        if program.hidden.is_empty() {
            return None;
        }
        let roots = program.law_roots().balances;
        let values = self.laws.evaluate(&Point { time: t, states: x, ..Point::default() }).ok()?;
        values.get(roots).map(<[f64]>::to_vec)
    }

    /// The last of each row.
    fn momenta(&self, rows: &[f64]) -> Vec<f64> {
        let program = self.bound.program();
        let width = program.coordinates + program.reactions + 1;
        rows.chunks(width).map(|row| row[width - 1]).collect()
    }

    /// Adds them to a blow that changed the rates of `x` by `jump` between two instants, the same ones where no prescribed velocity jumps.
    pub(super) fn hold(&mut self, times: [f64; 2], x: &[f64], jump: &[f64], blow: &mut Blow) {
        let Some(Beside { rows: after, momenta: [was, is], carried }) = self.balances_beside(times, x) else { return };
        let program = self.bound.program();
        let (hidden, reactions) = (program.hidden.clone(), program.reactions);
        let width = jump.len() + reactions + 1;
        blow.reactions.resize(reactions, 0.0);
        balances(&after, (&hidden, &carried), jump, &mut blow.reactions);
        // impulses that change every balance by no more than its rounding are none
        let n = jump.len();
        let size = |(b, row): (usize, &[f64])| -> f64 {
            let own: f64 = row[..n].iter().zip(jump).map(|(m, v)| (m * v).abs()).sum();
            let given: f64 = row[n..width - 1].iter().zip(&blow.reactions).map(|(f, p)| (f * p).abs()).sum();
            own + given + was[b].abs() + is[b].abs()
        };
        let sizes: Vec<f64> = after.chunks(width).enumerate().map(size).collect();
        for s in hidden {
            let p = blow.reactions[s];
            let felt = after.chunks(width).zip(&sizes).any(|(row, size)| (row[n + s] * p).abs() > RATE * size);
            blow.reactions[s] = if felt { p } else { 0.0 };
        }
    }
}
