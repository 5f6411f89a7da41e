//! A linkage followed over its driven coordinates: places by continuation, first and second derivatives of all coordinates.
//!
//! The conditions of connections are known through [`System::project`] alone. Its derivative P at a place is the projection on the directions in
//! which the machine can move; the direction with given rates of the driven coordinates is b = P y, P_driven y = rates. A place is found by moving
//! along b and projecting, in turns, until the driven coordinates have their values.

use symbolic::Text;

use super::periodic::derivative;
use crate::fault::{Message, number};
use crate::numerics::rank::Qr;
use crate::{Fault, Mode, System};

/// A place with the derivatives along the way.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Place {
    /// Coordinates.
    pub q: Vec<f64>,
    /// dq/ds, s the parameter of the way.
    pub first: Vec<f64>,
    /// d²q/ds².
    pub second: Vec<f64>,
}

/// Turns of moving and projecting.
const TURNS: usize = 60;
/// Half width of the differences along the way, rad or share of the range.
const WIDTH: f64 = 2e-3;
/// Longest way between two places, rad.
const LONGEST: f64 = 0.05;
/// Directions longer than this times the driven rate: a dead point.
const DEAD: f64 = 1e7;

/// Directions in which the machine can move at a place, at rest: columns of the projection, one per degree of freedom, each 1 at its own coordinate.
pub fn freedoms<S: System + ?Sized>(system: &mut S, x: &[f64], modes: &[Mode]) -> Result<Vec<(usize, Vec<f64>)>, Fault> {
    let n = system.n_coordinates();
    let p = projection(system, &x[..n], x, modes)?;
    let transposed: Vec<f64> = (0..n * n).map(|k| p[k % n][k / n]).collect();
    let mut free = Qr::new(n, n, &transposed, 1e-8).independent().to_vec();
    if p.iter().flatten().all(|e| e.abs() < 1e-9) {
        free.clear();
    }
    free.sort_unstable();
    let mut out = Vec::new();
    for &i in &free {
        let driven: Vec<(usize, f64)> = free.iter().map(|&k| (k, if k == i { 1.0 } else { 0.0 })).collect();
        out.push((i, direction(&p, &driven)));
    }
    Ok(out)
}

/// Derivative of the projection of places.
fn projection<S: System + ?Sized>(system: &mut S, q: &[f64], like: &[f64], modes: &[Mode]) -> Result<Vec<Vec<f64>>, Fault> {
    let n = q.len();
    let scales: Vec<f64> = (0..n).map(|i| if system.states()[i].unit == "rad" { 1.0 } else { q[i].abs().max(0.1) }).collect();
    derivative(q, &scales, |place| project(system, place, like, modes))
}

fn project<S: System + ?Sized>(system: &mut S, q: &[f64], like: &[f64], modes: &[Mode]) -> Result<Vec<f64>, Fault> {
    let n = q.len();
    let mut x = like.to_vec();
    x[..n].copy_from_slice(q);
    x[n..2 * n].fill(0.0);
    system.project(0.0, &mut x, modes)?;
    Ok(x[..n].to_vec())
}

/// The direction with these components.
fn direction(p: &[Vec<f64>], driven: &[(usize, f64)]) -> Vec<f64> {
    let n = p.len();
    let rows: Vec<f64> = driven.iter().flat_map(|&(i, _)| p[i].iter().copied()).collect();
    let wanted: Vec<f64> = driven.iter().map(|d| d.1).collect();
    let y = Qr::new(driven.len(), n, &rows, 1e-10).least_squares(&wanted).0;
    p.iter().map(|row| row.iter().zip(&y).map(|(a, b)| a * b).sum()).collect()
}

/// Follows the linkage: `driven` says for a parameter s the driven coordinates with value and first derivative. Places at `ways`, ascending or
/// descending, from the state `start`, whose place is near that of the first way. Ends early at a dead point, with the fault beside.
pub fn follow<S: System + ?Sized>(
    system: &mut S,
    start: &[f64],
    ways: &[f64],
    driven: &dyn Fn(f64) -> Vec<(usize, f64, f64)>,
) -> (Vec<Place>, Option<Fault>) {
    let n = system.n_coordinates();
    let modes = vec![Mode::Zero; system.guards().len()];
    let mut bench = Bench { system, like: start.to_vec(), modes, driven };
    let mut out = Vec::new();
    let mut q = start[..n].to_vec();
    let mut at: Option<f64> = None;
    for &s in ways {
        match bench.advance(&q, at.unwrap_or(s), s).and_then(|q| bench.place(q, s)) {
            Ok(place) => {
                q.clone_from(&place.q);
                at = Some(s);
                out.push(place);
            }
            Err(fault) => return (out, Some(fault)),
        }
    }
    (out, None)
}

struct Bench<'a, S: System + ?Sized> {
    system: &'a mut S,
    like: Vec<f64>,
    modes: Vec<Mode>,
    driven: &'a dyn Fn(f64) -> Vec<(usize, f64, f64)>,
}

impl<S: System + ?Sized> Bench<'_, S> {
    /// From the place at s = a to that at b, in short ways.
    fn advance(&mut self, q: &[f64], a: f64, b: f64) -> Result<Vec<f64>, Fault> {
        let parts = ((b - a).abs() / LONGEST).ceil().max(1.0) as usize;
        let mut q = q.to_vec();
        for k in 1..=parts {
            q = self.close(&q, a + (b - a) * k as f64 / parts as f64)?;
        }
        Ok(q)
    }

    /// The place at s nearest to q.
    fn close(&mut self, q: &[f64], s: f64) -> Result<Vec<f64>, Fault> {
        let targets = (self.driven)(s);
        let mut q = q.to_vec();
        let mut least = f64::INFINITY;
        for _ in 0..TURNS {
            q = project(self.system, &q, &self.like, &self.modes)?;
            let gaps: Vec<(usize, f64)> = targets.iter().map(|&(i, value, _)| (i, value - q[i])).collect();
            let gap = gaps.iter().fold(0.0_f64, |m, g| m.max(g.1.abs()));
            if gap <= 4e-16 * (1.0 + s.abs()) || (gap < 1e-12 && gap >= least) {
                return Ok(q);
            }
            least = gap;
            let p = projection(self.system, &q, &self.like, &self.modes)?;
            let step = direction(&p, &gaps);
            let longest = step.iter().fold(0.0_f64, |m, d| m.max(d.abs()));
            if longest.is_nan() || longest > DEAD * gap {
                return Err(self.dead(&q, &targets));
            }
            let factor = if longest > 0.3 { 0.3 / longest } else { 1.0 };
            q.iter_mut().zip(&step).for_each(|(q, d)| *q += factor * d);
        }
        if least < 1e-10 { Ok(q) } else { Err(self.dead(&q, &targets)) }
    }

    fn first(&mut self, q: &[f64], s: f64) -> Result<Vec<f64>, Fault> {
        let p = projection(self.system, q, &self.like, &self.modes)?;
        let targets = (self.driven)(s);
        let rates: Vec<(usize, f64)> = targets.iter().map(|&(i, _, rate)| (i, rate)).collect();
        let b = direction(&p, &rates);
        let largest = rates.iter().fold(0.0_f64, |m, r| m.max(r.1.abs()));
        let off = rates.iter().fold(0.0_f64, |m, &(i, r)| m.max((b[i] - r).abs()));
        if off > 1e-6 * largest || b.iter().any(|b| b.abs() > DEAD * largest) {
            return Err(self.dead(q, &targets));
        }
        Ok(b)
    }

    /// The place with both derivatives; the second one by differences of the first, of fourth order.
    fn place(&mut self, q: Vec<f64>, s: f64) -> Result<Place, Fault> {
        let first = self.first(&q, s)?;
        let mut sides = Vec::new();
        for k in [-2.0, -1.0, 1.0, 2.0] {
            let at = s + k * WIDTH;
            let beside: Vec<f64> = q.iter().zip(&first).map(|(q, b)| q + b * k * WIDTH).collect();
            // beside a dead point one side does not exist
            let Ok(place) = self.close(&beside, at) else { return Ok(Place { second: vec![f64::NAN; q.len()], q, first }) };
            let Ok(b) = self.first(&place, at) else { return Ok(Place { second: vec![f64::NAN; q.len()], q, first }) };
            sides.push(b);
        }
        let second = (0..q.len()).map(|i| (8.0 * (sides[2][i] - sides[1][i]) - (sides[3][i] - sides[0][i])) / (12.0 * WIDTH)).collect();
        Ok(Place { q, first, second })
    }

    /// The linkage cannot be driven further from here.
    fn dead(&self, q: &[f64], targets: &[(usize, f64, f64)]) -> Fault {
        let names = self.system.states();
        let place = |ru: bool| {
            let each = q.iter().enumerate().map(|(i, v)| {
                let short: f64 = format!("{v:.6}").parse().unwrap_or(*v);
                let n = number(short);
                format!("{} = {}", names[i].name, if ru { n.ru } else { n.en })
            });
            each.collect::<Vec<_>>().join("; ")
        };
        let driven = targets.iter().map(|t| names[t.0].name.clone()).collect::<Vec<_>>().join(", ");
        Fault::new(Message {
            code: "S049",
            what: Text::new(
                format!("`{driven}` cannot be driven further: dead point at {}", place(false)),
                format!("дальше вести `{driven}` нельзя: мёртвое положение при {}", place(true)),
            ),
            why: Text::new(
                "levers stand in line, or the range leaves what the linkage can reach, or the linkage has other degrees of freedom",
                "звенья вытянулись в линию, промежуток выходит за достижимые положения или у механизма другое число степеней свободы",
            ),
            help: Text::new(
                "end the range before it, drive another coordinate, or name further driven coordinates in `with`",
                "закончите промежуток раньше, ведите другую координату или задайте остальные ведущие координаты в `with`",
            ),
        })
    }
}
