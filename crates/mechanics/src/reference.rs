//! The reference of the model file, generated from the tables of fields: `docs/model-file.md`.

use crate::fields::{self, TableSpec};
use crate::formula::KINEMATIC_FUNCTIONS;
use std::fmt::Write;

/// Which language to write in.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Language {
    /// English.
    English,
    /// Russian.
    Russian,
}

impl Language {
    fn pick(self, words: (&'static str, &'static str)) -> &'static str {
        if self == Language::English { words.0 } else { words.1 }
    }
}

/// The whole reference in Markdown.
pub fn markdown(language: Language) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "# {}\n", language.pick(("The model file", "Файл модели")));
    let _ = writeln!(out, "{}\n", language.pick(INTRODUCTION));
    for table in fields::all() {
        section(&mut out, table, language);
    }
    functions(&mut out, language);
    units(&mut out, language);
    out
}

const INTRODUCTION: (&str, &str) = (
    "A model is a TOML file. Quantities are strings with units, in Latin or Cyrillic: `\"20 g\"`, `\"12,5 кг\"`, `\"1450 rpm\"`, `\"30°\"`. \
     Bare numbers have no dimension; 0 fits every dimension. Any other string is a formula: names, `+ - * / ^`, brackets, functions, \
     `pi`, `t`, primes for time derivatives (`phi'`), units in square brackets after a number (`30 [rad/s^2] * t`). \
     In units `/` divides by the next factor only: `N m s/rad`. Names with Greek or Cyrillic letters need quotes as keys: `\"φ\" = \"rad\"`.",
    "Модель — файл TOML. Величины — строки с единицами, латинскими или русскими: `\"20 g\"`, `\"12,5 кг\"`, `\"1450 об/мин\"`, `\"30°\"`. \
     Числа без единиц безразмерны; 0 подходит к любой размерности. Любая другая строка — формула: имена, `+ - * / ^`, скобки, функции, \
     `pi`, `t`, штрихи производных по времени (`phi'`), единицы в квадратных скобках после числа (`30 [рад/с^2] * t`). \
     В единицах `/` относится только к следующему множителю: `Н м с/рад`. Ключи с греческими и русскими буквами берут в кавычки: `\"φ\" = \"rad\"`.",
);

fn section(out: &mut String, table: &TableSpec, language: Language) {
    let title = match table.name {
        "" => language.pick(("Top level", "Верхний уровень")).to_owned(),
        "study" | "phases" | "claims" => format!("`[[{}]]`", table.name),
        "parameters" | "coordinates" | "points" | "outputs" | "variants" => format!("`[{}]`", table.name),
        "inertia" | "plot" | "text" | "wound" | "circle" | "parts" => {
            format!("`{{ {} }}`", table.fields.iter().map(|f| f.key).collect::<Vec<_>>().join(", "))
        }
        name => format!("`[{name}.NAME]`"),
    };
    let _ = writeln!(out, "## {title}\n\n{}\n", language.pick(table.about));
    if let Some(short) = table.short {
        let _ = writeln!(out, "{}: `{}`.\n", language.pick(("Short form", "Краткая запись")), language.pick(short));
    }
    let _ = writeln!(out, "{}\n|---|---|---|---|---|---|", language.pick(HEADER));
    for f in table.fields {
        let default = if f.required { language.pick(("**required**", "**обязателен**")) } else { f.default };
        let example = if f.example.is_empty() { String::new() } else { format!("`{}`", f.example) };
        let (kind, about) = (language.pick(f.ty.words()), language.pick(f.about));
        let _ = writeln!(out, "| `{}` | {kind} | {} | {default} | {about} | {example} |", f.key, f.dimension);
    }
    let _ = writeln!(out);
    if !table.example.is_empty() {
        let _ = writeln!(out, "```toml\n{}```\n", table.example);
    }
}

const HEADER: (&str, &str) =
    ("| key | value | dimension | default | meaning | example |", "| ключ | значение | размерность | по умолчанию | смысл | пример |");

fn functions(out: &mut String, language: Language) {
    let _ = writeln!(out, "## {}\n", language.pick(("Functions", "Функции")));
    let names: Vec<String> = symbolic::Function::ALL.iter().map(|(_, n)| format!("`{n}`")).collect();
    let _ = writeln!(
        out,
        "{}, `sqrt`, `cbrt`, `ln` (= `log`), `lg` (= `log10`), `if(a < b, x, y)` (`<`, `<=`, `>`, `>=`, `and`, `or`, `not`).\n",
        names.join(", ")
    );
    let _ = writeln!(
        out,
        "{}\n",
        language.pick((
            "`log` and `ln` are natural, `lg` and `log10` to the base 10; angles are in radians; `min` and `max` take two or more. `if(a < b and not c < d, x, y)`: `and` binds closer than `or`, brackets group.",
            "`log` и `ln` — натуральный логарифм, `lg` и `log10` — десятичный; углы в радианах; у `min` и `max` два аргумента и больше. `if(a < b and not c < d, x, y)`: `and` связывает сильнее, чем `or`, скобки группируют.",
        ))
    );
    let _ = writeln!(out, "{}\n|---|---|", language.pick(("| kinematic function | meaning |", "| кинематическая функция | смысл |")));
    for f in KINEMATIC_FUNCTIONS {
        use crate::formula::Takes;
        let argument = match f.takes {
            Takes::Point => "A",
            Takes::Frame => "B",
            Takes::BodyOrNothing => "B",
            Takes::Nothing => "",
            Takes::Element | Takes::Acting => "S",
        };
        let _ = writeln!(out, "| `{}({argument})` | {} |", f.name, language.pick((f.en, f.ru)));
    }
    let _ = writeln!(out);
}

fn units(out: &mut String, language: Language) {
    let _ = writeln!(out, "## {}\n", language.pick(("Units", "Единицы")));
    let _ = writeln!(out, "{}\n|---|---|---|", language.pick(("| names | SI value | prefixes |", "| имена | значение в СИ | приставки |")));
    for unit in crate::units::listed() {
        let prefixes = if unit.prefixed { language.pick(("yes", "да")) } else { "" };
        let names: Vec<String> = unit.names.iter().map(|n| format!("`{n}`")).collect();
        let _ = writeln!(out, "| {} | {} | {prefixes} |", names.join(", "), unit.value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_unit_and_function_is_in_both_references() {
        for language in [Language::English, Language::Russian] {
            let text = markdown(language);
            for table in fields::all() {
                assert!(table.fields.iter().all(|f| text.contains(&format!("| `{}` |", f.key))), "{}", table.name);
            }
            assert!(text.contains("`rpm`") && text.contains("`кгс`") && text.contains("`vx(A)`"));
        }
    }
}
