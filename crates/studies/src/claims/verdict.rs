//! What was found of a published result.

use words::Text;

/// What came of a claim.
#[derive(Clone, Debug, Default)]
pub struct Verdict {
    /// Its name.
    pub name: Text,
    /// Where it is published; may be empty.
    pub source: Text,
    /// SI unit of both values.
    pub unit: String,
    /// What strutt finds; for equations and formulas at the state where they differ most.
    pub value: f64,
    /// What is published, at the same place.
    pub published: f64,
    /// Relative difference.
    pub deviation: f64,
    /// Whether it holds.
    pub ok: bool,
    /// What differs, in words and formulas; may be empty.
    pub words: Text,
}
