//! The parts of Lagrange's equations.

use super::connections::Connected;
use super::lagrange::{self, Kinetic, Quadratic};
use super::loads::Loads;
use crate::scene::Scene;
use symbolic::equations::Equality;
use symbolic::{Expr, Matrix};
use words::Text;

/// Above this number of nodes in one equation, formulas are not written out.
const LONGEST_SHOWN: usize = 1500;

/// The parts of Lagrange's equations, Σ M_ij q''_j + gyroscopic = conservative + resisting + applied.
pub(super) struct Motion {
    pub(super) mass: Quadratic,
    pub(super) gyroscopic: Vec<Expr>,
    pub(super) forces: lagrange::Forces,
    /// Generalized forces of reactions.
    pub(super) reactions: Vec<Expr>,
}

impl Motion {
    pub(super) fn new(scene: &mut Scene, kinetic: &Kinetic, loads: &Loads, connected: &Connected) -> Motion {
        let gyroscopic = lagrange::gyroscopic_terms(scene, &kinetic.total);
        let reactions = (0..scene.n()).map(|j| connected.force(scene, j)).collect();
        Motion { mass: kinetic.total.clone(), gyroscopic, forces: lagrange::forces(scene, loads), reactions }
    }

    pub(super) fn entry(&self, i: usize, j: usize) -> Option<Expr> {
        self.mass.get(&(i.min(j), i.max(j))).copied()
    }

    pub(super) fn mass_matrix(&self, scene: &mut Scene) -> Matrix {
        let n = scene.n();
        let mut mass = Matrix::zeros(&mut scene.graph, n, n);
        for ((a, b), e) in self.mass.range(..(n, 0)).filter(|((_, b), _)| *b < n) {
            mass.set(*a, *b, *e);
            mass.set(*b, *a, *e);
        }
        mass
    }

    pub(super) fn right_side(&self, scene: &mut Scene, i: usize) -> Expr {
        let inertial = scene.graph.neg(self.gyroscopic[i]);
        scene.graph.sum(&[inertial, self.forces.conservative[i], self.forces.resisting[i], self.forces.applied[i]])
    }

    pub(super) fn right_sides(&self, scene: &mut Scene) -> Vec<Expr> {
        (0..scene.n()).map(|i| self.right_side(scene, i)).collect()
    }

    /// Σ M_ij q''_j = right side, for every coordinate, unless that is too long to read.
    pub(super) fn textbook(&self, scene: &mut Scene) -> Result<Vec<Equality>, Text> {
        let n = scene.n();
        let mut equalities = Vec::with_capacity(n);
        for i in 0..n {
            let mut terms = Vec::new();
            for j in 0..n {
                if let Some(entry) = self.entry(i, j) {
                    terms.push(scene.graph.mul(entry, scene.q[j][2]));
                }
            }
            let left = scene.graph.sum(&terms);
            let right = self.right_side(scene, i);
            let right = scene.graph.add(right, self.reactions[i]);
            let size = scene.graph.reachable(&[left, right]).len();
            if size > LONGEST_SHOWN {
                return Err(Text::new(
                    format!("equation {} is not written out: it has {size} parts", i + 1),
                    format!("уравнение {} не выписано: в нём {size} частей", i + 1),
                ));
            }
            equalities.push(Equality { left, right });
        }
        Ok(equalities)
    }
}
