//! Kernels over several numbers at once, in vector registers whatever the compiler makes of loops: only this file knows the crate `wide`.
//!
//! A processor multiplies two, four or eight numbers in the time of one. The compiler finds that in loops of its own, but not in every program: where units are optimised together and for
//! size, as in the one that is handed out, it leaves most of them scalar. Here the operations are written as those of vectors. Each number sees the same products and sums in the
//! same order as in a loop (there is no fused multiplication), so that the bits are the same on every machine.

use wide::f64x4;

/// Numbers of a vector.
const WIDTH: usize = 4;

/// Σ a_i b_i over whole groups of four, as four sums s_l over i = l (mod 4), then (s_0 + s_2) + (s_1 + s_3). What is left over behind the last whole group does not count.
#[inline(never)]
pub fn product(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = f64x4::ZERO;
    for (x, y) in a.as_chunks::<WIDTH>().0.iter().zip(b.as_chunks::<WIDTH>().0) {
        sums += f64x4::new(*x) * f64x4::new(*y);
    }
    folded(sums)
}

/// [`product`] of one run with two.
#[inline(never)]
pub fn products(a: &[f64], [b, c]: [&[f64]; 2]) -> [f64; 2] {
    let (mut first, mut second) = (f64x4::ZERO, f64x4::ZERO);
    for ((x, y), z) in a.as_chunks::<WIDTH>().0.iter().zip(b.as_chunks::<WIDTH>().0).zip(c.as_chunks::<WIDTH>().0) {
        let x = f64x4::new(*x);
        first += x * f64x4::new(*y);
        second += x * f64x4::new(*z);
    }
    [folded(first), folded(second)]
}

#[inline(always)]
fn folded(sums: f64x4) -> f64 {
    let [a, b, c, d] = sums.to_array();
    (a + c) + (b + d)
}

/// Σ_k c_k τ^k and its derivative at four places by Horner's rule.
#[inline(never)]
pub fn horner(c: &[f64], taus: &[f64; 4]) -> [[f64; 4]; 2] {
    let tau = f64x4::new(*taus);
    let (mut values, mut slopes) = (f64x4::ZERO, f64x4::ZERO);
    for c_k in c.iter().rev() {
        slopes = slopes * tau + values;
        values = values * tau + f64x4::splat(*c_k);
    }
    [values.to_array(), slopes.to_array()]
}

/// Σ_j c_j rows_j, in the order of j, by columns.
#[inline(never)]
pub fn combined<const K: usize>(rows: &[[f64; K]], c: &[f64]) -> [f64; K] {
    // nothing, as a sum begins
    let mut sums = [-0.0; K];
    let (groups, rest) = sums.as_chunks_mut::<WIDTH>();
    for (g, group) in groups.iter_mut().enumerate() {
        let mut sum = f64x4::new(*group);
        for (row, c_j) in rows.iter().zip(c) {
            sum += f64x4::splat(*c_j) * f64x4::new(row.as_chunks::<WIDTH>().0[g]);
        }
        *group = sum.to_array();
    }
    for (k, sum) in rest.iter_mut().enumerate() {
        let k = k + K / WIDTH * WIDTH;
        rows.iter().zip(c).for_each(|(row, c_j)| *sum += c_j * row[k]);
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fixed sequence in -1..1.
    fn numbers(count: usize, seed: f64) -> Vec<f64> {
        (1..=count).map(|n| 2.0 * (seed + n as f64 * 0.754_877_666_246_692_7).fract() - 1.0).collect()
    }

    #[test]
    fn vectors_have_the_bits_of_loops() {
        for count in 0..=29 {
            let [a, b, c] = [0.1, 0.2, 0.3].map(|seed| numbers(count, seed));
            let mut sums = [0.0_f64; WIDTH];
            for i in 0..count / WIDTH * WIDTH {
                sums[i % WIDTH] += a[i] * b[i];
            }
            let looped = (sums[0] + sums[2]) + (sums[1] + sums[3]);
            assert_eq!(product(&a, &b).to_bits(), looped.to_bits());
            assert_eq!(products(&a, [&b, &c]), [looped, product(&a, &c)]);
            let taus = [0.7, -0.3, 0.0, 1.9];
            let [values, slopes] = horner(&a, &taus);
            for (lane, tau) in taus.into_iter().enumerate() {
                let (mut value, mut slope) = (0.0, 0.0);
                for c_k in a.iter().rev() {
                    slope = slope * tau + value;
                    value = value * tau + c_k;
                }
                assert_eq!([values[lane], slopes[lane]], [value, slope]);
            }
        }
    }

    #[test]
    fn columns_are_summed_in_the_order_of_rows() {
        let (rows, c) = (numbers(12 * 7, 0.4), numbers(12, 0.5));
        let sums = combined(rows.as_chunks::<7>().0, &c);
        for (k, sum) in sums.iter().enumerate() {
            let looped: f64 = (0..12).map(|j| c[j] * rows[7 * j + k]).sum();
            assert_eq!(sum.to_bits(), looped.to_bits());
        }
    }
}
