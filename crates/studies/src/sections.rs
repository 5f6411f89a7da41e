//! Sections of rods as they are shown: table, drawing, JSON and CSV. Everything was computed when the file was read.

use mechanics::section::{Properties, Section};
use report::document::Rich;
use report::figure::{Axis, Kind, Mark, Pen, Series};
use report::table::Column;
use report::unit::Scale;
use report::{Block, Cell, Figure, Table, Word};
use serde_json::{Map, Value, json};
use words::{Language, Text};

/// Significant digits in tables.
const DIGITS: usize = 6;

/// A property: key in JSON, printed symbol, power of length, value, what it is.
type Row = (&'static str, &'static str, i32, f64, &'static str, &'static str);

/// All properties, SI.
fn rows(p: &Properties) -> [Row; 23] {
    let ([x, y], [sx, sy], [gx, gy, gxy], [cx, cy, cxy]) = (p.centroid, p.first, p.given, p.central);
    let ([largest, smallest], [ix, iy, i1, i2], [wx, wy, w1, w2]) = (p.principal, p.radii, p.moduli);
    [
        ("area", "A", 2, p.area, "area", "площадь"),
        ("x_c", "x_c", 1, x, "centroid, x", "координата x центра тяжести"),
        ("y_c", "y_c", 1, y, "centroid, y", "координата y центра тяжести"),
        ("Sx", "S_x", 3, sx, "static moment about the given axis x", "статический момент относительно заданной оси x"),
        ("Sy", "S_y", 3, sy, "static moment about the given axis y", "статический момент относительно заданной оси y"),
        ("Ix_given", "I_x0", 4, gx, "second moment about the given axis x", "момент инерции относительно заданной оси x"),
        ("Iy_given", "I_y0", 4, gy, "second moment about the given axis y", "момент инерции относительно заданной оси y"),
        ("Ixy_given", "I_xy0", 4, gxy, "product of inertia, given axes", "центробежный момент инерции, заданные оси"),
        ("Ix", "I_x", 4, cx, "second moment about the centroidal axis x", "момент инерции относительно центральной оси x"),
        ("Iy", "I_y", 4, cy, "second moment about the centroidal axis y", "момент инерции относительно центральной оси y"),
        ("Ixy", "I_xy", 4, cxy, "product of inertia, centroidal axes", "центробежный момент инерции, центральные оси"),
        ("I1", "I_1", 4, largest, "larger principal moment", "главный момент инерции, больший"),
        ("I2", "I_2", 4, smallest, "smaller principal moment", "главный момент инерции, меньший"),
        ("angle", "alpha", 0, p.angle, "angle from x to the principal axis 1", "угол от x до главной оси 1"),
        ("ix", "i_x", 1, ix, "radius of gyration about the centroidal axis x", "радиус инерции относительно центральной оси x"),
        ("iy", "i_y", 1, iy, "radius of gyration about the centroidal axis y", "радиус инерции относительно центральной оси y"),
        ("i1", "i_1", 1, i1, "radius of gyration about the centroidal axis 1", "радиус инерции относительно центральной оси 1"),
        ("i2", "i_2", 1, i2, "radius of gyration about the centroidal axis 2", "радиус инерции относительно центральной оси 2"),
        ("Wx", "W_x", 3, wx, "section modulus in bending about the axis x", "момент сопротивления при изгибе относительно оси x"),
        ("Wy", "W_y", 3, wy, "section modulus in bending about the axis y", "момент сопротивления при изгибе относительно оси y"),
        ("W1", "W_1", 3, w1, "section modulus in bending about the axis 1", "момент сопротивления при изгибе относительно оси 1"),
        ("W2", "W_2", 3, w2, "section modulus in bending about the axis 2", "момент сопротивления при изгибе относительно оси 2"),
        ("height", "h", 1, p.extents[3] - p.extents[2], "height along y", "высота по y"),
    ]
}

/// A property by its key in JSON, SI.
pub fn property(section: &Section, key: &str) -> Option<f64> {
    rows(&section.properties).into_iter().find(|r| r.0 == key).map(|r| r.3)
}

/// The unit of length that suits the section: cm, or mm or m for very small and very large ones.
fn scale(p: &Properties) -> Scale {
    let size = (p.extents[1] - p.extents[0]).max(p.extents[3] - p.extents[2]);
    let (size, label) = match size {
        s if s < 0.01 => (0.001, "mm"),
        s if s < 10.0 => (0.01, "cm"),
        _ => (1.0, "m"),
    };
    Scale { size, label: label.into() }
}

/// `cm^4`.
fn unit(label: &str, power: i32) -> String {
    match power {
        0 => "deg".into(),
        1 => label.into(),
        n => format!("{label}^{n}"),
    }
}

/// The name of a section with what it is.
pub fn title(section: &Section, language: Language) -> String {
    let label = language.text(&section.label);
    let head = language.pick(format!("Section {}", section.name), format!("Сечение «{}»", section.name));
    match label.is_empty() {
        true => head,
        // a key of the file is no word of a Russian text; letters of the drawing are
        false if language == Language::Ru && crate::naming::is_word(&section.name) => format!("Сечение: {label}"),
        false => format!("{head}: {label}"),
    }
}

/// Symbol, value, unit, meaning.
pub fn table(section: &Section, language: Language) -> Table {
    let heads = [Word::Symbol, Word::Value, Word::Unit, Word::Description];
    let mut table = Table::new(heads.map(|w| Column::new(language.word(w))).into());
    let scale = scale(&section.properties);
    for (_, symbol, power, value, en, ru) in rows(&section.properties) {
        let shown = if power == 0 { value.to_degrees() } else { value / algebra::elementary::powi(scale.size, power) };
        table.row(vec![
            Cell::symbol(symbol),
            Cell::number(shown, DIGITS, language),
            Cell::words(report::unit::print(&unit(&scale.label, power), language)),
            Cell::words(language.pick(en, ru)),
        ]);
    }
    table
}

/// The outline with its centroid and principal axes.
pub fn figure(section: &Section, language: Language) -> Figure {
    let p = &section.properties;
    let axis = |symbol: &str| Axis { symbols: vec![symbol.into()], units: Vec::new(), scale: scale(p), log: false };
    let mut series = Vec::new();
    let outlines = |removed: bool, name: &str, label: Text| {
        let mut one = Series { name: name.into(), label: language.text(&label).into(), x: Vec::new(), y: Vec::new(), pen: Pen::Line };
        let parts = section.parts.iter().filter(|part| part.removed == removed);
        for contour in parts.flat_map(|part| &part.outline.contours) {
            let closed = contour.iter().chain(contour.first());
            closed.for_each(|[x, y]| {
                one.x.push(*x);
                one.y.push(*y);
            });
            // a gap before the next outline
            one.x.push(f64::NAN);
            one.y.push(f64::NAN);
        }
        one
    };
    series.push(outlines(false, "A", Text::new("material", "материал")));
    if section.parts.iter().any(|part| part.removed) {
        series.push(outlines(true, "A_0", Text::new("taken out", "вычтено")));
    }
    let length = 0.6 * (p.extents[1] - p.extents[0]).max(p.extents[3] - p.extents[2]);
    let ([x, y], (s, c)) = (p.centroid, algebra::elementary::sin_cos(p.angle));
    for (name, [a, b]) in [("I_1", [c, s]), ("I_2", [-s, c])] {
        let line = |at: f64, along: f64| vec![at - length * along, at + length * along];
        let label = language.text(&Text::new("principal axis", "главная ось")).into();
        series.push(Series { name: name.into(), label, x: line(x, a), y: line(y, b), pen: Pen::Line });
    }
    Figure {
        name: format!("section-{}", report::escape::file_name(&section.name)),
        title: Rich::from(title(section, language)),
        kind: Kind::Plane { equal: true },
        x: axis("x"),
        y: axis("y"),
        series,
        marks: vec![Mark::Point { x, y, label: "C".into() }],
        along: None,
        strip: Vec::new(),
        field: None,
    }
}

/// Whether sections are drawn beside their tables.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Drawings {
    /// A figure each.
    Shown,
    /// Tables alone.
    LeftOut,
}

/// Heading, table and drawing of every section.
pub fn blocks(sections: &[Section], drawings: Drawings, language: Language) -> Vec<Block> {
    let mut blocks = Vec::new();
    for section in sections {
        blocks.push(Block::heading(1, title(section, language)));
        let table = table(section, language);
        if drawings == Drawings::Shown {
            blocks.push(Block::Table(table.with_caption(title(section, language))));
            blocks.push(Block::Figure(figure(section, language)));
        } else {
            blocks.push(Block::Table(table));
        }
    }
    blocks
}

/// All properties of a section, SI; `centroid`, `parts` beside them.
pub fn to_json(section: &Section, language: Language) -> Value {
    let mut out = Map::new();
    out.insert("name".into(), json!(section.name));
    out.insert("label".into(), json!(language.text(&section.label)));
    out.insert("centroid".into(), json!(section.properties.centroid));
    for (key, _, _, value, ..) in rows(&section.properties) {
        out.insert(key.into(), json!(value));
    }
    out.insert("extents".into(), json!(section.properties.extents));
    let part = |p: &mechanics::section::Part| json!({"kind": p.kind, "area": p.area, "centroid": p.centroid, "removed": p.removed});
    out.insert("parts".into(), section.parts.iter().map(part).collect());
    Value::Object(out)
}

/// One row per section, SI, 17 digits.
pub fn to_csv(sections: &[Section]) -> String {
    let mut out = String::from("section");
    for (key, _, power, ..) in rows(&Properties::default()) {
        let unit = if power == 0 { "rad".into() } else { unit("m", power) };
        out.push_str(&format!(",{key} [{unit}]"));
    }
    for section in sections {
        out.push_str(&format!("\n{}", section.name));
        for (_, _, _, value, ..) in rows(&section.properties) {
            out.push_str(&format!(",{value:e}"));
        }
    }
    out.push('\n');
    out
}
