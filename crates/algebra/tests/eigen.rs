//! Eigenvalues against closed forms: chains, membranes, repeated and vanishing frequencies, free motions, massless coordinates.

use std::f64::consts::PI;

use algebra::eigen::{Options, general, lowest, symmetric};
use algebra::sparse::{Sparse, Triplets};
use algebra::trouble::{Defect, Trouble};

/// Closed forms of a few operations: units of the last place.
const ROUNDING: f64 = 1e-15;
/// A well-conditioned root: rounding times a condition of ten.
const WELL: f64 = 1e-14;
/// Repeated or neighbouring eigenvalues: rounding times the size of the matrix.
const CLUSTERED: f64 = 1e-13;
/// Dozens to hundreds of unknowns, and eigenvalues far below the largest.
const LARGE: f64 = 1e-12;
/// Products of shapes of a beam, and its deflections: rounding times the condition of its stiffness, some 1e4.
const ORTHOGONAL: f64 = 1e-11;
/// Residuals relative to the matrix, and what is thousands to billions of times smaller than the root or the entries beside it.
const RESIDUAL: f64 = 1e-9;
/// A rigid motion times a stiffness whose entries, up to 1e4, cancel.
const RIGID: f64 = 1e-8;
/// A defective double root keeps half the digits: √ε.
const DOUBLE: f64 = 1e-7;

/// Chain of n masses 1 with springs 1: fixed at both ends, or free at both.
fn chain(triplets: &mut Triplets, first: usize, n: usize, fixed: bool) {
    for i in 0..n {
        if fixed && (i == 0 || i == n - 1) {
            triplets.add(first + i, first + i, 1.0);
        }
        if i + 1 < n {
            triplets.add_element(&[first + i, first + i + 1], &[1.0, -1.0, -1.0, 1.0]);
        }
    }
}

fn chain_value(j: usize, n: usize) -> f64 {
    (2.0 * (j as f64 * PI / (2.0 * (n + 1) as f64)).sin()).powi(2)
}

fn unit(n: usize) -> Sparse {
    let mut m = Triplets::new(n);
    (0..n).for_each(|i| m.add(i, i, 1.0));
    Sparse::from_triplets(&m).unwrap()
}

fn close(a: f64, b: f64, relative: f64) {
    assert!((a - b).abs() <= relative * b.abs(), "{a} against {b}: {:e}", (a - b) / b);
}

#[test]
fn dense_chain_to_the_last_digits() {
    let n = 40;
    let mut k = Triplets::new(n);
    chain(&mut k, 0, n, true);
    let k = Sparse::from_triplets(&k).unwrap().to_dense();
    let modes = symmetric(n, &k, &unit(n).to_dense()).unwrap();
    (0..n).for_each(|j| close(modes.values[j], chain_value(j + 1, n), 2.0 * ROUNDING));
}

/// Hermite beam of unit E I, mass per length and length, clamped at one end, n elements, rotations in units of `radian`.
fn beam(n: usize, radian: f64) -> (Triplets, Triplets) {
    let l = 1.0 / n as f64;
    let (mut k, mut m) = (Triplets::new(2 * n + 2), Triplets::new(2 * n + 2));
    let t = [1.0, l * radian, 1.0, l * radian];
    let stiffness = [12.0, 6.0, -12.0, 6.0, 6.0, 4.0, -6.0, 2.0, -12.0, -6.0, 12.0, -6.0, 6.0, 2.0, -6.0, 4.0];
    let mass = [156.0, 22.0, 54.0, -13.0, 22.0, 4.0, 13.0, -3.0, 54.0, 13.0, 156.0, -22.0, -13.0, -3.0, -22.0, 4.0];
    let full = |a: [f64; 16], f: f64| -> Vec<f64> { (0..16).map(|e| a[e] * f * t[e / 4] * t[e % 4]).collect() };
    for e in 0..n {
        let places: Vec<usize> = (2 * e..2 * e + 4).collect();
        k.add_element(&places, &full(stiffness, l.powi(-3)));
        m.add_element(&places, &full(mass, l / 420.0));
    }
    (k, m)
}

/// Without the clamped node.
fn clamped(a: &Triplets) -> Sparse {
    let full = Sparse::from_triplets(a).unwrap();
    let n = full.size();
    let dense = full.to_dense();
    let rest: Vec<f64> = (2..n).flat_map(|i| dense[i * n + 2..(i + 1) * n].to_vec()).collect();
    Sparse::from_dense(n - 2, &rest).unwrap()
}

#[test]
fn units_do_not_cost_digits() {
    // rotations in milliseconds of arc against radians: the same frequencies
    let (k, m) = beam(12, 1.0);
    let (k2, m2) = beam(12, PI / 648_000_000.0);
    let (k, m, k2, m2) = (clamped(&k), clamped(&m), clamped(&k2), clamped(&m2));
    let a = symmetric(24, &k.to_dense(), &m.to_dense()).unwrap();
    let b = symmetric(24, &k2.to_dense(), &m2.to_dense()).unwrap();
    // the entries themselves are rounded differently, which the stiffness spreads by (highest / lowest)
    (0..24).for_each(|j| close(b.values[j], a.values[j], LARGE));
    // z, the first root of 1 + cos z cosh z = 0, to the fourth power; cubic elements are above it by (z/n)^4 / 720
    let exact = 1.875_104_068_711_961_f64.powi(4);
    close((a.values[0] / exact - 1.0) / (exact / (720.0 * 12_f64.powi(4))), 1.0, 0.01);
    let sparse = lowest(&k, &m, 6, Options::default()).unwrap();
    (0..6).for_each(|j| close(sparse.modes.values[j], a.values[j], LARGE));
}

#[test]
fn shapes_are_mass_normalised_and_orthogonal() {
    let (k, m) = beam(8, 1.0);
    let (k, m) = (clamped(&k), clamped(&m));
    let modes = symmetric(16, &k.to_dense(), &m.to_dense()).unwrap();
    for i in 0..16 {
        for j in 0..16 {
            let product: f64 = modes.shape(i).iter().zip(m.product(modes.shape(j))).map(|(a, b)| a * b).sum();
            let expected = f64::from(u8::from(i == j));
            assert!((product - expected).abs() < ORTHOGONAL, "{i} {j}: {product}");
        }
    }
}

#[test]
fn membrane_with_pairs() {
    // square membrane of 30 x 30 masses: all frequencies with j != k come twice
    let n = 30;
    let mut k = Triplets::new(n * n);
    for i in 0..n {
        for j in 0..n {
            k.add(i * n + j, i * n + j, 4.0);
            if i + 1 < n {
                k.add(i * n + j, (i + 1) * n + j, -1.0);
            }
            if j + 1 < n {
                k.add(i * n + j, i * n + j + 1, -1.0);
            }
        }
    }
    let k = Sparse::from_triplets(&k).unwrap();
    let mut exact: Vec<f64> = (0..n * n).map(|e| chain_value(e / n + 1, n) + chain_value(e % n + 1, n)).collect();
    exact.sort_by(f64::total_cmp);
    for (count, block) in [(1, 1), (2, 1), (13, 1), (13, 3), (20, 3), (20, 5)] {
        let found = lowest(&k, &unit(n * n), count, Options { block, ..Options::default() }).unwrap();
        (0..count).for_each(|j| close(found.modes.values[j], exact[j], CLUSTERED));
        assert!(found.residuals.iter().all(|r| *r < RESIDUAL), "{:?}", found.residuals);
    }
}

#[test]
fn seven_equal_chains_are_all_found() {
    let (n, copies) = (25, 7);
    let mut k = Triplets::new(n * copies);
    (0..copies).for_each(|c| chain(&mut k, c * n, n, true));
    let k = Sparse::from_triplets(&k).unwrap();
    for block in [1, 2, 3] {
        let found = lowest(&k, &unit(n * copies), 16, Options { block, ..Options::default() }).unwrap();
        (0..16).for_each(|j| close(found.modes.values[j], chain_value(j / copies + 1, n), CLUSTERED));
    }
}

#[test]
fn free_motions_have_no_frequency() {
    let n = 50;
    let mut k = Triplets::new(n);
    chain(&mut k, 0, n, false);
    let k = Sparse::from_triplets(&k).unwrap();
    let found = lowest(&k, &unit(n), 4, Options::default()).unwrap();
    assert_eq!(found.modes.values[0], 0.0);
    (1..4).for_each(|j| close(found.modes.values[j], (2.0 * (j as f64 * PI / (2.0 * n as f64)).sin()).powi(2), LARGE));
    let dense = symmetric(n, &k.to_dense(), &unit(n).to_dense()).unwrap();
    // zero up to rounding of the entries, squared by the refinement
    assert!(dense.values[0].abs() < 1e-28);
}

#[test]
fn massless_coordinates_have_no_mode() {
    // every second mass of a chain of 2 n + 1 springs is missing: springs in pairs of 1/2, n masses
    let n = 20;
    let mut k = Triplets::new(2 * n + 1);
    chain(&mut k, 0, 2 * n + 1, true);
    let mut m = Triplets::new(2 * n + 1);
    (0..n).for_each(|i| m.add(2 * i + 1, 2 * i + 1, 1.0));
    let (k, m) = (Sparse::from_triplets(&k).unwrap(), Sparse::from_triplets(&m).unwrap());
    let found = lowest(&k, &m, 5, Options::default()).unwrap();
    (0..5).for_each(|j| close(found.modes.values[j], 0.5 * chain_value(j + 1, n), CLUSTERED));
    // there are n modes, however many are asked for
    let all = lowest(&k, &m, 2 * n + 1, Options::default()).unwrap();
    assert_eq!(all.modes.values.len(), n);
    (0..n).for_each(|j| close(all.modes.values[j], 0.5 * chain_value(j + 1, n), LARGE));
    let trouble = symmetric(2 * n + 1, &k.to_dense(), &m.to_dense()).unwrap_err();
    assert!(matches!(trouble, Trouble::Massless(_)), "{trouble:?}");
}

#[test]
fn static_solution_and_free_motion() {
    let (k, _) = beam(10, 1.0);
    let k = clamped(&k);
    let mut load = vec![0.0; 20];
    load[18] = 1.0;
    let x = k.solve(&load).unwrap();
    close(x[18], 1.0 / 3.0, ORTHOGONAL);
    close(x[19], 0.5, ORTHOGONAL);
    // the free beam turns and moves: two motions, the first pivot found names one
    let free = Sparse::from_triplets(&beam(10, 1.0).0).unwrap();
    let Err(Trouble::Pivot(pivot)) = free.solve(&[0.0; 22]) else { panic!("a free beam has no static solution") };
    assert_eq!(pivot.defect, Defect::Singular);
    let rest = free.product(&pivot.motion);
    assert!(rest.iter().all(|r| r.abs() < RIGID), "{rest:?}");
    assert!(pivot.motion.iter().any(|v| v.abs() > 0.1));
    let negative = Sparse::from_dense(2, &[1.0, 2.0, 2.0, 1.0]).unwrap();
    let Err(Trouble::Pivot(pivot)) = negative.solve(&[0.0; 2]) else { panic!("indefinite") };
    assert_eq!(pivot.defect, Defect::Negative);
}

#[test]
fn damped_oscillator_has_a_conjugate_pair() {
    // q'' + 2 n q' + k^2 q = 0: -n +- i sqrt(k^2 - n^2); and a slow decay beside it
    let (n, k2) = (0.3, 4.0e6);
    let modes = general(3, &[0.0, 1.0, 0.0, -k2, -2.0 * n, 0.0, 0.0, 0.0, -1e-3]).unwrap();
    close(modes.values[0].re, -1e-3, ROUNDING);
    close(modes.values[1].re, -n, RESIDUAL);
    close(modes.values[1].im, (k2 - n * n).sqrt(), WELL);
    assert_eq!(modes.values[2], modes.values[1].conj());
    let x = modes.vector(1);
    let ratio = (x[1] / x[0]).re;
    assert!((ratio + n).abs() < RESIDUAL);
}

#[test]
fn slow_decay_beside_fast_oscillation_keeps_its_digits() {
    // triangular blocks: eigenvalues on the diagonal 1e-4 ... 1e8, coupled above; -3 +- 4 i in a block
    let n = 6;
    let mut a = vec![0.0; n * n];
    let diagonal = [-1e-4, -2.5, 0.0, 0.0, -1e5, -1e8];
    (0..n).for_each(|i| a[i * n + i] = diagonal[i]);
    (a[2 * n + 2], a[2 * n + 3], a[3 * n + 2], a[3 * n + 3]) = (-3.0, 4.0, -4.0, -3.0);
    (a[1], a[n + 2], a[2 * n + 4], a[3 * n + 5], a[5], a[n + 4]) = (7.0, -3.0, 20.0, 5e3, 1e3, 11.0);
    // hidden by a similarity with exact entries, x -> L x, L unit lower triangular with ones
    let mut hidden = a.clone();
    for i in 1..n {
        (0..n).for_each(|j| hidden[i * n + j] += hidden[(i - 1) * n + j]);
        (0..n).for_each(|k| hidden[k * n + i - 1] -= hidden[k * n + i]);
    }
    let modes = general(n, &hidden).unwrap();
    let expected = [(-1e-4, 0.0), (-2.5, 0.0), (-3.0, 4.0), (-3.0, -4.0), (-1e5, 0.0), (-1e8, 0.0)];
    for (found, expected) in modes.values.iter().zip(expected) {
        let size = f64::hypot(expected.0, expected.1);
        // the smallest feels the rounding of entries of 1e8 in the matrix itself
        let error = f64::hypot(found.re - expected.0, found.im - expected.1) / size;
        assert!(error < RESIDUAL, "{found:?} against {expected:?}: {error:e}");
    }
}

#[test]
fn defective_eigenvalue_is_left_alone() {
    // critical damping: q'' + 2 q' + q = 0
    let modes = general(2, &[0.0, 1.0, -1.0, -2.0]).unwrap();
    assert!(modes.values.iter().all(|z| (z.re + 1.0).abs() < DOUBLE && z.im.abs() < DOUBLE), "{:?}", modes.values);
}

#[test]
fn same_seed_same_bits() {
    let (k, m) = beam(60, 1.0);
    let (k, m) = (clamped(&k), clamped(&m));
    assert_eq!(lowest(&k, &m, 5, Options::default()).unwrap(), lowest(&k, &m, 5, Options::default()).unwrap());
}
