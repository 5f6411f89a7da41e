//! `strutt sweep FILE`: a study repeated over values of parameters.

use super::study::{self, toml_string};
use super::{Exit, study::row};
use crate::args;
use crate::console::{Console, listen_to_interrupts};
use mechanics::model::StudyKind;
use strutt::failure::Misuse;
use strutt::{Failure, studies};
use words::Notice;

pub fn run(args: &args::Sweep, console: &mut Console) -> Result<Exit, Failure> {
    listen_to_interrupts(console.language);
    let out = args.out.as_deref();
    let pick = |kind: &StudyKind| match kind {
        StudyKind::Sweep(study) => Some(study.clone()),
        _ => None,
    };
    let (mut machine, study) = study::open(&args.model, written(args), pick, out, console)?;
    let mut study = study.ok_or_else(nothing_to_sweep)?;
    // the command line replaces what it names; the rest is that of the file's study
    let of_file = machine.model.studies.iter().find_map(|s| pick(&s.kind)).unwrap_or_else(|| study.clone());
    study.observe = args.observe.clone().unwrap_or(of_file.observe);
    study.of = args.of.clone().or(of_file.of);
    let finding = console.watched(|watch| studies::sweep::run(&mut machine, &study, watch));
    study::finish(machine, finding, out, console)
}

/// The study that the command line describes, as the file would.
fn written(args: &args::Sweep) -> Option<String> {
    if args.over.is_empty() {
        return None;
    }
    let list = |items: &[String]| format!("[{}]", items.iter().map(|i| toml_string(i.trim())).collect::<Vec<_>>().join(", "));
    let mut text = row("kind", "sweep");
    text += &format!("over = {}\n", list(&args.over));
    if let Some(observe) = &args.observe {
        text += &format!("observe = {}\n", list(observe));
    }
    text += &args.of.as_ref().map(|of| row("of", of)).unwrap_or_default();
    Some(text)
}

fn nothing_to_sweep() -> Failure {
    Notice::new("C033", "over which values?", "по каким значениям?")
        .why("the file has no study `sweep`, and no --over was given", "в файле нет расчёта `sweep`, а ключ --over не задан")
        .help(
            "add --over \"v=linspace(1 m/s, 3 m/s, 21)\" --observe period",
            "добавьте --over \"v=linspace(1 м/с, 3 м/с, 21)\" --observe period",
        )
        .misuse()
}
