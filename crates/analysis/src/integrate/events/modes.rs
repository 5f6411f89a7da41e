//! Which modes hold after an event, or at the start.
//!
//! Contacts and frictions of one instant are one complementarity problem. A combination of modes is its solution when the flow *in* these modes keeps
//! every guard on the side its mode says (`sides.rs`): contact forces and friction limits not negative, gaps and sliding speeds going where the modes say,
//! ties of the accelerations decided by higher derivatives. It is solved by complementary pivoting: each trial solves the equations of motion in its modes, and
//! what the result contradicts is exchanged. Tried in this order, so that sticking and closed contacts are preferred where several solutions exist:
//!
//! 1. what the event suggests (a touched switch changes side, a friction that has come to rest sticks, a crossed bound releases its owner, a contact
//!    closes unless it rebounds), at the start `Zero` for everything on its surface; then all that the flow of the last trial asks for, at once;
//! 2. the same from the beginning, one exchange at a time, the first guard first (K. G. Murty, Linear Complementarity, 1988, chapter 4: ends for contacts
//!    without friction whatever the order of forces is);
//! 3. all combinations of the guards on their surfaces, those with most contacts closed and sticking first.
//!
//! Where the set found departs from the suggestion, nearer ones are tried as well (`nearest.rs`).
//!
//! When none is admissible the switch chatters, or the contacts have no consistent state (self-locking, Painlevé).
//!
//! Every trial begins from the state after the impacts and moves it exactly onto the conditions of its modes ([`System::project`]).

use crate::integrate::taylor::Flow;
use crate::{Fault, GuardKind, Mode, System, Tie};
use algebra::arrange::Arrange;

use super::contacts::{self, LATER};
use crate::integrate::crossings::{Change, Impact, Switch, Verdict, opposite};

/// Most combinations that are tried one by one: all of five contacts with friction, of more those with few changes.
const COMBINED: usize = 2000;

/// Modes that guards on their surfaces may take together.
struct Combination {
    /// How many leave `Zero`.
    changes: usize,
    /// Place in the order of all.
    code: u128,
    guards: Vec<usize>,
    modes: Vec<Mode>,
}

/// Share of the loads by which a limit may be exceeded where no set of modes keeps all laws to rounding: far below the limit of the audits.
const NEARLY: f64 = 1e-11;

/// The code of equations that leave motion or reactions open.
const UNDETERMINED: &str = "P013";

/// Surely longer than any chain of wishes that ends.
fn patience(guards: usize) -> usize {
    16 + 4 * guards
}

impl<S: System + ?Sized> Flow<'_, S> {
    /// Decides all modes at the start, where nothing is known yet.
    pub(crate) fn decide_at_start(&mut self) -> Result<(), Fault> {
        self.before.clone_from(&self.x);
        self.touched.fill(false);
        self.sides_of_switches(Mode::Zero);
        if self.has_contacts() {
            self.sides_of_switches(Mode::Positive);
            self.expand_gaps()?;
            self.measure()?;
            self.sides_at_start()?;
        }
        self.modes_before.clone_from(&self.modes);
        let impacts = self.collide()?;
        self.base.clone_from(&self.x);
        self.search()?;
        let rests = self.come_to_rest(&impacts)?;
        self.look_for_rivals()?;
        self.list(&impacts, &rests, Listed::Impacts);
        Ok(())
    }

    /// Expands for gaps and sliding speeds, which need no forces. Where the motion is not determined with all contacts open (a rope by which a motor hauls) they are those
    /// with all of them closed, or with the first that determines it.
    fn expand_gaps(&mut self) -> Result<(), Fault> {
        let Err(fault) = self.expand_here() else { return Ok(()) };
        if fault.code != UNDETERMINED {
            return Err(fault);
        }
        let open = self.modes.clone();
        let contacts = self.open_contacts();
        for closed in std::iter::once(contacts.clone()).chain(contacts.iter().map(|i| vec![*i])) {
            self.modes.clone_from(&open);
            closed.iter().for_each(|i| self.modes[*i] = Mode::Zero);
            if self.expand_here().is_ok() {
                return Ok(());
            }
        }
        Err(fault)
    }

    /// Contacts that are open in the present modes.
    fn open_contacts(&self) -> Vec<usize> {
        let guards = self.system.guards();
        (0..guards.len()).filter(|&i| matches!(guards[i].kind, GuardKind::Contact { .. }) && self.modes[i] != Mode::Zero).collect()
    }

    /// A motion that is not determined, by the contacts whose closing would determine it: what a slack rope should haul has nothing to act through.
    fn by_open_contacts(&mut self, fault: Fault) -> Fault {
        if fault.code != UNDETERMINED {
            return fault;
        }
        let open = self.modes.clone();
        let contacts = self.open_contacts();
        for closed in contacts.iter().map(|i| vec![*i]).chain(std::iter::once(contacts.clone())) {
            self.modes.clone_from(&open);
            closed.iter().for_each(|i| self.modes[*i] = Mode::Zero);
            if !closed.is_empty() && self.system.expand(self.now.high, &self.x, &self.modes, 1).is_ok() {
                let names: Vec<&words::Text> = closed.iter().map(|i| &self.system.guards()[*i].name).collect();
                let fault = fault.while_open(&names, self.now.high);
                self.modes.clone_from(&open);
                return fault;
            }
        }
        self.modes.clone_from(&open);
        fault
    }

    /// Switches away from their surfaces take their sides; the formula on the surface need not have a value here. The other guards become `others`.
    fn sides_of_switches(&mut self, others: Mode) {
        self.modes.fill(others);
        self.carry_all();
        let Some(sides) = self.system.sides(self.now.high, &self.x) else { return };
        for (i, side) in sides.into_iter().enumerate() {
            if self.system.guards()[i].kind == GuardKind::Switch && side != Mode::Zero {
                self.modes[i] = side;
            }
        }
    }

    /// Decides the modes after the guards in `touched` have reached their surfaces, and records what changed.
    pub(crate) fn decide(&mut self) -> Result<(), Fault> {
        self.before.clone_from(&self.x);
        self.modes_before.clone_from(&self.modes);
        self.ties.fill(Tie::default());
        let impacts = self.collide()?;
        self.base.clone_from(&self.x);
        if !self.shifts_load()? {
            self.suggest();
            self.search()?;
        }
        let rests = self.come_to_rest(&impacts)?;
        self.look_for_rivals()?;
        self.list(&impacts, &rests, Listed::All);
        Ok(())
    }

    /// Whether the machine goes on in its modes although a limit has been reached: others that hold the same motion take the load.
    fn shifts_load(&mut self) -> Result<bool, Fault> {
        // what presses a friction vanishes with the force of its contact
        let limits = |i: &usize| matches!(self.system.guards()[*i].kind, GuardKind::Bound { .. } | GuardKind::Normal { .. });
        let only_limits = (0..self.modes.len()).filter(|i| self.touched[*i]).all(|i| limits(&i)) && self.touched.contains(&true);
        if !only_limits || self.x != self.before || self.modes != self.modes_before || !self.shares_load() {
            return Ok(false);
        }
        self.note_fired();
        self.leaving.fill(false);
        let touched = self.touched.clone();
        self.grounded.fill(false);
        let modes = self.modes.clone();
        let held = matches!(self.settle(), Ok(Verdict::Holds));
        if !held {
            self.x.clone_from(&self.base);
            (self.modes, self.touched) = (modes, touched);
            self.system.expand(self.now.high, &self.x, &self.modes, 1)?;
        }
        Ok(held)
    }

    /// Whether something is left to others in the present modes.
    fn shares_load(&self) -> bool {
        let idle = |(guard, mode): (&crate::Guard, &Mode)| matches!(guard.kind, GuardKind::Share { .. }) && *mode == Mode::Zero;
        self.system.guards().iter().zip(&self.modes).any(idle)
    }

    /// The first trial after an event.
    fn suggest(&mut self) {
        self.note_fired();
        for i in 0..self.modes.len() {
            let off = self.is_off(i);
            let guard = &self.system.guards()[i];
            self.leaving[i] = false;
            match guard.kind {
                GuardKind::Bound { .. } => self.modes[i] = Mode::Positive,
                GuardKind::Friction { .. } if off => self.touched[i] = false,
                // what moved without a load has just come under one
                GuardKind::Friction { .. } if contacts::is_off(&guard.kind, &self.modes_before) && !self.touched[i] => {
                    self.load_friction(i)
                }
                GuardKind::Friction { .. } if self.touched[i] => self.modes[i] = Mode::Zero,
                // a rebound was decided with the impact
                GuardKind::Friction { .. } | GuardKind::Contact { .. } => {}
                // its sign follows; that it has just vanished is known
                GuardKind::Normal { .. } => {}
                GuardKind::Share { .. } | GuardKind::Side { .. } => self.touched[i] = false,
                GuardKind::Switch if self.modes[i] == Mode::Zero => {
                    self.touched[i] |= guard.scheduled.is_none() && !self.system.guard(i).is_empty();
                }
                GuardKind::Switch if self.touched[i] => self.modes[i] = opposite(self.modes[i]),
                GuardKind::Switch => {}
            }
        }
        for i in 0..self.modes.len() {
            if let GuardKind::Bound { of, exit } = self.system.guards()[i].kind
                && self.touched[i]
                && self.modes[of] == Mode::Zero
            {
                self.modes[of] = exit;
                self.leaving[of] = true;
            }
        }
        for i in 0..self.modes.len() {
            let holds = matches!(self.system.guards()[i].kind, GuardKind::Friction { .. } | GuardKind::Contact { .. });
            self.touched[i] |= holds && self.modes[i] == Mode::Zero || self.leaving[i];
        }
    }

    /// What the event is about: guards that were crossed, and owners of crossed bounds; everything after an impact.
    fn note_fired(&mut self) {
        let struck = self.x != self.before;
        self.fired.iter_mut().zip(&self.touched).for_each(|(fired, touched)| *fired = struck || *touched);
        for (guard, _) in self.system.guards().iter().zip(&self.touched).filter(|(_, touched)| **touched) {
            if let GuardKind::Bound { of, .. } = guard.kind {
                self.fired[of] = true;
            }
        }
    }

    /// Mode of a friction by its speed.
    fn load_friction(&mut self, i: usize) {
        self.touched[i] = self.is_on_surface(i);
        let speed = self.system.guard(i).first().copied().unwrap_or(0.0);
        self.modes[i] = if self.touched[i] { Mode::Zero } else { Mode::of(speed) };
    }

    /// Searches admissible modes, beginning with the present ones; leaves their expansion in the system and their state in the flow.
    pub(super) fn search(&mut self) -> Result<(), Fault> {
        let first = (self.modes.clone(), self.leaving.clone());
        self.grounded.clone_from(&self.touched);
        self.met.clone_from(&self.touched);
        let mut trail = Trail::default();
        if self.follow(&mut trail, Exchange::All) {
            return self.prefer(&first.0, &trail.tried);
        }
        let last = std::mem::replace(&mut self.modes, first.0.clone());
        self.leaving.clone_from(&first.1);
        if self.follow(&mut trail, Exchange::First) || self.try_all_combinations(&last) {
            return self.prefer(&first.0, &trail.tried);
        }
        if self.follow_proposals(&mut trail) {
            return self.prefer(&first.0, &trail.tried);
        }
        // within a few roundings of a limit one trial may find it exceeded and the other no motion behind it
        self.loosen();
        (self.modes, self.leaving) = first.clone();
        if self.follow(&mut trail, Exchange::All) {
            return self.prefer(&first.0, &trail.tried);
        }
        let guard = trail.suspect.or_else(|| self.touched.iter().position(|&t| t)).or(trail.changing).unwrap_or(0);
        Err(match trail.fault {
            Some(fault) => self.by_open_contacts(fault),
            None => self.no_modes(guard),
        })
    }

    /// Trials that begin with the modes that the accelerations ask for, now and a little later: where everything breaks away all accelerations are still zero.
    fn follow_proposals(&mut self, trail: &mut Trail) -> bool {
        let may_hold = |i: usize| match self.system.guards()[i].kind {
            GuardKind::Friction { .. } => self.touched[i] || self.modes_before[i] == Mode::Zero,
            GuardKind::Contact { .. } => (self.touched[i] || self.modes_before[i] == Mode::Zero) && !self.rebounds[i],
            _ => false,
        };
        let held: Vec<Mode> = (0..self.modes.len()).map(|i| if may_hold(i) { Mode::Zero } else { self.modes[i] }).collect();
        let n = self.system.n_coordinates();
        for share in LATER {
            let ahead = share * self.natural;
            let mut x = self.base.clone();
            (0..n).for_each(|j| x[j] += ahead * self.base[n + j]);
            let Some(likely) = self.system.likely(self.now.after(ahead).high, &x, &held) else { return false };
            let mut wanted = held.clone();
            likely.iter().for_each(|(guard, mode)| wanted[*guard] = *mode);
            self.leaving.fill(false);
            self.take_wishes(&held, wanted);
            if self.follow(trail, Exchange::All) {
                return true;
            }
        }
        false
    }

    /// Lets limits be exceeded by a small share of the largest load of the trials until modes are decided again.
    fn loosen(&mut self) {
        let is_load = |kind: GuardKind| matches!(kind, GuardKind::Bound { .. } | GuardKind::Normal { .. });
        let loads = self.system.guards().iter().zip(&self.guard_scale).filter(|(guard, _)| is_load(guard.kind.clone()));
        let force = NEARLY * loads.fold(0.0_f64, |most, (_, scale)| most.max(*scale));
        self.ties.iter_mut().for_each(|tie| tie.force = tie.force.max(force));
    }

    /// Takes the wishes of one trial after another; true when a trial holds.
    fn follow(&mut self, trail: &mut Trail, exchange: Exchange) -> bool {
        let earlier = trail.tried.len();
        while !trail.tried[earlier..].contains(&self.modes) && trail.tried.len() - earlier <= patience(self.modes.len()) {
            trail.tried.push(self.modes.clone());
            match self.settle() {
                Ok(Verdict::Holds) => return true,
                Ok(Verdict::Wants(wanted)) => {
                    let before = &trail.tried[trail.tried.len() - 1];
                    let suspects = |i: &usize| self.touched[*i] && wanted[*i] != before[*i];
                    trail.suspect = trail.suspect.or_else(|| (0..wanted.len()).rev().find(suspects));
                    trail.changing = trail.changing.or_else(|| (0..wanted.len()).find(|&i| wanted[i] != before[i]));
                    let exchanged = self.exchanged(before, wanted, exchange);
                    self.take_wishes(before, exchanged);
                }
                Ok(Verdict::Repeats) => return false,
                Err(fault) => {
                    trail.fault = trail.fault.take().or(Some(fault));
                    return false;
                }
            }
        }
        false
    }

    /// The wishes that are granted. The sign of a normal force is no choice: it follows.
    fn exchanged(&self, before: &[Mode], wanted: Vec<Mode>, exchange: Exchange) -> Vec<Mode> {
        let differs = |i: &usize| wanted[*i] != before[*i] && self.is_choice(*i);
        let Some(first) = (0..wanted.len()).find(differs) else { return wanted };
        match exchange {
            Exchange::All => wanted,
            Exchange::First => (0..wanted.len()).map(|i| if i == first || !self.is_choice(i) { wanted[i] } else { before[i] }).collect(),
        }
    }

    fn is_choice(&self, i: usize) -> bool {
        !matches!(self.system.guards()[i].kind, GuardKind::Normal { .. } | GuardKind::Share { .. } | GuardKind::Side { .. })
    }

    pub(super) fn no_modes(&self, guard: usize) -> Fault {
        let Some(of) = self.system.guards().get(guard) else { return Fault::chattering(&words::Text::default(), self.now.high) };
        let contacts: Vec<&words::Text> =
            (0..self.modes.len()).filter(|&i| self.takes_part(i)).map(|i| &self.system.guards()[i].name).collect();
        match of.kind {
            GuardKind::Switch => Fault::chattering(&of.name, self.now.high),
            _ if contacts.is_empty() => Fault::no_contact_state(&[&of.name], self.now.high),
            _ => Fault::no_contact_state(&contacts, self.now.high),
        }
    }

    /// Contacts on their surfaces, and frictions that they press or that stand on theirs.
    fn takes_part(&self, i: usize) -> bool {
        let closed = |i: usize| self.touched[i] && !self.rebounds[i];
        match &self.system.guards()[i].kind {
            GuardKind::Contact { .. } => closed(i),
            GuardKind::Friction { pressed, .. } => self.touched[i] || pressed.iter().any(|gap| closed(*gap)),
            _ => false,
        }
    }

    fn take_wishes(&mut self, before: &[Mode], wanted: Vec<Mode>) {
        for (i, (mode, before)) in wanted.iter().zip(before).enumerate() {
            self.leaving[i] |= *before == Mode::Zero && *mode != Mode::Zero;
        }
        self.modes = wanted;
    }

    /// Expands in the present modes and judges them.
    pub(super) fn attempt(&mut self) -> Result<Verdict, Fault> {
        self.x.clone_from(&self.base);
        // what another trial has moved onto its surface is not there in this one
        self.met.iter_mut().zip(&self.touched).for_each(|(met, touched)| *met |= touched);
        self.touched.clone_from(&self.grounded);
        if self.surplus()? > 0 {
            return Ok(Verdict::Repeats);
        }
        if let Some(wanted) = self.torn_off()? {
            return Ok(Verdict::Wants(wanted));
        }
        self.project_here()?;
        self.expand_here()?;
        self.measure()?;
        // the other wishes mean nothing while a friction is taken with the wrong sign of what presses it
        let signed = self.signed();
        if signed != self.modes {
            return Ok(Verdict::Wants(signed));
        }
        if (0..self.modes.len()).any(|i| self.is_loose(i)) {
            return Ok(Verdict::Repeats);
        }
        let wanted = self.wishes();
        if wanted != self.modes {
            return Ok(Verdict::Wants(wanted));
        }
        for i in 0..self.modes.len() {
            self.deflation[i] = self.roots_here(i);
        }
        Ok(Verdict::Holds)
    }

    /// Combinations of the guards on their surfaces, the others as their values say: those with most contacts closed and sticking first.
    fn try_all_combinations(&mut self, others: &[Mode]) -> bool {
        let on: Vec<usize> = (0..self.modes.len()).filter(|&i| self.met[i] && !self.rebounds[i] && self.options(i) > 1).collect();
        let mut all: Vec<Combination> = Vec::new();
        for changes in 0..=on.len() {
            let mut chosen = vec![Mode::Zero; on.len()];
            self.combine(&on, (0, changes), &mut chosen, &mut all);
            if all.len() >= COMBINED {
                break;
            }
        }
        all.arrange_by_key(|one| (one.changes, one.code));
        !on.is_empty() && all.iter().any(|one| self.try_combination((&one.guards, &one.modes), others))
    }

    /// Combinations in which so many of the guards from a place on leave `Zero`. A friction that no closed contact presses follows its speed.
    fn combine(&self, on: &[usize], (from, changes): (usize, usize), chosen: &mut [Mode], all: &mut Vec<Combination>) {
        if changes == 0 {
            let opens = |gap: &usize| on.iter().position(|i| i == gap).is_some_and(|k| chosen[k] == Mode::Positive);
            let off = |i: usize| match &self.system.guards()[i].kind {
                GuardKind::Friction { pressed, .. } => !pressed.is_empty() && pressed.iter().all(opens),
                _ => false,
            };
            if on.iter().zip(chosen.iter()).any(|(i, mode)| *mode != Mode::Zero && off(*i)) || all.len() >= COMBINED {
                return;
            }
            let digit = |mode: Mode| [Mode::Zero, Mode::Positive, Mode::Negative].iter().position(|m| *m == mode).unwrap_or(0) as u128;
            let code = on
                .iter()
                .zip(chosen.iter())
                .rev()
                .fold(0_u128, |code, (i, mode)| code.wrapping_mul(self.options(*i) as u128).wrapping_add(digit(*mode)));
            let (guards, modes) = on.iter().copied().zip(chosen.iter().copied()).filter(|(i, _)| !off(*i)).unzip();
            let changes = chosen.iter().filter(|mode| **mode != Mode::Zero).count();
            all.push(Combination { changes, code, guards, modes });
            return;
        }
        for k in from..on.len() {
            for mode in [Mode::Positive, Mode::Negative].into_iter().take(self.options(on[k]) - 1) {
                chosen[k] = mode;
                self.combine(on, (k + 1, changes - 1), chosen, all);
            }
            chosen[k] = Mode::Zero;
        }
    }

    pub(super) fn try_combination(&mut self, (on, modes): (&[usize], &[Mode]), others: &[Mode]) -> bool {
        self.modes.copy_from_slice(others);
        on.iter().zip(modes).for_each(|(&i, mode)| self.modes[i] = *mode);
        // the others may follow the combination: a few times with what they want
        for _ in 0..4 {
            let before = self.modes.clone();
            match self.settle() {
                Ok(Verdict::Holds) => return true,
                Ok(Verdict::Wants(wanted)) if on.iter().all(|&i| wanted[i] == before[i]) && wanted != before => {
                    self.take_wishes(&before, wanted);
                }
                _ => return false,
            }
        }
        false
    }

    /// Number of modes that a guard on its surface may take: `Zero`, `Positive`, `Negative`.
    fn options(&self, i: usize) -> usize {
        let guard = &self.system.guards()[i];
        match guard.kind {
            _ if guard.scheduled.is_some() => 1,
            GuardKind::Switch => 3,
            GuardKind::Friction { .. } => 3,
            GuardKind::Contact { .. } => 2,
            _ => 1,
        }
    }

    /// Puts the changes into [`Flow::switches`]: impacts first, in the order of the guards.
    fn list(&mut self, impacts: &[Impact], rests: &[(usize, f64)], listed: Listed) {
        let t = self.now.high;
        let impacts: Vec<&Impact> = impacts.iter().filter(|impact| !impact.silent).collect();
        for impact in &impacts {
            let guard = impact.guard;
            let after = if rests.iter().any(|r| r.0 == guard) { Mode::Positive } else { self.modes[guard] };
            let change = Change::Impact { rates: impact.rates, impulse: impact.impulse };
            self.switches.push(Switch { t, guard, before: self.modes_before[guard], after, change });
        }
        for &(guard, limit) in rests {
            let change = Change::Rests { limit };
            self.switches.push(Switch { t, guard, before: Mode::Positive, after: self.modes[guard], change });
        }
        for (guard, mode) in self.modes_before.iter().copied().enumerate() {
            let told = impacts.iter().any(|impact| impact.guard == guard) || rests.iter().any(|r| r.0 == guard);
            if listed == Listed::All && !told && self.is_told(guard) {
                let jolts = self.jolted && self.system.guards()[guard].kind == GuardKind::Switch;
                let change = match jolts {
                    true => Change::Jolt,
                    false if self.dies_away(guard) => Change::Rests { limit: t },
                    false => Change::Mode,
                };
                self.switches.push(Switch { t, guard, before: mode, after: self.modes[guard], change });
            }
        }
        self.work.switches += self.switches.len() as u64;
    }

    /// Whether contacts alone press a friction: its normal force keeps its sign.
    fn is_of_contacts(&self, friction: usize) -> bool {
        matches!(&self.system.guards()[friction].kind, GuardKind::Friction { pressed, .. } if !pressed.is_empty())
    }

    /// Whether a change of mode means something to the user.
    fn is_told(&self, guard: usize) -> bool {
        let (before, after) = (self.modes_before[guard], self.modes[guard]);
        match &self.system.guards()[guard].kind {
            GuardKind::Share { .. } | GuardKind::Side { .. } => false,
            GuardKind::Normal { of, .. } => after == opposite(before) && after != Mode::Zero && !self.is_of_contacts(*of),
            kind @ GuardKind::Friction { .. } => {
                let were = [&self.modes_before, &self.modes].map(|modes| contacts::is_off(kind, modes));
                before != after && !were[1] && !(were[0] && after != Mode::Zero)
            }
            _ => before != after,
        }
    }
}

/// Wishes tried in one search.
#[derive(Default)]
struct Trail {
    suspect: Option<usize>,
    /// The first guard that a trial wanted changed, on its surface or not.
    changing: Option<usize>,
    fault: Option<Fault>,
    tried: Vec<Vec<Mode>>,
}

/// How many wishes of a trial are granted at once.
#[derive(Clone, Copy, PartialEq)]
enum Exchange {
    All,
    First,
}

/// What becomes an event.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Listed {
    /// At the start only what changes the state.
    Impacts,
    All,
}
