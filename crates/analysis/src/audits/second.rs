//! Two derivations: accelerations from Lagrange's equations must satisfy the projected Newton-Euler equations.
//!
//! At random states q'' is solved from M q'' = h and put into the second derivation's residuals r(q'') = A q'' - b, which are linear in q''. A and b
//! are read off by evaluating r at zero and at unit vectors, so that each residual is compared with the terms that had to cancel in it:
//!
//! ```text
//! value = max over states and rows of |r_i(q'')| / max(|b_i| + sum_j |A_ij q''_j|, 1e-4 of the largest row, 1e-4 of sum_j |A_ij| w_j, 1e-4 of the
//!         largest of these sums, the terms of the balance with its reactions)
//! ```
//!
//! with w_j the largest of q'_j/s and of the accelerations of the same unit. These serve machines whose reactions vanish: with the inertial cranks of a linkage
//! turning uniformly and its bars without mass, q'' = 0 stands before each moment of inertia and all forces are rounding of the bars' accelerations.

use algebra::elementary;
use words::Text;

use crate::dataset::Audit;
use crate::{Mode, System};
use algebra::random::Random;

/// Rounding in a few thousand operations reaches 1e-13; a forgotten or doubled term is seen at 1e-3 and more.
const LIMIT: f64 = 1e-10;
/// Share of the largest row below which a row's own terms are rounding of the reactions in it.
const SMALL: f64 = 1e-4;
const STATES: usize = 12;
const TRIES: usize = 200;

/// The audit, or none when there is no second derivation or no regular state was found. Times are drawn from [0, end], states at the scale of `start`.
pub fn two_derivations<S: System + ?Sized>(system: &mut S, start: &[f64], end: f64, seed: u64) -> Option<Audit> {
    let mut random = Random::new(seed);
    let mut worst: f64 = 0.0;
    let mut done = 0;
    for _ in 0..TRIES {
        let mut sample = Sample::draw(system, start, end, &mut random);
        if let Some(value) = sample.difference(system) {
            worst = worst.max(value);
            done += 1;
        }
        if done == STATES {
            break;
        }
    }
    let name = Text::new(
        "two derivations (Lagrange, Newton-Euler): largest relative difference",
        "два вывода (Лагранж, Ньютон-Эйлер): наибольшее относительное расхождение",
    );
    (done > 0).then(|| Audit::at_most("two_derivations", name, worst, LIMIT))
}

struct Sample {
    t: f64,
    x: Vec<f64>,
    modes: Vec<Mode>,
}

impl Sample {
    /// Angles anywhere on the circle. Everything else of either sign, of magnitude 0.01 ... 1 in SI or, where the machine starts with a
    /// non-zero value, 0.01 ... 1 of ten times that value: large and small terms meet, and a machine of millimetres or of kilometres is
    /// tried at its own size. Rates without a start value stay at 0.01 ... 1; the residuals are relative, so their unit does not matter.
    fn draw<S: System + ?Sized>(system: &S, start: &[f64], end: f64, random: &mut Random) -> Sample {
        let t = random.between(0.0, end);
        let x = system.states().iter().zip(start).map(|(q, start)| {
            let unit = random.between(-1.0, 1.0);
            let size = if *start != 0.0 && start.is_finite() { 10.0 * start.abs() } else { 1.0 };
            if q.unit == "rad" { unit * std::f64::consts::PI } else { unit * size * elementary::pow(10.0_f64, random.between(-2.0, 0.0)) }
        });
        let x = x.collect();
        Sample { t, x, modes: Vec::new() }
    }

    /// None at a singular or undefined state.
    fn difference<S: System + ?Sized>(&mut self, system: &mut S) -> Option<f64> {
        self.modes = system.modes_by_value(self.t, &self.x)?;
        let n = system.n_coordinates();
        system.expand(self.t, &self.x, &self.modes, 1).ok()?;
        let accelerations: Vec<f64> = (n..2 * n).map(|i| system.state(i)[1]).collect();
        let residual = self.residuals(system, &accelerations)?;
        let mut trial = vec![0.0; n];
        let constant = self.residuals(system, &trial)?;
        let mut scale: Vec<f64> = constant.iter().map(|b| b.abs()).collect();
        let mut inertia = vec![0.0; n];
        let units: Vec<String> = system.states()[..n].iter().map(|q| q.unit.clone()).collect();
        let typical = |unit: &str| accelerations.iter().zip(&units).filter(|(_, u)| *u == unit).fold(0.0_f64, |m, (a, _)| m.max(a.abs()));
        for j in 0..n {
            // the unit of q''_j does not matter: its own value, or that of q'_j, serves as the unit vector's length
            let (acceleration, rate) = (accelerations[j].abs(), self.x[n + j].abs());
            let length = acceleration.max(rate);
            if length == 0.0 {
                continue;
            }
            trial.fill(0.0);
            trial[j] = length;
            let column = self.residuals(system, &trial)?;
            let size = rate.max(typical(&units[j]));
            for i in 0..n {
                let share = (column[i] - constant[i]).abs() / length;
                scale[i] += share * acceleration;
                inertia[i] += share * size;
            }
        }
        // b is what reactions leave of the loads: rounding follows the terms, not the rest
        let rows = system.balances(self.t, &self.x, &accelerations, &self.modes).unwrap_or_default();
        scale.iter_mut().zip(&rows).for_each(|(s, row)| *s = s.max(row[1]));
        // where reactions meet without inertia (a massless link) nothing is left to compare with: the size of the other rows then
        let largest = scale.iter().chain(&inertia).copied().fold(0.0, f64::max);
        let ratio = |((r, s), i): ((&f64, &f64), &f64)| if *r == 0.0 { 0.0 } else { r.abs() / s.max(SMALL * largest).max(SMALL * i) };
        let worst = residual.iter().zip(&scale).zip(&inertia).map(ratio).fold(0.0, f64::max);
        worst.is_finite().then_some(worst)
    }

    fn residuals<S: System + ?Sized>(&self, system: &mut S, accelerations: &[f64]) -> Option<Vec<f64>> {
        let mut residuals = vec![0.0; accelerations.len()];
        let known = system.second((self.t, &self.x), accelerations, &self.modes, &mut residuals);
        (known && residuals.iter().all(|r| r.is_finite())).then_some(residuals)
    }
}
