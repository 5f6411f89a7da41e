//! `strutt transient FILE`: the motion of a linear system in closed form; on a terminal the written solution, in a pipe the table.

use super::simulate::{show, tell_checks, wishes, write};
use super::{Exit, judge, open};
use crate::args;
use crate::console::{Console, Shape, listen_to_interrupts};
use mechanics::derive::Detail;
use strutt::document::Extent;
use strutt::pipeline::Calculation;
use strutt::wording::Word;
use strutt::{Failure, pipeline, plan};

pub fn run(asked: &args::Transient, console: &mut Console) -> Result<Exit, Failure> {
    let args = &asked.motion;
    let wishes = wishes(args)?;
    let detail = if args.out.is_some() { Detail::Steps } else { Detail::Equations };
    let (_, mut machine) = open(&args.model, detail, console)?;
    let mut study = plan::transient(&machine.model, &machine.equations, wishes)?;
    study.linearise |= asked.linearise;
    listen_to_interrupts(console.language);
    let finding = console.watched(|watch| {
        watch.halve_tolerance = args.halve_tolerance;
        pipeline::transient(&mut machine, &study, watch)
    });
    let exit = judge(&finding, console);
    if console.shape == Shape::Text && console.terminal && args.out.is_none() && finding.trouble().is_none() {
        let calculation = Calculation { machine, findings: vec![finding], files: Vec::new() };
        let width = console.width();
        let document = pipeline::document(&calculation, Extent::Terminal { width }, console.language);
        console.out(report::terminal::write(&document, width))?;
        return Ok(exit);
    }
    console.timed(Word::TimeWrite, |console| show(&finding, args, console))?;
    tell_checks(&finding, console);
    if let Some(out) = &args.out {
        write(machine, finding, out, console)?;
    }
    Ok(exit)
}
