//! Whole 30 s run of card P3 at tolerance 1e-9, by order: `cargo bench -p strutt-analysis`.

#[path = "../tests/common/shaft.rs"]
mod shaft;

use analysis::studies::simulate::{Grid, Simulate, simulate};
use analysis::taylor::{Flow, Options};
use std::time::Instant;

fn main() {
    let mut machine = shaft::shaft(0.01);
    let start = machine.start().expect("the start is regular");
    for tolerance in [1e-9, 1e-12] {
        for order in [None, Some(12), Some(14), Some(16), Some(18), Some(20), Some(22), Some(26), Some(30)] {
            let clock = Instant::now();
            let options = Options { tolerance, order, span: 30.0 };
            let mut flow = Flow::start(&mut machine, 0.0, &start, &options).expect("the start is regular");
            while !flow.reached(30.0) {
                flow.advance(30.0).expect("the motion is regular");
            }
            let ms = clock.elapsed().as_secs_f64() * 1e3;
            println!(
                "{tolerance:e} order {:>2}: {ms:7.2} ms, {:>6} steps, phi {:.9}, rejected {}",
                flow.order(),
                flow.work().steps,
                flow.state()[2],
                flow.work().rejected
            );
        }
    }
    let clock = Instant::now();
    let options = Simulate { grid: Grid::Auto, tolerance: 1e-9, ..Simulate::until(30.0) };
    let outcome = simulate(&mut machine, &start, options);
    println!("study simulate, 1001 rows, audits: {:.2} ms {:?}", clock.elapsed().as_secs_f64() * 1e3, outcome.fault);
}
