//! What the commands of the studies share: a study from the file or the command line, and showing what it found.

use super::{Exit, judge};
use crate::args;
use crate::console::{Console, Shape};
use crate::quantities;
use mechanics::derive::Detail;
use mechanics::model::{StudyKind, Times};
use mechanics::units::Dimension;
use std::path::Path;
use strutt::pipeline::{self, Calculation, Finding, Machine};
use strutt::wording::Word;
use strutt::{Failure, Source, document, folder};
use words::{Notice, Place};

/// The machine of a file, with a study that the command line writes behind the file when it asks for one: so its formulas are read and checked as
/// those of the file are. The study of this kind that counts, if there is one.
pub fn open<T>(
    model: &args::Model,
    written: Option<String>,
    pick: impl Fn(&StudyKind) -> Option<T>,
    out: Option<&Path>,
    console: &mut Console,
) -> Result<(Machine, Option<T>), Failure> {
    // a page shows the written derivation
    let detail = if out.is_some() { Detail::Steps } else { Detail::Equations };
    let (source, overrides) = super::inputs(model)?;
    let text = match &written {
        Some(study) => format!("{}\n\n[[study]]\n{study}", source.text.trim_end()),
        None => source.text.clone(),
    };
    let extended = Source { path: source.path.clone(), text };
    let built = console.watched(|watch| pipeline::build_in(&extended, &overrides, detail, watch));
    let mut machine = built.map_err(|failure| placed(failure, &source, &extended))?;
    machine.warnings.iter_mut().for_each(|d| place(d, &source, &extended));
    machine.model_hash = source.hash(&overrides);
    console.warn(&machine.warnings, &extended);
    let kinds = machine.model.studies.iter().map(|s| &s.kind);
    let found = if written.is_some() { kinds.rev().find_map(pick) } else { kinds.into_iter().find_map(pick) };
    Ok((machine, found))
}

/// Findings in the study that the command line wrote behind the file are findings on the command line.
fn placed(failure: Failure, file: &Source, extended: &Source) -> Failure {
    match failure {
        Failure::Findings { source, mut diagnostics } => {
            diagnostics.iter_mut().for_each(|d| place(d, file, extended));
            Failure::Findings { source, diagnostics }
        }
        other => other,
    }
}

fn place(diagnostic: &mut Notice, file: &Source, extended: &Source) {
    let Some(span) = diagnostic.span().filter(|s| s.start >= file.text.trim_end().len() && extended.text.len() > file.text.len()) else {
        return;
    };
    let text = &extended.text;
    let start = text[..span.start.min(text.len())].rfind('\n').map_or(0, |i| i + 1);
    let line = text[start..].lines().next().unwrap_or_default().to_owned();
    let within = |at: usize| at.saturating_sub(start).min(line.len());
    let span = within(span.start)..within(span.end);
    diagnostic.place = Place::CommandLine { text: line, span };
}

/// A row `key = "value"` of a study, quoted for TOML.
pub fn row(key: &str, value: &str) -> String {
    format!("{key} = {}\n", toml_string(value))
}

/// A basic string of TOML.
pub fn toml_string(text: &str) -> String {
    let escaped: String = text
        .chars()
        .map(|c| match c {
            '"' => "\\\"".to_owned(),
            '\\' => "\\\\".to_owned(),
            c if c.is_control() => format!("\\u{:04X}", u32::from(c)),
            c => c.to_string(),
        })
        .collect();
    format!("\"{escaped}\"")
}

/// Times that the command line asks for.
pub fn times(table: &args::Table) -> Result<Option<Times>, Failure> {
    Ok(match (&table.at, &table.every) {
        (Some(at), _) => Some(Times::At(quantities::times("--at", at)?)),
        (None, Some(every)) => Some(Times::Every(quantities::step("--every", every)?)),
        (None, None) => None,
    })
}

/// Dimension of a coordinate, by its name.
pub fn dimension_of(coordinate: &str, machine: &Machine) -> Dimension {
    let found = machine.model.coordinates.iter().find(|c| c.name == coordinate);
    found.and_then(|c| mechanics::units::parse_unit(&c.units[0]).ok()).map_or(Dimension::NONE, |u| u.dimension)
}

/// Columns that the command line asks for.
pub fn columns(table: &args::Table) -> Option<Vec<String>> {
    let clean = |list: &Vec<String>| list.iter().map(|name| name.trim().to_owned()).filter(|name| !name.is_empty()).collect();
    table.outputs.as_ref().map(clean)
}

/// Shows what was found, writes the folder when one is wanted, decides the exit code.
pub fn finish(machine: Machine, finding: Finding, out: Option<&Path>, console: &mut Console) -> Result<Exit, Failure> {
    let title = console.language.text(&machine.model.title).to_owned();
    console.timed(Word::TimeWrite, |console| show(&title, &finding, out, console))?;
    let exit = judge(&finding, console);
    if let Some(out) = out {
        let mut calculation = Calculation { machine, findings: vec![finding], files: Vec::new() };
        let language = console.language;
        let paths = console.timed(Word::TimeWrite, |_| folder::write(&mut calculation, out, language))?;
        let list: String = paths.iter().map(|p| format!("\n  {}", p.display())).collect();
        console.talk(&format!("{}{list}", console.say(Word::Written)));
    }
    Ok(exit)
}

fn show(title: &str, finding: &Finding, out: Option<&Path>, console: &Console) -> Result<(), Failure> {
    let (data, language) = (finding.data(), console.language);
    match console.shape {
        Shape::Json => console.out(report::json::write(data, &folder::own_fields(finding), language)),
        Shape::Csv => console.out(report::csv::write(data, report::csv::Dialect::Plain)),
        Shape::Text if out.is_some() && !console.terminal => Ok(()),
        // a study that failed before it found anything leaves no empty heading
        Shape::Text if is_nothing(finding) => Ok(()),
        Shape::Text => {
            let blocks = match finding {
                Finding::Study(results) => document::of_results(results, false, language),
                _ => Vec::new(),
            };
            console.out(document::in_terminal(title, blocks, language, console.width()))
        }
    }
}

fn is_nothing(finding: &Finding) -> bool {
    let empty = |r: &strutt::studies::Results| r.facts.is_empty() && r.words.is_empty() && r.data.columns.is_empty() && r.claims.is_empty();
    matches!(finding, Finding::Study(results) if results.trouble.is_some() && empty(results))
}
