//! Studies of frames and trusses: from a model with nodes to datasets, fields of JSON and blocks of the written calculation.

pub mod compare;
pub mod drawing;
pub mod equation;
pub mod modes;
pub mod rayleigh;
pub mod show;
pub mod statics;
mod terms;

use crate::machine::Machine;
use crate::provenance;
use crate::results::finite::checked;
use crate::results::{Alone, Body, Next, Results, Show, View};
use analysis::Dataset;
use mechanics::Model;
use mechanics::structure::Structure;
use report::{Block, Figure};
use serde_json::{Map, Value, json};
use std::sync::Arc;
use words::{Language, Notice, Text};

/// The result of a study.
#[derive(Clone, Debug)]
pub enum Outcome {
    /// Natural oscillations.
    Modes(Box<modes::Found>),
    /// Statics.
    Statics(Box<statics::Found>),
}

/// The structure of a model.
pub fn of(model: &Model) -> Option<&Structure> {
    model.structure.as_ref()
}

/// Natural oscillations of the structure; none when the model has none.
pub fn modes(machine: &Machine, study: &crate::small::asked::Modes) -> Option<Results> {
    // with bodies on it the frame is part of the machine
    let structure = of(&machine.model).filter(|_| crate::frame::coordinates::is_bare(&machine.model))?;
    let found = match ignored(study) {
        Some(key) => Err(Box::new(one_value(key))),
        None => modes::find(&machine.model, structure, study).map(|found| Outcome::Modes(Box::new(found))),
    };
    Some(finding(machine, modes::NAME, found))
}

/// A wish that has no meaning for a structure alone.
fn ignored(study: &crate::small::asked::Modes) -> Option<&'static str> {
    match study {
        study if study.over.is_some() => Some("over"),
        study if study.about_start => Some("about = \"start\""),
        study if !study.guess.is_empty() => Some("guess"),
        _ => None,
    }
}

fn one_value(key: &str) -> Notice {
    Notice::new("S105", format!("the modes of a structure have no `{key}`"), format!("у форм конструкции нет `{key}`"))
        .why(
            "a frame or truss without bodies is linear: its modes are those of the data as they stand in the file",
            "рама или ферма без тел линейна: её формы отвечают данным файла",
        )
        .help(
            "leave it out and set the parameter for each run: strutt modes FILE --set h=2",
            "уберите его и задавайте параметр в каждом запуске: strutt modes ФАЙЛ --set h=2",
        )
}

/// Statics of the structure; none when the model has none.
pub fn statics(machine: &Machine) -> Option<Results> {
    let structure = of(&machine.model)?;
    Some(finding(machine, statics::NAME, statics::find(machine, structure).map(|found| Outcome::Statics(Box::new(found)))))
}

fn finding(machine: &Machine, study: &'static str, outcome: Result<Outcome, Box<Notice>>) -> Results {
    let data = outcome.as_ref().map_or_else(|_| Dataset { partial: true, ..Dataset::default() }, |outcome| outcome.data().clone());
    let base = Results {
        kind: study,
        alone: Alone::Written { next: Next::Run },
        heading: heading(study),
        own: fields(study, outcome.as_ref().ok()),
        data: provenance::stamp(data, &machine.equations, &machine.model_hash),
        ..Results::default()
    };
    checked(match outcome {
        Ok(outcome) => Results { body: Body::Own(Arc::new(outcome)), ..base },
        Err(trouble) => Results { trouble: Some(*trouble), ..base },
    })
}

impl Outcome {
    fn data(&self) -> &Dataset {
        match self {
            Outcome::Modes(found) => &found.result.dataset,
            Outcome::Statics(found) => &found.result.dataset,
        }
    }
}

/// The study's own fields of JSON.
fn fields(study: &'static str, outcome: Option<&Outcome>) -> Map<String, Value> {
    let mut own = match outcome {
        Some(Outcome::Modes(found)) => modes::fields(found),
        Some(Outcome::Statics(found)) => statics::fields(found),
        None => Map::new(),
    };
    own.insert("study".into(), json!(study));
    if study == modes::NAME {
        own.entry("modes").or_insert_with(|| json!([]));
    }
    own
}

impl Show for Outcome {
    fn blocks(&self, results: &Results, view: &View) -> Vec<Block> {
        let mut blocks = match self {
            Outcome::Modes(found) => show::modes(found, view),
            Outcome::Statics(found) => show::statics(found, view),
        };
        blocks.extend(crate::results::events::notes(&results.data, view.language));
        blocks
    }

    fn figures(&self, _: &Results, language: Language) -> Vec<Figure> {
        match self {
            Outcome::Modes(found) => drawing::modes(found, language),
            Outcome::Statics(found) => drawing::statics(found, language),
        }
    }
}

/// What the study is called.
fn heading(study: &str) -> Text {
    match study {
        statics::NAME => Text::new("Statics", "Статика"),
        _ => Text::new("Natural oscillations", "Собственные колебания"),
    }
}
