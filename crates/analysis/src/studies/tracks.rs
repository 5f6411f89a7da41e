//! Modes followed along a parameter: which mode is which is decided by likeness of shapes, so that curves may cross.
//!
//! Between two values the likeness of shapes x, y is |xᴴ M y|² / (xᴴ M x · yᴴ M y) (modal assurance); every mode takes the free successor
//! that is most like it, and where that is not plain, or frequencies pass each other, values between are looked at (`successors`):
//! which mode is which does not depend on the number of values. Over a speed this is Campbell's diagram, whose crossings with the lines ω = k Ω are critical speeds; k is 1 and the
//! multiples of the speed at which the loads act. A frequency is |λ|, a frequency with damping |Im λ|; the lines are those of the latter.

mod told;

pub use told::{Critical, Tracks};

use crate::fault::codes::{NO_INERTIA, NO_REST};
use crate::linear::{LinearMachine, Place};
use crate::rest::search::no_equilibrium;
use crate::studies::modes::{self, Kind, Mode, Normalisation};
use crate::studies::response::{Forced, Source};
use crate::studies::rest::branch::{Branch, Change};
use crate::studies::rest::changes;
use crate::studies::successors::{Found, Line};
use crate::{Fault, Quantity};
use algebra::arrange::Arrange;
use told::{ONE_PLACE, dataset, runs_along, without_rest};
use words::Text;

/// Follows the modes over equidistant values of a parameter, about the place of rest that is followed along it.
///
/// *Errors*: no equilibrium at a value, a mass matrix that is not positive.
pub fn tracks(machine: &mut LinearMachine, branch: &mut Branch, ends: [f64; 2], points: usize) -> Result<Tracks, Fault> {
    let parameter = branch.parameter();
    let home = branch.home_place().clone();
    let quantity = machine.parameters()[parameter].clone();
    let is_speed = quantity.unit == "rad/s" || quantity.unit == "1/s";
    let largest = if ends[0].abs() > ends[1].abs() { ends[0] } else { ends[1] };
    let orders = if is_speed { orders(machine, parameter, largest, &home)? } else { Vec::new() };
    branch.cover(machine, ends)?;
    let coordinates = machine.coordinates().to_vec();
    let mut run =
        Run { machine, branch, place: home, along: Vec::new(), cells: 0, without: Vec::new(), barred: Vec::new(), why: None, freedom: 0 };
    let mut out = Tracks { parameter: quantity.name.clone(), orders, ..Tracks::default() };
    let mut slots: Vec<Vec<Option<Mode>>> = Vec::new();
    let mut line = Line::new(ends[1] - ends[0]);
    let (mut anchors, mut grows, mut diverges): (Vec<Line>, Vec<bool>, Vec<bool>) = Default::default();
    for k in 0..points {
        let value = ends[0] + (ends[1] - ends[0]) * k as f64 / (points - 1).max(1) as f64;
        out.values.push(value);
        let Some((list, mass)) = run.known(value)? else {
            out.freedom.push(0);
            // nothing is known here: the tracks go on behind it
            anchors.push(line.clone());
            grows.push(grows.last().copied().unwrap_or(false));
            diverges.push(false);
            slots.push(Vec::new());
            out.known.push(false);
            out.places.push(None);
            continue;
        };
        out.known.push(true);
        out.freedom.push(run.freedom);
        out.places.push((!run.without.contains(&value)).then(|| run.place.q.clone()));
        grows.push(growing(&list));
        diverges.push(list.iter().any(|m| m.kind == Kind::Divergence));
        let list = list.into_iter().filter(worth_following).collect();
        let here = line.follow(value, (list, mass), &mut |value| run.followed(value))?;
        slots.push(here);
        anchors.push(line.clone());
    }
    run.refuse_nothing(&out)?;
    let count = line.modes().len();
    let order = number(&mut slots, count);
    anchors.iter_mut().for_each(|anchor| anchor.reorder(&order));
    let track = |pick: fn(&Mode) -> f64| -> Vec<Vec<f64>> {
        let at = |here: &Vec<Option<Mode>>, j: usize| here.get(j).and_then(Option::as_ref).map_or(f64::NAN, pick);
        (0..count).map(|j| slots.iter().map(|here| at(here, j)).collect()).collect()
    };
    (out.omega, out.damped, out.ratio) = (track(|m| m.omega), track(|m| m.damped), track(|m| m.ratio));
    out.unstable = run.unstable(&out.values, &grows)?;
    out.unstable_from = out.unstable.first().map(|r| r[0]);
    out.critical = run.critical(&out, &anchors)?;
    out.data = dataset(&out, &quantity, &diverges);
    out.changes = run.branch.changes();
    changes::add_columns(&mut out.data, &out.places, &coordinates);
    out.data.notes.extend(changes::notes(run.branch, &quantity, &coordinates));
    out.data.notes.extend(runs_along(&run.along));
    out.data.notes.extend(run.missing(&quantity, &out));
    out.data.notes.extend(run.without_modes(&quantity, &out));
    out.data.notes.extend(line.note(&quantity));
    out.data.notes.extend(run.unlocated());
    Ok(out)
}

/// Numbers the tracks by the first value at which they differ: frequencies that are equal at the first value (forward and backward whirl at
/// rest) part in the order of the modes there.
fn number(slots: &mut [Vec<Option<Mode>>], tracks: usize) -> Vec<usize> {
    let at = |here: &[Option<Mode>], j: usize| here.get(j).and_then(Option::as_ref).map(|m| m.omega);
    let order = |a: usize, b: usize| {
        for here in slots.iter() {
            match (at(here, a), at(here, b)) {
                // frequencies that are one at this value are told apart at another
                (Some(x), Some(y)) if (x - y).abs() > 1e-9 * x.max(y) => return x.total_cmp(&y),
                (Some(_), None) => return std::cmp::Ordering::Less,
                (None, Some(_)) => return std::cmp::Ordering::Greater,
                _ => {}
            }
        }
        a.cmp(&b)
    };
    let mut list: Vec<usize> = (0..tracks).collect();
    list.arrange_by(|a, b| order(*a, *b));
    for here in slots {
        *here = list.iter().map(|j| here.get(*j).cloned().flatten()).collect();
    }
    list
}

/// Orders that are followed at most.
const ORDERS: usize = 6;

/// Multiples of a speed at which the loads act, and 1: the lowest ones.
fn orders(machine: &mut LinearMachine, parameter: usize, at: f64, place: &Place) -> Result<Vec<f64>, Fault> {
    let (own, angular) = (machine.value(parameter), machine.parameters()[parameter].unit == "rad/s");
    machine.set(parameter, at)?;
    // loads that do not follow the speed, or none, leave the first order alone
    let found = Forced::new(machine, (place, &[]), Source::OfEquations, Some(parameter), &[]);
    let per = |f: &Forced| f.own_frequency().map(|w| w / at.abs()).filter(|w| w.is_finite() && *w > 0.0);
    let list = found.map(|f| per(&f).map(|axis| f.components().iter().map(|c| c.order * axis).collect::<Vec<f64>>()));
    machine.set(parameter, own)?;
    let mut list = list.ok().flatten().unwrap_or_default();
    if angular || list.is_empty() {
        list.push(1.0);
    }
    list.sort_by(f64::total_cmp);
    // nine digits: one order told twice
    list.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * b.abs());
    list.truncate(ORDERS);
    Ok(list)
}

/// Growth below this share of a root is the rounding of the matrices' entries.
const ROUNDING: f64 = 1e-13;

/// Whether a motion grows, beyond rounding.
fn growing(list: &[Mode]) -> bool {
    list.iter().any(|m| m.root.0 > ROUNDING * (m.omega + m.root.0))
}

fn worth_following(mode: &Mode) -> bool {
    mode.kind == Kind::Oscillation || mode.kind == Kind::RigidBody
}

/// Which end of a range of growth is sought.
#[derive(Clone, Copy, PartialEq)]
enum Growth {
    Begins,
    Ends,
}

struct Run<'m> {
    machine: &'m mut LinearMachine,
    branch: &'m mut Branch,
    /// The last place.
    place: Place,
    /// Ranges of the speed in which a mode runs along a line ω = order·Ω.
    along: Vec<[f64; 2]>,
    /// Values at which there was none.
    without: Vec<f64>,
    /// Values at which there are no modes, and why the first has none.
    barred: Vec<f64>,
    why: Option<Fault>,
    /// Cells halved so far.
    cells: usize,
    /// Motions that are left at the last value.
    freedom: usize,
}

impl Run<'_> {
    /// The same; none where there is no equilibrium and the matrices depend on the place.
    fn known(&mut self, value: f64) -> Result<Option<Found>, Fault> {
        match self.modes(value) {
            Err(fault) if fault.code == NO_REST => Ok(None),
            Err(fault) if fault.code == NO_INERTIA => {
                self.barred.push(value);
                self.why.get_or_insert(fault);
                Ok(None)
            }
            found => found.map(Some),
        }
    }

    /// Those that are followed along the parameter.
    fn followed(&mut self, value: f64) -> Result<Option<Found>, Fault> {
        Ok(self.known(value)?.map(|(list, mass)| (list.into_iter().filter(worth_following).collect(), mass)))
    }

    /// The place of rest at a value. Where there is none, as at a value at which det K = 0 and the equilibrium runs away, the last place serves for a machine
    /// whose matrices are the same everywhere.
    fn settle(&mut self, value: f64) -> Result<(), Fault> {
        match self.branch.place(self.machine, value)? {
            Some(place) => self.place = place,
            None => {
                self.without.push(value);
                if !self.machine.same_everywhere() {
                    return Err(no_equilibrium());
                }
            }
        }
        Ok(())
    }

    /// Where there is no equilibrium: neighbouring values are one range unless one with a place of rest lies between them.
    fn missing(&self, parameter: &Quantity, tracks: &Tracks) -> Vec<Text> {
        let mut list = self.without.clone();
        list.sort_by(f64::total_cmp);
        let rests: Vec<f64> = tracks.values.iter().zip(&tracks.places).filter(|(_, p)| p.is_some()).map(|(v, _)| *v).collect();
        let lost: Vec<f64> = tracks.values.iter().zip(&tracks.places).filter(|(_, p)| p.is_none()).map(|(v, _)| *v).collect();
        let inside = |of: &[f64], a: f64, b: f64| of.iter().any(|v| (a..=b).contains(v));
        let one = |a: f64, b: f64| (b - a).abs() <= ONE_PLACE * a.abs().max(b.abs()) || (!inside(&rests, a, b) && inside(&lost, a, b));
        let groups = list.chunk_by(|a, b| one(*a, *b));
        let roots = if self.machine.same_everywhere() {
            ("the modes do not depend on it", "собственные движения от него не зависят")
        } else {
            (
                "there are no modes about it, and ends of ranges there are not located",
                "собственных движений около него нет, и концы областей там не найдены",
            )
        };
        groups.map(|group| without_rest(group, parameter, roots)).collect()
    }

    /// That critical speeds are missing.
    fn unlocated(&self) -> Option<Text> {
        (self.cells > CELLS).then(|| {
            Text::new(
                "critical speeds are not all located: modes begin and cease to oscillate at random within rounding (a double root, an inertia that is all but zero)",
                "критические скорости найдены не все: формы начинают и перестают колебаться случайно, в пределах округления (кратный корень, почти нулевая инерция)",
            )
        })
    }

    /// *Errors*: why there are no modes, where no value of the table has some.
    fn refuse_nothing(&mut self, tracks: &Tracks) -> Result<(), Fault> {
        match self.why.take_if(|_| !tracks.known.contains(&true)) {
            Some(why) => Err(why),
            None => Ok(()),
        }
    }

    /// Values of the table without modes.
    fn without_modes(&self, parameter: &Quantity, tracks: &Tracks) -> Option<Text> {
        let why = &self.why.as_ref()?.message.what;
        let rows = tracks.values.iter().filter(|v| self.barred.contains(v)).map(|v| changes::written(*v, parameter));
        let (en, ru): (Vec<String>, Vec<String>) = rows.map(|v| (v.en, v.ru)).unzip();
        let name = &parameter.name;
        (!en.is_empty()).then(|| {
            Text::new(
                format!("no modes at {name} = {}: {} [{NO_INERTIA}]", en.join(", "), why.en),
                format!("при {name} = {} собственных движений нет: {} [{NO_INERTIA}]", ru.join("; "), why.ru),
            )
        })
    }

    /// The modes at a value of the parameter, and M.
    fn modes(&mut self, value: f64) -> Result<Found, Fault> {
        self.settle(value)?;
        let matrices = self.machine.at(&self.place)?;
        self.freedom = matrices.allowed().map_or(matrices.n, |(_, k)| k);
        let names = self.machine.coordinates().to_vec();
        let found = modes::modes(&matrices, &names, Normalisation::Largest)?;
        Ok((found.modes, matrices.mass))
    }

    /// Ranges in which a motion grows; their ends by bisection between neighbouring values.
    fn unstable(&mut self, values: &[f64], grows: &[bool]) -> Result<Vec<[f64; 2]>, Fault> {
        let mut ranges: Vec<[f64; 2]> = Vec::new();
        for (k, here) in grows.iter().enumerate() {
            let before = k > 0 && grows[k - 1];
            match (before, *here) {
                (false, true) => {
                    let start = if k == 0 { values[0] } else { self.threshold([values[k - 1], values[k]], Growth::Begins)? };
                    ranges.push([start, values[values.len() - 1]]);
                }
                (true, false) => {
                    let end = self.threshold([values[k - 1], values[k]], Growth::Ends)?;
                    ranges.iter_mut().rev().take(1).for_each(|r| r[1] = end);
                }
                _ => {}
            }
        }
        Ok(ranges)
    }

    /// The end of a range of growth, to rounding: the sign of Re λ decides where it is sure on the quiet side, an amount beyond rounding where
    /// oscillations there neither grow nor decay.
    fn threshold(&mut self, [mut a, mut b]: [f64; 2], growth: Growth) -> Result<f64, Fault> {
        let at_a = growth == Growth::Ends;
        let Some((quiet, _)) = self.known(if at_a { b } else { a })? else { return Ok(0.5 * (a + b)) };
        let sure = quiet.iter().all(|m| m.kind == Kind::RigidBody || m.root.0 < 0.0);
        let growing = |list: &[Mode]| if sure { list.iter().any(Mode::grows) } else { growing(list) };
        for _ in 0..100 {
            let middle = 0.5 * (a + b);
            if (b - a).abs() <= 4.0 * f64::EPSILON * a.abs().max(b.abs()) || middle == a || middle == b {
                break;
            }
            let Some((list, _)) = self.known(middle)? else { break };
            if growing(&list) == at_a { a = middle } else { b = middle }
        }
        Ok(0.5 * (a + b))
    }

    /// How many modes oscillate above the line ω = order·Ω, at Ω: only a crossing with the line changes it, because a mode begins and ceases to
    /// oscillate at ω = 0.
    fn above(&mut self, speed: f64, order: f64) -> Result<Option<Count>, Fault> {
        let Some((list, _)) = self.known(speed)? else { return Ok(None) };
        // a speed below zero excites with its amount
        let line = order * speed.abs();
        let oscillating: Vec<f64> = list.iter().filter(|m| worth_following(m) && m.damped > 0.0).map(|m| m.damped).collect();
        let above = oscillating.iter().filter(|w| **w > line).count();
        let nearest = oscillating.iter().map(|w| (w - line).abs()).fold(f64::INFINITY, f64::min);
        Ok(Some(Count { above, nearest }))
    }

    /// Crossings with the lines ω = order·Ω: between values where the number of modes above the line changes, and where a mode comes so near to
    /// the line between them that it may cross it twice.
    fn critical(&mut self, tracks: &Tracks, anchors: &[Line]) -> Result<Vec<Critical>, Fault> {
        let mut out = Vec::new();
        for order in &tracks.orders {
            let mut places = Vec::new();
            let counts = tracks.values.iter().map(|v| self.above(*v, *order)).collect::<Result<Vec<Option<Count>>, Fault>>()?;
            let ends = [tracks.values[0], tracks.values[tracks.values.len() - 1]];
            for k in 1..tracks.values.len() {
                let cell = Cell { order: *order, depth: DEEPEST };
                let (a, b) = (tracks.values[k - 1], tracks.values[k]);
                if a < 0.0 && b > 0.0 {
                    // the line is bent at zero
                    let still = self.above(0.0, *order)?;
                    self.cell([a, 0.0], [counts[k - 1], still], cell, &mut places)?;
                    self.cell([0.0, b], [still, counts[k]], cell, &mut places)?;
                } else {
                    self.cell([a, b], [counts[k - 1], counts[k]], cell, &mut places)?;
                }
            }
            // a frequency that vanishes with the speed meets the line there without being excited
            places.retain(|v| v.abs() > STANDS * ends[0].abs().max(ends[1].abs()) && !self.leaps(*v, *order));
            places.sort_by(f64::total_cmp);
            // one place between two steps, found from both
            places.dedup_by(|a, b| (*a - *b).abs() <= 1e-12 * b.abs());
            for value in places {
                out.push(Critical { mode: self.which(value, *order, (tracks, anchors))?, value, order: *order });
            }
        }
        Ok(out)
    }

    /// Whether a frequency leaps over the line where the place changes, and meets it nowhere.
    fn leaps(&mut self, speed: f64, order: f64) -> bool {
        let changes = self.branch.changes();
        // the change is located as closely
        let there = |c: &Change| (c.value - speed).abs() <= 1e-9 * speed.abs();
        // met means six digits: a leap misses by a share of itself
        let met = |count: Count| count.nearest <= 1e-6 * order * speed.abs();
        changes.iter().any(there) && !self.above(speed, order).ok().flatten().is_some_and(met)
    }

    /// The track that meets the line ω = order·Ω at a speed: the modes are followed there from the neighbouring value.
    fn which(&mut self, speed: f64, order: f64, (tracks, anchors): (&Tracks, &[Line])) -> Result<usize, Fault> {
        let Some(found) = self.followed(speed)? else { return Ok(0) };
        let near = |a: &usize, b: &usize| (tracks.values[*a] - speed).abs().total_cmp(&(tracks.values[*b] - speed).abs());
        let k = (0..tracks.values.len()).min_by(near).unwrap_or(0);
        let here = anchors[k].clone().follow(speed, found, &mut |value| self.followed(value))?;
        let off =
            |m: &Option<Mode>| m.as_ref().filter(|m| m.damped > 0.0).map_or(f64::INFINITY, |m| (m.damped - order * speed.abs()).abs());
        Ok((0..here.len()).min_by(|a, b| off(&here[*a]).total_cmp(&off(&here[*b]))).unwrap_or(0))
    }

    /// The crossings in a cell: halved while its ends differ by more than one crossing, or a mode is nearer to the line than the cell is wide.
    ///
    /// A mode that runs along the line meets it nowhere by itself: rounding alone decides on which side it is, and there is nothing to locate.
    fn cell(&mut self, [a, b]: [f64; 2], ends: [Option<Count>; 2], cell: Cell, found: &mut Vec<f64>) -> Result<(), Fault> {
        let Cell { order, depth } = cell;
        // beside a value without an equilibrium nothing is counted
        let [Some(at_a), Some(at_b)] = ends else { return Ok(()) };
        let changes = at_a.above.abs_diff(at_b.above);
        let near = at_a.nearest.min(at_b.nearest) <= 2.0 * order * (b - a);
        let middle = 0.5 * (a + b);
        let last = (b - a).abs() <= 4.0 * f64::EPSILON * a.abs().max(b.abs()) || middle <= a || middle >= b;
        if last {
            if changes > 0 {
                found.push(middle);
            }
            return Ok(());
        }
        if changes == 0 && (!near || depth == 0) {
            return Ok(());
        }
        self.cells += 1;
        if self.cells > CELLS {
            return Ok(());
        }
        let at_middle = self.above(middle, order)?;
        let along = |count: &Count, speed: f64| count.nearest <= ALONG * order * speed.abs();
        if (b - a).abs() > APART * middle.abs() && along(&at_a, a) && at_middle.is_some_and(|m| along(&m, middle)) && along(&at_b, b) {
            self.along.push([a, b]);
            return Ok(());
        }
        let cell = Cell { order, depth: if changes == 0 { depth - 1 } else { depth } };
        self.cell([a, middle], [Some(at_a), at_middle], cell, found)?;
        self.cell([middle, b], [at_middle, Some(at_b)], cell, found)
    }
}

/// How many modes oscillate above the line, and how near the nearest of all is to it.
#[derive(Clone, Copy)]
struct Count {
    above: usize,
    nearest: f64,
}

/// Which line is looked at, and how often a cell without a sign of crossing may still be halved.
#[derive(Clone, Copy)]
struct Cell {
    order: f64,
    depth: usize,
}

/// Halvings of a cell in which a mode comes near to the line without a sign of crossing.
const DEEPEST: usize = 6;
/// Share of its frequency by which a mode may leave the line ω = order·Ω along which it runs: frequencies carry eleven digits and more.
const ALONG: f64 = 1e-10;
/// Share of a speed over which a mode that leaves the line by less than [`ALONG`] runs along it: a crossing leaves it by as much as this.
const APART: f64 = 1e-6;
/// Share of the largest speed that is none.
const STANDS: f64 = 1e-12;
/// Cells that are halved at most; a hundred critical speeds need six thousand.
const CELLS: usize = 20_000;
