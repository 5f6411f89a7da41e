//! `[[phases]]`: a schedule of parameters.
//!
//! A parameter that phases set becomes a formula of time, `if(t < t1, v1, if(t < t2, v2, v3))`: its switches are scheduled and therefore
//! hit exactly by every study. A value holds until another phase sets it. In a phase that `restarts`, the time in forces and torques
//! counts from the start of the phase: they are written over τ = t - t0(t) instead of t.

use super::raw::{RawCoordinate, RawParameter, names_of};
use crate::fields;
use crate::formula::{Context, Depends, Entry as ScopeEntry, EntryKind, Kind};
use crate::model::{Class, Element, ParameterDecl, ParameterValue};
use crate::reader::{Checked, Fields, Raw, Reader, string, wrong_type};
use crate::structure;
use crate::units::Dimension;
use std::collections::HashMap;
use std::ops::Range;
use symbolic::{Edge, Expr, Substitution, SymbolId};
use toml::de::DeValue;
use words::{Notice, Text};

/// The name that an override uses to choose the reading of all phases: `--set phases=restarts`.
pub(super) const READING: &str = "phases";

/// The schedule as written.
#[derive(Default)]
pub(super) struct Schedule<'a> {
    phases: Vec<Phase<'a>>,
    /// Ends of phases, once they are known.
    ends: Vec<Option<Checked>>,
    /// Instants at which loads restart.
    pub restarts: Vec<f64>,
}

struct Phase<'a> {
    span: Range<usize>,
    until: Option<(Raw<'a>, Range<usize>)>,
    sets: Vec<(String, Range<usize>, Raw<'a>)>,
    restarts: Option<bool>,
}

/// The phases as written.
pub(super) fn collect<'a>(reader: &mut Reader<'a>, top: &Fields<'a>) -> Schedule<'a> {
    let Some(value) = top.get("phases") else { return Schedule::default() };
    let DeValue::Array(items) = value.get_ref() else {
        reader.fault(
            wrong_type(value.span(), "an array of tables", "массив таблиц", value.get_ref().type_str())
                .help("write [[phases]] with double brackets", "напишите [[phases]] в двойных скобках"),
        );
        return Schedule::default();
    };
    let mut phases = Vec::new();
    for item in items.iter() {
        let DeValue::Table(table) = item.get_ref() else {
            reader.fault(wrong_type(item.span(), "a table", "таблица", item.get_ref().type_str()));
            continue;
        };
        let fields = Fields::open(reader, &fields::PHASE, table, item.span(), "phases".to_owned());
        phases.push(phase(reader, &fields));
    }
    let last = phases.len().saturating_sub(1);
    for phase in phases.iter().take(last).filter(|p| p.until.is_none()) {
        reader.fault(
            Notice::piece(
                "M006",
                phase.span.clone(),
                "a phase that is not the last lacks `until`",
                "у этапа, кроме последнего, не хватает `until`",
            )
            .help("add for example until = \"2 s\"", "добавьте, например: until = \"2 с\""),
        );
    }
    let ends = (0..phases.len()).map(|_| None).collect();
    Schedule { phases, ends, restarts: Vec::new() }
}

fn phase<'a>(reader: &mut Reader<'a>, fields: &Fields<'a>) -> Phase<'a> {
    let until = fields.raw(reader, "until").map(|raw| (raw, fields.span_of("until")));
    let mut sets = Vec::new();
    for (name, span, value) in fields.rows(reader, "set") {
        if let Some(raw) = reader.raw(value) {
            sets.push((name.to_owned(), span, raw));
        }
    }
    let restarts = fields.get("phase").and_then(|v| string(reader, v, "\"keeps\" or \"restarts\"", "\"keeps\" или \"restarts\""));
    let restarts = restarts.and_then(|(word, span)| {
        let reading = reading(&word);
        if reading.is_none() {
            reader.fault(unknown_reading(&word, span));
        }
        reading
    });
    Phase { span: fields.span.clone(), until, sets, restarts }
}

fn reading(word: &str) -> Option<bool> {
    match word.trim() {
        "keeps" => Some(false),
        "restarts" => Some(true),
        _ => None,
    }
}

fn unknown_reading(word: &str, span: Range<usize>) -> Notice {
    let word = crate::reader::short(word);
    Notice::piece("M098", span, format!("unknown reading `{word}` of the forcing's phase"), format!("неизвестное толкование фазы возбуждения `{word}`"))
        .why(
            "at a switch the forcing either keeps its phase (a motor turns on) or restarts it (time counts from the switch)",
            "при переключении возбуждение либо сохраняет фазу (двигатель вращается дальше), либо начинает её заново (время отсчитывается от переключения)",
        )
        .help("write phase = \"keeps\" or phase = \"restarts\"", "напишите phase = \"keeps\" или phase = \"restarts\"")
}

impl<'a> Schedule<'a> {
    /// Whether the file has phases.
    pub(super) fn is_empty(&self) -> bool {
        self.phases.is_empty()
    }

    /// Reports settings of what is no parameter, twice the same in a phase included by TOML itself.
    pub(super) fn check_names(&self, reader: &mut Reader, coordinates: &[RawCoordinate], parameters: &[RawParameter]) {
        let known: HashMap<&str, ()> = parameters.iter().map(|p| (p.name.as_str(), ())).collect();
        for (name, span, _) in self.phases.iter().flat_map(|p| &p.sets) {
            if known.contains_key(name.as_str()) {
                continue;
            }
            let short = crate::reader::short(name);
            let fault = Notice::piece(
                "M097",
                span.clone(),
                format!("a phase sets `{short}`, which is no parameter"),
                format!("этап задаёт `{short}`, но такого параметра нет"),
            );
            let fault = if coordinates.iter().any(|c| &c.name == name) {
                fault.why(
                    "a coordinate follows from the motion and is not set at a switch",
                    "координата следует из движения и при переключении не задаётся",
                )
            } else {
                match reader.scope.nearest(name, parameters.iter().map(|p| p.name.as_str())) {
                    Some(near) => fault.meant(name, near),
                    None => fault.help("name a parameter of [parameters]", "назовите параметр из [parameters]"),
                }
            };
            reader.fault(fault);
        }
    }

    /// Names that a parameter depends on because of the phases that set it; its own name stands for its value in [parameters].
    pub(super) fn dependencies(&self, name: &str) -> Vec<&str> {
        if !self.sets(name) {
            return Vec::new();
        }
        let ends = self.phases.iter().flat_map(|p| &p.until).flat_map(|(raw, _)| names_of(raw));
        let own = self.phases.iter().flat_map(|p| &p.sets).filter(|s| s.0 == name).flat_map(|s| names_of(&s.2));
        ends.chain(own.filter(|n| *n != name)).collect()
    }

    fn sets(&self, name: &str) -> bool {
        self.phases.iter().any(|p| p.sets.iter().any(|s| s.0 == name))
    }

    /// The value of a parameter over time, from its value in [parameters]; unchanged when no phase sets it.
    pub(super) fn scheduled(&mut self, reader: &mut Reader<'a>, name: &str, base: Checked) -> Option<Checked> {
        if !self.sets(name) {
            return None;
        }
        let symbol = reader.builder.graph.symbol_id(name, 0);
        // in `set` the parameter's own name is its value in [parameters]
        if let Some(number) = reader.number(&base) {
            reader.values.set(&mut reader.builder.graph, symbol, number);
        }
        reader.scope.declare(name, ScopeEntry { kind: EntryKind::Parameter(symbol), dimension: base.kind, depends: base.depends });
        let mut own = Substitution::new([(symbol, base.expr)]);
        let wanted = match base.kind {
            Kind::Known(d) => Some(d),
            _ => None,
        };
        let (mut result, mut value) = (base, base.expr);
        let mut values = Vec::new();
        for phase in &self.phases {
            if let Some((_, _, raw)) = phase.sets.iter().find(|s| s.0 == name) {
                let set = reader.value(raw, &Context::PARAMETER, wanted.as_ref());
                result.depends = result.depends | set.depends;
                result.good &= set.good;
                value = own.apply(&mut reader.builder.graph, set.expr);
            }
            values.push(value);
        }
        result.expr = self.switched(reader, &values);
        result.depends = result.depends | Depends::TIME;
        Some(result)
    }

    /// The formula of time that has these values in the phases.
    fn switched(&mut self, reader: &mut Reader<'a>, values: &[Expr]) -> Expr {
        let ends: Vec<Option<Expr>> = (0..values.len()).map(|i| self.end(reader, i)).collect();
        let graph = &mut reader.builder.graph;
        let time = graph.symbol(reader.builder.time);
        let Some((&last, before)) = values.split_last() else { return graph.zero() };
        before.iter().zip(&ends).rev().fold(last, |later, (value, end)| match end {
            Some(end) => {
                let guard = graph.sub(*end, time);
                graph.switch(guard, Edge::Open, *value, later)
            }
            None => later,
        })
    }

    /// The end of a phase, checked once.
    fn end(&mut self, reader: &mut Reader<'a>, i: usize) -> Option<Expr> {
        let (raw, _) = self.phases.get(i)?.until.as_ref()?;
        let checked = *self.ends[i].get_or_insert_with(|| reader.value(raw, &Context::CONSTANT, Some(&Dimension::TIME)));
        Some(checked.expr)
    }

    /// Ends of the phases in order, when all parameters are known.
    pub(super) fn finish(&mut self, reader: &mut Reader<'a>) -> Vec<f64> {
        for i in 0..self.phases.len() {
            self.end(reader, i);
        }
        let mut ends = Vec::new();
        let mut before = 0.0;
        for (phase, checked) in self.phases.iter().zip(&self.ends) {
            let (Some((_, span)), Some(checked)) = (&phase.until, checked) else { continue };
            let Some(end) = reader.number(checked) else { continue };
            if end <= before {
                reader.fault(
                    Notice::piece(
                        "M096",
                        span.clone(),
                        format!("the phase ends at {end} s, but it begins at {before} s"),
                        format!("этап кончается в {end} с, а начинается в {before} с"),
                    )
                    .why(
                        "each phase begins where the one before ends, the first at t = 0",
                        "каждый этап начинается там, где кончается предыдущий, первый — при t = 0",
                    )
                    .help(
                        "put the phases in the order of time; `until` is an instant, not a duration",
                        "расположите этапы по времени; `until` — момент, а не длительность",
                    ),
                );
            }
            before = end;
            ends.push(end);
        }
        ends
    }

    /// Starts that the time of the forcing counts from, phase by phase; empty when no phase restarts it.
    fn origins(&mut self, reader: &mut Reader<'a>) -> Vec<Expr> {
        let by_hand = reader.override_of(READING).and_then(|snippet| {
            let found = reading(&snippet.text);
            if found.is_none() {
                let fault = unknown_reading(&snippet.text, snippet.all());
                reader.report(snippet.diagnose(fault));
            }
            found
        });
        let (mut restarts, mut any) = (false, false);
        let mut origin = reader.builder.graph.zero();
        let mut origins = vec![];
        for i in 0..self.phases.len() {
            restarts = by_hand.or(self.phases[i].restarts).unwrap_or(restarts);
            if i > 0 && restarts {
                any = true;
                origin = self.end(reader, i - 1).unwrap_or(origin);
                self.restarts.extend(self.ends[i - 1].as_ref().and_then(|end| reader.number(end)));
            }
            origins.push(origin);
        }
        if any { origins } else { Vec::new() }
    }

    /// Writes forces and torques over the time since the last restart. The new parameter is that time.
    pub(super) fn restart(
        &mut self,
        reader: &mut Reader<'a>,
        parameters: &[ParameterDecl],
        loads: Loads,
        notation: &mut Vec<(String, String)>,
    ) -> Option<ParameterDecl> {
        let origins = self.origins(reader);
        if origins.is_empty() {
            return None;
        }
        let mut name = "t_phase".to_owned();
        while reader.claimed.contains_key(&name) {
            name.push('_');
        }
        let t0 = self.switched(reader, &origins);
        let graph = &mut reader.builder.graph;
        let time = graph.symbol(reader.builder.time);
        let formula = graph.sub(time, t0);
        let symbol = graph.symbol_id(&name, 0);
        let elapsed = graph.symbol(symbol);
        notation.push((name.clone(), "τ".to_owned()));
        let mut rewriting = Rewriting::new(reader, parameters, |name| self.sets(name), elapsed);
        loads.change(&mut |value| rewriting.apply(reader, value));
        Some(ParameterDecl {
            name,
            symbol,
            value: ParameterValue::Formula(formula),
            class: Class::Time,
            number: None,
            unit: "s".to_owned(),
            written: String::new(),
            label: Text::new("time since the last restart of the loads", "время с последнего возобновления нагрузок"),
            span: None,
        })
    }
}

/// All that acts as a load of its own: on bodies and on structures.
pub(super) struct Loads<'l> {
    pub elements: &'l mut [Element],
    pub on_structure: Vec<&'l mut structure::Load>,
}

impl Loads<'_> {
    /// Replaces the formulas of loads.
    fn change(self, change: &mut dyn FnMut(Expr) -> Expr) {
        for element in self.elements {
            if let Some(law) = element.law.over(change) {
                element.law = law;
            }
        }
        for load in self.on_structure {
            let values: Vec<&mut Expr> = match &mut load.action {
                structure::Action::Point { value, .. } => value.iter_mut().collect(),
                structure::Action::Distributed { value, .. } => value.iter_mut().flatten().collect(),
            };
            values.into_iter().for_each(|value| *value = change(*value));
        }
    }
}

/// Replaces t by the time since the last restart, also inside parameters that are formulas of time.
struct Rewriting {
    substitution: Substitution,
}

impl Rewriting {
    fn new(reader: &mut Reader, parameters: &[ParameterDecl], set_by_phases: impl Fn(&str) -> bool, elapsed: Expr) -> Rewriting {
        let mut map: Vec<(SymbolId, Expr)> = vec![(reader.builder.time, elapsed)];
        for p in parameters {
            // what the phases set switches with t itself; what follows from it alone does not run either
            let ParameterValue::Formula(formula) = p.value else { continue };
            if p.class == Class::Constant || set_by_phases(&p.name) {
                continue;
            }
            let rewritten = Substitution::new(map.iter().copied()).apply(&mut reader.builder.graph, formula);
            if rewritten != formula {
                map.push((p.symbol, rewritten));
            }
        }
        Rewriting { substitution: Substitution::new(map) }
    }

    fn apply(&mut self, reader: &mut Reader, e: Expr) -> Expr {
        self.substitution.apply(&mut reader.builder.graph, e)
    }
}
