//! Contacts that close and open along a branch: where, and which set of closed contacts holds the place beyond.

use super::{BEHIND, Beyond, Branch, Event, JOINED, Spot, Station, ZERO, between, mixed};
use crate::Fault;
use crate::linear::LinearMachine;
use crate::studies::rest::contacts::Margin;

impl Branch {
    /// A smooth step at the end of which contacts cannot stand as they do.
    pub(super) fn touch(&mut self, machine: &mut LinearMachine, side: usize, to: Station) -> Result<(), Fault> {
        let (mut low, mut high) = (self.last(side), to.clone());
        let wanted = to.spot.as_ref().map(|s| s.violated.clone()).unwrap_or_default();
        let mut margins = Vec::new();
        for _ in 0..100 {
            let middle = 0.5 * (low.value + high.value);
            let (Some(a), Some(b)) = (&low.spot, &high.spot) else { break };
            if middle == low.value || middle == high.value || (high.value - low.value).abs() <= ZERO * (to.value - self.home).abs() {
                break;
            }
            let Some(spot) = self.spot(machine, middle, &mixed(&a.place.q, &b.place.q, 0.5))? else { break };
            let found = self.margins(machine, &spot.place)?;
            let gone = found.iter().any(|m| m.value < 0.0 && (m.is_violated() || wanted.contains(&m.contact)));
            let station = Station { value: middle, spot: Some(spot), parted: false };
            if gone { (high, margins) = (station, found) } else { low = station }
        }
        let here = low.spot.as_ref().map(|s| s.place.q.clone()).unwrap_or_default();
        if between(self.last(side).value, low.value, side) {
            // a fork may lie on the way there
            self.push_or_walk(machine, side, low.clone())?;
            if self.last(side).spot.is_none_or(|s| !self.same(&s.place.q, &here)) {
                return self.walk(machine, side, to.value);
            }
        }
        let violated: Vec<usize> = match margins
            .iter()
            .filter(|m| m.value < 0.0 && (m.is_violated() || wanted.contains(&m.contact)))
            .map(|m| m.contact)
            .collect::<Vec<_>>()
        {
            list if list.is_empty() => wanted,
            list => list,
        };
        self.retouch(machine, (side, &to), (high.value, &here), (&margins, &violated))
    }

    /// Behind p*, where contacts cannot stand as they did: the place that continues with others, or another one.
    fn retouch(
        &mut self,
        machine: &mut LinearMachine,
        (side, to): (usize, &Station),
        (value, here): (f64, &[f64]),
        (margins, violated): (&[Margin], &[usize]),
    ) -> Result<(), Fault> {
        let before = self.closed.clone();
        let step = BEHIND * (to.value - self.home);
        let sets = self.contacts.as_ref().map(|c| c.successors(margins, violated)).unwrap_or_default();
        let reach = self.reach.clone();
        let sizes = self.sizes.at(&[here, &self.place.q]);
        let near = |spot: &Spot| (0..here.len()).all(|i| (spot.place.q[i] - here[i]).abs() <= JOINED * reach[i] + BEHIND * sizes[i]);
        for set in sets {
            self.closed = set;
            let Some(spot) = self.spot(machine, value + step, here)? else { continue };
            if !spot.violated.is_empty() || !near(&spot) {
                continue;
            }
            self.touched(side, value, here, &before);
            if self.beyond == Beyond::Ends {
                self.closed = before;
                self.push(side, Station { value, spot: None, parted: true });
                self.push(side, Station { value: to.value, spot: None, parted: true });
                return Ok(());
            }
            let there = self.spot(machine, value, here)?.map(|s| Spot { violated: Vec::new(), ..s });
            self.push(side, Station { value, spot: there.or(Some(spot)), parted: false });
            return self.walk(machine, side, to.value);
        }
        self.closed = before;
        self.change(side, value, Event::Ends, here);
        let (spot, _) = self.anew(machine, value + step, (None, None))?;
        self.push(side, Station { value: value + step, spot, parted: true });
        self.walk(machine, side, to.value)
    }

    /// Notes which contacts close and open.
    fn touched(&mut self, side: usize, value: f64, at: &[f64], before: &[usize]) {
        self.change(side, value, Event::Touches, at);
        let Some(contacts) = &self.contacts else { return };
        let names =
            |of: &[usize], other: &[usize]| of.iter().filter(|c| !other.contains(c)).map(|c| contacts.name(*c).to_owned()).collect();
        let (closes, opens) = (names(&self.closed, before), names(before, &self.closed));
        if let Some(change) = self.changes.last_mut() {
            (change.closes, change.opens) = (closes, opens);
        }
    }
}
