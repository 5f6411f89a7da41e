//! What several kinds of connections share: from below, reading and keys; components and the faults of their geometry; what wheels, tracks, drums and axles do.

pub mod axes;
pub mod axles;
pub mod component;
pub mod drums;
pub mod faults;
pub mod held;
pub mod keys;
pub mod made;
pub mod pair;
pub mod reading;
pub mod strands;
pub mod tracks;
pub mod wheels;
