//! Jets: Taylor coefficients of the motion about a state.
use crate::{Bound, Fault, Mode};

/// Taylor expander of the dynamics.
#[derive(Clone, Debug)]
pub struct Jets {}

impl Jets {
    /// An expander with room for `order`.
    pub fn new(bound: &Bound, order: usize) -> Jets {
        let _ = (bound, order);
        todo!()
    }
    /// Expands the solution through (t, x) to `order` (at most that of [`Jets::new`]).
    ///
    /// *Errors*: a domain error, a singular mass matrix, a point without Taylor series, overflow.
    pub fn expand(&mut self, time: f64, states: &[f64], modes: &[Mode], order: usize) -> Result<(), Fault> {
        let _ = (time, states, modes, order);
        todo!()
    }
    /// Coefficients x_i[0..=order] of state `i`: x_i(t + h) = Σ x_i[k] h^k.
    pub fn state(&self, i: usize) -> &[f64] {
        let _ = i;
        todo!()
    }
    /// Coefficients [0..=order] of guard `i`; meaningless when the guard is not active.
    pub fn guard(&self, i: usize) -> &[f64] {
        let _ = i;
        todo!()
    }
}
