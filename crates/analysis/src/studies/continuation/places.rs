//! Places of rest as zeros: the accelerations of the coordinates (and the rates of auxiliary states) of a machine that does not move.
//!
//! ```text
//! R(q, s, p) = (q'', s')(q, q' = 0, s; p),      J = ∂R/∂(q, s),      stability: roots of x' = A x on what the connections leave free
//! ```

use super::normal;
use super::zeros::{Facts, Family, Local, Sort, Zeros};
use crate::fault::codes;
use crate::studies::periodic::{Multiplier, tangent_of};
use crate::{Fault, GuardKind, Machine, Mode, Since, System};
use algebra::eigen::general;
use algebra::lu::Lu;
use algebra::qr::{DEPENDENT, Qr};
use words::{Message, Text};

/// Step of the parameter for derivatives, as a share of its range: accelerations are known to rounding, and half of their digits is the best of a difference.
const STEP: f64 = 1e-7;
/// A coordinate without a size: a thousandth of its unit.
const SMALL: f64 = 1e-3;
/// Rounding of an entry of A, as a share of the largest of its row: sums of a few terms that may cancel.
const ROUNDING: f64 = 8.0 * f64::EPSILON;
/// Disturbances of A by its rounding: the roots err by twice what moves them most.
const TRIALS: usize = 3;
/// Frequencies that differ by less than this share of the largest root may be one: a double root is known to the root of rounding.
const APART: f64 = 1e-6;
/// Instants at which the laws are asked for time, s: a load may rest at one of them.
const INSTANTS: [f64; 4] = [0.0, 0.37, 1.9, 11.3];
/// Corrections from a start to the first place.
const CORRECTIONS: usize = 60;
/// How far, in scales, another state may be moved by one that stays free: beyond that a better one is taken.
const LEADS: f64 = 10.0;
/// A correction below this, in scales, has arrived.
const ENOUGH: f64 = 1e-13;

/// Places of rest of a machine along its parameter.
pub(super) struct Rests<'f> {
    pub(super) family: &'f mut dyn Family,
    /// Sizes of the states.
    sizes: Vec<f64>,
    /// States that are functions of time alone and that nothing feels: the angle of a frame that turns at a given speed.
    clocks: Vec<usize>,
    /// The largest that each rate has changed by over the sizes, SI.
    felt: Vec<f64>,
    range: f64,
    evaluations: usize,
    /// The states that were free at the last place.
    kept: Vec<usize>,
}

/// Switch positions at a state, by the values of their formulas.
fn modes(machine: &mut Machine, x: &[f64]) -> Vec<Mode> {
    machine.modes_by_value(0.0, x).unwrap_or_else(|| vec![Mode::Positive; machine.guards().len()])
}

/// Rates of the states at rest.
fn rates(machine: &mut Machine, x: &[f64]) -> Result<Vec<f64>, Fault> {
    let modes = modes(machine, x);
    machine.expand(0.0, x, &modes, 1)?;
    Ok((0..x.len()).map(|i| machine.state(i)[1]).collect())
}

impl<'f> Rests<'f> {
    /// The machine near a start, which need not be at rest.
    ///
    /// *Errors*: S154 where time occurs in the equations, S155 where contacts or dry friction hold.
    pub(super) fn new(family: &'f mut dyn Family, start: &[f64], value: f64, range: f64) -> Result<Rests<'f>, Fault> {
        let (machine, _) = family.at(value)?;
        let n = machine.n_coordinates();
        let mut x = start.to_vec();
        x[n..2 * n].fill(0.0);
        if machine.guards().iter().any(|guard| matches!(guard.kind, GuardKind::Friction { .. } | GuardKind::Contact { .. })) {
            return Err(touching());
        }
        let modes = modes(machine, &x);
        let (mut rows, width) = (Vec::new(), x.len() + 1);
        for t in INSTANTS {
            machine.slopes(t, &x, &modes, &mut rows)?;
            if (0..x.len()).any(|i| rows[i * width + x.len()] != 0.0) {
                return Err(driven());
            }
        }
        let clocks = clocks(n, x.len(), &rows)?;
        let size = |(i, x): (usize, &f64)| if machine.states()[i].unit == "rad" { 1.0 } else { x.abs().max(SMALL) };
        let sizes: Vec<f64> = x.iter().enumerate().map(size).collect();
        let mut felt = vec![0.0; x.len()];
        // a place beside the start, too: at the start of a family of places rows may vanish
        let mut random = algebra::random::Random::new(1);
        let beside: Vec<f64> = x
            .iter()
            .zip(&sizes)
            .enumerate()
            .map(|(i, (x, size))| if (n..2 * n).contains(&i) { *x } else { x + ASIDE * size * random.between(-1.0, 1.0) })
            .collect();
        if machine.slopes(0.0, &beside, &modes, &mut rows).is_ok() {
            feel(&mut felt, &rows, &sizes);
        }
        Ok(Rests { family, sizes, clocks, felt, range, evaluations: 0, kept: Vec::new() })
    }

    /// Unknowns at a state.
    pub(super) fn unknowns(x: &[f64], n: usize, value: f64) -> Vec<f64> {
        let mut y: Vec<f64> = x.iter().enumerate().map(|(i, x)| if (n..2 * n).contains(&i) { 0.0 } else { *x }).collect();
        y.push(value);
        y
    }

    /// The place of rest that a start leads to by corrections at most as long as the sizes.
    ///
    /// *Errors*: S153 where they do not settle.
    pub(super) fn settled(&mut self, mut y: Vec<f64>) -> Result<Vec<f64>, Fault> {
        for _ in 0..CORRECTIONS {
            let near = self.local(&y)?;
            let k = near.basis.len();
            let m = k - 1;
            let residual = self.residual(&y, &near)?;
            let square: Vec<f64> = (0..m * m).map(|e| near.jacobian[e / m * k + e % m]).collect();
            let right: Vec<f64> = residual.iter().map(|r| -r).collect();
            // where nothing holds a direction the least of all changes
            let mut change = match algebra::lu::Lu::exact(&square, m).and_then(|lu| lu.solve(&right)) {
                Some(change) => change,
                None => Qr::alike(&square, m, m, DEPENDENT).least_squares(&right).0,
            };
            let largest = change.iter().fold(0.0_f64, |l, c| l.max(c.abs()));
            let share = if largest > 1.0 { 1.0 / largest } else { 1.0 };
            change.iter_mut().for_each(|c| *c *= share);
            change.push(0.0);
            y = self.moved(&y, &change, &near)?;
            if largest.is_nan() {
                break;
            }
            if largest <= ENOUGH {
                let held = square.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
                // a force that no change of place takes away
                if residual.iter().any(|r| r.abs() > ENOUGH.sqrt() * held) {
                    break;
                }
                return if self.is_adrift(&y)? { Err(adrift()) } else { Ok(y) };
            }
        }
        Err(nowhere())
    }

    /// Whether the machine rests just as well a whole scale away, in a direction that nothing holds.
    fn is_adrift(&mut self, y: &[f64]) -> Result<bool, Fault> {
        let near = self.local(y)?;
        let k = near.basis.len();
        let m = k - 1;
        let square: Vec<f64> = (0..m * m).map(|e| near.jacobian[e / m * k + e % m]).collect();
        let largest = square.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
        for mut direction in Qr::alike(&square, m, m, DEPENDENT).null_space() {
            direction.push(0.0);
            let there = self.moved(y, &direction, &near)?;
            if self.residual(&there, &near)?.iter().all(|r| r.abs() <= ENOUGH * largest) {
                return Ok(true);
            }
        }
        Ok(false)
    }
}

/// How far that place lies from the start, in sizes.
const ASIDE: f64 = 0.1;

/// Takes what each rate changes by over the sizes of the states, where it is more than before.
fn feel(felt: &mut [f64], rows: &[f64], sizes: &[f64]) {
    for (felt, row) in felt.iter_mut().zip(rows.chunks(sizes.len() + 1)) {
        let most = row.iter().zip(sizes).fold(0.0_f64, |m, (v, size)| m.max((v * size).abs()));
        *felt = if most.is_finite() { felt.max(most) } else { *felt };
    }
}

/// Share of the largest entry of a row below which a state is not felt: rounding of terms that cancel.
const FELT: f64 = 1e-12;

/// Auxiliary states that run on, whatever the machine does, from the derivatives of the rates of all states.
///
/// *Errors*: S154 where the machine feels one of them.
fn clocks(n: usize, states: usize, rows: &[f64]) -> Result<Vec<usize>, Fault> {
    let width = states + 1;
    let largest = |i: usize| rows[i * width..(i + 1) * width].iter().fold(0.0_f64, |l, v| l.max(v.abs()));
    let list: Vec<usize> = (2 * n..states).filter(|i| largest(*i) == 0.0).collect();
    let felt = |i: usize| (0..states).any(|row| rows[row * width + i].abs() > FELT * largest(row));
    if list.iter().any(|i| felt(*i)) { Err(driven()) } else { Ok(list) }
}

impl Rests<'_> {
    /// y on the conditions that hold at its parameter: the angles of a linkage follow the length of its rod.
    fn seated(&mut self, y: &[f64]) -> Result<Vec<f64>, Fault> {
        let (last, mut y) = (y.len() - 1, y.to_vec());
        let (machine, _) = self.family.at(y[last])?;
        let (n, modes) = (machine.n_coordinates(), modes(machine, &y[..last]));
        let assembled = machine.start()?;
        machine.rejoin(0.0, &mut y[..last], &modes, Since { t: 0.0, x: &assembled, closed: &[] })?;
        y[n..2 * n].fill(0.0);
        Ok(y)
    }

    /// The direction in which the parameter changes and the place keeps to the conditions, as a change of all unknowns in scales.
    fn by_parameter(&mut self, y: &[f64], scales: &[f64]) -> Result<Vec<f64>, Fault> {
        let (last, step) = (y.len() - 1, STEP * self.range);
        let mut ends = [y.to_vec(), y.to_vec()];
        for (end, step) in ends.iter_mut().zip([-step, step]) {
            end[last] += step;
            *end = self.seated(end)?;
        }
        let [before, behind] = ends;
        let slope = |i: usize| (behind[i] - before[i]) / (2.0 * STEP * scales[i]);
        Ok((0..=last).map(|i| if i == last { 1.0 } else { slope(i) }).collect())
    }
}

/// Scales of the states: an angle has the size of a radian, and a rate the scale of its coordinate.
fn scales(machine: &Machine, sizes: &[f64]) -> Vec<f64> {
    let n = machine.n_coordinates();
    let mut scales = sizes.to_vec();
    for i in 0..n {
        if machine.states()[i].unit == "rad" {
            scales[i] = 1.0;
        }
        scales[n + i] = scales[i];
    }
    scales
}

/// Small motions beside a place: what is free, and the derivatives of all rates.
struct Small {
    free: Vec<usize>,
    basis: Vec<Vec<f64>>,
    /// Derivatives of the rates by the states, then by time.
    rows: Vec<f64>,
}

impl Small {
    fn at(machine: &mut Machine, x: &[f64], (scales, clocks): (&[f64], &[usize])) -> Result<Small, Fault> {
        let modes = modes(machine, x);
        let (free, basis) = tangent_of(machine, (0.0, x, &modes), scales)?;
        let own = free.into_iter().zip(basis).filter(|(i, _)| !clocks.contains(i));
        let (free, basis) = own.unzip();
        let mut rows = Vec::new();
        machine.slopes(0.0, x, &modes, &mut rows)?;
        Ok(Small { free, basis, rows })
    }

    /// The same by the states that were free at another place, as long as they lead the others by not much: of states that lead equally (the coordinate and the angle of an upright column)
    /// now this and now that one would be taken, and places side by side could not be compared.
    fn keeping(self, kept: &[usize], scales: &[f64]) -> Small {
        let m = self.free.len();
        if kept.len() != m || kept == self.free {
            return self;
        }
        let entry = |e: usize| self.basis[e % m][kept[e / m]] * scales[self.free[e % m]] / scales[kept[e / m]];
        let Some(lu) = Lu::exact(&(0..m * m).map(entry).collect::<Vec<f64>>(), m) else { return self };
        let mut basis = Vec::with_capacity(m);
        for j in 0..m {
            let unit: Vec<f64> = (0..m).map(|i| if i == j { 1.0 } else { 0.0 }).collect();
            let Some(shares) = lu.solve(&unit).filter(|shares| shares.iter().all(|share| share.abs() <= LEADS)) else { return self };
            let mut whole = vec![0.0; scales.len()];
            for ((share, column), free) in shares.iter().zip(&self.basis).zip(&self.free) {
                let by = share * scales[*free] / scales[kept[j]];
                whole.iter_mut().zip(column).for_each(|(w, c)| *w += by * c);
            }
            basis.push(whole);
        }
        Small { free: kept.to_vec(), basis, rows: self.rows }
    }

    /// Change of the rate of state i by the k-th free direction, SI.
    fn entry(&self, i: usize, k: usize) -> f64 {
        let width = self.basis[k].len() + 1;
        self.basis[k].iter().zip(&self.rows[i * width..]).map(|(b, a)| a * b).sum()
    }

    /// Rates of the free states by the free states, in scales.
    fn matrix(&self, scales: &[f64]) -> Vec<f64> {
        let pairs = self.free.iter().flat_map(|&i| self.free.iter().enumerate().map(move |(k, &j)| (i, k, j)));
        pairs.map(|(i, k, j)| self.entry(i, k) * scales[j] / scales[i]).collect()
    }
}

/// A rate below this, in scales a second, is rounding of a projection.
const STILL: f64 = 1e-9;

/// Whether connections let the machine rest: a condition on rates may ask for motion at the place.
fn may_rest(machine: &mut Machine, x: &[f64], scales: &[f64]) -> Result<bool, Fault> {
    if machine.margin(0.0, x).is_none() {
        return Ok(true);
    }
    let (n, modes, mut there) = (machine.n_coordinates(), modes(machine, x), x.to_vec());
    machine.project(0.0, &mut there, &modes)?;
    Ok((n..2 * n).all(|i| there[i].abs() <= STILL * scales[i]))
}

impl Zeros for Rests<'_> {
    fn local(&mut self, y: &[f64]) -> Result<Local, Fault> {
        let last = y.len() - 1;
        self.evaluations += 1;
        let y = &self.seated(y)?[..];
        let x = &y[..last];
        self.sizes.iter_mut().zip(x).for_each(|(size, x)| *size = size.max(x.abs()));
        let (machine, _) = self.family.at(y[last])?;
        let n = machine.n_coordinates();
        let scales = scales(machine, &self.sizes);
        if !may_rest(machine, x, &scales)? {
            return Err(nowhere());
        }
        let small = Small::at(machine, x, (&scales, &self.clocks))?.keeping(&self.kept, &scales);
        self.kept.clone_from(&small.free);
        feel(&mut self.felt, &small.rows, &scales);
        let multipliers = roots(small.free.len(), &small.matrix(&scales))?;
        let facts = Facts {
            extremes: x[..n].iter().map(|q| [*q, *q]).collect(),
            stable: stable(&multipliers),
            multipliers: Some(multipliers),
            ..Facts::default()
        };
        // of coordinates and auxiliary states; rates stay zero
        let still: Vec<usize> = (0..small.free.len()).filter(|k| !(n..2 * n).contains(&small.free[*k])).collect();
        let states: Vec<usize> = still.iter().map(|k| small.free[*k]).collect();
        let mut basis: Vec<Vec<f64>> = Vec::new();
        for (&k, &j) in still.iter().zip(&states) {
            let mut whole: Vec<f64> = small.basis[k].iter().zip(&scales).map(|(b, s)| b * scales[j] / s).collect();
            whole[n..2 * n].fill(0.0);
            whole.push(0.0);
            basis.push(whole);
        }
        basis.push(self.by_parameter(y, &scales)?);
        let (m, columns) = (states.len(), states.len() + 1);
        let mut jacobian = vec![0.0; m * columns];
        for (r, &i) in states.iter().enumerate() {
            for (c, (&k, &j)) in still.iter().zip(&states).enumerate() {
                jacobian[r * columns + c] = small.entry(if i < n { n + i } else { i }, k) * scales[j] / scales[i];
            }
        }
        let rows = states.iter().map(|&i| self.felt[if i < n { n + i } else { i }] / scales[i]).collect();
        let scales = scales.into_iter().chain([self.range]).collect();
        let mut local =
            Local { scales, jacobian, rows, own: Vec::new(), residual: Vec::new(), basis, states, phase: None, turning: None, facts };
        let here = self.residual(y, &local)?;
        let mut beside = y.to_vec();
        beside[last] += STEP * self.range;
        let there = self.residual(&beside, &local)?;
        for (r, (there, here)) in there.iter().zip(&here).enumerate() {
            local.jacobian[r * columns + m] = (there - here) / STEP;
        }
        local.residual = here;
        Ok(local)
    }

    fn residual(&mut self, y: &[f64], near: &Local) -> Result<Vec<f64>, Fault> {
        let y = self.seated(y)?;
        let last = y.len() - 1;
        let (machine, _) = self.family.at(y[last])?;
        let n = machine.n_coordinates();
        let found = rates(machine, &y[..last])?;
        Ok(near.states.iter().map(|&i| found[if i < n { n + i } else { i }] / near.scales[i]).collect())
    }

    fn moved(&mut self, y: &[f64], change: &[f64], near: &Local) -> Result<Vec<f64>, Fault> {
        let mut y = y.to_vec();
        for (c, column) in change.iter().zip(&near.basis) {
            y.iter_mut().zip(column).zip(&near.scales).for_each(|((y, b), s)| *y += c * b * s);
        }
        self.seated(&y)
    }

    fn switches(&mut self, _: &[f64]) -> Option<Vec<usize>> {
        None
    }

    fn lyapunov(&mut self, y: &[f64]) -> Option<f64> {
        let (last, clocks) = (y.len() - 1, self.clocks.is_empty());
        let (machine, _) = self.family.at(y[last]).ok()?;
        if machine.is_tied() || !clocks {
            return None;
        }
        let (x, scales) = (&y[..last], scales(machine, &self.sizes));
        let modes = modes(machine, x);
        let (mut rows, width) = (Vec::new(), last + 1);
        machine.slopes(0.0, x, &modes, &mut rows).ok()?;
        let a: Vec<f64> = (0..last * last).map(|e| rows[e / last * width + e % last] * scales[e % last] / scales[e / last]).collect();
        normal::lyapunov(last, &a, &mut |z| {
            let there: Vec<f64> = x.iter().zip(z).zip(&scales).map(|((x, z), s)| x + z * s).collect();
            Some(rates(machine, &there).ok()?.iter().zip(&scales).map(|(r, s)| r / s).collect())
        })
    }

    fn hold(&mut self, second: f64) {
        self.family.hold(second);
    }

    fn sort(&self) -> Sort {
        Sort::Roots
    }

    fn turns(&self) -> [usize; 2] {
        [0, self.evaluations]
    }
}

/// Eigenvalues of the linear equations, those that grow most first. Each errs by what the rounding of A moves it by, which is little for a single root and the root of it for a double one.
fn roots(n: usize, matrix: &[f64]) -> Result<Vec<Multiplier>, Fault> {
    let values = general(n, matrix)?.values;
    let largest = values.iter().map(|z| algebra::complex::abs(*z)).fold(0.0, f64::max);
    let mut errors = vec![ROUNDING * largest; n];
    let mut random = algebra::random::Random::new(1);
    for _ in 0..TRIALS {
        let mut disturbed = matrix.to_vec();
        for row in disturbed.chunks_mut(n.max(1)) {
            // a rate is the derivative of its coordinate exactly
            let size = if row.iter().all(|v| *v == 0.0 || *v == 1.0) { 0.0 } else { row.iter().fold(0.0_f64, |l, v| l.max(v.abs())) };
            row.iter_mut().for_each(|v| *v += ROUNDING * size * random.between(-1.0, 1.0));
        }
        let moved = general(n, &disturbed)?.values;
        for (error, value) in errors.iter_mut().zip(&values) {
            let nearest = moved.iter().map(|m| algebra::complex::abs(m - value)).fold(f64::INFINITY, f64::min);
            *error = error.max(2.0 * nearest);
        }
    }
    let root = |(z, error): (&algebra::complex::Complex, &f64)| Multiplier { re: z.re, im: z.im, error: *error, ..Multiplier::default() };
    let mut list: Vec<Multiplier> = values.iter().zip(&errors).map(root).collect();
    list.sort_by(|a, b| b.re.total_cmp(&a.re).then(b.im.total_cmp(&a.im)));
    Ok(list)
}

/// Whether no root grows; none where one of them is zero, or several on the imaginary axis are one. A single one there oscillates for ever, as far as linear
/// equations say.
fn stable(roots: &[Multiplier]) -> Option<bool> {
    let largest = roots.iter().map(Multiplier::abs).fold(0.0, f64::max);
    if roots.iter().any(|m| m.re > m.error) {
        return Some(false);
    }
    let lone = |k: usize, m: &Multiplier| {
        let far = |(i, other): (usize, &Multiplier)| i == k || (other.im - m.im).abs() > APART * largest;
        m.im.abs() > APART * largest && roots.iter().enumerate().all(far)
    };
    roots.iter().enumerate().all(|(k, m)| m.re < -m.error || lone(k, m)).then_some(true)
}

/// Time occurs in the equations.
fn driven() -> Fault {
    Fault::new(Message {
        code: codes::DRIVEN,
        what: Text::new(
            "a machine driven in time has no place of rest to follow",
            "у машины с нагрузками, зависящими от времени, нет положений равновесия",
        ),
        why: Text::new("time occurs in the equations", "время входит в уравнения явно"),
        help: Text::new(
            "follow its periodic motions: give the period, period = \"2*pi/w\"",
            "проследите её периодические движения: задайте период, period = \"2*pi/w\"",
        ),
    })
}

/// The machine rests in a whole family of places.
fn adrift() -> Fault {
    Fault::new(Message {
        code: "S152",
        what: Text::new(
            "the machine rests in a whole family of places, and the branch has no direction among them",
            "машина покоится в целом семействе положений, и ветвь не имеет среди них направления",
        ),
        why: Text::new(
            "nothing holds it in some direction: it can be moved as a whole",
            "в некотором направлении её ничто не удерживает: машину можно сместить как целое",
        ),
        help: Text::new(
            "hold it, or describe it by coordinates relative to one another (y − x), without its motion as a whole",
            "закрепите её или опишите относительными координатами (y − x), без движения как целого",
        ),
    })
}

/// No place of rest near the start.
fn nowhere() -> Fault {
    Fault::new(Message {
        code: "S153",
        what: Text::new(
            "no place of rest is found from the start of the file",
            "от начального положения из файла положение равновесия не находится",
        ),
        why: Text::new(
            "the start is far from rest, or the machine cannot rest at this value of the parameter",
            "начальное положение далеко от равновесия или при этом значении параметра равновесия нет",
        ),
        help: Text::new(
            "begin where the machine rests: take a place that `strutt equilibrium` names as the start of the coordinates",
            "начните с положения равновесия: возьмите за начальные значения координат положение, которое называет `strutt equilibrium`",
        ),
    })
}

/// Contacts and frictions hold a machine in many places.
fn touching() -> Fault {
    Fault::new(Message {
        code: "S155",
        what: Text::new(
            "places of rest that contacts or dry friction hold are not followed",
            "положения равновесия при контактах или сухом трении не прослеживаются",
        ),
        why: Text::new(
            "friction lets a machine rest in whole ranges of places, and a contact may close or open on the way",
            "сухое трение допускает целые области положений равновесия, а контакт по пути может замкнуться или разомкнуться",
        ),
        help: Text::new(
            "repeat the study equilibrium over the parameter (strutt sweep), which follows contacts, or follow periodic motions",
            "повторите расчёт equilibrium по параметру (strutt sweep), он учитывает контакты, или проследите периодические движения",
        ),
    })
}
