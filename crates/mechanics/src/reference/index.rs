//! The first page: how a file is written, the chapters, every table and every key with the way to them.

use super::formulas;
use super::link::{self, INDEX, Place, file, heading, path, pick};
use crate::asked::Kinds;
use crate::fields::{self, Words};
use algebra::arrange::Arrange;
use std::collections::BTreeMap;
use std::fmt::Write;
use words::Language;

const INTRODUCTION: Words = (
    "A model is a TOML file. Quantities are strings with units, in Latin or Cyrillic: `\"20 g\"`, `\"12,5 кг\"`, `\"1450 rpm\"`, `\"30°\"`. \
     Bare numbers have no dimension; 0 fits every dimension. Any other string is a formula: names, `+ - * / ^`, brackets, functions, \
     `pi`, `t`, primes for time derivatives (`phi'`), units in square brackets after a number (`30 [rad/s^2] * t`). \
     In units `/` divides by the next factor only: `N m s/rad`. Names with Greek or Cyrillic letters need quotes as keys: `\"φ\" = \"rad\"`.",
    "Модель — файл TOML. Величины — строки с единицами, латинскими или русскими: `\"20 g\"`, `\"12,5 кг\"`, `\"1450 об/мин\"`, `\"30°\"`. \
     Числа без единиц безразмерны; 0 подходит к любой размерности. Любая другая строка — формула: имена, `+ - * / ^`, скобки, функции, \
     `pi`, `t`, штрихи производных по времени (`phi'`), единицы в квадратных скобках после числа (`30 [рад/с^2] * t`). \
     В единицах `/` относится только к следующему множителю: `Н м с/рад`. Ключи с греческими и русскими буквами берут в кавычки: `\"φ\" = \"rad\"`.",
);

/// The page.
pub fn text(language: Language, studies: &Kinds) -> String {
    let (title, other) = language.pick(("The model file", "По-русски"), ("Файл модели", "In English"));
    let across = format!("{INDEX}{}", link::ending(language.pick(Language::Ru, Language::En)));
    let mut out = format!("# {title}\n\n[{other}]({across})\n\n{}\n\n", pick(language, INTRODUCTION));
    chapters(&mut out, language);
    tables(&mut out, language);
    keys(&mut out, studies, language);
    out
}

fn chapters(out: &mut String, language: Language) {
    let _ = writeln!(out, "## {}\n", pick(language, ("Chapters", "Главы")));
    let _ = writeln!(out, "{}\n|---|---|", pick(language, ("| chapter | what is in it |", "| глава | содержание |")));
    let made = fields::CHAPTERS.iter().map(|c| (c.file, c.title, c.about));
    for (name, title, about) in made.chain(formulas::CHAPTERS.iter().map(|c| (c.file, c.title, c.about))) {
        let _ = writeln!(out, "| [{}]({INDEX}/{}) | {} |", pick(language, title), file(name, language), pick(language, about));
    }
    let _ = writeln!(out);
}

/// Every table by its name, with the first sentence of what it is about.
fn tables(out: &mut String, language: Language) {
    let _ = writeln!(out, "## {}\n", pick(language, ("Tables", "Таблицы")));
    let _ = writeln!(out, "{}\n|---|---|", pick(language, ("| table | meaning |", "| таблица | смысл |")));
    let mut all: Vec<Place> = link::places().collect();
    all.arrange_by_key(|p| p.table.name);
    for place in all {
        let about = pick(language, place.table.about);
        let sentence = about.split_once(". ").map_or(about, |(first, _)| first).trim_end_matches('.');
        let _ = writeln!(out, "| {} | {sentence} |", linked(&place, &heading(place.table, language), language));
    }
    let _ = writeln!(out);
}

/// Every key with the tables that have it.
fn keys(out: &mut String, studies: &Kinds, language: Language) {
    let _ = writeln!(out, "## {}\n", pick(language, ("Keys", "Ключи")));
    let _ = writeln!(out, "{}\n|---|---|", pick(language, ("| key | of |", "| ключ | таблица |")));
    let mut places: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for place in link::places() {
        for field in place.table.fields {
            let name = if place.table.name.is_empty() { heading(place.table, language) } else { format!("`{}`", place.table.name) };
            places.entry(field.key).or_default().push(linked(&place, &name, language));
        }
        // the keys of all kinds stand below the table of studies
        let further = if place.table.name == "study" { &studies.list[..] } else { &[] };
        for key in further.iter().flat_map(|kind| kind.keys) {
            let link = linked(&place, "`study`", language);
            let known = places.entry(key.name).or_default();
            if !known.contains(&link) {
                known.push(link);
            }
        }
    }
    for (key, of) in places {
        let _ = writeln!(out, "| `{key}` | {} |", of.join(", "));
    }
}

fn linked(place: &Place, name: &str, language: Language) -> String {
    format!("[{name}]({INDEX}/{})", path(place, language))
}
