//! Figures: what to draw, apart from how. Values are SI; the scale of an axis turns them into what is shown.
//!
//! A figure is over time ([`Kind::Curves`]: x grows, all curves share the zoom of the other figures of a page) or in a plane
//! ([`Kind::Plane`]: phase portraits, trajectories). [`svg::write`] draws it as a file, [`png::write`] rasterises that, and
//! [`crate::page`] makes it interactive.

mod axis;
pub mod bands;
pub mod decimate;
pub mod field;
mod layout;
mod log_axis;
pub mod png;
mod series;
pub mod svg;
pub mod ticks;
mod tiles;
pub(crate) mod width;

pub use axis::Axis;
pub use field::Field;
pub use series::{Mark, Pen, Series};

use crate::rich::{Inline, Rich};
use crate::unit::Scale;
use crate::wording::Word;
use analysis::Dataset;
use analysis::dataset::Column;
use words::Language;
use words::capital;

/// A figure.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Stem of file names and anchors.
    pub name: String,
    /// What is shown; the caption.
    pub title: Rich,
    /// Curves over a common axis, or a plane.
    pub kind: Kind,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Curves.
    pub series: Vec<Series>,
    /// Lines and points with a word beside them.
    pub marks: Vec<Mark>,
    /// For a plane: the axis of the data (time) and its value at each point, so that a page shows the same instant everywhere.
    pub along: Option<(Axis, Vec<f64>)>,
    /// What happened along x: shown as a strip under the curves.
    pub strip: Vec<Happening>,
    /// What fills a plane behind its curves.
    pub field: Option<Field>,
}

/// How x is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// x grows along each curve.
    Curves,
    /// Curves in a plane; with equal scales a circle is round.
    Plane {
        /// One unit of x is as long as one unit of y.
        equal: bool,
    },
}

/// Where the title of a drawn figure stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Title {
    /// Above the curves, inside the picture.
    Above,
    /// In a caption beside the picture, which has none itself.
    Caption,
}

impl Title {
    /// Room that the title takes at the top of the picture, and the edge without one.
    fn room(self) -> f64 {
        match self {
            Title::Above => 30.0,
            Title::Caption => 4.0,
        }
    }
}

/// Something on the event strip: an instant (`to` equals `from`) or an interval, which is also shaded behind the curves.
#[derive(Clone, Debug, PartialEq)]
pub struct Happening {
    /// Start, SI.
    pub from: f64,
    /// End, SI.
    pub to: f64,
    /// What.
    pub what: String,
}

/// Colours of Okabe and Ito (Color Universal Design, 2008), black and the pale yellow left out, in an order in which neighbours differ
/// in lightness too.
pub const COLOURS: [&str; 6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
/// Dash patterns beside the colours, so that curves differ in black and white.
pub const DASHES: [&[f64]; 6] = [&[], &[8.0, 4.0], &[2.0, 3.0], &[10.0, 3.0, 2.0, 3.0], &[14.0, 5.0], &[5.0, 2.0, 1.0, 2.0, 1.0, 2.0]];

/// Colour and dash pattern of the i-th curve; after six the colours repeat with other dashes, 36 curves in all.
pub fn style(i: usize) -> (&'static str, &'static [f64]) {
    (COLOURS[i % 6], DASHES[(i + i / 6) % 6])
}

impl Figure {
    /// Columns of a dataset over its axis, with the events of the dataset as a strip.
    /// None if the dataset has no axis or a name is not a column.
    pub fn over_axis(data: &Dataset, names: &[&str], language: Language) -> Option<Figure> {
        let axis = data.columns.get(data.axis?)?;
        let strip = data.events.iter().map(|e| Happening { from: e.t, to: e.t, what: language.text(&e.what).into() }).collect();
        let mut figure = Figure::of(axis, names, data, language)?;
        figure.strip = strip;
        figure.y.log = log_axis::wanted(&figure.series);
        Some(figure)
    }

    /// Columns of a dataset over another column: phase portraits, trajectories. Scales are equal when the units are.
    /// None if a name is not a column.
    pub fn in_plane(data: &Dataset, x: &str, names: &[&str], language: Language) -> Option<Figure> {
        let abscissa = data.column(x)?;
        let mut figure = Figure::of(abscissa, names, data, language)?;
        figure.title = against(&figure.y.symbols, &abscissa.quantity.symbol, language);
        figure.along = data.axis.and_then(|i| data.columns.get(i)).map(|c| (Axis::of_columns(&[c]), c.values.clone()));
        let lengths = |axis: &Axis| axis.scale.label == "m" || axis.scale.label.ends_with("mm") || axis.scale.label == "um";
        figure.kind = Kind::Plane { equal: lengths(&figure.x) && lengths(&figure.y) };
        if figure.kind == (Kind::Plane { equal: true }) {
            // one prefix for both, or the picture would lie about shape
            let scale = if figure.x.scale.size > figure.y.scale.size { &figure.x.scale } else { &figure.y.scale }.clone();
            figure.x.scale = scale.clone();
            figure.y.scale = scale;
        }
        Some(figure)
    }

    /// Curves in a plane with equal scales, both axes in the unit `unit` with one prefix for the largest value.
    pub fn to_scale(name: String, title: Rich, (unit, symbols): (&str, [&str; 2]), series: Vec<Series>) -> Figure {
        let values = series.iter().flat_map(|s| s.x.iter().chain(&s.y));
        let largest = values.filter(|v| v.is_finite()).fold(0.0_f64, |m, v| m.max(v.abs()));
        let axis =
            |symbol: &str| Axis { symbols: vec![symbol.into()], units: Vec::new(), scale: Scale::of_column(unit, largest), log: false };
        let [x, y] = symbols.map(axis);
        let kind = Kind::Plane { equal: true };
        Figure { name, title, kind, x, y, series, marks: Vec::new(), along: None, strip: Vec::new(), field: None }
    }

    fn of(x: &Column, names: &[&str], data: &Dataset, language: Language) -> Option<Figure> {
        let columns: Vec<&Column> = names.iter().map(|n| data.column(n)).collect::<Option<_>>()?;
        let series = columns
            .iter()
            .map(|c| Series {
                name: c.quantity.symbol.clone(),
                label: language.text(&c.quantity.label).into(),
                x: x.values.clone(),
                y: c.values.clone(),
                pen: Pen::Line,
            })
            .collect();
        let y = Axis::of_columns(&columns);
        let title = match columns.as_slice() {
            [only] if !language.text(&only.quantity.label).is_empty() => capital(language.text(&only.quantity.label)).into(),
            _ => against(&y.symbols, &x.quantity.symbol, language),
        };
        Some(Figure {
            name: crate::escape::file_name(&names.join("-").replace('\'', "_rate")),
            title,
            kind: Kind::Curves,
            x: Axis::of_columns(&[x]),
            y,
            series,
            marks: Vec::new(),
            along: None,
            strip: Vec::new(),
            field: None,
        })
    }
}

/// `φ, φ′ against t`.
fn against(symbols: &[String], x: &str, language: Language) -> Rich {
    let many = language.pick("", if symbols.len() > 1 { "Зависимости " } else { "Зависимость " });
    let mut pieces = vec![Inline::Words(many.into())];
    for (i, name) in symbols.iter().enumerate() {
        if i > 0 {
            pieces.push(Inline::Words(", ".into()));
        }
        pieces.push(Inline::Symbol(name.clone()));
    }
    pieces.push(Inline::Words(format!(" {} ", language.word(Word::Against))));
    pieces.push(Inline::Symbol(x.into()));
    Rich(pieces)
}
