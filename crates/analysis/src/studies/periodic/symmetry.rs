//! Translations under which the motion is the same: a coordinate that the equations do not contain, a point carried along with x = v t.
//!
//! Along the turn the accelerations, the rates of auxiliary states and the guards are differentiated by q, s and t; what lies in the null space
//! of all these rows is a direction (dq, ds, dt) of translation. A motion is periodic when it comes back up to such translations and whole
//! turns of angles.

use super::orbit::Orbit;
use super::slopes::{Known, WIDTH, derivative, slopes};
use crate::{Fault, Mode, Since, System};
use algebra::qr::Qr;
use algebra::random::Random;

/// Points of the turn at which derivatives are taken.
const POINTS: usize = 12;
/// Off the motion the laws are looked at this share of the scales beside it: where the machine rests, its laws may say nothing of time.
const BESIDE: f64 = 0.05;
/// Share of a row below which an entry is rounding of the differences.
const NOISE: f64 = 1e-9;
/// The same of exact derivatives, in which a solution of the balances leaves some hundred units of the last place: a spring of 10⁻¹⁰ of another one may alone hold a direction.
const EXACT: f64 = 1e-12;
/// Rounding of a difference of places, some units of the last place over its width, relative to the place beside its scale.
const DIFFERENCE: f64 = 8.0 * f64::EPSILON / WIDTH;

/// Directions of translation.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Symmetry {
    /// Velocity of the frame in which time does not occur, by state (zero for rates); none when the machine is driven in time.
    pub(super) frame: Option<Vec<f64>>,
    /// Directions at one instant, by state: each has 1 at its pivot, and 0 at the pivots of the others.
    pub(super) shifts: Vec<(usize, Vec<f64>)>,
    /// Directions that the laws do not feel and that connections do not leave free: where a wheel has rolled to follows from its angle, and need not come back with it.
    pub(super) followers: Vec<Vec<f64>>,
}

impl Symmetry {
    /// With what is left of all translations that the laws do not feel beside those that connections leave free.
    pub(super) fn followed(mut self, loose: &Symmetry, scales: &[f64]) -> Symmetry {
        let in_scales = |shift: &Vec<f64>| -> Vec<f64> {
            let scaled: Vec<f64> = shift.iter().zip(scales).map(|(v, s)| v / s).collect();
            let size = scaled.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            scaled.iter().map(|v| v / size).collect()
        };
        let mut left: Vec<Vec<f64>> = loose.shifts.iter().map(|(_, shift)| in_scales(shift)).collect();
        for (pivot, shift) in &self.shifts {
            let own = in_scales(shift);
            for direction in &mut left {
                let amount = direction[*pivot] / own[*pivot];
                direction.iter_mut().zip(&own).for_each(|(d, v)| *d -= amount * v);
                direction[*pivot] = 0.0;
            }
        }
        while let Some((pivot, _)) = left.iter().flat_map(|d| d.iter().enumerate()).max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())) {
            let Some(direction) = eliminate(&mut left, pivot, |d, k| d[k].abs()) else { break };
            self.followers.push(direction.iter().zip(scales).map(|(d, s)| d * s).collect());
        }
        self
    }
}

/// Which translations count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reach {
    /// Those that the conditions of connections allow.
    Possible,
    /// All that the laws do not feel.
    Any,
}

/// Finds the translations; `keep` is the state that should be a pivot where it can.
pub(super) fn find<S: System + ?Sized>(
    system: &mut S,
    orbit: &Orbit,
    scales: &[f64],
    keep: Option<usize>,
    reach: Reach,
) -> Result<Symmetry, Fault> {
    let (n, n_x) = (system.n_coordinates(), orbit.first.len());
    let places: Vec<usize> = (0..n).chain(2 * n..n_x).collect();
    let sizes: Vec<f64> = places.iter().map(|&i| scales[i]).chain([orbit.period]).collect();
    let columns = places.len() + 1;
    let samples = samples(system, orbit, scales);
    let (closed, matrix, norms) = (orbit.closed(), Vec::new(), Vec::new());
    let mut table = Table { samples, closed, places: places.clone(), sizes: sizes.clone(), noise: EXACT, matrix, norms };
    for k in 0..table.samples.len() {
        rows(system, k, scales, orbit.period, &mut table)?;
    }
    let laws = table.norms.len();
    if reach == Reach::Possible {
        let own: Vec<usize> = (0..table.samples.len()).filter(|&k| table.samples[k].own).collect();
        for &k in own.iter().step_by(4) {
            conditions(system, k, scales, orbit.period, &mut table)?;
        }
    }
    let (of_laws, of_conditions) = table.matrix.split_at(laws * columns);
    let unfelt = Qr::alike(of_laws, laws, columns, table.noise).null_space();
    let mut directions = within(unfelt, of_conditions);
    let rank = |direction: &[f64], k: usize| direction[k].abs();
    let keep = keep.and_then(|state| places.iter().position(|&i| i == state));
    let mut symmetry = Symmetry::default();
    // time first, so that the others have no part in it
    if let Some(moving) = eliminate(&mut directions, columns - 1, rank) {
        let mut frame = vec![0.0; n_x];
        places.iter().enumerate().for_each(|(k, &i)| frame[i] = moving[k] * sizes[k] / sizes[columns - 1]);
        symmetry.frame = Some(refined(system, &table, frame, orbit.period)?);
    }
    while !directions.is_empty() {
        // entries of directions of unit size: rounding of differences is 1e-10
        let free = |k: &usize| directions.iter().any(|d| d[*k].abs() > 1e-6);
        let largest = |k: &usize| directions.iter().map(|d| d[*k].abs()).fold(0.0, f64::max);
        let best = (0..columns - 1).max_by(|a, b| largest(a).total_cmp(&largest(b)));
        let Some(pivot) = keep.filter(free).filter(|k| symmetry.shifts.iter().all(|(p, _)| *p != places[*k])).or(best) else { break };
        let Some(direction) = eliminate(&mut directions, pivot, rank) else { break };
        let mut shift = vec![0.0; n_x];
        places.iter().enumerate().for_each(|(k, &i)| shift[i] = direction[k] * sizes[k] / sizes[pivot]);
        let p = places[pivot];
        for (_, other) in &mut symmetry.shifts {
            let factor = other[p];
            other.iter_mut().zip(&shift).for_each(|(o, s)| *o -= factor * s);
        }
        symmetry.shifts.push((p, shift));
    }
    if let Some(frame) = &mut symmetry.frame {
        for (p, shift) in &symmetry.shifts {
            let factor = frame[*p];
            frame.iter_mut().zip(shift).for_each(|(f, s)| *f -= factor * s);
        }
    }
    Ok(symmetry)
}

struct Sample {
    /// Whether the motion passes there.
    own: bool,
    t: f64,
    x: Vec<f64>,
    modes: Vec<Mode>,
}

/// Scaled derivatives of the laws by places and time.
struct Table {
    samples: Vec<Sample>,
    /// Contacts and frictions, by guard, that hold all along the motion.
    closed: Vec<usize>,
    /// States that are coordinates or auxiliary.
    places: Vec<usize>,
    /// Their scales, then that of time.
    sizes: Vec<f64>,
    /// Share of a row of the laws below which an entry is rounding.
    noise: f64,
    /// Row by row: of the laws, then of the conditions.
    matrix: Vec<f64>,
    /// What each row was divided by.
    norms: Vec<f64>,
}

/// Accelerations, rates of auxiliary states, guards.
fn laws<S: System + ?Sized>(system: &mut S, t: f64, x: &[f64], modes: &[Mode]) -> Result<Vec<f64>, Fault> {
    system.expand(t, x, modes, 1)?;
    let n = system.n_coordinates();
    let rates = (n..x.len()).map(|i| system.state(i)[1]);
    let guards = (0..modes.len()).map(|g| system.guard(g).first().copied().unwrap_or(0.0));
    Ok(rates.chain(guards).collect())
}

/// Adds the rows of one instant.
fn rows<S: System + ?Sized>(system: &mut S, sample: usize, scales: &[f64], period: f64, table: &mut Table) -> Result<(), Fault> {
    let n = system.n_coordinates();
    let Sample { t, x, modes, .. } = &table.samples[sample];
    let values = laws(system, *t, x, modes)?;
    let mut slopes_of = Vec::new();
    let noise = match slopes(system, (*t, x), modes, scales, &mut slopes_of)? {
        Known::Exactly => EXACT,
        Known::Roughly => NOISE,
    };
    table.noise = table.noise.max(noise);
    for (k, row) in slopes_of.chunks(x.len() + 1).skip(n).enumerate() {
        let (row, time) = row.split_at(x.len());
        if !row.iter().chain(time).all(|v| v.is_finite()) {
            // a slope that does not exist says nothing
            table.matrix.resize(table.matrix.len() + table.places.len() + 1, 0.0);
            table.norms.push(f64::INFINITY);
            continue;
        }
        let total: f64 = row.iter().zip(scales).map(|(d, s)| (d * s).abs()).sum::<f64>() + (time[0] * period).abs();
        let own = match scales.get(n + k) {
            Some(scale) => scale / period,
            None => values[k].abs(),
        };
        let norm = total.max(own).max(f64::MIN_POSITIVE);
        let entries = table.places.iter().map(|&i| row[i] * scales[i]).chain([time[0] * period]);
        table.matrix.extend(entries.map(|e| e / norm).map(|e| if e.abs() < noise { 0.0 } else { e }));
        table.norms.push(norm);
    }
    Ok(())
}

/// Adds rows that vanish for directions in which the machine can be moved: the projection on the conditions leaves them as they are.
fn conditions<S: System + ?Sized>(system: &mut S, sample: usize, scales: &[f64], period: f64, table: &mut Table) -> Result<(), Fault> {
    let Sample { t, x, modes, .. } = &table.samples[sample];
    let mut moved = |time: f64, place: &[f64]| {
        let mut place = place.to_vec();
        system.rejoin(time, &mut place, modes, Since { t: *t, x, closed: &table.closed })?;
        Ok(place)
    };
    let by_state = derivative(x, scales, |place| moved(*t, place))?;
    let by_time = derivative(&[*t], &[period], |time| moved(time[0], x))?;
    for (i, (row, time)) in by_state.iter().zip(&by_time).enumerate() {
        let change = |j: usize| row[j] - if i == j { 1.0 } else { 0.0 };
        let entries = table.places.iter().map(|&j| change(j) * scales[j]).chain([time[0] * period]);
        // a coordinate that has gone far keeps fewer digits of a difference
        let noise = NOISE.max(DIFFERENCE * x[i].abs() / scales[i]);
        let entries: Vec<f64> = entries.map(|e| e / scales[i]).map(|e| if e.abs() < noise { 0.0 } else { e }).collect();
        table.matrix.extend(entries);
        table.norms.push(1.0);
    }
    Ok(())
}

/// Those combinations of the directions that the conditions allow too. What these are known by, differences, must not decide what the laws feel.
fn within(mut directions: Vec<Vec<f64>>, conditions: &[f64]) -> Vec<Vec<f64>> {
    let Some(columns) = directions.first().map(Vec::len).filter(|_| !conditions.is_empty()) else { return directions };
    for direction in &mut directions {
        let size = direction.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        direction.iter_mut().for_each(|v| *v /= size);
    }
    let rows: Vec<&[f64]> = conditions.chunks(columns).collect();
    let part = |row: &[f64], direction: &Vec<f64>| row.iter().zip(direction).map(|(a, b)| a * b).sum::<f64>();
    let moved: Vec<f64> = rows.iter().flat_map(|row| directions.iter().map(|direction| part(row, direction))).collect();
    let largest = moved.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    if largest <= NOISE {
        return directions;
    }
    let combine = |shares: Vec<f64>| (0..columns).map(|i| shares.iter().zip(&directions).map(|(s, d)| s * d[i]).sum()).collect();
    Qr::alike(&moved, rows.len(), directions.len(), NOISE / largest.min(1.0)).null_space().into_iter().map(combine).collect()
}

/// Takes out of the directions the one that is largest at `pivot`, normed to 1 there, and clears that entry of the others.
fn eliminate(directions: &mut Vec<Vec<f64>>, pivot: usize, size: impl Fn(&[f64], usize) -> f64) -> Option<Vec<f64>> {
    let best = (0..directions.len()).max_by(|&a, &b| size(&directions[a], pivot).total_cmp(&size(&directions[b], pivot)))?;
    // as in [`find`]
    if size(&directions[best], pivot) < 1e-6 {
        return None;
    }
    let mut taken = directions.swap_remove(best);
    let norm = taken[pivot];
    taken.iter_mut().for_each(|v| *v /= norm);
    for other in directions.iter_mut() {
        let factor = other[pivot];
        other.iter_mut().zip(&taken).for_each(|(o, t)| *o -= factor * t);
    }
    Some(taken)
}

/// The frame's velocity to rounding: a whole period of translation must leave the laws as they are.
fn refined<S: System + ?Sized>(system: &mut S, table: &Table, mut frame: Vec<f64>, period: f64) -> Result<Vec<f64>, Fault> {
    if frame.iter().all(|v| *v == 0.0) {
        return Ok(frame);
    }
    let columns = table.sizes.len();
    let left: Vec<f64> = table.matrix.chunks(columns).flat_map(|row| &row[..columns - 1]).copied().collect();
    for _ in 0..2 {
        let mut right = Vec::new();
        for sample in &table.samples {
            let here = laws(system, sample.t, &sample.x, &sample.modes)?;
            let moved: Vec<f64> = sample.x.iter().zip(&frame).map(|(x, v)| x + v * period).collect();
            let there = laws(system, sample.t + period, &moved, &sample.modes)?;
            right.extend(here.iter().zip(&there).map(|(a, b)| a - b));
        }
        // the frame keeps to the conditions
        right.resize(table.norms.len(), 0.0);
        right.iter_mut().zip(&table.norms).for_each(|(r, norm)| *r /= norm);
        let (change, _) = Qr::alike(&left, right.len(), columns - 1, NOISE).least_squares(&right);
        table.places.iter().enumerate().for_each(|(k, &i)| frame[i] += change[k] * table.sizes[k] / period);
    }
    Ok(frame)
}

/// States of the motion, each with another one beside it at another instant.
fn samples<S: System + ?Sized>(system: &mut S, orbit: &Orbit, scales: &[f64]) -> Vec<Sample> {
    let stride = orbit.steps.len().div_ceil(POINTS).max(1);
    let begin = orbit.steps.first().map_or(0.0, |s| s.start.high);
    let mut random = Random::new(1);
    let mut out = Vec::new();
    for s in orbit.steps.iter().step_by(stride) {
        let x: Vec<f64> = (0..orbit.first.len()).map(|i| s.start_value(i)).collect();
        let beside: Vec<f64> = x.iter().zip(scales).map(|(x, scale)| x + BESIDE * scale * random.between(-1.0, 1.0)).collect();
        out.push(Sample { own: true, t: s.start.high, x, modes: s.modes.clone() });
        let t = begin + orbit.period * random.between(0.0, 1.0);
        // a formula need not have a value there
        if laws(system, t, &beside, &s.modes).is_ok_and(|v| v.iter().all(|v| v.is_finite())) {
            out.push(Sample { own: false, t, x: beside, modes: s.modes.clone() });
        }
    }
    out
}

/// Takes the translations out of a change.
pub(super) fn clear_shifts(symmetry: &Symmetry, change: &mut [f64]) {
    for (pivot, shift) in &symmetry.shifts {
        let amount = change[*pivot];
        change.iter_mut().zip(shift).for_each(|(c, s)| *c -= amount * s);
    }
}

/// Whether the laws are the same after whole turns of some states.
pub(super) fn turned<S: System + ?Sized>(system: &mut S, orbit: &Orbit, turns: &[(usize, f64)], scales: &[f64]) -> Result<bool, Fault> {
    unchanged(system, orbit, scales, |sample| {
        let mut x = sample.x.clone();
        turns.iter().for_each(|(state, count)| x[*state] += std::f64::consts::TAU * count);
        (sample.t, x)
    })
}

/// Whether the laws are the same after this time, while states are carried along with these velocities.
pub(super) fn repeats<S: System + ?Sized>(
    system: &mut S,
    orbit: &Orbit,
    (period, carried): (f64, &[f64]),
    scales: &[f64],
) -> Result<bool, Fault> {
    unchanged(system, orbit, scales, |sample| {
        let mut x = sample.x.clone();
        x.iter_mut().zip(carried).for_each(|(x, v)| *x += v * period);
        (sample.t + period, x)
    })
}

/// Whether the laws do not feel a change of place or time.
fn unchanged<S: System + ?Sized>(
    system: &mut S,
    orbit: &Orbit,
    scales: &[f64],
    change: impl Fn(&Sample) -> (f64, Vec<f64>),
) -> Result<bool, Fault> {
    let n = system.n_coordinates();
    let samples = samples(system, orbit, scales);
    let mut here = Vec::with_capacity(samples.len());
    for sample in &samples {
        here.push(laws(system, sample.t, &sample.x, &sample.modes)?);
    }
    // a guard is zero where it switches: its size is that of the whole motion
    let size = |k: usize| here.iter().map(|values| values[k].abs()).fold(0.0, f64::max);
    let sizes: Vec<f64> = (0..here.first().map_or(0, Vec::len)).map(size).collect();
    for (sample, values) in samples.iter().zip(&here) {
        let (t, x) = change(sample);
        let Ok(there) = laws(system, t, &x, &sample.modes) else { return Ok(false) };
        for (k, (a, b)) in values.iter().zip(&there).enumerate() {
            let own = scales.get(n + k).map_or(0.0, |s| s / orbit.period);
            // laws that do not feel a change differ by rounding of their terms
            if (a - b).abs() > 1e-8 * (own + sizes[k]) {
                return Ok(false);
            }
        }
    }
    Ok(true)
}
