//! The normal form of a Hopf point: whether the motions that part there are stable is told by the first Lyapunov coefficient.
//!
//! ```text
//! A q = iω q,  w'A = iω w',  w'q = 1
//! l₁ = Re [w'C(q,q,q̄) - 2 w'B(q, A⁻¹B(q,q̄)) + w'B(q̄, (2iω - A)⁻¹B(q,q))] / 2ω         B, C second and third derivatives of the rates
//! ```
//!
//! Derivatives along real directions are differences; those of several directions follow from sums and differences of them. l₁ = 0 is a generalised Hopf point (Bautin): a fold of motions
//! begins there. *Source*: Yu. A. Kuznetsov, Elements of Applied Bifurcation Theory, 5.4, 8.3.

use algebra::complex::{self, Complex};
use algebra::eigen::general;
use algebra::lu::Lu;

/// First step of the differences, in scales: their error is its fourth power, and rounding over its third.
const STEP: f64 = 2.5e-3;
/// How much longer the next one is, and how many are tried: a place of rest at zero has no size of its own, and what the rates bend over tells itself.
const LONGER: f64 = 4.0;
const STEPS: usize = 12;
/// Distance of a shift from its root, as a share of the frequency: an inverse iteration then gains ten digits.
const BESIDE: f64 = 1e-10;
/// Share of the frequency beyond which a real part is that of another root than the one of the point.
const OFF: f64 = 1e-3;

type Rates<'a> = dyn FnMut(&[f64]) -> Option<Vec<f64>> + 'a;

/// l₁ from A, row by row, and the rates at a change of the state, all in scales; none without a pair on the axis, or where rates have no value.
pub(super) fn lyapunov(n: usize, a: &[f64], rates: &mut Rates<'_>) -> Option<f64> {
    let own = general(n, a).ok()?.values.into_iter().filter(|z| z.im > 0.0 && z.re.abs() <= OFF * z.im);
    let omega = own.min_by(|a, b| (a.re / a.im).abs().total_cmp(&(b.re / b.im).abs()))?.im;
    let transposed: Vec<f64> = (0..n * n).map(|e| a[e % n * n + e / n]).collect();
    let q = eigenvector(n, a, omega)?;
    let w = eigenvector(n, &transposed, omega)?;
    let scale = product(&w, &q);
    let w: Vec<Complex> = w.iter().map(|w| complex::over(*w, scale)).collect();
    let mut forms = Forms { here: rates(&vec![0.0; n])?, step: STEP, rates };
    // the value that the next step changes least
    let (mut best, mut before): (Option<(f64, f64)>, Option<f64>) = (None, None);
    for _ in 0..STEPS {
        let Some(now) = coefficient(a, (omega, &q, &w), &mut forms) else { break };
        if let Some(before) = before.filter(|before| best.is_none_or(|(off, _)| (now - before).abs() < off)) {
            best = Some(((now - before).abs(), before));
        }
        before = Some(now);
        forms.step *= LONGER;
    }
    best.map(|(_, value)| value).or(before)
}

/// l₁ with one step of the differences.
fn coefficient(a: &[f64], (omega, q, w): (f64, &[Complex], &[Complex]), forms: &mut Forms<'_, '_>) -> Option<f64> {
    let n = q.len();
    let [re, im] = parts(q);
    let (rr, ri, ii) = (forms.second(&re, &re)?, forms.second(&re, &im)?, forms.second(&im, &im)?);
    let turning: Vec<Complex> = (0..n).map(|i| Complex::new(rr[i] - ii[i], 2.0 * ri[i])).collect();
    let resting: Vec<f64> = rr.iter().zip(&ii).map(|(a, b)| a + b).collect();
    let h = Lu::exact(a, n)?.solve(&resting)?;
    let second = |e: usize| Complex::new(-a[e], if e / n == e % n { 2.0 * omega } else { 0.0 });
    let k = Lu::exact(&(0..n * n).map(second).collect::<Vec<_>>(), n)?.solve(&turning)?;
    let [kr, ki] = parts(&k);
    let by_h = joined(&forms.second(&re, &h)?, &forms.second(&im, &h)?);
    let (a1, a2) = (forms.second(&re, &kr)?, forms.second(&im, &ki)?);
    let (b1, b2) = (forms.second(&re, &ki)?, forms.second(&im, &kr)?);
    let by_k: Vec<Complex> = (0..n).map(|i| Complex::new(a1[i] + a2[i], b1[i] - b2[i])).collect();
    let (c1, c2) = (forms.third(&re, &re)?, forms.third(&im, &re)?);
    let (d1, d2) = (forms.third(&re, &im)?, forms.third(&im, &im)?);
    let cubic: Vec<Complex> = (0..n).map(|i| Complex::new(c1[i] + c2[i], d1[i] + d2[i])).collect();
    let whole = product(w, &cubic) - product(w, &by_h) * 2.0 + product(w, &by_k);
    Some(whole.re / (2.0 * omega)).filter(|l| l.is_finite())
}

/// Of the root iω, of length 1; its phase is what the iteration leaves, and l₁ does not feel it.
fn eigenvector(n: usize, a: &[f64], omega: f64) -> Option<Vec<Complex>> {
    let entry = |e: usize| if e / n == e % n { Complex::new(a[e] - BESIDE * omega, -omega) } else { Complex::new(a[e], 0.0) };
    let lu = Lu::exact(&(0..n * n).map(entry).collect::<Vec<_>>(), n)?;
    let mut v: Vec<Complex> = (0..n).map(|i| Complex::new(1.0, 0.37 * i as f64)).collect();
    for _ in 0..3 {
        v = lu.solve(&v)?;
        let length = v.iter().map(|z| z.norm_sqr()).sum::<f64>().sqrt();
        if !(length > 0.0 && length.is_finite()) {
            return None;
        }
        v.iter_mut().for_each(|z| *z /= length);
    }
    Some(v)
}

fn product(a: &[Complex], b: &[Complex]) -> Complex {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn parts(z: &[Complex]) -> [Vec<f64>; 2] {
    [z.iter().map(|z| z.re).collect(), z.iter().map(|z| z.im).collect()]
}

fn joined(re: &[f64], im: &[f64]) -> Vec<Complex> {
    re.iter().zip(im).map(|(re, im)| Complex::new(*re, *im)).collect()
}

/// Derivatives of the rates at a place.
struct Forms<'r, 'a> {
    /// The rates there.
    here: Vec<f64>,
    /// Step of the differences, in scales.
    step: f64,
    rates: &'r mut Rates<'a>,
}

impl Forms<'_, '_> {
    /// D²f and D³f along one direction.
    fn along(&mut self, u: &[f64]) -> Option<[Vec<f64>; 2]> {
        let size = u.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
        if size == 0.0 {
            return Some([vec![0.0; u.len()], vec![0.0; u.len()]]);
        }
        let h = self.step / size;
        let mut at = |k: f64| (self.rates)(&u.iter().map(|u| k * h * u).collect::<Vec<_>>());
        let [a3, a2, a1, b1, b2, b3] = [at(-3.0)?, at(-2.0)?, at(-1.0)?, at(1.0)?, at(2.0)?, at(3.0)?];
        let second = |i: usize| (16.0 * (a1[i] + b1[i]) - (a2[i] + b2[i]) - 30.0 * self.here[i]) / (12.0 * h * h);
        let third = |i: usize| (8.0 * (b2[i] - a2[i]) - 13.0 * (b1[i] - a1[i]) - (b3[i] - a3[i])) / (8.0 * h * h * h);
        Some([(0..u.len()).map(second).collect(), (0..u.len()).map(third).collect()])
    }

    /// B(u, v).
    fn second(&mut self, u: &[f64], v: &[f64]) -> Option<Vec<f64>> {
        let [[sum, _], [difference, _]] = self.both(u, v)?;
        Some(sum.iter().zip(&difference).map(|(s, d)| 0.25 * (s - d)).collect())
    }

    /// C(u, u, v).
    fn third(&mut self, u: &[f64], v: &[f64]) -> Option<Vec<f64>> {
        let [[_, sum], [_, difference]] = self.both(u, v)?;
        let [_, alone] = self.along(v)?;
        Some((0..u.len()).map(|i| (sum[i] - difference[i] - 2.0 * alone[i]) / 6.0).collect())
    }

    /// Along u + v and u - v.
    fn both(&mut self, u: &[f64], v: &[f64]) -> Option<[[Vec<f64>; 2]; 2]> {
        let of = |sign: f64| -> Vec<f64> { u.iter().zip(v).map(|(u, v)| u + sign * v).collect() };
        Some([self.along(&of(1.0))?, self.along(&of(-1.0))?])
    }
}

#[cfg(test)]
mod tests {
    use super::lyapunov;

    /// Differences of fourth order of a polynomial whose derivatives beyond the fifth vanish: rounding over the third power of the step.
    const EXACT: f64 = 1e-8;

    /// x'' = -x + A x² + (B x + S x²) x': with y = -x' the coefficient of Guckenheimer and Holmes is a = (S + A B)/8, r' = a r³; a vector q of length 1 makes r = √2 |z|, so that l₁ = 2a.
    #[test]
    fn quadratic_terms_count_by_their_product() {
        for (a, b, s) in [(0.0, 0.0, 1.0), (0.7, 0.9, -0.63), (0.7, 0.9, 0.2), (-0.4, 1.1, 0.3)] {
            let mut rates = |z: &[f64]| Some(vec![z[1], -z[0] + a * z[0] * z[0] + (b * z[0] + s * z[0] * z[0]) * z[1]]);
            let found = lyapunov(2, &[0.0, 1.0, -1.0, 0.0], &mut rates).unwrap();
            assert!((found - 0.25 * (s + a * b)).abs() < EXACT, "{a} {b} {s}: {found}");
        }
    }
}
