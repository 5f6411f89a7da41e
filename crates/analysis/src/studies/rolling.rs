//! Small motions with conditions on rates that restrain no places: J δq' + D δq = 0 (a caster, a coin, a skate, a trailer).
//!
//! Places are restrained by the other conditions alone, δq = Z y; rates have to satisfy A y' + D y = 0 with A = J Z, so that
//!
//! ```text
//! y'             = P y + N u,           A P = -D, A N = 0
//! Nᵀ M N u'      = -Nᵀ (M P P + B P + C) y - Nᵀ (M P + B) N u
//! ```
//!
//! with M, B, C along Z: n coordinates and n - m rates, so that roots need not come in pairs. The reactions do no work along Z N and are gone; their
//! change of direction is in C. Roots at zero (places that nothing restores, families of steady motions) form chains, which rounding would split by its
//! cube root: null spaces are taken off one after another before the other roots are sought.
//!
//! *Source*: Ju. I. Neimark, N. A. Fufaev, Dynamics of Nonholonomic Systems, ch. V and VI.

use algebra::arrange::Arrange;
use algebra::elementary;
use words::Text;

use crate::audits::worse;
use crate::dataset::Audit;
use crate::fault::small::refused;
use crate::linear::{Matrices, largest, parts};
use crate::studies::amplitudes::{Amplitudes, SINGULAR};
use crate::studies::shapes::{Complex, Damping, Kind, Mode, Modes, Normalisation, check_mass, normalise, pairs, remarks};
use crate::{Fault, Quantity};
use algebra::lu::Lu;
use algebra::qr::{DEPENDENT, Qr};
use algebra::vectors::dot;
use algebra::{eigen, qr};
use words::explain::{Explanation, plain};

/// Largest residual of a root in the equations and conditions as they stand, relative to its terms.
const RESIDUAL: f64 = 1e-8;
/// A real part below this share of the root is rounding.
const ON_AXIS: f64 = 1e-10;

/// S092.
pub const REFUSED: Explanation =
    plain("S092", ("conditions that leave no linear equations", "связи, не допускающие линейных уравнений"), (REFUSED_EN, REFUSED_RU));
const REFUSED_EN: &str = "Small motions need equations whose coefficients are constant and which give every acceleration and reaction. Here conditions on rates \
    contradict each other beside the place (a combination of them restrains no rate but the place itself), or the equations give no acceleration at the start. Wrong: \
    zero_rate of two wheels of one car that cannot turn on one circle. Right: leave out the condition that repeats another one, or follow the motion with `simulate` or \
    `periodic`.";
const REFUSED_RU: &str = "Для малых движений нужны уравнения с постоянными коэффициентами, дающие все ускорения и реакции. Здесь связи на скорости противоречат друг другу \
    вблизи положения (их комбинация ограничивает не скорость, а само положение), либо уравнения не дают ускорений в начале движения. Неверно: zero_rate двух колёс, которые не могут \
    катиться по одной окружности. Верно: уберите связь, повторяющую другую, или проследите движение в `simulate` либо `periodic`.";

/// y' = P y + N u of scaled coordinates δq_i = scale_i Σ z_ic y_c; matrices row-major.
struct Form {
    n: usize,
    k: usize,
    p: usize,
    /// n x k, scales included.
    z: Vec<f64>,
    /// k x k.
    drift: Vec<f64>,
    /// k x p.
    free: Vec<f64>,
}

impl Form {
    fn new(m: &Matrices) -> Result<Form, Fault> {
        let n = m.n;
        let unit = |i: usize| if m.mass[i * n + i] > 0.0 { m.mass[i * n + i].sqrt().recip() } else { 1.0 };
        let scale: Vec<f64> = (0..n).map(unit).collect();
        let rows = |from: &[f64], on_rates: bool| -> Vec<Vec<f64>> {
            let wanted = from.chunks(n.max(1)).zip(&m.on_rates).filter(|(_, r)| **r == on_rates);
            wanted.map(|(row, _)| row.iter().zip(&scale).map(|(v, s)| v * s).collect()).collect()
        };
        let places: Vec<Vec<f64>> = rows(&m.jacobian, false).into_iter().map(|r| alike(&r, largest(&r))).collect();
        let z = complement(&places, n);
        let k = z.len();
        let columns = |row: &Vec<f64>| -> Vec<f64> { z.iter().map(|d| dot(d, row)).collect() };
        let (rates, drifts) = (rows(&m.jacobian, true), rows(&m.drift, true));
        let sizes: Vec<f64> = rates.iter().map(|r| largest(r)).collect();
        let a: Vec<Vec<f64>> = rates.iter().zip(&sizes).map(|(r, s)| alike(&columns(r), *s)).collect();
        let d: Vec<Vec<f64>> = drifts.iter().zip(&sizes).map(|(r, s)| alike(&columns(r), *s)).collect();
        let free = complement(&a, k);
        let p = free.len();
        let qr = Qr::alike(&a.concat(), a.len(), k, DEPENDENT);
        let mut drift = vec![0.0; k * k];
        for c in 0..k {
            let right: Vec<f64> = d.iter().map(|row| -row[c]).collect();
            let (x, residual) = if a.is_empty() { (vec![0.0; k], 0.0) } else { qr.least_squares(&right) };
            // conditions that contradict leave a residual of their own size
            if residual > 1e-9 * largest(&d.concat()) {
                return Err(refused(Text::new(
                    "a combination of the conditions on rates restrains no rate but the place",
                    "комбинация связей на скорости ограничивает не скорость, а положение",
                )));
            }
            x.iter().enumerate().for_each(|(i, v)| drift[i * k + c] = *v);
        }
        let mut flat = vec![0.0; n * k];
        (0..n * k).for_each(|e| flat[e] = scale[e / k] * z[e % k][e / k]);
        let free = (0..k * p).map(|e| free[e % p][e / p]).collect();
        Ok(Form { n, k, p, z: flat, drift, free })
    }

    /// Z N, n x p.
    fn allowed(&self) -> Vec<f64> {
        product(&self.z, &self.free, [self.n, self.k, self.p])
    }

    /// The matrix of d/dt (y, u).
    fn state(&self, m: &Matrices, names: &[Quantity]) -> Result<Vec<f64>, Fault> {
        let (k, p, d) = (self.k, self.p, self.k + self.p);
        let along = m.reduced(&self.z, k);
        let inertia = m.reduced(&self.allowed(), p).mass;
        check_mass(&inertia, p, names)?;
        let lu = Lu::new(&inertia, p);
        let moved = product(&along.mass, &self.drift, [k, k, k]);
        let by_rate: Vec<f64> = moved.iter().zip(&along.damping).map(|(a, b)| a + b).collect();
        let by_place = product(&by_rate, &self.drift, [k, k, k]);
        let by_place: Vec<f64> = by_place.iter().zip(&along.stiffness).map(|(a, b)| a + b).collect();
        let by_rate = product(&by_rate, &self.free, [k, k, p]);
        let mut s = vec![0.0; d * d];
        for i in 0..k {
            s[i * d..i * d + k].copy_from_slice(&self.drift[i * k..(i + 1) * k]);
            s[i * d + k..(i + 1) * d].copy_from_slice(&self.free[i * p..(i + 1) * p]);
        }
        for c in 0..d {
            let entry = |i: usize| if c < k { by_place[i * k + c] } else { by_rate[i * p + c - k] };
            let right: Vec<f64> = (0..p).map(|r| -(0..k).map(|i| self.free[i * p + r] * entry(i)).sum::<f64>()).collect();
            let column = lu.solve(&right).ok_or_else(|| refused(Text::new("the inertia is singular", "матрица инерции вырождена")))?;
            column.iter().enumerate().for_each(|(r, v)| s[(k + r) * d + c] = *v);
        }
        Ok(s)
    }

    /// δq of y.
    fn shape(&self, y: &[Complex]) -> Vec<Complex> {
        let sum = |i: usize, part: fn(&Complex) -> f64| (0..self.k).map(|c| self.z[i * self.k + c] * part(&y[c])).sum();
        (0..self.n).map(|i| (sum(i, |z| z.0), sum(i, |z| z.1))).collect()
    }
}

/// Modes whose roots are not zero; the others are counted.
///
/// *Errors*: S031 for inertia that is not positive, S092 for conditions that contradict each other, faults of the eigensolver.
pub(super) fn modes(m: &Matrices, names: &[Quantity], normalisation: Normalisation) -> Result<Modes, Fault> {
    let form = Form::new(m)?;
    let (k, d) = (form.k, form.k + form.p);
    let mut s = form.state(m, names)?;
    // u and the time in units that make the rates of like size
    let rate = (0..d * d).fold(0.0_f64, |r, e| match (e / d >= k, e % d >= k) {
        (false, true) => r,
        (true, false) => r.max(s[e].abs().sqrt()),
        _ => r.max(s[e].abs()),
    });
    let rate = if rate > 0.0 { rate } else { 1.0 };
    for (e, v) in s.iter_mut().enumerate() {
        *v /= match (e / d >= k, e % d >= k) {
            (false, true) => 1.0,
            (true, false) => rate * rate,
            _ => rate,
        };
    }
    let stairs = Stairs::new(s, d);
    let found = eigen::general(stairs.left, &stairs.core)?;
    let mut list = Vec::new();
    for (j, root) in pairs(&found.values).iter().enumerate().filter(|(_, root)| root.1 >= 0.0) {
        let state = stairs.lifted(*root, &pairs(found.vector(j)));
        list.push(mode((root.0 * rate, root.1 * rate), form.shape(&state[..k])));
    }
    list.arrange_by(|a, b| a.omega.total_cmp(&b.omega).then(a.root.0.total_cmp(&b.root.0)));
    let mut notes = Vec::new();
    for (i, mode) in list.iter_mut().enumerate() {
        notes.extend(normalise(mode, &m.mass, normalisation).map(|what| what(i + 1)));
    }
    notes.extend(remarks(&list));
    notes.push(counted(d - stairs.left, d));
    // rounding of the parts is no gyroscopic or follower force
    let (present, along) = (|part: &[f64], whole: &[f64]| largest(part) > 1e-12 * largest(whole), m.reduced(&form.z, k));
    let gyroscopic = present(&parts(&along.damping, k).1, &along.damping);
    let circulatory = present(&parts(&along.stiffness, k).1, &along.stiffness);
    let audits = vec![residual(m, &form.allowed(), form.p, &list)];
    Ok(Modes {
        modes: list,
        damping: Damping::General,
        gyroscopic,
        circulatory,
        undamped: Vec::new(),
        audits,
        notes,
        zeros: d - stairs.left,
    })
}

fn mode((re, im): Complex, shape: Vec<Complex>) -> Mode {
    let size = elementary::hypot(re, im);
    let re = if re.abs() <= ON_AXIS * size { 0.0 } else { re };
    let kind = match () {
        () if im > 0.0 => Kind::Oscillation,
        () if re > 0.0 => Kind::Divergence,
        () => Kind::Aperiodic,
    };
    let (omega, ratio) = if kind == Kind::Divergence { (0.0, f64::NAN) } else { (size, 0.0 - re / size) };
    Mode { kind, omega, damped: im, ratio, root: (re, im), shape }
}

fn counted(zeros: usize, all: usize) -> Text {
    Text::new(
        format!(
            "conditions on rates: {all} roots, {zeros} of them zero (places and steady motions that nothing restores), the others in the table; \
             a real root is one motion, not two"
        ),
        format!(
            "связи на скорости: корней {all}, из них нулевых {zeros} (положения и стационарные движения, которые ничто не восстанавливает), остальные в таблице; \
             вещественному корню отвечает одно движение, а не два"
        ),
    )
}

/// A matrix without its roots at zero: Qᵀ S Q = [0 X; 0 core] again and again.
struct Stairs {
    left: usize,
    core: Vec<f64>,
    /// Columns of Q (null space first), how many of them are null, X.
    steps: Vec<(Vec<Vec<f64>>, usize, Vec<f64>)>,
}

impl Stairs {
    fn new(s: Vec<f64>, d: usize) -> Stairs {
        let mut out = Stairs { left: d, core: s, steps: Vec::new() };
        while out.left > 0 {
            let d = out.left;
            let null = orthonormal(qr::null_space(&out.core, d, d));
            if null.is_empty() {
                break;
            }
            let k = null.len();
            let rest = complement(&null, d);
            let columns: Vec<Vec<f64>> = null.into_iter().chain(rest).collect();
            let moved: Vec<Vec<f64>> =
                columns[k..].iter().map(|c| (0..d).map(|i| dot(&out.core[i * d..(i + 1) * d], c)).collect()).collect();
            let entry = |row: usize, column: usize| dot(&columns[row], &moved[column]);
            let left = d - k;
            let x = (0..k * left).map(|e| entry(e / left.max(1), e % left.max(1))).collect();
            out.core = (0..left * left).map(|e| entry(k + e / left, e % left)).collect();
            out.steps.push((columns, k, x));
            out.left = left;
        }
        out
    }

    /// The vector of the whole matrix for one of the core: (X b/λ, b) at each step.
    fn lifted(&self, root: Complex, core: &[Complex]) -> Vec<Complex> {
        let square = root.0 * root.0 + root.1 * root.1;
        let over = |z: Complex| ((z.0 * root.0 + z.1 * root.1) / square, (z.1 * root.0 - z.0 * root.1) / square);
        let mut b = core.to_vec();
        for (columns, k, x) in self.steps.iter().rev() {
            let left = b.len();
            let sum = |r: usize| (0..left).fold((0.0, 0.0), |s, c| (s.0 + x[r * left + c] * b[c].0, s.1 + x[r * left + c] * b[c].1));
            let all: Vec<Complex> = (0..*k).map(|r| over(sum(r))).chain(b.iter().copied()).collect();
            let at = |i: usize| columns.iter().zip(&all).fold((0.0, 0.0), |s, (q, z)| (s.0 + q[i] * z.0, s.1 + q[i] * z.1));
            b = (0..columns.len()).map(at).collect();
        }
        b
    }
}

/// The amplitudes that a load F exp(iωt) forces: Wᵀ (C - ω² M + iω B) X = Wᵀ F along the rates W that the conditions allow, J X = 0 and (iω J + D) X = 0.
/// A free oscillation that the load meets makes its coordinates infinite.
pub(super) fn forced(m: &Matrices, omega: f64, load: &[Complex]) -> Amplitudes {
    let n = m.n;
    let Ok(form) = Form::new(m) else {
        return Amplitudes { regular: vec![(f64::NAN, f64::NAN); n], doubt: f64::NAN, ..Amplitudes::default() };
    };
    let (w, p) = (form.allowed(), form.p);
    let unit = |i: usize| if m.mass[i * n + i] > 0.0 { m.mass[i * n + i].sqrt().recip() } else { 1.0 };
    let scale: Vec<f64> = (0..n).map(unit).collect();
    let mut rows: Vec<(Vec<Complex>, Complex)> = Vec::new();
    for c in 0..p {
        let along = |a: &[f64], j: usize| (0..n).map(|i| w[i * p + c] * a[i * n + j]).sum::<f64>();
        let row = |j: usize| (along(&m.stiffness, j) - omega * omega * along(&m.mass, j), omega * along(&m.damping, j));
        let right = (0..n).fold((0.0, 0.0), |s, i| (s.0 + w[i * p + c] * load[i].0, s.1 + w[i * p + c] * load[i].1));
        rows.push(((0..n).map(row).collect(), right));
    }
    for (r, on_rates) in m.on_rates.iter().enumerate() {
        let row = |j: usize| if *on_rates { (m.drift[r * n + j], omega * m.jacobian[r * n + j]) } else { (m.jacobian[r * n + j], 0.0) };
        rows.push(((0..n).map(row).collect(), (0.0, 0.0)));
    }
    let (mut a, mut right) = (Vec::new(), Vec::new());
    for (row, f) in &rows {
        let size = row.iter().zip(&scale).fold(0.0_f64, |s, (z, u)| s.max(elementary::hypot(z.0, z.1) * u));
        let over = if size > 0.0 { size.recip() } else { 1.0 };
        let part = |sign: f64, first: fn(&Complex) -> f64, second: fn(&Complex) -> f64| -> Vec<f64> {
            let left = row.iter().zip(&scale).map(|(z, u)| first(z) * u * over);
            left.chain(row.iter().zip(&scale).map(|(z, u)| sign * second(z) * u * over)).collect()
        };
        a.extend(part(-1.0, |z| z.0, |z| z.1));
        a.extend(part(1.0, |z| z.1, |z| z.0));
        right.extend([f.0 * over, f.1 * over]);
    }
    let qr = Qr::alike(&a, 2 * rows.len(), 2 * n, SINGULAR);
    let back = |x: &[f64]| -> Vec<Complex> { (0..n).map(|i| (x[i] * scale[i], x[n + i] * scale[i])).collect() };
    let regular = back(&qr.least_squares(&right).0);
    let free = qr.null_space();
    if free.is_empty() {
        return Amplitudes { regular, ..Amplitudes::default() };
    }
    let at_rest = (omega == 0.0).then(|| at_zero(m, &w, p, load)).flatten();
    let pole = || back(&(0..2 * n).map(|i| free.iter().map(|x| x[i]).sum()).collect::<Vec<f64>>());
    at_rest.unwrap_or_else(|| Amplitudes { regular, poles: vec![pole()], ..Amplitudes::default() })
}

/// The limit of the same for ω -> 0 where free motions are left: Wᵀ (C + s B + s² M) X = Wᵀ F, (D + s J) X = 0.
fn at_zero(m: &Matrices, w: &[f64], p: usize, load: &[Complex]) -> Option<Amplitudes> {
    let n = m.n;
    if p + m.on_rates.len() != n {
        return None;
    }
    let along = |a: &[f64]| (0..p * n).map(|e| (0..n).map(|i| w[i * p + e / n] * a[i * n + e % n]).sum()).collect::<Vec<f64>>();
    let [mut first, mut second, mut third] = [along(&m.stiffness), along(&m.damping), along(&m.mass)];
    let none = vec![0.0; n];
    for (r, on_rates) in m.on_rates.iter().enumerate() {
        let row = |a: &[f64]| a[r * n..(r + 1) * n].to_vec();
        let (place, rate) = if *on_rates { (row(&m.drift), row(&m.jacobian)) } else { (row(&m.jacobian), none.clone()) };
        first.extend(place);
        second.extend(rate);
        third.extend(&none);
    }
    let onto = |c: usize| (0..n).fold((0.0, 0.0), |s, i| (s.0 + w[i * p + c] * load[i].0, s.1 + w[i * p + c] * load[i].1));
    let right: Vec<Complex> = (0..n).map(|c| if c < p { onto(c) } else { (0.0, 0.0) }).collect();
    super::free_motion::at_zero([&first, &second, &third], n, super::free_motion::pace(m), &right)
}

/// Each root in the equations and conditions as they stand: Wᵀ (λ² M + λ B + C) x, J x and (λ J + D) x, relative to their terms.
fn residual(m: &Matrices, w: &[f64], p: usize, list: &[Mode]) -> Audit {
    let n = m.n;
    let mut worst = 0.0_f64;
    for mode in list {
        let (re, im) = mode.root;
        let (square, size) = ((re * re - im * im, 2.0 * re * im), elementary::hypot(re, im));
        let of = |mass: f64, damping: f64, stiffness: f64| -> (Complex, f64) {
            let sum = (square.0 * mass + re * damping + stiffness, square.1 * mass + im * damping);
            (sum, size * size * mass.abs() + size * damping.abs() + stiffness.abs())
        };
        let unit = |j: usize| if m.mass[j * n + j] > 0.0 { m.mass[j * n + j].sqrt().recip() } else { 0.0 };
        let reach =
            (0..n).fold(0.0_f64, |r, j| r.max(elementary::hypot(mode.shape[j].0, mode.shape[j].1) * m.mass[j * n + j].abs().sqrt()));
        let mut check = |row: &dyn Fn(usize) -> (Complex, f64)| {
            let (mut sum, mut terms) = ((0.0, 0.0), 0.0);
            for (j, x) in mode.shape.iter().enumerate() {
                let (z, s) = row(j);
                sum = (sum.0 + z.0 * x.0 - z.1 * x.1, sum.1 + z.0 * x.1 + z.1 * x.0);
                // a coordinate that only rounding moves counts with the size of the shape, in kinetic energy
                terms += s * elementary::hypot(x.0, x.1).max(reach * unit(j));
            }
            if terms != 0.0 {
                worst = worse(worst, elementary::hypot(sum.0, sum.1) / terms);
            }
        };
        for c in 0..p {
            let along = |a: &[f64], j: usize| -> (f64, f64) {
                (0..n).fold((0.0, 0.0), |s, i| (s.0 + w[i * p + c] * a[i * n + j], s.1 + (w[i * p + c] * a[i * n + j]).abs()))
            };
            check(&|j| {
                let ((a, aa), (b, bb), (s, ss)) = (along(&m.mass, j), along(&m.damping, j), along(&m.stiffness, j));
                (of(a, b, s).0, of(aa, bb, ss).1)
            });
        }
        for (r, on_rates) in m.on_rates.iter().enumerate() {
            check(&|j| match on_rates {
                true => of(0.0, m.jacobian[r * n + j], m.drift[r * n + j]),
                false => of(0.0, 0.0, m.jacobian[r * n + j]),
            });
        }
    }
    let name = Text::new(
        "modes: residual of the equations and the conditions on rates",
        "формы колебаний: невязка уравнений и связей на скорости",
    );
    Audit::at_most("mode_residual", name, worst, RESIDUAL)
}

fn alike(row: &[f64], size: f64) -> Vec<f64> {
    row.iter().map(|v| if size > 0.0 { v / size } else { 0.0 }).collect()
}

/// Row-major A (r x c) times B (c x q).
fn product(a: &[f64], b: &[f64], [r, c, q]: [usize; 3]) -> Vec<f64> {
    (0..r * q).map(|e| (0..c).map(|j| a[(e / q) * c + j] * b[j * q + e % q]).sum()).collect()
}

/// An orthonormal basis of what all rows leave at zero, in n dimensions.
fn complement(rows: &[Vec<f64>], n: usize) -> Vec<Vec<f64>> {
    let rows: Vec<&Vec<f64>> = rows.iter().filter(|r| largest(r) > 0.0).collect();
    if rows.is_empty() {
        return (0..n).map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect()).collect();
    }
    let flat: Vec<f64> = rows.iter().flat_map(|r| r.iter().copied()).collect();
    orthonormal(qr::null_space(&flat, rows.len(), n))
}

/// Gram and Schmidt, twice.
fn orthonormal(vectors: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let mut out: Vec<Vec<f64>> = Vec::with_capacity(vectors.len());
    for mut v in vectors {
        for _ in 0..2 {
            for q in &out {
                let share = dot(q, &v);
                v.iter_mut().zip(q).for_each(|(x, y)| *x -= share * y);
            }
            let length = dot(&v, &v).sqrt();
            v.iter_mut().for_each(|x| *x /= length);
        }
        out.push(v);
    }
    out
}
