//! The lowest modes of large sparse structures: K x = lambda M x by Lanczos' method for (K - sigma M)⁻¹ M in the inner product of M.
//!
//! Blocks of vectors, all kept orthogonal to all others (full reorthogonalisation), so that no mode is found twice; eigenvalues more often
//! repeated than a block is wide are found by widening the block with new random vectors until the number of eigenvalues below the
//! highest one wanted agrees with the inertia of K - s M (Sturm's count). *Source*: R. G. Grimes, J. G. Lewis, H. D. Simon,
//! A shifted block Lanczos algorithm, SIAM J. Matrix Anal. Appl. 15 (1994); B. N. Parlett, The Symmetric Eigenvalue Problem, 13.

use crate::Trouble;
use crate::elementary;
use crate::factor::Factored;
use crate::kernels;
use crate::modes::{Modes, orient};
use crate::random::Random;
use crate::refine::sharpen;
use crate::sparse::Sparse;
use crate::trouble::Pivot;

/// Wishes for [`lowest`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Largest residual |(K - sigma M)⁻¹ M x - theta x| / theta in the norm of M; the eigenvalue errs by its square.
    pub tolerance: f64,
    /// Vectors that are iterated together.
    pub block: usize,
    /// Most vectors in the basis; 0 for 10 times the number of modes and 200 more.
    pub basis: usize,
    /// Of the start vectors.
    pub seed: u64,
    /// Whether Sturm's count confirms that no mode is missing.
    pub sturm: Sturm,
}

/// Whether the number of modes is confirmed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sturm {
    /// By one more factorisation (about a third of the time).
    Counted,
    /// Not: an eigenvalue repeated more often than the block is wide may be found too seldom.
    Skipped,
}

impl Default for Options {
    fn default() -> Options {
        // eigenvalues err by the square of a residual: 1e-10 is more than the digits they have
        Options { tolerance: 1e-10, block: 4, basis: 0, seed: 1, sturm: Sturm::Counted }
    }
}

/// What the search took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Counters {
    /// Shift sigma.
    pub shift: f64,
    /// Vectors in the basis.
    pub basis: usize,
    /// Solutions with the factor.
    pub solves: usize,
    /// Factorisations.
    pub factorisations: usize,
    /// Numbers in one factor.
    pub factor: usize,
    /// Times the block was widened because a mode was missing.
    pub widened: usize,
    /// Modes below the limit by Sturm's count; none when it was not taken.
    pub counted: Option<usize>,
}

/// Lowest modes with the quality of each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lowest {
    /// Eigenvalues and shapes.
    pub modes: Modes,
    /// Residual of each mode, see [`Options::tolerance`].
    pub residuals: Vec<f64>,
    /// Work.
    pub counters: Counters,
}

/// The `count` lowest solutions of K x = lambda M x (fewer when M has a smaller rank).
///
/// K symmetric, positive definite or with free motions, whose eigenvalues are 0; M symmetric, positive semidefinite.
/// *Errors*: [`Trouble::Pivot`] when K and M vanish for the same motion, [`Trouble::Unconverged`] at the cap of the basis.
pub fn lowest(k: &Sparse, m: &Sparse, count: usize, options: Options) -> Result<Lowest, Trouble> {
    if k.size() != m.size() {
        return Err(Trouble::Malformed("M"));
    }
    let wanted = count.min(k.size());
    if wanted == 0 {
        return Ok(Lowest { modes: Modes { n: k.size(), ..Modes::default() }, ..Lowest::default() });
    }
    let mut search = Search::new(k, m, options)?;
    let cap = if options.basis > 0 { options.basis } else { 10 * count + 200 };
    loop {
        let ritz = search.ritz(wanted)?;
        if search.exhausted || ritz.settled(wanted, options.tolerance) {
            if !search.missing(&ritz, wanted, options)? {
                return search.finish(&ritz, wanted);
            }
            search.widen();
        }
        if search.size >= cap && !search.exhausted {
            return Err(Trouble::Unconverged { found: ritz.converged(wanted, options.tolerance), wanted });
        }
        search.extend(wanted);
    }
}

/// Basis, projected matrix and factor of one search.
struct Search<'a> {
    n: usize,
    k: &'a Sparse,
    m: &'a Sparse,
    factor: Factored,
    random: Random,
    /// Vectors one after another, M-orthonormal; the first `done` have been multiplied.
    basis: Vec<f64>,
    /// M times the vectors that wait for their multiplication.
    waiting: Vec<f64>,
    size: usize,
    done: usize,
    /// Coefficients of the products: column j in the basis.
    products: Vec<Vec<f64>>,
    /// First vector of the block multiplied last.
    previous: usize,
    exhausted: bool,
    counters: Counters,
}

/// Factors K - sigma M, with the plan of an earlier factor.
fn shifted(k: &Sparse, m: &Sparse, shift: f64, plan: Option<&Factored>, counters: &mut Counters) -> Result<Factored, Trouble> {
    counters.factorisations += 1;
    Factored::new(&k.sum(1.0, m, -shift), plan)
}

/// Shares of the largest k / m at which a shift below zero is tried when K alone is not positive definite.
const SHIFTS: [f64; 8] = [1e-11, 1e-9, 1e-7, 1e-5, 1e-3, 1e-1, 1e1, 1e3];
/// New part of a vector below this share of it: the basis holds all of it.
const DEPENDENT: f64 = 1e-12;

impl<'a> Search<'a> {
    fn new(k: &'a Sparse, m: &'a Sparse, options: Options) -> Result<Search<'a>, Trouble> {
        let n = k.size();
        let mut counters = Counters::default();
        let (factor, shift) = positive(k, m, &mut counters)?;
        counters.shift = shift;
        counters.factor = factor.size();
        let random = Random::new(options.seed);
        let mut search = Search {
            n,
            k,
            m,
            factor,
            random,
            basis: Vec::new(),
            waiting: Vec::new(),
            size: 0,
            done: 0,
            products: Vec::new(),
            previous: 0,
            exhausted: false,
            counters,
        };
        search.append_random(options.block.max(1));
        search.exhausted = search.size == 0;
        Ok(search)
    }

    fn vector(&self, j: usize) -> &[f64] {
        &self.basis[j * self.n..(j + 1) * self.n]
    }

    fn masses(&self, block: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; block.len()];
        block.chunks(self.n).zip(out.chunks_mut(self.n)).for_each(|(x, y)| self.m.product_into(x, y));
        out
    }

    /// (K - sigma M)⁻¹ of a block.
    fn inverse(&mut self, block: &mut [f64]) {
        let count = block.len() / self.n;
        self.counters.solves += count;
        self.factor.solve(block, count);
    }

    /// Takes the components along basis vectors `from..` out of a block; returns them, one row of all columns per basis vector.
    fn orthogonalise(&self, block: &mut [f64], masses: &[f64], from: usize) -> Vec<f64> {
        let old = &self.basis[from * self.n..self.size * self.n];
        let shares = kernels::shares(self.n, old, masses);
        kernels::subtract(self.n, block, old, &shares);
        shares
    }

    /// Appends random vectors to the waiting ones. They are taken from the range of the operator, so that no massless motion enters.
    fn append_random(&mut self, count: usize) {
        let start: Vec<f64> = (0..count * self.n).map(|_| self.random.between(-1.0, 1.0)).collect();
        let mut block = self.masses(&start);
        self.inverse(&mut block);
        self.append(block, &mut Vec::new());
    }

    /// Makes a block M-orthonormal, to the basis and in itself, and appends it; writes the coefficients of each vector.
    fn append(&mut self, mut block: Vec<f64>, coefficients: &mut Vec<Vec<f64>>) {
        let (n, count, old) = (self.n, block.len() / self.n, self.size);
        let mut masses = self.masses(&block);
        let before: Vec<f64> = columns(n, &block, &masses).map(f64::sqrt).collect();
        coefficients.clear();
        coefficients.resize(count, vec![0.0; old + count]);
        // first the two blocks in which the product must lie, then all: the second pass removes what rounding left
        for from in [self.previous, 0, 0] {
            let shares = self.orthogonalise(&mut block, &masses, from);
            for (i, row) in shares.chunks(count).enumerate() {
                row.iter().enumerate().for_each(|(c, s)| coefficients[c][from + i] += s);
            }
            masses = self.masses(&block);
            let after = columns(n, &block, &masses);
            let clean = after.enumerate().all(|(c, a)| {
                let removed: f64 = shares.chunks(count).map(|row| row[c] * row[c]).sum();
                // a hundredth of the length taken off leaves no more than rounding along the basis: two digits of sixteen
                removed <= 1e-4 * a
            });
            if clean && from == 0 {
                break;
            }
        }
        for (c, own) in coefficients.iter_mut().enumerate() {
            self.append_one((&mut block, &mut masses), c, before[c], own);
        }
        coefficients.iter_mut().for_each(|c| c.truncate(self.size));
    }

    /// The c-th vector of a block: orthogonal to the new ones before it, then of length 1.
    fn append_one(&mut self, (block, masses): (&mut [f64], &mut [f64]), c: usize, before: f64, coefficients: &mut [f64]) {
        let n = self.n;
        let first_waiting = self.size - self.waiting.len() / n;
        let (own, own_masses) = (&mut block[c * n..(c + 1) * n], &mut masses[c * n..(c + 1) * n]);
        for _ in 0..2 {
            let waiting = self.basis[first_waiting * n..].chunks(n).zip(self.waiting.chunks(n));
            for ((vector, mass), coefficient) in waiting.zip(&mut coefficients[first_waiting..]) {
                let share = kernels::dot(vector, own_masses);
                *coefficient += share;
                own.iter_mut().zip(vector).for_each(|(x, v)| *x -= share * v);
                own_masses.iter_mut().zip(mass).for_each(|(x, v)| *x -= share * v);
            }
        }
        let norm = kernels::dot(own, own_masses).max(0.0).sqrt();
        if norm.is_nan() || norm <= DEPENDENT * before {
            return;
        }
        coefficients[self.size] = norm;
        self.basis.extend(own.iter().map(|x| x / norm));
        self.waiting.extend(own_masses.iter().map(|x| x / norm));
        self.size += 1;
    }

    /// Multiplies waiting blocks until the basis is worth a look.
    fn extend(&mut self, wanted: usize) {
        let target = if self.done < wanted + 8 { wanted + wanted / 2 + 8 } else { self.done + 1 + (self.done / 10) };
        while self.done < target && !self.exhausted {
            self.step();
        }
    }

    /// Multiplies the waiting block.
    fn step(&mut self) {
        let (first, count) = (self.done, self.size - self.done);
        let mut block = std::mem::take(&mut self.waiting);
        self.inverse(&mut block);
        let mut coefficients = Vec::new();
        self.append(block, &mut coefficients);
        self.products.append(&mut coefficients);
        self.done += count;
        self.previous = first;
        // a vector without a new part: a random one in its place looks for what the block has not seen
        if self.size - self.done < count {
            self.append_random(count - (self.size - self.done));
        }
        self.exhausted = self.size == self.done;
    }

    fn widen(&mut self) {
        self.counters.widened += 1;
        let count = (self.size - self.done).max(1);
        self.append_random(count);
        self.exhausted = self.size == self.done;
    }

    /// Eigenvalues of the projected operator and what they miss.
    fn ritz(&self, wanted: usize) -> Result<Ritz, Trouble> {
        let size = self.done;
        let entry = |i: usize, j: usize| self.products[j].get(i).copied().unwrap_or(0.0);
        let projected: Vec<f64> = (0..size * size).map(|e| 0.5 * (entry(e / size, e % size) + entry(e % size, e / size))).collect();
        let (values, vectors) = kernels::self_adjoint(size, &projected).ok_or(Trouble::Unconverged { found: 0, wanted })?;
        let mut ritz = Ritz { size, shift: self.counters.shift, values: Vec::new(), vectors: Vec::new(), residuals: Vec::new() };
        for j in (0..size).rev().filter(|&j| values[j] > 0.0) {
            let vector = &vectors[j * size..(j + 1) * size];
            let outside = |i: usize| (0..size).map(|c| entry(i, c) * vector[c]).sum::<f64>();
            let rest = (size..self.size).fold(0.0_f64, |norm, i| elementary::hypot(norm, outside(i)));
            ritz.residuals.push(rest / values[j]);
            ritz.values.push(values[j]);
            ritz.vectors.extend(vector);
        }
        Ok(ritz)
    }

    /// Whether Sturm's count finds more eigenvalues below the highest one wanted than the basis has.
    fn missing(&mut self, ritz: &Ritz, wanted: usize, options: Options) -> Result<bool, Trouble> {
        if options.sturm == Sturm::Skipped || self.exhausted || ritz.values.len() <= wanted {
            return Ok(false);
        }
        let (mut limit, expected) = ritz.limit(wanted);
        for _ in 0..4 {
            let (below, certain) = shifted(self.k, self.m, limit, Some(&self.factor), &mut self.counters)?.inertia();
            if certain {
                self.counters.counted = Some(below);
                return Ok(below > expected);
            }
            // off a shift on which the factorisation failed, by far less than the gap above it (1e-5)
            limit *= 1.0 + 1e-7;
        }
        Ok(false)
    }

    /// Shapes, once more multiplied, which shows their residuals and takes massless parts out.
    fn finish(mut self, ritz: &Ritz, wanted: usize) -> Result<Lowest, Trouble> {
        let (n, count) = (self.n, wanted.min(ritz.values.len()));
        let mut shapes = vec![0.0; n * count];
        let weights: Vec<f64> = (0..ritz.size * count).map(|e| -ritz.vectors[e % count * ritz.size + e / count]).collect();
        kernels::subtract(n, &mut shapes, &self.basis[..ritz.size * n], &weights);
        self.basis = Vec::new();
        let mut masses = self.masses(&shapes);
        let mut inverse = masses.clone();
        self.inverse(&mut inverse);
        let mut residuals = Vec::with_capacity(count);
        for j in 0..count {
            let own = j * n..(j + 1) * n;
            let theta = kernels::dot(&inverse[own.clone()], &masses[own.clone()]);
            let rest: Vec<f64> = inverse[own.clone()].iter().zip(&shapes[own]).map(|(z, x)| z - theta * x).collect();
            residuals.push(kernels::dot(&rest, &self.m.product(&rest)).max(0.0).sqrt() / theta);
        }
        drop(shapes);
        masses = self.masses(&inverse);
        (self.size, self.done, self.previous) = (0, 0, 0);
        self.waiting = Vec::new();
        let mut coefficients = vec![0.0; count + 1];
        for j in 0..count {
            let before = kernels::dot(&inverse[j * n..][..n], &masses[j * n..][..n]).max(0.0).sqrt();
            self.append_one((&mut inverse, &mut masses), j, before, &mut coefficients);
        }
        self.counters.basis = ritz.size;
        if self.size < count {
            return Err(Trouble::Unconverged { found: self.size, wanted });
        }
        Ok(self.ordered(residuals))
    }

    /// Rayleigh's quotients of the shapes, ascending.
    fn ordered(mut self, residuals: Vec<f64>) -> Lowest {
        let n = self.n;
        let ratio = |a: f64, b: f64| if b > 0.0 { a / b } else { 0.0 };
        let largest = self.k.diagonal().iter().zip(self.m.diagonal()).fold(0.0_f64, |s, (k, m)| s.max(ratio(*k, m)));
        let mut found: Vec<(f64, usize)> = Vec::new();
        for j in 0..residuals.len() {
            let shape = &mut self.basis[j * n..(j + 1) * n];
            orient(shape);
            found.push((self.k.quotient(self.m, shape), j));
        }
        // what rounding leaves of a free motion is no frequency
        found.iter_mut().filter(|(value, _)| value.abs() <= 1e-15 * largest && self.counters.shift < 0.0).for_each(|f| f.0 = 0.0);
        found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut modes = Modes { n, values: found.iter().map(|f| f.0).collect(), vectors: Vec::with_capacity(n * found.len()) };
        found.iter().for_each(|&(_, j)| modes.vectors.extend(self.vector(j)));
        sharpen(self.k, self.m, &mut modes);
        Lowest { modes, residuals: found.iter().map(|&(_, j)| residuals[j]).collect(), counters: self.counters }
    }
}

/// xᵀ M x of each vector of a block.
fn columns<'a>(n: usize, block: &'a [f64], masses: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
    block.chunks(n).zip(masses.chunks(n)).map(|(x, m)| kernels::dot(x, m).max(0.0))
}

/// Factor of K - sigma M, positive definite, with the shift nearest zero that makes it so.
pub(super) fn positive(k: &Sparse, m: &Sparse, counters: &mut Counters) -> Result<(Factored, f64), Trouble> {
    let ratio = |(k, m): (f64, f64)| if m > 0.0 { k.abs() / m } else { 0.0 };
    let largest = k.diagonal().into_iter().zip(m.diagonal()).map(ratio).fold(0.0, f64::max);
    // a structure without any stiffness still has masses
    let unit = if largest > 0.0 { largest } else { 1.0 };
    let mut last: Option<(Factored, Pivot)> = None;
    for shift in std::iter::once(0.0).chain(SHIFTS.iter().map(|s| -s * unit)) {
        let factor = shifted(k, m, shift, last.as_ref().map(|l| &l.0), counters)?;
        match factor.defect() {
            None => return Ok((factor, shift)),
            Some(pivot) => last = Some((factor, pivot)),
        }
    }
    Err(last.map_or_else(|| Trouble::Malformed("K, M"), |l| l.1.into()))
}

/// Eigenpairs of the projected operator, theta = 1 / (lambda - sigma) falling.
struct Ritz {
    size: usize,
    shift: f64,
    values: Vec<f64>,
    vectors: Vec<f64>,
    residuals: Vec<f64>,
}

impl Ritz {
    fn eigenvalue(&self, j: usize) -> f64 {
        self.shift + 1.0 / self.values[j]
    }

    fn converged(&self, wanted: usize, tolerance: f64) -> usize {
        self.residuals.iter().take(wanted).take_while(|&&r| r <= tolerance).count()
    }

    /// All wanted ones have converged, and the one after them well enough to put the limit of Sturm's count below it.
    fn settled(&self, wanted: usize, tolerance: f64) -> bool {
        // its value errs by the square of the residual, 1e-4: less than where the limit is put
        self.converged(wanted, tolerance) >= wanted && self.residuals.get(wanted).is_some_and(|&r| r <= 1e-2)
    }

    /// A number above the wanted eigenvalues, in the first wide gap, and how many are known below it.
    fn limit(&self, wanted: usize) -> (f64, usize) {
        let wide = |j: &usize| {
            let (low, high) = (self.eigenvalue(j - 1), self.eigenvalue(*j));
            // the count needs a shift that is no eigenvalue within the digits of the factorisation; clusters are closer
            high - low > 1e-5 * (high - self.shift)
        };
        let j = (wanted..self.values.len()).find(wide).unwrap_or(self.values.len() - 1);
        (0.8 * self.eigenvalue(j - 1) + 0.2 * self.eigenvalue(j), j)
    }
}
