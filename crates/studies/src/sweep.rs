//! The study `sweep`: another study repeated over values of parameters, starts or starting rates.

mod rests;

use super::keys::OWN_PLOT;
use super::{Extra, Finds, Found, Given, Interrupts, Repeats, Results, Rows, Studies, Study, overlaid};
use crate::failure::{Failure, Misuse};
use crate::machine::{self, Machine};
use crate::repeat::abreast::{self, Pace};
use crate::repeat::course::Course;
use crate::repeat::gathered::{Gathered, Row, missing, partly_absent};
use crate::repeat::journal::{self, Head};
use crate::repeat::many::{self, Shared};
use crate::repeat::stated::{of_ranges, stated};
use crate::repeat::{Asks, At, Repeated, regimes};
use crate::results::finite::checked;
use crate::watch::{Lap, Watch};
use crate::{provenance, repeat};
use analysis::Dataset;
use analysis::dataset::Column;
use mechanics::asked::{Asked, Key, Kind, Takes, Value as Taken, Way, Words};
use mechanics::model::{Plot, SweepRange};
use serde_json::{Value, json};
use words::explain::{Explanation, plain};
use words::{Notice, Text};

/// What stands for the regime of the file.
const REGIME: &str = "regime";

/// A study repeated over values of parameters; SI.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// What is changed, the first slowest.
    pub over: Vec<SweepRange>,
    /// What is noted: outputs, or results of the study (`period`).
    pub observe: Vec<String>,
    /// Kind of the study of the file that is repeated; `None`: the first that has the results.
    pub of: Option<String>,
    /// Plots wanted, of what is noted over the values.
    pub plots: Vec<Plot>,
    /// Values of the repeated study in place of those of the file.
    pub inner: Asked,
}

impl Sweep {
    /// The repetition that is asked for.
    pub fn of(asked: &Asked) -> Sweep {
        Sweep {
            over: if let Some(Taken::Ranges(over)) = asked.get("over") { over.clone() } else { Vec::new() },
            observe: asked.words("observe").to_vec(),
            of: asked.word("of").map(str::to_owned),
            plots: asked.plots().to_vec(),
            inner: repeat::inner(asked, &KIND),
        }
    }
}

/// The study.
pub struct Sweeping;

/// Its name and its keys.
pub static KIND: Kind = Kind::new("sweep", ("Repeat a study over values of parameters", "Повторить расчёт для ряда значений параметров"))
    .keys(&[
        Key::new(
            "over",
            Takes::Ranges,
            (
                "name=linspace(first, last, number), logspace, uniform(from, to, number, seed), normal(mean, deviation, number, seed) or a list of values, or an array of such strings",
                "имя=linspace(первое, последнее, число), logspace, uniform(от, до, число, начальное), normal(среднее, отклонение, число, начальное) или список значений, или массив таких строк",
            ),
            "\"v=linspace(1 m/s, 3 m/s, 21)\"",
        )
        .required()
        .option(
            "Values of a parameter or start: v=linspace(1 m/s, 3 m/s, 21), c=logspace(1 N/m, 1 kN/m, 4), m=1 kg, 2 kg, m=column(\"masses.csv\",\"m\"); may be repeated",
            "Значения параметра или начального условия: v=linspace(1 м/с, 3 м/с, 21), c=logspace(1 Н/м, 1 кН/м, 4), \"m=1 кг; 2 кг\", m=column(\"masses.csv\",\"m\"); ключ можно повторять",
        )
        .way(Way::Begins),
        Key::new(
            "observe",
            Takes::Observed,
            (
                "results noted for each value, or one: an output by its name (its greatest and least value); max(..), min(..), mean(..), amplitude(..), last(..) of an output, a coordinate, a rate or a formula of the motion, all but the last also between two instants, as mean(phi', 20 s, 30 s); events (their number), events(NAME) (those of a named event, a contact, a rope or a friction); regime (that of the table [regimes], with the numbers of its conditions); or a number of the repeated study by its path in JSON, as period or multipliers.0.abs",
                "результаты, записываемые для каждого значения, или один: величина из [outputs] по имени (её наибольшее и наименьшее значения); max(..), min(..), mean(..), amplitude(..), last(..) от выходной величины, координаты, скорости или формулы движения, все, кроме последнего, и между двумя моментами, например mean(phi', 20 с, 30 с); events (число событий), events(ИМЯ) (именованного события, контакта, нити или трения); regime (режим из таблицы [regimes] и числа, входящие в его условия) или число повторяемого расчёта по его пути в JSON: period, multipliers.0.abs",
            ),
            "[\"period\"]",
        )
        .option(
            "What is noted: mean(x, 20 s, 30 s), max(x), min(x), amplitude(x), last(x), events, events(NAME), regime, or a number of the study's JSON, whose lists count from 0: period, multipliers.1.abs",
            "Что записывать: mean(x, 20 с, 30 с), max(x), min(x), amplitude(x), last(x), events, events(ИМЯ), regime либо число из JSON расчёта, где списки нумеруются с 0: period, multipliers.1.abs",
        )
        .way(Way::Written),
        repeat::OF,
        OWN_PLOT,
    ]);

impl Study for Sweeping {
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn wanted(&self) -> Words {
        ("investigate the influence of parameters", "исследовать влияние параметров")
    }
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        Some(repeated(machine, &Sweep::of(asked), watch))
    }
    /// The command line replaces what it names; the rest is that of the file's study.
    fn merge(&self, _: &Machine, given: Given) -> Result<Asked, Failure> {
        let fresh = given.written.is_some();
        let mut asked = given.written.or(given.of_file.clone()).ok_or_else(nothing_to_sweep)?;
        for key in ["observe", "of"] {
            if let Some(value) = given.of_file.as_ref().and_then(|file| file.get(key)).filter(|_| fresh && !asked.has(key)) {
                asked.set(key, value.clone());
            }
        }
        Ok(overlaid(&KIND, asked, given.line))
    }
    /// Options of every study that it repeats, the first of each name.
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
        &[Extra::Threads, Extra::Resume, Extra::Shard]
    }
    fn explanations(&self) -> &'static [Explanation] {
        EXPLANATIONS
    }
}

const EXPLANATIONS: &[Explanation] = &[
    plain(
        "S148",
        ("rows of another sweep", "строки другой серии"),
        (
            "A sweep with --out keeps its rows in the file sweep.rows of that folder until it is finished (a map those in map.rows), and --resume goes on with them. They are those of the same model with the same \
             values, the same request and the same version of strutt; here something of that differs. Nothing was changed: repeat the command as it was, or choose another folder.",
            "Серия с ключом --out до своего окончания хранит строки в файле sweep.rows этой папки (карта — в map.rows), а --resume продолжает с них. Они относятся к той же модели с теми же значениями, тому же \
             заданию и той же версии strutt; здесь что-то из этого отличается. Ничего не изменено: повторите прежнюю команду или выберите другую папку.",
        ),
    ),
    plain(
        "S149",
        ("damaged rows", "повреждённые строки"),
        (
            "Each line of sweep.rows and map.rows begins with a checksum. The last one may be torn where a run was killed, and is then computed again; any other that does not fit is damage of the file. \
             Cut the file before the line that is named and resume, or begin in another folder.",
            "Каждая строка файлов sweep.rows и map.rows начинается с контрольной суммы. Последняя может быть оборвана при снятии программы и вычисляется заново; любая другая, не сходящаяся с \
             суммой, означает повреждение файла. Обрежьте файл перед названной строкой и продолжите или начните в другой папке.",
        ),
    ),
    plain(
        "S160",
        ("a part of a sweep is missing", "нет части серии"),
        (
            "`strutt merge` needs every part of a sweep, finished: --shard 1/n to --shard n/n, each with a folder of its own. The message names the first that is missing or not finished; \
             --resume finishes it.",
            "Команде `strutt merge` нужны все части серии, законченные: от --shard 1/n до --shard n/n, каждая в своей папке. В сообщении названа первая из отсутствующих или \
             незаконченных; закончить её можно ключом --resume.",
        ),
    ),
    plain(
        "S143",
        ("no instants", "нет моментов времени"),
        (
            "mean(x, 20 s, 30 s) is taken of a motion between two instants. A place of rest, a regime over its period or a position of a linkage has no instants counted from a start.              Repeat a study `simulate` (of = \"simulate\", or --until on the command line), or leave the instants out.",
            "mean(x, 20 с, 30 с) берётся по движению между двумя моментами. У положения равновесия, режима за период или положения механизма нет моментов, отсчитываемых от \
             начала. Повторяйте расчёт `simulate` (of = \"simulate\" или --until в командной строке) либо уберите моменты.",
        ),
    ),
    plain(
        "S144",
        ("no such number of a motion", "у движения нет такого числа"),
        (
            "A motion has no greatest, least or mean value of a quantity that has no value along it, and none between two instants when an event ends it before the second one. Look at the \
             formula of the quantity, or choose the window inside of the motion.",
            "У движения нет наибольшего, наименьшего или среднего значения величины, которая на нём не определена, и нет числа между двумя моментами, если событие заканчивает его раньше \
             второго. Проверьте формулу величины или выберите окно внутри движения.",
        ),
    ),
];

fn nothing_to_sweep() -> Failure {
    Notice::new("C033", "over which values?", "по каким значениям?")
        .why("the file has no study `sweep`, and no --over was given", "в файле нет расчёта `sweep`, а ключ --over не задан")
        .help(
            "add --over \"v=linspace(1 m/s, 3 m/s, 21)\" --observe period",
            "добавьте --over \"v=linspace(1 м/с, 3 м/с, 21)\" --observe period",
        )
        .misuse()
}

/// The study for every combination of the values.
pub fn repeated(machine: &mut Machine, study: &Sweep, watch: &mut Watch) -> Results {
    let mut results = Results {
        kind: KIND.name,
        heading: Text::new("Sweep", "Серия расчётов"),
        rows: Rows::All,
        plots: study.plots.clone(),
        ..Results::default()
    };
    match given_once(study).and_then(|()| repeat(machine, study, watch, &mut results)) {
        Ok(data) => results.data = provenance::stamp(data, &machine.equations, &machine.model_hash),
        Err(trouble) => {
            results.data = machine::no_numbers(machine);
            results.trouble = Some(trouble);
        }
    }
    watch.lap(Lap::Run);
    checked(results)
}

/// M070 where values of one name are given twice.
fn given_once(study: &Sweep) -> Result<(), Notice> {
    let twice = study.over.iter().enumerate().find(|(i, range)| study.over[..*i].iter().any(|other| other.name == range.name));
    if let Some((_, range)) = twice {
        return Err(Notice::new("M070", format!("`{}` is given twice", range.name), format!("`{}` задан дважды", range.name))
            .help("give all its values in one range: m=1 kg; 2 kg", "задайте все значения в одном наборе: m=1 кг; 2 кг"));
    }
    Ok(())
}

/// Runs row by row, then what is said of all of them, in the order of the page.
fn repeat(machine: &Machine, study: &Sweep, watch: &mut Watch, results: &mut Results) -> Result<Dataset, Notice> {
    let (observe, regimes) = observed(machine, &study.observe)?;
    let asks = Asks { observe: &observe, of: study.of.as_deref(), inner: &study.inner };
    let repeated = Repeated::new(machine, asks)?;
    let (wanted, base) = (&repeated.noted, &repeated.base);
    let count: usize = study.over.iter().map(|range| range.values.len()).product();
    let mut data = Dataset { axis: (study.over.len() == 1).then_some(0), ..Dataset::default() };
    let mut rows = Gathered::new(machine, &study.over, wanted).with_regimes(&regimes);
    let start = At::given(machine, &place(&study.over, 0));
    let values = |row: usize| place(&study.over, row);
    let pace = abreast::pace(&start, &repeated);
    let block = if pace == Pace::InLanes { many::block_in_lanes(count) } else { many::block(count) };
    let shared = Shared { threads: watch.threads.max(1), block, interrupt: watch.interrupt, spread: watch.spread };
    let run = |at: &mut At, rows: std::ops::Range<usize>| match pace {
        Pace::InLanes => abreast::rows(at, &repeated, (&values, rows), shared.interrupt),
        _ => many::one_by_one(at, rows, shared.interrupt, &|at, row| Row::of(at, &repeated, values(row), shared.interrupt)),
    };
    let shard = watch.shard.unwrap_or(journal::WHOLE);
    let head = Head::new(same(machine, study, &repeated), [count, shared.block], shard, (rows.own, &rows.columns)).with_regimes(regimes);
    let range = head.rows();
    let mut course = Course::begin(watch, &head)?;
    let mut done = range.start;
    while done < range.end {
        // what an earlier run has done is taken at once
        let batch = done..(done + course.left().max(shared.batch())).min(range.end);
        let asked = batch.len();
        let found = course.rows(watch, batch, &|places| many::rows(&start, places, shared, &run))?;
        done += found.len();
        let short = found.len() < asked;
        found.into_iter().for_each(|row| rows.take(wanted, &row));
        if machine.origin.studies.finds(base.kind) != Finds::Rest {
            // nobody reads them
            rows.stands.clear();
        }
        if short {
            let (made, all) = (done - range.start, range.len());
            data.partial = true;
            data.notes.push(Text::new(format!("interrupted after {made} of {all} values"), format!("прервано: сделано {made} из {all}")));
            break;
        }
        if let Some(progress) = &mut watch.progress {
            progress((done - range.start) as f64 / range.len() as f64);
        }
    }
    data.notes.extend(part_of(shard, &range, count));
    data.notes.extend(pace.note(range.len()));
    let mut without = rows.tell(&mut data, results, range.len());
    if machine.origin.studies.finds(base.kind) == Finds::Rest && study.over.len() == 1 {
        let changes = rests::remarks(&mut start.clone(), &repeated, &rows.columns[0].quantity, &rows.stands);
        let list: Vec<Value> = changes.iter().map(|(value, what)| json!({"value": value, "what": what.en})).collect();
        results.own.insert("changes".into(), json!(list));
        data.notes.extend(changes.into_iter().map(|c| c.1));
    }
    results.own.insert("read_anew".into(), json!(start.anew + rows.anew));
    data.notes.extend(named(machine, study, base, results));
    data.notes.extend(repeat::without_impulses(machine, wanted));
    if results.plots.is_empty() && study.over.len() == 1 {
        results.plots = rows.columns[rows.own..].iter().map(drawn).collect();
    }
    without.extend(partly_absent(&rows.columns[rows.own..], &without));
    data.columns = rows.columns;
    missing(&mut data, without);
    Ok(data)
}

/// The numbers that are noted; `regime` stands for those that the conditions of the regimes ask for, and for their names.
fn observed(machine: &Machine, observe: &[String]) -> Result<(Vec<String>, Vec<String>), Notice> {
    let is_output = machine.equations.outputs.iter().any(|output| output.name == REGIME);
    if is_output || !observe.iter().any(|text| text == REGIME) {
        return Ok((observe.to_vec(), Vec::new()));
    }
    let mut list: Vec<String> = observe.iter().filter(|text| *text != REGIME).cloned().collect();
    let needed = regimes::numbers(machine)?;
    list.extend(needed.into_iter().filter(|text| !observe.contains(text)));
    Ok((list, machine.model.regimes.iter().map(|regime| regime.name.clone()).collect()))
}

/// A column by itself.
fn drawn(column: &Column) -> Plot {
    Plot { title: Text::default(), x: None, y: vec![column.quantity.name.clone()] }
}

/// Which part of the values this is, where it is not all of them.
fn part_of(shard: [usize; 2], range: &std::ops::Range<usize>, count: usize) -> Option<Text> {
    let (rows, from) = (range.len(), range.start + 1);
    (shard != journal::WHOLE).then(|| {
        Text::new(
            format!("part {} of {}: {rows} of {count} values, from value {from} on", shard[0], shard[1]),
            format!("часть {} из {}: значений {rows} из {count}, начиная с {from}-го", shard[0], shard[1]),
        )
    })
}

/// The study that was repeated, in words where the file has several.
fn named(machine: &Machine, study: &Sweep, base: &Asked, results: &mut Results) -> Option<Text> {
    let name = base.kind;
    results.own.insert("of".into(), json!(name));
    let several = machine.model.studies.iter().filter(|s| repeat::moves(machine, s) || repeat::rests(machine, s)).count() > 1;
    (study.of.is_none() && several).then(|| Text::new(format!("repeated: the study `{name}`"), format!("повторялся расчёт `{name}`")))
}

/// What makes the same rows: version, model with its values, what is asked.
fn same(machine: &Machine, study: &Sweep, repeated: &Repeated) -> String {
    let own = json!([of_ranges(&study.over), study.observe, study.of, stated(&study.inner), stated(&repeated.base)]);
    let asked = journal::checksum(&own.to_string());
    format!("strutt {} model {} sweep {asked:016x}", provenance::VERSION, machine.model_hash)
}

/// The table of the rows of all parts of a sweep, and its rows as one part.
///
/// # Errors
/// A part is missing (S160), of another sweep (S148) or damaged (S149).
pub fn merged(parts: &[Vec<String>]) -> Result<(Dataset, Vec<String>), Notice> {
    let (head, lines) = journal::merged(parts)?;
    let (own, columns, noted) = journal::columns(&head);
    let mut rows = Gathered::with(columns, own).with_regimes(&head.regimes);
    let (found, _) = journal::earlier(&lines, &head)?;
    let count = found.len();
    found.iter().for_each(|row| rows.take(&noted, row));
    let mut data = Dataset { axis: (own == 1).then_some(0), ..Dataset::default() };
    rows.tell(&mut data, &mut Results::default(), count);
    data.columns = rows.columns;
    missing(&mut data, Vec::new());
    Ok((data, lines))
}

/// Values of all ranges in a row; the last range changes fastest.
fn place(over: &[SweepRange], row: usize) -> Vec<(String, f64)> {
    let mut rest = row;
    let mut values: Vec<(String, f64)> = over
        .iter()
        .rev()
        .map(|range| {
            let k = rest % range.values.len();
            rest /= range.values.len();
            (range.name.clone(), range.values[k])
        })
        .collect();
    values.reverse();
    values
}
