//! Forced oscillations over the frequency of a harmonic load: (C - ω² M + i ω B) X = F.
//!
//! c cos ωt + s sin ωt is Re((c - i s) exp iωt). Where the load's frequency is a parameter of the model, this parameter follows ω, so that a
//! load whose amplitude grows with the frequency (unbalance), a base that moves and matrices that depend on the speed are right by
//! themselves. Phases are relative to the load: to sin ωt or cos ωt, whichever the largest load component mostly is; lag is negative.
//!
//! *Source*: C. W. de Silva, Vibration: Fundamentals and Practice, ch. 3; L. Meirovitch, Fundamentals of Vibrations, ch. 3.

use std::f64::consts::PI;

use symbolic::{Expr, Text};

use crate::Fault;
use crate::fault::{Message, rounded};
use crate::linear::{LinearMachine, Matrices, Observer, Place, Values};
use crate::numerics::lu::Lu;
use crate::studies::modes::Complex;

/// What excites.
#[derive(Clone, Debug)]
pub enum Source {
    /// A harmonic load of the equations, by its index in [`Matrices::loads`].
    OfEquations(usize),
    /// Expressions of the linear graph: rate (none for a load that takes any frequency), cosine parts, sine parts.
    Given {
        /// ν.
        rate: Option<Expr>,
        /// c and s of every coordinate, one after another.
        parts: Vec<Expr>,
    },
    /// A unit load c = 1 on one coordinate.
    Unit(usize),
}

/// A forced machine.
pub struct Forced<'m> {
    machine: &'m mut LinearMachine,
    place: Place,
    observer: Observer,
    source: Source,
    given: Option<Values>,
    /// The parameter that is the frequency, and its number for rate 1.
    follows: Option<(usize, f64)>,
    /// Whether phases count from sin ωt.
    from_sine: bool,
}

/// The machine at a frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// ω.
    pub omega: f64,
    /// Complex amplitudes of the coordinates; infinite at a resonance without damping.
    pub coordinates: Vec<Complex>,
    /// Complex amplitudes of the outputs.
    pub outputs: Vec<Complex>,
    /// What the same load does when it acts statically; NaN where nothing restores.
    pub still: Vec<Complex>,
}

/// |z|.
pub fn magnitude(z: Complex) -> f64 {
    z.0.hypot(z.1)
}

/// arg z in [-π, π), so that a motion against its load lags by π.
pub fn phase(z: Complex) -> f64 {
    if z == (0.0, 0.0) {
        return f64::NAN;
    }
    if z.1.abs() <= 1e-14 * z.0.abs() {
        return if z.0 < 0.0 { -PI } else { 0.0 };
    }
    z.1.atan2(z.0)
}

impl<'m> Forced<'m> {
    /// A machine at its place with a load, and formulas to observe.
    ///
    /// `parameter` is the frequency; none when the load takes any frequency.
    ///
    /// *Errors*: S033 when the rate of the load does not follow the parameter in proportion, S032 when the load vanishes.
    pub fn new(
        machine: &'m mut LinearMachine,
        place: &Place,
        source: Source,
        parameter: Option<usize>,
        formulas: &[Expr],
    ) -> Result<Forced<'m>, Fault> {
        let observer = machine.observer(formulas)?;
        let given = match &source {
            Source::Given { rate, parts } => {
                let list: Vec<Expr> = rate.iter().chain(parts).copied().collect();
                Some(machine.prepare(&list)?)
            }
            _ => None,
        };
        let mut forced = Forced { machine, place: place.clone(), observer, source, given, follows: None, from_sine: false };
        if let Some(parameter) = parameter {
            forced.follows = Some((parameter, forced.per_rate(parameter)?));
        }
        Ok(forced)
    }

    /// value/rate of the frequency's parameter.
    fn per_rate(&mut self, parameter: usize) -> Result<f64, Fault> {
        let own = self.machine.value(parameter);
        let probe = if own == 0.0 { 1.0 } else { own };
        let mut rates = [0.0; 2];
        for (k, rate) in rates.iter_mut().enumerate() {
            self.machine.set(parameter, probe * (k + 1) as f64)?;
            let matrices = self.machine.at(&self.place)?;
            *rate = self.load(&matrices)?.0.unwrap_or(f64::NAN);
        }
        self.machine.set(parameter, own)?;
        let proportional = rates[0].abs() > 0.0 && (rates[1] - 2.0 * rates[0]).abs() <= 1e-12 * rates[1].abs();
        if proportional { Ok(probe / rates[0]) } else { Err(not_proportional(&self.machine.parameters()[parameter].name)) }
    }

    /// The frequency of the load with the parameters as the model gives them.
    pub fn own_frequency(&mut self) -> Result<Option<f64>, Fault> {
        let matrices = self.machine.at(&self.place)?;
        Ok(self.load(&matrices)?.0.map(f64::abs))
    }

    /// Counts phases from the wave that the largest component of the load mostly is at a frequency.
    ///
    /// *Errors*: S032 when there is no load.
    pub fn refer(&mut self, omega: f64) -> Result<(), Fault> {
        let matrices = self.matrices(omega)?;
        let (_, load) = self.load(&matrices)?;
        let largest =
            load.iter().fold((0.0, 0.0), |best: Complex, z| if magnitude(*z) > magnitude(best) * (1.0 + 1e-12) { *z } else { best });
        if magnitude(largest) == 0.0 {
            return Err(no_load());
        }
        self.from_sine = largest.1.abs() > largest.0.abs();
        Ok(())
    }

    /// Whether phases count from sin ωt.
    pub fn from_sine(&self) -> bool {
        self.from_sine
    }

    /// M, B, C at a frequency; the parameter follows it, and the equilibrium follows the parameter.
    pub fn matrices(&mut self, omega: f64) -> Result<Matrices, Fault> {
        if let Some((parameter, per_rate)) = self.follows {
            self.machine.set(parameter, omega * per_rate)?;
            self.place = self.machine.settle(&self.place.q)?;
        }
        self.machine.at(&self.place)
    }

    /// Rate of the load, and F = c - i s.
    fn load(&mut self, matrices: &Matrices) -> Result<(Option<f64>, Vec<Complex>), Fault> {
        let n = matrices.n;
        match &self.source {
            Source::OfEquations(i) => {
                let Some(load) = matrices.loads.get(*i) else { return Err(no_load()) };
                let sign = load.rate.signum();
                Ok((Some(load.rate), load.cos.iter().zip(&load.sin).map(|(c, s)| (*c, -sign * s)).collect()))
            }
            Source::Given { rate, .. } => {
                let Some(given) = &self.given else { return Err(no_load()) };
                let values = self.machine.values(given, &self.place)?;
                let (head, parts) = values.split_at(usize::from(rate.is_some()));
                let sign = head.first().map_or(1.0, |rate| rate.signum());
                Ok((head.first().copied(), (0..n).map(|i| (parts[i], -sign * parts[n + i])).collect()))
            }
            Source::Unit(i) => Ok((None, (0..n).map(|k| (f64::from(u8::from(k == *i)), 0.0)).collect())),
        }
    }

    /// The forced motion at ω.
    ///
    /// *Errors*: formulas without a value at this frequency.
    pub fn at(&mut self, omega: f64) -> Result<Point, Fault> {
        let matrices = self.matrices(omega)?;
        let (rate, load) = self.load(&matrices)?;
        // from here on exp(iωt) stands for the wave from which phases count: -i exp(iωt) is its sine
        let turn = |z: Complex| if self.from_sine { (-z.1, z.0) } else { z };
        let load: Vec<Complex> = load.into_iter().map(turn).collect();
        let coordinates = solve(&matrices, omega, &load);
        let mut still = solve(&matrices, 0.0, &load);
        if still.iter().any(|z| z.0.is_infinite()) {
            // nothing restores a free motion: there is no static displacement
            still.fill((f64::NAN, f64::NAN));
        }
        let seen = self.machine.observe(&self.observer, &self.place)?;
        // what oscillates with the load by itself, the motion of a base for example
        let own = |other: f64| rate.is_some_and(|rate| (other.abs() - rate.abs()).abs() <= 1e-9 * rate.abs());
        let see = |x: &[Complex], omega: f64| -> Vec<Complex> {
            let one = |s: &crate::linear::Seen| {
                let mut y = (0.0, 0.0);
                for (i, z) in x.iter().enumerate() {
                    // ∂y/∂q + iω ∂y/∂q' - ω² ∂y/∂q''
                    let g = (s.by_place[i] - omega * omega * s.by_acceleration[i], omega * s.by_rate[i]);
                    if g != (0.0, 0.0) {
                        y = (y.0 + g.0 * z.0 - g.1 * z.1, y.1 + g.0 * z.1 + g.1 * z.0);
                    }
                }
                for (rate, c, s) in s.waves.iter().filter(|w| own(w.0)) {
                    let direct = turn((*c, -s * rate.signum()));
                    y = (y.0 + direct.0, y.1 + direct.1);
                }
                y
            };
            seen.iter().map(one).collect()
        };
        let (outputs, still) = (see(&coordinates, omega), see(&still, 0.0));
        Ok(Point { omega, coordinates, outputs, still })
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

/// (C - ω² M + i ω B) X = F as a real system of twice the size; infinite where it is singular.
pub fn solve(m: &Matrices, omega: f64, load: &[Complex]) -> Vec<Complex> {
    if let Some((z, k)) = m.allowed() {
        // X = Z Y with Zᵀ (C - ω² M + i ω B) Z Y = Zᵀ F
        let onto = |c: usize| (0..m.n).fold((0.0, 0.0), |s, i| (s.0 + z[i * k + c] * load[i].0, s.1 + z[i * k + c] * load[i].1));
        let y = solve(&m.reduced(&z, k), omega, &(0..k).map(onto).collect::<Vec<_>>());
        return (0..m.n).map(|i| (0..k).fold((0.0, 0.0), |s, c| (s.0 + z[i * k + c] * y[c].0, s.1 + z[i * k + c] * y[c].1))).collect();
    }
    let n = m.n;
    let mut a = vec![0.0; 4 * n * n];
    for i in 0..n {
        for j in 0..n {
            let k = m.stiffness[i * n + j] - omega * omega * m.mass[i * n + j];
            let b = omega * m.damping[i * n + j];
            a[i * 2 * n + j] = k;
            a[i * 2 * n + n + j] = -b;
            a[(n + i) * 2 * n + j] = b;
            a[(n + i) * 2 * n + n + j] = k;
        }
    }
    let right: Vec<f64> = load.iter().map(|z| z.0).chain(load.iter().map(|z| z.1)).collect();
    match Lu::new(&a, 2 * n).solve(&right) {
        Some(x) => (0..n).map(|i| (x[i], x[n + i])).collect(),
        None => vec![(f64::INFINITY, 0.0); n],
    }
}

fn no_load() -> Fault {
    Fault::new(Message {
        code: "S032",
        what: Text::new("nothing excites the machine harmonically", "гармонической нагрузки нет"),
        why: Text::new(
            "no force, torque or base motion of the form A sin(p*t) or A cos(p*t) acts, or its amplitude is zero",
            "нет силы, момента или движения основания вида A sin(p*t) или A cos(p*t), либо амплитуда равна нулю",
        ),
        help: Text::new(
            "name a load: load = \"x\" puts a unit load on the coordinate x",
            "укажите нагрузку: load = \"x\" — единичная нагрузка по координате x",
        ),
    })
}

/// There is no harmonic load.
pub fn without_load() -> Fault {
    no_load()
}

/// Several parameters could be the frequency.
pub fn ambiguous(names: &[String]) -> Fault {
    let list = names.join(", ");
    Fault::new(Message {
        code: "S033",
        what: Text::new(format!("which is the frequency: {list}?"), format!("что является частотой: {list}?")),
        why: Text::new(
            "the loads oscillate with several of these parameters",
            "нагрузки колеблются с частотами, зависящими от этих параметров",
        ),
        help: Text::new("name it: over = \"p\"", "укажите: over = \"p\""),
    })
}

fn not_proportional(name: &str) -> Fault {
    Fault::new(Message {
        code: "S033",
        what: Text::new(
            format!("the frequency of the load is not proportional to `{name}`"),
            format!("частота нагрузки не пропорциональна `{name}`"),
        ),
        why: Text::new(
            "the response is taken over the frequency, which this parameter must set",
            "отклик строится по частоте, а её должен задавать этот параметр",
        ),
        help: Text::new(
            "name another parameter, or write the load as A*sin(p*t)",
            "укажите другой параметр или запишите нагрузку как A*sin(p*t)",
        ),
    })
}

/// A range of frequencies that cannot be used.
pub fn bad_range(from: f64, to: f64) -> Fault {
    let (a, b) = (rounded(from), rounded(to));
    Fault::new(Message {
        code: "S034",
        what: Text::new(
            format!("the range of frequencies {} ... {} has no meaning", a.en, b.en),
            format!("диапазон частот {} ... {} не имеет смысла", a.ru, b.ru),
        ),
        why: Text::new(
            "frequencies are positive and ascend; a logarithmic axis begins above zero",
            "частоты положительны и возрастают; логарифмическая ось начинается выше нуля",
        ),
        help: Text::new("give for example 1,100 (rad/s)", "задайте, например, 1,100 (рад/с)"),
    })
}
