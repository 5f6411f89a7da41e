//! A machine ready for studies, and what it was made from.

use super::study::Studies;
use crate::guards;
use crate::provenance;
use crate::source::Source;
use analysis::Dataset;
use mechanics::Model;
use report::formula::{Form, Printer};
use symbolic::Equations;
use words::{Language, Notice};

/// A machine ready for studies.
#[derive(Clone, Debug)]
pub struct Machine {
    /// What the file says.
    pub model: Model,
    /// Findings that do not prevent its use.
    pub warnings: Vec<Notice>,
    /// Equations of motion.
    pub equations: Equations,
    /// The same as a program with numbers.
    pub system: analysis::Machine,
    /// Hash of the file and the overrides.
    pub model_hash: String,
    /// What it was made from.
    pub origin: Origin,
}

impl Machine {
    /// Names of the states: coordinates, rates, auxiliary states.
    pub fn system_states(&self) -> Vec<String> {
        use analysis::System;
        self.system.states().iter().map(|q| q.name.clone()).collect()
    }

    /// The number of a parameter.
    ///
    /// # Errors
    /// C031: there is none of this name, or it has no number.
    pub fn number(&self, name: &str) -> Result<f64, Notice> {
        let declared = self.model.parameters.iter().find(|p| p.name == name);
        declared.and_then(|p| p.number).ok_or_else(|| self.no_number(name))
    }

    /// C031, with the name that was meant.
    pub fn no_number(&self, name: &str) -> Notice {
        let trouble =
            Notice::new("C031", format!("`{name}` is no parameter with a number"), format!("`{name}` — не параметр с числовым значением"));
        match words::nearest(name, self.model.parameters.iter().map(|p| p.name.as_str())) {
            Some(near) => trouble.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
            None => trouble,
        }
    }
}

/// From equations to a program with numbers.
///
/// # Errors
/// A formula that has no value for the parameters as given.
pub fn lower(equations: &Equations) -> Result<analysis::Machine, analysis::Fault> {
    let values: Vec<f64> = equations.parameters.iter().map(|p| p.value).collect();
    analysis::Machine::assembled(equations, &values, &|program| guards::names(equations, program))
}

/// A fault with the expression that failed in the user's symbols.
pub fn explained(fault: analysis::Fault, equations: &Equations) -> Notice {
    let expression = fault.expression();
    let mut trouble = Notice::from(fault);
    // small motions have a graph of their own: an expression of theirs is not one of these
    if let Some(e) = expression.filter(|e| e.index() < equations.graph.len()) {
        let what = &mut trouble.what;
        for (words, language) in [(&mut what.en, Language::En), (&mut what.ru, Language::Ru)] {
            let printer = Printer::of(equations, language);
            words.push_str(": ");
            words.push_str(&printer.inline(&equations.graph, e, Form::Text));
        }
    }
    trouble
}

/// The result of a study that computes no numbers: provenance and checks only.
pub fn no_numbers(machine: &Machine) -> Dataset {
    provenance::stamp(Dataset::default(), &machine.equations, &machine.model_hash)
}

/// File and overrides of a machine.
#[derive(Clone, Debug)]
pub struct Origin {
    /// The file.
    pub source: Source,
    /// Values set from outside.
    pub overrides: Vec<(String, String)>,
    /// The studies that it may ask for.
    pub studies: &'static Studies,
}
