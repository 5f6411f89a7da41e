//! Periodic motions as zeros: the states that a turn of given length misses.
//!
//! ```text
//! R(x, p)    = φ_T(p)(x; p) - x                                   driven in time: T is that of the loads
//! R(x, T, p) = φ_T(x; p) - x,   f(x_0) · (x - x_0)                 free: T is sought, and where the period begins is fixed beside the last point
//! ```

use super::collocation::Collocation;
use super::ground::{Ground, not_the_period, not_the_turn, passes_the_start, period_at};
use super::zeros::{Facts, Family, Finer, Local, Place, Sort, Turn, Zeros};
use crate::studies::periodic::{Multiplier, Shooting, Turned, Varied};
use crate::studies::stability::{Verdict, verdict};
use crate::{Fault, System};
use algebra::vectors::norm;

/// Step of the parameter for derivatives, as a share of its range: turns are known to some fourteen digits, and half of that is the best of a difference.
const STEP: f64 = 1e-7;

/// The same where something switches, of both sides.
const NEARER: [f64; 5] = [STEP, 1e-8, 1e-9, 1e-10, 1e-11];
/// Share by which the changes of both sides may differ: its square is the error of their mean.
const STRAIGHT: f64 = 1e-3;
/// What a turn is known to, in scales.
const ROUNDING: f64 = 1e-14;

/// Periodic motions of a machine along its parameter.
pub(super) struct Orbits<'f, 'o> {
    pub(super) family: &'f mut dyn Family,
    pub(super) shooting: Shooting<'o>,
    /// Periods of the loads in one of the motion.
    pub(super) returns: usize,
    /// Range of the parameter.
    pub(super) range: f64,
    /// Turns followed, and turns varied.
    pub(super) work: [usize; 2],
    /// By what points are found.
    pub(super) by: By,
}

/// By what points are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum By {
    /// By whole turns, and by collocation where these are too sensitive.
    #[default]
    Either,
    /// By whole turns alone.
    Turns,
}

/// Largest multiplier with which whole turns are followed: of fourteen digits of a turn eight are left.
const SENSITIVE: f64 = 1e6;

/// What follows from the states that return is missed by less where it returns as well: beside a miss of theirs only its square is left.
const SAME: f64 = 1e-6;

impl<'o> Orbits<'_, 'o> {
    /// Scales of the unknowns.
    fn scales(&self) -> Vec<f64> {
        let mut scales = self.shooting.scales().to_vec();
        if !self.shooting.is_driven() {
            scales.push(self.shooting.regime().1);
        }
        scales.push(self.range);
        scales
    }

    /// The turn that begins at y.
    fn turn(&mut self, y: &[f64]) -> Result<Turned<'o>, Fault> {
        let n = self.shooting.scales().len();
        self.work[0] += 1;
        let (driven, returns) = (self.shooting.is_driven(), self.returns);
        let period = period_at(self.family, y, driven.then_some(returns))?;
        let (machine, _) = self.family.at(y[y.len() - 1])?;
        self.shooting.turn(machine, &y[..n], period)
    }

    /// R at y, whose start is first put onto the conditions.
    fn off(&mut self, y: &[f64], near: &Local) -> Result<Vec<f64>, Fault> {
        let y = self.seated(y)?;
        let turned = self.turn(&y)?;
        Ok(missed(&turned, &y, near))
    }

    /// Change of R with the parameter, over its range. By one difference ahead; where something switches, and the motion beside it may switch otherwise or not at all, by
    /// one over both sides, so near that they differ little from each other.
    fn slope(&mut self, y: &[f64], here: &[f64], local: &Local) -> Result<Vec<f64>, Fault> {
        let mut beside = |step: f64| {
            let mut there = y.to_vec();
            there[y.len() - 1] += step * self.range;
            self.off(&there, local)
        };
        if local.facts.switches.is_empty() {
            let ahead = beside(STEP)?;
            return Ok(here.iter().zip(&ahead).map(|(here, ahead)| (ahead - here) / STEP).collect());
        }
        let (mut best, mut failed) = (None, None);
        for step in NEARER {
            let [before, behind] = match (beside(-step), beside(step)) {
                (Ok(before), Ok(behind)) => [before, behind],
                (Err(fault), _) | (_, Err(fault)) => {
                    failed = Some(fault);
                    continue;
                }
            };
            let bent = norm(&here.iter().zip(before.iter().zip(&behind)).map(|(r, (a, b))| a - r + (b - r)).collect::<Vec<f64>>());
            let way: Vec<f64> = before.iter().zip(&behind).map(|(a, b)| b - a).collect();
            let share = bent / norm(&way);
            // the error of the difference is about the square of this share of it, and what a turn is not known to
            let error = share * share + ROUNDING / norm(&way);
            if best.as_ref().is_none_or(|(least, _)| error < *least) {
                best = Some((error, way.iter().map(|d| d / (2.0 * step)).collect()));
            }
            if share.is_nan() || share <= STRAIGHT {
                break;
            }
        }
        best.map(|(_, slope)| slope).ok_or_else(|| failed.unwrap_or_else(not_the_turn))
    }

    /// y with its start on the conditions that hold at its parameter: the rate of a crank that turns by w t is another one at another w.
    fn seated(&mut self, y: &[f64]) -> Result<Vec<f64>, Fault> {
        let n = self.shooting.scales().len();
        let mut y = y.to_vec();
        if !self.shooting.is_tied() {
            return Ok(y);
        }
        let (machine, _) = self.family.at(y[y.len() - 1])?;
        let assembled = machine.start()?;
        self.shooting.seat(machine, &mut y[..n], &assembled)?;
        Ok(y)
    }

    /// How the start keeps to the conditions where the parameter changes: change of the unknowns over its range, SI.
    fn by_parameter(&mut self, y: &[f64]) -> Result<Vec<f64>, Fault> {
        let (last, step) = (y.len() - 1, STEP * self.range);
        if !self.shooting.is_tied() {
            return Ok((0..=last).map(|i| if i == last { self.range } else { 0.0 }).collect());
        }
        let mut ends = [y.to_vec(), y.to_vec()];
        for (end, step) in ends.iter_mut().zip([-step, step]) {
            end[last] += step;
            *end = self.seated(end)?;
        }
        let [before, behind] = ends;
        let slope = |i: usize| (behind[i] - before[i]) / (2.0 * STEP);
        Ok((0..=last).map(|i| if i == last { self.range } else { slope(i) }).collect())
    }
}

/// Share of the rates at which what has to come back is at rest in a motion.
const AT_REST: f64 = 1e-12;

/// The angle by which a motion is counted that is nothing but steady turning: all else is at rest, and how long a turn takes follows from the angle alone.
fn steady_turn(turned: &Turned<'_>, varied: &Varied, (y, coordinates): (&[f64], usize)) -> Option<Turn> {
    let n = varied.rates.len();
    let angle =
        (0..coordinates).filter(|i| !varied.states.contains(i)).max_by(|a, b| varied.rates[*a].abs().total_cmp(&varied.rates[*b].abs()))?;
    let speed = varied.rates[angle];
    let still = varied.states.iter().all(|&i| varied.rates[i].abs() <= AT_REST * speed.abs());
    (still && speed != 0.0).then(|| Turn {
        angle,
        rate: coordinates + angle,
        speed,
        period: y[n],
        whole: speed * y[n] - turned.gap()[angle],
    })
}

/// A coordinate is held against the others of its unit in its motion by this share: what is less is their rounding.
const BESIDE: f64 = 1e-3;
/// The same against its size on the branch: half of the digits that a turn is known to.
const LEAST: f64 = 1e-7;

/// Sizes of the unknowns in one motion, SI.
fn own_sizes(machine: &crate::Machine, extremes: &[[f64; 2]], scales: &[f64]) -> Vec<f64> {
    let (n, states) = (extremes.len(), machine.states());
    let reach = |i: usize| extremes[i][0].abs().max(extremes[i][1].abs());
    let alike = |i: usize| (0..n).filter(|j| states[*j].unit == states[i].unit).map(reach).fold(0.0, f64::max);
    let place = |i: usize| reach(i).max(BESIDE * alike(i)).max(LEAST * scales[i]);
    let of = |i: usize| match i {
        _ if i < n => place(i),
        _ if i < 2 * n => place(i - n) * scales[i] / scales[i - n],
        _ => scales[i],
    };
    (0..scales.len()).map(of).map(|size| if size.is_finite() { size } else { 1.0 }).collect()
}

/// Whether a motion with these multipliers is stable; none where they do not decide it.
fn decided(multipliers: &[Multiplier]) -> Option<bool> {
    match verdict(multipliers) {
        Verdict::Stable => Some(true),
        Verdict::Unstable => Some(false),
        Verdict::Limit => None,
    }
}

/// The rates at the start, of length one in scales: across them the start is fixed.
fn phase_row(varied: &Varied, scales: &[f64]) -> Vec<f64> {
    let size = varied.rates.iter().zip(scales).map(|(r, s)| (r / s) * (r / s)).sum::<f64>().sqrt();
    varied.rates.iter().map(|r| r / size).collect()
}

/// What the states that return are missed by, in scales, at most.
fn missed_in(turned: &Turned<'_>, states: &[usize], scales: &[f64]) -> f64 {
    let gap = turned.gap();
    states.iter().map(|&i| gap[i].abs() / scales[i]).fold(0.0, f64::max)
}

/// R in scales.
fn missed(turned: &Turned<'_>, y: &[f64], near: &Local) -> Vec<f64> {
    let all = turned.gap();
    let mut gap: Vec<f64> = near.states.iter().map(|&i| all[i] / near.scales[i]).collect();
    gap.extend(near.phase_at(y));
    gap
}

/// Free directions of the start, then the period of a free motion and the parameter alone, as changes of all unknowns in scales.
pub(super) fn directions(varied: &Varied, scales: &[f64], unknowns: usize) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for (column, &j) in varied.basis.iter().zip(&varied.states) {
        let mut whole: Vec<f64> = column.iter().zip(scales).map(|(c, s)| c * scales[j] / s).collect();
        whole.resize(unknowns, 0.0);
        basis.push(whole);
    }
    for i in varied.rates.len()..unknowns {
        basis.push((0..unknowns).map(|l| if l == i { 1.0 } else { 0.0 }).collect());
    }
    basis
}

/// Rows by the states that return and the phase of a free motion, columns by the directions, in scales.
fn jacobian(varied: &Varied, local: &Local, by_parameter: &[f64]) -> Vec<f64> {
    let (k, columns, n) = (varied.states.len(), local.basis.len(), varied.rates.len());
    let mut jacobian = vec![0.0; (columns - 1) * columns];
    for (i, &state) in local.states.iter().enumerate() {
        for j in 0..k {
            jacobian[i * columns + j] = varied.matrix[i * k + j] - if i == j { 1.0 } else { 0.0 };
        }
        if local.phase.is_some() {
            jacobian[i * columns + k] = varied.rates[state] * local.scales[n] / local.scales[state];
        }
    }
    if let Some(turn) = &local.turning {
        let (period, rate) = (local.scales[n], turn.rate);
        let size = local.scales[turn.angle];
        for (j, column) in local.basis.iter().take(k).enumerate() {
            jacobian[k * columns + j] = turn.period * column[rate] * local.scales[rate] / size;
        }
        jacobian[k * columns + k] = turn.speed * period / size;
    } else if let Some((rates, _)) = &local.phase {
        for (j, column) in local.basis.iter().take(k).enumerate() {
            jacobian[k * columns + j] = rates.iter().zip(column).zip(&local.scales).map(|((r, b), s)| r / s * b).sum();
        }
    }
    by_parameter.iter().enumerate().for_each(|(i, value)| jacobian[(i + 1) * columns - 1] = *value);
    jacobian
}

impl Zeros for Orbits<'_, '_> {
    fn local(&mut self, y: &[f64]) -> Result<Local, Fault> {
        let y = &self.seated(y)?[..];
        let mut turned = self.turn(y)?;
        self.work[1] += 1;
        let (last, n) = (y.len() - 1, self.shooting.scales().len());
        let (machine, _) = self.family.at(y[last])?;
        if self.shooting.is_driven() && !turned.laws_repeat(machine)? {
            return Err(not_the_period(turned.period()));
        }
        if !turned.turns_are_unfelt(machine)? {
            return Err(not_the_turn());
        }
        let coordinates = crate::System::n_coordinates(machine);
        self.shooting.widen(machine, &turned);
        let with_parameter = self.by_parameter(y)?;
        // what follows the parameter has its way over the range as its scale
        self.shooting.raise(&with_parameter);
        turned.rescale(self.shooting.scales());
        let (machine, _) = self.family.at(y[last])?;
        let varied = self.shooting.vary(machine, &mut turned)?;
        let slowest = turned.slowest(machine)?;
        let edge = turned.edge(machine)?;
        let scales = self.scales();
        let missed_by = missed_in(&turned, &varied.states, &scales);
        if varied.off > SAME + missed_by {
            return Err(if turned.holds_on() { not_the_turn() } else { passes_the_start() });
        }
        let mut basis = directions(&varied, &scales, y.len());
        basis.pop();
        basis.push(with_parameter.iter().zip(&scales).map(|(change, scale)| change / scale).collect());
        let turning = if last > n { steady_turn(&turned, &varied, (y, coordinates)) } else { None };
        let phase = (last > n).then(|| (phase_row(&varied, &scales), y[..n].to_vec()));
        let multipliers = varied.multipliers.clone();
        let facts = Facts {
            period: turned.period(),
            extremes: turned.extremes(coordinates),
            stable: multipliers.as_deref().and_then(decided),
            multipliers,
            switches: turned.switches(),
            slowest,
            edge,
            liouville: varied.liouville,
            ..Facts::default()
        };
        let (machine, _) = self.family.at(y[last])?;
        let own = own_sizes(machine, &facts.extremes, &scales);
        let rows = vec![1.0; varied.states.len()];
        let states = varied.states.clone();
        let mut local = Local { scales, rows, own, basis, states, phase, turning, facts, ..Local::default() };
        let here = missed(&turned, y, &local);
        let by_parameter = self.slope(y, &here, &local)?;
        local.jacobian = jacobian(&varied, &local, &by_parameter);
        local.residual = here;
        Ok(local)
    }

    fn residual(&mut self, y: &[f64], near: &Local) -> Result<Vec<f64>, Fault> {
        self.off(y, near)
    }

    fn moved(&mut self, y: &[f64], change: &[f64], near: &Local) -> Result<Vec<f64>, Fault> {
        let mut y = y.to_vec();
        for (c, column) in change.iter().zip(&near.basis) {
            y.iter_mut().zip(column).zip(&near.scales).for_each(|((y, b), s)| *y += c * b * s);
        }
        let n = self.shooting.scales().len();
        let (machine, _) = self.family.at(y[y.len() - 1])?;
        let assembled = machine.start()?;
        self.shooting.seat(machine, &mut y[..n], &assembled)?;
        Ok(y)
    }

    fn switches(&mut self, y: &[f64]) -> Option<Vec<usize>> {
        self.turn(y).ok().map(|turned| turned.switches())
    }

    fn hold(&mut self, second: f64) {
        self.family.hold(second);
    }

    fn repeat(&mut self, periods: usize) {
        self.returns = periods.max(1);
    }

    fn sort(&self) -> Sort {
        Sort::Multipliers
    }

    fn outgrown(&self, place: &Place) -> bool {
        let numbers = place.local.facts.multipliers.iter().flatten();
        self.by == By::Either && numbers.map(Multiplier::abs).fold(0.0, f64::max) > SENSITIVE
    }

    fn finer(&mut self, place: &Place) -> Option<(Box<dyn Finer + '_>, Place)> {
        if self.by == By::Turns {
            return None;
        }
        let Orbits { family, shooting, returns, range, work, .. } = self;
        let ground = Ground { family: &mut **family, shooting, returns: *returns, range: *range, work };
        let (finer, start) = Collocation::beside(ground, place).ok().flatten()?;
        Some((Box::new(finer), start))
    }

    fn stay(&mut self) {
        self.by = By::Turns;
    }

    fn turns(&self) -> [usize; 2] {
        self.work
    }
}
