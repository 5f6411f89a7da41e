//! Runs the command of a trial and checks its claims.

use crate::chapter::Trial;
use crate::claim::{Claim, Tolerance, When, Which, parse};
use analysis::Dataset;
use analysis::studies::simulate::{Grid, Simulate, simulate};
use mechanics::asked::Asked;
use mechanics::model::Times;
use report::formula::{Form, Printer};
use studies::Results;
use studies::phases::Phases;
use studies::pipeline::{self, Machine};
use studies::{Failure, Source, Watch};
use symbolic::SymbolId;
use words::{Language, Notice};

/// Instants of claims about a whole motion.
const INSTANTS: usize = 200;
/// Default tolerance of the book.
const TOLERANCE: f64 = 1e-14;

/// Checks a trial; the message lists every claim that does not hold.
pub fn check(trial: &Trial) -> Result<(), String> {
    let mut complaints = Vec::new();
    let mut claims = Vec::new();
    if trial.claims.is_empty() {
        complaints.push("the expectation claims nothing".to_owned());
    }
    for (line, text) in &trial.claims {
        match parse(text) {
            Ok(claim) => claims.push((*line, text, claim)),
            Err(e) => complaints.push(format!("line {line}: {e}")),
        }
    }
    let command = Command::parse(&trial.command)?;
    let parsed: Vec<&Claim> = claims.iter().map(|c| &c.2).collect();
    let result = command.run(trial, &parsed)?;
    for (line, text, claim) in &claims {
        if let Err(e) = result.check(claim, &trial.model) {
            complaints.push(format!("line {line}: {text}\n    {e}"));
        }
    }
    if complaints.is_empty() { Ok(()) } else { Err(format!("{}:{}\n{}", trial.file.display(), trial.line, complaints.join("\n"))) }
}

/// The first study of a kind that the model itself asks for.
fn study(machine: &mut Machine, kind: &str) -> Result<Outcome, String> {
    for study in machine.model.studies.clone() {
        if let Some(results) = pipeline::study(machine, &study, &mut Watch::default())
            && results.kind == kind
        {
            return Ok(match &results.trouble {
                Some(trouble) => Outcome::Trouble { code: trouble.code, what: trouble.what.en.clone() },
                None => Outcome::Study(Box::new(results)),
            });
        }
    }
    Err(format!("the model has no study `{kind}`"))
}

/// A number of a study: `period`, `multipliers.1.abs`.
fn field(results: &Results, path: &str) -> Result<f64, String> {
    let fields = serde_json::Value::Object(results.fields());
    let whole = fields.get(path).cloned();
    let found = whole.or_else(|| {
        path.split('.').try_fold(fields.clone(), |at, key| match key.parse::<usize>() {
            Ok(i) => at.get(i).cloned(),
            Err(_) => at.get(key).cloned(),
        })
    });
    let names = || fields.as_object().map(|o| o.keys().cloned().collect::<Vec<_>>().join(", ")).unwrap_or_default();
    found.and_then(|v| v.as_f64()).ok_or_else(|| format!("no number `{path}`; there are {}", names()))
}

/// Values of a study's column at the places of its axis.
fn study_claim(results: &Results, claim: &Claim) -> Result<(), String> {
    let data = &results.data;
    if let Claim::Extreme { name, which: which @ (Which::Least | Which::Greatest), expected, tolerance } = claim {
        // statics names the ends of what friction leaves open as facts of their own
        let word = if matches!(which, Which::Least) { "least" } else { "greatest" };
        if let Ok(found) = field(results, &format!("{word} {name}")) {
            return tolerance.check(name, found, *expected);
        }
    }
    match claim {
        Claim::Field { path, text } => says(&json_field(&results.fields().into(), path)?, path, text),
        Claim::Rest { name, expected, tolerance } => tolerance.check(name, field(results, name)?, *expected),
        Claim::Value { name, when, expected, tolerance } => {
            let axis = data.axis.and_then(|i| data.columns.get(i)).ok_or("the study has no axis")?;
            let values = &data.column(name).ok_or_else(|| no_column(data, name))?.values;
            let last = axis.values.len().checked_sub(1).ok_or("the study has no rows")?;
            let range = (axis.values[last] - axis.values[0]).abs();
            let row = match when {
                When::End => last,
                When::At(x) => {
                    // the same value of the axis: rounding of a grid
                    let near = |v: &f64| (v - x).abs() <= 1e-12 * range.max(x.abs());
                    axis.values.iter().position(near).ok_or_else(|| format!("no row at {x}"))?
                }
            };
            tolerance.check(name, values[row], *expected)
        }
        claim => motion(&[], data, claim),
    }
}

/// The first line of an expectation.
struct Command {
    verb: String,
    until: f64,
    tolerance: f64,
    method: analysis::integrate::stiff::Method,
    set: Vec<(String, String)>,
    guess: Vec<(String, String)>,
    linearise: bool,
    /// Name of a section.
    name: String,
    /// Row of the table of variants.
    variant: Option<String>,
}

impl Command {
    fn parse(words: &[String]) -> Result<Command, String> {
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

    fn run(&self, trial: &Trial, claims: &[&Claim]) -> Result<Outcome, String> {
        // a table of variants stands beside the model of a page of the gallery
        let beside = trial.file.parent().filter(|folder| folder.components().any(|c| c.as_os_str() == "gallery"));
        let path = beside.map_or_else(|| "model.toml".into(), |folder| folder.join("model.toml"));
        let source = Source::new(&path.to_string_lossy(), &trial.model);
        if self.verb == "variants" {
            return variants(source);
        }
        let set = match self.overrides(&source) {
            Ok(set) => set,
            Err(Failure::Trouble(t) | Failure::Misuse(t)) => return Ok(Outcome::Trouble { code: t.code, what: t.what.en.clone() }),
            Err(other) => return Err(format!("no variant: {other:?}")),
        };
        let mut machine = match pipeline::build(&source, &set, &mut Watch::default()) {
            Ok(machine) => machine,
            Err(Failure::Findings { diagnostics, .. }) => return Ok(Outcome::Findings(diagnostics)),
            Err(Failure::Trouble(trouble)) => return Ok(Outcome::Trouble { code: trouble.code, what: trouble.what.en.clone() }),
            Err(other) => return Err(format!("the model is not built: {other:?}")),
        };
        match self.verb.as_str() {
            "simulate" => self.simulate(&mut machine, claims),
            "claims" => match studies::claims::run(&mut machine, &mut Watch::default()) {
                Some(results) => Ok(match &results.trouble {
                    Some(trouble) => Outcome::Trouble { code: trouble.code, what: trouble.what.en.clone() },
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
        };
        let study = studies::transient::Transient { motion, linearise: self.linearise };
        let (results, phases) = studies::transient::solved(machine, &study, &mut Watch::default());
        let results = studies::results::finite::checked(results);
        match &results.trouble {
            None => Ok(Outcome::Closed { times, data: results.data, phases }),
            Some(trouble) => Ok(Outcome::Trouble { code: trouble.code, what: trouble.what.en.clone() }),
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
                Some(trouble) => Outcome::Trouble { code: trouble.code, what: trouble.what.en.clone() },
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
            Some(trouble) => Ok(Outcome::Trouble { code: trouble.code, what: trouble.what.en.clone() }),
        }
    }
}

/// Every variant of a model.
fn variants(source: Source) -> Result<Outcome, String> {
    let reading = match studies::read(&source, &[]) {
        Ok(reading) => reading,
        Err(diagnostics) => return Ok(Outcome::Findings(diagnostics)),
    };
    let members = match strutt::variants::members(&reading.model, &source, None) {
        Ok(members) => members,
        Err(Failure::Trouble(t) | Failure::Misuse(t)) => return Ok(Outcome::Trouble { code: t.code, what: t.what.en.clone() }),
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

/// What a command gave.
enum Outcome {
    Findings(Vec<Notice>),
    Trouble { code: &'static str, what: String },
    Machine(Box<Machine>),
    Motion { times: Vec<f64>, data: Dataset },
    Rest(Dataset),
    Fields { own: serde_json::Value, data: Dataset },
    Section(Box<mechanics::section::Section>),
    Closed { times: Vec<f64>, data: Dataset, phases: Phases },
    Study(Box<Results>),
}

impl Outcome {
    fn check(&self, claim: &Claim, model: &str) -> Result<(), String> {
        match (self, claim) {
            (Outcome::Findings(diagnostics), Claim::Error { code, line, only }) => findings(model, diagnostics, code, *line, *only),
            (Outcome::Machine(machine), Claim::Warning { code, line }) => findings(model, &machine.warnings, code, *line, false),
            (Outcome::Findings(list), Claim::Help { code, text }) => help(list, code, text),
            (Outcome::Machine(machine), Claim::Help { code, text }) => help(&machine.warnings, code, text),
            (Outcome::Machine(machine), Claim::Warnings(count)) => {
                let found: Vec<String> = machine.warnings.iter().map(|d| format!("{}: {}", d.code, d.what.en)).collect();
                if found.len() == *count { Ok(()) } else { Err(format!("{} warnings: {}", found.len(), found.join("; "))) }
            }
            (Outcome::Trouble { code, what }, Claim::Fails { code: expected, text })
                if code == expected && what.contains(text.as_str()) =>
            {
                Ok(())
            }
            (Outcome::Fields { own, .. }, Claim::Rest { name, expected, tolerance }) => {
                let found = json_field(own, name)?.as_f64().unwrap_or(f64::NAN);
                tolerance.check(name, found, *expected)
            }
            (Outcome::Fields { own, .. }, Claim::Field { path, text }) => says(&json_field(own, path)?, path, text),
            (Outcome::Fields { data, .. }, claim) => motion(&[], data, claim),
            (Outcome::Motion { times, data }, claim) => motion(times, data, claim),
            (Outcome::Closed { phases, .. }, Claim::PhaseConstant { phase, key, expected, tolerance }) => {
                tolerance.check(key, constant_of(phases, *phase, key)?, *expected)
            }
            (Outcome::Closed { phases, .. }, Claim::PhaseCase { phase, case }) => case_of(phases, *phase, case),
            (Outcome::Closed { times, data, .. }, claim) => motion(times, data, claim),
            (Outcome::Machine(machine), claim) => equations(machine, claim),
            (Outcome::Section(section), Claim::Rest { name, expected, tolerance }) => {
                let found = studies::sections::property(section, name).ok_or_else(|| format!("no property `{name}`"))?;
                tolerance.check(name, found, *expected)
            }
            (Outcome::Study(results), claim) => study_claim(results, claim),
            (Outcome::Rest(data), claim @ (Claim::Audit { .. } | Claim::AuditFails(_) | Claim::AuditsOk)) => motion(&[], data, claim),
            (Outcome::Rest(data), Claim::Open(name)) => {
                let column = data.column(name).ok_or_else(|| no_column(data, name))?;
                let open = |v: &f64| v.is_nan() && data.explains(name, *v);
                let all = !column.values.is_empty() && column.values.iter().all(open);
                if all { Ok(()) } else { Err(format!("{name}: {:?}, or nothing says why it is empty", column.values)) }
            }
            (Outcome::Rest(data), Claim::Rest { name, expected, tolerance }) => {
                let column = data.column(name).ok_or_else(|| no_column(data, name))?;
                // several equilibria may be found; the claim is about the nearest
                let distance = |v: &f64| (v - expected).abs();
                let found = column.values.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b)));
                tolerance.check(name, found.unwrap_or(f64::NAN), *expected)
            }
            (other, _) => Err(format!("does not hold: {}", other.summary())),
        }
    }

    fn summary(&self) -> String {
        match self {
            Outcome::Findings(diagnostics) => {
                let list: Vec<String> = diagnostics.iter().map(|d| format!("{}: {}", d.code, d.what.en)).collect();
                format!("the model has findings: {}", list.join("; "))
            }
            Outcome::Trouble { code, what } => format!("ended with {code}: {what}"),
            Outcome::Machine(_) => "the model is accepted".into(),
            Outcome::Motion { .. } => "the motion was computed".into(),
            Outcome::Fields { .. } => "the study was made".into(),
            Outcome::Section(_) => "the section was computed".into(),
            Outcome::Closed { .. } => "the closed form was found".into(),
            Outcome::Rest(_) => "an equilibrium was found".into(),
            Outcome::Study(results) => format!("the study {} was made", results.kind),
        }
    }
}

/// A constant of a phase as the JSON of the study names it; of the first mode when there are several.
fn constant_of(phases: &Phases, number: usize, key: &str) -> Result<f64, String> {
    let phase = phases.list.get(number.wrapping_sub(1)).ok_or_else(|| format!("there are {} phases", phases.list.len()))?;
    match key {
        "start" => return Ok(phase.start),
        "end" => return Ok(phase.end),
        _ => {}
    }
    let (mode, key) = key.split_once('.').map_or((1, key), |(mode, key)| (mode.parse().unwrap_or(1), key));
    let listed = phase.listed();
    let mode = listed.get(mode - 1).ok_or_else(|| format!("there are {} modes", listed.len()))?;
    let named = mode.named();
    let found = named.iter().find(|(name, _)| *name == key).map(|(_, value)| *value);
    found.ok_or_else(|| format!("constants: {}", named.iter().map(|n| n.0).collect::<Vec<_>>().join(", ")))
}

fn case_of(phases: &Phases, number: usize, case: &str) -> Result<(), String> {
    let phase = phases.list.get(number.wrapping_sub(1)).ok_or_else(|| format!("there are {} phases", phases.list.len()))?;
    let listed = phase.listed();
    let name = listed.first().map_or("coupled", |l| if l.constants.resonance { "resonance" } else { l.constants.case.name() });
    if name == case { Ok(()) } else { Err(format!("the case is {name}")) }
}

fn help(diagnostics: &[Notice], code: &str, text: &str) -> Result<(), String> {
    let helps: Vec<&str> = diagnostics.iter().filter(|d| d.code == code).map(|d| d.help.en.as_str()).collect();
    if helps.iter().any(|h| h.contains(text)) { Ok(()) } else { Err(format!("helps: {}", helps.join("; "))) }
}

fn findings(model: &str, diagnostics: &[Notice], code: &str, line: Option<usize>, only: bool) -> Result<(), String> {
    let line_of = |d: &Notice| d.span().map(|s| model[..s.start].matches('\n').count() + 1);
    let found: Vec<String> = diagnostics.iter().map(|d| format!("{} in line {}", d.code, line_of(d).unwrap_or(0))).collect();
    let fits = |d: &Notice| d.code == code && line.is_none_or(|l| line_of(d) == Some(l));
    let holds = diagnostics.iter().any(fits) && (!only || diagnostics.iter().all(fits));
    match &found[..] {
        _ if holds => Ok(()),
        [] => Err("nothing was found".into()),
        list => Err(format!("found {}", list.join(", "))),
    }
}

/// Whether a field is this text.
fn says(found: &serde_json::Value, path: &str, text: &str) -> Result<(), String> {
    let found = found.as_str().map_or_else(|| found.to_string(), str::to_owned);
    if found == text { Ok(()) } else { Err(format!("{path} is {found}")) }
}

/// The field at a path: `modes[1].shape.phi`, counted from 1; `length(modes)` is a number of entries.
fn json_field(own: &serde_json::Value, path: &str) -> Result<serde_json::Value, String> {
    if let Some(inner) = path.strip_prefix("length(").and_then(|p| p.strip_suffix(')')) {
        return Ok(json_field(own, inner)?.as_array().map_or(0, Vec::len).into());
    }
    let mut at = own;
    for step in path.split(['.', '[']) {
        let next = match step.strip_suffix(']') {
            Some(index) => index.parse::<usize>().ok().and_then(|i| at.get(i.wrapping_sub(1))),
            None => at.get(step),
        };
        at = next.ok_or_else(|| format!("no field `{path}` (at `{step}`)"))?;
    }
    Ok(at.clone())
}

fn no_column(data: &Dataset, name: &str) -> String {
    let names: Vec<&str> = data.columns.iter().map(|c| c.quantity.name.as_str()).collect();
    format!("no column `{name}`; there are {}", names.join(", "))
}

fn motion(times: &[f64], data: &Dataset, claim: &Claim) -> Result<(), String> {
    let values = |name: &str| data.column(name).map(|c| &c.values[..]).ok_or_else(|| no_column(data, name));
    match claim {
        Claim::Value { name, when, expected, tolerance } => {
            let row = match when {
                When::At(t) => times.iter().rposition(|x| x == t),
                When::End => last_row(data),
            };
            let row = row.ok_or("the instant was not asked for")?;
            let column = name.strip_prefix("shown ").unwrap_or(name);
            let unit = data.column(column).and_then(|c| c.quantity.display.as_ref()).map_or(1.0, |(_, size)| *size);
            let found = values(column)?.get(row).copied().unwrap_or(f64::NAN);
            tolerance.check(name, if column == name { found } else { found / unit }, *expected)
        }
        Claim::Extreme { name, which, expected, tolerance } => {
            let e = data.extreme(name).ok_or_else(|| no_column(data, name))?;
            let found = match which {
                Which::Least => e.min,
                Which::LeastAt => e.t_min,
                Which::Greatest => e.max,
                Which::GreatestAt => e.t_max,
            };
            tolerance.check(name, found, *expected)
        }
        Claim::Mean { name, expected, tolerance } => {
            let found = data.overall(name).ok_or_else(|| no_column(data, name))?.mean();
            tolerance.check(&format!("mean of {name}"), found, *expected)
        }
        Claim::AuditFails(key) => match data.audits.iter().find(|a| a.key == *key) {
            Some(audit) if !audit.ok => Ok(()),
            Some(audit) => Err(format!("it passes with {:.3e}", audit.value)),
            None => Err(format!("audits: {:?}", data.audits.iter().map(|a| &a.key).collect::<Vec<_>>())),
        },
        Claim::Bounded { name, limit } => {
            // not-a-number must not pass as small
            let largest = values(name)?.iter().fold(0.0f64, |m, v| if v.is_nan() { f64::INFINITY } else { m.max(v.abs()) });
            if largest < *limit { Ok(()) } else { Err(format!("largest |{name}| is {largest:.3e}")) }
        }
        Claim::MeanRate { name, from, to, expected, tolerance } => {
            let at = |t: &f64| times.iter().rposition(|x| x == t).and_then(|row| values(name).ok()?.get(row).copied()).unwrap_or(f64::NAN);
            tolerance.check(&format!("mean rate of {name}"), (at(to) - at(from)) / (to - from), *expected)
        }
        Claim::Constant { name, tolerance } => constant(name, values(name)?, *tolerance),
        Claim::Event { number, at, tolerance } => {
            let event = data.events.get(number - 1).ok_or_else(|| format!("there are {} events", data.events.len()))?;
            Tolerance { size: *tolerance, relative: false }.check("t", event.t, *at)
        }
        Claim::Says { event, text } => {
            let event = data.events.get(event - 1).ok_or_else(|| format!("there are {} events", data.events.len()))?;
            if event.what.en == *text { Ok(()) } else { Err(format!("it says: {}", event.what.en)) }
        }
        Claim::Impulse { name, event, expected, tolerance } => {
            let event = data.events.get(event - 1).ok_or_else(|| format!("there are {} events", data.events.len()))?;
            let names = || event.impulses.iter().map(|p| p.name.as_str()).collect::<Vec<_>>().join(", ");
            let found = event.impulses.iter().find(|p| p.name == *name).ok_or_else(|| format!("impulses: {}", names()))?;
            tolerance.check(name, found.value, *expected)
        }
        Claim::OpenImpulse { name, event } => {
            let event = data.events.get(event - 1).ok_or_else(|| format!("there are {} events", data.events.len()))?;
            match event.impulses.iter().find(|p| p.name == *name) {
                Some(found) if found.value.is_nan() => Ok(()),
                found => Err(format!("{name}: {:?}", found.map(|p| p.value))),
            }
        }
        Claim::NoValue { name, at } => {
            let row = times.iter().rposition(|x| x == at).ok_or("the instant was not asked for")?;
            let found = values(name)?.get(row).copied().ok_or("the motion ended before")?;
            match (found.is_nan(), data.explains(name, found)) {
                (true, true) => Ok(()),
                (true, false) => Err("nothing says why it is empty".into()),
                _ => Err(format!("{name} is {found:e}")),
            }
        }
        Claim::Note(text) if data.notes.iter().any(|note| note.en.contains(text.as_str())) => Ok(()),
        Claim::NoNote(text) if !data.notes.iter().any(|note| note.en.contains(text.as_str())) => Ok(()),
        Claim::Note(_) | Claim::NoNote(_) => Err(format!("notes: {:?}", data.notes.iter().map(|note| &note.en).collect::<Vec<_>>())),
        Claim::Events(count) if data.events.len() == *count => Ok(()),
        Claim::Events(_) => {
            Err(format!("there are {} events: {:?}", data.events.len(), data.events.iter().map(|e| e.t).collect::<Vec<_>>()))
        }
        Claim::Audit { name, limit } => {
            let audit = data.audits.iter().find(|a| a.name.en == *name || a.key == *name || a.key == name.replace(' ', "_"));
            let audit = audit.ok_or_else(|| format!("audits: {:?}", data.audits.iter().map(|a| &a.name.en).collect::<Vec<_>>()))?;
            if audit.value < *limit { Ok(()) } else { Err(format!("the audit has {:.3e}", audit.value)) }
        }
        Claim::AuditsOk => match data.audits.iter().find(|a| !a.ok) {
            Some(a) => Err(format!("{}: {:.3e} above {:.1e}", a.name.en, a.value, a.limit)),
            None if data.audits.is_empty() => Err("no audits".into()),
            None => Ok(()),
        },
        _ => Err("the motion was computed".into()),
    }
}

/// The row of the latest instant: an event may have ended the motion before the time asked for.
fn last_row(data: &Dataset) -> Option<usize> {
    let times = &data.columns.get(data.axis?)?.values;
    (0..times.len()).max_by(|a, b| times[*a].total_cmp(&times[*b]))
}

fn constant(name: &str, values: &[f64], tolerance: Tolerance) -> Result<(), String> {
    let first = values.first().copied().unwrap_or(f64::NAN);
    let spread = values.iter().fold(0.0f64, |m, v| if v.is_nan() { f64::INFINITY } else { m.max((v - first).abs()) });
    let size = values.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    let allowed = if tolerance.relative { tolerance.size * size } else { tolerance.size };
    if spread <= allowed { Ok(()) } else { Err(format!("{name} varies by {spread:.3e}, allowed {allowed:.3e}")) }
}

fn equations(machine: &Machine, claim: &Claim) -> Result<(), String> {
    let equations = &machine.equations;
    let printer = Printer::of(equations, Language::En).with_width(100_000);
    let same = |found: String, expected: &str| {
        let plain = |s: &str| s.split_whitespace().collect::<Vec<_>>().join(" ");
        if plain(&found) == plain(expected) { Ok(()) } else { Err(format!("printed {}", plain(&found))) }
    };
    match claim {
        Claim::Equation { number, text } => {
            let list = equations.textbook.as_ref().map_err(|e| e.en.clone())?;
            let equality = *list.get(number - 1).ok_or("no such equation")?;
            same(printer.equality(&equations.graph, equality, Some(number - 1), Form::Text), text)
        }
        Claim::Energy { kind, text } => {
            let e = &equations.energy;
            let e = match *kind {
                "kinetic:" => e.kinetic,
                "potential:" => e.potential,
                _ => e.dissipation,
            };
            same(printer.expression(&equations.graph, e, Form::Text), text)
        }
        Claim::Inertia { name, expected, tolerance } => {
            let i = equations.coordinates.iter().position(|c| equations.graph.symbol_info(c.symbols[0]).name == *name);
            let i = i.ok_or_else(|| format!("no coordinate `{name}`"))?;
            tolerance.check("inertia", at_start(machine, equations.mass.get(i, i)), *expected)
        }
        _ => Err("the model is accepted".into()),
    }
}

/// The value of an expression at the start of the motion, by the plain evaluator of the graph.
fn at_start(machine: &Machine, e: symbolic::Expr) -> f64 {
    let equations = &machine.equations;
    let mut values = vec![0.0; equations.graph.symbol_count()];
    equations.parameters.iter().for_each(|p| values[p.symbol.index()] = p.value);
    for d in &equations.definitions {
        let known = |s: SymbolId| values[s.index()];
        values[d.symbol.index()] = equations.graph.evaluate(&[d.formula], &known)[0];
    }
    for c in &equations.coordinates {
        let known = |s: SymbolId| values[s.index()];
        let start = equations.graph.evaluate(&[c.start, c.rate], &known);
        (values[c.symbols[0].index()], values[c.symbols[1].index()]) = (start[0], start[1]);
    }
    equations.graph.evaluate(&[e], &|s| values[s.index()])[0]
}
