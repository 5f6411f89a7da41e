//! An SVG that plays by itself: places as lists of values (SMIL), which every browser reads; no script.

use super::Moving;
use super::picture::{opened, outline, pieces, running};
use super::pose::{Kind, Pose, kind, strokes};
use crate::escape::markup;
use crate::scheme::Item;
use crate::scheme::ink::{P, Stroke};
use crate::scheme::svg::{Drawn, path, text};
use std::fmt::Write;
use words::Language;

/// The file.
pub(super) fn write(moving: &Moving, frames: usize, language: Language) -> String {
    let seconds = moving.span() / moving.pace();
    let moving = &moving.even(frames);
    let file = File { moving, timing: format!("dur=\"{seconds:.2}s\" repeatCount=\"indefinite\"") };
    let drawn = Drawn::new(&moving.scheme, language);
    let mut out = opened(moving, &drawn, language);
    for (item, ink) in moving.scheme.items.iter().zip(&drawn.inks) {
        let _ = write!(out, "<g data-path=\"{}\">", markup(&item.path));
        out.push_str(&file.item(item, &ink.strokes));
        out.push_str("</g>\n");
    }
    for set in &drawn.labels {
        let by = set.label.rides.as_ref().filter(|r| r.at != 0 || r.to != 0).map(|rides| {
            file.shifts(|k| {
                let at = moving.carried(rides, k, set.label.at);
                [at[0] - set.label.at[0], at[1] - set.label.at[1]]
            })
        });
        let _ = write!(out, "<g>{}", by.unwrap_or_default());
        text(&mut out, set, language);
        out.push_str("</g>\n");
    }
    out + "</svg>\n"
}

struct File<'a> {
    moving: &'a Moving,
    timing: String,
}

impl File<'_> {
    fn frames(&self) -> std::ops::Range<usize> {
        0..self.moving.times.len()
    }

    fn values(&self, value: impl Fn(usize) -> String) -> String {
        self.frames().map(value).collect::<Vec<_>>().join(";")
    }

    fn shifts(&self, by: impl Fn(usize) -> P) -> String {
        let values = self.values(|k| {
            let [x, y] = by(k);
            format!("{x:.1} {y:.1}")
        });
        format!("<animateTransform attributeName=\"transform\" type=\"translate\" values=\"{values}\" {}/>", self.timing)
    }

    fn item(&self, item: &Item, ink: &[Stroke]) -> String {
        let still: String = ink.iter().map(path).collect();
        match kind(item) {
            _ if item.rides.is_still() => still,
            Kind::Moved => self.moved(item, &(still + &self.run(item, ink))),
            Kind::Stretched | Kind::Way => self.redrawn(item) + &self.run(item, ink),
        }
    }

    /// A shift of the anchor, inside of it a turn about the anchor.
    fn moved(&self, item: &Item, inside: &str) -> String {
        let (mut from, mut turns) = ([0.0; 2], false);
        let poses: Vec<(P, f64)> = self
            .frames()
            .filter_map(|k| match self.moving.pose(item, k) {
                Pose::Moved { from: own, to, turn } => {
                    from = own;
                    turns |= turn != 0.0;
                    Some((to, turn))
                }
                _ => None,
            })
            .collect();
        let [x, y] = from;
        let shift = self.shifts(|k| [poses[k].0[0] - x, poses[k].0[1] - y]);
        let rotation = if turns {
            let values = self.values(|k| format!("{:.2} {x:.1} {y:.1}", -poses[k].1.to_degrees()));
            format!("<animateTransform attributeName=\"transform\" type=\"rotate\" values=\"{values}\" {}/>", self.timing)
        } else {
            String::new()
        };
        format!("{shift}<g>{rotation}{inside}</g>")
    }

    /// Strokes whose ways are lists of values.
    fn redrawn(&self, item: &Item) -> String {
        let frames: Vec<Vec<Stroke>> =
            self.frames().map(|k| if let Pose::Drawn(strokes) = self.moving.pose(item, k) { strokes } else { Vec::new() }).collect();
        let first = strokes(item, super::pose::at_rest(&item.place));
        let alike = frames
            .iter()
            .all(|f| f.len() == first.len() && f.iter().zip(&first).all(|(a, b)| a.polyline().0.len() == b.polyline().0.len()));
        if !alike {
            return first.iter().map(pieces).collect();
        }
        let one = |(i, stroke): (usize, &Stroke)| {
            let values = self.values(|k| outline(&frames[k][i]));
            let open = pieces(stroke);
            format!("{}><animate attributeName=\"d\" values=\"{values}\" {}/></path>", open.trim_end_matches("/>"), self.timing)
        };
        first.iter().enumerate().map(one).collect()
    }

    /// The running marks of a belt.
    fn run(&self, item: &Item, ink: &[Stroke]) -> String {
        let marks = running(item, ink);
        if marks.is_empty() {
            return marks;
        }
        let values = self.values(|k| format!("{:.1}", self.moving.run(item, k)));
        format!(
            "{}><animate attributeName=\"stroke-dashoffset\" values=\"{values}\" {}/></path>",
            marks.trim_end_matches("/>"),
            self.timing
        )
    }
}
