//! Named events: instants at which a formula of the user's passes zero, and whether the motion ends there.
//!
//! An event is a change of sign, zeros left out: a touch from one side is none, a jump across zero (the rate of a contact at an impact) is one at the
//! instant of the jump, and a formula that rests at zero for a while changes when it leaves to the other side. A formula that is zero at the start gives
//! an event there when it leaves in the direction asked for; it does not stop the motion. How the signs are found stands in `search.rs`.

use super::Line;
use super::search::Search;
use crate::proxies::proxy::{Piece, Proxies};
use algebra::arrange::Arrange;
use words::Text;
use words::digits::number;

/// Which changes of sign count.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Direction {
    /// From minus to plus.
    Rising,
    /// From plus to minus.
    Falling,
    /// Either.
    #[default]
    Both,
}

impl Direction {
    /// Whether a passage to a sign counts.
    pub(crate) fn counts(self, sign: f64) -> bool {
        match self {
            Direction::Both => true,
            Direction::Rising => sign > 0.0,
            Direction::Falling => sign < 0.0,
        }
    }
}

/// A named event of a system.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// Its name.
    pub name: String,
    /// Index of the output whose zeros are meant.
    pub output: usize,
    /// Which changes count.
    pub direction: Direction,
    /// Whether the motion ends at the first one after the start.
    pub stop: bool,
}

/// One that happened.
#[derive(Clone, Debug, PartialEq)]
pub struct Happened {
    /// Index of the event.
    pub event: usize,
    /// After the start of the step.
    pub tau: f64,
    /// Sign afterwards.
    pub sign: f64,
}

/// What happened where an event passes zero to a sign, for people.
pub(crate) fn passed(name: &str, sign: f64) -> Text {
    let (en, ru) = if sign > 0.0 {
        ("rises through zero", "проходит нуль снизу")
    } else {
        ("falls through zero", "проходит нуль сверху")
    };
    Text::new(format!("{name}: {en}"), format!("{name}: {ru}"))
}

/// Follows the events along a motion.
#[derive(Clone, Debug)]
pub struct Watcher {
    events: Vec<Named>,
    /// Sign before, and largest value so far.
    states: Vec<(f64, f64)>,
    started: bool,
    proxies: Proxies,
    /// Events whose formulas could not be followed beside a zero.
    blurred: Vec<bool>,
}

impl Watcher {
    /// For these events.
    pub fn new(events: &[Named]) -> Watcher {
        Watcher {
            events: events.to_vec(),
            states: vec![(0.0, 0.0); events.len()],
            started: false,
            proxies: Proxies::default(),
            blurred: vec![false; events.len()],
        }
    }

    /// The events watched.
    pub fn events(&self) -> &[Named] {
        &self.events
    }

    /// What happens in a step, in order of time; ends with the first event that stops the motion.
    pub(crate) fn look<L: Line>(&mut self, along: &mut L) -> Vec<Happened> {
        if self.events.is_empty() || along.length() == 0.0 {
            return Vec::new();
        }
        let outputs: Vec<usize> = self.events.iter().map(|e| e.output).collect();
        let h = along.length();
        let pieces = self.proxies.pieces(along, &outputs, h);
        let mut found = Vec::new();
        for (i, &output) in outputs.iter().enumerate() {
            let own: Vec<&Piece> = pieces.iter().filter(|p| p.of == output).collect();
            let (sign, largest) = self.states[i];
            let mut search = Search::new(along, output, (sign, largest));
            search.whole(&own);
            let Search { sign, largest, lost, turns, .. } = search;
            let begins = Some(sign).filter(|_| !self.started && turns.begins);
            self.states[i] = (sign, largest);
            self.blurred[i] |= lost;
            let all = begins.map(|_| (0.0, turns.first)).into_iter().chain(turns.list);
            found.extend(all.filter(|(_, sign)| self.events[i].direction.counts(*sign)).map(|(tau, sign)| Happened {
                event: i,
                tau,
                sign,
            }));
        }
        self.started = true;
        found.arrange_by(|a, b| a.tau.total_cmp(&b.tau).then(a.event.cmp(&b.event)));
        let stops = |e: &Happened| self.events[e.event].stop && along.instant(e.tau) > 0.0;
        if let Some(k) = found.iter().position(stops) {
            found.truncate(k + 1);
        }
        found
    }

    /// Events whose formulas could not be followed everywhere.
    pub fn lost(&self) -> Vec<usize> {
        (0..self.events.len()).filter(|i| self.blurred[*i] || self.proxies.lost().contains(&self.events[*i].output)).collect()
    }

    /// Rows of outputs sampled.
    pub fn samples(&self) -> u64 {
        self.proxies.samples()
    }

    /// What happened, for people, and the signs before and after.
    pub(crate) fn told(&self, happened: &Happened) -> (Text, [f64; 2]) {
        (passed(&self.events[happened.event].name, happened.sign), [-happened.sign, happened.sign])
    }

    /// That an event ended the motion at `t`, s.
    pub(crate) fn ending(&self, event: usize, t: f64) -> Text {
        let (n, name) = (number(t), &self.events[event].name);
        Text::new(
            format!("the event `{name}` ends the motion at t = {} s", n.en),
            format!("событие `{name}` завершает движение при t = {} с", n.ru),
        )
    }

    /// Whether an event ends the motion.
    pub fn stops(&self, happened: &Happened) -> bool {
        self.events[happened.event].stop
    }
}
