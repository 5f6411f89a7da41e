//! What the impacts of an instant took, and whether they kept their laws.

use words::Text;

use super::{Run, jumps};
use crate::audits::impacts::relative;
use crate::dataset::Impulse;
use crate::integrate::events::{Change, Switch};
use crate::integrate::taylor::Flow;
use crate::{GuardKind, Mode, System};
use words::digits::rounded;

impl Run {
    /// The laws of the impact of this instant; one that stands for infinitely many that follow has their momenta as well.
    pub(super) fn judge_blow<S: System + ?Sized>(&mut self, flow: &mut Flow<'_, S>) {
        if flow.switches().iter().any(|s| matches!(s.change, Change::Rests { .. })) {
            return;
        }
        let Some(blow) = flow.blow().cloned().filter(|blow| !blow.reactions.is_empty()) else { return };
        let (t, before, after, modes) = (flow.time(), flow.state_before(), flow.state().to_vec(), flow.modes_before().to_vec());
        if flow.switches().iter().any(|s| s.change == Change::Jolt) {
            let modes = flow.modes().to_vec();
            return self.blows.look_at_jolt(t, [&before, &after], (flow.system(), &modes, &blow));
        }
        self.blows.look(t, [&before, &after], (flow.system(), &modes, &blow));
    }

    /// Energy that the impacts of this instant take, together, relative to the surfaces that are struck.
    pub(super) fn loss<S: System + ?Sized>(
        &mut self,
        flow: &mut Flow<'_, S>,
        switches: &[Switch],
        states: &[Vec<f64>; 2],
        modes: [&[Mode]; 2],
    ) -> Option<f64> {
        if !switches.iter().any(|s| matches!(s.change, Change::Impact { .. })) {
            return None;
        }
        let (t, system) = (flow.time(), flow.system());
        // all that took part holds: then the rates nearest to rest are those of the surfaces themselves
        let mut taking = modes[1].to_vec();
        let took = |i: usize| switches.iter().any(|s| s.guard == i && matches!(s.change, Change::Impact { .. }));
        for (i, guard) in system.guards().iter().enumerate() {
            let struck = took(i);
            // a friction strikes with the contact that presses it: its surface may move too
            let rubbed = matches!(&guard.kind, GuardKind::Friction { pressed, .. } if pressed.iter().any(|gap| took(*gap)));
            if struck || rubbed || (modes[0][i] == Mode::Zero && matches!(guard.kind, GuardKind::Contact { .. })) {
                taking[i] = Mode::Zero;
            }
        }
        let n = system.n_coordinates();
        let mut surface = states[1].clone();
        surface[n..2 * n].fill(0.0);
        if system.project(t, &mut surface, &taking).is_err() {
            surface[n..2 * n].fill(0.0);
        }
        let [before, after] = relative(system, t, [&states[0], &states[1]], &surface, modes[1])?;
        Some(self.impacts.record(before, after))
    }

    /// Impulses of this instant.
    pub(super) fn impulses<S: System + ?Sized>(&self, flow: &mut Flow<'_, S>, switches: &[Switch]) -> Vec<Impulse> {
        if !switches.iter().any(jumps) {
            return Vec::new();
        }
        let Some(blow) = flow.blow().cloned() else { return Vec::new() };
        let named = flow.system().impulses().iter().zip(blow.reactions);
        let felt = named.filter(|(_, value)| *value != 0.0 && value.is_finite());
        felt.map(|(q, value)| Impulse { name: q.name.clone(), unit: q.unit.clone(), value }).collect()
    }
}

/// `..., impulses: force_x(O) = 3 N s`.
pub(super) fn with_impulses(what: &Text, impulses: &[Impulse]) -> Text {
    let one = |p: &Impulse, ru: bool| {
        let (n, unit) = (rounded(p.value), Text::unit(&p.unit));
        if ru { format!("{} = {} {}", p.name, n.ru, unit.ru) } else { format!("{} = {} {}", p.name, n.en, unit.en) }
    };
    let list = |ru: bool| impulses.iter().map(|p| one(p, ru)).collect::<Vec<_>>().join("; ");
    Text::new(format!("{}, impulses: {}", what.en, list(false)), format!("{}, импульсы: {}", what.ru, list(true)))
}
