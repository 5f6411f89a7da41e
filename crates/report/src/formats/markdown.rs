//! Markdown as GitHub and pandoc read it: formulas between dollars, pipe tables, pictures as SVG files beside it.

use super::paper::{self, Paper, Walk, paragraphs};
use super::{Format, Holds, Page, Pictures, Sheet, VECTOR, fit};
use crate::document::{Content, Document, Download, Formula, Front, Inline, Rich};
use crate::escape::address;
use crate::formula::Form;
use crate::table::{Cell, Table};
use crate::wording::Word;
use words::Language;

/// The row of the table.
pub const FORMAT: Format = Format {
    name: "markdown",
    extension: "md",
    help: ("for GitHub or pandoc, with pictures beside it", "для GitHub или pandoc, рисунки рядом"),
    holds: Holds::Page(Page { write, pictures: Pictures::Beside(VECTOR), press: None }),
};

/// A document as Markdown.
pub fn write(document: &Document, sheet: &Sheet) -> String {
    let mut writer = Writer { out: String::new(), language: document.language };
    if !document.has_front() {
        writer.push(&format!("# {}\n", escaped(&document.title)));
    }
    for paragraph in document.description.split('\n').filter(|p| !p.trim().is_empty()) {
        writer.paragraph(&paragraph.into());
    }
    Walk::new(document, sheet).blocks(&document.blocks, &mut writer);
    writer.push(&format!("\n---\n\n{}\n", escaped(&paper::footer(document))));
    writer.out
}

struct Writer {
    out: String,
    language: Language,
}

impl Paper for Writer {
    fn heading(&mut self, level: u8, text: &str) {
        self.push(&format!("\n{} {}\n", "#".repeat(usize::from(level) + 1), escaped(text)));
    }

    fn paragraph(&mut self, content: &Rich) {
        for rich in paragraphs(content) {
            let text = self.rich(&rich);
            self.push(&format!("\n{}\n", at_start(text.trim())));
        }
    }

    fn equation(&mut self, formula: &Formula, number: Option<usize>) {
        let tag = number.map_or(String::new(), |n| format!(" \\tag{{{n}}}"));
        self.push(&format!("\n$$\n{}{tag}\n$$\n", formula.write(Form::Latex)));
    }

    fn table(&mut self, table: &Table, caption: Option<(usize, &str)>) {
        if let Some(caption) = caption {
            self.push(&format!("\n{}\n", escaped(&paper::caption(caption, 0, self.language))));
        }
        let row = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
        let is_number = |i: usize| table.rows.iter().any(|row| matches!(row.get(i), Some(Cell::Number(_))));
        let heads = table.columns.iter().map(|column| self.rich(&fit::head(column))).collect();
        let rules = (0..table.columns.len()).map(|i| if is_number(i) { "---:" } else { ":---" }.to_owned()).collect();
        let mut out = format!("\n{}{}", row(heads), row(rules));
        for cells in &table.rows {
            out.push_str(&row((0..table.columns.len()).map(|i| self.cell(cells.get(i).unwrap_or(&Cell::Empty))).collect()));
        }
        self.push(&out);
    }

    fn picture(&mut self, file: &str, caption: &Rich) {
        let words = escaped(&caption.plain(self.language));
        let caption = self.rich(caption);
        self.push(&format!("\n![{words}]({file})\n\n{caption}\n"));
    }

    fn files(&mut self, files: &[Download]) {
        self.push("\n");
        for file in files.iter().filter(|f| matches!(f.content, Content::Beside)) {
            self.push(&format!("- [{}]({}) {}\n", escaped(&file.name), address(&file.name), escaped(&file.label)));
        }
    }

    fn front(&mut self, front: &Front) {
        front.above.iter().for_each(|line| self.push(&format!("{}\n\n", at_start(&escaped(line)))));
        self.push(&format!("# {}\n\n**{}**\n", escaped(&front.kind), escaped(&front.subject)));
        front.about.iter().for_each(|line| self.push(&format!("\n{}\n", at_start(&escaped(line)))));
        for (role, name) in &front.people {
            let name = if name.is_empty() { "____________________" } else { name };
            self.push(&format!("\n{}: {}\n", escaped(role), escaped(name)));
        }
        self.push(&format!("\n{}\n\n---\n", at_start(&escaped(&front.below))));
    }

    fn contents(&mut self, headings: &[(u8, &str)]) {
        self.push(&format!("\n## {}\n\n", self.language.word(Word::Contents)));
        for (level, text) in headings {
            self.push(&format!("{}- {}\n", "  ".repeat(usize::from(*level) - 1), at_start(&escaped(text))));
        }
    }

    fn verbatim(&mut self, text: &str) {
        self.push("\n");
        text.lines().for_each(|line| self.push(&format!("    {line}\n")));
    }
}

impl Writer {
    fn push(&mut self, text: &str) {
        self.out.push_str(text);
    }

    /// Words and formulas; a dollar before a digit would not close a formula.
    fn rich(&self, rich: &Rich) -> String {
        let mut out = String::new();
        for piece in &rich.0 {
            let one = Rich(vec![piece.clone()]);
            // a bar would part the cells of a table
            let text = one.write(Form::Latex, self.language, (escaped, |f| format!("${}$", f.replace('|', "\\vert "))));
            let apart = out.ends_with('$') && text.starts_with(|c: char| c.is_ascii_digit() || c == '$');
            out.push_str(if apart { " " } else { "" });
            let glued = !matches!(piece, Inline::Words(_)) && out.ends_with(|c: char| c.is_alphanumeric());
            out.push_str(if glued { " " } else { "" });
            out.push_str(&text);
        }
        out
    }

    fn cell(&self, cell: &Cell) -> String {
        match cell {
            Cell::Empty => String::new(),
            Cell::Rich(rich) => self.rich(rich).replace('\n', " "),
            Cell::Verdict(found) => escaped(&super::text::verdict(*found, self.language)),
            Cell::Number(number) => escaped(number),
        }
    }
}

/// Text that begins no list.
fn at_start(text: &str) -> String {
    let digits = text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    match text[digits..].chars().next() {
        Some(c @ ('.' | ')')) if digits > 0 => format!("{}\\{c}{}", &text[..digits], &text[digits + 1..]),
        Some('-' | '+' | '=' | ':' | '%') if digits == 0 => format!("\\{text}"),
        _ => text.to_owned(),
    }
}

/// User text: no character of it means anything to Markdown.
pub(crate) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\\' | '`' | '*' | '_' | '{' | '}' | '[' | ']' | '<' | '>' | '#' | '$' | '|' | '~' | '^' | '@' | '&' | '!' => {
                out.push('\\');
                out.push(c);
            }
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_character_of_the_user_means_anything() {
        let text = escaped("$ % & # _ { } ~ ^ \\ < > \" @ * ` [x](y) | маятник");
        for c in ['$', '&', '#', '_', '{', '}', '~', '^', '<', '>', '@', '*', '`', '[', ']', '|'] {
            assert!(text.match_indices(c).all(|(i, _)| text[..i].ends_with('\\')), "{c} in {text}");
        }
        assert_eq!(at_start("1. a"), "1\\. a");
        assert_eq!(at_start("- a"), "\\- a");
        assert_eq!(at_start("1,5 a"), "1,5 a");
    }
}
