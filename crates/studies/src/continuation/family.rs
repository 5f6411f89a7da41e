//! The machine with other values of its parameter, and the period that its file gives then.

use super::asked::{Branched, Followed};
use crate::failure::in_words;
use crate::machine::Machine;
use crate::machine::bind::Binding;
use crate::periodic::Periodic;
use analysis::Fault;
use analysis::studies::continuation::Family;
use symbolic::Expr;

/// A machine and its parameter.
pub(super) struct Bound<'a> {
    study: &'a Branched,
    /// The regime as the file has it before any value is set.
    written: Option<Periodic>,
    pub(super) machine: Machine,
    /// Value of the second parameter.
    second: Option<f64>,
    last: Option<f64>,
    period: Period,
}

/// How the period follows from the parameter.
#[derive(Clone, Copy, Debug)]
enum Period {
    /// Not at all: it is a number, or there is none.
    Is(Option<f64>),
    /// By this formula over the constants of the model.
    Formula(Expr),
    /// Several formulas have its value: the file is read for each value of the parameter.
    Read,
}

impl<'a> Bound<'a> {
    pub(super) fn new(machine: &Machine, study: &'a Branched) -> Bound<'a> {
        let written = in_file(machine, study);
        let second = study.second.as_ref().map(|second| second.here);
        Bound { study, written, machine: machine.clone(), second, last: None, period: Period::Read }
    }

    /// The regime as it reads at a value of the parameter; what the command line says instead of the file holds.
    ///
    /// *Errors*: what the model says against the value.
    pub(super) fn regime(&mut self, regime: &Periodic, value: f64) -> Result<Periodic, Fault> {
        self.bind(value)?;
        let found = match self.reread(regime) {
            Some(after) => Periodic { section: after.section, period: after.period, ..regime.clone() },
            None => regime.clone(),
        };
        Ok(found)
    }

    /// The regime of the file with the values that the machine has now, where the command line says nothing else.
    fn reread(&self, regime: &Periodic) -> Option<Periodic> {
        let before = self.written.as_ref()?;
        in_file(&self.machine, self.study).filter(|_| before.period == regime.period)
    }

    fn bind(&mut self, value: f64) -> Result<Binding, Fault> {
        let mut values = vec![(self.study.name.as_str(), value)];
        values.extend(self.study.second.as_ref().zip(self.second).map(|(second, value)| (second.name.as_str(), value)));
        self.machine.bind(&values).map_err(|failure| Fault::from(in_words(failure)))
    }

    /// The period of a machine whose file has just been read, and how it follows from the parameter. Where a formula gives it, the studies are forgotten: they
    /// would ask for reading the file anew with each value.
    fn learn(&mut self) {
        let Followed::Orbits(regime) = &self.study.of else {
            self.period = Period::Is(None);
            self.machine.model.forget_studies();
            return;
        };
        let period = self.reread(regime).map_or(regime.period, |after| after.period);
        let formulas = period.map(|period| self.machine.model.formulas_of(period)).unwrap_or_default();
        let overridden = self.written.as_ref().is_none_or(|before| before.period != regime.period);
        self.period = match formulas.as_slice() {
            _ if overridden => Period::Is(regime.period),
            [] => Period::Is(period),
            [one] => Period::Formula(*one),
            _ => Period::Read,
        };
        if !matches!(self.period, Period::Read) {
            self.machine.model.forget_studies();
        }
    }
}

/// The study that says what a period is, as the file has it.
fn in_file(machine: &Machine, study: &Branched) -> Option<Periodic> {
    machine.model.studies.iter().find(|asked| asked.span == study.place).map(Periodic::of)
}

impl Family for Bound<'_> {
    fn at(&mut self, value: f64) -> Result<(&mut analysis::Machine, Option<f64>), Fault> {
        if self.last != Some(value) {
            self.last = None;
            if self.bind(value)? == Binding::Anew {
                self.learn();
            }
            self.last = Some(value);
        }
        let period = match (&self.period, &self.study.of) {
            (Period::Is(period), _) => *period,
            (Period::Formula(formula), _) => Some(self.machine.model.number_of(*formula)),
            (Period::Read, Followed::Orbits(regime)) => self.reread(regime).and_then(|after| after.period),
            (Period::Read, Followed::Rest | Followed::Free { .. }) => None,
        };
        Ok((&mut self.machine.system, period))
    }

    fn hold(&mut self, second: f64) {
        if self.second != Some(second) {
            (self.second, self.last) = (Some(second), None);
        }
    }
}
