//! Solutions of K x = lambda M x with K in twice the digits, from approximate ones.
//!
//! One step: Z = K⁻¹ M X, then Rayleigh's and Ritz's problem (Zᵀ K Z) c = lambda (Zᵀ M Z) c with Zᵀ K Z = Zᵀ M X, everything in twice the digits. What a shape
//! has too much of a higher one falls to lambda_low/lambda_high, and the value errs by its square. *Source*: K. J. Bathe, Finite Element Procedures, 11.6; the
//! small problem by Jacobi's rotations, which keep small eigenvalues of a graded matrix: J. Demmel, K. Veselić, SIAM J. Matrix Anal. Appl. 13 (1992).

use crate::Trouble;
use crate::certify::{Certificate, limits};
use crate::double::{Double, inner};
use crate::modes::{Modes, orient};
use crate::twofold::{Factor, Twofold};

/// Shapes beyond the wanted ones: what is missing of the wanted ones lies mostly in the next, and Sturm's count finds a gap above them.
const BEYOND: usize = 4;

/// Steps at most; from solutions of eight digits one or two are enough.
const STEPS: usize = 24;

/// A change of an eigenvalue that is its last digit.
const SETTLED: f64 = 4.0 * f64::EPSILON;

/// Share of a product of diagonal entries below which an entry is rotated no more.
const ROTATED: f64 = 1e-28;

/// A matrix with its factor.
pub struct Firm {
    stiffness: Twofold,
    factor: Factor,
}

impl Firm {
    /// Factors K; none where that is too dear in twice the digits.
    ///
    /// *Errors*: the pivot of a K that is not positive definite.
    pub fn of(stiffness: Twofold) -> Result<Option<Firm>, Trouble> {
        let Some(factor) = stiffness.factor() else { return Ok(None) };
        match factor.defect() {
            Some(pivot) => Err(pivot.into()),
            None => Ok(Some(Firm { stiffness, factor })),
        }
    }

    /// K⁻¹ b.
    pub fn solve(&self, b: &[Double]) -> Vec<Double> {
        self.factor.solve(b)
    }

    /// The lowest `wanted` solutions with their certificate, from approximate shapes, the lowest first.
    ///
    /// *Errors*: shapes that depend on each other, memory.
    pub fn polished(&self, mass: &Twofold, start: &Modes, wanted: usize) -> Result<(Modes, Certificate), Trouble> {
        let n = start.n;
        let wanted = wanted.min(start.values.len());
        let count = start.values.len().min(wanted + BEYOND);
        let mut shapes: Vec<Vec<Double>> = (0..count).map(|j| start.shape(j).iter().map(|x| Double::from(*x)).collect()).collect();
        let mut values = start.values[..count].to_vec();
        for _ in 0..STEPS {
            let (next, better) = self.step(mass, &shapes).ok_or(Trouble::Unconverged { found: 0, wanted })?;
            let change = values.iter().zip(&next).take(wanted).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
            (values, shapes) = (next, better);
            if change <= SETTLED {
                break;
            }
        }
        let residuals = (0..wanted).map(|j| self.residual(mass, values[j], &shapes[j])).collect();
        let certificate = Certificate { residuals, count: self.counted(mass, &values, wanted) };
        let mut modes = Modes { n, values: values[..wanted].to_vec(), vectors: Vec::with_capacity(n * wanted) };
        for shape in &shapes[..wanted] {
            let mut x: Vec<f64> = shape.iter().map(|v| v.round()).collect();
            orient(&mut x);
            modes.vectors.extend(x);
        }
        Ok((modes, certificate))
    }

    /// Values rising, shapes with xᵀ M x = 1; none where a number leaves its range.
    fn step(&self, mass: &Twofold, shapes: &[Vec<Double>]) -> Option<(Vec<f64>, Vec<Vec<Double>>)> {
        let p = shapes.len();
        let forces: Vec<Vec<Double>> = shapes.iter().map(|x| mass.product(x)).collect();
        let mut next: Vec<Vec<Double>> = forces.iter().map(|f| self.solve(f)).collect();
        // unit energy, so that weak and strong shapes are alike; and triangular, so that Zᵀ K Z = 1
        let energies: Vec<Double> = (0..p * p).map(|e| symmetric(&next, &forces, e / p, e % p)).collect();
        let lower = cholesky(&energies, p)?;
        forward(&lower, &mut next);
        let heavy: Vec<Vec<Double>> = next.iter().map(|z| mass.product(z)).collect();
        let mut inertia: Vec<Double> = (0..p * p).map(|e| symmetric(&next, &heavy, e / p, e % p)).collect();
        let turned = jacobi(&mut inertia, p);
        let theta: Vec<Double> = (0..p).map(|j| inertia[j * p + j]).collect();
        let mut order: Vec<usize> = (0..p).collect();
        order.sort_by(|a, b| theta[*b].round().total_cmp(&theta[*a].round()));
        let values: Vec<f64> = order.iter().map(|j| Double::from(1.0).over(theta[*j]).round()).collect();
        let shape = |j: &usize| -> Vec<Double> {
            let size = Double::from(1.0).over(theta[*j].root());
            let weights: Vec<Double> = (0..p).map(|i| turned[i * p + j].times(size)).collect();
            (0..next[0].len()).map(|i| next.iter().zip(&weights).fold(Double::default(), |sum, (z, w)| sum.plus(z[i], *w))).collect()
        };
        values.iter().all(|v| v.is_finite() && *v > 0.0).then(|| (values, order.iter().map(shape).collect()))
    }

    /// |K⁻¹ (K x - lambda M x)| / |x| in the norm of M bounds the relative error of the value.
    fn residual(&self, mass: &Twofold, value: f64, shape: &[Double]) -> f64 {
        let (stiff, heavy) = (self.stiffness.product(shape), mass.product(shape));
        let minus = Double::from(-value);
        let rest: Vec<Double> = stiff.iter().zip(&heavy).map(|(k, m)| k.plus(minus, *m)).collect();
        let solved = self.solve(&rest);
        let size = |x: &[Double], m: &[Double]| inner(x, m).round().max(0.0).sqrt();
        let bound = size(&solved, &mass.product(&solved)) / size(shape, &heavy);
        if bound.is_nan() { f64::INFINITY } else { bound }
    }

    /// Sturm's count: eigenvalues found below a limit, and negative pivots of K - limit M.
    fn counted(&self, mass: &Twofold, values: &[f64], wanted: usize) -> Option<(usize, usize)> {
        if values.is_empty() {
            return Some((0, 0));
        }
        let limits = limits(values, wanted, 0.0, self.stiffness.size());
        limits.into_iter().find_map(|(limit, expected)| Some((expected, self.stiffness.shifted(limit, mass).factor()?.negative()?)))
    }
}

fn symmetric(a: &[Vec<Double>], b: &[Vec<Double>], i: usize, j: usize) -> Double {
    Double::from(0.5).times(inner(&a[i], &b[j]).sum(inner(&a[j], &b[i])))
}

/// L of A = L Lᵀ; none when A is not positive definite.
fn cholesky(a: &[Double], n: usize) -> Option<Vec<Double>> {
    let mut lower = vec![Double::default(); n * n];
    for i in 0..n {
        for j in 0..=i {
            let rest = (0..j).fold(a[i * n + j], |sum, k| sum.plus(lower[i * n + k].negated(), lower[j * n + k]));
            if i != j {
                lower[i * n + j] = rest.over(lower[j * n + j]);
            } else if rest.round() > ROTATED * a[i * n + i].round() {
                lower[i * n + i] = rest.root();
            } else {
                return None;
            }
        }
    }
    Some(lower)
}

/// Columns Z L⁻ᵀ of the columns Z.
fn forward(lower: &[Double], columns: &mut [Vec<Double>]) {
    let p = columns.len();
    for j in 0..p {
        let (before, own) = columns.split_at_mut(j);
        let inverse = Double::from(1.0).over(lower[j * p + j]);
        for (k, other) in before.iter().enumerate() {
            let minus = lower[j * p + k].negated();
            own[0].iter_mut().zip(other).for_each(|(x, z)| *x = x.plus(minus, *z));
        }
        own[0].iter_mut().for_each(|x| *x = x.times(inverse));
    }
}

/// Turns a symmetric positive definite matrix into its diagonal; columns of the result are its eigenvectors.
fn jacobi(a: &mut [Double], n: usize) -> Vec<Double> {
    let one = Double::from(1.0);
    let mut turned: Vec<Double> = (0..n * n).map(|e| if e / n == e % n { one } else { Double::default() }).collect();
    // rotations converge quadratically: some six rounds from any matrix
    for _ in 0..30 {
        let mut settled = true;
        for (i, j) in (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))) {
            let (own, other, coupling) = (a[i * n + i], a[j * n + j], a[i * n + j]);
            let size = (own.round().abs() * other.round().abs()).sqrt();
            if coupling.is_zero() || coupling.round().abs() <= ROTATED * size {
                continue;
            }
            settled = false;
            // tan of the smaller angle: t² + 2 t cot 2φ - 1 = 0
            let cot = other.less(own).over(coupling.sum(coupling));
            let length = one.plus(cot, cot).root();
            let tan = if cot.round() < 0.0 { one.negated().over(length.less(cot)) } else { one.over(length.sum(cot)) };
            let cos = one.over(one.plus(tan, tan).root());
            rotate(a, &mut turned, (n, i, j), [cos, tan.times(cos)]);
        }
        if settled {
            break;
        }
    }
    turned
}

fn rotate(a: &mut [Double], turned: &mut [Double], (n, i, j): (usize, usize, usize), [c, s]: [Double; 2]) {
    let mix = |x: Double, y: Double| (c.times(x).plus(s.negated(), y), s.times(x).plus(c, y));
    for k in 0..n {
        (a[k * n + i], a[k * n + j]) = mix(a[k * n + i], a[k * n + j]);
        (turned[k * n + i], turned[k * n + j]) = mix(turned[k * n + i], turned[k * n + j]);
    }
    for k in 0..n {
        (a[i * n + k], a[j * n + k]) = mix(a[i * n + k], a[j * n + k]);
    }
    // what the rotation takes away, exactly
    a[i * n + j] = Double::default();
    a[j * n + i] = Double::default();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eigen;

    fn double(list: &[f64]) -> Vec<Double> {
        list.iter().map(|v| Double::from(*v)).collect()
    }

    /// Two masses of 1 kg, a stiff spring between them, a soft one to the ground on each: 1 and 1 + 2 c.
    #[test]
    fn a_soft_spring_below_the_last_digit_of_a_stiff_one() {
        for soft in [1e-3, 1e-9, 1e-15] {
            let (stiff, soft) = (Double::from(1e8), Double::from(soft));
            let k = [stiff.sum(soft), stiff.negated(), stiff.negated(), stiff.sum(soft)];
            let m = double(&[1.0, 0.0, 0.0, 1.0]);
            let rounded: Vec<f64> = k.iter().map(|v| v.round()).collect();
            let start = eigen::symmetric(2, &rounded, &[1.0, 0.0, 0.0, 1.0]).unwrap();
            let firm = Firm::of(Twofold::from_dense(2, &k)).unwrap().unwrap();
            let (modes, certificate) = firm.polished(&Twofold::from_dense(2, &m), &start, 2).unwrap();
            // the last digit of a division and a square root
            assert!((modes.values[0] / soft.round() - 1.0).abs() < 1e-15, "{:?}", modes.values);
            // the same
            assert!((modes.values[1] / (2e8 + soft.round()) - 1.0).abs() < 1e-15);
            assert_eq!(certificate.passes(), [true, true], "{certificate:?}");
        }
    }

    /// The inverse iteration repairs shapes that hold a hundredth of each other and of others.
    #[test]
    fn wrong_shapes_are_repaired_or_told() {
        let n = 8;
        let entry = |i: usize, j: usize| if i == j { 2.0 } else { -f64::from(u8::from(i.abs_diff(j) == 1)) };
        let k: Vec<f64> = (0..n * n).map(|e| entry(e / n, e % n)).collect();
        let m: Vec<f64> = (0..n * n).map(|e| f64::from(u8::from(e / n == e % n))).collect();
        let right = eigen::symmetric(n, &k, &m).unwrap();
        let mut start = right.clone();
        start.vectors.iter_mut().enumerate().for_each(|(i, v)| *v += 0.01 * (i as f64).sin());
        let firm = Firm::of(Twofold::from_dense(n, &double(&k))).unwrap().unwrap();
        let mass = Twofold::from_dense(n, &double(&m));
        let (modes, certificate) = firm.polished(&mass, &start, 2).unwrap();
        // chain: lambda_j = 4 sin²(j pi/18)
        for (j, value) in modes.values.iter().enumerate() {
            let exact = 4.0 * ((j + 1) as f64 * std::f64::consts::PI / 18.0).sin().powi(2);
            // rounding of the sine that is squared
            assert!((value / exact - 1.0).abs() < 1e-14, "{value} {exact}");
        }
        assert_eq!(certificate.passes(), [true, true]);
        // without the first shape the count finds one more
        let skipped = Modes { n, values: right.values[1..].to_vec(), vectors: right.vectors[n..].to_vec() };
        assert_eq!(firm.polished(&mass, &skipped, 7).unwrap().1.missing(), 1);
    }
}
