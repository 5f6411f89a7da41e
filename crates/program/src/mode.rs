//! The sides of a guard.

/// Sign of a guard function.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub enum Mode {
    /// Below zero.
    Negative,
    /// Zero for a while: sign and abs are 0, `>=` holds, `>` does not.
    Zero,
    /// Above zero.
    #[default]
    Positive,
}

impl Mode {
    /// The mode of a value; not-a-number counts as positive.
    pub fn of(value: f64) -> Mode {
        if value < 0.0 {
            Mode::Negative
        } else if value == 0.0 {
            Mode::Zero
        } else {
            Mode::Positive
        }
    }
    /// -1, 0, 1.
    pub fn sign(self) -> f64 {
        match self {
            Mode::Negative => -1.0,
            Mode::Zero => 0.0,
            Mode::Positive => 1.0,
        }
    }
    /// Position among the sides of a choice.
    pub fn side(self) -> usize {
        self as usize
    }
}
