//! When curves are shown on a logarithmic axis without being asked.

use super::Series;

/// Least ratio of the largest to the smallest value: 1.7 decades.
const SPAN: f64 = 50.0;
/// Share of points below a tenth of the largest value. A straight line from zero has 0.1, a decay over 1.7 decades 0.41.
const LOW_SHARE: f64 = 1.0 / 3.0;
/// Turning points that a curve may have and still count as a run-up or decay.
const MOST_TURNS: usize = 2;

/// Whether the curves are positive decays or growths over more than 1.7 decades; what oscillates, crosses zero or grows along a line
/// reads better on a linear axis.
pub fn wanted(series: &[Series]) -> bool {
    let values = || series.iter().flat_map(|s| &s.y).copied();
    let (low, high) = values().fold((f64::INFINITY, 0.0_f64), |(l, h), v| (l.min(v), h.max(v)));
    let n_low = values().filter(|v| *v < high / 10.0).count();
    let positive = values().all(|v| v.is_finite() && v > 0.0);
    positive && high > SPAN * low && n_low as f64 > LOW_SHARE * values().count() as f64 && series.iter().all(|s| turns(&s.y) <= MOST_TURNS)
}

/// How often the curve turns, rounding noise left out.
fn turns(y: &[f64]) -> usize {
    let mut rising = None;
    let mut turns = 0;
    for pair in y.windows(2) {
        // nine digits are more than a curve shows
        if (pair[1] - pair[0]).abs() <= 1e-9 * pair[0].abs() {
            continue;
        }
        let up = pair[1] > pair[0];
        turns += usize::from(rising.is_some_and(|r| r != up));
        rising = Some(up);
    }
    turns
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decays_are_logarithmic_and_oscillations_are_not() {
        let curve = |f: &dyn Fn(f64) -> f64| {
            let x: Vec<f64> = (0..500).map(|i| f64::from(i) * 0.01).collect();
            let y = x.iter().map(|&x| f(x)).collect();
            vec![Series { name: "y".into(), label: String::new(), x, y, pen: crate::figure::Pen::Line }]
        };
        assert!(wanted(&curve(&|x| (-x).exp())));
        assert!(wanted(&curve(&|x| (2.0 * x).exp())));
        assert!(!wanted(&curve(&|x| (-0.5 * x).exp())), "1.1 decades");
        assert!(!wanted(&curve(&|x| 1e-3 + x)), "a line");
        assert!(!wanted(&curve(&|x| (-x).exp() * (1.01 + (20.0 * x).sin()))), "oscillation");
        assert!(!wanted(&curve(&|x| (-x).exp() - 0.5)), "zero crossed");
        assert!(!wanted(&[]));
    }
}
