//! The lanes themselves: values at points, series, and work over steps.

use super::faithful::Watches;
use super::layout::{Layout, Row};
use super::rows::{LANES, Modes, View};
use super::series::Series;
use super::values::Point;
use crate::Mode;
use algebra::elementary;
use algebra::simd::{Lanes, Shelf, Simd, Work, dispatch, horner, horners, less, plus, plus_product, scaled, times, weighted};
use std::sync::Arc;

/// Values of all rows at one point of each lane.
#[derive(Debug)]
pub struct Values {
    layout: Arc<Layout>,
    rows: Shelf,
    sound: [bool; LANES],
}

impl Values {
    /// x'_i.
    pub fn rate(&self, i: usize) -> &Lanes {
        &self.rows[self.layout.rates[i] as usize]
    }
    /// Velocities that formulas of time prescribe.
    pub fn prescribed(&self) -> impl Iterator<Item = &Lanes> {
        self.layout.jumping.iter().map(|row| &self.rows[*row as usize])
    }
    /// In which lanes all that the rates follow from has a value.
    pub fn sound(&self) -> &[bool; LANES] {
        &self.sound
    }
    /// T (0) or Π (1).
    pub fn level(&self, i: usize) -> &Lanes {
        &self.rows[self.layout.levels[i] as usize]
    }
}

/// Eight motions, see the head of the file.
#[derive(Debug)]
pub struct Ensemble {
    layout: Arc<Layout>,
    numbers: Shelf,
    modes: Modes,
    cells: Shelf,
    stride: usize,
    scratch: Vec<Lanes>,
    watches: Watches,
    /// Lanes without a machine, whose values nobody reads.
    idle: [bool; LANES],
}

impl Ensemble {
    /// With room for this order.
    pub fn new(layout: &Arc<Layout>, order: usize) -> Ensemble {
        let stride = order.max(1) + 1;
        Ensemble {
            layout: Arc::clone(layout),
            numbers: Shelf::new(layout.numbers),
            modes: Modes(vec![[2; LANES]; layout.guards]),
            cells: Shelf::new(layout.count as usize * stride),
            stride,
            scratch: Vec::new(),
            watches: Watches::default(),
            idle: [true; LANES],
        }
    }

    /// Gives a lane the numbers of a machine of this layout.
    pub fn load(&mut self, lane: usize, numbers: &[f64]) {
        self.numbers.iter_mut().zip(numbers).for_each(|(lanes, number)| lanes[lane] = *number);
        self.watches.forget(lane);
        self.idle[lane] = false;
    }

    /// Nobody reads a lane until it is loaded again.
    pub fn rest(&mut self, lane: usize) {
        self.idle[lane] = true;
    }

    /// Gives a lane modes.
    pub fn set_modes(&mut self, lane: usize, modes: &[Mode]) {
        self.modes.0.iter_mut().zip(modes).for_each(|(lanes, mode)| lanes[lane] = mode.side() as u8);
        self.watches.forget(lane);
    }

    /// Room for values.
    pub fn values(&self) -> Values {
        Values { layout: Arc::clone(&self.layout), rows: Shelf::new(self.layout.count as usize), sound: [true; LANES] }
    }

    /// Rates, prescribed velocities and energies at a point of each lane.
    pub fn evaluate(&self, times: &Lanes, states: &[Lanes], into: &mut Values) {
        self.fill((&self.layout.ends, times, states), into);
    }

    /// Rates alone.
    pub fn evaluate_rates(&self, times: &Lanes, states: &[Lanes], into: &mut Values) {
        self.fill((&self.layout.series, times, states), into);
    }

    fn fill(&self, (steps, times, states): (&[u32], &Lanes, &[Lanes]), into: &mut Values) {
        let point = Point { layout: &self.layout, numbers: &self.numbers, modes: &self.modes, times, states };
        let sound = dispatch(Evaluation { point, steps, values: &mut into.rows });
        into.sound = std::array::from_fn(|lane| sound[lane] || !self.idle[lane] && self.has_value(lane, into));
    }

    /// Whether all that matters in the modes of a lane is finite: what overflows on the way is never replaced.
    #[inline(never)]
    fn has_value(&self, lane: usize, values: &Values) -> bool {
        let modes: Vec<u8> = self.modes.0.iter().map(|sides| sides[lane]).collect();
        let live = self.layout.live(&modes);
        live.iter().zip(&*values.rows).all(|(live, row)| !live || row[lane].is_finite())
    }

    /// Work of loads, of drives and of dissipation over a step of each lane; accelerations are those of the polynomials.
    pub fn works(&mut self, span: &Span<'_>, rule: &Rule, room: &mut Values) -> [Lanes; 3] {
        let mut scratch = std::mem::take(&mut self.scratch);
        let works = dispatch(Works { ensemble: self, span, rule, values: &mut room.rows, scratch: &mut scratch });
        self.scratch = scratch;
        works
    }

    /// Expands the motions through a point, whose values these are. Tells in which lanes all coefficients of the states are finite.
    pub fn expand(&mut self, from: &Values) -> [bool; LANES] {
        let stride = self.stride;
        let of_steps =
            self.layout.series.iter().map(|i| &self.layout.steps[*i as usize]).flat_map(|step| step.row..step.own + step.what.own());
        for row in of_steps.chain(self.layout.states.iter().copied()) {
            self.cells[row as usize * stride] = from.rows[row as usize];
        }
        let (layout, numbers, modes) = (&*self.layout, &self.numbers, &self.modes);
        dispatch(Series { layout, numbers, modes, cells: &mut self.cells, stride, scratch: &mut self.scratch })
    }

    fn view(&self) -> View<'_> {
        View { layout: &self.layout, numbers: &self.numbers, modes: &self.modes, cells: &self.cells, stride: self.stride }
    }

    fn row(&self, row: Row) -> &[Lanes] {
        self.view().row(row)
    }

    /// Coefficients of state `i`.
    pub fn state(&self, i: usize) -> &[Lanes] {
        self.row(self.layout.states[i])
    }

    /// Changes of all states since the start of the step, and their slopes, at `taus` after it.
    pub fn motion(&self, taus: &Lanes, changes: &mut [Lanes], slopes: &mut [Lanes]) {
        dispatch(Motion { ensemble: self, taus, changes, slopes });
    }

    /// The longest step of a lane, at most `h`, over which its series says what every operation does: [`crate::Jets::faithful`] of the lane. None where an operation is at a singular point.
    pub fn faithful(&mut self, lengths: &Lanes, tolerance: f64) -> [Option<f64>; LANES] {
        let mut watches = std::mem::take(&mut self.watches);
        let found = watches.faithful(self.view(), lengths, tolerance);
        self.watches = watches;
        found
    }
}

/// Steps of all lanes: starts in time, high and low part, and of the states, and lengths.
#[derive(Clone, Copy, Debug)]
pub struct Span<'a> {
    /// Instants.
    pub times: [&'a Lanes; 2],
    /// States.
    pub states: [&'a [Lanes]; 2],
    /// Lengths.
    pub lengths: &'a Lanes,
}

/// Points of a rule that are looked at together.
const GROUP: usize = 4;

/// A rule for integrals over steps of one order.
#[derive(Clone, Debug)]
pub struct Rule {
    /// Shares of the step, and weights.
    points: Vec<(f64, f64)>,
    /// u^k and k u^(k-1), k from 1 on, of the points by groups.
    powers: Vec<[Vec<[f64; GROUP]>; 2]>,
}

impl Rule {
    /// From a rule on -1 to 1 whose points are whole groups of four.
    pub fn new(rule: &[(f64, f64)], order: usize) -> Rule {
        let points: Vec<(f64, f64)> = rule.iter().map(|(u, weight)| (0.5 * (1.0 + u), 0.5 * weight)).collect();
        let group = |points: &[(f64, f64); GROUP]| {
            let power = |k: usize| points.map(|(u, _)| elementary::powi(u, k as i32));
            [(1..=order).map(power).collect(), (1..=order).map(|k| power(k - 1).map(|u| k as f64 * u)).collect()]
        };
        let powers = points.as_chunks::<GROUP>().0.iter().map(group).collect();
        Rule { points, powers }
    }
}

struct Works<'a> {
    ensemble: &'a Ensemble,
    span: &'a Span<'a>,
    rule: &'a Rule,
    values: &'a mut [Lanes],
    scratch: &'a mut Vec<Lanes>,
}

impl Work for Works<'_> {
    type Output = [Lanes; 3];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [Lanes; 3] {
        let Works { ensemble, span, rule, values, scratch } = self;
        let (layout, n_x, order) = (&*ensemble.layout, ensemble.layout.states.len(), ensemble.stride - 1);
        let width = n_x + layout.coordinates;
        scratch.clear();
        scratch.resize(2 * order + width * rule.points.len(), [0.0; LANES]);
        let (powers, rest) = scratch.split_at_mut(order);
        let (scaled_row, room) = rest.split_at_mut(order);
        // h^(k-1)
        let mut power = [1.0; LANES];
        for place in powers.iter_mut() {
            *place = power;
            power = times(simd, &power, span.lengths);
        }
        for slot in &layout.read {
            let i = *slot as usize;
            // x = x(0) + h Σ c_k h^(k-1) u^k, x' = Σ c_k h^(k-1) k u^(k-1)
            let state = if i < n_x { i } else { i - n_x + layout.coordinates };
            for ((e, c), power) in scaled_row.iter_mut().zip(&ensemble.state(state)[1..]).zip(powers.iter()) {
                *e = times(simd, c, power);
            }
            for (g, [values, slopes]) in rule.powers.iter().enumerate() {
                let four = weighted(simd, scaled_row, if i < n_x { values } else { slopes });
                for (j, value) in four.iter().enumerate() {
                    room[(GROUP * g + j) * width + i] = if i < n_x {
                        plus(simd, &plus_product(simd, &span.states[1][i], span.lengths, value), &span.states[0][i])
                    } else {
                        *value
                    };
                }
            }
        }
        let mut works = [[0.0; LANES]; 3];
        for ((u, weight), states) in rule.points.iter().zip(room.chunks_exact(width.max(1))) {
            let taus = scaled(simd, *u, span.lengths);
            let times = plus(simd, span.times[0], &plus(simd, span.times[1], &taus));
            let point = Point { layout, numbers: &ensemble.numbers, modes: &ensemble.modes, times: &times, states };
            point.fill(simd, &layout.powers, values);
            let shares = scaled(simd, *weight, span.lengths);
            for (work, row) in works.iter_mut().zip(&layout.supply) {
                *work = plus_product(simd, work, &shares, &values[*row as usize]);
            }
        }
        works
    }
}

struct Evaluation<'a> {
    point: Point<'a>,
    steps: &'a [u32],
    values: &'a mut [Lanes],
}

impl Work for Evaluation<'_> {
    type Output = [bool; LANES];

    /// Lanes in which everything on the way to the rates is finite.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [bool; LANES] {
        self.point.fill(simd, self.steps, self.values);
        let layout = self.point.layout;
        let mut nothing = [0.0; LANES];
        for i in &layout.series {
            let step = &layout.steps[*i as usize];
            for row in step.row..step.row + step.width {
                let value = &self.values[row as usize];
                nothing = plus(simd, &nothing, &less(simd, value, value));
            }
        }
        nothing.map(|v| v == 0.0)
    }
}

struct Motion<'a> {
    ensemble: &'a Ensemble,
    taus: &'a Lanes,
    changes: &'a mut [Lanes],
    slopes: &'a mut [Lanes],
}

impl Work for Motion<'_> {
    type Output = ();

    /// x = x(0) + τ V(τ) gives x' = V + τ V'.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let count = self.changes.len();
        for i in (0..count).step_by(2) {
            let row = |i: usize| &self.ensemble.state(i)[1..];
            let found = if i + 1 < count {
                horners(simd, [row(i), row(i + 1)], self.taus)
            } else {
                [horner(simd, row(i), self.taus), [[0.0; LANES]; 2]]
            };
            for (i, [value, rate]) in (i..count).zip(found) {
                self.changes[i] = times(simd, &value, self.taus);
                self.slopes[i] = plus_product(simd, &value, self.taus, &rate);
            }
        }
    }
}
