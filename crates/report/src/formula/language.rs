//! What depends on the language inside a formula: function names, marks, the last case.

use symbolic::Function;
use words::Language;

/// Between arguments; not a comma where the comma is decimal.
pub(super) fn list_mark(language: Language) -> &'static str {
    language.pick(",", ";")
}

/// The last case.
pub(super) fn otherwise(language: Language) -> &'static str {
    language.pick("otherwise", "в остальных случаях")
}

/// The name of a function in print.
pub(super) fn function(language: Language, function: Function) -> &'static str {
    use Function::{Acos, Acosh, Asin, Asinh, Atan, Atanh, Cosh, Log, Sinh, Tan, Tanh};
    match (language, function) {
        (_, Asin) => "arcsin",
        (_, Acos) => "arccos",
        (_, Log) => "ln",
        (Language::En, Asinh) => "arsinh",
        (Language::En, Acosh) => "arcosh",
        (Language::En, Atanh) => "artanh",
        (Language::Ru, Asinh) => "arsh",
        (Language::Ru, Acosh) => "arch",
        (Language::Ru, Atanh) => "arth",
        (Language::En, Atan) => "arctan",
        (Language::Ru, Tan) => "tg",
        (Language::Ru, Atan) => "arctg",
        (Language::Ru, Sinh) => "sh",
        (Language::Ru, Cosh) => "ch",
        (Language::Ru, Tanh) => "th",
        (_, other) => other.name(),
    }
}
