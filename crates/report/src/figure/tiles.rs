//! The tiles of a field as paths of SVG.
//!
//! Tiles of one tint are one path of runs along x, so that a picture stays small; hatching is drawn line by line, so that it needs no name that could stand twice on a page.

use super::axis::Axis;
use super::field::{Field, Hatch, Key, STEPS, Tile};
use super::layout::{Area, Ruler};
use super::ticks;
use crate::palette::INK;
use std::fmt::Write;
use words::Language;

/// Pixels between hatching lines.
const HATCHED: f64 = 7.0;
/// Anchors of the scale from low to high: viridis (S. van der Walt, N. Smith 2015), even in lightness, also in grey and for the colour-blind.
const ANCHORS: [[f64; 3]; 6] =
    [[68.0, 1.0, 84.0], [65.0, 68.0, 135.0], [42.0, 120.0, 142.0], [34.0, 168.0, 132.0], [122.0, 209.0, 81.0], [253.0, 231.0, 37.0]];
/// Light tints of classes, of the hues of the curves; black lines and hatching stay visible on them.
const TINTS: [&str; 8] = ["#a9cfe8", "#f3c3a0", "#a5dcc6", "#eacbdd", "#f4da9e", "#d3d9e2", "#c9bfe6", "#d9e8a8"];
/// What has no result.
const NOTHING: &str = "#ececec";

fn colour(field: &Field, tint: Option<usize>) -> String {
    match (&field.key, tint) {
        (_, None) => NOTHING.into(),
        (Key::Classes(_), Some(k)) => TINTS[k % TINTS.len()].into(),
        (Key::Scale(..), Some(k)) => scaled((k as f64 + 0.5) / STEPS as f64),
    }
}

/// A colour of the scale.
fn scaled(share: f64) -> String {
    let at = share.clamp(0.0, 1.0) * (ANCHORS.len() - 1) as f64;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let k = (at.floor() as usize).min(ANCHORS.len() - 2);
    let mixed = |c: usize| ANCHORS[k][c] + (at - k as f64) * (ANCHORS[k + 1][c] - ANCHORS[k][c]);
    format!("#{:02x}{:02x}{:02x}", mixed(0).round() as u8, mixed(1).round() as u8, mixed(2).round() as u8)
}

/// A rectangle: left, top, width, height.
type Box4 = [f64; 4];

/// The tiles of a field on its rulers.
pub(super) fn tiles(field: &Field, x: &Ruler, y: &Ruler) -> String {
    let rows = field.tiles.len().checked_div(field.across).unwrap_or(0);
    let edge = |ruler: &Ruler, [from, to]: [f64; 2], k: usize, n: usize| {
        ruler.pixel(from + (to - from) * k as f64 / n.max(1) as f64).unwrap_or(0.0)
    };
    let runs = |same: &dyn Fn(&Tile, &Tile) -> bool| {
        let mut out: Vec<(Tile, Box4)> = Vec::new();
        for j in 0..rows {
            let row = &field.tiles[j * field.across..(j + 1) * field.across];
            let (top, bottom) = (edge(y, field.ends[1], j + 1, rows), edge(y, field.ends[1], j, rows));
            let mut from = 0;
            for k in 1..=row.len() {
                if k == row.len() || !same(&row[k], &row[from]) {
                    let (left, right) = (edge(x, field.ends[0], from, row.len()), edge(x, field.ends[0], k, row.len()));
                    out.push((row[from], [left, top, right - left, bottom - top]));
                    from = k;
                }
            }
        }
        out
    };
    let mut out = String::new();
    let tinted = runs(&|a, b| a.tint == b.tint);
    let most = tinted.iter().filter_map(|(tile, _)| tile.tint).max().map_or(0, |k| k + 1);
    for tint in std::iter::once(None).chain((0..most).map(Some)) {
        let path: String = tinted.iter().filter(|(tile, _)| tile.tint == tint).map(|(_, place)| rectangle(*place)).collect();
        if !path.is_empty() {
            // a hair's breadth of the same colour closes the seams that smoothing leaves between tiles
            let colour = colour(field, tint);
            let _ = writeln!(out, "<path d=\"{path}\" fill=\"{colour}\" stroke=\"{colour}\" stroke-width=\"0.4\"/>");
        }
    }
    let hatched = runs(&|a, b| a.hatch == b.hatch);
    for hatch in [Hatch::Unstable, Hatch::Failed] {
        let places: Vec<Box4> = hatched.iter().filter(|(tile, _)| tile.hatch == hatch).map(|(_, place)| *place).collect();
        out += &lines(&places, hatch);
    }
    out
}

fn rectangle([left, top, width, height]: Box4) -> String {
    format!("M{left:.1} {top:.1}h{width:.1}v{height:.1}h-{width:.1}z")
}

/// Hatching over rectangles on one lattice of slanted lines: up to the right where something is unstable, both ways where there is no result.
fn lines(places: &[Box4], hatch: Hatch) -> String {
    if hatch == Hatch::Plain {
        return String::new();
    }
    let mut path = String::new();
    for [left, top, width, height] in places {
        let (right, bottom) = (left + width, top + height);
        // x + y = c rises to the right on a page whose y grows downwards
        let mut c = ((left + top) / HATCHED).ceil() * HATCHED;
        while c < right + bottom {
            let (a, b) = ((c - bottom).max(*left), (c - top).min(right));
            if b > a {
                let _ = write!(path, "M{a:.1} {:.1}L{b:.1} {:.1}", c - a, c - b);
            }
            c += HATCHED;
        }
        if hatch == Hatch::Failed {
            let mut c = ((left - bottom) / HATCHED).ceil() * HATCHED;
            while c < right - top {
                let (a, b) = ((c + top).max(*left), (c + bottom).min(right));
                if b > a {
                    let _ = write!(path, "M{a:.1} {:.1}L{b:.1} {:.1}", a - c, b - c);
                }
                c += HATCHED;
            }
        }
    }
    if path.is_empty() {
        return path;
    }
    let ink = if hatch == Hatch::Failed { "#8a8a8a" } else { INK };
    // white below it, for dark tints
    format!(
        "<path d=\"{path}\" fill=\"none\" stroke=\"#ffffff\" stroke-width=\"2\" stroke-opacity=\"0.6\"/>\n<path d=\"{path}\" fill=\"none\" stroke=\"{ink}\" stroke-width=\"0.8\"/>\n"
    )
}

/// A tile of the legend.
pub(super) fn swatch(field: &Field, tile: Tile, [x, y]: [f64; 2]) -> String {
    let place = [x, y - 6.0, 34.0, 12.0];
    let fill = colour(field, tile.tint);
    format!("<path d=\"{}\" fill=\"{fill}\" stroke=\"#8a8a8a\" stroke-width=\"0.6\"/>\n{}", rectangle(place), lines(&[place], tile.hatch))
}

/// The bar of a scale beside the area, with its ticks.
pub(super) fn bar((axis, [low, high]): (&Axis, [f64; 2]), area: Area, language: Language) -> String {
    let (left, width) = (area.right + 16.0, 16.0);
    let height = (area.bottom - area.top) / STEPS as f64;
    let mut out = String::new();
    for k in 0..STEPS {
        let top = area.bottom - (k + 1) as f64 * height;
        let _ = writeln!(
            out,
            "<path d=\"{}\" fill=\"{}\"/>",
            rectangle([left, top, width, height + 0.4]),
            scaled((k as f64 + 0.5) / STEPS as f64)
        );
    }
    let (from, to) = (low / axis.scale.size, high / axis.scale.size);
    for tick in ticks::linear(from, to, 6, language) {
        let y = area.bottom - (tick.at - from) / (to - from) * (area.bottom - area.top);
        if y.is_finite() {
            let (edge, text) = (left + width, crate::escape::markup(&tick.label));
            let _ = writeln!(
                out,
                "<path d=\"M{edge:.1} {y:.1}h4\" stroke=\"{INK}\"/><text x=\"{:.1}\" y=\"{:.1}\">{text}</text>",
                edge + 7.0,
                y + 4.0
            );
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::{ANCHORS, lines, scaled};
    use crate::figure::field::Hatch;

    #[test]
    fn colours_reach_both_ends() {
        let hex = |colour: [f64; 3]| format!("#{:02x}{:02x}{:02x}", colour[0] as u8, colour[1] as u8, colour[2] as u8);
        assert_eq!([scaled(0.0), scaled(1.0)], [hex(ANCHORS[0]), hex(ANCHORS[ANCHORS.len() - 1])]);
    }

    #[test]
    fn hatching_stays_inside() {
        let path = lines(&[[10.0, 20.0, 9.0, 5.0]], Hatch::Failed);
        let numbers: Vec<f64> =
            path.split("d=\"").nth(1).unwrap().split('"').next().unwrap().split(['M', 'L', ' ']).filter_map(|n| n.parse().ok()).collect();
        assert!(!numbers.is_empty());
        assert!(numbers.chunks(2).all(|p| (10.0..=19.0).contains(&p[0]) && (20.0..=25.0).contains(&p[1])), "{path}");
    }
}
