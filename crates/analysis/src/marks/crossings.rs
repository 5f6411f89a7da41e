//! All sign changes of a polynomial on [0, 1], in Bernstein's form.
//!
//! Between n + 1 Bernstein coefficients there are at least as many sign changes as roots, and the difference is even (Descartes): no change, no root;
//! one, exactly one. Otherwise the interval is halved (de Casteljau). Coefficients below `noise` count as zero, so that a touch of zero and a pair of
//! roots nearer than rounding can tell are no change of sign. *Source*: see [`crate::integrate::crossings::roots`].

use algebra::elementary;

/// Deepest halving.
const DEPTH: u32 = 48;

/// A change of sign inside [from, to], or at the point from = to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bracket {
    /// Left end.
    pub from: f64,
    /// Right end.
    pub to: f64,
    /// Sign after it.
    pub sign: f64,
}

/// Sign changes in order. `sign` is that before the interval, 0 when unknown; afterwards that at its end, zeros left out.
pub fn crossings(row: &[f64], noise: f64, sign: &mut f64) -> Vec<Bracket> {
    let mut found = Vec::new();
    let mut open = vec![(row.to_vec(), 0.0_f64, 0_u32)];
    while let Some((row, from, depth)) = open.pop() {
        let width = elementary::powi(0.5_f64, depth as i32);
        let (changes, mut first, mut last) = signs(&row, noise);
        // only the ends are values: a coefficient between says nothing about an end that is noise
        let ends = [row[0], row[row.len() - 1]].map(|b| b.abs() > noise);
        let clear = if changes == 0 { first == 0.0 || ends[0] || ends[1] } else { changes == 1 && ends[0] && ends[1] };
        if !clear && depth < DEPTH {
            let (left, right) = halves(row);
            open.push((right, from + 0.5 * width, depth + 1));
            open.push((left, from, depth + 1));
            continue;
        }
        if !clear {
            // an instant: what its ends say, if anything
            let sides = [row[0], row[row.len() - 1]].map(f64::signum);
            (first, last) = match ends {
                [true, true] => (sides[0], sides[1]),
                [true, false] => (sides[0], sides[0]),
                [false, true] => (sides[1], sides[1]),
                [false, false] => continue,
            };
        }
        if first == 0.0 {
            continue;
        }
        if *sign != 0.0 && first != *sign {
            found.push(Bracket { from, to: from, sign: first });
        }
        if first != last {
            found.push(Bracket { from, to: from + width, sign: last });
        }
        *sign = last;
    }
    found
}

/// A part of [0, 1] between whose ends a polynomial changes its sign once or not at all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Left end.
    pub from: f64,
    /// Right end.
    pub to: f64,
    /// Signs at both ends, clear of noise; none where the polynomial is not clear of it.
    pub signs: Option<[f64; 2]>,
}

/// Halvings after which a part that noise blurs is told as it is: a thousandth of the whole.
const BLURRED: u32 = 10;

/// The parts of [0, 1] in order; those that noise blurs are as long as they come.
pub fn stretches(row: &[f64], noise: f64) -> Vec<Stretch> {
    let mut found: Vec<Stretch> = Vec::new();
    let mut open = vec![(row.to_vec(), 0.0_f64, 0_u32)];
    while let Some((row, from, depth)) = open.pop() {
        let width = elementary::powi(0.5_f64, depth as i32);
        let (changes, first, last) = signs(&row, noise);
        let clear = changes <= 1 && [row[0], row[row.len() - 1]].iter().all(|b| b.abs() > noise);
        if !clear && first != 0.0 && depth < BLURRED && row.len() > 2 {
            let (left, right) = halves(row);
            open.push((right, from + 0.5 * width, depth + 1));
            open.push((left, from, depth + 1));
            continue;
        }
        let signs = clear.then_some([first, last]);
        match found.last_mut().filter(|before| before.signs.is_none() && signs.is_none()) {
            Some(before) => before.to = from + width,
            None => found.push(Stretch { from, to: from + width, signs }),
        }
    }
    found
}

/// Bernstein coefficients of Σ c_k τ^k over 0 <= τ <= h.
pub fn from_powers(c: &[f64], h: f64) -> Vec<f64> {
    let n = c.len().saturating_sub(1);
    let (mut b, mut power, mut binomial) = (Vec::with_capacity(n + 1), 1.0, 1.0);
    for (k, c_k) in c.iter().enumerate() {
        b.push(c_k * power / binomial);
        power *= h;
        binomial *= (n - k) as f64 / (k + 1) as f64;
    }
    for level in 1..=n {
        for j in (level..=n).rev() {
            b[j] += b[j - 1];
        }
    }
    b
}

/// Value of the polynomial at u in [0, 1]: Σ b_i C(n, i) r^i (1 - u)^n with r = u/(1 - u), from the nearer end, so that r <= 1. All weights are positive: as
/// exact as de Casteljau's triangle, in n operations.
pub fn value(row: &[f64], u: f64) -> f64 {
    let Some(n) = row.len().checked_sub(1) else { return 0.0 };
    let from_end = u > 0.5;
    let (near, far) = if from_end { (1.0 - u, u) } else { (u, 1.0 - u) };
    let ratio = near / far;
    let (mut sum, mut weight) = (0.0, 1.0);
    for i in 0..=n {
        sum += weight * row[if from_end { n - i } else { i }];
        weight *= ratio * (n - i) as f64 / (i + 1) as f64;
    }
    sum * elementary::powi(far, n as i32)
}

/// Coefficients of the derivative.
pub fn derivative(row: &[f64]) -> Vec<f64> {
    let n = row.len().saturating_sub(1) as f64;
    row.windows(2).map(|pair| n * (pair[1] - pair[0])).collect()
}

/// Coefficients of the integral from 0 over a piece of this width.
pub fn integral(row: &[f64], width: f64) -> Vec<f64> {
    let share = width / row.len() as f64;
    let sums = row.iter().scan(0.0, |sum, b| {
        *sum += share * b;
        Some(*sum)
    });
    std::iter::once(0.0).chain(sums).collect()
}

/// Coefficients over both halves.
pub(super) fn halves(mut row: Vec<f64>) -> (Vec<f64>, Vec<f64>) {
    let n = row.len();
    let mut left = Vec::with_capacity(n);
    for level in 0..n {
        left.push(row[0]);
        for j in 0..n - 1 - level {
            row[j] = 0.5 * (row[j] + row[j + 1]);
        }
    }
    (left, row)
}

/// Number of changes; first and last sign.
fn signs(row: &[f64], noise: f64) -> (usize, f64, f64) {
    let (mut changes, mut first, mut last) = (0, 0.0, 0.0);
    for b in row.iter().filter(|b| b.abs() > noise) {
        let sign = b.signum();
        if first == 0.0 {
            first = sign;
        } else if sign != last {
            changes += 1;
        }
        last = sign;
    }
    (changes, first, last)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// cos(3u) of degree 16: the sum of weights against de Casteljau's triangle.
    #[test]
    fn values_are_those_of_the_triangle() {
        let row: Vec<f64> = (0..17).map(|k| (3.0 * f64::from(k) / 16.0).cos()).collect();
        for k in 0..=200 {
            let u = f64::from(k) / 200.0;
            let mut b = row.clone();
            for level in 1..b.len() {
                (0..b.len() - level).for_each(|j| b[j] += u * (b[j + 1] - b[j]));
            }
            // both err by some units in the last place for each of the 16 degrees
            assert!((value(&row, u) - b[0]).abs() < 16.0 * f64::EPSILON, "{u}");
        }
    }

    fn of_roots(roots: &[f64]) -> Vec<f64> {
        let mut c = vec![1.0];
        for r in roots {
            c.push(0.0);
            for k in (0..c.len()).rev() {
                c[k] = if k > 0 { c[k - 1] } else { 0.0 } - r * c[k];
            }
        }
        from_powers(&c, 1.0)
    }

    #[test]
    fn every_root_has_its_bracket() {
        for roots in [vec![0.1, 0.5, 0.75], vec![0.25, 0.5], vec![0.3, 0.3000001, 0.9], vec![0.0, 0.4]] {
            let row = of_roots(&roots);
            let mut sign = 0.0;
            let found = crossings(&row, 1e-17, &mut sign);
            let inner: Vec<f64> = roots.iter().copied().filter(|r| *r > 0.0).collect();
            assert_eq!(found.len(), inner.len(), "{roots:?} {found:?}");
            for (bracket, root) in found.iter().zip(&inner) {
                assert!(bracket.from <= root + 1e-15 && *root <= bracket.to + 1e-15, "{bracket:?} {root}");
            }
        }
    }

    /// Two roots that noise blurs are one blurred part between parts that are clear.
    #[test]
    fn what_noise_blurs_is_told() {
        let found = stretches(&of_roots(&[0.3, 0.3000001, 0.9]), 1e-9);
        let mut told: Vec<_> = found.iter().map(|s| s.signs).collect();
        told.dedup();
        assert_eq!(told, [Some([-1.0; 2]), None, Some([-1.0; 2]), Some([-1.0, 1.0])], "{found:?}");
        let blurred = found.iter().find(|s| s.signs.is_none()).unwrap();
        assert!(blurred.from <= 0.3 && blurred.to >= 0.3000001 && blurred.to - blurred.from < 0.01);
    }

    #[test]
    fn a_touch_is_no_change_and_a_change_between_intervals_is_found() {
        let mut sign = 0.0;
        assert!(crossings(&of_roots(&[0.4, 0.4]), 1e-15, &mut sign).is_empty());
        // minus before, plus from the first value on: the change is at the start
        let mut sign = -1.0;
        assert_eq!(crossings(&[0.0, 1.0, 2.0], 1e-15, &mut sign), vec![Bracket { from: 0.0, to: 0.0, sign: 1.0 }]);
    }
}
