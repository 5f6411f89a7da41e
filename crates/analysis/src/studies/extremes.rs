//! Resonances and antiresonances of a response, with what absorbs. Peaks of oscillations with so little damping that no grid of frequencies shows them are looked for over
//! the distance from the root.

use crate::Fault;
use crate::peaks::{self, Peak};
use crate::studies::modes::{Complex, Kind, Mode, Modes};
use crate::studies::response::{Forced, Point, magnitude, phase};
use algebra::arrange::Arrange;

/// A largest amplitude.
#[derive(Clone, Debug, PartialEq)]
pub struct Resonance {
    /// Index of the output.
    pub output: usize,
    /// Frequency, rad/s.
    pub omega: f64,
    /// Amplitude; infinite without damping.
    pub amplitude: f64,
    /// Phase; NaN without damping.
    pub phase: f64,
    /// Dynamic coefficient: amplitude over that of the same load acting statically; NaN where nothing restores.
    pub gain: f64,
    /// Index of the mode that resounds, among those of the machine at this frequency.
    pub mode: Option<usize>,
    /// Quality factor 1/2ζ of that mode there; infinite without damping.
    pub quality: f64,
    /// Frequencies of half power, amplitude/√2, on both sides; NaN where there are none.
    pub half_power: [f64; 2],
}

/// A zero or a least amplitude.
#[derive(Clone, Debug, PartialEq)]
pub struct Antiresonance {
    /// Index of the output.
    pub output: usize,
    /// Frequency, rad/s.
    pub omega: f64,
    /// Amplitude; zero without damping.
    pub amplitude: f64,
    /// Whether the output stands still exactly.
    pub exact: bool,
    /// Coordinates that carry the motion there, with their shares of the kinetic energy, largest first.
    pub absorbs: Vec<(usize, f64)>,
}

/// Amplitudes below this share of their neighbours are zero.
const STILL: f64 = 1e-9;
/// Coordinates with a smaller share of the energy do not absorb.
const SHARE: f64 = 0.05;
/// How much larger than beside it a value is where it is infinite: a change of sign through zero is smaller, and the place is known to rounding.
const ENDLESS: f64 = 1e6;
/// Damping ratio below which peaks are looked for over the distance from the root: points of a grid stand no nearer to each other.
const SHARP: f64 = 1e-6;
/// Half-width of a peak, as a share of its frequency, below which frequencies themselves are too coarse.
const NARROWEST: f64 = 1e-12;
/// Share of the narrowest half-width within which two frequencies are the same one found twice: points about a peak stand a tenth of it apart.
const TWICE: f64 = 1e-3;
/// Places that are looked at, in half-widths of the peak; those beside a wide peak, see `dense`, with the place itself.
const LOOKED: [f64; 10] = [0.0, 0.1, 0.3, 0.6, 1.0, 2.0, 4.0, 10.0, 30.0, 100.0];
/// A root of a machine that follows the frequency is its own where it is as near as this.
const OWN: f64 = 1e-6;
/// Points between two natural frequencies.
const BETWEEN: usize = 60;
/// Points of the grid at most at which modes are asked for: an eigenproblem each, and natural frequencies are smooth beside amplitudes.
const SOUGHT: usize = 101;

/// Resonances and antiresonances of the first `outputs` outputs between the ends of a grid of points.
///
/// *Errors*: formulas without a value at a frequency.
pub fn extremes(
    forced: &mut Forced,
    modes: &Modes,
    points: &[Point],
    outputs: usize,
) -> Result<(Vec<Resonance>, Vec<Antiresonance>), Fault> {
    let (mut high, mut low) = (Vec::new(), Vec::new());
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return Ok((high, low)) };
    let mut natural: Vec<Mode> = modes.modes.clone();
    natural.extend(critical(forced, points)?);
    let roots = roots(forced, &natural, [first.omega, last.omega])?;
    let omegas = dense((&natural, &roots), first.omega, last.omega, points);
    let dense = omegas.iter().map(|w| forced.at(*w)).collect::<Result<Vec<Point>, Fault>>()?;
    for k in 0..outputs {
        let mut search = Search { forced, modes, natural: &natural, sharp_roots: &roots, k, omegas: &omegas, points: &dense };
        high.extend(search.resonances()?);
        low.extend(search.antiresonances()?);
    }
    Ok((high, low))
}

/// The grid, points between natural frequencies, and points about each.
fn dense((modes, roots): (&[Mode], &[Root]), from: f64, to: f64, points: &[Point]) -> Vec<f64> {
    let mut marks: Vec<f64> = modes.iter().filter(|m| m.kind == Kind::Oscillation && m.damped > 0.0).map(|m| m.damped).collect();
    let mut list: Vec<f64> = points.iter().map(|p| p.omega).collect();
    for m in modes.iter().filter(|m| m.kind == Kind::Oscillation) {
        // without damping points stand as near as those of a damping of a millionth, and where the peak is looked for from its root
        let apart = m.root.0 == 0.0 || roots.iter().any(|r| r.reaches(m.damped));
        let half = m.omega * m.ratio.abs().max(if apart { SHARP } else { NARROWEST });
        for s in [0.1, 0.3, 0.6, 1.0, 2.0, 4.0, 10.0, 30.0, 100.0] {
            list.extend([m.damped - s * half, m.damped + s * half]);
        }
    }
    marks.extend([from, to]);
    marks.sort_by(f64::total_cmp);
    for pair in marks.windows(2) {
        list.extend((1..BETWEEN).map(|i| pair[0] + (pair[1] - pair[0]) * i as f64 / BETWEEN as f64));
    }
    list.retain(|w| (from..=to).contains(w) && *w > 0.0);
    list.sort_by(f64::total_cmp);
    let narrowest = modes.iter().map(|m| m.ratio.abs()).filter(|r| *r > 0.0).fold(SHARP, f64::min).max(NARROWEST);
    list.dedup_by(|a, b| (*a - *b).abs() <= TWICE * narrowest * b.abs());
    list
}

/// Modes of a machine that follows the frequency, at the frequencies that are their own: critical speeds. The k-th frequency of a machine is continuous in its
/// numbers, so that k-th frequency less ω changes its sign between two points where one lies between them.
fn critical(forced: &mut Forced, points: &[Point]) -> Result<Vec<Mode>, Fault> {
    if !forced.is_followed() {
        return Ok(Vec::new());
    }
    let every = points.len().div_ceil(SOUGHT).max(1);
    let mut found = Vec::new();
    let mut before: Option<(f64, Vec<Mode>)> = None;
    for point in points.iter().step_by(every).chain(points.last()).filter(|p| p.omega > 0.0) {
        let here = oscillations(forced, point.omega)?;
        if let Some((omega, there)) = before.filter(|(_, there)| there.len() == here.len()) {
            for k in (0..here.len()).filter(|k| (there[*k].damped - omega) * (here[*k].damped - point.omega) < 0.0) {
                let mut above = |w: f64| oscillations(forced, w).ok().and_then(|list| Some(list.get(k)?.damped - w)).unwrap_or(f64::NAN);
                let own = peaks::zero(&mut above, omega, point.omega);
                found.extend(oscillations(forced, own)?.into_iter().nth(k));
            }
        }
        before = Some((point.omega, here));
    }
    Ok(found)
}

/// Oscillations of the machine at a frequency, the slowest first.
fn oscillations(forced: &mut Forced, omega: f64) -> Result<Vec<Mode>, Fault> {
    let mut list = forced.modes(omega)?.modes;
    list.retain(|m| m.kind == Kind::Oscillation);
    list.sort_by(|a, b| a.damped.total_cmp(&b.damped));
    Ok(list)
}

/// A root by which peaks are looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Root {
    /// λ.
    root: Complex,
    /// Its mode.
    mode: usize,
}

impl Root {
    /// Half the width of its peak.
    fn half(&self) -> f64 {
        self.root.0.abs()
    }

    /// Whether a frequency is among those that are looked at from it.
    fn reaches(&self, omega: f64) -> bool {
        (omega - self.root.1).abs() <= 2.0 * LOOKED[LOOKED.len() - 1] * SHARP * self.root.1
    }
}

/// Simple roots with so little damping that peaks are looked for over the distance from them.
///
/// *Errors*: S031 of a machine that follows the frequency.
fn roots(forced: &mut Forced, natural: &[Mode], [from, to]: [f64; 2]) -> Result<Vec<Root>, Fault> {
    // beside another root the refinement may come to that one, and points about both stand near enough
    let alone = |m: &Mode| {
        let reach = 2.0 * LOOKED[LOOKED.len() - 1] * SHARP * m.damped;
        natural.iter().all(|o| o.kind != Kind::Oscillation || o.root == m.root || (o.damped - m.damped).abs() > reach)
    };
    let weak = |m: &&Mode| m.kind == Kind::Oscillation && m.root.0 != 0.0 && m.ratio.abs() < SHARP && alone(m);
    let mut found: Vec<Root> = Vec::new();
    for (i, mode) in natural.iter().enumerate().filter(|(_, m)| weak(m) && (from..=to).contains(&m.damped)) {
        let own = match forced.is_followed() {
            true => nearest(&forced.modes(mode.damped)?.modes, mode.damped),
            false => Some((i, mode.root)),
        };
        let Some((mode, root)) = own.filter(|(_, root)| (root.1 - mode.damped).abs() <= OWN * mode.damped && root.0 != 0.0) else {
            continue;
        };
        let root = Root { root, mode };
        let known = found.iter().any(|f| f.root == root.root);
        if !known && forced.is_simple(root.root)? {
            found.push(root);
        }
    }
    Ok(found)
}

fn nearest(modes: &[Mode], omega: f64) -> Option<(usize, Complex)> {
    let all = modes.iter().enumerate().filter(|(_, m)| m.kind == Kind::Oscillation);
    let away = |m: &Mode| (m.damped - omega).abs();
    all.min_by(|a, b| away(a.1).total_cmp(&away(b.1))).map(|(i, m)| (i, m.root))
}

struct Search<'a, 'm> {
    forced: &'a mut Forced<'m>,
    /// Of the machine with the numbers of the file.
    modes: &'a Modes,
    /// With those at critical speeds, where the machine follows the frequency.
    natural: &'a [Mode],
    /// Roots with so little damping that no grid shows their peaks.
    sharp_roots: &'a [Root],
    k: usize,
    omegas: &'a [f64],
    points: &'a [Point],
}

impl Search<'_, '_> {
    fn value(&mut self, omega: f64) -> Complex {
        let k = self.k;
        self.forced.at(omega).map_or((f64::NAN, f64::NAN), |p| p.outputs[k])
    }

    fn powers(&self) -> Vec<f64> {
        let square = |z: Complex| z.0 * z.0 + z.1 * z.1;
        self.points.iter().map(|p| square(p.outputs[self.k])).collect()
    }

    /// Whether the system that resounds has no damping: all values lie on one line through zero.
    fn undamped(&self) -> bool {
        self.modes.modes.iter().all(|m| m.root.0 == 0.0)
            && self.points.iter().all(|p| {
                let z = p.outputs[self.k];
                // a part across the line is rounding of the part along it
                !magnitude(z).is_finite() || z.1.abs() <= 1e-12 * z.0.abs() || z.0.abs() <= 1e-12 * z.1.abs()
            })
    }

    fn resonances(&mut self) -> Result<Vec<Resonance>, Fault> {
        let (from, to) = (self.omegas[0], self.omegas[self.omegas.len() - 1]);
        if self.undamped() {
            return self.poles(from, to);
        }
        let powers = self.powers();
        // modes without damping beside damped ones have poles too
        let mut found = self.poles(from, to)?;
        let poles: Vec<f64> = found.iter().map(|r| r.omega).collect();
        found.extend(self.sharp()?);
        for c in peaks::candidates(&powers, 1.0) {
            let (low, high) = (self.omegas[c - 1], self.omegas[c + 1]);
            // from their roots these have been looked at
            let seen = |r: &Root| r.reaches(self.omegas[c]) || (low..=high).contains(&r.root.1);
            if poles.iter().any(|w| (low..=high).contains(w)) || self.sharp_roots.iter().any(seen) {
                continue;
            }
            let peak = peaks::refine(&mut |w| square(self.value(w)), low, high, 1.0);
            found.push(self.resonance(peak)?);
        }
        found.arrange_by(|a, b| a.omega.total_cmp(&b.omega));
        Ok(found)
    }

    /// Without damping: natural frequencies that the load excites and the output shows.
    fn poles(&mut self, from: f64, to: f64) -> Result<Vec<Resonance>, Fault> {
        let mut found: Vec<Resonance> = Vec::new();
        let natural = self.natural.iter().filter(|m| m.kind == Kind::Oscillation && m.root.0 == 0.0);
        let mut places: Vec<f64> = natural.map(|m| m.damped).collect();
        // a machine that follows the frequency may resound where a place of rest changes under it, too
        if self.undamped() {
            places.extend(self.changes_through_infinity());
        }
        for omega in places {
            // nine digits: the same frequency found twice
            if omega < from || omega > to || found.iter().any(|f| (f.omega - omega).abs() <= 1e-9 * omega) {
                continue;
            }
            // near a pole of residue R the amplitude is R/|ω - ω_i|: a hundred times nearer, a hundred times larger
            let (near, far) = (self.value(omega * (1.0 + 1e-6)), self.value(omega * (1.0 + 1e-4)));
            let grows = magnitude(near) > 30.0 * magnitude(far);
            if !grows {
                continue;
            }
            found.push(Resonance {
                output: self.k,
                omega,
                amplitude: f64::INFINITY,
                phase: f64::NAN,
                gain: f64::INFINITY,
                mode: self.resounding(omega)?.map(|(i, _)| i),
                quality: f64::INFINITY,
                half_power: [f64::NAN; 2],
            });
        }
        Ok(found)
    }

    /// Where the values on their line change sign through infinity, between the points.
    fn changes_through_infinity(&mut self) -> Vec<f64> {
        let mut found = Vec::new();
        for i in 1..self.points.len() {
            let [a, b] = [i - 1, i].map(|j| part(self.points[j].outputs[self.k]));
            if !(a.is_finite() && b.is_finite() && a * b < 0.0) {
                continue;
            }
            let (low, high) = (self.omegas[i - 1], self.omegas[i]);
            let omega = peaks::zero(&mut |w| 1.0 / part(self.value(w)), low, high);
            if magnitude(self.value(omega)) >= ENDLESS * a.abs().max(b.abs()) {
                found.push(omega);
            }
        }
        found
    }

    fn resonance(&mut self, peak: Peak) -> Result<Resonance, Fault> {
        let point = self.forced.at(peak.omega)?;
        let (z, still) = (point.outputs[self.k], magnitude(point.still[self.k]));
        let resounding = self.resounding(peak.omega)?;
        let (mode, quality) = (resounding.map(|(i, _)| i), resounding.map_or(f64::NAN, |(_, ratio)| 0.5 / ratio));
        let half_power = [-1.0, 1.0].map(|side| self.half((&peak, side), 0.0, &|search, omega| square(search.value(omega))));
        let gain = if still > 0.0 { magnitude(z) / still } else { f64::NAN };
        Ok(Resonance { output: self.k, omega: peak.omega, amplitude: magnitude(z), phase: phase(z), gain, mode, quality, half_power })
    }

    /// The mode whose frequency is nearest, with its damping ratio; of a machine that follows the frequency those that it has there.
    fn resounding(&mut self, omega: f64) -> Result<Option<(usize, f64)>, Fault> {
        let here = if self.forced.is_followed() { &self.forced.modes(omega)? } else { self.modes };
        let distance = |m: &Mode| (m.damped - omega).abs();
        let candidates = here.modes.iter().enumerate().filter(|(_, m)| m.kind == Kind::Oscillation);
        Ok(candidates.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1))).map(|(i, m)| (i, m.ratio)))
    }

    /// Where the amplitude has fallen to 1/√2 of the peak, beside it and above the least place.
    fn half(&mut self, (peak, side): (&Peak, f64), least: f64, power_at: &dyn Fn(&mut Self, f64) -> f64) -> f64 {
        let level = 0.5 * peak.amplitude * peak.amplitude;
        let mut inner = peak.omega;
        for step in 1..=200 {
            let outer = peak.omega + side * 0.1 * peak.width * f64::from(step);
            if outer <= least {
                return f64::NAN;
            }
            let power = power_at(self, outer);
            if power > 1.0001 * peak.amplitude * peak.amplitude {
                return f64::NAN;
            }
            if power < level {
                let mut above = |w: f64| power_at(self, w) - level;
                return if side > 0.0 { peaks::zero(&mut above, inner, outer) } else { peaks::zero(&mut |w| -above(w), outer, inner) };
            }
            inner = outer;
        }
        f64::NAN
    }

    fn antiresonances(&mut self) -> Result<Vec<Antiresonance>, Fault> {
        let mut found = Vec::new();
        if self.undamped() {
            for i in 1..self.points.len() {
                let [a, b] = [i - 1, i].map(|j| part(self.points[j].outputs[self.k]));
                let finite = a.is_finite() && b.is_finite() && a * b < 0.0;
                if !finite {
                    continue;
                }
                let (low, high) = (self.omegas[i - 1], self.omegas[i]);
                let omega = peaks::zero(&mut |w| part(self.value(w)), low, high);
                let value = magnitude(self.value(omega));
                // a change of sign through a pole grows, through zero it shrinks
                if value <= 1e-6 * a.abs().max(b.abs()) {
                    found.push(Antiresonance { exact: true, ..self.antiresonance(omega, 0.0)? });
                }
            }
            return Ok(found);
        }
        let powers = self.powers();
        for c in peaks::candidates(&powers, -1.0) {
            let (low, high) = (self.omegas[c - 1], self.omegas[c + 1]);
            let least = peaks::refine(&mut |w| square(self.value(w)), low, high, -1.0);
            let beside = powers[c - 1].max(powers[c + 1]).sqrt();
            let exact = least.amplitude <= STILL * beside;
            if !exact && !self.leads(&least) {
                continue;
            }
            found.push(Antiresonance { exact, ..self.antiresonance(least.omega, least.amplitude)? });
        }
        Ok(found)
    }

    /// At an antiresonance the phase turns forward; in a mere valley between two resonances it turns back.
    fn leads(&mut self, least: &Peak) -> bool {
        let h = 0.01 * least.width.min(0.1 * least.omega);
        let (a, b) = (self.value(least.omega - h), self.value(least.omega + h));
        a.0 * b.1 - a.1 * b.0 > 0.0
    }

    fn antiresonance(&mut self, omega: f64, amplitude: f64) -> Result<Antiresonance, Fault> {
        let matrices = self.forced.matrices(omega)?;
        let point = self.forced.at(omega)?;
        let n = matrices.n;
        let x = &point.coordinates;
        // share of coordinate i: its row of Xᴴ M X
        let row = |i: usize| (0..n).map(|j| matrices.mass[i * n + j] * (x[i].0 * x[j].0 + x[i].1 * x[j].1)).sum::<f64>();
        let total: f64 = (0..n).map(row).sum();
        let mut absorbs: Vec<(usize, f64)> = (0..n).map(|i| (i, row(i) / total)).filter(|(_, s)| *s > SHARE).collect();
        absorbs.arrange_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        Ok(Antiresonance { output: self.k, omega, amplitude, exact: false, absorbs })
    }
}

impl Search<'_, '_> {
    fn beside(&mut self, root: Complex, offset: f64) -> Complex {
        let k = self.k;
        self.forced.beside(root, offset).map_or((f64::NAN, f64::NAN), |p| p.outputs[k])
    }

    /// Peaks beside the roots.
    fn sharp(&mut self) -> Result<Vec<Resonance>, Fault> {
        let mut found = Vec::new();
        for own in self.sharp_roots {
            let half = own.half();
            let offsets: Vec<f64> = LOOKED[1..].iter().rev().map(|s| -s).chain(LOOKED).map(|s| s * half).collect();
            let powers: Vec<f64> = offsets.iter().map(|offset| square(self.beside(own.root, *offset))).collect();
            for c in peaks::candidates(&powers, 1.0) {
                let peak = peaks::refine(&mut |offset| square(self.beside(own.root, offset)), offsets[c - 1], offsets[c + 1], 1.0);
                found.push(self.sharp_resonance(own, peak)?);
            }
        }
        Ok(found)
    }

    fn sharp_resonance(&mut self, own: &Root, peak: Peak) -> Result<Resonance, Fault> {
        let point = self.forced.beside(own.root, peak.omega)?;
        let (z, still) = (point.outputs[self.k], magnitude(point.still[self.k]));
        let half_power = [-1.0, 1.0]
            .map(|side| own.root.1 + self.half((&peak, side), f64::NEG_INFINITY, &|search, at| square(search.beside(own.root, at))));
        Ok(Resonance {
            output: self.k,
            omega: point.omega,
            amplitude: magnitude(z),
            phase: phase(z),
            gain: if still > 0.0 { magnitude(z) / still } else { f64::NAN },
            mode: Some(own.mode),
            // ζ = -Re λ/|λ|, and |λ| is Im λ but for a square of ζ
            quality: -0.5 * own.root.1 / own.root.0,
            half_power,
        })
    }
}

fn square(z: Complex) -> f64 {
    z.0 * z.0 + z.1 * z.1
}

/// The part that is not zero when all values lie on one axis.
fn part(z: Complex) -> f64 {
    if z.0.abs() >= z.1.abs() { z.0 } else { z.1 }
}
