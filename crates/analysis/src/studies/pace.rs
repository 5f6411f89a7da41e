//! How the number of steps of a run grows.

use crate::{GuardKind, System};
use algebra::elementary;

/// A doubling of the number of steps takes twice as long as the one before at a steady pace, 1.4 times where the frequency grows with the time, and as long where it grows exponentially: switches
/// of a force that follows the sign of a coordinate towards its zero do.
const AS_LONG: f64 = 1.2;
/// Such doublings in a row that are no start of something else.
const DOUBLINGS: u32 = 4;
/// Steps from which on doublings are counted.
const FIRST: u64 = 1024;

/// When the number of steps doubled last.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Doubled {
    /// The instant.
    at: f64,
    /// How long that took.
    took: f64,
    /// How often in a row it took no longer than before.
    alike: u32,
}

impl Doubled {
    /// Looks at a number of steps and the time that they reach: where it doubles in equal times, and would be above the most in the end, how long that takes and how many there would be.
    pub(super) fn look(&mut self, (steps, time): (u64, f64), (end, most): (f64, f64)) -> Option<(f64, f64)> {
        if !steps.is_multiple_of(FIRST) || !(steps / FIRST).is_power_of_two() {
            return None;
        }
        let took = time - self.at;
        let alike = if took <= AS_LONG * self.took { self.alike + 1 } else { 0 };
        *self = Doubled { at: time, took, alike };
        let needed = (steps as f64 * elementary::exp2((end - time) / took)).min(f64::MAX);
        (alike >= DOUBLINGS && needed > most).then_some((took, needed))
    }
}

/// Whether numbers of steps may double in equal times and come to an end: the integrator passes the limit of impacts that follow each other ever faster.
pub(super) fn may_strike<S: System + ?Sized>(system: &S) -> bool {
    system.guards().iter().any(|guard| matches!(guard.kind, GuardKind::Contact { .. }))
}

#[cfg(test)]
mod tests {
    use super::Doubled;
    use algebra::elementary;

    /// The instants at which 1024, 2048, ... steps are reached, up to 2²⁰ of them.
    fn told(at: impl Fn(f64) -> f64, end: f64) -> bool {
        let mut doubled = Doubled::default();
        (0..=10).map(|k| 1024_u64 << k).any(|steps| doubled.look((steps, at(steps as f64)), (end, 1e10)).is_some())
    }

    /// Steps at a steady pace, and of an oscillation whose frequency grows with the time, are no endless run, however many there are; switches at intervals 1/k are.
    #[test]
    fn only_what_doubles_in_equal_times_is_endless() {
        assert!(!told(|steps| 1e-6 * steps, 1e9));
        assert!(!told(|steps| 1e-3 * steps.sqrt(), 1e9));
        assert!(told(|steps| 0.03 * elementary::ln(steps), 5.0));
        // the same to where it may be waited for
        assert!(!told(|steps| 0.03 * elementary::ln(steps), 0.6));
    }
}
