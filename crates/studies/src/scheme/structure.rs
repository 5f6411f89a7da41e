//! Frames and trusses: rods, hinges, supports, masses, loads, named displacements.

use super::sketch::Sketch;
use mechanics::structure::{Action, Direction, Site, Structure};
use report::scheme::{LabelText, P, Place, S, between, direction, polar};
use std::f64::consts::{FRAC_PI_2, PI};
use symbolic::Expr;

/// Structures with more rods have each letter of a length once.
const FEW: usize = 8;
/// Structures with more rods have no names of nodes.
const MANY: usize = 60;

/// Nodes of a structure, m.
pub(super) fn nodes(structure: &Structure, value: &dyn Fn(Expr) -> f64) -> Vec<[f64; 3]> {
    structure.nodes.iter().map(|n| [value(n.at[0]), value(n.at[1]), 0.0]).collect()
}

impl Sketch<'_> {
    fn value(&self, e: Expr) -> f64 {
        self.numbers.value(self.machine, e)
    }

    fn node(&self, i: usize) -> P {
        let machine = self.machine;
        let Some(structure) = &machine.model.structure else { return [0.0; 2] };
        let at = structure.nodes[i].at.map(|e| self.value(e));
        self.stage.at(0, [at[0], at[1], 0.0])
    }

    /// All of it.
    pub(super) fn structure(&mut self) {
        let machine = self.machine;
        let Some(structure) = &machine.model.structure else { return };
        for rod in &structure.rods {
            let [a, b] = rod.ends.map(|i| self.node(i));
            let symbol = if rod.rigid { "rigid" } else { "link" };
            self.put(symbol, &format!("rods.{}", rod.name), Place { at: a, to: b, ..Place::default() });
        }
        self.structure_supports(structure);
        self.structure_hinges(structure);
        for (i, node) in structure.nodes.iter().enumerate() {
            self.node_loads(i, &format!("nodes.{}", node.name), node);
        }
        for load in &structure.loads {
            if !matches!(load.path.split('.').next(), Some("nodes" | "rods")) {
                self.structure_load(structure, &load.path, load.action.clone());
            }
        }
        if structure.nodes.len() <= MANY {
            for (i, node) in structure.nodes.iter().enumerate() {
                let text = self.letters.named(&node.name);
                let at = self.node(i);
                self.note(text, at, 7.0, None);
            }
        }
        for named in &structure.displacements {
            self.displacement(structure, named);
        }
        self.rod_lengths(structure);
    }

    /// Hinges where rods are released: at the node where all are, else a little way along the rod.
    fn structure_hinges(&mut self, structure: &Structure) {
        for i in 0..structure.nodes.len() {
            let at = self.node(i);
            let meeting = structure.rods.iter().flat_map(|r| [0, 1].map(|k| (r, k))).filter(|(r, k)| r.ends[*k] == i);
            let meeting: Vec<_> = meeting.collect();
            let all = meeting.iter().all(|(r, k)| r.hinged[*k]);
            if all && meeting.len() > 1 {
                let supported = structure.supports.iter().any(|s| s.node == i && !s.holds[2]);
                if !supported {
                    self.put("pin", &format!("nodes.{}", structure.nodes[i].name), Place { at, ..Place::default() });
                }
                continue;
            }
            for (rod, k) in meeting.into_iter().filter(|(r, k)| r.hinged[*k]) {
                let other = self.node(rod.ends[1 - k]);
                let near = polar(at, 0.4 * S, direction(at, other));
                self.put("pin", &format!("rods.{}", rod.name), Place { at: near, ..Place::default() });
            }
        }
    }

    fn structure_supports(&mut self, structure: &Structure) {
        for support in &structure.supports {
            let at = self.node(support.node);
            let axis = self.value(support.angle);
            let away = self.free_side(at);
            let rods = structure.rods.iter().filter(|r| r.ends.contains(&support.node));
            let leaving: Vec<f64> =
                rods.map(|r| direction(at, self.node(if r.ends[0] == support.node { r.ends[1] } else { r.ends[0] }))).collect();
            let back = leaving.first().map_or(away, |t| t + PI);
            // a support stands on the side from which it is seen to hold
            let side = |turn: f64| if leaving.iter().any(|l| (l - turn).cos() > 0.5) { turn + PI } else { turn };
            let (symbol, turn) = match support.holds {
                [true, true, true] => ("clamp", back),
                [true, true, false] => ("pin_fixed", away),
                [true, false, false] => ("support_roller", side(axis + PI)),
                [false, true, false] => ("support_roller", side(axis - FRAC_PI_2)),
                [true, false, true] => ("clamp_guided", side(axis + PI)),
                _ => ("clamp_guided", side(axis - FRAC_PI_2)),
            };
            self.put(symbol, &format!("supports.{}", support.name), Place { at, turn, ..Place::default() });
        }
    }

    fn node_loads(&mut self, i: usize, path: &str, node: &mechanics::structure::Node) {
        let at = self.node(i);
        if self.value(node.mass) > 0.0 || self.value(node.inertia) > 0.0 {
            self.put("ball", path, Place { at, ..Place::default() });
            if let Some(text) = self.letters.symbol(node.mass) {
                self.note(text, at, 10.0, Some(0.7));
            }
        }
        for (k, stiffness) in node.springs.into_iter().enumerate() {
            if self.value(stiffness) == 0.0 {
                continue;
            }
            let letter = self.letters.of(stiffness, "c");
            if k == 2 {
                self.put("torsion_spring", path, Place { at, size: S, turn: FRAC_PI_2, ..Place::default() });
                self.note(letter, at, 1.2 * S, None);
                continue;
            }
            let turn = if k == 0 { PI } else { -FRAC_PI_2 };
            let foot = polar(at, 3.2 * S, turn);
            self.put("spring", path, Place { at: foot, to: at, ..Place::default() });
            let (a, b) = (polar(foot, 0.7 * S, turn - FRAC_PI_2), polar(foot, 0.7 * S, turn + FRAC_PI_2));
            self.put("wall", "ground", Place { at: a, to: b, ..Place::default() });
            self.note(letter, between(foot, at, 0.5), 0.55 * S, Some(turn + FRAC_PI_2));
        }
    }

    fn site(&self, structure: &Structure, site: Site) -> P {
        match site {
            Site::Node(i) => self.node(i),
            Site::Rod(i, far) => {
                let rod = &structure.rods[i];
                let [a, b] = rod.ends.map(|i| self.node(i));
                between(a, b, (self.value(far) / self.value(rod.length)).clamp(0.0, 1.0))
            }
        }
    }

    fn structure_load(&mut self, structure: &Structure, path: &str, action: Action) {
        let name = path.rsplit('.').next().unwrap_or_default().to_owned();
        match action {
            Action::Point { site, value } => {
                let at = self.site(structure, site);
                self.point_load(path, at, value);
            }
            Action::Distributed { rod, value } => {
                let [a, b] = structure.rods[rod].ends.map(|i| self.node(i));
                self.spread_load(path, (a, b), (value, &name));
            }
        }
    }

    /// A force whose arrow ends at its place, and a couple.
    fn point_load(&mut self, path: &str, at: P, value: [Expr; 3]) {
        let graph = &self.machine.model.graph;
        let forces: Vec<usize> = (0..2).filter(|k| !graph.is_zero(value[*k])).collect();
        let couple = !graph.is_zero(value[2]);
        let (vector, letter) = match forces[..] {
            [k] => {
                let (sense, letter) = self.signed(value[k], path);
                let mut v = [0.0; 3];
                v[k] = sense;
                (v, letter)
            }
            _ => ([self.value(value[0]), self.value(value[1]), 0.0], self.letters.load(path)),
        };
        if let Some(turn) = self.stage.turn(vector).filter(|_| !forces.is_empty()) {
            // where a rod is in the way of its tail it begins at its place
            let blocked = self.busy(at).into_iter().any(|b| (b - turn - PI).cos() > 0.9);
            let (from, to) = if blocked { (at, polar(at, 2.1 * S, turn)) } else { (polar(at, 2.1 * S, turn + PI), at) };
            self.put("force", path, Place { at: from, to, ..Place::default() });
            self.note(letter, if blocked { to } else { from }, 6.0, None);
        }
        if couple {
            let (sense, letter) = self.signed(value[2], path);
            let symbol = if sense < 0.0 { "moment_negative" } else { "moment" };
            self.put(symbol, path, Place { at, size: 1.1 * S, turn: FRAC_PI_2, ..Place::default() });
            self.note(letter, polar(at, 1.1 * S, FRAC_PI_2), 6.0, None);
        }
    }

    /// A load per length on a line, from its values at the ends.
    pub(super) fn spread_load(&mut self, path: &str, (a, b): (P, P), (value, name): ([[Expr; 2]; 2], &str)) {
        let graph = &self.machine.model.graph;
        let at_ends = value.map(|v| v.map(|e| self.value(e)));
        let most = if at_ends[0][0].hypot(at_ends[0][1]) >= at_ends[1][0].hypot(at_ends[1][1]) { 0 } else { 1 };
        let given: Vec<usize> = (0..2).filter(|k| !graph.is_zero(value[most][*k])).collect();
        let largest = at_ends[most][0].hypot(at_ends[most][1]);
        let (vector, letter) = match given[..] {
            [k] => {
                let (sense, letter) = self.signed(value[most][k], path);
                let mut v = [0.0; 3];
                v[k] = if largest > 0.0 { at_ends[most][k].signum() } else { sense };
                (v, letter)
            }
            _ => ([at_ends[most][0], at_ends[most][1], 0.0], self.letters.named(name)),
        };
        let Some(turn) = self.stage.turn(vector) else { return };
        let tall = |v: [f64; 2]| if largest > 0.0 { 1.5 * S * v[0].hypot(v[1]) / largest } else { 1.5 * S };
        let [first, last] = at_ends.map(tall);
        self.put("distributed", path, Place { at: a, to: b, size: first, other: last, turn, ..Place::default() });
        let middle = between(a, b, if most == 0 { 0.35 } else { 0.65 });
        self.note(letter, polar(middle, first.max(last), turn + PI), 5.0, Some(turn + PI));
    }

    fn displacement(&mut self, structure: &Structure, named: &mechanics::structure::Displacement) {
        let at = self.site(structure, named.site);
        let path = format!("displacements.{}", named.name);
        let text = self.letters.named(&named.name);
        match named.direction {
            Direction::Turn => {
                self.put("angle", &path, Place { at, size: 1.3 * S, turn: 0.3, other: 0.9, ..Place::default() });
                self.note(text, polar(at, 1.3 * S, 0.75), 5.0, Some(0.75));
            }
            Direction::Along(way) => {
                let Some(turn) = self.stage.turn([self.value(way[0]), self.value(way[1]), 0.0]) else { return };
                let from = polar(at, 0.7 * S, turn);
                let tip = polar(from, 1.5 * S, turn);
                self.put("coordinate", &path, Place { at: from, to: tip, ..Place::default() });
                self.note(text, tip, 5.0, Some(turn + 0.8));
            }
        }
    }

    /// Lengths and masses of rods that have letters; of many rods each letter once.
    fn rod_lengths(&mut self, structure: &Structure) {
        let mut known: Vec<LabelText> = Vec::new();
        for rod in &structure.rods {
            let [i, j] = rod.ends;
            let [a, b] = [i, j].map(|k| structure.nodes[k].at);
            let (from, to) = (self.node(i), self.node(j));
            let differing: Vec<usize> = (0..2).filter(|k| a[*k] != b[*k]).collect();
            let mut graph = self.machine.model.graph.clone();
            if let [k] = differing[..] {
                let letter = [(a[k], b[k]), (b[k], a[k])].into_iter().find_map(|(x, y)| {
                    let long = graph.sub(x, y);
                    graph.as_symbol(long).map(|s| self.letters.named(&graph.symbol_info(s).name))
                });
                if let Some(text) = letter.filter(|t| structure.rods.len() <= FEW || !known.contains(t)) {
                    known.push(text.clone());
                    self.note(text, between(from, to, 0.5), 5.0, None);
                }
            }
            let mass = graph.mul(rod.mass, rod.length);
            if let Some(symbol) = graph.as_symbol(mass) {
                let text = self.letters.named(&graph.symbol_info(symbol).name);
                self.note(text, between(from, to, 0.3), 7.0, None);
            }
        }
    }
}
