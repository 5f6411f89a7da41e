//! Studies that a file asks for.

use std::ops::Range;
use symbolic::{Expr, SymbolId};
use words::Text;

/// A study.
#[derive(Clone, Debug)]
pub struct Study {
    /// What to do.
    pub kind: StudyKind,
    /// Place in the file.
    pub span: Range<usize>,
}

/// What a study does.
#[derive(Clone, Debug)]
pub enum StudyKind {
    /// Show the equations of motion.
    Equations,
    /// Find the equilibrium.
    Equilibrium {
        /// Initial guess of coordinates, SI; the start value for those not named.
        guess: Vec<(SymbolId, f64)>,
        /// Find all equilibria with a coordinate between two values.
        over: Option<Between>,
    },
    /// Compute a motion.
    Simulate(Simulate),
    /// Compute the motion of a linear system in closed form.
    Transient(Transient),
    /// Find the forces and torques of the motors that realise the prescribed motions.
    Inverse(Simulate),
    /// Find the reactions at rest.
    Statics,
    /// Follow a linkage over a range of a coordinate, without forces.
    Kinematics(Kinematics),
    /// Find a periodic motion.
    Periodic(Periodic),
    /// Energy balance of a machine over one turn.
    Cycle(Cycle),
    /// Repeat a study over values of a parameter.
    Sweep(Sweep),
    /// Natural frequencies and shapes.
    Modes(Modes),
    /// Forced oscillations over the frequency.
    Response(Response),
}

/// Positions, velocities and accelerations over a range of one coordinate; SI.
#[derive(Clone, Debug)]
pub struct Kinematics {
    /// The driven coordinate.
    pub over: SymbolId,
    /// Its name.
    pub name: String,
    /// First value; `None`: the coordinate's start.
    pub from: Option<f64>,
    /// Last value.
    pub to: KinematicsEnd,
    /// How many positions, both ends included.
    pub points: usize,
    /// Rate of the driven coordinate, constant, from which velocities and accelerations follow; `None`: its starting rate, or 1 when
    /// that is zero.
    pub rate: Option<f64>,
    /// Further driven coordinates as formulas of the driven one, for linkages of two and more degrees of freedom.
    pub with: Vec<(SymbolId, Expr)>,
    /// Outputs wanted, by name (also coordinates and rates); empty means all.
    pub outputs: Vec<String>,
    /// Plots wanted; the horizontal axis `None` is the driven coordinate.
    pub plots: Vec<Plot>,
}

/// Where a kinematic range ends.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum KinematicsEnd {
    /// At this value.
    At(f64),
    /// After so many turns of 2π from the first value.
    Turns(f64),
}

/// A periodic motion to find; SI.
#[derive(Clone, Debug)]
pub struct Periodic {
    /// What begins a period.
    pub section: Section,
    /// The period, where the section is a time; otherwise a guess.
    pub period: Option<f64>,
    /// Duration of an ordinary motion before the search begins.
    pub settle: f64,
    /// Parameter that is changed so that the period becomes the second value.
    pub tuned: Option<(String, f64)>,
    /// Relative tolerance of the integrator.
    pub tolerance: f64,
    /// Times at which results are wanted, counted from the section.
    pub times: Times,
    /// Outputs wanted, by name (also coordinates and rates); empty means all.
    pub outputs: Vec<String>,
    /// Plots wanted.
    pub plots: Vec<Plot>,
}

/// The surface at which a periodic motion begins and ends.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Section {
    /// The loads repeat in time: the period is given, the state is what returns.
    Time,
    /// The formula over coordinates, rates and time passes zero from below.
    Zero(Expr),
    /// The angle has grown by so many turns of 2π; the section passes through its start. All other coordinates return.
    Turns {
        /// The angle.
        angle: SymbolId,
        /// How many turns; negative when it falls.
        turns: f64,
    },
}

/// Energy balance of a cyclic machine; SI.
#[derive(Clone, Debug)]
pub struct Cycle {
    /// The angle that describes the cycle.
    pub angle: SymbolId,
    /// Its name.
    pub name: String,
    /// How many turns of 2π make a cycle (2 for a four-stroke engine); negative when it falls.
    pub turns: f64,
    /// Uniform rate of the angle; `None`: its starting rate.
    pub speed: Option<f64>,
    /// Parameter found from the balance: a drive force or torque. `None`: the balance is only drawn up.
    pub unknown: Option<String>,
    /// Wanted irregularity of running, (max - min)/mean of the rate.
    pub irregularity: Option<f64>,
    /// Parameter, an inertia, changed for the wanted irregularity.
    pub flywheel: Option<String>,
    /// How many positions of the tables, both ends included.
    pub points: usize,
    /// Plots wanted; the horizontal axis `None` is the angle.
    pub plots: Vec<Plot>,
}

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
}

/// Values of a parameter, or of a start or starting rate of a coordinate.
#[derive(Clone, PartialEq, Debug)]
pub struct SweepRange {
    /// Name as with `--set`: `v`, `phi`, `phi'`.
    pub name: String,
    /// Values, SI.
    pub values: Vec<f64>,
}

/// A coordinate between two values, SI.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Between {
    /// The coordinate.
    pub coordinate: SymbolId,
    /// Least value.
    pub from: f64,
    /// Largest value.
    pub to: f64,
}

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

/// name = factor·ω².
#[derive(Clone, Debug)]
pub struct FrequencyVariable {
    /// The user's letter.
    pub name: String,
    /// Over constant parameters.
    pub factor: Expr,
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

/// A motion in closed form.
#[derive(Clone, Debug)]
pub struct Transient {
    /// The motion.
    pub motion: Simulate,
    /// Small motions about the equilibrium when the system is not linear.
    pub linearise: bool,
}

/// A motion to compute; SI.
#[derive(Clone, Debug)]
pub struct Simulate {
    /// End of the motion.
    pub until: f64,
    /// Times at which results are wanted.
    pub times: Times,
    /// Relative tolerance.
    pub tolerance: f64,
    /// How the motion is integrated.
    pub method: Method,
    /// Outputs wanted, by name (also coordinates and rates); empty means all.
    pub outputs: Vec<String>,
    /// Plots wanted.
    pub plots: Vec<Plot>,
}

/// How a motion is integrated.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Method {
    /// Taylor series, or the implicit method where the motion is stiff.
    #[default]
    Auto,
    /// Taylor series.
    Taylor,
    /// The implicit method.
    Stiff,
}

impl Method {
    /// The methods with their names.
    pub const ALL: [(Method, &'static str); 3] = [(Method::Auto, "auto"), (Method::Taylor, "taylor"), (Method::Stiff, "stiff")];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        Method::ALL.iter().find(|row| row.0 == self).map_or("", |row| row.1)
    }
}

/// Times at which results are wanted.
#[derive(Clone, Debug, PartialEq)]
pub enum Times {
    /// Not said.
    Automatic,
    /// 0, step, 2 step, ... and the end.
    Every(f64),
    /// Exactly these, ascending.
    At(Vec<f64>),
}

/// A plot.
#[derive(Clone, Debug)]
pub struct Plot {
    /// Title; may be empty.
    pub title: Text,
    /// Name on the horizontal axis; `None` is time.
    pub x: Option<String>,
    /// Names on the vertical axis.
    pub y: Vec<String>,
}

/// The default tolerance of a simulation.
pub const DEFAULT_TOLERANCE: f64 = 1e-12;
