//! `strutt inverse FILE`: the forces and torques of motors that realise prescribed motions.

use super::{Exit, study};
use crate::args;
use crate::console::{Console, Shape, listen_to_interrupts};
use crate::quantities;
use mechanics::model::{DEFAULT_TOLERANCE, Simulate, StudyKind, Times};
use strutt::{Failure, Trouble, plan, studies};

pub fn run(args: &args::Inverse, console: &mut Console) -> Result<Exit, Failure> {
    listen_to_interrupts();
    let out = args.table.out.as_deref();
    let pick = |kind: &StudyKind| match kind {
        StudyKind::Inverse(study) => Some(study.clone()),
        _ => None,
    };
    let (mut machine, of_file) = study::open(&args.model, None, pick, out, console)?;
    let study = asked(args, of_file)?;
    plan::known_columns(&study.outputs, &machine.equations)?;
    let finding = console.watched(|watch| studies::inverse::run(&mut machine, &study, watch));
    if console.shape == Shape::Text && !console.terminal && out.is_none() && finding.trouble().is_none() {
        // in a pipe the table itself, as of a simulation
        console.out(report::csv::write(finding.data(), report::csv::Dialect::Plain))?;
        return Ok(super::judge(&finding, console));
    }
    study::finish(machine, finding, out, console)
}

/// What the file says, changed by the command line.
fn asked(args: &args::Inverse, of_file: Option<Simulate>) -> Result<Simulate, Failure> {
    let until = args.until.as_deref().map(|text| quantities::seconds("--until", text)).transpose()?;
    let times = study::times(&args.table)?;
    let last = match &times {
        Some(Times::At(times)) => times.iter().copied().reduce(f64::max),
        _ => None,
    };
    let in_file = of_file.is_some();
    let mut study = of_file.unwrap_or_else(|| Simulate {
        until: 0.0,
        times: Times::Automatic,
        tolerance: DEFAULT_TOLERANCE,
        outputs: Vec::new(),
        plots: Vec::new(),
    });
    match (until, last) {
        (Some(until), _) => study.until = until,
        (None, Some(last)) => study.until = study.until.max(last),
        (None, None) if !in_file => return Err(no_end()),
        (None, None) => {}
    }
    if times.is_none()
        && let Times::At(times) = &mut study.times
    {
        times.retain(|t| *t <= study.until);
    }
    study.times = times.unwrap_or(study.times);
    if let Some(tolerance) = &args.table.tolerance {
        study.tolerance = quantities::number("--tolerance", tolerance)?;
    }
    if let Some(outputs) = study::columns(&args.table) {
        (study.outputs, study.plots) = (outputs, Vec::new());
    }
    Ok(study)
}

fn no_end() -> Failure {
    Trouble::new("C007", "how long shall the motion be?", "до какого момента считать движение?")
        .why("the file has no study `inverse`, and no --until was given", "в файле нет расчёта `inverse`, а ключ --until не задан")
        .help("add --until 10 (seconds), or a study to the file", "добавьте --until 10 (секунд) или расчёт в файл")
        .misuse()
}
