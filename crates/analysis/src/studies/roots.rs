//! Roots and shapes of small motions whose damping, gyroscopic or circulatory forces couple the undamped shapes.
//!
//! In the undamped shapes Φ (xᵀ M x = 1), q = Φ z, the motion is z'' + B z' + C z = 0. Free motions Z (C Z = 0) have a root zero each for staying where they are; beside
//! fast roots rounding would make of it anything up to √ε of the fastest. So it is taken out first: with unit vectors E beside Z, z = Z a + E b, a stands in no
//! equation, and the states are b and the rates y = z':
//!
//! ```text
//! b' = P y,   y' = -B y - C E b,        P y = b' of y = Z a' + E b'
//! ```
//!
//! of 2n - k roots. Of these as many are zero again as there are free motions that no damping resists, Wᵀ B Z v = 0 (Wᵀ C = 0): they go on at any speed. All others stand, however
//! slow beside the fastest: what decays last is what is left of a motion.
//!
//! *Source*: F. Tisseur, K. Meerbergen, The Quadratic Eigenvalue Problem, SIAM Review 43 (2001), 3.4 on singular coefficients.

use super::amplitudes::SINGULAR;
use super::clusters::{Cluster, clusters, sine};
use super::free_motion;
use super::polish::polish;
use super::shapes::{Complex, Kind, Mode, pairs};
use crate::Fault;
use crate::linear::{Matrices, largest};
use algebra::eigen;
use algebra::elementary;
use algebra::qr::Qr;
use words::Text;

/// A root below this share of the fastest is lost in its rounding, unless Newton's method finds it.
const LOST: f64 = 1e-10;
/// A multiple root at zero, which rounding splits by the root of 1e-16 of the fastest, is no larger than this share of it.
const SPLIT: f64 = 1e-6;
/// Share within which two polished roots with shapes alike are one.
const ONE: f64 = 1e-9;
/// Sine of the angle between their shapes.
const PARALLEL: f64 = 3e-5;
/// Share of a root that the mean of a cluster leaves unknown.
const MEAN: f64 = 1e-12;
/// Share within which roots that are equal come out of the eigensolver: the root of its rounding.
const BESIDE: f64 = 1e-6;
/// Share of a root that Newton's method with residuals in twice the digits leaves unknown.
const POLISHED: f64 = 1e-28;
/// The same where nothing depends on rates: λ² are roots of a real polynomial, imaginary λ leave rounding only.
const UNDAMPED: f64 = 1e-14;

/// Undamped shapes as a basis, xᵀ M x = 1.
pub(super) struct Basis<'a> {
    pub(super) n: usize,
    /// Shape after shape.
    pub(super) shapes: &'a [f64],
}

impl Basis<'_> {
    fn shape(&self, j: usize) -> &[f64] {
        &self.shapes[j * self.n..(j + 1) * self.n]
    }

    /// Φᵀ A Φ.
    pub(super) fn project(&self, a: &[f64]) -> Vec<f64> {
        let n = self.n;
        let product = |i: usize, x: &[f64]| -> f64 { (0..n).map(|j| a[i * n + j] * x[j]).sum() };
        let mut out = vec![0.0; n * n];
        for c in 0..n {
            let ax: Vec<f64> = (0..n).map(|i| product(i, self.shape(c))).collect();
            for r in 0..n {
                out[r * n + c] = self.shape(r).iter().zip(&ax).map(|(x, y)| x * y).sum();
            }
        }
        out
    }

    /// Φ z.
    fn expand(&self, z: &[Complex]) -> Vec<Complex> {
        let n = self.n;
        let sum = |i: usize, part: fn(&Complex) -> f64| z.iter().enumerate().map(|(j, z)| self.shapes[j * n + i] * part(z)).sum();
        (0..n).map(|i| (sum(i, |z| z.0), sum(i, |z| z.1))).collect()
    }

    /// z of a displacement, Φᵀ M q.
    fn within(&self, mass: &[f64], q: &[f64]) -> Vec<f64> {
        let n = self.n;
        let momentum: Vec<f64> = (0..n).map(|i| (0..n).map(|j| mass[i * n + j] * q[j]).sum()).collect();
        (0..n).map(|j| self.shape(j).iter().zip(&momentum).map(|(x, p)| x * p).sum()).collect()
    }

    /// w Φ of a row.
    fn across(&self, row: &[f64]) -> Vec<f64> {
        (0..self.n).map(|j| self.shape(j).iter().zip(row).map(|(x, w)| x * w).sum()).collect()
    }
}

/// Free motions in the undamped shapes.
struct Free {
    /// Z, each with 1 at its own pivot and 0 at those of the others.
    right: Vec<Vec<f64>>,
    pivots: Vec<usize>,
    /// Rows of Wᵀ.
    left: Vec<Vec<f64>>,
}

impl Free {
    /// Of a symmetric C the shapes whose value is zero, else the null directions of C.
    fn new(system: &Matrices, basis: &Basis, values: Option<&Vec<f64>>) -> Free {
        let n = basis.n;
        let unit = |j: usize| (0..n).map(|i| f64::from(u8::from(i == j))).collect::<Vec<f64>>();
        if let Some(values) = values {
            let pivots: Vec<usize> = (0..n).filter(|j| values[*j] == 0.0).collect();
            let right: Vec<Vec<f64>> = pivots.iter().map(|j| unit(*j)).collect();
            return Free { left: right.clone(), right, pivots };
        }
        let Some((right, left)) = free_motion::directions(system) else {
            return Free { right: Vec::new(), pivots: Vec::new(), left: Vec::new() };
        };
        let mut right: Vec<Vec<f64>> = right.iter().map(|z| basis.within(&system.mass, z)).collect();
        let mut pivots: Vec<usize> = Vec::new();
        for k in 0..right.len() {
            let size = |j: &usize| right[k][*j].abs();
            let Some(pivot) = (0..n).filter(|j| !pivots.contains(j)).max_by(|a, b| size(a).total_cmp(&size(b))) else { break };
            let by = right[k][pivot];
            right[k].iter_mut().for_each(|v| *v /= by);
            let own = right[k].clone();
            for (i, other) in right.iter_mut().enumerate().filter(|(i, _)| *i != k) {
                let share = if i == k { 0.0 } else { other[pivot] };
                other.iter_mut().zip(&own).for_each(|(v, z)| *v -= share * z);
            }
            pivots.push(pivot);
        }
        Free { right, pivots, left: left.iter().map(|w| basis.across(w)).collect() }
    }

    /// How many of them no damping resists.
    fn unresisted(&self, damping: &[f64], n: usize) -> usize {
        let k = self.pivots.len();
        let entry = |w: &Vec<f64>, z: &Vec<f64>| -> f64 { free_motion::settled((0..n * n).map(|p| w[p / n] * damping[p] * z[p % n])) };
        let work: Vec<f64> = self.left.iter().flat_map(|w| self.right.iter().map(move |z| entry(w, z))).collect();
        if largest(&work) == 0.0 { k } else { k - Qr::alike(&work, k, k, SINGULAR).rank() }
    }
}

/// All modes, free motions first. `values` are the squared natural frequencies of the undamped machine where C is symmetric.
///
/// With what is to be said where roots cannot be told from zero.
///
/// *Errors*: S066 for a slow root that hangs on rounding, faults of the eigensolver.
pub(super) fn roots(system: &Matrices, basis: &Basis, values: Option<&Vec<f64>>) -> Result<(Vec<Mode>, Option<Text>), Fault> {
    let n = system.n;
    let columns: Vec<f64> = (0..n * n).map(|p| basis.shapes[(p % n) * n + p / n]).collect();
    // sums that are rounding of their terms are zero
    let Matrices { damping, stiffness, .. } = system.reduced(&columns, n);
    let free = Free::new(system, basis, values);
    let kept: Vec<usize> = (0..n).filter(|j| !free.pivots.contains(j)).collect();
    let held = |i: usize| values.is_some() && free.pivots.contains(&i);
    let found = eigen::general(kept.len() + n, &first_order((&damping, &stiffness), &free, &kept, &held))?;
    let mut modes: Vec<Mode> = free.right.iter().map(|z| still(basis.expand(&z.iter().map(|v| (*v, 0.0)).collect::<Vec<_>>()))).collect();
    let list = pairs(&found.values);
    let fastest = list.iter().fold(0.0_f64, |m, v| m.max(elementary::hypot(v.0, v.1)));
    let slow = |v: &Complex| !free.pivots.is_empty() && elementary::hypot(v.0, v.1) <= SPLIT * fastest;
    let mut zeros = free.unresisted(&damping, n);
    let mut doubtful = 0.0_f64;
    let shapes: Vec<Vec<Complex>> = (0..list.len()).map(|j| basis.expand(&pairs(&found.vector(j)[kept.len()..]))).collect();
    let mut polished: Vec<Option<(Complex, Vec<Complex>)>> =
        list.iter().zip(&shapes).map(|(root, shape)| finer(system, *root, shape)).collect();
    // what is zero with the free motions is no cluster of its own
    let clusters: Vec<Cluster> =
        clusters(&list, &shapes, fastest).into_iter().filter(|c| !slow(&c.root) && !told_apart(c, &polished)).collect();
    // the slowest come first
    for (j, root) in list.iter().enumerate() {
        if zeros > 0 && slow(root) {
            zeros -= 1;
            continue;
        }
        if let Some(cluster) = clusters.iter().find(|c| c.members.contains(&j)) {
            if cluster.root.1 >= 0.0 {
                modes.push(moving(settled_root(cluster.root, MEAN), cluster.shape.clone()));
            }
            continue;
        }
        if root.1 < 0.0 {
            continue;
        }
        let (root, shape) = match polished[j].take() {
            Some(better) => better,
            // what more than the free motions is zero; rounding splits that to both sides of zero, and repeated roots stand beside each other
            None if slow(root) && !is_repeated(&list, j) => {
                doubtful = doubtful.max(elementary::hypot(root.0, root.1));
                continue;
            }
            // the fastest root's rounding is larger than this one
            None if elementary::hypot(root.0, root.1) <= LOST * fastest => return Err(lost()),
            None => (*root, shapes[j].clone()),
        };
        // a simple real root stays real under any correction
        let root = (root.0, if list[j].1 == 0.0 { 0.0 } else { root.1 });
        let root = settled_root(root, if largest(&system.damping) == 0.0 { UNDAMPED } else { POLISHED });
        if slow(&root) && modes.iter().any(|m| is_one((&root, &shape), m)) {
            continue;
        }
        modes.push(moving(root, shape));
    }
    Ok((modes, (doubtful > 0.0).then(|| unclear(doubtful))))
}

/// The matrix of (b, z') in first order, row-major; `held`: rows without stiffness.
fn first_order((damping, stiffness): (&[f64], &[f64]), free: &Free, kept: &[usize], held: &dyn Fn(usize) -> bool) -> Vec<f64> {
    let n = kept.len() + free.pivots.len();
    let size = kept.len() + n;
    let mut a = vec![0.0; size * size];
    for (r, i) in kept.iter().enumerate() {
        a[r * size + kept.len() + i] = 1.0;
        for (z, pivot) in free.right.iter().zip(&free.pivots) {
            a[r * size + kept.len() + pivot] = -z[*i];
        }
    }
    for i in 0..n {
        let row = &mut a[(kept.len() + i) * size..(kept.len() + i + 1) * size];
        kept.iter().enumerate().filter(|_| !held(i)).for_each(|(c, j)| row[c] = -stiffness[i * n + j]);
        (0..n).for_each(|j| row[kept.len() + j] = -damping[i * n + j]);
    }
    a
}

/// The root with its shape to the last digits; none of one with a negative imaginary part, which its conjugate stands for.
fn finer(system: &Matrices, root: Complex, shape: &[Complex]) -> Option<(Complex, Vec<Complex>)> {
    (root.1 >= 0.0).then(|| polish(system, root, shape)).flatten()
}

/// Whether Newton's method has found as many roots in a cluster as it has members.
fn told_apart(cluster: &Cluster, polished: &[Option<(Complex, Vec<Complex>)>]) -> bool {
    let is_real = cluster.root.1 == 0.0;
    // the conjugate of a root about a real one is a member too
    let with_conjugate = |root: Complex| [Some(root), (is_real && root.1 != 0.0).then_some((root.0, -root.1))];
    let found: Vec<Complex> =
        cluster.members.iter().filter_map(|j| polished[*j].as_ref()).flat_map(|p| with_conjugate(p.0)).flatten().collect();
    let near = |a: &Complex, b: &Complex| elementary::hypot(a.0 - b.0, a.1 - b.1) <= ONE * elementary::hypot(a.0, a.1);
    let distinct = (0..found.len()).all(|i| (0..i).all(|j| !near(&found[i], &found[j])));
    distinct && found.len() == cluster.members.len()
}

/// What is said of roots that are taken for zeros.
fn unclear(largest: f64) -> Text {
    let size = words::digits::rounded(largest);
    Text::new(
        format!("roots of at most {} 1/s that rounding does not tell from zero are taken for those of free motions", size.en),
        format!("корни не больше {} 1/с, неотличимые от нуля из-за округления, отнесены к свободным движениям", size.ru),
    )
}

/// Whether a root is one of several that are equal.
fn is_repeated(list: &[Complex], j: usize) -> bool {
    let own = list[j];
    let near = |v: &Complex| elementary::hypot(v.0 - own.0, v.1 - own.1) <= BESIDE * elementary::hypot(own.0, own.1);
    list.iter().enumerate().any(|(i, v)| i != j && near(v))
}

/// Whether a root with its shape stands already.
fn is_one((root, shape): (&Complex, &[Complex]), mode: &Mode) -> bool {
    let near = elementary::hypot(root.0 - mode.root.0, root.1 - mode.root.1) <= ONE * elementary::hypot(root.0, root.1);
    near && sine(shape, &mode.shape) <= PARALLEL
}

/// A free motion.
fn still(shape: Vec<Complex>) -> Mode {
    Mode { kind: Kind::RigidBody, omega: 0.0, damped: 0.0, ratio: f64::NAN, root: (0.0, 0.0), shape }
}

fn moving(root: Complex, shape: Vec<Complex>) -> Mode {
    let omega = elementary::hypot(root.0, root.1);
    let kind = match () {
        () if root.1 > 0.0 => Kind::Oscillation,
        () if root.0 > 0.0 => Kind::Divergence,
        () => Kind::Aperiodic,
    };
    let omega = if kind == Kind::Divergence { 0.0 } else { omega };
    let ratio = if kind == Kind::Divergence { f64::NAN } else { 0.0 - root.0 / omega };
    Mode { kind, omega, damped: root.1, ratio, root, shape }
}

/// A root whose real part is rounding, a share `noise` of the root at most, neither grows nor decays.
fn settled_root(root: Complex, noise: f64) -> Complex {
    if root.1 != 0.0 && root.0.abs() <= noise * root.1.abs() { (0.0, root.1) } else { root }
}

pub(super) fn lost() -> Fault {
    crate::fault::small::rounded_away(Text::new(
        "a slow root of the small motions hangs on rounding",
        "медленный корень уравнений малых движений определяется округлением",
    ))
}
