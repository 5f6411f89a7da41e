//! Places of rest at which the stiffness vanishes in a direction: what decides there is the force of higher order.
//!
//! Where V' has a double zero Newton's method comes to within the root of a rounding, δ ~ √ε, and finds the stiffness 2kδ there, of either sign: any verdict of
//! small motions is one on rounding. So the force itself is followed to both sides of the place, along the direction u of each stiffness κ, with all other
//! directions relaxed:
//!
//! ```text
//! g(s) = V'(q₀ + s u + w(s)),    w such that the forces along the others vanish,    s = ... 10⁻², both signs
//! g(s) ≈ κ s                               a stiffness like any other
//! s g(s) > 0 on both sides                 a minimum whatever its order (x⁴):                stable, if all others are
//! s g(s) < 0 on one side or both           the energy falls there (a fold x³, a top -x⁴):    unstable (Chetaev)
//! g = 0 but for rounding                   a free motion
//! ```
//!
//! Where loads have no energy C is not symmetric, and a direction in which uᵀ C u vanishes is none in which C does. There the directions come in pairs of C = Σ σ l rᵀ:
//! displacements go along r, forces are taken along l, and σ stands for κ.
//!
//! g is looked at at the smallest s where |g| is clear of its rounding, on two steps in a row. A minimum of the energy is stable (Lagrange, Dirichlet), for any order. Loads that
//! have no energy, gyroscopic forces and two such directions at once leave it open.
//!
//! *Source*: D. R. Merkin, Introduction to the Theory of Stability, ch. 3; the reduction to the directions that are left, K. Huseyin, Nonlinear Theory of
//! Elastic Stability, ch. 2.

use super::fall::Slope;
use super::stability::scales;
use crate::linear::{LinearMachine, Matrices, Place, largest, parts};
use crate::rest::search::Statics;
use crate::rest::sizes::Sizes;
use algebra::eigen;
use algebra::lu::Lu;
use algebra::vectors::{dot, norm};
use words::Text;

/// The least and the largest displacement, of the coordinate that moves most, relative to its size; and the ratio of two that follow each other.
const LEAST: f64 = 1e-14;
const MOST: f64 = 0.1;
const APART: f64 = 3.2;
/// Displacements at which a stiffness is looked at before the force is followed.
const LOOKS: [f64; 2] = [1e-3, 1e-6];
/// The same where nothing acts on a line of places.
const SHOWN: [f64; 6] = [1e-5, 1e-3, 1e-2, 0.1, FAR, 1.0];
/// Where sums of the order of one cancel, as those of (1 - cos s)⁴ expanded, a force of high order is clear of them no sooner.
const FAR: f64 = 0.45;
/// Change of the force over a look beside what the stiffness makes of it, beyond which it is followed.
const BENT: f64 = 30.0;
/// The same where the force is clear of its rounding: a line is off by the rounding and by the bend of a regular place, both far less.
const STRAIGHT: f64 = 0.5;
/// Rounding of a force, relative to the terms that meet in it: some sums of them, and the place that is drawn onto the connections.
const ROUNDED: f64 = 32.0 * f64::EPSILON;
/// What is clear of rounding, in units of it. At a double zero s is then thirty times the distance that Newton's method leaves.
const CLEAR: f64 = 1e3;
/// How far beside a place its stiffness is asked, in units of what rounding leaves unknown of it.
const UNSURE: f64 = 4.0;
/// A stiffness is clear of its own rounding from so many times it on.
const SEEN: f64 = 64.0;
/// Displacements at which a weak stiffness makes nothing of the force but rounding.
const BESIDE: [f64; 4] = [1e-10, 3e-10, 1e-9, 3e-9];
/// Steps of the relaxation; each leaves a share like s.
const STEPS: usize = 12;
/// Share of the stiffness that loads without energy may have.
const ODD: f64 = 1e-9;
/// Share of a matrix that its odd part may have where it is symmetric but for rounding: entries are sums of some dozens of terms.
const EVEN: f64 = 256.0 * f64::EPSILON;
/// Singular values below this share of the largest, about the root of a rounding, have left vectors of their own: Aᵀ A knows none of them from zero.
const FLAT: f64 = 1e-7;
/// Share of the largest stiffness, coordinates alike, that counts as none beside a contact that touches.
const NEARLY: f64 = 1e-9;
/// Most directions that are looked at.
const DIRECTIONS: usize = 24;

/// What is known of a degenerate place of rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Degenerate {
    /// The verdict of the force of higher order; none where it leaves it open.
    pub stable: Option<bool>,
    /// Stiffnesses κ that are rounding, each with what they stand for in C, κ l rᵀ, by coordinate.
    flat: Vec<Rounded>,
}

/// A part κ l rᵀ of C.
#[derive(Clone, Debug, PartialEq)]
struct Rounded {
    stiffness: f64,
    left: Vec<f64>,
    right: Vec<f64>,
}

impl Degenerate {
    /// Directions whose stiffness is rounding.
    pub fn directions(&self) -> usize {
        self.flat.len()
    }

    /// The matrices without that rounding.
    pub fn settle(&self, matrices: &mut Matrices) {
        let n = matrices.n;
        for part in &self.flat {
            for (p, entry) in matrices.stiffness.iter_mut().enumerate() {
                let rounded = part.stiffness * part.left[p / n] * part.right[p % n];
                let rest = *entry - rounded;
                // where nothing else stood only the rounding of both is left
                *entry = if rest.abs() <= ROUNDED * (entry.abs() + rounded.abs()) { 0.0 } else { rest };
            }
        }
    }
}

/// Sides of a place on which a direction is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sides {
    Both,
    Ahead,
    Behind,
    Neither,
}

impl Sides {
    /// Those of them on which a gap with this slope along the direction does not close.
    pub(super) fn within(self, slope: f64) -> Sides {
        match (self, slope) {
            (Sides::Both | Sides::Ahead, a) if a > 0.0 => Sides::Ahead,
            (Sides::Both | Sides::Behind, a) if a < 0.0 => Sides::Behind,
            (sides, 0.0) => sides,
            _ => Sides::Neither,
        }
    }

    fn signs(self) -> &'static [f64] {
        match self {
            Sides::Both => &[1.0, -1.0],
            Sides::Ahead => &[1.0],
            Sides::Behind => &[-1.0],
            Sides::Neither => &[],
        }
    }
}

/// How the force goes in a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Way {
    /// Like a stiffness, or nothing at all.
    Plain,
    /// Against the displacement on both sides.
    Rises,
    /// With it on one side at least.
    Falls,
    /// Clear on one side only.
    Open,
}

/// What decides at a place of rest whose stiffness vanishes in some direction; none at all others, and where a whole line of places rests.
pub fn degenerate(machine: &mut LinearMachine, place: &Place) -> Option<Degenerate> {
    let mut around = Around::new(machine, place)?;
    let ways: Vec<Way> = (0..around.directions.len()).map(|j| around.way(j)).collect();
    if ways.iter().all(|way| *way == Way::Plain) {
        return None;
    }
    let flat: Vec<Rounded> =
        around.directions.iter().zip(&ways).filter(|(_, way)| **way != Way::Plain).map(|(d, _)| d.part.clone()).collect();
    let matrices = &around.along;
    let (_, odd) = parts(&matrices.stiffness, matrices.n);
    let (_, gyroscopic) = parts(&matrices.damping, matrices.n);
    if largest(&odd) > ODD * largest(&matrices.stiffness) || largest(&gyroscopic) > 0.0 {
        return Some(Degenerate { stable: None, flat });
    }
    let others = || around.directions.iter().zip(&ways).filter(|(_, way)| **way == Way::Plain).map(|(d, _)| d.stiffness);
    let damped = matrices.calm();
    let stable = match () {
        () if ways.contains(&Way::Falls) || others().any(|k| k < 0.0) => Some(false),
        () if ways.iter().filter(|way| **way != Way::Plain).count() > 1 || ways.contains(&Way::Open) => None,
        () if others().all(|k| k > 0.0) && damped => Some(true),
        () => None,
    };
    Some(Degenerate { stable, flat })
}

/// Whether a direction leads along places of rest, on one side at least: no force in it is clear of its rounding at any of the displacements, where all others are relaxed.
pub fn rests_beside(machine: &mut LinearMachine, place: &Place) -> bool {
    let Some(mut around) = Around::new(machine, place) else { return false };
    let switches = around.machine.linear().force.clone();
    let graph = &around.machine.linear().graph;
    let shorter = graph.reachable(&switches).into_iter().any(|e| graph.node(e).switches());
    // the edge of a play ends a line of places
    let looks = if shorter { &SHOWN[..1] } else { &SHOWN[..] };
    (0..around.directions.len()).any(|j| {
        [1.0, -1.0].iter().any(|sign| {
            let mut rests = |s: f64| around.gradient(j, sign * s).is_some_and(|[g, noise]| g.abs() <= CLEAR * noise);
            looks.iter().all(|s| rests(*s))
        })
    })
}

/// How the force goes in the only direction without stiffness, on the sides that are allowed of it; none where there are several, or one in which the energy falls.
pub(super) fn along_one(machine: &mut LinearMachine, place: &Place, sides: &mut dyn FnMut(&[f64]) -> Sides) -> Option<Way> {
    let mut around = Around::new(machine, place)?;
    let most = around.directions.iter().fold(0.0_f64, |m, d| m.max(d.part.stiffness.abs()));
    let mut flat = (0..around.directions.len()).filter(|j| around.directions[*j].part.stiffness <= NEARLY * most);
    let j = flat.next()?;
    if flat.next().is_some() || around.directions[j].part.stiffness < -NEARLY * most {
        return None;
    }
    let signs = sides(&around.directions[j].shape).signs();
    (!signs.is_empty()).then(|| around.follow(j, signs, MOST))
}

/// What is to be said of such places.
pub fn remark<'d>(found: impl Iterator<Item = &'d Degenerate>) -> Option<Text> {
    let open = found.map(|d| d.stable.is_none()).reduce(|a, b| a || b)?;
    let (en, ru) = match open {
        true => ("and leave it open whether it is stable", "но и они не решают вопроса об устойчивости"),
        false => ("and decide whether it is stable", "они и определяют устойчивость"),
    };
    Some(Text::new(
        format!(
            "degenerate: the stiffness vanishes in a direction at a place of rest, the forces of higher order act there alone {en}; its lowest frequency is zero but for rounding"
        ),
        format!(
            "вырожденное положение равновесия: жёсткость в одном из направлений равна нулю, там действуют только силы высших порядков, {ru}; низшая частота равна нулю с точностью до округления"
        ),
    ))
}

/// A direction, its longest entry one size of its coordinate.
struct Direction {
    /// Of a displacement, by coordinate.
    shape: Vec<f64>,
    /// Of the force, in the same units of work: the shape itself where C is symmetric.
    against: Vec<f64>,
    stiffness: f64,
    /// One metre (radian) in sizes of that coordinate.
    unit: f64,
    /// The part of C.
    part: Rounded,
}

/// Directions of a square matrix that belong together, of length 1: A = Σ σ l rᵀ.
struct Pair {
    left: Vec<f64>,
    right: Vec<f64>,
    /// σ, with the sign that makes l and r point alike.
    value: f64,
}

impl Pair {
    /// Without entries that are rounding of the largest: they would couple what nothing couples.
    fn settled(mut self) -> Pair {
        for list in [&mut self.left, &mut self.right] {
            let largest = list.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            list.iter_mut().filter(|v| v.abs() <= f64::EPSILON * largest).for_each(|v| *v = 0.0);
        }
        self
    }
}

/// The pairs of a matrix in which coordinates are alike: eigenvectors where it is symmetric but for rounding, else singular vectors.
fn pairs(a: &[f64], k: usize) -> Option<Vec<Pair>> {
    let unit: Vec<f64> = (0..k * k).map(|p| f64::from(u8::from(p / k == p % k))).collect();
    let (even, odd) = parts(a, k);
    if largest(&odd) <= EVEN * largest(a) {
        let found = eigen::symmetric(k, &even, &unit).ok()?;
        let pair = |j: usize| Pair { left: found.shape(j).to_vec(), right: found.shape(j).to_vec(), value: found.values[j] };
        return Some((0..k).map(pair).collect());
    }
    let product = |across: bool| -> Vec<f64> {
        let entry = |i: usize, l: usize| if across { a[i * k + l] } else { a[l * k + i] };
        (0..k * k).map(|p| (0..k).map(|l| entry(p / k, l) * entry(p % k, l)).sum()).collect()
    };
    let (right, left) = (eigen::symmetric(k, &product(false), &unit).ok()?, eigen::symmetric(k, &product(true), &unit).ok()?);
    let top = right.values.iter().fold(0.0_f64, |m, v| m.max(v.abs())).sqrt();
    let pair = |j: usize| {
        let r = right.shape(j).to_vec();
        let image: Vec<f64> = a.chunks(k).map(|row| dot(row, &r)).collect();
        let size = norm(&image);
        let mut l = if size > FLAT * top { image.iter().map(|v| v / size).collect() } else { left.shape(j).to_vec() };
        if dot(&l, &r) < 0.0 {
            l.iter_mut().for_each(|v| *v = -*v);
        }
        let value = dot(&l, &image);
        Pair { left: l, right: r, value }
    };
    Some((0..k).map(pair).collect())
}

/// The matrix P = Z (Zᵀ Z)⁻¹ of a basis, row-major n x k: Zᵀ P = E.
fn inverse(z: &[f64], k: usize) -> Option<Vec<f64>> {
    let n = z.len() / k;
    let gram: Vec<f64> = (0..k * k).map(|p| (0..n).map(|i| z[i * k + p / k] * z[i * k + p % k]).sum()).collect();
    let lu = Lu::exact(&gram, k)?;
    let rows: Option<Vec<Vec<f64>>> = z.chunks(k).map(|row| lu.solve(row)).collect();
    Some(rows?.concat())
}

/// The surroundings of a place.
struct Around<'m> {
    machine: &'m mut LinearMachine,
    q: Vec<f64>,
    along: Matrices,
    directions: Vec<Direction>,
}

impl Around<'_> {
    fn new<'m>(machine: &'m mut LinearMachine, place: &Place) -> Option<Around<'m>> {
        let matrices = machine.at(place).ok().filter(|m| m.drift.is_empty())?;
        let (basis, along) = match matrices.allowed() {
            Some((z, k)) => (Some((z.clone(), k)), matrices.reduced(&z, k)),
            None => (None, matrices),
        };
        let k = along.n;
        // a weak spring beside hard ones is one: in its own coordinates C is diagonal, and no entry of that diagonal is rounding
        if k == 0 || k > DIRECTIONS || along.graded().is_some() {
            return None;
        }
        // alike stiffnesses on the diagonal: the eigenvectors are those of no unit
        let units = scales(&along);
        let scaled: Vec<f64> = (0..k * k).map(|p| units[p / k] * along.stiffness[p] * units[p % k]).collect();
        let found: Vec<Pair> = pairs(&scaled, k)?.into_iter().map(Pair::settled).collect();
        let names: Vec<String> = machine.coordinates().iter().map(|c| c.unit.clone()).collect();
        let sizes = Sizes::new(names.iter().map(String::as_str)).at(&[&place.q]);
        // displacements z y, and the rows that give y of them
        let back = match &basis {
            Some((z, _)) => Some(inverse(z, k)?),
            None => None,
        };
        let whole = |own: &[f64]| -> Vec<f64> {
            match &basis {
                Some((z, _)) => z.chunks(k).map(|row| row.iter().zip(own).map(|(z, v)| z * v).sum()).collect(),
                None => own.to_vec(),
            }
        };
        let dual = |own: &[f64]| -> Vec<f64> {
            match &back {
                Some(p) => p.chunks(k).map(|row| row.iter().zip(own).map(|(p, v)| p * v).sum()).collect(),
                None => own.to_vec(),
            }
        };
        let by = |v: &[f64], f: fn(f64, f64) -> f64| -> Vec<f64> { v.iter().zip(&units).map(|(v, u)| f(*v, *u)).collect() };
        let direction = |pair: &Pair| {
            let (shape, against) = (whole(&by(&pair.right, |v, u| v * u)), whole(&by(&pair.left, |v, u| v * u)));
            let [most, size] =
                shape.iter().zip(&sizes).map(|(v, size)| [v.abs() / size, *size]).fold([0.0, 1.0], |m, v| if v[0] > m[0] { v } else { m });
            let part =
                Rounded { stiffness: pair.value, left: dual(&by(&pair.left, |v, u| v / u)), right: dual(&by(&pair.right, |v, u| v / u)) };
            let scaled = |list: Vec<f64>| list.iter().map(|v| v / most).collect();
            Direction { shape: scaled(shape), against: scaled(against), stiffness: pair.value / (most * most), unit: size.recip(), part }
        };
        let directions = found.iter().map(direction).collect();
        Some(Around { machine, q: place.q.clone(), along, directions })
    }

    /// Forces along all directions at a displacement by them, with their rounding.
    fn forces(&mut self, by: &[f64]) -> Option<Vec<[f64; 2]>> {
        let n = self.q.len();
        let moved = |i: usize| self.directions.iter().zip(by).map(|(d, s)| d.shape[i] * s).sum::<f64>();
        let q: Vec<f64> = (0..n).map(|i| self.q[i] + moved(i)).collect();
        let Slope { q, along, basis, whole } = Slope::at(self.machine, &q)?;
        let terms = self.machine.terms();
        let reach = |i: usize| (0..n).map(|j| (whole[i * n + j] * q[j]).abs()).sum::<f64>();
        let sizes: Vec<f64> = (0..n).map(|i| terms[i] + reach(i)).collect();
        // what the connections leave of the forces, P h with P = Z (Zᵀ Z)⁻¹ Zᵀ, and of their terms: Z is no orthonormal basis
        let (force, sizes) = match &basis {
            Some(z) => {
                let k = along.n;
                let back = inverse(z, k)?;
                let reduced: Vec<f64> = (0..k).map(|c| z.chunks(k).zip(&sizes).map(|(row, s)| row[c].abs() * s).sum()).collect();
                let force: Vec<f64> = back.chunks(k).map(|row| dot(row, &along.force)).collect();
                (force, back.chunks(k).map(|row| row.iter().zip(&reduced).map(|(p, s)| p.abs() * s).sum()).collect())
            }
            None => (along.force, sizes),
        };
        let of = |d: &Direction| {
            let sum: f64 = d.against.iter().zip(&force).map(|(v, f)| v * f).sum();
            let size: f64 = d.against.iter().zip(&sizes).map(|(v, s)| (v * s).abs()).sum();
            [sum, ROUNDED * size]
        };
        Some(self.directions.iter().map(of).collect())
    }

    /// g(s) of a direction with its rounding; none where it has no value or the others find no rest.
    fn gradient(&mut self, j: usize, s: f64) -> Option<[f64; 2]> {
        let mut by = vec![0.0; self.directions.len()];
        by[j] = s;
        for _ in 0..STEPS {
            let forces = self.forces(&by)?;
            let rests = |(i, [f, noise]): (usize, &[f64; 2])| i == j || f.abs() <= *noise;
            if forces.iter().enumerate().all(rests) {
                return Some([-forces[j][0], forces[j][1]]);
            }
            for (i, [f, _]) in forces.iter().enumerate().filter(|(i, _)| *i != j) {
                by[i] += f / self.directions[i].stiffness;
            }
            if !by.iter().all(|v| v.is_finite()) {
                return None;
            }
        }
        None
    }

    fn way(&mut self, j: usize) -> Way {
        let stiffness = self.directions[j].stiffness;
        let both = Sides::Both.signs();
        let straight = |around: &mut Self, s: f64| {
            let [there, here] = [around.gradient(j, s), around.gradient(j, -s)];
            let off =
                |g: Option<[f64; 2]>, s: f64| g.is_none_or(|[g, noise]| (g - stiffness * s).abs() > BENT * (stiffness * s).abs() + noise);
            !off(there, s) && !off(here, -s)
        };
        if !LOOKS.iter().all(|s| straight(self, *s)) {
            return if self.is_resolved(j) { Way::Plain } else { self.follow(j, both, MOST) };
        }
        // a force of high order may be rounding at these and none farther off
        let far = |around: &mut Self, s: f64| {
            around.gradient(j, s).is_some_and(|[g, noise]| (g - stiffness * s).abs() > BENT * (stiffness * s).abs() + CLEAR * noise)
        };
        if [MOST, -MOST, FAR, -FAR].iter().any(|s| far(self, *s)) {
            return if self.is_resolved(j) { Way::Plain } else { self.follow(j, both, FAR) };
        }
        // a place that is itself no more than what rounding leaves of a zero has no size of its own: at its own distance nothing is clear
        let unseen = |g: Option<[f64; 2]>| g.is_some_and(|[g, noise]| g.abs().max((stiffness * MOST).abs()) <= noise);
        let unit = self.directions[j].unit;
        if unit > 1.0 && [MOST, -MOST].iter().all(|s| unseen(self.gradient(j, *s))) {
            self.follow(j, both, MOST * unit)
        } else {
            Way::Plain
        }
    }

    /// Whether a stiffness, weak as it is beside what it is the sum of, is one: the same on both sides of the place as far off as rounding of the force leaves that unknown. Beside a double
    /// zero it is of the other sign on the other side.
    fn is_resolved(&mut self, j: usize) -> bool {
        let stiffness = self.directions[j].stiffness;
        let Some(here) = self.stiffness(j, 0.0) else { return false };
        let [_, rounding] = self.machine.rounding();
        let length = |v: &[f64]| v.iter().map(|v| v.abs()).sum::<f64>();
        let d = &self.directions[j];
        if here.abs() <= SEEN * rounding * length(&d.shape) * length(&d.against) {
            return false;
        }
        // what forces err by is seen where the stiffness makes nothing of them
        let errs =
            BESIDE.iter().flat_map(|s| [*s, -*s]).map(|s| self.gradient(j, s).map_or(f64::INFINITY, |[g, _]| (g - stiffness * s).abs()));
        let s = (UNSURE * errs.fold(0.0, f64::max) / stiffness.abs()).max(BESIDE[0]);
        let mut same = |s: f64| self.stiffness(j, s).is_some_and(|there| (there - stiffness).abs() <= STRAIGHT * stiffness.abs());
        s <= MOST && same(s) && same(-s)
    }

    /// The stiffness of a direction at a displacement by it.
    fn stiffness(&mut self, j: usize, s: f64) -> Option<f64> {
        let d = &self.directions[j];
        let q: Vec<f64> = self.q.iter().zip(&d.shape).map(|(q, v)| q + s * v).collect();
        let (shape, against) = (d.shape.clone(), d.against.clone());
        let Slope { along, basis, .. } = Slope::at(self.machine, &q)?;
        let k = along.n;
        let own = |v: &[f64]| -> Option<Vec<f64>> {
            let Some(z) = &basis else { return Some(v.to_vec()) };
            let back = inverse(z, k)?;
            Some((0..k).map(|c| back.chunks(k).zip(v).map(|(row, v)| row[c] * v).sum()).collect())
        };
        let (shape, against) = (own(&shape)?, own(&against)?);
        Some((0..k * k).map(|p| against[p / k] * along.stiffness[p] * shape[p % k]).sum())
    }

    /// The force on these sides, from near the place on to a displacement.
    fn follow(&mut self, j: usize, signs: &[f64], farthest: f64) -> Way {
        let stiffness = self.directions[j].stiffness;
        let (mut before, mut open, mut s) = (None, false, LEAST);
        let mut last: [Vec<[f64; 2]>; 2] = Default::default();
        while s <= farthest {
            let Some(here) = signs.iter().map(|sign| self.gradient(j, sign * s)).collect::<Option<Vec<_>>>() else {
                return if open { Way::Open } else { Way::Plain };
            };
            let clear = |([g, noise], sign): (&[f64; 2], &f64)| (if g.abs() > CLEAR * noise { *g } else { 0.0 }, sign * s);
            let sides: Vec<(f64, f64)> = here.iter().zip(signs).map(clear).collect();
            let falls = sides.iter().any(|(g, s)| g * s < 0.0);
            let clear = sides.iter().all(|(g, _)| *g != 0.0);
            open |= sides.iter().any(|(g, _)| *g != 0.0);
            let found = match () {
                () if clear && sides.iter().all(|(g, s)| (g - stiffness * s).abs() <= STRAIGHT * (stiffness * s).abs()) => Some(Way::Plain),
                () if falls => Some(Way::Falls),
                () if clear => Some(Way::Rises),
                () => None,
            };
            if let Some(way) = found.filter(|_| found == before) {
                return if begins_off(&last, &here) { Way::Plain } else { way };
            }
            last.rotate_left(1);
            last[1] = here;
            (before, s) = (found, APART * s);
        }
        if open { Way::Open } else { Way::Plain }
    }
}

/// Whether a force that is there at two displacements in a row is nothing at all at the one before, where it would have been clear of rounding by the power that both tell: then it begins off the
/// place, at the edge of a play.
fn begins_off([first, second]: &[Vec<[f64; 2]>; 2], third: &[[f64; 2]]) -> bool {
    let begins = |(([a, _], [b, noise]), [c, _]): ((&[f64; 2], &[f64; 2]), &[f64; 2])| {
        let foretold = b * b / c.abs();
        *a == 0.0 && *b != 0.0 && foretold > (CLEAR * noise).max(f64::MIN_POSITIVE)
    };
    first.iter().zip(second).zip(third).any(begins)
}
