//! Events without end: what happens between impacts that follow one another ever faster happens infinitely often too.
//!
//! A contact that comes to rest after infinitely many impacts is listed with those above rounding ([`ContactChange::endless`]). Their intervals shrink like
//! the terms of a geometric series. What belongs to the series (contacts that strike in turn, frictions that reverse, named events of every flight) goes on in
//! step with it to the last interval that can be told from rounding; whatever else the machine does has its own time and nothing in intervals that have become
//! far shorter.
//!
//! [`ContactChange::endless`]: crate::dataset::ContactChange::endless

use crate::dataset::Event;
use algebra::arrange::Arrange;

/// Roundings of an instant below which events of an interval are not told from its ends.
const RESOLVED: f64 = 1e3 * f64::EPSILON;
/// Intervals of which most tell what goes on; of fewer one may have an event of its own.
const FEW: usize = 4;
/// Roundings of an instant below which intervals are compared no more.
const NOISE: f64 = 64.0 * f64::EPSILON;

/// The instant before which there are infinitely many of these events; none where there is an end to them.
pub fn endless(events: &[Event], is: &dyn Fn(&Event) -> bool) -> Option<f64> {
    let mut times: Vec<f64> = events.iter().filter(|event| is(event)).map(|event| event.t).collect();
    times.arrange_by(f64::total_cmp);
    let rests = events.iter().filter(|event| event.contact.as_ref().is_some_and(|change| change.endless));
    let mut own = rests.filter(|rest| is(rest) || goes_along(&times, &intervals(events, rest)));
    own.next().map(|rest| rest.t)
}

/// The later half of the intervals between the impacts that came ever faster before a rest, as far as they are told from rounding.
fn intervals(events: &[Event], rest: &Event) -> Vec<[f64; 2]> {
    let hit =
        |event: &&Event| event.guard == rest.guard && event.t <= rest.t && event.contact.as_ref().is_some_and(|c| c.impulse.is_some());
    let hits: Vec<f64> = events.iter().filter(hit).map(|event| event.t).collect();
    let mut all: Vec<[f64; 2]> = Vec::new();
    for pair in hits.windows(2).rev() {
        let length = pair[1] - pair[0];
        let shrinks = all.last().is_none_or(|later: &[f64; 2]| length > later[1] - later[0]);
        if !shrinks && length > NOISE * rest.t.abs() {
            break;
        }
        all.push([pair[0], pair[1]]);
    }
    all.retain(|[from, to]| to - from > RESOLVED * rest.t.abs());
    // the last interval stands first
    if all.len() >= FEW {
        all.truncate(all.len().div_ceil(2));
    }
    all
}

/// Whether something happens in most of the intervals, ends included; in all where they are few.
fn goes_along(times: &[f64], intervals: &[[f64; 2]]) -> bool {
    let within = |[from, to]: &&[f64; 2]| {
        let first = times.partition_point(|t| t <= from);
        times.get(first).is_some_and(|t| t <= to)
    };
    let count = intervals.iter().filter(within).count();
    count > 0 && (count == intervals.len() || intervals.len() >= FEW && 2 * count > intervals.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dataset::ContactChange;

    fn impact(t: f64, impulse: Option<f64>) -> Event {
        let contact = ContactChange { contact: "floor".into(), from: "open", to: "open", impulse, endless: impulse.is_none() };
        Event { t, guard: 0, contact: Some(contact), ..Event::default() }
    }

    fn named(name: &str, t: f64) -> Event {
        Event { t, name: name.into(), guard: usize::MAX, ..Event::default() }
    }

    /// Impacts at 1 - 2^-k, a top between two of them, a level that only the first flights reach, and a clock of a thousandth of a second.
    fn bouncing() -> Vec<Event> {
        let at = |k: i32| 1.0 - 0.5_f64.powi(k);
        let mut list: Vec<Event> = (0..48).map(|k| impact(at(k), Some(1.0))).collect();
        list.push(impact(1.0, None));
        list.extend((0..47).map(|k| named("top", 0.5 * (at(k) + at(k + 1)))));
        list.extend((0..8).map(|k| named("level", 0.4 * at(k) + 0.6 * at(k + 1))));
        list.extend((0..1000).map(|k| named("clock", 1e-3 * f64::from(k))));
        list
    }

    /// A ratio of 1e-6 leaves two intervals: what happens in the second alone happens once.
    #[test]
    fn of_few_intervals_all_count() {
        let mut list: Vec<Event> = [0.5, 0.5 + 1e-6, 0.5 + 1e-6 + 1e-12].into_iter().map(|t| impact(t, Some(1.0))).collect();
        list.push(impact(0.5 + 1e-6 + 1e-12, None));
        list.extend([0.5 + 5e-7, 0.5 + 1e-6 + 5e-13].map(|t| named("top", t)));
        list.push(named("once", 0.5 + 1e-6 + 4e-13));
        let of = |name: &str| endless(&list, &|event| event.name == name);
        assert!(of("top").is_some() && of("once").is_none());
    }

    #[test]
    fn what_goes_along_with_the_impacts_has_no_end() {
        let list = bouncing();
        let of = |name: &str| endless(&list, &|event| event.name == name);
        assert_eq!(of("top"), Some(1.0));
        assert_eq!(of("level"), None);
        assert_eq!(of("clock"), None);
        assert_eq!(endless(&list, &|event| event.guard == 0), Some(1.0));
    }
}
