//! The same machine gives the same bytes on every machine: motions of the gallery with all their digits against stored ones, by both methods of integration.
//!
//! `UPDATE_BITS=1 cargo test -p strutt --test all same_bits` writes them anew, for a change that is meant to change the last digits.

use crate::common;

use common::{gallery, stdout, strutt};
use std::path::Path;

/// Machine, end and distance of the rows: impacts, dry friction, ropes, connections, rotation in space, chaos.
const MOTIONS: [(&str, &str, &str); 10] = [
    ("pendulum-on-shaft", "8", "1"),
    ("belt-oscillator", "20", "2"),
    ("stick-slip", "10", "1"),
    ("double-pendulum", "20", "2"),
    ("crank-hoist", "0.25", "0.05"),
    ("scotch-yoke-dry", "2", "0.5"),
    ("top", "5", "1"),
    ("spherical-pendulum", "5", "1"),
    ("rattling", "5", "1"),
    ("thread-pendulum", "3", "0.6"),
];

/// The same by the implicit method: relaxation oscillations, connections.
const STIFF: [(&str, &str, &str); 2] = [("van-der-pol", "20", "2"), ("crank-hoist", "0.1", "0.02")];

#[test]
fn motions_have_their_stored_bytes() {
    hold(&MOTIONS, "auto");
}

#[test]
fn stiff_motions_have_their_stored_bytes() {
    hold(&STIFF, "stiff");
}

fn hold(motions: &[(&str, &str, &str)], method: &str) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bits");
    let mut others = Vec::new();
    for (name, until, every) in motions {
        let motion =
            stdout(strutt().args(["simulate", &gallery(name), "--until", until, "--every", every, "--method", method, "--csv", "-q"]));
        let path = folder.join(if method == "stiff" { format!("{name}-stiff.csv") } else { format!("{name}.csv") });
        if std::env::var_os("UPDATE_BITS").is_some() {
            std::fs::write(&path, &motion).unwrap();
        }
        let stored = std::fs::read_to_string(&path).unwrap_or_default();
        if let Some((was, is)) = stored.lines().zip(motion.lines()).find(|(a, b)| a != b) {
            others.push(format!("{name}:\n  stored {was}\n  now    {is}"));
        }
        assert_eq!(stored.lines().count(), motion.lines().count(), "{name}");
    }
    assert!(others.is_empty(), "{}", others.join("\n"));
}
