//! Multipliers of a turn from its fundamental matrix: the shift along the motion apart, each with the error it may have.
//!
//! For an autonomous machine Φ f = f, f the rates at the start: the shift in time is known by its vector and not by its value. A reflection H that
//! turns f into the first axis leaves
//!
//! ```text
//! H Φ H = | 1  * |
//!         | 0  B |        the eigenvalues of B are the multipliers of the return map
//! ```
//!
//! so that a second multiplier 1 (a conservative machine) stands alone and keeps its digits. How far a multiplier can be trusted is seen by
//! disturbing B by what it may err: its rounding, what the steps have left in it, and what is missing in Φ f = f, Φ being that of a motion which
//! is itself known to some digits only.

use super::options::Multiplier;
use crate::Fault;
use algebra::complex::{self, Complex};
use algebra::eigen::general;
use algebra::elementary;
use algebra::product::Spread;
use algebra::random::Random;

/// What is known of a turn, on the states that have to come back, in their scales.
pub(super) struct Turn {
    pub(super) n: usize,
    /// Row-major.
    pub(super) matrix: Vec<f64>,
    /// Rates at the start; none when time is not free.
    pub(super) flow: Option<Vec<f64>>,
    /// ln |det| of the matrix, where it is known apart from it.
    pub(super) log_determinant: Option<f64>,
    /// Whether a switch has taken a direction away, so that one multiplier at least is 0 exactly.
    pub(super) loses_one: bool,
    /// By how much Liouville's formula was missed.
    pub(super) liouville: f64,
    /// What the entries may err by, as a share of the largest.
    pub(super) doubt: f64,
}

/// Multipliers and how well Φ f = f is met.
pub(super) struct Spectrum {
    pub(super) multipliers: Vec<Multiplier>,
    /// |Φ f - f|/|f|.
    pub(super) shift: Option<f64>,
    /// By how much the errors of a turn are magnified in what closes, the largest 1/|1 - μ|; none where a multiplier cannot be told from 1, so that what closes is one of a family.
    pub(super) magnified: Option<f64>,
}

/// Rounding of an entry of the matrix, in its largest one.
const ROUNDING: f64 = 1e-12;
/// Disturbances tried.
const TRIALS: u64 = 3;

pub(super) fn spectrum(turn: &Turn, seed: u64) -> Result<Spectrum, Fault> {
    let n = turn.n;
    let (rest, shift) = match &turn.flow {
        Some(flow) => without_shift(n, &turn.matrix, flow),
        None => (turn.matrix.clone(), None),
    };
    let r = if shift.is_some() { n - 1 } else { n };
    // rounding is that of the whole matrix, however small what is left of it
    let largest = turn.matrix.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let off = shift.map_or(0.0, |(_, off)| off);
    let size = largest * ROUNDING.max(turn.liouville).max(turn.doubt).max(off);
    let mut multipliers = with_errors(r, &rest, size, seed)?;
    let apart = |m: &Multiplier| elementary::hypot(m.re - 1.0, m.im);
    let one_of_many = multipliers.iter().any(|m| apart(m) <= m.error);
    let magnified = (!one_of_many).then(|| multipliers.iter().map(|m| 1.0 / apart(m)).fold(0.0, f64::max));
    name_smallest(&mut multipliers, turn);
    if let Some((value, _)) = shift {
        // a quotient of what is known to thirteen digits
        multipliers.push(Multiplier { re: value, trivial: true, error: 1e-12 * (1.0 + value.abs()), ..Multiplier::default() });
    }
    multipliers.sort_by(|a, b| b.abs().total_cmp(&a.abs()).then(b.re.total_cmp(&a.re)).then(b.im.total_cmp(&a.im)));
    Ok(Spectrum { multipliers, shift: shift.map(|(_, off)| off), magnified })
}

/// A reflection that turns a direction into the first axis.
struct Mirror {
    v: Vec<f64>,
    square: f64,
}

impl Mirror {
    /// f -> ± e_1, the sign that does not cancel; f has unit length.
    fn new(f: &[f64]) -> Mirror {
        let mut v = f.to_vec();
        v[0] += if f[0] < 0.0 { -1.0 } else { 1.0 };
        Mirror { square: v.iter().map(|x| x * x).sum(), v }
    }

    fn reflect(&self, x: &mut [f64]) {
        let amount = 2.0 * x.iter().zip(&self.v).map(|(a, b)| a * b).sum::<f64>() / self.square;
        x.iter_mut().zip(&self.v).for_each(|(x, v)| *x -= amount * v);
    }

    /// H A H without its first row and column, transposed.
    fn rest(&self, matrix: &[f64]) -> Vec<f64> {
        let n = self.v.len();
        let mut rows = matrix.to_vec();
        rows.chunks_mut(n).for_each(|row| self.reflect(row));
        let mut columns = transposed(n, &rows);
        columns.chunks_mut(n).for_each(|column| self.reflect(column));
        columns.chunks(n).skip(1).flat_map(|column| column[1..].iter().copied()).collect()
    }
}

fn transposed(n: usize, matrix: &[f64]) -> Vec<f64> {
    (0..n * n).map(|k| matrix[(k % n) * n + k / n]).collect()
}

fn unit(f: &[f64]) -> Vec<f64> {
    let length = f.iter().map(|f| f * f).sum::<f64>().sqrt();
    f.iter().map(|v| v / length).collect()
}

/// B, and of the first axis its eigenvalue and how well it is met.
fn without_shift(n: usize, matrix: &[f64], flow: &[f64]) -> (Vec<f64>, Option<(f64, f64)>) {
    let f = unit(flow);
    let image: Vec<f64> = (0..n).map(|i| (0..n).map(|j| matrix[i * n + j] * f[j]).sum()).collect();
    let off = image.iter().zip(&f).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
    let value = image.iter().zip(&f).map(|(a, b)| a * b).sum();
    (transposed(n - 1, &Mirror::new(&f).rest(matrix)), Some((value, off)))
}

/// Multipliers of motions without losses, of which all neighbours of other energies close as well: f is kept by Φ, and b, the gradient of the energy, by Φ'. What is across both has the
/// multipliers beside these two 1, which would be of one root with a pair that meets there, and known to the root, or the fourth root, of a rounding.
pub(in crate::studies) fn of_family(known: &[Multiplier], matrix: &[f64], [f, b]: [&[f64]; 2]) -> Result<Vec<Multiplier>, Fault> {
    let n = f.len();
    if n < 2 {
        return Ok(known.to_vec());
    }
    let (along, mut up) = (Mirror::new(&unit(f)), unit(b));
    along.reflect(&mut up);
    // transposed, so that b is kept from the right
    let rest = along.rest(matrix);
    let rest = Mirror::new(&unit(&up[1..])).rest(&rest);
    let size = known.iter().filter(|m| !m.trivial).map(|m| m.error).fold(f64::INFINITY, f64::min);
    let mut list = with_errors(n - 2, &rest, size, 1)?;
    let one = Multiplier { re: 1.0, trivial: true, error: size, ..Multiplier::default() };
    list.extend([one, one]);
    list.sort_by(|a, b| b.abs().total_cmp(&a.abs()).then(b.re.total_cmp(&a.re)).then(b.im.total_cmp(&a.im)));
    Ok(list)
}

/// Eigenvalues, each with what it moves by when the entries of the matrix move by `size`.
fn with_errors(n: usize, matrix: &[f64], size: f64, seed: u64) -> Result<Vec<Multiplier>, Fault> {
    if n == 0 {
        return Ok(Vec::new());
    }
    let values = general(n, matrix)?.values;
    let mut errors = vec![0.0_f64; n];
    let mut random = Random::new(seed);
    for _ in 0..TRIALS {
        let disturbed: Vec<f64> = matrix.iter().map(|v| v + size * random.between(-1.0, 1.0)).collect();
        let moved = general(n, &disturbed)?.values;
        for (error, value) in errors.iter_mut().zip(&values) {
            let nearest = moved.iter().map(|m| complex::abs(m - value)).fold(f64::INFINITY, f64::min);
            *error = error.max(2.0 * nearest);
        }
    }
    let multiplier =
        |(value, error): (&Complex, &f64)| Multiplier { re: value.re, im: value.im, error: error.max(size), ..Multiplier::default() };
    Ok(values.iter().zip(&errors).map(multiplier).collect())
}

/// A multiplier below its error is no number: it is zero as far as the matrix tells. When it is the only one, the determinant gives it, or it is 0 exactly
/// because a switch took its direction away.
fn name_smallest(multipliers: &mut [Multiplier], turn: &Turn) {
    let lost = |m: &Multiplier| elementary::hypot(m.re, m.im) <= m.error;
    let known: f64 = multipliers.iter().filter(|m| !lost(m)).map(|m| elementary::ln(m.abs())).sum();
    let alone = multipliers.iter().filter(|m| lost(m)).count() == 1;
    for m in multipliers.iter_mut().filter(|m| lost(m)) {
        (m.re, m.im) = (0.0, 0.0);
        m.error = if alone && turn.loses_one { 0.0 } else { m.error };
        m.log_abs = turn.log_determinant.filter(|_| alone).map(|whole| whole - known);
    }
}

/// ln of a magnitude that is no number any more.
const BEYOND: f64 = 700.0;

/// A multiplier with its error.
pub(in crate::studies) fn named(spread: &Spread) -> Multiplier {
    let size = spread.log_abs();
    if size.abs() >= BEYOND {
        // a direction that is taken away has 0 exactly
        return Multiplier { log_abs: Some(size).filter(|size| size.is_finite()), ..Multiplier::default() };
    }
    let z = spread.z.scale(elementary::exp(size) / complex::abs(spread.z));
    Multiplier { re: z.re, im: z.im, error: spread.error * complex::abs(z), ..Multiplier::default() }
}

/// Of a free motion the multiplier that is nearest to 1 belongs to the shift along it.
pub(in crate::studies) fn name_shift(list: &mut [Multiplier]) {
    let off = |m: &Multiplier| if m.log_abs.is_some() { f64::INFINITY } else { elementary::hypot(m.re - 1.0, m.im) };
    if let Some(shift) = list.iter_mut().min_by(|a, b| off(a).total_cmp(&off(b))) {
        shift.trivial = true;
    }
}
