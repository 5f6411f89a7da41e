//! A diagram: its branches, and what happens on them.

use super::curve::{Bounds, Curve, FIRST};
use super::locate::{Special, What};
use super::relay;
use super::zeros::{Place, Zeros};
use crate::interrupt::is_set;
use std::sync::atomic::AtomicBool;

/// What is asked of a diagram.
#[derive(Clone, Copy, Debug)]
pub struct Options<'a> {
    /// Least value of the parameter, SI.
    pub from: f64,
    /// Greatest value.
    pub to: f64,
    /// Where it begins.
    pub start: f64,
    /// Most points of a branch.
    pub points: usize,
    /// Most branches.
    pub branches: usize,
    /// The second parameter, over which folds and period doublings are followed.
    pub second: Option<Second>,
    /// Set from outside to end early.
    pub interrupt: Option<&'a AtomicBool>,
}

impl Options<'_> {
    /// Whether the user has interrupted: what is left to follow is left then.
    pub(super) fn is_interrupted(&self) -> bool {
        is_set(self.interrupt)
    }
}

/// A second parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Second {
    /// Least value, SI.
    pub from: f64,
    /// Greatest value.
    pub to: f64,
    /// The value that the branches have, between both.
    pub here: f64,
}

/// What was counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Turns of the motion followed.
    pub turns: usize,
    /// Turns whose variations were followed.
    pub variations: usize,
}

/// A curve of folds or of period doublings.
#[derive(Clone, Debug)]
pub struct Crease {
    /// Folds or period doublings.
    pub what: What,
    /// The special point of the diagram that it begins at.
    pub from: usize,
    /// What is followed, with its ends; the last unknown of its points is the second parameter, the one before it the first. Cusps are among its special points.
    pub curve: Curve,
}

impl Crease {
    /// Both parameters at a point of it, SI.
    pub fn plane(place: &Place) -> [f64; 2] {
        let y = place.unknowns();
        let at = |back: usize| y.len().checked_sub(back).map_or(f64::NAN, |i| y[i]);
        [at(2), at(1)]
    }
}

/// Branches, and what happens on them.
#[derive(Clone, Debug, Default)]
pub struct Diagram {
    /// In the order in which they were followed.
    pub curves: Vec<Curve>,
    /// Special points with the branch and the index of the point of it that lies behind.
    pub special: Vec<(usize, usize, Special)>,
    /// Special points whose other branch was not followed, because there were enough.
    pub left_out: usize,
    /// Hopf points of a machine without damping: the motions that part there are families at each value of the parameter.
    pub families: usize,
    /// Period doublings whose motions have more periods than are followed.
    pub deeper: usize,
    /// Directions in which a branch parts but was not found.
    pub unmet: usize,
    /// Curves of folds and period doublings in the plane of two parameters.
    pub creases: Vec<Crease>,
    /// Folds and period doublings from which no curve was found.
    pub lone: Vec<usize>,
    /// Branches, and points of them before which stability changes without a special point.
    pub unnamed: Vec<(usize, usize)>,
    /// Special points that branches have come to, with the direction from which they came.
    pub(super) joined: Vec<(usize, Vec<f64>)>,
    /// Work done.
    pub work: Work,
}

/// Values of the parameter that are one, as a share of the range: special points are known far better.
pub(super) const SAME: f64 = 1e-6;
/// Unknowns that are one, in scales: those of a branch point are known to the root of what its parameter is.
const ALIKE: f64 = 1e-4;

/// Follows a branch.
pub(super) fn followed(zeros: &mut dyn Zeros, start: Place, options: &Options<'_>, diagram: &Diagram) -> Curve {
    let bounds = Bounds { ranges: &[[options.from, options.to]], points: options.points, interrupt: options.interrupt, first: FIRST };
    relay::walk(zeros, start, bounds, &|special| diagram.known(special).is_some())
}

impl Diagram {
    /// Takes a branch with what happens on it.
    pub(super) fn take(&mut self, mut curve: Curve) {
        let which = self.curves.len();
        self.unnamed.extend(curve.unnamed().into_iter().map(|place| (which, place)));
        for (place, special) in std::mem::take(&mut curve.special) {
            match self.known(&special) {
                None => self.special.push((which, place, special)),
                Some(k) => {
                    let before = &curve.places[place.saturating_sub(1)];
                    self.joined.push((k, before.y.iter().zip(&special.place.y).map(|(a, b)| a - b).collect()));
                }
            }
        }
        self.curves.push(curve);
    }

    /// The special point of another branch that a branch point is, if it is one: that crosses there, or doubles its period; or where it touches the same switch.
    pub(super) fn known(&self, special: &Special) -> Option<usize> {
        let own = &special.place;
        let range = own.local.scales.last().copied().unwrap_or(1.0);
        let alike = |other: &Special| {
            let near = |i: usize| (other.place.y[i] - own.y[i]).abs() <= ALIKE * own.local.scales[i];
            let meets = match special.what {
                What::Grazing => other.what == What::Grazing,
                _ => matches!(other.what, What::Branch | What::Doubling),
            };
            meets
                && other.place.local.states == own.local.states
                && (other.place.parameter() - own.parameter()).abs() <= SAME * range
                && own.local.states.iter().all(|i| near(*i))
        };
        if matches!(special.what, What::Branch | What::Grazing) { self.special.iter().position(|(_, _, other)| alike(other)) } else { None }
    }
}
