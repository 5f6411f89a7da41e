//! Polynomials of all lanes: values, slopes, bounds. Two rows at a time, or four points, hide how long an addition takes; each sum has its terms in the order of its own.

use super::registers::{Lanes, Simd, abs, add, add_mul, at, mul, pairs, put, splat};

/// Σ_k c_k τ^k and its derivative by Horner's rule.
#[inline(always)]
pub fn horner<S: Simd>(simd: S, c: &[Lanes], tau: &Lanes) -> [Lanes; 2] {
    let (mut values, mut slopes) = ([0.0; 8], [0.0; 8]);
    for p in pairs::<S>() {
        let tau = at::<S>(tau, p);
        let [mut v, mut s] = [splat(simd, 0.0); 2];
        for c_k in c.iter().rev() {
            s = add_mul(simd, v, s, tau);
            v = add_mul(simd, at::<S>(c_k, p), v, tau);
        }
        put::<S>(&mut values, p, v);
        put::<S>(&mut slopes, p, s);
    }
    [values, slopes]
}

/// [`horner`] of two rows of one length.
#[inline(always)]
pub fn horners<S: Simd>(simd: S, [c, d]: [&[Lanes]; 2], tau: &Lanes) -> [[Lanes; 2]; 2] {
    let [mut values, mut slopes, mut others, mut other_slopes] = [[0.0; 8]; 4];
    for p in pairs::<S>() {
        let tau = at::<S>(tau, p);
        let [mut v, mut s, mut w, mut r] = [splat(simd, 0.0); 4];
        for (c_k, d_k) in c.iter().rev().zip(d.iter().rev()) {
            s = add_mul(simd, v, s, tau);
            v = add_mul(simd, at::<S>(c_k, p), v, tau);
            r = add_mul(simd, w, r, tau);
            w = add_mul(simd, at::<S>(d_k, p), w, tau);
        }
        put::<S>(&mut values, p, v);
        put::<S>(&mut slopes, p, s);
        put::<S>(&mut others, p, w);
        put::<S>(&mut other_slopes, p, r);
    }
    [[values, slopes], [others, other_slopes]]
}

/// Σ_k c_k w_k for four weights each: a row at four points.
#[inline(always)]
pub fn weighted<S: Simd>(simd: S, c: &[Lanes], weights: &[[f64; 4]]) -> [Lanes; 4] {
    let [mut first, mut second, mut third, mut fourth] = [[0.0; 8]; 4];
    for p in pairs::<S>() {
        let [mut s0, mut s1, mut s2, mut s3] = [splat(simd, 0.0); 4];
        // the smallest terms first
        for (c_k, [w0, w1, w2, w3]) in c.iter().zip(weights).rev() {
            let x = at::<S>(c_k, p);
            s0 = add_mul(simd, s0, x, splat(simd, *w0));
            s1 = add_mul(simd, s1, x, splat(simd, *w1));
            s2 = add_mul(simd, s2, x, splat(simd, *w2));
            s3 = add_mul(simd, s3, x, splat(simd, *w3));
        }
        put::<S>(&mut first, p, s0);
        put::<S>(&mut second, p, s1);
        put::<S>(&mut third, p, s2);
        put::<S>(&mut fourth, p, s3);
    }
    [first, second, third, fourth]
}

/// Σ_k |c_k| h^k over the terms from the first to the last, by Horner's rule, times h.
#[inline(always)]
pub fn way<S: Simd>(simd: S, c: &[Lanes], h: &Lanes) -> Lanes {
    let mut result = [0.0; 8];
    for p in pairs::<S>() {
        let h = at::<S>(h, p);
        let mut sum = splat(simd, 0.0);
        for c_k in c.iter().rev() {
            sum = mul(simd, add(simd, sum, abs(simd, at::<S>(c_k, p))), h);
        }
        put::<S>(&mut result, p, sum);
    }
    result
}

/// [`way`] of two rows of one length.
#[inline(always)]
pub fn ways<S: Simd>(simd: S, [c, d]: [&[Lanes]; 2], h: &Lanes) -> [Lanes; 2] {
    let (mut first, mut second) = ([0.0; 8], [0.0; 8]);
    for p in pairs::<S>() {
        let h = at::<S>(h, p);
        let [mut s, mut r] = [splat(simd, 0.0); 2];
        for (c_k, d_k) in c.iter().rev().zip(d.iter().rev()) {
            s = mul(simd, add(simd, s, abs(simd, at::<S>(c_k, p))), h);
            r = mul(simd, add(simd, r, abs(simd, at::<S>(d_k, p))), h);
        }
        put::<S>(&mut first, p, s);
        put::<S>(&mut second, p, r);
    }
    [first, second]
}

/// max_k |c_k| p_k of powers p_k that are not negative, infinite where a term is no number.
#[inline(always)]
pub fn largest_term<S: Simd>(simd: S, c: &[Lanes], powers: &[Lanes]) -> Lanes {
    let mut result = [0.0; 8];
    for p in pairs::<S>() {
        // the maximum passes over what is no number, the sum does not
        let [mut most, mut sum] = [splat(simd, 0.0); 2];
        for (c_k, power) in c.iter().zip(powers) {
            let term = mul(simd, abs(simd, at::<S>(c_k, p)), at::<S>(power, p));
            most = [simd.max_f64s(term[0], most[0]), simd.max_f64s(term[1], most[1])];
            sum = add(simd, sum, term);
        }
        let infinite = simd.splat_f64s(f64::INFINITY);
        let known = [
            simd.select_f64s(simd.equal_f64s(sum[0], sum[0]), most[0], infinite),
            simd.select_f64s(simd.equal_f64s(sum[1], sum[1]), most[1], infinite),
        ];
        put::<S>(&mut result, p, known);
    }
    result
}
