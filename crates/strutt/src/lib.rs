//! The library behind the command `strutt`: the street from a model file to a written calculation ([`pipeline`]), and what a command
//! line needs around it. Tests, benches and bindings call this.
//!
//! ```
//! use strutt::{Source, Watch, pipeline};
//! let source = Source::new("top.toml", strutt::gallery::find("top").ok_or("no example")?.text);
//! let machine = pipeline::build(&source, &[], &mut Watch::default()).map_err(|_| "not a model")?;
//! assert_eq!(machine.equations.coordinates.len(), 3);
//! # Ok::<(), &str>(())
//! ```

pub mod chain;
pub mod claims;
pub mod contacts;
pub mod diagnostics;
pub mod document;
pub mod explain;
pub mod failure;
pub mod files;
pub mod finite;
pub mod folder;
pub mod frictions;
pub mod gallery;
pub mod guards;
mod letters;
pub mod phases;
pub mod pipeline;
pub mod plan;
mod provenance;
pub mod sections;
mod shelf;
pub mod small;
pub mod source;
mod strands;
pub mod structure;
pub mod studies;
pub mod system;
pub mod variants;
pub mod watch;
pub mod wording;

pub use failure::Failure;
pub use source::Source;
pub use watch::Watch;

/// Version of strutt.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
