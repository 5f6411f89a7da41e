//! What connections add to the equations.

use crate::connections::{Doubt, Pull};
use crate::model::FrameId;
use crate::scene::Columns;
use crate::scene::wrench::Act;
use std::collections::BTreeSet;
use std::ops::Range;
use symbolic::Expr;
use symbolic::connections::{Balance, Condition, Reaction, Released};

/// What connections add to the equations.
#[derive(Debug, Default)]
pub struct Connected {
    /// As in the equations.
    pub reactions: Vec<Reaction>,
    /// As in the equations.
    pub conditions: Vec<Condition>,
    /// As in the equations.
    pub balances: Vec<Balance>,
    /// As in the equations.
    pub free: Released,
    /// Work of each force and torque in the balances, as in `Loads::named`.
    pub applied: Vec<Vec<(usize, Expr)>>,
    /// Newton-Euler: generalized force of each reaction per unit, per direction.
    pub geometric: Vec<Columns<Expr>>,
    /// Actions of each reaction per unit.
    pub(super) acts: Vec<Vec<Act>>,
    pub(super) released: BTreeSet<FrameId>,
    pub(super) taken: BTreeSet<String>,
    /// With the conditions of the connection that has them.
    pub(super) doubts: Vec<(Doubt, Range<usize>)>,
    /// What belts and chains do by the unknown sum of their tensions, with the connection.
    pub(super) pulls: Vec<(usize, Pull)>,
}
