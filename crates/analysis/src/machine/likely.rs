//! The modes that a machine which cannot be held takes: its contacts and frictions as one complementarity problem in accelerations.
//!
//! ```text
//! a_i = b_i + Σ G_ij λ_j          G_ij = J_i dq''_j, the change under a unit of reaction j, connections kept; b without any of them
//! contact    λ ≥ 0, a ≥ 0, λ a = 0
//! friction   |λ| ≤ μ₀ |N|,  λ = μ |N| sign(a) where a ≠ 0         N follows from all reactions
//! ```
//!
//! Solved by successive projections (Gauss, Seidel): with limits that stand still it is a convex problem, whose accelerations are unique although the reactions are
//! not. What comes out is a suggestion only; the modes that it leads to are tried like any others.

use super::Machine;
use super::bilateral::Bilateral;
use super::conditions::{Conditions, Holds};
use super::open::{Pressed, with_sliding};
use crate::Mode;
use program::Point;

/// Most sweeps: they converge by a ratio each.
const SWEEPS: usize = 4000;
/// Change relative to the largest reaction at which they end: some hundred roundings.
const SETTLED: f64 = 1e-13;
/// Share of the largest reaction or acceleration below which one is none.
const NOTHING: f64 = 1e-9;

/// A contact or friction that takes part.
struct Part {
    guard: usize,
    /// Its acceleration without any of them.
    free: f64,
    /// None of a contact.
    pressed: Option<Pressed>,
    /// Change of all accelerations, and of all reactions, under its unit.
    row: usize,
    reactions: Vec<f64>,
}

impl Machine {
    /// See [`crate::System::likely`].
    pub(super) fn likely_modes(&mut self, (t, x): (f64, &[f64]), modes: &[Mode]) -> Option<Vec<(usize, Mode)>> {
        let rows = {
            let conditions = self.conditions.as_mut()?;
            conditions.evaluate_in((t, x), (modes, &self.bound)).ok()?;
            conditions.carrying(modes)
        };
        let conditions = self.conditions.as_ref()?;
        let mut free = modes.to_vec();
        self.set_idle(&mut free, &rows.iter().filter_map(|row| Some((conditions.share_of(*row)?, Mode::Zero))).collect());
        self.observing.set(&free, &self.bound);
        self.solve_forces(t, x).ok()?;
        let inputs = self.accelerations.clone();
        let touches = self.touches_with((t, x), &inputs, &[])?;
        let mut pressing = self.pressing((t, x), &inputs);
        let laws = self.laws.evaluate(&Point { time: t, states: x, ..Point::default() }).ok()?.to_vec();
        let n = self.bound.program().coordinates;
        let conditions = self.conditions.as_mut()?;
        let sliding = conditions.sliding(modes, (&laws, &inputs[n..]), &self.sharing);
        let bilateral = Bilateral::new(conditions, t).ok()?;
        let still = bilateral.unmoved();
        let (mut parts, mut changes) = (Vec::new(), Vec::new());
        for row in rows {
            let reaction = conditions.rows[row].reaction?;
            let place = self.touching.iter().position(|place| place.reaction == reaction)?;
            let way = with_sliding(reaction, conditions.reactions, &sliding);
            let mut force = vec![0.0; n];
            for (r, share) in way.iter().enumerate().filter(|(_, share)| **share != 0.0) {
                force.iter_mut().zip(conditions.push(r)).for_each(|(sum, f)| *sum += share * f);
            }
            let (change, mut reactions) = bilateral.response(conditions, &force, &still).ok()?;
            reactions.iter_mut().zip(&way).for_each(|(sum, own)| *sum += own);
            let pressed = match conditions.rows[row].holds {
                Holds::Closed(..) => None,
                Holds::Sticking(..) => {
                    let own = pressing.iter().position(|(r, _)| *r == reaction)?;
                    Some(pressing.swap_remove(own).1)
                }
                Holds::Always | Holds::Rough(_) => return None,
            };
            parts.push(Part { guard: touches[place].guard, free: touches[place].acceleration[0], pressed, row, reactions });
            changes.push(change);
        }
        solve(&parts, &couplings(conditions, &parts, &changes))
    }
}

/// G, row by row.
fn couplings(conditions: &Conditions, parts: &[Part], changes: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let dot = |row: usize, change: &Vec<f64>| conditions.column(row).iter().zip(change).map(|(j, v)| j * v).sum::<f64>();
    parts.iter().map(|part| changes.iter().map(|change| dot(part.row, change)).collect()).collect()
}

/// Modes of the parts; none where nothing settles.
fn solve(parts: &[Part], coupling: &[Vec<f64>]) -> Option<Vec<(usize, Mode)>> {
    let count = parts.len();
    let mut forces = vec![0.0; count];
    let mut slides = vec![false; count];
    let acceleration = |i: usize, forces: &[f64]| parts[i].free + coupling[i].iter().zip(forces).map(|(g, p)| g * p).sum::<f64>();
    let limit = |part: &Pressed, slides: bool, reaction: &dyn Fn(usize) -> f64| {
        let normal = part.normal + part.terms.iter().enumerate().filter(|(_, f)| **f != 0.0).map(|(r, f)| f * reaction(r)).sum::<f64>();
        normal.abs() * if slides { part.kinetic } else { part.fixed }
    };
    for _ in 0..SWEEPS {
        let mut moved = 0.0_f64;
        for i in 0..count {
            let own = coupling[i][i];
            if own == 0.0 {
                continue;
            }
            let wanted = forces[i] - acceleration(i, &forces) / own;
            let next = match &parts[i].pressed {
                None => wanted.max(0.0),
                Some(pressed) => {
                    let reaction = |r: usize| parts.iter().zip(&forces).map(|(part, p)| part.reactions[r] * p).sum::<f64>();
                    let most = limit(pressed, slides[i], &reaction);
                    slides[i] = wanted.abs() > most;
                    wanted.clamp(-most, most)
                }
            };
            moved = moved.max((next - forces[i]).abs());
            forces[i] = next;
        }
        if moved <= SETTLED * forces.iter().fold(0.0_f64, |m, p| m.max(p.abs())) {
            break;
        }
    }
    let accelerations: Vec<f64> = (0..count).map(|i| acceleration(i, &forces)).collect();
    let largest = |list: &[f64]| list.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let (strongest, fastest) = (largest(&forces), largest(&accelerations).max(largest(&parts.iter().map(|p| p.free).collect::<Vec<_>>())));
    let moves = |i: usize| accelerations[i].abs() > NOTHING * fastest;
    let mode = |i: usize| match parts[i].pressed {
        None if forces[i] <= NOTHING * strongest && accelerations[i] > 0.0 && moves(i) => Mode::Positive,
        Some(_) if slides[i] && moves(i) => Mode::of(accelerations[i]),
        _ => Mode::Zero,
    };
    (fastest.is_finite() && strongest.is_finite()).then(|| (0..count).map(|i| (parts[i].guard, mode(i))).collect())
}
