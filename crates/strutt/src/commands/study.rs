//! `strutt NAME FILE` of any study of the table: its keys from the command line over those of the file, its run, and showing what it found.

use super::{Exit, judge};
use crate::args;
use crate::console::{Console, end_on_interrupts, listen_to_interrupts, quoted};
use crate::line::{Line, Taken};
use clap::{ArgMatches, FromArgMatches};
use mechanics::asked::Asked;
use mechanics::derive::Detail;
use report::Document;
use report::formats::Holds;
use std::path::{Path, PathBuf};
use strutt::folder;
use strutt::rows::{Earlier, Rows};
use strutt::wording::Word;
use studies::failure::Misuse;
use studies::pipeline::{self, Calculation, Machine};
use studies::watch::Keeper;
use studies::{Alone, Extra, Finds, Given, Interrupts, Study};
use studies::{Extent, Failure, Next, Results, Source, document};
use words::{Notice, Place};

/// Runs the command of a study.
pub fn run(study: &dyn Study, matches: &ArgMatches, console: &mut Console) -> Result<Exit, Failure> {
    match study.interrupts() {
        Interrupts::Kept => listen_to_interrupts(console.language),
        Interrupts::Ending => end_on_interrupts(),
        Interrupts::Short => {}
    }
    let Ok(model) = args::Model::from_arg_matches(matches) else { return Ok(Exit::Failed) };
    let line = Line::new(study, matches);
    let out = matches.get_one::<PathBuf>("out").cloned();
    let written = line.written()?;
    let fresh = written.is_some();
    // a page shows the written derivation
    let detail = if out.is_some() || console.page.is_some() { Detail::Steps } else { Detail::Equations };
    let mut machine = open(&model, written, detail, console)?;
    let in_file = machine.model.studies.len() - usize::from(fresh);
    let of_file = of_file(study, &machine.model.studies[..in_file]);
    let written = fresh.then(|| machine.model.studies.last().cloned()).flatten();
    let base = written.clone().or(of_file.clone()).unwrap_or_default();
    let taken = if fresh { Taken::Instead } else { Taken::All };
    let values = line.values(&machine, (&base, taken))?;
    let asked = study.merge(&machine, Given { written, of_file, line: &values, drawn: out.is_some() })?;
    let wants = |extra: Extra| study.extras().contains(&extra) && matches.get_flag(name_of(extra));
    let shard = if study.extras().contains(&Extra::Shard) { shard(matches)? } else { None };
    let keeps = study.extras().contains(&Extra::Resume);
    let earlier = if wants(Extra::Resume) { Earlier::Resumed } else { Earlier::Refused };
    let mut rows = out.as_deref().filter(|_| keeps).map(|out| Rows::open(out, study.kind().name, earlier)).transpose()?;
    let results = console.watched(|watch| {
        watch.shard = shard;

        watch.halve_tolerance = wants(Extra::HalveTolerance);
        watch.check = wants(Extra::Check);
        watch.threads = if study.extras().contains(&Extra::Threads) { threads(matches) } else { 1 };
        watch.spread = Some(spread);
        let keeper = rows.as_mut().map(|rows| rows as &mut dyn Keeper);
        study.command(&mut machine, &asked, &mut watch.with_keeper(keeper))
    });
    let Some(results) = results else { return Ok(Exit::Done) };
    let tables = line.tables();
    let view = View {
        tables: &tables,
        name: study.kind().name,
        file: &model.file,
        out: out.as_deref(),
        events: wants(Extra::Events),
        switches: wants(Extra::Switches),
    };
    let finished = results.trouble.is_none() && !results.data.partial;
    let exit = finish(machine, results, &view, console)?;
    if let Some(rows) = rows.filter(|rows| finished && shard.is_none() || !rows.holds()) {
        rows.remove();
    }
    Ok(exit)
}

/// `2/8`: the second of eight parts.
fn shard(matches: &ArgMatches) -> Result<Option<[usize; 2]>, Failure> {
    let Some(text) = matches.get_one::<String>(name_of(Extra::Shard)) else { return Ok(None) };
    let parts = text.split_once('/').and_then(|(i, n)| Some([i.trim().parse().ok()?, n.trim().parse().ok()?]));
    match parts {
        Some([part, parts]) if (1..=parts).contains(&part) => Ok(Some([part, parts])),
        _ => Err(Notice::new(
            "C009",
            format!("--shard {text}: this is no part of several"),
            format!("--shard {text}: это не часть из нескольких"),
        )
        .help("write --shard 2/8 for the second of eight", "напишите --shard 2/8: вторая из восьми")
        .misuse()),
    }
}

fn name_of(extra: Extra) -> &'static str {
    match extra {
        Extra::HalveTolerance => "halve_tolerance",
        Extra::Check => "check",
        Extra::Events => "events",
        Extra::Switches => "switches",
        Extra::Threads => "threads",
        Extra::Resume => "resume",
        Extra::Shard => "shard",
    }
}

/// A work on so many threads at once.
fn spread(threads: usize, work: &(dyn Fn() + Sync)) {
    std::thread::scope(|scope| (0..threads).for_each(|_| drop(scope.spawn(work))));
}

/// How many runs at a time: as many as there are processors, unless said otherwise.
fn threads(matches: &ArgMatches) -> usize {
    let given = matches.get_one::<u16>(name_of(Extra::Threads)).map(|n| usize::from(*n));
    given.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from))
}

/// The study among those of the file whose values the command takes.
fn of_file(study: &dyn Study, listed: &[Asked]) -> Option<Asked> {
    let name = study.kind().name;
    let first = |kinds: &[&str]| listed.iter().find(|asked| kinds.contains(&asked.kind)).cloned();
    match study.of_file() {
        [] => first(&[name]),
        preferred => preferred.iter().find_map(|kinds| first(kinds)),
    }
}

/// The machine of a file, with a study that the command line writes behind the file when it begins one.
fn open(model: &args::Model, written: Option<String>, detail: Detail, console: &mut Console) -> Result<Machine, Failure> {
    let (source, overrides) = super::inputs(model)?;
    let text = match &written {
        Some(study) => format!("{}\n\n[[study]]\n{study}", source.text.trim_end()),
        None => source.text.clone(),
    };
    let extended = Source { path: source.path.clone(), text };
    let built = console.watched(|watch| pipeline::build_in(&extended, &overrides, detail, watch));
    let mut machine = built.map_err(|failure| placed(failure, &source, &extended))?;
    machine.warnings.iter_mut().for_each(|d| place(d, &source, &extended));
    machine.model_hash = source.hash(&overrides);
    console.warn(&machine.warnings, &extended);
    Ok(machine)
}

/// Findings in the study that the command line wrote behind the file are findings on the command line.
fn placed(failure: Failure, file: &Source, extended: &Source) -> Failure {
    match failure {
        Failure::Findings { source, mut diagnostics } => {
            diagnostics.iter_mut().for_each(|d| place(d, file, extended));
            Failure::Findings { source, diagnostics }
        }
        other => other,
    }
}

fn place(diagnostic: &mut Notice, file: &Source, extended: &Source) {
    let Some(span) = diagnostic.span().filter(|s| s.start >= file.text.trim_end().len() && extended.text.len() > file.text.len()) else {
        return;
    };
    let text = &extended.text;
    let start = text[..span.start.min(text.len())].rfind('\n').map_or(0, |i| i + 1);
    let line = text[start..].lines().next().unwrap_or_default().to_owned();
    let within = |at: usize| at.saturating_sub(start).min(line.len());
    let span = within(span.start)..within(span.end);
    diagnostic.place = Place::CommandLine { text: line, span };
}

/// How a result is shown.
pub struct View<'a> {
    /// Name of the study.
    pub name: &'static str,
    /// The file, as the user wrote it.
    pub file: &'a str,
    /// Where the folder of results goes.
    pub out: Option<&'a Path>,
    /// Tables that the command line takes values from.
    pub tables: &'a [PathBuf],
    /// Rows at events.
    pub events: bool,
    /// Rows at switches.
    pub switches: bool,
}

/// Shows what was found, writes the folder when one is wanted, decides the exit code.
pub fn finish(machine: Machine, results: Results, view: &View, console: &mut Console) -> Result<Exit, Failure> {
    if console.page.is_some() && view.out.is_none() {
        let exit = judge(&results, console);
        super::page(&Calculation { machine, results: vec![results], files: Vec::new() }, console)?;
        return Ok(exit);
    }
    let alone = results.alone;
    if alone == Alone::WrittenOrTable && console.is_text() && console.terminal && view.out.is_none() && results.trouble.is_none() {
        let exit = judge(&results, console);
        let calculation = Calculation { machine, results: vec![results], files: Vec::new() };
        let width = console.width();
        let document = pipeline::document(&calculation, Extent::Terminal { width }, console.language);
        console.out(report::terminal::write(&document, width))?;
        return Ok(exit);
    }
    let rows = matches!(alone, Alone::Table | Alone::WrittenOrTable) || view.events || view.switches;
    console.timed(Word::TimeWrite, |console| match rows {
        true => table(&results, view, console),
        false => show(&machine, &results, view, console),
    })?;
    if rows {
        tell_checks(&results, console);
    }
    let exit = judge(&results, console);
    // what was refused before it found anything leaves an earlier result where it is
    if let Some(out) = view.out.filter(|_| !is_nothing(&results)) {
        write(machine, results, (out, view.tables), console)?;
    }
    Ok(exit)
}

fn write(machine: Machine, results: Results, (out, tables): (&Path, &[PathBuf]), console: &mut Console) -> Result<(), Failure> {
    let mut calculation = Calculation { machine, results: vec![results], files: Vec::new() };
    let (language, page) = (console.language, console.page.unwrap_or(folder::PAGE));
    let paths = console.timed(Word::TimeWrite, |_| folder::write(&mut calculation, (out, tables), (page, language)))?;
    let list: String = paths.iter().map(|p| format!("\n  {}", p.display())).collect();
    console.talk(&format!("{}{list}", console.say(Word::Written)));
    Ok(())
}

fn show(machine: &Machine, results: &Results, view: &View, console: &Console) -> Result<(), Failure> {
    let language = console.language;
    match (console.format.holds, results.alone) {
        (Holds::Tree(tree), _) => console.out_by(&mut |to| (tree.data)((&results.data, &results.fields()), language, to)),
        (Holds::Table(table), _) => console.out_by(&mut |to| (table.data)(&results.data, to)),
        (Holds::Page(_), _) if view.out.is_some() && !console.terminal => Ok(()),
        (Holds::Page(_), Alone::Places) => places(results, view, console),
        (Holds::Page(_), Alone::Written { next }) => solution(machine, results, (view, next), console),
        // a study that failed before it found anything leaves no empty heading
        (Holds::Page(_), _) if is_nothing(results) => Ok(()),
        (Holds::Page(_), _) => {
            let blocks = results.told(&in_terminal(machine, console));
            console.out(document::in_terminal(language.text(&machine.model.title), blocks, language, console.width()))
        }
    }
}

fn in_terminal<'a>(machine: &'a Machine, console: &Console) -> studies::View<'a> {
    studies::View { equations: &machine.equations, extent: Extent::Terminal { width: console.width() }, language: console.language }
}

/// Positions of equilibrium side by side.
fn places(results: &Results, view: &View, console: &Console) -> Result<(), Failure> {
    if results.trouble.is_some() {
        return Ok(());
    }
    let language = console.language;
    if let Some(table) = results.columns_table(language) {
        console.out(report::terminal::table(&table, language, console.width()))?;
    }
    for note in &results.data.notes {
        console.out(format!("{}\n", language.text(note)))?;
    }
    console.next(&format!("strutt run {}", quoted(view.file)));
    Ok(())
}

/// What was found, below the title of the machine.
fn solution(machine: &Machine, results: &Results, (view, next): (&View, Next), console: &Console) -> Result<(), Failure> {
    let language = console.language;
    let blocks = results.below(&in_terminal(machine, console));
    // after a trouble only modes tell what they have
    let silent = results.trouble.is_some() && machine.origin.studies.finds(view.name) != Finds::Shapes;
    if !blocks.is_empty() && !silent {
        let document = Document {
            language,
            title: language.text(&machine.model.title).to_owned(),
            description: String::new(),
            blocks,
            version: strutt::VERSION.into(),
            model_hash: machine.model_hash.clone(),
        };
        console.out(report::terminal::write(&document, console.width()))?;
    }
    match next {
        Next::Numbers if results.trouble.is_some() => {}
        Next::Numbers => console.next(&format!("strutt {} {} --csv", view.name, quoted(view.file))),
        Next::Run => console.next(&format!("strutt run {}", quoted(view.file))),
    }
    Ok(())
}

/// CSV in pipes, a summary on terminals, unless said otherwise.
fn table(results: &Results, view: &View, console: &Console) -> Result<(), Failure> {
    let data = &results.data;
    if data.columns.is_empty() && console.tree().is_none() {
        return Ok(());
    }
    // where people read, rows are numbers too
    let numbers = console.format.table().unwrap_or(report::csv::NUMBERS);
    match console.format.holds {
        Holds::Tree(tree) => console.out_by(&mut |to| (tree.data)((data, &results.fields()), console.language, to)),
        _ if view.events => console.out((numbers.events)(data, console.language)),
        Holds::Page(_) if view.out.is_some() => Ok(()),
        _ if view.switches => console.out_by(&mut |to| (numbers.data)(&data.with_switches(), to)),
        Holds::Page(_) if console.terminal => {
            let table = studies::results::tables::results(data, console.language);
            console.out(report::terminal::table(&table, console.language, console.width()))?;
            console.next(&format!("strutt simulate {} --csv > motion.csv", quoted(view.file)));
            Ok(())
        }
        _ => console.out_by(&mut |to| (numbers.data)(data, to)),
    }
}

/// The checks of the run and what is to be said of it, beside the data.
fn tell_checks(results: &Results, console: &Console) {
    let number = |x| report::number::short(x, 2, console.language);
    let passed = results.data.audits.iter().filter(|a| a.ok);
    let passed = passed.map(|a| format!("✓ {}: {}", console.language.text(&a.name), number(a.value)));
    let notes = results.data.notes.iter().map(|note| console.language.text(note).to_owned());
    let lines: Vec<String> = passed.chain(notes).collect();
    if !lines.is_empty() {
        console.talk(&lines.join("\n"));
    }
}

fn is_nothing(results: &Results) -> bool {
    results.trouble.is_some() && results.facts.is_empty() && results.words.is_empty() && results.data.columns.is_empty()
}
