//! Least and greatest values along the way, between the places of the table too.
//!
//! Every quantity is a curve over the leading coordinate. It is replaced by polynomials through its values at Chebyshev's points ([`crate::proxies::proxy`]); the
//! place of a value comes from the nearest place of the table. Extremes lie at the ends and where the derivative of a polynomial vanishes.

use crate::fault::codes;
use std::sync::Arc;

use program::Behind;

use super::stand::Stand;
use super::walk::{Observer, Place, Walk};
use crate::dataset::Extreme;
use crate::marks::course::Course;
use crate::proxies::proxy::{Proxies, Source};

/// Places that are kept along the whole way.
const MOST: f64 = 2e4;
/// Pieces of a quantity that may fail: a kink takes about a hundred.
const PIECES: i64 = 600;

/// Extremes of all quantities of the observer; those that could not be followed everywhere are left out.
pub(super) fn extremes(walk: &mut Walk, stands: &[Stand], observer: &mut dyn Observer, rows: (&[Place], &[f64])) -> Vec<Extreme> {
    let (Some(first), Some(last)) = (stands.first(), stands.last()) else { return Vec::new() };
    let count = observer.count();
    let mut course = Course::new(count, Proxies::sparing(PIECES, count));
    // places of the table count exactly, also those that can be passed and not stood on
    for (place, s) in rows.0.iter().zip(rows.1) {
        let values = observer.values(place);
        (0..count).for_each(|k| course.offer(k, *s, values[k]));
    }
    let (from, span) = (first.s, last.s - first.s);
    let sign = span.signum();
    let spacing = walk.linkage.stride().max(span.abs() / MOST);
    let mut curve = Curve { walk, stands: stands.to_vec(), spacing, observer, from, sign };
    course.add(&mut curve, span.abs(), &|tau| from + sign * tau);
    course.found()
}

/// The quantities over the way from its first place.
struct Curve<'c, 'w, 'e> {
    walk: &'c mut Walk<'w, 'e>,
    /// Places that values have been wanted at, in the order of the way: from the table alone the way to each value would grow with the range.
    stands: Vec<Stand>,
    /// Places nearer than this to a known one are not kept.
    spacing: f64,
    observer: &'c mut dyn Observer,
    from: f64,
    sign: f64,
}

impl Curve<'_, '_, '_> {
    fn place(&mut self, s: f64) -> Option<Place> {
        let after = self.stands.partition_point(|stand| (stand.s - s) * self.sign < 0.0).min(self.stands.len() - 1);
        let before = after.saturating_sub(1);
        let near = |k: usize| (self.stands[k].s - s).abs();
        let nearest = if near(before) < near(after) { before } else { after };
        let new = near(nearest) > self.spacing;
        let nearest = self.stands[nearest].clone();
        match self.walk.at(&nearest, s) {
            Err(fault) if fault.code == codes::BRANCHING => self.walk.between(&nearest, s).ok(),
            Err(_) => None,
            Ok((stand, place)) => {
                if new {
                    let place = self.stands.partition_point(|known| (known.s - s) * self.sign < 0.0);
                    self.stands.insert(place, stand);
                }
                Some(place)
            }
        }
    }
}

impl Source for Curve<'_, '_, '_> {
    fn sample(&mut self, tau: f64) -> Vec<f64> {
        match self.place(self.from + self.sign * tau) {
            Some(place) => self.observer.values(&place),
            None => vec![f64::NAN; self.observer.count() + self.observer.behind().width()],
        }
    }

    fn rounding(&mut self, _: f64) -> Vec<f64> {
        Vec::new()
    }

    fn behind(&mut self) -> (usize, Arc<Behind>) {
        (self.observer.count(), self.observer.behind())
    }

    fn resolution(&self) -> f64 {
        // closing leaves a place uncertain by about this
        1e-11
    }
}
