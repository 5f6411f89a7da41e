//! Motion from given initial values.

mod abreast;
mod blows;
mod bridge;
mod options;
mod rivals;
mod rows;
mod run;
mod trail;
mod watching;

use crate::System;
use crate::audits::{digits, halving::tolerance_halving, second::two_derivations};
use crate::dataset::Dataset;
use crate::integrate::taylor::order_for;
use run::Run;
use words::Text;
use words::limits::TOLERANCES;

pub use abreast::{Made, Wanted, abreast, fits};
pub(super) use options::{EVENTS, check, choose, requested, untraced};
pub use options::{Grid, Kept, Outcome, Simulate, parts};

/// Runs the machine from the state `start` at t = 0.
///
/// A requested time that is the instant of an event shows the values after it; the event itself records both sides.
///
/// *Errors* come beside the results so far: options without meaning, a table larger than the limit, and every fault of [`crate::integrate::taylor::Flow`].
pub fn simulate<S: System + ?Sized>(system: &mut S, start: &[f64], mut options: Simulate<'_>) -> Outcome {
    let mut run = match Run::prepare(system, &options) {
        Ok(run) => run,
        Err(fault) => return Outcome { dataset: Dataset { partial: true, ..Dataset::default() }, fault: Some(fault) },
    };
    let fault = run.integrate(system, start, &mut options).err();
    let mut dataset = run.dataset(system, options.tolerance);
    dataset.partial |= fault.is_some();
    dataset.audits.splice(0..0, two_derivations(system, start, options.until, options.seed));
    if options.check && !dataset.partial {
        confirm(system, start, &mut options, &mut dataset);
    }
    if options.tolerance_halving && !dataset.partial {
        match halved(system, start, &mut options) {
            Some(finer) if !finer.dataset.partial => {
                dataset.audits.push(tolerance_halving(&dataset.columns, &finer.dataset.columns, options.tolerance));
            }
            _ => dataset
                .notes
                .push(Text::new("the run with half the tolerance was not finished", "расчёт с половинной точностью не закончен")),
        }
    }
    Outcome { dataset, fault }
}

/// The same run with half the tolerance (twice at the lower end).
fn halved<S: System + ?Sized>(system: &mut S, start: &[f64], options: &mut Simulate<'_>) -> Option<Outcome> {
    let half = 0.5 * options.tolerance;
    let (tolerance, order) = (if half < *TOLERANCES.start() { 2.0 * options.tolerance } else { half }, options.order);
    repeated(system, start, options, (tolerance, order))
}

/// Computes a finished motion once more, by a tenth of the tolerance where there is room below it and by an order that a run does not take by itself, and
/// notes which digits hold. Costs about as much as the motion.
pub fn confirm<S: System + ?Sized>(system: &mut S, start: &[f64], options: &mut Simulate<'_>, dataset: &mut Dataset) {
    let tolerance = (0.1 * options.tolerance).max(*TOLERANCES.start());
    // orders of runs are two apart
    let order = order_for(tolerance) + 3;
    match repeated(system, start, options, (tolerance, Some(order))) {
        Some(again) if !again.dataset.partial => {
            let found = digits::compare(dataset, &again.dataset, tolerance, order);
            dataset.notes.extend(digits::note(&found, dataset));
            dataset.notes.extend(digits::note_of_events(dataset, &again.dataset));
            dataset.digits = Some(found);
        }
        _ => dataset.notes.push(Text::new(
            "the repetition that shows which digits hold was not finished",
            "повторный расчёт для проверки верных цифр не закончен",
        )),
    }
}

fn repeated<S: System + ?Sized>(
    system: &mut S,
    start: &[f64],
    options: &mut Simulate<'_>,
    (tolerance, order): (f64, Option<usize>),
) -> Option<Outcome> {
    let mut again = Simulate {
        grid: options.grid.clone(),
        outputs: options.outputs.clone(),
        events: options.events.clone(),
        pushes: options.pushes.clone(),
        tolerance,
        order,
        interrupt: options.interrupt,
        memory: options.memory,
        method: options.method,
        kept: Kept::Numbers,
        most_steps: options.most_steps,
        progress: options.progress.as_mut().map(|p| &mut **p as &mut dyn FnMut(f64)),
        ..Simulate::until(options.until)
    };
    let mut run = Run::prepare(system, &again).ok()?;
    run.rounding = Some(vec![0.0; run.chosen.len()]);
    let fault = run.integrate(system, start, &mut again).err();
    let mut dataset = run.dataset(system, tolerance);
    dataset.partial |= fault.is_some();
    Some(Outcome { dataset, fault })
}
