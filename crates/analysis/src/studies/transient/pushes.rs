//! Strands that only pull and tracks that only push, along the closed form.

use super::course::Closed;
use super::phase::Phase;
use super::walk::Walk;
use crate::fault::connections::Since;
use crate::marks::crossings::{self, Bracket};
use crate::marks::pushes::{Beyond, Push};
use crate::proxies::proxy::{Piece, Proxies};
use crate::{Fault, System};
use words::Text;

/// A force of the wrong sign below this share of the largest force that is watched is rounding.
const ROUNDING: f64 = 1e-9;

/// Remarks on tracks that would have to pull.
///
/// *Errors*: S116 a strand would have to push; an output is undefined.
pub(super) fn watch<S: System + ?Sized>(system: &mut S, phases: &[Phase], pushes: &[Push]) -> Result<Vec<Text>, Fault> {
    let known: Vec<&Push> = pushes.iter().filter(|push| system.refusal(push.output).is_none()).collect();
    if known.is_empty() {
        return Ok(Vec::new());
    }
    let chosen: Vec<usize> = known.iter().map(|push| push.output).collect();
    system.show(&chosen)?;
    let rows = rows(system, phases, &chosen);
    let largest = rows.iter().flat_map(|(piece, _)| &piece.row).fold(0.0_f64, |m, v| m.max(v.abs()));
    let mut first: Vec<Option<f64>> = vec![None; known.len()];
    for (piece, begin) in &rows {
        if let Some(at) = below(&piece.row, -ROUNDING * largest).and(below(&piece.row, 0.0)) {
            let t = begin + piece.from + (piece.to - piece.from) * at;
            first[piece.of] = Some(first[piece.of].map_or(t, |known| known.min(t)));
        }
    }
    let found = || known.iter().zip(&first).filter_map(|(push, t)| Some((push, Since::Time((*t)?))));
    match found().find(|(push, _)| push.beyond == Beyond::Ends) {
        Some((push, since)) => Err(Fault::strand_pushes(&push.label, since)),
        None => Ok(found().map(|(push, since)| push.pulling(since)).collect()),
    }
}

/// The outputs as polynomials, each with the start of its phase.
fn rows<S: System + ?Sized>(system: &mut S, phases: &[Phase], chosen: &[usize]) -> Vec<(Piece, f64)> {
    let mut proxies = Proxies::default();
    let columns: Vec<usize> = (0..chosen.len()).collect();
    let mut rows = Vec::new();
    for phase in phases {
        let length = phase.end - phase.start;
        let mut closed = Closed { system, phase, chosen, walk: Walk::new(&phase.motion, length) };
        let pieces = proxies.pieces(&mut closed, &columns, length);
        rows.extend(pieces.into_iter().map(|piece| (piece, phase.start)));
    }
    rows
}

/// Where in [0, 1] a polynomial is below a bound first.
fn below(row: &[f64], bound: f64) -> Option<f64> {
    let shifted: Vec<f64> = row.iter().map(|b| b - bound).collect();
    if shifted[0] < 0.0 {
        return Some(0.0);
    }
    let mut value = |u: f64| crossings::value(&shifted, u);
    let mut sign = 1.0;
    let falling = crossings::crossings(&shifted, 0.0, &mut sign).into_iter().find(|b| b.sign < 0.0);
    falling.map(|Bracket { from, to, .. }| {
        let ends = [value(from), value(to)];
        if from < to { crate::marks::bracketed(&mut value, (from, ends[0]), (to, ends[1])) } else { from }
    })
}
