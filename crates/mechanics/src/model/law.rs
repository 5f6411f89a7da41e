//! What an element is: its data, and what they mean to a derivation. A derivation is met through [`Stage`] alone: an element says what energy it stores, what
//! power it loses and which forces it puts on bodies, and does not know what is done with that.

use super::pathway::Pathway;
use crate::requests::{FrameId, PointRef};
use std::fmt::Debug;
use std::ops::Range;
use std::sync::Arc;
use symbolic::{Expr, Graph};
use words::{Notice, Text};

/// A result, or a finding about the model.
pub type Found<T> = Result<T, Box<Notice>>;

/// Something that acts by a law: a spring, a damper, a load.
#[derive(Clone, Debug)]
pub struct Element {
    /// Name.
    pub name: String,
    /// Table it stands in: `springs`.
    pub table: &'static str,
    /// Place of its table among those of all elements, in which they act.
    pub rank: usize,
    /// Table and name of what it is in the file, or is a part of: `forces.f`, `distributed.q`.
    pub path: String,
    /// What it is, in words; empty where the file does not say.
    pub label: Text,
    /// What it does.
    pub law: Arc<dyn Law>,
    /// Place in the file (its name).
    pub span: Range<usize>,
}

/// The data of an element with what they mean.
pub trait Law: Debug + Send + Sync {
    /// Acts on the machine: energy or virtual power for Lagrange, forces on bodies for Newton and Euler. Gives the values that its functions tell, in SI units.
    ///
    /// # Errors
    /// A pathway that is not defined (M102), a function that is not available (M103).
    fn act(&self, stage: &mut dyn Stage) -> Found<Vec<Expr>>;

    /// Where it acts and what its letter is, for drawings.
    fn sketch(&self) -> Sketch;

    /// What must be a straight line over places and rates so that small motions lose nothing of it.
    fn straight(&self) -> Straight;

    /// Components of forces and moments that move bodies out of the plane unless they vanish.
    fn leaves_plane(&self) -> Vec<Expr> {
        Vec::new()
    }

    /// The law with other formulas of time in its load; none for what is no load.
    fn over(&self, _change: &mut dyn FnMut(Expr) -> Expr) -> Option<Arc<dyn Law>> {
        None
    }

    /// Whether it makes of a frame a machine; loads and energies of frames do not.
    fn couples(&self) -> bool {
        true
    }
}

/// What a drawing shows of an element.
#[derive(Clone, Copy, Debug)]
pub struct Sketch {
    /// Where it acts.
    pub site: Site,
    /// The formula whose letter stands beside it: a stiffness, a force.
    pub letter: Expr,
    /// Play in which it does nothing.
    pub play: Option<Expr>,
}

/// Where an element acts.
#[derive(Clone, Copy, Debug)]
pub enum Site {
    /// Along a pathway.
    On(Pathway),
    /// A vector at a point.
    At {
        /// The point.
        at: PointRef,
        /// Components.
        value: [Expr; 3],
        /// Their axes.
        axes: FrameId,
    },
    /// A moment on a body.
    Turns {
        /// The body.
        on: FrameId,
        /// Components.
        value: [Expr; 3],
        /// Their axes.
        axes: FrameId,
        /// The body that takes the opposite moment.
        reaction: Option<FrameId>,
    },
    /// By a potential energy over places.
    Energy,
    /// By a dissipation function over rates.
    Dissipation,
}

impl Sketch {
    /// Without play.
    pub fn new(site: Site, letter: Expr) -> Sketch {
        Sketch { site, letter, play: None }
    }
}

/// Formulas that bend what is linear otherwise.
#[derive(Clone, Debug)]
pub struct Straight {
    /// Whether it switches by itself.
    pub switches: bool,
    /// The formulas.
    pub formulas: Vec<Expr>,
    /// Degree in places and rates up to which they are straight: 0 for a factor, 1 for a force, 2 for an energy.
    pub degree: usize,
}

/// A pathway in a derivation.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    /// Its value.
    pub value: Expr,
    /// Number in the derivation.
    pub number: usize,
}

/// A force along a pathway; positive increases it.
#[derive(Clone, Copy, Debug)]
pub struct Push {
    /// The pathway.
    pub way: Way,
    /// The force, or the moment on an angle.
    pub force: Expr,
}

/// A derivation as an element sees it.
pub trait Stage {
    /// Owner of all expressions.
    fn graph(&mut self) -> &mut Graph;
    /// A formula of the file over coordinates, rates, constants and formulas of time.
    ///
    /// # Errors
    /// It asks for what is not known yet (M103).
    fn open(&mut self, e: Expr) -> Found<Expr>;
    /// A pathway.
    ///
    /// # Errors
    /// Two bodies without an angle between them (M102), or as [`Stage::open`].
    fn way(&mut self, pathway: Pathway) -> Found<Way>;
    /// The rate of a pathway, by differentiation of its value and from velocities of points and bodies.
    fn rates(&mut self, way: Way) -> [Expr; 2];
    /// d/dt of a value of places and time.
    fn rate_of(&mut self, e: Expr) -> Expr;
    /// A value of places at the start of the motion.
    fn at_start(&mut self, e: Expr) -> Expr;
    /// Components of a vector in the axes of the ground.
    fn in_ground_axes(&mut self, axes: FrameId, v: [Expr; 3]) -> [Expr; 3];

    /// Stores an energy; a force along its pathway takes it out again.
    fn store(&mut self, energy: Expr, force: Push);
    /// Loses power by a dissipation function (half of it), with a force along its pathway.
    fn dissipate(&mut self, function: Expr, force: Push);
    /// Applies a force along a pathway.
    fn push(&mut self, force: Push);
    /// Applies a force at a point, ground axes.
    fn pull(&mut self, at: PointRef, force: [Expr; 3]);
    /// Applies a moment to a body, ground axes.
    fn turn(&mut self, on: FrameId, moment: [Expr; 3]);
    /// Stores an energy by a formula of the file: points and bodies that it names take its forces.
    ///
    /// # Errors
    /// As [`Stage::open`].
    fn store_by_places(&mut self, energy: Expr) -> Found<()>;
    /// The same of a dissipation function.
    ///
    /// # Errors
    /// As [`Stage::open`].
    fn dissipate_by_rates(&mut self, function: Expr) -> Found<()>;
}

impl dyn Stage + '_ {
    /// Opens every component.
    ///
    /// # Errors
    /// As [`Stage::open`].
    pub fn open_vector(&mut self, v: [Expr; 3]) -> Found<[Expr; 3]> {
        let [x, y, z] = v.map(|e| self.open(e));
        Ok([x?, y?, z?])
    }
}
