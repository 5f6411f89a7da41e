//! `strutt kinematics FILE`: a linkage over a range of its driven coordinate.

use super::{Exit, study};
use crate::args;
use crate::console::{Console, listen_to_interrupts};
use mechanics::model::StudyKind;
use strutt::{Failure, Trouble, plan, studies};

pub fn run(args: &args::Kinematics, console: &mut Console) -> Result<Exit, Failure> {
    listen_to_interrupts();
    let out = args.out.as_deref();
    let pick = |kind: &StudyKind| match kind {
        StudyKind::Kinematics(study) => Some(study.clone()),
        _ => None,
    };
    let (mut machine, study) = study::open(&args.model, written(args), pick, out, console)?;
    let mut study = study.ok_or_else(nothing_driven)?;
    if let Some(names) = &args.outputs {
        study.outputs = names.iter().map(|n| n.trim().to_owned()).filter(|n| !n.is_empty()).collect();
        plan::known_columns(&study.outputs, &machine.equations)?;
    }
    let finding = console.watched(|watch| studies::kinematics::run(&mut machine, &study, watch));
    study::finish(machine, finding, out, console)
}

/// The study that the command line describes, as the file would.
fn written(args: &args::Kinematics) -> Option<String> {
    let over = args.over.as_ref()?;
    let mut text = study::row("kind", "kinematics") + &study::row("over", over);
    let keys = [("from", &args.from), ("to", &args.to), ("turns", &args.turns), ("rate", &args.rate)];
    for (key, value) in keys {
        text += &value.as_ref().map(|v| study::row(key, v)).unwrap_or_default();
    }
    text += &args.points.map(|p| format!("points = {p}\n")).unwrap_or_default();
    Some(text)
}

fn nothing_driven() -> Failure {
    Trouble::new("C035", "which coordinate is driven?", "какая координата ведущая?")
        .why("the file has no study `kinematics`, and no --over was given", "в файле нет расчёта `kinematics`, а ключ --over не задан")
        .help("add --over phi1", "добавьте --over phi1")
        .misuse()
}
