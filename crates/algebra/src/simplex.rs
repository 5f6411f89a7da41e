//! Small linear programmes: the largest value of c·y under G y + g ≥ 0 with free y, by the simplex method with Bland's rule.
//!
//! y = y⁺ - y⁻ and slacks s ≥ 0 give G(y⁺ - y⁻) - s = -g; rows whose right side would be negative get an artificial variable, and the first phase takes
//! these away. Bland's rule (the first variable that improves enters, of equal ratios the first leaves) never cycles.
//! *Source*: V. Chvátal, Linear Programming, ch. 2, 3 and 8.

/// One inequality: G_i, g_i.
pub type Inequality = (Vec<f64>, f64);

/// What a programme gives.
#[derive(Clone, Debug, PartialEq)]
pub enum Optimum {
    /// No y meets all inequalities.
    Nowhere,
    /// c·y grows without bound.
    Unbounded,
    /// The largest c·y and a y that reaches it.
    At(f64, Vec<f64>),
}

/// Entries below this are rounding; rows should be scaled to entries of the order 1.
const ROUNDING: f64 = 1e-11;
/// Sum of artificial variables that counts as none.
const FEASIBLE: f64 = 1e-10;
/// Exchanges before giving up; Bland's rule needs far fewer for what statics asks.
const EXCHANGES: usize = 10_000;

/// The largest c·y.
///
/// *Shapes*: c: d; each inequality: d and a number. *Units*: free, rows of the order 1.
pub fn largest(c: &[f64], inequalities: &[Inequality]) -> Optimum {
    let mut table = Table::new(c.len(), inequalities);
    if !table.first_phase() {
        return Optimum::Nowhere;
    }
    table.second_phase(c)
}

/// Rows of basic variables over all variables, right sides at the end.
struct Table {
    d: usize,
    /// y⁺, y⁻, slacks: what may enter in the second phase.
    real: usize,
    width: usize,
    rows: Vec<Vec<f64>>,
    basis: Vec<usize>,
}

impl Table {
    fn new(d: usize, inequalities: &[Inequality]) -> Table {
        let m = inequalities.len();
        let real = 2 * d + m;
        let artificial = inequalities.iter().filter(|(_, g)| *g < 0.0).count();
        let width = real + artificial;
        let (mut rows, mut basis, mut next) = (Vec::new(), Vec::new(), real);
        for (i, (row, g)) in inequalities.iter().enumerate() {
            // -G y + s = g, or with g < 0: G y - s + a = -g
            let sign = if *g < 0.0 { -1.0 } else { 1.0 };
            let mut line = vec![0.0; width + 1];
            for j in 0..d {
                line[j] = -sign * row[j];
                line[d + j] = sign * row[j];
            }
            line[2 * d + i] = sign;
            line[width] = g.abs();
            if *g < 0.0 {
                line[next] = 1.0;
                basis.push(next);
                next += 1;
            } else {
                basis.push(2 * d + i);
            }
            rows.push(line);
        }
        Table { d, real, width, rows, basis }
    }

    /// Minimises the sum of the artificial variables; whether none is left.
    fn first_phase(&mut self) -> bool {
        let mut cost = vec![0.0; self.width];
        cost[self.real..].fill(-1.0);
        self.climb(&cost, self.width);
        let left: f64 = (0..self.rows.len()).filter(|i| self.basis[*i] >= self.real).map(|i| self.rows[i][self.width]).sum();
        if left > FEASIBLE {
            return false;
        }
        // artificial variables at zero leave the basis where a real one can take their place
        for i in 0..self.rows.len() {
            if self.basis[i] >= self.real
                // a pivot that is rounding of rows scaled to 1 is none
                && let Some(j) = (0..self.real).find(|j| self.rows[i][*j].abs() > 1e-9)
            {
                self.exchange(i, j);
            }
        }
        true
    }

    fn second_phase(&mut self, c: &[f64]) -> Optimum {
        let mut cost = vec![0.0; self.width];
        for (j, c) in c.iter().enumerate() {
            cost[j] = *c;
            cost[self.d + j] = -c;
        }
        if !self.climb(&cost, self.real) {
            return Optimum::Unbounded;
        }
        let mut y = vec![0.0; self.d];
        for (i, b) in self.basis.iter().enumerate().filter(|(_, b)| **b < 2 * self.d) {
            let value = self.rows[i][self.width];
            y[b % self.d] += if *b < self.d { value } else { -value };
        }
        Optimum::At(y.iter().zip(c).map(|(y, c)| y * c).sum(), y)
    }

    /// Exchanges until nothing improves; false when the cost grows without bound. Only the first `open` variables may enter.
    fn climb(&mut self, cost: &[f64], open: usize) -> bool {
        for _ in 0..EXCHANGES {
            let gain = |j: usize| cost[j] - self.basis.iter().zip(&self.rows).map(|(b, row)| cost[*b] * row[j]).sum::<f64>();
            let Some(enters) = (0..open).find(|j| !self.basis.contains(j) && gain(*j) > ROUNDING) else { return true };
            let ratio = |i: usize| self.rows[i][self.width] / self.rows[i][enters];
            let candidates = (0..self.rows.len()).filter(|i| self.rows[*i][enters] > ROUNDING);
            let leaves = candidates.min_by(|a, b| ratio(*a).total_cmp(&ratio(*b)).then(self.basis[*a].cmp(&self.basis[*b])));
            let Some(leaves) = leaves else { return false };
            self.exchange(leaves, enters);
        }
        true
    }

    fn exchange(&mut self, leaves: usize, enters: usize) {
        let pivot = self.rows[leaves][enters];
        self.rows[leaves].iter_mut().for_each(|a| *a /= pivot);
        let own = self.rows[leaves].clone();
        for (i, row) in self.rows.iter_mut().enumerate() {
            let share = row[enters];
            if i != leaves && share != 0.0 {
                row.iter_mut().zip(&own).for_each(|(a, b)| *a -= share * b);
            }
        }
        self.basis[leaves] = enters;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle() {
        // x >= 0, y >= 0, x + 2 y <= 4: largest x + y is 4 at (4, 0), largest y is 2
        let sides = [(vec![1.0, 0.0], 0.0), (vec![0.0, 1.0], 0.0), (vec![-1.0, -2.0], 4.0)];
        assert_eq!(largest(&[1.0, 1.0], &sides), Optimum::At(4.0, vec![4.0, 0.0]));
        assert_eq!(largest(&[0.0, 1.0], &sides), Optimum::At(2.0, vec![0.0, 2.0]));
        assert_eq!(largest(&[-1.0, 0.0], &sides), Optimum::At(0.0, vec![0.0, 0.0]));
    }

    #[test]
    fn negative_values_and_open_sides() {
        // x >= 1 and x <= 3; y free
        let sides = [(vec![1.0, 0.0], -1.0), (vec![-1.0, 0.0], 3.0)];
        assert_eq!(largest(&[-1.0, 0.0], &sides), Optimum::At(-1.0, vec![1.0, 0.0]));
        assert_eq!(largest(&[0.0, 1.0], &sides), Optimum::Unbounded);
        assert_eq!(largest(&[1.0, 0.0], &[(vec![1.0, 0.0], -4.0), (vec![-1.0, 0.0], 3.0)]), Optimum::Nowhere);
    }

    #[test]
    fn nothing_to_choose() {
        assert_eq!(largest(&[], &[(vec![], 1.0)]), Optimum::At(0.0, vec![]));
        assert_eq!(largest(&[], &[(vec![], -1.0)]), Optimum::Nowhere);
    }
}
