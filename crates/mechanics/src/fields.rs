//! Every key of the model file: what it is, what it defaults to, an example. The reader takes its list of known and required keys from
//! here, and the reference (`docs/model-file.md` and the chapters beside it) is generated from here.

mod chapters;
pub mod claims;
mod distributed;
pub mod events;
mod report;
mod sections;
pub mod structures;
mod tables;
pub mod variants;

pub use crate::asked::STUDY;
pub use crate::keys::{Field, TEXT, TableSpec, Type, Words};
pub use chapters::{CHAPTERS, Chapter, all};
pub use distributed::DISTRIBUTED;
pub use report::{PARTS, REPORT};
pub use sections::{PART, SECTION};
pub use tables::{BODY, COORDINATE, FRAME, OUTPUT, PARAMETER, PHASE, PLOT, POINT, REGIME, TENSOR, TOP};
