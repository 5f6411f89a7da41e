//! A number of a study that was repeated.

use crate::observable::{Absent, Observable};
use crate::results::Results;
use analysis::Quantity;
use analysis::reduce::NAMES;
use serde_json::Value;
use words::{Notice, Text};

/// The number, and what it is where the study itself says so.
///
/// # Errors
/// The study has no such number (S085), knows it at its rows only (S100), or not between these instants (S143, S144).
pub fn number(results: &Results, wanted: &Observable) -> Result<(f64, Option<Quantity>), Notice> {
    match (wanted.of(results), wanted) {
        (Ok(value), Observable::Field(path)) => Ok((value, path.fact(results).map(|fact| fact.quantity.clone()))),
        (Ok(value), _) => Ok((value, None)),
        (Err(Absent::AtRowsOnly), _) => Err(rows_only(wanted.column().unwrap_or_default())),
        (Err(Absent::NoWindow), _) => Err(no_windows(&wanted.to_string())),
        (Err(Absent::Unfinished), _) => Err(unfinished(&wanted.to_string(), results)),
        (Err(Absent::Nothing), _) => Err(no_number(&wanted.to_string(), &Value::Object(results.fields()))),
    }
}

/// Only a motion from its start has instants.
fn no_windows(text: &str) -> Notice {
    Notice::new(
        "S143",
        format!("the repeated study has no instants between which `{text}` could be taken"),
        format!("в повторяемом расчёте нет моментов времени, между которыми берётся `{text}`"),
    )
    .help(
        "repeat a study of a motion (of = \"simulate\", or --until), or leave the instants out",
        "повторяйте расчёт движения (of = \"simulate\" или --until) либо уберите моменты",
    )
}

/// The motion has no number between the two instants.
fn unfinished(text: &str, results: &Results) -> Notice {
    let why = results.data.notes.last().cloned().unwrap_or_default();
    Notice::new("S144", format!("this motion has no `{text}`"), format!("у этого движения нет `{text}`"))
        .why(
            if why.en.is_empty() { "the quantity has no value along it, or it ends before the window does".to_owned() } else { why.en },
            if why.ru.is_empty() {
                "величина на нём не определена, или оно кончается раньше окна".to_owned()
            } else {
                why.ru
            },
        )
        .help(
            "look at the formula of the quantity, or choose the window inside of the motion",
            "проверьте формулу величины или выберите окно внутри движения",
        )
}

/// The study does not know the quantity between its rows.
pub(super) fn rows_only(name: &str) -> Notice {
    Notice::new(
        "S100",
        format!("the repeated study knows `{name}` at its rows only, or not at all"),
        format!("повторяемый расчёт знает `{name}` лишь в строках таблицы или не знает вовсе"),
    )
    .help(
        "repeat a study of a motion (of = \"simulate\"), or observe a number of the study itself: of `statics` a reaction, as force(A)",
        "повторяйте расчёт движения (of = \"simulate\") или наблюдайте число самого расчёта: у `statics` реакцию, например force(A)",
    )
}

/// Only a periodic regime has a number of its own that is meant when none is named.
pub(super) fn nothing_observed(of: &str) -> Notice {
    Notice::new(
        "S085",
        format!("the sweep does not say what to observe of the study `{of}`"),
        format!("в серии не указано, что наблюдать в расчёте `{of}`"),
    )
    .help(format!("give observe = [...]: {}", observable().en), format!("задайте observe = [...]: {}", observable().ru))
}

/// What a sweep may observe besides the numbers of its study.
fn observable() -> Text {
    let of_columns = NAMES.iter().map(|(word, _)| format!("{word}(..)")).collect::<Vec<_>>().join(", ");
    Text::new(
        format!("an output by its name or by {of_columns}; the number of `events`, or of `events(NAME)`; a number of the study's JSON"),
        format!("величина из [outputs] по имени или через {of_columns}; число событий `events` или `events(ИМЯ)`; число из JSON расчёта"),
    )
}

/// The study's JSON has nothing at this path.
fn no_number(path: &str, fields: &Value) -> Notice {
    let first = path.split('.').next().unwrap_or_default();
    let trouble = Notice::new("S085", format!("the study has no number `{path}`"), format!("в расчёте нет числа `{path}`"));
    match fields.get(first).and_then(Value::as_array).map(Vec::len) {
        Some(n) => trouble.help(
            format!("`{first}` has {n} entries; as in the JSON of the study they are counted from 0"),
            format!("в `{first}` элементов: {n}; как и в JSON расчёта, их счёт начинается с 0"),
        ),
        None => {
            let names = fields
                .as_object()
                .map(|o| o.iter().filter(|(_, v)| !v.is_string()).map(|(k, _)| k.as_str()).collect::<Vec<_>>().join(", "))
                .unwrap_or_default();
            let more = observable();
            trouble.help(format!("it has: {names}; or {}", more.en), format!("в нём есть: {names}; или {}", more.ru))
        }
    }
}
