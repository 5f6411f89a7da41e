//! Where a place of rest does not continue smoothly: it joins another one, or ends, and the machine falls from there to another.

use super::{BEHIND, Branch, Change, Event, JOINED, NOISE, NOTHING, ONE, Spot, Station, between};
use crate::Fault;
use crate::linear::LinearMachine;
use crate::studies::rest::contacts::Contacts;
use crate::studies::rest::fall::{Way as Fall, way};

impl Branch {
    /// A narrow step that is not smooth: the place joins another one, or ends.
    pub(super) fn singular(&mut self, machine: &mut LinearMachine, side: usize, to: Station) -> Result<(), Fault> {
        let a = self.last(side);
        let here = a.spot.map(|s| s.place.q).unwrap_or_default();
        let reach = self.reach.clone();
        let sizes = self.sizes.at(&[&here, &self.place.q]);
        let within = |spot: &Spot, share: f64, least: f64| {
            (0..here.len()).all(|i| (spot.place.q[i] - here[i]).abs() <= share * reach[i] + least * sizes[i])
        };
        // where Newton's method fails in the singular place itself, another start may lead beside it
        let to = match to.spot {
            None => Station { spot: self.anew(machine, to.value, (None, None))?.0, ..to },
            Some(_) => to,
        };
        if let Some(spot) = to.spot.as_ref().filter(|s| within(s, JOINED, 1e3 * NOTHING)) {
            let (far, real) = (spot.place.q.clone(), !within(spot, NOISE, NOTHING));
            if let Some((at, spot)) = self.joined(machine, side, (to.value, &far))? {
                self.change(side, at, Event::Joins, &spot.place.q);
                if between(a.value, at, side) {
                    self.push(side, Station { value: at, spot: Some(spot), parted: true });
                    return Ok(());
                }
            }
            match self.known(side, to.value, Event::Joins) {
                Some(known) => known.at = far,
                None if real => self.change(side, to.value, Event::Joins, &far),
                None => {}
            }
            self.push(side, to);
            return Ok(());
        }
        // the last narrow step before a fold looks like that onto another place
        if let Some(at) = self.known(side, to.value, Event::Joins).map(|c| c.value) {
            self.changes.retain(|c| c.value != at || c.event != Event::Joins);
        }
        // and rounding may take the last step of it for a loss of stability
        let near = ONE * to.value.abs().max((to.value - self.home).abs());
        self.changes.retain(|c| c.upwards != (side == 1) || c.event != Event::Loses || (c.value - to.value).abs() > near);
        let (spot, event) = self.anew(machine, to.value, (Some(&here), to.spot))?;
        if self.known(side, to.value, Event::Ends).is_none() && self.known(side, to.value, Event::Falls).is_none() {
            self.change(side, to.value, event, &here);
        }
        self.push(side, Station { spot, ..to });
        Ok(())
    }

    /// The same change, met at a value that differs by rounding.
    pub(super) fn known(&mut self, side: usize, value: f64, event: Event) -> Option<&mut Change> {
        let near = ONE * value.abs().max((value - self.home).abs());
        self.changes.iter_mut().find(|c| c.upwards == (side == 1) && c.event == event && (c.value - value).abs() <= near)
    }

    /// Where the machine falls from `here`, else rest from the starts of the file: the first stable place, or the first.
    pub(super) fn anew(
        &mut self,
        machine: &mut LinearMachine,
        value: f64,
        (here, other): (Option<&[f64]>, Option<Spot>),
    ) -> Result<(Option<Spot>, Event), Fault> {
        match here.map(|here| self.fallen(machine, value, here)).transpose()? {
            Some(Fallen::To(spot)) => return Ok((Some(*spot), Event::Falls)),
            Some(Fallen::Singular) => {
                self.singular[usize::from(value > self.home)] = true;
                return Ok((None, Event::Ends));
            }
            Some(Fallen::Nowhere) | None => {}
        }
        let (mut first, own) = (None, self.closed.clone());
        let sets = self.contacts.as_ref().map_or(vec![own.clone()], Contacts::all);
        let starts = self.starts.clone();
        for (set, start) in sets.into_iter().flat_map(|set| starts.clone().into_iter().map(move |start| (set.clone(), start))) {
            self.closed = set;
            match self.spot(machine, value, &start)?.filter(|s| s.violated.is_empty()) {
                Some(spot) if spot.unstable == 0 => return Ok((Some(spot), Event::Ends)),
                Some(spot) => drop(first.get_or_insert(spot)),
                None => {}
            }
        }
        self.closed = own;
        Ok((other.filter(|o| o.unstable == 0 && o.violated.is_empty()).or(first), Event::Ends))
    }

    /// The stable place to which the machine falls from `here`, where it is pushed off a little behind the value.
    fn fallen(&mut self, machine: &mut LinearMachine, value: f64, here: &[f64]) -> Result<Fallen, Fault> {
        self.hold(machine)?;
        let behind = value + BEHIND * (value - self.home);
        machine.set(self.parameter, behind)?;
        let guess = match way(machine, here) {
            Fall::Rests(guess) => guess,
            Fall::Nowhere => return Ok(Fallen::Nowhere),
            Fall::Singular => return Ok(Fallen::Singular),
        };
        let Some(far) = self.spot(machine, behind, &guess)? else { return Ok(Fallen::Nowhere) };
        let spot = self.spot(machine, value, &far.place.q)?;
        Ok(spot.filter(|s| s.unstable == 0 && s.violated.is_empty()).map_or(Fallen::Nowhere, |spot| Fallen::To(Box::new(spot))))
    }
}

/// Where the machine falls to behind the end of a place of rest.
enum Fallen {
    /// A stable place.
    To(Box<Spot>),
    /// None that is known.
    Nowhere,
    /// A pole of its forces: it does not come to rest, and places behind the pole cannot be reached.
    Singular,
}
