//! Forced oscillations over the frequency of periodic loads: (C - ω² M + i ω B) X = F for every harmonic.
//!
//! c cos ωt + s sin ωt is Re((c - i s) exp iωt). Where the load's frequency is a parameter of the model, this parameter follows ω, so that a
//! load whose amplitude grows with the frequency (unbalance), a base that moves and matrices that depend on the speed are right by
//! themselves. All loads whose frequencies follow the parameter act together, each at its order, the multiple of ω at which it oscillates;
//! a waveform acts at all orders of its Fourier series. Phases are relative to the load: to sin ωt or cos ωt, whichever the largest load
//! component mostly is; lag is negative.
//!
//! *Source*: C. W. de Silva, Vibration: Fundamentals and Practice, ch. 3; L. Meirovitch, Fundamentals of Vibrations, ch. 3.

mod faults;
mod loads;

pub use faults::{ROUNDED, ambiguous, bad_range, no_period, through_connections};

use faults::{no_load, written_as_number};

use algebra::elementary;
use std::f64::consts::PI;

use symbolic::Expr;
use symbolic::linear::HarmonicLoad;
use words::Text;

use crate::Fault;
use crate::fault::small::rounded_away;
use crate::linear::{LinearMachine, LoadParts, Matrices, Observer, Place, Seen, Values};
use crate::rest::search::no_equilibrium;
use crate::studies::amplitudes::{Amplitudes, CANCELLED, Gain};
use crate::studies::impedance::{is_simple, solve, solve_at};
use crate::studies::modes::{Complex, Modes, Normalisation, modes};
use crate::studies::rest::branch::{Beyond, Branch};
use crate::studies::rest::contacts::Contacts;
use crate::studies::sharp::Spot;
use crate::waveform::LISTED;
use words::digits::rounded;

/// What excites.
#[derive(Clone, Debug)]
pub enum Source {
    /// All periodic loads of the equations.
    OfEquations,
    /// Expressions of the linear graph.
    Given {
        /// Sines.
        waves: Vec<HarmonicLoad>,
        /// Waveforms by index, factors on each coordinate.
        shaped: Vec<(usize, Vec<Expr>)>,
        /// The load as the equations have it.
        parts: LoadParts,
    },
    /// A constant load that takes any frequency with its value as amplitude: by coordinate, and as the equations have it.
    Constant(Vec<Expr>, LoadParts),
    /// A unit load c = 1 on one coordinate.
    Unit(usize),
}

/// The loads at some values of the parameters.
#[derive(Clone, Debug, Default)]
pub(super) struct Excitation {
    /// Rate (none when it takes any), F = c - i s over the rate's absolute value.
    pub waves: Vec<(Option<f64>, Vec<Complex>)>,
    /// Index of the waveform, rate, factors.
    pub shaped: Vec<(usize, f64, Vec<f64>)>,
}

impl Excitation {
    /// Angular rates of all loads; none of a constant one.
    fn rates(&self) -> Vec<f64> {
        self.waves.iter().map(|w| w.0.unwrap_or(f64::NAN)).chain(self.shaped.iter().map(|s| s.1)).collect()
    }
}

/// One order: a harmonic of the whole load.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Component {
    /// Multiple of ω.
    pub order: f64,
    /// Waves of the excitation, by index.
    pub(super) waves: Vec<usize>,
    /// Waveforms of the excitation by index, and which of their harmonics.
    pub(super) harmonics: Vec<(usize, usize)>,
}

/// A forced machine.
pub struct Forced<'m> {
    pub(super) machine: &'m mut LinearMachine,
    pub(super) place: Place,
    /// The place along the frequency.
    branch: Option<Branch>,
    pub(super) observer: Observer,
    pub(super) source: Source,
    /// The outputs as functions of the whole state, where they can be lowered so.
    pub(super) formulas: Option<Values>,
    /// Outputs that leave their straight line, see [`Forced::curved`].
    pub(super) bent: Vec<usize>,
    given: Option<Values>,
    /// The loads over time, as the equations have them.
    whole: Values,
    /// Rates of the waveforms.
    rates: Values,
    /// The parameter that is the frequency, and its number for ω = 1.
    pub(super) follows: Option<(usize, f64)>,
    /// The frequency ω with the parameters as the model gives them.
    own: Option<f64>,
    /// Whether phases count from sin ωt.
    from_sine: bool,
    pub(super) components: Vec<Component>,
    pub(super) current: usize,
    /// The last static displacements.
    last: Option<(Still, Amplitudes)>,
    /// Frequencies of loads that do not follow the parameter.
    pub left_out: Vec<f64>,
}

/// What static displacements depend on.
#[derive(Clone, Debug, PartialEq)]
struct Still {
    matrices: Matrices,
    load: Vec<Complex>,
}

/// The machine at a frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Frequency of the load, its order times ω.
    pub omega: f64,
    /// The place of rest about which it moves.
    pub place: Vec<f64>,
    /// Complex amplitudes of the coordinates; at a resonance without damping their real or imaginary parts, or both, are infinite.
    pub coordinates: Vec<Complex>,
    /// Complex amplitudes of the outputs.
    pub outputs: Vec<Complex>,
    /// What the same load does as ω -> 0: statically, with the inertia of free motions; NaN where it grows beyond all bounds.
    pub still: Vec<Complex>,
    /// Share of the static displacements that a rounding of the stiffnesses may change.
    pub doubt: f64,
}

/// |z|.
pub fn magnitude(z: Complex) -> f64 {
    elementary::hypot(z.0, z.1)
}

/// arg z in [-π, π), so that a motion against its load lags by π.
pub fn phase(z: Complex) -> f64 {
    if z == (0.0, 0.0) || !magnitude(z).is_finite() {
        return f64::NAN;
    }
    // a part of rounding turns no phase from -π to π
    if z.1.abs() <= 1e-14 * z.0.abs() {
        return if z.0 < 0.0 { -PI } else { 0.0 };
    }
    elementary::atan2(z.1, z.0)
}

/// Whether an output's own wave is one.
fn oscillates((rate, cos, sin): &(f64, f64, f64)) -> bool {
    *rate != 0.0 && (*cos != 0.0 || *sin != 0.0)
}

/// Loads below this share of the largest are no component.
const SILENT: f64 = 1e-13;
/// Orders that differ by this share are one.
const SAME: f64 = 1e-12;
/// Share of a frequency within which it is the one asked for: rates are sums and products of some roundings, and loads meant to be apart are farther than that.
const SAME_RATE: f64 = 1e-9;

impl<'m> Forced<'m> {
    /// A machine at its place with a load, and formulas to observe.
    ///
    /// `parameter` is the frequency; none when the load takes any frequency. The place is followed along it; `starts` are where rest is sought when it
    /// ends on the way.
    ///
    /// *Errors*: S033 when no rate of the load follows the parameter in proportion, S032 when the load vanishes.
    pub fn new(
        machine: &'m mut LinearMachine,
        (place, starts): (&Place, &[Vec<f64>]),
        source: Source,
        parameter: Option<usize>,
        formulas: &[Expr],
    ) -> Result<Forced<'m>, Fault> {
        let load = match &source {
            Source::OfEquations => None,
            Source::Given { parts, .. } | Source::Constant(_, parts) => Some(parts.clone()),
            Source::Unit(i) => Some(machine.unit_load(*i, formulas)?),
        };
        let observer = machine.observer(formulas, load.as_ref())?;
        let list: Vec<Expr> = match &source {
            Source::Given { waves, shaped, .. } => {
                let wave = |l: &HarmonicLoad| std::iter::once(l.rate).chain(l.cos.clone()).chain(l.sin.clone()).collect::<Vec<_>>();
                waves.iter().flat_map(wave).chain(shaped.iter().flat_map(|s| s.1.clone())).collect()
            }
            Source::Constant(parts, _) => parts.clone(),
            Source::OfEquations | Source::Unit(_) => Vec::new(),
        };
        let whole_formulas = machine.whole(formulas).ok();
        let given = if list.is_empty() { None } else { Some(machine.prepare(&list)?) };
        let rates: Vec<Expr> = machine.linear().forms.iter().map(|f| f.wave.rate).collect();
        let rates = machine.prepare(&rates)?;
        let forces: Vec<(usize, Expr)> = match &source {
            Source::OfEquations => machine.equations().force.iter().copied().enumerate().collect(),
            Source::Given { parts, .. } => parts.forces.clone(),
            Source::Constant(..) | Source::Unit(_) => Vec::new(),
        };
        let whole = machine.over_time(&forces)?;
        let branch = parameter.map(|p| Branch::new(machine, p, place, starts.to_vec()));
        let mut forced = Forced {
            whole,
            machine,
            place: place.clone(),
            branch,
            observer,
            source,
            formulas: whole_formulas,
            bent: Vec::new(),
            given,
            rates,
            follows: None,
            own: None,
            from_sine: false,
            components: Vec::new(),
            current: 0,
            last: None,
            left_out: Vec::new(),
        };
        forced.arrange(parameter)?;
        Ok(forced)
    }

    /// The same for a machine with one-sided contacts, which are as at the place: the way ends where others close or open.
    pub fn with_contacts(mut self, contacts: Option<Contacts>) -> Forced<'m> {
        self.branch = self.branch.map(|b| b.with_contacts(contacts, Beyond::Ends));
        self
    }

    /// Of ascending frequencies those that lie on one way with the place, from the first to the last without a gap.
    ///
    /// *Errors*: formulas without a value.
    pub fn reached(&mut self, omegas: &[f64]) -> Result<Vec<f64>, Fault> {
        let (Some((_, per)), Some(branch)) = (self.follows, &mut self.branch) else { return Ok(omegas.to_vec()) };
        let mut found = Vec::new();
        for omega in omegas {
            found.push(branch.place(self.machine, pace(*omega, per))?.is_some());
        }
        let home = branch.home() / per;
        let away = |i: &usize| (omegas[*i] - home).abs();
        let Some(nearest) = (0..omegas.len()).filter(|i| found[*i]).min_by(|a, b| away(a).total_cmp(&away(b))) else {
            return Err(no_equilibrium());
        };
        let below = (0..nearest).rev().take_while(|i| found[*i]).last().unwrap_or(nearest);
        let above = (nearest..omegas.len()).take_while(|i| found[*i]).last().unwrap_or(nearest);
        Ok(omegas[below..=above].to_vec())
    }

    /// The orders at which the load acts, ascending; of a waveform the first [`LISTED`] harmonics.
    pub fn components(&self) -> &[Component] {
        &self.components
    }

    /// Which order [`Forced::at`] is about: at first order 1, or the lowest.
    pub fn current(&self) -> usize {
        self.current
    }

    /// Chooses the order.
    pub fn choose(&mut self, component: usize) {
        self.current = component.min(self.components.len().saturating_sub(1));
    }

    /// Whether a waveform acts, whose series has no end.
    pub fn endless(&self) -> bool {
        self.components.iter().any(|c| !c.harmonics.is_empty())
    }

    /// ω with the parameters as the model gives them; none when the load takes any frequency.
    pub fn own_frequency(&self) -> Option<f64> {
        self.own
    }

    /// Counts phases from the wave that the largest component of the load mostly is at a frequency ω.
    ///
    /// *Errors*: S032 when there is no load.
    pub fn refer(&mut self, omega: f64) -> Result<(), Fault> {
        let matrices = self.matrices(omega)?;
        let excitation = self.excitation(&matrices)?;
        let load = self.load(&excitation, self.current, matrices.n);
        let largest =
            // equal entries differ by rounding: the first of them counts
            load.iter().fold((0.0, 0.0), |best: Complex, z| if magnitude(*z) > magnitude(best) * (1.0 + 1e-12) { *z } else { best });
        let (cos, sin) = match magnitude(largest) > 0.0 {
            true => largest,
            false => {
                let seen = self.machine.observe(&self.observer, &self.place)?;
                let wave = seen.iter().flat_map(|seen| &seen.waves).find(|wave| oscillates(wave)).copied().ok_or_else(no_load)?;
                (wave.1, wave.2)
            }
        };
        self.from_sine = sin.abs() > cos.abs();
        Ok(())
    }

    /// Whether phases count from sin ωt.
    pub fn from_sine(&self) -> bool {
        self.from_sine
    }

    /// M, B, C at a frequency ω; the parameter follows it, and the equilibrium follows the parameter.
    ///
    /// *Errors*: no place of rest at this value of the parameter.
    pub fn matrices(&mut self, omega: f64) -> Result<Matrices, Fault> {
        if let Some((parameter, per)) = self.follows {
            let value = pace(omega, per);
            self.place = match &mut self.branch {
                Some(branch) => branch.place(self.machine, value)?.ok_or_else(no_equilibrium)?,
                None => {
                    self.machine.set(parameter, value)?;
                    self.place.clone()
                }
            };
        }
        self.machine.at(&self.place)
    }

    /// Whether a parameter of the machine follows the frequency.
    pub fn is_followed(&self) -> bool {
        self.follows.is_some()
    }

    /// The modes of the machine at a frequency ω.
    ///
    /// *Errors*: as [`Forced::matrices`], S031.
    pub fn modes(&mut self, omega: f64) -> Result<Modes, Fault> {
        let matrices = self.matrices(omega)?;
        modes(&matrices, self.machine.coordinates(), Normalisation::Largest)
    }

    /// Follows the place of rest over a range of ω at once.
    ///
    /// *Errors*: formulas without a value.
    pub fn cover(&mut self, ends: [f64; 2]) -> Result<(), Fault> {
        match (self.follows, &mut self.branch) {
            (Some((_, per)), Some(branch)) => branch.cover(self.machine, ends.map(|w| pace(w, per))),
            _ => Ok(()),
        }
    }

    /// The place of rest along the parameter that is the frequency.
    pub fn branch(&self) -> Option<&Branch> {
        self.branch.as_ref()
    }

    /// The forced motion of the chosen order at the frequency `omega` of that order.
    ///
    /// *Errors*: formulas without a value at this frequency.
    pub fn at(&mut self, omega: f64) -> Result<Point, Fault> {
        self.point(Spot::At(omega))
    }

    /// The same at a distance from the frequency of a root.
    ///
    /// *Errors*: as [`Forced::at`].
    pub fn beside(&mut self, root: Complex, offset: f64) -> Result<Point, Fault> {
        self.point(Spot::Beside { root, offset })
    }

    /// Whether a root of the chosen order is a simple one, from which distances can be counted.
    ///
    /// *Errors*: formulas without a value there.
    pub fn is_simple(&mut self, root: Complex) -> Result<bool, Fault> {
        let order = self.components.get(self.current).map_or(1.0, |c| c.order);
        let matrices = self.matrices(root.1 / order)?;
        Ok(is_simple(&matrices, root))
    }

    fn point(&mut self, spot: Spot) -> Result<Point, Fault> {
        let omega = spot.omega();
        let order = self.components.get(self.current).map_or(1.0, |c| c.order);
        let matrices = self.matrices(omega / order)?;
        let excitation = self.excitation(&matrices)?;
        let turn = |z: Complex| self.turned(z);
        let load: Vec<Complex> = self.load(&excitation, self.current, matrices.n).into_iter().map(turn).collect();
        let (moving, still) = (solve_at(&matrices, spot, &load), self.still(&matrices, &load));
        if moving.doubt.is_nan() || still.doubt.is_nan() || still.doubt > DOUBT {
            return Err(hangs_on_rounding(omega));
        }
        let doubt = still.doubt;
        for z in moving.regular.iter().chain(moving.free.iter().map(|f| &f.1)).chain(moving.fine.iter().map(|f| &f.1)) {
            crate::fault::finite(z.0 + z.1, "response")?;
        }
        let seen = self.machine.observe(&self.observer, &self.place)?;
        self.movable(&seen, omega)?;
        let free = !matches!(self.source, Source::OfEquations | Source::Given { .. });
        let direct = if free { seen.iter().map(|s| self.turned((s.constant, 0.0))).collect() } else { self.direct(&seen, omega)? };
        let see = |x: &Amplitudes, omega: f64| -> Vec<Complex> {
            let one = |(s, own): (&Seen, &Complex)| {
                let (y, terms) = x.seen_in_terms(&gain(s, omega));
                let sum = (y.0 + own.0, y.1 + own.1);
                if *own == (0.0, 0.0) || !magnitude(y).is_finite() { sum } else { cancelled(sum, terms) }
            };
            seen.iter().zip(&direct).map(one).collect()
        };
        // nothing restores a free motion: there is no static displacement along it
        let unbounded = |z: Complex| if !magnitude(z).is_finite() { (f64::NAN, f64::NAN) } else { z };
        let mut still: Vec<Complex> = see(&still, 0.0).into_iter().map(unbounded).collect();
        for k in self.prescribed() {
            still[k] = (f64::NAN, f64::NAN);
        }
        let outputs = see(&moving, omega);
        // infinite by the free oscillation is meant, by overflow it is not
        for z in outputs.iter().filter(|z| z.0.is_nan() || z.1.is_nan() || moving.poles.is_empty()) {
            crate::fault::finite(z.0 + z.1, "response")?;
        }
        Ok(Point { omega, place: self.place.q.clone(), coordinates: moving.coordinates(), outputs, still, doubt })
    }

    /// A frequency written as a number changes with ω in the loads of the coordinates only: not in what outputs have of it by themselves (the load's own part of a
    /// reaction), nor in the size of loads that a motion given in time makes (A p² of a base).
    ///
    /// *Errors*: S033 away from that frequency.
    fn movable(&self, seen: &[Seen], omega: f64) -> Result<(), Fault> {
        let order = self.components.get(self.current).map_or(1.0, |c| c.order);
        let Some(own) = self.own.filter(|own| self.follows.is_none() && (omega - order * own).abs() > SAME_RATE * omega) else {
            return Ok(());
        };
        let followed = |rate: f64| self.components.iter().any(|c| (rate.abs() - c.order * own).abs() <= SAME_RATE * rate.abs());
        let alone = |s: &Seen| s.waves.iter().any(|w| oscillates(w) && followed(w.0)) || s.forms.iter().any(|f| f.1 != 0.0);
        let equations = self.machine.equations();
        let timed = |e: Expr| self.machine.linear().graph.contains(e, |s| s == equations.time);
        let moved = matches!(self.source, Source::OfEquations) && (timed(equations.energy.kinetic) || timed(equations.energy.dissipation));
        if moved || seen.iter().any(alone) { Err(written_as_number(own)) } else { Ok(()) }
    }

    /// What the load does statically; the last answer where neither the matrices nor the load have changed.
    fn still(&mut self, matrices: &Matrices, load: &[Complex]) -> Amplitudes {
        let key = Still {
            matrices: Matrices { loads: Vec::new(), shaped: Vec::new(), force: Vec::new(), ..matrices.clone() },
            load: load.to_vec(),
        };
        match &self.last {
            Some((known, found)) if *known == key => found.clone(),
            _ => {
                let found = solve(matrices, 0.0, load);
                self.last = Some((key, found.clone()));
                found
            }
        }
    }

    /// -i exp(iωt) is the sine of the wave that exp(iωt) stands for.
    pub(super) fn turned(&self, z: Complex) -> Complex {
        if self.from_sine { (-z.1, z.0) } else { z }
    }

    /// What outputs do by themselves at a frequency, the motion of a base for example.
    fn direct(&self, seen: &[Seen], omega: f64) -> Result<Vec<Complex>, Fault> {
        let rates = self.form_rates()?;
        // the frequency asked for, but for rounding of the rates
        let own = |rate: f64| (rate.abs() - omega).abs() <= SAME_RATE * omega;
        let one = |s: &Seen| {
            let mut y = (0.0, 0.0);
            for (rate, c, s) in s.waves.iter().filter(|w| own(w.0)) {
                let z = self.turned((*c, -s * rate.signum()));
                y = (y.0 + z.0, y.1 + z.1);
            }
            for (form, factor) in &s.forms {
                let (rate, wave) = (rates.get(*form).copied().unwrap_or(f64::NAN), &self.machine.shapes()[*form].wave);
                let k = (omega / rate.abs()).round();
                if (1.0..=LISTED as f64).contains(&k) && own(k * rate) {
                    let k = k as usize - 1;
                    let z = self.turned((factor * wave.cos[k], -factor * wave.sin[k] * rate.signum()));
                    y = (y.0 + z.0, y.1 + z.1);
                }
            }
            y
        };
        Ok(seen.iter().map(one).collect())
    }

    /// Outputs that are not linear in reactions.
    pub fn bent_by_reactions(&self) -> &[usize] {
        &self.observer.by_reactions
    }

    /// Outputs that contain a motion which time prescribes. How much of such an output the load of the equations makes, and how much the prescribed motion, hangs on
    /// the coordinates (absolute or relative to a moving base): nothing of it is static.
    pub fn prescribed(&self) -> Vec<usize> {
        match self.source {
            Source::OfEquations => self.observer.prescribed(),
            _ => Vec::new(),
        }
    }

    /// Outputs that depend on time by themselves, where a load acts alone.
    pub fn timed(&self) -> &[usize] {
        self.observer.timed.as_deref().unwrap_or_default()
    }

    /// Whether the load is one of the machine's own, with a size.
    pub fn has_size(&self) -> bool {
        matches!(self.source, Source::OfEquations | Source::Given { .. })
    }

    /// Puts the parameter back.
    ///
    /// *Errors*: none that was not met before.
    pub fn restore(&mut self, value: f64) -> Result<(), Fault> {
        match self.follows {
            Some((parameter, _)) => self.machine.set(parameter, value),
            None => Ok(()),
        }
    }
}

/// The parameter at a frequency. ω = 0 is the limit of slow loads, which a load that stands still is not: it belongs to the place of rest.
fn pace(omega: f64, per: f64) -> f64 {
    if omega == 0.0 { SLOWEST.copysign(per) } else { omega * per }
}

/// A frequency whose square is a number still, rad/s.
const SLOWEST: f64 = 1e-150;

/// How an output follows the coordinates at ω.
pub(super) fn gain(s: &Seen, omega: f64) -> Gain<'_> {
    Gain { place: &s.by_place, rate: &s.by_rate, acceleration: &s.by_acceleration, omega }
}

/// A sum, zero where it is rounding of its terms.
fn cancelled(sum: Complex, terms: f64) -> Complex {
    if magnitude(sum) <= CANCELLED * terms { (0.0, 0.0) } else { sum }
}

/// Share of a static displacement beyond which rounding of the stiffnesses decides it.
const DOUBT: f64 = 1e-2;

/// S066 for amplitudes.
pub(super) fn hangs_on_rounding(omega: f64) -> Fault {
    let w = rounded(omega);
    rounded_away(Text::new(
        format!("at ω = {} rad/s the amplitudes hang on rounding", w.en),
        format!("при ω = {} рад/с амплитуды определяются округлением", w.ru),
    ))
}
