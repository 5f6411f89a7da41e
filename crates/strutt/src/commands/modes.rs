//! `strutt modes FILE`: natural oscillations.

use super::{Exit, open};
use crate::args;
use crate::console::{Console, Shape};
use strutt::structure;
use strutt::{Failure, pipeline};

pub fn run(args: &args::Modes, console: &mut Console) -> Result<Exit, Failure> {
    let (_, machine) = open(&args.model, mechanics::derive::Detail::Equations, console)?;
    let Some(of_file) = structure::of(&machine.model) else { return Ok(Exit::Failed) };
    let found = structure::modes::find(&machine.model, of_file)?;
    let data = pipeline::stamped(&machine, found.result.dataset.clone());
    let language = console.language;
    match console.shape {
        Shape::Json => console.out(report::json::write(&data, &structure::modes::fields(&found), language))?,
        Shape::Csv => console.out(report::csv::write(&data, report::csv::Dialect::Plain))?,
        Shape::Text => console.out(format!("{:?} {:?}\n", found.equation, found.result.modes.iter().map(|m| m.omega).collect::<Vec<_>>()))?,
    }
    Ok(if data.audits.iter().all(|a| a.ok) { Exit::Done } else { Exit::Failed })
}
