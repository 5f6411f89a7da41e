//! Free oscillations of a machine without losses along their frequency: backbone curves, nonlinear normal modes.
//!
//! ```text
//! R(x, λ, ω) = φ_(2π/ω)(x) - x + λ b,   f(x_0)·(x - x_0),      b' (Φ - 1) = 0, b' f = 0
//! ```
//!
//! Motions without losses form families: neighbours of other energies close as well, so that the equations φ = x depend on one another in the direction of the gradient of the energy.
//! λ b takes that direction up; both ends of a turn have one energy, so that λ is 0 on the family. Where it is not, energy is lost or gained.
//!
//! *Source*: F. J. Muñoz-Almaraz et al., Physica D 181 (2003) 1-38; G. Kerschen, M. Peeters, J. C. Golinval, A. F. Vakakis, Mechanical Systems and Signal Processing 23 (2009) 170-194; M. Peeters et al., ibid. 195-216.

use super::curve::{Curve, End, Of};
use super::diagram::{Diagram, Options, Work, followed};
use super::locate::{Special, What};
use super::orbits::directions;
use super::places::Rests;
use super::switching;
use super::zeros::{Facts, Family, Local, Place, Sort, Zeros};
use crate::fault::codes;
use crate::studies::periodic::{Multiplier, Periodic, Shooting, Turned, of_family};
use crate::{Fault, Machine, System};
use algebra::eigen::general;
use algebra::elementary;
use std::f64::consts::TAU;
use words::{Message, Text};

/// Damping of a small oscillation, as a share of its frequency, that is rounding.
const LOSSLESS: f64 = 1e-9;
/// λ, in scales, that may be what points miss their branch by.
const KEPT: f64 = 1e-8;
/// Step along the gradient of the energy, in scales, for its sign: far above the rounding of the energy of small oscillations.
const UPHILL: f64 = 1e-4;
/// Ends of the range of frequencies without a wish, as shares of that of small oscillations.
const AROUND: [f64; 2] = [0.2, 5.0];

/// A backbone curve.
#[derive(Clone, Debug)]
pub struct Backbone {
    /// Its only branch and those that part from it; the parameter is the frequency, rad/s.
    pub diagram: Diagram,
    /// Frequency of small oscillations, rad/s.
    pub small: f64,
    /// Range of frequencies, rad/s.
    pub range: [f64; 2],
}

/// A machine of which no parameter is changed.
struct Alone<'m>(&'m mut Machine);

impl Family for Alone<'_> {
    fn at(&mut self, _: f64) -> Result<(&mut Machine, Option<f64>), Fault> {
        Ok((self.0, None))
    }

    fn hold(&mut self, _: f64) {}
}

/// The free oscillations that begin at the k-th natural mode (1 is the lowest) of the place of rest near a start, in a range of frequencies that contains its own. From `options` the numbers of points and branches and the interruption are taken.
///
/// *Errors*: S155 under contacts and dry friction, S153 where nothing rests near the start, S158 where the machine loses or gains energy or is driven in time, S159 where it has no such mode or none that can be told from another.
pub fn backbone(
    machine: &mut Machine,
    start: &[f64],
    (mode, range): (usize, Option<[f64; 2]>),
    options: &Options<'_>,
) -> Result<Backbone, Fault> {
    let n = machine.n_coordinates();
    let mut alone = Alone(machine);
    // a load in time gives and takes energy
    let mut rests = Rests::new(&mut alone, start, 0.0, 1.0).map_err(|fault| if fault.code == codes::DRIVEN { lossy() } else { fault })?;
    let y = rests.settled(Rests::unknowns(start, n, 0.0))?;
    let scales = rests.local(&y)?.scales;
    let (x, scales) = (&y[..y.len() - 1], &scales[..y.len() - 1]);
    let (shape, small) = shape(alone.0, (x, scales), mode)?;
    let range = range.unwrap_or(AROUND.map(|share| share * small));
    if !(range[0]..=range[1]).contains(&small) {
        return Err(elsewhere(small));
    }
    let periodic = Periodic { tolerance: 1e-13, ..Periodic::default() }; // turns are differentiated: they are followed more closely than they are shown
    let shooting = Shooting::beside(alone.0, x, (scales, TAU / small), &periodic)?;
    let modes = alone.0.modes_by_value(0.0, x).unwrap_or_default();
    let least = alone.0.energies(0.0, x, &modes).map_or(f64::NAN, |[kinetic, potential]| kinetic + potential);
    let mut free = Free { machine: alone.0, shooting, range: range[1] - range[0], least, work: [0; 2] };
    let options = Options { from: range[0], to: range[1], start: small, second: None, ..*options };
    let origin = origin(x, scales, (small, free.range));
    let direction: Vec<f64> = shape.iter().copied().chain([0.0, 0.0]).collect();
    let first = switching::first_of(&mut free, &origin, &direction).ok_or_else(|| indistinct(mode))?;
    let curve = followed(&mut free, first, &options, &Diagram::default());
    let lost = curve.places.iter().map(|place| lambda(place).abs()).fold(0.0, f64::max);
    if lost > KEPT {
        return Err(lossy());
    }
    let mut diagram = Diagram::default();
    diagram.take(Curve { of: Of::Orbits(0), ends: [Some(End::Rests), curve.ends[1].clone()], ..curve });
    switching::at_branch_points(&mut free, 0, &options, &mut diagram);
    let [turns, variations] = free.turns();
    diagram.work = Work { turns, variations };
    Ok(Backbone { diagram, small, range })
}

/// λ in scales.
fn lambda(place: &Place) -> f64 {
    place.y.len().checked_sub(2).map_or(0.0, |i| place.y[i])
}

/// The place of rest as a point of the curve, with the frequency of small oscillations.
fn origin(x: &[f64], scales: &[f64], (small, range): (f64, f64)) -> Special {
    let n = x.len();
    let local = Local { scales: scales.iter().copied().chain([1.0, range]).collect(), ..Local::default() };
    let y = x.iter().copied().chain([0.0, small]).collect();
    let place = Place { y, tangent: vec![0.0; n + 2], local, ..Place::default() };
    Special { what: What::Hopf, place, within: 0.0 }
}

/// Displacements of the k-th oscillation at a place of rest, of unit length in scales, and its frequency.
fn shape(machine: &mut Machine, (x, scales): (&[f64], &[f64]), mode: usize) -> Result<(Vec<f64>, f64), Fault> {
    let n = x.len();
    let modes = machine.modes_by_value(0.0, x).unwrap_or_default();
    let mut rows = Vec::new();
    machine.slopes(0.0, x, &modes, &mut rows)?;
    let matrix: Vec<f64> = (0..n * n).map(|e| rows[e / n * (n + 1) + e % n] * scales[e % n] / scales[e / n]).collect();
    let found = general(n, &matrix)?;
    let mut list: Vec<usize> = (0..n).filter(|j| found.values[*j].im > 0.0).collect();
    list.sort_by(|a, b| found.values[*a].im.total_cmp(&found.values[*b].im));
    let Some(&j) = mode.checked_sub(1).and_then(|k| list.get(k)) else { return Err(no_mode(mode, list.len())) };
    let value = found.values[j];
    if value.re.abs() > LOSSLESS * value.im {
        return Err(lossy());
    }
    // turned so that the largest displacement is real: all others are as well, and nothing moves at the start
    let vector = found.vector(j);
    let places = machine.n_coordinates();
    let size = |i: usize| elementary::hypot(vector[i].re, vector[i].im);
    let largest = (0..places).max_by(|a, b| size(*a).total_cmp(&size(*b))).unwrap_or(0);
    let (by, length) = (vector[largest], size(largest));
    let mut v: Vec<f64> = vector.iter().map(|z| (z.re * by.re + z.im * by.im) / length).collect();
    v[places..2 * places].fill(0.0);
    let length = v.iter().map(|v| v * v).sum::<f64>().sqrt();
    Ok((v.iter().zip(scales).map(|(v, s)| v / length * s).collect(), value.im))
}

/// Free oscillations of a machine without losses.
struct Free<'m, 'o> {
    machine: &'m mut Machine,
    shooting: Shooting<'o>,
    /// Range of the frequency.
    range: f64,
    /// Energy at rest.
    least: f64,
    work: [usize; 2],
}

impl<'o> Free<'_, 'o> {
    fn turn(&mut self, y: &[f64]) -> Result<Turned<'o>, Fault> {
        let n = self.shooting.scales().len();
        self.work[0] += 1;
        let period = TAU / y[n + 1];
        if !(period > 0.0 && period.is_finite()) {
            return Err(no_mode(1, 0));
        }
        self.shooting.turn(self.machine, &y[..n], period)
    }

    /// b over the free states. It is the gradient of the energy but for its length: its sign is that of the energy along it, for the one before may belong to other
    /// free states, and with its sign that of the determinant which tells branch points.
    fn border(&mut self, square: &[f64], y: &[f64], (states, basis): (&[usize], &[Vec<f64>])) -> Result<Vec<f64>, Fault> {
        let m = states.len() + 1;
        let transposed: Vec<f64> = (0..m * m).map(|e| square[(e % m) * m + e / m]).collect();
        let mut b = switching::null(&transposed, m).ok_or_else(switching::no_direction)?;
        b.truncate(states.len());
        let (n, scales) = (self.shooting.scales().len(), self.shooting.scales().to_vec());
        let mut along = vec![0.0; n];
        for (b, column) in b.iter().zip(basis) {
            along.iter_mut().zip(column).zip(&scales).for_each(|((a, c), s)| *a += b * c * s);
        }
        let mut energy = |by: f64| {
            let x: Vec<f64> = y.iter().zip(&along).map(|(x, a)| x + by * a).collect();
            let modes = self.machine.modes_by_value(0.0, &x).unwrap_or_default();
            self.machine.energies(0.0, &x, &modes).map_or(f64::NAN, |[kinetic, potential]| kinetic + potential)
        };
        if energy(UPHILL) < energy(-UPHILL) {
            b.iter_mut().for_each(|b| *b = -*b);
        }
        Ok(b)
    }
}

/// The miss of a turn with λ b and the phase, in scales; b is the column of λ.
fn missed(turned: &Turned<'_>, y: &[f64], near: &Local) -> Vec<f64> {
    let (all, k, columns) = (turned.gap(), near.states.len(), near.basis.len());
    let lambda = y[y.len() - 2];
    let border = |row: usize| near.jacobian[row * columns + k];
    let row = |(row, i): (usize, &usize)| all[*i] / near.scales[*i] + lambda * border(row);
    let mut gap: Vec<f64> = near.states.iter().enumerate().map(row).collect();
    gap.extend(near.phase_at(y));
    gap
}

impl Zeros for Free<'_, '_> {
    fn local(&mut self, y: &[f64]) -> Result<Local, Fault> {
        let mut turned = self.turn(y)?;
        self.work[1] += 1;
        let n = self.shooting.scales().len();
        let places = self.machine.n_coordinates();
        self.shooting.widen(self.machine, &turned);
        turned.rescale(self.shooting.scales());
        let varied = self.shooting.vary(self.machine, &mut turned)?;
        let scales: Vec<f64> = self.shooting.scales().iter().copied().chain([1.0, self.range]).collect();
        let basis = directions(&varied, &scales, y.len());
        let size = varied.rates.iter().zip(&scales).map(|(r, s)| (r / s) * (r / s)).sum::<f64>().sqrt();
        let phase: Vec<f64> = varied.rates.iter().map(|r| r / size).collect();
        let (k, columns) = (varied.states.len(), basis.len());
        let by_frequency = -turned.period() / y[n + 1] * self.range;
        let along: Vec<f64> = varied.states.iter().map(|i| varied.rates[*i] * by_frequency / scales[*i]).collect();
        let across: Vec<f64> =
            basis.iter().take(k).map(|column| phase.iter().zip(column).zip(&scales).map(|((r, b), s)| r / s * b).sum()).collect();
        let entry = |i: usize, j: usize| varied.matrix[i * k + j] - if i == j { 1.0 } else { 0.0 };
        let m = k + 1;
        let square: Vec<f64> = (0..m * m)
            .map(|e| match (e / m, e % m) {
                (i, j) if i < k && j < k => entry(i, j),
                (i, _) if i < k => along[i],
                (_, j) if j < k => across[j],
                _ => 0.0,
            })
            .collect();
        let border = self.border(&square, &y[..n], (&varied.states, &basis))?;
        let mut jacobian = vec![0.0; m * columns];
        for i in 0..k {
            (0..k).for_each(|j| jacobian[i * columns + j] = entry(i, j));
            (jacobian[i * columns + k], jacobian[i * columns + k + 1]) = (border[i], along[i]);
        }
        (0..k).for_each(|j| jacobian[k * columns + j] = across[j]);
        let flow: Vec<f64> = varied.states.iter().map(|i| varied.rates[*i] / scales[*i]).collect();
        let multipliers = varied.multipliers.map(|known| of_family(&known, &varied.matrix, [&flow, &border])).transpose()?;
        let outside = |m: &Multiplier| !m.trivial && m.abs() - 1.0 > m.error;
        let modes = self.machine.modes_by_value(0.0, &y[..n]).unwrap_or_default();
        let energy = self.machine.energies(0.0, &y[..n], &modes).map(|[kinetic, potential]| kinetic + potential - self.least);
        let slowest = turned.slowest(self.machine)?;
        let edge = turned.edge(self.machine)?;
        let facts = Facts {
            period: turned.period(),
            extremes: turned.extremes(places),
            stable: multipliers.as_deref().map(|list| !list.iter().any(outside)),
            multipliers,
            energy,
            switches: turned.switches(),
            slowest,
            edge,
            liouville: varied.liouville,
            ..Facts::default()
        };
        let phase = Some((phase, y[..n].to_vec()));
        let mut local = Local { scales, jacobian, basis, states: varied.states, phase, facts, ..Local::default() };
        local.residual = missed(&turned, y, &local);
        Ok(local)
    }

    fn residual(&mut self, y: &[f64], near: &Local) -> Result<Vec<f64>, Fault> {
        let turned = self.turn(y)?;
        Ok(missed(&turned, y, near))
    }

    fn moved(&mut self, y: &[f64], change: &[f64], near: &Local) -> Result<Vec<f64>, Fault> {
        let mut y = y.to_vec();
        for (c, column) in change.iter().zip(&near.basis) {
            y.iter_mut().zip(column).zip(&near.scales).for_each(|((y, b), s)| *y += c * b * s);
        }
        let n = self.shooting.scales().len();
        let assembled = self.machine.start()?;
        self.shooting.seat(self.machine, &mut y[..n], &assembled)?;
        Ok(y)
    }

    fn hold(&mut self, _: f64) {}

    fn switches(&mut self, y: &[f64]) -> Option<Vec<usize>> {
        self.turn(y).ok().map(|turned| turned.switches())
    }

    fn sort(&self) -> Sort {
        Sort::Multipliers
    }

    fn turns(&self) -> [usize; 2] {
        self.work
    }
}

/// Energy is lost or gained.
fn lossy() -> Fault {
    Fault::new(Message {
        code: "S158",
        what: Text::new(
            "the machine loses or gains energy, and has no family of free oscillations",
            "энергия машины не сохраняется, и семейства свободных колебаний у неё нет",
        ),
        why: Text::new(
            "damping, drives or follower forces act: a backbone curve is that of the machine without them",
            "действуют сопротивления, приводы или следящие силы, а скелетная кривая относится к машине без них",
        ),
        help: Text::new(
            "set damping and loads to zero for this study: --set b=0 --set F=0",
            "задайте для этого расчёта нулевые сопротивления и нагрузки: --set b=0 --set F=0",
        ),
    })
}

/// There is no mode of that number.
fn no_mode(mode: usize, of: usize) -> Fault {
    Fault::new(Message {
        code: "S159",
        what: Text::new(
            format!("there is no mode {mode}: the machine has {of} at its place of rest"),
            format!("формы {mode} нет: в положении равновесия их {of}"),
        ),
        why: Text::new(
            "a backbone curve begins at an oscillation about a place of rest",
            "скелетная кривая начинается с колебаний около положения равновесия",
        ),
        help: Text::new("take another mode; `strutt modes` lists them", "возьмите другую форму; их перечисляет `strutt modes`"),
    })
}

/// No motion of the mode alone.
fn indistinct(mode: usize) -> Fault {
    Fault::new(Message {
        code: "S159",
        what: Text::new(
            format!("beside rest no oscillation of mode {mode} was found that comes back"),
            format!("около равновесия не найдено возвращающегося колебания по форме {mode}"),
        ),
        why: Text::new(
            "two modes have one frequency, or one is a multiple of the other: small oscillations mix them",
            "две частоты совпадают или кратны друг другу: малые колебания смешивают такие формы",
        ),
        help: Text::new(
            "change a parameter a little so that the frequencies differ",
            "немного измените параметр, чтобы частоты различались",
        ),
    })
}

/// The range does not contain the frequency of small oscillations.
fn elsewhere(small: f64) -> Fault {
    let n = words::digits::number(small);
    Fault::new(Message {
        code: "S159",
        what: Text::new(
            format!("small oscillations have {} rad/s, outside of the range of frequencies", n.en),
            format!("частота малых колебаний {} рад/с лежит вне заданного промежутка частот", n.ru),
        ),
        why: Text::new("a backbone curve begins there", "скелетная кривая начинается с этой частоты"),
        help: Text::new("take a range that contains it, or another mode", "возьмите промежуток, который её содержит, или другую форму"),
    })
}
