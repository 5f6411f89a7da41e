//! The command `strutt`.

mod args;
mod commands;
mod console;
mod localize;
mod quantities;

use clap::FromArgMatches;
use console::Console;
use std::process::ExitCode;

fn main() -> ExitCode {
    let language = console::language_of(std::env::args_os().skip(1));
    let matches = match localize::command(language).try_get_matches() {
        Ok(matches) => matches,
        Err(error) => return wrong_use(&error),
    };
    let cli = match args::Cli::from_arg_matches(&matches) {
        Ok(cli) => cli,
        Err(error) => return wrong_use(&error),
    };
    let mut console = Console::new(&cli.global, language);
    let code = match commands::run(cli.command, &mut console) {
        Ok(exit) => exit as u8,
        Err(failure) => console.fail(&failure),
    };
    console.timings();
    ExitCode::from(code)
}

/// Help and version go to stdout with code 0, complaints to stderr with code 2.
fn wrong_use(error: &clap::Error) -> ExitCode {
    // a reader that has gone away is no reason to fail
    let _ = error.print();
    ExitCode::from(if error.use_stderr() { 2 } else { 0 })
}
