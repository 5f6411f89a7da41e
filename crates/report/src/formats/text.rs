//! Terminal text of a [`Document`]: headings, paragraphs cut to the width, tables aligned on the decimal mark.

use super::{Format, Holds, Page, Pictures, Sheet};
use crate::document::{Block, Content, Document, Front, Rich};
use crate::figure::Figure;
use crate::number::short;
use crate::symbol;
use crate::table::{Cell, Table, Verdict, split_number};
use crate::wording::Word;
use words::Language;

/// The row of the table.
pub const FORMAT: Format = Format {
    name: "text",
    extension: "txt",
    help: ("for the terminal", "для терминала"),
    holds: Holds::Page(Page {
        write: |document: &Document, sheet: &Sheet| write(document, sheet.width),
        pictures: Pictures::Told,
        press: None,
    }),
};

/// Space between two columns of a table.
const GAP: usize = 2;

/// The whole document as text with lines of at most `width` characters (formulas and words longer than that stay whole).
pub fn write(document: &Document, width: usize) -> String {
    let (language, width) = (document.language, width.max(20));
    let mut writer = Writer { out: String::new(), language, width, headings: Vec::new(), figures: 0, tables: 0, equations: 0 };
    writer.headings = document.contents().into_iter().map(|(level, text)| (level, text.to_owned())).collect();
    if !document.has_front() {
        writer.line(&document.title);
        writer.line(&"=".repeat(document.title.chars().count().min(writer.width)));
    }
    if !document.description.is_empty() {
        writer.paragraph(&document.description);
    }
    writer.blocks(&document.blocks);
    writer.out
}

/// One table as text, aligned on decimal marks and cut to `width`.
pub fn table(table: &Table, language: Language, width: usize) -> String {
    let n_rows = table.rows.len();
    let columns: Vec<Vec<String>> = (0..table.columns.len()).map(|i| column_lines(table, i, language)).collect();
    let mut lines = vec![String::new(); n_rows + 1];
    let mut used = 0;
    let mut cut = false;
    for cells in &columns {
        let wide = cells.iter().map(|c| c.chars().count()).max().unwrap_or(0);
        let gap = if used == 0 { 0 } else { GAP };
        // the first column is always shown: a table without it says nothing
        if used > 0 && used + gap + wide > width {
            cut = true;
            break;
        }
        for (line, cell) in lines.iter_mut().zip(cells) {
            let pad = used + gap - line.chars().count();
            line.extend(std::iter::repeat_n(' ', pad));
            line.push_str(cell);
        }
        used += gap + wide;
    }
    let mut out = String::new();
    for (i, line) in lines.iter().enumerate() {
        out.push_str(line.trim_end());
        out.push('\n');
        if i == 0 {
            out.push_str(&"─".repeat(used.min(width)));
            out.push('\n');
        }
    }
    if cut {
        out.push_str(&format!("… {}\n", language.word(Word::Continued)));
    }
    out
}

/// Head and cells of one column, numbers already padded to their decimal mark.
fn column_lines(table: &Table, i_column: usize, language: Language) -> Vec<String> {
    let column = &table.columns[i_column];
    let mut head = column.head.plain(language);
    if !column.unit.is_empty() {
        head = format!("{head}, {}", column.unit);
    }
    let (whole, decimals) = table.number_width(i_column);
    let has_numbers = whole + decimals > 0;
    // a wide head over narrow numbers: both end at the same place
    let shift = head.chars().count().saturating_sub(whole + decimals);
    let mut lines = vec![if has_numbers { format!("{head:>w$}", w = whole + decimals) } else { head }];
    for row in &table.rows {
        lines.push(match row.get(i_column).unwrap_or(&Cell::Empty) {
            Cell::Empty => String::new(),
            Cell::Rich(rich) => rich.plain(language),
            Cell::Verdict(found) => verdict(*found, language),
            Cell::Number(number) => {
                let (w, d) = split_number(number);
                format!("{:shift$}{w:>whole$}{d:<decimals$}", "")
            }
        });
    }
    lines
}

/// The mark and the word of a verdict: the mark alone would say nothing to a screen reader.
pub fn verdict(found: Verdict, language: Language) -> String {
    let (mark, word) = match found {
        Verdict::Passed => ('✓', Word::Passed),
        Verdict::Failed => ('✗', Word::Failed),
    };
    format!("{mark} {}", language.word(word))
}

struct Writer {
    out: String,
    language: Language,
    width: usize,
    headings: Vec<(u8, String)>,
    figures: usize,
    tables: usize,
    equations: usize,
}

impl Writer {
    fn line(&mut self, line: &str) {
        self.out.push_str(line);
        self.out.push('\n');
    }

    fn blocks(&mut self, blocks: &[Block]) {
        for block in blocks {
            self.block(block);
        }
    }

    fn block(&mut self, block: &Block) {
        if matches!(block, Block::Moving(_)) {
            return;
        }
        self.out.push('\n');
        match block {
            Block::Moving(_) => {}
            Block::Heading { level, text } => {
                self.line(text);
                let rule = if *level == 1 { "─" } else { "·" };
                self.line(&rule.repeat(text.chars().count().min(self.width)));
            }
            Block::Paragraph(rich) => self.paragraph(&rich.plain(self.language)),
            Block::Equation { formula, numbered } => {
                self.equations += usize::from(*numbered);
                self.equation(&formula.text(), numbered.then_some(self.equations));
            }
            Block::Table(content) => {
                if let Some(caption) = &content.caption {
                    self.tables += 1;
                    let caption = format!("{} {} – {caption}", self.language.word(Word::Table), self.tables);
                    self.paragraph(&caption);
                }
                let text = table(content, self.language, self.width);
                self.out.push_str(&text);
            }
            Block::Figure(figure) => {
                self.figure(&figure.title);
                let summary = figure_summary(figure, self.language);
                self.out.push_str(&summary);
            }
            Block::Bands(bands) => {
                self.figure(&bands.title);
                let summary = bands.summary(self.language);
                self.out.push_str(&summary);
            }
            Block::Scheme(scheme) => {
                self.figure(&scheme.title);
                scheme.summary.iter().for_each(|line| self.line(&format!("  {line}")));
            }
            Block::Details { summary, blocks } => {
                self.line(summary);
                self.blocks(blocks);
            }
            Block::Downloads(files) => {
                for file in files.iter().filter(|f| matches!(f.content, Content::Beside)) {
                    self.line(&format!("  {}  {}", file.name, file.label));
                }
            }
            Block::Front(front) => self.front(front),
            Block::Contents => {
                self.line(self.language.word(Word::Contents));
                for (level, text) in std::mem::take(&mut self.headings) {
                    self.line(&format!("{}{text}", "  ".repeat(usize::from(level))));
                }
            }
            Block::Verbatim(text) => text.lines().for_each(|line| self.line(line)),
        }
    }

    /// The caption of a figure.
    fn figure(&mut self, title: &Rich) {
        self.figures += 1;
        let caption = format!("{} {} – {}", self.language.word(Word::Figure), self.figures, title.plain(self.language));
        self.paragraph(&caption);
    }

    fn front(&mut self, front: &Front) {
        let head = front.above.iter().chain([&front.kind, &front.subject]).chain(&front.about);
        head.for_each(|line| self.paragraph(line));
        for (role, name) in &front.people {
            self.line(&format!("{role}: {}", if name.is_empty() { "____________________" } else { name }));
        }
        self.line(&front.below);
    }

    fn paragraph(&mut self, text: &str) {
        for paragraph in text.split('\n') {
            let wrapped = wrap(paragraph, self.width);
            self.out.push_str(&wrapped);
        }
    }

    /// Indented; the number stands at the right edge of the last line if it fits, otherwise two spaces behind.
    fn equation(&mut self, text: &str, number: Option<usize>) {
        let lines: Vec<&str> = text.lines().collect();
        for (i, line) in lines.iter().enumerate() {
            self.out.push_str("  ");
            self.out.push_str(line);
            if let Some(n) = number.filter(|_| i + 1 == lines.len()) {
                let number = format!("({n})");
                let free = self.width.saturating_sub(2 + line.chars().count() + number.chars().count());
                self.out.extend(std::iter::repeat_n(' ', free.max(2)));
                self.out.push_str(&number);
            }
            self.out.push('\n');
        }
    }
}

/// Lines of at most `width` characters, cut at spaces; a no-break space is none.
fn wrap(text: &str, width: usize) -> String {
    let mut out = String::new();
    let mut used = 0;
    for word in text.split(' ').filter(|w| !w.is_empty()) {
        let n = word.chars().count();
        if used > 0 && used + 1 + n > width {
            out.push('\n');
            used = 0;
        }
        if used > 0 {
            out.push(' ');
            used += 1;
        }
        out.push_str(word);
        used += n;
    }
    out.push('\n');
    out
}

/// What a figure shows, in words and numbers: one line per series.
pub fn figure_summary(figure: &Figure, language: Language) -> String {
    if let Some(field) = &figure.field {
        return field.summary(language);
    }
    let mut out = String::new();
    for (i, series) in figure.series.iter().enumerate() {
        let finite = || series.y.iter().copied().filter(|y| y.is_finite()).map(|y| y / figure.y.scale.size);
        let (low, high) = finite().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), y| (l.min(y), h.max(y)));
        let name = symbol::plain(&series.name, language);
        if low > high {
            out.push_str(&format!("  {name}: {}\n", language.word(Word::NoData)));
            continue;
        }
        let last = finite().next_back().unwrap_or(low);
        let number = |x| crate::number::with_unit(&short(x, 4, language), &figure.y.unit(i, language));
        out.push_str(&format!(
            "  {name}: {} {}, {} {}, {} {}\n",
            language.word(Word::Minimum),
            number(low),
            language.word(Word::Maximum),
            number(high),
            language.word(Word::Final),
            number(last)
        ));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::Column;

    fn numbers() -> Table {
        let mut t = Table::new(vec![Column::new("Обозначение"), Column::with_unit("Значение", "m", Language::Ru), Column::new("Вывод")]);
        t.row(vec![Cell::symbol("c_x"), Cell::Number("12,5".into()), Cell::Verdict(Verdict::Passed)]);
        t.row(vec![Cell::symbol("phi'"), Cell::Number("−1234".into()), Cell::Verdict(Verdict::Failed)]);
        t.row(vec![Cell::words("a"), Cell::Number("1,25·10⁻³".into()), Cell::Empty]);
        t
    }

    #[test]
    fn numbers_line_up_on_the_decimal_mark() {
        let text = table(&numbers(), Language::Ru, 80);
        let column = |line: &str, c: char| line.chars().position(|x| x == c).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(column(lines[2], ','), column(lines[4], ','), "\n{text}");
        assert_eq!(column(lines[3], '4') + 1, column(lines[4], ','), "\n{text}");
    }

    #[test]
    fn a_table_is_cut_to_the_width_and_says_so() {
        let text = table(&numbers(), Language::Ru, 30);
        assert!(text.lines().take(5).all(|line| line.chars().count() <= 30), "\n{text}");
        assert!(text.contains('…') && !text.contains("Вывод"));
    }

    #[test]
    fn paragraphs_wrap_at_spaces_only() {
        assert_eq!(wrap("one two\u{a0}three four", 10), "one\ntwo\u{a0}three\nfour\n");
    }
}
