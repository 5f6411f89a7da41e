//! Chapter 9: every check with what was found, what is expected, the limit and the verdict; published results beside ours.

use super::pen::Pen;
use super::wording::Word;
use super::work::Work;
use analysis::dataset::Audit;
use report::table::{Column, Verdict};
use report::{Cell, Table};
use words::capital;

pub(super) fn write(work: &Work, pen: &mut Pen) {
    let audits = merged(work.calculation.audits());
    if !audits.is_empty() {
        pen.table(table(work, &audits), capital(pen.word(Word::Checks)));
    }
    for results in work.results_of(Word::Verification) {
        let heading = work.text(&results.heading);
        pen.section(heading, |pen| pen.take(super::sentences::below(work, results), heading));
    }
}

/// Every kind of check once, as it came out worst: studies of one machine repeat those of its equations.
pub(super) fn merged<'a>(audits: Vec<&'a Audit>) -> Vec<&'a Audit> {
    let mut list: Vec<&'a Audit> = Vec::new();
    for audit in audits {
        match list.iter_mut().find(|a| a.key == audit.key && a.name == audit.name) {
            Some(kept) if is_worse(audit, kept) => *kept = audit,
            Some(_) => {}
            None => list.push(audit),
        }
    }
    list
}

/// A check that fails is worse than one that holds; else the nearer one to its limit.
fn is_worse(a: &Audit, b: &Audit) -> bool {
    let used = |audit: &Audit| if audit.value.is_nan() { f64::INFINITY } else { audit.value / audit.limit.max(f64::MIN_POSITIVE) };
    match (a.ok, b.ok) {
        (false, true) => true,
        (true, false) => false,
        _ => used(a) > used(b),
    }
}

/// What is checked is a deviation: zero is expected.
fn table(work: &Work, audits: &[&Audit]) -> Table {
    let word = |w: report::Word| Column::new(work.language.word(w));
    let mut table = Table::new(vec![
        word(report::Word::Check),
        Column::new(work.language.word(Word::Found)),
        Column::new(work.language.word(Word::Expected)),
        word(report::Word::Limit),
        word(report::Word::Verdict),
    ]);
    for audit in audits {
        table.row(vec![
            Cell::words(capital(work.text(&audit.name))),
            Cell::number(audit.value, 2, work.language),
            Cell::number(0.0, 2, work.language),
            Cell::number(audit.limit, 2, work.language),
            Cell::Verdict(Verdict::of(audit)),
        ]);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_equal_checks_the_worst_is_kept_and_a_failure_never_goes_lost() {
        let audit = |key: &str, value: f64, limit: f64| Audit::at_most(key, words::Text::same(key), value, limit);
        let all = [audit("a", 1e-3, 1.0), audit("b", 0.0, 1.0), audit("a", 2.0, 1.0), audit("a", 0.5, 1.0), audit("b", f64::NAN, 1.0)];
        let kept = merged(all.iter().collect());
        assert_eq!(kept.len(), 2);
        assert!(kept.iter().all(|a| !a.ok), "{kept:?}");
    }
}
