//! What a row of the table of formats says.

use crate::document::{Block, Document};
use crate::figure::{Title, bands, png, svg};
use analysis::Dataset;
use serde_json::{Map, Value};
use std::io::{self, Write};
use words::Language;

/// A format: a row of [`super::TABLE`].
#[derive(Clone, Copy, Debug)]
pub struct Format {
    /// As the command line names it.
    pub name: &'static str,
    /// End of the names of its files, without the point.
    pub extension: &'static str,
    /// What it is good for, English and Russian.
    pub help: (&'static str, &'static str),
    /// What it can hold, and how it is written.
    pub holds: Holds,
}

/// What a format can hold.
#[derive(Clone, Copy, Debug)]
pub enum Holds {
    /// A document, for people.
    Page(Page),
    /// Columns of numbers, for spreadsheets.
    Table(Table),
    /// Results and notices as a tree, for programs.
    Tree(Tree),
}

/// How a document is written.
#[derive(Clone, Copy, Debug)]
pub struct Page {
    /// The document as text.
    pub write: fn(&Document, &Sheet) -> String,
    /// Where its figures are.
    pub pictures: Pictures,
    /// What makes a PDF of it, if anything does.
    pub press: Option<Press>,
}

/// A kind of program that makes a PDF of a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Press {
    /// A browser prints it.
    Browser,
    /// The compiler of Typst.
    Typst,
    /// A compiler of LaTeX, which runs twice: its second run knows the pages of the contents.
    Latex,
}

/// What a page is written on.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sheet<'a> {
    /// Characters of a line, for formats that count them.
    pub width: usize,
    /// Files of the pictures in the order of the blocks; where there is none, the figure is told in words.
    pub pictures: &'a [String],
}

/// Where the figures of a page are.
#[derive(Clone, Copy, Debug)]
pub enum Pictures {
    /// In the page itself.
    Inside,
    /// Nowhere: they are told in words.
    Told,
    /// In files of this kind beside the page.
    Beside(Drawing),
    /// In the file of the page, which is a package of several.
    Packed(Package),
}

/// Name and bytes of a file.
pub type Named = (String, Vec<u8>);

/// A file that holds the text of a page and its pictures.
#[derive(Clone, Copy, Debug)]
pub struct Package {
    /// How its pictures are drawn.
    pub drawing: Drawing,
    /// The text and the pictures, name and bytes, as one file.
    pub pack: fn(&str, &[Named]) -> Vec<u8>,
}

/// A kind of picture.
#[derive(Clone, Copy, Debug)]
pub struct Drawing {
    /// End of the names of its files.
    pub extension: &'static str,
    /// Makes it of an SVG.
    pub draw: fn(String) -> Result<Vec<u8>, png::Error>,
}

/// How columns of numbers are written.
#[derive(Clone, Copy, Debug)]
pub struct Table {
    /// All rows, piece by piece.
    pub data: fn(&Dataset, &mut dyn Write) -> io::Result<()>,
    /// Rows at events and switches.
    pub events: fn(&Dataset, Language) -> Vec<u8>,
}

/// Writes numbers and what else a study has found, piece by piece.
type Written = fn((&Dataset, &Map<String, Value>), Language, &mut dyn Write) -> io::Result<()>;

/// How trees are written.
#[derive(Clone, Copy, Debug)]
pub struct Tree {
    /// Everything about a study, with its own fields, piece by piece.
    pub data: Written,
    /// Anything else.
    pub value: fn(&Value) -> String,
}

/// Bytes that are kept until they are passed on: a table of a million rows is never in memory as text.
const PIECE: usize = 1 << 16;

/// Passes on what is written so far, once it is a piece.
pub(crate) fn pass_on(written: &mut Vec<u8>, to: &mut dyn Write) -> io::Result<()> {
    if written.len() >= PIECE {
        to.write_all(written)?;
        written.clear();
    }
    Ok(())
}

/// SVG as it is.
pub(crate) const VECTOR: Drawing = Drawing { extension: "svg", draw: |svg| Ok(svg.into_bytes()) };

/// For programs that read no SVG.
pub(crate) const RASTER: Drawing = Drawing { extension: "png", draw: |svg| png::of_svg(&svg) };

impl Format {
    /// How it writes documents, if it does.
    pub fn page(&self) -> Option<Page> {
        if let Holds::Page(page) = self.holds { Some(page) } else { None }
    }

    /// How it writes columns of numbers, if it does.
    pub fn table(&self) -> Option<Table> {
        if let Holds::Table(table) = self.holds { Some(table) } else { None }
    }

    /// How it writes trees, if it does.
    pub fn tree(&self) -> Option<Tree> {
        if let Holds::Tree(tree) = self.holds { Some(tree) } else { None }
    }

    /// Whether a folder of results has its page in it: figures are with it.
    pub fn is_paged(&self) -> bool {
        self.page().is_some_and(|page| !matches!(page.pictures, Pictures::Told))
    }
}

impl Page {
    /// The pictures that go beside the page, in the order of the blocks: name and bytes.
    ///
    /// # Errors
    /// A fault of the renderer.
    pub fn pictures(&self, document: &Document) -> Result<Vec<(String, Vec<u8>)>, png::Error> {
        if let Pictures::Beside(drawing) = self.pictures { drawings(document, drawing) } else { Ok(Vec::new()) }
    }

    /// The page as the bytes of its file.
    ///
    /// # Errors
    /// A fault of the renderer of the pictures that go into it.
    pub fn file(&self, document: &Document, sheet: &Sheet) -> Result<Vec<u8>, png::Error> {
        let Pictures::Packed(package) = self.pictures else { return Ok((self.write)(document, sheet).into_bytes()) };
        let drawn = drawings(document, package.drawing)?;
        let names: Vec<String> = drawn.iter().map(|(name, _)| name.clone()).collect();
        let text = (self.write)(document, &Sheet { pictures: &names, ..*sheet });
        Ok((package.pack)(&text, &drawn))
    }
}

fn drawings(document: &Document, drawing: Drawing) -> Result<Vec<(String, Vec<u8>)>, png::Error> {
    let mut drawn = Vec::new();
    draw(&document.blocks, document.language, &mut drawn);
    let named = |(i, svg)| Ok((format!("figure-{}.{}", i + 1, drawing.extension), (drawing.draw)(svg)?));
    drawn.into_iter().enumerate().map(named).collect()
}

/// The figures of blocks as SVG without titles, which stand in captions.
fn draw(blocks: &[Block], language: Language, drawn: &mut Vec<String>) {
    for block in blocks {
        match block {
            Block::Figure(figure) => drawn.push(svg::write(figure, Title::Caption, language)),
            Block::Bands(bands) => drawn.push(bands::write(bands, Title::Caption, language)),
            Block::Scheme(scheme) => drawn.push(scheme.svg(language)),
            Block::Details { blocks, .. } => draw(blocks, language, drawn),
            _ => {}
        }
    }
}
