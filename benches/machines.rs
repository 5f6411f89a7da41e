//! Whole motions after loading: a machine with connections, reactions and switches, and an oscillator with dry friction.
//!
//! `cargo bench -p strutt --bench machines` prints medians. Targets: crank-hoist, one cycle with all reactions and outputs, 2 ms; belt oscillator, 100 s, 5 ms.

use std::path::Path;
use std::time::Instant;
use strutt::pipeline::{self, Machine};
use strutt::{Source, Watch, plan};

/// Medians over this many runs.
const RUNS: usize = 101;

fn main() {
    // name, end, rows of the table: the 25 of the published one, or as many as a plot needs
    for (name, until, rows) in [("crank-hoist", 0.2568, 24), ("crank-hoist", 0.2568, 1000), ("belt-oscillator", 100.0, 1000)] {
        println!("{name:>16}  {until:>7} s  {:>5} rows  {:>8.3} ms", rows + 1, 1e3 * motion(name, until, rows));
    }
}

fn machine(name: &str) -> Machine {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gallery").join(name).join("model.toml");
    let source = Source::open(&path.to_string_lossy()).unwrap_or_else(|_| panic!("{name}"));
    pipeline::build(&source, &[], &mut Watch::default()).unwrap_or_else(|_| panic!("{name}"))
}

fn motion(name: &str, until: f64, rows: usize) -> f64 {
    let mut machine = machine(name);
    let times = (0..=rows).map(|k| until * k as f64 / rows as f64).collect();
    let wishes = plan::Wishes { until: Some(until), times: Some(mechanics::model::Times::At(times)), ..plan::Wishes::default() };
    let study = plan::simulation(&machine.model, &machine.equations, wishes).unwrap_or_else(|_| panic!("{name}"));
    let mut times: Vec<f64> = (0..RUNS)
        .map(|_| {
            let start = Instant::now();
            std::hint::black_box(pipeline::simulate(&mut machine, &study, &mut Watch::default()));
            start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[RUNS / 2]
}
