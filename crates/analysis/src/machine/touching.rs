//! Where contacts and frictions stand among the roots of their tape.

use program::{Evaluator, Point, Program, TouchRoots};
use symbolic::Equations;
use symbolic::connections::Law;

/// A contact or friction that has a guard.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// First of its roots.
    pub(super) root: usize,
    pub(super) guard: usize,
    pub(super) reaction: usize,
    pub(super) friction: bool,
    /// First friction with the same guard, by place.
    pub(super) leader: usize,
}

/// Where contacts and frictions are among the roots.
pub(super) fn places(equations: &Equations, program: &Program) -> Vec<Place> {
    let (mut found, mut root): (Vec<Place>, usize) = (Vec::new(), 0);
    for (reaction, r) in equations.reactions.iter().enumerate() {
        let friction = match r.law {
            Law::Contact { .. } => false,
            Law::Friction(_) => true,
            _ => continue,
        };
        if let Some(Some(guard)) = program.switches.get(reaction) {
            let leader = found.iter().position(|p| p.guard == *guard).unwrap_or(found.len());
            found.push(Place { root, guard: *guard, reaction, friction, leader });
        }
        root += TouchRoots::WIDTH;
    }
    found
}

/// Rows of a balance that is linear in its inputs: residual without the part free of them, and Σ of the terms without sign.
pub(super) fn linear(second: &mut Evaluator, point: &Point, rows: usize) -> Option<Vec<[f64; 2]>> {
    let mut residual = |inputs: &[f64]| -> Option<Vec<f64>> {
        let values = second.evaluate(&Point { accelerations: inputs, ..*point }).ok()?;
        Some(values.get(..rows)?.to_vec())
    };
    let whole = residual(point.accelerations)?;
    let mut trial = vec![0.0; point.accelerations.len()];
    let constant = residual(&trial)?;
    let mut out: Vec<[f64; 2]> = whole.iter().zip(&constant).map(|(r, c)| [r - c, 0.0]).collect();
    for (k, input) in point.accelerations.iter().enumerate().filter(|(_, input)| **input != 0.0) {
        trial[k] = *input;
        let term = residual(&trial)?;
        trial[k] = 0.0;
        out.iter_mut().zip(&term).zip(&constant).for_each(|((row, t), c)| row[1] += (t - c).abs());
    }
    Some(out)
}
