//! A turn that closes: its miss, the correction of its start, and what it does to small changes.

use super::faults::{closure, unsettled};
use super::fundamental::{self, Blur};
use super::listener::Listener;
use super::options::Periodic;
use super::orbit::{Limit, Orbit, Section, follow};
use super::slopes;
use super::spectrum::Turn;
use super::symmetry::{Symmetry, clear_shifts};
use super::turns::{self, Known, Turns};
use super::variation::Care;
use crate::dataset::Audit;
use crate::integrate::taylor::Options;
use crate::{Fault, GuardKind, Mode, Since, System};
use algebra::qr::{DEPENDENT, Qr};
use std::f64::consts::TAU;

/// Share of a column below which Newton's matrix counts as singular: a family of periodic motions.
const SINGULAR: f64 = 1e-9;
/// The same for a forced machine, which is singular only at resonance.
const RESONANT: f64 = 1e-12;
/// Rank of the derivative of a projection, as a share of its rows: differences of states give it with half of the digits, and rows are sums of some.
const IN_ROWS: f64 = 1e-9;
/// The same as a share of its columns, each of which is one difference.
const IN_COLUMNS: f64 = 1e-7;
/// Least share of the largest scale of its unit by which a state is moved to see what connections do.
const APART: f64 = 1e-3;
/// Shares of the period by which a turn may be followed further to end behind a switch.
const BEHIND: [f64; 4] = [0.0, 1e-14, 1e-13, 1e-12];
/// Units of the last place of its terms to which a force is known.
const ROUNDED: f64 = 64.0;
/// Parts of a period that are tried as the least one.
const PARTS: usize = 12;

/// A turn that closes.
#[derive(Clone)]
pub(super) struct Found<'o> {
    pub(super) orbit: Orbit,
    /// Number of coordinates.
    pub(super) coordinates: usize,
    pub(super) scales: Vec<f64>,
    pub(super) symmetry: Symmetry,
    /// Translations of the laws alone, whether the conditions allow them or not.
    pub(super) loose: Symmetry,
    /// States that can be chosen freely; the others follow from the conditions.
    pub(super) free: Vec<usize>,
    /// Change of all states per change of the free ones, column by column.
    pub(super) basis: Vec<Vec<f64>>,
    pub(super) turns: Turns,
    /// Velocities, by state, of the angles that turn with the forcing; zero for a machine that is not driven in time.
    pub(super) carried: Vec<f64>,
    /// Whether the motion is far smaller than in the first turn.
    pub(super) shrunk: bool,
    /// Whether the motion from the given start comes here by itself, without a correction.
    pub(super) own: bool,
    /// Who listens.
    pub(super) listener: Listener<'o>,
}

/// How far a correction may lead.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stride {
    /// Half of the scales at most.
    Careful,
    /// As far as the linear map says.
    Full,
}

/// States that can be chosen freely under the conditions, and the change of all states with each of them.
pub(super) fn tangent<S: System + ?Sized>(
    system: &mut S,
    (place, modes): (Since<'_>, &[Mode]),
    scales: &[f64],
    first: Option<usize>,
    symmetry: &Symmetry,
) -> Result<(Vec<usize>, Vec<Vec<f64>>), Fault> {
    let (t, x) = (place.t, place.x);
    let n = x.len();
    let scales = &beside_others(system, scales)[..];
    let rows = slopes::derivative(x, scales, |beside| {
        let mut beside = beside.to_vec();
        system.rejoin(t, &mut beside, modes, place)?;
        Ok(beside)
    })?;
    // scaled: entry (i, j) is the change of state i in its scale for a change of state j in its scale
    let p: Vec<f64> = (0..n * n).map(|k| rows[k / n][k % n] * scales[k % n] / scales[k / n]).collect();
    let weight = |i: usize| match first {
        Some(state) if state == i => 1e3,
        _ if symmetry.shifts.iter().any(|(pivot, _)| *pivot == i) => 1e2,
        _ => 1.0,
    };
    let transposed: Vec<f64> = (0..n * n).map(|k| p[(k % n) * n + k / n] * weight(k % n)).collect();
    let mut free = Qr::alike(&transposed, n, n, IN_ROWS).independent().to_vec();
    free.sort_unstable();
    let columns = Qr::alike(&p, n, n, IN_COLUMNS).independent().to_vec();
    let r = free.len().min(columns.len());
    free.truncate(r);
    // B = P_columns (P_free,columns)^-1
    let square: Vec<f64> = free.iter().flat_map(|&i| columns[..r].iter().map(move |&j| (i, j))).map(|(i, j)| p[i * n + j]).collect();
    let qr = Qr::alike(&square, r, r, DEPENDENT);
    let mut basis = Vec::with_capacity(r);
    for k in 0..r {
        let unit: Vec<f64> = (0..r).map(|i| if i == k { 1.0 } else { 0.0 }).collect();
        let c = qr.least_squares(&unit).0;
        let size = scales[free[k]];
        let column: Vec<f64> =
            (0..n).map(|i| c.iter().zip(&columns).map(|(c, &j)| c * p[i * n + j]).sum::<f64>() * scales[i] / size).collect();
        basis.push(column);
    }
    Ok((free, basis))
}

/// Scales that are not far below those of the same unit: a coordinate that rests at zero is moved by connections together with others that do not, and a
/// difference over its own rounding would be within what a projection leaves alone.
pub(super) fn beside_others<S: System + ?Sized>(system: &S, scales: &[f64]) -> Vec<f64> {
    let unit = |i: usize| system.states()[i].unit.as_str();
    let largest = |i: usize| (0..scales.len()).filter(|&j| unit(j) == unit(i)).map(|j| scales[j]).fold(0.0, f64::max);
    (0..scales.len()).map(|i| scales[i].max(APART * largest(i))).collect()
}

impl Found<'_> {
    /// The state as it would be at t = 0, had the motion begun earlier.
    pub(super) fn at_time_zero(&self, (t, mut x): (f64, Vec<f64>)) -> Vec<f64> {
        if let Some(frame) = &self.symmetry.frame {
            x.iter_mut().zip(frame).for_each(|(x, v)| *x -= v * t);
        }
        x
    }

    /// Takes out of a change the translations that connections leave free, then what it has off the conditions along others that the laws do not feel.
    fn clear(&self, change: &mut [f64]) {
        clear_shifts(&self.symmetry, change);
        let followers = &self.symmetry.followers;
        if followers.is_empty() || self.free.is_empty() || self.free.len() == change.len() {
            return;
        }
        let (rows, columns) = (self.coordinates, followers.len());
        let off = |v: &[f64]| -> Vec<f64> { (0..rows).map(|i| (v[i] - self.linear(v, i)) / self.scales[i]).collect() };
        let by: Vec<Vec<f64>> = followers.iter().map(|follower| off(follower)).collect();
        let matrix: Vec<f64> = (0..rows * columns).map(|k| by[k % columns][k / columns]).collect();
        let amounts = Qr::alike(&matrix, rows, columns, DEPENDENT).least_squares(&off(change)).0;
        for (amount, follower) in amounts.iter().zip(followers) {
            change.iter_mut().zip(follower).for_each(|(c, f)| *c -= amount * f);
        }
    }

    /// What the free entries of a change say of another one.
    fn linear(&self, change: &[f64], i: usize) -> f64 {
        self.free.iter().zip(&self.basis).map(|(&k, column)| column[i] * change[k]).sum()
    }

    /// last - first less drift and whole turns, the shifts taken out.
    pub(super) fn gap(&self) -> Vec<f64> {
        let mut gap = self.raw_gap();
        self.clear(&mut gap);
        gap
    }

    /// Velocities of what is carried along, in a frame without time or by a forcing.
    fn drift(&self) -> &[f64] {
        self.symmetry.frame.as_deref().unwrap_or(&self.carried)
    }

    fn raw_gap(&self) -> Vec<f64> {
        let mut gap = self.gain();
        self.turns.take_off(&mut gap);
        gap
    }

    /// last - first less drift.
    fn gain(&self) -> Vec<f64> {
        let drift = self.drift();
        let gain = |i: usize| self.orbit.last[i] - self.orbit.first[i];
        (0..self.orbit.first.len()).map(|i| gain(i) - drift[i] * self.orbit.period).collect()
    }

    /// Whether the laws do not feel the whole turns that are taken off what the turn has gained.
    pub(super) fn turns_are_unfelt<S: System + ?Sized>(&self, system: &mut S) -> Result<bool, Fault> {
        self.turns.unfelt(system, &self.orbit, &self.scales, &self.gain())
    }

    /// States that have to come back: free, not the section's, not translations.
    pub(super) fn returning(&self, section: Option<usize>) -> Vec<usize> {
        let pivot = |i: usize| self.symmetry.shifts.iter().any(|(p, _)| *p == i);
        self.free.iter().copied().filter(|&i| Some(i) != section && !pivot(i)).collect()
    }

    /// Largest gap in scales: of what has to come back, and of what follows from it but for whole turns. A wheel in mesh with one that has made a turn may stand elsewhere.
    pub(super) fn miss(&self, gap: &[f64], section: Option<usize>) -> f64 {
        let free = self.returning(section).iter().map(|&i| gap[i].abs() / self.scales[i]).fold(0.0, f64::max);
        free.max(self.off(gap))
    }

    /// The largest part of a gap, in scales, that does not follow from what can be chosen: whole turns of angles in mesh that the laws feel; and, where what holds at the start does not hold at the end
    /// (a friction that sticks, a closed contact), the rates that followed from it.
    pub(super) fn off(&self, gap: &[f64]) -> f64 {
        self.off_in(gap, &self.orbit.modes[1])
    }

    /// The same where the turn has come to other modes.
    fn off_in(&self, gap: &[f64], end: &[Mode]) -> f64 {
        let begin = &self.orbit.modes[0];
        let held = |mode: &Mode| *mode == Mode::Zero;
        let same = begin.iter().map(held).eq(end.iter().map(held));
        let followed = match (self.free.len() < gap.len(), same) {
            (false, _) => 0,
            (true, true) => self.coordinates,
            (true, false) => 2 * self.coordinates,
        };
        (0..followed).map(|i| (gap[i] - self.linear(gap, i)).abs() / self.scales[i]).fold(0.0, f64::max)
    }

    /// The end of the turn, as the start of another one: what the laws do not feel is taken out of its gap along straight lines, and conditions that bend are met again.
    pub(super) fn next_start<S: System + ?Sized>(&self, system: &mut S, gap: &[f64]) -> Vec<f64> {
        let next: Vec<f64> = self.orbit.first.iter().zip(gap).map(|(x, g)| x + g).collect();
        let mut held = next.clone();
        let bends = !self.symmetry.followers.is_empty();
        let closed = self.orbit.closed();
        let met = bends && system.rejoin(0.0, &mut held, &self.orbit.modes[0], self.orbit.since(&closed)).is_ok();
        if met { held } else { next }
    }

    /// Rates at the end in the moving frame.
    pub(super) fn flow_at_end<S: System + ?Sized>(&self, system: &mut S) -> Result<Vec<f64>, Fault> {
        let mut rates = fundamental::rates(system, self.orbit.period, &self.orbit.last, &self.orbit.modes[1])?;
        if let Some(frame) = &self.symmetry.frame {
            rates.iter_mut().zip(frame).for_each(|(r, v)| *r -= v);
        }
        Ok(rates)
    }

    /// Newton's step of the start; none when nothing has to return.
    pub(super) fn correction<S: System + ?Sized>(
        &self,
        system: &mut S,
        gap: &[f64],
        section: Option<usize>,
        reach: Stride,
    ) -> Result<Option<Vec<f64>>, Fault> {
        let returning = self.returning(section);
        if returning.is_empty() {
            return Ok(None);
        }
        let care = match reach {
            Stride::Careful => Care::Correction,
            Stride::Full => Care::Closing,
        };
        let matrix = fundamental::of_orbit(system, &self.orbit, &self.scales, (care, self.listener))?.matrix;
        let rates = self.flow_at_end(system)?;
        let m = returning.len();
        let mut square = vec![0.0; m * m];
        for (column, &j) in returning.iter().enumerate() {
            let k = self.free.iter().position(|&i| i == j).unwrap_or(0);
            let mut change = matrix.apply(&self.basis[k]);
            if let Some(s) = section {
                let later = -change[s] / rates[s];
                change.iter_mut().zip(&rates).for_each(|(c, r)| *c += r * later);
            }
            self.clear(&mut change);
            for (row, &i) in returning.iter().enumerate() {
                let unit = if i == j { 1.0 } else { 0.0 };
                square[row * m + column] = (change[i] - unit) * self.scales[j] / self.scales[i];
            }
        }
        let right: Vec<f64> = returning.iter().map(|&i| -gap[i] / self.scales[i]).collect();
        let singular = if self.symmetry.frame.is_some() { SINGULAR } else { RESONANT };
        let (y, _) = Qr::alike(&square, m, m, singular).least_squares(&right);
        let largest = y.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
        if !largest.is_finite() {
            return Ok(None);
        }
        let damping = if reach == Stride::Careful && largest > 0.5 { 0.5 / largest } else { 1.0 };
        let mut step = vec![0.0; gap.len()];
        for (y, &j) in y.iter().zip(&returning) {
            let k = self.free.iter().position(|&i| i == j).unwrap_or(0);
            step.iter_mut().zip(&self.basis[k]).for_each(|(s, b)| *s += damping * y * self.scales[j] * b);
        }
        Ok(Some(step))
    }

    /// What the turn does to small changes of the states that have to come back, in scales, and what leaves that undefined.
    pub(super) fn turn<S: System + ?Sized>(&self, system: &mut S) -> Result<(Turn, Blur), Fault> {
        let whole = fundamental::of_orbit(system, &self.orbit, &self.scales, (Care::Multipliers, self.listener))?;
        let states = self.returning(None);
        let n = states.len();
        let mut matrix = vec![0.0; n * n];
        for (column, &j) in states.iter().enumerate() {
            let k = self.free.iter().position(|&i| i == j).unwrap_or(0);
            let mut change = whole.matrix.apply(&self.basis[k]);
            self.clear(&mut change);
            // in scales: eigenvalues are the same, rounding is not
            states.iter().enumerate().for_each(|(row, &i)| matrix[row * n + column] = change[i] * self.scales[j] / self.scales[i]);
        }
        let flow = self.flow_at_start(system)?;
        // what connections or translations take out has no part in the matrix, but in the determinant
        let log_determinant = whole.log_determinant.filter(|_| n == self.orbit.first.len());
        let loses_one = whole.singular && n == self.orbit.first.len();
        Ok((Turn { n, matrix, flow, log_determinant, loses_one, liouville: whole.liouville, doubt: whole.doubt }, whole.blur))
    }

    /// Rates at the start of the states that have to come back, in the moving frame and in scales; none when time is not free or nothing moves in it.
    fn flow_at_start<S: System + ?Sized>(&self, system: &mut S) -> Result<Option<Vec<f64>>, Fault> {
        let Some(frame) = &self.symmetry.frame else { return Ok(None) };
        let mut rates = fundamental::rates(system, 0.0, &self.orbit.first, &self.orbit.modes[0])?;
        rates.iter_mut().zip(frame).for_each(|(r, v)| *r -= v);
        self.clear(&mut rates);
        let flow: Vec<f64> = self.returning(None).iter().map(|&i| rates[i] * self.orbit.period / self.scales[i]).collect();
        // rates over a period, relative to what varies: a state that does not move
        Ok(flow.iter().any(|f| f.abs() > 1e-9).then_some(flow))
    }

    /// How many times a period of this turn holds the least one, and how many times the forces repeat in it.
    pub(super) fn repeats<S: System + ?Sized>(&self, system: &mut S) -> Result<(usize, usize), Fault> {
        let (mut motion, mut forces) = (1, 1);
        if self.symmetry.frame.is_some() && self.flow_at_start(system)?.is_none() {
            return Ok((1, 1));
        }
        for k in 2..=PARTS {
            let part = self.orbit.period / k as f64;
            let laws = match &self.symmetry.frame {
                Some(_) => false,
                None => self.laws_repeat(system, part)?,
            };
            if laws {
                forces = k;
            }
            if (laws || self.symmetry.frame.is_some()) && self.comes_back_after(part) {
                motion = k;
            }
        }
        Ok((motion, forces))
    }

    /// Whether the machine is the same after a time: laws and conditions.
    pub(super) fn laws_repeat<S: System + ?Sized>(&self, system: &mut S, time: f64) -> Result<bool, Fault> {
        let known = Known { turns: &self.turns, loose: &self.loose, scales: &self.scales };
        turns::repeats(system, (&self.orbit, self.orbit.period), (time, &self.carried), &known)
    }

    /// Whether the state at that instant is the one at the start, on one side of it where something switches there: rates that follow from what holds at the start (a friction that sticks) are
    /// compared too where it does not hold.
    fn comes_back_after(&self, t: f64) -> bool {
        self.orbit.sides_at(t).any(|step| {
            let mut x = vec![0.0; self.orbit.first.len()];
            step.state_at(t.clamp(step.start.high, step.end().high.max(step.start.high)), &mut x);
            let mut gap: Vec<f64> = x.iter().zip(&self.orbit.first).map(|(a, b)| a - b).collect();
            gap.iter_mut().zip(self.drift()).for_each(|(gap, v)| *gap -= v * t);
            self.turns.take_off(&mut gap);
            self.clear(&mut gap);
            let returning = self.returning(None).iter().map(|&i| gap[i].abs() / self.scales[i]).fold(0.0, f64::max);
            // a regime that closes to 1e-10 comes back so where it repeats earlier
            returning.max(self.off_in(&gap, &step.modes)) < 1e-8
        })
    }

    /// Whether time occurs in the equations.
    pub(super) fn is_driven(&self) -> bool {
        self.symmetry.frame.is_none()
    }

    /// The same motion followed for one period from another of its states.
    pub(super) fn shifted<S: System + ?Sized>(self, system: &mut S, x: &[f64], options: &Periodic<'_>) -> Result<Self, Fault> {
        let flow = Options { tolerance: options.tolerance, ..Options::default() };
        let period = self.orbit.period;
        let mut ended: Option<Orbit> = None;
        // a start on a switch is behind it; so must the end be, which rounding may have put before it
        for late in BEHIND {
            let end = period * (1.0 + late);
            let limit = Limit { time: end, listener: options.listener };
            let Some((orbit, _)) = follow(system, x, &[Section::Time(end)], limit, &flow)? else { break };
            let same = orbit.modes[0] == orbit.modes[1];
            if same || ended.is_none() {
                ended = Some(orbit);
            }
            if same {
                break;
            }
        }
        let orbit = ended.ok_or_else(|| unsettled(1.0, 1))?;
        let closed = orbit.closed();
        let place = (orbit.since(&closed), &orbit.modes[0][..]);
        let (free, basis) = tangent(system, place, &self.scales, None, &self.symmetry)?;
        Ok(Found { orbit, free, basis, ..self })
    }

    /// The same with the directions in which what sticks can be moved: the search keeps its place, but no condition does, and a disturbance leaves it elsewhere.
    pub(super) fn disturbed<S: System + ?Sized>(self, system: &mut S) -> Result<Self, Fault> {
        let mut closed = self.orbit.closed();
        let all = closed.len();
        closed.retain(|guard| !matches!(system.guards()[*guard].kind, GuardKind::Friction { .. }));
        if closed.len() == all {
            return Ok(self);
        }
        let place = (self.orbit.since(&closed), &self.orbit.modes[0][..]);
        let (free, basis) = tangent(system, place, &self.scales, None, &self.symmetry)?;
        Ok(Found { free, basis, ..self })
    }

    /// Largest difference of the start from another state, in scales.
    pub(super) fn away_from(&self, x: &[f64]) -> f64 {
        self.orbit.first.iter().zip(x).zip(&self.scales).map(|((a, b), s)| ((a - b) / s).abs()).fold(0.0, f64::max)
    }

    /// The check that all states and their rates come back.
    pub(super) fn closure<S: System + ?Sized>(&self, system: &mut S) -> Result<Audit, Fault> {
        let mut gap = self.raw_gap();
        // what follows from the free states may have gone on, where the laws do not feel it
        clear_shifts(&self.loose, &mut gap);
        let n = system.n_coordinates();
        let places = gap.iter().zip(&self.scales).map(|(g, s)| (g / s).abs()).fold(0.0, f64::max);
        let first = fundamental::rates(system, 0.0, &self.orbit.first, &self.orbit.modes[0])?;
        let last = fundamental::rates(system, self.orbit.period, &self.orbit.last, &self.orbit.modes[1])?;
        let size = (n..2 * n).map(|i| self.scales[i] / self.orbit.period * TAU + first[i].abs());
        // forces that cancel are known to the rounding of their terms
        let mut slopes = Vec::new();
        let known = slopes::slopes(system, (0.0, &self.orbit.first), &self.orbit.modes[0], &self.scales, &mut slopes).is_ok();
        let width = self.orbit.first.len() + 1;
        let terms = |i: usize| -> f64 { slopes[i * width..].iter().zip(&self.orbit.first).map(|(a, x)| (a * x).abs()).sum() };
        let rounding = |i: usize| if known && terms(i).is_finite() { ROUNDED * f64::EPSILON * terms(i) } else { 0.0 };
        let off = |i: usize| ((last[i] - first[i]).abs() - rounding(i)).max(0.0);
        let rates = (n..2 * n).zip(size).map(|(i, s)| off(i) / s).fold(0.0, f64::max);
        // in modes that differ (a start on a switch) the accelerations need not agree
        let same = self.orbit.modes[0] == self.orbit.modes[1];
        Ok(closure(if same { places.max(rates) } else { places }))
    }
}
