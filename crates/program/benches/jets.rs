//! Cost of one Taylor expansion, of one interpretation, and of lowering.
//!
//! `cargo bench -p strutt-program` prints the table of nanoseconds per instruction and order first.

use program::{Bound, lower};
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

#[path = "../tests/common/mod.rs"]
mod common;

fn bound(n: usize) -> Bound {
    let program = Arc::new(lower::equations(&common::pendulum_chain(n)).expect("the chain lowers"));
    let values = program.values.clone();
    Bound::new(&program, &values).expect("the chain binds")
}

fn states(n: usize) -> Vec<f64> {
    (0..2 * n).map(|i| (i as f64 * 1.7).sin()).collect()
}

/// The same chain of rods as points with conditions: 2n coordinates, n tensions.
fn connected(n: usize) -> (Bound, Vec<f64>) {
    let program = Arc::new(lower::equations(&common::mechanisms::rod_chain(n)).expect("the rods lower"));
    let values = program.values.clone();
    let x = (0..n).flat_map(|i| [0.3, -0.4].map(|c| c * (i + 1) as f64)).chain((0..2 * n).map(|i| (i as f64).cos())).collect();
    (Bound::new(&program, &values).expect("the rods bind"), x)
}

fn main() {
    println!("{:>3} {:>6} {:>6} {:>12} {:>16} {:>10}", "n", "order", "steps", "us/expand", "ns/(step order)", "mults");
    for (n, order) in [(1, 20), (2, 20), (3, 14), (3, 20), (10, 20), (30, 20)] {
        let bound = bound(n);
        let (mut jets, x) = (bound.jets(order), states(n));
        jets.expand(0.0, &x, &[], order).expect("regular");
        let repeats = 200_000 / (n * n * n);
        let start = Instant::now();
        for _ in 0..repeats {
            jets.expand(0.0, black_box(&x), &[], order).expect("regular");
        }
        let micro = start.elapsed().as_secs_f64() * 1e6 / repeats as f64;
        let (mults, steps) = (0..order).fold((0, 0), |(m, _), k| (m + jets.work(k).0, jets.work(k).1));
        println!("{n:>3} {order:>6} {steps:>6} {micro:>12.3} {:>16.2} {mults:>10}", micro * 1e3 / (steps * order) as f64);
    }
    divan::main();
}

#[divan::bench(args = [1, 2, 3, 10])]
fn expand_20(bencher: divan::Bencher, n: usize) {
    let bound = bound(n);
    let (mut jets, x) = (bound.jets(20), states(n));
    bencher.bench_local(|| jets.expand(0.0, black_box(&x), &[], 20));
}

#[divan::bench(args = [1, 3, 5, 10])]
fn expand_20_with_reactions(bencher: divan::Bencher, n: usize) {
    let (bound, x) = connected(n);
    let mut jets = bound.jets(20);
    bencher.bench_local(|| jets.expand(0.0, black_box(&x), &[], 20));
}

#[divan::bench(args = [1, 3, 5, 10])]
fn interpret_with_reactions(bencher: divan::Bencher, n: usize) {
    let (mut bound, x) = connected(n);
    bencher.bench_local(|| bound.rates(0.0, black_box(&x), &[]).map(|r| r[0]));
}

#[divan::bench(args = [1, 3, 10])]
fn interpret(bencher: divan::Bencher, n: usize) {
    let (mut bound, x) = (bound(n), states(n));
    bencher.bench_local(|| bound.rates(0.0, black_box(&x), &[]).map(|r| r[0]));
}

#[divan::bench(args = [3, 10, 30, 100], sample_count = 10)]
fn lower_chain(bencher: divan::Bencher, n: usize) {
    let equations = common::pendulum_chain(n);
    bencher.bench_local(|| lower::equations(black_box(&equations)));
}
