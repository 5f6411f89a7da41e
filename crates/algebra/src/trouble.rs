//! What can be wrong with the matrices of a linear problem. A [`Pivot`] keeps the row, so that a caller who knows what the rows mean can
//! name the node and the free motion. The words for users stand where studies are.

use std::fmt;

/// What the elimination met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Defect {
    /// The pivot vanishes within rounding: a direction without stiffness.
    Singular,
    /// The pivot is negative: a direction of negative stiffness.
    Negative,
}

/// A symmetric matrix is not positive definite: the first pivot that says so.
#[derive(Clone, Debug, PartialEq)]
pub struct Pivot {
    /// Row of the matrix whose pivot it is.
    pub row: usize,
    /// What is wrong.
    pub defect: Defect,
    /// The motion without (or of negative) stiffness, largest entry 1 in units that give every coordinate the same stiffness.
    pub motion: Vec<f64>,
}

impl Pivot {
    /// The row that moves most in the free motion.
    pub fn most(&self) -> usize {
        let largest = |best: usize, i: usize| if self.motion[i].abs() > self.motion[best].abs() { i } else { best };
        (0..self.motion.len()).fold(self.row, largest)
    }
}

/// Why a linear problem has no solution.
#[derive(Clone, Debug, PartialEq)]
pub enum Trouble {
    /// A stiffness matrix is not positive definite.
    Pivot(Pivot),
    /// The mass matrix is not positive definite; the first row without inertia of its own.
    Massless(usize),
    /// An entry is infinite or undefined, or the matrix has the wrong size: its name.
    Malformed(&'static str),
    /// The iteration for eigenvalues did not end.
    Unconverged {
        /// Eigenvalues that converged.
        found: usize,
        /// Eigenvalues that were asked for.
        wanted: usize,
    },
    /// Not enough memory for a factor.
    Memory,
}

impl From<Pivot> for Trouble {
    fn from(pivot: Pivot) -> Trouble {
        Trouble::Pivot(pivot)
    }
}

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Trouble::Pivot(pivot) => write!(f, "not positive definite at row {}", pivot.row),
            Trouble::Massless(row) => write!(f, "mass matrix not positive definite at row {row}"),
            Trouble::Malformed(name) => write!(f, "{name}: an entry that is no number, or a wrong size"),
            Trouble::Unconverged { found, wanted } => write!(f, "{found} of {wanted} eigenvalues converged"),
            Trouble::Memory => write!(f, "the factor does not fit into memory"),
        }
    }
}

impl std::error::Error for Trouble {}
