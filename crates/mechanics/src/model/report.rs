//! What the file says about its written calculation.

use words::Text;

/// `[report]`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// The title page; none where the file gives nothing of it.
    pub front: Option<Front>,
    /// Chapters that are written, by the names of [`crate::fields::PARTS`]; all where the file does not choose.
    pub parts: Option<Vec<String>>,
    /// How deep.
    pub depth: Depth,
}

/// How much of the derivation is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Depth {
    /// Everything.
    #[default]
    Full,
    /// Without the derivatives on the way and without appendices.
    Short,
}

/// What stands on the title page; empty texts where the file gives nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Front {
    /// University or firm.
    pub organisation: Text,
    /// Department.
    pub department: Text,
    /// What the work is.
    pub kind: Text,
    /// Discipline.
    pub discipline: Text,
    /// Who made it.
    pub student: Text,
    /// Group.
    pub group: Text,
    /// Who checks it.
    pub teacher: Text,
    /// City.
    pub city: Text,
    /// Year.
    pub year: String,
}
