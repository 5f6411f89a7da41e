//! What a formula may ask of a machine (`x(A)`, `force(S)`, a time derivative) and the handles of what it asks: frames, points, elements, parts of a
//! reaction.

use symbolic::{Expr, SymbolId};

/// Index of a frame or body in `Model::frames`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct FrameId(pub usize);

impl FrameId {
    /// The ground.
    pub const GROUND: FrameId = FrameId(0);
    /// Position in `Model::frames`.
    pub fn index(self) -> usize {
        self.0
    }
}

/// Index of a point in `Model::points`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct PointId(pub usize);

impl PointId {
    /// Position in `Model::points`.
    pub fn index(self) -> usize {
        self.0
    }
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
    /// `tight_side` of a belt or chain: the larger tension.
    Tight,
    /// `slack_side` of a belt or chain: the smaller one.
    Slack,
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
    /// What an element tells of itself, `force(S)`: which of the values that its law gives.
    Element(ElementId, usize),
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

/// Index of an element in `Model::elements`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct ElementId(pub usize);

impl Part {
    /// The function that asks for it in formulas.
    pub fn name(self) -> &'static str {
        match self {
            Part::Force => "force",
            Part::ForceX => "force_x",
            Part::ForceY => "force_y",
            Part::ForceZ => "force_z",
            Part::Moment => "moment",
            Part::MomentX => "moment_x",
            Part::MomentY => "moment_y",
            Part::Normal => "normal",
            Part::Tangential => "tangential",
            Part::Tight => "tight_side",
            Part::Slack => "slack_side",
        }
    }
}
