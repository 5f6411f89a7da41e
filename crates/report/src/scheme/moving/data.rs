//! What the script of a page needs: tracks in steps of a tenth of a pixel as differences of whole numbers, and for each item what carries it. What is drawn anew
//! comes twice, at its shortest and at its longest: the script divides between them, so that it knows no symbol.

use super::pose::{Kind, anchor, kind, straight, strokes};
use super::{Moving, Track};
use crate::scheme::ink::{P, Stroke, distance};
use crate::scheme::{Fit, Item};
use serde_json::{Value, json};

/// Step of places, pixels.
pub const RESOLUTION: f64 = 0.05;
/// Step of angles, rad: a tenth of a pixel at the edge of a picture.
pub const TURN: f64 = 2e-4;
/// Step of times, of the duration.
const MOMENT: f64 = 1e-6;

pub(super) fn write(moving: &Moving) -> Value {
    let items = moving.scheme.items.iter().enumerate().filter(|(_, item)| !item.rides.is_still());
    let labels = moving.scheme.labels.iter().enumerate().filter_map(|(i, label)| {
        let rides = label.rides.as_ref().filter(|r| r.at != 0 || r.to != 0)?;
        Some(json!([i, rides.at, rides.to, short(label.at[0]), short(label.at[1])]))
    });
    let (first, span) = (moving.times[0], moving.span());
    let states = moving.states.iter().map(|(i, stays)| json!([i, stays.iter().map(|s| json!([s.from, s.to, s.look])).collect::<Vec<_>>()]));
    json!({
        "states": states.collect::<Vec<_>>(),
        "clock": {"symbol": moving.clock.symbol, "unit": moving.clock.unit, "repeats": moving.clock.repeats},
        "first": first, "span": span, "shown": first + if moving.rest { 0.25 * span } else { 0.0 }, "pace": moving.pace(), "step": [RESOLUTION, TURN, MOMENT],
        "times": steps(moving.times.iter().map(|t| (t - first) / span), MOMENT),
        "tracks": moving.tracks.iter().map(track).collect::<Vec<_>>(),
        "items": items.map(|(i, item)| moved(moving, (i, item))).collect::<Vec<_>>(),
        "labels": labels.collect::<Vec<_>>(),
    })
}

/// Values in whole steps, the first as it is, the others as what is added.
fn steps(values: impl Iterator<Item = f64>, step: f64) -> Vec<i64> {
    let mut before = 0;
    let difference = |v: f64| {
        let now = (v / step).round() as i64;
        let by = now - before;
        before = now;
        by
    };
    values.map(difference).collect()
}

fn track(track: &Track) -> Value {
    if track.at.is_empty() {
        return Value::Null;
    }
    let still = |values: &[f64]| values.iter().all(|v| (v - values[0]).abs() < 0.5 * RESOLUTION);
    let along = |i: usize| {
        let values: Vec<f64> = track.at.iter().map(|p| p[i]).collect();
        if still(&values) { json!(short(values[0])) } else { json!(steps(values.into_iter(), RESOLUTION)) }
    };
    let turn = match track.turn.first() {
        Some(first) if track.turn.iter().any(|t| (t - first).abs() > 0.5 * TURN) => {
            json!(steps(track.turn.iter().map(|t| t - first), TURN))
        }
        _ => json!(0),
    };
    json!([along(0), along(1), turn])
}

/// An item: number, kind, what carries it, what is drawn.
fn moved(moving: &Moving, (i, item): (usize, &Item)) -> Value {
    let rides = &item.rides;
    let mut out = match kind(item) {
        Kind::Way => way(item, i),
        Kind::Stretched => stretched(moving, (i, item)),
        Kind::Moved => {
            let [x, y] = anchor(item).map(short);
            let turn = if item.symbol.fit == Fit::Static { 0 } else { rides.turn };
            json!({"g": i, "on": [rides.at, turn], "p": [x, y]})
        }
    };
    if let Some((wheel, radius)) = rides.runs {
        out["runs"] = json!([wheel, short(radius)]);
    }
    out
}

fn way(item: &Item, i: usize) -> Value {
    let via = item.place.path.iter().zip(&item.rides.path).map(|(p, via)| match &via.drum {
        Some(d) => json!([via.track, short(d.center[0]), short(d.center[1]), short(d.radius), d.sense]),
        None => json!([via.track, short(p[0]), short(p[1])]),
    });
    let closed = strokes(item, item.place.clone()).first().is_some_and(|s| s.polyline().1);
    json!({"g": i, "way": via.collect::<Vec<_>>(), "closed": closed})
}

fn stretched(moving: &Moving, (i, item): (usize, &Item)) -> Value {
    let lengths = (0..moving.times.len()).map(|k| moving.ends(item, k)).map(|[a, b]| distance(a, b));
    let (low, high) = lengths.fold((f64::INFINITY, 0.0_f64), |(l, h), d| (l.min(d), h.max(d)));
    let (short_one, long_one) = (straight(item, low), straight(item, high));
    let alike =
        short_one.len() == long_one.len() && short_one.iter().zip(&long_one).all(|(a, b)| a.polyline().0.len() == b.polyline().0.len());
    let start = moving.ends(item, 0);
    // what has more pieces when it is longer keeps those of the start
    let own = straight(item, distance(start[0], start[1]));
    let [near, far] = if alike { [&short_one, &long_one] } else { [&own, &own] };
    let [a, b] = [item.place.at, item.place.to].map(|p| p.map(short));
    json!({"g": i, "ends": [item.rides.at, item.rides.to], "p": [a[0], a[1], b[0], b[1]], "l": [short(low), short(high)],
        "d": [drawn(near), drawn(far)], "closed": near.iter().map(|s| u8::from(s.polyline().1)).collect::<Vec<_>>()})
}

fn drawn(strokes: &[Stroke]) -> Vec<Vec<f64>> {
    strokes.iter().map(|s| s.polyline().0.into_iter().flatten().map(tenth).collect()).collect()
}

fn tenth(x: f64) -> f64 {
    (x * 10.0).round() / 10.0
}

fn short(x: f64) -> f64 {
    (x * 100.0).round() / 100.0
}

/// Tracks read back from what a page holds.
#[derive(Clone, Debug, Default)]
pub struct Decoded {
    /// Times, SI.
    pub times: Vec<f64>,
    /// Origins by track and frame; none for what stands still.
    pub at: Vec<Vec<P>>,
    /// Angles by track and frame against the first one.
    pub turn: Vec<Vec<f64>>,
}

impl Decoded {
    /// Reads the data of a page; none where they are no such data.
    pub fn read(data: &Value) -> Option<Decoded> {
        let number = |v: &Value| v.as_f64();
        let step: Vec<f64> = data["step"].as_array()?.iter().filter_map(number).collect();
        let summed = |list: &Vec<Value>, step: f64| {
            let sums = list.iter().filter_map(number).scan(0.0, |sum, d| {
                *sum += d;
                Some(step * *sum)
            });
            sums.collect::<Vec<f64>>()
        };
        let (first, span) = (number(&data["first"])?, number(&data["span"])?);
        let times: Vec<f64> = summed(data["times"].as_array()?, step[2]).into_iter().map(|s| first + span * s).collect();
        let row = |v: &Value, step: f64| match v {
            Value::Array(list) => summed(list, step),
            other => vec![other.as_f64().unwrap_or(0.0); times.len()],
        };
        let mut out = Decoded { times: times.clone(), ..Decoded::default() };
        for track in data["tracks"].as_array()? {
            let Some([x, y, turn]) = track.as_array().map(Vec::as_slice) else {
                out.at.push(Vec::new());
                out.turn.push(Vec::new());
                continue;
            };
            out.at.push(row(x, step[0]).into_iter().zip(row(y, step[0])).map(|(x, y)| [x, y]).collect());
            out.turn.push(row(turn, step[1]));
        }
        Some(out)
    }
}
