//! Least, greatest and mean values of a motion between two instants.
//!
//! The dense output is cut at the instants: of the step in which one lies the part inside counts, its polynomial about that instant. What is found there is what
//! [`super::extremes`] finds of a whole motion: integrals of the polynomials, extremes where their slopes pass zero. The steps of the motion stay as they are, and no more
//! than a handful of numbers is kept of a window, however many steps lie in it.

use words::Text;
use words::digits::number;

use super::Along;
use super::extremes::{Extremes, Sought};
use crate::dataset::{Extreme, Overall, Windowed};
use crate::integrate::Step;
use crate::{Fault, Quantity, System};
use algebra::sum::Instant;

/// Rounding of the sum of the lengths of steps.
const SUMMED: f64 = 1e-9;

/// An output between two instants, s.
#[derive(Clone, Debug, PartialEq)]
pub struct Window {
    /// Name of the output.
    pub output: String,
    /// From, to.
    pub between: [f64; 2],
    /// What is wanted of it.
    pub sought: Sought,
}

/// Instants with the outputs between them.
type Chosen = ([f64; 2], Vec<(usize, Sought)>);

/// All outputs between the same instants.
#[derive(Clone, Debug)]
struct Part {
    between: [f64; 2],
    columns: Vec<Quantity>,
    extremes: Extremes,
    outputs: Vec<usize>,
}

/// Collects what is wanted between instants.
#[derive(Clone, Debug, Default)]
pub struct Windows {
    parts: Vec<Part>,
}

impl Windows {
    /// For these windows of a run up to `until`.
    ///
    /// *Errors*: an output that does not exist; a window that is empty, or not inside the run.
    pub fn new<S: System + ?Sized>(system: &S, windows: &[Window], (until, tolerance): (f64, f64)) -> Result<Windows, Fault> {
        let mut chosen: Vec<Chosen> = Vec::new();
        for window in windows {
            let outputs = system.outputs();
            let output = outputs.iter().position(|q| q.name == window.output).ok_or_else(|| {
                let known: Vec<String> = outputs.iter().map(|q| q.name.clone()).collect();
                Fault::unknown_output(&window.output, &known)
            })?;
            let [from, to] = window.between;
            if !(from >= 0.0 && from < to && to <= until) {
                return Err(outside(window.between, until));
            }
            match chosen.iter_mut().find(|(between, _)| *between == window.between) {
                Some((_, list)) => match list.iter_mut().find(|(known, _)| *known == output) {
                    Some((_, sought)) => *sought = window.sought.max(*sought),
                    None => list.push((output, window.sought)),
                },
                None => chosen.push((window.between, vec![(output, window.sought)])),
            }
        }
        let part = |(between, list): Chosen| {
            let outputs: Vec<usize> = list.iter().map(|(i, _)| *i).collect();
            Part {
                between,
                columns: outputs.iter().map(|i| system.outputs()[*i].clone()).collect(),
                extremes: Extremes::new(system, &outputs, tolerance).seeking(list.iter().map(|(_, sought)| *sought)),
                outputs,
            }
        };
        Ok(Windows { parts: chosen.into_iter().map(part).collect() })
    }

    /// The outputs that are looked at.
    pub fn outputs(&self) -> impl Iterator<Item = usize> + '_ {
        self.parts.iter().flat_map(|part| part.outputs.iter().copied())
    }

    /// Looks at a step, up to where the motion ends in it.
    pub(crate) fn look<S: System + ?Sized>(&mut self, step: &Step, system: &mut S, length: f64) {
        for part in &mut self.parts {
            let [from, to] = part.between.map(|t| step.start.until(t));
            if from >= length || to <= 0.0 {
                continue;
            }
            if from <= 0.0 && to >= length {
                part.extremes.look(&mut Along::new(step, system, length));
            } else {
                part.extremes.look(&mut Along::part(step, system, [from.max(0.0), to.min(length)]));
            }
        }
    }

    /// Whether a window reaches into a step.
    pub(crate) fn reach_into(&self, start: Instant, length: f64) -> bool {
        self.parts.iter().any(|part| start.until(part.between[0]) < length && start.until(part.between[1]) > 0.0)
    }

    /// Outputs that could not be followed everywhere.
    pub fn lost(&self) -> Vec<usize> {
        self.parts.iter().flat_map(|part| part.extremes.lost().into_iter().map(|j| part.outputs[j])).collect()
    }

    /// What was found. Of a window in which the motion ends there is nothing.
    pub fn found(&self) -> Vec<Windowed> {
        let one = |part: &Part| {
            let [from, to] = part.between;
            let overall: Vec<Overall> = part.extremes.overall();
            let whole = overall.first().is_some_and(|o| (o.span - (to - from)).abs() <= SUMMED * (to - from));
            let extremes: Vec<Extreme> = if whole { part.extremes.found() } else { Vec::new() };
            // what is nowhere left out is as long as the window, whatever the sum of the lengths
            let overall = overall.into_iter().filter(|_| whole).map(|o| Overall { span: to - from, ..o }).collect();
            Windowed { between: part.between, columns: part.columns.clone(), extremes, overall }
        };
        self.parts.iter().map(one).collect()
    }
}

fn outside([from, to]: [f64; 2], until: f64) -> Fault {
    let (a, b, end) = (number(from), number(to), number(until));
    Fault::option(
        Text::new(
            format!("the window from {} s to {} s is not inside the run, 0 ... {} s", a.en, b.en, end.en),
            format!("окно от {} с до {} с не лежит внутри расчёта, 0 ... {} с", a.ru, b.ru, end.ru),
        ),
        Text::new(
            "change the window or `until`; the first instant is the earlier one",
            "измените окно или `until`; первый момент — более ранний",
        ),
    )
}
