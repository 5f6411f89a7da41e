//! What the questions of a file ask for: the grammar of their values, their names and dimensions.

pub mod meaning;
pub mod wanted;
