//! The study `map`: another study over a plane of two parameters, starts or starting rates; where its regime or verdict changes the plane is divided and the boundary closed in.
//!
//! Every place is computed from the start of the file, without a memory of its neighbours, so that a place is the same whichever way the map came to it, on any number of threads and
//! after a kill.

mod classes;
mod clusters;
mod command;
mod places;
mod show;
mod tell;
mod tongues;

use super::keys::{LEVEL, REGIMES};
use super::{Extra, Found, Given, Interrupts, Repeats, Results, Rows, Studies, Study, agreed, overlaid};
use crate::failure::{Failure, Misuse};
use crate::machine::{self, Machine};
use crate::repeat;
use crate::results::finite::checked;
use crate::watch::{Lap, Watch};
use analysis::studies::map::Grid;
use mechanics::asked::{Asked, Key, Kind, Limits, Objection, Takes, Way, Words};
use words::explain::{Explanation, plain};
use words::{Notice, Text};

/// Coarse cells along each side without a word of the user.
const CELLS: usize = 40;
/// Halvings of a cell with a boundary without a word of the user.
const REFINE: usize = 3;
/// Share of a range to which boundaries are closed in without a word of the user: a finest cell of 40 · 2³ is three of them.
const ACCURACY: f64 = 1e-3;
/// A boundary is not closed in any further than this: some hundred roundings of a value.
const FINEST: f64 = 1e-13;
/// Finest cells along a side at most: a map all of whose places are computed has a million of them, some 400 bytes each.
const MOST_FINEST: usize = 1000;

/// The study.
pub struct Plane;

/// Its name and its keys.
pub static KIND: Kind = Kind::new(
    "map",
    (
        "Map regimes, verdicts or numbers over two parameters, with their boundaries",
        "Построить карту режимов, устойчивости или чисел на плоскости двух параметров с границами областей",
    ),
)
.keys(&[
    Key::new(
        "x",
        Takes::Stretch,
        ("what changes from left to right: name=from..to", "что изменяется слева направо: имя=от..до"),
        "\"m=2 g..60 g\"",
    )
    .required()
    .option("What changes from left to right: \"m=2 g..60 g\"", "Что изменяется слева направо: \"m=2 г..60 г\"")
    .way(Way::Begins),
    Key::new("y", Takes::Stretch, ("what changes upwards: name=from..to", "что изменяется снизу вверх: имя=от..до"), "\"b=10 N s/m..50 N s/m\"")
        .required()
        .option("What changes upwards: \"b=10 N s/m..50 N s/m\"", "Что изменяется снизу вверх: \"b=10 Н с/м..50 Н с/м\"")
        .way(Way::Begins),
    Key::new(
        "cells",
        Takes::Count("M071", 1),
        ("coarse cells along each side, all corners of which are computed", "число крупных ячеек вдоль каждой стороны; вычисляются все их вершины"),
        "40",
    )
    .default("40", "40")
    .option("Coarse cells along each side [default: 40]", "Число крупных ячеек вдоль каждой стороны [по умолчанию: 40]"),
    Key::new(
        "refine",
        Takes::Count("M071", 0),
        ("how often a cell with a boundary is halved both ways", "сколько раз ячейка с границей делится пополам по обоим направлениям"),
        "3",
    )
    .default("3", "3")
    .option("Halvings of cells with a boundary [default: 3]", "Число делений ячеек с границей [по умолчанию: 3]"),
    Key::new(
        "accuracy",
        Takes::Number(Limits::NotZero),
        ("share of a range to which boundaries are closed in", "доля промежутка, с которой уточняются границы"),
        "1e-5",
    )
    .default("1e-3", "1e-3")
    .option(
        "Share of a range to which boundaries are closed in [default: 1e-3]",
        "Доля промежутка, с которой уточняются границы [по умолчанию: 1e-3]",
    ),
    Key::new(
        "observe",
        Takes::Observed,
        (
            "numbers that are mapped, or one, as `sweep` observes them; the first is what `level` is about. Without `level` and `regimes` they are grouped by gaps between their values",
            "числа, карта которых строится, или одно, записанные как в `sweep`; к первому относится `level`. Без `level` и `regimes` они разбиваются на группы по разрывам между значениями",
        ),
        "[\"mean(phi', 20 s, 30 s)\"]",
    )
    .option(
        "What is mapped: mean(x, 20 s, 30 s), max(x), min(x), amplitude(x), last(x), events, or a number of the study's JSON: period, multipliers.1.abs",
        "Карта чего: mean(x, 20 с, 30 с), max(x), min(x), amplitude(x), last(x), events либо число из JSON расчёта: period, multipliers.1.abs",
    )
    .way(Way::Written),
    LEVEL.way(Way::Written),
    REGIMES.not_with("level", "M071").way(Way::Written),
    repeat::OF,
])
.check(objections);

/// How the plane is divided.
fn grid(asked: &Asked) -> Grid {
    let count = |key, default| u32::try_from(asked.count(key).unwrap_or(default)).unwrap_or(u32::MAX);
    Grid { cells: count("cells", CELLS), refine: count("refine", REFINE), accuracy: asked.number("accuracy").unwrap_or(ACCURACY) }
}

fn objections(asked: &Asked) -> Vec<Objection> {
    let mut found = Vec::new();
    let (cells, refine) = (asked.count("cells").unwrap_or(CELLS), asked.count("refine").unwrap_or(REFINE));
    let finest = u32::try_from(refine).ok().and_then(|refine| 1_usize.checked_shl(refine)).and_then(|parts| cells.checked_mul(parts));
    if finest.is_none_or(|finest| finest > MOST_FINEST) {
        found.push(
            Objection::at(
                "cells",
                "M379",
                format!("{cells} cells halved {refine} times are more than {MOST_FINEST} finest cells along a side"),
                format!("{cells} ячеек, {refine} раз делённых пополам, — это больше {MOST_FINEST} мельчайших ячеек вдоль стороны"),
            )
            .why(
                "a map all of whose places are computed would not fit into memory",
                "карта, все точки которой вычислены, не поместилась бы в памяти",
            )
            .help(
                "take fewer cells or fewer halvings: boundaries are closed in to `accuracy` whatever the cells are",
                "возьмите меньше ячеек или делений: границы уточняются до `accuracy` при любых ячейках",
            ),
        );
    }
    if asked.number("accuracy").is_some_and(|share| !(FINEST..=1.0).contains(&share)) {
        found.push(
            Objection::at("accuracy", "M379", "`accuracy` is a share of a range: 1e-13 ... 1", "`accuracy` — доля промежутка: 1e-13 ... 1")
                .help("write accuracy = 1e-5", "напишите accuracy = 1e-5"),
        );
    }
    let names =
        ["x", "y"].map(|key| if let Some(mechanics::asked::Value::Ranges(ranges)) = asked.get(key) { ranges.first() } else { None });
    if let [Some(x), Some(y)] = names
        && x.name == y.name
    {
        found.push(Objection::at(
            "y",
            "M379",
            format!("`{}` cannot change both ways", y.name),
            format!("`{}` не может изменяться по обоим направлениям", y.name),
        ));
    }
    if asked.has("level") && !asked.has("observe") {
        found.push(
            Objection::at("level", "M379", "`level` needs `observe`", "ключу `level` нужен `observe`")
                .why("it is a level of the first number that is observed", "это уровень первого из наблюдаемых чисел"),
        );
    }
    found
}

impl Study for Plane {
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn wanted(&self) -> Words {
        ("map the regimes over two parameters", "построить карту режимов на плоскости двух параметров")
    }
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        let mut results = Results {
            kind: KIND.name,
            heading: Text::new("Map", "Карта"),
            rows: Rows::Hidden,
            data: machine::no_numbers(machine),
            ..Results::default()
        };
        if let Err(trouble) = tell::mapped(machine, (asked, &repeat::inner(asked, &KIND), grid(asked)), &mut results, watch) {
            results.fail(trouble);
        }
        watch.lap(Lap::Run);
        Some(checked(results))
    }
    fn merge(&self, _: &Machine, given: Given) -> Result<Asked, Failure> {
        let asked = given.written.or(given.of_file).ok_or_else(nothing_to_map)?;
        let asked = overlaid(&KIND, asked, given.line);
        agreed(&KIND, asked)
    }
    fn inner(&self, all: &Studies) -> Vec<&'static Key> {
        repeat::keys(all, &KIND)
    }
    fn interrupts(&self) -> Interrupts {
        Interrupts::Kept
    }
    fn repeats(&self) -> Repeats {
        Repeats::Never
    }
    fn extras(&self) -> &'static [Extra] {
        &[Extra::Threads, Extra::Resume]
    }
    fn explanations(&self) -> &'static [Explanation] {
        EXPLANATIONS
    }
}

fn nothing_to_map() -> Failure {
    Notice::new("C033", "a map of what?", "карту чего строить?")
        .why("the file has no study `map`, and no --x was given", "в файле нет расчёта `map`, а ключ --x не задан")
        .help(
            "add --x \"m=2 g..60 g\" --y \"b=10 N s/m..50 N s/m\" --observe \"mean(phi', 20 s, 30 s)\"",
            "добавьте --x \"m=2 г..60 г\" --y \"b=10 Н с/м..50 Н с/м\" --observe \"mean(phi', 20 с, 30 с)\"",
        )
        .misuse()
}

const EXPLANATIONS: &[Explanation] = &[plain(
    "M379",
    ("no map", "карта не определена"),
    (
        "A map goes over two different names, each between two values. Its coarse cells, halved as often as `refine` says, are at most 1000 along a side: so many places fit into memory even \
         when all of them must be computed. `accuracy` is the share of a range to which boundaries are closed in, and `level` is that of the first number in `observe`.",
        "Карта строится по двум разным именам, каждое — между двумя значениями. Её крупные ячейки, делённые столько раз, сколько задано в `refine`, дают не больше 1000 мельчайших вдоль \
         стороны: столько точек помещается в памяти, даже если вычислить надо все. `accuracy` — доля промежутка, с которой уточняются границы, `level` — уровень первого числа из `observe`.",
    ),
)];
