//! Folds, period doublings, Hopf and torus points as zeros: the equations of a branch, and one more that says that its point is one of them. The unknowns of the branch are followed by
//! the second parameter, which is the last one.
//!
//! ```text
//! R(u, p; s) = 0,      g(u, p; s) = 0,      | A   b | |v|   |0|        A = ∂R/∂u of a fold, Φ + 1 of a period doubling
//!                                           | c'  0 | |g| = |1|        b, c beside the null directions of A' and A
//! ```
//!
//! Of a Hopf point g is half the sum of its two roots, of a torus point the product of its two multipliers less 1: both stay smooth where the two become real.
//!
//! g = det A / det of the bordered matrix vanishes with det A, and is of the size of its least singular value. Its derivatives are differences.
//!
//! *Source*: W. Govaerts, Numerical Methods for Bifurcations of Dynamical Equilibria (2000), 4; Yu. A. Kuznetsov, Elements of Applied Bifurcation Theory, 10.3.

use super::locate::What;
use super::zeros::{Local, Sort, Zeros};
use crate::Fault;
use crate::studies::periodic::Multiplier;
use algebra::complex::{self, Complex};
use algebra::lu::Lu;
use algebra::vectors::norm;
use words::{Message, Text};

/// Half of the distance of the places whose g are compared for its derivatives, in scales: A is known to some twelve digits, and a difference about the middle errs by its square.
const STEP: f64 = 3e-5;
/// Cosine of the angle between a border and the null direction below which another one is taken.
const BESIDE: f64 = 0.5;

/// Folds or period doublings of what is followed.
pub(super) struct Turning<'z> {
    pub(super) inner: &'z mut dyn Zeros,
    what: What,
    /// Range of the second parameter.
    range: f64,
    /// b and c.
    border: Option<[Vec<f64>; 2]>,
    /// What told the pair at the last point, and the frequency at the first one; of a fold the largest root there.
    pair: Option<(f64, f64)>,
}

impl<'z> Turning<'z> {
    pub(super) fn new(inner: &'z mut dyn Zeros, what: What, range: f64) -> Turning<'z> {
        Turning { inner, what, range, border: None, pair: None }
    }

    /// A, row by row, and its order.
    fn matrix(&self, local: &Local) -> (Vec<f64>, usize) {
        let columns = local.basis.len();
        let (k, own) = if self.what == What::Doubling { (local.states.len(), 2.0) } else { (local.rows(), 0.0) };
        let entry = |e: usize| local.jacobian[e / k * columns + e % k] + if e / k == e % k { own } else { 0.0 };
        ((0..k * k).map(entry).collect(), k)
    }

    fn is_pair(&self) -> bool {
        matches!(self.what, What::Hopf | What::Torus)
    }

    /// g of the pair that goes on from the last point, what tells it, and the frequency of the first one.
    fn of_pair(&self, local: &Local) -> Result<(f64, f64, f64), Fault> {
        let sort = self.inner.sort();
        let list: Vec<_> = local.facts.multipliers.iter().flatten().filter(|m| !m.trivial).map(|m| Complex::new(m.re, m.im)).collect();
        let mut best: Option<(f64, (f64, f64, f64))> = None;
        for (i, a) in list.iter().enumerate() {
            for b in &list[i + 1..] {
                let (sum, product) = (a + b, a * b);
                // conjugate, or both real: other sums and products have imaginary parts
                if a.im != -b.im || (self.pair.is_none() && a.im == 0.0) {
                    continue;
                }
                let size = self.pair.map_or(product.re.abs().sqrt(), |pair| pair.1);
                let (g, told) = match sort {
                    Sort::Roots => (0.5 * sum.re / size, product.re / (size * size)),
                    Sort::Multipliers => (product.re - 1.0, 0.5 * sum.re),
                };
                let off = g.abs() + self.pair.map_or(0.0, |pair| (told - pair.0).abs());
                if best.as_ref().is_none_or(|(least, _)| off < *least) {
                    best = Some((off, (g, told, size)));
                }
            }
        }
        best.map(|(_, found)| found).ok_or_else(no_border)
    }

    /// g with the border that there is; one that lies beside the null directions is made where there is none. The signs of g and of the null direction of A' go on: what happens on the
    /// curve is told by signs.
    fn test(&mut self, local: &mut Local) -> Result<f64, Fault> {
        if self.is_pair() {
            let (g, told, size) = self.of_pair(local)?;
            self.pair = Some((told, size));
            local.facts.pair = Some((self.inner.sort(), told));
            return Ok(g);
        }
        let (matrix, k) = self.matrix(local);
        let old =
            self.border.as_ref().and_then(|[b, c]| Some((Bordered::new(&matrix, b, c)?, Bordered::new(&transposed(&matrix, k), c, b)?)));
        if let (Some([b, c]), Some((right, left))) = (&self.border, &old)
            && beside(c, &right.v)
            && beside(b, &left.v)
        {
            return Ok(right.g);
        }
        let (mut b, mut c) = null(&transposed(&matrix, k), k).zip(null(&matrix, k)).ok_or_else(no_border)?;
        let turned = |v: &mut [f64]| v.iter_mut().for_each(|v| *v = -*v);
        if old.as_ref().is_some_and(|(_, left)| inner(&b, &left.v) < 0.0) {
            turned(&mut b);
        }
        let mut found = Bordered::new(&matrix, &b, &c).ok_or_else(no_border)?;
        if old.is_some_and(|(right, _)| right.determinant * found.determinant < 0.0) {
            turned(&mut c);
            found.g = -found.g;
        }
        self.border = Some([b, c]);
        Ok(found.g)
    }

    /// w ∂R/∂p of both parameters, the last columns of equations of which A is the part before them; w A = 0 as b lies.
    fn across(&self, local: &Local) -> Option<[f64; 2]> {
        let ([b, c], columns) = (self.border.as_ref()?, local.basis.len());
        let k = b.len();
        let entry = |e: usize| local.jacobian[e % k * columns + e / k];
        let w = Bordered::new(&(0..k * k).map(entry).collect::<Vec<_>>(), c, b)?.v;
        Some([k, k + 1].map(|j| (0..k).map(|i| w[i] * local.jacobian[i * columns + j]).sum()))
    }

    /// g with the border that there is.
    fn value(&self, local: &Local) -> Result<f64, Fault> {
        if self.is_pair() {
            return Ok(self.of_pair(local)?.0);
        }
        let (matrix, _) = self.matrix(local);
        let found = self.border.as_ref().and_then(|[b, c]| Bordered::new(&matrix, b, c));
        found.map(|found| found.g).ok_or_else(no_border)
    }

    /// The product of all roots but the one that is 0 at a fold, as a share of the power of the largest at the first point: the second coefficient of the characteristic equation, which vanishes
    /// where two roots are 0.
    fn beside_zero(&mut self, roots: &[Multiplier]) -> Option<f64> {
        let list: Vec<Complex> = roots.iter().map(|m| Complex::new(m.re, m.im)).collect();
        let largest = list.iter().map(|z| complex::abs(*z)).fold(0.0, f64::max);
        let size = self.pair.get_or_insert((0.0, largest)).1;
        let without = |k: usize| list.iter().enumerate().filter(|(i, _)| *i != k).map(|(_, z)| z / size).product::<Complex>();
        (list.len() > 1).then(|| (0..list.len()).map(without).sum::<Complex>().re)
    }

    /// The equations of the branch at y, whose last unknown is the second parameter, with the same free directions as another place.
    fn beside(&mut self, y: &[f64], near: &Local) -> Result<Local, Fault> {
        let last = y.len() - 1;
        self.inner.hold(y[last]);
        let local = self.inner.local(&y[..last])?;
        if local.states == near.states { Ok(local) } else { Err(no_border()) }
    }
}

/// The solution of the bordered system, and its determinant.
struct Bordered {
    v: Vec<f64>,
    g: f64,
    determinant: f64,
}

impl Bordered {
    fn new(matrix: &[f64], b: &[f64], c: &[f64]) -> Option<Bordered> {
        let k = b.len();
        if matrix.len() != k * k {
            return None;
        }
        let mut rows = Vec::with_capacity((k + 1) * (k + 1));
        for (row, b) in matrix.chunks(k).zip(b) {
            rows.extend_from_slice(row);
            rows.push(*b);
        }
        rows.extend_from_slice(c);
        rows.push(0.0);
        let unit: Vec<f64> = (0..=k).map(|i| if i == k { 1.0 } else { 0.0 }).collect();
        let lu = Lu::exact(&rows, k + 1)?;
        let mut v = lu.solve(&unit)?;
        let g = v.pop()?;
        g.is_finite().then(|| Bordered { v, g, determinant: lu.determinant() })
    }
}

/// R in the scales of another place, which may have grown since.
fn rescaled(local: &Local, near: &Local) -> Vec<f64> {
    let share = |i: usize| local.states.get(i).map_or(1.0, |s| local.scales[*s] / near.scales[*s]);
    local.residual.iter().enumerate().map(|(i, r)| r * share(i)).collect()
}

fn inner(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn beside(c: &[f64], v: &[f64]) -> bool {
    inner(c, v).abs() >= BESIDE * norm(c) * norm(v)
}

fn transposed(matrix: &[f64], k: usize) -> Vec<f64> {
    (0..k * k).map(|e| matrix[(e % k) * k + e / k]).collect()
}

/// The direction that a matrix all but takes away, of unit length.
fn null(matrix: &[f64], k: usize) -> Option<Vec<f64>> {
    // a right side that no symmetry of a machine knows
    let mut v: Vec<f64> = (0..k).map(|i| 1.0 + 0.37 * i as f64).collect();
    let exact = Lu::exact(matrix, k);
    for _ in 0..2 {
        v = match &exact {
            Some(lu) => lu.solve(&v)?,
            None => Lu::new(matrix, k).null_direction()?,
        };
        let length = norm(&v);
        if !(length > 0.0 && length.is_finite()) {
            return None;
        }
        v.iter_mut().for_each(|v| *v /= length);
    }
    Some(v)
}

impl Zeros for Turning<'_> {
    fn local(&mut self, y: &[f64]) -> Result<Local, Fault> {
        let last = y.len() - 1;
        self.inner.hold(y[last]);
        let mut local = self.inner.local(&y[..last])?;
        let g = self.test(&mut local)?;
        match (self.what, self.inner.sort()) {
            (What::Hopf, Sort::Roots) => local.facts.lyapunov = self.inner.lyapunov(&y[..last]),
            (What::Fold, Sort::Roots) => local.facts.rest = self.beside_zero(local.facts.multipliers.as_deref().unwrap_or_default()),
            _ => {}
        }
        let (m, k) = (local.rows(), local.basis.len());
        let mut slopes = Vec::with_capacity(k + 1);
        for j in 0..k {
            let mut ends = [0.0; 2];
            for (end, step) in ends.iter_mut().zip([-STEP, STEP]) {
                let change: Vec<f64> = (0..k).map(|i| if i == j { step } else { 0.0 }).collect();
                let mut there = self.inner.moved(&y[..last], &change, &local)?;
                there.push(y[last]);
                let there = self.beside(&there, &local)?;
                *end = self.value(&there)?;
            }
            slopes.push((ends[1] - ends[0]) / (2.0 * STEP));
        }
        let mut beside = Vec::with_capacity(2);
        for step in [-STEP, STEP] {
            let mut there = y.to_vec();
            there[last] += step * self.range;
            let there = self.beside(&there, &local)?;
            beside.push((self.value(&there)?, rescaled(&there, &local)));
        }
        slopes.push((beside[1].0 - beside[0].0) / (2.0 * STEP));
        let mut jacobian = Vec::with_capacity((m + 1) * (k + 1));
        for (i, row) in local.jacobian.chunks(k).enumerate() {
            jacobian.extend_from_slice(row);
            jacobian.push((beside[1].1[i] - beside[0].1[i]) / (2.0 * STEP));
        }
        jacobian.extend(slopes);
        local.jacobian = jacobian;
        local.residual.push(g);
        local.basis.iter_mut().for_each(|column| column.push(0.0));
        local.basis.push((0..=last).map(|i| if i == last { 1.0 } else { 0.0 }).collect());
        local.scales.push(self.range);
        local.facts.across = if self.what == What::Fold { self.across(&local) } else { None };
        // one of the multipliers is where it is by definition
        local.facts.multipliers = None;
        local.facts.stable = None;
        self.inner.hold(y[last]);
        Ok(local)
    }

    fn residual(&mut self, y: &[f64], near: &Local) -> Result<Vec<f64>, Fault> {
        let local = self.beside(y, near)?;
        let mut residual = rescaled(&local, near);
        residual.truncate(local.states.len());
        residual.extend(near.phase_at(y));
        residual.push(self.value(&local)?);
        Ok(residual)
    }

    fn moved(&mut self, y: &[f64], change: &[f64], near: &Local) -> Result<Vec<f64>, Fault> {
        let last = y.len() - 1;
        let second = y[last] + change.last().copied().unwrap_or(0.0) * self.range;
        self.inner.hold(second);
        let mut moved = self.inner.moved(&y[..last], change, near)?;
        moved.push(second);
        Ok(moved)
    }

    fn hold(&mut self, second: f64) {
        self.inner.hold(second);
    }

    fn switches(&mut self, _: &[f64]) -> Option<Vec<usize>> {
        None
    }

    fn sort(&self) -> Sort {
        self.inner.sort()
    }

    fn turns(&self) -> [usize; 2] {
        self.inner.turns()
    }
}

/// The matrix has no single null direction there.
fn no_border() -> Fault {
    Fault::new(Message {
        code: "S156",
        what: Text::new(
            "the curve of folds or period doublings has no single direction there",
            "кривая складок или удвоений периода не имеет там определённого направления",
        ),
        why: Text::new(
            "a second multiplier is where the first one is, or other states become dependent on the way",
            "там же оказывается второй мультипликатор или по пути зависимыми становятся другие состояния",
        ),
        help: Text::new(
            "begin at another value of the second parameter, on the other side of that point",
            "начните с другого значения второго параметра, по другую сторону от этой точки",
        ),
    })
}
