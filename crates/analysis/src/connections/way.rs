//! Integrals along a straight way, s = 0 ... 1, with the size of their terms.

use crate::Fault;
use crate::waveform::{NODES, RULE};
use words::Text;

/// Change of an integral by halving its panels, relative to its terms and for each panel, that ends the halving.
const SETTLED: f64 = 1e-14;
/// Panels at most: a way of thousands of turns has no integral that anybody waits for.
const PANELS: usize = 1024;

/// A value, and the sum of the sizes of its terms.
pub(crate) type Sum = [f64; 2];

/// ∫ f(s) ds of several functions by Gauss's rule on equal panels, halved until they settle.
///
/// *Errors*: those of the functions, and a way that no panel resolves, at time t.
pub(crate) fn integrals(t: f64, mut at: impl FnMut(f64) -> Result<Vec<Sum>, Fault>) -> Result<Vec<Sum>, Fault> {
    let mut before = on_panels(1, &mut at)?;
    let mut panels = 2;
    loop {
        let now = on_panels(panels, &mut at)?;
        if now.iter().zip(&before).all(|(now, before)| (now[0] - before[0]).abs() <= SETTLED * panels as f64 * now[1]) {
            return Ok(now);
        }
        if panels >= PANELS {
            return Err(lost(t));
        }
        (before, panels) = (now, 2 * panels);
    }
}

fn on_panels(panels: usize, at: &mut impl FnMut(f64) -> Result<Vec<Sum>, Fault>) -> Result<Vec<Sum>, Fault> {
    let mut sums: Vec<Sum> = Vec::new();
    for (panel, node) in (0..panels).flat_map(|panel| (0..NODES).map(move |node| (panel, node))) {
        let values = at((panel as f64 + 0.5 * (1.0 + RULE.x[node])) / panels as f64)?;
        sums.resize(values.len(), [0.0; 2]);
        let weight = 0.5 * RULE.w[node] / panels as f64;
        for (sum, value) in sums.iter_mut().zip(&values) {
            *sum = [sum[0] + weight * value[0], sum[1] + weight * value[1]];
        }
    }
    Ok(sums)
}

/// A way that does not lead to a place, at time t.
pub(crate) fn lost(t: f64) -> Fault {
    Fault::not_finite(&Text::new("way of a connection", "путь связи"), t)
}

/// Σ of products, and of their sizes.
pub(crate) fn sum(terms: impl Iterator<Item = f64>) -> Sum {
    terms.fold([0.0; 2], |[sum, size], term| [sum + term, size + term.abs()])
}
