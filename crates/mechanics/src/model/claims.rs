//! Published results that are laid against the machine.

use std::ops::Range;
use symbolic::{Expr, SymbolId};
use words::Text;

/// A published result.
#[derive(Clone, Debug)]
pub struct ClaimDecl {
    /// Name.
    pub name: Text,
    /// Where it is published; may be empty.
    pub source: Text,
    /// What is claimed.
    pub kind: ClaimKind,
    /// Largest relative deviation with which it holds.
    pub tolerance: f64,
    /// Whether the file states the tolerance; half a written digit is counted on the published value, a stated one on the value found.
    pub stated: bool,
    /// SI unit label of what is compared.
    pub unit: String,
    /// What is wrong with its dimensions; empty when nothing is.
    pub dimensions: Text,
    /// Place in the file.
    pub span: Range<usize>,
}

/// What is claimed.
#[derive(Clone, Debug)]
pub enum ClaimKind {
    /// An equation that every motion satisfies: left = right.
    Equation {
        /// Left side.
        left: Expr,
        /// Right side.
        right: Expr,
    },
    /// A formula of a quantity, at every state.
    Formula {
        /// The quantity as strutt finds it.
        of: Expr,
        /// What is published.
        formula: Expr,
    },
    /// A value of a quantity.
    Value {
        /// The quantity as strutt finds it.
        of: Expr,
        /// What is published, SI.
        published: f64,
        /// When.
        at: ClaimInstant,
    },
    /// The frequency equation left = right.
    FrequencyEquation {
        /// Left side.
        left: Expr,
        /// Right side.
        right: Expr,
        /// The circular frequency.
        frequency: SymbolId,
        /// The unknown, where the equation has another than the frequency, and what it is.
        unknown: Option<(SymbolId, Expr)>,
    },
    /// A natural frequency, rad/s.
    Frequency {
        /// Number of the mode, from 1.
        mode: usize,
        /// What is published, rad/s.
        published: f64,
    },
}

/// When a value is claimed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ClaimInstant {
    /// At this time of the motion, s; 0 is the start.
    At(f64),
    /// In equilibrium.
    Rest,
}
