//! Named events: instants at which a formula of the user's passes zero, and whether the motion ends there.
//!
//! An event is a change of sign, zeros left out: a touch from one side is none, a jump across zero (the rate of a contact at an impact) is one at the
//! instant of the jump, and a formula that rests at zero for a while changes when it leaves to the other side. A formula that is zero at the start gives
//! an event there when it leaves in the direction asked for; it does not stop the motion. What is smaller than the rounding of the largest value so far
//! counts as zero.

use super::crossings::{self, Bracket};
use super::{Line, bracketed};
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

/// Values below this share of the largest so far are zero.
const ZERO: f64 = 16.0 * f64::EPSILON;
/// Share of its largest value below which a coefficient does not say whereto a quantity leaves its zero at the start: the polynomial of a quantity that leaves
/// with a horizontal tangent has a slope of rounding.
const LEAVES: f64 = 1e-9;

/// Follows the events along a motion.
#[derive(Clone, Debug)]
pub struct Watcher {
    events: Vec<Named>,
    /// Sign before, and largest value so far.
    states: Vec<(f64, f64)>,
    started: bool,
    proxies: Proxies,
}

impl Watcher {
    /// For these events.
    pub fn new(events: &[Named]) -> Watcher {
        Watcher { events: events.to_vec(), states: vec![(0.0, 0.0); events.len()], started: false, proxies: Proxies::default() }
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
        for i in 0..self.events.len() {
            let output = self.events[i].output;
            for piece in pieces.iter().filter(|p| p.of == output) {
                self.piece((i, output), piece, along, &mut found);
            }
            let last = pieces.iter().rfind(|p| p.of == output && p.to == h);
            last.into_iter().for_each(|piece| self.end((i, output), &piece.row, along, &mut found));
        }
        self.started = true;
        found.arrange_by(|a, b| a.tau.total_cmp(&b.tau).then(a.event.cmp(&b.event)));
        let stops = |e: &Happened| self.events[e.event].stop && along.instant(e.tau) > 0.0;
        if let Some(k) = found.iter().position(stops) {
            found.truncate(k + 1);
        }
        found
    }

    fn piece<L: Line>(&mut self, (i, output): (usize, usize), piece: &Piece, along: &mut L, found: &mut Vec<Happened>) {
        let (mut sign, largest) = self.states[i];
        let largest = piece.row.iter().fold(largest, |m: f64, b| m.max(b.abs()));
        // what has been zero so far has no size of its own: that of its terms
        let terms =
            if sign == 0.0 { along.rounding(piece.to).get(output).copied().filter(|off| off.is_finite()).unwrap_or(0.0) } else { 0.0 };
        let noise = (ZERO * largest).max(terms);
        if sign == 0.0 && !self.started && piece.from == 0.0 && along.output(0.0, output).abs() <= noise {
            // it leaves zero at the start, as if it came from the other side
            sign = leaving(&piece.row, LEAVES * largest);
            if sign != 0.0 && self.counts(i, sign) {
                found.push(Happened { event: i, tau: 0.0, sign });
            }
        }
        let brackets = crossings::crossings(&piece.row, noise, &mut sign);
        let rough: Vec<f64> =
            brackets.iter().map(|bracket| piece.from + (piece.to - piece.from) * of_polynomial(bracket, &piece.row)).collect();
        for (k, bracket) in brackets.iter().enumerate() {
            let before = found.iter().rev().find(|e| e.event == i).map_or(0.0, |e| e.tau);
            let low = if k > 0 { 0.5 * (rough[k - 1] + rough[k]) } else { before };
            let high = rough.get(k + 1).map_or(along.length(), |next| 0.5 * (rough[k] + next));
            let tau = polished([low, rough[k], high], (piece.to - piece.from, bracket.sign), &mut |tau| along.output(tau, output));
            if self.counts(i, bracket.sign) {
                found.push(Happened { event: i, tau, sign: bracket.sign });
            }
        }
        self.states[i] = (sign, largest);
    }

    /// What has clearly happened at the end of a step although rounding of the largest value hides it there: a root of higher order just before it.
    fn end<L: Line>(&mut self, (i, output): (usize, usize), row: &[f64], along: &mut L, found: &mut Vec<Happened>) {
        let (sign, largest) = self.states[i];
        let hidden = row.last().is_some_and(|b| b.abs() <= ZERO * largest);
        if sign == 0.0 || !hidden {
            return;
        }
        let end = along.length();
        let (value, rounding) = (along.output(end, output), along.rounding(end));
        if value * sign >= 0.0 || value.is_nan() || rounding.get(output).is_none_or(|off| value.abs() <= *off) {
            return;
        }
        let before = found.iter().rev().find(|e| e.event == i).map_or(0.0, |e| e.tau);
        let tau = polished([before, end, end], (end, -sign), &mut |tau| along.output(tau, output));
        if self.counts(i, -sign) {
            found.push(Happened { event: i, tau, sign: -sign });
        }
        self.states[i] = (-sign, largest);
    }

    fn counts(&self, i: usize, sign: f64) -> bool {
        match self.events[i].direction {
            Direction::Both => true,
            Direction::Rising => sign > 0.0,
            Direction::Falling => sign < 0.0,
        }
    }

    /// Events whose formulas could not be followed everywhere.
    pub fn lost(&self) -> Vec<usize> {
        (0..self.events.len()).filter(|i| self.proxies.lost().contains(&self.events[*i].output)).collect()
    }

    /// Rows of outputs sampled.
    pub fn samples(&self) -> u64 {
        self.proxies.samples()
    }

    /// What happened, for people, and the signs before and after.
    pub(crate) fn told(&self, happened: &Happened) -> (Text, [f64; 2]) {
        let name = &self.events[happened.event].name;
        let (en, ru) = if happened.sign > 0.0 {
            ("rises through zero", "проходит нуль снизу")
        } else {
            ("falls through zero", "проходит нуль сверху")
        };
        (Text::new(format!("{name}: {en}"), format!("{name}: {ru}")), [-happened.sign, happened.sign])
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

/// The sign with which a polynomial leaves its zero at the start.
fn leaving(row: &[f64], noise: f64) -> f64 {
    row.iter().find(|b| b.abs() > noise).map_or(0.0, |b| b.signum())
}

/// The place inside a bracket at which the polynomial passes zero.
fn of_polynomial(bracket: &Bracket, row: &[f64]) -> f64 {
    let Bracket { from, to, .. } = *bracket;
    if from >= to {
        return from;
    }
    let mut value = |u: f64| crossings::value(row, u);
    let ends = [value(from), value(to)];
    if row.len() == 2 { 0.5 * (from + to) } else { bracketed(&mut value, (from, ends[0]), (to, ends[1])) }
}

/// The instant at which the quantity itself takes the sign, between the first and the last of three instants; the second is that of the polynomial over this width.
///
/// Rounding hides the polynomial around a root of higher order: from where it is met the quantity is followed to both sides until it has the signs of both. What is
/// zero, or has the later sign, from the first instant on takes it where it leaves zero.
fn polished([low, rough, high]: [f64; 3], (width, sign): (f64, f64), exact: &mut dyn FnMut(f64) -> f64) -> f64 {
    // shares of the piece: the polynomial is true to nine digits at least where the step was taken
    let near = 1e-9 * width;
    let mut side = |to: f64, turned: bool| {
        let mut off = near;
        loop {
            let tau = if to < rough { (rough - off).max(to) } else { (rough + off).min(to) };
            let value = exact(tau);
            let there = (value * sign > 0.0) == turned && (turned || value != 0.0);
            if there || tau == to || value.is_nan() {
                return (tau, value, there);
            }
            off *= 2.0;
        }
    };
    let (mut a, fa, is_before) = side(low, false);
    let (mut b, fb, is_after) = side(high, true);
    if !is_after || fa.is_nan() || fb.is_nan() {
        return rough;
    }
    if is_before && b - a <= 4.0 * near {
        return bracketed(exact, (a, fa), (b, fb));
    }
    // a flat root is closed in by its sign alone
    if fa * sign > 0.0 {
        return a;
    }
    while 0.5 * (a + b) > a && 0.5 * (a + b) < b {
        let middle = 0.5 * (a + b);
        if exact(middle) * sign > 0.0 { b = middle } else { a = middle }
    }
    b
}
