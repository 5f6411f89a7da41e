//! What the equations of connections are made of: the guards of a reaction, a friction with two components.

use super::forms::Value;
use symbolic::connections::Friction;

/// Numbers of the guards of one reaction. Frictions that slide together have one leader, whose limits they share.
#[derive(Clone, Copy, Debug)]
pub(super) enum Numbers {
    Sliding {
        leader: usize,
        sliding: u32,
        limits: [u32; 2],
        normal: Option<u32>,
        shares: Option<[u32; 2]>,
    },
    Gap {
        gap: u32,
        force: u32,
        share: Option<u32>,
    },
    /// The gap is that of the contact that it follows.
    Rough {
        gap: u32,
        share: Option<u32>,
    },
}

impl Numbers {
    /// The guard that selects the equation.
    pub(super) fn switch(self) -> usize {
        match self {
            Numbers::Sliding { sliding, .. } => sliding as usize,
            Numbers::Gap { gap, .. } | Numbers::Rough { gap, .. } => gap as usize,
        }
    }
}

/// A friction with two components.
pub(super) struct Journal<'e> {
    /// Its row in the system.
    pub row: usize,
    pub law: &'e Friction,
    /// Guard of the sliding speed, and that of its own.
    pub sliding: u32,
    pub unique: u32,
    /// Guard that leaves it to others while it sticks.
    pub share: Option<u32>,
    /// c: negative in the mode `Negative`, zero while it sticks and in the mode `Negative` of `unique`; ± its static coefficient where it is left to others at its limit.
    pub coefficient: Value,
}
