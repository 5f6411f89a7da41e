//! A figure as a static SVG file: light, printable, readable without fonts of ours.
//!
//! Own writer instead of a plotting library: the library tried (kuva 0.6) has no event strip, no slanted symbols in axis labels, loses
//! dash patterns in PNG and uses one clip name for all pictures, which breaks several pictures on one page.

use super::field::Key;
use super::layout::{LEGEND_ROW, Layout, STRIP, TEXT, lay};
use super::tiles;
use super::width::text_width;
use super::{Axis, Figure, Kind, Mark, Pen, Title, decimate, style};
use crate::escape::markup;
use crate::palette::{FONTS, GRID, INK};
use crate::rich::Inline;
use crate::symbol;
use crate::wording::Word;
use std::fmt::Write;
use words::Language;

/// Width of curves.
const STROKE: f64 = 1.6;
const SOFT: &str = "#5a5a5a";
const BOUNDARY: &str = "fill=\"none\" stroke=\"#1a1a1a\" stroke-width=\"1.6\" stroke-linejoin=\"round\"";

/// The figure as an SVG document; one with a caption beside it needs no title above.
pub fn write(figure: &Figure, title: Title, language: Language) -> String {
    let layout = lay(figure, title, language);
    let mut out = String::with_capacity(32 * 1024);
    let (w, h) = (layout.width, layout.height);
    let _ = write!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h:.0}\" viewBox=\"0 0 {w} {h:.0}\" role=\"img\" \
         aria-label=\"{}\" font-family=\"{FONTS}\" font-size=\"{TEXT}\" fill=\"{INK}\">\n<rect width=\"{w}\" height=\"{h:.0}\" fill=\"#ffffff\"/>\n",
        markup(&figure.title.plain(language))
    );
    let mut draw = Draw { out, layout: &layout, figure, language };
    if title == Title::Above {
        draw.title();
    }
    draw.legend();
    draw.intervals();
    draw.grid();
    if layout.empty {
        draw.nothing();
    } else {
        draw.curves();
        draw.marks();
    }
    draw.strip();
    draw.scale();
    draw.axis_labels();
    draw.out.push_str("</svg>\n");
    draw.out
}

struct Draw<'a> {
    out: String,
    layout: &'a Layout,
    figure: &'a Figure,
    language: Language,
}

// writing into a string cannot fail: results of `write!` are dropped throughout
impl Draw<'_> {
    fn title(&mut self) {
        let _ = write!(self.out, "<text x=\"{:.1}\" y=\"18\" font-size=\"14\">", self.layout.area.left);
        for piece in &self.figure.title.0 {
            match piece {
                Inline::Words(words) => self.out.push_str(&markup(words)),
                Inline::Formula(formula) => self.out.push_str(&markup(&formula.text())),
                Inline::Symbol(name) => self.symbol(name),
            }
        }
        self.out.push_str("</text>\n");
    }

    fn legend(&mut self) {
        let entries = self.layout.entries.clone();
        if let Some(field) = &self.figure.field {
            for ((row, x), (tile, words)) in entries.into_iter().zip(field.entries(self.language)) {
                let y = self.layout.legend + (row as f64 + 0.5) * LEGEND_ROW;
                self.out.push_str(&tiles::swatch(field, tile, [x, y]));
                let _ = writeln!(self.out, "<text x=\"{:.1}\" y=\"{:.1}\">{}</text>", x + 42.0, y + 4.0, markup(&words));
            }
            return;
        }
        for (i, ((row, x), series)) in entries.into_iter().zip(&self.figure.series).enumerate() {
            let y = self.layout.legend + (row as f64 + 0.5) * LEGEND_ROW;
            let _ = match series.pen {
                Pen::Line => write!(self.out, "<path d=\"M{x:.1} {y:.1}h34\" {}/>", stroke(i)),
                Pen::Dots => write!(self.out, "<path d=\"M{:.1} {y:.1}h0\" {}/>", x + 17.0, dotted(i, FEW)),
            };
            let _ = write!(self.out, "<text x=\"{:.1}\" y=\"{:.1}\">", x + 42.0, y + 4.0);
            self.symbol(&series.name);
            if !series.label.is_empty() {
                let dash = if series.name.is_empty() { "" } else { " – " };
                let _ = write!(self.out, "{dash}{}", markup(&series.label));
            }
            self.out.push_str("</text>\n");
        }
    }

    /// Intervals of the event strip, shaded behind the curves.
    fn intervals(&mut self) {
        let area = self.layout.area;
        for happening in self.figure.strip.iter().filter(|h| h.to > h.from) {
            let (Some(a), Some(b)) = (self.layout.x.pixel(happening.from), self.layout.x.pixel(happening.to)) else { continue };
            let (a, b) = (a.max(area.left), b.min(area.right));
            if b > a {
                let _ = writeln!(
                    self.out,
                    "<rect x=\"{a:.2}\" y=\"{:.1}\" width=\"{:.2}\" height=\"{:.1}\" fill=\"#f3f0e6\"/>",
                    area.top,
                    b - a,
                    area.bottom - area.top
                );
            }
        }
    }

    fn grid(&mut self) {
        let a = self.layout.area;
        let mut lines = String::new();
        let mut labels = String::new();
        for tick in &self.layout.x.ticks {
            let Some(x) = self.layout.x.pixel_of_shown(tick.at) else { continue };
            let _ = write!(lines, "M{x:.1} {:.1}V{:.1}", a.top, a.bottom);
            let _ = write!(labels, "<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>", a.bottom + 17.0, markup(&tick.label));
        }
        for tick in &self.layout.y.ticks {
            let Some(y) = self.layout.y.pixel_of_shown(tick.at) else { continue };
            let _ = write!(lines, "M{:.1} {y:.1}H{:.1}", a.left, a.right);
            let _ =
                write!(labels, "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>", a.left - 8.0, y + 4.0, markup(&tick.label));
        }
        let _ = writeln!(self.out, "<path d=\"{lines}\" stroke=\"{GRID}\" fill=\"none\"/>\n{labels}");
        if let Some(zero) = self.layout.y.pixel_of_shown(0.0).filter(|y| *y > a.top && *y < a.bottom) {
            let _ = writeln!(self.out, "<path d=\"M{:.1} {zero:.1}H{:.1}\" stroke=\"#b0b0b0\" fill=\"none\"/>", a.left, a.right);
        }
        let _ =
            writeln!(self.out, "<path d=\"M{:.1} {:.1}V{:.1}H{:.1}\" stroke=\"{INK}\" fill=\"none\"/>", a.left, a.top, a.bottom, a.right);
    }

    fn curves(&mut self) {
        let a = self.layout.area;
        // a nested svg cuts at its edges and needs no name, so that several pictures can stand on one page
        let _ = writeln!(
            self.out,
            "<svg x=\"{0:.1}\" y=\"{1:.1}\" width=\"{2:.1}\" height=\"{3:.1}\" viewBox=\"{0:.1} {1:.1} {2:.1} {3:.1}\" overflow=\"hidden\">",
            a.left,
            a.top,
            a.right - a.left,
            a.bottom - a.top
        );
        if let Some(field) = &self.figure.field {
            self.out.push_str(&tiles::tiles(field, &self.layout.x, &self.layout.y));
        }
        for (i, series) in self.figure.series.iter().enumerate() {
            let kept = match self.figure.kind {
                // as wide as the stroke: finer ones cost time and show nothing
                Kind::Curves => decimate::buckets(&series.x, &[&series.y], ((a.right - a.left) / STROKE) as usize),
                Kind::Plane { .. } => decimate::plane(&series.x, &series.y, 600, 6000),
            };
            let points = kept.into_iter().map(|i| (series.x[i], series.y[i]));
            let (path, look) = match series.pen {
                // boundaries between tints are of no tint themselves
                Pen::Line if self.figure.field.is_some() => (self.path(points), BOUNDARY.into()),
                Pen::Line => (self.path(points), stroke(i)),
                Pen::Dots => (self.dots(points), dotted(i, series.x.len())),
            };
            let _ = writeln!(self.out, "<path d=\"{path}\" {look}/>");
        }
        self.out.push_str("</svg>\n");
    }

    fn path(&self, points: impl Iterator<Item = (f64, f64)>) -> String {
        let mut path = String::new();
        let mut pen = 'M';
        for (x, y) in points {
            match (self.layout.x.pixel(x), self.layout.y.pixel(y)) {
                (Some(px), Some(py)) => {
                    let _ = write!(path, "{pen}{px:.2} {py:.2}");
                    pen = 'L';
                }
                _ => pen = 'M',
            }
        }
        path
    }

    /// Strokes without length, which a round pen leaves as dots.
    fn dots(&self, points: impl Iterator<Item = (f64, f64)>) -> String {
        let pixels = points.filter_map(|(x, y)| self.layout.x.pixel(x).zip(self.layout.y.pixel(y)));
        pixels.map(|(x, y)| format!("M{x:.2} {y:.2}h0")).collect()
    }

    fn marks(&mut self) {
        let a = self.layout.area;
        // labels of near lines stand below one another: left edge, right edge, row
        let mut taken: Vec<(f64, f64, f64)> = Vec::new();
        for mark in &self.figure.marks {
            let (x, y, label) = match mark {
                Mark::Vertical { x, label } => (Some(*x), None, label),
                Mark::Horizontal { y, label } => (None, Some(*y), label),
                Mark::Point { x, y, label } => (Some(*x), Some(*y), label),
            };
            let px = x.map_or(Some(a.right), |x| self.layout.x.pixel(x)).filter(|p| (a.left..=a.right).contains(p));
            let py = y.map_or(Some(a.top), |y| self.layout.y.pixel(y)).filter(|p| (a.top..=a.bottom).contains(p));
            let (Some(px), Some(py)) = (px, py) else { continue };
            let _ = match mark {
                Mark::Vertical { .. } => {
                    write!(self.out, "<path d=\"M{px:.1} {:.1}V{:.1}\" stroke=\"{SOFT}\" stroke-dasharray=\"3 3\"/>", a.top, a.bottom)
                }
                Mark::Horizontal { .. } => {
                    write!(self.out, "<path d=\"M{:.1} {py:.1}H{:.1}\" stroke=\"{SOFT}\" stroke-dasharray=\"3 3\"/>", a.left, a.right)
                }
                Mark::Point { .. } => write!(self.out, "<circle cx=\"{px:.1}\" cy=\"{py:.1}\" r=\"3.5\" fill=\"{INK}\"/>"),
            };
            // words stay inside: left of the point in the right half
            let right_half = px > (a.left + a.right) / 2.0;
            let (anchor, dx) = if right_half { ("end", -6.0) } else { ("start", 6.0) };
            let dy = if py < a.top + 18.0 { 14.0 } else { -6.0 };
            let wide = text_width(label, TEXT);
            let from = if right_half { px + dx - wide } else { px + dx };
            let mut row = py + dy;
            while y.is_none() && taken.iter().any(|t| t.2 == row && from < t.1 && t.0 < from + wide) {
                row += 14.0;
            }
            taken.push((from, from + wide, row));
            let _ = writeln!(
                self.out,
                "<text x=\"{:.1}\" y=\"{row:.1}\" text-anchor=\"{anchor}\" fill=\"{SOFT}\">{}</text>",
                px + dx,
                markup(label)
            );
        }
    }

    /// The event strip: a tick for an instant, a bar for an interval, words where they fit.
    fn strip(&mut self) {
        if self.figure.strip.is_empty() {
            return;
        }
        let a = self.layout.area;
        let top = a.bottom + 24.0;
        let mut free = a.left;
        for happening in &self.figure.strip {
            let (Some(from), Some(to)) = (self.layout.x.pixel(happening.from), self.layout.x.pixel(happening.to)) else { continue };
            if to < a.left - 0.5 || from > a.right + 0.5 {
                continue;
            }
            let (from, to) = (from.max(a.left), to.min(a.right));
            let _ = if to - from > 2.0 {
                write!(self.out, "<rect x=\"{from:.2}\" y=\"{top:.1}\" width=\"{:.2}\" height=\"12\" fill=\"#d8cfb4\"/>", to - from)
            } else {
                write!(self.out, "<path d=\"M{from:.2} {top:.1}v12\" stroke=\"{SOFT}\" stroke-width=\"1.5\"/>")
            };
            let wide = text_width(&happening.what, 10.0);
            if from + 4.0 >= free && from + 4.0 + wide <= a.right {
                let _ = write!(
                    self.out,
                    "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"10\" fill=\"{SOFT}\">{}</text>",
                    from + 4.0,
                    top + 9.5,
                    markup(&happening.what)
                );
                free = from + 4.0 + wide + 6.0;
            } else {
                free = free.max(from + 4.0);
            }
        }
        self.out.push('\n');
    }

    /// The bar of a filling by numbers, below what it shows.
    fn scale(&mut self) {
        let Some(Key::Scale(axis, ends)) = self.figure.field.as_ref().map(|field| &field.key) else { return };
        let a = self.layout.area;
        self.out.push_str(&tiles::bar((axis, *ends), a, self.language));
        let _ = write!(self.out, "<text x=\"{:.1}\" y=\"{:.1}\">", a.right + 16.0, a.top - 10.0);
        self.axis(axis);
        self.out.push_str("</text>\n");
    }

    fn axis_labels(&mut self) {
        let a = self.layout.area;
        let strip = if self.figure.strip.is_empty() { 0.0 } else { STRIP };
        let _ = write!(self.out, "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">", a.right, a.bottom + strip + 34.0);
        self.axis(&self.figure.x);
        let _ = write!(self.out, "</text>\n<text x=\"{:.1}\" y=\"{:.1}\">", (a.left - 30.0).max(4.0), a.top - 10.0);
        self.axis(&self.figure.y);
        self.out.push_str("</text>\n");
    }

    fn axis(&mut self, axis: &Axis) {
        for (i, name) in axis.symbols.iter().enumerate() {
            if i > 0 {
                self.out.push_str(if axis.units.is_empty() { ", " } else { "; " });
            }
            self.symbol(name);
            let unit = axis.unit(i, self.language);
            if !unit.is_empty() && (!axis.units.is_empty() || i + 1 == axis.symbols.len()) {
                let _ = write!(self.out, ", {}", markup(&unit));
            }
        }
    }

    /// A symbol as spans: slanted Latin letters, index below the line.
    fn symbol(&mut self, name: &str) {
        let mut low = false;
        for piece in symbol::pieces(name, self.language) {
            let dy = match (low, piece.index) {
                (false, true) => " dy=\"3\"",
                (true, false) => " dy=\"-3\"",
                _ => "",
            };
            low = piece.index;
            let italic = if piece.italic { " font-style=\"italic\"" } else { "" };
            let size = if piece.index { " font-size=\"9\"" } else { "" };
            let _ = write!(self.out, "<tspan{dy}{italic}{size}>{}</tspan>", markup(&piece.text));
        }
        if low {
            // back to the line for what follows; a zero-width space carries the shift
            self.out.push_str("<tspan dy=\"-3\">\u{200b}</tspan>");
        }
    }

    fn nothing(&mut self) {
        let a = self.layout.area;
        let (x, y) = ((a.left + a.right) / 2.0, (a.top + a.bottom) / 2.0);
        let words = self.language.word(Word::NoData);
        let _ = writeln!(self.out, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\" fill=\"{SOFT}\">{words}</text>");
    }
}

/// So many dots are seen one by one; more make a curve or a cloud.
const FEW: usize = 200;

/// Stroke attributes of the dots of the i-th curve.
fn dotted(i: usize, count: usize) -> String {
    let width = if count > FEW { 3 } else { 6 };
    format!("fill=\"none\" stroke=\"{}\" stroke-width=\"{width}\" stroke-linecap=\"round\"", style(i).0)
}

/// Stroke attributes of the i-th curve.
fn stroke(i: usize) -> String {
    let (colour, dash) = style(i);
    let mut out = format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"{STROKE}\" stroke-linejoin=\"round\"");
    if !dash.is_empty() {
        let pattern: Vec<String> = dash.iter().map(f64::to_string).collect();
        let _ = write!(out, " stroke-dasharray=\"{}\"", pattern.join(" "));
    }
    out
}

/// Where the data of a figure stand in its picture: left, top, right, bottom, and the width and height of the picture, pixels.
pub fn area(figure: &Figure, title: Title, language: Language) -> [f64; 6] {
    let layout = lay(figure, title, language);
    [layout.area.left, layout.area.top, layout.area.right, layout.area.bottom, layout.width, layout.height]
}
