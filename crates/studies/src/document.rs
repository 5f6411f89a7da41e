//! The written calculation of a machine: title, coordinates, equations, checks, results. It arranges what was computed and computes
//! nothing itself.

use crate::pipeline::{Calculation, Finding, Phases};
use crate::simulate::Simulate;
use crate::wording::{Word as Say, say};
use analysis::Dataset;
use analysis::dataset::{Audit, Event, Extreme};
use mechanics::model::Plot;
use report::document::{Content, Formula, Inline, Rich};
use report::formula::{Layout, Printer};
use report::table::Column;
use report::{Block, Cell, Document, Download, Figure, Table, Word};
use symbolic::connections::{Law, Reaction};
use symbolic::equations::Role;
use symbolic::{Equations, Expr};
use words::Language;

/// Significant digits of numbers in tables.
const DIGITS: usize = 4;
/// Rows of events that are listed.
const EVENTS: usize = 50;
/// Width of a formula on the page, in characters of its text form.
const PAGE_WIDTH: usize = 90;

/// How much a document says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Everything: for the page.
    Page,
    /// What fits a terminal of a width: no parameters, no derivation, no plots.
    Terminal {
        /// Characters on a line.
        width: usize,
    },
}

/// The document of a calculation.
pub fn compose(calculation: &Calculation, extent: Extent, language: Language) -> Document {
    let writer = Writer { calculation, equations: &calculation.machine.equations, extent, language };
    let sections = &calculation.machine.model.sections;
    // sections alone have no motion
    let machine = sections.is_empty() || !writer.equations.coordinates.is_empty();
    let mut blocks = if machine { writer.coordinates() } else { Vec::new() };
    if machine {
        blocks.extend(writer.equations());
    }
    if extent == Extent::Page {
        blocks.extend(writer.derivation());
        blocks.extend(writer.parameters());
    }
    blocks.extend(writer.checks());
    for finding in &calculation.findings {
        blocks.extend(writer.finding(finding));
    }
    blocks.extend(crate::sections::blocks(sections, extent == Extent::Page, language));
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
        version: crate::VERSION.into(),
        model_hash: calculation.machine.model_hash.clone(),
    }
}

/// A printer of formulas in the user's symbols.
pub fn printer(equations: &Equations, language: Language, width: usize) -> Printer {
    Printer::of(equations, language).with_width(width)
}

/// Figures of a simulation: those the file asks for, otherwise one per coordinate. Their names differ.
pub fn figures(calculation: &Calculation, study: &Simulate, data: &Dataset, language: Language) -> Vec<Figure> {
    if study.plots.is_empty() {
        let coordinates = calculation.machine.equations.outputs.iter().filter(|o| o.role == Role::Coordinate);
        distinct(coordinates.filter_map(|o| Figure::over_axis(data, &[&o.name], language)).collect())
    } else {
        plots(&study.plots, data, language)
    }
}

/// Figures that a study asks for. Their names differ.
pub fn plots(plots: &[Plot], data: &Dataset, language: Language) -> Vec<Figure> {
    distinct(plots.iter().filter_map(|plot| figure(plot, data, language)).collect())
}

fn distinct(mut figures: Vec<Figure>) -> Vec<Figure> {
    for i in 1..figures.len() {
        let (before, rest) = figures.split_at_mut(i);
        if before.iter().any(|f| f.name == rest[0].name) {
            rest[0].name = format!("{}-{}", rest[0].name, i + 1);
        }
    }
    figures
}

/// Figures of findings other than motions.
pub fn other_figures(finding: &Finding, language: Language) -> Vec<Figure> {
    match finding {
        Finding::Structure(found) => crate::structure::figures(found, language),
        Finding::Response(found) => crate::small::show::response_figures(found, language),
        Finding::Study(results) => results.figures(language),
        Finding::Modes(found) => {
            let orders = found.found.as_ref().and_then(|f| f.tracks.as_ref()).map_or(&[][..], |t| &t.orders);
            crate::small::show::campbell(&found.data, orders, language).into_iter().collect()
        }
        _ => Vec::new(),
    }
}

fn figure(plot: &Plot, data: &Dataset, language: Language) -> Option<Figure> {
    let names: Vec<&str> = plot.y.iter().map(String::as_str).collect();
    let mut figure = match plot.x.as_deref() {
        None | Some("t") => Figure::over_axis(data, &names, language)?,
        Some(x) => {
            let mut figure = Figure::in_plane(data, x, &names, language)?;
            figure.name = format!("{}-{}", report::escape::file_name(&x.replace('\'', "_rate")), figure.name);
            figure
        }
    };
    let title = language.text(&plot.title);
    if !title.is_empty() {
        figure.title = title.into();
    }
    Some(figure)
}

struct Writer<'a> {
    calculation: &'a Calculation,
    equations: &'a Equations,
    extent: Extent,
    language: Language,
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
            Extent::Page => PAGE_WIDTH,
            // the number of the equation stands behind it
            Extent::Terminal { width } => width.saturating_sub(8),
        };
        printer(self.equations, self.language, width)
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
        vec![Block::Details { summary: self.word(Word::Derivation).into(), blocks: steps(self.equations, &self.printer(), self.language) }]
    }

    fn parameters(&self) -> Vec<Block> {
        let language = self.language;
        if self.equations.parameters.is_empty() {
            return Vec::new();
        }
        let heads = [Word::Symbol, Word::Written, Word::ValueSi, Word::Unit, Word::Description];
        let mut table = Table::new(heads.map(|w| Column::new(self.word(w))).into());
        let printer = self.printer();
        for p in &self.equations.parameters {
            table.row(vec![
                Cell::Rich(Rich::formula(self.symbol(&printer, p.symbol))),
                Cell::words(written(&p.written, language)),
                Cell::number(p.value, 6, language),
                Cell::words(report::unit::print(&p.unit, language)),
                Cell::words(language.text(&p.label)),
            ]);
        }
        vec![self.heading(Word::Parameters), self.table(table, Word::Parameters)]
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
                Cell::Verdict(audit.ok),
            ]);
        }
        vec![self.heading(Word::Checks), self.table(table, Word::Checks)]
    }

    fn check(&self, audit: &Audit) -> String {
        let number = |x| report::number::short(x, 2, self.language);
        let verdict = report::terminal::verdict(audit.ok, self.language);
        let (value, limit) = (number(audit.value), number(audit.limit));
        format!("{verdict}: {}: {value} ({} {limit})", self.language.text(&audit.name), self.word(Word::Limit).to_lowercase())
    }

    fn finding(&self, finding: &Finding) -> Vec<Block> {
        match finding {
            Finding::Equilibrium(data, _) => {
                let mut blocks = vec![self.heading(Word::Equilibrium)];
                if !data.columns.is_empty() {
                    blocks.push(self.table(equilibria(data, self.language), Word::Equilibrium));
                }
                blocks.extend(self.notes(data));
                blocks
            }
            Finding::Structure(found) => {
                let heading = crate::structure::heading(found, self.language);
                let mut blocks = vec![Block::heading(1, heading)];
                blocks.extend(crate::structure::blocks(found, self.language, self.extent == Extent::Page));
                blocks
            }
            Finding::Study(results) => {
                let mut blocks = of_results(results, self.extent == Extent::Page, self.language);
                if self.extent == Extent::Page {
                    blocks.extend(results.figures(self.language).into_iter().map(Block::Figure));
                }
                blocks.extend(self.counters(&results.data));
                blocks
            }
            Finding::Response(found) => {
                let mut blocks = vec![Block::heading(1, say(self.language, Say::Response))];
                blocks.extend(crate::small::show::response(found, self.language, self.extent == Extent::Page));
                blocks
            }
            Finding::Modes(found) => {
                let mut blocks = vec![Block::heading(1, say(self.language, Say::Modes))];
                blocks.extend(crate::small::show::modes(found, self.language, self.extent == Extent::Page));
                blocks
            }
            Finding::Motion(study, data, _) | Finding::Transient(study, data, ..) => {
                let mut blocks = vec![self.heading(Word::Simulation)];
                if let Finding::Transient(_, _, phases, _) = finding {
                    blocks = self.phases(phases);
                }
                blocks.push(self.table(results(data, self.language), Word::Results));
                blocks.extend(self.notes(data));
                blocks.extend(self.events(data));
                if self.extent == Extent::Page {
                    blocks.extend(figures(self.calculation, study, data, self.language).into_iter().map(Block::Figure));
                    blocks.extend(crate::contacts::bands(data, self.language).map(Block::Bands));
                }
                blocks.extend(self.counters(data));
                blocks
            }
        }
    }

    /// The written solution phase by phase.
    fn phases(&self, phases: &Phases) -> Vec<Block> {
        let width = match self.extent {
            Extent::Page => PAGE_WIDTH,
            Extent::Terminal { width } => width,
        };
        let mut blocks = vec![Block::heading(1, say(self.language, Say::ClosedForm))];
        blocks.extend(crate::phases::steps::blocks(self.equations, phases, self.language, width));
        blocks
    }

    fn notes(&self, data: &Dataset) -> Vec<Block> {
        notes(data, self.language)
    }

    fn events(&self, data: &Dataset) -> Vec<Block> {
        events(data, self.extent == Extent::Page, self.language)
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

/// Remarks beside a result.
fn notes(data: &Dataset, language: Language) -> Vec<Block> {
    data.notes.iter().map(|note| Block::paragraph(language.text(note))).collect()
}

/// What happened, and when.
fn events(data: &Dataset, captions: bool, language: Language) -> Vec<Block> {
    let mut blocks = named_events(data, captions, language);
    let switches: Vec<&Event> = data.events.iter().filter(|e| e.name.is_empty()).collect();
    if switches.is_empty() {
        return blocks;
    }
    let [time, event] = [Column::with_unit(language.word(Word::Time), "s", language), Column::new(language.word(Word::Event))];
    let listed = &switches[..switches.len().min(EVENTS)];
    // a terminal has no room for columns that say again what the words do
    let contacts = captions && listed.iter().any(|e| e.contact.is_some());
    let mut table = if contacts { crate::contacts::table(time, event, language) } else { Table::new(vec![time, event]) };
    let between = if contacts { crate::contacts::cells(listed, language) } else { vec![Vec::new(); listed.len()] };
    let times: Vec<f64> = listed.iter().map(|e| e.t).collect();
    for ((time, event), between) in Cell::column(&times, 6, language).into_iter().zip(listed).zip(between) {
        let what = Cell::words(language.text(&event.what));
        table.row(std::iter::once(time).chain(between).chain(std::iter::once(what)).collect());
    }
    blocks.push(Block::Table(if captions { table.with_caption(language.word(Word::Events)) } else { table }));
    blocks.extend(more_events(switches.len() - listed.len(), language));
    blocks
}

fn more_events(more: usize, language: Language) -> Option<Block> {
    let (en, ru) = (format!("and {more} more events: see the JSON file"), format!("и ещё событий: {more}, см. файл JSON"));
    (more > 0).then(|| Block::paragraph(language.pick(en, ru)))
}

/// The events that the file names, with the quantities at their instants.
fn named_events(data: &Dataset, captions: bool, language: Language) -> Vec<Block> {
    let named: Vec<&Event> = data.events.iter().filter(|e| !e.name.is_empty()).collect();
    let listed = &named[..named.len().min(EVENTS)];
    if listed.is_empty() {
        return Vec::new();
    }
    let quantities: Vec<_> = data.columns.iter().enumerate().filter(|(i, _)| Some(*i) != data.axis).map(|(_, c)| &c.quantity).collect();
    let mut columns = vec![Column::new(language.word(Word::Event)), Column::with_unit(language.word(Word::Time), "s", language)];
    let times: Vec<f64> = listed.iter().map(|e| e.t).collect();
    let mut cells = vec![Cell::column(&times, 6, language)];
    for (j, quantity) in quantities.iter().enumerate() {
        let values: Vec<f64> = listed.iter().map(|e| e.outputs[1].get(j).copied().unwrap_or(f64::NAN)).collect();
        let scale = scale(quantity, values.iter().fold(0.0, |m: f64, v| m.max(v.abs())));
        columns.push(Column { head: report::document::Rich::symbol(&quantity.symbol), unit: scale.print(language) });
        cells.push(Cell::column(&values.iter().map(|v| v / scale.size).collect::<Vec<_>>(), DIGITS, language));
    }
    let mut table = Table::new(columns);
    for (k, event) in listed.iter().enumerate() {
        let row = std::iter::once(Cell::words(&event.name)).chain(cells.iter().map(|column| column[k].clone()));
        table.row(row.collect());
    }
    let table = Block::Table(if captions { table.with_caption(say(language, Say::NamedEvents)) } else { table });
    std::iter::once(table).chain(more_events(named.len() - listed.len(), language)).collect()
}

/// The results of a study, without plots.
pub fn of_results(results: &crate::Results, captions: bool, language: Language) -> Vec<Block> {
    let mut blocks = results.blocks(captions, language);
    blocks.extend(notes(&results.data, language));
    blocks.extend(events(&results.data, captions, language));
    blocks
}

/// Blocks as text for a terminal, below the title of the machine.
pub fn in_terminal(title: &str, blocks: Vec<Block>, language: Language, width: usize) -> String {
    let none = String::new;
    let document = Document { language, title: title.into(), description: none(), blocks, version: none(), model_hash: none() };
    report::terminal::write(&document, width)
}

/// What stands behind "where": definitions, and the rates of prescribed turning angles, ψ' = ω. Nothing when the equations are not shown.
pub fn definitions(equations: &Equations, printer: &Printer) -> Vec<Layout> {
    let Ok(shown_equations) = &equations.textbook else { return Vec::new() };
    let graph = &equations.graph;
    let sides: Vec<symbolic::Expr> = shown_equations.iter().flat_map(|e| [e.left, e.right]).collect();
    let occurring = graph.symbols_in(&sides);
    let shown = equations.definitions.iter().filter(|d| d.shown);
    let mut out: Vec<Layout> = shown.map(|d| printer.definition(graph, d.symbol, d.formula)).collect();
    let turning: Vec<_> = equations.auxiliaries.iter().filter(|a| occurring.binary_search(&a.symbol).is_ok()).collect();
    if !turning.is_empty() {
        // the symbol of the rate is made for print only
        let mut graph = graph.clone();
        for a in turning {
            let name = graph.symbol_info(a.symbol).name.clone();
            let rate = graph.symbol_id(&name, 1);
            out.push(printer.definition(&graph, rate, a.rate));
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
    let rubs = |c: &symbolic::connections::Condition| c.reaction.is_some_and(|r| matches!(equations.reactions[r].law, Law::Friction(_)));
    equations.conditions.iter().filter(|c| !rubs(c)).map(write).collect()
}

/// When a condition holds, if not always: "while the stop `floor` is closed". One for each of [`conditions`].
pub fn holding(equations: &Equations, language: Language) -> Vec<Option<String>> {
    let one = |c: &symbolic::connections::Condition| {
        let Some(reaction) = c.reaction.map(|r| &equations.reactions[r]) else {
            return Some(language.pick("prescribed motion", "заданное движение").to_owned());
        };
        let name = language.text(&reaction.label);
        match reaction.law {
            Law::Contact { tie: true, .. } => Some(format!("{name}, {}", language.pick("while it is taut", "пока канат натянут"))),
            Law::Contact { .. } => Some(format!("{name}, {}", language.pick("while it is closed", "пока контакт замкнут"))),
            Law::Friction(_) => Some(format!("{name}, {}", language.pick("while it sticks", "пока нет скольжения"))),
            _ => None,
        }
    };
    equations.conditions.iter().map(one).collect()
}

fn unnumbered(printer: &Printer, layout: Layout) -> Block {
    Block::Equation { formula: printer.block(layout), numbered: false }
}

/// The written derivation as blocks.
pub fn steps(equations: &Equations, printer: &Printer, language: Language) -> Vec<Block> {
    let mut blocks = Vec::new();
    for step in &equations.steps {
        blocks.push(Block::heading(3, language.text(&step.title)));
        let words = language.text(&step.words);
        if !words.is_empty() {
            blocks.push(Block::paragraph(words));
        }
        for formula in &step.formulas {
            blocks.push(unnumbered(printer, printer.step(&equations.graph, formula)));
        }
    }
    blocks
}

/// Energies of the machine, named.
pub fn energies(equations: &Equations) -> [(Say, &'static str, Expr); 3] {
    let e = &equations.energy;
    [(Say::KineticEnergy, "T", e.kinetic), (Say::PotentialEnergy, "Π", e.potential), (Say::DissipationFunction, "Φ", e.dissipation)]
}

/// What became of each quantity: at the start, least, largest, at the end. Least and greatest values are those of the motion, with their places on the
/// axis; a quantity that could not be followed between the rows has none.
pub fn results(data: &Dataset, language: Language) -> Table {
    let heads = [Word::Symbol, Word::Unit].map(|w| Column::new(language.word(w)));
    let axis = data.axis.and_then(|a| data.columns.get(a)).map(|c| &c.quantity);
    let timed = !data.extremes.is_empty();
    let mut columns: Vec<Column> = heads.into();
    columns.push(Column::new(say(language, Say::AtStart)));
    for word in [Word::Minimum, Word::Maximum] {
        columns.push(Column::new(language.word(word)));
        columns.extend(timed.then(|| taken_at(axis, language)));
    }
    columns.push(Column::new(language.word(Word::Final)));
    columns.push(Column::new(language.word(Word::Description)));
    let mut table = Table::new(columns);
    for (i, column) in data.columns.iter().enumerate() {
        if Some(i) == data.axis || column.values.is_empty() {
            continue;
        }
        let (first, last) = (column.values[0], column.values[column.values.len() - 1]);
        let known = extreme_of(data, i);
        if known.is_none() && !column.values.iter().any(|v| v.is_finite()) {
            continue;
        }
        let none = Extreme { min: f64::NAN, t_min: f64::NAN, max: f64::NAN, t_max: f64::NAN, column: i };
        let e = known.unwrap_or(none);
        let size = [first, e.min, e.max, last].iter().filter(|v| v.is_finite()).fold(0.0_f64, |m, v| m.max(v.abs()));
        let held = data.digits.as_ref().and_then(|d| d.columns.iter().find(|h| h.column == i));
        // what is rounding alone is a zero
        let noise = held.map_or(0.0, |h| h.noise);
        let scale = scale(&column.quantity, if size <= noise { 0.0 } else { size });
        let shown = [first, e.min, e.max, last].map(|v| if v.abs() <= noise { 0.0 } else { v / scale.size });
        let mut cells = with_digits(&shown, held.map(|h| h.deviations.map(|d| d / scale.size)), language).into_iter();
        let nothing = e.min.abs().max(e.max.abs()) <= noise && noise > 0.0;
        let instants = if nothing { [f64::NAN; 2] } else { [e.t_min, e.t_max] };
        let mut instants = with_digits(&instants, held.map(|h| h.instants), language).into_iter();
        let mut row = vec![Cell::symbol(&column.quantity.symbol), Cell::words(scale.print(language))];
        row.extend(cells.next());
        for _ in 0..2 {
            row.extend(cells.next());
            row.extend(instants.next().filter(|_| timed));
        }
        row.extend(cells);
        row.push(Cell::words(language.text(&column.quantity.label)));
        table.row(row);
    }
    table
}

/// Head of the column of places: "at, s" over time, the driven coordinate otherwise.
fn taken_at(axis: Option<&analysis::Quantity>, language: Language) -> Column {
    match axis.filter(|q| q.name != "t") {
        None => Column::with_unit(say(language, Say::WhenTaken), "s", language),
        Some(q) => {
            Column::with_unit(format!("{} {}", language.pick("at", "при"), report::symbol::plain(&q.symbol, language)), &q.unit, language)
        }
    }
}

/// Least and greatest value of a column: those of the motion; of results that stand beside one another, those of the list.
fn extreme_of(data: &Dataset, i: usize) -> Option<Extreme> {
    if let Some(found) = data.extremes.iter().find(|e| e.column == i) {
        return Some(found.clone());
    }
    let finite = data.columns[i].values.iter().copied().filter(|v| v.is_finite() && data.axis.is_none());
    let (min, max) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    (min <= max).then_some(Extreme { column: i, min, max, ..Extreme::default() })
}

/// Cells of a row of numbers. Where a repetition deviates, only the digits that it confirms; a dash where not even the first holds.
fn with_digits<const N: usize>(values: &[f64; N], deviations: Option<[f64; N]>, language: Language) -> Vec<Cell> {
    let held = deviations.map(|d| std::array::from_fn::<i32, N, _>(|k| analysis::audits::digits::digits(values[k].abs(), d[k])));
    let few = |k: usize| held.is_some_and(|h| h[k] < DIGITS as i32 && values[k] != 0.0);
    if !(0..N).any(few) {
        let finite: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
        let mut printed = Cell::column(&finite, DIGITS, language).into_iter();
        return values.iter().map(|v| if v.is_finite() { printed.next().unwrap_or(Cell::Empty) } else { Cell::Empty }).collect();
    }
    let cell = |k: usize| match held {
        Some(h) if few(k) && h[k] < 1 => Cell::words("–"),
        Some(h) if few(k) => Cell::number(values[k], h[k] as usize, language),
        _ => Cell::number(values[k], DIGITS, language),
    };
    (0..N).map(cell).collect()
}

/// The user's unit of display, otherwise SI with a prefix.
pub fn scale(quantity: &analysis::Quantity, largest: f64) -> report::unit::Scale {
    match &quantity.display {
        Some((label, size)) => report::unit::Scale { size: *size, label: label.clone() },
        None => report::unit::Scale::of_column(&quantity.unit, largest),
    }
}

/// One row per quantity, one column per equilibrium.
pub fn equilibria(data: &Dataset, language: Language) -> Table {
    let n = data.columns.first().map_or(0, |c| c.values.len());
    let mut columns = vec![Column::new(language.word(Word::Symbol)), Column::new(language.word(Word::Unit))];
    columns.extend((1..=n).map(|i| if n == 1 { language.word(Word::Value).to_owned() } else { i.to_string() }).map(Column::new));
    columns.push(Column::new(language.word(Word::Description)));
    let mut table = Table::new(columns);
    for column in &data.columns {
        if column.quantity.name == "stable" {
            let verdict = |v: &f64| match v {
                v if v.is_nan() => Say::Undecided,
                v if *v == 0.0 => Say::Unstable,
                _ => Say::Stable,
            };
            let mut row = vec![Cell::words(say(language, Say::Stability)), Cell::Empty];
            row.extend(column.values.iter().map(|v| Cell::words(say(language, verdict(v)))));
            table.row(row);
            continue;
        }
        if matches!(column.quantity.name.as_str(), "residual" | "negative_directions") {
            continue;
        }
        let largest = column.values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let scale = scale(&column.quantity, largest);
        let shown: Vec<f64> = column.values.iter().map(|v| v / scale.size).collect();
        let symbol = if column.quantity.name == "growth" { Cell::words("Re λ") } else { Cell::symbol(&column.quantity.symbol) };
        let mut row = vec![symbol, Cell::words(scale.print(language))];
        row.extend(Cell::column(&shown, DIGITS, language));
        row.push(Cell::words(language.text(&column.quantity.label)));
        table.row(row);
    }
    table
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
        return format!("{number} {unit}").trim_end().to_owned();
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
