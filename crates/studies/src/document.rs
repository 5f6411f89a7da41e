//! The written calculation of a machine: title, coordinates, equations, checks, results. It arranges what was computed and computes
//! nothing itself.

use crate::calculation::Calculation;
use crate::results::{Extent, Results, View};
use crate::sections::Drawings;
use crate::wording::{Word as Say, say};
use analysis::Dataset;
use analysis::dataset::Audit;
use report::document::{Content, Formula, Inline, Rich};
use report::formula::{Layout, Printer, Sign};
use report::table::{Column, Verdict};
use report::{Block, Cell, Document, Download, Table, Word};
use symbolic::connections::{Law, Reaction};
use symbolic::{Equations, Expr};
use words::Language;

/// Significant digits of numbers in tables.
const DIGITS: usize = 4;

/// The document of a calculation.
pub fn compose(calculation: &Calculation, (extent, language): (Extent, Language), setting: &Setting) -> Document {
    let writer = Writer { calculation, equations: &calculation.machine.equations, extent, language, setting };
    let sections = &calculation.machine.model.sections;
    // sections alone have no motion
    let machine = sections.is_empty() || !writer.equations.coordinates.is_empty();
    let scheme = if extent == Extent::Page { crate::scheme::figure(&calculation.machine, language) } else { None };
    let mut blocks: Vec<Block> = scheme.into_iter().collect();
    if machine {
        blocks.extend(writer.coordinates());
    }
    if machine {
        blocks.extend(writer.equations());
    }
    if extent == Extent::Page {
        blocks.extend(writer.derivation());
        blocks.extend(writer.parameters());
    }
    blocks.extend(writer.checks());
    for results in &calculation.results {
        blocks.extend(writer.result(results));
    }
    blocks.extend(crate::sections::blocks(sections, if extent == Extent::Page { Drawings::Shown } else { Drawings::LeftOut }, language));
    if extent == Extent::Page {
        blocks.extend(writer.downloads());
    }
    let model = &calculation.machine.model;
    let description = if extent == Extent::Page { language.text(&model.description).into() } else { String::new() };
    Document {
        language,
        title: language.text(&model.title).into(),
        description,
        blocks,
        version: crate::provenance::VERSION.into(),
        model_hash: calculation.machine.model_hash.clone(),
    }
}

/// How formulas of a page are set.
pub struct Setting<'a> {
    /// Expressions with the signs that all motions keep.
    pub signs: Vec<(Expr, Sign)>,
    /// A formula of the derivation, with the indices of its bodies and springs.
    pub step: &'a dyn Fn(&symbolic::equations::StepFormula) -> Layout,
}

struct Writer<'a> {
    calculation: &'a Calculation,
    equations: &'a Equations,
    extent: Extent,
    language: Language,
    setting: &'a Setting<'a>,
}

impl Writer<'_> {
    fn word(&self, word: Word) -> &'static str {
        self.language.word(word)
    }

    /// A table; in the terminal its heading is enough of a caption.
    fn table(&self, table: Table, caption: Word) -> Block {
        Block::Table(if self.extent == Extent::Page { table.with_caption(self.word(caption)) } else { table })
    }

    fn heading(&self, word: Word) -> Block {
        Block::heading(1, self.word(word))
    }

    fn printer(&self) -> Printer {
        let width = match self.extent {
            Extent::Page => self.view().width(),
            // the number of the equation stands behind it
            Extent::Terminal { width } => width.saturating_sub(8),
        };
        let printer = Printer::of(self.equations, self.language).with_width(width);
        match self.extent {
            // a page knows the signs that the motions keep, as the written calculation does
            Extent::Page => printer.with_signs(self.setting.signs.clone()),
            Extent::Terminal { .. } => printer,
        }
    }

    fn coordinates(&self) -> Vec<Block> {
        let language = self.language;
        let coordinates = &self.equations.coordinates;
        let mut pieces = vec![Inline::Words(format!("{}: {}. ", self.word(Word::DegreesOfFreedom), self.equations.degrees_of_freedom()))];
        if coordinates.is_empty() {
            return vec![Block::Paragraph(Rich(pieces))];
        }
        pieces.push(Inline::Words(format!("{}: ", self.coordinates_are())));
        let printer = self.printer();
        for (i, coordinate) in coordinates.iter().enumerate() {
            let symbol = self.symbol(&printer, coordinate.symbols[0]);
            pieces.push(Inline::Words(if i == 0 { String::new() } else { "; ".into() }));
            pieces.push(Inline::Formula(symbol));
            let label = language.text(&coordinate.label);
            let unit = report::unit::print(&coordinate.unit, language);
            let words = [label, &unit].into_iter().filter(|w| !w.is_empty()).collect::<Vec<_>>().join(", ");
            pieces.push(Inline::Words(if words.is_empty() { words } else { format!(" ({words})") }));
        }
        pieces.push(Inline::Words(".".into()));
        vec![Block::Paragraph(Rich(pieces))]
    }

    /// Generalized coordinates are independent; those that connections tie are coordinates with equations.
    fn coordinates_are(&self) -> String {
        let n = self.equations.coordinates.len();
        let tied = n - self.equations.degrees_of_freedom().min(n);
        if tied == 0 {
            return self.word(Word::Coordinates).to_owned();
        }
        self.language.pick(
            format!("Coordinates ({n}, tied by connections; equations of these: {tied})"),
            format!("Координаты ({n}, подчинены связям; уравнений связей: {tied})"),
        )
    }

    fn symbol(&self, printer: &Printer, symbol: symbolic::SymbolId) -> Formula {
        Formula::inline(printer.symbol_layout(&self.equations.graph, symbol))
    }

    fn equations(&self) -> Vec<Block> {
        let printer = self.printer();
        let graph = &self.equations.graph;
        let nothing_moves = self.equations.coordinates.is_empty() && self.equations.reactions.is_empty();
        if nothing_moves {
            return Vec::new();
        }
        let none = self.equations.coordinates.is_empty();
        let mut blocks = if none { Vec::new() } else { vec![self.heading(Word::Equations)] };
        match &self.equations.textbook {
            Err(reason) => blocks.push(Block::paragraph(self.language.text(reason))),
            Ok(equalities) => {
                for (i, equality) in equalities.iter().enumerate() {
                    let formula = printer.block(printer.equality_layout(graph, *equality, Some(i)));
                    blocks.push(Block::Equation { formula, numbered: true });
                }
            }
        }
        blocks.extend(self.connections(&printer));
        let definitions = definitions(self.equations, &printer);
        blocks.extend((!definitions.is_empty()).then(|| Block::paragraph(say(self.language, Say::WhereText))));
        blocks.extend(definitions.into_iter().map(|layout| unnumbered(&printer, layout)));
        blocks
    }

    /// What the connections demand, and what the letters of their reactions mean.
    fn connections(&self, printer: &Printer) -> Vec<Block> {
        let conditions = conditions(self.equations, printer);
        let mut blocks = Vec::new();
        blocks.extend((!conditions.is_empty()).then(|| Block::paragraph(say(self.language, Say::Connections))));
        for (layout, when) in conditions.into_iter().zip(holding(self.equations, self.language)) {
            blocks.extend(when.map(|words| Block::paragraph(format!("{words}:"))));
            blocks.push(unnumbered(printer, layout));
        }
        let laws = crate::frictions::laws(self.equations, printer);
        blocks.extend((!laws.is_empty()).then(|| Block::paragraph(say(self.language, Say::FrictionLaws))));
        blocks.extend(laws.into_iter().map(|layout| unnumbered(printer, layout)));
        blocks.extend(self.reactions(printer));
        blocks
    }

    /// What the letters of reactions mean: first those of the equations, then those that only the released bodies give.
    fn reactions(&self, printer: &Printer) -> Vec<Block> {
        let graph = &self.equations.graph;
        let shown = self.equations.textbook.iter().flatten().flat_map(|e| [e.left, e.right]).collect::<Vec<_>>();
        let occurring = graph.symbols_in(&shown);
        let reactions = self.equations.reactions.iter().filter(|r| r.law.is_reaction());
        let (inside, outside): (Vec<_>, Vec<_>) = reactions.partition(|r| occurring.binary_search(&r.symbol).is_ok());
        let found = match (inside.is_empty(), self.equations.coordinates.is_empty()) {
            (_, true) => Say::Reactions,
            (true, _) => Say::ReactionsReleased,
            (false, _) => Say::OtherReactions,
        };
        let lists = [(Say::Reactions, inside), (found, outside)];
        lists.into_iter().filter(|(_, list)| !list.is_empty()).map(|(word, list)| self.named_reactions(printer, word, &list)).collect()
    }

    fn named_reactions(&self, printer: &Printer, word: Say, list: &[&Reaction]) -> Block {
        let mut pieces = Vec::new();
        for (i, reaction) in list.iter().enumerate() {
            let before = if i == 0 { format!("{}: ", say(self.language, word)) } else { "; ".into() };
            pieces.push(Inline::Words(before));
            pieces.push(Inline::Formula(self.symbol(printer, reaction.symbol)));
            pieces.push(Inline::Words(format!(" – {}", self.language.text(&reaction.label))));
            if let Some(result) = self.result_of(printer, reaction) {
                pieces.push(Inline::Words(self.language.pick(" (in results ", " (в результатах ").to_owned()));
                pieces.push(Inline::Formula(result));
                pieces.push(Inline::Words(")".into()));
            }
        }
        pieces.push(Inline::Words(".".into()));
        Block::Paragraph(Rich(pieces))
    }

    /// The output that is this reaction by itself, where it is printed with another letter.
    fn result_of(&self, printer: &Printer, reaction: &Reaction) -> Option<Formula> {
        let graph = &self.equations.graph;
        let is = |o: &&symbolic::equations::Output| matches!(graph.node(o.formula), symbolic::Node::Symbol(s) if *s == reaction.symbol);
        let output = self.equations.outputs.iter().find(is)?;
        let name = &output.name;
        let shown = self.equations.notation.iter().find(|(n, _)| n == name).map_or(name, |(_, symbol)| symbol);
        let written = Formula::inline(Layout::Symbol(printer.named(shown)));
        let own = self.symbol(printer, reaction.symbol);
        (written.text() != own.text()).then_some(written)
    }

    fn derivation(&self) -> Vec<Block> {
        if self.equations.steps.is_empty() || self.equations.coordinates.is_empty() {
            return Vec::new();
        }
        vec![Block::Details { summary: self.word(Word::Derivation).into(), blocks: self.steps() }]
    }

    /// The derivation step by step; bodies and springs have the indices of the written calculation.
    fn steps(&self) -> Vec<Block> {
        let (printer, step) = (self.printer(), self.setting.step);
        let mut blocks = Vec::new();
        for part in &self.equations.steps {
            blocks.push(Block::heading(3, self.language.text(&part.title)));
            let words = self.language.text(&part.words);
            if !words.is_empty() {
                blocks.push(Block::paragraph(words));
            }
            blocks.extend(part.formulas.iter().map(|formula| unnumbered(&printer, step(formula))));
        }
        blocks
    }

    fn parameters(&self) -> Vec<Block> {
        let table = parameters(self.equations, self.language);
        table.map_or_else(Vec::new, |table| vec![self.heading(Word::Parameters), self.table(table, Word::Parameters)])
    }

    fn checks(&self) -> Vec<Block> {
        let audits = self.calculation.audits();
        if audits.is_empty() {
            return Vec::new();
        }
        if self.extent != Extent::Page {
            // whole lines, since a table would be cut at the width of the terminal
            let lines: Vec<String> = audits.iter().map(|a| self.check(a)).collect();
            return vec![self.heading(Word::Checks), Block::paragraph(lines.join("\n"))];
        }
        let heads = [Word::Check, Word::Value, Word::Limit, Word::Verdict];
        let mut table = Table::new(heads.map(|w| Column::new(self.word(w))).into());
        for audit in audits {
            table.row(vec![
                Cell::words(self.language.text(&audit.name)),
                Cell::number(audit.value, 2, self.language),
                Cell::number(audit.limit, 2, self.language),
                Cell::Verdict(Verdict::of(audit)),
            ]);
        }
        vec![self.heading(Word::Checks), self.table(table, Word::Checks)]
    }

    fn check(&self, audit: &Audit) -> String {
        let number = |x| report::number::short(x, 2, self.language);
        let verdict = report::terminal::verdict(Verdict::of(audit), self.language);
        let (value, limit) = (number(audit.value), number(audit.limit));
        format!("{verdict}: {}: {value} ({} {limit})", self.language.text(&audit.name), self.word(Word::Limit).to_lowercase())
    }

    fn result(&self, results: &Results) -> Vec<Block> {
        let mut blocks = results.told(&self.view());
        if self.extent == Extent::Page {
            let played = crate::scheme::played(&self.calculation.machine, results, self.language);
            let place = blocks.iter().position(|b| matches!(b, Block::Figure(_) | Block::Bands(_))).unwrap_or(blocks.len());
            blocks.splice(place..place, played.into_iter().map(Block::Moving));
        }
        if results.tells_work() {
            blocks.extend(self.counters(&results.data));
        }
        blocks
    }

    fn view(&self) -> View<'_> {
        View { equations: self.equations, extent: self.extent, language: self.language }
    }

    fn counters(&self, data: &Dataset) -> Vec<Block> {
        let number = |x: f64| report::number::short(x, DIGITS, self.language);
        let counters = data.counters.iter().map(|c| format!("{}: {}", self.language.text(&c.name), number(c.value)));
        let words = counters.collect::<Vec<_>>().join(", ");
        if words.is_empty() { Vec::new() } else { vec![Block::paragraph(format!("{}: {words}.", self.word(Word::Counters)))] }
    }

    fn downloads(&self) -> Vec<Block> {
        let files = &self.calculation.files;
        if files.is_empty() {
            return Vec::new();
        }
        let download = |(name, label): &(String, words::Text)| Download {
            name: name.clone(),
            label: self.language.text(label).into(),
            content: Content::Beside,
        };
        vec![self.heading(Word::Downloads), Block::Downloads(files.iter().map(download).collect())]
    }
}

/// Blocks as text for a terminal, below the title of the machine.
pub fn in_terminal(title: &str, blocks: Vec<Block>, language: Language, width: usize) -> String {
    let none = String::new;
    let document = Document { language, title: title.into(), description: none(), blocks, version: none(), model_hash: none() };
    report::terminal::write(&document, width)
}

/// Every parameter with its number; none where there are none.
pub fn parameters(equations: &Equations, language: Language) -> Option<Table> {
    if equations.parameters.is_empty() {
        return None;
    }
    let heads = [Word::Symbol, Word::Written, Word::ValueSi, Word::Unit, Word::Description];
    let mut table = Table::new(heads.map(|w| Column::new(language.word(w))).into());
    let printer = Printer::of(equations, language);
    for p in &equations.parameters {
        table.row(vec![
            Cell::Rich(Rich::formula(Formula::inline(printer.symbol_layout(&equations.graph, p.symbol)))),
            Cell::words(written(&p.written, language)),
            Cell::number(p.value, 6, language),
            Cell::words(report::unit::print(&p.unit, language)),
            Cell::words(language.text(&p.label)),
        ]);
    }
    Some(table)
}

/// What stands behind "where": definitions, and the rates of prescribed turning angles, ψ' = ω. Nothing when the equations are not shown.
pub fn definitions(equations: &Equations, printer: &Printer) -> Vec<Layout> {
    named_definitions(equations, printer).into_iter().map(|(_, layout)| layout).collect()
}

/// The same with the symbols that are defined.
pub fn named_definitions(equations: &Equations, printer: &Printer) -> Vec<(symbolic::SymbolId, Layout)> {
    let Ok(shown_equations) = &equations.textbook else { return Vec::new() };
    let graph = &equations.graph;
    let sides: Vec<symbolic::Expr> = shown_equations.iter().flat_map(|e| [e.left, e.right]).collect();
    let occurring = graph.symbols_in(&sides);
    let shown = equations.definitions.iter().filter(|d| d.shown);
    let mut out: Vec<_> = shown.map(|d| (d.symbol, printer.definition(graph, d.symbol, d.formula))).collect();
    let turning: Vec<_> = equations.auxiliaries.iter().filter(|a| occurring.binary_search(&a.symbol).is_ok()).collect();
    if !turning.is_empty() {
        // the symbol of the rate is made for print only
        let mut graph = graph.clone();
        for a in turning {
            let name = graph.symbol_info(a.symbol).name.clone();
            let rate = graph.symbol_id(&name, 1);
            out.push((rate, printer.definition(&graph, rate, a.rate)));
        }
    }
    out
}

/// The conditions of connections, `... = 0`: on positions where they exist, else on rates. Those of frictions, which hold only at rest, stand with
/// their laws. Nothing when the equations are not shown.
pub fn conditions(equations: &Equations, printer: &Printer) -> Vec<Layout> {
    if equations.textbook.is_err() {
        return Vec::new();
    }
    let mut graph = equations.graph.clone();
    let right = graph.zero();
    let write = |c: &symbolic::connections::Condition| {
        let equality = symbolic::equations::Equality { left: c.place.unwrap_or(c.rate), right };
        printer.equality_layout(&graph, equality, None)
    };
    equations.conditions.iter().filter(|c| !rubs(equations, c)).map(write).collect()
}

/// Whether a condition holds only while a friction sticks.
fn rubs(equations: &Equations, condition: &symbolic::connections::Condition) -> bool {
    condition.reaction.is_some_and(|r| matches!(equations.reactions[r].law, Law::Friction(_)))
}

/// When a condition holds, if not always: "while the stop `floor` is closed". One for each of [`conditions`].
pub fn holding(equations: &Equations, language: Language) -> Vec<Option<String>> {
    let one = |c: &symbolic::connections::Condition| {
        let Some(reaction) = c.reaction.map(|r| &equations.reactions[r]) else {
            return Some(language.text(&c.name).to_owned());
        };
        // "rope S1, tension": what holds is the rope
        let name = language.text(&reaction.label).split(',').next().unwrap_or_default();
        match reaction.law {
            Law::Contact { tie: true, .. } => Some(format!("{name}, {}", language.pick("while it is taut", "пока канат натянут"))),
            Law::Contact { .. } => Some(format!("{name}, {}", language.pick("while it is closed", "пока контакт замкнут"))),
            _ => None,
        }
    };
    equations.conditions.iter().filter(|c| !rubs(equations, c)).map(one).collect()
}

fn unnumbered(printer: &Printer, layout: Layout) -> Block {
    Block::Equation { formula: printer.block(layout), numbered: false }
}

/// Energies of the machine, named.
pub fn energies(equations: &Equations) -> [(Say, &'static str, Expr); 3] {
    let e = &equations.energy;
    [(Say::KineticEnergy, "T", e.kinetic), (Say::PotentialEnergy, "Π", e.potential), (Say::DissipationFunction, "Φ", e.dissipation)]
}

/// A quantity as the user wrote it, with the decimal mark of the language.
fn written(text: &str, language: Language) -> String {
    let number = text.split_whitespace().next().unwrap_or("");
    let (from, to) = language.pick((',', "."), ('.', ","));
    if number.parse::<f64>().is_ok() || number.replacen(',', ".", 1).parse::<f64>().is_ok() {
        let unit = text.trim_start()[number.len()..].trim();
        let number = with_power(&number.replacen(from, to, 1)).replacen('-', "−", 1);
        // the same unit in the letters of the language
        let unit = if unit.is_ascii() && language == Language::Ru { report::unit::print(unit, language) } else { unit.to_owned() };
        let space = if unit.starts_with(['°', '′', '″']) { "" } else { " " };
        return format!("{number}{space}{unit}").trim_end().to_owned();
    }
    if text.is_empty() { "–".into() } else { text.to_owned() }
}

/// `2e11` as `2·10¹¹`.
fn with_power(number: &str) -> String {
    match number.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => format!("{mantissa}·10{}", report::number::superscript(exponent.trim_start_matches('+'))),
        None => number.to_owned(),
    }
}
