//! `[[study]]`: which kinds there are and what their keys take is declared above this crate; here the values are read, one function for each way of
//! writing them.

mod frequencies;
mod names;
pub(super) mod observed;
mod plot;
mod repeated;
mod times;

use crate::asked::{Asked, Choice, Key, Kind, Kinds, Like, Limits, Objection, Takes, Value, Written};
use crate::formula::{Context, Kind as Sort};
use crate::reader::names::names;
use crate::reader::{Fields, Reader, short, string, wrong_type};
use crate::units::{Dimension, si_label};
use plot::{Axis, plots};
use toml::de::DeValue;
use words::Notice;
use words::digits::typed;

/// The studies, in order.
pub(super) fn read<'a>(reader: &mut Reader<'a>, top: &Fields<'a>, kinds: &Kinds) -> Vec<Asked> {
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
        let fields = Fields::open(reader, kinds.spec, table, item.span(), "study".to_owned());
        found.extend(study(reader, &fields, kinds));
    }
    found
}

fn study<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, kinds: &Kinds) -> Option<Asked> {
    let (name, span) = string(reader, fields.get("kind")?, "a string", "строка")?;
    if let Some(kind) = kinds.find(&name) {
        misplaced(reader, fields, (kind, kinds));
        return Some(asked(reader, fields, (kind, kinds)));
    }
    let names: Vec<&str> = kinds.list.iter().map(|kind| kind.name).collect();
    let fault = Notice::piece("M064", span, format!("unknown study `{}`", short(&name)), format!("неизвестный расчёт `{}`", short(&name)));
    let fault = match reader.scope.nearest(&name, names.iter().copied()) {
        Some(near) => fault.meant(&name, near),
        None => fault.help(format!("known studies: {}", names.join(", ")), format!("известные расчёты: {}", names.join(", "))),
    };
    reader.fault(fault);
    None
}

/// Keys that belong to another kind of study.
fn misplaced<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, (kind, kinds): (&Kind, &Kinds)) {
    for key in kinds.spec.fields.iter().map(|f| f.key).filter(|key| *key != "kind") {
        if kind.key(key).is_none() && fields.has(key) {
            let kind = kind.name;
            reader.fault(Notice::piece(
                "M005",
                fields.span_of(key),
                format!("`{key}` does not belong to the study `{kind}`"),
                format!("ключ `{key}` не относится к расчёту `{kind}`"),
            ));
        }
    }
}

/// The values, key by key, and what they contradict.
fn asked<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, (kind, kinds): (&Kind, &Kinds)) -> Asked {
    let mut asked = Asked::new(kind.name);
    asked.span = fields.span.clone();
    for key in kind.keys.iter().filter(|key| fields.has(key.name)) {
        asked.note(key.name);
    }
    for key in kind.keys {
        if key.required && !asked.has(key.name) {
            let fault = lacking(fields, kind, key);
            reader.fault(fault);
        }
        if let Some((other, code)) = key.excluded.filter(|(other, _)| asked.has(key.name) && asked.has(other)) {
            let key = key.name;
            let (en, ru) = (format!("both `{other}` and `{key}` are given"), format!("заданы и `{other}`, и `{key}`"));
            reader.fault(Notice::piece(code, fields.span_of(key), en, ru).help("keep one", "оставьте одно"));
        }
        if asked.has(key.name)
            && let Some(value) = value(reader, fields, (key, &asked), kinds)
        {
            asked.set(key.name, value);
        }
    }
    for Objection { code, at, what, why, help } in (kind.check)(&asked) {
        let span = at.map_or(fields.span.clone(), |key| fields.span_of(key));
        reader.fault(Notice::piece(code, span, what.en, what.ru).why(why.en, why.ru).help(help.en, help.ru));
    }
    asked
}

fn lacking(fields: &Fields<'_>, kind: &Kind, key: &Key) -> Notice {
    let (study, name, path) = (kind.name, key.name, &fields.path);
    if matches!(key.takes, Takes::Coordinate) {
        let fault = Notice::piece("M006", fields.span.clone(), format!("{path} lacks `{name}`"), format!("в {path} не хватает `{name}`"));
        return fault
            .help(format!("add {name} = \"phi\", the name of a coordinate"), format!("добавьте {name} = \"phi\" — имя координаты"));
    }
    let (en, ru) = (format!("the study {study} lacks `{name}`"), format!("в расчёте {study} не хватает `{name}`"));
    let russian = key.example.replace("m/s", "м/с").replace(" s\"", " с\"");
    Notice::piece("M006", fields.span.clone(), en, ru).help(format!("add {name} = {}", key.example), format!("добавьте {name} = {russian}"))
}

/// The value of a key; those that stand before it in the kind's list are known.
fn value<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, (key, before): (&Key, &Asked), kinds: &Kinds) -> Option<Value> {
    let (name, raw) = (key.name, fields.get(key.name)?);
    match key.takes {
        Takes::End | Takes::Duration => times::duration(reader, fields, name).map(Value::Number),
        Takes::Step => times::step(reader, fields, (name, before.number("until"))).map(Value::Number),
        Takes::Moments => Some(Value::Numbers(times::moments(reader, raw, before.number("until")))),
        Takes::Wait => times::waiting(reader, fields, name).map(Value::Number),
        Takes::Tolerance => times::tolerance(reader, fields, name).map(Value::Number),
        Takes::Number(limits) => number(reader, fields, (name, limits), Some(&Dimension::NONE)).map(Value::Number),
        Takes::Quantity(like, limits) => {
            let dimension = dimension_of(reader, before, like);
            number(reader, fields, (name, limits), dimension.as_ref()).map(Value::Number)
        }
        Takes::Count(code, least) => count(reader, fields, (name, code), least).map(Value::Number),
        Takes::Flag => fields.flag(reader, name).map(Value::Flag),
        Takes::Word(choice) => word(reader, fields, (name, choice)).map(Value::Word),
        Takes::Coordinate => names::coordinate(reader, fields, name).map(Value::Coordinate),
        Takes::Sought => names::constant_parameter(reader, fields, name).map(Value::Word),
        Takes::Varied => {
            let (parameter, span) = fields.name(reader, name)?;
            frequencies::parameter(reader, &parameter, span).map(|_| Value::Word(parameter))
        }
        Takes::Name => fields.name(reader, name).map(|(name, _)| Value::Word(name)),
        Takes::RangeOf(over) => {
            let wanted = named(reader, before.get(over)?);
            frequencies::ascending(reader, raw, wanted.as_ref()).map(|ends| Value::Numbers(ends.to_vec()))
        }
        Takes::Between(over) => {
            let (name, wanted) = (before.word(over)?.to_owned(), named(reader, before.get(over)?));
            let ends = frequencies::ascending(reader, raw, wanted.as_ref())?;
            repeated::with_units(reader, raw, &name).then(|| Value::Numbers(ends.to_vec()))
        }
        Takes::Changed => {
            let (name, span) = fields.name(reader, name)?;
            repeated::changed(reader, &name, span).map(|_| Value::Word(name))
        }
        Takes::FrequencyRange => frequencies::band(reader, raw).map(|ends| Value::Numbers(ends.to_vec())),
        Takes::Frequencies => {
            Some(Value::Numbers(frequencies::quantities(reader, raw, (Some(&Dimension::ANGULAR_RATE), frequencies::Periods::Turn))))
        }
        Takes::Results => Some(Value::Words(names::outputs(reader, raw))),
        Takes::Observed => Some(Value::Words(observed::read(reader, raw))),
        Takes::Plots => Some(Value::Plots(plots(reader, raw, Axis::Time))),
        Takes::OwnPlots => Some(Value::Plots(plots(reader, raw, Axis::Over))),
        Takes::Guess => Some(Value::Guess(names::guess(reader, fields, name))),
        Takes::Driven(over) => {
            let over = before.coordinate(over).map(|c| c.symbol);
            Some(Value::Driven(names::driven_too(reader, fields, (name, over))))
        }
        Takes::Section => names::section(reader, fields, name),
        Takes::Formulas => Some(Value::Formulas(formulas(reader, raw))),
        Takes::FrequencyVariable => frequencies::variable(reader, fields, name).map(Value::Variable),
        Takes::Ranges => Some(Value::Ranges(repeated::ranges(reader, raw))),
        Takes::Stretch => repeated::stretch(reader, raw).map(|range| Value::Ranges(vec![range])),
        Takes::Repeatable => repeated::kind(reader, fields, (name, kinds)).map(Value::Word),
    }
}

/// The dimension of a coordinate, parameter or observed number that another key names.
fn named(reader: &Reader<'_>, value: &Value) -> Option<Dimension> {
    match value {
        Value::Coordinate(named) => named.dimension,
        Value::Word(name) => repeated::dimension(reader, name),
        Value::Words(texts) => observed::dimension(reader, texts.first()?),
        _ => None,
    }
}

fn known(kind: Option<Sort>) -> Option<Dimension> {
    if let Some(Sort::Known(dimension)) = kind { Some(dimension) } else { None }
}

fn dimension_of(reader: &Reader<'_>, before: &Asked, like: Like) -> Option<Dimension> {
    let of = |key: &str| named(reader, before.get(key)?);
    match like {
        Like::Is(dimension, _) => Some(dimension),
        Like::Of(key) => of(key),
        Like::RateOf(key) => of(key).map(|d| d.per_time(1)),
    }
}

/// A constant within limits.
fn number<'a>(
    reader: &mut Reader<'a>,
    fields: &Fields<'a>,
    (key, limits): (&'static str, Limits),
    wanted: Option<&Dimension>,
) -> Option<f64> {
    let value = fields.formula(reader, key, &Context::CONSTANT, wanted)?;
    let number = reader.number(&value)?;
    let (within, words) = match limits {
        Limits::None => return Some(number),
        Limits::NotZero => (number != 0.0, ("different from 0", "отлично от 0")),
        Limits::UpToTwo => (number > 0.0 && number < 2.0, ("between 0 and 2", "от 0 до 2")),
    };
    if !within {
        reader.fault(Notice::piece(
            "M071",
            fields.span_of(key),
            format!("`{key}` is {}; it must be {}", typed(number).en, words.0),
            format!("`{key}` равно {}; должно быть {}", typed(number).ru, words.1),
        ));
    }
    within.then_some(number)
}

/// A whole number from 2 to 1000000.
fn count<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, (key, code): (&'static str, &'static str), least: usize) -> Option<f64> {
    let value = fields.formula(reader, key, &Context::CONSTANT, Some(&Dimension::NONE))?;
    let number = reader.number(&value)?;
    if number.fract() != 0.0 || !(least as f64..=1e6).contains(&number) {
        reader.fault(Notice::piece(
            code,
            fields.span_of(key),
            format!("`{key}` is {}; a whole number from {least} to 1000000 is needed", typed(number).en),
            format!("`{key}` равно {}; нужно целое от {least} до 1000000", typed(number).ru),
        ));
        return None;
    }
    Some(number)
}

fn word<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, (key, choice): (&'static str, &Choice)) -> Option<String> {
    let (word, span) = string(reader, fields.get(key)?, "a string", "строка")?;
    if choice.words.contains(&word.as_str()) {
        return Some(word);
    }
    let (en, ru) = (choice.unknown.0.replace("{}", &short(&word)), choice.unknown.1.replace("{}", &short(&word)));
    reader.fault(Notice::piece(choice.code, span, en, ru).help(choice.help.0, choice.help.1));
    None
}

/// Formulas over coordinates, rates and time, each with its text and the SI label of its value.
fn formulas<'a>(reader: &mut Reader<'a>, value: &'a crate::reader::syntax::Value<'a>) -> Vec<Written> {
    let listed = names(reader, value);
    let items = value.get_ref().as_array().map(|items| items.iter().collect::<Vec<_>>()).unwrap_or_default();
    let mut found = Vec::new();
    for ((text, _), item) in listed.into_iter().zip(items) {
        let Some(raw) = reader.raw(item) else { continue };
        let checked = reader.value(&raw, &Context::MOTION, None);
        let unit = known(Some(checked.kind)).map_or_else(String::new, |d| si_label(&d));
        found.extend(checked.good.then(|| Written { text: text.trim().to_owned(), formula: checked.expr, unit }));
    }
    found
}
