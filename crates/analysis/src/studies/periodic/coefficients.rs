//! The coefficients of the variational equations at equally spaced instants of a period.

use super::found::Found;
use super::slopes::slopes;
use crate::{Fault, System};

/// ∂f/∂x at `count` instants k T/count, row by row, SI; none where connections tie the states, or the motion switches.
pub(super) fn along<S: System + ?Sized>(system: &mut S, found: &Found<'_>, count: usize) -> Result<Vec<Vec<f64>>, Fault> {
    let (orbit, n) = (&found.orbit, found.orbit.first.len());
    let switches = !orbit.jumps.is_empty() || orbit.steps.windows(2).any(|pair| pair[0].modes != pair[1].modes);
    // what connections or symmetries tie has fewer free states
    if switches || orbit.steps.is_empty() || found.free.len() < n {
        return Ok(Vec::new());
    }
    let mut rows = Vec::new();
    let mut list = Vec::with_capacity(count);
    for k in 0..count {
        let t = orbit.period * k as f64 / count as f64;
        let x = orbit.state_at(t);
        slopes(system, (t, &x), &orbit.modes[0], &found.scales, &mut rows)?;
        let matrix: Vec<f64> = (0..n * n).map(|e| rows[e / n * (n + 1) + e % n]).collect();
        if matrix.iter().any(|v| !v.is_finite()) {
            return Ok(Vec::new());
        }
        list.push(matrix);
    }
    Ok(list)
}
