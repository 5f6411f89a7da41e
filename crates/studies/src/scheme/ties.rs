//! Ropes, belts, chains, gears, rods.

use super::groups::Joint;
use super::sketch::Sketch;
use crate::connections::Pair;
use crate::shown::{Role, role_at};
use mechanics::model::{PointRef, Wound};
use report::scheme::{Drum, P, Place, Rides, S, Via, between, direction, distance, polar, tangent};
use std::f64::consts::FRAC_PI_2;

impl Sketch<'_> {
    /// Two wheels that turn together.
    pub(super) fn tied_wheels(&mut self, path: &str, pair: &Pair) {
        let [a, b] = pair.between.map(|f| self.origin(f));
        let [r, s] = pair.radii.map(|e| self.long(self.numbers.value(self.machine, e)));
        self.rides = self.over_wheels(pair.between.map(|f| self.groups.of(f)), r);
        self.transmission(path, (a, b), (r, s), if pair.opposite { Sense::Opposite } else { Sense::Same });
        if role_at(path) != Role::Gear {
            let name = self.letters.load(path);
            let side = direction(a, b) + FRAC_PI_2;
            self.note(name, polar(between(a, b, 0.5), (r + s) / 2.0, side), 5.0, Some(side));
        }
    }

    /// A massless rod.
    pub(super) fn bar(&mut self, path: &str, [a, b]: [PointRef; 2]) {
        let (at, to) = (self.seen(a), self.seen(b));
        self.rides = Rides::between(self.group_of(a), self.group_of(b));
        self.put("rod", path, Place { at, to, ..Place::default() });
        let name = self.letters.load(path);
        self.note(name, between(at, to, 0.5), 6.0, None);
    }

    /// A belt over two wheels is carried by what carries these, and runs with the first.
    fn over_wheels(&self, [a, b]: [usize; 2], radius: f64) -> Rides {
        let axle = |g: usize| if self.groups.all[g].joint == Joint::Turns { self.groups.all[g].carrier } else { g };
        let (at, to) = (axle(a), axle(b));
        // on one carrier the belt turns with it
        Rides { runs: Some((a, radius)), ..Rides::between(at, to) }
    }

    fn transmission(&mut self, path: &str, (a, b): (P, P), (r, s): (f64, f64), sense: Sense) {
        let place = Place { at: a, to: b, size: r, other: s, ..Place::default() };
        let symbol = match (role_at(path), sense) {
            (Role::Chain, _) => "chain",
            (Role::Gear, Sense::Opposite) => return,
            (Role::Gear, Sense::Same) => {
                let (at, size) = if r > s { (a, r) } else { (b, s) };
                self.put("gear_internal", path, Place { at, size, ..Place::default() });
                return;
            }
            (_, Sense::Opposite) => "belt_crossed",
            _ => "belt",
        };
        self.put(symbol, path, place);
    }

    /// A rope: its points, and where it leaves the drums that it winds on.
    pub(super) fn thread(&mut self, path: &str, points: &[PointRef], wound: &[Wound]) {
        let named: Vec<P> = points.iter().map(|p| self.seen(*p)).collect();
        let mut way = named.clone();
        for drum in wound {
            self.onto(&mut way, drum);
        }
        // points of the way that are none of the rope's own are those where it leaves a drum
        let via = |p: &P| match named.iter().position(|n| n == p) {
            Some(i) => Via { track: self.group_of(points[i]), drum: None },
            None => self.leaving(*p, wound),
        };
        let rides: Vec<Via> = way.iter().map(via).collect();
        if let ([_, ..], true) = (&way[..], way.len() >= 2) {
            self.pulleys(path, points, &way);
            let longest = way.windows(2).max_by(|a, b| distance(a[0], a[1]).total_cmp(&distance(b[0], b[1])));
            let middle = longest.map_or(way[0], |w| between(w[0], w[1], 0.5));
            let half = rides.len() / 2;
            let near = if half > 0 { [rides[half - 1].track, rides[half].track] } else { [0, 0] };
            self.rides = Rides { path: rides, ..Rides::between(near[0], near[1]) };
            self.put("thread", path, Place { path: way, ..Place::default() });
            self.rides = Rides::between(near[0], near[1]);
            let name = self.letters.load(path);
            self.note(name, middle, 5.0, None);
        }
    }

    /// What carries the point where a rope leaves a drum: the one whose rim is nearest.
    fn leaving(&self, p: P, wound: &[Wound]) -> Via {
        let rim = |d: &Wound| (self.origin(d.on), self.long(self.numbers.value(self.machine, d.radius)));
        let off = |d: &&Wound| (distance(p, rim(d).0) - rim(d).1).abs();
        match wound.iter().min_by(|a, b| off(a).total_cmp(&off(b))) {
            Some(drum) => {
                let ((center, radius), sense) = (rim(drum), if drum.positive { 1.0 } else { -1.0 });
                Via { track: self.groups.of(drum.on), drum: Some(Drum { center, radius, sense }) }
            }
            None => Via { track: 0, drum: None },
        }
    }

    /// The end of a rope that is nearer to a drum goes onto its rim: unless it lies there already.
    pub(super) fn onto(&self, way: &mut Vec<P>, drum: &Wound) {
        let center = self.origin(drum.on);
        let r = self.long(self.numbers.value(self.machine, drum.radius));
        if way.is_empty() {
            way.push(polar(center, r, FRAC_PI_2));
            return;
        }
        let (first, last) = (way[0], way[way.len() - 1]);
        let at_start = way.len() > 1 && distance(first, center) < distance(last, center);
        if at_start {
            way.reverse();
        }
        let end = way[way.len() - 1];
        let off = (distance(end, center) - r).abs();
        if off > 0.12 * r + 2.0 {
            // from the point before, where the end is the axis of the drum
            if distance(end, center) < 0.5 * r && way.len() > 1 {
                way.pop();
            }
            let from = way[way.len() - 1];
            way.push(tangent(center, r, (from, if drum.positive { 1.0 } else { -1.0 })));
        }
        if at_start {
            way.reverse();
        }
    }

    /// Rings on the ground, and a pulley where a rope goes round two points of one body.
    fn pulleys(&mut self, path: &str, points: &[PointRef], way: &[P]) {
        for i in 1..points.len().saturating_sub(1) {
            let (here, next) = (self.group_of(points[i]), self.group_of(points[i + 1]));
            let (p, q) = (self.seen(points[i]), self.seen(points[i + 1]));
            self.rides = Rides::on(here);
            if here == next && i + 1 < points.len() - 1 && distance(p, q) > 6.0 {
                let (at, size) = (between(p, q, 0.5), distance(p, q) / 2.0);
                self.put("pulley", path, Place { at, size, turn: 0.7, ..Place::default() });
                self.hinges.retain(|h| distance(*h, at) > 4.0);
            } else if way.len() == points.len() || i > 0 {
                let held = i > 0 && self.group_of(points[i - 1]) == here;
                if !held {
                    self.put("ring_eye", path, Place { at: p, ..Place::default() });
                }
            }
        }
    }
}

/// How two wheels turn.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Sense {
    Same,
    Opposite,
}

/// Size of what has no size of its own.
pub(super) const SMALL: f64 = 1.3 * S;
