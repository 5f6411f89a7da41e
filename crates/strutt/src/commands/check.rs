//! `strutt check FILE`: all findings, or a summary.

use super::{Exit, inputs};
use crate::args::{self, Format};
use crate::console::{Console, quoted};
use serde_json::json;
use strutt::diagnostics;
use strutt::wording::Word;
use studies::Failure;
use studies::pipeline::{self, Machine};

pub fn run(args: &args::Check, console: &mut Console) -> Result<Exit, Failure> {
    let (source, overrides) = inputs(&args.model)?;
    let machine = match console.watched(|watch| pipeline::build(&source, &overrides, watch)) {
        Ok(machine) => machine,
        Err(Failure::Findings { diagnostics, .. }) if args.format == Format::Short && console.tree().is_none() => {
            console.out(diagnostics::short(&diagnostics, &source, console.language))?;
            return Ok(Exit::Failed);
        }
        Err(failure) => return Err(failure),
    };
    if let Some(tree) = console.tree() {
        let findings = diagnostics::to_json(&machine.warnings, &source, console.language);
        let value = json!({"ok": true, "file": source.path, "title": console.language.text(&machine.model.title),
            "model_hash": machine.model_hash, "findings": findings, "counts": counts(&machine), "notes": notes(&machine, console)});
        console.out((tree.value)(&value))?;
        return Ok(Exit::Done);
    }
    match args.format {
        Format::Full => console.warn(&machine.warnings, &source),
        Format::Short => console.out(diagnostics::short(&machine.warnings, &source, console.language))?,
    }
    console.out(format!("{}: {}: {}\n", source.path, console.say(Word::Ok), summary(&machine, console)))?;
    for note in notes(&machine, console) {
        console.out(format!("{note}\n"))?;
    }
    console.next(&format!("strutt run {}", quoted(&args.model.file)));
    Ok(Exit::Done)
}

/// Remarks of the assembly: start values that were moved, conditions left out.
fn notes(machine: &Machine, console: &Console) -> Vec<String> {
    use analysis::System;
    machine.system.notes().iter().map(|note| console.language.text(note).to_owned()).collect()
}

/// Word for people, key for machines, number.
fn rows(machine: &Machine) -> [(Word, &'static str, usize); 6] {
    let model = &machine.model;
    [
        (Word::Bodies, "bodies", model.frames.iter().filter(|f| f.is_body).count()),
        (Word::Coordinates, "coordinates", model.coordinates.len()),
        (Word::Parameters, "parameters", model.parameters.len()),
        (Word::Outputs, "outputs", model.outputs.len()),
        (Word::Studies, "studies", model.studies.len()),
        (Word::Sections, "sections", model.sections.len()),
    ]
}

fn summary(machine: &Machine, console: &Console) -> String {
    // what few models have is told only where it is
    let rows = rows(machine).into_iter().filter(|(word, _, n)| *n > 0 || *word != Word::Sections);
    rows.map(|(word, _, n)| format!("{} {n}", console.say(word))).collect::<Vec<_>>().join(", ")
}

fn counts(machine: &Machine) -> serde_json::Value {
    rows(machine).iter().map(|(_, key, n)| ((*key).to_owned(), json!(n))).collect::<serde_json::Map<_, _>>().into()
}
