//! Ways and integrals on the surface of the conditions on places.
//!
//! A disc that rolls inside a circle has x, y and its turn for coordinates. Its condition, ((x y' - y x')/ρ + r φ' = 0, is the derivative of something only
//! where x² + y² = ρ², the place that the circle keeps. Such a condition is integrated along a way that lies there: the straight way, of which every point is moved onto the
//! surface by the least changes,
//!
//! ```text
//! q_i = Π(q₀ + i h (q - q₀)),     c_h = Σ (J(q_i) + J(q_{i+1}))/2 (q_{i+1} - q_i),     h -> 0 by Romberg's scheme
//! ```
//!
//! Beside the surface c goes on with its slope J.

use super::way::{Sum, lost, sum};
use crate::Fault;
use algebra::qr::Qr;
use algebra::vectors::norm;

/// Change of the integral by halving the stretches, relative to its terms, that ends the halving: sums of some hundred terms keep no more.
const SETTLED: f64 = 4e-15;
/// Halvings at most.
const HALVINGS: usize = 12;
/// What may still be open then: stretches that short leave rounding, and a way through a place where the surface has none changes wholly.
const OPEN: f64 = 1e-11;
/// Steps of Newton's method onto the surface: from as far off as a chord goes it converges in a few.
const STEPS: usize = 24;
/// A step of that size, relative to the place, is rounding.
const STILL: f64 = 4.0 * f64::EPSILON;

/// Time and coordinates.
pub(crate) type Instant = (f64, Vec<f64>);

/// Rows that are integrated, and the conditions on places, at an instant.
#[derive(Clone, Debug, Default)]
pub(crate) struct Slopes {
    /// J of each row, then its part in time.
    pub(crate) rows: Vec<Vec<f64>>,
    /// What should vanish.
    pub(crate) places: Vec<f64>,
    /// Derivatives of these by the coordinates, place by place.
    pub(crate) gradients: Vec<f64>,
}

/// Where the straight way from one instant to another, its end moved onto the surface, leads.
pub(crate) struct Ways<'a, F> {
    /// The numbers at an instant.
    pub(crate) at: &'a mut F,
}

impl<F: FnMut(&Instant) -> Result<Slopes, Fault>> Ways<'_, F> {
    /// The point of the surface beside a place.
    ///
    /// *Errors*: none is near; a formula without a value.
    pub(crate) fn onto(&mut self, (t, q): &Instant) -> Result<(Instant, Slopes), Fault> {
        let mut here = (*t, q.clone());
        let mut before = f64::INFINITY;
        for _ in 0..STEPS {
            let slopes = (self.at)(&here)?;
            let (n, m) = (here.1.len(), slopes.places.len());
            let columns: Vec<f64> = (0..n * m).map(|k| slopes.gradients[(k % m) * n + k / m]).collect();
            let step = Qr::new(&columns, n, m).shortest(&slopes.places);
            let size = norm(&step);
            // near enough steps fall quadratically, until only rounding is left
            if size <= STILL * norm(&here.1) || size >= before && before <= OPEN * norm(&here.1) {
                return Ok((here, slopes));
            }
            before = size;
            here.1.iter_mut().zip(&step).for_each(|(q, d)| *q -= d);
        }
        Err(lost(*t))
    }

    /// c of each row along the way between two instants, and the size of its terms.
    ///
    /// *Errors*: a way that leaves the surface; a formula without a value on it.
    pub(crate) fn integrals(&mut self, from: &Instant, to: &Instant) -> Result<Vec<Sum>, Fault> {
        let ends = [self.onto(from)?, self.onto(to)?];
        let beside = |k: usize| -> Vec<f64> { [from, to][k].1.iter().zip(&ends[k].0.1).map(|(q, on)| q - on).collect() };
        let mut stops = ends.to_vec();
        let mut sums = trapezoids(&stops);
        let mut table = vec![sums.clone()];
        for halving in 0..HALVINGS {
            stops = self.halved(&stops, [from, to])?;
            let mut row = vec![trapezoids(&stops)];
            for (k, known) in table.iter().enumerate() {
                let share = 1.0 / (4_u64.pow(k as u32 + 1) - 1) as f64;
                row.push(row[k].iter().zip(known).map(|(new, old)| [new[0] + (new[0] - old[0]) * share, new[1]]).collect());
            }
            let now = row.last().cloned().unwrap_or_default();
            let changed = |limit: f64| now.iter().zip(&sums).any(|(a, b)| (a[0] - b[0]).abs() > limit * a[1]);
            let (open, rounding) = (changed(OPEN), changed(SETTLED));
            (sums, table) = (now, row);
            if !rounding || halving + 1 == HALVINGS && !open {
                let [first, last] = [0, 1].map(|k| outside(&ends[k].1, &beside(k)));
                return Ok((0..sums.len()).map(|i| [sums[i][0] + last[i] - first[i], sums[i][1]]).collect());
            }
        }
        Err(lost(to.0))
    }

    /// Twice as many points of the same way.
    fn halved(&mut self, stops: &[(Instant, Slopes)], [from, to]: [&Instant; 2]) -> Result<Vec<(Instant, Slopes)>, Fault> {
        let parts = 2 * (stops.len() - 1);
        let on_chord = |i: usize| -> Instant {
            let s = i as f64 / parts as f64;
            (from.0 + s * (to.0 - from.0), from.1.iter().zip(&to.1).map(|(a, b)| a + s * (b - a)).collect())
        };
        let points = (0..=parts).map(|i| if i % 2 == 0 { Ok(stops[i / 2].clone()) } else { self.onto(&on_chord(i)) });
        points.collect()
    }
}

/// c of each row by chords, and the size of its terms.
fn trapezoids(stops: &[(Instant, Slopes)]) -> Vec<Sum> {
    let rows = stops[0].1.rows.len();
    let of = |row: usize| {
        let chords = stops.windows(2).flat_map(|pair| {
            let [((t, q), before), ((later, there), behind)] = pair else { unreachable!("windows of two") };
            let way = q.iter().zip(there).map(|(a, b)| b - a).chain([later - t]);
            let mean = before.rows[row].iter().zip(&behind.rows[row]).map(|(a, b)| 0.5 * (a + b));
            mean.zip(way).map(|(j, d)| j * d)
        });
        sum(chords)
    };
    (0..rows).map(of).collect()
}

/// What the rows gain off the surface.
fn outside(slopes: &Slopes, beside: &[f64]) -> Vec<f64> {
    slopes.rows.iter().map(|row| row.iter().zip(beside).map(|(j, d)| j * d).sum()).collect()
}
