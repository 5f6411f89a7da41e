//! `strutt report FILE`: the calculation as it is handed in.

use super::{Exit, inputs, judge};
use crate::args;
use crate::console::{Console, INTERRUPTED, listen_to_interrupts};
use report::formats::{self, Format};
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use strutt::wording::Word;
use strutt::{folder, pdf};
use studies::Failure;
use studies::failure::Misuse;
use studies::pipeline;
use words::Notice;

pub fn run(args: &args::Report, console: &mut Console) -> Result<Exit, Failure> {
    listen_to_interrupts(console.language);
    let format = console.paged().map_err(|format| no_pages(&format).misuse())?.unwrap_or(folder::PAGE);
    if args.pdf {
        pdf::printed(&format).map_err(Misuse::misuse)?;
    }
    let (source, overrides) = inputs(&args.model)?;
    let calculation = console.watched(|watch| pipeline::run(&source, &overrides, watch))?;
    console.warn(&calculation.machine.warnings, &source);
    let (out, name) = place(args, &source.name(), format.extension);
    let document = pipeline::report(&calculation, console.language);
    let paths = console.timed(Word::TimeWrite, |_| folder::report(&calculation, &document, (&out, &name), &format))?;
    let mut paths = paths;
    if args.pdf {
        paths.extend(paths.last().map(|page| pdf::print(page, &format)).transpose()?);
    }
    let list: String = paths.iter().map(|p| format!("\n  {}", p.display())).collect();
    console.talk(&format!("{}{list}", console.say(Word::Written)));
    let least = if INTERRUPTED.load(Ordering::Relaxed) { Exit::Interrupted } else { Exit::Done };
    Ok(calculation.results.iter().fold(least, |exit, results| exit.worse(judge(results, console))))
}

/// A calculation has figures and formulas: formats of the terminal, of tables and of trees hold none.
fn no_pages(format: &Format) -> Notice {
    let fitting: Vec<&str> = formats::TABLE.iter().filter(|format| format.is_paged()).map(|format| format.name).collect();
    let list = fitting.join(", ");
    Notice::new(
        "C073",
        format!("a calculation is not written as {}", format.name),
        format!("расчётная записка в формате {} не составляется", format.name),
    )
    .help(format!("use --format {list}"), format!("укажите --format и один из форматов: {list}"))
}

/// Folder and name of the file.
fn place(args: &args::Report, model: &str, extension: &str) -> (PathBuf, String) {
    if let Some(path) = &args.output {
        let folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
        let name = path.file_name().map_or_else(|| format!("report.{extension}"), |name| name.to_string_lossy().into_owned());
        return (folder, name);
    }
    let folder = args.out.clone().unwrap_or_else(|| Path::new("out").join(model));
    (folder, format!("report.{extension}"))
}
