//! Lagrange's equations of the second kind.
//!
//! With the time direction n (rate 1) the kinetic energy is one quadratic form, T = Σ M_ab q'_a q'_b / 2 over a, b = 0..=n, and
//!
//! ```text
//! d/dt ∂T/∂q'_i - ∂T/∂q_i = Σ_j M_ij q''_j + Σ_bc (∂M_ib/∂q_c - ∂M_bc/∂q_i / 2) q'_b q'_c
//! ```
//!
//! M is gathered body by body from J·J: equal products of Jacobian columns are one expression, so their masses add up in front, which
//! gives the grouping of a textbook and keeps long chains of bodies short.

use super::loads::Loads;
use crate::model::{FrameId, Inertia, Mass, PointRef};
use crate::scene::kinematics::Kinematics;
use crate::scene::{Columns, Scene, Vector};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;
use symbolic::{Expr, Rational};

/// A symmetric matrix over directions, upper half: (a, b) with a <= b.
pub type Quadratic = BTreeMap<(usize, usize), Expr>;

/// Kinetic energy as quadratic forms.
#[derive(Clone, Debug, Default)]
pub struct Kinetic {
    /// All bodies together.
    pub total: Quadratic,
    /// Per frame; empty for massless ones.
    pub bodies: Vec<Quadratic>,
}

/// A product of Jacobian columns, and the factors it is multiplied by.
type Weighted = (Expr, Vec<Expr>);

/// The weighted products of each pair of directions.
#[derive(Default)]
struct Gathered {
    entries: BTreeMap<(usize, usize), Vec<Weighted>>,
}

impl Gathered {
    fn push(&mut self, pair: (usize, usize), product: Expr, factor: Expr) {
        let list = self.entries.entry(pair).or_default();
        match list.iter_mut().find(|(p, _)| *p == product) {
            Some((_, factors)) => factors.push(factor),
            None => list.push((product, vec![factor])),
        }
    }

    fn finish(self, scene: &mut Scene) -> Quadratic {
        let mut out = Quadratic::new();
        for (pair, list) in self.entries {
            let terms: Vec<Expr> = list
                .into_iter()
                .map(|(product, factors)| {
                    let factor = scene.graph.sum(&factors);
                    scene.graph.mul(factor, product)
                })
                .collect();
            let sum = scene.graph.sum(&terms);
            let entry = scene.tidy(sum);
            if !scene.graph.is_zero(entry) {
                out.insert(pair, entry);
            }
        }
        out
    }
}

/// Whose kinetic energy is wanted.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum EnergyOf {
    /// Of the machine.
    Machine,
    /// Of the machine and of each body.
    Bodies,
}

/// Gathers the kinetic energy.
pub fn kinetic_energy(scene: &mut Scene, kinematics: &mut Kinematics, of: EnergyOf) -> Kinetic {
    let model = scene.model;
    let mut kinetic = Kinetic::default();
    let mut total = Gathered::default();
    let mut dots: FxHashMap<(Vector, Vector), Expr> = FxHashMap::default();
    for (i, frame) in model.frames.iter().enumerate() {
        let mut own = (of == EnergyOf::Bodies).then(Gathered::default);
        if let Some(mass) = &frame.mass {
            let frame = FrameId(i);
            let columns = kinematics.jacobian(scene, PointRef::Center(frame));
            let turning = kinematics.frames[i].turning.clone();
            let mut sink = |pair, product, factor| {
                total.push(pair, product, factor);
                own.iter_mut().for_each(|own| own.push(pair, product, factor));
            };
            translation(scene, mass, &columns, &mut dots, &mut sink);
            rotation(scene, mass, &turning, &mut sink);
        }
        kinetic.bodies.push(own.map(|own| own.finish(scene)).unwrap_or_default());
    }
    let one = scene.graph.one();
    for inertia in &model.inertias {
        total.push((inertia.between[0], inertia.between[1]), one, inertia.value);
    }
    kinetic.total = total.finish(scene);
    kinetic
}

type Sink<'a> = dyn FnMut((usize, usize), Expr, Expr) + 'a;

/// m J_a·J_b
fn translation(scene: &mut Scene, mass: &Mass, columns: &Columns<Vector>, dots: &mut FxHashMap<(Vector, Vector), Expr>, sink: &mut Sink) {
    if scene.graph.is_zero(mass.mass) {
        return;
    }
    for (a, ja) in columns {
        for (b, jb) in columns.range(a..) {
            let product = match dots.get(&(*ja, *jb)) {
                Some(known) => *known,
                None => {
                    let dot = scene.dot(ja, jb);
                    let dot = scene.tidy(dot);
                    dots.insert((*ja, *jb), dot);
                    dot
                }
            };
            if !scene.graph.is_zero(product) {
                sink((*a, *b), product, mass.mass);
            }
        }
    }
}

/// W_a^T I W_b, one component of I at a time so that the components stay in front.
fn rotation(scene: &mut Scene, mass: &Mass, turning: &Columns<Vector>, sink: &mut Sink) {
    let parts = inertia_parts(scene, mass);
    for (a, wa) in turning {
        for (b, wb) in turning.range(a..) {
            for (k, l, component) in &parts {
                let mut product = scene.graph.mul(wa[*k], wb[*l]);
                if k != l {
                    let mirrored = scene.graph.mul(wa[*l], wb[*k]);
                    product = scene.graph.add(product, mirrored);
                }
                let product = scene.tidy(product);
                if !scene.graph.is_zero(product) {
                    sink((*a, *b), product, *component);
                }
            }
        }
    }
}

/// The distinct components of the inertia tensor; off-diagonal ones carry the minus of the tensor.
pub fn inertia_parts(scene: &mut Scene, mass: &Mass) -> Vec<(usize, usize, Expr)> {
    let mut parts = match mass.inertia {
        Inertia::None => vec![],
        Inertia::Planar(zz) => vec![(2, 2, zz)],
        Inertia::Tensor { xx, yy, zz, xy, yz, xz } => {
            let [xy, yz, xz] = [xy, yz, xz].map(|e| scene.graph.neg(e));
            vec![(0, 0, xx), (1, 1, yy), (2, 2, zz), (0, 1, xy), (1, 2, yz), (0, 2, xz)]
        }
    };
    parts.retain(|(_, _, e)| !scene.graph.is_zero(*e));
    // a moment that is the same about all three axes: W_a·W_b contracts as a whole when the components share one factor
    parts
}

/// T as an expression: Σ M_ab q'_a q'_b / 2.
pub fn energy_of(scene: &mut Scene, quadratic: &Quadratic) -> Expr {
    let mut terms = Vec::with_capacity(quadratic.len());
    for ((a, b), entry) in quadratic {
        let factor = if a == b { Rational::HALF } else { Rational::ONE };
        let items = [(*entry, Rational::ONE), (scene.rate(*a), Rational::ONE), (scene.rate(*b), Rational::ONE)];
        terms.push(scene.graph.monomial(factor, &items));
    }
    scene.graph.sum(&terms)
}

/// Σ_bc (∂M_ib/∂q_c - ∂M_bc/∂q_i / 2) q'_b q'_c for every coordinate i.
///
/// Each entry M_ab with derivative D in direction c adds D q'_b q'_c to equation a, D q'_a q'_c to equation b (once if a = b), and
/// takes D q'_a q'_b (half if a = b) from equation c.
pub fn gyroscopic_terms(scene: &mut Scene, quadratic: &Quadratic) -> Vec<Expr> {
    let n = scene.n();
    let mut terms: Vec<Vec<(Expr, Rational)>> = vec![Vec::new(); n];
    for ((a, b), entry) in quadratic {
        for c in scene.directions(*entry) {
            let d = scene.along(*entry, c);
            let d = scene.tidy(d);
            let mut push = |equation: usize, factor: Rational, x: usize, y: usize| {
                if equation < n {
                    let (x, y) = (scene.rate(x), scene.rate(y));
                    let product = scene.graph.product(&[d, x, y]);
                    terms[equation].push((product, factor));
                }
            };
            push(*a, Rational::ONE, *b, c);
            if a != b {
                push(*b, Rational::ONE, *a, c);
            }
            let half = if a == b { Rational::HALF } else { Rational::ONE };
            push(c, -&half, *a, *b);
        }
    }
    terms
        .into_iter()
        .map(|list| {
            let sum = scene.graph.linear(Rational::ZERO, &list);
            scene.tidy(sum)
        })
        .collect()
}

/// Generalized forces: Q_i = -∂Π/∂q_i - ∂Φ/∂q'_i + Q_i applied, as separate sums.
pub struct Forces {
    /// -∂Π/∂q_i.
    pub conservative: Vec<Expr>,
    /// -∂Φ/∂q'_i.
    pub resisting: Vec<Expr>,
    /// Virtual power of the rest.
    pub applied: Vec<Expr>,
}

/// Finds the generalized forces.
pub fn forces(scene: &mut Scene, loads: &Loads) -> Forces {
    let n = scene.n();
    let mut conservative: Vec<Vec<Expr>> = vec![Vec::new(); n];
    for term in &loads.potentials {
        for (j, d) in scene.gradient(term.energy) {
            if j < n {
                let force = scene.graph.neg(d);
                conservative[j].push(force);
            }
        }
    }
    let mut resisting: Vec<Vec<Expr>> = vec![Vec::new(); n];
    for term in &loads.dissipations {
        let rates: Vec<usize> = (0..n).collect();
        let symbols = scene.graph.symbols_in(&[term.energy]);
        for j in rates {
            if symbols.binary_search(&scene.model.coordinates[j].symbols[1]).is_ok() {
                let d = scene.by_rate(term.energy, j);
                let force = scene.graph.neg(d);
                resisting[j].push(force);
            }
        }
    }
    let mut sum = |lists: Vec<Vec<Expr>>| -> Vec<Expr> {
        lists
            .into_iter()
            .map(|l| {
                let e = scene.graph.sum(&l);
                scene.shortest(e)
            })
            .collect()
    };
    let (conservative, resisting) = (sum(conservative), sum(resisting));
    let applied = (0..n)
        .map(|j| {
            let e = Loads::in_direction(scene, &loads.applied, j);
            scene.tidy(e)
        })
        .collect();
    Forces { conservative, resisting, applied }
}
