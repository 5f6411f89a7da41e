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
    /// First value at which a motion grows.
    pub unstable_from: Option<f64>,
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
    for k in 0..points {
        let value = ends[0] + (ends[1] - ends[0]) * k as f64 / (points - 1).max(1) as f64;
        let (list, mass) = run.modes(value)?;
        if out.unstable_from.is_none() && list.iter().any(|m| m.root.0 > 1e-9 * (m.omega + m.root.0)) {
            out.unstable_from = Some(value);
        }
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
    if quantity.unit == "rad/s" || quantity.unit == "1/s" {
        out.critical = run.critical(&out)?;
    }
    out.data = dataset(&out, &quantity);
    Ok(out)
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

    /// Sign changes of ω_j - Ω between the values, refined by bisection among the roots nearest to the curve.
    fn critical(&mut self, tracks: &Tracks) -> Result<Vec<Critical>, Fault> {
        let mut found = Vec::new();
        for (mode, omega) in tracks.omega.iter().enumerate() {
            for k in 1..tracks.values.len() {
                let [a, b] = [k - 1, k].map(|i| tracks.values[i]);
                let [fa, fb] = [omega[k - 1] - a, omega[k] - b];
                if fa.is_nan() || fb.is_nan() || fa * fb > 0.0 || (fa == 0.0 && k > 1) || (omega[k - 1] == 0.0 && omega[k] == 0.0) {
                    continue;
                }
                if let Some(value) = self.crossing([a, b], [omega[k - 1], omega[k]])? {
                    found.push(Critical { mode, value, order: 1.0 });
                }
            }
        }
        found.sort_by(|a, b| a.value.total_cmp(&b.value).then(a.mode.cmp(&b.mode)));
        Ok(found)
    }

    fn crossing(&mut self, [mut a, mut b]: [f64; 2], [mut wa, mut wb]: [f64; 2]) -> Result<Option<f64>, Fault> {
        for _ in 0..200 {
            if (b - a).abs() <= 4.0 * f64::EPSILON * b.abs().max(a.abs()) {
                break;
            }
            let middle = 0.5 * (a + b);
            let expected = 0.5 * (wa + wb);
            let (list, _) = self.modes(middle)?;
            let near = list.iter().filter(|m| worth_following(m)).map(|m| m.damped);
            let Some(w) = near.min_by(|x, y| (x - expected).abs().total_cmp(&(y - expected).abs())) else { return Ok(None) };
            if (wa - a) * (w - middle) <= 0.0 {
                (b, wb) = (middle, w);
            } else {
                (a, wa) = (middle, w);
            }
        }
        Ok(Some(0.5 * (a + b)))
    }
}

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
        let label = Text::new(format!("frequency of mode {}", j + 1), format!("частота формы {}", j + 1));
        let quantity = Quantity { label, symbol: format!("omega_{}", j + 1), ..Quantity::new(&format!("omega_{}", j + 1), "rad/s") };
        columns.push(Column { quantity, values: values.clone() });
    }
    for (j, values) in tracks.ratio.iter().enumerate().filter(|(_, v)| v.iter().any(|r| r.is_finite() && *r != 0.0)) {
        let label = Text::new(format!("damping ratio of mode {}", j + 1), format!("относительное затухание формы {}", j + 1));
        let quantity = Quantity { label, symbol: format!("zeta_{}", j + 1), ..Quantity::new(&format!("zeta_{}", j + 1), "1") };
        columns.push(Column { quantity, values: values.clone() });
    }
    let mut notes = Vec::new();
    if let Some(value) = tracks.unstable_from {
        let v = crate::fault::rounded(value);
        let unit = if parameter.unit == "1" { String::new() } else { format!(" {}", parameter.unit) };
        notes.push(Text::new(
            format!("from {} = {}{unit} on a motion grows", parameter.name, v.en),
            format!("начиная с {} = {}{unit} движение растёт", parameter.name, v.ru),
        ));
    }
    Dataset { axis: Some(0), columns, notes, ..Dataset::default() }
}
