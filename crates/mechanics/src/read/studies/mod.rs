//! `[[study]]`: one file per kind and one line in [`KINDS`].

mod cycle;
mod equilibrium;
mod inverse;
mod kinematics;
mod linear;
mod periodic;
mod plot;
mod simulate;
mod statics;
mod sweep;
mod transient;

use super::parameters::names;
use super::reader::{Fields, Reader, string, wrong_type};
use crate::fields;
use crate::formula::{Context, EntryKind, Kind};
use crate::model::{DEFAULT_TOLERANCE, Study, StudyKind};
use crate::snippet::nearest;
use crate::units::Dimension;
use std::ops::Range;
use symbolic::SymbolId;
use toml::de::DeValue;
use words::Notice;

/// A kind of study: its name, the keys that belong to it, how it is read.
struct Row {
    name: &'static str,
    keys: &'static [&'static str],
    read: for<'a> fn(&mut Reader<'a>, &Fields<'a>) -> Option<StudyKind>,
}

const KINDS: &[Row] = &[
    Row { name: "equations", keys: &[], read: |_, _| Some(StudyKind::Equations) },
    Row { name: "equilibrium", keys: &["guess", "over", "range"], read: equilibrium::read },
    Row { name: "modes", keys: &["guess", "about", "normalise", "frequency_variable", "over", "range", "points"], read: linear::modes },
    Row { name: "response", keys: &["guess", "load", "over", "range", "points", "log", "outputs", "shapes"], read: linear::response },
    Row { name: "simulate", keys: &["until", "every", "at", "tolerance", "method", "outputs", "plot"], read: simulate::read },
    Row { name: "transient", keys: &["until", "every", "at", "tolerance", "outputs", "plot", "linearise"], read: transient::read },
    Row { name: "inverse", keys: &["until", "every", "at", "tolerance", "outputs", "plot"], read: inverse::read },
    Row { name: "statics", keys: &[], read: statics::read },
    Row { name: "kinematics", keys: &["over", "from", "to", "turns", "points", "rate", "with", "outputs", "plot"], read: kinematics::read },
    Row {
        name: "periodic",
        keys: &["section", "turns", "period", "settle", "unknown", "wanted_period", "every", "at", "tolerance", "outputs", "plot"],
        read: periodic::read,
    },
    Row {
        name: "cycle",
        keys: &["angle", "turns", "speed", "period", "unknown", "irregularity", "flywheel", "points", "plot"],
        read: cycle::read,
    },
    Row { name: "sweep", keys: &["over", "observe", "of", "plot"], read: sweep::read },
];

/// The kinds of studies with the keys that belong to them.
pub(crate) fn kinds() -> impl Iterator<Item = (&'static str, &'static [&'static str])> {
    KINDS.iter().map(|row| (row.name, row.keys))
}

/// The studies, in order.
pub(super) fn read<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Vec<Study> {
    let Some(value) = top.get("study") else { return Vec::new() };
    let DeValue::Array(items) = value.get_ref() else {
        reader.fault(
            wrong_type(value.span(), "an array of tables", "массив таблиц", value.get_ref().type_str())
                .help("write [[study]] with double brackets", "напишите [[study]] в двойных скобках"),
        );
        return Vec::new();
    };
    let mut found = Vec::new();
    for item in items.iter() {
        let DeValue::Table(table) = item.get_ref() else {
            reader.fault(wrong_type(item.span(), "a table", "таблица", item.get_ref().type_str()));
            continue;
        };
        let fields = Fields::open(reader, &fields::STUDY, table, item.span(), "study".to_owned());
        if let Some(kind) = study(reader, &fields) {
            found.push(Study { kind, span: item.span() });
        }
    }
    found
}

fn study<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<StudyKind> {
    let (kind, span) = string(reader, fields.get("kind")?, "a string", "строка")?;
    if let Some(row) = KINDS.iter().find(|row| row.name == kind) {
        misplaced(reader, fields, row);
        return (row.read)(reader, fields);
    }
    let names: Vec<&str> = KINDS.iter().map(|row| row.name).collect();
    let fault = Notice::piece(
        "M064",
        span,
        format!("unknown study `{}`", super::reader::short(&kind)),
        format!("неизвестный расчёт `{}`", super::reader::short(&kind)),
    );
    let fault = match nearest(&kind, names.iter().copied()) {
        Some(near) => fault.meant(&kind, near),
        None => fault.help(format!("known studies: {}", names.join(", ")), format!("известные расчёты: {}", names.join(", "))),
    };
    reader.fault(fault);
    None
}

/// Keys that belong to another kind of study.
fn misplaced<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, row: &Row) {
    for key in fields::STUDY.fields.iter().map(|f| f.key).filter(|key| *key != "kind") {
        if !row.keys.contains(&key) && fields.has(key) {
            let kind = row.name;
            reader.fault(Notice::piece(
                "M005",
                fields.span_of(key),
                format!("`{key}` does not belong to the study `{kind}`"),
                format!("ключ `{key}` не относится к расчёту `{kind}`"),
            ));
        }
    }
}

/// A positive time.
fn duration<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Option<f64> {
    let value = fields.formula(reader, key, &Context::CONSTANT, Some(&Dimension::TIME))?;
    let number = reader.number(&value)?;
    if number <= 0.0 {
        reader.fault(Notice::piece(
            "M065",
            fields.span_of(key),
            format!("`{key}` is {number} s; it must be positive"),
            format!("`{key}` равно {number} с; должно быть положительным"),
        ));
        return None;
    }
    Some(number)
}

/// A time that may be zero.
fn waiting<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Option<f64> {
    let value = fields.formula(reader, key, &Context::CONSTANT, Some(&Dimension::TIME))?;
    let number = reader.number(&value)?;
    if number < 0.0 {
        reader.fault(Notice::piece(
            "M065",
            fields.span_of(key),
            format!("`{key}` is {number} s; it must not be negative"),
            format!("`{key}` равно {number} с; отрицательным быть не может"),
        ));
        return None;
    }
    Some(number)
}

fn tolerance<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> f64 {
    let Some(value) = fields.formula(reader, "tolerance", &Context::CONSTANT, Some(&Dimension::NONE)) else { return DEFAULT_TOLERANCE };
    let Some(number) = reader.number(&value) else { return DEFAULT_TOLERANCE };
    if !(1e-15..=1e-3).contains(&number) {
        reader.fault(
            Notice::piece(
                "M065",
                fields.span_of("tolerance"),
                format!("the tolerance is {number:e}; it must lie between 1e-15 and 1e-3"),
                format!("допустимая погрешность {number:e}; она должна лежать между 1e-15 и 1e-3"),
            )
            .why("machine numbers carry 16 digits", "машинные числа несут 16 знаков"),
        );
    }
    number
}

/// The names under `outputs`.
fn outputs<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Vec<String> {
    let listed = fields.get("outputs").map(|v| names(reader, v)).unwrap_or_default();
    listed.into_iter().filter_map(|(n, span)| known(reader, n, span)).collect()
}

/// A coordinate named by a key.
struct Named {
    name: String,
    symbol: SymbolId,
    dimension: Option<Dimension>,
}

fn coordinate<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Option<Named> {
    if !fields.has(key) {
        let path = &fields.path;
        reader.fault(
            Notice::piece("M006", fields.span.clone(), format!("{path} lacks `{key}`"), format!("в {path} не хватает `{key}`"))
                .help(format!("add {key} = \"phi\", the name of a coordinate"), format!("добавьте {key} = \"phi\" — имя координаты")),
        );
    }
    let (name, span) = fields.name(reader, key)?;
    match reader.scope.get(name.trim()).map(|e| (e.kind, e.dimension)) {
        Some((EntryKind::Coordinate(symbols), kind)) => {
            let dimension = if let Kind::Known(d) = kind { Some(d) } else { None };
            Some(Named { name: name.trim().to_owned(), symbol: symbols[0], dimension })
        }
        _ => {
            let fault = no_coordinate(reader, &name, span);
            reader.fault(fault);
            None
        }
    }
}

/// M013 for what must name a coordinate, with the one that may have been meant or those that there are.
fn no_coordinate(reader: &Reader<'_>, name: &str, span: std::ops::Range<usize>) -> Notice {
    let shown = super::reader::short(name);
    let fault = Notice::piece("M013", span, format!("`{shown}` is not a coordinate"), format!("`{shown}` — не координата"));
    let is_coordinate = |name: &&str| matches!(reader.scope.get(name).map(|e| e.kind), Some(EntryKind::Coordinate(_)));
    let all: Vec<&str> = reader.scope.names().filter(is_coordinate).collect();
    let listed = |all: &[&str]| all.iter().take(20).copied().collect::<Vec<_>>().join(", ");
    match nearest(name, all.iter().copied()) {
        Some(near) => fault.meant(name, near),
        None if all.is_empty() => fault.help("the model has no coordinates", "в модели нет координат"),
        None => fault.help(format!("coordinates: {}", listed(&all)), format!("координаты: {}", listed(&all))),
    }
}

/// A parameter with a constant value, named by a key.
fn constant_parameter<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Option<String> {
    let (name, span) = fields.name(reader, key)?;
    let name = name.trim().to_owned();
    match reader.scope.get(&name).map(|e| (e.kind, e.depends)) {
        Some((EntryKind::Parameter(_), depends)) if depends.is_constant() => return Some(name),
        Some((EntryKind::Parameter(_), _)) => reader.fault(
            Notice::piece("M072", span, format!("`{name}` is not constant"), format!("`{name}` — не постоянная"))
                .why("what is looked for is one number", "ищется одно число"),
        ),
        _ => {
            let shown = super::reader::short(&name);
            let fault = Notice::piece("M072", span, format!("there is no parameter `{shown}`"), format!("нет параметра `{shown}`"));
            let fault = match nearest(&name, reader.scope.names()) {
                Some(near) => fault.meant(&name, near),
                None => fault.help("name a constant of [parameters]", "укажите постоянную из [parameters]"),
            };
            reader.fault(fault);
        }
    }
    None
}

/// How many positions a table has.
fn points<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, usual: usize) -> usize {
    let Some(value) = fields.formula(reader, "points", &Context::CONSTANT, Some(&Dimension::NONE)) else { return usual };
    let Some(number) = reader.number(&value) else { return usual };
    if number.fract() != 0.0 || !(2.0..=1e6).contains(&number) {
        reader.fault(Notice::piece(
            "M071",
            fields.span_of("points"),
            format!("`points` is {number}; a whole number from 2 to 1000000 is needed"),
            format!("`points` равно {number}; нужно целое от 2 до 1000000"),
        ));
        return usual;
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let points = number as usize;
    points
}

/// The fault of a number of a study outside its limits.
fn positive<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str, value: f64) {
    let limits = if key == "irregularity" { ("between 0 and 2", "от 0 до 2") } else { ("different from 0", "отлично от 0") };
    reader.fault(Notice::piece(
        "M071",
        fields.span_of(key),
        format!("`{key}` is {value}; it must be {}", limits.0),
        format!("`{key}` равно {value}; должно быть {}", limits.1),
    ));
}

/// The fault of turns of what is no angle.
fn angular<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) {
    reader.fault(
        Notice::piece("M071", fields.span_of(key), format!("`{key}` needs an angle"), format!("ключу `{key}` нужен угол"))
            .why("only an angle makes turns", "обороты совершает только угол"),
    );
}

/// A name of a result: coordinate with primes, or output.
fn known(reader: &mut Reader, name: String, span: Range<usize>) -> Option<String> {
    let base = name.trim_end_matches('\'');
    let primes = name.len() - base.len();
    let fits = match reader.scope.get(base).map(|e| e.kind) {
        Some(EntryKind::Coordinate(_)) => primes <= 1,
        Some(EntryKind::Output(_)) => primes == 0,
        _ => false,
    };
    let fits = fits || reader.results.contains(&name);
    if fits {
        return Some(name);
    }
    let fault = Notice::piece(
        "M066",
        span,
        format!("there is no result `{}`", super::reader::short(&name)),
        format!("нет результата `{}`", super::reader::short(&name)),
    )
    .why(
        "results are coordinates, their rates (phi') and the names in [outputs]",
        "результаты — это координаты, их скорости (phi') и имена из [outputs]",
    );
    let fault = match nearest(base, reader.scope.names()) {
        Some(near) if near != base => fault.meant(base, near),
        _ => fault.help("add it to [outputs]", "добавьте её в [outputs]"),
    };
    reader.fault(fault);
    None
}
