//! Letters and numbers: bodies, points, coordinates, lengths, masses, gravity.

use super::groups::Joint;
use super::numbers::{STILL, minus, norm};
use super::sketch::Sketch;
use crate::connections::Own;
use mechanics::model::FrameId;
use report::scheme::{Label, LabelText, P, Place, Rides, S, between, direction, distance, polar};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use words::{Language, Text};

/// Radius of a wheel that holds its letter.
const SMALL: f64 = 0.9 * S;
/// Radius of a wheel that is seen as one.
const DOT: f64 = 0.4 * S;

impl Sketch<'_> {
    /// Names of points and the number of a body that is drawn alone.
    pub(super) fn letters_of_body(&mut self, group: usize) {
        let acting = std::mem::take(&mut self.scheme.labels);
        self.bodies_numbered();
        let others = self.looks.clone();
        self.looks.iter_mut().enumerate().filter(|(i, _)| *i != group).for_each(|(_, l)| l.spots.clear());
        self.points_named();
        self.looks = others;
        self.scheme.labels.extend(acting);
        self.summary();
    }

    /// A label beside a place.
    pub(super) fn note(&mut self, text: LabelText, at: P, away: f64, side: Option<f64>) {
        let rides = if self.signing { None } else { Some(self.rides.clone()) };
        self.scheme.label(Label { text, at, away, side, rides });
    }

    /// All letters; numbers of bodies and names of points come first.
    pub(super) fn signs(&mut self) {
        let acting = std::mem::take(&mut self.scheme.labels);
        self.bodies_numbered();
        self.points_named();
        self.scheme.labels.extend(acting);
        self.signing = true;
        self.coordinates();
        self.lengths();
        self.signing = false;
        self.masses();
        self.rides = Rides::default();
        self.gravity();
        self.summary();
    }

    fn bodies_numbered(&mut self) {
        for i in 1..self.groups.all.len() {
            let group = &self.groups.all[i];
            if group.body && self.scheme.items.iter().any(|item| item.path == group.path) {
                let (at, away) = self.place_of_number(i);
                self.number(i, at, away);
            }
        }
    }

    /// Gives a group the next number.
    pub(super) fn number(&mut self, group: usize, at: P, away: f64) {
        // the least of its bodies' numbers, as in the written calculation
        let numbers = crate::numbering::numbers(&self.machine.model);
        let next = self.groups.all[group].frames.iter().filter_map(|f| numbers[f.index()]).min().unwrap_or(0);
        self.groups.all[group].number = next;
        self.rides = Rides::on(group);
        self.note(LabelText::Number(next), at, away, None);
    }

    fn place_of_number(&self, group: usize) -> (P, f64) {
        if let Some(block) = self.blocks[group] {
            let roomy = block.half[0].min(block.half[1]) > 0.6 * S;
            return (block.center, if roomy { 0.0 } else { 8.0 });
        }
        let look = &self.looks[group];
        if let Some(wheel) = look.wheels.iter().max_by(|a, b| a.radius.total_cmp(&b.radius)) {
            let r = self.long(wheel.radius);
            let center = self.stage.at(group, wheel.center);
            return if r > 1.6 * S { (polar(center, 0.62 * r, 2.4), 1.0) } else { (center, r + 3.0) };
        }
        let path = &self.groups.all[group].path;
        let item = |name: &str| self.scheme.items.iter().find(|i| i.path == *path && i.symbol.name == name).map(|i| i.place.clone());
        if let Some(link) = item("link") {
            return (between(link.at, link.to, 0.55), 5.0);
        }
        if let Some(plate) = item("plate") {
            let n = plate.path.len().max(1) as f64;
            let sum = plate.path.iter().fold([0.0; 2], |s, p| [s[0] + p[0] / n, s[1] + p[1] / n]);
            return (sum, 1.0);
        }
        match item("ball") {
            Some(ball) => (ball.at, 10.0),
            None => (self.middle(group), 1.4 * S),
        }
    }

    fn points_named(&mut self) {
        let mut named: Vec<(P, String, usize)> = Vec::new();
        let connections: Vec<String> = self.machine.model.connections.iter().map(|c| c.name.clone()).collect();
        for (i, look) in self.looks.iter().enumerate() {
            for spot in &look.spots {
                // words for points of the file are no letters of a figure
                let Some(name) = spot.name.as_ref().filter(|n| n.chars().filter(|c| c.is_alphabetic()).count() <= 2) else { continue };
                let at = self.stage.at(i, spot.at);
                match named.iter_mut().find(|(p, ..)| distance(*p, at) < 4.0) {
                    // of coinciding points the one that gives its joint the name
                    Some(known) if connections.contains(name) && !connections.contains(&known.1) => known.1.clone_from(name),
                    Some(_) => {}
                    None => named.push((at, name.clone(), i)),
                }
            }
        }
        for (at, name, group) in named {
            self.rides = Rides::on(group);
            if !self.scheme.items.iter().any(|item| item.place.at == at || item.place.to == at || item.place.path.contains(&at)) {
                self.put("point", "points", Place { at, ..Place::default() });
            }
            let text = self.letters.named(&name);
            self.note(text, at, 7.0, None);
        }
    }

    fn coordinates(&mut self) {
        let model = &self.machine.model;
        let names: Vec<String> = model.coordinates.iter().map(|c| c.name.clone()).collect();
        let mut taken = vec![0usize; self.groups.all.len()];
        for (j, name) in names.iter().enumerate() {
            let Some(group) = self.turned_with(j).or_else(|| self.moved_with(j)) else { continue };
            let state = self.numbers.moved(j);
            let root = self.groups.all[group].root;
            let (a, b) = (self.numbers.frames[0][root.index()], self.numbers.frames[state][root.index()]);
            let way = minus(b.origin, a.origin);
            let path = format!("coordinates.{name}");
            let text = self.letters.named(name);
            if norm(way) > STILL && self.groups.all[group].joint != Joint::Turns && self.pin_of([0, group]).is_none() {
                let Some(turn) = self.stage.turn(way) else { continue };
                let from = self.beside(group, turn, taken[group]);
                taken[group] += 1;
                let tip = polar(from, 1.7 * S, turn);
                self.put("coordinate", &path, Place { at: from, to: tip, ..Place::default() });
                self.note(text, tip, 5.0, Some(turn + 0.7));
            } else {
                let by = (b.angle() - a.angle() + PI).rem_euclid(TAU) - PI;
                self.angle((group, root), (j, by), (path, text));
            }
        }
    }

    /// The first group whose angle a coordinate is: what turns a multiple of it is told by its own wheels.
    fn turned_with(&self, j: usize) -> Option<usize> {
        let (values, state) = (self.numbers.coordinate(j), self.numbers.moved(j));
        let by = values[state] - values[0];
        let angle = |i: usize, s: usize| self.numbers.frames[s][self.groups.all[i].root.index()].angle();
        let turned = |i: &usize| ((angle(*i, state) - angle(*i, 0) + PI).rem_euclid(TAU) - PI).abs();
        let is_angle = self.machine.model.coordinates[j].units[0] == "rad";
        (1..self.groups.all.len()).filter(|_| is_angle).find(|i| (turned(i) - by).abs() < STILL)
    }

    /// Where the arrow of a displacement begins: above or beside what is drawn.
    fn beside(&self, group: usize, turn: f64, rank: usize) -> P {
        let middle = self.middle(group);
        let up = if turn.sin().abs() > 0.7 { 0.0 } else { FRAC_PI_2 };
        let reach = match self.blocks[group] {
            Some(block) => block.reach(up) + 0.5 * S,
            None => self.looks[group].wheels.iter().map(|w| self.long(w.radius)).fold(0.5 * S, f64::max) + 0.4 * S,
        };
        polar(middle, reach + 0.6 * S * rank as f64, up)
    }

    /// An angle of a body from the direction in which its coordinate is zero.
    fn angle(&mut self, (group, root): (usize, FrameId), (j, by): (usize, f64), (path, text): (String, LabelText)) {
        let pivot = self.pin_of([0, group]).unwrap_or_else(|| self.origin(root));
        let spots = self.looks[group].spots.iter().map(|s| s.at).chain(self.looks[group].centers.iter().map(|c| c.0));
        let spots: Vec<P> = spots.map(|p| self.stage.at(group, p)).collect();
        let far = spots.iter().copied().max_by(|a, b| distance(pivot, *a).total_cmp(&distance(pivot, *b))).unwrap_or(pivot);
        let wheel = self.looks[group].wheels.iter().map(|w| self.long(w.radius)).fold(0.0, f64::max);
        let taken = self.scheme.items.iter().filter(|i| i.symbol.name == "angle" && distance(i.place.at, pivot) < 4.0).count() as f64;
        let sense = if by < 0.0 { -1.0 } else { 1.0 };
        if distance(pivot, far) < 0.8 * S || by == 0.0 {
            let size = wheel.max(1.4 * S) + 0.55 * S + 0.5 * S * taken;
            let turn = 0.9 - sense * 0.45;
            self.put("angle", &path, Place { at: pivot, size, turn, other: sense * 0.9, ..Place::default() });
            self.note(text, polar(pivot, size, 0.9), 5.0, Some(0.9));
            return;
        }
        let link = direction(pivot, far);
        let q = self.at.q.get(j).copied().unwrap_or(0.0);
        let value = (sense * q + PI).rem_euclid(TAU) - PI;
        let zero = link - value;
        let size = (0.42 * distance(pivot, far)).clamp(1.3 * S, 2.4 * S) + 0.35 * S * taken;
        self.put("reference", &path, Place { at: pivot, to: polar(pivot, size + 0.7 * S, zero), ..Place::default() });
        let (from, sweep) = if value.abs() * size > 9.0 { (zero, value) } else { (link, sense * 0.55) };
        self.put("angle", &path, Place { at: pivot, size, turn: from, other: sweep, ..Place::default() });
        let middle = from + sweep / 2.0;
        self.note(text, polar(pivot, size, middle), 4.0, Some(middle));
    }

    /// Lengths of links and radii of wheels that have letters.
    fn lengths(&mut self) {
        let mut known: Vec<(usize, symbolic::Expr)> = Vec::new();
        for i in 0..self.groups.all.len() {
            let look = self.looks[i].clone();
            for (from, to, formula) in look.lengths {
                let (a, b) = (self.stage.at(i, from), self.stage.at(i, to));
                let Some(text) = self.letters.symbol(formula).filter(|_| distance(a, b) > 1.6 * S && !known.contains(&(i, formula))) else {
                    continue;
                };
                known.push((i, formula));
                if i == 0 {
                    let below = direction(a, b).cos().signum();
                    self.put("dimension", "ground", Place { at: a, to: b, size: -2.1 * S * below, ..Place::default() });
                    self.note(text, polar(between(a, b, 0.5), 2.1 * S, -FRAC_PI_2), 4.0, Some(-FRAC_PI_2));
                    continue;
                }
                let inside = look.wheels.iter().any(|w| self.long(w.radius) > distance(a, b));
                if inside {
                    self.note(text, between(a, b, 0.55), 4.0, None);
                } else {
                    self.note(text, between(a, b, 0.42), 5.0, Some(direction(a, b) + FRAC_PI_2));
                }
            }
            for (k, wheel) in look.wheels.iter().enumerate() {
                let r = self.long(wheel.radius);
                let Some(text) = self.letters.symbol(wheel.formula).filter(|_| r > DOT && !known.contains(&(i, wheel.formula))) else {
                    continue;
                };
                known.push((i, wheel.formula));
                if !self.facing(wheel) {
                    continue;
                }
                let (center, turn) = (self.stage.at(i, wheel.center), -0.9 - 0.75 * k as f64);
                let rim = polar(center, r, turn);
                let path = self.groups.all[i].path.clone();
                // a small wheel has no room for a letter: its arrow comes from outside
                let (from, beside) = if r > SMALL {
                    (center, between(center, rim, 0.6))
                } else {
                    let outside = polar(center, r + 1.3 * S, turn);
                    (outside, outside)
                };
                self.put("radius", &path, Place { at: from, to: rim, ..Place::default() });
                self.note(text, beside, 3.0, None);
            }
        }
    }

    fn masses(&mut self) {
        let model = &self.machine.model;
        let mut found = Vec::new();
        for (i, frame) in model.frames.iter().enumerate() {
            let Some(mass) = &frame.mass else { continue };
            let Some(text) = self.letters.symbol(mass.mass) else { continue };
            let group = self.groups.of(FrameId(i));
            let center = self.numbers.at(0, mechanics::model::PointRef::Center(FrameId(i)));
            // an unbalance is drawn farther from its axis than it is
            let path = &self.groups.all[group].path;
            let drawn = self.scheme.items.iter().find(|i| i.symbol.name == "rotor" && i.path == *path).map(|i| i.place.to);
            let real = || drawn.unwrap_or_else(|| self.stage.at(group, center));
            let at = self.blocks[group].map_or_else(real, |b| b.center);
            let away = match self.blocks[group] {
                Some(block) => block.half[1] + 3.0,
                None => {
                    let wheel = self.looks[group].wheels.iter().filter(|w| self.facing(w)).map(|w| self.long(w.radius)).fold(0.0, f64::max);
                    if wheel > 0.0 { wheel + 3.0 } else { 8.0 }
                }
            };
            found.push((text, at, away, group));
        }
        for (text, at, away, group) in found {
            self.rides = Rides::on(group);
            self.note(text, at, away, Some(0.7));
        }
    }

    /// The direction of gravity, at the right edge.
    fn gravity(&mut self) {
        let model = &self.machine.model;
        let Some(g) = model.gravity.filter(|_| model.frames.iter().any(|f| f.mass.as_ref().is_some_and(|m| m.gravity))) else { return };
        let vector = g.map(|e| self.numbers.value(self.machine, e));
        let Some(turn) = self.stage.turn(vector) else { return };
        let places =
            self.scheme.items.iter().flat_map(|i| [Some(i.place.at), Some(i.place.to).filter(|_| i.place.to != [0.0; 2])]).flatten();
        let (right, top) = places.fold((f64::NEG_INFINITY, f64::INFINITY), |(r, t), p| (r.max(p[0]), t.min(p[1])));
        if !right.is_finite() {
            return;
        }
        let at = [right + 2.6 * S, top];
        let tip = polar(at, 1.8 * S, turn);
        self.put("gravity", "gravity", Place { at, to: tip, ..Place::default() });
        self.note(LabelText::Symbol("g".into()), between(at, tip, 0.5), 5.0, Some(0.0));
    }

    /// What is drawn, in words.
    pub(super) fn summary(&mut self) {
        let language = self.language;
        let mut lines = Vec::new();
        for group in self.groups.all.iter().skip(1).filter(|g| g.number > 0) {
            let bodies = group.frames.iter().map(|f| &self.machine.model.frames[f.index()]).filter(|f| f.is_body);
            let names: Vec<&str> = bodies.map(|f| told(&f.label, &f.name, language)).collect();
            lines.push(format!("{} – {}", group.number, names.join(", ")));
        }
        let model = &self.machine.model;
        let of_frame = |e: &&mechanics::model::Element| model.structure.is_some() && e.span.is_empty();
        // of a body alone only what acts on it
        let alone = self.scheme.name.starts_with("body-");
        let drawn = |path: &str| !alone || self.scheme.items.iter().any(|item| item.path == path);
        let elements = model.elements.iter().filter(|e| !of_frame(e) && drawn(&e.path)).map(|e| told(&e.label, &e.name, language));
        let connections = model.connections.iter().filter(|c| drawn(&Own::of(c).path)).map(|c| told(&c.label, &c.name, language));
        let mut others: Vec<&str> = connections.chain(elements).collect();
        // a load in several parts is one load of the file
        others.dedup();
        if !others.is_empty() {
            lines.push(format!("{}: {}", language.pick("connections and loads", "связи и нагрузки"), others.join(", ")));
        }
        if let Some(structure) = &model.structure {
            let nodes: Vec<&str> = structure.nodes.iter().map(|n| n.name.as_str()).collect();
            lines.push(format!("{}: {}", language.pick("nodes", "узлы"), nodes.join(", ")));
        }
        self.scheme.summary = lines;
    }
}

/// What the file calls something: its label, else its name.
fn told<'m>(label: &'m Text, name: &'m str, language: Language) -> &'m str {
    let label = language.text(label);
    if label.is_empty() { name } else { label }
}
