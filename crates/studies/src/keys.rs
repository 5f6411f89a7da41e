//! Keys that several studies share, and what is objected to them.

use mechanics::asked::{Asked, Choice, Key, Like, Limits, Objection, Takes, Way};

/// End of a motion.
pub const UNTIL: Key = Key::new("until", Takes::End, ("end of the motion", "конец движения"), "\"30 s\"")
    .required()
    .option("End of the motion: 30, 30s, \"2 min\"", "Конец движения: 30, 30с, \"2 мин\"");

/// Step of the results.
pub const EVERY: Key = Key::new("every", Takes::Step, ("step of the results", "шаг вывода результатов"), "\"10 ms\"")
    .option("Results at equal intervals", "Результаты через равные промежутки времени");

/// Times of the results.
pub const AT: Key = Key::new(
    "at",
    Takes::Moments,
    ("times of the results, ascending, instead of `every`", "моменты вывода по возрастанию, вместо `every`"),
    "[\"1 s\", \"2 s\"]",
)
.not_with("every", "M065")
.option("Results exactly at these times: 0,0.5,10", "Результаты точно в эти моменты: 0,0.5,10 (или \"0;0,5;10\")");

/// The studies of a file whose motion the commands of both take, and the closed form beside them.
pub const MOTIONS: &[&str] = &["simulate", "inverse"];

/// Tolerance of the integrator.
pub const TOLERANCE: Key = Key::new("tolerance", Takes::Tolerance, ("relative tolerance of a step", "относительная точность шага"), "1e-9")
    .default("1e-12", "1e-12")
    .option(
        concat!("Relative tolerance of a step, ", words::finest_tolerance!(), " ... ", words::coarsest_tolerance!()),
        concat!("Допустимая относительная погрешность шага, ", words::finest_tolerance!(), " ... ", words::coarsest_tolerance!()),
    );

/// Tolerance of a motion, with its default in the help.
pub const TOLERANCE_OF_MOTION: Key = TOLERANCE.option(
    concat!("Relative tolerance of a step, ", words::finest_tolerance!(), " ... ", words::coarsest_tolerance!(), " [default: 1e-12]"),
    concat!(
        "Допустимая относительная погрешность шага, ",
        words::finest_tolerance!(),
        " ... ",
        words::coarsest_tolerance!(),
        " [по умолчанию: 1e-12]"
    ),
);

/// Methods of integration.
pub const METHODS: Choice = Choice {
    words: &["auto", "taylor", "stiff"],
    metavar: "METHOD",
    code: "M065",
    unknown: ("unknown method `{}`", "неизвестный метод `{}`"),
    help: ("auto, taylor or stiff", "auto, taylor или stiff"),
};

/// How a motion is integrated.
pub const METHOD: Key = Key::new(
    "method",
    Takes::Word(&METHODS),
    (
        "how the motion is integrated: taylor (Taylor series), stiff (implicit, for damping that is fast beside the motion), auto (whichever is worth while)",
        "как интегрируется движение: taylor (ряды Тейлора), stiff (неявный метод для затухания, быстрого по сравнению с движением), auto (что выгоднее)",
    ),
    "\"stiff\"",
)
.default("\"auto\"", "\"auto\"")
.option(
    "How the motion is integrated [default: auto]",
    "Как интегрируется движение: ряды Тейлора, неявный метод или что выгоднее [по умолчанию: auto]",
);

/// Columns.
pub const OUTPUTS: Key =
    Key::new("outputs", Takes::Results, ("results wanted; all without it", "нужные результаты; без ключа — все"), "[\"phi\", \"omega_p\"]")
        .option("Columns by name, in this order: phi,phi',omega_p", "Столбцы по именам, в этом порядке: phi,phi',omega_p");

/// Plots over time.
pub const PLOT: Key = Key::new(
    "plot",
    Takes::Plots,
    ("plots: a name, several names in one, or an x-y plot", "графики: имя, несколько имён вместе или график x-y"),
    "[\"phi'\", { x = \"x\", y = [\"y\"] }]",
);

/// A number of a study that is repeated.
pub const OBSERVED: Key = Key::new(
    "observe",
    Takes::Observed,
    (
        "the number that is followed: max(..), min(..), amplitude(..), mean(..) or last(..) of a result or of a formula of the motion, the first four also between two instants, as \
         mean(phi', 20 s, 30 s); events; or a number of the repeated study by its path in JSON",
        "число, за которым следят: max(..), min(..), amplitude(..), mean(..) или last(..) от результата или формулы движения, первые четыре и между двумя моментами, например \
         mean(phi', 20 с, 30 с); events; либо число повторяемого расчёта по его пути в JSON",
    ),
    "\"mean(phi', 20 s, 30 s)\"",
)
.option(
    "What is followed: mean(x, 20 s, 30 s), max(x), min(x), amplitude(x), last(x), events, or a number of the study's JSON: period, multipliers.1.abs",
    "За чем следить: mean(x, 20 с, 30 с), max(x), min(x), amplitude(x), last(x), events либо число из JSON расчёта: period, multipliers.1.abs",
);

/// The level that it passes.
pub const LEVEL: Key = Key::new(
    "level",
    Takes::Quantity(Like::Of("observe"), Limits::None),
    ("the level that it passes", "уровень, через который оно переходит"),
    "\"250 rad/s\"",
)
.option("The level that it passes: \"250 rad/s\"", "Уровень, через который оно переходит: \"250 рад/с\"");

/// Regimes of the file in place of a level.
pub const REGIMES: Key = Key::new(
    "regimes",
    Takes::Flag,
    (
        "the regimes of the table [regimes] change, in place of `observe` and `level`",
        "сменяются режимы из таблицы [regimes]; вместо `observe` и `level`",
    ),
    "true",
)
.default("false", "false")
.option("Regimes of the file in place of a number and its level", "Режимы файла вместо числа и его уровня");

/// Parts of a range that are looked at.
pub const PARTS: Key = Key::new(
    "parts",
    Takes::Count("M071", 1),
    (
        "into so many equal parts the range is divided first, to see whether it holds one change",
        "на столько равных частей сначала делится промежуток, чтобы увидеть, одна ли в нём смена",
    ),
    "16",
)
.default("8", "8")
.option("Parts of the range that are looked at first [default: 8]", "На сколько частей сначала делить промежуток [по умолчанию: 8]");

/// Plots over what the study goes over.
pub const OWN_PLOT: Key = Key { takes: Takes::OwnPlots, ..PLOT };

/// Where rest is looked for.
pub const GUESS: Key =
    Key::new("guess", Takes::Guess, ("where to look for the equilibrium", "откуда искать положение равновесия"), "{ phi = \"0.1 rad\" }")
        .default("start", "начальное значение")
        .option("Where to look for the equilibrium: phi=0.1", "Откуда искать положение равновесия: phi=0.1");

/// Number of positions of a turn; one a degree without it.
pub const POINTS: Key = Key::new(
    "points",
    Takes::Count("M071", 2),
    ("number of positions, both ends included", "число положений вместе с обоими концами"),
    "73",
)
.default("361", "361");

/// What begins a period.
pub const SECTION: Key = Key::new(
    "section",
    Takes::Section,
    (
        "where a period begins: a formula that passes zero from below, or the name of an angle, which makes `turns`; without it `period` decides",
        "где начинается период: формула, проходящая нуль снизу, или имя угла, который совершает `turns`; без ключа решает `period`",
    ),
    "\"x'\"",
)
.option(
    "What begins a period: an angle (one turn) or a formula that passes zero from below",
    "Начало периода: угол (один оборот) или формула, переходящая через нуль снизу вверх",
)
.way(Way::Begins);

/// Turns of the angle of the section.
pub const TURNS: Key = Key::new(
    "turns",
    Takes::Number(Limits::NotZero),
    ("turns of the angle in a period; negative when it falls", "обороты угла за период; отрицательны, если он убывает"),
    "2",
)
.default("1", "1")
.option("Turns of the angle in a period", "Число оборотов угла за период")
.way(Way::Written);

/// The period of what is forced.
pub const PERIOD: Key = Key::new(
    "period",
    Takes::Duration,
    ("the period of the loads, or a guess when there is a section", "период нагрузок, а при сечении — начальное приближение"),
    "\"0.2568 s\"",
)
.option("Period of a forced motion", "Период вынужденного движения")
.way(Way::Begins);

/// Ordinary motion before a search.
pub const SETTLE: Key = Key::new("settle", Takes::Wait, ("ordinary motion before the search", "обычное движение перед поиском"), "\"5 s\"")
    .default("0", "0")
    .option("Ordinary motion before the search", "Обычное движение перед поиском");

/// An objection to a range `from`, `to` that runs backwards.
pub fn backwards(asked: &Asked) -> Option<Objection> {
    let (from, to) = (asked.number("from")?, asked.number("to")?);
    (to <= from).then(|| {
        Objection::at("to", "M071", "`to` must be larger than `from`", "`to` должно быть больше `from`")
            .why("the range would be empty or run backwards", "промежуток был бы пуст или шёл бы назад")
            .help("write the smaller value into `from`", "меньшее значение запишите в `from`")
    })
}

/// An objection to a parameter without both of its values, or to values without their parameter.
pub fn half_a_range(asked: &Asked) -> Option<Objection> {
    let given = ["parameter", "from", "to"].iter().filter(|key| asked.has(key)).count();
    (given % 3 != 0).then(go_together)
}

/// An objection to a range that lacks its parameter or a value.
pub fn go_together() -> Objection {
    Objection::whole("M071", "`parameter`, `from` and `to` go together", "`parameter`, `from` и `to` задают вместе")
}

/// An objection to turns of a section that is no angle; a section that could not be read has its own.
pub fn turns_of_no_angle(asked: &Asked) -> Option<Objection> {
    let is_read = !asked.has("section") || asked.get("section").is_some();
    (asked.has("turns") && asked.coordinate("section").is_none() && is_read).then(|| Objection::no_angle("turns"))
}
