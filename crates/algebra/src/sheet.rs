//! Many smooth functions of two parameters over a rectangle at once, each a sum of Chebyshev polynomials of one degree: coefficients of an equation over the parameters of a machine.
//!
//! ```text
//! f_k(x, y) ≈ Σ c_kij T_i(ξ) T_j(η),   ξ, η ∈ [-1, 1],   c from the values at cos(πl/n), l = 0 ... n
//! ```
//!
//! Degrees 4, 8, 16 and 32 are tried; their nodes hold those of the degree before. A degree is enough where the last two coefficients in each direction are below the tolerance and values
//! between the nodes agree. *Source*: L. N. Trefethen, Approximation Theory and Approximation Practice, 2013, ch. 3, 4, 8.

use crate::elementary;
use crate::surface::{place, share};
use std::f64::consts::PI;

/// Degrees that are tried.
const DEGREES: [usize; 4] = [4, 8, 16, 32];
/// The last of them.
const FINEST: usize = 32;
/// Last coefficients of a direction that count as what was left out: even and odd functions have every second one 0.
const LAST: usize = 2;
/// Places between the nodes, as shares of the sides: multiples of √2 - 1 and of √3 - 1 without their whole parts, apart from one another and from the nodes.
const BETWEEN: [[f64; 2]; 4] = [[0.414, 0.732], [0.828, 0.464], [0.243, 0.196], [0.657, 0.928]];

/// Functions over a rectangle.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    x: [f64; 2],
    y: [f64; 2],
    degree: usize,
    /// How many functions there are.
    pub width: usize,
    /// c_kij: k within j within i.
    coefficients: Vec<f64>,
    /// Places at which the functions were asked for.
    pub places: usize,
}

/// Values at the nodes of the finest degree, as far as they are known.
struct Known<F> {
    f: F,
    values: Vec<Option<Vec<f64>>>,
    places: usize,
}

impl<F: FnMut(f64, f64) -> Option<Vec<f64>>> Known<F> {
    fn ask(&mut self, x: f64, y: f64) -> Option<Vec<f64>> {
        self.places += 1;
        (self.f)(x, y).filter(|found| found.iter().all(|v| v.is_finite()))
    }
}

impl Sheet {
    /// The functions of a rectangle; none where one has no value, or a degree of 32 does not reach the tolerance: a share of the larger of 1 and of the greatest value of all functions. Where
    /// a place gives fewer functions than another, the rest are 0 there.
    pub fn of(x: [f64; 2], y: [f64; 2], tolerance: f64, f: impl FnMut(f64, f64) -> Option<Vec<f64>>) -> Option<Sheet> {
        let side = FINEST + 1;
        let mut known = Known { f, values: vec![None; side * side], places: 0 };
        let mut between: Vec<([f64; 2], Vec<f64>)> = Vec::new();
        for degree in DEGREES {
            let stride = FINEST / degree;
            let nodes = |k: usize| elementary::cos(PI * (k * stride) as f64 / FINEST as f64);
            let mut width = between.iter().map(|(_, values)| values.len()).max().unwrap_or(0);
            for (i, j) in (0..=degree).flat_map(|i| (0..=degree).map(move |j| (i, j))) {
                let index = i * stride * side + j * stride;
                if known.values[index].is_none() {
                    known.values[index] = Some(known.ask(place(x, nodes(i)), place(y, nodes(j)))?);
                }
                width = width.max(known.values[index].as_ref().map_or(0, Vec::len));
            }
            let value = |i: usize, j: usize, k: usize| {
                known.values[i * stride * side + j * stride].as_ref().and_then(|values| values.get(k)).copied().unwrap_or(0.0)
            };
            let all = || (0..=degree).flat_map(|i| (0..=degree).map(move |j| (i, j)));
            let largest =
                all().flat_map(|(i, j)| (0..width).map(move |k| (i, j, k))).fold(1.0_f64, |l, (i, j, k)| l.max(value(i, j, k).abs()));
            let coefficients = coefficients(degree, width, value);
            let mut sheet = Sheet { x, y, degree, width, coefficients, places: known.places };
            if sheet.tail() > tolerance * largest {
                continue;
            }
            if between.is_empty() {
                for share in BETWEEN {
                    let at = [x[0] + share[0] * (x[1] - x[0]), y[0] + share[1] * (y[1] - y[0])];
                    between.push((at, known.ask(at[0], at[1])?));
                }
            }
            sheet.places = known.places;
            let agrees = |(at, own): &([f64; 2], Vec<f64>)| {
                let found = sheet.at(at[0], at[1]);
                (0..width.max(own.len())).all(|k| {
                    let of = |list: &[f64]| list.get(k).copied().unwrap_or(0.0);
                    (of(&found) - of(own)).abs() <= tolerance * largest
                })
            };
            if between.iter().all(agrees) {
                return Some(sheet);
            }
        }
        None
    }

    /// The values at a place of the rectangle.
    pub fn at(&self, x: f64, y: f64) -> Vec<f64> {
        let (by_x, by_y) = (chebyshev(share(x, self.x), self.degree), chebyshev(share(y, self.y), self.degree));
        let mut sums = vec![0.0; self.width];
        for (e, c) in self.coefficients.chunks_exact(self.width.max(1)).enumerate() {
            let factor = by_x[e / (self.degree + 1)] * by_y[e % (self.degree + 1)];
            sums.iter_mut().zip(c).for_each(|(sum, c)| *sum += factor * c);
        }
        sums
    }

    /// The greatest |c| of each function.
    pub fn bounds(&self) -> Vec<f64> {
        let mut all = vec![0.0_f64; self.width];
        for c in self.coefficients.chunks_exact(self.width.max(1)) {
            all.iter_mut().zip(c).for_each(|(largest, c)| *largest = largest.max(c.abs()));
        }
        all
    }

    /// The greatest sum of last coefficients of a function.
    fn tail(&self) -> f64 {
        let late = |e: usize| {
            let (i, j) = (e / (self.degree + 1), e % (self.degree + 1));
            i + LAST > self.degree || j + LAST > self.degree
        };
        let of = |k: usize| {
            let terms = self.coefficients.chunks_exact(self.width).enumerate().filter(|(e, _)| late(*e));
            terms.map(|(_, c)| c[k].abs()).sum::<f64>()
        };
        (0..self.width).map(of).fold(0.0, f64::max)
    }
}

/// T_0 ... T_n.
fn chebyshev(xi: f64, degree: usize) -> Vec<f64> {
    let mut all = vec![1.0; degree + 1];
    all[1] = xi;
    for k in 2..=degree {
        all[k] = 2.0 * xi * all[k - 1] - all[k - 2];
    }
    all
}

/// Coefficients of values at the nodes, in x and then in y: c_j = (2/n) Σ'' f_k cos(πjk/n), the first and the last terms halved, c_0 and c_n too.
fn coefficients(degree: usize, width: usize, value: impl Fn(usize, usize, usize) -> f64) -> Vec<f64> {
    let count = degree + 1;
    let halved = |k: usize| if k == 0 || k == degree { 0.5 } else { 1.0 };
    let weight = |j: usize, k: usize| {
        let turn = (j * k) % (2 * degree);
        2.0 / degree as f64 * halved(j) * halved(k) * elementary::cos(PI * turn as f64 / degree as f64)
    };
    let weights: Vec<f64> = (0..count * count).map(|e| weight(e / count, e % count)).collect();
    let mut by_x = vec![0.0; count * count * width];
    let mut both = by_x.clone();
    for (i, l, k) in (0..count).flat_map(|i| (0..count).flat_map(move |l| (0..width).map(move |k| (i, l, k)))) {
        by_x[(i * count + l) * width + k] = (0..count).map(|m| weights[i * count + m] * value(m, l, k)).sum();
    }
    for (i, j, k) in (0..count).flat_map(|i| (0..count).flat_map(move |j| (0..width).map(move |k| (i, j, k)))) {
        both[(i * count + j) * width + k] = (0..count).map(|l| weights[j * count + l] * by_x[(i * count + l) * width + k]).sum();
    }
    both
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is asked of the sheets here.
    const TOLERANCE: f64 = 1e-12;

    /// Polynomials of the first degree tried take its nodes, and those between them; one place gives a function less.
    #[test]
    fn polynomials_are_themselves() {
        let f = |x: f64, y: f64| Some(if x == 0.0 { vec![x + y] } else { vec![x + y, x * y * y] });
        let sheet = Sheet::of([0.0, 3.0], [2.0, 5.0], TOLERANCE, f).unwrap();
        assert_eq!((sheet.places, sheet.width), (25 + BETWEEN.len(), 2));
        let found = sheet.at(0.7, 4.1);
        // some ten roundings of values about 75
        assert!((found[0] - 4.8).abs() < 1e-13 && (found[1] - 0.7 * 4.1 * 4.1).abs() < 1e-12, "{found:?}");
    }

    /// 1/x over 60 ... 150: the pole of its continuation lies at ξ = -7/3, so that coefficients fall as 4.44⁻ⁿ; a degree of 32 holds it.
    #[test]
    fn a_period_over_a_frequency_is_smooth_enough() {
        let sheet = Sheet::of([60.0, 150.0], [0.0, 1.0], TOLERANCE, |x, y| Some(vec![100.0 / x, y / (x * x)])).unwrap();
        for x in [60.0, 77.7, 150.0] {
            assert!((sheet.at(x, 0.3)[0] - 100.0 / x).abs() < TOLERANCE * 10.0, "{x}");
        }
    }

    #[test]
    fn kinks_and_places_without_a_value_have_no_sheet() {
        assert_eq!(Sheet::of([0.0, 1.0], [0.0, 1.0], TOLERANCE, |x, y| Some(vec![(x - 0.371).abs() + y])), None);
        assert_eq!(Sheet::of([0.0, 1.0], [0.0, 1.0], TOLERANCE, |x, _| (x < 0.9).then(|| vec![x])), None);
        assert_eq!(Sheet::of([0.0, 1.0], [0.0, 1.0], TOLERANCE, |x, _| Some(vec![1.0 / x])), None);
    }
}
