//! What may be said at the end of a calculation, as data; whether it holds and how it is worded stands in [`crate::written`].

use algebra::arrange::Arrange;
use analysis::Dataset;
use mechanics::model::Plot;
use symbolic::Equations;
use symbolic::equations::Role;
use words::{Language, Text};

/// Extremes that are named.
const MOST: usize = 6;

/// What may be said at the end.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)]
pub enum Conclusion {
    /// A study did not come to its end.
    Unfinished { heading: Text },
    /// The least of the natural frequencies, none of which is left out.
    Lowest { omega: f64, all: Vec<f64> },
    /// Places of rest with what linearisation says of each: stable, unstable, nothing.
    Rest { stable: Vec<Option<bool>> },
    /// The greatest size of a quantity during the motion, its instant, and its values.
    Greatest { label: Text, shown: (f64, String), t: f64, beside: Vec<f64>, value: f64 },
    /// The amplitude of a quantity as it is shown, at the frequency of the file, with its dynamic coefficient.
    Forced { label: Text, omega: f64, amplitude: (f64, String), gain: Option<f64> },
    /// A frequency at which a quantity rests; least only, where it is not exact.
    Antiresonance { label: Text, omega: f64, exact: bool },
    /// A periodic regime with its period and the largest size of the multipliers that are not that of the shift along it.
    Regime { period: f64, stable: bool },
    /// What becomes of small disturbances, with the greatest growth, 1/s, and the verdict in words.
    Disturbed { stable: Option<bool>, growth: Option<f64>, verdict: Text },
    /// A number that a study found, with what it is.
    Number { label: Text, symbol: String, value: f64, unit: String },
    /// (ω_max − ω_min)/ω_mean.
    Irregular { delta: f64 },
    /// What a cycle needs: names, values with units as they are shown; for a wanted irregularity where there is one.
    Needed { delta: Option<f64>, found: Vec<(String, f64, String)> },
    /// Reactions at rest: symbols, values with units as they are shown.
    Held { found: Vec<(String, f64, String)> },
    /// Published results laid against ours: all, and those that do not hold.
    Published { all: usize, refuted: usize },
    /// The checks of the calculation.
    Checks { all: usize, failed: usize },
}

/// The greatest sizes of the first named quantities of a motion.
pub fn greatest(equations: &Equations, (data, plots): (&Dataset, &[Plot]), language: Language) -> Vec<Conclusion> {
    let named = |name: &str| equations.outputs.iter().any(|o| o.name == name && o.role == Role::Named);
    // what is plotted is what was asked for
    let plotted: Vec<&str> = plots.iter().flat_map(|plot| plot.y.iter().map(String::as_str)).collect();
    let name = |e: &analysis::dataset::Extreme| data.columns[e.column].quantity.name.as_str();
    // where the file names nothing, the motion itself is what was found
    let any = equations.outputs.iter().any(|o| o.role == Role::Named);
    let moves = |name: &str| !any && equations.outputs.iter().any(|o| o.name == name && o.role == Role::Coordinate);
    let mut extremes: Vec<_> = data.extremes.iter().filter(|e| named(name(e)) || moves(name(e))).collect();
    extremes.arrange_by_key(|e| plotted.iter().position(|p| *p == name(e)).unwrap_or(usize::MAX));
    let one = |e: &analysis::dataset::Extreme| {
        let column = &data.columns[e.column];
        let (value, t) = if e.max.abs() >= e.min.abs() { (e.max, e.t_max) } else { (e.min, e.t_min) };
        let scale = super::tables::scale(&column.quantity, value.abs());
        let label = distinct(equations, &column.quantity, language);
        let shown = (value / scale.size, scale.print(language));
        let beside = column.values.iter().chain([&e.min, &e.max]).copied().collect();
        (!label.en.is_empty()).then_some(Conclusion::Greatest { label, shown, t, beside, value })
    };
    extremes.into_iter().filter_map(one).take(MOST).collect()
}

/// The label of a quantity; with its symbol where another one has the same label, as components of one reaction have.
fn distinct(equations: &Equations, quantity: &analysis::Quantity, language: Language) -> Text {
    let label = &quantity.label;
    let alike = equations.outputs.iter().filter(|o| o.name != quantity.name).any(|o| o.label.en == label.en || o.label.ru == label.ru);
    if !alike || label.en.is_empty() {
        return label.clone();
    }
    let symbol = report::symbol::plain(&quantity.symbol, language);
    Text::new(format!("{}, {symbol}", label.en), format!("{}, {symbol}", label.ru))
}

/// A number that a study found, to be told at the end.
pub fn found(fact: &super::Fact, language: Language) -> Conclusion {
    let (symbol, value, unit) = shown(&fact.quantity, fact.value, language);
    Conclusion::Number { label: fact.quantity.label.clone(), symbol, value, unit }
}

/// Symbol, value and unit of a number as they are shown.
pub fn shown(quantity: &analysis::Quantity, value: f64, language: Language) -> (String, f64, String) {
    let scale = super::tables::scale(quantity, value.abs());
    (report::symbol::plain(&quantity.symbol, language), value / scale.size, scale.print(language))
}
