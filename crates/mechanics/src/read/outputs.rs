//! `[outputs]`.

use super::order::topological;
use super::parameters::{claim, cycle_fault};
use crate::fields;
use crate::formula::{Context, Depends, Entry, EntryKind, Formula, Kind, Plain, display};
use crate::model::{DisplayUnit, OutputDecl, Request, RequestKind};
use crate::reader::{Checked, Fields, Raw, Reader, short};
use crate::units::{Dimension, Unit, mismatch, si_label};
use std::collections::{HashMap, HashSet};
use std::ops::Range;
use toml::de::DeValue;
use words::Text;

/// An output before its formula is checked.
pub(super) struct RawOutput<'a> {
    name: String,
    span: Range<usize>,
    raw: Raw<'a>,
    unit: Option<(Unit, String, Range<usize>)>,
    label: Text,
    /// a parameter has the name in formulas
    shadowed: bool,
}

/// The outputs as written; their names are taken from here on.
///
/// An output may bear the name of a parameter (`v`, the speed of a drive and a result): formulas mean the parameter, results the output.
pub(super) fn collect<'a>(
    reader: &mut Reader<'a>,
    top: &Fields<'a>,
    parameters: &HashSet<String>,
    notation: &mut Vec<(String, String)>,
) -> Vec<RawOutput<'a>> {
    let mut found = Vec::new();
    for (name, span, value) in top.rows(reader, "outputs") {
        let shadowed = parameters.contains(name) && !found.iter().any(|o: &RawOutput| o.name == name);
        if !shadowed && !claim(reader, name, &span) {
            continue;
        }
        let (mut unit, mut label) = (None, Text::default());
        let raw = match value.get_ref() {
            DeValue::Table(table) => {
                let fields = Fields::open(reader, &fields::OUTPUT, table, span.clone(), format!("outputs.{}", short(name)));
                fields.symbol(reader, name, notation);
                label = fields.text(reader, "label").unwrap_or_default();
                unit = fields.get("unit").and_then(|v| reader.unit(v).map(|(u, written)| (u, written, v.span())));
                fields.raw(reader, "value")
            }
            _ => reader.raw(value),
        };
        reader.results.insert(name.to_owned());
        if !shadowed {
            reader.scope.declare(name, Entry { kind: EntryKind::Output(None), dimension: Kind::Unknown, depends: Depends::NOTHING });
        }
        if let Some(raw) = raw {
            found.push(RawOutput { name: name.to_owned(), span, raw, unit, label, shadowed });
        }
    }
    found
}

/// Checks the outputs by dependence and gives them back in the user's order.
pub(super) fn resolve<'a>(reader: &mut Reader<'a>, raw: Vec<RawOutput<'a>>) -> Vec<OutputDecl> {
    let index: HashMap<&str, usize> = raw.iter().enumerate().filter(|(_, o)| !o.shadowed).map(|(i, o)| (o.name.as_str(), i)).collect();
    let dependencies: Vec<Vec<usize>> =
        raw.iter().map(|o| o.raw.formula.iter().flat_map(|f| f.names()).filter_map(|(n, _)| index.get(n).copied()).collect()).collect();
    let (order, cycles) = topological(&dependencies);
    for cycle in &cycles {
        let names: Vec<&str> = cycle.iter().chain(cycle.first()).map(|i| raw[*i].name.as_str()).collect();
        let o = &raw[cycle[0]];
        let finding = o.raw.snippet.diagnose(cycle_fault(o.raw.snippet.all(), &names));
        reader.report(finding);
    }
    let cyclic: HashSet<usize> = cycles.into_iter().flatten().collect();
    let mut done: Vec<Option<OutputDecl>> = (0..raw.len()).map(|_| None).collect();
    let mut raw: Vec<Option<RawOutput>> = raw.into_iter().map(Some).collect();
    for i in order {
        if let Some(o) = raw[i].take()
            && !cyclic.contains(&i)
        {
            done[i] = Some(declare(reader, o));
        }
    }
    done.into_iter().flatten().collect()
}

/// The SI label; joules for what is made of energies, because N m alone would read as a moment.
fn unit_label(reader: &Reader, value: &Checked) -> String {
    let dimension = value.kind.or_none();
    let of_energies = || {
        let symbols = reader.builder.graph.symbols_in(&[value.expr]);
        let energy = |r: &Request| matches!(r.kind, RequestKind::KineticEnergy(_) | RequestKind::PotentialEnergy);
        reader.builder.requests.iter().any(|r| energy(r) && symbols.binary_search(&r.symbol).is_ok())
    };
    if dimension.same(&Dimension::ENERGY) && of_energies() { "J".to_owned() } else { si_label(&dimension) }
}

/// A value in 1/s made of times and numbers alone is one over a period.
fn plain(reader: &Reader, raw: &Raw) -> Plain {
    let of_times = |name: &str| {
        name == "t"
            || matches!(reader.scope.get(name).map(|e| e.dimension), Some(Kind::Known(d)) if d.is_duration() || d.is_none() && !d.is_angular())
    };
    let formula = raw.formula.as_ref();
    // sqrt(2000 [N/m]/0.5 [kg]) is no more one over a period than sqrt(c/m)
    let times = |f: &Formula| f.names().all(|(name, _)| of_times(name)) && f.has_units(Dimension::is_of_time);
    let periods = formula.is_some_and(|f| !f.asks_the_machine() && times(f));
    if periods { Plain::Periods } else { Plain::Doubtful }
}

fn declare<'a>(reader: &mut Reader<'a>, o: RawOutput<'a>) -> OutputDecl {
    let mut value = reader.value(&o.raw, &Context::OUTPUT, None);
    let display = o.unit.as_ref().map(|(unit, label, span)| {
        let factor = match value.kind {
            Kind::Known(d) if !d.same(&unit.dimension) => {
                reader.fault(mismatch(span.clone(), &unit.dimension, &d));
                1.0
            }
            Kind::Known(d) => {
                let (factor, fault) = display(&d, unit, o.raw.formula.as_ref(), plain(reader, &o.raw));
                if let Some(fault) = fault {
                    let finding = o.raw.snippet.diagnose(fault);
                    reader.report(finding);
                }
                let counts = d.counts_periods() || d.has_radians();
                value.kind = Kind::Known(if counts { d } else { d.with_angle_of(&unit.dimension) });
                factor
            }
            _ => {
                value.kind = Kind::Known(unit.dimension);
                unit.factor.to_f64()
            }
        };
        DisplayUnit { label: label.clone(), factor }
    });
    let formula = value.good.then_some(value.expr);
    let dimension = if value.good { value.kind } else { Kind::Unknown };
    if !o.shadowed {
        reader.scope.declare(&o.name, Entry { kind: EntryKind::Output(formula), dimension, depends: value.depends });
    }
    OutputDecl {
        symbol: reader.builder.graph.symbol_id(&o.name, 0),
        name: o.name,
        formula: value.expr,
        unit: unit_label(reader, &value),
        display,
        label: o.label,
        span: o.span,
    }
}
