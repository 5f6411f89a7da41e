//! A formula ready to be written: its layout, where it stands, how long its lines may be. The written forms stand behind it.

use super::layout::{Layout, Placement};
use super::lines::Room;
use super::{latex, lines, mathml, measure, omml, text, typst};

/// A written form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Unicode on one line, or on several of limited width: `m l² φ''`.
    Text,
    /// LaTeX for math mode with amsmath, without delimiters.
    Latex,
    /// MathML Core, a complete `<math>` element.
    MathMl,
    /// Typst for math mode, without dollars.
    Typst,
    /// Office MathML, an `<m:oMath>` element, in a block within `<m:oMathPara>`.
    Omml,
}

/// A formula of a document.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formula {
    /// Its boxes.
    pub layout: Layout,
    /// On a line of its own or within one.
    pub placement: Placement,
    /// The greatest length of a line on its own, in characters of the text form (0.45 em of a formula that is set); longer formulas are
    /// broken at top-level signs. None: never broken.
    pub width: Option<usize>,
}

impl Formula {
    /// Within a sentence or a table cell.
    pub fn inline(layout: Layout) -> Formula {
        Formula { layout, placement: Placement::Inline, width: None }
    }

    /// In a written form.
    pub fn write(&self, form: Form) -> String {
        write(&self.layout, form, self.placement, self.width)
    }

    /// As Unicode text; it may have several lines.
    pub fn text(&self) -> String {
        self.write(Form::Text)
    }
}

/// Writes a layout.
pub(super) fn write(layout: &Layout, form: Form, placement: Placement, width: Option<usize>) -> String {
    let room = match form {
        Form::Text => Room { piece: text::piece_length, aligned: false },
        Form::Latex | Form::MathMl | Form::Typst | Form::Omml => Room { piece: measure::piece_length, aligned: true },
    };
    let lines = lines::split(layout, width.filter(|_| placement == Placement::Block), room);
    match form {
        Form::Text => text::lines(&lines),
        Form::Latex => latex::lines(&lines),
        Form::MathMl => mathml::lines(&lines, placement),
        Form::Typst => typst::lines(&lines),
        Form::Omml => omml::lines(&lines, placement),
    }
}
