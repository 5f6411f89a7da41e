//! The study `poincare`: section points of a motion, where a formula passes zero, at a named event, or once a period.

mod diagram;

use super::keys::{METHOD, OUTPUTS, PLOT, SETTLE, TOLERANCE_OF_MOTION, UNTIL};
use super::simulate::{Simulate, moving, options};
use super::{Finds, Found, Given, Interrupts, Results, Rows, Study, overlaid};
use crate::failure::{Failure, Misuse};
use crate::machine::{self, Machine, explained};
use crate::results::finite::checked;
use crate::watch::{Lap, Watch};
use crate::{plan, provenance};
use analysis::Dataset;
use analysis::marks::named::{Direction, Named};
use analysis::studies::poincare::{Poincare, Section};
use mechanics::asked::{Asked, Choice, Key, Kind, Objection, Takes, Value, Way, Words, Written};
use mechanics::model::{Plot, Times};
use report::figure::Pen;
use symbolic::equations::{Output, Role};
use symbolic::{Equations, Expr};
use words::explain::{Explanation, plain};
use words::{Notice, Text};

/// Points of a stroboscopic section where nobody says how many.
const POINTS: usize = 200;
/// Relative spread of values that the tolerance of a motion does not tell apart.
const DIGITS: f64 = 1e-9;
/// Name of the output whose zeros are the section.
const SECTION: &str = "section";

/// The study.
pub struct SectionPoints;

static DIRECTIONS: Choice = Choice {
    words: &["rising", "falling", "both"],
    metavar: "WAY",
    code: "M112",
    unknown: ("a section has no direction \"{}\"", "у сечения нет направления \"{}\""),
    help: ("write \"rising\", \"falling\" or \"both\"", "напишите \"rising\", \"falling\" или \"both\""),
};

/// Its name and its keys.
pub static KIND: Kind = Kind::new(
    "poincare",
    (
        "Find section points of a motion, where a formula passes zero or once a period",
        "Найти точки сечения движения: при переходе формулы через нуль или раз в период",
    ),
)
.keys(&[
    Key::new(
        "section",
        Takes::Section,
        (
            "formula over coordinates and rates whose zeros are the section",
            "формула от координат и скоростей, нули которой образуют сечение",
        ),
        "\"x'\"",
    )
    .option("Where the points are: a formula that passes zero", "Где берутся точки: формула, переходящая через нуль")
    .way(Way::Begins),
    Key::new(
        "direction",
        Takes::Word(&DIRECTIONS),
        ("in which direction: rising, falling or both", "в каком направлении: rising (вверх), falling (вниз) или both (оба)"),
        "\"both\"",
    )
    .default("\"rising\"", "\"rising\"")
    .option("In which direction it passes zero [default: rising]", "В каком направлении она проходит нуль [по умолчанию: rising]")
    .way(Way::Written),
    Key::new("event", Takes::Name, ("named event that is the section", "именованное событие, служащее сечением"), "\"top\"")
        .not_with("section", "M071")
        .option("The named event that is the section", "Именованное событие, служащее сечением")
        .way(Way::Begins),
    Key::new(
        "period",
        Takes::Duration,
        ("the section is the state once in this time, from t = 0", "сечение — состояние раз в это время, считая от t = 0"),
        "\"2*pi/w\"",
    )
    .not_with("section", "M071")
    .option("The state once in this time", "Состояние раз в это время")
    .way(Way::Begins),
    Key {
        required: false,
        about: (
            "the motion is followed no longer; required with `section` or `event`",
            "дольше движение не прослеживается; обязателен при `section` и `event`",
        ),
        ..UNTIL
            .option("The motion is followed no longer: 30, 30s, \"2 min\"", "Дольше движение не прослеживается: 30, 30с, \"2 мин\"")
            .way(Way::Written)
    },
    Key {
        about: ("time that is left out at the start", "время в начале, которое не учитывается"),
        ..SETTLE.option("Time that is left out at the start", "Время в начале, которое не учитывается")
    },
    Key::new(
        "points",
        Takes::Count("M071", 1),
        ("number of points; all up to `until` without it", "число точек; без ключа — все до `until`"),
        "500",
    )
    .default("200 with `period` alone", "200 при одном `period`")
    .option("Number of points", "Число точек"),
    Key::new(
        "coordinates",
        Takes::Formulas,
        (
            "columns as formulas over coordinates, rates and time, before those in `outputs`",
            "столбцы — формулы от координат, скоростей и времени, перед столбцами `outputs`",
        ),
        "[\"x - l\", \"x'\"]",
    ),
    Key::new(
        "over",
        Takes::Ranges,
        (
            "values of a parameter or start whose section points stand one below the other, a bifurcation diagram: name=linspace(first, last, number) or another range of `sweep`",
            "значения параметра или начального условия, для которых точки сечения записываются друг под другом (бифуркационная диаграмма): имя=linspace(первое, последнее, число) или другой набор, как в `sweep`",
        ),
        "\"F=linspace(1 N, 2 N, 101)\"",
    )
    .option(
        "Section points for each of these values, a bifurcation diagram: F=linspace(1 N, 2 N, 101)",
        "Точки сечения для каждого из этих значений, бифуркационная диаграмма: F=linspace(1 Н, 2 Н, 101)",
    )
    .way(Way::Written),
    TOLERANCE_OF_MOTION,
    METHOD,
    OUTPUTS,
    PLOT,
])
.check(objections);

fn objections(asked: &Asked) -> Vec<Objection> {
    let mut found = Vec::new();
    let passes = asked.has("section") || asked.has("event");
    if !passes && !asked.has("period") {
        found.push(
            Objection::whole(
                "M071",
                "the study poincare lacks `section`, `event` or `period`",
                "в расчёте poincare нет ни `section`, ни `event`, ни `period`",
            )
            .why(
                "points are taken where a formula passes zero, at an event, or once a period",
                "точки берутся при переходе формулы через нуль, в событии или раз в период",
            )
            .help("add section = \"x'\" or period = \"2*pi/w\"", "добавьте section = \"x'\" или period = \"2*pi/w\""),
        );
    }
    if passes && !asked.has("until") {
        found.push(
            Objection::whole("M071", "the study poincare lacks `until`", "в расчёте poincare нет `until`")
                .why("nobody knows how long the motion must be followed", "неизвестно, сколько прослеживать движение")
                .help("add until = \"100 s\"", "добавьте until = \"100 с\""),
        );
    }
    if let Some(Value::Ranges(ranges)) = asked.get("over")
        && ranges.len() > 1
    {
        found.push(
            Objection::at(
                "over",
                "M071",
                "a diagram of section points goes over one parameter",
                "диаграмма точек сечения строится по одному параметру",
            )
            .help("leave one range", "оставьте один набор значений"),
        );
    }
    if asked.has("direction") && !asked.has("section") {
        found.push(Objection::at("direction", "M071", "`direction` needs `section`", "ключу `direction` нужен `section`"));
    }
    found
}

impl Study for SectionPoints {
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn wanted(&self) -> Words {
        ("find the section points of the motion", "построить сечение Пуанкаре")
    }
    fn chapter(&self) -> &'static str {
        "motion"
    }
    fn finds(&self) -> Finds {
        Finds::Points
    }
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        let mut results = Results {
            kind: KIND.name,
            heading: Text::new("Poincaré section", "Сечение Пуанкаре"),
            rows: Rows::All,
            plots: asked.plots().to_vec(),
            pen: Pen::Dots,
            ..Results::default()
        };
        results.data = machine::no_numbers(machine);
        let done = if diagram::over(asked).is_some() {
            diagram::diagram(machine, asked, (&mut results, watch), points)
        } else {
            points(machine, asked, &mut results, watch)
        };
        results.trouble = done.err().or(results.trouble);
        watch.lap(Lap::Run);
        Some(checked(results))
    }
    fn merge(&self, _: &Machine, given: Given) -> Result<Asked, Failure> {
        Ok(overlaid(&KIND, given.written.or(given.of_file).ok_or_else(no_section)?, given.line))
    }
    fn interrupts(&self) -> Interrupts {
        Interrupts::Kept
    }
    fn explanations(&self) -> &'static [Explanation] {
        EXPLANATIONS
    }
}

fn points(machine: &Machine, asked: &Asked, results: &mut Results, watch: &mut Watch) -> Result<(), Notice> {
    let mut equations = machine.equations.clone();
    let columns = columns(&mut equations, asked);
    let section = section(machine, &mut equations, asked)?;
    let mut system = machine::lower(&equations).map_err(Notice::from)?;
    let say = |fault| explained(fault, &equations);
    moving(&equations).map_err(say)?;
    let start = system.start().map_err(say)?;
    let count = asked.count("points").or((asked.number("until").is_none()).then_some(POINTS));
    let until = asked.number("until").unwrap_or_else(|| longest(asked, count));
    let study = Simulate { until, times: Times::Automatic, outputs: columns.clone(), plots: Vec::new(), ..Simulate::of(asked) };
    let mut motion = options(&study, watch);
    motion.events = plan::events(&machine.model, &equations);
    motion.pushes = plan::pushes(&machine.model, &equations);
    let options = Poincare { section, settle: asked.number("settle").unwrap_or(0.0), points: count, motion };
    let outcome = (analysis::made::POINCARE)(&mut system, &start, options);
    let found = outcome.dataset.columns.first().map_or(0, |c| c.values.len());
    results.data = provenance::stamp(outcome.dataset, &machine.equations, &machine.model_hash);
    results.words.push(Text::new(format!("Section points: {found}."), format!("Точек сечения: {found}.")));
    results.own.insert("points".into(), serde_json::json!(found));
    results.trouble = outcome.fault.map(say);
    if results.plots.is_empty() {
        results.plots = picture(&columns, &equations, &results.data);
    }
    Ok(())
}

/// The first two quantities over one another; what the section holds comes last, it would draw a line.
fn picture(columns: &[String], equations: &Equations, data: &Dataset) -> Vec<Plot> {
    let formula = |name: &str| equations.outputs.iter().find(|o| o.name == name).map(|o| o.formula);
    let held = |name: &&String| {
        formula(name).is_some_and(|own| formula(SECTION) == Some(own)) || data.column(name).is_some_and(|c| constant(&c.values))
    };
    let (held, free): (Vec<&String>, Vec<&String>) = columns.iter().partition(held);
    match free.into_iter().chain(held).take(2).collect::<Vec<_>>()[..] {
        [x, y] => vec![Plot { title: Text::default(), x: Some(x.clone()), y: vec![y.clone()] }],
        _ => Vec::new(),
    }
}

/// Whether all values are one, to the digits of a motion.
fn constant(values: &[f64]) -> bool {
    let (low, high) = values.iter().filter(|v| v.is_finite()).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
    high - low <= DIGITS * low.abs().max(high.abs())
}

/// The end of a stroboscopic section of so many points, s.
fn longest(asked: &Asked, count: Option<usize>) -> f64 {
    let period = asked.number("period").unwrap_or(0.0);
    // a period more for the one that `settle` begins in
    asked.number("settle").unwrap_or(0.0) + period * (count.unwrap_or(POINTS) as f64 + 1.0)
}

/// Names of the columns: formulas of the study first, then the results asked for; the usual ones when nobody asks.
fn columns(equations: &mut Equations, asked: &Asked) -> Vec<String> {
    let formulas: &[Written] = if let Some(Value::Formulas(list)) = asked.get("coordinates") { list } else { &[] };
    for written in formulas {
        output(equations, &written.text, (&written.unit, Role::Named), written.formula);
    }
    let mut columns: Vec<String> = formulas.iter().map(|f| f.text.clone()).collect();
    match asked.words("outputs") {
        [] if columns.is_empty() => columns = plan::usual_columns(equations),
        names => columns.extend(names.iter().cloned()),
    }
    plan::columns_with_plots(&columns, asked.plots(), equations)
}

fn output(equations: &mut Equations, name: &str, (unit, role): (&str, Role), formula: Expr) {
    let symbol = equations.graph.symbol_id(name, 0);
    equations.outputs.push(Output { name: name.into(), symbol, unit: unit.into(), display: None, label: Text::default(), role, formula });
}

fn section(machine: &Machine, equations: &mut Equations, asked: &Asked) -> Result<Section, Notice> {
    if let Some(name) = asked.word("event") {
        let events = plan::events(&machine.model, equations);
        return events.iter().find(|e| e.name == name).cloned().map(Section::Passing).ok_or_else(|| no_event(name, &events));
    }
    let formula = match asked.get("section") {
        Some(Value::Formula(formula)) => *formula,
        // the name of an angle is a formula as well
        Some(Value::Coordinate(angle)) => equations.graph.symbol(angle.symbol),
        _ => return Ok(Section::Every(asked.number("period").ok_or_else(nowhere)?)),
    };
    let direction = match asked.word("direction") {
        Some("falling") => Direction::Falling,
        Some("both") => Direction::Both,
        _ => Direction::Rising,
    };
    output(equations, SECTION, ("1", Role::Event), formula);
    Ok(Section::Passing(Named { name: SECTION.into(), output: equations.outputs.len() - 1, direction, stop: false }))
}

fn no_event(name: &str, events: &[Named]) -> Notice {
    let trouble = Notice::new("S118", format!("the file has no event `{name}`"), format!("в файле нет события `{name}`"));
    match words::nearest(name, events.iter().map(|e| e.name.as_str())) {
        Some(near) => trouble.help(format!("did you mean `{near}`?"), format!("может быть, `{near}`?")),
        None => trouble.help("add [events] with this name, or write `section`", "добавьте событие в [events] или напишите `section`"),
    }
}

fn nowhere() -> Notice {
    Notice::new("S119", "where shall the motion be looked at?", "где брать точки движения?")
        .why("the file has no study `poincare`, and no section was given", "в файле нет расчёта `poincare`, и сечение не задано")
        .help(
            "add --section \"x'\" --until 100, or --period 2 --points 500",
            "добавьте --section \"x'\" --until 100 либо --period 2 --points 500",
        )
}

fn no_section() -> Failure {
    nowhere().misuse()
}

const EXPLANATIONS: &[Explanation] = &[
    plain(
        "S117",
        ("Too few section points", "Мало точек сечения"),
        (
            "The study `poincare` follows the motion until it has passed its section as often as `points` says, but not beyond `until`. What was found is \
             kept. Take a larger `until`, fewer points, or a section that the motion passes.",
            "Расчёт `poincare` прослеживает движение, пока оно не пройдёт сечение столько раз, сколько задано в `points`, но не дольше `until`. Найденное \
             сохраняется. Увеличьте `until`, уменьшите число точек или выберите сечение, которое движение проходит.",
        ),
    ),
    plain(
        "S118",
        ("No such event", "Нет такого события"),
        (
            "`event` of the study `poincare` names an event of the table [events]; the file has none of this name.",
            "Ключ `event` расчёта `poincare` называет событие из таблицы [events]; в файле события с таким именем нет.",
        ),
    ),
    plain(
        "S119",
        ("No section", "Не задано сечение"),
        (
            "Section points are taken where a formula passes zero (`section`), at a named event (`event`) or once a period (`period`). The file has no study \
             `poincare` and the command line gives none of them.",
            "Точки сечения берутся при переходе формулы через нуль (`section`), в именованном событии (`event`) или раз в период (`period`). В файле нет \
             расчёта `poincare`, и в командной строке сечение не задано.",
        ),
    ),
];
