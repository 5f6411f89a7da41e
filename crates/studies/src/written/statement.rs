//! Chapter 1: what is given, what is wanted, what is assumed, the data.

use super::pen::{Pen, inline, lowered, words};
use super::quantity;
use super::wording::Word;
use super::work::Work;
use crate::Finds;
use mechanics::asked::{Asked, Words};
use mechanics::model::{Class, ParameterValue};
use report::Block;
use report::document::{Inline, Rich};
use symbolic::Node;
use symbolic::equations::Parameter;
use words::capital;

pub(super) fn write(work: &Work, pen: &mut Pen) {
    pen.section(pen.word(Word::Given), |pen| given(work, pen));
    pen.section(pen.word(Word::Wanted), |pen| wanted(work, pen));
    pen.section(pen.word(Word::Assumptions), |pen| assumptions(work, pen));
    pen.section(pen.word(Word::Data), |pen| data(work, pen));
}

fn given(work: &Work, pen: &mut Pen) {
    let description = work.text(&work.model.description);
    description.split('\n').filter(|p| !p.trim().is_empty()).for_each(|paragraph| pen.say(paragraph));
    parts(work, pen);
}

/// Bodies, connections, elements, rods.
pub(super) fn parts(work: &Work, pen: &mut Pen) {
    let tables = [(work.bodies(), Word::Bodies), (work.connections(), Word::Connected), (work.elements(), Word::Elements)];
    for (table, caption) in tables {
        if let Some(table) = table {
            pen.table(table, capital(pen.word(caption)));
        }
    }
    if let Some(structure) = &work.model.structure {
        super::studied::structure(work, structure, pen);
    }
}

/// What is asked: the studies of the file, in the order of the file, equal ones once.
fn wanted(work: &Work, pen: &mut Pen) {
    let mut asked: Vec<String> = Vec::new();
    for study in &work.model.studies {
        let Some((en, ru)) = work.study(study.kind).map(|study| study.wanted()) else { continue };
        let line = work.language.pick(en, ru).to_owned();
        if !asked.contains(&line) {
            asked.push(line);
        }
    }
    if !work.model.claims.is_empty() {
        asked.push(work.language.pick("compare the published results", "сопоставить опубликованные результаты с полученными").into());
    }
    let last = asked.len();
    for (i, line) in asked.iter().enumerate() {
        let end = if i + 1 == last { "." } else { ";" };
        pen.say(format!("{}) {line}{end}", i + 1));
    }
    outputs(work, pen);
}

/// The quantities that the file names.
fn outputs(work: &Work, pen: &mut Pen) {
    let outputs: Vec<_> = work.model.outputs.iter().filter(|o| !work.text(&o.label).is_empty()).collect();
    if outputs.is_empty() {
        return;
    }
    let mut pieces = vec![words(work.language.pick("Sought quantities: ", "Искомые величины: "))];
    for (i, output) in outputs.iter().enumerate() {
        pieces.push(words(if i == 0 { "" } else { "; " }));
        pieces.push(inline(work.printer.symbol_layout(&work.model.graph, output.symbol)));
        pieces.push(words(format!(" – {}", lowered(work.text(&output.label)))));
    }
    pieces.push(words("."));
    pen.tell(pieces);
}

fn assumptions(work: &Work, pen: &mut Pen) {
    if let Some(scheme) = crate::scheme::figure(&work.calculation.machine, work.language) {
        pen.scheme(scheme);
    }
    let model = work.model;
    let bodies = model.frames.iter().any(|f| f.is_body);
    let massless = model.frames.iter().any(|f| f.is_body && f.mass.is_none());
    let linearised = |s: &Asked| match work.finds(s.kind) {
        Finds::Shapes | Finds::Amplitudes => true,
        _ => s.flag("linearise"),
    };
    let small = model.studies.iter().any(linearised);
    let structure = model.structure.is_some();
    let mut list: Vec<(bool, Words)> = vec![
        (bodies, ("the bodies are rigid", "тела абсолютно твёрдые")),
        (massless, ("bodies without a given mass are massless", "массой тел, для которых она не задана, пренебрегаем")),
    ];
    list.extend(assumed(|table| model.connections.iter().any(|c| c.table == table)));
    list.extend([
        (bodies, ("joints and guides without a given friction are ideal", "связи, трение в которых не задано, идеальные")),
        (bodies && model.gravity.is_none(), ("gravity is left out", "сила тяжести не учитывается")),
    ]);
    list.extend(assumed(|table| model.elements.iter().any(|e| e.table == table)));
    list.extend([
        (structure, ("rods are straight and elastic, displacements are small", "стержни прямые и упругие, перемещения малы")),
        (
            small,
            (
                "where oscillations are called small, the equations are linearised about the place named there",
                "малые колебания рассматриваются по уравнениям, линеаризованным около указанного там положения",
            ),
        ),
    ]);
    let held: Vec<&str> = list.into_iter().filter(|(holds, _)| *holds).map(|(_, (en, ru))| work.language.pick(en, ru)).collect();
    if !held.is_empty() {
        pen.say(format!("{} {}.", work.language.pick("It is assumed that", "Приняты следующие допущения:"), held.join("; ")));
    }
}

/// What rows of tables assume that the file has, each once.
fn assumed(has: impl Fn(&str) -> bool) -> Vec<(bool, Words)> {
    let mut told: Vec<(bool, Words)> = Vec::new();
    for row in crate::shown::TABLE.iter().filter(|row| !row.assumed.0.is_empty() && has(row.table)) {
        if !told.iter().any(|(_, words)| *words == row.assumed) {
            told.push((true, row.assumed));
        }
    }
    told
}

/// What is written as a formula of numbers (`pi/7*1[m/s]`) is set as one.
fn typeset(work: &Work, table: &mut report::Table) {
    for (p, row) in work.equations.parameters.iter().zip(&mut table.rows) {
        let declared = work.model.parameters.iter().find(|d| d.symbol == p.symbol);
        let Some(ParameterValue::Number { si }) = declared.map(|d| d.value) else { continue };
        if p.written.contains(['*', '/', '(']) && !matches!(work.model.graph.node(si), Node::Number(_)) {
            let unit = report::unit::print(&p.unit, work.language);
            row[1] = report::Cell::Rich(Rich(vec![inline(work.printer.layout(&work.model.graph, si)), words(format!("\u{a0}{unit}"))]));
        }
    }
}

/// Takes out what was computed from the rods of a frame: it is not given.
fn apart(work: &Work, table: &mut report::Table) -> Option<report::Table> {
    let text = &work.calculation.machine.origin.source.text;
    let given = |name: &str| text.lines().any(|line| line.trim_start().starts_with(name));
    let own = |p: &Parameter| p.label.en.ends_with(" of the frame") && !given(&work.equations.graph.symbol_info(p.symbol).name);
    let computed: Vec<bool> = work.equations.parameters.iter().map(|p| work.model.structure.is_some() && own(p)).collect();
    if !computed.contains(&true) {
        return None;
    }
    // nobody wrote them: symbol, value, unit, description
    let columns = table.columns.iter().enumerate().filter(|(i, _)| *i != 1).map(|(_, column)| column.clone());
    let mut taken = report::Table::new(columns.collect());
    for (mut row, computed) in std::mem::take(&mut table.rows).into_iter().zip(computed) {
        if computed {
            row.remove(1);
            taken.row(row);
        } else {
            table.row(row);
        }
    }
    Some(taken)
}

fn data(work: &Work, pen: &mut Pen) {
    if let Some(mut table) = crate::document::parameters(work.equations, work.language) {
        typeset(work, &mut table);
        let computed = apart(work, &mut table);
        if !table.rows.is_empty() {
            // "s4 at the start" of what the file leaves to the program
            let table = super::sentences::Symbols::of(work).table(table);
            pen.table(table, capital(work.language.pick("given quantities", "исходные данные")));
        }
        if let Some(computed) = computed {
            let caption = ("Coefficients of the frame, found from its rods", "Коэффициенты рамы, найденные по её стержням");
            pen.table(computed, work.language.pick(caption.0, caption.1));
        }
    }
    let derived: Vec<_> = work.model.parameters.iter().filter(|p| p.class == Class::Constant && p.number.is_some()).collect();
    let symbols = super::sentences::Symbols::of(work);
    let formulas: Vec<Block> = derived
        .iter()
        .filter_map(|p| {
            let ParameterValue::Formula(formula) = p.value else { return None };
            let name = work.printer.symbol_layout(&work.model.graph, p.symbol);
            let formula = quantity::line(work, (name, &p.unit), (&work.model.graph, formula));
            let label = work.text(&p.label);
            // what it is stands before its formula, as before every other
            let told = if label.is_empty() { Vec::new() } else { symbols.finished(vec![Block::paragraph(format!("{label}:"))]) };
            Some(told.into_iter().chain([Block::Equation { formula, numbered: false }]))
        })
        .flatten()
        .collect();
    if !formulas.is_empty() {
        let sentence: Vec<Inline> =
            vec![words(work.language.pick("Quantities that follow from them:", "Величины, вычисляемые по исходным данным:"))];
        pen.say(Rich(sentence));
        pen.take(formulas, "");
    }
}
