//! The rows of a sweep, as they come.

use super::rests::{self, Stands};
use crate::machine::Machine;
use crate::repeat::{self, At, Noted, Repeated, number, one};
use crate::results::Results;
use crate::watch::Watch;
use analysis::dataset::{Audit, Column};
use analysis::{Dataset, Quantity};
use mechanics::model::SweepRange;
use std::sync::atomic::AtomicBool;
use words::{Notice, Text};

/// What the runs have given so far.
pub(super) struct Gathered {
    /// The values first, then what is wanted.
    pub(super) columns: Vec<Column>,
    /// Number of columns of values.
    pub(super) own: usize,
    failed: usize,
    /// The first of the troubles.
    first: Option<Notice>,
    /// Runs with checks, and those of which a check failed.
    checked: usize,
    doubtful: Vec<(Vec<(String, f64)>, Audit)>,
    /// How places of rest stand, value by value.
    pub(super) stands: Vec<(f64, Stands)>,
    /// How often the file was read again.
    pub(super) anew: usize,
    /// Rows without numbers, with the reason.
    reasons: Vec<(usize, Text)>,
}

/// What is kept of one run.
pub(super) struct Row {
    pub(super) values: Vec<(String, f64)>,
    /// What is noted, with its quantity where the study says it itself.
    pub(super) numbers: Result<Vec<(f64, Option<Quantity>)>, Notice>,
    /// The check that failed, where there were checks.
    pub(super) audit: Option<Option<Audit>>,
    pub(super) stands: Stands,
    pub(super) anew: usize,
}

impl Row {
    /// The run at a place.
    pub(super) fn of(at: &mut At, repeated: &Repeated, values: Vec<(String, f64)>, interrupt: Option<&AtomicBool>) -> Row {
        let before = at.anew;
        let outcome = one(at, repeated, &values, &mut Watch { interrupt, ..Watch::default() });
        let audits = outcome.as_ref().ok().map(|finding| &finding.data.audits).filter(|audits| !audits.is_empty());
        let audit = audits.map(|audits| audits.iter().find(|a| !a.ok).cloned());
        let stands = outcome.as_ref().ok().and_then(|finding| rests::stands(&at.machine, &finding.data));
        let numbers = outcome.and_then(|finding| repeated.noted.iter().map(|(_, wanted)| number(&finding, wanted)).collect());
        Row { values, numbers, audit, stands, anew: at.anew - before }
    }
}

impl Gathered {
    pub(super) fn new(machine: &Machine, over: &[SweepRange], wanted: &[Noted]) -> Gathered {
        let mut columns: Vec<Column> =
            over.iter().map(|range| Column { quantity: repeat::quantity(machine, &range.name), values: Vec::new() }).collect();
        columns.extend(wanted.iter().map(|(quantity, _)| Column { quantity: quantity.clone(), values: Vec::new() }));
        Gathered::with(columns, over.len())
    }

    /// With these columns, the first so many for the values.
    pub(super) fn with(columns: Vec<Column>, own: usize) -> Gathered {
        Gathered {
            columns,
            own,
            failed: 0,
            first: None,
            checked: 0,
            doubtful: Vec::new(),
            stands: Vec::new(),
            anew: 0,
            reasons: Vec::new(),
        }
    }

    /// The row of one run.
    pub(super) fn take(&mut self, wanted: &[Noted], row: Row) {
        let Row { values, numbers, audit, stands, anew } = row;
        self.stands.push((values[0].1, stands));
        self.anew += anew;
        self.checked += usize::from(audit.is_some());
        self.doubtful.extend(audit.flatten().map(|audit| (values.clone(), audit)));
        let (own, found) = self.columns.split_at_mut(self.own);
        let place = own.first().map_or(0, |column| column.values.len());
        for (column, (_, value)) in own.iter_mut().zip(&values) {
            column.values.push(*value);
        }
        match numbers {
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
                let (code, what) = (trouble.code, &trouble.what);
                self.reasons.push((place, Text::new(format!("{} [{code}]", what.en), format!("{} [{code}]", what.ru))));
                self.first.get_or_insert(trouble);
            }
        }
    }

    /// Checks and troubles of all runs; the columns that lack values for these.
    pub(super) fn tell(&mut self, data: &mut Dataset, results: &mut Results, count: usize) -> Vec<(String, Text)> {
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
        data.reasons = std::mem::take(&mut self.reasons);
        data.audits.push(Audit::at_most("missing", Text::new("values without a result", "значений без результата"), failed as f64, 0.0));
        if failed == count {
            results.trouble = Some(trouble);
        }
        without
    }
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
