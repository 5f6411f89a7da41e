//! Names that formulas of variants and answers know besides those of the model.

use crate::formula::{Context, Depends, Entry, EntryKind, Kind, check, lower};
use crate::reader::{Raw, Reader, short};
use crate::units::{Dimension, mismatch, mismatch_of_number};
use std::ops::Range;
use symbolic::{Expr, SymbolId};
use words::{Notice, Severity};

/// The names of group and number.
pub(super) const GROUP: &str = "n";

pub(super) const NUMBER: &str = "N";

/// Names that formulas of variants know besides those of the model, and what they meant before.
pub(super) struct Cover {
    pub(super) before: Vec<(String, Option<Entry>)>,
    /// Whether the model has parameters n and N.
    pub(super) own: [bool; 2],
}

impl Cover {
    /// A pure number.
    pub(super) fn number(&mut self, reader: &mut Reader, name: &str, symbol: &str) -> SymbolId {
        self.quantity(reader, name, (symbol, Dimension::NONE))
    }
    /// A constant of this dimension, with a symbol of its own.
    pub(super) fn quantity(&mut self, reader: &mut Reader, name: &str, (symbol, dimension): (&str, Dimension)) -> SymbolId {
        let symbol = reader.builder.graph.symbol_id(symbol, 0);
        let entry = Entry { kind: EntryKind::Parameter(symbol), dimension: Kind::Known(dimension), depends: Depends::NOTHING };
        self.before.push((name.to_owned(), reader.scope.cover(name, entry)));
        symbol
    }
    /// Whether the model has a parameter of this name that is a pure number.
    pub(super) fn pure(&self, name: &str) -> bool {
        let entry = self.before.iter().find(|(n, _)| n == name).and_then(|(_, entry)| entry.as_ref());
        entry.is_some_and(|e| matches!(e.kind, EntryKind::Parameter(_)) && matches!(e.dimension, Kind::Known(d) if d.is_none()))
    }
    pub(super) fn lift(self, reader: &mut Reader) {
        for (name, entry) in self.before.into_iter().rev() {
            reader.scope.uncover(&name, entry);
        }
    }
}

/// A formula over constants whose numbers differ from variant to variant.
pub(super) fn constant<'a>(reader: &mut Reader<'a>, raw: &Raw<'a>, wanted: Option<&Dimension>) -> Option<(Expr, Kind)> {
    let formula = raw.formula.as_ref()?;
    let checked = check(formula, &reader.scope, &Context::CONSTANT);
    let failed = checked.faults.iter().any(|f| f.severity == Severity::Error);
    for fault in checked.faults {
        let finding = raw.snippet.diagnose(fault);
        reader.report(finding);
    }
    if failed {
        return None;
    }
    if let (Some(wanted), Kind::Known(got)) = (wanted, checked.kind)
        && !got.same(wanted)
    {
        let mismatch = if formula.is_literal() { mismatch_of_number } else { mismatch };
        let finding = raw.snippet.diagnose(mismatch(raw.snippet.all(), &got, wanted));
        reader.report(finding);
        return None;
    }
    match lower(formula, &reader.scope, &mut reader.builder) {
        Ok(expr) => Some((expr, checked.kind)),
        Err(fault) => {
            let finding = raw.snippet.diagnose(fault);
            reader.report(finding);
            None
        }
    }
}

/// Whether --set knows the name.
pub(super) fn is_value(reader: &Reader, name: &str, cover: &Cover) -> bool {
    if let Some(i) = [GROUP, NUMBER].iter().position(|own| *own == name) {
        return cover.own[i];
    }
    let base = name.strip_suffix('\'').unwrap_or(name);
    match reader.scope.get(base).map(|e| e.kind) {
        Some(EntryKind::Coordinate(_)) => true,
        Some(EntryKind::Parameter(_)) => base == name && (reader.claimed.contains_key(name) || name == "g"),
        _ => false,
    }
}

pub(super) fn symbol_of(reader: &Reader, name: &str) -> Option<SymbolId> {
    if let EntryKind::Parameter(symbol) = reader.scope.get(name)?.kind { Some(symbol) } else { None }
}

/// A parameter of the model, also one called n or N.
pub(super) fn parameter(reader: &mut Reader, name: String, span: Range<usize>, cover: &Cover) -> Option<String> {
    let name = name.trim().to_owned();
    if is_value(reader, &name, cover) && symbol_of(reader, &name).is_some() {
        return Some(name);
    }
    let fault = unknown(reader, &name, span);
    reader.fault(fault);
    None
}

pub(super) fn unknown(reader: &Reader, name: &str, span: Range<usize>) -> Notice {
    let shown = short(name);
    let (en, ru) = (format!("no parameter or coordinate is called `{shown}`"), format!("нет параметра или координаты `{shown}`"));
    let fault = Notice::piece("M089", span, en, ru);
    match reader.scope.nearest(name, reader.scope.names()) {
        Some(near) => fault.meant(name, near),
        None => fault.help(
            "a column that only formulas use has its unit in brackets: \"I1r [kg m^2]\"",
            "столбец, нужный только формулам, указывают с единицей в скобках: \"I1r [кг м^2]\"",
        ),
    }
}
