//! Whether a step is accepted: it must be finite, longer than the resolution of time, and its end must satisfy the equations.

use crate::integrate::step;
use words::Text;

use super::flow::{Ending, Flow, extend_within_range};
use crate::{Fault, System};
use algebra::sum::Instant;

/// Decides whether the defect of a step is due to truncation, and then too large.
#[derive(Default)]
pub(super) struct Defect {
    /// Defect per length of the step that was taken back, and how many were.
    before: Option<f64>,
    tries: u32,
    /// A power is kept constant at its zero.
    held: bool,
    /// Defect per length that halving did not lower on the step before.
    floor: Option<f64>,
    /// The same of this step.
    pub(super) stayed: Option<f64>,
}

/// The defect at the end of a step: the greatest length times the difference of the rates of the polynomial and of the equations.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Off {
    /// Relative to what the step may err.
    share: f64,
    /// Relative to the largest values so far of the states with the same unit.
    of_all: f64,
}

/// Defects above this multiple of the tolerance mean that the last coefficients misled the choice of the step. In a regular step the defect
/// is about p tol e^-2, p the order.
pub(crate) const DEFECT: f64 = 60.0;
/// Rounding of the rates of a state, in units of the last place of the terms that met in them: the linear solve adds some digits.
pub(crate) const ROUNDING: f64 = 64.0;
/// Share of the tolerance, relative to the largest values so far, below which a step over the zero of a power is left alone.
const LITTLE: f64 = 1e-2;
/// A defect per length that exceeds that of rounding by less than this is rounding too: truncation on a step twice as long would be eight times as large.
const ALIKE: f64 = 4.0;
/// Times such a step is taken back before its defect is taken for rounding.
const PATIENCE: u32 = 16;

impl Defect {
    /// Of a step over the zero of a root or power.
    pub(super) fn of_held_powers() -> Defect {
        Defect { held: true, ..Defect::default() }
    }

    /// After a step whose defect was rounding.
    pub(super) fn after(floor: Option<f64>) -> Defect {
        Defect { floor, ..Defect::default() }
    }

    /// Truncation falls at least like h^4 when the step is halved. What does not fall is rounding of the system itself and has to be accepted, or a power
    /// that is kept constant at its zero (`Jets::faithful`), whose defect falls like h^(1+p): that step is made so short that it changes nothing.
    pub(super) fn accept(&mut self, off: Off, h: f64, tolerance: f64) -> bool {
        if off.share.is_nan() {
            return false;
        }
        if off.share <= DEFECT {
            return true;
        }
        let per_length = off.share / h;
        if !self.held && self.floor.is_some_and(|floor| per_length <= ALIKE * floor) {
            self.stayed = self.floor;
            return true;
        }
        let stays = self.tries >= 2 && self.before.is_some_and(|before| per_length > 0.25 * before);
        self.before = Some(per_length);
        self.tries += 1;
        self.stayed = (stays && !self.held).then_some(per_length);
        stays && (!self.held || off.of_all <= LITTLE * tolerance || self.tries > PATIENCE)
    }
}

impl<S: System + ?Sized> Flow<'_, S> {
    /// Rates at the next state in the old modes: an expansion of order 1, which says how far the step is off. That of a step that is accepted is continued.
    pub(super) fn probe(&mut self, at: Instant) -> Result<(), Fault> {
        self.work.probes += 1;
        self.system.expand(at.high, &self.next_x, &self.modes, 1)?;
        self.check_series(at)
    }

    /// The expansion of the next step; of order 1 where the modes are about to change.
    pub(super) fn complete(&mut self, at: Instant, ending: Ending) -> Result<(), Fault> {
        if ending == Ending::Event {
            return Ok(());
        }
        self.work.probes -= 1;
        self.work.expansions += 1;
        extend_within_range(self.system, &mut self.rule, (at.high, &self.next_x), &self.modes)?;
        self.check_series(at)
    }

    fn check_series(&self, at: Instant) -> Result<(), Fault> {
        match (0..self.x.len()).find(|&i| !self.system.state(i).iter().all(|c| c.is_finite())) {
            Some(i) => Err(Fault::not_finite(&Text::same(&self.system.states()[i].name), at.high)),
            None => Ok(()),
        }
    }

    /// How far the end of a step is from satisfying the equations.
    pub(super) fn defect(&self, h: f64) -> Off {
        let mut worst = Off::default();
        for i in 0..self.x.len() {
            let rate = self.system.state(i)[1];
            let off = h * (self.next_slope[i] - rate).abs();
            let truncation = self.rule.tolerance * self.rule.scale[i];
            // the allowance for rounding is a pass over the coefficients: only where it can matter
            if off > DEFECT * truncation || off.is_nan() {
                let size = step::slope_size(self.step.states.row(i), h);
                let allowed = truncation + ROUNDING * f64::EPSILON * h * (size + rate.abs());
                worst.share = if off.is_nan() { f64::NAN } else { worst.share.max(off / allowed) };
                worst.of_all = worst.of_all.max(off / self.rule.reach_of(i).max(f64::MIN_POSITIVE));
            }
        }
        worst
    }

    pub(super) fn take_back(&mut self, h: f64, factor: f64, fault: Option<Fault>) -> Result<f64, Fault> {
        self.work.rejected += 1;
        self.rule.restore(self.step.order);
        let h = factor * h;
        self.guess = h;
        match fault {
            // what has no value however short the step is a singularity that the motion runs into
            Some(fault) if self.vanishes(h) => {
                Err(if fault.code == program::NOT_FINITE { self.underflow() } else { fault.during(self.now.high) })
            }
            _ => Ok(h),
        }
    }

    pub(super) fn vanishes(&self, h: f64) -> bool {
        !h.is_finite() || h <= 4.0 * f64::EPSILON * self.now.high.abs() || h < f64::MIN_POSITIVE
    }

    pub(super) fn check_length(&self, h: f64) -> Result<(), Fault> {
        let limit_reached = h > 0.0 && h.is_finite() && !self.vanishes(h);
        if limit_reached || self.now.after(h).high > self.now.high {
            return Ok(());
        }
        Err(self.underflow())
    }

    pub(super) fn underflow(&self) -> Fault {
        let places = self.system.states().iter().zip(&self.x).take(self.system.n_coordinates());
        Fault::underflow(&self.fastest(), self.now.high).in_configuration(&crate::naming::configuration(places))
    }

    /// Name of the state whose last coefficient limits the step most.
    pub(crate) fn fastest(&self) -> Text {
        let fastest = (0..self.x.len()).max_by(|&a, &b| {
            let size = |i: usize| self.step.states.row(i).last().map_or(0.0, |c| c.abs()) / self.rule.scale[i].max(f64::MIN_POSITIVE);
            size(a).total_cmp(&size(b))
        });
        fastest.map_or(Text::default(), |i| Text::same(&self.system.states()[i].name))
    }

    pub(super) fn not_finite(&self) -> Fault {
        let i = self.next_x.iter().position(|x| !x.is_finite()).unwrap_or(0);
        Fault::not_finite(&Text::same(&self.system.states()[i].name), self.now.high)
    }
}

#[cfg(test)]
mod tests {
    use super::{Defect, Off};

    fn takes(defect: &mut Defect, share: f64, h: f64) -> bool {
        defect.accept(Off { share, of_all: 0.0 }, h, 1e-12)
    }

    #[test]
    fn a_defect_that_halving_does_not_lower_is_rounding_on_the_next_step_too() {
        // off by 400 per length, whatever the length is
        let mut first = Defect::default();
        assert!(!takes(&mut first, 400.0, 1.0) && !takes(&mut first, 200.0, 0.5) && takes(&mut first, 100.0, 0.25));
        let mut next = Defect::after(first.stayed);
        assert!(takes(&mut next, 420.0, 1.0));
        assert_eq!(next.stayed, first.stayed);
        // truncation beside it
        let mut truncated = Defect::after(first.stayed);
        assert!(!takes(&mut truncated, 3200.0, 1.0) && truncated.stayed.is_none());
        // a step without is the end of it
        let mut clean = Defect::after(first.stayed);
        assert!(takes(&mut clean, 10.0, 1.0) && clean.stayed.is_none());
        // a root at its zero is judged by what it changes
        let mut held = Defect::of_held_powers();
        assert!(!takes(&mut held, 400.0, 1.0) && held.stayed.is_none());
    }
}
