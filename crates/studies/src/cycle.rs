//! The study `cycle`: energy balance over a turn with a uniform shaft, the drive that closes it, irregularity of running, the flywheel.

use super::keys::{OWN_PLOT, POINTS};
use super::periodic::value_of;
use super::{Conclusion, Fact, Found, Given, Interrupts, Repeats, Results, Rows, Study, idle, overlaid};
use crate::failure::in_words;
use crate::failure::{Failure, Misuse};
use crate::machine::{self, Machine, explained};
use crate::provenance;
use crate::results::finite::checked;
use crate::watch::{Lap, Watch};
use analysis::studies::cycle::{Balance, Cycle as Options, Running, cycle};
use mechanics::asked::{Asked, Key, Kind, Like, Limits, Objection, Takes, Way, Words};
use mechanics::model::{ParameterValue, Plot};
use mechanics::units::Dimension;
use serde_json::json;
use std::f64::consts::TAU;
use symbolic::SymbolId;
use words::{Language, Notice, Text};

/// Tolerance of a turn: its work is a small difference of what passes, and the flywheel an inverse of it.
const TURNED: f64 = 1e-14;

/// Steps of the searches.
const STEPS: usize = 40;
/// Changes of a drive below this share of it are rounding.
const SETTLED: f64 = 1e-13;

/// One position a degree.
const USUAL_POINTS: usize = 361;

/// Energy balance of a cyclic machine; SI.
#[derive(Clone, Debug)]
pub struct Cycle {
    /// The angle that describes the cycle.
    pub angle: SymbolId,
    /// Its name.
    pub name: String,
    /// How many turns of 2π make a cycle (2 for a four-stroke engine); negative when it falls.
    pub turns: f64,
    /// Uniform rate of the angle; `None`: its starting rate.
    pub speed: Option<f64>,
    /// Parameter found from the balance: a drive force or torque. `None`: the balance is only drawn up.
    pub unknown: Option<String>,
    /// Wanted irregularity of running, (max - min)/mean of the rate.
    pub irregularity: Option<f64>,
    /// Parameter, an inertia, changed for the wanted irregularity.
    pub flywheel: Option<String>,
    /// How many positions of the tables, both ends included.
    pub points: usize,
    /// Plots wanted; the horizontal axis `None` is the angle.
    pub plots: Vec<Plot>,
}

impl Cycle {
    /// The balance that is asked for; none without an angle.
    pub fn of(asked: &Asked) -> Option<Cycle> {
        let angle = asked.coordinate("angle")?;
        let turns = asked.number("turns").unwrap_or(1.0);
        Some(Cycle {
            angle: angle.symbol,
            name: angle.name.clone(),
            turns,
            speed: asked.number("speed").or(asked.number("period").map(|p| TAU * turns / p)),
            unknown: asked.word("unknown").map(str::to_owned),
            irregularity: asked.number("irregularity"),
            flywheel: asked.word("flywheel").map(str::to_owned),
            points: asked.count("points").unwrap_or(USUAL_POINTS),
            plots: asked.plots().to_vec(),
        })
    }
}

/// The study.
pub struct Turn;

/// Its name and its keys.
pub static KIND: Kind = Kind::new(
    "cycle",
    (
        "Energy balance over a turn: the drive, reduced inertia and moment, irregularity",
        "Баланс энергии за оборот: движущая сила, приведённые момент инерции и момент сил, неравномерность хода",
    ),
)
.keys(&[
    Key::new("angle", Takes::Coordinate, ("angle of the main shaft, a coordinate", "угол главного вала, координата"), "\"phi1\"")
        .required()
        .option("The angle that describes the cycle", "Угол, описывающий цикл")
        .way(Way::Begins),
    Key::new(
        "turns",
        Takes::Number(Limits::NotZero),
        ("turns of the angle in a cycle; negative when it falls", "обороты угла за цикл; отрицательны, если он убывает"),
        "2",
    )
    .default("1", "1")
    .option("Turns of a cycle", "Число оборотов в цикле")
    .needs("angle")
    .way(Way::Written),
    Key::new(
        "speed",
        Takes::Quantity(Like::Is(Dimension::ANGULAR_RATE, "rad/s"), Limits::NotZero),
        ("uniform rate of that angle", "равномерная скорость этого угла"),
        "\"1450 rpm\"",
    )
    .default("starting rate", "начальная скорость")
    .option("Uniform rate [default: the starting rate]", "Равномерная угловая скорость [по умолчанию: начальная скорость]")
    .needs("angle")
    .way(Way::Written),
    Key::new("period", Takes::Duration, ("time of a cycle instead of `speed`", "время цикла вместо `speed`"), "\"0.2568 s\"")
        .not_with("speed", "M071")
        .option("Duration of a cycle, instead of the rate", "Длительность цикла вместо скорости")
        .needs("angle")
        .way(Way::Written),
    Key::new("unknown", Takes::Sought, ("parameter found from the balance of a cycle", "искомый параметр: из баланса за цикл"), "\"F0\"")
        .option("Drive force or torque that is found from the balance", "Движущая сила или момент, которые находят из баланса"),
    Key::new(
        "irregularity",
        Takes::Number(Limits::UpToTwo),
        ("wanted (max - min)/mean of the rate", "нужная неравномерность хода (max - min)/среднее"),
        "0.02",
    )
    .option("Wanted irregularity of running", "Нужная неравномерность хода")
    .needs("angle")
    .way(Way::Written),
    Key::new(
        "flywheel",
        Takes::Sought,
        ("parameter, an inertia, found for the wanted irregularity", "параметр — момент инерции, искомый по нужной неравномерности"),
        "\"I1\"",
    )
    .option("Inertia that is changed for the wanted irregularity", "Момент инерции, который меняют ради нужной неравномерности"),
    POINTS,
    OWN_PLOT,
])
.check(objections);

fn objections(asked: &Asked) -> Vec<Objection> {
    let mut found = Vec::new();
    if asked.coordinate("angle").is_some_and(|angle| angle.dimension.is_some() && !angle.is_angle()) {
        found.push(Objection::no_angle("angle"));
    }
    if asked.word("flywheel").is_some() && !asked.has("irregularity") {
        found.push(
            Objection::at("flywheel", "M071", "`flywheel` needs `irregularity`", "ключу `flywheel` нужна `irregularity`")
                .help("add irregularity = 0.02", "добавьте irregularity = 0.02"),
        );
    }
    found
}

impl Study for Turn {
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn wanted(&self) -> Words {
        (
            "balance the work over a cycle, find the reduced inertia and the irregularity of running",
            "составить баланс работ за цикл, найти приведённый момент инерции и коэффициент неравномерности хода",
        )
    }
    /// A wanted irregularity is no result of the machine of the file, whose flywheel is another one.
    fn concludes(&self, machine: &Machine, results: &Results, language: Language) -> Vec<Conclusion> {
        let study = machine.model.studies.iter().find(|s| s.kind == KIND.name);
        let wanted = study.and_then(|s| s.number("irregularity"));
        let sought = ["unknown", "flywheel"].map(|key| study.and_then(|s| s.word(key)));
        let fact = |name: &str| results.facts.iter().find(|f| f.quantity.name == name);
        let shown = |f: &Fact| {
            let scale = crate::results::tables::scale(&f.quantity, f.value.abs());
            (report::symbol::plain(&f.quantity.symbol, language), f.value / scale.size, scale.print(language))
        };
        let found: Vec<_> = sought.into_iter().flatten().filter_map(fact).map(shown).collect();
        let needed = (!found.is_empty()).then_some(Conclusion::Needed { delta: wanted, found });
        let own = fact("irregularity").filter(|_| wanted.is_none()).map(|f| Conclusion::Irregular { delta: f.value });
        needed.into_iter().chain(own).collect()
    }
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        Cycle::of(asked).map(|study| balanced(machine, &study, watch))
    }
    fn merge(&self, _: &Machine, given: Given) -> Result<Asked, Failure> {
        let asked = overlaid(&KIND, given.written.or(given.of_file).ok_or_else(no_angle)?, given.line);
        if given.line.has("flywheel") && asked.number("irregularity").is_none() {
            let (en, ru) =
                ("no irregularity is wanted: add --irregularity 0.02", "не задана неравномерность хода: добавьте --irregularity 0,02");
            return Err(idle("--flywheel", &Text::new(en, ru)));
        }
        Ok(asked)
    }
    fn interrupts(&self) -> Interrupts {
        Interrupts::Kept
    }
    fn repeats(&self) -> Repeats {
        Repeats::Motion
    }
}

fn no_angle() -> Failure {
    Notice::new("C034", "which angle describes the cycle?", "какой угол описывает цикл?")
        .why("the file has no study `cycle`, and no --angle was given", "в файле нет расчёта `cycle`, а ключ --angle не задан")
        .help("add --angle phi1, and --unknown F0 for the drive", "добавьте --angle phi1 и --unknown F0 для движущей силы")
        .misuse()
}

/// The balance, the drive that closes it and the flywheel.
pub fn balanced(machine: &mut Machine, study: &Cycle, watch: &mut Watch) -> Results {
    let mut results = Results {
        kind: KIND.name,
        heading: Text::new("Cycle of the machine", "Цикл машины"),
        rows: Rows::Summary,
        plots: study.plots.clone(),
        ..Results::default()
    };
    results.data = machine::no_numbers(machine);
    if let Err(trouble) = fill(machine, study, &mut results) {
        results.trouble = Some(trouble);
    }
    watch.lap(Lap::Run);
    checked(results)
}

fn fill(machine: &mut Machine, study: &Cycle, results: &mut Results) -> Result<(), Notice> {
    let (mut values, mut formula): (Vec<(String, f64)>, Option<Text>) = (Vec::new(), None);
    let mut drive = None;
    let mut tried = Tried::new(machine, study);
    if let Some(name) = &study.unknown {
        let found = driven(machine, &mut tried, study, (name, &values), None)?;
        values.push((name.clone(), found.value));
        formula = Some(found.words(name));
        drive = Some(found);
    }
    if let (Some(inertia), Some(wanted)) = (&study.flywheel, study.irregularity) {
        let (found, drive) = flywheel(machine, &mut tried, study, (inertia, wanted), drive)?;
        values.retain(|(name, _)| Some(name) != study.unknown.as_ref());
        values.push((inertia.clone(), found));
        values.extend(study.unknown.clone().zip(drive));
    }
    tried.set(&values)?;
    let (balance, speed) = tried.balance(study)?;
    let pulling = tried.pulling(study)?;
    let mut changed = tried.machine;
    results.data = provenance::stamp(balance.dataset.clone(), &changed.equations, &machine.model_hash);
    results.data.notes.extend(pulling);
    results.words.extend(formula);
    if study.unknown.is_some() {
        let name = Text::new(
            "with the drive found, the work over the cycle vanishes: share of what is done",
            "с найденной движущей силой работа за цикл равна нулю: доля совершённой",
        );
        let off = balance.work.abs() / balance.size.max(f64::MIN_POSITIVE);
        // a secant of the unknown ends within the digits of the work
        results.data.audits.push(analysis::dataset::Audit::at_most("closed_balance", name, off, 1e-9));
    }
    facts(results, &changed, &balance, speed, &values);
    running(results, &mut changed, study)?;
    if results.plots.is_empty() {
        let plot = |name: &str| mechanics::model::Plot { title: Text::default(), x: None, y: vec![name.to_owned()] };
        results.plots = ["J", "M", "A"].map(plot).into();
    }
    Ok(())
}

/// A study of the uniform running of a machine, led by the same machine with its shaft held.
type Uniform<T> = fn(&mut analysis::Machine, Option<&mut analysis::Machine>, &[f64], &Options) -> Result<T, analysis::Fault>;

/// A machine whose values are tried, and the same with its shaft held to the uniform rate (with that rate; none where it cannot be held).
struct Tried {
    machine: Machine,
    held: Option<(f64, Option<Box<Machine>>)>,
    /// The values that both have.
    values: Vec<(String, f64)>,
}

impl Tried {
    /// The machine as it is. A drive and an inertia that are both sought are set to their own numbers already, so that numbers alone change from then on; the drive
    /// has a value of its own in every trial, the inertia must be a number before it is tried, too.
    fn new(machine: &Machine, study: &Cycle) -> Tried {
        let mut tried = Tried { machine: machine.clone(), held: None, values: Vec::new() };
        let own = |name: &String| value_of(machine, name).map(|value| (name.clone(), value));
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

    fn set(&mut self, values: &[(String, f64)]) -> Result<(), Notice> {
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
    fn balance(&mut self, study: &Cycle) -> Result<(Balance, f64), Notice> {
        self.over(study, cycle)
    }

    /// The work of the balance.
    fn work(&mut self, study: &Cycle) -> Result<f64, Notice> {
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
            return Err(Notice::new("S046", format!("`{}` stands still", study.name), format!("`{}` неподвижна", study.name))
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
    fn pulling(&self, study: &Cycle) -> Result<Vec<Text>, Notice> {
        let Some((_, Some(held))) = &self.held else { return Ok(Vec::new()) };
        let mut held = held.clone();
        pulling(&mut held, study).map_err(|fault| explained(fault, &held.equations))
    }
}

/// The same for the motion of a machine from its start.
fn pulling(machine: &mut Machine, study: &Cycle) -> Result<Vec<Text>, analysis::Fault> {
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

/// The balance of work over the cycle, rest + slope·drive = 0, J, and the drive that solves it.
#[derive(Clone, Copy)]
struct Drive {
    rest: f64,
    slope: f64,
    value: f64,
}

impl Drive {
    fn words(self, name: &str) -> Text {
        let print = |x: f64| report::number::short(x, 8, words::Language::En);
        let sign = |x: f64| if x < 0.0 { "−" } else { "+" };
        let name = report::symbol::plain(name, words::Language::En);
        let (rest, value) = (print(self.rest), print(self.value));
        let line = format!("∮ M dφ = {rest} {} {}·{name} = 0,   {name} = {value}", sign(self.slope), print(self.slope.abs()));
        let ru = line.replace('.', ",");
        Text::new(format!("Energy balance of the cycle (J): {line}"), format!("Баланс энергии за цикл (Дж): {ru}"))
    }
}

/// The value of a parameter for which the work over the cycle vanishes. `near` solved the balance with other numbers.
fn driven(
    machine: &Machine,
    tried: &mut Tried,
    study: &Cycle,
    (name, others): (&str, &[(String, f64)]),
    near: Option<Drive>,
) -> Result<Drive, Notice> {
    let first = value_of(machine, name).ok_or_else(|| super::periodic::no_parameter(machine, name))?;
    let mut work = |value: f64| -> Result<f64, Notice> {
        let mut values = others.to_vec();
        values.retain(|(n, _)| n != name);
        values.push((name.to_owned(), value));
        tried.set(&values)?;
        tried.work(study)
    };
    let mut a = near.map_or(first, |near| near.value);
    let mut work_a = work(a)?;
    let mut b = near.map_or(if first == 0.0 { 1.0 } else { 0.9 * first }, |near| a - work_a / near.slope);
    if let Some(near) = near.filter(|near| (b - near.value).abs() <= SETTLED * b.abs()) {
        return Ok(near);
    }
    let (mut slope, mut rest) = (0.0, 0.0);
    for _ in 0..STEPS {
        let work_b = work(b)?;
        let now = (work_b - work_a) / (b - a);
        if now == 0.0 || !now.is_finite() {
            break;
        }
        (slope, rest) = (now, work_b - now * b);
        let next = -rest / slope;
        let settled = (next - b).abs() <= SETTLED * next.abs();
        (a, work_a, b) = (b, work_b, next);
        if settled {
            break;
        }
    }
    if slope == 0.0 {
        return Err(Notice::new("S048", format!("`{name}` does no work over the cycle"), format!("`{name}` не совершает работы за цикл"))
            .help("choose a drive force or torque as the unknown", "выберите неизвестной движущую силу или момент"));
    }
    Ok(Drive { rest, slope, value: b })
}

/// The inertia for which the irregularity is the wanted one, with the drive that goes with it.
fn flywheel(
    machine: &Machine,
    tried: &mut Tried,
    study: &Cycle,
    (name, wanted): (&str, f64),
    mut drive: Option<Drive>,
) -> Result<(f64, Option<f64>), Notice> {
    let first = value_of(machine, name).ok_or_else(|| super::periodic::no_parameter(machine, name))?;
    let mut at = |value: f64| -> Result<f64, Notice> {
        let mut values = vec![(name.to_owned(), value)];
        if let Some(unknown) = &study.unknown {
            let found = driven(machine, tried, study, (unknown, &values), drive)?;
            drive = Some(found);
            values.push((unknown.clone(), found.value));
        }
        tried.set(&values)?;
        let found = turned(&mut tried.machine, study)?;
        Ok((found.greatest - found.least) / found.mean.abs())
    };
    // the irregularity is nearly inverse to the inertia: secant in 1/irregularity
    let (mut a, turns) = turning_with(first, &mut at)?;
    let mut b = 1.5 * a;
    let mut f_a = 1.0 / turns - 1.0 / wanted;
    let mut reached = at(b)?;
    for _ in 0..STEPS {
        let f_b = 1.0 / reached - 1.0 / wanted;
        let slope = (f_b - f_a) / (b - a);
        // a share of the wanted value that the tolerance of a turn still shows
        if f_b.abs() <= 1e-12 / wanted || slope == 0.0 || !slope.is_finite() {
            break;
        }
        let next = (b - f_b / slope).max(0.1 * b);
        (a, f_a, b) = (b, f_b, next);
        reached = at(b)?;
    }
    // more digits than a flywheel is made to
    if (reached - wanted).abs() > 1e-8 * wanted {
        return Err(Notice::new(
            "S048",
            format!("no value of `{name}` gives the irregularity {wanted}"),
            format!("ни при каком значении `{name}` неравномерность хода не равна {wanted}"),
        ));
    }
    Ok((b, drive.map(|drive| drive.value)))
}

/// The first of growing values with which the shaft turns, and its irregularity then: the value in the file is a guess, a small flywheel stalls.
fn turning_with(first: f64, at: &mut impl FnMut(f64) -> Result<f64, Notice>) -> Result<(f64, f64), Notice> {
    let (mut stalled, mut value) = (None, first);
    for _ in 0..GROWN {
        match at(value) {
            Ok(found) => return Ok((value, found)),
            Err(fault) if fault.code == "S046" => stalled = stalled.or(Some(fault)),
            Err(fault) => return Err(stalled.unwrap_or(fault)),
        }
        value *= 4.0;
    }
    Err(stalled.unwrap_or_else(|| Notice::new("S046", "the shaft does not turn", "вал не вращается")))
}

/// How often the value of the file is multiplied by four.
const GROWN: usize = 16;

/// The running of the motion over one cycle of the angle from the start.
fn turned(machine: &mut Machine, study: &Cycle) -> Result<Running, Notice> {
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

/// The work over the cycle; zero where rounding of its parts is left.
fn own_work(balance: &Balance) -> f64 {
    // some hundred units of the last place of what passes
    if balance.work.abs() <= 1e-13 * balance.size { 0.0 } else { balance.work }
}

fn facts(results: &mut Results, machine: &Machine, balance: &Balance, speed: f64, values: &[(String, f64)]) {
    for (name, value) in values {
        let declared = machine.model.parameters.iter().find(|p| p.name == *name);
        let symbol = machine.model.notation.iter().find(|(n, _)| n == name).map_or(name.as_str(), |(_, s)| s.as_str());
        let label = declared.map(|p| p.label.clone()).filter(|l| !l.en.is_empty());
        let label = label.unwrap_or_else(|| Text::new("value found from the cycle", "значение, найденное из цикла"));
        results.facts.push(Fact::new(name, symbol, declared.map_or("1", |p| p.unit.as_str()), *value, label));
    }
    let text = Text::new;
    results.facts.push(Fact::new("omega", "ω", "rad/s", speed, text("uniform rate of the shaft", "равномерная угловая скорость вала")));
    results.facts.push(Fact::new(
        "work",
        "A",
        "J",
        own_work(balance),
        text("work of all forces over the cycle", "работа всех сил за цикл"),
    ));
    results.facts.push(Fact::new(
        "J_mean",
        "J_m",
        "kg m^2",
        balance.inertia,
        text("mean reduced moment of inertia", "средний приведённый момент инерции"),
    ));
    let label = text("largest excess work within the cycle", "наибольшая избыточная работа внутри цикла");
    results.facts.push(Fact::new("excess_work", "ΔA", "J", balance.excess, label));
    results.own.insert("values".into(), json!(values.iter().map(|(n, v)| (n.clone(), json!(v))).collect::<serde_json::Map<_, _>>()));
}

fn of_the_start(note: &Text) -> Text {
    Text::new(format!("the motion from the start: {}", note.en), format!("движение из заданного начала: {}", note.ru))
}

/// Irregularity of the true motion over the cycle.
fn running(results: &mut Results, machine: &mut Machine, study: &Cycle) -> Result<(), Notice> {
    match pulling(&mut machine.clone(), study) {
        Ok(notes) => results.data.notes.extend(notes.into_iter().map(|note| of_the_start(&note))),
        Err(fault) if fault.code == "S116" => {
            results.words.push(of_the_start(&fault.message.what));
            results.words.push(Text::new(
                "Nothing is said of the irregularity of that motion.",
                "О неравномерности хода этого движения ничего не сказано.",
            ));
            return Ok(());
        }
        // told where the motion itself is computed
        Err(_) => {}
    }
    let Running { greatest: high, least: low, mean, .. } = match turned(machine, study) {
        Err(trouble) if trouble.code == "S046" => {
            results.words.push(Text::new(
                "The motion from the start does not turn through the cycle: nothing is said of its irregularity.",
                "Движение из заданного начала не проходит весь цикл: о неравномерности хода ничего не сказано.",
            ));
            return Ok(());
        }
        found => found?,
    };
    // of a shaft that turns backwards the largest rate is that of the largest speed
    let (high, low) = if mean < 0.0 { (low, high) } else { (high, low) };
    let by_max = (high - low) / high;
    let text = Text::new;
    results.facts.push(Fact::new(
        "omega_max",
        "ω_max",
        "rad/s",
        high,
        text("largest rate over the cycle from the start", "наибольшая угловая скорость за цикл от начала"),
    ));
    results.facts.push(Fact::new("omega_min", "ω_min", "rad/s", low, text("least rate", "наименьшая угловая скорость")));
    let label = text(
        "mean rate over time: angle of the cycle over its duration",
        "средняя по времени угловая скорость: угол цикла, делённый на его длительность",
    );
    results.facts.push(Fact::new("omega_mean", "ω_m", "rad/s", mean, label));
    results.facts.push(Fact::new(
        "irregularity",
        "δ",
        "1",
        (high - low) / mean,
        text(
            "irregularity (ω_max − ω_min)/ω_m of the first cycle, by the mean over time",
            "неравномерность хода (ω_max − ω_min)/ω_m первого цикла, по среднему по времени",
        ),
    ));
    results.facts.push(Fact::new(
        "irregularity_max",
        "δ_max",
        "1",
        by_max,
        text("the same over the largest rate, (ω_max − ω_min)/ω_max", "то же по наибольшей скорости, (ω_max − ω_min)/ω_max"),
    ));
    Ok(())
}
