//! Systems A x = b of any kind: motion and reactions together.
//!
//! A is neither symmetric (motors, friction that follows a normal force) nor positive. Rows are eliminated in the given order, each with the
//! largest remaining entry of the row as its pivot, entries being compared after scaling of rows and columns: Gaussian elimination with partial
//! pivoting of the transposed matrix (Golub and Van Loan, Matrix Computations, section 3.4), hence as stable. The order of the rows is kept because the
//! conditions come first: accelerations that conditions alone determine are then found from these alone, and a block that is held stays at exactly 0
//! whatever the forces on it are.
//!
//! A, L and U are kept as lists of entries that are not zero: a row of a mechanism has few. Rows are worked through in the order of the columns, so that sums are
//! those of the whole rows.

use crate::solve::{Defect, SINGULAR};
use crate::spare::{Spare, leave_out};

/// A factored matrix; reused from call to call without allocation.
#[derive(Clone, Debug, Default)]
pub(crate) struct General {
    size: usize,
    /// Entries of A that are not zero, by rows.
    matrix: Vec<f64>,
    /// Their columns; ends by row.
    pattern: Vec<u32>,
    bounds: Vec<usize>,
    /// Largest entry of each row and, after division by it, of each column.
    rows: Vec<f64>,
    columns: Vec<f64>,
    /// Column and value of the pivot of each row.
    pivots: Vec<(usize, f64)>,
    used: Vec<bool>,
    /// The row whose pivot each column is; [`OPEN`] for none yet.
    owner: Vec<u32>,
    /// Rows before that the row under elimination still needs, one bit each.
    pending: Vec<u64>,
    /// Columns of the row under elimination that may not be zero.
    columns_here: Vec<u32>,
    marked: Vec<bool>,
    /// Multipliers of earlier rows, then what stands right of the pivot: (index, value) by row; ends of both lists by row.
    lower: Vec<(u32, f64)>,
    upper: Vec<(u32, f64)>,
    ends: Vec<(usize, usize)>,
    /// Row under elimination, later the solution.
    row: Vec<f64>,
    rest: Vec<f64>,
    /// Rows that repeat others here: their right sides are 0. Empty where none can.
    out: Vec<bool>,
    /// All entries of a matrix with spare rows.
    whole: Vec<f64>,
}

/// A column without a pivot.
const OPEN: u32 = u32::MAX;

impl General {
    /// Takes the matrix by its entries: place i n + j and value, by rows. Places left out are zero. Of spare rows those that repeat others here are left out.
    pub(crate) fn load(&mut self, (size, spare): (usize, Option<&Spare>), entries: impl Iterator<Item = (u32, f64)>) {
        self.size = size;
        self.out.clear();
        match spare {
            None => self.collect(entries),
            Some(spare) => {
                let mut whole = std::mem::take(&mut self.whole);
                refill(&mut whole, size * size, 0.0);
                entries.for_each(|(place, value)| whole[place as usize] = value);
                self.out.resize(size, false);
                leave_out(spare, &mut whole, &mut self.out);
                self.collect((0..).zip(whole.iter().copied()));
                self.whole = whole;
            }
        }
        self.row.resize(size, 0.0);
        self.rest.resize(size, 0.0);
    }

    fn collect(&mut self, entries: impl Iterator<Item = (u32, f64)>) {
        let size = self.size as u32;
        self.matrix.clear();
        self.pattern.clear();
        self.bounds.clear();
        self.bounds.push(0);
        let mut end_of_row = size;
        for (place, value) in entries {
            while place >= end_of_row {
                self.bounds.push(self.pattern.len());
                end_of_row += size;
            }
            if value != 0.0 {
                self.pattern.push(place + size - end_of_row);
                self.matrix.push(value);
            }
        }
        self.bounds.resize(self.size + 1, self.pattern.len());
    }

    /// Entries that are not finite pass through and spoil the solution, which is reported where it is used.
    ///
    /// Where lengths and masses are far from 1 in their units, an inertia of 1e-22 kg m² beside an arm of 1e-5 m is rounding by its size in the row alone. A matrix that
    /// seems singular so is judged once more in units in which all inertias are 1.
    pub(crate) fn factor(&mut self) -> Result<(), Defect> {
        self.measure();
        self.eliminated().or_else(|defect| if self.measure_by_inertias() { self.eliminated().map_err(|_| defect) } else { Err(defect) })
    }

    fn eliminated(&mut self) -> Result<(), Defect> {
        let n = self.size;
        self.pivots.clear();
        refill(&mut self.used, n, false);
        refill(&mut self.owner, n, OPEN);
        refill(&mut self.marked, n, false);
        refill(&mut self.pending, n.div_ceil(64), 0);
        self.row.fill(0.0);
        self.lower.clear();
        self.upper.clear();
        self.ends.clear();
        let mut failed = None;
        for i in 0..n {
            self.eliminate(i);
            match self.choose(i) {
                Some(column) => self.keep(column),
                None => {
                    failed = failed.or(Some(i));
                    self.pivots.push((0, f64::NAN));
                }
            }
            self.clear_row();
            self.ends.push((self.lower.len(), self.upper.len()));
        }
        match failed {
            None => Ok(()),
            Some(row) => Err(Defect::Dependent { row, unknown: self.used.iter().position(|u| !u).unwrap_or(0) }),
        }
    }

    fn measure(&mut self) {
        let n = self.size;
        self.rows.clear();
        self.columns.clear();
        self.columns.resize(n, 0.0);
        for ends in self.bounds.windows(2) {
            let entries = || (ends[0]..ends[1]).map(|k| (self.pattern[k] as usize, self.matrix[k].abs()));
            let largest = entries().fold(0.0_f64, |m, (_, a)| m.max(a));
            self.rows.push(largest);
            for (j, a) in entries() {
                let scaled = a / largest;
                if scaled > self.columns[j] {
                    self.columns[j] = scaled;
                }
            }
        }
    }

    fn entry(&self, i: usize, j: usize) -> f64 {
        let range = self.bounds[i]..self.bounds[i + 1];
        range.into_iter().find(|k| self.pattern[*k] as usize == j).map_or(0.0, |k| self.matrix[k])
    }

    /// The row of the first equation of motion: those of n accelerations are the last n rows, and with the first n columns the symmetric mass matrix. None where
    /// the matrix is of another kind, or an inertia is zero.
    fn first_motion(&self) -> Option<usize> {
        (0..self.size).find(|c| {
            let n = self.size - c;
            let positive = (0..n).all(|j| self.entry(c + j, j) > 0.0);
            positive && (0..n).all(|i| (0..i).all(|j| self.entry(c + i, j) == self.entry(c + j, i)))
        })
    }

    /// Scales in units in which each acceleration has the inertia 1 (columns by √M_jj) and each reaction is measured by the largest acceleration that it gives.
    fn measure_by_inertias(&mut self) -> bool {
        let Some(first) = self.first_motion() else { return false };
        let n = self.size - first;
        for j in 0..n {
            self.columns[j] = self.entry(first + j, j).sqrt();
        }
        self.columns[n..].fill(0.0);
        for i in first..self.size {
            for k in self.bounds[i]..self.bounds[i + 1] {
                let j = self.pattern[k] as usize;
                if j >= n {
                    self.columns[j] = self.columns[j].max(self.matrix[k].abs() / self.columns[i - first]);
                }
            }
        }
        // a reaction that moves nothing has no measure
        if self.columns.contains(&0.0) {
            return false;
        }
        for i in 0..self.size {
            let scaled = (self.bounds[i]..self.bounds[i + 1]).map(|k| self.matrix[k].abs() / self.columns[self.pattern[k] as usize]);
            self.rows[i] = scaled.fold(0.0, f64::max);
        }
        true
    }

    /// A column of the row under elimination, and the row whose pivot it is.
    fn mark(&mut self, j: usize) {
        if self.marked[j] {
            return;
        }
        self.marked[j] = true;
        self.columns_here.push(j as u32);
        let owner = self.owner[j];
        if owner != OPEN {
            self.pending[owner as usize / 64] |= 1 << (owner % 64);
        }
    }

    /// The first row before that is still needed.
    fn next_pending(&mut self, from: &mut usize) -> Option<usize> {
        while *from < self.pending.len() {
            let word = self.pending[*from];
            if word != 0 {
                self.pending[*from] = word & (word - 1);
                return Some(64 * *from + word.trailing_zeros() as usize);
            }
            *from += 1;
        }
        None
    }

    fn clear_row(&mut self) {
        for j in self.columns_here.drain(..) {
            self.row[j as usize] = 0.0;
            self.marked[j as usize] = false;
        }
    }

    /// Subtracts multiples of the rows before from row i, in their order: what they fill in belongs to pivots of later rows.
    fn eliminate(&mut self, i: usize) {
        for k in self.bounds[i]..self.bounds[i + 1] {
            let j = self.pattern[k] as usize;
            self.row[j] = self.matrix[k];
            self.mark(j);
        }
        let mut word = 0;
        while let Some(p) = self.next_pending(&mut word) {
            let (column, pivot) = self.pivots[p];
            let entry = self.row[column];
            // a number that is lost stays where it is
            if entry == 0.0 || pivot.is_nan() {
                continue;
            }
            let l = entry / pivot;
            self.lower.push((p as u32, l));
            let start = if p == 0 { 0 } else { self.ends[p - 1].1 };
            for k in start..self.ends[p].1 {
                let (j, u) = self.upper[k];
                self.row[j as usize] -= l * u;
                self.mark(j as usize);
            }
        }
        self.columns_here.sort_unstable();
    }

    /// The column of the pivot; none when nothing but rounding is left.
    fn choose(&self, i: usize) -> Option<usize> {
        let limit = SINGULAR * self.size as f64 * self.rows[i];
        if limit.is_infinite() {
            return self.used.iter().position(|used| !used);
        }
        let (mut best, mut largest) = (None, 0.0);
        for j in self.columns_here.iter().map(|j| *j as usize).filter(|j| !self.used[*j]) {
            let scaled = self.row[j].abs() / self.columns[j];
            if self.row[j].is_nan() {
                return Some(j);
            }
            if scaled > limit && scaled > largest {
                (best, largest) = (Some(j), scaled);
            }
        }
        best
    }

    fn keep(&mut self, column: usize) {
        self.used[column] = true;
        self.owner[column] = self.pivots.len() as u32;
        self.pivots.push((column, self.row[column]));
        for j in self.columns_here.iter().map(|j| *j as usize) {
            if !self.used[j] && self.row[j] != 0.0 {
                self.upper.push((j as u32, self.row[j]));
            }
        }
    }

    /// Replaces b by A⁻¹ b.
    pub(crate) fn solve(&mut self, b: &mut [f64]) {
        self.drop_right_sides(b);
        let mut start = 0;
        for i in 0..self.size {
            let end = self.ends[i].0;
            let mut value = b[i];
            for &(p, l) in &self.lower[start..end] {
                value -= l * b[p as usize];
            }
            b[i] = value;
            start = end;
        }
        let mut end = self.upper.len();
        for i in (0..self.size).rev() {
            let start = if i == 0 { 0 } else { self.ends[i - 1].1 };
            let mut value = b[i];
            for &(j, u) in &self.upper[start..end] {
                value -= u * self.row[j as usize];
            }
            let (column, pivot) = self.pivots[i];
            self.row[column] = value / pivot;
            end = start;
        }
        b.copy_from_slice(&self.row[..self.size]);
    }

    fn drop_right_sides(&self, b: &mut [f64]) {
        b.iter_mut().zip(&self.out).filter(|(_, out)| **out).for_each(|(b, _)| *b = 0.0);
    }

    /// The same with one step of refinement, x + A⁻¹(b - A x): each equation is then met to its own rounding (Skeel 1980).
    pub(crate) fn solve_refined(&mut self, b: &mut [f64]) {
        let mut rest = std::mem::take(&mut self.rest);
        rest.copy_from_slice(b);
        self.solve(b);
        for (value, ends) in rest.iter_mut().zip(self.bounds.windows(2)) {
            for k in ends[0]..ends[1] {
                *value -= self.matrix[k] * b[self.pattern[k] as usize];
            }
        }
        self.solve(&mut rest);
        for (x, correction) in b.iter_mut().zip(&rest) {
            *x += correction;
        }
        self.rest = rest;
    }
}

fn refill<T: Clone>(list: &mut Vec<T>, n: usize, value: T) {
    list.clear();
    list.resize(n, value);
}

#[cfg(test)]
mod tests {
    use super::General;
    use crate::solve::Defect;
    use proptest::prelude::*;
    use symbolic::Rational;

    fn solved(matrix: &[f64], b: &[f64]) -> Result<Vec<f64>, Defect> {
        let mut general = General::default();
        general.load((b.len(), None), (0..).zip(matrix.iter().copied()));
        general.factor()?;
        let mut x = b.to_vec();
        general.solve_refined(&mut x);
        Ok(x)
    }

    /// Rows in any scale, a zero on the diagonal: x = (1, 2, 3).
    #[test]
    fn unsymmetric_system_is_solved() {
        let x = solved(&[0.0, 2e9, -1e9, 1e-7, 1e-7, 0.0, 4.0, 0.0, 1.0], &[1e9, 3e-7, 7.0]).unwrap();
        // four units of the last place
        assert!(x.iter().zip([1.0, 2.0, 3.0]).all(|(x, want)| (x - want).abs() < 1e-15 * want * 4.0), "{x:?}");
    }

    /// x'' = 0 from the condition whatever the weight is: [1, 0; m, 1] (x'', λ) = (0, m g sin a).
    #[test]
    fn held_block_has_exactly_no_acceleration() {
        for force in [0.1, 1.0 / 3.0, 123.456e7] {
            assert_eq!(solved(&[1.0, 0.0, 0.7, 1.0], &[0.0, force]).unwrap(), [0.0, force]);
        }
    }

    #[test]
    fn dependent_rows_and_open_unknowns_are_named() {
        let matrix = [1.0, 1.0, 0.0, 2.0, 2.0, 0.0, 0.0, 0.0, 1.0];
        assert_eq!(solved(&matrix, &[0.0; 3]), Err(Defect::Dependent { row: 1, unknown: 1 }));
        assert_eq!(solved(&[0.0], &[0.0]), Err(Defect::Dependent { row: 0, unknown: 0 }));
    }

    /// Two silicon gears of 15 and 60 µm: b'' = -a'' r1/r2, J1 a'' + r1 F = M, J2 b'' + r2 F = 0, so a'' = M/(J1 + J2 r1²/r2²). A third
    /// condition that repeats the first stays one too many, however small the wheels are.
    #[test]
    fn small_wheels_are_not_rounding() {
        let (r1, r2, j1, j2, m) = (15e-6, 60e-6, 2.8e-22, 7.1e-20, 2e-12);
        let x = solved(&[r1, r2, 0.0, j1, 0.0, r1, 0.0, j2, r2], &[0.0, m, 0.0]).unwrap();
        let a = m / (j1 + j2 * r1 * r1 / (r2 * r2));
        for (have, want) in x.iter().zip([a, -a * r1 / r2, j2 * a * r1 / (r2 * r2)]) {
            // a few roundings
            assert!((have - want).abs() < 1e-14 * want.abs(), "{have} {want}");
        }
        let twice = [r1, r2, 0.0, 0.0, r1, r2, 0.0, 0.0, j1, 0.0, r1, r1, 0.0, j2, r2, r2];
        assert!(matches!(solved(&twice, &[0.0, 0.0, m, 0.0]), Err(Defect::Dependent { row: 1, .. })));
    }

    #[test]
    fn a_lost_number_is_no_dependence() {
        for lost in [f64::NAN, f64::INFINITY] {
            assert!(solved(&[lost, 1.0, 1.0, 1.0], &[1.0, 1.0]).unwrap().iter().any(|x| !x.is_finite()));
        }
    }

    /// x of A x = b in exact arithmetic, and whether there is one.
    fn exact(matrix: &[i64], b: &[i64]) -> Option<Vec<f64>> {
        let n = b.len();
        let number = |v: &i64| Rational::new(*v, 1).unwrap();
        let mut rows: Vec<Vec<Rational>> =
            (0..n).map(|i| matrix[i * n..(i + 1) * n].iter().chain(&b[i..=i]).map(number).collect()).collect();
        for i in 0..n {
            let pivot = (i..n).find(|r| !rows[*r][i].is_zero())?;
            rows.swap(i, pivot);
            let row: Vec<Rational> = rows[i].iter().map(|a| a / &rows[i][i]).collect();
            for (_, other) in rows.iter_mut().enumerate().filter(|(r, _)| *r != i) {
                let factor = other[i].clone();
                other.iter_mut().zip(&row).for_each(|(a, b)| *a = &*a - &(&factor * b));
            }
            rows[i] = row;
        }
        Some(rows.iter().map(|row| row[n].to_f64()).collect())
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

        /// Whole numbers, half of them zero, rows in powers of ten: condition numbers of such matrices stay below 1e6 or they are singular.
        #[test]
        fn agrees_with_exact_arithmetic(
            n in 1usize..9,
            entries in proptest::collection::vec(prop_oneof![Just(0i64), -4i64..5], 64),
            b in proptest::collection::vec(-9i64..10, 8),
            scales in proptest::collection::vec(-6i32..7, 8),
        ) {
            let (matrix, b) = (&entries[..n * n], &b[..n]);
            let scale = |i: usize| 10_f64.powi(scales[i]);
            let numbers: Vec<f64> = matrix.iter().enumerate().map(|(k, a)| *a as f64 * scale(k / n)).collect();
            let right: Vec<f64> = b.iter().enumerate().map(|(i, b)| *b as f64 * scale(i)).collect();
            match (exact(matrix, b), solved(&numbers, &right)) {
                (Some(want), Ok(have)) => {
                    let size = want.iter().fold(1.0, |m: f64, v| m.max(v.abs()));
                    // random matrices, conditions up to some 1e5
                    prop_assert!(have.iter().zip(&want).all(|(h, w)| (h - w).abs() < 1e-10 * size), "{:?} {:?}", have, want);
                }
                (None, Err(Defect::Dependent { row, unknown })) => prop_assert!(row < n && unknown < n),
                (want, have) => prop_assert!(false, "{:?} against {:?}", want, have),
            }
        }
    }
}
