//! strutt
