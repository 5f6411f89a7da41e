//! From metres to the picture: the directions that are seen, one scale for all, and shifts of groups that would lie on each other.

use super::numbers::{STILL, V3, dot, plus};
use report::scheme::{P, S};
use std::cell::RefCell;

/// Largest width and height of the mechanism, without its supports and labels.
const ROOM: P = [470.0, 330.0];

/// How places become pixels.
#[derive(Clone, Debug)]
pub struct Stage {
    /// What is seen to the right and upwards.
    pub axes: [V3; 2],
    /// Pixels per metre.
    pub scale: f64,
    /// Shift of each group, pixels.
    pub shift: Vec<P>,
    /// Shift of each group that stands far away, metres.
    pub nearer: Vec<V3>,
    /// Places that were asked for with their groups: what is drawn at one of them is known again.
    known: RefCell<Vec<(P, usize, V3)>>,
}

impl Stage {
    /// A scale with which these points fill the room.
    pub fn new(axes: [V3; 2], points: &[V3], nearer: Vec<V3>) -> Stage {
        let groups = nearer.len();
        let flat: Vec<P> =
            points.iter().map(|p| [dot(axes[0], *p), dot(axes[1], *p)]).filter(|p| p[0].is_finite() && p[1].is_finite()).collect();
        let span = |k: usize| {
            let (low, high) = flat.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p[k]), h.max(p[k])));
            (high - low).max(0.0)
        };
        let fits: Vec<f64> = [0, 1].into_iter().filter(|k| span(*k) > 0.0).map(|k| ROOM[k] / span(k)).collect();
        let scale = fits.into_iter().fold(f64::INFINITY, f64::min);
        Stage {
            axes,
            scale: if scale.is_finite() { scale } else { 10.0 * S },
            shift: vec![[0.0; 2]; groups],
            nearer,
            known: RefCell::default(),
        }
    }

    /// Where a point of a group is.
    pub fn at(&self, group: usize, p: V3) -> P {
        let place = self.place(group, p);
        self.known.borrow_mut().push((place, group, p));
        place
    }

    /// The point of a group that is drawn at a place; rather one of this group.
    pub fn point(&self, place: P, group: usize) -> Option<(usize, V3)> {
        let known = self.known.borrow();
        let there = || known.iter().filter(|k| k.0 == place).map(|k| (k.1, k.2));
        there().find(|k| k.0 == group).or_else(|| there().find(|k| k.0 > 0))
    }

    /// The point of a group that is drawn nearest to a place.
    pub fn nearest(&self, place: P, group: usize) -> Option<V3> {
        let known = self.known.borrow();
        let off = |p: P| (p[0] - place[0]).hypot(p[1] - place[1]);
        known.iter().filter(|k| k.1 == group).min_by(|a, b| off(a.0).total_cmp(&off(b.0))).map(|k| k.2)
    }

    /// The same, without a note of it.
    pub fn place(&self, group: usize, p: V3) -> P {
        let shift = self.shift.get(group).copied().unwrap_or_default();
        let p = plus(p, 1.0, self.nearer.get(group).copied().unwrap_or_default());
        [self.scale * dot(self.axes[0], p) + shift[0], -self.scale * dot(self.axes[1], p) + shift[1]]
    }

    /// The direction in which a vector is seen, rad; none where it is seen as a point.
    pub fn turn(&self, v: V3) -> Option<f64> {
        let (x, y) = (dot(self.axes[0], v), dot(self.axes[1], v));
        (x.hypot(y) > STILL).then(|| y.atan2(x))
    }
}
