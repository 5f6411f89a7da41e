//! What the studies `modes` and `response` are asked for.

use mechanics::asked::{Asked, Value};
use mechanics::model::FrequencyVariable;
use symbolic::SymbolId;

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

/// Forced oscillations over the frequency of a harmonic load.
#[derive(Clone, Debug, Default)]
pub struct Response {
    /// Where to look for the equilibrium, SI.
    pub guess: Vec<(SymbolId, f64)>,
    /// The load, by name: a force, a torque, or a coordinate for a unit load on it. Otherwise the harmonic loads of the file.
    pub load: Option<String>,
    /// The parameter that is the frequency; otherwise the one that occurs as such in the loads.
    pub frequency: Option<String>,
    /// Frequencies from and to, rad/s; found from the natural frequencies when absent.
    pub range: Option<[f64; 2]>,
    /// Number of frequencies.
    pub points: Option<usize>,
    /// Logarithmic axes.
    pub log: bool,
    /// Outputs wanted, by name; the coordinates and the user's outputs when empty.
    pub outputs: Vec<String>,
    /// Frequencies at which the shape of the forced motion is shown, rad/s.
    pub shapes: Vec<f64>,
}

impl Response {
    /// The response that is asked for.
    pub fn of(asked: &Asked) -> Response {
        Response {
            guess: asked.guess().to_vec(),
            load: asked.word("load").map(str::to_owned),
            frequency: asked.word("over").map(str::to_owned),
            range: asked.numbers("range").and_then(|ends| ends.try_into().ok()),
            points: asked.count("points"),
            log: asked.flag("log"),
            outputs: asked.words("outputs").to_vec(),
            shapes: asked.numbers("shapes").unwrap_or_default().to_vec(),
        }
    }
}
