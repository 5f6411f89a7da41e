//! The stages z_i = u(t + c_i h) - x by simplified Newton steps.
//!
//! ```text
//! r_i = z_i - h sum_j a_ij f(t + c_j h, x + z_j)        (I - h A ⊗ J) d = -r ,   z <- z + d
//! ```
//!
//! With A = T diag(mu) T^-1 the system of s n unknowns falls into one real and (s - 1)/2 complex systems of n unknowns. The iteration ends when what is
//! still missing lies below a hundredth of what the step may err, or below the rounding of f: rho_k = eps (sum_j |J_kj| |x_j| + |f_k| + |t ∂f_k/∂t|), which as an
//! error of the states is |(1/(h mu) - J)^-1| rho. *Source*: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, IV.8.

use super::nodes::{Base, Counts, Stages};
use super::radau::Tableau;
use super::scales::{NOTHING, Scales};
use crate::System;
use algebra::complex::Complex;
use algebra::elementary;
use algebra::lu::Lu;

/// Part of the admissible error that the iteration may leave.
const LEFT: f64 = 0.01;
/// Iterations of one attempt.
const MOST: usize = 14;
/// Part of a step over which the change of f with t is measured.
const APART: f64 = 1e-3;
/// Rounding of r, in units of its own estimate.
const ROUNDING: f64 = 4.0;

/// What became of an iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Outcome {
    /// The stages are found.
    Converged,
    /// It does not converge, or f has no value on the way.
    Failed,
}

/// Workspace.
#[derive(Clone, Debug)]
pub(super) struct Newton {
    n: usize,
    /// ∂f/∂x.
    pub(super) jacobian: Vec<f64>,
    factors: Vec<Lu<Complex>>,
    rates: Stages,
    residual: Stages,
    change: Stages,
    point: Vec<f64>,
    right: Vec<Complex>,
    /// |r| that is rounding, by state.
    pub(super) rounding: Vec<f64>,
    /// Rounding of f because t is rounded, by state.
    by_time: Vec<f64>,
}

impl Newton {
    pub(super) fn new(stages: usize, n: usize) -> Newton {
        let room = || Stages::new(stages, n);
        Newton {
            n,
            jacobian: vec![0.0; n * n],
            factors: Vec::new(),
            rates: room(),
            residual: room(),
            change: room(),
            point: vec![0.0; n],
            right: vec![Complex::ZERO; n],
            rounding: vec![0.0; n],
            by_time: vec![0.0; n],
        }
    }

    /// Factors I - h mu J for all mu; false when one is singular.
    pub(super) fn factor(&mut self, tableau: &Tableau, h: f64, counts: &mut Counts) -> bool {
        let n = self.n;
        counts.factorisations += tableau.eigen.len() as u64;
        let shifted = |mu: Complex| -> Vec<Complex> {
            let diagonal = |k: usize| if k / n == k % n { Complex::ONE } else { Complex::ZERO };
            (0..n * n).map(|k| diagonal(k) - mu.scale(h * self.jacobian[k])).collect()
        };
        let factors: Option<Vec<Lu<Complex>>> = tableau.eigen.iter().map(|e| Lu::exact(&shifted(e.value), n)).collect();
        self.factors = factors.unwrap_or_default();
        !self.factors.is_empty()
    }

    /// Replaces a defect of the rates by the error of the state that it means: (1/(h mu) - J)^-1 d with the real mu.
    pub(super) fn error_of(&mut self, tableau: &Tableau, h: f64, defect: &mut [f64]) {
        let factor = h * tableau.eigen[0].value.re;
        self.right.iter_mut().zip(&*defect).for_each(|(b, d)| *b = Complex::from(factor * d));
        let error = self.factors[0].solve(&self.right).unwrap_or_default();
        defect.iter_mut().zip(&error).for_each(|(d, b)| *d = b.re);
    }

    pub(super) fn solve<S: System + ?Sized>(
        &mut self,
        system: &mut S,
        base: &Base<'_>,
        (tableau, h): (&Tableau, f64),
        (stages, scales, counts): (&mut Stages, &mut Scales, &mut Counts),
    ) -> Outcome {
        scales.noise.fill(0.0);
        let (mut before, mut ratio) = (f64::INFINITY, 1.0_f64);
        for iteration in 0..MOST {
            counts.newton += 1;
            if !self.residuals(system, base, (tableau, h), stages) {
                return Outcome::Failed;
            }
            if iteration == 0 {
                self.measure_time(system, base, (tableau, h), stages);
                self.measure_rounding(base, h, stages);
                self.note_noise((tableau, h), scales);
            }
            let rounded = self.is_rounding(stages, scales);
            self.correct(tableau);
            stages.values.iter_mut().zip(&self.change.values).for_each(|(z, d)| *z += d);
            scales.measure(base.x, stages);
            let size = self.size_of_change(scales);
            if size.is_nan() {
                return Outcome::Failed;
            }
            if iteration > 0 {
                ratio = if iteration == 1 { size / before } else { (ratio * size / before).sqrt() };
            }
            let left = if ratio < 1.0 { ratio / (1.0 - ratio) * size } else { f64::INFINITY };
            if rounded || size == 0.0 || (iteration > 0 && left <= LEFT) {
                self.measure_rounding(base, h, stages);
                self.note_noise((tableau, h), scales);
                scales.measure(base.x, stages);
                return Outcome::Converged;
            }
            // hopeless: too much would be left at the end
            let remaining = (MOST - 1 - iteration) as i32;
            if iteration > 1 && (ratio >= 1.0 || elementary::powi(ratio, remaining) * size > LEFT) {
                return Outcome::Failed;
            }
            before = size;
        }
        Outcome::Failed
    }

    /// Rates and residuals at all nodes; false where f has no value.
    fn residuals<S: System + ?Sized>(&mut self, system: &mut S, base: &Base<'_>, (tableau, h): (&Tableau, f64), stages: &Stages) -> bool {
        let s = tableau.stages;
        for i in 0..s {
            base.state(stages.row(i), &mut self.point);
            if system.expand(base.time(tableau.nodes[i] * h), &self.point, base.modes, 1).is_err() {
                return false;
            }
            self.rates.row_mut(i).iter_mut().enumerate().for_each(|(k, f)| *f = system.state(k)[1]);
        }
        self.measure_rounding(base, h, stages);
        for i in 0..s {
            let row = self.residual.row_mut(i);
            row.copy_from_slice(stages.row(i));
            for j in 0..s {
                let weight = h * tableau.a[i * s + j];
                row.iter_mut().zip(self.rates.row(j)).for_each(|(r, f)| *r -= weight * f);
            }
        }
        self.residual.values.iter().all(|r| r.is_finite())
    }

    /// The rounding of h f: what cancels in f is as large as the parts that each state gives.
    fn measure_rounding(&mut self, base: &Base<'_>, h: f64, stages: &Stages) {
        let n = self.n;
        let size = |k: usize| base.x[k].abs() + stages.column(k).fold(0.0, |m: f64, z| m.max(z.abs()));
        let sizes: Vec<f64> = (0..n).map(size).collect();
        for (k, noise) in self.rounding.iter_mut().enumerate() {
            let parts: f64 = self.jacobian[k * n..(k + 1) * n].iter().zip(&sizes).map(|(j, x)| j.abs() * x).sum();
            let rate = self.rates.column(k).fold(0.0, |m: f64, f| m.max(f.abs()));
            *noise = ROUNDING * h * (f64::EPSILON * (parts + rate) + self.by_time[k]);
        }
    }

    /// What the rounding of t does to f: eps |t| |∂f/∂t| at the first, the middle and the last node, by differences. A pulse of a millisecond after an hour is
    /// known to ten digits only.
    fn measure_time<S: System + ?Sized>(&mut self, system: &mut S, base: &Base<'_>, (tableau, h): (&Tableau, f64), stages: &Stages) {
        self.by_time.fill(0.0);
        let s = tableau.stages;
        for i in [0, s / 2, s - 1] {
            base.state(stages.row(i), &mut self.point);
            let (t, later) = (base.time(tableau.nodes[i] * h), base.time((tableau.nodes[i] - APART) * h));
            // where there is no value beside the node nothing is known
            if t == later || system.expand(later, &self.point, base.modes, 1).is_err() {
                continue;
            }
            let rounding = f64::EPSILON * t.abs() / (t - later).abs();
            for (k, most) in self.by_time.iter_mut().enumerate() {
                let off = rounding * (system.state(k)[1] - self.rates.row(i)[k]).abs();
                *most = most.max(if off.is_finite() { off } else { 0.0 });
            }
        }
    }

    /// Whether nothing but rounding is left of the residuals.
    fn is_rounding(&self, stages: &Stages, scales: &Scales) -> bool {
        let rows = self.residual.values.chunks(self.n).zip(stages.values.chunks(self.n));
        let mut all = rows.flat_map(|(r, z)| r.iter().zip(z).zip(&self.rounding));
        all.all(|((r, z), noise)| r.abs() <= noise + ROUNDING * f64::EPSILON * z.abs() + NOTHING * scales.tolerance)
    }

    /// d from r.
    fn correct(&mut self, tableau: &Tableau) {
        self.change.values.fill(0.0);
        for (eigen, factor) in tableau.eigen.iter().zip(&self.factors) {
            self.right.fill(Complex::ZERO);
            for (i, weight) in eigen.row.iter().enumerate() {
                self.right.iter_mut().zip(self.residual.row(i)).for_each(|(b, r)| *b -= weight.scale(*r));
            }
            let change = factor.solve(&self.right).unwrap_or_default();
            for (i, weight) in eigen.column.iter().enumerate() {
                self.change.row_mut(i).iter_mut().zip(&change).for_each(|(d, w)| *d += weight.re * w.re - weight.im * w.im);
            }
        }
    }

    /// Largest change beside what the step may err; what is noise counts as settled.
    fn size_of_change(&self, scales: &Scales) -> f64 {
        let each = self.change.values.chunks(self.n).flat_map(|row| row.iter().zip(&scales.of).zip(&scales.noise));
        let beside = |((d, scale), noise): ((&f64, &f64), &f64)| if d.abs() <= *noise { 0.0 } else { d.abs() / (scales.tolerance * scale) };
        each.map(beside).fold(0.0, |m, q| if q <= m { m } else { q })
    }

    /// The rounding of f as the error of the states that it means, all directions added by size.
    fn note_noise(&mut self, (tableau, h): (&Tableau, f64), scales: &mut Scales) {
        scales.noise.fill(0.0);
        let mut defect = vec![0.0; self.n];
        for j in 0..self.n {
            defect.fill(0.0);
            defect[j] = self.rounding[j] / (ROUNDING * h);
            self.error_of(tableau, h, &mut defect);
            scales.noise.iter_mut().zip(&defect).for_each(|(noise, d)| *noise += d.abs());
        }
    }
}
