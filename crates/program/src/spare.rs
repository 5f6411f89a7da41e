//! Conditions that hold one motion several times: which of them stand in the system, chosen where the machine is.
//!
//! Of m conditions of rank r only r are equations; the others hold through them. Which r are independent changes along a motion (of two side rods
//! whose cranks stand at right angles each is dead four times a turn), so that the choice is made with each factorisation: rows are taken by what is left of them
//! beside the rows taken before, the largest first. The m - r smallest are left out, with the reactions that belong to them set to 0.
//!
//! Rows are measured by their typical size, not their present one: a row whose levers vanish here holds nothing here.
//!
//! *Source*: P. Businger, G. H. Golub, Linear least squares solutions by Householder transformations, Numerische Mathematik 7 (1965) 269-276, for the pivots.

use crate::Real;
use algebra::vectors::{dot, norm};

/// What may be left out of a system.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Spare {
    /// How many pairs are left out.
    pub count: u32,
    /// Rows that stay whatever the others do.
    pub fixed: Box<[u32]>,
    /// Row, unknown that is 0 when the row is left out, typical size of the row over `columns`.
    pub pairs: Box<[(u32, u32, Real)]>,
    /// Typical size of the entries of each column; the columns behind them do not count.
    pub columns: Box<[Real]>,
}

impl Spare {
    /// Whether it belongs to a system of this size.
    pub(crate) fn fits(&self, n: usize) -> bool {
        let inside = |k: &u32| (*k as usize) < n;
        let unknown = |k: &u32| inside(k) && *k as usize >= self.columns.len();
        self.count as usize <= self.pairs.len()
            && self.columns.len() <= n
            && self.fixed.iter().all(inside)
            && self.pairs.iter().all(|(row, k, size)| inside(row) && unknown(k) && size.0 > 0.0)
            && self.columns.iter().all(|size| size.0 > 0.0)
    }
}

/// Replaces rows of a square matrix, of `columns.len()` columns or more, that are left out by "their unknown is 0"; `out` says which rows they are.
pub(crate) fn leave_out(spare: &Spare, matrix: &mut [f64], out: &mut [bool]) {
    let n = out.len();
    let mut rows: Vec<Vec<f64>> = spare.pairs.iter().map(|(row, _, size)| vector(spare, &matrix[*row as usize * n..], size.0)).collect();
    for row in &spare.fixed {
        let mut fixed = vector(spare, &matrix[*row as usize * n..], 1.0);
        if scale(&mut fixed) {
            rows.iter_mut().for_each(|v| subtract(v, &fixed));
        }
    }
    let mut left: Vec<usize> = (0..rows.len()).collect();
    while left.len() > spare.count as usize {
        let size = |k: &usize| rows[*k].iter().map(|a| a * a).sum::<f64>();
        let Some(best) = (0..left.len()).rev().max_by(|a, b| size(&left[*a]).total_cmp(&size(&left[*b]))) else { return };
        let mut taken = std::mem::take(&mut rows[left.remove(best)]);
        if scale(&mut taken) {
            // twice is enough
            left.iter().for_each(|k| (0..2).for_each(|_| subtract(&mut rows[*k], &taken)));
        }
    }
    for k in left {
        let (row, unknown, _) = spare.pairs[k];
        let entries = &mut matrix[row as usize * n..(row as usize + 1) * n];
        entries.fill(0.0);
        entries[unknown as usize] = 1.0;
        out[row as usize] = true;
    }
}

fn vector(spare: &Spare, row: &[f64], size: f64) -> Vec<f64> {
    row.iter().zip(&spare.columns).map(|(a, column)| a / (column.0 * size)).collect()
}

/// To unit length; false for nothing.
fn scale(v: &mut [f64]) -> bool {
    let length = norm(v);
    v.iter_mut().for_each(|a| *a /= length);
    length > 0.0 && length.is_finite()
}

fn subtract(v: &mut [f64], unit: &[f64]) {
    let share = dot(v, unit);
    v.iter_mut().zip(unit).for_each(|(a, b)| *a -= share * b);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two_of_three() -> Spare {
        let one = Real(1.0);
        Spare { count: 1, fixed: Box::new([]), pairs: (0..3).map(|k| (k, 2 + k, one)).collect(), columns: Box::new([one, one]) }
    }

    /// Two unknowns held by three rows, then what the rows are multiplied with.
    fn left_out(rows: [[f64; 2]; 3]) -> Vec<usize> {
        let mut matrix = vec![0.0; 25];
        rows.iter().enumerate().for_each(|(i, row)| matrix[5 * i..5 * i + 2].copy_from_slice(row));
        let mut out = vec![false; 5];
        leave_out(&two_of_three(), &mut matrix, &mut out);
        let list: Vec<usize> = (0..5).filter(|i| out[*i]).collect();
        assert!(list.iter().all(|i| matrix[5 * i + 2 + i] == 1.0));
        list
    }

    #[test]
    fn the_row_that_says_least_here_is_left_out() {
        assert_eq!(left_out([[1.0, 0.0], [0.0, 1.0], [1e-9, 1e-9]]), [2]);
        assert_eq!(left_out([[0.0, 0.0], [0.0, 1.0], [1.0, 1.0]]), [0]);
        assert_eq!(left_out([[1.0, 0.0], [1.0, 1e-3], [0.0, 1.0]]), [0]);
        // of equal ones the last
        assert_eq!(left_out([[1.0, 0.0], [0.0, 1.0], [0.0, 1.0]]), [2]);
    }
}
