//! What a system tells of itself: what switches it, what acts in it and at what power, what a blow does.

use program::{Lanes, Mode};
use symbolic::connections::Impacts;
use words::Text;

/// A formula whose sign switches the equations.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Guard {
    /// What is switched, for messages: `sign(v)`.
    pub name: Text,
    /// What role it plays.
    pub kind: GuardKind,
    /// A contact that is a rope: only the words about it differ.
    pub tie: bool,
    /// Instant at which a guard that is affine in time vanishes; such an instant is hit exactly instead of being searched.
    pub scheduled: Option<f64>,
}

/// The role of a guard.
#[derive(Clone, Debug, PartialEq, Default)]
pub enum GuardKind {
    /// Switches formulas. All three modes are ordinary.
    #[default]
    Switch,
    /// Sliding speed of a dry friction. `Zero`: it sticks, a condition on the motion holds the speed at zero, and both `limits` (bounds:
    /// static limit minus and plus the friction force) must not be negative. When one is crossed, or is negative when modes are decided,
    /// the contact slides in the direction of that bound's `exit`.
    Friction {
        /// Guards of kind `Bound`.
        limits: [usize; 2],
        /// Contacts that alone press it: while all are open there is no friction, and its mode means nothing. Empty where something else presses.
        pressed: Vec<usize>,
    },
    /// Gap of a one-sided contact. `Positive`: open. `Zero`: closed, a condition holds the gap, and `force` must not be negative; when it
    /// falls below zero the contact opens. Never `Negative`: when the gap closes with a rate, [`crate::System::impact`] gives the rates after it.
    Contact {
        /// Guard of kind `Bound`: the contact force.
        force: usize,
    },
    /// Sign of a normal force that follows from the reactions. It jumps where modes change.
    Normal {
        /// The guard of its friction.
        of: usize,
        /// One reaction in one direction, whose other sign is another force. That of a resultant (a journal) or of what a rope presses with is a way of writing.
        single: bool,
    },
    /// Whether contact or friction `of` carries its own condition (`Positive`), or others that hold the same motion carry it (`Zero`).
    Share {
        /// The guard it belongs to.
        of: usize,
    },
    /// What a friction whose condition others carry takes of its static limit: -1, 0 or 1. Without meaning otherwise.
    Side {
        /// The guard it belongs to.
        of: usize,
    },
    /// Counts only while guard `of` is `Zero`; it must be positive. Its own mode is then `Positive`, otherwise without meaning.
    Bound {
        /// The guard it belongs to.
        of: usize,
        /// The mode that guard takes when the bound is crossed.
        exit: Mode,
    },
}

/// Powers at a state, W.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Powers {
    /// dE/dt by differentiation of the energy, linear in q''.
    pub rate: f64,
    /// Power of applied loads without potential.
    pub loads: f64,
    /// Power of the drives that realise prescribed motions.
    pub drives: f64,
    /// Power taken by dissipative elements.
    pub dissipated: f64,
    /// Σ of the powers of all loads by size, before they cancel; 0 when unknown.
    pub through: f64,
}

/// What passes into and out of a machine at a state, W: dE/dt = loads + drives - dissipated.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Supply {
    /// Power of applied loads without potential.
    pub loads: f64,
    /// Power of the drives that realise prescribed motions.
    pub drives: f64,
    /// Power taken by dissipative elements.
    pub dissipated: f64,
}

/// States and their rates at several places of a motion, at most [`crate::system::ABREAST`].
#[derive(Clone, Debug, Default)]
pub struct Motions {
    /// How many places there are; what stands behind them has no meaning.
    pub count: usize,
    /// Time, s.
    pub times: Lanes,
    /// By state.
    pub x: Vec<Lanes>,
    /// Derivatives of the states by time.
    pub rates: Vec<Lanes>,
}

/// What an impact did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Blow {
    /// Rates of contacts and frictions that took part, before and after, by guard. What is held, or has reached what its law asks for, has that rate exactly.
    pub rates: Vec<(usize, [f64; 2])>,
    /// Contacts and frictions that took an impulse, by guard.
    pub impulses: Vec<(usize, f64)>,
    /// Frictions whose sliding it stopped, by guard.
    pub stuck: Vec<usize>,
    /// Whether phases were followed (Poisson's restitution): a sliding may turn within the impact, and the whole impulse then has either direction.
    pub phased: bool,
    /// Contacts and frictions to which nothing happened but rounding of the rates and impulses of the instant, by guard.
    pub silent: Vec<usize>,
    /// Impulses of all reactions, those of supports included; [`crate::System::impulses`] names them. Empty where there are none.
    pub reactions: Vec<f64>,
    /// Which contacts strike at once.
    pub law: Impacts,
    /// The first blows of the instant one by one, where there were several.
    pub blows: Vec<SingleBlow>,
    /// What contacts and frictions did, all blows together; none where nothing struck.
    pub work: Option<BlowWork>,
}

/// Corners of the admissible reactions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Corners {
    /// Those to be tried first before the others.
    pub list: Vec<Corner>,
    /// Whether all limits are linear in the reactions. Those of journals are taken beside one direction of their forces.
    pub exact: bool,
}

/// A distribution of reactions at a corner of those that are admissible.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Corner {
    /// Modes of shares and sides: what is left to others, and at which limit it stands.
    pub idle: Vec<(usize, Mode)>,
    /// All frictions at their limits, by guard, with the way in which they would slide.
    pub limits: Vec<(usize, Mode)>,
}

/// Closed contacts at a switch of their gap, by guard.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bends {
    /// Those whose gap jumps open, or has a positive rate behind the switch: the surface falls away.
    pub opens: Vec<usize>,
    /// Those whose gap has a negative rate behind it: the surface rises and strikes.
    pub strikes: Vec<usize>,
}

/// Work of the impulses of contacts and frictions in the blows of an instant, relative to the surfaces that meet, J.
///
/// ```text
/// W = Σ ± Λ (u₋ + u₊)/2          + for contacts, - for frictions, whose Λ resists; over all blows, each with its own rates
/// ```
///
/// The kinetic energies before and after have the same difference, and where a light body strikes a heavy one they cancel to the last digit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BlowWork {
    /// W: negative where energy is lost.
    pub done: f64,
    /// Σ |Λ| (|u₋| + |u₊|)/2, what has met in it.
    pub met: f64,
    /// Rounding of `done`, by the terms that meet in the rates u.
    pub rounding: f64,
}

/// One of several blows of an instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SingleBlow {
    /// Rates q' after it.
    pub rates: Vec<f64>,
    /// Its impulses of all reactions.
    pub reactions: Vec<f64>,
}

/// Which law a [`Touch`] obeys.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TouchLaw {
    /// One-sided: gap and force.
    Contact {
        /// Gap, and the size of the terms that meet in it.
        gap: [f64; 2],
    },
    /// Dry friction.
    Friction {
        /// Largest magnitudes sliding back, sliding forth, at rest; they are those of impulses in an impact.
        limits: [f64; 3],
        /// Sliding speed by that of the first friction with the same guard.
        ratio: f64,
    },
}

/// A contact or a dry friction at a state, with what its law compares.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Its guard.
    pub guard: usize,
    /// Its law.
    pub law: TouchLaw,
    /// Force, not negative of a contact; that of a friction resists positive sliding. Not a number where it is not unique.
    pub force: f64,
    /// Rate of the gap or sliding speed, and the size of the terms that meet in it.
    pub rate: [f64; 2],
    /// The same for its derivative.
    pub acceleration: [f64; 2],
    /// Coefficient of restitution; of a friction the tangential one.
    pub restitution: f64,
}

/// What rounding can make of what vanishes at a contact or friction: that much of either sign is nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tie {
    /// Rate of the gap, or sliding speed, m/s or rad/s.
    pub rate: f64,
    /// Its acceleration, m/s² or rad/s².
    pub acceleration: f64,
    /// Force, N or N m.
    pub force: f64,
}

/// Whether a system has given its Jacobian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Jacobian {
    /// It is in the table handed over.
    Given,
    /// The system has no derivatives.
    Absent,
}

/// Numbers of bodies: 19 for each body (mass, centre, rotation by rows, moments xx, yy, zz, xy, yz, xz about the centre in body axes), then for each released
/// frame its origin, the force and moment on it (about the origin of the ground), and its ways (shift, turn), then for each body what acts on it by itself (force, moment
/// about the origin of the ground, the same sums of components without signs), then for each coordinate the loads given along it and their sum without signs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layout {
    /// Number of bodies.
    pub bodies: usize,
    /// Bodies on each frame, and its number of ways.
    pub frames: Vec<(Vec<usize>, usize)>,
    /// Number of bodies whose own loads are listed.
    pub wrenches: usize,
    /// Number of coordinates along which loads are listed.
    pub along: usize,
    /// Reactions that follow from balances in which contacts or frictions stand too, by name.
    pub leaning: Vec<String>,
}

impl Layout {
    /// Numbers of a body.
    pub const BODY: usize = 19;
}

/// A state from which conditions on rates count what they keep.
#[derive(Clone, Copy, Debug)]
pub struct Since<'a> {
    /// Its time, s.
    pub t: f64,
    /// Its states.
    pub x: &'a [f64],
    /// Guards of the contacts that have been closed, and of the frictions that have been sticking, ever since: what rolls on them has not slipped.
    pub closed: &'a [usize],
}
