//! What is asked of a study as text whose form is stated here, so that a checksum of it means the same in every build: JSON, numbers by their bits, formulas and symbols by their positions in
//! the machine's graph, which the hash of the model beside it fixes. Plots are left out: no row depends on them.

use mechanics::asked::{Asked, Value};
use mechanics::model::SweepRange;
use serde_json::{Value as Json, json};
use symbolic::{Expr, SymbolId};

/// A study: its kind, then key by key as they were given.
pub(crate) fn stated(asked: &Asked) -> Json {
    let values: Vec<Json> = asked.values().iter().filter_map(|(key, value)| Some(json!([key, of_value(value)?]))).collect();
    json!([asked.kind, values])
}

/// Ranges: name and values.
pub(crate) fn of_ranges(ranges: &[SweepRange]) -> Json {
    ranges.iter().map(|range| json!([range.name, numbers(&range.values)])).collect()
}

fn of_value(value: &Value) -> Option<Json> {
    let place = |(symbol, value): &(SymbolId, f64)| json!([symbol.index(), bits(*value)]);
    let driven = |(symbol, formula): &(SymbolId, Expr)| json!([symbol.index(), formula.index()]);
    Some(match value {
        Value::Number(number) => json!({"number": bits(*number)}),
        Value::Numbers(list) => json!({"numbers": numbers(list)}),
        Value::Flag(flag) => json!({"flag": flag}),
        Value::Word(word) => json!({"word": word}),
        Value::Words(list) => json!({"words": list}),
        Value::Coordinate(named) => json!({"coordinate": named.name}),
        Value::Guess(list) => json!({"guess": list.iter().map(place).collect::<Vec<_>>()}),
        Value::Driven(list) => json!({"driven": list.iter().map(driven).collect::<Vec<_>>()}),
        Value::Formula(formula) => json!({"formula": formula.index()}),
        Value::Formulas(list) => json!({"formulas": list.iter().map(|f| json!([f.text, f.unit])).collect::<Vec<_>>()}),
        Value::Variable(variable) => json!({"variable": [json!(variable.name), json!(variable.factor.index())]}),
        Value::Ranges(ranges) => json!({"ranges": of_ranges(ranges)}),
        Value::Windows(list) => json!({"windows": list.iter().map(|(name, ends)| json!([name, numbers(ends)])).collect::<Vec<_>>()}),
        Value::Plots(_) => return None,
    })
}

fn numbers(list: &[f64]) -> Json {
    list.iter().map(|v| bits(*v)).collect()
}

fn bits(value: f64) -> Json {
    json!(format!("{:016x}", value.to_bits()))
}

#[cfg(test)]
mod tests {
    use super::super::journal::checksum;
    use super::*;

    /// The text and its FNV-1a are those of this page, worked out apart from the program: 0.5 is 3fe0000000000000, 2 is 4000000000000000.
    #[test]
    fn the_form_is_the_one_that_is_stated() {
        let mut asked = Asked::new("simulate");
        asked.set("until", Value::Number(0.5));
        asked.set("outputs", Value::Words(vec!["x".into()]));
        asked.set("over", Value::Ranges(vec![SweepRange { name: "m".into(), values: vec![2.0] }]));
        asked.set("plot", Value::Plots(Vec::new()));
        let text = stated(&asked).to_string();
        assert_eq!(
            text,
            r#"["simulate",[["until",{"number":"3fe0000000000000"}],["outputs",{"words":["x"]}],["over",{"ranges":[["m",["4000000000000000"]]]}]]]"#
        );
        assert_eq!(checksum(&text), FNV);
        asked.set("until", Value::Number(-0.0));
        let other = stated(&asked).to_string();
        asked.set("until", Value::Number(0.0));
        assert_ne!(other, stated(&asked).to_string());
    }

    const FNV: u64 = 0x5d56_ca63_2819_9e82;
}
