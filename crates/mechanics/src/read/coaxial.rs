//! Springs, dampers and torsion bars between two bodies act through their relative angle. Where both bodies turn about axes that stand still and lie apart, no bar
//! lies on both: a warning.
//!
//! ```text
//! d = (O_b - O_a) - ((O_b - O_a)·u) u        distance of parallel axes through O_a and O_b along u
//! ```
//!
//! Axes are compared in the frame that carries both, the ground or a moving one; bodies whose origins move have no axis to compare.

use crate::connections::Space;
use crate::elements::{Stands, TABLE};
use crate::model::{Element, Frame, FrameId, Origin, Pathway, Reliance, Site};
use crate::reader::Reader;
use algebra::elementary;
use algebra::vectors::norm;
use words::{Notice, Text};

/// Distance of axes below which they are one, relative to their places.
const ONE: f64 = 1e-9;

/// Warns of each element between axes that lie apart.
pub(super) fn warn(reader: &mut Reader, elements: &[Element], (frames, space): (&[Frame], &Space)) {
    for element in elements.iter().filter(|e| TABLE.get(e.rank).is_some_and(|row| row.stands == Stands::Between)) {
        let Site::On(Pathway::RelativeAngle(a, b)) = element.law.sketch().site else { continue };
        let lines = [a, b].map(|frame| line(reader, (frames, space), frame));
        let [Some(first), Some(second)] = lines else { continue };
        if let Some(distance) = apart(&first, &second) {
            reader.report(warning(element, [a, b].map(|f| frames[f.index()].name.as_str()), distance));
        }
    }
}

/// An axis that stands still in a frame.
struct Line {
    carrier: FrameId,
    at: [f64; 3],
    along: [f64; 3],
}

/// The axis about which a body turns; none where it does not turn, turns about several axes, or its axis moves in what carries it.
fn line(reader: &mut Reader, (frames, space): (&[Frame], &Space), body: FrameId) -> Option<Line> {
    let mut here = body;
    // what stands on a turning body without a turn of its own turns about the axis of that body
    while here != FrameId::GROUND && !turns(reader, space, &frames[here.index()]) {
        here = frames[here.index()].on;
    }
    if here == FrameId::GROUND {
        return None;
    }
    let frame = &frames[here.index()];
    let along = own_axis(reader, space, frame)?;
    let mut line = Line { carrier: frame.on, at: origin(reader, space, frame)?, along };
    while line.carrier != FrameId::GROUND && !turns(reader, space, &frames[line.carrier.index()]) {
        let carrier = &frames[line.carrier.index()];
        let Some(from) = origin(reader, space, carrier) else { break };
        for (axis, angle) in carrier.rotations.iter().rev() {
            let angle = reader.number_of_for(*angle, Reliance::Sign)?;
            line.at = turned(line.at, axis.index(), angle);
            line.along = turned(line.along, axis.index(), angle);
        }
        (0..3).for_each(|k| line.at[k] += from[k]);
        line.carrier = carrier.on;
    }
    Some(line)
}

fn turns(reader: &Reader, space: &Space, frame: &Frame) -> bool {
    frame.spin.is_some() || frame.rotations.iter().any(|(_, angle)| !space.is_fixed(reader, *angle))
}

/// The one axis of the varying rotations, turned by the constant ones before it.
fn own_axis(reader: &mut Reader, space: &Space, frame: &Frame) -> Option<[f64; 3]> {
    let varying = frame.rotations.iter().position(|(_, angle)| !space.is_fixed(reader, *angle)).unwrap_or(frame.rotations.len());
    let rest = frame.rotations[varying..].iter().map(|(axis, _)| *axis).chain(frame.spin.map(|(axis, _)| axis));
    let axes: Vec<usize> = rest.map(crate::requests::Axis::index).collect();
    let first = *axes.first()?;
    if axes.iter().any(|axis| *axis != first) {
        return None;
    }
    let mut along = [0.0; 3];
    along[first] = 1.0;
    for (axis, angle) in frame.rotations[..varying].iter().rev() {
        along = turned(along, axis.index(), reader.number_of_for(*angle, Reliance::Sign)?);
    }
    Some(along)
}

/// The place of a frame that stands still on the one that carries it.
fn origin(reader: &mut Reader, space: &Space, frame: &Frame) -> Option<[f64; 3]> {
    let Origin::Vector(v) = &frame.origin else { return None };
    if !v.iter().all(|e| space.is_fixed(reader, *e)) {
        return None;
    }
    let [x, y, z] = v.map(|e| reader.number_of_for(e, Reliance::Sign));
    Some([x?, y?, z?])
}

/// A vector turned about an axis of coordinates.
fn turned(v: [f64; 3], axis: usize, angle: f64) -> [f64; 3] {
    let (sin, cos) = elementary::sin_cos(angle);
    let [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
    let mut w = v;
    w[i] = cos * v[i] - sin * v[j];
    w[j] = sin * v[i] + cos * v[j];
    w
}

/// The distance of two axes in one carrier; none where they are one, or not parallel.
fn apart(a: &Line, b: &Line) -> Option<f64> {
    let dot = |v: &[f64; 3], w: &[f64; 3]| -> f64 { v.iter().zip(w).map(|(v, w)| v * w).sum() };
    if a.carrier != b.carrier || dot(&a.along, &b.along).abs() < 1.0 - ONE {
        return None;
    }
    let between: [f64; 3] = std::array::from_fn(|k| b.at[k] - a.at[k]);
    let along = dot(&between, &a.along);
    let across: [f64; 3] = std::array::from_fn(|k| between[k] - along * a.along[k]);
    let distance = norm(&across);
    (distance > ONE * norm(&a.at).max(norm(&b.at))).then_some(distance)
}

fn warning(element: &Element, [a, b]: [&str; 2], distance: f64) -> Notice {
    let (path, d) = (&element.path, words::digits::rounded(distance));
    Notice::file(
        "M384",
        element.span.clone(),
        Text::new(
            format!("`{path}` joins `{a}` and `{b}`, which turn about axes {} m apart", d.en),
            format!("`{path}` соединяет `{a}` и `{b}`, оси вращения которых удалены на {} м", d.ru),
        ),
    )
    .warning()
    .why(
        "it passes a torque along one axis; between axes apart something else would have to carry it, and take the forces that go with it",
        "такой элемент передаёт момент вдоль одной оси; между разными осями момент должно передавать что-то ещё, и при этом возникают силы",
    )
    .help(
        "put both bodies on one axis, or join them by [gears], [belts], [chains] or springs between points; the torque acts on the relative angle as it stands",
        "поставьте оба тела на одну ось либо соедините их через [gears], [belts], [chains] или пружины между точками; пока момент действует по относительному углу",
    )
}
