//! What it costs that every step is checked over its whole length: each motion of the gallery with the check and without it.
//!
//! `cargo bench -p strutt --bench checked` prints for every machine the time of the bare integration (no outputs, no audits), its steps, those taken
//! back, those shortened and the expansions, with the check and without; then the sums. Target: at most 10 % more time in all.

use analysis::integrate::taylor::{Check, Flow, Options, Work};
use std::path::{Path, PathBuf};
use std::time::Instant;
use studies::Watch;
use studies::pipeline::{self, Machine};
use studies::simulate;

/// Least time of so many runs counts.
const RUNS: usize = 15;
/// A motion is repeated until a run takes so long, s.
const LEAST: f64 = 5e-3;

fn main() {
    println!("{:>24} {:>9} {:>9} {:>6}   work with the check / without", "machine", "ms", "ms bare", "ratio");
    let mut whole = [0.0; 2];
    for path in machines() {
        let Some(mut motion) = Motion::of(&path) else { continue };
        let (times, works) = motion.measure();
        println!(
            "{:>24} {:>9.3} {:>9.3} {:>6.3}   {} / {}",
            motion.name,
            times[0],
            times[1],
            times[0] / times[1],
            line(&works[0]),
            line(&works[1])
        );
        whole = [whole[0] + times[0], whole[1] + times[1]];
    }
    println!("{:>24} {:>9.3} {:>9.3} {:>6.3}", "all", whole[0], whole[1], whole[0] / whole[1]);
}

/// Models of the gallery by name.
fn machines() -> Vec<PathBuf> {
    let gallery = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gallery");
    let folders = std::fs::read_dir(gallery).into_iter().flatten().flatten();
    let mut paths: Vec<PathBuf> = folders.map(|entry| entry.path().join("model.toml")).filter(|path| path.exists()).collect();
    paths.sort();
    paths
}

fn line(work: &Work) -> String {
    format!("{} steps, {} back, {} short, {} expansions", work.steps, work.rejected, work.shortened, work.expansions + work.probes)
}

/// The first motion that a file asks for.
struct Motion {
    name: String,
    machine: Machine,
    start: Vec<f64>,
    until: f64,
    tolerance: f64,
}

impl Motion {
    fn of(path: &Path) -> Option<Motion> {
        let name = path.parent()?.file_name()?.to_string_lossy().into_owned();
        let source = strutt::source::open(&path.to_string_lossy()).ok()?;
        let machine = pipeline::build(&source, &[], &mut Watch::default()).ok()?;
        let study = simulate::with_values(&machine, &[]).ok()?;
        let start = machine.system.start().ok()?;
        Some(Motion { name, start, until: study.until, tolerance: study.tolerance, machine })
    }

    /// Shortest times, ms, and work, with the check and without; the two take turns, so that a disturbance of the computer meets both.
    fn measure(&mut self) -> ([f64; 2], [Work; 2]) {
        let (mut times, mut works) = ([f64::INFINITY; 2], [Work::default(), Work::default()]);
        for _ in 0..RUNS {
            for (k, check) in [Check::Whole, Check::Ends].into_iter().enumerate() {
                let (clock, mut repeats) = (Instant::now(), 0);
                while repeats == 0 || clock.elapsed().as_secs_f64() < LEAST {
                    works[k] = self.integrate(check);
                    repeats += 1;
                }
                times[k] = times[k].min(1e3 * clock.elapsed().as_secs_f64() / f64::from(repeats));
            }
        }
        (times, works)
    }

    fn integrate(&mut self, check: Check) -> Work {
        let options = Options { tolerance: self.tolerance, span: self.until, check, ..Options::default() };
        let Ok(mut flow) = Flow::start(&mut self.machine.system, 0.0, &self.start, &options) else { return Work::default() };
        // a motion that ends early ends early both times
        while !flow.reached(self.until) && flow.advance(self.until).is_ok() {}
        flow.work().clone()
    }
}
