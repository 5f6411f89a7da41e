//! Exact natural frequencies of a frame with distributed mass: dynamic stiffness and the count of Wittrick and Williams.
//!
//! A rod that oscillates with the angular frequency ω obeys EI v'''' = ρA ω² v, so the forces at its ends follow from the displacements there
//! exactly, by trigonometric and hyperbolic functions of λ = l (ρA ω²/EI)^¼. With K(ω) put together from all rods, the number of natural
//! frequencies below ω is J = J₀ + (negative eigenvalues of K(ω)), where J₀ counts those of the rods with clamped ends. Each frequency is
//! found by halving an interval on J: none can be missed.
//!
//! *Source*: W. H. Wittrick, F. W. Williams, A general algorithm for computing natural frequencies of elastic structures, Quart. J. Mech.
//! Appl. Math. 24 (1971) 263.

use crate::{Assembly, Frame, Rod, RodKind, elements};
use algebra::eigen;
use algebra::elementary;
use std::f64::consts::PI;

/// Below this λ the two matrices of the static shape are exact to 1e-13, while the functions cancel.
const SMALL: f64 = 0.15;
/// Above this exp(-λ) has left the numbers.
const LARGE: f64 = 40.0;
/// Largest number of independent freedoms.
const LARGEST: usize = 80;

/// The lowest angular frequencies of the continuum, as many as estimates are given; none when the frame has rods for which there is no
/// closed form (turning of sections of elastic rods, bars with mass), or is too large.
pub fn frequencies(frame: &Frame<f64>, estimates: &[f64]) -> Option<Vec<f64>> {
    let frame = frame.divided(1);
    let closed = |r: &Rod<f64>| match r.kind {
        RodKind::Rigid => true,
        RodKind::Beam { .. } => r.rotary == 0.0,
        RodKind::Bar(_) => r.mass == 0.0,
    };
    let assembly = Assembly::of(&frame);
    if !frame.rods.iter().all(closed) || assembly.n() > LARGEST {
        return None;
    }
    estimates.iter().enumerate().map(|(i, w)| root(&frame, &assembly, i + 1, *w)).collect()
}

/// The frequency number `number` (from 1), near an estimate.
fn root(frame: &Frame<f64>, assembly: &Assembly<f64>, number: usize, estimate: f64) -> Option<f64> {
    // the estimate of the refined frame has its certificate; the bracket widens when it does not hold
    let (mut low, mut high) = (estimate * (1.0 - 1e-3), estimate * (1.0 + 1e-3));
    for _ in 0..60 {
        if count(frame, assembly, low)? < number {
            break;
        }
        low *= 0.9;
    }
    for _ in 0..60 {
        if count(frame, assembly, high)? >= number {
            break;
        }
        high *= 1.1;
    }
    // ten units of the last place: nothing more is to be halved
    while high - low > 2e-15 * high {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        match count(frame, assembly, middle)? >= number {
            true => high = middle,
            false => low = middle,
        }
    }
    Some(0.5 * (low + high))
}

/// Number of natural frequencies below ω.
pub fn count(frame: &Frame<f64>, assembly: &Assembly<f64>, omega: f64) -> Option<usize> {
    let n = assembly.n();
    let lumped = frame.nodes.iter().enumerate();
    let square = omega * omega;
    let lumped = lumped.flat_map(|(i, node)| {
        let inertia = [node.mass, node.mass, node.inertia];
        (0..3).map(move |k| (3 * i + k, node.springs[k] - square * inertia[k]))
    });
    let stiffness = assembly.gather(frame, &|part| dynamic(&frame.rods[part.rod], part.length, omega), lumped.collect());
    let clamped: usize = assembly.freedoms.parts.iter().map(|part| clamped(&frame.rods[part.rod], part.length, omega)).sum();
    if n == 0 {
        return Some(clamped);
    }
    // rows of unlike units are scaled alike; the signs of eigenvalues stay
    let dense = stiffness.dense();
    let size: Vec<f64> = (0..n).map(|i| (0..n).fold(0.0_f64, |m, j| m.max(dense[i * n + j].abs())).max(f64::MIN_POSITIVE).sqrt()).collect();
    let scaled: Vec<f64> = (0..n * n).map(|k| dense[k] / (size[k / n] * size[k % n])).collect();
    let unit: Vec<f64> = (0..n * n).map(|k| f64::from(u8::from(k / n == k % n))).collect();
    let modes = eigen::symmetric(n, &scaled, &unit).ok()?;
    Some(clamped + modes.values.iter().filter(|v| **v < 0.0).count())
}

/// λ of bending and of stretching; none for rods that do not move so.
fn wave(rod: &Rod<f64>, length: f64, omega: f64) -> [Option<f64>; 2] {
    let RodKind::Beam { bending, axial } = &rod.kind else { return [None, None] };
    if rod.mass == 0.0 {
        return [None, None];
    }
    let across = length * (rod.mass * omega * omega / bending).sqrt().sqrt();
    [Some(across), axial.map(|ea| length * omega * (rod.mass / ea).sqrt())]
}

/// Natural frequencies below ω of a part of a rod with clamped ends.
fn clamped(rod: &Rod<f64>, length: f64, omega: f64) -> usize {
    let [across, along] = wave(rod, length, omega);
    let bending = across.filter(|x| *x > SMALL).map_or(0, |x| {
        let i = (x / PI).floor();
        // 1 - cos λ cosh λ divided by cosh λ
        let sign = (1.0 / elementary::cosh(x.min(700.0)) - elementary::cos(x)).signum();
        let parity = if i as i64 % 2 == 0 { 1.0 } else { -1.0 };
        (i - 0.5 * (1.0 - parity * sign)).round() as usize
    });
    bending + along.map_or(0, |x| (x / PI).floor() as usize)
}

/// Dynamic stiffness of a part of a rod, 6 x 6 in its own axes.
fn dynamic(rod: &Rod<f64>, l: f64, omega: f64) -> Vec<f64> {
    let (k, m) = (elements::stiffness(rod, &l), elements::mass(rod, &l));
    let mut out: Vec<f64> = k.iter().zip(&m).map(|(k, m)| k - omega * omega * m).collect();
    let RodKind::Beam { bending, axial } = &rod.kind else { return out };
    let [across, along] = wave(rod, l, omega);
    if let Some(x) = across.filter(|x| *x > SMALL) {
        let [vv, vt, tt, vw, vs, ts] = functions(x);
        let e = bending / elementary::powi(l, 3);
        let block = [
            [elementary::powi(x, 3) * vv, l * x * x * vt, -elementary::powi(x, 3) * vw, l * x * x * vs],
            [l * x * x * vt, l * l * x * tt, -l * x * x * vs, l * l * x * ts],
            [-elementary::powi(x, 3) * vw, -l * x * x * vs, elementary::powi(x, 3) * vv, -l * x * x * vt],
            [l * x * x * vs, l * l * x * ts, -l * x * x * vt, l * l * x * tt],
        ];
        for (a, i) in [1, 2, 4, 5].into_iter().enumerate() {
            for (b, j) in [1, 2, 4, 5].into_iter().enumerate() {
                out[6 * i + j] = e * block[a][b];
            }
        }
    }
    // below it x/tan x is 1 - x²/3, what stiffness and masses of the rod give, with an error of x⁴/45
    if let (Some(x), Some(ea)) = (along.filter(|x| *x > 1e-3), axial) {
        let (own, other) = (ea / l * x / elementary::tan(x), -ea / l * x / elementary::sin(x));
        [(0, 0, own), (3, 3, own), (0, 3, other), (3, 0, other)].into_iter().for_each(|(i, j, v)| out[6 * i + j] = v);
    }
    out
}

/// (cS + sC, sS, sC - cS, s + S, C - c, S - s)/(1 - cC) with s, c of sin λ, cos λ and S, C of sinh λ, cosh λ.
fn functions(x: f64) -> [f64; 6] {
    let (s, c) = elementary::sin_cos(x);
    if x > LARGE {
        // all divided by cosh λ, what is below exp(-40) left out
        let d = -c;
        let tail = 2.0 * elementary::exp(-x);
        return [(c + s) / d, s / d, (s - c) / d, (1.0 + s * tail) / d, (1.0 - c * tail) / d, (1.0 - s * tail) / d];
    }
    let (sh, ch) = (elementary::sinh(x), elementary::cosh(x));
    let d = 1.0 - c * ch;
    [(c * sh + s * ch) / d, s * sh / d, (s * ch - c * sh) / d, (s + sh) / d, (ch - c) / d, (sh - s) / d]
}
