//! The written calculation: its outline is a golden text, its formulas name what cards of problems ask for, and nothing of one language stands in the other.
//!
//! `UPDATE_GOLDEN=1 cargo test -p strutt --test reports` writes the outlines anew; look at what changed.

mod common;

use common::{folder, gallery, strutt};
use report::{Block, Document};
use std::path::PathBuf;
use studies::{Source, Watch, pipeline};
use words::Language;

/// Models whose outlines are kept: every kind of chapter, and none that takes seconds.
const MODELS: [&str; 9] = [
    "oscillator",
    "oscillator-linkage",
    "manipulator",
    "scotch-yoke",
    "thread-pendulum",
    "portal-frame",
    "three-rod-frame",
    "pendulum-on-shaft",
    "gyroscopic-rotor",
];

fn document(name: &str, language: Language) -> Document {
    let text = std::fs::read_to_string(gallery(name)).unwrap();
    let source = Source::new(&format!("{name}.toml"), &text);
    let calculation = pipeline::run(&source, &[], &mut Watch::default()).unwrap_or_else(|_| panic!("{name} is a model"));
    pipeline::report(&calculation, language)
}

/// Headings with what stands below each.
fn outline(document: &Document) -> String {
    let mut out = String::new();
    let mut counts = [0usize; 4];
    let close = |out: &mut String, counts: &mut [usize; 4]| {
        if *counts != [0; 4] {
            out.push_str(&format!("    formulas {} (numbered {}), tables {}, figures {}\n", counts[0], counts[1], counts[2], counts[3]));
        }
        *counts = [0; 4];
    };
    for block in &document.blocks {
        match block {
            Block::Heading { level, text } => {
                close(&mut out, &mut counts);
                out.push_str(&format!("{}{text}\n", "  ".repeat(usize::from(*level) - 1)));
            }
            Block::Equation { numbered, .. } => {
                counts[0] += 1;
                counts[1] += usize::from(*numbered);
            }
            Block::Table(_) => counts[2] += 1,
            Block::Figure(_) | Block::Bands(_) | Block::Scheme(_) => counts[3] += 1,
            _ => {}
        }
    }
    close(&mut out, &mut counts);
    out
}

#[test]
fn outlines_are_those_that_were_read() {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/reports.txt");
    let mut written = String::new();
    for name in MODELS {
        for language in [Language::En, Language::Ru] {
            written.push_str(&format!("# {name} {}\n{}\n", language.code(), outline(&document(name, language))));
        }
    }
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(&file, &written).unwrap();
    }
    let kept = std::fs::read_to_string(&file).unwrap_or_default();
    for (a, b) in written.lines().zip(kept.lines()) {
        assert_eq!(a, b, "UPDATE_GOLDEN=1 cargo test -p strutt --test reports");
    }
    assert_eq!(written.lines().count(), kept.lines().count());
}

/// The text of a document with its formulas as text.
fn text(document: &Document) -> String {
    let mut out = String::new();
    for block in &document.blocks {
        match block {
            Block::Heading { text, .. } => out.push_str(text),
            Block::Paragraph(rich) => out.push_str(&rich.plain(document.language)),
            Block::Equation { formula, .. } => out.push_str(&formula.text()),
            Block::Table(table) => {
                for row in &table.rows {
                    for cell in row {
                        match cell {
                            report::Cell::Rich(rich) => out.push_str(&rich.plain(document.language)),
                            report::Cell::Number(number) => out.push_str(number),
                            _ => {}
                        }
                        out.push_str(" | ");
                    }
                    out.push('\n');
                }
            }
            _ => {}
        }
        out.push('\n');
    }
    out
}

/// Spaces of any kind as one.
fn spaced(text: &str) -> String {
    text.split(|c: char| c.is_whitespace()).filter(|w| !w.is_empty()).collect::<Vec<_>>().join(" ")
}

#[test]
fn quantities_stand_with_formula_substitution_and_value() {
    let russian = spaced(&text(&document("oscillator", Language::Ru)));
    for line in ["b = 4 μ l² = 4·40·0,3² = 14,4 Н·м·с", "n = b/(2 a) = 14,4/(2·0,72) = 10 1/с", "k = √(c/a) = √(72/0,72) = 10 1/с"]
    {
        assert!(russian.contains(line), "{line}\n{russian}");
    }
}

#[test]
fn a_machine_of_one_freedom_has_its_equation_with_reduced_inertia() {
    let english = spaced(&text(&document("scotch-yoke", Language::En)));
    // the truth of the problem's card: J = 2.299608 + 0.126 cos² φ₁, the weight of 31 kg and not of 35
    assert!(english.contains("J(φ₁) = 2.29961 + 0.126 cos² φ₁ kg·m²"), "{english}");
    assert!(english.contains("reduced moment of inertia"));
}

#[test]
fn tables_and_figures_are_mentioned_before_they_come() {
    for name in ["manipulator", "thread-pendulum"] {
        let document = document(name, Language::Ru);
        let (mut tables, mut figures, mut said) = (0, 0, String::new());
        for block in &document.blocks {
            match block {
                Block::Paragraph(rich) => said = rich.plain(Language::Ru),
                Block::Table(_) => {
                    tables += 1;
                    assert!(said.ends_with(&format!("см. таблицу\u{a0}{tables}.")), "{name}: {said}");
                }
                Block::Figure(_) | Block::Bands(_) | Block::Scheme(_) => {
                    figures += 1;
                    assert!(said.contains("рисун"), "{name}: {said}");
                }
                _ => {}
            }
        }
        assert!(tables > 4 && figures > 1, "{name}");
    }
}

#[test]
fn the_command_writes_where_it_is_told_and_the_same_bytes_again() {
    let here = folder("report-command");
    let file = here.join("work.html");
    for _ in 0..2 {
        strutt().args(["report", &gallery("oscillator-linkage"), "--lang", "ru", "-q", "-o"]).arg(&file).assert().success();
        let page = std::fs::read_to_string(&file).unwrap();
        assert!(page.contains("<section class=\"front\">") && page.contains("Курсовая работа") && page.contains("class=\"contents\""));
        let kept = here.join("first.html");
        if kept.exists() {
            assert_eq!(std::fs::read_to_string(&kept).unwrap(), page);
        }
        std::fs::write(kept, page).unwrap();
    }
    strutt().args(["report", &gallery("oscillator-linkage"), "--format", "latex", "-q", "--out"]).arg(&here).assert().success();
    assert!(std::fs::read_to_string(here.join("report.tex")).unwrap().contains("\\begin{titlepage}"));
    let refused = common::stderr(
        strutt().args(["report", &gallery("oscillator-linkage"), "--format", "markdown", "--pdf", "-q", "--out"]).arg(&here),
        2,
    );
    assert!(refused.contains("C061"), "{refused}");
}
