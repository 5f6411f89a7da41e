//! The command of a trial.

use crate::chapter::Trial;
use crate::claim::{Claim, When};
use crate::drawn::drawn;
use crate::outcome::Outcome;
use analysis::Dataset;
use analysis::studies::simulate::{Grid, Simulate, simulate};
use mechanics::asked::Asked;
use mechanics::model::Times;
use studies::pipeline::{self, Machine};
use studies::{Failure, Source, Watch};

/// Instants of claims about a whole motion.
const INSTANTS: usize = 200;

/// Default tolerance of the book.
const TOLERANCE: f64 = 1e-14;

/// The first line of an expectation.
pub struct Command {
    verb: String,
    until: f64,
    tolerance: f64,
    method: analysis::integrate::stiff::Method,
    set: Vec<(String, String)>,
    guess: Vec<(String, String)>,
    linearise: bool,
    /// Name of a section, or of a body that is drawn alone.
    name: String,
    /// Row of the table of variants.
    variant: Option<String>,
}

impl Command {
    pub fn parse(words: &[String]) -> Result<Command, String> {
        let mut command = Command {
            verb: words[0].clone(),
            until: 0.0,
            tolerance: TOLERANCE,
            method: Default::default(),
            set: Vec::new(),
            guess: Vec::new(),
            name: String::new(),
            variant: None,
            linearise: false,
        };
        let mut list = None;
        for word in &words[1..] {
            if word == "set" || word == "guess" {
                list = Some(word.as_str());
                continue;
            }
            if word == "linearise" {
                command.linearise = true;
                continue;
            }
            let (name, value) = word.split_once('=').ok_or_else(|| format!("not NAME=VALUE: `{word}`"))?;
            let pair = (name.to_owned(), value.to_owned());
            match (list.take(), name) {
                (Some("set"), _) => command.set.push(pair),
                (Some(_), _) => command.guess.push(pair),
                (None, "until") => command.until = quantity(value)?,
                (None, "name") => value.clone_into(&mut command.name),
                (None, "variant") => command.variant = Some(value.to_owned()),
                (None, "method") => {
                    command.method = analysis::integrate::stiff::Method::named(value).ok_or_else(|| format!("no method: {value}"))?
                }
                (None, "tolerance") => command.tolerance = value.parse().map_err(|_| format!("not a number: {value}"))?,
                (None, _) => return Err(format!("unknown option `{word}`")),
            }
        }
        Ok(command)
    }

    /// Values of the variant, then those set by hand.
    fn overrides(&self, source: &Source) -> Result<Vec<(String, String)>, Failure> {
        let mut all = Vec::new();
        if let Some(variant) = &self.variant {
            let reading =
                studies::read(source, &[]).map_err(|diagnostics| Failure::Findings { source: Box::new(source.clone()), diagnostics })?;
            all = strutt::variants::overrides(&reading.model, source, (variant, None))?;
        }
        all.extend(self.set.iter().cloned());
        Ok(all)
    }

    pub fn run(&self, trial: &Trial, claims: &[&Claim]) -> Result<Outcome, String> {
        // a table of variants stands beside the model of a page of the gallery
        let beside = trial.file.parent().filter(|folder| folder.components().any(|c| c.as_os_str() == "gallery"));
        let path = beside.map_or_else(|| "model.toml".into(), |folder| folder.join("model.toml"));
        let source = Source::new(&path.to_string_lossy(), &trial.model);
        if self.verb == "variants" {
            return variants(source);
        }
        let set = match self.overrides(&source) {
            Ok(set) => set,
            Err(Failure::Trouble(t) | Failure::Misuse(t)) => return Ok(Outcome::ended(&t)),
            Err(other) => return Err(format!("no variant: {other:?}")),
        };
        let mut machine = match pipeline::build(&source, &set, &mut Watch::default()) {
            Ok(machine) => machine,
            Err(Failure::Findings { diagnostics, .. }) => return Ok(Outcome::Findings(diagnostics)),
            Err(Failure::Trouble(trouble)) => return Ok(Outcome::ended(&trouble)),
            Err(other) => return Err(format!("the model is not built: {other:?}")),
        };
        match self.verb.as_str() {
            "simulate" => self.simulate(&mut machine, claims),
            "claims" => match studies::claims::run(&mut machine, &mut Watch::default()) {
                Some(results) => Ok(match &results.trouble {
                    Some(trouble) => Outcome::ended(trouble),
                    None => Outcome::Fields { own: results.fields().into(), data: results.data },
                }),
                None => Err("the model has no claims".into()),
            },
            "transient" => self.transient(&mut machine, claims),
            "equilibrium" => self.equilibrium(&mut machine),
            "modes" | "response" | "equilibria" => Ok(self.fields(&mut machine)),
            "section" => {
                let found = machine.model.sections.iter().find(|s| s.name == self.name).cloned();
                found.map(|s| Outcome::Section(Box::new(s))).ok_or_else(|| format!("no section `{}`", self.name))
            }
            "statics" if machine.model.structure.is_some() => Ok(self.fields(&mut machine)),
            "scheme" => Ok(drawn(&machine, &self.name)),
            "equations" | "check" => Ok(Outcome::Machine(Box::new(machine))),
            kind if studies::find(kind).is_some() => study(&mut machine, kind),
            other => Err(format!("unknown command `{other}`")),
        }
    }

    /// Instants of the whole motion, then those of the claims.
    fn times(&self, claims: &[&Claim]) -> Vec<f64> {
        let mut times: Vec<f64> = (0..=INSTANTS).map(|k| self.until * k as f64 / INSTANTS as f64).collect();
        for claim in claims {
            match claim {
                Claim::Value { when: When::At(t), .. } | Claim::NoValue { at: t, .. } => times.push(*t),
                Claim::MeanRate { from, to, .. } => times.extend([*from, *to]),
                _ => {}
            }
        }
        times
    }

    fn transient(&self, machine: &mut Machine, claims: &[&Claim]) -> Result<Outcome, String> {
        let times = self.times(claims);
        let motion = studies::simulate::Simulate {
            until: self.until,
            times: Times::At(times.clone()),
            tolerance: self.tolerance,
            method: Default::default(),
            outputs: machine.equations.outputs.iter().map(|o| o.name.clone()).collect(),
            plots: Vec::new(),
            windows: Vec::new(),
        };
        let study = studies::transient::Transient { motion, linearise: self.linearise };
        let (results, phases) = studies::transient::solved(machine, &study, &mut Watch::default());
        let results = studies::results::finite::checked(results);
        match &results.trouble {
            None => Ok(Outcome::Closed { times, data: results.data, phases }),
            Some(trouble) => Ok(Outcome::ended(trouble)),
        }
    }

    fn simulate(&self, machine: &mut Machine, claims: &[&Claim]) -> Result<Outcome, String> {
        let times = self.times(claims);
        // only what is claimed: another output may be undefined with the values that are set
        let wanted = claims.iter().filter_map(|claim| match claim {
            Claim::Extreme { name, .. } | Claim::Mean { name, .. } => Some(name.clone()),
            Claim::Value { name, .. }
            | Claim::NoValue { name, .. }
            | Claim::Bounded { name, .. }
            | Claim::Constant { name, .. }
            | Claim::MeanRate { name, .. } => Some(name.strip_prefix("shown ").unwrap_or(name).to_owned()),
            _ => None,
        });
        let fails = claims.iter().any(|claim| matches!(claim, Claim::Fails { .. }));
        let outputs = if fails { None } else { Some(wanted.collect()) };
        let events = studies::plan::events(&machine.model, &machine.equations);
        let pushes = studies::plan::pushes(&machine.model, &machine.equations);
        let options = Simulate {
            grid: Grid::At(times.clone()),
            tolerance: self.tolerance,
            method: self.method,
            outputs,
            events,
            pushes,
            ..Simulate::until(self.until)
        };
        let start = match machine.system.start() {
            Ok(start) => start,
            Err(fault) => return Ok(Outcome::Trouble { code: fault.code, what: fault.what.en.clone() }),
        };
        let outcome = simulate(&mut machine.system, &start, options);
        match outcome.fault {
            Some(fault) => Ok(Outcome::Trouble { code: fault.code, what: fault.what.en.clone() }),
            None => Ok(Outcome::Motion { times, data: outcome.dataset }),
        }
    }

    /// The study of the file of that kind, or the one that the command makes without.
    fn fields(&self, machine: &mut Machine) -> Outcome {
        let kind = match self.verb.as_str() {
            "equilibria" => "equilibrium",
            verb => studies::find(verb).map_or("", |study| study.kind().name),
        };
        let asked = studies::of_file(machine, &[kind]).cloned().unwrap_or_else(|| Asked::new(kind));
        match pipeline::study(machine, &asked, &mut Watch::default()) {
            Some(results) => match &results.trouble {
                Some(trouble) => Outcome::ended(trouble),
                None => {
                    let data = results.data.clone();
                    let mut own = results.fields();
                    let parameters: serde_json::Map<String, serde_json::Value> =
                        data.provenance.parameters.iter().map(|p| (p.quantity.name.clone(), p.value.into())).collect();
                    own.insert("parameters".into(), parameters.into());
                    Outcome::Fields { own: own.into(), data }
                }
            },
            None => Outcome::Trouble { code: "", what: "no study".into() },
        }
    }

    fn equilibrium(&self, machine: &mut Machine) -> Result<Outcome, String> {
        let mut guess = Vec::new();
        for (name, value) in &self.guess {
            let coordinate = machine.model.coordinates.iter().find(|c| c.name == *name);
            let coordinate = coordinate.ok_or_else(|| format!("no coordinate `{name}`"))?;
            guess.push((coordinate.symbols[0], quantity(value)?));
        }
        let results = studies::equilibrium::places(machine, &guess, None, &mut Watch::default());
        match &results.trouble {
            None => Ok(Outcome::Rest(results.data)),
            Some(trouble) => Ok(Outcome::ended(trouble)),
        }
    }
}

/// The first study of a kind that the model itself asks for.
fn study(machine: &mut Machine, kind: &str) -> Result<Outcome, String> {
    for study in machine.model.studies.clone() {
        if let Some(results) = pipeline::study(machine, &study, &mut Watch::default())
            && results.kind == kind
        {
            return Ok(match &results.trouble {
                Some(trouble) => Outcome::ended(trouble),
                None => Outcome::Study(Box::new(results)),
            });
        }
    }
    Err(format!("the model has no study `{kind}`"))
}

/// Every variant of a model.
fn variants(source: Source) -> Result<Outcome, String> {
    let reading = match studies::read(&source, &[]) {
        Ok(reading) => reading,
        Err(diagnostics) => return Ok(Outcome::Findings(diagnostics)),
    };
    let members = match strutt::variants::members(&reading.model, &source, None) {
        Ok(members) => members,
        Err(Failure::Trouble(t) | Failure::Misuse(t)) => return Ok(Outcome::ended(&t)),
        Err(other) => return Err(format!("no variants: {other:?}")),
    };
    let mut class = studies::variants::Class::new(source, mechanics::derive::Detail::Equations);
    let found = studies::variants::check(&mut class, &reading.model, &members, &mut Watch::default());
    Ok(Outcome::Fields { own: found.to_json(words::Language::En), data: Dataset::default() })
}

/// A quantity in SI; bare numbers are SI.
fn quantity(text: &str) -> Result<f64, String> {
    mechanics::units::parse_number_or_quantity(text).map(|q| q.to_f64()).map_err(|e| format!("{text}: {e:?}"))
}
