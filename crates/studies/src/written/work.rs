//! What a chapter is made from: the model, its equations, the results, and how formulas are written.

use super::signs;
use super::wording::Word;
use crate::calculation::Calculation;
use crate::results::Results;
use crate::{Finds, Study};
use mechanics::Model;
use report::document::Formula;
use report::formula::{Layout, Printer, Sign};
use symbolic::{Equations, Expr};
use words::Language;

/// Characters of a line of formulas.
const LINE: usize = 84;

/// What a chapter is made from.
pub(super) struct Work<'a> {
    pub calculation: &'a Calculation,
    pub model: &'a Model,
    pub equations: &'a Equations,
    pub language: Language,
    pub printer: Printer,
    /// The same for formulas of the equations' own graph, with the signs that the motions keep.
    pub own: Printer,
    /// Expressions that keep their sign during all motions.
    pub signs: Vec<(Expr, Sign)>,
}

impl<'a> Work<'a> {
    pub fn new(calculation: &'a Calculation, language: Language) -> Work<'a> {
        let machine = &calculation.machine;
        let printer = Printer::of(&machine.equations, language).with_width(LINE);
        let signs = signs::kept(calculation);
        let own = printer.clone().with_signs(signs.clone());
        Work { calculation, model: &machine.model, equations: &machine.equations, language, printer, own, signs }
    }

    /// A layout; numbers that print would cut are rounded instead: 0,327485 and not 0,327485….
    pub fn settled(&self, make: impl Fn(&Printer) -> Layout) -> Layout {
        let layout = make(&self.own);
        let cut = Formula::inline(layout.clone()).text().contains('…');
        if cut { make(&self.own.clone().rounded()) } else { layout }
    }

    /// A formula, settled.
    pub fn readable(&self, graph: &symbolic::Graph, e: Expr) -> Layout {
        self.settled(|printer| printer.layout(graph, e))
    }

    /// The study of that name; none for claims.
    pub fn study(&self, kind: &str) -> Option<&'static dyn Study> {
        self.calculation.machine.origin.studies.find(kind)
    }

    /// What the study of that name finds.
    pub fn finds(&self, kind: &str) -> Finds {
        self.calculation.machine.origin.studies.finds(kind)
    }

    /// The results of studies that find this.
    pub fn results_that(&self, fits: impl Fn(Finds) -> bool) -> impl Iterator<Item = &'a Results> {
        self.calculation.results.iter().filter(move |results| fits(self.finds(results.kind)))
    }

    /// The results of studies that a chapter tells; no study is left out.
    pub fn results_of(&self, chapter: Word) -> impl Iterator<Item = &'a Results> {
        let told = move |kind: &str| self.study(kind).map_or(crate::claims::CHAPTER, Study::chapter);
        self.calculation.results.iter().filter(move |results| told(results.kind) == chapter.chapter())
    }

    /// Whether the machine has anything that moves or is held.
    pub fn is_machine(&self) -> bool {
        !self.equations.coordinates.is_empty()
    }

    pub fn text(&self, text: &'a words::Text) -> &'a str {
        self.language.text(text)
    }
}
