//! Impacts at contacts, and when a contact that rebounds ever less comes to rest.
//!
//! All contacts on their surfaces whose gaps close take part in one impact, those that are closed as well; a contact that would have to pull (a
//! negative impulse) is let go and the impact repeated without it. Newton's rule: rate after = -restitution x rate before, each contact. Of several
//! contacts that touch at the same time this is one possible rule; waves in the bodies decide in reality.
//!
//! **Infinitely many impacts.** After an impact with the rates -v before and e v after, e < 1, and the gap g1 tau + g2 tau^2 + ..., g2 < 0, the
//! next flight lasts tau = -g1/g2, and each of the following e times the one before:
//!
//! ```text
//! remaining = tau (1 + e + e^2 + ...) = tau / (1 - e)
//! ```
//!
//! When this is below [`REST`] of the time (or of the step that the motion would allow), the contact is closed at once.

use crate::taylor::Flow;
use crate::{Fault, GuardKind, Mode, System};

/// Share of the time below which the impacts still to come are one instant.
const REST: f64 = 4e-15;
/// Share of the rate before below which a rate after is rounding.
const SILENT: f64 = 1e-13;

/// An impact at one contact.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Impact {
    pub guard: usize,
    /// Rates of the gap before and after.
    pub rates: [f64; 2],
    /// Instant at which infinitely many impacts end, when the contact comes to rest here.
    pub rests: Option<f64>,
}

impl<S: System + ?Sized> Flow<'_, S> {
    /// Impacts at the touched contacts whose gap closes; sets the first trial of the modes of all contacts on their surfaces. The last
    /// expansion belongs to the present state.
    pub(super) fn collide(&mut self) -> Result<Vec<Impact>, Fault> {
        self.rebounds.fill(false);
        let on: Vec<usize> = (0..self.modes.len())
            .filter(|&i| self.is_contact(i) && (self.touched[i] || self.modes[i] == Mode::Zero || self.is_on_surface(i)))
            .collect();
        let before: Vec<f64> = on.iter().map(|&i| self.gap_rate(i)).collect();
        let closing = |(i, rate): (&usize, &f64)| self.modes[*i] != Mode::Zero && *rate < 0.0;
        if !on.iter().zip(&before).any(closing) {
            self.close_touched(&on);
            return Ok(Vec::new());
        }
        let scale = before.iter().fold(0.0_f64, |m, r| m.max(r.abs()));
        let after = self.share_impulses(&on, &before, SILENT * scale)?;
        let mut impacts = Vec::new();
        for ((&i, &rate), &rebound) in on.iter().zip(&before).zip(&after) {
            let was_open = self.modes[i] != Mode::Zero;
            self.rebounds[i] = rebound > SILENT * scale;
            self.modes[i] = if self.rebounds[i] { Mode::Positive } else { Mode::Zero };
            self.touched[i] = true;
            if was_open && rate < 0.0 {
                impacts.push(Impact { guard: i, rates: [rate, if self.modes[i] == Mode::Zero { 0.0 } else { rebound }], rests: None });
            }
        }
        Ok(impacts)
    }

    /// Whether the value of a guard is rounding.
    fn is_on_surface(&self, i: usize) -> bool {
        self.system.guard(i).first().is_some_and(|value| value.abs() <= self.guard_noise[i])
    }

    fn is_contact(&self, i: usize) -> bool {
        matches!(self.system.guards()[i].kind, GuardKind::Contact { .. })
    }

    fn gap_rate(&self, i: usize) -> f64 {
        self.system.guard(i).get(1).copied().unwrap_or(0.0)
    }

    /// A touched contact without a closing rate: closed, unless the flow opens it.
    fn close_touched(&mut self, on: &[usize]) {
        for &i in on {
            let opens = self.gap_rate(i) > SILENT * self.guard_scale[i];
            if self.modes[i] != Mode::Zero && !opens {
                self.modes[i] = Mode::Zero;
            }
        }
    }

    /// Rates of the gaps after the impact; contacts with a negative impulse are let go, the most negative one first.
    fn share_impulses(&mut self, on: &[usize], before: &[f64], silent: f64) -> Result<Vec<f64>, Fault> {
        let start = self.x.clone();
        let mut taking: Vec<usize> = on.iter().zip(before).filter(|(_, rate)| **rate <= silent).map(|(i, _)| *i).collect();
        loop {
            let mut modes = self.modes.clone();
            for &i in on {
                // those that take part are handed over as closing, the others are open
                modes[i] = Mode::Positive;
            }
            self.x.clone_from(&start);
            let impulses = self.system.impact(self.now.high, &mut self.x, &modes, &taking).map_err(|f| f.during(self.now.high))?;
            let largest = impulses.iter().fold(0.0_f64, |m, p| m.max(p.abs()));
            let worst = (0..impulses.len().min(taking.len())).min_by(|&a, &b| impulses[a].total_cmp(&impulses[b]));
            match worst {
                Some(k) if impulses[k] < -1e-12 * largest && taking.len() > 1 => {
                    taking.remove(k);
                }
                _ => break,
            }
        }
        self.system.expand(self.now.high, &self.x, &self.modes, 1)?;
        Ok(on.iter().map(|&i| self.gap_rate(i)).collect())
    }

    /// Closes the contacts whose impacts will be over within rounding of the time.
    pub(super) fn come_to_rest(&mut self, mut impacts: Vec<Impact>) -> Result<Vec<Impact>, Fault> {
        let resolution = REST * self.now.high.abs().max(self.natural);
        let mut any = false;
        for impact in &mut impacts {
            let i = impact.guard;
            let [_, g1, g2, ..] = self.system.guard(i) else { continue };
            let restitution = impact.rates[1] / -impact.rates[0];
            let remaining = -g1 / g2 / (1.0 - restitution);
            if self.modes[i] == Mode::Positive && *g2 < 0.0 && restitution < 1.0 && remaining <= resolution {
                impact.rests = Some(self.now.after(remaining).high);
                any = true;
            }
        }
        if any {
            for impact in impacts.iter().filter(|impact| impact.rests.is_some()) {
                self.modes[impact.guard] = Mode::Zero;
            }
            self.search()?;
        }
        Ok(impacts)
    }
}
