//! The study `stability`: what becomes of small disturbances of a machine whose linear equations have periodic coefficients.
//!
//! About a motion or a place of rest it takes the multipliers of the study `periodic`; a machine with one degree of freedom has Hill's equation besides, which
//! is solved a second way. With `angle` the machine is reduced to that coordinate, which runs uniformly: ψ(φ) = K(φ)/J(φ), φ = ωt. Along a parameter the
//! boundaries of stability are located. Of motions that never come back Lyapunov's exponents are asked.

mod asked;
mod boundaries;
mod lyapunov;
pub(crate) mod plane;
mod point;
mod reduction;
mod show;
mod single;
mod walk;

use super::keys::{PERIOD, SECTION, SETTLE, TOLERANCE, TURNS, backwards, half_a_range, turns_of_no_angle};
use super::{Finds, Found, Given, Interrupts, Repeats, Results, Study, agreed, idle, overlaid, turns_of_an_angle};
use crate::Failure;
use crate::machine::{self, Machine};
use crate::results::Conclusion;
use crate::results::finite::checked;
use crate::watch::{Lap, Watch};
use asked::Stability;
use mechanics::asked::{Asked, Key, Kind, Like, Limits, Objection, Takes, Way, Words};
use mechanics::units::Dimension;
use words::explain::{Explanation, plain};
use words::{Language, Text};

/// Sentences of a verdict that a calculation repeats at its end: what becomes of disturbances, and why.
const TOLD: usize = 2;

/// The study.
pub struct Disturbances;

/// Its name and its keys.
pub static KIND: Kind = Kind::new(
    "stability",
    (
        "Find whether small disturbances grow: multipliers, exponents, Mathieu's and Hill's equation, boundaries",
        "Найти, растут ли малые возмущения: мультипликаторы, показатели, уравнения Матьё и Хилла, границы устойчивости",
    ),
)
.keys(&[
    SECTION,
    TURNS,
    PERIOD,
    SETTLE,
    Key::new(
        "angle",
        Takes::Coordinate,
        (
            "the only coordinate, which runs uniformly while the machine swings about it: reduction to J(φ), K(φ) and Hill's equation",
            "единственная координата, которая равномерно растёт, пока машина колеблется около неё: приведение к J(φ), K(φ) и уравнению Хилла",
        ),
        "\"phi\"",
    )
    .not_with("period", "M071")
    .option("Reduce the machine to this coordinate, which runs uniformly", "Привести машину к этой координате, которая равномерно растёт")
    .way(Way::Begins),
    Key::new(
        "speed",
        Takes::Quantity(Like::Is(Dimension::ANGULAR_RATE, "rad/s"), Limits::NotZero),
        ("uniform rate of `angle`", "равномерная скорость координаты `angle`"),
        "\"250 rad/s\"",
    )
    .default("starting rate", "начальная скорость")
    .option("Its uniform rate [default: the starting rate]", "Её равномерная скорость [по умолчанию: начальная скорость]")
    .way(Way::Written),
    Key::new(
        "parameter",
        Takes::Varied,
        ("a parameter along which boundaries of stability are located", "параметр, вдоль которого ищутся границы устойчивости"),
        "\"R\"",
    )
    .option("A parameter along which boundaries are located", "Параметр, вдоль которого ищутся границы устойчивости")
    .needs("from"),
    Key::new("from", Takes::Quantity(Like::Of("parameter"), Limits::None), ("its first value", "его первое значение"), "\"0.05 m\"")
        .option("Its first value", "Его первое значение")
        .needs("to"),
    Key::new("to", Takes::Quantity(Like::Of("parameter"), Limits::None), ("its last value", "его последнее значение"), "\"0.25 m\"")
        .option("Its last value", "Его последнее значение")
        .needs("from"),
    Key::new(
        "lyapunov",
        Takes::Duration,
        (
            "Lyapunov's exponents of the motion from the start of the file, over this time after `settle`",
            "показатели Ляпунова движения из начального состояния файла за это время после `settle`",
        ),
        "\"2000 s\"",
    )
    .option("Lyapunov's exponents over this time: 2000s", "Показатели Ляпунова за это время: 2000с")
    .way(Way::Begins),
    Key::new(
        "points",
        Takes::Count("M071", 2),
        ("number of its values, or of places of the turn with `angle`", "число его значений, а при `angle` — положений за оборот"),
        "73",
    )
    .default("201, 37", "201, 37")
    .option("Number of values, or of places of the turn", "Число значений или положений за оборот"),
    TOLERANCE,
])
.check(objections);

fn objections(asked: &Asked) -> Vec<Objection> {
    let mut found = Vec::new();
    if asked.coordinate("angle").is_some_and(|angle| angle.dimension.is_some() && !angle.is_angle()) {
        found.push(Objection::no_angle("angle"));
    }
    if let Some(half) = half_a_range(asked) {
        found.push(
            half.why("boundaries are looked for between two values of a parameter", "границы ищут между двумя значениями параметра").help(
                "write parameter = \"R\", from = \"0.1 m\", to = \"0.25 m\"",
                "напишите parameter = \"R\", from = \"0.1 m\", to = \"0.25 m\"",
            ),
        );
    }
    found.extend(backwards(asked));
    if asked.has("speed") && !asked.has("angle") {
        found.push(
            Objection::at("speed", "M071", "`speed` needs `angle`", "ключу `speed` нужен `angle`")
                .why("it is the rate at which that coordinate runs", "это скорость, с которой растёт эта координата"),
        );
    }
    if let Some(other) = ["angle", "section", "period", "parameter"].into_iter().find(|key| asked.has("lyapunov") && asked.has(key)) {
        found.push(
            Objection::at(other, "M071", format!("both `lyapunov` and `{other}` are given"), format!("заданы и `lyapunov`, и `{other}`"))
                .why(
                    "Lyapunov's exponents are those of the motion from the start, whether it comes back or not",
                    "показатели Ляпунова относятся к движению из начального состояния, возвращается оно или нет",
                )
                .help(
                    "keep one; over a parameter `strutt sweep` repeats the study",
                    "оставьте одно; вдоль параметра расчёт повторяет `strutt sweep`",
                ),
        );
    }
    if asked.has("angle") && asked.has("section") {
        found.push(
            Objection::at("angle", "M071", "both `section` and `angle` are given", "заданы и `section`, и `angle`")
                .why(
                    "`section` is about a motion of the machine, `angle` about its reduction",
                    "`section` относится к движению машины, `angle` — к её приведению",
                )
                .help("keep one", "оставьте одно"),
        );
    }
    found.extend(turns_of_no_angle(asked));
    found
}

impl Study for Disturbances {
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn wanted(&self) -> Words {
        ("find whether small disturbances grow", "исследовать устойчивость по отношению к малым возмущениям")
    }
    fn concludes(&self, _: &Machine, results: &Results, language: Language) -> Vec<Conclusion> {
        let stable = match results.own.get("verdict").and_then(serde_json::Value::as_str) {
            Some("stable") => Some(true),
            Some("unstable") => Some(false),
            _ => None,
        };
        let growth = results.facts.iter().find(|f| f.quantity.name == "growth").map(|f| f.value);
        let told = results.words.iter().take(TOLD).map(|verdict| Conclusion::Disturbed { stable, growth, verdict: verdict.clone() });
        // along a parameter the boundaries are what was found
        let bounds = results.facts.iter().filter(|f| f.quantity.name.starts_with("boundary")).map(|f| crate::results::found(f, language));
        told.chain(bounds).collect()
    }
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        let mut results = Results { kind: KIND.name, heading: Text::new("Stability", "Устойчивость"), ..Results::default() };
        results.data = machine::no_numbers(machine);
        let study = Stability::of(asked);
        let done = match (lyapunov::Long::of(asked), &study.over) {
            (Some(long), _) => lyapunov::long(machine, &long, &mut results, watch),
            (None, Some(range)) => walk::walk(machine, (&study, range), &mut results, watch),
            (None, None) => single::single(machine, &study, &mut results, watch),
        };
        if let Err(trouble) = done {
            results.fail(trouble);
        }
        watch.lap(Lap::Run);
        Some(checked(results))
    }
    fn merge(&self, _: &Machine, given: Given) -> Result<Asked, Failure> {
        let asked = overlaid(&KIND, given.written.or(given.of_file).unwrap_or_else(|| Asked::new(KIND.name)), given.line);
        turns_of_an_angle(given.line, &asked)?;
        if given.line.has("speed") && !asked.has("angle") {
            return Err(idle("--speed", &Text::new("no angle runs: --angle phi", "ни одна координата не растёт равномерно: --angle phi")));
        }
        agreed(&KIND, asked)
    }
    fn finds(&self) -> Finds {
        Finds::Verdict
    }
    fn interrupts(&self) -> Interrupts {
        Interrupts::Kept
    }
    fn repeats(&self) -> Repeats {
        Repeats::Numbers
    }
    fn explanations(&self) -> &'static [Explanation] {
        EXPLANATIONS
    }
}

const EXPLANATIONS: &[Explanation] = &[
    plain(
        "S141",
        ("no multipliers", "мультипликаторов нет"),
        (
            "The study `stability` follows small disturbances over a period. Where the motion only touches a switch, meets two of them at once or has infinitely many impacts, \
             its end has no derivative by its start, and nothing is said of stability. Change a parameter a little; `simulate` from neighbouring starts shows what \
             becomes of disturbances.",
            "Расчёт `stability` прослеживает малые возмущения за период. Если движение лишь касается поверхности переключения, встречает два переключения сразу или содержит \
             бесконечно много ударов, производной конца по началу нет, и об устойчивости ничего не сказано. Немного измените параметр; что станет с \
             возмущениями, показывает `simulate` из соседних начальных состояний.",
        ),
    ),
    plain(
        "S142",
        ("no reduction to one equation", "машина не приводится к одному уравнению"),
        (
            "With `angle` the study `stability` writes J(φ) q'' + B(φ) q' + K(φ) q = 0 at each position φ of the machine and lets φ run uniformly. That needs one coordinate, no \
             connection that ties it to others, no time in the equations, a positive J and coefficients that are smooth and repeat after a turn. Describe the positions of the links by \
             formulas of that coordinate (the rod of a slider-crank: asin(r/l*sin(phi))), or ask for the motion itself with `period` or `section`.",
            "С ключом `angle` расчёт `stability` записывает J(φ) q'' + B(φ) q' + K(φ) q = 0 в каждом положении φ машины и считает рост φ равномерным. Для этого нужна \
             одна координата, не связанная с другими, уравнения без явного времени, положительный J и гладкие коэффициенты, которые повторяются через \
             оборот. Задайте положения звеньев формулами от этой координаты (шатун: asin(r/l*sin(phi))) или исследуйте само движение, задав `period` или `section`.",
        ),
    ),
];
