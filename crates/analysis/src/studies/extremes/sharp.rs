//! Peaks of oscillations with so little damping that no grid of frequencies shows them: looked for over the distance from the root.

use super::{Resonance, SHARP, Search, square};
use crate::Fault;
use crate::peaks::{self, Peak};
use crate::studies::modes::{Kind, Mode};
use crate::studies::response::{Forced, magnitude, phase};
use crate::studies::shapes::Complex;

/// Places that are looked at, in half-widths of the peak; those beside a wide peak, see `dense`, with the place itself.
const LOOKED: [f64; 10] = [0.0, 0.1, 0.3, 0.6, 1.0, 2.0, 4.0, 10.0, 30.0, 100.0];
/// A root of a machine that follows the frequency is its own where it is as near as this.
const OWN: f64 = 1e-6;

/// A root by which peaks are looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Root {
    /// λ.
    pub(super) root: Complex,
    /// Its mode.
    pub(super) mode: usize,
}

impl Root {
    /// Half the width of its peak.
    fn half(&self) -> f64 {
        self.root.0.abs()
    }

    /// Whether a frequency is among those that are looked at from it.
    pub(super) fn reaches(&self, omega: f64) -> bool {
        (omega - self.root.1).abs() <= 2.0 * LOOKED[LOOKED.len() - 1] * SHARP * self.root.1
    }
}

/// Simple roots with so little damping that peaks are looked for over the distance from them.
///
/// *Errors*: S031 of a machine that follows the frequency.
pub(super) fn roots(forced: &mut Forced, natural: &[Mode], [from, to]: [f64; 2]) -> Result<Vec<Root>, Fault> {
    let weak = |m: &&Mode| m.kind == Kind::Oscillation && m.root.0 != 0.0 && m.ratio.abs() < SHARP;
    let mut found: Vec<Root> = Vec::new();
    for (i, mode) in natural.iter().enumerate().filter(|(_, m)| weak(m) && (from..=to).contains(&m.damped)) {
        let own = match forced.is_followed() {
            true => nearest(&forced.modes(mode.damped)?.modes, mode.damped),
            false => Some((i, mode.root)),
        };
        let Some((mode, root)) = own.filter(|(_, root)| (root.1 - mode.damped).abs() <= OWN * mode.damped && root.0 != 0.0) else {
            continue;
        };
        let root = Root { root, mode };
        let known = found.iter().any(|f| f.root == root.root);
        if !known && forced.is_simple(root.root)? {
            found.push(root);
        }
    }
    Ok(found)
}

fn nearest(modes: &[Mode], omega: f64) -> Option<(usize, Complex)> {
    let all = modes.iter().enumerate().filter(|(_, m)| m.kind == Kind::Oscillation);
    let away = |m: &Mode| (m.damped - omega).abs();
    all.min_by(|a, b| away(a.1).total_cmp(&away(b.1))).map(|(i, m)| (i, m.root))
}

impl Search<'_, '_> {
    fn beside(&mut self, root: Complex, offset: f64) -> Complex {
        let k = self.k;
        self.forced.beside(root, offset).map_or((f64::NAN, f64::NAN), |p| p.outputs[k])
    }

    /// Peaks beside the roots.
    pub(super) fn sharp(&mut self) -> Result<Vec<Resonance>, Fault> {
        let mut found = Vec::new();
        for own in self.sharp_roots {
            let half = own.half();
            let offsets: Vec<f64> = LOOKED[1..].iter().rev().map(|s| -s).chain(LOOKED).map(|s| s * half).collect();
            let powers: Vec<f64> = offsets.iter().map(|offset| square(self.beside(own.root, *offset))).collect();
            for c in peaks::candidates(&powers, 1.0) {
                let peak = peaks::refine(&mut |offset| square(self.beside(own.root, offset)), offsets[c - 1], offsets[c + 1], 1.0);
                found.push(self.sharp_resonance(own, peak)?);
            }
        }
        Ok(found)
    }

    fn sharp_resonance(&mut self, own: &Root, peak: Peak) -> Result<Resonance, Fault> {
        let point = self.forced.beside(own.root, peak.omega)?;
        let (z, still) = (point.outputs[self.k], magnitude(point.still[self.k]));
        let half_power = [-1.0, 1.0]
            .map(|side| own.root.1 + self.half((&peak, side), f64::NEG_INFINITY, &|search, at| square(search.beside(own.root, at))));
        Ok(Resonance {
            output: self.k,
            omega: point.omega,
            amplitude: magnitude(z),
            phase: phase(z),
            gain: if still > 0.0 { magnitude(z) / still } else { f64::NAN },
            mode: Some(own.mode),
            // ζ = -Re λ/|λ|, and |λ| is Im λ but for a square of ζ
            quality: -0.5 * own.root.1 / own.root.0,
            half_power,
        })
    }
}
