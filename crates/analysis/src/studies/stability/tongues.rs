//! Boundaries of the tongues of a diagram: the characteristic curves of Mathieu's and of Hill's equation, and those that damping lifts.
//!
//! ```text
//! tr M = 0                 between two tongues: n counts zeros, 2n - 1 in two periods below tongue n and 2n + 1 above it (Sturm)
//! det(M - σ) = 0           σ = (-1)^n: a solution of period T (σ = 1) or 2T (σ = -1)
//! σM - 1 = JS + trace/2    det S = 0 there, S symmetric: both of its eigenvalues change their signs, each at one boundary of tongue n
//! σ tr M = 2 ch hT         with damping: the multiplier of q is σ
//! ```
//!
//! A row is a line of the plane along which ψ T² grows, or falls, at every instant of the period: there each tongue is met once. No width is too small: at the places where tr M = 0, between which a
//! tongue lies, S is definite with opposite signs, and its eigenvalues are smooth functions with simple zeros also where a tongue is closed. *Source*: W. Magnus, S. Winkler, Hill's Equation,
//! 1966, ch. II; V. A. Yakubovich, V. M. Starzhinskii, 1975, ch. III.

use super::diagram::{Damped, Diagram, Equations};
use crate::marks::bracketed;
use algebra::elementary;
use algebra::golden::Section;
use algebra::mathieu::Parity;
use std::convert::Infallible;

/// Places of a row for each tongue in it at first, and how often four times as many are taken where counts of zeros do not follow one another.
const PER_TONGUE: usize = 24;
const FINER: usize = 3;
/// Places at which the sense of ψ T² along a row is looked at: along it, across it, and instants of a period.
const LOOKED: [usize; 3] = [9, 5, 48];
/// Share of the largest |ψ| T² below which a difference is rounding.
const ROUNDING: f64 = 1e-11;
/// Parts of (√5 - 1)/2 of an interval in which the top of a damped tongue lies: its place is known to the root of the rounding of its height.
const TOP: usize = 48;
/// Share of the largest entry of S up to which what should vanish for an even ψ is rounding of the steps of a period and of the place.
const VANISHES: f64 = 1e-9;
/// Largest entry of S up to which a tongue counts as closed: what vanishes and what does not are told apart above a hundred times the former.
const CLOSED: f64 = 1e-7;

/// Which end of a tongue along its row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// Where it begins.
    Lower,
    /// Where it ends.
    Upper,
}

/// A boundary of a tongue.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// n.
    pub tongue: usize,
    /// Along its rows; none with a letter, which goes from one end to the other where its tongue is closed.
    pub edge: Option<Edge>,
    /// Without damping and with an even ψ: whether its solution is even (a_n) or odd (b_n).
    pub letter: Option<Parity>,
    /// (x, y) in the order of the rows.
    pub points: Vec<[f64; 2]>,
    /// Whether it ends where the tongue closes, at its first and its last point: the least and the greatest place that the tongue reaches.
    pub tips: [bool; 2],
}

impl Curve {
    /// a_2, b_2, or the number of the tongue and which end of it.
    pub fn name(&self) -> String {
        let n = self.tongue;
        match (self.letter, self.edge) {
            (Some(Parity::Even), _) => format!("a_{n}"),
            (Some(Parity::Odd), _) => format!("b_{n}"),
            (None, Some(Edge::Upper)) => format!("{n} upper"),
            (None, _) => format!("{n} lower"),
        }
    }
    /// The multiplier on it, 1 or -1.
    pub fn multiplier(&self) -> f64 {
        sign(self.tongue)
    }
}

/// Along which parameter rows go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Along {
    /// The first.
    X,
    /// The second.
    Y,
}

/// The boundaries of all tongues over a rectangle from so many rows, and the parameter along which these go: the first along which ψ T² grows or falls throughout; none where there is no such
/// parameter, or damping is negative.
pub fn curves<E: Equations>(diagram: &Diagram<E>, ends: [[f64; 2]; 2], rows: usize) -> Option<(Along, Vec<Curve>)> {
    let along = [Along::X, Along::Y].into_iter().find(|along| is_definite(&diagram.equations, *along, ends))?;
    let plane = Plane { diagram, along, range: if along == Along::X { ends[0] } else { ends[1] } };
    let [low, high] = if along == Along::X { ends[1] } else { ends[0] };
    let places: Vec<f64> =
        (0..rows).map(|k| if k + 1 == rows { high } else { low + (high - low) * k as f64 / (rows - 1) as f64 }).collect();
    let found: Vec<Vec<Tongue>> = places.iter().map(|other| plane.row(*other, None)).collect::<Option<_>>()?;
    Some((along, joined(&plane, &places, &found)))
}

/// (-1)^n.
fn sign(tongue: usize) -> f64 {
    if tongue.is_multiple_of(2) { 1.0 } else { -1.0 }
}

/// Whether ψ T² grows along rows at every instant, or falls: at places of the rectangle.
fn is_definite<E: Equations>(equations: &E, along: Along, ends: [[f64; 2]; 2]) -> bool {
    let [many, few, instants] = LOOKED;
    let place = |[low, high]: [f64; 2], k: usize, count: usize| low + (high - low) * k as f64 / (count - 1) as f64;
    let psi = |i: usize, j: usize| -> Vec<f64> {
        let at = |i, j| {
            if along == Along::X {
                equations.at(place(ends[0], i, many), place(ends[1], j, few))
            } else {
                equations.at(place(ends[0], j, few), place(ends[1], i, many))
            }
        };
        let hill = at(i, j).hill;
        (0..instants).map(|k| hill.period * hill.period * hill.value(hill.period * k as f64 / instants as f64)).collect()
    };
    let (mut grows, mut falls) = (false, false);
    for j in 0..few {
        let mut before = psi(0, j);
        for i in 1..many {
            let now = psi(i, j);
            let rounding = ROUNDING * now.iter().chain(&before).fold(1.0_f64, |l, v| l.max(v.abs()));
            for (a, b) in before.iter().zip(&now) {
                grows |= b - a > rounding;
                falls |= a - b > rounding;
            }
            before = now;
        }
    }
    grows != falls
}

/// What a row has of a tongue.
#[derive(Clone, Debug)]
struct Tongue {
    n: usize,
    /// Its ends within the row.
    edges: [Option<f64>; 2],
    /// The solution of the lower end.
    solution: Solution,
    /// Its ends without damping, or those of the range; and whether the range holds both.
    within: ([f64; 2], bool),
}

/// What a solution of period T or 2T is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Solution {
    /// Even or odd.
    Of(Parity),
    /// Neither: ψ is not even.
    Neither,
    /// The tongue is closed, or is not told to be open: solutions of both sorts are.
    Any,
}

struct Plane<'a, E> {
    diagram: &'a Diagram<E>,
    along: Along,
    range: [f64; 2],
}

impl<E: Equations> Plane<'_, E> {
    fn place(&self, s: f64, other: f64) -> [f64; 2] {
        if self.along == Along::X { [s, other] } else { [other, s] }
    }
    fn exact(&self, s: f64, other: f64) -> Damped {
        let [x, y] = self.place(s, other);
        self.diagram.equations.at(x, y)
    }
    fn trace(&self, s: f64, other: f64) -> [f64; 2] {
        let [x, y] = self.place(s, other);
        self.diagram.trace(x, y)
    }

    /// Places where tr M = 0 with their counts of zeros in two periods, and +1 or -1: whether counts grow along the row. None where they do not follow one another.
    fn zeros(&self, other: f64) -> Option<(Vec<(f64, usize)>, f64)> {
        let [low, high] = self.range;
        let count = |s: f64| self.exact(s, other).hill.zeros(2);
        let ends = [count(low), count(high)];
        let mut places = PER_TONGUE * (ends[0].abs_diff(ends[1]) / 2 + 2);
        for _ in 0..FINER {
            let value = |k: usize| low + (high - low) * k as f64 / places as f64;
            let mut samples = (0..=places).map(|k| (value(k), self.trace(value(k), other)[0]));
            let mut before = samples.next()?;
            let mut found = Vec::new();
            for now in samples {
                if (before.1 > 0.0) != (now.1 > 0.0) {
                    let s = bracketed(&mut |s| self.trace(s, other)[0], before, now);
                    found.push((s, count(s)));
                }
                before = now;
            }
            let counts: Vec<f64> = found.iter().map(|(_, c)| *c as f64).collect();
            let sense = match counts.as_slice() {
                [first, .., last] => (last - first).signum(),
                _ if ends[0] > ends[1] => -1.0,
                _ => 1.0,
            };
            let odd = found.iter().all(|(_, c)| c % 2 == 1);
            if odd && counts.windows(2).all(|c| c[1] - c[0] == 2.0 * sense) {
                return Some((found, sense));
            }
            places *= 4;
        }
        None
    }

    /// The tongues of a row, or the one that is wanted.
    fn row(&self, other: f64, wanted: Option<usize>) -> Option<Vec<Tongue>> {
        let (zeros, sense) = self.zeros(other)?;
        let [low, high] = self.range;
        let bounds: Vec<f64> = [low].into_iter().chain(zeros.iter().map(|z| z.0)).chain([high]).collect();
        let mut found = Vec::new();
        for (i, pair) in bounds.windows(2).enumerate() {
            // 2n is the count in its middle
            let twice = match (i.checked_sub(1).and_then(|i| zeros.get(i)), zeros.get(i)) {
                (Some((_, below)), Some((_, above))) => 0.5 * (*below as f64 + *above as f64),
                (None, Some((_, above))) => *above as f64 - sense,
                (Some((_, below)), None) => *below as f64 + sense,
                (None, None) => self.lone(other),
            };
            let n = (0.5 * twice).round().max(0.0) as usize;
            if wanted.is_some_and(|wanted| wanted != n) {
                continue;
            }
            // at the ends of the range zeros of tr M may have been missed: solutions there have no other count
            for s in [low, high].into_iter().filter(|s| pair.contains(s)) {
                if self.exact(s, other).hill.zeros(2).abs_diff(2 * n) > 1 {
                    return None;
                }
            }
            found.extend(self.tongue((n, other), [pair[0], pair[1]])?);
        }
        Some(found)
    }

    /// Twice the number of the only tongue of a row: of two counts that differ by one the one whose parity has the sign of the trace.
    fn lone(&self, other: f64) -> f64 {
        let middle = 0.5 * (self.range[0] + self.range[1]);
        let count = self.exact(middle, other).hill.zeros(2);
        let even = self.trace(middle, other)[0] > 0.0;
        let n = if (count / 2).is_multiple_of(2) == even { count / 2 } else { count.div_ceil(2) };
        2.0 * n as f64
    }

    /// Tongue n between two places; none where the row has no part of it.
    fn tongue(&self, (n, other): (usize, f64), [from, to]: [f64; 2]) -> Option<Option<Tongue>> {
        let eigenvalues = |s: f64| Form::of(&self.exact(s, other), n).eigenvalues();
        let (first, last) = (eigenvalues(from), eigenvalues(to));
        let mut roots: Vec<f64> = Vec::new();
        for k in 0..2 {
            if (first[k] > 0.0) != (last[k] > 0.0) {
                roots.push(bracketed(&mut |s| eigenvalues(s)[k], (from, first[k]), (to, last[k])));
            }
        }
        roots.sort_by(f64::total_cmp);
        let inside = (first[0] > 0.0) != (first[1] > 0.0);
        let edges = match roots.as_slice() {
            [] if !inside => return Some(None),
            [] => [None, None],
            [only] if inside => [None, Some(*only)],
            [only] => [Some(*only), None],
            [lower, upper, ..] => [Some(*lower), Some(*upper)],
        };
        let within = [edges[0].unwrap_or(from), edges[1].unwrap_or(to)];
        let dampings = within.map(|s| self.exact(s, other).damping);
        if dampings.iter().any(|d| *d < 0.0) {
            return None;
        }
        let within = (within, edges.iter().all(Option::is_some));
        Some(Some(if dampings == [0.0, 0.0] {
            Tongue { n, edges, solution: self.solution((n, other), edges), within }
        } else {
            Tongue { n, edges: self.lifted((n, other), within.0, edges), solution: Solution::Neither, within }
        }))
    }

    /// σ tr M - 2 ch hT by polynomials.
    fn excess(&self, (n, other): (usize, f64), s: f64) -> f64 {
        let [trace, damping] = self.trace(s, other);
        sign(n) * trace - 2.0 * elementary::cosh(damping)
    }

    /// The same of the equation itself.
    fn exact_excess(&self, (n, other): (usize, f64), s: f64) -> f64 {
        let [trace, damping] = self.exact(s, other).trace();
        sign(n) * trace - 2.0 * elementary::cosh(damping)
    }

    /// Ends of a tongue with damping, within those that it has without.
    fn lifted(&self, at: (usize, f64), [from, to]: [f64; 2], open: [Option<f64>; 2]) -> [Option<f64>; 2] {
        let ends = [from, to].map(|s| (s, self.exact_excess(at, s)));
        let top = ends.into_iter().chain([self.top(at, [from, to])]).max_by(|a, b| a.1.total_cmp(&b.1));
        let Some(top) = top.filter(|top| top.1 > 0.0) else { return [None, None] };
        let root = |end: (f64, f64), there: bool| {
            let (a, b) = if end.0 < top.0 { (end, top) } else { (top, end) };
            (there && end.1 < 0.0).then(|| bracketed(&mut |s| self.exact_excess(at, s), a, b))
        };
        // where the range cuts a tongue it has no end
        let cut = |k: usize| open[k].is_some() || ends[k].1 < 0.0;
        [root(ends[0], cut(0)), root(ends[1], cut(1))]
    }

    /// The place of the largest excess, and the excess of the equation itself there.
    fn top(&self, at: (usize, f64), ends: [f64; 2]) -> (f64, f64) {
        let value = |s: f64| Ok::<f64, Infallible>(self.excess(at, s));
        let Ok(mut section) = Section::new(ends, value);
        for _ in 0..TOP {
            let Ok(next) = section.narrowed(|a, b| a > b, value);
            section = next;
        }
        let (best, _) = section.best(|a, b| a > b);
        (best, self.exact_excess(at, best))
    }

    /// That of the lower end; the other end has the other sort.
    fn solution(&self, (n, other): (usize, f64), edges: [Option<f64>; 2]) -> Solution {
        let at = |s: f64| Form::of(&self.exact(s, other), n).solution();
        match edges {
            [Some(lower), _] => at(lower),
            [None, Some(upper)] => match at(upper) {
                Solution::Of(Parity::Even) => Solution::Of(Parity::Odd),
                Solution::Of(Parity::Odd) => Solution::Of(Parity::Even),
                same => same,
            },
            [None, None] => Solution::Any,
        }
    }

    /// Where a tongue closes between two rows of which the first has it and the second has not: its last row and the place on it.
    fn tip(&self, n: usize, [with, without]: [f64; 2]) -> Option<[f64; 2]> {
        let top = |other: f64| {
            let tongue = self.row(other, Some(n))?.into_iter().find(|tongue| tongue.within.1)?;
            Some(self.top((n, other), tongue.within.0))
        };
        let mut lost = false;
        let mut height = |other: f64| {
            let found = top(other);
            lost |= found.is_none();
            found.map_or(f64::NAN, |top| top.1)
        };
        // the height of the top is a smooth function of the row
        let mut ends = [with, without].map(|other| (other, height(other)));
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        if (ends[0].1 > 0.0) == (ends[1].1 > 0.0) {
            return None;
        }
        let last = bracketed(&mut height, ends[0], ends[1]);
        if lost {
            return None;
        }
        Some(self.place(top(last)?.0, last))
    }
}

/// S of σM - 1, in the measure of a period of length 1.
struct Form {
    diagonal: [f64; 2],
    beside: f64,
}

impl Form {
    fn of(equation: &Damped, n: usize) -> Form {
        let [a, b, c, d] = equation.hill.monodromy().entries.map(|v| sign(n) * v);
        let period = equation.hill.period;
        Form { diagonal: [-c * period, b / period], beside: 0.5 * (a - d) }
    }

    /// In ascending order; the one of less magnitude by the determinant.
    fn eigenvalues(&self) -> [f64; 2] {
        let [p, q] = self.diagonal;
        let (mean, half) = (0.5 * (p + q), elementary::hypot(0.5 * (p - q), self.beside));
        let large = if mean < 0.0 { mean - half } else { mean + half };
        let small = if large == 0.0 { 0.0 } else { (p * q - self.beside * self.beside) / large };
        if small < large { [small, large] } else { [large, small] }
    }

    /// At a boundary: the solution of an even ψ is told by the entry that vanishes, y₁'(T) for an even one.
    fn solution(&self) -> Solution {
        let [p, q] = self.diagonal.map(f64::abs);
        let (largest, vanishes) = (p.max(q), VANISHES * p.max(q).max(1.0));
        match (largest < CLOSED, self.beside.abs() < vanishes && p.min(q) < vanishes) {
            (true, _) => Solution::Any,
            (false, false) => Solution::Neither,
            (false, true) => Solution::Of(if p < q { Parity::Even } else { Parity::Odd }),
        }
    }
}

/// Ends of tongues from row to row.
fn joined<E: Equations>(plane: &Plane<'_, E>, places: &[f64], rows: &[Vec<Tongue>]) -> Vec<Curve> {
    let mut tongues: Vec<usize> = rows.iter().flatten().map(|tongue| tongue.n).collect();
    tongues.sort_unstable();
    tongues.dedup();
    let mut all = Vec::new();
    for n in tongues {
        let list: Vec<Option<&Tongue>> = rows.iter().map(|row| row.iter().find(|tongue| tongue.n == n)).collect();
        let letters = letters(&list);
        // damped tongues that end between two rows
        let open = |k: usize| list[k].is_some_and(|tongue| tongue.edges.iter().any(Option::is_some));
        let closed = |k: usize| list[k].is_some_and(|tongue| tongue.within.1 && tongue.edges == [None, None]);
        let tips: Vec<Option<[f64; 2]>> = (1..list.len())
            .map(|k| match (open(k - 1) && closed(k), closed(k - 1) && open(k)) {
                (true, _) => plane.tip(n, [places[k - 1], places[k]]),
                (_, true) => plane.tip(n, [places[k], places[k - 1]]),
                _ => None,
            })
            .collect();
        for (which, edge) in [Edge::Lower, Edge::Upper].into_iter().enumerate() {
            // of an even ψ a curve goes on with its letter, which is at the other end of the tongue behind a row where it is closed
            let end = |k: usize| match letters[k] {
                Some(Parity::Even) => 1 - which,
                _ => which,
            };
            let letter = letters.iter().flatten().next().map(|_| if which == 0 { Parity::Odd } else { Parity::Even });
            let edge = Some(edge).filter(|_| letter.is_none());
            let mut curve = Curve { tongue: n, edge, letter, points: Vec::new(), tips: [false; 2] };
            for k in 0..list.len() {
                let point = list[k].and_then(|tongue| tongue.edges[end(k)]);
                let tip = k.checked_sub(1).and_then(|k| tips[k]);
                if let (Some(tip), true) = (tip, !curve.points.is_empty()) {
                    curve.points.push(tip);
                    curve.tips[1] = true;
                }
                let Some(s) = point else {
                    all.extend(taken(&mut curve));
                    continue;
                };
                if let (Some(tip), true) = (tip, curve.points.is_empty()) {
                    curve.points.push(tip);
                    curve.tips[0] = true;
                }
                curve.points.push(plane.place(s, places[k]));
            }
            all.extend(taken(&mut curve));
        }
    }
    all
}

/// A curve of two points at least, and the rest begins anew.
fn taken(curve: &mut Curve) -> Option<Curve> {
    let fresh = Curve { points: Vec::new(), tips: [false; 2], ..curve.clone() };
    let done = std::mem::replace(curve, fresh);
    (done.points.len() > 1).then_some(done)
}

/// The letters of lower ends row by row; closed tongues take that of the row before, or behind. None where a solution is neither even nor odd.
fn letters(list: &[Option<&Tongue>]) -> Vec<Option<Parity>> {
    let letter = |tongue: &Option<&Tongue>| match tongue.map(|tongue| tongue.solution) {
        Some(Solution::Of(parity)) => Some(parity),
        _ => None,
    };
    let mut all: Vec<Option<Parity>> = list.iter().map(letter).collect();
    if list.iter().flatten().any(|tongue| tongue.solution == Solution::Neither) {
        return vec![None; all.len()];
    }
    for k in 1..all.len() {
        all[k] = all[k].or(all[k - 1]);
    }
    for k in (1..all.len()).rev() {
        all[k - 1] = all[k - 1].or(all[k]);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::super::diagram::Family;
    use super::*;
    use algebra::hill::Hill;
    use algebra::mathieu::characteristic;
    use std::f64::consts::PI;

    /// y'' + (a - 2 q cos 2t) y = 0, b = q.
    fn mathieu(decay: f64, ends: [[f64; 2]; 2]) -> Diagram<Family> {
        Diagram::of(Family::new(&Hill { period: PI, mean: 0.0, waves: vec![[-2.0, 0.0]] }, decay), ends, [500, 500])
    }

    /// Characteristic values by Sturm's count on tridiagonal matrices; on both sides of q = 0, where every tongue but the one below is closed, and down to tongues of a width of 1e-9.
    #[test]
    fn curves_are_characteristic_values() {
        let ends = [[-6.0, 18.0], [-1.0, 6.0]];
        let (along, found) = curves(&mathieu(0.0, ends), ends, 57).unwrap();
        assert_eq!(along, Along::X);
        let names: Vec<(usize, Option<Parity>)> = found.iter().map(|c| (c.tongue, c.letter)).collect();
        let (odd, even) = (Some(Parity::Odd), Some(Parity::Even));
        assert_eq!(names, [(0, even), (1, odd), (1, even), (2, odd), (2, even), (3, odd), (3, even), (4, odd), (4, even)]);
        for curve in &found {
            // a₀, b₁ and a₄ leave the rectangle
            assert!(curve.points.len() > 40);
            for [a, q] in &curve.points {
                let value = characteristic(curve.letter.unwrap(), curve.tongue, *q).unwrap();
                // some hundred roundings of the matrix over its slope in a
                assert!((a - value).abs() < 1e-12, "{:?}{} at q = {q}: {a} {value}", curve.letter, curve.tongue);
            }
        }
    }

    /// Damping lifts the main tongue to b = 2h: (a - 1)² = b² - 4h² to first order; both of its boundaries begin at its tip, of which the next term is of order h³.
    #[test]
    fn damping_lifts_the_tongues() {
        let h = 0.01_f64;
        let ends = [[0.5, 1.5], [0.0, 0.2]];
        let (_, found) = curves(&mathieu(h, ends), ends, 41).unwrap();
        assert_eq!(found.iter().map(|c| (c.tongue, c.edge)).collect::<Vec<_>>(), [(1, Some(Edge::Lower)), (1, Some(Edge::Upper))]);
        assert!(found.iter().all(|c| c.tips == [true, false] && c.multiplier() == -1.0 && c.letter.is_none()));
        assert!((found[0].points[0][1] - 2.0 * h).abs() < h * h * h, "{:?}", found[0].points[0]);
        for (lower, upper) in found[0].points.iter().zip(&found[1].points) {
            assert_eq!(lower[1], upper[1]);
            let half = 0.5 * (upper[0] - lower[0]);
            // terms of order b² move both bounds alike
            let first = (lower[1] * lower[1] - 4.0 * h * h).max(0.0);
            assert!((half * half - first).abs() < lower[1] * lower[1] * lower[1], "{lower:?} {half}");
        }
    }

    /// Along q at given a nothing grows at every instant: rows go the other way.
    #[test]
    fn rows_go_along_what_grows() {
        struct Turned(Family);
        impl Equations for Turned {
            fn at(&self, x: f64, y: f64) -> Damped {
                self.0.at(y, x)
            }
        }
        let ends = [[0.0, 2.0], [-1.0, 6.0]];
        let family = Family::new(&Hill { period: PI, mean: 0.0, waves: vec![[-2.0, 0.0]] }, 0.0);
        let (along, found) = curves(&Diagram::of(Turned(family), ends, [100, 100]), ends, 21).unwrap();
        assert!(along == Along::Y && found.len() == 5, "{along:?} {}", found.len());
        let [q, a] = found[1].points[15];
        // as above
        assert!((a - characteristic(Parity::Odd, 1, q).unwrap()).abs() < 1e-12);
    }

    /// Gaps of y'' + (a + b p(t)) y = 0 with a p that is not even have no letters; all are closed at b = 0, at a = n².
    #[test]
    fn other_shapes_have_numbers_only() {
        let shape = Hill { period: PI, mean: 0.0, waves: vec![[1.0, 0.0], [0.3, 0.4]] };
        let ends = [[-1.0, 10.0], [0.0, 1.0]];
        let diagram = Diagram::of(Family::new(&shape, 0.0), ends, [200, 200]);
        let (_, found) = curves(&diagram, ends, 11).unwrap();
        assert_eq!(found.len(), 7);
        for curve in &found {
            assert!(curve.letter.is_none());
            // some hundred roundings of a monodromy matrix
            assert!((curve.points[0][0] - (curve.tongue * curve.tongue) as f64).abs() < 1e-12, "{curve:?}");
            for [a, b] in &curve.points {
                let [trace, _] = diagram.equations.at(*a, *b).trace();
                // the same
                assert!((trace - 2.0 * curve.multiplier()).abs() < 1e-12, "{trace}");
            }
        }
    }
}
