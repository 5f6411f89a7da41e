//! Defect of the dense output inside the steps: x' of the polynomials against the equations, evaluated by the interpreter.
//!
//! The points are none of the integrator's own: step number n is looked at the fraction of n times the golden section, which fills the unit interval
//! evenly. The defect is multiplied by the length of the step and compared with what the state changes within it, and with the tolerance that the
//! integrator keeps at the end of a step; x' multiplies the truncation of a polynomial by at most its order. In an implicit step a fast mode multiplies an
//! error of the state by its own rate; there the defect d counts as the error of the state that it means, (1/h - J)^-1 d.

use words::Text;

use super::frontier::{FLOOR, Frontier};
use crate::dataset::Audit;
use crate::integrate::Step;
use crate::{Jacobian, System};
use algebra::golden::GOLDEN;
use algebra::lu::Lu;

/// Rounding of a rate, relative to the largest of its state so far.
const ROUNDING: f64 = 1e-13;
/// Share of the limit from which on the terms of a rate are looked at: what is less is no finding, with its rounding or without.
const SUSPECT: f64 = 0.1;

/// Where the inside of a step is looked at, as a share of its length: multiples of the golden section, since those of no other number fill the steps more evenly.
pub(crate) fn looked_at(step: u64) -> f64 {
    (step as f64 * GOLDEN).fract()
}

/// Collects the largest defect along a motion.
#[derive(Clone, Debug, Default)]
pub struct InteriorDefect {
    /// By state.
    found: Vec<Frontier>,
    steps: u64,
    known: bool,
    /// Defects, relative to their scale, from which on the terms of a rate are looked at.
    suspect: f64,
    x: Vec<f64>,
    slopes: Vec<f64>,
    rates: Vec<f64>,
    /// Largest size and largest rate of each state so far.
    sizes: Vec<[f64; 2]>,
    /// For each state the first of those with its unit.
    alike: Vec<usize>,
}

impl InteriorDefect {
    /// For a system with this many states.
    pub fn new(n_states: usize, tolerance: f64) -> InteriorDefect {
        let zeros = vec![0.0; n_states];
        InteriorDefect {
            known: true,
            suspect: SUSPECT * super::limit(tolerance),
            found: vec![Frontier::default(); n_states],
            x: zeros.clone(),
            slopes: zeros.clone(),
            rates: zeros,
            sizes: vec![[0.0; 2]; n_states],
            ..InteriorDefect::default()
        }
    }

    /// What an ensemble has found over so many steps.
    pub(crate) fn settle(&mut self, worst: f64, steps: u64) {
        self.found = vec![Frontier::default()];
        self.found[0].note(worst, 1.0);
        self.steps = steps;
    }

    /// Looks at one point of a step.
    pub fn look<S: System + ?Sized>(&mut self, step: &Step, system: &mut S) {
        self.steps += 1;
        let t = step.instant(step.beside_change_point(looked_at(self.steps) * step.length)).high;
        step.motion_after(step.start.until(t), &mut self.x, &mut self.slopes);
        if !self.known || !system.rates(t, &self.x, &step.modes, &mut self.rates) {
            self.known = false;
            return;
        }
        let n = system.n_coordinates();
        let meant = if step.implicit { self.meant(t, step, system) } else { None };
        let mut roundings = None;
        for i in 0..self.x.len() {
            let [size, rate] = self.sizes[i];
            let [size, rate] = [size.max(self.x[i].abs()), rate.max(self.rates[i].abs())];
            self.sizes[i] = [size, rate];
            let off = step.length * (self.slopes[i] - self.rates[i]).abs();
            let off = (meant.as_ref().map_or(off, |meant| meant[i].abs().min(off)) - ROUNDING * (step.length * rate + size)).max(0.0);
            let scale = size.max(step.length * rate);
            // a rate that moves its coordinate by less than rounding within the step is none; a force that is left of larger ones has their rounding
            let unseen = if (n..2 * n).contains(&i) { self.sizes[i - n][0] / step.length } else { 0.0 };
            let off = if off > self.suspect * scale {
                let roundings = roundings.get_or_insert_with(|| self.roundings(t, step, system));
                (off - step.length * roundings[i]).max(0.0)
            } else {
                off
            };
            self.found[i].note(off, scale.max(FLOOR * unseen));
        }
        self.compare_alike(system);
    }

    /// The error of the states that the defect means; none without a Jacobian, or where its matrix is singular.
    fn meant<S: System + ?Sized>(&self, t: f64, step: &Step, system: &mut S) -> Option<Vec<f64>> {
        let width = self.x.len();
        let mut matrix = vec![0.0; width * width];
        let Ok(Jacobian::Given) = system.jacobian(t, &self.x, &step.modes, &mut matrix) else { return None };
        matrix.iter_mut().enumerate().for_each(|(k, v)| *v = if k / width == k % width { 1.0 } else { 0.0 } - step.length * *v);
        let defect: Vec<f64> = self.slopes.iter().zip(&self.rates).map(|(s, r)| step.length * (s - r)).collect();
        Lu::new(&matrix, width).solve(&defect)
    }

    /// Σ |∂x'_i/∂x_j x_j|: how large the terms are that meet in each rate.
    fn terms<S: System + ?Sized>(&self, t: f64, step: &Step, system: &mut S) -> Vec<f64> {
        let width = self.x.len();
        let mut jacobian = vec![0.0; width * width];
        match system.jacobian(t, &self.x, &step.modes, &mut jacobian) {
            Ok(Jacobian::Given) => jacobian.chunks(width).map(|row| row.iter().zip(&self.x).map(|(d, x)| (d * x).abs()).sum()).collect(),
            _ => vec![0.0; width],
        }
    }

    /// What rounding can make of each rate: of the terms by states, and of all loads that meet in an acceleration.
    fn roundings<S: System + ?Sized>(&self, t: f64, step: &Step, system: &mut S) -> Vec<f64> {
        let mut terms = self.terms(t, step, system);
        terms.iter_mut().for_each(|term| *term *= ROUNDING);
        let n = system.n_coordinates();
        let loads = system.rounding_of_accelerations(t, &self.x, &step.modes);
        for (term, load) in terms[n..].iter_mut().zip(loads.iter().take(n)) {
            *term = if load.is_finite() { load.max(*term) } else { *term };
        }
        terms
    }

    /// States of one kind are known to the rounding of the largest of them: the far end of a chain moves by what is left of the rest.
    fn compare_alike<S: System + ?Sized>(&mut self, system: &S) {
        if self.alike.is_empty() {
            let units: Vec<&str> = system.states().iter().map(|q| q.unit.as_str()).collect();
            self.alike = units.iter().enumerate().map(|(i, unit)| units.iter().position(|u| u == unit).unwrap_or(i)).collect();
        }
        let mut largest = vec![0.0_f64; self.alike.len()];
        self.alike.iter().zip(&self.sizes).for_each(|(first, [size, _])| largest[*first] = largest[*first].max(*size));
        self.found.iter_mut().zip(&self.alike).for_each(|(found, first)| found.whole(largest[*first]));
    }

    /// The audit, or none when the system cannot be evaluated.
    pub fn audit(&self, tolerance: f64) -> Option<Audit> {
        let name = Text::new(
            "defect x' − f inside the steps: largest relative to the state",
            "невязка x' − f внутри шагов: наибольшая относительно состояния",
        );
        let worst = self
            .found
            .iter()
            .map(Frontier::worst)
            .fold(0.0_f64, |a: f64, b: f64| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) });
        (self.known && self.steps > 0).then(|| Audit::at_most("interior_defect", name, worst, super::limit(tolerance)))
    }
}
