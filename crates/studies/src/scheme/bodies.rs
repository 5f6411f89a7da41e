//! Bodies: wheels, links and plates between the places that hold them, blocks.

use super::groups::Joint;
use super::looks::{Look, Wheel};
use super::numbers::{V3, dot, plus};
use super::sketch::{Carrier, Sketch};
use algebra::arrange::Arrange;
use mechanics::model::FrameId;
use report::scheme::{P, Place, Rides, S, Via, direction, distance, polar};
use std::f64::consts::TAU;

impl Sketch<'_> {
    /// All bodies, wheels behind links.
    pub(super) fn bodies(&mut self) {
        let order = 1..self.groups.all.len();
        self.wheels();
        for i in order {
            match self.blocks[i] {
                Some(_) => self.block(i),
                None if self.groups.all[i].turns || self.is_bar(i) => self.link(i),
                None => self.mover(i),
            }
        }
    }

    fn spots(&self, group: usize) -> Vec<P> {
        let mut out: Vec<P> = Vec::new();
        for spot in &self.looks[group].spots {
            let p = self.stage.at(group, spot.at);
            if out.iter().all(|q| distance(*q, p) > 3.0) {
                out.push(p);
            }
        }
        out
    }

    /// Wheels of all groups, the largest behind.
    fn wheels(&mut self) {
        let of = |i: usize| self.looks[i].wheels.iter().map(move |w| (i, *w));
        let mut wheels: Vec<(usize, Wheel)> = (0..self.groups.all.len()).flat_map(of).collect();
        // a circle of the ground itself is drawn by what runs on it
        wheels.retain(|(_, wheel)| wheel.frame != FrameId::GROUND);
        wheels.arrange_by(|a, b| b.1.radius.total_cmp(&a.1.radius));
        for (group, wheel) in wheels {
            let path = match group {
                // a wheel that stands: it has no group of its own
                0 => format!("bodies.{}", self.machine.model.frames[wheel.frame.index()].name),
                _ => self.groups.all[group].path.clone(),
            };
            self.rides = Rides::default();
            if !self.facing(&wheel) {
                let path_points = self.rim(group, &wheel);
                let (rim, center) = (path_points.first().copied(), self.stage.at(group, wheel.center));
                let axis = self.numbers.frames[0][wheel.frame.index()].shown([0.0, 0.0, 1.0]);
                self.put("outline", &path, Place { path: path_points, ..Place::default() });
                self.leaning(group, (wheel.center, axis));
                // a mark, without which a turning wheel seems to stand
                if let Some(to) = rim {
                    self.put("spoke", &path, Place { at: center, to, ..Place::default() });
                }
                continue;
            }
            let at = self.stage.at(group, wheel.center);
            let turn = self.numbers.frames[0][wheel.frame.index()].angle() + 0.7;
            let size = self.long(wheel.radius);
            self.put(wheel.symbol, &path, Place { at, size, other: 0.78 * size, turn, ..Place::default() });
            if group == 0 {
                let foot = [at[0], at[1] + size];
                self.put("wall", "ground", Place { at: [foot[0] - S, foot[1]], to: [foot[0] + S, foot[1]], ..Place::default() });
            }
        }
    }

    /// Whether a wheel is seen as a circle.
    pub(super) fn facing(&self, wheel: &Wheel) -> bool {
        let axis = self.numbers.frames[0][wheel.frame.index()].shown([0.0, 0.0, 1.0]);
        // a thousandth of a radian off is still a circle to the eye
        self.stage.axes.iter().all(|a| dot(*a, axis).abs() < 1e-3)
    }

    /// The points of the rim that was put last go with the axis of their wheel.
    fn leaning(&mut self, group: usize, (center, axis): (V3, V3)) {
        let Some(points) = self.scheme.items.last().map(|item| item.place.path.clone()) else { return };
        let mut via = Vec::new();
        for p in points {
            let at = self.stage.point(p, group).map_or(center, |known| known.1);
            via.push(Via { track: self.carrier(Carrier::Lean { group, center, axis, at }), drum: None });
        }
        if let Some(item) = self.scheme.items.last_mut() {
            item.rides.path = via;
        }
    }

    fn rim(&self, group: usize, wheel: &Wheel) -> Vec<P> {
        let pose = self.numbers.frames[0][wheel.frame.index()];
        let (u, v) = (pose.shown([1.0, 0.0, 0.0]), pose.shown([0.0, 1.0, 0.0]));
        let place = |i: i32| {
            let a = TAU * f64::from(i) / 48.0;
            self.stage.at(group, plus(plus(wheel.center, wheel.radius * a.cos(), u), wheel.radius * a.sin(), v))
        };
        (0..48).map(place).collect()
    }

    /// A body that turns: its places are joined.
    fn link(&mut self, group: usize) {
        let path = self.groups.all[group].path.clone();
        let mut spots = self.spots(group);
        let look = self.looks[group].clone();
        if !look.boxes.is_empty() {
            self.boxes(group);
        }
        if look.wheels.iter().any(|w| !self.facing(w)) {
            // an axle through its wheels
            let centers = look.wheels.iter().map(|w| self.stage.at(group, w.center));
            spots.extend(centers.collect::<Vec<_>>());
            self.line(&path, &spots);
            return;
        }
        if self.spins(group) {
            return self.rotor(group, &look);
        }
        if let Some(wheel) = look.wheels.iter().max_by(|a, b| a.radius.total_cmp(&b.radius)) {
            let center = self.stage.at(group, wheel.center);
            for spot in spots.into_iter().filter(|p| distance(*p, center) > 3.0) {
                self.put("link", &path, Place { at: center, to: spot, ..Place::default() });
            }
            return;
        }
        let masses: Vec<P> = self.loads_of(&look, group, &spots);
        let ends = spots.len();
        spots.extend(
            masses
                .iter()
                .copied()
                .filter(|m| ends < 2 || look.centers.iter().any(|c| c.1 && distance(self.stage.at(group, c.0), *m) < 1.0)),
        );
        match &spots[..] {
            [] => {}
            [only] => {
                let particle = look.centers.iter().all(|c| c.1);
                if self.groups.all[group].heavy && !self.is_axle(group) && !particle {
                    self.put("disc", &path, Place { at: *only, size: 1.4 * S, turn: 0.7, ..Place::default() });
                }
            }
            [a, b] => self.put("link", &path, Place { at: *a, to: *b, ..Place::default() }),
            many if self.groups.all[group].joint == Joint::Held => self.bent(&path, many),
            many => self.many(&path, many),
        }
        for (center, is_point) in &look.centers {
            let at = self.stage.at(group, *center);
            if *is_point {
                self.put("ball", &path, Place { at, ..Place::default() });
            } else if self.looks[group].boxes.is_empty() && spots.len() > 1 && spots.iter().all(|s| distance(*s, at) > 8.0) {
                self.put("point", &path, Place { at, ..Place::default() });
            } else if ends < 2 && masses.iter().any(|m| distance(*m, at) < 1.0) && self.looks[group].boxes.is_empty() {
                // the mass centre of a body of unknown shape; a ball is a point mass
                self.put("center", &path, Place { at, ..Place::default() });
            }
        }
    }

    /// Whether all of a group's mass is on its axis and something else on it is drawn.
    fn is_axle(&self, group: usize) -> bool {
        self.groups.all.iter().any(|g| g.carrier == group) && self.looks[group].centers.is_empty()
    }

    /// Mass centres that are not among the places.
    fn loads_of(&self, look: &Look, group: usize, spots: &[P]) -> Vec<P> {
        let seen = look.centers.iter().map(|c| self.stage.at(group, c.0));
        seen.filter(|c| spots.iter().all(|s| distance(*s, *c) > 3.0)).collect()
    }

    /// Whether a group turns in a given way and carries its mass off its axis.
    fn spins(&self, group: usize) -> bool {
        let g = &self.groups.all[group];
        let driven = g.frames.iter().any(|f| self.machine.model.frames[f.index()].spin.is_some());
        driven && self.looks[group].wheels.is_empty() && g.joint == Joint::Turns && !self.looks[group].centers.is_empty()
    }

    /// A rotor with its unbalance.
    fn rotor(&mut self, group: usize, look: &Look) {
        let path = self.groups.all[group].path.clone();
        let at = self.origin(self.groups.all[group].root);
        let to = look
            .centers
            .iter()
            .map(|c| self.stage.at(group, c.0))
            .max_by(|a, b| distance(at, *a).total_cmp(&distance(at, *b)))
            .unwrap_or(at);
        let off = distance(at, to);
        // eccentricities are drawn as large as they are seen best; on a block they stay inside
        let inside = self.blocks[self.groups.all[group].carrier].is_some();
        let far = if inside { 0.45 * S } else { off.max(0.5 * S) };
        let to = polar(at, far, if off > 0.0 { direction(at, to) } else { 0.7 });
        self.put("rotor", &path, Place { at, to, size: if inside { 0.68 * S } else { (1.3 * far).max(1.1 * S) }, ..Place::default() });
    }

    /// A line through places that lie on one.
    fn line(&mut self, path: &str, spots: &[P]) {
        let Some(&first) = spots.first() else { return };
        let far = |from: P| spots.iter().copied().max_by(|a, b| distance(from, *a).total_cmp(&distance(from, *b))).unwrap_or(from);
        let a = far(first);
        self.put("link", path, Place { at: a, to: far(a), ..Place::default() });
    }

    /// A bent bar: from one place to the nearest of the others, and so on.
    fn bent(&mut self, path: &str, spots: &[P]) {
        let mut left = spots.to_vec();
        let mut here = left.remove(0);
        while !left.is_empty() {
            let nearest = (0..left.len()).min_by(|a, b| distance(here, left[*a]).total_cmp(&distance(here, left[*b]))).unwrap_or(0);
            let next = left.remove(nearest);
            self.put("link", path, Place { at: here, to: next, ..Place::default() });
            here = next;
        }
    }

    /// Three places and more: a line where they lie on one, else a plate.
    fn many(&mut self, path: &str, spots: &[P]) {
        let far = |from: P| spots.iter().copied().max_by(|a, b| distance(from, *a).total_cmp(&distance(from, *b))).unwrap_or(from);
        let a = far(spots[0]);
        let b = far(a);
        let turn = direction(a, b);
        let off = |p: P| ((p[0] - a[0]) * turn.sin() + (p[1] - a[1]) * turn.cos()).abs();
        if spots.iter().all(|p| off(*p) < 2.5) {
            self.put("link", path, Place { at: a, to: b, ..Place::default() });
        } else {
            self.put("plate", path, Place { path: hull(spots), ..Place::default() });
        }
    }

    fn boxes(&mut self, group: usize) {
        let path = self.groups.all[group].path.clone();
        for (center, half, frame) in self.looks[group].boxes.clone() {
            let pose = self.numbers.frames[0][frame.index()];
            let corner = |x: f64, y: f64| {
                let p = plus(plus(center, x * half[0], pose.shown([1.0, 0.0, 0.0])), y * half[1], pose.shown([0.0, 1.0, 0.0]));
                self.stage.at(group, p)
            };
            let corners = vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
            self.put("outline", &path, Place { path: corners, ..Place::default() });
        }
    }

    fn block(&mut self, group: usize) {
        let Some(block) = self.blocks[group] else { return };
        let path = self.groups.all[group].path.clone();
        let outside = |p: &P| distance(*p, block.center) > block.reach(direction(block.center, *p)) + 1.0;
        for spot in self.spots(group).into_iter().filter(outside) {
            self.put("link", &path, Place { at: block.center, to: spot, ..Place::default() });
        }
        let place = Place { at: block.center, size: block.half[0], other: block.half[1], turn: block.turn, ..Place::default() };
        let (slides, guided, hangs) = (matches!(self.groups.all[group].joint, Joint::Slides(_)), self.is_guided(group), self.hangs(group));
        let on_ground = self.groups.all[group].carrier == 0;
        match (slides, guided, hangs) {
            (true, true, _) => {
                if on_ground {
                    self.guides(group);
                }
                self.put("block", &path, place);
            }
            (true, false, false) if on_ground && !self.rubs(group) => {
                self.floor(group, 0.34 * S);
                self.put("cart", &path, place);
            }
            (true, false, false) if on_ground => {
                self.floor(group, 0.0);
                self.put("block", &path, place);
                self.rough(group);
            }
            _ => self.put("block", &path, place),
        }
    }

    /// Bodies without mass that do not turn: a slider where one is held, lines to its places.
    fn mover(&mut self, group: usize) {
        let spots = self.spots(group);
        let path = self.groups.all[group].path.clone();
        if self.groups.all[group].heavy && self.looks[group].wheels.is_empty() {
            for (center, _) in self.looks[group].centers.clone() {
                let at = self.stage.at(group, center);
                self.put("ball", &path, Place { at, ..Place::default() });
            }
            return;
        }
        let carries = self.groups.all.iter().enumerate().any(|(i, g)| g.carrier == group && !self.looks[i].wheels.is_empty());
        if !self.looks[group].wheels.is_empty() || spots.is_empty() || carries {
            return;
        }
        if spots.len() > 1 {
            match &spots[..] {
                [a, b] => self.put("link", &path, Place { at: *a, to: *b, ..Place::default() }),
                many => self.many(&path, many),
            }
        }
        if let (Joint::Slides(way), 0, true) = (self.groups.all[group].joint, self.groups.all[group].carrier, self.is_pinned(group)) {
            let turn = self.stage.turn(way).unwrap_or(0.0);
            let at = self.middle(group);
            let half = 1.8 * S;
            let [back, forth] = self.swept_at(group, turn);
            let reach = |far: f64| [at[0] + far * turn.cos(), at[1] - far * turn.sin()];
            self.put("guides", "ground", Place { at: reach(back - half), to: reach(forth + half), other: 0.42 * S, ..Place::default() });
            self.put("slider", &path, Place { at, turn, ..Place::default() });
        }
    }
}

/// The convex hull, by angles about the lowest point.
fn hull(points: &[P]) -> Vec<P> {
    let mut sorted = points.to_vec();
    sorted.arrange_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let cross = |o: P, a: P, b: P| (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
    let half = |points: &mut dyn Iterator<Item = P>| {
        let mut chain: Vec<P> = Vec::new();
        for p in points {
            while chain.len() >= 2 && cross(chain[chain.len() - 2], chain[chain.len() - 1], p) <= 0.0 {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut out = half(&mut sorted.iter().copied());
    out.extend(half(&mut sorted.iter().rev().copied()));
    out
}
