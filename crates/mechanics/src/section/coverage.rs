//! What covers what: strips between all heights at which outlines have corners or cross, in which every boundary is a straight line.
//! In each piece of a strip the number of parts added less those removed must be 0 or 1.

use super::part::Part;
use algebra::arrange::Arrange;

/// What the parts cover.
#[derive(Clone, Debug, Default)]
pub struct Coverage {
    /// Area taken out where there is no material, per removed part.
    pub missing: Vec<(usize, f64)>,
    /// Area that is added more than once, per later part, with the earlier one.
    pub doubled: Vec<(usize, usize, f64)>,
    /// Corners of what remains.
    pub corners: Vec<[f64; 2]>,
}

/// A side of an outline, upwards.
struct Side {
    part: usize,
    low: [f64; 2],
    high: [f64; 2],
}

impl Side {
    fn at(&self, y: f64) -> f64 {
        let share = (y - self.low[1]) / (self.high[1] - self.low[1]);
        self.low[0] + share * (self.high[0] - self.low[0])
    }
}

/// Covers the plane by the parts.
pub fn cover(parts: &[Part]) -> Coverage {
    let sides = sides(parts);
    let heights = heights(&sides, parts.len());
    let mut coverage = Coverage::default();
    let size = sides.iter().flat_map(|s| [s.low, s.high]).flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
    let (mut active, mut next): (Vec<usize>, usize) = (Vec::new(), 0);
    let mut missing = vec![0.0; parts.len()];
    let mut doubled = std::collections::BTreeMap::new();
    for pair in heights.windows(2) {
        let (low, high) = (pair[0], pair[1]);
        let middle = 0.5 * (low + high);
        while next < sides.len() && sides[next].low[1] <= middle {
            active.push(next);
            next += 1;
        }
        active.retain(|&k| sides[k].high[1] >= middle);
        let mut crossings: Vec<(f64, usize)> = active.iter().map(|&k| (sides[k].at(middle), k)).collect();
        crossings.arrange_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut inside = vec![false; parts.len()];
        for two in crossings.windows(2) {
            let part = sides[two[0].1].part;
            inside[part] = !inside[part];
            let area = (two[1].0 - two[0].0) * (high - low);
            let within =
                |removed: bool| (0..parts.len()).filter(move |&p| parts[p].removed == removed).filter(|&p| inside[p]).collect::<Vec<_>>();
            let (added, removed) = (within(false), within(true));
            match added.len() as i64 - removed.len() as i64 {
                0 => {}
                // two sides one on the other leave nothing between them
                1 if two[1].0 - two[0].0 <= 1e-9 * size => {}
                1 => {
                    let ends = two.iter().flat_map(|(_, k)| [low, high].map(|y| [sides[*k].at(y), y]));
                    coverage.corners.extend(ends);
                }
                less if less < 0 => missing[removed[removed.len() - 1]] += area,
                _ => *doubled.entry((added[added.len() - 1], added[added.len() - 2])).or_insert(0.0) += area,
            }
        }
    }
    coverage.missing = missing.into_iter().enumerate().filter(|m| m.1 > 0.0).collect();
    coverage.doubled = doubled.into_iter().map(|((later, earlier), area)| (later, earlier, area)).collect();
    coverage
}

fn sides(parts: &[Part]) -> Vec<Side> {
    let mut sides = Vec::new();
    for (part, p) in parts.iter().enumerate() {
        for contour in &p.outline.contours {
            for (k, &a) in contour.iter().enumerate() {
                let b = contour[(k + 1) % contour.len()];
                if a[1] != b[1] {
                    let (low, high) = if a[1] < b[1] { (a, b) } else { (b, a) };
                    sides.push(Side { part, low, high });
                }
            }
        }
    }
    sides.arrange_by(|a, b| a.low[1].total_cmp(&b.low[1]));
    sides
}

/// All heights of corners and crossings, ascending, without those nearer than rounding.
fn heights(sides: &[Side], parts: usize) -> Vec<f64> {
    let mut heights: Vec<f64> = sides.iter().flat_map(|s| [s.low[1], s.high[1]]).collect();
    for (k, a) in sides.iter().enumerate() {
        // sorted by their lower ends: later ones that begin above this one do not meet it
        for b in sides[k + 1..].iter().take_while(|b| b.low[1] < a.high[1]) {
            if parts > 1 && a.part == b.part {
                continue;
            }
            heights.extend(crossing(a, b));
        }
    }
    heights.sort_by(f64::total_cmp);
    let size = heights.last().unwrap_or(&0.0).abs().max(heights.first().unwrap_or(&0.0).abs());
    // a crossing is a quotient of products of coordinates: some hundred units of the last place
    heights.dedup_by(|b, a| *b - *a <= 1e-13 * size);
    heights
}

/// Height at which two sides cross inside both.
fn crossing(a: &Side, b: &Side) -> Option<f64> {
    let (low, high) = (a.low[1].max(b.low[1]), a.high[1].min(b.high[1]));
    if low >= high {
        return None;
    }
    let (below, above) = (a.at(low) - b.at(low), a.at(high) - b.at(high));
    (below * above < 0.0).then(|| low + (high - low) * below / (below - above))
}
