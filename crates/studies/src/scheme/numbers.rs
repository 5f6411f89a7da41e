//! Numbers of a machine in some states near one place: what moves with what is read off them, so that no kinematics is written twice.

use crate::machine::Machine;
use mechanics::Places;
use mechanics::model::{Class, FrameId, Pathway, PointId, PointRef};
use std::collections::BTreeMap;
use symbolic::{Expr, SymbolId};

pub use algebra::space::{Vector as V3, cross, dot, minus, norm};

/// States in which all coordinates are moved at once.
const MIXED: usize = 3;
/// How far coordinates are moved, rad or m.
const STEP: f64 = 0.06;

/// Below it nothing moves and two places are one, in metres, radians or pixels: what moves at all moves by some thousandth of `STEP` and more, and places about a
/// metre are rounded to 1e-15.
pub const STILL: f64 = 1e-9;
/// Ratios of movements that differ less, relatively, are one: movements of `STEP` and of its square carry ten digits and more.
pub const ALIKE: f64 = 1e-6;

/// Where a frame is.
#[derive(Clone, Copy, Debug)]
pub struct Pose {
    /// Its origin.
    pub origin: V3,
    /// Rows of its rotation matrix, ground from frame.
    pub rotation: [V3; 3],
}

/// A machine in states: the place that is drawn, some in which every coordinate is moved, one for each coordinate, and one later.
#[derive(Debug)]
pub struct Numbers {
    /// By state and frame.
    pub frames: Vec<Vec<Pose>>,
    /// By state and point.
    points: Vec<Vec<V3>>,
    /// By state and frame: mass centres.
    centers: Vec<Vec<V3>>,
    /// Values of pathways by name of what they belong to, by state.
    pathways: BTreeMap<String, Vec<f64>>,
    values: BTreeMap<SymbolId, f64>,
    /// Coordinates by state.
    q: Vec<Vec<f64>>,
}

/// A place of the machine: coordinates, rates and time.
#[derive(Clone, Debug)]
pub struct Instant {
    /// Coordinates, SI.
    pub q: Vec<f64>,
    /// Rates.
    pub rates: Vec<f64>,
    /// Turn angles and other auxiliary states, by name.
    pub turned: Vec<f64>,
    /// Time, s.
    pub t: f64,
}

impl Instant {
    /// The start of the motion.
    pub fn start(machine: &Machine) -> Instant {
        let equations = &machine.equations;
        let numbers: BTreeMap<SymbolId, f64> = equations.parameters.iter().map(|p| (p.symbol, p.value)).collect();
        let value = |s: SymbolId| numbers.get(&s).copied().unwrap_or(0.0);
        let roots = |of: fn(&symbolic::equations::Coordinate) -> Expr| -> Vec<Expr> { equations.coordinates.iter().map(of).collect() };
        let q = equations.graph.evaluate(&roots(|c| c.start), &value);
        let rates = equations.graph.evaluate(&roots(|c| c.rate), &value);
        let given = Instant { q: finite(q), rates: finite(rates), turned: vec![0.0; equations.auxiliaries.len()], t: 0.0 };
        // as assembled, where the connections close
        match machine.system.start() {
            Ok(start) if start.len() >= 2 * given.q.len() => {
                let n = given.q.len();
                Instant { q: finite(start[..n].to_vec()), rates: finite(start[n..2 * n].to_vec()), ..given }
            }
            _ => given,
        }
    }
}

fn finite(values: Vec<f64>) -> Vec<f64> {
    values.into_iter().map(|v| if v.is_finite() { v } else { 0.0 }).collect()
}

/// A number between -1 and 1 that looks like chance and is always the same.
fn scattered(i: usize, k: usize) -> f64 {
    let x = ((i * 7919 + k * 104_729 + 13) % 1000) as f64 / 500.0 - 1.0;
    if x.abs() < 0.2 { x + 0.5 } else { x }
}

impl Numbers {
    /// Evaluates everything about an instant.
    pub fn new(machine: &Machine, at: &Instant, asked: &[(String, Pathway)]) -> Numbers {
        let model = &machine.model;
        let mut places = Places::new(model);
        let mut roots: Vec<Expr> = Vec::new();
        for i in 0..model.frames.len() {
            let (origin, rotation) = places.frame(FrameId(i));
            roots.extend(origin);
            roots.extend(rotation.into_iter().flatten());
        }
        for i in 0..model.points.len() {
            roots.extend(places.point(PointRef::Point(PointId(i))));
        }
        for i in 0..model.frames.len() {
            roots.extend(places.point(PointRef::Center(FrameId(i))));
        }
        let mut names = Vec::new();
        for (name, pathway) in asked {
            if let Some(value) = places.pathway(*pathway) {
                names.push(name.clone());
                roots.push(value);
            }
        }
        let states = states(machine, at);
        let mut numbers = Numbers {
            frames: Vec::new(),
            points: Vec::new(),
            centers: Vec::new(),
            pathways: names.iter().map(|n| (n.clone(), Vec::new())).collect(),
            values: states[0].clone(),
            q: (0..states.len()).map(|s| moved(at, s)).collect(),
        };
        for state in &states {
            let values = places.graph().evaluate(&roots, &|s| state.get(&s).copied().unwrap_or(0.0));
            numbers.take(&values, (model.frames.len(), model.points.len()), &names);
        }
        numbers
    }

    fn take(&mut self, values: &[f64], (n_frames, n_points): (usize, usize), names: &[String]) {
        let vector = |at: usize| [values[at], values[at + 1], values[at + 2]];
        let pose = |i: usize| Pose { origin: vector(12 * i), rotation: [3, 6, 9].map(|k| vector(12 * i + k)) };
        self.frames.push((0..n_frames).map(pose).collect());
        let points = 12 * n_frames;
        self.points.push((0..n_points).map(|i| vector(points + 3 * i)).collect());
        let centers = points + 3 * n_points;
        self.centers.push((0..n_frames).map(|i| vector(centers + 3 * i)).collect());
        for (name, value) in names.iter().zip(&values[centers + 3 * n_frames..]) {
            self.pathways.entry(name.clone()).or_default().push(*value);
        }
    }

    /// States without the one later.
    pub fn still(&self) -> std::ops::Range<usize> {
        0..self.frames.len() - 1
    }

    /// The state later.
    pub fn later(&self) -> usize {
        self.frames.len() - 1
    }

    /// The state in which only that coordinate is moved.
    pub fn moved(&self, coordinate: usize) -> usize {
        1 + MIXED + coordinate
    }

    /// A point in a state.
    pub fn at(&self, state: usize, point: PointRef) -> V3 {
        match point {
            PointRef::Point(p) => self.points[state][p.index()],
            PointRef::Origin(f) => self.frames[state][f.index()].origin,
            PointRef::Center(f) => self.centers[state][f.index()],
        }
    }

    /// A pathway in all states.
    pub fn pathway(&self, name: &str) -> Option<&[f64]> {
        self.pathways.get(name).map(Vec::as_slice)
    }

    /// A coordinate in all states.
    pub fn coordinate(&self, i: usize) -> Vec<f64> {
        self.q.iter().map(|q| q[i]).collect()
    }

    /// The number of a formula of the model in the place that is drawn.
    pub fn value(&self, machine: &Machine, e: Expr) -> f64 {
        machine.model.graph.evaluate(&[e], &|s| self.values.get(&s).copied().unwrap_or(0.0))[0]
    }
}

/// The coordinates of a state.
fn moved(at: &Instant, state: usize) -> Vec<f64> {
    let (mut q, n) = (at.q.clone(), at.q.len());
    match state {
        0 => {}
        k if k <= MIXED => q.iter_mut().enumerate().for_each(|(i, q)| *q += STEP * scattered(i, k)),
        k if k <= MIXED + n => q[k - MIXED - 1] += STEP,
        _ => {}
    }
    q
}

/// Values of symbols by state.
fn states(machine: &Machine, at: &Instant) -> Vec<BTreeMap<SymbolId, f64>> {
    let n = at.q.len();
    let mut out = Vec::new();
    for state in 0..1 + MIXED + n + 1 {
        let q = moved(at, state);
        let t = if state == MIXED + n + 1 { at.t + 0.013 } else { at.t };
        let mut state = values(machine, (&q, &at.rates), t);
        for (auxiliary, turned) in machine.equations.auxiliaries.iter().zip(&at.turned) {
            state.insert(auxiliary.symbol, turned + (t - at.t));
        }
        out.push(state);
    }
    out
}

/// Values of all symbols at an instant.
pub fn known(machine: &Machine, at: &Instant) -> BTreeMap<SymbolId, f64> {
    values(machine, (&at.q, &at.rates), at.t)
}

fn values(machine: &Machine, (q, rates): (&[f64], &[f64]), t: f64) -> BTreeMap<SymbolId, f64> {
    let (model, equations) = (&machine.model, &machine.equations);
    let mut known: BTreeMap<SymbolId, f64> = equations.parameters.iter().map(|p| (p.symbol, p.value)).collect();
    known.insert(model.time, t);
    for (i, c) in model.coordinates.iter().enumerate() {
        known.insert(c.symbols[0], q[i]);
        known.insert(c.symbols[1], rates[i]);
    }
    for p in model.parameters.iter().filter(|p| p.class != Class::Constant) {
        let value = model.graph.evaluate(&[p.value.expr()], &|s| known.get(&s).copied().unwrap_or(0.0))[0];
        known.insert(p.symbol, value);
    }
    for p in &model.parameters {
        if let (Some(number), false) = (p.number, known.contains_key(&p.symbol)) {
            known.insert(p.symbol, number);
        }
    }
    known
}

/// a + k b.
pub fn plus(a: V3, k: f64, b: V3) -> V3 {
    [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]]
}

/// The vector of length 1 in that direction; none for no direction.
pub fn unit(a: V3) -> Option<V3> {
    let n = norm(a);
    // a direction of anything shorter is rounding
    (n.is_finite() && n > 1e-12).then(|| a.map(|c| c / n))
}

impl Pose {
    /// A vector of the ground in the axes of the frame.
    pub fn seen(&self, v: V3) -> V3 {
        [0, 1, 2].map(|j| self.rotation[0][j] * v[0] + self.rotation[1][j] * v[1] + self.rotation[2][j] * v[2])
    }

    /// Where a point of the frame is that was there when the frame had another pose.
    pub fn carried(&self, before: &Pose, p: V3) -> V3 {
        plus(self.origin, 1.0, self.shown(before.seen(minus(p, before.origin))))
    }

    /// A vector of the frame in the axes of the ground.
    pub fn shown(&self, v: V3) -> V3 {
        self.rotation.map(|row| dot(row, v))
    }

    /// Plane angle of its x axis.
    pub fn angle(&self) -> f64 {
        self.rotation[1][0].atan2(self.rotation[0][0])
    }
}
