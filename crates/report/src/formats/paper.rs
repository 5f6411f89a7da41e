//! Formats for print walk a document in one way: numbers of figures, tables and equations are counted here.

use super::Sheet;
use super::text::figure_summary;
use crate::document::{Block, Document, Download, Formula, Front, Inline, Rich};
use crate::table::Table;
use crate::wording::Word;
use words::Language;

/// Writes blocks, told their numbers.
pub(super) trait Paper {
    /// Words at a level: 1 is the largest below the title.
    fn heading(&mut self, level: u8, text: &str);
    /// A paragraph.
    fn paragraph(&mut self, content: &Rich);
    /// A formula on its own line, with its number.
    fn equation(&mut self, formula: &Formula, number: Option<usize>);
    /// A table; its number and words.
    fn table(&mut self, table: &Table, caption: Option<(usize, &str)>);
    /// A picture with its caption.
    fn picture(&mut self, file: &str, caption: &Rich);
    /// Files beside the page.
    fn files(&mut self, files: &[Download]);
    /// A title page.
    fn front(&mut self, front: &Front);
    /// The list of headings.
    fn contents(&mut self, headings: &[(u8, &str)]);
    /// Text of a file.
    fn verbatim(&mut self, text: &str);
}

/// Numbers so far.
pub(super) struct Walk<'a> {
    sheet: &'a Sheet<'a>,
    headings: Vec<(u8, &'a str)>,
    language: Language,
    figures: usize,
    tables: usize,
    equations: usize,
}

impl<'a> Walk<'a> {
    pub(super) fn new(document: &'a Document, sheet: &'a Sheet<'a>) -> Walk<'a> {
        Walk { sheet, headings: document.contents(), language: document.language, figures: 0, tables: 0, equations: 0 }
    }

    /// All blocks in order.
    pub(super) fn blocks(&mut self, blocks: &[Block], paper: &mut impl Paper) {
        for block in blocks {
            self.block(block, paper);
        }
    }

    fn block(&mut self, block: &Block, paper: &mut impl Paper) {
        match block {
            Block::Heading { level, text } => paper.heading((*level).clamp(1, 3), text),
            Block::Paragraph(content) => paper.paragraph(content),
            Block::Equation { formula, numbered } => {
                self.equations += usize::from(*numbered);
                paper.equation(formula, numbered.then_some(self.equations));
            }
            Block::Table(table) => {
                self.tables += usize::from(table.caption.is_some());
                paper.table(table, table.caption.as_deref().map(|words| (self.tables, words)));
            }
            Block::Figure(figure) => self.picture(&figure.title, &figure_summary(figure, self.language), paper),
            Block::Bands(bands) => self.picture(&bands.title, &bands.summary(self.language), paper),
            Block::Scheme(scheme) => self.picture(&scheme.title, &scheme.summary.join("\n"), paper),
            Block::Moving(_) => {}
            Block::Details { summary, blocks } => {
                paper.heading(2, summary);
                self.blocks(blocks, paper);
            }
            Block::Downloads(files) => paper.files(files),
            Block::Front(front) => paper.front(front),
            Block::Contents => paper.contents(&self.headings),
            Block::Verbatim(text) => paper.verbatim(text),
        }
    }

    fn picture(&mut self, title: &Rich, summary: &str, paper: &mut impl Paper) {
        self.figures += 1;
        let lead = format!("{}\u{a0}{} – ", self.language.word(Word::Figure), self.figures);
        let caption = Rich(std::iter::once(Inline::Words(lead)).chain(title.0.iter().cloned()).collect());
        match self.sheet.pictures.get(self.figures - 1) {
            Some(file) => paper.picture(file, &caption),
            None => {
                paper.paragraph(&caption);
                summary.lines().for_each(|line| paper.paragraph(&line.trim().into()));
            }
        }
    }
}

/// "Table 3 – words", and "Table 3 (continued)" above its further parts.
pub(super) fn caption((number, words): (usize, &str), part: usize, language: Language) -> String {
    let lead = format!("{}\u{a0}{number}", language.word(Word::Table));
    match part {
        0 => format!("{lead} – {words}"),
        _ => format!("{lead} ({})", language.word(Word::Continuation)),
    }
}

/// Paragraphs of words that hold line feeds.
pub(super) fn paragraphs(content: &Rich) -> Vec<Rich> {
    let mut all = vec![Rich::default()];
    for piece in &content.0 {
        let Inline::Words(words) = piece else {
            all.iter_mut().last().into_iter().for_each(|rich| rich.0.push(piece.clone()));
            continue;
        };
        for (i, line) in words.split('\n').enumerate() {
            if i > 0 {
                all.push(Rich::default());
            }
            all.iter_mut().last().into_iter().for_each(|rich| rich.0.push(Inline::Words(line.into())));
        }
    }
    all
}

/// What the page was made by.
pub(super) fn footer(document: &Document) -> String {
    let word = |w| document.language.word(w);
    let model =
        if document.model_hash.is_empty() { String::new() } else { format!(" · {} {}", word(Word::ModelHash), document.model_hash) };
    format!("strutt, {} {}{model}", word(Word::Version), document.version)
}
