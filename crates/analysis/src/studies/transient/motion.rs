//! The motion of a linear system within a phase: by modes where they uncouple it, otherwise by the matrix exponential.
//!
//! M q'' + B q' + C q = f(τ). With symmetric M > 0 and C, and a B that the modes of (C, M) make diagonal (proportional damping), each principal
//! coordinate is an [`Oscillator`] of its own. Otherwise (q, q') and the load, itself the solution of a linear system, are carried by one
//! exponential of the joint matrix: exact in resonance and with multiple roots, since nothing is diagonalised.

use super::form::Form;
use super::load::Load;
use super::oscillator::Oscillator;
use crate::Fault;
use crate::linear::Matrices;
use algebra::complex::Complex;
use algebra::double::Double;
use algebra::eigen::{general, symmetric};
use algebra::expm;
use algebra::lu::Lu;
use algebra::vectors::dot;
use words::{Message, Text};

/// The motion within a phase, τ from its start.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// q = Σ shape_i x_i.
    Modes(Vec<Mode>),
    /// The joint exponential.
    Exponential(Joint),
}

/// A principal coordinate; the shape has the mass 1, with one degree of freedom the displacement 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Displacements of the coordinates for x = 1.
    pub shape: Vec<f64>,
    /// The equation of x.
    pub oscillator: Oscillator,
    /// Share of k by which rounding of the stiffnesses may have changed it.
    pub doubt: f64,
}

/// z' = A z for z = (ω q, q', load).
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    n: usize,
    size: usize,
    /// Scale of q, so that both halves of the state are velocities.
    omega: f64,
    matrix: Vec<f64>,
    start: Vec<f64>,
    /// Shapes whose amplitudes the places q are, where weak springs stand beside hard ones.
    shapes: Option<Vec<Vec<f64>>>,
}

/// A rate λ of a part e^(λ τ).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rate {
    /// Real part, 1/s.
    pub re: f64,
    /// Imaginary part, rad/s.
    pub im: f64,
    /// Share of it that is not known, beside the rounding of the angle.
    pub doubt: f64,
}

impl Motion {
    /// The motion from a state (q, q') at the start of a phase; `start` is that instant in the time of the loads.
    ///
    /// *Errors*: S073 the mass matrix is singular.
    pub fn new(form: &Form, state: &[f64], start: f64) -> Result<Motion, Fault> {
        let loads: Vec<Load> = form.loads.iter().map(|f| f.from(start)).collect();
        if let Some(modes) = principal(form, &loads, state) {
            return Ok(Motion::Modes(modes));
        }
        let joint = Joint::by_shapes(form, &loads, state).or_else(|| Joint::new(form, &loads, state));
        joint.map(Motion::Exponential).ok_or_else(singular)
    }

    /// Rates of the parts e^(λ τ) of the motion.
    pub fn rates(&self) -> Vec<Rate> {
        match self {
            Motion::Modes(modes) => {
                let own = |m: &Mode| m.oscillator.rates().into_iter().map(|(re, im)| Rate { re, im, doubt: m.doubt }).collect::<Vec<_>>();
                modes.iter().flat_map(own).collect()
            }
            Motion::Exponential(joint) => {
                let values = general(joint.size, &joint.matrix).map(|found| found.values).unwrap_or_default();
                let plain = values.iter().map(|z| Rate { re: z.re, im: z.im, doubt: 0.0 });
                // squares of the exponential carry the rounding of its fastest part into all others, whether that one dies away or not
                let fastest = values.iter().map(|z| algebra::elementary::hypot(z.re, z.im)).fold(0.0, f64::max);
                let carried = joint.shapes.is_some().then_some(Rate { re: 0.0, im: fastest, doubt: 0.0 });
                plain.chain(carried).collect()
            }
        }
    }

    /// Whether shapes of weak springs beside hard ones carry it.
    pub(super) fn is_by_shapes(&self) -> bool {
        matches!(self, Motion::Exponential(Joint { shapes: Some(_), .. }))
    }

    /// States (q, q') at each τ.
    pub fn states(&self, taus: &[f64]) -> Vec<Vec<f64>> {
        match self {
            Motion::Modes(modes) => taus.iter().map(|tau| superpose(modes, *tau)).collect(),
            Motion::Exponential(joint) => joint.states(taus),
        }
    }
}

fn superpose(modes: &[Mode], tau: f64) -> Vec<f64> {
    let n = modes.first().map_or(0, |m| m.shape.len());
    let mut state = vec![0.0; 2 * n];
    for mode in modes {
        let [x, v] = mode.oscillator.at(tau);
        for (i, s) in mode.shape.iter().enumerate() {
            state[i] += s * x;
            state[n + i] += s * v;
        }
    }
    state
}

/// Off-diagonal damping below this share of the diagonal is rounding.
const PROPORTIONAL: f64 = 1e-12;

/// The principal coordinates; none when they do not uncouple the system.
fn principal(form: &Form, loads: &[Load], state: &[f64]) -> Option<Vec<Mode>> {
    let n = form.n;
    let symmetric = |a: &[f64]| (0..n).all(|i| (0..i).all(|j| near(a[i * n + j], a[j * n + i], a[i * n + i].abs() + a[j * n + j].abs())));
    if !symmetric(&form.mass) || !symmetric(&form.stiffness) || !symmetric(&form.damping) {
        return None;
    }
    if let ([a], [b], [c]) = (form.mass.as_slice(), form.damping.as_slice(), form.stiffness.as_slice()) {
        return (*a > 0.0).then(|| vec![single([*a, *b, *c], &loads[0], state)]);
    }
    let Shapes { squares: k2, shapes, doubts } = generalized(form)?;
    let times = |a: &[f64], v: &[f64]| -> Vec<f64> { (0..n).map(|i| (0..n).map(|j| a[i * n + j] * v[j]).sum()).collect() };
    let drags: Vec<Vec<f64>> = shapes.iter().map(|s| times(&form.damping, s)).collect();
    let damping: Vec<f64> = shapes.iter().zip(&drags).map(|(s, d)| dot(s, d)).collect();
    for i in 0..n {
        for j in 0..i {
            if dot(&shapes[i], &drags[j]).abs() > PROPORTIONAL * (damping[i].abs() + damping[j].abs()) {
                return None;
            }
        }
    }
    let mode = |(((shape, k2), b), doubt): (((Vec<f64>, f64), f64), f64)| {
        let mut load = Load::default();
        for (f, s) in loads.iter().zip(&shape) {
            load.add(f, *s);
        }
        // x = sᵀ M q, since sᵀ M s = 1
        let weight = times(&form.mass, &shape);
        let (x0, v0) = (dot(&weight, &state[..n]), dot(&weight, &state[n..]));
        Mode { oscillator: Oscillator { n: 0.5 * b, k2, load, x0, v0 }, shape, doubt }
    };
    Some(shapes.into_iter().zip(k2).zip(damping).zip(doubts).map(mode).collect())
}

fn near(a: f64, b: f64, size: f64) -> bool {
    (a - b).abs() <= PROPORTIONAL * (size + a.abs() + b.abs())
}

/// a q'' + b q' + c q = f, the coordinate itself being the principal one.
fn single([a, b, c]: [f64; 3], load: &Load, state: &[f64]) -> Mode {
    let mut per_inertia = Load::default();
    per_inertia.add(load, 1.0 / a);
    let oscillator = Oscillator { n: b / (2.0 * a), k2: c / a, load: per_inertia, x0: state[0], v0: state[1] };
    Mode { shape: vec![1.0], oscillator, doubt: 0.0 }
}

/// Undamped oscillations: C v = k² M v with vᵀ M v = 1.
struct Shapes {
    squares: Vec<f64>,
    shapes: Vec<Vec<f64>>,
    /// Share of each k that rounding of the stiffnesses leaves open.
    doubts: Vec<f64>,
}

/// A square below this share of its terms is what 32 digits leave of zero.
const NOTHING: f64 = 1e-28;

impl Form {
    /// With what C has below its last digits.
    fn matrices(&self) -> Matrices {
        let (mass, damping) = (self.mass.clone(), self.damping.clone());
        Matrices {
            n: self.n,
            mass,
            damping,
            stiffness: self.stiffness.clone(),
            below: self.below.clone(),
            force: vec![0.0; self.n],
            ..Matrices::default()
        }
    }

    /// vᵀ C v / vᵀ M v in twice the digits, and Σ |v_i C_ij v_j| / vᵀ M v.
    fn quotient(&self, v: &[f64]) -> [f64; 2] {
        let n = self.n;
        let low = |p: usize| self.below.get(p).copied().unwrap_or(0.0);
        let form = |entry: &dyn Fn(usize) -> [f64; 2]| {
            (0..n * n).fold(Double::default(), |sum, p| {
                let [high, low] = entry(p);
                let both = Double::from(v[p / n]).times(Double::from(v[p % n]));
                sum.add_times(high, both).add_times(low, both)
            })
        };
        let mass = form(&|p| [self.mass[p], 0.0]);
        let terms: f64 = (0..n * n).map(|p| (v[p / n] * self.stiffness[p] * v[p % n]).abs()).sum();
        [form(&|p| [self.stiffness[p], low(p)]).over(mass).round(), terms / mass.round()]
    }
}

/// The undamped shapes, ascending; none when M is not positive definite. Where weak springs stand beside hard ones they come from coordinates in which C is diagonal.
fn generalized(form: &Form) -> Option<Shapes> {
    let n = form.n;
    let graded = form.matrices().graded();
    let (mass, stiffness) = graded.as_ref().map_or((&form.mass, &form.stiffness), |g| (&g.matrices.mass, &g.matrices.stiffness));
    let modes = symmetric(n, stiffness, mass).ok()?;
    let size = modes.values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let (mut squares, mut shapes, mut doubts) = (Vec::new(), Vec::new(), Vec::new());
    for (j, value) in modes.values.iter().enumerate() {
        let own = modes.shape(j);
        let shape: Vec<f64> = match &graded {
            Some(g) => g.rounded().chunks(n).map(|row| dot(row, own)).collect(),
            None => own.to_vec(),
        };
        let [quotient, terms] = form.quotient(&shape);
        let square = match () {
            () if graded.is_some() => *value,
            () if form.below.is_empty() => {
                if value.abs() > 4.0 * f64::EPSILON * size {
                    *value
                } else {
                    0.0
                }
            }
            () => {
                if quotient.abs() > NOTHING * terms && value.abs() > 4.0 * f64::EPSILON * size {
                    quotient
                } else {
                    0.0
                }
            }
        };
        let known = !form.below.is_empty() || square == 0.0;
        doubts.push(if known { 0.0 } else { 0.5 * f64::EPSILON * terms / square.abs() });
        squares.push(square);
        shapes.push(shape);
    }
    Some(Shapes { squares, shapes, doubts })
}

/// Functions g_j = τ^j/j! e^(λτ), of which loads are made: g_j' = λ g_j + g_(j-1), g_0(0) = 1, the others begin at 0.
struct Chain {
    rate: Complex,
    powers: usize,
}

impl Joint {
    /// By the undamped shapes, where weak springs stand beside hard ones: there C is diagonal, and each stiffness has its own digits.
    fn by_shapes(form: &Form, loads: &[Load], state: &[f64]) -> Option<Joint> {
        let n = form.n;
        let even = |a: &[f64]| (0..n * n).all(|p| near(a[p], a[(p % n) * n + p / n], 0.0));
        if !even(&form.mass) || !even(&form.stiffness) {
            return None;
        }
        form.matrices().graded()?;
        let Shapes { squares, shapes, .. } = generalized(form)?;
        let product = |a: &[f64], v: &[f64]| -> Vec<f64> { a.chunks(n).map(|row| dot(row, v)).collect() };
        let unit = |p: usize, value: f64| if p / n == p % n { value } else { 0.0 };
        let drags: Vec<Vec<f64>> = shapes.iter().map(|s| product(&form.damping, s)).collect();
        let pushed = |shape: &Vec<f64>| {
            let mut load = Load::default();
            loads.iter().zip(shape).for_each(|(f, s)| load.add(f, *s));
            load
        };
        let own = Form {
            n,
            mass: (0..n * n).map(|p| unit(p, 1.0)).collect(),
            damping: (0..n * n).map(|p| dot(&shapes[p / n], &drags[p % n])).collect(),
            stiffness: (0..n * n).map(|p| unit(p, squares[p / n])).collect(),
            ..Form::default()
        };
        // x = vᵀ M q, since vᵀ M v = 1
        let weights: Vec<Vec<f64>> = shapes.iter().map(|s| product(&form.mass, s)).collect();
        let amplitudes = |q: &[f64]| weights.iter().map(|w| dot(w, q)).collect::<Vec<f64>>();
        let start = [amplitudes(&state[..n]), amplitudes(&state[n..])].concat();
        let joint = Joint::new(&own, &shapes.iter().map(pushed).collect::<Vec<_>>(), &start)?;
        Some(Joint { shapes: Some(shapes), ..joint })
    }

    fn new(form: &Form, loads: &[Load], state: &[f64]) -> Option<Joint> {
        let n = form.n;
        let lu = Lu::new(&form.mass, n);
        let mut chains: Vec<Chain> = Vec::new();
        for term in loads.iter().flat_map(|l| &l.0).filter(|t| t.rate.im >= 0.0) {
            match chains.iter_mut().find(|c| c.rate == term.rate) {
                Some(chain) => chain.powers = chain.powers.max(term.power as usize),
                None => chains.push(Chain { rate: term.rate, powers: term.power as usize }),
            }
        }
        let width = |c: &Chain| (c.powers + 1) * if c.rate.im == 0.0 { 1 } else { 2 };
        let size = 2 * n + chains.iter().map(width).sum::<usize>();
        let mut matrix = vec![0.0; size * size];
        let columns =
            |a: &[f64]| -> Option<Vec<Vec<f64>>> { (0..n).map(|j| lu.solve(&(0..n).map(|i| a[i * n + j]).collect::<Vec<_>>())).collect() };
        let (damping, stiffness) = (columns(&form.damping)?, columns(&form.stiffness)?);
        let largest = stiffness.iter().flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
        let omega = if largest > 0.0 { largest.sqrt() } else { 1.0 };
        for i in 0..n {
            matrix[i * size + n + i] = omega;
            for j in 0..n {
                matrix[(n + i) * size + j] = -stiffness[j][i] / omega;
                matrix[(n + i) * size + n + j] = -damping[j][i];
            }
        }
        let mut start: Vec<f64> = state[..n].iter().map(|q| q * omega).chain(state[n..].iter().copied()).collect();
        start.resize(size, 0.0);
        let mut joint = Joint { n, size, omega, matrix, start, shapes: None };
        let mut at = 2 * n;
        for chain in &chains {
            joint.couple(chain, at, loads, &lu)?;
            at += width(chain);
        }
        Some(joint)
    }

    /// Adds the functions of a chain and what they do to the accelerations.
    fn couple(&mut self, chain: &Chain, at: usize, loads: &[Load], lu: &Lu) -> Option<()> {
        let (n, size) = (self.n, self.size);
        let real = chain.rate.im == 0.0;
        let width = if real { 1 } else { 2 };
        let mut factorial = 1.0;
        for j in 0..=chain.powers {
            let place = at + j * width;
            factorial *= (j as f64).max(1.0);
            let factor = |l: &Load| {
                let term = l.0.iter().find(|t| t.rate == chain.rate && t.power as usize == j);
                term.map_or(Complex::ZERO, |t| t.factor).scale(factorial)
            };
            let weights: Vec<Complex> = loads.iter().map(factor).collect();
            // a conjugate pair: 2 Re(c g) = 2 re(c) Re g - 2 im(c) Im g
            let parts: Vec<Vec<f64>> = if real {
                vec![weights.iter().map(|c| c.re).collect()]
            } else {
                vec![weights.iter().map(|c| 2.0 * c.re).collect(), weights.iter().map(|c| -2.0 * c.im).collect()]
            };
            for (k, part) in parts.iter().enumerate() {
                for (i, value) in lu.solve(part)?.into_iter().enumerate() {
                    self.matrix[(n + i) * size + place + k] = value;
                }
                self.matrix[(place + k) * size + place + k] = chain.rate.re;
                if j > 0 {
                    self.matrix[(place + k) * size + place + k - width] = 1.0;
                }
            }
            if !real {
                self.matrix[place * size + place + 1] = -chain.rate.im;
                self.matrix[(place + 1) * size + place] = chain.rate.im;
            }
        }
        self.scale(at, (chain.powers + 1) * width);
        Some(())
    }

    /// Loads far larger than the system's own rates would cost digits in the exponential: the functions carry the size instead.
    fn scale(&mut self, at: usize, width: usize) {
        let (n, size) = (self.n, self.size);
        let largest = (n..2 * n)
            .flat_map(|i| (at..at + width).map(move |j| (i, j)))
            .fold(0.0_f64, |m, (i, j)| m.max(self.matrix[i * size + j].abs()));
        let factor = if largest > 0.0 { self.omega / largest } else { 1.0 };
        for i in n..2 * n {
            for j in at..at + width {
                self.matrix[i * size + j] *= factor;
            }
        }
        self.start[at] = 1.0 / factor;
    }

    /// Equal steps are propagated by one matrix; others have an exponential each.
    fn states(&self, taus: &[f64]) -> Vec<Vec<f64>> {
        let mut found = Vec::with_capacity(taus.len());
        let mut step: Option<(f64, Vec<f64>)> = None;
        let (mut before, mut z) = (0.0, self.start.clone());
        for &tau in taus {
            let delta = tau - before;
            if delta != 0.0 {
                // equal steps, but for rounding of the instants
                let known = step.as_ref().is_some_and(|(d, _)| (d - delta).abs() <= 1e-13 * tau.abs());
                if !known {
                    step = expm::exponential(&self.matrix, self.size, delta).map(|e| (delta, e));
                }
                let Some((_, e)) = &step else {
                    z.fill(f64::NAN);
                    found.push(z[..2 * self.n].to_vec());
                    continue;
                };
                z = (0..self.size).map(|i| (0..self.size).map(|j| e[i * self.size + j] * z[j]).sum()).collect();
                before = tau;
            }
            found.push(self.state_of(&z));
        }
        found
    }

    /// (q, q') of z.
    pub(super) fn state_of(&self, z: &[f64]) -> Vec<f64> {
        let places: Vec<f64> = z[..self.n].iter().map(|q| q / self.omega).collect();
        let rates = &z[self.n..2 * self.n];
        let whole = |own: &[f64]| -> Vec<f64> {
            match &self.shapes {
                Some(shapes) => (0..self.n).map(|i| shapes.iter().zip(own).map(|(s, x)| s[i] * x).sum()).collect(),
                None => own.to_vec(),
            }
        };
        [whole(&places), whole(rates)].concat()
    }
    /// Number of components of z.
    pub(super) fn size(&self) -> usize {
        self.size
    }
    /// A by rows.
    pub(super) fn matrix(&self) -> &[f64] {
        &self.matrix
    }
    /// z at the start of the phase.
    pub(super) fn start(&self) -> &[f64] {
        &self.start
    }
}

fn singular() -> Fault {
    Fault::new(Message {
        code: "S073",
        what: Text::new("the mass matrix is singular", "матрица масс вырождена"),
        why: Text::new("some motion of the coordinates moves no mass", "при некотором изменении координат масса не движется"),
        help: Text::new("give every coordinate an inertia, or remove it", "придайте каждой координате инерцию или уберите её"),
    })
}
