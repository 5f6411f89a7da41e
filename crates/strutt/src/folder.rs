//! The folder of results: tables, plots and the page.

use crate::diagnostics;
use crate::document::{self, Extent};
use crate::pipeline::{self, Calculation, Finding};
use crate::shelf::Shelf;
use crate::source::Source;
use crate::variants;
use crate::wording::Word;
use analysis::Dataset;
use analysis::dataset::Column;
use mechanics::Model;
use mechanics::section::Section;
use report::{Figure, csv, json, page};
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};
use words::{Language, Notice};

/// Writes everything about a calculation into a folder; returns the paths, the page last.
///
/// # Errors
/// A result would replace an input (C052), or the disk refuses (C005); then nothing is written.
pub fn write(calculation: &mut Calculation, folder: &Path, language: Language) -> Result<Vec<PathBuf>, Box<Notice>> {
    let inputs = inputs(&calculation.machine.origin.source, &calculation.machine.model);
    let mut shelf = Shelf::open(folder, &inputs)?;
    let several = calculation.findings.len() > 1;
    for (i, finding) in calculation.findings.iter().enumerate() {
        let number = if several { format!("-{}", i + 1) } else { String::new() };
        let stem = match finding {
            Finding::Motion(..) => format!("motion{number}"),
            Finding::Transient(..) => format!("transient{number}"),
            Finding::Equilibrium(..) => format!("equilibrium{number}"),
            Finding::Study(results) => format!("{}{number}", results.kind),
            Finding::Modes(..) => format!("modes{number}"),
            Finding::Structure(found) => format!("{}{number}", found.study),
            Finding::Response(..) => format!("response{number}"),
        };
        tables(&mut shelf, finding, &stem, language)?;
        if let Finding::Motion(study, data, _) | Finding::Transient(study, data, ..) = finding {
            for figure in document::figures(calculation, study, data, language) {
                plot(&mut shelf, &figure, &number, language)?;
            }
            if let Some(bands) = crate::contacts::bands(data, language) {
                let svg = report::figure::bands::write(&bands, true, language);
                shelf.put(&format!("{}{number}.svg", bands.name), Word::Vector, svg.as_bytes())?;
            }
        }
        for figure in document::other_figures(finding, language) {
            plot(&mut shelf, &figure, &number, language)?;
        }
    }
    section_files(&mut shelf, &calculation.machine.model.sections, language)?;
    calculation.files = shelf.names.clone();
    let document = pipeline::document(calculation, Extent::Page, language);
    shelf.put(
        "index.html",
        Word::Page,
        page::write(&document, page::Options { math_font: Some(report::formula::MATH_FONT) }).as_bytes(),
    )?;
    shelf.close()
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
    shelf.put("sections.csv", Word::SectionTable, crate::sections::to_csv(sections).as_bytes())?;
    for section in sections {
        plot(shelf, &crate::sections::figure(section, language), "", language)?;
    }
    Ok(())
}

fn tables(shelf: &mut Shelf, finding: &Finding, stem: &str, language: Language) -> Result<(), Box<Notice>> {
    let data = finding.data();
    shelf.put(&format!("{stem}.csv"), Word::Table, &csv::write(data, csv::Dialect::Plain))?;
    if data.events.iter().any(|e| !e.name.is_empty()) {
        shelf.put(&format!("{stem}-events.csv"), Word::EventTable, &csv::write_events(data, csv::Dialect::Plain, language))?;
    }
    if language == Language::Ru {
        shelf.put(&format!("{stem}-excel.csv"), Word::TableRu, &csv::write(data, csv::Dialect::Ru))?;
    }
    shelf.put(&format!("{stem}.json"), Word::AllData, &json::write(data, &own_fields(finding), language))
}

fn plot(shelf: &mut Shelf, figure: &Figure, number: &str, language: Language) -> Result<(), Box<Notice>> {
    let stem = format!("{}{number}", figure.name);
    shelf.put(&format!("{stem}.svg"), Word::Vector, report::figure::svg::write(figure, true, language).as_bytes())?;
    let png = report::figure::png::write(figure, true, language).map_err(|error| {
        Box::new(Notice::new("C005", format!("cannot draw {stem}.png: {error}"), format!("не удаётся нарисовать {stem}.png: {error}")))
    })?;
    shelf.put(&format!("{stem}.png"), Word::Picture, &png)
}

/// The fields of a study that are not common to all.
pub fn own_fields(finding: &Finding) -> Map<String, Value> {
    let mut own = Map::new();
    match finding {
        Finding::Motion(study, ..) => {
            own.insert("study".into(), json!("simulate"));
            own.insert("until".into(), json!(study.until));
            own.insert("tolerance".into(), json!(study.tolerance));
            own.insert("method".into(), json!(study.method.name()));
        }
        Finding::Transient(study, _, phases, _) => {
            own.insert("study".into(), json!("transient"));
            own.insert("until".into(), json!(study.until));
            own.insert("phases".into(), crate::phases::to_json(phases));
        }
        Finding::Equilibrium(..) => {
            own.insert("study".into(), json!("equilibrium"));
            own.insert("equilibria".into(), equilibria(finding.data()));
        }
        Finding::Study(results) => own = results.fields(),
        Finding::Response(found) => own = crate::small::response::to_json(found),
        Finding::Modes(found) => own = crate::small::modes::to_json(found),
        Finding::Structure(found) => own = crate::structure::fields(found),
    }
    if let Some(trouble) = finding.trouble() {
        own.insert("fault".into(), diagnostics::trouble_to_json(trouble, Language::En));
    }
    own
}

/// `{coordinates: {phi: 0.1}, stable: true, residual: 1e-16, outputs: {N: 3}}` for each; `stable` is null where linearisation does not decide.
fn equilibria(data: &Dataset) -> Value {
    let n = data.columns.first().map_or(0, |c| c.values.len());
    // what is not there is null
    let at = |name: &str, row: usize| data.column(name).map_or(f64::NAN, |c| c.values[row]);
    // coordinates and reactions come first, then the residual, then what follows from them
    let first = data.columns.iter().position(|c| c.quantity.name == "residual").unwrap_or(data.columns.len());
    let listed = |columns: &[Column], row: usize| -> Map<String, Value> {
        let own = columns.iter().filter(|c| !is_verdict(&c.quantity.name) && !is_reaction(&c.quantity.name));
        own.map(|c| (c.quantity.name.clone(), json!(c.values[row]))).collect()
    };
    let place = |row: usize| {
        let coordinates = listed(&data.columns[..first], row);
        let stable = at("stable", row);
        let stable = if stable.is_nan() { Value::Null } else { json!(stable != 0.0) };
        let mut out = json!({"coordinates": coordinates, "stable": stable, "residual": at("residual", row)});
        let outputs = listed(&data.columns[first..], row);
        if !outputs.is_empty() {
            out["outputs"] = json!(outputs);
        }
        let reactions = data.columns[..first].iter().filter(|c| is_reaction(&c.quantity.name));
        let reactions: Map<String, Value> = reactions.map(|c| (c.quantity.name.clone(), json!(c.values[row]))).collect();
        if !reactions.is_empty() {
            out["reactions"] = json!(reactions);
        }
        if data.column("growth").is_some() {
            let (growth, negative) = (at("growth", row), at("negative_directions", row));
            out["growth"] = json!(growth);
            out["negative_directions"] = json!(negative);
            out["stable_by_energy"] = if negative.is_nan() { Value::Null } else { json!(negative == 0.0) };
            out["stable_by_eigenvalues"] = if growth.is_nan() { Value::Null } else { json!(growth <= 1e-9) };
        }
        out
    };
    (0..n).map(place).collect()
}

/// Columns of an equilibrium that are reactions: `force(AB)`.
fn is_reaction(name: &str) -> bool {
    name.contains('(')
}

/// Columns of an equilibrium that are no coordinates.
pub fn is_verdict(name: &str) -> bool {
    matches!(name, "residual" | "stable" | "growth" | "negative_directions")
}

fn with_sections(mut head: Value, sections: &[Section], language: Language) -> Value {
    if !sections.is_empty() {
        head["sections"] = sections.iter().map(|s| crate::sections::to_json(s, language)).collect();
    }
    head
}

/// All studies as one JSON object: the common fields, then each study as it would be written alone.
pub fn calculation_to_json(calculation: &Calculation, language: Language) -> Vec<u8> {
    let machine = &calculation.machine;
    let head = json!({"title": language.text(&machine.model.title), "version": crate::VERSION, "model_hash": machine.model_hash,
        "degrees_of_freedom": machine.equations.coordinates.len()});
    let head = with_sections(head, &machine.model.sections, language);
    let mut out = head.to_string().into_bytes();
    out.pop();
    out.extend_from_slice(b",\"studies\":[\n");
    for (i, finding) in calculation.findings.iter().enumerate() {
        if i > 0 {
            out.extend_from_slice(b",\n");
        }
        out.extend_from_slice(&json::write(finding.data(), &own_fields(finding), language));
    }
    out.extend_from_slice(b"]}\n");
    out
}
