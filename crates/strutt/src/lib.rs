//! The library behind the command `strutt`: files, folders of results, findings as text, examples. What a file may ask and the street from a model to
//! a written calculation stand in [`studies`]. It knows no physics.
//!
//! Rooms, in order of reading: [`source`], [`files`], [`shelf`], [`rows`], [`columns`], [`folder`], [`pdf`], [`system`] (files and the machine that it runs on) - [`diagnostics`], [`mod@explain`],
//! [`wording`] - `letters`, [`variants`], [`class`] - [`gallery`], [`showcase`], [`film`], [`chain`]. The program: `main`, `args`, `line`, `localize`, `console`, `quantities`, `commands`.
//!
//! ```
//! use studies::{Source, Watch, pipeline};
//! let source = Source::new("top.toml", strutt::gallery::find("top").ok_or("no example")?.text);
//! let machine = pipeline::build(&source, &[], &mut Watch::default()).map_err(|_| "not a model")?;
//! assert_eq!(machine.equations.coordinates.len(), 3);
//! # Ok::<(), &str>(())
//! ```

#![cfg_attr(not(test), deny(clippy::too_many_lines, clippy::fn_params_excessive_bools))]

pub mod chain;
pub mod class;
pub mod columns;
pub mod diagnostics;
pub mod explain;
pub mod files;
pub mod film;
pub mod folder;
pub mod gallery;
mod letters;
pub mod pdf;
pub mod rows;
pub mod shelf;
pub mod showcase;
pub mod source;
pub mod system;
pub mod variants;
pub mod wording;

pub use studies::VERSION;
