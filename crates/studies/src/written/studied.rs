//! Chapters that are told by the studies themselves: sections, free and forced oscillations, motion, working regime; and the facts of frames.

use super::pen::{Pen, inline, words};
use super::wording::Word;
use super::work::Work;
use mechanics::structure::Structure;
use report::document::Rich;
use report::table::Column;
use report::{Cell, Table};
use symbolic::Expr;
use words::capital;

/// Every study of the chapter in a section of its own.
pub(super) fn told(work: &Work, chapter: Word, pen: &mut Pen) {
    // a lone study of the chapter's own name needs no section
    if let [only] = work.results_of(chapter).collect::<Vec<_>>()[..]
        && work.text(&only.heading) == pen.word(chapter)
    {
        return pen.take(super::sentences::below(work, only), pen.word(chapter));
    }
    for results in work.results_of(chapter) {
        let heading = work.text(&results.heading);
        pen.section(heading, |pen| pen.take(super::sentences::below(work, results), heading));
    }
}

pub(super) fn sections(work: &Work, pen: &mut Pen) {
    let blocks = crate::sections::blocks(&work.model.sections, crate::sections::Drawings::Shown, work.language);
    pen.take(blocks, pen.word(Word::Sections));
}

pub(super) fn free(work: &Work, pen: &mut Pen) {
    pen.coefficients = super::linear::write(work, pen);
    told(work, Word::Free, pen);
    super::shapes::write(work, pen);
}

pub(super) fn forced(work: &Work, pen: &mut Pen) {
    told(work, Word::Forced, pen);
    if let Some(found) = pen.coefficients.take() {
        super::dimensionless::write(work, &found, pen);
    }
}

pub(super) fn motion(work: &Work, pen: &mut Pen) {
    told(work, Word::Motion, pen);
    for results in work.results_of(Word::Motion) {
        super::instants::of_motion(work, results, pen);
    }
}

pub(super) fn regime(work: &Work, pen: &mut Pen) {
    told(work, Word::Regime, pen);
}

/// Nodes, rods and supports of a frame or truss.
pub(super) fn structure(work: &Work, structure: &Structure, pen: &mut Pen) {
    let pick = |en: &'static str, ru: &'static str| work.language.pick(en, ru);
    let formula = |e: Expr| Cell::Rich(Rich(vec![inline(work.printer.layout(&work.model.graph, e))]));
    let mut nodes = Table::new(vec![
        Column::new(pick("Node", "Узел")),
        Column::with_unit("x", "m", work.language),
        Column::with_unit("y", "m", work.language),
    ]);
    let lumped = structure.nodes.iter().any(|node| !work.model.graph.is_zero(node.mass));
    if lumped {
        nodes.columns.push(Column::with_unit(pick("Lumped mass", "Сосредоточенная масса"), "kg", work.language));
    }
    for node in &structure.nodes {
        let mass = if work.model.graph.is_zero(node.mass) { Cell::words("–") } else { formula(node.mass) };
        let row = [Cell::words(node.name.clone()), formula(node.at[0]), formula(node.at[1])];
        nodes.row(row.into_iter().chain(lumped.then_some(mass)).collect());
    }
    pen.table(nodes, capital(pick("nodes of the structure", "узлы конструкции")));
    let heads = [
        ("Rod", "Стержень"),
        ("Nodes", "Узлы"),
        ("Length, m", "Длина, м"),
        ("Bending stiffness EI", "Жёсткость на изгиб EI"),
        ("Mass per length, kg/m", "Погонная масса, кг/м"),
    ];
    let mut rods = Table::new(heads.map(|(en, ru)| Column::new(pick(en, ru))).into());
    for rod in &structure.rods {
        let ends = format!("{} – {}", structure.nodes[rod.ends[0]].name, structure.nodes[rod.ends[1]].name);
        let stiffness = match (rod.rigid, rod.bending) {
            (true, _) => Cell::words(pick("rigid", "жёсткий")),
            (false, Some(e)) => formula(e),
            (false, None) => Cell::words(pick("bar of a truss", "стержень фермы")),
        };
        let massless = work.model.graph.is_zero(rod.mass);
        let mass = if massless { Cell::words(work.language.word(Word::Free0)) } else { formula(rod.mass) };
        rods.row(vec![Cell::words(rod.name.clone()), Cell::words(ends), formula(rod.length), stiffness, mass]);
    }
    pen.table(rods, capital(pick("rods of the structure", "стержни конструкции")));
    let mut pieces = Vec::new();
    for (i, support) in structure.supports.iter().enumerate() {
        let held = [(support.holds[0], "x"), (support.holds[1], "y"), (support.holds[2], pick("turn", "поворот"))];
        let held: Vec<&str> = held.into_iter().filter(|(holds, _)| *holds).map(|(_, what)| what).collect();
        let lead = if i == 0 { pick("Supports: ", "Опоры: ") } else { "; " };
        pieces.push(words(format!("{lead}{} ({})", structure.nodes[support.node].name, held.join(", "))));
    }
    if !pieces.is_empty() {
        pieces.push(words("."));
        pen.tell(pieces);
    }
}
