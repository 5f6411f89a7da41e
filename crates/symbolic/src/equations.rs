//! The hand-over between mechanics and numerics: equations of motion as expressions.
//!
//! With coordinates q (n of them), multipliers and auxiliary states s:
//!
//! ```text
//! M(q, t) q'' = h(q, q', s, t) + reactions   equations of motion; conditions: see [`crate::connections`]
//! s' = r(q, q', s, t)                        auxiliary states (turn angle of a shaft with prescribed speed, ...)
//! ```
//!
//! Every symbol that occurs is time, a coordinate or its derivatives, an auxiliary state, a parameter (a number), or a definition
//! (a formula over the others, listed so that each uses earlier ones only).

use crate::connections::{Balance, Condition, Impacts, Reaction, Released};
use crate::{Expr, Graph, Matrix, Mounted, Substitution, SymbolId};
use std::sync::Arc;
use words::Text;

/// Equations of motion and everything that is asked of them.
#[derive(Clone, Debug)]
pub struct Equations {
    /// Owner of all expressions below.
    pub graph: Graph,
    /// Title of the model.
    pub title: Text,
    /// The symbol `t`.
    pub time: SymbolId,
    /// Generalized coordinates, in the user's order; n = length.
    pub coordinates: Vec<Coordinate>,
    /// Auxiliary first-order states.
    pub auxiliaries: Vec<Auxiliary>,
    /// Symbols with a number.
    pub parameters: Vec<Parameter>,
    /// Places at the start that lengths and rests are measured from.
    pub starts: Vec<Start>,
    /// Symbols that stand for a formula; each uses parameters, time, coordinates and earlier definitions only.
    pub definitions: Vec<Definition>,
    /// Mass matrix M, n x n, symmetric.
    pub mass: Matrix,
    /// Right-hand side h, length n: everything that does not contain accelerations.
    pub force: Vec<Expr>,
    /// Unknown reactions λ of connections, supports, motors, contacts and frictions. See [`crate::connections`].
    pub reactions: Vec<Reaction>,
    /// Conditions on the motion.
    pub conditions: Vec<Condition>,
    /// Balances of released bodies: what the reactions of supports follow from.
    pub balances: Vec<Balance>,
    /// The released bodies, for an audit of these balances.
    pub released: Released,
    /// The law of impact of several contacts.
    pub impacts: Impacts,
    /// Textbook form of each equation of motion, or the reason why it is not shown.
    pub textbook: Result<Vec<Equality>, Text>,
    /// Step-by-step derivation.
    pub steps: Vec<Step>,
    /// Second derivation (projected Newton-Euler): n residuals over q, q', q'' and reactions, which vanish exactly where the
    /// equations of motion hold; then the residuals of the balances.
    pub second: Vec<Expr>,
    /// What places the machine and has a value only within limits (an inverse sine, a root): the equations may stay real beyond them,
    /// because only derivatives enter, but the machine cannot be there.
    pub places: Vec<Expr>,
    /// Generalized forces of each load, parts of `force`.
    pub applied: Vec<Applied>,
    /// Energies and powers.
    pub energy: Energy,
    /// Every coordinate, rate, acceleration and auxiliary, then what the user wants to see.
    pub outputs: Vec<Output>,
    /// Printed symbols the user asked for: name as in formulas, symbol.
    pub notation: Vec<(String, String)>,
    /// Formulas over constants whose numbers decided something in the derivation: with other numbers of these it is to be made anew.
    pub premises: Vec<Expr>,
    /// Numbers among the parameters that follow from others without a formula: those of a frame. None where there are none.
    pub mounted: Option<Arc<dyn Mounted>>,
}

impl Equations {
    /// The formula without definitions.
    pub fn inlined(&self, graph: &mut Graph, formula: Expr) -> Expr {
        self.definitions.iter().rev().fold(formula, |e, d| Substitution::new([(d.symbol, d.formula)]).apply(graph, e))
    }

    /// Equations in which nothing stands yet, over `graph`, with time `t` and room for n accelerations: what is written by hand begins with them.
    pub fn empty(mut graph: Graph, n: usize) -> Equations {
        let time = graph.symbol_id("t", 0);
        let zero = graph.zero();
        let mass = Matrix::zeros(&mut graph, n, n);
        let energy = Energy {
            kinetic: zero,
            potential: zero,
            dissipation: zero,
            dissipated: zero,
            rate: zero,
            loads: zero,
            drives: zero,
            through: zero,
        };
        Equations {
            graph,
            title: Text::default(),
            time,
            coordinates: Vec::new(),
            auxiliaries: Vec::new(),
            parameters: Vec::new(),
            starts: Vec::new(),
            definitions: Vec::new(),
            mass,
            force: Vec::new(),
            reactions: Vec::new(),
            conditions: Vec::new(),
            balances: Vec::new(),
            released: Released::default(),
            impacts: Impacts::default(),
            textbook: Err(Text::default()),
            steps: Vec::new(),
            second: Vec::new(),
            places: Vec::new(),
            applied: Vec::new(),
            energy,
            outputs: Vec::new(),
            notation: Vec::new(),
            premises: Vec::new(),
            mounted: None,
        }
    }

    /// Whether numbers of a parameter's frame follow from it: giving it another value is then a matter of [`Equations::mounted`].
    pub fn is_mounted_on(&self, parameter: SymbolId) -> bool {
        self.mounted.as_ref().is_some_and(|m| m.reach().contains(&parameter))
    }

    /// Coordinates less ideal conditions and taut ropes, as they stand: conditions that repeat others count too.
    pub fn degrees_of_freedom(&self) -> usize {
        let ideal = self.reactions.iter().filter(|r| r.law.holds()).count();
        self.coordinates.len().saturating_sub(ideal)
    }
}

/// A load of the file: an applied force or torque, or a distributed load, with all that it is made of.
#[derive(Clone, Debug)]
pub struct Applied {
    /// Its table and name in the file, as `forces.f`.
    pub path: String,
    /// (index of a coordinate, generalized force).
    pub forces: Vec<(usize, Expr)>,
    /// (index of a balance, work there).
    pub released: Vec<(usize, Expr)>,
}

impl Applied {
    /// Its name without its table.
    pub fn name(&self) -> &str {
        self.path.rsplit_once('.').map_or(&self.path, |(_, name)| name)
    }
}

/// A generalized coordinate with its initial data.
#[derive(Clone, Debug)]
pub struct Coordinate {
    /// q, q', q''.
    pub symbols: [SymbolId; 3],
    /// SI unit of q (`m`, `rad`, `1`).
    pub unit: String,
    /// What it is.
    pub label: Text,
    /// Value at the start, over parameters only.
    pub start: Expr,
    /// Rate at the start, over parameters only.
    pub rate: Expr,
    /// Whether the user gives start and rate: a given value is kept when the machine is assembled, the others are guesses.
    pub given: [bool; 2],
    /// Whether the user gives a guess for start and rate: such values are sought before defaults of zero are moved.
    pub guessed: [bool; 2],
}

/// An auxiliary state s with s' = rate.
#[derive(Clone, Debug)]
pub struct Auxiliary {
    /// The state.
    pub symbol: SymbolId,
    /// SI unit.
    pub unit: String,
    /// What it is.
    pub label: Text,
    /// Its time derivative.
    pub rate: Expr,
    /// Value at the start, over parameters only.
    pub start: Expr,
}

/// A symbol with a number, SI.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// The symbol.
    pub symbol: SymbolId,
    /// The number, SI.
    pub value: f64,
    /// What the exact number has beyond `value`.
    pub rest: f64,
    /// As the user wrote it (`20 g`).
    pub written: String,
    /// SI unit.
    pub unit: String,
    /// What it is.
    pub label: Text,
}

/// The place of a coordinate at the start of the motion, as formulas use it (`rest = "start"`) where the file does not give it.
#[derive(Clone, Debug)]
pub struct Start {
    /// Index of the coordinate.
    pub coordinate: usize,
    /// Index of the parameter that stands for a place that is sought; none where the place is its default of 0.
    pub parameter: Option<usize>,
    /// Name of an element whose formula uses it.
    pub used_by: String,
}

/// A symbol that stands for a formula.
#[derive(Clone, Debug)]
pub struct Definition {
    /// The symbol.
    pub symbol: SymbolId,
    /// The formula.
    pub formula: Expr,
    /// SI unit.
    pub unit: String,
    /// What it is.
    pub label: Text,
    /// Whether to list it to the user (time derivatives of a definition are not).
    pub shown: bool,
}

/// left = right.
#[derive(Clone, Copy, Debug)]
pub struct Equality {
    /// Left side.
    pub left: Expr,
    /// Right side.
    pub right: Expr,
}

/// What a step of the written derivation is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// How many coordinates there are.
    Coordinates,
    /// T.
    Kinetic,
    /// Π.
    Potential,
    /// Φ.
    Dissipation,
    /// The conditions of connections.
    Conditions,
    /// Q of loads without a potential.
    Forces,
    /// What goes into Lagrange's equations.
    Derivatives,
}

/// One step of the written derivation.
#[derive(Clone, Debug)]
pub struct Step {
    /// What it is about.
    pub part: Part,
    /// Heading.
    pub title: Text,
    /// A sentence before the formulas; may be empty.
    pub words: Text,
    /// Formulas of the step.
    pub formulas: Vec<StepFormula>,
}

/// A formula of a step: the name of the quantity and its value, `T_1 = ...`.
#[derive(Clone, Debug)]
pub struct StepFormula {
    /// Left side.
    pub left: StepName,
    /// Right side.
    pub right: Expr,
}

/// The left side of a step formula.
#[derive(Clone, Debug)]
pub enum StepName {
    /// A plain symbol with an optional lower index: T_housing, Π, Φ, Q_x.
    Quantity {
        /// Letter: `T`, `Π`, `Φ`, `Q`, `v^2`.
        letter: String,
        /// Index, a name; empty when none.
        index: String,
    },
    /// ∂of/∂by.
    Partial {
        /// Numerator letter, `T`.
        of: String,
        /// Denominator.
        by: Expr,
    },
    /// d/dt ∂of/∂by.
    TimeDerivativeOfPartial {
        /// Numerator letter, `T`.
        of: String,
        /// Denominator.
        by: Expr,
    },
    /// Any expression.
    Formula(Expr),
}

/// Energies and powers as expressions over q, q', s, t (and q'' in `rate` and `drive`).
#[derive(Clone, Copy, Debug)]
pub struct Energy {
    /// Kinetic energy T.
    pub kinetic: Expr,
    /// Potential energy Π.
    pub potential: Expr,
    /// Rayleigh's dissipation function Φ.
    pub dissipation: Expr,
    /// Power taken by all dissipative elements (2 Φ for viscous ones).
    pub dissipated: Expr,
    /// dE/dt by differentiation of E = T + Π, over q, q', q''.
    pub rate: Expr,
    /// Power of applied loads that have no potential and are not in `dissipated`.
    pub loads: Expr,
    /// Power of the drives that realise prescribed motions, from Newton-Euler; over q, q', q''.
    pub drives: Expr,
    /// Σ |Q_kj q'_j| over every load k (gravity of each body, each spring, damper, force) and every reaction that is in the powers, and every
    /// coordinate j, and with drives every component of the inertia forces of each body: how large the powers are before they cancel.
    pub through: Expr,
}

/// A named formula for the user.
#[derive(Clone, Debug)]
pub struct Output {
    /// Name in files and on the command line: `omega_p`, `phi'`.
    pub name: String,
    /// For pretty printing.
    pub symbol: SymbolId,
    /// SI unit.
    pub unit: String,
    /// Unit to show it in, with the SI value of one such unit, when the user names one.
    pub display: Option<(String, f64)>,
    /// What it is.
    pub label: Text,
    /// Where it comes from.
    pub role: Role,
    /// The formula over q, q', q'', s, t and parameters.
    pub formula: Expr,
}

/// Where an output comes from.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Role {
    /// A generalized coordinate.
    Coordinate,
    /// Its rate.
    Rate,
    /// Its second derivative.
    Acceleration,
    /// An auxiliary state.
    Auxiliary,
    /// A formula of the user's.
    Named,
    /// Power of a motor, `power(B)`.
    Power,
    /// The formula of a named event, `event(NAME)`; no result of its own.
    Event,
}
