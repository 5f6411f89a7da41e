//! The nearest state that keeps the conditions, in the metric of the mass matrix, and how near the conditions are to depending on each other.

use super::{AROUND, CANCELS, CONTRADICTS, Conditions, Holds, INSIDE, Level, MANY, MOVED, REACHED, ROUNDING, STEPS};
use crate::{Fault, Mode};
use algebra::cholesky::{Cholesky, is_firm};
use algebra::elementary;
use algebra::qr::Qr;
use algebra::random::Random;
use program::Bound;

impl Conditions {
    /// See [`crate::System::project`].
    pub(in crate::machine) fn project(&mut self, t: f64, x: &mut [f64], (modes, bound): (&[Mode], &Bound)) -> Result<f64, Fault> {
        self.drifts.fill([0.0; 2]);
        self.activate(modes, bound);
        if self.active.is_empty() {
            return Ok(0.0);
        }
        self.evaluate_on_side(t, x)?;
        self.remember_arms(x);
        let mut place = self.worst(x, Level::Place);
        if place > REACHED {
            self.remember_terms();
            place = self.worst(x, Level::Place);
        }
        for k in 0..self.active.len() {
            let row = self.active[k];
            self.drifts[row] = [self.place(row).abs(), self.arms[row]];
        }
        if place > ROUNDING {
            self.close(t, x, Level::Place, place)?;
        }
        self.remember_spans();
        self.remember_rates(x);
        let rate = self.worst(x, Level::Rate);
        for k in 0..self.active.len() {
            let row = self.active[k];
            if !self.is_sticking(row) {
                self.drifts[self.rows.len() + row] = [self.rate(row).abs(), self.slip_size(row, x)];
            }
        }
        let drift = self.active.iter().filter(|row| !self.is_sticking(**row)).fold(place, |m, &row| m.max(self.slip(row, x)));
        if rate > ROUNDING {
            self.close(t, x, Level::Rate, rate)?;
        }
        self.check_repeated(x)?;
        Ok(if place > ROUNDING || rate > ROUNDING { drift.max(f64::MIN_POSITIVE) } else { 0.0 })
    }

    /// See [`crate::System::polish`].
    pub(in crate::machine) fn polish(&mut self, t: f64, x: &mut [f64], (modes, bound): (&[Mode], &Bound)) -> Result<(), Fault> {
        self.activate(modes, bound);
        if self.active.is_empty() {
            return Ok(());
        }
        self.evaluate_on_side(t, x)?;
        for level in [Level::Place, Level::Rate] {
            self.close(t, x, level, self.worst(x, level))?;
        }
        Ok(())
    }

    /// See [`crate::System::drifts`].
    pub(in crate::machine) fn drifts(&self) -> &[[f64; 2]] {
        &self.drifts
    }

    /// What repeats other conditions must hold through these: prescribed places may part.
    fn check_repeated(&self, x: &[f64]) -> Result<(), Fault> {
        let lasting = |row: &&usize| self.repeated > 0 && self.rows[**row].holds == Holds::Always;
        for &row in self.active.iter().filter(lasting) {
            let levers = self.levers[row].max(self.column(row).iter().map(|j| j.abs()).sum());
            let parted = |value: f64, size: f64| value.abs() > (CONTRADICTS * size).max(MOVED * levers);
            if parted(self.place(row), self.arms[row]) || parted(self.rate(row), self.slip_size(row, x)) {
                return Err(Fault::contradiction(&self.names[row], &crate::naming::configuration(self.coordinates.iter().zip(x))));
            }
        }
        Ok(())
    }

    /// Sizes of conditions that repeat others, from positions around the start: where the machine stands some may have no levers.
    pub(in crate::machine) fn look_around(&mut self, start: &[f64]) {
        let mut random = Random::new(7);
        self.activate_ideal();
        for _ in 0..if self.repeated > 0 { AROUND } else { 0 } {
            let mut x = start.to_vec();
            for (value, angle) in x.iter_mut().zip(&self.angles) {
                let unit = random.between(-1.0, 1.0);
                *value += if *angle { unit } else { 0.5 * unit * *value };
            }
            if self.evaluate(0.0, &x).is_err() {
                continue;
            }
            for k in 0..self.active.len() {
                let row = self.active[k];
                let levers: f64 = self.column(row).iter().map(|j| j.abs()).sum();
                if levers.is_finite() {
                    self.levers[row] = self.levers[row].max(levers);
                }
            }
            self.remember_arms(&x);
            self.remember_spans();
        }
    }

    /// Newton's method on one level, as long as it helps.
    pub(super) fn close(&mut self, t: f64, x: &mut [f64], level: Level, mut violation: f64) -> Result<(), Fault> {
        let part = match level {
            Level::Place => 0..self.n,
            Level::Rate => self.n..2 * self.n,
        };
        let start = x[part.clone()].to_vec();
        let mut best = x.to_vec();
        // where all rates vanish each is compared with itself, and only their size tells whether they still fall
        let mut left = self.left(level);
        for _ in 0..STEPS {
            let change = self.least_change(level);
            for ((value, change), start) in x[part.clone()].iter_mut().zip(&change).zip(&start) {
                let next = *value - change;
                // what cancels to rounding is zero: a body that sticks must not creep
                *value = if level == Level::Rate && next.abs() <= CANCELS * start.abs().max(value.abs()) { 0.0 } else { next };
            }
            self.evaluate_on_side(t, x)?;
            let (now, smaller) = (self.worst(x, level), self.left(level));
            let falls = smaller < 0.5 * left;
            let helps = now < 0.5 * violation || falls;
            if now < violation || falls {
                (violation, best) = (now, x.to_vec());
            }
            left = left.min(smaller);
            if !helps || now <= ROUNDING {
                break;
            }
        }
        if best != x {
            x.copy_from_slice(&best);
            self.evaluate_on_side(t, x)?;
        }
        // rates that vanish leave nothing to compare with
        if level == Level::Place && violation > REACHED {
            self.check_repeated(x)?;
            return Err(Fault::lost_conditions(violation, t));
        }
        Ok(())
    }

    /// Largest rate of the active rows by their levers; of places nothing more is known than their violation.
    pub(super) fn left(&self, level: Level) -> f64 {
        let rate = |row: &usize| {
            let levers: f64 = self.column(*row).iter().map(|j| j.abs()).sum();
            if levers > 0.0 { self.rate(*row).abs() / levers } else { 0.0 }
        };
        if level == Level::Rate { self.active.iter().map(rate).fold(0.0, f64::max) } else { 0.0 }
    }

    /// Change d with J d = the violations of the active rows and least d' M d.
    fn least_change(&mut self, level: Level) -> Vec<f64> {
        let (n, m) = (self.n, self.active.len());
        let wanted: Vec<f64> =
            self.active.iter().map(|&row| if level == Level::Place { self.place(row) } else { self.rate(row) }).collect();
        let factor = self.metric();
        let mut change =
            if self.repeated > 0 { self.least_of_repeated(&wanted) } else { Qr::new(&self.gradients_by(&factor), n, m).shortest(&wanted) };
        factor.backward(&mut change);
        change
    }

    /// The least change where conditions repeat each other: by those that are independent here.
    fn least_of_repeated(&mut self, wanted: &[f64]) -> Vec<f64> {
        self.remember_spans();
        let columns = self.measured();
        let spans = self.active.iter().map(|row| self.spans[*row]);
        let wanted: Vec<f64> = wanted.iter().zip(spans).map(|(w, span)| if span > 0.0 { w / span } else { *w }).collect();
        self.independent(&columns).shortest(&wanted)
    }

    /// Factors of measured gradients, as many of them as can be independent.
    pub(in crate::machine) fn independent(&self, columns: &[f64]) -> Qr {
        let m = self.active.len();
        Qr::measured(columns, self.n, m, m.saturating_sub(self.repeated))
    }

    /// Gradients of the active rows, each relative to its largest so far.
    pub(in crate::machine) fn measured(&self) -> Vec<f64> {
        let (n, m) = (self.n, self.active.len());
        let mut columns = self.gradients();
        for (k, &row) in self.active.iter().enumerate() {
            let span = (0..n).fold(0.0_f64, |span, i| elementary::hypot(span, columns[i * m + k]));
            let largest = self.spans[row].max(span);
            (0..n).filter(|_| span > 0.0).for_each(|i| columns[i * m + k] /= largest);
        }
        columns
    }

    /// Keeps the sizes of the gradients of a state that the machine has: what a series says far ahead may be none.
    fn remember_spans(&mut self) {
        let (n, m) = (self.n, self.active.len());
        let columns = self.gradients();
        for (k, &row) in self.active.iter().enumerate() {
            let span = (0..n).fold(0.0_f64, |span, i| elementary::hypot(span, columns[i * m + k]));
            self.spans[row] = self.spans[row].max(span);
        }
    }

    /// See [`crate::System::margin`].
    pub(in crate::machine) fn margin(&mut self, t: f64, x: &[f64]) -> Option<f64> {
        self.activate_ideal();
        if self.active.is_empty() || self.evaluate(t, x).is_err() {
            return None;
        }
        let columns = self.measured();
        let factors = if self.repeated > 0 { self.independent(&columns) } else { Qr::new(&columns, self.n, self.active.len()) };
        Some(factors.least_pivot())
    }

    /// See [`crate::System::margins`].
    pub(in crate::machine) fn margins(&self) -> usize {
        if self.rows.len() <= MANY { INSIDE } else { 0 }
    }

    /// C^-1 J' of the active rows, row-major.
    pub(super) fn gradients(&self) -> Vec<f64> {
        self.gradients_by(&self.metric())
    }

    /// The same where C is known.
    fn gradients_by(&self, factor: &Cholesky) -> Vec<f64> {
        let (n, m) = (self.n, self.active.len());
        let mut columns = vec![0.0; n * m];
        for (k, &row) in self.active.iter().enumerate() {
            let mut a = self.column(row).to_vec();
            factor.forward(&mut a);
            (0..n).for_each(|i| columns[i * m + k] = a[i]);
        }
        columns
    }

    /// C of M = C C'.
    pub(in crate::machine) fn metric(&self) -> Cholesky {
        let n = self.n;
        let mass = &self.values[self.roots.mass.clone()];
        let at = |i: usize, j: usize| mass[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
        let full: Vec<f64> = (0..n * n).map(|k| at(k / n, k % n)).collect();
        if is_firm(&full, n)
            && let Ok(factor) = Cholesky::new(&full, n)
        {
            return factor;
        }
        let mut widened = full;
        for i in 0..n {
            let arms: f64 = self.active.iter().map(|&row| elementary::powi(self.column(row)[i], 2)).sum();
            widened[i * n + i] += if arms > 0.0 { arms } else { 1.0 };
        }
        Cholesky::new(&widened, n).unwrap_or_else(|_| Cholesky::identity(n))
    }
}
