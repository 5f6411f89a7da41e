//! Answers of a rest that is not linear: those that slower speeds and rest itself lead to, and what starts of other sizes find.
//!
//! A branch comes back over its folds with all answers that hang together. A resonance of a hardening foundation that never ends has its small answers on a branch of their own: they are sought from rest at each speed.
//! Large answers are sought where a motion of the shape of a known one would go on without its load (a point of the backbone curve of that shape):
//!
//! ```text
//! <q, R(λq) - R(0)> = 0
//! ```

use super::follow::{Branch, Walker};
use super::turn::{Grid, INSTANTS, Turn, Turning, turn};
use algebra::elementary;

/// Speeds at which other answers are sought.
const TRIED: usize = 5;
/// Sizes of the starts there, by that of a known answer: turned round, and larger ones.
const SIZES: [f64; 6] = [-1.0, 3.0, -3.0, 10.0, -10.0, 40.0];
/// Constant starts there, by the size of each coordinate: other places of rest.
const OFFSETS: [f64; 4] = [1.0, -1.0, 10.0, -10.0];
/// Doublings of a shape up to which its backbone is looked for: some million times the known answer.
const DOUBLINGS: i32 = 20;
/// Halvings of the size of a free motion: a start need not be nearer.
const HALVINGS: usize = 12;

impl<T: Turning + ?Sized> Walker<'_, T> {
    /// The branches through answers of a rest that is not linear, and from how many starts others were sought.
    pub(super) fn several(&self, speeds: &[f64], found: &[Option<Turn>]) -> (Vec<Branch>, usize) {
        let mut branches: Vec<Branch> = Vec::new();
        for seed in found.iter().flatten() {
            self.take(&mut branches, seed);
        }
        for seed in speeds.iter().filter_map(|speed| turn(self.machine(), *speed, None)) {
            self.take(&mut branches, &seed);
        }
        let mut starts = 0;
        let stride = (found.len() - 1).div_ceil(TRIED - 1).max(1);
        let places: Vec<usize> = (0..found.len()).step_by(stride).chain([found.len() - 1]).collect();
        for known in places.into_iter().filter_map(|k| found[k].as_ref()) {
            for values in self.starts(known) {
                starts += 1;
                let start = Turn { values, ..known.clone() };
                if let Some(other) = turn(self.machine(), known.speed, Some(&start)) {
                    self.take(&mut branches, &other);
                }
            }
        }
        (branches, starts)
    }

    /// Starts beside a known answer.
    fn starts(&self, known: &Turn) -> Vec<Vec<f64>> {
        let sizes = self.sizes();
        let width = sizes.len();
        let by = |factor: f64, values: &[f64]| values.iter().map(|v| factor * v).collect::<Vec<f64>>();
        let mut list: Vec<Vec<f64>> = SIZES.iter().map(|size| by(*size, &known.values)).collect();
        for (j, offset) in (0..width).flat_map(|j| OFFSETS.map(|offset| (j, offset))) {
            let at = |(e, v): (usize, &f64)| if e % width == j { v + offset * sizes[j] } else { *v };
            list.push(known.values.iter().enumerate().map(at).collect());
        }
        let alone = |j: usize| known.values.iter().enumerate().map(move |(e, v)| if e % width == j { *v } else { 0.0 }).collect();
        let shapes: Vec<Vec<f64>> = if width > 1 { (0..width).map(alone).collect() } else { Vec::new() };
        for shape in shapes.into_iter().chain([known.values.clone()]) {
            for size in free(self.machine(), (known.speed, &shape), width) {
                list.extend([by(size, &shape), by(-size, &shape)]);
            }
        }
        list
    }
}

/// By what a shape is to be multiplied to go on without its load.
fn free<T: Turning + ?Sized>(machine: &T, (speed, shape): (f64, &[f64]), width: usize) -> Vec<f64> {
    let grid = Grid::new(INSTANTS[0], width);
    let shape = grid.taken(Some(shape));
    let still = grid.left(machine, speed, &vec![0.0; shape.len()]);
    let work = |size: f64| -> f64 {
        let values: Vec<f64> = shape.iter().map(|v| size * v).collect();
        grid.left(machine, speed, &values).iter().zip(&still).zip(&shape).map(|((r, s), v)| (r - s) * v / size).sum()
    };
    let known: Vec<(f64, f64)> = (-2..=DOUBLINGS).map(|k| elementary::exp2(f64::from(k))).map(|size| (size, work(size))).collect();
    let between = |pair: &[(f64, f64)]| {
        let ([mut low, mut high], sign) = ([pair[0].0, pair[1].0], pair[0].1 > 0.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            *(if (work(middle) > 0.0) == sign { &mut low } else { &mut high }) = middle;
        }
        0.5 * (low + high)
    };
    known.windows(2).filter(|pair| (pair[0].1 > 0.0) != (pair[1].1 > 0.0)).map(between).collect()
}
