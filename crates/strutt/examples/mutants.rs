//! Spoilt gallery files against every command: no panic, no deafness to an interruption, no number that is none with exit code 0.
//!
//! `cargo run --release -p strutt --example mutants -- --count 20000 --seed 1`. Same seed, same mutants. What is found is kept in `target/mutants/`, one
//! folder a finding: the model, the command, what it said.

#[path = "mutants/mutate.rs"]
mod mutate;
#[path = "mutants/trial.rs"]
mod trial;

use mutate::Dice;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::{AtomicU64, Ordering};
use strutt::gallery;
use trial::{Trial, Verdict};

fn main() -> ExitCode {
    let (count, seed, binary) = (number("--count", 1000), number("--seed", 1), binary());
    let folder = PathBuf::from("target/mutants");
    let next = AtomicU64::new(0);
    let found = AtomicU64::new(0);
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= count {
                        break;
                    }
                    if let Some(what) = one(&binary, &folder, seed, index) {
                        found.fetch_add(1, Ordering::Relaxed);
                        println!("{what}");
                    }
                    if index > 0 && index.is_multiple_of(500) {
                        eprintln!("{index} of {count}, found {}", found.load(Ordering::Relaxed));
                    }
                }
            });
        }
    });
    let found = found.into_inner();
    println!("{count} mutants of seed {seed}: {found} findings");
    ExitCode::from(u8::from(found > 0))
}

/// Runs one mutant; what is wrong with it, if anything.
fn one(binary: &std::path::Path, folder: &std::path::Path, seed: u64, index: u64) -> Option<String> {
    let mut dice = Dice::of(seed, index);
    let example = dice.pick(gallery::EXAMPLES);
    let text = mutate::mutate(example.text, &mut dice);
    let trial = Trial { binary, folder: folder.join(format!("{seed}-{index}")), text: &text, arguments: trial::command(&mut dice) };
    match trial.run() {
        Verdict::Well => None,
        Verdict::Bad(what) => Some(format!("{}: {} {}: {what}", trial.folder.display(), example.name, trial.arguments.join(" "))),
    }
}

fn number(key: &str, default: u64) -> u64 {
    argument(key).and_then(|text| text.parse().ok()).unwrap_or(default)
}

fn argument(key: &str) -> Option<String> {
    let arguments: Vec<String> = std::env::args().collect();
    arguments.iter().position(|a| a == key).and_then(|i| arguments.get(i + 1).cloned())
}

/// `--binary`, or the one beside this program.
fn binary() -> PathBuf {
    argument("--binary").map_or_else(
        || {
            let own = std::env::current_exe().unwrap_or_default();
            own.ancestors().nth(2).map(|folder| folder.join("strutt")).unwrap_or_default()
        },
        PathBuf::from,
    )
}
