//! Spoilt model files: whatever the text, the library answers with findings or a machine, never with a crash.

use proptest::prelude::*;
use strutt::diagnostics::{self, Style};
use strutt::gallery;
use studies::{Failure, Source, Watch, pipeline};

/// Pieces that users and fuzzers put into files.
const PIECES: &[&str] = &[
    "",
    "\"",
    "[",
    "]",
    "{",
    "}",
    "=",
    "'",
    "''",
    "0",
    "-",
    "1e999",
    "1e-999",
    "nan",
    "inf",
    "kg",
    "м",
    "φ",
    "phi",
    "phi''",
    "(",
    ")",
    "/0",
    "^",
    "^1000",
    "if(",
    "sin(",
    "\n",
    "#",
    ".",
    ",",
    "\\",
    "\u{0}",
    "\u{feff}",
    "🙂",
    "[[study]]\n",
    "sqrt(-1)",
    "1 [m]",
    "on = \"b\"\n",
];

/// Cuts, copies and inserts.
fn spoil(text: &str, changes: &[(usize, usize, usize)]) -> String {
    let mut chars: Vec<char> = text.chars().collect();
    for &(at, cut, piece) in changes {
        let at = at % (chars.len() + 1);
        let end = (at + cut).min(chars.len());
        chars.splice(at..end, PIECES[piece % PIECES.len()].chars());
    }
    chars.into_iter().collect()
}

fn survives(text: &str) {
    let source = Source::new("model.toml", text);
    for language in [words::Language::En, words::Language::Ru] {
        match pipeline::build(&source, &[], &mut Watch::default()) {
            Ok(_) | Err(Failure::Trouble(_) | Failure::Misuse(_) | Failure::ClosedPipe) => {}
            Err(Failure::Findings { diagnostics, .. }) => {
                assert!(!diagnostics.is_empty());
                let style = Style { language, colour: false };
                assert!(!diagnostics::render(&diagnostics, &source, style).is_empty());
                assert!(!diagnostics::short(&diagnostics, &source, language).is_empty());
                assert!(diagnostics::to_json(&diagnostics, &source, language).is_array());
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn spoilt_gallery_files_do_no_harm(
        model in 0..gallery::EXAMPLES.len(),
        changes in prop::collection::vec((any::<usize>(), 0..12usize, any::<usize>()), 1..4),
    ) {
        survives(&spoil(gallery::EXAMPLES[model].text, &changes));
    }

    #[test]
    fn random_text_does_no_harm(text in "\\PC{0,200}") {
        survives(&text);
    }
}

#[path = "../../examples/mutants/mutate.rs"]
mod mutate;
#[path = "../../examples/mutants/trial.rs"]
mod trial;

/// A short run of `examples/mutants.rs`: every command over mutants that are models still.
#[test]
fn commands_survive_mutants() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("mutants");
    let binary = assert_cmd::cargo::cargo_bin!("strutt");
    let mut bad = Vec::new();
    for index in 0..60 {
        let mut dice = mutate::Dice::of(7, index);
        let text = mutate::mutate(dice.pick(gallery::EXAMPLES).text, &mut dice);
        let trial = trial::Trial { binary, folder: folder.join(index.to_string()), text: &text, arguments: trial::command(&mut dice) };
        if let trial::Verdict::Bad(what) = trial.run() {
            bad.push(format!("{} {}: {what}", trial.folder.display(), trial.arguments.join(" ")));
        }
    }
    assert!(bad.is_empty(), "{}", bad.join("\n"));
}
