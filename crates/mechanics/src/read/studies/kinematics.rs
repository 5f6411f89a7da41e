//! The study `kinematics`: a linkage followed over a range of one coordinate.

use super::plot::{Axis, plots_over};
use super::{angular, coordinate, outputs, points, positive};
use crate::formula::{Context, EntryKind, Kind};
use crate::model::{Kinematics, KinematicsEnd, StudyKind};
use crate::read::reader::{Fields, Reader};
use crate::units::Dimension;
use symbolic::{Expr, SymbolId};
use words::Notice;

/// A drawing of a turn needs this many positions to look smooth: one a degree.
const USUAL_POINTS: usize = 361;

pub(super) fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<StudyKind> {
    let over = coordinate(reader, fields, "over");
    let dimension = over.as_ref().and_then(|o| o.dimension);
    let is_angle = over.as_ref().is_some_and(|o| o.dimension.as_ref().is_some_and(Dimension::is_angular));
    let mut number = |key, wanted: Option<Dimension>| {
        let value = fields.formula(reader, key, &Context::CONSTANT, wanted.as_ref())?;
        reader.number(&value)
    };
    let (from, to) = (number("from", dimension), number("to", dimension));
    let rate = number("rate", dimension.map(|d| d.per_time(1)));
    let turns = number("turns", Some(Dimension::NONE));
    let points = points(reader, fields, USUAL_POINTS);
    let with = driven_too(reader, fields, over.as_ref().map(|o| o.symbol));
    let outputs = outputs(reader, fields);
    let plots = fields.get("plot").map(|v| plots_over(reader, v, Axis::Over)).unwrap_or_default();
    if rate == Some(0.0) {
        positive(reader, fields, "rate", 0.0);
    }
    let over = over?;
    let to = end(reader, fields, is_angle, (from, to, turns))?;
    Some(StudyKind::Kinematics(Kinematics { over: over.symbol, name: over.name, from, to, points, rate, with, outputs, plots }))
}

/// Exactly one of `to` and `turns`; one turn of an angle without either.
fn end<'a>(
    reader: &mut Reader<'a>,
    fields: &Fields<'a>,
    is_angle: bool,
    (from, to, turns): (Option<f64>, Option<f64>, Option<f64>),
) -> Option<KinematicsEnd> {
    match (fields.has("to"), fields.has("turns")) {
        (true, true) => {
            reader.fault(
                Notice::piece("M071", fields.span_of("turns"), "both `to` and `turns` are given", "заданы и `to`, и `turns`")
                    .help("keep one", "оставьте одно"),
            );
            None
        }
        (true, false) if to.is_some() && to == from => {
            reader.fault(Notice::piece(
                "M071",
                fields.span_of("to"),
                "the range is empty: `to` equals `from`",
                "промежуток пуст: `to` равно `from`",
            ));
            None
        }
        (true, false) => to.map(KinematicsEnd::At),
        (false, true) if !is_angle => {
            angular(reader, fields, "turns");
            None
        }
        (false, true) if turns == Some(0.0) => {
            positive(reader, fields, "turns", 0.0);
            None
        }
        (false, true) => turns.map(KinematicsEnd::Turns),
        (false, false) if is_angle => Some(KinematicsEnd::Turns(1.0)),
        (false, false) => {
            reader.fault(
                Notice::piece(
                    "M071",
                    fields.span.clone(),
                    "the study kinematics lacks the end of its range",
                    "в расчёте kinematics не задан конец промежутка",
                )
                .help("add to = \"0.3 m\"", "добавьте to = \"0,3 м\""),
            );
            None
        }
    }
}

/// `with = { psi = "2*phi" }`: further driven coordinates.
fn driven_too<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, over: Option<SymbolId>) -> Vec<(SymbolId, Expr)> {
    let mut found = Vec::new();
    for (name, span, value) in fields.rows(reader, "with") {
        let entry = reader.scope.get(name).map(|e| (e.kind, e.dimension));
        let Some((EntryKind::Coordinate(symbols), kind)) = entry else {
            let fault = super::no_coordinate(reader, name, span);
            reader.fault(fault);
            continue;
        };
        let wanted = match kind {
            Kind::Known(d) => Some(d),
            _ => None,
        };
        let Some(raw) = reader.raw(value) else { continue };
        let formula = reader.value(&raw, &Context::GEOMETRY, wanted.as_ref());
        let allowed = |s: &SymbolId| Some(*s) == over;
        let of_others = reader.coordinates_in(formula.expr).iter().any(|s| !allowed(s));
        if Some(symbols[0]) == over || formula.good && of_others {
            reader.fault(
                Notice::piece(
                    "M071",
                    value.span(),
                    "a driven coordinate is a formula of the one in `over` alone",
                    "ведомая так координата — формула только от координаты в `over`",
                )
                .help("write for example with = { phi4 = \"2*phi1\" }", "напишите, например, with = { phi4 = \"2*phi1\" }"),
            );
            continue;
        }
        found.push((symbols[0], formula.expr));
    }
    found
}
