//! From a model file to a tape: chains of n pendulums with masses and lengths of their own (m_i, l_i separate symbols).
//!
//! `cargo bench -p strutt --bench derivation` prints the times and how they grow, with the sizes of what was built. A peer is timed on
//! the same machines by bench/peers.

use std::time::{Duration, Instant};
use strutt::chain;

/// Medians over this many runs, fewer for long ones.
const RUNS: usize = 15;

fn main() {
    println!("{:>5} {:>11} {:>11} {:>11} {:>9} {:>9} {:>14}", "n", "read", "derive", "lower", "nodes", "tape", "derive + lower");
    let mut last: Option<(usize, f64)> = None;
    for n in [2, 3, 5, 10, 20, 50, 100] {
        let text = chain::model(n);
        let runs = if n < 50 { RUNS } else { 3 };
        let samples: Vec<Sample> = (0..runs).map(|_| measure(&text)).collect();
        let median = |pick: fn(&Sample) -> Duration| {
            let mut list: Vec<Duration> = samples.iter().map(pick).collect();
            list.sort();
            list[list.len() / 2].as_secs_f64()
        };
        let (read, derive, lower) = (median(|s| s.read), median(|s| s.derive), median(|s| s.lower));
        let both = derive + lower;
        let growth = last.map_or(String::new(), |(m, t)| format!("  ~ n^{:.1}", (both / t).ln() / (n as f64 / m as f64).ln()));
        let ms = |t: f64| format!("{:.3} ms", 1e3 * t);
        let (nodes, tape) = (samples[0].nodes, samples[0].tape);
        println!("{n:>5} {:>11} {:>11} {:>11} {nodes:>9} {tape:>9} {:>14}{growth}", ms(read), ms(derive), ms(lower), ms(both));
        last = Some((n, both));
    }
}

struct Sample {
    read: Duration,
    derive: Duration,
    lower: Duration,
    nodes: usize,
    tape: usize,
}

fn measure(text: &str) -> Sample {
    let start = Instant::now();
    let reading = mechanics::read(text, "chain.toml", &[]).expect("the chain is a valid model");
    let read = start.elapsed();
    let start = Instant::now();
    let equations =
        mechanics::derive::derive_in(&reading.model, mechanics::derive::Detail::Equations).expect("a chain has inertia everywhere");
    let derive = start.elapsed();
    let start = Instant::now();
    let program = program::lower::equations(&equations).expect("a chain can be lowered");
    let lower = start.elapsed();
    Sample { read, derive, lower, nodes: equations.graph.len(), tape: program.dynamics.instructions().count() }
}
