//! Periodic motions of the whole equations by harmonic balance: what the amplitudes of small motions are measured with.
//!
//! ```text
//! q = q₀ + Σ_p x_p φ_p(Ωt),   λ = λ₀ + Σ_p y_p φ_p(Ωt),   φ = 1, cos Ωt, sin Ωt, ..., cos HΩt, sin HΩt
//! ⟨φ_p (M(q) q'' - h(q, q') - R(q) λ - F)⟩ = 0,   ⟨φ_p c(q)⟩ = 0
//! ```
//!
//! Means ⟨⟩ are sums over the instants of a period, four for each of the highest harmonic's half turns. Newton's method with the exact derivatives M, B, C, R and J at each instant;
//! the load is raised from zero, so that what is found joins the small motions continuously. Where the way turns back (the jump of a hardening or softening
//! spring) there is no such motion at the full load.
//!
//! Where nothing depends on a coordinate (a shaft that turns freely) its mean is any number, and the mean of its equation, the change of a momentum over a period, says nothing
//! but rounding: the mean is pinned at zero in place of that equation, and what the equation lacks must stay far below the load, else the motion drifts away.
//!
//! *Source*: A. H. Nayfeh, D. T. Mook, Nonlinear Oscillations, 2.3.4; T. M. Cameron, J. H. Griffin, J. Appl. Mech. 56 (1989) 149-154.

use algebra::elementary;
use algebra::qr::{DEPENDENT, Qr, null_space};
use std::f64::consts::TAU;
use std::sync::Arc;
use symbolic::linear::About;

use crate::Fault;
use crate::linear::{LinearMachine, Matrices, Place, Values};
use crate::studies::amplitudes::balanced;
use crate::studies::impedance::solve;
use crate::studies::modes::Complex;
use crate::studies::response::{Forced, magnitude};
use crate::studies::superposition::common;

/// Most unknowns of one balance.
const MOST: usize = 280;
/// Steps of Newton's method, and the correction that ends them, in scaled unknowns.
const STEPS: usize = 10;
// the root of rounding: what a quadratic iteration needs one more step from
const SETTLED: f64 = 1e-7;
/// A first correction beyond this share of the motion may lead to another one.
const FAR: f64 = 0.3;
/// Shares of the load: the first step and the least.
const FIRST: f64 = 0.125;
const LEAST: f64 = 1.0 / 1024.0;
/// Change of the amplitudes with twice the harmonics that is small enough.
const FINE: f64 = 2e-3;

/// A load on the coordinates at a multiple of the common rate: F = c - i s, and the amplitudes of the small motion that it forces.
#[derive(Clone, Debug)]
pub(super) struct Wave {
    /// Multiple of the common rate.
    pub multiple: usize,
    /// F.
    pub load: Vec<Complex>,
    /// X of the small motion.
    pub small: Vec<Complex>,
}

/// Coefficients of φ_p, function after function, n coordinates and m reactions each.
type Series = Vec<f64>;

/// What is found with the whole load.
#[derive(Clone, Debug)]
pub(super) enum Found {
    /// A periodic motion: coefficients of the coordinates, by function φ_p, with the number of harmonics; and the share of the load up to which all amplitudes
    /// are within the asked share of the small motion's.
    Motion { series: Vec<Vec<f64>>, harmonics: usize, good: f64 },
    /// The way from the small motions ends at this share of the load.
    Lost { share: f64, good: f64 },
}

/// Equations to be balanced.
pub(super) struct Balance {
    machine: LinearMachine,
    extra: Values,
    rest: Place,
    /// M q'' - h - R λ at rest: rounding, or what the place lacks of balance.
    force: Vec<f64>,
    n: usize,
    m: usize,
    rate: f64,
    waves: Vec<Wave>,
    /// Which coordinates count, see [`counting`].
    counts: Vec<bool>,
    /// Distance from the small motion's amplitudes, see [`away`], that counts as good.
    good: f64,
    free: Vec<Free>,
    /// Mean force along free motions that the last residuals left out, relative to the load.
    drift: f64,
}

/// A motion that nothing holds at rest: its direction over (q, λ), and the row that repeats others there.
struct Free {
    along: Vec<f64>,
    row: usize,
}

/// Entries of a column below this share of the row are rounding: nothing depends on the mean along it.
const IDLE: f64 = 1e-10;
/// Mean force along a free motion, relative to the load, beyond which it drifts away.
const DRIFTS: f64 = 1e-3;

/// Residuals and their derivatives.
struct System {
    residual: Vec<f64>,
    matrix: Vec<f64>,
}

impl Balance {
    /// The balance of a machine about its place of rest, for its parameters as they are; none where conditions on rates bend, or the balance is too large.
    ///
    /// *Errors*: formulas without a value at rest.
    pub fn new(machine: &LinearMachine, place: &Place, (rate, waves): (f64, Vec<Wave>), good: f64) -> Result<Option<Balance>, Fault> {
        let mut whole = LinearMachine::new(&Arc::clone(machine.equations()), About::Motion)?;
        whole.renumber(machine.numbers())?;
        let linear = whole.linear();
        let (n, m) = (whole.coordinates().len(), linear.multipliers.len());
        if linear.conditions.len() != m || linear.on_rates.contains(&true) {
            return Ok(None);
        }
        let list: Vec<_> = linear.conditions.iter().chain(linear.reach.entries()).copied().collect();
        let extra = whole.prepare(&list)?;
        let rest = Place { rates: vec![0.0; n], accelerations: vec![0.0; n], ..place.clone() };
        let force = whole.at(&rest)?.force;
        let counts = counting(&whole.clone().at(&rest)?, &waves, rate);
        let free = Vec::new();
        let mut balance = Balance { machine: whole, extra, rest, force, n, m, rate, waves, counts, good, free, drift: 0.0 };
        balance.free = balance.free_motions()?;
        Ok((balance.size(balance.least()) <= MOST).then_some(balance))
    }

    /// Motions that nothing holds at rest; none where connections are redundant besides.
    fn free_motions(&mut self) -> Result<Vec<Free>, Fault> {
        let width = self.n + self.m;
        let (_, [tangent, ..]) = self.instant(&vec![0.0; width], &functions(1, 0.0, self.rate))?;
        let (rows, columns) = balanced(&tangent, width);
        let entry = |i: usize, j: usize| tangent[i * width + j] * rows[i] * columns[j];
        let right = null_space(&(0..width * width).map(|p| entry(p / width, p % width)).collect::<Vec<_>>(), width, width);
        let left = null_space(&(0..width * width).map(|p| entry(p % width, p / width)).collect::<Vec<_>>(), width, width);
        let moves = |v: &[f64]| v[..self.n].iter().any(|x| *x != 0.0);
        // the dependent row of each: 1 in it, 0 in those of the others
        let row = |w: &Vec<f64>| (0..self.n).find(|i| w[*i] == 1.0 && left.iter().filter(|other| other[*i] != 0.0).count() == 1);
        let list: Vec<Free> = right
            .iter()
            .filter(|z| moves(z))
            .zip(left.iter().filter(|w| moves(w)))
            .filter_map(|(z, w)| Some(Free { along: z.iter().zip(&columns).map(|(z, c)| z * c).collect(), row: row(w)? }))
            .collect();
        Ok(if list.len() == right.len() && list.len() == left.len() { list } else { Vec::new() })
    }

    /// Puts the mean along free motions at zero, in place of equations that say nothing.
    fn pin(&mut self, system: &mut System, x: &[f64], share: f64) {
        let size = system.residual.len();
        let load = self.waves.iter().flat_map(|w| &w.load).map(|f| magnitude(*f)).fold(0.0, f64::max);
        let mut drift = 0.0_f64;
        for Free { along, row } in &self.free {
            let largest = along.iter().fold(0.0_f64, |m, z| m.max(z.abs()));
            let idle = system.matrix.chunks(size).all(|of| {
                let moved: f64 = of.iter().zip(along).map(|(a, z)| a * z).sum();
                moved.abs() <= IDLE * largest * of.iter().fold(0.0_f64, |m, a| m.max(a.abs()))
            });
            if !idle {
                continue;
            }
            drift = drift.max(system.residual[*row].abs() / (share * load));
            system.residual[*row] = x.iter().zip(along).map(|(x, z)| x * z).sum();
            let equation = &mut system.matrix[row * size..(row + 1) * size];
            equation.fill(0.0);
            equation.iter_mut().zip(along).for_each(|(a, z)| *a = *z);
        }
        self.drift = drift;
    }

    /// Harmonics to begin with: thrice the highest of the load.
    fn least(&self) -> usize {
        3 * self.waves.iter().map(|w| w.multiple).max().unwrap_or(1)
    }

    fn size(&self, harmonics: usize) -> usize {
        (self.n + self.m) * (2 * harmonics + 1)
    }

    /// The motion under the whole load, with as many harmonics as its amplitudes need.
    pub fn solve(&mut self) -> Found {
        let mut harmonics = self.least();
        let (mut x, good) = match self.raised(harmonics) {
            Ok(found) => found,
            Err(lost) => return lost,
        };
        while self.size(2 * harmonics) <= MOST {
            let mut longer = x.clone();
            longer.resize(self.size(2 * harmonics), 0.0);
            let Some((finer, _)) = self.newton(longer, 1.0) else { return Found::Lost { share: 1.0, good } };
            let change = self.apart(&finer, &x);
            (x, harmonics) = (finer, 2 * harmonics);
            if change <= FINE {
                break;
            }
        }
        let (n, width) = (self.n, self.n + self.m);
        Found::Motion { series: x.chunks(width).map(|c| c[..n].to_vec()).collect(), harmonics, good }
    }

    /// Raises the load from zero: the motion at the whole load and the share up to which it is near the small one.
    fn raised(&mut self, harmonics: usize) -> Result<(Series, f64), Found> {
        let small = self.small(harmonics);
        let scaled = |x: &[f64], f: f64| -> Series { x.iter().map(|v| v * f).collect() };
        // two last places of the way
        let (mut s, mut x) = (0.0, vec![0.0; small.len()]);
        let (mut before, mut behind) = (0.0, x.clone());
        let mut good: Option<f64> = None;
        let mut step = FIRST;
        while s < 1.0 {
            let next = (s + step).min(1.0);
            let guess: Series = match s > 0.0 {
                false => scaled(&small, next),
                true => x.iter().zip(&behind).map(|(a, b)| a + (a - b) * (next - s) / (s - before)).collect(),
            };
            let Some(found) = self.newton(guess, next).filter(|(_, first)| *first <= FAR).map(|f| f.0) else {
                step *= 0.5;
                if step < LEAST {
                    return Err(Found::Lost { share: s, good: good.unwrap_or(s) });
                }
                continue;
            };
            if good.is_none() && self.off(&found, next) > self.good {
                good = Some(self.bisected((s, &x), (next, &found)));
            }
            (before, behind) = (s, std::mem::replace(&mut x, found));
            (s, step) = (next, (2.0 * step).min(0.25));
        }
        Ok((x, good.unwrap_or(1.0)))
    }

    /// Where between two shares the motion leaves the small one.
    fn bisected(&mut self, (mut low, x): (f64, &Series), (mut high, y): (f64, &Series)) -> f64 {
        let ends = (low, high);
        for _ in 0..8 {
            let middle = 0.5 * (low + high);
            let part = (middle - ends.0) / (ends.1 - ends.0);
            let guess = x.iter().zip(y).map(|(a, b)| a + part * (b - a)).collect();
            let Some((found, _)) = self.newton(guess, middle) else { break };
            if self.off(&found, middle) <= self.good { low = middle } else { high = middle }
        }
        low
    }

    /// The series of the small motion.
    fn small(&self, harmonics: usize) -> Series {
        let mut x = vec![0.0; self.size(harmonics)];
        let width = self.n + self.m;
        for wave in &self.waves {
            for (i, z) in wave.small.iter().enumerate() {
                x[(2 * wave.multiple - 1) * width + i] = z.0;
                x[2 * wave.multiple * width + i] = -z.1;
            }
        }
        x
    }

    /// Largest share by which an amplitude of a loaded harmonic is off the small motion's at this share of the load.
    fn off(&self, x: &[f64], share: f64) -> f64 {
        let width = self.n + self.m;
        let mut worst = 0.0_f64;
        for wave in &self.waves {
            for i in (0..self.n).filter(|i| self.counts[*i]) {
                let whole = elementary::hypot(x[(2 * wave.multiple - 1) * width + i], x[2 * wave.multiple * width + i]);
                let small = share * elementary::hypot(wave.small[i].0, wave.small[i].1);
                worst = worst.max(away(small, whole));
            }
        }
        worst
    }

    /// How far two series are apart at the loaded harmonics, as a share of the amplitudes.
    fn apart(&self, a: &[f64], b: &[f64]) -> f64 {
        let width = self.n + self.m;
        let mut worst = 0.0_f64;
        for i in 0..self.n {
            let at = |x: &[f64], p: usize| x.get(p * width + i).copied().unwrap_or(0.0);
            let whole = (0..a.len() / width).fold(0.0_f64, |m, p| m.max(at(a, p).abs()));
            let change = |p: usize| (at(a, p) - at(b, p)).abs();
            let change = self.waves.iter().flat_map(|w| [2 * w.multiple - 1, 2 * w.multiple]).map(change).fold(0.0, f64::max);
            if whole > 0.0 {
                worst = worst.max(change / whole);
            }
        }
        worst
    }

    /// Newton's method at a share of the load: the series, and the first correction as a share of the motion. None where it does not settle.
    fn newton(&mut self, mut x: Series, share: f64) -> Option<(Series, f64)> {
        let (size, width) = (x.len(), self.n + self.m);
        let mut first = None;
        for _ in 0..STEPS {
            let system = self.system(&x, share).ok()?;
            let (rows, columns) = balanced(&system.matrix, size);
            let scaled: Vec<f64> = (0..size * size).map(|p| system.matrix[p] * rows[p / size] * columns[p % size]).collect();
            let right: Vec<f64> = system.residual.iter().zip(&rows).map(|(r, f)| -r * f).collect();
            let (step, _) = Qr::alike(&scaled, size, size, DEPENDENT).least_squares(&right);
            x.iter_mut().zip(&step).zip(&columns).for_each(|((x, d), c)| *x += d * c);
            let length = |v: &mut dyn Iterator<Item = f64>| v.fold(0.0_f64, |m, d| m.max(d.abs()));
            let share = |change: f64, whole: f64| if whole > 0.0 { change / whole } else { 0.0 };
            let scaled: Vec<f64> = x.iter().zip(&columns).map(|(x, c)| x / c).collect();
            let change = share(length(&mut step.iter().copied()), length(&mut scaled.iter().copied()));
            if !change.is_finite() {
                return None;
            }
            // reactions are guessed as zero
            let places = |v: &[f64]| length(&mut v.iter().enumerate().filter(|(p, _)| p % width < self.n).map(|(_, d)| *d));
            let start = *first.get_or_insert_with(|| share(places(&step), places(&scaled)));
            if change <= SETTLED {
                return (self.drift <= DRIFTS).then_some((x, start));
            }
        }
        None
    }

    /// Residuals and derivatives at a series.
    fn system(&mut self, x: &[f64], share: f64) -> Result<System, Fault> {
        let (n, m) = (self.n, self.m);
        let width = n + m;
        let count = x.len() / width;
        let size = x.len();
        let instants = 4 * count;
        let mut system = System { residual: vec![0.0; size], matrix: vec![0.0; size * size] };
        for j in 0..instants {
            let phi = functions(count, TAU * j as f64 / instants as f64, self.rate);
            let (local, tangent) = self.instant(x, &phi)?;
            for p in 0..count {
                let weight = if p == 0 { 1.0 } else { 2.0 } * phi[p][0] / instants as f64;
                if weight == 0.0 {
                    continue;
                }
                for (residual, part) in system.residual[p * width..][..width].iter_mut().zip(&local) {
                    *residual += weight * part;
                }
                for (l, [f, df, ddf]) in phi.iter().enumerate() {
                    for r in 0..width {
                        let row = (p * width + r) * size + l * width;
                        let [c, b, a] = &tangent;
                        for s in 0..width {
                            let at = r * width + s;
                            system.matrix[row + s] += weight * (c[at] * f + b[at] * df + a[at] * ddf);
                        }
                    }
                }
            }
        }
        for wave in &self.waves {
            for (i, f) in wave.load.iter().enumerate() {
                system.residual[(2 * wave.multiple - 1) * width + i] -= share * f.0;
                system.residual[2 * wave.multiple * width + i] += share * f.1;
            }
        }
        self.pin(&mut system, x, share);
        Ok(system)
    }

    /// Residuals at an instant without the load, and their derivatives by (q, λ), rates and accelerations.
    fn instant(&mut self, x: &[f64], phi: &[[f64; 3]]) -> Result<(Vec<f64>, [Vec<f64>; 3]), Fault> {
        let (n, m) = (self.n, self.m);
        let width = n + m;
        let sum = |i: usize, level: usize| phi.iter().enumerate().map(|(p, f)| x[p * width + i] * f[level]).sum::<f64>();
        let rest = &self.rest;
        let place = Place {
            q: (0..n).map(|i| rest.q[i] + sum(i, 0)).collect(),
            rates: (0..n).map(|i| sum(i, 1)).collect(),
            accelerations: (0..n).map(|i| sum(i, 2)).collect(),
            multipliers: (0..m).map(|k| rest.multipliers.get(k).copied().unwrap_or(0.0) + sum(n + k, 0)).collect(),
            ..Place::default()
        };
        let found = self.machine.at(&place)?;
        let extra = self.machine.values(&self.extra, &place)?;
        let (conditions, reach) = extra.split_at(m);
        let mut local: Vec<f64> = found.force.iter().zip(&self.force).map(|(f, own)| own - f).collect();
        local.extend(conditions);
        let mut tangent = [vec![0.0; width * width], vec![0.0; width * width], vec![0.0; width * width]];
        for i in 0..n {
            for j in 0..n {
                tangent[0][i * width + j] = found.stiffness[i * n + j];
                tangent[1][i * width + j] = found.damping[i * n + j];
                tangent[2][i * width + j] = found.mass[i * n + j];
            }
            (0..m).for_each(|k| tangent[0][i * width + n + k] = -reach[i * m + k]);
        }
        for k in 0..m {
            (0..n).for_each(|j| tangent[0][(n + k) * width + j] = found.jacobian[k * n + j]);
        }
        Ok((local, tangent))
    }
}

/// φ_p, φ_p' and φ_p'' at the phase Ωt.
pub(super) fn functions(count: usize, phase: f64, rate: f64) -> Vec<[f64; 3]> {
    let one = |p: usize| {
        let k = p.div_ceil(2) as f64;
        let (sin, cos) = elementary::sin_cos(k * phase);
        let nu = k * rate;
        if p % 2 == 1 || p == 0 { [cos, -nu * sin, -nu * nu * cos] } else { [sin, nu * cos, -nu * nu * sin] }
    };
    (0..count).map(one).collect()
}

/// Distance of a small motion's amplitude from that of the whole equations, as a share of the latter, at most 1 where it is zero.
pub(super) fn away(small: f64, whole: f64) -> f64 {
    let larger = small.max(whole);
    if larger == 0.0 { 0.0 } else { (small - whole).abs() / if whole > 0.0 { whole } else { larger } }
}

/// Share of the largest motion, measured by energy, below which a coordinate has no voice.
const VOICE: f64 = 1e-2;

/// Which coordinates count: those whose small motion holds more than a trace of the energy.
pub(super) fn counting(m: &Matrices, waves: &[Wave], rate: f64) -> Vec<bool> {
    let size = |i: usize| {
        let p = i * m.n + i;
        let one = |w: &Wave| {
            let nu = w.multiple as f64 * rate;
            let weight = m.stiffness[p].abs() + nu * nu * m.mass[p].abs() + nu * m.damping[p].abs();
            weight.sqrt() * magnitude(w.small[i])
        };
        waves.iter().map(one).fold(0.0, f64::max)
    };
    let sizes: Vec<f64> = (0..m.n).map(size).collect();
    let largest = sizes.iter().copied().fold(0.0, f64::max);
    sizes.iter().map(|s| *s > VOICE * largest).collect()
}

/// Orders of a load beyond this multiple of the common rate are left to the small motion.
const HIGHEST: usize = 12;
/// So are those below this share of the largest amplitude: what they bend is its square.
pub(super) const TRACE: f64 = 1e-4;

/// The loads at ω with the small motions that they force, by multiples of their common rate; none where there is no such rate or a motion is infinite.
///
/// *Errors*: formulas without a value at this frequency.
pub(super) fn waves(forced: &mut Forced, omega: f64) -> Result<Option<(f64, Vec<Wave>)>, Fault> {
    let matrices = forced.matrices(omega)?;
    let excitation = forced.excitation(&matrices)?;
    let orders: Vec<f64> = forced.components().iter().map(|c| c.order).collect();
    let Some((base, multiples)) = common(&orders) else { return Ok(None) };
    let mut list = Vec::new();
    for (component, multiple) in multiples.into_iter().enumerate().filter(|(_, k)| *k <= HIGHEST) {
        let load = forced.load(&excitation, component, matrices.n);
        let small = solve(&matrices, multiple as f64 * base * omega, &load).coordinates();
        if small.iter().any(|z| !magnitude(*z).is_finite()) {
            return Ok(None);
        }
        list.push(Wave { multiple, load, small });
    }
    let size = |w: &Wave| w.small.iter().map(|z| magnitude(*z)).fold(0.0, f64::max);
    let largest = list.iter().map(size).fold(0.0, f64::max);
    list.retain(|w| size(w) > TRACE * largest);
    Ok((!list.is_empty()).then_some((base * omega, list)))
}
