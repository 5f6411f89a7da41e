//! Connections of a model: what joins, holds, drives, stops and rubs.

use super::pathway::{Pathway, Rest};
use crate::requests::{FrameId, PointRef};
use std::ops::Range;
use symbolic::connections::Rebound;
use symbolic::{Expr, SymbolId};
use words::Text;

/// Something with reactions: a joint, a support, a drive, a stop, a dry friction.
#[derive(Clone, Debug)]
pub struct Connection {
    /// Name.
    pub name: String,
    /// Table it stands in: `pins`.
    pub table: &'static str,
    /// What it is, in words; empty where the file does not say.
    pub label: Text,
    /// What it does.
    pub kind: ConnectionKind,
    /// SI unit of its force, for those that act along a formula: energy by the formula's unit. Empty where the formula has no known dimension.
    pub unit: String,
    /// Place in the file (its name).
    pub span: Range<usize>,
}

impl Connection {
    /// What is said of a part of it, `pin B, along x`, in the words of its label where it has one: `right support, along x`.
    pub(crate) fn named(&self, told: &Text) -> Text {
        if self.label == Text::default() {
            return told.clone();
        }
        let put = |told: &str, label: &str| {
            let name = self.name.as_str();
            // the name as a word of its own
            let ends = |at: usize| !told[at + name.len()..].starts_with(|c: char| c.is_alphanumeric() || c == '_');
            let found = told.match_indices(name).map(|(at, _)| at).find(|at| told[..*at].ends_with(' ') && ends(*at));
            found.map_or_else(|| told.to_owned(), |at| format!("{label}{}", &told[at + name.len()..]))
        };
        Text::new(put(&told.en, &self.label.en), put(&told.ru, &self.label.ru))
    }
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
    /// point, positive towards the line's direction turned by +90 degrees; in space there is a second one, along z of the line's frame.
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
        /// The frame that carries both axes; angles count from it. Without it they count from the line of centres.
        carrier: Option<FrameId>,
        /// How its forces go from wheel to wheel.
        strands: Strands,
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
        /// Restitution of a landing, where the wheel may leave the track: then it is held one-sidedly.
        leaves: Option<Expr>,
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
        /// What holds it; `None`: what the body stands on, at its mount the body of that point.
        on: Option<FrameId>,
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
        /// Restitution of the sliding speed of a friction that it presses.
        tangential: Expr,
        /// What the restitution is the ratio of.
        rebound: Rebound,
    },
    /// Dry friction. The force is positive when it resists positive sliding.
    Friction {
        /// What slides.
        slides: Slides,
        /// Kinetic magnitude over constants, time and `u`, the sliding speed's magnitude; a coefficient when `normal` is given.
        kinetic: Expr,
        /// Symbol of `u` in `kinetic`.
        speed: SymbolId,
        /// Static limit (or coefficient); `None`: the kinetic one at u = 0.
        fixed: Option<Expr>,
        /// What it is a share of.
        normal: Pressing,
    },
}

/// How two wheels pull at each other. With F the force of the connection and T₁, T₂ the tensions of the strands, T₁ − T₂ = F.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Strands {
    /// By teeth that meet: there is no other force.
    Teeth,
    /// T₁ + T₂ is not known.
    Open,
    /// (T₁ + T₂)/2, the tension of both strands when nothing is transmitted.
    Pretension(Expr),
    /// The slack strand carries nothing; whether F is positive.
    Slack {
        /// T₁ = F, T₂ = 0; else T₁ = 0, T₂ = −F.
        positive: bool,
    },
}

/// What the law of a friction multiplies.
#[derive(Clone, Copy, Debug)]
pub enum Pressing {
    /// Nothing: the law is a force.
    Given,
    /// A normal force, which may contain reactions linearly; its magnitude counts.
    Formula(Expr),
    /// The force of the named contact, pin or rope.
    Contact,
}

/// What a friction acts between. Other connections go by their index in the model.
#[derive(Clone, Debug)]
pub enum Slides {
    /// A pathway, whose rate is the sliding speed.
    Along(Pathway),
    /// A point of a body along a direction on another body: the force acts there on both.
    Point {
        /// The point.
        point: PointRef,
        /// The other body.
        on: FrameId,
        /// The direction.
        direction: Aim,
    },
    /// A body where it touches another: at a wheel's contact point, which may then slip, or at the point of a stop.
    Contact {
        /// A rolling contact or a stop.
        of: usize,
        /// The direction; `None`: along the track, or the normal turned by -90 degrees.
        direction: Option<Aim>,
        /// Distance of the contact from the point of a stop, towards the surface.
        radius: Option<Expr>,
    },
    /// A body that turns on another where they touch: the coefficient is the lever of the normal force.
    Rolls {
        /// A rolling contact or a stop.
        of: usize,
    },
    /// Two bodies that turn about a pin: the coefficient times the radius is the lever of the pin's force, of all its components.
    Journal {
        /// A pin or a support.
        of: usize,
        /// Radius of the journal.
        radius: Expr,
    },
    /// A rope over points of a drum or ring that does not turn: the tensions differ by the factor exp(coefficient · wrap).
    Belt {
        /// The rope.
        of: usize,
        /// First and last of its points that lie on the drum.
        over: [PointRef; 2],
        /// Angle of contact; `None`: that by which the rope turns there.
        wrap: Option<Expr>,
    },
}

/// A direction, of any length.
#[derive(Clone, Copy, Debug)]
pub struct Aim {
    /// Components.
    pub vector: [Expr; 3],
    /// Their axes.
    pub axes: FrameId,
}

/// A drum on which a rope winds: winding length = sense · radius · angle of the drum against its carrier.
#[derive(Clone, Copy, Debug)]
pub struct Wound {
    /// The drum.
    pub on: FrameId,
    /// Its radius.
    pub radius: Expr,
    /// What its angle counts from; `None`: what carries its axis.
    pub carrier: Option<FrameId>,
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
