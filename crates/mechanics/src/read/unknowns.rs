//! `[unknowns]`: parameters that statics decide.

use crate::asked::{Asked, Value};
use crate::model::{Class, Connection, ConnectionKind, ParameterDecl, ParameterValue};
use crate::reader::{Fields, Reader, short, string};
use symbolic::SymbolId;
use words::Notice;

/// The symbols of the unknowns; one that the command line sets is known.
pub(super) fn check<'a>(reader: &mut Reader<'a>, top: &Fields<'a>, parameters: &[ParameterDecl]) -> Vec<SymbolId> {
    let mut found = Vec::new();
    for (name, span, _) in top.rows(reader, "unknowns") {
        let Some(p) = parameters.iter().find(|p| p.name == name) else { continue };
        if reader.override_of(name).is_some() {
            continue;
        }
        if p.class == Class::Constant && matches!(p.value, ParameterValue::Number { .. }) {
            found.push(p.symbol);
            continue;
        }
        reader.fault(
            Notice::piece(
                "M094",
                span,
                format!("the guess of `{}` is a formula", short(name)),
                format!("приближение для `{}` — формула", short(name)),
            )
            .why("an unknown is a number, and its guess one too", "неизвестное — число, и приближение к нему тоже")
            .help("write a quantity: M = \"2 N m\"", "запишите величину: M = \"2 Н м\""),
        );
    }
    found
}

/// Frictions that are about to slide, `[impending]`: name and direction.
pub(super) fn impending<'a>(
    reader: &mut Reader<'a>,
    top: &Fields<'a>,
    connections: &[Connection],
    (unknowns, studies): (&[SymbolId], &[Asked]),
) -> Vec<(String, f64)> {
    let ranges = |s: &Asked| s.has("range") && matches!(s.get("over"), Some(Value::Coordinate(_)));
    let something_unknown = !unknowns.is_empty() || studies.iter().any(ranges);
    let rows = top.rows(reader, "impending");
    let frictions: Vec<&str> =
        connections.iter().filter(|c| matches!(c.kind, ConnectionKind::Friction { .. })).map(|c| c.name.as_str()).collect();
    let mut found = Vec::new();
    for (name, span, value) in rows {
        if !frictions.contains(&name) {
            reader.fault(no_friction(name, span, &frictions));
            continue;
        }
        if !something_unknown {
            reader.fault(nothing_unknown(span));
            continue;
        }
        let Some((word, place)) = string(reader, value, "\"+\" or \"-\"", "\"+\" или \"-\"") else { continue };
        match word.trim() {
            "+" => found.push((name.to_owned(), 1.0)),
            "-" | "−" => found.push((name.to_owned(), -1.0)),
            other => reader.fault(
                Notice::piece("M110", place, format!("`{}` is no direction", short(other)), format!("`{}` — не направление", short(other)))
                    .why(
                        "a friction at its limit resists sliding forward or backward along its path",
                        "трение на пределе противится скольжению вперёд или назад по своему пути",
                    )
                    .help("write \"+\" (about to slide forward) or \"-\"", "напишите \"+\" (готово скользить вперёд) или \"-\""),
            ),
        }
    }
    found
}

fn no_friction(name: &str, span: std::ops::Range<usize>, frictions: &[&str]) -> Notice {
    let list = if frictions.is_empty() { "-".to_owned() } else { frictions.join(", ") };
    Notice::piece("M109", span, format!("there is no friction `{}`", short(name)), format!("нет трения `{}`", short(name)))
        .why(format!("[frictions] has: {list}"), format!("в [frictions] есть: {list}"))
        .help("name a dry friction of the model", "назовите сухое трение модели")
}

fn nothing_unknown(span: std::ops::Range<usize>) -> Notice {
    Notice::piece("M111", span, "friction at its limit, but nothing is unknown", "трение на пределе, но неизвестных нет")
        .why(
            "every friction at its limit is one more equation, from which one more unknown follows",
            "каждое трение на пределе добавляет уравнение, из которого находится ещё одно неизвестное",
        )
        .help(
            "name a load, an angle or a length in [unknowns], or give the study `equilibrium` a coordinate in `over` with its `range`",
            "назовите нагрузку, угол или длину в [unknowns] либо задайте расчёту `equilibrium` координату `over` и диапазон `range`",
        )
}
