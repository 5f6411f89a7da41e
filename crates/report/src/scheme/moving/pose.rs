//! Where items are at a frame.

use super::Moving;
use crate::scheme::ink::{Ink, P, Stroke, distance, tangent};
use crate::scheme::{Fit, Item, Place, Rides};

/// How an item is drawn at a frame.
pub(super) enum Pose {
    /// As it stands.
    Still,
    /// Moved from one place to another and turned about it.
    Moved { from: P, to: P, turn: f64 },
    /// Drawn anew.
    Drawn(Vec<Stroke>),
}

impl Moving {
    /// How far a track has turned since the first frame.
    pub(super) fn turned(&self, track: usize, k: usize) -> f64 {
        self.tracks.get(track).filter(|t| !t.turn.is_empty()).map_or(0.0, |t| t.turn[k] - t.turn[0])
    }

    /// Where a point that a track carries is at a frame: x' = o' + R (x - o).
    pub fn image(&self, track: usize, k: usize, p: P) -> P {
        let Some(path) = self.tracks.get(track).filter(|t| !t.at.is_empty()) else { return p };
        let (o, there, turn) = (path.at[0], path.at[k], self.turned(track, k));
        let ([x, y], (s, c)) = ([p[0] - o[0], p[1] - o[1]], turn.sin_cos());
        // y points downwards, angles are counter-clockwise as seen
        [there[0] + c * x + s * y, there[1] - s * x + c * y]
    }

    /// Anchors of an item at a frame.
    pub(super) fn ends(&self, item: &Item, k: usize) -> [P; 2] {
        [self.image(item.rides.at, k, item.place.at), self.image(item.rides.to, k, item.place.to)]
    }

    /// The points of a way at a frame.
    pub(super) fn path(&self, item: &Item, k: usize) -> Vec<P> {
        let points = &item.place.path;
        let mut out: Vec<P> = points.iter().zip(&item.rides.path).map(|(p, via)| self.image(via.track, k, *p)).collect();
        for (i, via) in item.rides.path.iter().enumerate() {
            let Some(drum) = &via.drum else { continue };
            let Some(from) = out.get(if i == 0 { 1 } else { i - 1 }).copied() else { continue };
            out[i] = tangent(self.image(via.track, k, drum.center), drum.radius, (from, drum.sense));
        }
        out
    }

    pub(super) fn pose(&self, item: &Item, k: usize) -> Pose {
        if item.rides.is_still() {
            return Pose::Still;
        }
        match kind(item) {
            Kind::Way => Pose::Drawn(strokes(item, Place { path: self.path(item, k), ..item.place.clone() })),
            Kind::Stretched => {
                let [at, to] = self.ends(item, k);
                Pose::Drawn(strokes(item, Place { at, to, ..at_rest(&item.place) }))
            }
            Kind::Moved => {
                let from = anchor(item);
                let turn = if item.symbol.fit == Fit::Static { 0.0 } else { self.turned(item.rides.turn, k) };
                Pose::Moved { from, to: self.image(item.rides.at, k, from), turn }
            }
        }
    }

    /// Where the middle of a label's anchor is at a frame, against where it was.
    pub(super) fn carried(&self, rides: &Rides, k: usize, p: P) -> P {
        let [a, b] = [rides.at, rides.to].map(|track| self.image(track, k, p));
        [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0]
    }

    /// How far a belt has run at a frame, pixels.
    pub(super) fn run(&self, item: &Item, k: usize) -> f64 {
        item.rides.runs.map_or(0.0, |(wheel, radius)| radius * self.turned(wheel, k))
    }
}

/// What must be done with an item.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Moved,
    Stretched,
    Way,
}

pub(super) fn kind(item: &Item) -> Kind {
    match () {
        () if !item.rides.path.is_empty() => Kind::Way,
        () if item.rides.at != item.rides.to => Kind::Stretched,
        () => Kind::Moved,
    }
}

/// The point of an item that is followed.
pub(super) fn anchor(item: &Item) -> P {
    if item.place.path.is_empty() || item.place.at != [0.0; 2] { item.place.at } else { item.place.path[0] }
}

/// A place with its length at rest.
pub(super) fn at_rest(place: &Place) -> Place {
    Place { other: if place.other == 0.0 { distance(place.at, place.to) } else { place.other }, ..place.clone() }
}

/// The strokes of a stretched item of a length, from the origin to the right.
pub(super) fn straight(item: &Item, length: f64) -> Vec<Stroke> {
    strokes(item, Place { at: [0.0; 2], to: [length, 0.0], ..at_rest(&item.place) })
}

/// Strokes of an item at another place.
pub(super) fn strokes(item: &Item, place: Place) -> Vec<Stroke> {
    let mut ink = Ink::default();
    (item.symbol.draw)(&place, &mut ink);
    ink.strokes
}

/// The closed way along which a belt runs: both strands and the arcs between them.
pub(super) fn belt_way(strokes: &[Stroke]) -> Vec<P> {
    let ways: Vec<Vec<P>> = strokes.iter().take(4).map(|s| s.polyline().0).collect();
    let [one, other, first, second] = &ways[..] else { return Vec::new() };
    let mut out = one.clone();
    let mut rest: Vec<Vec<P>> = vec![second.clone(), other.clone(), first.clone()];
    // each piece begins where the one before it ends
    while let Some(end) = out.last().copied() {
        let near = |w: &Vec<P>| w.first().zip(w.last()).map_or(f64::INFINITY, |(a, b)| distance(end, *a).min(distance(end, *b)));
        let Some(i) = (0..rest.len()).min_by(|a, b| near(&rest[*a]).total_cmp(&near(&rest[*b]))) else { break };
        let mut next = rest.swap_remove(i);
        if next.first().zip(next.last()).is_some_and(|(a, b)| distance(end, *b) < distance(end, *a)) {
            next.reverse();
        }
        out.extend(next);
    }
    out
}
