//! Section points over a parameter: a bifurcation diagram. Each value has its own motion, from the start of the file, with the checks of a motion.

use crate::failure::in_words;
use crate::machine::Machine;
use crate::provenance;
use crate::repeat::gathered::{doubt, judged};
use crate::repeat::quantity;
use crate::results::Results;
use crate::watch::Watch;
use analysis::Dataset;
use analysis::dataset::{Audit, Column};
use mechanics::asked::{Asked, Value};
use mechanics::model::{Plot, SweepRange};
use words::{Notice, Text};

/// Finds the section points of one machine.
pub(super) type Points = fn(&Machine, &Asked, &mut Results, &mut Watch) -> Result<(), Notice>;

/// The parameter of a diagram, where one is asked for.
pub(super) fn over(asked: &Asked) -> Option<&SweepRange> {
    if let Some(Value::Ranges(ranges)) = asked.get("over") { ranges.first() } else { None }
}

/// The points of all values, one below the other, the value in the first column.
///
/// # Errors
/// The trouble of the first value where no value has points.
pub(super) fn diagram(
    machine: &Machine,
    asked: &Asked,
    (results, watch): (&mut Results, &mut Watch),
    points: Points,
) -> Result<(), Notice> {
    let Some(range) = over(asked) else { return Ok(()) };
    let mut found = Found::new(machine, range);
    for (k, value) in range.values.iter().enumerate() {
        if watch.is_interrupted() {
            found.interrupted(k, range.values.len());
            break;
        }
        let values = vec![(range.name.clone(), *value)];
        let single = one((machine, asked), &values, &mut Watch { interrupt: watch.interrupt, ..Watch::default() }, points);
        // what was interrupted on its way is none
        if watch.is_interrupted() {
            found.interrupted(k, range.values.len());
            break;
        }
        found.take(&values, single);
        if let Some(progress) = &mut watch.progress {
            progress((k + 1) as f64 / range.values.len() as f64);
        }
    }
    found.tell(machine, range, results)
}

/// The points at a value, with what the study shows of them.
fn one((machine, asked): (&Machine, &Asked), values: &[(String, f64)], watch: &mut Watch, points: Points) -> Results {
    let mut results = Results::default();
    let mut own = machine.clone();
    let values: Vec<(&str, f64)> = values.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    let done = own.bind(&values).map_err(in_words).and_then(|_| points(&own, &at(machine, &own, asked), &mut results, watch));
    results.trouble = done.err().or(results.trouble);
    results
}

/// The study as the file reads with the value: a period 2*pi/w may depend on it. What the command line says stays.
fn at(machine: &Machine, own: &Machine, asked: &Asked) -> Asked {
    let of_file =
        machine.model.studies.iter().zip(&own.model.studies).find(|(before, _)| before.kind == asked.kind && before.span == asked.span);
    let Some((before, now)) = of_file else { return asked.clone() };
    let mut fresh = now.clone();
    for (key, value) in asked.values() {
        let same = before.get(key).is_some_and(|written| format!("{written:?}") == format!("{value:?}"));
        if !same {
            fresh.set(key, value.clone());
        }
    }
    fresh
}

/// What the values have given so far.
struct Found {
    columns: Vec<Column>,
    audits: usize,
    doubtful: Vec<(Vec<(String, f64)>, Audit)>,
    without: usize,
    trouble: Option<Notice>,
    plots: Vec<Plot>,
    interrupted: Option<Text>,
}

impl Found {
    fn new(machine: &Machine, range: &SweepRange) -> Found {
        Found {
            columns: vec![Column { quantity: quantity(machine, &range.name), values: Vec::new() }],
            audits: 0,
            doubtful: Vec::new(),
            without: 0,
            trouble: None,
            plots: Vec::new(),
            interrupted: None,
        }
    }

    fn interrupted(&mut self, done: usize, all: usize) {
        self.interrupted =
            Some(Text::new(format!("interrupted after {done} of {all} values"), format!("прервано: сделано {done} из {all}")));
    }

    /// The points of a value.
    fn take(&mut self, values: &[(String, f64)], single: Results) {
        let Results { data, trouble, plots, .. } = single;
        let count = data.columns.first().map_or(0, |column| column.values.len());
        if let Some(trouble) = trouble {
            self.without += 1;
            self.trouble.get_or_insert(trouble);
        }
        if count == 0 {
            return;
        }
        if self.columns.len() == 1 {
            self.columns.extend(data.columns.iter().map(|c| Column { values: Vec::new(), ..c.clone() }));
            self.plots = plots;
        }
        self.columns[0].values.extend(std::iter::repeat_n(values[0].1, count));
        for (all, own) in self.columns[1..].iter_mut().zip(data.columns) {
            all.values.extend(own.values);
        }
        self.audits += usize::from(!data.audits.is_empty());
        self.doubtful.extend(data.audits.into_iter().find(|audit| !audit.ok).map(|audit| (values.to_vec(), audit)));
    }

    fn tell(self, machine: &Machine, range: &SweepRange, results: &mut Results) -> Result<(), Notice> {
        let Found { columns, audits, doubtful, without, trouble, plots, interrupted } = self;
        let (count, all) = (columns[0].values.len(), range.values.len());
        let mut data = Dataset { columns, partial: interrupted.is_some(), ..Dataset::default() };
        if audits > 0 {
            data.audits.push(judged(doubtful.len()));
            data.notes.extend(doubtful.first().map(|(values, audit)| doubt(values, audit)));
        }
        if let Some(trouble) = trouble {
            if count == 0 {
                return Err(trouble);
            }
            let (en, ru, code) = (&trouble.what.en, &trouble.what.ru, trouble.code);
            data.notes.push(Text::new(
                format!("{without} of {all} values lack points; the first: {en} [{code}]"),
                format!("точек не хватает для {without} значений из {all}; первое: {ru} [{code}]"),
            ));
            let name = Text::new("values that lack points", "значений, для которых не хватает точек");
            data.audits.push(Audit::at_most("missing", name, without as f64, 0.0));
        }
        data.notes.extend(interrupted);
        results.data = provenance::stamp(data, &machine.equations, &machine.model_hash);
        let name = &range.name;
        results.words.push(Text::new(
            format!("Section points: {count}; values of {name}: {all}."),
            format!("Точек сечения: {count}; значений {name}: {all}."),
        ));
        results.own.insert("points".into(), serde_json::json!(count));
        if results.plots.is_empty() {
            // what a section at one value shows over another quantity stands over the parameter here
            let seen = plots.into_iter().flat_map(|plot| plot.x.into_iter().chain(plot.y)).next();
            let shown = seen.or_else(|| results.data.columns.get(2).map(|column| column.quantity.name.clone()));
            results.plots = shown.map(|y| Plot { title: Text::default(), x: Some(name.clone()), y: vec![y] }).into_iter().collect();
        }
        Ok(())
    }
}
