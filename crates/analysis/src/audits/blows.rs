//! The laws of an impact, by its impulses Λ: what they give is the change of all momenta, contacts only push, friction keeps within its limit and brakes.
//!
//! ```text
//! M Δq' = Σ forces Λ                 by the second derivation, which knows nothing of the impact
//! Λ_n >= 0,   |Λ_t| <= μ |Λ_n|       μ by the speed before, the static one where the sliding vanishes or turns
//! |Λ_t| = μ |Λ_n|                    where a sliding is left, asked as the next one
//! Λ_t (u_t⁺ + ε u_t⁻) >= 0           against the sliding that is left beside the tangential restitution ε; asked where one contact strikes, by Newton's law
//! Λ_n (u⁺ + e u⁻) = 0                of every contact in every single blow, by Newton's law; u⁺ >= 0 after the last
//! u⁺ + e u⁻ >= 0                     where contacts strike together, of every contact that closed or was closed, u⁻ <= 0
//! ```
//!
//! Rates of gaps count against the terms that meet in them, at least a hundredth of the largest so far. Impulses count against the largest of the instant, and a small share of the momenta of which they are differences; momenta against the terms that meet in them, at least a hundredth of the largest so far.

use symbolic::connections::Impacts;
use words::Text;

use super::frontier::Frontier;
use crate::dataset::Audit;
use crate::system::{Blow, Touch, TouchLaw};
use crate::{Mode, System};

/// Rounding of rates and impulses of an impact, and what the last blows of a chain that converges leave.
const LIMIT: f64 = 1e-9;
/// Share of the size of a speed below which its sign is rounding.
pub const STILL: f64 = 1e-9;
/// Share of the largest momentum below which an impact is the end of a sequence: a contact that moves by a rounding of its largest rate is closed, and with it
/// those that hang on it.
const DYING: f64 = 1e-2;
/// Share of the momenta by which impulses count at least: a thousand roundings of a momentum keep the limit.
const ROUNDED: f64 = 1e3 * f64::EPSILON / LIMIT;
/// Impacts that are all looked at; of the later ones every second, fourth, ...
const WHOLE: u64 = 256;

/// Collects what the laws leave.
#[derive(Clone, Debug, Default)]
pub struct BlowLaws {
    pushes: Frontier,
    rebounds: Frontier,
    momenta: Frontier,
    /// Largest terms in the rate of each contact so far.
    speeds: Vec<f64>,
    /// Largest momentum so far, with the changes.
    largest: f64,
    /// Largest momentum of the motion so far.
    momentum: f64,
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
        let whole = self.whole((t, states[1]), (system, modes), blow);
        self.judge(&before, &after, blow);
        self.follow_rebounds((t, states[0]), [&before, &after], (system, modes, blow));
        let n = system.n_coordinates();
        let change: Vec<f64> = (n..2 * n).map(|i| states[1][i] - states[0][i]).collect();
        let rows = system.momenta(t, states[1], [&change, &blow.reactions], modes).unwrap_or_default();
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

    /// Impulses at a jump of prescribed velocities: the drives' part of the momenta is not known here.
    pub fn look_at_jolt<S: System + ?Sized>(&mut self, t: f64, states: [&[f64]; 2], (system, modes, blow): (&mut S, &[Mode], &Blow)) {
        let [before, after] = states.map(|x| system.struck(t, x, &blow.reactions, modes));
        let (Some(before), Some(after)) = (before, after) else { return };
        self.whole((t, states[1]), (system, modes), blow);
        self.judge(&before, &after, blow);
        self.taken += 1;
    }

    /// Momenta of the whole motion by coordinate, with the size of the terms that meet in them: an impulse that follows from them is rounded like these.
    fn whole<S: System + ?Sized>(&mut self, (t, x): (f64, &[f64]), (system, modes): (&mut S, &[Mode]), blow: &Blow) -> Vec<[f64; 2]> {
        let n = system.n_coordinates();
        let whole = system.momenta(t, x, [&x[n..2 * n], &vec![0.0; blow.reactions.len()]], modes).unwrap_or_default();
        self.momentum = whole.iter().fold(self.momentum, |m, [_, size]| m.max(*size));
        whole
    }

    fn judge(&mut self, before: &[Touch], after: &[Touch], blow: &Blow) {
        let contact = |t: &&Touch| matches!(t.law, TouchLaw::Contact { .. }) && t.force != 0.0;
        let largest = before.iter().map(|t| t.force.abs()).filter(|f| f.is_finite()).fold(self.least_impulse(), f64::max);
        // in a sequence of blows, or within the phases of one, the sliding may turn before the end
        let single = !blow.phased && blow.blows.is_empty() && before.iter().filter(contact).count() <= 1;
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
            if single && left.abs() > STILL * size(before).max(size(after)) {
                self.pushes.note(if before.force * left < 0.0 { before.force.abs() } else { 0.0 }, largest);
                // one that is rounding of the momenta is not handed on
                let rounded = before.force == 0.0 && blow.impulses.iter().any(|(guard, _)| *guard == before.guard);
                self.pushes.note(if rounded { 0.0 } else { least(before) - before.force.abs() }, largest);
            }
        }
    }

    /// The rates of every single blow; the last one ends with the rates of the instant.
    fn follow_rebounds<S: System + ?Sized>(
        &mut self,
        (t, x): (f64, &[f64]),
        [first, last]: [&[Touch]; 2],
        (system, modes, blow): (&mut S, &[Mode], &Blow),
    ) {
        self.speeds.resize(first.len(), 0.0);
        let n = system.n_coordinates();
        let mut state = x.to_vec();
        let mut before = first.to_vec();
        for single in &blow.blows {
            state[n..2 * n].copy_from_slice(&single.rates);
            let Some(after) = system.struck(t, &state, &single.reactions, modes) else { return };
            self.rebound([&before, &after], blow);
            before = after;
        }
        if blow.blows.is_empty() {
            self.rebound([first, last], blow);
        }
        self.part(last, blow);
    }

    /// What impulses are compared with at least: the blows of a chain that dies out are differences of momenta that do not.
    fn least_impulse(&self) -> f64 {
        (ROUNDED * self.momentum).max(f64::MIN_POSITIVE)
    }

    /// Newton's law of one blow, whose impulses stand in `after`.
    fn rebound(&mut self, [before, after]: [&[Touch]; 2], blow: &Blow) {
        let impulse = |touch: &Touch| if takes_part(touch, blow) { touch.force.abs() } else { 0.0 };
        let largest = after.iter().map(impulse).filter(|p| p.is_finite()).fold(self.least_impulse(), f64::max);
        for (i, (before, after)) in before.iter().zip(after).enumerate().filter(|(_, (_, after))| takes_part(after, blow)) {
            self.speeds[i] = self.speeds[i].max(size(before)).max(size(after));
            let speed = size(before).max(size(after)).max(DYING * self.speeds[i]);
            if blow.phased || speed == 0.0 {
                continue;
            }
            let off = (after.rate[0] + before.restitution * before.rate[0]) / speed;
            // of both the smaller one should vanish
            self.rebounds.note(off.abs().min(after.force.abs() / largest), 1.0);
            if blow.law == Impacts::Together && before.rate[0] <= LIMIT * speed {
                self.rebounds.note(-off, 1.0);
            }
        }
    }

    /// No contact closes any more.
    fn part(&mut self, last: &[Touch], blow: &Blow) {
        for (touch, largest) in last.iter().zip(&self.speeds).filter(|(touch, _)| takes_part(touch, blow)) {
            self.rebounds.note(-touch.rate[0], size(touch).max(DYING * largest));
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
            let name = Text::new(
                "impacts: rates of the contacts against their restitution, largest residual relative to the rates",
                "удары: скорости контактов и коэффициенты восстановления, наибольшая невязка относительно скоростей",
            );
            list.push(Audit::at_most("impact_rebounds", name, self.rebounds.worst(), LIMIT));
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

fn takes_part(touch: &Touch, blow: &Blow) -> bool {
    matches!(touch.law, TouchLaw::Contact { .. }) && blow.rates.iter().any(|(guard, _)| *guard == touch.guard)
}

fn size(touch: &Touch) -> f64 {
    touch.rate[1].max(touch.rate[0].abs())
}

/// The least impulse of a friction that slides on.
fn least(touch: &Touch) -> f64 {
    let TouchLaw::Friction { limits: [back, forth, _], .. } = touch.law else { return 0.0 };
    back.min(forth)
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
