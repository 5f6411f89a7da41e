//! Places of labels: eight directions around the anchor at growing distances; the place with the least overlap wins. Labels are placed in order, each
//! keeps away from the strokes and from the labels before it.

use super::ink::{P, distance, polar};
use super::{Label, LabelText};
use crate::figure::width::text_width;
use crate::symbol;
use std::f64::consts::{FRAC_PI_4, PI, TAU};
use words::Language;

/// Size of letters.
pub(super) const TEXT: f64 = 14.0;

/// Room that labels keep between them and strokes.
const FREE: f64 = 2.0;
/// What a label costs that stands nearer to the place of another: it would be read there. More than a stroke or two through it, less than letters on letters.
const MISLEADS: f64 = 12.0;

/// A label with its place.
pub(super) struct Set<'a> {
    pub label: &'a Label,
    /// Upper left corner of its room.
    pub low: P,
    /// Lower right corner.
    pub high: P,
    /// Where its letters begin.
    pub baseline: P,
}

/// Room of a label: width, height above the line, below it.
fn room(text: &LabelText, language: Language) -> [f64; 3] {
    match text {
        LabelText::Number(_) => [19.0, 19.0, 0.0],
        LabelText::Words(words) => {
            let wide = words.lines().map(|line| text_width(line, 11.0)).fold(0.0, f64::max);
            [wide, 9.0, 3.0 + 13.0 * words.lines().count().saturating_sub(1) as f64]
        }
        LabelText::Formula(text) => [text_width(text, 13.0) * 0.92, 11.0, 4.0],
        LabelText::Symbol(name) => {
            let pieces = symbol::pieces(name, language);
            let wide = pieces.iter().map(|p| text_width(&p.text, if p.index { 10.0 } else { TEXT }) * 0.94).sum();
            [wide, 11.0, if pieces.iter().any(|p| p.index) { 6.0 } else { 3.0 }]
        }
    }
}

/// Places all labels.
pub(super) fn placed<'a>(labels: &'a [Label], strokes: &[P], language: Language) -> Vec<Set<'a>> {
    let mut done: Vec<Set> = Vec::new();
    for label in labels {
        let [w, up, down] = room(&label.text, language);
        let mut best: Option<(f64, Set)> = None;
        for (cost, center) in candidates(label, [w, up + down]) {
            let low = [center[0] - w / 2.0, center[1] - (up + down) / 2.0];
            let high = [low[0] + w, low[1] + up + down];
            if best.as_ref().is_some_and(|(b, _)| cost >= *b) {
                continue;
            }
            let nearest = labels.iter().filter(|other| distance(other.at, label.at) > FREE).map(|other| gap((low, high), other.at));
            let misleads = nearest.fold(f64::INFINITY, f64::min) < gap((low, high), label.at);
            let total = cost
                + if misleads { MISLEADS } else { 0.0 }
                + crowd(low, high, strokes)
                + done.iter().map(|set| overlap((low, high), (set.low, set.high))).sum::<f64>();
            // equal costs differ by rounding: the first place of them is taken on every machine
            if best.as_ref().is_none_or(|(b, _)| total < *b - 1e-9) {
                best = Some((total, Set { label, low, high, baseline: [low[0], low[1] + up] }));
            }
        }
        done.extend(best.map(|b| b.1));
    }
    done
}

/// Places with what they cost by themselves.
fn candidates(label: &Label, [w, h]: [f64; 2]) -> Vec<(f64, P)> {
    if label.away == 0.0 {
        return vec![(0.0, label.at)];
    }
    // right above first, as in textbooks
    const ORDER: [f64; 8] = [1.0, 3.0, 7.0, 5.0, 2.0, 0.0, 6.0, 4.0];
    let mut out = Vec::new();
    for (k, far) in [0.0, 5.0, 11.0, 20.0, 32.0].into_iter().enumerate() {
        for (rank, eighth) in ORDER.into_iter().enumerate() {
            let angle = eighth * FRAC_PI_4;
            let turned = label.side.map_or(0.0, |side| ((angle - side + PI).rem_euclid(TAU) - PI).abs());
            // the nearest edge or corner of the room keeps the distance
            let reach = label.away + far;
            let [x, y] = polar([0.0; 2], reach, angle);
            let push = |c: f64, half: f64| if c.abs() < 0.3 * reach { 0.0 } else { c.signum() * half };
            let center = [label.at[0] + x + push(x, w / 2.0), label.at[1] + y + push(y, h / 2.0)];
            let rank = if label.side.is_some() { 0.0 } else { rank as f64 * 0.2 };
            out.push((k as f64 * 3.0 + rank + turned * 4.0, center));
        }
    }
    out
}

/// Distance of a place from a room.
fn gap((low, high): (P, P), p: P) -> f64 {
    distance(p, [p[0].clamp(low[0], high[0]), p[1].clamp(low[1], high[1])])
}

/// How many points of strokes lie in a room.
fn crowd(low: P, high: P, strokes: &[P]) -> f64 {
    let inside = |p: &&P| p[0] > low[0] - FREE && p[0] < high[0] + FREE && p[1] > low[1] - FREE && p[1] < high[1] + FREE;
    strokes.iter().filter(inside).count() as f64 * 4.0
}

fn overlap(a: (P, P), b: (P, P)) -> f64 {
    const FREE: f64 = 3.0;
    let along = |k: usize| a.1[k].min(b.1[k]) - a.0[k].max(b.0[k]) + FREE;
    let (x, y) = (along(0), along(1));
    if x > 0.0 && y > 0.0 { 30.0 + x * y * 0.2 } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::{gap, placed};
    use crate::scheme::Label;
    use words::Language;

    /// A weight and a normal force whose heads nearly meet: each letter stands nearer to its own.
    #[test]
    fn letters_of_arrows_that_meet_are_not_exchanged() {
        for apart in [4.0, 8.0, 14.0, 25.0] {
            let labels = [Label::symbol("G", [0.0, 0.0], 6.0).towards(2.4), Label::symbol("N_P", [0.0, apart], 6.0).towards(-0.7)];
            let found = placed(&labels, &[], Language::En);
            for (own, other) in [(0, 1), (1, 0)] {
                let room = (found[own].low, found[own].high);
                assert!(gap(room, labels[own].at) <= gap(room, labels[other].at), "{apart}");
            }
        }
    }
}
