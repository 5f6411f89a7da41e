//! Multiple shooting, where a whole turn magnifies its start beyond all digits: the starts of many parts of the turn are sought together.
//!
//! ```text
//! φ_j(x_j; T) - x_(j+1) = 0,  j = 0 ... N - 1,   x_N = x_0 + what a turn gains         φ_j the motion over part j
//! ```
//!
//! No part magnifies more than some hundred times, however large the multipliers are; each is followed by the series, switches and all. Far from the motion the step d of Newton's method is shortened
//! until the next one, by the same matrix, is shorter (P. Deuflhard's natural monotonicity). The multipliers are those of the product of the parts (`algebra::product`).
//!
//! *Source*: J. Stoer, R. Bulirsch, Introduction to Numerical Analysis, 7.3.5; P. Deuflhard, Newton Methods for Nonlinear Problems, 3.2, 7.1; U. M. Ascher, R. M. M. Mattheij, R. D. Russell, 4.

use super::found::Found;
use super::fundamental::{self, Blur};
use super::newton::ENOUGH;
use super::options::{Multiplier, Periodic};
use super::orbit::{Orbit, follow};
use super::pieces::way;
use super::search::{Search, prepare};
use super::slopes::slopes;
use super::spectrum::{name_shift, named};
use super::trial::{opened, scales};
use super::variation::{self, Care};
use crate::integrate::taylor::{Flow, Options};
use crate::{Fault, System};
use algebra::elementary;
use algebra::lu::Lu;
use algebra::product::{self, Factor};

/// ln of what the bound of the slopes lets a small change grow by in a part.
const QUICKEST: f64 = 4.0;
/// Growth from which on a part is parted again: what it leaves of sixteen digits is more than a turn needs.
const GROWN: f64 = 1e3;
/// Least number of parts.
const LEAST: usize = 8;
/// Most unknowns: their equations are solved as one dense system.
const LARGEST: usize = 900;
/// Instants of the guess at which the slopes are looked at.
const SAMPLES: usize = 256;
/// The power by which the growth of slopes is told: unlike scales count by its root.
const POWER: usize = 32;
/// Corrections, and how often the parts are laid anew.
const CORRECTIONS: usize = 60;
const ROUNDS: usize = 4;
/// A correction below this, in scales, has arrived.
const ARRIVED: f64 = 1e-14;
/// Share of a correction below which none is tried.
const SHORTEST: f64 = 1e-3;
/// Growth in a turn from which on one start cannot close it: rounding becomes what [`ENOUGH`] allows.
const SENSITIVE: f64 = 1e6;

/// The parts of a turn.
pub(super) struct Parts {
    /// Where each but the first one starts.
    pub(super) joints: Vec<(f64, Vec<f64>)>,
    /// Largest miss of a start, in scales.
    pub(super) miss: f64,
    /// Largest first.
    pub(super) multipliers: Vec<Multiplier>,
    /// By how much Liouville's formula is missed.
    pub(super) liouville: f64,
}

/// Unknowns, and the motion that they begin.
type Known = (Vec<f64>, Vec<Orbit>);

/// The unknowns: the starts of all parts, one behind the other, and the period of a free motion.
struct Sought<'s, 'o, 'p> {
    search: &'s mut Search<'p, 'o>,
    n: usize,
    /// Ends of the parts as shares of the period.
    shares: Vec<f64>,
    /// Whole turns that the states gain in a period.
    gain: Vec<f64>,
    /// Period of the loads.
    period: f64,
}

/// The regime near a start; none where the motion is not of that kind: connections or translations bind it, no corrections settle, or one start is enough for it.
///
/// *Errors*: those of the motion at its start.
pub(super) fn solve<'o, S: System + ?Sized>(
    system: &mut S,
    start: &[f64],
    options: &Periodic<'o>,
) -> Result<Option<(Found<'o>, Parts)>, Fault> {
    let (slow, tried) = opened(system, start, options)?;
    let options = &slow;
    let (mut search, x) = prepare(system, start, tried, options)?;
    let still = search.symmetry.frame.as_ref().is_none_or(|frame| frame.iter().all(|v| *v == 0.0));
    if system.is_tied() || !search.symmetry.shifts.is_empty() || !still {
        return Ok(None);
    }
    let turn = follow(system, &x, &search.sections, options.limit(), &search.flow).ok().flatten();
    let n = x.len();
    let mut guesses = Vec::new();
    if let Some((orbit, which)) = turn {
        search.sections = vec![search.sections[which]];
        guesses.push(orbit);
    }
    if let Some(period) = search.sections.first().and_then(|section| section.time()) {
        // a motion about a place that it would leave
        guesses.push(Orbit { period, ..Orbit::default() });
    }
    for guess in guesses {
        let mut sought = Sought { search: &mut search, n, shares: Vec::new(), gain: vec![0.0; n], period: guess.period };
        if let Some(y) = sought.laid(system, &x, guess)?
            && let Some(found) = sought.settled(system, y)?
        {
            return Ok(Some(found));
        }
    }
    Ok(None)
}

impl<'o> Sought<'_, 'o, '_> {
    fn is_free(&self) -> bool {
        self.search.state.is_some()
    }

    /// Parts between which small changes grow alike, and their starts on a motion that is likely; none where there would be too many.
    fn laid<S: System + ?Sized>(&mut self, system: &mut S, x: &[f64], guess: Orbit) -> Result<Option<Vec<f64>>, Fault> {
        let (n, period) = (self.n, guess.period);
        let carried = self.search.carried.clone();
        let modes = Flow::start(system, 0.0, x, &self.search.flow)?.modes().to_vec();
        let followed = !guess.steps.is_empty();
        let place = |t: f64| if followed { guess.state_at(t) } else { (0..n).map(|i| x[i] + carried[i] * t).collect() };
        let (mut sums, mut rows) = (vec![0.0], Vec::new());
        for k in 0..SAMPLES {
            let t = period * (k as f64 + 0.5) / SAMPLES as f64;
            slopes(system, (t, &place(t)), &modes, &self.search.scales, &mut rows)?;
            let quickest = growth(&rows, &self.search.scales);
            sums.push(sums[k] + (quickest / QUICKEST).max(LEAST as f64 / period) * period / SAMPLES as f64);
        }
        let count = sums[SAMPLES].ceil();
        if count.is_nan() || count * n as f64 > LARGEST as f64 {
            return Ok(None);
        }
        let share = |part: usize| {
            let wanted = sums[SAMPLES] * part as f64 / count;
            let k = sums.partition_point(|sum| *sum < wanted).clamp(1, SAMPLES);
            (k as f64 - (sums[k] - wanted) / (sums[k] - sums[k - 1])) / SAMPLES as f64
        };
        let count = count as usize;
        self.shares = (0..=count).map(|part| if part == count { 1.0 } else { share(part) }).collect();
        let mut y: Vec<f64> = self.shares[..count].iter().flat_map(|share| place(share * period)).collect();
        y[..n].copy_from_slice(x);
        if followed {
            let found = self.search.found(system, guess)?;
            let gap = found.gap();
            self.gain = (0..n).map(|i| found.orbit.last[i] - found.orbit.first[i] - gap[i] - carried[i] * period).collect();
        }
        if self.is_free() {
            y.push(period);
        }
        Ok(Some(y))
    }

    fn period(&self, y: &[f64]) -> f64 {
        if self.is_free() { y[y.len() - 1] } else { self.period }
    }

    /// The motion over all parts.
    fn parts<S: System + ?Sized>(&self, system: &mut S, y: &[f64]) -> Result<Vec<Orbit>, Fault> {
        let (n, period) = (self.n, self.period(y));
        let one = |(j, ends): (usize, &[f64])| {
            let [from, to] = [ends[0] * period, ends[1] * period];
            let flow = Options { span: to - from, ..self.search.flow.clone() };
            let (mut orbit, _) = way(system, (from, &y[j * n..(j + 1) * n]), to, &flow, usize::MAX)?;
            // variations take steps by the whole period
            orbit.period = period;
            Ok(orbit)
        };
        self.shares.windows(2).enumerate().map(one).collect()
    }

    /// Where part j has to end.
    fn target(&self, y: &[f64], j: usize) -> Vec<f64> {
        let (n, count) = (self.n, self.shares.len() - 1);
        let whole = |i: usize| y[i] + self.gain[i] + self.search.carried[i] * self.period(y);
        if j + 1 == count { (0..n).map(whole).collect() } else { y[(j + 1) * n..(j + 2) * n].to_vec() }
    }

    /// By how much the ends miss the starts of the next parts, in scales.
    fn missed(&self, orbits: &[Orbit], y: &[f64]) -> Vec<f64> {
        let scales = &self.search.scales;
        let of = |(j, orbit): (usize, &Orbit)| -> Vec<f64> {
            let target = self.target(y, j);
            (0..self.n).map(|i| (orbit.last[i] - target[i]) / scales[i]).collect()
        };
        // the section is kept by the start
        orbits.iter().enumerate().flat_map(of).chain(self.is_free().then_some(0.0)).collect()
    }

    /// The equations of a correction in scales; none where they are singular.
    fn linear<S: System + ?Sized>(&self, system: &mut S, orbits: &[Orbit], y: &[f64]) -> Result<Option<Lu>, Fault> {
        let (n, count, size, scales) = (self.n, orbits.len(), y.len(), &self.search.scales);
        let mut matrix = vec![0.0; size * size];
        for (j, orbit) in orbits.iter().enumerate() {
            let mut found = fundamental::of_orbit(system, orbit, scales, (Care::Correction, self.search.options.listener))?.matrix;
            found.scale(scales);
            let next = (j + 1) % count;
            for i in 0..n {
                let row = &mut matrix[(j * n + i) * size..(j * n + i + 1) * size];
                (0..n).for_each(|c| row[j * n + c] += found.values[i * n + c]);
                row[next * n + i] -= 1.0;
            }
            if self.is_free() {
                let end = self.shares[j + 1] * self.period(y);
                let rates = fundamental::rates(system, end, &orbit.last, &orbit.modes[1])?;
                let length = (self.shares[j + 1] - self.shares[j]) * self.period(y);
                (0..n).for_each(|i| matrix[(j * n + i + 1) * size - 1] = rates[i] * length / scales[i]);
            }
        }
        if let Some(state) = self.search.state {
            matrix[(size - 1) * size + state] = 1.0;
        }
        Ok(Lu::exact(&matrix, size))
    }

    /// How much the parts magnify, in scales in which their rows and columns are alike.
    fn grown<S: System + ?Sized>(&self, system: &mut S, orbits: &[Orbit]) -> Result<Vec<f64>, Fault> {
        let one = |orbit: &Orbit| {
            let scales = variation::balanced(system, orbit, &self.search.scales);
            let mut found = fundamental::of_orbit(system, orbit, &scales, (Care::Correction, self.search.options.listener))?.matrix;
            found.scale(&scales);
            Ok(found.norm())
        };
        orbits.iter().map(one).collect()
    }

    fn moved(&self, y: &[f64], change: &[f64], share: f64) -> Vec<f64> {
        let scale = |e: usize| if e / self.n + 1 < self.shares.len() { self.search.scales[e % self.n] } else { self.period(y) };
        y.iter().zip(change).enumerate().map(|(e, (y, d))| y + share * d * scale(e)).collect()
    }

    /// The unknowns that the corrections lead to, with the motion there.
    fn corrected<S: System + ?Sized>(&self, system: &mut S, mut y: Vec<f64>) -> Result<Option<Known>, Fault> {
        let largest = |d: &[f64]| d.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
        let Ok(mut orbits) = self.parts(system, &y) else { return Ok(None) };
        for _ in 0..CORRECTIONS {
            if self.search.options.listener.is_interrupted() {
                break;
            }
            let Some(lu) = self.linear(system, &orbits, &y)? else { break };
            let step = |missed: Vec<f64>| lu.solve(&missed.iter().map(|m| -m).collect::<Vec<_>>());
            let Some(change) = step(self.missed(&orbits, &y)) else { break };
            let size = largest(&change);
            if size <= ARRIVED {
                return Ok(Some((y, orbits)));
            }
            // a scale at most
            let mut share = (1.0 / size).min(1.0);
            let nearer = loop {
                if share.is_nan() || share <= SHORTEST {
                    break None;
                }
                let next = self.moved(&y, &change, share);
                // outside of a domain there is no motion
                let tried = self.parts(system, &next).ok().filter(|_| self.period(&next) > 0.0);
                let after = tried.as_ref().and_then(|tried| step(self.missed(tried, &next))).map_or(f64::NAN, |d| largest(&d));
                if after <= (1.0 - 0.25 * share) * size
                    && let Some(tried) = tried
                {
                    break Some((next, tried));
                }
                if size <= ENOUGH {
                    return Ok(Some((y, orbits)));
                }
                share *= 0.5;
            };
            let Some(next) = nearer else { break };
            (y, orbits) = next;
        }
        Ok(None)
    }

    /// Parts each of which magnifies little, with their starts on a motion that is known; none where there would be too many.
    fn finer(&mut self, y: &[f64], orbits: &[Orbit], grown: &[f64]) -> Option<Vec<f64>> {
        let (n, period) = (self.n, self.period(y));
        let (mut shares, mut unknowns) = (Vec::new(), Vec::new());
        for (j, (ends, orbit)) in self.shares.windows(2).zip(orbits).enumerate() {
            let count = (elementary::ln(grown[j].max(1.0)) / QUICKEST).ceil().max(1.0) as usize;
            for k in 0..count {
                let share = ends[0] + (ends[1] - ends[0]) * k as f64 / count as f64;
                unknowns.extend(if k == 0 { y[j * n..(j + 1) * n].to_vec() } else { orbit.state_at(share * period) });
                shares.push(share);
            }
        }
        shares.push(1.0);
        unknowns.extend(self.is_free().then_some(period));
        (unknowns.len() <= LARGEST).then(|| {
            self.shares = shares;
            unknowns
        })
    }

    /// From a guess to the turn; none where nothing settles, or one start would do.
    fn settled<S: System + ?Sized>(&mut self, system: &mut S, mut y: Vec<f64>) -> Result<Option<(Found<'o>, Parts)>, Fault> {
        for _ in 0..ROUNDS {
            let Some((known, orbits)) = self.corrected(system, y)? else { return Ok(None) };
            let grown = self.grown(system, &orbits)?;
            let turn = joined(&orbits, self.period(&known));
            // of this motion, and not of the one that has run away from it
            let scales = scales(system, &turn, None, &self.search.floor);
            let alike = scales.iter().zip(&self.search.scales).all(|(now, before)| (0.5..=2.0).contains(&(now / before)));
            self.search.scales = scales;
            let finest = grown.iter().all(|g| *g <= GROWN);
            if alike && finest {
                return self.told(system, &known, (orbits, turn));
            }
            if finest {
                y = known;
                continue;
            }
            match self.finer(&known, &orbits, &grown) {
                Some(finer) => y = finer,
                None => return Ok(None),
            }
        }
        Ok(None)
    }

    /// The turn with its multipliers.
    fn told<S: System + ?Sized>(
        &self,
        system: &mut S,
        y: &[f64],
        (orbits, turn): (Vec<Orbit>, Orbit),
    ) -> Result<Option<(Found<'o>, Parts)>, Fault> {
        let (n, scales, period) = (self.n, &self.search.scales, self.period(y));
        let missed = self.missed(&orbits, y);
        let miss = missed.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
        let (mut factors, mut liouville) = (Vec::with_capacity(orbits.len()), 0.0);
        for orbit in &orbits {
            let mut found = fundamental::of_orbit(system, orbit, scales, (Care::Multipliers, self.search.options.listener))?;
            if found.blur != Blur::None {
                return Ok(None);
            }
            found.matrix.scale(scales);
            liouville += found.liouville;
            factors.push(Factor { matrix: found.matrix.values, doubt: found.doubt.max(found.liouville).max(miss) });
        }
        let mut multipliers: Vec<Multiplier> = product::eigenvalues(n, &factors)?.iter().map(named).collect();
        if self.is_free() {
            name_shift(&mut multipliers);
        }
        let found = self.search.found(system, turn)?;
        let sensitive = multipliers.iter().any(|m| m.abs() >= SENSITIVE);
        if miss > ENOUGH || !sensitive || !found.turns_are_unfelt(system)? || found.is_driven() && !found.laws_repeat(system, period)? {
            return Ok(None);
        }
        let joint = |(share, x): (&f64, &[f64])| (share * period, x.to_vec());
        let joints = self.shares[1..].iter().zip(y[n..].chunks_exact(n)).take(orbits.len() - 1).map(joint).collect();
        Ok(Some((found, Parts { joints, miss, multipliers, liouville })))
    }
}

/// How quickly a small change may grow, 1/s: the root of Perron of the magnitudes of the slopes, whatever the scales; by the length that a power of them gives a vector.
fn growth(rows: &[f64], scales: &[f64]) -> f64 {
    let n = scales.len();
    let entry = |i: usize, j: usize| (rows[i * (n + 1) + j] * scales[j] / scales[i]).abs();
    let (mut v, mut log) = (vec![1.0; n], 0.0);
    for _ in 0..POWER {
        let next: Vec<f64> = (0..n).map(|i| (0..n).map(|j| entry(i, j) * v[j]).sum()).collect();
        let largest = next.iter().copied().fold(0.0, f64::max);
        if largest == 0.0 {
            return 0.0;
        }
        log += elementary::ln(largest);
        v = next.iter().map(|x| x / largest).collect();
    }
    elementary::exp(log / POWER as f64)
}

/// The turn of these parts.
fn joined(parts: &[Orbit], period: f64) -> Orbit {
    let mut turn = Orbit { period, ..Orbit::default() };
    for part in parts {
        let before = turn.steps.len();
        turn.jumps.extend(part.jumps.iter().cloned().map(|jump| super::orbit::Jump { after: jump.after + before, ..jump }));
        turn.steps.extend(part.steps.iter().cloned());
        turn.last.clone_from(&part.last);
        turn.modes[1].clone_from(&part.modes[1]);
        if before == 0 {
            turn.first.clone_from(&part.first);
            turn.modes[0].clone_from(&part.modes[0]);
        }
    }
    turn
}
