//! `strutt kinematics FILE`: a linkage over a range of its driven coordinate.

use super::{Exit, study};
use crate::args;
use crate::console::{Console, end_on_interrupts};
use crate::quantities;
use mechanics::model::{Kinematics, KinematicsEnd, StudyKind};
use strutt::failure::Misuse;
use strutt::pipeline::Machine;
use strutt::{Failure, plan, studies};
use words::Notice;

pub fn run(args: &args::Kinematics, console: &mut Console) -> Result<Exit, Failure> {
    end_on_interrupts();
    let out = args.out.as_deref();
    let pick = |kind: &StudyKind| match kind {
        StudyKind::Kinematics(study) => Some(study.clone()),
        _ => None,
    };
    let (mut machine, study) = study::open(&args.model, written(args), pick, out, console)?;
    let mut study = study.ok_or_else(nothing_driven)?;
    if args.over.is_none() {
        change(&mut study, args, &machine)?;
    }
    if let Some(names) = &args.outputs {
        study.outputs = names.iter().map(|n| n.trim().to_owned()).filter(|n| !n.is_empty()).collect();
        let own = studies::kinematics::own_columns(&machine, &study);
        let others: Vec<String> = study.outputs.iter().filter(|o| !own.contains(o)).cloned().collect();
        plan::known_columns(&others, &machine.equations)?;
    }
    let finding = console.watched(|watch| studies::kinematics::run(&mut machine, &study, watch));
    study::finish(machine, finding, out, console)
}

/// Keys of the command line in place of those of the file's study.
fn change(study: &mut Kinematics, args: &args::Kinematics, machine: &Machine) -> Result<(), Failure> {
    let dimension = study::dimension_of(&study.name, machine);
    if let Some(text) = &args.from {
        study.from = Some(quantities::quantity("--from", text, &dimension)?);
    }
    if let Some(text) = &args.to {
        study.to = KinematicsEnd::At(quantities::quantity("--to", text, &dimension)?);
    }
    if let Some(text) = &args.turns {
        study.to = KinematicsEnd::Turns(quantities::number("--turns", text)?);
    }
    if let Some(text) = &args.rate {
        study.rate = Some(quantities::quantity("--rate", text, &dimension.per_time(1))?);
    }
    study.points = args.points.unwrap_or(study.points);
    let empty = matches!((study.from, study.to), (Some(from), KinematicsEnd::At(to)) if from == to);
    if empty || study.to == KinematicsEnd::Turns(0.0) || study.rate == Some(0.0) || study.points < 2 {
        return Err(Notice::new("C036", "the range of positions is empty", "промежуток положений пуст")
            .why(
                "two different ends, a rate other than zero and at least two positions are needed",
                "нужны разные концы, ненулевая скорость и не менее двух положений",
            )
            .help("for example --from 0 --to \"90 deg\" --points 91", "например, --from 0 --to \"90 град\" --points 91")
            .misuse());
    }
    Ok(())
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
    Notice::new("C035", "which coordinate is driven?", "какая координата ведущая?")
        .why("the file has no study `kinematics`, and no --over was given", "в файле нет расчёта `kinematics`, а ключ --over не задан")
        .help("add --over phi1", "добавьте --over phi1")
        .misuse()
}
