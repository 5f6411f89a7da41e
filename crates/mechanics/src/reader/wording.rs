//! Words of the file in messages.

use std::ops::Range;
use words::Notice;

/// A long word cut for a message.
pub(crate) fn short(text: &str) -> String {
    match text.char_indices().nth(40) {
        Some((i, _)) => format!("{}...", text[..i].escape_debug()),
        None => text.escape_debug().to_string(),
    }
}

pub(crate) fn wrong_type(span: Range<usize>, en: &str, ru: &str, got: &str) -> Notice {
    let got_ru = match got {
        "string" => "строка",
        "integer" => "целое число",
        "float" => "число",
        "boolean" => "логическое значение",
        "datetime" => "дата",
        "array" => "массив",
        "table" => "таблица",
        other => other,
    };
    Notice::piece("M007", span, format!("expected {en}, found {got}"), format!("ожидается {ru}, а стоит {got_ru}"))
}
