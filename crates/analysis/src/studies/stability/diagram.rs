//! The diagram of Ince and Strutt: Hill's equation over two of its coefficients.
//!
//! ```text
//! q'' + 2h q' + (a + b p(t)) q = 0      q = y e^(-ht):  y'' + (a - h² + b p) y = 0,  disturbances grow where |tr M| > 2 ch hT
//! ```
//!
//! tr M is an entire function of a and b, whatever p is, so that polynomials on patches give it everywhere ([`algebra::surface`]); values of the equation itself are their nodes. *Source*:
//! W. Magnus, S. Winkler, Hill's Equation, 1966, ch. II; E. L. Ince, Proc. R. Soc. Edinburgh 46 (1925); M. J. O. Strutt, Ergebn. Math. 1 (1932).

use algebra::elementary;
use algebra::hill::Hill;
use algebra::surface::{Rectangle, Surface};

/// Error of a trace, beside the larger of it and 1.
pub const TRACE: f64 = 1e-10;
/// Places of a row between which a boundary is looked for, over √(a - a₀) T/π: a tongue and the stable strip above it are a whole one together.
const PER_TONGUE: f64 = 24.0;
/// Halvings of an interval with a boundary; each ends at neighbouring numbers.
const HALVINGS: usize = 100;
/// Newton's steps that the equation itself adds to a boundary of the surface, which errs by 1e-10 of the trace: the second one is below rounding.
const POLISHES: usize = 3;
/// Difference of a for the slope of the trace, beside the larger of |a| and 1: the cube root of a rounding.
const DIFFERENCE: f64 = 1e-5;
/// A step of Newton's from a boundary is this small a part of its interval, or the boundary is left where it is.
const NEAR: f64 = 0.01;

/// Equations that differ in a and b.
#[derive(Clone, Debug, PartialEq)]
pub struct Family {
    /// p over its least period.
    shape: Hill,
    /// h.
    decay: f64,
}

/// The traces of a family over a rectangle.
#[derive(Clone, Debug)]
pub struct Diagram {
    /// The equations.
    pub family: Family,
    surface: Surface<1>,
    a: [f64; 2],
}

impl Family {
    /// From p and from h >= 0.
    pub fn new(shape: &Hill, decay: f64) -> Family {
        Family { shape: shape.least().0, decay }
    }
    /// y'' + ψ y = 0 at (a, b).
    pub fn at(&self, a: f64, b: f64) -> Hill {
        let waves = self.shape.waves.iter().map(|[c, s]| [b * c, b * s]).collect();
        Hill { period: self.shape.period, mean: a - self.decay * self.decay + b * self.shape.mean, waves }
    }
    /// |tr M| above which disturbances grow.
    pub fn bound(&self) -> f64 {
        2.0 * elementary::cosh(self.decay * self.shape.period)
    }
}

impl Diagram {
    /// Over a rectangle of a and b, for so many points of each. The error of a trace is `TRACE` at most.
    pub fn of(family: Family, [a, b]: [[f64; 2]; 2], points: [usize; 2]) -> Diagram {
        // what the nodes err by is far less: the rest is for the polynomials
        let asked = Rectangle { x: a, y: b, points, tolerance: 0.1 * TRACE };
        let surface = Surface::of(&asked, |a, b| Some([family.at(a, b).monodromy().trace()]));
        Diagram { family, surface, a }
    }

    /// tr M.
    pub fn trace(&self, a: f64, b: f64) -> f64 {
        self.surface.at(a, b).map_or_else(|| self.family.at(a, b).monodromy().trace(), |[trace]| trace)
    }

    /// tr M at the points of a grid, those of each a together.
    pub fn traces(&self, a: &[f64], b: &[f64]) -> Vec<f64> {
        let value = |(k, found): (usize, Option<[f64; 1]>)| match found {
            Some([trace]) => trace,
            None => self.family.at(a[k / b.len()], b[k % b.len()]).monodromy().trace(),
        };
        self.surface.grid(a, b).into_iter().enumerate().map(value).collect()
    }

    /// Estimate of the error of a trace, beside the larger of it and 1.
    pub fn error(&self) -> f64 {
        self.surface.error
    }

    /// Solutions of the equation that were made.
    pub fn values(&self) -> usize {
        self.surface.values
    }

    /// The values of a at which a row changes its verdict, ascending, each with the number of the tongue that it bounds.
    ///
    /// A tongue narrower than a few hundredths of the distance of tongues is sought by the extreme of the trace in it; one in which |tr M| stays within the error of its bound counts
    /// as closed.
    pub fn boundaries(&self, b: f64) -> Vec<(f64, usize)> {
        let bound = self.family.bound();
        let mut f = |a: f64| self.trace(a, b).abs() - bound;
        let [low, high] = self.a;
        let samples: Vec<(f64, f64)> = self.places(b).into_iter().map(|a| (a, f(a))).collect();
        let mut found: Vec<f64> = Vec::new();
        for (i, pair) in samples.windows(2).enumerate() {
            let [from, to] = [pair[0], pair[1]];
            if (from.1 > 0.0) != (to.1 > 0.0) {
                found.push(self.boundary([from.0, to.0], (b, from.1), &mut f));
                continue;
            }
            // the top of |tr M| in a narrow tongue, or its bottom between two tongues
            let Some(next) = samples.get(i + 2).filter(|next| (next.1 > 0.0) == (to.1 > 0.0)) else { continue };
            if to.1.abs() > from.1.abs() || to.1.abs() > next.1.abs() {
                continue;
            }
            let (top, value) = extreme((from.0, next.0), -to.1.signum(), &mut f);
            if (value > 0.0) != (to.1 > 0.0) && value.abs() > TRACE {
                found.push(self.boundary([from.0, top], (b, to.1), &mut f));
                found.push(self.boundary([top, next.0], (b, value), &mut f));
            }
        }
        let middles = |k: usize| {
            let below = if k == 0 { low } else { found[k - 1] };
            let above = found.get(k + 1).copied().unwrap_or(high);
            [0.5 * (below + found[k]), 0.5 * (found[k] + above)]
        };
        let tongue = |k: usize| middles(k).into_iter().find_map(|a| self.family.at(a, b).tongue()).unwrap_or(0);
        found.iter().enumerate().map(|(k, a)| (*a, tongue(k))).collect()
    }

    /// Where a row changes its verdict between two values of a, to rounding; the excess at the first of them is given.
    fn boundary(&self, [from, to]: [f64; 2], (b, first): (f64, f64), f: &mut impl FnMut(f64) -> f64) -> f64 {
        let (mut low, mut high) = (from, to);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if (f(middle) > 0.0) == (first > 0.0) { low = middle } else { high = middle }
        }
        let mut at = 0.5 * (low + high);
        let excess = |a: f64| self.family.at(a, b).monodromy().trace().abs() - self.family.bound();
        let h = DIFFERENCE * at.abs().max(1.0);
        for _ in 0..POLISHES {
            let move_by = 2.0 * h * excess(at) / (excess(at + h) - excess(at - h));
            // beside another boundary the slope says little
            if move_by.is_nan() || move_by.abs() > NEAR * (to - from) {
                break;
            }
            at -= move_by;
        }
        at
    }

    /// Values of a, evenly spaced in the root of what is above the least one of any tongue.
    fn places(&self, b: f64) -> Vec<f64> {
        let [low, high] = self.a;
        let [least, most] = self.family.at(0.0, b).extremes();
        // where ψ is negative throughout all solutions grow
        let first = low.max(-most);
        if first >= high {
            return vec![low, high];
        }
        let root = |a: f64| (a + most).max(0.0).sqrt();
        let tongues = (root(high) - root(first)) * self.family.shape.period / std::f64::consts::PI;
        // deep wells put tongues closer than free oscillation does
        let crowd = 1.0 + ((most - least) / (most + high).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let count = (tongues * PER_TONGUE * crowd).ceil().clamp(PER_TONGUE, f64::MAX) as usize;
        let step = (root(high) - root(first)) / count as f64;
        let inner = (1..count).map(|k| {
            let r = root(first) + step * k as f64;
            r * r - most
        });
        let ends = if first > low { vec![low, first] } else { vec![low] };
        ends.into_iter().chain(inner).chain([high]).collect()
    }
}

/// The greatest value of `sign` times a function within an interval, by parts of (√5 - 1)/2.
fn extreme((mut low, mut high): (f64, f64), sign: f64, f: &mut impl FnMut(f64) -> f64) -> (f64, f64) {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let mut inner = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)].map(|a| (a, f(a)));
    for _ in 0..HALVINGS {
        if sign * inner[0].1 > sign * inner[1].1 {
            high = inner[1].0;
            let next = high - GOLDEN * (high - low);
            inner = [(next, f(next)), inner[0]];
        } else {
            low = inner[0].0;
            let next = low + GOLDEN * (high - low);
            inner = [inner[1], (next, f(next))];
        }
    }
    if sign * inner[0].1 > sign * inner[1].1 { inner[0] } else { inner[1] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use algebra::mathieu::{Parity, characteristic};
    use std::f64::consts::{PI, TAU};

    /// y'' + (a - 2 q cos 2t) y = 0, b = q.
    fn mathieu(decay: f64) -> Family {
        Family::new(&Hill { period: PI, mean: 0.0, waves: vec![[-2.0, 0.0]] }, decay)
    }

    /// Points of a grid that are not those of another grid.
    fn line([low, high]: [f64; 2], count: usize) -> Vec<f64> {
        (0..count).map(|k| low + (high - low) * (k as f64 + 0.5) / count as f64).collect()
    }

    /// 500 times 500 traces cost some thousand solutions, and err by what is said: against the equation itself on a grid of its own.
    #[test]
    fn traces_keep_their_error() {
        let (a, b) = ([-5.0, 20.0], [0.0, 10.0]);
        let diagram = Diagram::of(mathieu(0.0), [a, b], [500, 500]);
        let (xs, ys) = (line(a, 41), line(b, 37));
        let mut worst = 0.0_f64;
        for (k, trace) in diagram.traces(&xs, &ys).into_iter().enumerate() {
            let own = algebra::mathieu::trace(xs[k / 37], ys[k % 37]);
            worst = worst.max((trace - own).abs() / own.abs().max(1.0));
        }
        assert!(worst <= TRACE && diagram.error() <= TRACE, "{worst:e}, said {:e}", diagram.error());
        assert!(diagram.values() <= 500 * 500 / 20, "{} solutions", diagram.values());
    }

    /// The boundaries of a row are the characteristic values, in order and numbered; the third tongue of q = 0.5 has a width of 0.004, and |tr M| - 2 is 1e-6 in it.
    #[test]
    fn boundaries_are_characteristic_values() {
        let diagram = Diagram::of(mathieu(0.0), [[-6.0, 13.0], [0.0, 6.0]], [500, 500]);
        for q in [0.5, 1.5, 5.0] {
            let found = diagram.boundaries(q);
            let mut expected = vec![(characteristic(Parity::Even, 0, q).unwrap(), 0)];
            for n in 1..=3 {
                expected.extend([Parity::Odd, Parity::Even].map(|parity| (characteristic(parity, n, q).unwrap(), n)));
            }
            assert_eq!(
                found.iter().map(|f| f.1).collect::<Vec<_>>(),
                expected.iter().map(|f| f.1).collect::<Vec<_>>(),
                "q = {q}: {found:?}"
            );
            for ((found, n), (value, _)) in found.iter().zip(&expected) {
                // some hundred roundings of the trace over its slope, which is small where a tongue is narrow
                assert!((found - value).abs() < 1e-8, "q = {q}, {n}: {found} {value}");
            }
        }
    }

    /// Damping lifts the main tongue to b = 2h: (a - 1)² = b² - 4h² to first order, and terms of order b² move both bounds alike.
    #[test]
    fn damping_lifts_the_tongues() {
        let h = 0.01_f64;
        let diagram = Diagram::of(mathieu(h), [[0.5, 1.5], [0.0, 0.2]], [500, 500]);
        assert!(diagram.boundaries(1.9 * h).is_empty());
        let found = diagram.boundaries(4.0 * h);
        assert_eq!(found.iter().map(|f| f.1).collect::<Vec<_>>(), [1, 1]);
        let half = 0.5 * (found[1].0 - found[0].0);
        // the root to an order of b more than the formula has
        assert!((half - (16.0 * h * h - 4.0 * h * h).sqrt()).abs() < h * h, "{half}");
    }

    /// y = exp(∫ cos t) solves the equation with ψ = sin t - cos² t: at a = 0, b = 1 of this p the trace is 2. Beside it the equation itself tells.
    #[test]
    fn several_harmonics_are_as_exact() {
        let p = |t: f64| {
            let (sin, cos) = elementary::sin_cos(t);
            Some(sin - cos * cos)
        };
        let family = Family::new(&Hill::of(TAU, p).unwrap(), 0.0);
        let diagram = Diagram::of(family, [[-1.0, 4.0], [-2.0, 2.0]], [500, 500]);
        assert!((diagram.trace(0.0, 1.0) - 2.0).abs() <= TRACE, "{}", diagram.trace(0.0, 1.0));
        for (a, b) in line([-1.0, 4.0], 17).into_iter().zip(line([-2.0, 2.0], 17)) {
            let own = diagram.family.at(a, b).monodromy().trace();
            assert!((diagram.trace(a, b) - own).abs() <= TRACE * own.abs().max(1.0), "{a} {b}");
        }
    }
}
