//! The laws of contacts and frictions along the motion, each by values and not by the modes in which the motion was computed:
//!
//! ```text
//! gap >= 0,   N >= 0                                     depth, pull
//! |F| <= μ₀ N at rest,   F = μ N against the sliding     cone
//! N gap = 0,  N a_n = 0,  slip = 0 and a_t = 0 at rest   pairing: of each pair the member that should vanish
//! ```
//!
//! Forces follow from the equations in the modes of the step, gaps and speeds from the dense output, accelerations from its derivatives. They are looked at where a
//! step begins and ends and within it, which takes in both sides of every event; gaps and forces that the integrator follows as polynomials are looked at along
//! the whole step.
//!
//! Scales: a force counts against the largest of its own contact or friction so far, at least `WEAK` of the largest of the machine; a gap, a rate and an acceleration
//! against the terms that meet in them, the last also against the one that the contact would have without its force. A force below the rounding of the balances
//! behind it ([`crate::System::ties`]) is none.

use words::Text;

use super::ROUNDED;
use super::blows::STILL;
use super::defect::looked_at;
use super::frontier::{FLOOR, Frontier};
use crate::dataset::Audit;
use crate::integrate::Step;
use crate::system::{Touch, TouchLaw};
use crate::{GuardKind, Mode, System};

/// Where a step is looked at.
const PLACES: [f64; 5] = [0.0, 0.1, 0.5, 0.9, 1.0];
/// Steps that are looked at in all places; later ones in one, that of the golden section.
const WHOLE: u64 = 512;
/// Share of the largest force of the machine that stands for the size of a small one: it is what is left of the large ones.
const WEAK: f64 = 1e-3;
/// How many tolerances of a step a speed may err by: beside a reversal it is the error of the step.
const STEPPED: f64 = 1e3;
/// Limit of these audits, and the share of a speed that is error, at the loosest tolerance.
const WIDEST: f64 = 1e-2;
/// Share of its size, a hundredth of the least limit, up to which an acceleration is in order whatever else may be a size.
const CLEAR: f64 = 1e-11;
/// How often the acceleration without a contact's force is asked for.
const ASKED: u32 = 4;
/// Points at which a polynomial is looked at that may come below zero.
const POINTS: usize = 32;

/// Largest sizes of one contact or friction so far.
#[derive(Clone, Copy, Debug, Default)]
struct Sizes {
    force: f64,
    place: f64,
    rate: f64,
    acceleration: f64,
    asked: u32,
}

/// Collects what the laws leave.
#[derive(Clone, Debug, Default)]
pub struct TouchLaws {
    pull: Frontier,
    depth: Frontier,
    cone: Frontier,
    pairing: Frontier,
    sizes: Vec<Sizes>,
    strongest: f64,
    /// Largest length among the coordinates.
    widest: f64,
    /// Share of the size of a speed that the steps may be off.
    still: f64,
    contacts: bool,
    frictions: bool,
    steps: u64,
    x: Vec<f64>,
    rates: Vec<f64>,
}

/// Magnitudes of the coordinates that are lengths.
fn lengths<'x, S: System + ?Sized>(system: &'x S, x: &'x [f64]) -> impl Iterator<Item = f64> + 'x {
    let n = system.n_coordinates();
    system.states().iter().take(n).zip(x).filter(|(state, _)| state.unit == "m").map(|(_, x)| x.abs())
}

impl TouchLaws {
    /// For a motion computed with this tolerance.
    pub fn new(tolerance: f64) -> TouchLaws {
        TouchLaws { still: (STEPPED * tolerance).min(WIDEST), ..TouchLaws::default() }
    }

    /// Looks at a step up to `length`.
    pub fn look<S: System + ?Sized>(&mut self, step: &Step, system: &mut S, length: f64) {
        if !system.guards().iter().any(|g| matches!(g.kind, GuardKind::Contact { .. } | GuardKind::Friction { .. })) {
            return;
        }
        self.steps += 1;
        self.x.resize(system.states().len(), 0.0);
        self.rates.resize(system.states().len(), 0.0);
        let one = [looked_at(self.steps)];
        let places: &[f64] = if self.steps <= WHOLE { &PLACES } else { &one };
        for place in places {
            let Some(touches) = self.touches(step, system, place * length) else { continue };
            self.sizes.resize(touches.len(), Sizes::default());
            self.widest = lengths(system, &self.x).fold(self.widest, f64::max);
            self.measure(&touches, step);
            self.without((step, place * length), system, &touches);
            self.weigh((step, place * length), system, &touches);
            self.weigh_gaps((step, place * length), system, &touches);
            self.judge(&touches, &step.modes);
        }
        self.follow(step, system, length);
    }

    fn touches<S: System + ?Sized>(&mut self, step: &Step, system: &mut S, tau: f64) -> Option<Vec<Touch>> {
        step.state_after(tau, &mut self.x);
        step.rate_after(tau, &mut self.rates);
        let n = system.n_coordinates();
        system.touches(step.instant(tau).high, &self.x, &self.rates[n..2 * n], &step.modes)
    }

    fn measure(&mut self, touches: &[Touch], step: &Step) {
        for (sizes, touch) in self.sizes.iter_mut().zip(touches) {
            let own = match touch.law {
                TouchLaw::Contact { gap } => {
                    self.contacts = true;
                    // a body that has long lain on a table has the rounding of the table's motion for its place
                    sizes.place = sizes.place.max(gap[0].abs()).max(gap[1]).max(FLOOR * self.widest);
                    touch.force.abs()
                }
                TouchLaw::Friction { limits, .. } => {
                    self.frictions = true;
                    limits.iter().fold(touch.force.abs(), |m, l| m.max(l.abs()))
                }
            };
            // what moves a place by less than its rounding within the step is no motion
            let h = step.length.max(f64::MIN_POSITIVE);
            sizes.rate = sizes.rate.max(touch.rate[0].abs()).max(touch.rate[1]).max(FLOOR * sizes.place / h);
            sizes.acceleration = sizes.acceleration.max(touch.acceleration[0].abs()).max(touch.acceleration[1]).max(FLOOR * sizes.rate / h);
            // nor is a speed that the rounding of the time makes at this acceleration
            sizes.rate = sizes.rate.max(FLOOR * sizes.acceleration * step.instant(step.length).high.abs());
            sizes.force = if own.is_finite() { sizes.force.max(own) } else { sizes.force };
            self.strongest = self.strongest.max(sizes.force);
        }
    }

    /// What the accelerations would be without the force of each contact or friction that holds: their natural size.
    /// Asked where an acceleration is not small against those that have been seen.
    fn without<S: System + ?Sized>(&mut self, (step, tau): (&Step, f64), system: &mut S, touches: &[Touch]) {
        let (t, n) = (step.instant(tau).high, system.n_coordinates());
        for (i, touch) in touches.iter().enumerate() {
            let clear = touch.acceleration[0].abs() <= CLEAR * self.sizes[i].acceleration;
            if step.modes[touch.guard] != Mode::Zero || clear || self.sizes[i].asked >= ASKED {
                continue;
            }
            self.sizes[i].asked += 1;
            let mut modes = step.modes.clone();
            modes[touch.guard] = Mode::Positive;
            if !system.rates(t, &self.x, &modes, &mut self.rates) {
                continue;
            }
            let free = system.touches(t, &self.x, &self.rates[n..2 * n], &modes);
            if let Some(free) = free.as_ref().and_then(|list| list.get(i)).filter(|free| free.acceleration[0].is_finite()) {
                self.sizes[i].acceleration = self.sizes[i].acceleration.max(free.acceleration[0].abs());
            }
        }
    }

    /// What rounding makes of a force where one seems to break its law: where weights and inertia cancel, all forces may be that.
    fn weigh<S: System + ?Sized>(&mut self, (step, tau): (&Step, f64), system: &mut S, touches: &[Touch]) {
        let breaks = |(i, touch): (usize, &Touch)| match touch.law {
            TouchLaw::Contact { .. } => -touch.force > CLEAR * self.force_size(i),
            TouchLaw::Friction { limits: [back, forth, fixed], .. } => {
                touch.force.abs() - back.max(forth).max(fixed) > CLEAR * self.force_size(i)
            }
        };
        if touches.iter().enumerate().any(breaks) {
            self.widen((step, tau), system);
        }
    }

    /// The same of a gap that seems to be negative: lengths of the machine meet in it, however little it has moved.
    fn weigh_gaps<S: System + ?Sized>(&mut self, (step, tau): (&Step, f64), system: &mut S, touches: &[Touch]) {
        let breaks = |(i, touch): (usize, &Touch)| match touch.law {
            TouchLaw::Contact { gap } => -gap[0] > CLEAR * self.sizes[i].place,
            TouchLaw::Friction { .. } => false,
        };
        if touches.iter().enumerate().any(breaks) {
            for (_, rounding) in system.rounding_of_gaps(step.instant(tau).high, &self.x) {
                self.depth.whole(rounding / (ROUNDED * f64::EPSILON));
            }
        }
    }

    /// No scale is so small that the rounding of a force at the last state would count.
    fn widen<S: System + ?Sized>(&mut self, (step, tau): (&Step, f64), system: &mut S) {
        for (guard, tie) in system.ties(step.instant(tau).high, &self.x, &step.modes) {
            let contact = matches!(system.guards()[guard].kind, GuardKind::Contact { .. });
            let audit = if contact { &mut self.pull } else { &mut self.cone };
            audit.whole(tie.force / (ROUNDED * f64::EPSILON));
        }
    }

    fn judge(&mut self, touches: &[Touch], modes: &[Mode]) {
        for (i, touch) in touches.iter().enumerate().filter(|(_, touch)| touch.force.is_finite()) {
            let holds = modes[touch.guard] == Mode::Zero;
            let (sizes, force) = (self.sizes[i], self.force_size(i));
            if holds {
                self.pairing.note(touch.rate[0].abs(), sizes.rate);
                self.pairing.note(touch.acceleration[0].abs(), sizes.acceleration);
            }
            match touch.law {
                TouchLaw::Contact { gap } => {
                    self.depth.note(-gap[0], sizes.place);
                    self.pull.note(-touch.force, force);
                    self.pairing.note(if holds { gap[0].abs() } else { 0.0 }, sizes.place);
                    self.pairing.note(if holds { 0.0 } else { touch.force.abs() }, force);
                }
                TouchLaw::Friction { limits, .. } if holds && limits[2].is_finite() => self.hold(touches, i),
                TouchLaw::Friction { limits, .. } if limits.iter().all(|l| l.is_finite()) && !holds => {
                    self.cone.note(excess(touch, limits, self.still.max(STILL) * sizes.rate), force);
                }
                TouchLaw::Friction { .. } => {}
            }
        }
    }

    /// Frictions that stick together are held together: Σ r λ by Σ |r| limit, once for each guard.
    fn hold(&mut self, touches: &[Touch], first: usize) {
        let guard = touches[first].guard;
        if touches.iter().position(|t| t.guard == guard) != Some(first) {
            return;
        }
        let (mut load, mut capacity, mut size) = (0.0, 0.0, 0.0);
        for (i, touch) in touches.iter().enumerate().filter(|(_, t)| t.guard == guard) {
            let TouchLaw::Friction { limits, ratio } = touch.law else { continue };
            load += ratio * touch.force;
            capacity += ratio.abs() * limits[2];
            size += ratio.abs() * self.force_size(i);
        }
        if load.is_finite() && capacity.is_finite() {
            self.cone.note(f64::abs(load) - capacity, size);
        }
    }

    fn force_size(&self, i: usize) -> f64 {
        self.sizes[i].force.max(WEAK * self.strongest)
    }

    /// Gaps and forces as the integrator follows them, along the whole step.
    fn follow<S: System + ?Sized>(&mut self, step: &Step, system: &mut S, length: f64) {
        let mut breaks = false;
        for (i, guard) in system.guards().iter().enumerate() {
            match guard.kind {
                GuardKind::Contact { .. } if step.modes[i] == Mode::Positive => {
                    let place = self.sizes.iter().map(|s| s.place).fold(0.0, f64::max);
                    self.depth.note(-least(step.guards.row(i), length), place);
                }
                GuardKind::Bound { of, .. } if step.modes[of] == Mode::Zero => {
                    let below = -least(step.guards.row(i), length);
                    let contact = matches!(system.guards()[of].kind, GuardKind::Contact { .. });
                    if contact {
                        self.pull.note(below, self.strongest)
                    } else {
                        self.cone.note(below, self.strongest)
                    }
                    breaks |= below > CLEAR * self.strongest;
                }
                _ => {}
            }
        }
        if breaks {
            step.state_after(length, &mut self.x);
            self.widen((step, length), system);
        }
    }

    /// The audits of what there is.
    pub fn audits(&self, tolerance: f64) -> Vec<Audit> {
        // rounding below, a wrong sign above
        let limit = (STEPPED * tolerance).clamp(1e-9, WIDEST);
        let audit = |key: &str, (en, ru): (&str, &str), found: &Frontier| Audit::at_most(key, Text::new(en, ru), found.worst(), limit);
        let mut list = Vec::new();
        if self.contacts {
            let words = ("contacts: deepest penetration, relative", "контакты: наибольшее внедрение, относительно");
            list.push(audit("contact_gap", words, &self.depth));
            let words = ("contacts: largest pull, relative to the forces", "контакты: наибольшее притяжение относительно сил");
            list.push(audit("contact_force", words, &self.pull));
        }
        if self.frictions {
            let words = (
                "dry friction: largest departure from |F| ≤ μN, against the sliding, relative",
                "сухое трение: наибольшее отступление от |F| ≤ μN против скольжения, относительно",
            );
            list.push(audit("friction_limit", words, &self.cone));
        }
        if self.contacts || self.frictions {
            let words = (
                "contacts and frictions: of force and motion one vanishes, largest residual, relative",
                "контакты и трение: дополнительность (сила или движение равны нулю), наибольшая невязка, относительно",
            );
            list.push(audit("complementarity", words, &self.pairing));
        }
        list
    }
}

/// How far a friction that slides is from its law; at a speed that is rounding, up to `still`, it may be that of either direction.
fn excess(touch: &Touch, [back, forth, _]: [f64; 3], still: f64) -> f64 {
    let [forward, backward] = [(touch.force - forth).abs(), (touch.force + back).abs()];
    match touch.rate[0] {
        rate if rate.abs() <= still => forward.min(backward),
        rate if rate > 0.0 => forward,
        _ => backward,
    }
}

/// A value that the polynomial does not fall below by more than it shows at [`POINTS`] points; 0 where it surely stays positive.
fn least(c: &[f64], h: f64) -> f64 {
    let Some((first, rest)) = c.split_first() else { return 0.0 };
    let change = rest.iter().rev().fold(0.0, |sum, c_k| (sum + c_k.abs()) * h);
    if *first >= change {
        return 0.0;
    }
    let value = |k: usize| c.iter().rev().fold(0.0, |sum, c_k| sum * (h * k as f64 / POINTS as f64) + c_k);
    (0..=POINTS).map(value).fold(0.0, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_below_zero_between_the_ends_is_seen() {
        // (τ - 1/2)² - 1/100
        assert!((least(&[0.24, -1.0, 1.0], 1.0) + 0.01).abs() < 1e-15);
        assert_eq!(least(&[0.25, -1.0, 1.0], 1.0), 0.0);
        assert_eq!(least(&[2.0, -1.0], 1.0), 0.0);
    }
}
