//! No figure twice: curves that a figure before shows already, computed another way, are named and not drawn again.

use report::figure::{Figure, Kind, Series};
use words::Language;

/// Curves nearer than this share of their range are one line on paper: half a millimetre of ten centimetres.
const ONE_LINE: f64 = 0.005;

/// Whether two figures are the same to the eye.
pub(super) fn alike(a: &Figure, b: &Figure) -> bool {
    let axes = a.kind == Kind::Curves && b.kind == a.kind && a.x.symbols == b.x.symbols && a.y.symbols == b.y.symbols;
    let marks = a.marks == b.marks && a.x.log == b.x.log && a.y.log == b.y.log;
    axes && marks && a.series.len() == b.series.len() && a.series.iter().zip(&b.series).all(|(a, b)| one_line(a, b))
}

fn one_line(a: &Series, b: &Series) -> bool {
    let near = |x: f64, y: f64, range: f64| (x - y).abs() <= ONE_LINE * range;
    let ends = a.x.first().zip(b.x.first()).zip(a.x.last().zip(b.x.last()));
    let Some(((a0, b0), (a1, b1))) = ends else { return false };
    let (wide, high) = (range(&a.x), range(&a.y).max(range(&b.y)));
    a.name == b.name
        && near(*a0, *b0, wide)
        && near(*a1, *b1, wide)
        && b.x.iter().zip(&b.y).all(|(x, y)| match at(a, *x) {
            Some(own) => near(own, *y, high),
            None => y.is_nan(),
        })
}

fn range(values: &[f64]) -> f64 {
    let (low, high) = values.iter().filter(|v| v.is_finite()).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
    if high > low { high - low } else { 0.0 }
}

/// The curve at x, between its points; none in a gap.
fn at(curve: &Series, x: f64) -> Option<f64> {
    let next = curve.x.partition_point(|p| *p < x).min(curve.x.len().checked_sub(1)?);
    let before = next.saturating_sub(1);
    let ([a, b], [fa, fb]) = ([curve.x[before], curve.x[next]], [curve.y[before], curve.y[next]]);
    let share = if b > a { ((x - a) / (b - a)).clamp(0.0, 1.0) } else { 1.0 };
    let value = if share == 1.0 { fb } else { fa + share * (fb - fa) };
    value.is_finite().then_some(value)
}

/// "The curves coincide with figures 6 and 7."
pub(super) fn told(numbers: &[usize], language: Language) -> String {
    let (last, before) = match numbers.split_last() {
        Some((last, before)) => (last, before.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")),
        None => return String::new(),
    };
    match (language, before.is_empty()) {
        (Language::En, true) => format!("The curves are those of figure\u{a0}{last}."),
        (Language::En, false) => format!("The curves are those of figures\u{a0}{before} and\u{a0}{last}."),
        (Language::Ru, true) => format!("График совпадает с рисунком\u{a0}{last}."),
        (Language::Ru, false) => format!("Графики совпадают с рисунками\u{a0}{before} и\u{a0}{last}."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use analysis::dataset::Column;
    use analysis::{Dataset, Quantity};

    /// A curve of so many points, with a disturbance.
    fn figure(points: u32, off: f64) -> Figure {
        let x: Vec<f64> = (0..=points).map(|k| f64::from(k) / f64::from(points)).collect();
        let y = x.iter().map(|x| x * x + off * x).collect();
        let column = |name: &str, values| Column { quantity: Quantity::new(name, "m"), values };
        let data = Dataset { axis: Some(0), columns: vec![column("t", x), column("x", y)], ..Dataset::default() };
        Figure::over_axis(&data, &["x"], Language::En).unwrap()
    }

    #[test]
    fn curves_of_other_points_are_one_line_and_others_are_not() {
        assert!(alike(&figure(200, 0.0), &figure(333, 1e-4)));
        assert!(!alike(&figure(200, 0.0), &figure(200, 0.02)));
        let mut gap = figure(200, 0.0);
        gap.series[0].y[50] = f64::NAN;
        assert!(!alike(&gap, &figure(200, 0.0)) && !alike(&figure(200, 0.0), &gap));
    }

    #[test]
    fn figures_are_named_in_sentences() {
        assert_eq!(told(&[6], Language::Ru), "График совпадает с рисунком\u{a0}6.");
        assert_eq!(told(&[6, 7, 9], Language::En), "The curves are those of figures\u{a0}6, 7 and\u{a0}9.");
    }
}
