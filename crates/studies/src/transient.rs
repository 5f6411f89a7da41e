//! The study `transient`: the motion of a linear system in closed form, phase by phase.

use super::keys::{AT, EVERY, METHOD, MOTIONS, OUTPUTS, PLOT, TOLERANCE_OF_MOTION, UNTIL};
use super::simulate::{Simulate, drawn, merged, moving, options};
use super::{Extra, Finds, Found, Given, Interrupts, Repeats, Results, Study};
use crate::failure::Failure;
use crate::machine::Machine;
use crate::phases::{self, Phases};
use crate::results::finite::checked;
use crate::results::{Alone, Body, fields};
use crate::watch::{Lap, Watch};
use crate::wording::Word as Say;
use crate::{plan, provenance};
use analysis::Dataset;
use analysis::studies::simulate::Outcome;
use analysis::studies::transient::Found as Closed;
use mechanics::asked::{Asked, Key, Kind, Takes, Words};
use serde_json::json;
use std::sync::Arc;
use words::{Notice, Printed};

/// A motion in closed form.
#[derive(Clone, Debug)]
pub struct Transient {
    /// The motion.
    pub motion: Simulate,
    /// Small motions about the equilibrium when the system is not linear.
    pub linearise: bool,
}

impl Transient {
    /// As a file asks for it.
    pub fn of(asked: &Asked) -> Transient {
        Transient { motion: Simulate::of(asked), linearise: asked.flag("linearise") }
    }
}

/// The study.
pub struct ClosedForm;

/// Its name and its keys.
pub static KIND: Kind = Kind::new(
    "transient",
    (
        "Compute the motion of a linear system in closed form, phase by phase",
        "Рассчитать движение линейной системы в замкнутой форме, этап за этапом",
    ),
)
.keys(&[
    UNTIL,
    TOLERANCE_OF_MOTION,
    METHOD,
    EVERY,
    AT,
    OUTPUTS,
    PLOT,
    Key::new(
        "linearise",
        Takes::Flag,
        ("small motions about the equilibrium when the system is not linear", "малые движения около равновесия, если система нелинейна"),
        "true",
    )
    .default("false", "false")
    .option("Small motions about the equilibrium when the system is not linear", "Малые движения около равновесия, если система нелинейна"),
]);

impl Study for ClosedForm {
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn wanted(&self) -> Words {
        ("find the motion in closed form, phase by phase", "найти закон движения в замкнутой форме по этапам нагружения")
    }
    fn chapter(&self) -> &'static str {
        "motion"
    }
    fn finds(&self) -> Finds {
        Finds::ClosedForm
    }
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        let linearise = asked.flag("linearise");
        let motion = Simulate::of(asked).with_plots(&machine.equations);
        let finding = closed_form(machine, &Transient { motion: motion.clone(), linearise }, watch);
        Some(match motion.finer(&finding.data) {
            Some(motion) => closed_form(machine, &Transient { motion, linearise }, watch),
            None => finding,
        })
    }
    fn command(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        Some(closed_form(machine, &Transient::of(asked), watch))
    }
    fn of_file(&self) -> &'static [&'static [&'static str]] {
        &[&["transient"], MOTIONS]
    }
    fn merge(&self, machine: &Machine, given: Given) -> Result<Asked, Failure> {
        merged(&KIND, &machine.equations, given)
    }
    fn extras(&self) -> &'static [Extra] {
        Extra::OF_A_MOTION
    }
    fn interrupts(&self) -> Interrupts {
        Interrupts::Kept
    }
    fn repeats(&self) -> Repeats {
        Repeats::Motion
    }
}

/// A motion in closed form.
pub fn closed_form(machine: &mut Machine, study: &Transient, watch: &mut Watch) -> Results {
    let (results, phases) = solved(machine, study, watch);
    checked(Results { body: Body::After(Arc::new(phases)), ..results })
}

/// A motion in closed form, and its phases.
pub fn solved(machine: &mut Machine, study: &Transient, watch: &mut Watch) -> (Results, Phases) {
    let twin =
        analysis::studies::simulate::Simulate { events: plan::events(&machine.model, &machine.equations), ..options(&study.motion, watch) };
    let pushes = plan::pushes(&machine.model, &machine.equations);
    let options = analysis::studies::transient::Transient { twin, ends: machine.model.phases.clone(), linearise: study.linearise, pushes };
    let found = match moving(&machine.equations).and_then(|()| machine.system.start()) {
        Ok(start) => (analysis::made::TRANSIENT)(&mut machine.system, &machine.equations, &start, options),
        Err(fault) => Closed { outcome: Outcome { dataset: Dataset::default(), fault: Some(fault) }, phases: Vec::new() },
    };
    watch.lap(Lap::Run);
    let trouble = found.outcome.fault.map(Notice::from);
    let phases = Phases { list: found.phases, names: phases::state_names(&machine.equations), restarts: machine.model.restarts.clone() };
    let data = provenance::stamp(found.outcome.dataset, &machine.equations, &machine.model_hash);
    let own = fields(json!({"until": study.motion.until, "phases": phases::to_json(&phases)}));
    let results = Results {
        kind: KIND.name,
        alone: Alone::WrittenOrTable,
        heading: Say::ClosedForm.text(),
        own,
        trouble,
        ..drawn(machine, &study.motion, data)
    };
    (results, phases)
}
