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

impl Beside {
    /// Whether they carry more or less afterwards, by more than this share.
    pub(super) fn jumps(&self, share: f64) -> bool {
        let size = self.momenta.iter().flatten().fold(0.0_f64, |m, p| m.max(p.abs()));
        self.carried.iter().any(|c| c.abs() > share * size)
    }
}

impl Machine {
    /// None where nothing is released, or the balances have no values.
    pub(super) fn balances_beside(&mut self, times: [f64; 2], x: &[f64]) -> Option<Beside> {
        let program = self.bound.program();
        if program.hidden.is_empty() {
            return None;
        }
        let (roots, width) = (program.law_roots().balances, program.coordinates + program.reactions + 1);
        let mut rows = |t: f64| {
            let values = self.laws.evaluate(&Point { time: t, states: x, ..Point::default() }).ok()?;
            values.get(roots.clone()).map(<[f64]>::to_vec)
        };
        let [Some(before), Some(after)] = times.map(&mut rows) else { return None };
        let last = |rows: &[f64]| rows.chunks(width).map(|row| row[width - 1]).collect::<Vec<f64>>();
        let (was, is) = (last(&before), last(&after));
        let carried: Vec<f64> = was.iter().zip(&is).map(|(was, is)| is - was).collect();
        Some(Beside { rows: after, momenta: [was, is], carried })
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
