//! A machine near a state, in numbers: M δq'' + B δq' + C δq = Σ c cos ν t + s sin ν t.
//!
//! [`symbolic::linear`] makes the expressions; here they become a tape over q (and q', q'' about a motion) whose parameters can be changed
//! one by one, so that a study may follow a frequency, a speed or a stiffness. Derivatives are exact: nothing is differenced.

mod doubles;
mod following;
mod graded;
mod machine;
mod matrices;
mod observer;
mod reactions;
mod seen;
mod sought;

pub use graded::{By, Graded};
pub use machine::values::Values;
pub use machine::{LinearMachine, Place, driven};
pub use matrices::{Harmonic, Matrices, hidden_inertia, largest, parts};
pub use observer::Observer;
pub use reactions::LoadParts;
pub use seen::Seen;
pub use sought::Sought;
