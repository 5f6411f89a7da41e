//! The laws of an impact, by its impulses Λ: what they give is the change of all momenta, contacts only push, friction keeps within its limit and brakes.
//!
//! ```text
//! M Δq' = Σ forces Λ                 by the second derivation, which knows nothing of the impact
//! Λ_n >= 0,   |Λ_t| <= μ |Λ_n|       μ by the speed before, the static one where the sliding vanishes or turns
//! Λ_t (u_t⁺ + ε u_t⁻) >= 0           against the sliding that is left beside the tangential restitution ε; asked where one contact strikes, by Newton's law
//! ```
//!
//! Impulses count against the largest of the instant, momenta against the terms that meet in them, at least a hundredth of the largest so far.

use words::Text;

use super::frontier::Frontier;
use crate::dataset::Audit;
use crate::system::{Blow, Touch, TouchLaw};
use crate::{Mode, System};

/// Rounding of rates and impulses of an impact, and what the last blows of a chain that converges leave.
const LIMIT: f64 = 1e-9;
/// Share of the size of a speed below which its sign is rounding.
const STILL: f64 = 1e-9;
/// Share of the largest momentum below which an impact is the end of a sequence: a contact that moves by a rounding of its largest rate is closed, and with it
/// those that hang on it.
const DYING: f64 = 1e-2;
/// Impacts that are all looked at; of the later ones every second, fourth, ...
const WHOLE: u64 = 256;

/// Collects what the laws leave.
#[derive(Clone, Debug, Default)]
pub struct BlowLaws {
    pushes: Frontier,
    momenta: Frontier,
    /// Largest momentum so far.
    largest: f64,
    count: u64,
    stride: u64,
    taken: u64,
    balanced: bool,
}

impl BlowLaws {
    /// Looks at an impact between two states at t.
    pub fn look<S: System + ?Sized>(&mut self, t: f64, states: [&[f64]; 2], (system, modes, blow): (&mut S, &[Mode], &Blow)) {
        self.count += 1;
        if !(self.count - 1).is_multiple_of(self.stride.max(1)) {
            return;
        }
        let before = system.struck(t, states[0], &blow.reactions, modes);
        let after = system.struck(t, states[1], &blow.reactions, modes);
        let (Some(before), Some(after)) = (before, after) else { return };
        self.judge(&before, &after, blow);
        let n = system.n_coordinates();
        let change: Vec<f64> = (n..2 * n).map(|i| states[1][i] - states[0][i]).collect();
        let rows = system.momenta(t, states[1], &change, &blow.reactions).unwrap_or_default();
        let whole = system.momenta(t, states[1], &states[1][n..2 * n], &vec![0.0; blow.reactions.len()]).unwrap_or_default();
        for ([residual, size], [_, whole]) in rows.into_iter().zip(whole) {
            self.balanced = true;
            self.largest = self.largest.max(size).max(whole);
            self.momenta.note(residual.abs(), size.max(DYING * self.largest));
        }
        self.taken += 1;
        if self.taken.is_multiple_of(WHOLE) {
            self.stride = 2 * self.stride.max(1);
        }
    }

    fn judge(&mut self, before: &[Touch], after: &[Touch], blow: &Blow) {
        let contact = |t: &&Touch| matches!(t.law, TouchLaw::Contact { .. }) && t.force != 0.0;
        let largest = before.iter().map(|t| t.force.abs()).filter(|f| f.is_finite()).fold(0.0, f64::max);
        // in a sequence of blows, or within the phases of one, the sliding may turn before the end
        let single = !blow.phased && before.iter().filter(contact).count() <= 1;
        for (before, after) in before.iter().zip(after) {
            let TouchLaw::Friction { limits, .. } = before.law else {
                self.pushes.note(-before.force, largest);
                continue;
            };
            let limit = limit(limits, before, after);
            if !limit.is_finite() {
                continue;
            }
            self.pushes.note(before.force.abs() - limit, largest);
            let left = after.rate[0] + before.restitution * before.rate[0];
            let drives = single && left.abs() > STILL * size(before).max(size(after)) && before.force * left < 0.0;
            self.pushes.note(if drives { before.force.abs() } else { 0.0 }, largest);
        }
    }

    /// The audits, none without impacts.
    pub fn audits(&self) -> Vec<Audit> {
        let mut list = Vec::new();
        if self.taken > 0 {
            let name = Text::new(
                "impacts: largest pull of a contact, excess or wrong direction of friction, relative to the impulses",
                "удары: наибольшее притяжение контакта, превышение или неверное направление трения относительно импульсов",
            );
            list.push(Audit::at_most("impact_laws", name, self.pushes.worst(), LIMIT));
        }
        if self.balanced {
            let name = Text::new(
                "impacts: momenta of all bodies against the impulses, largest relative residual",
                "удары: количества движения всех тел и импульсы, наибольшая относительная невязка",
            );
            list.push(Audit::at_most("impact_momenta", name, self.momenta.worst(), LIMIT));
        }
        list
    }
}

fn size(touch: &Touch) -> f64 {
    touch.rate[1].max(touch.rate[0].abs())
}

/// The largest impulse that the law allows.
fn limit([back, forth, fixed]: [f64; 3], before: &Touch, after: &Touch) -> f64 {
    let moves = |touch: &Touch| touch.rate[0].abs() > STILL * size(touch);
    let same = moves(before) && moves(after) && before.rate[0] * after.rate[0] > 0.0;
    match before.rate[0] > 0.0 {
        _ if !same => fixed.max(back).max(forth),
        true => forth,
        false => back,
    }
}
