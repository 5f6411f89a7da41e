//! The model: a machine as its file describes it, with every name resolved, every quantity in SI and every formula an expression.
//!
//! Nothing here is derived: kinematics and equations are the business of `derive`. Everything was checked by the reader: dimensions,
//! cycles, dependence (positions depend on coordinates and time only, prescribed rates on time only, starts on constants only).

mod change;
mod claims;
mod connections;
mod law;
mod pathway;
mod premises;
mod report;
mod variants;

pub use crate::asked::{FrequencyVariable, Plot, SweepRange, Times};
pub use crate::requests::*;
pub use claims::*;
pub use connections::*;
pub use law::{Element, Found, Law, Push, Site, Sketch, Stage, Straight, Way};
pub use pathway::{Measure, Pathway, Rest};
pub use premises::{Change, Premise, Reliance, Values, unmoved};
pub use report::{Depth, Front, Report};
pub use variants::*;

use algebra::arrange::Arrange;
use std::ops::Range;
use symbolic::{Expr, Graph, SymbolId};
use words::Text;

/// A machine.
#[derive(Clone, Debug)]
pub struct Model {
    /// Title; empty when the file gives none.
    pub title: Text,
    /// Description; may be empty.
    pub description: Text,
    /// Owner of all expressions below.
    pub graph: Graph,
    /// The symbol `t`.
    pub time: SymbolId,
    /// Acceleration of gravity in ground axes; `None` when switched off or when no body feels it.
    pub gravity: Option<[Expr; 3]>,
    /// Parameters. The user's order, except that a formula comes after everything it uses. The predefined `g` is among them only
    /// when something uses it.
    pub parameters: Vec<ParameterDecl>,
    /// Generalized coordinates, in the user's order.
    pub coordinates: Vec<CoordinateDecl>,
    /// Frames and bodies. Index 0 is the ground; a parent, and the frame of a point used as origin, come before the child.
    pub frames: Vec<Frame>,
    /// Points, in the user's order.
    pub points: Vec<Point>,
    /// Springs, dampers, loads: see [`crate::elements::TABLE`]. Those that were added later stand at the end; [`Model::acting`] has the order in which they act.
    pub elements: Vec<Element>,
    /// Connections, supports, motions, motors, stops and frictions: by table, within a table in the user's order.
    pub connections: Vec<Connection>,
    /// Named formulas for the user, in the user's order. An output used in another one is already expanded there.
    pub outputs: Vec<OutputDecl>,
    /// Formulas whose zeros are instants to be found, in the user's order.
    pub events: Vec<EventDecl>,
    /// Formulas of the motion that studies observe.
    pub observed: Vec<ObservedDecl>,
    /// Regimes of the motion, in order: the first whose condition holds is meant.
    pub regimes: Vec<RegimeDecl>,
    /// Published results to be laid against the machine.
    pub claims: Vec<ClaimDecl>,
    /// What `derive` must find: placeholder symbols that occur in formulas and what they stand for. In order of first use, so that the
    /// argument of a time derivative contains earlier requests only.
    pub requests: Vec<Request>,
    /// Printed symbols the user asked for: name as in formulas, symbol.
    pub notation: Vec<(String, String)>,
    /// Sections of rods, in the user's order.
    pub sections: Vec<crate::section::Section>,
    /// Ends of the phases of the load schedule, ascending, s. What the phases set is already a formula of time.
    pub phases: Vec<f64>,
    /// Parameters that are found so that the start is a place of rest; their numbers are guesses.
    pub unknowns: Vec<SymbolId>,
    /// Frictions at their limit in that place: name, about to slide forward (1) or backward (-1).
    pub impending: Vec<(String, f64)>,
    /// The law of impact of several contacts.
    pub impacts: symbolic::connections::Impacts,
    /// Instants of these at which the time of forces and torques begins anew, s.
    pub restarts: Vec<f64>,
    /// Studies, in the user's order.
    pub studies: Vec<crate::asked::Asked>,
    /// Frame or truss, when the file has nodes.
    pub structure: Option<crate::structure::Structure>,
    /// Inertia that no body carries: that of a structure over its displacements.
    pub inertias: Vec<ConstantInertia>,
    /// Values that replace those of the file, one set a variant.
    pub variants: Option<Variants>,
    /// Items that a student answers, in the user's order.
    pub answers: Vec<AnswerDecl>,
    /// What the file gives in another unit than the SI one (coordinates, their rates with a prime, parameters), with that unit: a bare number would be misread.
    pub scaled: std::collections::BTreeMap<String, String>,
    /// What the file says about its written calculation.
    pub report: Report,
    /// What the reader read off numbers, each once.
    pub premises: Vec<Premise>,
    /// Those of them that only studies rest on.
    pub of_studies: Vec<Premise>,
}

/// A term M_ij q_i' q_j' of the kinetic energy (half of it for i = j).
#[derive(Clone, Debug)]
pub struct ConstantInertia {
    /// Indices in [`Model::coordinates`], ascending.
    pub between: [usize; 2],
    /// Over constant parameters.
    pub value: Expr,
}

/// What a value depends on; the order is meant: each class may use the ones before it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Class {
    /// A number.
    Constant,
    /// Changes with time in a prescribed way.
    Time,
    /// Changes with coordinates or rates.
    State,
}

/// A named value.
#[derive(Clone, Debug)]
pub struct ParameterDecl {
    /// Name in formulas.
    pub name: String,
    /// Its symbol; formulas contain the symbol, never the value.
    pub symbol: SymbolId,
    /// Number or formula.
    pub value: ParameterValue,
    /// What it depends on.
    pub class: Class,
    /// The value in SI when `class` is [`Class::Constant`], also for formulas; always finite.
    pub number: Option<f64>,
    /// SI unit label: `kg`, `N m`, `1`.
    pub unit: String,
    /// As the user wrote it: `20 g`.
    pub written: String,
    /// What it is; may be empty.
    pub label: Text,
    /// Place in the file; `None` when predefined or set on the command line.
    pub span: Option<Range<usize>>,
}

/// Number or formula.
#[derive(Clone, Copy, Debug)]
pub enum ParameterValue {
    /// Free of symbols, SI, exact; may contain π, roots and functions of numbers.
    Number {
        /// The number.
        si: Expr,
    },
    /// Over other parameters, time, coordinates, rates and requests.
    Formula(Expr),
}

impl ParameterValue {
    /// The value as an expression.
    pub fn expr(self) -> Expr {
        match self {
            ParameterValue::Number { si } => si,
            ParameterValue::Formula(e) => e,
        }
    }
}

/// A generalized coordinate.
#[derive(Clone, Debug)]
pub struct CoordinateDecl {
    /// Name in formulas.
    pub name: String,
    /// q, q', q''.
    pub symbols: [SymbolId; 3],
    /// SI unit labels of q, q', q'': `rad`, `rad/s`, `rad/s^2`.
    pub units: [String; 3],
    /// Value at the start, over constant parameters; a guess when not `given`.
    pub start: Expr,
    /// Rate at the start, over constant parameters.
    pub rate: Expr,
    /// Whether the file gives start and rate. Others are found from the connections, beginning at `start` and `rate`.
    pub given: [bool; 2],
    /// Whether the file gives a guess for start and rate; values with neither are 0 wherever the connections allow it.
    pub guessed: [bool; 2],
    /// What it is; may be empty.
    pub label: Text,
    /// Place in the file.
    pub span: Range<usize>,
}

/// A frame or a body.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Name; `ground` for index 0.
    pub name: String,
    /// What it is; may be empty.
    pub label: Text,
    /// Whether it stands under `[bodies]`.
    pub is_body: bool,
    /// The frame it is placed on; the ground names itself.
    pub on: FrameId,
    /// Where its origin is.
    pub origin: Origin,
    /// Successive rotations from the axes of `on`, each about an own, already turned axis.
    pub rotations: Vec<(Axis, Expr)>,
    /// Prescribed rate of turning about an own axis after `rotations`; over constants and time only. At t = 0 the angle is 0.
    pub spin: Option<(Axis, Expr)>,
    /// Mass properties; `None` for frames and massless bodies.
    pub mass: Option<Mass>,
    /// Place in the file (its name).
    pub span: Range<usize>,
}

/// Where the origin of a frame is.
#[derive(Clone, Debug)]
pub enum Origin {
    /// In the axes of [`Frame::on`], from its origin.
    Vector([Expr; 3]),
    /// At a point; the axes are still those of [`Frame::on`].
    Point(PointId),
}

/// Mass properties of a body.
#[derive(Clone, Debug)]
pub struct Mass {
    /// Mass; the number 0 for a body with an inertia only.
    pub mass: Expr,
    /// Mass centre in body axes.
    pub center: [Expr; 3],
    /// Inertia about the mass centre, body axes.
    pub inertia: Inertia,
    /// Whether gravity acts on it.
    pub gravity: bool,
    /// The homogeneous body that its inertia is that of.
    pub shape: Option<Solid>,
}

/// A homogeneous body as the file names it.
#[derive(Clone, Debug)]
pub struct Solid {
    /// `disc`, `rod`, ...: see [`crate::SHAPES`].
    pub name: &'static str,
    /// Its lengths, m.
    pub lengths: Vec<Expr>,
    /// Axis of the body along which a rod lies.
    pub axis: Axis,
}

/// Inertia about the mass centre.
#[derive(Clone, Copy, Debug)]
pub enum Inertia {
    /// Nothing given: a point mass.
    None,
    /// About an axis through the centre along z only: enough in the plane.
    Planar(Expr),
    /// All of it, body axes. The products are the sums Σ m x y, so that the tensor has them with a minus sign.
    #[allow(missing_docs)]
    Tensor { xx: Expr, yy: Expr, zz: Expr, xy: Expr, yz: Expr, xz: Expr },
}

/// A named point of a frame.
#[derive(Clone, Debug)]
pub struct Point {
    /// Name.
    pub name: String,
    /// The frame it belongs to.
    pub on: FrameId,
    /// Coordinates in that frame; may depend on coordinates and time.
    pub at: [Expr; 3],
    /// Place in the file (its name).
    pub span: Range<usize>,
}

/// A named formula for the user.
#[derive(Clone, Debug)]
pub struct OutputDecl {
    /// Name.
    pub name: String,
    /// Its symbol, for printing.
    pub symbol: SymbolId,
    /// The formula, over coordinates, rates, accelerations, time, parameters and requests.
    pub formula: Expr,
    /// SI unit label.
    pub unit: String,
    /// Unit to show it in, when the user names one.
    pub display: Option<DisplayUnit>,
    /// What it is; may be empty.
    pub label: Text,
    /// Place in the file (its name).
    pub span: Range<usize>,
}

/// A formula of the motion that a study observes.
#[derive(Clone, Debug)]
pub struct ObservedDecl {
    /// As it is written: the name of the result.
    pub name: String,
    /// A symbol of its own.
    pub symbol: SymbolId,
    /// Like that of an output.
    pub formula: Expr,
    /// SI unit label.
    pub unit: String,
    /// Its dimension where the formula has one.
    pub dimension: Option<crate::units::Dimension>,
    /// Place of the formula in the file.
    pub span: Range<usize>,
}

/// A regime of the motion by a condition on its numbers.
#[derive(Clone, Debug)]
pub struct RegimeDecl {
    /// Name.
    pub name: String,
    /// The condition as it is written.
    pub text: String,
    /// The numbers in it as studies observe them, and the symbols that stand for them.
    pub numbers: Vec<(String, SymbolId)>,
    /// 1 where it holds, 0 elsewhere; over these symbols and constant parameters.
    pub holds: Expr,
    /// Place of the condition in the file.
    pub span: Range<usize>,
}

/// A named event.
#[derive(Clone, Debug)]
pub struct EventDecl {
    /// Name.
    pub name: String,
    /// What it is; may be empty.
    pub label: Text,
    /// A symbol of its own.
    pub symbol: SymbolId,
    /// The formula whose zeros are meant; like that of an output.
    pub zero: Expr,
    /// SI unit label of the formula.
    pub unit: String,
    /// Which changes of sign count.
    pub direction: EventDirection,
    /// Whether the motion ends there.
    pub stop: bool,
    /// Place of the formula in the file.
    pub span: Range<usize>,
}

/// Which changes of sign are events.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EventDirection {
    /// From minus to plus.
    Rising,
    /// From plus to minus.
    Falling,
    /// Either.
    Both,
}

/// A unit for showing values: shown = SI / factor.
#[derive(Clone, Debug, PartialEq)]
pub struct DisplayUnit {
    /// As the user wrote it: `rpm`, `об/мин`.
    pub label: String,
    /// SI value of one such unit.
    pub factor: f64,
}

impl Model {
    /// Elements with their handles, in the order of their tables.
    pub fn acting(&self) -> Vec<(ElementId, &Element)> {
        let mut all: Vec<_> = self.elements.iter().enumerate().map(|(i, e)| (ElementId(i), e)).collect();
        all.arrange_by_key(|(_, e)| e.rank);
        all
    }
}
