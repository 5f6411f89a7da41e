//! Derivatives of the dynamics by state and time: forward differentiation along the tape, all directions in one pass.
//!
//! Every register carries its derivatives beside its value, u' = Σ ∂op/∂a a'; a system A x = b gives A x' = b' - A' x with the matrix of the
//! value. The derivatives are exact up to rounding in the modes given: of a choice only the branch that is taken counts.
//! *Source*: A. Griewank, A. Walther, Evaluating Derivatives, 3.1.

use crate::general::General;
use crate::interpret::places;
use crate::solve::Factor;
use crate::{Bound, Evaluator, Fault, Instruction, Operation, Point, Register, Unary};
use algebra::elementary;

/// The dynamics with their derivatives.
#[derive(Clone, Debug)]
pub struct Tangent {
    values: Evaluator,
    /// Registers x columns.
    slopes: Vec<f64>,
    /// States, then time.
    columns: usize,
    /// One row of slopes under construction.
    row: Vec<f64>,
    /// Right sides of a system, a row each.
    sides: Vec<f64>,
    roots: Vec<f64>,
    factor: Factor,
    general: General,
}

impl Tangent {
    /// For the dynamics of a machine.
    pub fn new(bound: &Bound) -> Tangent {
        let columns = bound.dimension() + 1;
        let values = bound.dynamics.clone();
        let tape = values.tape();
        Tangent {
            slopes: vec![0.0; tape.registers() * columns],
            roots: vec![0.0; (bound.dimension() + tape.guards.len()) * columns],
            values,
            columns,
            row: vec![0.0; columns],
            sides: Vec::new(),
            factor: Factor::default(),
            general: General::default(),
        }
    }

    /// Derivatives, row by row: of x' (one row per state), then of the guards (zero where one has no formula). Columns: the states, then time. A
    /// slope that does not exist (that of a square root at zero) is not finite.
    ///
    /// *Shapes*: (states + guards) x (states + 1). *Units*: SI. *Errors*: those of the equations at the point.
    pub fn evaluate(&mut self, point: &Point) -> Result<&[f64], Fault> {
        self.values.evaluate(point)?;
        let tape = std::sync::Arc::clone(self.values.tape());
        for instruction in &tape.body {
            self.differentiate(instruction, point)?;
        }
        let rates = tape.roots.iter().take(self.columns - 1).map(|root| Some(root.register));
        for (row, register) in self.roots.chunks_mut(self.columns).zip(rates.chain(tape.guards.iter().copied())) {
            match register.map(|r| r.index() * self.columns) {
                Some(from) => row.copy_from_slice(&self.slopes[from..from + self.columns]),
                None => row.fill(0.0),
            }
        }
        Ok(&self.roots)
    }

    /// row += factor times the slopes of a register; a slope of zero adds nothing even where the factor is infinite.
    fn add(&mut self, factor: f64, of: Register) {
        let from = of.index() * self.columns;
        for (r, s) in self.row.iter_mut().zip(&self.slopes[from..from + self.columns]) {
            if *s != 0.0 {
                *r += factor * s;
            }
        }
    }

    /// Puts the row under construction at a register.
    fn put(&mut self, into: usize) {
        let from = into * self.columns;
        self.slopes[from..from + self.columns].copy_from_slice(&self.row);
        self.row.fill(0.0);
    }

    fn differentiate(&mut self, instruction: &Instruction, point: &Point) -> Result<(), Fault> {
        let into = instruction.into.index();
        let own = self.values.value(instruction.into);
        let at = |t: &Tangent, r: &Register| t.values.value(*r);
        match &instruction.operation {
            Operation::Number(_) | Operation::Parameter(_) | Operation::Acceleration(_) => {}
            Operation::Time => self.row[self.columns - 1] = 1.0,
            Operation::State(slot) => self.row[*slot as usize] = 1.0,
            Operation::Linear { terms, .. } => {
                for (c, r) in terms {
                    let c = self.values.coefficient(*c);
                    self.add(c, *r);
                }
            }
            Operation::Multiply(a, b) => {
                let (x, y) = (at(self, a), at(self, b));
                self.add(y, *a);
                self.add(x, *b);
            }
            Operation::Square(a) => self.add(2.0 * at(self, a), *a),
            Operation::Divide(a, b) => {
                let y = at(self, b);
                self.add(1.0 / y, *a);
                self.add(-own / y, *b);
            }
            Operation::Power(a, p) => {
                let p = self.values.coefficient(*p);
                // a radicand whose power has a value is negative by rounding only
                let base = if own.is_finite() && p.fract() != 0.0 { at(self, a).max(0.0) } else { at(self, a) };
                let slope = if p == 0.0 { 0.0 } else { p * elementary::pow(base, p - 1.0) };
                self.add(slope, *a);
            }
            Operation::Unary(f, a) => self.add(slope(*f, at(self, a), own), *a),
            Operation::Atan2(a, b) => {
                let (y, x) = (at(self, a), at(self, b));
                let square = y * y + x * x;
                self.add(x / square, *a);
                self.add(-y / square, *b);
            }
            Operation::SinCos(a) => {
                self.pair(instruction.into, *a, -own);
                return Ok(());
            }
            Operation::SinhCosh(a) => {
                self.pair(instruction.into, *a, own);
                return Ok(());
            }
            Operation::Choose { by, sides } => {
                if let Some(mode) = self.values.decided(*by, point) {
                    self.add(1.0, sides[mode.side()]);
                }
            }
            Operation::Solve { .. } | Operation::System { .. } => {
                self.solved(instruction);
                return Ok(());
            }
        }
        self.put(into);
        Ok(())
    }

    /// A function beside its derivative, whose own derivative is `second`.
    fn pair(&mut self, first: Register, of: Register, second: f64) {
        let into = first.index();
        let slope = self.values.value(Register(first.0 + 1));
        self.add(slope, of);
        self.put(into);
        self.add(second, of);
        self.put(into + 1);
    }

    /// Unknowns of a linear system, whose rows are put at once.
    fn solved(&mut self, instruction: &Instruction) {
        let into = instruction.into.index();
        match &instruction.operation {
            Operation::Solve { matrix, right } => {
                let values = &self.values;
                self.factor.load(right.len(), matrix.iter().map(|r| r.map_or(0.0, |r| values.value(r))));
                // the value has been found with this matrix: it is regular
                if self.factor.factor().is_ok() {
                    let place = |i: usize, j: usize| matrix[if i >= j { i * (i + 1) / 2 + j } else { j * (j + 1) / 2 + i }];
                    self.system(into, right, &place, &|t: &mut Tangent, b: &mut [f64]| t.factor.solve(b));
                }
            }
            Operation::System { matrix, right, spare } => {
                let values = &self.values;
                self.general.load((right.len(), spare.as_deref()), places(matrix).map(|(place, r)| (place, values.value(r))));
                if self.general.factor().is_ok() {
                    let n = right.len();
                    self.system(into, right, &|i, j| matrix[i * n + j], &|t: &mut Tangent, b: &mut [f64]| t.general.solve_refined(b));
                }
            }
            _ => {}
        }
    }

    /// A x' = b' - A' x: all columns of the right sides at once, then column by column.
    fn system(
        &mut self,
        into: usize,
        right: &[Register],
        place: &dyn Fn(usize, usize) -> Option<Register>,
        solve: &dyn Fn(&mut Tangent, &mut [f64]),
    ) {
        let (n, m) = (right.len(), self.columns);
        let mut sides = std::mem::take(&mut self.sides);
        sides.clear();
        for (i, r) in right.iter().enumerate() {
            sides.extend_from_slice(&self.slopes[r.index() * m..(r.index() + 1) * m]);
            let side = &mut sides[i * m..];
            for (j, entry) in (0..n).filter_map(|j| Some((j, place(i, j)?))) {
                let x = self.values.value(Register((into + j) as u32));
                let slopes = &self.slopes[entry.index() * m..(entry.index() + 1) * m];
                side.iter_mut().zip(slopes).for_each(|(b, a)| *b -= a * x);
            }
        }
        let mut b = vec![0.0; n];
        for column in 0..m {
            (0..n).for_each(|i| b[i] = sides[i * m + column]);
            if b.iter().any(|v| *v != 0.0) {
                solve(self, &mut b);
            }
            b.iter().enumerate().for_each(|(j, v)| self.slopes[(into + j) * m + column] = *v);
        }
        self.sides = sides;
    }
}

/// Derivative at x of a function with the value `own` there.
fn slope(f: Unary, x: f64, own: f64) -> f64 {
    match f {
        Unary::SquareRoot => 0.5 / own,
        Unary::Exp => own,
        Unary::Log => 1.0 / x,
        Unary::Tan => 1.0 + own * own,
        Unary::Asin => 1.0 / ((1.0 - x) * (1.0 + x)).sqrt(),
        Unary::Acos => -1.0 / ((1.0 - x) * (1.0 + x)).sqrt(),
        Unary::Atan => 1.0 / (1.0 + x * x),
        Unary::Asinh => 1.0 / elementary::hypot(x, 1.0),
        Unary::Acosh => 1.0 / ((x - 1.0) * (x + 1.0)).sqrt(),
        Unary::Atanh => 1.0 / ((1.0 - x) * (1.0 + x)),
        // 1 - tanh² without cancellation
        Unary::Tanh => elementary::powi(elementary::cosh(x).recip(), 2),
    }
}
