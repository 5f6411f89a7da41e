//! e^x, ln x and the hyperbolic functions of all lanes, without a branch. Where numbers end or are none, the library's own values are taken.
//!
//! *Source*: FreeBSD's msun (`e_exp`, `s_expm1`, `e_log`), by way of musl: the same reductions and polynomials; one formula of `expm1` serves all whole parts from 0 on.

use super::registers::{Lanes, Simd, WHOLE, and, at, pairs, put, times, whole};
use crate::elementary;

/// From here on e^x comes near the ends of the numbers.
const STEEP: f64 = 700.0;
/// Beyond this tanh x is 1 to the last digit, by far.
const FLAT: f64 = 50.0;
/// Up to here tanh x is a quotient that keeps the digits of small x, beyond it what is left to 1.
const SMALL: f64 = 0.549_306_144_334_054_8;
/// ln 2 in a part of 33 bits and what is left.
const LN_2: [f64; 2] = [0.693_147_180_369_123_8, 1.908_214_929_270_587_7e-10];
const EXP: [f64; 5] = [
    0.166_666_666_666_666_02,
    -0.002_777_777_777_701_559_3,
    6.613_756_321_437_934e-5,
    -1.653_390_220_546_525_2e-6,
    4.138_136_797_057_238_5e-8,
];
const EXPM1: [f64; 5] = [
    -0.033_333_333_333_333_13,
    0.001_587_301_587_254_814_6,
    -7.936_507_578_674_88e-5,
    4.008_217_827_329_362e-6,
    -2.010_992_181_836_243_7e-7,
];
const LOG: [f64; 7] = [
    0.666_666_666_666_673_5,
    0.399_999_999_994_094_2,
    0.285_714_287_436_623_9,
    0.222_221_984_321_497_84,
    0.181_835_721_616_180_5,
    0.153_138_376_992_093_73,
    0.147_981_986_051_165_86,
];

/// e^x.
#[inline(always)]
pub fn exp<S: Simd>(simd: S, x: &Lanes) -> Lanes {
    let (mut values, mut wholes) = ([0.0; 8], [0.0; 8]);
    for p in pairs::<S>() {
        let [x, y] = at::<S>(x, p);
        let ([k, a], [l, b]) = (near_one(simd, x), near_one(simd, y));
        put::<S>(&mut values, p, [a, b]);
        put::<S>(&mut wholes, p, [k, l]);
    }
    let mut result = times(simd, &values, &twos(&wholes)[0]);
    if !within(x, STEEP) {
        far(x, &mut result, elementary::exp);
    }
    result
}

/// ln x.
#[inline(always)]
pub fn log<S: Simd>(simd: S, x: &Lanes) -> Lanes {
    /// Upper half of √½ and of 1.
    const ROOT: u64 = 0x3fe6_a09e << 32;
    const ONE: u64 = 0x3ff0_0000 << 32;
    const FRACTION: u64 = (1 << 52) - 1;
    // x = m 2^k, m between √½ and √2
    let (mut wholes, mut parts) = ([0.0; 8], [0.0; 8]);
    for lane in 0..8 {
        let bits = x[lane].to_bits().wrapping_add(ONE - ROOT);
        wholes[lane] = (bits >> 52) as i32 as f64 - 1023.0;
        parts[lane] = f64::from_bits((bits & FRACTION).wrapping_add(ROOT));
    }
    let mut result = [0.0; 8];
    for p in pairs::<S>() {
        let ([k, l], [a, b]) = (at::<S>(&wholes, p), at::<S>(&parts, p));
        put::<S>(&mut result, p, [logarithm(simd, k, a), logarithm(simd, l, b)]);
    }
    let mut ends = false;
    for x in x {
        ends |= !(*x >= f64::MIN_POSITIVE && *x < f64::INFINITY);
    }
    if ends {
        log_at_ends(x, &mut result);
    }
    result
}

/// (tanh x, 1 - tanh² x), both with their digits wherever they are; what tanh itself does not show any more is nothing.
#[inline(always)]
pub fn tanh<S: Simd>(simd: S, x: &Lanes) -> [Lanes; 2] {
    let mut twice = [0.0; 8];
    for p in pairs::<S>() {
        let [x, y] = at::<S>(x, p);
        put::<S>(&mut twice, p, [limited(simd, x), limited(simd, y)]);
    }
    let grown = expm1(simd, &twice);
    let (mut values, mut rest) = ([0.0; 8], [0.0; 8]);
    for p in pairs::<S>() {
        let ([x, y], [t, s]) = (at::<S>(x, p), at::<S>(&grown, p));
        let ([a, u], [b, v]) = (saturated(simd, x, t), saturated(simd, y, s));
        put::<S>(&mut values, p, [a, b]);
        put::<S>(&mut rest, p, [u, v]);
    }
    if !within(x, f64::MAX) {
        far(x, &mut values, elementary::tanh);
        far(x, &mut rest, nothing);
    }
    [values, rest]
}

/// (sinh x, cosh x).
#[inline(always)]
pub fn sinh_cosh<S: Simd>(simd: S, x: &Lanes) -> [Lanes; 2] {
    let mut size = [0.0; 8];
    for p in pairs::<S>() {
        let [x, y] = at::<S>(x, p);
        put::<S>(&mut size, p, [simd.abs_f64s(x), simd.abs_f64s(y)]);
    }
    let grown = expm1(simd, &size);
    let (mut sines, mut cosines) = ([0.0; 8], [0.0; 8]);
    for p in pairs::<S>() {
        let ([x, y], [t, s]) = (at::<S>(x, p), at::<S>(&grown, p));
        let ([a, c], [b, d]) = (hyperbolic(simd, x, t), hyperbolic(simd, y, s));
        put::<S>(&mut sines, p, [a, b]);
        put::<S>(&mut cosines, p, [c, d]);
    }
    if !within(x, STEEP) {
        far(x, &mut sines, elementary::sinh);
        far(x, &mut cosines, elementary::cosh);
    }
    [sines, cosines]
}

/// x^(-1/k) of numbers that are not negative, to nine digits: what a search for lengths asks for. Very small and very large ones count as 1e-300 and 1e300; of what is no number nothing can be said.
#[inline(always)]
pub fn roots<S: Simd>(simd: S, x: &Lanes, k: f64) -> Lanes {
    const ROOT_2: u64 = 0x3ff6_a09e_667f_3bcd;
    /// All numbers but the very ends.
    const LEAST: f64 = 1e-300;
    // x = m 2^e, m between √½ and √2
    let (mut wholes, mut parts) = ([0.0; 8], [0.0; 8]);
    for lane in 0..8 {
        let x = x[lane].clamp(LEAST, 1.0 / LEAST);
        let e = (x.to_bits().wrapping_sub(ROOT_2) as i64 >> 52) + 1;
        wholes[lane] = e as i32 as f64;
        parts[lane] = f64::from_bits(x.to_bits().wrapping_sub((e << 52) as u64));
    }
    let (mut exponents, mut powers) = ([0.0; 8], [0.0; 8]);
    for p in pairs::<S>() {
        let ([e, f], [m, n]) = (at::<S>(&wholes, p), at::<S>(&parts, p));
        let ([i, a], [j, b]) = (rough_root(simd, e, m, k), rough_root(simd, f, n, k));
        put::<S>(&mut exponents, p, [i, j]);
        put::<S>(&mut powers, p, [a, b]);
    }
    times(simd, &powers, &twos(&exponents)[0])
}

/// The whole part of y = -log2(m 2^e)/k, and 2 to the power of the rest: the series of artanh for the logarithm and that of the exponential.
#[inline(always)]
fn rough_root<S: Simd>(simd: S, e: S::f64s, m: S::f64s, k: f64) -> [S::f64s; 2] {
    let one = simd.splat_f64s(1.0);
    let s = simd.div_f64s(simd.sub_f64s(m, one), simd.add_f64s(m, one));
    let z = simd.mul_f64s(s, s);
    let series = and(simd, 1.0, z, and(simd, 1.0 / 3.0, z, and(simd, 0.2, z, and(simd, 1.0 / 7.0, z, simd.splat_f64s(1.0 / 9.0)))));
    let log = simd.mul_f64s(simd.mul_f64s(simd.splat_f64s(2.0), s), series);
    let log2 = simd.add_f64s(simd.mul_f64s(log, simd.splat_f64s(std::f64::consts::LOG2_E)), e);
    let y = simd.mul_f64s(log2, simd.splat_f64s(-1.0 / k));
    let i = whole(simd, y);
    let f = simd.mul_f64s(simd.sub_f64s(y, i), simd.splat_f64s(std::f64::consts::LN_2));
    let last = and(simd, 1.0 / 720.0, f, and(simd, 1.0 / 5040.0, f, simd.splat_f64s(1.0 / 40320.0)));
    let high = and(simd, 1.0 / 24.0, f, and(simd, 1.0 / 120.0, f, last));
    [i, and(simd, 1.0, f, and(simd, 1.0, f, and(simd, 0.5, f, and(simd, 1.0 / 6.0, f, high))))]
}

/// e^y - 1 for y from 0 to where e^y comes near the ends of the numbers.
#[inline(always)]
fn expm1<S: Simd>(simd: S, y: &Lanes) -> Lanes {
    let (mut parts, mut wholes) = ([0.0; 8], [0.0; 8]);
    for p in pairs::<S>() {
        let [x, y] = at::<S>(y, p);
        let ([k, a], [l, b]) = (near_nothing(simd, x), near_nothing(simd, y));
        put::<S>(&mut parts, p, [a, b]);
        put::<S>(&mut wholes, p, [k, l]);
    }
    let [up, down] = twos(&wholes);
    let mut result = [0.0; 8];
    for p in pairs::<S>() {
        let ([a, b], [u, v], [s, t]) = (at::<S>(&parts, p), at::<S>(&down, p), at::<S>(&up, p));
        let one = simd.splat_f64s(1.0);
        // 2^k (e^r - 1 + 1 - 2^-k)
        let a = simd.mul_f64s(simd.add_f64s(a, simd.sub_f64s(one, u)), s);
        let b = simd.mul_f64s(simd.add_f64s(b, simd.sub_f64s(one, v)), t);
        put::<S>(&mut result, p, [a, b]);
    }
    result
}

/// 2^k and 2^-k of whole numbers below a thousand.
#[inline(always)]
fn twos(wholes: &Lanes) -> [Lanes; 2] {
    let (mut up, mut down) = ([0.0; 8], [0.0; 8]);
    for lane in 0..8 {
        let k = (wholes[lane] + WHOLE).to_bits();
        up[lane] = f64::from_bits(k.wrapping_add(1023) << 52);
        down[lane] = f64::from_bits(1023_u64.wrapping_sub(k) << 52);
    }
    [up, down]
}

/// Whether all lanes are below a limit in size.
#[inline(always)]
fn within(x: &Lanes, limit: f64) -> bool {
    let mut all = true;
    for x in x {
        all &= x.abs() <= limit;
    }
    all
}

/// k, and the parts of x - k ln 2.
#[inline(always)]
fn reduced<S: Simd>(simd: S, x: S::f64s) -> [S::f64s; 3] {
    let k = whole(simd, simd.mul_f64s(x, simd.splat_f64s(std::f64::consts::LOG2_E)));
    let high = simd.sub_f64s(x, simd.mul_f64s(k, simd.splat_f64s(LN_2[0])));
    [k, high, simd.mul_f64s(k, simd.splat_f64s(LN_2[1]))]
}

/// k and e^(x - k ln 2).
#[inline(always)]
fn near_one<S: Simd>(simd: S, x: S::f64s) -> [S::f64s; 2] {
    let [k, high, low] = reduced(simd, x);
    let r = simd.sub_f64s(high, low);
    let z = simd.mul_f64s(r, r);
    let p = and(simd, EXP[0], z, and(simd, EXP[1], z, and(simd, EXP[2], z, and(simd, EXP[3], z, simd.splat_f64s(EXP[4])))));
    let c = simd.sub_f64s(r, simd.mul_f64s(z, p));
    let share = simd.div_f64s(simd.mul_f64s(r, c), simd.sub_f64s(simd.splat_f64s(2.0), c));
    [k, simd.add_f64s(simd.splat_f64s(1.0), simd.add_f64s(simd.sub_f64s(share, low), high))]
}

/// k and e^(x - k ln 2) - 1.
#[inline(always)]
fn near_nothing<S: Simd>(simd: S, x: S::f64s) -> [S::f64s; 2] {
    let [k, high, low] = reduced(simd, x);
    let r = simd.sub_f64s(high, low);
    let c = simd.sub_f64s(simd.sub_f64s(high, r), low);
    let half = simd.mul_f64s(simd.splat_f64s(0.5), r);
    let z = simd.mul_f64s(r, half);
    let p = and(simd, EXPM1[0], z, and(simd, EXPM1[1], z, and(simd, EXPM1[2], z, and(simd, EXPM1[3], z, simd.splat_f64s(EXPM1[4])))));
    let first = and(simd, 1.0, z, p);
    let t = simd.sub_f64s(simd.splat_f64s(3.0), simd.mul_f64s(first, half));
    let e = simd.div_f64s(simd.sub_f64s(first, t), simd.sub_f64s(simd.splat_f64s(6.0), simd.mul_f64s(r, t)));
    let e = simd.mul_f64s(z, e);
    let e = simd.sub_f64s(simd.mul_f64s(r, simd.sub_f64s(e, c)), c);
    [k, simd.sub_f64s(r, simd.sub_f64s(e, z))]
}

/// ln m + k ln 2.
#[inline(always)]
fn logarithm<S: Simd>(simd: S, k: S::f64s, m: S::f64s) -> S::f64s {
    let f = simd.sub_f64s(m, simd.splat_f64s(1.0));
    let half = simd.mul_f64s(simd.mul_f64s(simd.splat_f64s(0.5), f), f);
    let s = simd.div_f64s(f, simd.add_f64s(simd.splat_f64s(2.0), f));
    let z = simd.mul_f64s(s, s);
    let w = simd.mul_f64s(z, z);
    let even = simd.mul_f64s(w, and(simd, LOG[1], w, and(simd, LOG[3], w, simd.splat_f64s(LOG[5]))));
    let odd = simd.mul_f64s(z, and(simd, LOG[0], w, and(simd, LOG[2], w, and(simd, LOG[4], w, simd.splat_f64s(LOG[6])))));
    let curved = simd.mul_f64s(s, simd.add_f64s(half, simd.add_f64s(odd, even)));
    let low = simd.add_f64s(curved, simd.mul_f64s(k, simd.splat_f64s(LN_2[1])));
    let near = simd.add_f64s(simd.sub_f64s(low, half), f);
    simd.add_f64s(near, simd.mul_f64s(k, simd.splat_f64s(LN_2[0])))
}

/// 2 |x|, at most where tanh is 1.
#[inline(always)]
fn limited<S: Simd>(simd: S, x: S::f64s) -> S::f64s {
    let (x, most) = (simd.abs_f64s(x), simd.splat_f64s(FLAT));
    simd.mul_f64s(simd.splat_f64s(2.0), simd.select_f64s(simd.less_than_f64s(x, most), x, most))
}

/// tanh x and 1 - tanh² x by t = e^(2|x|) - 1.
#[inline(always)]
fn saturated<S: Simd>(simd: S, x: S::f64s, t: S::f64s) -> [S::f64s; 2] {
    let (one, two) = (simd.splat_f64s(1.0), simd.splat_f64s(2.0));
    let (size, more) = (simd.abs_f64s(x), simd.add_f64s(t, two));
    let small = simd.less_than_or_equal_f64s(size, simd.splat_f64s(SMALL));
    let value = simd.div_f64s(simd.select_f64s(small, t, two), more);
    let value = simd.select_f64s(small, value, simd.sub_f64s(one, value));
    let value = simd.select_f64s(simd.less_than_f64s(x, simd.splat_f64s(0.0)), simd.neg_f64s(value), value);
    let value = simd.select_f64s(simd.equal_f64s(x, simd.splat_f64s(0.0)), x, value);
    let share = simd.div_f64s(two, more);
    let rest = simd.mul_f64s(simd.mul_f64s(share, share), simd.add_f64s(t, one));
    let seen = simd.less_than_f64s(simd.splat_f64s(f64::EPSILON), rest);
    [value, simd.select_f64s(seen, rest, simd.splat_f64s(0.0))]
}

/// sinh x and cosh x by t = e^|x| - 1.
#[inline(always)]
fn hyperbolic<S: Simd>(simd: S, x: S::f64s, t: S::f64s) -> [S::f64s; 2] {
    let (one, half) = (simd.splat_f64s(1.0), simd.splat_f64s(0.5));
    let grown = simd.add_f64s(t, one);
    let sine = simd.mul_f64s(half, simd.add_f64s(t, simd.div_f64s(t, grown)));
    let sine = simd.select_f64s(simd.less_than_f64s(x, simd.splat_f64s(0.0)), simd.neg_f64s(sine), sine);
    let sine = simd.select_f64s(simd.equal_f64s(x, simd.splat_f64s(0.0)), x, sine);
    [sine, simd.mul_f64s(half, simd.add_f64s(grown, simd.div_f64s(one, grown)))]
}

/// Lanes that are large, or no numbers.
#[inline(never)]
fn far(x: &Lanes, values: &mut Lanes, function: fn(f64) -> f64) {
    for lane in (0..8).filter(|lane| x[*lane].abs() > STEEP || x[*lane].is_nan()) {
        values[lane] = function(x[lane]);
    }
}

/// Lanes in which the logarithm has another formula, or no value.
#[inline(never)]
fn log_at_ends(x: &Lanes, values: &mut Lanes) {
    for lane in (0..8).filter(|lane| !(x[*lane] >= f64::MIN_POSITIVE && x[*lane] < f64::INFINITY)) {
        values[lane] = elementary::ln(x[lane]);
    }
}

/// What is left of 1 - tanh² far out.
fn nothing(x: f64) -> f64 {
    if x.is_nan() { x } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::super::registers::{Work, dispatch};
    use super::*;
    use crate::double::Double;

    #[derive(Clone, Copy)]
    struct All<'a>(&'a Lanes);

    impl Work for All<'_> {
        type Output = [Lanes; 6];

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> [Lanes; 6] {
            let [t, u] = tanh(simd, self.0);
            let [s, c] = sinh_cosh(simd, self.0);
            [exp(simd, self.0), log(simd, self.0), t, u, s, c]
        }
    }

    /// Difference in units of the last place of the exact number, of which one is between ε/2 and ε of it.
    fn units(own: f64, exact: Double) -> f64 {
        Double::from(own).less(exact).round().abs() / (0.5 * f64::EPSILON * exact.round().abs())
    }

    /// Against twice the digits; the bounds are units of 2^-53 of the number, half a unit of the last place at least.
    #[test]
    fn exponentials_keep_their_bounds() {
        let mut most = [0.0_f64; 6];
        for i in 0..6000 {
            let x: Lanes = std::array::from_fn(|lane| {
                let u = ((8 * i + lane) as f64 * 0.618_033_988_749_894_9).fract() * 2.0 - 1.0;
                match lane % 4 {
                    0 => u,
                    1 => 20.0 * u,
                    2 => 0.01 * u * u * u,
                    _ => 300.0 * u,
                }
            });
            let found = dispatch(All(&x));
            let bits = |all: [Lanes; 6]| all.map(|lanes| lanes.map(f64::to_bits));
            assert_eq!(bits(found), bits(All(&x).with_simd(pulp::Scalar)));
            for lane in 0..8 {
                let own = Double::from(x[lane]);
                let (sine, cosine) = own.sinh_cosh();
                let rest = Double::from(1.0).over(cosine.times(cosine));
                most[0] = most[0].max(units(found[0][lane], own.exp()));
                if x[lane] > 0.0 {
                    most[1] = most[1].max(units(found[1][lane], own.ln()));
                }
                most[2] = most[2].max(units(found[2][lane], sine.over(cosine)));
                if rest.round() > 1.01 * f64::EPSILON {
                    most[3] = most[3].max(units(found[3][lane], rest));
                } else if rest.round() < 0.99 * f64::EPSILON {
                    assert_eq!(found[3][lane], 0.0);
                }
                most[4] = most[4].max(units(found[4][lane], sine));
                most[5] = most[5].max(units(found[5][lane], cosine));
            }
        }
        // exp, ln, tanh, 1 - tanh², sinh, cosh
        let bounds = [2.0, 2.0, 5.0, 8.0, 4.0, 3.0];
        assert!(most.iter().zip(bounds).all(|(m, b)| *m <= b), "{most:?}");
    }

    struct Roots<'a>(&'a Lanes, f64);

    impl Work for Roots<'_> {
        type Output = Lanes;

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> Lanes {
            roots(simd, self.0, self.1)
        }
    }

    #[test]
    fn roots_are_those_of_the_elementary_functions() {
        for i in -100..100 {
            let x: Lanes = std::array::from_fn(|lane| 10.0_f64.powf(1.45 * f64::from(i) + 0.37 * lane as f64));
            for k in [7.0, 20.0, 26.0] {
                let found = dispatch(Roots(&x, k));
                assert_eq!(found.map(f64::to_bits), Roots(&x, k).with_simd(pulp::Scalar).map(f64::to_bits));
                for lane in 0..8 {
                    let exact = x[lane].powf(-1.0 / k);
                    // nine digits
                    assert!((found[lane] - exact).abs() <= 2e-9 * exact, "{} {k}: {} {exact}", x[lane], found[lane]);
                }
            }
        }
        let odd = dispatch(Roots(&[0.0, f64::INFINITY, 1.0, 1e-310, 1e-320, 1e308, 2.0, 0.5], 10.0));
        assert!(odd.iter().all(|r| r.is_finite()) && odd[2] == 1.0, "{odd:?}");
    }

    #[test]
    fn ends_are_those_of_the_library() {
        let odd = [0.0, -0.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 800.0, -800.0, 5e-324];
        for x in [odd, [1.0, -1.0, 700.0, -700.0, 709.7, -745.0, 1e-300, f64::MAX]] {
            let found = dispatch(All(&x));
            for lane in 0..8 {
                let v = x[lane];
                let library =
                    [elementary::exp(v), elementary::ln(v), elementary::tanh(v), f64::NAN, elementary::sinh(v), elementary::cosh(v)];
                for (i, other) in library.iter().enumerate().filter(|(i, _)| *i != 3) {
                    let own = found[i][lane];
                    let same = own.to_bits() == other.to_bits() || own.is_nan() && other.is_nan();
                    assert!(same || (own - other).abs() <= 2.0 * f64::EPSILON * other.abs(), "{i} of {v}: {own} {other}");
                    assert!(own.is_nan() || own.is_sign_negative() == other.is_sign_negative(), "{i} of {v}");
                }
            }
        }
    }
}
