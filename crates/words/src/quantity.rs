//! What a number is called: name, symbol, unit, label.

use crate::Text;

/// A named quantity: a state or an output.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Quantity {
    /// Name in files: `phi'`.
    pub name: String,
    /// Symbol in notation: `phi`, `omega_p`.
    pub symbol: String,
    /// SI label: `rad/s`.
    pub unit: String,
    /// What it is.
    pub label: Text,
    /// Unit to show it in, with the SI value of one such unit, when the user names one. Values are SI everywhere.
    pub display: Option<(String, f64)>,
}

impl Quantity {
    /// A quantity whose symbol is its name, without a label.
    pub fn new(name: &str, unit: &str) -> Quantity {
        Quantity { name: name.into(), symbol: name.into(), unit: unit.into(), label: Text::default(), display: None }
    }
}
