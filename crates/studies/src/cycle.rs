//! The study `cycle`: energy balance over a turn with a uniform shaft, the drive that closes it, irregularity of running, the flywheel.

mod asked;
mod search;
mod show;
mod tried;

pub use asked::Cycle;

use super::keys::{OWN_PLOT, POINTS};
use super::{Conclusion, Fact, Found, Given, Interrupts, Repeats, Results, Rows, Study, idle, overlaid};
use crate::failure::{Failure, Misuse};
use crate::machine::{self, Machine};
use crate::provenance;
use crate::results::finite::checked;
use crate::watch::{Lap, Watch};
use mechanics::asked::{Asked, Key, Kind, Like, Limits, Objection, Takes, Way, Words};
use mechanics::units::Dimension;
use search::{driven, flywheel};
use show::{facts, running};
use tried::Tried;
use words::{Language, Notice, Text};

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
    .way(Way::Written),
    Key::new(
        "speed",
        Takes::Quantity(Like::Is(Dimension::ANGULAR_RATE, "rad/s"), Limits::NotZero),
        ("uniform rate of that angle", "равномерная скорость этого угла"),
        "\"1450 rpm\"",
    )
    .default("starting rate", "начальная скорость")
    .option("Uniform rate [default: the starting rate]", "Равномерная угловая скорость [по умолчанию: начальная скорость]")
    .way(Way::Written),
    Key::new("period", Takes::Duration, ("time of a cycle instead of `speed`", "время цикла вместо `speed`"), "\"0.2568 s\"")
        .not_with("speed", "M071")
        .option("Duration of a cycle, instead of the rate", "Длительность цикла вместо скорости")
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

/// Change of the moment from the start of a cycle to its end, as a share of the largest, beyond which it is more than the tolerance of the motion that leads through it.
const REPEATED: f64 = 1e-6;

/// What is to be said where the reduced moment at the end of the cycle is not the one at its start: the next turn is another one, and what balances this one does not
/// balance that.
fn unrepeated(data: &analysis::dataset::Dataset) -> Option<Text> {
    let moments = &data.column("M")?.values;
    let [first, last] = [*moments.first()?, *moments.last()?];
    let largest = moments.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    ((last - first).abs() > REPEATED * largest).then(|| {
        let [a, b] = [first, last].map(words::digits::rounded);
        Text::new(
            format!("the reduced moment is {} N m at the start of the cycle and {} N m at its end: the next turn is another one, and drive, excess work and flywheel are those of this turn alone; give `turns` after which the loads repeat", a.en, b.en),
            format!("приведённый момент в начале цикла {} Н·м, а в конце {} Н·м: следующий оборот не такой же, и движущий момент, избыточная работа и маховик относятся только к этому; задайте `turns` — число оборотов, через которое нагрузки повторяются", a.ru, b.ru),
        )
    })
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
        results.own.insert("balance".into(), found.json());
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
    results.data.notes.extend(unrepeated(&balance.dataset));
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
