//! All named quantities at the instants at which an acceleration is greatest, and at the events that the file names: the tables that a course asks for beside the
//! curves.

use super::pen::Pen;
use super::work::Work;
use crate::Finds;
use crate::results::Results;
use crate::simulate::{Simulate, motion};
use crate::watch::Watch;
use mechanics::model::Times;
use report::table::Column;
use report::{Cell, Table};
use symbolic::equations::Role;

/// Significant digits.
const DIGITS: usize = 6;
/// Accelerations that are looked at.
const MOST: usize = 2;

/// Values of every named quantity where an acceleration of the motion is greatest in size.
pub(super) fn of_motion(work: &Work, results: &Results, pen: &mut Pen) {
    if work.finds(results.kind) != Finds::Motion || results.trouble.is_some() {
        return;
    }
    for (name, t) in accelerations(work, results) {
        let Some(table) = at(work, results, &name, t) else { continue };
        let label = results.data.column(&name).map_or("", |c| work.text(&c.quantity.label));
        let what = if label.is_empty() { &name } else { label };
        let caption = work.language.pick(
            format!("Values at the instant of the largest magnitude of “{what}”"),
            format!("Значения величин в момент наибольшего по модулю значения величины «{what}»"),
        );
        pen.table(table, caption);
    }
    at_events(work, results, pen);
}

/// Values of every named quantity at the first of the events that the file names for the reader.
fn at_events(work: &Work, results: &Results, pen: &mut Pen) {
    let Some(any) = results.data.columns.iter().map(|c| c.quantity.name.clone()).find(|n| n != "t") else { return };
    for declared in work.model.events.iter().filter(|e| !e.label.en.is_empty()).take(MOST) {
        let first = results.data.events.iter().find(|e| e.name == declared.name);
        let Some(table) = first.and_then(|event| at(work, results, &any, event.t)) else { continue };
        let what = work.text(&declared.label);
        let caption = work.language.pick(format!("Values at the event “{what}”"), format!("Значения величин в момент события «{what}»"));
        pen.table(table, caption);
    }
}

/// Named quantities that are an acceleration of a coordinate, with the instants of their greatest size within the motion.
fn accelerations(work: &Work, results: &Results) -> Vec<(String, f64)> {
    let equations = work.equations;
    let is_one = |name: &str| {
        equations.outputs.iter().any(|o| {
            let symbol = equations.graph.as_symbol(o.formula);
            o.name == name && o.role == Role::Named && symbol.is_some_and(|s| equations.coordinates.iter().any(|c| c.symbols[2] == s))
        })
    };
    let extremes = results.data.extremes.iter().filter_map(|e| {
        let name = &results.data.columns[e.column].quantity.name;
        let t = if e.max.abs() >= e.min.abs() { e.t_max } else { e.t_min };
        (is_one(name) && e.max != e.min && t.is_finite()).then(|| (name.clone(), t))
    });
    extremes.take(MOST).collect()
}

/// The motion once more, with a row at that instant.
fn at(work: &Work, results: &Results, name: &str, t: f64) -> Option<Table> {
    let until = results.own.get("until").and_then(serde_json::Value::as_f64)?;
    let tolerance = results.own.get("tolerance").and_then(serde_json::Value::as_f64).unwrap_or(crate::simulate::TOLERANCE);
    let study = work.model.studies.iter().find(|s| work.finds(s.kind) == Finds::Motion)?;
    let mut study = Simulate { until: until.min(t), times: Times::At(vec![t]), tolerance, ..Simulate::of(study) };
    study.outputs = results.data.columns.iter().map(|c| c.quantity.name.clone()).filter(|n| n != "t").collect();
    let mut machine = work.calculation.machine.clone();
    let found = motion(&mut machine, &study, &mut Watch::default());
    let row = found.data.columns.iter().find(|c| c.quantity.name == name)?.values.len().checked_sub(1)?;
    let mut table = Table::new(vec![
        Column::new(work.language.word(report::Word::Symbol)),
        Column::new(work.language.word(report::Word::Unit)),
        Column::new(work.language.word(report::Word::Value)),
        Column::new(work.language.word(report::Word::Description)),
    ]);
    table.row(vec![
        Cell::symbol("t"),
        Cell::words(report::unit::print("s", work.language)),
        Cell::number(t, DIGITS, work.language),
        Cell::Empty,
    ]);
    for column in &found.data.columns {
        let quantity = &column.quantity;
        let named = work.equations.outputs.iter().any(|o| o.name == quantity.name && o.role == Role::Named);
        let coordinate = work.model.coordinates.iter().any(|c| c.name == quantity.name);
        let value = column.values.get(row).copied().unwrap_or(f64::NAN);
        if !(named || coordinate) || !value.is_finite() {
            continue;
        }
        let scale = crate::results::tables::scale(quantity, value.abs());
        table.row(vec![
            Cell::symbol(quantity.symbol.clone()),
            Cell::words(scale.print(work.language)),
            Cell::number(value / scale.size, DIGITS, work.language),
            Cell::words(work.text(&quantity.label)),
        ]);
    }
    (table.rows.len() > 1).then_some(table)
}
