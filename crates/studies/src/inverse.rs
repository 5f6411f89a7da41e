//! The study `inverse`: forces and torques that realise prescribed motions, their powers and work.
//!
//! The work of a motor is the integral of its power over the dense output: of the polynomials that also give the extremes, on parts so short that nothing
//! hides between their points. It is confirmed by the energy: all motors together do what the change of energy and the work of everything else leave.

use super::keys::{AT, EVERY, METHOD, MOTIONS, OUTPUTS, PLOT, TOLERANCE_OF_MOTION, UNTIL};
use super::simulate::{self, Simulate, merged, with_works};
use super::{Conclusion, Extra, Fact, Finds, Found, Given, Interrupts, Repeats, Results, Study};
use crate::failure::Failure;
use crate::machine::Machine;
use crate::results::finite::checked;
use crate::watch::Watch;
use analysis::Dataset;
use mechanics::asked::{Asked, Kind, Words};
use serde_json::json;
use symbolic::equations::Role;
use words::{Language, Notice, Text};

/// A motor: the output that is its power, its name, what the output is.
struct Motor {
    power: String,
    name: String,
    label: Text,
}

/// The study.
pub struct Inverse;

/// Its name and its keys.
pub static KIND: Kind = Kind::new(
    "inverse",
    (
        "Find the forces and torques of motors that realise prescribed motions, their powers and work",
        "Найти силы и моменты двигателей для заданных движений, их мощности и работу",
    ),
)
.keys(&[UNTIL, TOLERANCE_OF_MOTION, METHOD, EVERY, AT, OUTPUTS, PLOT]);

impl Study for Inverse {
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn wanted(&self) -> Words {
        (
            "find the forces and moments of the motors for the prescribed motion",
            "решить обратную задачу динамики: найти силы и моменты двигателей по заданному движению",
        )
    }
    fn chapter(&self) -> &'static str {
        "motion"
    }
    fn finds(&self) -> Finds {
        Finds::Drives
    }
    fn concludes(&self, machine: &Machine, results: &Results, language: Language) -> Vec<Conclusion> {
        crate::results::greatest(&machine.equations, (&results.data, &results.plots), language)
    }
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        Some(forces(machine, &Simulate::of(asked), watch))
    }
    fn of_file(&self) -> &'static [&'static [&'static str]] {
        &[&["inverse"], MOTIONS]
    }
    fn merge(&self, machine: &Machine, given: Given) -> Result<Asked, Failure> {
        let (columns, drawn) = (given.line.has("outputs"), given.drawn);
        let mut asked = merged(&simulate::KIND, &machine.equations, given)?;
        asked.kind = KIND.name;
        if columns && !drawn {
            // columns of plots that nobody draws are not asked for
            asked.unset("plot");
        }
        Ok(asked)
    }
    fn extras(&self) -> &'static [Extra] {
        Extra::OF_A_MOTION
    }
    fn interrupts(&self) -> Interrupts {
        Interrupts::Kept
    }
    fn repeats(&self) -> Repeats {
        Repeats::Motion
    }
}

fn forces(machine: &mut Machine, study: &Simulate, watch: &mut Watch) -> Results {
    let study = study.with_plots(&machine.equations);
    let motors = motors(machine);
    if motors.is_empty() {
        return Results::failed(KIND.name, heading(), no_motor());
    }
    let powers: Vec<String> = motors.iter().map(|m| m.power.clone()).collect();
    let shown = study.outputs.len();
    let mut asked = study.clone();
    asked.outputs.extend(powers.iter().filter(|p| !study.outputs.contains(p)).cloned());
    let Results { mut data, trouble, .. } = with_works(machine, &asked, &powers, watch);
    let (facts, work) = if trouble.is_none() && !data.partial { works(&motors, &mut data) } else { Default::default() };
    // only the columns that were asked for; the powers stand behind them
    let mut at = 0..;
    data.keep_columns(|_| at.next().is_some_and(|i| i <= shown));
    let mut results =
        Results { kind: KIND.name, heading: heading(), facts, data, plots: study.plots.clone(), trouble, ..Results::default() };
    results.own.insert("until".into(), json!(study.until));
    results.own.insert("tolerance".into(), json!(study.tolerance));
    results.own.insert("work".into(), work);
    checked(results)
}

fn heading() -> Text {
    Text::new("Inverse dynamics", "Обратная задача динамики")
}

fn no_motor() -> Notice {
    Notice::new("S101", "the model has no motor whose force could be found", "в модели нет двигателя, усилие которого можно найти")
        .why(
            "inverse dynamics gives the forces of [motors] that realise prescribed [motions]",
            "обратная задача динамики даёт усилия двигателей [motors], осуществляющих заданные движения [motions]",
        )
        .help(
            "add a motion and its motor; `strutt simulate` gives a motion under given forces, `strutt statics` reactions at rest",
            "задайте движение и двигатель; `strutt simulate` даёт движение под заданными силами, `strutt statics` – реакции в покое",
        )
}

fn motors(machine: &Machine) -> Vec<Motor> {
    let powers = machine.equations.outputs.iter().filter(|o| o.role == Role::Power);
    let motor = |o: &symbolic::equations::Output| Motor {
        power: o.name.clone(),
        name: o.name.trim_start_matches("power(").trim_end_matches(')').to_owned(),
        label: o.label.clone(),
    };
    powers.map(motor).collect()
}

/// Work of each motor, that of its impulses included.
fn works(motors: &[Motor], data: &mut Dataset) -> (Vec<Fact>, serde_json::Value) {
    let mut own = serde_json::Map::new();
    let mut facts = Vec::new();
    for (k, Motor { power, name, label }) in motors.iter().enumerate() {
        let Some(work) = data.overall(power).map(|o| o.integral) else { continue };
        let struck = data.struck.get(k).copied().unwrap_or(0.0);
        if struck.is_nan() {
            data.notes.push(not_unique(name));
            own.insert(name.clone(), serde_json::Value::Null);
            continue;
        }
        // `power: motor B` is what its output is called
        let label = Text::new(label.en.trim_start_matches("power: "), label.ru.trim_start_matches("мощность: "));
        let meaning = match struck != 0.0 {
            true => {
                Text::new(format!("work with that of impulses: {}", label.en), format!("работа вместе с работой импульсов: {}", label.ru))
            }
            false => Text::new(format!("work: {}", label.en), format!("работа: {}", label.ru)),
        };
        facts.push(Fact::new(&format!("work({name})"), &format!("A_{name}"), "J", work + struck, meaning));
        own.insert(name.clone(), json!(work + struck));
    }
    if motors.len() > 1 && facts.len() == motors.len() {
        let sum = facts.iter().map(|fact| fact.value).sum();
        facts.push(Fact::new("work_sum", "A", "J", sum, Text::new("work of all motors", "работа всех двигателей")));
    }
    (facts, own.into())
}

fn not_unique(motor: &str) -> Text {
    Text::new(
        format!(
            "the work of {motor} is left out: it has an impulse that is not unique, since others stop the same motion at that instant, or more events than are kept"
        ),
        format!(
            "работа {motor} не приведена: её импульс определён неоднозначно, так как то же движение в то же мгновение останавливают и другие, либо событий больше, чем хранится"
        ),
    )
}
