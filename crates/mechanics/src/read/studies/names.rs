//! Names in a study: coordinates, parameters, results, and formulas that stand beside them.

use crate::asked::{Named, Value as Asked};
use crate::formula::{Context, EntryKind, Kind};
use crate::reader::names::names;
use crate::reader::syntax::Value;
use crate::reader::{Fields, Reader, short};
use crate::units::Dimension;
use std::ops::Range;
use symbolic::{Expr, SymbolId};
use words::Notice;

/// Names of results.
pub(super) fn outputs<'a>(reader: &mut Reader<'a>, value: &'a Value<'a>) -> Vec<String> {
    names(reader, value).into_iter().filter_map(|(n, span)| known(reader, n, span)).collect()
}

/// A coordinate.
pub(super) fn coordinate<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Option<Named> {
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
fn no_coordinate(reader: &Reader<'_>, name: &str, span: Range<usize>) -> Notice {
    let shown = short(name);
    let fault = Notice::piece("M013", span, format!("`{shown}` is not a coordinate"), format!("`{shown}` — не координата"));
    let is_coordinate = |name: &&str| matches!(reader.scope.get(name).map(|e| e.kind), Some(EntryKind::Coordinate(_)));
    let all: Vec<&str> = reader.scope.names().filter(is_coordinate).collect();
    let listed = |all: &[&str]| all.iter().take(20).copied().collect::<Vec<_>>().join(", ");
    match reader.scope.nearest(name, all.iter().copied()) {
        Some(near) => fault.meant(name, near),
        None if all.is_empty() => fault.help("the model has no coordinates", "в модели нет координат"),
        None => fault.help(format!("coordinates: {}", listed(&all)), format!("координаты: {}", listed(&all))),
    }
}

/// A parameter with a constant value, named by a key.
pub(super) fn constant_parameter<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Option<String> {
    let (name, span) = fields.name(reader, key)?;
    let name = name.trim().to_owned();
    match reader.scope.get(&name).map(|e| (e.kind, e.depends)) {
        Some((EntryKind::Parameter(_), depends)) if depends.is_constant() => return Some(name),
        Some((EntryKind::Parameter(_), _)) => reader.fault(
            Notice::piece("M072", span, format!("`{name}` is not constant"), format!("`{name}` — не постоянная"))
                .why("what is looked for is one number", "ищется одно число"),
        ),
        _ => {
            let shown = short(&name);
            let fault = Notice::piece("M072", span, format!("there is no parameter `{shown}`"), format!("нет параметра `{shown}`"));
            let fault = match reader.scope.nearest(&name, reader.scope.names()) {
                Some(near) => fault.meant(&name, near),
                None => fault.help("name a constant of [parameters]", "укажите постоянную из [parameters]"),
            };
            reader.fault(fault);
        }
    }
    None
}

/// The rows of a table by coordinates: q, its dimension, what stands there.
fn by_coordinate<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Vec<(SymbolId, Option<Dimension>, &'a Value<'a>)> {
    let mut found = Vec::new();
    for (name, span, value) in fields.rows(reader, key) {
        match reader.scope.get(name).map(|e| (e.kind, e.dimension)) {
            Some((EntryKind::Coordinate(symbols), kind)) => {
                let dimension = if let Kind::Known(d) = kind { Some(d) } else { None };
                found.push((symbols[0], dimension, value));
            }
            _ => {
                let fault = no_coordinate(reader, name, span);
                reader.fault(fault);
            }
        }
    }
    found
}

/// Values of coordinates by name.
pub(super) fn guess<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Vec<(SymbolId, f64)> {
    let mut found = Vec::new();
    for (symbol, wanted, value) in by_coordinate(reader, fields, key) {
        if let Some(raw) = reader.raw(value) {
            let guess = reader.value(&raw, &Context::CONSTANT, wanted.as_ref());
            found.extend(reader.number(&guess).map(|v| (symbol, v)));
        }
    }
    found
}

/// The name of an angle, or a formula that passes zero from below.
pub(super) fn section<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str) -> Option<Asked> {
    let value = fields.get(key)?;
    let name = value.get_ref().as_str().map(str::trim);
    if let Some((name, entry)) = name.and_then(|n| Some((n, reader.scope.get(n)?)))
        && let (EntryKind::Coordinate(symbols), Kind::Known(d)) = (entry.kind, entry.dimension)
        && d.is_angular()
    {
        return Some(Asked::Coordinate(Named { name: name.to_owned(), symbol: symbols[0], dimension: Some(d) }));
    }
    let zero = fields.formula(reader, key, &Context::SECTION, None)?;
    if zero.good && !zero.depends.is_state() {
        reader.fault(
            Notice::piece("M071", value.span(), "the section does not depend on the motion", "сечение не зависит от движения")
                .help("write the section as a formula over coordinates and rates", "задайте сечение формулой от координат и скоростей"),
        );
        return None;
    }
    zero.good.then_some(Asked::Formula(zero.expr))
}

/// `with = { psi = "2*phi" }`: further driven coordinates.
pub(super) fn driven_too<'a>(
    reader: &mut Reader<'a>,
    fields: &Fields<'a>,
    (key, over): (&'static str, Option<SymbolId>),
) -> Vec<(SymbolId, Expr)> {
    let mut found = Vec::new();
    for (symbol, wanted, value) in by_coordinate(reader, fields, key) {
        let Some(raw) = reader.raw(value) else { continue };
        let formula = reader.value(&raw, &Context::GEOMETRY, wanted.as_ref());
        let allowed = |s: &SymbolId| Some(*s) == over;
        let of_others = reader.coordinates_in(formula.expr).iter().any(|s| !allowed(s));
        if Some(symbol) == over || formula.good && of_others {
            reader.fault(
                Notice::piece(
                    "M071",
                    value.span(),
                    "a driven coordinate is a formula of the one in `over` alone",
                    "ведомая так координата — формула только от координаты в `over`",
                )
                .help("write for example with = { phi4 = \"2*phi1\" }", "напишите, например, with = { phi4 = \"2*phi1\" }"),
            );
            continue;
        }
        found.push((symbol, formula.expr));
    }
    found
}

/// A name of a result: coordinate with primes, or output.
pub(super) fn known(reader: &mut Reader, name: String, span: Range<usize>) -> Option<String> {
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
    let fault = Notice::piece("M066", span, format!("there is no result `{}`", short(&name)), format!("нет результата `{}`", short(&name)))
        .why(
            "results are coordinates, their rates (phi') and the names in [outputs]",
            "результаты — это координаты, их скорости (phi') и имена из [outputs]",
        );
    let fault = match reader.scope.nearest(base, reader.scope.names()) {
        Some(near) if near != base => fault.meant(base, near),
        _ => fault.help("add it to [outputs]", "добавьте её в [outputs]"),
    };
    reader.fault(fault);
    None
}
