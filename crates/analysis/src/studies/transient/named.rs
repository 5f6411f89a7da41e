//! Named events on the closed form, and the end of the motion at one that stops it.

use super::course::Closed;
use super::phase::{Phase, modes};
use super::walk::Walk;
use crate::System;
use crate::dataset::Event;
use crate::marks::named::{Happened, Named, Watcher};
use crate::studies::simulate::EVENTS;
use words::Text;

/// What the named events say of a motion.
pub(super) struct Marked {
    /// Those that happened, in order of time.
    pub(super) events: Vec<Event>,
    /// Names of those whose formulas could not be followed everywhere.
    pub(super) lost: Vec<String>,
    /// When one ended the motion, s, and the sentence.
    pub(super) ended: Option<(f64, Text)>,
}

/// Follows the events phase by phase; the phases are cut at the first that stops the motion. `chosen`: the outputs listed with them.
pub(super) fn follow<S: System + ?Sized>(system: &mut S, phases: &mut Vec<Phase>, chosen: &[usize], named: &[Named]) -> Marked {
    let mut watcher = Watcher::new(named);
    let mut marked = Marked { events: Vec::new(), lost: Vec::new(), ended: None };
    if named.is_empty() || system.show(&named.iter().map(|e| e.output).collect::<Vec<_>>()).is_err() {
        return marked;
    }
    let mut found: Vec<(usize, Happened)> = Vec::new();
    for (k, phase) in phases.iter().enumerate() {
        found.extend(along(system, phase, &mut watcher).into_iter().map(|h| (k, h)));
        if let Some((_, last)) = found.last().filter(|(at, last)| *at == k && watcher.stops(last) && phase.start + last.tau > 0.0) {
            let t = phase.start + last.tau;
            marked.ended = Some((t, watcher.ending(last.event, t)));
            break;
        }
    }
    marked.lost = watcher.lost().into_iter().map(|i| named[i].name.clone()).collect();
    marked.events = found.iter().take(EVENTS).map(|(k, happened)| listed(system, &phases[*k], chosen, (&watcher, happened))).collect();
    if let (Some((_, _)), Some((k, last))) = (&marked.ended, found.last()) {
        cut(phases, *k, last.tau);
    }
    marked
}

/// What happens in a phase.
fn along<S: System + ?Sized>(system: &mut S, phase: &Phase, watcher: &mut Watcher) -> Vec<Happened> {
    let length = phase.end - phase.start;
    let all: Vec<usize> = (0..system.outputs().len()).collect();
    watcher.look(&mut Closed { system, phase, chosen: &all, walk: Walk::new(&phase.motion, length) })
}

/// The motion ends `tau` after the start of a phase.
fn cut(phases: &mut Vec<Phase>, k: usize, tau: f64) {
    phases.truncate(k + 1);
    if let Some(last) = phases.last_mut() {
        last.end = last.start + tau;
        last.state_at_end = last.motion.states(&[tau]).pop().unwrap_or_default();
    }
}

/// An event with the state and the outputs at its instant.
fn listed<S: System + ?Sized>(system: &mut S, phase: &Phase, chosen: &[usize], (watcher, happened): (&Watcher, &Happened)) -> Event {
    let (what, sides) = watcher.told(happened);
    let name = watcher.events()[happened.event].name.clone();
    let (state, outputs) = values(system, phase, chosen, happened.tau);
    Event {
        t: phase.start + happened.tau,
        name,
        what,
        guard: usize::MAX,
        sides,
        states: [state.clone(), state],
        outputs: [outputs.clone(), outputs],
        ..Event::default()
    }
}

/// State and chosen outputs `tau` after the start of a phase; not numbers where they have no value.
pub(super) fn values<S: System + ?Sized>(system: &mut S, phase: &Phase, chosen: &[usize], tau: f64) -> (Vec<f64>, Vec<f64>) {
    let t = phase.start + tau;
    let mut x = phase.motion.states(&[tau]).pop().unwrap_or_default();
    x.extend(phase.form.turns.iter().map(|turn| turn.at(t)));
    let modes = modes(system, phase, t, &x);
    phase.accelerate(system, t, &x);
    let mut all = vec![f64::NAN; system.outputs().len()];
    if system.show(chosen).is_err() || system.observe(t, &x, &modes, &mut all).is_err() {
        all.fill(f64::NAN);
    }
    (x, chosen.iter().map(|&i| all[i]).collect())
}
