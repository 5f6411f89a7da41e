//! The 20 lowest modes of a plane frame of `bays` x `bays` bays (Euler-Bernoulli rods, consistent mass, columns clamped at the ground):
//! times, counters and peak memory as JSON, for bench/peers. The same structure is built there for scipy.
//!
//! `cargo run --release -p strutt-algebra --example frame [bays] [modes]`

use std::time::Instant;

use algebra::eigen::{Options, Sturm, lowest};
use algebra::sparse::{Sparse, Triplets};

const MODULUS: f64 = 2.1e11;
const AREA: f64 = 0.01;
const INERTIA: f64 = 1e-4;
const DENSITY: f64 = 7850.0;
const SPAN: f64 = 6.0;
const HEIGHT: f64 = 3.0;

/// Stiffness and mass of a rod of length l along x.
fn rod(l: f64) -> ([f64; 36], [f64; 36]) {
    let (ea, ei, mu) = (MODULUS * AREA / l, MODULUS * INERTIA / l.powi(3), DENSITY * AREA * l / 420.0);
    let bend = |k: [f64; 16], axial: [f64; 4]| {
        let (places, mut a) = ([1, 2, 4, 5], [0.0; 36]);
        (0..16).for_each(|e| a[places[e / 4] * 6 + places[e % 4]] = k[e]);
        (0..4).for_each(|e| a[e / 2 * 18 + e % 2 * 3] = axial[e]);
        a
    };
    let k = [12.0, 6.0 * l, -12.0, 6.0 * l, 6.0 * l, 4.0 * l * l, -6.0 * l, 2.0 * l * l, -12.0, -6.0 * l, 12.0, -6.0 * l];
    let k = [k.as_slice(), &[6.0 * l, 2.0 * l * l, -6.0 * l, 4.0 * l * l]].concat();
    let m = [156.0, 22.0 * l, 54.0, -13.0 * l, 22.0 * l, 4.0 * l * l, 13.0 * l, -3.0 * l * l, 54.0, 13.0 * l, 156.0, -22.0 * l];
    let m = [m.as_slice(), &[-13.0 * l, -3.0 * l * l, -22.0 * l, 4.0 * l * l]].concat();
    let stiffness = bend(std::array::from_fn(|e| ei * k[e]), [ea, -ea, -ea, ea]);
    let mass = bend(std::array::from_fn(|e| mu * m[e]), [140.0, 70.0, 70.0, 140.0].map(|v| mu * v));
    (stiffness, mass)
}

/// Turned by a right angle: (x, y) of the rod is (y, -x) of the frame.
fn upright(a: &[f64; 36]) -> [f64; 36] {
    let place = [1, 0, 2, 4, 3, 5];
    let sign = [1.0, -1.0, 1.0, 1.0, -1.0, 1.0];
    let mut out = [0.0; 36];
    for i in 0..6 {
        (0..6).for_each(|j| out[place[i] * 6 + place[j]] = sign[i] * sign[j] * a[i * 6 + j]);
    }
    out
}

fn frame(bays: usize) -> (Sparse, Sparse) {
    let n = 3 * bays * (bays + 1);
    let (mut k, mut m) = (Triplets::new(n), Triplets::new(n));
    let beam = rod(SPAN);
    let column = rod(HEIGHT);
    let column = (upright(&column.0), upright(&column.1));
    let node = |level: usize, line: usize| 3 * ((level - 1) * (bays + 1) + line);
    for level in 1..=bays {
        for line in 0..=bays {
            let top = node(level, line);
            if level == 1 {
                // the lower end is clamped: only the upper one moves
                for (a, matrix) in [(&mut k, &column.0), (&mut m, &column.1)] {
                    let own: Vec<f64> = (0..9).map(|e| matrix[(3 + e / 3) * 6 + 3 + e % 3]).collect();
                    a.add_element(&[top, top + 1, top + 2], &own);
                }
            } else {
                let low = node(level - 1, line);
                let places = [low, low + 1, low + 2, top, top + 1, top + 2];
                k.add_element(&places, &column.0);
                m.add_element(&places, &column.1);
            }
            if line < bays {
                let right = node(level, line + 1);
                let places = [top, top + 1, top + 2, right, right + 1, right + 2];
                k.add_element(&places, &beam.0);
                m.add_element(&places, &beam.1);
            }
        }
    }
    (Sparse::from_triplets(&k).expect("finite"), Sparse::from_triplets(&m).expect("finite"))
}

/// Peak resident memory in megabytes, where the system tells it.
fn peak() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|l| l.starts_with("VmHWM")).unwrap_or_default();
    line.split_whitespace().nth(1).and_then(|kb| kb.parse::<f64>().ok()).unwrap_or(f64::NAN) / 1024.0
}

fn main() {
    let number = |k: usize, usual: usize| std::env::args().nth(k).and_then(|a| a.parse().ok()).unwrap_or(usual);
    let (bays, count) = (number(1, 180), number(2, 20));
    let mut options = Options { block: number(3, Options::default().block), ..Options::default() };
    if number(4, 1) == 0 {
        options.sturm = Sturm::Skipped;
    }
    let began = Instant::now();
    let (k, m) = frame(bays);
    let assembly = began.elapsed().as_secs_f64();
    let began = Instant::now();
    let found = match lowest(&k, &m, count, options) {
        Ok(found) => found,
        Err(fault) => {
            eprintln!("{fault}");
            std::process::exit(1)
        }
    };
    let solution = began.elapsed().as_secs_f64();
    let worst = found.residuals.iter().fold(0.0_f64, |a, b| a.max(*b));
    let c = found.counters;
    let values: Vec<String> = found.modes.values.iter().map(|v| format!("{v:.15e}")).collect();
    println!(
        "{{\"size\": {}, \"assembly\": {assembly:.4}, \"solution\": {solution:.4}, \"memory_mb\": {:.0}, \"residual\": {worst:.1e}, \
         \"basis\": {}, \"solves\": {}, \"factorisations\": {}, \"factor\": {}, \"counted\": {}, \"values\": [{}]}}",
        k.size(),
        peak(),
        c.basis,
        c.solves,
        c.factorisations,
        c.factor,
        c.counted.map_or("null".to_string(), |n| n.to_string()),
        values.join(", ")
    );
}
