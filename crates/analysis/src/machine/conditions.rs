//! Conditions of connections at a state: how far they are violated, the nearest state that keeps them, rates after an impact.
//!
//! **Projection.** Of all changes of position that close the conditions the one with the least kinetic energy: with places g(q) and J = ∂g/∂q,
//!
//! ```text
//! minimise d' M d   subject to   J d = -g(q)          repeated (Newton) until rounding;   M = C C', A = C^-1 J' = Q R, d = -C^-T Q R^-T g
//! ```
//!
//! then the same for the rates. So a projection takes away as little of the motion as can be, and energy changes by the square of the drift. Where M
//! is singular (massless bodies) its place is taken by M + diag(JJ').
//!
//! Impacts: `impact.rs`.

mod projection;

use std::sync::Arc;

use program::{Behind, Bound, ConnectionRoots, Construct, Evaluator, LawRoots, Point};
use symbolic::Equations;
use symbolic::connections::{Impacts, Law, Reaction, Rebound};
use words::Text;

use super::integrals::Kept;
use super::leap::Leap;
use super::switches::Switches;
use crate::{Fault, Mode, Quantity};
use algebra::qr::Qr;

/// Violations below this many units in the last place of the terms that meet in a condition are left alone.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// Share of its largest rate to which a machine at rest is compared.
const STILL: f64 = 1e-3;
/// Share of a rate below which what is left of it is rounding: conditions that repeat each other lose some digits in their factors.
const CANCELS: f64 = 32.0 * f64::EPSILON;
/// Share of a rate below which its change over an instant is no jump.
const STEPPED: f64 = 1e-9;
/// Newton steps of one projection.
const STEPS: usize = 12;
/// Relative violation from which a condition left out as a repetition contradicts the others: far above rounding near singular positions.
const CONTRADICTS: f64 = 1e-7;
/// The same for machines at their origin, where nothing is left to compare with: metres, radians (and per second).
const MOVED: f64 = 1e-12;
/// Positions around the start that are looked at.
const AROUND: usize = 4;
/// Margins asked for inside a step, and the number of conditions from which on they cost more than they are worth.
const INSIDE: usize = 3;
const MANY: usize = 24;
/// Violation that a projection must reach.
const REACHED: f64 = 1e-9;

/// The conditions of a machine.
#[derive(Clone, Debug)]
pub(super) struct Conditions {
    pub(super) evaluator: Evaluator,
    pub(super) roots: ConnectionRoots,
    pub(super) laws: Evaluator,
    pub(super) law_roots: LawRoots,
    pub(super) impacts: Impacts,
    /// The law of restitution of each contact.
    pub(super) rebounds: Vec<Rebound>,
    pub(super) n: usize,
    pub(super) rows: Vec<Row>,
    /// Number of reactions.
    pub(super) reactions: usize,
    /// Supports that press frictions: unknowns of the balances among the dynamics.
    pub(super) supports: Vec<usize>,
    /// How many of the conditions that always hold repeat others wherever the machine is.
    repeated: usize,
    names: Vec<Text>,
    /// Names and units, for messages.
    coordinates: Vec<Quantity>,
    /// Motors: reactions whose impulses keep prescribed motions.
    pub(super) motors: Vec<usize>,
    /// Whether each coordinate is an angle, and has the size 1.
    angles: Vec<bool>,
    pub(super) values: Vec<f64>,
    /// The modes of the flow: the sides on which formulas of places stand where a switch of theirs is on its surface.
    pub(super) sides: Switches,
    /// Places of conditions on rates.
    pub(super) kept: Kept,
    /// Rows in force.
    pub(super) active: Vec<usize>,
    /// Largest terms of each row's place so far: in some positions all levers vanish.
    arms: Vec<f64>,
    /// Largest gradients of each row so far, in the metric of the kinetic energy.
    spans: Vec<f64>,
    /// Largest terms of each row's rate so far: a machine that stops for an instant has rates of its own size all the same.
    moved: Vec<f64>,
    /// Largest levers of each row around the start, where rows repeat others: one of them may have none in some position.
    levers: Vec<f64>,
    /// Largest rate of a coordinate so far: what a machine that has come to rest is compared with.
    fastest: f64,
    /// Violation and size of each row's place, then of each row's rate, as the last projection found them.
    drifts: Vec<[f64; 2]>,
}

/// A condition that takes part.
#[derive(Clone, Debug)]
pub(super) struct Row {
    pub(super) condition: usize,
    pub(super) has_place: bool,
    pub(super) reaction: Option<usize>,
    pub(super) holds: Holds,
    /// The guard that says whether its equation stands or others carry it; none where that is not asked.
    share: Option<usize>,
    /// What it is, for messages.
    pub(super) name: Text,
}

/// `rope T, tension` is the rope T.
fn whole(reaction: &Reaction) -> Text {
    let head = |words: &str| words.split(", ").next().unwrap_or_default().to_owned();
    let Text { en, ru, .. } = &reaction.label;
    if en.is_empty() { Text::same(&reaction.name) } else { Text::new(head(en), head(ru)) }
}

/// When a condition holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Holds {
    Always,
    /// While this guard is `Zero`, with the index among the frictions.
    Sticking(usize, usize),
    /// The same, with the index among the contacts.
    Closed(usize, usize),
    /// While the contact with this guard is closed.
    Rough(usize),
}

impl Conditions {
    /// None when the machine has none.
    pub(super) fn new(equations: &Equations, bound: &Bound) -> Result<Option<Conditions>, Fault> {
        let program = bound.program();
        let of_kind = |wanted: fn(&Law) -> bool| -> Vec<usize> {
            (0..equations.reactions.len()).filter(|r| wanted(&equations.reactions[*r].law)).collect()
        };
        let contacts = of_kind(|law| matches!(law, Law::Contact { .. }));
        let frictions = of_kind(|law| matches!(law, Law::Friction(_)));
        let place = |list: &[usize], r: usize| list.iter().position(|k| *k == r);
        let mut rows = Vec::new();
        for (condition, c) in equations.conditions.iter().enumerate() {
            let holds = match c.reaction {
                None => Holds::Always,
                Some(r) if !program.solved.contains(&r) => continue,
                Some(r) => match (program.switches[r], place(&frictions, r), place(&contacts, r)) {
                    (Some(guard), Some(friction), _) => Holds::Sticking(guard, friction),
                    (Some(guard), _, Some(contact)) => Holds::Closed(guard, contact),
                    (Some(guard), ..) => Holds::Rough(guard),
                    _ => Holds::Always,
                },
            };
            let shares = |kind: &Construct| matches!(kind, Construct::Share { reaction, .. } if Some(*reaction) == c.reaction);
            let share = program.guards.iter().position(|g| shares(&g.kind));
            let name = c.reaction.map_or_else(|| c.name.clone(), |r| whole(&equations.reactions[r]));
            rows.push(Row { condition, has_place: c.place.is_some(), reaction: c.reaction, holds, share, name });
        }
        if rows.is_empty() {
            return Ok(None);
        }
        let motor = |r: &usize| matches!(equations.reactions[*r].law, Law::Motor);
        let quantity = |c: &symbolic::equations::Coordinate| Quantity::new(&equations.graph.symbol_info(c.symbols[0]).name, &c.unit);
        let coordinates = equations.coordinates.iter().map(quantity).collect();
        Ok(Some(Conditions {
            evaluator: bound.evaluator(&Arc::clone(&program.connections))?,
            roots: program.connection_roots(),
            laws: bound.evaluator(&Arc::clone(&program.laws))?,
            law_roots: program.law_roots(),
            impacts: equations.impacts,
            rebounds: contacts.iter().filter_map(|r| rebound(&equations.reactions[*r].law)).collect(),
            n: program.coordinates,
            reactions: program.reactions,
            supports: if program.joined.is_empty() { Vec::new() } else { program.hidden.clone() },
            motors: program.solved.iter().copied().filter(motor).collect(),
            angles: equations.coordinates.iter().map(|c| c.unit == "rad").collect(),
            values: Vec::new(),
            sides: Switches::default(),
            kept: Kept::default(),
            active: Vec::with_capacity(rows.len()),
            arms: vec![0.0; rows.len()],
            spans: vec![0.0; rows.len()],
            moved: vec![0.0; rows.len()],
            fastest: 0.0,
            drifts: vec![[0.0; 2]; 2 * rows.len()],
            levers: vec![0.0; rows.len()],
            names: rows.iter().map(|row| equations.conditions[row.condition].name.clone()).collect(),
            rows,
            repeated: program.repeated,
            coordinates,
        }))
    }

    fn activate(&mut self, modes: &[Mode], bound: &Bound) {
        self.sides.set(modes, bound);
        self.active.clear();
        let mut active = std::mem::take(&mut self.active);
        active.extend((0..self.rows.len()).filter(|&row| self.holds_in(row, modes)));
        self.active = active;
    }

    /// All numbers at a state, switches by the values of their guards.
    pub(super) fn evaluate(&mut self, t: f64, x: &[f64]) -> Result<(), Fault> {
        self.evaluate_at(&Point { time: t, states: x, ..Point::default() })
    }

    /// The same on the side of these modes: at a switch its guard is rounding of either sign.
    pub(super) fn evaluate_in(&mut self, (t, x): (f64, &[f64]), (modes, bound): (&[Mode], &Bound)) -> Result<(), Fault> {
        self.sides.set(modes, bound);
        self.evaluate_on_side(t, x)
    }

    fn evaluate_on_side(&mut self, t: f64, x: &[f64]) -> Result<(), Fault> {
        self.count(t, x)?;
        let sides = std::mem::take(&mut self.sides);
        let point = Point { time: t, states: x, modes: Some(&sides.modes), active: Some(&sides.active), ..Point::default() };
        let done = self.evaluate_at(&point);
        self.sides = sides;
        done
    }

    fn evaluate_at(&mut self, point: &Point) -> Result<(), Fault> {
        let values = self.evaluator.evaluate(point)?;
        self.values.clear();
        self.values.extend_from_slice(values);
        Ok(())
    }

    pub(super) fn column(&self, row: usize) -> &[f64] {
        let start = self.roots.jacobian.start + self.rows[row].condition * self.n;
        &self.values[start..start + self.n]
    }

    fn place(&self, row: usize) -> f64 {
        match self.rows[row].has_place {
            true => self.values[self.roots.places.start + self.rows[row].condition],
            false if self.counts(row) => self.kept.places[row],
            false => 0.0,
        }
    }

    pub(super) fn rate(&self, row: usize) -> f64 {
        self.values[self.roots.rates.start + self.rows[row].condition]
    }

    /// Whether a rate jumps between two times at the same state, against the terms that meet in it: on the motion they cancel.
    pub(super) fn steps(&mut self, times: [f64; 2], x: &[f64]) -> Result<bool, Fault> {
        let [[earlier, before], [later, after]] = Leap::instants(times);
        let leap = Leap {
            before: [self.rates_at(earlier, x)?, self.rates_at(before, x)?],
            after: [self.rates_at(later, x)?, self.rates_at(after, x)?],
        };
        let size = |row: usize| self.rate_size(row, &x[self.n..2 * self.n]).max(leap.before[0][row].abs());
        Ok((0..self.rows.len()).any(|row| leap.of(row).abs() > STEPPED * size(row)))
    }

    /// The rates of all conditions.
    pub(super) fn rates_at(&mut self, t: f64, x: &[f64]) -> Result<Vec<f64>, Fault> {
        self.evaluate(t, x)?;
        Ok((0..self.rows.len()).map(|row| self.rate(row)).collect())
    }

    /// Their places, 0 of those that have none.
    pub(super) fn places_at(&mut self, t: f64, x: &[f64]) -> Option<Vec<f64>> {
        self.evaluate(t, x).ok()?;
        Some((0..self.rows.len()).map(|row| self.place(row)).collect())
    }

    /// What a place is compared with.
    pub(super) fn size_of_place(&self, row: usize, x: &[f64]) -> f64 {
        self.place_size(row, &x[..self.n]).max(self.arms[row])
    }

    /// The guard of a contact.
    pub(super) fn contact_of(&self, row: usize) -> Option<usize> {
        if let Holds::Closed(guard, _) = self.rows[row].holds { Some(guard) } else { None }
    }

    /// The contact, by guard, on which a row rolls.
    pub(super) fn rough_on(&self, row: usize) -> Option<usize> {
        if let Holds::Rough(guard) = self.rows[row].holds { Some(guard) } else { None }
    }

    /// Whether a condition is in force.
    pub(super) fn holds_in(&self, row: usize, modes: &[Mode]) -> bool {
        match self.rows[row].holds {
            Holds::Always => true,
            Holds::Sticking(guard, _) | Holds::Closed(guard, _) | Holds::Rough(guard) => modes[guard] == Mode::Zero,
        }
    }

    /// How large the terms are that meet in the place of a condition: arms times angles of one radian, or the lengths themselves.
    fn place_size(&self, row: usize, q: &[f64]) -> f64 {
        let largest = q.iter().zip(&self.angles).filter(|(_, angle)| !**angle).fold(0.0_f64, |m, (q, _)| m.max(q.abs()));
        self.column(row).iter().zip(&self.angles).map(|(j, angle)| j.abs() * if *angle { 1.0 } else { largest }).sum()
    }

    /// What the places and rates of contacts and frictions are compared with at a start, by guard: their levers times the largest of what moves on them. Metres and
    /// radians are no sizes of each other; an angle counts as one radian.
    pub(super) fn reaches(&mut self, t: f64, x: &[f64]) -> Option<Vec<(usize, [f64; 2])>> {
        self.evaluate(t, x).ok()?;
        let (q, rates) = (&x[..self.n], &x[self.n..2 * self.n]);
        let fastest = |turning: bool| {
            let alike = rates.iter().zip(&self.angles).filter(|(_, angle)| **angle == turning);
            alike.fold(0.0_f64, |m, (v, _)| m.max(v.abs()))
        };
        let [along, turning] = [false, true].map(fastest);
        let rate = |row: usize| -> f64 {
            self.column(row).iter().zip(&self.angles).map(|(j, angle)| j.abs() * if *angle { turning } else { along }).sum()
        };
        let one = |(row, held): (usize, &Row)| match held.holds {
            Holds::Sticking(guard, _) | Holds::Closed(guard, _) => Some((guard, [self.place_size(row, q), rate(row)])),
            Holds::Always | Holds::Rough(_) => None,
        };
        Some(self.rows.iter().enumerate().filter_map(one).collect())
    }

    /// Terms that meet in its rate.
    pub(super) fn rate_size(&self, row: usize, rates: &[f64]) -> f64 {
        let moved: f64 = self.column(row).iter().zip(rates).map(|(j, v)| j.abs() * v.abs()).sum();
        moved.max(self.rate(row).abs())
    }

    fn violation(&self, row: usize, x: &[f64], of: Level) -> f64 {
        let (q, rates) = (&x[..self.n], &x[self.n..2 * self.n]);
        let (value, size) = match of {
            Level::Place => (self.place(row).abs(), self.place_size(row, q).max(self.arms[row])),
            Level::Rate => (self.rate(row).abs(), self.rate_size(row, rates).max(STILL * self.moved[row])),
        };
        if value == 0.0 { 0.0 } else { value / size }
    }

    /// Largest relative violation of places or rates.
    fn worst(&self, x: &[f64], of: Level) -> f64 {
        self.active.iter().fold(0.0_f64, |worst, &row| worst.max(self.violation(row, x, of)))
    }

    /// Violation of a rate, relative to the rates that the machine has had.
    fn slip(&self, row: usize, x: &[f64]) -> f64 {
        let size = self.slip_size(row, x);
        if size > 0.0 { self.rate(row).abs() / size } else { 0.0 }
    }

    /// What a slip is compared with: terms of the rate, now and so far, and the fastest coordinate on these levers.
    fn slip_size(&self, row: usize, x: &[f64]) -> f64 {
        let levers: f64 = self.column(row).iter().map(|j| j.abs()).sum();
        self.rate_size(row, &x[self.n..2 * self.n]).max(self.moved[row]).max(levers.max(self.levers[row]) * self.fastest)
    }

    fn is_sticking(&self, row: usize) -> bool {
        matches!(self.rows[row].holds, Holds::Sticking(..))
    }

    fn remember_arms(&mut self, x: &[f64]) {
        for k in 0..self.active.len() {
            let row = self.active[k];
            self.arms[row] = self.arms[row].max(self.place_size(row, &x[..self.n]));
        }
    }

    /// What meets in the places as they were computed: at a start where all lengths of the state vanish the prescribed ones are left.
    fn remember_terms(&mut self) {
        let off = self.rounding_of_places();
        for k in 0..self.active.len() {
            let row = self.active[k];
            self.arms[row] = self.arms[row].max(off[row] / ROUNDING);
        }
    }

    /// Rounding of the place of each row in the last numbers, by running error analysis; 0 where there is none.
    fn rounding_of_places(&self) -> Vec<f64> {
        let off = Behind::default().rounding(&self.evaluator, &[], &[], &mut Vec::new());
        let of = |row: &Row| off.get(self.roots.places.start + row.condition).copied().filter(|off| row.has_place && off.is_finite());
        self.rows.iter().map(|row| of(row).unwrap_or(0.0)).collect()
    }

    /// The same of the gaps of contacts at a state, by guard.
    pub(super) fn rounding_of_gaps(&mut self, t: f64, x: &[f64]) -> Vec<(usize, f64)> {
        if self.evaluate(t, x).is_err() {
            return Vec::new();
        }
        let off = self.rounding_of_places();
        (0..self.rows.len()).filter_map(|row| Some((self.contact_of(row)?, off[row]))).collect()
    }

    fn remember_rates(&mut self, x: &[f64]) {
        self.fastest = x[self.n..2 * self.n].iter().fold(self.fastest, |m, v| m.max(v.abs()));
        for k in 0..self.active.len() {
            let row = self.active[k];
            // what sticks is compared with itself, so that it stands exactly
            if !self.is_sticking(row) {
                let size = self.rate_size(row, &x[self.n..2 * self.n]).max(self.levers[row] * self.fastest);
                self.moved[row] = self.moved[row].max(size);
            }
        }
    }

    /// Whether conditions that always hold repeat each other.
    pub(super) fn has_repeated(&self) -> bool {
        self.repeated > 0
    }

    /// Makes the conditions that always hold the active ones.
    pub(super) fn activate_ideal(&mut self) {
        self.active.clear();
        self.active.extend((0..self.rows.len()).filter(|&k| self.rows[k].holds == Holds::Always));
    }

    /// See [`crate::System::repeats`].
    pub(super) fn repeats(&mut self, t: f64, x: &[f64], (modes, bound): (&[Mode], &Bound)) -> Result<usize, Fault> {
        let carries = |row: &Row| match row.holds {
            Holds::Sticking(guard, _) | Holds::Closed(guard, _) | Holds::Rough(guard) => {
                modes[guard] == Mode::Zero && row.share.is_some_and(|share| modes[share] == Mode::Positive)
            }
            Holds::Always => false,
        };
        let own: Vec<usize> = (0..self.rows.len()).filter(|&k| carries(&self.rows[k])).collect();
        if own.is_empty() {
            return Ok(0);
        }
        self.evaluate_in((t, x), (modes, bound))?;
        self.activate_ideal();
        let ideal = self.rank_of(&self.active);
        self.active.extend(&own);
        Ok((ideal + own.len()).saturating_sub(self.rank_of(&self.active)))
    }

    /// How many of these rows are independent in the last numbers.
    pub(super) fn rank_of(&self, rows: &[usize]) -> usize {
        let (n, m) = (self.n, rows.len());
        let columns: Vec<f64> = (0..n * m).map(|k| self.column(rows[k % m])[k / m]).collect();
        Qr::new(&columns, n, m).rank()
    }

    /// The guard by which a row may be left to others.
    pub(super) fn share_of(&self, row: usize) -> Option<usize> {
        self.rows[row].share
    }
}

fn rebound(law: &Law) -> Option<Rebound> {
    if let Law::Contact { rebound, .. } = law { Some(*rebound) } else { None }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Level {
    Place,
    Rate,
}
