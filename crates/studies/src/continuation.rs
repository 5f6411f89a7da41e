//! The study `continue`: regimes and places of rest along a parameter, over folds and onto the branches that part, with what happens on the way.

mod asked;
mod beside;
mod creases;
mod explained;
mod family;
mod phrases;
mod show;
mod tell;

use super::keys::{PERIOD, SECTION, SETTLE, TOLERANCE, TURNS, backwards, go_together, turns_of_no_angle};
use super::{Found, Given, Interrupts, Repeats, Results, Study, agreed, idle, overlaid};
use crate::Failure;
use crate::equilibrium;
use crate::machine::{self, Machine, explained as in_symbols};
use crate::periodic;
use crate::results::finite::checked;
use crate::results::{Fact, Rows};
use crate::watch::{Lap, Watch};
use analysis::studies::continuation::{Diagram, Family, Options, Second, backbone, regimes, rests};
use analysis::studies::periodic::{Listener, Periodic};
use asked::{BACKBONE, Beside, Branched, Followed};
use family::Bound;
use mechanics::asked::{Asked, Choice, Key, Kind, Like, Limits, Objection, Takes, Value, Way, Words};
use words::explain::Explanation;
use words::{Notice, Text};

/// The study.
pub struct Branches;

static OF: Choice = Choice {
    words: &[periodic::KIND.name, equilibrium::KIND.name, BACKBONE],
    metavar: "WHAT",
    code: "M071",
    unknown: ("`{}` cannot be followed", "`{}` проследить нельзя"),
    help: ("periodic, equilibrium or backbone", "periodic, equilibrium или backbone"),
};

static KIND: Kind = Kind::new(
    "continue",
    (
        "Follow periodic motions or equilibria along a parameter: folds, branches, their stability",
        "Проследить периодические движения или равновесия вдоль параметра: повороты, ветвления, устойчивость ветвей",
    ),
)
.keys(&[
    Key::new("parameter", Takes::Varied, ("the parameter that changes", "параметр, который меняется"), "\"w\"")
        .option("The parameter that changes", "Параметр, который меняется")
        .way(Way::Written),
    Key::new("from", Takes::Quantity(Like::Of("parameter"), Limits::None), ("its least value", "его наименьшее значение"), "\"0.2 rad/s\"")
        .option("Its least value", "Его наименьшее значение")
        .way(Way::Written),
    Key::new("to", Takes::Quantity(Like::Of("parameter"), Limits::None), ("its greatest value", "его наибольшее значение"), "\"3 rad/s\"")
        .option("Its greatest value", "Его наибольшее значение")
        .way(Way::Written),
    Key::new(
        "of",
        Takes::Word(&OF),
        (
            "what is followed: periodic (motions), equilibrium (places of rest) or backbone (free oscillations without losses from a natural mode on, over their frequency)",
            "что прослеживается: periodic (периодические движения), equilibrium (положения равновесия) или backbone (свободные колебания без потерь, начиная с собственной формы, в зависимости от частоты)",
        ),
        "\"periodic\"",
    )
    .default(
        "periodic with a `period` or `section` in the file, otherwise equilibrium",
        "periodic, если в файле есть `period` или `section`, иначе equilibrium",
    )
    .option("What is followed", "Что прослеживается"),
    Key::new(
        "mode",
        Takes::Count("M071", 1),
        ("the natural mode at which a backbone curve begins, 1 the lowest", "собственная форма, с которой начинается скелетная кривая; 1 — низшая"),
        "2",
    )
    .default("1", "1")
    .option("The natural mode of a backbone curve [default: 1]", "Собственная форма скелетной кривой [по умолчанию: 1]"),
    Key::new(
        "frequencies",
        Takes::FrequencyRange,
        (
            "frequencies of a backbone curve, from and to, that of small oscillations among them; Hz count periods",
            "частоты скелетной кривой, от и до, включая частоту малых колебаний; Гц — число периодов",
        ),
        "[\"0.9 rad/s\", \"2 rad/s\"]",
    )
    .default("0.2 ... 5 times that of small oscillations", "0,2 ... 5 частот малых колебаний")
    .option(
        "Frequencies of a backbone curve, from and to: 0.9,2 (rad/s) or \"1 Hz,2 Hz\"",
        "Частоты скелетной кривой, от и до: 0.9,2 (рад/с) или \"1 Гц;2 Гц\"",
    ),
    Key::new(
        BACKBONE,
        Takes::Ranges,
        (
            "the backbone curve of `mode` over the response: the values with which nothing is lost and nothing drives, an array of name=value; `parameter` is the frequency of the load",
            "скелетная кривая формы `mode` поверх амплитудной характеристики: значения, при которых нет потерь и нагрузок, массив строк имя=значение; `parameter` — частота нагрузки",
        ),
        "[\"b=0 N s/m\", \"F=0 N\"]",
    )
    .option(
        "Lay the backbone curve over the response: a value with which nothing is lost or nothing drives, \"b=0 N s/m\"; may be repeated",
        "Показать скелетную кривую: значение, при котором нет потерь или нагрузки, \"b=0 Н с/м\"; ключ можно повторять",
    ),
    SECTION,
    TURNS,
    PERIOD,
    SETTLE,
    Key::new("points", Takes::Count("M071", 2), ("most points of a branch", "наибольшее число точек ветви"), "500")
        .default("2000, 300 of a backbone curve", "2000, для скелетной кривой 300")
        .option("Most points of a branch", "Наибольшее число точек ветви"),
    Key::new(
        "branches",
        Takes::Count("M071", 1),
        (
            "most branches; 1: those that part are named and not followed",
            "наибольшее число ветвей; при 1 отходящие ветви называются, но не прослеживаются",
        ),
        "4",
    )
    .default("12, 1 of a backbone curve", "12, для скелетной кривой 1")
    .option("Most branches", "Наибольшее число ветвей"),
    Key::new(
        "second",
        Takes::Stretch,
        (
            "a second parameter, along which the folds, period doublings, Hopf and torus points of the branches are followed: name=from..to",
            "второй параметр, вдоль которого прослеживаются складки, удвоения периода, точки Хопфа и рождения тора: имя=от..до",
        ),
        "\"F=0.1 N..2 N\"",
    )
    .option(
        "A second parameter for curves of special points: \"F=0.1 N..2 N\"",
        "Второй параметр для кривых особых точек: \"F=0.1 Н..2 Н\"",
    )
    .way(Way::Written),
    TOLERANCE,
])
.check(objections);

fn objections(asked: &Asked) -> Vec<Objection> {
    let mut found = Vec::new();
    let free = asked.word("of") == Some(BACKBONE);
    if let Some(key) = ["mode", "frequencies"].into_iter().find(|key| !free && asked.has(key) && !(*key == "mode" && asked.has(BACKBONE))) {
        found.push(
            Objection::at(key, "M071", format!("`{key}` belongs to a backbone curve"), format!("`{key}` относится к скелетной кривой"))
                .help("write of = \"backbone\"", "напишите of = \"backbone\""),
        );
    }
    if asked.has(BACKBONE) && (free || asked.word("of") == Some(equilibrium::KIND.name)) {
        found.push(
            Objection::at(
                BACKBONE,
                "M071",
                "a backbone curve lies over motions of a driven machine",
                "скелетная кривая показывается поверх движений под нагрузкой",
            )
            .help("take of = \"periodic\", or leave `backbone` out", "возьмите of = \"periodic\" или уберите `backbone`"),
        );
    }
    if free && asked.has("second") {
        found.push(
            Objection::at("second", "M071", "a backbone curve has no second parameter", "у скелетной кривой нет второго параметра")
                .why("its frequency follows from its energy", "её частота определяется энергией")
                .help("leave `second` out", "уберите `second`"),
        );
    }
    let ranged = asked.has("parameter") && asked.has("from") && asked.has("to");
    if !free && !ranged {
        found.push(
            go_together()
                .why("branches are followed between two values of a parameter", "ветви прослеживаются между двумя значениями параметра")
                .help(
                    "write parameter = \"w\", from = \"0.2 rad/s\", to = \"3 rad/s\"",
                    "напишите parameter = \"w\", from = \"0.2 rad/s\", to = \"3 rad/s\"",
                ),
        );
    }
    if let Some(Value::Ranges(ranges)) = asked.get("second")
        && let Some(name) = ranges.first().map(|range| range.name.as_str()).filter(|name| asked.word("parameter") == Some(*name))
    {
        found.push(
            Objection::at("second", "M071", format!("`{name}` is both parameters"), format!("`{name}` — оба параметра сразу"))
                .why("folds are followed in the plane of two parameters", "складки прослеживаются на плоскости двух параметров")
                .help("name another parameter in `second`", "назовите в `second` другой параметр"),
        );
    }
    found.extend(backwards(asked));
    found.extend(turns_of_no_angle(asked));
    found
}

impl Study for Branches {
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn wanted(&self) -> Words {
        ("follow the regimes along a parameter", "проследить режимы вдоль параметра")
    }
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        let mut study = Branched::of(machine, asked);
        let heading = match study.of {
            Followed::Free { .. } => Text::new("Backbone curve", "Скелетная кривая"),
            _ => Text::new("Branches along a parameter", "Ветви вдоль параметра"),
        };
        let mut results = Results { kind: KIND.name, heading, rows: Rows::Hidden, ..Results::default() };
        results.data = machine::no_numbers(machine);
        let found = match study.of {
            Followed::Free { mode, range } => free(machine, (&mut study, mode, range), &mut results, watch),
            _ => diagram(machine, &study, watch),
        };
        match found {
            Ok(diagram) => {
                let wanted = study.backbone.as_ref();
                let spine = wanted.map(|wanted| beside::spine(machine, (&study, wanted), &diagram, watch)).transpose();
                let (spine, trouble) = spine.map_or_else(|trouble| (None, Some(trouble)), |spine| (spine, None));
                tell::tell(machine, &study, (&diagram, spine), &mut results);
                trouble.into_iter().for_each(|trouble| results.fail(trouble));
            }
            Err(trouble) => results.fail(trouble),
        }
        results.data.partial |= watch.is_interrupted();
        watch.lap(Lap::Run);
        Some(checked(results))
    }
    fn merge(&self, _: &Machine, given: Given) -> Result<Asked, Failure> {
        let mut asked = given.written.clone().or(given.of_file.clone()).unwrap_or_else(|| Asked::new(KIND.name));
        // a period that the command line writes is one more key of the study of the file
        if let Some(file) = given.of_file.as_ref().filter(|_| given.written.is_some()) {
            for (key, value) in file.values() {
                let begins = ["period", "section", "turns"].contains(key);
                if !begins && !asked.has(key) {
                    asked.set(key, value.clone());
                }
            }
        }
        let asked = overlaid(&KIND, asked, given.line);
        if given.line.has("turns") && asked.coordinate("section").is_none() {
            let (en, ru) =
                ("only a section that is an angle has turns: --section phi", "обороты есть только у сечения-угла: --section phi");
            return Err(idle("--turns", &Text::new(en, ru)));
        }
        agreed(&KIND, asked)
    }
    fn interrupts(&self) -> Interrupts {
        Interrupts::Kept
    }
    fn repeats(&self) -> Repeats {
        Repeats::Never
    }
    fn explanations(&self) -> &'static [Explanation] {
        explained::EXPLANATIONS
    }
}

/// The second parameter, which the branches have between its ends.
///
/// # Errors
/// C031 where it is no parameter, S157 where its value lies outside.
fn beside(machine: &Machine, second: &Beside) -> Result<Second, Notice> {
    let ([from, to], here) = (second.range, second.here);
    if here.is_nan() {
        return Err(machine.no_number(&second.name));
    }
    if !(from..=to).contains(&here) {
        let name = &second.name;
        let fault = Notice::new(
            "S157",
            format!("the value of `{name}` in the file lies outside of the range of `second`"),
            format!("значение `{name}` в файле лежит вне промежутка `second`"),
        );
        return Err(fault
            .why(
                "curves begin at special points of the branches, which have the value of the file",
                "кривые начинаются в особых точках ветвей, а ветви построены при значении из файла",
            )
            .help(
                format!("take a range with that value, or another value: --set {name}=..."),
                format!("возьмите промежуток с этим значением или другое значение: --set {name}=..."),
            ));
    }
    Ok(Second { from, to, here })
}

/// The free oscillations of a mode; the study learns their range.
fn free(
    machine: &mut Machine,
    (study, mode, range): (&mut Branched, usize, Option<[f64; 2]>),
    results: &mut Results,
    watch: &mut Watch,
) -> Result<Diagram, Notice> {
    let options = Options {
        from: study.from,
        to: study.to,
        start: study.from,
        points: study.points,
        branches: study.branches,
        second: None,
        interrupt: watch.interrupt,
    };
    let found = machine.system.start().and_then(|start| backbone(&mut machine.system, &start, (mode, range), &options));
    let found = found.map_err(|fault| in_symbols(fault, &machine.equations))?;
    [study.from, study.to] = found.range;
    results.own.insert("small".into(), serde_json::json!(found.small));
    let label = Text::new(format!("mode {mode}: frequency of small oscillations"), format!("форма {mode}: частота малых колебаний"));
    results.facts.push(Fact::new("small", "ω₀", "rad/s", found.small, label));
    Ok(found.diagram)
}

/// Follows what is asked for.
fn diagram(machine: &Machine, study: &Branched, watch: &mut Watch) -> Result<Diagram, Notice> {
    let here = machine.number(&study.name)?;
    let start = if (study.from..=study.to).contains(&here) { here } else { study.from };
    let second = study.second.as_ref().map(|second| beside(machine, second)).transpose()?;
    let mut family = Bound::new(machine, study);
    let options = Options {
        from: study.from,
        to: study.to,
        start,
        points: study.points,
        branches: study.branches,
        second,
        interrupt: watch.interrupt,
    };
    match &study.of {
        Followed::Orbits(regime) => {
            let asked = family.regime(regime, start)?;
            let outcome = periodic::regime(&mut family.machine, &asked, watch);
            if let Some(fault) = outcome.fault {
                return Err(in_symbols(fault, &machine.equations));
            }
            // from here on with the numbers alone
            let mut family = Bound::new(machine, study);
            let (by, returns) = periodic::returns(&asked, &machine.equations);
            let tolerance = asked.tolerance.min(1e-13); // turns are differentiated: they are followed more closely than they are shown
            let listener = Listener { interrupt: watch.interrupt, told: None };
            let options_of = Periodic { by, returns, tolerance, listener, ..Periodic::default() };
            regimes(&mut family, &outcome.regime.start, &options_of, &options)
        }
        Followed::Rest | Followed::Free { .. } => {
            let place = family.at(start).and_then(|(system, _)| system.start()).map_err(|fault| in_symbols(fault, &machine.equations))?;
            rests(&mut family, &place, &options)
        }
    }
    .map_err(|fault| in_symbols(fault, &machine.equations))
}
