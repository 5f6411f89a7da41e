//! Exact natural frequencies of a frame with distributed mass: dynamic stiffness and the count of Wittrick and Williams.
//!
//! A rod that oscillates with the angular frequency ω obeys EI v'''' = ρA ω² v, so the forces at its ends follow from the displacements there
//! exactly, by trigonometric and hyperbolic functions of λ = l (ρA ω²/EI)^¼. With K(ω) put together from all rods, the number of natural
//! frequencies below ω is J = J₀ + (negative eigenvalues of K(ω)), where J₀ counts those of the rods with clamped ends. Each frequency is
//! found by halving an interval on J: none can be missed.
//!
//! In z = λ⁴ all these functions are quotients of entire series without cancellation: with P = cos λ cosh λ = Σ (-4)ⁿ zⁿ/(4n)! its integrals are
//! (sin λ cosh λ + cos λ sinh λ)/2, sin λ sinh λ/2, (sin λ cosh λ - cos λ sinh λ)/4, and 1 - P = z (1/6 - ...). They are summed in twice the digits, and K(ω) with
//! them: for a stiff frame on soft springs the inertia of a rigid motion, z of the stiffness, must not be lost in it.
//!
//! *Source*: W. H. Wittrick, F. W. Williams, A general algorithm for computing natural frequencies of elastic structures, Quart. J. Mech.
//! Appl. Math. 24 (1971) 263.

use crate::{Assembly, Frame, Rod, RodKind, Scalar, elements, lowest};
use algebra::double::Double;
use algebra::elementary;
use std::f64::consts::PI;

/// Up to this λ the series of bending keep 24 of their 32 digits: their largest term is exp(√2 λ), their value exp(λ).
const LARGE: f64 = 40.0;
/// Up to this λ the series of stretching keep 23 of theirs: the largest term is exp(λ).
const LONG: f64 = 20.0;
/// Largest number of independent freedoms.
const LARGEST: usize = 80;

/// The lowest angular frequencies of the continuum, as many as estimates are given; none when the frame has rods for which there is no
/// closed form (turning of sections of elastic rods, bars with mass), or is too large.
pub fn frequencies(frame: &Frame<f64>, estimates: &[f64]) -> Option<Vec<f64>> {
    let frame = frame.divided(1).doubled();
    let closed = |r: &Rod<Double>| match r.kind {
        RodKind::Rigid => true,
        RodKind::Beam { .. } => r.rotary.is_zero(),
        RodKind::Bar(_) => r.mass.is_zero(),
    };
    let assembly = Assembly::of(&frame);
    if !frame.rods.iter().all(closed) || assembly.n() > LARGEST {
        return None;
    }
    let continuum = Continuum { frame, assembly };
    estimates.iter().enumerate().map(|(i, w)| continuum.root(i + 1, *w)).collect()
}

/// A frame of undivided rods.
struct Continuum {
    frame: Frame<Double>,
    assembly: Assembly<Double>,
}

impl Continuum {
    /// The frequency number `number` (from 1), near an estimate.
    fn root(&self, number: usize, estimate: f64) -> Option<f64> {
        // the estimate of the refined frame has its certificate; the bracket widens when it does not hold
        let (mut low, mut high) = (estimate * (1.0 - 1e-3), estimate * (1.0 + 1e-3));
        for _ in 0..60 {
            if self.count(low)? < number {
                break;
            }
            low *= 0.9;
        }
        for _ in 0..60 {
            if self.count(high)? >= number {
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
            match self.count(middle)? >= number {
                true => high = middle,
                false => low = middle,
            }
        }
        Some(0.5 * (low + high))
    }

    /// Number of natural frequencies below ω; at a pole of K(ω) that of a neighbour.
    fn count(&self, omega: f64) -> Option<usize> {
        let clamped: usize = self.parts().map(|(rod, length)| clamped(rod, length, omega)).sum();
        if self.assembly.n() == 0 {
            return Some(clamped);
        }
        let places = std::iter::successors(Some(omega), |w| Some(w.next_up())).take(4);
        places.into_iter().find_map(|w| lowest::twofold(&self.stiffness(w)).factor()?.signs()).map(|negative| clamped + negative)
    }

    fn parts(&self) -> impl Iterator<Item = (&Rod<Double>, f64)> {
        self.assembly.freedoms.parts.iter().map(|part| (&self.frame.rods[part.rod], part.length.value()))
    }

    /// K(ω) over the independent freedoms.
    fn stiffness(&self, omega: f64) -> crate::assembly::Sparse<Double> {
        let square = Double::from(omega).times(Double::from(omega));
        let lumped = self.frame.nodes.iter().enumerate().flat_map(|(i, node)| {
            let inertia = [node.mass, node.mass, node.inertia];
            (0..3).map(move |k| (3 * i + k, node.springs[k].sub(&square.mul(&inertia[k]))))
        });
        self.assembly.gather(&self.frame, &|part| dynamic(&self.frame.rods[part.rod], part.length, square), lumped.collect())
    }
}

/// λ of bending and of stretching; none for rods that do not move so.
fn wave(rod: &Rod<Double>, length: f64, omega: f64) -> [Option<f64>; 2] {
    let RodKind::Beam { bending, axial } = &rod.kind else { return [None, None] };
    if rod.mass.is_zero() {
        return [None, None];
    }
    let mass = rod.mass.value();
    let across = length * (mass * omega * omega / bending.value()).sqrt().sqrt();
    [Some(across), axial.map(|ea| length * omega * (mass / ea.value()).sqrt())]
}

/// The lowest λ of a rod with clamped ends is 4.73.
const CLAMPED: f64 = 4.0;

/// Natural frequencies below ω of a part of a rod with clamped ends.
fn clamped(rod: &Rod<Double>, length: f64, omega: f64) -> usize {
    let [across, along] = wave(rod, length, omega);
    let bending = across.filter(|x| *x > CLAMPED).map_or(0, |x| {
        let i = (x / PI).floor();
        // 1 - cos λ cosh λ divided by cosh λ
        let sign = (1.0 / elementary::cosh(x.min(700.0)) - elementary::cos(x)).signum();
        let parity = if i as i64 % 2 == 0 { 1.0 } else { -1.0 };
        (i - 0.5 * (1.0 - parity * sign)).round() as usize
    });
    bending + along.map_or(0, |x| (x / PI).floor() as usize)
}

/// Dynamic stiffness of a part of a rod for ω², 6 x 6 in its own axes.
fn dynamic(rod: &Rod<Double>, l: Double, square: Double) -> Vec<Double> {
    let (k, m) = (elements::stiffness(rod, &l), elements::mass(rod, &l));
    let mut out: Vec<Double> = k.iter().zip(&m).map(|(k, m)| k.sub(&square.mul(m))).collect();
    let RodKind::Beam { bending, axial } = &rod.kind else { return out };
    if rod.mass.is_zero() {
        return out;
    }
    let l2 = l.mul(&l);
    let [vv, vt, tt, vw, vs, ts] = across(rod.mass.mul(&square).mul(&l2).mul(&l2).div(bending));
    let e = bending.div(&l2.mul(&l));
    let (vt, vs, tt, ts) = (vt.mul(&l), vs.mul(&l), tt.mul(&l2), ts.mul(&l2));
    let block = [[vv, vt, vw.neg(), vs], [vt, tt, vs.neg(), ts], [vw.neg(), vs.neg(), vv, vt.neg()], [vs, ts, vt.neg(), tt]];
    for (a, i) in [1, 2, 4, 5].into_iter().enumerate() {
        for (b, j) in [1, 2, 4, 5].into_iter().enumerate() {
            out[6 * i + j] = e.mul(&block[a][b]);
        }
    }
    if let Some(ea) = axial {
        let [own, other] = along(rod.mass.mul(&square).mul(&l2).div(ea)).map(|f| f.mul(ea).div(&l));
        [(0, 0, own), (3, 3, own), (0, 3, other.neg()), (3, 0, other.neg())].into_iter().for_each(|(i, j, v)| out[6 * i + j] = v);
    }
    out
}

/// Share of a sum that is below its 32 digits.
const LAST: f64 = 1e-34;

/// Σ factorⁿ first!/(first + step n)! zⁿ.
fn series(z: Double, factor: f64, first: u32, step: u32) -> Double {
    let z = z.mul(&Double::from(factor));
    let (mut term, mut sum) = (Double::one(), Double::one());
    // the largest term stands where (first + step n)^step = factor z: within the limits of λ before the fortieth
    for n in 0..200 {
        let below = (1..=step).fold(Double::one(), |product, k| product.mul(&Double::from(f64::from(first + step * n + k))));
        term = term.mul(&z).div(&below);
        sum = sum.sum(term);
        if term.size() < LAST * sum.size() {
            break;
        }
    }
    sum
}

/// λ³ (cS + sC), λ² sS, λ (sC - cS), λ³ (s + S), λ² (C - c), λ (S - s), each over 1 - cC, with s, c of sin λ, cos λ and S, C of sinh λ, cosh λ; z = λ⁴.
fn across(z: Double) -> [Double; 6] {
    let x = z.value().sqrt().sqrt();
    if x > LARGE {
        // all divided by cosh λ, what is below exp(-40) left out
        let (s, c) = elementary::sin_cos(x);
        let (d, tail) = (-c, 2.0 * elementary::exp(-x));
        let (x2, x3) = (x * x, elementary::powi(x, 3));
        return [
            x3 * (c + s) / d,
            x2 * s / d,
            x * (s - c) / d,
            x3 * (1.0 + s * tail) / d,
            x2 * (1.0 - c * tail) / d,
            x * (1.0 - s * tail) / d,
        ]
        .map(Double::from);
    }
    // 1 - cC over z, times 24/4
    let d = series(z, -4.0, 4, 4);
    let of = |value: i64, factor: f64, first: u32| Double::ratio(value, 1).mul(&series(z, factor, first, 4)).div(&d);
    [of(12, -4.0, 1), of(6, -4.0, 2), of(4, -4.0, 3), of(12, 1.0, 1), of(6, 1.0, 2), of(2, 1.0, 3)]
}

/// λ/tan λ and λ/sin λ; w = λ².
fn along(w: Double) -> [Double; 2] {
    let x = w.value().sqrt();
    if x > LONG {
        return [x / elementary::tan(x), x / elementary::sin(x)].map(Double::from);
    }
    let sine = series(w, -1.0, 1, 2);
    [series(w, -1.0, 0, 2).div(&sine), Double::one().div(&sine)]
}
