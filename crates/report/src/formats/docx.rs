//! DOCX for Word and LibreOffice: ECMA-376, the parts that a text with formulas, tables and pictures needs. Headings are styles of the program, so that a list of
//! contents can be made of them; formulas are formulas (OMML), each with its number at the right edge.

mod package;

use super::fit;
use super::paper::{self, Paper, Walk, paragraphs};
use super::{Format, Holds, Package, Page, Pictures, RASTER, Sheet};
use crate::document::{Content, Document, Download, Formula, Front, Inline, Rich};
use crate::escape::markup;
use crate::formula::Form;
use crate::table::{Cell, Table};
use crate::wording::Word;
use words::Language;

/// The row of the table.
pub const FORMAT: Format = Format {
    name: "docx",
    extension: "docx",
    help: ("for Word or LibreOffice, formulas to go on with", "для Word или LibreOffice, формулы можно править"),
    holds: Holds::Page(Page { write, pictures: Pictures::Packed(Package { drawing: RASTER, pack: package::pack }), press: None }),
};

/// Twentieths of a point between the margins.
const TWIPS: u64 = 9354;
/// The same for the number of a formula.
const NUMBER: u64 = 900;

/// The text of the document, `word/document.xml`.
pub fn write(document: &Document, sheet: &Sheet) -> String {
    let mut writer = Writer { out: String::new(), language: document.language, pictures: 0 };
    if !document.has_front() {
        writer.styled("Title", &run(&document.title, ""));
    }
    for paragraph in document.description.split('\n').filter(|p| !p.trim().is_empty()) {
        writer.paragraph(&paragraph.into());
    }
    Walk::new(document, sheet).blocks(&document.blocks, &mut writer);
    writer.styled("Footnote", &run(&paper::footer(document), ""));
    package::document(&writer.out)
}

struct Writer {
    out: String,
    language: Language,
    pictures: usize,
}

/// Words as a run with these properties.
fn run(words: &str, properties: &str) -> String {
    let properties = if properties.is_empty() { String::new() } else { format!("<w:rPr>{properties}</w:rPr>") };
    format!("<w:r>{properties}<w:t xml:space=\"preserve\">{}</w:t></w:r>", markup(words))
}

impl Paper for Writer {
    fn heading(&mut self, level: u8, text: &str) {
        self.styled(&format!("Heading{level}"), &run(text, ""));
    }

    fn paragraph(&mut self, content: &Rich) {
        for rich in paragraphs(content) {
            let text = self.rich(&rich);
            self.styled("", &text);
        }
    }

    fn equation(&mut self, formula: &Formula, number: Option<usize>) {
        let formula = Formula { width: None, ..formula.clone() }.write(Form::Omml);
        let Some(number) = number else { return self.styled("Formula", &formula) };
        let cell = |width: u64, content: &str| {
            format!("<w:tc><w:tcPr><w:tcW w:w=\"{width}\" w:type=\"dxa\"/><w:vAlign w:val=\"center\"/></w:tcPr>{content}</w:tc>")
        };
        let left = cell(TWIPS - NUMBER, &paragraph("Formula", &formula));
        let right = cell(NUMBER, &paragraph("FormulaNumber", &run(&format!("({number})"), "")));
        let grid = format!("<w:tblGrid><w:gridCol w:w=\"{}\"/><w:gridCol w:w=\"{NUMBER}\"/></w:tblGrid>", TWIPS - NUMBER);
        self.push(&format!(
            "<w:tbl><w:tblPr><w:tblW w:w=\"{TWIPS}\" w:type=\"dxa\"/><w:tblLayout w:type=\"fixed\"/></w:tblPr>{grid}<w:tr><w:trPr><w:cantSplit/></w:trPr>{left}{right}</w:tr></w:tbl>"
        ));
    }

    fn table(&mut self, table: &Table, caption: Option<(usize, &str)>) {
        if let Some(caption) = caption {
            self.styled("TableCaption", &run(&paper::caption(caption, 0, self.language), ""));
        }
        let columns = table.columns.len().max(1);
        let grid = format!("<w:gridCol w:w=\"{}\"/>", TWIPS / columns as u64).repeat(columns);
        let heads: Vec<String> = table.columns.iter().map(|column| cell("TableText", &self.rich(&fit::head(column)))).collect();
        let mut out = format!(
            "<w:tbl><w:tblPr><w:tblStyle w:val=\"Grid\"/><w:tblW w:w=\"5000\" w:type=\"pct\"/></w:tblPr><w:tblGrid>{grid}</w:tblGrid>\
             <w:tr><w:trPr><w:cantSplit/><w:tblHeader/></w:trPr>{}</w:tr>",
            heads.concat()
        );
        for row in &table.rows {
            let cells = (0..table.columns.len()).map(|i| self.cell(row.get(i).unwrap_or(&Cell::Empty)));
            out.push_str(&format!("<w:tr><w:trPr><w:cantSplit/></w:trPr>{}</w:tr>", cells.collect::<String>()));
        }
        self.push(&out);
        self.push("</w:tbl>");
        // two tables without a paragraph between would be one
        self.styled("TableEnd", "");
    }

    fn picture(&mut self, file: &str, caption: &Rich) {
        self.pictures += 1;
        let (id, words) = (self.pictures, markup(&caption.plain(self.language)));
        let drawing = package::drawing(id, file, &words);
        self.styled("Picture", &format!("<w:r>{drawing}</w:r>"));
        let caption = self.rich(caption);
        self.styled("FigureCaption", &caption);
    }

    fn files(&mut self, files: &[Download]) {
        for file in files.iter().filter(|f| matches!(f.content, Content::Beside)) {
            self.styled("", &run(&format!("{} – {}", file.name, file.label), ""));
        }
    }

    fn front(&mut self, front: &Front) {
        front.above.iter().for_each(|line| self.styled("FrontLine", &run(line, "")));
        self.styled("FrontKind", &run(&front.kind, ""));
        self.styled("FrontSubject", &run(&front.subject, ""));
        front.about.iter().for_each(|line| self.styled("FrontLine", &run(line, "")));
        for (role, name) in &front.people {
            let name = if name.is_empty() { "____________________" } else { name };
            self.styled("FrontPerson", &run(&format!("{role}: {name}"), ""));
        }
        self.styled("FrontBelow", &run(&front.below, ""));
        self.push("<w:p><w:r><w:br w:type=\"page\"/></w:r></w:p>");
    }

    fn contents(&mut self, headings: &[(u8, &str)]) {
        self.styled("ContentsTitle", &run(self.language.word(Word::Contents), ""));
        // the program fills in the pages; until then the headings stand there
        let field = |kind: &str| format!("<w:r><w:fldChar w:fldCharType=\"{kind}\"/></w:r>");
        let begin = format!(
            "{}<w:r><w:instrText xml:space=\"preserve\"> TOC \\o \"1-2\" \\h \\z </w:instrText></w:r>{}",
            field("begin"),
            field("separate")
        );
        for (i, (level, text)) in headings.iter().enumerate() {
            let lead = if i == 0 { begin.as_str() } else { "" };
            let end = if i + 1 == headings.len() { field("end") } else { String::new() };
            self.styled(&format!("TOC{level}"), &format!("{lead}{}{end}", run(text, "")));
        }
        self.push("<w:p><w:r><w:br w:type=\"page\"/></w:r></w:p>");
    }

    fn verbatim(&mut self, text: &str) {
        text.lines().for_each(|line| self.styled("Listing", &run(line, "")));
    }
}

/// A paragraph of a style.
fn paragraph(style: &str, content: &str) -> String {
    let style = if style.is_empty() { String::new() } else { format!("<w:pPr><w:pStyle w:val=\"{style}\"/></w:pPr>") };
    format!("<w:p>{style}{content}</w:p>")
}

fn cell(style: &str, content: &str) -> String {
    format!("<w:tc>{}</w:tc>", paragraph(style, content))
}

impl Writer {
    fn push(&mut self, text: &str) {
        self.out.push_str(text);
    }

    fn styled(&mut self, style: &str, content: &str) {
        let text = paragraph(style, content);
        self.push(&text);
    }

    fn rich(&self, rich: &Rich) -> String {
        let piece = |piece: &Inline| match piece {
            Inline::Words(words) => run(words, ""),
            Inline::Formula(formula) => Formula { placement: crate::formula::Placement::Inline, ..formula.clone() }.write(Form::Omml),
            Inline::Symbol(name) => crate::symbol::written(name, self.language, Form::Omml),
        };
        rich.0.iter().map(piece).collect()
    }

    fn cell(&self, found: &Cell) -> String {
        match found {
            Cell::Empty => cell("TableText", ""),
            Cell::Rich(rich) => {
                cell("TableText", &paragraphs(rich).iter().map(|r| self.rich(r)).collect::<Vec<_>>().join("<w:r><w:br/></w:r>"))
            }
            Cell::Verdict(found) => cell("TableText", &run(&super::text::verdict(*found, self.language), "")),
            Cell::Number(number) => cell("TableNumber", &run(number, "")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Block;

    #[test]
    fn no_character_of_the_user_is_markup() {
        let document = Document {
            language: Language::Ru,
            title: "<w:p> & \" маятник \u{1}".into(),
            description: String::new(),
            blocks: vec![Block::paragraph("a < b & c > d"), Block::Verbatim("x = \"<y>\"\n".into())],
            version: "0".into(),
            model_hash: String::new(),
        };
        let text = write(&document, &Sheet::default());
        assert!(text.contains("&lt;w:p&gt; &amp;") && text.contains("a &lt; b &amp; c &gt; d") && !text.contains('\u{1}'));
        assert_eq!(text.matches("<w:p>").count(), text.matches("</w:p>").count());
    }
}
