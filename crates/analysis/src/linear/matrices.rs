//! The matrices of small motions.

use algebra::double::Double;
use algebra::qr;
use words::Text;

/// The matrices of small motions, row-major n x n, SI.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Matrices {
    /// Number of coordinates.
    pub n: usize,
    /// M, symmetric.
    pub mass: Vec<f64>,
    /// B; its antisymmetric part is gyroscopic.
    pub damping: Vec<f64>,
    /// C; its antisymmetric part is circulatory.
    pub stiffness: Vec<f64>,
    /// What C has below its last digits, row by row as C; empty where that is not known, for formulas of places and of more than the four operations.
    pub below: Vec<f64>,
    /// The same of B where a weak damper lies there beside a hard one; else empty.
    pub damping_below: Vec<f64>,
    /// Whether a weak damper may lie there and nobody knows: B hangs on what is known in single digits only.
    pub damping_open: bool,
    /// Mean force at the state: zero at an equilibrium.
    pub force: Vec<f64>,
    /// Harmonic loads.
    pub loads: Vec<Harmonic>,
    /// Loads of other waveforms: index of the form, factor on each coordinate.
    pub shaped: Vec<(usize, Vec<f64>)>,
    /// Conditions J δq = 0 of connections, row-major; empty without.
    pub jacobian: Vec<f64>,
    /// Where conditions on rates restrain no places: D of J δq' + D δq = 0, row by row as `jacobian`. Empty where all conditions
    /// restrain places.
    pub drift: Vec<f64>,
    /// Which rows are such conditions; as long as `drift` has rows.
    pub on_rates: Vec<bool>,
}

/// A harmonic load: c cos ν t + s sin ν t on each coordinate.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Harmonic {
    /// ν, rad/s.
    pub rate: f64,
    /// c.
    pub cos: Vec<f64>,
    /// s.
    pub sin: Vec<f64>,
}

/// Sums of two products of n terms that cancel to this share of their terms are rounding.
const CANCELLED: f64 = 256.0 * f64::EPSILON;

/// The same in twice the digits, and the squares of roundings of a basis.
const FINE: f64 = 1e-28;

/// Rounding of stiffnesses is small beside the largest of them; a bound beyond this share of it says nothing.
const ROUNDING: f64 = 1e-12;

/// Stiffnesses of which cancellation left only rounding (ropes that lie straight) are zero: they would be oscillations of years.
pub(super) fn settle(stiffness: &mut [f64], bounds: &[f64]) {
    let largest = stiffness.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    for (value, bound) in stiffness.iter_mut().zip(bounds) {
        if value.abs() <= bound.min(ROUNDING * largest) {
            *value = 0.0;
        }
    }
}

/// Σ |z_ia a_ij z_jb|, row-major k x k.
fn absolute(a: &[f64], z: &[f64], k: usize) -> Vec<f64> {
    let n = z.len() / k.max(1);
    let az: Vec<f64> = (0..n * k).map(|p| (0..n).map(|j| (a[(p / k) * n + j] * z[j * k + p % k]).abs()).sum()).collect();
    (0..k * k).map(|p| (0..n).map(|i| z[i * k + p / k].abs() * az[i * k + p % k]).sum()).collect()
}

/// Zᵀ A Z and what it has below its last digits; sums of which only rounding is left are zero.
fn fine_reduced((high, low): (&[f64], &[f64]), z: &[f64], k: usize) -> (Vec<f64>, Vec<f64>) {
    let n = z.len() / k.max(1);
    let az: Vec<Double> = (0..n * k)
        .map(|p| {
            (0..n).fold(Double::default(), |sum, j| {
                let (entry, z) = ((p / k) * n + j, z[j * k + p % k]);
                sum.add(high[entry], z).add(low[entry], z)
            })
        })
        .collect();
    let sums = (0..k * k).map(|p| (0..n).fold(Double::default(), |sum, i| sum.add_times(z[i * k + p / k], az[i * k + p % k])));
    let terms = absolute(high, z, k);
    sums.zip(terms)
        .map(|(v, t)| if v.round().abs() <= FINE * t { Double::default() } else { v }.parts())
        .map(|[high, low]| (high, low))
        .unzip()
}

impl Matrices {
    /// The same in coordinates y with q = Z y: Zᵀ M Z and so on; `z` is row-major n x k. For constraints Z is an orthonormal basis of the
    /// motions they allow. Stiffness and resistance of which the sums leave only rounding are zero: a free motion along a condition stays one.
    pub fn reduced(&self, z: &[f64], k: usize) -> Matrices {
        let n = self.n;
        let square = |a: &[f64]| -> Vec<f64> {
            let az: Vec<f64> = (0..n * k).map(|p| (0..n).map(|j| a[(p / k) * n + j] * z[j * k + p % k]).sum()).collect();
            (0..k * k).map(|p| (0..n).map(|i| z[i * k + p / k] * az[i * k + p % k]).sum()).collect()
        };
        let settled = |a: &[f64]| -> Vec<f64> {
            let (sums, terms) = (square(a), absolute(a, z, k));
            sums.iter().zip(terms).map(|(v, t)| if v.abs() <= CANCELLED * t { 0.0 } else { *v }).collect()
        };
        let both = |high: &[f64], low: &[f64]| match low.is_empty() {
            true => (settled(high), Vec::new()),
            false => fine_reduced((high, low), z, k),
        };
        let (stiffness, below) = both(&self.stiffness, &self.below);
        let (damping, damping_below) = both(&self.damping, &self.damping_below);
        let vector = |v: &[f64]| -> Vec<f64> { (0..k).map(|c| (0..n).map(|i| z[i * k + c] * v[i]).sum()).collect() };
        Matrices {
            n: k,
            mass: square(&self.mass),
            damping,
            stiffness,
            below,
            damping_below,
            damping_open: self.damping_open,
            force: vector(&self.force),
            loads: self.loads.iter().map(|l| Harmonic { rate: l.rate, cos: vector(&l.cos), sin: vector(&l.sin) }).collect(),
            shaped: self.shaped.iter().map(|(form, factors)| (*form, vector(factors))).collect(),
            jacobian: Vec::new(),
            drift: Vec::new(),
            on_rates: Vec::new(),
        }
    }

    /// A basis of the motions that the conditions allow, row-major n x k, with k; none without conditions.
    pub fn allowed(&self) -> Option<(Vec<f64>, usize)> {
        let n = self.n;
        if self.jacobian.is_empty() || n == 0 {
            return None;
        }
        let size = |row: &[f64]| row.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let scaled: Vec<f64> = self.jacobian.chunks(n).filter(|r| size(r) > 0.0).flat_map(|r| r.iter().map(move |v| v / size(r))).collect();
        let directions = qr::null_space(&scaled, scaled.len() / n, n);
        let k = directions.len();
        let mut z = vec![0.0; n * k];
        for (c, direction) in directions.iter().enumerate() {
            direction.iter().enumerate().for_each(|(i, v)| z[i * k + c] = *v);
        }
        Some((z, k))
    }
}

/// (A + Aᵀ)/2 and (A - Aᵀ)/2 of a row-major square matrix.
pub fn parts(a: &[f64], n: usize) -> (Vec<f64>, Vec<f64>) {
    let turned = |p: usize| a[(p % n) * n + p / n];
    ((0..n * n).map(|p| 0.5 * (a[p] + turned(p))).collect(), (0..n * n).map(|p| 0.5 * (a[p] - turned(p))).collect())
}

/// Largest absolute entry.
pub fn largest(a: &[f64]) -> f64 {
    a.iter().fold(0.0, |m: f64, v| m.max(v.abs()))
}

/// Share of the inertias on the diagonal below which what is left of their difference loses digits of a result that are shown.
const HIDDEN: f64 = 1e-7;
/// Below this nothing is left: a motion without inertia.
const NONE: f64 = 1e-15;

/// What is to be said where an inertia is the small difference of large ones, as that of a small body beside a large one in sums and differences of their places: its digits are those that
/// rounding leaves of the difference.
pub fn hidden_inertia(matrices: &Matrices) -> Option<Text> {
    let n = matrices.n;
    let size = |i: usize| matrices.mass[i * n + i];
    if (0..n).any(|i| size(i) <= 0.0) {
        return None;
    }
    let scaled: Vec<f64> = (0..n * n).map(|p| matrices.mass[p] / (size(p / n) * size(p % n)).sqrt()).collect();
    let unit: Vec<f64> = (0..n * n).map(|p| f64::from(u8::from(p / n == p % n))).collect();
    let least = algebra::eigen::symmetric(n, &parts(&scaled, n).0, &unit).ok()?.values.iter().copied().fold(f64::INFINITY, f64::min);
    let digits = (-algebra::elementary::ln(f64::EPSILON / least) / std::f64::consts::LN_10).floor();
    (least < HIDDEN && least > NONE).then(|| {
        Text::new(
            format!("an inertia is the small difference of large ones in these coordinates: about {digits} digits of what hangs on it are left; give a coordinate to the small body itself"),
            format!("в этих координатах одна из инерций — малая разность больших: у зависящих от неё величин верны около {digits} цифр; задайте малому телу собственную координату"),
        )
    })
}
