//! A place on the way of a linkage.

use super::linkage::Spot;

/// A place with what is known there.
#[derive(Clone, Debug)]
pub(super) struct Stand {
    pub(super) s: f64,
    pub(super) at: Spot,
    /// dq/ds, integrated from the second derivative.
    pub(super) integrated: Vec<f64>,
}
