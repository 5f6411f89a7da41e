//! What is known of a scheme while it is drawn.

use super::ends::Ends;
use super::groups::Groups;
use super::letters::Letters;
use super::looks::Look;
use super::numbers::{Instant, Numbers, Pose, STILL, V3};
use super::pinned::Pin;
use super::stage::Stage;
use crate::machine::Machine;
use report::Scheme;
use report::scheme::{LabelText, P, Rides};
use words::Language;

/// A rectangle that stands for a group.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    pub center: P,
    pub half: [f64; 2],
    pub turn: f64,
}

/// Something that acts along a pathway.
#[derive(Clone, Debug)]
pub(super) struct Act {
    /// Its place in the file.
    pub path: String,
    pub table: &'static str,
    /// Number in its list: elements, or connections.
    pub index: usize,
    pub ends: Ends,
    /// The letter of one that is given by an energy or a dissipation function.
    pub letter: Option<LabelText>,
}

pub(super) struct Sketch<'a> {
    pub machine: &'a Machine,
    pub language: Language,
    pub numbers: Numbers,
    pub at: &'a Instant,
    pub groups: Groups,
    pub looks: Vec<Look>,
    pub stage: Stage,
    pub letters: Letters<'a>,
    pub scheme: Scheme,
    pub acts: Vec<Act>,
    /// Hinges that follow from formulas.
    pub pins: Vec<Pin>,
    pub blocks: Vec<Option<Block>>,
    /// Where hinges stand already.
    pub hinges: Vec<P>,
    /// Middles of groups that are drawn elsewhere than they are.
    pub origins: Vec<(usize, P)>,
    /// What carries what is drawn next: groups by their numbers, then `more`.
    pub rides: Rides,
    /// What else carries something besides groups.
    pub more: Vec<Carrier>,
    /// Whether labels belong to the place that is drawn.
    pub signing: bool,
    /// Poses of all frames in the course of a motion; none for a single place.
    pub course: Vec<Vec<Pose>>,
}

/// What carries something besides the groups themselves.
#[derive(Clone, Debug)]
pub(super) enum Carrier {
    /// The far end of an act, which moves in a given way: the act, its direction, the number of its carrier without that way.
    Driven { act: usize, direction: V3, of: usize },
    /// The rim of a disc that is seen from the side: its group, half of its height.
    Rim { group: usize, half: f64 },
    /// A point of a group of a machine in space.
    Point { group: usize, at: V3 },
    /// A point of a rim, as the axis of the wheel leans: that the wheel turns about it is not seen.
    Lean { group: usize, center: V3, axis: V3, at: V3 },
}

impl Block {
    /// Distance from the centre to the edge in a direction.
    pub fn reach(&self, turn: f64) -> f64 {
        let (c, s) = ((turn - self.turn).cos().abs(), (turn - self.turn).sin().abs());
        let along = |half: f64, c: f64| if c < STILL { f64::INFINITY } else { half / c };
        along(self.half[0], c).min(along(self.half[1], s))
    }
}
