//! What a scheme shows, as fields for claims: each symbol with its items in the order of drawing.
//!
//! Lengths are shares of the first link, else of the first spring, places count from where that begins, y upwards, and directions are degrees: the numbers do not
//! depend on the scale of the picture.

use crate::outcome::Outcome;
use analysis::Dataset;
use report::scheme::{Item, LabelText, P, direction, distance};
use serde_json::{Map, Value, json};
use studies::pipeline::Machine;
use studies::scheme::{Options, asked};
use words::Language;

/// The scheme of a machine, or of the body of that name alone.
pub fn drawn(machine: &Machine, body: &str) -> Outcome {
    let body = (!body.is_empty()).then(|| body.to_owned());
    let scheme = match asked(machine, &Options { at: None, body }, Language::En) {
        Ok(scheme) => scheme,
        Err(trouble) => return Outcome::ended(&trouble),
    };
    let two_ends = |item: &&Item| item.place.to != [0.0; 2];
    let first = |name: &str| scheme.items.iter().find(|i| i.symbol.name == name);
    let (origin, unit) =
        first("link").or_else(|| first("spring")).map_or(([0.0; 2], 1.0), |i| (i.place.at, distance(i.place.at, i.place.to)));
    let seen = |p: P| [(p[0] - origin[0]) / unit, (origin[1] - p[1]) / unit];
    let mut own: Map<String, Value> = Map::new();
    for item in &scheme.items {
        let place = &item.place;
        let ([x, y], [to_x, to_y]) = (seen(place.at), seen(place.to));
        let turn = if two_ends(&item) { direction(place.at, place.to) } else { place.turn };
        let fields = json!({"path": item.path, "x": x, "y": y, "to_x": to_x, "to_y": to_y,
            "long": distance(place.at, place.to) / unit, "turn": turn.to_degrees()});
        if let Some(list) = own.entry(item.symbol.name).or_insert_with(|| json!([])).as_array_mut() {
            list.push(fields);
        }
    }
    let text = |text: &LabelText| match text {
        LabelText::Symbol(text) | LabelText::Formula(text) | LabelText::Words(text) => text.clone(),
        LabelText::Number(n) => n.to_string(),
    };
    let mut letters: Vec<String> = scheme.labels.iter().map(|label| text(&label.text)).collect();
    letters.sort();
    own.insert("letters".into(), letters.join(" ").into());
    Outcome::Fields { own: own.into(), data: Dataset::default() }
}
