//! The study `cycle`: energy balance of a machine over one turn of its main shaft.

use super::plot::{Axis, plots_over};
use super::{constant_parameter, coordinate, duration, points, positive};
use crate::formula::Context;
use crate::model::{Cycle, StudyKind};
use crate::read::reader::{Fields, Reader};
use crate::units::Dimension;
use std::f64::consts::TAU;
use words::Notice;

/// One position a degree.
const USUAL_POINTS: usize = 361;

pub(super) fn read<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<StudyKind> {
    let angle = coordinate(reader, fields, "angle");
    if let Some(found) = &angle
        && found.dimension.as_ref().is_some_and(|d| !d.is_angular())
    {
        super::angular(reader, fields, "angle");
    }
    let turns = fields.formula(reader, "turns", &Context::CONSTANT, Some(&Dimension::NONE)).map_or(Some(1.0), |v| reader.number(&v));
    if turns == Some(0.0) {
        positive(reader, fields, "turns", 0.0);
    }
    let turns = turns?;
    let speed = speed(reader, fields, turns);
    let unknown = constant_parameter(reader, fields, "unknown");
    let flywheel = constant_parameter(reader, fields, "flywheel");
    let irregularity = fields.formula(reader, "irregularity", &Context::CONSTANT, Some(&Dimension::NONE)).and_then(|v| reader.number(&v));
    if let Some(value) = irregularity.filter(|v| !(*v > 0.0 && *v < 2.0)) {
        positive(reader, fields, "irregularity", value);
    }
    if flywheel.is_some() && irregularity.is_none() {
        reader.fault(
            Notice::piece("M071", fields.span_of("flywheel"), "`flywheel` needs `irregularity`", "ключу `flywheel` нужна `irregularity`")
                .help("add irregularity = 0.02", "добавьте irregularity = 0.02"),
        );
    }
    let points = points(reader, fields, USUAL_POINTS);
    let plots = fields.get("plot").map(|v| plots_over(reader, v, Axis::Over)).unwrap_or_default();
    let angle = angle?;
    Some(StudyKind::Cycle(Cycle { angle: angle.symbol, name: angle.name, turns, speed, unknown, irregularity, flywheel, points, plots }))
}

/// The uniform rate: `speed`, or the turns of a cycle in a `period`.
fn speed<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, turns: f64) -> Option<f64> {
    let speed = fields.formula(reader, "speed", &Context::CONSTANT, Some(&Dimension::ANGULAR_RATE)).and_then(|v| reader.number(&v));
    let period = duration(reader, fields, "period");
    if fields.has("speed") && fields.has("period") {
        reader.fault(
            Notice::piece("M071", fields.span_of("period"), "both `speed` and `period` are given", "заданы и `speed`, и `period`")
                .help("keep one", "оставьте одно"),
        );
    }
    if speed == Some(0.0) {
        positive(reader, fields, "speed", 0.0);
    }
    speed.or(period.map(|p| TAU * turns / p))
}
