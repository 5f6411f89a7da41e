//! `[parameters]` and `[coordinates]`.

use super::order::topological;
use super::phases::Schedule;
use super::raw::{RawCoordinate, RawParameter, names_of};
use crate::fields;
use crate::formula::{Context, Depends, Entry, EntryKind, Formula, Kind};
use crate::model::{Class, CoordinateDecl, ParameterDecl, ParameterValue, Reliance};
use crate::reader::{Checked, Fields, Raw, Reader, short};
use crate::snippet::{Site, Snippet};
use crate::units::{Dimension, in_field, mismatch, si_label, written_unit};
use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;
use toml::de::DeValue;
use words::{Notice, Text};

const RESERVED: [&str; 3] = ["pi", "π", "t"];

/// Claims a name of formulas; reports a second claim.
pub(super) fn claim(reader: &mut Reader, name: &str, span: &Range<usize>) -> bool {
    if !reader.name_is_fine(name, span.clone(), &RESERVED) {
        return false;
    }
    if let Some(first) = reader.claimed.get(name).cloned() {
        let d = Notice::file(
            "M011",
            span.clone(),
            Text::new(format!("the name `{name}` is used twice"), format!("имя `{name}` использовано дважды")),
        )
        .why("parameters, coordinates and outputs share one set of names", "у параметров, координат и выходных величин общий список имён")
        .related(first, Text::new("first here", "впервые здесь"));
        reader.report(d);
        return false;
    }
    reader.claimed.insert(name.to_owned(), span.clone());
    true
}

/// The coordinates with their units.
pub(super) fn collect_coordinates<'a>(
    reader: &mut Reader<'a>,
    top: &Fields<'a>,
    notation: &mut Vec<(String, String)>,
) -> Vec<RawCoordinate<'a>> {
    let rows = top.rows(reader, "coordinates");
    // reactions of a structure at rest need no coordinate
    let rests =
        ["supports", "pins", "welds", "sliders", "rods", "ropes", "threads", "sections", "nodes"].into_iter().any(|table| top.has(table));
    if rows.is_empty() && !rests {
        let fault = Notice::piece("M015", top.span_of("coordinates"), "the model has no coordinates", "в модели нет координат")
            .why("a machine without a degree of freedom does not move", "у машины без степеней свободы нет движения")
            .help(
                "add [coordinates] with for example phi = { unit = \"rad\" }",
                "добавьте [coordinates], например phi = { unit = \"rad\" }",
            );
        reader.fault(fault);
    }
    let mut found = Vec::new();
    for (name, span, value) in rows {
        if !claim(reader, name, &span) {
            continue;
        }
        let mut coordinate = RawCoordinate {
            name: name.to_owned(),
            span: span.clone(),
            dimension: Kind::Unknown,
            scaled: None,
            start: None,
            rate: None,
            guesses: [None, None],
            label: Text::default(),
        };
        let unit = match value.get_ref() {
            DeValue::Table(table) => {
                let fields = Fields::open(reader, &fields::COORDINATE, table, span, format!("coordinates.{}", short(name)));
                fields.symbol(reader, name, notation);
                coordinate.label = fields.text(reader, "label").unwrap_or_default();
                coordinate.start = fields.raw(reader, "start");
                coordinate.rate = fields.raw(reader, "rate");
                coordinate.guesses = ["guess", "rate_guess"].map(|key| fields.raw(reader, key));
                fields.get("unit").and_then(|v| reader.unit(v))
            }
            _ => reader.unit(value),
        };
        if let Some((unit, written)) = unit {
            coordinate.dimension = Kind::Known(unit.dimension);
            coordinate.scaled = (unit.factor != crate::units::Factor::ONE).then_some(written);
        }
        found.push(coordinate);
    }
    found
}

/// The displacements of a frame that have names: coordinates like any other.
pub(super) fn collect_displacements<'a>(
    reader: &mut Reader<'a>,
    top: &Fields<'a>,
    notation: &mut Vec<(String, String)>,
) -> Vec<RawCoordinate<'a>> {
    let mut found = Vec::new();
    for (name, fields) in top.entries(reader, "displacements", &fields::structures::DISPLACEMENT) {
        if !claim(reader, &name, &fields.span) {
            continue;
        }
        fields.symbol(reader, &name, notation);
        let turns = fields.get("direction").and_then(|v| v.get_ref().as_str()) == Some("turn");
        found.push(RawCoordinate {
            dimension: Kind::Known(if turns { Dimension::ANGLE } else { Dimension::LENGTH }),
            scaled: None,
            start: fields.raw(reader, "start"),
            rate: fields.raw(reader, "rate"),
            guesses: [None, None],
            label: fields.text(reader, "label").unwrap_or_default(),
            span: fields.span.clone(),
            name,
        });
    }
    found
}

/// Makes the coordinates known to formulas.
pub(super) fn declare_coordinates(reader: &mut Reader, coordinates: &[RawCoordinate]) {
    for c in coordinates {
        let symbols = [0, 1, 2].map(|primes| reader.builder.graph.symbol_id(&c.name, primes));
        reader.scope.declare(&c.name, Entry { kind: EntryKind::Coordinate(symbols), dimension: c.dimension, depends: Depends::POSITION });
    }
}

/// The start values.
pub(super) fn starts<'a>(reader: &mut Reader<'a>, raw: Vec<RawCoordinate<'a>>) -> Vec<CoordinateDecl> {
    raw.into_iter().map(|c| start_of(reader, c)).collect()
}

fn start_of<'a>(reader: &mut Reader<'a>, c: RawCoordinate<'a>) -> CoordinateDecl {
    let dimension = match c.dimension {
        Kind::Known(d) => Some(d),
        _ => None,
    };
    let rate_dimension = dimension.map(|d| d.per_time(1));
    let set: Vec<String> = [c.name.clone(), format!("{}'", c.name)].into_iter().filter(|name| reader.override_of(name).is_some()).collect();
    let mut read = |raw: Option<Raw<'a>>, name: String, wanted: Option<&Dimension>| {
        if let Some(unit) = &c.scaled {
            let unit = if name.ends_with('\'') { per_second(unit) } else { unit.clone() };
            reader.scaled.insert(name.clone(), unit);
        }
        let wanted_by_hand = reader.override_of(&name).map(|snippet| by_hand(reader, (&name, snippet), wanted));
        if let Some(value) = wanted_by_hand {
            return value.expr;
        }
        let Some(raw) = raw else { return reader.builder.graph.zero() };
        refuse_bare(reader, &name, &raw);
        reader.value(&raw, &Context::CONSTANT, wanted).expr
    };
    let given = [(&c.start, c.name.clone()), (&c.rate, format!("{}'", c.name))].map(|(raw, name)| raw.is_some() || set.contains(&name));
    let [guess, rate_guess] = c.guesses;
    let guessed = [guess.is_some() && !given[0], rate_guess.is_some() && !given[1]];
    let start = read(c.start.or(guess), c.name.clone(), dimension.as_ref());
    let rate = read(c.rate.or(rate_guess), format!("{}'", c.name), rate_dimension.as_ref());
    let symbols = [0, 1, 2].map(|primes| reader.builder.graph.symbol_id(&c.name, primes));
    let base = dimension.unwrap_or(Dimension::NONE);
    let units = [0, 1, 2].map(|order| si_label(&base.per_time(order)));
    CoordinateDecl { name: c.name, symbols, units, start, rate, given, guessed, label: c.label, span: c.span }
}

/// The unit of a rate.
fn per_second(unit: &str) -> String {
    format!("{unit}/s")
}

/// Reports a number without a unit for something that the file gives in another unit than the SI one.
fn refuse_bare(reader: &mut Reader, name: &str, raw: &Raw) {
    let Some(unit) = reader.scaled.get(name).filter(|_| raw.formula.as_ref().is_some_and(Formula::lacks_unit)) else { return };
    let fault = without_unit(raw.snippet.all(), (name, unit), raw.snippet.text.trim());
    let finding = raw.snippet.diagnose(fault);
    reader.report(finding);
}

/// The unit of a parameter when the file gives it in another unit than the SI one; a value made of several quantities gets the SI unit, to be written.
fn other_unit(p: &RawParameter, kind: Kind) -> Option<String> {
    if let Some((unit, _, written)) = &p.unit
        && unit.is_scaled()
    {
        return Some(written.clone());
    }
    let formula = p.raw.formula.as_ref().filter(|f| f.is_scaled())?;
    let own = formula.only_quantity().and_then(|span| p.raw.snippet.text.get(span)).and_then(written_unit);
    match (own, kind) {
        (Some(unit), _) => Some(unit.to_owned()),
        (None, Kind::Known(d)) => Some(si_label(&d)).filter(|label| label != "1"),
        (None, _) => None,
    }
}

/// The fault of a number without a unit for something that the file gives in another unit than the SI one.
pub(super) fn without_unit(span: Range<usize>, (name, unit): (&str, &str), number: &str) -> Notice {
    let si =
        crate::units::parse_unit(unit).map(|u| si_label(&u.dimension)).ok().filter(|si| si != unit && si != "1").map(|si| Text::unit(&si));
    let (or, or_ru) = si
        .map_or_else(Default::default, |si| (format!(", or in SI \"{number} {}\"", si.en), format!(" или, в СИ, \"{number} {}\"", si.ru)));
    let unit = Text::unit(unit);
    Notice::piece(
        "M023",
        span,
        format!("a number without a unit, while `{name}` is in {}", unit.en),
        format!("число без единицы, хотя `{name}` задано в {}", unit.ru),
    )
    .help(format!("write the unit: \"{number} {}\"{or}", unit.en), format!("напишите единицу: \"{number} {}\"{or_ru}", unit.ru))
}

/// A value from the command line: a bare number is SI, and refused where the file uses another unit.
fn by_hand<'a>(reader: &mut Reader<'a>, (name, snippet): (&str, Snippet<'a>), wanted: Option<&Dimension>) -> Checked {
    let raw = reader.raw_text(snippet);
    refuse_bare(reader, name, &raw);
    let bare = raw.formula.as_ref().is_some_and(Formula::is_bare_number);
    reader.value(&raw, &Context::CONSTANT, wanted.filter(|_| !bare))
}

/// The parameters as written, and the predefined g.
pub(super) fn collect<'a>(reader: &mut Reader<'a>, top: &Fields<'a>, notation: &mut Vec<(String, String)>) -> Vec<RawParameter<'a>> {
    let mut found = Vec::new();
    let rows = ["parameters", "unknowns"].map(|table| top.rows(reader, table).into_iter().map(|row| (table, row)).collect::<Vec<_>>());
    for (section, (name, span, value)) in rows.into_iter().flatten() {
        if !claim(reader, name, &span) {
            continue;
        }
        let (mut unit, mut label) = (None, Text::default());
        let raw = match value.get_ref() {
            DeValue::Table(table) => {
                let fields = Fields::open(reader, &fields::PARAMETER, table, span.clone(), format!("{section}.{}", short(name)));
                fields.symbol(reader, name, notation);
                label = fields.text(reader, "label").unwrap_or_default();
                unit = fields.get("unit").and_then(|v| reader.unit(v).map(|(unit, written)| (unit, v.span(), written)));
                fields.raw(reader, "value")
            }
            _ => reader.raw(value),
        };
        let raw = raw.unwrap_or(Raw { snippet: nowhere(span.clone()), formula: None });
        let by_hand = reader.override_of(name).map(|snippet| reader.raw_text(snippet));
        found.push(RawParameter { name: name.to_owned(), span: Some(span), raw, by_hand, unit, label });
    }
    if !reader.claimed.contains_key("g") && !reader.is_output("g", top) {
        let snippet = Snippet { text: Cow::Borrowed("9.81 m/s^2"), site: Site::Inside(0..0) };
        let raw = reader.raw_text(snippet);
        let label = Text::new("acceleration of gravity", "ускорение свободного падения");
        let by_hand = reader.override_of("g").map(|snippet| reader.raw_text(snippet));
        found.push(RawParameter { name: "g".to_owned(), span: None, raw, by_hand, unit: None, label });
    }
    found
}

fn nowhere<'a>(span: Range<usize>) -> Snippet<'a> {
    Snippet { text: Cow::Borrowed(""), site: Site::Inside(span) }
}

/// Checks the parameters in the order of their dependence.
pub(super) fn resolve<'a>(reader: &mut Reader<'a>, raw: Vec<RawParameter<'a>>, schedule: &mut Schedule<'a>) -> Vec<ParameterDecl> {
    let index: HashMap<&str, usize> = raw.iter().enumerate().map(|(i, p)| (p.name.as_str(), i)).collect();
    let by_hand = |p: &RawParameter| p.by_hand.iter().flat_map(names_of).filter_map(|n| index.get(n).copied()).collect::<Vec<_>>();
    let uses =
        |p: &RawParameter| names_of(&p.raw).chain(schedule.dependencies(&p.name)).filter_map(|n| index.get(n).copied()).collect::<Vec<_>>();
    let dependencies: Vec<Vec<usize>> = raw.iter().map(|p| uses(p).into_iter().chain(by_hand(p)).collect()).collect();
    let (order, cycles) = topological(&dependencies);
    for cycle in &cycles {
        let names: Vec<&str> = cycle.iter().chain(cycle.first()).map(|i| raw[*i].name.as_str()).collect();
        let p = &raw[cycle[0]];
        let finding = p.raw.snippet.diagnose(cycle_fault(p.raw.snippet.all(), &names));
        reader.report(finding);
        for i in cycle {
            let symbol = reader.builder.graph.symbol_id(&raw[*i].name, 0);
            let entry = Entry { kind: EntryKind::Parameter(symbol), dimension: Kind::Unknown, depends: Depends::NOTHING };
            reader.scope.declare(&raw[*i].name, entry);
        }
    }
    let cyclic: std::collections::HashSet<usize> = cycles.into_iter().flatten().collect();
    let mut raw: Vec<Option<RawParameter>> = raw.into_iter().map(Some).collect();
    let mut declared = Vec::with_capacity(raw.len());
    for i in order {
        if let Some(p) = raw[i].take()
            && !cyclic.contains(&i)
        {
            declared.push(declare(reader, p, schedule));
        }
    }
    declared
}

/// The fault of definitions that need each other.
pub(super) fn cycle_fault(span: Range<usize>, names: &[&str]) -> Notice {
    let chain = if names.len() > 12 { format!("{} -> ...", names[..12].join(" -> ")) } else { names.join(" -> ") };
    Notice::piece("M040", span, format!("cyclic definition: {chain}"), format!("циклическое определение: {chain}"))
        .why("each of these values needs the next one first", "каждая из этих величин требует сначала следующую")
        .help("give one of them as a number, or solve the relation by hand", "задайте одну из них числом или разрешите зависимость вручную")
}

fn declare<'a>(reader: &mut Reader<'a>, mut p: RawParameter<'a>, schedule: &mut Schedule<'a>) -> ParameterDecl {
    apply_unit(reader, &mut p);
    let by_hand = p.by_hand.take();
    let mut written = p.raw.snippet.text.trim().to_owned();
    let mut value = reader.value(&p.raw, &Context::PARAMETER, None);
    let mut symbol_free = p.raw.formula.as_ref().is_some_and(Formula::is_symbol_free);
    if let Some((unit, span, _)) = &p.unit {
        match value.kind {
            Kind::Known(d) if !d.same(&unit.dimension) => reader.fault(mismatch(span.clone(), &unit.dimension, &d)),
            Kind::Known(d) => {
                if let Some(fault) = in_field(&d, &unit.dimension, p.raw.snippet.all()) {
                    let finding = p.raw.snippet.diagnose(fault);
                    reader.report(finding);
                }
                value.kind = Kind::Known(if d.counts_periods() || d.has_radians() { d } else { d.with_angle_of(&unit.dimension) });
            }
            Kind::Any => value.kind = Kind::Known(unit.dimension),
            Kind::Unknown => {}
        }
    }
    if let Some(unit) = other_unit(&p, value.kind) {
        reader.scaled.insert(p.name.clone(), unit);
    }
    let symbol = |reader: &mut Reader, name: &str| reader.builder.graph.symbol_id(name, 0);
    let uses: Vec<_> = names_of(&p.raw).chain(by_hand.iter().flat_map(names_of)).map(|name| symbol(reader, name)).collect();
    if by_hand.is_some() || uses.iter().any(|s| reader.by_hand.contains(s)) {
        let own = symbol(reader, &p.name);
        reader.by_hand.insert(own);
    }
    if let Some(raw) = by_hand {
        refuse_bare(reader, &p.name, &raw);
        let wanted = match value.kind {
            Kind::Known(d) => Some(d),
            _ => None,
        };
        raw.snippet.text.trim().clone_into(&mut written);
        // a bare number is SI
        let bare = raw.formula.as_ref().is_some_and(Formula::is_bare_number);
        let set = reader.value(&raw, &Context::PARAMETER, wanted.as_ref().filter(|_| !bare));
        let kind = match (wanted, set.kind) {
            (Some(w), Kind::Known(d)) if !w.is_angular() => Kind::Known(w.with_angle_of(&d)),
            (Some(_), _) => value.kind,
            (None, kind) => kind,
        };
        value = Checked { kind, ..set };
        symbol_free = raw.formula.as_ref().is_some_and(Formula::is_symbol_free);
    }
    if let Some(over_time) = schedule.scheduled(reader, &p.name, value) {
        value = over_time;
        symbol_free = false;
    }
    let shown = if symbol_free { ParameterValue::Number { si: value.expr } } else { ParameterValue::Formula(value.expr) };
    finish(reader, p, value, (written, shown))
}

/// `{ value = 5, unit = "kg" }` is 5 kg.
fn apply_unit(reader: &mut Reader, p: &mut RawParameter) {
    let (Some((unit, ..)), Some(formula)) = (&p.unit, &p.raw.formula) else { return };
    if let Some(number) = formula.bare_number() {
        let quantity = crate::units::Quantity { number: number.clone(), unit: unit.clone(), has_unit: true };
        if !quantity.to_f64().is_finite() {
            let finding = p.raw.snippet.diagnose(crate::units::out_of_range(p.raw.snippet.all()));
            reader.report(finding);
        }
        p.raw.formula = Some(Formula::quantity(quantity, p.raw.snippet.all()));
    }
}

fn finish(reader: &mut Reader, p: RawParameter, value: Checked, (written, shown): (String, ParameterValue)) -> ParameterDecl {
    let symbol = reader.builder.graph.symbol_id(&p.name, 0);
    let number = reader.number_for(&value, Reliance::Finite);
    if let Some(n) = number {
        reader.values.set(&mut reader.builder.graph, symbol, n);
    }
    let class = if value.depends.is_state() {
        Class::State
    } else if value.depends.is_constant() {
        Class::Constant
    } else {
        Class::Time
    };
    let dimension = if value.good { value.kind } else { Kind::Unknown };
    reader.scope.declare(&p.name, Entry { kind: EntryKind::Parameter(symbol), dimension, depends: value.depends });
    ParameterDecl {
        name: p.name,
        symbol,
        value: shown,
        class,
        number,
        unit: si_label(&value.kind.or_none()),
        written,
        label: p.label,
        span: p.span,
    }
}

impl Reader<'_> {
    /// Whether the file has an output of that name.
    fn is_output(&self, name: &str, top: &Fields) -> bool {
        top.get("outputs").and_then(|v| v.get_ref().as_table()).is_some_and(|t| t.contains_key(name))
    }
}
