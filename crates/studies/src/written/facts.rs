//! What the file gives, as rows of facts: bodies with their motion, connections, elements.

use super::pen::{inline, words};
use super::wording::Word;
use super::work::Work;
use crate::connections::{self, Own};
use crate::shown::{Role, role};
use algebra::arrange::Arrange;
use mechanics::model::{Element, Frame, FrameId, Inertia, Origin};
use report::document::Rich;
use report::formula::{Layout, Relation};
use report::table::Column;
use report::{Cell, Table};
use symbolic::equations::{Part, StepName};
use symbolic::{Expr, SymbolId};

/// How a body moves against what carries it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Moves {
    /// Not at all.
    Rests,
    /// All its points alike.
    Translates,
    /// About an axis that what carries it holds.
    Turns,
    /// In a plane in any way.
    InPlane,
    /// In space.
    InSpace,
}

/// Whether a body has a mass and no moment of inertia.
fn is_point(frame: &Frame) -> bool {
    frame.mass.as_ref().is_some_and(|m| matches!(m.inertia, Inertia::None))
}

/// The energy that an element is a part of; none of loads.
pub(super) fn part_of(role: Role) -> Option<Part> {
    match role {
        Role::Spring | Role::Energy => Some(Part::Potential),
        Role::Damper | Role::Dissipation => Some(Part::Dissipation),
        _ => None,
    }
}

impl<'a> Work<'a> {
    /// Numbers of bodies, by frame.
    pub(super) fn number(&self, frame: FrameId) -> Option<usize> {
        crate::numbering::number(self.model, frame)
    }

    /// Bodies in the order of their numbers.
    pub(super) fn by_number(&self) -> Vec<(usize, &'a Frame)> {
        let numbers = crate::numbering::numbers(self.model);
        let mut list: Vec<_> = self.model.frames.iter().enumerate().filter(|(_, frame)| frame.is_body).collect();
        list.arrange_by_key(|(i, _)| numbers[*i]);
        list
    }

    /// Whether a formula changes during the motion.
    fn changes(&self, e: Expr) -> bool {
        let moving = |s: SymbolId| s == self.model.time || self.model.coordinates.iter().any(|c| c.symbols.contains(&s));
        let varies = |s: SymbolId| {
            let class = self.model.parameters.iter().find(|p| p.symbol == s).map(|p| p.class);
            class.is_some_and(|class| class != mechanics::model::Class::Constant)
        };
        self.model.graph.contains(e, |s| moving(s) || varies(s))
    }

    /// How a body moves.
    pub(super) fn moves(&self, frame: &Frame) -> Moves {
        let plane = frame.rotations.iter().all(|(axis, _)| axis.index() == 2) && frame.spin.is_none_or(|(axis, _)| axis.index() == 2);
        let turns = frame.spin.is_some() || frame.rotations.iter().any(|(_, angle)| self.changes(*angle));
        let shifts = match &frame.origin {
            Origin::Vector(v) => v.iter().any(|e| self.changes(*e)),
            Origin::Point(p) => {
                let point = &self.model.points[p.index()];
                point.on != frame.on || point.at.iter().any(|e| self.changes(*e))
            }
        };
        // what stands fast on its carrier moves as that does
        if !turns && !shifts && frame.on != FrameId::GROUND {
            return self.moves(&self.model.frames[frame.on.index()]);
        }
        let carried = frame.on == FrameId::GROUND || self.moves(&self.model.frames[frame.on.index()]) == Moves::Rests;
        match (turns, shifts) {
            _ if !plane => Moves::InSpace,
            (false, false) if carried => Moves::Rests,
            (true, false) if carried => Moves::Turns,
            (false, true) if carried => Moves::Translates,
            (false, _) if self.moves(&self.model.frames[frame.on.index()]) == Moves::Translates => Moves::Translates,
            _ => Moves::InPlane,
        }
    }

    /// The motion of a body in words.
    fn motion(&self, frame: &Frame) -> String {
        let how = match self.moves(frame) {
            Moves::Rests => self.language.pick("at rest", "неподвижно"),
            Moves::Translates => self.language.pick("translates", "движется поступательно"),
            Moves::Turns => self.language.pick("turns about a fixed axis", "вращается вокруг неподвижной оси"),
            Moves::InPlane if is_point(frame) => {
                self.language.pick("a point mass that moves in the plane", "материальная точка, движется в плоскости")
            }
            Moves::InPlane => self.language.pick("moves in the plane", "совершает плоское движение"),
            Moves::InSpace => self.language.pick("moves in space", "движется в пространстве"),
        };
        let joined = match &frame.origin {
            Origin::Point(p) if self.model.points[p.index()].on != frame.on => {
                let point = &self.model.points[p.index()];
                let (name, body) = (&point.name, self.with_body(point.on));
                Some(self.language.pick(format!("joined with {body} at the point {name}"), format!("соединено с {body} в точке {name}")))
            }
            _ if frame.on != FrameId::GROUND => {
                let (en, ru) = (self.body(frame.on), self.of_body(frame.on));
                Some(self.language.pick(format!("its place counts from {en}"), format!("положение задано относительно {ru}")))
            }
            _ => None,
        };
        joined.map_or_else(|| how.to_owned(), |joined| format!("{how}; {joined}"))
    }

    fn formula(&self, e: Expr) -> Cell {
        Cell::Rich(Rich(vec![inline(self.printer.layout(&self.model.graph, e))]))
    }

    /// Bodies with their motion and inertia.
    pub(super) fn bodies(&self) -> Option<Table> {
        let heads = [Word::Number, Word::Body, Word::MovesHow, Word::Mass, Word::Inertia].map(|w| Column::new(self.language.word(w)));
        let mut table = Table::new(heads.into());
        let none = || Cell::words(self.language.word(Word::Free0));
        for (i, frame) in self.by_number() {
            let mass = frame.mass.as_ref().filter(|m| !self.model.graph.is_zero(m.mass));
            let inertia = frame.mass.as_ref().map(|m| match m.inertia {
                Inertia::Planar(e) if !self.model.graph.is_zero(e) => self.formula(e),
                Inertia::Tensor { zz, .. } => self.formula(zz),
                _ => none(),
            });
            table.row(vec![
                Cell::words(self.number(FrameId(i)).map_or(String::new(), |n| n.to_string())),
                Cell::words(self.body_name(FrameId(i))),
                Cell::words(self.motion(frame)),
                match (mass, &inertia) {
                    (Some(m), _) => self.formula(m.mass),
                    // a body about a fixed axis: its moment of inertia says all
                    (None, Some(_)) => Cell::words("–"),
                    (None, None) => none(),
                },
                inertia.unwrap_or_else(none),
            ]);
        }
        (!table.rows.is_empty()).then_some(table)
    }

    /// Connections and what they demand.
    pub(super) fn connections(&self) -> Option<Table> {
        let heads = [Word::Connection, Word::What].map(|w| Column::new(self.language.word(w)));
        let mut table = Table::new(heads.into());
        for (at, connection) in self.model.connections.iter().enumerate() {
            let demand = connections::of(connection).demand(&Own::of(connection), self);
            table.row(vec![Cell::words(self.connection_name(at)), Cell::words(self.language.pick(demand.en, demand.ru))]);
        }
        (!table.rows.is_empty()).then_some(table)
    }

    /// Springs, dampers and loads with their energy or virtual power.
    pub(super) fn elements(&self) -> Option<Table> {
        // where nothing moves a load has no power
        if self.equations.coordinates.is_empty() {
            return None;
        }
        let heads = [Word::Element, Word::Law].map(|w| Column::new(self.language.word(w)));
        let mut table = Table::new(heads.into());
        // the energy of a frame is no element of the file
        let framed = self.model.structure.is_some();
        let mut told = String::new();
        for (_, element) in self.model.acting().into_iter().filter(|(_, e)| !(framed && role(e.table) == Role::Energy && e.span.is_empty()))
        {
            // a load in several parts is one load of the file
            if std::mem::replace(&mut told, element.path.clone()) == element.path {
                continue;
            }
            let name = words::capital(&self.element_name(element));
            table.row(vec![Cell::words(name), Cell::Rich(Rich(self.law(element)))]);
        }
        (!table.rows.is_empty()).then_some(table)
    }

    /// Π or Φ of an element as the derivation has it, or the power of its load.
    fn law(&self, element: &Element) -> Vec<report::document::Inline> {
        let graph = &self.equations.graph;
        let part = part_of(role(element.table));
        if let Some(step) = self.equations.steps.iter().find(|step| Some(step.part) == part) {
            let single = step.formulas.len() == 1;
            let own = step
                .formulas
                .iter()
                .rev()
                .find(|f| matches!(&f.left, StepName::Quantity { index, .. } if *index == element.name || single && index.is_empty()));
            if let Some(formula) = own {
                return vec![inline(self.step_formula(formula))];
            }
        }
        let path = &element.path;
        let loads = self.equations.applied.iter().find(|load| load.path == *path);
        match loads {
            Some(load) if !load.forces.is_empty() => {
                let mut graph = graph.clone();
                let terms: Vec<Expr> = load
                    .forces
                    .iter()
                    .map(|(i, q)| {
                        let rate = graph.symbol(self.equations.coordinates[*i].symbols[1]);
                        graph.mul(*q, rate)
                    })
                    .collect();
                let power = graph.sum(&terms);
                vec![inline(Layout::Related(
                    Box::new(Layout::Symbol(self.printer.named(&self.power_of(path)))),
                    Relation::Equal,
                    Box::new(self.readable(&graph, power)),
                ))]
            }
            _ => vec![words("–")],
        }
    }
}
