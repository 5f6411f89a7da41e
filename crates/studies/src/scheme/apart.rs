//! Wheels of a belt, a chain or a gear whose file gives them no places: they all begin at the origin and would be drawn in one another. The picture shows them
//! beside each other, wheels of a gear as far as they mesh.

use super::groups::{Groups, Joint};
use super::numbers::{Numbers, STILL, V3, minus, norm, plus};
use crate::connections::{Pair, pairs};
use crate::machine::Machine;
use crate::shown::{Role, role};

/// Distance of the axes of a belt, in sums of its radii.
const AWAY: f64 = 1.7;

/// Adds the shifts of such wheels, with all that they carry, m.
pub(super) fn apart(machine: &Machine, (groups, numbers): (&Groups, &Numbers), shifts: &mut [V3]) {
    let model = &machine.model;
    let mut placed = vec![false; groups.all.len()];
    for (table, Pair { between, radii, opposite }) in pairs(model) {
        let gear = role(table) == Role::Gear;
        let [a, b] = between.map(|f| groups.of(f));
        let bare = |g: usize| groups.all[g].joint == Joint::Turns && groups.all[g].carrier == 0;
        if a == b || !bare(a) || !bare(b) || gear && !opposite {
            continue;
        }
        let at = |k: usize, g: usize| plus(numbers.frames[0][between[k].index()].origin, 1.0, shifts[g]);
        let (from, to) = (at(0, a), at(1, b));
        let sum: f64 = radii.iter().map(|e| numbers.value(machine, *e).abs()).sum();
        if norm(minus(from, to)) > STILL || !sum.is_finite() {
            placed[a] = true;
            placed[b] = true;
            continue;
        }
        let distance = if gear { sum } else { AWAY * sum };
        let (moved, by) = if placed[b] && !placed[a] { (a, -distance) } else { (b, distance) };
        placed[a] = true;
        placed[b] = true;
        for (i, shift) in shifts.iter_mut().enumerate().skip(1) {
            let mut carrier = i;
            while carrier != moved && carrier != 0 {
                carrier = groups.all[carrier].carrier;
            }
            if carrier == moved {
                shift[0] += by;
            }
        }
    }
}
