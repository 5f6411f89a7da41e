//! Past hard spots and to dead points: the linkage is followed along the length of its way, where the driven coordinate may turn back.
//!
//! z = (q, s) moves along the direction v with [J; E] v_q + (r/w; -d') v_s = 0, |v| = 1 (angles times their arm). At a dead point v_s passes zero: it is
//! located there by bisection of the length.

use crate::fault::codes;
use algebra::elementary;
use words::{Message, Text};

use super::extrapolation;
use super::linkage::{Linkage, Spot};
use super::stand::Stand;
use crate::Fault;
use words::digits::ten_digits;

/// First step along the way, rad or arms.
const STEP: f64 = 0.01;
/// Steps before the way is given up.
const STEPS: usize = 4000;
// some hundred units of the last place of the terms that meet
const TOLERANCE: f64 = 1e-13;
const BISECTIONS: usize = 60;

/// A place on the way by its length.
#[derive(Clone)]
struct Point {
    z: Vec<f64>,
    v: Vec<f64>,
}

impl Linkage<'_> {
    /// Follows the way by its length from `here` until the driven coordinate reaches `to`.
    ///
    /// *Errors*: S049 where it turns back, S028 where the way cannot be continued.
    pub(super) fn turn(&mut self, here: &Stand, to: f64) -> Result<Stand, Fault> {
        let sense = (to - here.s).signum();
        let z = [&here.at[..], &[here.s]].concat();
        let Some(v) = self.tangent(&z, None, sense)? else { return Err(self.singular(&here.at, here.s)) };
        let mut point = Point { z, v };
        let mut length = STEP;
        for _ in 0..STEPS {
            let Some(next) = self.along(&point, length) else {
                length *= 0.5;
                // thirty halvings: the way ends here
                if length < 1e-9 * STEP {
                    return Err(self.singular(&point.z, point.z[point.z.len() - 1]));
                }
                continue;
            };
            if next.v[self.n] * sense <= 0.0 {
                let dead = self.bisect(&point, length, |linkage, p| p.v[linkage.n] * sense <= 0.0);
                return Err(self.dead(&dead.z));
            }
            if (next.s() - to) * sense >= 0.0 {
                let there = self.bisect(&point, length, |_, p| (p.s() - to) * sense >= 0.0);
                return self.stand(&there, to);
            }
            point = next;
            length = (2.0 * length).min(STEP);
        }
        Err(self.singular(&point.z, point.s()))
    }

    /// The place at exactly `to`, closed.
    fn stand(&mut self, point: &Point, to: f64) -> Result<Stand, Fault> {
        let at = &point.z[..point.z.len() - 1];
        let Some((at, _)) = self.closed(to, at) else { return Err(self.singular(at, to)) };
        let integrated = match self.first(to, &at)? {
            Some((b, _)) => b,
            None => return Err(self.singular(&at, to)),
        };
        Ok(Stand { s: to, at, integrated })
    }

    /// The point nearest before which `past` does not hold, between the start of a step and its end.
    fn bisect(&mut self, from: &Point, length: f64, past: impl Fn(&Self, &Point) -> bool) -> Point {
        let (mut low, mut high) = (0.0, length);
        let mut best = from.clone();
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            match self.along(from, middle) {
                Some(point) if !past(self, &point) => (low, best) = (middle, point),
                _ => high = middle,
            }
        }
        best
    }

    /// The point at this length from another.
    fn along(&mut self, from: &Point, length: f64) -> Option<Point> {
        let scales: Vec<f64> = (0..from.z.len()).map(|i| if i < self.n { 1.0 / self.scale(i) * self.arm } else { 1.0 }).collect();
        let like = from.v.clone();
        let mut field = |_: f64, z: &[f64]| self.tangent(z, Some(&like), 0.0).ok().flatten().map(|v| self.with_auxiliaries(z, &v));
        let z = extrapolation::step(&mut field, (0.0, length), &from.z, &scales, TOLERANCE)?;
        let v = self.tangent(&z, Some(&like), 0.0).ok().flatten()?;
        Some(Point { z, v })
    }

    /// Derivative of z by the length: (q, auxiliaries, s).
    fn with_auxiliaries(&mut self, z: &[f64], v: &[f64]) -> Vec<f64> {
        let (n, s) = (self.n, z[z.len() - 1]);
        let at = z[..z.len() - 1].to_vec();
        let rest = self.auxiliary_slopes(s, &at);
        let slow = rest.iter().map(|r| r * v[n]);
        v[..n].iter().copied().chain(slow).chain([v[n]]).collect()
    }

    /// (dq, ds) of length 1, in the sense of `like` or else with ds of the sign `sense`; none where the way branches.
    fn tangent(&mut self, z: &[f64], like: Option<&[f64]>, sense: f64) -> Result<Option<Vec<f64>>, Fault> {
        let (n, s) = (self.n, z[z.len() - 1]);
        let at: Spot = z[..z.len() - 1].to_vec();
        let mut directions = self.directions(s, &at)?;
        let (Some(v), true) = (directions.pop(), directions.is_empty()) else { return Ok(None) };
        let weight = |i: usize| if i < n && !self.angles[i] { 1.0 / self.arm } else { 1.0 };
        let length = v.iter().enumerate().fold(0.0_f64, |l, (i, v)| elementary::hypot(l, v * weight(i)));
        let along = match like {
            Some(like) => v.iter().zip(like).enumerate().map(|(i, (a, b))| a * b * weight(i) * weight(i)).sum(),
            None => v[n] * sense,
        };
        let factor = if along < 0.0 { -1.0 / length } else { 1.0 / length };
        Ok(Some(v.iter().map(|v| v * factor).collect()))
    }

    /// Why the linkage cannot stand at a place where the drives do not determine it: the driven coordinate turns back there, or several ways meet.
    pub(super) fn stuck(&mut self, at: &Spot, s: f64) -> Result<Fault, Fault> {
        // along the way itself, not along that to its first place
        self.arrived();
        let single = self.directions(s, at)?.len() == 1;
        Ok(if single { self.dead(at) } else { self.singular(at, s) })
    }

    /// The linkage cannot be driven further from here.
    fn dead(&self, z: &[f64]) -> Fault {
        let place = self.place(z);
        let driven = self.driven_names();
        Fault::new(Message {
            code: "S049",
            what: Text::new(
                format!("`{driven}` cannot be driven further: dead point at {}", place.en),
                format!("дальше вести `{driven}` нельзя: мёртвое положение при {}", place.ru),
            ),
            why: Text::new(
                "the driven coordinate has an extreme value here: levers stand in line, or the range leaves what the linkage can reach",
                "ведущая координата достигает здесь крайнего значения: звенья вытянулись в линию или промежуток выходит за достижимые положения",
            ),
            help: Text::new(
                "end the range before it, or drive another coordinate",
                "закончите промежуток раньше или ведите другую координату",
            ),
        })
    }

    /// The way branches or ends.
    pub(super) fn singular(&self, at: &[f64], s: f64) -> Fault {
        let place = self.place(at);
        let s = ten_digits(s);
        let driven = self.driven_names();
        Fault::new(Message {
            code: codes::BRANCHING,
            what: Text::new(
                format!("the linkage cannot be followed at `{driven}` = {}: {}", s.en, place.en),
                format!("механизм нельзя проследить при `{driven}` = {}: {}", s.ru, place.ru),
            ),
            why: Text::new(
                "in this position the driven coordinates do not determine where the links go next: several ways meet, or there is none",
                "в этом положении ведущие координаты не определяют дальнейшее движение звеньев: сходятся несколько путей или нет ни одного",
            ),
            help: Text::new(
                "begin or end the range elsewhere, or drive another coordinate",
                "начните или закончите промежуток в другом месте или ведите другую координату",
            ),
        })
    }

    pub(super) fn driven_names(&self) -> String {
        let all = std::iter::once(self.over).chain(self.with.iter().copied());
        all.map(|i| self.name(i)).collect::<Vec<_>>().join(", ")
    }

    pub(super) fn name(&self, i: usize) -> &str {
        &self.equations.graph.symbol_info(self.equations.coordinates[i].symbols[0]).name
    }

    /// `p1 = 0.7122; p3 = 1.77`.
    fn place(&self, at: &[f64]) -> Text {
        let each: Vec<Text> = (0..self.n)
            .map(|i| {
                let v = ten_digits(at[i]);
                Text::new(format!("{} = {}", self.name(i), v.en), format!("{} = {}", self.name(i), v.ru))
            })
            .collect();
        let join = |pick: fn(&Text) -> &str| each.iter().map(pick).collect::<Vec<_>>().join("; ");
        Text::new(join(|t| &t.en), join(|t| &t.ru))
    }
}

impl Point {
    fn s(&self) -> f64 {
        self.z[self.z.len() - 1]
    }
}
