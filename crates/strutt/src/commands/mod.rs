//! The commands, one file each.

mod check;
mod claims;
mod common;
mod completions;
mod equations;
mod examples;
mod explain;
mod gallery;
mod merge;
mod new;
mod paper;
mod run;
mod scheme;
mod section;
pub mod study;
mod variants;

pub use common::Exit;
pub(crate) use common::{has_numbers, inputs, judge, open, page};

use crate::args::Command;
use crate::console::Console;
use studies::Failure;

/// Runs a command.
pub fn run(command: Command, console: &mut Console) -> Result<Exit, Failure> {
    match command {
        Command::Run(args) => run::run(&args, console),
        Command::Report(args) => paper::run(&args, console),
        Command::Check(args) => check::run(&args, console),
        Command::Claims(args) => claims::run(&args, console),
        Command::Equations(args) => equations::run(&args, console),
        Command::Variants(args) => variants::run(&args, console),
        Command::Section(args) => section::run(&args, console),
        Command::Scheme(args) => scheme::run(&args, console),
        Command::Examples(args) => examples::run(&args, console),
        Command::Gallery(args) => gallery::run(&args, console),
        Command::Merge(args) => merge::run(&args, console),
        Command::New(args) => new::run(&args, console),
        Command::Explain(args) => explain::run(&args, console),
        Command::Completions(args) => completions::run(&args, console),
    }
}
