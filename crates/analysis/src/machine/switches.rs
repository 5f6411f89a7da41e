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
    /// Those before them: checks look at the same instant in the modes on its two sides by turns.
    before: (Vec<Mode>, Vec<bool>),
}

impl Switches {
    /// Takes these modes.
    pub(super) fn set(&mut self, modes: &[Mode], bound: &Bound) {
        if self.known && self.modes == modes {
            return;
        }
        std::mem::swap(&mut self.modes, &mut self.before.0);
        std::mem::swap(&mut self.active, &mut self.before.1);
        if !self.known || self.modes != modes {
            self.modes.clear();
            self.modes.extend(modes);
            self.active = bound.active(&self.modes);
        }
        self.known = true;
    }
}
