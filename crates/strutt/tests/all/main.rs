//! Tests of the command line and of whole machines in one program, which is linked once. Beside it: `book`, a test a heading; `house`, the rules of the sources.

#[path = "../common/mod.rs"]
mod common;

mod asked;
mod binding;
mod command_line;
mod documents;
mod ensembles;
mod explanations;
mod formats;
mod hidden_reactions;
mod interrupt;
mod inverse;
mod linear;
mod long_chains;
mod maps;
mod moving;
mod mutations;
mod pages;
mod random_models;
mod reports;
mod russian;
mod same_bits;
mod schemes;
mod stability;
mod studies;
mod sweeps;
mod tutorial;
mod variants;
mod virtual_work;
