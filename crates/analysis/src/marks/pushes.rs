//! Contacts that hold both ways though a surface only pushes: when they would have to pull.
//!
//! A wheel that its track keeps at a distance has a normal force of either sign. Where it becomes negative the wheel would have left: an event, and a note
//! with the first instant. What is not larger than the rounding of the forces that meet in it is no pull.

use words::Text;

use super::Along;
use super::named::{Direction, Named, Watcher};
use crate::System;
use crate::dataset::Impulse;
use crate::fault::connections::Since;
use crate::proxies::proxy::Source;

/// A normal force to be watched.
#[derive(Clone, Debug, PartialEq)]
pub struct Push {
    /// `normal(F)`.
    pub name: String,
    /// What holds: "rolling F".
    pub label: Text,
    /// Index of the output that it is.
    pub output: usize,
    /// What follows.
    pub beyond: Beyond,
    /// The reaction whose impulses it must not have the wrong sign of, and that sign.
    pub impulse: Option<(String, f64)>,
}

/// What follows where a force has the wrong sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beyond {
    /// The motion is that of the connection that holds both ways.
    Noted,
    /// Other forces are wrong from there on.
    Ends,
}

/// A pull must exceed so many times the rounding of the force.
const CERTAIN: f64 = 1e3;
/// Share of the largest impulse of an instant below which one is rounding.
const STRUCK: f64 = 1e-9;
/// Places of a step at which a pull is looked for.
const PLACES: [f64; 6] = [0.02, 0.1, 0.3, 0.5, 0.8, 1.0];

/// Follows normal forces along a motion.
#[derive(Clone, Debug)]
pub(crate) struct Pushes {
    list: Vec<Push>,
    watcher: Watcher,
    /// First instant of a pull.
    pulled: Vec<Option<f64>>,
    started: bool,
}

impl Pushes {
    pub(crate) fn new(list: &[Push]) -> Pushes {
        let named = |p: &Push| Named { name: p.name.clone(), output: p.output, direction: Direction::Falling, stop: false };
        let watcher = Watcher::new(&list.iter().map(named).collect::<Vec<_>>());
        Pushes { list: list.to_vec(), watcher, pulled: vec![None; list.len()], started: false }
    }

    /// Where in a step a contact begins to pull: which, and how far into the step.
    pub(crate) fn look<S: System + ?Sized>(&mut self, along: &mut Along<'_, S>) -> Vec<(usize, f64)> {
        if self.list.is_empty() || along.length == 0.0 {
            return Vec::new();
        }
        if !std::mem::replace(&mut self.started, true) {
            for i in 0..self.list.len() {
                if self.pulls(i, 0.0, along) {
                    self.pulled[i] = Some(along.time(0.0));
                }
            }
        }
        let mut found = Vec::new();
        for happened in self.watcher.look(along) {
            let (i, left) = (happened.event, along.length - happened.tau);
            if PLACES.iter().any(|place| self.pulls(i, happened.tau + place * left, along)) {
                self.pulled[i] = self.pulled[i].or(Some(along.time(happened.tau)));
                found.push((i, happened.tau));
            }
        }
        found.extend(self.already(along));
        found
    }

    /// Contacts that pull at the end of a step in which no zero was found: theirs is the instant at which it began, where something else happened as well.
    fn already<S: System + ?Sized>(&mut self, along: &mut Along<'_, S>) -> Vec<(usize, f64)> {
        let open: Vec<usize> = (0..self.list.len()).filter(|&i| self.pulled[i].is_none()).collect();
        if open.is_empty() {
            return Vec::new();
        }
        let values = along.outputs(along.length).to_vec();
        let mut found = Vec::new();
        for i in open {
            if values[self.list[i].output] < 0.0 && self.pulls(i, along.length, along) {
                self.pulled[i] = Some(along.time(0.0));
                found.push((i, 0.0));
            }
        }
        found
    }

    fn pulls<S: System + ?Sized>(&self, i: usize, tau: f64, along: &mut Along<'_, S>) -> bool {
        let output = self.list[i].output;
        let value = along.outputs(tau)[output];
        value < 0.0 && along.rounding(tau).get(output).is_none_or(|rounding| value < -CERTAIN * rounding)
    }

    /// Looks at the impulses of an instant: which contacts would have to pull in it.
    pub(crate) fn strike(&mut self, t: f64, impulses: &[Impulse]) -> Vec<usize> {
        let largest = impulses.iter().fold(0.0_f64, |m, p| m.max(p.value.abs()));
        let mut found = Vec::new();
        for (i, (push, pulled)) in self.list.iter().zip(&mut self.pulled).enumerate() {
            let Some((name, sign)) = &push.impulse else { continue };
            let wrong = |p: &Impulse| p.name == *name && sign * p.value < -STRUCK * largest;
            if impulses.iter().any(wrong) {
                *pulled = pulled.or(Some(t));
                found.push(i);
            }
        }
        found
    }

    /// The first force of the wrong sign after which nothing is right.
    pub(crate) fn broken(&self) -> Option<(&Push, f64)> {
        let ended = |(push, t): (_, &Option<f64>)| Some((push, (*t)?));
        self.list.iter().zip(&self.pulled).filter(|(push, _)| push.beyond == Beyond::Ends).find_map(ended)
    }

    /// What is watched.
    pub(crate) fn list(&self) -> &[Push] {
        &self.list
    }

    /// Contacts that pulled, with where each first did.
    pub(crate) fn notes<'n>(&self, since: impl Fn(f64) -> Since<'n>) -> Vec<Text> {
        let noted = |(push, t): (&Push, &Option<f64>)| Some(push.pulling(since((*t)?)));
        self.list.iter().zip(&self.pulled).filter(|(push, _)| push.beyond == Beyond::Noted).filter_map(noted).collect()
    }
}

impl Push {
    /// What is said of a contact that would have to pull.
    pub(crate) fn pulling(&self, since: Since<'_>) -> Text {
        let (from, Text { en, ru }) = (since.words(), &self.label);
        Text::new(
            format!(
                "{en}: {} the normal force is negative at times; a track only pushes: with leaves = true the wheel would lift off there",
                from.en
            ),
            format!(
                "{ru}: {} нормальная реакция временами отрицательна; опора только давит: с leaves = true колесо здесь оторвалось бы",
                from.ru
            ),
        )
    }
}
