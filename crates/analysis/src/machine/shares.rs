//! How contacts and frictions that hold the same motion may share its load: corners of the polyhedron of admissible reactions.
//!
//! Where J has dependent rows, some conditions are left to the others and their reactions are set: 0 for a contact, ± its static limit for a friction. At a
//! corner of the polyhedron
//!
//! ```text
//! λ = λ0 + Z y,     λ_contact ≥ 0,   |F| ≤ μ₀ |N|
//! ```
//!
//! at least as many limits are met as there are directions Z, and those are the ones to be set. A corner is found by a linear programme; that one first at
//! which most is left of the limit that has just been reached. So a load goes over from one support to the next wherever one of them can take it.

use super::Machine;
use super::conditions::{Conditions, Holds};
use super::open::{Acting, Limits};
use crate::rest::admissible::Hold;
use crate::system::{Corner, Corners};
use crate::{GuardKind, Mode};

/// Share of the largest reaction within which a limit is met at a corner.
const MET: f64 = 1e-8;

/// Guards of shares and sides, with their modes.
type Idle = Vec<(usize, Mode)>;

impl Machine {
    /// See [`crate::System::shares`].
    pub(super) fn shares_of_load(&mut self, (t, x): (f64, &[f64]), modes: &[Mode], relieved: &[usize]) -> Option<Corners> {
        let conditions = self.conditions.as_mut()?;
        conditions.evaluate_in((t, x), (modes, &self.bound)).ok()?;
        let rows = conditions.carrying(modes);
        let spare = conditions.spare(&rows);
        let idle: Idle = spare.iter().filter_map(|row| Some((conditions.share_of(*row)?, Mode::Zero))).collect();
        let mut trial = modes.to_vec();
        self.set_idle(&mut trial, &idle);
        let Limits { acting, hold, exact } = self.hold_in((t, x), &trial)?;
        let conditions = self.conditions.as_ref()?;
        let column = |guard: &usize| acting.iter().position(|a| a.guard == Some(*guard));
        let relieved: Vec<usize> = relieved.iter().filter_map(column).collect();
        let corners = hold.corners(&relieved);
        // where more limits are met than have to be, what is about to be unloaded is left to the others, or carries
        let reversed: Vec<usize> = rows.iter().rev().copied().collect();
        let assign = |reactions: &Vec<f64>| [&rows, &reversed].map(|rows| conditions.corner(rows, (&acting, &hold), reactions));
        let mut corners: Vec<Corner> = corners.iter().flat_map(assign).flatten().collect();
        corners.dedup();
        let list = corners.into_iter().map(|corner| Corner { idle: self.with_sides(corner.idle), ..corner }).collect();
        Some(Corners { list, exact })
    }

    /// The forces of these modes, with their limits.
    fn hold_in(&mut self, (t, x): (f64, &[f64]), modes: &[Mode]) -> Option<Limits> {
        self.observing.set(modes, &self.bound);
        self.solve_forces(t, x).ok()?;
        self.limits_of_acting((t, x)).ok()?
    }

    /// Leaves these conditions to others, without a force.
    pub(super) fn set_idle(&self, modes: &mut [Mode], idle: &Idle) {
        for (i, guard) in self.guards.iter().enumerate() {
            match guard.kind {
                GuardKind::Share { .. } => modes[i] = Mode::Positive,
                GuardKind::Side { .. } => modes[i] = Mode::Zero,
                _ => {}
            }
        }
        idle.iter().for_each(|(share, _)| modes[*share] = Mode::Zero);
    }

    /// Shares with the limits at which they stand, as modes of guards.
    fn with_sides(&self, idle: Idle) -> Idle {
        let side = |of: usize| self.guards.iter().position(|g| g.kind == GuardKind::Side { of });
        let mut all = Vec::new();
        for (share, limit) in idle {
            all.push((share, Mode::Zero));
            let GuardKind::Share { of } = self.guards[share].kind else { continue };
            all.extend(side(of).map(|side| (side, limit)));
        }
        all
    }
}

impl Conditions {
    /// Conditions of contacts and frictions that hold in these modes and may be left to others, contacts first.
    pub(super) fn carrying(&self, modes: &[Mode]) -> Vec<usize> {
        let own = |row: &usize| self.holds_in(*row, modes) && self.share_of(*row).is_some();
        let (contacts, others): (Vec<usize>, Vec<usize>) =
            (0..self.rows.len()).filter(own).partition(|row| self.contact_of(*row).is_some());
        contacts.into_iter().chain(others).collect()
    }

    /// Those of the rows, in this order, that repeat the ones before them and what always holds.
    fn spare(&self, rows: &[usize]) -> Vec<usize> {
        let mut kept: Vec<usize> = (0..self.rows.len()).filter(|row| self.rows[*row].holds == Holds::Always).collect();
        let mut rank = self.rank_of(&kept);
        let mut spare = Vec::new();
        for &row in rows {
            kept.push(row);
            let more = self.rank_of(&kept);
            if more > rank {
                rank = more;
            } else {
                kept.pop();
                spare.push(row);
            }
        }
        spare
    }

    /// What is left to others at a corner, with the side of its limit; none where the limits that are met there do not carry that much.
    fn corner(&self, rows: &[usize], (acting, hold): (&[Acting], &Hold), reactions: &[f64]) -> Option<Corner> {
        let size = reactions.iter().fold(0.0_f64, |m, r| m.max(r.abs()));
        let limit = |row: usize| -> Option<Mode> {
            let column = acting.iter().position(|a| Some(a.reaction) == self.rows[row].reaction)?;
            let force = reactions[column];
            if force.abs() <= MET * size {
                return Some(Mode::Zero);
            }
            let most = hold.limit(column, reactions)?;
            (force.abs() >= most - MET * size).then_some(Mode::of(force))
        };
        let met: Vec<Option<Mode>> = rows.iter().map(|row| limit(*row)).collect();
        let ordered = |met_ones: bool| rows.iter().zip(&met).filter(move |(_, m)| m.is_some() == met_ones).map(|(row, _)| *row);
        let spare = self.spare(&ordered(false).chain(ordered(true)).collect::<Vec<_>>());
        let idle = |row: &usize| {
            let place = rows.iter().position(|r| r == row)?;
            Some((self.share_of(*row)?, met[place]?))
        };
        let limits = rows.iter().zip(&met).filter_map(|(row, met)| match (self.rows[*row].holds, met) {
            (Holds::Sticking(guard, _), Some(way)) if *way != Mode::Zero => Some((guard, *way)),
            _ => None,
        });
        Some(Corner { limits: limits.collect(), idle: spare.iter().map(idle).collect::<Option<Idle>>()? })
    }
}
