//! Orders above 0 in all lanes: the recurrences of [`crate::jets`], over runs of lanes.

use super::layout::{Layout, Row, Step, UNBOUNDED, What};
use super::rows::Modes;
use super::values::substitute;
use algebra::simd::{Lanes, Simd, Work, cauchy, cauchys, less, over, plus, plus_product, scaled, squared, times};

/// Coefficients of all rows; those of a row stand behind each other.
pub(super) struct Series<'a> {
    pub(super) layout: &'a Layout,
    pub(super) numbers: &'a [Lanes],
    pub(super) modes: &'a Modes,
    pub(super) cells: &'a mut [Lanes],
    /// Coefficients of a row.
    pub(super) stride: usize,
    pub(super) scratch: &'a mut Vec<Lanes>,
}

impl Work for Series<'_> {
    type Output = [bool; 8];

    /// All orders; order 0 is there.
    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) -> [bool; 8] {
        let layout = self.layout;
        let mut nothing = [0.0; 8];
        for k in 0..self.stride - 1 {
            if k > 0 {
                for i in &layout.series {
                    self.advance(simd, &layout.steps[*i as usize], k);
                }
            }
            let share = 1.0 / (k + 1) as f64;
            for (state, rate) in layout.states.iter().zip(&layout.rates) {
                let value = scaled(simd, share, self.at(*rate, k));
                nothing = plus(simd, &nothing, &less(simd, &value, &value));
                self.put(*state, k + 1, value);
            }
        }
        nothing.map(|v| v == 0.0)
    }
}

impl Series<'_> {
    #[inline(always)]
    fn at(&self, row: Row, k: usize) -> &Lanes {
        &self.cells[row as usize * self.stride + k]
    }

    #[inline(always)]
    fn put(&mut self, row: Row, k: usize, value: Lanes) {
        self.cells[row as usize * self.stride + k] = value;
    }

    /// Coefficients from..to.
    #[inline(always)]
    fn run(&self, row: Row, from: usize, to: usize) -> &[Lanes] {
        let start = row as usize * self.stride;
        &self.cells[start + from..start + to.max(from)]
    }

    #[inline(always)]
    fn degree(&self, row: Row) -> usize {
        self.layout.degrees[row as usize]
    }

    /// Σ_{j=from}^{k} a_j b_{k-j+less}: rows of few powers of time end early.
    #[inline(always)]
    fn product<S: Simd>(&self, simd: S, (a, b): (Row, Row), k: usize) -> Lanes {
        let (from, to) = (k.saturating_sub(self.degree(b)), k.min(self.degree(a)));
        if from > to { [0.0; 8] } else { cauchy(simd, self.run(a, from, to + 1), self.run(b, k - to, k - from + 1)) }
    }

    /// w_{k-1} = k a_k.
    #[inline(always)]
    fn weigh<S: Simd>(&mut self, simd: S, (own, a): (Row, Row), k: usize) {
        let value = scaled(simd, k as f64, self.at(a, k));
        self.put(own, k - 1, value);
    }

    /// Order k >= 1 of an operation.
    #[inline(always)]
    fn advance<S: Simd>(&mut self, simd: S, step: &Step, k: usize) {
        if self.degree(step.row) < k {
            return;
        }
        let value = match &step.what {
            What::Literal(_) | What::State(_) => return,
            What::Time => [1.0; 8],
            What::Linear { terms, .. } => self.linear(simd, terms, k),
            What::Multiply(a, b) => self.product(simd, (*a, *b), k),
            What::Square(a) if self.degree(*a) == UNBOUNDED => squared(simd, self.run(*a, 0, k + 1)),
            What::Square(a) => self.product(simd, (*a, *a), k),
            What::Choose { guard, sides } => self.modes.chosen(*guard, sides, |row| self.at(row, k)),
            What::SinCos { a, hyperbolic } => {
                self.weigh(simd, (step.own, *a), k);
                let w = self.run(step.own, 0, k);
                let [c, s] = cauchys(simd, w, [self.run(step.row, 0, k), self.run(step.row + 1, 0, k)]);
                let share = 1.0 / k as f64;
                self.put(step.row + 1, k, scaled(simd, if *hyperbolic { share } else { -share }, &c));
                scaled(simd, share, &s)
            }
            What::Solve { matrix, right } => {
                self.solve(simd, step, (matrix, right), k);
                return;
            }
            other => self.rarely(simd, (step, other), k),
        };
        self.put(step.row, k, value);
    }

    #[inline(always)]
    fn linear<S: Simd>(&self, simd: S, terms: &[(u32, Row)], k: usize) -> Lanes {
        let mut sum = [0.0; 8];
        for (number, row) in terms {
            if self.degree(*row) >= k {
                sum = plus_product(simd, &sum, &self.numbers[*number as usize], self.at(*row, k));
            }
        }
        sum
    }

    #[inline(always)]
    fn rarely<S: Simd>(&mut self, simd: S, (step, what): (&Step, &What), k: usize) -> Lanes {
        let (row, own, whole) = (step.row, step.own, k as f64);
        match what {
            // a = c b
            What::Divide(a, b) => {
                let rest = cauchy(simd, self.run(row, 0, k), self.run(*b, 1, k + 1));
                over(simd, &less(simd, self.at(*a, k), &rest), self.at(*b, 0))
            }
            // a = c c
            What::Root(a) => {
                let rest = squared(simd, self.run(row, 1, k));
                over(simd, &less(simd, self.at(*a, k), &rest), &scaled(simd, 2.0, self.at(row, 0)))
            }
            // k a_0 c_k = p Σ_{j=1}^{k} j a_j c_{k-j} - Σ_{j=1}^{k-1} j c_j a_{k-j}
            What::Power(a, p) => {
                self.weigh(simd, (own, *a), k);
                let first = times(simd, &self.numbers[*p as usize], &cauchy(simd, self.run(own, 0, k), self.run(row, 0, k)));
                let second = cauchy(simd, self.run(own + 1, 0, k - 1), self.run(*a, 1, k));
                let value = over(simd, &less(simd, &first, &second), &scaled(simd, whole, self.at(*a, 0)));
                self.put(own + 1, k - 1, scaled(simd, whole, &value));
                value
            }
            What::Exp(a) => {
                self.weigh(simd, (own, *a), k);
                scaled(simd, 1.0 / whole, &cauchy(simd, self.run(own, 0, k), self.run(row, 0, k)))
            }
            // c' a = a'
            What::Log(a) => {
                let rest = cauchy(simd, self.run(own, 0, k - 1), self.run(*a, 1, k));
                let slope = over(simd, &less(simd, &scaled(simd, whole, self.at(*a, k)), &rest), self.at(*a, 0));
                self.put(own, k - 1, slope);
                scaled(simd, 1.0 / whole, &slope)
            }
            // c' = a' u, u = 1 - c²
            What::Tanh(a) => {
                self.weigh(simd, (own, *a), k);
                let value = scaled(simd, 1.0 / whole, &cauchy(simd, self.run(own, 0, k), self.run(own + 1, 0, k)));
                self.put(row, k, value);
                let square = squared(simd, self.run(row, 0, k + 1));
                self.put(own + 1, k, scaled(simd, -1.0, &square));
                value
            }
            // done where they are found
            _ => [f64::NAN; 8],
        }
    }

    /// M_0 a_k = h_k - Σ_{j=1}^{k} M_j a_{k-j}.
    #[inline(always)]
    fn solve<S: Simd>(&mut self, simd: S, step: &Step, (matrix, right): (&[Option<Row>], &[Row]), k: usize) {
        let n = right.len();
        let mut scratch = std::mem::take(self.scratch);
        scratch.clear();
        scratch.extend(right.iter().map(|row| *self.at(*row, k)));
        let (mut i, mut j) = (0, 0);
        for entry in matrix {
            if let Some(entry) = entry
                && self.degree(*entry) > 0
            {
                let run = self.run(*entry, 1, k + 1);
                let of = |column: usize| self.run(step.row + column as Row, 0, k);
                if i == j {
                    scratch[i] = less(simd, &scratch[i], &cauchy(simd, run, of(i)));
                } else {
                    let [at_i, at_j] = cauchys(simd, run, [of(j), of(i)]);
                    scratch[i] = less(simd, &scratch[i], &at_i);
                    scratch[j] = less(simd, &scratch[j], &at_j);
                }
            }
            (i, j) = if j == i { (i + 1, 0) } else { (i, j + 1) };
        }
        scratch.extend((0..n * n).map(|cell| self.cells[(step.own as usize + cell) * self.stride]));
        substitute(simd, n, [n, 0], &mut scratch);
        (step.row..).zip(&scratch[..n]).for_each(|(row, value)| self.put(row, k, *value));
        *self.scratch = scratch;
    }
}
