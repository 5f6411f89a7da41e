//! A guess of some coordinates, with the others moved so that the connections close.
//!
//! As at the start: what is guessed stays, given values stay where they can, guesses of the file move, and of the rest as few as can be. A chain that is torn
//! open would leave it to Newton's method where it closes.

use symbolic::Equations;

use super::bench::Bench;
use super::lowered::conditions;

/// The place with these coordinates (by index) at these values; none where the connections do not admit them.
pub fn closed_guess(equations: &Equations, parameters: &[f64], guess: &[(usize, f64)]) -> Option<Vec<f64>> {
    let mut held = equations.clone();
    for (j, _) in guess {
        held.coordinates[*j].given[0] = true;
    }
    closed(&held, parameters, guess).or_else(|| {
        for (_, coordinate) in held.coordinates.iter_mut().enumerate().filter(|(j, _)| guess.iter().all(|(g, _)| g != j)) {
            (coordinate.given[0], coordinate.guessed[0]) = (false, true);
        }
        closed(&held, parameters, guess)
    })
}

fn closed(equations: &Equations, parameters: &[f64], guess: &[(usize, f64)]) -> Option<Vec<f64>> {
    let program = conditions(equations).ok()?;
    let mut bench = Bench::new(&program, equations, parameters).ok()?;
    guess.iter().for_each(|(j, value)| bench.x[*j] = *value);
    bench.close_places(&mut Vec::new()).ok()?;
    Some(bench.x[..bench.n].to_vec())
}
