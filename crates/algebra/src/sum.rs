//! Sums that keep their rounding error.

/// a + b = sum + error exactly. *Source*: D. E. Knuth, The Art of Computer Programming, vol. 2, 4.2.2, theorem B.
#[inline]
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_seen = sum - a;
    let error = (a - (sum - b_seen)) + (b - b_seen);
    (sum, error)
}

/// An instant as an unevaluated sum, so that millions of steps do not add rounding.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Instant {
    /// Nearest number.
    pub high: f64,
    /// The rest.
    pub low: f64,
}

impl Instant {
    /// A given number.
    pub fn at(t: f64) -> Instant {
        Instant { high: t, low: 0.0 }
    }
    /// This instant plus a step.
    #[inline]
    pub fn after(self, h: f64) -> Instant {
        let (sum, error) = two_sum(self.high, h);
        let (high, low) = two_sum(sum, error + self.low);
        Instant { high, low }
    }
    /// t minus this instant.
    #[inline]
    pub fn until(self, t: f64) -> f64 {
        (t - self.high) - self.low
    }
}
