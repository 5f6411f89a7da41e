//! What is to be seen of each group: the places that others hold it by, its wheels, its load.

use super::groups::{Groups, Joint, frame_of};
use super::numbers::{ALIKE, Numbers, Pose, STILL, V3, dot, minus, norm, plus};
use super::pinned::Pin;
use crate::connections::{self, Own, Place};
use crate::machine::Machine;
use mechanics::model::{FrameId, Inertia, Origin, PointId, PointRef, Site, Solid};
use symbolic::Expr;

/// A place of a group.
#[derive(Clone, Debug)]
pub struct Spot {
    /// Where.
    pub at: V3,
    /// Name of its point, when it has one.
    pub name: Option<String>,
    /// Whether something holds it there.
    pub held: bool,
}

/// A wheel of a group.
#[derive(Clone, Copy, Debug)]
pub struct Wheel {
    /// Its symbol.
    pub symbol: &'static str,
    /// Its centre.
    pub center: V3,
    /// Its radius, m.
    pub radius: f64,
    /// The formula of the radius.
    pub formula: Expr,
    /// The frame that it is on.
    pub frame: FrameId,
}

/// A group as it is seen.
#[derive(Clone, Debug, Default)]
pub struct Look {
    /// Places by which it is held, and named points.
    pub spots: Vec<Spot>,
    /// Its wheels.
    pub wheels: Vec<Wheel>,
    /// Mass centres of its bodies with mass, and whether they are point masses.
    pub centers: Vec<(V3, bool)>,
    /// Homogeneous boxes: centre, half lengths along the axes of a frame.
    pub boxes: Vec<(V3, [f64; 2], FrameId)>,
    /// Lengths of the file between two spots: from, to, formula.
    pub lengths: Vec<(V3, V3, Expr)>,
}

/// What is known of a spot besides its place.
enum Spotted<'a> {
    /// Nothing.
    Plain,
    /// Its name.
    Named(&'a str),
    /// A connection holds it; its name, if it has one.
    Held(Option<&'a str>),
}

impl Look {
    /// A spot with what else is known of it.
    fn spot(&mut self, at: V3, more: Spotted<'_>) {
        let (name, held) = match more {
            Spotted::Plain => (None, false),
            Spotted::Named(name) => (Some(name), false),
            Spotted::Held(name) => (name, true),
        };
        if !at.iter().all(|c| c.is_finite()) {
            return;
        }
        let size = self.spots.iter().map(|s| norm(minus(s.at, at))).fold(0.0, f64::max);
        if let Some(known) = self.spots.iter_mut().find(|s| norm(minus(s.at, at)) <= STILL * (1.0 + size)) {
            known.held |= held;
            known.name = known.name.take().or_else(|| name.map(str::to_owned));
            return;
        }
        self.spots.push(Spot { at, name: name.map(str::to_owned), held });
    }

    fn wheel(&mut self, wheel: Wheel) {
        let same = |w: &&mut Wheel| norm(minus(w.center, wheel.center)) < STILL && (w.radius - wheel.radius).abs() < ALIKE * w.radius;
        let real = wheel.radius.is_finite() && wheel.radius > 0.0;
        match self.wheels.iter_mut().find(same) {
            // teeth and grooves say more than a disc
            Some(known) if known.symbol == "disc" => known.symbol = wheel.symbol,
            Some(_) => {}
            None if real => self.wheels.push(wheel),
            None => {}
        }
    }
}

/// What is seen of all groups.
pub fn looks(machine: &Machine, (numbers, groups): (&Numbers, &Groups), (pins, arms): (&[Pin], &[(usize, V3)])) -> Vec<Look> {
    let mut gatherer = Gatherer { machine, numbers, groups, looks: vec![Look::default(); groups.all.len()] };
    gatherer.joints();
    gatherer.bodies();
    gatherer.connections();
    gatherer.elements();
    gatherer.points();
    for pin in pins {
        pin.groups.into_iter().for_each(|g| gatherer.looks[g].spot(pin.at, Spotted::Held(None)));
    }
    arms.iter().for_each(|arm| gatherer.arm(*arm));
    gatherer.looks
}

struct Gatherer<'a> {
    machine: &'a Machine,
    numbers: &'a Numbers,
    groups: &'a Groups,
    looks: Vec<Look>,
}

impl Gatherer<'_> {
    fn hold(&mut self, point: PointRef) {
        let model = &self.machine.model;
        let name = match point {
            PointRef::Point(p) => Some(model.points[p.index()].name.as_str()),
            _ => None,
        };
        let group = self.groups.of_point(model, point);
        let at = self.numbers.at(0, point);
        self.looks[group].spot(at, Spotted::Held(name));
    }

    fn pose(&self, frame: FrameId) -> Pose {
        self.numbers.frames[0][frame.index()]
    }

    fn joints(&mut self) {
        let groups = self.groups;
        for (i, group) in groups.all.iter().enumerate().skip(1) {
            let at = self.pose(group.root).origin;
            if group.joint == Joint::Turns {
                self.looks[i].spot(at, Spotted::Held(None));
                self.looks[group.carrier].spot(at, Spotted::Held(None));
            }
        }
    }

    fn bodies(&mut self) {
        let model = &self.machine.model;
        for (i, frame) in model.frames.iter().enumerate() {
            let Some(mass) = &frame.mass else { continue };
            let group = self.groups.of(FrameId(i));
            let center = self.numbers.at(0, PointRef::Center(FrameId(i)));
            let point = matches!(mass.inertia, Inertia::None);
            self.looks[group].centers.push((center, point));
            if let Some(solid) = &mass.shape {
                self.solid(group, FrameId(i), (solid, center));
            }
        }
    }

    fn solid(&mut self, group: usize, frame: FrameId, (solid, center): (&Solid, V3)) {
        let size = |k: usize| solid.lengths.get(k).map_or(0.0, |e| self.numbers.value(self.machine, *e));
        let (first, second) = (size(0), size(1));
        let wheel = |symbol| Wheel { symbol, center, radius: first, formula: solid.lengths[0], frame };
        match solid.name {
            "ring" => self.looks[group].wheel(wheel("ring")),
            "disc" | "sphere" | "cylinder" => self.looks[group].wheel(wheel("disc")),
            "box" => self.looks[group].boxes.push((center, [first / 2.0, second / 2.0], frame)),
            "rod" => {
                let mut along = [0.0; 3];
                along[solid.axis.index()] = first / 2.0;
                let half = self.pose(frame).shown(along);
                for sign in [1.0, -1.0] {
                    self.looks[group].spot(plus(center, sign, half), Spotted::Plain);
                }
            }
            _ => {}
        }
    }

    fn connections(&mut self) {
        let machine = self.machine;
        for connection in &machine.model.connections {
            let tie = connections::of(connection);
            for grip in tie.grips() {
                if let Place::Point(point) = grip.what {
                    self.hold(point);
                }
            }
            for rim in tie.rims(&Own::of(connection)) {
                self.wheel_of(rim.frame, rim.center, (rim.symbol, rim.radius));
            }
        }
    }

    fn wheel_of(&mut self, frame: FrameId, center: PointRef, (symbol, radius): (&'static str, Expr)) {
        let group = self.groups.of(frame);
        let value = self.numbers.value(self.machine, radius);
        let center = self.numbers.at(0, center);
        self.looks[group].wheel(Wheel { symbol, center, radius: value, formula: radius, frame });
    }

    fn elements(&mut self) {
        let machine = self.machine;
        for element in &machine.model.elements {
            match element.law.sketch().site {
                Site::On(mechanics::model::Pathway::Distance(a, b)) => [a, b].into_iter().for_each(|p| self.hold(p)),
                Site::At { at: at @ (PointRef::Point(_) | PointRef::Origin(_)), .. } => self.hold(at),
                _ => {}
            }
        }
    }

    /// The end of a lever on which something acts, where no rim is there.
    fn arm(&mut self, (group, at): (usize, V3)) {
        let look = &mut self.looks[group];
        let rim = |w: &Wheel| (norm(minus(at, w.center)) - w.radius).abs() < ALIKE * w.radius;
        if !look.wheels.iter().any(rim) {
            look.spot(at, Spotted::Held(None));
        }
    }

    /// Named points of moving bodies, and the lengths that they are given by.
    fn points(&mut self) {
        let machine = self.machine;
        for (i, point) in machine.model.points.iter().enumerate() {
            let reference = PointRef::Point(PointId(i));
            let group = self.groups.of(frame_of(&machine.model, reference));
            let at = self.numbers.at(0, reference);
            if group > 0 || self.looks[0].spots.iter().any(|s| norm(minus(s.at, at)) < STILL) {
                self.looks[group].spot(at, Spotted::Named(&point.name));
            }
            self.length(group, (point.on, at), point.at);
        }
        for (i, frame) in machine.model.frames.iter().enumerate().skip(1) {
            if let (Origin::Vector(origin), Joint::Turns, FrameId::GROUND) =
                (&frame.origin, self.groups.all[self.groups.of(FrameId(i))].joint, frame.on)
            {
                self.length(0, (FrameId::GROUND, self.pose(FrameId(i)).origin), *origin);
            }
            if let Some(mass) = &frame.mass {
                let group = self.groups.of(FrameId(i));
                self.length(group, (FrameId(i), self.numbers.at(0, PointRef::Center(FrameId(i)))), mass.center);
            }
        }
    }

    /// A place that lies on an axis of its frame: the formula of the other coordinate is the length.
    fn length(&mut self, group: usize, (frame, at): (FrameId, V3), formula: [Expr; 3]) {
        let graph = &self.machine.model.graph;
        let given: Vec<Expr> = formula.into_iter().filter(|e| !graph.is_zero(*e)).collect();
        let origin = self.pose(frame).origin;
        if let ([only], true) = (&given[..], dot(minus(at, origin), minus(at, origin)) > 0.0) {
            self.looks[group].lengths.push((origin, at, *only));
        }
    }
}
