//! One step of z' = f(s, z) by extrapolation of the modified midpoint rule.
//!
//! Midpoint steps of h/2, h/4, h/6, ... have errors in even powers of the step; with n_k = 2 (k + 1) steps Aitken's and Neville's scheme removes one
//! power with each column:
//!
//! ```text
//! T_k,j = T_k,j-1 + (T_k,j-1 - T_k-1,j-1)/((n_k/n_k-j)² - 1)
//! ```
//!
//! *Source*: E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, II.9 (Gragg, Bulirsch, Stoer).

use algebra::elementary;

/// Rows of the scheme: order 16 at the end.
const ROWS: usize = 8;

/// What a step may see of the motion: f(s, z), none where it has no value.
pub(super) type Field<'f> = &'f mut dyn FnMut(f64, &[f64]) -> Option<Vec<f64>>;

/// z at s + h, when two columns agree to `tolerance` of `scales` or of the value; none when they do not, or f has no value.
pub(super) fn step(f: Field, (s, h): (f64, f64), z: &[f64], scales: &[f64], tolerance: f64) -> Option<Vec<f64>> {
    let slope = f(s, z)?;
    let mut above: Vec<Vec<f64>> = Vec::new();
    for k in 0..ROWS {
        let parts = |k: usize| 2.0 * (k + 1) as f64;
        let mut row = vec![midpoint(f, (s, h), (z, &slope), 2 * (k + 1))?];
        for j in 1..=k {
            let ratio = elementary::powi(parts(k) / parts(k - j), 2) - 1.0;
            row.push(row[j - 1].iter().zip(&above[j - 1]).map(|(new, old)| new + (new - old) / ratio).collect());
        }
        if k > 0 && agree(&row[k], &row[k - 1], scales, tolerance) {
            return row.pop();
        }
        above = row;
    }
    None
}

fn agree(a: &[f64], b: &[f64], scales: &[f64], tolerance: f64) -> bool {
    a.iter().zip(b).zip(scales).all(|((a, b), scale)| (a - b).abs() <= tolerance * scale.max(a.abs()))
}

/// The modified midpoint rule in `parts` parts, an even number, with Gragg's smoothing at the end.
fn midpoint(f: Field, (s, h): (f64, f64), (z, slope): (&[f64], &[f64]), parts: usize) -> Option<Vec<f64>> {
    let part = h / parts as f64;
    let mut before = z.to_vec();
    let mut here: Vec<f64> = z.iter().zip(slope).map(|(z, d)| z + part * d).collect();
    for k in 1..parts {
        let d = f(s + k as f64 * part, &here)?;
        let next = before.iter().zip(&d).map(|(z, d)| z + 2.0 * part * d).collect();
        before = std::mem::replace(&mut here, next);
    }
    let d = f(s + h, &here)?;
    Some((0..z.len()).map(|i| 0.5 * (here[i] + before[i] + part * d[i])).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_of_a_circle_closes() {
        let mut circle = |_: f64, z: &[f64]| Some(vec![-z[1], z[0]]);
        let mut z = vec![1.0, 0.0];
        for k in 0..16 {
            let h = std::f64::consts::TAU / 16.0;
            z = step(&mut circle, (k as f64 * h, h), &z, &[1.0, 1.0], 1e-14).unwrap();
        }
        // sixteen steps, each to rounding
        assert!((z[0] - 1.0).abs() < 1e-13 && z[1].abs() < 1e-13, "{z:?}");
    }

    #[test]
    fn a_pole_is_not_stepped_over() {
        let mut pole = |s: f64, _: &[f64]| (s != 0.0).then(|| vec![1.0 / s]);
        assert!(step(&mut pole, (-1.0, 3.0), &[0.0], &[1.0], 1e-9).is_none());
    }
}
