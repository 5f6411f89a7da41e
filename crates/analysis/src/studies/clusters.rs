//! Roots that coincide but for rounding, with one shape.
//!
//! A root of multiplicity m with one shape alone (defective) comes out of an eigensolver as m roots on a circle about it, of radius
//!
//! ```text
//! ρ ~ |λ| (ε |λ|max/|λ|)^(1/m)         1e-8 for two, 1e-4 for four
//! ```
//!
//! Each of them is wrong by ρ, and so are its growth and its frequency; their mean is right to the rounding itself, for terms of ρ, ρ², ... ρ^(m-1) cancel
//! on the circle. The same holds for the shapes. Newton's method ([`super::polish`]) tells roots apart where the matrices do.
//!
//! *Source*: J. H. Wilkinson, The Algebraic Eigenvalue Problem (1965), ch. 2, 23; F. Chatelin, Eigenvalues of Matrices (SIAM 2012), 4.3 (arithmetic means of clusters).

use super::shapes::{Complex, divided};
use algebra::elementary;

/// What an eigensolver may be off by, in units of the last place of its fastest root: some for each of its sweeps.
const OFF: f64 = 1e3 * f64::EPSILON;
/// Sine of the angle between two shapes that are one but for what their roots are apart.
const ALIKE: f64 = 0.05;
/// Roots whose distance beside their size is larger are no cluster, whatever its size.
const WIDE: f64 = 0.03;

/// One root for several.
#[derive(Clone, Debug)]
pub(super) struct Cluster {
    /// Places in the list.
    pub(super) members: Vec<usize>,
    pub(super) root: Complex,
    pub(super) shape: Vec<Complex>,
}

/// All clusters among roots with shapes, of which `fastest` is the largest.
pub(super) fn clusters(roots: &[Complex], shapes: &[Vec<Complex>], fastest: f64) -> Vec<Cluster> {
    let mut found: Vec<Cluster> = Vec::new();
    for i in 0..roots.len() {
        if found.iter().any(|c| c.members.contains(&i)) {
            continue;
        }
        let mut near: Vec<usize> = (0..roots.len()).filter(|j| sine(&shapes[i], &shapes[*j]) <= ALIKE).collect();
        near.sort_by(|a, b| apart(roots[i], roots[*a]).total_cmp(&apart(roots[i], roots[*b])));
        let largest = (2..=near.len()).rev().find(|m| is_one(roots, &near[..*m], fastest));
        if let Some(m) = largest {
            let mut members = near[..m].to_vec();
            members.sort_unstable();
            found.push(Cluster { root: mean(roots, &members), shape: shape(shapes, &members), members });
        }
    }
    found
}

fn is_one(roots: &[Complex], members: &[usize], fastest: f64) -> bool {
    let middle = mean(roots, members);
    let size = elementary::hypot(middle.0, middle.1);
    let radius = members.iter().map(|j| apart(roots[*j], middle)).fold(0.0, f64::max) / size;
    radius <= WIDE && elementary::powi(radius, members.len() as i32) <= OFF * fastest / size
}

fn apart(a: Complex, b: Complex) -> f64 {
    elementary::hypot(a.0 - b.0, a.1 - b.1)
}

/// The mean; real where the members are conjugate.
fn mean(roots: &[Complex], members: &[usize]) -> Complex {
    let count = members.len() as f64;
    let sum = members.iter().fold((0.0, 0.0), |(re, im), j| (re + roots[*j].0, im + roots[*j].1));
    let (re, im) = (sum.0 / count, sum.1 / count);
    (re, if im.abs() <= f64::EPSILON * re.abs() { 0.0 } else { im })
}

/// The mean of the shapes, each with 1 at the largest entry of the first.
fn shape(shapes: &[Vec<Complex>], members: &[usize]) -> Vec<Complex> {
    let first = &shapes[members[0]];
    let size = |z: &Complex| elementary::hypot(z.0, z.1);
    let peak = (0..first.len()).max_by(|a, b| size(&first[*a]).total_cmp(&size(&first[*b]))).unwrap_or(0);
    let mut sum = vec![(0.0, 0.0); first.len()];
    for j in members {
        let by = shapes[*j][peak];
        sum.iter_mut().zip(&shapes[*j]).for_each(|(s, z)| {
            let z = divided(*z, by);
            *s = (s.0 + z.0, s.1 + z.1);
        });
    }
    let count = members.len() as f64;
    sum.into_iter().map(|z| (z.0 / count, z.1 / count)).collect()
}

/// Sine of the angle between two shapes.
pub(super) fn sine(x: &[Complex], y: &[Complex]) -> f64 {
    let square = |x: &[Complex]| x.iter().map(|z| z.0 * z.0 + z.1 * z.1).sum::<f64>();
    // xᴴ y
    let across = x.iter().zip(y).fold((0.0, 0.0), |(re, im), (x, y)| (re + x.0 * y.0 + x.1 * y.1, im + x.0 * y.1 - x.1 * y.0));
    let cosine = (across.0 * across.0 + across.1 * across.1) / (square(x) * square(y));
    (1.0 - cosine).max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::clusters;

    /// Four roots on a circle about -1 with one shape, and a pair with two.
    #[test]
    fn a_circle_is_its_middle_and_equal_roots_with_two_shapes_stay() {
        let off = 1.2e-4;
        let roots = [(-1.0 + off, 0.0), (-1.0, off), (-1.0, -off), (-1.0 - off, 0.0), (-2.0, 3.0), (-2.0, 3.0)];
        let one = |by: (f64, f64)| vec![(1.0, 0.0), by];
        let shapes = [one((off, 0.0)), one((0.0, off)), one((0.0, -off)), one((-off, 0.0)), one((0.0, 0.0)), one((2.0, 0.0))];
        let found = clusters(&roots, &shapes, 4.0);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].members, [0, 1, 2, 3]);
        // means of numbers of the size of 1
        assert!((found[0].root.0 + 1.0).abs() < 4.0 * f64::EPSILON && found[0].root.1 == 0.0);
        assert!(found[0].shape[1].0.abs() < 4.0 * f64::EPSILON);
    }
}
