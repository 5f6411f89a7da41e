//! Poisson's restitution: an impact in two phases.
//!
//! **Closing**: until the approach has ended, the impulse of the contact being P. **Opening**: until the impulse is (1 + e) P. Coulomb's law holds all the time.
//! At one contact the phases are followed as they pass (Routh), the impulse p of the contact taking the place of time:
//!
//! ```text
//! dΛ/dp:  contact 1;  friction μ |dΛ_n/dp| against the sliding, or what keeps it at rest if at most μ₀ |dΛ_n/dp|
//! du/dp = G dΛ/dp         constant until a sliding ends or the phase does
//! ```
//!
//! so that a sliding may end, reverse or stay at rest within a phase. Where several contacts strike at once nothing says how their impulses grow side by
//! side: each phase is then one problem of its own (Glocker and Pfeiffer), closing with e = 0, opening with Λ >= e P and u >= 0.
//!
//! With Newton's restitution an eccentric impact may gain energy where friction reverses the sliding; so followed, it cannot.
//!
//! *Source*: E. J. Routh, Dynamics of a System of Rigid Bodies, part 1, chapter 5; Y. Wang and M. T. Mason, Two-dimensional rigid-body collisions with
//! friction, J. Appl. Mech. 59 (1992) 635-642; F. Pfeiffer and C. Glocker, Multibody Dynamics with Unilateral Contacts, chapter 8.

use super::parts::Part;
use super::strike::{Goal, Law, SILENT, Strike};
use crate::Fault;
use symbolic::connections::Rebound;

/// Most pieces of one impact: each friction stops or turns a few times at most.
const PIECES: usize = 200;
/// Rounding of speeds and limits.
const SLACK: f64 = 1e-12;

impl Strike {
    /// A blow with contacts that follow Poisson's law.
    pub(super) fn strike_by_phases(&mut self, taking: &[usize], set: &[usize], t: f64) -> Result<(), Fault> {
        match taking {
            [contact] => self.follow_phases(*contact, set, t),
            _ => self.two_problems(taking, set, t),
        }
    }

    fn restitution(&self, i: usize) -> f64 {
        if let Law::Contact { restitution, rebound: Rebound::Poisson } = self.units[i].law { restitution } else { 0.0 }
    }

    fn two_problems(&mut self, taking: &[usize], set: &[usize], t: f64) -> Result<(), Fault> {
        let undetermined = || Fault::undetermined_impact(t);
        let closing: Vec<Goal> = set.iter().map(|&i| self.rebound_of(i)).collect();
        let first = self.solve(set, &closing).ok_or_else(undetermined)?;
        self.reach((set, &closing), &first);
        let opening = |k: usize| if taking.contains(&set[k]) { self.restitution(set[k]) * first[k] } else { 0.0 };
        let goal: Vec<Goal> = (0..set.len()).map(|k| Goal { rate: 0.0, change: -self.rates[set[k]], impulse: opening(k) }).collect();
        let second = self.solve(set, &goal).ok_or_else(undetermined)?;
        self.reach((set, &goal), &second);
        Ok(())
    }

    /// Closing: Newton's contacts among Poisson's rebound at once.
    fn rebound_of(&self, i: usize) -> Goal {
        let rate = match self.units[i].law {
            Law::Contact { restitution, rebound: Rebound::Newton } => -restitution * self.rates[i],
            _ => 0.0,
        };
        Goal { rate, change: rate - self.rates[i], impulse: 0.0 }
    }

    /// One contact, piece by piece.
    fn follow_phases(&mut self, contact: usize, set: &[usize], t: f64) -> Result<(), Fault> {
        let mut phase = Phase::Closing { impulse: 0.0 };
        for _ in 0..PIECES {
            let Some(way) = self.way(contact, set) else { return Err(Fault::undetermined_impact(t)) };
            let slopes: Vec<f64> = set.iter().map(|&i| self.slope(i, set, &way)).collect();
            let own = set.iter().position(|&i| i == contact).map_or(0.0, |k| slopes[k]);
            let left = match phase {
                Phase::Closing { .. } if own > 0.0 => (-self.rates[contact] / own).max(0.0),
                Phase::Closing { .. } => f64::INFINITY,
                Phase::Opening { left } => left,
            };
            let stop = self.next_stop(set, &slopes);
            let length = left.min(stop.map_or(f64::INFINITY, |(_, p)| p));
            if !length.is_finite() {
                return Err(Fault::jammed_impact(t));
            }
            let impulses: Vec<f64> = way.iter().map(|w| w * length).collect();
            let before = self.rates.clone();
            self.take(set, &impulses);
            if let Some((i, _)) = stop.filter(|(_, p)| *p <= length) {
                self.rates[i] = 0.0;
            }
            phase = match phase {
                Phase::Closing { impulse } if length < left => Phase::Closing { impulse: impulse + length },
                Phase::Closing { impulse } => {
                    self.rates[contact] = 0.0;
                    Phase::Opening { left: self.restitution(contact) * (impulse + length) }
                }
                Phase::Opening { left } => Phase::Opening { left: left - length },
            };
            self.book((set, &impulses), &before);
            if matches!(phase, Phase::Opening { left } if left <= 0.0) {
                return Ok(());
            }
        }
        Err(Fault::undetermined_impact(t))
    }

    fn is_still(&self, i: usize) -> bool {
        self.rates[i].abs() <= SILENT * self.sizes[i]
    }

    /// du/dp of a unit.
    fn slope(&self, i: usize, set: &[usize], way: &[f64]) -> f64 {
        let count = self.units.len();
        set.iter().zip(way).map(|(&j, w)| self.coupling[i * count + j] * w).sum()
    }

    /// The friction whose sliding ends first, and the impulse until then.
    fn next_stop(&self, set: &[usize], slopes: &[f64]) -> Option<(usize, f64)> {
        let ends = |(&i, slope): (&usize, &f64)| {
            let slides = matches!(self.units[i].law, Law::Friction { .. }) && !self.is_still(i);
            (slides && self.rates[i] * slope < 0.0).then(|| (i, -self.rates[i] / slope))
        };
        set.iter().zip(slopes).filter_map(ends).min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// dΛ/dp: frictions that slide against their sliding, those at rest as Coulomb's law decides, sticking first.
    fn way(&self, contact: usize, set: &[usize]) -> Option<Vec<f64>> {
        let resting: Vec<usize> =
            (0..set.len()).filter(|&k| matches!(self.units[set[k]].law, Law::Friction { .. }) && self.is_still(set[k])).collect();
        let total = resting.iter().try_fold(1_usize, |product, _| product.checked_mul(3).filter(|p| *p <= 20_000))?;
        (0..total).find_map(|code| {
            let mut digits = code;
            let mut signs = vec![0.0; set.len()];
            for &k in &resting {
                signs[k] = [0.0, 1.0, -1.0][digits % 3];
                digits /= 3;
            }
            let moving = |k: usize| if resting.contains(&k) { signs[k] } else { self.rates[set[k]].signum() };
            self.along(contact, set, &moving).filter(|way| resting.iter().all(|&k| self.agrees(set, way, (k, signs[k]))))
        })
    }

    /// dΛ/dp with given ways of sliding, 0 for sticking. The sign of the normal impulse is 1 first.
    fn along(&self, contact: usize, set: &[usize], sign: &dyn Fn(usize) -> f64) -> Option<Vec<f64>> {
        let mut pressed = vec![1.0; set.len()];
        for _ in 0..4 {
            let part = |k: usize| match self.units[set[k]].law {
                Law::Contact { .. } => Part::Out,
                Law::Friction { .. } if sign(k) != 0.0 => Part::Slides(sign(k) * pressed[k]),
                _ => Part::Held,
            };
            let parts: Vec<Part> = (0..set.len()).map(part).collect();
            // held: the speed does not change; the contact: one unit of impulse
            let goal: Vec<Goal> =
                set.iter().map(|&i| Goal { rate: self.rates[i], change: 0.0, impulse: if i == contact { 1.0 } else { 0.0 } }).collect();
            let way = self.impulses_of((set, &goal), &parts)?;
            let now: Vec<f64> = set.iter().map(|&i| if self.normal(i, set, &way) < 0.0 { -1.0 } else { 1.0 }).collect();
            if now == pressed {
                return Some(way);
            }
            pressed = now;
        }
        None
    }

    /// Whether a friction at rest may stick so, or begins to slide that way.
    fn agrees(&self, set: &[usize], way: &[f64], (k, sign): (usize, f64)) -> bool {
        let i = set[k];
        let Law::Friction { fixed, .. } = self.units[i].law else { return true };
        if sign == 0.0 {
            let limit = fixed * self.normal(i, set, way).abs();
            return way[k].abs() <= limit + SLACK * way.iter().fold(0.0_f64, |m, w| m.max(w.abs()));
        }
        self.slope(i, set, way) * sign >= 0.0
    }
}

/// Where in an impact.
#[derive(Clone, Copy)]
enum Phase {
    Closing {
        /// Of the contact so far.
        impulse: f64,
    },
    Opening {
        /// Of the contact, still to come.
        left: f64,
    },
}
