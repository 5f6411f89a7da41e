//! The folder of results: tables, plots and the page.

use crate::shelf::Shelf;
use crate::variants;
use crate::wording::Word;
use mechanics::Model;
use mechanics::section::Section;
use report::figure::{Title, png};
use report::formats::Sheet;
use report::{Document, Figure, Format, csv, json};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use studies::pipeline::{self, Calculation};
use studies::{Extent, Results, Source, VERSION};
use words::{Language, Notice, Printed};

/// How the page of a folder is written where nobody says otherwise.
pub const PAGE: Format = report::formats::html::FORMAT;

/// Writes everything about a calculation, which has taken values from some tables as well, into a folder, its page in a format; returns the paths, the page last.
///
/// # Errors
/// A result would replace an input (C052), or the disk refuses (C005); then nothing is written.
pub fn write(
    calculation: &mut Calculation,
    (folder, read): (&Path, &[PathBuf]),
    (format, language): (Format, Language),
) -> Result<Vec<PathBuf>, Box<Notice>> {
    let mut inputs = inputs(&calculation.machine.origin.source, &calculation.machine.model);
    inputs.extend_from_slice(read);
    let mut shelf = Shelf::open(folder, &inputs)?;
    let several = calculation.results.len() > 1;
    for (i, results) in calculation.results.iter().enumerate() {
        let number = if several { format!("-{}", i + 1) } else { String::new() };
        tables(&mut shelf, results, &format!("{}{number}", results.stem()), language)?;
        for figure in results.figures(language) {
            plot(&mut shelf, &figure, &number, language)?;
        }
        if let Some(bands) = results.bands(language) {
            let svg = report::figure::bands::write(&bands, Title::Above, language);
            shelf.put(&format!("{}{number}.svg", bands.name), Word::Vector, svg.as_bytes())?;
        }
    }
    section_files(&mut shelf, &calculation.machine.model.sections, language)?;
    calculation.files = shelf.names.iter().map(|(name, what)| (name.clone(), what.text())).collect();
    let document = pipeline::document(calculation, Extent::Page, language);
    page(&mut shelf, &document, &format)?;
    shelf.close()
}

/// Writes the calculation that is handed in; the paths, its own last.
///
/// # Errors
/// As [`write()`].
pub fn report(
    calculation: &Calculation,
    document: &Document,
    (folder, name): (&Path, &str),
    format: &Format,
) -> Result<Vec<PathBuf>, Box<Notice>> {
    let inputs = inputs(&calculation.machine.origin.source, &calculation.machine.model);
    let mut shelf = Shelf::open(folder, &inputs)?;
    paged(&mut shelf, document, (format, name))?;
    shelf.close()
}

/// Writes one picture; an older one of that name is replaced.
///
/// # Errors
/// It would replace an input (C052), or the disk refuses (C005).
pub fn picture(path: &Path, bytes: &[u8], inputs: &[PathBuf]) -> Result<(), Box<Notice>> {
    crate::shelf::replace(path, bytes, inputs)
}

/// An SVG as the bytes of a PNG file.
///
/// # Errors
/// A fault of the renderer.
pub fn pixels(svg: &str, name: &str) -> Result<Vec<u8>, Box<Notice>> {
    png::of_svg(svg).map_err(|error| undrawn(name, &error))
}

/// The page and its pictures.
fn page(shelf: &mut Shelf, document: &Document, format: &Format) -> Result<(), Box<Notice>> {
    paged(shelf, document, (format, &format!("index.{}", format.extension)))
}

fn paged(shelf: &mut Shelf, document: &Document, (format, name): (&Format, &str)) -> Result<(), Box<Notice>> {
    let Some(page) = format.page() else { return Ok(()) };
    let mut pictures = Vec::new();
    for (name, bytes) in page.pictures(document).map_err(|error| undrawn("figure", &error))? {
        pictures.push(shelf.put(&name, Word::Picture, &bytes)?);
    }
    let bytes = page.file(document, &Sheet { width: 0, pictures: &pictures }).map_err(|error| undrawn("figure", &error))?;
    shelf.put(name, Word::Page, &bytes)?;
    Ok(())
}

/// A picture that the renderer refused.
pub fn undrawn(stem: &str, error: &png::Error) -> Box<Notice> {
    Box::new(Notice::new("C005", format!("cannot draw {stem}.png: {error}"), format!("не удаётся нарисовать {stem}.png: {error}")))
}

/// The files that a calculation reads: the model and its table of variants.
pub fn inputs(source: &Source, model: &Model) -> Vec<PathBuf> {
    let table = variants::file(model, source);
    [PathBuf::from(&source.path)].into_iter().chain(table.map(PathBuf::from)).collect()
}

/// Writes a table and drawings of sections into a folder; returns the paths.
///
/// # Errors
/// A result would replace an input (C052), or the disk refuses (C005); then nothing is written.
pub fn sections(sections: &[Section], (folder, inputs): (&Path, &[PathBuf]), language: Language) -> Result<Vec<PathBuf>, Box<Notice>> {
    let mut shelf = Shelf::open(folder, inputs)?;
    section_files(&mut shelf, sections, language)?;
    shelf.close()
}

fn section_files(shelf: &mut Shelf, sections: &[Section], language: Language) -> Result<(), Box<Notice>> {
    if sections.is_empty() {
        return Ok(());
    }
    shelf.put("sections.csv", Word::SectionTable, studies::sections::to_csv(sections).as_bytes())?;
    for section in sections {
        plot(shelf, &studies::sections::figure(section, language), "", language)?;
    }
    Ok(())
}

fn tables(shelf: &mut Shelf, results: &Results, stem: &str, language: Language) -> Result<(), Box<Notice>> {
    let data = &results.data;
    shelf.put_by(&format!("{stem}.csv"), Word::Table, &mut |to| csv::write_to(data, csv::Dialect::Plain, to))?;
    if data.events.iter().any(|e| !e.name.is_empty()) {
        shelf.put(&format!("{stem}-events.csv"), Word::EventTable, &csv::write_events(data, csv::Dialect::Plain, language))?;
    }
    for (name, table) in &results.beside {
        shelf.put(&format!("{stem}-{name}.csv"), Word::Table, &csv::write(table, csv::Dialect::Plain))?;
    }
    if language == Language::Ru {
        shelf.put_by(&format!("{stem}-excel.csv"), Word::TableRu, &mut |to| csv::write_to(data, csv::Dialect::Ru, to))?;
    }
    shelf.put_by(&format!("{stem}.json"), Word::AllData, &mut |to| json::write_to((data, &results.fields()), language, to))?;
    Ok(())
}

fn plot(shelf: &mut Shelf, figure: &Figure, number: &str, language: Language) -> Result<(), Box<Notice>> {
    let stem = format!("{}{number}", figure.name);
    shelf.put(&format!("{stem}.svg"), Word::Vector, report::figure::svg::write(figure, Title::Above, language).as_bytes())?;
    let png = png::write(figure, Title::Above, language).map_err(|error| undrawn(&stem, &error))?;
    shelf.put(&format!("{stem}.png"), Word::Picture, &png)?;
    Ok(())
}

fn with_sections(mut head: Value, sections: &[Section], language: Language) -> Value {
    if !sections.is_empty() {
        head["sections"] = sections.iter().map(|s| studies::sections::to_json(s, language)).collect();
    }
    head
}

/// All studies as one JSON object: the common fields, then each study as it would be written alone.
pub fn calculation_to_json(calculation: &Calculation, language: Language) -> Vec<u8> {
    let machine = &calculation.machine;
    let head = json!({"title": language.text(&machine.model.title), "version": VERSION, "model_hash": machine.model_hash,
        "degrees_of_freedom": machine.equations.coordinates.len()});
    let head = with_sections(head, &machine.model.sections, language);
    let mut out = head.to_string().into_bytes();
    out.pop();
    out.extend_from_slice(b",\"studies\":[\n");
    for (i, results) in calculation.results.iter().enumerate() {
        if i > 0 {
            out.extend_from_slice(b",\n");
        }
        out.extend_from_slice(&json::write(&results.data, &results.fields(), language));
    }
    out.extend_from_slice(b"]}\n");
    out
}
