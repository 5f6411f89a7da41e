//! Contacts that repeat each other: two feet of a block that rests, a stop where a guide holds anyway.
//!
//! The motion is unique, the reactions are not: J has dependent rows. Some conditions are then left to the others, which imply them, and their reactions
//! are set: 0 for a contact, 0 or ± its static limit for a friction. By the theory of linear inequalities the forces that agree with all limits, if there
//! are any, include some of exactly this kind (the corners of their polyhedron), so that nothing breaks away too early or too late.

use crate::integrate::crossings::Verdict;
use crate::integrate::taylor::Flow;
use crate::system::{Corner, Corners};
use crate::{Fault, GuardKind, Mode, System};

/// Most trials of shares at one instant.
const TRIALS: usize = 2000;
/// How much later corners and modes are asked for, in undisturbed steps.
pub(super) const LATER: [f64; 3] = [0.0, 1e-6, 1e-3];
/// Times that signs may follow each other: those of one friction, then those that its force changes.
const SIGNS: usize = 4;

/// A contact or friction that can be left to others: its guards.
#[derive(Clone, Copy)]
struct Idle {
    share: usize,
    side: Option<usize>,
}

/// What the corners of the admissible reactions say of modes.
#[derive(PartialEq)]
enum AtCorners {
    /// One of them holds.
    Holds,
    /// Modes of contacts and frictions that all want changed.
    Want(Vec<(usize, Mode)>),
}

impl<S: System + ?Sized> Flow<'_, S> {
    /// Every contact and friction carries itself.
    pub(super) fn carry_all(&mut self) {
        for i in 0..self.modes.len() {
            match self.system.guards()[i].kind {
                GuardKind::Share { .. } => self.modes[i] = Mode::Positive,
                GuardKind::Side { .. } => self.modes[i] = Mode::Zero,
                _ => {}
            }
        }
    }

    /// Tries the present modes, with shares where they repeat each other.
    pub(super) fn settle(&mut self) -> Result<Verdict, Fault> {
        self.carry_all();
        let first = self.attempt()?;
        if first != Verdict::Repeats {
            return Ok(first);
        }
        let modes = self.modes.clone();
        match self.share_by_corners(&modes)? {
            Some(Verdict::Wants(wanted)) if wanted != modes => return Ok(Verdict::Wants(wanted)),
            Some(Verdict::Holds) => return Ok(Verdict::Holds),
            _ => {}
        }
        let list = self.holding();
        // as many as repeat others: leaving out more would loosen what is held
        let count = self.surplus()?.min(list.len());
        let mut chosen: Vec<usize> = (0..count).collect();
        let mut wishes = None;
        let mut trials = 0;
        loop {
            let idle: Vec<Idle> = chosen.iter().map(|&k| list[k]).collect();
            match self.try_sides(&modes, &idle, &mut trials)? {
                Verdict::Holds => return Ok(Verdict::Holds),
                Verdict::Wants(wanted) => wishes = wishes.or(Some(wanted)),
                Verdict::Repeats => {}
            }
            if trials > TRIALS || !next_choice(&mut chosen, list.len()) {
                break;
            }
        }
        self.modes = modes;
        Ok(wishes.map_or(Verdict::Repeats, Verdict::Wants))
    }

    /// Tries the corners of the polyhedron of admissible reactions. Where there are none the machine is not held, and is asked for the modes that it takes; none
    /// where nothing is known.
    fn share_by_corners(&mut self, modes: &[Mode]) -> Result<Option<Verdict>, Fault> {
        let Some(corners) = self.corners_later(modes, 0.0) else { return Ok(None) };
        let limits = corners.list.first().map(|corner| corner.limits.clone());
        let now = self.holds_at_a_corner(modes, &corners.list)?;
        if now == AtCorners::Holds {
            return Ok(Some(Verdict::Holds));
        }
        // where more limits are met than have to be, those that stay met are the ones of a little later
        for share in &LATER[1..] {
            let later = self.corners_later(modes, share * self.natural);
            if let Some(later) = later
                && self.holds_at_a_corner(modes, &later.list)? == AtCorners::Holds
            {
                return Ok(Some(Verdict::Holds));
            }
        }
        self.modes.copy_from_slice(modes);
        if !corners.exact {
            return Ok(None);
        }
        // at the limit of all of them the accelerations do not say yet how it moves
        let likely = match limits {
            Some(limits) => Some(limits),
            None => self.system.likely(self.now.high, &self.base, modes),
        };
        let Some(likely) = likely else { return Ok(None) };
        let mut wanted = modes.to_vec();
        likely.iter().for_each(|(guard, mode)| wanted[*guard] = *mode);
        // what holds the machine at no share of the load changes, however the load is shared
        if let AtCorners::Want(common) = now
            && wanted == modes
        {
            common.iter().for_each(|(guard, mode)| wanted[*guard] = *mode);
        }
        Ok(Some(Verdict::Wants(wanted)))
    }

    /// Tries the present modes with the signs of what presses frictions that they lead to: a share of a load changes them, and they are no choice.
    fn attempt_with_signs(&mut self) -> Result<Verdict, Fault> {
        let mut verdict = self.attempt()?;
        for _ in 0..SIGNS {
            let Verdict::Wants(wanted) = &verdict else { break };
            let sign = |i: usize| matches!(self.system.guards()[i].kind, GuardKind::Normal { .. });
            if !(0..wanted.len()).all(|i| wanted[i] == self.modes[i] || sign(i)) {
                break;
            }
            self.modes.clone_from(wanted);
            verdict = self.attempt()?;
        }
        Ok(verdict)
    }

    /// Corners a little later, the machine going on as it does.
    fn corners_later(&mut self, modes: &[Mode], ahead: f64) -> Option<Corners> {
        let n = self.system.n_coordinates();
        let mut x = self.base.clone();
        (0..n).for_each(|j| x[j] += ahead * self.base[n + j]);
        let relieved: Vec<usize> = (0..self.fired.len()).filter(|i| self.fired[*i]).collect();
        self.system.shares(self.now.after(ahead).high, &x, modes, &relieved)
    }

    /// Whether the modes hold with the shares of one of these corners, which are then in force, or what all of them want instead.
    fn holds_at_a_corner(&mut self, modes: &[Mode], corners: &[Corner]) -> Result<AtCorners, Fault> {
        let mut common: Option<Vec<(usize, Mode)>> = None;
        for corner in corners {
            self.modes.copy_from_slice(modes);
            self.carry_all();
            corner.idle.iter().for_each(|(guard, mode)| self.modes[*guard] = *mode);
            match self.attempt_with_signs()? {
                Verdict::Holds => return Ok(AtCorners::Holds),
                Verdict::Wants(wanted) => {
                    let is_held =
                        |i: &usize| matches!(self.system.guards()[*i].kind, GuardKind::Friction { .. } | GuardKind::Contact { .. });
                    let changes = (0..modes.len()).filter(is_held).filter(|i| wanted[*i] != modes[*i]).map(|i| (i, wanted[i]));
                    common = Some(match common {
                        None => changes.collect(),
                        Some(known) => changes.filter(|change| known.contains(change)).collect(),
                    });
                }
                Verdict::Repeats => {}
            }
        }
        Ok(AtCorners::Want(common.unwrap_or_default()))
    }

    /// Contacts and frictions that repeat others in the present modes.
    pub(super) fn surplus(&mut self) -> Result<usize, Fault> {
        if self.has_contacts() { self.system.repeats(self.now.high, &self.base, &self.modes) } else { Ok(0) }
    }

    /// Frictions first: what presses is to be found from the contacts.
    fn holding(&self) -> Vec<Idle> {
        let guards = self.system.guards();
        let side = |of: usize| guards.iter().position(|g| g.kind == GuardKind::Side { of });
        let shares = guards.iter().enumerate().filter_map(|(share, g)| match g.kind {
            GuardKind::Share { of } if self.modes[of] == Mode::Zero => Some(Idle { share, side: side(of) }),
            _ => None,
        });
        let (frictions, contacts): (Vec<Idle>, Vec<Idle>) = shares.partition(|idle| idle.side.is_some());
        frictions.into_iter().rev().chain(contacts.into_iter().rev()).collect()
    }

    /// The idle ones at zero, then at their limits.
    fn try_sides(&mut self, modes: &[Mode], idle: &[Idle], trials: &mut usize) -> Result<Verdict, Fault> {
        let sides: Vec<usize> = idle.iter().filter_map(|i| i.side).collect();
        let mut first = None;
        for code in 0..3usize.saturating_pow(sides.len() as u32) {
            *trials += 1;
            self.modes.clone_from_slice(modes);
            idle.iter().for_each(|i| self.modes[i.share] = Mode::Zero);
            let mut digits = code;
            for &side in &sides {
                self.modes[side] = [Mode::Zero, Mode::Positive, Mode::Negative][digits % 3];
                digits /= 3;
            }
            match self.attempt_with_signs()? {
                Verdict::Holds => return Ok(Verdict::Holds),
                Verdict::Repeats => return Ok(Verdict::Repeats),
                Verdict::Wants(wanted) => first = first.or(Some(wanted)),
            }
            if *trials > TRIALS {
                break;
            }
        }
        Ok(first.map_or(Verdict::Repeats, Verdict::Wants))
    }

    /// A friction that no closed contact presses.
    pub(crate) fn is_off(&self, i: usize) -> bool {
        is_off(&self.system.guards()[i].kind, &self.modes)
    }
}

/// A friction whose contacts are all open in these modes.
pub(crate) fn is_off(kind: &GuardKind, modes: &[Mode]) -> bool {
    match kind {
        GuardKind::Friction { pressed, .. } => !pressed.is_empty() && pressed.iter().all(|gap| modes[*gap] == Mode::Positive),
        _ => false,
    }
}

/// The next ascending choice of indices below n; false after the last.
fn next_choice(chosen: &mut [usize], n: usize) -> bool {
    let k = chosen.len();
    let Some(i) = (0..k).rev().find(|&i| chosen[i] + k - i < n) else { return false };
    chosen[i] += 1;
    for j in i + 1..k {
        chosen[j] = chosen[j - 1] + 1;
    }
    true
}
