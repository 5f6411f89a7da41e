//! The modes in which the tapes of a machine are evaluated.

use program::Bound;

use crate::Mode;

/// Modes as the program has them.
#[derive(Clone, Debug, Default)]
pub(super) struct Switches {
    pub(super) modes: Vec<Mode>,
    /// Guards that decide something in these modes; others have no meaning.
    pub(super) active: Vec<bool>,
    known: bool,
}

impl Switches {
    /// Takes these modes.
    pub(super) fn set(&mut self, modes: &[Mode], bound: &Bound) {
        let same = self.known && self.modes == modes;
        if !same {
            self.modes.clear();
            self.modes.extend(modes);
            self.active = bound.active(&self.modes);
            self.known = true;
        }
    }
}
