//! Order 0: the operations themselves, in all lanes.

use super::layout::{Layout, Row, Step, What};
use super::rows::Modes;
use crate::Unary;
use crate::solve::SINGULAR;
use algebra::elementary;
use algebra::simd::{Lanes, Simd, less, over, plus_product, root, sin_cos, times};

/// Values of all rows at a point of each lane.
pub(super) struct Point<'a> {
    pub(super) layout: &'a Layout,
    pub(super) numbers: &'a [Lanes],
    pub(super) modes: &'a Modes,
    pub(super) times: &'a Lanes,
    pub(super) states: &'a [Lanes],
}

impl Point<'_> {
    /// The results of these steps. A mass matrix that cannot be factored in a lane leaves no numbers there.
    #[inline(always)]
    pub(super) fn fill<S: Simd>(&self, simd: S, steps: &[u32], values: &mut [Lanes]) {
        for i in steps {
            let step = &self.layout.steps[*i as usize];
            let at = |row: &Row| &values[*row as usize];
            let value = match &step.what {
                What::Literal(number) => self.numbers[*number as usize],
                What::Time => *self.times,
                What::State(slot) => self.states[*slot as usize],
                What::Linear { constant, terms } => {
                    let mut sum = self.numbers[*constant as usize];
                    for (number, row) in terms {
                        sum = plus_product(simd, &sum, &self.numbers[*number as usize], at(row));
                    }
                    sum
                }
                What::Multiply(a, b) => times(simd, at(a), at(b)),
                What::Square(a) => times(simd, at(a), at(a)),
                What::Divide(a, b) => over(simd, at(a), at(b)),
                What::Root(a) => root(simd, at(a)),
                What::SinCos { a, hyperbolic: false } => {
                    let [sines, cosines] = sin_cos(simd, at(a));
                    values[step.row as usize + 1] = cosines;
                    sines
                }
                What::Choose { guard, sides } => self.modes.chosen(*guard, sides, |row| at(&row)),
                What::Solve { .. } => {
                    solve_first(simd, step, values);
                    continue;
                }
                _ => rarely(step, values, self.numbers),
            };
            values[step.row as usize] = value;
        }
    }
}

/// Functions, lane by lane: one source for all paths.
#[inline(never)]
fn rarely(step: &Step, values: &mut [Lanes], numbers: &[Lanes]) -> Lanes {
    let at = |row: &Row| values[*row as usize];
    match &step.what {
        What::Power(a, p) => {
            let (x, p) = (at(a), numbers[*p as usize]);
            std::array::from_fn(|lane| elementary::pow(x[lane], p[lane]))
        }
        What::Exp(a) => at(a).map(|x| Unary::Exp.apply(x)),
        What::Log(a) => at(a).map(|x| Unary::Log.apply(x)),
        What::Tanh(a) => {
            let x = at(a);
            // 1 - tanh² has few digits left near saturation; what tanh itself does not show any more is nothing
            let u = |x: f64| Some(elementary::powi(elementary::cosh(x), -2)).filter(|u| *u > f64::EPSILON).unwrap_or(0.0);
            values[step.own as usize + 1] = x.map(u);
            x.map(|x| Unary::Tanh.apply(x))
        }
        What::SinCos { a, hyperbolic: true } => {
            let x = at(a);
            values[step.row as usize + 1] = x.map(elementary::cosh);
            x.map(elementary::sinh)
        }
        // done where they are found
        _ => [f64::NAN; 8],
    }
}

/// M = L D Lᵀ, D on the diagonal, and M⁻¹ h. A pivot that is not positive spoils the lane.
#[inline(always)]
fn solve_first<S: Simd>(simd: S, step: &Step, values: &mut [Lanes]) {
    let What::Solve { matrix, right } = &step.what else { return };
    let (n, own) = (right.len(), step.own as usize);
    let mut packed = matrix.iter().map(|entry| entry.as_ref());
    for i in 0..n {
        for j in 0..=i {
            values[own + i * n + j] = packed.next().flatten().map_or([0.0; 8], |row| values[*row as usize]);
        }
        let diagonal = values[own + i * n + i];
        let mut pivot = diagonal;
        for j in 0..i {
            // c_ij = l_ij d_j = m_ij - Σ_k l_jk c_ik
            let mut c = values[own + i * n + j];
            for k in 0..j {
                c = less(simd, &c, &times(simd, &values[own + j * n + k], &values[own + i * n + k]));
            }
            values[own + i * n + j] = c;
        }
        for j in 0..i {
            let c = values[own + i * n + j];
            let l = over(simd, &c, &values[own + j * n + j]);
            pivot = less(simd, &pivot, &times(simd, &l, &c));
            values[own + i * n + j] = l;
        }
        let lost = diagonal.map(|d| SINGULAR * n as f64 * d.abs());
        values[own + i * n + i] = std::array::from_fn(|lane| if pivot[lane] > lost[lane] { pivot[lane] } else { f64::NAN });
    }
    for (i, row) in right.iter().enumerate() {
        values[step.row as usize + i] = values[*row as usize];
    }
    substitute(simd, n, [own, step.row as usize], values);
}

/// h := M⁻¹ h; the factors of M and h stand among the values from these places on.
#[inline(always)]
pub(super) fn substitute<S: Simd>(simd: S, n: usize, [factors, h]: [usize; 2], values: &mut [Lanes]) {
    for i in 0..n {
        let mut value = values[h + i];
        for j in 0..i {
            value = less(simd, &value, &times(simd, &values[factors + i * n + j], &values[h + j]));
        }
        values[h + i] = value;
    }
    for i in 0..n {
        values[h + i] = over(simd, &values[h + i], &values[factors + i * n + i]);
    }
    for i in (0..n).rev() {
        for j in 0..i {
            values[h + j] = less(simd, &values[h + j], &times(simd, &values[factors + i * n + j], &values[h + i]));
        }
    }
}
