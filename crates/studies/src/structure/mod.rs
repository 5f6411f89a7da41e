//! Studies of frames and trusses: from a model with nodes to datasets, fields of JSON and blocks of the written calculation.

pub mod bind;
pub mod compare;
pub mod drawing;
pub mod equation;
pub mod modes;
pub mod mount;
pub mod rayleigh;
pub mod show;
pub mod statics;

use crate::finite::checked;
use crate::pipeline::{Finding, Machine};
use crate::provenance;
use analysis::Dataset;
use mechanics::Model;
use mechanics::structure::Structure;
use report::{Block, Figure};
use serde_json::{Map, Value, json};
use words::{Language, Notice};

/// What a study of a structure found.
#[derive(Clone, Debug)]
pub struct StructureFound {
    /// Kind of the study, as files call it.
    pub study: &'static str,
    /// The numbers.
    pub data: Dataset,
    /// What ended it.
    pub trouble: Option<Notice>,
    /// Everything else; none after a trouble.
    pub result: Option<Outcome>,
}

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
pub fn modes(machine: &Machine, study: &crate::modes::Modes) -> Option<Finding> {
    // with bodies on it the frame is part of the machine
    let structure = of(&machine.model).filter(|_| mount::is_bare(&machine.model))?;
    let found = match ignored(study) {
        Some(key) => Err(Box::new(one_value(key))),
        None => modes::find(&machine.model, structure, study).map(|found| Outcome::Modes(Box::new(found))),
    };
    Some(finding(machine, "modes", found))
}

/// A wish that has no meaning for a structure alone.
fn ignored(study: &crate::modes::Modes) -> Option<&'static str> {
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
pub fn statics(machine: &Machine) -> Option<Finding> {
    let structure = of(&machine.model)?;
    Some(finding(machine, "statics", statics::find(machine, structure).map(|found| Outcome::Statics(Box::new(found)))))
}

fn finding(machine: &Machine, study: &'static str, outcome: Result<Outcome, Box<Notice>>) -> Finding {
    let (data, trouble, result) = match outcome {
        Ok(outcome) => (outcome.data().clone(), None, Some(outcome)),
        Err(trouble) => (Dataset { partial: true, ..Dataset::default() }, Some(*trouble), None),
    };
    let data = provenance::stamp(data, &machine.equations, &machine.model_hash);
    checked(Finding::Structure(Box::new(StructureFound { study, data, trouble, result })))
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
pub fn fields(found: &StructureFound) -> Map<String, Value> {
    let mut own = match &found.result {
        Some(Outcome::Modes(found)) => modes::fields(found),
        Some(Outcome::Statics(found)) => statics::fields(found),
        None => Map::new(),
    };
    own.insert("study".into(), json!(found.study));
    if found.study == "modes" {
        own.entry("modes").or_insert_with(|| json!([]));
    }
    own
}

/// The written calculation.
pub fn blocks(found: &StructureFound, language: Language, page: bool) -> Vec<Block> {
    let mut blocks = match &found.result {
        Some(Outcome::Modes(found)) => show::modes(found, language, page),
        Some(Outcome::Statics(found)) => show::statics(found, language, page),
        None => Vec::new(),
    };
    blocks.extend(found.data.notes.iter().map(|note| Block::paragraph(language.text(note))));
    blocks
}

/// What the study is called.
pub fn heading(found: &StructureFound, language: Language) -> &'static str {
    match found.study {
        "statics" => language.pick("Statics", "Статика"),
        _ => language.pick("Natural oscillations", "Собственные колебания"),
    }
}

/// Drawings.
pub fn figures(found: &StructureFound, language: Language) -> Vec<Figure> {
    match &found.result {
        Some(Outcome::Modes(found)) => drawing::modes(found, language),
        Some(Outcome::Statics(found)) => drawing::statics(found, language),
        None => Vec::new(),
    }
}
