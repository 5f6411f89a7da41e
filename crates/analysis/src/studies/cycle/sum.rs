//! Sums over the cycle and rows of the result, on polynomials of each step.

use super::faults::rough;
use super::reduced::{Pair, Potential, ROUNDING, Reduced, gained, reduced};
use super::turn::{Cycle, place};
use crate::dataset::{Column, Dataset, Extreme};
use crate::integrate::Step;
use crate::marks::bracketed;
use crate::marks::crossings::{self, Bracket};
use crate::proxies::proxy::{Piece, Proxies, Values};
use crate::{Fault, Quantity, System};
use words::Text;

/// What a piece holds: J, dJ/dφ, M, then the integrands M φ', J φ', and that of the work of what has no potential.
const COLUMNS: usize = 3;
const POWER: usize = 3;
const TURNED: usize = 4;
const DRIVEN: usize = 5;

/// Sums over the cycle, and rows of the result at equal angles.
pub(super) struct Sum {
    pub(super) angles: Vec<f64>,
    /// J, dJ/dφ, M, A.
    values: Vec<[f64; 4]>,
    pub(super) extremes: [Extreme; 4],
    pub(super) proxies: Proxies,
    /// Ends of the parts of each step over which the power is a polynomial.
    pub(super) parts: Vec<Vec<f64>>,
    pub(super) work: f64,
    pub(super) size: f64,
    /// Largest sum of the moments that meet.
    pub(super) terms: f64,
    pub(super) fed: Fed,
    pub(super) inertia: f64,
    pub(super) angle: f64,
}

/// Work of what has no potential, and the change of the potential, which is known by its ends alone: over a cycle that closes it vanishes, however large the potential is in between.
#[derive(Default)]
pub(super) struct Fed {
    pub(super) work: f64,
    pub(super) size: f64,
    /// Largest sum of the moments that meet.
    pub(super) terms: f64,
    /// Potential at both ends of all steps so far, and its jumps between steps.
    pub(super) ends: Option<[Potential; 2]>,
    jumps: f64,
}

impl Fed {
    pub(super) fn add(&mut self, pieces: &[Piece]) {
        for piece in pieces.iter().filter(|p| p.of == DRIVEN) {
            let [work, size] = done(piece, |_, _| {});
            (self.work, self.size) = (self.work + work, self.size + size);
        }
    }

    /// The potential at the ends of one more step.
    pub(super) fn passes(&mut self, [begin, end]: [Potential; 2]) {
        let [first, before] = self.ends.unwrap_or([begin; 2]);
        self.jumps += gained(before, begin);
        self.ends = Some([first, end]);
    }

    /// The work of all forces, and what passes.
    pub(super) fn with_potential(&self, size: f64) -> [f64; 2] {
        let [first, last] = self.ends.unwrap_or_default();
        // a difference of potentials is as uncertain as they are
        [self.work - gained(first, last) + self.jumps, size + first.known.max(last.known) / ROUNDING]
    }
}

/// Work of a piece, and what passes in it; told where it turns back and at the end.
pub(super) fn done(piece: &Piece, mut told: impl FnMut(f64, f64)) -> [f64; 2] {
    let work = crossings::integral(&piece.row, piece.to - piece.from);
    let (mut last, mut size) = (0.0, 0.0);
    for u in roots(&piece.row).into_iter().chain([1.0]) {
        let value = crossings::value(&work, u);
        told(u, value);
        size += f64::abs(value - last);
        last = value;
    }
    [last, size]
}

impl Sum {
    pub(super) fn new(options: &Cycle, first: f64) -> Sum {
        let last = options.points.max(2) - 1;
        let angles = (0..=last).map(|k| first + options.range * k as f64 / last as f64).collect();
        let none = |k: usize| Extreme { column: k + 1, min: f64::INFINITY, max: f64::NEG_INFINITY, t_min: first, t_max: first };
        let mut sum = Sum {
            angles,
            values: Vec::new(),
            extremes: std::array::from_fn(none),
            proxies: Proxies::default(),
            parts: Vec::new(),
            work: 0.0,
            size: 0.0,
            terms: 0.0,
            fed: Fed::default(),
            inertia: 0.0,
            angle: 0.0,
        };
        sum.offer(3, first, 0.0);
        sum
    }

    fn offer(&mut self, k: usize, place: f64, value: f64) {
        let e = &mut self.extremes[k];
        if value < e.min {
            (e.min, e.t_min) = (value, place);
        }
        if value > e.max {
            (e.max, e.t_max) = (value, place);
        }
    }

    /// Adds a step up to `length`.
    pub(super) fn add<S: System + ?Sized>(
        &mut self,
        machine: &mut Pair<'_, S>,
        step: &Step,
        length: f64,
        options: &Cycle,
    ) -> Result<(), Fault> {
        let (mut fault, mut terms, mut fed) = (None, self.terms, self.fed.terms);
        let mut largest = |r: &Reduced| (terms, fed) = (terms.max(r.terms), fed.max(r.fed));
        let mut sample = Values(|tau: f64| match reduced(machine, step, tau, options).inspect(&mut largest) {
            Ok(r) => vec![r.inertia, r.slope, r.moment, r.moment * r.rate, r.inertia * r.rate, r.driven * r.rate],
            Err(f) => {
                fault.get_or_insert(f);
                vec![f64::NAN; 6]
            }
        });
        let pieces = self.proxies.pieces(&mut sample, &[0, 1, 2, POWER, TURNED, DRIVEN], length);
        if let Some(fault) = fault {
            return Err(fault);
        }
        (self.terms, self.fed.terms) = (terms, fed);
        self.fed.add(&pieces);
        self.fed.passes([machine.potential(step, 0.0, options)?, machine.potential(step, length, options)?]);
        let place = |tau: f64| place(step, options.angle, tau);
        for piece in pieces.iter().filter(|p| p.of < COLUMNS) {
            self.column(piece, &place);
        }
        self.parts.push(pieces.iter().filter(|p| p.of == POWER).map(|p| p.to).collect());
        let (mut now, before) = (0.0, self.work);
        for piece in pieces.iter().filter(|p| p.of == POWER) {
            self.rows((machine, step), (piece, before + now), &place, options)?;
            now += self.working(piece, before + now, &place);
        }
        self.work = before + now;
        let turned = pieces.iter().filter(|p| p.of == TURNED);
        self.inertia += turned.map(|p| (p.to - p.from) * p.row.iter().sum::<f64>() / p.row.len() as f64).sum::<f64>();
        self.angle += place(length) - place(0.0);
        Ok(())
    }

    /// Extremes of a column in a piece.
    pub(super) fn column(&mut self, piece: &Piece, place: &dyn Fn(f64) -> f64) {
        let at = |u: f64| place(piece.from + (piece.to - piece.from) * u);
        let ends = [(0.0, piece.row[0]), (1.0, piece.row[piece.row.len() - 1])];
        let inside = roots(&crossings::derivative(&piece.row)).into_iter().map(|u| (u, crossings::value(&piece.row, u)));
        for (u, value) in ends.into_iter().chain(inside) {
            self.offer(piece.of, at(u), value);
        }
    }

    /// Work of a piece, with the extremes of the work inside it.
    fn working(&mut self, piece: &Piece, before: f64, place: &dyn Fn(f64) -> f64) -> f64 {
        let [work, size] = done(piece, |u, value| self.offer(3, place(piece.from + (piece.to - piece.from) * u), before + value));
        self.size += size;
        work
    }

    /// Rows whose angle lies in a piece of the power, before which the work is `before`.
    pub(super) fn rows<S: System + ?Sized>(
        &mut self,
        (machine, step): (&mut Pair<'_, S>, &Step),
        (piece, before): (&Piece, f64),
        place: &dyn Fn(f64) -> f64,
        options: &Cycle,
    ) -> Result<(), Fault> {
        let sign = options.range.signum();
        let done = crossings::integral(&piece.row, piece.to - piece.from);
        while let Some(&angle) = self.angles.get(self.values.len()) {
            if sign * (place(piece.to) - angle) <= 0.0 {
                break;
            }
            let (mut low, mut high) = (piece.from, piece.to);
            for _ in 0..100 {
                let middle = 0.5 * (low + high);
                if sign * (place(middle) - angle) < 0.0 { low = middle } else { high = middle }
            }
            let here = reduced(machine, step, high, options)?;
            let work = before + crossings::value(&done, (high - piece.from) / (piece.to - piece.from));
            self.values.push([here.inertia, here.slope, here.moment, work]);
        }
        Ok(())
    }

    /// The last row, at the end of the cycle.
    pub(super) fn finish<S: System + ?Sized>(
        &mut self,
        machine: &mut Pair<'_, S>,
        steps: &[(Step, f64)],
        options: &Cycle,
    ) -> Result<(), Fault> {
        if let Some((step, length)) = steps.last() {
            while self.values.len() < self.angles.len() {
                let here = reduced(machine, step, *length, options)?;
                self.values.push([here.inertia, here.slope, here.moment, self.work]);
            }
        }
        Ok(())
    }

    pub(super) fn dataset<S: System + ?Sized>(self, system: &S, options: &Cycle) -> Dataset {
        let angle = system.states()[options.angle].clone();
        let column = |name: &str, symbol: &str, unit: &str, en: &str, ru: &str, k: usize| Column {
            quantity: Quantity { symbol: symbol.into(), label: Text::new(en, ru), ..Quantity::new(name, unit) },
            values: self.values.iter().map(|row| row[k]).collect(),
        };
        let columns = vec![
            column("J", "J", "kg m^2", "reduced moment of inertia", "приведённый момент инерции", 0),
            column("dJ", "J_φ", "kg m^2", "its derivative by the angle", "его производная по углу", 1),
            column("M", "M", "N m", "reduced moment of the forces", "приведённый момент сил", 2),
            column("A", "A", "J", "work of the reduced moment since the start", "работа приведённого момента от начала", 3),
        ];
        let axis = Column { quantity: angle, values: self.angles.clone() };
        let notes = if self.proxies.lost().is_empty() { Vec::new() } else { vec![rough()] };
        let extremes = self.extremes.into_iter().filter(|e| e.min <= e.max).collect();
        Dataset { axis: Some(0), columns: std::iter::once(axis).chain(columns).collect(), extremes, notes, ..Dataset::default() }
    }
}

/// Places in [0, 1] where a polynomial passes zero.
fn roots(row: &[f64]) -> Vec<f64> {
    let mut value = |u: f64| crossings::value(row, u);
    let mut sign = 0.0;
    let found = crossings::crossings(row, 0.0, &mut sign);
    let place = |Bracket { from, to, .. }: Bracket| {
        let ends = [value(from), value(to)];
        if from < to { bracketed(&mut value, (from, ends[0]), (to, ends[1])) } else { from }
    };
    found.into_iter().map(place).collect()
}
