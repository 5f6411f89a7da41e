//! What is followed: equations R(y) = 0 with one unknown more than there are equations, the last unknown being the parameter.

use crate::studies::periodic::{Meeting, Multiplier};
use crate::{Fault, Machine};
use algebra::vectors::norm;

/// A machine whose parameter can be given values.
pub trait Family {
    /// The machine with that value, and the period of its loads; none where its motion is free.
    ///
    /// *Errors*: what the model says against the value.
    fn at(&mut self, value: f64) -> Result<(&mut Machine, Option<f64>), Fault>;

    /// Gives the second parameter a value that holds from then on.
    fn hold(&mut self, second: f64);
}

/// What a point of a branch is, for those who read it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facts {
    /// Period, s; 0 of a place of rest.
    pub period: f64,
    /// Least and greatest value of each coordinate, SI.
    pub extremes: Vec<[f64; 2]>,
    /// Multipliers, or roots of the linear equations of a place of rest; largest first. None where the motion has no derivative by its start.
    pub multipliers: Option<Vec<Multiplier>>,
    /// Whether small disturbances die out; none where that is not decided.
    pub stable: Option<bool>,
    /// Energy above that of the place of rest, J, of free oscillations without losses.
    pub energy: Option<f64>,
    /// The guards that switch in a period.
    pub switches: Vec<usize>,
    /// How near to the ends of the period something switches, as a share of it; none where nothing does.
    pub(super) edge: Option<f64>,
    /// The guard that is met most slowly in a period; none where all instants of switches are fixed.
    pub(in crate::studies) slowest: Option<Meeting>,
    /// Newton's next correction of the point, in scales.
    pub miss: f64,
    /// By how much Liouville's formula is missed.
    pub liouville: f64,
    /// On a curve of Hopf or torus points what tells the pair: ω² as a share of its first value, or the cosine of its angle.
    pub(super) pair: Option<(Sort, f64)>,
    /// On a curve of Hopf points the first Lyapunov coefficient.
    pub lyapunov: Option<f64>,
    /// On a curve of folds w ∂R/∂p of both parameters, w A = 0.
    pub(super) across: Option<[f64; 2]>,
    /// On a curve of folds of places of rest the product of the roots that are not 0, as a share of what it may be.
    pub(super) rest: Option<f64>,
    /// Number of intervals of the mesh where it was found by collocation; none of other points.
    pub intervals: Option<usize>,
    /// By how much the motion from the beginning of an interval misses the next one, in scales; of collocation.
    pub defect: f64,
}

/// The equations near a point.
#[derive(Clone, Debug, Default)]
pub(super) struct Local {
    /// Sizes of the unknowns, SI.
    pub(super) scales: Vec<f64>,
    /// ∂R/∂c: rows are the equations, columns the free directions and the parameter as the last one, all in scales.
    pub(super) jacobian: Vec<f64>,
    /// What each row is in other places, in scales: where rows vanish they are held against it. Empty where they are told by themselves.
    pub(super) rows: Vec<f64>,
    /// Sizes of the unknowns in this motion alone, SI: beside a high peak the scales are those of the peak. Empty where they are the same.
    pub(super) own: Vec<f64>,
    /// R there, in scales.
    pub(super) residual: Vec<f64>,
    /// Change of y by each direction, in scales.
    pub(super) basis: Vec<Vec<f64>>,
    /// States that are compared at the end of a turn.
    pub(super) states: Vec<usize>,
    /// Phase of a free motion: rates and state at which the phase is fixed.
    pub(super) phase: Option<(Vec<f64>, Vec<f64>)>,
    /// A motion that is nothing but steady turning: its turn in place of its phase.
    pub(super) turning: Option<Turn>,
    pub(super) facts: Facts,
}

/// Steady turning by an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Turn {
    /// State of the angle.
    pub(super) angle: usize,
    /// State of its rate.
    pub(super) rate: usize,
    /// Rate, rad/s.
    pub(super) speed: f64,
    /// Period, s.
    pub(super) period: f64,
    /// What the angle turns by in a period, rad.
    pub(super) whole: f64,
}

impl Local {
    /// Number of equations.
    pub(super) fn rows(&self) -> usize {
        self.basis.len().saturating_sub(1)
    }

    /// The largest change that local directions make of an unknown, in its size in this motion.
    pub(super) fn change(&self, c: &[f64]) -> f64 {
        if self.own.is_empty() {
            return norm(c);
        }
        let of = |i: usize| c.iter().zip(&self.basis).map(|(c, b)| c * b[i]).sum::<f64>() * self.scales[i] / self.own[i];
        (0..self.own.len()).map(|i| of(i).abs()).fold(0.0, f64::max)
    }

    /// By how much the phase of a free motion is off at y, in scales; none of other motions.
    pub(super) fn phase_at(&self, y: &[f64]) -> Option<f64> {
        let (rates, x) = self.phase.as_ref()?;
        if let Some(turn) = &self.turning {
            return Some((y[turn.rate] * y[rates.len()] - turn.whole) / self.scales[turn.angle]);
        }
        Some(rates.iter().zip(y.iter().zip(x)).zip(&self.scales).map(|((r, (y, x)), s)| r / s * ((y - x) / s)).sum())
    }
}

/// Equations with one unknown more.
pub(super) trait Zeros {
    /// The equations near y.
    fn local(&mut self, y: &[f64]) -> Result<Local, Fault>;

    /// R(y) in scales.
    fn residual(&mut self, y: &[f64], near: &Local) -> Result<Vec<f64>, Fault>;

    /// y changed in the directions of a point near it, on the conditions of connections.
    fn moved(&mut self, y: &[f64], change: &[f64], near: &Local) -> Result<Vec<f64>, Fault>;

    /// The guards that switch in the motion from y; none where there is no motion.
    fn switches(&mut self, y: &[f64]) -> Option<Vec<usize>>;

    /// Gives the second parameter a value that holds from then on.
    fn hold(&mut self, second: f64);

    /// Follows motions that repeat after so many periods of the loads; 0 where the period is their own.
    fn repeat(&mut self, periods: usize) {
        let _ = periods;
    }

    /// Which test functions mean something.
    fn sort(&self) -> Sort;

    /// Whether the motion at a point is so sensitive that the next ones are better found otherwise.
    fn outgrown(&self, place: &Place) -> bool {
        let _ = place;
        false
    }

    /// The same by finer equations, where they do for the motion at a point; with their unknowns there.
    fn finer(&mut self, place: &Place) -> Option<(Box<dyn Finer + '_>, Place)> {
        let _ = place;
        None
    }

    /// The first Lyapunov coefficient of a place of rest at which a pair of roots is on the axis.
    fn lyapunov(&mut self, y: &[f64]) -> Option<f64> {
        let _ = y;
        None
    }

    /// No finer equations are asked for any more.
    fn stay(&mut self) {}

    /// Work done.
    fn turns(&self) -> [usize; 2];
}

/// Equations with more unknowns, which are laid out anew now and then.
pub(super) trait Finer: Zeros {
    /// Lays them out anew for the motion at a point; none where that takes too many unknowns.
    fn remesh(&mut self, place: &Place) -> Result<Option<Place>, Fault>;

    /// A point with the unknowns of the coarser equations.
    fn shortened(&self, place: Place) -> Place;

    /// They themselves.
    fn zeros(&mut self) -> &mut dyn Zeros;
}

/// What the numbers of stability are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sort {
    /// Multipliers: stable inside of the unit circle.
    Multipliers,
    /// Roots: stable left of the imaginary axis.
    Roots,
}

/// The test functions at a point.
#[derive(Clone, Debug, Default)]
pub(super) struct Signs {
    pub(super) fold: f64,
    pub(super) branch: f64,
    /// Number of directions that change no equation, at points as at this one.
    pub(super) neutral: usize,
    /// det J without the column of the parameter: zero at a fold and at a branch point, and known to all digits of Φ, where the column is that of a difference.
    pub(super) square: f64,
    /// None of places of rest.
    pub(super) doubling: Option<f64>,
    /// Torus or Hopf.
    pub(super) pair: Option<f64>,
    /// Whether some pair is on the circle (the axis), as all are in a machine without damping.
    pub(super) paired: bool,
    /// Number of multipliers outside.
    pub(super) outside: Option<usize>,
    /// Of free motions without losses Π (1 - μ).
    pub(super) ones: Option<f64>,
    /// On a curve of folds how both parameters move along it, by w ∂R/∂p.
    pub(super) cusp: Option<f64>,
}

/// Points lie on their branch to this share of what varies: corrections end below it, mostly by three digits.
pub const ON_BRANCH: f64 = 1e-9;

/// Share of the period beside its ends within which what switches does so at its ends: branches come as near to where that happens as to any other end.
const AT_EDGE: f64 = 1e-5;
/// Share by which corrections leave a point, and by what share of itself the rate of a guard may be unsure with that.
const CORRECTED: f64 = 1e-10;
const RESOLVED: f64 = 0.01;

/// A point of a branch.
#[derive(Clone, Debug, Default)]
pub struct Place {
    /// Unknowns, SI; the parameter is the last one.
    pub(super) y: Vec<f64>,
    /// Direction of the branch: dy/ds, in SI.
    pub(super) tangent: Vec<f64>,
    pub(super) local: Local,
    pub(super) signs: Signs,
}

impl Place {
    /// Value of the parameter, SI.
    pub fn parameter(&self) -> f64 {
        self.y.last().copied().unwrap_or(f64::NAN)
    }

    /// All unknowns: states at the start, the period of a free motion, the parameter; SI.
    pub fn unknowns(&self) -> &[f64] {
        &self.y
    }

    /// Whether Newton's own correction leaves it where it is, to this share of what varies.
    pub(super) fn lies(&self) -> bool {
        self.local.facts.miss <= ON_BRANCH && self.local.facts.defect <= ON_BRANCH
    }

    /// Whether something switches just where the period begins. A switch that passes there is none that is touched: the motion is the same one, counted otherwise.
    pub(super) fn is_at_edge(&self) -> bool {
        self.local.facts.edge.is_some_and(|edge| edge <= AT_EDGE)
    }

    /// Whether it cannot be told how fast the slowest switch is met: the branch ends before it.
    pub(super) fn is_blurred(&self) -> bool {
        self.local.facts.slowest.is_some_and(|meeting| meeting.unsure * CORRECTED > RESOLVED)
    }

    /// What it is.
    pub fn facts(&self) -> &Facts {
        &self.local.facts
    }

    /// J, and the tangent of the branch as the last row.
    pub(super) fn bordered(&self) -> Vec<f64> {
        let column = |c: &Vec<f64>| self.tangent.iter().zip(c).zip(&self.local.scales).map(|((t, c), s)| t / s * c).sum::<f64>();
        let mut matrix = self.local.jacobian.clone();
        matrix.extend(self.local.basis.iter().map(column));
        matrix
    }

    /// a · b in the scales of this place.
    pub(super) fn dot(&self, a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).zip(&self.local.scales).map(|((a, b), s)| a / s * (b / s)).sum()
    }
}
