//! The study `sweep`: another study repeated over values of parameters, starts or starting rates. The solution found before is the next guess.

mod repeated;
mod rests;

use super::keys::OWN_PLOT;
use super::{Finds, Found, Given, Interrupts, Repeats, Results, Rows, Studies, Study, overlaid};
use crate::failure::{Failure, Misuse};
use crate::machine::{self, Machine};
use crate::observable::{Absent, Observable};
use crate::results::finite::checked;
use crate::watch::{Lap, Watch};
use crate::{periodic, provenance, simulate, statics};
use analysis::dataset::{Audit, Column, Missing};
use analysis::reduce::NAMES;
use analysis::{Dataset, Quantity};
use mechanics::asked::{Asked, Key, Kind, Takes, Value as Taken, Way, Words};
use mechanics::model::{Plot, SweepRange};
use serde_json::{Value, json};
use std::sync::atomic::Ordering;
use words::{Notice, Text};

use repeated::{Repeated, changed, observing, one};

/// Results of the study `periodic` that no other study has.
const OF_PERIODIC: [&str; 5] = ["period", "frequency", "multiplier", "stable", "gain"];
/// Studies that find what they need without a word of the file.
static ALONE: [&Kind; 2] = [&periodic::KIND, &statics::KIND];
/// What a sweep repeats.
const REPEATED: Words = (
    "a sweep repeats a study of the file: simulate, periodic, equilibrium, cycle, statics, inverse",
    "серия повторяет расчёт из файла: simulate, periodic, equilibrium, cycle, statics, inverse",
);

/// A study repeated over values of parameters; SI.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// What is changed, the first slowest.
    pub over: Vec<SweepRange>,
    /// What is noted: outputs, or results of the study (`period`).
    pub observe: Vec<String>,
    /// Kind of the study of the file that is repeated; `None`: the first that has the results.
    pub of: Option<String>,
    /// Plots wanted, of what is noted over the values.
    pub plots: Vec<Plot>,
    /// Values of the repeated study in place of those of the file.
    pub inner: Asked,
}

impl Sweep {
    /// The repetition that is asked for.
    pub fn of(asked: &Asked) -> Sweep {
        let mut inner = Asked::default();
        let others = asked.values().iter().filter(|(key, _)| KIND.key(key).is_none());
        others.for_each(|(key, value)| inner.set(key, value.clone()));
        Sweep {
            over: if let Some(Taken::Ranges(over)) = asked.get("over") { over.clone() } else { Vec::new() },
            observe: asked.words("observe").to_vec(),
            of: asked.word("of").map(str::to_owned),
            plots: asked.plots().to_vec(),
            inner,
        }
    }
}

/// The study.
pub struct Sweeping;

/// Its name and its keys.
pub static KIND: Kind = Kind::new("sweep", ("Repeat a study over values of parameters", "Повторить расчёт для ряда значений параметров"))
    .keys(&[
        Key::new(
            "over",
            Takes::Ranges,
            (
                "name=linspace(first, last, number), logspace or a list of values, or an array of such strings",
                "имя=linspace(первое, последнее, число), logspace или список значений, или массив таких строк",
            ),
            "\"v=linspace(1 m/s, 3 m/s, 21)\"",
        )
        .required()
        .option(
            "Values of a parameter or start: v=linspace(1 m/s, 3 m/s, 21), c=logspace(1 N/m, 1 kN/m, 4), m=1 kg, 2 kg; may be repeated",
            "Значения параметра или начального условия: v=linspace(1 м/с, 3 м/с, 21), c=logspace(1 Н/м, 1 кН/м, 4), \"m=1 кг; 2 кг\"; ключ можно повторять",
        )
        .way(Way::Begins),
        Key::new(
            "observe",
            Takes::Names,
            (
                "results noted for each value; or one name: an output (its greatest and least value), max(..), min(..), mean(..), last(..), amplitude(..) of one, events (their number), or a number of the repeated study by its path in JSON, as period or multipliers.0.abs",
                "результаты, записываемые для каждого значения; или одно имя: величина из [outputs] (её наибольшее и наименьшее значения), max(..), min(..), mean(..), last(..), amplitude(..) от неё, events (число событий) или число повторяемого расчёта по его пути в JSON: period, multipliers.0.abs",
            ),
            "[\"period\"]",
        )
        .option(
            "What is noted: events, max(x), min(x), amplitude(x), mean(x), last(x), or a number of the study's JSON, whose lists count from 0: period, multipliers.1.abs",
            "Что записывать: events, max(x), min(x), amplitude(x), mean(x), last(x) либо число из JSON расчёта, где списки нумеруются с 0: period, multipliers.1.abs",
        )
        .way(Way::Written),
        Key::new(
            "of",
            Takes::Repeatable,
            ("kind of the study of the file that is repeated", "вид расчёта из файла, который повторяется"),
            "\"periodic\"",
        )
        .default("first that fits", "первый подходящий")
        .option("The study that is repeated, when the file has several", "Повторяемый расчёт, если в файле их несколько")
        .way(Way::Written),
        OWN_PLOT,
    ]);

impl Study for Sweeping {
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn wanted(&self) -> Words {
        ("investigate the influence of parameters", "исследовать влияние параметров")
    }
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        Some(repeated(machine, &Sweep::of(asked), watch))
    }
    /// The command line replaces what it names; the rest is that of the file's study.
    fn merge(&self, _: &Machine, given: Given) -> Result<Asked, Failure> {
        let fresh = given.written.is_some();
        let mut asked = given.written.or(given.of_file.clone()).ok_or_else(nothing_to_sweep)?;
        for key in ["observe", "of"] {
            if let Some(value) = given.of_file.as_ref().and_then(|file| file.get(key)).filter(|_| fresh && !asked.has(key)) {
                asked.set(key, value.clone());
            }
        }
        Ok(overlaid(&KIND, asked, given.line))
    }
    /// Options of every study that it repeats, the first of each name.
    fn inner(&self, all: &Studies) -> Vec<&'static Key> {
        let mut keys: Vec<&'static Key> = Vec::new();
        for key in all.iter().filter(|study| study.kind().repeatable).flat_map(|study| study.kind().keys) {
            let own = KIND.key(key.name).is_some() || keys.iter().any(|k| k.name == key.name);
            // rows and columns are those that are observed; names of coordinates need the study in the file
            let idle = matches!(key.takes, Takes::Results | Takes::Moments | Takes::Step);
            let usable = key.option.is_some() && !idle && !matches!(key.takes, Takes::Coordinate | Takes::RangeOf(_) | Takes::Section);
            if !own && usable {
                keys.push(key);
            }
        }
        keys
    }
    fn interrupts(&self) -> Interrupts {
        Interrupts::Kept
    }
    fn repeats(&self) -> Repeats {
        Repeats::Never
    }
}

fn nothing_to_sweep() -> Failure {
    Notice::new("C033", "over which values?", "по каким значениям?")
        .why("the file has no study `sweep`, and no --over was given", "в файле нет расчёта `sweep`, а ключ --over не задан")
        .help(
            "add --over \"v=linspace(1 m/s, 3 m/s, 21)\" --observe period",
            "добавьте --over \"v=linspace(1 м/с, 3 м/с, 21)\" --observe period",
        )
        .misuse()
}

/// The study for every combination of the values.
pub fn repeated(machine: &mut Machine, study: &Sweep, watch: &mut Watch) -> Results {
    let mut results = Results {
        kind: KIND.name,
        heading: Text::new("Sweep", "Серия расчётов"),
        rows: Rows::All,
        plots: study.plots.clone(),
        ..Results::default()
    };
    match repeat(machine, study, watch, &mut results) {
        Ok(data) => results.data = provenance::stamp(data, &machine.equations, &machine.model_hash),
        Err(trouble) => {
            results.data = machine::no_numbers(machine);
            results.trouble = Some(trouble);
        }
    }
    watch.lap(Lap::Run);
    checked(results)
}

/// Runs row by row, then what is said of all of them, in the order of the page.
fn repeat(machine: &Machine, study: &Sweep, watch: &mut Watch, results: &mut Results) -> Result<Dataset, Notice> {
    let wanted = wanted(machine, study)?;
    let (base, of) = base(machine, study, &wanted)?;
    let repeated = Repeated { base: &base, of, inner: &study.inner };
    let count: usize = study.over.iter().map(|range| range.values.len()).product();
    let mut data = Dataset { axis: (study.over.len() == 1).then_some(0), ..Dataset::default() };
    let mut rows = Gathered::new(machine, study, &wanted);
    let (mut changed, mut anew, mut guess) = (machine.clone(), 0, None);
    for row in 0..count {
        if watch.interrupt.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            data.partial = true;
            data.notes.push(Text::new(format!("interrupted after {row} of {count} values"), format!("прервано: сделано {row} из {count}")));
            break;
        }
        let values = place(&study.over, row);
        let outcome = one((&mut changed, &mut anew), &repeated, &values, &mut guess, watch);
        rows.take(machine, &wanted, &values, outcome);
        if let Some(progress) = &mut watch.progress {
            progress((row + 1) as f64 / count as f64);
        }
    }
    let mut without = rows.tell(&mut data, results, count);
    if machine.origin.studies.finds(base.kind) == Finds::Rest && study.over.len() == 1 {
        let changes = rests::remarks(&mut changed, &repeated, &rows.columns[0].quantity, &rows.stands);
        let list: Vec<Value> = changes.iter().map(|(value, what)| json!({"value": value, "what": what.en})).collect();
        results.own.insert("changes".into(), json!(list));
        data.notes.extend(changes.into_iter().map(|c| c.1));
    }
    results.own.insert("of".into(), json!(base.kind));
    results.own.insert("read_anew".into(), json!(anew));
    if study.of.is_none() && machine.model.studies.iter().filter(|s| moves(machine, s) || rests(machine, s)).count() > 1 {
        let name = base.kind;
        data.notes.push(Text::new(format!("repeated: the study `{name}`"), format!("повторялся расчёт `{name}`")));
    }
    if results.plots.is_empty() && study.over.len() == 1 {
        let plot = |c: &Column| mechanics::model::Plot { title: Text::default(), x: None, y: vec![c.quantity.name.clone()] };
        results.plots = rows.columns[rows.own..].iter().map(plot).collect();
    }
    without.extend(partly_absent(&rows.columns[rows.own..], &without));
    data.columns = rows.columns;
    without.into_iter().for_each(|(column, words)| data.state(&column, Missing::Absent, words));
    Ok(data)
}

/// What the runs have given so far.
struct Gathered {
    /// The values first, then what is wanted.
    columns: Vec<Column>,
    /// Number of columns of values.
    own: usize,
    failed: usize,
    /// The first of the troubles.
    first: Option<Notice>,
    /// Runs with checks, and those of which a check failed.
    checked: usize,
    doubtful: Vec<(Vec<(String, f64)>, Audit)>,
    stands: Vec<(f64, rests::Stands)>,
}

impl Gathered {
    fn new(machine: &Machine, study: &Sweep, wanted: &[(Quantity, Observable)]) -> Gathered {
        let mut columns: Vec<Column> = study.over.iter().map(|range| column_of(machine, range)).collect();
        columns.extend(wanted.iter().map(|(quantity, _)| Column { quantity: quantity.clone(), values: Vec::new() }));
        Gathered { columns, own: study.over.len(), failed: 0, first: None, checked: 0, doubtful: Vec::new(), stands: Vec::new() }
    }

    /// The row of one run.
    fn take(&mut self, machine: &Machine, wanted: &[(Quantity, Observable)], values: &[(String, f64)], outcome: Result<Results, Notice>) {
        self.stands.push((values[0].1, outcome.as_ref().ok().and_then(|finding| rests::stands(machine, &finding.data))));
        if let Ok(finding) = &outcome {
            let audits = &finding.data.audits;
            self.checked += usize::from(!audits.is_empty());
            self.doubtful.extend(audits.iter().find(|a| !a.ok).map(|audit| (values.to_vec(), audit.clone())));
        }
        let outcome = outcome.and_then(|finding| wanted.iter().map(|(_, w)| number(&finding, w)).collect::<Result<Vec<_>, _>>());
        let (own, found) = self.columns.split_at_mut(self.own);
        for (column, (_, value)) in own.iter_mut().zip(values) {
            column.values.push(*value);
        }
        match outcome {
            Ok(numbers) => {
                for ((column, (quantity, _)), (value, described)) in found.iter_mut().zip(wanted).zip(numbers) {
                    column.values.push(value);
                    if quantity.unit == "1" && column.quantity.unit == "1" {
                        column.quantity = described.unwrap_or_else(|| quantity.clone());
                    }
                }
            }
            Err(trouble) => {
                found.iter_mut().for_each(|column| column.values.push(f64::NAN));
                self.failed += 1;
                self.first.get_or_insert(trouble);
            }
        }
    }

    /// Checks and troubles of all runs; the columns that lack values for these.
    fn tell(&mut self, data: &mut Dataset, results: &mut Results, count: usize) -> Vec<(String, Text)> {
        if self.checked > 0 {
            data.audits.push(judged(self.doubtful.len()));
            data.notes.extend(self.doubtful.first().map(|(values, audit)| doubt(values, audit)));
        }
        let Some(trouble) = self.first.take() else { return Vec::new() };
        let (en, ru) = (&trouble.what.en, &trouble.what.ru);
        let (code, failed) = (trouble.code, self.failed);
        let words = Text::new(
            format!("no result for {failed} of {count} values; the first: {en} [{code}]"),
            format!("нет результата для {failed} значений из {count}; первое: {ru} [{code}]"),
        );
        let without = self.columns[self.own..].iter().map(|c| (c.quantity.name.clone(), words.clone())).collect();
        data.notes.push(words);
        if failed == count {
            results.trouble = Some(trouble);
        }
        without
    }
}

/// Columns with numbers at some values only, of which nothing has been said.
fn partly_absent(columns: &[Column], said: &[(String, Text)]) -> Vec<(String, Text)> {
    let absent = Text::new("the study has no such number at this value", "при этом значении такого числа в расчёте нет");
    let partly = |c: &&Column| c.values.iter().any(|v| v.is_finite()) && said.iter().all(|(name, _)| *name != c.quantity.name);
    columns.iter().filter(partly).map(|c| (c.quantity.name.clone(), absent.clone())).collect()
}

/// The checks of all runs.
fn judged(failed: usize) -> Audit {
    let name = Text::new("repeated studies of which a check failed", "повторённых расчётов, в которых не выполнена проверка");
    Audit::at_most("repeated", name, failed as f64, 0.0)
}

/// The first run of which a check failed.
fn doubt(values: &[(String, f64)], audit: &Audit) -> Text {
    let shown: Vec<(String, Text)> = values.iter().map(|(name, value)| (name.clone(), words::digits::rounded(*value))).collect();
    let list =
        |pick: fn(&Text) -> &str| shown.iter().map(|(name, value)| format!("{name} = {}", pick(value))).collect::<Vec<_>>().join(", ");
    Text::new(
        format!("the check that failed at {}: {}", list(|t| &t.en), audit.name.en),
        format!("проверка, не выполненная при {}: {}", list(|t| &t.ru), audit.name.ru),
    )
}

/// Values of all ranges in a row; the last range changes fastest.
fn place(over: &[SweepRange], row: usize) -> Vec<(String, f64)> {
    let mut rest = row;
    let mut values: Vec<(String, f64)> = over
        .iter()
        .rev()
        .map(|range| {
            let k = rest % range.values.len();
            rest /= range.values.len();
            (range.name.clone(), range.values[k])
        })
        .collect();
    values.reverse();
    values
}

fn column_of(machine: &Machine, range: &SweepRange) -> Column {
    let model = &machine.model;
    let base = range.name.trim_end_matches('\'');
    let primes = range.name.len() - base.len();
    let symbol = model.notation.iter().find(|(n, _)| n == base).map_or(base, |(_, s)| s.as_str());
    let mut quantity = Quantity { symbol: format!("{symbol}{}", "'".repeat(primes)), ..Quantity::new(&range.name, "1") };
    if let Some(p) = model.parameters.iter().find(|p| p.name == range.name) {
        (quantity.unit, quantity.label) = (p.unit.clone(), p.label.clone());
    } else if let Some(c) = model.coordinates.iter().find(|c| c.name == base) {
        quantity.unit = c.units.get(primes).cloned().unwrap_or_default();
    }
    Column { quantity, values: Vec::new() }
}

/// What the names in `observe` mean, with the columns they fill.
fn wanted(machine: &Machine, study: &Sweep) -> Result<Vec<(Quantity, Observable)>, Notice> {
    let outputs = &machine.equations.outputs;
    let quantity = |observable: &Observable, output: &symbolic::equations::Output| {
        let shown = machine.model.notation.iter().find(|(n, _)| *n == output.name).map_or(output.name.as_str(), |(_, s)| s.as_str());
        Quantity {
            symbol: format!("{shown}_{}", observable.word()),
            label: output.label.clone(),
            display: output.display.clone(),
            ..Quantity::new(&observable.to_string(), &output.unit)
        }
    };
    let mut found = Vec::new();
    for text in &study.observe {
        for observable in Observable::read(text, &|name| outputs.iter().any(|o| o.name == name)) {
            let described = match &observable {
                Observable::Events => {
                    Quantity { label: Text::new("number of events", "число событий"), ..Quantity::new("events", "1") }
                }
                Observable::Field(_) => Quantity::new(&observable.to_string(), "1"),
                Observable::Extreme(_, of) | Observable::Amplitude(of) | Observable::Mean(of) | Observable::Last(of) => {
                    quantity(&observable, outputs.iter().find(|o| o.name == *of).ok_or_else(|| unknown(of, machine))?)
                }
            };
            found.push((described, observable));
        }
    }
    if let Some(of) = study.of.as_deref().filter(|of| found.is_empty() && *of != periodic::KIND.name) {
        return Err(nothing_observed(of));
    }
    if found.is_empty() {
        found.push((Quantity::new("period", "1"), Observable::field("period")));
    }
    Ok(found)
}

fn unknown(name: &str, machine: &Machine) -> Notice {
    let trouble = Notice::new("C008", format!("there is no output `{name}`"), format!("нет выходной величины `{name}`"));
    match words::nearest(name, machine.equations.outputs.iter().map(|o| o.name.as_str())) {
        Some(near) => trouble.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
        None => trouble,
    }
}

/// The study to repeat, with the columns that are wanted.
fn base(machine: &Machine, study: &Sweep, wanted: &[(Quantity, Observable)]) -> Result<(Asked, Option<usize>), Notice> {
    let fields = || wanted.iter().filter_map(|(_, w)| w.root());
    let of_periodic = fields().any(|name| OF_PERIODIC.iter().any(|p| name.starts_with(p)));
    let kind = study.of.as_deref().or(of_periodic.then_some(periodic::KIND.name));
    let first = |fits: &dyn Fn(&Asked) -> bool| machine.model.studies.iter().position(fits);
    let repeatable = |asked: &Asked| machine.origin.studies.finds(asked.kind) != Finds::Formulas && sort(machine, asked) != Repeats::Never;
    let of = match kind {
        Some(kind) => first(&|asked| asked.kind == kind),
        // greatest values are those of a motion, else of a place of rest: a shape of modes has no size
        None if wanted.iter().any(|(_, w)| w.root().is_none()) => {
            first(&|asked| moves(machine, asked)).or_else(|| first(&|asked| rests(machine, asked))).or_else(|| first(&repeatable))
        }
        None => first(&repeatable),
    };
    let in_file = of.map(|k| &machine.model.studies[k]);
    let column = wanted.iter().find_map(|(_, w)| w.column());
    if let (Some(Finds::Shapes), Some(name)) = (in_file.map(|asked| machine.origin.studies.finds(asked.kind)), column) {
        return Err(rows_only(name));
    }
    let mut base = match (in_file, kind) {
        (Some(asked), _) => changed(machine, asked.kind, Some(asked.clone()), &study.inner)?,
        (None, Some(kind)) if ALONE.iter().any(|study| study.name == kind) => changed(machine, kind, None, &study.inner)?,
        (None, Some(kind)) if machine.origin.studies.find(kind).is_some() && !study.inner.values().is_empty() => {
            changed(machine, kind, None, &study.inner)?
        }
        (None, None) if study.inner.has("until") => changed(machine, simulate::KIND.name, None, &study.inner)?,
        _ => {
            return Err(Notice::new("C032", "there is no study to repeat", "нет расчёта, который надо повторять")
                .why(REPEATED.0, REPEATED.1)
                .help("add that study to the file, or observe the period", "добавьте такой расчёт в файл или наблюдайте период (period)"));
        }
    };
    let columns: Vec<String> = wanted.iter().filter_map(|(_, w)| w.column().map(str::to_owned)).collect();
    observing(machine, &mut base, columns);
    Ok((base, of))
}

fn sort(machine: &Machine, asked: &Asked) -> Repeats {
    machine.origin.studies.find(asked.kind).map_or(Repeats::Never, |study| study.repeats())
}

fn moves(machine: &Machine, asked: &Asked) -> bool {
    sort(machine, asked) == Repeats::Motion
}

fn rests(machine: &Machine, asked: &Asked) -> bool {
    sort(machine, asked) == Repeats::Rest
}

/// The number, and what it is where the study itself says so.
fn number(results: &Results, wanted: &Observable) -> Result<(f64, Option<Quantity>), Notice> {
    match (wanted.of(results), wanted) {
        (Ok(value), Observable::Field(path)) => Ok((value, path.fact(results).map(|fact| fact.quantity.clone()))),
        (Ok(value), _) => Ok((value, None)),
        (Err(Absent::AtRowsOnly), _) => Err(rows_only(wanted.column().unwrap_or_default())),
        (Err(Absent::Nothing), _) => Err(no_number(&wanted.to_string(), &Value::Object(results.fields()))),
    }
}

/// The study does not know the quantity between its rows.
fn rows_only(name: &str) -> Notice {
    Notice::new(
        "S100",
        format!("the repeated study knows `{name}` at its rows only, or not at all"),
        format!("повторяемый расчёт знает `{name}` лишь в строках таблицы или не знает вовсе"),
    )
    .help(
        "repeat a study of a motion (of = \"simulate\"), or observe a number of the study itself: of `statics` a reaction, as force(A)",
        "повторяйте расчёт движения (of = \"simulate\") или наблюдайте число самого расчёта: у `statics` реакцию, например force(A)",
    )
}

/// Only a periodic regime has a number of its own that is meant when none is named.
fn nothing_observed(of: &str) -> Notice {
    Notice::new(
        "S085",
        format!("the sweep does not say what to observe of the study `{of}`"),
        format!("в серии не указано, что наблюдать в расчёте `{of}`"),
    )
    .help(format!("give observe = [...]: {}", observable().en), format!("задайте observe = [...]: {}", observable().ru))
}

/// What a sweep may observe besides the numbers of its study.
fn observable() -> Text {
    let of_columns = NAMES.iter().map(|(word, _)| format!("{word}(..)")).collect::<Vec<_>>().join(", ");
    Text::new(
        format!("an output by its name or by {of_columns}; the number of `events`; a number of the study's JSON"),
        format!("величина из [outputs] по имени или через {of_columns}; число событий `events`; число из JSON расчёта"),
    )
}

/// The study's JSON has nothing at this path.
fn no_number(path: &str, fields: &Value) -> Notice {
    let first = path.split('.').next().unwrap_or_default();
    let trouble = Notice::new("S085", format!("the study has no number `{path}`"), format!("в расчёте нет числа `{path}`"));
    match fields.get(first).and_then(Value::as_array).map(Vec::len) {
        Some(n) => trouble.help(
            format!("`{first}` has {n} entries; as in the JSON of the study they are counted from 0"),
            format!("в `{first}` элементов: {n}; как и в JSON расчёта, их счёт начинается с 0"),
        ),
        None => {
            let names = fields
                .as_object()
                .map(|o| o.iter().filter(|(_, v)| !v.is_string()).map(|(k, _)| k.as_str()).collect::<Vec<_>>().join(", "))
                .unwrap_or_default();
            let more = observable();
            trouble.help(format!("it has: {names}; or {}", more.en), format!("в нём есть: {names}; или {}", more.ru))
        }
    }
}
