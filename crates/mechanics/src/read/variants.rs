//! `[variants]`: values of variants by a table or by formulas, and the conditions that they keep. The table itself may be another file, which whoever opens
//! files reads.

use super::answers;
use super::cover::{Cover, GROUP, NUMBER, constant, is_value, parameter, symbol_of, unknown};
use crate::fields;
use crate::formula::{Context, Kind};
use crate::model::{AnswerDecl, EmptyCell, Helper, ParameterDecl, ParameterValue, Requirement, VariantFormula, VariantTable, Variants};
use crate::reader::names::names;
use crate::reader::{Fields, Raw, Reader, short, string};
use crate::snippet::{Site, Snippet};
use crate::units::{Dimension, parse_unit, si_label};
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::ops::Range;
use symbolic::{Expr, Graph, SymbolId};
use words::Notice;

/// Most variants of a range.
const MOST: u32 = 10_000;

/// The variants, and the items that students answer.
pub(super) fn read<'a>(reader: &mut Reader<'a>, top: &Fields<'a>, parameters: &[ParameterDecl]) -> (Option<Variants>, Vec<AnswerDecl>) {
    let own = [GROUP, NUMBER].map(|name| symbol_of(reader, name).is_some());
    let mut cover = Cover { before: Vec::new(), own };
    let symbols = [GROUP, NUMBER].map(|name| cover.number(reader, name, &format!("variant {name}")));
    let mut variants = top.get("variants").and_then(|value| table_of(reader, value, &cover)).map(|fields| {
        let variants = head(reader, &fields, (symbols, &mut cover));
        (variants, fields)
    });
    if let Some((Some(variants), fields)) = &mut variants {
        let formulas = formulas(reader, fields, (variants, &cover));
        variants.formulas = ordered(reader, formulas, parameters);
        let [group, number] = [GROUP, NUMBER].map(|name| cover.pure(name).then(|| name.to_owned()));
        if variants.table.is_none() || !variants.formulas.is_empty() {
            // a parameter of the same name means the same
            variants.group_parameter = variants.group_parameter.take().or(group);
            variants.number = variants.number.take().or(number);
        }
    }
    let answers = answers::read(reader, top, &mut cover);
    if let Some((Some(variants), fields)) = &mut variants {
        variants.require = requirements(reader, fields);
    }
    cover.lift(reader);
    (variants.and_then(|v| v.0), answers)
}

fn table_of<'a>(reader: &mut Reader<'a>, value: &'a crate::reader::syntax::Value<'a>, cover: &Cover) -> Option<Fields<'a>> {
    let Some(table) = value.get_ref().as_table() else {
        let fault = crate::reader::wrong_type(value.span(), "a table", "таблица", value.get_ref().type_str());
        reader.fault(fault.help("write [variants] and table = \"variants.csv\"", "напишите [variants] и table = \"variants.csv\""));
        return None;
    };
    let named: Vec<String> = table.iter().map(|(k, _)| k.get_ref().as_ref().to_owned()).filter(|k| is_value(reader, k, cover)).collect();
    let free = |key: &str| named.iter().any(|k| k == key);
    Some(Fields::open_with(reader, (&fields::variants::VARIANTS, &free), table, value.span(), "variants".to_owned()))
}

/// Everything but formulas and conditions.
fn head<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, (symbols, cover): ([SymbolId; 2], &mut Cover)) -> Option<Variants> {
    let range = fields.get("N").map(|v| range(reader, v));
    let (file, inside) = (fields.name(reader, "table"), fields.name(reader, "rows"));
    let table = match (file, inside, range) {
        (Some((file, _)), None, None) => Some(VariantTable::File(file)),
        (None, Some((text, _)), None) => Some(VariantTable::Text(text)),
        (None, None, Some(_)) => None,
        _ => {
            let (en, ru) = ("[variants] needs one of `table`, `rows` and `N`", "в [variants] нужен один из ключей `table`, `rows` и `N`");
            let fault = Notice::piece("M089", fields.span.clone(), en, ru);
            reader.fault(fault.help(
                "write table = \"variants.csv\", or N = \"1..30\" and formulas",
                "напишите table = \"variants.csv\" или N = \"1..30\" и формулы",
            ));
            return None;
        }
    };
    let key = fields.name(reader, "key").map(|(name, _)| name.trim().to_owned());
    let (mut helpers, mut units) = (Vec::new(), Vec::new());
    let columns = fields.get("columns").map(|v| names(reader, v));
    let columns = columns.map(|list| {
        let mut known = Vec::new();
        for (name, span) in list {
            match column(reader, &name, span, cover) {
                Some(Column::Known(name, unit)) => {
                    units.extend(unit.map(|unit| (name.clone(), unit)));
                    known.push(name);
                }
                Some(Column::Helper(helper)) => helpers.push(helper),
                None => {}
            }
        }
        known
    });
    let number = fields.name(reader, "number").and_then(|(name, span)| parameter(reader, name, span, cover));
    let group_parameter = fields.name(reader, "group").and_then(|(name, span)| parameter(reader, name, span, cover));
    let group = group(reader, fields);
    let empty = empty(reader, fields);
    let (formulas, require) = (Vec::new(), Vec::new());
    let range = range.flatten();
    if table.is_none() && range.is_none() {
        return None;
    }
    let span = fields.span.clone();
    Some(Variants { table, range, key, columns, units, helpers, number, group_parameter, group, empty, formulas, require, symbols, span })
}

/// `1..30`.
fn range<'a>(reader: &mut Reader<'a>, value: &'a crate::reader::syntax::Value<'a>) -> Option<[u32; 2]> {
    let (text, span) = string(reader, value, "a range in quotes", "диапазон в кавычках")?;
    let number = |part: &str| part.trim().parse::<u32>().ok();
    let parts = text.split_once("..").or_else(|| text.split_once('…')).or_else(|| text.split_once('–'));
    let ends = parts.and_then(|(a, b)| Some([number(a)?, number(b.trim_start_matches(['.', '=']))?]));
    let fits = |e: &[u32; 2]| e[0] <= e[1] && e[1] - e[0] < MOST;
    if let Some(ends) = ends.filter(fits) {
        return Some(ends);
    }
    let fault = Notice::piece(
        "M370",
        span,
        format!("`{}` is no range of numbers", short(&text)),
        format!("`{}` — не диапазон номеров", short(&text)),
    )
    .why(
        format!("a range goes from a smaller whole number to a larger one, at most {MOST} of them"),
        format!("диапазон идёт от меньшего целого числа к большему, номеров не больше {MOST}"),
    );
    reader.fault(fault.help("write N = \"1..30\"", "напишите N = \"1..30\""));
    None
}

fn group<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Option<u32> {
    let checked = fields.formula(reader, "n", &Context::CONSTANT, Some(&Dimension::NONE))?;
    let value = reader.number(&checked)?;
    if value >= 0.0 && value.fract() == 0.0 && value <= 1e6 {
        return Some(value as u32);
    }
    reader.fault(Notice::piece("M370", fields.span_of("n"), "a group has a whole number", "номер группы — целое число"));
    None
}

fn empty<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> EmptyCell {
    let Some((word, span)) = fields.get("empty").and_then(|v| string(reader, v, "a word", "слово")) else {
        return EmptyCell::default();
    };
    match word.trim() {
        "keeps" => EmptyCell::Keeps,
        "absent" => EmptyCell::Absent,
        other => {
            let what = (
                format!("`{}` says nothing of empty cells", short(other)),
                format!("`{}` ничего не говорит о пустых клетках", short(other)),
            );
            let fault = Notice::piece("M370", span, what.0, what.1);
            reader.fault(fault.help("write \"keeps\" or \"absent\"", "напишите \"keeps\" или \"absent\""));
            EmptyCell::default()
        }
    }
}

/// Formulas of parameters, starts and rates, each after those that it uses.
fn formulas<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>, (variants, cover): (&Variants, &Cover)) -> Vec<VariantFormula> {
    let mut found = Vec::new();
    let mut rows = fields.others();
    rows.retain(|(name, _, _)| is_value(reader, name, cover));
    for (name, span, value) in rows {
        let Some(raw) = reader.raw(value) else { continue };
        let wanted = dimension_of(reader, name);
        if variants.columns.iter().flatten().any(|c| c == name) && !uses(&raw, name) {
            reader.fault(covered(name, span));
            continue;
        }
        let Some((value, kind)) = constant(reader, &raw, wanted.as_ref()) else { continue };
        let unit = si_label(&wanted.unwrap_or_else(|| kind.or_none()));
        found.push(VariantFormula { name: name.to_owned(), value, unit, span: raw.snippet_span(span) });
    }
    found
}

fn uses(raw: &Raw, name: &str) -> bool {
    raw.formula.as_ref().is_some_and(|f| f.names().any(|(n, _)| n == name))
}

fn covered(name: &str, span: Range<usize>) -> Notice {
    let name = short(name);
    Notice::piece(
        "M371",
        span,
        format!("`{name}` has a column in the table and a formula that does not use it"),
        format!("для `{name}` в таблице есть столбец, а формула его не использует"),
    )
    .help(
        format!("use the column, {name} = \"{name}*(1 + 0.01*N)\", or leave it out of `columns`"),
        format!("используйте столбец, {name} = \"{name}*(1 + 0.01*N)\", или уберите его из `columns`"),
    )
}

/// Formulas in the order of their use, directly or through formulas of parameters.
fn ordered(reader: &mut Reader, found: Vec<VariantFormula>, parameters: &[ParameterDecl]) -> Vec<VariantFormula> {
    let symbols: Vec<Option<SymbolId>> = found.iter().map(|f| symbol_of(reader, &f.name)).collect();
    let graph = &reader.builder.graph;
    let used: Vec<BTreeSet<SymbolId>> = found.iter().zip(&symbols).map(|(f, own)| behind(graph, (f.value, *own), parameters)).collect();
    let uses = |i: usize, j: usize| i != j && symbols[j].is_some_and(|s| used[i].contains(&s));
    let needs: Vec<Vec<usize>> = (0..found.len()).map(|i| (0..found.len()).filter(|j| uses(i, *j)).collect()).collect();
    let (order, cycles) = super::order::topological(&needs);
    for cycle in &cycles {
        let names: Vec<&str> = cycle.iter().chain(cycle.first()).map(|i| found[*i].name.as_str()).collect();
        let list = names.join(" -> ");
        let (en, ru) =
            (format!("formulas of variants need each other: {list}"), format!("формулы вариантов зависят друг от друга: {list}"));
        reader.fault(Notice::piece("M371", found[cycle[0]].span.clone(), en, ru));
    }
    let mut found: Vec<Option<VariantFormula>> = found.into_iter().map(Some).collect();
    order.into_iter().filter_map(|i| found[i].take()).collect()
}

/// Every symbol that a value needs; the own one is that of the file.
fn behind(graph: &Graph, (value, own): (Expr, Option<SymbolId>), parameters: &[ParameterDecl]) -> BTreeSet<SymbolId> {
    let mut seen: BTreeSet<SymbolId> = graph.symbols_in(&[value]).into_iter().collect();
    // a parameter stands behind those that it uses
    for p in parameters.iter().rev() {
        if let ParameterValue::Formula(formula) = p.value
            && seen.contains(&p.symbol)
            && own != Some(p.symbol)
        {
            seen.extend(graph.symbols_in(&[formula]));
        }
    }
    seen
}

/// `[variants.require]`.
fn requirements<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Vec<Requirement> {
    let mut found = Vec::new();
    for (name, _, value) in fields.rows(reader, "require") {
        let Some((text, span)) = string(reader, value, "a condition in quotes", "условие в кавычках") else { continue };
        // a condition stands in an `if`: 1 where it holds
        let snippet = Snippet { text: Cow::Owned(format!("if({text}, 1, 0)")), site: Site::Inside(span.clone()) };
        let raw = reader.raw_text(snippet);
        let Some((holds, _)) = constant(reader, &raw, None) else { continue };
        found.push(Requirement { name: name.to_owned(), text, holds, span });
    }
    found
}

enum Column {
    /// With the unit of its numbers.
    Known(String, Option<String>),
    Helper(Helper),
}

/// A column that counts: a parameter, a coordinate (its start), a coordinate with a prime (its rate), or a quantity with its unit.
fn column(reader: &mut Reader, written: &str, span: Range<usize>, cover: &mut Cover) -> Option<Column> {
    let written = written.trim();
    let (name, unit) = match written.strip_suffix(']').and_then(|c| c.split_once('[')) {
        Some((name, unit)) => (name.trim(), Some(unit.trim())),
        None => (written, None),
    };
    let Some(unit) = unit else { return known(reader, name, span, cover).map(|name| Column::Known(name, None)) };
    if is_value(reader, name, cover) {
        return Some(Column::Known(name.to_owned(), Some(unit.to_owned())));
    }
    if !crate::formula::is_identifier(name) {
        let fault = unknown(reader, name, span);
        reader.fault(fault);
        return None;
    }
    match parse_unit(unit) {
        Ok(unit) => {
            let symbol = cover.quantity(reader, name, (&format!("column {name}"), unit.dimension));
            let (factor, dimension) = (unit.factor.to_f64(), unit.dimension);
            Some(Column::Helper(Helper { name: name.to_owned(), symbol, factor, dimension }))
        }
        Err(fault) => {
            reader.fault(Notice { place: words::Place::Piece(span), ..fault });
            None
        }
    }
}

fn dimension_of(reader: &Reader, name: &str) -> Option<Dimension> {
    let base = name.strip_suffix('\'').unwrap_or(name);
    let Kind::Known(dimension) = reader.scope.get(base)?.dimension else { return None };
    Some(if base == name { dimension } else { dimension.per_time(1) })
}

fn known(reader: &mut Reader, name: &str, span: Range<usize>, cover: &Cover) -> Option<String> {
    if is_value(reader, name, cover) {
        return Some(name.to_owned());
    }
    let fault = unknown(reader, name, span);
    reader.fault(fault);
    None
}

impl Raw<'_> {
    /// Where the formula stands in the file; otherwise that of its name.
    fn snippet_span(&self, name: Range<usize>) -> Range<usize> {
        match &self.snippet.site {
            Site::Literal(from) => *from..from + self.snippet.text.len(),
            Site::Inside(span) => span.clone(),
            Site::Override { .. } => name,
        }
    }
}
