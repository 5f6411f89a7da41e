//! Sources, the file as it is, values of motions row by row.

use super::pen::Pen;
use super::work::Work;
use crate::Finds;
use crate::results::Results;
use algebra::arrange::Arrange;
use report::document::Rich;
use report::table::Column;
use report::{Block, Cell, Table};
use symbolic::equations::Role;

/// What the methods come from.
const SOURCES: [(&str, &str); 3] = [
    (
        "Loitsyanskii L. G., Lurie A. I. A Course of Theoretical Mechanics. Vol. 2: Dynamics.",
        "Лойцянский Л. Г., Лурье А. И. Курс теоретической механики. Т. 2: Динамика.",
    ),
    ("Yablonskii A. A., Noreiko S. S. A Course of the Theory of Oscillations.", "Яблонский А. А., Норейко С. С. Курс теории колебаний."),
    (
        "GOST 7.32-2017. Research report. Structure and rules of presentation.",
        "ГОСТ 7.32–2017. Отчёт о научно-исследовательской работе. Структура и правила оформления.",
    ),
];

pub(super) fn sources(work: &Work, pen: &mut Pen) {
    for (i, (en, ru)) in SOURCES.into_iter().enumerate() {
        pen.say(format!("{}. {}", i + 1, work.language.pick(en, ru)));
    }
}

pub(super) fn model(work: &Work, pen: &mut Pen) {
    let source = &work.calculation.machine.origin.source;
    if !source.text.trim().is_empty() {
        pen.blocks.push(Block::Verbatim(super::listing::in_language(&source.text, work.language)));
    }
}

/// Rows that a table of values has.
const ROWS: usize = 31;
/// Columns beside the first.
const COLUMNS: usize = 8;
/// Significant digits.
const DIGITS: usize = 5;

/// Values of motions row by row: the plotted quantities, or the named ones.
pub(super) fn tables(work: &Work, pen: &mut Pen) {
    for results in work.results_that(|finds| matches!(finds, Finds::Motion | Finds::Drives | Finds::ClosedForm)) {
        let Some((axis, columns)) = columns(work, results) else { continue };
        let data = &results.data;
        let rows = thinned(data.columns[axis].values.len());
        let mut table = Table::default();
        let mut cells = Vec::new();
        for i in std::iter::once(axis).chain(columns) {
            let column = &data.columns[i];
            let values: Vec<f64> = rows.iter().map(|k| column.values.get(*k).copied().unwrap_or(f64::NAN)).collect();
            let largest = values.iter().filter(|v| v.is_finite()).fold(0.0_f64, |m, v| m.max(v.abs()));
            let scale = crate::results::tables::scale(&column.quantity, if i == axis { 1.0 } else { largest });
            let shown: Vec<f64> = values.iter().map(|v| v / scale.size).collect();
            table.columns.push(Column::with_unit(Rich::symbol(&column.quantity.symbol), &scale.label, work.language));
            cells.push(Cell::column(&shown, DIGITS, work.language));
        }
        (0..rows.len()).for_each(|k| table.row(cells.iter().map(|column| column[k].clone()).collect()));
        pen.table(table, work.text(&results.heading));
    }
}

/// The axis and the columns of a table.
fn columns(work: &Work, results: &Results) -> Option<(usize, Vec<usize>)> {
    let data = &results.data;
    let axis = data.axis?;
    let plotted: Vec<&str> = results.plots.iter().flat_map(|plot| plot.y.iter().map(String::as_str)).collect();
    let named = |name: &str| work.equations.outputs.iter().any(|o| o.name == name && o.role == Role::Named);
    let wanted = |name: &str| plotted.contains(&name) || named(name);
    let mut list: Vec<usize> = (0..data.columns.len()).filter(|i| *i != axis && wanted(&data.columns[*i].quantity.name)).collect();
    // what is plotted comes first
    list.arrange_by_key(|i| !plotted.contains(&data.columns[*i].quantity.name.as_str()));
    list.truncate(COLUMNS);
    (!list.is_empty() && data.columns[axis].values.len() > 1).then_some((axis, list))
}

/// Rows spread over all, the first and the last among them.
fn thinned(n: usize) -> Vec<usize> {
    let rows = n.min(ROWS);
    (0..rows).map(|k| if rows > 1 { k * (n - 1) / (rows - 1) } else { k }).collect()
}
