//! Which modes hold after an event, or at the start.
//!
//! A combination of modes is admissible when the flow *in* these modes keeps every guard on the side its mode says (`sides.rs`). Tried in this
//! order: first what the event suggests (a touched switch changes side, a friction that has come to rest sticks, a crossed bound releases its
//! owner, a contact closes unless it rebounds), at the start `Zero` for everything on its surface; then what the flow of the last
//! trial suggests; then all combinations of the guards on their surfaces, `Zero` first, so that sticking is preferred. When none is admissible
//! the flow is driven back from every side: the switch chatters, or the friction law has no solution.
//!
//! Every trial begins from the state after the impacts and moves it exactly onto the conditions of its modes ([`System::project`]).

use crate::taylor::Flow;
use crate::{Fault, GuardKind, Mode, System};

use super::{Change, Switch};

/// Most guards on their surfaces at once for which all combinations are tried (3^5 expansions).
const COMBINED: usize = 5;

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
            self.expand_here()?;
            self.measure()?;
            self.sides_at_start()?;
        }
        self.modes_before.clone_from(&self.modes);
        let impacts = self.collide()?;
        self.base.clone_from(&self.x);
        self.search()?;
        let impacts = self.come_to_rest(impacts)?;
        self.list(&impacts, Listed::Impacts);
        Ok(())
    }

    /// Switches away from their surfaces take their sides; the formula on the surface need not have a value here. The other guards become `others`.
    fn sides_of_switches(&mut self, others: Mode) {
        self.modes.fill(others);
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
        let impacts = self.collide()?;
        self.base.clone_from(&self.x);
        self.suggest();
        self.search()?;
        let impacts = self.come_to_rest(impacts)?;
        self.list(&impacts, Listed::All);
        Ok(())
    }

    /// The first trial after an event.
    fn suggest(&mut self) {
        for i in 0..self.modes.len() {
            let guard = &self.system.guards()[i];
            self.leaving[i] = false;
            match guard.kind {
                GuardKind::Bound { .. } => self.modes[i] = Mode::Positive,
                GuardKind::Friction { .. } if self.touched[i] => self.modes[i] = Mode::Zero,
                // a rebound was decided with the impact
                GuardKind::Friction { .. } | GuardKind::Contact { .. } => {}
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

    /// Searches admissible modes, beginning with the present ones; leaves their expansion in the system and their state in the flow.
    pub(super) fn search(&mut self) -> Result<(), Fault> {
        let mut tried: Vec<Vec<Mode>> = Vec::new();
        let mut suspect = None;
        let mut fault = None;
        while !tried.contains(&self.modes) {
            tried.push(self.modes.clone());
            match self.attempt() {
                Ok(None) => return Ok(()),
                Ok(Some(wanted)) => {
                    suspect = suspect.or_else(|| (0..wanted.len()).rev().find(|&i| self.touched[i] && wanted[i] != self.modes[i]));
                    self.take_wishes(wanted);
                }
                Err(e) => {
                    fault = Some(e);
                    break;
                }
            }
            if tried.len() > patience(self.modes.len()) {
                break;
            }
        }
        if self.try_all_combinations(&tried) {
            return Ok(());
        }
        let guard = suspect.or_else(|| self.touched.iter().position(|&t| t)).unwrap_or(0);
        Err(fault.unwrap_or_else(|| self.no_modes(guard)))
    }

    fn no_modes(&self, guard: usize) -> Fault {
        let Some(of) = self.system.guards().get(guard) else { return Fault::chattering(&symbolic::Text::default(), self.now.high) };
        match of.kind {
            GuardKind::Switch => Fault::chattering(&of.name, self.now.high),
            GuardKind::Bound { of, .. } => Fault::no_contact_state(&self.system.guards()[of].name, self.now.high),
            _ => Fault::no_contact_state(&of.name, self.now.high),
        }
    }

    fn take_wishes(&mut self, wanted: Vec<Mode>) {
        for (i, mode) in wanted.iter().enumerate() {
            self.leaving[i] |= self.modes[i] == Mode::Zero && *mode != Mode::Zero;
        }
        self.modes = wanted;
    }

    /// Expands in the present modes. None when they are admissible, otherwise the modes that their flow suggests.
    fn attempt(&mut self) -> Result<Option<Vec<Mode>>, Fault> {
        self.x.clone_from(&self.base);
        if let Some(wanted) = self.torn_off()? {
            return Ok(Some(wanted));
        }
        self.project_here()?;
        self.expand_here()?;
        self.measure()?;
        let wanted: Vec<Mode> = (0..self.modes.len()).map(|i| self.wanted(i)).collect();
        if wanted != self.modes {
            return Ok(Some(wanted));
        }
        for i in 0..self.modes.len() {
            let guard = &self.system.guards()[i];
            let searched = guard.scheduled.is_none() && !matches!(guard.kind, GuardKind::Bound { .. });
            let deflates = self.touched[i] && self.modes[i] != Mode::Zero && searched;
            self.deflation[i] = if deflates { self.leading(i).map_or(0, |(k, _)| k) } else { 0 };
        }
        Ok(None)
    }

    /// All combinations of the guards on their surfaces, the others as their values say.
    fn try_all_combinations(&mut self, tried: &[Vec<Mode>]) -> bool {
        let free = |guard: &crate::Guard| guard.scheduled.is_none() && !matches!(guard.kind, GuardKind::Bound { .. });
        let on: Vec<usize> = (0..self.modes.len()).filter(|&i| self.touched[i] && free(&self.system.guards()[i])).collect();
        if on.is_empty() || on.len() > COMBINED {
            return false;
        }
        let others = tried.last().cloned().unwrap_or_else(|| self.modes.clone());
        for code in 0..3usize.pow(on.len() as u32) {
            self.modes.clone_from(&others);
            let mut digits = code;
            for &i in &on {
                self.modes[i] = [Mode::Zero, Mode::Positive, Mode::Negative][digits % 3];
                digits /= 3;
            }
            if on.iter().any(|&i| self.penetrates(i)) {
                continue;
            }
            // the others may follow the combination: once more with what they want
            for _ in 0..2 {
                match self.attempt() {
                    Ok(None) => return true,
                    Ok(Some(wanted)) if on.iter().all(|&i| wanted[i] == self.modes[i]) => self.take_wishes(wanted),
                    _ => break,
                }
            }
        }
        false
    }

    fn penetrates(&self, i: usize) -> bool {
        self.modes[i] == Mode::Negative && matches!(self.system.guards()[i].kind, GuardKind::Contact { .. })
    }

    /// Puts the changes into [`Flow::switches`]: impacts first, in the order of the guards.
    fn list(&mut self, impacts: &[super::Impact], listed: Listed) {
        let t = self.now.high;
        for impact in impacts {
            let guard = impact.guard;
            let after = if impact.rests.is_some() { Mode::Positive } else { self.modes[guard] };
            let change = Change::Impact { rates: impact.rates };
            self.switches.push(Switch { t, guard, before: self.modes_before[guard], after, change });
            if let Some(limit) = impact.rests {
                let change = Change::Rests { limit };
                self.switches.push(Switch { t, guard, before: Mode::Positive, after: self.modes[guard], change });
            }
        }
        for (guard, mode) in self.modes_before.iter().copied().enumerate() {
            let after = self.modes[guard];
            let told = impacts.iter().any(|impact| impact.guard == guard);
            if after != mode && !told && listed == Listed::All {
                self.switches.push(Switch { t, guard, before: mode, after, change: Change::Mode });
            }
        }
        self.work.switches += self.switches.len() as u64;
    }
}

/// What becomes an event.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Listed {
    /// At the start only what changes the state.
    Impacts,
    All,
}

pub(super) fn opposite(mode: Mode) -> Mode {
    match mode {
        Mode::Negative => Mode::Positive,
        Mode::Zero => Mode::Zero,
        Mode::Positive => Mode::Negative,
    }
}
