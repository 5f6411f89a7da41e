//! Closing loops: coordinates, then rates, that meet all lasting conditions, given ones kept.
//!
//! Positions: Gauss-Newton steps of least change from the guess, limited to half a radian (half the size of the machine); where such a step does
//! not bring the loops closer, a damped one (Levenberg, Marquardt):
//!
//! ```text
//! minimise |J d + g|² + μ |d|²        g, J: places and their derivatives in units of their own size;  d: changes times the reach of each coordinate
//! ```
//!
//! From a guess at which all levers lie in line no step leads away; then guesses around it are tried in a fixed order, and of the closed
//! configurations the one nearest to the user's guess is taken. Rates: one linear problem of least change.

use words::Text;

use super::bench::{Bench, listed};
use super::level::Level;
use symbolic::connections::Law;

use crate::Fault;
use algebra::qr::Qr;
use algebra::random::Random;
use algebra::vectors::norm;
use words::digits::number;

/// Largest relative violation of a closed loop.
pub(super) const CLOSED: f64 = 1e-12;
const STEPS: usize = 200;
/// Longest step, rad, or share of the size.
const LONGEST: f64 = 0.5;
/// Share of a rate by typical levers with which a condition without levers is compared.
const STILL: f64 = 1e-3;
/// Guesses around the user's.
const AROUND: usize = 40;
/// A given value that closes when it changes by this share is the printed form of one that does.
const PRINTED: f64 = 1e-9;

impl Bench<'_> {
    pub(super) fn close_places(&mut self, notes: &mut Vec<Text>) -> Result<(), Fault> {
        self.close_rows(&vec![true; self.equations.conditions.len()], notes)
    }

    /// The same for some of the conditions.
    pub(super) fn close_rows(&mut self, wanted: &[bool], notes: &mut Vec<Text>) -> Result<(), Fault> {
        let rows: Vec<usize> = self.lasting().into_iter().filter(|c| wanted[*c] && self.equations.conditions[*c].place.is_some()).collect();
        let given: Vec<bool> = self.equations.coordinates.iter().map(|c| c.given[0]).collect();
        let guess = self.x.clone();
        if let Some(x) = self.closed_by_fewest(&guess, &rows, Level::Place)? {
            self.x = x;
            return Ok(());
        }
        // which given values would close it, each alone, the last first
        let mut cures = Vec::new();
        for j in (0..self.n).rev().filter(|j| given[*j]) {
            let free: Vec<usize> = (0..self.n).filter(|k| !given[*k] || *k == j).collect();
            if let Some(x) = self.closed_from(&guess, &rows, &free)? {
                let size = if self.is_angle(j) { 1.0 } else { 0.0 };
                if (x[j] - guess[j]).abs() <= PRINTED * guess[j].abs().max(size) {
                    notes.push(self.taken_as(self.coordinate(j), guess[j], x[j], &self.equations.coordinates[j].unit));
                    self.x = x;
                    return Ok(());
                }
                cures.push((self.coordinate(j).to_owned(), x[j], self.equations.coordinates[j].unit.clone()));
            }
        }
        if !cures.is_empty() {
            return Err(self.inconsistent(&rows, &guess, &cures)?);
        }
        let everything: Vec<usize> = (0..self.n).collect();
        match self.closed_from(&guess, &rows, &everything)? {
            Some(x) => {
                let moved = (0..self.n).filter(|j| given[*j] && x[*j] != guess[*j]);
                let cures: Vec<_> =
                    moved.map(|j| (self.coordinate(j).to_owned(), x[j], self.equations.coordinates[j].unit.clone())).collect();
                Err(self.inconsistent_together(&rows, &guess, &cures)?)
            }
            None => Err(self.cannot_close(&rows, &guess, &everything)?),
        }
    }

    /// The closed configuration to which the way of least change leads.
    pub(super) fn closed_at_once(&mut self, guess: &[f64], rows: &[usize], free: &[usize]) -> Result<Option<Vec<f64>>, Fault> {
        let mut x = guess.to_vec();
        Ok((self.approach(&mut x, rows, free)? <= CLOSED).then_some(x))
    }

    /// The closed configuration nearest to `guess` with only the `free` coordinates moved; none when there is none around.
    pub(super) fn closed_from(&mut self, guess: &[f64], rows: &[usize], free: &[usize]) -> Result<Option<Vec<f64>>, Fault> {
        if let Some(x) = self.closed_at_once(guess, rows, free)? {
            return Ok(Some(x));
        }
        let mut random = Random::new(11);
        let mut nearest: Option<(f64, Vec<f64>)> = None;
        for trial in 0..AROUND {
            let radius = 3.0 * (trial + 1) as f64 / AROUND as f64;
            let mut x = guess.to_vec();
            let size = free.iter().filter(|j| !self.is_angle(**j)).fold(0.0_f64, |m, j| m.max(guess[*j].abs()));
            for &j in free {
                let unit = random.between(-1.0, 1.0);
                x[j] += radius * unit * if self.is_angle(j) { 1.0 } else { size.max(self.length()) };
            }
            if self.approach(&mut x, rows, free).is_ok_and(|gap| gap <= CLOSED) {
                let way: Vec<f64> = free.iter().map(|&j| self.reach[j] * (x[j] - guess[j])).collect();
                let way = norm(&way);
                if nearest.as_ref().is_none_or(|(best, _)| way < 0.999 * best) {
                    nearest = Some((way, x));
                }
            }
        }
        Ok(nearest.map(|(_, x)| x))
    }

    /// A length of the machine: the longest lever.
    pub(super) fn length(&self) -> f64 {
        let lever = (0..self.n).filter(|j| self.is_angle(*j)).fold(0.0_f64, |m, j| m.max(self.reach[j]));
        if lever > 0.0 { lever } else { 1.0 }
    }

    /// Moves x until the rows are closed or nothing helps; returns the largest relative violation.
    pub(super) fn approach(&mut self, x: &mut [f64], rows: &[usize], free: &[usize]) -> Result<f64, Fault> {
        self.evaluate(x)?;
        let mut damping = 0.0;
        for _ in 0..STEPS {
            let gap = self.gap(x, rows);
            if gap <= 4.0 * f64::EPSILON {
                break;
            }
            let before = norm(&self.residual(x, rows));
            let step = self.step(x, rows, free, damping);
            let mut next = x.to_vec();
            free.iter().zip(&step).for_each(|(&j, d)| next[j] += d);
            let better = self.evaluate(&next).is_ok() && norm(&self.residual(&next, rows)) < before;
            if better {
                let gained = norm(&self.residual(&next, rows)) < 0.999 * before;
                x.copy_from_slice(&next);
                // damping below the digits that rows have changes nothing
                damping = if damping > 1e-9 { 0.1 * damping } else { 0.0 };
                if !gained && gap <= CLOSED {
                    break;
                }
            } else {
                self.evaluate(x)?;
                if gap <= 16.0 * f64::EPSILON || damping > 1e8 {
                    break;
                }
                // first so little that a regular step stays as it is, then ten times more
                damping = if damping == 0.0 { 1e-6 } else { 10.0 * damping };
            }
        }
        Ok(self.gap(x, rows))
    }

    fn residual(&self, x: &[f64], rows: &[usize]) -> Vec<f64> {
        rows.iter().map(|&c| self.place(c) / self.place_size(c, x)).collect()
    }

    fn gap(&self, x: &[f64], rows: &[usize]) -> f64 {
        self.residual(x, rows).iter().fold(0.0_f64, |m, r| if r.is_nan() { f64::INFINITY } else { m.max(r.abs()) })
    }

    /// Change of the free coordinates.
    fn step(&self, x: &[f64], rows: &[usize], free: &[usize], damping: f64) -> Vec<f64> {
        let (m, n) = (rows.len(), free.len());
        let residual = self.residual(x, rows);
        let entry = |k: usize, j: usize| self.row(rows[k])[free[j]] / (self.place_size(rows[k], x) * self.reach[free[j]]);
        let scaled = if damping == 0.0 {
            let matrix: Vec<f64> = (0..n * m).map(|p| entry(p % m, p / m)).collect();
            let wanted: Vec<f64> = residual.iter().map(|r| -r).collect();
            let factors = if self.has_dead(rows) { Qr::measured(&matrix, n, m, m) } else { Qr::new(&matrix, n, m) };
            factors.shortest(&wanted)
        } else {
            let largest = (0..m * n).fold(0.0_f64, |l, p| l.max(entry(p / n, p % n).abs()));
            let weight = damping.sqrt() * largest;
            let mut matrix: Vec<f64> = (0..m * n).map(|p| entry(p / n, p % n)).collect();
            matrix.extend((0..n * n).map(|p| if p / n == p % n { weight } else { 0.0 }));
            let wanted: Vec<f64> = residual.iter().map(|r| -r).chain(vec![0.0; n]).collect();
            Qr::new(&matrix, m + n, n).least_squares(&wanted).0
        };
        let mut step: Vec<f64> = scaled.iter().zip(free).map(|(d, &j)| d / self.reach[j]).collect();
        let longest = step.iter().zip(free).fold(0.0_f64, |l, (d, &j)| {
            let size = if self.is_angle(j) { 1.0 } else { self.length().max(x[j].abs()) };
            l.max(d.abs() / size)
        });
        if longest > LONGEST {
            step.iter_mut().for_each(|d| *d *= LONGEST / longest);
        }
        step
    }

    pub(super) fn close_rates(&mut self, notes: &mut Vec<Text>) -> Result<(), Fault> {
        let rows = self.lasting();
        let given: Vec<bool> = self.equations.coordinates.iter().map(|c| c.given[1]).collect();
        let guess = self.x.clone();
        if let Some(x) = self.closed_by_fewest(&guess, &rows, Level::Rate)? {
            self.x = x;
            return self.follow_contacts(rows, &guess, notes);
        }
        let mut cures = Vec::new();
        for j in (0..self.n).rev().filter(|j| given[*j]) {
            let free: Vec<usize> = (0..self.n).filter(|k| !given[*k] || *k == j).collect();
            if let Some(x) = self.rates_from(&guess, &rows, &free)? {
                let (old, new) = (guess[self.n + j], x[self.n + j]);
                let name = format!("{}'", self.coordinate(j));
                let unit = format!("{}/s", self.equations.coordinates[j].unit);
                if (new - old).abs() <= PRINTED * old.abs() {
                    notes.push(self.taken_as(&name, old, new, &unit));
                    self.x = x;
                    return Ok(());
                }
                cures.push((name, new, unit));
            }
        }
        self.evaluate(&guess)?;
        let worst = self.worst_of(&rows, |bench, c| bench.rate(c).abs() / bench.rate_size(c, &guess));
        if !cures.is_empty() {
            return Err(Fault::inconsistent_start(self.name(worst), &cures, &[]));
        }
        let everything: Vec<usize> = (0..self.n).collect();
        if let Some(x) = self.rates_from(&guess, &rows, &everything)? {
            let moved = (0..self.n).filter(|j| given[*j] && x[self.n + *j] != guess[self.n + *j]);
            let cures: Vec<_> = moved
                .map(|j| (format!("{}'", self.coordinate(j)), x[self.n + j], format!("{}/s", self.equations.coordinates[j].unit)))
                .collect();
            return Err(Fault::inconsistent_start(self.name(worst), &[], &cures));
        }
        Err(Fault::contradiction(&self.involved(&rows, worst), &self.configuration()))
    }

    /// Rates that nobody gives follow ropes that are taut and would be torn otherwise (a load on a taut rope starts with its drum), and tracks on which
    /// wheels roll. A rope that slackens lets them stay 0, and so does a stop: it opens, or strikes.
    fn follow_contacts(&mut self, mut rows: Vec<usize>, guess: &[f64], notes: &mut Vec<Text>) -> Result<(), Fault> {
        self.evaluate(&self.x.clone())?;
        let closed = |c: &usize| self.place(*c).abs() <= CLOSED * self.place_size(*c, &self.x);
        let [tracks, ties] = [self.tracks(), self.ties()].map(|list| list.into_iter().filter(closed).collect::<Vec<usize>>());
        for track in tracks {
            self.hold(track, &mut rows, guess)?;
        }
        // one that is held may tighten another
        let mut tried = Vec::new();
        for _ in 0..ties.len() {
            self.evaluate(&self.x.clone())?;
            let torn = |c: &usize| !tried.contains(c) && self.rate(*c) < -CLOSED * self.rate_size(*c, &self.x);
            let Some(tie) = ties.iter().copied().find(torn) else { break };
            tried.push(tie);
            self.hold(tie, &mut rows, guess)?;
        }
        self.evaluate(&self.x.clone())?;
        let left = |j: &usize| !self.equations.coordinates[*j].given[1];
        let slack =
            |c: &&usize| self.rate(**c) > CLOSED * self.rate_size(**c, &self.x) && (0..self.n).any(|j| left(&j) && self.row(**c)[j] != 0.0);
        notes.extend(ties.iter().filter(slack).map(|c| slackens(self.name(*c))));
        self.roll_on(rows, guess)
    }

    /// Lets the rates that nobody gives meet one more row, where they can.
    fn hold(&mut self, row: usize, rows: &mut Vec<usize>, guess: &[f64]) -> Result<(), Fault> {
        rows.push(row);
        match self.closed_by_fewest(guess, rows, Level::Rate)? {
            Some(x) => self.x = x,
            None => drop(rows.pop()),
        }
        Ok(())
    }

    /// Conditions of ropes.
    fn ties(&self) -> Vec<usize> {
        let tie = |law: &Law| match law {
            Law::Contact { condition, tie: true, .. } => Some(*condition),
            _ => None,
        };
        self.equations.reactions.iter().filter_map(|r| tie(&r.law)).collect()
    }

    /// Conditions of contacts on which wheels roll.
    fn tracks(&self) -> Vec<usize> {
        let track = |law: &Law| match law {
            Law::Rough { contact, .. } => self.equations.reactions[*contact].law.condition(),
            _ => None,
        };
        self.equations.reactions.iter().filter_map(|r| track(&r.law)).collect()
    }

    /// A wheel that rolls while it touches its track does so from the start, unless the given rates lift it.
    fn roll_on(&mut self, mut rows: Vec<usize>, guess: &[f64]) -> Result<(), Fault> {
        let rough = |r: &symbolic::connections::Reaction| match r.law {
            Law::Rough { condition, contact } => Some((condition, self.equations.reactions[contact].law.condition()?)),
            _ => None,
        };
        let pairs: Vec<(usize, usize)> = self.equations.reactions.iter().filter_map(rough).collect();
        for (slip, gap) in pairs {
            self.evaluate(&self.x.clone())?;
            let touches = self.place(gap).abs() <= CLOSED * self.place_size(gap, &self.x);
            if !touches || self.rate(gap).abs() > CLOSED * self.rate_size(gap, &self.x) {
                continue;
            }
            rows.push(slip);
            match self.closed_by_fewest(guess, &rows, Level::Rate)? {
                Some(x) => self.x = x,
                None => return Err(Fault::inconsistent_start(self.name(slip), &[], &[])),
            }
        }
        Ok(())
    }

    /// Rates of least change that meet the rows; none when there are none.
    pub(super) fn rates_from(&mut self, guess: &[f64], rows: &[usize], free: &[usize]) -> Result<Option<Vec<f64>>, Fault> {
        let (m, n) = (rows.len(), free.len());
        let mut x = guess.to_vec();
        for _ in 0..3 {
            self.evaluate(&x)?;
            let dead = self.has_dead(rows);
            let unit = |c: usize| if dead { self.spans[c] } else { 1.0 };
            let entry = |c: usize, j: usize| self.row(c)[j] / (self.reach[j] * unit(c));
            let matrix: Vec<f64> = (0..n * m).map(|p| entry(rows[p % m], free[p / m])).collect();
            let wanted: Vec<f64> = rows.iter().map(|&c| -self.rate(c) / unit(c)).collect();
            if wanted.iter().all(|w| *w == 0.0) {
                break;
            }
            let factors = if dead { Qr::measured(&matrix, n, m, m) } else { Qr::new(&matrix, n, m) };
            let change = factors.shortest(&wanted);
            for (&j, d) in free.iter().zip(&change) {
                let (old, change) = (x[self.n + j], d / self.reach[j]);
                // what cancels to rounding is zero
                x[self.n + j] = if (old + change).abs() <= 8.0 * f64::EPSILON * old.abs() { 0.0 } else { old + change };
            }
        }
        self.evaluate(&x)?;
        // solved to thirteen digits in rows of unlike sizes
        let closed = rows.iter().all(|&c| self.rate(c).abs() <= 1e-11 * self.rate_size(c, &x).max(self.rate_scale(c, guess)));
        Ok(closed.then_some(x))
    }

    /// Size of the rates that were given: rates that have cancelled are compared with these.
    fn rate_scale(&self, condition: usize, guess: &[f64]) -> f64 {
        let own: f64 = self.row(condition).iter().zip(&guess[self.n..2 * self.n]).map(|(a, v)| a.abs() * v.abs()).sum();
        STILL * own.max(self.typical_rate(condition, guess))
    }

    fn worst_of(&self, rows: &[usize], size: impl Fn(&Self, usize) -> f64) -> usize {
        rows.iter().copied().max_by(|&a, &b| size(self, a).total_cmp(&size(self, b))).unwrap_or(0)
    }

    fn inconsistent(&mut self, rows: &[usize], guess: &[f64], cures: &[(String, f64, String)]) -> Result<Fault, Fault> {
        let worst = self.most_open(rows, guess)?;
        Ok(Fault::inconsistent_start(self.name(worst), cures, &[]))
    }

    fn inconsistent_together(&mut self, rows: &[usize], guess: &[f64], cures: &[(String, f64, String)]) -> Result<Fault, Fault> {
        let worst = self.most_open(rows, guess)?;
        Ok(Fault::inconsistent_start(self.name(worst), &[], cures))
    }

    fn most_open(&mut self, rows: &[usize], x: &[f64]) -> Result<usize, Fault> {
        self.evaluate(x)?;
        Ok(self.worst_of(rows, |bench, c| bench.place(c).abs() / bench.place_size(c, x)))
    }

    /// No configuration closes: either two conditions contradict each other, or the lengths do not reach.
    fn cannot_close(&mut self, rows: &[usize], guess: &[f64], free: &[usize]) -> Result<Fault, Fault> {
        let mut best = guess.to_vec();
        let mut gap = self.approach(&mut best, rows, free)?;
        let mut random = Random::new(11);
        for _ in 0..AROUND {
            let mut x = guess.to_vec();
            for &j in free {
                x[j] += 3.0 * random.between(-1.0, 1.0) * if self.is_angle(j) { 1.0 } else { self.length() };
            }
            if let Ok(now) = self.approach(&mut x, rows, free)
                && now < 0.999 * gap
            {
                (gap, best) = (now, x);
            }
        }
        let worst = self.most_open(rows, &best)?;
        let left = self.place(worst).abs();
        self.x = best;
        let together = self.involved(rows, worst);
        let contradiction = self.is_linear_contradiction(rows, worst);
        Ok(if contradiction {
            Fault::contradiction(&together, &self.configuration())
        } else {
            Fault::cannot_close(self.name(worst), left, &self.configuration())
        })
    }

    /// Conditions whose rows combine to that of `condition` at the present state, with it.
    fn involved(&self, rows: &[usize], condition: usize) -> Text {
        let others: Vec<usize> = rows.iter().copied().filter(|c| *c != condition).collect();
        let shares = self.combination(&others, condition).unwrap_or_default();
        // a condition whose share is smaller takes no part that is worth naming
        let names = others.iter().zip(&shares).filter(|(_, s)| **s > 1e-6).map(|(c, _)| self.name(*c));
        listed(names.chain([self.name(condition)]))
    }

    /// Whether the row repeats others away from the present state as well: lengths that do not reach give dependence at the stretched position only.
    fn is_linear_contradiction(&mut self, rows: &[usize], condition: usize) -> bool {
        let others: Vec<usize> = rows.iter().copied().filter(|c| *c != condition).collect();
        let mut random = Random::new(5);
        (0..3).all(|_| {
            let mut x = self.x.clone();
            (0..self.n).for_each(|j| x[j] += 0.1 * random.between(-1.0, 1.0) * if self.is_angle(j) { 1.0 } else { self.length() });
            self.evaluate(&x).is_ok() && self.combination(&others, condition).is_some()
        })
    }

    fn taken_as(&self, name: &str, given: f64, taken: f64, unit: &str) -> Text {
        let (given, taken, unit) = (number(given), number(taken), Text::unit(unit));
        Text::new(
            format!("{name} = {} {} is taken as {}, which closes the connections", given.en, unit.en, taken.en),
            format!("{name} = {} {} принято равным {}, при котором связи замыкаются", given.ru, unit.ru, taken.ru),
        )
    }
}

fn slackens(rope: &Text) -> Text {
    Text::new(
        format!("{} slackens at the start: rates that are not given are 0", rope.en),
        format!("{}: в начале движения провисает, так как незаданные скорости равны 0", rope.ru),
    )
}
