//! Natural frequencies and shapes of small motions M q'' + B q' + C q = 0.
//!
//! Without damping: (C - ω² M) x = 0, a symmetric problem. Damping that the shapes of the undamped machine diagonalise (classical) gives each
//! of them a ratio ζ = xᵀ B x / 2ω. Everything else, also gyroscopic and circulatory forces, goes to the first-order form in the
//! undamped shapes Φ (xᵀ M x = 1), q = Φ z:
//!
//! ```text
//! d/dt (z, z') = [ 0  E; -Φᵀ C Φ  -Φᵀ B Φ ] (z, z'),      roots λ = -ζ ω ± i ω √(1 - ζ²)
//! ```
//!
//! *Source*: P. C. Müller, W. Schiehlen, Linear Vibrations, ch. 4; L. Meirovitch, Methods of Analytical Dynamics, ch. 9.

use algebra::arrange::Arrange;
use algebra::cholesky::positive_definite;
use algebra::elementary;
use std::cmp::Ordering;
use words::Text;

use crate::audits::certified;
use crate::audits::worse;
use crate::dataset::Audit;
use crate::linear::{Matrices, largest, parts};
use crate::studies::roots::{Basis, lost, roots};
pub use crate::studies::shapes::{Complex, Damping, Kind, Mode, Modes, Normalisation, check_mass, divided};
use crate::studies::shapes::{normalise, remarks};
use crate::{Fault, Quantity};
use algebra::certify::certify;
use algebra::eigen;
use algebra::lu::Lu;
use algebra::refined::products;
use algebra::sparse::Sparse;

/// Sums that cancel to this share of their terms are zero.
const CANCELLED: f64 = 1e-12;
/// Force of a free motion beyond this share of its terms is more than rounding.
const WEAK: f64 = 8.0 * f64::EPSILON;
/// Share of a root beyond which a last digit of B must not move it: below that no oscillation counts as growing or dying away.
const UNSURE: f64 = SPLIT;
/// Coupling of undamped shapes by damping that counts as none.
const UNCOUPLED: f64 = 1e-10;
/// Distance of eigenvalues, relative, from which on a shape is its own: a step of inverse iteration leaves rounding over it of the others.
const APART: f64 = 1e-3;
/// Share of a shape in the one that it is refined to, in the metric of the masses.
const SAME: f64 = 0.99;
/// Largest residual of eigenpairs relative to its terms.
const RESIDUAL: f64 = 1e-9;

/// The modes of a linear system; `names` for messages.
///
/// *Errors*: S031 for a mass matrix that is not positive, faults of the eigensolver.
///
/// Conditions of connections reduce the problem to the motions they allow; shapes are given for all coordinates.
pub fn modes(system: &Matrices, names: &[Quantity], normalisation: Normalisation) -> Result<Modes, Fault> {
    let found = allowed(system, names, normalisation)?;
    for (i, mode) in found.modes.iter().enumerate() {
        let numbers = [mode.omega, mode.damped, mode.root.0, mode.root.1];
        let shape = mode.shape.iter().flat_map(|z| [z.0, z.1]);
        for value in numbers.into_iter().chain(shape) {
            crate::fault::finite(value, &format!("mode {}", i + 1))?;
        }
    }
    Ok(found)
}

/// The modes that the conditions allow.
fn allowed(system: &Matrices, names: &[Quantity], normalisation: Normalisation) -> Result<Modes, Fault> {
    if !system.drift.is_empty() {
        // conditions on rates are solved in single numbers
        if system.loses() {
            return Err(lost());
        }
        return crate::studies::rolling::modes(system, names, normalisation);
    }
    let Some((z, k)) = system.allowed() else { return sound(system, names, normalisation) };
    let found = sound(&system.reduced(&z, k), names, Normalisation::Mass)?;
    Ok(carried(found, (&z, k), system, normalisation))
}

/// In coordinates in which weak springs do not vanish beside hard ones.
fn sound(system: &Matrices, names: &[Quantity], normalisation: Normalisation) -> Result<Modes, Fault> {
    check_mass(&system.mass, system.n, names)?;
    let Some(graded) = system.graded() else { return free(system, names, normalisation) };
    let found = free(&graded.matrices, names, Normalisation::Mass)?;
    Ok(carried(found, (&graded.rounded(), system.n), system, normalisation))
}

/// Shapes x = Z y for all coordinates.
fn carried(mut found: Modes, (z, k): (&[f64], usize), system: &Matrices, normalisation: Normalisation) -> Modes {
    for (i, mode) in found.modes.iter_mut().enumerate() {
        let own = std::mem::take(&mut mode.shape);
        let entry = |i: usize, part: fn(&Complex) -> f64| own.iter().enumerate().map(|(c, y)| z[i * k + c] * part(y)).sum();
        mode.shape = (0..system.n).map(|i| (entry(i, |y| y.0), entry(i, |y| y.1))).collect();
        found.notes.extend(normalise(mode, &system.mass, normalisation).map(|what| what(i + 1)));
    }
    found
}

/// The same without conditions.
fn free(system: &Matrices, names: &[Quantity], normalisation: Normalisation) -> Result<Modes, Fault> {
    let n = system.n;
    check_mass(&system.mass, n, names)?;
    let (damping, gyroscopic) = parts(&system.damping, n);
    let (stiffness, circulatory) = parts(&system.stiffness, n);
    let mut undamped = eigen::symmetric(n, &stiffness, &system.mass)?;
    sharpen(&mut undamped, &stiffness, &system.mass);
    let values: Vec<f64> = (0..n).map(|j| settled(undamped.values[j], undamped.shape(j), &stiffness)).collect();
    let present = |part: &[f64], whole: &[f64]| largest(part) > CANCELLED * largest(whole);
    let (turns, follows) = (present(&gyroscopic, &system.damping), present(&circulatory, &system.stiffness));
    let basis = Basis { n, shapes: &undamped.vectors };
    let modal = basis.project(&system.damping);
    let kind = match () {
        () if turns || follows => Damping::General,
        () if largest(&damping) == 0.0 => Damping::None,
        // beside a hard damper everything that couples a weak one is small
        () if system.damping_below.is_empty() && uncoupled(&modal, n) => Damping::Classical,
        () => Damping::General,
    };
    let (mut list, unclear): (Vec<Mode>, Option<Text>) = match kind {
        Damping::General => roots(system, &basis, (!follows).then_some(&values)).map(|(list, unclear)| (ordered(list), unclear))?,
        _ => ((0..n).map(|j| classical(values[j], modal[j * n + j], undamped.shape(j))).collect(), None),
    };
    if largest(&damping) == 0.0 && !follows {
        list.iter_mut().for_each(conservative);
    }
    if !follows && system.calm() && positive_definite(&stiffness, n) != Some(false) {
        list.iter_mut().for_each(resisted);
    }
    if system.damping_open && list.iter().any(|mode| hangs_on_rounding(system, mode)) {
        return Err(lost());
    }
    let orthogonal = (kind != Damping::General).then(|| orthogonality(system, &stiffness, &list));
    if kind == Damping::Classical {
        let second = |j: usize| slipping(&list[j], settled(modal[j * n + j], undamped.shape(j), &damping));
        let second: Vec<Mode> = (0..n).filter(|j| values[*j] == 0.0).filter_map(second).collect();
        if !second.is_empty() {
            list.extend(second);
            list = ordered(list);
        }
    }
    let mut notes = Vec::new();
    for (i, mode) in list.iter_mut().enumerate() {
        notes.extend(normalise(mode, &system.mass, normalisation).map(|what| what(i + 1)));
    }
    notes.extend(remarks(&list));
    notes.extend(unclear);
    if !follows && (0..n).any(|j| values[j] == 0.0 && undamped.values[j] != 0.0 && weak(undamped.shape(j), &stiffness)) {
        notes.push(Text::new(
            "a free motion may have a weak stiffness that is lost in the rounding of strong ones",
            "у свободного движения может быть слабая жёсткость, потерянная при округлении больших",
        ));
    }
    let mut audits = vec![orthogonal.unwrap_or_else(|| residual(system, &list))];
    let pencil = (Sparse::from_dense(n, &stiffness)?, Sparse::from_dense(n, &system.mass)?);
    // values of free motions are zero
    let certified = eigen::Modes { values: values.clone(), ..undamped };
    // forces that have no energy leave no undamped machine to certify
    if !follows {
        audits.extend(certified::audits(&certify(&pencil.0, &pencil.1, &certified, n)?));
    }
    let frequency = |v: &f64| if *v < 0.0 { f64::NAN } else { v.sqrt() };
    let undamped = values.iter().map(frequency).collect();
    Ok(Modes { modes: list, damping: kind, gyroscopic: turns, circulatory: follows, undamped, audits, notes, zeros: 0 })
}

/// Replaces every shape that stands apart by (C - λ M)⁻¹ M x, xᵀ M x = 1. The eigensolver leaves in each entry a rounding of the largest one in coordinates whose
/// masses are 1: a body of 1e-9 kg beside 10⁶ kg would be off by 3e-9 of the heavy one's motion. Elimination goes row by row, and by the terms of each.
fn sharpen(modes: &mut eigen::Modes, stiffness: &[f64], mass: &[f64]) {
    let n = modes.values.len();
    let largest = modes.values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    for j in 0..n {
        let value = modes.values[j];
        let near = |i: usize| (modes.values[i] - value).abs() <= APART * value.abs().max(f64::EPSILON * largest);
        if (0..n).any(|i| i != j && near(i)) {
            continue;
        }
        let shifted: Vec<f64> = stiffness.iter().zip(mass).map(|(c, m)| c - value * m).collect();
        let product = |x: &[f64]| -> Vec<f64> { mass.chunks(n).map(|row| row.iter().zip(x).map(|(m, x)| m * x).sum()).collect() };
        let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        let x = modes.shape(j).to_vec();
        let Some(found) = Lu::exact(&shifted, n).and_then(|lu| lu.solve(&product(&x))) else { continue };
        let (size, along) = (dot(&found, &product(&found)), dot(&found, &product(&x)));
        let factor = size.sqrt().recip().copysign(along);
        // another shape than the one that was refined is none
        if factor.is_finite() && factor != 0.0 && along.abs() >= SAME * size.sqrt() {
            modes.vectors[j * n..(j + 1) * n].iter_mut().zip(&found).for_each(|(x, y)| *x = factor * y);
        }
    }
}

/// ω², or zero when xᵀ C x is rounding of its terms; what overflows stays infinite.
fn settled(value: f64, shape: &[f64], stiffness: &[f64]) -> f64 {
    if value.is_finite() && value.abs() <= CANCELLED * terms(shape, stiffness) { 0.0 } else { value }
}

/// Σ |x_i C_ij x_j|.
fn terms(shape: &[f64], stiffness: &[f64]) -> f64 {
    let n = shape.len();
    (0..n * n).map(|p| (shape[p / n] * stiffness[p] * shape[p % n]).abs()).sum()
}

/// Free motions whose stiffness is not exactly zero, where something weak may restore them: C x in twice the digits, beyond its own rounding.
fn weak(shape: &[f64], stiffness: &[f64]) -> bool {
    let n = shape.len();
    let forces = products(stiffness, n, shape);
    let size = |i: usize| (0..n).map(|j| (stiffness[i * n + j] * shape[j]).abs()).sum::<f64>();
    let largest = (0..n).map(size).fold(0.0, f64::max);
    forces.iter().any(|f| f.abs() > WEAK * largest)
}

/// Whether a last digit of B moves a root by more than [`UNSURE`] of it: δλ = -λ xᵀ δB x / xᵀ (2 λ M + B) x.
fn hangs_on_rounding(system: &Matrices, mode: &Mode) -> bool {
    let n = system.n;
    let (mut moved, mut held) = (0.0, (0.0, 0.0));
    for p in 0..n * n {
        let (x, y) = (mode.shape[p / n], mode.shape[p % n]);
        let both = (x.0 * y.0 - x.1 * y.1, x.0 * y.1 + x.1 * y.0);
        let (re, im) = (2.0 * mode.root.0 * system.mass[p] + system.damping[p], 2.0 * mode.root.1 * system.mass[p]);
        held = (held.0 + re * both.0 - im * both.1, held.1 + re * both.1 + im * both.0);
        moved += (system.damping[p] * elementary::hypot(x.0, x.1) * elementary::hypot(y.0, y.1)).abs();
    }
    mode.root != (0.0, 0.0) && f64::EPSILON * moved > UNSURE * elementary::hypot(held.0, held.1)
}

fn uncoupled(modal: &[f64], n: usize) -> bool {
    let size = largest(modal);
    (0..n * n).all(|p| p / n == p % n || modal[p].abs() <= UNCOUPLED * size)
}

/// z'' + d z' + v z = 0.
fn classical(v: f64, d: f64, shape: &[f64]) -> Mode {
    let shape = shape.iter().map(|x| (*x, 0.0)).collect();
    let omega = if v > 0.0 { v.sqrt() } else { 0.0 };
    let ratio = if v > 0.0 { d / (2.0 * omega) } else { f64::NAN };
    let discriminant = 0.25 * d * d - v;
    // of critical damping only rounding is left
    let close = discriminant.abs() <= 1e-14 * (0.25 * d * d).max(v.abs());
    let (root, kind) = match () {
        () if v == 0.0 => ((0.0, 0.0), Kind::RigidBody),
        () if close => ((-0.5 * d, 0.0), if d >= 0.0 { Kind::Aperiodic } else { Kind::Divergence }),
        () if discriminant < 0.0 => ((-0.5 * d, (-discriminant).sqrt()), Kind::Oscillation),
        () => {
            let far = -0.5 * d - discriminant.sqrt().copysign(d);
            let near = if far == 0.0 { 0.0 } else { v / far };
            // what stays longest: of two decays the slow one, of two growths the fast one
            let last = near.max(far);
            ((last, 0.0), if last > 0.0 { Kind::Divergence } else { Kind::Aperiodic })
        }
    };
    Mode { kind, omega, damped: root.1, ratio, root, shape }
}

fn ordered(mut list: Vec<Mode>) -> Vec<Mode> {
    list.arrange_by(in_order);
    list
}

/// Free motions first, then by frequency.
fn in_order(a: &Mode, b: &Mode) -> Ordering {
    let order = |m: &Mode| (m.kind != Kind::RigidBody, m.omega);
    order(a).0.cmp(&order(b).0).then(a.omega.total_cmp(&b.omega)).then(a.root.0.total_cmp(&b.root.0))
}

/// The other motion of a free one with resistance, z'' + d z' = 0: besides staying where it is (λ = 0) it slips, λ = -d.
fn slipping(free: &Mode, d: f64) -> Option<Mode> {
    let kind = if d > 0.0 { Kind::Aperiodic } else { Kind::Divergence };
    let (omega, ratio) = if d > 0.0 { (d, 1.0) } else { (0.0, f64::NAN) };
    (d != 0.0).then(|| Mode { kind, omega, ratio, damped: 0.0, root: (-d, 0.0), shape: free.shape.clone() })
}

/// Where damping takes energy and stiffness stores it no oscillation grows: λ = a + ib has a = -xᴴ B x / 2 xᴴ M x, gyroscopic forces do no work. What a root that
/// is nearly double has left of growth is rounding.
fn resisted(mode: &mut Mode) {
    if mode.kind == Kind::Oscillation && mode.root.0 > 0.0 && mode.root.0 <= SPLIT * mode.omega {
        mode.root.0 = 0.0;
        mode.ratio = 0.0;
    }
}

/// Share of a root by which rounding may move it off the axis: a double problem splits roots by some 1e-12 of them.
const SPLIT: f64 = 1e-9;

/// Without damping an oscillation neither grows nor decays, up to rounding.
fn conservative(mode: &mut Mode) {
    if mode.kind == Kind::Oscillation && mode.root.0.abs() <= SPLIT * mode.omega {
        mode.root.0 = 0.0;
        mode.ratio = 0.0;
        mode.omega = mode.omega.max(mode.root.1);
    }
}

/// max |x_iᵀ A x_j| relative to the sum of the absolute terms, over A = M, C and i ≠ j.
fn orthogonality(system: &Matrices, stiffness: &[f64], list: &[Mode]) -> Audit {
    let n = system.n;
    let mut worst: f64 = 0.0;
    for a in [&system.mass[..], stiffness] {
        let product = |x: &Mode, y: &Mode| -> f64 { (0..n * n).map(|p| x.shape[p / n].0 * a[p] * y.shape[p % n].0).sum() };
        let size = |x: &Mode| -> f64 { (0..n * n).map(|p| (x.shape[p / n].0 * a[p] * x.shape[p % n].0).abs()).sum() };
        let sizes: Vec<f64> = list.iter().map(size).collect();
        for i in 0..list.len() {
            for j in 0..i {
                let scale = (sizes[i] * sizes[j]).sqrt();
                if scale != 0.0 {
                    worst = worse(worst, product(&list[i], &list[j]).abs() / scale);
                }
            }
        }
    }
    let name = Text::new("modes: orthogonality of the shapes in M and C", "формы колебаний: ортогональность по M и C");
    Audit::at_most("orthogonality", name, worst, RESIDUAL)
}

/// max |(λ² M + λ B + C) x| relative to the terms.
fn residual(system: &Matrices, list: &[Mode]) -> Audit {
    let n = system.n;
    let mut worst: f64 = 0.0;
    for mode in list {
        let (re, im) = mode.root;
        let square = (re * re - im * im, 2.0 * re * im);
        let (mut sum, mut size) = (vec![(0.0, 0.0); n], 0.0_f64);
        for (i, row) in sum.iter_mut().enumerate() {
            let mut terms = 0.0;
            for (j, x) in mode.shape.iter().enumerate() {
                let (m, b, c) = (system.mass[i * n + j], system.damping[i * n + j], system.stiffness[i * n + j]);
                let z = (square.0 * m + re * b + c, square.1 * m + im * b);
                row.0 += z.0 * x.0 - z.1 * x.1;
                row.1 += z.0 * x.1 + z.1 * x.0;
                let r = elementary::hypot(re, im);
                terms += (r * r * m.abs() + r * b.abs() + c.abs()) * elementary::hypot(x.0, x.1);
            }
            size = worse(size, terms);
        }
        if size != 0.0 {
            worst = sum.iter().fold(worst, |w, z| worse(w, elementary::hypot(z.0, z.1) / size));
        }
    }
    let name = Text::new("modes: residual of (λ² M + λ B + C) x = 0", "формы колебаний: невязка уравнения (λ² M + λ B + C) x = 0");
    Audit::at_most("mode_residual", name, worst, RESIDUAL)
}
