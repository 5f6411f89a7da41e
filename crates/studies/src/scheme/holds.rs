//! What holds bodies: hinges, supports, guides, floors, tracks.

use super::ends::Ends;
use super::groups::Joint;
use super::numbers::STILL;
use super::pinned::Pin;
use super::sketch::{Act, Sketch};
use crate::connections::{Held, Layer, Rolls, Support};
use crate::shown::{Role, role, role_at};
use mechanics::model::{FrameId, PointRef, SupportDirection, Track};
use report::scheme::{P, Place, Rides, S, direction, distance, polar};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

impl Sketch<'_> {
    /// Hinges and supports.
    pub(super) fn holds(&mut self) {
        self.layer(Layer::Supports);
        self.layer(Layer::Joints);
        for i in 1..self.groups.all.len() {
            let group = &self.groups.all[i];
            if group.joint != Joint::Turns || self.is_shaft(i) {
                continue;
            }
            let (at, path, on_ground) = (self.origin(group.root), group.path.clone(), group.carrier == 0);
            self.rides = Rides::on(group.carrier);
            if !group.body && mechanics::is_spatial(&self.machine.model) {
                self.rides = Rides::on(i);
                self.axes_of(group.root);
                continue;
            }
            self.hinge(at, &path, on_ground.then_some(()));
        }
        for pin in self.pins.clone() {
            self.hinge_of_formulas(&pin);
        }
    }

    /// A hinge that follows from formulas: on the ground, on the other body, or on a slider that moves in a given way.
    fn hinge_of_formulas(&mut self, pin: &Pin) {
        let [a, b] = pin.groups;
        let at = self.stage.at(b, pin.at);
        let path = self.groups.all[b].path.clone();
        self.rides = Rides::on(if pin.driven.is_some() { b } else { a });
        let Some(turn) = pin.driven.and_then(|way| self.stage.turn(way)) else {
            return self.hinge(at, &path, (a == 0).then_some(()));
        };
        if self.hinges.iter().any(|p| distance(*p, at) < 4.0) {
            return;
        }
        let turn = if turn.sin() < -STILL || turn.cos() < -0.5 { turn + PI } else { turn };
        let [back, forth] = self.swept_at(b, turn);
        let (from, to) = (polar(at, back - 1.5 * S, turn), polar(at, forth + 1.5 * S, turn));
        self.put("guides", "ground", Place { at: from, to, other: 0.42 * S, ..Place::default() });
        self.rides = Rides::along(b);
        self.put("slider", "ground", Place { at, turn, ..Place::default() });
        if let Some(slider) = self.scheme.items.last_mut() {
            slider.rides = Rides::along(b);
        }
        let tail = polar(polar(at, 1.3 * S, turn - FRAC_PI_2), -1.1 * S, turn);
        self.put("motion", "frames", Place { at: tail, to: polar(tail, 2.2 * S, turn), ..Place::default() });
        self.hinge(at, &path, None);
    }

    /// The axes of a frame.
    fn axes_of(&mut self, frame: FrameId) {
        let pose = self.numbers.frames[0][frame.index()];
        let at = self.origin(frame);
        let tip = |v: [f64; 3]| {
            let long = self.stage.axes.map(|a| super::numbers::dot(a, v));
            [at[0] + 2.4 * S * long[0], at[1] - 2.4 * S * long[1]]
        };
        let path = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|v| tip(pose.shown(v))).to_vec();
        let name = format!("frames.{}", self.machine.model.frames[frame.index()].name);
        self.put("axes", &name, Place { at, path, ..Place::default() });
    }

    /// A body that turns about an axis in the plane of the picture.
    fn is_shaft(&self, group: usize) -> bool {
        !self.looks[group].wheels.is_empty() && !self.looks[group].wheels.iter().all(|w| self.facing(w))
    }

    /// A hinge, once at a place; with a stand on the ground.
    fn hinge(&mut self, at: P, path: &str, ground: Option<()>) {
        if self.hinges.iter().any(|p| distance(*p, at) < 4.0) {
            return;
        }
        self.hinges.push(at);
        match ground {
            Some(()) => {
                let turn = self.free_side(at);
                self.put("pin_fixed", path, Place { at, turn, ..Place::default() });
            }
            None => self.put("pin", path, Place { at, ..Place::default() }),
        }
    }

    /// The side of a place on which the least is drawn; below where all are alike.
    pub(super) fn free_side(&self, at: P) -> f64 {
        let busy = self.busy(at);
        let cost = |turn: f64| busy.iter().map(|b| (1.0 - ((b - turn + PI).rem_euclid(TAU) - PI).abs() / 1.2).max(0.0)).sum::<f64>();
        let sides = [(-FRAC_PI_2, 0.0), (FRAC_PI_2, 0.15), (PI, 0.2), (0.0, 0.2)];
        let best = sides.into_iter().min_by(|a, b| (cost(a.0) + a.1).total_cmp(&(cost(b.0) + b.1)));
        best.map_or(-FRAC_PI_2, |b| b.0)
    }

    /// Directions in which something leaves a place.
    pub(super) fn busy(&self, at: P) -> Vec<f64> {
        let mut out = Vec::new();
        for item in &self.scheme.items {
            let place = &item.place;
            let near = |p: P| distance(p, at) < 4.0;
            let ways: Vec<P> = match item.symbol.name {
                "link" | "rigid" | "rod" | "spring" | "damper" => vec![place.at, place.to],
                "thread" => place.path.clone(),
                "plate" => {
                    if place.path.iter().any(|p| near(*p)) {
                        out.extend(place.path.iter().filter(|p| !near(**p)).map(|p| direction(at, *p)));
                    }
                    continue;
                }
                _ => continue,
            };
            for (i, p) in ways.iter().enumerate().filter(|(_, p)| near(**p)) {
                let others = [i.checked_sub(1), Some(i + 1)].into_iter().flatten().filter_map(|k| ways.get(k));
                out.extend(others.map(|q| direction(*p, *q)));
            }
        }
        out
    }

    /// A hinge where two points coincide.
    pub(super) fn pinned(&mut self, path: &str, [a, b]: [PointRef; 2]) {
        let on_ground = self.group_of(a) == 0 || self.group_of(b) == 0;
        let at = self.seen(if self.group_of(a) == 0 { a } else { b });
        self.rides = Rides::on(if on_ground { 0 } else { self.group_of(b) });
        self.hinge(at, path, on_ground.then_some(()));
    }

    /// A rigid joint of two points.
    pub(super) fn welded(&mut self, path: &str, [a, b]: [PointRef; 2]) {
        let at = self.seen(a);
        self.rides = Rides::on(self.group_of(a));
        if self.group_of(a) == 0 || self.group_of(b) == 0 {
            let turn = self.busy(at).first().map_or(-FRAC_PI_2, |t| t + PI);
            self.put("clamp", path, Place { at, turn, ..Place::default() });
        } else {
            let turn = self.busy(at).first().map_or(0.0, |t| t + PI);
            self.put("weld", path, Place { at, turn, ..Place::default() });
        }
        self.hinges.push(at);
    }

    /// Hinges at the ends of a rod.
    pub(super) fn hinged_ends(&mut self, path: &str, between: [PointRef; 2]) {
        for end in between {
            let at = self.seen(end);
            let on_ground = self.group_of(end) == 0;
            self.rides = Rides::on(self.group_of(end));
            self.hinge(at, path, on_ground.then_some(()));
        }
    }

    pub(super) fn slider(&mut self, path: &str, (point, on): (PointRef, FrameId), along: symbolic::Expr) {
        let at = self.seen(point);
        let pose = self.numbers.frames[0][on.index()];
        let angle = self.numbers.value(self.machine, along);
        let turn = self.stage.turn(pose.shown([angle.cos(), angle.sin(), 0.0])).unwrap_or(0.0);
        let on_ground = self.groups.of(on) == 0;
        let is_slot = role_at(path) == Role::Slot;
        let half = if is_slot { 2.2 * S } else { 1.7 * S };
        let [back, forth] = if on_ground { self.swept_point(point, turn) } else { [0.0; 2] };
        let (a, b) = (polar(at, back - half, turn), polar(at, forth + half, turn));
        let (bearer, block) = (self.groups.of(on), self.group_of(point));
        // the way lies in its bearer, the block goes with the point and turns with the way
        self.rides = Rides::on(bearer);
        let slider = Rides::turning(block, bearer);
        match (is_slot, on_ground) {
            (true, _) => {
                self.put("slot", path, Place { at: a, to: b, ..Place::default() });
                self.rides = slider;
                self.put("slider", path, Place { at, turn, ..Place::default() });
            }
            (false, true) => {
                self.put("guides", "ground", Place { at: a, to: b, other: 0.42 * S, ..Place::default() });
                self.rides = slider;
                self.put("slider", path, Place { at, turn, ..Place::default() });
            }
            (false, false) => {
                self.put("link", path, Place { at: a, to: b, ..Place::default() });
                self.rides = slider;
                self.put("slider", path, Place { at, turn, ..Place::default() });
            }
        }
        self.hinges.retain(|p| distance(*p, at) > 4.0);
        self.hinge(at, path, None);
    }

    /// A support against what its body stands on.
    pub(super) fn supported(&mut self, path: &str, support: &Support) {
        let place = self.seen(support.at);
        let bearer = support.on.map_or(self.groups.all[self.group_of(support.at)].carrier, |f| self.groups.of(f));
        self.rides = Rides::on(bearer);
        // floors and guides of blocks show what holds them across their way
        let own = self.group_of(support.at);
        if self.blocks[own].is_some() && matches!(self.groups.all[own].joint, Joint::Slides(_)) {
            return;
        }
        if mechanics::is_spatial(&self.machine.model) && self.is_on_shaft(support.at) {
            self.put("bearing", path, Place { at: place, ..Place::default() });
            self.hinges.push(place);
            return;
        }
        if bearer != 0 {
            self.hinge(place, path, None);
            return;
        }
        let turned = self.numbers.frames[0][support.axes.index()].angle();
        let has = |d: SupportDirection| support.directions.contains(&d);
        let (x, y, fixed) = (has(SupportDirection::X), has(SupportDirection::Y), has(SupportDirection::TurnZ));
        let side = self.free_side(place);
        let symbol = match (x, y, fixed) {
            (true, true, true) => ("clamp", self.busy(place).first().map_or(side, |t| t + PI)),
            (true, true, false) => ("pin_fixed", side),
            (true, false, false) => ("support_roller", turned + if side.cos() < 0.5 { PI } else { 0.0 }),
            (false, true, false) => ("support_roller", turned + if side.sin() > 0.5 { FRAC_PI_2 } else { -FRAC_PI_2 }),
            (true, false, true) => ("clamp_guided", turned + if side.cos() < 0.5 { PI } else { 0.0 }),
            _ => ("clamp_guided", turned - FRAC_PI_2),
        };
        if self.hinges.iter().any(|p| distance(*p, place) < 4.0) {
            return;
        }
        self.hinges.push(place);
        self.put(symbol.0, path, Place { at: place, turn: symbol.1, ..Place::default() });
    }

    /// How far a point goes along a direction of the picture in the course of the motion, back and forth, pixels.
    fn swept_point(&self, point: PointRef, turn: f64) -> [f64; 2] {
        let group = self.group_of(point);
        let (root, first) = (self.groups.all[group].root.index(), self.numbers.at(0, point));
        let start = self.stage.place(group, first);
        let away = self.course.iter().map(|frames| {
            let p = self.stage.place(group, frames[root].carried(&self.numbers.frames[0][root], first));
            (p[0] - start[0]) * turn.cos() - (p[1] - start[1]) * turn.sin()
        });
        away.fold([0.0, 0.0], |[low, high], d| [low.min(d), high.max(d)])
    }

    fn is_on_shaft(&self, at: PointRef) -> bool {
        let group = self.group_of(at);
        self.is_shaft(group)
    }

    /// Whether dry friction acts on a group.
    pub(super) fn rubs(&self, group: usize) -> bool {
        self.acts.iter().any(|a| role(a.table) == Role::Friction && self.touches(a, group))
    }

    /// Whether an act has an end on a group.
    pub(super) fn touches(&self, act: &Act, group: usize) -> bool {
        match act.ends {
            Ends::Points(a, b) => self.group_of(a) == group || self.group_of(b) == group,
            Ends::Along { on, from, .. } => self.group_of(on) == group || from.is_some_and(|f| self.group_of(f) == group),
            Ends::Turn { on, from, .. } => self.groups.of(on) == group || self.groups.of(from) == group,
            Ends::Unknown => false,
        }
    }

    /// Whether a hinge, guide or slot is at a group.
    pub(super) fn is_pinned(&self, group: usize) -> bool {
        self.is_gripped(group, &[Held::Hinged, Held::Guides])
    }

    /// A hatched floor below a block.
    pub(super) fn floor(&mut self, group: usize, gap: f64) {
        let Some(block) = self.blocks[group] else { return };
        let low = polar(block.center, -(block.half[1] + gap), block.turn + FRAC_PI_2);
        let half = block.half[0] + 1.3 * S;
        let [back, forth] = self.swept_at(group, block.turn);
        let (from, to) = (polar(low, back - half, block.turn), polar(low, forth + half, block.turn));
        self.put("wall", "ground", Place { at: from, to, ..Place::default() });
    }

    /// Rough teeth below a block on which dry friction acts: drawn after the block, which would hide them.
    pub(super) fn rough(&mut self, group: usize) {
        if let Some(block) = self.blocks[group] {
            let low = polar(block.center, -block.half[1], block.turn + FRAC_PI_2);
            let (from, to) = (polar(low, -block.half[0], block.turn), polar(low, block.half[0], block.turn));
            let rubbing = self
                .acts
                .iter()
                .find(|a| role(a.table) == Role::Friction && self.touches(a, group))
                .map_or_else(String::new, |a| a.path.clone());
            self.rides = Rides::along(group);
            self.put("friction", &rubbing, Place { at: from, to, ..Place::default() });
        }
    }

    /// Guides on both sides of a block.
    pub(super) fn guides(&mut self, group: usize) {
        let Some(block) = self.blocks[group] else { return };
        let half = block.half[0] + 1.0 * S;
        let [back, forth] = self.swept_at(group, block.turn);
        let (from, to) = (polar(block.center, back - half, block.turn), polar(block.center, forth + half, block.turn));
        self.put("guides", "ground", Place { at: from, to, other: block.half[1] + 1.5, ..Place::default() });
    }

    /// Lines and circles on which wheels roll, racks, and where points rub.
    pub(super) fn tracks(&mut self) {
        self.layer(Layer::Tracks);
        self.layer(Layer::Rubbed);
    }

    /// What a wheel rolls on.
    pub(super) fn rolled_on(&mut self, path: &str, rolls: &Rolls) {
        let machine = self.machine;
        let (c, r) = (self.seen(rolls.center), self.long(self.numbers.value(machine, rolls.radius)));
        let bearer = self.groups.of(rolls.on);
        self.rides = Rides::on(bearer);
        let (along, left) = match rolls.track {
            Track::Line { direction, left, .. } => (direction, left),
            Track::Circle { center, radius, .. } => {
                let (at, size) = (self.seen(center), self.long(self.numbers.value(machine, radius)));
                self.put("track_circle", path, Place { at, size, ..Place::default() });
                return;
            }
        };
        let angle = self.numbers.value(machine, along);
        let pose = self.numbers.frames[0][rolls.on.index()];
        let turn = self.stage.turn(pose.shown([angle.cos(), angle.sin(), 0.0])).unwrap_or(0.0);
        let side = if left { 1.0 } else { -1.0 };
        let contact = polar(c, -r, turn + side * FRAC_PI_2);
        let half = (1.2 * r).clamp(2.2 * S, 6.0 * S);
        let [back, forth] = if bearer == 0 { self.swept_at(self.group_of(rolls.center), turn) } else { [0.0; 2] };
        let (a, b) = (polar(contact, back - half, turn), polar(contact, forth + half, turn));
        let (from, to) = if left { (a, b) } else { (b, a) };
        if role_at(path) == Role::Rack {
            // the teeth of the rack mesh with those of the wheel
            self.put("rack", path, Place { at: from, to, ..Place::default() });
            if bearer == 0 {
                let back = |p: P| polar(p, -9.0, turn + side * FRAC_PI_2);
                self.put("wall", "ground", Place { at: back(from), to: back(to), ..Place::default() });
            }
        } else if bearer == 0 {
            self.put("wall", path, Place { at: from, to, ..Place::default() });
            self.slope((from, to), along, path);
        } else {
            self.put("link", path, Place { at: from, to, ..Place::default() });
        }
    }

    /// The angle of an incline, where it has a letter.
    fn slope(&mut self, (a, b): (P, P), angle: symbolic::Expr, path: &str) {
        let Some(letter) = self.letters.symbol(angle) else { return };
        let low = if a[1] > b[1] { a } else { b };
        let high = if a[1] > b[1] { b } else { a };
        let turn = direction(low, high);
        let flat = if turn.cos() >= 0.0 { 0.0 } else { PI };
        let size = 1.7 * S;
        self.put("reference", path, Place { at: low, to: polar(low, 2.2 * S, flat), ..Place::default() });
        let sweep = (turn - flat + PI).rem_euclid(TAU) - PI;
        self.put("angle", path, Place { at: low, size, turn: flat, other: sweep, ..Place::default() });
        self.signing = true;
        self.note(letter, polar(low, size, flat + sweep / 2.0), 4.0, Some(flat + sweep / 2.0));
        self.signing = false;
    }
}
