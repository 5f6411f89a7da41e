//! The command line as types, but for studies, whose options are made of their keys (`line.rs`). Help texts here are English; `localize`
//! puts the Russian ones in.

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
    /// Write the calculation to be handed in: statement, derivation, results, checks
    Report(Report),
    /// Find all errors of a model file
    Check(Check),
    /// Derive the equations of motion
    Equations(Equations),
    /// Lay the published results of a file against the machine
    Claims(Claims),
    /// Look at all variants of a file: values, answers, what speaks against one
    Variants(Variants),
    /// Show the properties of the sections of a file
    Section(Section),
    /// Draw the scheme of the machine, as SVG on standard output
    Scheme(Scheme),
    /// List the example models, or print one
    Examples(Examples),
    /// Write a page of all example models with moving pictures
    Gallery(Gallery),
    /// Write a model file to start from
    New(New),
    /// Explain the code of a message
    Explain(Explain),
    /// Put the parts of a sweep together
    Merge(Merge),
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
    /// Number n of the group in the formulas of the variants
    #[arg(long, value_name = "NUMBER", requires = "variant")]
    pub group: Option<u32>,
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
    /// Also write moving pictures: SVG that plays by itself, and MP4 where ffmpeg is installed
    #[arg(long)]
    pub animate: bool,
}

#[derive(Args, Debug)]
pub struct Report {
    #[command(flatten)]
    pub model: Model,
    /// The file that is written [default: report.html in the folder of the results]
    #[arg(long, short, value_name = "FILE", conflicts_with = "out")]
    pub output: Option<PathBuf>,
    /// Folder for the calculation and its pictures [default: out/<name of the model>]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Also make a PDF with an installed browser (html), typst or LaTeX
    #[arg(long)]
    pub pdf: bool,
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

#[derive(Args, Debug)]
pub struct Claims {
    #[command(flatten)]
    pub model: Model,
    /// Exit with 1 when a published result does not hold
    #[arg(long)]
    pub strict: bool,
}

#[derive(Args, Debug)]
#[command(subcommand_required = true, arg_required_else_help = true)]
pub struct Variants {
    #[command(subcommand)]
    pub action: VariantsAction,
}

#[derive(Subcommand, Debug)]
pub enum VariantsAction {
    /// Compute every variant: answers, broken conditions, twins, near resonance, failures
    Check(VariantsCheck),
    /// Write task sheets, solutions and the key of a class into a folder
    Make(VariantsMake),
    /// Check what students handed in against a key
    Grade(VariantsGrade),
}

#[derive(Args, Debug)]
pub struct VariantsMake {
    /// Model file, or a folder with model.toml
    #[arg(value_name = "FILE")]
    pub file: String,
    /// Number n of the group in the formulas of the variants
    #[arg(long, value_name = "NUMBER")]
    pub group: Option<u32>,
    /// List of students, one a line, in a second column the variant; without a list a sheet for each variant
    #[arg(long, value_name = "CSV")]
    pub names: Option<String>,
    /// Folder for the sheets
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Print tasks and solutions as PDF too, by an installed Chromium
    #[arg(long)]
    pub pdf: bool,
}

#[derive(Args, Debug)]
pub struct VariantsGrade {
    /// The key that `variants make` wrote: key.json, or the folder that holds it
    #[arg(value_name = "KEY")]
    pub key: String,
    /// What students handed in, a row for each
    #[arg(value_name = "ANSWERS")]
    pub answers: String,
    /// Also write a report for each student and the table of the class into this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

#[derive(Args, Debug)]
pub struct VariantsCheck {
    /// Model file, or a folder with model.toml
    #[arg(value_name = "FILE")]
    pub file: String,
    /// Number n of the group in the formulas of the variants
    #[arg(long, value_name = "NUMBER")]
    pub group: Option<u32>,
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
pub struct Scheme {
    #[command(flatten)]
    pub model: Model,
    /// Write it into this SVG file
    #[arg(long, value_name = "PATH")]
    pub svg: Option<PathBuf>,
    /// Write it into this PNG file
    #[arg(long, value_name = "PATH")]
    pub png: Option<PathBuf>,
    /// Draw the machine at this time of its motion, or in equilibrium
    #[arg(long, value_name = "TIME|rest")]
    pub at: Option<String>,
    /// Draw this body alone, with the reactions of what holds it
    #[arg(long, value_name = "NAME")]
    pub body: Option<String>,
}

#[derive(Args, Debug)]
pub struct Examples {
    /// The example to print
    #[arg(value_name = "NAME")]
    pub name: Option<String>,
}

#[derive(Args, Debug)]
pub struct Gallery {
    /// Only these examples
    #[arg(value_name = "EXAMPLE")]
    pub names: Vec<String>,
    /// Folder for the page
    #[arg(long, value_name = "DIR", default_value = "out/gallery")]
    pub out: PathBuf,
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
pub struct Merge {
    /// Folders of the parts, each written by sweep --shard I/N --out DIR
    #[arg(value_name = "DIR", required = true)]
    pub parts: Vec<PathBuf>,
    /// Folder for the rows and the table of the whole sweep
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

#[derive(Args, Debug)]
pub struct Completions {
    /// The shell
    #[arg(value_name = "SHELL")]
    pub shell: clap_complete::Shell,
}
