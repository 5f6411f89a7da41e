//! A [`Document`] as one HTML file that needs nothing else: opened from a disk without a network it shows everything.
//!
//! Styles, script, plotting library (uPlot, MIT) and data are inside; a content security policy forbids requests. Without scripts the
//! page still shows all text, tables and static pictures; print always takes these. User text is escaped.

mod blocks;
mod cards;
mod data;
mod played;

pub use cards::{Card, cards};

use super::{Format, Holds, Page, Pictures, Press, Sheet};
use crate::document::{Block, Document};
use crate::escape::{markup, script_json};
use crate::figure::Figure;
use crate::scheme::Moving;
use crate::wording::Word;
use base64::Engine;
use words::Language;

/// The row of the table.
pub const FORMAT: Format = Format {
    name: "html",
    extension: "html",
    help: ("for browsers, with live plots, one file", "для браузера, с живыми графиками, один файл"),
    holds: Holds::Page(Page {
        write: |document: &Document, _: &Sheet| write(document, Options::default()),
        pictures: Pictures::Inside,
        press: Some(Press::Browser),
    }),
};

const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");
const MOVING_SCRIPT: &str = include_str!("moving.js");
const FIELD_SCRIPT: &str = include_str!("field.js");
const PLANE_SCRIPT: &str = include_str!("plane.js");
const UPLOT: &str = include_str!("../../../assets/uplot/uPlot.iife.min.js");
const UPLOT_STYLE: &str = include_str!("../../../assets/uplot/uPlot.min.css");
const UPLOT_LICENSE: &str = include_str!("../../../assets/uplot/LICENSE");

/// What a page may carry besides the document.
#[derive(Clone, Copy, Debug)]
pub struct Options<'a> {
    /// A WOFF2 font with a table for mathematics, so that brackets stretch and dots stand on machines without one; the
    /// default is [`crate::formula::MATH_FONT`].
    pub math_font: Option<&'a [u8]>,
}

impl Default for Options<'_> {
    fn default() -> Self {
        Options { math_font: Some(crate::formula::MATH_FONT) }
    }
}

/// The page as text in UTF-8.
pub fn write(document: &Document, options: Options) -> String {
    let language = document.language;
    let mut writer = blocks::Writer::new(document);
    writer.blocks(&document.blocks);
    let figures = figures_of(&document.blocks);
    let title = markup(&document.title);
    let mut out = String::with_capacity(writer.out.len() + 160 * 1024);
    out.push_str(&head(&title, &figures, language, options));
    let side = writer.side(document);
    out.push_str(if side.is_empty() { "<body>\n" } else { "<body class=\"sided\">\n" });
    out.push_str(&side);
    out.push_str("<main>\n");
    if !document.has_front() {
        out.push_str(&header(document));
    }
    out.push_str(&writer.out);
    out.push_str(&format!("</main>\n{}", footer(document)));
    if !figures.is_empty() {
        out.push_str(&scripts(&figures, language));
    }
    let played = played_of(&document.blocks);
    if !played.is_empty() {
        let data = script_json(&played::write(&played, language));
        out.push_str(&format!(
            "<script type=\"application/json\" id=\"strutt-moving\">{data}</script>\n<script>\n{MOVING_SCRIPT}\n</script>\n"
        ));
    }
    if has_field(&document.blocks) {
        out.push_str(&format!("<script>\n{FIELD_SCRIPT}\n</script>\n"));
    }
    out.push_str("</body>\n</html>\n");
    out
}

/// Whether a place of some figure can be clicked.
fn has_field(blocks: &[Block]) -> bool {
    blocks.iter().any(|block| match block {
        Block::Figure(figure) => figure.field.is_some(),
        Block::Details { blocks, .. } => has_field(blocks),
        _ => false,
    })
}

fn header(document: &Document) -> String {
    let mut out = format!("<header>\n<h1>{}</h1>\n", markup(&document.title));
    for paragraph in document.description.split('\n').filter(|p| !p.trim().is_empty()) {
        out.push_str(&format!("<p class=\"lead\">{}</p>\n", markup(paragraph)));
    }
    out + "</header>\n"
}

/// Styles of the plotting library come only where something is plotted.
fn head(title: &str, figures: &[&Figure], language: Language, options: Options) -> String {
    let font = options.math_font.map_or(String::new(), |bytes| {
        let data = base64::engine::general_purpose::STANDARD.encode(bytes);
        format!("@font-face{{font-family:\"Strutt Math\";src:url(data:font/woff2;base64,{data}) format(\"woff2\")}}\n")
    });
    format!(
        "<!DOCTYPE html>\n<html lang=\"{}\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; \
         img-src data: blob:; font-src data:\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta name=\"color-scheme\" content=\"light dark\">\n\
         <title>{title}</title>\n<style>\n{font}{}{STYLE}</style>\n</head>\n",
        language.code(),
        if figures.is_empty() { "" } else { UPLOT_STYLE },
    )
}

fn footer(document: &Document) -> String {
    let word = |w| document.language.word(w);
    let mut parts = vec![format!("strutt, {} {}", word(Word::Version), markup(&document.version))];
    if !document.model_hash.is_empty() {
        parts.push(format!("{} <code>{}</code>", word(Word::ModelHash), markup(&document.model_hash)));
    }
    format!("<footer>{}</footer>\n", parts.join(" · "))
}

fn scripts(figures: &[&Figure], language: Language) -> String {
    // the address in the first comment of the library is replaced by its licence
    let library = UPLOT.split_once("*/").map_or(UPLOT, |(_, code)| code);
    let license = UPLOT_LICENSE.replace("*/", "* /");
    let data = script_json(&data::write(figures, language));
    format!(
        "<script type=\"application/json\" id=\"strutt-data\">{data}</script>\n<script>\n/*! uPlot 1.6.32\n{license}*/\n{library}\n</script>\n\
         <script>\n{PLANE_SCRIPT}\n{SCRIPT}\n</script>\n"
    )
}

/// Figures in the order in which the writer meets them.
fn figures_of(blocks: &[Block]) -> Vec<&Figure> {
    let mut out = Vec::new();
    for block in blocks {
        match block {
            Block::Figure(figure) if figure.field.is_none() => out.push(figure),
            Block::Details { blocks, .. } => out.extend(figures_of(blocks)),
            _ => {}
        }
    }
    out
}

/// Moving pictures in the order in which the writer meets them.
fn played_of(blocks: &[Block]) -> Vec<&Moving> {
    let mut out = Vec::new();
    for block in blocks {
        match block {
            Block::Moving(moving) => out.push(moving),
            Block::Details { blocks, .. } => out.extend(played_of(blocks)),
            _ => {}
        }
    }
    out
}
