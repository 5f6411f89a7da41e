//! The recurrences, one order of one operation at a time.
//!
//! All follow from a differential equation that the function satisfies, with (f')_k = (k+1) f_{k+1} and the Cauchy product
//! (f g)_k = Σ_{j=0}^{k} f_j g_{k-j}. Helper rows called *weighted* hold the coefficients of t-derivatives shifted down: w_{j-1} = j a_j,
//! so that Σ_{j=1}^{k} j a_j b_{k-j} is again a product of runs.

use super::plan::{Plan, Resolved};
use super::steps::{Row, Rows, Step};
use crate::general::General;
use crate::solve::{Defect, Factor};
use crate::{Mode, Unary};
use algebra::elementary;
use algebra::lanes::{product, products};

impl Step {
    /// First row written.
    pub(super) fn row(&self) -> Row {
        match self {
            Step::Copy { row, .. }
            | Step::Scale { row, .. }
            | Step::Linear { row, .. }
            | Step::Multiply { row, .. }
            | Step::Square { row, .. }
            | Step::Divide { row, .. }
            | Step::SquareRoot { row, .. }
            | Step::Power { row, .. }
            | Step::Exp { row, .. }
            | Step::SinCos { row, .. }
            | Step::Tangent { row, .. }
            | Step::Inverse { row, .. }
            | Step::Atan2 { row, .. }
            | Step::Solve { row, .. }
            | Step::System { row, .. } => *row,
        }
    }

    /// Calls `visit` with every row read.
    pub(super) fn operands(&self, plan: &Plan, visit: &mut dyn FnMut(Row)) {
        match self {
            Step::Copy { a, .. }
            | Step::Scale { a, .. }
            | Step::Square { a, .. }
            | Step::SquareRoot { a, .. }
            | Step::Power { a, .. }
            | Step::Exp { a, .. }
            | Step::SinCos { a, .. }
            | Step::Tangent { a, .. }
            | Step::Inverse { a, .. } => visit(*a),
            Step::Linear { start, end, .. } => plan.terms[*start as usize..*end as usize].iter().for_each(|t| visit(t.1)),
            Step::Multiply { a, b, .. } | Step::Divide { a, b, .. } | Step::Atan2 { y: a, x: b, .. } => {
                visit(*a);
                visit(*b);
            }
            Step::Solve { system, .. } => {
                let system = &plan.systems[*system as usize];
                system.moving.iter().for_each(|m| visit(m.2));
                system.right.iter().copied().for_each(visit);
            }
            Step::System { system, .. } => {
                let system = &plan.generals[*system as usize];
                system.entries.iter().flatten().copied().for_each(&mut *visit);
                system.right.iter().copied().for_each(visit);
            }
        }
    }

    /// Multiplications and divisions of order k, counted without the rounding up to groups.
    pub(super) fn multiplications(&self, k: usize, plan: &Plan) -> usize {
        match self {
            Step::Copy { .. } => 0,
            Step::Scale { .. } => 1,
            Step::Linear { start, end, .. } => (end - start) as usize,
            Step::Multiply { .. } | Step::Square { .. } | Step::Divide { .. } | Step::SquareRoot { .. } => k + 1,
            Step::Exp { .. } => k + 2,
            Step::Power { .. } | Step::SinCos { .. } | Step::Tangent { .. } => 2 * k + 4,
            Step::Inverse { .. } => 3 * k + 4,
            Step::Atan2 { .. } => 5 * k + 6,
            Step::Solve { system, .. } => {
                let s = &plan.systems[*system as usize];
                s.moving.iter().map(|m| if m.0 == m.1 { k } else { 2 * k }).sum::<usize>() + s.size * s.size
            }
            // an upper bound: choices are counted as if they moved, factors as if they were full
            Step::System { system, .. } => {
                let s = &plan.generals[*system as usize];
                s.entries.iter().flatten().count() * k + s.size * s.size
            }
        }
    }
}

/// The rows.
#[derive(Clone, Debug)]
pub(super) struct Memory {
    cells: Vec<f64>,
    /// Length of one copy of a row.
    stride: usize,
    /// Largest order.
    order: usize,
    factors: Vec<Factor>,
    generals: Vec<General>,
    resolved: Vec<Resolved>,
    scratch: Vec<f64>,
    /// The first row of a system that could not be factored, and why.
    pub(super) defect: Option<(Row, Defect)>,
    /// Rows of roots and powers whose argument is zero up to rounding: they hold the value alone.
    pub(super) at_zero: Vec<Row>,
}

/// Runs are multiplied in groups of this many.
const LANES: usize = 4;

/// The cells while coefficients of one order are found.
struct Order<'m> {
    cells: &'m mut [f64],
    /// Length of both copies of a row.
    width: usize,
    k: usize,
    /// Where coefficient k stands behind the start of its row in the copy that runs backwards.
    back: usize,
}

impl Order<'_> {
    #[inline(always)]
    fn get(&self, row: Row) -> f64 {
        self.cells[row as usize * self.width + self.k]
    }

    #[inline(always)]
    fn put(&mut self, row: Row, value: f64) {
        let start = row as usize * self.width;
        self.cells[start + self.k] = value;
        self.cells[start + self.back] = value;
    }

    /// The run a_from, a_{from+1}, ... of k - less + 1 coefficients; what is behind them in the last group meets zeros and must be finite.
    #[inline(always)]
    fn run(&self, (a, from): (Row, usize), less: usize) -> &[f64] {
        let start = a as usize * self.width + from;
        &self.cells[start..start + (self.k - less + LANES) / LANES * LANES]
    }

    /// The run backwards from coefficient k - less.
    #[inline(always)]
    fn back(&self, b: Row, less: usize) -> &[f64] {
        let start = b as usize * self.width + self.back + less;
        &self.cells[start..start + (self.k - less + LANES) / LANES * LANES]
    }

    /// w_{k-1} = k a_k.
    #[inline(always)]
    fn weigh(&mut self, weighted: Row, a: Row) {
        self.cells[weighted as usize * self.width + self.k - 1] = self.k as f64 * self.get(a);
    }
}

impl Memory {
    pub(super) fn new(plan: &Plan, order: usize) -> Memory {
        let stride = (order + 1).next_multiple_of(LANES) + LANES;
        let sizes = plan.systems.iter().map(|s| s.size).chain(plan.generals.iter().map(|s| s.size));
        let largest = sizes.max().unwrap_or(0);
        Memory {
            cells: vec![0.0; plan.count as usize * 2 * stride],
            stride,
            order,
            factors: vec![Factor::default(); plan.systems.len()],
            generals: vec![General::default(); plan.generals.len()],
            resolved: vec![Resolved::default(); plan.generals.len()],
            scratch: vec![0.0; largest],
            defect: None,
            at_zero: Vec::new(),
        }
    }

    /// What the check of a step reads; rows hold coefficients 0..count.
    pub(super) fn rows(&self, count: usize) -> Rows<'_> {
        Rows { cells: &self.cells, stride: 2 * self.stride, count }
    }

    /// Forgets everything but constants and takes the branches of these modes.
    pub(super) fn clear(&mut self, plan: &Plan, modes: &[Mode]) {
        self.resolved = plan.resolve(modes);
        self.cells.fill(0.0);
        for (row, value) in &plan.constants {
            self.put(*row, 0, *value);
        }
    }

    /// A row that is a straight line.
    pub(super) fn start(&mut self, row: Row, value: f64, slope: f64) {
        self.put(row, 0, value);
        if self.order > 0 {
            self.put(row, 1, slope);
        }
    }

    /// Coefficients 0..=order.
    pub(super) fn row(&self, row: Row, order: usize) -> &[f64] {
        let start = self.forward(row);
        &self.cells[start..=start + order]
    }

    #[inline(always)]
    fn forward(&self, row: Row) -> usize {
        row as usize * 2 * self.stride
    }

    #[inline(always)]
    pub(super) fn get(&self, row: Row, k: usize) -> f64 {
        self.cells[self.forward(row) + k]
    }

    #[inline(always)]
    pub(super) fn put(&mut self, row: Row, k: usize, value: f64) {
        let start = self.forward(row);
        self.cells[start + k] = value;
        self.cells[start + self.stride + self.order - k] = value;
    }

    /// Σ_{j=0}^{k} a_{from+j} b_{k-j}; what a holds after from+k must be finite.
    #[inline(always)]
    fn cauchy(&self, a: Row, from: usize, b: Row, k: usize) -> f64 {
        let length = (k + LANES) / LANES * LANES;
        let (a, b) = (self.forward(a) + from, self.forward(b) + self.stride + self.order - k);
        product(&self.cells[a..a + length], &self.cells[b..b + length])
    }

    /// Σ_{j=from}^{k-1} c_j b_{k-j} where c_k is not known yet: counted as zero.
    #[inline(always)]
    fn partial(&mut self, c: Row, from: usize, b: Row, k: usize) -> f64 {
        let start = self.forward(c);
        self.cells[start + k] = 0.0;
        self.cauchy(c, from, b, k - from)
    }

    /// w_{k-1} = k a_k.
    #[inline(always)]
    fn weigh(&mut self, weighted: Row, a: Row, k: usize) {
        let value = k as f64 * self.get(a, k);
        let start = self.forward(weighted);
        self.cells[start + k - 1] = value;
    }

    /// Order 0: the operation itself, as the interpreter does it.
    pub(super) fn begin(&mut self, step: &Step, plan: &Plan) {
        let value = match *step {
            Step::Copy { a, .. } => self.get(a, 0),
            Step::Scale { constant, factor, a, .. } => constant + factor * self.get(a, 0),
            Step::Linear { constant, start, end, .. } => {
                plan.terms[start as usize..end as usize].iter().fold(constant, |sum, (f, a)| sum + f * self.get(*a, 0))
            }
            Step::Multiply { a, b, .. } => self.get(a, 0) * self.get(b, 0),
            Step::Square { a, .. } => self.get(a, 0) * self.get(a, 0),
            Step::Divide { a, b, .. } => self.get(a, 0) / self.get(b, 0),
            Step::SquareRoot { row, a } if self.is_at_zero(row) => self.get(a, 0).max(0.0).sqrt(),
            Step::Power { row, a, p, .. } if self.is_at_zero(row) => elementary::pow(self.get(a, 0).max(0.0), p),
            Step::SquareRoot { a, .. } => self.get(a, 0).sqrt(),
            Step::Power { a, p, .. } => elementary::pow(self.get(a, 0), p),
            Step::Exp { a, .. } => elementary::exp(self.get(a, 0)),
            Step::SinCos { row, a, sign, .. } => {
                let x = self.get(a, 0);
                let (s, c) = if sign < 0.0 { elementary::sin_cos(x) } else { (elementary::sinh(x), elementary::cosh(x)) };
                self.put(row + 1, 0, c);
                s
            }
            Step::Tangent { a, helper, sign, .. } => {
                let x = self.get(a, 0);
                let t = if sign > 0.0 { elementary::tan(x) } else { elementary::tanh(x) };
                // 1 - tanh² has few digits left near saturation; what tanh itself does not show any more is nothing
                let u = if sign > 0.0 {
                    1.0 + t * t
                } else {
                    Some(elementary::powi(elementary::cosh(x), -2)).filter(|u| *u > f64::EPSILON).unwrap_or(0.0)
                };
                self.put(helper + 1, 0, u);
                t
            }
            Step::Inverse { a, f, helper, .. } => self.begin_inverse(a, f, helper),
            Step::Atan2 { y, x, helper, .. } => {
                let (y, x) = (self.get(y, 0), self.get(x, 0));
                self.put(helper, 0, x * x + y * y);
                elementary::atan2(y, x)
            }
            Step::Solve { row, system } => {
                self.begin_solve(row, system as usize, plan);
                return;
            }
            Step::System { row, system } => {
                self.begin_system(row, system as usize);
                return;
            }
        };
        self.put(step.row(), 0, value);
    }

    /// Helper rows: weighted c, u, and what stands under the root of u: 1 - a², 1 + a², a² - 1.
    fn begin_inverse(&mut self, a: Row, f: Unary, helper: Row) -> f64 {
        let x = self.get(a, 0);
        match f {
            Unary::Log => {}
            Unary::Atan => self.put(helper + 1, 0, 1.0 + x * x),
            Unary::Atanh => self.put(helper + 1, 0, (1.0 - x) * (1.0 + x)),
            _ => {
                let inner = match f {
                    Unary::Asinh => 1.0 + x * x,
                    Unary::Acosh => (x - 1.0) * (x + 1.0),
                    _ => (1.0 - x) * (1.0 + x),
                };
                self.put(helper + 2, 0, inner);
                self.put(helper + 1, 0, inner.sqrt());
            }
        }
        f.apply(x)
    }

    fn begin_solve(&mut self, first: Row, index: usize, plan: &Plan) {
        let system = &plan.systems[index];
        let mut factor = std::mem::take(&mut self.factors[index]);
        factor.load(system.size, system.entries.iter().map(|e| e.map_or_else(|value| value, |row| self.get(row, 0))));
        if let Err(defect) = factor.factor() {
            self.defect = Some((first, defect));
        }
        self.factors[index] = factor;
        let mut h = std::mem::take(&mut self.scratch);
        for (value, row) in h.iter_mut().zip(&system.right) {
            *value = self.get(*row, 0);
        }
        self.finish_solve(first, (index, system.size), 0, h);
    }

    fn finish_solve(&mut self, first: Row, (index, size): (usize, usize), k: usize, mut h: Vec<f64>) {
        self.factors[index].solve(&mut h[..size]);
        let mut order = self.at(k);
        for (i, value) in (0..).zip(&h[..size]) {
            order.put(first + i, *value);
        }
        self.scratch = h;
    }

    /// The cells at order k.
    #[inline(always)]
    fn at(&mut self, k: usize) -> Order<'_> {
        Order { width: 2 * self.stride, k, back: self.stride + self.order - k, cells: &mut self.cells }
    }

    /// x_{k+1} = f_k/(k+1); false when one of them is not finite.
    pub(super) fn raise(&mut self, plan: &Plan, k: usize) -> bool {
        let divisor = (k + 1) as f64;
        let mut order = self.at(k + 1);
        let mut sound = true;
        for (row, rate) in plan.states.iter().zip(&plan.rates) {
            let next = order.cells[*rate as usize * order.width + k] / divisor;
            sound &= next.is_finite();
            order.put(*row, next);
        }
        sound
    }

    /// Order k >= 1.
    #[inline(always)]
    pub(super) fn advance(&mut self, step: &Step, k: usize, plan: &Plan) {
        let mut order = self.at(k);
        let (row, value) = match *step {
            Step::Copy { row, a } => (row, order.get(a)),
            Step::Scale { row, factor, a, .. } => (row, factor * order.get(a)),
            Step::Linear { row, start, end, .. } => {
                (row, plan.terms[start as usize..end as usize].iter().fold(0.0, |sum, (f, a)| sum + f * order.get(*a)))
            }
            Step::Multiply { row, a, b } => (row, product(order.run((a, 0), 0), order.back(b, 0))),
            Step::Square { row, a } => (row, product(order.run((a, 0), 0), order.back(a, 0))),
            Step::SinCos { row, a, weighted, sign } => {
                order.weigh(weighted, a);
                let [s, c] = products(order.run((weighted, 0), 1), [order.back(row + 1, 1), order.back(row, 1)]);
                order.put(row + 1, sign * c / k as f64);
                (row, s / k as f64)
            }
            Step::Solve { row, system } => {
                self.solve(row, system as usize, k, plan);
                return;
            }
            Step::System { row, system } => {
                self.system(row, system as usize, k);
                return;
            }
            _ => {
                self.advance_rarely(step, k);
                return;
            }
        };
        order.put(row, value);
    }

    /// The same of operations that are few.
    fn advance_rarely(&mut self, step: &Step, k: usize) {
        let value = match *step {
            Step::Divide { row, a, b } => (self.get(a, k) - self.partial(row, 0, b, k)) / self.get(b, 0),
            Step::SquareRoot { row, a } => self.square_root(row, a, k),
            Step::Power { row, a, p, weighted } => self.power(row, (a, p), weighted, k),
            Step::Exp { row, a, weighted } => {
                self.weigh(weighted, a, k);
                self.cauchy(weighted, 0, row, k - 1) / k as f64
            }
            Step::Tangent { row, a, helper, sign } => {
                self.weigh(helper, a, k);
                let t = self.cauchy(helper, 0, helper + 1, k - 1) / k as f64;
                self.put(row, k, t);
                let square = self.cauchy(row, 0, row, k);
                self.put(helper + 1, k, sign * square);
                t
            }
            Step::Inverse { a, f, helper, .. } => self.inverse(a, f, helper, k),
            Step::Atan2 { y, x, helper, .. } => self.atan2(y, x, helper, k),
            // done where they are found
            _ => return,
        };
        self.put(step.row(), k, value);
    }

    /// Roots and powers at zero have no series; see `faithful.rs`.
    #[inline(always)]
    fn is_at_zero(&self, row: Row) -> bool {
        !self.at_zero.is_empty() && self.at_zero.contains(&row)
    }

    fn square_root(&mut self, row: Row, a: Row, k: usize) -> f64 {
        if self.get(row, 0) == 0.0 || self.is_at_zero(row) {
            return 0.0;
        }
        let rest = if k < 2 { 0.0 } else { self.partial(row, 1, row, k) };
        (self.get(a, k) - rest) / (2.0 * self.get(row, 0))
    }

    /// Both weighted rows: of a, then of c.
    fn power(&mut self, row: Row, (a, p): (Row, f64), weighted: Row, k: usize) -> f64 {
        if self.get(a, 0) == 0.0 || self.is_at_zero(row) {
            return 0.0;
        }
        self.weigh(weighted, a, k);
        let first = p * self.cauchy(weighted, 0, row, k - 1);
        let second = if k < 2 { 0.0 } else { self.partial(weighted + 1, 0, a, k - 1) };
        let value = (first - second) / (k as f64 * self.get(a, 0));
        self.put(row, k, value);
        self.weigh(weighted + 1, row, k);
        value
    }

    fn inverse(&mut self, a: Row, f: Unary, helper: Row, k: usize) -> f64 {
        let (u, sign) = match f {
            Unary::Log => (a, 1.0),
            Unary::Atan | Unary::Atanh => {
                let square = self.cauchy(a, 0, a, k);
                self.put(helper + 1, k, if f == Unary::Atan { square } else { -square });
                (helper + 1, 1.0)
            }
            _ => {
                let square = self.cauchy(a, 0, a, k);
                self.put(helper + 2, k, if matches!(f, Unary::Asinh | Unary::Acosh) { square } else { -square });
                let root = self.square_root(helper + 1, helper + 2, k);
                self.put(helper + 1, k, root);
                (helper + 1, if f == Unary::Acos { -1.0 } else { 1.0 })
            }
        };
        let right = sign * (k as f64 * self.get(a, k));
        self.quotient_integral(right, u, helper, k)
    }

    /// c' u = r: k u_0 c_k = r_{k-1} - Σ_{j=1}^{k-1} j c_j u_{k-j}; `weighted` keeps j c_j.
    fn quotient_integral(&mut self, right: f64, u: Row, weighted: Row, k: usize) -> f64 {
        let rest = if k < 2 { 0.0 } else { self.partial(weighted, 0, u, k - 1) };
        let slope = (right - rest) / self.get(u, 0);
        let start = self.forward(weighted);
        self.cells[start + k - 1] = slope;
        slope / k as f64
    }

    /// Helper rows: u = x² + y², weighted y, weighted x, weighted c.
    fn atan2(&mut self, y: Row, x: Row, helper: Row, k: usize) -> f64 {
        let u = self.cauchy(x, 0, x, k) + self.cauchy(y, 0, y, k);
        self.put(helper, k, u);
        self.weigh(helper + 1, y, k);
        self.weigh(helper + 2, x, k);
        let right = self.cauchy(helper + 1, 0, x, k - 1) - self.cauchy(helper + 2, 0, y, k - 1);
        self.quotient_integral(right, helper, helper + 3, k)
    }

    fn solve(&mut self, first: Row, index: usize, k: usize, plan: &Plan) {
        let system = &plan.systems[index];
        let mut h = std::mem::take(&mut self.scratch);
        let order = self.at(k);
        for (value, row) in h.iter_mut().zip(&system.right) {
            *value = order.get(*row);
        }
        // M_1 .. M_k meet a_{k-1} .. a_0
        for &(i, j, entry) in &system.moving {
            let run = order.run((entry, 1), 1);
            if i == j {
                h[i as usize] -= product(run, order.back(first + j, 1));
            } else {
                let [at_i, at_j] = products(run, [order.back(first + j, 1), order.back(first + i, 1)]);
                h[i as usize] -= at_i;
                h[j as usize] -= at_j;
            }
        }
        self.finish_solve(first, (index, system.size), k, h);
    }

    /// A_0 x_0 = b_0, factored for all orders.
    fn begin_system(&mut self, first: Row, index: usize) {
        let mut general = std::mem::take(&mut self.generals[index]);
        let mut b = std::mem::take(&mut self.scratch);
        let resolved = &self.resolved[index];
        let size = resolved.right.len();
        let entries = resolved.entries.iter().map(|(place, e)| (*place, e.map_or_else(|value| value, |row| self.get(row, 0))));
        general.load((size, resolved.spare.as_deref()), entries);
        match general.factor() {
            Ok(()) => {
                for (value, row) in b.iter_mut().zip(&resolved.right) {
                    *value = self.get(*row, 0);
                }
                general.solve_refined(&mut b[..size]);
                (first..).zip(&b[..size]).for_each(|(row, value)| self.put(row, 0, *value));
            }
            Err(defect) => self.defect = Some((first, defect)),
        }
        self.generals[index] = general;
        self.scratch = b;
    }

    /// A_0 x_k = b_k - Σ_{j=1}^{k} A_j x_{k-j}.
    fn system(&mut self, first: Row, index: usize, k: usize) {
        if self.defect.is_some() {
            return;
        }
        let mut b = std::mem::take(&mut self.scratch);
        let resolved = &self.resolved[index];
        let size = resolved.right.len();
        b[..size].fill(0.0);
        for (i, row) in &resolved.driven {
            b[*i as usize] = self.get(*row, k);
        }
        for (i, j, entry) in &resolved.moving {
            b[*i as usize] -= self.cauchy(*entry, 1, first + j, k - 1);
        }
        self.generals[index].solve(&mut b[..size]);
        (first..).zip(&b[..size]).for_each(|(row, value)| self.put(row, k, *value));
        self.scratch = b;
    }
}
