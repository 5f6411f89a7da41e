//! What the diagram of Ince and Strutt costs: 500 times 500 traces of Hill's equation by polynomials on patches, and what one trace costs by itself.
//!
//! `cargo run --release -p strutt-analysis --example diagram` prints for each equation the least time of some runs, the solutions that were made, the error as it is estimated and as it is found at places of
//! another grid, and the time of a trace by itself. Target: at most 0.5 s with an error of at most 1e-10.

use algebra::hill::Hill;
use analysis::studies::stability::{Diagram, Equations, Family};
use std::f64::consts::{PI, TAU};
use std::time::Instant;

/// Least time of so many runs counts.
const RUNS: usize = 3;
const POINTS: usize = 500;
/// Places of the other grid, in each parameter.
const CHECKED: usize = 37;

fn main() {
    println!("{:>34} {:>9} {:>9} {:>10} {:>10} {:>12}", "equation", "s", "solutions", "said", "found", "one, µs");
    let mathieu = Hill { period: PI, mean: 0.0, waves: vec![[-2.0, 0.0]] };
    row("Mathieu, a -5...20, q 0...10", &mathieu, 0.0, [[-5.0, 20.0], [0.0, 10.0]]);
    row("Mathieu, a -10...60, q 0...40", &mathieu, 0.0, [[-10.0, 60.0], [0.0, 40.0]]);
    row("damped, h = 0.1", &mathieu, 0.1, [[-5.0, 20.0], [0.0, 10.0]]);
    let three = Hill { period: TAU, mean: 0.0, waves: vec![[1.0, 0.0], [0.3, 0.4], [0.0, 0.2]] };
    row("three harmonics, a 0...8, b 0...4", &three, 0.0, [[0.0, 8.0], [0.0, 4.0]]);
}

fn row(name: &str, shape: &Hill, decay: f64, [a, b]: [[f64; 2]; 2]) {
    let line = |[low, high]: [f64; 2], count: usize| -> Vec<f64> {
        (0..count).map(|k| low + (high - low) * k as f64 / (count - 1) as f64).collect()
    };
    let (mut least, mut made) = (f64::INFINITY, None);
    for _ in 0..RUNS {
        let begin = Instant::now();
        let diagram = Diagram::of(Family::new(shape, decay), [a, b], [POINTS, POINTS]);
        let traces = diagram.traces(&line(a, POINTS), &line(b, POINTS));
        least = least.min(begin.elapsed().as_secs_f64());
        made = Some((diagram, traces));
    }
    let Some((diagram, _)) = made else { return };
    let (mut worst, begin) = (0.0_f64, Instant::now());
    let (xs, ys) = (line(a, CHECKED), line(b, CHECKED));
    let own: Vec<f64> = xs.iter().flat_map(|a| ys.iter().map(|b| diagram.equations.at(*a, *b).trace()[0])).collect();
    let one = begin.elapsed().as_secs_f64() / own.len() as f64;
    for ([found, _], own) in diagram.traces(&xs, &ys).iter().zip(&own) {
        worst = worst.max((found - own).abs() / own.abs().max(1.0));
    }
    println!("{name:>34} {least:>9.4} {:>9} {:>10.1e} {worst:>10.1e} {:>12.2}", diagram.values(), diagram.error(), 1e6 * one);
}
