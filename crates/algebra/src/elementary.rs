//! Elementary functions that give the same bits on every machine.
//!
//! std hands them to the library of the platform, which takes the variant that suits the processor (with fused multiplications or without): the last digit changes
//! from machine to machine, and a motion with switches may then take another step. The crate `libm` is one source for all, made of operations that are rounded
//! correctly everywhere; errors stay below one unit of the last place. `sqrt`, `abs`, `floor` and the four operations are exact in std and are used from there.
//! *Source* of the methods: FreeBSD's msun, by way of musl.

/// sin x.
#[inline]
pub fn sin(x: f64) -> f64 {
    libm::sin(x)
}

/// cos x.
#[inline]
pub fn cos(x: f64) -> f64 {
    libm::cos(x)
}

/// (sin x, cos x) by one reduction of the argument; the same bits as [`sin`] and [`cos`].
#[inline]
pub fn sin_cos(x: f64) -> (f64, f64) {
    libm::sincos(x)
}

/// tan x.
#[inline]
pub fn tan(x: f64) -> f64 {
    libm::tan(x)
}

/// arcsin x, NaN outside -1...1.
#[inline]
pub fn asin(x: f64) -> f64 {
    libm::asin(x)
}

/// arccos x, NaN outside -1...1.
#[inline]
pub fn acos(x: f64) -> f64 {
    libm::acos(x)
}

/// arctan x.
#[inline]
pub fn atan(x: f64) -> f64 {
    libm::atan(x)
}

/// Angle of the point (x, y), -π...π.
#[inline]
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// e^x.
#[inline]
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// 2^x.
#[inline]
pub fn exp2(x: f64) -> f64 {
    libm::exp2(x)
}

/// e^x - 1 without cancellation at 0.
#[inline]
pub fn exp_m1(x: f64) -> f64 {
    libm::expm1(x)
}

/// Natural logarithm, NaN below 0.
#[inline]
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// ln(1 + x) without cancellation at 0.
#[inline]
pub fn ln_1p(x: f64) -> f64 {
    libm::log1p(x)
}

/// Logarithm to the base 2.
#[inline]
pub fn log2(x: f64) -> f64 {
    libm::log2(x)
}

/// Logarithm to the base 10.
#[inline]
pub fn log10(x: f64) -> f64 {
    libm::log10(x)
}

/// x^p, NaN for negative x unless p is whole.
#[inline]
pub fn pow(x: f64, p: f64) -> f64 {
    libm::pow(x, p)
}

/// x^n by squaring: products in one order everywhere.
#[inline]
pub fn powi(x: f64, n: i32) -> f64 {
    let (mut left, mut square, mut power) = (n.unsigned_abs(), x, 1.0);
    loop {
        if left & 1 == 1 {
            power *= square;
        }
        left >>= 1;
        if left == 0 {
            break;
        }
        square *= square;
    }
    if n < 0 { 1.0 / power } else { power }
}

/// sinh x.
#[inline]
pub fn sinh(x: f64) -> f64 {
    libm::sinh(x)
}

/// cosh x.
#[inline]
pub fn cosh(x: f64) -> f64 {
    libm::cosh(x)
}

/// tanh x.
#[inline]
pub fn tanh(x: f64) -> f64 {
    libm::tanh(x)
}

/// arsinh x.
#[inline]
pub fn asinh(x: f64) -> f64 {
    libm::asinh(x)
}

/// arcosh x, NaN below 1.
#[inline]
pub fn acosh(x: f64) -> f64 {
    libm::acosh(x)
}

/// artanh x, NaN outside -1...1.
#[inline]
pub fn atanh(x: f64) -> f64 {
    libm::atanh(x)
}

/// √(x² + y²) without overflow.
#[inline]
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

/// Cube root.
#[inline]
pub fn cbrt(x: f64) -> f64 {
    libm::cbrt(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nearest numbers to 40-digit values of mpmath, one unit of the last place is allowed.
    #[test]
    fn values_to_the_last_place() {
        let near = |got: f64, want: f64| assert!((got - want).abs() <= f64::EPSILON * want.abs(), "{got:?} instead of {want:?}");
        near(sin(0.7), 0.644_217_687_237_691);
        near(cos(0.7), 0.764_842_187_284_488_5);
        near(sin(1e10), -0.487_506_025_087_510_7);
        near(tan(1.5), 14.101_419_947_171_719);
        near(exp(-3.3), 0.036_883_167_401_240_015);
        near(ln(7.5), 2.014_903_020_542_264_7);
        near(pow(1.7, 2.3), 3.388_695_291_147_646);
        near(tanh(0.3), 0.291_312_612_451_590_9);
        near(cosh(2.5), 6.132_289_479_663_686);
        near(asin(0.3), 0.304_692_654_015_397_5);
        near(atan2(-1.0, -2.0), -2.677_945_044_588_987);
        near(powi(1.1, -7), 0.513_158_118_230_706_5);
    }

    /// Bits that this machine must share with all others.
    #[test]
    fn bits_are_those_of_every_machine() {
        let mut sum = 0_u64;
        for k in 0..1000 {
            let x = 0.013 * f64::from(k) + 0.001;
            let (s, c) = sin_cos(x);
            assert_eq!((s.to_bits(), c.to_bits()), (sin(x).to_bits(), cos(x).to_bits()));
            for value in [s, c, tan(x), exp(-x), ln(x), pow(x, 1.7), tanh(x), sinh(x), cosh(x), atan(x), asinh(x), hypot(x, 1.0), cbrt(x)] {
                sum = sum.rotate_left(5) ^ value.to_bits();
            }
        }
        assert_eq!(sum, BITS, "{sum:#x}");
    }

    const BITS: u64 = 0x471e_1099_f32e_182b;
}
