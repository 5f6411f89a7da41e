//! Elementary functions in twice the digits.
//!
//! ```text
//! sin, cos, exp     the argument less a multiple of π/2 or ln 2, which are known to 48 digits, then Taylor's series
//! all inverses      the value in single digits and one step of Newton's method, which doubles them
//! ```
//!
//! *Source*: Y. Hida, X. S. Li, D. H. Bailey, Library for double-double and quad-double arithmetic (2007).

use super::Double;
use crate::elementary;

/// π/2 and ln 2 in three parts.
const QUARTER: [f64; 3] = [std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];
const LN_2: [f64; 3] = [std::f64::consts::LN_2, 2.319_046_813_846_299_6e-17, 5.707_708_438_416_212e-34];
/// Terms of the series: at π/4 and at ln 2 / 2 the next one is below 1e-32.
const TERMS: u32 = 28;
/// Arguments up to which the parts of π/2 and ln 2 hold the remainder.
const LARGEST: f64 = 1e9;
/// Below this sinh cancels in the difference of two exponentials.
const SMALL: f64 = 0.5;

/// x less k times a number of three parts.
fn less_times(x: Double, k: f64, parts: [f64; 3]) -> Double {
    parts.iter().fold(x, |rest, part| rest.add(-k, *part))
}

impl Double {
    /// π.
    pub fn pi() -> Double {
        Double { high: 2.0 * QUARTER[0], low: 2.0 * QUARTER[1] }
    }

    /// |self|.
    #[must_use]
    pub fn abs(self) -> Double {
        if self.round() < 0.0 { self.negated() } else { self }
    }

    /// self · 2^k, exactly.
    fn scaled(self, k: f64) -> Double {
        // in two steps: a power of two may overflow where the product does not
        let half = (0.5 * k).trunc();
        let (a, b) = (elementary::exp2(half), elementary::exp2(k - half));
        Double { high: self.high * a * b, low: self.low * a * b }
    }

    /// Σ over k ≡ first (mod step) of x^k/k!, with signs that change where `sign` is -1.
    fn series(self, first: u32, step: u32, sign: f64) -> Double {
        let one = Double::from(1.0);
        let by = if step == 1 { self } else { self.times(self) };
        let (mut term, mut sum) = if first == 0 { (one, one) } else { (self, self) };
        let mut k = first;
        while k + step <= TERMS {
            let divisor = (1..=step).map(|i| f64::from(k + i)).product::<f64>();
            term = term.times(by).over(Double::from(sign * divisor));
            sum = sum.sum(term);
            k += step;
        }
        sum
    }

    /// sin and cos; no numbers beyond 10⁹.
    pub fn sin_cos(self) -> (Double, Double) {
        let k = (self.round() / QUARTER[0]).round();
        if !k.is_finite() || k.abs() > LARGEST {
            return (Double::from(f64::NAN), Double::from(f64::NAN));
        }
        let x = less_times(self, k, QUARTER);
        let (s, c) = (x.series(1, 2, -1.0), x.series(0, 2, -1.0));
        match k.rem_euclid(4.0) as u8 {
            0 => (s, c),
            1 => (c, s.negated()),
            2 => (s.negated(), c.negated()),
            _ => (c.negated(), s),
        }
    }

    /// e^self.
    #[must_use]
    pub fn exp(self) -> Double {
        let k = (self.round() / LN_2[0]).round();
        if !k.is_finite() || k.abs() > LARGEST {
            return Double::from(elementary::exp(self.round()));
        }
        less_times(self, k, LN_2).series(0, 1, 1.0).scaled(k)
    }

    /// ln self.
    #[must_use]
    pub fn ln(self) -> Double {
        let near = Double::from(elementary::ln(self.round()));
        let rest = self.times(near.negated().exp()).less(Double::from(1.0));
        // ln(1 + e) = e - e²/2
        near.sum(rest).less(rest.times(rest).times(Double::from(0.5)))
    }

    /// self^exponent of a number that is not negative.
    #[must_use]
    pub fn pow(self, exponent: Double) -> Double {
        match () {
            () if self.is_zero() && exponent.round() > 0.0 => self,
            () => self.ln().times(exponent).exp(),
        }
    }

    /// The angle of the point (x, self), -π ... π.
    #[must_use]
    pub fn atan2(self, x: Double) -> Double {
        if self.is_zero() && x.is_zero() {
            return Double::default();
        }
        let near = Double::from(elementary::atan2(self.round(), x.round()));
        let (s, c) = near.sin_cos();
        let across = self.times(c).less(x.times(s));
        near.sum(across.over(x.times(c).sum(self.times(s))))
    }

    /// arctan self.
    #[must_use]
    pub fn atan(self) -> Double {
        self.atan2(Double::from(1.0))
    }

    /// √(1 - self²).
    fn beside(self) -> Double {
        let one = Double::from(1.0);
        one.less(self).times(one.sum(self)).root()
    }

    /// arcsin self.
    #[must_use]
    pub fn asin(self) -> Double {
        self.atan2(self.beside())
    }

    /// arccos self.
    #[must_use]
    pub fn acos(self) -> Double {
        self.beside().atan2(self)
    }

    /// sinh and cosh.
    pub fn sinh_cosh(self) -> (Double, Double) {
        let (up, half) = (self.exp(), Double::from(0.5));
        let down = Double::from(1.0).over(up);
        let s = if self.round().abs() < SMALL { self.series(1, 2, 1.0) } else { up.less(down).times(half) };
        (s, up.sum(down).times(half))
    }

    /// arsinh self.
    #[must_use]
    pub fn asinh(self) -> Double {
        let near = Double::from(elementary::asinh(self.round()));
        let (s, c) = near.sinh_cosh();
        near.sum(self.less(s).over(c))
    }

    /// arcosh self.
    #[must_use]
    pub fn acosh(self) -> Double {
        let near = Double::from(elementary::acosh(self.round()));
        let (s, c) = near.sinh_cosh();
        if s.is_zero() { near } else { near.sum(self.less(c).over(s)) }
    }

    /// artanh self.
    #[must_use]
    pub fn atanh(self) -> Double {
        let near = Double::from(elementary::atanh(self.round()));
        let (s, c) = near.sinh_cosh();
        near.sum(self.times(c).less(s).times(c))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 33 digits of mpmath as two numbers.
    fn near(found: Double, [high, low]: [f64; 2]) {
        let off = found.less(Double::of(high, low)).round();
        // some units of the 32nd digit
        assert!(off.abs() <= 2e-31 * high.abs(), "{found:?} instead of {high:?} + {low:?}: {off:e}");
    }

    #[test]
    fn digits_are_twice_as_many() {
        near(Double::from(0.7).sin_cos().0, [0.644217687237691, 2.8740567927338755e-18]);
        near(Double::from(0.7).sin_cos().1, [0.7648421872844885, -4.013780434022238e-17]);
        near(Double::from(-2.3).sin_cos().0, [-0.7457052121767203, -4.002747741986857e-17]);
        near(Double::from(-2.3).sin_cos().1, [-0.6662760212798241, 4.355007402796815e-17]);
        near(Double::from(100000.1).sin_cos().0, [-0.06419940098945935, -2.3116918316007342e-18]);
        near(Double::from(100000.1).sin_cos().1, [-0.9979370906588223, -4.252010560977194e-17]);
        near(Double::from(0.3).exp(), [1.3498588075760032, -9.447314673432387e-17]);
        near(Double::from(-20.7).exp(), [1.0235385977594162e-09, -6.484174939174867e-26]);
        near(Double::from(300.2).exp(), [2.372484956670759e+130, 3.398896382756561e+113]);
        near(Double::from(0.3).ln(), [-1.2039728043259361, 8.935521583403776e-17]);
        near(Double::from(7.5).ln(), [2.0149030205422647, 8.991967888489638e-17]);
        near(Double::from(1e-200).ln(), [-460.51701859880916, 2.2080942657241066e-14]);
        near(Double::from(0.3).atan(), [0.2914567944778671, -1.6448555435075034e-17]);
        near(Double::from(0.3).asinh(), [0.29567304756342244, -1.351693404864361e-17]);
        near(Double::from(0.3).sinh_cosh().0, [0.3045202934471426, 9.177343117072388e-18]);
        near(Double::from(0.3).sinh_cosh().1, [1.0453385141288605, 7.371812611119388e-18]);
        near(Double::from(-7.5).atan(), [-1.4382447944982226, 2.4930199102645656e-17]);
        near(Double::from(-7.5).asinh(), [-2.712465305184344, -5.2474044024029236e-17]);
        near(Double::from(-7.5).sinh_cosh().0, [-904.0209306858466, 3.5676140790686165e-14]);
        near(Double::from(-7.5).sinh_cosh().1, [904.0214837702167, -4.139849526572508e-14]);
        near(Double::from(0.3).asin(), [0.3046926540153975, -2.7469740051157017e-17]);
        near(Double::from(0.3).acos(), [1.2661036727794992, -7.78313736852488e-17]);
        near(Double::from(0.3).atanh(), [0.3095196042031117, 5.4139184190139844e-18]);
        near(Double::from(-0.9).asin(), [-1.1197695149986342, -4.092642558112641e-17]);
        near(Double::from(-0.9).acos(), [2.6905658417935308, 1.0215876553849407e-16]);
        near(Double::from(-0.9).atanh(), [-1.4722194895832204, 6.2981627878629994e-18]);
        near(Double::from(3.7).acosh(), [1.9826969446812033, 7.661117538781047e-17]);
        near(Double::from(-1.5).atan2(Double::from(-2.5)), [-2.601173153319209, -1.92805387078992e-17]);
        near(Double::from(1.7).pow(Double::from(2.3)), [3.388695291147646, 9.72953792654729e-18]);
    }
}
