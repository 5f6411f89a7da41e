//! Registers: numbers of all lanes by pairs of them, and a work compiled for the instructions that the processor has; only here and in its neighbours the crate `pulp` is known.

pub use pulp::{Simd, WithSimd as Work};

/// One number of each of eight motions.
pub type Lanes = [f64; 8];

/// Runs a work with the instructions that this processor has.
pub fn dispatch<W: Work>(work: W) -> W::Output {
    pulp::Arch::new().dispatch(work)
}

/// Registers that one number of all lanes takes.
#[inline(always)]
pub(super) const fn parts<S: Simd>() -> usize {
    size_of::<Lanes>() / size_of::<S::f64s>()
}

/// Two registers of a number. Work goes by pairs: two at a time hide how long an addition takes, and AVX2 has no more of a number.
///
/// All that stands here is a function that is always inlined, no closure: what is compiled by itself has the instructions of every processor only.
pub(super) type Pair<S> = [<S as Simd>::f64s; 2];

#[inline(always)]
pub(super) fn at<S: Simd>(x: &Lanes, [p, q]: [usize; 2]) -> Pair<S> {
    let registers = S::as_simd_f64s(x).0;
    [registers[p], registers[q]]
}

#[inline(always)]
pub(super) fn put<S: Simd>(into: &mut Lanes, [p, q]: [usize; 2], value: Pair<S>) {
    let registers = S::as_mut_simd_f64s(into).0;
    (registers[p], registers[q]) = (value[0], value[1]);
}

/// The pairs of a number: one with AVX2, one register twice where it has a single one.
#[inline(always)]
pub(super) fn pairs<S: Simd>() -> impl Iterator<Item = [usize; 2]> {
    (0..parts::<S>().div_ceil(2)).map(|pair| [2 * pair, (2 * pair + 1).min(parts::<S>() - 1)])
}

#[inline(always)]
pub(super) fn splat<S: Simd>(simd: S, v: f64) -> Pair<S> {
    [simd.splat_f64s(v), simd.splat_f64s(v)]
}

#[inline(always)]
pub(super) fn add<S: Simd>(simd: S, a: Pair<S>, b: Pair<S>) -> Pair<S> {
    [simd.add_f64s(a[0], b[0]), simd.add_f64s(a[1], b[1])]
}

#[inline(always)]
pub(super) fn mul<S: Simd>(simd: S, a: Pair<S>, b: Pair<S>) -> Pair<S> {
    [simd.mul_f64s(a[0], b[0]), simd.mul_f64s(a[1], b[1])]
}

/// a + b c, rounded twice.
#[inline(always)]
pub(super) fn add_mul<S: Simd>(simd: S, a: Pair<S>, b: Pair<S>, c: Pair<S>) -> Pair<S> {
    add(simd, a, mul(simd, b, c))
}

#[inline(always)]
pub(super) fn abs<S: Simd>(simd: S, a: Pair<S>) -> Pair<S> {
    [simd.abs_f64s(a[0]), simd.abs_f64s(a[1])]
}

/// max(a, |b|), where a b that is no number counts as infinite.
#[inline(always)]
pub(super) fn larger<S: Simd>(simd: S, a: Pair<S>, b: Pair<S>) -> Pair<S> {
    [larger_of_one(simd, a[0], b[0]), larger_of_one(simd, a[1], b[1])]
}

#[inline(always)]
pub(super) fn larger_of_one<S: Simd>(simd: S, a: S::f64s, b: S::f64s) -> S::f64s {
    let b = simd.abs_f64s(b);
    // false for what is no number
    let known = simd.select_f64s(simd.less_than_or_equal_f64s(b, a), a, b);
    simd.select_f64s(simd.equal_f64s(b, b), known, simd.splat_f64s(f64::INFINITY))
}

/// a b.
#[inline(always)]
pub fn times<S: Simd>(simd: S, a: &Lanes, b: &Lanes) -> Lanes {
    let mut result = [0.0; 8];
    for p in pairs::<S>() {
        put::<S>(&mut result, p, mul(simd, at::<S>(a, p), at::<S>(b, p)));
    }
    result
}

/// Adding this leaves a whole number in the last bits.
pub(super) const WHOLE: f64 = 6_755_399_441_055_744.0;
/// a + b c of one register.
#[inline(always)]
pub(super) fn and<S: Simd>(simd: S, a: f64, b: S::f64s, c: S::f64s) -> S::f64s {
    simd.add_f64s(simd.splat_f64s(a), simd.mul_f64s(b, c))
}

#[inline(always)]
pub(super) fn whole<S: Simd>(simd: S, x: S::f64s) -> S::f64s {
    let shift = simd.splat_f64s(WHOLE);
    simd.sub_f64s(simd.add_f64s(x, shift), shift)
}
