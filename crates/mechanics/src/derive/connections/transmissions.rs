//! Coordinates that move several bodies at once.
//!
//! A piston placed by a formula of the crank's angle follows the crank, so something drives it: the work of what acts on the piston, in the piston's own
//! displacement, is that of the transmission with opposite sign. Its line of action is that of the rod and stands nowhere, unless the rod is declared.
//! The bodies that a coordinate moves are taken together by the declared reactions that do work in the displacements of two of them; where these leave
//! more than one group, the wrench between the groups is unknown, in size and direction, and whatever depends on it has no value.

use super::connected::Connected;
use super::release::{self, Displacement};
use crate::derive::place::Placer;
use crate::model::FrameId;
use crate::scene::kinematics::Kinematics;
use crate::scene::wrench::Act;
use crate::scene::{Scene, Vector};
use symbolic::connections::Law;

/// Leaves open what moves several bodies by one coordinate and is not declared.
pub fn leave_open(
    scene: &mut Scene,
    kinematics: &mut Kinematics,
    placer: &mut Placer,
    (loads, inertial): (&[Act], &[Act]),
    connected: &Connected,
) {
    let declared: Vec<usize> = (0..connected.reactions.len()).filter(|k| matches!(connected.reactions[*k].law, Law::Support)).collect();
    let others = (0..connected.acts.len()).filter(|k| !declared.contains(k)).flat_map(|k| &connected.acts[k]);
    let acting: Vec<FrameId> = loads.iter().chain(inertial).chain(others).filter_map(|act| act.frame(scene)).collect();
    for j in 0..scene.n() {
        let carries = |f: &FrameId| acting.iter().any(|on| release::chain(scene, *on).contains(f));
        let moved: Vec<FrameId> = placer.moved(j).into_iter().filter(carries).collect();
        let moved: Vec<FrameId> = moved.into_iter().filter(|f| !moves_freely(scene, placer, (*f, j))).collect();
        if moved.len() > 1 && !is_one_group(scene, kinematics, placer, (j, &moved), (connected, &declared)) {
            placer.transmit(scene, kinematics, (j, &moved));
        }
    }
}

/// Whether coordinates that move this body alone give it the same displacement: by their equations of motion nothing drives it along there, though the file may
/// write its place over the other coordinate too (an angle that counts from the ground on a turning arm).
fn moves_freely(scene: &mut Scene, placer: &Placer, (frame, j): (FrameId, usize)) -> bool {
    let Some(own) = placer.own(frame).column(scene, j) else { return false };
    let alone: Vec<usize> = placer.own(frame).coordinates().into_iter().filter(|k| *k != j && placer.moved(*k) == [frame]).collect();
    let zero = scene.zero_vector();
    let part = |(shift, turn): (Vector, Vector)| match (shift == zero, turn == zero) {
        (true, _) => Some((true, turn)),
        (_, true) => Some((false, shift)),
        _ => None,
    };
    let Some((turns, way)) = part(own) else { return false };
    let columns: Vec<(Vector, Vector)> = alone.into_iter().filter_map(|k| placer.own(frame).column(scene, k)).collect();
    let mut ways: Vec<Vector> = columns.into_iter().filter_map(part).filter(|(turn, _)| *turn == turns).map(|(_, way)| way).collect();
    let before = scene.rank(&ways);
    ways.push(way);
    before > 0 && scene.rank(&ways) == before
}

/// Whether declared reactions join all bodies that a coordinate moves.
fn is_one_group(
    scene: &mut Scene,
    kinematics: &Kinematics,
    placer: &Placer,
    (j, moved): (usize, &[FrameId]),
    (connected, declared): (&Connected, &[usize]),
) -> bool {
    let mut group: Vec<usize> = (0..moved.len()).collect();
    for r in declared {
        let mut joined: Option<usize> = None;
        for (i, frame) in moved.iter().enumerate() {
            let Some((shift, turn)) = placer.own(*frame).column(scene, j) else { continue };
            if !release::does_work(scene, kinematics, &connected.acts[*r], (*frame, &Displacement::Own(shift, turn))) {
                continue;
            }
            let (from, to) = (group[i], joined.unwrap_or(group[i]));
            group.iter_mut().filter(|g| **g == from).for_each(|g| *g = to);
            joined = Some(to);
        }
    }
    group.iter().all(|g| *g == group[0])
}
