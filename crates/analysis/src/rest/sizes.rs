//! With what coordinates compare, so that a machine of nanometres is judged like one of metres.
//!
//! ```text
//! angles, numbers          1
//! lengths and other units  the largest |q| of the same unit at the places that are compared, 1 where all are zero
//! ```

/// Coordinates by their units.
#[derive(Clone, Debug, Default)]
pub struct Sizes {
    /// Index of the unit of each coordinate; none for angles and numbers.
    units: Vec<Option<usize>>,
}

/// Share of a coordinate's size that counts beside the terms of a row themselves.
const BESIDE: f64 = 0.1;
/// Lengths up to this one, SI, are rounding and no size of anything.
const NONE: f64 = 1e-13;

/// Least size that counts for the rounding of a row, SI.
const LEAST: f64 = 1e-3;
/// A force below this share of the largest of its unit, or of those that stand beside it, is rounding: some ten units in the last place.
pub const NOISE: f64 = 1e-14;

impl Sizes {
    /// Of coordinates with these units.
    pub fn new<'u>(units: impl Iterator<Item = &'u str>) -> Sizes {
        let mut known: Vec<&str> = Vec::new();
        let index = |unit: &'u str| {
            if unit == "rad" || unit == "1" {
                return None;
            }
            let at = known.iter().position(|k| *k == unit).unwrap_or_else(|| {
                known.push(unit);
                known.len() - 1
            });
            Some(at)
        };
        Sizes { units: units.map(index).collect() }
    }

    /// The size of each coordinate at these places.
    pub fn at(&self, places: &[&[f64]]) -> Vec<f64> {
        let largest = |unit: usize| {
            let alike =
                |q: &&[f64]| self.units.iter().zip(q.iter()).filter(|(u, _)| **u == Some(unit)).map(|(_, v)| v.abs()).fold(0.0, f64::max);
            places.iter().map(alike).fold(0.0_f64, f64::max)
        };
        self.units.iter().map(|unit| unit.map_or(1.0, largest)).map(|size| if size > NONE { size } else { 1.0 }).collect()
    }

    /// What the slopes of a row make of the coordinates' sizes.
    pub fn made(&self, slopes: &[f64], q: &[f64]) -> f64 {
        slopes.iter().zip(self.at(&[q])).map(|(s, size)| s.abs() * size.max(LEAST)).sum()
    }

    /// The same, as far as it counts beside the terms of a force.
    pub fn beside(&self, slopes: &[f64], q: &[f64]) -> f64 {
        BESIDE * self.made(slopes, q)
    }

    /// Whether two places are one, up to a share of the sizes that coordinates have there and at a third one.
    pub fn same(&self, [a, b]: [&[f64]; 2], at: &[f64], share: f64) -> bool {
        let sizes = self.at(&[a, b, at]);
        let near = |((a, b), size): ((&f64, &f64), &f64)| (a - b).abs() <= share * (size + a.abs().max(b.abs()));
        a.iter().zip(b).zip(&sizes).all(near)
    }
}

#[cfg(test)]
mod tests {
    use super::Sizes;

    #[test]
    fn places_of_a_small_machine_are_told_apart() {
        let sizes = Sizes::new(["m", "rad", "m"].into_iter());
        assert_eq!(sizes.at(&[&[3e-9, 0.1, -5e-9], &[1e-9, 0.2, 0.0]]), [5e-9, 1.0, 5e-9]);
        assert_eq!(sizes.at(&[&[1e-17, 0.1, 0.0]]), [1.0, 1.0, 1.0]);
        assert!(!sizes.same([&[9e-10, 0.0, 0.0], &[8e-10, 0.0, 0.0]], &[0.0; 3], 1e-7));
        assert!(sizes.same([&[1e-17, 0.0, 0.1], &[0.0, 1e-12, 0.1]], &[0.0; 3], 1e-7));
    }
}
