//! `strutt cycle FILE`: energy balance over a turn.

use super::{Exit, study};
use crate::args;
use crate::console::{Console, listen_to_interrupts};
use crate::quantities;
use mechanics::model::StudyKind;
use strutt::failure::Misuse;
use strutt::{Failure, studies};
use words::{Notice, Text};

pub fn run(args: &args::Cycle, console: &mut Console) -> Result<Exit, Failure> {
    listen_to_interrupts(console.language);
    let out = args.out.as_deref();
    let pick = |kind: &StudyKind| match kind {
        StudyKind::Cycle(study) => Some(study.clone()),
        _ => None,
    };
    let (mut machine, study) = study::open(&args.model, written(args), pick, out, console)?;
    let mut study = study.ok_or_else(no_angle)?;
    study.unknown = args.unknown.clone().or(study.unknown);
    study.flywheel = args.flywheel.clone().or(study.flywheel);
    if args.flywheel.is_some() && study.irregularity.is_none() {
        let needs =
            Text::new("no irregularity is wanted: add --irregularity 0.02", "не задана неравномерность хода: добавьте --irregularity 0,02");
        return Err(quantities::idle("--flywheel", &needs));
    }
    let finding = console.watched(|watch| studies::cycle::run(&mut machine, &study, watch));
    study::finish(machine, finding, out, console)
}

/// The study that the command line describes, as the file would.
fn written(args: &args::Cycle) -> Option<String> {
    let angle = args.angle.as_ref()?;
    let mut text = study::row("kind", "cycle") + &study::row("angle", angle);
    for (key, value, unit) in [("speed", &args.speed, "rad/s"), ("period", &args.period, "s")] {
        text += &value.as_ref().map(|v| study::row(key, &quantities::with_unit(v, unit))).unwrap_or_default();
    }
    for (key, value) in [("irregularity", &args.irregularity), ("turns", &args.turns)] {
        text += &value.as_ref().map(|v| study::row(key, v)).unwrap_or_default();
    }
    Some(text)
}

fn no_angle() -> Failure {
    Notice::new("C034", "which angle describes the cycle?", "какой угол описывает цикл?")
        .why("the file has no study `cycle`, and no --angle was given", "в файле нет расчёта `cycle`, а ключ --angle не задан")
        .help("add --angle phi1, and --unknown F0 for the drive", "добавьте --angle phi1 и --unknown F0 для движущей силы")
        .misuse()
}
