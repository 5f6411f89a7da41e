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

use words::digits::rounded;
use words::{Message, Text};

use crate::audits::worse;
use crate::dataset::{Audit, Column, Dataset, Extreme};
use crate::integrate::Step;
use crate::integrate::taylor::{Flow, Options};
use crate::marks::bridge::Bridge;
use crate::marks::crossings::{self, Bracket};
use crate::marks::extremes::Extremes;
use crate::marks::{Along, bracketed};
use crate::proxies::proxy::{Piece, Proxies, Values};
use crate::{Fault, Guard, GuardKind, Mode, Quantity, System};
use algebra::gauss::EIGHT;

/// Options of the study.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// Index of the coordinate that is the angle of the shaft.
    pub angle: usize,
    /// Angle of a cycle, rad; negative when it falls.
    pub range: f64,
    /// Uniform rate, rad/s.
    pub rate: f64,
    /// Rows of the result.
    pub points: usize,
    /// Relative tolerance of a step.
    pub tolerance: f64,
}

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
/// Rounding of a sum of moments, relative to its terms.
const ROUNDING: f64 = 32.0 * f64::EPSILON;
/// Change of the inertia with the angle, as a share of it, that is rounding of accelerations: beside a change point they have some eleven digits.
const FLAT: f64 = 1e-11;
/// Most steps of a cycle.
const STEPS: usize = 100_000;

/// What the machine is at an angle.
struct Reduced {
    inertia: f64,
    slope: f64,
    moment: f64,
    /// Sum of the moments that meet in it, without signs.
    terms: f64,
    /// The part of the moment that comes from no potential, and the same sum of it.
    driven: f64,
    fed: f64,
    /// dφ/dt of the motion that led here.
    rate: f64,
}

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
    let mut sum = Sum { angles: Vec::new(), ..Sum::new(options, start[options.angle]) };
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
            Err(fault) if fault.code == "S046" => turn(system, start, options, 30.0)?,
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

/// The machine, and the same with its shaft held to the uniform rate. What dry friction takes hangs on normal forces, and these on accelerations: those of
/// the uniform motion, not those that the loads would give a free shaft.
struct Pair<'p, S: ?Sized> {
    own: &'p mut S,
    uniform: Option<&'p mut S>,
    /// Where the guards of the machine stand among those of the motion that leads.
    shared: Vec<usize>,
}

impl<S: System + ?Sized> Pair<'_, S> {
    /// Modes of the machine where those of the motion that leads are these.
    fn own_modes(&self, modes: &[Mode]) -> Vec<Mode> {
        self.shared.iter().map(|&at| modes[at]).collect()
    }

    /// Power of the loads less the dissipated one, that at the accelerations of the uniform motion; and dE/dt.
    fn power(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Result<Power, Fault> {
        let own_modes = self.own_modes(modes);
        let own = self.own.supply(t, x, accelerations, &own_modes).ok_or_else(no_energies)?;
        let dissipated = match &mut self.uniform {
            Some(uniform) => uniform.supply(t, x, accelerations, modes).ok_or_else(no_energies)?.dissipated,
            None => own.dissipated,
        };
        Ok(Power { loads: own.loads, dissipated, rate: self.rate(t, x, accelerations, modes)? })
    }

    /// Potential energy at tau in a step.
    fn potential(&mut self, step: &Step, tau: f64, options: &Cycle) -> Result<Potential, Fault> {
        let t = step.instant(tau).high;
        let mut x = vec![0.0; self.own.states().len()];
        step.state_at(t, &mut x);
        let [_, energy] = self.energies(t, &x, &step.modes).ok_or_else(no_energies)?;
        let Reduced { moment, driven, .. } = reduced(self, step, tau, options)?;
        // the angle of the end is known to the rounding of the way there
        Ok(Potential { energy, known: ROUNDING * (energy.abs() + ((moment - driven) * options.range).abs()) })
    }

    /// Kinetic and potential energy.
    fn energies(&mut self, t: f64, x: &[f64], modes: &[Mode]) -> Option<[f64; 2]> {
        let modes = self.own_modes(modes);
        self.own.energies(t, x, &modes)
    }

    /// dE/dt.
    fn rate(&mut self, t: f64, x: &[f64], accelerations: &[f64], modes: &[Mode]) -> Result<f64, Fault> {
        let modes = self.own_modes(modes);
        self.own.energy_rate(t, x, accelerations, &modes).ok_or_else(no_energies)
    }
}

/// Powers, W.
struct Power {
    loads: f64,
    dissipated: f64,
    rate: f64,
}

fn uneven() -> Text {
    Text::new(
        "the shaft does not turn uniformly in the motion that led through the cycle: the work is not checked by its powers",
        "в движении, которое провело машину через цикл, вал вращается неравномерно: работа по его мощностям не проверена",
    )
}

fn pressed() -> Text {
    Text::new(
        "the shaft cannot be held to the uniform rate: normal forces of dry frictions are those of the machine's own motion",
        "вал нельзя удержать на постоянной скорости: нормальные силы сухого трения взяты из собственного движения машины",
    )
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

/// A motion through the cycle.
pub(super) struct Turned {
    /// Its steps, each with the part of it that counts.
    pub(super) steps: Vec<(Step, f64)>,
    /// The contact that opens, closes or is struck first, with the angle.
    parted: Option<(usize, f64)>,
}

/// The motion through the cycle.
pub(super) fn turn<S: System + ?Sized>(system: &mut S, start: &[f64], options: &Cycle, quicker: f64) -> Result<Turned, Fault> {
    let j = options.angle;
    let n = system.n_coordinates();
    let mut x = start.to_vec();
    let faster = if x[n + j] == 0.0 { 1.0 } else { quicker * options.rate / x[n + j] };
    x[n..2 * n].iter_mut().for_each(|v| *v *= faster);
    let end = start[j] + options.range;
    let sign = options.range.signum();
    let rate = if x[n + j] == 0.0 { options.rate } else { x[n + j] };
    // a nanosecond: the length of a run is not nothing
    let most = 10.0 * (options.range / rate).abs().max(1e-9);
    let contacts: Vec<bool> = system.guards().iter().map(|g| matches!(g.kind, GuardKind::Contact { .. })).collect();
    let mut flow = Flow::start(system, 0.0, &x, &Options { tolerance: options.tolerance, span: most, ..Options::default() })?;
    let (mut steps, mut parted): (Vec<(Step, f64)>, _) = (Vec::new(), None);
    while !flow.reached(most) && steps.len() < STEPS {
        flow.advance(most)?;
        let step = flow.step().clone();
        let place = |tau: f64| place(&step, j, tau);
        if sign * (place(step.length) - end) >= 0.0 {
            let (mut a, mut b) = (0.0, step.length);
            for _ in 0..200 {
                let middle = 0.5 * (a + b);
                if sign * (place(middle) - end) < 0.0 { a = middle } else { b = middle }
            }
            steps.push((step, b));
            return Ok(Turned { steps, parted });
        }
        let length = step.length;
        parted = parted.or_else(|| flow.switches().iter().find(|s| contacts[s.guard]).map(|s| (s.guard, place(length))));
        steps.push((step, length));
    }
    Err(not_turning(&system.states()[j].name))
}

/// A coordinate at tau in a step, with its whole turns.
pub(super) fn place(step: &Step, j: usize, tau: f64) -> f64 {
    step.start_value(j) + step.coefficients(j)[1..].iter().rev().fold(0.0, |sum, c| (sum + c) * tau)
}

/// The reduced machine at tau in a step. Where a change point is passed the accelerations follow from no equation, and what is smooth there from both sides.
fn reduced<S: System + ?Sized>(machine: &mut Pair<'_, S>, step: &Step, tau: f64, options: &Cycle) -> Result<Reduced, Fault> {
    let Some(around) = step.around_change_point(tau) else { return plainly(machine, step, tau, options) };
    let row = |r: Reduced| vec![r.inertia, r.slope, r.moment, r.terms, r.driven, r.fed];
    let bridge = Bridge::new(around, |tau| plainly(machine, step, tau, options).map(row))?;
    let rate = step.value_after(machine.own.n_coordinates() + options.angle, tau);
    let value = |column: usize| bridge.value(column, tau).ok_or_else(no_energies);
    let [inertia, slope, moment, terms, driven, fed] = [value(0)?, value(1)?, value(2)?, value(3)?, value(4)?, value(5)?];
    Ok(Reduced { inertia, slope, moment, terms, driven, fed, rate })
}

fn plainly<S: System + ?Sized>(machine: &mut Pair<'_, S>, step: &Step, tau: f64, options: &Cycle) -> Result<Reduced, Fault> {
    let (n, j, w) = (machine.own.n_coordinates(), options.angle, options.rate);
    let t = step.instant(tau).high;
    let n_x = machine.own.states().len();
    let (mut x, mut slope) = (vec![0.0; n_x], vec![0.0; n_x]);
    step.state_at(t, &mut x);
    step.rate_at(t, &mut slope);
    let rate = x[n + j];
    let b: Vec<f64> = (0..n).map(|i| x[n + i] / rate).collect();
    let c: Vec<f64> = (0..n).map(|i| (slope[n + i] - b[i] * slope[n + j]) / (rate * rate)).collect();
    let at = |w: f64| {
        let mut x = x.clone();
        (0..n).for_each(|i| x[n + i] = b[i] * w);
        x
    };
    let scaled = |factor: f64| c.iter().map(|c| c * factor).collect::<Vec<f64>>();
    let (turning, quicker) = (at(w), at(2.0 * w));
    let uniform = machine.power(t, &turning, &scaled(w * w), &step.modes)?;
    let double = machine.rate(t, &quicker, &scaled(4.0 * w * w), &step.modes)?;
    let still = machine.rate(t, &turning, &vec![0.0; n], &step.modes)?;
    // dE/dt is linear in the accelerations: those of a quick shaft are as large as its centripetal ones, beside which one radian per second squared would be rounding
    let push = (w * w).max(1.0);
    let accelerations: Vec<f64> = b.iter().map(|b| b * push).collect();
    let pushed = machine.rate(t, &turning, &accelerations, &step.modes)?;
    // dE/dt = A w + B w³: the cubic part is that of the kinetic energy, B = ½ J'
    let kinetic = (double - 2.0 * uniform.rate) / 6.0;
    let potential = uniform.rate - kinetic;
    let terms = (uniform.loads.abs() + uniform.dissipated.abs() + potential.abs() + kinetic.abs()) / w.abs();
    let moment = (uniform.loads - uniform.dissipated - potential) / w;
    let fed = (uniform.loads.abs() + uniform.dissipated.abs()) / w.abs();
    let driven = (uniform.loads - uniform.dissipated) / w;
    let (inertia, slope) = ((pushed - still) / (w * push), 2.0 * kinetic / (w * w * w));
    Ok(Reduced {
        inertia,
        // of an inertia that does not change what accelerations err by is left
        slope: if slope.abs() <= FLAT * inertia.abs() { 0.0 } else { slope },
        moment: if moment.abs() <= ROUNDING * terms { 0.0 } else { moment },
        terms,
        driven: if driven.abs() <= ROUNDING * fed { 0.0 } else { driven },
        fed,
        rate,
    })
}

fn no_energies() -> Fault {
    Fault::new(Message {
        code: "S047",
        what: Text::new("the machine has no energies at this place", "в этом положении энергии машины не определены"),
        why: Text::new("a formula of a load or an energy has no value there", "формула нагрузки или энергии там не имеет значения"),
        help: Text::new("check the formulas of loads over the whole turn", "проверьте формулы нагрузок на всём обороте"),
    })
}

/// S168: what a contact holds only for a part of the turn follows from the angle only there.
fn parts(contact: &Text, (name, angle): (&str, f64)) -> Fault {
    let angle = rounded(angle);
    Fault::new(Message {
        code: "S168",
        what: Text::new(
            format!("{} does not stay as it is through the cycle: it changes at {name} = {} rad", contact.en, angle.en),
            format!("{}: состояние меняется в цикле при {name} = {} рад", contact.ru, angle.ru),
        ),
        why: Text::new(
            "while a contact is open the machine has one freedom more: its places do not follow from the angle, and what a blow takes is no moment of the shaft",
            "при открытом контакте у машины на одну степень свободы больше: положения не следуют из угла, а потери при ударе не сводятся к моменту на валу",
        ),
        help: Text::new(
            "choose a rate at which the contact stays closed; or hold the shaft with [motions] and take the work of a turn that repeats from `inverse`, divided by its angle",
            "выберите скорость, при которой контакт остаётся замкнутым; либо задайте движение вала в [motions] и разделите на угол работу повторяющегося оборота из `inverse`",
        ),
    })
}

fn not_turning(name: &str) -> Fault {
    Fault::new(Message {
        code: "S046",
        what: Text::new(format!("`{name}` does not turn through the cycle"), format!("`{name}` не проходит весь цикл")),
        why: Text::new(
            "the shaft has a dead point, turns the other way, or the machine has more degrees of freedom",
            "у вала есть мёртвое положение, он вращается в другую сторону или у машины больше степеней свободы",
        ),
        help: Text::new(
            "check the sign of `turns` and of the starting rate; the other coordinates must follow from the angle",
            "проверьте знак `turns` и начальной скорости; остальные координаты должны следовать из угла",
        ),
    })
}

/// What a piece holds: J, dJ/dφ, M, then the integrands M φ', J φ', and that of the work of what has no potential.
const COLUMNS: usize = 3;
const POWER: usize = 3;
const TURNED: usize = 4;
const DRIVEN: usize = 5;

/// Sums over the cycle, and rows of the result at equal angles.
struct Sum {
    angles: Vec<f64>,
    /// J, dJ/dφ, M, A.
    values: Vec<[f64; 4]>,
    extremes: [Extreme; 4],
    proxies: Proxies,
    /// Ends of the parts of each step over which the power is a polynomial.
    parts: Vec<Vec<f64>>,
    work: f64,
    size: f64,
    /// Largest sum of the moments that meet.
    terms: f64,
    fed: Fed,
    inertia: f64,
    angle: f64,
}

/// Work of what has no potential, and the change of the potential, which is known by its ends alone: over a cycle that closes it vanishes, however large the potential is in between.
#[derive(Default)]
struct Fed {
    work: f64,
    size: f64,
    /// Largest sum of the moments that meet.
    terms: f64,
    /// Potential at both ends of all steps so far, and its jumps between steps.
    ends: Option<[Potential; 2]>,
    jumps: f64,
}

impl Fed {
    fn add(&mut self, pieces: &[Piece]) {
        for piece in pieces.iter().filter(|p| p.of == DRIVEN) {
            let [work, size] = done(piece, |_, _| {});
            (self.work, self.size) = (self.work + work, self.size + size);
        }
    }

    /// The potential at the ends of one more step.
    fn passes(&mut self, [begin, end]: [Potential; 2]) {
        let [first, before] = self.ends.unwrap_or([begin; 2]);
        self.jumps += gained(before, begin);
        self.ends = Some([first, end]);
    }

    /// The work of all forces, and what passes.
    fn with_potential(&self, size: f64) -> [f64; 2] {
        let [first, last] = self.ends.unwrap_or_default();
        // a difference of potentials is as uncertain as they are
        [self.work - gained(first, last) + self.jumps, size + first.known.max(last.known) / ROUNDING]
    }
}

/// Work of a piece, and what passes in it; told where it turns back and at the end.
fn done(piece: &Piece, mut told: impl FnMut(f64, f64)) -> [f64; 2] {
    let work = crossings::integral(&piece.row, piece.to - piece.from);
    let (mut last, mut size) = (0.0, 0.0);
    for u in roots(&piece.row).into_iter().chain([1.0]) {
        let value = crossings::value(&work, u);
        told(u, value);
        size += f64::abs(value - last);
        last = value;
    }
    [last, size]
}

/// A potential energy, and its rounding.
#[derive(Clone, Copy, Default)]
struct Potential {
    energy: f64,
    known: f64,
}

/// What a potential gains, zero where rounding is left of it.
fn gained(from: Potential, to: Potential) -> f64 {
    let gain = to.energy - from.energy;
    if gain.abs() <= from.known.max(to.known) { 0.0 } else { gain }
}

impl Sum {
    fn new(options: &Cycle, first: f64) -> Sum {
        let last = options.points.max(2) - 1;
        let angles = (0..=last).map(|k| first + options.range * k as f64 / last as f64).collect();
        let none = |k: usize| Extreme { column: k + 1, min: f64::INFINITY, max: f64::NEG_INFINITY, t_min: first, t_max: first };
        let mut sum = Sum {
            angles,
            values: Vec::new(),
            extremes: std::array::from_fn(none),
            proxies: Proxies::default(),
            parts: Vec::new(),
            work: 0.0,
            size: 0.0,
            terms: 0.0,
            fed: Fed::default(),
            inertia: 0.0,
            angle: 0.0,
        };
        sum.offer(3, first, 0.0);
        sum
    }

    fn offer(&mut self, k: usize, place: f64, value: f64) {
        let e = &mut self.extremes[k];
        if value < e.min {
            (e.min, e.t_min) = (value, place);
        }
        if value > e.max {
            (e.max, e.t_max) = (value, place);
        }
    }

    /// Adds a step up to `length`.
    fn add<S: System + ?Sized>(&mut self, machine: &mut Pair<'_, S>, step: &Step, length: f64, options: &Cycle) -> Result<(), Fault> {
        let (mut fault, mut terms, mut fed) = (None, self.terms, self.fed.terms);
        let mut largest = |r: &Reduced| (terms, fed) = (terms.max(r.terms), fed.max(r.fed));
        let mut sample = Values(|tau: f64| match reduced(machine, step, tau, options).inspect(&mut largest) {
            Ok(r) => vec![r.inertia, r.slope, r.moment, r.moment * r.rate, r.inertia * r.rate, r.driven * r.rate],
            Err(f) => {
                fault.get_or_insert(f);
                vec![f64::NAN; 6]
            }
        });
        let pieces = self.proxies.pieces(&mut sample, &[0, 1, 2, POWER, TURNED, DRIVEN], length);
        if let Some(fault) = fault {
            return Err(fault);
        }
        (self.terms, self.fed.terms) = (terms, fed);
        self.fed.add(&pieces);
        self.fed.passes([machine.potential(step, 0.0, options)?, machine.potential(step, length, options)?]);
        let place = |tau: f64| place(step, options.angle, tau);
        for piece in pieces.iter().filter(|p| p.of < COLUMNS) {
            self.column(piece, &place);
        }
        self.parts.push(pieces.iter().filter(|p| p.of == POWER).map(|p| p.to).collect());
        let (mut now, before) = (0.0, self.work);
        for piece in pieces.iter().filter(|p| p.of == POWER) {
            self.rows((machine, step), (piece, before + now), &place, options)?;
            now += self.working(piece, before + now, &place);
        }
        self.work = before + now;
        let turned = pieces.iter().filter(|p| p.of == TURNED);
        self.inertia += turned.map(|p| (p.to - p.from) * p.row.iter().sum::<f64>() / p.row.len() as f64).sum::<f64>();
        self.angle += place(length) - place(0.0);
        Ok(())
    }

    /// Extremes of a column in a piece.
    fn column(&mut self, piece: &Piece, place: &dyn Fn(f64) -> f64) {
        let at = |u: f64| place(piece.from + (piece.to - piece.from) * u);
        let ends = [(0.0, piece.row[0]), (1.0, piece.row[piece.row.len() - 1])];
        let inside = roots(&crossings::derivative(&piece.row)).into_iter().map(|u| (u, crossings::value(&piece.row, u)));
        for (u, value) in ends.into_iter().chain(inside) {
            self.offer(piece.of, at(u), value);
        }
    }

    /// Work of a piece, with the extremes of the work inside it.
    fn working(&mut self, piece: &Piece, before: f64, place: &dyn Fn(f64) -> f64) -> f64 {
        let [work, size] = done(piece, |u, value| self.offer(3, place(piece.from + (piece.to - piece.from) * u), before + value));
        self.size += size;
        work
    }

    /// Rows whose angle lies in a piece of the power, before which the work is `before`.
    fn rows<S: System + ?Sized>(
        &mut self,
        (machine, step): (&mut Pair<'_, S>, &Step),
        (piece, before): (&Piece, f64),
        place: &dyn Fn(f64) -> f64,
        options: &Cycle,
    ) -> Result<(), Fault> {
        let sign = options.range.signum();
        let done = crossings::integral(&piece.row, piece.to - piece.from);
        while let Some(&angle) = self.angles.get(self.values.len()) {
            if sign * (place(piece.to) - angle) <= 0.0 {
                break;
            }
            let (mut low, mut high) = (piece.from, piece.to);
            for _ in 0..100 {
                let middle = 0.5 * (low + high);
                if sign * (place(middle) - angle) < 0.0 { low = middle } else { high = middle }
            }
            let here = reduced(machine, step, high, options)?;
            let work = before + crossings::value(&done, (high - piece.from) / (piece.to - piece.from));
            self.values.push([here.inertia, here.slope, here.moment, work]);
        }
        Ok(())
    }

    /// The last row, at the end of the cycle.
    fn finish<S: System + ?Sized>(&mut self, machine: &mut Pair<'_, S>, steps: &[(Step, f64)], options: &Cycle) -> Result<(), Fault> {
        if let Some((step, length)) = steps.last() {
            while self.values.len() < self.angles.len() {
                let here = reduced(machine, step, *length, options)?;
                self.values.push([here.inertia, here.slope, here.moment, self.work]);
            }
        }
        Ok(())
    }

    fn dataset<S: System + ?Sized>(self, system: &S, options: &Cycle) -> Dataset {
        let angle = system.states()[options.angle].clone();
        let column = |name: &str, symbol: &str, unit: &str, en: &str, ru: &str, k: usize| Column {
            quantity: Quantity { symbol: symbol.into(), label: Text::new(en, ru), ..Quantity::new(name, unit) },
            values: self.values.iter().map(|row| row[k]).collect(),
        };
        let columns = vec![
            column("J", "J", "kg m^2", "reduced moment of inertia", "приведённый момент инерции", 0),
            column("dJ", "J_φ", "kg m^2", "its derivative by the angle", "его производная по углу", 1),
            column("M", "M", "N m", "reduced moment of the forces", "приведённый момент сил", 2),
            column("A", "A", "J", "work of the reduced moment since the start", "работа приведённого момента от начала", 3),
        ];
        let axis = Column { quantity: angle, values: self.angles.clone() };
        let notes = if self.proxies.lost().is_empty() { Vec::new() } else { vec![rough()] };
        let extremes = self.extremes.into_iter().filter(|e| e.min <= e.max).collect();
        Dataset { axis: Some(0), columns: std::iter::once(axis).chain(columns).collect(), extremes, notes, ..Dataset::default() }
    }
}

fn rough() -> Text {
    Text::new(
        "the reduced moment is too rough to be followed everywhere: the work is that of a polynomial through samples",
        "приведённый момент изменяется слишком нерегулярно: работа найдена по отдельным значениям",
    )
}

/// Places in [0, 1] where a polynomial passes zero.
fn roots(row: &[f64]) -> Vec<f64> {
    let mut value = |u: f64| crossings::value(row, u);
    let mut sign = 0.0;
    let found = crossings::crossings(row, 0.0, &mut sign);
    let place = |Bracket { from, to, .. }: Bracket| {
        let ends = [value(from), value(to)];
        if from < to { bracketed(&mut value, (from, ends[0]), (to, ends[1])) } else { from }
    };
    found.into_iter().map(place).collect()
}
