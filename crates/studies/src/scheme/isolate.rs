//! A body alone: what holds it is cut, and the forces that act there instead stand at its places with the letters of the equations.
//!
//! A massless axle of which nothing is drawn is one body with the wheel on it: forces act on what is seen. Each force is drawn once.
//!
//! Arrows point in the positive direction of their letters: a reaction acts on the second of two partners as it is written, and opposite on the first; springs, rods
//! and ropes pull.

use super::ends::Ends;
use super::groups::Joint;
use super::laws::resists;
use super::numbers::{STILL, V3};
use super::sketch::{Act, Sketch};
use crate::connections::{self, Guide, Held, Knife, Own, Pair, Rolls, Rope, Support};
use crate::shown::{Role, role};
use mechanics::model::{FrameId, PointRef, Site, SupportDirection, Track, Wound};
use report::formula::{Form, Printer};
use report::scheme::{LabelText, P, Place, S, direction, distance, polar};
use std::f64::consts::{FRAC_PI_2, PI};

/// Length of an arrow.
const ARROW: f64 = 2.0 * S;

/// Leaves of a sketch with all bodies the one that the frame belongs to, and adds what acts on it.
pub(super) fn isolate(sketch: &mut Sketch, body: FrameId) {
    let own = sketch.groups.of(body);
    let (group, axle) = match (sketch.wheel_on(own), sketch.axle_of(own)) {
        (Some(wheel), _) => (wheel, Some(own)),
        (None, axle) => (own, axle),
    };
    let path = sketch.groups.all[group].path.clone();
    sketch.scheme.items.retain(|item| item.path == path);
    let mut cut = Cut { sketch, group, axle, taken: Vec::new() };
    // what is given comes first, then the weight; reactions that lie on their lines make room
    cut.loads();
    cut.weight();
    cut.connections();
    cut.joints();
    cut.acts();
    let (weights, others): (Vec<_>, Vec<_>) =
        std::mem::take(&mut cut.sketch.scheme.items).into_iter().partition(|item| item.path == "gravity");
    cut.sketch.scheme.items = [others, weights].concat();
    cut.axes();
}

struct Cut<'s, 'm> {
    sketch: &'s mut Sketch<'m>,
    group: usize,
    /// A massless axle that is one body with the group.
    axle: Option<usize>,
    /// Places whose reactions are drawn.
    taken: Vec<P>,
}

impl Cut<'_, '_> {
    fn is_mine(&self, point: PointRef) -> bool {
        self.has(self.sketch.group_of(point))
    }

    fn has(&self, group: usize) -> bool {
        group == self.group || self.axle == Some(group)
    }

    fn holds(&self, frame: FrameId) -> bool {
        self.has(self.sketch.groups.of(frame))
    }

    /// The letter of a component, as in the equations; another one where the equations do not need it.
    fn letter(&self, part: &str, name: &str, other: &str) -> LabelText {
        let equations = &self.sketch.machine.equations;
        let (bare, long) = (format!("{part}({name})"), format!(".{name})"));
        let is =
            |r: &&symbolic::connections::Reaction| r.name == bare || r.name.starts_with(&format!("{part}(")) && r.name.ends_with(&long);
        match equations.reactions.iter().find(is) {
            Some(reaction) => {
                let name = &equations.graph.symbol_info(reaction.symbol).name;
                let shown = equations.notation.iter().find(|(n, _)| n == name).map_or(name, |(_, shown)| shown);
                LabelText::Symbol(shown.clone())
            }
            None => LabelText::Symbol(format!("{other}_{name}")),
        }
    }

    fn arrow(&mut self, path: &str, (at, turn): (P, f64), letter: LabelText) {
        let at = self.beside((at, turn));
        let tip = polar(at, ARROW, turn);
        self.sketch.put("reaction", path, Place { at, to: tip, ..Place::default() });
        self.sketch.note(letter, tip, 5.0, Some(turn + 0.8));
    }

    /// A place for an arrow where no other one lies: arrows of one place stand beside one another; one that would lie on another of the same line
    /// ends where it acts instead of beginning there.
    fn beside(&self, (at, turn): (P, f64)) -> P {
        let drawn = |i: &&report::scheme::Item| matches!(i.symbol.name, "reaction" | "force");
        let alike = |i: &&report::scheme::Item| (direction(i.place.at, i.place.to) - turn).cos().abs() > 0.97;
        let others: Vec<[P; 2]> = self.sketch.scheme.items.iter().filter(drawn).filter(alike).map(|i| [i.place.at, i.place.to]).collect();
        let free = |p: &P| others.iter().all(|o| off(*p, turn, o[0]) > 0.5 * S || !overlap((*p, turn), *o));
        let side = |k: f64| polar(at, 0.75 * S * k, turn - FRAC_PI_2);
        let ways = [at, polar(at, -ARROW, turn)].into_iter().chain([1.0, -1.0, 2.0, -2.0, 3.0].map(side));
        ways.into_iter().find(free).unwrap_or(at)
    }

    fn bow(&mut self, path: &str, (at, sense): (P, f64), letter: LabelText) {
        let symbol = if sense < 0.0 { "moment_negative" } else { "moment" };
        self.sketch.put(symbol, path, Place { at, size: 1.2 * S, turn: 0.8, ..Place::default() });
        self.sketch.note(letter, polar(at, 1.2 * S, 0.8), 5.0, Some(0.8));
    }

    /// Components along the axes of a frame, with a sign.
    fn components(&mut self, (path, name): (&str, &str), at: P, (axes, sign): (FrameId, f64)) {
        let pose = self.sketch.numbers.frames[0][axes.index()];
        for (part, letter, v) in [("force_x", "X", [1.0, 0.0, 0.0]), ("force_y", "Y", [0.0, 1.0, 0.0])] {
            let Some(turn) = self.sketch.stage.turn(pose.shown(v).map(|c: f64| c * sign)) else { continue };
            let letter = self.letter(part, name, letter);
            self.arrow(path, (at, turn), letter);
        }
        self.taken.push(at);
    }

    fn connections(&mut self) {
        let machine = self.sketch.machine;
        for connection in &machine.model.connections {
            connections::of(connection).cut(&Own::of(connection), self);
        }
    }

    /// The place of the body's own one of two points, and the sign of the reaction there.
    fn end(&self, [a, b]: [PointRef; 2]) -> Option<(P, f64)> {
        match (self.is_mine(a), self.is_mine(b)) {
            (true, false) => Some((self.sketch.seen(a), -1.0)),
            (false, true) => Some((self.sketch.seen(b), 1.0)),
            _ => None,
        }
    }

    /// Hinges and guides that follow from the coordinates.
    fn joints(&mut self) {
        let own = self.sketch.groups.all[self.group].clone();
        for (i, group) in self.sketch.groups.all.clone().iter().enumerate().skip(1) {
            let sides = (self.has(i), self.has(group.carrier));
            if group.joint != Joint::Turns || sides.0 == sides.1 {
                continue;
            }
            let at = self.sketch.origin(group.root);
            if self.taken.iter().any(|p| distance(*p, at) < 4.0) {
                continue;
            }
            let name = self.name_at(at, i);
            self.components((&own.path, &name), at, (FrameId::GROUND, if sides.0 { 1.0 } else { -1.0 }));
        }
        self.pressed();
    }

    /// The reaction of what the coordinates hide: guides, a floor, an incline.
    fn pressed(&mut self) {
        let own = self.sketch.groups.all[self.group].clone();
        let Joint::Slides(way) = own.joint else { return };
        let Some(turn) = self.sketch.stage.turn(way).filter(|_| !self.is_carried_otherwise()) else { return };
        let letter = self.sketch.letters.free(&format!("N_{}", self.sketch.number_of(self.group)));
        let middle = self.sketch.middle(self.group);
        if self.is_led() {
            self.arrow(&own.path, (middle, turn + FRAC_PI_2), letter);
        } else if let Some(down) = self.weighs_across(turn) {
            let foot = self.sketch.blocks[self.group].map_or(0.0, |b| b.half[1]);
            self.arrow(&own.path, (polar(middle, foot, down), down + PI), letter);
        }
    }

    /// Whether something of the file holds a body across its way: itself, or wheels on it that roll.
    fn is_carried_otherwise(&self) -> bool {
        let sketch = &*self.sketch;
        let rolls = |g: usize| (1..sketch.groups.all.len()).any(|i| sketch.groups.all[i].carrier == g && sketch.rolls(i));
        sketch.is_gripped(self.group, &[Held::Supported, Held::Slides]) || rolls(self.group)
    }

    /// Whether guides lead it, or links that are hinged to it press it against its way.
    fn is_led(&self) -> bool {
        let sketch = &*self.sketch;
        sketch.is_guided(self.group) || sketch.groups.all.iter().any(|g| g.carrier == self.group && g.joint == Joint::Turns)
    }

    /// The direction across its way in which its weight presses a body; none where it has no weight there.
    fn weighs_across(&self, turn: f64) -> Option<f64> {
        let model = &self.sketch.machine.model;
        let heavy = |f: &FrameId| model.frames[f.index()].mass.as_ref().is_some_and(|m| m.gravity && !model.graph.is_zero(m.mass));
        self.sketch.groups.all[self.group].frames.iter().find(|f| heavy(f))?;
        let weight = self.sketch.stage.turn(model.gravity?.map(|e| self.sketch.numbers.value(self.sketch.machine, e)))?;
        let across = (weight - turn).sin();
        (across.abs() > STILL).then_some(turn + if across > 0.0 { FRAC_PI_2 } else { -FRAC_PI_2 })
    }

    /// The point of the file that is there; where several hinges have none, O with the number of the body that turns about it.
    fn name_at(&self, at: P, group: usize) -> String {
        let spots = self.sketch.looks.iter().enumerate().flat_map(|(i, look)| look.spots.iter().map(move |s| (i, s)));
        let mut here = spots.filter(|(i, s)| distance(self.sketch.stage.at(*i, s.at), at) < 4.0).filter_map(|(_, s)| s.name.clone());
        let bare = |i: &usize| {
            let g = &self.sketch.groups.all[*i];
            let at = self.sketch.numbers.frames[0][g.root.index()].origin;
            let named = |s: &super::looks::Spot| s.name.is_some() && super::numbers::norm(super::numbers::minus(s.at, at)) < STILL;
            g.joint == Joint::Turns && !self.sketch.looks.iter().flat_map(|l| &l.spots).any(named)
        };
        let alone = (1..self.sketch.groups.all.len()).filter(bare).count() < 2;
        here.next().unwrap_or_else(|| if alone { "O".to_owned() } else { format!("O{}", self.sketch.number_of(group)) })
    }

    /// Springs, dampers, stops, frictions, motors, forces on pathways.
    fn acts(&mut self) {
        for act in self.sketch.acts.clone() {
            match act.ends {
                Ends::Points(a, b) => {
                    let (own, other) = match (self.is_mine(a), self.is_mine(b)) {
                        (true, false) => (a, b),
                        (false, true) => (b, a),
                        _ => continue,
                    };
                    let (at, to) = (self.sketch.seen(own), self.sketch.seen(other));
                    let turn = direction(at, to) + if self.grows(&act) { PI } else { 0.0 };
                    let letter = self.force_of(&act);
                    self.arrow(&act.path, (at, turn), letter);
                }
                Ends::Along { on, from, direction: way, arm, .. } => {
                    let (point, sign) = match (self.is_mine(on), from.filter(|f| self.is_mine(*f))) {
                        (true, None) => (on, 1.0),
                        (false, Some(from)) => (from, -1.0),
                        _ => continue,
                    };
                    let Some(turn) = self.sketch.stage.turn(way.map(|c| c * sign * if self.grows(&act) { 1.0 } else { -1.0 })) else {
                        continue;
                    };
                    let at = match arm.filter(|_| sign > 0.0) {
                        Some(arm) => self.sketch.stage.at(self.group, arm),
                        None => self.sketch.grip(point, turn),
                    };
                    let letter = self.force_of(&act);
                    self.arrow(&act.path, (at, turn), letter);
                }
                Ends::Turn { on, from, sense } => {
                    let sign = match (self.holds(on), self.holds(from)) {
                        (true, false) => 1.0,
                        (false, true) => -1.0,
                        _ => continue,
                    };
                    let at = self.sketch.pivot(on, from);
                    let letter = self.force_of(&act);
                    self.bow(&act.path, (at, sign * sense * if self.grows(&act) { 1.0 } else { -1.0 }), letter);
                }
                Ends::Unknown => {}
            }
        }
    }

    /// Whether a positive force makes the pathway longer: loads and drives do, and a stop that holds it from below; springs, dampers and a stop that holds it from above
    /// make it shorter, frictions resist.
    fn grows(&self, act: &Act) -> bool {
        match role(act.table) {
            Role::Stop => self.sketch.connection(act).and_then(|tie| tie.limit()).is_some_and(|limit| limit.above),
            role => matches!(role, Role::Force | Role::Motor | Role::Motion),
        }
    }

    /// F with the letter of a stiffness or damping as its index; loads and drives have their own letter.
    fn force_of(&self, act: &Act) -> LabelText {
        let base = if matches!(act.ends, Ends::Turn { .. }) { "M" } else { "F" };
        match (role(act.table), self.sketch.letter(act)) {
            (role, LabelText::Symbol(letter)) if resists(role) => LabelText::Symbol(format!("{base}_{}", letter.replace('_', ""))),
            (role, _) if resists(role) => LabelText::Symbol(base.to_owned()),
            (Role::Stop | Role::Friction | Role::Motion, _) => {
                let name = act.path.rsplit('.').next().unwrap_or_default();
                self.letter("force", name, base)
            }
            (_, letter) => letter,
        }
    }

    fn loads(&mut self) {
        let machine = self.sketch.machine;
        for element in &machine.model.elements {
            match element.law.sketch().site {
                Site::At { at, value, axes } if self.is_mine(at) => self.sketch.force(&element.path, (at, axes), value),
                Site::Turns { on, value, .. } if self.holds(on) => self.sketch.moment(&element.path, on, value),
                Site::Turns { value, reaction: Some(on), .. } if self.holds(on) => {
                    let (sense, letter) = self.sketch.signed(value[2], &element.path);
                    let at = self.sketch.middle(self.group);
                    self.bow(&element.path, (at, -sense), letter);
                }
                Site::Dissipation => self.dragged(element),
                _ => {}
            }
        }
    }

    /// The resistance of a medium, where one acts on this body.
    fn dragged(&mut self, element: &mechanics::model::Element) {
        let sketch = &*self.sketch;
        // a damper is an act already
        if sketch.acts.iter().any(|act| act.path == element.path) {
            return;
        }
        let drag = super::laws::drag(sketch.machine, &sketch.groups, (element, sketch.at));
        if let Some(drag) = drag.filter(|drag| self.is_mine(drag.on)) {
            self.sketch.dragged(&element.path, drag);
        }
    }

    fn weight(&mut self) {
        let model = &self.sketch.machine.model;
        let Some(g) = model.gravity else { return };
        let printer = Printer::of(&self.sketch.machine.equations, self.sketch.language);
        let Some(turn) = self.sketch.stage.turn(g.map(|e| self.sketch.numbers.value(self.sketch.machine, e))) else { return };
        for frame in self.sketch.groups.all[self.group].frames.clone() {
            let Some(mass) = model.frames[frame.index()].mass.as_ref().filter(|m| m.gravity && !model.graph.is_zero(m.mass)) else {
                continue;
            };
            let text = printer.inline(&model.graph, mass.mass, Form::Text);
            let text = if text.contains([' ', '+']) { format!("({text}) g") } else { format!("{text} g") };
            let at = match self.sketch.blocks[self.group] {
                Some(block) => block.center,
                None => self.sketch.seen(PointRef::Center(frame)),
            };
            self.arrow("gravity", (at, turn), LabelText::Formula(text));
        }
    }

    /// The axes of the ground, at the lower left.
    fn axes(&mut self) {
        let places = self.sketch.scheme.items.iter().flat_map(|i| [i.place.at, i.place.to].into_iter().filter(|p| *p != [0.0; 2]));
        // round bodies reach beyond their centres
        let round = self
            .sketch
            .scheme
            .items
            .iter()
            .filter(|i| matches!(i.symbol.name, "disc" | "ring" | "rotor" | "drum" | "gear" | "pulley" | "ball"));
        let rims = round.map(|i| [i.place.at[0] - i.place.size, i.place.at[1] + i.place.size]);
        let (left, low) = places.chain(rims).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, b), p| (l.min(p[0]), b.max(p[1])));
        if !left.is_finite() {
            return;
        }
        let at = [left - 3.5 * S, low + 1.5 * S];
        let seen = |v: V3| self.sketch.stage.turn(v).map(|turn| polar(at, 1.7 * S, turn));
        let tips: Vec<(P, &str)> =
            [([1.0, 0.0, 0.0], "x"), ([0.0, 1.0, 0.0], "y")].into_iter().filter_map(|(v, name)| Some((seen(v)?, name))).collect();
        self.sketch.put("axes", "ground", Place { at, path: tips.iter().map(|t| t.0).collect(), ..Place::default() });
        for (tip, name) in tips {
            self.sketch.note(LabelText::Symbol(name.to_owned()), tip, 4.0, None);
        }
    }
}

impl Knife for Cut<'_, '_> {
    fn pin(&mut self, own: &Own, between: [PointRef; 2], axes: FrameId) {
        if let Some((at, sign)) = self.end(between) {
            self.components((&own.path, own.name), at, (axes, sign));
        }
    }

    fn weld(&mut self, own: &Own, between: [PointRef; 2], axes: FrameId) {
        self.pin(own, between, axes);
        if let Some((at, sign)) = self.end(between) {
            let letter = self.letter("moment", own.name, "M");
            self.bow(&own.path, (at, sign), letter);
        }
    }

    fn guide(&mut self, own: &Own, guide: &Guide) {
        let sign = match (self.is_mine(guide.point), self.holds(guide.on)) {
            (true, false) => 1.0,
            (false, true) => -1.0,
            _ => return,
        };
        let at = self.sketch.seen(guide.point);
        let angle = self.sketch.numbers.value(self.sketch.machine, guide.direction) + FRAC_PI_2;
        let normal = self.sketch.numbers.frames[0][guide.on.index()].shown([sign * angle.cos(), sign * angle.sin(), 0.0]);
        let Some(turn) = self.sketch.stage.turn(normal) else { return };
        let letter = self.letter("force", own.name, "N");
        self.arrow(&own.path, (at, turn), letter);
        if !guide.turns {
            let letter = self.letter("moment", own.name, "M");
            self.bow(&own.path, (at, sign), letter);
        }
    }

    /// A tie pulls its end towards the other one.
    fn pull(&mut self, own: &Own, [a, b]: [PointRef; 2]) {
        let (mine, other) = match (self.is_mine(a), self.is_mine(b)) {
            (true, false) => (a, b),
            (false, true) => (b, a),
            _ => return,
        };
        let (at, to) = (self.sketch.seen(mine), self.sketch.seen(other));
        let letter = self.letter("force", own.name, "S");
        self.arrow(&own.path, (at, direction(at, to)), letter);
    }

    /// A rope pulls at the rim of a drum, and at its points towards the next ones.
    fn rope(&mut self, own: &Own, rope: &Rope) {
        let drums: Vec<&Wound> = rope.wound.iter().filter(|d| self.holds(d.on)).collect();
        for drum in drums {
            let mut way: Vec<P> = rope.path.iter().map(|p| self.sketch.seen(*p)).collect();
            self.sketch.onto(&mut way, drum);
            let center = self.sketch.origin(drum.on);
            if way.first().zip(way.last()).is_some_and(|(a, b)| distance(*a, center) < distance(*b, center)) {
                way.reverse();
            }
            let [.., from, rim] = way[..] else { continue };
            let letter = self.letter("force", own.name, "S");
            self.arrow(&own.path, (rim, direction(rim, from)), letter);
        }
        // an end that winds onto a drum pulls at its rim, and not at what carries the drum besides
        let winds: Vec<PointRef> = rope.wound.iter().filter_map(|d| self.winding_end(rope, d)).collect();
        for pair in rope.path.windows(2) {
            if !pair.iter().any(|p| winds.contains(p) && self.is_mine(*p)) {
                self.pull(own, [pair[0], pair[1]]);
            }
        }
    }

    /// The tooth or belt force on a wheel: it turns the second one in the positive direction.
    /// The first one, too, where they turn opposite to one another (`sense` 1), else in the negative one (-1): r₁ φ₁ ± r₂ φ₂ = 0.
    fn pair(&mut self, own: &Own, pair: &Pair) {
        let radii = pair.radii.map(|r| self.sketch.numbers.value(self.sketch.machine, r));
        let sense = if pair.opposite { 1.0 } else { -1.0 };
        let mine = pair.between.map(|f| self.holds(f));
        let Some(k) = (0..2).find(|k| mine[*k] && !mine[1 - *k]) else { return };
        let [this, other] = [pair.between[k], pair.between[1 - k]].map(|f| self.sketch.origin(f));
        let r = self.sketch.long(radii[k]);
        let toward = direction(this, other);
        // the smaller wheel meshes with inner teeth on its far side
        let inside = role(own.table) == Role::Gear && sense < 0.0 && radii[k] < radii[1 - k];
        let side = if inside { toward + PI } else { toward };
        let contact = polar(this, r, side);
        let turn = side + FRAC_PI_2 * if k == 1 { 1.0 } else { sense };
        let letter = self.letter("force", own.name, "F");
        self.arrow(&own.path, (contact, turn), letter);
    }

    fn rolls(&mut self, own: &Own, rolls: &Rolls) {
        let Track::Line { direction: along, left, .. } = rolls.track else { return };
        let sign = match (self.holds(rolls.wheel), self.holds(rolls.on)) {
            (true, false) => 1.0,
            (false, true) => -1.0,
            _ => return,
        };
        let machine = self.sketch.machine;
        let (c, r) = (self.sketch.seen(rolls.center), self.sketch.long(self.sketch.numbers.value(machine, rolls.radius)));
        let angle = self.sketch.numbers.value(machine, along);
        let way: V3 = self.sketch.numbers.frames[0][rolls.on.index()].shown([angle.cos(), angle.sin(), 0.0]);
        let Some(turn) = self.sketch.stage.turn(way) else { return };
        let normal = turn + if left { FRAC_PI_2 } else { -FRAC_PI_2 };
        let contact = polar(c, -r, normal);
        let flip = if sign < 0.0 { PI } else { 0.0 };
        let part = if role(own.table) == Role::Rack { "force" } else { "tangential" };
        let letter = self.letter(part, own.name, "F");
        self.arrow(&own.path, (contact, turn + flip), letter);
        if role(own.table) == Role::Rolling {
            let letter = self.letter("normal", own.name, "N");
            self.arrow(&own.path, (contact, normal + flip), letter);
        }
    }

    fn support(&mut self, own: &Own, support: &Support) {
        if !self.is_mine(support.at) {
            return;
        }
        let place = self.sketch.seen(support.at);
        let pose = self.sketch.numbers.frames[0][support.axes.index()];
        self.taken.push(place);
        for d in support.directions {
            let (part, letter, v) = match d {
                SupportDirection::X => ("force_x", "X", [1.0, 0.0, 0.0]),
                SupportDirection::Y => ("force_y", "Y", [0.0, 1.0, 0.0]),
                SupportDirection::Z => ("force_z", "Z", [0.0, 0.0, 1.0]),
                _ => {
                    let letter = self.letter("moment", own.name, "M");
                    self.bow(&own.path, (place, 1.0), letter);
                    continue;
                }
            };
            let Some(turn) = self.sketch.stage.turn(pose.shown(v)) else { continue };
            let letter = self.letter(part, own.name, letter);
            self.arrow(&own.path, (place, turn), letter);
        }
    }
}

impl Cut<'_, '_> {
    /// The end of a rope that winds onto a drum, where what carries the drum bears it.
    fn winding_end(&self, rope: &Rope, drum: &Wound) -> Option<PointRef> {
        let (first, last) = (*rope.path.first()?, *rope.path.last()?);
        let center = self.sketch.origin(drum.on);
        let near = |p: PointRef| distance(self.sketch.seen(p), center);
        let end = if near(first) < near(last) { first } else { last };
        let wheel = self.sketch.groups.of(drum.on);
        let bearer = self.sketch.group_of(end);
        (bearer != 0 && (bearer == wheel || bearer == self.sketch.groups.all[wheel].carrier)).then_some(end)
    }
}

/// Whether an arrow from a place and one that lies on its line cover one another.
fn overlap((from, turn): (P, f64), [a, b]: [P; 2]) -> bool {
    let along = |p: P| (p[0] - from[0]) * turn.cos() - (p[1] - from[1]) * turn.sin();
    let (low, high) = (along(a).min(along(b)), along(a).max(along(b)));
    // arrows may begin at one point
    low.max(0.0) + 1.0 < high.min(ARROW)
}

/// Distance of a point from a line.
fn off(at: P, turn: f64, p: P) -> f64 {
    ((p[0] - at[0]) * turn.sin() + (p[1] - at[1]) * turn.cos()).abs()
}
