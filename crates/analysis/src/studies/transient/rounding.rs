//! What the rounding of its numbers makes of a closed form by an instant, where no integration stands beside it.
//!
//! A root moves by δλ when the entries of M, B and C change by a rounding each, and e^(λ τ) by δλ τ of itself. Of principal coordinates both parts are known:
//!
//! ```text
//! δλ = i δω - δn,     δω/ω as in [`super::phase_error`],     δn = ε Σ |s_i B_ij s_j|/2        sᵀ M s = 1
//! ```
//!
//! The exponential of a joint matrix is backward stable in the norm only, and a weak damper beside a hard one lies below that: there the motion is computed once more with
//! entries a rounding away and in two steps instead of one, and the difference is what nobody knows.
//!
//! *Source*: N. J. Higham, Functions of Matrices, ch. 10 (scaling and squaring).

use super::form::Form;
use super::motion::Motion;
use super::phase::Phase;
use super::phase_error;
use crate::audits::worse;
use crate::dataset::Audit;
use algebra::elementary;
use algebra::random::Random;
use words::Text;

/// Six digits are printed.
const PRINTED: f64 = 1e-6;
/// Where the second way takes a rest: no power of two, so that its squarings are others.
const STEP: f64 = 0.381_966_011_250_105_1;

/// The check up to the instant `last`.
pub(super) fn audit(phases: &[Phase], last: f64) -> Audit {
    let mut worst = phase_error::largest(phases, last);
    for phase in phases.iter().filter(|p| p.start < last) {
        let tau = last.min(phase.end) - phase.start;
        let own = match &phase.motion {
            Motion::Modes(modes) => {
                let lost = |m: &super::motion::Mode| {
                    let left = elementary::exp((-m.oscillator.n).min(0.0) * tau);
                    0.5 * f64::EPSILON * terms(&phase.form, &m.shape) * tau * left
                };
                modes.iter().map(lost).fold(0.0, f64::max)
            }
            Motion::Exponential(_) => again(phase, tau),
        };
        worst = worse(worst, own);
    }
    let name = Text::new(
        "closed form: what rounding of its numbers changes by the end, share of the largest value",
        "замкнутое решение: влияние округления чисел к концу, доля наибольшего значения",
    );
    Audit::at_most("closed_form_rounding", name, worst, PRINTED)
}

/// Σ |s_i B_ij s_j|.
fn terms(form: &Form, s: &[f64]) -> f64 {
    let n = form.n;
    (0..n * n).map(|p| (s[p / n] * form.damping[p] * s[p % n]).abs()).sum()
}

/// The largest difference of the motion on another way, as a share of the largest place or rate.
fn again(phase: &Phase, tau: f64) -> f64 {
    let n = phase.form.n;
    let there = |motion: &Motion, taus: &[f64]| motion.states(taus).pop().unwrap_or_default();
    let plain = there(&phase.motion, &[tau]);
    // shapes of weak springs beside hard ones know what is below the last digits of the entries
    let beside = if phase.form.below.is_empty() || !phase.motion.is_by_shapes() {
        Motion::new(&shaken(&phase.form), &phase.state_at_start, phase.start).ok()
    } else {
        None
    };
    let other = there(beside.as_ref().unwrap_or(&phase.motion), &[STEP * tau, tau]);
    let size = |part: std::ops::Range<usize>| part.map(|i| phase.state_at_start[i].abs().max(plain[i].abs())).fold(0.0_f64, f64::max);
    let sizes = [size(0..n), size(n..2 * n)];
    let share = |i: usize| {
        let off = (plain[i] - other[i]).abs();
        if off == 0.0 { 0.0 } else { off / sizes[i / n] }
    };
    (0..2 * n).map(share).fold(0.0, worse)
}

/// Entries a rounding away from what they are.
fn shaken(form: &Form) -> Form {
    let mut random = Random::new(1);
    let mut shake = |list: &[f64]| -> Vec<f64> { list.iter().map(|v| v * (1.0 + f64::EPSILON * random.between(-1.0, 1.0))).collect() };
    Form { mass: shake(&form.mass), damping: shake(&form.damping), stiffness: shake(&form.stiffness), ..form.clone() }
}
