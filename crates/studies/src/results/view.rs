//! Where a result is shown.

use symbolic::Equations;
use words::Language;

/// Width of a formula on the page, in characters of its text form.
const PAGE_WIDTH: usize = 90;

/// How much a document says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Everything: for the page.
    Page,
    /// What fits a terminal of a width: no parameters, no derivation, no plots.
    Terminal {
        /// Characters on a line.
        width: usize,
    },
}

/// What a result is shown with.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    /// The equations of the machine.
    pub equations: &'a Equations,
    /// How much is shown.
    pub extent: Extent,
    /// In which language.
    pub language: Language,
}

impl View<'_> {
    /// Whether it is a page.
    pub fn is_page(&self) -> bool {
        self.extent == Extent::Page
    }

    /// Width of a formula, in characters of its text form.
    pub fn width(&self) -> usize {
        match self.extent {
            Extent::Page => PAGE_WIDTH,
            Extent::Terminal { width } => width,
        }
    }
}
