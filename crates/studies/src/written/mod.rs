//! The written calculation that is handed in and signed: one file a chapter, one row a chapter in [`CHAPTERS`]. A chapter makes its text with a [`Pen`] of the
//! model, the equations, the steps of their derivation and the results of the file's studies; a chapter that has nothing to say is left out.
//!
//! Words stand in one table, [`wording`]; a quantity with its formula, its substitution and its value is written by [`quantity`] alone.

mod appendix;
mod conclusions;
mod dynamics;
mod facts;
mod kinematics;
mod pen;
mod quantity;
mod reactions;
mod statement;
mod studied;
mod verification;
mod wording;

use crate::calculation::Calculation;
use crate::results::{Extent, Results, View};
use mechanics::Model;
use pen::Pen;
use report::Document;
use report::formula::Printer;
use symbolic::Equations;
use wording::Word;
use words::Language;

/// Characters of a line of formulas.
const LINE: usize = 84;

/// A chapter: its title, how it is counted, what makes it.
struct Chapter {
    title: Word,
    count: Count,
    make: fn(&Work, &mut Pen),
}

/// How a chapter is counted.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Count {
    /// 1, 2, 3.
    Number,
    /// Not at all: conclusions, sources.
    None,
    /// Appendix A, B.
    Letter,
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

/// The chapter in which a study is told; no study is left out.
fn chapter_of(kind: &str) -> Word {
    match kind {
        "kinematics" => Word::Kinematics,
        "equations" | "equilibrium" => Word::Dynamics,
        "modes" => Word::Free,
        "response" => Word::Forced,
        "simulate" | "transient" | "inverse" | "poincare" => Word::Motion,
        "statics" => Word::Reactions,
        "claims" => Word::Verification,
        _ => Word::Regime,
    }
}

/// What a chapter is made from.
struct Work<'a> {
    calculation: &'a Calculation,
    model: &'a Model,
    equations: &'a Equations,
    language: Language,
    printer: Printer,
}

impl<'a> Work<'a> {
    fn new(calculation: &'a Calculation, language: Language) -> Work<'a> {
        let machine = &calculation.machine;
        let printer = Printer::of(&machine.equations, language).with_width(LINE);
        Work { calculation, model: &machine.model, equations: &machine.equations, language, printer }
    }

    /// The results of studies that a chapter tells.
    fn results_of(&self, chapter: Word) -> impl Iterator<Item = &'a Results> {
        self.calculation.results.iter().filter(move |results| chapter_of(results.kind) == chapter)
    }

    fn view(&self) -> View<'a> {
        View { equations: self.equations, extent: Extent::Page, language: self.language }
    }

    /// Whether the machine has anything that moves or is held.
    fn is_machine(&self) -> bool {
        !self.equations.coordinates.is_empty() || !self.equations.reactions.is_empty()
    }

    fn text(&self, text: &'a words::Text) -> &'a str {
        self.language.text(text)
    }
}

/// The written calculation.
pub fn compose(calculation: &Calculation, language: Language) -> Document {
    let work = Work::new(calculation, language);
    let mut pen = Pen::new(language);
    for chapter in CHAPTERS {
        pen.chapter(chapter, |pen| (chapter.make)(&work, pen));
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
