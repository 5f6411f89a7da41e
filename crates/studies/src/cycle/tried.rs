//! A machine whose values are tried: its uniform running, with the shaft held, and its own motion over a cycle.

use super::asked::Cycle;
use crate::failure::in_words;
use crate::machine::{Machine, explained};
use analysis::fault::codes;
use analysis::studies::cycle::{Balance, Cycle as Options, Running, cycle};
use mechanics::model::ParameterValue;
use std::f64::consts::TAU;
use words::{Notice, Text};

/// Tolerance of a turn: its work is a small difference of what passes, and the flywheel an inverse of it.
const TURNED: f64 = 1e-14;

/// A study of the uniform running of a machine, led by the same machine with its shaft held.
type Uniform<T> = fn(&mut analysis::Machine, Option<&mut analysis::Machine>, &[f64], &Options) -> Result<T, analysis::Fault>;

/// A machine whose values are tried, and the same with its shaft held to the uniform rate (with that rate; none where it cannot be held).
pub(super) struct Tried {
    pub machine: Machine,
    held: Option<(f64, Option<Box<Machine>>)>,
    /// The values that both have.
    values: Vec<(String, f64)>,
}

impl Tried {
    /// The machine as it is. A drive and an inertia that are both sought are set to their own numbers already, so that numbers alone change from then on; the drive
    /// has a value of its own in every trial, the inertia must be a number before it is tried, too.
    pub fn new(machine: &Machine, study: &Cycle) -> Tried {
        let mut tried = Tried { machine: machine.clone(), held: None, values: Vec::new() };
        let own = |name: &String| machine.number(name).ok().map(|value| (name.clone(), value));
        let is_number = |name: &&String| {
            let mut declared = machine.model.parameters.iter().filter(|p| p.name == **name);
            declared.any(|p| matches!(p.value, ParameterValue::Number { .. }))
        };
        let inertia = study.flywheel.as_ref().filter(|_| study.irregularity.is_some()).filter(is_number);
        if let Some((inertia, drive)) = inertia.and_then(own).zip(study.unknown.as_ref().and_then(own)) {
            // what cannot be set is told when it is tried
            let _ = tried.set(&[inertia, drive]);
        }
        tried
    }

    /// Gives the machine these values.
    ///
    /// *Errors*: values that the machine cannot have.
    pub fn set(&mut self, values: &[(String, f64)]) -> Result<(), Notice> {
        let same = |(name, value): &(String, f64)| self.values.iter().any(|(n, v)| n == name && v.to_bits() == value.to_bits());
        if self.values.len() == values.len() && values.iter().all(same) {
            return Ok(());
        }
        self.values.clear();
        let written: Vec<(&str, f64)> = values.iter().map(|(n, v)| (n.as_str(), *v)).collect();
        self.machine.bind(&written).map_err(in_words)?;
        let held = self.held.take().filter(|(_, held)| held.is_some());
        self.held = held.and_then(|(rate, held)| {
            let mut held = held?;
            held.bind(&written).is_ok().then_some((rate, Some(held)))
        });
        self.values = values.to_vec();
        Ok(())
    }

    /// The machine held to the uniform rate.
    fn held(&mut self, study: &Cycle, rate: f64) -> Option<&mut Machine> {
        if self.held.as_ref().is_none_or(|(known, _)| *known != rate) {
            self.held = Some((rate, held(&self.machine, study, rate).map(Box::new)));
        }
        self.held.as_mut()?.1.as_deref_mut()
    }

    /// The balance, and the uniform rate.
    ///
    /// *Errors*: S046, and what the study finds wrong.
    pub fn balance(&mut self, study: &Cycle) -> Result<(Balance, f64), Notice> {
        self.over(study, cycle)
    }

    /// The work of the balance, and the sum of the magnitudes that make it up.
    ///
    /// *Errors*: S046, and what the study finds wrong.
    pub fn work(&mut self, study: &Cycle) -> Result<[f64; 2], Notice> {
        Ok(self.over(study, analysis::studies::cycle::work)?.0)
    }

    /// What a study of uniform running finds, and the uniform rate.
    fn over<T>(&mut self, study: &Cycle, find: Uniform<T>) -> Result<(T, f64), Notice> {
        let machine = &self.machine;
        let start = machine.system.start().map_err(|fault| explained(fault, &machine.equations))?;
        let n = machine.equations.coordinates.len();
        let angle = angle(machine, study);
        let rate = study.speed.unwrap_or(start[n + angle]);
        if rate == 0.0 {
            return Err(Notice::new(codes::STANDS, format!("`{}` stands still", study.name), format!("`{}` неподвижна", study.name))
                .help("give `speed`, `period` or a starting rate", "задайте `speed`, `period` или начальную скорость"));
        }
        let range = TAU * study.turns.abs() * rate.signum();
        let options = Options { angle, range, rate, points: study.points, tolerance: TURNED };
        self.held(study, rate);
        let Tried { machine, held, .. } = self;
        let mut held = held.as_mut().and_then(|(_, held)| held.as_deref_mut());
        let start = match held.as_ref().map(|held| held.system.start()) {
            Some(Ok(uniform)) => uniform,
            _ => start,
        };
        let lead = held.as_mut().map(|held| &mut held.system);
        let found = find(&mut machine.system, lead, &start, &options).map_err(|fault| explained(fault, &machine.equations))?;
        Ok((found, rate))
    }

    /// What is to be said of tracks that would have to pull in the uniform running that [`Tried::balance`] is about; S116 for strands.
    ///
    /// *Errors*: S116.
    pub fn pulling(&self, study: &Cycle) -> Result<Vec<Text>, Notice> {
        let Some((_, Some(held))) = &self.held else { return Ok(Vec::new()) };
        let mut held = held.clone();
        pulling(&mut held, study).map_err(|fault| explained(fault, &held.equations))
    }
}

/// The same for the motion of a machine from its start.
pub(super) fn pulling(machine: &mut Machine, study: &Cycle) -> Result<Vec<Text>, analysis::Fault> {
    let start = begun(machine, study)?;
    let pushes = crate::plan::pushes(&machine.model, &machine.equations);
    let options = turning(machine, study, &start);
    (analysis::made::OVER_CYCLE)(&mut machine.system, &start, &options, &pushes)
}

/// The machine with its shaft held to the uniform rate by one more condition, so that ropes are taut and contacts closed as they are in uniform
/// running; none where the shaft's motion is given already.
fn held(machine: &Machine, study: &Cycle, rate: f64) -> Option<Machine> {
    let name = format!("uniform_turning_of_{}", study.name);
    let condition = format!("\n\n[constraints.{name}]\nzero_rate = \"{}' - ({rate:e} [rad/s])\"\n", study.name);
    let mut source = machine.origin.source.clone();
    source.text = source.text.trim_end().to_owned() + &condition;
    let own = format!("{}'", study.name);
    let mut overrides: Vec<(String, String)> = machine.origin.overrides.iter().filter(|(n, _)| *n != own).cloned().collect();
    let written = machine.written(&own, rate);
    overrides.push((own, written));
    machine.again(source, overrides).ok()
}

/// The running of the motion over one cycle of the angle from the start.
pub(super) fn turned(machine: &mut Machine, study: &Cycle) -> Result<Running, Notice> {
    let start = begun(machine, study).map_err(|fault| explained(fault, &machine.equations))?;
    let options = turning(machine, study, &start);
    (analysis::made::RUNNING)(&mut machine.system, &start, &options).map_err(|fault| explained(fault, &machine.equations))
}

/// Where that motion begins; a shaft that the file starts at rest has the uniform rate there, with the rates of all else that go with it.
fn begun(machine: &Machine, study: &Cycle) -> Result<Vec<f64>, analysis::Fault> {
    let own = machine.system.start()?;
    let rate = own[machine.equations.coordinates.len() + angle(machine, study)];
    match study.speed.filter(|_| rate == 0.0).and_then(|speed| held(machine, study, speed)) {
        Some(uniform) => uniform.system.start(),
        None => Ok(own),
    }
}

/// Index of the coordinate that is the angle.
fn angle(machine: &Machine, study: &Cycle) -> usize {
    machine.equations.coordinates.iter().position(|c| c.symbols[0] == study.angle).unwrap_or(0)
}

/// The cycle of the machine's own motion, which begins with the uniform rate: that of the study, else that of the start.
fn turning(machine: &Machine, study: &Cycle, start: &[f64]) -> Options {
    let angle = angle(machine, study);
    let rate = study.speed.unwrap_or(start[machine.equations.coordinates.len() + angle]);
    let range = TAU * study.turns.abs() * rate.signum();
    Options { angle, range, rate, points: study.points, tolerance: TURNED }
}
