//! Modes followed along a parameter: which mode is which is decided by likeness of shapes, so that curves may cross.
//!
//! Between two values the likeness of shapes x, y is |xᴴ M y|² / (xᴴ M x · yᴴ M y) (modal assurance); every mode takes the free successor
//! that is most like it. Over a speed this is Campbell's diagram, whose crossings with the lines ω = k Ω are critical speeds.

use symbolic::Text;

use crate::dataset::{Column, Dataset};
use crate::linear::{LinearMachine, Place};
use crate::studies::modes::{self, Kind, Mode, Normalisation};
use crate::{Fault, Quantity};

/// Modes along a parameter.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tracks {
    /// Name of the parameter.
    pub parameter: String,
    /// Its values.
    pub values: Vec<f64>,
    /// Frequency of each mode (outer) at each value, |Im λ|; NaN where the mode does not oscillate.
    pub omega: Vec<Vec<f64>>,
    /// Damping ratio of each mode at each value.
    pub ratio: Vec<Vec<f64>>,
    /// Where a frequency equals the parameter (or half, twice it), when the parameter is a speed.
    pub critical: Vec<Critical>,
    /// First value at which a motion grows, located to rounding.
    pub unstable_from: Option<f64>,
    /// Ranges of the parameter in which a motion grows, with their ends located to rounding (those of the range itself as they are).
    pub unstable: Vec<[f64; 2]>,
    /// The same as columns.
    pub data: Dataset,
}

/// A critical speed: frequency of the mode = order · speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Critical {
    /// Index of the mode.
    pub mode: usize,
    /// The speed.
    pub value: f64,
    /// Multiple of the speed that excites.
    pub order: f64,
}

/// Follows the modes over equidistant values of a parameter.
///
/// *Errors*: no equilibrium at a value, a mass matrix that is not positive.
pub fn tracks(machine: &mut LinearMachine, parameter: usize, ends: [f64; 2], points: usize, place: &Place) -> Result<Tracks, Fault> {
    let quantity = machine.parameters()[parameter].clone();
    let mut run = Run { machine, parameter, place: place.clone() };
    let n = run.machine.coordinates().len();
    let mut out = Tracks { parameter: quantity.name.clone(), omega: vec![Vec::new(); n], ratio: vec![Vec::new(); n], ..Tracks::default() };
    let mut before: Vec<Option<Mode>> = Vec::new();
    let mut grows = Vec::new();
    for k in 0..points {
        let value = ends[0] + (ends[1] - ends[0]) * k as f64 / (points - 1).max(1) as f64;
        let (list, mass) = run.modes(value)?;
        grows.push(growing(&list));
        let slots =
            if before.is_empty() { list.into_iter().filter(worth_following).map(Some).collect() } else { matched(&before, list, &mass) };
        out.values.push(value);
        for (j, (omega, ratio)) in out.omega.iter_mut().zip(&mut out.ratio).enumerate() {
            let mode = slots.get(j).and_then(Option::as_ref).filter(|m| m.kind != Kind::Divergence && m.kind != Kind::Aperiodic);
            omega.push(mode.map_or(f64::NAN, |m| m.damped));
            ratio.push(mode.map_or(f64::NAN, |m| m.ratio));
        }
        // a mode that is lost for a while keeps its last shape
        before = slots.into_iter().enumerate().map(|(j, s)| s.or_else(|| before.get(j).cloned().flatten())).collect();
    }
    out.unstable = run.unstable(&out.values, &grows)?;
    out.unstable_from = out.unstable.first().map(|r| r[0]);
    if quantity.unit == "rad/s" || quantity.unit == "1/s" {
        out.critical = run.critical(&out)?;
    }
    out.data = dataset(&out, &quantity);
    Ok(out)
}

/// Whether a motion grows, beyond rounding.
fn growing(list: &[Mode]) -> bool {
    list.iter().any(|m| m.root.0 > 1e-9 * (m.omega + m.root.0))
}

fn worth_following(mode: &Mode) -> bool {
    mode.kind == Kind::Oscillation || mode.kind == Kind::RigidBody
}

struct Run<'m> {
    machine: &'m mut LinearMachine,
    parameter: usize,
    place: Place,
}

impl Run<'_> {
    /// The modes at a value of the parameter, and M.
    fn modes(&mut self, value: f64) -> Result<(Vec<Mode>, Vec<f64>), Fault> {
        self.machine.set(self.parameter, value)?;
        self.place = self.machine.settle(&self.place.q)?;
        let matrices = self.machine.at(&self.place)?;
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
                    let start = if k == 0 { values[0] } else { self.threshold([values[k - 1], values[k]], false)? };
                    ranges.push([start, values[values.len() - 1]]);
                }
                (true, false) => {
                    let end = self.threshold([values[k - 1], values[k]], true)?;
                    ranges.iter_mut().rev().take(1).for_each(|r| r[1] = end);
                }
                _ => {}
            }
        }
        Ok(ranges)
    }

    fn threshold(&mut self, [mut a, mut b]: [f64; 2], at_a: bool) -> Result<f64, Fault> {
        for _ in 0..100 {
            let middle = 0.5 * (a + b);
            if (b - a).abs() <= 4.0 * f64::EPSILON * a.abs().max(b.abs()) || middle == a || middle == b {
                break;
            }
            if growing(&self.modes(middle)?.0) == at_a { a = middle } else { b = middle }
        }
        Ok(0.5 * (a + b))
    }

    /// How many modes oscillate below Ω, at Ω: a crossing with the line ω = Ω changes it.
    fn below(&mut self, speed: f64) -> Result<Count, Fault> {
        let (list, _) = self.modes(speed)?;
        let oscillating: Vec<f64> = list.iter().filter(|m| worth_following(m) && m.damped > 0.0).map(|m| m.damped).collect();
        let below = oscillating.iter().filter(|w| **w < speed).count();
        let nearest = oscillating.iter().map(|w| (w - speed).abs()).fold(f64::INFINITY, f64::min);
        Ok(Count { below, all: oscillating.len(), nearest })
    }

    /// Crossings with the line ω = Ω: between values where the number of modes below the line changes, and where a mode comes so near to
    /// the line between them that it may cross it twice.
    fn critical(&mut self, tracks: &Tracks) -> Result<Vec<Critical>, Fault> {
        let mut places = Vec::new();
        let counts = tracks.values.iter().map(|v| self.below(*v)).collect::<Result<Vec<Count>, Fault>>()?;
        for k in 1..tracks.values.len() {
            self.cell([tracks.values[k - 1], tracks.values[k]], [counts[k - 1], counts[k]], DEEPEST, &mut places)?;
        }
        places.sort_by(f64::total_cmp);
        places.dedup_by(|a, b| (*a - *b).abs() <= 1e-12 * b.abs());
        let mode = |value: f64| {
            let k = tracks.values.windows(2).position(|w| value <= w[1]).unwrap_or(0);
            let distance = |w: &[f64]| {
                let [a, b] = [w[k] - tracks.values[k], w[k + 1] - tracks.values[k + 1]];
                if a.is_nan() || b.is_nan() {
                    f64::INFINITY
                } else if a * b <= 0.0 {
                    0.0
                } else {
                    a.abs().min(b.abs())
                }
            };
            let best = (0..tracks.omega.len()).map(|j| (j, distance(&tracks.omega[j])));
            best.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |b| b.0)
        };
        Ok(places.into_iter().map(|value| Critical { mode: mode(value), value, order: 1.0 }).collect())
    }

    /// The crossings in a cell: halved while its ends differ by more than one crossing, or a mode is nearer to the line than the cell is wide.
    fn cell(&mut self, [a, b]: [f64; 2], [at_a, at_b]: [Count; 2], depth: usize, found: &mut Vec<f64>) -> Result<(), Fault> {
        let changes = at_a.below.abs_diff(at_b.below);
        let near = at_a.nearest.min(at_b.nearest) <= 2.0 * (b - a);
        let middle = 0.5 * (a + b);
        let last = (b - a).abs() <= 4.0 * f64::EPSILON * a.abs().max(b.abs()) || middle <= a || middle >= b;
        if last {
            // a mode that begins or ends to oscillate here crosses nothing
            if changes > 0 && at_a.all == at_b.all {
                found.push(middle);
            }
            return Ok(());
        }
        if changes == 0 && (!near || depth == 0) {
            return Ok(());
        }
        let at_middle = self.below(middle)?;
        let depth = if changes == 0 { depth - 1 } else { depth };
        self.cell([a, middle], [at_a, at_middle], depth, found)?;
        self.cell([middle, b], [at_middle, at_b], depth, found)
    }
}

/// Modes that oscillate, how many of them below the line, and how near the nearest is to it.
#[derive(Clone, Copy)]
struct Count {
    below: usize,
    all: usize,
    nearest: f64,
}

/// Halvings of a cell in which a mode comes near to the line without a sign of crossing.
const DEEPEST: usize = 6;

/// Successors in the order of their predecessors.
fn matched(before: &[Option<Mode>], list: Vec<Mode>, mass: &[f64]) -> Vec<Option<Mode>> {
    let list: Vec<Mode> = list.into_iter().filter(worth_following).collect();
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    for (i, old) in before.iter().enumerate() {
        let Some(old) = old else { continue };
        for (j, new) in list.iter().enumerate() {
            // shapes that are equally alike are told apart by frequency
            let distance = (old.damped - new.damped).abs() / (old.damped + new.damped).max(f64::MIN_POSITIVE);
            pairs.push((likeness(&old.shape, &new.shape, mass) - distance, i, j));
        }
    }
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
    let mut slots: Vec<Option<usize>> = vec![None; before.len()];
    let mut taken = vec![false; list.len()];
    for (_, i, j) in pairs {
        if slots[i].is_none() && !taken[j] {
            slots[i] = Some(j);
            taken[j] = true;
        }
    }
    let mut out: Vec<Option<Mode>> = slots.into_iter().map(|s| s.map(|j| list[j].clone())).collect();
    // modes that begin to oscillate get a track of their own
    out.extend((0..list.len()).filter(|&j| !taken[j]).map(|j| Some(list[j].clone())));
    out
}

/// |xᴴ M y|² / (xᴴ M x · yᴴ M y).
fn likeness(x: &[modes::Complex], y: &[modes::Complex], mass: &[f64]) -> f64 {
    let n = x.len();
    let product = |a: &[modes::Complex], b: &[modes::Complex]| -> (f64, f64) {
        let term = |p: usize| {
            let (u, v) = (a[p / n], b[p % n]);
            (mass[p] * (u.0 * v.0 + u.1 * v.1), mass[p] * (u.0 * v.1 - u.1 * v.0))
        };
        (0..n * n).map(term).fold((0.0, 0.0), |s, t| (s.0 + t.0, s.1 + t.1))
    };
    let (xy, xx, yy) = (product(x, y), product(x, x).0, product(y, y).0);
    if xx * yy > 0.0 { (xy.0 * xy.0 + xy.1 * xy.1) / (xx * yy) } else { 0.0 }
}

fn dataset(tracks: &Tracks, parameter: &Quantity) -> Dataset {
    let mut columns = vec![Column { quantity: parameter.clone(), values: tracks.values.clone() }];
    let used = |values: &[f64]| values.iter().any(|v| v.is_finite());
    for (j, values) in tracks.omega.iter().enumerate().filter(|(_, v)| used(v)) {
        let label = Text::new(
            format!("frequency of mode {} with damping, |Im λ|", j + 1),
            format!("частота формы {} с учётом затухания, |Im λ|", j + 1),
        );
        let quantity = Quantity { label, symbol: format!("omega_{}", j + 1), ..Quantity::new(&format!("omega_{}", j + 1), "rad/s") };
        columns.push(Column { quantity, values: values.clone() });
    }
    for (j, values) in tracks.ratio.iter().enumerate().filter(|(_, v)| v.iter().any(|r| r.is_finite() && *r != 0.0)) {
        let label = Text::new(format!("damping ratio of mode {}", j + 1), format!("относительное затухание формы {}", j + 1));
        let quantity = Quantity { label, symbol: format!("zeta_{}", j + 1), ..Quantity::new(&format!("zeta_{}", j + 1), "1") };
        columns.push(Column { quantity, values: values.clone() });
    }
    let mut notes = Vec::new();
    let last = tracks.values.last().copied().unwrap_or(f64::NAN);
    for [from, to] in &tracks.unstable {
        let [v, w] = [*from, *to].map(crate::fault::rounded);
        let unit = if parameter.unit == "1" { String::new() } else { format!(" {}", parameter.unit) };
        notes.push(if *to == last {
            Text::new(
                format!("from {} = {}{unit} on a motion grows", parameter.name, v.en),
                format!("начиная с {} = {}{unit} движение растёт", parameter.name, v.ru),
            )
        } else {
            Text::new(
                format!("between {} = {} and {}{unit} a motion grows", parameter.name, v.en, w.en),
                format!("между {} = {} и {}{unit} движение растёт", parameter.name, v.ru, w.ru),
            )
        });
    }
    Dataset { axis: Some(0), columns, notes, ..Dataset::default() }
}
