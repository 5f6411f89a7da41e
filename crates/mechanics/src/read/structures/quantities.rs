//! What tables of structures have in common: quantities with a sign, names of nodes and rods, words of a list.

use crate::formula::Context;
use crate::read::plane;
use crate::reader::names::names;
use crate::reader::{Fields, Reader, components, short};
use crate::units::Dimension;
use std::ops::Range;
use symbolic::Expr;
use words::{Notice, digits};

/// A vector in the plane under a key; zeros without it.
pub(super) fn plane_vector<'a>(
    reader: &mut Reader<'a>,
    fields: &Fields<'a>,
    key: &'static str,
    context: &Context,
    wanted: &Dimension,
) -> [Expr; 2] {
    let zero = reader.builder.graph.zero();
    let Some(value) = fields.get(key) else { return [zero; 2] };
    let parts = components(reader, value, context, wanted);
    plane::along(reader, value, parts)
}

/// A quantity that is positive.
pub(super) fn positive<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str, wanted: &Dimension) -> Option<Expr> {
    unless(reader, fields, (key, wanted), |v| v <= 0.0)
}

/// A quantity that may be zero, but not negative.
pub(super) fn not_negative<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str, wanted: &Dimension) -> Option<Expr> {
    unless(reader, fields, (key, wanted), |v| v < 0.0)
}

/// A constant under a key, with a fault where its number is wrong.
fn unless<'a>(
    reader: &mut Reader<'a>,
    fields: &Fields<'a>,
    (key, wanted): (&'static str, &Dimension),
    is_wrong: impl Fn(f64) -> bool,
) -> Option<Expr> {
    let value = fields.formula(reader, key, &Context::CONSTANT, Some(wanted))?;
    let Some(number) = reader.number(&value).filter(|v| is_wrong(*v)) else { return Some(value.expr) };
    let given = digits::typed(number);
    let fault = Notice::piece(
        "M203",
        fields.span_of(key),
        format!("{key} of {} is {}", fields.path, given.en),
        format!("{key} в {} равно {}", fields.path, given.ru),
    )
    .why(
        "stiffnesses and masses are positive; a parameter is probably wrong",
        "жёсткости и массы положительны; вероятно, неверен параметр",
    );
    reader.fault(fault);
    Some(value.expr)
}

pub(super) fn unknown_node(reader: &mut Reader, name: &str, span: Range<usize>) {
    let fault = Notice::piece("M202", span, format!("there is no node `{}`", short(name)), format!("нет узла `{}`", short(name)));
    let nodes = reader.structure.nodes.iter().map(|n| n.name.as_str());
    let near = reader.scope.nearest(name, nodes).map(str::to_owned);
    reader.fault(or_add(fault, name, near));
}

/// Neither a node nor a rod.
pub(super) fn unknown_site(reader: &mut Reader, name: &str, span: Range<usize>) {
    let (en, ru) = (format!("there is no node or rod `{}`", short(name)), format!("нет узла или стержня `{}`", short(name)));
    let nodes = reader.structure.nodes.iter().map(|n| n.name.as_str());
    let rods = reader.structure.rods.iter().map(|r| r.name.as_str());
    let near = reader.scope.nearest(name, nodes.chain(rods)).map(str::to_owned);
    reader.fault(or_add(Notice::piece("M202", span, en, ru), name, near));
}

fn or_add(fault: Notice, name: &str, near: Option<String>) -> Notice {
    match near {
        Some(near) => fault.meant(name, &near),
        None => fault.help("add it to [nodes]", "добавьте его в [nodes]"),
    }
}

/// Words of a list under a key; each must be one of `known`.
pub(super) fn words<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, key: &'static str, known: &[&'static str]) -> Vec<usize> {
    let Some(value) = fields.get(key) else { return Vec::new() };
    let found = names(reader, value);
    found.into_iter().filter_map(|(word, span)| one_of(reader, &word, span, known)).collect()
}

pub(super) fn one_of(reader: &mut Reader, word: &str, span: Range<usize>, known: &[&'static str]) -> Option<usize> {
    let found = known.iter().position(|k| *k == word);
    if found.is_none() {
        let list = known.join(", ");
        let fault = Notice::piece(
            "M205",
            span,
            format!("`{}` is not one of {list}", short(word)),
            format!("`{}` — не из списка: {list}", short(word)),
        );
        reader.fault(fault);
    }
    found
}
