//! Rest in twice the digits: where weak springs stand beside hard ones.
//!
//! Beside a spring of 10¹² N/m a displacement of 10⁻¹² m makes as much force as one of 100 m in a spring of 10⁻² N/m. A force that is small beside the largest one
//! of the machine says nothing about the weak spring, and where the machine rests cannot even be written in sixteen digits: at −2943 m their last one is half a newton of
//! the hard spring. So coordinates, forces and their derivatives are taken in twice the digits, and each direction is measured by what holds it:
//!
//! ```text
//! r(z) = 0,  A = ∂r/∂z    A is eliminated with complete pivoting, each entry with the sum t of the terms that it has been made of
//! |pivot| ≤ 10⁻²⁸ t       nothing holds that direction: z stays there, and what is left of the rows must vanish by itself
//! |pivot| ≤ 10⁻⁶ t        a weak spring behind hard ones: single digits do not find its place
//! ```
//!
//! Newton's method is damped in its own metric, the length of the correction, as in single digits ([`super::search`]).
//!
//! *Source*: P. Deuflhard, Newton Methods for Nonlinear Problems, 3.3; running error bounds, N. J. Higham, Accuracy and Stability of Numerical Algorithms, 3.3.

use algebra::double::Double;

/// A pivot below this share of its terms is what 32 digits leave of zero.
const NOTHING: f64 = 1e-28;
/// What single digits leave of zero, some ten units.
const SINGLE: f64 = 1e-14;
/// Below this share single numbers have ten digits left at most.
const WEAK: f64 = 1e-6;
/// What is left of a row that nothing can balance, beside its terms: rounding of 32 digits with some decades to spare.
const BALANCED: f64 = 1e-24;
/// Share of the place by which the last correction may move it.
const SETTLED: f64 = 1e-12;
/// The same up to which a place that single digits gave stands, where corrections come to no end: a multiple zero is approached by a share in each step.
const NEAR: f64 = 1e-3;
/// How far beside the place the weakest stiffness is looked at, as a share of the largest coordinate, and how many times itself it may be there.
const BESIDE: f64 = 1e-9;
const CHANGED: f64 = 10.0;
/// A correction that is more than the rounding of forces and stiffnesses of which none hides behind another, as a share of the place.
const SEEN: f64 = 1e-9;
/// Corrections below this share of the place are followed by no other.
const DONE: f64 = 1e-29;
/// Steps of Newton's method.
const STEPS: usize = 300;
/// Longest change of a coordinate in one step, SI, and steps in a row that are cut to it before it grows.
const LONGEST: f64 = 1.0;
const PATIENCE: usize = 30;
/// Least share of a step: twenty-six halvings.
const LEAST: f64 = 1e-8;
/// Coordinates below this share of the largest on the way are zero.
const WAY: f64 = 1e-28;
/// Coordinates below this many last corrections are zero.
const ROUNDED: f64 = 16.0;
/// Rows or columns beyond which twice the digits cost seconds.
pub(crate) const LARGEST: usize = 160;

/// Rows at a place, and their derivatives by z, row by row.
pub(crate) struct Rows {
    pub(crate) values: Vec<Double>,
    pub(crate) slopes: Vec<Double>,
}

/// Rows of z; none where a formula has no value in twice the digits.
pub(crate) type Law<'l> = &'l dyn Fn(&[Double]) -> Option<Rows>;

/// What is found.
pub(crate) enum Fine {
    /// Single digits say what there is to say: no direction hides behind another, and nothing moves. Or the rows have no such values.
    Plain,
    /// Rest; with the combinations of rows that nothing but themselves balances and what is left of each.
    Rest(Vec<Double>, Vec<Unheld>),
    /// A weak direction is there, and along it no rest was found.
    Nowhere,
}

/// A combination of rows in which no unknown has a part.
pub(crate) struct Unheld {
    pub(crate) rows: Vec<f64>,
    pub(crate) left: f64,
}

/// A number of one or two sets of digits.
pub(crate) trait Digits: Copy + Default {
    /// What is left of zero.
    const NOTHING: f64;
    fn of(value: Double) -> Self;
    /// The nearest single number.
    fn single(self) -> f64;
    /// self - a b / c.
    fn less_ratio(self, a: Self, b: Self, c: Self) -> Self;
}

impl Digits for Double {
    const NOTHING: f64 = NOTHING;
    fn of(value: Double) -> Double {
        value
    }
    fn single(self) -> f64 {
        self.round()
    }
    fn less_ratio(self, a: Double, b: Double, c: Double) -> Double {
        self.plus(a.over(c).negated(), b)
    }
}

impl Digits for f64 {
    const NOTHING: f64 = SINGLE;
    fn of(value: Double) -> f64 {
        value.round()
    }
    fn single(self) -> f64 {
        self
    }
    fn less_ratio(self, a: f64, b: f64, c: f64) -> f64 {
        self - a / c * b
    }
}

/// A matrix with its right side, eliminated with complete pivoting.
struct Eliminated<D> {
    m: usize,
    w: usize,
    /// m x (w + 1), the right side last.
    a: Vec<D>,
    /// Sizes of the terms that each entry is made of.
    terms: Vec<f64>,
    /// (row, column) of the pivots in their order.
    pivots: Vec<(usize, usize)>,
    /// The least share of its terms that a pivot has kept.
    weakest: f64,
    /// What has been taken off each row, m x m.
    rows: Vec<f64>,
}

impl<D: Digits> Eliminated<D> {
    fn new(slopes: &[Double], values: &[Double]) -> Eliminated<D> {
        let (m, w) = (values.len(), slopes.len() / values.len().max(1));
        let entry = |p: usize| {
            let (i, j) = (p / (w + 1), p % (w + 1));
            D::of(if j == w { values[i].negated() } else { slopes[i * w + j] })
        };
        let a: Vec<D> = (0..m * (w + 1)).map(entry).collect();
        let terms = a.iter().map(|v| v.single().abs()).collect();
        let rows = (0..m * m).map(|p| f64::from(u8::from(p / m.max(1) == p % m.max(1)))).collect();
        let mut found = Eliminated { m, w, a, terms, pivots: Vec::new(), weakest: f64::INFINITY, rows };
        found.run();
        found
    }

    /// Scales that bring rows and columns to the size of one: units of coordinates and forces decide no order.
    fn scales(&self) -> (Vec<f64>, Vec<f64>) {
        let unit = |v: f64| if v > 0.0 && v.is_finite() { v.sqrt().recip() } else { 1.0 };
        let (mut rows, mut columns) = (vec![1.0; self.m], vec![1.0; self.w]);
        let stride = self.w + 1;
        // a few rounds bring both to size one
        for _ in 0..4 {
            for (i, row) in rows.iter_mut().enumerate() {
                let most = (0..self.w).fold(0.0_f64, |most, j| most.max(self.a[i * stride + j].single().abs() * *row * columns[j]));
                *row *= unit(most);
            }
            for (j, column) in columns.iter_mut().enumerate() {
                let most = (0..self.m).fold(0.0_f64, |most, i| most.max(self.a[i * stride + j].single().abs() * rows[i] * *column));
                *column *= unit(most);
            }
        }
        (rows, columns)
    }

    fn run(&mut self) {
        let stride = self.w + 1;
        let (rows, columns) = self.scales();
        let (mut left_rows, mut left_columns): (Vec<usize>, Vec<usize>) = ((0..self.m).collect(), (0..self.w).collect());
        loop {
            let size = |i: usize, j: usize| {
                let v = self.a[i * stride + j].single().abs();
                if v > D::NOTHING * self.terms[i * stride + j] { v * rows[i] * columns[j] } else { 0.0 }
            };
            let all = left_rows.iter().flat_map(|i| left_columns.iter().map(move |j| (*i, *j)));
            let Some((i, j)) = all.max_by(|a, b| size(a.0, a.1).total_cmp(&size(b.0, b.1)).then(b.cmp(a))) else { break };
            if size(i, j) == 0.0 {
                break;
            }
            self.weakest = self.weakest.min(self.a[i * stride + j].single().abs() / self.terms[i * stride + j]);
            self.pivots.push((i, j));
            left_rows.retain(|r| *r != i);
            left_columns.retain(|c| *c != j);
            for r in &left_rows {
                self.take(*r, (i, j), &left_columns);
            }
        }
    }

    /// Takes the pivot's row off another one, in the columns that are left and the right side.
    fn take(&mut self, r: usize, (i, j): (usize, usize), columns: &[usize]) {
        let stride = self.w + 1;
        let (own, pivot) = (self.a[r * stride + j], self.a[i * stride + j]);
        if own.single().abs() == 0.0 {
            return;
        }
        let (own_terms, pivot_terms, size) = (self.terms[r * stride + j], self.terms[i * stride + j], pivot.single().abs());
        for c in columns.iter().copied().chain([self.w]) {
            let by = self.a[i * stride + c];
            let made =
                own_terms * by.single().abs() + own.single().abs() * (self.terms[i * stride + c] + by.single().abs() * pivot_terms / size);
            self.terms[r * stride + c] += made / size;
            self.a[r * stride + c] = self.a[r * stride + c].less_ratio(own, by, pivot);
        }
        let share = -own.single() / pivot.single();
        for c in 0..self.m {
            self.rows[r * self.m + c] += share * self.rows[i * self.m + c];
        }
    }
}

impl<D: Digits> Eliminated<D> {
    /// The unknowns that the rows determine; those that no row holds are zero.
    fn solved(&self) -> Vec<D> {
        let stride = self.w + 1;
        let one = D::of(Double::from(1.0));
        let mut z = vec![D::default(); self.w];
        for (k, (i, j)) in self.pivots.iter().enumerate().rev() {
            let later = self.pivots[k + 1..].iter().map(|p| p.1);
            let sum = later.fold(self.a[i * stride + self.w], |sum, c| sum.less_ratio(self.a[i * stride + c], z[c], one));
            z[*j] = D::default().less_ratio(sum, D::of(Double::from(-1.0)), self.a[i * stride + j]);
        }
        z
    }
}

impl Eliminated<Double> {
    /// The direction of the weakest pivot, with the rows before it balanced.
    fn weak_direction(&self) -> Option<Vec<Double>> {
        let stride = self.w + 1;
        let kept = |(i, j): &(usize, usize)| self.a[i * stride + j].single().abs() / self.terms[i * stride + j];
        let last = (0..self.pivots.len()).min_by(|a, b| kept(&self.pivots[*a]).total_cmp(&kept(&self.pivots[*b])))?;
        let mut z = vec![Double::default(); self.w];
        z[self.pivots[last].1] = Double::from(1.0);
        for (k, (i, j)) in self.pivots[..last].iter().enumerate().rev() {
            let later = self.pivots[k + 1..=last].iter().map(|p| p.1);
            let sum = later.fold(Double::default(), |sum, c| sum.plus(self.a[i * stride + c].negated(), z[c]));
            z[*j] = sum.over(self.a[i * stride + j]);
        }
        Some(z)
    }

    /// Combinations of rows that no unknown moves and that do not vanish.
    fn unheld(&self) -> Vec<Unheld> {
        let at = |i: usize| i * (self.w + 1) + self.w;
        let open = (0..self.m).filter(|i| !self.pivots.iter().any(|p| p.0 == *i));
        let left = open.filter(|i| self.a[at(*i)].single().abs() > BALANCED * self.terms[at(*i)]);
        left.map(|i| Unheld { rows: self.rows[i * self.m..(i + 1) * self.m].to_vec(), left: self.a[at(i)].single() }).collect()
    }
}

/// What the search in single digits came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sought {
    /// A place of rest.
    Found,
    /// None.
    Lost,
}

impl Sought {
    /// Whether twice the digits are asked.
    pub(crate) fn asks(self, single: &Single) -> bool {
        single.hides || self == Sought::Found && single.moves
    }
}

/// What single digits say of rows at a place.
pub(crate) struct Single {
    /// A direction hides behind another.
    pub(crate) hides: bool,
    /// A correction of Newton's method that can be seen is left, though the forces are small beside the largest.
    pub(crate) moves: bool,
}

/// What single digits say of rows (row by row as long as z) at z, of which the first `n` components are coordinates.
pub(crate) fn single(values: &[f64], slopes: &[f64], (z, n): (&[f64], usize)) -> Single {
    let m = values.len();
    if m == 0 || m > LARGEST || z.len() > LARGEST {
        return Single { hides: false, moves: false };
    }
    let doubles = |list: &[f64]| list.iter().map(|v| Double::from(*v)).collect::<Vec<_>>();
    let found = Eliminated::<f64>::new(&doubles(slopes), &doubles(values));
    let hides = found.weakest <= WEAK || found.pivots.len() < m.min(z.len());
    Single { hides, moves: share(&doubles(&found.solved()), &doubles(z), n) > SEEN }
}

fn length(z: &[Double]) -> f64 {
    z.iter().map(|v| v.round() * v.round()).sum::<f64>().sqrt()
}

fn largest(list: &[Double]) -> f64 {
    list.iter().fold(0.0_f64, |m, v| m.max(v.round().abs()))
}

/// The largest change of coordinates (the first `n`) and of the others, each beside the largest of its kind.
fn share(step: &[Double], z: &[Double], n: usize) -> f64 {
    let beside = |step: &[Double], z: &[Double]| if largest(step) == 0.0 { 0.0 } else { largest(step) / (largest(step) + largest(z)) };
    beside(&step[..n], &z[..n]).max(beside(&step[n..], &z[n..]))
}

/// Newton's method from z, of which the first `n` components are coordinates.
pub(crate) fn settle(law: Law, start: &[f64], n: usize) -> Fine {
    let mut z: Vec<Double> = start.iter().map(|v| Double::from(*v)).collect();
    let Some(rows) = law(&z) else { return Fine::Plain };
    let mut here = Eliminated::<Double>::new(&rows.slopes, &rows.values);
    let (mut weakest, mut slopes) = (here.weakest, rows.slopes);
    if weakest > WEAK && share(&here.solved(), &z, n) <= SEEN {
        return Fine::Plain;
    }
    let mut seen = [largest(&z[..n]), largest(&z[n..])];
    let (mut longest, mut cut) = (LONGEST, 0);
    for _ in 0..STEPS {
        let step = here.solved();
        let (size, moved) = (length(&step), length(&step[..n]));
        cut = if moved > longest { cut + 1 } else { 0 };
        longest *= if cut > PATIENCE { 2.0 } else { 1.0 };
        let mut part = if moved > longest { longest / moved } else { 1.0 };
        let next = loop {
            let there: Vec<Double> = z.iter().zip(&step).map(|(z, s)| z.add_times(part, *s)).collect();
            let found = law(&there).map(|rows| (Eliminated::<Double>::new(&slopes, &rows.values).solved(), rows));
            if let Some((after, rows)) = found
                && length(&after) <= (1.0 - 0.25 * part) * size
            {
                break Some((there, rows));
            }
            part *= 0.5;
            if part < LEAST {
                break None;
            }
        };
        let Some((there, rows)) = next else {
            return ended(law, (z, &step), (n, seen), (&here, weakest));
        };
        here = Eliminated::<Double>::new(&rows.slopes, &rows.values);
        (z, slopes, weakest) = (there, rows.slopes, weakest.min(here.weakest));
        seen = [seen[0].max(largest(&z[..n])), seen[1].max(largest(&z[n..]))];
        if share(&step, &z, n) <= DONE || largest(&step[..n]) <= DONE * seen[0] {
            return ended(law, (z, &step), (n, seen), (&here, weakest));
        }
    }
    if weakest <= WEAK { Fine::Nowhere } else { Fine::Plain }
}

/// Whether the weakest stiffness is another one beside the place, along its own direction: a multiple zero of the forces and no weak spring.
fn bends(law: Law, z: &[Double], n: usize, here: &Eliminated<Double>) -> bool {
    let Some(weak) = here.weak_direction() else { return false };
    let (size, longest) = (largest(&z[..n]), largest(&weak[..n]));
    if longest == 0.0 {
        return false;
    }
    let by = BESIDE * if size > 0.0 { size } else { 1.0 } / longest;
    let there: Vec<Double> = z.iter().zip(&weak).map(|(z, v)| z.add_times(by, *v)).collect();
    let found = law(&there).map(|rows| Eliminated::<Double>::new(&rows.slopes, &rows.values).weakest);
    found.is_none_or(|weakest| weakest > CHANGED * here.weakest)
}

/// What is found where corrections come to an end.
fn ended(
    law: Law,
    (mut z, step): (Vec<Double>, &[Double]),
    (n, seen): (usize, [f64; 2]),
    (here, weakest): (&Eliminated<Double>, f64),
) -> Fine {
    // a place that is zero is measured by the way that has led to it
    let beside = |step: &[Double], z: &[Double], seen: f64| {
        let step = largest(step);
        if step == 0.0 { 0.0 } else { step / (step + largest(z) + SINGLE * seen) }
    };
    let off = beside(&step[..n], &z[..n], seen[0]).max(beside(&step[n..], &z[n..], seen[1]));
    let unsettled = off > SETTLED;
    if unsettled && (weakest > WEAK || off <= NEAR) || bends(law, &z, n, here) {
        return Fine::Plain;
    }
    if unsettled {
        return Fine::Nowhere;
    }
    // what has come down from far away to a rounding of the way is zero
    let rounding = (ROUNDED * largest(&step[..n])).max(WAY * seen[0]);
    z[..n].iter_mut().filter(|v| v.round().abs() <= rounding).for_each(|v| *v = Double::default());
    Fine::Rest(z, here.unheld())
}
