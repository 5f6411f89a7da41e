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
//! **Impact.** Positions stand still, rates jump by impulses p:
//!
//! ```text
//! | M  -F' | | change of q' |   |            0             |   conditions kept, stuck frictions:  e = -1 + 1: J dq' = -rate
//! | J   0  | |      p       | = | -(1 + e) rate (closing)  |   dry friction that slides gives no impulse
//! ```

use std::sync::Arc;

use program::{Bound, ConnectionRoots, Evaluator, Point};
use symbolic::connections::Law;
use symbolic::{Equations, Text};

use crate::numerics::lu::Lu;
use crate::numerics::qr::Qr;
use crate::{Fault, Mode, Quantity};

/// Violations below this many units in the last place of the terms that meet in a condition are left alone.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// Share of its largest rate to which a machine at rest is compared.
const STILL: f64 = 1e-3;
/// Newton steps of one projection.
const STEPS: usize = 12;
/// Relative violation from which a condition left out as a repetition contradicts the others: far above rounding near singular positions.
const CONTRADICTS: f64 = 1e-7;
/// The same for machines at their origin, where nothing is left to compare with: metres, radians (and per second).
const MOVED: f64 = 1e-12;
/// Violation that a projection must reach.
const REACHED: f64 = 1e-9;

/// The conditions of a machine.
#[derive(Clone, Debug)]
pub(super) struct Conditions {
    evaluator: Evaluator,
    roots: ConnectionRoots,
    n: usize,
    rows: Vec<Row>,
    /// Conditions left out because they repeat others at the start: index, whether it has a place, name.
    repeated: Vec<(usize, bool, Text)>,
    /// Names and units, for messages.
    coordinates: Vec<Quantity>,
    /// Motors: reactions whose impulses keep prescribed motions.
    motors: Vec<usize>,
    /// Whether each coordinate is an angle, and has the size 1.
    angles: Vec<bool>,
    values: Vec<f64>,
    /// Rows in force.
    active: Vec<usize>,
    /// Largest terms of each row's place so far: in some positions all levers vanish.
    arms: Vec<f64>,
    /// Largest terms of each row's rate so far: a machine that stops for an instant has rates of its own size all the same.
    moved: Vec<f64>,
}

/// A condition that takes part.
#[derive(Clone, Debug)]
struct Row {
    condition: usize,
    has_place: bool,
    reaction: Option<usize>,
    holds: Holds,
}

/// When a condition holds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Holds {
    Always,
    /// While this guard is `Zero`.
    Sticking(usize),
    /// The same, with the index among the contacts.
    Closed(usize, usize),
}

impl Conditions {
    /// None when the machine has none.
    pub(super) fn new(equations: &Equations, bound: &Bound) -> Result<Option<Conditions>, Fault> {
        let program = bound.program();
        let contacts: Vec<usize> =
            (0..equations.reactions.len()).filter(|r| matches!(equations.reactions[*r].law, Law::Contact { .. })).collect();
        let (mut rows, mut repeated) = (Vec::new(), Vec::new());
        for (condition, c) in equations.conditions.iter().enumerate() {
            let holds = match c.reaction {
                None => Holds::Always,
                Some(r) if !program.solved.contains(&r) => {
                    if matches!(equations.reactions[r].law, Law::Ideal { .. }) {
                        repeated.push((condition, c.place.is_some(), c.name.clone()));
                    }
                    continue;
                }
                Some(r) => match (&equations.reactions[r].law, program.switches[r], contacts.iter().position(|k| *k == r)) {
                    (Law::Friction(_), Some(guard), _) => Holds::Sticking(guard),
                    (Law::Contact { .. }, Some(guard), Some(contact)) => Holds::Closed(guard, contact),
                    _ => Holds::Always,
                },
            };
            rows.push(Row { condition, has_place: c.place.is_some(), reaction: c.reaction, holds });
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
            n: program.coordinates,
            motors: program.solved.iter().copied().filter(motor).collect(),
            angles: equations.coordinates.iter().map(|c| c.unit == "rad").collect(),
            values: Vec::new(),
            active: Vec::with_capacity(rows.len()),
            arms: vec![0.0; rows.len()],
            moved: vec![0.0; rows.len()],
            rows,
            repeated,
            coordinates,
        }))
    }

    fn activate(&mut self, modes: &[Mode]) {
        self.active.clear();
        self.active.extend((0..self.rows.len()).filter(|&k| match self.rows[k].holds {
            Holds::Always => true,
            Holds::Sticking(guard) | Holds::Closed(guard, _) => modes[guard] == Mode::Zero,
        }));
    }

    fn evaluate(&mut self, t: f64, x: &[f64]) -> Result<(), Fault> {
        let values = self.evaluator.evaluate(&Point { time: t, states: x, ..Point::default() })?;
        self.values.clear();
        self.values.extend_from_slice(values);
        Ok(())
    }

    fn column(&self, row: usize) -> &[f64] {
        let start = self.roots.jacobian.start + self.rows[row].condition * self.n;
        &self.values[start..start + self.n]
    }

    fn place(&self, row: usize) -> f64 {
        if self.rows[row].has_place { self.values[self.roots.places.start + self.rows[row].condition] } else { 0.0 }
    }

    fn rate(&self, row: usize) -> f64 {
        self.values[self.roots.rates.start + self.rows[row].condition]
    }

    /// How large the terms are that meet in the place of a condition: arms times angles of one radian, or the lengths themselves.
    fn place_size(&self, row: usize, q: &[f64]) -> f64 {
        let largest = q.iter().zip(&self.angles).filter(|(_, angle)| !**angle).fold(0.0_f64, |m, (q, _)| m.max(q.abs()));
        self.column(row).iter().zip(&self.angles).map(|(j, angle)| j.abs() * if *angle { 1.0 } else { largest }).sum()
    }

    /// Terms that meet in its rate.
    fn rate_size(&self, row: usize, rates: &[f64]) -> f64 {
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
        let size = self.rate_size(row, &x[self.n..2 * self.n]).max(self.moved[row]);
        if size > 0.0 { self.rate(row).abs() / size } else { 0.0 }
    }

    fn is_sticking(&self, row: usize) -> bool {
        matches!(self.rows[row].holds, Holds::Sticking(_))
    }

    fn remember_arms(&mut self, x: &[f64]) {
        for k in 0..self.active.len() {
            let row = self.active[k];
            self.arms[row] = self.arms[row].max(self.place_size(row, &x[..self.n]));
        }
    }

    fn remember_rates(&mut self, x: &[f64]) {
        for k in 0..self.active.len() {
            let row = self.active[k];
            // what sticks is compared with itself, so that it stands exactly
            if !self.is_sticking(row) {
                self.moved[row] = self.moved[row].max(self.rate_size(row, &x[self.n..2 * self.n]));
            }
        }
    }

    /// See [`crate::System::project`].
    pub(super) fn project(&mut self, t: f64, x: &mut [f64], modes: &[Mode]) -> Result<f64, Fault> {
        self.activate(modes);
        if self.active.is_empty() {
            return Ok(0.0);
        }
        self.evaluate(t, x)?;
        self.remember_arms(x);
        let place = self.worst(x, Level::Place);
        if place > ROUNDING {
            self.close(t, x, Level::Place, place)?;
        }
        self.remember_rates(x);
        let rate = self.worst(x, Level::Rate);
        let drift = self.active.iter().filter(|row| !self.is_sticking(**row)).fold(place, |m, &row| m.max(self.slip(row, x)));
        if rate > ROUNDING {
            self.close(t, x, Level::Rate, rate)?;
        }
        self.check_repeated(x)?;
        Ok(if place > ROUNDING || rate > ROUNDING { drift.max(f64::MIN_POSITIVE) } else { 0.0 })
    }

    /// What repeated other conditions at the start must go on doing so: prescribed places may part later.
    fn check_repeated(&self, x: &[f64]) -> Result<(), Fault> {
        for (condition, has_place, name) in &self.repeated {
            let start = self.roots.jacobian.start + condition * self.n;
            let column = &self.values[start..start + self.n];
            let size = |part: &[f64]| column.iter().zip(part).map(|(j, v)| j.abs() * v.abs()).sum::<f64>();
            let unit: f64 = column.iter().map(|j| j.abs()).sum();
            let parted = |value: f64, size: f64| value.abs() > (CONTRADICTS * size).max(MOVED * unit);
            let place = if *has_place { self.values[self.roots.places.start + condition] } else { 0.0 };
            let rate = self.values[self.roots.rates.start + condition];
            if parted(place, size(&x[..self.n])) || parted(rate, size(&x[self.n..2 * self.n])) {
                return Err(Fault::contradiction(name, &super::configuration(self.coordinates.iter().zip(x))));
            }
        }
        Ok(())
    }

    /// Newton's method on one level, as long as it helps.
    fn close(&mut self, t: f64, x: &mut [f64], level: Level, mut violation: f64) -> Result<(), Fault> {
        let part = match level {
            Level::Place => 0..self.n,
            Level::Rate => self.n..2 * self.n,
        };
        let mut best = x.to_vec();
        for _ in 0..STEPS {
            let change = self.least_change(level);
            for (value, change) in x[part.clone()].iter_mut().zip(&change) {
                let next = *value - change;
                // what cancels to rounding is zero: a body that sticks must not creep
                *value = if level == Level::Rate && next.abs() <= 8.0 * f64::EPSILON * value.abs() { 0.0 } else { next };
            }
            self.evaluate(t, x)?;
            let now = self.worst(x, level);
            let helps = now < 0.5 * violation;
            if now < violation {
                (violation, best) = (now, x.to_vec());
            }
            if !helps || now <= ROUNDING {
                break;
            }
        }
        if best != x {
            x.copy_from_slice(&best);
            self.evaluate(t, x)?;
        }
        // rates that vanish leave nothing to compare with
        if level == Level::Place && violation > REACHED {
            return Err(Fault::lost_conditions(violation, t));
        }
        Ok(())
    }

    /// Change d with J d = the violations of the active rows and least d' M d.
    fn least_change(&self, level: Level) -> Vec<f64> {
        let (n, m) = (self.n, self.active.len());
        let wanted: Vec<f64> =
            self.active.iter().map(|&row| if level == Level::Place { self.place(row) } else { self.rate(row) }).collect();
        let factor = self.metric();
        let mut columns = vec![0.0; n * m];
        for (k, &row) in self.active.iter().enumerate() {
            let mut a = self.column(row).to_vec();
            forward(&factor, n, &mut a);
            (0..n).for_each(|i| columns[i * m + k] = a[i]);
        }
        let mut change = Qr::new(&columns, n, m).shortest(&wanted);
        backward(&factor, n, &mut change);
        change
    }

    /// C of M = C C', row-major.
    fn metric(&self) -> Vec<f64> {
        let n = self.n;
        let mass = &self.values[self.roots.mass.clone()];
        let at = |i: usize, j: usize| mass[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
        let full: Vec<f64> = (0..n * n).map(|k| at(k / n, k % n)).collect();
        if let Some(factor) = cholesky(&full, n) {
            return factor;
        }
        let mut widened = full;
        for i in 0..n {
            let arms: f64 = self.active.iter().map(|&row| self.column(row)[i].powi(2)).sum();
            widened[i * n + i] += if arms > 0.0 { arms } else { 1.0 };
        }
        cholesky(&widened, n).unwrap_or_else(|| (0..n * n).map(|k| if k / n == k % n { 1.0 } else { 0.0 }).collect())
    }

    /// See [`crate::System::impact`].
    pub(super) fn impact(&mut self, t: f64, x: &mut [f64], modes: &[Mode], closing: &[usize]) -> Result<Vec<f64>, Fault> {
        self.activate(modes);
        let hit = |row: &Row| if let Holds::Closed(guard, _) = row.holds { closing.iter().position(|c| *c == guard) } else { None };
        let new: Vec<usize> = (0..self.rows.len()).filter(|k| hit(&self.rows[*k]).is_some() && !self.active.contains(k)).collect();
        self.active.extend(new);
        self.evaluate(t, x)?;
        let (n, m) = (self.n, self.active.len());
        let size = n + m;
        let mut matrix = vec![0.0; size * size];
        let mut right = vec![0.0; size];
        let mass = &self.values[self.roots.mass.clone()];
        for i in 0..n {
            for j in 0..n {
                matrix[i * size + j] = mass[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
            }
        }
        let mut motors = self.motors.iter();
        let mut places = vec![0; closing.len()];
        for (k, &row) in self.active.iter().enumerate() {
            matrix[(n + k) * size..(n + k) * size + n].copy_from_slice(self.column(row));
            let pushes = match self.rows[row].reaction.or_else(|| motors.next().copied()) {
                Some(reaction) => {
                    let start = self.roots.forces.start + reaction * n;
                    &self.values[start..start + n]
                }
                None => self.column(row),
            };
            (0..n).for_each(|i| matrix[i * size + n + k] = -pushes[i]);
            let restitution = match (self.rows[row].holds, hit(&self.rows[row])) {
                (Holds::Closed(_, contact), Some(place)) => {
                    places[place] = n + k;
                    self.values[self.roots.restitutions.start + contact]
                }
                _ => 0.0,
            };
            right[n + k] = -(1.0 + restitution) * self.rate(row);
        }
        let solution = match Lu::new(&matrix, size).solve(&right) {
            Some(solution) => solution,
            None => self.shared_impact(&right[n..]).ok_or_else(|| Fault::undetermined_impact(t))?,
        };
        for i in 0..n {
            x[n + i] += solution[i];
        }
        Ok(places.iter().map(|&place| solution[place]).collect())
    }
}

impl Conditions {
    /// An impact in which active rows repeat each other (a block that lies on two supports is hit): rates are unique all the same, of the impulses one
    /// choice is given. None when the changes of rates contradict each other, or with motors.
    fn shared_impact(&self, changes: &[f64]) -> Option<Vec<f64>> {
        if !self.motors.is_empty() {
            return None;
        }
        let (n, m) = (self.n, self.active.len());
        let factor = self.metric();
        let mut columns = vec![0.0; n * m];
        for (k, &row) in self.active.iter().enumerate() {
            let mut a = self.column(row).to_vec();
            forward(&factor, n, &mut a);
            (0..n).for_each(|i| columns[i * m + k] = a[i]);
        }
        let qr = Qr::new(&columns, n, m);
        let scaled = qr.shortest(changes);
        let met = |k: usize| (0..n).map(|i| columns[i * m + k] * scaled[i]).sum::<f64>();
        let largest = changes.iter().fold(0.0_f64, |l, c| l.max(c.abs()));
        if (0..m).any(|k| (met(k) - changes[k]).abs() > 1e-9 * largest) {
            return None;
        }
        let (impulses, _) = qr.least_squares(&scaled);
        let mut solution = scaled;
        backward(&factor, n, &mut solution);
        solution.extend(impulses);
        Some(solution)
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Level {
    Place,
    Rate,
}

/// Lower factor C of a symmetric positive definite matrix C C'; none when it is not.
fn cholesky(matrix: &[f64], n: usize) -> Option<Vec<f64>> {
    let mut c = vec![0.0; n * n];
    for i in 0..n {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| c[i * n + k] * c[j * n + k]).sum();
            let left = matrix[i * n + j] - known;
            if i == j {
                // a massless direction leaves only rounding
                if left.is_nan() || left <= 1e-12 * matrix[i * n + i].abs() || left <= 0.0 {
                    return None;
                }
                c[i * n + i] = left.sqrt();
            } else {
                c[i * n + j] = left / c[j * n + j];
            }
        }
    }
    Some(c)
}

/// C^-1 b.
fn forward(c: &[f64], n: usize, b: &mut [f64]) {
    for i in 0..n {
        let known: f64 = (0..i).map(|j| c[i * n + j] * b[j]).sum();
        b[i] = (b[i] - known) / c[i * n + i];
    }
}

/// C^-T b.
fn backward(c: &[f64], n: usize, b: &mut [f64]) {
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|j| c[j * n + i] * b[j]).sum();
        b[i] = (b[i] - known) / c[i * n + i];
    }
}
