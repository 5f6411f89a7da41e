//! The study that a sweep repeats, at one place.

use crate::machine::Machine;
use crate::machine::bind::Binding;
use crate::periodic::{self, Periodic, in_words};
use crate::watch::Watch;
use crate::{Finds, Given, Results, idle};
use mechanics::asked::{Asked, Value as Taken};
use words::{Notice, Text};

/// What is repeated, which study of the file it is, and what the command line says of it.
pub(super) struct Repeated<'a> {
    pub(super) base: &'a Asked,
    pub(super) of: Option<usize>,
    pub(super) inner: &'a Asked,
}

impl Repeated<'_> {
    /// The study as the file reads with the values: its formulas (a period 2*pi/w) may depend on them.
    pub(super) fn at(&self, machine: &Machine) -> Result<Asked, Notice> {
        let Some(fresh) = self.of.and_then(|k| machine.model.studies.get(k)) else { return Ok(self.base.clone()) };
        let mut fresh = changed(machine, fresh.kind, Some(fresh.clone()), self.inner)?;
        observing(machine, &mut fresh, self.base.words("outputs").to_vec());
        Ok(fresh)
    }
}

/// The study at one place.
pub(super) fn one(
    (machine, anew): (&mut Machine, &mut usize),
    repeated: &Repeated<'_>,
    values: &[(String, f64)],
    guess: &mut Option<Vec<f64>>,
    watch: &mut Watch,
) -> Result<Results, Notice> {
    let values: Vec<(&str, f64)> = values.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    *anew += usize::from(machine.bind(&values).map_err(in_words)? == Binding::Anew);
    let base = &repeated.at(machine)?;
    // what is tuned is not the machine of the next place
    let mut own = base.has("wanted_period").then(|| machine.clone());
    let machine = own.as_mut().unwrap_or(machine);
    let study = (base.kind == periodic::KIND.name).then(|| Periodic::of(base)).filter(|study| study.tuned.is_none());
    let mut inner = Watch { interrupt: watch.interrupt, ..Watch::default() };
    if let (Some(study), Some(x)) = (&study, guess.as_ref()) {
        // the regime before is the better guess; when it leads nowhere, the file's start is tried
        let outcome = periodic::from(machine, &Periodic { settle: 0.0, ..study.clone() }, x, &mut inner);
        if outcome.fault.is_none() {
            *guess = Some(outcome.regime.start.clone());
            return Ok(periodic::results(machine, study, outcome, None));
        }
    }
    let finding = match &study {
        Some(study) => {
            let outcome = periodic::regime(machine, study, &mut inner);
            *guess = outcome.fault.is_none().then(|| outcome.regime.start.clone());
            periodic::results(machine, study, outcome, None)
        }
        None => match machine.origin.studies.find(base.kind).and_then(|study| study.run(machine, base, &mut inner)) {
            Some(finding) => finding,
            None => return Err(Notice::new("C032", "this study cannot be repeated", "этот расчёт повторять нельзя")),
        },
    };
    match &finding.trouble {
        Some(trouble) => Err(trouble.clone()),
        None => Ok(finding),
    }
}

/// A study of the file, or one from nothing, with what the command line says of it.
pub(super) fn changed(machine: &Machine, kind: &str, of_file: Option<Asked>, inner: &Asked) -> Result<Asked, Notice> {
    let Some(study) = machine.origin.studies.find(kind) else { return Ok(of_file.unwrap_or_default()) };
    if inner.values().is_empty()
        && let Some(asked) = of_file
    {
        return Ok(asked);
    }
    if let Some((key, _)) = inner.values().iter().find(|(key, _)| study.kind().key(key).is_none()) {
        let (en, ru) =
            (format!("the repeated study `{kind}` has no such key"), format!("у повторяемого расчёта `{kind}` нет такого ключа"));
        return Err(in_words(idle(&format!("--{}", key.replace('_', "-")), &Text::new(en, ru))));
    }
    study.merge(machine, Given { written: None, of_file, line: inner, drawn: false }).map_err(in_words)
}

/// Lets a study give these columns only, and draw nothing.
pub(super) fn observing(machine: &Machine, asked: &mut Asked, columns: Vec<String>) {
    let kind = machine.origin.studies.find(asked.kind).map(|study| study.kind());
    if kind.is_some_and(|kind| {
        kind.key("outputs").is_some() && kind.key("tolerance").is_some() && machine.origin.studies.finds(asked.kind) != Finds::ClosedForm
    }) {
        asked.set("outputs", Taken::Words(columns));
        asked.unset("plot");
    }
}
