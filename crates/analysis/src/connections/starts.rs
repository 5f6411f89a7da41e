//! Places at the start that lengths and rests are measured from.
//!
//! `rest = "start"` of a spring and the default lengths of rods and ropes mean the closed configuration. Where a coordinate is sought, its place there is a parameter of the
//! formulas, and what such a parameter makes up closes by itself. So all other conditions are closed first; their configuration gives the parameters; with these nothing moves any more.

use symbolic::Equations;

use super::bench::Bench;
use super::lowered::conditions;
use crate::Fault;

/// Difference of a start from the one that lengths were measured in, relative to its size or to one metre or radian.
const SAME: f64 = 1e-9;
/// Contacts that move a guess change the start in which lengths are measured.
const ROUNDS: usize = 3;

/// Gives the parameters that stand for places at the start their numbers.
///
/// *Errors*: those of [`super::assemble`] for the conditions that do not depend on them.
pub fn settle_starts(equations: &mut Equations) -> Result<(), Fault> {
    let sought: Vec<(usize, usize)> = equations.starts.iter().filter_map(|s| Some((s.coordinate, s.parameter?))).collect();
    if sought.is_empty() {
        return Ok(());
    }
    let own: Vec<_> = sought.iter().map(|(_, p)| equations.parameters[*p].symbol).collect();
    let hangs = |e: symbolic::Expr| equations.graph.symbols_in(&[e]).iter().any(|s| own.contains(s));
    let apart: Vec<bool> = equations.conditions.iter().map(|c| !c.place.is_some_and(hangs)).collect();
    let program = conditions(equations)?;
    for round in 0..ROUNDS {
        let numbers: Vec<f64> = equations.parameters.iter().map(|p| p.value).collect();
        let mut bench = Bench::new(&program, equations, &numbers)?;
        let before = bench.x.clone();
        if round == 0 {
            bench.close_rows(&apart, &mut Vec::new())?;
        } else {
            bench.close_rows(&vec![true; apart.len()], &mut Vec::new())?;
            bench.keep_apart()?;
        }
        let found = if round == 0 || bench.x != before { bench.x } else { before };
        let mut same = true;
        for (j, p) in &sought {
            let parameter = &mut equations.parameters[*p];
            same &= parameter.value == found[*j];
            parameter.value = found[*j];
            parameter.written = format!("{}", found[*j]);
        }
        if same {
            break;
        }
    }
    Ok(())
}

impl Bench<'_> {
    /// Lengths that are measured at the start must have been measured at this start.
    ///
    /// *Errors*: S121.
    pub(super) fn check_starts(&self) -> Result<(), Fault> {
        let parameters = &self.equations.parameters;
        for start in &self.equations.starts {
            let j = start.coordinate;
            let measured = start.parameter.map_or(0.0, |p| parameters[p].value);
            if (self.x[j] - measured).abs() > SAME * measured.abs().max(if self.is_angle(j) { 1.0 } else { self.length() }) {
                return Err(Fault::moved_start(
                    &start.used_by,
                    self.coordinate(j),
                    [measured, self.x[j]],
                    &self.equations.coordinates[j].unit,
                ));
            }
        }
        Ok(())
    }
}
