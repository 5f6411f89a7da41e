//! JSON of a study: `title, version, model_hash, parameters, counters, audits, events, columns` and the study's own fields.
//!
//! ```json
//! {"title": "...", "version": "0.1.0", "model_hash": "...",
//!  "parameters": {"m": {"value": 0.02, "unit": "kg", "written": "20 g"}},
//!  "counters": {"steps": 117},
//!  "audits": [{"key": "power_balance", "name": "...", "value": 1e-13, "limit": 1e-9, "ok": true}],
//!  "extremes": [{"name": "phi", "min": -1.0, "t_min": 0.5, "max": 1.0, "t_max": 0.0}],
//!  "means": {"phi": 0.1},
//!  "digits": {"tolerance": 1e-13, "order": 29, "columns": {"phi": {"digits": 12}}},
//!  "events": [{"t": 10.0, "what": "...", "contact": "floor", "from": "open", "to": "closed", "impulse": 1.4, "impulses": [{"name": "force(floor)", "unit": "N s", "value": 1.4}], "before": {"phi": 0.1, "phi'": -2.0}, "after": {"phi": 0.1, "phi'": 1.6}}],
//!  "partial": false, "notes": [],
//!  "columns": {"t": {"unit": "s", "values": [0.0, 0.1]}, "phi": {"unit": "rad", "values": [0.0, 1.5]}}}
//! ```
//!
//! Numbers are SI, in the shortest form that reads back as the same `f64`. JSON has no form for infinities and not-a-number: they are
//! `null`, and `stated` says what they mean: `[{"name": "x_phase", "missing": "absent", "words": "..."}]` ("unbounded" for infinities). Columns and parameters are objects in the order of the study; a later column with the name of an earlier one is `f.1`.

use super::row::pass_on;
use super::{Format, Holds, Tree};
use analysis::Dataset;
use analysis::dataset::{Digits, Event, Extreme, Held, Impulse, Labels, Stated};
use serde_json::{Map, Value, json};
use std::io::{self, Write};
use words::Language;

/// The row of the table.
pub const FORMAT: Format = Format {
    name: "json",
    extension: "json",
    help: ("all results on standard output, for programs", "все результаты в стандартный вывод, для программ"),
    holds: Holds::Tree(Tree { data: write_to, value: |value| format!("{value}\n") }),
};

/// The JSON of a dataset as bytes, closed by a line feed. `extra` are the study's own fields, written before the columns.
pub fn write(data: &Dataset, extra: &Map<String, Value>, language: Language) -> Vec<u8> {
    let mut out = Vec::new();
    // memory takes everything
    let written = write_to((data, extra), language, &mut out);
    debug_assert!(written.is_ok());
    out
}

/// Writes the same, piece by piece.
///
/// # Errors
/// The place refuses it.
pub fn write_to((data, extra): (&Dataset, &Map<String, Value>), language: Language, to: &mut dyn Write) -> io::Result<()> {
    let mut head = head(data, language);
    for (key, value) in extra {
        // the fields of every study cannot be replaced by a study's own
        head.entry(key.clone()).or_insert_with(|| value.clone());
    }
    let mut out = Vec::new();
    push(&mut out, &head);
    // open the object again: the columns are written without an intermediate tree
    out.pop();
    out.extend_from_slice(b",\"columns\":{");
    for (i, (column, name)) in data.columns.iter().zip(data.names()).enumerate() {
        out.extend_from_slice(if i > 0 { b",\n" } else { b"\n" });
        push(&mut out, &name);
        out.extend_from_slice(b":{\"unit\":");
        push(&mut out, &column.quantity.unit);
        out.extend_from_slice(b",\"values\":[");
        for (k, value) in column.values.iter().enumerate() {
            if k > 0 {
                out.push(b',');
            }
            push(&mut out, value);
            pass_on(&mut out, to)?;
        }
        out.extend_from_slice(b"]}");
    }
    out.extend_from_slice(b"}}\n");
    to.write_all(&out)
}

/// Everything but the columns.
fn head(data: &Dataset, language: Language) -> Map<String, Value> {
    let from = &data.provenance;
    let parameters: Map<String, Value> = from
        .parameters
        .iter()
        .map(|p| (p.quantity.name.clone(), json!({"value": p.value, "unit": p.quantity.unit, "written": p.written})))
        .collect();
    let counters: Map<String, Value> = data.counters.iter().map(|c| (c.key.into(), count(c.value))).collect();
    let audits: Vec<Value> = data
        .audits
        .iter()
        .map(|a| json!({"key": a.key, "name": language.text(&a.name), "value": a.value, "limit": a.limit, "ok": a.ok}))
        .collect();
    let events: Vec<Value> = data.events.iter().map(|e| event(data, e, language)).collect();
    let notes: Vec<&str> = data.notes.iter().map(|n| language.text(n)).collect();
    let fields = [
        ("title", json!(language.text(&from.title))),
        ("version", json!(from.version)),
        ("model_hash", json!(from.model_hash)),
        ("parameters", Value::Object(parameters)),
        ("counters", Value::Object(counters)),
        ("audits", Value::Array(audits)),
        ("events", Value::Array(events)),
        ("partial", json!(data.partial)),
        ("notes", json!(notes)),
    ];
    let mut head: Map<String, Value> = fields.into_iter().map(|(key, value)| (key.into(), value)).collect();
    if !data.extremes.is_empty() {
        head.insert("extremes".into(), data.extremes.iter().map(|e| extreme(data, e)).collect());
    }
    if !data.stated.is_empty() {
        let one = |s: &Stated| json!({"name": s.column, "missing": s.missing.key(), "words": language.text(&s.words)});
        head.insert("stated".into(), data.stated.iter().map(one).collect());
    }
    if !data.reasons.is_empty() {
        let one = |(row, words): &(usize, words::Text)| json!({"row": row, "what": language.text(words)});
        head.insert("reasons".into(), data.reasons.iter().map(one).collect());
    }
    if !data.labels.is_empty() {
        let words = |labels: &Labels| labels.rows.iter().map(|k| json!(labels.words.get(*k))).collect::<Vec<_>>();
        let labels = data.labels.iter().map(|labels| (labels.name.clone(), json!(words(labels))));
        head.insert("labels".into(), Value::Object(labels.collect()));
    }
    let means: Map<String, Value> =
        data.overall.iter().filter(|o| o.mean().is_finite()).map(|o| (name(data, o.column).to_owned(), json!(o.mean()))).collect();
    if !means.is_empty() {
        head.insert("means".into(), Value::Object(means));
    }
    if let Some(found) = &data.digits {
        head.insert("digits".into(), digits(data, found));
    }
    head
}

fn name(data: &Dataset, column: usize) -> &str {
    data.columns.get(column).map_or("", |c| &c.quantity.name)
}

/// `{"name": "phi", "min": -1.0, "t_min": 0.5, "max": 1.0, "t_max": 0.0}`, SI.
fn extreme(data: &Dataset, e: &Extreme) -> Value {
    json!({"name": name(data, e.column), "min": e.min, "t_min": e.t_min, "max": e.max, "t_max": e.t_max})
}

/// `{"tolerance": 1e-13, "order": 29, "columns": {"phi": {"digits": 12}}}`; `lost` is the first row time with fewer than four.
fn digits(data: &Dataset, found: &Digits) -> Value {
    let column = |held: &Held| {
        let mut value = json!({"digits": held.digits});
        if let Some(t) = held.lost {
            value["lost"] = json!(t);
        }
        (name(data, held.column).to_owned(), value)
    };
    let columns: Map<String, Value> = found.columns.iter().map(column).collect();
    json!({"tolerance": found.tolerance, "order": found.order, "columns": columns})
}

/// Whole counters read as integers.
fn count(x: f64) -> Value {
    if x.fract() == 0.0 && x.abs() < 9e15 { json!(x as i64) } else { json!(x) }
}

fn push<T: serde::Serialize + ?Sized>(out: &mut Vec<u8>, value: &T) {
    // strings, numbers and maps with string keys always serialize, and memory always takes them
    let written = serde_json::to_writer(&mut *out, value);
    debug_assert!(written.is_ok());
}

/// An event with the states and the columns just before and just after it.
fn event(data: &Dataset, event: &Event, language: Language) -> Value {
    let columns = data.columns.iter().enumerate().filter(|(i, _)| Some(*i) != data.axis).map(|(_, c)| &c.quantity.name);
    let names: Vec<&String> = columns.collect();
    let side = |k: usize| {
        let states = data.states.iter().zip(&event.states[k]);
        let outputs = names.iter().copied().zip(&event.outputs[k]);
        states.chain(outputs).map(|(name, value)| (name.clone(), json!(value))).collect::<Map<String, Value>>()
    };
    let mut fields = Map::new();
    fields.insert("t".into(), json!(event.t));
    if !event.name.is_empty() {
        fields.insert("name".into(), json!(event.name));
    }
    fields.insert("what".into(), json!(language.text(&event.what)));
    if let Some(change) = &event.contact {
        fields.insert("contact".into(), json!(change.contact));
        fields.insert("from".into(), json!(change.from));
        fields.insert("to".into(), json!(change.to));
        if let Some(impulse) = change.impulse {
            fields.insert("impulse".into(), json!(impulse));
        }
    }
    if !event.impulses.is_empty() {
        let one = |p: &Impulse| json!({"name": p.name, "unit": p.unit, "value": p.value});
        fields.insert("impulses".into(), event.impulses.iter().map(one).collect());
    }
    if !event.states[1].is_empty() {
        fields.insert("before".into(), Value::Object(side(0)));
        fields.insert("after".into(), Value::Object(side(1)));
    }
    Value::Object(fields)
}

#[cfg(test)]
mod tests {
    use super::*;
    use analysis::Quantity;
    use analysis::dataset::{Audit, Column, Counter, ParameterValue};
    use words::Text;

    fn sample() -> Dataset {
        let mut data = Dataset::default();
        data.provenance.title = Text::new("A \"title\"", "Название");
        data.provenance.parameters.push(ParameterValue { quantity: Quantity::new("m", "kg"), written: "20 g".into(), value: 0.02 });
        data.counters.push(Counter { key: "steps", name: Text::default(), value: 117.0 });
        data.audits.push(Audit::at_most("power_balance", Text::new("Power", "Мощность"), f64::NAN, 1e-9));
        data.events.push(Event { t: 10.0, what: Text::new("switch", "переключение"), ..Event::default() });
        data.columns.push(Column { quantity: Quantity::new("t", "s"), values: vec![0.0, 0.1] });
        data.columns.push(Column { quantity: Quantity::new("phi'", "rad/s"), values: vec![f64::INFINITY, 1.0 / 3.0] });
        data
    }

    #[test]
    fn all_fields_are_there_in_order() {
        let mut extra = Map::new();
        extra.insert("stable".into(), json!(true));
        extra.insert("title".into(), json!("taken"));
        let value: Value = serde_json::from_slice(&write(&sample(), &extra, Language::Ru)).unwrap();
        let keys: Vec<&str> = value.as_object().unwrap().keys().map(String::as_str).collect();
        assert_eq!(
            keys,
            ["title", "version", "model_hash", "parameters", "counters", "audits", "events", "partial", "notes", "stable", "columns"]
        );
        assert_eq!(value["title"], "Название");
        assert_eq!(value["counters"]["steps"], 117);
        assert_eq!(value["audits"][0]["ok"], false);
        assert_eq!(value["audits"][0]["value"], Value::Null);
        assert_eq!(value["events"][0]["what"], "переключение");
        assert_eq!(value["columns"]["phi'"]["unit"], "rad/s");
        assert_eq!(value["columns"]["phi'"]["values"][0], Value::Null);
        assert_eq!(value["columns"]["phi'"]["values"][1].as_f64().map(f64::to_bits), Some((1.0_f64 / 3.0).to_bits()));
    }

    #[test]
    fn an_empty_dataset_is_valid_json() {
        let value: Value = serde_json::from_slice(&write(&Dataset::default(), &Map::new(), Language::En)).unwrap();
        assert!(value["columns"].as_object().unwrap().is_empty());
    }

    #[test]
    fn columns_of_one_name_are_told_apart() {
        let column = |name: &str, unit: &str| Column { quantity: Quantity::new(name, unit), values: vec![1.0] };
        let names = ["f", "f", "f.1", "f"];
        let data = Dataset { columns: names.iter().map(|n| column(n, "Hz")).collect(), ..Dataset::default() };
        assert_eq!(data.names(), ["f", "f.2", "f.1", "f.3"]);
        let read: Value = serde_json::from_slice(&write(&data, &Map::new(), Language::En)).unwrap();
        assert_eq!(read["columns"].as_object().unwrap().len(), names.len());
    }
}
