//! Groups of the values of a number, when nobody has named regimes.
//!
//! The values at the coarse places are put in order. Where two neighbours are further apart than a tenth of all of them spread, and than a steady slope would leave between places three
//! cells apart, there is a gap, and its middle parts two groups. A number that changes steadily over the plane leaves no such gap; one that jumps from one regime to another does. The rule
//! needs no start and no chance.

use words::Text;
use words::digits::seven_digits;

/// Share of the spread of all values that a gap must exceed: so there are no more than ten groups.
const GAP: f64 = 0.1;
/// Cells over which a steady slope may leave a gap: the values at the corners of a plane stand alone.
const STEADY: f64 = 3.0;

/// Groups of values, parted by levels.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Groups {
    /// Levels between the groups, ascending.
    levels: Vec<f64>,
    /// Least and greatest value of each group.
    ends: Vec<[f64; 2]>,
}

impl Groups {
    /// From the values at the corners of so many cells along a side.
    pub(super) fn of(mut values: Vec<f64>, cells: u32) -> Groups {
        values.sort_unstable_by(f64::total_cmp);
        let (Some(first), Some(last)) = (values.first().copied(), values.last().copied()) else { return Groups::default() };
        let wide = GAP.max(STEADY / f64::from(cells.max(1))) * (last - first);
        let mut groups = Groups { levels: Vec::new(), ends: vec![[first, first]] };
        for pair in values.windows(2) {
            if pair[1] - pair[0] > wide {
                groups.levels.push(0.5 * (pair[0] + pair[1]));
                groups.ends.push([pair[1], pair[1]]);
            }
            if let Some(end) = groups.ends.last_mut() {
                end[1] = pair[1];
            }
        }
        groups
    }

    pub(super) fn count(&self) -> usize {
        self.levels.len() + 1
    }

    /// The group of a value.
    pub(super) fn which(&self, value: f64) -> usize {
        self.levels.iter().filter(|level| value >= **level).count()
    }

    /// A group by the values that it was found with.
    pub(super) fn name(&self, which: usize, number: &str) -> Text {
        let Some([low, high]) = self.ends.get(which) else { return Text::same(number) };
        let rounded = |v: f64| seven_digits(format!("{v:.3e}").parse().unwrap_or(v));
        let (low, high) = (rounded(*low), rounded(*high));
        if low == high {
            return Text::new(format!("{number} ≈ {}", low.en), format!("{number} ≈ {}", low.ru));
        }
        Text::new(format!("{number} {} ... {}", low.en, high.en), format!("{number} {} ... {}", low.ru, high.ru))
    }
}

#[cfg(test)]
mod tests {
    use super::Groups;

    #[test]
    fn gaps_part_groups_and_steady_values_are_one() {
        let groups = Groups::of(vec![98.0, 300.0, 0.1, 197.0, 98.9, 0.0, 199.0], 40);
        assert_eq!(groups.count(), 4);
        assert_eq!([0.05, 99.0, 210.0, 280.0].map(|v| groups.which(v)), [0, 1, 2, 3]);
        assert_eq!(groups.name(1, "v").en, "v 98 ... 98.9");
        assert_eq!(Groups::of((0..100).map(|k| f64::from(k * k)).collect(), 40).count(), 1);
        assert_eq!(Groups::of(vec![2.0; 5], 40).count(), 1);
        assert_eq!(Groups::of(Vec::new(), 40).count(), 1);
    }
}
