//! The command line as types. Help texts here are English; `localize` puts the Russian ones in.

use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Dynamics and oscillations of machines: one text file becomes equations, motions and a written calculation.
#[derive(Parser, Debug)]
#[command(name = "strutt", version, max_term_width = 110, arg_required_else_help = true)]
pub struct Cli {
    #[command(flatten)]
    pub global: Global,
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Args, Debug, Clone)]
pub struct Global {
    /// Language of all output; otherwise from LC_ALL, LC_MESSAGES, LANG
    #[arg(long, global = true, value_enum, value_name = "LANG")]
    pub lang: Option<Lang>,
    /// Print data and errors only
    #[arg(long, short, global = true)]
    pub quiet: bool,
    /// Data as JSON on standard output
    #[arg(long, global = true, conflicts_with = "csv")]
    pub json: bool,
    /// Data as CSV on standard output
    #[arg(long, global = true)]
    pub csv: bool,
    /// Show how long each phase took, on standard error
    #[arg(long, global = true)]
    pub timings: bool,
}

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lang {
    En,
    Ru,
}

#[derive(Subcommand, Debug)]
pub enum Command {
    /// Make every study of a model file; tables, plots and a page go to out/<name>/
    Run(Run),
    /// Find all errors of a model file
    Check(Check),
    /// Derive the equations of motion
    Equations(Equations),
    /// Lay the published results of a file against the machine
    Claims(Claims),
    /// Compute a motion
    Simulate(Simulate),
    /// Find the forces and torques of motors that realise prescribed motions, their powers and work
    Inverse(Simulate),
    /// Compute the motion of a linear system in closed form, phase by phase
    Transient(Transient),
    /// Find positions of equilibrium
    Equilibrium(Equilibrium),
    /// Show the properties of the sections of a file
    Section(Section),
    /// Find the exact periodic regime: period, multipliers, motion over one period
    Periodic(Periodic),
    /// Follow a linkage over a range of its driven coordinate
    Kinematics(Kinematics),
    /// Energy balance over a turn: the drive, reduced inertia and moment, irregularity
    Cycle(Cycle),
    /// Repeat a study over values of parameters
    Sweep(Sweep),
    /// Find natural frequencies and shapes of small motions
    Modes(Modes),
    /// Find reactions and internal forces at rest
    Statics(Statics),
    /// Find forced oscillations over the frequency of a load
    Response(Response),
    /// List the example models, or print one
    Examples(Examples),
    /// Write a model file to start from
    New(New),
    /// Explain the code of a message
    Explain(Explain),
    /// Print the completion script of a shell
    Completions(Completions),
}

#[derive(Args, Debug)]
pub struct Model {
    /// Model file, a folder with model.toml, or - for standard input
    #[arg(value_name = "FILE")]
    pub file: String,
    /// Replace a parameter (m="10 g"), a start (phi=0.1) or a starting rate ("phi'=30")
    #[arg(long = "set", value_name = "NAME=QUANTITY")]
    pub overrides: Vec<String>,
    /// Take the values of this row of the table of variants; --set counts more
    #[arg(long, value_name = "NAME")]
    pub variant: Option<String>,
}

#[derive(Args, Debug)]
pub struct Run {
    #[command(flatten)]
    pub model: Model,
    /// Folder for the results [default: out/<name of the model>]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Compute each motion once more with half the tolerance and show the difference
    #[arg(long)]
    pub halve_tolerance: bool,
}

#[derive(Args, Debug)]
pub struct Check {
    #[command(flatten)]
    pub model: Model,
    /// How findings are shown: with the line of the file, or one line each for editors
    #[arg(long, value_enum, value_name = "FORMAT", default_value_t = Format::Full)]
    pub format: Format,
}

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    Full,
    Short,
}

#[derive(Args, Debug)]
pub struct Equations {
    #[command(flatten)]
    pub model: Model,
    /// How formulas are written
    #[arg(long, value_enum, value_name = "FORM", default_value_t = Form::Text)]
    pub form: Form,
    /// Show the derivation step by step
    #[arg(long)]
    pub steps: bool,
}

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    Text,
    Latex,
    Mathml,
}

/// Methods of integration.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    Auto,
    Taylor,
    Stiff,
}

impl Method {
    /// As the model file has it.
    pub fn of_model(self) -> mechanics::model::Method {
        match self {
            Method::Auto => mechanics::model::Method::Auto,
            Method::Taylor => mechanics::model::Method::Taylor,
            Method::Stiff => mechanics::model::Method::Stiff,
        }
    }
}

#[derive(Args, Debug)]
pub struct Simulate {
    #[command(flatten)]
    pub model: Model,
    /// End of the motion: 30, 30s, "2 min"
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub until: Option<String>,
    /// Relative tolerance of a step, 1e-15 ... 1e-3 [default: 1e-12]
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    pub tolerance: Option<String>,
    /// How the motion is integrated [default: auto]
    #[arg(long, value_name = "METHOD")]
    pub method: Option<Method>,
    /// Results exactly at these times: 0,0.5,10
    #[arg(long, value_name = "T1,T2,...", conflicts_with = "every", allow_hyphen_values = true)]
    pub at: Option<String>,
    /// Results at equal intervals
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub every: Option<String>,
    /// Columns by name, in this order: phi,phi',omega_p
    #[arg(long, value_name = "A,B,...", value_delimiter = ',')]
    pub outputs: Option<Vec<String>>,
    /// Also write tables, plots and a page into this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Compute each motion once more with half the tolerance and show the difference
    #[arg(long)]
    pub halve_tolerance: bool,
    /// Compute the motion once more with other steps and show which digits hold
    #[arg(long)]
    pub check: bool,
    /// Rows at the named events and switches instead of the times
    #[arg(long, conflicts_with = "switches")]
    pub events: bool,
    /// Also rows at every switch, just before and just after it
    #[arg(long)]
    pub switches: bool,
}

#[derive(Args, Debug)]
pub struct Transient {
    #[command(flatten)]
    pub motion: Simulate,
    /// Small motions about the equilibrium when the system is not linear
    #[arg(long)]
    pub linearise: bool,
}

#[derive(Args, Debug)]
pub struct Equilibrium {
    #[command(flatten)]
    pub model: Model,
    /// Where to look for the equilibrium: phi=0.1
    #[arg(long = "guess", value_name = "NAME=QUANTITY")]
    pub guess: Vec<String>,
    /// Find all equilibria with this coordinate in a range
    #[arg(long, value_name = "NAME", requires = "range")]
    pub over: Option<String>,
    /// The range: "-180 deg,180 deg"
    #[arg(long, value_name = "FROM,TO", requires = "over", allow_hyphen_values = true)]
    pub range: Option<String>,
}

#[derive(Args, Debug)]
pub struct Claims {
    #[command(flatten)]
    pub model: Model,
    /// Exit with 1 when a published result does not hold
    #[arg(long)]
    pub strict: bool,
}

#[derive(Args, Debug)]
pub struct Statics {
    #[command(flatten)]
    pub model: Model,
}

#[derive(Args, Debug)]
pub struct Modes {
    #[command(flatten)]
    pub model: Model,
    /// Where to look for the equilibrium: phi=0.1
    #[arg(long = "guess", value_name = "NAME=QUANTITY")]
    pub guess: Vec<String>,
    /// About the motion at the start instead of a place of rest
    #[arg(long)]
    pub about_start: bool,
    /// A parameter along which the modes are followed
    #[arg(long, value_name = "NAME", requires = "range")]
    pub over: Option<String>,
    /// Its values, from and to: "0 rad/s,600 rad/s"
    #[arg(long, value_name = "FROM,TO", requires = "over", allow_hyphen_values = true)]
    pub range: Option<String>,
    /// Number of its values
    #[arg(long, value_name = "N", requires = "over")]
    pub points: Option<usize>,
    /// Scale of the shapes
    #[arg(long, value_enum, value_name = "SCALE")]
    pub normalise: Option<Normalise>,
}

#[derive(Args, Debug)]
pub struct Response {
    #[command(flatten)]
    pub model: Model,
    /// Where to look for the equilibrium: phi=0.1
    #[arg(long = "guess", value_name = "NAME=QUANTITY")]
    pub guess: Vec<String>,
    /// The load: a force, a torque, or a coordinate for a unit load; otherwise the harmonic loads of the file
    #[arg(long, value_name = "NAME")]
    pub load: Option<String>,
    /// The parameter that is the frequency
    #[arg(long, value_name = "NAME")]
    pub over: Option<String>,
    /// Frequencies from and to: 1,100 (rad/s) or "1 Hz,20 Hz"
    #[arg(long, value_name = "FROM,TO", allow_hyphen_values = true)]
    pub range: Option<String>,
    /// Number of frequencies
    #[arg(long, value_name = "N")]
    pub points: Option<usize>,
    /// Logarithmic axes
    #[arg(long)]
    pub log: bool,
    /// Quantities by name, in this order: phi,phi',omega_p
    #[arg(long, value_name = "A,B,...", value_delimiter = ',')]
    pub outputs: Option<Vec<String>>,
    /// Frequencies at which the shape of the motion is shown: 10,20 (rad/s) or "3 Hz"
    #[arg(long, value_name = "W1,W2,...", allow_hyphen_values = true)]
    pub shapes: Option<String>,
}

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum Normalise {
    Largest,
    First,
    Mass,
}

#[derive(Args, Debug)]
pub struct Section {
    #[command(flatten)]
    pub model: Model,
    /// One section only
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
    /// Also write drawings and a table into this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

#[derive(Args, Debug)]
pub struct Periodic {
    #[command(flatten)]
    pub model: Model,
    /// What begins a period: an angle (one turn) or a formula that passes zero from below
    #[arg(long, value_name = "FORMULA", allow_hyphen_values = true)]
    pub section: Option<String>,
    /// Turns of the angle in a period
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    pub turns: Option<String>,
    /// Period of a forced motion
    #[arg(long, value_name = "TIME")]
    pub period: Option<String>,
    /// Ordinary motion before the search
    #[arg(long, value_name = "TIME")]
    pub settle: Option<String>,
    /// Parameter that is changed until the period is the wanted one
    #[arg(long, value_name = "NAME", requires = "wanted_period")]
    pub unknown: Option<String>,
    /// Wanted period
    #[arg(long, value_name = "TIME", requires = "unknown")]
    pub wanted_period: Option<String>,
    #[command(flatten)]
    pub table: Table,
}

#[derive(Args, Debug)]
pub struct Kinematics {
    #[command(flatten)]
    pub model: Model,
    /// The driven coordinate
    #[arg(long, value_name = "NAME")]
    pub over: Option<String>,
    /// First value [default: the start]
    #[arg(long, value_name = "QUANTITY", allow_hyphen_values = true)]
    pub from: Option<String>,
    /// Last value
    #[arg(long, value_name = "QUANTITY", conflicts_with = "turns", allow_hyphen_values = true)]
    pub to: Option<String>,
    /// Turns of an angle [default: 1]
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    pub turns: Option<String>,
    /// Uniform rate of the driven coordinate [default: its starting rate, or 1]
    #[arg(long, value_name = "QUANTITY", allow_hyphen_values = true)]
    pub rate: Option<String>,
    /// Number of positions
    #[arg(long, value_name = "N")]
    pub points: Option<usize>,
    /// Columns by name, in this order: phi,phi',omega_p
    #[arg(long, value_name = "A,B,...", value_delimiter = ',')]
    pub outputs: Option<Vec<String>>,
    /// Also write tables, plots and a page into this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

#[derive(Args, Debug)]
pub struct Cycle {
    #[command(flatten)]
    pub model: Model,
    /// The angle that describes the cycle
    #[arg(long, value_name = "NAME")]
    pub angle: Option<String>,
    /// Turns of a cycle
    #[arg(long, value_name = "NUMBER", requires = "angle", allow_hyphen_values = true)]
    pub turns: Option<String>,
    /// Uniform rate [default: the starting rate]
    #[arg(long, value_name = "QUANTITY", requires = "angle", allow_hyphen_values = true)]
    pub speed: Option<String>,
    /// Duration of a cycle, instead of the rate
    #[arg(long, value_name = "TIME", requires = "angle", conflicts_with = "speed")]
    pub period: Option<String>,
    /// Drive force or torque that is found from the balance
    #[arg(long, value_name = "NAME")]
    pub unknown: Option<String>,
    /// Wanted irregularity of running
    #[arg(long, value_name = "NUMBER", requires = "angle")]
    pub irregularity: Option<String>,
    /// Inertia that is changed for the wanted irregularity
    #[arg(long, value_name = "NAME")]
    pub flywheel: Option<String>,
    /// Also write tables, plots and a page into this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

#[derive(Args, Debug)]
pub struct Sweep {
    #[command(flatten)]
    pub model: Model,
    /// Values of a parameter or start: v=linspace(1 m/s, 3 m/s, 21), c=logspace(1 N/m, 1 kN/m, 4), m=1 kg, 2 kg; may be repeated
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true)]
    pub over: Vec<String>,
    /// What is noted: events, max(x), min(x), amplitude(x), mean(x), last(x), or a number of the study's JSON, whose lists count from 0: period, multipliers.1.abs
    #[arg(long, value_name = "A,B,...", value_delimiter = ',')]
    pub observe: Option<Vec<String>>,
    /// The study that is repeated, when the file has several
    #[arg(long, value_name = "STUDY")]
    pub of: Option<String>,
    /// Also write tables, plots and a page into this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// What a table of results shall hold.
#[derive(Args, Debug)]
pub struct Table {
    /// Results exactly at these times: 0,0.5,10
    #[arg(long, value_name = "T1,T2,...", conflicts_with = "every", allow_hyphen_values = true)]
    pub at: Option<String>,
    /// Results at equal intervals
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    pub every: Option<String>,
    /// Columns by name, in this order: phi,phi',omega_p
    #[arg(long, value_name = "A,B,...", value_delimiter = ',')]
    pub outputs: Option<Vec<String>>,
    /// Relative tolerance of a step, 1e-15 ... 1e-3
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    pub tolerance: Option<String>,
    /// Also write tables, plots and a page into this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

#[derive(Args, Debug)]
pub struct Examples {
    /// The example to print
    #[arg(value_name = "NAME")]
    pub name: Option<String>,
}

#[derive(Args, Debug)]
pub struct New {
    /// Name of the file, with or without .toml; the name of an example copies that example
    #[arg(value_name = "NAME")]
    pub name: String,
    /// The example to copy
    #[arg(long, value_name = "EXAMPLE")]
    pub from: Option<String>,
    /// Number of pendulums of an n-pendulum
    #[arg(long, value_name = "N")]
    pub count: Option<usize>,
}

#[derive(Args, Debug)]
pub struct Explain {
    /// The code, as in error[M021]; without one, all codes are listed
    #[arg(value_name = "CODE")]
    pub code: Option<String>,
}

#[derive(Args, Debug)]
pub struct Completions {
    /// The shell
    #[arg(value_name = "SHELL")]
    pub shell: clap_complete::Shell,
}
