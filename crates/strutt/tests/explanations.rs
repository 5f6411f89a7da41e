//! The examples of `strutt explain` raise what they explain.

use strutt::{Failure, Source, Watch, explain, pipeline};

#[test]
fn every_example_raises_its_code() {
    for e in explain::all().into_iter().filter(|e| !e.wrong.is_empty()) {
        let source = Source::new("example.toml", e.wrong);
        let codes: Vec<&str> = match pipeline::build(&source, &[], &mut Watch::default()) {
            Ok(machine) => machine.warnings.iter().map(|d| d.code).collect(),
            Err(Failure::Findings { diagnostics, .. }) => diagnostics.iter().map(|d| d.code).collect(),
            Err(Failure::Trouble(t)) => vec![t.code],
            Err(_) => Vec::new(),
        };
        assert!(codes.contains(&e.code), "{}: {codes:?}\n{}", e.code, e.wrong);
    }
}
