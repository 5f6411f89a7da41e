//! A table of the file as a table of the reference.

use super::link::{self, pick};
use crate::asked::Kinds;
use crate::fields::{Field, TableSpec, Words};
use std::fmt::Write;
use words::Language;

/// What stands below the heading of a table.
pub fn section(out: &mut String, table: &TableSpec, language: Language) {
    let _ = writeln!(out, "{}\n", pick(language, table.about));
    if let Some(short) = table.short {
        let _ = writeln!(out, "{}: `{}`.\n", pick(language, ("Short form", "Краткая запись")), pick(language, short));
    }
    let _ = writeln!(out, "{}\n|---|---|---|---|---|---|", pick(language, HEADER));
    for field in table.fields {
        row(out, field, (&key(table, field, language), default_in(field.default, language)), language);
    }
    let _ = writeln!(out);
    if !table.example.is_empty() {
        let _ = writeln!(out, "```toml\n{}```\n", table.example);
    }
}

const HEADER: Words =
    ("| key | value | dimension | default | meaning | example |", "| ключ | значение | размерность | по умолчанию | смысл | пример |");

fn row(out: &mut String, f: &Field, (key, default): (&str, &str), language: Language) {
    let default = if f.required { pick(language, ("**required**", "**обязателен**")) } else { default };
    let example = if f.example.is_empty() { String::new() } else { format!("`{}`", f.example) };
    let (kind, about, dimension) = (pick(language, f.ty.words()), pick(language, f.about), dimension(f.dimension, language));
    let _ = writeln!(out, "| {key} | {kind} | {dimension} | {default} | {about} | {example} |");
}

/// The key; on the top level it leads to its table.
fn key(table: &TableSpec, field: &Field, language: Language) -> String {
    let own = link::places().find(|p| table.name.is_empty() && p.table.name == field.key);
    own.map_or(format!("`{}`", field.key), |p| format!("[`{}`]({})", field.key, link::path(&p, language)))
}

/// The SI unit of a value in the letters of the language.
fn dimension(label: &'static str, language: Language) -> String {
    match (language, label) {
        (Language::En, _) => label.to_owned(),
        (Language::Ru, "time") => "время".into(),
        (Language::Ru, _) => crate::units::in_russian(label),
    }
}

/// Defaults in words; what is written in the file as it stands is the same in both languages.
const DEFAULTS: &[(&str, &str)] = &[
    ("the place at the start", "положение в начале движения"),
    ("line of the centres", "линия центров"),
    ("not known", "неизвестно"),
    ("value", "`value`"),
    ("the other", "текст на другом языке"),
    ("start", "начальное значение"),
    ("origin of the body", "начало координат тела"),
    (
        "true for undivided rods of frames with at most 100 independent displacements",
        "true для неделённых стержней рам с числом независимых перемещений не больше 100",
    ),
    ("length", "длина"),
    ("kinetic at u = 0", "kinetic при u = 0"),
    ("coefficient at u = 0", "coefficient при u = 0"),
    ("lever at u = 0", "lever при u = 0"),
    ("see above", "см. выше"),
    ("force of the named contact, pin or rope", "сила названного контакта, шарнира или каната"),
    ("angle by which the rope turns at `over`", "угол поворота каната в точках `over`"),
    ("along the track; normal of the stop turned by −90°", "вдоль пути; нормаль упора, повёрнутая на −90°"),
    ("first column", "первый столбец"),
    ("claim N", "утверждение N"),
    ("the id", "идентификатор"),
    ("pure number", "безразмерная"),
    ("first that fits", "первый подходящий"),
    ("both", "оба"),
    ("body that carries its axis", "тело, несущее его ось"),
    ("body of the points", "тело этих точек"),
    ("all others", "все остальные"),
    ("SI", "СИ"),
];

fn default_in(default: &'static str, language: Language) -> &'static str {
    let russian = || DEFAULTS.iter().find(|(en, _)| *en == default).map(|(_, ru)| *ru);
    if language == Language::En { default } else { russian().unwrap_or(default) }
}

/// The kinds of studies, each with its keys.
pub fn kinds(out: &mut String, studies: &Kinds, language: Language) {
    for kind in &studies.list {
        let _ = writeln!(out, "### `kind = \"{}\"`\n\n{}.\n", kind.name, pick(language, kind.about));
        if kind.keys.is_empty() {
            continue;
        }
        let _ = writeln!(out, "{}\n|---|---|---|---|---|---|", pick(language, HEADER));
        for key in kind.keys {
            row(out, &key.field(), (&format!("`{}`", key.name), pick(language, key.default)), language);
        }
        let _ = writeln!(out);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fields;

    #[test]
    fn defaults_in_words_are_translated() {
        let defaults = fields::all().flat_map(|t| t.fields).map(|f| f.default);
        for default in defaults.filter(|d| d.contains(' ') && !d.contains(['[', '"'])) {
            assert!(DEFAULTS.iter().any(|(en, _)| *en == default), "{default}");
        }
    }
}
