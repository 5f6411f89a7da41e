//! `strutt completions SHELL`.

use super::Exit;
use crate::console::Console;
use crate::{args, localize};
use studies::Failure;

pub fn run(args: &args::Completions, console: &mut Console) -> Result<Exit, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut localize::command(console.language), "strutt", &mut script);
    console.out(script)?;
    Ok(Exit::Done)
}
