//! The picture of a frame; items that move carry their number for the script.

use super::Moving;
use super::pose::{Kind, Pose, belt_way, kind, strokes};
use crate::escape::markup;
use crate::scheme::Item;
use crate::scheme::ink::{P, Stroke};
use crate::scheme::svg::{Drawn, bounds, head, look, path, text, way};
use std::fmt::Write;
use words::Language;

/// Frames whose places must be inside of the picture.
const SEEN: usize = 120;

/// The first frame with the numbers of what moves.
pub(super) fn write(moving: &Moving, language: Language) -> String {
    let drawn = Drawn::new(&moving.scheme, language);
    let mut out = opened(moving, &drawn, language);
    for (i, (item, ink)) in moving.scheme.items.iter().zip(&drawn.inks).enumerate() {
        let shown = moving.states.iter().any(|s| s.0 == i);
        let mark = if item.rides.is_still() && !shown { String::new() } else { format!(" data-item=\"{i}\"") };
        let _ = write!(out, "<g data-path=\"{}\"{mark}>", markup(&item.path));
        match kind(item) {
            // what the script draws anew are ways of straight pieces
            Kind::Stretched | Kind::Way => strokes(item, super::pose::at_rest(&item.place)).iter().for_each(|s| out.push_str(&pieces(s))),
            Kind::Moved => ink.strokes.iter().for_each(|s| out.push_str(&path(s))),
        }
        out.push_str(&running(item, &ink.strokes));
        out.push_str("</g>\n");
    }
    for (i, set) in drawn.labels.iter().enumerate() {
        let _ = write!(out, "<g data-label=\"{i}\">");
        text(&mut out, set, language);
        out.push_str("</g>\n");
    }
    out + "</svg>\n"
}

/// The opening of the picture with room for the whole motion, and what rests behind it.
pub(super) fn opened(moving: &Moving, drawn: &Drawn, language: Language) -> String {
    let (low, high) = swept(moving, drawn);
    let mut out = head(&moving.scheme, (low, high), language);
    if moving.rest {
        out.push_str("<g class=\"rest\" opacity=\"0.28\">");
        drawn.inks.iter().flat_map(|ink| &ink.strokes).for_each(|s| out.push_str(&path(s)));
        out.push_str("</g>\n");
    }
    out
}

/// The marks that show how a belt runs.
pub(super) fn running(item: &Item, strokes: &[Stroke]) -> String {
    if item.rides.runs.is_none() || kind(item) != Kind::Moved {
        return String::new();
    }
    format!("<path class=\"run\" d=\"{}\" stroke-width=\"5\" stroke-dasharray=\"2 20\" stroke-linecap=\"butt\"/>", way(&belt_way(strokes)))
}

/// A stroke as straight pieces.
pub(super) fn pieces(stroke: &Stroke) -> String {
    format!("<path d=\"{}\" {}/>", outline(stroke), look(stroke))
}

/// The way of straight pieces.
pub(super) fn outline(stroke: &Stroke) -> String {
    let (points, closed) = stroke.polyline();
    way(&points) + if closed { "Z" } else { "" }
}

/// Everything that is seen in the course of the motion.
pub(super) fn swept(moving: &Moving, drawn: &Drawn) -> (P, P) {
    let n = moving.times.len();
    let mut points = drawn.points();
    for k in (0..SEEN.min(n)).map(|i| i * (n - 1) / (SEEN.min(n) - 1).max(1)) {
        for (item, ink) in moving.scheme.items.iter().zip(&drawn.inks) {
            match moving.pose(item, k) {
                Pose::Still => {}
                Pose::Moved { from, to, turn } => {
                    let (s, c) = turn.sin_cos();
                    let place = |p: P| {
                        let (x, y) = (p[0] - from[0], p[1] - from[1]);
                        [to[0] + c * x + s * y, to[1] - s * x + c * y]
                    };
                    points.extend(ink.strokes.iter().flat_map(|s| s.polyline().0).map(place));
                }
                Pose::Drawn(strokes) => points.extend(strokes.iter().flat_map(|s| s.polyline().0)),
            }
        }
        for set in &drawn.labels {
            let Some(rides) = &set.label.rides else { continue };
            let at = moving.carried(rides, k, set.label.at);
            let by = [at[0] - set.label.at[0], at[1] - set.label.at[1]];
            points.extend([set.low, set.high].map(|p| [p[0] + by[0], p[1] + by[1]]));
        }
    }
    bounds(&points, &drawn.labels)
}

/// One frame.
pub(super) fn frame(moving: &Moving, k: usize, language: Language) -> String {
    let drawn = Drawn::new(&moving.scheme, language);
    let mut out = opened(moving, &drawn, language);
    for (item, ink) in moving.scheme.items.iter().zip(&drawn.inks) {
        match moving.pose(item, k) {
            Pose::Still => ink.strokes.iter().for_each(|s| out.push_str(&path(s))),
            Pose::Moved { from, to, turn } => {
                let _ = write!(out, "<g transform=\"{}\">", transform(from, to, turn));
                ink.strokes.iter().for_each(|s| out.push_str(&path(s)));
                out.push_str("</g>");
            }
            Pose::Drawn(strokes) => strokes.iter().for_each(|s| out.push_str(&pieces(s))),
        }
    }
    for set in &drawn.labels {
        let Some(rides) = &set.label.rides else { continue };
        let at = moving.carried(rides, k, set.label.at);
        let _ = write!(out, "<g transform=\"translate({:.2} {:.2})\">", at[0] - set.label.at[0], at[1] - set.label.at[1]);
        text(&mut out, set, language);
        out.push_str("</g>\n");
    }
    out + "</svg>\n"
}

/// A shift and a turn about what is shifted; SVG counts angles clockwise.
fn transform(from: P, to: P, turn: f64) -> String {
    format!("translate({:.2} {:.2}) rotate({:.3}) translate({:.2} {:.2})", to[0], to[1], -turn.to_degrees(), -from[0], -from[1])
}
