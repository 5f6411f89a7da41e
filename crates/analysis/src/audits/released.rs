//! The balances of released bodies along the motion, made anew from placements.
//!
//! Reactions of hidden directions follow from balances whose accelerations are expressions. Here nothing of these is used: centres r and rotations R of all
//! bodies are taken at Chebyshev's points of a stretch about the middle of a step, short enough to resolve them, and differentiated in numbers, twice,
//!
//! ```text
//! p = m r',   L = r × p + R I Rᵀ ω,   ω from R' Rᵀ,   about the origin of the ground
//! ```
//!
//! and in every displacement (shift s of the frame's origin o, turn w) in which a released frame with all that stands on it must balance,
//!
//! ```text
//! Σ F·(s - w × o) + Σ M·w = Σ p'·(s - w × o) + Σ L'·w
//! ```
//!
//! F and M are all loads and reactions with their moment about the origin of the ground, another point than that of the balances. A reaction from which a load or an
//! inertia force was left out breaks it.

use algebra::space::{Vector, cross, dot, minus, norm};
use words::Text;

use super::frontier::Frontier;
use super::placements::{BODY, Column, N, Placements, Wrench};
use super::sampling::Sampling;
use super::virtual_work::VirtualWork;
use crate::dataset::Audit;
use crate::integrate::Step;
use crate::system::Layout;
use crate::{Mode, System};

/// Largest residual relative to the terms that meet. A forgotten term is seen at 1e-3 and more.
const LIMIT: f64 = 1e-6;
/// Samples before every second one is dropped.
const SAMPLES: u64 = 8;

/// Collects the residual along a motion.
#[derive(Clone, Debug)]
pub struct ReleasedBalance {
    layout: Layout,
    found: Frontier,
    /// Largest terms of each displacement so far.
    largest: Vec<f64>,
    strongest: f64,
    sampling: Sampling,
    placements: Placements,
    work: VirtualWork,
}

/// Terms of one displacement.
struct Terms {
    residual: f64,
    size: f64,
    rounding: f64,
}

impl ReleasedBalance {
    /// For a system.
    pub fn new<S: System + ?Sized>(system: &S) -> ReleasedBalance {
        let layout = system.layout();
        let mut sampling = Sampling::new(SAMPLES);
        if layout.wrenches + layout.along == 0 {
            sampling.give_up();
        }
        let placements = Placements::new(layout.bodies);
        let found = Frontier::default();
        ReleasedBalance { layout, found, largest: Vec::new(), strongest: 0.0, sampling, placements, work: VirtualWork::default() }
    }

    /// Counts a step that would not be looked at; false where it is to be looked at.
    pub(crate) fn passes_over(&mut self) -> bool {
        self.sampling.passes_over()
    }

    /// Looks at the middle of a step; at every one of the first, then at every second, fourth, ...
    pub fn look<S: System + ?Sized>(&mut self, step: &Step, system: &mut S) {
        if !self.sampling.takes() || step.length == 0.0 || step.change.is_some() {
            return;
        }
        let middle = 0.5 * step.length;
        let Some(stretch) = self.placements.stretch(middle, |after| self.nodes(step, after.map(|after| middle + after), system)) else {
            return;
        };
        let t = step.instant(middle).high;
        let momenta: Vec<[Vector; 3]> = (0..self.layout.bodies).map(|b| self.placements.rates(&stretch, (t, b))).collect();
        let here = &stretch.nodes[N / 2];
        let terms = self.terms(here, &momenta);
        let mut x = vec![0.0; system.states().len()];
        step.state_after(middle, &mut x);
        self.work.look((t, &x), (&self.layout, &self.placements), (here, &momenta), system);
        self.largest.resize(terms.len(), 0.0);
        for (term, largest) in terms.iter().zip(&mut self.largest) {
            *largest = largest.max(term.size);
            self.found.note(term.residual, term.size.max(super::PASSING * *largest).max(term.rounding / LIMIT));
            self.strongest = self.strongest.max(term.size);
        }
        self.found.whole(self.strongest);
        self.sampling.note();
    }

    fn terms(&self, here: &[f64], momenta: &[[Vector; 3]]) -> Vec<Terms> {
        let mut at = BODY * self.layout.bodies;
        let mut take = || -> Vector {
            at += 3;
            [here[at - 3], here[at - 2], here[at - 1]]
        };
        let mut list = Vec::new();
        for (bodies, ways) in &self.layout.frames {
            let (origin, force, moment) = (take(), take(), take());
            for _ in 0..*ways {
                let (shift, turn) = (take(), take());
                let shift = minus(shift, cross(turn, origin));
                let (f, m) = (dot(force, shift), dot(moment, turn));
                let (mut residual, mut size, mut rounding) = (f + m, f.abs() + m.abs(), 0.0);
                for &b in bodies {
                    let [p, l, noise] = momenta[b];
                    // loads of one body may cancel in its resultant
                    size += Wrench::new(&self.layout, here, b).size(shift, turn);
                    let (linear, angular) = (dot(p, shift), dot(l, turn));
                    residual -= linear + angular;
                    size += linear.abs() + angular.abs();
                    rounding += noise[0] * norm(shift) + noise[1] * norm(turn);
                }
                list.push(Terms { residual: residual.abs(), size, rounding });
            }
        }
        list
    }

    fn nodes<S: System + ?Sized>(&self, step: &Step, afters: Column, system: &mut S) -> Option<Vec<Vec<f64>>> {
        let n = system.states().len();
        let point = |after: f64| {
            let mut x = vec![0.0; n];
            step.state_after(after, &mut x);
            (step.instant(after).high, x)
        };
        // loads and reactions are asked for in the middle only
        let mut points: Vec<(f64, Vec<f64>)> = afters.iter().map(|after| point(*after)).collect();
        let (t, x) = points.remove(N / 2);
        let mut nodes = system.placements_at(&points)?;
        let mut rates = vec![0.0; n];
        step.rate_after(afters[N / 2], &mut rates);
        let q = system.n_coordinates();
        let modes: &[Mode] = &step.modes;
        nodes.insert(N / 2, system.released(t, &x, &rates[q..2 * q], modes)?);
        Some(nodes)
    }

    /// The audits: of released bodies where a reaction is hidden, of virtual work wherever bodies are known.
    pub fn audits(&self, tolerance: f64) -> Vec<Audit> {
        let work = self.work.audit(tolerance).filter(|_| self.sampling.is_known());
        self.released(tolerance).into_iter().chain(work).collect()
    }

    fn released(&self, tolerance: f64) -> Option<Audit> {
        let name = Text::new(
            "momentum and angular momentum of released bodies, from their placements: largest relative residual",
            "количество движения и кинетический момент освобождённых тел по их положениям: наибольшая относительная невязка",
        );
        (self.sampling.has_seen() && !self.layout.frames.is_empty())
            .then(|| Audit::at_most("released_balance", name, self.found.worst(), (super::GROWN * tolerance).max(LIMIT)))
    }
}
