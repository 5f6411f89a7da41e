//! Energy balance of a machine of one degree of freedom over a cycle of its main shaft, with the shaft turning uniformly.
//!
//! The places q(φ) follow from one turn of the motion itself; with q' and q'' of that motion
//!
//! ```text
//! b = dq/dφ = q'/φ',      c = d²q/dφ² = (q'' - b φ'')/φ'²
//! ```
//!
//! so that at the uniform rate ω the rates are b ω and the accelerations c ω². With dE/dt(q', q'') linear in q'':
//!
//! ```text
//! reduced inertia    J = bᵀ M b = (dE/dt(bω, b) - dE/dt(bω, 0))/ω
//! reduced moment     M = (loads - dissipated - dΠ/dt)/ω          J φ'' + ½ J' φ'² = M
//! ```
//!
//! where the dissipated power is taken at the accelerations of the uniform motion, from which the normal forces of dry frictions follow;
//! and ∮ M dφ = 0 in a steady cycle. J, J', M and the power M φ' of each step are polynomials through Chebyshev's points ([`crate::proxies::proxy`]); the
//! work A(φ) is the integral of the last, and its extremes lie where M passes zero, between steps and inside them.
//!
//! The running of the true motion from the start is that over one cycle of the angle, whatever time it takes: greatest and least rate from the dense
//! output, mean over time = cycle/duration.
//! *Source*: I. I. Artobolevskii, Theory of Mechanisms and Machines, 16-19.

mod faults;
mod reduced;
mod sum;
mod turn;

pub use turn::Cycle;
pub(super) use turn::{place, turn};

use crate::audits::worse;
use crate::dataset::{Audit, Dataset};
use crate::fault::codes;
use crate::integrate::Step;
use crate::marks::Along;
use crate::marks::extremes::Extremes;
use crate::{Fault, Guard, GuardKind, System};
use algebra::gauss::EIGHT;
use faults::{parts, pressed, uneven};
use reduced::{Pair, ROUNDING, reduced};
use sum::Sum;
use turn::Turned;
use words::Text;

/// A balance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Balance {
    /// ∮ M dφ, J.
    pub work: f64,
    /// Sum of the magnitudes, J: what the work is compared with.
    pub size: f64,
    /// Mean of the reduced inertia, kg m².
    pub inertia: f64,
    /// Largest difference of the work done up to an angle, J.
    pub excess: f64,
    /// Columns over the angle: J, dJ/dφ, M, work.
    pub dataset: Dataset,
}

/// Parts of a step for the check by Gauss's rule: a step spans about a radian of the quickest motion.
const CHECK: usize = 3;
/// Share of the work of the moments that meet, below which the work of their sum is not compared with itself.
const SHARE: f64 = 1e-3;

/// The balance over one cycle from the state `start`. `lead` is the same machine with its shaft held to the uniform rate, whose motion shows the places
/// and which contacts are closed; without it the machine's own motion does.
///
/// *Errors*: S046 when the shaft does not turn through the cycle, S047 when the system has no energies, S168 when a contact opens, closes or is struck, and every fault of a motion.
pub fn cycle<S: System>(system: &mut S, lead: Option<&mut S>, start: &[f64], options: &Cycle) -> Result<Balance, Fault> {
    let Led { mut machine, steps } = led(system, lead, start, options)?;
    let machine = &mut machine;
    let rubs = machine.uniform.is_none() && machine.own.guards().iter().any(|g| matches!(g.kind, GuardKind::Friction { .. }));
    let mut sum = Sum::new(options, start[options.angle]);
    for (step, length) in &steps {
        sum.add(machine, step, *length, options)?;
    }
    sum.finish(machine, &steps, options)?;
    let Sum { inertia, angle, .. } = sum;
    let parts = std::mem::take(&mut sum.parts);
    // where moments cancel all the way, what is left of them is their rounding
    let passes = |size: f64, terms: f64| size.max(SHARE * terms * options.range.abs());
    let whole = [sum.work, passes(sum.size, sum.terms)];
    let driven = [sum.fed.work, passes(sum.fed.size, sum.fed.terms)];
    let [work, size] = sum.fed.with_potential(driven[1]);
    let mut dataset = sum.dataset(&*machine.own, options);
    dataset.notes.extend(rubs.then(pressed));
    let range = dataset.extreme("A").map_or([0.0; 2], |e| [e.min.min(0.0), e.max.max(0.0)]);
    dataset.audits.extend(periodic_inertia(machine, &steps, options)?);
    let again = same_work(machine, (&steps, &parts), [whole, driven], options)?;
    dataset.notes.extend(again.is_none().then(uneven));
    dataset.audits.extend(again);
    Ok(Balance { work, size, inertia: inertia / angle, excess: range[1] - range[0], dataset })
}

/// The work of [`cycle`], to the same bits, and the sum of the magnitudes that make it up: for searches, without rows and checks.
///
/// *Errors*: as [`cycle`].
pub fn work<S: System>(system: &mut S, lead: Option<&mut S>, start: &[f64], options: &Cycle) -> Result<[f64; 2], Fault> {
    let Led { mut machine, steps } = led(system, lead, start, options)?;
    let mut sum = Sum::new(options, start[options.angle]);
    // without rows
    sum.angles.clear();
    for (step, length) in &steps {
        sum.add(&mut machine, step, *length, options)?;
    }
    Ok(sum.fed.with_potential(sum.fed.size))
}

/// A machine, and the steps that lead through its cycle.
struct Led<'p, S> {
    machine: Pair<'p, S>,
    steps: Vec<(Step, f64)>,
}

fn led<'p, S: System>(system: &'p mut S, lead: Option<&'p mut S>, start: &[f64], options: &Cycle) -> Result<Led<'p, S>, Fault> {
    let alike = |lead: &S| if lead.states() == system.states() { shared(system.guards(), lead.guards()) } else { None };
    let (mut lead, shared) = lead.and_then(|lead| alike(lead).map(|shared| (lead, shared))).unzip();
    let turned = match &mut lead {
        Some(lead) => turn(&mut **lead, start, options, 1.0)?,
        // places alone matter: where the loads stop the shaft, it is made quicker
        None => match turn(system, start, options, 1.0) {
            Err(fault) if fault.code == codes::STANDS => turn(system, start, options, 30.0)?,
            other => other?,
        },
    };
    let Turned { steps, parted } = turned;
    if let Some((guard, angle)) = parted {
        let guards = lead.as_ref().map_or(system.guards(), |lead| lead.guards());
        return Err(parts(&guards[guard].name, (&system.states()[options.angle].name, angle)));
    }
    let shared = shared.unwrap_or_else(|| (0..system.guards().len()).collect());
    Ok(Led { machine: Pair { own: system, uniform: lead, shared }, steps })
}

/// Where guards stand among those of the same machine held to the uniform rate, which has some more where one more condition makes its reactions redundant; none where it is another machine.
fn shared(own: &[Guard], held: &[Guard]) -> Option<Vec<usize>> {
    let mut left = held.iter().enumerate();
    let same = |a: &Guard, b: &Guard| a.name == b.name && std::mem::discriminant(&a.kind) == std::mem::discriminant(&b.kind);
    own.iter().map(|own| left.find(|(_, held)| same(own, held)).map(|(at, _)| at)).collect()
}

/// How the shaft runs over one cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Running {
    /// Greatest rate, rad/s.
    pub greatest: f64,
    /// Least rate, rad/s.
    pub least: f64,
    /// Mean rate over time, angle/duration, rad/s.
    pub mean: f64,
    /// Duration, s.
    pub duration: f64,
    /// Rate with which it begins, rad/s, where contacts that are struck at the start make it another one than that of the start.
    pub struck: Option<f64>,
}

/// The running of the machine's own motion over one cycle of its angle from the state `start`.
///
/// *Errors*: S046 when the shaft does not turn through the cycle, and every fault of a motion.
pub fn running<S: System>(system: &mut S, start: &[f64], options: &Cycle) -> Result<Running, Fault> {
    let rate = system.n_coordinates() + options.angle;
    let name = &system.states()[rate].name;
    let output = system.outputs().iter().position(|o| o.name == *name);
    let Turned { steps, .. } = turn(system, start, options, 1.0)?;
    let mut extremes = Extremes::new(system, &output.into_iter().collect::<Vec<_>>(), options.tolerance);
    let mut duration = 0.0;
    for (step, length) in &steps {
        extremes.look(&mut Along::new(step, system, *length));
        duration += length;
    }
    let found = extremes.found();
    let (least, greatest) = found.first().map_or((f64::NAN, f64::NAN), |e| (e.min, e.max));
    let begins = steps.first().map_or(f64::NAN, |(step, _)| step.start_value(rate));
    // as the motion leads it, the start is as given but for rounding: a shaft that turns has the rate asked for, see `turn`
    let given = if start[rate] == 0.0 { 0.0 } else { options.rate };
    let struck = Some(begins).filter(|begins| (begins - given).abs() > ROUNDING * given.abs());
    Ok(Running { greatest, least, mean: options.range / duration, duration, struck })
}

/// The machine at the end of the cycle is the one at its start.
fn periodic_inertia<S: System + ?Sized>(machine: &mut Pair<'_, S>, steps: &[(Step, f64)], options: &Cycle) -> Result<Option<Audit>, Fault> {
    let name = Text::new(
        "the reduced inertia is the same after the cycle: relative difference",
        "приведённый момент инерции после цикла тот же: относительное расхождение",
    );
    let Some(((first, _), (last, length))) = steps.first().zip(steps.last()) else { return Ok(None) };
    let (a, b) = (reduced(machine, first, 0.0, options)?, reduced(machine, last, *length, options)?);
    let off = (a.inertia - b.inertia).abs() / a.inertia.abs().max(b.inertia.abs()).max(f64::MIN_POSITIVE);
    // a cycle that closes leaves rounding; one that does not is off by its play
    Ok(Some(Audit::at_most("periodic_inertia", name, off, 1e-9)))
}

/// The work once more, without reduction: powers of the motion that led through the cycle, with its own accelerations, on other places. Over a cycle
/// in which the kinetic energy returns,
///
/// ```text
/// ∮ M dφ = ∫ (loads - dissipated - dE/dt) dt + [T]         for a shaft that turns at any rate
/// ```
///
/// provided that the loads do not feel the rate; the check is made where the motion is the uniform one. What comes from no potential is compared by itself, too: beside a stiff spring
/// the work of the loads is less than the rounding of all that passes.
fn same_work<S: System + ?Sized>(
    machine: &mut Pair<'_, S>,
    (steps, parts): (&[(Step, f64)], &[Vec<f64>]),
    [whole, driven]: [[f64; 2]; 2],
    options: &Cycle,
) -> Result<Option<Audit>, Fault> {
    let (n, n_x) = (machine.own.n_coordinates(), machine.own.states().len());
    let (mut x, mut slope) = (vec![0.0; n_x], vec![0.0; n_x]);
    let (mut again, mut fed, mut uneven) = (0.0, 0.0, 0.0_f64);
    let mut kinetic: [Option<f64>; 2] = [None, None];
    for ((step, length), ends) in steps.iter().zip(parts) {
        let whole: Vec<f64> = (1..=CHECK).map(|k| length * k as f64 / CHECK as f64).collect();
        // a pulse stands in a part of its own
        let ends = if ends.len() > 1 { ends } else { &whole };
        let mut from = 0.0;
        for &to in ends {
            let part = to - from;
            for (node, weight) in EIGHT {
                let t = step.instant(from + part * 0.5 * (1.0 + node)).high;
                step.state_at(t, &mut x);
                step.rate_at(t, &mut slope);
                uneven = uneven.max((x[n + options.angle] / options.rate - 1.0).abs());
                let p = machine.power(t, &x, &slope[n..2 * n], &step.modes)?;
                again += 0.5 * part * weight * (p.loads - p.dissipated - p.rate);
                fed += 0.5 * part * weight * (p.loads - p.dissipated);
            }
            from = to;
        }
        for (end, t) in [(0, step.start.high), (1, step.instant(*length).high)] {
            step.state_at(t, &mut x);
            let energy = machine.energies(t, &x, &step.modes).map(|[kinetic, _]| kinetic);
            if end == 1 || kinetic[0].is_none() {
                kinetic[end] = energy;
            }
        }
    }
    let gained = kinetic[1].unwrap_or(0.0) - kinetic[0].unwrap_or(0.0);
    let name = Text::new(
        "work of the cycle by the powers of the uniform motion: relative difference",
        "работа за цикл по мощностям равномерного движения: относительное расхождение",
    );
    let apart = |found: f64, [work, size]: [f64; 2]| (found - work).abs() / size.max(f64::MIN_POSITIVE);
    // a shaft that could not be held to the uniform rate has another motion
    if uneven > 1e-9 {
        return Ok(None);
    }
    let off = worse(apart(again + gained, whole), apart(fed, driven));
    // a cycle that closes leaves rounding; one that does not is off by its play
    Ok(Some(Audit::at_most("work_of_uniform_motion", name, off, 1e-9)))
}
