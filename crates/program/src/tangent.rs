//! The Jacobian of the motion, ∂x'/∂x, from the tape: exact derivatives, no differences.
//!
//! The interpreter fills the registers with values; one more walk over the instructions that the present modes need carries, for every
//! register r, the row ∂r/∂x_1 ... ∂r/∂x_n by the rule of each operation (forward mode; A. Griewank, A. Walther, Evaluating Derivatives, SIAM 2008,
//! chapter 3). A linear system A y = b gives
//!
//! ```text
//! A ∂y = ∂b - ∂A y        the factors of A serve all n directions
//! ```
//!
//! Inside a mode the motion is smooth; at a switching surface the derivative is that of the side which the mode names.

use crate::general::General;
use crate::guard::needed;
use crate::interpret::{decide, defective};
use crate::solve::Factor;
use crate::{Bound, Evaluator, Fault, Instruction, Mode, Operation, Point, Register, Unary};

/// Values and derivatives of the dynamics by the states.
#[derive(Clone, Debug)]
pub struct Tangent {
    evaluator: Evaluator,
    /// Number of directions: the states.
    n: usize,
    /// Row r: ∂(register r)/∂x.
    rows: Vec<f64>,
    /// Instructions of the body that the present modes need, by index.
    live: Vec<usize>,
    modes: Option<Vec<Mode>>,
    factor: Factor,
    general: General,
}

impl Tangent {
    /// For the dynamics of a program with its parameters.
    pub fn new(bound: &Bound) -> Tangent {
        let evaluator = bound.dynamics.clone();
        let n = evaluator.tape().shape.states;
        let rows = vec![0.0; evaluator.tape().registers() * n];
        Tangent { evaluator, n, rows, live: Vec::new(), modes: None, factor: Factor::default(), general: General::default() }
    }

    /// ∂x'/∂x at (t, x) in these modes, row i = derivatives of x'_i.
    ///
    /// *Shapes*: n x n, row-major. *Errors*: those of the interpreter; P007 when x' has a value but no derivative.
    pub fn jacobian(&mut self, time: f64, states: &[f64], modes: &[Mode], jacobian: &mut [f64]) -> Result<(), Fault> {
        let point = Point { time, states, modes: Some(modes), ..Point::default() };
        self.evaluator.evaluate(&point)?;
        self.choose(modes);
        let tape = self.evaluator.tape().clone();
        for &k in &self.live {
            let instruction = &tape.body[k];
            differentiate(instruction, &self.evaluator, &point, self.n, &mut self.rows, (&mut self.factor, &mut self.general))?;
        }
        for (row, root) in jacobian.chunks_mut(self.n.max(1)).zip(&tape.roots) {
            let start = root.register.index() * self.n;
            row.copy_from_slice(&self.rows[start..start + self.n]);
            if row.iter().any(|d| !d.is_finite()) {
                return Err(Fault::about("P007", root.name.clone()));
            }
        }
        Ok(())
    }

    fn choose(&mut self, modes: &[Mode]) {
        if self.modes.as_deref() == Some(modes) {
            return;
        }
        let (wanted, _) = needed(&self.evaluator, modes);
        let body = &self.evaluator.tape().body;
        let writes = |i: &Instruction| wanted[i.into.index()..i.into.index() + i.operation.width()].iter().any(|w| *w);
        self.live = (0..body.len()).filter(|k| writes(&body[*k])).collect();
        self.modes = Some(modes.to_vec());
        self.rows.fill(0.0);
    }
}

/// row(into) = Σ factor row(of).
fn combine(rows: &mut [f64], n: usize, into: usize, terms: &[(f64, Register)]) {
    let (done, rest) = rows.split_at_mut(into * n);
    let row = &mut rest[..n];
    row.fill(0.0);
    // a term whose factor has no value counts only where its argument moves
    for (factor, of) in terms {
        let of = &done[of.index() * n..(of.index() + 1) * n];
        row.iter_mut().zip(of).filter(|(_, d)| **d != 0.0).for_each(|(sum, d)| *sum += factor * d);
    }
}

fn differentiate(
    instruction: &Instruction,
    values: &Evaluator,
    point: &Point<'_>,
    n: usize,
    rows: &mut [f64],
    (factor, general): (&mut Factor, &mut General),
) -> Result<(), Fault> {
    let into = instruction.into.index();
    let at = |r: &Register| values.value(*r);
    let own = |k: usize| values.value(Register((into + k) as u32));
    match &instruction.operation {
        Operation::Number(_) | Operation::Parameter(_) | Operation::Time | Operation::Acceleration(_) => {}
        Operation::State(slot) => rows[into * n + *slot as usize] = 1.0,
        Operation::Linear { terms, .. } => {
            let terms: Vec<(f64, Register)> = terms.iter().map(|(c, r)| (values.coefficient(*c), *r)).collect();
            combine(rows, n, into, &terms);
        }
        Operation::Multiply(a, b) => combine(rows, n, into, &[(at(b), *a), (at(a), *b)]),
        Operation::Square(a) => combine(rows, n, into, &[(2.0 * at(a), *a)]),
        Operation::Divide(a, b) => combine(rows, n, into, &[(1.0 / at(b), *a), (-own(0) / at(b), *b)]),
        Operation::Power(a, p) => {
            let p = values.coefficient(*p);
            combine(rows, n, into, &[(p * at(a).powf(p - 1.0), *a)]);
        }
        Operation::Unary(f, a) => combine(rows, n, into, &[(slope(*f, at(a), own(0)), *a)]),
        Operation::Atan2(y, x) => {
            let square = at(x) * at(x) + at(y) * at(y);
            combine(rows, n, into, &[(at(x) / square, *y), (-at(y) / square, *x)]);
        }
        Operation::SinCos(a) => {
            combine(rows, n, into, &[(own(1), *a)]);
            combine(rows, n, into + 1, &[(-own(0), *a)]);
        }
        Operation::SinhCosh(a) => {
            combine(rows, n, into, &[(own(1), *a)]);
            combine(rows, n, into + 1, &[(own(0), *a)]);
        }
        Operation::Choose { by, sides } => {
            let side = decide(*by, values.registers(), point, values.tape()).map_or_else(|undecided| undecided, |mode| sides[mode.side()]);
            combine(rows, n, into, &[(1.0, side)]);
        }
        Operation::Solve { matrix, right } => {
            factor.load(right.len(), matrix.iter().map(|r| r.map_or(0.0, |r| at(&r))));
            factor.factor().map_err(|defect| defective(values.tape(), instruction.into, defect))?;
            let entries = matrix.iter().zip(triangle(right.len())).filter_map(|(r, place)| r.map(|r| (place, r)));
            let both = entries.flat_map(|((i, j), r)| [Some((i, j, r)), (i != j).then_some((j, i, r))]).flatten();
            solve(rows, n, (into, right), (&|k| own(k), both.collect()), &mut |b| factor.solve(b));
        }
        Operation::System { matrix, right } => {
            let size = right.len();
            general.load(size, matrix.iter().map(|r| r.map_or(0.0, |r| at(&r))));
            general.factor().map_err(|defect| defective(values.tape(), instruction.into, defect))?;
            let entries = matrix.iter().enumerate().filter_map(|(k, r)| r.map(|r| (k / size, k % size, r)));
            solve(rows, n, (into, right), (&|k| own(k), entries.collect()), &mut |b| general.solve(b));
        }
    }
    Ok(())
}

/// Row, column and register of an entry of a matrix.
type Entry = (usize, usize, Register);

/// (i, j) of the packed lower triangle, by rows.
fn triangle(size: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..size).flat_map(|i| (0..=i).map(move |j| (i, j)))
}

/// Rows of the solution y: A ∂y = ∂b - ∂A y, direction by direction; `entries` are (i, j, register) of A.
fn solve(
    rows: &mut [f64],
    n: usize,
    (into, right): (usize, &[Register]),
    (solution, entries): (&dyn Fn(usize) -> f64, Vec<Entry>),
    invert: &mut dyn FnMut(&mut [f64]),
) {
    let mut b = vec![0.0; right.len()];
    for direction in 0..n {
        for (value, r) in b.iter_mut().zip(right) {
            *value = rows[r.index() * n + direction];
        }
        for (i, j, r) in &entries {
            b[*i] -= rows[r.index() * n + direction] * solution(*j);
        }
        invert(&mut b);
        for (k, value) in b.iter().enumerate() {
            rows[(into + k) * n + direction] = *value;
        }
    }
}

/// f'(x), with the value f(x) at hand.
fn slope(f: Unary, x: f64, value: f64) -> f64 {
    match f {
        Unary::SquareRoot => 0.5 / value,
        Unary::Exp => value,
        Unary::Log => 1.0 / x,
        Unary::Tan => 1.0 + value * value,
        // 1 - tanh² would cancel near saturation
        Unary::Tanh => x.cosh().recip().powi(2),
        Unary::Asin => ((1.0 - x) * (1.0 + x)).sqrt().recip(),
        Unary::Acos => -((1.0 - x) * (1.0 + x)).sqrt().recip(),
        Unary::Atan => 1.0 / (1.0 + x * x),
    }
}
