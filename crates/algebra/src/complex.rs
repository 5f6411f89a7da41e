//! Complex numbers: the type of `num-complex`, with functions that give the same bits on every machine ([`crate::elementary`]) and quotients that do not overflow.

use crate::elementary;

/// re + i im.
pub use num_complex::Complex64 as Complex;

/// i im.
pub fn imaginary(im: f64) -> Complex {
    Complex::new(0.0, im)
}

/// Modulus.
pub fn abs(z: Complex) -> f64 {
    elementary::hypot(z.re, z.im)
}

/// Angle, -π...π.
pub fn arg(z: Complex) -> f64 {
    elementary::atan2(z.im, z.re)
}

/// e^z.
pub fn exp(z: Complex) -> Complex {
    let (size, (sine, cosine)) = (elementary::exp(z.re), elementary::sin_cos(z.im));
    Complex::new(size * cosine, size * sine)
}

/// a / b with Smith's scaling, so that squares do not overflow. *Source*: R. L. Smith, Algorithm 116: complex division, Comm. ACM 5 (1962).
pub fn over(a: Complex, b: Complex) -> Complex {
    if b.re.abs() >= b.im.abs() {
        let r = b.im / b.re;
        let d = b.re + b.im * r;
        Complex::new((a.re + a.im * r) / d, (a.im - a.re * r) / d)
    } else {
        let r = b.re / b.im;
        let d = b.re * r + b.im;
        Complex::new((a.re * r + a.im) / d, (a.im * r - a.re) / d)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_of_huge_and_tiny_numbers() {
        for size in [1e-200, 1.0, 1e200] {
            let z = over(Complex::new(2.0 * size, size), Complex::new(size, -size));
            // units of the last place
            assert!(abs(z - Complex::new(0.5, 1.5)) < 1e-15, "{z}");
        }
    }
}
