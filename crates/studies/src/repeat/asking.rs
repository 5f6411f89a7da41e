//! How a study is asked for that is repeated.

use super::wanted::Noted;
use crate::failure::in_words;
use crate::machine::Machine;
use crate::{Finds, Given, idle};
use analysis::reduce::Reduction;
use mechanics::asked::{Asked, Value as Taken};
use words::{Notice, Text};

/// What a study that repeats another says of it.
#[derive(Clone, Copy, Debug)]
pub struct Asks<'a> {
    /// What is noted, as written.
    pub observe: &'a [String],
    /// Kind of the study of the file that is repeated; `None`: the first that has the results.
    pub of: Option<&'a str>,
    /// Values of the repeated study in place of those of the file.
    pub inner: &'a Asked,
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

/// Lets a study give what is noted only, and draw nothing.
pub(super) fn observing(machine: &Machine, asked: &mut Asked, noted: &[Noted]) {
    let reduced = || noted.iter().filter_map(|(_, observable)| observable.reduced());
    let study = machine.origin.studies.find(asked.kind);
    let finds = machine.origin.studies.finds(asked.kind);
    let has = |key| study.is_some_and(|study| study.kind().key(key).is_some());
    if has("outputs") && has("tolerance") && finds != Finds::ClosedForm {
        // what is noted between instants need not be followed elsewhere
        let everywhere = reduced().filter(|r| r.window.is_none() || finds != Finds::Motion).map(|r| r.of.clone());
        asked.set("outputs", Taken::Words(everywhere.collect()));
        asked.unset("plot");
    }
    if finds == Finds::Verdict {
        // what goes along a parameter in the file is asked at each place here
        ["parameter", "from", "to"].iter().for_each(|key| asked.unset(key));
    }
    if finds == Finds::Motion {
        asked.unset("every");
        asked.set("at", Taken::Numbers(Vec::new()));
        asked.set("windows", Taken::Windows(reduced().filter_map(|r| Some((r.of.clone(), r.window?))).collect()));
        // of these nothing but means
        let others = |of: &String| reduced().any(|r| r.of == *of && r.window.is_some() && r.reduction != Reduction::Mean);
        asked.set("means", Taken::Words(reduced().map(|r| r.of.clone()).filter(|of| !others(of)).collect()));
    }
}
