//! A frame as generalised coordinates: its named displacements u and, for what they leave open, amplitudes η of shapes in which all named
//! displacements rest.
//!
//! ```text
//! q = B u + Φ η      B = K⁻¹ Pᵀ (P K⁻¹ Pᵀ)⁻¹ static shapes of unit displacements u = P q,   P Φ = 0,  Φᵀ M Φ = 1
//! ```
//!
//! K then couples no u with an η. With all η nothing is lost; with the lowest ones the frame is right up to about their frequencies.
//! *Source*: R. R. Craig, M. C. C. Bampton, Coupling of substructures for dynamic analyses, AIAA J. 6 (1968) 1313, with displacements in place
//! of boundary nodes.

use crate::Fault;
use crate::equilibrium::SEARCHED;
use crate::loads::loading;
use crate::lowest::{lowest_dense, lowest_sparse, twofold};
use crate::reduced::{Condensation, Reduced, displacements, reduce};
use crate::{Assembly, Frame, Load, dense, faults};
use algebra::arrange::Arrange;
use algebra::certify::Certificate;
use algebra::double::{Double, inner};
use algebra::factor::Factored;
use algebra::polish::Firm;
use algebra::twofold::Twofold;
use algebra::vectors;

/// A frame over few coordinates: the named displacements that are independent, then amplitudes.
#[derive(Clone, Debug)]
pub struct Substructure {
    /// Indices of the named displacements that are coordinates.
    pub named: Vec<usize>,
    /// Number of amplitudes.
    pub amplitudes: usize,
    /// M, row by row.
    pub mass: Vec<f64>,
    /// K, row by row, in twice the digits: the springs that hold a stiff frame lie below the last digit of its rods.
    pub stiffness: Vec<Double>,
    /// All independent freedoms over the coordinates, n_q x n.
    pub basis: Vec<f64>,
    /// Number of independent freedoms.
    pub n_q: usize,
    /// Whether the coordinates are just the condensed freedoms in other words.
    pub condensed: bool,
    /// The highest frequency of the oscillations that span the space, rad/s, when higher ones are left out.
    pub kept: Option<f64>,
    /// What each of the acting loads moves of each named displacement while all coordinates rest, m or rad per unit of the load: the flexibility of freedoms without
    /// inertia, which follow the load at once. Row by row of displacements; such a displacement is no coordinate.
    pub lags: Vec<f64>,
}

impl Substructure {
    /// K in single numbers.
    pub fn rounded(&self) -> Vec<f64> {
        rounded(&self.stiffness)
    }

    /// Gives the amplitudes the order and the signs of those of `other` (the same frame with other numbers): each takes the shape that is most like its own.
    /// Shapes over another division are left as they are; nothing but the names of amplitudes depends on it.
    pub fn align(&mut self, other: &Substructure) {
        let (m, k) = (self.named.len(), self.amplitudes);
        if self.n_q != other.n_q || k != other.amplitudes || m != other.named.len() {
            return;
        }
        let n = m + k;
        let column = |of: &Substructure, j: usize| -> Vec<f64> { (0..of.n_q).map(|i| of.basis[i * n + m + j]).collect() };
        let unit = |v: Vec<f64>| -> Vec<f64> {
            let size = vectors::dot(&v, &v).sqrt();
            v.iter().map(|x| if size > 0.0 { x / size } else { 0.0 }).collect()
        };
        let shapes = |of: &Substructure| (0..k).map(|j| unit(column(of, j))).collect::<Vec<_>>();
        let (old, new) = (shapes(other), shapes(self));
        let mut pairs: Vec<(f64, usize, usize)> =
            (0..k * k).map(|p| (p / k, p % k)).map(|(i, j)| (vectors::dot(&old[i], &new[j]), i, j)).collect();
        pairs.arrange_by(|a, b| b.0.abs().total_cmp(&a.0.abs()).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
        let mut from: Vec<Option<(usize, f64)>> = vec![None; k];
        let mut taken = vec![false; k];
        for (like, i, j) in pairs {
            if from[i].is_none() && !taken[j] {
                from[i] = Some((j, if like < 0.0 { -1.0 } else { 1.0 }));
                taken[j] = true;
            }
        }
        let source: Vec<(usize, f64)> = (0..m).map(|i| (i, 1.0)).chain(from.iter().flatten().map(|(j, sign)| (m + j, *sign))).collect();
        let place = |e: usize| source[e / n].0 * n + source[e % n].0;
        let sign = |e: usize| source[e / n].1 * source[e % n].1;
        self.mass = (0..n * n).map(|e| sign(e) * self.mass[place(e)]).collect();
        self.stiffness = (0..n * n).map(|e| Double::from(sign(e)).times(self.stiffness[place(e)])).collect();
        self.basis = (0..self.n_q * n).map(|e| source[e % n].1 * self.basis[(e / n) * n + source[e % n].0]).collect();
    }
}

/// What coordinates are chosen from: shapes over the independent freedoms with their matrices.
struct Space {
    /// Number of shapes.
    n: usize,
    mass: Vec<Double>,
    stiffness: Vec<Double>,
    flexibility: Vec<Double>,
    /// All independent freedoms over the shapes, n_q x n.
    basis: Vec<Double>,
    /// Named displacements over the shapes, one row each.
    named: Vec<Vec<Double>>,
    /// Whether it is more than the condensed freedoms, or less.
    lost: bool,
    /// The highest oscillation in it, rad/s, when higher ones are left out.
    kept: Option<f64>,
}

/// What is wanted of the coordinates.
#[derive(Clone, Debug, Default)]
pub struct Wish {
    /// Which freedoms follow statically.
    pub condensation: Condensation,
    /// Largest number of lowest oscillations that span the space.
    pub count: usize,
    /// Loads whose static shapes span it too: those that change with time.
    pub loads: Vec<Load<f64>>,
    /// All loads, each as a unit load in its place.
    pub acting: Vec<Load<f64>>,
}

/// The coordinates of a frame.
///
/// Where the wanted oscillations are fewer than the freedoms, the space is spanned by them and the static shapes K⁻¹ Pᵀ of unit forces along
/// the named displacements and of the loads: the lowest frequencies, the statics of the named displacements and the static part of what
/// the loads do are those of the whole frame. Where they are not, it is spanned by all freedoms with inertia and by what gives way along the
/// displacements that something outside acts on. What loads move beyond it follows them without inertia ([`Substructure::lags`]).
///
/// *Errors*: nothing to move, S063, S064, faults of the eigensolver.
pub fn substructure(frame: &Frame<f64>, assembly: &Assembly<f64>, wish: &Wish) -> Result<Substructure, Fault> {
    let whole = Whole::of(frame, wish)?;
    let space = match assembly.n() > SEARCHED && wish.condensation != Condensation::Turns {
        true => whole.sparse(wish.count)?,
        false => whole.dense(wish)?,
    };
    let lags = whole.lags(&space);
    coordinates(space, assembly.n(), lags)
}

/// K⁻¹ in twice the digits, or where that is too dear as well as single numbers can.
enum Inverse {
    Fine(Firm),
    Plain(Factored),
}

impl Inverse {
    fn of(frame: &Frame<f64>, stiffness: &Twofold) -> Result<Inverse, Fault> {
        match Firm::of(stiffness.clone()) {
            Ok(Some(firm)) => Ok(Inverse::Fine(firm)),
            Ok(None) => {
                let rounded = stiffness.rounded().map_err(crate::matrices::told)?;
                Ok(Inverse::Plain(rounded.factor().map_err(|_| faults::extreme(frame))?))
            }
            Err(_) => Err(faults::extreme(frame)),
        }
    }

    fn solve(&self, b: &[Double]) -> Vec<Double> {
        match self {
            Inverse::Fine(firm) => firm.solve(b),
            Inverse::Plain(factor) => {
                let mut x: Vec<f64> = b.iter().map(|v| v.round()).collect();
                factor.solve(&mut x, 1);
                x.into_iter().map(Double::from).collect()
            }
        }
    }
}

/// All independent freedoms.
struct Whole<'a> {
    frame: &'a Frame<f64>,
    fine: Frame<Double>,
    assembly: Assembly<Double>,
    stiffness: Twofold,
    mass: Twofold,
    inverse: Inverse,
    /// Named displacements over the freedoms.
    named: Vec<Vec<Double>>,
    /// Loads on the freedoms, whose static shapes are wanted.
    loads: Vec<Vec<Double>>,
    /// All loads.
    acting: Vec<Vec<Double>>,
}

impl Whole<'_> {
    fn of<'a>(frame: &'a Frame<f64>, wish: &Wish) -> Result<Whole<'a>, Fault> {
        let lists = Frame { loads: [&wish.loads[..], &wish.acting].concat(), ..frame.clone() };
        let mut fine = lists.doubled();
        let loads = std::mem::take(&mut fine.loads);
        let assembly = Assembly::of(&fine);
        let (stiffness, mass) = (twofold(&assembly.stiffness(&fine)), twofold(&assembly.mass(&fine)));
        let force = |load: &Load<Double>| assembly.elimination.gather(&loading(&assembly, &fine, std::slice::from_ref(load)).forces);
        let mut loads: Vec<Vec<Double>> = loads.iter().map(force).collect();
        let acting = loads.split_off(wish.loads.len());
        let (inverse, named) = (Inverse::of(frame, &stiffness)?, displacements(&fine, &assembly));
        Ok(Whole { frame, fine, assembly, stiffness, mass, inverse, named, loads, acting })
    }

    /// pᵀ (K⁻¹ - Φ (Φᵀ K Φ)⁻¹ Φᵀ) f for named displacements p and loads f, Φ the shapes of the space, row by row; what is rounding is zero. In a space of few shapes
    /// those of the named displacements are there, and nothing is left.
    fn lags(&self, space: &Space) -> Vec<f64> {
        let (n, n_q) = (space.n, self.stiffness.size());
        if self.acting.is_empty() || self.named.is_empty() || space.kept.is_some() {
            return vec![0.0; self.named.len() * self.acting.len()];
        }
        let across = dense::transpose(&space.basis, n_q, n);
        let left = |f: &Vec<Double>| -> (Vec<Double>, f64) {
            let x = self.inverse.solve(f);
            let own = inner(f, &x).round();
            let in_space = dense::product(&space.flexibility, &dense::product(&across, f, n, n_q, 1), n, n, 1);
            let followed = dense::product(&space.basis, &in_space, n_q, n, 1);
            (x.iter().zip(followed).map(|(x, y)| x.less(y)).collect(), own)
        };
        let moved: Vec<(Vec<Double>, f64)> = self.acting.iter().map(left).collect();
        let mut lags = Vec::new();
        for row in &self.named {
            let own = inner(row, &self.inverse.solve(row)).round();
            let of = |(x, load): &(Vec<Double>, f64)| {
                let lag = inner(row, x).round();
                if lag.abs() > AT_ONCE * (own * load).sqrt() { lag } else { 0.0 }
            };
            lags.extend(moved.iter().map(of));
        }
        lags
    }

    /// All of a small frame, condensed; or the few shapes that matter.
    fn dense(&self, wish: &Wish) -> Result<Space, Fault> {
        if self.mass.diagonal().iter().all(|m| m.is_zero()) {
            return Ok(self.complete(None));
        }
        let mut bare = self.fine.clone();
        bare.displacements.clear();
        let reduced = reduce(&bare, &self.assembly, wish.condensation)?;
        let (n, n_q) = (reduced.n(), reduced.n_q);
        if self.named.len() + wish.count >= n {
            return Ok(self.complete(Some(reduced)));
        }
        let (modes, certificate) = lowest_dense(&reduced.stiffness, &reduced.mass, n, wish.count)?;
        confirmed(&certificate)?;
        let shape = |j: usize| dense::product(&reduced.basis, &doubled(modes.shape(j)), n_q, n, 1);
        Ok(self.few(&modes.values, (0..modes.values.len()).map(shape).collect()))
    }

    fn sparse(&self, count: usize) -> Result<Space, Fault> {
        if self.mass.diagonal().iter().all(|m| m.is_zero()) {
            return Ok(self.few(&[], Vec::new()));
        }
        let (stiffness, mass) = (self.assembly.stiffness(&self.fine), self.assembly.mass(&self.fine));
        let (modes, certificate) = lowest_sparse(&stiffness, &mass, count)?;
        confirmed(&certificate)?;
        Ok(self.few(&modes.values, (0..modes.values.len()).map(|j| doubled(modes.shape(j))).collect()))
    }

    /// The condensed freedoms, and what their condensation took from the displacements that something outside acts on.
    fn complete(&self, reduced: Option<Reduced<Double>>) -> Space {
        let n_q = self.stiffness.size();
        let reduced = reduced.unwrap_or_else(|| Reduced { n_q, ..Reduced::default() });
        let kept = reduced.n();
        let mut shapes: Vec<Vec<Double>> = (0..kept).map(|j| (0..n_q).map(|i| reduced.basis[i * kept + j]).collect()).collect();
        let loaded = self.named.iter().zip(&self.frame.displacements).filter(|(_, d)| d.loaded);
        for (row, _) in loaded {
            shapes.extend(self.beyond(row, &shapes, &reduced));
        }
        let n = shapes.len();
        let extended = |matrix: &[Double]| -> Vec<Double> {
            let mut out: Vec<Double> = dense::identity(n);
            (0..kept * kept).for_each(|e| out[(e / kept) * n + e % kept] = matrix[e]);
            out
        };
        let (stiffness, flexibility) = (extended(&reduced.stiffness), extended(&reduced.flexibility));
        let mut space = self.space(&shapes);
        for (i, j) in (0..kept).flat_map(|i| (0..kept).map(move |j| (i, j))) {
            space.mass[i * n + j] = reduced.mass[i * kept + j];
        }
        Space { stiffness, flexibility, lost: n > kept, ..space }
    }

    /// The space of some oscillations and of the static shapes of unit forces along the named displacements and of the loads, with K = 1.
    fn few(&self, values: &[f64], modes: Vec<Vec<Double>>) -> Space {
        let mut shapes: Vec<Vec<Double>> = Vec::new();
        for (value, shape) in values.iter().zip(modes) {
            let size = Double::from(*value).root();
            shapes.push(shape.iter().map(|x| x.over(size)).collect());
        }
        for row in self.named.iter().chain(&self.loads) {
            shapes.extend(self.beyond(row, &shapes, &Reduced::default()));
        }
        let kept = values.iter().copied().reduce(f64::max).map(f64::sqrt);
        Space { lost: true, kept, ..self.space(&shapes) }
    }

    /// What the static shape of a unit force along `row` adds to shapes, xᵀ K x = 1; nothing where it only repeats them. The first shapes are the columns of
    /// condensed freedoms, the others orthonormal in K and to them.
    fn beyond(&self, row: &[Double], shapes: &[Vec<Double>], condensed: &Reduced<Double>) -> Option<Vec<Double>> {
        let (k, kept) = (&self.stiffness, condensed.n());
        let mut shape = self.inverse.solve(row);
        let own = inner(row, &shape).round();
        for _ in 0..2 {
            let force = k.product(&shape);
            let shares: Vec<Double> = shapes.iter().map(|s| inner(s, &force)).collect();
            let mut weights = dense::product(&condensed.flexibility, &shares[..kept], kept, kept, 1);
            weights.extend(&shares[kept..]);
            for (other, weight) in shapes.iter().zip(weights) {
                let minus = weight.negated();
                shape.iter_mut().zip(other).for_each(|(x, o)| *x = x.plus(minus, *o));
            }
        }
        let left = inner(&shape, &k.product(&shape));
        let size = left.root();
        (left.round() > NEW * own && shapes.len() < k.size()).then(|| shape.iter().map(|x| x.over(size)).collect())
    }

    /// The space of shapes that are orthonormal in K.
    fn space(&self, shapes: &[Vec<Double>]) -> Space {
        let (n, n_q) = (shapes.len(), self.stiffness.size());
        let heavy: Vec<Vec<Double>> = shapes.iter().map(|s| self.mass.product(s)).collect();
        let half = Double::from(0.5);
        let mass = (0..n * n).map(|e| half.times(inner(&shapes[e / n], &heavy[e % n]).sum(inner(&shapes[e % n], &heavy[e / n])))).collect();
        let basis = (0..n_q * n).map(|e| shapes[e % n][e / n]).collect();
        let named = self.named.iter().map(|row| shapes.iter().map(|s| inner(row, s)).collect()).collect();
        Space { n, mass, stiffness: dense::identity(n), flexibility: dense::identity(n), basis, named, lost: false, kept: None }
    }
}

fn doubled(vector: &[f64]) -> Vec<Double> {
    vector.iter().map(|v| Double::from(*v)).collect()
}

fn rounded(vector: &[Double]) -> Vec<f64> {
    vector.iter().map(|v| v.round()).collect()
}

fn confirmed(certificate: &Certificate) -> Result<(), Fault> {
    if certificate.passes() == [true; 2] { Ok(()) } else { Err(faults::unconfirmed(certificate.worst(), certificate.missing() as f64)) }
}

/// Smallest share of its energy that a static shape adds to what is there.
const NEW: f64 = 1e-10;

/// Share of its flexibility that makes a functional independent of others: 1e-5 of the functional, squared.
const INDEPENDENT: f64 = 1e-10;

/// Share of what a load could move of a displacement, by Schwarz's inequality, below which a lag is rounding of solutions that carry thirteen digits.
const AT_ONCE: f64 = 1e-10;

/// Named displacements, then amplitudes of shapes in which they rest. A displacement that a load moves at once has no inertia in part: it follows.
fn coordinates(space: Space, n_q: usize, lags: Vec<f64>) -> Result<Substructure, Fault> {
    let (n, rows) = (space.n, &space.named);
    let width = lags.len() / rows.len().max(1);
    let follows = |i: usize| lags[i * width..(i + 1) * width].iter().any(|lag| *lag != 0.0);
    let open: Vec<usize> = (0..rows.len()).filter(|i| !follows(*i)).collect();
    let candidates: Vec<Vec<Double>> = open.iter().map(|i| rows[*i].clone()).collect();
    let named: Vec<usize> = independent(&candidates, &space.flexibility, n).into_iter().map(|k| open[k]).collect();
    let p: Vec<Double> = named.iter().flat_map(|i| rows[*i].clone()).collect();
    let m = named.len();
    let dpt = dense::product(&space.flexibility, &dense::transpose(&p, m, n), n, n, m);
    let small = dense::product(&p, &dpt, m, n, m);
    let inverse = dense::solve(&small, m, &dense::identity(m), m).ok_or_else(|| faults::unconfirmed(1.0, 0.0))?;
    let fixed = dense::product(&dpt, &inverse, n, m, m);
    let free = resting(&p, &space, m)?;
    let amplitudes = free.len();
    let width = m + amplitudes;
    let mut local = vec![Double::default(); n * width];
    for i in 0..n {
        (0..m).for_each(|j| local[i * width + j] = fixed[i * m + j]);
        free.iter().enumerate().for_each(|(j, shape)| local[i * width + m + j] = shape[i]);
    }
    let mut stiffness = dense::congruence(&space.stiffness, &local, n, width);
    // exactly uncoupled; what rounding leaves would look like a spring
    for i in 0..m {
        for j in m..width {
            stiffness[i * width + j] = Double::default();
            stiffness[j * width + i] = Double::default();
        }
    }
    for i in m..width {
        (m..width).filter(|j| *j != i).for_each(|j| stiffness[i * width + j] = Double::default());
    }
    let mut mass = rounded(&dense::congruence(&space.mass, &local, n, width));
    for i in m..width {
        (m..width).for_each(|j| mass[i * width + j] = f64::from(u8::from(i == j)));
    }
    Ok(Substructure {
        named,
        amplitudes,
        mass,
        stiffness,
        basis: rounded(&dense::product(&space.basis, &local, n_q, n, width)),
        n_q,
        condensed: !space.lost,
        kept: space.kept,
        lags,
    })
}

/// The functionals that are independent of those before them, in the metric of the flexibility.
fn independent(rows: &[Vec<Double>], flexibility: &[Double], n: usize) -> Vec<usize> {
    let mut kept: Vec<(usize, Vec<Double>)> = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        let own = energy(row, row, flexibility, n).round();
        let mut rest = row.clone();
        for _ in 0..2 {
            for (_, other) in &kept {
                let minus = energy(&rest, other, flexibility, n).negated();
                rest.iter_mut().zip(other).for_each(|(r, o)| *r = r.plus(minus, *o));
            }
        }
        let left = energy(&rest, &rest, flexibility, n);
        // energies: 1e-5 of the functional itself is new, the rest of a dependent one is rounding of its square
        if own > 0.0 && left.round() > INDEPENDENT * own && kept.len() < n {
            let size = left.root();
            rest.iter_mut().for_each(|r| *r = r.over(size));
            kept.push((i, rest));
        }
    }
    kept.into_iter().map(|k| k.0).collect()
}

fn energy(a: &[Double], b: &[Double], flexibility: &[Double], n: usize) -> Double {
    inner(a, &dense::product(flexibility, b, n, n, 1))
}

/// The oscillations in which the named displacements rest, xᵀ M x = 1.
fn resting(p: &[Double], space: &Space, m: usize) -> Result<Vec<Vec<Double>>, Fault> {
    let n = space.n;
    if m >= n {
        return Ok(Vec::new());
    }
    // columns that solve P x = 0: the pivots of P follow the others
    let rows: Vec<crate::constraints::Row<Double>> =
        (0..m).map(|i| (0..n).filter(|j| !p[i * n + j].is_zero()).map(|j| (j, p[i * n + j])).collect()).collect();
    let elimination = crate::constraints::eliminate(n, &rows, &|i| i);
    let k = elimination.free.len();
    let mut basis = vec![Double::default(); n * k];
    for (i, row) in elimination.transform.iter().enumerate() {
        row.iter().for_each(|(j, c)| basis[i * k + j] = *c);
    }
    let (stiffness, mass) = (dense::congruence(&space.stiffness, &basis, n, k), dense::congruence(&space.mass, &basis, n, k));
    let (found, certificate) = lowest_dense(&stiffness, &mass, k, k)?;
    confirmed(&certificate)?;
    Ok((0..found.values.len()).map(|j| dense::product(&basis, &doubled(found.shape(j)), n, k, 1)).collect())
}
