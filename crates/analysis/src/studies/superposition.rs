//! The steady motion under all harmonics together, over one period.
//!
//! Harmonics up to K are summed; of a waveform, whose series has no end, the rest follows from the load's antiderivatives I₂, I₃, I₄ without
//! their first K harmonics, since beyond all natural frequencies, with s = iν,
//!
//! ```text
//! (M s² + B s + C)⁻¹ = M⁻¹/s² - M⁻¹ B M⁻¹/s³ + (M⁻¹ B M⁻¹ B M⁻¹ - M⁻¹ C M⁻¹)/s⁴ + O(s⁻⁵)
//! ```
//!
//! Accelerations are those of the equations of motion. The audit is independent of the decomposition: the change of momentum between any
//! two nodes is the impulse of the equations' own forces, evaluated over time.

mod ranges;
mod turn;

use algebra::elementary;
use std::f64::consts::{PI, TAU};

use crate::Fault;
use crate::linear::{Graded, Matrices};
use crate::studies::free_motion::settled;
use crate::studies::impedance::solve;
use crate::studies::modes::Complex;
use crate::studies::response::{Excitation, Forced, Source};
use crate::waveform::Panels;
use algebra::double::Double;
use algebra::lu::Lu;
use turn::Turn;

/// The motion of one output over a period, its static part included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The static part: the value about which it oscillates.
    pub mean: f64,
    /// Largest value and its instant in the period, s.
    pub max: (f64, f64),
    /// Least value and its instant.
    pub min: (f64, f64),
    /// Largest distance from the mean and its instant.
    pub largest: (f64, f64),
}

/// The superposed motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Superposed {
    /// ω.
    pub omega: f64,
    /// Its period, s.
    pub period: f64,
    /// One for each output; infinite where one of the harmonics resounds without damping.
    pub outputs: Vec<Range>,
    /// Residual of the equations of motion, see the module; NaN where some motion is infinite.
    pub residual: f64,
}

/// How many harmonics are summed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Care {
    /// For curves.
    Curve,
    /// For numbers.
    Number,
}

/// Largest whole multiple of the common frequency.
const MOST: f64 = 1000.0;

/// The whole multiples of one frequency that the orders are, and that frequency in ω; none when there is no such frequency.
pub fn common(orders: &[f64]) -> Option<(f64, Vec<usize>)> {
    let least = orders.iter().copied().fold(f64::INFINITY, f64::min);
    for parts in 1..=64 {
        let base = least / f64::from(parts);
        // orders are quotients of frequencies with twelve digits
        let whole = |o: &f64| (o / base - (o / base).round()).abs() <= 1e-10 * (o / base);
        if orders.iter().all(whole) {
            let list: Vec<f64> = orders.iter().map(|o| (o / base).round()).collect();
            return list.iter().all(|k| *k <= MOST).then(|| (base, list.iter().map(|k| *k as usize).collect()));
        }
    }
    None
}

/// The superposed motion at ω; none when the frequencies have no common period, or the load takes any frequency.
///
/// *Errors*: formulas without a value at this frequency.
pub fn superpose(forced: &mut Forced, omega: f64, care: Care) -> Result<Option<Superposed>, Fault> {
    if !matches!(forced.source, Source::OfEquations | Source::Given { .. }) || omega <= 0.0 {
        return Ok(None);
    }
    let matrices = forced.matrices(omega)?;
    if !matrices.drift.is_empty() {
        // the series' rest is that of equations without conditions on rates
        return Ok(None);
    }
    let excitation = forced.excitation(&matrices)?;
    let mut orders: Vec<f64> = forced.components().iter().map(|c| c.order).collect();
    let count = orders.len();
    // a waveform repeats at its own rate, which may be none of its harmonics
    orders.extend(forced.components().iter().flat_map(|c| &c.harmonics).map(|h| excitation.shaped[h.0].1.abs() / omega));
    let Some((base, mut multiples)) = common(&orders) else { return Ok(None) };
    multiples.truncate(count);
    let run = Run::new(forced, matrices, excitation, (base * omega, multiples), care)?;
    run.superposed(omega).map(Some)
}

/// One period cut into panels.
struct Run<'f, 'm> {
    forced: &'f Forced<'m>,
    /// In the motions that the connections allow: q = Z y.
    m: Matrices,
    z: Option<(Vec<f64>, usize)>,
    /// The same in twice the digits, where weak springs stand beside hard ones.
    exact: Option<Vec<Double>>,
    full: usize,
    excitation: Excitation,
    /// Common frequency, rad/s.
    rate: f64,
    /// Whole multiples of it, by component.
    multiples: Vec<usize>,
    panels: Panels,
    /// Harmonics that are summed.
    k: usize,
    care: Care,
}

/// y, y', y'' by coordinate, then node; and which coordinates are infinite.
struct Motion {
    places: Vec<Vec<f64>>,
    rates: Vec<Vec<f64>>,
    accelerations: Vec<Vec<f64>>,
    loads: Vec<Vec<f64>>,
    /// Harmonics with an infinite amplitude: the pole of each.
    poles: Vec<(f64, Vec<Vec<Complex>>)>,
    /// Free motions that stand apart, see [`Amplitudes::free`]; not part of `places` and `rates`.
    free: Vec<Free>,
}

/// A free motion: direction, then amplitude and rate by node.
struct Free {
    z: Vec<f64>,
    place: Vec<f64>,
    rate: Vec<f64>,
}

impl Motion {
    /// y with the free motions.
    fn whole_places(&self) -> Vec<Vec<f64>> {
        self.whole(&self.places, |f| &f.place)
    }

    /// y' with the free motions.
    fn whole_rates(&self) -> Vec<Vec<f64>> {
        self.whole(&self.rates, |f| &f.rate)
    }

    fn whole(&self, bound: &[Vec<f64>], part: fn(&Free) -> &Vec<f64>) -> Vec<Vec<f64>> {
        let mut out = bound.to_vec();
        for f in &self.free {
            for (row, z) in out.iter_mut().zip(&f.z) {
                row.iter_mut().zip(part(f)).for_each(|(v, a)| *v += z * a);
            }
        }
        out
    }

    /// The free motion along z.
    fn along(&mut self, z: &[f64]) -> &mut Free {
        let count = self.places.first().map_or(0, Vec::len);
        let known = self.free.iter().position(|f| f.z == z).unwrap_or_else(|| {
            self.free.push(Free { z: z.to_vec(), place: vec![0.0; count], rate: vec![0.0; count] });
            self.free.len() - 1
        });
        &mut self.free[known]
    }
}

/// A basis, row-major, with its number of columns.
type Columns = Option<(Vec<f64>, usize)>;

/// Coordinates in which weak springs do not vanish beside hard ones, as columns over all coordinates.
fn graded(z: Columns, m: Matrices, full: usize) -> (Columns, Option<Vec<Double>>, Matrices) {
    let Some(Graded { basis, matrices, .. }) = m.graded() else { return (z, None, m) };
    let k = m.n;
    let exact: Vec<Double> = match &z {
        None => basis,
        Some((z, _)) => {
            let entry = |i: usize, c: usize| (0..k).fold(Double::default(), |s, j| s.add_times(z[i * k + j], basis[j * k + c]));
            (0..full * k).map(|p| entry(p / k, p % k)).collect()
        }
    };
    (Some((exact.iter().map(|v| v.round()).collect(), k)), Some(exact), matrices)
}

impl<'f, 'm> Run<'f, 'm> {
    fn new(
        forced: &'f Forced<'m>,
        matrices: Matrices,
        excitation: Excitation,
        (rate, multiples): (f64, Vec<usize>),
        care: Care,
    ) -> Result<Run<'f, 'm>, Fault> {
        let full = matrices.n;
        let z = matrices.allowed();
        let m = z.as_ref().map_or_else(|| matrices.clone(), |(z, k)| matrices.reduced(z, *k));
        let (z, exact, m) = graded(z, m, full);
        let top = multiples.iter().copied().max().unwrap_or(1);
        let k = if forced.endless() {
            let (least, most) = if care == Care::Number { (256, 4096) } else { (64, 256) };
            // a waveform of a high order begins there
            ((32.0 * fastest(&m) / rate).ceil().min(1e6) as usize).clamp(least, most).max(64 * multiples.first().copied().unwrap_or(1))
        } else {
            top
        };
        let mut edges = Vec::new();
        for (form, own, _) in excitation.shaped.iter().filter(|s| (s.1.abs() / rate).round() >= 1.0) {
            let times = (own.abs() / rate).round();
            let turn = |e: f64| if *own < 0.0 { TAU - e } else { e };
            for edge in &forced.machine.shapes()[*form].wave.panels.edges {
                edges.extend((0..times as usize).map(|j| (turn(*edge) + TAU * j as f64) / times));
            }
        }
        // a formula has harmonics that its motion has not
        let fine = if care == Care::Number && !forced.bent.is_empty() { 8.0 } else { 1.0 };
        // one turn of the highest order to a panel, whose polynomial then has all digits; the last harmonics of a waveform are small
        let turns = if forced.endless() { 0.5 } else { 1.0 };
        let panels = Panels::new(edges, TAU / (turns * k as f64).max(8.0) / fine);
        Ok(Run { forced, m, z, exact, full, excitation, rate, multiples, panels, k, care })
    }

    fn superposed(&self, omega: f64) -> Result<Superposed, Fault> {
        let motion = self.motion()?;
        let seen = self.forced.machine.observe(&self.forced.observer, &self.forced.place)?;
        let outputs = seen.iter().enumerate().map(|(k, s)| self.range((k, s), &motion)).collect::<Result<Vec<Range>, Fault>>()?;
        Ok(Superposed { omega, period: TAU / self.rate, outputs, residual: self.residual(&motion)? })
    }

    /// F of each multiple of the common frequency, from 1.
    fn series(&self, loads: &[Vec<f64>]) -> Vec<Vec<Complex>> {
        if self.forced.endless() {
            let weights = self.panels.weights();
            let weighted: Vec<Vec<f64>> = loads.iter().map(|f| f.iter().zip(&weights).map(|(v, w)| v * w).collect()).collect();
            let mut turn = Turn::new(&self.panels.nodes());
            let sum = |row: &Vec<f64>, turn: &Turn| -> Complex {
                let add = |t: Complex, (v, (c, s)): (&f64, &Complex)| (t.0 + v * c, t.1 - v * s);
                let total = row.iter().zip(&turn.now).fold((0.0, 0.0), add);
                (total.0 / PI, total.1 / PI)
            };
            let mut list = Vec::with_capacity(self.k);
            for _ in 0..self.k {
                list.push(weighted.iter().map(|row| sum(row, &turn)).collect());
                turn.next();
            }
            return list;
        }
        let mut list = vec![vec![(0.0, 0.0); self.m.n]; self.k];
        for (i, multiple) in self.multiples.iter().enumerate() {
            list[multiple - 1] = self.onto(&self.forced.load(&self.excitation, i, self.full));
        }
        list
    }

    /// Zᵀ F.
    fn onto(&self, load: &[Complex]) -> Vec<Complex> {
        let Some((z, k)) = &self.z else { return load.to_vec() };
        let one = |c: usize| (0..self.full).fold((0.0, 0.0), |s, i| (s.0 + z[i * k + c] * load[i].0, s.1 + z[i * k + c] * load[i].1));
        (0..*k).map(one).collect()
    }

    /// The loads without their means at the nodes, by coordinate.
    fn loads(&self) -> Result<Vec<Vec<f64>>, Fault> {
        let nodes = self.panels.nodes();
        let mut list = vec![vec![0.0; nodes.len()]; self.full];
        for (component, multiple) in self.forced.components().iter().zip(&self.multiples) {
            for i in &component.waves {
                for (row, z) in list.iter_mut().zip(&self.excitation.waves[*i].1).filter(|(_, z)| **z != (0.0, 0.0)) {
                    let wave = |x: &f64| {
                        let (s, c) = elementary::sin_cos(*multiple as f64 * x);
                        z.0 * c - z.1 * s
                    };
                    row.iter_mut().zip(&nodes).for_each(|(v, x)| *v += wave(x));
                }
            }
        }
        let used: Vec<usize> = self.forced.components().iter().flat_map(|c| c.harmonics.iter().map(|h| h.0)).collect();
        for (form, rate, factors) in self.excitation.shaped.iter().enumerate().filter(|(i, _)| used.contains(i)).map(|(_, s)| s) {
            let values = self.waveform(*form, *rate)?;
            for (row, factor) in list.iter_mut().zip(factors).filter(|(_, f)| **f != 0.0) {
                row.iter_mut().zip(&values).for_each(|(v, w)| *v += factor * w);
            }
        }
        let Some((z, k)) = &self.z else { return Ok(list) };
        let node = |c: usize, x: usize| (0..self.full).map(|i| z[i * k + c] * list[i][x]).sum();
        Ok((0..*k).map(|c| (0..nodes.len()).map(|x| node(c, x)).collect()).collect())
    }

    /// A waveform without its mean at the nodes.
    fn waveform(&self, form: usize, rate: f64) -> Result<Vec<f64>, Fault> {
        let times = (rate / self.rate).round();
        let phases: Vec<f64> = self.panels.nodes().iter().map(|x| times * x).collect();
        let mean = self.forced.machine.shapes()[form].wave.mean;
        Ok(self.forced.machine.waveform(form, &phases)?.into_iter().map(|v| v - mean).collect())
    }

    fn motion(&self) -> Result<Motion, Fault> {
        let n = self.m.n;
        let loads = self.loads()?;
        let series = self.series(&loads);
        let nodes = self.panels.nodes();
        let zero = || vec![vec![0.0; nodes.len()]; n];
        let mut motion = Motion { places: zero(), rates: zero(), accelerations: zero(), loads, poles: Vec::new(), free: Vec::new() };
        let largest = series.iter().flatten().fold(0.0_f64, |m, z| m.max(elementary::hypot(z.0, z.1)));
        let mut turn = Turn::new(&nodes);
        for (k, load) in series.iter().enumerate().map(|(i, f)| (i + 1, f)) {
            if k > 1 {
                turn.next();
            }
            // a load of some units of the last place of the largest is none
            if load.iter().all(|z| elementary::hypot(z.0, z.1) <= 1e-15 * largest) {
                continue;
            }
            let nu = k as f64 * self.rate;
            let x = solve(&self.m, nu, load);
            if x.doubt.is_nan() {
                return Err(super::response::hangs_on_rounding(nu));
            }
            if !x.poles.is_empty() {
                motion.poles.push((nu, x.poles.clone()));
            }
            for (z, a) in &x.free {
                let free = motion.along(z);
                turn.add(&mut free.place, *a);
                turn.add(&mut free.rate, (-nu * a.1, nu * a.0));
            }
            for (i, z) in x.regular.iter().enumerate().filter(|(_, z)| **z != (0.0, 0.0)) {
                turn.add(&mut motion.places[i], *z);
                turn.add(&mut motion.rates[i], (-nu * z.1, nu * z.0));
            }
        }
        if self.forced.endless() {
            self.add_rest(&mut motion, &series);
        }
        let lu = Lu::new(&self.m.mass, n);
        for x in 0..nodes.len() {
            let row = |a: &[f64], v: &[Vec<f64>], i: usize| (0..n).map(|j| a[i * n + j] * v[j][x]).sum::<f64>();
            // C Z = 0, and B Z where that is rounding
            let dragged = |i: usize, f: &Free| settled((0..n).map(|j| self.m.damping[i * n + j] * f.z[j])) * f.rate[x];
            let free = |i: usize| motion.free.iter().map(|f| dragged(i, f)).sum::<f64>();
            let force = |i: usize| {
                motion.loads[i][x] - row(&self.m.damping, &motion.rates, i) - free(i) - row(&self.m.stiffness, &motion.places, i)
            };
            let force: Vec<f64> = (0..n).map(force).collect();
            let found = lu.solve(&force).unwrap_or_else(|| vec![f64::NAN; n]);
            found.into_iter().enumerate().for_each(|(i, a)| motion.accelerations[i][x] = a);
        }
        Ok(motion)
    }

    /// What the harmonics above K add.
    fn add_rest(&self, motion: &mut Motion, series: &[Vec<Complex>]) {
        let n = self.m.n;
        let lu = Lu::new(&self.m.mass, n);
        let over = |v: &[Vec<f64>]| -> Vec<Vec<f64>> {
            let count = v.first().map_or(0, Vec::len);
            let mut out = vec![vec![0.0; count]; n];
            for x in 0..count {
                let right: Vec<f64> = v.iter().map(|row| row[x]).collect();
                let found = lu.solve(&right).unwrap_or_else(|| vec![0.0; n]);
                found.into_iter().enumerate().for_each(|(i, a)| out[i][x] = a);
            }
            out
        };
        let times = |a: &[f64], v: &[Vec<f64>]| -> Vec<Vec<f64>> {
            let row = |i: usize, x: usize| (0..n).map(|j| a[i * n + j] * v[j][x]).sum();
            (0..n).map(|i| (0..v[0].len()).map(|x| row(i, x)).collect()).collect()
        };
        // I_1 ... I_4 of M⁻¹ f without the first K harmonics
        let nodes = self.panels.nodes();
        let mut parts: Vec<Vec<Vec<f64>>> = Vec::new();
        let mut power = motion.loads.clone();
        for m in 1..=4 {
            power = power.iter().map(|f| self.panels.antiderivative(f).iter().map(|v| v / self.rate).collect()).collect();
            let mut rest = power.clone();
            let mut turn = Turn::new(&nodes);
            for (k, load) in series.iter().enumerate().map(|(i, f)| (i + 1, f)) {
                let nu = elementary::powi(k as f64 * self.rate, m);
                if k > 1 {
                    turn.next();
                }
                for (row, z) in rest.iter_mut().zip(load).filter(|(_, z)| **z != (0.0, 0.0)) {
                    // F/(iν)^m
                    let turned = match m {
                        1 => (z.1, -z.0),
                        2 => (-z.0, -z.1),
                        3 => (-z.1, z.0),
                        _ => *z,
                    };
                    turn.add(row, (-turned.0 / nu, -turned.1 / nu));
                }
            }
            parts.push(over(&rest));
        }
        let [one, two, three, four] = [&parts[0], &parts[1], &parts[2], &parts[3]];
        let damped = |v: &[Vec<f64>]| over(&times(&self.m.damping, v));
        let last = |v: &[Vec<f64>]| -> Vec<Vec<f64>> {
            let (bb, c) = (damped(&damped(v)), over(&times(&self.m.stiffness, v)));
            bb.iter().zip(&c).map(|(b, c)| b.iter().zip(c).map(|(b, c)| b - c).collect()).collect()
        };
        for (target, [a, b, c]) in
            [(&mut motion.places, [two.clone(), damped(three), last(four)]), (&mut motion.rates, [one.clone(), damped(two), last(three)])]
        {
            for (i, row) in target.iter_mut().enumerate() {
                row.iter_mut().enumerate().for_each(|(x, v)| *v += a[i][x] - b[i][x] + c[i][x]);
            }
        }
    }

    /// max |M y' + B y + C ∫y - ∫f| between nodes, relative to its terms; f from the equations.
    fn residual(&self, motion: &Motion) -> Result<f64, Fault> {
        if !motion.poles.is_empty() {
            return Ok(f64::NAN);
        }
        let n = self.m.n;
        let times: Vec<f64> = self.panels.nodes().iter().map(|x| x / self.rate).collect();
        let forces = self.forced.forces(&self.excitation, &times)?;
        let force = |i: usize| -> Vec<f64> {
            let one = |f: &Vec<f64>| match &self.z {
                None => f[i],
                Some((z, k)) => (0..self.full).map(|j| z[j * k + i] * f[j]).sum(),
            };
            forces.iter().map(one).collect()
        };
        let integral = |v: &[f64]| -> Vec<f64> { self.panels.integral(v).iter().map(|v| v / self.rate).collect() };
        let displaced: Vec<Vec<f64>> = motion.places.iter().map(|y| integral(y)).collect();
        // C Z = 0: what the springs do follows from the rest
        let (moved, rates) = (motion.whole_places(), motion.whole_rates());
        let (mut worst, mut size) = (0.0_f64, 0.0_f64);
        for i in 0..n {
            let mut own = force(i);
            // the static part is no matter of the oscillation
            let mean = own.iter().zip(self.panels.weights()).map(|(v, w)| v * w).sum::<f64>() / TAU;
            own.iter_mut().for_each(|v| *v -= mean);
            let impulse = integral(&own);
            let mut first = None;
            for (x, impulse) in impulse.iter().enumerate() {
                let row = |a: &[f64], v: &[Vec<f64>]| (0..n).map(|j| a[i * n + j] * v[j][x]).sum::<f64>();
                let terms = [row(&self.m.mass, &rates), row(&self.m.damping, &moved), row(&self.m.stiffness, &displaced), -impulse];
                let sum: f64 = terms.iter().sum();
                size = terms.iter().fold(size, |m, t| m.max(t.abs()));
                worst = worst.max((sum - *first.get_or_insert(sum)).abs());
            }
        }
        Ok(if size > 0.0 { worst / size } else { 0.0 })
    }
}

/// A bound of the natural frequencies and of the rates of decay: Gershgorin's discs of M^-½ C M^-½ and M^-½ B M^-½ with the diagonal of M.
fn fastest(m: &Matrices) -> f64 {
    let n = m.n;
    let disc = |a: &[f64], i: usize| (0..n).map(|j| a[i * n + j].abs() / (m.mass[i * n + i] * m.mass[j * n + j]).abs().sqrt()).sum::<f64>();
    (0..n).fold(0.0_f64, |w, i| w.max(disc(&m.stiffness, i).sqrt()).max(disc(&m.damping, i)))
}
