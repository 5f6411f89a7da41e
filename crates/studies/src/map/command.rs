//! The command line for one place of a map.

use crate::machine::Machine;
use crate::repeat::Repeated;
use mechanics::asked::{Asked, Key, Like, Takes, Value};

/// The command of the repeated study without the values of the place; empty where what was asked for cannot be written as options.
pub(super) fn command(machine: &Machine, repeated: &Repeated, inner: &Asked) -> String {
    let kind = repeated.base.kind;
    let Some(study) = machine.origin.studies.find(kind).filter(|study| study.has_command()) else { return String::new() };
    let mut words = vec!["strutt".to_owned(), kind.to_owned(), quoted(&machine.origin.source.path)];
    for (name, value) in &machine.origin.overrides {
        words.push(format!("--set {}", quoted(&format!("{name}={value}"))));
    }
    for (name, value) in inner.values() {
        let Some(text) = study.kind().key(name).and_then(|key| option(key, value)) else { return String::new() };
        words.push(text);
    }
    words.join(" ")
}

/// A value as an option.
fn option(key: &Key, value: &Value) -> Option<String> {
    let line = key.option?;
    let name = line.name.unwrap_or(key.name).replace('_', "-");
    Some(match value {
        Value::Flag(true) => format!("--{name}"),
        Value::Word(_) if line.sets.is_some() => format!("--{name}"),
        Value::Word(word) => format!("--{name} {}", quoted(word)),
        Value::Number(number) => {
            let unit = match key.takes {
                Takes::Quantity(Like::Is(_, unit), _) if unit != "1" => format!(" {unit}"),
                Takes::Quantity(..) => return None,
                _ => String::new(),
            };
            format!("--{name} {}", quoted(&format!("{number}{unit}")))
        }
        _ => return None,
    })
}

/// A word as shells take it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./=:+".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        let escaped = word.chars().flat_map(|c| "\\\"$`".contains(c).then_some('\\').into_iter().chain([c]));
        format!("\"{}\"", escaped.collect::<String>())
    }
}
