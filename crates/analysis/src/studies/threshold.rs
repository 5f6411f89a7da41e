//! The value of a parameter at which something changes, to a number of digits.
//!
//! What is followed is a number f(p) of a motion or of another study, less a level: the change is where it passes zero. A regime that gives way to another makes f jump; then only
//! halving is safe, a bit an evaluation. Where f comes nearer to zero as the values come nearer to each other it is continuous, and the secant of an end that stays with halved weight
//! (Illinois) closes in with fewer evaluations. Which of both holds is seen at every step and may change: a steep slope looks like a jump from afar, and a small jump like a slope.
//! The answer is always a pair of values with the change between them, never an extrapolation.
//!
//! *Source*: M. Dowell, P. Jarratt, A modified regula falsi method for computing the root of an equation, BIT 11 (1971) 168-174.

use algebra::elementary;

/// Share of the difference of both sides that is left where the values came twice as near: half of it for a straight line, all of it for a jump.
const SMOOTH: f64 = 0.8;
/// A secant that has not brought the values so much nearer in three evaluations is followed by a halving.
const SLOW: f64 = 0.25;
/// Evaluations; a bit each, 53 of them are those of a number, and a secant never needs more than three times as many.
const MOST: usize = 200;

/// A value and what is found there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// The value of the parameter.
    pub place: f64,
    /// What is followed, less its level.
    pub value: f64,
}

impl Side {
    /// Whether the number is at its level or above it.
    pub fn is_above(&self) -> bool {
        self.value >= 0.0
    }
}

/// What gives the number at a value of the parameter, less its level.
pub type Followed<'a, E> = dyn FnMut(f64) -> Result<f64, E> + 'a;

/// The unit of the last of so many digits of a value: 1e-9 for the 7 digits of 0.005235298.
pub fn unit(value: f64, digits: usize) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return 0.0;
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_possible_wrap)]
    elementary::powi(10.0, elementary::log10(value.abs()).floor() as i32 + 1 - digits as i32)
}

/// Both ends of a range and the values that divide it into so many equal parts.
///
/// # Errors
/// That of a value.
pub fn scan<E>(f: &mut Followed<'_, E>, [from, to]: [f64; 2], parts: usize) -> Result<Vec<Side>, E> {
    let place = |k: usize| if k == parts { to } else { from + (to - from) * (k as f64 / parts as f64) };
    (0..=parts).map(|k| Ok(Side { place: place(k), value: f(place(k))? })).collect()
}

/// Neighbours between which the number passes its level.
pub fn changes(sides: &[Side]) -> Vec<[Side; 2]> {
    sides.windows(2).filter(|pair| pair[0].is_above() != pair[1].is_above()).map(|pair| [pair[0], pair[1]]).collect()
}

/// Closes in on a change between two values until they are `width` apart, which is asked anew with the values; or neighbouring numbers of the machine.
///
/// # Errors
/// That of a value.
pub fn close<E>(f: &mut Followed<'_, E>, [mut a, mut b]: [Side; 2], width: &dyn Fn(f64, f64) -> f64) -> Result<[Side; 2], E> {
    let (mut weights, mut kept, mut beside, mut smooth) = ([a.value, b.value], None, 1.0, false);
    let mut third = b.place - a.place;
    for i in 0..MOST {
        let (before, wanted) = (b.place - a.place, width(a.place, b.place));
        let middle = 0.5 * (a.place + b.place);
        if before <= wanted || middle <= a.place || middle >= b.place {
            break;
        }
        let slow = i % 3 == 2 && before > SLOW * third;
        third = if i % 3 == 2 { before } else { third };
        // what the secant leaves beside an end is half of what is wanted, so that the end is closed in
        let tick = (0.5 * wanted * beside).max(f64::EPSILON * a.place.abs().max(b.place.abs()));
        let secant = b.place - weights[1] * before / (weights[1] - weights[0]);
        let (low, high) = (a.place + tick, b.place - tick);
        let straight = smooth && !slow && !secant.is_nan() && low < high;
        let c = if straight { secant.clamp(low, high) } else { middle };
        beside *= if straight && (c == low || c == high) { 2.0 } else { 1.0 };
        let found = Side { place: c, value: f(c)? };
        let (difference, end) = ((b.value - a.value).abs(), usize::from(found.is_above() == b.is_above()));
        *(if end == 1 { &mut b } else { &mut a }) = found;
        weights[end] = found.value;
        weights[1 - end] *= if straight && kept == Some(1 - end) { 0.5 } else { 1.0 };
        if !straight {
            // after a halving both ends count as they are
            weights = [a.value, b.value];
            smooth = (b.value - a.value).abs() <= SMOOTH * difference;
        }
        kept = straight.then_some(1 - end);
    }
    Ok([a, b])
}

#[cfg(test)]
mod tests {
    use super::{Side, changes, close, scan, unit};
    use std::convert::Infallible;

    /// The ends and the number of evaluations between 0 and 1.
    fn closed(f: fn(f64) -> f64, width: f64) -> ([f64; 2], usize) {
        let mut count = 0;
        let mut counted = |x: f64| -> Result<f64, Infallible> {
            count += 1;
            Ok(f(x))
        };
        let ends = [0.0, 1.0].map(|place| Side { place, value: f(place) });
        let Ok(found) = close(&mut counted, ends, &|_, _| width);
        (found.map(|side| side.place), count)
    }

    #[test]
    fn a_jump_is_halved_and_a_crossing_takes_fewer_values() {
        let jump = |x: f64| if x < 0.3 { 98.5 + x } else { -2.5 - 7.0 * x };
        let ([a, b], count) = closed(jump, 1e-10);
        // the width that was asked for
        assert!(a < 0.3 && 0.3 <= b && b - a <= 1e-10);
        // 2^-34 is less than the width: a bit each, and no more than a handful of secants that led nowhere
        assert!((34..=38).contains(&count), "{count}");
        for (f, root) in
            [((|x: f64| x * x * x - 0.2) as fn(f64) -> f64, 0.2_f64.cbrt()), (|x| (9.0 * (x - 0.71)).tanh(), 0.71), (|x| 0.4 - x, 0.4)]
        {
            let ([a, b], count) = closed(f, 1e-12);
            // the width that was asked for, and the last places of the roots
            assert!(a <= root + 1e-15 && root - 1e-15 <= b && b - a <= 1e-12, "{a} {root} {b}");
            assert!(count <= 16, "{count} for {root}");
        }
    }

    #[test]
    fn a_jump_within_a_slope_and_a_flat_root_are_closed_in() {
        let ([a, b], _) = closed(|x| if x < 0.62 { x - 0.7 } else { x }, 1e-9);
        // the width that was asked for
        assert!(a < 0.62 && 0.62 <= b && b - a <= 1e-9);
        let ([a, b], count) = closed(|x| (x - 0.4).powi(5), 1e-9);
        // the width that was asked for
        assert!(a <= 0.4 && 0.4 <= b && b - a <= 1e-9 && count <= 90, "{a} {b} {count}");
    }

    #[test]
    fn several_changes_are_seen_and_digits_are_counted_from_the_first() {
        let Ok(sides) = scan::<Infallible>(&mut |x| Ok((x - 0.2) * (x - 0.6)), [0.0, 1.0], 8);
        let found = changes(&sides);
        assert_eq!(found.len(), 2);
        let places: Vec<[f64; 2]> = found.iter().map(|pair| pair.map(|side| side.place)).collect();
        assert_eq!(places, [[0.125, 0.25], [0.5, 0.625]]);
        for (value, digits, expected) in [(0.005_235_297_7, 8, 1e-10), (-1.5, 1, 1.0), (999.0, 3, 1.0), (1000.0, 3, 10.0)] {
            // powers of ten are products
            assert!((unit(value, digits) / expected - 1.0).abs() < 1e-12, "{value}");
        }
    }
}
