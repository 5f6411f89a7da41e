//! How long a closed form keeps its digits: cos ω τ is known as well as its angle, and the angle is rounded once as a product.
//!
//! ```text
//! δ(τ) = ε |λ| τ e^(min(Re λ, 0) τ)        λ roots of the characteristic equation and rates of the loads
//! ```
//!
//! is the share of its first amplitude by which a part e^(λ τ) may err: what dies away takes its error with it. The integrator of `simulate` adds small
//! angles and would lose more; no method of this word length does better. Where a weak spring stands beside hard ones and the stiffnesses are known in single digits only
//! (about a place of rest), their rounding moves its λ by ε times the ratio of the terms of vᵀ C v to their sum: the note tells what is more.

use super::motion::Rate;
use super::phase::Phase;
use crate::Fault;
use algebra::elementary;
use words::digits::rounded;
use words::explain::{Explanation, plain};
use words::{Message, Text};

/// Below this nothing is said: the closed form is compared with integration to the same share.
const SILENT: f64 = 1e-9;
/// Above this fewer than six digits are left, and there is no table.
const LOST: f64 = 1e-6;

/// S078.
pub(crate) const PHASE: Explanation =
    plain("S078", ("the phase of a closed form is lost", "фаза замкнутого решения потеряна"), (PHASE_EN, PHASE_RU));
const PHASE_EN: &str = "A closed form can be asked at any instant, but its sines know their angle ω t to 2.2·10⁻¹⁶ of itself only: after so many radians that fewer than six \
    digits are left, `transient` gives no table. Below that a note says how many hold. What dies away (damping) is no obstacle. Wrong: --at 1e12 of a free undamped \
    oscillation. Right: an instant within the first 10⁹ radians.";
const PHASE_RU: &str = "Замкнутое решение можно вычислить в любой момент, но угол ω t под знаком синуса известен лишь с относительной погрешностью 2,2·10⁻¹⁶: если радиан так \
    много, что верных цифр остаётся меньше шести, `transient` таблицы не даёт; до этого примечание сообщает, сколько цифр верны. Затухающие составляющие не мешают. \
    Неверно: --at 1e12 для свободных незатухающих колебаний. Верно: момент в пределах первых 10⁹ радиан.";

/// The largest error of a phase, and where it stands.
#[derive(Clone, Copy, Debug, Default)]
struct Loss {
    share: f64,
    t: f64,
    angle: f64,
}

/// The largest share that is lost up to the instant `last`.
pub(super) fn largest(phases: &[Phase], last: f64) -> f64 {
    let (worst, open) = losses(phases, last);
    crate::audits::worse(worst.share, open.share)
}

/// By rounding of the angles, and by what is not known of the rates.
fn losses(phases: &[Phase], last: f64) -> (Loss, Loss) {
    let (mut worst, mut open) = (Loss::default(), Loss::default());
    for phase in phases.iter().filter(|p| p.start < last) {
        let tau = last.min(phase.end) - phase.start;
        for Rate { re, im, doubt } in phase.motion.rates() {
            let angle = elementary::hypot(re, im) * tau;
            let left = angle * elementary::exp(re.min(0.0) * tau);
            let share = f64::EPSILON * left;
            if share.is_nan() || share > worst.share {
                worst = Loss { share, t: phase.start + tau, angle };
            }
            if doubt * left > open.share {
                open = Loss { share: doubt * left, t: phase.start + tau, angle };
            }
        }
    }
    (worst, open)
}

/// A note where digits are lost up to the instant `last`.
///
/// *Errors*: S078 where fewer than six are left.
pub(super) fn check(phases: &[Phase], last: f64) -> Result<Option<Text>, Fault> {
    let (worst, open) = losses(phases, last);
    match worst.share {
        s if s <= SILENT && open.share <= SILENT => Ok(None),
        s if s <= LOST => Ok(Some(note(if open.share > s { open } else { worst }))),
        _ => Err(lost(worst)),
    }
}

fn note(Loss { share, t, .. }: Loss) -> Text {
    let (t, share) = (rounded(t), rounded(share));
    Text::new(
        format!("towards t = {} s the angles of the oscillations are known to {} rad only: later digits mean nothing", t.en, share.en),
        format!("к моменту t = {} с углы колебаний известны лишь с погрешностью {} рад: дальнейшие цифры ничего не значат", t.ru, share.ru),
    )
}

fn lost(Loss { share, t, angle }: Loss) -> Fault {
    let (t, share, angle) = (rounded(t), rounded(share), rounded(angle));
    Fault::new(Message {
        code: "S078",
        what: Text::new(
            format!("at t = {} s the phase of the motion is lost", t.en),
            format!("к моменту t = {} с фаза движения потеряна", t.ru),
        ),
        why: Text::new(
            format!("an oscillation has turned by {} rad, an angle that numbers of 16 digits know to {} rad only", angle.en, share.en),
            format!("угол колебания достиг {} рад, а числа из 16 цифр передают его лишь с погрешностью {} рад", angle.ru, share.ru),
        ),
        help: Text::new(
            "ask for earlier instants; amplitudes of what lasts stand in `response` and in the constants of the phases",
            "запросите более ранние моменты; амплитуды установившегося движения дают `response` и постоянные этапов",
        ),
    })
}
