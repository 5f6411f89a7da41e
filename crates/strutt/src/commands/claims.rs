//! `strutt claims FILE`: published results against the machine.

use super::study::{View, finish};
use super::{Exit, open};
use crate::args;
use crate::console::Console;
use mechanics::derive::Detail;
use studies::failure::Misuse;
use studies::{Failure, claims};
use words::Notice;

pub fn run(args: &args::Claims, console: &mut Console) -> Result<Exit, Failure> {
    let (_, mut machine) = open(&args.model, Detail::Equations, console)?;
    let finding = console.watched(|watch| claims::run(&mut machine, watch)).ok_or_else(none)?;
    let fails = finding.data.column("ok").is_some_and(|c| c.values.contains(&0.0));
    let view = View { name: "claims", file: &args.model.file, out: None, tables: &[], events: false, switches: false };
    let exit = finish(machine, finding, &view, console)?;
    Ok(if args.strict && fails { exit.worse(Exit::Failed) } else { exit })
}

fn none() -> Failure {
    Notice::new("C050", "the file has no [[claims]]", "в файле нет [[claims]]")
        .why(
            "a claim is a published result to be laid against the machine",
            "[[claims]] — это опубликованные результаты, сопоставляемые с машиной",
        )
        .help(
            "write [[claims]] and equation = \"...\", or of = \"...\" and value = \"...\"",
            "напишите [[claims]] и equation = \"...\" либо of = \"...\" и value = \"...\"",
        )
        .misuse()
}
