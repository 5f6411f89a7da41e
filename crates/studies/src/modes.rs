//! The study `modes`: natural frequencies, shapes, the frequency equation, modes followed along a parameter.

use super::equilibrium::no_range;
use super::keys::GUESS;
use super::{Conclusion, Finds, Found, Results, Study};
use crate::machine::Machine;
use crate::results::finite::checked;
use crate::small::asked::Modes;
use crate::watch::{Lap, Watch};
use mechanics::asked::{Asked, Choice, Key, Kind, Objection, Takes, Words};
use words::explain::{Explanation, row};
use words::{Language, Text};

static ABOUT: Choice = Choice {
    words: &["rest", "start"],
    metavar: "WHAT",
    code: "M095",
    unknown: ("small motions about `{}` are not known", "малые движения около `{}` неизвестны"),
    help: ("rest or start", "rest (покой) или start (движение в начале)"),
};
static SCALES: Choice = Choice {
    words: &["largest", "first", "mass"],
    metavar: "SCALE",
    code: "M090",
    unknown: ("unknown scale of shapes `{}`", "неизвестная нормировка `{}`"),
    help: ("largest, first or mass", "largest, first или mass"),
};

static EXPLANATIONS: &[Explanation] = &[
    row(
        "M090",
        ("unknown scale of mode shapes", "неизвестная нормировка форм"),
        (
            "A shape is known up to a factor. `normalise` says how it is chosen: `largest` makes the largest entry 1, `first` the entry of the first \
             coordinate, `mass` makes xT M x = 1.",
            "Форма колебаний определена с точностью до множителя. Ключ `normalise` задаёт его: `largest` — наибольшая компонента равна 1, `first` — \
             компонента первой координаты равна 1, `mass` — xT M x = 1.",
        ),
        "normalise = \"max\"",
        "normalise = \"largest\"",
    ),
    row(
        "M095",
        ("about what motions are small", "около чего движения малы"),
        (
            "Modes belong to a state: a place of rest (`rest`), or the motion as it is at the start (`start`), for example a steady rotation.",
            "Собственные формы относятся к состоянию: положению покоя (`rest`) или движению в начальный момент (`start`), например равномерному вращению.",
        ),
        "about = \"middle\"",
        "about = \"start\"",
    ),
];

/// The study.
pub struct Natural;

/// Its name and its keys.
pub static KIND: Kind = Kind::new(
    crate::small::modes::NAME,
    ("Find natural frequencies and shapes of small motions", "Найти собственные частоты и формы малых колебаний"),
)
.keys(&[
    GUESS,
    Key::new(
        "about",
        Takes::Word(&ABOUT),
        (
            "modes about a place of rest, or about the motion as it is at the start",
            "формы около положения покоя (rest) или около движения в начальный момент (start)",
        ),
        "\"start\"",
    )
    .default("\"rest\"", "\"rest\"")
    .flag(
        "about_start",
        "start",
        ("About the motion at the start instead of a place of rest", "Около движения в начальный момент, а не около положения покоя"),
    ),
    Key::new("over", Takes::Varied, ("a parameter to follow them along", "параметр, вдоль которого прослеживаются формы"), "\"Omega\"")
        .option("A parameter along which the modes are followed", "Параметр, вдоль которого прослеживаются формы")
        .needs("range"),
    Key::new("range", Takes::RangeOf("over"), ("values of `over`, from and to", "границы значений `over`"), "[\"0 rad/s\", \"300 rad/s\"]")
        .option("Its values, from and to: \"0 rad/s,600 rad/s\"", "Его значения, от и до: \"0 rad/s,600 rad/s\"")
        .needs("over"),
    Key::new("points", Takes::Count("M093", 2), ("number of its values", "число его значений"), "73")
        .default("101", "101")
        .option("Number of its values", "Число его значений")
        .needs("over"),
    Key::new(
        "normalise",
        Takes::Word(&SCALES),
        (
            "scale of mode shapes: largest, first (coordinate) or mass",
            "нормировка форм: largest (наибольшая), first (первая координата) или mass",
        ),
        "\"mass\"",
    )
    .default("\"largest\"", "\"largest\"")
    .option("Scale of the shapes", "Нормировка форм: наибольшая компонента 1, первая координата 1 или по массе"),
    Key::new(
        "frequency_variable",
        Takes::FrequencyVariable,
        ("unknown of the frequency equation over the frequency k", "неизвестное частотного уравнения, выраженное через частоту k"),
        "{ z = \"m*k^2/c\" }",
    ),
])
.check(|asked| {
    let lost = asked.get("over").is_some() && !asked.has("range");
    let range = lost.then(|| no_range("[\"0 rad/s\", \"300 rad/s\"]"));
    range.into_iter().chain(of_rest_alone(asked)).collect()
});

/// Keys that the motion at the start has no use for.
fn of_rest_alone(asked: &Asked) -> Vec<Objection> {
    let idle = ["over", "range", "points", "guess", "frequency_variable"].into_iter().filter(|key| asked.has(key));
    let about_start = asked.word("about") == Some("start");
    let one = |key: &'static str| {
        let what = format!("`{key}` goes with a place of rest, not with about = \"start\"");
        let text = Text::new(what, format!("ключ `{key}` относится к положению покоя, а не к about = \"start\""));
        Objection::at(key, "M071", &text.en, &text.ru).help(
            "leave it out; for several values of a parameter run the study once for each by --set",
            "уберите его; для нескольких значений параметра повторите расчёт с --set",
        )
    };
    idle.filter(|_| about_start).map(one).collect()
}

impl Study for Natural {
    fn explanations(&self) -> &'static [Explanation] {
        EXPLANATIONS
    }
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn wanted(&self) -> Words {
        ("find the natural frequencies and mode shapes", "определить собственные частоты и формы колебаний")
    }
    fn chapter(&self) -> &'static str {
        "free"
    }
    fn finds(&self) -> Finds {
        Finds::Shapes
    }
    fn concludes(&self, _: &Machine, results: &Results, _: Language) -> Vec<Conclusion> {
        let all = results.data.column("omega").map(|c| c.values.clone());
        all.and_then(|all| Some(Conclusion::Lowest { omega: lowest(&all)?, all })).into_iter().collect()
    }
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        Some(natural(machine, &Modes::of(asked), watch))
    }
}

/// The least positive value.
fn lowest(values: &[f64]) -> Option<f64> {
    values.iter().copied().filter(|w| w.is_finite() && *w > 0.0).reduce(f64::min)
}

/// Natural frequencies and shapes.
pub fn natural(machine: &mut Machine, study: &Modes, watch: &mut Watch) -> Results {
    if let Some(finding) = crate::structure::modes(machine, study) {
        watch.lap(Lap::Run);
        return finding;
    }
    let found = crate::small::modes::find(machine, study);
    watch.lap(Lap::Run);
    checked(found)
}
