//! The work of all loads and reactions on virtual displacements of all bodies.
//!
//! Every body is a released one: a joint that the coordinates imply gives it an arbitrary wrench and its carrier the opposite, of which nothing is known but that it does no
//! work where the coordinates let the joint move. So for any change δq, whether it keeps the connections closed or not,
//!
//! ```text
//! Σ_b (F_b·s_b + M_b·w_b) + Σ_j A_j δq_j = Σ_b (p_b'·s_b + L_b'·w_b)
//! ```
//!
//! over all bodies, with the shift s of a body's particle at the origin of the ground and the turn w, both found in numbers from placements at q + τ δq; F and M are the loads and
//! reactions on the body as forces and moments about the origin of the ground, A_j the loads that are given along coordinates, p' and L' momenta differentiated along
//! the motion. Nothing of the derivation of the equations goes in here, neither gradients nor accelerations. Displacements in which a body cannot move by its coordinates are those of
//! [`super::released`].

use algebra::space::{Vector, dot, norm};
use words::Text;

use super::frontier::Frontier;
use super::placements::{BODY, Column, N, Placements, Wrench};
use crate::System;
use crate::dataset::Audit;
use crate::system::Layout;
use algebra::random::Random;

/// Largest residual relative to the terms that meet. A forgotten term is seen at 1e-3 and more.
const LIMIT: f64 = 1e-6;
/// Displacements of one state: of so many coordinates alone, in turn, and of all together at random.
const ALONE: usize = 3;
/// Rounding of a first derivative, in units of the last place of the place over half the stretch.
const ROUNDING: f64 = 4.0 * (N * N) as f64 * f64::EPSILON;
/// Half the stretch of a virtual displacement: radians, or share of the size of the machine.
const REACH: f64 = 0.5;

/// Collects the residual along a motion.
#[derive(Clone, Debug, Default)]
pub(super) struct VirtualWork {
    found: Frontier,
    /// Largest terms of each displacement of a coordinate alone so far.
    largest: Vec<f64>,
    next: usize,
    taken: u64,
}

impl VirtualWork {
    /// Looks at a state with the numbers of its bodies and the rates of their momenta.
    pub(super) fn look<S: System + ?Sized>(
        &mut self,
        (t, x): (f64, &[f64]),
        (layout, placements): (&Layout, &Placements),
        (here, momenta): (&[f64], &[[Vector; 3]]),
        system: &mut S,
    ) {
        let n = layout.along;
        if n == 0 || layout.wrenches != layout.bodies {
            return;
        }
        self.largest.resize(n, 0.0);
        let size = (0..layout.bodies).flat_map(|b| (1..4).map(move |i| here[BODY * b + i].abs())).fold(0.0_f64, f64::max);
        let size = if size > 0.0 { size } else { 1.0 };
        let scale = |j: usize, system: &S| if system.states()[j].unit == "rad" { 1.0 } else { size };
        let mut random = Random::new(self.taken);
        for k in 0..=ALONE.min(n) {
            let alone = (k < ALONE.min(n)).then(|| (self.next + k) % n);
            let way: Vec<f64> = (0..n)
                .map(|j| match alone {
                    Some(i) => {
                        if i == j {
                            scale(j, system)
                        } else {
                            0.0
                        }
                    }
                    None => random.between(-1.0, 1.0) * scale(j, system),
                })
                .collect();
            let beside = |taus: &Column| {
                let place = |tau: f64| x.iter().enumerate().map(|(i, x)| x + tau * way.get(i).unwrap_or(&0.0)).collect();
                let points: Vec<(f64, Vec<f64>)> = taus.iter().map(|tau| (t, place(*tau))).collect();
                system.placements_at(&points)
            };
            let Some(stretch) = placements.stretch(REACH, beside) else { continue };
            let moves: Vec<[Vector; 2]> = (0..layout.bodies).map(|b| placements.moves(&stretch, b)).collect();
            self.note((layout, &way, alone), (here, momenta), &moves, [size, 1.0].map(|s| s * ROUNDING / stretch.half));
        }
        self.next = (self.next + ALONE) % n;
        self.taken += 1;
    }

    fn note(
        &mut self,
        (layout, way, alone): (&Layout, &[f64], Option<usize>),
        (here, momenta): (&[f64], &[[Vector; 3]]),
        moves: &[[Vector; 2]],
        [rounded, turned]: [f64; 2],
    ) {
        let (mut sum, mut size, mut rounding) = (0.0, 0.0, 0.0);
        for (b, [shift, turn]) in moves.iter().enumerate() {
            let own = Wrench::new(layout, here, b);
            let [p, l, noise] = momenta[b];
            sum += dot(own.force, *shift) + dot(own.moment, *turn) - dot(p, *shift) - dot(l, *turn);
            size += own.size(*shift, *turn) + dot(p, *shift).abs() + dot(l, *turn).abs();
            rounding += noise[0] * norm(*shift) + noise[1] * norm(*turn);
            // of the displacement itself: places by the size of the machine, rotations by one
            rounding += rounded * (norm(own.sizes[0]) + norm(p)) + turned * (norm(own.sizes[1]) + norm(l));
        }
        for (along, d) in here[here.len() - 2 * layout.along..].chunks(2).zip(way) {
            sum += along[0] * d;
            size += (along[1] * d).abs();
        }
        let scale = match alone {
            Some(j) => {
                self.largest[j] = self.largest[j].max(size);
                size.max(super::PASSING * self.largest[j])
            }
            None => size,
        };
        self.found.note(sum.abs(), scale.max(rounding / LIMIT));
        self.found.whole(size);
    }

    /// The audit, none without a look.
    pub(super) fn audit(&self, tolerance: f64) -> Option<Audit> {
        let name = Text::new(
            "work of all loads, reactions and inertia forces on virtual displacements of all bodies: largest relative residual",
            "работа всех нагрузок, реакций и сил инерции на возможных перемещениях всех тел: наибольшая относительная невязка",
        );
        (self.taken > 0).then(|| Audit::at_most("virtual_work", name, self.found.worst(), (super::GROWN * tolerance).max(LIMIT)))
    }
}
