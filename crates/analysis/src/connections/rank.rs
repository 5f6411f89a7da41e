//! Which conditions are independent, and which reactions are unique.
//!
//! Rows of J are taken in their order; one that depends on those before it repeats them. The dependence must hold in neighbouring configurations too:
//! where it holds only at the start the configuration is singular. Which of the rows that repeat each other are equations is chosen where the machine is
//! ([`program::Spare`]), for each of them may lose its levers somewhere; here only their number is found, and the reactions that they leave open, at the start and
//! beside it.
//!
//! Reactions λ enter motions and balances through the columns of [F; R]. Every relation Σ c_k column_k = 0 leaves the λ_k with c_k ≠ 0 open. It may be hidden
//! in the position of the start: positions around it are asked too, and balances are chosen where most are independent.

use program::lower::{Repeated, Selection};
use symbolic::connections::{Law, Reaction};
use words::Text;

use super::Undetermined;
use super::bench::{Bench, listed};
use crate::Fault;
use algebra::arrange::Arrange;
use algebra::qr::Qr;
use algebra::random::Random;
use algebra::vectors::{Basis, norm};

/// Places around the start that are asked whether reactions are open.
const AROUND: usize = 9;
/// How far away they are, in turn: radians, or lengths by the length of the machine. Formulas with switches may have other slopes far away.
const FAR: [f64; 3] = [0.3, 1.0, 3.0];
/// Places beside a start whose conditions depend on one another: one along its rates, the others along any motion.
const TRIALS: usize = 6;
/// How far away a singular position must have ended.
const NEAR: f64 = 0.05;
/// What is left of a row after the others have been taken away counts as nothing below this share of it.
const NOTHING: f64 = 1e-9;

/// Vectors in their order: which are independent, and how the others combine from these (index, share).
pub(super) struct Sorted {
    pub(super) kept: Vec<usize>,
    relations: Vec<(usize, Vec<(usize, f64)>)>,
}

/// What is left of a vector is compared with the vector itself.
pub(super) fn sort(vectors: &[Vec<f64>]) -> Sorted {
    sort_beside(vectors, norm)
}

/// What is left of a vector is compared with a `size`.
fn sort_beside(vectors: &[Vec<f64>], size: impl Fn(&[f64]) -> f64) -> Sorted {
    let mut basis = Basis::default();
    let mut sorted = Sorted { kept: Vec::new(), relations: Vec::new() };
    for (i, vector) in vectors.iter().enumerate() {
        let length = size(vector);
        if basis.takes(vector, NOTHING * length) {
            sorted.kept.push(i);
        } else {
            sorted.relations.push((i, shares(vectors, &sorted.kept, (i, length))));
        }
    }
    sorted
}

/// Shares of the kept vectors in vector i, relative to a length.
fn shares(vectors: &[Vec<f64>], kept: &[usize], (i, length): (usize, f64)) -> Vec<(usize, f64)> {
    if length == 0.0 || kept.is_empty() {
        return Vec::new();
    }
    let (m, n) = (vectors[i].len(), kept.len());
    let matrix: Vec<f64> = (0..m * n).map(|p| vectors[kept[p % n]][p / n]).collect();
    let (c, _) = Qr::new(&matrix, m, n).least_squares(&vectors[i]);
    kept.iter().zip(&c).map(|(&k, c)| (k, c.abs() * norm(&vectors[k]) / length)).filter(|(_, s)| *s > NOTHING).collect()
}

impl Bench<'_> {
    /// Relative shares of `others` in the row of `condition`; none when it is independent of them.
    pub(super) fn combination(&self, others: &[usize], condition: usize) -> Option<Vec<f64>> {
        let sorted = self.sorted_rows(&[others, &[condition]].concat());
        let (last, found) = sorted.relations.last()?;
        if *last != others.len() {
            return None;
        }
        let mut shares = vec![0.0; others.len()];
        found.iter().for_each(|(k, s)| shares[*k] = *s);
        Some(shares)
    }

    fn sorted_rows(&self, rows: &[usize]) -> Sorted {
        let vector = |c: usize| self.row(c).iter().zip(&self.reach).map(|(a, r)| a / (r * self.spans[c])).collect();
        let vectors: Vec<Vec<f64>> = rows.iter().map(|&c| vector(c)).collect();
        sort_beside(&vectors, |_| 1.0)
    }

    /// Selection of conditions, reactions and balances; reactions that are not unique.
    pub(super) fn select(&mut self, notes: &mut Vec<Text>) -> Result<(Selection, Undetermined), Fault> {
        let mut selection = Selection::all(self.equations);
        let mut open = vec![false; self.equations.reactions.len()];
        let x = self.x.clone();
        if self.equations.reactions.is_empty() && self.equations.conditions.is_empty() && self.equations.balances.is_empty() {
            return Ok((selection, Undetermined::default()));
        }
        self.evaluate(&x)?;
        let mut rows = self.lasting();
        rows.arrange_by_key(|c| self.equations.conditions[*c].reaction.is_some());
        let here = self.sorted_rows(&rows);
        if !here.relations.is_empty() {
            let beside = self.beside(&rows, &here)?;
            self.evaluate(&x)?;
            for (i, shares) in beside.iter().flat_map(|sorted| &sorted.relations).chain(&here.relations) {
                let own = shares.iter().map(|(k, _)| rows[*k]).chain([rows[*i]]);
                own.filter_map(|c| self.equations.conditions[c].reaction).for_each(|r| open[r] = true);
            }
            let usual = beside.first().unwrap_or(&here);
            for (i, shares) in &usual.relations {
                let names = shares.iter().map(|(k, _)| self.name(rows[*k])).chain([self.name(rows[*i])]);
                notes.push(repeated(self.name(rows[*i]), &listed(names)));
            }
            self.select_repeated(&rows, usual, &mut selection);
        }
        let places = self.places_around(&rows)?;
        self.evaluate(&x)?;
        let placed = self.select_supports(&places, &mut selection, &mut open)?;
        let shown = |r: usize| open[r] && self.equations.reactions[r].law.is_reaction();
        let open: Vec<usize> = (0..open.len()).filter(|r| shown(*r)).collect();
        self.refuse_open_pressure(&placed)?;
        self.refuse_shared_pressure(&open)?;
        for (r, load) in &placed {
            notes.push(without_place(&self.equations.reactions[*r].name, &self.equations.reactions[*load]));
        }
        let shared: Vec<usize> = open.iter().copied().filter(|r| !placed.iter().any(|(p, _)| p == r)).collect();
        if !shared.is_empty() {
            notes.push(not_unique(&shared.iter().map(|&r| &self.equations.reactions[r]).collect::<Vec<_>>()));
        }
        Ok((selection, Undetermined { open, placed }))
    }

    /// Conditions without a reaction that repeat others are no equations; of those with one, and of all that hold together with them, enough are chosen later.
    fn select_repeated(&self, rows: &[usize], usual: &Sorted, selection: &mut Selection) {
        let has_reaction = |c: &usize| self.equations.conditions[*c].reaction.is_some();
        let (members, without): (Vec<usize>, Vec<usize>) = usual.relations.iter().map(|(i, _)| rows[*i]).partition(has_reaction);
        without.iter().for_each(|c| selection.conditions[*c] = false);
        let group = self.holding_together(rows, &members);
        let (all, fixed): (Vec<usize>, Vec<usize>) = group.into_iter().filter(|c| selection.conditions[*c]).partition(has_reaction);
        selection.repeated = (!members.is_empty()).then(|| Repeated {
            count: members.len(),
            members: all.into_iter().map(|c| (c, self.spans[c])).collect(),
            fixed,
            reach: self.reach.clone(),
        });
    }

    /// Conditions that reach one another through common coordinates, from some of them.
    fn holding_together(&self, rows: &[usize], from: &[usize]) -> Vec<usize> {
        let columns = |c: usize| self.equations.conditions[c].columns.iter().map(|(j, _)| *j);
        let mut touched = vec![false; self.n];
        let mut group: Vec<usize> = from.to_vec();
        from.iter().flat_map(|c| columns(*c)).for_each(|j| touched[j] = true);
        while let Some(next) = rows.iter().find(|c| !group.contains(c) && columns(**c).any(|j| touched[j])) {
            group.push(*next);
            columns(*next).for_each(|j| touched[j] = true);
        }
        group.sort_unstable();
        group
    }

    /// The start and some places around it, in which hidden reactions are looked at.
    fn places_around(&mut self, rows: &[usize]) -> Result<Vec<Vec<f64>>, Fault> {
        let x = self.x.clone();
        let mut places = vec![x.clone()];
        if !self.equations.reactions.iter().any(|r| r.law.is_hidden()) {
            return Ok(places);
        }
        let mut random = Random::new(11);
        let placed: Vec<usize> = rows.iter().copied().filter(|c| self.equations.conditions[*c].place.is_some()).collect();
        let everything: Vec<usize> = (0..self.n).collect();
        for step in FAR.into_iter().cycle().take(AROUND) {
            self.evaluate(&x)?;
            let Some(mut near) = self.along_the_motion(&x, (rows, step), &mut random) else { continue };
            // closed but for what Newton in rows of unlike sizes leaves
            let closed = placed.is_empty() || self.approach(&mut near, &placed, &everything).is_ok_and(|gap| gap <= 1e-10);
            if closed && self.released(&near).is_ok() && self.evaluate(&near).is_ok() {
                places.push(near);
            }
        }
        Ok(places)
    }

    /// Work of each reaction in each balance, row-major: balances by reactions.
    fn released(&mut self, x: &[f64]) -> Result<Vec<f64>, Fault> {
        Ok(self.balances.evaluate(&program::Point { states: x, ..Default::default() })?.to_vec())
    }

    /// Independent balances for the supports, and supports that rigid bodies leave open.
    fn select_supports(&mut self, places: &[Vec<f64>], selection: &mut Selection, open: &mut [bool]) -> Result<Vec<(usize, usize)>, Fault> {
        let (reactions, b) = (self.equations.reactions.len(), self.equations.balances.len());
        let supports: Vec<usize> = (0..reactions).filter(|r| self.equations.reactions[*r].law.is_hidden()).collect();
        let mut placed: Vec<(usize, usize)> = Vec::new();
        let mut best: Option<(Sorted, Vec<f64>)> = None;
        // what is shared in some places only has values in the others: the motion tells
        let needed = if super::is_piecewise(self.equations) { places.len() } else { 1 };
        let (always, mut often) = (open.to_vec(), vec![0; reactions]);
        for x in places {
            let mut here = always.clone();
            let released = self.released(x)?;
            let columns: Vec<Vec<f64>> = supports.iter().map(|r| (0..b).map(|i| released[i * reactions + r]).collect()).collect();
            let sorted = sort(&columns);
            for (i, shares) in &sorted.relations {
                here[supports[*i]] = true;
                shares.iter().for_each(|(k, _)| here[supports[*k]] = true);
            }
            self.evaluate(x)?;
            placed.extend(self.spread_open(&released, &supports, &mut here));
            often.iter_mut().zip(&here).for_each(|(count, open)| *count += usize::from(*open));
            if best.as_ref().is_none_or(|(before, _)| sorted.kept.len() > before.kept.len()) {
                best = Some((sorted, released));
            }
        }
        for r in 0..reactions {
            open[r] |= often[r] >= needed || placed.iter().any(|(p, _)| *p == r);
        }
        let Some((by_columns, released)) = best else { return Ok(placed) };
        by_columns.relations.iter().for_each(|(i, _)| selection.reactions[supports[*i]] = false);
        let kept: Vec<usize> = by_columns.kept.iter().map(|&i| supports[i]).collect();
        let rows: Vec<Vec<f64>> = (0..b).map(|i| kept.iter().map(|r| released[i * reactions + r]).collect()).collect();
        let by_rows = sort(&rows);
        for i in 0..b {
            selection.balances[i] = by_rows.kept.contains(&i);
        }
        placed.sort_unstable();
        placed.dedup_by_key(|(r, _)| *r);
        Ok(placed)
    }

    /// A friction pressed by a reaction that has no value has none either, and with it the motion.
    fn refuse_open_pressure(&self, placed: &[(usize, usize)]) -> Result<(), Fault> {
        for reaction in &self.equations.reactions {
            let Law::Friction(friction) = &reaction.law else { continue };
            let terms = friction.components().flat_map(|n| &n.terms);
            for (r, _) in terms {
                if let Some((_, load)) = placed.iter().find(|(p, _)| p == r) {
                    let (pressure, load) = (&self.equations.reactions[*r].name, &self.equations.reactions[*load]);
                    return Err(match load.law {
                        Law::Transmission => Fault::pressure_without_transmission(&reaction.name, pressure, (&load.name, &load.label)),
                        Law::Tension => Fault::pressure_without_tension(&reaction.name, pressure, (&load.name, &load.label)),
                        _ => Fault::pressure_without_place(&reaction.name, pressure, &load.name),
                    });
                }
            }
        }
        Ok(())
    }

    /// A friction pressed by reactions that are not unique is not either.
    fn refuse_shared_pressure(&self, open: &[usize]) -> Result<(), Fault> {
        for reaction in &self.equations.reactions {
            let Law::Friction(friction) = &reaction.law else { continue };
            let mut pressing = friction.components().flat_map(|n| &n.terms).map(|(r, _)| *r);
            if let Some(r) = pressing.find(|r| open.contains(r)) {
                return Err(Fault::pressure_not_unique(&reaction.name, &self.equations.reactions[r].name));
            }
        }
        Ok(())
    }

    /// A support whose balance contains an open reaction is open too, unless that reaction's share is fixed by the balances.
    /// Returns the reactions that loads without a place leave open, each with such a load.
    fn spread_open(&self, released: &[f64], supports: &[usize], open: &mut [bool]) -> Vec<(usize, usize)> {
        let (reactions, b, n) = (self.equations.reactions.len(), self.equations.balances.len(), self.n);
        let ideal = |r: usize| matches!(self.equations.reactions[r].law, Law::Ideal { .. });
        let unknown: Vec<usize> = (0..reactions).filter(|r| ideal(*r)).chain(supports.iter().copied()).collect();
        let column = |r: usize| -> Vec<f64> {
            let start = self.roots.forces.start + r * n;
            let forces = self.values[start..start + n].iter().zip(&self.reach).map(|(f, reach)| f / reach);
            forces.chain((0..b).map(|i| released[i * reactions + r])).collect()
        };
        let vectors: Vec<Vec<f64>> = unknown.iter().map(|&r| column(r)).collect();
        let is_place = |r: usize| !self.equations.reactions[r].law.is_reaction();
        let mut placed = Vec::new();
        for (i, shares) in sort(&vectors).relations {
            open[unknown[i]] = true;
            shares.iter().for_each(|(k, _)| open[unknown[*k]] = true);
            let members: Vec<usize> = shares.iter().map(|(k, _)| unknown[*k]).chain([unknown[i]]).collect();
            if let Some(load) = members.iter().copied().find(|r| is_place(*r)) {
                placed.extend(members.into_iter().filter(|r| !is_place(*r)).map(|r| (r, load)));
            }
        }
        placed
    }

    /// What depends on what in neighbouring configurations.
    ///
    /// *Errors*: S018 a dependence that they do not have, that of a singular configuration.
    fn beside(&mut self, rows: &[usize], sorted: &Sorted) -> Result<Vec<Sorted>, Fault> {
        let x = self.x.clone();
        let mut random = Random::new(3);
        let mut beside = Vec::new();
        for trial in 0..TRIALS {
            self.evaluate(&x)?;
            let near = if trial == 0 { self.along_the_rates(&x) } else { self.along_the_motion(&x, (rows, NEAR), &mut random) };
            let Some(mut near) = near else { continue };
            let everything: Vec<usize> = (0..self.n).collect();
            let placed: Vec<usize> = rows.iter().copied().filter(|c| self.equations.conditions[*c].place.is_some()).collect();
            // closed but for what Newton in rows of unlike sizes leaves
            let closed = self.approach(&mut near, &placed, &everything).is_ok_and(|gap| gap <= 1e-10);
            // far enough that a rank that only holds here is seen to change
            let moved = (0..self.n).any(|j| (near[j] - x[j]).abs() > 1e-4 * if self.is_angle(j) { 1.0 } else { self.length() });
            if !closed || !moved || self.evaluate(&near).is_err() {
                continue;
            }
            let there = self.sorted_rows(rows);
            if there.kept.len() > sorted.kept.len() {
                let (i, shares) = &sorted.relations[0];
                let names = listed(shares.iter().map(|(k, _)| self.name(rows[*k])).chain([self.name(rows[*i])]));
                return Err(Fault::singular_start(&names, &self.configuration()));
            }
            if there.kept.len() == sorted.kept.len() {
                beside.push(there);
            }
        }
        Ok(beside)
    }

    /// A state a little way along the rates of the start; none at rest.
    fn along_the_rates(&self, x: &[f64]) -> Option<Vec<f64>> {
        let rates = &x[self.n..2 * self.n];
        let longest = (0..self.n).fold(0.0_f64, |l, j| l.max(rates[j].abs() / if self.is_angle(j) { 1.0 } else { self.length() }));
        let mut near = x.to_vec();
        (0..self.n).for_each(|j| near[j] += NEAR * rates[j] / longest);
        (longest > 0.0).then_some(near)
    }

    /// A state a little way along a motion that the conditions allow to first order.
    fn along_the_motion(&self, x: &[f64], (rows, step): (&[usize], f64), random: &mut Random) -> Option<Vec<f64>> {
        let (m, n) = (rows.len(), self.n);
        let way: Vec<f64> = (0..n).map(|_| random.between(-1.0, 1.0)).collect();
        let matrix: Vec<f64> = (0..n * m).map(|p| self.row(rows[p % m])[p / m] / self.reach[p / m]).collect();
        let blocked: Vec<f64> = (0..m).map(|k| (0..n).map(|j| matrix[j * m + k] * way[j]).sum()).collect();
        let back = if m == 0 { vec![0.0; n] } else { Qr::new(&matrix, n, m).shortest(&blocked) };
        let way: Vec<f64> = way.iter().zip(&back).zip(&self.reach).map(|((w, b), reach)| (w - b) / reach).collect();
        let longest = (0..n).fold(0.0_f64, |l, j| l.max(way[j].abs() / if self.is_angle(j) { 1.0 } else { self.length() }));
        // rounding of the null vectors is no direction
        if longest.is_nan() || longest <= 1e-9 {
            return None;
        }
        let mut near = x.to_vec();
        (0..n).for_each(|j| near[j] += step * way[j] / longest);
        Some(near)
    }
}

fn repeated(condition: &Text, together: &Text) -> Text {
    Text::new(
        format!("`{}` repeats other conditions; one of them is left out, chosen where the machine is: {}", condition.en, together.en),
        format!("условие `{}` повторяет другие; одно из них не используется, по положению машины: {}", condition.ru, together.ru),
    )
}

fn without_place(reaction: &str, open: &Reaction) -> Text {
    let load = &open.name;
    if matches!(open.law, Law::Transmission) {
        let (bodies, ru) = (&open.label.en, &open.label.ru);
        return Text::new(
            format!(
                "the reaction {reaction} depends on how the coordinate `{load}` moves several bodies at once ({bodies}), which no connection says"
            ),
            format!(
                "реакция {reaction} зависит от того, чем координата `{load}` приводит в движение сразу несколько тел ({ru}); такая связь не задана"
            ),
        );
    }
    if matches!(open.law, Law::Tension) {
        return Text::new(
            format!("the reaction {reaction} depends on the sum of the tensions of `{load}`, which no law gives"),
            format!("реакция {reaction} зависит от суммы натяжений ветвей `{load}`, которая ни из какого закона не следует"),
        );
    }
    Text::new(
        format!("the reaction {reaction} depends on where the load `{load}` acts, which its formula does not say"),
        format!("реакция {reaction} зависит от места приложения нагрузки `{load}`, которого её формула не задаёт"),
    )
}

/// Reactions with what they are of: names alone do not say which bodies are held twice.
fn not_unique(open: &[&Reaction]) -> Text {
    let list = |pick: fn(&Text) -> &str| {
        let told = |r: &&Reaction| {
            let label = pick(&r.label);
            if label.is_empty() || label == r.name { r.name.clone() } else { format!("{} ({label})", r.name) }
        };
        open.iter().map(told).collect::<Vec<_>>().join(", ")
    };
    Text::new(
        format!(
            "statically indeterminate: together these reactions hold more than the rigid bodies need, and their shares are open: {}; the motion and all other reactions are right; leave one of the connections out or make it elastic to know the shares",
            list(|t| &t.en)
        ),
        format!(
            "статически неопределимо: вместе эти реакции удерживают больше, чем нужно твёрдым телам, и их доли неопределимы: {}; движение и остальные реакции верны; чтобы найти доли, уберите одну из связей или сделайте её упругой",
            list(|t| &t.ru)
        ),
    )
}
