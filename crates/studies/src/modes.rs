//! The study `modes`: natural frequencies, shapes, the frequency equation, modes followed along a parameter.

use super::equilibrium::no_range;
use super::keys::GUESS;
use super::{Found, Results, Study};
use crate::pipeline::Machine;
use crate::results::finite::checked;
use crate::watch::{Lap, Watch};
use mechanics::asked::{Asked, Choice, Key, Kind, Takes, Value};
use mechanics::model::FrequencyVariable;
use symbolic::SymbolId;
use words::explain::{Explanation, row};

/// Values of a followed parameter where nobody says how many.
const POINTS: usize = 101;

/// Natural frequencies and shapes about an equilibrium.
#[derive(Clone, Debug, Default)]
pub struct Modes {
    /// Where to look for the equilibrium, SI.
    pub guess: Vec<(SymbolId, f64)>,
    /// Scale of the shapes.
    pub scale: Scale,
    /// The unknown of the frequency equation; ω² without it.
    pub variable: Option<FrequencyVariable>,
    /// A parameter to follow the modes along.
    pub over: Option<ParameterRange>,
    /// Linearise about the motion at the start instead of a place of rest.
    pub about_start: bool,
}

/// How shapes are scaled.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Scale {
    /// The largest entry is 1.
    #[default]
    Largest,
    /// The first coordinate has 1.
    First,
    /// Modal mass 1.
    Mass,
}

/// A parameter that takes equidistant values, SI.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterRange {
    /// Its name.
    pub name: String,
    /// First value.
    pub from: f64,
    /// Last value.
    pub to: f64,
    /// Number of values.
    pub points: usize,
}

impl Modes {
    /// The modes that are asked for.
    pub fn of(asked: &Asked) -> Modes {
        let over = match (asked.word("over"), asked.numbers("range")) {
            (Some(name), Some(&[from, to])) => {
                Some(ParameterRange { name: name.to_owned(), from, to, points: asked.count("points").unwrap_or(POINTS) })
            }
            _ => None,
        };
        Modes {
            guess: asked.guess().to_vec(),
            scale: match asked.word("normalise") {
                Some("first") => Scale::First,
                Some("mass") => Scale::Mass,
                _ => Scale::Largest,
            },
            variable: if let Some(Value::Variable(variable)) = asked.get("frequency_variable") { Some(variable.clone()) } else { None },
            over,
            about_start: asked.word("about") == Some("start"),
        }
    }
}

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

static KIND: Kind =
    Kind::new("modes", ("Find natural frequencies and shapes of small motions", "Найти собственные частоты и формы малых колебаний"))
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
                (
                    "About the motion at the start instead of a place of rest",
                    "Около движения в начальный момент, а не около положения покоя",
                ),
            ),
            Key::new(
                "over",
                Takes::Varied,
                ("a parameter to follow them along", "параметр, вдоль которого прослеживаются формы"),
                "\"Omega\"",
            )
            .option("A parameter along which the modes are followed", "Параметр, вдоль которого прослеживаются формы")
            .needs("range"),
            Key::new(
                "range",
                Takes::RangeOf("over"),
                ("values of `over`, from and to", "границы значений `over`"),
                "[\"0 rad/s\", \"300 rad/s\"]",
            )
            .option("Its values, from and to: \"0 rad/s,600 rad/s\"", "Его значения, от и до: \"0 rad/s,600 rad/s\"")
            .needs("over"),
            Key::new("points", Takes::Count("M093"), ("number of its values", "число его значений"), "73")
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
        .check(|asked| match asked.get("over").is_some() && !asked.has("range") {
            true => vec![no_range("[\"0 rad/s\", \"300 rad/s\"]")],
            false => Vec::new(),
        });

impl Study for Natural {
    fn explanations(&self) -> &'static [Explanation] {
        EXPLANATIONS
    }
    fn kind(&self) -> &'static Kind {
        &KIND
    }
    fn run(&self, machine: &mut Machine, asked: &Asked, watch: &mut Watch) -> Found {
        Some(natural(machine, &Modes::of(asked), watch))
    }
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
