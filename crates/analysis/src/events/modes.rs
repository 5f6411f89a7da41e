//! Which modes hold after an event, or at the start.
//!
//! A combination of modes is admissible when the flow *in* these modes keeps every guard on the side its mode says: a guard away from its surface has
//! the sign of its value, a guard on its surface the sign of its first Taylor coefficient that does not vanish, and `Zero` when all
//! vanish (sign(v) of a body that rests without force). Tried in this order: at an event every touched guard changes side, at the start everything is
//! `Zero`; then what the flow of the last trial suggests; then all combinations of the guards on their surfaces. When none is
//! admissible the flow is driven back from every side: the switch chatters.

use crate::taylor::Flow;
use crate::{Fault, Mode, System};

use super::Switch;

/// Share of a guard's own scale below which it counts as standing still on its surface.
pub(crate) const STILL: f64 = 1e-11;
/// Share of the guard's change within a step below which a Taylor coefficient is rounding. Were it taken for more, the mode would be corrected by a
/// second switch that share of a step later.
const SIGNIFICANT: f64 = 1e-15;
/// Most guards on their surfaces at once for which all combinations are tried (3^5 expansions).
const COMBINED: usize = 5;

/// sum |g_k| h^k.
pub(crate) fn size(g: &[f64], h: f64) -> f64 {
    g.iter().rev().fold(0.0, |sum, g_k| sum * h + g_k.abs())
}

impl<S: System + ?Sized> Flow<'_, S> {
    /// Decides all modes at the start, where nothing is known yet.
    pub(crate) fn decide_at_start(&mut self) -> Result<(), Fault> {
        self.touched.fill(false);
        self.modes.fill(Mode::Zero);
        self.search()
    }

    /// Decides the modes after the guards in `touched` have reached their surfaces, and records what changed.
    pub(crate) fn decide(&mut self) -> Result<(), Fault> {
        let before = self.modes.clone();
        for i in 0..self.modes.len() {
            let scheduled = self.system.guards()[i].scheduled.is_some();
            if self.modes[i] == Mode::Zero && !scheduled && !self.system.guard(i).is_empty() {
                self.touched[i] = true;
            } else if self.touched[i] {
                self.modes[i] = opposite(self.modes[i]);
            }
        }
        self.search()?;
        for (guard, &mode) in before.iter().enumerate() {
            let after = self.modes[guard];
            if after != mode {
                self.work.switches += 1;
                self.switches.push(Switch { t: self.now.high, guard, before: mode, after });
            }
        }
        Ok(())
    }

    /// Searches admissible modes, beginning with the present ones; leaves their expansion in the system.
    fn search(&mut self) -> Result<(), Fault> {
        let mut tried: Vec<Vec<Mode>> = Vec::new();
        let mut suspect = None;
        let mut fault = None;
        while !tried.contains(&self.modes) {
            tried.push(self.modes.clone());
            match self.attempt() {
                Ok(None) => return Ok(()),
                Ok(Some(wanted)) => {
                    suspect = suspect.or_else(|| (0..wanted.len()).rev().find(|&i| self.touched[i] && wanted[i] != self.modes[i]));
                    self.modes = wanted;
                }
                Err(e) => {
                    fault = Some(e);
                    break;
                }
            }
            if tried.len() > 16 + 4 * self.modes.len() {
                break;
            }
        }
        if self.try_all_combinations(&tried) {
            return Ok(());
        }
        let guard = suspect.or_else(|| self.touched.iter().position(|&t| t)).unwrap_or(0);
        Err(fault.unwrap_or_else(|| Fault::chattering(&self.system.guards()[guard].name, self.now.high)))
    }

    /// Expands in the present modes. None when they are admissible, otherwise the modes that their flow suggests.
    fn attempt(&mut self) -> Result<Option<Vec<Mode>>, Fault> {
        self.expand_here()?;
        self.measure()?;
        let wanted: Vec<Mode> = (0..self.modes.len()).map(|i| self.wanted(i)).collect();
        if wanted != self.modes {
            return Ok(Some(wanted));
        }
        for i in 0..self.modes.len() {
            let deflates = self.touched[i] && self.modes[i] != Mode::Zero && self.system.guards()[i].scheduled.is_none();
            self.deflation[i] = if deflates { self.leading(i).map_or(0, |(k, _)| k) } else { 0 };
        }
        Ok(None)
    }

    /// All combinations of the guards on their surfaces, the others as their values say.
    fn try_all_combinations(&mut self, tried: &[Vec<Mode>]) -> bool {
        let on: Vec<usize> = (0..self.modes.len()).filter(|&i| self.touched[i] && self.system.guards()[i].scheduled.is_none()).collect();
        if on.is_empty() || on.len() > COMBINED {
            return false;
        }
        let others = tried.last().cloned().unwrap_or_else(|| self.modes.clone());
        for code in 0..3usize.pow(on.len() as u32) {
            self.modes.clone_from(&others);
            let mut digits = code;
            for &i in &on {
                self.modes[i] = [Mode::Zero, Mode::Positive, Mode::Negative][digits % 3];
                digits /= 3;
            }
            // the others may follow the combination: once more with what they want
            for _ in 0..2 {
                match self.attempt() {
                    Ok(None) => return true,
                    Ok(Some(wanted)) if on.iter().all(|&i| wanted[i] == self.modes[i]) => self.modes = wanted,
                    _ => break,
                }
            }
        }
        false
    }

    /// The side on which the flow of the last expansion keeps a guard.
    fn wanted(&mut self, i: usize) -> Mode {
        let g = self.system.guard(i);
        let Some(&value) = g.first() else { return self.modes[i] };
        if let Some(t) = self.system.guards()[i].scheduled {
            let slope = Mode::of(g.get(1).copied().unwrap_or(0.0));
            return if self.now.until(t) > 0.0 { opposite(slope) } else { slope };
        }
        if !self.touched[i] {
            if value.abs() > self.guard_noise[i] {
                return Mode::of(value);
            }
            self.touched[i] = true;
        }
        self.leading(i).map_or(Mode::Zero, |(_, mode)| mode)
    }

    /// Order and sign of the first coefficient, after the constant one, that does not vanish.
    fn leading(&self, i: usize) -> Option<(usize, Mode)> {
        let g = self.system.guard(i);
        let h = self.natural;
        let change = size(g.get(1..)?, h) * h;
        if change <= STILL * self.guard_scale[i] {
            return None;
        }
        let mut power = 1.0;
        for (k, &g_k) in g.iter().enumerate().skip(1) {
            power *= h;
            if g_k.abs() * power > SIGNIFICANT * change {
                return Some((k, Mode::of(g_k)));
            }
        }
        None
    }
}

fn opposite(mode: Mode) -> Mode {
    match mode {
        Mode::Negative => Mode::Positive,
        Mode::Zero => Mode::Zero,
        Mode::Positive => Mode::Negative,
    }
}
