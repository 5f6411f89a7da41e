//! Chapter 9: every check with what was found, what is expected, the limit and the verdict; published results beside ours.

use super::Work;
use super::pen::Pen;
use super::statement::capital;
use super::wording::Word;
use report::table::{Column, Verdict};
use report::{Cell, Table};

pub(super) fn write(work: &Work, pen: &mut Pen) {
    let audits = work.calculation.audits();
    if !audits.is_empty() {
        pen.table(table(work, &audits), capital(pen.word(Word::Checks)));
    }
    for results in work.results_of(Word::Verification) {
        let heading = work.text(&results.heading);
        pen.section(heading, |pen| pen.take(results.below(&work.view()), heading));
    }
}

/// What is checked is a deviation: zero is expected.
fn table(work: &Work, audits: &[&analysis::dataset::Audit]) -> Table {
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
            Cell::words(work.text(&audit.name)),
            Cell::number(audit.value, 2, work.language),
            Cell::number(0.0, 2, work.language),
            Cell::number(audit.limit, 2, work.language),
            Cell::Verdict(Verdict::of(audit)),
        ]);
    }
    table
}
