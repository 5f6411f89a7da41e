//! Forced motions of machines that nothing holds: at ω = 0, and near it without loss of digits.
//!
//! C has null directions Z (C Z = 0) and W (Wᵀ C = 0). With s = iω and A(s) = C + s B + s² M the motion is X = Z a + E b, where E are unit vectors on
//! independent columns of C, R its independent rows:
//!
//! ```text
//! Wᵀ (B + s M) (Z ã + s E b) = Wᵀ F,      (B + s M)_R Z ã + A_RE(s) b = F_R,      a = ã/s
//! ```
//!
//! C Z and Wᵀ C do not stand there, so that their rounding cannot take the place of the small inertia forces s² M. At s = 0 the first row is the
//! balance of the free motions by damping or, where that is none, by their inertia: with B = 0, WᵀM Z (s ã) = Wᵀ F is the acceleration, and
//! the elastic part follows from C X = F - M Z (s ã). Both are the first terms of Laurent's series X = Σ X_j s^j, found for any order of the pole by
//! eliminating b and dividing the rest by s, again and again.
//!
//! *Source*: K. E. Avrachenkov, M. Haviv, P. G. Howlett, Inversion of analytic matrix functions that are singular at the origin, SIAM J. Matrix Anal.
//! Appl. 22 (2001).

use crate::linear::{Matrices, largest};
use crate::studies::amplitudes::{Amplitudes, SINGULAR, balanced, cleared};
use crate::studies::shapes::Complex;
use algebra::elementary;
use algebra::qr::Qr;
use algebra::refined::{Factors, products};

/// Terms of the series that are carried: enough for poles of the order [`DEEPEST`].
const TERMS: usize = 9;
/// Share of the terms of C z that roundings leave: one in each entry of C and of z, and one in the sums of C.
const ROUNDED: f64 = 2.0 * f64::EPSILON;
/// Highest order of a pole.
const DEEPEST: usize = 4;
/// Below this ratio of the elastic terms, which cancel in a free motion, to its inertia and damping no digits worth a word are lost.
const HARMLESS: f64 = 1e2;

/// A dense matrix, row-major.
#[derive(Clone, Debug)]
struct Dense {
    rows: usize,
    columns: usize,
    data: Vec<f64>,
}

impl Dense {
    fn new(rows: usize, columns: usize, entry: impl Fn(usize, usize) -> f64) -> Dense {
        Dense { rows, columns, data: (0..rows * columns).map(|p| entry(p / columns, p % columns)).collect() }
    }

    fn zeros(rows: usize, columns: usize) -> Dense {
        Dense::new(rows, columns, |_, _| 0.0)
    }

    fn at(&self, i: usize, j: usize) -> f64 {
        self.data[i * self.columns + j]
    }

    fn times(&self, other: &Dense) -> Dense {
        Dense::new(self.rows, other.columns, |i, j| settled((0..self.columns).map(|k| self.at(i, k) * other.at(k, j))))
    }

    fn minus(&self, other: &Dense) -> Dense {
        Dense::new(self.rows, self.columns, |i, j| self.at(i, j) - other.at(i, j))
    }

    /// Rows and columns by their indices.
    fn part(&self, rows: &[usize], columns: &[usize]) -> Dense {
        Dense::new(rows.len(), columns.len(), |i, j| self.at(rows[i], columns[j]))
    }
}

/// A sum, zero where it is rounding of its terms.
pub(super) fn settled(terms: impl Iterator<Item = f64>) -> f64 {
    let (sum, size) = terms.fold((0.0, 0.0), |(s, m), t: f64| (s + t, m + t.abs()));
    if sum.abs() <= SINGULAR * size { 0.0 } else { sum }
}

/// Null directions of a square matrix on both sides, beside its independent rows and columns.
struct Split {
    /// Z, as columns.
    right: Dense,
    /// Wᵀ, as rows.
    left: Dense,
    rows: Vec<usize>,
    columns: Vec<usize>,
}

impl Split {
    /// Pivots below `small` are zero; none where rows and columns differ in rank.
    fn new(a: &Dense, small: f64) -> Option<Split> {
        let n = a.rows;
        let across = Dense::new(n, n, |i, j| a.at(j, i));
        let columns = independent(a, small);
        let thresholds = (0..40).map(|p| small * elementary::powi(1.5_f64, p));
        let rows = thresholds.map(|t| independent(&across, t)).find(|r| r.len() == columns.len())?;
        let right = null(a, &rows, &columns)?;
        let left = null(&across, &columns, &rows)?;
        let left = Dense::new(left.columns, n, |i, j| left.at(j, i));
        Some(Split { right, left, rows, columns })
    }
}

/// Independent columns, ascending.
fn independent(a: &Dense, small: f64) -> Vec<usize> {
    let length = |j: usize| (0..a.rows).fold(0.0_f64, |s, i| elementary::hypot(s, a.at(i, j)));
    let longest = (0..a.columns).map(length).fold(0.0, f64::max);
    if longest <= small {
        return Vec::new();
    }
    let mut list = Qr::alike(&a.data, a.rows, a.columns, small / longest).independent().to_vec();
    list.sort_unstable();
    list
}

/// Directions z with A z = 0, as columns: 1 in one dependent column, 0 in the others; solved in twice the digits.
fn null(a: &Dense, rows: &[usize], columns: &[usize]) -> Option<Dense> {
    let n = a.columns;
    let dependent: Vec<usize> = (0..n).filter(|j| !columns.contains(j)).collect();
    let core = a.part(rows, columns);
    let factors = Factors::new(&core.data, rows.len());
    let mut z = Dense::zeros(n, dependent.len());
    for (k, j) in dependent.iter().enumerate() {
        let right: Vec<f64> = rows.iter().map(|i| -a.at(*i, *j)).collect();
        let x = if rows.is_empty() { Vec::new() } else { factors.refined(&core.data, &right).0 };
        if x.iter().any(|v| !v.is_finite()) {
            return None;
        }
        z.data[j * dependent.len() + k] = 1.0;
        columns.iter().zip(x).for_each(|(i, v)| z.data[i * dependent.len() + k] = v);
    }
    Some(z)
}

/// Σ_j terms[j] s^(j - pole).
struct Laurent {
    pole: usize,
    terms: Vec<Dense>,
}

/// A(s)⁻¹ F(s) for a regular A(0).
fn regular(a: &[Dense], f: &[Dense]) -> Option<Vec<Dense>> {
    let (n, columns) = (f[0].rows, f[0].columns);
    let first = Factors::new(&a[0].data, n);
    let mut x: Vec<Dense> = Vec::with_capacity(f.len());
    for j in 0..f.len() {
        let mut right = f[j].clone();
        for k in (1..=j.min(a.len() - 1)).filter(|k| largest(&a[*k].data) > 0.0) {
            right = right.minus(&a[k].times(&x[j - k]));
        }
        let mut next = Dense::zeros(n, columns);
        for c in 0..columns {
            let b: Vec<f64> = (0..n).map(|i| right.at(i, c)).collect();
            let solved = if n == 0 { Vec::new() } else { first.refined(&a[0].data, &b).0 };
            if solved.iter().any(|v| !v.is_finite()) {
                return None;
            }
            solved.iter().enumerate().for_each(|(i, v)| next.data[i * columns + c] = *v);
        }
        x.push(next);
    }
    Some(x)
}

/// Σ a_k b_(j-k), as many terms as both have.
fn product(a: &[Dense], b: &[Dense]) -> Vec<Dense> {
    let count = a.len().min(b.len());
    let one = |j: usize| {
        let zero = Dense::zeros(a[0].rows, b[0].columns);
        (0..=j).fold(zero, |s, k| Dense { data: s.data.iter().zip(&a[k].times(&b[j - k]).data).map(|(x, y)| x + y).collect(), ..s })
    };
    (0..count).map(one).collect()
}

/// A(s)⁻¹ F(s) as Laurent's series; pivots of A(0) below the first of `small` are zero, those of what is left below the others.
fn laurent(a: &[Dense], f: &[Dense], small: &[f64]) -> Option<Laurent> {
    let (threshold, deeper) = small.split_first()?;
    let n = a[0].rows;
    let split = Split::new(&a[0], *threshold)?;
    if split.columns.len() == n {
        return Some(Laurent { pole: 0, terms: regular(a, f)? });
    }
    let all: Vec<usize> = (0..n).collect();
    let none: Vec<Dense> = Vec::new();
    // A Z = s K, Wᵀ A = s G
    let k: Vec<Dense> = a[1..].iter().map(|t| t.times(&split.right)).collect();
    let g: Vec<Dense> = a[1..].iter().map(|t| split.left.times(t)).collect();
    let free: Vec<usize> = (0..split.right.columns).collect();
    let bound: Vec<Dense> = a.iter().map(|t| t.part(&split.rows, &split.columns)).collect();
    let coupled: Vec<Dense> = k.iter().map(|t| t.part(&split.rows, &free)).collect();
    let loads: Vec<Dense> = f.iter().map(|t| t.part(&split.rows, &(0..t.columns).collect::<Vec<_>>())).collect();
    // P⁻¹ of the coupling and of the load: b = P⁻¹ F_R - P⁻¹ K_R ã
    let (by_free, by_load) =
        if split.columns.is_empty() { (none.clone(), none) } else { (regular(&bound, &coupled)?, regular(&bound, &loads)?) };
    let across: Vec<Dense> = g.iter().map(|t| t.part(&free, &split.columns)).collect();
    let own: Vec<Dense> = g.iter().map(|t| t.part(&free, &all).times(&split.right)).collect();
    let push = |list: Vec<Dense>| -> Vec<Dense> { std::iter::once(Dense::zeros(list[0].rows, list[0].columns)).chain(list).collect() };
    let work: Vec<Dense> = f.iter().map(|t| split.left.times(t)).collect();
    let (rest, right) = if split.columns.is_empty() {
        (own, work)
    } else {
        // G Z ã + s G E b with b = P⁻¹ (F_R - K_R ã)
        let back = push(product(&across, &by_free));
        let pulled = push(product(&across, &by_load));
        let less = |a: Vec<Dense>, b: Vec<Dense>| a.iter().zip(&b).map(|(a, b)| a.minus(b)).collect::<Vec<Dense>>();
        (less(own, back), less(work, pulled))
    };
    let right: Vec<Dense> = right.into_iter().take(rest.len()).collect();
    let inner = laurent(&rest, &right, deeper)?;
    // x = Z ã/s + E b, orders -(pole + 1) and up
    let pole = inner.pole + 1;
    let columns = f[0].columns;
    let mut terms: Vec<Dense> = inner.terms.iter().map(|t| split.right.times(t)).collect();
    if !split.columns.is_empty() {
        let moved = product(&by_free, &inner.terms);
        for (j, term) in terms.iter_mut().enumerate() {
            for (i, row) in split.columns.iter().enumerate() {
                for c in 0..columns {
                    let load = j.checked_sub(pole).and_then(|o| by_load.get(o)).map_or(0.0, |t| t.at(i, c));
                    let coupling = j.checked_sub(1).and_then(|o| moved.get(o)).map_or(0.0, |t| t.at(i, c));
                    term.data[row * columns + c] += load - coupling;
                }
            }
        }
    }
    Some(Laurent { pole, terms })
}

/// The limit ω -> 0 of X with (A₀ + s A₁ + s² A₂) X = F, s = iω, where A₀ is singular: poles and regular part; none where no finite order of the
/// pole is found. `sigma` is a rate of the machine, 1/s, by which the three matrices become comparable.
pub(super) fn at_zero(matrices: [&[f64]; 3], n: usize, sigma: f64, load: &[Complex]) -> Option<Amplitudes> {
    let scaled: Vec<Vec<f64>> = matrices.iter().zip([1.0, sigma, sigma * sigma]).map(|(a, s)| a.iter().map(|v| v * s).collect()).collect();
    let (rows, columns) = scales(&scaled, n);
    let dense = |a: &Vec<f64>| Dense::new(n, n, |i, j| a[i * n + j] * rows[i] * columns[j]);
    let mut a: Vec<Dense> = scaled.iter().map(dense).collect();
    let size = |list: &[Dense]| list.iter().map(|t| largest(&t.data)).fold(0.0, f64::max);
    let small: Vec<f64> = std::iter::once(size(&a[..1])).chain([size(&a[1..]); DEEPEST]).map(|s| SINGULAR * s).collect();
    a.resize(TERMS, Dense::zeros(n, n));
    let mut f = vec![Dense::new(n, 2, |i, c| rows[i] * if c == 0 { load[i].0 } else { load[i].1 })];
    f.resize(TERMS, Dense::zeros(n, 2));
    let found = laurent(&a, &f, &small)?;
    // s^-m in units of σ: (iω)^-m σ^m
    let term = |order: usize| -> Option<Vec<Complex>> {
        let t = found.terms.get(found.pole.checked_sub(order)?)?;
        let unit = elementary::powi(sigma, i32::try_from(order).ok()?);
        // some dozens of units of the last place of the largest entry
        let noise = 1e-14 * largest(&t.data);
        let entry = |i: usize, c: usize| if t.at(i, c).abs() <= noise { 0.0 } else { t.at(i, c) * unit * columns[i] };
        let turned = |(x, y): Complex| match order % 4 {
            1 => (y, -x),
            2 => (-x, -y),
            3 => (-y, x),
            _ => (x, y),
        };
        Some((0..n).map(|i| turned((entry(i, 0), entry(i, 1)))).collect())
    };
    let mut poles: Vec<Vec<Complex>> = (1..=found.pole).map(term).collect::<Option<_>>()?;
    while poles.last().is_some_and(|p| p.iter().all(|z| *z == (0.0, 0.0))) {
        poles.pop();
    }
    Some(Amplitudes { regular: term(0)?, poles, ..Amplitudes::default() })
}

/// Factors of rows and columns: of the first matrix, so that slow and fast parts are of one size; where that has nothing, of the sum of all.
fn scales(matrices: &[Vec<f64>], n: usize) -> (Vec<f64>, Vec<f64>) {
    let (mut rows, mut columns) = balanced(&matrices[0], n);
    let sum: Vec<f64> = (0..n * n).map(|p| matrices.iter().map(|a| a[p].abs()).sum()).collect();
    let entry = |i: usize, j: usize| matrices[0][i * n + j] != 0.0;
    let (empty_rows, empty_columns): (Vec<bool>, Vec<bool>) =
        (0..n).map(|i| (!(0..n).any(|j| entry(i, j)), !(0..n).any(|j| entry(j, i)))).unzip();
    let at: Vec<f64> = (0..n * n).map(|p| sum[p] * rows[p / n] * columns[p % n]).collect();
    let (more_rows, more_columns) = balanced(&at, n);
    (0..n).filter(|i| empty_rows[*i]).for_each(|i| rows[i] *= more_rows[i]);
    (0..n).filter(|j| empty_columns[*j]).for_each(|j| columns[j] *= more_columns[j]);
    (rows, columns)
}

/// A rate of the machine, 1/s: of its stiffest coordinate, else of the damping.
pub(super) fn pace(m: &Matrices) -> f64 {
    let n = m.n;
    let ratio = |a: &[f64]| (0..n).map(|i| a[i * n + i].abs() / m.mass[i * n + i].abs()).filter(|r| r.is_finite()).fold(0.0, f64::max);
    let (stiff, damped) = (ratio(&m.stiffness).sqrt(), ratio(&m.damping));
    [stiff, damped].into_iter().find(|r| *r > 0.0).unwrap_or(1.0)
}

/// Null directions of C beside its independent rows and columns, with Z as columns and Wᵀ as rows in the coordinates of the machine; none where C is regular.
fn split(m: &Matrices) -> Option<(Split, Dense, Dense)> {
    let n = m.n;
    let (rows, columns) = balanced(&m.stiffness, n);
    let c = Dense::new(n, n, |i, j| m.stiffness[i * n + j] * rows[i] * columns[j]);
    if Factors::new(&c.data, n).is_sound(&c.data) {
        return None;
    }
    let split = Split::new(&c, SINGULAR * largest(&c.data)).filter(|s| s.columns.len() < n)?;
    let k = split.right.columns;
    let z = Dense::new(n, k, |i, j| split.right.at(i, j) * columns[i]);
    let w = Dense::new(k, n, |i, j| split.left.at(i, j) * rows[j]);
    Some((split, z, w))
}

/// Directions z, and w, each by coordinate.
pub(super) type Directions = (Vec<Vec<f64>>, Vec<Vec<f64>>);

/// Free motions: directions z with C z = 0 and w with wᵀ C = 0, in the coordinates of the machine; none where nothing is free, or where something weak may restore
/// what seems free.
pub(super) fn directions(m: &Matrices) -> Option<Directions> {
    let n = m.n;
    let (_, z, w) = split(m)?;
    let right: Vec<Vec<f64>> = (0..z.columns).map(|j| (0..n).map(|i| z.at(i, j)).collect()).collect();
    let stiffness = Dense { rows: n, columns: n, data: m.stiffness.clone() };
    let left = || (0..w.rows).map(|i| (0..n).map(|j| w.at(i, j)).collect()).collect();
    right.iter().all(|z| unrestored(&stiffness, z)).then(|| (right.clone(), left()))
}

/// The forced motion at a low ω > 0, free and elastic part apart; none where nothing is free, where no digits are at stake, or where the machine
/// resounds.
pub(super) fn apart(m: &Matrices, omega: f64, load: &[Complex]) -> Option<Amplitudes> {
    let n = m.n;
    let (split, z, w) = split(m)?;
    let k = split.right.columns;
    let whole = |a: &[f64]| Dense { rows: n, columns: n, data: a.to_vec() };
    let (stiffness, damping, mass) = (whole(&m.stiffness), whole(&m.damping), whole(&m.mass));
    let (bz, mz, wb, wm) = (damping.times(&z), mass.times(&z), w.times(&damping), w.times(&mass));
    let (wbz, wmz) = (w.times(&bz), w.times(&mz));
    if !(0..k).all(|j| unrestored(&stiffness, &(0..n).map(|i| z.at(i, j)).collect::<Vec<f64>>())) {
        return None;
    }
    // of each row, what cancels in C Z beside what is left
    let cancels = |i: usize, j: usize| (0..n).map(|l| (stiffness.at(i, l) * z.at(l, j)).abs()).sum::<f64>();
    let left = |i: usize, j: usize| omega * bz.at(i, j).abs() + omega * omega * mz.at(i, j).abs();
    if (0..n).all(|i| (0..k).all(|j| cancels(i, j) <= HARMLESS * left(i, j))) {
        return None;
    }
    let entry = |r: usize, c: usize| -> Complex {
        let at = |a: &Dense, b: &Dense, i: usize, j: usize| (a.at(i, j), omega * b.at(i, j));
        match (r < k, c < k) {
            (true, true) => at(&wbz, &wmz, r, c),
            (true, false) => {
                let (b, m) = at(&wb, &wm, r, split.columns[c - k]);
                (-omega * m, omega * b)
            }
            (false, true) => at(&bz, &mz, split.rows[r - k], c),
            (false, false) => {
                let p = split.rows[r - k] * n + split.columns[c - k];
                (stiffness.data[p] - omega * omega * mass.data[p], omega * damping.data[p])
            }
        }
    };
    let work = |j: usize| (0..n).fold((0.0, 0.0), |s, i| (s.0 + w.at(j, i) * load[i].0, s.1 + w.at(j, i) * load[i].1));
    let right: Vec<Complex> = (0..k).map(work).chain(split.rows.iter().map(|i| load[*i])).collect();
    let (x, doubt) = solved(&|r, c| entry(r, c), &right, n)?;
    let mut regular = vec![(0.0, 0.0); n];
    split.columns.iter().zip(&x[k..]).for_each(|(i, b)| regular[*i] = *b);
    // a = ã/(iω)
    let direction = |j: usize| (0..n).map(|i| z.at(i, j)).collect::<Vec<f64>>();
    let free = (0..k).map(|j| (direction(j), (x[j].1 / omega, -x[j].0 / omega))).collect();
    Some(Amplitudes { regular, free, doubt, ..Amplitudes::default() })
}

/// Whether a motion counts as free whose stiffness is below that of the smallest pivot, but more than rounding leaves of its terms: a weak spring beside strong
/// ones, of which the sums keep too few digits.
pub(super) fn is_barely_held(m: &Matrices) -> bool {
    let n = m.n;
    let (rows, columns) = balanced(&m.stiffness, n);
    let c = Dense::new(n, n, |i, j| m.stiffness[i * n + j] * rows[i] * columns[j]);
    let Some(split) = Split::new(&c, SINGULAR * largest(&c.data)).filter(|s| s.columns.len() < n) else { return false };
    let stiffness = Dense { rows: n, columns: n, data: m.stiffness.clone() };
    let direction = |j: usize| (0..n).map(|i| split.right.at(i, j) * columns[i]).collect::<Vec<f64>>();
    !(0..split.right.columns).all(|j| unrestored(&stiffness, &direction(j)))
}

/// Whether C z, in twice the digits, is what the roundings of C and z leave of its terms: more may be a weak spring beside strong ones.
fn unrestored(stiffness: &Dense, z: &[f64]) -> bool {
    let n = z.len();
    let terms = |i: usize| (0..n).map(|l| (stiffness.at(i, l) * z[l]).abs()).sum::<f64>();
    products(&stiffness.data, n, z).iter().enumerate().all(|(i, f)| f.abs() <= ROUNDED * terms(i))
}

/// A square complex system in balanced real form, refined; none where it is singular.
fn solved(entry: &dyn Fn(usize, usize) -> Complex, right: &[Complex], n: usize) -> Option<(Vec<Complex>, f64)> {
    let sizes: Vec<f64> = (0..n * n).map(|p| entry(p / n, p % n)).map(|z| elementary::hypot(z.0, z.1)).collect();
    let (rows, columns) = balanced(&sizes, n);
    let mut a = vec![0.0; 4 * n * n];
    for p in 0..n * n {
        let (i, j) = (p / n, p % n);
        let (re, im) = entry(i, j);
        let by = rows[i] * columns[j];
        (a[i * 2 * n + j], a[i * 2 * n + n + j]) = (re * by, -im * by);
        (a[(n + i) * 2 * n + j], a[(n + i) * 2 * n + n + j]) = (im * by, re * by);
    }
    let f: Vec<f64> = right.iter().zip(&rows).map(|(z, r)| z.0 * r).chain(right.iter().zip(&rows).map(|(z, r)| z.1 * r)).collect();
    if Qr::alike(&a, 2 * n, 2 * n, SINGULAR).rank() < 2 * n {
        return None;
    }
    let (mut x, doubt) = Factors::new(&a, 2 * n).refined(&a, &f);
    if doubt.is_nan() {
        return None;
    }
    cleared(&a, &f, &mut x);
    Some(((0..n).map(|i| (x[i] * columns[i], x[n + i] * columns[i])).collect(), doubt))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studies::amplitudes::Gain;
    use crate::studies::impedance::solve;

    /// Twists and rates in closed form: sums of a few terms about ten.
    const ROUNDING: f64 = 1e-13;
    /// The same with three discs.
    const EXACT: f64 = 1e-12;
    /// A rate that follows only behind the twist: the load times the condition of the rest.
    const NEAR: f64 = 1e-10;
    /// A frequency of 1e-9 stands for zero: what the next power of it leaves.
    const LIMIT: f64 = 1e-6;

    /// Two discs J1, J2 on a shaft k with a damper b to the ground on the first: free of stiffness.
    fn discs(b: f64) -> Matrices {
        Matrices {
            n: 2,
            mass: vec![2.0, 0.0, 0.0, 6.0],
            damping: vec![b, 0.0, 0.0, 0.0],
            stiffness: vec![200.0, -200.0, -200.0, 200.0],
            ..Matrices::default()
        }
    }

    fn seen(x: &Amplitudes, place: [f64; 2], acceleration: [f64; 2], omega: f64) -> Complex {
        x.seen(&Gain { place: &place, rate: &[0.0, 0.0], acceleration: &acceleration, omega })
    }

    #[test]
    fn a_free_machine_balances_its_load_by_inertia() {
        // twist k (a - b) = M J2/(J1 + J2), acceleration M/(J1 + J2)
        for omega in [0.0, 1e-9, 1e-6, 1e-3] {
            let x = solve(&discs(0.0), omega, &[(8.0, 0.0), (0.0, 0.0)]);
            let twist = seen(&x, [200.0, -200.0], [0.0; 2], omega);
            let right = 6.0 / (1.0 - omega * omega * 12.0 / (8.0 * 200.0));
            assert!((twist.0 - right).abs() < ROUNDING * right && twist.1 == 0.0, "{omega}: {twist:?}");
            // the free motion at ω = 1e-3 beside the twist, which is smaller by ω²
            assert!((seen(&x, [0.0; 2], [1.0, 0.0], omega).0 - 1.0).abs() < 1e-5);
        }
    }

    #[test]
    fn a_damper_of_the_free_motion_carries_the_load_at_rest() {
        // at ω -> 0 the first disc's damper takes all of a load on the second: twist -8, rate 8/b
        for omega in [0.0, 1e-9] {
            let x = solve(&discs(0.5), omega, &[(0.0, 0.0), (8.0, 0.0)]);
            assert!((seen(&x, [200.0, -200.0], [0.0; 2], omega).0 + 8.0).abs() < LIMIT);
            let rate = x.seen(&Gain { place: &[0.0; 2], rate: &[1.0, 0.0], acceleration: &[0.0; 2], omega });
            assert!((rate.0 - 16.0).abs() < LIMIT, "{rate:?}");
        }
    }

    #[test]
    fn a_gyroscopic_coupling_adds_to_the_inertia_of_a_free_motion() {
        // I x'' + G y' = F, J y'' - G x' + k y = 0: at rest x'' = F/(I + G²/k), y' G = F - I x''
        let m = Matrices {
            n: 2,
            mass: vec![2.0, 0.0, 0.0, 3.0],
            damping: vec![0.0, 5.0, -5.0, 0.0],
            stiffness: vec![0.0, 0.0, 0.0, 10.0],
            ..Matrices::default()
        };
        let x = solve(&m, 0.0, &[(9.0, 0.0), (0.0, 0.0)]);
        assert!((seen(&x, [0.0; 2], [1.0, 0.0], 0.0).0 - 2.0).abs() < ROUNDING);
        assert!(seen(&x, [1.0, 0.0], [0.0; 2], 0.0).0.is_infinite());
    }

    #[test]
    fn several_free_motions_keep_their_digits_together() {
        // the discs with a third body on a damper between them, whatever the order of rows
        let mut m = Matrices { n: 3, mass: vec![0.0; 9], damping: vec![0.0; 9], stiffness: vec![0.0; 9], ..Matrices::default() };
        (m.mass[0], m.mass[4], m.mass[8], m.damping[4]) = (2.0, 5.0, 6.0, 0.5);
        (m.stiffness[0], m.stiffness[2], m.stiffness[6], m.stiffness[8]) = (200.0, -200.0, -200.0, 200.0);
        for omega in [0.0, 1e-7] {
            let x = solve(&m, omega, &[(8.0, 0.0), (3.0, 0.0), (0.0, 0.0)]);
            let none = [0.0; 3];
            let twist = x.seen(&Gain { place: &[200.0, 0.0, -200.0], rate: &none, acceleration: &none, omega });
            let rate = x.seen(&Gain { place: &none, rate: &[0.0, 1.0, 0.0], acceleration: &none, omega });
            assert!((twist.0 - 6.0).abs() < EXACT && (rate.0 - 6.0).abs() < NEAR, "{omega}: {twist:?} {rate:?}");
        }
    }
}
