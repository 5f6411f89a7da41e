//! The places of a map: the repeated study at each of them, on threads, kept and taken up again.

use super::classes::{Classes, Judge};
use crate::machine::Machine;
use crate::provenance;
use crate::repeat::abreast::{self, Pace};
use crate::repeat::course::Course;
use crate::repeat::gathered::{Gathered, Row};
use crate::repeat::journal::{self, Head};
use crate::repeat::many::{self, Shared};
use crate::repeat::stated::stated;
use crate::repeat::{At, Repeated};
use crate::stability::plane::Plane;
use crate::watch::Watch;
use analysis::studies::map::{Class, Grid, Place};
use analysis::studies::stability::Verdict;
use mechanics::asked::Asked;
use mechanics::model::SweepRange;
use serde_json::json;
use words::{Notice, Text};

/// Places that a thread takes at once.
const BLOCK: usize = 4;
/// The same of motions in lanes: a turn of all of them.
const IN_LANES: usize = 8;

/// Why a map ends early.
#[derive(Debug)]
pub(super) enum Stop {
    Interrupted,
    Trouble(Notice),
}

/// Places as they are computed.
pub(super) struct Places<'a, 'w> {
    pub(super) ranges: &'a [SweepRange; 2],
    pub(super) repeated: &'a Repeated,
    pub(super) classes: Classes,
    /// Rows in the order of the places.
    pub(super) rows: Vec<Row>,
    /// The diagram that has the verdicts of all places, where there is one.
    pub(super) diagram: Option<Plane>,
    start: At,
    course: Course,
    /// Coarse cells along a side.
    cells: u32,
    watch: &'a mut Watch<'w>,
}

impl<'a, 'w> Places<'a, 'w> {
    pub(super) fn new(
        machine: &Machine,
        (ranges, repeated): (&'a [SweepRange; 2], &'a Repeated),
        (asked, grid, judge, diagram): (&Asked, Grid, Judge, Option<Plane>),
        watch: &'a mut Watch<'w>,
    ) -> Result<Places<'a, 'w>, Notice> {
        let gathered = Gathered::new(machine, ranges, &repeated.noted);
        let same = json!([stated(asked), stated(&repeated.base), grid.cells, grid.refine, format!("{:016x}", grid.accuracy.to_bits())]);
        let same = format!("strutt {} model {} map {:016x}", provenance::VERSION, machine.model_hash, journal::checksum(&same.to_string()));
        let most = usize::try_from(grid.places()).unwrap_or(usize::MAX);
        // how many places there will be nobody knows: more than ten times the lattice there are not
        let head = Head::new(same, [most.saturating_mul(10), 1], journal::WHOLE, (gathered.own, &gathered.columns));
        let start = At::given(machine, &values(ranges, [0.0, 0.0]));
        let course = Course::begin(watch, &head)?;
        Ok(Places { ranges, repeated, classes: Classes::new(judge), rows: Vec::new(), diagram, start, course, cells: grid.cells, watch })
    }

    /// How often the file was read again.
    pub(super) fn anew(&self) -> usize {
        self.start.anew + self.rows.iter().map(|row| row.anew).sum::<usize>()
    }

    /// The classes of places; of the first places also the groups of values that part them.
    pub(super) fn find(&mut self, places: &[Place]) -> Result<Vec<Class>, Stop> {
        let first = self.rows.len();
        if let Some(diagram) = &self.diagram {
            let fresh = of_diagram(diagram, self.ranges, (places, if first == 0 { self.cells } else { 0 }));
            self.rows.extend(fresh);
            return Ok(self.rows[first..].iter().map(|row| self.classes.of(row)).collect());
        }
        let (ranges, repeated) = (self.ranges, self.repeated);
        let of_place = |row: usize| values(ranges, places[row - first]);
        let pace = abreast::pace(&self.start, repeated);
        let block = if pace == Pace::InLanes { IN_LANES } else { BLOCK };
        let shared = Shared { threads: self.watch.threads.max(1), block, interrupt: self.watch.interrupt, spread: self.watch.spread };
        let run = |at: &mut At, rows: std::ops::Range<usize>| match pace {
            Pace::InLanes => abreast::rows(at, repeated, (&of_place, rows), shared.interrupt),
            _ => many::one_by_one(at, rows, shared.interrupt, &|at, row| Row::of(at, repeated, of_place(row), shared.interrupt)),
        };
        let end = first + places.len();
        while self.rows.len() < end {
            let from = self.rows.len();
            let batch = from..(from + self.course.left().max(shared.batch())).min(end);
            let asked = batch.len();
            let start = &self.start;
            let found = self.course.rows(self.watch, batch, &|rows| many::rows(start, rows, shared, &run)).map_err(Stop::Trouble)?;
            let short = found.len() < asked;
            for (row, place) in found.iter().zip(&places[from - first..]) {
                if row.values != values(ranges, *place) {
                    return Err(Stop::Trouble(journal::foreign()));
                }
            }
            self.rows.extend(found);
            if short {
                return Err(Stop::Interrupted);
            }
            if let Some(progress) = &mut self.watch.progress {
                progress(done(self.rows.len(), self.cells));
            }
        }
        if first == 0 && self.classes.judge == Judge::Gaps {
            self.classes.group(&self.rows, self.cells);
        }
        Ok(self.rows[first..].iter().map(|row| self.classes.of(row)).collect())
    }
}

/// The verdicts of places by a diagram; of those of a whole lattice of so many cells along a side, row by row, together.
fn of_diagram(diagram: &Plane, ranges: &[SweepRange; 2], (places, cells): (&[Place], u32)) -> Vec<Row> {
    let side = cells as usize + 1;
    let of_place = |place: Place| [0, 1].map(|k| value(&ranges[k], place[k]));
    let traces: Vec<[f64; 2]> = if cells > 0 && places.len() == side * side {
        let xs: Vec<f64> = places[..side].iter().map(|place| of_place(*place)[0]).collect();
        let ys: Vec<f64> = places.iter().step_by(side).map(|place| of_place(*place)[1]).collect();
        let all = diagram.diagram.traces(&xs, &ys);
        (0..side * side).map(|k| all[k % side * side + k / side]).collect()
    } else {
        places.iter().map(|place| of_place(*place)).map(|[x, y]| diagram.diagram.trace(x, y)).collect()
    };
    let row = |(place, trace): (&Place, [f64; 2])| {
        let stable = match Verdict::of_trace(trace) {
            Verdict::Stable => Some(true),
            Verdict::Unstable => Some(false),
            Verdict::Limit => None,
        };
        Row {
            values: values(ranges, *place),
            numbers: Ok(Vec::new()),
            audit: None,
            stands: None,
            anew: 0,
            regime: None,
            stable,
            resonance: None,
            other: false,
        }
    };
    places.iter().zip(traces).map(row).collect()
}

/// The share that is done: half of it is the coarse places; how many boundaries take besides nobody knows, the rest shrinks as they go on.
fn done(places: usize, cells: u32) -> f64 {
    let coarse = f64::from(cells + 1) * f64::from(cells + 1);
    let ratio = places as f64 / coarse;
    if ratio < 1.0 { 0.5 * ratio } else { 1.0 - 0.5 / ratio }
}

/// The values at shares of the ranges.
pub(super) fn values(ranges: &[SweepRange; 2], place: Place) -> Vec<(String, f64)> {
    ranges.iter().zip(place).map(|(range, share)| (range.name.clone(), value(range, share))).collect()
}

/// The value at a share of a range.
pub(super) fn value(range: &SweepRange, share: f64) -> f64 {
    let [from, to] = ends(range);
    if share >= 1.0 { to } else { from + (to - from) * share }
}

/// Both ends of a range.
pub(super) fn ends(range: &SweepRange) -> [f64; 2] {
    [range.values.first().copied().unwrap_or_default(), range.values.last().copied().unwrap_or_default()]
}

/// The remark on a map that was interrupted.
pub(super) fn interrupted(places: usize) -> Text {
    Text::new(
        format!("interrupted after {places} places: there is no map yet; --resume goes on"),
        format!("прервано; вычислено точек: {places}. Карты ещё нет; продолжить можно ключом --resume"),
    )
}
