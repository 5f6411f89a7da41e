//! Where the numbers of a result come from: title, version, hash of the file, parameters.

use analysis::dataset::{ParameterValue, Provenance};
use analysis::{Dataset, Quantity};
use symbolic::Equations;

/// Version of strutt.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Stamps a result.
pub fn stamp(mut data: Dataset, equations: &Equations, model_hash: &str) -> Dataset {
    data.provenance = Provenance {
        title: equations.title.clone(),
        version: VERSION.into(),
        model_hash: model_hash.into(),
        parameters: parameters(equations),
    };
    // columns that only know their name are printed with the symbol of the file
    for quantity in data.columns.iter_mut().map(|column| &mut column.quantity).filter(|q| q.symbol == q.name) {
        if let Some((_, shown)) = equations.notation.iter().find(|(name, _)| *name == quantity.name) {
            quantity.symbol.clone_from(shown);
        }
    }
    data
}

fn parameters(equations: &Equations) -> Vec<ParameterValue> {
    let quantity = |p: &symbolic::equations::Parameter| {
        let name = equations.graph.symbol_info(p.symbol).name.clone();
        let symbol = equations.notation.iter().find(|(n, _)| *n == name).map_or_else(|| name.clone(), |(_, s)| s.clone());
        Quantity { name, symbol, unit: p.unit.clone(), label: p.label.clone(), display: None }
    };
    let value = |p| ParameterValue { quantity: quantity(p), written: p.written.clone(), value: p.value };
    equations.parameters.iter().map(value).collect()
}
