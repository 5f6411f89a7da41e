//! Axles that feel a rope or a belt: drums and pulleys get the couple of the tension, not its pull.
//!
//! A rope pulls at the points of its path. Where none of them belongs to the drum, the drum turns as it should, and whatever holds its axle alone has a
//! reaction without the pull. The sum of the tensions of a belt, its pretension, is not known at all. What carries the axle and the points together has the
//! whole reaction.

use super::Places;
use crate::diagnostic::Diagnostic;
use crate::model::{Connection, ConnectionKind, FrameId, PointRef, SupportDirection};
use crate::read::reader::Reader;
use symbolic::Text;

/// Warns of supports and pins on such drums and wheels.
pub(in crate::read) fn warn_of_axles(reader: &mut Reader, connections: &[Connection], places: &Places) {
    for pull in connections {
        for wheel in wheels(pull, places) {
            let holds = |c: &&Connection| held(c, places).contains(&wheel);
            if let Some(holder) = connections.iter().find(holds) {
                reader.report(warning(holder, pull, &places.frames[wheel.index()].name));
            }
        }
    }
}

/// Bodies that get a couple of a connection and not its force.
fn wheels(connection: &Connection, places: &Places) -> Vec<FrameId> {
    match &connection.kind {
        ConnectionKind::Wheels { between, .. } if connection.table != "gears" => between.to_vec(),
        ConnectionKind::Rope { path, wound, .. } if !path.is_empty() => {
            let ends = [path[0], path[path.len() - 1]].map(|p| places.frame_of(p));
            wound.iter().map(|drum| drum.on).filter(|on| !ends.contains(on)).collect()
        }
        _ => Vec::new(),
    }
}

/// Bodies whose places a connection holds by forces.
fn held(connection: &Connection, places: &Places) -> Vec<FrameId> {
    let force = |d: &SupportDirection| matches!(d, SupportDirection::X | SupportDirection::Y | SupportDirection::Z);
    let of = |points: &[PointRef]| points.iter().map(|p| places.frame_of(*p)).collect();
    match &connection.kind {
        ConnectionKind::Pin { between, .. } => of(between),
        ConnectionKind::Support { at, directions, .. } if directions.iter().any(force) => of(&[*at]),
        _ => Vec::new(),
    }
}

fn warning(holder: &Connection, pull: &Connection, wheel: &str) -> Diagnostic {
    let [of, by] = [holder, pull].map(|c| format!("{}.{}", c.table, c.name));
    Diagnostic::warning(
        "M157",
        holder.span.clone(),
        Text::new(
            format!("the force of `{of}` is without the pull of `{by}`: `{wheel}` gets only its couple"),
            format!("сила `{of}` найдена без натяжения `{by}`: тело `{wheel}` получает только его момент"),
        ),
    )
    .why(Text::new(
        "a rope pulls at the points of its path, none of which is a point of the drum; the pretension of a belt is not known",
        "канат тянет за точки своего пути, ни одна из которых не принадлежит барабану; предварительное натяжение ремня неизвестно",
    ))
    .help(Text::new(
        "let one body carry the axle and the points of the path: its supports have the whole force; or add the pull by hand",
        "пусть ось и точки пути несёт одно тело: его опоры имеют полную силу; либо прибавьте натяжение сами",
    ))
}
