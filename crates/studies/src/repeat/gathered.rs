//! The rows of a study of many runs, as they come.

use super::keys::quantity;
use super::number::number;
use super::one::{At, one};
use super::regimes;
use super::repeated::Repeated;
use super::stands::{self, Stands};
use super::verdict::{is_other, resonance, verdict};
use super::wanted::Noted;
use crate::machine::Machine;
use crate::results::{Fact, Results};
use crate::watch::Watch;
use analysis::dataset::{Audit, Column, Labels, Missing};
use analysis::{Dataset, Quantity};
use mechanics::model::SweepRange;
use std::sync::atomic::AtomicBool;
use words::{Notice, Text};

/// The regime of a row without a result.
const NO_REGIME: usize = usize::MAX;
/// Where the condition of no regime holds.
const NONE: &str = "-";

/// What the runs have given so far.
pub(crate) struct Gathered {
    /// The values first, then what is wanted.
    pub(crate) columns: Vec<Column>,
    /// Number of columns of values.
    pub(crate) own: usize,
    failed: usize,
    /// The first of the troubles.
    first: Option<Notice>,
    /// Runs with checks, and those of which a check failed.
    checked: usize,
    doubtful: Vec<(Vec<(String, f64)>, Audit)>,
    /// Values at which the regime is another one of a family.
    others: Vec<Vec<(String, f64)>>,
    /// How places of rest stand, value by value.
    pub(crate) stands: Vec<(f64, Stands)>,
    /// How often the file was read again.
    pub(crate) anew: usize,
    /// Rows without numbers, with the reason.
    reasons: Vec<(usize, Text)>,
    /// The regime of each row; their number where there is none.
    regimes: Vec<usize>,
    /// Their names; empty where they are not noted.
    names: Vec<String>,
}

/// What is kept of one run.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) values: Vec<(String, f64)>,
    /// What is noted, with its quantity where the study says it itself.
    pub(crate) numbers: Result<Vec<(f64, Option<Quantity>)>, Notice>,
    /// The check that failed, where there were checks.
    pub(crate) audit: Option<Option<Audit>>,
    pub(crate) stands: Stands,
    pub(crate) anew: usize,
    /// The regime of the file by its number, where its numbers are noted.
    pub(crate) regime: Option<usize>,
    /// Whether what was found is stable, where the study says so.
    pub(crate) stable: Option<bool>,
    /// What makes disturbances grow, where the study says so.
    pub(crate) resonance: Option<String>,
    /// Whether it is a regime of a family, and not the one from the given start.
    pub(crate) other: bool,
}

impl Row {
    /// The run at a place.
    pub(crate) fn of(at: &mut At, repeated: &Repeated, values: Vec<(String, f64)>, interrupt: Option<&AtomicBool>) -> Row {
        let before = at.anew;
        let outcome = one(at, repeated, &values, &mut Watch { interrupt, ..Watch::default() });
        let anew = at.anew - before;
        Row::new(at, repeated, (values, anew), outcome)
    }

    /// Of what was found at a place; the file was read so often for it.
    pub(super) fn new(at: &At, repeated: &Repeated, (values, anew): (Vec<(String, f64)>, usize), outcome: Result<Results, Notice>) -> Row {
        let audits = outcome.as_ref().ok().map(|finding| &finding.data.audits).filter(|audits| !audits.is_empty());
        let audit = audits.map(|audits| audits.iter().find(|a| !a.ok).cloned());
        let stands = outcome.as_ref().ok().and_then(|finding| stands::stands(&at.machine, &finding.data));
        let stable = outcome.as_ref().ok().and_then(verdict);
        let resonance = outcome.as_ref().ok().and_then(resonance);
        let other = outcome.as_ref().is_ok_and(is_other);
        let numbers: Result<Vec<_>, Notice> =
            outcome.and_then(|finding| repeated.noted.iter().map(|(_, wanted)| number(&finding, wanted)).collect());
        let regime = numbers.as_ref().ok().and_then(|found| regimes::of(&at.machine, &repeated.noted, found));
        Row { values, numbers, audit, stands, anew, regime, stable, resonance, other }
    }
}

impl Gathered {
    pub(crate) fn new(machine: &Machine, over: &[SweepRange], wanted: &[Noted]) -> Gathered {
        let mut columns: Vec<Column> =
            over.iter().map(|range| Column { quantity: quantity(machine, &range.name), values: Vec::new() }).collect();
        columns.extend(wanted.iter().map(|(quantity, _)| Column { quantity: quantity.clone(), values: Vec::new() }));
        Gathered::with(columns, over.len())
    }

    /// With these columns, the first so many for the values.
    pub(crate) fn with(columns: Vec<Column>, own: usize) -> Gathered {
        Gathered {
            columns,
            own,
            failed: 0,
            first: None,
            checked: 0,
            doubtful: Vec::new(),
            others: Vec::new(),
            stands: Vec::new(),
            anew: 0,
            reasons: Vec::new(),
            regimes: Vec::new(),
            names: Vec::new(),
        }
    }

    /// Notes regimes by these names too.
    pub(crate) fn with_regimes(mut self, names: &[String]) -> Gathered {
        self.names = names.to_vec();
        self
    }

    /// The row of one run.
    pub(crate) fn take(&mut self, wanted: &[Noted], row: &Row) {
        let Row { values, numbers, audit, stands, anew, regime, .. } = row;
        self.others.extend(row.other.then(|| values.clone()));
        if !self.names.is_empty() {
            self.regimes.push(regime.unwrap_or(NO_REGIME));
        }
        self.stands.push((values[0].1, stands.clone()));
        self.anew += *anew;
        self.checked += usize::from(audit.is_some());
        self.doubtful.extend(audit.iter().flatten().map(|audit| (values.clone(), audit.clone())));
        let (own, found) = self.columns.split_at_mut(self.own);
        let place = own.first().map_or(0, |column| column.values.len());
        for (column, (_, value)) in own.iter_mut().zip(values) {
            column.values.push(*value);
        }
        match numbers {
            Ok(numbers) => {
                for ((column, (quantity, _)), (value, described)) in found.iter_mut().zip(wanted).zip(numbers) {
                    column.values.push(*value);
                    if quantity.unit == "1" && column.quantity.unit == "1" {
                        column.quantity = described.clone().unwrap_or_else(|| quantity.clone());
                    }
                }
            }
            Err(trouble) => {
                found.iter_mut().for_each(|column| column.values.push(f64::NAN));
                self.failed += 1;
                let (code, what) = (trouble.code, &trouble.what);
                self.reasons.push((place, Text::new(format!("{} [{code}]", what.en), format!("{} [{code}]", what.ru))));
                self.first.get_or_insert_with(|| trouble.clone());
            }
        }
    }

    /// The column of regimes, and what share of the values each has.
    fn tell_regimes(&mut self, data: &mut Dataset, results: &mut Results) {
        if self.names.is_empty() {
            return;
        }
        // a condition of none of them holds
        let words: Vec<String> = self.names.iter().cloned().chain([NONE.to_owned()]).collect();
        let all = self.regimes.len().max(1) as f64;
        let mut shares = serde_json::Map::new();
        for (k, name) in words.iter().enumerate() {
            let share = self.regimes.iter().filter(|own| **own == k).count() as f64 / all;
            if share > 0.0 {
                let label = Text::new(format!("share of the values: {name}"), format!("доля значений: {name}"));
                results.facts.push(Fact::new(&format!("share({name})"), &format!("s_{}", k + 1), "1", share, label));
                shares.insert(name.clone(), serde_json::json!(share));
            }
        }
        results.own.insert("shares".into(), serde_json::Value::Object(shares));
        data.labels.push(Labels { name: "regime".into(), words, rows: std::mem::take(&mut self.regimes) });
    }

    /// Checks and troubles of all runs; the columns that lack values for these.
    pub(crate) fn tell(&mut self, data: &mut Dataset, results: &mut Results, count: usize) -> Vec<(String, Text)> {
        self.tell_regimes(data, results);
        if self.checked > 0 {
            data.audits.push(judged(self.doubtful.len()));
            data.notes.extend(self.doubtful.first().map(|(values, audit)| doubt(values, audit)));
        }
        data.notes.extend(self.others.first().map(|values| of_family(values, self.others.len())));
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

/// Says what columns lack, and of numbers of events that there are infinitely many.
pub(crate) fn missing(data: &mut Dataset, without: Vec<(String, Text)>) {
    without.into_iter().for_each(|(column, words)| data.state(&column, Missing::Absent, words));
    let words = Text::new("infinitely many impacts, until the contact closes", "бесконечно много ударов до замыкания контакта");
    let of = |c: &&Column| c.quantity.name.starts_with("events") && c.values.iter().any(|v| v.is_infinite());
    let names: Vec<String> = data.columns.iter().filter(of).map(|c| c.quantity.name.clone()).collect();
    for name in names {
        data.notes.push(Text::new(
            format!("{name}: without a value there are {}", words.en),
            format!("{name}: где значения нет, там {}", words.ru),
        ));
        data.state(&name, Missing::Unbounded, words.clone());
    }
}

/// Columns with numbers at some values only, of which nothing has been said.
pub(crate) fn partly_absent(columns: &[Column], said: &[(String, Text)]) -> Vec<(String, Text)> {
    let absent = Text::new("the study has no such number at this value", "при этом значении такого числа в расчёте нет");
    let partly = |c: &&Column| c.values.iter().any(|v| v.is_finite()) && said.iter().all(|(name, _)| *name != c.quantity.name);
    columns.iter().filter(partly).map(|c| (c.quantity.name.clone(), absent.clone())).collect()
}

/// The checks of all runs.
pub(crate) fn judged(failed: usize) -> Audit {
    let name = Text::new("repeated studies of which a check failed", "повторённых расчётов, в которых не выполнена проверка");
    Audit::at_most("repeated", name, failed as f64, 0.0)
}

/// The first run of which a check failed.
pub(crate) fn doubt(values: &[(String, f64)], audit: &Audit) -> Text {
    let at = place(values);
    Text::new(
        format!("the check that failed at {}: {}", at.en, audit.name.en),
        format!("проверка, не выполненная при {}: {}", at.ru, audit.name.ru),
    )
}

/// `m = 1, l = 2`.
fn place(values: &[(String, f64)]) -> Text {
    let shown: Vec<(String, Text)> = values.iter().map(|(name, value)| (name.clone(), words::digits::rounded(*value))).collect();
    let list =
        |pick: fn(&Text) -> &str| shown.iter().map(|(name, value)| format!("{name} = {}", pick(value))).collect::<Vec<_>>().join(", ");
    Text::new(list(|t| &t.en), list(|t| &t.ru))
}

/// That regimes are others of a family than those from the given starts.
fn of_family(first: &[(String, f64)], count: usize) -> Text {
    let at = place(first);
    Text::new(
        format!(
            "a multiplier 1 besides the shift: for {count} values, the first {}, the regime is one of a family, and the numbers are those of the member that the search met, not of the motion from the given start",
            at.en
        ),
        format!(
            "кроме сдвига есть ещё мультипликатор 1: режим принадлежит семейству, и числа относятся к найденному движению, а не к движению из заданного начала (таких значений {count}, первое: {})",
            at.ru
        ),
    )
}
