//! Where a place loses its stability without oscillation: the stable places that part from it there, and which of them is followed.

use super::{BEHIND, Branch, Event, ONE_PLACE, SEEDS, Spot, Station, ZERO, between, distance, diverging, flutters, mixed};
use crate::Fault;
use crate::linear::LinearMachine;

/// Share of a step before a fork at which its oscillations are looked at.
const BEFORE: f64 = 1e-3;

impl Branch {
    /// A smooth step on which a stable place becomes unstable by a real root.
    pub(super) fn fork(&mut self, machine: &mut LinearMachine, side: usize, to: Station) -> Result<(), Fault> {
        let first = self.last(side);
        let (mut low, mut high) = (first.clone(), to.clone());
        for _ in 0..100 {
            let middle = 0.5 * (low.value + high.value);
            let (Some(a), Some(b)) = (&low.spot, &high.spot) else { break };
            if middle == low.value || middle == high.value || (high.value - low.value).abs() <= ZERO * (to.value - self.home).abs() {
                break;
            }
            let Some(spot) = self.spot(machine, middle, &mixed(&a.place.q, &b.place.q, 0.5))? else { break };
            let station = |spot| Station { value: middle, spot: Some(spot), parted: false };
            if spot.unstable > 0 { high = station(spot) } else { low = station(spot) }
        }
        // a little before, where the roots of a flutter that ends are still apart
        let before = low.value - BEFORE * (low.value - first.value);
        let place = low.spot.as_ref().map(|s| s.place.q.clone()).unwrap_or_default();
        if let Some(spot) = self.spot(machine, before, &place)?
            && flutters(machine, &spot.place)?
        {
            // a growing oscillation that becomes two growing motions: the stability was lost before, and no place parts here
            self.push(side, high);
            self.push(side, to);
            return Ok(());
        }
        let at = high.spot.as_ref().map(|s| s.place.q.clone()).unwrap_or_default();
        let step = BEHIND * (to.value - self.home);
        let found = self.parting(machine, high.value, step, &at)?;
        let Some(chosen) = self.preferred(&found, &at) else {
            self.change(side, high.value, Event::Loses, &at);
            self.push(side, high);
            self.push(side, to);
            return Ok(());
        };
        self.change(side, high.value, Event::Forks(found.len()), &at);
        self.push(side, Station { parted: false, ..low });
        let mut parted = true;
        for station in found[chosen].iter().filter(|s| !between(to.value, s.value, side)) {
            self.push(side, Station { parted, ..station.clone() });
            parted = false;
        }
        if parted {
            let near = found[chosen][0].spot.as_ref().map(|s| s.place.q.clone()).unwrap_or_default();
            let spot = self.spot(machine, to.value, &near)?;
            self.push(side, Station { value: to.value, spot, parted });
        }
        self.walk(machine, side, to.value)
    }

    /// The stable places that part from an unstable one behind p*, each as stations outwards.
    fn parting(&mut self, machine: &mut LinearMachine, fork: f64, step: f64, at: &[f64]) -> Result<Vec<Vec<Station>>, Fault> {
        let Some(own) = self.spot(machine, fork + step, at)? else { return Ok(Vec::new()) };
        let slowest = diverging(machine, &own.place)?.into_iter().min_by(|a, b| a.root.0.total_cmp(&b.root.0));
        let Some(shape) = slowest.map(|m| m.shape.iter().map(|z| z.0).collect::<Vec<f64>>()) else { return Ok(Vec::new()) };
        let mut found: Vec<Vec<Station>> = Vec::new();
        let sizes = self.sizes.at(&[at, &self.place.q]);
        let unit = (0..shape.len()).max_by(|i, j| shape[*i].abs().total_cmp(&shape[*j].abs())).map_or(1.0, |i| sizes[i]);
        let unit = if unit > 0.0 { unit } else { 1.0 };
        for size in std::iter::successors(Some(1.0), |s| Some(s / 3.0)).take(SEEDS) {
            for sign in [1.0, -1.0] {
                let away = sign * size * unit;
                let guess: Vec<f64> = own.place.q.iter().zip(&shape).map(|(q, v)| q + away * v).collect();
                let Some(spot) = self.spot(machine, fork + step, &guess)? else { continue };
                let known = found.iter().filter_map(|f| f.last()?.spot.as_ref()).any(|other| self.same(&other.place.q, &spot.place.q));
                if spot.unstable > 0 || known || self.same(&spot.place.q, &own.place.q) {
                    continue;
                }
                found.extend(self.inwards(machine, (fork, step), &own, spot)?);
            }
        }
        Ok(found)
    }

    /// A place followed back towards p*; none where it does not join the other one there.
    fn inwards(
        &mut self,
        machine: &mut LinearMachine,
        (fork, step): (f64, f64),
        own: &Spot,
        spot: Spot,
    ) -> Result<Option<Vec<Station>>, Fault> {
        let first = distance(&spot.place.q, &own.place.q);
        let mut list = vec![Station { value: fork + step, spot: Some(spot), parted: false }];
        let mut trunk = own.clone();
        for part in [0.25, 0.0625] {
            let value = fork + part * step;
            let Some(next) = self.spot(machine, value, &trunk.place.q)? else { return Ok(None) };
            let Some(last) = list.last().and_then(|s| s.spot.as_ref()) else { return Ok(None) };
            let guess: Vec<f64> = (0..next.place.q.len()).map(|i| next.place.q[i] + 0.5 * (last.place.q[i] - trunk.place.q[i])).collect();
            let Some(spot) = self.spot(machine, value, &guess)? else { return Ok(None) };
            trunk = next;
            list.push(Station { value, spot: Some(spot), parted: false });
        }
        let last = list.last().and_then(|s| s.spot.as_ref()).map_or(f64::NAN, |s| distance(&s.place.q, &trunk.place.q));
        list.reverse();
        Ok((last > 0.0 && last <= 0.5 * first).then_some(list))
    }

    pub(super) fn same(&self, a: &[f64], b: &[f64]) -> bool {
        self.sizes.same([a, b], &self.place.q, ONE_PLACE)
    }

    /// Of places that part from `at`, that on the side of the file's start; of two alike the one where the coordinate that moves most grows.
    fn preferred(&self, found: &[Vec<Station>], at: &[f64]) -> Option<usize> {
        let moved = |list: &Vec<Station>| -> Vec<f64> {
            let q = list.last().and_then(|s| s.spot.as_ref()).map_or(Vec::new(), |s| s.place.q.clone());
            q.iter().zip(at).map(|(a, b)| a - b).collect()
        };
        let towards = |d: &[f64]| self.starts.first().map_or(0.0, |s| s.iter().zip(at).zip(d).map(|((s, a), d)| (s - a) * d).sum::<f64>());
        // equal entries differ by rounding: the first of them counts
        let grows = |d: &[f64]| d.iter().fold(0.0_f64, |m, v| if v.abs() > m.abs() * (1.0 + 1e-9) { *v } else { m });
        let rank = |list: &Vec<Station>| {
            let d = moved(list);
            let along = towards(&d);
            // across the side of the start: no side is nearer
            (if along.abs() <= 1e-9 * distance(&d, &vec![0.0; d.len()]) { 0.0 } else { along.signum() }, grows(&d).signum())
        };
        (0..found.len()).max_by(|i, j| {
            let (a, b) = (rank(&found[*i]), rank(&found[*j]));
            a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)).then(j.cmp(i))
        })
    }
}
