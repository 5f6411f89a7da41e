//! When the implicit method takes a step instead of the Taylor series, and how it does.
//!
//! A Taylor step is as long as the fastest mode allows, even when that mode has died out: h lambda is about 10 at most. The motion is *stiff* where its smooth
//! rest would allow far longer steps. That is found by trial, never by the size of an eigenvalue: a fast mode that carries energy is resolved by both methods and an
//! implicit step over it is refused by its own control. A trial is made
//!
//! - after [`FIRST`] Taylor steps since the last event, when the states at every fourth step lie on a smooth curve (the last one is met by the cubic
//!   through the four before), then after twice as many, and so on;
//! - smooth or not (rounding may be all that is left of a motion) after [`FORCED`] steps, then after four times as many.
//!
//! So a machine that is not stiff pays for a handful of trials, and one that is never takes more than a bounded number of Taylor steps before it is
//! recognised. A trial step is [`WORTH`] Taylor steps long or more; where the accepted steps become shorter than half of that, the Taylor series
//! takes over again, and at each event it takes the first steps, because the modes are decided by derivatives.

use super::options::Options;
use crate::Fault;
use crate::integrate::stiff::{Collocation, Method};
use algebra::sum::Instant;

/// Taylor steps before the first trial on a smooth motion.
const FIRST: u64 = 24;
/// Taylor steps before the first trial on any motion, with one state; more states make a trial dearer.
const FORCED: u64 = 256;
/// Taylor steps that an implicit step of a small system costs, and what each state adds.
const WORTH: f64 = 12.0;
const WORTH_OF_STATE: f64 = 0.5;
/// Steps between samples of the motion.
const APART: u64 = 4;
/// Share of a state's change within the samples by which it may miss the cubic.
const SMOOTH: f64 = 0.05;
/// Share of its size below which a change is rounding.
const STILL: f64 = 1e-12;

/// The implicit method of a flow, and when to use it.
#[derive(Clone, Debug)]
pub(super) struct Implicit {
    pub(super) method: Method,
    /// Made at the first trial.
    pub(super) engine: Option<Collocation>,
    pub(super) tolerance: f64,
    pub(super) units: Vec<String>,
    pub(super) n_guards: usize,
    /// Length of the next step while the method is in use.
    pub(super) next: Option<f64>,
    pub(super) impossible: bool,
    /// Taylor steps since the last event or implicit step.
    pub(super) taken: u64,
    /// When the next trials are due.
    pub(super) smooth_due: u64,
    pub(super) forced_due: u64,
    /// The last five samples: instant, state.
    pub(super) samples: Samples,
}

impl Implicit {
    pub(super) fn new(options: &Options, units: &[&str], n_guards: usize) -> Implicit {
        let mut implicit = Implicit {
            method: options.method,
            engine: None,
            tolerance: options.tolerance,
            units: units.iter().map(|unit| (*unit).to_owned()).collect(),
            n_guards,
            next: None,
            impossible: units.is_empty(),
            taken: 0,
            smooth_due: 0,
            forced_due: 0,
            samples: Vec::new(),
        };
        implicit.interrupt();
        implicit
    }

    /// An event, or the series has taken over: everything is to be learnt again.
    pub(super) fn interrupt(&mut self) {
        self.next = None;
        self.taken = 0;
        self.smooth_due = FIRST;
        self.forced_due = FORCED * (16 + self.units.len() as u64) / 16;
        self.samples.clear();
        if let Some(engine) = &mut self.engine {
            engine.forget();
        }
    }

    /// Taylor steps that an implicit one must replace.
    pub(super) fn worth(&self) -> f64 {
        WORTH + WORTH_OF_STATE * self.units.len() as f64
    }

    /// The length of an implicit step to be tried, when a Taylor step has the length `taylor`.
    pub(super) fn proposal(&mut self, taylor: f64, limit: f64, deflation: &[usize]) -> Option<f64> {
        let leaves_surface = deflation.iter().any(|k| *k > 0);
        if self.method == Method::Taylor || self.impossible || leaves_surface || !(taylor > 0.0 && taylor < limit) {
            return None;
        }
        let least = self.least(taylor);
        match (self.method, self.next) {
            (_, Some(next)) if next >= least => Some(next.min(limit)),
            (Method::Stiff, _) if self.taken > 0 => Some((4.0 * taylor).min(limit)),
            (Method::Stiff, _) => None,
            (_, Some(_)) => {
                self.interrupt();
                None
            }
            (_, None) => (limit > 2.0 * least && self.is_due()).then_some(2.0 * least),
        }
    }

    /// Below this length the Taylor series is the cheaper way.
    pub(super) fn least(&self, taylor: f64) -> f64 {
        if self.method == Method::Stiff { 0.5 * taylor } else { self.worth() * taylor }
    }

    pub(super) fn is_due(&self) -> bool {
        self.taken >= self.forced_due || (self.taken >= self.smooth_due && self.is_smooth())
    }

    pub(super) fn sample(&mut self, at: Instant, x: &[f64]) {
        self.taken += 1;
        if !self.taken.is_multiple_of(APART) || self.method != Method::Auto {
            return;
        }
        note(&mut self.samples, at, x);
    }

    /// Whether the last sample is where the cubic through the four before leads.
    pub(super) fn is_smooth(&self) -> bool {
        is_smooth(&self.samples, STILL)
    }

    pub(super) fn refused(&mut self) {
        if self.next.is_some() {
            self.interrupt();
            return;
        }
        self.smooth_due = 2 * self.taken.max(FIRST);
        if self.taken >= self.forced_due {
            self.forced_due = 4 * self.taken;
        }
    }

    /// The engine, made when it is first wanted.
    pub(super) fn take_engine(&mut self) -> Result<Collocation, Fault> {
        match self.engine.take() {
            Some(engine) => Ok(engine),
            None => {
                let units: Vec<&str> = self.units.iter().map(String::as_str).collect();
                Collocation::new(self.tolerance, &units, self.n_guards)
            }
        }
    }
}

/// States at some instants of a motion.
pub(crate) type Samples = Vec<(Instant, Vec<f64>)>;

/// Takes a state among the last five.
pub(crate) fn note(samples: &mut Samples, at: Instant, x: &[f64]) {
    let mut slot = if samples.len() < 5 { (at, x.to_vec()) } else { samples.remove(0) };
    slot.0 = at;
    slot.1.copy_from_slice(x);
    samples.push(slot);
}

/// Whether the last of five samples is where the cubic through the four before leads; a change below this share of its size is none.
pub(crate) fn is_smooth(samples: &Samples, still: f64) -> bool {
    let [a, .., last] = &samples[..] else { return false };
    if samples.len() < 5 {
        return false;
    }
    let times: Vec<f64> = samples.iter().map(|s| a.0.until(s.0.high) + s.0.low).collect();
    let smooth = |k: usize| {
        let values: Vec<f64> = samples.iter().map(|s| s.1[k]).collect();
        let change = values.iter().fold(0.0, |m: f64, v| m.max((v - values[0]).abs()));
        let size = values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        (next_of_cubic(&times, &values) - last.1[k]).abs() <= SMOOTH * change + still * size
    };
    (0..last.1.len()).all(smooth)
}

/// Value at the last of five times of the cubic through the first four points.
fn next_of_cubic(times: &[f64], values: &[f64]) -> f64 {
    let [.., t] = times else { return 0.0 };
    let weight = |i: usize| (0..4).filter(|j| *j != i).map(|j| (t - times[j]) / (times[i] - times[j])).product::<f64>();
    (0..4).map(|i| values[i] * weight(i)).sum()
}
