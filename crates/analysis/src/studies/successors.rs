//! Which mode at one value of a parameter is which at another.
//!
//! Shapes are compared by |xᴴ M y|² / (xᴴ M x · yᴴ M y); every mode takes the free successor that is most like it. Over a long way that decides nothing: shapes turn on
//! the way, and two frequencies that seem to pass each other may have turned away, each with the other's shape (veering). So a way is halved while
//!
//! - a mode has less than three quarters of its likeness in its successor, or
//! - the frequencies of two modes change their order,
//!
//! until it is so short that only a crossing is left. Modes of one frequency are told apart by nothing: they count together, and keep the shapes they had before.
//! Thus the numbers of modes do not depend on the values that a table shows.

use words::Text;

use crate::studies::modes::{Complex, Mode};
use crate::studies::rest::changes;
use crate::{Fault, Quantity};

/// Likeness of a shape and its successor from which on no other can be meant: the shape has turned by less than 30 degrees.
const PLAIN: f64 = 0.75;
/// Relative difference below which two frequencies are one: what the eigensolver leaves of a double root.
const ONE: f64 = 1e-9;
/// Share of the whole range within which two frequencies that change their order cross: a narrower veering is told from a crossing by no table.
const CROSSING: f64 = 1e-9;
/// Where a way is divided: the middle, or beside it where frequencies are one there.
const DIVIDED: [f64; 3] = [0.5, 0.53, 0.44];
/// Values between those of the table at which modes are computed at most.
const MOST: usize = 4000;

/// Modes, and M.
pub(super) type Found = (Vec<Mode>, Vec<f64>);

/// Modes that are followed along a parameter, where they have come to.
#[derive(Clone, Debug)]
pub(super) struct Line {
    /// The last shape of each; none has been seen while there are none.
    modes: Vec<Option<Mode>>,
    /// Where that was.
    at: f64,
    /// A way that is not divided any more.
    shortest: f64,
    /// Values between so far, and where they no longer sufficed.
    between: usize,
    unsure: Option<f64>,
}

impl Line {
    /// Before the first value of a range of this length.
    pub fn new(range: f64) -> Line {
        Line { modes: Vec::new(), at: f64::NAN, shortest: CROSSING * range.abs(), between: 0, unsure: None }
    }

    /// The last shapes.
    pub fn modes(&self) -> &[Option<Mode>] {
        &self.modes
    }

    /// Takes another order.
    pub fn reorder(&mut self, order: &[usize]) {
        self.modes = order.iter().map(|j| self.modes.get(*j).cloned().flatten()).collect();
    }

    /// Follows them to a value with these modes: each at its place, new ones behind. `known` gives those at a value between, none where there are none.
    ///
    /// *Errors*: those of `known`.
    pub fn follow(
        &mut self,
        value: f64,
        found: Found,
        known: &mut dyn FnMut(f64) -> Result<Option<Found>, Fault>,
    ) -> Result<Vec<Option<Mode>>, Fault> {
        if self.modes.is_empty() {
            self.modes = found.0.into_iter().map(Some).collect();
            self.at = value;
            return Ok(self.modes.clone());
        }
        let mut ahead = vec![(value, found)];
        let mut here = Vec::new();
        while let Some((to, (list, mass))) = ahead.last() {
            let successors = matched(&self.modes, list, mass);
            let short = (to - self.at).abs() <= self.shortest;
            if !short
                && !self.is_plain(&successors, list, mass)
                && let Some(part) = self.divide(*to, known)?
            {
                ahead.push(part);
                continue;
            }
            here = successors.iter().map(|s| s.map(|j| list[j].clone())).collect();
            self.arrive(*to, &here);
            ahead.pop();
        }
        Ok(here)
    }

    /// A value between, and the modes there; none where there are none, or where enough was looked at.
    fn divide(&mut self, to: f64, known: &mut dyn FnMut(f64) -> Result<Option<Found>, Fault>) -> Result<Option<(f64, Found)>, Fault> {
        if self.between >= MOST {
            self.unsure = self.unsure.or(Some(to));
            return Ok(None);
        }
        for share in DIVIDED {
            let value = self.at + share * (to - self.at);
            if value == self.at || value == to {
                return Ok(None);
            }
            self.between += 1;
            match known(value)? {
                Some((list, _)) if share != DIVIDED[2] && has_one(&list) => {}
                found => return Ok(found.map(|found| (value, found))),
            }
        }
        Ok(None)
    }

    /// Whether these successors are the only ones that can be meant.
    fn is_plain(&self, successors: &[Option<usize>], list: &[Mode], mass: &[f64]) -> bool {
        let pairs: Vec<(&Mode, &Mode)> =
            self.modes.iter().zip(successors).filter_map(|(old, new)| Some((old.as_ref()?, &list[(*new)?]))).collect();
        let alike = |(old, new): &(&Mode, &Mode)| {
            let into: f64 = list.iter().filter(|m| is_one(m, new)).map(|m| likeness(&old.shape, &m.shape, mass)).sum();
            let from: f64 = pairs.iter().filter(|(m, _)| is_one(m, old)).map(|(m, _)| likeness(&m.shape, &new.shape, mass)).sum();
            into.max(from) >= PLAIN
        };
        let passes = |(i, (a, c)): (usize, &(&Mode, &Mode))| {
            let apart = |a: &Mode, b: &Mode| if is_one(a, b) { 0.0 } else { (a.damped - b.damped).signum() };
            pairs[..i].iter().any(|(b, d)| apart(a, b) * apart(c, d) < 0.0)
        };
        pairs.iter().all(alike) && !pairs.iter().enumerate().any(passes)
    }

    /// What is remembered of a value: a mode that is lost for a while keeps its last shape, and so does one that another has the frequency of.
    fn arrive(&mut self, at: f64, here: &[Option<Mode>]) {
        self.at = at;
        self.modes.resize(here.len(), None);
        for (j, mode) in here.iter().enumerate() {
            let Some(mode) = mode else { continue };
            let shared = here.iter().enumerate().any(|(k, other)| k != j && other.as_ref().is_some_and(|other| is_one(other, mode)));
            if !shared || self.modes[j].is_none() {
                self.modes[j] = Some(mode.clone());
            }
        }
    }

    /// Where it is not sure which mode is which.
    pub fn note(&self, parameter: &Quantity) -> Option<Text> {
        let from = changes::written(self.unsure?, parameter);
        let name = &parameter.name;
        Some(Text::new(
            format!("from {name} = {} on it is not sure which mode is which: shapes turn too fast beside the values of the table", from.en),
            format!("начиная с {name} = {} нумерация форм не надёжна: формы поворачиваются слишком быстро для значений таблицы", from.ru),
        ))
    }
}

/// Whether two modes have one frequency.
fn is_one(a: &Mode, b: &Mode) -> bool {
    (a.damped - b.damped).abs() <= ONE * a.damped.max(b.damped)
}

/// Whether some do.
fn has_one(list: &[Mode]) -> bool {
    list.iter().enumerate().any(|(i, a)| list[..i].iter().any(|b| is_one(a, b)))
}

/// Successors in the order of their predecessors, then those without one.
fn matched(before: &[Option<Mode>], list: &[Mode], mass: &[f64]) -> Vec<Option<usize>> {
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    for (i, old) in before.iter().enumerate() {
        let Some(old) = old else { continue };
        for (j, new) in list.iter().enumerate() {
            // shapes that are equally alike are told apart by frequency
            let distance = (old.damped - new.damped).abs() / (old.damped + new.damped).max(f64::MIN_POSITIVE);
            pairs.push((likeness(&old.shape, &new.shape, mass) - distance, i, j));
        }
    }
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
    let mut slots: Vec<Option<usize>> = vec![None; before.len()];
    let mut taken = vec![false; list.len()];
    for (_, i, j) in pairs {
        if slots[i].is_none() && !taken[j] {
            slots[i] = Some(j);
            taken[j] = true;
        }
    }
    // modes that begin to oscillate get a track of their own
    slots.extend((0..list.len()).filter(|&j| !taken[j]).map(Some));
    slots
}

/// |xᴴ M y|² / (xᴴ M x · yᴴ M y).
fn likeness(x: &[Complex], y: &[Complex], mass: &[f64]) -> f64 {
    let n = x.len();
    let product = |a: &[Complex], b: &[Complex]| -> (f64, f64) {
        let term = |p: usize| {
            let (u, v) = (a[p / n], b[p % n]);
            (mass[p] * (u.0 * v.0 + u.1 * v.1), mass[p] * (u.0 * v.1 - u.1 * v.0))
        };
        (0..n * n).map(term).fold((0.0, 0.0), |s, t| (s.0 + t.0, s.1 + t.1))
    };
    let (xy, xx, yy) = (product(x, y), product(x, x).0, product(y, y).0);
    if xx * yy > 0.0 { (xy.0 * xy.0 + xy.1 * xy.1) / (xx * yy) } else { 0.0 }
}
