//! An axis: symbols with their unit, as text and as HTML.

use crate::symbol;
use crate::unit::Scale;
use analysis::dataset::Column;
use words::Language;

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Names of the model shown as symbols, with commas between.
    pub symbols: Vec<String>,
    /// Unit of each symbol (ASCII label) when they are unlike; empty when `scale` holds for all.
    pub units: Vec<String>,
    /// Unit in which values are shown.
    pub scale: Scale,
    /// Logarithmic.
    pub log: bool,
}

impl Axis {
    /// An axis for these columns: symbols, common unit, SI prefix after the largest value. Columns of unlike units share an axis
    /// without prefix, each unit then stands behind its symbol.
    pub fn of_columns(columns: &[&Column]) -> Axis {
        let symbols = columns.iter().map(|c| c.quantity.symbol.clone()).collect();
        let unit = columns.first().map_or("1", |c| c.quantity.unit.as_str());
        if columns.iter().any(|c| c.quantity.unit != unit) {
            let units = columns.iter().map(|c| c.quantity.unit.clone()).collect();
            return Axis { symbols, units, scale: Scale::plain(""), log: false };
        }
        let largest = columns.iter().flat_map(|c| &c.values).filter(|v| v.is_finite()).fold(0.0_f64, |m, v| m.max(v.abs()));
        // the user's unit of display, where all have the same
        let display = columns.first().and_then(|c| c.quantity.display.clone());
        let common = display.filter(|d| columns.iter().all(|c| c.quantity.display.as_ref() == Some(d)));
        let scale = common.map_or_else(|| Scale::of_column(unit, largest), |(label, size)| Scale { size, label });
        Axis { symbols, units: Vec::new(), scale, log: false }
    }

    /// The axis as plain text: `φ′, рад/с`.
    pub fn plain(&self, language: Language) -> String {
        self.join(language, |name| symbol::plain(name, language))
    }

    /// The axis as HTML, symbols as MathML.
    pub fn html(&self, language: Language) -> String {
        self.join(language, |name| symbol::mathml(name, language))
    }

    /// Unit in print of the i-th symbol.
    pub fn unit(&self, i: usize, language: Language) -> String {
        self.units.get(i).map_or_else(|| self.scale.print(language), |label| crate::unit::print(label, language))
    }

    fn join(&self, language: Language, print: impl Fn(&str) -> String) -> String {
        let with_unit =
            |symbol: String, unit: String| if unit.is_empty() { symbol } else { format!("{symbol}, {}", crate::escape::markup(&unit)) };
        if self.units.is_empty() {
            let symbols: Vec<String> = self.symbols.iter().map(|s| print(s)).collect();
            return with_unit(symbols.join(", "), self.scale.print(language));
        }
        let parts: Vec<String> = self.symbols.iter().enumerate().map(|(i, s)| with_unit(print(s), self.unit(i, language))).collect();
        parts.join("; ")
    }
}
