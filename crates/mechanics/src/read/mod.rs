//! Model file to [`Model`]: every table in turn, all findings collected.
//!
//! Order: names of coordinates, parameters by dependence, start values, frames and points by dependence, elements and loads,
//! connections, outputs by dependence, studies. A faulty value becomes zero of unknown dimension, so that one slip gives one message.

mod answers;
mod claims;
mod coaxial;
mod connections;
mod cover;
mod events;
mod frames;
mod order;
mod outputs;
mod overrides;
mod parameters;
mod phases;
mod plane;
mod ranges;
mod raw;
mod regimes;
mod report;
mod sections;
mod shapes;
mod structures;
mod studies;
mod unknowns;
mod variants;

pub use crate::reader::MAX_FINDINGS;
pub use overrides::split as split_override;
pub use ranges::{sweep_range, sweep_stretch};
pub use shapes::SHAPES;

use crate::asked::Kinds;
use crate::elements;
use crate::fields;
use crate::formula::KINEMATIC_FUNCTIONS;
use crate::model::{Connection, CoordinateDecl, Element, Frame, Model, ParameterDecl, Point, Premise};
use crate::reader::syntax;
use crate::reader::{Fields, Reader};
use crate::section::Section;
use crate::structure::Structure;
use std::collections::HashSet;
use symbolic::{Expr, SymbolId};
use words::{Notice, Severity, Text, notice};

/// Largest model file, bytes.
pub const MAX_FILE: usize = 4 << 20;

/// What reading a model file gives.
#[derive(Clone, Debug)]
pub struct Reading {
    /// The model.
    pub model: Model,
    /// Findings that do not prevent its use.
    pub warnings: Vec<Notice>,
}

/// Reads a model file. `file` is its path, used only to name a model without a title. `overrides` are (name, quantity) pairs as given
/// by `--set name=quantity`: a parameter (also one with a formula), the start of a coordinate (`phi`), or its rate (`phi'`).
///
/// # Errors
/// All findings, sorted by place in the file; at least one of them is an error.
pub fn read(text: &str, file: &str, overrides: &[(String, String)]) -> Result<Reading, Vec<Notice>> {
    read_asking(text, (file, None), overrides)
}

/// The same with the studies that the file asks for; without their kinds they are passed over.
///
/// # Errors
/// As [`read`].
pub fn read_with(text: &str, file: &str, overrides: &[(String, String)], kinds: &Kinds) -> Result<Reading, Vec<Notice>> {
    read_asking(text, (file, Some(kinds)), overrides)
}

fn read_asking(text: &str, (file, kinds): (&str, Option<&Kinds>), overrides: &[(String, String)]) -> Result<Reading, Vec<Notice>> {
    if text.len() > MAX_FILE {
        let size = text.len() / 1024;
        let fault = Notice::piece(
            "M001",
            0..0,
            format!("the file has {size} KiB; the limit is {} KiB", MAX_FILE / 1024),
            format!("размер файла {size} КиБ; предел {} КиБ", MAX_FILE / 1024),
        );
        return Err(vec![crate::snippet::Site::Literal(0).diagnose(fault)]);
    }
    let (root, syntax) = syntax::parse(text);
    let Some(root) = root else { return Err(finish(syntax)) };
    let broken = !syntax.is_empty();
    let mut reader = Reader::new(text, overrides, KINEMATIC_FUNCTIONS.iter().chain(elements::functions()).collect());
    let model = model(&mut reader, &root, (file, kinds));
    let mut findings = reader.into_diagnostics();
    if broken {
        findings.retain(|d| !syntax::FOLLOW_UPS.contains(&d.code));
    }
    findings.extend(syntax);
    if findings.iter().any(|d| d.severity == Severity::Error) {
        return Err(finish(findings));
    }
    Ok(Reading { model, warnings: finish(findings) })
}

fn finish(mut findings: Vec<Notice>) -> Vec<Notice> {
    notice::sort(&mut findings);
    if findings.len() > MAX_FINDINGS {
        let more = findings.len() - MAX_FINDINGS;
        let errors = findings[MAX_FINDINGS..].iter().any(|d| d.severity == Severity::Error);
        findings.truncate(MAX_FINDINGS);
        let place = findings.last().and_then(Notice::span).unwrap_or(0..0);
        let mut last = Notice::file(
            "M016",
            place,
            Text::new(format!("{more} more findings are not listed"), format!("ещё замечаний, не вошедших в список: {more}")),
        )
        .warning();
        if errors {
            last.severity = Severity::Error;
        }
        findings.push(last);
    }
    findings
}

fn model<'a>(reader: &mut Reader<'a>, root: &'a syntax::Table<'a>, (file, kinds): (&str, Option<&Kinds>)) -> Model {
    let top = Fields::open(reader, &fields::TOP, root, 0..0, String::new());
    let title = top.text(reader, "title").unwrap_or_else(|| Text::same(name_of(file)));
    let description = top.text(reader, "description").unwrap_or_default();
    let mut notation = Vec::new();

    let Quantities { mut parameters, coordinates, outputs, mut schedule, phases } = quantities(reader, &top, &mut notation);
    let Machine { frames, points, sections, gravity, mut elements, connections } = machine(reader, &top, (&parameters, &coordinates));
    let acting = reader.builder.used.clone();
    let outputs = outputs::resolve(reader, outputs);
    let events = events::read(reader, &top);
    let regimes = regimes::read(reader, &top);
    let claims = claims::read(reader, &top);
    let mut structure = structure(reader, &top, gravity.structure, (&coordinates, &acting));
    let loads = phases::Loads { elements: &mut elements, on_structure: structure.iter_mut().flat_map(|s| &mut s.loads).collect() };
    parameters.extend(schedule.restart(reader, &parameters, loads, &mut notation));
    let (studies, of_studies) = reader.apart(|reader| kinds.map(|kinds| studies::read(reader, &top, kinds)).unwrap_or_default());
    let (variants, answers) = variants::read(reader, &top, &parameters);
    let (report, impacts) = (report::read(reader, &top), connections::impacts(reader, &top));

    let mut unknowns = unknowns::check(reader, &top, &parameters);
    let impending = unknowns::impending(reader, &top, &connections, (&unknowns, &studies));
    let rests = reader.take_rests();
    unknowns.extend(rests.iter().map(|p| p.symbol));
    parameters.extend(rests);
    let (premises, of_studies) = premises(reader, of_studies);
    let builder = reader.take_builder();
    parameters.retain(|p| p.span.is_some() || p.name != "g" || builder.used.contains(&p.symbol));
    Model {
        title,
        description,
        time: builder.time,
        graph: builder.graph,
        requests: builder.requests,
        gravity: gravity.bodies,
        parameters,
        coordinates,
        frames,
        points,
        elements,
        connections,
        outputs,
        events,
        observed: std::mem::take(&mut reader.observed),
        regimes,
        claims,
        notation,
        sections,
        phases,
        unknowns,
        impending,
        impacts,
        restarts: schedule.restarts,
        studies,
        structure,
        inertias: Vec::new(),
        variants,
        answers,
        report,
        scaled: std::mem::take(&mut reader.scaled),
        premises,
        of_studies,
    }
}

/// What numbers of the model rest on, those of studies last; and what only studies rest on.
fn premises(reader: &mut Reader<'_>, mut of_studies: Vec<Premise>) -> (Vec<Premise>, Vec<Premise>) {
    let mut premises = reader.premises();
    of_studies.retain(|p| !premises.contains(p));
    premises.extend(&of_studies);
    (premises, of_studies)
}

/// What formulas name: parameters, coordinates, and the outputs before their formulas are checked.
struct Quantities<'a> {
    parameters: Vec<ParameterDecl>,
    coordinates: Vec<CoordinateDecl>,
    outputs: Vec<outputs::RawOutput<'a>>,
    schedule: phases::Schedule<'a>,
    /// Ends of the phases.
    phases: Vec<f64>,
}

fn quantities<'a>(reader: &mut Reader<'a>, top: &Fields<'a>, notation: &mut Vec<(String, String)>) -> Quantities<'a> {
    let mut coordinates = parameters::collect_coordinates(reader, top, notation);
    coordinates.extend(parameters::collect_displacements(reader, top, notation));
    let raw = parameters::collect(reader, top, notation);
    let names = raw.iter().map(|p| p.name.clone()).collect();
    let outputs = outputs::collect(reader, top, &names, notation);
    let mut schedule = phases::collect(reader, top);
    schedule.check_names(reader, &coordinates, &raw);
    overrides::check_names(reader, &coordinates, &raw, &schedule);
    parameters::declare_coordinates(reader, &coordinates);
    let parameters = parameters::resolve(reader, raw, &mut schedule);
    let phases = schedule.finish(reader);
    let coordinates = parameters::starts(reader, coordinates);
    Quantities { parameters, coordinates, outputs, schedule, phases }
}

/// What stands in the machine and what acts on it.
struct Machine {
    frames: Vec<Frame>,
    points: Vec<Point>,
    sections: Vec<Section>,
    gravity: frames::Gravity,
    elements: Vec<Element>,
    connections: Vec<Connection>,
}

fn machine<'a>(reader: &mut Reader<'a>, top: &Fields<'a>, (parameters, coordinates): (&[ParameterDecl], &[CoordinateDecl])) -> Machine {
    let (frames, mut points) = frames::read(reader, top);
    let sections = sections::read(reader, top);
    structures::nodes(reader, top, &sections);
    structures::rods(reader, top);
    let gravity = frames::gravity(reader, top, &frames);
    connections::announce(reader, top);
    let mut elements = elements::read(reader, top, &structures::takes);
    let space = crate::connections::Space::new(reader, &frames, &points, parameters);
    let connections = connections::read(reader, top, &space);
    let places_of = connections::Places { frames: &frames, points: &points, coordinates };
    connections::warn(reader, &connections, &places_of);
    coaxial::warn(reader, &elements, (&frames, &space));
    let (resultants, places) = connections::distributed(reader, top, &space, points.len());
    elements.extend(resultants);
    points.extend(places);
    Machine { frames, points, sections, gravity, elements, connections }
}

/// The structure of nodes and rods under its weight; its displacements are loaded by what formulas of elements have used.
fn structure<'a>(
    reader: &mut Reader<'a>,
    top: &Fields<'a>,
    gravity: Option<[Expr; 3]>,
    (coordinates, acting): (&[CoordinateDecl], &HashSet<SymbolId>),
) -> Option<Structure> {
    if let Some(acceleration) = gravity {
        plane::weight(reader, top, acceleration);
    }
    let mut structure = structures::read(reader, top);
    for d in structure.iter_mut().flat_map(|s| &mut s.displacements) {
        d.loaded = coordinates.iter().any(|c| c.name == d.name && c.symbols.iter().any(|s| acting.contains(s)));
    }
    structure
}

/// `gallery/pendulum/model.toml` is called pendulum, `top.toml` top.
fn name_of(file: &str) -> String {
    let mut parts = file.rsplit(['/', '\\']);
    let stem = parts.next().unwrap_or_default();
    let stem = stem.rsplit_once('.').map_or(stem, |(s, _)| s);
    match parts.next() {
        Some(folder) if stem == "model" && !folder.is_empty() => folder.to_owned(),
        _ => stem.to_owned(),
    }
}

#[cfg(test)]
mod tests;
