//! Whether a turn is a motion at all. A machine that comes to rest returns to every section as well, by its rounding.
//!
//! A turn is measured against the first one of the search, state by state and without a moving frame: what turns uniformly moves. Newton's method may
//! jump to a place of rest that the motion itself leaves; it is the answer only where every small motion about it dies away.

use super::found::Found;
use super::fundamental::Blur;
use super::options::Multiplier;
use super::orbit::Orbit;
use super::spectrum;
use super::verdict::stable;
use crate::fault::codes;
use crate::{Fault, System};
use algebra::elementary;
use words::{Message, Text};

/// Share of the first turn's scales within which a whole turn is rest.
const REST: f64 = 1e-9;
/// A turn that has shrunk to this share is measured in scales of its own: a return to 10⁻¹⁰ of the first turn would say nothing of it.
const SHRUNK: f64 = 1e-3;

/// How much of the first turn is left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Left {
    /// A motion of its size.
    Motion,
    /// A far smaller one.
    Little,
    /// None.
    Rest,
}

/// What a turn is beside the scales of the first one. `apart` are states that go on by themselves and that nothing feels: a rotor that spins beside a machine at rest
/// is no motion of it.
pub(super) fn left(orbit: &Orbit, scales: &[f64], apart: &[usize]) -> Left {
    let still = vec![0.0; scales.len()];
    let ranges = orbit.ranges(&still);
    let own = (0..scales.len()).filter(|i| !apart.contains(i));
    let size = own.map(|i| ranges[i].0 / scales[i]).fold(0.0, f64::max);
    match size {
        s if s <= REST => Left::Rest,
        s if s <= SHRUNK => Left::Little,
        _ => Left::Motion,
    }
}

/// Whether every small motion about the place of rest that the turn has become dies away.
pub(super) fn attracts<S: System + ?Sized>(system: &mut S, found: &Found<'_>, seed: u64) -> bool {
    let Ok((turn, Blur::None)) = found.turn(system) else { return false };
    spectrum::spectrum(&turn, seed).is_ok_and(|s| stable(&s.multipliers) == Some(true))
}

/// Whether a shrunk turn has a multiplier 1 of its own: its motion then dies away more slowly than any exponential, and a turn of any size all but closes.
pub(super) fn fades(multipliers: &[Multiplier]) -> bool {
    multipliers.iter().any(|m| !m.trivial && elementary::hypot(m.re - 1.0, m.im) <= m.error.max(FADING))
}

/// Distance from 1 at which the multiplier of a shrunk turn is 1.
const FADING: f64 = 1e-6;

/// S041: no motion is left.
pub(super) fn at_rest() -> Fault {
    Fault::new(Message {
        code: codes::NEVER_BACK,
        what: Text::new(
            "the machine comes to rest: no motion is left that could repeat, and rest has no period",
            "машина останавливается: движения, которое могло бы повторяться, не остаётся, а у покоя нет периода",
        ),
        why: Text::new(
            "friction, damping or impacts take the energy of the motion, and nothing in the file feeds it",
            "трение, сопротивление или удары отнимают энергию движения, а восполнять её в модели нечему",
        ),
        help: Text::new(
            "ask for `equilibrium` (where it rests) and `modes` (how small motions die away); a regime needs a drive, or a start within its reach",
            "запросите `equilibrium` (положение покоя) и `modes` (затухание малых движений); для режима нужен привод или начало ближе к режиму",
        ),
    })
}
