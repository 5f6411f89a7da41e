//! Switches that a turn touches without passing them: a stop that is reached without speed, a sliding that comes to nothing and goes on, a static limit that
//! is just not exceeded. Nothing happens there, but half of the neighbours meet what the turn does not, and what it does to them grows with the root of
//! their distance, or is another slope on that side: the turn has no derivative by its start.
//!
//! Along a turn a switch keeps a sign; where that distance from its surface has a least value of nothing, it is touched. A switch whose law is continuous
//! across the surface (a kink) changes a neighbour by the power 3/2 of the distance only, and leaves the derivative as it is.

use super::fundamental::rates;
use super::orbit::Orbit;
use super::slopes::slopes;
use crate::integrate::Step;
use crate::{Fault, GuardKind, Mode, System};

/// Parts of a step at whose ends a rate is looked at for a change of its sign.
const PARTS: usize = 12;
/// Halvings of such a part: to the last bit of the time within it.
const HALVINGS: usize = 54;
/// A distance below this share of what the states change of it is none: nine digits of a regime are shown and compared.
const TOUCHED: f64 = 1e-9;
/// Share of its largest value along the turn below which the least one of a switch is looked at, and below which what the states change of it is nothing.
const NEAR: f64 = 1e-6;
/// A law that jumps by less than this share of itself is continuous: rates are known to more digits.
const JUMPS: f64 = 1e-9;
/// Share of the rates in the steps there by which a rate may differ at both ends of a turn that closes.
const CLOSED: f64 = 1e-6;

/// A least distance of a switch from its surface.
struct Low {
    /// Index of the step.
    step: usize,
    /// Time after its start.
    tau: f64,
    value: f64,
    /// Largest distance on the way to it since the switch happened last.
    from: f64,
}

/// Whether a switch is only touched along the turn.
///
/// *Errors*: those of the derivatives of guards.
pub(super) fn is_touched<S: System + ?Sized>(system: &mut S, orbit: &Orbit, scales: &[f64]) -> Result<bool, Fault> {
    for guard in 0..system.guards().len() {
        if system.guards()[guard].scheduled.is_some() {
            continue;
        }
        let (lows, largest) = lows(system, orbit, guard);
        // what has just left its surface, with a rate that is rounding, comes from nowhere
        let comes_near = |low: &Low| low.value <= NEAR * largest && low.from > NEAR * largest;
        for low in lows.into_iter().filter(comes_near) {
            if touches(system, (orbit, guard), &low, (scales, largest))? {
                return Ok(true);
            }
        }
    }
    Ok(false)
}

/// The sign that a guard keeps in these modes, where it is one that a neighbour could pass.
fn side<S: System + ?Sized>(system: &S, guard: usize, modes: &[Mode]) -> Option<f64> {
    let open = |contact: &usize| modes[*contact] == Mode::Positive;
    let signed = |mode: Mode| (mode != Mode::Zero).then(|| mode.sign());
    match &system.guards()[guard].kind {
        GuardKind::Contact { .. } => Some(1.0).filter(|_| modes[guard] == Mode::Positive),
        GuardKind::Friction { pressed, .. } if !pressed.is_empty() && pressed.iter().all(open) => None,
        GuardKind::Friction { .. } | GuardKind::Switch => signed(modes[guard]),
        GuardKind::Bound { of, .. } => {
            let sticks = modes[*of] == Mode::Zero && matches!(system.guards()[*of].kind, GuardKind::Friction { .. });
            Some(1.0).filter(|_| sticks)
        }
        _ => None,
    }
}

/// The polynomial of a guard in a step, as a distance from its surface: value and rate.
fn distance(step: &Step, guard: usize, sign: f64, tau: f64) -> [f64; 2] {
    step.guards.row(guard).iter().rev().fold([0.0; 2], |[value, rate], c| [value * tau + sign * c, rate * tau + value])
}

/// All least distances of a guard, and its largest.
fn lows<S: System + ?Sized>(system: &S, orbit: &Orbit, guard: usize) -> (Vec<Low>, f64) {
    let steps = &orbit.steps;
    let switches = |after: usize| orbit.jumps.iter().any(|jump| jump.after == after && jump.switches.iter().any(|s| s.guard == guard));
    let last = steps.len().saturating_sub(1);
    // where the turn closes its end is the time before its start
    let mut before = steps.last().filter(|_| !switches(last)).and_then(|step| {
        let sign = side(system, guard, &step.modes)?;
        let rates = |step: &Step| [0.0, step.length].map(|tau| distance(step, guard, sign, tau)[1]);
        let ([first, end], [start, second]) = (rates(step), rates(&steps[0]));
        // at a touch both rates are rounding of what they are elsewhere
        let size = [first, end, start, second].into_iter().fold(0.0, |m: f64, rate| m.max(rate.abs()));
        ((end - start).abs() <= CLOSED * size).then_some((sign, end))
    });
    let (mut list, mut largest) = (Vec::new(), 0.0_f64);
    let mut from = if before.is_some() { f64::INFINITY } else { 0.0 };
    for (k, step) in steps.iter().enumerate() {
        let Some(sign) = side(system, guard, &step.modes) else {
            before = None;
            continue;
        };
        let at = |tau: f64| distance(step, guard, sign, tau);
        let mut rate_before = before.filter(|(own, _)| *own == sign).map(|(_, rate)| rate);
        if rate_before.is_none() {
            from = 0.0;
        }
        for part in 0..=PARTS {
            let tau = step.length * part as f64 / PARTS as f64;
            let [value, rate] = at(tau);
            largest = largest.max(value.abs());
            if rate_before.is_some_and(|before| before < 0.0) && rate >= 0.0 {
                let tau = if part == 0 { tau } else { turned(&at, [step.length * (part - 1) as f64 / PARTS as f64, tau]) };
                list.push(Low { step: k, tau, value: at(tau)[0], from });
            }
            // only behind it: what rises from the surface is not on its way to it
            from = from.max(value);
            rate_before = Some(rate);
        }
        before = rate_before.filter(|_| !switches(k)).map(|rate| (sign, rate));
    }
    (list, largest)
}

/// Where a falling distance begins to rise.
fn turned(at: &impl Fn(f64) -> [f64; 2], [mut low, mut high]: [f64; 2]) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if at(middle)[1] < 0.0 { low = middle } else { high = middle }
    }
    high
}

/// Whether a least distance is none, and the law another one behind the surface.
fn touches<S: System + ?Sized>(
    system: &mut S,
    (orbit, guard): (&Orbit, usize),
    low: &Low,
    (scales, largest): (&[f64], f64),
) -> Result<bool, Fault> {
    let (step, n) = (&orbit.steps[low.step], scales.len());
    let (t, mut x, mut rows) = (step.instant(low.tau).high, vec![0.0; n], Vec::new());
    step.state_after(low.tau, &mut x);
    slopes(system, (t, &x), &step.modes, scales, &mut rows)?;
    let row = &rows[(n + guard) * (n + 1)..][..n];
    let size: f64 = row.iter().zip(scales).map(|(g, s)| (g * s).abs()).sum();
    // what follows the time alone, or is even in the states, no neighbour passes; what never leaves its surface is held there by others
    if size <= NEAR * largest || low.value > TOUCHED * size || largest <= TOUCHED * size {
        return Ok(false);
    }
    let mut beyond = step.modes.clone();
    match &system.guards()[guard].kind {
        GuardKind::Contact { .. } => return Ok(true),
        GuardKind::Bound { of, exit } => beyond[*of] = *exit,
        _ => beyond[guard] = if beyond[guard] == Mode::Positive { Mode::Negative } else { Mode::Positive },
    }
    let here = rates(system, t, &x, &step.modes)?;
    // where there is no law behind the surface, there is no derivative either
    let Ok(there) = rates(system, t, &x, &beyond) else { return Ok(true) };
    let own = |i: usize| JUMPS * (here[i].abs() + there[i].abs() + scales[i] / orbit.period);
    Ok((0..n).any(|i| (here[i] - there[i]).abs() > own(i)))
}
