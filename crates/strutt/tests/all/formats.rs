//! Every page in every format: the same headings, formulas, tables and figures, and where a compiler is at hand nothing sticks out.

use crate::common;

use common::{folder, gallery, in_parallel, strutt};
use report::formats::{Package, Pictures, Sheet, TABLE};
use std::path::Path;
use std::process::Command;

use studies::{Extent, Source, Watch, pipeline};
use words::Language;

/// How each format of pages numbers an equation.
const NUMBERS: [(&str, &str); 5] = [
    ("html", "class=\"no\""),
    ("markdown", "\\tag{"),
    ("latex", "\\tag{"),
    ("typst", "\n#formula([("),
    ("docx", "w:val=\"FormulaNumber\""),
];

fn read(path: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

#[test]
fn every_row_has_its_chapter_and_its_test() {
    for format in &TABLE {
        for page in ["docs/formats.md", "docs/formats.ru.md"] {
            assert!(read(page).contains(&format!("\n## {}\n", format.name)), "{page} has no chapter on {}", format.name);
        }
        let paged = format.is_paged();
        assert_eq!(paged, NUMBERS.iter().any(|(name, _)| *name == format.name), "{}", format.name);
    }
}

#[test]
fn every_model_gives_a_page_in_every_format() {
    in_parallel(strutt::gallery::EXAMPLES, |example| {
        let source = Source::new(example.name, example.text);
        let calculation = pipeline::run(&source, &[], &mut Watch::default()).unwrap_or_else(|_| panic!("{}", example.name));
        for language in [Language::En, Language::Ru] {
            let document = pipeline::document(&calculation, Extent::Page, language);
            let counts = NUMBERS.map(|(name, equation)| {
                let page = TABLE.iter().find(|f| f.name == name).and_then(|f| f.page()).unwrap();
                let pictures: Vec<String> = match page.pictures {
                    Pictures::Beside(drawing) | Pictures::Packed(Package { drawing, .. }) => {
                        (0..100).map(|i| format!("p{i}.{}", drawing.extension)).collect()
                    }
                    _ => Vec::new(),
                };
                let text = (page.write)(&document, &Sheet { width: 0, pictures: &pictures });
                let count = |word| (1..).take_while(|i| captioned(&text, language.word(word), *i)).count();
                [text.matches(equation).count(), count(report::Word::Figure), count(report::Word::Table)]
            });
            for (count, (name, _)) in counts.iter().zip(NUMBERS).skip(1) {
                assert_eq!(*count, counts[0], "{} {name}: equations, figures, tables", example.name);
            }
        }
    });
}

/// Whether "Table 3" stands there, with the space of the format between.
fn captioned(text: &str, word: &str, i: usize) -> bool {
    ["\u{a0}", "~"].iter().any(|space| text.contains(&format!("{word}{space}{i} ")))
}

/// A model whose every word is full of marks that mean something to some format.
const HOSTILE: &str = r#"
title = "$ % & # _ { } ~ ^ \\ < > \" @ * ` ' | [x] -- маятник φ₁² é \\end{document}"
description = "1. = + - // /* \\input{x} $x$ #let *a* [b](c) ∮ F dx ≤ √2 – и 中, длинное_слово_из_многих_частей_которое_нигде_не_кончается_и_не_помещается_в_строку_страницы"
[parameters]
m = { value = "1 kg", label = "масса & $ % # _ {" }
c = "100 N/m"
[coordinates]
x = { unit = "m", start = "1 mm", label = "ход *b_c|d" }
[bodies.a]
origin = ["x", "0"]
mass = "m"
[springs.s]
along = "x"
stiffness = "c"
[[study]]
kind = "simulate"
until = "1 s"
"#;

/// What the compiler says; it must be content.
fn compiled(program: &str, arguments: &[&str], within: &Path) -> String {
    let done = Command::new(program).args(arguments).current_dir(within).output().unwrap_or_else(|e| panic!("{program}: {e}"));
    let said = String::from_utf8_lossy(&done.stdout).into_owned() + &String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{program} in {}:\n{said}", within.display());
    said
}

/// Whether the machine has a program that begins so.
fn is_at_hand(program: &str, arguments: &[&str]) -> bool {
    let found = Command::new(program).args(arguments).output().is_ok_and(|done| done.status.success());
    if !found {
        eprintln!("{program} {arguments:?} is not at hand: its pages are not compiled here");
    }
    found
}

/// The compiler of typst or its package for Python, with how it is asked for and called.
const TYPST: [(&str, &[&str], &[&str]); 2] = [
    ("typst", &["--version"], &["compile", "index.typ"]),
    ("python3", &["-c", "import typst"], &["-c", "import typst; typst.compile('index.typ', output='index.pdf')"]),
];

fn page(file: &str, format: &str, language: &str) -> std::path::PathBuf {
    let name = Path::new(file).parent().and_then(Path::file_name).unwrap_or_default().to_string_lossy().into_owned();
    let out = folder(&format!("formats-{name}-{format}-{language}"));
    strutt().args(["run", file, "--format", format, "--lang", language, "-q", "--out"]).arg(&out).assert().success();
    out
}

#[test]
fn pages_compile_and_nothing_sticks_out() {
    let hostile = folder("formats-hostile").join("model.toml");
    std::fs::write(&hostile, HOSTILE).unwrap();
    let hostile = hostile.to_str().unwrap().to_owned();
    let typst = TYPST.iter().find(|(program, asked, _)| is_at_hand(program, asked));
    for (language, engine) in [("en", "xelatex"), ("ru", "pdflatex")] {
        let has_engine = is_at_hand(engine, &["--version"]);
        for file in [&hostile, &gallery("crank-hoist"), &gallery("portal-frame")] {
            if has_engine {
                let log = compiled(engine, &["-interaction=nonstopmode", "-halt-on-error", "index.tex"], &page(file, "latex", language));
                assert!(!log.contains("Overfull"), "{file} {language} {engine}:\n{log}");
            }
            if let Some((program, _, arguments)) = typst {
                compiled(program, arguments, &page(file, "typst", language));
            }
        }
    }
}
