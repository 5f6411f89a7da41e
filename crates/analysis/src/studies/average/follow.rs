//! Answers of the rest over the speed, followed as branches: over their folds by pseudo-arclength, and from several starts.
//!
//! ```text
//! R(q, Ω) = 0,      t · (z - z0 - h t) = 0      z = (q at n instants, Ω) in scales, t the tangent of the branch
//! ```
//!
//! Where the rest is linear there is one answer at each speed. Otherwise a branch comes back over its folds with all answers that hang together; others are sought from starts of other sizes.
//! *Source*: H. B. Keller, Numerical solution of bifurcation and nonlinear eigenvalue problems (1977).

use super::resonances::{nearest, resonances};
use super::turn::{Grid, INSTANTS, NEAR, Place, Turn, Turning, greatest, turn};
use algebra::elementary;
use algebra::lu::Lu;
use algebra::vectors::norm;
use std::f64::consts::TAU;

/// Corrections of a point.
const STEPS: usize = 16;
/// Share of the one before below which a correction shows that the derivatives are still good.
const SLOW: f64 = 0.1;
/// A step below this, in scales, is rounding of the derivatives' differences by the speed.
const ENOUGH: f64 = 1e-11;
/// Where steps end to fall, a point is known to this.
const ROUGH: f64 = 1e-9;
/// Relative step of the speed for differences: half of the digits.
const SLOPE: f64 = 1e-6;
/// Step along the tangent for the slope of L, in scales: the third derivative by its square, and the rounding of L over it, are both 1e-8 of the moments at most.
const ALONG: f64 = 1e-5;
/// First step; the whole range of speeds is 1.
const FIRST: f64 = 2e-3;
/// A step below this cannot be told from rounding of the corrections.
const SHORTEST: f64 = 1e-8;
/// Longest step: answers are of the size 1 as well; of larger ones it is this share.
const LONGEST: f64 = 0.02;
/// Cosine of the angle between the tangents at both ends of a step: 18 degrees, beyond which a step may lead to another branch.
const STRAIGHT: f64 = 0.95;
/// The cosine below which the next step is not longer.
const LEVEL: f64 = 0.995;
/// A point may lie this share of the step from its guess.
const BESIDE: f64 = 0.3;
/// Most points of a branch in one direction.
const POINTS: usize = 4000;
/// Share of the harmonics above a third of the instants' number in the largest: what a cubic force folds back is then below 1e-10 of the moments.
const TAIL: f64 = 1e-11;
/// Answers that are one, in scales: corrections end far below.
const SAME: f64 = 1e-6;
/// Share of the distance to a resonance of the linear equations beside an answer by which a step may change the speed: one that is narrower than the step is not passed over.
const APPROACH: f64 = 0.5;

/// The size of an answer, in scales: those of the coordinates are taken from the answers that were known before, which may be small ones.
fn size_of(z: &[f64]) -> f64 {
    norm(&z[..z.len().saturating_sub(1)]).max(1.0)
}

/// A point of a branch.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Point {
    pub(super) turn: Turn,
    /// Direction of the branch, of unit length in scales.
    tangent: Vec<f64>,
    /// Derivative of L by the length of the branch, in scales.
    pub(super) slope: f64,
}

impl Point {
    /// How fast the speed changes along the branch, in scales.
    pub(super) fn forwards(&self) -> f64 {
        self.tangent.last().copied().unwrap_or(0.0)
    }
}

/// Answers that hang together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Branch {
    pub(super) points: Vec<Point>,
    /// Ends within the range of speeds: an undamped resonance, or an answer that is not smooth enough.
    pub broken: usize,
}

impl Branch {
    /// The answers in order.
    pub fn turns(&self) -> impl Iterator<Item = &Turn> {
        self.points.iter().map(|point| &point.turn)
    }

    /// Number of places at which the speed turns.
    pub fn folds(&self) -> usize {
        let way = |pair: &[Point]| pair[1].turn.speed > pair[0].turn.speed;
        self.points.windows(3).filter(|three| way(&three[..2]) != way(&three[1..])).count()
    }
}

/// What lengths along branches are measured by.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Ruler {
    /// Slowest and fastest speed.
    ends: [f64; 2],
    /// Sizes of the coordinates.
    sizes: Vec<f64>,
}

impl Ruler {
    pub(super) fn new(others: usize, speeds: &[f64], found: &[Option<Turn>]) -> Ruler {
        let ends = [speeds.first(), speeds.last()].map(|end| end.copied().unwrap_or_default());
        let largest = |j: usize| {
            let values = found.iter().flatten().flat_map(|turn| turn.values.iter().skip(j).step_by(others.max(1)));
            values.fold(0.0_f64, |l, v| l.max(v.abs()))
        };
        let sizes = (0..others).map(largest).map(|size| if size > 0.0 { size } else { 1.0 }).collect();
        Ruler { ends, sizes }
    }

    /// Whether a speed lies between the slowest and the fastest.
    pub(super) fn covers(&self, speed: f64) -> bool {
        speed >= self.ends[0] && speed <= self.ends[1]
    }
}

/// Branches that were found.
pub(super) struct Followed {
    pub(super) branches: Vec<Branch>,
    /// From how many starts others were sought; none where the rest is linear.
    pub(super) starts: Option<usize>,
    /// Speeds on and beside resonances at which there is no answer.
    pub(super) unseen: usize,
    /// What their lengths are measured by.
    pub(super) ruler: Ruler,
}

/// Follows the answers of a machine.
pub(super) struct Walker<'a, T: ?Sized> {
    machine: &'a T,
    ruler: &'a Ruler,
    grids: Vec<Grid>,
}

/// The branches of answers that the turns at ascending speeds lead to.
pub(super) fn all<T: Turning + ?Sized>(machine: &T, speeds: &[f64], found: &[Option<Turn>]) -> Followed {
    let ruler = Ruler::new(machine.others(), speeds, found);
    let walker = Walker::new(machine, &ruler);
    if walker.is_linear(found) {
        let (all, unseen) = with_resonances(machine, found);
        let ruler = Ruler::new(machine.others(), speeds, &all);
        let branches = Walker::new(machine, &ruler).single(&all);
        return Followed { branches, starts: None, unseen, ruler };
    }
    let (branches, starts) = walker.several(speeds, found);
    Followed { branches, starts: Some(starts), unseen: 0, ruler }
}

/// The answers of a linear rest with those on and beside its resonances, and how many of these there are not.
fn with_resonances<T: Turning + ?Sized>(machine: &T, found: &[Option<Turn>]) -> (Vec<Option<Turn>>, usize) {
    let (mut all, mut unseen) = (Vec::new(), 0);
    for part in found.split_inclusive(Option::is_none) {
        let known: Vec<&Turn> = part.iter().flatten().collect();
        let speeds: Vec<f64> = known.iter().map(|turn| turn.speed).collect();
        let mut own: Vec<Turn> = known.into_iter().cloned().collect();
        for speed in resonances(machine, &speeds) {
            let answer = turn(machine, speed, part[0].as_ref());
            unseen += usize::from(answer.is_none());
            own.extend(answer);
        }
        own.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        own.dedup_by(|a, b| a.speed == b.speed);
        all.extend(own.into_iter().map(Some));
        all.extend(part.last().filter(|turn| turn.is_none()).cloned());
    }
    (all, unseen)
}

impl<'a, T: Turning + ?Sized> Walker<'a, T> {
    pub(super) fn new(machine: &'a T, ruler: &'a Ruler) -> Walker<'a, T> {
        Walker { machine, ruler, grids: INSTANTS.iter().map(|n| Grid::new(*n, ruler.sizes.len())).collect() }
    }

    pub(super) fn machine(&self) -> &'a T {
        self.machine
    }

    /// Sizes of the coordinates.
    pub(super) fn sizes(&self) -> &[f64] {
        &self.ruler.sizes
    }

    pub(super) fn range(&self) -> f64 {
        self.ruler.ends[1] - self.ruler.ends[0]
    }

    fn grid(&self, values: &[f64]) -> &Grid {
        let n = values.len() / self.ruler.sizes.len().max(1);
        self.grids.iter().find(|grid| grid.n == n || self.ruler.sizes.is_empty()).unwrap_or(&self.grids[0])
    }

    /// Whether the derivatives of the equations of the rest are the same wherever it is.
    fn is_linear(&self, found: &[Option<Turn>]) -> bool {
        let m = self.ruler.sizes.len();
        let Some(known) = found.iter().flatten().next().filter(|_| m > 0) else { return true };
        let at = |angle: f64, share: f64| {
            let of = |by: f64| -> Vec<f64> { self.ruler.sizes.iter().map(|s| share * s * by).collect() };
            let (values, rates, accelerations) = (of(0.7), of(known.speed), of(known.speed * known.speed));
            let place = Place { angle, speed: known.speed, values: &values, rates: &rates, accelerations: &accelerations };
            self.machine.at(&place).slopes
        };
        (0..7).all(|k| {
            let (here, there, far) = (at(k as f64, 0.0), at(k as f64, 1.0), at(k as f64, -30.0));
            // rows by three derivatives of each coordinate: an entry counts beside its row
            here.chunks(3 * m).zip(there.chunks(3 * m)).zip(far.chunks(3 * m)).all(|((a, b), c)| {
                let size = a.iter().chain(b).chain(c).fold(0.0_f64, |l, v| l.max(v.abs()));
                a.iter().zip(b).zip(c).all(|((a, b), c)| (a - b).abs().max((a - c).abs()) <= 1e-12 * size) // rounding of sums of terms
            })
        })
    }

    /// The answers of a linear rest, one at each speed: they hang together but where there is none.
    fn single(&self, found: &[Option<Turn>]) -> Vec<Branch> {
        let parts = found.split(Option::is_none).filter(|part| !part.is_empty());
        let whole = |part: &[Option<Turn>]| {
            let points = part.iter().flatten().filter_map(|turn| self.at(turn.clone(), 1.0)).collect();
            let mut branch = Branch { points, broken: 0 };
            self.see_tops(&mut branch);
            branch
        };
        parts.map(whole).collect()
    }

    /// Follows the branch of an answer unless it is known.
    pub(super) fn take(&self, branches: &mut Vec<Branch>, seed: &Turn) {
        if branches.iter().any(|branch| self.passes(branch, seed)) {
            return;
        }
        if let Some(branch) = self.whole(seed) {
            branches.push(branch);
        }
    }

    /// Whether an answer lies on a branch.
    fn passes(&self, branch: &Branch, seed: &Turn) -> bool {
        let grid = self.grid(&seed.values);
        let straddles = |pair: &&[Point]| {
            let [a, b] = [&pair[0].turn, &pair[1].turn].map(|turn| turn.speed - seed.speed);
            a * b <= 0.0
        };
        branch.points.windows(2).filter(straddles).any(|pair| {
            let (a, b) = (&pair[0].turn, &pair[1].turn);
            let share = if a.speed == b.speed { 0.0 } else { (seed.speed - a.speed) / (b.speed - a.speed) };
            let (u, v) = (grid.taken(Some(&a.values)), grid.taken(Some(&b.values)));
            let guess: Vec<f64> = u.iter().zip(&v).map(|(u, v)| u + share * (v - u)).collect();
            let ends = self.apart(&u, &v);
            let near = self.apart(&guess, &seed.values);
            let polished = || grid.turn(self.machine, seed.speed, Some(&guess));
            near <= SAME || near <= 2.0 * ends && polished().is_some_and(|turn| self.apart(&turn.values, &seed.values) <= SAME)
        })
    }

    /// Largest difference of two answers at the same instants, in scales.
    fn apart(&self, a: &[f64], b: &[f64]) -> f64 {
        let m = self.ruler.sizes.len().max(1);
        a.iter().zip(b).enumerate().map(|(e, (a, b))| ((a - b) / self.ruler.sizes[e % m]).abs()).fold(0.0, f64::max)
    }

    /// Unknowns in scales: a motion counts by its mean square.
    fn unknowns(&self, values: &[f64], speed: f64) -> Vec<f64> {
        let m = self.ruler.sizes.len().max(1);
        let root = ((values.len() / m).max(1) as f64).sqrt();
        let scaled = values.iter().enumerate().map(|(e, v)| v / (self.ruler.sizes[e % m] * root));
        scaled.chain([speed / self.range()]).collect()
    }

    fn known(&self, z: &[f64]) -> (Vec<f64>, f64) {
        let m = self.ruler.sizes.len().max(1);
        let count = z.len() - 1;
        let root = ((count / m).max(1) as f64).sqrt();
        let values = z[..count].iter().enumerate().map(|(e, v)| v * self.ruler.sizes[e % m] * root).collect();
        (values, z[count] * self.range())
    }

    /// Derivatives of the residuals by the unknowns, each row by its largest entry, and these; none where they are no numbers.
    fn equations(&self, grid: &Grid, z: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
        let (values, speed) = self.known(z);
        let (m, count) = (self.ruler.sizes.len().max(1), values.len());
        let root = (grid.n as f64).sqrt();
        let of = |speed: f64| grid.left(self.machine, speed, &values);
        let instants = grid.instants(self.machine, speed, &values);
        let by_values = grid.matrix(&instants, speed);
        let step = SLOPE * speed.abs();
        let (behind, before) = (of(speed + step), of(speed - step));
        let (mut rows, mut sizes) = (Vec::with_capacity(count * (count + 1)), Vec::with_capacity(count));
        for i in 0..count {
            let row = (0..count).map(|j| by_values[i * count + j] * self.ruler.sizes[j % m] * root);
            let row: Vec<f64> = row.chain([(behind[i] - before[i]) / (2.0 * step) * self.range()]).collect();
            let size = row.iter().fold(f64::MIN_POSITIVE, |l, v| l.max(v.abs()));
            rows.extend(row.iter().map(|v| v / size));
            sizes.push(size);
        }
        rows.iter().all(|v| v.is_finite()).then_some((rows, sizes))
    }

    /// The answer in the plane through z across a direction.
    fn corrected(&self, grid: &Grid, mut z: Vec<f64>, normal: &[f64]) -> Option<Vec<f64>> {
        let k = z.len();
        let large = size_of(&z);
        let (mut last, mut slopes) = (f64::INFINITY, None);
        for _ in 0..STEPS {
            // the derivatives of the guess, as long as they bring a digit a step
            let (lu, sizes) = match slopes.take() {
                Some(known) => known,
                None => {
                    let (mut rows, sizes) = self.equations(grid, &z)?;
                    rows.extend(normal);
                    (Lu::exact(&rows, k)?, sizes)
                }
            };
            let (values, speed) = self.known(&z);
            let mut right = grid.left(self.machine, speed, &values);
            right.iter_mut().zip(&sizes).for_each(|(r, size)| *r /= size);
            right.push(0.0);
            let step = lu.solve(&right)?;
            let size = norm(&step);
            slopes = Some((lu, sizes)).filter(|_| size <= SLOW * last || last == f64::INFINITY);
            if !size.is_finite() || size > 2.0 * last {
                return (last <= ROUGH * large).then_some(z);
            }
            z.iter_mut().zip(&step).for_each(|(z, s)| *z -= s);
            if size <= ENOUGH * large || size >= 0.5 * last && last <= ROUGH * large {
                return Some(z);
            }
            last = size;
        }
        (last <= ROUGH * large).then_some(z)
    }

    /// The direction of the branch at z, which goes on as another one.
    fn tangent(&self, grid: &Grid, z: &[f64], towards: &[f64]) -> Option<Vec<f64>> {
        let k = z.len();
        let (mut rows, _) = self.equations(grid, z)?;
        rows.extend(towards);
        let unit: Vec<f64> = (0..k).map(|i| if i + 1 == k { 1.0 } else { 0.0 }).collect();
        let t = Lu::exact(&rows, k)?.solve(&unit)?;
        let length = norm(&t);
        (length > 0.0 && length.is_finite()).then(|| t.iter().map(|t| t / length).collect())
    }

    fn point(&self, grid: &Grid, z: &[f64], towards: &[f64]) -> Option<Point> {
        let tangent = self.tangent(grid, z, towards)?;
        let (values, speed) = self.known(z);
        self.pointed(grid.told(self.machine, speed, values)?, tangent)
    }

    /// Whether the highest harmonics of an answer are rounding.
    fn resolved(&self, grid: &Grid, values: &[f64]) -> bool {
        let m = self.ruler.sizes.len();
        let around: Vec<(f64, f64)> = (0..grid.n).map(|i| elementary::sin_cos(TAU * i as f64 / grid.n as f64)).collect();
        let amplitude = |j: usize, k: usize| {
            let sums = (0..grid.n).fold([0.0, 0.0], |[c, s], i| {
                let (sin, cos) = around[i * k % grid.n];
                [c + values[i * m + j] * cos, s + values[i * m + j] * sin]
            });
            elementary::hypot(sums[0], sums[1])
        };
        let all: Vec<Vec<f64>> = (0..m).map(|j| (0..=grid.n / 2).map(|k| amplitude(j, k)).collect()).collect();
        let largest = |list: &[f64]| list.iter().fold(0.0_f64, |l, v| l.max(*v));
        let size = |j: usize| largest(&all[j]).max(TAIL * self.ruler.sizes[j] * grid.n as f64);
        (0..m).all(|j| largest(&all[j][grid.n / 3 + 1..]) <= TAIL * size(j))
    }

    /// Unknowns and a direction at the next finer instants.
    fn finer(&self, z: &[f64], t: &[f64]) -> Option<(&Grid, Vec<f64>, Vec<f64>)> {
        let (values, speed) = self.known(z);
        let n = values.len() / self.ruler.sizes.len().max(1);
        let grid = self.grids.iter().find(|grid| grid.n > n)?;
        let (along, rate) = self.known(t);
        let z = self.unknowns(&grid.taken(Some(&values)), speed);
        Some((grid, z, self.unknowns(&grid.taken(Some(&along)), rate)))
    }

    /// The branch through an answer, in both directions.
    fn whole(&self, seed: &Turn) -> Option<Branch> {
        let mut grid = self.grid(&seed.values);
        let mut z = self.unknowns(&seed.values, seed.speed);
        let mut up: Vec<f64> = (0..z.len()).map(|i| if i + 1 == z.len() { 1.0 } else { 0.0 }).collect();
        while !self.resolved(grid, &self.known(&z).0) {
            (grid, z, up) = self.finer(&z, &up)?;
            z = self.corrected(grid, z, &up)?;
        }
        let start = self.point(grid, &z, &up)?;
        let (forth, mut broken, closed) = self.one_way(&start);
        let mut points = Vec::new();
        if !closed {
            let back = Point { tangent: start.tangent.iter().map(|t| -t).collect(), slope: -start.slope, ..start };
            let (list, more, _) = self.one_way(&back);
            broken += more;
            points.extend(list.into_iter().skip(1).rev());
            for point in &mut points {
                let Point { tangent, slope, .. } = point;
                tangent.iter_mut().chain([slope]).for_each(|t| *t = -*t);
            }
        }
        points.extend(forth);
        Some(Branch { points, broken })
    }

    /// The points from one on, how many ends lie within the range, and whether they come back.
    fn one_way(&self, start: &Point) -> (Vec<Point>, usize, bool) {
        let mut list = vec![start.clone()];
        let mut h = FIRST.min(self.stride(start));
        while list.len() < POINTS {
            let Some(a) = list.last().cloned() else { break };
            let speed = a.turn.speed;
            let inwards = |end: f64, sign: f64| (speed - end) * sign >= 0.0 && a.forwards() * sign >= 0.0;
            // beyond an end, or on it and on the way out
            if list.len() > 1 && (speed < self.ruler.ends[0] || speed > self.ruler.ends[1])
                || inwards(self.ruler.ends[1], 1.0)
                || inwards(self.ruler.ends[0], -1.0)
            {
                return (list, 0, false);
            }
            let Some((b, cosine)) = self.step(&a, h) else {
                h *= 0.5;
                if h < SHORTEST {
                    return (list, 1, false);
                }
                continue;
            };
            let closed = list.len() > 3 && self.closes(start, &a, &b);
            h = if cosine > LEVEL { 1.5 * h } else { h }.min(self.stride(&b));
            list.push(if closed { start.clone() } else { b });
            if closed {
                return (list, 0, true);
            }
        }
        (list, 1, false)
    }

    /// The size of an answer in scales, 1 at least.
    pub(super) fn size(&self, a: &Point) -> f64 {
        size_of(&self.unknowns(&a.turn.values, a.turn.speed))
    }

    /// The longest step from a point: the sizes of the coordinates are those of the answers that were known before, which may be small ones.
    fn longest(&self, a: &Point) -> f64 {
        LONGEST * self.size(a)
    }

    /// The longest next step from a point, that passes over no resonance.
    fn stride(&self, a: &Point) -> f64 {
        let forwards = a.forwards().abs() * self.range();
        let longest = self.longest(a);
        if forwards * longest <= 0.0 {
            return longest;
        }
        let grid = self.grid(&a.turn.values);
        let speed = a.turn.speed;
        let slopes: Vec<Vec<f64>> = grid.instants(self.machine, speed, &a.turn.values).into_iter().map(|instant| instant.slopes).collect();
        let excited = |k: usize| {
            let strong = |j: usize| {
                let [c, s] = grid.harmonic(&a.turn.values, j, k);
                c.abs().max(s.abs()) > TAIL * self.ruler.sizes[j]
            };
            (0..self.ruler.sizes.len()).any(strong)
        };
        let away = nearest(&slopes, speed, &excited);
        longest.min((APPROACH * away / forwards).max(SHORTEST))
    }

    /// A step along the tangent, and the cosine of the angle by which it turns; none where it is too long.
    fn step(&self, a: &Point, h: f64) -> Option<(Point, f64)> {
        let mut grid = self.grid(&a.turn.values);
        let (mut z, mut t) = (self.unknowns(&a.turn.values, a.turn.speed), a.tangent.clone());
        z.iter_mut().zip(&t).for_each(|(z, t)| *z += h * t);
        let guess = z.clone();
        z = self.corrected(grid, z, &t)?;
        let off: Vec<f64> = z.iter().zip(&guess).map(|(z, g)| z - g).collect();
        if norm(&off) > BESIDE * h {
            return None;
        }
        while !self.resolved(grid, &self.known(&z).0) {
            (grid, z, t) = self.finer(&z, &t)?;
            z = self.corrected(grid, z, &t)?;
        }
        let b = self.point(grid, &z, &t)?;
        let cosine: f64 = t.iter().zip(&b.tangent).map(|(a, b)| a * b).sum();
        (cosine >= STRAIGHT).then_some((b, cosine))
    }

    /// Whether a branch has come back to its start on the way from a to b.
    fn closes(&self, start: &Point, a: &Point, b: &Point) -> bool {
        // a step changes the speed by less than itself
        let longest = self.longest(a).max(self.longest(b)) * self.range();
        if (start.turn.speed - a.turn.speed).abs().min((start.turn.speed - b.turn.speed).abs()) > longest {
            return false;
        }
        let grid = &self.grids[self.grids.len() - 1];
        let at = |point: &Point| self.unknowns(&grid.taken(Some(&point.turn.values)), point.turn.speed);
        let (from, a, b) = (at(start), at(a), at(b));
        let way: Vec<f64> = b.iter().zip(&a).map(|(b, a)| b - a).collect();
        let there: Vec<f64> = from.iter().zip(&a).map(|(f, a)| f - a).collect();
        let length: f64 = way.iter().map(|w| w * w).sum();
        let share = way.iter().zip(&there).map(|(w, t)| w * t).sum::<f64>() / length;
        let off: Vec<f64> = there.iter().zip(&way).map(|(t, w)| t - share * w).collect();
        // a chord of a step leaves the branch by less than a twentieth of itself
        (0.0..=1.0).contains(&share) && norm(&off) <= 0.05 * length.sqrt()
    }

    /// Adds points where V is greatest between neighbours of a linear rest: a resonance may be narrower than the distance of the speeds.
    fn see_tops(&self, branch: &mut Branch) {
        let old = std::mem::take(&mut branch.points);
        let mut between: Vec<(usize, Point)> = Vec::new();
        let resonance = |turn: &Turn| turn.vibration.abs();
        for (k, three) in old.windows(3).enumerate() {
            let [a, b, c] = [&three[0].turn, &three[1].turn, &three[2].turn];
            if resonance(b) < resonance(a).max(resonance(c)) || resonance(b) == resonance(a).min(resonance(c)) {
                continue;
            }
            if let Some(top) = greatest(self.machine, ([a.speed, c.speed], b), NEAR, &resonance) {
                let behind = if top.speed > b.speed { k + 2 } else { k + 1 };
                between.extend(self.at(top, 1.0).map(|point| (behind, point)));
            }
        }
        for (k, point) in old.into_iter().enumerate() {
            let mut inside: Vec<Point> = between.iter().filter(|(behind, _)| *behind == k).map(|(_, point)| point.clone()).collect();
            inside.sort_by(|a, b| a.turn.speed.total_cmp(&b.turn.speed));
            inside.dedup_by(|a, b| (a.turn.speed - b.turn.speed).abs() <= 2.0 * NEAR * b.turn.speed.abs());
            branch.points.extend(inside);
            branch.points.push(point);
        }
    }

    /// The answer at a distance from a point along its tangent.
    pub(super) fn beside(&self, a: &Point, s: f64) -> Option<Point> {
        let grid = self.grid(&a.turn.values);
        let mut z = self.unknowns(&a.turn.values, a.turn.speed);
        z.iter_mut().zip(&a.tangent).for_each(|(z, t)| *z += s * t);
        let z = self.corrected(grid, z, &a.tangent)?;
        self.point(grid, &z, &a.tangent)
    }

    /// The answer between two neighbours at a share of the way.
    pub(super) fn between(&self, a: &Point, b: &Point, share: f64) -> Option<Point> {
        let (grid, z, normal) = self.unknowns_between(a, b, share)?;
        self.point(grid, &z, &normal)
    }

    /// L there.
    pub(super) fn balance_between(&self, a: &Point, b: &Point, share: f64) -> Option<f64> {
        let (grid, z, _) = self.unknowns_between(a, b, share)?;
        let (values, speed) = self.known(&z);
        Some(grid.balance(self.machine, speed, &values))
    }

    /// The unknowns of it, in the plane across the chord, and the direction of the chord.
    fn unknowns_between(&self, a: &Point, b: &Point, share: f64) -> Option<(&Grid, Vec<f64>, Vec<f64>)> {
        let grid = self.grid(if a.turn.values.len() > b.turn.values.len() { &a.turn.values } else { &b.turn.values });
        let at = |point: &Point| self.unknowns(&grid.taken(Some(&point.turn.values)), point.turn.speed);
        let (from, to) = (at(a), at(b));
        let way: Vec<f64> = to.iter().zip(&from).map(|(b, a)| b - a).collect();
        let z: Vec<f64> = from.iter().zip(&way).map(|(a, w)| a + share * w).collect();
        let length = norm(&way);
        let normal: Vec<f64> = way.iter().map(|w| w / length).collect();
        Some((grid, self.corrected(grid, z, &normal)?, normal))
    }

    /// The point of an answer, on a branch along which the speed changes this way.
    pub(super) fn at(&self, turn: Turn, way: f64) -> Option<Point> {
        let z = self.unknowns(&turn.values, turn.speed);
        let along: Vec<f64> = (0..z.len()).map(|i| if i + 1 == z.len() { way } else { 0.0 }).collect();
        let tangent = self.tangent(self.grid(&turn.values), &z, &along)?;
        self.pointed(turn, tangent)
    }

    /// An answer with the direction of its branch, and the slope of L: L is a function of the unknowns, and beside the branch by the square of the step along its tangent.
    fn pointed(&self, turn: Turn, tangent: Vec<f64>) -> Option<Point> {
        let grid = self.grid(&turn.values);
        let z = self.unknowns(&turn.values, turn.speed);
        let step = ALONG * size_of(&z);
        let [behind, before] = [step, -step].map(|by| {
            let (values, speed) = self.known(&z.iter().zip(&tangent).map(|(z, t)| z + by * t).collect::<Vec<f64>>());
            grid.balance(self.machine, speed, &values)
        });
        let slope = (behind - before) / (2.0 * step);
        slope.is_finite().then_some(Point { turn, tangent, slope })
    }

    /// The same answers where only what acts on the angle has changed.
    pub(super) fn told_again(&self, branch: &Branch) -> Option<Branch> {
        let again = |point: &Point| {
            let turn = self.grid(&point.turn.values).told(self.machine, point.turn.speed, point.turn.values.clone())?;
            self.pointed(turn, point.tangent.clone())
        };
        let points = branch.points.iter().map(again).collect::<Option<Vec<Point>>>()?;
        Some(Branch { points, broken: branch.broken })
    }

    /// Distance of two points in scales.
    pub(super) fn distance(&self, a: &Point, b: &Point) -> f64 {
        let grid = &self.grids[self.grids.len() - 1];
        let at = |point: &Point| self.unknowns(&grid.taken(Some(&point.turn.values)), point.turn.speed);
        norm(&at(a).iter().zip(at(b)).map(|(a, b)| a - b).collect::<Vec<f64>>())
    }
}
