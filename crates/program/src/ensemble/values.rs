//! Order 0: the operations themselves, in all lanes.

use super::layout::{Layout, Row, Step, What};
use super::rows::Modes;
use crate::solve::SINGULAR;
use algebra::elementary;
use algebra::simd::{Lanes, Simd, exp, less, log, over, plus_product, root, sin_cos, sinh_cosh, tanh, times};

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
                What::SinCos { a, hyperbolic: true } => {
                    let [sines, cosines] = sinh_cosh(simd, at(a));
                    values[step.row as usize + 1] = cosines;
                    sines
                }
                What::Exp(a) => exp(simd, at(a)),
                What::Log(a) => log(simd, at(a)),
                What::Tanh(a) => {
                    let [value, rest] = tanh(simd, at(a));
                    values[step.own as usize + 1] = rest;
                    value
                }
                What::Power(a, p) => power(at(a), &self.numbers[*p as usize]),
                What::Choose { guard, sides } => self.modes.chosen(*guard, sides, |row| at(&row)),
                What::Solve { .. } => {
                    solve_first(simd, step, values);
                    continue;
                }
            };
            values[step.row as usize] = value;
        }
    }
}

/// Powers, lane by lane: the only function left to the library.
#[inline(never)]
fn power(x: &Lanes, p: &Lanes) -> Lanes {
    std::array::from_fn(|lane| elementary::pow(x[lane], p[lane]))
}

/// M = L D Lᵀ, the reciprocals of D on the diagonal, and M⁻¹ h. A pivot that is not positive spoils the lane.
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
            let l = times(simd, &c, &values[own + j * n + j]);
            pivot = less(simd, &pivot, &times(simd, &l, &c));
            values[own + i * n + j] = l;
        }
        let lost = diagonal.map(|d| SINGULAR * n as f64 * d.abs());
        let sound = std::array::from_fn(|lane| if pivot[lane] > lost[lane] { pivot[lane] } else { f64::NAN });
        values[own + i * n + i] = over(simd, &[1.0; 8], &sound);
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
        values[h + i] = times(simd, &values[h + i], &values[factors + i * n + i]);
    }
    for i in (0..n).rev() {
        for j in 0..i {
            values[h + j] = less(simd, &values[h + j], &times(simd, &values[factors + i * n + j], &values[h + i]));
        }
    }
}
