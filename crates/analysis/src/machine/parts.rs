//! One blow as a complementarity problem: a contact rebounds or takes no impulse, a friction sticks or slides.
//!
//! Each combination of such parts is a linear system; what its solution contradicts is exchanged, at last all combinations are tried.

use super::strike::{Goal, Law, Pressure, SILENT, Strike};
use algebra::lu::Lu;

/// Most combinations of a blow that are tried one by one.
const COMBINED: usize = 20_000;
/// Rounding of rates and impulses of a blow.
const SLACK: f64 = 1e-10;

/// Most repetitions for the direction of a normal impulse, and where they end.
const TURNS: usize = 200;
// some units of the last place of a direction
const TURNED: f64 = 1e-15;
/// What a unit does in a blow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Part {
    /// The contact rebounds by its law, the friction sticks.
    Held,
    /// The contact takes no impulse.
    Out,
    /// The friction slides; sign of its impulse by that of the normal impulse.
    Slides(f64),
}

impl Strike {
    /// Impulses of a blow: rebound and sticking first, then what the result asks for, then all combinations.
    pub(super) fn solve(&self, set: &[usize], goal: &[Goal]) -> Option<Vec<f64>> {
        let mut parts = vec![Part::Held; set.len()];
        let mut tried: Vec<Vec<Part>> = Vec::new();
        while !tried.contains(&parts) && tried.len() < 8 * set.len() + 8 {
            tried.push(parts.clone());
            let Some(impulses) = self.impulses_of((set, goal), &parts) else { break };
            match self.objection((set, goal), &parts, &impulses) {
                None => return Some(impulses),
                Some((k, part)) => parts[k] = part,
            }
        }
        let options = |k: usize| match self.units[set[k]].law {
            Law::Contact { .. } => 2,
            Law::Friction { .. } => 3,
            Law::Rough => 1,
        };
        let total = (0..set.len()).try_fold(1_usize, |product, k| product.checked_mul(options(k)).filter(|p| *p <= COMBINED))?;
        (0..total).find_map(|code| {
            let mut digits = code;
            for (k, part) in parts.iter_mut().enumerate() {
                *part = match (digits % options(k), self.is_contact(set[k])) {
                    (0, _) => Part::Held,
                    (_, true) => Part::Out,
                    (1, false) => Part::Slides(1.0),
                    _ => Part::Slides(-1.0),
                };
                digits /= options(k);
            }
            self.impulses_of((set, goal), &parts).filter(|impulses| self.objection((set, goal), &parts, impulses).is_none())
        })
    }

    /// Impulses in given parts; none where these repeat each other. Directions of normal impulses with two components are repeated until they stay.
    pub(super) fn impulses_of(&self, (set, goal): (&[usize], &[Goal]), parts: &[Part]) -> Option<Vec<f64>> {
        let mut along = vec![[1.0, 0.0]; set.len()];
        for _ in 0..TURNS {
            let impulses = self.impulses_along((set, goal), parts, &along)?;
            let next: Vec<Pressure> = set.iter().map(|&i| self.direction(i, self.pressed(i, set, &impulses))).collect();
            let turn = along.iter().zip(&next).fold(0.0_f64, |m, (a, b)| m.max((a[0] - b[0]).abs()).max((a[1] - b[1]).abs()));
            if turn <= TURNED {
                return Some(impulses);
            }
            along = next;
        }
        None
    }

    /// Unit vector of a normal impulse; one component alone keeps its axis.
    fn direction(&self, i: usize, pressed: Pressure) -> Pressure {
        let size = algebra::elementary::hypot(pressed[0], pressed[1]);
        match &self.units[i].law {
            Law::Friction { normal, .. } if !normal[1].is_empty() && size > 0.0 => pressed.map(|p| p / size),
            _ => [1.0, 0.0],
        }
    }

    /// Normal impulse of a friction.
    pub(super) fn pressed(&self, i: usize, set: &[usize], impulses: &[f64]) -> Pressure {
        let count = self.units.len();
        let part = |axis: usize| set.iter().zip(impulses).map(|(&j, p)| self.pressure[i * count + j][axis] * p).sum::<f64>();
        [0, 1].map(|axis| self.carried[i][axis] + part(axis))
    }

    /// The same along its direction.
    pub(super) fn normal(&self, i: usize, set: &[usize], impulses: &[f64]) -> f64 {
        let pressed = self.pressed(i, set, impulses);
        let along = self.direction(i, pressed);
        along[0] * pressed[0] + along[1] * pressed[1]
    }

    fn impulses_along(&self, (set, goal): (&[usize], &[Goal]), parts: &[Part], along: &[Pressure]) -> Option<Vec<f64>> {
        let (count, size) = (self.units.len(), set.len());
        let mut matrix = vec![0.0; size * size];
        let mut right = vec![0.0; size];
        for (k, (&i, part)) in set.iter().zip(parts).enumerate() {
            let row = &mut matrix[k * size..(k + 1) * size];
            match (part, &self.units[i].law) {
                (Part::Held, _) => {
                    row.iter_mut().zip(set).for_each(|(a, &j)| *a = self.coupling[i * count + j]);
                    right[k] = goal[k].change;
                }
                (Part::Slides(sign), Law::Friction { kinetic, .. }) => {
                    let normal = |j: usize| along[k][0] * self.pressure[i * count + j][0] + along[k][1] * self.pressure[i * count + j][1];
                    row.iter_mut().zip(set).for_each(|(a, &j)| *a = -sign * kinetic * normal(j));
                    row[k] += 1.0;
                    right[k] = sign * kinetic * (along[k][0] * self.carried[i][0] + along[k][1] * self.carried[i][1]);
                }
                _ => {
                    row[k] = 1.0;
                    right[k] = goal[k].impulse;
                }
            }
        }
        Lu::new(&matrix, size).solve(&right)
    }

    /// The part that violates its law most, and what it should be instead.
    fn objection(&self, (set, goal): (&[usize], &[Goal]), parts: &[Part], impulses: &[f64]) -> Option<(usize, Part)> {
        let count = self.units.len();
        let sum = |i: usize| set.iter().zip(impulses).map(|(&j, p)| self.coupling[i * count + j] * p).sum::<f64>();
        let terms = |i: usize| set.iter().zip(impulses).map(|(&j, p)| (self.coupling[i * count + j] * p).abs()).sum::<f64>();
        let largest = impulses.iter().fold(0.0_f64, |m, p| m.max(p.abs()));
        let mut worst: Option<(usize, Part, f64)> = None;
        for (k, (&i, part)) in set.iter().zip(parts).enumerate() {
            let after = self.rates[i] + sum(i);
            let size = self.rates[i].abs() + terms(i);
            let (excess, instead) = match (part, &self.units[i].law) {
                (_, Law::Rough) => continue,
                (Part::Held, Law::Contact { .. }) => ((goal[k].impulse - impulses[k]) / largest, Part::Out),
                (_, Law::Contact { .. }) => ((goal[k].rate - after) / size, Part::Held),
                (Part::Held, Law::Friction { kinetic, fixed, .. }) => {
                    let still = self.rates[i].abs() <= SILENT * self.sizes[i];
                    let pressed = self.normal(i, set, impulses);
                    let limit = if still { fixed } else { kinetic } * pressed.abs();
                    let positive = impulses[k] * pressed >= 0.0;
                    ((impulses[k].abs() - limit) / largest, Part::Slides(if positive { 1.0 } else { -1.0 }))
                }
                // what nothing presses gives nothing
                (_, Law::Friction { .. }) if impulses[k].abs() <= SLACK * largest => continue,
                // friction acts against the sliding that it leaves, beside the rebound that it would give
                (_, Law::Friction { .. }) => (-(after - goal[k].rate) * impulses[k].signum() / size, Part::Held),
            };
            if excess > SLACK && worst.is_none_or(|(_, _, most)| excess > most) {
                worst = Some((k, instead, excess));
            }
        }
        worst.map(|(k, part, _)| (k, part))
    }
}
