//! Section points of a motion: its state where a formula passes zero, or once a period of the loads.
//!
//! A motion that repeats gives one point, one that repeats after n returns n points; two frequencies without a common measure fill a curve; a chaotic
//! motion gives a set with structure at every scale. The instants at which a formula passes zero are located to rounding, by the events of the motion
//! itself; those of a period are exact multiples of it.
//! *Source*: H. Poincaré, Les méthodes nouvelles de la mécanique céleste, vol. 3, ch. 27; F. C. Moon, Chaotic Vibrations, Wiley 1987, ch. 2.

use crate::dataset::{Column, Dataset};
use crate::marks::endless::endless;
use crate::marks::named::Named;
use crate::studies::simulate::{Grid, Outcome, Simulate, simulate};
use crate::{Fault, System};
use words::{Message, Text};

/// The first run looks at this share of the longest motion; each further one is twice as long.
const SHARE: f64 = 1.0 / 16.0;
/// A multiple of the period that is missed by this share of it is met: rounding of the quotient.
const MET: f64 = 1e-9;

/// Where a motion is looked at.
#[derive(Clone, Debug)]
pub enum Section {
    /// Where an output passes zero.
    Passing(Named),
    /// At the multiples of a period, s.
    Every(f64),
}

/// Options of the study.
pub struct Poincare<'a> {
    /// Where the motion is looked at.
    pub section: Section,
    /// What comes before this time is left out, s.
    pub settle: f64,
    /// How many points are wanted; all up to the end when absent.
    pub points: Option<usize>,
    /// The motion; it ends at `until` at the latest.
    pub motion: Simulate<'a>,
}

/// The points: a row each, with the time in the first column.
///
/// *Shapes*: a column for the time and one for each output of the motion. *Units*: SI.
/// *Errors* stand beside the points so far: those of the motion, and S117 where the motion has fewer points than are wanted.
pub fn poincare<S: System + ?Sized>(system: &mut S, start: &[f64], mut options: Poincare<'_>) -> Outcome {
    let mut outcome = match options.section.clone() {
        Section::Every(period) => stroboscope(system, start, period, &mut options),
        Section::Passing(named) => crossings(system, start, &named, &mut options),
    };
    let found = outcome.dataset.columns.first().map_or(0, |c| c.values.len());
    if let Some(wanted) = options.points.filter(|n| *n > found && outcome.fault.is_none()) {
        outcome.dataset.partial = true;
        outcome.fault = Some(too_few((found, wanted), options.motion.until, limit(&outcome.dataset, &options)));
    }
    points_alone(&mut outcome.dataset);
    outcome
}

/// The state at k T, k = k₀, k₀ + 1, ..., where k₀ T is the first that is not before `settle`.
fn stroboscope<S: System + ?Sized>(system: &mut S, start: &[f64], period: f64, options: &mut Poincare<'_>) -> Outcome {
    let first = (options.settle / period - MET).ceil();
    let last = (options.motion.until / period + MET).floor();
    let most = (last - first + 1.0).max(0.0);
    let count = options.points.map_or(most, |n| most.min(n as f64));
    let times: Vec<f64> = (0..count as usize).map(|k| (first + k as f64) * period).collect();
    let end = times.last().copied().unwrap_or(0.0);
    let mut outcome = run(system, start, (end, Grid::At(times.clone())), options);
    // a motion that ends before has its end for the last row
    let data = &mut outcome.dataset;
    let kept: Vec<bool> =
        data.columns.get(data.axis.unwrap_or(0)).map_or(Vec::new(), |t| t.values.iter().map(|t| times.contains(t)).collect());
    for column in &mut data.columns {
        let mut keep = kept.iter();
        column.values.retain(|_| keep.next().is_none_or(|k| *k));
    }
    outcome
}

/// The state at each passage, in runs that grow until there are enough.
fn crossings<S: System + ?Sized>(system: &mut S, start: &[f64], named: &Named, options: &mut Poincare<'_>) -> Outcome {
    let longest = options.motion.until;
    let mut end = if options.points.is_some() { (longest * SHARE).max(options.settle).min(longest) } else { longest };
    loop {
        let mut outcome = run(system, start, (end, Grid::At(vec![0.0])), options);
        let passages = collect(&mut outcome.dataset, named, options);
        let enough = options.points.is_some_and(|n| passages >= n);
        if enough || end >= longest || outcome.fault.is_some() || outcome.dataset.partial {
            return outcome;
        }
        end = (2.0 * end).min(longest);
    }
}

fn run<S: System + ?Sized>(system: &mut S, start: &[f64], (until, grid): (f64, Grid), options: &mut Poincare<'_>) -> Outcome {
    let motion = &mut options.motion;
    let mut events = motion.events.clone();
    if let Section::Passing(named) = &options.section
        && !events.contains(named)
    {
        events.push(named.clone());
    }
    let asked = Simulate {
        grid,
        events,
        tolerance: motion.tolerance,
        outputs: motion.outputs.clone(),
        pushes: motion.pushes.clone(),
        interrupt: motion.interrupt,
        method: motion.method,
        progress: motion.progress.as_mut().map(|p| &mut **p as &mut dyn FnMut(f64)),
        ..Simulate::until(until)
    };
    simulate(system, start, asked)
}

/// Puts the passages in the place of the rows; how many there are.
fn collect(data: &mut Dataset, named: &Named, options: &Poincare<'_>) -> usize {
    let passed = data.events.iter().filter(|e| e.name == named.name && e.t >= options.settle);
    let passed: Vec<_> = passed.take(options.points.unwrap_or(usize::MAX)).collect();
    let axis = data.axis.unwrap_or(0);
    let mut others = 0..;
    let values: Vec<Vec<f64>> = (0..data.columns.len())
        .map(|i| match (i == axis, &passed) {
            (true, list) => list.iter().map(|e| e.t).collect(),
            (false, list) => {
                let j = others.next().unwrap_or(0);
                list.iter().map(|e| e.outputs[1].get(j).copied().unwrap_or(f64::NAN)).collect()
            }
        })
        .collect();
    let count = passed.len();
    data.columns.iter_mut().zip(values).for_each(|(column, values): (&mut Column, _)| column.values = values);
    count
}

/// What a motion says of the whole of it is not said of its section.
fn points_alone(data: &mut Dataset) {
    data.extremes.clear();
    data.overall.clear();
    data.digits = None;
    data.events.clear();
}

/// The instant before which the motion passes its section infinitely often, where it does.
fn limit(data: &Dataset, options: &Poincare<'_>) -> Option<f64> {
    let Section::Passing(named) = &options.section else { return None };
    endless(&data.events, &|event| event.name == named.name).filter(|t| *t >= options.settle)
}

fn too_few((found, wanted): (usize, usize), until: f64, limit: Option<f64>) -> Fault {
    let t = words::digits::rounded(until);
    let why = match limit.map(words::digits::number) {
        Some(n) => Text::new(
            format!(
                "the motion passes the section infinitely often before t = {} s, nearer than rounding to one another, and comes to rest",
                n.en
            ),
            format!(
                "движение проходит сечение бесконечно много раз до t = {} с, через промежутки меньше погрешности округления, и прекращается",
                n.ru
            ),
        ),
        None => Text::new("the motion passes the section more rarely, or comes to rest", "движение проходит сечение реже или прекращается"),
    };
    Fault::new(Message {
        code: "S117",
        what: Text::new(
            format!("the motion has {found} section points up to t = {} s; {wanted} are wanted", t.en),
            format!("до t = {} с у движения точек сечения: {found}; нужно {wanted}", t.ru),
        ),
        why,
        help: Text::new("take a larger `until`, or another section", "увеличьте `until` или выберите другое сечение"),
    })
}
