//! The study `average`: a machine averaged over the turn of a fast angle, the balance of what turns it and of what the vibration takes, the speeds of steady turning and their stability.
//!
//! Over a parameter the speeds are its branches; folds are located. Motions of the machine itself are laid beside them.

mod curves;
mod formulas;
mod motions;
mod show;
mod tell;
mod walk;

use super::{Found, Given, Interrupts, Results, Rows, Study, agreed, overlaid};
use crate::failure::{Failure, Misuse};
use crate::machine::{self, Machine};
use crate::results::Conclusion;
use crate::results::finite::checked;
use crate::watch::{Lap, Watch};
use mechanics::asked::{Asked, Choice, Key, Kind, Like, Limits, Objection, Takes, Way, Words};
use mechanics::units::Dimension;
use words::explain::{Explanation, plain};
use words::{Language, Notice, Text};

/// The study.
pub struct SlowBalance;

static FROM: Choice = Choice {
    words: &["start", walk::NEIGHBOUR],
    metavar: "WHERE",
    code: "M071",
    unknown: ("motions cannot begin at `{}`", "движения не могут начинаться в `{}`"),
    help: ("start or neighbour", "start или neighbour"),
};

/// Its name and its keys.
pub static KIND: Kind = Kind::new(
    "average",
    (
        "Average a machine over the turn of a fast angle: balance of moments, speeds of steady turning, their stability",
        "Осреднить машину за оборот быстрого угла: баланс моментов, скорости установившегося вращения и их устойчивость",
    ),
)
.keys(&[
    Key::new("angle", Takes::Coordinate, ("the angle that turns fast", "быстро вращающийся угол"), "\"phi\"")
        .required()
        .option("The angle that turns fast", "Быстро вращающийся угол")
        .way(Way::Begins),
    Key::new(
        "slowest",
        Takes::Quantity(Like::Is(Dimension::ANGULAR_RATE, "rad/s"), Limits::NotZero),
        ("the first of the speeds that are looked at", "первая из рассматриваемых скоростей"),
        "\"10 rad/s\"",
    )
    .required()
    .option("The first of the speeds that are looked at", "Первая из рассматриваемых скоростей")
    .way(Way::Written),
    Key::new(
        "fastest",
        Takes::Quantity(Like::Is(Dimension::ANGULAR_RATE, "rad/s"), Limits::NotZero),
        ("the last of them", "последняя из них"),
        "\"60 rad/s\"",
    )
    .required()
    .option("The last of them", "Последняя из рассматриваемых скоростей")
    .way(Way::Written),
    Key::new(
        "instant",
        Takes::Wait,
        ("the instant at which formulas of time stand: the end of a run-up", "момент, на который берутся формулы времени: конец разгона"),
        "\"30 s\"",
    )
    .default("0", "0")
    .option("The instant at which formulas of time stand [default: 0]", "Момент, на который берутся формулы времени [по умолчанию: 0]"),
    Key::new(
        "parameter",
        Takes::Varied,
        ("a parameter over which the speeds of steady turning are followed", "параметр, вдоль которого прослеживаются скорости"),
        "\"Omega\"",
    )
    .option("A parameter over which the speeds are followed", "Параметр, вдоль которого прослеживаются скорости")
    .needs("from"),
    Key::new("from", Takes::Quantity(Like::Of("parameter"), Limits::None), ("its first value", "его первое значение"), "\"10 rad/s\"")
        .option("Its first value", "Его первое значение")
        .needs("to"),
    Key::new("to", Takes::Quantity(Like::Of("parameter"), Limits::None), ("its last value", "его последнее значение"), "\"40 rad/s\"")
        .option("Its last value", "Его последнее значение")
        .needs("from"),
    Key::new(
        "points",
        Takes::Count("M071", 3),
        ("number of speeds, and of values of the parameter", "число скоростей и значений параметра"),
        "61",
    )
    .default("201, 61 with `parameter`", "201, при `parameter` — 61")
    .option("Number of speeds, and of values of the parameter", "Число скоростей и значений параметра"),
    Key::new(
        "runs",
        Takes::Duration,
        (
            "motions of the machine itself over this time from the start of the file are laid beside: the mean speed over their last fifth",
            "рядом показаны движения самой машины за это время из начального состояния файла: средняя скорость за последнюю пятую часть",
        ),
        "\"60 s\"",
    )
    .option("Lay motions of the machine over this time beside: 60s", "Показать рядом движения самой машины за это время: 60с"),
    Key::new(
        "runs_from",
        Takes::Word(&FROM),
        (
            "where these motions begin: start (each at the start of the file) or neighbour (a slow run from `from` to `to` and back: each where the one at the value before ended)",
            "откуда начинаются эти движения: start (каждое из начального состояния файла) или neighbour (медленный проход от `from` до `to` и обратно: каждое из конца движения при соседнем значении)",
        ),
        "\"neighbour\"",
    )
    .default("\"start\"", "\"start\"")
    .option(
        "Where these motions begin, at the start of the file or, in a slow run forth and back, each where the one before ended [default: start]",
        "Откуда начинаются эти движения: из начального состояния файла или, при медленном проходе туда и обратно, из конца соседнего [по умолчанию: start]",
    )
    .needs("runs"),
])
.check(objections);

fn objections(asked: &Asked) -> Vec<Objection> {
    let mut found = Vec::new();
    if asked.coordinate("angle").is_some_and(|angle| angle.dimension.is_some() && !angle.is_angle()) {
        found.push(Objection::no_angle("angle"));
    }
    let ends = [asked.number("slowest"), asked.number("fastest")];
    if let [Some(slowest), Some(fastest)] = ends
        && (slowest >= fastest || slowest * fastest < 0.0)
    {
        found.push(
            Objection::at("fastest", "M071", "`fastest` is above `slowest`, of one sign", "`fastest` больше `slowest`, знаки одинаковы")
                .why("an angle that does not turn has no mean over a turn", "у угла, который не вращается, нет среднего за оборот")
                .help("write slowest = \"10 rad/s\", fastest = \"60 rad/s\"", "напишите slowest = \"10 рад/с\", fastest = \"60 рад/с\""),
        );
    }
    if let Some(half) = super::keys::half_a_range(asked) {
        found.push(half.help(
            "write parameter = \"Omega\", from = \"10 rad/s\", to = \"40 rad/s\"",
            "напишите parameter = \"Omega\", from = \"10 рад/с\", to = \"40 рад/с\"",
        ));
    }
    found.extend(super::keys::backwards(asked));
    found.extend(slow_run(asked));
    found
}

/// What a slow run needs: a parameter, a time, and equations that do not know when they are.
fn slow_run(asked: &Asked) -> Option<Objection> {
    let objection = |en: &str, ru: &str| Objection::at("runs_from", "M071", en, ru);
    if asked.word("runs_from") != Some(walk::NEIGHBOUR) {
        return None;
    }
    if !asked.has("parameter") || !asked.has("runs") {
        let found = objection("a slow run goes along a parameter", "медленный проход идёт вдоль параметра");
        return Some(found.help("write `parameter`, `from`, `to` and `runs`", "задайте `parameter`, `from`, `to` и `runs`"));
    }
    asked.number("instant").is_some_and(|instant| instant != 0.0).then(|| {
        objection("a slow run has no `instant`", "у медленного прохода нет `instant`")
            .why(
                "each of its motions begins at t = 0: a run-up that formulas of time prescribe would begin again",
                "каждое его движение начинается при t = 0: разгон, заданный формулами времени, начинался бы заново",
            )
            .help("take runs_from = \"start\"", "возьмите runs_from = \"start\"")
    })
}

impl Study for SlowBalance {
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn wanted(&self) -> Words {
        ("average the machine over its fast turn", "осреднить движение машины за быстрый оборот")
    }
    /// The speeds at which the moments balance, and where they jump.
    fn concludes(&self, _: &Machine, results: &Results, language: Language) -> Vec<Conclusion> {
        let told = |f: &&crate::results::Fact| ["speed_", "fold_"].iter().any(|start| f.quantity.name.starts_with(start));
        results.facts.iter().filter(told).map(|f| crate::results::found(f, language)).collect()
    }
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        let mut results = Results {
            kind: KIND.name,
            heading: Text::new("Averaged motion", "Осреднённое движение"),
            rows: Rows::Hidden,
            data: machine::no_numbers(machine),
            ..Results::default()
        };
        let done = if asked.has("parameter") {
            walk::walk(machine, asked, &mut results, watch)
        } else {
            tell::single(machine, asked, &mut results, watch)
        };
        if let Err(trouble) = done {
            results.fail(trouble);
        }
        watch.lap(Lap::Run);
        Some(checked(results))
    }
    fn merge(&self, _: &Machine, given: Given) -> Result<Asked, Failure> {
        let asked = overlaid(&KIND, given.written.or(given.of_file).ok_or_else(nothing_turns)?, given.line);
        agreed(&KIND, asked)
    }
    fn interrupts(&self) -> Interrupts {
        Interrupts::Kept
    }
    fn explanations(&self) -> &'static [Explanation] {
        EXPLANATIONS
    }
}

fn nothing_turns() -> Failure {
    Notice::new("S162", "which angle turns fast?", "какой угол вращается быстро?")
        .why("the file has no study `average`, and no --angle was given", "в файле нет расчёта `average`, а ключ --angle не задан")
        .help(
            "add --angle phi --slowest \"10 rad/s\" --fastest \"60 rad/s\"",
            "добавьте --angle phi --slowest \"10 рад/с\" --fastest \"60 рад/с\"",
        )
        .misuse()
}

const EXPLANATIONS: &[Explanation] = &[
    plain(
        "S161",
        ("no averaging over this angle", "осреднения по этому углу нет"),
        (
            "The study `average` lets an angle turn uniformly and looks for the motion of the rest that repeats after a turn. That needs a machine without connections, contacts and dry friction, \
             whose equations are the same after a turn and know no other rotation, and a rest that is damped where it resonates. Describe links by formulas of the coordinates, or simulate.",
            "Расчёт `average` считает вращение угла равномерным и ищет движение остальной машины, повторяющееся через оборот. Для этого нужна машина без связей, контактов и сухого трения, уравнения \
             которой через оборот те же и не содержат другого вращения, и сопротивление там, где возможен резонанс. Задайте звенья формулами от координат или выполните `simulate`.",
        ),
    ),
    plain(
        "S162",
        ("no angle to average over", "не задан угол осреднения"),
        (
            "The study `average` needs the angle that turns fast and the speeds between which a balance of moments is looked for: keys `angle`, `slowest`, `fastest`.",
            "Расчёту `average` нужны быстро вращающийся угол и скорости, между которыми ищется баланс моментов: ключи `angle`, `slowest`, `fastest`.",
        ),
    ),
];
