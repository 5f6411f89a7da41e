//! Connections in the hand-over: unknown reactions, conditions on the motion, balances of released bodies.
//!
//! With coordinates q (n of them) and reactions λ:
//!
//! ```text
//! M q'' = h + Σ_k forces_k λ_k            equations of motion; forces_k is sparse, by coordinate
//! J_c q'' + remainder_c = 0               one for each condition, from d/dt of `rate`, which itself is d/dt of `place`
//! m_b q'' = rest_b + Σ_k released_k λ_k   balances: what a released body needs in a direction in which it cannot move
//! ```
//!
//! The unknowns other than supports are as many as the conditions. A condition owned by a contact or a friction has an alternative:
//!
//! | law | mode of its guard | equation in place of the condition |
//! |---|---|---|
//! | `Contact` | open (gap > 0) | λ = 0 |
//! | `Contact` | closed (gap = 0) | the condition; λ >= 0 must hold |
//! | `Rough` | its contact is open | λ = 0 |
//! | `Friction` | slides with sign s of `sliding` | λ = s · kinetic, with |N| as a factor where the normal force is a reaction |
//! | `Friction` | sticks | the condition (sliding = 0); |λ| <= static limit must hold |

use crate::{Expr, SymbolId};
use words::Text;

/// An unknown scalar force or moment.
#[derive(Clone, Debug)]
pub struct Reaction {
    /// Its symbol λ in outputs and in the second derivation.
    pub symbol: SymbolId,
    /// As users write it: `force(AB)`, `force_x(O)`.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// What it is: "pin O, along x".
    pub label: Text,
    /// Generalized force on each coordinate per unit of the reaction, by differentiation of the condition.
    pub forces: Vec<(usize, Expr)>,
    /// Force in each balance per unit of the reaction.
    pub released: Vec<(usize, Expr)>,
    /// What decides it.
    pub law: Law,
}

/// What decides a reaction.
#[derive(Clone, Debug)]
pub enum Law {
    /// A condition that always holds.
    Ideal {
        /// Index in `Equations::conditions`.
        condition: usize,
    },
    /// The condition holds by the choice of the coordinates; the reaction follows from balances alone.
    Support,
    /// An unknown drive that realises prescribed motions; it owns no condition.
    Motor,
    /// No reaction: a wrench that a load given by a formula of coordinates may have besides its generalized forces, as its place is not given.
    /// It does no work on the coordinates and enters balances only; `name` is that of the load.
    Place,
    /// No reaction either: a wrench by which a coordinate may move several bodies at once where no connection declares it; `name` is that of the
    /// coordinate, the label lists the bodies.
    Transmission,
    /// No reaction either: the sum of the tensions of a belt or chain, which follows from no law; `name` is that of its table and its own, the forces are those on
    /// coordinates that could change the distance of the axles.
    Tension,
    /// One-sided: the force is not negative, and vanishes while the gap is open.
    Contact {
        /// Index in `Equations::conditions`.
        condition: usize,
        /// Gap, at least 0; its rate is that of the condition.
        gap: Expr,
        /// Ratio of the rate after an impact to that before, 0 ... 1.
        restitution: Expr,
        /// The same for the sliding speed of a friction that it presses, where the friction can hold it.
        tangential: Expr,
        /// A rope, which pulls, and not a surface, which pushes: only the words about it differ.
        tie: bool,
        /// What the restitution is the ratio of.
        rebound: Rebound,
    },
    /// Dry friction: λ acts against positive sliding.
    Friction(Box<Friction>),
    /// No slip while a contact is closed, whatever it takes; nothing while it is open.
    Rough {
        /// Index in `Equations::conditions`.
        condition: usize,
        /// The reaction of the contact.
        contact: usize,
    },
}

/// Laws of restitution.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rebound {
    /// Of rates: that of the gap after the impact to that before.
    #[default]
    Newton,
    /// Of impulses: that of the time in which the gap opens again to that in which it closes.
    Poisson,
}

/// Which contacts strike when several touch at the instant of an impact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Impacts {
    /// One after another, the fastest first.
    #[default]
    InSequence,
    /// All at once.
    Together,
}

/// Dry friction in one direction. λ > 0 resists sliding in the positive direction: its generalized force is -λ ∂sliding/∂q'.
#[derive(Clone, Debug)]
pub struct Friction {
    /// Index in `Equations::conditions`; the condition says that the sliding speed does not change.
    pub condition: usize,
    /// Sliding speed v.
    pub sliding: Expr,
    /// Magnitude while v < 0 and while v > 0, not negative; a coefficient of |N| where `normal` is given.
    pub kinetic: [Expr; 2],
    /// Largest magnitude while sticking; a coefficient of |N| where `normal` is given.
    pub fixed: Expr,
    /// Normal force where it depends on reactions.
    pub normal: Option<Normal>,
    /// A second component at right angles to it, as of the force of a pin: |N| is then the root of the sum of squares.
    pub across: Option<Normal>,
}

impl Friction {
    /// The components of the normal force.
    pub fn components(&self) -> impl Iterator<Item = &Normal> {
        self.normal.iter().chain(&self.across)
    }
}

/// N = constant + Σ factor λ_k.
#[derive(Clone, Debug)]
pub struct Normal {
    /// Part free of reactions.
    pub constant: Expr,
    /// (index of a reaction, its factor).
    pub terms: Vec<(usize, Expr)>,
}

/// A scalar condition on the motion.
#[derive(Clone, Debug)]
pub struct Condition {
    /// What it is: "rod AB: length".
    pub name: Text,
    /// Vanishes at all times, over q, t; none for a condition on rates only.
    pub place: Option<Expr>,
    /// Vanishes at all times: Σ J_j q'_j + explicit change in time.
    pub rate: Expr,
    /// J: ∂rate/∂q'_j, nonzero entries only.
    pub columns: Vec<(usize, Expr)>,
    /// d(rate)/dt without the terms with q''.
    pub remainder: Expr,
    /// The reaction that owns it; none for a prescribed motion, which motors realise.
    pub reaction: Option<usize>,
}

/// Newton-Euler balance of a released body (and all that stands on it) in one direction of its displacement:
/// Σ columns_j q''_j = rest + Σ released λ.
#[derive(Clone, Debug)]
pub struct Balance {
    /// "crank, along x".
    pub name: Text,
    /// Inertia coefficients of q''.
    pub columns: Vec<(usize, Expr)>,
    /// Applied forces less inertia terms without q''.
    pub rest: Expr,
    /// Momentum at rates of zero, of prescribed motions; none without.
    pub carried: Option<Expr>,
}

/// Bodies as placements and resultants, from which audits make their balances anew by differentiation in numbers.
#[derive(Clone, Debug, Default)]
pub struct Released {
    /// All bodies, and frames without inertia on which something acts.
    pub bodies: Vec<FreeBody>,
    /// What was released.
    pub frames: Vec<FreeFrame>,
    /// What acts on each body by itself.
    pub wrenches: Vec<Wrench>,
    /// Loads by formulas, in the direction of each coordinate: the sum, and the sum of the terms without their signs.
    pub along: Vec<[Expr; 2]>,
}

/// All loads and reactions on a body.
#[derive(Clone, Debug)]
pub struct Wrench {
    /// Sum of the forces over q, q', q'', t and reactions.
    pub force: [Expr; 3],
    /// Sum of the moments about the origin of the ground.
    pub moment: [Expr; 3],
    /// The same sums of the components without their signs.
    pub sizes: [[Expr; 3]; 2],
}

/// A rigid body, ground axes.
#[derive(Clone, Debug)]
pub struct FreeBody {
    /// Mass, 0 of a frame without.
    pub mass: Expr,
    /// Place of the centre, of a frame without mass that of its origin.
    pub center: [Expr; 3],
    /// Ground components from body components.
    pub rotation: [[Expr; 3]; 3],
    /// Distinct components (k, l, I_kl) of the tensor about the centre, body axes.
    pub inertia: Vec<(usize, usize, Expr)>,
}

/// A released frame with all that stands on it.
#[derive(Clone, Debug)]
pub struct FreeFrame {
    /// Its name.
    pub name: Text,
    /// The bodies on it, by index.
    pub bodies: Vec<usize>,
    /// Place of its origin.
    pub origin: [Expr; 3],
    /// Sum of all loads and reactions over q, q', q'', t and reactions.
    pub force: [Expr; 3],
    /// Their moment about the origin of the ground.
    pub moment: [Expr; 3],
    /// Displacements in which they balance inertia: shift of the frame's origin, turn.
    pub ways: Vec<[[Expr; 3]; 2]>,
}

impl Released {
    /// Everything in it, in this order: bodies (mass, centre, rotation by rows, six components xx, yy, zz, xy, yz, xz), then frames
    /// (origin, force, moment, ways), wrenches (force, moment, sizes), loads along coordinates.
    pub fn expressions(&self, zero: Expr) -> Vec<Expr> {
        let mut list = Vec::new();
        for body in &self.bodies {
            list.push(body.mass);
            list.extend(body.center);
            list.extend(body.rotation.iter().flatten());
            let component = |k: usize, l: usize| body.inertia.iter().find(|(a, b, _)| (*a, *b) == (k, l)).map_or(zero, |c| c.2);
            list.extend([(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)].map(|(k, l)| component(k, l)));
        }
        for frame in &self.frames {
            list.extend([frame.origin, frame.force, frame.moment].iter().flatten());
            list.extend(frame.ways.iter().flatten().flatten());
        }
        for wrench in &self.wrenches {
            list.extend([wrench.force, wrench.moment].iter().flatten());
            list.extend(wrench.sizes.iter().flatten());
        }
        list.extend(self.along.iter().flatten());
        list
    }
}

impl Law {
    /// Whether it takes a degree of freedom: an ideal condition, or a rope, which is counted taut.
    pub fn holds(&self) -> bool {
        matches!(self, Law::Ideal { .. } | Law::Contact { tie: true, .. })
    }

    /// Whether it is a force of the machine and not an unknown of the balances alone.
    pub fn is_reaction(&self) -> bool {
        !matches!(self, Law::Place | Law::Transmission | Law::Tension)
    }

    /// Whether it is an unknown of the balances of released bodies alone.
    pub fn is_hidden(&self) -> bool {
        matches!(self, Law::Support | Law::Place | Law::Transmission | Law::Tension)
    }

    /// The condition that the reaction owns.
    pub fn condition(&self) -> Option<usize> {
        match self {
            Law::Ideal { condition } | Law::Contact { condition, .. } | Law::Rough { condition, .. } => Some(*condition),
            Law::Friction(friction) => Some(friction.condition),
            Law::Support | Law::Motor | Law::Place | Law::Transmission | Law::Tension => None,
        }
    }
}
