//! Passes: tape to tape. The verifier runs after each in debug builds, and the tape that a pass was given stays its oracle.

mod specialise;

pub use specialise::{select, specialise};
