//! Complex numbers, as many operations as closed forms need.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// re + i im.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Complex {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
}

impl Complex {
    /// 0.
    pub const ZERO: Complex = Complex { re: 0.0, im: 0.0 };
    /// 1.
    pub const ONE: Complex = Complex { re: 1.0, im: 0.0 };

    /// re + i im.
    pub fn new(re: f64, im: f64) -> Complex {
        Complex { re, im }
    }
    /// A real number.
    pub fn real(re: f64) -> Complex {
        Complex { re, im: 0.0 }
    }
    /// i im.
    pub fn imaginary(im: f64) -> Complex {
        Complex { re: 0.0, im }
    }
    /// Modulus.
    pub fn abs(self) -> f64 {
        self.re.hypot(self.im)
    }
    /// Angle, -π..π.
    pub fn arg(self) -> f64 {
        self.im.atan2(self.re)
    }
    /// re - i im.
    pub fn conjugate(self) -> Complex {
        Complex::new(self.re, -self.im)
    }
    /// e^z.
    pub fn exp(self) -> Complex {
        let (size, (sine, cosine)) = (self.re.exp(), self.im.sin_cos());
        Complex::new(size * cosine, size * sine)
    }
    /// z times a real number.
    pub fn scale(self, factor: f64) -> Complex {
        Complex::new(self.re * factor, self.im * factor)
    }
    /// z^n.
    pub fn powi(self, n: u32) -> Complex {
        (0..n).fold(Complex::ONE, |p, _| p * self)
    }
}

impl Add for Complex {
    type Output = Complex;
    fn add(self, o: Complex) -> Complex {
        Complex::new(self.re + o.re, self.im + o.im)
    }
}
impl Sub for Complex {
    type Output = Complex;
    fn sub(self, o: Complex) -> Complex {
        Complex::new(self.re - o.re, self.im - o.im)
    }
}
impl Neg for Complex {
    type Output = Complex;
    fn neg(self) -> Complex {
        Complex::new(-self.re, -self.im)
    }
}
impl Mul for Complex {
    type Output = Complex;
    fn mul(self, o: Complex) -> Complex {
        Complex::new(self.re * o.re - self.im * o.im, self.re * o.im + self.im * o.re)
    }
}
impl Div for Complex {
    type Output = Complex;
    /// Smith's scaling, so that squares do not overflow.
    fn div(self, o: Complex) -> Complex {
        if o.re.abs() >= o.im.abs() {
            let r = o.im / o.re;
            let d = o.re + o.im * r;
            Complex::new((self.re + self.im * r) / d, (self.im - self.re * r) / d)
        } else {
            let r = o.re / o.im;
            let d = o.re * r + o.im;
            Complex::new((self.re * r + self.im) / d, (self.im * r - self.re) / d)
        }
    }
}
