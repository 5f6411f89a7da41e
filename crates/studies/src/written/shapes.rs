//! What the file names as a linear form of the coordinates, in each mode: a ratio of displacements, the deflection of a point.

use super::pen::Pen;
use super::work::Work;
use crate::Finds;
use report::document::Rich;
use report::table::Column;
use report::{Cell, Table};
use symbolic::equations::{Output, Role};
use symbolic::{Expr, Graph, SymbolId};
use words::capital;

/// Significant digits.
const DIGITS: usize = 6;

/// A table of them, where there are any.
pub(super) fn write(work: &Work, pen: &mut Pen) {
    let equations = work.equations;
    let mut graph = equations.graph.clone();
    let symbols = super::sentences::Symbols::of(work);
    let shown = |o: &Output| equations.notation.iter().find(|(n, _)| *n == o.name).map_or_else(|| o.name.clone(), |(_, s)| s.clone());
    let named: Vec<(&Output, Vec<f64>)> = (equations.outputs.iter().filter(|o| o.role == Role::Named))
        .filter_map(|o| Some((o, slopes(work, &mut graph, o.formula)?)))
        .collect();
    for results in work.results_that(|finds| matches!(finds, Finds::Shapes)).filter(|_| !named.is_empty()) {
        let column = |name: &str| results.data.column(name).map(|c| c.values.as_slice());
        let shapes: Option<Vec<&[f64]>> = equations.coordinates.iter().map(|c| column(&name(work, c.symbols[0]))).collect();
        // shapes with phases have no ratio that is one number
        let phased = equations.coordinates.iter().any(|c| column(&format!("{}_im", name(work, c.symbols[0]))).is_some());
        let (Some(shapes), Some(omega)) = (shapes.filter(|_| !phased), column("omega")) else { continue };
        // shapes without a unit are ratios
        let bare =
            equations.coordinates.iter().all(|c| results.data.column(&name(work, c.symbols[0])).is_some_and(|c| c.quantity.unit == "1"));
        let mut table = Table::new(vec![Column::with_unit(Rich::symbol("ω"), "rad/s", work.language)]);
        let mut cells = vec![Cell::column_apart(omega, DIGITS, work.language)];
        for (output, slopes) in &named {
            let values: Vec<f64> = (0..omega.len()).map(|k| slopes.iter().zip(&shapes).map(|(s, shape)| s * shape[k]).sum()).collect();
            let unit = if bare { "" } else { output.unit.as_str() };
            table.columns.push(Column::with_unit(Rich::symbol(shown(output)), unit, work.language));
            cells.push(Cell::column(&values, DIGITS, work.language));
        }
        (0..omega.len()).for_each(|k| table.row(cells.iter().map(|column| column[k].clone()).collect()));
        let what: Vec<String> =
            named.iter().map(|(o, _)| format!("{} – {}", shown(o), work.text(&o.label))).filter(|what| !what.ends_with("– ")).collect();
        let lead = work.language.pick("In the scale of the shapes above: ", "В масштабе приведённых форм: ");
        if !what.is_empty() {
            pen.tell(symbols.split(&format!("{lead}{}.", what.join("; "))));
        }
        pen.table(table, capital(work.language.pick("named displacements in the modes", "перемещения при собственных колебаниях")));
    }
}

fn name(work: &Work, symbol: SymbolId) -> String {
    work.equations.graph.symbol_info(symbol).name.clone()
}

/// The factors of the coordinates in a linear form of them with constant factors; none of other formulas.
fn slopes(work: &Work, graph: &mut Graph, formula: Expr) -> Option<Vec<f64>> {
    let equations = work.equations;
    let places: Vec<SymbolId> = equations.coordinates.iter().map(|c| c.symbols[0]).collect();
    let numbers: Vec<(SymbolId, f64)> = equations.parameters.iter().map(|p| (p.symbol, p.value)).collect();
    let constant = |s: SymbolId| numbers.iter().any(|(n, _)| *n == s);
    let slopes: Vec<Expr> = places.iter().map(|q| graph.derivative(formula, *q)).collect();
    let own = !graph.contains(formula, |s| !places.contains(&s) && !constant(s));
    if !own || slopes.iter().any(|e| graph.contains(*e, |s| !constant(s))) || slopes.iter().all(|e| graph.is_zero(*e)) {
        return None;
    }
    let find = |s: SymbolId| numbers.iter().find(|(n, _)| *n == s).map_or(0.0, |(_, v)| *v);
    let at_rest = graph.evaluate(&[formula], &find)[0];
    (at_rest == 0.0).then(|| graph.evaluate(&slopes, &find))
}
