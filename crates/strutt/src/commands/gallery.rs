//! `strutt gallery --out DIR`: a page of the example models with moving pictures.

use super::{Exit, examples};
use crate::args;
use crate::console::Console;
use strutt::showcase;
use strutt::wording::Word;
use studies::Failure;

pub fn run(args: &args::Gallery, console: &mut Console) -> Result<Exit, Failure> {
    let chosen = showcase::chosen(&args.names, examples::find)?;
    let page = showcase::write(&chosen, &args.out, console.language)?;
    console.talk(&format!("{}\n  {}", console.say(Word::Written), page.display()));
    Ok(Exit::Done)
}
