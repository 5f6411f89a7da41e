//! A structure as few degrees of freedom: static condensation, named displacements as coordinates, flexibility.
//!
//! Freedoms that carry no inertia follow the others statically, q_s = -K_ss⁻¹ K_sm q_m. Undivided rods with mass take the engineer's hand
//! method: turns of nodes (without an own inertia, not fixed to a rigid rod) follow statically too, so that each rod has the static shape that
//! the displacements of the nodes give it.
//!
//! With named displacements u = Φ q as coordinates, M_u = Φ⁻ᵀ M Φ⁻¹ and the flexibility is D = Φ K⁻¹ Φᵀ: column j is what a unit force
//! along u_j does.

use crate::Fault;
use crate::assembly::Bond;
use crate::constraints::Row;
use crate::freedoms::Freedom;
use crate::{Assembly, Component, Displacement, Frame, RodKind, Scalar, dense, faults};
use words::Quantity;

/// Whether freedoms that carry inertia are condensed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Condensation {
    /// Turns follow statically when no rod is divided.
    #[default]
    Automatic,
    /// Turns follow statically.
    Turns,
    /// Only what carries no inertia.
    Massless,
}

/// Matrices over the coordinates of a structure, row by row.
#[derive(Clone, Debug, Default)]
pub struct Reduced<S> {
    /// Coordinates.
    pub coordinates: Vec<Quantity>,
    /// Whether they are the named displacements.
    pub named: bool,
    /// Whether turns that carry inertia were condensed.
    pub condensed: bool,
    /// M.
    pub mass: Vec<S>,
    /// K.
    pub stiffness: Vec<S>,
    /// D = K⁻¹.
    pub flexibility: Vec<S>,
    /// All independent freedoms over the coordinates, n_q x n.
    pub basis: Vec<S>,
    /// Number of independent freedoms before condensation.
    pub n_q: usize,
}

impl<S: Scalar> Reduced<S> {
    /// Number of coordinates.
    pub fn n(&self) -> usize {
        self.coordinates.len()
    }
}

impl<S: Scalar> Reduced<S> {
    /// The same in the nearest machine numbers.
    pub fn rounded(&self) -> Reduced<f64> {
        let values = |list: &[S]| list.iter().map(S::value).collect();
        Reduced {
            coordinates: self.coordinates.clone(),
            named: self.named,
            condensed: self.condensed,
            mass: values(&self.mass),
            stiffness: values(&self.stiffness),
            flexibility: values(&self.flexibility),
            basis: values(&self.basis),
            n_q: self.n_q,
        }
    }
}

/// The quantity of a named displacement.
pub fn quantity<S>(d: &Displacement<S>) -> Quantity {
    let unit = if matches!(d.component, Component::Turn) { "rad" } else { "m" };
    Quantity { symbol: d.symbol.clone(), label: d.label.clone(), ..Quantity::new(&d.name, unit) }
}

/// What becomes of turns without inertia.
#[derive(Clone, Copy, PartialEq)]
enum Turns {
    Kept,
    Condensed,
}

/// Independent freedoms that stay.
fn masters<S: Scalar>(frame: &Frame<S>, assembly: &Assembly<S>, turns: Turns, massive: &[bool]) -> Vec<usize> {
    let turns = turns == Turns::Condensed;
    let mut firm = vec![false; assembly.freedoms.meaning.len()];
    for part in assembly.freedoms.parts.iter().filter(|p| matches!(frame.rods[p.rod].kind, RodKind::Rigid)) {
        [2, 5].into_iter().for_each(|k| firm[part.freedoms[k]] = true);
    }
    let follows = |i: usize| {
        let freedom = assembly.elimination.free[i];
        match assembly.freedoms.meaning[freedom] {
            Freedom::Node(node, 2) => turns && !firm[freedom] && frame.nodes[node].inertia.is_zero(),
            Freedom::Hinge(..) => turns && !firm[freedom],
            Freedom::Inner(_, _, 2) => turns,
            _ => false,
        }
    };
    (0..assembly.n()).filter(|i| massive[*i] && !follows(*i)).collect()
}

/// Reduces a structure that stands.
///
/// *Errors*: no inertia.
pub fn reduce<S: Scalar>(frame: &Frame<S>, assembly: &Assembly<S>, condensation: Condensation) -> Result<Reduced<S>, Fault> {
    let n_q = assembly.n();
    let (k, m) = (assembly.stiffness(frame).dense(), assembly.mass(frame).dense());
    let massive: Vec<bool> = (0..n_q).map(|i| !m[i * n_q + i].is_zero()).collect();
    if !massive.iter().any(|v| *v) {
        return Err(faults::massless());
    }
    let divided = frame.rods.iter().any(|r| r.divisions > 1);
    let turns = match condensation {
        Condensation::Automatic if divided => Turns::Kept,
        Condensation::Massless => Turns::Kept,
        Condensation::Automatic | Condensation::Turns => Turns::Condensed,
    };
    let all = masters(frame, assembly, Turns::Kept, &massive);
    let mut keep = masters(frame, assembly, turns, &massive);
    if keep.is_empty() {
        keep = all.clone();
    }
    let condensed = keep.len() < all.len();
    let (mut basis, mut stiffness) = condense(frame, &k, n_q, &keep)?;
    let n = keep.len();
    let mut mass = dense::congruence(&m, &basis, n_q, n);
    let mut coordinates: Vec<Quantity> = keep.iter().map(|i| own_quantity(frame, assembly, *i)).collect();
    let functionals: Vec<Vec<S>> = displacements(frame, assembly);
    // displacements that depend on each other are shown, but are no coordinates
    let phi = dense::product(&functionals.concat(), &basis, functionals.len(), n_q, n);
    let inverse = (!divided && functionals.len() == n).then(|| dense::solve(&phi, n, &dense::identity(n), n)).flatten();
    let named = inverse.is_some();
    if let Some(inverse) = inverse {
        basis = dense::product(&basis, &inverse, n_q, n, n);
        mass = dense::congruence(&mass, &inverse, n, n);
        stiffness = dense::congruence(&stiffness, &inverse, n, n);
        coordinates = frame.displacements.iter().map(quantity).collect();
    }
    let flexibility = dense::solve(&stiffness, n, &dense::identity(n), n).ok_or_else(|| extreme(frame))?;
    Ok(Reduced { coordinates, named, condensed, mass, stiffness, flexibility, basis, n_q })
}

/// The functionals of the named displacements over the independent freedoms.
pub fn displacements<S: Scalar>(frame: &Frame<S>, assembly: &Assembly<S>) -> Vec<Vec<S>> {
    let row = |d: &Displacement<S>| -> Row<S> { assembly.functional(frame, &d.place, &d.component) };
    frame.displacements.iter().map(|d| assembly.elimination.pull(&row(d))).collect()
}

fn own_quantity<S: Scalar>(frame: &Frame<S>, assembly: &Assembly<S>, i: usize) -> Quantity {
    let turn = matches!(
        assembly.freedoms.meaning[assembly.elimination.free[i]],
        Freedom::Node(_, 2) | Freedom::Hinge(..) | Freedom::Inner(_, _, 2)
    );
    Quantity::new(&assembly.name(frame, i), if turn { "rad" } else { "m" })
}

/// All independent freedoms over the kept ones, and the stiffness that is left.
fn condense<S: Scalar>(frame: &Frame<S>, k: &[S], n: usize, keep: &[usize]) -> Result<(Vec<S>, Vec<S>), Fault> {
    let m = keep.len();
    let follow: Vec<usize> = (0..n).filter(|i| !keep.contains(i)).collect();
    let pick = |rows: &[usize], columns: &[usize]| -> Vec<S> {
        rows.iter().flat_map(|i| columns.iter().map(move |j| k[i * n + j].clone())).collect()
    };
    let mut basis = vec![S::zero(); n * m];
    keep.iter().enumerate().for_each(|(j, i)| basis[i * m + j] = S::one());
    if !follow.is_empty() {
        let share = dense::solve(&pick(&follow, &follow), follow.len(), &pick(&follow, keep), m).ok_or_else(|| extreme(frame))?;
        for (a, i) in follow.iter().enumerate() {
            (0..m).for_each(|j| basis[i * m + j] = share[a * m + j].neg());
        }
    }
    let stiffness = dense::product(&pick(keep, &(0..n).collect::<Vec<_>>()), &basis, m, n, m);
    Ok((basis, stiffness))
}

/// A structure that stands and whose stiffness is singular all the same.
fn extreme<S: Scalar>(frame: &Frame<S>) -> Fault {
    frame.map(&|s: &S| Some(s.value())).map_or_else(faults::massless, |frame| faults::extreme(&frame))
}

/// Names of constraints, for messages.
pub fn bond_name<S>(frame: &Frame<S>, assembly: &Assembly<S>, bond: Bond) -> Option<String> {
    match bond {
        Bond::Support(i, _) => Some(frame.supports[i].name.clone()),
        Bond::Part(i, _) => Some(frame.rods[assembly.freedoms.parts[i].rod].name.clone()),
        Bond::Idle => None,
    }
}
