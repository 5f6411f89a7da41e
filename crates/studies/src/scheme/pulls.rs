//! What acts along pathways: springs, dampers, stops, frictions, motors and given motions; then loads.

use super::ends::Ends;
use super::laws::{Drag, resists};
use super::numbers::{STILL, V3};
use super::sketch::{Act, Carrier, Sketch};
use super::ties::SMALL;
use crate::connections::{self, Held, Layer, Letter, Own, Tie};
use crate::shown::{Role, find, role};
use mechanics::model::{FrameId, PointRef, Site};
use report::scheme::{LabelText, P, Place, Rides, S, between, direction, distance, polar};
use std::f64::consts::{FRAC_PI_2, PI};
use symbolic::Expr;

/// Length of a spring to a wall.
const SPRING: f64 = 3.4 * S;

impl Sketch<'_> {
    /// Everything on pathways.
    pub(super) fn pulls(&mut self) {
        let acts = self.acts.clone();
        for (i, act) in acts.iter().enumerate() {
            match (&act.ends, role(act.table)) {
                (Ends::Points(a, b), _) => {
                    self.rides = Rides::between(self.group_of(*a), self.group_of(*b));
                    let (a, b) = (self.seen(*a), self.seen(*b));
                    let side = self.rank(&acts, i);
                    self.tie(act, offset((a, b), side));
                }
                (Ends::Along { .. }, role) if resists(role) => self.along((i, act), self.rank(&acts, i)),
                (Ends::Along { on, direction, driven, .. }, _) => self.push(act, (*on, *direction), *driven),
                (Ends::Turn { on, from, sense, .. }, _) => self.turn(act, (*on, *from, *sense), self.rank_of_turn(&acts, i)),
                (Ends::Unknown, _) => self.somewhere(act),
            }
        }
    }

    /// Place of an act among those between the same ends, about 0.
    fn rank(&self, acts: &[Act], i: usize) -> f64 {
        let key = |a: &Act| match a.ends {
            Ends::Points(a, b) => {
                let (a, b) = (self.seen(a), self.seen(b));
                let far = |p: P| [(p[0] * 2.0).round() as i64, (p[1] * 2.0).round() as i64];
                Some((far(a), far(b)))
            }
            Ends::Along { on, from, direction, .. } if self.is_body(a) => {
                let turn = self.stage.turn(direction).unwrap_or(0.0);
                Some(([self.group_of(on) as i64, (turn * 100.0).round() as i64], [from.map_or(0, |f| self.group_of(f)) as i64, -1]))
            }
            _ => None,
        };
        let Some(own) = key(&acts[i]) else { return 0.0 };
        let same: Vec<usize> = (0..acts.len()).filter(|k| key(&acts[*k]) == Some(own)).collect();
        let place = same.iter().position(|k| *k == i).unwrap_or(0);
        place as f64 - (same.len() - 1) as f64 / 2.0
    }

    fn rank_of_turn(&self, acts: &[Act], i: usize) -> usize {
        let at = |a: &Act| if let Ends::Turn { on, from, .. } = a.ends { Some(self.pivot(on, from)) } else { None };
        let own = at(&acts[i]);
        (0..i).filter(|k| at(&acts[*k]).zip(own).is_some_and(|(p, q)| distance(p, q) < 4.0)).count()
    }

    pub(super) fn letter(&self, act: &Act) -> LabelText {
        let model = &self.machine.model;
        if let Some(letter) = &act.letter {
            return letter.clone();
        }
        if let Some(element) = model.elements.get(act.index).filter(|e| e.path == act.path) {
            return self.letters.of(element.law.sketch().letter, &act.path);
        }
        match self.connection(act).map_or(Letter::Usual, |tie| tie.letter()) {
            Letter::Of(formula) => self.letters.of(formula, &act.path),
            Letter::Drive => {
                let name = act.path.rsplit('.').next().unwrap_or_default();
                let force = !matches!(act.ends, Ends::Turn { .. });
                LabelText::Symbol(format!("{}_{name}", if force { "F" } else { "M" }))
            }
            Letter::Usual => self.letters.load(&act.path),
        }
    }

    /// Whether an element has play.
    pub(super) fn has_play(&self, act: &Act) -> bool {
        self.machine.model.elements.get(act.index).is_some_and(|e| e.path == act.path && e.law.sketch().play.is_some())
    }

    /// The sign in front of a formula, and its letter without the sign.
    pub(super) fn signed(&self, e: Expr, path: &str) -> (f64, LabelText) {
        (self.sign(e), self.unsigned(e, path))
    }

    fn symbol_of(&self, act: &Act) -> &'static str {
        let own = find(act.table).map_or("", |row| row.along);
        match own {
            _ if self.has_play(act) => "backlash",
            "" if role(act.table) == Role::Energy => "spring",
            "" if role(act.table) == Role::Dissipation => "damper",
            "" => "friction",
            own => own,
        }
    }

    /// Something between two places.
    fn tie(&mut self, act: &Act, (a, b): (P, P)) {
        let symbol = self.symbol_of(act);
        match symbol {
            "stop" => self.put("stop", &act.path, Place { at: b, turn: direction(a, b), ..Place::default() }),
            "force" | "motion" => {
                let tip = polar(b, 2.0 * S, direction(a, b));
                self.put(symbol, &act.path, Place { at: b, to: tip, ..Place::default() });
            }
            _ => self.put(symbol, &act.path, Place { at: a, to: b, ..Place::default() }),
        }
        let letter = self.letter(act);
        self.note(letter, between(a, b, 0.5), 12.0, None);
    }

    /// Where a group is taken hold of from a direction.
    pub(super) fn grip(&self, point: PointRef, turn: f64) -> P {
        let group = self.group_of(point);
        match self.blocks[group] {
            Some(block) => polar(block.center, block.reach(turn), turn),
            None => self.seen(point),
        }
    }

    /// A spring or damper by a formula: from the place that moves to a wall behind it, or to the other place.
    fn along(&mut self, (index, act): (usize, &Act), side: f64) {
        let Ends::Along { on, from, direction: way, driven, arm } = act.ends else { return };
        let Some(turn) = self.stage.turn(way) else { return self.somewhere(act) };
        // what hangs from the middle of a block has room between its springs
        let apart = if self.hangs_from(self.group_of(on)) && turn.sin().abs() > 0.7 { 2.1 * S } else { 1.25 * S };
        let side = side * apart;
        let held = arm.map_or_else(|| self.grip(on, turn + PI), |at| self.stage.at(self.group_of(on), at));
        let near = polar(held, side, turn + FRAC_PI_2);
        let far = match from {
            Some(from) => {
                let end = polar(self.grip(from, turn), side, turn + FRAC_PI_2);
                let along = (near[0] - end[0]) * turn.cos() - (near[1] - end[1]) * turn.sin();
                // two places that are not in line are joined as they are
                if along < S { self.grip(from, turn) } else { polar(near, -along, turn) }
            }
            None => polar(near, -SPRING, turn),
        };
        let symbol = self.symbol_of(act);
        let base = from.map_or(0, |f| self.group_of(f));
        let base = if driven == 0.0 { base } else { self.carrier(Carrier::Driven { act: index, direction: way, of: base }) };
        self.rides = Rides::between(base, self.group_of(on));
        self.put(symbol, &act.path, Place { at: far, to: near, ..Place::default() });
        let own = std::mem::replace(&mut self.rides, Rides::along(base));
        if from.is_none() {
            let (a, b) = (polar(far, -0.75 * S, turn + FRAC_PI_2), polar(far, 0.75 * S, turn + FRAC_PI_2));
            // the wall is behind: to the right of its line
            let (end, part) = if driven == 0.0 { ("wall", "ground") } else { ("link", act.path.as_str()) };
            self.put(end, part, Place { at: b, to: a, ..Place::default() });
            if driven != 0.0 {
                // the pathway grows where its far end goes back
                let way = turn + if driven > 0.0 { PI } else { 0.0 };
                let tail = polar(far, 1.15 * S, turn + FRAC_PI_2);
                self.put("motion", &act.path, Place { at: tail, to: polar(tail, 1.9 * S, way), ..Place::default() });
            }
        }
        self.rides = own;
        let letter = self.letter(act);
        self.note(letter, between(far, near, 0.5), 0.55 * S, Some(turn + FRAC_PI_2 * if side < 0.0 { -1.0 } else { 1.0 }));
    }

    /// Forces, motors, given motions, stops, frictions along a direction.
    fn push(&mut self, act: &Act, (on, way): (PointRef, V3), driven: f64) {
        let Some(turn) = self.stage.turn(way) else { return self.somewhere(act) };
        let against = if let Ends::Along { from: Some(f), .. } = act.ends { self.group_of(f) } else { 0 };
        self.rides = Rides::along(if role(act.table) == Role::Stop { against } else { self.group_of(on) });
        match role(act.table) {
            Role::Stop => {
                let Some(limit) = self.connection(act).and_then(|tie| tie.limit()) else { return };
                let turn = if limit.above { turn + PI } else { turn };
                let edge = self.grip(on, turn);
                let value = self.numbers.pathway(&act.path).map_or(0.0, |v| v[0]);
                let gap = self.stage.scale * (value - self.numbers.value(self.machine, limit.clearance)).abs();
                // what moves meets its stop; a single place shows both near each other
                let gap = if self.course.is_empty() { gap.clamp(0.35 * S, 3.0 * S) } else { gap };
                let at = polar(edge, gap, turn);
                if turn.sin() < -0.9 {
                    self.put("wall", &act.path, Place { at: polar(at, -1.9 * S, 0.0), to: polar(at, 1.9 * S, 0.0), ..Place::default() });
                } else {
                    self.put("stop", &act.path, Place { at, turn, ..Place::default() });
                }
            }
            Role::Friction => {
                let group = self.group_of(on);
                if let Some(block) = self.blocks[group] {
                    let low = polar(block.center, -block.half[1], block.turn + FRAC_PI_2);
                    let letter = self.letter(act);
                    self.note(letter, polar(low, block.half[0], block.turn), 0.5 * S, Some(0.6));
                    if let Some(kinetic) = self.connection(act).and_then(|tie| tie.second_letter()) {
                        let kinetic = self.letters.of(kinetic, &act.path);
                        self.note(kinetic, polar(low, -block.half[0], block.turn), 0.5 * S, Some(PI - 0.6));
                    }
                    if driven != 0.0 {
                        let way = turn + if driven > 0.0 { PI } else { 0.0 };
                        let from = polar(polar(low, -S, block.turn + FRAC_PI_2), -1.1 * S, way);
                        self.put("motion", &act.path, Place { at: from, to: polar(from, 2.2 * S, way), ..Place::default() });
                    }
                } else {
                    let at = self.seen(on);
                    self.put("slip_mark", &act.path, Place { at, size: 0.55 * S, ..Place::default() });
                }
            }
            _ => {
                let from = self.grip(on, turn);
                let tip = polar(from, 2.1 * S, turn);
                let symbol = self.symbol_of(act);
                self.put(symbol, &act.path, Place { at: from, to: tip, ..Place::default() });
                let still = self.connection(act).is_some_and(|tie| tie.is_still(&self.machine.model.graph));
                if !still {
                    let letter = self.letter(act);
                    self.note(letter, tip, 6.0, Some(turn + 0.9));
                }
            }
        }
    }

    pub(super) fn connection(&self, act: &Act) -> Option<Box<dyn Tie + '_>> {
        let model = &self.machine.model;
        let connection = model.connections.get(act.index).filter(|_| model.elements.get(act.index).is_none_or(|e| e.path != act.path));
        connection.map(connections::of)
    }

    /// The axis about which one body turns against another.
    pub(super) fn pivot(&self, on: FrameId, from: FrameId) -> P {
        let (a, b) = (self.groups.of(on), self.groups.of(from));
        let root = |g: usize| self.origin(self.groups.all[g].root);
        if let Some(pin) = self.pin_of([a, b]) {
            return pin;
        }
        match () {
            () if self.groups.all[b].carrier == a && b != 0 => root(b),
            () if self.groups.all[a].carrier == b => root(a),
            () => self.hinge_of(a, b).unwrap_or_else(|| root(a)),
        }
    }

    /// The hinge of the file that joins two groups, neither of which carries the other.
    fn hinge_of(&self, a: usize, b: usize) -> Option<P> {
        let model = &self.machine.model;
        model.connections.iter().find_map(|connection| {
            let grips = connections::of(connection).grips();
            let on = |group: usize| grips.iter().find(|g| g.held == Held::Hinged && self.groups.of_grip(model, g) == group);
            match on(a).and(on(b))?.what {
                connections::Place::Point(point) => Some(self.seen(point)),
                connections::Place::Frame(_) => None,
            }
        })
    }

    /// What acts on an angle.
    fn turn(&mut self, act: &Act, (on, from, sense): (FrameId, FrameId, f64), rank: usize) {
        let at = self.pivot(on, from);
        let group = self.groups.of(on);
        self.rides = Rides::along(group);
        let wheel = self.looks[group].wheels.iter().map(|w| self.long(w.radius)).fold(0.0, f64::max);
        let clear = wheel.max(0.75 * S);
        let symbol = match find(act.table).map_or("", |row| row.turning) {
            own if !own.is_empty() => own,
            _ if role(act.table) == Role::Energy => "torsion_spring",
            _ if role(act.table) == Role::Dissipation => "torsion_damper",
            _ if sense < 0.0 => "moment_negative",
            _ => "moment",
        };
        let outside = matches!(symbol, "moment" | "moment_negative" | "motion_turn");
        let size = if outside { clear.min(4.0 * S) + 0.6 * S + 0.5 * S * rank as f64 } else { S * (0.95 + 0.45 * rank as f64) };
        let turn = if symbol == "stop" { 0.0 } else { FRAC_PI_2 + 0.8 * rank as f64 };
        let at = if symbol == "stop" { polar(at, clear, 0.0) } else { at };
        self.put(symbol, &act.path, Place { at, size, turn, ..Place::default() });
        let letter = self.letter(act);
        self.note(letter, polar(at, size, turn), 6.0, Some(turn));
    }

    /// What cannot be placed: beside the body that it moves most, with its letter.
    fn somewhere(&mut self, act: &Act) {
        let letter = self.letter(act);
        let at = self.moved_by(act);
        self.rides = Rides::default();
        self.put("field", &act.path, Place { at, ..Place::default() });
        self.note(letter, at, S, None);
    }

    fn moved_by(&self, act: &Act) -> P {
        let Some(values) = self.numbers.pathway(&act.path) else { return self.middle(self.groups.all.len().saturating_sub(1)) };
        let n = self.machine.model.coordinates.len();
        let change = |j: &usize| (values[self.numbers.moved(*j)] - values[0]).abs();
        let most = (0..n).max_by(|a, b| change(a).total_cmp(&change(b)));
        let group = most.and_then(|j| self.moved_with(j)).unwrap_or(self.groups.all.len() - 1);
        self.middle(group)
    }

    /// The first group that a coordinate moves.
    pub(super) fn moved_with(&self, coordinate: usize) -> Option<usize> {
        let state = self.numbers.moved(coordinate);
        (1..self.groups.all.len()).find(|i| {
            let root = self.groups.all[*i].root.index();
            let (a, b) = (self.numbers.frames[0][root], self.numbers.frames[state][root]);
            let far = super::numbers::norm(super::numbers::minus(a.origin, b.origin));
            let turned = a.rotation.iter().zip(&b.rotation).any(|(x, y)| super::numbers::norm(super::numbers::minus(*x, *y)) > STILL);
            far > STILL || turned
        })
    }

    /// Forces and moments of the file, potentials and resistances by formulas, frictions in joints, conditions.
    pub(super) fn loads(&mut self) {
        let machine = self.machine;
        for element in &machine.model.elements {
            let sketch = element.law.sketch();
            if machine.model.structure.is_some() && element.span.is_empty() {
                continue;
            }
            match sketch.site {
                Site::On(_) => {}
                Site::At { at, value, axes } => self.force(&element.path, (at, axes), value),
                Site::Turns { on, value, .. } => self.moment(&element.path, on, value),
                Site::Energy | Site::Dissipation => self.of_formula(element),
            }
        }
        self.layer(Layer::Loads);
    }

    /// What an energy or a dissipation function stands for: a spring or damper is drawn already; the resistance of a medium is a force.
    fn of_formula(&mut self, element: &mechanics::model::Element) {
        if self.acts.iter().any(|act| act.path == element.path) {
            return;
        }
        match super::laws::drag(self.machine, &self.groups, (element, self.at)) {
            Some(drag) => self.dragged(&element.path, drag),
            None => self.by_formula(&element.path, element.law.sketch().letter),
        }
    }

    /// The resistance of a medium: against the motion of its place.
    pub(super) fn dragged(&mut self, path: &str, drag: Drag) {
        let Some(turn) = self.stage.turn(drag.against) else { return };
        self.rides = Rides::along(self.group_of(drag.on));
        let from = self.grip(drag.on, turn);
        let tip = polar(from, 2.1 * S, turn);
        self.put("force", path, Place { at: from, to: tip, ..Place::default() });
        let LabelText::Symbol(letter) = drag.letter else { return };
        self.note(LabelText::Formula(format!("{} v", report::symbol::plain(&letter, self.language))), tip, 6.0, Some(turn + 0.9));
    }

    pub(super) fn force(&mut self, path: &str, (at, axes): (PointRef, FrameId), value: [Expr; 3]) {
        let graph = &self.machine.model.graph;
        let given: Vec<usize> = (0..3).filter(|k| !graph.is_zero(value[*k])).collect();
        let (vector, letter) = match given[..] {
            [] => return,
            [k] => {
                let mut v = [0.0; 3];
                v[k] = self.sign(value[k]);
                (v, self.unsigned(value[k], path))
            }
            _ => (value.map(|e| self.numbers.value(self.machine, e)), self.letters.load(path)),
        };
        let seen = self.numbers.frames[0][axes.index()].shown(vector);
        let Some(turn) = self.stage.turn(seen) else { return };
        self.rides = Rides::turning(self.group_of(at), self.groups.of(axes));
        let from = self.grip(at, turn);
        let tip = polar(from, 2.1 * S, turn);
        self.put("force", path, Place { at: from, to: tip, ..Place::default() });
        self.note(letter, tip, 6.0, Some(turn + 0.9));
    }

    /// The sign in front of a formula; of a sum or switch that of its value, where it has one.
    fn sign(&self, e: Expr) -> f64 {
        let graph = &self.machine.model.graph;
        if let symbolic::Node::Switch { then, otherwise, .. } = graph.node(e) {
            return self.sign(if graph.is_zero(*then) { *otherwise } else { *then });
        }
        if graph.is_negative(e) { -1.0 } else { 1.0 }
    }

    /// The letter without the sign that the arrow shows.
    fn unsigned(&self, e: Expr, path: &str) -> LabelText {
        if !self.machine.model.graph.is_negative(e) {
            return self.letters.of(e, path);
        }
        let mut graph = self.machine.model.graph.clone();
        let positive = graph.neg(e);
        match graph.as_symbol(positive) {
            Some(symbol) => self.letters.named(&graph.symbol_info(symbol).name),
            None => match self.letters.of(e, path) {
                LabelText::Formula(text) => LabelText::Formula(text.trim_start_matches('−').trim().to_owned()),
                other => other,
            },
        }
    }

    pub(super) fn moment(&mut self, path: &str, on: FrameId, value: [Expr; 3]) {
        let graph = &self.machine.model.graph;
        let Some(k) = (0..3).rev().find(|k| !graph.is_zero(value[*k])) else { return };
        let (sense, letter) = self.signed(value[k], path);
        let group = self.groups.of(on);
        self.rides = Rides::along(group);
        let look = &self.looks[group];
        let wheel = look.wheels.iter().max_by(|a, b| a.radius.total_cmp(&b.radius)).copied();
        let at = wheel.map_or_else(|| self.origin(self.groups.all[group].root), |w| self.stage.at(group, w.center));
        if wheel.is_some_and(|w| !self.facing(&w)) {
            return self.moment_of_shaft(path, group, (sense, letter));
        }
        let bare = if look.spots.len() < 2 { 1.4 * S } else { 0.6 * S };
        let size = wheel.map_or(bare, |w| self.long(w.radius)) + 0.6 * S;
        let taken = self.scheme.items.iter().filter(|i| i.symbol.name.starts_with("moment") && distance(i.place.at, at) < 4.0).count();
        let turn = [FRAC_PI_2 + 0.5, -0.4, PI + 0.6, -FRAC_PI_2][taken % 4];
        let symbol = if sense < 0.0 { "moment_negative" } else { "moment" };
        self.put(symbol, path, Place { at, size, turn, ..Place::default() });
        self.note(letter, polar(at, size, turn), 7.0, Some(turn));
    }

    /// About a shaft that is seen from the side: at its ends.
    fn moment_of_shaft(&mut self, path: &str, group: usize, (sense, letter): (f64, LabelText)) {
        let link =
            self.scheme.items.iter().find(|i| i.path == self.groups.all[group].path && i.symbol.name == "link").map(|i| i.place.clone());
        let Some(link) = link else { return };
        let taken = self.scheme.items.iter().filter(|i| i.symbol.name.starts_with("moment")).count();
        let (end, other) = if taken.is_multiple_of(2) { (link.at, link.to) } else { (link.to, link.at) };
        let at = polar(end, (0.9 + 1.2 * (taken / 2) as f64) * S, direction(other, end));
        self.put("link", "ground", Place { at: end, to: at, ..Place::default() });
        let symbol = if sense < 0.0 { "moment_negative" } else { "moment" };
        self.put(symbol, path, Place { at, size: 0.8 * S, turn: direction(other, end), ..Place::default() });
        self.note(letter, polar(at, 0.8 * S, FRAC_PI_2), 6.0, None);
    }

    /// A potential or dissipation: beside the body that its formula names most.
    fn by_formula(&mut self, path: &str, formula: Expr) {
        let group = self.named_in(formula).first().copied().unwrap_or(self.groups.all.len() - 1);
        self.rides = Rides::along(group);
        let at = self.middle(group);
        let at = [at[0] + 1.6 * S, at[1] - 1.2 * S];
        self.put("field", path, Place { at, ..Place::default() });
        let letter = self.letters.load(path);
        self.note(letter, at, 1.1 * S, None);
    }

    /// Groups that the coordinates of a formula move.
    fn named_in(&self, formula: Expr) -> Vec<usize> {
        let model = &self.machine.model;
        let symbols = model.graph.symbols_in(&[formula]);
        let has = |s: &symbolic::SymbolId| symbols.binary_search(s).is_ok();
        let mut groups: Vec<usize> = Vec::new();
        for (j, c) in model.coordinates.iter().enumerate() {
            if c.symbols[..2].iter().any(has) {
                groups.extend(self.moved_with(j));
            }
        }
        for request in model.requests.iter().filter(|r| has(&r.symbol)) {
            use mechanics::model::RequestKind as K;
            match request.kind {
                K::Position(p, _) | K::Velocity(p, _) | K::Speed(p) => groups.push(self.group_of(p)),
                K::Angle(f) | K::AngularVelocity(f) => groups.push(self.groups.of(f)),
                _ => {}
            }
        }
        groups.dedup();
        groups
    }

    pub(super) fn demanded(&mut self, path: &str, zero: Expr) {
        let groups = self.named_in(zero);
        let at = groups.first().map_or([0.0; 2], |g| self.middle(*g));
        let to = groups.get(1).map_or([at[0] + 2.4 * S, at[1] - 1.6 * S], |g| self.middle(*g));
        self.rides = Rides::between(groups.first().copied().unwrap_or(0), groups.get(1).copied().unwrap_or(0));
        self.put("condition", path, Place { at, to, ..Place::default() });
        let letter = self.letters.load(path);
        self.note(letter, between(at, to, 0.5), 0.6 * S, None);
    }

    /// Friction in a joint, of a rope on a drum, of a wheel on its track.
    pub(super) fn rubbing(&mut self, path: &str, of: usize) {
        let Some(at) = self.place_of(of) else { return };
        let carried = self.scheme.items.iter().find(|i| distance(i.place.at, at) < 1.0 && i.rides.path.is_empty());
        self.rides = carried.map_or_else(Rides::default, |i| Rides::along(i.rides.at));
        self.put("slip_mark", path, Place { at, size: 0.55 * S, ..Place::default() });
        let letter = self.letters.load(path);
        self.note(letter, at, 0.6 * S, None);
    }

    /// Where a connection is.
    fn place_of(&self, connection: usize) -> Option<P> {
        let c = self.machine.model.connections.get(connection)?;
        if let Some((point, below)) = connections::of(c).place() {
            let at = self.seen(point);
            return Some([at[0], at[1] + below.map_or(0.0, |e| self.long(self.numbers.value(self.machine, e)))]);
        }
        let path = Own::of(c).path;
        self.scheme.items.iter().find(|i| i.path == path).map(|i| i.place.at)
    }
}

/// The same line to the side.
fn offset((a, b): (P, P), side: f64) -> (P, P) {
    let turn = direction(a, b) + FRAC_PI_2;
    let far = side * 1.1 * S;
    if far == 0.0 || distance(a, b) < SMALL { (a, b) } else { (polar(a, far, turn), polar(b, far, turn)) }
}
