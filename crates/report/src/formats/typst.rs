//! Typst: a file for the compiler of typst, without packages. Pictures are SVG files beside it.
//!
//! Nothing sticks out: tables are fitted (`fit.rs`) and go over pages, formulas are broken at their signs and made smaller where a
//! single term is too wide.

use super::fit::{self, Fitted, Room, breakable, longest_decimals};
use super::paper::{self, Paper, Walk, paragraphs};
use super::{Format, Holds, Page, Pictures, Press, Sheet, VECTOR};
use crate::document::{Content, Document, Download, Formula, Front, Rich};
use crate::formula::Form;
use crate::table::{Cell, Table, split_number};
use crate::wording::Word;
use words::Language;

/// The row of the table.
pub const FORMAT: Format = Format {
    name: "typst",
    extension: "typ",
    help: ("for typst, with pictures beside it", "для typst, рисунки рядом"),
    holds: Holds::Page(Page { write, pictures: Pictures::Beside(VECTOR), press: Some(Press::Typst) }),
};

const MACROS: &str = include_str!("macros.typ");
/// Sizes of type of tables, pt.
const SIZES: [f64; 4] = [11.0, 10.0, 9.0, 8.0];
/// Width between the margins of a page A4, pt.
const WIDTH: f64 = 480.0;
/// Space beside the text of a column, pt.
const GAP: f64 = 6.0;
/// Characters of a line of formulas: 41 em, the number stands beside.
const LINE: usize = 90;

/// A document as Typst.
pub fn write(document: &Document, sheet: &Sheet) -> String {
    let mut writer = Writer { out: String::new(), language: document.language };
    let (title, code) = (string(&document.title), document.language.code());
    writer.push(&format!(
        "// strutt {}\n#set document(title: {title})\n#set text(lang: \"{code}\", size: 11pt)\n{MACROS}\n",
        document.version.replace('\n', " ")
    ));
    if !document.has_front() {
        writer.push(&format!("#align(center, text(18pt, weight: \"bold\")[{}])\n", escaped(&document.title)));
    }
    for paragraph in document.description.split('\n').filter(|p| !p.trim().is_empty()) {
        writer.paragraph(&paragraph.into());
    }
    Walk::new(document, sheet).blocks(&document.blocks, &mut writer);
    writer.push(&format!("\n#v(1em)\n#text(8pt)[{}]\n", escaped(&paper::footer(document))));
    writer.out
}

struct Writer {
    out: String,
    language: Language,
}

impl Paper for Writer {
    fn heading(&mut self, level: u8, text: &str) {
        self.push(&format!("\n#heading(level: {level})[{}]\n", escaped(text)));
    }

    fn paragraph(&mut self, content: &Rich) {
        for rich in paragraphs(content) {
            let text = self.rich(&rich);
            self.push(&format!("\n{text}\n"));
        }
    }

    fn equation(&mut self, formula: &Formula, number: Option<usize>) {
        let formula = Formula { width: formula.width.map(|width| width.min(LINE)), ..formula.clone() }.write(Form::Typst);
        let number = number.map_or("[]".to_owned(), |n| format!("[({n})]"));
        self.push(&format!("\n#formula({number}, $ {formula} $)\n"));
    }

    fn table(&mut self, table: &Table, caption: Option<(usize, &str)>) {
        let Fitted { size, parts } = fit::fit(table, self.language, &Room { width: WIDTH, sizes: &SIZES, gap: GAP });
        for (i, part) in parts.iter().enumerate() {
            let words = caption.map_or(String::new(), |caption| escaped(&paper::caption(caption, i, self.language)));
            self.push(&format!("\n#titled([{words}], text({}pt, ", SIZES[size]));
            self.part(table, part);
            self.push("))\n");
        }
    }

    fn picture(&mut self, file: &str, caption: &Rich) {
        let caption = self.rich(caption);
        self.push(&format!("\n#picture({}, [{caption}])\n", string(file)));
    }

    fn files(&mut self, files: &[Download]) {
        self.push("\n");
        for file in files.iter().filter(|f| matches!(f.content, Content::Beside)) {
            self.push(&format!("- #raw({}) {}\n", string(&file.name), escaped(&file.label)));
        }
    }

    fn front(&mut self, front: &Front) {
        self.push("#page(numbering: none, align(center)[\n");
        front.above.iter().for_each(|line| self.push(&format!("{}\n\n", escaped(line))));
        self.push(&format!("#v(1fr)\n#text(17pt, weight: \"bold\")[{}]\n\n", escaped(&front.kind)));
        self.push(&format!("#text(14pt)[{}]\n\n", escaped(&front.subject)));
        front.about.iter().for_each(|line| self.push(&format!("{}\n\n", escaped(line))));
        self.push("#v(1fr)\n#align(right, block(width: 55%, align(left)[\n");
        for (role, name) in &front.people {
            let name = if name.is_empty() { "#box(width: 1fr, line(length: 100%, stroke: 0.5pt))".to_owned() } else { escaped(name) };
            self.push(&format!("{}: {name}\n\n", escaped(role)));
        }
        self.push(&format!("]))\n#v(1fr)\n{}\n])\n#counter(page).update(2)\n", escaped(&front.below)));
    }

    fn contents(&mut self, _: &[(u8, &str)]) {
        let title = escaped(self.language.word(Word::Contents));
        self.push(&format!("\n#outline(title: [{title}], depth: 2)\n#pagebreak()\n"));
    }

    fn verbatim(&mut self, text: &str) {
        let lines: Vec<String> = text.lines().map(string).collect();
        self.push(&format!("\n#text(8pt, raw(block: true, ({},).join(\"\\n\")))\n", lines.join(", ")));
    }
}

impl Writer {
    fn push(&mut self, text: &str) {
        self.out.push_str(text);
    }

    fn rich(&self, rich: &Rich) -> String {
        rich.write(Form::Typst, self.language, (escaped, |formula| format!("${formula}$")))
    }

    /// The same where a formula may be wider than its room.
    fn fitted(&self, rich: &Rich) -> String {
        rich.write(Form::Typst, self.language, (escaped, |formula| format!("#fit(${formula}$)")))
    }

    /// Some columns of a table.
    fn part(&mut self, table: &Table, columns: &[(usize, f64)]) {
        let longest: Vec<&str> = columns.iter().map(|(i, _)| longest_decimals(table, *i)).collect();
        let is_number = |i: usize| table.rows.iter().any(|row| matches!(row.get(i), Some(Cell::Number(_))));
        let widths: String = columns.iter().map(|(_, em)| format!("{em:.2}em + {GAP}pt, ")).collect();
        let sides: String = columns.iter().map(|(i, _)| if is_number(*i) { "right, " } else { "left, " }).collect();
        let heads: String = columns.iter().map(|(i, _)| format!("[{}], ", self.rich(&fit::head(&table.columns[*i])))).collect();
        self.push(&format!(
            "table(columns: ({widths}), align: ({sides}),\n  table.header(table.hline(), {heads}table.hline(stroke: 0.5pt)),\n"
        ));
        for row in &table.rows {
            let cells: String =
                columns.iter().zip(&longest).map(|((i, _), longest)| self.cell(row.get(*i).unwrap_or(&Cell::Empty), longest)).collect();
            self.push(&format!("  {cells}\n"));
        }
        self.push("  table.hline())");
    }

    fn cell(&self, cell: &Cell, longest: &str) -> String {
        match cell {
            Cell::Empty => "[], ".into(),
            Cell::Rich(rich) if rich.0.len() == 1 => format!("[{}], ", self.fitted(rich)),
            Cell::Rich(rich) => format!("[{}], ", self.rich(rich)),
            Cell::Verdict(found) => format!("[{}], ", escaped(&super::text::verdict(*found, self.language))),
            Cell::Number(number) => {
                let (whole, rest) = split_number(number);
                format!("num([{}], [{}], [{}]), ", escaped(whole), escaped(rest), escaped(longest))
            }
        }
    }
}

/// Text between quotes of code.
fn string(text: &str) -> String {
    let mut out = String::from('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => {
                out.push('\\');
                out.push(c);
            }
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// User text: no character of it means anything to Typst.
pub(crate) fn escaped(text: &str) -> String {
    breakable(text).into_iter().map(plain).collect::<Vec<_>>().join("\u{200b}")
}

fn plain(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            // units are not broken
            '/' => out.push_str("\\/\u{2060}"),
            // a backslash before any mark makes it a mere mark
            '(' | ')' | ',' | ';' | '!' | '?' => out.push(c),
            c if c.is_ascii_punctuation() => {
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
        let text = escaped("$ % & # _ { } ~ ^ \\ < > \" @ * ` = - + / // [x] 1. маятник");
        assert!(text.ends_with("1\\. маятник"), "{text}");
        let mut chars = text.chars();
        while let Some(c) = chars.next() {
            match c {
                '\\' => assert!(chars.next().is_some_and(|c| c.is_ascii_punctuation())),
                c => assert!(c.is_alphanumeric() || c == ' ' || c == '\u{2060}', "{c} in {text}"),
            }
        }
        assert_eq!(string("a\"b\\c\n"), "\"a\\\"b\\\\c \"");
    }
}
