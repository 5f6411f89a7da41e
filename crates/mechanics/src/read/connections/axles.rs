//! Axles that feel a belt or chain: its wheels get the couple of the tensions, not their pull.
//!
//! The sum of the tensions, the pretension of a belt, is not known: whatever holds one axle alone has a reaction without the pull. What carries both axles has
//! the whole reaction.

use super::Places;
use crate::model::{Connection, ConnectionKind, FrameId, PointRef, SupportDirection};
use crate::read::reader::Reader;
use symbolic::Graph;
use words::{Notice, Text};

/// Warns of supports and pins on such drums and wheels.
pub(in crate::read) fn warn_of_axles(reader: &mut Reader, connections: &[Connection], places: &Places) {
    for pull in connections {
        for wheel in wheels(pull) {
            let holder = connections.iter().find(|c| held(&reader.builder.graph, c, places).contains(&wheel));
            if let Some(holder) = holder {
                reader.report(warning(holder, pull, &places.frames[wheel.index()].name));
            }
        }
    }
}

/// Bodies that get a couple of a connection and not its force.
fn wheels(connection: &Connection) -> Vec<FrameId> {
    match &connection.kind {
        ConnectionKind::Wheels { between, .. } if connection.table != "gears" => between.to_vec(),
        _ => Vec::new(),
    }
}

/// Bodies whose axles a connection holds by forces: a pin elsewhere on a wheel is that of a rod.
fn held(graph: &Graph, connection: &Connection, places: &Places) -> Vec<FrameId> {
    let force = |d: &SupportDirection| matches!(d, SupportDirection::X | SupportDirection::Y | SupportDirection::Z);
    let central = |p: &&PointRef| match p {
        PointRef::Point(p) => places.points[p.index()].at.iter().all(|e| graph.is_zero(*e)),
        PointRef::Origin(_) | PointRef::Center(_) => true,
    };
    let of = |points: &[PointRef]| points.iter().filter(central).map(|p| places.frame_of(*p)).collect();
    match &connection.kind {
        ConnectionKind::Pin { between, .. } => of(between),
        ConnectionKind::Support { at, directions, .. } if directions.iter().any(force) => of(&[*at]),
        _ => Vec::new(),
    }
}

fn warning(holder: &Connection, pull: &Connection, wheel: &str) -> Notice {
    let [of, by] = [holder, pull].map(|c| format!("{}.{}", c.table, c.name));
    Notice::file(
        "M157",
        holder.span.clone(),
        Text::new(
            format!("the force of `{of}` is without the pull of `{by}`: `{wheel}` gets only its couple"),
            format!("сила `{of}` найдена без натяжения `{by}`: тело `{wheel}` получает только его момент"),
        ),
    )
    .warning()
    .why(
        "of the tensions their difference is known, not their sum: the pretension belongs to no law of the machine",
        "известна разность натяжений ветвей, но не их сумма: предварительное натяжение не следует из законов механизма",
    )
    .help(
        "support the body that carries both axles, which has the whole force, or add the pull by hand",
        "опирайте тело, несущее обе оси: на него действует полная сила; либо прибавьте натяжение сами",
    )
}
