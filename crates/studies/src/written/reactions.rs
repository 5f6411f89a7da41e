//! Chapter 7: reactions and internal forces, their extremes with the instants, both sides of every switch.

use super::pen::Pen;
use super::wording::Word;
use super::work::Work;
use crate::Finds;
use crate::results::Results;
use report::table::Column;
use report::{Block, Cell, Table};
use symbolic::equations::Output;
use words::capital;

/// Significant digits.
const DIGITS: usize = 6;
/// Share of the largest reaction of its unit below which one is rounding.
const NOISE: f64 = 1e-12;
/// Switches that a table lists.
const MOST: usize = 12;

/// Bodies whose free-body diagrams are drawn.
const FREE_BODIES: usize = 6;

pub(super) fn write(work: &Work, pen: &mut Pen) {
    let rests = work.results_of(Word::Reactions).any(|r| r.kind == crate::statics::KIND.name) && !work.equations.reactions.is_empty();
    if rests || !reactions(work).is_empty() {
        pen.released(free_bodies(work));
    }
    super::studied::told(work, Word::Reactions, pen);
    let motions: Vec<&Results> = work.results_that(|finds| matches!(finds, Finds::Motion | Finds::Drives)).collect();
    if let ([only], None) = (&motions[..], work.results_of(Word::Reactions).next()) {
        return of_motion(work, only, pen);
    }
    for results in motions {
        let heading = work.text(&results.heading);
        pen.section(heading, |pen| of_motion(work, results, pen));
    }
}

/// Bodies on which a reaction acts that somebody asks for, each alone.
fn free_bodies(work: &Work) -> Vec<Block> {
    let machine = &work.calculation.machine;
    let drawn = work.by_number().into_iter().filter_map(|(i, frame)| {
        if crate::scheme::is_axle(machine, mechanics::model::FrameId(i)) {
            return None;
        }
        let options = crate::scheme::Options { at: None, body: Some(frame.name.clone()) };
        let mut scheme = crate::scheme::scheme(machine, &options, work.language)?;
        let body = capital(&work.body(mechanics::model::FrameId(i)));
        scheme.title = body.into();
        let acting = scheme.items.iter().any(|item| item.symbol.name == "reaction");
        acting.then_some(Block::Scheme(scheme))
    });
    drawn.take(FREE_BODIES).collect()
}

/// Outputs that contain a reaction or a drive.
fn reactions<'a>(work: &Work<'a>) -> Vec<&'a Output> {
    let contains = |o: &&Output| work.equations.graph.contains(o.formula, |s| work.equations.reactions.iter().any(|r| r.symbol == s));
    work.equations.outputs.iter().filter(contains).collect()
}

fn of_motion(work: &Work, results: &Results, pen: &mut Pen) {
    let found = reactions(work);
    let columns: Vec<(usize, &Output)> = results
        .data
        .columns
        .iter()
        .enumerate()
        .filter_map(|(i, column)| Some((i, *found.iter().find(|o| o.name == column.quantity.name)?)))
        .collect();
    if columns.is_empty() {
        return;
    }
    let heads = [Word::Quantity, Word::Greatest, Word::At, Word::Least, Word::At].map(|w| Column::new(work.language.word(w)));
    let mut table = Table::new(heads.into());
    table.columns.insert(1, Column::new(work.language.word(report::Word::Unit)));
    table.columns.push(Column::new(work.language.word(report::Word::Description)));
    for (i, output) in &columns {
        let Some(extreme) = results.data.extremes.iter().find(|e| e.column == *i) else { continue };
        let quantity = &results.data.columns[*i].quantity;
        let size = extreme.min.abs().max(extreme.max.abs());
        // what is rounding beside other forces is zero, and has no instant
        let nothing = size <= NOISE * largest(results, &columns, &quantity.unit);
        let scale = crate::results::tables::scale(quantity, if nothing { 0.0 } else { size });
        let number = |x: f64| Cell::number(if nothing { 0.0 } else { x }, DIGITS, work.language);
        // what is rounding beside the other extreme is zero, too
        let value = |v: f64| number(if v.abs() <= NOISE * size { 0.0 } else { v / scale.size });
        let instant = |t: f64| if nothing { Cell::words("–") } else { number(t) };
        table.row(vec![
            Cell::symbol(quantity.symbol.clone()),
            Cell::words(scale.print(work.language)),
            value(extreme.max),
            instant(extreme.t_max),
            value(extreme.min),
            instant(extreme.t_min),
            Cell::words(work.text(&output.label)),
        ]);
    }
    pen.table(table, capital(pen.word(Word::Extremes)));
    jumps(work, results, &columns, pen);
}

/// The greatest size of a reaction of that unit.
fn largest(results: &Results, columns: &[(usize, &Output)], unit: &str) -> f64 {
    let alike = |e: &&analysis::dataset::Extreme| {
        columns.iter().any(|(i, _)| *i == e.column) && results.data.columns[e.column].quantity.unit == unit
    };
    results.data.extremes.iter().filter(alike).fold(0.0, |m, e| m.max(e.min.abs()).max(e.max.abs()))
}

/// What the reactions are just before and just after the switches.
fn jumps(work: &Work, results: &Results, columns: &[(usize, &Output)], pen: &mut Pen) {
    let quantities: Vec<usize> = (0..results.data.columns.len()).filter(|i| Some(*i) != results.data.axis).collect();
    let place = |i: usize| quantities.iter().position(|q| *q == i);
    let jumping: Vec<_> = results.data.events.iter().filter(|e| e.name.is_empty() && !e.outputs[0].is_empty()).take(MOST).collect();
    let leaps = |i: usize| {
        let sides = |e: &&&analysis::dataset::Event| place(i).map(|k| [e.outputs[0].get(k).copied(), e.outputs[1].get(k).copied()]);
        jumping.iter().filter_map(|e| sides(&e)).any(|[a, b]| {
            let (a, b) = (a.unwrap_or(f64::NAN), b.unwrap_or(f64::NAN));
            // both sides are of one event and its rounding
            (a - b).abs() > 1e-9 * a.abs().max(b.abs())
        })
    };
    let all = columns;
    let columns: Vec<_> = columns.iter().filter(|(i, _)| leaps(*i)).collect();
    if columns.is_empty() {
        return;
    }
    let mut table = Table::new(vec![Column::with_unit("t", "s", work.language)]);
    for (i, _) in &columns {
        let quantity = &results.data.columns[*i].quantity;
        for side in [Word::Before, Word::After] {
            let mut head = report::document::Rich::symbol(quantity.symbol.clone());
            head.0.push(super::pen::words(format!(" {}", work.language.word(side))));
            table.columns.push(Column::with_unit(head, &quantity.unit, work.language));
        }
    }
    for event in &jumping {
        let mut row = vec![Cell::number(event.t, DIGITS, work.language)];
        for (i, _) in &columns {
            for side in &event.outputs {
                let value = place(*i).and_then(|k| side.get(k).copied()).unwrap_or(f64::NAN);
                let noise = NOISE * largest(results, all, &results.data.columns[*i].quantity.unit);
                row.push(Cell::number(if value.abs() <= noise { 0.0 } else { value }, DIGITS, work.language));
            }
        }
        table.row(row);
    }
    pen.table(table, capital(pen.word(Word::Jumps)));
}
