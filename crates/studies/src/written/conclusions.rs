//! Conclusions: sentences with guards over numbers. A sentence says no more than its guard holds.

use super::Work;
use super::pen::Pen;
use crate::results::Results;
use words::Language;

/// Significant digits of a number in a sentence.
const DIGITS: usize = 4;

pub(super) fn write(work: &Work, pen: &mut Pen) {
    for (i, sentence) in sentences(work).into_iter().enumerate() {
        pen.say(format!("{}. {sentence}", i + 1));
    }
}

fn sentences(work: &Work) -> Vec<String> {
    let mut list = Vec::new();
    for results in &work.calculation.results {
        list.extend(of_study(results, work.language));
    }
    let audits = work.calculation.audits();
    list.extend(checked(audits.len(), audits.iter().filter(|a| !a.ok).count(), work.language));
    list
}

/// What a study allows to say.
fn of_study(results: &Results, language: Language) -> Vec<String> {
    if results.trouble.is_some() {
        let heading = language.text(&results.heading);
        return vec![language.pick(format!("The study “{heading}” was not completed."), format!("Расчёт «{heading}» не завершён."))];
    }
    match results.kind {
        "modes" => frequencies(results, language).into_iter().collect(),
        _ => Vec::new(),
    }
}

/// The lowest natural frequency that is one.
fn frequencies(results: &Results, language: Language) -> Option<String> {
    let omega = &results.data.column("omega")?.values;
    let lowest = lowest(omega)?;
    let pair = report::number::frequency_pair(lowest, DIGITS, language);
    Some(language.pick(format!("The lowest natural frequency is {pair}."), format!("Низшая собственная частота {pair}.")))
}

/// The least positive value.
fn lowest(values: &[f64]) -> Option<f64> {
    values.iter().copied().filter(|w| w.is_finite() && *w > 0.0).reduce(f64::min)
}

/// Whether all checks hold.
fn checked(all: usize, failed: usize, language: Language) -> Option<String> {
    match (all, failed) {
        (0, _) => None,
        (_, 0) => Some(language.pick(format!("All checks hold ({all})."), format!("Все проверки выполнены (всего {all})."))),
        _ => Some(language.pick(
            format!("Of {all} checks {failed} do not hold: the results are not to be used."),
            format!("Не выполнено проверок: {failed} из {all}; результатами пользоваться нельзя."),
        )),
    }
}
