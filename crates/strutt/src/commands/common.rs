//! What commands share: the file and the values of the line, the page, the exit code.

use crate::console::{Console, INTERRUPTED};
use crate::quantities;
use mechanics::derive::Detail;
use report::formats::Sheet;
use std::sync::atomic::Ordering;
use strutt::folder;
use strutt::wording::Word;
use studies::pipeline::{self, Calculation, Machine};
use studies::{Extent, Failure, Finds, Results, Source};

/// How a command ended that did not fail outright.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Done.
    Done = 0,
    /// The model, a check or the calculation failed; what was done is written.
    Failed = 1,
    /// Ctrl+C; what was done is written.
    Interrupted = 130,
}

/// The file, and the values of the command line that replace those in it: the variant's, then those set by hand.
pub(crate) fn inputs(model: &crate::args::Model) -> Result<(Source, Vec<(String, String)>), Failure> {
    let set = quantities::overrides(&model.overrides)?;
    let source = strutt::source::open(&model.file)?;
    let Some(variant) = &model.variant else { return Ok((source, set)) };
    let reading = studies::read(&source, &[]).map_err(|diagnostics| Failure::Findings { source: Box::new(source.clone()), diagnostics })?;
    let mut all = strutt::variants::overrides(&reading.model, &source, (variant, model.group))?;
    all.extend(set);
    Ok((source, all))
}

/// The file and the machine in it, warnings shown.
pub(crate) fn open(model: &crate::args::Model, detail: Detail, console: &mut Console) -> Result<(Source, Machine), Failure> {
    let (source, overrides) = inputs(model)?;
    let machine = console.watched(|watch| pipeline::build_in(&source, &overrides, detail, watch))?;
    console.warn(&machine.warnings, &source);
    Ok((source, machine))
}

/// A calculation on stdout in the format of pages that the command line names; figures are told in words.
pub(crate) fn page(calculation: &Calculation, console: &Console) -> Result<(), Failure> {
    let Some(page) = console.page.and_then(|format| format.page()) else { return Ok(()) };
    let document = pipeline::document(calculation, Extent::Page, console.language);
    let bytes =
        page.file(&document, &Sheet { width: console.width(), pictures: &[] }).map_err(|error| folder::undrawn("figure", &error))?;
    console.out(bytes)
}

/// Whether the file has a study that computes numbers.
pub(crate) fn has_numbers(machine: &Machine) -> bool {
    machine.model.studies.iter().any(|s| machine.origin.studies.finds(s.kind) != Finds::Formulas)
}

/// Says what ended a study early and which checks failed; decides the exit code.
pub(crate) fn judge(results: &Results, console: &Console) -> Exit {
    let data = &results.data;
    for audit in data.audits.iter().filter(|a| !a.ok) {
        let (name, number) = (console.language.text(&audit.name), |x| report::number::short(x, 2, console.language));
        let failed = console.say(Word::AuditFailed);
        console.complain(&format!("{failed} {name}: {} > {}\n", number(audit.value), number(audit.limit)));
    }
    let interrupted = INTERRUPTED.load(Ordering::Relaxed);
    if interrupted && (data.partial || results.trouble.is_some()) {
        // what an interrupted search lacks is no fault of the model
        console.complain(&format!("{}\n", console.say(Word::Interrupted)));
        return Exit::Interrupted;
    }
    if let Some(trouble) = &results.trouble {
        console.trouble(trouble);
        return Exit::Failed;
    }
    if data.audits.iter().all(|a| a.ok) { Exit::Done } else { Exit::Failed }
}

impl Exit {
    pub(crate) fn worse(self, other: Exit) -> Exit {
        if other as u8 > self as u8 { other } else { self }
    }
}
