//! Golden section: the highest place of a function with one hump between two ends.
//!
//! Of two places inside an interval the higher one keeps its neighbours, and the interval loses what lies beyond the lower one. With both at the share g of its length from the far end,
//! g² = 1 - g, the place that is left stands where the next pair wants one of its two, so that each narrowing costs one value (J. Kiefer, Sequential minimax search for a maximum, 1953).
//! Near the top a value changes with the square of the way, so that the place has half the digits of the values, and no more is to be asked for.

use std::convert::Infallible;

/// g = (√5 - 1)/2.
pub const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// An interval with two places inside it and what was found there.
#[derive(Clone, Debug)]
pub struct Section<T> {
    /// Ends of the interval.
    pub ends: [f64; 2],
    /// The places inside, the lower first.
    pub places: [f64; 2],
    /// What was found at them.
    pub values: [T; 2],
}

impl<T> Section<T> {
    /// The first pair between two ends.
    ///
    /// *Errors:* those of `value`.
    pub fn new<E>(ends: [f64; 2], mut value: impl FnMut(f64) -> Result<T, E>) -> Result<Section<T>, E> {
        let [low, high] = ends;
        let places = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
        Ok(Section { ends, places, values: [value(places[0])?, value(places[1])?] })
    }

    /// Leaves out what lies beyond the lower place of the pair: the first is higher where it stands `above` the second.
    ///
    /// *Errors:* those of `value`.
    pub fn narrowed<E>(self, above: impl Fn(&T, &T) -> bool, mut value: impl FnMut(f64) -> Result<T, E>) -> Result<Section<T>, E> {
        let ([low, high], [first, second], [at_first, at_second]) = (self.ends, self.places, self.values);
        Ok(if above(&at_first, &at_second) {
            let next = second - GOLDEN * (second - low);
            Section { ends: [low, second], places: [next, first], values: [value(next)?, at_first] }
        } else {
            let next = first + GOLDEN * (high - first);
            Section { ends: [first, high], places: [second, next], values: [at_second, value(next)?] }
        })
    }

    /// Length of the interval.
    pub fn length(&self) -> f64 {
        self.ends[1] - self.ends[0]
    }

    /// The higher place of the pair, with what was found there.
    pub fn best(self, above: impl Fn(&T, &T) -> bool) -> (f64, T) {
        let ([first, second], [at_first, at_second]) = (self.places, self.values);
        if above(&at_first, &at_second) { (first, at_first) } else { (second, at_second) }
    }
}

/// The section about the top of a function, narrowed as long as `goes_on` says so; of equal values the first counts as higher.
pub fn narrowest(ends: [f64; 2], function: &mut dyn FnMut(f64) -> f64, goes_on: &mut dyn FnMut(&Section<f64>) -> bool) -> Section<f64> {
    let mut value = |x: f64| Ok::<f64, Infallible>(function(x));
    let Ok(mut section) = Section::new(ends, &mut value);
    while goes_on(&section) {
        let Ok(next) = section.narrowed(|a, b| a >= b, &mut value);
        section = next;
    }
    section
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Some ten units of the last place of numbers about 1.
    const ROUNDING: f64 = 2e-15;

    /// 30 narrowings cost 32 values and leave g^30 of the interval, 5.4e-7, with the top inside.
    #[test]
    fn an_interval_shrinks_by_the_golden_ratio_at_one_value_each() {
        let (mut calls, mut left) = (0, 30);
        let top = 0.3;
        let mut function = |x: f64| {
            calls += 1;
            -(x - top).abs()
        };
        let section = narrowest([-1.0, 1.0], &mut function, &mut |_| {
            left -= 1;
            left >= 0
        });
        assert_eq!(calls, 32);
        let [low, high] = section.ends;
        assert!(low <= top && top <= high);
        // each narrowing adds the rounding of a place
        let wanted = 2.0 * (0..30).fold(1.0, |share: f64, _| share * GOLDEN);
        assert!((high - low - wanted).abs() <= 30.0 * ROUNDING, "{:e} {wanted:e}", high - low);
        assert!((GOLDEN * GOLDEN + GOLDEN - 1.0).abs() <= ROUNDING);
    }

    #[test]
    fn a_value_that_fails_ends_the_search() {
        let refused = Section::new([0.0, 1.0], |x| if x > 0.5 { Err("beyond") } else { Ok(x) });
        assert_eq!(refused.unwrap_err(), "beyond");
    }
}
