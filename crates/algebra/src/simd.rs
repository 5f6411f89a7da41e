//! Numbers of eight motions at once, in the widest registers of the processor that runs the program; only this file knows the crate `pulp`.
//!
//! [`dispatch`] looks once which instructions there are and runs a work compiled for them (AVX2, or what every processor has). Each lane sees the same products and sums in the same order
//! whatever the registers are, and there is no fused multiplication: the bits are the same on every machine. A work is an [`Work`] whose body and all that it calls is `#[inline(always)]`, as only
//! what is compiled into it gets the instructions.

mod exponentials;
mod polynomials;
mod registers;

pub use exponentials::{exp, log, roots, sinh_cosh, tanh};
pub use polynomials::{horner, horners, largest_term, way, ways, weighted};
pub use registers::{Lanes, Simd, Work, dispatch, times};
use registers::{abs, add, add_mul, and, at, larger, pairs, put, splat, whole};
/// Numbers of all lanes, each on a line of the cache of its own: a vector register never reads over the border of two.
#[derive(Debug)]
pub struct Shelf {
    numbers: Vec<f64>,
    /// Numbers before the first border.
    offset: usize,
}

impl Shelf {
    /// So many zeros.
    pub fn new(count: usize) -> Shelf {
        let numbers = vec![0.0; 8 * (count + 1)];
        let offset = (numbers.as_ptr() as usize).wrapping_neg() % size_of::<Lanes>() / size_of::<f64>();
        Shelf { numbers, offset }
    }
}

impl std::ops::Deref for Shelf {
    type Target = [Lanes];

    fn deref(&self) -> &[Lanes] {
        self.numbers[self.offset..].as_chunks().0
    }
}

impl std::ops::DerefMut for Shelf {
    fn deref_mut(&mut self) -> &mut [Lanes] {
        self.numbers[self.offset..].as_chunks_mut().0
    }
}

/// Sums that a sum of products is divided into, term i into sum i (mod 4): as many as hide that an addition takes some four cycles.
const SUMS: usize = 4;

/// Σ_i a_i b_(n-1-i), n the length of both.
#[inline(always)]
pub fn cauchy<S: Simd>(simd: S, a: &[Lanes], b: &[Lanes]) -> Lanes {
    let mut result = [0.0; 8];
    let ((a4, a), (b, b4)) = (a.as_chunks::<SUMS>(), b.as_rchunks::<SUMS>());
    for p in pairs::<S>() {
        let [mut s0, mut s1, mut s2, mut s3] = [splat(simd, 0.0); SUMS];
        for ([x0, x1, x2, x3], [y3, y2, y1, y0]) in a4.iter().zip(b4.iter().rev()) {
            s0 = add_mul(simd, s0, at::<S>(x0, p), at::<S>(y0, p));
            s1 = add_mul(simd, s1, at::<S>(x1, p), at::<S>(y1, p));
            s2 = add_mul(simd, s2, at::<S>(x2, p), at::<S>(y2, p));
            s3 = add_mul(simd, s3, at::<S>(x3, p), at::<S>(y3, p));
        }
        if let ([x0, ..], [.., y0]) = (a, b) {
            s0 = add_mul(simd, s0, at::<S>(x0, p), at::<S>(y0, p));
        }
        if let ([_, x1, ..], [.., y1, _]) = (a, b) {
            s1 = add_mul(simd, s1, at::<S>(x1, p), at::<S>(y1, p));
        }
        if let ([_, _, x2], [y2, _, _]) = (a, b) {
            s2 = add_mul(simd, s2, at::<S>(x2, p), at::<S>(y2, p));
        }
        put::<S>(&mut result, p, add(simd, add(simd, s0, s2), add(simd, s1, s3)));
    }
    result
}

/// [`cauchy`] of one run with two, by two sums each.
#[inline(always)]
pub fn cauchys<S: Simd>(simd: S, a: &[Lanes], [b, c]: [&[Lanes]; 2]) -> [Lanes; 2] {
    let (mut first, mut second) = ([0.0; 8], [0.0; 8]);
    let ((a2, a), (b, b2), (c, c2)) = (a.as_chunks::<2>(), b.as_rchunks::<2>(), c.as_rchunks::<2>());
    for p in pairs::<S>() {
        let [mut b0, mut b1, mut c0, mut c1] = [splat(simd, 0.0); 4];
        for (([x0, x1], [y1, y0]), [z1, z0]) in a2.iter().zip(b2.iter().rev()).zip(c2.iter().rev()) {
            let (x0, x1) = (at::<S>(x0, p), at::<S>(x1, p));
            b0 = add_mul(simd, b0, x0, at::<S>(y0, p));
            c0 = add_mul(simd, c0, x0, at::<S>(z0, p));
            b1 = add_mul(simd, b1, x1, at::<S>(y1, p));
            c1 = add_mul(simd, c1, x1, at::<S>(z1, p));
        }
        if let ([x], [y], [z]) = (a, b, c) {
            let x = at::<S>(x, p);
            b0 = add_mul(simd, b0, x, at::<S>(y, p));
            c0 = add_mul(simd, c0, x, at::<S>(z, p));
        }
        put::<S>(&mut first, p, add(simd, b0, b1));
        put::<S>(&mut second, p, add(simd, c0, c1));
    }
    [first, second]
}

/// Σ_i a_i a_(n-1-i): each product of two different terms once.
#[inline(always)]
pub fn squared<S: Simd>(simd: S, a: &[Lanes]) -> Lanes {
    let half = a.len() / 2;
    let twice = scaled(simd, 2.0, &cauchy(simd, &a[..half], &a[a.len() - half..]));
    if a.len().is_multiple_of(2) { twice } else { plus_product(simd, &twice, &a[half], &a[half]) }
}

/// max(a, |b|), where a b that is no number counts as infinite.
#[inline(always)]
pub fn largest<S: Simd>(simd: S, a: &Lanes, b: &Lanes) -> Lanes {
    let mut result = [0.0; 8];
    for p in pairs::<S>() {
        put::<S>(&mut result, p, larger(simd, at::<S>(a, p), at::<S>(b, p)));
    }
    result
}

/// |a|.
#[inline(always)]
pub fn size<S: Simd>(simd: S, a: &Lanes) -> Lanes {
    let mut result = [0.0; 8];
    for p in pairs::<S>() {
        put::<S>(&mut result, p, abs(simd, at::<S>(a, p)));
    }
    result
}

/// 1 where a ≤ b, else 0, also where one of them is no number.
#[inline(always)]
pub fn at_most<S: Simd>(simd: S, a: &Lanes, b: &Lanes) -> Lanes {
    let mut result = [0.0; 8];
    let (one, zero) = (simd.splat_f64s(1.0), simd.splat_f64s(0.0));
    for p in pairs::<S>() {
        let (a, b) = (at::<S>(a, p), at::<S>(b, p));
        let lower = [simd.less_than_or_equal_f64s(a[0], b[0]), simd.less_than_or_equal_f64s(a[1], b[1])];
        put::<S>(&mut result, p, [simd.select_f64s(lower[0], one, zero), simd.select_f64s(lower[1], one, zero)]);
    }
    result
}

/// a - b.
#[inline(always)]
pub fn less<S: Simd>(simd: S, a: &Lanes, b: &Lanes) -> Lanes {
    let mut result = [0.0; 8];
    for p in pairs::<S>() {
        let (a, b) = (at::<S>(a, p), at::<S>(b, p));
        put::<S>(&mut result, p, [simd.sub_f64s(a[0], b[0]), simd.sub_f64s(a[1], b[1])]);
    }
    result
}

/// a + b.
#[inline(always)]
pub fn plus<S: Simd>(simd: S, a: &Lanes, b: &Lanes) -> Lanes {
    let mut result = [0.0; 8];
    for p in pairs::<S>() {
        put::<S>(&mut result, p, add(simd, at::<S>(a, p), at::<S>(b, p)));
    }
    result
}

/// a / b.
#[inline(always)]
pub fn over<S: Simd>(simd: S, a: &Lanes, b: &Lanes) -> Lanes {
    let mut result = [0.0; 8];
    for p in pairs::<S>() {
        let (a, b) = (at::<S>(a, p), at::<S>(b, p));
        put::<S>(&mut result, p, [simd.div_f64s(a[0], b[0]), simd.div_f64s(a[1], b[1])]);
    }
    result
}

/// √a.
#[inline(always)]
pub fn root<S: Simd>(simd: S, a: &Lanes) -> Lanes {
    let mut result = [0.0; 8];
    for p in pairs::<S>() {
        let a = at::<S>(a, p);
        put::<S>(&mut result, p, [simd.sqrt_f64s(a[0]), simd.sqrt_f64s(a[1])]);
    }
    result
}

/// a + b c, rounded twice.
#[inline(always)]
pub fn plus_product<S: Simd>(simd: S, a: &Lanes, b: &Lanes, c: &Lanes) -> Lanes {
    let mut result = [0.0; 8];
    for p in pairs::<S>() {
        put::<S>(&mut result, p, add_mul(simd, at::<S>(a, p), at::<S>(b, p), at::<S>(c, p)));
    }
    result
}

/// s a.
#[inline(always)]
pub fn scaled<S: Simd>(simd: S, s: f64, a: &Lanes) -> Lanes {
    times(simd, &[s; 8], a)
}

/// Beyond this an angle has too many quarter turns for the reduction below, and the library's is taken.
const FAR: f64 = 1e5;
/// π/2 in parts of 33 bits, and what is left.
const QUARTER: [f64; 3] = [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];
const SINE: [f64; 6] = [
    -0.166_666_666_666_666_32,
    0.008_333_333_333_322_49,
    -0.000_198_412_698_298_579_5,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];
const COSINE: [f64; 6] = [
    0.041_666_666_666_666_6,
    -0.001_388_888_888_887_411,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// (sin x, cos x), to one unit of the last place; without a branch up to angles of 1e5.
///
/// *Source*: the reduction and the polynomials of FreeBSD's msun (`e_rem_pio2`, `k_sin`, `k_cos`), with two steps of the reduction everywhere.
#[inline(always)]
pub fn sin_cos<S: Simd>(simd: S, x: &Lanes) -> [Lanes; 2] {
    let (mut sines, mut cosines) = ([0.0; 8], [0.0; 8]);
    for p in pairs::<S>() {
        let [x, y] = at::<S>(x, p);
        let ((s0, c0), (s1, c1)) = (near(simd, x), near(simd, y));
        put::<S>(&mut sines, p, [s0, s1]);
        put::<S>(&mut cosines, p, [c0, c1]);
    }
    if !x.iter().all(|x| x.abs() < FAR) {
        far(x, &mut sines, &mut cosines);
    }
    [sines, cosines]
}

/// Lanes whose angles have too many turns, or are none.
#[inline(never)]
fn far(x: &Lanes, sines: &mut Lanes, cosines: &mut Lanes) {
    for lane in (0..8).filter(|lane| x[*lane].abs() >= FAR || x[*lane].is_nan()) {
        (sines[lane], cosines[lane]) = crate::elementary::sin_cos(x[lane]);
    }
}

/// Sine and cosine of y + rest, |y| up to π/4.
#[inline(always)]
fn kernel<S: Simd>(simd: S, y: S::f64s, rest: S::f64s) -> [S::f64s; 2] {
    let (one, half) = (simd.splat_f64s(1.0), simd.splat_f64s(0.5));
    let z = simd.mul_f64s(y, y);
    let square = simd.mul_f64s(z, z);
    let low = and(simd, SINE[1], z, and(simd, SINE[2], z, simd.splat_f64s(SINE[3])));
    let high = and(simd, SINE[4], z, simd.splat_f64s(SINE[5]));
    let p = simd.add_f64s(low, simd.mul_f64s(simd.mul_f64s(z, square), high));
    let v = simd.mul_f64s(z, y);
    let inner = simd.sub_f64s(simd.mul_f64s(half, rest), simd.mul_f64s(v, p));
    let cut = simd.sub_f64s(simd.sub_f64s(simd.mul_f64s(z, inner), rest), simd.mul_f64s(v, simd.splat_f64s(SINE[0])));
    let sine = simd.sub_f64s(y, cut);
    let low = simd.mul_f64s(z, and(simd, COSINE[0], z, and(simd, COSINE[1], z, simd.splat_f64s(COSINE[2]))));
    let high = and(simd, COSINE[3], z, and(simd, COSINE[4], z, simd.splat_f64s(COSINE[5])));
    let p = simd.add_f64s(low, simd.mul_f64s(simd.mul_f64s(square, square), high));
    let first = simd.mul_f64s(half, z);
    let most = simd.sub_f64s(one, first);
    let lost = simd.sub_f64s(simd.sub_f64s(one, most), first);
    let further = simd.sub_f64s(simd.mul_f64s(z, p), simd.mul_f64s(y, rest));
    [sine, simd.add_f64s(most, simd.add_f64s(lost, further))]
}

#[inline(always)]
fn near<S: Simd>(simd: S, x: S::f64s) -> (S::f64s, S::f64s) {
    let n = whole(simd, simd.mul_f64s(x, simd.splat_f64s(std::f64::consts::FRAC_2_PI)));
    // x - n π/2 = y + rest; the first product is exact
    let first = simd.sub_f64s(x, simd.mul_f64s(n, simd.splat_f64s(QUARTER[0])));
    let second = simd.mul_f64s(n, simd.splat_f64s(QUARTER[1]));
    let r = simd.sub_f64s(first, second);
    let w = simd.sub_f64s(simd.mul_f64s(n, simd.splat_f64s(QUARTER[2])), simd.sub_f64s(simd.sub_f64s(first, r), second));
    let y = simd.sub_f64s(r, w);
    let rest = simd.sub_f64s(simd.sub_f64s(r, y), w);
    let [sine, cosine] = kernel(simd, y, rest);
    // quarter turns, -2 to 2: odd ones exchange the two; sines change their sign from half a turn on, cosines behind the first quarter and at half a turn
    let fours = simd.mul_f64s(simd.splat_f64s(4.0), whole(simd, simd.mul_f64s(simd.splat_f64s(0.25), n)));
    let quarters = simd.sub_f64s(n, fours);
    let odd = simd.equal_f64s(simd.abs_f64s(quarters), simd.splat_f64s(1.0));
    let half_turn = simd.equal_f64s(simd.abs_f64s(quarters), simd.splat_f64s(2.0));
    let (s, c) = (simd.select_f64s(odd, cosine, sine), simd.select_f64s(odd, sine, cosine));
    let lower = simd.or_m64s(half_turn, simd.equal_f64s(quarters, simd.splat_f64s(-1.0)));
    let left = simd.or_m64s(half_turn, simd.equal_f64s(quarters, simd.splat_f64s(1.0)));
    (simd.select_f64s(lower, simd.neg_f64s(s), s), simd.select_f64s(left, simd.neg_f64s(c), c))
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Kernels<'a>(&'a [Lanes], &'a [Lanes], &'a [Lanes]);

    impl Work for Kernels<'_> {
        type Output = Vec<[u64; 8]>;

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
            let Kernels(a, b, c) = self;
            let [first, second] = cauchys(simd, a, [b, c]);
            let [value, slope] = horner(simd, a, &b[0]);
            let terms = largest_term(simd, a, b);
            let weights: Vec<[f64; 4]> = c.iter().map(|c| [c[0], c[1], c[2], c[3]]).collect();
            let four = weighted(simd, a, &weights);
            let (pair, both) = (horners(simd, [b, a], &b[0]), ways(simd, [c, a], &b[0]));
            [
                cauchy(simd, a, b),
                first,
                second,
                squared(simd, a),
                value,
                slope,
                four[1],
                way(simd, a, &b[0]),
                terms,
                pair[1][0],
                pair[1][1],
                both[1],
            ]
            .map(|lanes| lanes.map(f64::to_bits))
            .to_vec()
        }
    }

    fn numbers(seed: f64, count: usize) -> Vec<Lanes> {
        let mut n = seed;
        let mut next = || {
            n += 1.0;
            2.0 * (n * 0.754_877_666_246_692_7_f64).fract() - 1.0
        };
        (0..count).map(|_| std::array::from_fn(|_| next())).collect()
    }

    /// Every instruction set gives the same bits, and they are those of the sums as they are written.
    #[test]
    fn registers_do_not_change_the_bits() {
        for count in 1..30 {
            let (a, b, c) = (numbers(0.3, count), numbers(7.1, count), numbers(0.9, count));
            let wide = dispatch(Kernels(&a, &b, &c));
            assert_eq!(wide, Kernels(&a, &b, &c).with_simd(pulp::Scalar), "{count}");
            for lane in 0..8 {
                let product = |a: &[Lanes], b: &[Lanes]| -> f64 { (0..count).map(|i| a[i][lane] * b[count - 1 - i][lane]).sum() };
                // numbers up to 1: units of the last place of each of so many terms
                let near = |bits: u64, exact: f64| (f64::from_bits(bits) - exact).abs() <= 16.0 * f64::EPSILON * count as f64;
                assert!(near(wide[0][lane], product(&a, &b)) && near(wide[1][lane], product(&a, &b)));
                assert!(near(wide[2][lane], product(&a, &c)) && near(wide[3][lane], product(&a, &a)));
                let sum = |of: &dyn Fn(f64) -> f64, tau: f64| (0..count).map(|k| of(a[k][lane]) * tau.powi(k as i32)).sum::<f64>();
                let tau = b[0][lane];
                assert!(near(wide[4][lane], sum(&|c| c, tau)));
                assert!(near(wide[6][lane], (0..count).map(|k| a[k][lane] * c[k][1]).sum()));
                // two rows at a time have the sums of each
                assert_eq!([wide[9][lane], wide[10][lane], wide[11][lane]], [wide[4][lane], wide[5][lane], wide[7][lane]]);
                assert!(near(wide[7][lane], tau * sum(&f64::abs, tau)));
                let largest = (0..count).fold(0.0_f64, |m, k| m.max(a[k][lane].abs() * b[k][lane]));
                assert!(near(wide[8][lane], largest));
            }
        }
    }

    struct Circle<'a>(&'a Lanes);

    impl Work for Circle<'_> {
        type Output = [Lanes; 2];

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> [Lanes; 2] {
            sin_cos(simd, self.0)
        }
    }

    /// Against the library, which is within one unit itself.
    #[test]
    fn sines_and_cosines_are_those_of_the_library_to_a_unit() {
        let mut largest = 0.0_f64;
        for i in 0..40_000 {
            let x: Lanes = std::array::from_fn(|lane| {
                let u = ((8 * i + lane) as f64 * 0.618_033_988_749_894_9).fract() * 2.0 - 1.0;
                // of all sizes, and close to quarter turns
                match lane % 4 {
                    0 => u,
                    1 => 30.0 * u,
                    2 => 1.2e5 * u,
                    _ => ((i % 200) as f64 - 100.0) * std::f64::consts::FRAC_PI_2 + 1e-6 * u * u * u,
                }
            });
            let [s, c] = dispatch(Circle(&x));
            assert_eq!([s, c].map(|l| l.map(f64::to_bits)), Circle(&x).with_simd(pulp::Scalar).map(|l| l.map(f64::to_bits)));
            for lane in 0..8 {
                let (sine, cosine) = crate::elementary::sin_cos(x[lane]);
                for (own, other) in [(s[lane], sine), (c[lane], cosine)] {
                    largest = largest.max((own - other).abs() / (f64::EPSILON * other.abs()));
                }
            }
        }
        // a unit is between ε/2 and ε of the number
        assert!(largest <= 1.0, "{largest}");
        let odd = [0.0, -0.0, f64::INFINITY, f64::NAN, 1e300, 1e-300, 5e-324, -1e5];
        let [s, c] = dispatch(Circle(&odd));
        for lane in 0..8 {
            let (sine, cosine) = crate::elementary::sin_cos(odd[lane]);
            let same = |a: f64, b: f64| a == b || a.is_nan() && b.is_nan();
            assert!(same(s[lane], sine) && same(c[lane], cosine), "{}: {} {}", odd[lane], s[lane], c[lane]);
        }
    }
}
