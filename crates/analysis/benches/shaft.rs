//! Whole 30 s run of card P3 at tolerance 1e-9, by order: `cargo bench -p strutt-analysis`.

#[path = "../tests/common/shaft.rs"]
mod shaft;

use analysis::integrate::taylor::{Flow, Options};
use analysis::studies::simulate::{Grid, Simulate, simulate};
use std::time::Instant;

/// Shortest of several runs, ms: what the machine needs when nobody disturbs it.
fn shortest(mut run: impl FnMut()) -> f64 {
    let once = |_| {
        let clock = Instant::now();
        run();
        clock.elapsed().as_secs_f64() * 1e3
    };
    (0..7).map(once).fold(f64::INFINITY, f64::min)
}

fn main() {
    let mut machine = shaft::shaft(0.01);
    let start = machine.start().expect("the start is regular");
    for tolerance in [1e-6, 1e-9, 1e-12, 1e-14] {
        for order in [None, Some(10), Some(12), Some(14), Some(16), Some(18), Some(20), Some(22), Some(24), Some(26), Some(30)] {
            let mut line = String::new();
            let ms = shortest(|| {
                let options = Options { tolerance, order, span: 30.0, ..Options::default() };
                let mut flow = Flow::start(&mut machine, 0.0, &start, &options).expect("the start is regular");
                while !flow.reached(30.0) {
                    flow.advance(30.0).expect("the motion is regular");
                }
                let (steps, rejected) = (flow.work().steps, flow.work().rejected);
                line = format!("{steps:>6} steps, phi {:.9}, rejected {rejected}", flow.state()[2]);
            });
            println!("{tolerance:e} order {:>2}: {ms:7.2} ms, {line}", order.map_or("-".to_owned(), |p| p.to_string()));
        }
    }
    let ms = shortest(|| {
        let options = Simulate { grid: Grid::Auto, tolerance: 1e-9, ..Simulate::until(30.0) };
        assert!(simulate(&mut machine, &start, options).fault.is_none());
    });
    println!("study simulate, 1001 rows, audits: {ms:.2} ms");
}
