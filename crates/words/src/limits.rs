//! Limits that rooms who do not know each other hold and name: the reader, the command line and the integrator.

use std::ops::RangeInclusive;

/// The finest tolerance of a step, as a literal of code and of text: numbers carry 16 digits, and a step adds a few roundings to what it is compared with.
#[macro_export]
macro_rules! finest_tolerance {
    () => {
        // said at the head of the macro: some roundings of what is compared
        1e-15
    };
}

/// The coarsest: the order follows from the tolerance, and the order that would belong to a larger one has no terms left to see an event with.
#[macro_export]
macro_rules! coarsest_tolerance {
    () => {
        // said at the head of the macro: an order with terms left to see an event with
        1e-3
    };
}

/// Tolerances that a step can keep.
pub const TOLERANCES: RangeInclusive<f64> = finest_tolerance!()..=coarsest_tolerance!();

#[cfg(test)]
mod tests {
    /// Text and number are the same literal.
    #[test]
    fn limits_are_told_as_they_are() {
        let told = concat!(finest_tolerance!(), " ... ", coarsest_tolerance!());
        assert_eq!(told, "1e-15 ... 1e-3");
        assert_eq!(told, format!("{:e} ... {:e}", super::TOLERANCES.start(), super::TOLERANCES.end()));
    }
}
