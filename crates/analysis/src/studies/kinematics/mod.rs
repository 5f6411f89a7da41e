//! A linkage followed over its driven coordinates: places, first and second derivatives of all coordinates along the way.
//!
//! ```text
//! place --integrate b = dq/ds--> near the next place --close by Newton--> next place --linear systems--> b and c = d²q/ds²
//! ```
//!
//! Both derivatives solve linear systems (`linkage.rs`): they hold as many digits as the place itself.

mod curve;
mod extrapolation;
mod linkage;
mod stand;
mod turning;
mod walk;
mod way;

use words::{Message, Text};

use program::lower::Drive;
use symbolic::{Equations, Graph};

use crate::Fault;
use linkage::{Drives, Linkage};
use way::Doubts;
use words::digits::rounded;

use walk::Walk;
pub use walk::{Followed, Observer, Place};

/// What is followed.
pub struct Way<'w> {
    /// The leading coordinate, s.
    pub over: usize,
    /// Its values, ascending or descending.
    pub at: &'w [f64],
    /// Its uniform rate, not zero.
    pub rate: f64,
    /// Further driven coordinates: formulas d(s), d', d'' over the leading coordinate.
    pub with: Vec<(usize, Drive)>,
    /// Graph of these formulas, grown from that of the equations.
    pub graph: &'w Graph,
    /// Quantities whose least and greatest values along the way are wanted.
    pub observer: Option<&'w mut dyn Observer>,
}

/// Longest range, rad or arms.
const LONGEST: f64 = 1e5;

/// Follows the linkage from the state `start`.
pub fn follow(equations: &Equations, start: &[f64], way: Way) -> Followed {
    let mut found = Followed::default();
    let from = way.at.first().copied().unwrap_or(0.0);
    let drives = Drives { over: way.over, with: way.with, graph: way.graph, from, rate: way.rate };
    let outcome = Linkage::new(equations, start, &drives).and_then(|mut linkage| {
        passable(&linkage, start, way.at, way.rate)?;
        let mut walk = Walk { doubts: Doubts::default(), worst: [0.0; 3], rates: 0.0, largest: 0.0, linkage: &mut linkage };
        let mut stands = Vec::new();
        let result = walk.all(start, way.at, &mut found, &mut stands);
        if let (Ok(()), Some(observer)) = (&result, way.observer) {
            found.extremes = curve::extremes(&mut walk, &stands, observer, (&found.places, way.at));
        }
        found.audits = walk.audits();
        result
    });
    found.fault = outcome.err();
    found
}

/// Refuses a range that nobody waits for, and a rate whose square is no number.
///
/// *Errors*: S079.
fn passable(linkage: &Linkage<'_>, start: &[f64], at: &[f64], rate: f64) -> Result<(), Fault> {
    let unit = if linkage.angles[linkage.over] { 1.0 } else { linkage.arm };
    let ends = [start[linkage.over]].into_iter().chain(at.first().copied()).chain(at.last().copied());
    let (low, high) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), s| (l.min(s), h.max(s)));
    let radians = (high - low) / unit;
    if radians <= LONGEST && (rate * rate).is_normal() {
        return Ok(());
    }
    let (radians, rate) = (rounded(radians), rounded(rate));
    Err(Fault::new(Message {
        code: "S079",
        what: Text::new(
            format!("the range cannot be followed: {} rad (arms of the linkage) at the rate {}", radians.en, rate.en),
            format!("промежуток не пройти: {} рад (плеч механизма) при скорости {}", radians.ru, rate.ru),
        ),
        why: Text::new(
            "the linkage is closed place by place along the whole range, at most 10⁵ radians; the square of the rate must be a number",
            "механизм замыкается положение за положением на всём промежутке, не более 10⁵ радиан; квадрат скорости должен быть числом",
        ),
        help: Text::new("one turn tells all of a cyclic machine: --turns 1", "у цикловой машины достаточно одного оборота: --turns 1"),
    }))
}
