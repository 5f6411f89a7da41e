//! Equilibria: h(q, 0, s, 0) = 0 by damped Newton from guesses.
//!
//! Rates are zero; how loads that depend on time enter is the machine's affair ([`crate::linear`] takes their means, a `System` stands at
//! t = 0). An equilibrium of a conservative system is stable when its stiffness K = -dh/dq is positive definite (Lagrange, Dirichlet) and unstable when K has a negative direction; when K is not symmetric the loads do
//! work over closed ways (follower forces), and definiteness of the symmetric part is only a hint.

use words::{Message, Text};

use crate::dataset::{Audit, Column, Counter, Dataset, Missing};
use crate::{Fault, Quantity, System};
use algebra::cholesky::positive_definite;
use algebra::lu::Lu;
use algebra::qr::{DEPENDENT, Qr};
use words::digits::rounded;

use super::peaks;
use super::simulate::Outcome;

/// What the search for rest asks of a machine.
pub trait Statics {
    /// Number n of coordinates, the first components of x.
    fn n_coordinates(&self) -> usize;
    /// Name of coordinate `i`.
    fn name(&self, i: usize) -> &str;
    /// Generalized forces of rest, length n, and their derivatives by the coordinates, row i = force i.
    ///
    /// *Errors*: undefined there.
    fn statics(&mut self, x: &[f64], forces: &mut [f64], derivatives: &mut [f64]) -> Result<(), Fault>;
}

impl<S: System + ?Sized> Statics for S {
    fn n_coordinates(&self) -> usize {
        System::n_coordinates(self)
    }
    fn name(&self, i: usize) -> &str {
        &self.states()[i].name
    }
    fn statics(&mut self, x: &[f64], forces: &mut [f64], derivatives: &mut [f64]) -> Result<(), Fault> {
        System::statics(self, x, forces, derivatives)
    }
}

/// A state of rest near `start` (the coordinates come first), also one that is not isolated.
///
/// *Errors*: S007 when Newton's method finds none.
pub fn rest_near<S: Statics + ?Sized>(machine: &mut S, start: &[f64]) -> Result<Vec<f64>, Fault> {
    let n = machine.n_coordinates();
    let mut search =
        Search { system: machine, n, forces: vec![0.0; n], jacobian: vec![0.0; n * n], steps: 0, neutral_is_found: true, beside: true };
    search.from(start.to_vec()).map(|rest| rest.q)
}

/// Options of the study.
#[derive(Clone, Debug, Default)]
pub struct Equilibrium {
    /// Coordinates to begin from, besides the start values; n each.
    pub guesses: Vec<Vec<f64>>,
    /// Find all equilibria with this coordinate between these values.
    pub over: Option<Range>,
    /// Of these only those in which these dry frictions (by reaction) are about to slide, forward (1) or backward (-1).
    pub impending: Vec<(usize, f64)>,
}

/// A coordinate and its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Index of the coordinate.
    pub coordinate: usize,
    /// Least value.
    pub from: f64,
    /// Largest value.
    pub to: f64,
}

/// Values of the only coordinate at which the sign of its force is looked at.
const SAMPLES: usize = 4000;
/// Guesses along a range when there are other coordinates.
const GUESSES: usize = 97;

/// Other angles that are also tried half a turn further.
const TURNED: usize = 3;

/// Steps of Newton's method from one guess.
const STEPS: usize = 200;
/// Forces relative to the terms that balance in them, estimated by the stiffness times the coordinates.
const RESIDUAL: f64 = 1e-10;

/// The result for a machine without coordinates: there is nothing whose rest could be sought.
pub fn nothing_moves() -> Text {
    Text::new(
        "nothing can move: the machine has no coordinates, so there is no equilibrium to look for and no stability",
        "двигаться нечему: координат нет, поэтому нет ни искомого положения равновесия, ни вопроса об устойчивости",
    )
}

/// What rest means.
pub(crate) fn rates_are_zero() -> Text {
    Text::new("rates are zero", "скорости равны нулю")
}

/// Says what is absent in columns of equilibria.
pub fn state(data: &mut Dataset) {
    let growth = Text::new(
        "no roots: the place is not isolated, or its small motions are not linear",
        "корней нет: положение не изолировано либо малые движения в нём нелинейны",
    );
    let verdict = Text::new("small motions do not decide", "малыми движениями не решается");
    data.state("stable", Missing::Absent, verdict);
    data.state("growth", Missing::Absent, growth.clone());
    data.state("negative_directions", Missing::Absent, growth);
}

/// Equilibria from the state `start` and further guesses, one row of the result each.
///
/// Columns: the coordinates, `residual` (largest force relative to its terms), `stable` (1 yes, 0 no, NaN undecided).
///
/// *Errors* beside what was found: S007 when no guess leads to an equilibrium, S008 when nothing restores any motion there.
pub fn equilibrium<S: System + ?Sized>(system: &mut S, start: &[f64], options: &Equilibrium) -> Outcome {
    let coordinates = system.states()[..System::n_coordinates(system)].to_vec();
    find(system, &coordinates, start, options)
}

/// The same for anything that has forces of rest over these coordinates.
pub fn find<S: Statics + ?Sized>(system: &mut S, coordinates: &[Quantity], start: &[f64], options: &Equilibrium) -> Outcome {
    let n = coordinates.len();
    if n == 0 {
        return Outcome { dataset: Dataset { notes: vec![nothing_moves()], ..Dataset::default() }, fault: None };
    }
    let (forces, jacobian) = (vec![0.0; n], vec![0.0; n * n]);
    let mut search = Search { system, n, forces, jacobian, steps: 0, neutral_is_found: false, beside: options.over.is_none() };
    let mut found: Vec<Rest> = Vec::new();
    let mut faults = Vec::new();
    let own = start[..n].to_vec();
    let mut along = options.over.map(|range| search.along(range, start)).unwrap_or_default();
    if let Some(range) = options.over {
        let angle = |i: usize| i != range.coordinate && coordinates[i].unit == "rad";
        let angles: Vec<usize> = (0..n).filter(|&i| angle(i)).take(TURNED).collect();
        turned(&mut along, &angles);
    }
    for guess in std::iter::once(&own).chain(options.guesses.iter().filter(|g| g.len() == n)).chain(&along) {
        let mut x = start.to_vec();
        let rates = (2 * n).min(x.len());
        x[n..rates].fill(0.0);
        x[..n].copy_from_slice(guess);
        match search.from(x) {
            Ok(rest) if found.iter().all(|other| !other.is(&rest)) => found.push(rest),
            Ok(_) => {}
            Err(fault) => faults.push(fault),
        }
    }
    let steps = search.steps;
    if let Some(Range { coordinate, from, to }) = options.over {
        let slack = 1e-9 * (to - from);
        found.retain(|rest| (from - slack..=to + slack).contains(&rest.q[coordinate]));
        found.sort_by(|a, b| a.q[coordinate].total_cmp(&b.q[coordinate]));
        faults.retain(|f| f.code == "S008");
        if found.is_empty() && faults.is_empty() {
            faults.push(nothing_between(&coordinates[coordinate].name, from, to));
        }
    }
    let mut dataset = dataset(coordinates, &found, steps);
    if options.over.is_some() && n > 1 {
        dataset.notes.push(Text::new(
            "found by Newton's method from guesses along the range: there may be more",
            "найдены методом Ньютона из приближений вдоль диапазона: могут быть и другие",
        ));
    }
    if options.over.is_none() && n > 1 && found.iter().any(|rest| rest.stable.is_none()) {
        dataset.notes.push(Text::new(
            "neutral: no force resists a small motion in at least one direction, so these places are not isolated",
            "безразличное равновесие: хотя бы в одном направлении малому движению ничто не противится, и эти положения не изолированы",
        ));
    }
    // a guess that failed matters only when nothing was found, a free motion always
    let neutral = faults.iter().position(|f| f.code == "S008");
    let fault = match neutral {
        Some(i) => Some(faults.swap_remove(i)),
        None if found.is_empty() => faults.into_iter().next(),
        None => None,
    };
    Outcome { dataset, fault }
}

pub(crate) fn nothing_between(name: &str, from: f64, to: f64) -> Fault {
    let (a, b) = (rounded(from), rounded(to));
    Fault::new(Message {
        code: "S007",
        what: Text::new(
            format!("no equilibrium with `{name}` between {} and {}", a.en, b.en),
            format!("при `{name}` от {} до {} положений равновесия нет", a.ru, b.ru),
        ),
        why: Text::new("the force along the coordinate keeps its sign there", "сила по координате там не меняет знака"),
        help: Text::new("widen the range, or check the loads", "расширьте диапазон или проверьте нагрузки"),
    })
}

/// An equilibrium.
struct Rest {
    q: Vec<f64>,
    residual: f64,
    stable: Option<bool>,
    symmetric: bool,
}

impl Rest {
    fn is(&self, other: &Rest) -> bool {
        self.q.iter().zip(&other.q).all(|(a, b)| (a - b).abs() <= 1e-7 * (1.0 + a.abs().max(b.abs())))
    }
}

struct Search<'s, S: ?Sized> {
    system: &'s mut S,
    n: usize,
    forces: Vec<f64>,
    jacobian: Vec<f64>,
    steps: usize,
    /// Whether an equilibrium that is not isolated is an answer.
    neutral_is_found: bool,
    /// Whether places beside a free motion are sought: along a range they would be as many as guesses.
    beside: bool,
}

impl<S: Statics + ?Sized> Search<'_, S> {
    /// Newton's method with step halving on the residual measured in Newton's own metric (the length of the simplified correction), which does
    /// not depend on the units of the forces. *Source*: P. Deuflhard, Newton Methods for Nonlinear Problems, 3.3.
    fn from(&mut self, mut x: Vec<f64>) -> Result<Rest, Fault> {
        self.evaluate(&x)?;
        for _ in 0..STEPS {
            self.steps += 1;
            let lu = Lu::new(&self.jacobian, self.n);
            let balanced = self.residual(&x) <= RESIDUAL;
            let Some(correction) = lu.solve(&self.forces) else {
                let held = self.beside && Qr::alike(&self.jacobian, self.n, self.n, DEPENDENT).rank() > 0;
                if self.neutral_is_found || held {
                    return self.free(x);
                }
                return Err(if balanced { self.neutral(&lu) } else { self.failed() });
            };
            let length = norm(&correction);
            // otherwise the search ends when rounding lets no correction shrink any more
            if length <= 4.0 * f64::EPSILON * norm(&x[..self.n]) {
                return Ok(self.rest(x));
            }
            let before = self.forces.clone();
            let mut share = 1.0_f64.min(LONGEST / length);
            loop {
                let mut next = x.clone();
                next.iter_mut().zip(&correction).for_each(|(q, c)| *q -= share * c);
                let accepted =
                    self.evaluate(&next).is_ok() && lu.solve(&self.forces).is_some_and(|c| norm(&c) <= (1.0 - 0.25 * share) * length);
                if accepted {
                    x = next;
                    break;
                }
                share *= 0.5;
                if share < 1e-8 {
                    self.forces = before;
                    self.evaluate(&x)?;
                    return if balanced { Ok(self.rest(x)) } else { Err(self.failed()) };
                }
            }
        }
        Err(self.failed())
    }

    /// Guesses along a range: with one coordinate every change of sign of its force and every place where it nearly touches zero, with
    /// more coordinates equidistant values, the others as they start.
    fn along(&mut self, range: Range, start: &[f64]) -> Vec<Vec<f64>> {
        let place = |value: f64| {
            let mut q = start[..self.n].to_vec();
            q[range.coordinate] = value;
            q
        };
        let value = |k: usize, count: usize| range.from + (range.to - range.from) * k as f64 / count as f64;
        if self.n > 1 {
            return (0..=GUESSES).map(|k| place(value(k, GUESSES))).collect();
        }
        let mut rest = start.to_vec();
        let rates = (2 * self.n).min(rest.len());
        rest[self.n..rates].fill(0.0);
        let mut force = |at: f64| {
            rest[0] = at;
            self.evaluate(&rest).map_or(f64::NAN, |()| self.forces[0])
        };
        let forces: Vec<f64> = (0..=SAMPLES).map(|k| force(value(k, SAMPLES))).collect();
        let largest = forces.iter().filter(|f| f.is_finite()).fold(0.0_f64, |m, f| m.max(f.abs()));
        let mut found = vec![place_of(range.from), place_of(range.to)];
        for k in 1..=SAMPLES {
            let [a, b] = [forces[k - 1], forces[k]];
            if a * b < 0.0 || b == 0.0 {
                found.push(place_of(peaks::zero(&mut force, value(k - 1, SAMPLES), value(k, SAMPLES))));
            }
            // a force that touches zero without changing its sign
            if k < SAMPLES && b.abs() <= a.abs() && b.abs() <= forces[k + 1].abs() && b.abs() <= 1e-5 * largest {
                found.push(place_of(value(k, SAMPLES)));
            }
        }
        found
    }

    /// Newton's method where some motion is free: the free directions stay where they are.
    fn free(&mut self, mut x: Vec<f64>) -> Result<Rest, Fault> {
        let n = self.n;
        let mut residual = self.residual(&x);
        for _ in 0..STEPS {
            if residual <= f64::EPSILON {
                break;
            }
            let (correction, _) = Qr::alike(&self.jacobian, n, n, DEPENDENT).least_squares(&self.forces);
            let mut next = x.clone();
            next.iter_mut().zip(&correction).for_each(|(q, c)| *q -= c);
            self.evaluate(&next)?;
            let after = self.residual(&next);
            if after.is_nan() || after >= residual {
                break;
            }
            (x, residual) = (next, after);
        }
        self.evaluate(&x)?;
        if residual <= RESIDUAL { Ok(self.rest(x)) } else { Err(self.failed()) }
    }

    fn evaluate(&mut self, x: &[f64]) -> Result<(), Fault> {
        self.system.statics(x, &mut self.forces, &mut self.jacobian)?;
        let finite = self.forces.iter().chain(&self.jacobian).all(|v| v.is_finite());
        if finite { Ok(()) } else { Err(Fault::not_finite(&Text::new("force of rest", "сила в покое"), 0.0)) }
    }

    /// max |h_i| / sum_j |K_ij| max(|q_j|, 1).
    fn residual(&self, x: &[f64]) -> f64 {
        let n = self.n;
        (0..n).fold(0.0, |worst: f64, i| {
            let size: f64 = (0..n).map(|j| self.jacobian[i * n + j].abs() * x[j].abs().max(1.0)).sum();
            let h = self.forces[i].abs();
            worst.max(if h == 0.0 { 0.0 } else { h / size })
        })
    }

    fn rest(&self, x: Vec<f64>) -> Rest {
        let n = self.n;
        let k = |i: usize, j: usize| -self.jacobian[i * n + j];
        let symmetric = (0..n).all(|i| (0..i).all(|j| (k(i, j) - k(j, i)).abs() <= 1e-9 * (k(i, j).abs() + k(j, i).abs())));
        let even: Vec<f64> = (0..n * n).map(|p| 0.5 * (k(p / n, p % n) + k(p % n, p / n))).collect();
        Rest { residual: self.residual(&x), stable: positive_definite(&even, n), symmetric, q: x[..n].to_vec() }
    }

    fn neutral(&self, lu: &Lu) -> Fault {
        let direction = lu.null_direction().unwrap_or_default();
        let largest = direction.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let names: Vec<&str> = (0..self.n).filter(|&i| direction[i].abs() > 1e-9 * largest).map(|i| self.system.name(i)).collect();
        let names = names.join(", ");
        Fault::new(Message {
            code: "S008",
            what: Text::new(
                format!("neutral equilibrium: free motion along {names}"),
                format!("безразличное равновесие: свободное движение по {names}"),
            ),
            why: Text::new(
                "no force resists a small motion along these coordinates (a mechanism, or a machine that turns freely)",
                "малому движению по этим координатам ничто не сопротивляется (механизм или свободно вращающаяся машина)",
            ),
            help: Text::new(
                "add a spring or gravity that holds them, or fix the coordinate as a parameter",
                "добавьте пружину или силу тяжести, удерживающую их, либо задайте координату параметром",
            ),
        })
    }

    fn failed(&self) -> Fault {
        no_equilibrium()
    }
}

/// No place of rest was found.
pub fn no_equilibrium() -> Fault {
    Fault::new(Message {
        code: "S007",
        what: Text::new("no equilibrium found from this guess", "из этого приближения равновесие не найдено"),
        why: Text::new(
            "the forces do not vanish together near here, or the guess is far from the equilibrium",
            "силы здесь не обращаются в нуль одновременно, или приближение далеко от равновесия",
        ),
        help: Text::new(
            "give a `guess` nearer to the equilibrium; check that loads can be balanced",
            "задайте `guess` ближе к равновесию; проверьте, могут ли нагрузки уравновеситься",
        ),
    })
}

/// Longest step of Newton's method, SI: a radian or a metre.
const LONGEST: f64 = 1.0;

/// Adds every guess with some of the other angles turned by half a turn, where machines under gravity rest too.
fn turned(guesses: &mut Vec<Vec<f64>>, angles: &[usize]) {
    for i in angles {
        let more: Vec<Vec<f64>> = guesses
            .iter()
            .map(|q| {
                let mut q = q.clone();
                q[*i] += std::f64::consts::PI;
                q
            })
            .collect();
        guesses.extend(more);
    }
}

fn place_of(value: f64) -> Vec<f64> {
    vec![value]
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|a| a * a).sum::<f64>().sqrt()
}

fn dataset(coordinates: &[Quantity], found: &[Rest], steps: usize) -> Dataset {
    let column = |(i, q): (usize, &Quantity)| Column { quantity: q.clone(), values: found.iter().map(|r| r.q[i]).collect() };
    let mut columns: Vec<Column> = coordinates.iter().enumerate().map(column).collect();
    let labelled = |name: &str, label: Text| Quantity { label, ..Quantity::new(name, "1") };
    columns.push(Column {
        quantity: labelled("residual", Text::new("largest relative force", "наибольшая относительная сила")),
        values: found.iter().map(|r| r.residual).collect(),
    });
    columns.push(Column {
        quantity: labelled("stable", Text::new("1 stable, 0 unstable", "1 устойчиво, 0 неустойчиво")),
        values: found.iter().map(|r| r.stable.map_or(f64::NAN, |s| f64::from(u8::from(s)))).collect(),
    });
    let mut notes = vec![rates_are_zero()];
    if found.iter().any(|r| !r.symmetric) {
        notes.push(Text::new(
            "the stiffness is not symmetric: the loads are not conservative, and the verdict on stability is only a hint",
            "матрица жёсткости несимметрична: нагрузки неконсервативны, и заключение об устойчивости лишь ориентировочное",
        ));
    }
    let worst = found.iter().map(|r| r.residual).fold(0.0, f64::max);
    let name = Text::new("equilibrium: largest relative force", "равновесие: наибольшая относительная сила");
    let audits = if found.is_empty() { vec![] } else { vec![Audit::at_most("equilibrium", name, worst, RESIDUAL)] };
    let counters = vec![Counter {
        key: "newton_steps", name: Text::new("Newton steps", "шагов метода Ньютона"), value: steps as f64
    }];
    let mut data = Dataset { columns, notes, audits, counters, ..Dataset::default() };
    state(&mut data);
    data
}
