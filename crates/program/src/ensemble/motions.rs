//! The lanes themselves: values at points, series, and work over steps.

use super::faithful::Watches;
use super::layout::{Layout, Row};
use super::rows::{LANES, Modes, View};
use super::series::Series;
use super::values::Point;
use crate::Mode;
use algebra::simd::{Lanes, Shelf, Simd, Work, dispatch, horner, less, plus, plus_product, polynomial, scaled, times};
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
        }
    }

    /// Gives a lane the numbers of a machine of this layout.
    pub fn load(&mut self, lane: usize, numbers: &[f64]) {
        self.numbers.iter_mut().zip(numbers).for_each(|(lanes, number)| lanes[lane] = *number);
        self.watches.forget(lane);
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
        into.sound = std::array::from_fn(|lane| sound[lane] || self.has_value(lane, into));
    }

    /// Whether all that matters in the modes of a lane is finite: what overflows on the way is never replaced.
    #[inline(never)]
    fn has_value(&self, lane: usize, values: &Values) -> bool {
        let modes: Vec<u8> = self.modes.0.iter().map(|sides| sides[lane]).collect();
        let live = self.layout.live(&modes);
        live.iter().zip(&*values.rows).all(|(live, row)| !live || row[lane].is_finite())
    }

    /// Work of loads, of drives and of dissipation over a step of each lane, by a rule on -1 to 1; accelerations are those of the polynomials.
    pub fn works(&self, span: &Span<'_>, rule: &[(f64, f64)], room: &mut Values) -> [Lanes; 3] {
        dispatch(Works { ensemble: self, span, rule, values: &mut room.rows })
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

struct Works<'a> {
    ensemble: &'a Ensemble,
    span: &'a Span<'a>,
    rule: &'a [(f64, f64)],
    values: &'a mut [Lanes],
}

impl Work for Works<'_> {
    type Output = [Lanes; 3];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [Lanes; 3] {
        let Works { ensemble, span, rule, values } = self;
        let (layout, n_x) = (&*ensemble.layout, ensemble.layout.states.len());
        let mut room = vec![[0.0; LANES]; n_x + layout.coordinates];
        let mut works = [[0.0; LANES]; 3];
        for (u, weight) in rule {
            let taus = scaled(simd, 0.5 * (1.0 + u), span.lengths);
            for slot in &layout.read {
                let i = *slot as usize;
                room[i] = if i < n_x {
                    let change = polynomial(simd, &ensemble.state(i)[1..], &taus);
                    plus(simd, &plus_product(simd, &span.states[1][i], &change, &taus), &span.states[0][i])
                } else {
                    // x = x(0) + τ V(τ) gives x' = V + τ V'
                    let [value, rate] = horner(simd, &ensemble.state(i - n_x + layout.coordinates)[1..], &taus);
                    plus_product(simd, &value, &taus, &rate)
                };
            }
            let times = plus(simd, span.times[0], &plus(simd, span.times[1], &taus));
            let point = Point { layout, numbers: &ensemble.numbers, modes: &ensemble.modes, times: &times, states: &room };
            point.fill(simd, &layout.powers, values);
            let shares = scaled(simd, 0.5 * weight, span.lengths);
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
        for (i, (change, slope)) in self.changes.iter_mut().zip(self.slopes).enumerate() {
            let [value, rate] = horner(simd, &self.ensemble.state(i)[1..], self.taus);
            *change = times(simd, &value, self.taus);
            *slope = plus_product(simd, &value, self.taus, &rate);
        }
    }
}
