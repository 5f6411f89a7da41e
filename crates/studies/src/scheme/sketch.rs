//! A scheme in the making.

pub(super) use super::sketched::{Act, Block, Carrier, Sketch};

use super::ends::{Ends, ends};
use super::groups::{Groups, Joint};
use super::letters::Letters;
use super::looks::{Look, looks};
use super::numbers::{Instant, Numbers, Pose, STILL, V3, minus, norm, plus};
use super::stage::Stage;
use crate::connections::{self, Held, Layer, Own, grips};
use crate::machine::Machine;
use crate::shown::role;
use mechanics::model::{FrameId, Pathway, PointRef, Site};
use report::Scheme;
use report::scheme::{P, Place, Rides, S, direction};
use words::Language;

/// Draws a machine.
pub(super) fn draw(machine: &Machine, at: &Instant, language: Language) -> Scheme {
    let mut sketch = prepared(machine, (at, &[]), language);
    complete(&mut sketch);
    sketch.scheme
}

/// Draws a machine with room for all its places in the course of a motion.
pub(super) fn draw_moving<'a>(machine: &'a Machine, motion: (&'a Instant, &[Vec<Pose>]), language: Language) -> Sketch<'a> {
    let mut sketch = prepared(machine, motion, language);
    complete(&mut sketch);
    sketch
}

fn complete(sketch: &mut Sketch) {
    let line = super::shafts::is_line(sketch);
    if line {
        super::shafts::draw(sketch);
        sketch.summary();
    } else {
        parts(sketch);
    }
    if line || sketch.is_schematic() {
        sketch.scheme.title = sketch.language.pick("Scheme, not to scale", "Расчётная схема (без масштаба)").into();
    }
}

fn parts(sketch: &mut Sketch) {
    sketch.fit();
    sketch.blocks();
    sketch.spread();
    sketch.structure();
    sketch.bodies();
    sketch.tracks();
    sketch.layer(Layer::Ties);
    sketch.pulls();
    sketch.holds();
    sketch.loads();
    sketch.signs();
}

/// Draws a body alone.
pub(super) fn body(machine: &Machine, at: &Instant, (body, language): (FrameId, Language)) -> Scheme {
    let mut sketch = prepared(machine, (at, &[]), language);
    let group = sketch.groups.of(body);
    let name = &machine.model.frames[body.index()].name;
    sketch.scheme.name = format!("body-{name}");
    sketch.scheme.title = language.pick(format!("Free body: {name}"), format!("Освобождённое тело: {name}")).into();
    let only: Vec<Look> = sketch.looks.iter().enumerate().map(|(i, l)| if i == group { l.clone() } else { Look::default() }).collect();
    let mut points: Vec<V3> =
        extent(&only, (&sketch.groups, &sketch.numbers), &vec![[0.0; 3]; only.len()]).into_iter().map(|p| p.1).collect();
    points.retain(|p| p.iter().all(|c| c.is_finite()));
    // another body without places of its own has its origin there; it is not seen
    let own = sketch.numbers.frames[0][sketch.groups.all[group].root.index()].origin;
    if points.is_empty() {
        points.push(own);
    }
    sketch.stage = Stage::new(sketch.stage.axes, &points, vec![[0.0; 3]; only.len()]);
    sketch.stage.scale *= 0.7;
    sketch.fit();
    sketch.blocks();
    sketch.bodies();
    super::isolate::isolate(&mut sketch, body);
    sketch.letters_of_body(group);
    sketch.scheme
}

/// Whether a body is the massless axle of a wheel.
pub(super) fn is_axle(machine: &Machine, body: FrameId) -> bool {
    let at = Instant::start(machine);
    let mut sketch = prepared(machine, (&at, &[]), Language::En);
    sketch.fit();
    sketch.blocks();
    sketch.bodies();
    sketch.wheel_on(sketch.groups.of(body)).is_some()
}

/// Everything that is known before the first stroke.
fn prepared<'a>(machine: &'a Machine, (at, course): (&'a Instant, &[Vec<Pose>]), language: Language) -> Sketch<'a> {
    let pathways = pathways(machine);
    let asked: Vec<(String, Pathway)> = pathways.iter().map(|(act, pathway)| (act.path.clone(), *pathway)).collect();
    let numbers = Numbers::new(machine, at, &asked);
    let groups = Groups::new(&machine.model, &numbers);
    let mut acts: Vec<Act> =
        pathways.into_iter().map(|(act, pathway)| Act { ends: ends(machine, (&numbers, &groups), (&act.path, pathway)), ..act }).collect();
    acts.extend(by_formulas(machine, (&numbers, &groups), at));
    let pins = super::pinned::pins(&machine.model, &numbers, &groups);
    let arm = |act: &Act| match act.ends {
        Ends::Along { on, arm: Some(at), .. } => Some((groups.of_point(&machine.model, on), at)),
        _ => None,
    };
    let arms: Vec<(usize, V3)> = acts.iter().filter_map(arm).collect();
    let looks = looks(machine, (&numbers, &groups), (&pins, &arms));
    let mut nearer = nearer(machine, &looks, (&groups, &numbers));
    // a line of shafts is drawn from the side, one disc behind the other
    if !acts.iter().any(|a| matches!(a.ends, Ends::Turn { on, from, .. } if groups.of(on) > 0 && groups.of(from) > 0)) {
        super::apart::apart(machine, (&groups, &numbers), &mut nearer);
    }
    let places = extent(&looks, (&groups, &numbers), &nearer);
    let mut points: Vec<V3> = places.iter().map(|p| p.1).collect();
    points.extend(swept(&places, (&groups, &numbers), (course, &nearer)));
    if let Some(structure) = &machine.model.structure {
        points.extend(super::structure::nodes(structure, &|e| numbers.value(machine, e)));
    }
    let stage = Stage::new(axes(machine, &looks), &points, nearer);
    let n = groups.all.len();
    let title = language.pick("Scheme", "Расчётная схема");
    Sketch {
        machine,
        language,
        at,
        letters: Letters::new(machine, language),
        scheme: Scheme::new("scheme", title.into()),
        blocks: vec![None; n],
        hinges: Vec::new(),
        origins: Vec::new(),
        rides: Rides::default(),
        more: Vec::new(),
        signing: false,
        course: course.to_vec(),
        numbers,
        groups,
        looks,
        stage,
        acts,
        pins,
    }
}

/// Springs and dampers that are given by energies and dissipation functions.
fn by_formulas(machine: &Machine, parts: (&Numbers, &Groups), at: &Instant) -> Vec<Act> {
    let model = &machine.model;
    let elements = model.elements.iter().enumerate().filter(|_| model.structure.is_none());
    let found = elements.filter_map(|(index, element)| {
        let (ends, letter) = super::laws::ends(machine, parts, element, at)?;
        Some(Act { path: element.path.clone(), table: element.table, index, ends, letter })
    });
    found.collect()
}

/// All pathways of the file.
pub(super) fn pathways(machine: &Machine) -> Vec<(Act, Pathway)> {
    let act = |path: &str, table, index| Act { path: path.to_owned(), table, index, ends: Ends::Unknown, letter: None };
    let mut out = Vec::new();
    for (i, element) in machine.model.elements.iter().enumerate() {
        // a frame that is part of the machine is drawn by itself
        let of_frame = machine.model.structure.is_some() && element.span.is_empty();
        if let (Site::On(pathway), false) = (element.law.sketch().site, of_frame) {
            out.push((act(&element.path, element.table, i), pathway));
        }
    }
    for (i, connection) in machine.model.connections.iter().enumerate() {
        let Some(pathway) = connections::of(connection).pathway() else { continue };
        out.push((act(&format!("{}.{}", connection.table, connection.name), connection.table, i), pathway));
    }
    out
}

/// What is seen to the right and upwards: the plane x, y; in space from the side, the vertical upwards.
fn axes(machine: &Machine, looks: &[Look]) -> [V3; 2] {
    let spots = || looks.iter().flat_map(|l| l.spots.iter().map(|s| s.at).chain(l.centers.iter().map(|c| c.0)));
    let span = |k: usize| {
        let (low, high) = spots().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p[k]), h.max(p[k])));
        (high - low).max(0.0)
    };
    if !mechanics::is_spatial(&machine.model) {
        return [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    }
    let upright_z = machine.model.gravity.is_some_and(|g| !machine.model.graph.is_zero(g[2]));
    if upright_z {
        return [[-0.5, 0.87, 0.0], [-0.35, -0.2, 0.92]];
    }
    if span(2) > 3.0 * span(0).max(span(1)) {
        // a shaft along z lies across the picture
        return [[-0.3, 0.0, 1.0], [-0.2, 1.0, 0.0]];
    }
    [[0.94, 0.0, -0.34], [-0.12, 0.96, -0.3]]
}

/// Shifts of groups that only slide on ropes and tracks and stand far from all others, which would be too small: the picture shows them nearer, on their way.
fn nearer(machine: &Machine, looks: &[Look], (groups, numbers): (&Groups, &Numbers)) -> Vec<V3> {
    let n = groups.all.len();
    let mut out = vec![[0.0; 3]; n];
    let model = &machine.model;
    let gripped = |group: usize, how: &[Held]| grips(model).any(|g| how.contains(&g.held) && groups.of_grip(model, &g) == group);
    let jointed = |group: usize| gripped(group, &[Held::Hinged, Held::Fixed, Held::Linked, Held::Slides, Held::Guides]);
    let roped = |group: usize| gripped(group, &[Held::Roped]);
    let loose = |i: usize| matches!(groups.all[i].joint, Joint::Slides(_)) && groups.all[i].carrier == 0 && !jointed(i) && roped(i);
    let leader = |mut i: usize| {
        while i != 0 && !loose(i) {
            i = groups.all[i].carrier;
        }
        i
    };
    let core: Vec<V3> = (0..n)
        .filter(|i| leader(*i) == 0)
        .flat_map(|i| looks[i].spots.iter().map(|s| s.at).chain(looks[i].wheels.iter().map(|w| w.center)))
        .collect();
    let Some(first) = core.first().copied() else { return out };
    let (mut low, mut high) = (first, first);
    for p in &core {
        low = [0, 1, 2].map(|k| low[k].min(p[k]));
        high = [0, 1, 2].map(|k| high[k].max(p[k]));
    }
    let (size, middle) = (norm(minus(high, low)), [0, 1, 2].map(|k| (low[k] + high[k]) / 2.0));
    for i in (1..n).filter(|i| loose(*i)) {
        let Joint::Slides(way) = groups.all[i].joint else { continue };
        let away = super::numbers::dot(minus(numbers.frames[0][groups.all[i].root.index()].origin, middle), way);
        let wanted = 1.15 * size;
        if size > 0.0 && away.abs() > 1.3 * wanted {
            let by = way.map(|c| c * (wanted * away.signum() - away));
            for (k, shift) in out.iter_mut().enumerate().skip(1) {
                if leader(k) == i {
                    *shift = by;
                }
            }
        }
    }
    out
}

/// The same places in the course of a motion.
fn swept(places: &[(usize, V3)], (groups, numbers): (&Groups, &Numbers), (course, nearer): (&[Vec<Pose>], &[V3])) -> Vec<V3> {
    let moved = |frames: &Vec<Pose>, (group, p): (usize, V3)| {
        let root = groups.all[group].root.index();
        plus(frames[root].carried(&numbers.frames[0][root], minus(p, nearer[group])), 1.0, nearer[group])
    };
    course.iter().flat_map(|frames| places.iter().filter(|p| p.0 > 0).map(move |p| moved(frames, *p))).collect()
}

/// Places that must be in the picture, each with its group.
fn extent(looks: &[Look], (groups, numbers): (&Groups, &Numbers), nearer: &[V3]) -> Vec<(usize, V3)> {
    let mut out = Vec::new();
    for (i, (look, group)) in looks.iter().zip(&groups.all).enumerate() {
        let mut all: Vec<V3> = Vec::new();
        all.extend(look.spots.iter().map(|s| s.at));
        all.extend(look.centers.iter().map(|c| c.0));
        for wheel in &look.wheels {
            let pose = numbers.frames[0][wheel.frame.index()];
            for v in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] {
                all.extend([1.0, -1.0].map(|sign| plus(wheel.center, sign * wheel.radius, pose.shown(v))));
            }
        }
        for (center, half, _) in &look.boxes {
            all.extend([[half[0], half[1], 0.0], [-half[0], -half[1], 0.0]].map(|d| plus(*center, 1.0, d)));
        }
        if group.heavy && look.centers.is_empty() && !look.spots.is_empty() {
            all.push(numbers.frames[0][group.root.index()].origin);
        }
        out.extend(all.into_iter().map(|p| (i, plus(p, 1.0, nearer[i]))));
    }
    out
}

impl Sketch<'_> {
    /// Adds a symbol: parts of a body ride on it, those of the ground stand, others ride as was said last.
    pub fn put(&mut self, symbol: &str, path: &str, place: Place) {
        let own = self.groups.all.iter().skip(1).position(|g| g.path == path);
        let rides = match own {
            Some(i) => Rides::on(i + 1),
            None if path == "ground" => Rides::default(),
            None => self.rides.clone(),
        };
        self.scheme.carried(symbol, path, (place, rides));
    }

    /// One more carrier; its number.
    pub fn carrier(&mut self, carrier: Carrier) -> usize {
        self.more.push(carrier);
        self.groups.all.len() + self.more.len() - 1
    }

    /// Whether something has another place or size than it has: blocks of no given size, what was moved apart or nearer.
    fn is_schematic(&self) -> bool {
        let moved = self.stage.shift.iter().flatten().any(|c| *c != 0.0) || self.stage.nearer.iter().flatten().any(|c| *c != 0.0);
        let sized = |i: usize| !self.looks[i].boxes.is_empty();
        moved || self.blocks.iter().enumerate().any(|(i, block)| block.is_some() && !sized(i))
    }

    /// A point in the picture.
    pub fn seen(&self, point: PointRef) -> P {
        let group = self.groups.of_point(&self.machine.model, point);
        self.stage.at(group, self.numbers.at(0, point))
    }

    pub fn group_of(&self, point: PointRef) -> usize {
        self.groups.of_point(&self.machine.model, point)
    }

    pub fn origin(&self, frame: FrameId) -> P {
        self.seen(PointRef::Origin(frame))
    }

    /// Pixels of a length.
    pub fn long(&self, metres: f64) -> f64 {
        (metres * self.stage.scale).abs()
    }

    /// The middle of a group: its block, its wheels, its mass, its places.
    pub fn middle(&self, group: usize) -> P {
        if let Some((_, at)) = self.origins.iter().find(|o| o.0 == group) {
            return *at;
        }
        if let Some(block) = self.blocks[group] {
            return block.center;
        }
        let look = &self.looks[group];
        let points: Vec<V3> = match (&look.wheels[..], &look.spots[..]) {
            ([wheel, ..], _) => vec![wheel.center],
            (_, spots) if !spots.is_empty() => spots.iter().map(|s| s.at).collect(),
            _ => look.centers.iter().map(|c| c.0).collect(),
        };
        if points.is_empty() {
            return self.origin(self.groups.all[group].root);
        }
        let n = points.len() as f64;
        let sum = points.iter().fold([0.0; 3], |sum, p| plus(sum, 1.0, *p));
        self.stage.at(group, sum.map(|c| c / n))
    }

    /// How far a group goes along a direction in the course of the motion, back and forth, m.
    pub fn swept_along(&self, group: usize, way: V3) -> [f64; 2] {
        let root = self.groups.all[group].root.index();
        let first = self.numbers.frames[0][root].origin;
        let away = self.course.iter().map(|frames| super::numbers::dot(way, minus(frames[root].origin, first)));
        away.fold([0.0, 0.0], |[low, high], d| [low.min(d), high.max(d)])
    }

    /// The same in pixels along a direction of the picture.
    pub fn swept_at(&self, group: usize, turn: f64) -> [f64; 2] {
        let way = [0, 1, 2].map(|k| turn.cos() * self.stage.axes[0][k] + turn.sin() * self.stage.axes[1][k]);
        self.swept_along(group, way).map(|d| d * self.stage.scale)
    }

    /// Springs of blocks are as long as is drawn best: a motion is shown so large that it neither crushes them nor tears them.
    fn fit_motion(&mut self) {
        const CRUSHED: f64 = 1.9 * S;
        const TORN: f64 = 5.0 * S;
        let mut largest = f64::INFINITY;
        for act in self.acts.iter().filter(|a| self.is_body(a)) {
            let Ends::Along { on, from, direction, .. } = act.ends else { continue };
            let [near, far] = [self.group_of(on), from.map_or(0, |f| self.group_of(f))];
            let (a, b) = (self.groups.all[near].root.index(), self.groups.all[far].root.index());
            let long = |frames: &[Pose]| super::numbers::dot(direction, minus(frames[a].origin, frames[b].origin));
            let start = long(&self.numbers.frames[0]);
            let (low, high) = self.course.iter().map(|f| long(f) - start).fold((0.0_f64, 0.0_f64), |(l, h), d| (l.min(d), h.max(d)));
            largest = largest.min(CRUSHED / -low).min(TORN / high);
        }
        // links stay as long as is needed to see them
        const LEAST: f64 = 2.5 * S;
        let shortest = self.shortest();
        let least = if shortest.is_finite() { LEAST / shortest } else { 0.0 };
        if largest.is_finite() {
            self.stage.scale = self.stage.scale.min(largest.max(least));
        }
    }

    /// The shortest length of what turns, m.
    fn shortest(&self) -> f64 {
        let origin = |i: usize| self.numbers.frames[0][self.groups.all[i].root.index()].origin;
        let turning = (1..self.groups.all.len()).filter(|i| self.groups.all[*i].turns);
        let sizes = turning.flat_map(|i| {
            let look = &self.looks[i];
            let spots = look.spots.iter().map(|s| s.at).chain(look.centers.iter().map(|c| c.0));
            spots.map(move |p| norm(minus(p, origin(i)))).chain(look.wheels.iter().map(|w| w.radius))
        });
        sizes.filter(|r| *r > STILL).fold(f64::INFINITY, f64::min)
    }

    /// Beside blocks, which have no size of their own, the shortest link is not longer than a few modules.
    fn fit(&mut self) {
        self.fit_motion();
        const LONGEST: f64 = 4.5 * S;
        if !(1..self.groups.all.len()).any(|i| self.is_block(i) && !self.is_guided(i)) || self.machine.model.structure.is_some() {
            return;
        }
        let shortest = self.shortest();
        if shortest.is_finite() {
            self.stage.scale = self.stage.scale.min(LONGEST / shortest);
        }
    }

    /// Whether a rectangle stands for a group: it has mass and moves without turning; a lone particle is a ball.
    fn is_block(&self, group: usize) -> bool {
        let (g, look) = (&self.groups.all[group], &self.looks[group]);
        let particle =
            matches!(g.joint, Joint::Shifts | Joint::Free) && look.boxes.is_empty() && !self.acts.iter().any(|a| self.touches(a, group));
        let moves = matches!(g.joint, Joint::Slides(_) | Joint::Shifts | Joint::Free);
        !g.turns && look.wheels.is_empty() && g.heavy && moves && !particle && !self.is_bar(group)
    }

    /// Whether a group that does not turn is a link: formulas hinge it at more than one place.
    pub fn is_bar(&self, group: usize) -> bool {
        !self.groups.all[group].turns && self.pins.iter().filter(|p| p.groups.contains(&group)).count() > 1
    }

    /// Groups that move without turning and have mass become blocks.
    fn blocks(&mut self) {
        for i in 1..self.groups.all.len() {
            let group = &self.groups.all[i];
            let look = &self.looks[i];
            if !self.is_block(i) {
                continue;
            }
            let turn = match group.joint {
                Joint::Slides(way) if !self.hangs(i) => self.stage.turn(way).unwrap_or(0.0),
                _ => 0.0,
            };
            let turn = if turn.cos() < -STILL { turn + std::f64::consts::PI } else { turn };
            let center = look.centers.first().map_or(self.numbers.frames[0][group.root.index()].origin, |c| c.0);
            let slender = self.is_guided(i);
            let side_by_side = self.side_by_side(i);
            let least = if slender { [0.75 * S, 0.5 * S] } else { [1.15 * S, 0.8 * S] };
            let given = look.boxes.first().map_or(least, |b| b.1.map(|l| self.long(l)));
            let half = [given[0].clamp(least[0], 5.0 * S), given[1].clamp(least[1], 4.0 * S)];
            let room = if self.hangs_from(i) { 1.05 } else { 0.62 } * S * side_by_side as f64;
            let half =
                if (turn.sin().abs() > 0.7) != self.acts_upright(i) { [half[0].max(room), half[1]] } else { [half[0], half[1].max(room)] };
            self.blocks[i] = Some(Block { center: self.stage.at(i, center), half, turn });
        }
    }

    /// Whether what acts on a group acts up or down.
    fn acts_upright(&self, group: usize) -> bool {
        let upright = |d: V3| self.stage.turn(d).is_some_and(|t| t.sin().abs() > 0.7);
        self.acts.iter().any(|a| matches!(a.ends, Ends::Along { on, direction, .. } if self.group_of(on) == group && upright(direction)))
    }

    /// The largest number of elements on one side of a group.
    fn side_by_side(&self, group: usize) -> usize {
        let partner = |a: &Act| match a.ends {
            Ends::Along { on, from, .. } if self.is_body(a) => Some((self.group_of(on), from.map_or(0, |f| self.group_of(f)))),
            _ => None,
        };
        let pairs: Vec<(usize, usize)> = self.acts.iter().filter_map(partner).filter(|p| p.0 == group || p.1 == group).collect();
        pairs.iter().map(|p| pairs.iter().filter(|q| *q == p).count()).max().unwrap_or(1)
    }

    /// Whether it lies between two ends as springs do.
    pub fn is_body(&self, act: &Act) -> bool {
        super::laws::resists(role(act.table))
    }

    /// Whether something holds a group across its way.
    pub fn is_guided(&self, group: usize) -> bool {
        self.is_gripped(group, &[Held::Hinged, Held::Linked, Held::Slides, Held::Guides, Held::Rolled]) || self.leads_a_rod(group)
    }

    /// Whether a connection takes hold of a group in one of these ways.
    pub fn is_gripped(&self, group: usize, how: &[Held]) -> bool {
        let model = &self.machine.model;
        grips(model).any(|g| how.contains(&g.held) && self.groups.of_grip(model, &g) == group)
    }

    /// Whether something that turns is hinged to a group.
    pub fn hangs_from(&self, group: usize) -> bool {
        self.groups.all.iter().any(|g| g.carrier == group && g.joint == Joint::Turns && g.turns)
    }

    /// The hinge by formulas of two groups.
    pub fn pin_of(&self, groups: [usize; 2]) -> Option<P> {
        let pin = self.pins.iter().find(|p| p.groups.iter().all(|g| groups.contains(g)))?;
        Some(self.stage.at(pin.groups[1], pin.at))
    }

    /// Whether a wheel of a group rolls on something.
    pub fn rolls(&self, group: usize) -> bool {
        self.machine.model.connections.iter().any(|connection| {
            let tie = connections::of(connection);
            let on_track = tie.grips().iter().any(|g| g.held == Held::Rolled);
            on_track && tie.rims(&Own::of(connection)).iter().any(|rim| self.groups.of(rim.frame) == group)
        })
    }

    /// The wheel on a massless axle of which nothing is drawn: both are one body.
    pub fn wheel_on(&self, axle: usize) -> Option<usize> {
        let g = &self.groups.all[axle];
        let drawn = self.scheme.items.iter().any(|item| item.path == g.path);
        let carried: Vec<usize> = (1..self.groups.all.len()).filter(|i| self.groups.all[*i].carrier == axle).collect();
        let [wheel] = carried[..] else { return None };
        let turns = self.groups.all[wheel].joint == Joint::Turns && !self.looks[wheel].wheels.is_empty();
        (axle != 0 && !g.heavy && !drawn && turns).then_some(wheel)
    }

    /// The massless axle of a wheel of which nothing is drawn.
    pub fn axle_of(&self, wheel: usize) -> Option<usize> {
        let axle = self.groups.all[wheel].carrier;
        (self.wheel_on(axle) == Some(wheel)).then_some(axle)
    }

    /// The number of a group in the written calculation: the least of its bodies'.
    pub fn number_of(&self, group: usize) -> usize {
        let numbers = crate::numbering::numbers(&self.machine.model);
        self.groups.all[group].frames.iter().filter_map(|f| numbers[f.index()]).min().unwrap_or(0)
    }

    /// Whether a rod that is hinged to a group is held at its other end, too.
    fn leads_a_rod(&self, group: usize) -> bool {
        let mut rods =
            (1..self.groups.all.len()).filter(|i| self.groups.all[*i].carrier == group && self.groups.all[*i].joint == Joint::Turns);
        let pinned = |g: usize| self.pins.iter().filter(|p| p.groups.contains(&g)).count();
        let by_formulas = |p: &super::pinned::Pin| {
            let other = if p.groups[0] == group { p.groups[1] } else { p.groups[0] };
            p.groups.contains(&group) && self.groups.all[other].turns && pinned(other) > 1
        };
        rods.any(|i| self.is_pinned(i)) || self.pins.iter().any(by_formulas)
    }

    /// Whether a group goes up and down without guides.
    pub fn hangs(&self, group: usize) -> bool {
        let Joint::Slides(way) = self.groups.all[group].joint else { return false };
        self.stage.turn(way).is_some_and(|t| t.sin().abs() > 0.95) && !self.is_guided(group)
    }

    /// Blocks that springs join are moved apart along the spring where they would lie on each other.
    fn spread(&mut self) {
        const GAP: f64 = 3.2 * S;
        let pairs: Vec<(usize, usize, V3)> = self.acts.iter().filter_map(|a| self.pair(a)).collect();
        let mut done = vec![false; self.groups.all.len()];
        done[0] = true;
        for _ in 0..self.groups.all.len() {
            let Some((from, on, way)) = pairs.iter().find_map(|(a, b, way)| match (done[*a], done[*b]) {
                (true, false) => Some((*a, *b, *way)),
                (false, true) => Some((*b, *a, way.map(|c| -c))),
                _ => None,
            }) else {
                match (1..done.len()).find(|i| !done[*i] && pairs.iter().any(|p| p.0 == *i || p.1 == *i)) {
                    Some(next) => done[next] = true,
                    None => break,
                }
                continue;
            };
            done[on] = true;
            let (Some(a), Some(b), Some(turn)) = (self.blocks[from], self.blocks[on], self.stage.turn(way)) else { continue };
            let (dx, dy) = (turn.cos(), -turn.sin());
            let away = (b.center[0] - a.center[0]) * dx + (b.center[1] - a.center[1]) * dy;
            let wanted = a.reach(turn) + b.reach(turn) + GAP;
            if away.abs() < wanted - 0.5 * S && away > -0.5 * S {
                let by = wanted - away;
                self.shift(on, [by * dx, by * dy]);
            }
        }
    }

    fn pair(&self, act: &Act) -> Option<(usize, usize, V3)> {
        match act.ends {
            Ends::Along { on, from, direction, .. } if self.is_body(act) => {
                Some((from.map_or(0, |f| self.group_of(f)), self.group_of(on), direction))
            }
            _ => None,
        }
    }

    /// Moves a group with all that it carries.
    fn shift(&mut self, group: usize, by: P) {
        for i in 1..self.groups.all.len() {
            let mut carrier = i;
            while carrier != group && carrier != 0 {
                carrier = self.groups.all[carrier].carrier;
            }
            if carrier == group {
                self.stage.shift[i] = [self.stage.shift[i][0] + by[0], self.stage.shift[i][1] + by[1]];
                if let Some(block) = &mut self.blocks[i] {
                    block.center = [block.center[0] + by[0], block.center[1] + by[1]];
                }
            }
        }
    }
}

/// Whether links that are hinged to one another lie on one line, so that a mechanism looks like a bar.
pub(super) fn is_stretched(scheme: &Scheme) -> bool {
    let links: Vec<&Place> = scheme.items.iter().filter(|i| i.symbol.name == "link").map(|i| &i.place).collect();
    let Some(first) = links.first() else { return false };
    let turn = direction(first.at, first.to);
    let off = |p: P| ((p[0] - first.at[0]) * turn.sin() + (p[1] - first.at[1]) * turn.cos()).abs();
    links.len() > 1 && links.iter().all(|l| off(l.at) < 2.0 && off(l.to) < 2.0)
}
