//! The constants of the textbook formula by name, for tables and files.

use super::form::Form;
use super::load::{Load, Term};
use super::motion::{Mode, Motion};
use super::oscillator::{Case, Constants, Harmonic, Oscillator};
use super::phase::Phase;

/// The time that a harmonic load is written over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clock {
    /// t, from the start of the motion: sin(p t + delta).
    Motion,
    /// τ, from the start of the phase: sin(p τ + delta).
    Phase,
}

/// A harmonic with its initial phase over the clock that suits it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forcing {
    /// The harmonic; its `delta` belongs to τ.
    pub harmonic: Harmonic,
    /// The clock of `delta`.
    pub clock: Clock,
    /// Initial phase over that clock, -π..π.
    pub delta: f64,
}

/// A mode with its constants.
#[derive(Clone, Debug, PartialEq)]
pub struct Listed<'p> {
    /// Shape and equation.
    pub mode: &'p Mode,
    /// The textbook formula.
    pub constants: Constants,
    /// Harmonic loads.
    pub forcing: Vec<Forcing>,
    /// Factor of the inverse inertia: a of a q'' + b q' + c q = H sin pt with one degree of freedom, 1 for a mode.
    pub inertia: f64,
}

impl Phase {
    /// The textbook constants: one entry with one degree of freedom, one for each mode with several; none when modes do not uncouple.
    pub fn listed(&self) -> Vec<Listed<'_>> {
        let Motion::Modes(modes) = &self.motion else { return Vec::new() };
        modes.iter().map(|mode| listed(mode, &self.form, self.start)).collect()
    }
}

fn listed<'p>(mode: &'p Mode, form: &Form, start: f64) -> Listed<'p> {
    let constants = mode.oscillator.constants();
    let forcing = constants.harmonics.iter().map(|h| forcing(*h, start)).collect();
    Listed { mode, constants, forcing, inertia: if form.n == 1 { form.mass[0] } else { 1.0 } }
}

/// A load that goes on is written over t, one that restarts over τ.
fn forcing(harmonic: Harmonic, start: f64) -> Forcing {
    use std::f64::consts::{PI, TAU};
    // a phase at the start is a product of a frequency and an instant
    let rounding = 1e-13 * (1.0 + harmonic.p * start);
    let tidy = |delta: f64| {
        let turned = delta - TAU * (delta / TAU).round();
        if turned.abs() <= rounding {
            0.0
        } else if PI - turned.abs() <= rounding {
            PI
        } else {
            turned
        }
    };
    let (own, whole) = (tidy(harmonic.delta), tidy(harmonic.delta - harmonic.p * start));
    let clock = if own == 0.0 && whole != 0.0 { Clock::Phase } else { Clock::Motion };
    Forcing { harmonic, clock, delta: if clock == Clock::Phase { own } else { whole } }
}

impl Listed<'_> {
    /// The constant part of the load that has a displacement of its own, [`Listed::standing`].
    pub fn constant(&self) -> f64 {
        self.mode.oscillator.load.0.iter().filter(|t| t.power == 0 && t.rate.re == 0.0 && t.rate.im == 0.0).map(|t| t.factor.re).sum()
    }

    /// The displacement under the constant part of the load; none where nothing pulls back.
    pub fn standing(&self) -> Option<f64> {
        let k2 = self.mode.oscillator.k2;
        (k2 != 0.0 && self.constant() != 0.0).then(|| self.constant() / k2)
    }

    /// What the forced motion has besides D sin(pτ + δ - ε) and the standing displacement, over τ: ramps, growth, resonance.
    ///
    /// Forced motions superpose, so this one is that of the load without the parts that are written otherwise.
    pub fn further(&self) -> Load {
        let o = &self.mode.oscillator;
        let written = |t: &Term| {
            let harmonic = || self.forcing.iter().any(|f| f.harmonic.amplitude.is_some() && f.harmonic.p == t.rate.im.abs());
            t.power == 0 && t.rate.re == 0.0 && if t.rate.im == 0.0 { o.k2 != 0.0 } else { harmonic() }
        };
        let load = Load(o.load.0.iter().filter(|t| !written(t)).copied().collect());
        Oscillator { load, ..o.clone() }.constants().forced
    }

    /// Names as in a textbook, ASCII, and values; what does not exist (the lag of no load, roots that are complex) is left out.
    pub fn named(&self) -> Vec<(&'static str, f64)> {
        let (o, c) = (&self.mode.oscillator, &self.constants);
        let k = o.k2.max(0.0).sqrt();
        let mut list =
            vec![("a", self.inertia), ("b", 2.0 * o.n * self.inertia), ("c", o.k2 * self.inertia), ("n", o.n), ("k", k), ("k1", c.k1)];
        match c.case {
            Case::Undamped | Case::Underdamped => {
                let period = std::f64::consts::TAU / c.k1;
                list.extend([("T1", period), ("decrement", o.n * period)]);
            }
            _ => list.extend([("r1", c.roots[0].re), ("r2", c.roots[1].re)]),
        }
        list.extend([("C1", c.free[0]), ("C2", c.free[1]), ("static", c.rest)]);
        match self.forcing.as_slice() {
            [] => list.extend([("H", 0.0), ("h", 0.0), ("D", 0.0)]),
            [one] => list.extend(one.named(self.inertia, o.k2)),
            // several frequencies stand in a list of their own
            _ => {}
        }
        list
    }
}

impl Forcing {
    /// Names and values of one harmonic; without D in resonance without damping.
    pub fn named(&self, inertia: f64, k2: f64) -> Vec<(&'static str, f64)> {
        let h = &self.harmonic;
        let mut list = vec![("H", inertia * h.h), ("h", h.h), ("p", h.p), ("delta", self.delta)];
        if let Some(amplitude) = h.amplitude {
            list.extend([("D", amplitude), ("epsilon", h.lag)]);
            if k2 > 0.0 {
                // against the displacement under a constant load of the same size
                list.extend([("static_displacement", h.h / k2), ("dynamic_coefficient", amplitude * k2 / h.h)]);
            }
        }
        list
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The solution as it is written: free motion, harmonics, standing displacement, the rest.
    fn written(o: &Oscillator, tau: f64) -> f64 {
        let mode = Mode { shape: vec![1.0], oscillator: o.clone(), doubt: 0.0 };
        let constants = o.constants();
        let forcing = constants.harmonics.iter().map(|h| forcing(*h, 0.0)).collect();
        let listed = Listed { mode: &mode, constants, forcing, inertia: 1.0 };
        let [c1, c2] = listed.constants.free;
        let (k1, roots) = (listed.constants.k1, listed.constants.roots);
        let free = match listed.constants.case {
            Case::Undamped | Case::Underdamped => (-o.n * tau).exp() * (c1 * (k1 * tau).cos() + c2 * (k1 * tau).sin()),
            _ if roots[0] == roots[1] => (-o.n * tau).exp() * (c1 + c2 * tau),
            _ => c1 * (roots[0].re * tau).exp() + c2 * (roots[1].re * tau).exp(),
        };
        let wave = |f: &Forcing| f.harmonic.amplitude.map_or(0.0, |d| d * (f.harmonic.p * tau + f.delta - f.harmonic.lag).sin());
        free + listed.forcing.iter().map(wave).sum::<f64>() + listed.standing().unwrap_or(0.0) + listed.further().at(tau)
    }

    #[test]
    fn the_written_solution_is_the_motion() {
        let mut load = Load::sine(7.0, 0.3);
        load.add(&Load::cosine(10.0, 0.0), 2.0);
        load.add(&Load::constant(3.0), 1.0);
        load.add(&Load::time(), 0.8);
        load.add(&Load::time().times(&Load::sine(7.0, 0.1)), 0.4);
        load.add(&Load::growth(-0.7, 0.0), 1.5);
        // damped, undamped in resonance with the second harmonic, overdamped, free, unstable
        for (n, k2) in [(1.5, 100.0), (0.0, 100.0), (12.0, 100.0), (0.4, 0.0), (0.0, 0.0), (0.3, -4.0)] {
            let o = Oscillator { n, k2, load: load.clone(), x0: 0.2, v0: -1.0 };
            for tau in [0.0, 0.13, 0.9, 2.0] {
                let (found, wanted) = (written(&o, tau), o.at(tau)[0]);
                // a textbook formula cancels near critical damping; the other does not
                assert!((found - wanted).abs() < 1e-11 * (1.0 + wanted.abs()), "n = {n}, k² = {k2}, τ = {tau}: {found} {wanted}");
            }
        }
    }
}
