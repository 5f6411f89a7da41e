//! Motions about which a machine is linearised: accelerations and reactions of a state that does not rest.

use super::{BALANCED, LinearMachine, Place, driven};
use crate::Fault;
use crate::linear::matrices::Matrices;
use algebra::lu::Lu;
use algebra::qr;
use words::Text;

/// Share of the largest unknown below which one is the rounding of a solution in scaled rows.
const SOLVED: f64 = 1e-13;

impl LinearMachine {
    /// q'' and λ of the motion with the place's q and q', from M q'' = h + R λ and J q'' = -remainder.
    ///
    /// *Errors*: S073 where they do not give them; an entry has no finite value.
    pub fn moving(&mut self, place: &Place) -> Result<Place, Fault> {
        let n = self.names.len();
        let full = self.full(&Place { accelerations: vec![0.0; n], multipliers: Vec::new(), ..place.clone() })?;
        let (m, k) = (full.remainders.len(), self.linear.multipliers.len());
        let size = n + m.max(k);
        if m != k {
            return Err(driven());
        }
        let mut a = vec![0.0; size * size];
        let mut right = vec![0.0; size];
        let terms = self.force_terms(place)?;
        for i in 0..n {
            (0..n).for_each(|j| a[i * size + j] = full.matrices.mass[i * n + j]);
            (0..k).for_each(|c| a[i * size + n + c] = -full.reach[i * k + c]);
            let h = full.matrices.force[i];
            right[i] = if h.abs() <= BALANCED * terms[i] { 0.0 } else { h };
        }
        for c in 0..m {
            (0..n).for_each(|j| a[(n + c) * size + j] = full.matrices.jacobian[c * n + j]);
            right[n + c] = -full.remainders[c];
        }
        let solved = scaled_solution(&a, &right, size).ok_or_else(|| undetermined(&place.q))?;
        Ok(Place { accelerations: solved[..n].to_vec(), multipliers: solved[n..].to_vec(), ..place.clone() })
    }

    /// q'' of the motion with the place's q and q' where nothing connects, from M q'' = h.
    ///
    /// An acceleration below what `BALANCED` of the terms of h, and of M q'', make of it through M⁻¹ is zero: in a steady motion (relative equilibrium)
    /// large terms cancel, and their rounding must not enter C by ∂(M q'')/∂q. None where M is singular.
    ///
    /// *Errors*: an entry has no finite value.
    pub fn steady(&mut self, place: &Place) -> Result<Option<Vec<f64>>, Fault> {
        let n = self.names.len();
        let Matrices { mass, force, .. } = self.at(place)?;
        let lu = Lu::new(&mass, n);
        let Some(mut found) = lu.solve(&force) else { return Ok(None) };
        let inertia = |i: usize| (0..n).map(|j| (mass[i * n + j] * found[j]).abs()).sum::<f64>();
        let doubt: Vec<f64> = self.force_terms(place)?.iter().enumerate().map(|(i, t)| BALANCED * (t + inertia(i))).collect();
        let mut spread = vec![0.0; n];
        for (k, d) in doubt.iter().enumerate() {
            let unit: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == k))).collect();
            let column = lu.solve(&unit).unwrap_or_default();
            spread.iter_mut().zip(column).for_each(|(s, c)| *s += (c * d).abs());
        }
        found.iter_mut().zip(spread).filter(|(a, s)| a.abs() <= *s).for_each(|(a, _)| *a = 0.0);
        Ok(Some(found))
    }

    /// The size of the terms that add up to each mean force at a place: Σ |∂h/∂p p| over parameters, coordinates and rates; a rounding of any of them
    /// changes h by ε of it.
    ///
    /// *Errors*: an entry has no finite value.
    pub fn force_terms(&mut self, place: &Place) -> Result<Vec<f64>, Fault> {
        let n = self.names.len();
        let place = Place { accelerations: vec![0.0; n], multipliers: Vec::new(), ..place.clone() };
        let Matrices { damping, stiffness, .. } = self.at(&place)?;
        let by_state =
            |i: usize| (0..n).map(|j| (stiffness[i * n + j] * place.q[j]).abs() + (damping[i * n + j] * place.rates[j]).abs()).sum::<f64>();
        let mut terms: Vec<f64> = (0..n).map(by_state).collect();
        let all: Vec<usize> = (0..self.parameters.len()).collect();
        let prepared = self.forces_by(&all)?;
        // a parameter at the end of its domain has no derivative and no part in this
        let Ok(values) = self.values(&prepared, &place) else { return Ok(terms) };
        for (p, row) in values[n..].chunks(n.max(1)).take(all.len()).enumerate() {
            terms.iter_mut().zip(row).for_each(|(t, d)| *t += (d * self.values[p]).abs());
        }
        Ok(terms)
    }
}

/// A solution of a square system with rows and columns of unlike units; of redundant rows one is as good as another. None where they contradict.
fn scaled_solution(a: &[f64], right: &[f64], n: usize) -> Option<Vec<f64>> {
    let largest = |i: usize, step: usize, from: &[f64]| (0..n).fold(0.0_f64, |m, j| m.max(from[i + j * step].abs()));
    let unit = |v: f64| if v > 0.0 { v.recip() } else { 1.0 };
    let mut scaled = a.to_vec();
    let (mut rows, mut columns) = (vec![1.0; n], vec![1.0; n]);
    // a few rounds bring both to size one
    for _ in 0..8 {
        for i in 0..n {
            let f = unit(largest(i * n, 1, &scaled).sqrt());
            rows[i] *= f;
            scaled[i * n..(i + 1) * n].iter_mut().for_each(|v| *v *= f);
        }
        for j in 0..n {
            let f = unit(largest(j, n, &scaled).sqrt());
            columns[j] *= f;
            (0..n).for_each(|i| scaled[i * n + j] *= f);
        }
    }
    let b: Vec<f64> = right.iter().zip(&rows).map(|(v, f)| v * f).collect();
    let (x, residual) = qr::Qr::alike(&scaled, n, n, qr::DEPENDENT).least_squares(&b);
    let size = b.iter().chain(&x).fold(0.0_f64, |m, v| m.max(v.abs()));
    // an acceleration that is rounding only would couple motions that are free of each other
    let largest = x.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let x: Vec<f64> = x.iter().map(|v| if v.abs() <= SOLVED * largest { 0.0 } else { *v }).collect();
    // rows that contradict each other leave a residual of the size of the right side
    (residual <= 1e-9 * size).then(|| x.iter().zip(&columns).map(|(v, f)| v * f).collect())
}

/// S092.
fn undetermined(q: &[f64]) -> Fault {
    let at = q.iter().map(|v| words::digits::number(*v)).fold((String::new(), String::new()), |(en, ru), v| {
        let gap = if en.is_empty() { "" } else { "; " };
        (format!("{en}{gap}{}", v.en), format!("{ru}{gap}{}", v.ru))
    });
    let why = (
        format!("no accelerations and reactions satisfy the equations there (q = {})", at.0),
        format!("никакие ускорения и реакции не удовлетворяют там уравнениям (q = {})", at.1),
    );
    crate::fault::small::refused(Text::new(why.0, why.1))
}
