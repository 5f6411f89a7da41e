//! Periodic motions by collocation on a mesh, where a whole turn forgets its start or magnifies it beyond all digits: unknowns are the states at all ends of the intervals.
//!
//! ```text
//! G_j(x_j; T, p) - x_(j+1) = 0,  j = 0 ... N - 1,   x_N = x_0 + whole turns       G_j: an interval of a mesh (`mesh.rs`), its inner points eliminated
//! ```
//!
//! No disturbance grows by more than an interval lets it, however large the multipliers are. Each point is held against the series: the motion from each x_j comes to x_(j+1) (`defect`), and
//! the multipliers are those of the product of what these parts do to small changes (`algebra::product`). The mesh is laid anew every few points.
//!
//! *Source*: E. J. Doedel, H. B. Keller, J. P. Kernévez, Int. J. Bifurcation and Chaos 1 (1991) 745-772; T. F. Fairgrieve, A. D. Jepson, SIAM J. Numer. Anal. 28 (1991) 1446-1462.

use super::corrector;
use super::ground::{Ground, not_the_period, not_the_turn};
use super::mesh::{self, Gauss, Interval, Passed};
use super::zeros::{Facts, Finer, Local, Place, Sort, Zeros};
use crate::studies::periodic::{Multiplier, Passage, name_shift, named};
use crate::studies::stability::{Verdict, verdict};
use crate::{Fault, Mode, System};
use algebra::product::{self, Factor};
use words::{Message, Text};

/// Step of the parameter for derivatives, as a share of its range: half of the digits of an interval.
const STEP: f64 = 1e-7;
/// Most unknowns: their equations are solved as one dense system.
const LARGEST: usize = 900;
/// A defect above this asks for a new mesh: points are refused from a hundred times of it on.
const ROUGH: f64 = 1e-11;

/// Motions on a mesh.
pub(super) struct Collocation<'a, 'o> {
    orbits: Ground<'a, 'o>,
    rule: Gauss,
    /// Ends of the intervals as shares of the period.
    mesh: Vec<f64>,
    /// What states gain in a period: whole turns.
    gain: Vec<f64>,
    /// Switch positions, the same all along.
    modes: Vec<Mode>,
    /// Sizes of the states.
    scales: Vec<f64>,
    /// Rates at the points of each interval, where they were found last.
    rates: Vec<Vec<f64>>,
}

impl<'a, 'o> Collocation<'a, 'o> {
    /// On the mesh of a turn that shooting has found; none where connections or translations bind states, something switches, or too many intervals were needed.
    ///
    /// *Errors*: those of the motion.
    pub(super) fn beside(mut orbits: Ground<'a, 'o>, place: &Place) -> Result<Option<(Self, Place)>, Fault> {
        let scales = orbits.shooting.scales().to_vec();
        let n = scales.len();
        if place.local.states.len() != n || !place.local.facts.switches.is_empty() {
            return Ok(None);
        }
        let period = orbits.period(&place.y)?;
        let (machine, _) = orbits.family.at(place.parameter())?;
        let (steps, gain) = orbits.shooting.laid(machine, &place.y[..n], period)?;
        let modes = steps.first().map(|step| step.modes.clone()).unwrap_or_default();
        let mesh = mesh::mesh(machine, &steps, &scales)?;
        if (mesh.len() - 1) * n > LARGEST {
            return Ok(None);
        }
        let mut unknowns = Vec::with_capacity(mesh.len() * n + 2);
        for share in &mesh[..mesh.len() - 1] {
            let step = steps.iter().find(|step| step.end().high >= share * period).or(steps.last());
            let Some(step) = step else { return Ok(None) };
            let mut x = vec![0.0; n];
            step.state_at(share * period, &mut x);
            unknowns.extend(x);
        }
        unknowns[..n].copy_from_slice(&place.y[..n]);
        unknowns.extend(&place.y[n..]);
        let rates = vec![Vec::new(); mesh.len() - 1];
        let mut found = Collocation { orbits, rule: Gauss::new(), mesh, gain, modes, scales, rates };
        let direction = found.longer(&place.tangent);
        let start = corrector::reached(&mut found, unknowns, &direction)?;
        Ok(start.map(|start| (found, start)))
    }

    /// Changes of the start, the period and the parameter as changes of all unknowns.
    fn longer(&self, short: &[f64]) -> Vec<f64> {
        let n = self.scales.len();
        let mut long = short[..n].to_vec();
        long.resize((self.mesh.len() - 1) * n, 0.0);
        long.extend(&short[n..]);
        long
    }

    fn period(&mut self, y: &[f64]) -> Result<f64, Fault> {
        self.orbits.period(y)
    }

    /// The ends of all intervals.
    fn passed(&mut self, y: &[f64]) -> Result<Vec<Passed>, Fault> {
        let (n, period) = (self.scales.len(), self.period(y)?);
        let (machine, _) = self.orbits.family.at(y[y.len() - 1])?;
        let mut list = Vec::with_capacity(self.mesh.len() - 1);
        for (j, ends) in self.mesh.windows(2).enumerate() {
            let mut interval = Interval {
                machine: &mut *machine,
                rule: &self.rule,
                modes: &self.modes,
                scales: &self.scales,
                start: ends[0] * period,
                length: (ends[1] - ends[0]) * period,
            };
            let x = &y[j * n..(j + 1) * n];
            let mut found = interval.pass(x, &mut self.rates[j])?;
            if found.is_none() {
                // from the rates at its start
                self.rates[j].clear();
                found = interval.pass(x, &mut self.rates[j])?;
            }
            let Some(found) = found else {
                self.rates[j].clear();
                return Err(unsettled());
            };
            list.push(found);
        }
        Ok(list)
    }

    /// R in scales.
    fn missed(&self, passed: &[Passed], y: &[f64], near: &Local) -> Vec<f64> {
        let (n, count) = (self.scales.len(), passed.len());
        let target = |j: usize, i: usize| if j + 1 == count { y[i] + self.gain[i] } else { y[(j + 1) * n + i] };
        let row = |e: usize| (passed[e / n].end[e % n] - target(e / n, e % n)) / self.scales[e % n];
        (0..n * count).map(row).chain(near.phase_at(y)).collect()
    }

    /// Sizes of all unknowns: a motion counts by its mean square, however many intervals there are.
    fn sizes(&self, period: Option<f64>) -> Vec<f64> {
        let count = self.mesh.len() - 1;
        let root = (count as f64).sqrt();
        let states = (0..count).flat_map(|_| self.scales.iter().map(|s| s * root));
        states.chain(period).chain([self.orbits.range]).collect()
    }

    /// Rows by the ends of the intervals and the phase of a free motion, columns by the unknowns, in scales.
    fn jacobian(&mut self, (passed, y): (&[Passed], &[f64]), local: &Local, by_parameter: &[f64]) -> Result<Vec<f64>, Fault> {
        let (n, count, columns) = (self.scales.len(), passed.len(), y.len());
        let (period, root) = (self.period(y)?, (count as f64).sqrt());
        let free = local.phase.is_some();
        let mut jacobian = vec![0.0; (columns - 1) * columns];
        let (machine, _) = self.orbits.family.at(y[columns - 1])?;
        for (j, (ends, passed)) in self.mesh.windows(2).zip(passed).enumerate() {
            let share = ends[1] - ends[0];
            let interval = Interval {
                machine: &mut *machine,
                rule: &self.rule,
                modes: &self.modes,
                scales: &self.scales,
                start: ends[0] * period,
                length: share * period,
            };
            let change = interval.change(passed, &self.rates[j], share).ok_or_else(unsettled)?;
            let next = (j + 1) % count;
            for i in 0..n {
                let row = &mut jacobian[(j * n + i) * columns..(j * n + i + 1) * columns];
                (0..n).for_each(|c| row[j * n + c] += change.by_start[i * n + c] * root * self.scales[c] / self.scales[i]);
                row[next * n + i] -= root;
                if free {
                    row[count * n] = change.by_period[i] * local.scales[count * n] / self.scales[i];
                }
            }
        }
        if let Some((rates, _)) = &local.phase {
            let row = &mut jacobian[count * n * columns..];
            (0..n).for_each(|i| row[i] = rates[i] / local.scales[i]);
        }
        by_parameter.iter().enumerate().for_each(|(i, value)| jacobian[(i + 1) * columns - 1] = *value);
        Ok(jacobian)
    }

    /// The parts of the motion by the series.
    fn parts(&mut self, y: &[f64]) -> Result<Vec<Passage>, Fault> {
        let (n, period) = (self.scales.len(), self.period(y)?);
        let (machine, _) = self.orbits.family.at(y[y.len() - 1])?;
        let one = |(j, ends): (usize, &[f64])| {
            let part = self.orbits.shooting.passage(machine, &y[j * n..(j + 1) * n], [ends[0] * period, ends[1] * period])?;
            part.ok_or_else(switching)
        };
        self.mesh.windows(2).enumerate().map(one).collect()
    }

    fn facts(&mut self, y: &[f64]) -> Result<Facts, Fault> {
        let (n, count, period) = (self.scales.len(), self.mesh.len() - 1, self.period(y)?);
        let parts = self.parts(y)?;
        let target = |j: usize, i: usize| if j + 1 == count { y[i] + self.gain[i] } else { y[(j + 1) * n + i] };
        let off =
            |(j, part): (usize, &Passage)| (0..n).map(|i| ((part.end()[i] - target(j, i)) / self.scales[i]).abs()).fold(0.0, f64::max);
        let defect = parts.iter().enumerate().map(off).fold(0.0, f64::max);
        let (machine, _) = self.orbits.family.at(y[y.len() - 1])?;
        if self.orbits.shooting.is_driven() && !self.orbits.shooting.laws_repeat(machine, &parts, period)? {
            return Err(not_the_period(period));
        }
        if !self.orbits.shooting.turns_are_unfelt(machine, (&parts, period), &self.gain)? {
            return Err(not_the_turn());
        }
        let coordinates = machine.n_coordinates();
        let mut extremes = vec![[f64::INFINITY, f64::NEG_INFINITY]; coordinates];
        let (mut factors, mut liouville) = (Vec::with_capacity(count), 0.0);
        for (j, part) in parts.iter().enumerate() {
            extremes.iter_mut().zip(part.extremes(coordinates)).for_each(|(all, own)| *all = [all[0].min(own[0]), all[1].max(own[1])]);
            let carried = self.orbits.shooting.carried(machine, part)?;
            liouville += carried.liouville;
            factors.push(Factor { matrix: carried.matrix, doubt: carried.doubt.max(carried.liouville).max(off((j, part))) });
        }
        let found = product::eigenvalues(n, &factors)?;
        let mut multipliers: Vec<Multiplier> = found.iter().map(named).collect();
        if !self.orbits.shooting.is_driven() {
            name_shift(&mut multipliers);
        }
        let stable = match verdict(&multipliers) {
            Verdict::Stable => Some(true),
            Verdict::Unstable => Some(false),
            Verdict::Limit => None,
        };
        Ok(Facts {
            period,
            extremes,
            multipliers: Some(multipliers),
            stable,
            liouville,
            defect,
            intervals: Some(count),
            ..Facts::default()
        })
    }
}

impl Zeros for Collocation<'_, '_> {
    fn local(&mut self, y: &[f64]) -> Result<Local, Fault> {
        self.orbits.work[1] += 1;
        let (n, last) = (self.scales.len(), y.len() - 1);
        let driven = self.orbits.shooting.is_driven();
        let (machine, _) = self.orbits.family.at(y[last])?;
        let rates = mesh::rates(machine, (0.0, &y[..n]), &self.modes)?;
        let scales = self.sizes((!driven).then(|| self.orbits.shooting.regime().1));
        let phase = (!driven).then(|| {
            let size = rates.iter().zip(&scales).map(|(r, s)| (r / s) * (r / s)).sum::<f64>().sqrt();
            (rates.iter().map(|r| r / size).collect::<Vec<f64>>(), y[..n].to_vec())
        });
        let basis = (0..=last).map(|j| (0..=last).map(|i| if i == j { 1.0 } else { 0.0 }).collect()).collect();
        let facts = self.facts(y)?;
        let mut local = Local { scales, basis, states: (0..n).collect(), phase, facts, ..Local::default() };
        let mut there = y.to_vec();
        there[last] += STEP * self.orbits.range;
        let ahead = self.residual(&there, &local)?;
        let passed = self.passed(y)?;
        let here = self.missed(&passed, y, &local);
        let by_parameter: Vec<f64> = here.iter().zip(&ahead).map(|(here, there)| (there - here) / STEP).collect();
        local.jacobian = self.jacobian((&passed, y), &local, &by_parameter)?;
        local.residual = here;
        Ok(local)
    }

    fn residual(&mut self, y: &[f64], near: &Local) -> Result<Vec<f64>, Fault> {
        self.orbits.work[0] += 1;
        let passed = self.passed(y)?;
        Ok(self.missed(&passed, y, near))
    }

    fn moved(&mut self, y: &[f64], change: &[f64], near: &Local) -> Result<Vec<f64>, Fault> {
        Ok(y.iter().zip(change).zip(&near.scales).map(|((y, c), s)| y + c * s).collect())
    }

    fn switches(&mut self, _: &[f64]) -> Option<Vec<usize>> {
        None
    }

    fn hold(&mut self, second: f64) {
        self.orbits.family.hold(second);
    }

    fn sort(&self) -> Sort {
        Sort::Multipliers
    }

    fn outgrown(&self, place: &Place) -> bool {
        place.local.facts.defect > ROUGH
    }

    fn turns(&self) -> [usize; 2] {
        *self.orbits.work
    }
}

impl Finer for Collocation<'_, '_> {
    fn remesh(&mut self, place: &Place) -> Result<Option<Place>, Fault> {
        let (n, y) = (self.scales.len(), &place.y);
        let period = self.period(y)?;
        let parts = self.parts(y)?;
        let steps: Vec<_> = parts.iter().flat_map(|part| part.steps().iter().cloned()).collect();
        let (machine, _) = self.orbits.family.at(place.parameter())?;
        let mesh = mesh::mesh(machine, &steps, &self.scales)?;
        if (mesh.len() - 1) * n > LARGEST {
            return Ok(None);
        }
        let mut unknowns = y[..n].to_vec();
        for share in &mesh[1..mesh.len() - 1] {
            let part = self.mesh.partition_point(|end| end <= share).clamp(1, parts.len()) - 1;
            let own = parts[part].steps();
            let Some(step) = own.iter().find(|step| step.end().high >= share * period).or(own.last()) else { return Ok(None) };
            let mut x = vec![0.0; n];
            step.state_at(share * period, &mut x);
            unknowns.extend(x);
        }
        let count = self.mesh.len() - 1;
        unknowns.extend(&y[count * n..]);
        let short = self.shortened(place.clone()).tangent;
        (self.rates, self.mesh) = (vec![Vec::new(); mesh.len() - 1], mesh);
        let direction = self.longer(&short);
        corrector::reached(self, unknowns, &direction)
    }

    fn shortened(&self, place: Place) -> Place {
        let (n, count) = (self.scales.len(), self.mesh.len() - 1);
        let short = |long: &[f64]| -> Vec<f64> { long[..n].iter().chain(&long[count * n..]).copied().collect() };
        let scales = self.scales.iter().chain(&place.local.scales[count * n..]).copied().collect();
        let local = Local { scales, states: place.local.states, phase: place.local.phase, facts: place.local.facts, ..Local::default() };
        Place { y: short(&place.y), tangent: short(&place.tangent), local, signs: place.signs }
    }

    fn zeros(&mut self) -> &mut dyn Zeros {
        self
    }
}

/// An interval has no polynomial nearby.
fn unsettled() -> Fault {
    Fault::new(Message {
        code: "S166",
        what: Text::new("collocation finds no motion nearby", "коллокация не находит движения поблизости"),
        why: Text::new(
            "the rates at the points of an interval do not settle: the motion leaves the domain of a formula or moves too quickly there",
            "скорости в узлах отрезка не устанавливаются: движение выходит из области определения формулы или там слишком быстро",
        ),
        help: Text::new("take a narrower range of the parameter", "сузьте промежуток параметра"),
    })
}

/// Something switches.
fn switching() -> Fault {
    Fault::new(Message {
        code: "S166",
        what: Text::new(
            "a motion that is too sensitive for shooting switches there, and collocation follows smooth motions only",
            "слишком чувствительное для стрельбы движение там переключается, а коллокация прослеживает только гладкие движения",
        ),
        why: Text::new(
            "a contact, a dry friction or a change of formula lies on the way",
            "на пути встречается контакт, сухое трение или переключение формулы",
        ),
        help: Text::new(
            "smooth the switching formula, for example tanh(v/v0) for sign(v)",
            "сгладьте переключение, например tanh(v/v0) вместо sign(v)",
        ),
    })
}
