//! The model: a machine as its file describes it, with every name resolved, every quantity in SI and every formula an expression.
//!
//! Nothing here is derived: kinematics and equations are the business of `derive`. Everything was checked by the reader: dimensions,
//! cycles, dependence (positions depend on coordinates and time only, prescribed rates on time only, starts on constants only).

use std::ops::Range;
use symbolic::{Expr, Graph, SymbolId, Text};

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
    /// Springs.
    pub springs: Vec<Spring>,
    /// Dampers.
    pub dampers: Vec<Damper>,
    /// Forces.
    pub forces: Vec<Force>,
    /// Torques.
    pub torques: Vec<Torque>,
    /// Free-form potential energies.
    pub potentials: Vec<Potential>,
    /// Free-form Rayleigh functions.
    pub dissipations: Vec<Dissipation>,
    /// Connections, supports, motions, motors, stops and frictions: by table, within a table in the user's order.
    pub connections: Vec<Connection>,
    /// Named formulas for the user, in the user's order. An output used in another one is already expanded there.
    pub outputs: Vec<OutputDecl>,
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
    /// Instants of these at which the time of forces and torques begins anew, s.
    pub restarts: Vec<f64>,
    /// Studies, in the user's order.
    pub studies: Vec<Study>,
    /// Frame or truss, when the file has nodes.
    pub structure: Option<crate::structure::Structure>,
    /// Inertia that no body carries: that of a structure over its displacements.
    pub inertias: Vec<ConstantInertia>,
    /// A table of values that replace those of the file, one row a variant.
    pub variants: Option<Variants>,
}

/// A term M_ij q_i' q_j' of the kinetic energy (half of it for i = j).
#[derive(Clone, Debug)]
pub struct ConstantInertia {
    /// Indices in [`Model::coordinates`], ascending.
    pub between: [usize; 2],
    /// Over constant parameters.
    pub value: Expr,
}

/// A table of variants. Each row replaces values as `--set` does.
#[derive(Clone, Debug)]
pub struct Variants {
    /// The table.
    pub table: VariantTable,
    /// Column that names the variant; the first without it.
    pub key: Option<String>,
    /// Columns that are used, by the names of parameters, starts (`phi`) and starting rates (`phi'`); without it all must be such names.
    pub columns: Option<Vec<String>>,
    /// Parameter that gets the name of the variant as a number, unless the table has such a column.
    pub number: Option<String>,
    /// Place in the file.
    pub span: Range<usize>,
}

/// Where a table of variants is.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum VariantTable {
    /// In a file, relative to the model file.
    File(String),
    /// In the model file itself.
    Text(String),
}

/// Index of a frame or body in [`Model::frames`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct FrameId(pub usize);

impl FrameId {
    /// The ground.
    pub const GROUND: FrameId = FrameId(0);
    /// Position in [`Model::frames`].
    pub fn index(self) -> usize {
        self.0
    }
}

/// Index of a point in [`Model::points`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct PointId(pub usize);

impl PointId {
    /// Position in [`Model::points`].
    pub fn index(self) -> usize {
        self.0
    }
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
    /// What it is; may be empty.
    pub label: Text,
    /// Place in the file.
    pub span: Range<usize>,
}

/// An axis of a frame.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
#[allow(missing_docs)]
pub enum Axis {
    X,
    Y,
    Z,
}

impl Axis {
    /// 0, 1, 2.
    pub fn index(self) -> usize {
        self as usize
    }
}

/// A frame or a body.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Name; `ground` for index 0.
    pub name: String,
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

/// Something that has a position.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum PointRef {
    /// A named point.
    Point(PointId),
    /// The origin of a frame or body.
    Origin(FrameId),
    /// The mass centre of a body.
    Center(FrameId),
}

/// One scalar through which an element acts.
#[derive(Clone, Copy, Debug)]
pub enum Pathway {
    /// A formula over coordinates, time and position requests.
    Along(Expr),
    /// Distance between two points.
    Distance(PointRef, PointRef),
    /// Plane angle of the second frame minus that of the first.
    RelativeAngle(FrameId, FrameId),
}

/// The value of the pathway at which a spring carries its preload.
#[derive(Clone, Copy, Debug)]
pub enum Rest {
    /// A formula.
    Value(Expr),
    /// The value of the pathway at the start of the motion.
    Start,
}

/// Spring: force = preload + stiffness (pathway - rest), pulling the pathway shorter.
#[derive(Clone, Debug)]
pub struct Spring {
    /// Name.
    pub name: String,
    /// Pathway.
    pub pathway: Pathway,
    /// Stiffness.
    pub stiffness: Expr,
    /// Rest value of the pathway.
    pub rest: Rest,
    /// Force at rest; tension positive.
    pub preload: Expr,
    /// Whole play about `rest`, half on each side: the spring acts where |pathway - rest| > backlash/2, by what goes beyond.
    pub backlash: Option<Expr>,
    /// Place in the file (its name).
    pub span: Range<usize>,
}

/// Damper: force = damping · rate of the pathway, against it.
#[derive(Clone, Debug)]
pub struct Damper {
    /// Name.
    pub name: String,
    /// Pathway.
    pub pathway: Pathway,
    /// Damping.
    pub damping: Expr,
    /// Place in the file (its name).
    pub span: Range<usize>,
}

/// An applied force.
#[derive(Clone, Debug)]
pub struct Force {
    /// Name.
    pub name: String,
    /// How it acts.
    pub action: Action,
    /// Place in the file (its name).
    pub span: Range<usize>,
}

/// How a force acts.
#[derive(Clone, Debug)]
pub enum Action {
    /// A vector at a point.
    AtPoint {
        /// Where.
        at: PointRef,
        /// Components.
        value: [Expr; 3],
        /// Axes of the components.
        axes: FrameId,
    },
    /// Along a pathway; positive increases the pathway.
    OnPathway {
        /// Pathway.
        pathway: Pathway,
        /// Force, or torque when the pathway is an angle.
        value: Expr,
    },
}

/// An applied torque.
#[derive(Clone, Debug)]
pub struct Torque {
    /// Name.
    pub name: String,
    /// Where it acts.
    pub on: FrameId,
    /// Components.
    pub value: [Expr; 3],
    /// Axes of the components.
    pub axes: FrameId,
    /// Where minus the torque acts.
    pub reaction: Option<FrameId>,
    /// Place in the file (its name).
    pub span: Range<usize>,
}

/// A free-form potential energy.
#[derive(Clone, Debug)]
pub struct Potential {
    /// Name.
    pub name: String,
    /// Energy over coordinates, time and position requests.
    pub energy: Expr,
    /// Place in the file (its name).
    pub span: Range<usize>,
}

/// A free-form Rayleigh dissipation function; its force on q is -∂Φ/∂q'.
#[derive(Clone, Debug)]
pub struct Dissipation {
    /// Name.
    pub name: String,
    /// Function over coordinates, rates, time and requests.
    pub function: Expr,
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

/// A unit for showing values: shown = SI / factor.
#[derive(Clone, Debug, PartialEq)]
pub struct DisplayUnit {
    /// As the user wrote it: `rpm`, `об/мин`.
    pub label: String,
    /// SI value of one such unit.
    pub factor: f64,
}

/// A placeholder symbol and what it stands for.
#[derive(Clone, Debug)]
pub struct Request {
    /// The placeholder: named like `vx(A)`, or a name with primes.
    pub symbol: SymbolId,
    /// What it stands for.
    pub kind: RequestKind,
    /// SI unit label.
    pub unit: String,
}

/// What a placeholder stands for.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum RequestKind {
    /// Ground coordinate of a point: `x(A)`.
    Position(PointRef, Axis),
    /// Component of velocity in ground axes: `vx(A)`.
    Velocity(PointRef, Axis),
    /// Component of acceleration in ground axes: `ax(A)`. Outputs only.
    Acceleration(PointRef, Axis),
    /// Magnitude of velocity: `speed(A)`.
    Speed(PointRef),
    /// Plane angle from the ground: `angle(B)`.
    Angle(FrameId),
    /// Angular velocity about z of the ground: `omega(B)`.
    AngularVelocity(FrameId),
    /// Kinetic energy of everything, or of one body.
    KineticEnergy(Option<FrameId>),
    /// Potential energy of everything.
    PotentialEnergy,
    /// Rayleigh function of everything.
    Dissipation,
    /// Force of an element, tension positive: `force(S)`.
    ElementForce(Element),
    /// Pathway minus rest of a spring; the pathway itself for a damper: `extension(S)`.
    Extension(Element),
    /// A component of the reaction of a connection: `force(AB)`, `force_x(O)`.
    Reaction(usize, Part),
    /// Time derivative of an expression along the motion.
    TimeDerivative {
        /// What is differentiated: a parameter's symbol, or the formula of an output.
        of: Expr,
        /// How many times.
        order: u8,
    },
}

/// A spring or damper, by its index.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Element {
    /// Index in [`Model::springs`].
    Spring(usize),
    /// Index in [`Model::dampers`].
    Damper(usize),
}

/// A study.
#[derive(Clone, Debug)]
pub struct Study {
    /// What to do.
    pub kind: StudyKind,
    /// Place in the file.
    pub span: Range<usize>,
}

/// What a study does.
#[derive(Clone, Debug)]
pub enum StudyKind {
    /// Show the equations of motion.
    Equations,
    /// Find the equilibrium.
    Equilibrium {
        /// Initial guess of coordinates, SI; the start value for those not named.
        guess: Vec<(SymbolId, f64)>,
        /// Find all equilibria with a coordinate between two values.
        over: Option<Between>,
    },
    /// Compute a motion.
    Simulate(Simulate),
    /// Compute the motion of a linear system in closed form.
    Transient(Transient),
    /// Find the forces and torques of the motors that realise the prescribed motions.
    Inverse(Simulate),
    /// Find the reactions at rest.
    Statics,
    /// Follow a linkage over a range of a coordinate, without forces.
    Kinematics(Kinematics),
    /// Find a periodic motion.
    Periodic(Periodic),
    /// Energy balance of a machine over one turn.
    Cycle(Cycle),
    /// Repeat a study over values of a parameter.
    Sweep(Sweep),
    /// Natural frequencies and shapes.
    Modes(Modes),
    /// Forced oscillations over the frequency.
    Response(Response),
}

/// Positions, velocities and accelerations over a range of one coordinate; SI.
#[derive(Clone, Debug)]
pub struct Kinematics {
    /// The driven coordinate.
    pub over: SymbolId,
    /// Its name.
    pub name: String,
    /// First value; `None`: the coordinate's start.
    pub from: Option<f64>,
    /// Last value.
    pub to: KinematicsEnd,
    /// How many positions, both ends included.
    pub points: usize,
    /// Rate of the driven coordinate, constant, from which velocities and accelerations follow; `None`: its starting rate, or 1 when
    /// that is zero.
    pub rate: Option<f64>,
    /// Further driven coordinates as formulas of the driven one, for linkages of two and more degrees of freedom.
    pub with: Vec<(SymbolId, Expr)>,
    /// Outputs wanted, by name (also coordinates and rates); empty means all.
    pub outputs: Vec<String>,
    /// Plots wanted; the horizontal axis `None` is the driven coordinate.
    pub plots: Vec<Plot>,
}

/// Where a kinematic range ends.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum KinematicsEnd {
    /// At this value.
    At(f64),
    /// After so many turns of 2π from the first value.
    Turns(f64),
}

/// A periodic motion to find; SI.
#[derive(Clone, Debug)]
pub struct Periodic {
    /// What begins a period.
    pub section: Section,
    /// The period, where the section is a time; otherwise a guess.
    pub period: Option<f64>,
    /// Duration of an ordinary motion before the search begins.
    pub settle: f64,
    /// Parameter that is changed so that the period becomes the second value.
    pub tuned: Option<(String, f64)>,
    /// Relative tolerance of the integrator.
    pub tolerance: f64,
    /// Times at which results are wanted, counted from the section.
    pub times: Times,
    /// Outputs wanted, by name (also coordinates and rates); empty means all.
    pub outputs: Vec<String>,
    /// Plots wanted.
    pub plots: Vec<Plot>,
}

/// The surface at which a periodic motion begins and ends.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Section {
    /// The loads repeat in time: the period is given, the state is what returns.
    Time,
    /// The formula over coordinates, rates and time passes zero from below.
    Zero(Expr),
    /// The angle has grown by so many turns of 2π; the section passes through its start. All other coordinates return.
    Turns {
        /// The angle.
        angle: SymbolId,
        /// How many turns; negative when it falls.
        turns: f64,
    },
}

/// Energy balance of a cyclic machine; SI.
#[derive(Clone, Debug)]
pub struct Cycle {
    /// The angle that describes the cycle.
    pub angle: SymbolId,
    /// Its name.
    pub name: String,
    /// How many turns of 2π make a cycle (2 for a four-stroke engine); negative when it falls.
    pub turns: f64,
    /// Uniform rate of the angle; `None`: its starting rate.
    pub speed: Option<f64>,
    /// Parameter found from the balance: a drive force or torque. `None`: the balance is only drawn up.
    pub unknown: Option<String>,
    /// Wanted irregularity of running, (max - min)/mean of the rate.
    pub irregularity: Option<f64>,
    /// Parameter, an inertia, changed for the wanted irregularity.
    pub flywheel: Option<String>,
    /// How many positions of the tables, both ends included.
    pub points: usize,
    /// Plots wanted; the horizontal axis `None` is the angle.
    pub plots: Vec<Plot>,
}

/// A study repeated over values of parameters; SI.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// What is changed, the first slowest.
    pub over: Vec<SweepRange>,
    /// What is noted: outputs, or results of the study (`period`).
    pub observe: Vec<String>,
    /// Kind of the study of the file that is repeated; `None`: the first that has the results.
    pub of: Option<String>,
    /// Plots wanted, of what is noted over the values.
    pub plots: Vec<Plot>,
}

/// Values of a parameter, or of a start or starting rate of a coordinate.
#[derive(Clone, PartialEq, Debug)]
pub struct SweepRange {
    /// Name as with `--set`: `v`, `phi`, `phi'`.
    pub name: String,
    /// Values, SI.
    pub values: Vec<f64>,
}

/// A coordinate between two values, SI.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Between {
    /// The coordinate.
    pub coordinate: SymbolId,
    /// Least value.
    pub from: f64,
    /// Largest value.
    pub to: f64,
}

/// Natural frequencies and shapes about an equilibrium.
#[derive(Clone, Debug, Default)]
pub struct Modes {
    /// Where to look for the equilibrium, SI.
    pub guess: Vec<(SymbolId, f64)>,
    /// Scale of the shapes.
    pub scale: Scale,
    /// The unknown of the frequency equation; ω² without it.
    pub variable: Option<FrequencyVariable>,
    /// A parameter to follow the modes along.
    pub over: Option<ParameterRange>,
    /// Linearise about the motion at the start instead of a place of rest.
    pub about_start: bool,
}

/// How shapes are scaled.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Scale {
    /// The largest entry is 1.
    #[default]
    Largest,
    /// The first coordinate has 1.
    First,
    /// Modal mass 1.
    Mass,
}

/// name = factor·ω².
#[derive(Clone, Debug)]
pub struct FrequencyVariable {
    /// The user's letter.
    pub name: String,
    /// Over constant parameters.
    pub factor: Expr,
}

/// A parameter that takes equidistant values, SI.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterRange {
    /// Its name.
    pub name: String,
    /// First value.
    pub from: f64,
    /// Last value.
    pub to: f64,
    /// Number of values.
    pub points: usize,
}

/// Forced oscillations over the frequency of a harmonic load.
#[derive(Clone, Debug, Default)]
pub struct Response {
    /// Where to look for the equilibrium, SI.
    pub guess: Vec<(SymbolId, f64)>,
    /// The load, by name: a force, a torque, or a coordinate for a unit load on it. Otherwise the harmonic loads of the file.
    pub load: Option<String>,
    /// The parameter that is the frequency; otherwise the one that occurs as such in the loads.
    pub frequency: Option<String>,
    /// Frequencies from and to, rad/s; found from the natural frequencies when absent.
    pub range: Option<[f64; 2]>,
    /// Number of frequencies.
    pub points: Option<usize>,
    /// Logarithmic axes.
    pub log: bool,
    /// Outputs wanted, by name; the coordinates and the user's outputs when empty.
    pub outputs: Vec<String>,
    /// Frequencies at which the shape of the forced motion is shown, rad/s.
    pub shapes: Vec<f64>,
}

/// A motion in closed form.
#[derive(Clone, Debug)]
pub struct Transient {
    /// The motion.
    pub motion: Simulate,
    /// Small motions about the equilibrium when the system is not linear.
    pub linearise: bool,
}

/// A motion to compute; SI.
#[derive(Clone, Debug)]
pub struct Simulate {
    /// End of the motion.
    pub until: f64,
    /// Times at which results are wanted.
    pub times: Times,
    /// Relative tolerance.
    pub tolerance: f64,
    /// Outputs wanted, by name (also coordinates and rates); empty means all.
    pub outputs: Vec<String>,
    /// Plots wanted.
    pub plots: Vec<Plot>,
}

/// Times at which results are wanted.
#[derive(Clone, Debug, PartialEq)]
pub enum Times {
    /// Not said.
    Automatic,
    /// 0, step, 2 step, ... and the end.
    Every(f64),
    /// Exactly these, ascending.
    At(Vec<f64>),
}

/// A plot.
#[derive(Clone, Debug)]
pub struct Plot {
    /// Title; may be empty.
    pub title: Text,
    /// Name on the horizontal axis; `None` is time.
    pub x: Option<String>,
    /// Names on the vertical axis.
    pub y: Vec<String>,
}

/// The default tolerance of a simulation.
pub const DEFAULT_TOLERANCE: f64 = 1e-12;

/// Something with reactions: a joint, a support, a drive, a stop, a dry friction.
#[derive(Clone, Debug)]
pub struct Connection {
    /// Name.
    pub name: String,
    /// Table it stands in: `pins`.
    pub table: &'static str,
    /// What it does.
    pub kind: ConnectionKind,
    /// Place in the file (its name).
    pub span: Range<usize>,
}

/// What a connection does. Signs: a reaction acts on the second of two partners and opposite on the first, unless said otherwise.
#[derive(Clone, Debug)]
pub enum ConnectionKind {
    /// Two points coincide. Components in `axes`, acting on the frame of the second point.
    Pin {
        /// The points.
        between: [PointRef; 2],
        /// Axes of the components.
        axes: FrameId,
    },
    /// Two points coincide and their frames do not turn against each other (plane: one angle; space: three).
    Weld {
        /// The points.
        between: [PointRef; 2],
        /// Axes of the components.
        axes: FrameId,
    },
    /// A point stays on a straight line of another frame (slider on a guide, pin in a slot). The normal force acts on the frame of the
    /// point, positive towards the line's direction turned by +90 degrees.
    Slider {
        /// The sliding point.
        point: PointRef,
        /// The frame of the line.
        on: FrameId,
        /// A point of the line, fixed in `on`; `None`: the line passes through the point's place at the start.
        through: Option<PointRef>,
        /// Angle of the line from the x axis of `on`.
        direction: Expr,
        /// Whether the frame of the point may turn against `on`; otherwise a moment holds it.
        turns: bool,
    },
    /// Massless rigid rod: the distance of two points is constant. Tension is positive.
    Rod {
        /// The ends.
        between: [PointRef; 2],
        /// Length.
        length: Rest,
    },
    /// Inextensible rope or thread along points (ends, rings, axles of small pulleys), perhaps winding on drums. Tension is positive.
    Rope {
        /// The polygon; at least two points.
        path: Vec<PointRef>,
        /// Drums on which it winds, beyond the polygon.
        wound: Vec<Wound>,
        /// Length: polygon plus Σ winding radius · angle.
        length: Rest,
        /// Whether it may go slack (a contact) or is always held taut (an ideal condition).
        slack: bool,
        /// Restitution when it catches.
        restitution: Expr,
    },
    /// Two wheels turn together: belts (open, crossed), chains, gear pairs. The force is what the belt (its tension difference) or the
    /// tooth transmits; positive when it turns the second wheel in the positive direction.
    Wheels {
        /// The wheels.
        between: [FrameId; 2],
        /// Pitch radii.
        radii: [Expr; 2],
        /// Whether they turn in opposite directions (crossed belt, external gears).
        opposite: bool,
        /// The frame that carries both axes; angles count from it. Ground when absent.
        carrier: Option<FrameId>,
    },
    /// A gear on a rack, or a wheel on a straight line, or on a circle: no slip at the contact point. `tangential` acts on the wheel along
    /// the line's direction, `normal` on the wheel away from the line (towards its side).
    Rolling {
        /// The wheel.
        wheel: FrameId,
        /// Its centre; the wheel's origin unless given.
        center: PointRef,
        /// Radius of the rolling circle.
        radius: Expr,
        /// The frame of the track.
        on: FrameId,
        /// The track.
        track: Track,
        /// Whether the wheel is kept at the distance `radius` from the track (`normal` exists); not for racks.
        held: bool,
    },
    /// A condition written as a formula.
    Constraint {
        /// Vanishes: over coordinates and time, or affine in rates.
        zero: Expr,
        /// Whether it is on rates.
        on_rates: bool,
    },
    /// A point of a body (or the whole body with `Turn`) is held. The reaction acts on the body.
    Support {
        /// Where.
        at: PointRef,
        /// Directions held, in `axes`.
        directions: Vec<SupportDirection>,
        /// Axes of the components.
        axes: FrameId,
    },
    /// A prescribed motion: pathway = value, or its rate.
    Motion {
        /// What moves.
        pathway: Pathway,
        /// Over time and constants.
        value: Expr,
        /// Whether `value` is the rate.
        is_rate: bool,
    },
    /// An unknown force (or torque) along a pathway that realises a motion; positive increases the pathway.
    Motor {
        /// Where it acts: for two frames, the torque acts on the second and opposite on the first.
        pathway: Pathway,
    },
    /// One-sided stop: `gap` is never negative; the force, positive, pushes it open.
    Stop {
        /// Over coordinates and time.
        gap: Pathway,
        /// Its value at contact, taken off: gap = pathway - clearance when `above`, else clearance - pathway.
        clearance: Expr,
        /// Whether the pathway may only grow beyond the clearance.
        above: bool,
        /// Restitution.
        restitution: Expr,
    },
    /// Dry friction on a pathway. The force is positive when it resists a growing pathway.
    Friction {
        /// Pathway whose rate is the sliding speed.
        pathway: Pathway,
        /// Kinetic magnitude over constants, time and `u`, the sliding speed's magnitude; a coefficient when `normal` is given.
        kinetic: Expr,
        /// Symbol of `u` in `kinetic`.
        speed: SymbolId,
        /// Static limit (or coefficient); `None`: the kinetic one at u = 0.
        fixed: Option<Expr>,
        /// Normal force: a formula, which may contain reactions linearly; its magnitude counts.
        normal: Option<Expr>,
    },
}

/// A drum on which a rope winds: winding length = sense · radius · angle of the drum.
#[derive(Clone, Copy, Debug)]
pub struct Wound {
    /// The drum.
    pub on: FrameId,
    /// Its radius.
    pub radius: Expr,
    /// Whether the rope gets longer on the drum (shorter elsewhere) when the drum turns in the positive direction.
    pub positive: bool,
}

/// What a wheel rolls on.
#[derive(Clone, Copy, Debug)]
pub enum Track {
    /// A straight line.
    Line {
        /// A point of it; `None`: a line at the distance `radius` from the centre's place at the start.
        through: Option<PointRef>,
        /// Its angle from the x axis of the track's frame.
        direction: Expr,
        /// Whether the wheel is on the side of the direction turned by +90 degrees.
        left: bool,
    },
    /// A circle about a point of the track's frame.
    Circle {
        /// Its centre.
        center: PointRef,
        /// Its radius.
        radius: Expr,
        /// Whether the wheel is inside.
        inside: bool,
    },
}

/// A direction held by a support.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum SupportDirection {
    X,
    Y,
    Z,
    /// Rotation about z (`turn`), or about x, y, z in space.
    TurnX,
    TurnY,
    TurnZ,
}

/// A component of a connection's reaction.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum Part {
    /// The only component, or the magnitude where there are two or three: `force`.
    Force,
    /// `force_x`.
    ForceX,
    /// `force_y`.
    ForceY,
    /// `force_z`.
    ForceZ,
    /// `moment`, about z.
    Moment,
    /// `moment_x`.
    MomentX,
    /// `moment_y`.
    MomentY,
    /// `normal` of a rolling contact.
    Normal,
    /// `tangential` of a rolling contact.
    Tangential,
}
