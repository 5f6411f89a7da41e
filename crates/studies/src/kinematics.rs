//! The study `kinematics`: places, velocities and accelerations over a range of the driven coordinate, transfer functions, instantaneous centres.

use super::keys::{OUTPUTS, OWN_PLOT, POINTS};
use super::{Finds, Found, Given, Interrupts, Repeats, Results, Rows, Study, overlaid};
use crate::failure::{Failure, Misuse};
use crate::machine::{self, Machine, explained};
use crate::provenance;
use crate::results::finite::checked;
use crate::source::Source;
use crate::watch::{Lap, Watch};
use analysis::dataset::{Column, Extreme, Missing, Trail};
use analysis::studies::kinematics::{Observer, Place, Way, follow};
use analysis::{Dataset, Quantity, System};
use mechanics::asked::{Asked, Key, Kind, Like, Limits, Objection, Takes, Value, Way as Comes, Words};
use mechanics::model::{Axis, Plot};
use program::lower::{Drive, Inputs};
use program::{Behind, Evaluator, Point};
use serde_json::json;
use std::f64::consts::TAU;
use std::sync::Arc;
use symbolic::{Equations, Expr, Graph, SymbolId};
use words::{Notice, Text};

/// One position a degree: a drawing of a turn needs as many to look smooth.
const USUAL_POINTS: usize = 361;

/// Positions, velocities and accelerations over a range of one coordinate; SI.
#[derive(Clone, Debug)]
pub struct Kinematics {
    /// The driven coordinate.
    pub over: SymbolId,
    /// Its name.
    pub name: String,
    /// First value; `None`: the coordinate's start.
    pub from: Option<f64>,
    /// Last value.
    pub to: KinematicsEnd,
    /// How many positions, both ends included.
    pub points: usize,
    /// Rate of the driven coordinate, constant, from which velocities and accelerations follow; `None`: its starting rate, or 1 when
    /// that is zero.
    pub rate: Option<f64>,
    /// Further driven coordinates as formulas of the driven one, for linkages of two and more degrees of freedom.
    pub with: Vec<(SymbolId, Expr)>,
    /// Outputs wanted, by name (also coordinates and rates); empty means all.
    pub outputs: Vec<String>,
    /// Plots wanted; the horizontal axis `None` is the driven coordinate.
    pub plots: Vec<Plot>,
}

/// Where a kinematic range ends.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum KinematicsEnd {
    /// At this value.
    At(f64),
    /// After so many turns of 2π from the first value.
    Turns(f64),
}

impl Kinematics {
    /// What is asked for; none without a driven coordinate.
    pub fn of(asked: &Asked) -> Option<Kinematics> {
        let over = asked.coordinate("over")?;
        let to = match asked.number("to") {
            Some(to) => KinematicsEnd::At(to),
            None => KinematicsEnd::Turns(asked.number("turns").unwrap_or(1.0)),
        };
        let with = if let Some(Value::Driven(with)) = asked.get("with") { with.clone() } else { Vec::new() };
        Some(Kinematics {
            over: over.symbol,
            name: over.name.clone(),
            from: asked.number("from"),
            to,
            points: asked.count("points").unwrap_or(USUAL_POINTS),
            rate: asked.number("rate"),
            with,
            outputs: asked.words("outputs").to_vec(),
            plots: asked.plots().to_vec(),
        })
    }
}

/// The study.
pub struct Linkage;

/// Its name and its keys.
pub static KIND: Kind = Kind::new(
    "kinematics",
    ("Follow a linkage over a range of its driven coordinate", "Проследить движение механизма по ведущей координате"),
)
.keys(&[
    Key::new("over", Takes::Coordinate, ("the driven coordinate", "ведущая координата"), "\"phi1\"")
        .required()
        .option("The driven coordinate", "Ведущая координата")
        .way(Comes::Begins),
    Key::new(
        "from",
        Takes::Quantity(Like::Of("over"), Limits::None),
        ("first value of the driven coordinate", "первое значение ведущей координаты"),
        "\"0 deg\"",
    )
    .default("start", "начальное значение")
    .option("First value [default: the start]", "Первое значение [по умолчанию: начальное]")
    .way(Comes::Written),
    Key::new(
        "to",
        Takes::Quantity(Like::Of("over"), Limits::None),
        ("last value of the driven coordinate", "последнее значение ведущей координаты"),
        "\"180 deg\"",
    )
    .option("Last value", "Последнее значение")
    .way(Comes::Written),
    Key::new(
        "turns",
        Takes::Number(Limits::NotZero),
        (
            "turns of the driven angle, instead of `to`; negative when it falls",
            "обороты ведущего угла вместо `to`; отрицательны, если он убывает",
        ),
        "2",
    )
    .default("1", "1")
    .not_with("to", "M071")
    .option("Turns of an angle [default: 1]", "Число оборотов угла [по умолчанию: 1]")
    .way(Comes::Written),
    Key::new(
        "rate",
        Takes::Quantity(Like::RateOf("over"), Limits::NotZero),
        ("constant rate of the driven coordinate", "постоянная скорость ведущей координаты"),
        "\"10 rad/s\"",
    )
    .default("starting rate, else 1", "начальная скорость, иначе 1")
    .option(
        "Uniform rate of the driven coordinate [default: its starting rate, or 1]",
        "Равномерная скорость ведущей координаты [по умолчанию: начальная или 1]",
    )
    .way(Comes::Written),
    POINTS.option("Number of positions", "Число положений").way(Comes::Written),
    Key::new(
        "with",
        Takes::Driven("over"),
        ("further driven coordinates as formulas of the driven one", "другие ведущие координаты — формулы от ведущей"),
        "{ phi4 = \"2*phi1\" }",
    ),
    OUTPUTS,
    OWN_PLOT,
])
.check(objections);

/// Exactly one of `to` and `turns`; one turn of an angle without either.
fn objections(asked: &Asked) -> Vec<Objection> {
    let Some(over) = asked.coordinate("over") else { return Vec::new() };
    match (asked.has("to"), asked.has("turns")) {
        (true, false) if asked.number("to").is_some() && asked.number("to") == asked.number("from") => {
            vec![Objection::at("to", "M071", "the range is empty: `to` equals `from`", "промежуток пуст: `to` равно `from`")]
        }
        (false, true) if !over.is_angle() => vec![Objection::no_angle("turns")],
        (false, false) if !over.is_angle() => {
            let (en, ru) = ("the study kinematics lacks the end of its range", "в расчёте kinematics не задан конец промежутка");
            vec![Objection::whole("M071", en, ru).help("add to = \"0.3 m\"", "добавьте to = \"0,3 м\"")]
        }
        _ => Vec::new(),
    }
}

impl Study for Linkage {
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn wanted(&self) -> Words {
        ("investigate the kinematics of the linkage", "провести кинематическое исследование механизма")
    }
    fn chapter(&self) -> &'static str {
        "kinematics"
    }
    fn finds(&self) -> Finds {
        Finds::Positions
    }
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        Kinematics::of(asked).map(|study| followed(machine, &study, watch))
    }
    fn merge(&self, _: &Machine, given: Given) -> Result<Asked, Failure> {
        let fresh = given.written.is_some();
        let asked = overlaid(&KIND, given.written.or(given.of_file).ok_or_else(nothing_driven)?, given.line);
        let empty = matches!((asked.number("from"), asked.number("to")), (Some(from), Some(to)) if from == to);
        let still = asked.number("turns") == Some(0.0) || asked.number("rate") == Some(0.0);
        if !fresh && (empty || still || asked.count("points").is_some_and(|n| n < 2)) {
            return Err(nothing_followed());
        }
        Ok(asked)
    }
    fn own_columns(&self, machine: &Machine, asked: &Asked) -> Vec<String> {
        Kinematics::of(asked).map(|study| own_columns(machine, &study)).unwrap_or_default()
    }
    fn interrupts(&self) -> Interrupts {
        Interrupts::Ending
    }
    fn repeats(&self) -> Repeats {
        Repeats::Never
    }
}

fn nothing_driven() -> Failure {
    Notice::new("C035", "which coordinate is driven?", "какая координата ведущая?")
        .why("the file has no study `kinematics`, and no --over was given", "в файле нет расчёта `kinematics`, а ключ --over не задан")
        .help("add --over phi1", "добавьте --over phi1")
        .misuse()
}

fn nothing_followed() -> Failure {
    Notice::new("C036", "the range of positions is empty", "промежуток положений пуст")
        .why(
            "two different ends, a rate other than zero and at least two positions are needed",
            "нужны разные концы, ненулевая скорость и не менее двух положений",
        )
        .help("for example --from 0 --to \"90 deg\" --points 91", "например, --from 0 --to \"90 град\" --points 91")
        .misuse()
}

/// The linkage at every position.
pub fn followed(machine: &mut Machine, study: &Kinematics, watch: &mut Watch) -> Results {
    let mut results = Results {
        kind: KIND.name,
        heading: Text::new("Kinematics of the linkage", "Кинематика механизма"),
        rows: Rows::Summary,
        plots: study.plots.clone(),
        ..Results::default()
    };
    fill(machine, study, &mut results);
    watch.lap(Lap::Run);
    checked(results)
}

/// Columns that the study adds to the outputs of the file: transfer functions and instantaneous centres.
pub fn own_columns(machine: &Machine, study: &Kinematics) -> Vec<String> {
    let names = machine.model.coordinates.iter().map(|c| c.name.as_str()).filter(|name| *name != study.name);
    let transfers = names.flat_map(|name| [format!("d{name}/d{}", study.name), format!("d2{name}/d{}2", study.name)]);
    let frames = machine.model.frames.iter().enumerate().skip(1).filter(|(i, _)| turns_in_plane(machine, *i));
    let bodies = frames.map(|(_, f)| f.name.as_str());
    let centres = bodies.flat_map(|body| [format!("P_x_{body}"), format!("P_y_{body}"), format!("omega({body})")]);
    transfers.chain(centres).collect()
}

/// Whether a frame turns about z only: a body that turns in space has no instantaneous centre, and its angular velocity is no number.
fn turns_in_plane(machine: &Machine, frame: usize) -> bool {
    let mut here = frame;
    while here != 0 {
        let f = &machine.model.frames[here];
        let flat = f.rotations.iter().map(|(axis, _)| axis).chain(f.spin.as_ref().map(|(axis, _)| axis)).all(|axis| *axis == Axis::Z);
        if !flat {
            return false;
        }
        here = f.on.index();
    }
    true
}

fn fill(machine: &mut Machine, study: &Kinematics, results: &mut Results) {
    let start = match machine.system.start() {
        Ok(start) => start,
        Err(fault) => {
            results.data = machine::no_numbers(machine);
            results.trouble = Some(explained(fault, &machine.equations));
            return;
        }
    };
    let centres = Centres::of(machine, study);
    let equations = &machine.equations;
    let n = equations.coordinates.len();
    let index = |symbol: SymbolId| equations.coordinates.iter().position(|c| c.symbols[0] == symbol);
    let over = index(study.over).unwrap_or(0);
    let from = study.from.unwrap_or(start[over]);
    let to = match study.to {
        KinematicsEnd::At(to) => to,
        KinematicsEnd::Turns(turns) => from + TAU * turns,
    };
    let rate = study.rate.unwrap_or(if start[n + over] == 0.0 { 1.0 } else { start[n + over] });
    let last = study.points.max(2) - 1;
    let ways: Vec<f64> = (0..=last).map(|k| from + (to - from) * k as f64 / last as f64).collect();
    let (graph, with) = driven_too(equations, study, &index);
    let observed = centres.machine.as_ref().map_or(equations, |m| &m.equations);
    let table = Table { equations: observed, study, over, rate, ways: &ways, centres: &centres };
    let mut observing = table.observing();
    let followed = follow(equations, &start, Way { over, at: &ways, rate, with, graph: &graph, observer: Some(&mut observing) });
    let extremes =
        followed.extremes.into_iter().filter_map(|e| Some(Extreme { column: *observing.columns.get(e.column - 1)?, ..e })).collect();
    let mut data = table.columns(&followed.places, extremes);
    centres.state(&mut data);
    data.audits.extend(followed.audits);
    data.notes.extend(machine.system.notes().iter().cloned().chain(followed.notes));
    data.trail = trail(equations, &ways, &followed.places);
    results.data = provenance::stamp(data, &machine.equations, &machine.model_hash);
    results.own.insert("over".into(), json!(study.name));
    results.own.insert("rate".into(), json!(rate));
    if let Some(fault) = followed.fault {
        results.data.partial = true;
        results.trouble = Some(explained(fault, &machine.equations));
    }
    if results.plots.is_empty() {
        let name = |i: usize| equations.graph.symbol_info(equations.coordinates[i].symbols[0]).name.clone();
        let y: Vec<String> = (0..n).filter(|&i| i != over).map(name).filter(|y| results.data.column(y).is_some()).collect();
        results.plots = y.into_iter().map(|y| mechanics::model::Plot { title: Text::default(), x: None, y: vec![y] }).collect();
    }
}

/// The places over the driven coordinate, for pictures.
fn trail(equations: &Equations, ways: &[f64], places: &[Place]) -> Trail {
    let name = |s: SymbolId| equations.graph.symbol_info(s).name.clone();
    let names = equations
        .coordinates
        .iter()
        .map(|c| name(c.symbols[0]))
        .chain(equations.auxiliaries.iter().map(|a| name(a.symbol)))
        .chain(["t".to_owned()]);
    let mut rows: Vec<(f64, &Place)> = ways.iter().copied().zip(places).collect();
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let states = rows.iter().flat_map(|(_, p)| p.q.iter().chain(&p.auxiliaries).chain([&p.time]).copied()).collect();
    Trail { names: names.collect(), times: rows.iter().map(|r| r.0).collect(), states }
}

/// The other driven coordinates with both derivatives by the first, and the graph in which these stand.
fn driven_too(equations: &Equations, study: &Kinematics, index: &dyn Fn(SymbolId) -> Option<usize>) -> (Graph, Vec<(usize, Drive)>) {
    let mut graph = equations.graph.clone();
    let with = study.with.iter().filter_map(|(symbol, value)| {
        let slope = graph.derivative(*value, study.over);
        let curvature = graph.derivative(slope, study.over);
        Some((index(*symbol)?, [*value, slope, curvature]))
    });
    let with = with.collect();
    (graph, with)
}

/// The machine with what the instantaneous centres of its bodies follow from as outputs, under names that the file does not use.
struct Centres {
    /// None when no centre is asked for, or the machine has none (in space).
    machine: Option<Machine>,
    /// Body, then the names of the outputs x, y, angular velocity.
    bodies: Vec<(String, [String; 3])>,
}

impl Centres {
    fn of(machine: &Machine, study: &Kinematics) -> Centres {
        let file = &machine.origin.source.text;
        let wanted = |body: &str| {
            let own = [format!("P_x_{body}"), format!("P_y_{body}"), format!("omega({body})")];
            let taken = own.iter().any(|name| machine.equations.outputs.iter().any(|o| o.name == *name));
            !taken && (study.outputs.is_empty() || study.outputs.iter().any(|o| own.contains(o)))
        };
        let frames = machine.model.frames.iter().enumerate().skip(1).filter(|(i, _)| turns_in_plane(machine, *i));
        let named = frames.map(|(_, f)| f.name.clone()).filter(|name| wanted(name));
        let mut prefix = "centre_of_".to_owned();
        while file.contains(&prefix) {
            prefix.push('_');
        }
        let bodies: Vec<_> = named.enumerate().map(|(i, body)| (body, ["x", "y", "w"].map(|what| format!("{prefix}{i}_{what}")))).collect();
        let mut text = file.clone();
        for (i, (body, [x, y, w])) in bodies.iter().enumerate() {
            let quoted = serde_json::Value::from(body.as_str()).to_string();
            text += &format!("\n[points.{prefix}{i}]\non = {quoted}\nat = [\"0\", \"0\"]\n");
            text += &format!("[outputs.{x}]\nvalue = \"x({prefix}{i}) - vy({prefix}{i})/omega({body})\"\n");
            text += &format!("[outputs.{y}]\nvalue = \"y({prefix}{i}) + vx({prefix}{i})/omega({body})\"\n");
            text += &format!("[outputs.{w}]\nvalue = \"omega({body})\"\n");
        }
        let source = Source { path: machine.origin.source.path.clone(), text };
        let built = if bodies.is_empty() { None } else { machine.again(source, machine.origin.overrides.clone()).ok() };
        let bodies = if built.is_some() { bodies } else { Vec::new() };
        Centres { machine: built, bodies }
    }

    /// Where a body does not turn its centre is at infinity: such values are none, and columns without any other are left out.
    fn state(&self, data: &mut Dataset) {
        for body in self.bodies.iter().map(|(body, _)| body) {
            let own = [format!("P_x_{body}"), format!("P_y_{body}")];
            let all = |c: &Column| own.contains(&c.quantity.name) && !c.values.is_empty() && c.values.iter().all(|v| v.is_nan());
            if data.columns.iter().any(all) {
                data.keep_columns(|c| !own.contains(&c.quantity.name));
                data.notes.push(Text::new(
                    format!("{} does not turn: its instantaneous centre is at infinity", self.told(body).0),
                    format!("{} движется поступательно: мгновенный центр скоростей бесконечно удалён", self.told(body).1),
                ));
            }
            for name in own {
                let words = Text::new("at infinity: the body does not turn here", "в бесконечности: тело здесь не вращается");
                data.state(&name, Missing::Absent, words);
            }
        }
    }

    /// The symbol of an output that is one of ours with the number of the body, where a label says what the body is.
    fn symbol(&self, output: &str) -> Option<String> {
        let (body, names) = self.bodies.iter().find(|(_, names)| names.iter().any(|n| n == output))?;
        let bodies = self.machine.iter().flat_map(|machine| &machine.model.frames).filter(|frame| frame.is_body);
        let (number, frame) = bodies.enumerate().find(|(_, frame)| frame.name == *body)?;
        let letter = ["P_x_", "P_y_", "ω_"][names.iter().position(|n| n == output)?];
        (!frame.label.en.is_empty()).then(|| format!("{letter}{}", number + 1))
    }

    /// What a body is, in both languages; its name where the file does not say.
    fn told(&self, body: &str) -> (String, String) {
        let frames = self.machine.iter().flat_map(|machine| &machine.model.frames);
        let label = frames.into_iter().find(|frame| frame.name == body).map(|frame| frame.label.clone()).unwrap_or_default();
        if label.en.is_empty() { (body.to_owned(), body.to_owned()) } else { (label.en, label.ru) }
    }

    /// Name, label and unit of an output that is one of ours; none for the user's.
    fn shown(&self, output: &str) -> Option<(String, Text)> {
        let (body, names) = self.bodies.iter().find(|(_, names)| names.iter().any(|n| n == output))?;
        let (en, ru) = self.told(body);
        let label = |axis: &str| {
            let ru = format!("мгновенный центр скоростей ({ru}), {axis}");
            Text::new(format!("instantaneous centre of velocity of {en}, {axis}"), ru)
        };
        Some(match names.iter().position(|n| n == output)? {
            0 => (format!("P_x_{body}"), label("x")),
            1 => (format!("P_y_{body}"), label("y")),
            _ => (format!("omega({body})"), Text::new(format!("angular velocity of {en}"), format!("угловая скорость ({ru})"))),
        })
    }
}

/// An instantaneous centre farther than this is at infinity, m.
const FAR: f64 = 1e9;

/// Formulas over places, rates and accelerations, by the plain evaluator of the graph.
struct Formulas<'e> {
    equations: &'e Equations,
    constants: Vec<f64>,
}

impl<'e> Formulas<'e> {
    fn new(equations: &'e Equations) -> Self {
        let mut constants = vec![0.0; equations.graph.symbol_count()];
        equations.parameters.iter().for_each(|p| constants[p.symbol.index()] = p.value);
        Formulas { equations, constants }
    }

    /// At a place, driven at the uniform rate.
    fn values(&self, place: &Place, rate: f64, formulas: &[Expr]) -> Vec<f64> {
        let graph = &self.equations.graph;
        let mut values = self.constants.clone();
        values[self.equations.time.index()] = place.time;
        for (i, c) in self.equations.coordinates.iter().enumerate() {
            values[c.symbols[0].index()] = place.q[i];
            values[c.symbols[1].index()] = rate * place.first[i];
            values[c.symbols[2].index()] = rate * rate * place.second[i];
        }
        for (a, value) in self.equations.auxiliaries.iter().zip(&place.auxiliaries) {
            values[a.symbol.index()] = *value;
        }
        for d in &self.equations.definitions {
            values[d.symbol.index()] = graph.evaluate(&[d.formula], &|s| values[s.index()])[0];
        }
        graph.evaluate(formulas, &|s| values[s.index()])
    }

    /// The formulas as a tape over (q, q', q'', auxiliary states); none where that is not possible.
    fn tape(&self, formulas: &[Expr]) -> Option<(Evaluator, Arc<Behind>)> {
        let e = self.equations;
        let order = |k: usize| e.coordinates.iter().map(move |c| c.symbols[k]);
        let inputs = Inputs {
            parameters: e.parameters.iter().map(|p| p.symbol).collect(),
            time: Some(e.time),
            states: order(0).chain(order(1)).chain(order(2)).chain(e.auxiliaries.iter().map(|a| a.symbol)).collect(),
            definitions: e.definitions.iter().map(|d| (d.symbol, d.formula)).collect(),
            ..Inputs::default()
        };
        let roots: Vec<(String, Expr)> = formulas.iter().enumerate().map(|(k, f)| (format!("column {}", k + 1), *f)).collect();
        let tape = program::lower::expressions(&e.graph, "kinematics", &inputs, &roots).ok()?;
        let values: Vec<f64> = e.parameters.iter().map(|p| p.value).collect();
        let evaluator = Evaluator::new(&Arc::new(tape), &values).ok()?;
        let behind = Arc::new(Behind::new(&evaluator));
        Some((evaluator, behind))
    }

    /// Whether a formula is free of reactions, directly or through definitions.
    fn is_kinematic(&self, formula: Expr) -> bool {
        let reactions: Vec<SymbolId> = self.equations.reactions.iter().map(|r| r.symbol).collect();
        let mut all = vec![formula];
        let found = self.equations.graph.symbols_in(&all);
        all.extend(self.equations.definitions.iter().filter(|d| found.contains(&d.symbol)).map(|d| d.formula));
        !self.equations.graph.symbols_in(&all).iter().any(|s| reactions.contains(s))
    }
}

/// The columns between the places of the table: formulas, then both transfer functions of each other coordinate. Instantaneous centres are left out: they
/// go to infinity and have no least or greatest place.
struct Observing<'e> {
    formulas: Formulas<'e>,
    exprs: Vec<Expr>,
    /// The formulas once more, for what stands behind them.
    tape: Option<(Evaluator, Arc<Behind>)>,
    others: Vec<usize>,
    /// Which columns of the table they are.
    columns: Vec<usize>,
    rate: f64,
}

impl Observer for Observing<'_> {
    fn count(&self) -> usize {
        self.exprs.len() + 2 * self.others.len()
    }

    fn values(&mut self, place: &Place) -> Vec<f64> {
        let mut row: Vec<f64> = self.formulas.values(place, self.rate, &self.exprs);
        row.extend(self.others.iter().flat_map(|&i| [place.first[i], place.second[i]]));
        if let Some((evaluator, behind)) = &mut self.tape {
            let w = self.rate;
            let rates = place.first.iter().map(|b| w * b);
            let accelerations = place.second.iter().map(|c| w * w * c);
            let states: Vec<f64> =
                place.q.iter().copied().chain(rates).chain(accelerations).chain(place.auxiliaries.iter().copied()).collect();
            let point = Point { time: place.time, states: &states, ..Point::default() };
            // a result without a value is none of the record's business
            let _ = evaluator.evaluate(&point);
            behind.record(evaluator, &point, &mut row);
        }
        row
    }

    fn behind(&self) -> Arc<Behind> {
        self.tape.as_ref().map_or_else(Arc::default, |(_, behind)| Arc::clone(behind))
    }
}

/// The places as columns.
struct Table<'t> {
    equations: &'t Equations,
    study: &'t Kinematics,
    over: usize,
    rate: f64,
    ways: &'t [f64],
    centres: &'t Centres,
}

impl Table<'_> {
    fn columns(&self, places: &[Place], extremes: Vec<Extreme>) -> Dataset {
        let own = &self.equations.coordinates[self.over];
        let name = self.name(self.over);
        let axis = Quantity { symbol: self.symbol(&name), label: own.label.clone(), ..Quantity::new(&name, &own.unit) };
        let mut columns = vec![Column { quantity: axis, values: self.ways[..places.len()].to_vec() }];
        columns.extend(self.formulas(places));
        columns.extend(self.transfers(places));
        // in the order in which they were asked for
        if !self.study.outputs.is_empty() {
            let place = |c: &Column| self.study.outputs.iter().position(|o| *o == c.quantity.name);
            let mut chosen: Vec<usize> = (1..columns.len()).filter(|i| place(&columns[*i]).is_some()).collect();
            chosen.sort_by_key(|i| place(&columns[*i]));
            let of = |(k, i): (usize, &usize)| extremes.iter().find(|e| e.column == *i).map(|e| Extreme { column: k + 1, ..e.clone() });
            let extremes = chosen.iter().enumerate().filter_map(of).collect();
            let columns = std::iter::once(0).chain(chosen.iter().copied()).map(|i| columns[i].clone()).collect();
            return Dataset { axis: Some(0), columns, extremes, ..Dataset::default() };
        }
        Dataset { axis: Some(0), columns, extremes, ..Dataset::default() }
    }

    /// The columns behind the axis, as functions of the place.
    fn observing(&self) -> Observing<'_> {
        let formulas = Formulas::new(self.equations);
        let chosen = self.chosen(&formulas);
        let bounded = |o: &symbolic::equations::Output| self.centres.shown(&o.name).is_none_or(|(name, _)| name.starts_with("omega("));
        let (places, exprs): (Vec<usize>, Vec<Expr>) =
            chosen.iter().enumerate().filter(|(_, o)| bounded(o)).map(|(i, o)| (i + 1, o.formula)).unzip();
        let others: Vec<usize> = (0..self.equations.coordinates.len()).filter(|i| *i != self.over).collect();
        let columns = places.into_iter().chain((0..2 * others.len()).map(|k| chosen.len() + 1 + k)).collect();
        Observing { tape: formulas.tape(&exprs), formulas, exprs, others, columns, rate: self.rate }
    }

    /// Outputs that are free of reactions.
    fn chosen(&self, formulas: &Formulas) -> Vec<&symbolic::equations::Output> {
        let lead = self.name(self.over);
        self.equations.outputs.iter().filter(|o| o.name != lead && formulas.is_kinematic(o.formula)).collect()
    }

    fn name(&self, i: usize) -> String {
        self.equations.graph.symbol_info(self.equations.coordinates[i].symbols[0]).name.clone()
    }

    fn symbol(&self, name: &str) -> String {
        self.equations.notation.iter().find(|(n, _)| n == name).map_or(name, |(_, s)| s.as_str()).to_owned()
    }

    /// Coordinates, rates, accelerations, the user's outputs and the instantaneous centres: all formulas free of reactions.
    fn formulas(&self, places: &[Place]) -> Vec<Column> {
        let formulas = Formulas::new(self.equations);
        let chosen = self.chosen(&formulas);
        let exprs: Vec<Expr> = chosen.iter().map(|o| o.formula).collect();
        let mut table: Vec<Vec<f64>> = vec![Vec::with_capacity(places.len()); exprs.len()];
        for place in places {
            let row = formulas.values(place, self.rate, &exprs);
            for ((column, output), v) in table.iter_mut().zip(&chosen).zip(row) {
                let far = self.centres.shown(&output.name).is_some() && (!v.is_finite() || v.abs() >= FAR);
                column.push(if far { f64::NAN } else { v });
            }
        }
        let quantity = |output: &symbolic::equations::Output| match self.centres.shown(&output.name) {
            Some((name, label)) => {
                let symbol = self.centres.symbol(&output.name).unwrap_or_else(|| name.clone());
                Quantity { label, symbol, ..Quantity::new(&name, &output.unit) }
            }
            None => {
                let symbol = self.equations.graph.symbol_info(output.symbol);
                let symbol = format!("{}{}", self.symbol(&symbol.name), "'".repeat(usize::from(symbol.primes)));
                let label = output.label.clone();
                Quantity { symbol, label, display: output.display.clone(), ..Quantity::new(&output.name, &output.unit) }
            }
        };
        chosen.into_iter().zip(table).map(|(output, values)| Column { quantity: quantity(output), values }).collect()
    }

    fn transfers(&self, places: &[Place]) -> Vec<Column> {
        let over = &self.equations.coordinates[self.over];
        let lead = self.name(self.over);
        let mut columns = Vec::new();
        for (i, coordinate) in self.equations.coordinates.iter().enumerate().filter(|(i, _)| *i != self.over) {
            let own = self.name(i);
            let per = |unit: &str, by: &str| if unit == by { "1".to_owned() } else { format!("{unit}/{by}") };
            let first = per(&coordinate.unit, &over.unit);
            let second = if first == "1" { format!("1/{}", over.unit) } else { format!("{first}^2") };
            let [q, s] = [&own, &lead].map(|name| self.symbol(name));
            let label = Text::new("transfer function, first order", "передаточная функция первого порядка");
            let quantity = Quantity { label, symbol: format!("d{q}/d{s}"), ..Quantity::new(&format!("d{own}/d{lead}"), &first) };
            columns.push(Column { quantity, values: places.iter().map(|p| p.first[i]).collect() });
            let label = Text::new("transfer function, second order", "передаточная функция второго порядка");
            let quantity = Quantity { label, symbol: format!("d²{q}/d{s}²"), ..Quantity::new(&format!("d2{own}/d{lead}2"), &second) };
            columns.push(Column { quantity, values: places.iter().map(|p| p.second[i]).collect() });
        }
        columns
    }
}
