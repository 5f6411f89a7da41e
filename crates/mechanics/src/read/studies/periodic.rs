//! The study `periodic`: what begins a period, and what is known of it.

use super::simulate::grid;
use super::{angular, constant_parameter, duration, outputs, plot::plots, tolerance, waiting};
use crate::formula::{Context, EntryKind, Kind};
use crate::model::{Periodic, Section, StudyKind};
use crate::read::reader::{Fields, Reader};
use crate::units::Dimension;
use words::Notice;

pub(super) fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<StudyKind> {
    let section = section(reader, fields);
    let period = duration(reader, fields, "period");
    let settle = waiting(reader, fields, "settle").unwrap_or(0.0);
    let wanted = duration(reader, fields, "wanted_period");
    let unknown = constant_parameter(reader, fields, "unknown");
    if fields.has("wanted_period") != fields.has("unknown") {
        reader.fault(
            Notice::piece(
                "M071",
                fields.span.clone(),
                "`unknown` and `wanted_period` go together",
                "`unknown` и `wanted_period` задают вместе",
            )
            .why("one parameter is changed until the period is the wanted one", "один параметр меняется, пока период не станет нужным")
            .help("write unknown = \"F0\" and wanted_period = \"0.2568 s\"", "напишите unknown = \"F0\" и wanted_period = \"0,2568 с\""),
        );
    }
    if !fields.has("section") && !fields.has("period") {
        reader.fault(
            Notice::piece("M071", fields.span.clone(), "the study periodic lacks `section` or `period`", "в расчёте periodic нет ни `section`, ни `period`")
                .why(
                    "a free motion returns to a section, a forced one after the period of the force",
                    "свободное движение возвращается к сечению, вынужденное — через период силы",
                )
                .help(
                    "add section = \"phi\" (an angle: one turn), section = \"x - x0\" (passes zero from below), or period = \"2*pi/Omega\"",
                    "добавьте section = \"phi\" (угол: один оборот), section = \"x - x0\" (переход через нуль снизу) или period = \"2*pi/Omega\"",
                ),
        );
    }
    let times = grid(reader, fields, None);
    let tolerance = tolerance(reader, fields);
    let outputs = outputs(reader, fields);
    let plots = fields.get("plot").map(|v| plots(reader, v)).unwrap_or_default();
    let section = section?;
    let tuned = unknown.zip(wanted);
    Some(StudyKind::Periodic(Periodic { section, period, settle, tuned, tolerance, times, outputs, plots }))
}

/// The name of an angle means turns; any other formula passes zero from below; without it time decides.
fn section<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<Section> {
    let turns = fields.formula(reader, "turns", &Context::CONSTANT, Some(&Dimension::NONE)).map(|v| reader.number(&v));
    let Some(value) = fields.get("section") else {
        if fields.has("turns") {
            angular(reader, fields, "turns");
        }
        return Some(Section::Time);
    };
    let name = value.get_ref().as_str().map(str::trim);
    if let Some(entry) = name.and_then(|n| reader.scope.get(n))
        && let (EntryKind::Coordinate(symbols), Kind::Known(d)) = (entry.kind, entry.dimension)
        && d.is_angular()
    {
        let turns = turns.map_or(Some(1.0), |t| t)?;
        if turns == 0.0 {
            super::positive(reader, fields, "turns", 0.0);
            return None;
        }
        return Some(Section::Turns { angle: symbols[0], turns });
    }
    if fields.has("turns") {
        angular(reader, fields, "turns");
    }
    let zero = fields.formula(reader, "section", &Context::SECTION, None)?;
    if zero.good && !zero.depends.is_state() {
        reader.fault(
            Notice::piece("M071", value.span(), "the section does not depend on the motion", "сечение не зависит от движения")
                .help("write the section as a formula over coordinates and rates", "задайте сечение формулой от координат и скоростей"),
        );
        return None;
    }
    zero.good.then_some(Section::Zero(zero.expr))
}
