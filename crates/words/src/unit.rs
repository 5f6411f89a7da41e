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
    ("T", "T", "Тл"),
    ("Ω", "Ω", "Ом"),
    ("sec", "s", "с"),
    ("day", "d", "сут"),
    ("d", "d", "сут"),
    ("arcmin", "′", "′"),
    ("arcsec", "″", "″"),
    ("turn", "rev", "об"),
    ("r", "rev", "об"),
    ("l", "l", "л"),
    ("L", "l", "л"),
    ("atm", "atm", "атм"),
    ("mmHg", "mmHg", "мм рт. ст."),
    ("psi", "psi", "фунт-сила/дюйм²"),
    ("kgf", "kgf", "кгс"),
    ("gf", "gf", "гс"),
    ("tf", "tf", "тс"),
    // 745.7 W and 735.5 W: the Russian one is the second
    ("hp", "hp", "брит. л.с."),
    ("PS", "PS", "л.с."),
    ("in", "in", "дюйм"),
    ("ft", "ft", "фут"),
    ("lb", "lb", "фунт"),
    ("lbf", "lbf", "фунт-сила"),
];

/// SI prefixes: ASCII, English print, Russian print, power of ten.
pub const PREFIXES: &[(&str, &str, &str, i32)] = &[
    ("da", "da", "да", 1),
    ("h", "h", "г", 2),
    ("T", "T", "Т", 12),
    ("G", "G", "Г", 9),
    ("M", "M", "М", 6),
    ("k", "k", "к", 3),
    ("d", "d", "д", -1),
    ("c", "c", "с", -2),
    ("m", "m", "м", -3),
    ("u", "µ", "мк", -6),
    ("µ", "µ", "мк", -6),
    ("μ", "µ", "мк", -6),
    ("n", "n", "н", -9),
    ("p", "p", "п", -12),
    ("f", "f", "ф", -15),
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
