//! Checks of the steps in all lanes: the energy ledger and the defect inside of steps, as [`crate::audits`] describe them, but never milder.
//!
//! The work over a step is that of Gauss's rule with twelve points on the polynomials; T and Π are values at its end. The scales are those of the instant
//! and not of the whole motion, and powers of changing sign count for what is left of them. So a lane whose check holds would hold by the scalar one; the motion of one that does not is done again
//! by the scalar path, and judged there.

use crate::audits::frontier::FLOOR;
use algebra::simd::{Lanes, Simd, Work, dispatch};
use algebra::sum::two_sum;
use program::ensemble::{LANES, Values};

/// Rounding of a rate, relative to the largest of its state so far, as in [`crate::audits::defect`].
const ROUNDING: f64 = 1e-13;

/// What the checks of all lanes know.
#[derive(Clone, Debug, Default)]
pub(super) struct Checks {
    potential: Lanes,
    /// T and Π at the end of the last step, by its modes.
    last: [Lanes; 2],
    /// E - E(0) - W so far, high and low part.
    open: [Lanes; 2],
    passed: Lanes,
    /// Largest T, |Π - Π(0)|, and terms of both.
    sizes: [Lanes; 3],
    ledger: Lanes,
    /// Largest size and rate of each state.
    states: Vec<[Lanes; 2]>,
    /// For each state the first of those with its unit.
    alike: Vec<usize>,
    defect: Lanes,
}

impl Checks {
    pub(super) fn new(units: &[&str]) -> Checks {
        Checks {
            states: vec![[[0.0; LANES]; 2]; units.len()],
            alike: units.iter().enumerate().map(|(i, unit)| units.iter().position(|u| u == unit).unwrap_or(i)).collect(),
            ..Checks::default()
        }
    }

    /// A motion begins in a lane.
    pub(super) fn begin(&mut self, lane: usize, values: &Values) {
        let [kinetic, potential] = [0, 1].map(|i| values.level(i)[lane]);
        self.potential[lane] = potential;
        (self.last[0][lane], self.last[1][lane]) = (kinetic, potential);
        self.sizes[0][lane] = kinetic.abs();
        self.sizes[2][lane] = kinetic.abs() + potential.abs();
        let zeros = [&mut self.passed, &mut self.sizes[1], &mut self.ledger, &mut self.defect];
        zeros.into_iter().chain(&mut self.open).for_each(|lanes| lanes[lane] = 0.0);
        self.states.iter_mut().flatten().for_each(|lanes| lanes[lane] = 0.0);
    }

    /// Other laws take over in a lane while the state stands: the change of energy is work of what switches.
    pub(super) fn switch(&mut self, lane: usize, values: &Values) {
        let mut switched = 0.0;
        for i in 0..2 {
            switched += values.level(i)[lane] - self.last[i][lane];
            self.last[i][lane] = values.level(i)[lane];
        }
        self.passed[lane] += switched.abs();
    }

    /// Books a step: values at its end, and the work of loads, drives and dissipation.
    pub(super) fn book(&mut self, end: &Values, works: &[Lanes; 3]) {
        let levels = [*end.level(0), *end.level(1)];
        dispatch(Booking { checks: self, levels: &levels, works });
    }

    /// Compares slopes of the polynomials with the rates at a point inside of the steps.
    pub(super) fn compare(&mut self, at: &Inside<'_>) {
        dispatch(Comparison { checks: self, at });
    }

    /// Largest shares of the energy and of the states; not a number where one has no value.
    pub(super) fn found(&self, lane: usize) -> [f64; 2] {
        [self.ledger[lane], self.defect[lane]]
    }
}

struct Booking<'a> {
    checks: &'a mut Checks,
    levels: &'a [Lanes; 2],
    works: &'a [Lanes; 3],
}

impl Work for Booking<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Booking { checks, levels, works: [loads, drives, dissipated] } = self;
        for lane in 0..LANES {
            let [kinetic, potential] = [levels[0][lane], levels[1][lane]];
            let change = (kinetic - checks.last[0][lane]) + (potential - checks.last[1][lane]);
            (checks.last[0][lane], checks.last[1][lane]) = (kinetic, potential);
            let net = loads[lane] + drives[lane] - dissipated[lane];
            checks.passed[lane] += loads[lane].abs() + drives[lane].abs() + dissipated[lane].abs();
            let (high, low) = two_sum(checks.open[0][lane], change - net);
            checks.open[0][lane] = high;
            checks.open[1][lane] += low;
            checks.sizes[0][lane] = checks.sizes[0][lane].max(kinetic.abs());
            checks.sizes[1][lane] = checks.sizes[1][lane].max((potential - checks.potential[lane]).abs());
            checks.sizes[2][lane] = checks.sizes[2][lane].max(kinetic.abs() + potential.abs());
            let scale = checks.sizes[0][lane].max(checks.sizes[1][lane]).max(checks.passed[lane]).max(FLOOR * checks.sizes[2][lane]);
            checks.ledger[lane] = worse(checks.ledger[lane], (checks.open[0][lane] + checks.open[1][lane]).abs(), scale);
        }
    }
}

/// A point inside of the steps: the equations there, and what the polynomials say.
pub(super) struct Inside<'a> {
    pub(super) values: &'a Values,
    pub(super) states: &'a [Lanes],
    pub(super) slopes: &'a [Lanes],
    pub(super) lengths: &'a Lanes,
    pub(super) coordinates: usize,
}

struct Comparison<'a> {
    checks: &'a mut Checks,
    at: &'a Inside<'a>,
}

impl Work for Comparison<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let (checks, Inside { values, states, slopes, lengths, coordinates: n }) = (self.checks, self.at);
        for (i, known) in checks.states.iter_mut().enumerate() {
            let rates = values.rate(i);
            for lane in 0..LANES {
                known[0][lane] = known[0][lane].max(states[i][lane].abs());
                known[1][lane] = known[1][lane].max(rates[lane].abs());
            }
        }
        for i in 0..checks.states.len() {
            let (rates, [sizes, largest]) = (values.rate(i), &checks.states[i]);
            for lane in 0..LANES {
                let (h, size, rate) = (lengths[lane], sizes[lane], largest[lane]);
                let off = (h * (slopes[i][lane] - rates[lane]).abs() - ROUNDING * (h * rate + size)).max(0.0);
                // a rate that moves its coordinate by less than rounding within the step is none
                let unseen = if (*n..2 * n).contains(&i) { checks.states[i - n][0][lane] / h } else { 0.0 };
                let alike = checks.states[checks.alike[i]][0][lane];
                let scale = size.max(h * rate).max(FLOOR * unseen.max(alike));
                // the maximum above forgets what is no number
                let off = if slopes[i][lane].is_nan() || rates[lane].is_nan() { f64::NAN } else { off };
                checks.defect[lane] = worse(checks.defect[lane], off, scale);
            }
        }
    }
}

/// The larger share, nothing of nothing being nothing; what is no number stays.
#[inline(always)]
fn worse(known: f64, off: f64, scale: f64) -> f64 {
    let share = if off == 0.0 { 0.0 } else { off / scale };
    if known.is_nan() || share.is_nan() {
        f64::NAN
    } else if share > known {
        share
    } else {
        known
    }
}
