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
        "parameters" | "coordinates" | "points" | "outputs" | "variants" | "structure" => format!("`[{}]`", table.name),
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
        let default =
            if f.required { language.pick(("**required**", "**обязателен**")) } else { default_in(f.default, language) };
        let example = if f.example.is_empty() { String::new() } else { format!("`{}`", f.example) };
        let (kind, about, dimension) = (language.pick(f.ty.words()), language.pick(f.about), dimension(f.dimension, language));
        let _ = writeln!(out, "| `{}` | {kind} | {dimension} | {default} | {about} | {example} |", f.key);
    }
    if table.name == "study" {
        kinds(out, language);
    }
    let _ = writeln!(out);
    if !table.example.is_empty() {
        let _ = writeln!(out, "```toml\n{}```\n", table.example);
    }
}

/// The SI unit of a value in the letters of the language.
fn dimension(label: &'static str, language: Language) -> String {
    match (language, label) {
        (Language::English, _) => label.to_owned(),
        (Language::Russian, "time") => "время".into(),
        (Language::Russian, _) => crate::units::in_russian(label),
    }
}

/// Defaults in words; what is written in the file as it stands is the same in both languages.
const DEFAULTS: &[(&str, &str)] = &[
    ("the place at the start", "положение в начале движения"),
    ("line of the centres", "линия центров"),
    ("value", "`value`"),
    ("the other", "текст на другом языке"),
    ("start", "начальное значение"),
    ("origin of the body", "начало координат тела"),
    (
        "true for undivided rods of frames with at most 100 independent displacements",
        "true для неделённых стержней рам с числом независимых перемещений не больше 100",
    ),
    ("starting rate, else 1", "начальная скорость, иначе 1"),
    ("starting rate", "начальная скорость"),
    ("length", "длина"),
    ("kinetic at u = 0", "kinetic при u = 0"),
    ("coefficient at u = 0", "coefficient при u = 0"),
    ("lever at u = 0", "lever при u = 0"),
    ("see above", "см. выше"),
    ("force of the named contact, pin or rope", "сила названного контакта, шарнира или каната"),
    ("angle by which the rope turns at `over`", "угол поворота каната в точках `over`"),
    ("along the track; normal of the stop turned by −90°", "вдоль пути; нормаль упора, повёрнутая на −90°"),
    ("first that fits", "первый подходящий"),
    ("first column", "первый столбец"),
    ("claim N", "утверждение N"),
    ("both", "оба"),
    ("body that carries its axis", "тело, несущее его ось"),
    ("body of the points", "тело этих точек"),
    ("all others", "все остальные"),
    ("SI", "СИ"),
];

fn default_in(default: &'static str, language: Language) -> &'static str {
    let russian = || DEFAULTS.iter().find(|(en, _)| *en == default).map(|(_, ru)| *ru);
    if language == Language::English { default } else { russian().unwrap_or(default) }
}

/// Which keys belong to which kind of study.
fn kinds(out: &mut String, language: Language) {
    let _ = writeln!(out, "\n{}\n|---|---|", language.pick(("| kind of study | its keys |", "| вид расчёта (`kind`) | его ключи |")));
    for (name, keys) in crate::read::kinds_of_studies() {
        let keys: Vec<String> = keys.iter().map(|key| format!("`{key}`")).collect();
        let _ = writeln!(out, "| `{name}` | {} |", keys.join(", "));
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
            "`log` and `ln` are natural, `lg` and `log10` to the base 10; angles are in radians; `min` and `max` take two or more. `if(a < b and not c < d, x, y)`: `and` binds closer than `or`, brackets group. Functions that jump at every whole number (`floor`, `round`, `mod`) are not known: their jumps would be as many events; write the pieces with `if`, a wave by `sin`.",
            "`log` и `ln` — натуральный логарифм, `lg` и `log10` — десятичный; углы в радианах; у `min` и `max` два аргумента и больше. `if(a < b and not c < d, x, y)`: `and` связывает сильнее, чем `or`, скобки группируют. Функций со скачком в каждом целом числе (`floor`, `round`, `mod`) нет: их скачки были бы бесчисленными событиями; запишите участки через `if`, волну — через `sin`.",
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
        let value = if language == Language::English { unit.value } else { unit.value_ru };
        let _ = writeln!(out, "| {} | {value} | {prefixes} |", names.join(", "));
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

    #[test]
    fn units_are_written_in_the_letters_of_the_language() {
        let text = markdown(Language::Russian);
        for piece in ["| м/с² |", "| кг·м² |", "| Н·с/м |", "| время |", "0,001 кг", "π/30 рад/с", "| 0,01 |"] {
            assert!(text.contains(piece), "{piece}");
        }
        let tables: String = text.lines().filter(|l| l.starts_with("| `")).filter_map(|l| l.split('|').nth(3)).collect();
        assert!(!tables.chars().any(|c| c.is_ascii_alphabetic()), "{tables}");
    }

    #[test]
    fn defaults_in_words_are_translated() {
        let defaults = fields::all().flat_map(|t| t.fields).map(|f| f.default);
        for default in defaults.filter(|d| d.contains(' ') && !d.contains(['[', '"'])) {
            assert!(DEFAULTS.iter().any(|(en, _)| *en == default), "{default}");
        }
    }
}
