//! The command `strutt`.

#![cfg_attr(not(test), deny(clippy::too_many_lines, clippy::fn_params_excessive_bools))]

mod args;
mod commands;
mod console;
mod line;
mod localize;
mod quantities;

use clap::FromArgMatches;
use clap::error::ErrorKind;
use console::Console;
use std::io::Write;
use std::process::ExitCode;
use words::Language;

fn main() -> ExitCode {
    let language = console::language_of(std::env::args_os().skip(1));
    let matches = match localize::command(language).try_get_matches() {
        Ok(matches) => matches,
        Err(error) => return wrong_use(&error, language),
    };
    if let Some(help) = localize::help_asked(&matches, language) {
        let _ = std::io::stdout().write_all(help.as_bytes());
        return ExitCode::SUCCESS;
    }
    let global = match args::Global::from_arg_matches(&matches) {
        Ok(global) => global,
        Err(error) => return wrong_use(&error, language),
    };
    let mut console = Console::new(&global, language);
    let chosen = matches.subcommand().and_then(|(_, command)| command.try_get_one::<String>("format").ok().flatten());
    if let Some(format) = chosen.and_then(|name| report::formats::find(name)) {
        console.choose(format);
    }
    let asked = matches.subcommand().and_then(|(name, of_study)| Some((studies::find(name).filter(|s| s.has_command())?, of_study)));
    let result = match asked {
        Some((study, of_study)) => commands::study::run(study, of_study, &mut console),
        None => match args::Cli::from_arg_matches(&matches) {
            Ok(cli) => commands::run(cli.command, &mut console),
            Err(error) => return wrong_use(&error, language),
        },
    };
    let code = match result {
        Ok(exit) => exit as u8,
        Err(failure) => console.fail(&failure),
    };
    console.timings();
    ExitCode::from(code)
}

/// Help and version go to stdout with code 0, complaints to stderr with code 2.
fn wrong_use(error: &clap::Error, language: Language) -> ExitCode {
    let asked = matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion);
    // a reader that has gone away is no reason to fail
    let _ = match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => error.print(),
        _ => std::io::stderr().write_all(localize::complaint(error, language).as_bytes()),
    };
    ExitCode::from(if asked { 0 } else { 2 })
}
