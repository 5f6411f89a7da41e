//! The chapters that are not made of tables of the file: functions and units.

use super::link::pick;
use crate::fields::Words;
use crate::formula::{KINEMATIC_FUNCTIONS, Takes};
use std::fmt::Write;
use words::Language;

/// A chapter that writes itself.
pub struct Chapter {
    /// Name of its file, without the ending.
    pub file: &'static str,
    /// Heading.
    pub title: Words,
    /// What it is about, in a sentence.
    pub about: Words,
    /// Writes what stands below.
    pub write: fn(&mut String, Language),
}

/// Both of them.
pub const CHAPTERS: &[Chapter] = &[
    Chapter {
        file: "functions",
        title: ("Functions", "Функции"),
        about: (
            "What formulas may use: functions of numbers, and functions that ask the machine.",
            "Что можно использовать в формулах: функции чисел и функции, относящиеся к машине.",
        ),
        write: functions,
    },
    Chapter {
        file: "units",
        title: ("Units", "Единицы"),
        about: (
            "Names in Latin and Cyrillic letters; which of them take prefixes.",
            "Имена латинскими и русскими буквами; какие из них допускают приставки.",
        ),
        write: units,
    },
];

const OF_NUMBERS: Words = (
    "`log` and `ln` are natural, `lg` and `log10` to the base 10; angles are in radians; `min` and `max` take two or more. `if(a < b and not c < d, x, y)`: `and` binds closer than `or`, brackets group. Functions that jump at every whole number (`floor`, `round`, `mod`) are not known: their jumps would be as many events; write the pieces with `if`, a wave by `sin`.",
    "`log` и `ln` — натуральный логарифм, `lg` и `log10` — десятичный; углы в радианах; у `min` и `max` два аргумента и больше. `if(a < b and not c < d, x, y)`: `and` связывает сильнее, чем `or`, скобки группируют. Функций со скачком в каждом целом числе (`floor`, `round`, `mod`) нет: их скачки были бы бесчисленными событиями; запишите участки через `if`, волну — через `sin`.",
);

/// Functions of numbers and of the machine.
fn functions(out: &mut String, language: Language) {
    let names: Vec<String> = symbolic::Function::ALL.iter().map(|(_, n)| format!("`{n}`")).collect();
    let _ = writeln!(
        out,
        "{}, `sqrt`, `cbrt`, `ln` (= `log`), `lg` (= `log10`), `if(a < b, x, y)` (`<`, `<=`, `>`, `>=`, `and`, `or`, `not`).\n",
        names.join(", ")
    );
    let _ = writeln!(out, "{}\n", pick(language, OF_NUMBERS));
    kinematic(out, language);
}

fn kinematic(out: &mut String, language: Language) {
    let _ = writeln!(out, "{}\n|---|---|", pick(language, ("| kinematic function | meaning |", "| кинематическая функция | смысл |")));
    for f in KINEMATIC_FUNCTIONS.iter().chain(crate::elements::functions()) {
        let argument = match f.takes {
            Takes::Point => "A",
            Takes::Frame => "B",
            Takes::BodyOrNothing => "B",
            Takes::Nothing => "",
            Takes::Element | Takes::Acting => "S",
        };
        let _ = writeln!(out, "| `{}({argument})` | {} |", f.name, pick(language, (f.en, f.ru)));
    }
    let _ = writeln!(out);
}

fn units(out: &mut String, language: Language) {
    let _ =
        writeln!(out, "{}\n|---|---|---|", pick(language, ("| names | SI value | prefixes |", "| имена | значение в СИ | приставки |")));
    units_listed(out, language);
    prefixes(out, language);
}

/// Prefixes with their powers of ten, a line an alphabet.
fn prefixes(out: &mut String, language: Language) {
    let names = [("Latin prefixes", "Латинские приставки"), ("Cyrillic prefixes", "Русские приставки")];
    for (alphabet, name) in crate::units::PREFIXES.iter().zip(names) {
        let of: Vec<String> = alphabet.iter().map(|(prefix, power)| format!("`{prefix}` {}", power_of_ten(*power))).collect();
        let _ = writeln!(out, "{}: {}.\n", pick(language, name), of.join(", "));
    }
}

/// `10⁻³`.
fn power_of_ten(power: i64) -> String {
    let raised = |c: char| {
        if c == '-' { '⁻' } else { c.to_digit(10).and_then(|d| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(d as usize)).unwrap_or(c) }
    };
    format!("10{}", power.to_string().chars().map(raised).collect::<String>())
}

fn units_listed(out: &mut String, language: Language) {
    for unit in crate::units::listed() {
        let prefixes = if unit.prefixed { pick(language, ("yes", "да")) } else { "" };
        let names: Vec<String> = unit.names.iter().map(|n| format!("`{n}`")).collect();
        let value = if language == Language::En { unit.value } else { unit.value_ru };
        let _ = writeln!(out, "| {} | {value} | {prefixes} |", names.join(", "));
    }
    let _ = writeln!(out);
}
