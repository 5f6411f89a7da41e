//! The exponential of a small dense matrix.
//!
//! *Source*: N. J. Higham, The scaling and squaring method for the matrix exponential revisited, SIAM J. Matrix Anal. Appl. 26 (2005):
//! the diagonal Padé approximant of degree 13 serves up to the norm 5.37, larger matrices are halved and the result squared.

use super::lu::Lu;
use crate::elementary;

const LARGEST: f64 = 5.371_920_351_148_152;
const PADE: [f64; 14] = [
    64_764_752_532_480_000.0,
    32_382_376_266_240_000.0,
    7_771_770_303_897_600.0,
    1_187_353_796_428_800.0,
    129_060_195_264_000.0,
    10_559_470_521_600.0,
    670_442_572_800.0,
    33_522_128_640.0,
    1_323_241_920.0,
    40_840_800.0,
    960_960.0,
    16_380.0,
    182.0,
    1.0,
];

/// e^(A t) of a row-major n x n matrix; none when an entry is not finite.
pub fn exponential(a: &[f64], n: usize, t: f64) -> Option<Vec<f64>> {
    let norm = (0..n).map(|j| (0..n).map(|i| (a[i * n + j] * t).abs()).sum::<f64>()).fold(0.0, f64::max);
    if !norm.is_finite() {
        return None;
    }
    let halvings = if norm > LARGEST { elementary::log2(norm / LARGEST).ceil() as i32 } else { 0 };
    let factor = t * elementary::powi(0.5_f64, halvings);
    let a: Vec<f64> = a.iter().map(|v| v * factor).collect();
    let mut e = pade(&a, n)?;
    for _ in 0..halvings {
        e = product(&e, &e, n);
    }
    Some(e)
}

/// Row-major product of n x n matrices.
pub fn product(a: &[f64], b: &[f64], n: usize) -> Vec<f64> {
    let mut c = vec![0.0; n * n];
    for i in 0..n {
        for k in 0..n {
            let f = a[i * n + k];
            if f != 0.0 {
                for j in 0..n {
                    c[i * n + j] += f * b[k * n + j];
                }
            }
        }
    }
    c
}

/// (V - U)^-1 (V + U) with U odd and V even in A.
fn pade(a: &[f64], n: usize) -> Option<Vec<f64>> {
    let a2 = product(a, a, n);
    let a4 = product(&a2, &a2, n);
    let a6 = product(&a4, &a2, n);
    let combine = |c6: f64, c4: f64, c2: f64, c0: f64| -> Vec<f64> {
        (0..n * n).map(|i| c6 * a6[i] + c4 * a4[i] + c2 * a2[i] + if i % (n + 1) == 0 { c0 } else { 0.0 }).collect()
    };
    let add = |x: Vec<f64>, y: &[f64]| -> Vec<f64> { x.iter().zip(y).map(|(p, q)| p + q).collect() };
    let high = product(&a6, &combine(PADE[13], PADE[11], PADE[9], 0.0), n);
    let u = product(a, &add(combine(PADE[7], PADE[5], PADE[3], PADE[1]), &high), n);
    let high = product(&a6, &combine(PADE[12], PADE[10], PADE[8], 0.0), n);
    let v = add(combine(PADE[6], PADE[4], PADE[2], PADE[0]), &high);
    let below: Vec<f64> = v.iter().zip(&u).map(|(v, u)| v - u).collect();
    let above: Vec<f64> = v.iter().zip(&u).map(|(v, u)| v + u).collect();
    let lu = Lu::new(&below, n);
    let mut e = vec![0.0; n * n];
    for j in 0..n {
        let column: Vec<f64> = (0..n).map(|i| above[i * n + j]).collect();
        for (i, value) in lu.solve(&column)?.into_iter().enumerate() {
            e[i * n + j] = value;
        }
    }
    Some(e)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Units of the last place.
    const ROUNDING: f64 = 1e-15;

    #[test]
    fn rotation_and_jordan_block() {
        let e = exponential(&[0.0, 7.0, -7.0, 0.0], 2, 3.0).unwrap();
        let (s, c) = 21.0_f64.sin_cos();
        for (got, wanted) in e.iter().zip([c, s, -s, c]) {
            assert!((got - wanted).abs() < 20.0 * ROUNDING, "{got} {wanted}");
        }
        let e = exponential(&[-1.0, 1.0, 0.0, -1.0], 2, 2.0).unwrap();
        let d = (-2.0_f64).exp();
        for (got, wanted) in e.iter().zip([d, 2.0 * d, 0.0, d]) {
            assert!((got - wanted).abs() < ROUNDING, "{got} {wanted}");
        }
    }
}
