//! Where everything of a static figure stands: ranges, scales, margins. Pixels grow to the right and down.

use super::field::{BAR, Key};
use super::ticks::{self, Tick};
use super::width::text_width;
use super::{Axis, Figure, Kind, Mark, Title};
use words::Language;

/// Height of text.
pub const TEXT: f64 = 12.0;
/// Height of the event strip with the space above it.
pub const STRIP: f64 = 26.0;
/// Height of a row of the legend.
pub const LEGEND_ROW: f64 = 19.0;

/// A rectangle in pixels.
#[derive(Clone, Copy, Debug)]
pub struct Area {
    pub left: f64,
    pub right: f64,
    pub top: f64,
    pub bottom: f64,
}

/// An axis laid on pixels.
#[derive(Clone, Debug)]
pub struct Ruler {
    /// Shown values at the ends.
    pub low: f64,
    pub high: f64,
    pub log: bool,
    /// SI size of the shown unit.
    size: f64,
    /// Pixels of the ends.
    from: f64,
    to: f64,
    pub ticks: Vec<Tick>,
}

impl Ruler {
    /// Pixel of an SI value; none if it has no place.
    pub fn pixel(&self, si: f64) -> Option<f64> {
        self.pixel_of_shown(si / self.size)
    }

    /// Pixel of a shown value.
    pub fn pixel_of_shown(&self, v: f64) -> Option<f64> {
        let part = if self.log { (v / self.low).ln() / (self.high / self.low).ln() } else { (v - self.low) / (self.high - self.low) };
        // far outside the frame renderers lose precision: what is cut anyway is cut here
        part.is_finite().then(|| self.from + part.clamp(-3.0, 4.0) * (self.to - self.from))
    }
}

/// A figure laid out.
#[derive(Clone, Debug)]
pub struct Layout {
    pub width: f64,
    pub height: f64,
    /// The data area.
    pub area: Area,
    pub x: Ruler,
    pub y: Ruler,
    /// Top of the legend.
    pub legend: f64,
    /// Row and left edge of each legend entry.
    pub entries: Vec<(usize, f64)>,
    /// Whether there is anything to draw.
    pub empty: bool,
}

/// Lays a figure out, with room for a title above.
pub fn lay(figure: &Figure, title: Title, language: Language) -> Layout {
    let plane = matches!(figure.kind, Kind::Plane { .. });
    let (width, data_height) = if plane { (560.0, 400.0) } else { (720.0, 220.0) };
    let ranges = (range(figure, Direction::X), range(figure, Direction::Y));
    let empty = ranges.0.is_none() || ranges.1.is_none();
    let (mut x_range, mut y_range) = (ranges.0.unwrap_or((0.0, 1.0)), ranges.1.unwrap_or((0.0, 1.0)));
    let y_ticks = axis_ticks(&figure.y, y_range, if plane { 9 } else { 7 }, language);
    let left = 18.0 + y_ticks.iter().map(|t| text_width(&t.label, TEXT)).fold(24.0, f64::max);
    let (entries, rows) = legend_entries(figure, left, width, language);
    let bar = if figure.field.as_ref().is_some_and(|field| matches!(field.key, Key::Scale(..))) { BAR } else { 0.0 };
    let legend = title.room();
    let top = legend + rows as f64 * LEGEND_ROW + 26.0;
    let area = Area { left, right: width - 22.0 - bar, top, bottom: top + data_height };
    if figure.kind == (Kind::Plane { equal: true }) {
        equalize(&mut x_range, &mut y_range, (area.right - area.left) / data_height);
    }
    let strip = if figure.strip.is_empty() { 0.0 } else { STRIP };
    let x_ticks = axis_ticks(&figure.x, x_range, if plane { 6 } else { 8 }, language);
    let y_ticks = axis_ticks(&figure.y, y_range, if plane { 9 } else { 7 }, language);
    let ruler =
        |axis: &Axis, r: (f64, f64), from, to, ticks| Ruler { low: r.0, high: r.1, log: axis.log, size: axis.scale.size, from, to, ticks };
    Layout {
        width,
        height: area.bottom + strip + 42.0,
        area,
        x: ruler(&figure.x, x_range, area.left, area.right, x_ticks),
        y: ruler(&figure.y, y_range, area.bottom, area.top, y_ticks),
        legend,
        entries,
        empty,
    }
}

fn axis_ticks(axis: &Axis, (low, high): (f64, f64), wanted: usize, language: Language) -> Vec<Tick> {
    if axis.log { ticks::logarithmic(low, high, wanted, language) } else { ticks::linear(low, high, wanted, language) }
}

/// A direction of the plane of a figure.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    X,
    Y,
}

/// Range of the shown values of one direction, with room above and below; none without finite values.
pub fn range(figure: &Figure, direction: Direction) -> Option<(f64, f64)> {
    let of_x = direction == Direction::X;
    let axis = if of_x { &figure.x } else { &figure.y };
    if let Some(field) = &figure.field {
        let [low, high] = field.ends[usize::from(!of_x)].map(|v| v / axis.scale.size);
        return (low < high).then_some((low, high));
    }
    let values = figure.series.iter().flat_map(|s| if of_x { &s.x } else { &s.y });
    let marked = figure.marks.iter().filter_map(|m| match m {
        Mark::Point { x, y, .. } => Some(if of_x { x } else { y }),
        Mark::Vertical { x, .. } if of_x => Some(x),
        Mark::Horizontal { y, .. } if !of_x => Some(y),
        _ => None,
    });
    let shown = values.chain(marked).map(|v| v / axis.scale.size).filter(|v| v.is_finite() && (!axis.log || *v > 0.0));
    let (low, high) = shown.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    if low > high || !(high - low).is_finite() {
        return None;
    }
    let tight = of_x && figure.kind == Kind::Curves;
    if axis.log {
        let flat = high / low < 1.01;
        return Some(match (flat, tight) {
            (true, _) => (low / 2.0, high * 2.0),
            (false, true) => (low, high),
            (false, false) => (low / (high / low).powf(0.05), high * (high / low).powf(0.05)),
        });
    }
    // rounding noise of a constant is not a shape
    if high - low <= 1e-11 * low.abs().max(high.abs()) {
        let room = if low == 0.0 && high == 0.0 { 1.0 } else { 0.1 * low.abs().max(high.abs()) };
        return Some((low - room, high + room));
    }
    let room = if tight { 0.0 } else { 0.06 * (high - low) };
    Some((low - room, high + room))
}

/// Widens one range so that units are equally long in both directions; `aspect` is width over height.
fn equalize(x: &mut (f64, f64), y: &mut (f64, f64), aspect: f64) {
    let widen = |r: &mut (f64, f64), span: f64| {
        let middle = (r.0 + r.1) / 2.0;
        *r = (middle - span / 2.0, middle + span / 2.0);
    };
    let (span_x, span_y) = (x.1 - x.0, y.1 - y.0);
    if span_x < span_y * aspect {
        widen(x, span_y * aspect);
    } else {
        widen(y, span_x / aspect);
    }
}

/// Place of each legend entry, and the number of rows; a single curve needs no legend.
fn legend_entries(figure: &Figure, left: f64, width: f64, language: Language) -> (Vec<(usize, f64)>, usize) {
    let texts: Vec<String> = match &figure.field {
        Some(field) => field.entries(language).into_iter().map(|(_, text)| text).collect(),
        None if figure.series.len() < 2 => Vec::new(),
        None => figure.series.iter().map(|series| legend_text(series, language)).collect(),
    };
    if texts.is_empty() {
        return (Vec::new(), 0);
    }
    let (mut row, mut at) = (0, left);
    let mut places = Vec::new();
    for text in &texts {
        let wide = 44.0 + text_width(text, TEXT) + 18.0;
        if at > left && at + wide > width {
            row += 1;
            at = left;
        }
        places.push((row, at));
        at += wide;
    }
    (places, row + 1)
}

/// Words of a legend entry as plain text.
pub fn legend_text(series: &super::Series, language: Language) -> String {
    let symbol = crate::symbol::plain(&series.name, language);
    if series.label.is_empty() { symbol } else { format!("{symbol} – {}", series.label) }
}
