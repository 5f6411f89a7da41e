//! A motion in pieces, each with what it does to small changes of its start: what is asked of motions that never come back.

use super::fundamental;
use super::listener::Listener;
use super::orbit::{Jump, Orbit};
use super::trial;
use super::variation::Care;
use crate::integrate::taylor::{Flow, Options};
use crate::{Fault, Mode, System};
use words::{Message, Text};

/// Steps of a piece: many beside what a piece costs by itself, few beside what a disturbance of it can grow by.
const STEPS: usize = 64;
/// Steps after which a piece ends even where something switches in each of them.
const LONGEST: usize = 4096;

/// A piece of a motion.
pub(in crate::studies) struct Piece {
    /// Its end, s, and the state there.
    pub(in crate::studies) end: (f64, Vec<f64>),
    /// Change of each state at the end per change at the start, row by row, SI.
    pub(in crate::studies) matrix: Vec<f64>,
    /// Whether something switches in it.
    pub(in crate::studies) switches: bool,
    /// What the states vary by in it.
    pub(in crate::studies) scales: Vec<f64>,
    /// Modes at its start.
    pub(in crate::studies) modes: Vec<Mode>,
    /// By how much Liouville's formula is missed; 0 unless it was looked at.
    pub(in crate::studies) liouville: f64,
}

/// How closely a piece is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::studies) enum Look {
    /// With Liouville's formula.
    Close,
    /// The matrix to seven digits.
    Quick,
}

/// The piece that begins at (t, x), to `until` at the longest.
///
/// *Errors*: those of a motion; S054, S055 and S122 where it has no derivative by its start; S141 where a switch leaves none.
pub(in crate::studies) fn piece<S: System + ?Sized>(
    system: &mut S,
    (t, x): (f64, &[f64]),
    until: f64,
    options: &Options,
    (look, listener): (Look, Listener<'_>),
) -> Result<Piece, Fault> {
    let (orbit, end) = way(system, (t, x), until, options, STEPS)?;
    let mut scales = trial::scales(system, &orbit, None, &[]);
    // what has died out has no size of its own any more, and beside its last digits nothing can be told
    let largest = scales.iter().copied().fold(0.0, f64::max);
    scales.iter_mut().for_each(|scale| *scale = scale.max(DEAD * largest));
    let care = if look == Look::Close { Care::Multipliers } else { Care::Correction };
    let found = fundamental::of_orbit(system, &orbit, &scales, (care, listener))?;
    if let Some(why) = found.blur.told() {
        return Err(undefined(why, end));
    }
    let Orbit { last, modes: [modes, _], jumps, .. } = orbit;
    Ok(Piece { switches: !jumps.is_empty(), end: (end, last), matrix: found.matrix.values, scales, modes, liouville: found.liouville })
}

/// The motion from (t, x) to `until`, or over so many steps, and when it ends.
///
/// *Errors*: those of a motion.
pub(super) fn way<S: System + ?Sized>(
    system: &mut S,
    (t, x): (f64, &[f64]),
    until: f64,
    options: &Options,
    steps: usize,
) -> Result<(Orbit, f64), Fault> {
    let mut flow = Flow::start(system, t, x, options)?;
    let mut orbit = Orbit { first: flow.state().to_vec(), modes: [flow.modes().to_vec(), Vec::new()], ..Orbit::default() };
    while !flow.reached(until) && orbit.steps.len() < LONGEST.max(steps) {
        flow.advance(until)?;
        let step = flow.step().clone();
        let mut before = vec![0.0; x.len()];
        step.state_at(step.end().high, &mut before);
        let modes = [step.modes.clone(), flow.modes().to_vec()];
        orbit.steps.push(step);
        if flow.switches().is_empty() {
            // a piece does not end in a switch, where the next one could not tell what has happened already
            if orbit.steps.len() >= steps {
                break;
            }
            continue;
        }
        let (t, switches, then) = (flow.time(), flow.switches().to_vec(), flow.state().to_vec());
        orbit.jumps.push(Jump { after: orbit.steps.len() - 1, t, before, then, modes, switches });
    }
    (orbit.last, orbit.modes[1]) = (flow.state().to_vec(), flow.modes().to_vec());
    let end = flow.time();
    orbit.period = end - t;
    Ok((orbit, end))
}

/// Share of the largest size of a state below which a state has none: far above the numbers that lose their digits, far below all that others feel.
const DEAD: f64 = 1e-100;

/// S141: the motion has no derivative by its start.
fn undefined(why: Text, t: f64) -> Fault {
    let t = words::digits::rounded(t);
    Fault::new(Message {
        code: "S141",
        what: Text::new(
            format!("what becomes of small disturbances is not defined before t = {} s", t.en),
            format!("что станет с малыми возмущениями, не определено до t = {} с", t.ru),
        ),
        why,
        help: Text::new(
            "change a parameter or the start a little, so that the motion does not touch the switch",
            "немного измените параметр или начало, чтобы движение не касалось переключения",
        ),
    })
}
