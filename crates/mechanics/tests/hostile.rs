//! Whatever the file, reading returns, and every finding points into the file.

use mechanics::{Model, read, sweep_range};
use proptest::prelude::*;
use std::sync::LazyLock;
use words::Notice;

const FULL: &str = include_str!("full.toml");
const CONNECTIONS: &str = include_str!("connections.toml");
const STUDIES: &str = include_str!("studies.toml");
static MODEL: LazyLock<Model> = LazyLock::new(|| read(FULL, "model.toml", &[]).unwrap().model);

/// Formulas in places of every sort.
const FORMULAS: [(&str, &str); 9] = [
    (FULL, "m*l^2"),
    (FULL, "400 kN/m"),
    (FULL, "box(0.1 [m], 0.2 [m])"),
    (FULL, "z: phi"),
    (CONNECTIONS, "200 [N]*exp(-u/v)"),
    (CONNECTIONS, "force(sliders.B) - F0 + normal(F)"),
    (CONNECTIONS, "vx(B)*sin(phi2)"),
    (STUDIES, "2*phi"),
    (STUDIES, "x - v*1 [s]"),
];

/// A file with one formula of every sort, which is read in a fraction of the time.
const SMALL: &str = r#"
[parameters]
m = "2 kg"
k = "PARAMETER"
[coordinates]
x = { unit = "m", start = "START" }
[bodies.b]
mass = "m"
origin = ["PLACE", "0 m"]
[springs.s]
along = "ALONG"
stiffness = "k"
[forces.f]
along = "x"
value = "FORCE"
[outputs]
y = "OUTPUT"
[events.e]
zero = "EVENT"
"#;
/// Its formulas: where they stand, and what stands there when another one is tried.
const SORTS: [(&str, &str); 7] = [
    ("PARAMETER", "200 N/m"),
    ("START", "0.1 m"),
    ("PLACE", "x"),
    ("ALONG", "x"),
    ("FORCE", "3 [N]*cos(2 [1/s]*t)"),
    ("OUTPUT", "m*x'^2/2"),
    ("EVENT", "x'"),
];

/// The small file with another formula in one place.
fn small(place: usize, formula: &str) -> String {
    SORTS.iter().enumerate().fold(SMALL.to_owned(), |text, (i, (name, usual))| text.replace(name, if i == place { formula } else { usual }))
}

#[test]
fn the_formulas_stand_in_the_files() {
    assert!(FORMULAS.iter().all(|(file, written)| file.contains(written)));
    assert!(SORTS.iter().all(|(name, _)| SMALL.matches(name).count() == 1));
    read(&small(SORTS.len(), ""), "model.toml", &[]).unwrap();
}

fn check(text: &str) -> Result<(), TestCaseError> {
    let findings: Vec<Notice> = match read(text, "model.toml", &[]) {
        Ok(reading) => reading.warnings,
        Err(findings) => {
            prop_assert!(!findings.is_empty());
            findings
        }
    };
    for d in &findings {
        if let Some(span) = d.span() {
            prop_assert!(text.get(span.clone()).is_some(), "{} points at {span:?} of {}", d.code, text.len());
        }
        for (span, _) in &d.related {
            prop_assert!(text.get(span.clone()).is_some(), "{} relates to {span:?}", d.code);
        }
        prop_assert!(!d.what.en.is_empty() && !d.what.ru.is_empty());
    }
    Ok(())
}

fn floor(text: &str, mut at: usize) -> usize {
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_text(text in "\\PC{0,200}") {
        check(&text)?;
    }

    #[test]
    fn toml_like_text(lines in prop::collection::vec("(\\[{1,2}[a-z.]{1,12}\\]{1,2}|[a-zа-я_\"]{1,8} ?= ?[-0-9a-z\"'\\[\\]{}, .^*/()м]{0,20})", 0..20)) {
        check(&lines.join("\n"))?;
    }

    #[test]
    fn any_formula(place in 0usize..FORMULAS.len(), formula in "[-+*/^()<>=,.'\\[\\]0-9a-zφ² ]{0,40}") {
        let (file, written) = FORMULAS[place];
        check(&file.replace(written, &formula))?;
    }

    #[test]
    fn any_range(range in "[ \u{a0}]{0,3}[a-zφ²ωm']{0,4}[ \u{a0}]{0,3}=[ 0-9a-zφ².,;()]{0,20}") {
        if let Err(found) = sweep_range(&MODEL, &range) {
            prop_assert!(!found.what.en.is_empty() && !found.what.ru.is_empty());
        }
    }

    #[test]
    fn mutated_files(which in 0usize..3, cuts in prop::collection::vec((0usize..4000, 0usize..40, 0usize..4000, 0u8..3), 1..5)) {
        let mut text = [FULL, CONNECTIONS, STUDIES][which].to_owned();
        for (at, length, from, how) in cuts {
            let start = floor(&text, at.min(text.len()));
            let end = floor(&text, (start + length).min(text.len()));
            let source = floor(&text, from.min(text.len()));
            let piece = text[source..floor(&text, (source + length).min(text.len()))].to_owned();
            match how {
                0 => text.replace_range(start..end.max(start), ""),
                1 => text.insert_str(start, &piece),
                _ => text.replace_range(start..end.max(start), &piece),
            }
        }
        check(&text)?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3600, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_formula_of_any_sort(place in 0usize..SORTS.len(), formula in "[-+*/^()<>=,.'\\[\\]0-9a-zφ² ]{0,40}") {
        check(&small(place, &formula))?;
    }
}
