//! The blocks of a document as HTML.

use crate::document::{Block, Content, Document, Download, Front, Rich};
use crate::escape::{address, markup};
use crate::figure::bands::{self, Bands};
use crate::figure::{Field, Figure, Title, svg};
use crate::formats::text::{figure_summary, verdict};
use crate::formula::{Form, Formula};
use crate::scheme::{Moving, Scheme};
use crate::table::{Cell, Table, Verdict, split_number};
use crate::wording::Word;
use base64::Engine;
use words::Language;

/// Longest words of a cell that stay on one line.
const UNBROKEN: usize = 16;
/// How the MathML of a formula of several lines starts.
const BROKEN: &str = "<mtable displaystyle";

/// Writes blocks one behind the other and numbers them.
pub(super) struct Writer {
    pub out: String,
    language: Language,
    /// Headings that are listed; their places are numbered.
    headings: Vec<(u8, String)>,
    /// Lowest level of these.
    depth: u8,
    passed: usize,
    /// Figures that a script makes live, by their place in its data.
    live: usize,
    /// Moving pictures, by their place in the data of the script.
    played: usize,
    figures: usize,
    tables: usize,
    equations: usize,
}

impl Writer {
    pub fn new(document: &Document) -> Writer {
        let own = |(level, text): (u8, &str)| (level, text.to_owned());
        let listed: Vec<(u8, String)> = document.contents().into_iter().map(own).collect();
        let beside = if listed.is_empty() { beside(document) } else { Vec::new() };
        let (headings, depth) = if beside.is_empty() { (listed, 2) } else { (beside, 1) };
        Writer {
            depth,
            out: String::new(),
            language: document.language,
            headings,
            passed: 0,
            live: 0,
            played: 0,
            figures: 0,
            tables: 0,
            equations: 0,
        }
    }

    pub fn blocks(&mut self, blocks: &[Block]) {
        let mut rest = blocks;
        while let Some((first, others)) = rest.split_first() {
            let alike = rest.iter().take_while(|b| beside_one_another(b)).count();
            if alike < 2 {
                self.block(first);
                rest = others;
                continue;
            }
            // drawings without scales stay readable side by side on paper
            let drawings = rest[..alike].iter().all(|b| matches!(b, Block::Scheme(_)));
            self.push(if drawings { "<div class=\"figures drawings\">\n" } else { "<div class=\"figures\">\n" });
            rest[..alike].iter().for_each(|b| self.block(b));
            self.push("</div>\n");
            rest = &rest[alike..];
        }
    }

    /// The contents of a long page that has none itself, for the side of wide windows.
    pub fn side(&self, document: &Document) -> String {
        if self.depth != 1 {
            return String::new();
        }
        let line = |(i, (_, text)): (usize, &(u8, String))| format!("<li><a href=\"#heading-{}\">{}</a></li>\n", i + 1, markup(text));
        let lines: String = self.headings.iter().enumerate().map(line).collect();
        format!("<nav class=\"side\" aria-label=\"{}\"><ul>\n{lines}</ul></nav>\n", document.language.word(Word::Contents))
    }

    fn block(&mut self, block: &Block) {
        match block {
            Block::Heading { level, text } => {
                let place = self.place(*level);
                let level = (*level).clamp(1, 3) + 1;
                self.push(&format!("<h{level}{place}>{}</h{level}>\n", markup(text)));
            }
            Block::Paragraph(content) => self.push(&format!("<p>{}</p>\n", self.rich(content))),
            Block::Equation { formula, numbered } => {
                self.equations += usize::from(*numbered);
                self.equation(formula, numbered.then_some(self.equations));
            }
            Block::Table(table) => self.table(table),
            Block::Figure(figure) => self.figure(figure),
            Block::Bands(bands) => self.bands(bands),
            Block::Scheme(scheme) => self.scheme(scheme),
            Block::Moving(moving) => self.moving(moving),
            Block::Details { summary, blocks } => {
                self.push(&format!("<details>\n<summary>{}</summary>\n", markup(summary)));
                self.blocks(blocks);
                self.push("</details>\n");
            }
            Block::Downloads(files) => self.downloads(files),
            Block::Front(front) => self.front(front),
            Block::Contents => self.contents(),
            Block::Verbatim(text) => self.push(&format!("<pre class=\"file\">{}</pre>\n", markup(text))),
        }
    }

    /// The place of a heading that is listed.
    fn place(&mut self, level: u8) -> String {
        if self.headings.is_empty() || level > self.depth {
            return String::new();
        }
        self.passed += 1;
        format!(" id=\"heading-{}\"", self.passed)
    }

    fn contents(&mut self) {
        self.push(&format!("<nav class=\"contents\"><h2>{}</h2>\n<ul>\n", self.language.word(Word::Contents)));
        for (i, (level, text)) in std::mem::take(&mut self.headings).into_iter().enumerate() {
            self.push(&format!("<li class=\"level-{level}\"><a href=\"#heading-{}\">{}</a></li>\n", i + 1, markup(&text)));
            self.headings.push((level, text));
        }
        self.push("</ul></nav>\n");
    }

    fn front(&mut self, front: &Front) {
        let line = |text: &String| format!("<p>{}</p>\n", markup(text));
        let lines = |list: &[String]| list.iter().map(line).collect::<String>();
        let person = |(role, name): &(String, String)| format!("<dt>{}</dt><dd>{}</dd>\n", markup(role), markup(name));
        let people: String = front.people.iter().map(person).collect();
        let html = format!(
            "<section class=\"front\">\n<div class=\"above\">{}</div>\n<div class=\"what\"><h1>{}</h1>\n<p class=\"subject\">{}</p>\n{}</div>\n\
             <dl>{people}</dl>\n<p class=\"below\">{}</p>\n</section>\n",
            lines(&front.above),
            markup(&front.kind),
            markup(&front.subject),
            lines(&front.about),
            markup(&front.below),
        );
        self.push(&html);
    }

    fn push(&mut self, text: &str) {
        self.out.push_str(text);
    }

    fn equation(&mut self, formula: &Formula, number: Option<usize>) {
        let shown = formula.write(Form::MathMl);
        // the number stands at the last line of a broken formula
        let class = if shown.contains(BROKEN) { "equation long" } else { "equation" };
        self.push(&format!("<div class=\"{class}\"><div class=\"formula\">{shown}</div>"));
        if let Some(n) = number {
            self.push(&format!("<span class=\"no\" id=\"equation-{n}\">({n})</span>"));
        }
        self.push("</div>\n");
    }

    fn table(&mut self, table: &Table) {
        self.push("<div class=\"table\"><table>\n");
        if let Some(caption) = &table.caption {
            self.tables += 1;
            let (n, word) = (self.tables, self.language.word(Word::Table));
            self.push(&format!("<caption id=\"table-{n}\">{word}\u{a0}{n} – {}</caption>\n", markup(&caption.replace('/', "/\u{2060}"))));
        }
        let widths: Vec<Option<f64>> = (0..table.columns.len()).map(|i| decimals_width(table, i)).collect();
        self.push("<thead><tr>");
        for (column, width) in table.columns.iter().zip(&widths) {
            let class = if width.is_some() { " class=\"n\"" } else { "" };
            let unit = if column.unit.is_empty() { String::new() } else { format!(", {}", markup(&column.unit)) };
            self.push(&format!("<th scope=\"col\"{class}>{}{unit}</th>", self.rich(&column.head)));
        }
        self.push("</tr></thead>\n<tbody>\n");
        for row in &table.rows {
            self.push("<tr>");
            for (i, width) in widths.iter().enumerate() {
                let html = self.cell(row.get(i).unwrap_or(&Cell::Empty), width.unwrap_or(0.0));
                self.push(&html);
            }
            self.push("</tr>\n");
        }
        self.push("</tbody></table></div>\n");
    }

    /// A cell; the decimals of a number take the room of the longest of the column, so that the marks line up.
    fn cell(&self, cell: &Cell, decimals: f64) -> String {
        match cell {
            Cell::Empty => "<td></td>".into(),
            Cell::Rich(content) => {
                // a quantity or a unit is not torn apart
                let class = if content.plain(self.language).chars().count() <= UNBROKEN { " class=\"k\"" } else { "" };
                format!("<td{class}>{}</td>", self.rich(content))
            }
            Cell::Number(number) if decimals == 0.0 => format!("<td class=\"n\">{}</td>", markup(number)),
            Cell::Number(number) => {
                let (whole, rest) = split_number(number);
                let (whole, rest) = (markup(whole), markup(rest));
                format!("<td class=\"n\">{whole}<span class=\"d\" style=\"min-width:{decimals:.2}ch\">{rest}</span></td>")
            }
            Cell::Verdict(found) => {
                let class = match found {
                    Verdict::Passed => "ok",
                    Verdict::Failed => "bad",
                };
                format!("<td class=\"{class}\">{}</td>", verdict(*found, self.language))
            }
        }
    }

    /// The static picture, a place for the interactive one, caption, tools.
    fn figure(&mut self, figure: &Figure) {
        if let Some(field) = &figure.field {
            return self.field(figure, field);
        }
        let i = self.live;
        self.live += 1;
        self.figures += 1;
        let n = self.figures;
        let word = |w| self.language.word(w);
        let summary = figure_summary(figure, self.language);
        let summary: Vec<&str> = summary.lines().map(str::trim).collect();
        let html = format!(
            "<figure id=\"figure-{n}\" data-figure=\"{i}\">\n<div class=\"live\" hidden></div>\n<div class=\"still\">{}</div>\n\
             <figcaption>{}\u{a0}{n} – {}</figcaption>\n<p class=\"summary\" id=\"summary-{n}\">{}</p>\n\
             <div class=\"tools\" hidden></div>\n<details class=\"data\" hidden><summary>{}</summary></details>\n</figure>\n",
            svg::write(figure, Title::Caption, self.language),
            word(Word::Figure),
            self.rich(&figure.title),
            markup(&summary.join("; ")),
            word(Word::ShowData),
        );
        self.push(&html);
    }

    /// A filled plane: a picture in which a place can be clicked.
    fn field(&mut self, figure: &Figure, field: &Field) {
        self.figures += 1;
        let n = self.figures;
        let summary = figure_summary(figure, self.language);
        let summary: Vec<&str> = summary.lines().map(str::trim).collect();
        let pick = &field.pick;
        let data = serde_json::json!({
            "area": svg::area(figure, Title::Caption, self.language), "ends": field.ends, "names": pick.names, "units": pick.units,
            "command": pick.command, "copied": self.language.word(Word::Copied),
        });
        let html = format!(
            "<figure id=\"figure-{n}\" data-field=\"{}\">\n<div class=\"still\">{}</div>\n<figcaption>{}\u{a0}{n} – {}</figcaption>\n\
             <p class=\"summary\">{}</p>\n<p class=\"pick\" hidden>{}</p>\n<output class=\"picked\" hidden></output>\n</figure>\n",
            markup(&data.to_string()),
            svg::write(figure, Title::Caption, self.language),
            self.language.word(Word::Figure),
            self.rich(&figure.title),
            markup(&summary.join("; ")),
            self.language.word(Word::PickHelp),
        );
        self.push(&html);
    }

    /// A static picture of strips with its caption, and the same in words.
    fn bands(&mut self, bands: &Bands) {
        self.figures += 1;
        let n = self.figures;
        let summary = bands.summary(self.language);
        let summary: Vec<&str> = summary.lines().map(str::trim).collect();
        let html = format!(
            "<figure id=\"figure-{n}\">\n<div class=\"still\">{}</div>\n<figcaption>{}\u{a0}{n} – {}</figcaption>\n<p class=\"summary\">{}</p>\n</figure>\n",
            bands::write(bands, Title::Caption, self.language),
            self.language.word(Word::Figure),
            self.rich(&bands.title),
            markup(&summary.join("; ")),
        );
        self.push(&html);
    }

    /// The machine with its caption; lines take the colour of the page.
    fn scheme(&mut self, scheme: &Scheme) {
        self.figures += 1;
        let n = self.figures;
        let html = format!(
            "<figure id=\"figure-{n}\" class=\"drawing\">\n{}<figcaption>{}\u{a0}{n} – {}</figcaption>\n<p class=\"summary\">{}</p>\n</figure>\n",
            scheme.svg(self.language),
            self.language.word(Word::Figure),
            self.rich(&scheme.title),
            markup(&scheme.told()),
        );
        self.push(&html);
    }

    /// A picture that a script plays; without one, and in print, the scheme says the same.
    fn moving(&mut self, moving: &Moving) {
        let i = self.played;
        self.played += 1;
        let class = if moving.rest { "drawing moving shape" } else { "drawing moving" };
        let html = format!(
            "<figure class=\"{class}\" data-moving=\"{i}\">\n{}<div class=\"player\"></div>\n<figcaption>{}</figcaption>\n</figure>\n",
            moving.svg(self.language),
            self.rich(moving.title()),
        );
        self.push(&html);
    }

    /// Words with formulas and symbols as HTML.
    fn rich(&self, content: &Rich) -> String {
        content.write(Form::MathMl, self.language, (markup, |formula| formula))
    }

    fn downloads(&mut self, files: &[Download]) {
        self.push("<ul class=\"files\">\n");
        for file in files {
            let name = markup(&file.name);
            let target = match &file.content {
                Content::Beside => address(&file.name),
                Content::Inside { media, bytes } => {
                    format!("data:{};base64,{}", markup(media), base64::engine::general_purpose::STANDARD.encode(bytes))
                }
            };
            self.push(&format!("<li><a href=\"{target}\" download=\"{name}\">{name}</a> {}</li>\n", markup(&file.label)));
        }
        self.push("</ul>\n");
    }
}

/// Headings of a page from which it is long enough to list them.
const LONG: usize = 5;

/// The headings of a long page that does not list them itself.
fn beside(document: &Document) -> Vec<(u8, String)> {
    let heading = |b: &Block| if let Block::Heading { level: 1, text } = b { Some((1, text.clone())) } else { None };
    let list: Vec<(u8, String)> = document.blocks.iter().filter_map(heading).collect();
    if list.len() >= LONG { list } else { Vec::new() }
}

/// Plots, and shapes of small motions: those that follow one another stand side by side where there is room.
fn beside_one_another(block: &Block) -> bool {
    match block {
        Block::Figure(_) | Block::Scheme(_) => true,
        Block::Moving(moving) => moving.rest,
        _ => false,
    }
}

/// Room of the longest decimals of a column, in widths of a digit; none for a column without numbers.
fn decimals_width(table: &Table, i_column: usize) -> Option<f64> {
    let width = |c: char| match c {
        '0'..='9' => 1.0,
        '⁰'..='⁹' | '¹' | '²' | '³' | '⁻' => 0.68,
        _ => 0.55,
    };
    let numbers = table.rows.iter().filter_map(|row| match row.get(i_column) {
        Some(Cell::Number(number)) => Some(split_number(number).1.chars().map(width).sum::<f64>()),
        _ => None,
    });
    numbers.reduce(f64::max)
}
