//! A scheme as SVG: black lines of three weights on nothing, so that pages in the dark may colour it; printed as it is.

use super::ink::{Fill, Ink, P, Shape, Stroke, Weight, polar};
use super::labels::{Set, TEXT, placed};
use super::{Item, LabelText, Scheme};
use crate::escape::markup;
use crate::palette::FONTS;
use crate::symbol;
use std::fmt::Write;
use words::Language;

/// Room around the drawing.
const MARGIN: f64 = 10.0;

impl Scheme {
    /// The picture as an SVG document.
    pub fn svg(&self, language: Language) -> String {
        write(self, language)
    }
}

fn write(scheme: &Scheme, language: Language) -> String {
    let drawn = Drawn::new(scheme, language);
    let mut out = head(scheme, bounds(&drawn.points(), &drawn.labels), language);
    for (item, ink) in scheme.items.iter().zip(&drawn.inks) {
        let _ = write!(out, "<g data-path=\"{}\">", markup(&item.path));
        ink.strokes.iter().for_each(|stroke| out.push_str(&path(stroke)));
        out.push_str("</g>\n");
    }
    drawn.labels.iter().for_each(|set| text(&mut out, set, language));
    out.push_str("</svg>\n");
    out
}

/// Strokes of all items, and labels at their places.
pub(super) struct Drawn<'a> {
    pub inks: Vec<Ink>,
    pub labels: Vec<Set<'a>>,
}

impl Drawn<'_> {
    pub fn new(scheme: &Scheme, language: Language) -> Drawn<'_> {
        let inks: Vec<Ink> = scheme.items.iter().map(ink).collect();
        let points: Vec<P> = inks.iter().flat_map(|ink| &ink.strokes).flat_map(Stroke::points).collect();
        Drawn { labels: placed(&scheme.labels, &points, language), inks }
    }

    pub fn points(&self) -> Vec<P> {
        self.inks.iter().flat_map(|ink| &ink.strokes).flat_map(Stroke::points).collect()
    }
}

fn ink(item: &Item) -> Ink {
    let mut ink = Ink::default();
    (item.symbol.draw)(&item.place, &mut ink);
    ink
}

/// The opening tag with the paper; whole pixels, so that nothing shows through at the edges.
pub(super) fn head(scheme: &Scheme, (low, high): (P, P), language: Language) -> String {
    let (w, h) = ((high[0] - low[0]).ceil(), (high[1] - low[1]).ceil());
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"scheme\" width=\"{w}\" height=\"{h}\" viewBox=\"{:.1} {:.1} {w} {h}\" \
         role=\"img\" aria-label=\"{}\" color=\"#000000\" font-family=\"{FONTS}\" font-size=\"{TEXT}\" fill=\"none\" stroke=\"currentColor\" \
         stroke-linejoin=\"round\" stroke-linecap=\"round\">\n<title>{}</title>\n<rect class=\"paper\" x=\"{:.1}\" y=\"{:.1}\" width=\"{w}\" height=\"{h}\" \
         fill=\"#ffffff\" stroke=\"none\"/>\n",
        low[0],
        low[1],
        markup(&scheme.told()),
        markup(&scheme.title.plain(language)),
        low[0],
        low[1],
    )
}

pub(super) fn bounds(points: &[P], labels: &[Set]) -> (P, P) {
    let corners = labels.iter().flat_map(|set| [set.low, set.high]);
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in points.iter().copied().chain(corners) {
        for k in 0..2 {
            low[k] = low[k].min(p[k] - MARGIN);
            high[k] = high[k].max(p[k] + MARGIN);
        }
    }
    if low[0] <= high[0] { (low, high) } else { ([0.0; 2], [2.0 * MARGIN; 2]) }
}

/// Weight, filling and dashes of a stroke.
pub(super) fn look(stroke: &Stroke) -> String {
    let width = match stroke.weight {
        Weight::Link => "2.6",
        Weight::Part => "1.7",
        Weight::Thin => "0.9",
    };
    let fill = match stroke.fill {
        Fill::None => "",
        Fill::Paper => " class=\"paper\" fill=\"#ffffff\"",
        Fill::Tint => " class=\"tint\" fill=\"#ededed\"",
        Fill::Ink => " fill=\"currentColor\"",
    };
    let dash = if stroke.dashed { " stroke-dasharray=\"9 3 2 3\"" } else { "" };
    format!("stroke-width=\"{width}\"{fill}{dash}")
}

pub(super) fn path(stroke: &Stroke) -> String {
    let look = look(stroke);
    match &stroke.shape {
        Shape::Way(points) => format!("<path d=\"{}\" {look}/>", way(points)),
        Shape::Loop(points) => format!("<path d=\"{}Z\" {look}/>", way(points)),
        Shape::Circle([x, y], r) => format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r:.1}\" {look}/>"),
        Shape::Arc(center, r, [from, to]) => {
            let ([x, y], [u, v]) = (polar(*center, *r, *from), polar(*center, *r, *to));
            let large = u8::from((to - from).abs() > std::f64::consts::PI);
            let sweep = u8::from(to < from);
            format!("<path d=\"M{x:.1} {y:.1}A{r:.1} {r:.1} 0 {large} {sweep} {u:.1} {v:.1}\" {look}/>")
        }
    }
}

pub(super) fn way(points: &[P]) -> String {
    let mut out = String::new();
    for (i, [x, y]) in points.iter().enumerate() {
        let _ = write!(out, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' });
    }
    out
}

pub(super) fn text(out: &mut String, set: &Set, language: Language) {
    let [x, y] = set.baseline;
    if let LabelText::Number(n) = &set.label.text {
        let (cx, cy) = ((set.low[0] + set.high[0]) / 2.0, (set.low[1] + set.high[1]) / 2.0);
        let _ = writeln!(
            out,
            "<g class=\"number\"><circle class=\"paper\" cx=\"{cx:.1}\" cy=\"{cy:.1}\" r=\"8.5\" fill=\"#ffffff\" stroke-width=\"0.9\"/>\
             <text x=\"{cx:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"12\" fill=\"currentColor\" stroke=\"none\">{n}</text></g>",
            cy + 4.3
        );
        return;
    }
    let _ = write!(out, "<text x=\"{x:.1}\" y=\"{y:.1}\" fill=\"currentColor\" stroke=\"none\">");
    match &set.label.text {
        LabelText::Symbol(name) => symbol_spans(out, name, language),
        LabelText::Formula(formula) => {
            formula_spans(out, formula);
        }
        LabelText::Words(words) => {
            for (i, line) in words.lines().enumerate() {
                let _ = write!(out, "<tspan x=\"{x:.1}\" dy=\"{}\" font-size=\"11\">{}</tspan>", if i == 0 { 0 } else { 13 }, markup(line));
            }
        }
        LabelText::Number(_) => {}
    }
    out.push_str("</text>\n");
}

/// A short formula: what follows a low line is an index.
fn formula_spans(out: &mut String, formula: &str) {
    let mut rest = formula;
    let mut shift = 0;
    while !rest.is_empty() {
        let (before, after) = rest.split_once('_').unwrap_or((rest, ""));
        for (run, slope) in runs(before, formula) {
            let _ = write!(out, "<tspan font-size=\"13\" dy=\"{}\"{slope}>{}</tspan>", -shift, markup(run));
            shift = 0;
        }
        let end = after.find(|c: char| !c.is_alphanumeric()).unwrap_or(after.len());
        if end > 0 {
            let _ = write!(out, "<tspan font-size=\"10\" dy=\"{}\">{}</tspan>", 4 - shift, markup(&after[..end]));
            shift = 4;
        }
        rest = &after[end..];
    }
}

/// Letters and products of two slope; digits, names of functions, words and the units of a value stand upright.
fn runs<'t>(text: &'t str, formula: &str) -> Vec<(&'t str, &'static str)> {
    let is_value = formula.starts_with(|c: char| c.is_ascii_digit());
    let mut list = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let is_letter = |c: char| c.is_alphabetic() && !('₀'..='ₜ').contains(&c);
        let end = rest.find(|c: char| is_letter(c) != is_letter(first)).unwrap_or(rest.len());
        let (run, after) = rest.split_at(end);
        let slopes = is_letter(first) && run.chars().count() <= 2 && !matches!(run, "tg" | "ln" | "sh" | "ch" | "th") && !is_value;
        list.push((run, if slopes { " font-style=\"italic\"" } else { "" }));
        rest = after;
    }
    list
}

fn symbol_spans(out: &mut String, name: &str, language: Language) {
    let mut low = false;
    for piece in symbol::pieces(name, language) {
        let shift = match (low, piece.index) {
            (false, true) => " dy=\"4\"",
            (true, false) => " dy=\"-4\"",
            _ => "",
        };
        low = piece.index;
        let italic = if piece.italic { " font-style=\"italic\"" } else { "" };
        let size = if piece.index { " font-size=\"10\"" } else { "" };
        let _ = write!(out, "<tspan{shift}{italic}{size}>{}</tspan>", markup(&piece.text));
    }
}
