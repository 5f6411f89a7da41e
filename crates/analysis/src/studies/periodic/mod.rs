//! The exact periodic regime: the start that the motion comes back to, its period and its Floquet multipliers.
//!
//! A turn leads from a section (a coordinate has made its turn, or has returned to its value in the same direction, or a given period is over) back to
//! it: x -> P(x), up to translations that leave the motion the same (`symmetry.rs`). Newton's method solves P(x) = x with
//!
//! ```text
//! dP = (1 - f σᵀ/(σ·f)) Φ       Φ fundamental matrix of the turn ([`fundamental`]), f rates at its end, σ the state that defines the section
//! ```
//!
//! on the tangent space of all conditions of connections; far from the regime the map itself is iterated. The multipliers are the eigenvalues of Φ
//! on that space. For an autonomous machine one of them is 1 (a shift along the motion), which checks the whole computation.
//! *Source*: A. H. Nayfeh, B. Balachandran, Applied Nonlinear Dynamics, 5.2, 7.4.

mod fundamental;
mod newton;
mod orbit;
mod symmetry;

use std::sync::atomic::{AtomicBool, Ordering};

use symbolic::Text;

use super::simulate::{self, Grid};
use crate::dataset::{Audit, Dataset};
use crate::fault::{Message, number, rounded};
use crate::numerics::eigen::general;
use crate::taylor::check_tolerance;
use crate::{Fault, System};

/// What brings the motion back.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Return {
    /// An angle that turns, otherwise the state that moves most.
    #[default]
    Automatic,
    /// This coordinate, rate or auxiliary state: a whole turn of an angle, or the same value in the same direction.
    State(String),
    /// A given period, s.
    Period(f64),
}

/// A formula of time and state.
pub type Formula<'a> = &'a dyn Fn(f64, &[f64]) -> f64;

/// Options of the study.
pub struct Periodic<'a> {
    /// What brings the motion back.
    pub by: Return,
    /// Formula of (t, state) that passes zero from below where the period is to begin; at the start's own section when absent.
    pub begin: Option<Formula<'a>>,
    /// Returns in one period; 1 unless the motion repeats only after several.
    pub returns: usize,
    /// Time simulated before the search, s: lets the motion come near its regime.
    pub settle: f64,
    /// Longest period searched, s.
    pub longest: f64,
    /// Relative tolerance of a step.
    pub tolerance: f64,
    /// Times of the result within the period.
    pub grid: Grid,
    /// Outputs by name; all when absent.
    pub outputs: Option<Vec<String>>,
    /// Set from outside to stop early.
    pub interrupt: Option<&'a AtomicBool>,
    /// Seed of the audits.
    pub seed: u64,
}

impl Default for Periodic<'_> {
    fn default() -> Self {
        Periodic {
            by: Return::Automatic,
            begin: None,
            returns: 1,
            settle: 0.0,
            longest: 1e4,
            tolerance: 1e-14,
            grid: Grid::Auto,
            outputs: None,
            interrupt: None,
            seed: 1,
        }
    }
}

/// An eigenvalue of the fundamental matrix.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Multiplier {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
    /// Whether it belongs to a shift along the motion or another translation, and is 1 for that reason.
    pub trivial: bool,
}

impl Multiplier {
    /// Magnitude.
    pub fn abs(&self) -> f64 {
        self.re.hypot(self.im)
    }
}

/// A periodic regime.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Regime {
    /// Period, s.
    pub period: f64,
    /// Largest first.
    pub multipliers: Vec<Multiplier>,
    /// State at the start.
    pub start: Vec<f64>,
    /// What the states gain in a period: whole turns and drift.
    pub gain: Vec<f64>,
    /// Whether every multiplier that is not trivial lies inside the unit circle; none when one is on it.
    pub stable: Option<bool>,
    /// The motion over one period.
    pub dataset: Dataset,
}

/// A regime, or why there is none, with what was found so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// The regime.
    pub regime: Regime,
    /// Why there is no more.
    pub fault: Option<Fault>,
}

/// Multipliers this near to the unit circle decide nothing.
const NEUTRAL: f64 = 1e-5;

/// Searches the periodic regime from the state `start` at t = 0.
///
/// *Errors*: S041 when the motion does not come back, S042 when the search does not settle, S043 when a machine driven in time gets no
/// period or a wrong one, and every fault of a motion.
pub fn periodic<S: System + ?Sized>(system: &mut S, start: &[f64], options: &Periodic<'_>) -> Outcome {
    match search(system, start, options) {
        Ok(regime) => Outcome { regime, fault: None },
        Err(fault) => {
            Outcome { regime: Regime { dataset: Dataset { partial: true, ..Dataset::default() }, ..Regime::default() }, fault: Some(fault) }
        }
    }
}

fn search<S: System + ?Sized>(system: &mut S, start: &[f64], options: &Periodic<'_>) -> Result<Regime, Fault> {
    check_tolerance(options.tolerance)?;
    let mut found = newton::solve(system, start, options)?;
    if let Some(begin) = options.begin {
        let again = &Periodic {
            by: options.by.clone(),
            returns: options.returns,
            longest: options.longest,
            tolerance: options.tolerance,
            interrupt: options.interrupt,
            ..Periodic::default()
        };
        let x = found.orbit.first_zero(begin).ok_or_else(never_passed)?;
        found = newton::solve(system, &found.at_time_zero(x), again)?;
    }
    let (matrix, grazing) = found.monodromy(system)?;
    let n = found.returning(None).len();
    let mut values = if n == 0 { Vec::new() } else { general(n, &matrix)?.values };
    values.sort_by(|a, b| b.0.hypot(b.1).total_cmp(&a.0.hypot(a.1)).then(b.0.total_cmp(&a.0)).then(b.1.total_cmp(&a.1)));
    let multipliers = named(&values, found.trivial());
    let plan = simulate::Simulate {
        grid: options.grid.clone(),
        outputs: options.outputs.clone(),
        tolerance: options.tolerance,
        interrupt: options.interrupt,
        seed: options.seed,
        ..simulate::Simulate::until(found.orbit.period)
    };
    let run = simulate::simulate(system, &found.orbit.first, plan);
    if let Some(fault) = run.fault {
        return Err(fault);
    }
    let mut dataset = run.dataset;
    found.audits(system, &multipliers, options.tolerance, &mut dataset.audits)?;
    if grazing {
        dataset.notes.push(Text::new(
            "a switch is only touched (grazing): the multipliers are those of one side",
            "поверхность переключения лишь затронута (касание): мультипликаторы односторонние",
        ));
    }
    let gain = found.orbit.last.iter().zip(&found.orbit.first).map(|(b, a)| b - a).collect();
    Ok(Regime { period: found.orbit.period, stable: stable(&multipliers), multipliers, start: found.orbit.first, gain, dataset })
}

/// The multipliers, the `trivial` nearest to 1 marked.
fn named(values: &[(f64, f64)], trivial: usize) -> Vec<Multiplier> {
    let mut out: Vec<Multiplier> = values.iter().map(|&(re, im)| Multiplier { re, im, trivial: false }).collect();
    for _ in 0..trivial.min(out.len()) {
        let distance = |m: &Multiplier| if m.trivial { f64::INFINITY } else { (m.re - 1.0).hypot(m.im) };
        if let Some(nearest) = out.iter_mut().min_by(|a, b| distance(a).total_cmp(&distance(b))) {
            nearest.trivial = true;
        }
    }
    out
}

fn stable(multipliers: &[Multiplier]) -> Option<bool> {
    let largest = multipliers.iter().filter(|m| !m.trivial).map(Multiplier::abs).fold(0.0, f64::max);
    if largest.is_nan() || (largest - 1.0).abs() <= NEUTRAL { None } else { Some(largest < 1.0) }
}

/// Checks of a regime.
fn closure(value: f64) -> Audit {
    let name = Text::new(
        "the motion comes back to its start: largest relative difference",
        "движение возвращается в начало: наибольшее относительное расхождение",
    );
    Audit::at_most("closure", name, value, 1e-10)
}

fn interrupted(options: &Periodic<'_>) -> bool {
    options.interrupt.is_some_and(|flag| flag.load(Ordering::Relaxed))
}

/// The motion does not come back to the section.
fn no_return(name: &Text, longest: f64) -> Fault {
    let n = rounded(longest);
    Fault::new(Message {
        code: "S041",
        what: Text::new(
            format!("{} does not come back within {} s", name.en, n.en),
            format!("{} не возвращается в течение {} с", name.ru, n.ru),
        ),
        why: Text::new(
            "the machine comes to rest, runs away, or needs another section",
            "машина останавливается, уходит неограниченно далеко или нужно другое сечение",
        ),
        help: Text::new(
            "name the coordinate that turns or returns (`by`), let the motion settle first, or give the period",
            "укажите координату, которая совершает оборот или возвращается (`by`), дайте движению установиться или задайте период",
        ),
    })
}

/// Newton's method and the iteration of turns came to no end.
fn unsettled(residual: f64, turns: usize) -> Fault {
    let n = rounded(residual);
    Fault::new(Message {
        code: "S042",
        what: Text::new(
            format!("no periodic regime was found in {turns} turns; the motion still misses its start by {} of its range", n.en),
            format!("за {turns} оборотов периодический режим не найден; движение не возвращается в начало на {} своего размаха", n.ru),
        ),
        why: Text::new(
            "the start is far from a regime, the motion is not periodic (beats, chaos), or it repeats only after several returns",
            "начало далеко от режима, движение не периодическое (биения, хаос) или повторяется только через несколько возвращений",
        ),
        help: Text::new(
            "begin nearer to the regime (`settle`), or give the number of returns in a period",
            "начните ближе к режиму (`settle`) или задайте число возвращений за период",
        ),
    })
}

/// Time occurs in the equations, so the period is that of the forcing.
fn driven(given: Option<f64>) -> Fault {
    let what = match given {
        None => Text::new("time occurs in the equations, and no period is given", "время входит в уравнения явно, а период не задан"),
        Some(period) => {
            let n = number(period);
            Text::new(format!("{} s is not a period of the forces", n.en), format!("{} с – не период вынуждающих сил", n.ru))
        }
    };
    Fault::new(Message {
        code: "S043",
        what,
        why: Text::new(
            "a forced motion can repeat only after whole periods of its forcing",
            "вынужденное движение может повторяться только через целое число периодов возмущения",
        ),
        help: Text::new(
            "give the period of the forcing, for example period = \"2*pi/p\"",
            "задайте период возмущения, например period = \"2*pi/p\"",
        ),
    })
}

/// The formula that begins a period has no zero on the regime.
fn never_passed() -> Fault {
    Fault::new(Message {
        code: "S044",
        what: Text::new(
            "the periodic motion never passes the section from below",
            "периодическое движение ни разу не проходит сечение снизу вверх",
        ),
        why: Text::new("the formula of the section keeps its sign over the whole period", "формула сечения сохраняет знак на всём периоде"),
        help: Text::new(
            "choose a section that the motion crosses, for example a rate: section = \"x'\"",
            "выберите сечение, которое движение пересекает, например скорость: section = \"x'\"",
        ),
    })
}
