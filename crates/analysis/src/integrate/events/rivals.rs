//! Whether another motion obeys the laws too, where modes have just been decided.
//!
//! A friction pressed by |N| of a reaction that friction itself changes has N = b/A in one set of modes and N = b/A' in another. Where A and A' differ in
//! sign, both are admissible, or none is (Painlevé, Klein). One is followed: sticking before sliding, as before the event before other than before. That there
//! is another one is found by enumeration over the frictions pressed by reactions: their modes where they stand on their surfaces, the signs of what presses.
//!
//! A contact that slides and whose own friction presses it on (A < 0) may be closed with N = −a₀/A > 0 where, open, it leaves with a₀ > 0: Painlevé's
//! indeterminate case. Closed it stays; that it could leave is found by opening it.
//!
//! A friction at rest that only its static limit holds has no rival: that limit is there to hold it.

use crate::integrate::taylor::{Flow, Work};
use crate::system::TouchLaw;
use crate::{Fault, GuardKind, Mode, System, Tie};
use algebra::arrange::Arrange;

use crate::integrate::crossings::{Rival, opposite};

/// Most sets that are tried at an instant; those that differ in least come first.
const TRIED: usize = 64;
/// Share of the kinetic limit that a friction at rest must leave free: at the limit, sliding without acceleration is rest but for rounding.
const FREE: f64 = 1e-6;

/// A friction that a reaction presses, which keeps no sign of its own.
struct Pressed {
    friction: usize,
    normals: Vec<usize>,
}

/// Modes of some guards.
type Set = Vec<(usize, Mode)>;

/// What trials of modes change in a flow.
struct Kept {
    x: Vec<f64>,
    low: Vec<f64>,
    modes: Vec<Mode>,
    leaving: Vec<bool>,
    touched: Vec<bool>,
    deflation: Vec<usize>,
    guard_scale: Vec<f64>,
    ties: Vec<Tie>,
    weighed: bool,
    lengths: [f64; 2],
    /// What is counted is the work of the motion.
    work: Work,
}

impl<S: System + ?Sized> Flow<'_, S> {
    /// Looks for another admissible set; the present one, which holds, stays with its expansion.
    pub(super) fn look_for_rivals(&mut self) -> Result<(), Fault> {
        self.rivals.clear();
        let (pressed, rubbing) = (self.pressed_by_reactions(), self.rubbing_contacts());
        if pressed.is_empty() && rubbing.is_empty() {
            return Ok(());
        }
        let mut sets = self.sets(&pressed);
        let kept = self.kept();
        let ties = if rubbing.is_empty() { Vec::new() } else { self.system.ties(self.now.high, &kept.x, &kept.modes) };
        let leaving: Vec<usize> = rubbing.into_iter().filter(|contact| self.would_leave(*contact, (&kept, &ties))).collect();
        sets.extend(leaving.into_iter().map(|contact| vec![(contact, Mode::Positive)]));
        let rival = sets.iter().find(|set| self.is_rival(set, &kept));
        self.rivals = rival.map_or_else(Vec::new, |set| differing(set, &pressed, &kept.modes));
        self.return_to(kept)
    }

    /// Closed contacts that press a friction that slides.
    fn rubbing_contacts(&self) -> Vec<usize> {
        let slides = |(i, guard): (usize, &crate::Guard)| match &guard.kind {
            GuardKind::Friction { pressed, .. } if self.modes[i] != Mode::Zero => pressed.clone(),
            _ => Vec::new(),
        };
        let mut list: Vec<usize> = self.system.guards().iter().enumerate().flat_map(slides).collect();
        list.retain(|contact| self.modes[*contact] == Mode::Zero);
        list.sort_unstable();
        list.dedup();
        list
    }

    /// Whether a closed contact, opened, leaves at once: its gap's acceleration without its force, beyond rounding.
    fn would_leave(&mut self, contact: usize, (kept, ties): (&Kept, &[(usize, Tie)])) -> bool {
        let tie = ties.iter().find(|(guard, _)| *guard == contact);
        self.put_back(kept);
        self.modes[contact] = Mode::Positive;
        if self.system.expand(self.now.high, &self.base, &self.modes, 2).is_err() {
            return false;
        }
        let acceleration = 2.0 * self.system.guard(contact).get(2).copied().unwrap_or(0.0);
        acceleration > tie.map_or(0.0, |(_, tie)| tie.acceleration)
    }

    fn pressed_by_reactions(&self) -> Vec<Pressed> {
        let guards = self.system.guards();
        let normals =
            |i: usize| (0..guards.len()).filter(|&k| guards[k].kind == GuardKind::Normal { of: i, single: true }).collect::<Vec<_>>();
        let free = |i: &usize| matches!(&guards[*i].kind, GuardKind::Friction { pressed, .. } if pressed.is_empty());
        let one = |i: usize| Pressed { friction: i, normals: normals(i) };
        (0..guards.len()).filter(free).map(one).filter(|p| !p.normals.is_empty()).collect()
    }

    /// Sets other than the present one.
    fn sets(&mut self, pressed: &[Pressed]) -> Vec<Set> {
        let held = self.held_by_static_limits();
        let mut all: Vec<(usize, Set)> = vec![(0, Vec::new())];
        for p in pressed {
            let options = self.options_of(p, &held);
            let with = |(n, set): &(usize, Set), (more, own): &(usize, Set)| (n + more, [&set[..], &own[..]].concat());
            all = all.iter().flat_map(|set| options.iter().map(move |own| with(set, own))).collect();
            all.arrange_by_key(|(differences, _)| *differences);
            all.truncate(TRIED);
        }
        all.into_iter().filter(|(differences, _)| *differences > 0).map(|(_, set)| set).collect()
    }

    /// What one friction may do, with the number of its differences. While it sticks nothing depends on the sign of what presses it.
    fn options_of(&self, p: &Pressed, held: &[usize]) -> Vec<(usize, Set)> {
        let now = self.modes[p.friction];
        let modes = match (now, self.touched[p.friction]) {
            (Mode::Zero, _) if held.contains(&p.friction) => vec![Mode::Zero],
            (Mode::Zero, _) | (_, true) => vec![Mode::Zero, Mode::Positive, Mode::Negative],
            _ => vec![now],
        };
        let mut all = Vec::new();
        for mode in modes {
            let mut own: Vec<(usize, Set)> = vec![(usize::from(mode != now), vec![(p.friction, mode)])];
            for &n in p.normals.iter().filter(|_| mode != Mode::Zero) {
                let sign = self.modes[n];
                let with = |(k, set): &(usize, Set), turned: usize, sign: Mode| (k + turned, [&set[..], &[(n, sign)]].concat());
                own = own.iter().flat_map(|set| [with(set, 0, sign), with(set, 1, opposite(sign))]).collect();
            }
            all.extend(own);
        }
        all
    }

    /// Frictions at rest whose force the kinetic limit would not hold.
    fn held_by_static_limits(&mut self) -> Vec<usize> {
        let resting = |(i, guard): (usize, &crate::Guard)| {
            (matches!(guard.kind, GuardKind::Friction { .. }) && self.modes[i] == Mode::Zero).then_some(i)
        };
        let resting: Vec<usize> = self.system.guards().iter().enumerate().filter_map(resting).collect();
        if resting.is_empty() {
            return resting;
        }
        let n = self.system.n_coordinates();
        let second = |k: usize| self.system.state(n + k).get(1).copied().unwrap_or(0.0);
        let accelerations: Vec<f64> = (0..n).map(second).collect();
        let Some(touches) = self.system.touches(self.now.high, &self.x, &accelerations, &self.modes) else { return resting };
        let free = |i: &usize| {
            touches.iter().filter(|touch| touch.guard == *i).all(|touch| match touch.law {
                TouchLaw::Friction { limits: [back, forth, _], .. } => touch.force.abs() <= (1.0 - FREE) * back.min(forth),
                TouchLaw::Contact { .. } => true,
            })
        };
        resting.into_iter().filter(|i| !free(i)).collect()
    }

    fn is_rival(&mut self, set: &Set, kept: &Kept) -> bool {
        self.put_back(kept);
        set.iter().for_each(|(i, mode)| self.modes[*i] = *mode);
        // cheap, and nearly always enough: the signs of what presses in this set
        if self.system.expand(self.now.high, &self.base, &self.modes, 1).is_err() {
            return false;
        }
        let normal = |i: usize| matches!(self.system.guards()[i].kind, GuardKind::Normal { .. });
        let agrees = |(i, mode): &(usize, Mode)| !normal(*i) || self.system.guard(*i).first().is_some_and(|v| Mode::of(*v) == *mode);
        if !set.iter().all(agrees) {
            return false;
        }
        set.iter().for_each(|(i, mode)| self.leaving[*i] |= kept.modes[*i] == Mode::Zero && *mode != Mode::Zero);
        let (on, modes): (Vec<usize>, Vec<Mode>) = set.iter().copied().unzip();
        self.try_combination((&on, &modes), &kept.modes)
            && set.iter().all(|(i, _)| !matches!(self.system.guards()[*i].kind, GuardKind::Normal { .. }) || self.presses(*i))
    }

    fn kept(&self) -> Kept {
        Kept {
            x: self.x.clone(),
            low: self.low().to_vec(),
            modes: self.modes.clone(),
            leaving: self.leaving.clone(),
            touched: self.touched.clone(),
            deflation: self.deflation.clone(),
            guard_scale: self.guard_scale.clone(),
            ties: self.ties.clone(),
            weighed: self.weighed,
            lengths: [self.natural, self.loads],
            work: self.work.clone(),
        }
    }

    fn put_back(&mut self, kept: &Kept) {
        self.x.clone_from(&kept.x);
        self.put_low(&kept.low);
        self.modes.clone_from(&kept.modes);
        self.leaving.clone_from(&kept.leaving);
        self.touched.clone_from(&kept.touched);
        self.deflation.clone_from(&kept.deflation);
        self.guard_scale.clone_from(&kept.guard_scale);
        self.ties.clone_from(&kept.ties);
        self.weighed = kept.weighed;
        [self.natural, self.loads] = kept.lengths;
        self.work.clone_from(&kept.work);
    }

    /// The system, too, goes back: what it holds by its conditions is chosen where it moves a state onto them.
    fn return_to(&mut self, kept: Kept) -> Result<(), Fault> {
        self.put_back(&kept);
        self.x.clone_from(&self.base);
        self.project_here()?;
        self.put_back(&kept);
        self.expand_here()
    }
}

/// What the frictions do that are not as in `found`.
fn differing(set: &Set, pressed: &[Pressed], found: &[Mode]) -> Vec<Rival> {
    let of = |i: usize| set.iter().find(|(k, _)| *k == i).map_or(found[i], |(_, mode)| *mode);
    let one = |p: &Pressed| Rival { guard: p.friction, mode: of(p.friction), turned: p.normals.iter().any(|&n| of(n) != found[n]) };
    let frictions = pressed.iter().map(one).filter(|rival| rival.turned || rival.mode != found[rival.guard]);
    let alone = |(guard, _): &&(usize, Mode)| pressed.iter().all(|p| p.friction != *guard && !p.normals.contains(guard));
    let contacts = set.iter().filter(alone).map(|(guard, mode)| Rival { guard: *guard, mode: *mode, turned: false });
    frictions.chain(contacts).collect()
}
