//! `strutt variants ...`: the variants of a file, all at once.

use super::Exit;
use crate::args::{self, VariantsAction};
use crate::console::{Console, INTERRUPTED, listen_to_interrupts, quoted};
use mechanics::derive::Detail;
use report::formats::Holds;
use std::sync::atomic::Ordering;
use studies::variants::{Class, check};
use studies::{Failure, document};

pub fn run(args: &args::Variants, console: &mut Console) -> Result<Exit, Failure> {
    listen_to_interrupts(console.language);
    match &args.action {
        VariantsAction::Check(args) => overview(args, console),
    }
}

/// `strutt variants check FILE`.
fn overview(args: &args::VariantsCheck, console: &mut Console) -> Result<Exit, Failure> {
    let source = strutt::source::open(&args.file)?;
    let reading = studies::read(&source, &[]).map_err(|diagnostics| Failure::Findings { source: Box::new(source.clone()), diagnostics })?;
    console.warn(&reading.warnings, &source);
    let members = strutt::variants::members(&reading.model, &source, args.group)?;
    let mut class = Class::new(source, Detail::Equations);
    let found = console.watched(|watch| check(&mut class, &reading.model, &members, watch));
    let language = console.language;
    match console.format.holds {
        Holds::Tree(tree) => console.out((tree.value)(&found.to_json(language)))?,
        Holds::Table(_) => console.out(found.to_csv(language))?,
        Holds::Page(_) => {
            let title = language.text(&found.title);
            console.out(document::in_terminal(title, found.blocks(language), language, console.width()))?;
            let next = if found.is_good() { "run" } else { "check" };
            let variant = found.lines.first().map_or("1", |l| l.name.as_str());
            console.next(&format!("strutt {next} {} --variant {}", quoted(&args.file), quoted(variant)));
        }
    }
    Ok(match (INTERRUPTED.load(Ordering::Relaxed), found.is_good()) {
        (true, _) => Exit::Interrupted,
        (false, true) => Exit::Done,
        (false, false) => Exit::Failed,
    })
}
