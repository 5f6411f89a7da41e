//! Frictions pressed by a force of two components, as of a pin: λ = c |R| with the signed coefficient c while they slide.
//!
//! R depends on λ itself. In the modes of the moment everything else is linear, so that
//!
//! ```text
//! R_i = R_i0 + Σ_j R_ij κ_j        R_i0 the solution with κ = 0, R_ij that of the homogeneous equations with κ_j = 1
//! κ_i = c_i |R_i|
//! one friction:   (1 - c² |R_1|²) κ² - 2 c² (R_0·R_1) κ - c² |R_0|² = 0,
//!                 κ = (c² R_0·R_1 + c √(c² (R_0·R_1)² + (1 - c² |R_1|²) |R_0|²)) / (1 - c² |R_1|²)
//! several:        Newton's method from κ = 0, whose steps stand one after another on the tape
//! ```
//!
//! While c |R_1| < 1 there is one root with the sign of c. Else there is none or there are two, the joint locks itself: a guard of its own keeps such a motion
//! from being taken. It is negative there in its mode `Positive` and positive everywhere in its mode `Negative`, so that no mode agrees with a joint that
//! locks itself and none but `Positive` with one that does not.

use super::connections::Connected;
use super::forms::Value;
use super::numbers::Journal;
use crate::{By, Fault, Register};
use symbolic::connections::{Friction, Normal};

/// Steps of Newton's method: the error of the first is of the order of c², and each squares it, in every coefficient of the series.
const STEPS: usize = 8;

type Pair = [Value; 2];

impl Connected<'_, '_, '_, '_> {
    /// Puts the friction moments into the right sides of their rows.
    pub(super) fn press_journals(&mut self, journals: &[Journal]) -> Result<(), Fault> {
        if journals.is_empty() {
            return Ok(());
        }
        let base = self.lowering.system(self.matrix.clone(), self.right.clone(), self.arrangement.spare.clone());
        let mut own = Vec::new();
        for journal in journals {
            own.push(self.force(journal.law, base, Constant::Counts)?);
        }
        let mut by = Vec::new();
        for journal in journals {
            let unit = self.unit(journal);
            let response = self.lowering.system(self.matrix.clone(), unit, self.arrangement.spare.clone());
            let mut list = Vec::new();
            for other in journals {
                list.push(self.force(other.law, response, Constant::Left)?);
            }
            by.push(list);
        }
        for (i, journal) in journals.iter().enumerate() {
            self.watch(journal, own[i], by[i][i]);
        }
        let coefficients: Vec<Value> = journals.iter().map(|j| j.coefficient).collect();
        let moments = match (&coefficients[..], &own[..]) {
            ([c], [own]) => vec![self.closed(*c, *own, by[0][0])],
            _ => self.iterated(&coefficients, &own, &by),
        };
        for (journal, moment) in journals.iter().zip(moments) {
            let before = self.lowering.classify(self.right[journal.row]);
            let sum = self.lowering.sum(&[(1.0, before), (1.0, moment)]);
            self.right[journal.row] = self.lowering.whole(sum);
        }
        Ok(())
    }

    /// Right side of a unit friction; nothing while it sticks by itself.
    fn unit(&mut self, journal: &Journal) -> Vec<Register> {
        let (one, zero) = (self.lowering.literal(1.0), self.lowering.literal(0.0));
        let rests = journal.share.map_or(zero, |share| self.lowering.branch(By::Mode(share), [one, one, zero]));
        let entry = self.lowering.branch(By::Mode(journal.sliding), [one, rests, one]);
        let entry = self.lowering.whole(entry);
        let zero = self.lowering.whole(zero);
        (0..self.size).map(|i| if i == journal.row { entry } else { zero }).collect()
    }

    /// Both components in a solution that begins at this register.
    fn force(&mut self, law: &Friction, first: Register, constant: Constant) -> Result<Pair, Fault> {
        let zero = self.lowering.literal(0.0);
        let mut pair = [zero; 2];
        for (slot, normal) in pair.iter_mut().zip(law.components()) {
            *slot = self.component(normal, first, &constant)?;
        }
        Ok(pair)
    }

    fn component(&mut self, normal: &Normal, first: Register, constant: &Constant) -> Result<Value, Fault> {
        let mut items = Vec::new();
        if let Constant::Counts = constant {
            items.push((1.0, self.lowering.value(normal.constant)?));
        }
        for (k, e) in &normal.terms {
            let Some(column) = self.columns[*k] else { continue };
            let factor = self.lowering.value(*e)?;
            items.push((1.0, self.lowering.times(factor, Value::Plain(Register(first.0 + column as u32)))));
        }
        Ok(self.lowering.sum(&items))
    }

    fn dot(&mut self, a: Pair, b: Pair) -> Value {
        let x = self.lowering.times(a[0], b[0]);
        let y = self.lowering.times(a[1], b[1]);
        self.lowering.sum(&[(1.0, x), (1.0, y)])
    }

    /// The guard (1 - c² |R_1|²) |R_0|, a force; |R_0| in its mode `Negative`, which therefore never holds.
    fn watch(&mut self, journal: &Journal, own: Pair, by: Pair) {
        let left = self.left(journal.coefficient, by);
        let square = self.dot(own, own);
        let size = self.lowering.root(square);
        let surface = self.lowering.times(left, size);
        self.lowering.define_guard(journal.unique, surface);
    }

    /// 1 - c² |R_1|².
    fn left(&mut self, c: Value, by: Pair) -> Value {
        let one = self.lowering.literal(1.0);
        let square = self.lowering.times(c, c);
        let response = self.dot(by, by);
        let product = self.lowering.times(square, response);
        self.lowering.sum(&[(1.0, one), (-1.0, product)])
    }

    fn closed(&mut self, c: Value, own: Pair, by: Pair) -> Value {
        let left = self.left(c, by);
        let (mixed, size) = (self.dot(own, by), self.dot(own, own));
        let mixed = self.lowering.times(c, mixed);
        let square = self.lowering.times(mixed, mixed);
        let rest = self.lowering.times(left, size);
        let sum = self.lowering.sum(&[(1.0, square), (1.0, rest)]);
        // where the joint locks itself the radicand may be negative: any number will do there
        let square = self.lowering.times(sum, sum);
        let size = self.lowering.root(square);
        let root = self.lowering.root(size);
        let top = self.lowering.sum(&[(1.0, mixed), (1.0, root)]);
        let top = self.lowering.times(c, top);
        self.lowering.quotient(top, left)
    }

    /// κ - (I - diag(c n) R)⁻¹ (κ - c |R|), n = R/|R|.
    fn iterated(&mut self, c: &[Value], own: &[Pair], by: &[Vec<Pair>]) -> Vec<Value> {
        let count = c.len();
        let zero = self.lowering.literal(0.0);
        let one = self.lowering.literal(1.0);
        let mut moments = vec![zero; count];
        for _ in 0..STEPS {
            let (mut matrix, mut right) = (Vec::with_capacity(count * count), Vec::with_capacity(count));
            for i in 0..count {
                let force: Pair = [0, 1].map(|axis| {
                    let mut items = vec![(1.0, own[i][axis])];
                    for (j, moment) in moments.iter().enumerate() {
                        items.push((1.0, self.lowering.times(by[j][i][axis], *moment)));
                    }
                    self.lowering.sum(&items)
                });
                let square = self.dot(force, force);
                let size = self.lowering.root(square);
                let share = self.lowering.quotient(c[i], size);
                for (j, responses) in by.iter().enumerate() {
                    let along = self.dot(force, responses[i]);
                    let slope = self.lowering.times(share, along);
                    let unit = if i == j { one } else { zero };
                    matrix.push(self.lowering.sum(&[(1.0, unit), (-1.0, slope)]));
                }
                let wanted = self.lowering.times(c[i], size);
                right.push(self.lowering.sum(&[(1.0, wanted), (-1.0, moments[i])]));
            }
            let change = self.eliminate(matrix, right);
            for (moment, change) in moments.iter_mut().zip(change) {
                *moment = self.lowering.sum(&[(1.0, *moment), (1.0, change)]);
            }
        }
        moments
    }

    /// Gaussian elimination without exchanges: the matrix is close to the unit matrix.
    fn eliminate(&mut self, mut a: Vec<Value>, mut b: Vec<Value>) -> Vec<Value> {
        let n = b.len();
        for k in 0..n {
            for i in (0..n).filter(|i| *i != k) {
                let factor = self.lowering.quotient(a[i * n + k], a[k * n + k]);
                for j in k..n {
                    let part = self.lowering.times(factor, a[k * n + j]);
                    a[i * n + j] = self.lowering.sum(&[(1.0, a[i * n + j]), (-1.0, part)]);
                }
                let part = self.lowering.times(factor, b[k]);
                b[i] = self.lowering.sum(&[(1.0, b[i]), (-1.0, part)]);
            }
        }
        (0..n).map(|k| self.lowering.quotient(b[k], a[k * n + k])).collect()
    }
}

/// Whether the part free of reactions counts.
enum Constant {
    Counts,
    Left,
}
