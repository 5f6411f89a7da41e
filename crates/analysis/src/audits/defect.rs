//! Defect of the dense output inside the steps: x' of the polynomials against the equations, evaluated by the interpreter.
//!
//! The points are none of the integrator's own: step number n is looked at the fraction of n times the golden section, which fills the unit interval
//! evenly. The defect is multiplied by the length of the step and compared with what the state changes within it, and with the tolerance that the
//! integrator keeps at the end of a step; x' multiplies the truncation of a polynomial by at most its order.

use symbolic::Text;

use crate::System;
use crate::dataset::Audit;
use crate::taylor::Step;

/// Fraction between neighbouring points.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Rounding of a rate, relative to the largest of its state so far.
const ROUNDING: f64 = 1e-13;

/// Collects the largest defect along a motion.
#[derive(Clone, Debug, Default)]
pub struct InteriorDefect {
    worst: f64,
    steps: u64,
    known: bool,
    x: Vec<f64>,
    slopes: Vec<f64>,
    rates: Vec<f64>,
    /// Largest size and largest rate of each state so far.
    sizes: Vec<[f64; 2]>,
}

impl InteriorDefect {
    /// For a system with this many states.
    pub fn new(n_states: usize) -> InteriorDefect {
        let zeros = vec![0.0; n_states];
        InteriorDefect {
            known: true,
            x: zeros.clone(),
            slopes: zeros.clone(),
            rates: zeros,
            sizes: vec![[0.0; 2]; n_states],
            ..InteriorDefect::default()
        }
    }

    /// Looks at one point of a step.
    pub fn look<S: System + ?Sized>(&mut self, step: &Step, system: &mut S) {
        self.steps += 1;
        let t = step.start.after((self.steps as f64 * GOLDEN).fract() * step.length).high;
        step.state_at(t, &mut self.x);
        step.rate_at(t, &mut self.slopes);
        if !self.known || !system.rates(t, &self.x, &step.modes, &mut self.rates) {
            self.known = false;
            return;
        }
        for i in 0..self.x.len() {
            let [size, rate] = &mut self.sizes[i];
            *size = size.max(self.x[i].abs());
            *rate = rate.max(self.rates[i].abs());
            let off = (step.length * (self.slopes[i] - self.rates[i]).abs() - ROUNDING * (step.length * *rate + *size)).max(0.0);
            let scale = size.max(step.length * *rate);
            if scale > 0.0 {
                self.worst = self.worst.max(off / scale);
            }
        }
    }

    /// The audit, or none when the system cannot be evaluated.
    pub fn audit(&self, tolerance: f64) -> Option<Audit> {
        let name = Text::new(
            "defect x' - f inside the steps: largest relative to the state",
            "невязка x' - f внутри шагов: наибольшая относительно состояния",
        );
        (self.known && self.steps > 0).then(|| Audit::at_most("interior_defect", name, self.worst, (1e3 * tolerance).max(1e-9)))
    }
}
