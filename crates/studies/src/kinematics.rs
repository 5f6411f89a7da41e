//! The study `kinematics`: places, velocities and accelerations over a range of the driven coordinate, transfer functions, instantaneous centres.

mod asked;
mod centres;
mod table;

pub use asked::{Kinematics, KinematicsEnd};

use super::keys::{OUTPUTS, OWN_PLOT, POINTS};
use super::{Finds, Found, Given, Interrupts, Repeats, Results, Rows, Study, overlaid};
use crate::failure::{Failure, Misuse};
use crate::machine::{self, Machine, explained};
use crate::provenance;
use crate::results::finite::checked;
use crate::watch::{Lap, Watch};
use algebra::arrange::Arrange;
use analysis::System;
use analysis::dataset::{Extreme, Trail};
use analysis::studies::kinematics::{Place, Way, follow};
use centres::{Centres, turns_in_plane};
use mechanics::asked::{Asked, Key, Kind, Like, Limits, Objection, Takes, Way as Comes, Words};
use program::lower::Drive;
use serde_json::json;
use std::f64::consts::TAU;
use symbolic::{Equations, Graph, SymbolId};
use table::Table;
use words::{Notice, Text};

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
    rows.arrange_by(|a, b| a.0.total_cmp(&b.0));
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
