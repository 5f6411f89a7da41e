//! `strutt periodic FILE`: the exact periodic regime.

use super::{Exit, study};
use crate::args;
use crate::console::{Console, listen_to_interrupts};
use crate::quantities;
use mechanics::model::{DEFAULT_TOLERANCE, Periodic, Section, StudyKind, Times};
use strutt::{Failure, plan, studies};
use words::Text;

pub fn run(args: &args::Periodic, console: &mut Console) -> Result<Exit, Failure> {
    listen_to_interrupts(console.language);
    let out = args.table.out.as_deref();
    let pick = |kind: &StudyKind| match kind {
        StudyKind::Periodic(study) => Some(study.clone()),
        _ => None,
    };
    let (mut machine, of_file) = study::open(&args.model, written(args), pick, out, console)?;
    let study = asked(args, of_file)?;
    plan::known_columns(&study.outputs, &machine.equations)?;
    let finding = console.watched(|watch| studies::periodic::run(&mut machine, &study, watch));
    study::finish(machine, finding, out, console)
}

/// The study that the command line describes, as the file would.
fn written(args: &args::Periodic) -> Option<String> {
    if args.section.is_none() && args.period.is_none() {
        return None;
    }
    let mut text = study::row("kind", "periodic");
    for (key, value) in [("section", &args.section), ("turns", &args.turns)] {
        text += &value.as_ref().map(|v| study::row(key, v)).unwrap_or_default();
    }
    text += &args.period.as_ref().map(|v| study::row("period", &quantities::with_unit(v, "s"))).unwrap_or_default();
    Some(text)
}

/// What the file says, changed by the command line; a turn or a return found by itself when nobody says what a period is.
fn asked(args: &args::Periodic, of_file: Option<Periodic>) -> Result<Periodic, Failure> {
    let mut study = of_file.unwrap_or_else(|| Periodic {
        section: Section::Time,
        period: None,
        settle: 0.0,
        tuned: None,
        tolerance: DEFAULT_TOLERANCE,
        times: Times::Automatic,
        outputs: Vec::new(),
        plots: Vec::new(),
    });
    if let Some(settle) = &args.settle {
        study.settle = quantities::duration("--settle", settle)?;
    }
    if let Some(text) = &args.turns {
        let Section::Turns { turns, .. } = &mut study.section else { return Err(no_turns()) };
        *turns = quantities::number("--turns", text)?;
    }
    if let (Some(name), Some(wanted)) = (&args.unknown, &args.wanted_period) {
        study.tuned = Some((name.clone(), quantities::seconds("--wanted-period", wanted)?));
    }
    if let Some(tolerance) = &args.table.tolerance {
        study.tolerance = quantities::tolerance("--tolerance", tolerance)?;
    }
    study.times = study::times(&args.table)?.unwrap_or(study.times);
    study.outputs = study::columns(&args.table).unwrap_or(study.outputs);
    Ok(study)
}

fn no_turns() -> Failure {
    let needs = Text::new("only a section that is an angle has turns: --section phi", "обороты есть только у сечения-угла: --section phi");
    quantities::idle("--turns", &needs)
}
