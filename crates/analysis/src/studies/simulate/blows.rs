//! What the impacts of an instant took, and whether they kept their laws.

use words::Text;

use super::run::{Run, jumps};
use crate::audits::blows::STILL;
use crate::audits::impacts::relative;
use crate::dataset::{Audit, Impulse};
use crate::integrate::crossings::{Change, Switch};
use crate::integrate::taylor::Flow;
use crate::system::{Blow, Touch, TouchLaw};
use crate::{GuardKind, Mode, System};

/// Rounding of the energies of a blow, relative to the works that meet.
const LIMIT: f64 = 1e-9;

impl Run {
    /// The laws of the impact of this instant; one that stands for infinitely many that follow has their momenta as well.
    pub(super) fn judge_blow<S: System + ?Sized>(&mut self, flow: &mut Flow<'_, S>) {
        if flow.switches().iter().any(|s| matches!(s.change, Change::Rests { .. })) {
            return;
        }
        let Some(blow) = flow.blow().cloned().filter(|blow| !blow.reactions.is_empty()) else { return };
        let (t, before, after, modes) = (flow.time(), flow.state_before(), flow.state().to_vec(), flow.modes_struck());
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
        let energies = relative(system, t, [&states[0], &states[1]], &surface, modes[1]);
        let one = path(switches) == Path::Together && moves_as_one(system, t, &surface, [&taking, modes[1]]);
        // not where surfaces move that no motion keeps all, as of a rope that is drawn over a ring
        let one = one && !self.rubs_elsewhere(flow, states, modes, &taking);
        Some(match flow.blow().and_then(|blow| blow.work) {
            Some(work) => self.impacts.record_work(work, energies.filter(|_| one)),
            None => self.impacts.record(energies?),
        })
    }

    /// Whether an impulse of a friction that is none of those that take part does work.
    fn rubs_elsewhere<S: System + ?Sized>(
        &self,
        flow: &mut Flow<'_, S>,
        states: &[Vec<f64>; 2],
        modes: [&[Mode]; 2],
        taking: &[Mode],
    ) -> bool {
        if !flow.system().guards().iter().any(|guard| matches!(guard.kind, GuardKind::Friction { .. })) {
            return false;
        }
        let (t, Some(blow)) = (flow.time(), flow.blow().cloned()) else { return false };
        let touches = flow.system().struck(t, &states[0], &blow.reactions, modes[1]).unwrap_or_default();
        let rubs = |touch: &Touch| matches!(touch.law, TouchLaw::Friction { .. }) && touch.force != 0.0;
        touches.iter().any(|touch| rubs(touch) && taking[touch.guard] != Mode::Zero)
    }

    /// Impulses of this instant; those that are not unique are not numbers.
    pub(super) fn impulses<S: System + ?Sized>(&self, flow: &mut Flow<'_, S>, switches: &[Switch]) -> Vec<Impulse> {
        if !switches.iter().any(jumps) {
            return Vec::new();
        }
        let Some(blow) = flow.blow().cloned() else { return Vec::new() };
        let open = open_directions(flow, &blow);
        let value = |(k, value): (usize, f64)| if open.iter().any(|d| d[k] != 0.0) { f64::NAN } else { value };
        let values: Vec<f64> = blow.reactions.iter().copied().enumerate().map(value).collect();
        let named = flow.system().impulses().iter().zip(values);
        let felt = named.filter(|(_, value)| *value != 0.0 && !value.is_infinite());
        felt.map(|(q, value)| Impulse { name: q.name.clone(), unit: q.unit.clone(), value }).collect()
    }

    /// Books the works that the impulses of this instant do at the outputs in `works`; not a number where they are not unique.
    pub(super) fn book_works<S: System + ?Sized>(
        &mut self,
        flow: &mut Flow<'_, S>,
        switches: &[Switch],
        states: &[Vec<f64>; 2],
        modes: [&[Mode]; 2],
    ) {
        let Some(blow) = flow.blow().cloned().filter(|blow| !blow.reactions.is_empty() && !self.works.is_empty()) else { return };
        let (t, open) = (flow.time(), open_directions(flow, &blow));
        let works = self.works.clone();
        let mut of = |impulses: &[f64]| -> Option<Vec<f64>> {
            let [a, b] = [0, 1].map(|k| flow.system().impulse_powers(t, &states[k], modes[k], impulses));
            a.zip(b).map(|(a, b)| works.iter().map(|&i| 0.5 * (a[i] + b[i])).collect())
        };
        let none = || vec![f64::NAN; works.len()];
        let mut done = of(&blow.reactions).unwrap_or_else(none);
        let changes: Vec<Vec<f64>> = open.iter().map(|direction| of(direction).unwrap_or_else(none)).collect();
        if path(switches) == Path::JumpFirst {
            // what contacts take less than by their mean rates the drive does not do
            let [mean, after] = [Path::Together, Path::JumpFirst].map(|path| {
                let works = works_of_touches(flow.system(), t, states, (modes[1], &blow), path);
                works.map_or(f64::NAN, |works| works.iter().sum::<f64>())
            });
            match &mut done[..] {
                [only] => *only += mean - after,
                all => all.fill(f64::NAN),
            }
        }
        for (k, (sum, done)) in self.struck.iter_mut().zip(&done).enumerate() {
            *sum += if changes.iter().all(|change| change[k] == 0.0) { *done } else { f64::NAN };
        }
        self.balance_works(flow, states, (modes, &blow, path(switches)), done.iter().sum());
    }

    /// Notes what the works of all impulses leave of the change of the kinetic energy; drives that are no motors have impulses that nobody names.
    fn balance_works<S: System + ?Sized>(
        &mut self,
        flow: &mut Flow<'_, S>,
        states: &[Vec<f64>; 2],
        (modes, blow, path): ([&[Mode]; 2], &Blow, Path),
        motors: f64,
    ) {
        let (t, system) = (flow.time(), flow.system());
        if [0, 1].iter().any(|&k| driven(system, t, &states[k], modes[k])) {
            return;
        }
        let energies = [0, 1].map(|k| system.energies(t, &states[k], modes[k]).map(|e| e[0]));
        let [Some(before), Some(after)] = energies else { return };
        let Some(works) = works_of_touches(system, t, states, (modes[1], blow), path) else { return };
        let size = works.iter().map(|w| w.abs()).sum::<f64>() + motors.abs() + before + after;
        let left = after - before - motors - works.iter().sum::<f64>();
        let share = if size > 0.0 { left.abs() / size } else { 0.0 };
        self.unclosed = Some(self.unclosed.map_or(share, |known| known.max(share)));
    }

    /// The check of the works of impulses.
    pub(super) fn closed(&self) -> Option<Audit> {
        let name = Text::new(
            "works of all impulses of a blow: largest difference from the change of kinetic energy, relative",
            "работы всех импульсов удара: наибольшее отличие от изменения кинетической энергии, относительно",
        );
        Some(Audit::at_most("impulse_works", name, self.unclosed?, LIMIT))
    }
}

/// In which order an instant is thought to pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Path {
    /// All impulses grow together.
    Together,
    /// Prescribed velocities have jumped before contacts strike, as Newton's law takes it.
    JumpFirst,
}

fn path(switches: &[Switch]) -> Path {
    let any = |wanted: fn(&Change) -> bool| switches.iter().any(|s| wanted(&s.change));
    match any(|c| *c == Change::Jolt) && any(|c| matches!(c, Change::Impact { .. })) {
        true => Path::JumpFirst,
        false => Path::Together,
    }
}

/// Λ (u₋ + u₊)/2 of every contact and friction; none where one is not known.
fn works_of_touches<S: System + ?Sized>(
    system: &mut S,
    t: f64,
    states: &[Vec<f64>; 2],
    (modes, blow): (&[Mode], &Blow),
    path: Path,
) -> Option<Vec<f64>> {
    let [first, last] = [0, 1].map(|k| system.struck(t, &states[k], &blow.reactions, modes));
    let before = |touch: &Touch| {
        let known = blow.rates.iter().find(|(guard, _)| path == Path::JumpFirst && *guard == touch.guard);
        known.map_or(touch.rate[0], |(_, [before, _])| *before)
    };
    let work = |(a, b): (&Touch, &Touch)| {
        let mean = 0.5 * (before(a) + b.rate[0]);
        if matches!(a.law, TouchLaw::Contact { .. }) { a.force * mean } else { -a.force * mean }
    };
    let works: Vec<f64> = first?.iter().zip(&last?).map(work).collect();
    works.iter().all(|w| w.is_finite()).then_some(works)
}

/// Whether the rates in `surface` keep all contacts and frictions of the first modes that take part at once, and beside them what the others hold.
fn moves_as_one<S: System + ?Sized>(system: &mut S, t: f64, surface: &[f64], [taking, holding]: [&[Mode]; 2]) -> bool {
    let n = system.n_coordinates();
    let mut held = surface.to_vec();
    let size = surface[n..2 * n].iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let kept = system.project(t, &mut held, holding).is_ok();
    if !kept || held[n..2 * n].iter().zip(&surface[n..2 * n]).any(|(a, b)| (a - b).abs() > STILL * size.max(a.abs())) {
        return false;
    }
    let still = vec![0.0; system.impulses().len()];
    let Some(touches) = system.struck(t, surface, &still, taking) else { return true };
    let takes = |touch: &&Touch| taking[touch.guard] == Mode::Zero;
    touches.iter().filter(takes).all(|touch| touch.rate[0].abs() <= STILL * touch.rate[1])
}

/// Whether something moves the machine that is no motor.
fn driven<S: System + ?Sized>(system: &mut S, t: f64, x: &[f64], modes: &[Mode]) -> bool {
    let n = system.n_coordinates();
    let mut still = x.to_vec();
    still[n..2 * n].fill(0.0);
    let carried = system.energies(t, &still, modes).is_some_and(|e| e[0] != 0.0);
    carried || system.powers(t, x, &vec![0.0; n], modes).is_none_or(|p| p.drives != 0.0)
}

fn open_directions<S: System + ?Sized>(flow: &mut Flow<'_, S>, blow: &Blow) -> Vec<Vec<f64>> {
    let (t, state, modes) = (flow.time(), flow.state().to_vec(), flow.modes().to_vec());
    flow.system().open_impulses(t, &state, &modes, blow).unwrap_or_default()
}
