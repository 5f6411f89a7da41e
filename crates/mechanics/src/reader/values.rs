//! Single values of the file: strings, vectors of formulas.

use super::state::Reader;
use super::syntax::Value;
use super::wording::wrong_type;
use crate::formula::Context;
use crate::units::Dimension;
use std::ops::Range;
use symbolic::Expr;
use toml::de::DeValue;
use words::Notice;

/// A string with its place; a finding when it is something else.
pub(crate) fn string<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>, en: &str, ru: &str) -> Option<(String, Range<usize>)> {
    match value.get_ref() {
        DeValue::String(words) => printable(reader, words, value.span()).then(|| (words.as_ref().to_owned(), value.span())),
        other => {
            reader.fault(wrong_type(value.span(), en, ru, other.type_str()));
            None
        }
    }
}

/// Whether a text shows what it is: no character that steers a terminal or turns the direction of writing.
pub(super) fn printable(reader: &mut Reader, words: &str, span: Range<usize>) -> bool {
    let Some(bad) = words.chars().find(|c| steers(*c)) else { return true };
    let code = u32::from(bad);
    let fault = Notice::piece(
        "M150",
        span,
        format!("the text holds the control character U+{code:04X}"),
        format!("в тексте управляющий символ U+{code:04X}"),
    );
    reader.fault(fault.help("delete it, or retype the text", "удалите его или наберите текст заново"));
    false
}

/// Control characters but tabs and ends of lines; embedding, overriding and isolating of directions (Unicode Standard Annex 9).
fn steers(c: char) -> bool {
    (c.is_control() && !matches!(c, '\t' | '\n' | '\r')) || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Two or three formulas.
pub(crate) fn components<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>, context: &Context, wanted: &Dimension) -> [Expr; 3] {
    let mut result = [reader.builder.graph.zero(); 3];
    let Some(items) = value.get_ref().as_array() else {
        reader.fault(
            wrong_type(value.span(), "an array of 2 or 3 formulas", "массив из 2 или 3 формул", value.get_ref().type_str())
                .help("write for example [\"x\", \"y\"]", "напишите, например, [\"x\", \"y\"]"),
        );
        return result;
    };
    if !(2..=3).contains(&items.len()) {
        reader.fault(Notice::piece(
            "M008",
            value.span(),
            format!("a vector has 2 components in the plane or 3 in space, {} given", items.len()),
            format!("у вектора 2 компоненты на плоскости или 3 в пространстве, дано: {}", items.len()),
        ));
        return result;
    }
    for (slot, item) in result.iter_mut().zip(items.iter()) {
        if let Some(raw) = reader.raw(item) {
            *slot = reader.value(&raw, context, Some(wanted)).expr;
        }
    }
    result
}
