//! `strutt run FILE`: every study of the file, on the terminal and in a folder.

use super::{Exit, has_numbers, inputs, judge};
use crate::args;
use crate::console::{Console, INTERRUPTED, listen_to_interrupts, quoted};
use report::formats::Holds;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use strutt::wording::Word;
use strutt::{film, folder};
use studies::Extent;
use studies::Failure;
use studies::pipeline::{self, Calculation};

pub fn run(args: &args::Run, console: &mut Console) -> Result<Exit, Failure> {
    listen_to_interrupts(console.language);
    let (source, overrides) = inputs(&args.model)?;
    let mut calculation = console.watched(|watch| {
        watch.halve_tolerance = args.halve_tolerance;
        pipeline::run(&source, &overrides, watch)
    })?;
    console.warn(&calculation.machine.warnings, &source);
    let out = args.out.clone().unwrap_or_else(|| Path::new("out").join(source.name()));
    let (language, page) = (console.language, console.page.unwrap_or(folder::PAGE));
    let paths = console.timed(Word::TimeWrite, |_| folder::write(&mut calculation, (&out, &[]), (page, language)))?;
    let paths = if args.animate { animated(&calculation, (&out, paths), console)? } else { paths };
    show(&calculation, console)?;
    tell(&calculation, &paths, &args.model.file, console);
    // studies that were left out are no finding of their own
    let least = if INTERRUPTED.load(Ordering::Relaxed) { Exit::Interrupted } else { Exit::Done };
    Ok(calculation.results.iter().fold(least, |exit, results| exit.worse(judge(results, console))))
}

/// Moving pictures beside the page, before it in the list.
fn animated(calculation: &Calculation, (out, mut paths): (&Path, Vec<PathBuf>), console: &Console) -> Result<Vec<PathBuf>, Failure> {
    let films = film::write(calculation, out, console.language)?;
    if let Some(why) = films.without {
        console.talk(console.language.text(&why));
    }
    let page = paths.pop();
    paths.extend(films.paths);
    paths.extend(page);
    Ok(paths)
}

fn show(calculation: &Calculation, console: &Console) -> Result<(), Failure> {
    let language = console.language;
    match console.format.holds {
        Holds::Tree(_) => console.out(folder::calculation_to_json(calculation, language)),
        Holds::Table(table) => match calculation.results.first() {
            Some(results) => console.out_by(&mut |to| (table.data)(&results.data, to)),
            None => Ok(()),
        },
        Holds::Page(_) => {
            let width = console.width();
            let document = pipeline::document(calculation, Extent::Terminal { width }, language);
            console.out(report::terminal::write(&document, width))
        }
    }
}

fn tell(calculation: &Calculation, paths: &[PathBuf], file: &str, console: &Console) {
    let partial = calculation.results.iter().any(|r| r.data.partial);
    let heading = console.say(if partial { Word::WrittenPartly } else { Word::Written });
    let list: String = paths.iter().map(|p| format!("\n  {}", p.display())).collect();
    console.talk(&format!("\n{heading}{list}"));
    let file = quoted(file);
    let model = &calculation.machine.model;
    if model.coordinates.is_empty() && !model.sections.is_empty() {
        return console.next(&format!("strutt section {file}"));
    }
    let next = match has_numbers(&calculation.machine) {
        true => format!("strutt equations {file} --steps"),
        false => format!("strutt simulate {file} --until 10"),
    };
    console.next(&next);
}
