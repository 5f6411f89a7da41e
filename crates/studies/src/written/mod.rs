//! The written calculation that is handed in and signed: one file a chapter, one row a chapter in `CHAPTERS`. A chapter makes its text with a `Pen` of the
//! model, the equations, the steps of their derivation and the results of the file's studies; a chapter that has nothing to say is left out.
//!
//! Words stand in one table, `wording`; a quantity with its formula, its substitution and its value is written by `quantity` alone.

mod appendix;
mod centres;
mod coefficients;
mod conclusions;
mod dimensionless;
mod dynamics;
mod facts;
mod front;
mod instants;
mod kinematics;
mod linear;
mod listing;
mod machine;
mod names;
mod pen;
mod quantity;
mod reactions;
mod repeated;
mod sentences;
mod shapes;
mod signs;
mod statement;
mod studied;
mod tied;
mod verification;
mod wording;
mod work;

use crate::calculation::Calculation;
use mechanics::model::Depth;
use pen::{Count, Pen};
use report::{Block, Document};
use wording::Word;
use words::Language;
use work::Work;

/// A chapter: its title, from which its name in `[report]` follows, how it is counted, what makes it.
struct Chapter {
    title: Word,
    count: Count,
    make: fn(&Work, &mut Pen),
}

/// The outline, in order.
const CHAPTERS: &[Chapter] = &[
    Chapter { title: Word::Statement, count: Count::Number, make: statement::write },
    Chapter { title: Word::Sections, count: Count::Number, make: studied::sections },
    Chapter { title: Word::Kinematics, count: Count::Number, make: kinematics::write },
    Chapter { title: Word::Dynamics, count: Count::Number, make: dynamics::write },
    Chapter { title: Word::Free, count: Count::Number, make: studied::free },
    Chapter { title: Word::Forced, count: Count::Number, make: studied::forced },
    Chapter { title: Word::Motion, count: Count::Number, make: studied::motion },
    Chapter { title: Word::Reactions, count: Count::Number, make: reactions::write },
    Chapter { title: Word::Regime, count: Count::Number, make: studied::regime },
    Chapter { title: Word::Verification, count: Count::Number, make: verification::write },
    Chapter { title: Word::Conclusions, count: Count::None, make: conclusions::write },
    Chapter { title: Word::Sources, count: Count::None, make: appendix::sources },
    Chapter { title: Word::ModelText, count: Count::Letter, make: appendix::model },
    Chapter { title: Word::Tables, count: Count::Letter, make: appendix::tables },
];

/// Blocks of more than ten pages: a printed page holds about nine of them.
const LONG: usize = 90;

/// Whether the file asks for a chapter; a short calculation has no appendix unless it is asked for.
fn is_wanted(report: &mechanics::model::Report, chapter: &Chapter) -> bool {
    match &report.parts {
        Some(parts) => parts.iter().any(|part| *part == chapter.title.chapter()),
        None => report.depth == Depth::Full || chapter.count != Count::Letter,
    }
}

/// The signs that all motions of a calculation keep.
pub fn signs(calculation: &Calculation) -> Vec<(symbolic::Expr, report::formula::Sign)> {
    signs::kept(calculation)
}

/// How a formula of the derivation is set: bodies go by their numbers, springs by a letter.
pub fn steps(calculation: &Calculation, language: Language) -> impl Fn(&symbolic::equations::StepFormula) -> report::formula::Layout {
    // a terminal asks for none
    let work = std::cell::OnceCell::new();
    move |formula| work.get_or_init(|| Work::new(calculation, language)).step_formula(formula)
}

/// What the machine is made of, as tables: bodies, connections, elements and loads with their laws, rods.
pub fn given(calculation: &Calculation, language: Language) -> Vec<Block> {
    let work = Work::new(calculation, language);
    let mut pen = Pen::new(language);
    statement::parts(&work, &mut pen);
    pen.blocks.into_iter().filter(|block| matches!(block, Block::Table(_))).collect()
}

/// The written calculation.
pub fn compose(calculation: &Calculation, language: Language) -> Document {
    let work = Work::new(calculation, language);
    let mut pen = Pen::new(language);
    let report = &work.model.report;
    pen.blocks.extend(report.front.as_ref().map(|front| front::page(&work, front)));
    let at = pen.blocks.len();
    for chapter in CHAPTERS.iter().filter(|chapter| is_wanted(report, chapter)) {
        pen.chapter((chapter.title, chapter.count), |pen| (chapter.make)(&work, pen));
    }
    // a work that is handed in lists its chapters, and so does one of more than ten pages
    if report.front.is_some() || pen.blocks.len() > LONG {
        pen.blocks.insert(at, Block::Contents);
    }
    let title = language.text(&work.model.title).into();
    let machine = &calculation.machine;
    Document {
        language,
        title,
        description: String::new(),
        blocks: pen.blocks,
        version: crate::provenance::VERSION.into(),
        model_hash: machine.model_hash.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chapters_have_the_names_of_the_reference() {
        let names: Vec<&str> = CHAPTERS.iter().map(|chapter| chapter.title.chapter()).collect();
        assert_eq!(names, mechanics::fields::PARTS);
    }

    #[test]
    fn every_study_has_its_chapter_and_a_sentence_of_what_is_wanted() {
        for study in crate::TABLE {
            let (en, ru) = study.wanted();
            assert!(!en.is_empty() && ru.chars().any(|c| ('а'..='я').contains(&c)), "{}", study.kind().name);
            assert!(CHAPTERS.iter().any(|c| c.title.chapter() == study.chapter()), "{}", study.kind().name);
        }
    }
}
