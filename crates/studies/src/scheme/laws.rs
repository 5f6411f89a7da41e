//! Elements that the file gives by an energy or a dissipation function. Where the formula is that of a spring, of a damper or of the resistance of a medium, it is
//! drawn as such: the coefficient of a parameter tells which place of the machine it belongs to, as μ v_A²/2 does the point A.

use super::ends::{Ends, Finder};
use super::groups::Groups;
use super::numbers::{Instant, Numbers, V3, dot, known, plus, unit};
use crate::machine::Machine;
use crate::shown::{Role, role};
use mechanics::model::{Element, FrameId, Measure, PointRef, Site};
use report::scheme::LabelText;
use std::collections::BTreeMap;
use symbolic::{Expr, Node, SymbolId};

/// How far coordinates are moved for rates of places: central differences of it carry eight digits and more.
const SMALL: f64 = 1e-4;
/// Coefficients that differ less, relatively, are one: they come of differences that carry eight digits.
const SAME: f64 = 1e-6;

/// Whether an element pulls back or resists on its pathway.
pub(super) fn resists(role: Role) -> bool {
    matches!(role, Role::Spring | Role::Damper | Role::Energy | Role::Dissipation)
}

/// The resistance of a medium against a place that moves in more than one direction.
#[derive(Clone, Debug)]
pub(super) struct Drag {
    /// The place.
    pub on: PointRef,
    /// Against its motion.
    pub against: V3,
    /// The coefficient.
    pub letter: LabelText,
}

/// The ends of a spring or damper that is given by a formula, and its letter where a parameter is its coefficient.
pub(super) fn ends(
    machine: &Machine,
    (numbers, groups): (&Numbers, &Groups),
    element: &Element,
    at: &Instant,
) -> Option<(Ends, Option<LabelText>)> {
    let law = Law::of(machine, element, at)?;
    let [moved] = law.moved[..] else { return law.point(machine, groups) };
    if let Some(found) = law.point(machine, groups) {
        return Some(found);
    }
    let c = &machine.model.coordinates[moved];
    let coefficient = law.coefficient(moved, moved);
    // a formula that does not bend is a given force, no spring
    if coefficient.abs() < SAME || !coefficient.is_finite() {
        return None;
    }
    let measure = if c.units[0] == "rad" { Measure::Angle } else { Measure::Length };
    let values = numbers.coordinate(moved);
    match Finder::new(machine, (numbers, groups), &values).ends(measure) {
        Ends::Unknown => None,
        found => Some((found, law.letter(coefficient))),
    }
}

/// The resistance of a medium, where an element is one.
pub(super) fn drag(machine: &Machine, groups: &Groups, (element, at): (&Element, &Instant)) -> Option<Drag> {
    let law = Law::of(machine, element, at).filter(|law| !law.energy)?;
    let rates = Rates::of(machine, &law, groups);
    let (on, letter, way) = rates.points.iter().find_map(|(p, way)| {
        let letter = law.letter(law.alike(&|i, j| dot(way[i], way[j]))?)?;
        Some((*p, letter, way))
    })?;
    let moves = law.moved.iter().enumerate().fold([0.0; 3], |sum, (k, j)| plus(sum, at.rates[*j], way[k]));
    Some(Drag { on, against: unit(moves)?.map(|c| -c), letter })
}

/// A formula of coordinates, or of rates, alone.
struct Law<'a> {
    machine: &'a Machine,
    formula: Expr,
    known: BTreeMap<SymbolId, f64>,
    at: &'a Instant,
    energy: bool,
    /// Coordinates that it names.
    moved: Vec<usize>,
}

impl<'a> Law<'a> {
    fn of(machine: &'a Machine, element: &Element, at: &'a Instant) -> Option<Law<'a>> {
        let sketch = element.law.sketch();
        let energy = match (sketch.site, role(element.table)) {
            (Site::Energy, Role::Energy) => true,
            (Site::Dissipation, Role::Dissipation) => false,
            _ => return None,
        };
        let model = &machine.model;
        let symbols = model.graph.symbols_in(&[sketch.letter]);
        let has = |s: SymbolId| symbols.binary_search(&s).is_ok();
        let other = |c: &mechanics::model::CoordinateDecl| (0..c.symbols.len()).any(|k| k != usize::from(!energy) && has(c.symbols[k]));
        let asks = model.requests.iter().any(|r| has(r.symbol)) || has(model.time);
        if asks || model.coordinates.iter().any(other) {
            return None;
        }
        let moved = (0..model.coordinates.len()).filter(|j| has(model.coordinates[*j].symbols[usize::from(!energy)])).collect();
        let law = Law { machine, formula: sketch.letter, known: known(machine, at), at, energy, moved };
        // a weight on an arm is a potential of an angle, too: cosines make no spring
        (!(law.moved.is_empty() || energy && law.calls())).then_some(law)
    }

    fn calls(&self) -> bool {
        let graph = &self.machine.model.graph;
        graph.reachable(&[self.formula]).into_iter().any(|e| matches!(graph.node(e), Node::Call { .. } | Node::Switch { .. }))
    }

    /// The value with coordinates, or rates, that are zero but for these.
    fn value(&self, given: &[(usize, f64)]) -> f64 {
        let order = usize::from(!self.energy);
        let mut values = self.known.clone();
        for j in &self.moved {
            values.insert(self.machine.model.coordinates[*j].symbols[order], 0.0);
        }
        for (j, v) in given {
            *values.entry(self.machine.model.coordinates[*j].symbols[order]).or_default() += v;
        }
        self.machine.model.graph.evaluate(&[self.formula], &|s| values.get(&s).copied().unwrap_or(0.0))[0]
    }

    /// The second derivative by two of them: at rest for an energy.
    fn coefficient(&self, i: usize, j: usize) -> f64 {
        // dissipation functions are squares of rates, energies are so near their middle
        let h = if self.energy { 1e-3 } else { 1.0 };
        let all = |a: f64, b: f64| self.value(&[(i, a * h), (j, b * h)]);
        (all(1.0, 1.0) - all(1.0, -1.0) - all(-1.0, 1.0) + all(-1.0, -1.0)) / (4.0 * h * h)
    }

    /// The factor between the coefficients and products of rates of something; none where they are not alike.
    fn alike(&self, product: &dyn Fn(usize, usize) -> f64) -> Option<f64> {
        let n = self.moved.len();
        let pairs = move || (0..n).flat_map(move |i| (0..n).map(move |j| (i, j)));
        let (i, j) = pairs().max_by(|a, b| product(a.0, a.1).abs().total_cmp(&product(b.0, b.1).abs()))?;
        let factor = self.coefficient(self.moved[i], self.moved[j]) / product(i, j);
        let size = (factor * product(i, j)).abs();
        let fits = |(i, j): (usize, usize)| (self.coefficient(self.moved[i], self.moved[j]) - factor * product(i, j)).abs() < SAME * size;
        (factor.is_finite() && factor.abs() > 0.0 && pairs().all(fits)).then_some(factor)
    }

    /// The parameter of the formula that has this value.
    fn letter(&self, value: f64) -> Option<LabelText> {
        let symbols = self.machine.model.graph.symbols_in(&[self.formula]);
        let is = |p: &&mechanics::model::ParameterDecl| {
            let number = self.known.get(&p.symbol).copied().unwrap_or(f64::NAN);
            symbols.binary_search(&p.symbol).is_ok() && (number - value).abs() <= SAME * value.abs()
        };
        let found = self.machine.model.parameters.iter().find(is)?;
        let shown = self.machine.model.notation.iter().find(|(n, _)| *n == found.name).map_or(&found.name, |(_, shown)| shown);
        Some(LabelText::Symbol(shown.clone()))
    }

    /// A damper of a place that moves along a line, or of a body that turns, whose coefficient is a parameter of the formula.
    fn point(&self, machine: &Machine, groups: &Groups) -> Option<(Ends, Option<LabelText>)> {
        if self.energy {
            return None;
        }
        let rates = Rates::of(machine, self, groups);
        for (on, way) in &rates.points {
            let Some(letter) = self.alike(&|i, j| dot(way[i], way[j])).and_then(|c| self.letter(c)) else { continue };
            let direction = unit(*way.iter().find(|w| dot(**w, **w) > 0.0)?)?;
            let straight = way.iter().all(|w| dot(*w, *w) - dot(*w, direction).powi(2) <= SAME * dot(*w, *w));
            return straight.then_some((Ends::Along { on: *on, from: None, direction, driven: 0.0, arm: None }, Some(letter)));
        }
        rates.turns.iter().find_map(|(on, way)| {
            let letter = self.letter(self.alike(&|i, j| way[i] * way[j])?)?;
            Some((Ends::Turn { on: *on, from: FrameId::GROUND, sense: 1.0 }, Some(letter)))
        })
    }
}

/// How places and angles move with the coordinates of a formula.
struct Rates {
    points: Vec<(PointRef, Vec<V3>)>,
    turns: Vec<(FrameId, Vec<f64>)>,
}

impl Rates {
    fn of(machine: &Machine, law: &Law, groups: &Groups) -> Rates {
        let moved = |j: usize, by: f64| {
            let mut at = law.at.clone();
            at.q[j] += by;
            Numbers::new(machine, &at, &[])
        };
        let pairs: Vec<[Numbers; 2]> = law.moved.iter().map(|j| [moved(*j, SMALL), moved(*j, -SMALL)]).collect();
        let step = 1.0 / (2.0 * SMALL);
        let way = |p: PointRef| pairs.iter().map(|[a, b]| plus(a.at(0, p), -1.0, b.at(0, p)).map(|c| c * step)).collect::<Vec<V3>>();
        let turn = |f: FrameId| {
            let by = |[a, b]: &[Numbers; 2]| super::ends::turned(a.frames[0][f.index()].angle() - b.frames[0][f.index()].angle()) * step;
            pairs.iter().map(by).collect::<Vec<f64>>()
        };
        let roots = groups.all.iter().skip(1).filter(|g| g.turns).map(|g| g.root);
        Rates {
            points: super::ends::places(machine, groups).into_iter().map(|p| (p, way(p))).collect(),
            turns: roots.map(|f| (f, turn(f))).collect(),
        }
    }
}
