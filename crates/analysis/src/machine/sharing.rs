//! Reactions that can share a load.

use std::collections::BTreeMap;

use program::{Construct, Mode, Program};
use symbolic::Equations;
use symbolic::connections::{Law, Normal};

/// What can share a load, known from the equations.
#[derive(Clone, Debug, Default)]
pub(super) struct Sharing {
    /// Guards of what is left to others, and of what it belongs to.
    pub(super) shares: Vec<[usize; 2]>,
    /// Guards by which several frictions go.
    pub(super) together: Vec<usize>,
    /// The guard that says on which side of zero the normal force of a friction is, by reaction.
    pub(super) sides: Vec<(usize, usize)>,
    /// By friction: whether its normal force is made of reactions alone.
    pub(super) whole: Vec<bool>,
    /// Whether formulas with switches move what supports act on: how many of them share may then change along the motion. Otherwise it is known from the start.
    pub(super) piecewise: bool,
    /// Outputs that have had no value so far, with the guards that shared the load.
    pub(super) seen: BTreeMap<usize, Vec<usize>>,
}

impl Sharing {
    pub(super) fn new(equations: &Equations, program: &Program) -> Sharing {
        let mut sharing = Sharing { piecewise: crate::connections::is_piecewise(equations), ..Sharing::default() };
        for (i, guard) in program.guards.iter().enumerate() {
            match guard.kind {
                Construct::Share { of, .. } => sharing.shares.push([i, of]),
                Construct::Normal { reaction } => sharing.sides.push((reaction, i)),
                _ => {}
            }
        }
        let mut before = Vec::new();
        for (reaction, guard) in equations.reactions.iter().zip(&program.switches) {
            let Law::Friction(friction) = &reaction.law else { continue };
            let free = |normal: &Normal| equations.graph.is_zero(normal.constant);
            sharing.whole.push(friction.components().all(free));
            let Some(guard) = guard else { continue };
            if before.contains(guard) {
                sharing.together.push(*guard);
            }
            before.push(*guard);
        }
        sharing
    }

    /// Whether something is shared in these modes.
    pub(super) fn may_share(&self, modes: &[Mode]) -> bool {
        let idle = |[share, of]: &[usize; 2]| modes[*share] != Mode::Positive && modes[*of] == Mode::Zero;
        self.piecewise || self.shares.iter().any(idle) || self.together.iter().any(|guard| modes[*guard] == Mode::Zero)
    }
}
