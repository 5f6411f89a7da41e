//! `strutt inverse FILE`: forces and torques of motors for prescribed motions.

use super::{Exit, open, simulate, study};
use crate::args;
use crate::console::{Console, listen_to_interrupts};
use mechanics::derive::Detail;
use strutt::{Failure, plan, studies};

pub fn run(args: &args::Simulate, console: &mut Console) -> Result<Exit, Failure> {
    let wishes = simulate::wishes(args)?;
    let detail = if args.out.is_some() { Detail::Steps } else { Detail::Equations };
    let (_, mut machine) = open(&args.model, detail, console)?;
    let mut asked = plan::simulation(&machine.model, &machine.equations, wishes)?;
    if args.outputs.is_some() && args.out.is_none() {
        // columns of plots that nobody draws are not asked for
        asked.plots.clear();
    }
    listen_to_interrupts(console.language);
    let finding = console.watched(|watch| {
        watch.halve_tolerance = args.halve_tolerance;
        studies::inverse::run(&mut machine, &asked, watch)
    });
    study::finish(machine, finding, args.out.as_deref(), console)
}
