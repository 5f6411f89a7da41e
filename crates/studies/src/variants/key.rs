//! The key of a class: who has which variant, with which values, and the right numbers. It carries the model, so that what follows from a student's own value
//! can be computed from the key alone.

use super::course::Member;
use crate::provenance::VERSION;
use crate::source::Source;
use mechanics::Model;
use mechanics::variants::Given;
use serde_json::{Value, json};
use std::fmt::Write;

/// Version of the form of a key.
const FORM: u64 = 1;

/// The key of a class.
#[derive(Clone, Debug)]
pub struct Key {
    /// The model that it was made of.
    pub source: Source,
    /// Version of the program that made it.
    pub version: String,
    /// Students in the order of the list.
    pub entries: Vec<Entry>,
}

/// A student in the key.
#[derive(Clone, Debug, Default)]
pub struct Entry {
    /// As the list has it; empty without a list.
    pub student: String,
    /// The variant with its values.
    pub member: Member,
    /// Right numbers, in the unit of the question.
    pub truths: Vec<Option<f64>>,
    /// Sizes of the quantities that are asked for, in the same units: what a right answer of zero is measured by.
    pub sizes: Vec<f64>,
    /// Why there are none.
    pub failure: String,
}

impl Entry {
    /// What to call it where there is no student.
    pub fn name(&self) -> &str {
        if self.student.is_empty() { &self.member.name } else { &self.student }
    }
}

impl Key {
    /// A key that this version makes.
    pub fn new(source: Source, entries: Vec<Entry>) -> Key {
        Key { source, version: VERSION.to_owned(), entries }
    }

    /// Hash of the model.
    pub fn hash(&self) -> String {
        self.source.hash(&[])
    }

    /// As JSON. `model` is the model of the source.
    pub fn to_json(&self, model: &Model) -> Value {
        let helper = |symbol| {
            model.variants.iter().flat_map(|v| &v.helpers).find(|h| h.symbol == symbol).map(|h| h.name.clone()).unwrap_or_default()
        };
        let entry = |e: &Entry| {
            let columns: Vec<Value> = e.member.given.helpers.iter().map(|(symbol, value)| json!([helper(*symbol), value])).collect();
            json!({"student": e.student, "variant": e.member.name, "hash": self.source.hash(&e.member.overrides), "values": e.member.overrides,
                "group": e.member.given.group, "number": e.member.given.number, "columns": columns, "answers": e.truths, "sizes": e.sizes, "failure": e.failure})
        };
        let answer = |a: &mechanics::model::AnswerDecl| json!({"id": a.id, "en": a.ask.en, "ru": a.ask.ru, "unit": a.unit.label});
        json!({"strutt_key": FORM, "version": self.version, "model_hash": self.hash(), "title": {"en": model.title.en, "ru": model.title.ru},
            "answers": model.answers.iter().map(answer).collect::<Vec<_>>(), "entries": self.entries.iter().map(entry).collect::<Vec<_>>(),
            "model": {"path": self.source.path, "text": self.source.text}})
    }

    /// The model of a key as JSON.
    pub fn source_of(value: &Value) -> Option<Source> {
        value.get("strutt_key").and_then(Value::as_u64).filter(|form| *form == FORM)?;
        let model = value.get("model")?;
        Some(Source::new(model.get("path")?.as_str()?, model.get("text")?.as_str()?))
    }

    /// A key from JSON; none where something is missing or another model has been put in.
    pub fn from_json(value: &Value, source: Source, model: &Model) -> Option<Key> {
        let entries: Option<Vec<Entry>> = value.get("entries")?.as_array()?.iter().map(|e| entry(e, model)).collect();
        let key = Key { source, version: value.get("version")?.as_str()?.to_owned(), entries: entries? };
        (value.get("model_hash")?.as_str()? == key.hash()).then_some(key)
    }

    /// As CSV: student, variant, answers in the units of the questions, hash of the variant.
    pub fn to_csv(&self, model: &Model) -> String {
        let heads =
            model.answers.iter().map(|a| if a.unit.label.is_empty() { a.id.clone() } else { format!("{} [{}]", a.id, a.unit.label) });
        let mut out = format!("# strutt {}, model {}\n", self.version, self.hash());
        let _ = writeln!(out, "student,variant,{}hash,remark", heads.map(|h| format!("{},", quoted(&h))).collect::<String>());
        for e in &self.entries {
            let number = |i: usize| e.truths.get(i).copied().flatten().map_or(String::new(), |v| v.to_string());
            let numbers: String = (0..model.answers.len()).map(|i| format!("{},", number(i))).collect();
            let (hash, failure) = (self.source.hash(&e.member.overrides), quoted(&e.failure));
            let _ = writeln!(out, "{},{},{numbers}{hash},{failure}", quoted(&e.student), quoted(&e.member.name));
        }
        out
    }

    /// An empty file for the answers, with semicolons and a byte order mark, as spreadsheets with decimal commas want it.
    pub fn answers_csv(&self, model: &Model) -> String {
        let heads =
            model.answers.iter().map(|a| if a.unit.label.is_empty() { a.id.clone() } else { format!("{} [{}]", a.id, a.unit.label) });
        let mut out = format!("\u{feff}# strutt {}, model {}\nstudent;variant", self.version, self.hash());
        heads.for_each(|h| out.push_str(&format!(";{h}")));
        out.push('\n');
        for e in &self.entries {
            let _ = writeln!(out, "{};{}{}", quoted(&e.student), quoted(&e.member.name), ";".repeat(model.answers.len()));
        }
        out
    }
}

/// A cell of CSV with commas or semicolons; a formula of a spreadsheet is made a text.
pub fn quoted(text: &str) -> String {
    let text = if text.starts_with(['=', '+', '@']) { format!("'{text}") } else { text.to_owned() };
    if text.contains([',', '"', '\n', '\r', ';']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text }
}

fn entry(value: &Value, model: &Model) -> Option<Entry> {
    let text = |key: &str| value.get(key).and_then(Value::as_str).map(str::to_owned);
    let pair = |v: &Value| Some((v.get(0)?.as_str()?.to_owned(), v.get(1)?.as_str()?.to_owned()));
    let overrides: Option<Vec<(String, String)>> = value.get("values")?.as_array()?.iter().map(pair).collect();
    let helper = |v: &Value| {
        let name = v.get(0)?.as_str()?;
        let known = model.variants.iter().flat_map(|own| &own.helpers).find(|h| h.name == name)?;
        Some((known.symbol, v.get(1)?.as_f64()?))
    };
    let helpers: Option<Vec<_>> = value.get("columns")?.as_array()?.iter().map(helper).collect();
    let given =
        Given { values: Vec::new(), helpers: helpers?, group: value.get("group")?.as_f64(), number: value.get("number")?.as_f64()? };
    Some(Entry {
        student: text("student")?,
        member: Member { name: text("variant")?, overrides: overrides?, given },
        truths: value.get("answers")?.as_array()?.iter().map(Value::as_f64).collect(),
        // keys of earlier versions have none
        sizes: value.get("sizes").and_then(Value::as_array).into_iter().flatten().map(|v| v.as_f64().unwrap_or(0.0)).collect(),
        failure: text("failure")?,
    })
}
