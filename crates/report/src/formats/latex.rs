//! LaTeX: a file for pdflatex, xelatex or lualatex of the class article, with packages of every distribution. Russian is set in T2A by pdflatex,
//! by a font of the system that has Cyrillic by the others. Pictures are PNG files beside it: LaTeX reads no SVG.
//!
//! Nothing sticks out: tables are fitted (`fit.rs`) and go over pages, formulas are broken at their signs and made smaller where a
//! single term is too wide, words longer than a line may be broken.

use super::fit::{self, Fitted, Room, breakable, longest_decimals};
use super::paper::{self, Paper, Walk, paragraphs};
use super::signs::{Sign, sign};
use super::{Drawing, Format, Holds, Page, Pictures, Press, RASTER, Sheet};
use crate::document::{Content, Document, Download, Formula, Front, Rich};
use crate::formula::Form;
use crate::table::{Cell, Table, split_number};
use crate::wording::Word;
use std::collections::BTreeSet;
use words::Language;

/// The row of the table.
pub const FORMAT: Format = Format {
    name: "latex",
    extension: "tex",
    help: ("for pdflatex or xelatex, with pictures beside it", "для pdflatex или xelatex, рисунки рядом"),
    holds: Holds::Page(Page { write, pictures: Pictures::Beside(PNG), press: Some(Press::Latex) }),
};

const PNG: Drawing = RASTER;
const PREAMBLE: &str = include_str!("preamble.tex");
const MACROS: &str = include_str!("macros.tex");
/// An em of the sizes of type of tables, and how they are called.
const SIZES: [(f64, &str); 4] = [(10.95, "\\normalsize"), (10.0, "\\small"), (9.25, "\\footnotesize"), (8.5, "\\scriptsize")];
/// Width between the margins of a page A4, pt of TeX, less what rounding may cost.
const WIDTH: f64 = 480.0;
/// Space beside the text of a column, pt.
const GAP: f64 = 8.0;
/// Characters of a line of formulas: 41 em, the number stands beside.
const LINE: usize = 90;

/// A document as LaTeX.
pub fn write(document: &Document, sheet: &Sheet) -> String {
    let mut writer = Writer { out: String::new(), language: document.language, listed: !document.contents().is_empty() };
    if !document.has_front() {
        writer.push(&format!("\\begin{{center}}\\LARGE\\bfseries {}\\end{{center}}\n", escaped(&document.title)));
    }
    for paragraph in document.description.split('\n').filter(|p| !p.trim().is_empty()) {
        writer.paragraph(&paragraph.into());
    }
    Walk::new(document, sheet).blocks(&document.blocks, &mut writer);
    writer.push(&format!("\n\\bigskip{{\\footnotesize {}\\par}}\n", escaped(&paper::footer(document))));
    let body = writer.out;
    format!("{}\\begin{{document}}\n{body}\\end{{document}}\n", head(document, &body))
}

fn head(document: &Document, body: &str) -> String {
    let languages = document.language.pick("russian,english", "english,russian");
    let mut out = format!(
        "% strutt {}: pdflatex, xelatex or lualatex\n\\documentclass[11pt,a4paper]{{article}}\n{PREAMBLE}\\usepackage[{languages},shorthands=off]{{babel}}\n",
        escaped(&document.version)
    );
    out.push_str(&declarations(body));
    out.push_str(MACROS);
    out
}

/// The signs that occur and that fonts of text do not have.
fn declarations(body: &str) -> String {
    let used: BTreeSet<char> = body.chars().filter(|c| !c.is_ascii()).collect();
    let mut out = String::from(
        "\\iftutex\n  \\newcommand{\\sign}[2]{\\catcode\"#1=\\active\\begingroup\\lccode`\\~=\"#1\\relax\\lowercase{\\endgroup\\protected\\def~}{#2}}\n\
         \x20 \\newcommand{\\eightbits}[2]{}\n\\else\n  \\newcommand{\\sign}[2]{\\DeclareUnicodeCharacter{#1}{#2}}\n  \\newcommand{\\eightbits}[2]{\\sign{#1}{#2}}\n\\fi\n",
    );
    for c in used {
        match sign(c) {
            Some(Sign::Set(text)) => out.push_str(&format!("\\sign{{{:04X}}}{{{text}}}\n", c as u32)),
            Some(Sign::EightBits(text)) => out.push_str(&format!("\\eightbits{{{:04X}}}{{{text}}}\n", c as u32)),
            None => {}
        }
    }
    out
}

struct Writer {
    out: String,
    language: Language,
    /// Whether headings stand in a list of contents.
    listed: bool,
}

impl Paper for Writer {
    fn heading(&mut self, level: u8, text: &str) {
        let command = ["section", "subsection", "subsubsection"][usize::from(level) - 1];
        self.push(&format!("\n\\{command}*{{\\raggedright {}}}\n", escaped(text)));
        if self.listed && level < 3 {
            self.push(&format!("\\addcontentsline{{toc}}{{{command}}}{{{}}}\n", escaped(text)));
        }
    }

    fn paragraph(&mut self, content: &Rich) {
        for rich in paragraphs(content) {
            let text = self.rich(&rich, "$");
            self.push(&format!("\n{text}\\par\n"));
        }
    }

    fn equation(&mut self, formula: &Formula, number: Option<usize>) {
        let formula = Formula { width: formula.width.map(|width| width.min(LINE)), ..formula.clone() }.write(Form::Latex);
        match number {
            Some(number) => self.push(&format!("\\begin{{equation*}}\n\\fit{{{formula}}}\\tag{{{number}}}\n\\end{{equation*}}\n")),
            None => self.push(&format!("\\[\n\\fit{{{formula}}}\n\\]\n")),
        }
    }

    fn table(&mut self, table: &Table, caption: Option<(usize, &str)>) {
        let sizes = SIZES.map(|(size, _)| size);
        let Fitted { size, parts } = fit::fit(table, self.language, &Room { width: WIDTH, sizes: &sizes, gap: GAP });
        for (i, part) in parts.iter().enumerate() {
            if let Some(caption) = caption {
                let words = escaped(&paper::caption(caption, i, self.language));
                self.push(&format!("\n\\needspace{{5\\baselineskip}}\\noindent {words}\\par\\nopagebreak\n"));
            }
            self.part(table, part, SIZES[size]);
        }
    }

    fn picture(&mut self, file: &str, caption: &Rich) {
        let caption = self.rich(caption, "$");
        self.push(&format!("\n\\drawing{{{file}}}{{{caption}}}\n"));
    }

    fn files(&mut self, files: &[Download]) {
        self.push("\n\\begin{itemize}\n");
        for file in files.iter().filter(|f| matches!(f.content, Content::Beside)) {
            self.push(&format!("\\item \\texttt{{{}}} {}\n", loose(&file.name), escaped(&file.label)));
        }
        self.push("\\end{itemize}\n");
    }

    fn front(&mut self, front: &Front) {
        self.push("\\begin{titlepage}\\centering\n");
        front.above.iter().for_each(|line| self.push(&format!("{}\\par\n", escaped(line))));
        self.push(&format!("\\vfill{{\\Large\\bfseries {}\\par}}\\medskip\n", escaped(&front.kind)));
        self.push(&format!("{{\\large {}\\par}}\\medskip\n", escaped(&front.subject)));
        front.about.iter().for_each(|line| self.push(&format!("{}\\par\n", escaped(line))));
        self.push("\\vfill\n");
        for (role, name) in &front.people {
            let name = if name.is_empty() { "\\rule{5cm}{0.4pt}".to_owned() } else { escaped(name) };
            self.push(&format!("\\noindent\\hfill\\makebox[8cm][l]{{{}: {name}}}\\par\\smallskip\n", escaped(role)));
        }
        self.push(&format!("\\vfill {}\\par\n\\end{{titlepage}}\n\\setcounter{{page}}{{2}}\n", escaped(&front.below)));
    }

    fn contents(&mut self, _: &[(u8, &str)]) {
        let title = escaped(self.language.word(Word::Contents));
        self.push(&format!("\\renewcommand{{\\contentsname}}{{{title}}}\\tableofcontents\\clearpage\n"));
    }

    fn verbatim(&mut self, text: &str) {
        self.push("\n{\\footnotesize\\ttfamily\\raggedright\\parindent=0pt\n");
        for line in text.lines() {
            let bare = line.trim_start();
            let lead = "~".repeat(line.chars().count() - bare.chars().count());
            self.push(&if bare.is_empty() { "\\smallskip\n".to_owned() } else { format!("{lead}{}\\par\n", escaped(bare)) });
        }
        self.push("}\n");
    }
}

impl Writer {
    fn push(&mut self, text: &str) {
        self.out.push_str(text);
    }

    fn rich(&self, rich: &Rich, dollar: &str) -> String {
        let (open, close) = if dollar == "$" { ("$", "$") } else { ("\\fitcell{", "}") };
        rich.write(Form::Latex, self.language, (escaped, |formula| format!("{open}{formula}{close}")))
    }

    /// Some columns of a table, over pages.
    fn part(&mut self, table: &Table, columns: &[(usize, f64)], (em, size): (f64, &str)) {
        let numbers: Vec<&str> = columns.iter().map(|(i, _)| longest_decimals(table, *i)).collect();
        let is_number = |i: usize| table.rows.iter().any(|row| matches!(row.get(i), Some(Cell::Number(_))));
        let kinds: String =
            columns.iter().map(|(i, width)| format!("{}{{{:.1}pt}}", if is_number(*i) { 'R' } else { 'L' }, width * em)).collect();
        let heads: Vec<String> = columns.iter().map(|(i, _)| self.rich(&fit::head(&table.columns[*i]), "")).collect();
        self.push(&format!(
            "{{{size}\\setlength{{\\tabcolsep}}{{{}pt}}\\begin{{longtable}}{{{kinds}}}\n\\toprule\n{} \\\\\n\\midrule\n\\endhead\n\\bottomrule\n\\endfoot\n",
            GAP / 2.0,
            heads.join(" & ")
        ));
        for row in &table.rows {
            let cells: Vec<String> =
                columns.iter().zip(&numbers).map(|((i, _), longest)| self.cell(row.get(*i).unwrap_or(&Cell::Empty), longest)).collect();
            self.push(&format!("{} \\\\\n", cells.join(" & ")));
        }
        self.push("\\end{longtable}}\n");
    }

    fn cell(&self, cell: &Cell, longest: &str) -> String {
        match cell {
            Cell::Empty => String::new(),
            Cell::Rich(rich) => self.rich(rich, ""),
            Cell::Verdict(found) => escaped(&super::text::verdict(*found, self.language)),
            Cell::Number(number) => {
                let (whole, rest) = split_number(number);
                format!("\\num{{{}}}{{{}}}{{{}}}", escaped(whole), escaped(rest), escaped(longest))
            }
        }
    }
}

/// A name of a file that may be broken behind its marks.
fn loose(name: &str) -> String {
    let mut out = String::new();
    for piece in name.split_inclusive(['-', '_', '.', '/']) {
        out.push_str(&escaped(piece));
        out.push_str("\\allowbreak{}");
    }
    out
}

/// User text: no character of it means anything to LaTeX.
pub(crate) fn escaped(text: &str) -> String {
    breakable(text).into_iter().map(plain).collect::<Vec<_>>().join("\\allowbreak{}")
}

fn plain(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut before = ' ';
    for c in text.chars() {
        match c {
            '\\' => out.push_str("\\textbackslash{}"),
            '^' => out.push_str("\\textasciicircum{}"),
            '~' => out.push_str("\\textasciitilde{}"),
            '<' => out.push_str("\\textless{}"),
            '>' => out.push_str("\\textgreater{}"),
            '|' => out.push_str("\\textbar{}"),
            '"' => out.push_str("\\textquotedbl{}"),
            '\'' => out.push_str("\\textquotesingle{}"),
            '`' => out.push_str("\\textasciigrave{}"),
            '{' | '}' | '$' | '&' | '#' | '%' | '_' => {
                out.push('\\');
                out.push(c);
            }
            // an optional argument or a star behind the end of a row
            '[' | ']' | '*' => out.push_str(&format!("{{{c}}}")),
            // no ligatures
            '-' | ',' if before == c => out.push_str(&format!("{{}}{c}")),
            '\u{a0}' => out.push('~'),
            '\u{202f}' | '\u{2009}' => out.push_str("\\,"),
            '\u{200b}' => out.push_str("\\allowbreak{}"),
            '\u{ad}' => out.push_str("\\-"),
            '\u{2011}' => out.push_str("\\mbox{-}"),
            c if c.is_control() || is_silent(c) => out.push(' '),
            c => out.push(c),
        }
        before = c;
    }
    out
}

/// Marks without a shape: directions, joiners, what belongs to no text.
fn is_silent(c: char) -> bool {
    matches!(c, '\u{200c}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff0}'..='\u{ffff}')
        || (c as u32) & 0xfffe == 0xfffe
        || matches!(c, '\u{300}'..='\u{36f}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_character_of_the_user_means_anything() {
        let hostile = "$ % & # _ { } ~ ^ \\ < > \" @ * ` -- | [x] маятник φ₁";
        let text = escaped(hostile);
        for c in ['$', '%', '&', '#', '_'] {
            assert!(text.match_indices(c).all(|(i, _)| text[..i].ends_with('\\')), "{c} in {text}");
        }
        let depth = text.replace("\\{", "").replace("\\}", "").chars().fold(0, |d, c| d + i32::from(c == '{') - i32::from(c == '}'));
        assert_eq!(depth, 0, "{text}");
        assert!(text.ends_with("маятник φ₁") && !text.contains("--"));
    }

    #[test]
    fn signs_that_fonts_lack_are_declared_once() {
        let head = declarations("φ φ ² é 中 маятник");
        assert!(head.contains("\\sign{03C6}{\\ensuremath{\\varphi}}") && head.contains("\\sign{00B2}{\\textsuperscript{2}}"), "{head}");
        assert!(head.contains("\\eightbits{00E9}") && head.contains("\\eightbits{4E2D}{\\texttt{U+4E2D}}"), "{head}");
        assert_eq!(head.matches("03C6").count(), 1);
        assert!(!head.contains("043C"));
    }
}
