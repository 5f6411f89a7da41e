//! Codes that callers go by: who raises one and who looks for it take its name from here. All others are known to their texts alone.

/// The step fell below the resolution of time.
pub const UNDERFLOW: &str = "S003";
/// No place of rest is found.
pub const NO_REST: &str = "S007";
/// Rest that is neutral, or a motion that nothing holds.
pub const NEUTRAL: &str = "S008";
/// Connections come apart.
pub const APART: &str = "S013";
/// Conditions contradict each other.
pub const CONTRADICTION: &str = "S017";
/// A position in which the way of a linkage branches.
pub const BRANCHING: &str = "S028";
/// A mass matrix without inertia in some direction.
pub const NO_INERTIA: &str = "S031";
/// A motion that does not come back.
pub const NEVER_BACK: &str = "S041";
/// No periodic regime is found.
pub const NO_REGIME: &str = "S042";
/// A forced motion whose period is not that of its forcing.
pub const FORCED: &str = "S043";
/// A shaft that does not turn through its cycle.
pub const STANDS: &str = "S046";
/// Equations without a derivative.
pub const NO_DERIVATIVE: &str = "S054";
/// Variations that cannot be followed.
pub const NO_VARIATIONS: &str = "S055";
/// A strand that would have to push.
pub const STRAND_PUSHES: &str = "S116";
/// A driven motion whose period does not follow from the file.
pub const NO_PERIOD: &str = "S150";
/// A machine driven in time, of which places of rest were asked for.
pub const DRIVEN: &str = "S154";
