//! The study `periodic`: the exact periodic regime, and the parameter that gives a wanted period.

mod told;

pub(crate) use told::multiplier_words;

use super::keys::{AT, EVERY, OUTPUTS, PERIOD, PLOT, SECTION, SETTLE, TOLERANCE, TURNS, turns_of_no_angle};
use super::section::of_state;
use super::{Conclusion, Fact, Finds, Found, Given, Interrupts, Repeats, Results, Rows, Study, overlaid, turns_of_an_angle};
use crate::failure::in_words;
use crate::machine::{Machine, explained};
use crate::plan;
use crate::results::finite::checked;
use crate::watch::{Lap, Watch};
use crate::{Failure, provenance};
use analysis::fault::codes;
use analysis::studies::periodic::{Aim, Listener, Multiplier, Outcome, Periodic as Options, Regime, Return, Stage};
use analysis::studies::simulate::Grid;
use mechanics::asked::{Asked, Key, Kind, Objection, Takes, Value as Taken, Words};
use mechanics::model::{Plot, Times};
use serde_json::{Value, json};
use std::cell::RefCell;
use symbolic::{Expr, SymbolId};
use told::{in_parts, least, one_of_a_family, verdict};
use words::{Language, Notice, Text};

/// Steps of the search for a parameter.
const STEPS: usize = 60;
/// The wanted period is kept to this share.
const EXACT: f64 = 1e-13;

/// A periodic motion to find; SI.
#[derive(Clone, Debug)]
pub struct Periodic {
    /// What begins a period.
    pub section: Section,
    /// The period, where the section is a time; otherwise a guess.
    pub period: Option<f64>,
    /// Duration of an ordinary motion before the search begins.
    pub settle: f64,
    /// Parameter that is changed so that the period becomes the second value.
    pub tuned: Option<(String, f64)>,
    /// Relative tolerance of the integrator.
    pub tolerance: f64,
    /// Times at which results are wanted, counted from the section.
    pub times: Times,
    /// Outputs wanted, by name (also coordinates and rates); empty means all.
    pub outputs: Vec<String>,
    /// Plots wanted.
    pub plots: Vec<Plot>,
    /// At how many instants of the period the coefficients of the variational equations are wanted.
    pub coefficients: usize,
}

/// The surface at which a periodic motion begins and ends.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Section {
    /// The loads repeat in time: the period is given, the state is what returns.
    Time,
    /// The formula over coordinates, rates and time passes zero from below.
    Zero(Expr),
    /// The angle has grown by so many turns of 2π; the section passes through its start. All other coordinates return.
    Turns {
        /// The angle.
        angle: SymbolId,
        /// How many turns; negative when it falls.
        turns: f64,
    },
}

impl Periodic {
    /// The regime that is asked for.
    pub fn of(asked: &Asked) -> Periodic {
        let section = match asked.get("section") {
            Some(Taken::Coordinate(angle)) => Section::Turns { angle: angle.symbol, turns: asked.number("turns").unwrap_or(1.0) },
            Some(Taken::Formula(zero)) => Section::Zero(*zero),
            _ => Section::Time,
        };
        Periodic {
            section,
            period: asked.number("period"),
            settle: asked.number("settle").unwrap_or(0.0),
            tuned: asked.word("unknown").map(str::to_owned).zip(asked.number("wanted_period")),
            tolerance: asked.number("tolerance").unwrap_or(super::simulate::TOLERANCE),
            times: asked.times(),
            outputs: asked.words("outputs").to_vec(),
            plots: asked.plots().to_vec(),
            coefficients: 0,
        }
    }
}

/// The study.
pub struct Regimes;

/// Its name and its keys.
pub static KIND: Kind = Kind::new(
    "periodic",
    (
        "Find the exact periodic regime: period, multipliers, motion over one period",
        "Найти точный периодический режим: период, мультипликаторы, движение за период",
    ),
)
.keys(&[
    SECTION,
    TURNS,
    PERIOD,
    SETTLE,
    Key::new(
        "unknown",
        Takes::Sought,
        (
            "parameter found from the wanted period; the value holds for this study alone",
            "искомый параметр: по нужному периоду; найденное значение действует только в этом расчёте",
        ),
        "\"F0\"",
    )
    .option("Parameter that is changed until the period is the wanted one", "Параметр, который меняется, пока период не станет нужным")
    .needs("wanted_period"),
    Key::new(
        "wanted_period",
        Takes::Duration,
        ("period that `unknown` must give", "период, который должен дать `unknown`"),
        "\"0.2568 s\"",
    )
    .option("Wanted period", "Нужный период")
    .needs("unknown"),
    AT,
    EVERY,
    OUTPUTS,
    TOLERANCE,
    PLOT,
])
.check(objections);

fn objections(asked: &Asked) -> Vec<Objection> {
    let mut found = Vec::new();
    if asked.has("wanted_period") != asked.has("unknown") {
        found.push(
            Objection::whole("M071", "`unknown` and `wanted_period` go together", "`unknown` и `wanted_period` задают вместе")
                .why("one parameter is changed until the period is the wanted one", "один параметр меняется, пока период не станет нужным")
                .help(
                    "write unknown = \"F0\" and wanted_period = \"0.2568 s\"",
                    "напишите unknown = \"F0\" и wanted_period = \"0,2568 с\"",
                ),
        );
    }
    if !asked.has("section") && !asked.has("period") {
        found.push(
            Objection::whole("M071", "the study periodic lacks `section` or `period`", "в расчёте periodic нет ни `section`, ни `period`")
                .why(
                    "a free motion returns to a section, a forced one after the period of the force",
                    "свободное движение возвращается к сечению, вынужденное — через период силы",
                )
                .help(
                    "add section = \"phi\" (an angle: one turn), section = \"x - x0\" (passes zero from below), or period = \"2*pi/Omega\"",
                    "добавьте section = \"phi\" (угол: один оборот), section = \"x - x0\" (переход через нуль снизу) или period = \"2*pi/Omega\"",
                ),
        );
    }
    found.extend(turns_of_no_angle(asked));
    found
}

impl Study for Regimes {
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn wanted(&self) -> Words {
        ("find the periodic regime and its stability", "найти периодический режим и исследовать его устойчивость")
    }
    fn finds(&self) -> Finds {
        Finds::Regime
    }
    fn concludes(&self, _: &Machine, results: &Results, _: Language) -> Vec<Conclusion> {
        let period = results.facts.iter().find(|f| f.quantity.name == "period").map(|f| f.value);
        let stable = results.own.get("stable").and_then(serde_json::Value::as_bool);
        period.zip(stable).map(|(period, stable)| Conclusion::Regime { period, stable }).into_iter().collect()
    }
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        let study = Periodic::of(asked);
        // what is tuned is this study's machine, not that of the studies behind it
        let mut own = study.tuned.is_some().then(|| machine.clone());
        Some(exact(own.as_mut().unwrap_or(machine), &study, watch))
    }
    /// What the file says, changed by the command line; a turn or a return found by itself when nobody says what a period is.
    fn merge(&self, _: &Machine, given: Given) -> Result<Asked, Failure> {
        let asked = overlaid(&KIND, given.written.or(given.of_file).unwrap_or_else(|| Asked::new(KIND.name)), given.line);
        turns_of_an_angle(given.line, &asked)?;
        Ok(asked)
    }
    fn interrupts(&self) -> Interrupts {
        Interrupts::Kept
    }
    fn repeats(&self) -> Repeats {
        Repeats::Motion
    }
}

/// Runs the study. `tuned` changes the machine to the value found.
pub fn exact(machine: &mut Machine, study: &Periodic, watch: &mut Watch) -> Results {
    let found = match &study.tuned {
        None => Ok((regime(machine, study, watch), None)),
        Some((name, wanted)) => tuned(machine, study, name, *wanted, watch),
    };
    watch.lap(Lap::Run);
    checked(match found {
        Ok((outcome, tuning)) => results(machine, study, outcome, tuning),
        Err(trouble) => Results::failed(KIND.name, heading(), trouble),
    })
}

/// Times of ordinary motion tried before the search when the start leads to no regime, s.
const WAITS: [f64; 3] = [2.0, 20.0, 200.0];

fn heading() -> Text {
    Text::new("Periodic regime", "Периодический режим")
}

/// The regime of the machine as it is.
pub fn regime(machine: &mut Machine, study: &Periodic, watch: &mut Watch) -> Outcome {
    let start = match machine.system.start() {
        Ok(start) => start,
        Err(fault) => return Outcome { fault: Some(fault), ..Outcome::default() },
    };
    let first = from(machine, study, &start, watch);
    let lost = first.fault.as_ref().is_some_and(|f| [codes::NEVER_BACK, codes::NO_REGIME].contains(&f.code));
    if !lost || study.settle > 0.0 {
        return first;
    }
    let mut rest = None;
    // a start far from the regime: let the motion come near it, and longer
    for settle in WAITS {
        if watch.is_interrupted() {
            break;
        }
        let outcome = from(machine, &Periodic { settle, ..study.clone() }, &start, watch);
        if outcome.fault.is_none() {
            return outcome;
        }
        if outcome.fault.as_ref().is_some_and(|f| f.code == codes::NEVER_BACK) {
            rest.get_or_insert(outcome);
        }
    }
    // one that a turn magnifies beyond all digits comes back to none of its starts
    let parts = sought(machine, (study, Aim::Parts), &start, watch);
    if parts.fault.is_none() {
        return parts;
    }
    // a motion that never comes back says more than one that has not settled yet
    match rest {
        Some(rest) if first.fault.as_ref().is_some_and(|f| f.code == codes::NO_REGIME) => rest,
        _ => first,
    }
}

/// What a search does, in words.
fn in_progress(stage: Stage) -> Text {
    let short = |x: f64| {
        let en = report::number::short(x, 3, words::Language::En);
        (en.clone(), en.replace('.', ","))
    };
    let both = |x: f64, en: &str, ru: &str| {
        let (x_en, x_ru) = short(x);
        Text::new(en.replace("{}", &x_en), ru.replace("{}", &x_ru))
    };
    match stage {
        Stage::Settling(t, of) => both(100.0 * t / of, "settling before the search: {} %", "установление перед поиском: {} %"),
        Stage::Following(t) => both(t, "following the motion to its section: t = {} s", "движение до сечения: t = {} с"),
        Stage::Varying(share) => both(100.0 * share, "variations of a turn: {} %", "вариации оборота: {} %"),
        Stage::Turned(turn, miss) => both(
            miss,
            &format!("turn {turn}: the start is missed by {{}} of the range"),
            &format!("оборот {turn}: до начала не хватает {{}} размаха"),
        ),
    }
}

/// By what the motion returns, and how many times it does so in a period.
pub(super) fn returns(study: &Periodic, equations: &symbolic::Equations) -> (Return, usize) {
    match (study.section, study.period) {
        (Section::Time, Some(period)) => (Return::Period(period), 1),
        (Section::Turns { angle, turns }, _) => {
            let name = equations.graph.symbol_info(angle).name.clone();
            (Return::State(name), (turns.abs().round() as usize).max(1))
        }
        _ => (Return::Automatic, 1),
    }
}

/// The regime found from a state.
pub fn from(machine: &mut Machine, study: &Periodic, start: &[f64], watch: &mut Watch) -> Outcome {
    sought(machine, (study, Aim::Whole), start, watch)
}

fn sought(machine: &mut Machine, (study, aim): (&Periodic, Aim), start: &[f64], watch: &mut Watch) -> Outcome {
    let formula = match study.section {
        Section::Zero(expr) => Some(of_state(&machine.equations, expr)),
        _ => None,
    };
    let (by, returns) = returns(study, &machine.equations);
    let grid = match &study.times {
        Times::Automatic => Grid::Auto,
        Times::Every(step) => Grid::Every(*step),
        Times::At(times) => Grid::At(times.clone()),
    };
    let plotted = plan::columns_with_plots(&study.outputs, &study.plots, &machine.equations);
    let doing = RefCell::new(watch.doing.as_mut());
    let told = |stage: Stage| {
        if let Some(doing) = &mut *doing.borrow_mut() {
            doing(in_progress(stage));
        }
    };
    let events = plan::events(&machine.model, &machine.equations);
    let pushes = plan::pushes(&machine.model, &machine.equations);
    let options = Options {
        by,
        returns,
        begin: formula.as_ref().map(|f| f as &dyn Fn(f64, &[f64]) -> f64),
        settle: study.settle,
        // multipliers lose digits of the motion: it is followed more closely than it is shown
        tolerance: study.tolerance.min(1e-13),
        grid,
        outputs: Some(plotted),
        events: &events,
        pushes: &pushes,
        listener: Listener { interrupt: watch.interrupt, told: Some(&told) },
        coefficients: study.coefficients,
        aim,
        longest: longest(study),
        ..Options::default()
    };
    let mut outcome = (analysis::made::PERIODIC)(&mut machine.system, start, &options);
    let forced = outcome.fault.as_ref().is_some_and(|f| f.code == codes::FORCED);
    if forced && study.period.is_some() && study.section != Section::Time {
        // the period is given, and it is the section that cannot be
        outcome.fault = Some(analysis::studies::periodic::section_of_forced());
    }
    outcome
}

/// How long a motion may take to come back at least, s: a multiple of what is given of its time.
fn longest(study: &Periodic) -> f64 {
    const TIMES: f64 = 100.0;
    let given = [study.period, study.tuned.as_ref().map(|(_, wanted)| *wanted), Some(study.settle)];
    given.into_iter().flatten().fold(Options::default().longest, |longest, time| longest.max(TIMES * time))
}

/// A parameter with its value, found for a wanted period.
pub(super) struct Tuning {
    name: String,
    value: f64,
}

/// Changes a parameter until the period is the wanted one: secant steps on logarithmic scale near the value of the file.
fn tuned(machine: &mut Machine, study: &Periodic, name: &str, wanted: f64, watch: &mut Watch) -> Result<(Outcome, Option<Tuning>), Notice> {
    let first = machine.number(name)?;
    let mut tried = machine.clone();
    let mut at = |value: f64, watch: &mut Watch| -> Result<(Machine, Outcome), Notice> {
        tried.bind(&[(name, value)]).map_err(in_words)?;
        let mut other = tried.clone();
        let study = reread(machine, &other, study);
        let outcome = regime(&mut other, &study, watch);
        if let Some(fault) = &outcome.fault {
            return Err(Notice::from(fault.clone()));
        }
        Ok((other, outcome))
    };
    // a thousandth: far above the digits of a period, far below where it bends
    let step = if first == 0.0 { 1e-3 } else { 1e-3 * first };
    let (mut a, mut b) = (first, first + step);
    let mut miss_a = at(a, watch)?.1.regime.period - wanted;
    let mut best: Option<(f64, f64, Machine, Outcome)> = None;
    for _ in 0..STEPS {
        let (other, outcome) = at(b, watch)?;
        let miss = outcome.regime.period - wanted;
        let better = best.as_ref().is_none_or(|(least, ..)| miss.abs() < *least);
        if better {
            best = Some((miss.abs(), b, other, outcome));
        }
        let slope = (miss - miss_a) / (b - a);
        // where the digits of a period end: what comes no nearer there has arrived
        if miss.abs() <= EXACT * wanted || slope == 0.0 || !slope.is_finite() || !better && miss.abs() < 1e-11 * wanted {
            break;
        }
        // never more than half of the value at once: the regime must stay within reach
        let limit = 0.5 * b.abs().max(first.abs()).max(step.abs());
        let change = (-miss / slope).clamp(-limit, limit);
        (a, miss_a, b) = (b, miss, b + change);
    }
    match best {
        // nine digits of a wanted period are what anybody can use
        Some((miss, value, other, outcome)) if miss <= 1e-9 * wanted => {
            let keep = (machine.model_hash.clone(), machine.origin.clone());
            *machine = other;
            (machine.model_hash, machine.origin) = keep;
            Ok((outcome, Some(Tuning { name: name.to_owned(), value })))
        }
        _ => Err(Notice::new(
            "S045",
            format!("no value of `{name}` gives the period {wanted} s"),
            format!("ни при каком значении `{name}` период не равен {wanted} с").replace('.', ","),
        )
        .why("the period does not depend on the parameter, or not enough", "период не зависит от параметра или зависит слабо")
        .help("choose another parameter, or a period near the present one", "выберите другой параметр или период, близкий к нынешнему")),
    }
}

/// The study as it reads with other values of parameters: its formulas may depend on them.
pub fn reread(machine: &Machine, other: &Machine, study: &Periodic) -> Periodic {
    let of = |machine: &Machine| -> Vec<Periodic> {
        machine.model.studies.iter().filter(|asked| asked.kind == KIND.name).map(Periodic::of).collect()
    };
    let place = of(machine).iter().position(|p| p.section == study.section && p.period == study.period);
    match place.and_then(|k| of(other).get(k).cloned()) {
        // what the command line says of the rest holds
        Some(fresh) => Periodic { section: fresh.section, period: fresh.period, ..study.clone() },
        None => study.clone(),
    }
}

/// What was found, for people and machines.
pub(super) fn results(machine: &Machine, study: &Periodic, outcome: Outcome, tuning: Option<Tuning>) -> Results {
    let Outcome { regime, fault } = outcome;
    let trouble = fault.map(|fault| explained(fault, &machine.equations));
    let mut results =
        Results { kind: KIND.name, heading: heading(), plots: study.plots.clone(), rows: Rows::Summary, ..Results::default() };
    results.data = provenance::stamp(regime.dataset.clone(), &machine.equations, &machine.model_hash);
    if trouble.is_none() {
        facts(&mut results, machine, &regime, tuning);
    }
    results.trouble = trouble;
    results
}

fn facts(results: &mut Results, machine: &Machine, regime: &Regime, tuning: Option<Tuning>) {
    let text = Text::new;
    results.facts.push(Fact::new("period", "T", "s", regime.period, text("period", "период")));
    let label = text("frequency of the regime", "частота режима");
    results.facts.push(Fact::new("frequency", "f", "Hz", 1.0 / regime.period, label));
    for (k, m) in regime.multipliers.iter().enumerate() {
        let words = multiplier_words(m);
        let label = Text::new(format!("multiplier {}", k + 1), format!("мультипликатор {}", k + 1));
        let fact = Fact::new(&format!("multiplier_{}", k + 1), &format!("mu_{}", k + 1), "1", shown(m), label);
        results.facts.push(fact.with_words(words));
    }
    if let Some(tuning) = &tuning {
        let declared = machine.model.parameters.iter().find(|p| p.name == tuning.name);
        let unit = declared.map_or("1", |p| p.unit.as_str());
        let symbol = machine.model.notation.iter().find(|(n, _)| *n == tuning.name).map_or(tuning.name.as_str(), |(_, s)| s.as_str());
        let label = text("value for the wanted period", "значение для заданного периода");
        results.facts.push(Fact::new(&tuning.name, symbol, unit, tuning.value, label));
        results.own.insert("unknown".into(), json!({"name": tuning.name, "value": tuning.value, "unit": unit}));
    }
    results.words.extend(least(regime));
    results.words.push(verdict(regime));
    results.words.extend(in_parts(regime));
    results.own.insert("parts".into(), json!(regime.pieces.max(1)));
    let family = one_of_a_family(regime);
    results.own.insert("one_of_a_family".into(), json!(family.is_some()));
    results.own.insert("from_start".into(), json!(regime.own));
    results.words.extend(family);
    let multipliers: Vec<Value> = regime.multipliers.iter().map(json_of).collect();
    results.own.insert("multipliers".into(), json!(multipliers));
    results.own.insert("stable".into(), json!(regime.stable));
    results.own.insert("least_period".into(), json!(regime.period / regime.parts.max(1) as f64));
    results.own.insert("periods_of_forces".into(), json!(regime.forces.max(1)));
    let names = machine.system_states();
    let by_name = |values: &[f64]| -> Value {
        names.iter().zip(values).map(|(n, v)| (n.clone(), json!(v))).collect::<serde_json::Map<_, _>>().into()
    };
    results.own.insert("start".into(), by_name(&regime.start));
    results.own.insert("gain".into(), by_name(&regime.gain));
}

pub(super) fn json_of(m: &Multiplier) -> Value {
    let mut value = json!({"re": m.re, "im": m.im, "abs": m.abs(), "trivial": m.trivial, "error": m.error});
    if let (Some(log), Some(fields)) = (m.log_abs, value.as_object_mut()) {
        fields.insert("ln_abs".into(), json!(log));
    }
    value
}

/// A real multiplier with its sign, the magnitude of another one.
pub(super) fn shown(m: &Multiplier) -> f64 {
    if m.im == 0.0 && m.re != 0.0 { m.re } else { m.abs() }
}
