//! The pen: headings are numbered, figures and tables are mentioned before they come, formulas know their numbers.

use super::wording::Word;
use report::document::{Formula, Inline, Rich};
use report::formula::Layout;
use report::table::Column;
use report::{Block, Cell, Table};
use symbolic::SymbolId;
use words::Language;
use words::capital;

/// Columns beyond which a table of few rows is turned.
const WIDEST: usize = 10;
/// Rows of such a table.
const FEW: usize = 5;
/// Letters of appendices.
const LETTERS: [(&str, &str); 4] = [("A", "А"), ("B", "Б"), ("C", "В"), ("D", "Г")];

/// a q'' + b q' + c q of one degree of freedom, and the frequency of the only harmonic load with its symbol, rad/s.
pub(super) struct Coefficients {
    pub a: f64,
    pub b: f64,
    pub c: f64,
    pub p: Option<(f64, Layout)>,
}

/// How a chapter is counted.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Count {
    /// 1, 2, 3.
    Number,
    /// Not at all: conclusions, sources.
    None,
    /// Appendix A, B.
    Letter,
}

/// What is written, and the numbers so far.
pub(super) struct Pen {
    pub language: Language,
    pub blocks: Vec<Block>,
    chapters: usize,
    appendices: usize,
    sections: usize,
    /// The number of the chapter, for its sections; empty where it has none.
    number: String,
    figures: usize,
    /// Where figures stand among the blocks, with their numbers.
    drawn: Vec<(usize, usize)>,
    tables: usize,
    equations: usize,
    /// Quantities whose formulas were written.
    pub defined: Vec<SymbolId>,
    /// The linear equation, where there is one.
    pub coefficients: Option<Coefficients>,
}

impl Pen {
    pub fn new(language: Language) -> Pen {
        Pen {
            language,
            blocks: Vec::new(),
            chapters: 0,
            appendices: 0,
            sections: 0,
            number: String::new(),
            figures: 0,
            drawn: Vec::new(),
            tables: 0,
            equations: 0,
            defined: Vec::new(),
            coefficients: None,
        }
    }

    pub fn word(&self, word: Word) -> &'static str {
        self.language.word(word)
    }

    /// A chapter; without its heading when nothing is written in it.
    pub fn chapter(&mut self, (title, count): (Word, Count), write: impl FnOnce(&mut Pen)) {
        let title = self.word(title);
        let before = (self.chapters, self.appendices);
        self.sections = 0;
        let heading = match count {
            Count::None => title.to_owned(),
            Count::Number => {
                self.chapters += 1;
                format!("{} {title}", self.chapters)
            }
            Count::Letter => {
                let (en, ru) = LETTERS[self.appendices.min(LETTERS.len() - 1)];
                self.appendices += 1;
                format!("{} {}. {title}", self.word(Word::Appendix), self.language.pick(en, ru))
            }
        };
        self.number = if count == Count::Number { self.chapters.to_string() } else { String::new() };
        let empty = !self.under(1, heading, write);
        if empty {
            (self.chapters, self.appendices) = before;
        }
    }

    /// A section; without its heading when nothing is written in it.
    pub fn section(&mut self, title: &str, write: impl FnOnce(&mut Pen)) {
        self.sections += 1;
        let heading = if self.number.is_empty() { title.to_owned() } else { format!("{}.{} {title}", self.number, self.sections) };
        if !self.under(2, heading, write) {
            self.sections -= 1;
        }
    }

    /// Whether anything is written under the heading.
    fn under(&mut self, level: u8, heading: String, write: impl FnOnce(&mut Pen)) -> bool {
        let at = self.blocks.len();
        self.blocks.push(Block::heading(level, heading));
        write(self);
        let written = self.blocks.len() > at + 1;
        if !written {
            self.blocks.truncate(at);
        }
        written
    }

    /// A paragraph.
    pub fn say(&mut self, words: impl Into<Rich>) {
        self.blocks.push(Block::paragraph(words));
    }

    /// A paragraph of words and formulas.
    pub fn tell(&mut self, pieces: Vec<Inline>) {
        self.blocks.push(Block::Paragraph(Rich(pieces)));
    }

    /// A formula with a number at the edge; gives the number.
    pub fn numbered(&mut self, formula: Formula) -> usize {
        self.equations += 1;
        self.blocks.push(Block::Equation { formula, numbered: true });
        self.equations
    }

    /// A formula on the way to a result.
    pub fn formula(&mut self, formula: Formula) {
        self.blocks.push(Block::Equation { formula, numbered: false });
    }

    /// A table behind the sentence that mentions it.
    pub fn table(&mut self, table: Table, caption: impl Into<String>) {
        let caption = caption.into();
        if table.columns.len() > WIDEST && table.rows.len() <= FEW {
            return self.table(turned(&table, self.language), caption);
        }
        self.tables += 1;
        let number = self.tables;
        self.say(match self.language {
            Language::En => format!("{caption}: see table\u{a0}{number}."),
            Language::Ru => format!("{caption} – см. таблицу\u{a0}{number}."),
        });
        self.blocks.push(Block::Table(table.with_caption(caption)));
    }

    /// Blocks of a study below its own heading: headings stand one level lower, tables without a caption take that of the study.
    pub fn take(&mut self, blocks: Vec<Block>, caption: &str) {
        let mut blocks = blocks.into_iter().peekable();
        // a table without a caption takes that of what it stands under
        let mut own = caption.to_owned();
        while let Some(block) = blocks.next() {
            match block {
                Block::Heading { level, text } => {
                    own = capital(&text);
                    self.blocks.push(Block::heading((level + 1).min(3), text));
                }
                Block::Table(mut table) => {
                    let told = self.language.pick("values of the quantities", "значения величин");
                    let caption = match table.caption.take() {
                        Some(given) if given == self.language.word(report::Word::Results) => format!("{caption}: {told}"),
                        Some(given) => given,
                        None => titled(&table, &own, self.language),
                    };
                    self.table(table, caption);
                }
                Block::Figure(_) | Block::Bands(_) => {
                    let mut run = vec![block];
                    while let Some(next) = blocks.next_if(|b| matches!(b, Block::Figure(_) | Block::Bands(_))) {
                        run.push(next);
                    }
                    self.pictures(run);
                }
                Block::Equation { formula, numbered: true } => {
                    self.numbered(formula);
                }
                Block::Details { blocks, .. } => self.take(blocks, &own),
                other => self.blocks.push(other),
            }
        }
    }

    /// The scheme behind the sentence that mentions it.
    pub fn scheme(&mut self, scheme: Block) {
        self.figures += 1;
        let n = self.figures;
        self.say(match self.language {
            Language::En => format!("Figure\u{a0}{n} shows the model."),
            Language::Ru => format!("Расчётная схема показана на рисунке\u{a0}{n}."),
        });
        self.blocks.push(scheme);
    }

    /// Bodies released from their connections, behind the sentence that mentions them.
    pub fn released(&mut self, run: Vec<Block>) {
        let (first, last) = (self.figures + 1, self.figures + run.len());
        self.figures = last;
        let places = match (self.language, run.len()) {
            (_, 0) => return,
            (Language::En, 1) => format!("figure\u{a0}{first}"),
            (Language::En, 2) => format!("figures\u{a0}{first} and\u{a0}{last}"),
            (Language::En, _) => format!("figures\u{a0}{first}–{last}"),
            (Language::Ru, 1) => format!("рисунке\u{a0}{first}"),
            (Language::Ru, 2) => format!("рисунках\u{a0}{first} и\u{a0}{last}"),
            (Language::Ru, _) => format!("рисунках\u{a0}{first}–{last}"),
        };
        self.say(self.language.pick(
            format!("The bodies are released from their connections; the reactions that act on them are shown in {places} in their positive directions."),
            format!("Освобождаем тела от связей; действующие на них реакции показаны в положительных направлениях на {places}."),
        ));
        self.blocks.extend(run);
    }

    /// The number of the figure that shows the same curves already.
    fn before(&self, block: &Block) -> Option<usize> {
        let Block::Figure(figure) = block else { return None };
        let same =
            |(at, _): &&(usize, usize)| matches!(self.blocks.get(*at), Some(Block::Figure(old)) if super::repeated::alike(old, figure));
        self.drawn.iter().find(same).map(|(_, number)| *number)
    }

    /// Pictures behind the sentence that mentions them; what a figure shows already is named.
    pub fn pictures(&mut self, run: Vec<Block>) {
        let (mut again, mut fresh) = (Vec::new(), Vec::new());
        for block in run {
            match self.before(&block) {
                Some(number) => again.push(number),
                None => fresh.push(block),
            }
        }
        if !again.is_empty() {
            self.say(super::repeated::told(&again, self.language));
        }
        if !fresh.is_empty() {
            self.draw(fresh);
        }
    }

    fn draw(&mut self, run: Vec<Block>) {
        let (first, last) = (self.figures + 1, self.figures + run.len());
        self.figures = last;
        self.say(match (self.language, run.len()) {
            (Language::En, 1) => format!("Figure\u{a0}{first} shows the result."),
            (Language::En, 2) => format!("Figures\u{a0}{first} and\u{a0}{last} show the results."),
            (Language::En, _) => format!("Figures\u{a0}{first}–{last} show the results."),
            (Language::Ru, 1) => format!("Результат показан на рисунке\u{a0}{first}."),
            (Language::Ru, 2) => format!("Результаты показаны на рисунках\u{a0}{first} и\u{a0}{last}."),
            (Language::Ru, _) => format!("Результаты показаны на рисунках\u{a0}{first}–{last}."),
        });
        let here = self.blocks.len();
        self.drawn.extend((0..run.len()).map(|k| (here + k, first + k)));
        self.blocks.extend(run);
    }
}

/// A wide table of few rows with a row for every column: quantity, unit, what the first column says of each row.
fn turned(table: &Table, language: Language) -> Table {
    let head = |row: &Vec<Cell>| match row.first() {
        Some(Cell::Rich(rich)) => rich.clone(),
        Some(Cell::Number(number)) => Rich::from(number.clone()),
        _ => Rich::default(),
    };
    let mut columns = vec![Column::new(language.word(Word::Quantity)), Column::new(language.word(report::Word::Unit))];
    columns.extend(table.rows.iter().map(|row| Column::new(head(row))));
    let mut turned = Table::new(columns);
    for (i, column) in table.columns.iter().enumerate().skip(1) {
        let values = table.rows.iter().map(|row| row.get(i).cloned().unwrap_or(Cell::Empty));
        turned.row([Cell::Rich(column.head.clone()), Cell::words(column.unit.clone())].into_iter().chain(values).collect());
    }
    turned
}

/// The caption of a table that has none: that of its study, and what its first column says in words.
fn titled(table: &Table, caption: &str, language: Language) -> String {
    let head = table.columns.first().map(|column| column.head.plain(language)).unwrap_or_default();
    // "M: mass matrix" stands above the names of its rows
    if let Some((letter, what)) = head.split_once(": ").filter(|(letter, _)| letter.chars().count() < 4) {
        return format!("{} {letter}", capital(what));
    }
    if head.chars().count() < 4 { caption.to_owned() } else { format!("{caption}: {}", lowered(&head)) }
}

/// The first letter small, unless the word is a symbol or an abbreviation.
pub(super) fn lowered(text: &str) -> String {
    let mut chars = text.chars();
    match (chars.next(), chars.next()) {
        (Some(first), Some(second)) if second.is_lowercase() => first.to_lowercase().chain(text.chars().skip(1)).collect(),
        _ => text.to_owned(),
    }
}

/// Words.
pub(super) fn words(text: impl Into<String>) -> Inline {
    Inline::Words(text.into())
}

/// A formula within a sentence.
pub(super) fn inline(layout: Layout) -> Inline {
    Inline::Formula(Formula::inline(layout))
}
