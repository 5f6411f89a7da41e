//! The search for rest without connections: h(q, 0, s, 0) = 0 by damped Newton from guesses.

use crate::fault::codes;
use words::{Message, Text};

use super::fine::Sought;
use super::poles;
use super::sizes::Sizes;
use crate::peaks;
use crate::{Fault, System};
use algebra::cholesky::positive_definite;
use algebra::lu::Lu;
use algebra::qr::{DEPENDENT, Qr};
use algebra::vectors::norm;
use words::digits::rounded;

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
    /// SI unit of coordinate `i`.
    fn unit(&self, i: usize) -> &str;
    /// The place of rest next to one that single digits give, or to where it is sought, where weak springs stand beside hard ones; none elsewhere.
    ///
    /// *Errors*: S007 where the weak forces find no rest.
    fn fine(&mut self, _: &[f64], _: Sought) -> Result<Option<FineRest>, Fault> {
        Ok(None)
    }
    /// Size of the terms that cancel in each force of the last [`Statics::statics`], beside what the derivatives make of the coordinates; zeros where it is not
    /// known.
    fn terms(&self) -> Vec<f64> {
        vec![0.0; self.n_coordinates()]
    }
}

/// A place of rest in twice the digits.
pub struct FineRest {
    /// Coordinates, rounded.
    pub q: Vec<f64>,
    /// Whether the energy is least there; none where that is open.
    pub stable: Option<bool>,
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
    fn unit(&self, i: usize) -> &str {
        &self.states()[i].unit
    }
}

/// A state of rest near `start` (the coordinates come first), also one that is not isolated.
///
/// *Errors*: S007 when Newton's method finds none.
pub fn rest_near<S: Statics + ?Sized>(machine: &mut S, start: &[f64]) -> Result<Vec<f64>, Fault> {
    let mut search = Search { neutral_is_found: true, beside: true, ..Search::new(machine) };
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

impl Equilibrium {
    /// How far from zero each coordinate is sought at least: what a machine at zero compares with.
    pub(crate) fn reach(&self, start: &[f64]) -> Vec<f64> {
        let ends = self.over.iter().map(|range| {
            let mut q = vec![0.0; start.len()];
            q[range.coordinate] = range.from.abs().max(range.to.abs());
            q
        });
        let farther = |reach: Vec<f64>, q: Vec<f64>| reach.iter().zip(q).map(|(a, b)| a.abs().max(b.abs())).collect();
        self.guesses.iter().filter(|g| g.len() == start.len()).cloned().chain(ends).fold(start.to_vec(), farther)
    }
}

/// Values of the only coordinate at which the sign of its force is looked at.
const SAMPLES: usize = 4000;

/// Guesses along a range when there are other coordinates.
const GUESSES: usize = 97;

/// Steps of Newton's method from one guess.
const STEPS: usize = 200;

/// Distance of two places that are one, relative to the sizes of the coordinates.
pub(crate) const ONE: f64 = 1e-7;

/// How far beside a place with a singular stiffness Newton's method begins, relative to the sizes, and its steps: towards a zero of order seven they leave a
/// hundredth of the way.
const ASIDE: f64 = 1e-3;
const BACK: usize = 30;

/// Forces relative to the terms that balance in them, where Newton's method comes to no better place: some hundred roundings.
const BALANCED: f64 = 1e-13;

/// Work of a force that is rounding, relative to the largest work of one over the size of a coordinate: some dozens of roundings.
const NOTHING: f64 = 64.0 * f64::EPSILON;

/// How a range was searched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Searched {
    /// Along its whole length.
    Whole,
    /// From guesses, or not with every choice of closed contacts.
    Guessed,
}

/// What is said of poles in a range, by the values of its coordinate.
pub(crate) fn at_poles(name: &str, values: &[f64]) -> Option<Text> {
    let list = |pick: fn(&Text) -> &str, gap: &str| values.iter().map(|v| pick(&rounded(*v)).to_owned()).collect::<Vec<_>>().join(gap);
    (!values.is_empty()).then(|| {
        Text::new(
            format!("at {name} = {} a force has a pole: it changes its sign there and grows from both sides, which is no place of rest", list(|t| &t.en, ", ")),
            format!("при {name} = {} сила имеет полюс: она меняет там знак, неограниченно возрастая с обеих сторон, и это не положение равновесия", list(|t| &t.ru, "; ")),
        )
    })
}

pub(crate) fn nothing_between(name: &str, (from, to): (f64, f64), searched: Searched) -> Fault {
    let (a, b) = (rounded(from), rounded(to));
    let (why_en, why_ru) = match searched {
        Searched::Whole => ("the force along the coordinate vanishes nowhere there", "сила по координате там нигде не обращается в нуль"),
        Searched::Guessed => (
            "from guesses along the range Newton's method came to none; that is no proof that there is none",
            "из приближений вдоль диапазона метод Ньютона не нашёл ни одного; это не доказывает, что их нет",
        ),
    };
    Fault::new(Message {
        code: codes::NO_REST,
        what: Text::new(
            format!("no equilibrium with `{name}` between {} and {}", a.en, b.en),
            format!("при `{name}` от {} до {} положений равновесия нет", a.ru, b.ru),
        ),
        why: Text::new(why_en, why_ru),
        help: Text::new("widen the range, or check the loads", "расширьте диапазон или проверьте нагрузки"),
    })
}

/// An equilibrium.
pub(crate) struct Rest {
    pub(crate) q: Vec<f64>,
    pub(crate) residual: f64,
    pub(crate) stable: Option<bool>,
    pub(crate) symmetric: bool,
    /// Whether some motion is free of all forces.
    pub(crate) singular: bool,
}

pub(crate) struct Search<'s, S: ?Sized> {
    pub(crate) system: &'s mut S,
    pub(crate) n: usize,
    pub(crate) forces: Vec<f64>,
    pub(crate) jacobian: Vec<f64>,
    pub(crate) steps: usize,
    /// Whether an equilibrium that is not isolated is an answer.
    pub(crate) neutral_is_found: bool,
    /// Whether places beside a free motion are sought: along a range they would be as many as guesses.
    pub(crate) beside: bool,
    pub(crate) sizes: Sizes,
}

impl<'s, S: Statics + ?Sized> Search<'s, S> {
    pub(crate) fn new(system: &'s mut S) -> Search<'s, S> {
        let n = system.n_coordinates();
        let sizes = Sizes::new((0..n).map(|i| system.unit(i)));
        Search { system, n, forces: vec![0.0; n], jacobian: vec![0.0; n * n], steps: 0, neutral_is_found: false, beside: false, sizes }
    }

    /// Rest from a place, weak springs beside hard ones too.
    pub(crate) fn sought(&mut self, x: Vec<f64>) -> Result<Rest, Fault> {
        let n = self.n;
        let found = self.from(x.clone());
        let place = found.as_ref().map_or(&x[..n], |rest| &rest.q);
        match self.system.fine(place, if found.is_ok() { Sought::Found } else { Sought::Lost }) {
            Ok(Some(FineRest { q, stable })) => {
                let mut there = x;
                there[..n].copy_from_slice(&q);
                self.evaluate(&there)?;
                Ok(Rest { stable, ..self.rest(there) })
            }
            Err(fault) if found.is_ok() => Err(fault),
            _ => found,
        }
    }

    /// Newton's method with step halving on the residual measured in Newton's own metric (the length of the simplified correction), which does
    /// not depend on the units of the forces. *Source*: P. Deuflhard, Newton Methods for Nonlinear Problems, 3.3.
    pub(crate) fn from(&mut self, mut x: Vec<f64>) -> Result<Rest, Fault> {
        self.evaluate(&x)?;
        let (mut longest, mut cut) = (LONGEST, 0);
        for _ in 0..STEPS {
            self.steps += 1;
            let lu = Lu::new(&self.jacobian, self.n);
            let balanced = self.residual(&x) <= BALANCED;
            let Some(correction) = lu.solve(&self.forces) else {
                let held = self.beside && Qr::alike(&self.jacobian, self.n, self.n, DEPENDENT).rank() > 0;
                if self.neutral_is_found || held {
                    return self.free(x);
                }
                return match lu.null_direction() {
                    Some(free) if balanced && self.is_isolated(&x, &free)? => Ok(self.rest(x)),
                    _ => Err(if balanced { self.neutral(&lu) } else { self.failed() }),
                };
            };
            let length = norm(&correction);
            // otherwise the search ends when rounding lets no correction shrink any more
            if length <= 4.0 * f64::EPSILON * norm(&x[..self.n]) {
                return Ok(self.rest(x));
            }
            let before = self.forces.clone();
            // a place that many steps have not come near is far by its units
            cut = if length > longest { cut + 1 } else { 0 };
            longest *= if cut > PATIENCE { 2.0 } else { 1.0 };
            let mut share = 1.0_f64.min(longest / length);
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
                // twenty-six halvings: no direction of descent
                if share < 1e-8 {
                    self.forces = before;
                    self.evaluate(&x)?;
                    return if balanced { Ok(self.rest(x)) } else { Err(self.failed()) };
                }
            }
        }
        // towards a multiple zero every step leaves a share of the way
        if self.residual(&x) <= BALANCED || self.is_nothing(&x) { Ok(self.rest(x)) } else { Err(self.failed()) }
    }

    /// Whether a place with a singular stiffness is a multiple zero of the forces and not one of a line of places: from beside it Newton's method comes back.
    fn is_isolated(&mut self, x: &[f64], free: &[f64]) -> Result<bool, Fault> {
        let n = self.n;
        let sizes = self.sizes.at(&[&x[..n]]);
        let longest = free.iter().zip(&sizes).fold(0.0_f64, |m, (v, size)| m.max(v.abs() / size));
        let square: f64 = free.iter().map(|v| v * v).sum();
        let mut comes_back = true;
        for off in [ASIDE, -ASIDE] {
            let mut there = x.to_vec();
            there.iter_mut().zip(free).for_each(|(q, v)| *q += off * v / longest);
            for _ in 0..BACK {
                self.evaluate(&there)?;
                let (correction, _) = Qr::alike(&self.jacobian, n, n, DEPENDENT).least_squares(&self.forces);
                there.iter_mut().zip(&correction).for_each(|(q, c)| *q -= c);
            }
            let left: f64 = there.iter().zip(x).zip(free).map(|((a, b), v)| (a - b) * v).sum::<f64>() / square;
            comes_back &= (left * longest).abs() <= 0.5 * ASIDE;
        }
        comes_back |= self.is_held_farther_off(x)?;
        self.evaluate(x)?;
        Ok(comes_back)
    }

    /// Whether the force of the only coordinate, which is rounding beside a place, is one farther off: then it is of higher order.
    fn is_held_farther_off(&mut self, x: &[f64]) -> Result<bool, Fault> {
        let size = self.sizes.at(&[&x[..self.n]])[0].max(1.0);
        let (mut held, alone) = (false, self.n == 1);
        for off in FARTHER.into_iter().filter(|_| alone).flat_map(|off| [off, -off]) {
            let mut there = x.to_vec();
            there[0] += off * size;
            // beyond the end of a formula nothing is asked
            held |= self.evaluate(&there).is_ok() && self.residual(&there) > CLEAR;
        }
        Ok(held)
    }

    /// The middle of two places between which no force is clear of its rounding: they are one, at a zero of higher order.
    pub(crate) fn between(&mut self, [a, b]: [&[f64]; 2], x: &[f64]) -> Option<Rest> {
        let n = self.n;
        let mut at = |share: f64| {
            let mut there = x.to_vec();
            (0..n).for_each(|i| there[i] = a[i] + share * (b[i] - a[i]));
            self.evaluate(&there).ok().filter(|()| self.residual(&there) <= FLAT)?;
            Some(self.rest(there))
        };
        ACROSS.into_iter().map(&mut at).collect::<Option<Vec<Rest>>>()?.into_iter().next()
    }

    /// Guesses along a range: with one coordinate every change of sign of its force and every place where it nearly touches zero, with
    /// more coordinates equidistant values, the others as they start.
    pub(crate) fn along(&mut self, range: Range, start: &[f64]) -> Vec<Vec<f64>> {
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
            // a force that touches zero without changing its sign, or passes it twice between two samples
            if k < SAMPLES && b.abs() <= a.abs() && b.abs() <= forces[k + 1].abs() && b.abs() <= TOUCHING * largest {
                let (low, high) = (value(k - 1, SAMPLES), value(k + 1, SAMPLES));
                found.extend(pair(&mut force, [low, value(k, SAMPLES), high]).map(place_of));
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
        if residual <= BALANCED || self.is_nothing(&x) { Ok(self.rest(x)) } else { Err(self.failed()) }
    }

    /// Whether all forces are rounding beside the largest of the machine, by the works that they do over the sizes of the coordinates. At a multiple zero a
    /// force and all terms that meet in it vanish together, and there is nothing of its own to compare it with.
    fn is_nothing(&self, x: &[f64]) -> bool {
        let n = self.n;
        let (terms, sizes) = (self.system.terms(), self.sizes.at(&[&x[..n]]));
        let reach = |i: usize| terms[i] + (0..n).map(|j| self.jacobian[i * n + j].abs() * x[j].abs().max(sizes[j])).sum::<f64>();
        let largest = (0..n).map(|i| reach(i) * sizes[i]).fold(0.0, f64::max);
        (0..n).all(|i| (self.forces[i] * sizes[i]).abs() <= NOTHING * largest)
    }

    /// Whether a force has a pole at a place along some coordinate.
    pub(crate) fn is_pole(&mut self, x: &[f64]) -> bool {
        let sizes = self.sizes.at(&[&x[..self.n]]);
        (0..self.n).any(|j| {
            poles::is_pole(&mut |s| {
                let mut there = x.to_vec();
                there[j] += s * sizes[j];
                self.evaluate(&there).ok()?;
                let clear = |i: usize| if self.share(i, &there) > poles::CLEAR { self.forces[i] } else { 0.0 };
                Some((0..self.n).map(clear).collect())
            })
        })
    }

    fn evaluate(&mut self, x: &[f64]) -> Result<(), Fault> {
        self.system.statics(x, &mut self.forces, &mut self.jacobian)?;
        let finite = self.forces.iter().chain(&self.jacobian).all(|v| v.is_finite());
        if finite { Ok(()) } else { Err(Fault::not_finite(&Text::new("force of rest", "сила в покое"), 0.0)) }
    }

    /// max |h_i| / (Σ_j |K_ij q_j| + the terms that cancel in h_i).
    fn residual(&self, x: &[f64]) -> f64 {
        (0..self.n).fold(0.0, |worst: f64, i| worst.max(self.share(i, x)))
    }

    /// The same of one force.
    fn share(&self, i: usize, x: &[f64]) -> f64 {
        let slopes = &self.jacobian[i * self.n..(i + 1) * self.n];
        let moved: f64 = slopes.iter().zip(x).map(|(k, q)| (k * q).abs()).sum();
        let size = moved + self.system.terms()[i] + self.sizes.beside(slopes, &x[..self.n]);
        let h = self.forces[i].abs();
        if h == 0.0 { 0.0 } else { h / size }
    }

    fn rest(&self, x: Vec<f64>) -> Rest {
        let n = self.n;
        let k = |i: usize, j: usize| -self.jacobian[i * n + j];
        // derivatives of a potential are symmetric to rounding; a follower force is off by its whole size
        let symmetric = (0..n).all(|i| (0..i).all(|j| (k(i, j) - k(j, i)).abs() <= 1e-9 * (k(i, j).abs() + k(j, i).abs())));
        let even: Vec<f64> = (0..n * n).map(|p| 0.5 * (k(p / n, p % n) + k(p % n, p / n))).collect();
        let singular = Lu::new(&self.jacobian, n).null_direction().is_some();
        Rest { residual: self.residual(&x), stable: positive_definite(&even, n), symmetric, singular, q: x[..n].to_vec() }
    }

    fn neutral(&self, lu: &Lu) -> Fault {
        let direction = lu.null_direction().unwrap_or_default();
        let largest = direction.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        // rounding of a null vector names no coordinate
        let names: Vec<&str> = (0..self.n).filter(|&i| direction[i].abs() > 1e-9 * largest).map(|i| self.system.name(i)).collect();
        let names = names.join(", ");
        Fault::new(Message {
            code: codes::NEUTRAL,
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
        code: codes::NO_REST,
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

/// There is none, and small motions need none: the loads accelerate a machine whose coefficients are the same everywhere (a free shaft under a torque).
pub fn accelerated() -> Fault {
    Fault::new(Message {
        code: codes::NO_REST,
        what: Text::new("the loads set this machine in motion: it has no equilibrium", "нагрузки разгоняют эту машину: равновесия нет"),
        why: Text::new(
            "something turns or moves freely, and a force acts on it; the coefficients of small motions are the same in every place",
            "есть свободное движение, и на него действует сила; коэффициенты малых движений всюду одни и те же",
        ),
        help: Text::new(
            "about = \"start\" (--about-start) gives the modes, whatever the loads are; or balance the loads",
            "about = \"start\" (--about-start) даст собственные движения при любых нагрузках; либо уравновесьте нагрузки",
        ),
    })
}

/// Displacements at which a force of higher order shows, in metres or radians.
const FARTHER: [f64; 4] = [1e-4, 1e-3, 1e-2, 0.1];
/// A force above this share of the terms that meet in it is one.
const CLEAR: f64 = 1e-9;
/// Shares of the way between two places at which forces are looked at, the middle first.
pub(crate) const ACROSS: [f64; 5] = [0.5, 0.13, 0.31, 0.71, 0.89];
/// A force below this share of the terms that meet in it is rounding there: some ten units in the last place.
pub(crate) const FLAT: f64 = 1e-14;
/// So near, as a share of their sizes, two places may be one.
pub(crate) const BESIDE: f64 = 1e-2;

/// The ends of what is one place, with one more: those that are farthest apart.
pub(crate) fn widened([a, b]: &[Vec<f64>; 2], q: &[f64]) -> [Vec<f64>; 2] {
    let apart = |p: &[f64], q: &[f64]| p.iter().zip(q).map(|(p, q)| (p - q).abs()).fold(0.0, f64::max);
    let far = if apart(a, q) >= apart(b, q) { a } else { b };
    if apart(far, q) > apart(a, b) { [far.clone(), q.to_vec()] } else { [a.clone(), b.clone()] }
}

/// A force below this share of the largest along a range may touch zero.
const TOUCHING: f64 = 1e-5;

/// Two places beside each other, where a force that comes near zero at `middle` passes it twice between the ends: the zeros on both sides of its extreme. Where
/// it does not pass, the extreme alone, as a guess.
fn pair(force: &mut dyn FnMut(f64) -> f64, [low, middle, high]: [f64; 3]) -> impl Iterator<Item = f64> {
    let sign = if force(low) > 0.0 { -1.0 } else { 1.0 };
    let extreme = peaks::highest(&mut |x| sign * force(x), low, high);
    let passes = sign * force(extreme) > 0.0 && sign * force(high) < 0.0;
    let found = if passes { [peaks::zero(force, low, extreme), peaks::zero(force, extreme, high)] } else { [middle, extreme] };
    found.into_iter()
}

/// Longest step of Newton's method, SI: a radian or a metre.
const LONGEST: f64 = 1.0;
/// Steps in a row that are cut to the longest one before it grows.
const PATIENCE: usize = 30;

fn place_of(value: f64) -> Vec<f64> {
    vec![value]
}
