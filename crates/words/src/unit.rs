//! Names of units in both alphabets.

use crate::Language;

/// Unit names: ASCII label, English print, Russian print.
pub const NAMES: &[(&str, &str, &str)] = &[
    ("m", "m", "м"),
    ("g", "g", "г"),
    ("t", "t", "т"),
    ("s", "s", "с"),
    ("min", "min", "мин"),
    ("h", "h", "ч"),
    ("N", "N", "Н"),
    ("J", "J", "Дж"),
    ("W", "W", "Вт"),
    ("Pa", "Pa", "Па"),
    ("Hz", "Hz", "Гц"),
    ("rad", "rad", "рад"),
    ("deg", "°", "°"),
    ("rev", "rev", "об"),
    ("rpm", "rpm", "об/мин"),
    ("A", "A", "А"),
    ("V", "V", "В"),
    ("K", "K", "К"),
    ("mol", "mol", "моль"),
    ("bar", "bar", "бар"),
    ("dB", "dB", "дБ"),
    ("%", "%", "%"),
    ("cd", "cd", "кд"),
    ("C", "C", "Кл"),
    ("Ohm", "Ohm", "Ом"),
    ("F", "F", "Ф"),
    ("H", "H", "Гн"),
    ("Wb", "Wb", "Вб"),
];

/// SI prefixes: ASCII, English print, Russian print, power of ten.
pub const PREFIXES: &[(&str, &str, &str, i32)] = &[
    ("T", "T", "Т", 12),
    ("G", "G", "Г", 9),
    ("M", "M", "М", 6),
    ("k", "k", "к", 3),
    ("d", "d", "д", -1),
    ("c", "c", "с", -2),
    ("m", "m", "м", -3),
    ("u", "µ", "мк", -6),
    ("µ", "µ", "мк", -6),
    ("n", "n", "н", -9),
    ("p", "p", "п", -12),
];

/// A unit name in print, with its prefix. What is not known is printed as it is.
pub fn print(name: &str, language: Language) -> String {
    let find = |n: &str| NAMES.iter().find(|row| row.0 == n).map(|row| language.pick(row.1, row.2));
    if let Some(print) = find(name) {
        return print.into();
    }
    for (ascii, en, ru, _) in PREFIXES {
        if let Some(base) = name.strip_prefix(ascii).and_then(find) {
            return format!("{}{base}", language.pick(en, ru));
        }
    }
    name.into()
}
