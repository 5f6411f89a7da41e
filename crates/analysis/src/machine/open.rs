//! Reactions that are not unique at a state: several contacts, frictions at rest and supports hold the same motion.
//!
//! With the columns of the forces F on the coordinates and R in the balances of released bodies, of everything that acts in these modes, frictions that slide
//! counted with what presses them,
//!
//! ```text
//! [F; R] d = 0        directions in which the reactions may change and nothing else does
//! ```
//!
//! Along such a direction contacts stay pushing and frictions within their limits ([`crate::rest::admissible`]); where these fix a reaction after all (two feet that
//! bear nothing together bear nothing each) it keeps its value. An output that changes along what is left has no value at this state: it is not a number. So sums and
//! moments that are unique keep theirs.

use algebra::elementary;

use program::{Mode, Point};

use super::Machine;
use super::conditions::{Conditions, Holds};
use super::sharing::Sharing;
use crate::Fault;
use crate::rest::admissible::{Hold, Holds as Held, Limit};
use algebra::qr::Qr;

/// Share of a column that counts as none when it is combined from others.
const NOTHING: f64 = 1e-9;
/// Share of what its terms change by below which an output does not change along a direction.
const STEADY: f64 = 1e-7;
/// Repetitions for frictions that press each other.
const TURNS: usize = 50;

/// A reaction that acts as a force of its own at a state.
pub(super) struct Acting {
    pub(super) reaction: usize,
    pub(super) guard: Option<usize>,
    kind: Kind,
}

/// What acts, and what of it is open.
struct Freedom {
    acting: Vec<Acting>,
    /// Reactions under a unit of each.
    ways: Vec<Vec<f64>>,
    /// Combinations that do nothing.
    free: Vec<Vec<f64>>,
}

/// What presses a friction.
pub(super) struct Pressed {
    pub(super) kinetic: f64,
    pub(super) fixed: f64,
    /// Not negative.
    pub(super) normal: f64,
    /// Whether it has one component.
    pub(super) single: bool,
    /// How it changes with each reaction.
    pub(super) terms: Vec<f64>,
}

/// What acts at a state, by column of its limits.
pub(super) struct Limits {
    pub(super) acting: Vec<Acting>,
    pub(super) hold: Hold,
    /// Whether the limits are linear in the reactions.
    pub(super) exact: bool,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Bilateral,
    Contact,
    /// At rest, with its index among the frictions.
    Friction(usize),
}

/// A friction that slides: λ = factor N.
pub(super) struct Sliding {
    reaction: usize,
    factor: f64,
    terms: Vec<(usize, f64)>,
}

/// What acts at a state, and the directions in which the reactions are open, by reaction.
pub(super) struct Open {
    acting: Vec<Acting>,
    directions: Vec<Vec<f64>>,
}

impl Open {
    pub(super) fn into_directions(self) -> Vec<Vec<f64>> {
        self.directions
    }
}

impl Machine {
    /// As [`Machine::solve_forces`]; where supports share a load they take one of the shares that balance it.
    pub(super) fn solve_any(&mut self, t: f64, x: &[f64]) -> Result<(), Fault> {
        match self.solve_forces(t, x) {
            Err(fault) if self.sharing.piecewise => {
                if self.share(t, x)? {
                    Ok(())
                } else {
                    Err(fault)
                }
            }
            solved => solved,
        }
    }

    /// Whether something is shared in the modes of `observing`.
    pub(super) fn may_share(&self) -> bool {
        self.sharing.may_share(&self.observing.modes)
    }

    /// Accelerations and reactions, and what they leave open.
    pub(super) fn solve_shared(&mut self, t: f64, x: &[f64]) -> Result<Option<Open>, Fault> {
        self.solve_any(t, x)?;
        if !self.may_share() {
            return Ok(None);
        }
        let reactions = self.accelerations[self.bound.program().coordinates..].to_vec();
        let open = self.open_directions((t, x), &reactions)?;
        if open.is_some() && self.sharing.piecewise {
            self.share(t, x)?;
        }
        Ok(open)
    }

    /// Accelerations from the motion alone, supports as one solution of all balances; whether there is one.
    fn share(&mut self, t: f64, x: &[f64]) -> Result<bool, Fault> {
        let roots = self.bound.rates(t, x, &self.observing.modes)?.to_vec();
        let program = self.bound.program();
        let (n, states) = (program.coordinates, program.states.len());
        self.accelerations.clear();
        self.accelerations.extend_from_slice(&roots[n..2 * n]);
        self.accelerations.resize(n + program.reactions, 0.0);
        for (r, value) in program.solved.iter().zip(&roots[states..]) {
            self.accelerations[n + r] = *value;
        }
        let hidden: Vec<usize> = program.hidden.iter().copied().filter(|r| !program.solved.contains(r)).collect();
        let shares = self.balances.evaluate(&Point { time: t, states: x, ..Point::default() })?;
        let rows = shares.len() / program.reactions.max(1);
        let matrix: Vec<f64> = (0..rows).flat_map(|b| hidden.iter().map(move |r| b * program.reactions + r)).map(|k| shares[k]).collect();
        let point = Point { time: t, states: x, accelerations: &self.accelerations, ..Point::default() };
        let missing = self.second.evaluate(&point)?[n..n + rows].to_vec();
        let (found, left) = Qr::alike(&matrix, rows, hidden.len(), NOTHING).least_squares(&missing);
        hidden.iter().zip(found).for_each(|(r, value)| self.accelerations[n + r] = value);
        let size = missing.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        Ok(left <= NOTHING * size)
    }

    /// Takes away the values of outputs that have none.
    pub(super) fn leave_open(&mut self, (t, x): (f64, &[f64]), open: &Open, values: &mut [f64]) -> Result<(), Fault> {
        let (n, count) = (self.bound.program().coordinates, self.bound.program().reactions);
        let base = self.accelerations.clone();
        let unit = base[n..].iter().filter(|v| v.is_finite()).fold(0.0_f64, |m, v| m.max(v.abs()));
        let unit = if unit > 0.0 { unit } else { 1.0 };
        let shown = self.shown.clone();
        let known = values.to_vec();
        for direction in &open.directions {
            let whole = self.outputs_beside((t, x), &base, direction, unit)?;
            let mut terms = vec![0.0; shown.len()];
            for r in (0..count).filter(|r| direction[*r] != 0.0) {
                let alone: Vec<f64> = (0..count).map(|k| if k == r { direction[k] } else { 0.0 }).collect();
                let changed = self.outputs_beside((t, x), &base, &alone, unit)?;
                terms.iter_mut().zip(changed).zip(&shown).for_each(|((sum, v), &i)| *sum += (v - known[i]).abs());
            }
            let guards: Vec<usize> = open.acting.iter().filter(|a| direction[a.reaction] != 0.0).filter_map(|a| a.guard).collect();
            for ((value, terms), &i) in whole.iter().zip(&terms).zip(&shown) {
                if (value - known[i]).abs() > STEADY * terms {
                    values[i] = f64::NAN;
                    let seen = self.sharing.seen.entry(i).or_default();
                    seen.extend(&guards);
                    seen.sort_unstable();
                    seen.dedup();
                }
            }
        }
        self.accelerations = base;
        Ok(())
    }

    /// The shown outputs with the reactions a step along a direction.
    fn outputs_beside(&mut self, (t, x): (f64, &[f64]), base: &[f64], direction: &[f64], unit: f64) -> Result<Vec<f64>, Fault> {
        let n = self.bound.program().coordinates;
        let mut inputs = base.to_vec();
        inputs[n..].iter_mut().zip(direction).filter(|(_, d)| **d != 0.0).for_each(|(v, d)| *v += unit * d);
        let modes = &self.observing;
        let point = Point { time: t, states: x, accelerations: &inputs, modes: Some(&modes.modes), active: Some(&modes.active) };
        Ok(self.observed.evaluate(&point)?.to_vec())
    }

    /// See [`crate::System::moves_otherwise`]: whether a direction in which the reactions balance by themselves changes what frictions that slide under them do.
    pub(super) fn shares_move(&mut self, t: f64, x: &[f64]) -> Result<bool, Fault> {
        if !self.may_share() {
            return Ok(false);
        }
        self.solve_any(t, x)?;
        let program = self.bound.program();
        let reactions = self.accelerations[program.coordinates..].to_vec();
        let laws = self.laws.evaluate(&Point { time: t, states: x, ..Point::default() })?.to_vec();
        let shares = self.balances.evaluate(&Point { time: t, states: x, ..Point::default() })?.to_vec();
        let Some(conditions) = &mut self.conditions else { return Ok(false) };
        conditions.evaluate(t, x)?;
        let modes = &self.observing.modes;
        let acting = conditions.acting(modes, &program.hidden);
        let sliding = conditions.sliding(modes, (&laws, &reactions), &self.sharing);
        let ways = |sliding: &[Sliding]| acting.iter().map(|a| with_sliding(a.reaction, program.reactions, sliding)).collect::<Vec<_>>();
        let effects = |ways: Vec<Vec<f64>>| ways.iter().map(|way| conditions.effect(way, &shares)).collect::<Vec<_>>();
        let rubbing = effects(ways(&sliding));
        let free = null_space(&effects(ways(&[])));
        if sliding.is_empty() || free.is_empty() {
            return Ok(false);
        }
        let hold = hold(&acting, free, (&reactions, &laws), (conditions, &self.sharing));
        let moves = |z: &Vec<f64>| {
            (0..conditions.n).any(|i| {
                let terms = || z.iter().zip(&rubbing).map(|(z, effect)| z * effect[i]);
                terms().sum::<f64>().abs() > NOTHING * terms().map(f64::abs).sum::<f64>()
            })
        };
        Ok(unpinned(&hold).iter().any(moves))
    }

    /// What acts in the modes of `observing`, with the directions in which reactions of the last solution are open and the limits along them; none where all are unique.
    pub(super) fn limits_of_acting(&mut self, (t, x): (f64, &[f64])) -> Result<Option<Limits>, Fault> {
        let inputs = self.accelerations.clone();
        let pressing = self.pressing((t, x), &inputs);
        let reactions = &inputs[self.bound.program().coordinates..];
        let laws = self.laws.evaluate(&Point { time: t, states: x, ..Point::default() })?.to_vec();
        let shares = self.balances.evaluate(&Point { time: t, states: x, ..Point::default() })?.to_vec();
        let Some(conditions) = &self.conditions else { return Ok(None) };
        let Freedom { acting, free, .. } = self.freedom(conditions, (&laws, &shares), reactions);
        if free.is_empty() {
            return Ok(None);
        }
        let mut hold = hold(&acting, free, (reactions, &laws), (conditions, &self.sharing));
        hold.limits =
            acting.iter().enumerate().filter_map(|(column, a)| whole_limit((column, a), (&acting, &pressing), reactions)).collect();
        let of = |a: &Acting| pressing.iter().find(|(r, _)| *r == a.reaction).is_none_or(|(_, pressed)| pressed.single);
        let exact = acting.iter().all(of);
        Ok(Some(Limits { acting, hold, exact }))
    }

    /// What acts in the modes of `observing` beside these reactions, what each does with the frictions that slide under it, and the combinations that do nothing.
    fn freedom(&self, conditions: &Conditions, (laws, shares): (&[f64], &[f64]), reactions: &[f64]) -> Freedom {
        let program = self.bound.program();
        let modes = &self.observing.modes;
        let acting = conditions.acting(modes, &program.hidden);
        let sliding = conditions.sliding(modes, (laws, reactions), &self.sharing);
        let ways: Vec<Vec<f64>> = acting.iter().map(|a| with_sliding(a.reaction, program.reactions, &sliding)).collect();
        let columns: Vec<Vec<f64>> = ways.iter().map(|way| conditions.effect(way, shares)).collect();
        Freedom { acting, free: null_space(&columns), ways }
    }

    /// What presses each friction with these accelerations and reactions, by reaction: the resultant along its own direction, as a linear form about them.
    pub(super) fn pressing(&mut self, (t, x): (f64, &[f64]), inputs: &[f64]) -> Vec<(usize, Pressed)> {
        let (Some(normals), Ok(laws)) =
            (self.normals((t, x), inputs), self.laws.evaluate(&Point { time: t, states: x, ..Point::default() }))
        else {
            return Vec::new();
        };
        let Some(conditions) = &self.conditions else { return Vec::new() };
        let one = |row: &super::conditions::Row| {
            let (Some(reaction), Holds::Sticking(_, friction)) = (row.reaction, row.holds) else { return None };
            let place = self.touching.iter().position(|place| place.reaction == reaction)?;
            let ([kinetic, fixed], [first, second]) = conditions.law(friction, laws);
            let [along, across] = normals[place];
            let size = elementary::hypot(along, across);
            let way = if size > 0.0 { [along / size, across / size] } else { [1.0, 0.0] };
            let terms = first.iter().zip(second).map(|(a, b)| way[0] * a + way[1] * b).collect();
            let single = second.iter().all(|f| *f == 0.0);
            Some((reaction, Pressed { kinetic, fixed, normal: size, single, terms }))
        };
        conditions.rows.iter().filter_map(one).collect()
    }

    /// What acts, and the directions in which reactions or impulses of these values are open, by reaction; none where all are unique.
    pub(super) fn open_directions(&mut self, (t, x): (f64, &[f64]), reactions: &[f64]) -> Result<Option<Open>, Fault> {
        let laws = self.laws.evaluate(&Point { time: t, states: x, ..Point::default() })?.to_vec();
        let shares = self.balances.evaluate(&Point { time: t, states: x, ..Point::default() })?.to_vec();
        let program = self.bound.program();
        let Some(conditions) = &mut self.conditions else { return Ok(open_supports(&program.hidden, program.reactions, &shares)) };
        conditions.evaluate(t, x)?;
        let Some(conditions) = &self.conditions else { return Ok(None) };
        let Freedom { acting, ways, free } = self.freedom(conditions, (&laws, &shares), reactions);
        if free.is_empty() {
            return Ok(None);
        }
        let hold = hold(&acting, free, (reactions, &laws), (conditions, &self.sharing));
        let combined = |z: Vec<f64>| {
            let mut sum = vec![0.0; program.reactions];
            for (share, way) in z.iter().zip(&ways).filter(|(share, _)| **share != 0.0) {
                sum.iter_mut().zip(way).for_each(|(s, w)| *s += share * w);
            }
            sum
        };
        let directions: Vec<Vec<f64>> = unpinned(&hold).into_iter().map(combined).collect();
        Ok((!directions.is_empty()).then_some(Open { acting, directions }))
    }
}

impl Conditions {
    fn acting(&self, modes: &[Mode], hidden: &[usize]) -> Vec<Acting> {
        let zero = |guard: usize| modes[guard] == Mode::Zero;
        let of_row = |row: &super::conditions::Row| {
            let reaction = row.reaction?;
            let (guard, kind) = match row.holds {
                Holds::Always => (None, Kind::Bilateral),
                Holds::Sticking(guard, friction) if zero(guard) => (Some(guard), Kind::Friction(friction)),
                Holds::Closed(guard, _) if zero(guard) => (Some(guard), Kind::Contact),
                Holds::Rough(guard) if zero(guard) => (Some(guard), Kind::Bilateral),
                _ => return None,
            };
            Some(Acting { reaction, guard, kind })
        };
        let others = self.motors.iter().chain(hidden);
        let bilateral = |r: &usize| Acting { reaction: *r, guard: None, kind: Kind::Bilateral };
        self.rows.iter().filter_map(of_row).chain(others.map(bilateral)).collect()
    }

    /// Coefficient at rest, factors of the reactions in both components of the normal force.
    pub(super) fn law<'l>(&self, friction: usize, laws: &'l [f64]) -> ([f64; 2], [&'l [f64]; 2]) {
        let width = 2 + 2 * self.reactions;
        let own = &laws[self.law_roots.frictions.start + friction * width..][..width];
        let (first, second) = own[2..].split_at(self.reactions);
        ([own[0], own[1]], [first, second])
    }

    pub(super) fn sliding(&self, modes: &[Mode], (laws, reactions): (&[f64], &[f64]), sharing: &Sharing) -> Vec<Sliding> {
        let mut list = Vec::new();
        for row in &self.rows {
            let (Some(reaction), Holds::Sticking(guard, friction)) = (row.reaction, row.holds) else { continue };
            let ([kinetic, _], [first, second]) = self.law(friction, laws);
            let way = match modes[guard] {
                Mode::Zero => continue,
                Mode::Positive => 1.0,
                Mode::Negative => -1.0,
            };
            let component = |factors: &[f64]| factors.iter().zip(reactions).filter(|(f, _)| **f != 0.0).map(|(f, p)| f * p).sum::<f64>();
            let along = if second.iter().any(|f| *f != 0.0) {
                let both = [component(first), component(second)];
                let size = elementary::hypot(both[0], both[1]);
                if size > 0.0 { both.map(|c| c / size) } else { [1.0, 0.0] }
            } else {
                let side = sharing.sides.iter().find(|(r, _)| *r == reaction).map(|(_, guard)| modes[*guard]);
                [if side == Some(Mode::Negative) { -1.0 } else { 1.0 }, 0.0]
            };
            let terms = first.iter().zip(second).map(|(a, b)| along[0] * a + along[1] * b).enumerate().filter(|(_, f)| *f != 0.0).collect();
            list.push(Sliding { reaction, factor: way * kinetic, terms });
        }
        list
    }

    /// What reactions together do: on the coordinates, in the metric of the kinetic energy, and in the balances.
    fn effect(&self, way: &[f64], shares: &[f64]) -> Vec<f64> {
        let mut column = vec![0.0; self.n];
        for (r, share) in way.iter().enumerate().filter(|(_, share)| **share != 0.0) {
            column.iter_mut().zip(self.push(r)).for_each(|(sum, f)| *sum += share * f);
        }
        self.metric().forward(&mut column);
        column.extend(shares.chunks(self.reactions).map(|row| row.iter().zip(way).map(|(f, share)| f * share).sum::<f64>()));
        column
    }
}

/// The same of a machine that has supports only.
fn open_supports(hidden: &[usize], reactions: usize, shares: &[f64]) -> Option<Open> {
    let columns: Vec<Vec<f64>> = hidden.iter().map(|r| shares.chunks(reactions).map(|row| row[*r]).collect()).collect();
    let whole = |z: Vec<f64>| {
        let mut way = vec![0.0; reactions];
        hidden.iter().zip(z).for_each(|(r, share)| way[*r] = share);
        way
    };
    let directions: Vec<Vec<f64>> = null_space(&columns).into_iter().map(whole).collect();
    (!directions.is_empty()).then_some(Open { acting: Vec::new(), directions })
}

/// A unit of a reaction with the frictions that slide under it.
pub(super) fn with_sliding(reaction: usize, count: usize, sliding: &[Sliding]) -> Vec<f64> {
    let mut way = vec![0.0; count];
    way[reaction] = 1.0;
    for _ in 0..TURNS {
        let before = way.clone();
        for friction in sliding {
            way[friction.reaction] = friction.factor * friction.terms.iter().map(|(k, f)| f * way[*k]).sum::<f64>();
        }
        if way == before {
            break;
        }
    }
    way
}

/// Combinations of columns that vanish; columns that vanish by themselves are left alone.
fn null_space(columns: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let (rows, count) = (columns.first().map_or(0, Vec::len), columns.len());
    let heights: Vec<f64> = (0..rows).map(|i| columns.iter().fold(0.0_f64, |m, c| m.max(c[i].abs()))).collect();
    let entry = |i: usize, k: usize| if heights[i] > 0.0 { columns[k][i] / heights[i] } else { 0.0 };
    let lengths: Vec<f64> = (0..count).map(|k| (0..rows).map(|i| elementary::powi(entry(i, k), 2)).sum::<f64>().sqrt()).collect();
    let kept: Vec<usize> = (0..count).filter(|k| lengths[*k] > 0.0).collect();
    if kept.is_empty() {
        return Vec::new();
    }
    let matrix: Vec<f64> = (0..rows).flat_map(|i| kept.iter().map(move |&k| (i, k))).map(|(i, k)| entry(i, k) / lengths[k]).collect();
    let whole = |z: Vec<f64>| {
        let largest = z.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let mut out = vec![0.0; count];
        for (&k, share) in kept.iter().zip(z).filter(|(_, share)| share.abs() > NOTHING * largest) {
            out[k] = share / lengths[k];
        }
        let largest = out.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        out.iter_mut().for_each(|v| *v /= largest);
        out
    };
    Qr::alike(&matrix, rows, kept.len(), NOTHING).null_space().into_iter().map(whole).collect()
}

/// The limits of what acts, about the reactions that were found.
fn hold(acting: &[Acting], free: Vec<Vec<f64>>, (reactions, laws): (&[f64], &[f64]), (c, sharing): (&Conditions, &Sharing)) -> Hold {
    let known = |r: usize| if reactions[r].is_finite() { reactions[r] } else { 0.0 };
    let mut hold = Hold { some: acting.iter().map(|a| known(a.reaction)).collect(), free, ..Hold::default() };
    for (column, a) in acting.iter().enumerate() {
        match a.kind {
            Kind::Bilateral => {}
            Kind::Contact => hold.contacts.push(column),
            Kind::Friction(friction) => {
                let ([_, coefficient], [first, second]) = c.law(friction, laws);
                // a limit that is not known here does not fix anything
                if !sharing.whole[friction] || second.iter().any(|f| *f != 0.0) {
                    continue;
                }
                let pressing = first.iter().copied().enumerate().filter(|(_, f)| *f != 0.0).collect::<Vec<_>>();
                let place = |r: usize| acting.iter().position(|a| a.reaction == r);
                let terms = pressing.iter().filter_map(|(r, f)| place(*r).map(|k| (k, *f))).collect();
                let constant = pressing.iter().filter(|(r, _)| place(*r).is_none()).map(|(r, f)| f * known(*r)).sum();
                hold.limits.push(Limit { column, coefficient, normal: (!pressing.is_empty()).then_some((constant, terms)) });
            }
        }
    }
    hold
}

/// The limit of a friction about these reactions.
fn whole_limit((column, own): (usize, &Acting), (acting, pressing): (&[Acting], &[(usize, Pressed)]), reactions: &[f64]) -> Option<Limit> {
    let Kind::Friction(_) = own.kind else { return None };
    let (_, pressed) = pressing.iter().find(|(r, _)| *r == own.reaction)?;
    let known = |r: usize| if reactions[r].is_finite() { reactions[r] } else { 0.0 };
    let terms: Vec<(usize, f64)> =
        acting.iter().enumerate().filter(|(_, a)| pressed.terms[a.reaction] != 0.0).map(|(k, a)| (k, pressed.terms[a.reaction])).collect();
    let constant = pressed.normal - terms.iter().map(|(k, f)| f * known(acting[*k].reaction)).sum::<f64>();
    Some(Limit { column, coefficient: pressed.fixed, normal: Some((constant, terms)) })
}

/// Directions along which no reaction changes that its limits fix.
fn unpinned(hold: &Hold) -> Vec<Vec<f64>> {
    let Held::Between(ranges) = hold.judge() else { return hold.free.clone() };
    let pinned: Vec<usize> = (0..ranges.len()).filter(|k| ranges[*k].0 == ranges[*k].1 && !hold.is_unique(*k)).collect();
    if pinned.is_empty() {
        return hold.free.clone();
    }
    let matrix: Vec<f64> = pinned.iter().flat_map(|k| hold.free.iter().map(|z| z[*k])).collect();
    let combined = |y: Vec<f64>| {
        let mut sum = vec![0.0; hold.some.len()];
        for (share, z) in y.iter().zip(&hold.free) {
            sum.iter_mut().zip(z).for_each(|(s, v)| *s += share * v);
        }
        let largest = sum.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        sum.iter_mut().for_each(|v| *v = if v.abs() <= NOTHING * largest { 0.0 } else { *v });
        sum
    };
    Qr::alike(&matrix, pinned.len(), hold.free.len(), NOTHING).null_space().into_iter().map(combined).collect()
}
