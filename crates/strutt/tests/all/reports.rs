//! The written calculation: its outline is a golden text, its formulas name what cards of problems ask for, and nothing of one language stands in the other.
//!
//! `UPDATE_GOLDEN=1 cargo test -p strutt --test all reports` writes the outlines anew; look at what changed.

use crate::common;

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
    told(name, &std::fs::read_to_string(gallery(name)).unwrap(), language)
}

fn told(name: &str, text: &str, language: Language) -> Document {
    let source = Source::new(&format!("{name}.toml"), text);
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
        assert_eq!(a, b, "UPDATE_GOLDEN=1 cargo test -p strutt --test all reports");
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
    assert!(english.contains("J(φ₁) = 2.29961 + 0.126 cos² φ₁, kg·m²"), "{english}");
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

#[test]
fn formats_without_pages_are_refused_with_those_that_have_them() {
    for arguments in [&["--format", "text"][..], &["--format", "csv"], &["--format", "json"], &["--json"], &["--csv"]] {
        // what a program asked for, a program is told on stdout
        let output = strutt().args(["report", &gallery("oscillator")]).args(arguments).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let refused = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
        assert!(refused.contains("C073") && refused.contains("html") && refused.contains("latex"), "{arguments:?}: {refused}");
    }
}

/// Names of elements and connections in a file: `spiral` of `[springs.spiral]`.
fn keys(text: &str) -> Vec<String> {
    // every table of elements, connections and loads; bodies, points and coordinates have symbols
    let elements = mechanics::elements::TABLE.iter().map(|row| row.keys.name);
    let connections = mechanics::connections::TABLE.iter().map(|row| row.keys.name);
    let tables: Vec<&str> = elements.chain(connections).chain(["forces", "torques"]).collect();
    let named = text.lines().filter_map(|line| line.strip_prefix('[')?.split(']').next()?.split_once('.'));
    named.filter(|(table, _)| tables.contains(table)).map(|(_, name)| name.to_owned()).collect()
}

#[test]
fn a_russian_calculation_calls_nothing_by_an_english_key() {
    for name in ["oscillator", "oscillator-linkage", "manipulator", "scotch-yoke", "pendulum-on-shaft", "stick-slip", "crank-hoist"] {
        let keys = keys(&std::fs::read_to_string(gallery(name)).unwrap());
        let text = text(&document(name, Language::Ru));
        let words: Vec<&str> = text.split(|c: char| !(c.is_alphanumeric() || c == '_')).collect();
        for key in keys.iter().filter(|key| key.chars().count() > 2) {
            assert!(!words.contains(&key.as_str()), "{name}: {key}");
        }
    }
}

#[test]
fn elements_without_a_label_are_called_by_what_they_are() {
    let model = "[parameters]\nm = \"1 kg\"\nc = \"100 N/m\"\n[coordinates]\nx = { unit = \"m\", start = \"1 cm\" }\n[bodies.cart]\norigin = [\"x\", \"0\"]\nmass = \"m\"\n\
                 [springs.left]\nalong = \"x\"\nstiffness = \"c\"\n[springs.right]\nalong = \"x\"\nstiffness = \"c\"\n[forces.push]\nalong = \"x\"\nvalue = \"if(t < 1 [s], 5 [N], 0)\"\n";
    let source = Source::new("model.toml", model);
    let calculation = pipeline::run(&source, &[], &mut Watch::default()).unwrap_or_else(|_| panic!("a model"));
    let russian = spaced(&text(&pipeline::report(&calculation, Language::Ru)));
    assert!(russian.contains("Пружина 1") && russian.contains("Пружина 2") && russian.contains("«сила»"), "{russian}");
    let words: Vec<&str> = russian.split(|c: char| !c.is_alphanumeric()).collect();
    assert!(!["left", "right", "push"].iter().any(|key| words.contains(key)), "{russian}");
}

#[test]
fn constants_over_a_switch_have_the_unit_of_their_quantity() {
    let russian = spaced(&text(&document("oscillator", Language::Ru)));
    let at = russian.find("M₀ = {").unwrap_or_else(|| panic!("{russian}"));
    let told: String = russian[at..].chars().take(90).collect();
    assert!(told.contains("Н·м"), "{told}");
    assert!(!russian.contains("= – "), "{russian}");
}

#[test]
fn linearisation_has_its_numbers_with_connections_too() {
    // the problem's card: a = 0.72, b = 14.4, c = 72, n = k = 10
    for name in ["oscillator", "oscillator-linkage"] {
        let russian = spaced(&text(&document(name, Language::Ru)));
        for line in [
            "= 0,72 кг·м²",
            "= 14,4 Н·м·с/рад",
            "= 72 Н·м/рад",
            "n = b/(2 a) = 14,4/(2·0,72) = 10 1/с",
            "k = √(c/a) = √(72/0,72) = 10 рад/с",
        ] {
            assert!(russian.contains(line), "{name}: {line}\n{russian}");
        }
    }
    let linkage = spaced(&text(&document("oscillator-linkage", Language::Ru)));
    assert!(linkage.contains("a = J(q) = (m₁/2 + m₂ + 4 m₃/3) l²"), "{linkage}");
}

#[test]
fn the_response_stands_over_the_ratio_of_the_frequencies() {
    let russian = spaced(&text(&document("oscillator", Language::Ru)));
    // z = 15/10, ζ = 1: λ = 1/(1 + z²)
    for line in ["z = p/k = 15/10 = 1,5", "λ = 0,307692", "ζ = n/k = 10/10 = 1"] {
        assert!(russian.contains(line), "{line}\n{russian}");
    }
}

#[test]
fn reactions_stand_at_the_instant_of_the_greatest_acceleration() {
    // the problem's card: S, S1, S2 at max|ε|
    let document = document("crank-hoist", Language::En);
    let table = document.blocks.iter().find_map(|block| match block {
        Block::Table(table) if table.caption.as_deref().is_some_and(|c| c.contains("largest magnitude of “angular acceleration")) => {
            Some(table)
        }
        _ => None,
    });
    let rows: Vec<String> = table.unwrap().rows.iter().map(|row| format!("{row:?}")).collect();
    for (value, what) in [("0.132649", "instant"), ("65.809", "ε"), ("9159.88", "S"), ("4202.24", "S₁"), ("9455.04", "S₂")] {
        assert!(rows.iter().any(|row| row.contains(value)), "{what}: {value}\n{rows:?}");
    }
}

/// The rod of a slider-crank turns about the meeting of the crank's line and the perpendicular to the guide at B: P = (x_B, x_B tan φ), ω₂ = −v_A/AP.
#[test]
fn a_rod_turns_about_its_instantaneous_centre() {
    let text = std::fs::read_to_string(gallery("slider-crank")).unwrap().replace("start = \"0\"", "start = \"0.7 rad\"");
    let document = told("slider-crank", &text, Language::En);
    let table = |caption: &str| {
        let found = document.blocks.iter().find_map(|block| match block {
            Block::Table(table) if table.caption.as_deref() == Some(caption) => Some(table.rows.clone()),
            _ => None,
        });
        found.unwrap_or_else(|| panic!("no table “{caption}”"))
    };
    let numbers = |row: &[report::Cell]| -> Vec<f64> {
        let digits = |cell: &report::Cell| if let report::Cell::Number(text) = cell { text.replace('−', "-").parse().ok() } else { None };
        row.iter().filter_map(digits).collect()
    };
    let row = |rows: &[Vec<report::Cell>], what: &[&str]| {
        let named = |row: &&Vec<report::Cell>| what.iter().all(|w| row.iter().any(|cell| format!("{cell:?}").contains(w)));
        numbers(rows.iter().find(named).unwrap_or_else(|| panic!("no row {what:?} in {rows:?}")))
    };
    let (phi, r, l, omega) = (0.7_f64, 0.1, 0.3_f64, 10.0);
    let x_b = r * phi.cos() + (l * l - (r * phi.sin()).powi(2)).sqrt();
    let omega_2 = -omega * r / (x_b / phi.cos() - r);
    // six digits are shown
    let near = |found: f64, wanted: f64| assert!((found - wanted).abs() <= 1e-5 * wanted.abs(), "{found} for {wanted}");
    let rod = row(&table("Instantaneous centres of velocity"), &["(rod)"]);
    [(rod[0], omega_2), (rod[1], x_b), (rod[2], x_b * phi.tan())].into_iter().for_each(|(found, wanted)| near(found, wanted));
    let end = row(&table("Velocities of points by their distances from the centres"), &["(rod)", "Symbol(\"B\")"]);
    near(end[0], x_b * phi.tan());
    near(end[1], -omega_2 * x_b * phi.tan());
    near(end[2], omega_2 * x_b * phi.tan());
    let plans = document.blocks.iter().filter(|b| matches!(b, Block::Figure(f) if f.name == "velocity-plan")).count();
    assert_eq!(plans, 1);
}

/// Integration repeats the curves of the closed form: they are named and not drawn again.
#[test]
fn no_figure_stands_twice() {
    let document = document("oscillator", Language::En);
    let titles: Vec<String> = document
        .blocks
        .iter()
        .filter_map(|b| if let Block::Figure(f) = b { Some(format!("{:?}{:?}", f.title, f.y)) } else { None })
        .collect();
    let mut distinct = titles.clone();
    distinct.sort();
    distinct.dedup();
    assert_eq!(distinct.len(), titles.len(), "{titles:?}");
    assert!(text(&document).contains("The curves are those of figures"));
}

#[test]
fn lengths_keep_their_sign_where_motions_do() {
    let russian = spaced(&text(&document("crank-hoist", Language::Ru)));
    assert!(!russian.contains("|l₀ − s|") && !russian.contains("sign(l₀ − s)"), "{russian}");
    assert!(russian.contains("s − r₄ φ₄ = 0") && russian.contains("l₀ − s > 0"), "{russian}");
}

#[test]
fn generalized_and_dependent_coordinates_are_told_apart() {
    let russian = spaced(&text(&document("crank-hoist", Language::Ru)));
    assert!(russian.contains("Обобщённая координата – φ₁; остальные координаты – зависимые"), "{russian}");
    let transfers = spaced(&text(&document("four-bar", Language::Ru)));
    assert!(transfers.contains("J₁ + m₂ a²") && transfers.contains("мгновенный центр скоростей (шатун)"), "{transfers}");
}

#[test]
fn a_word_document_holds_every_formula_and_picture() {
    let here = folder("report-docx");
    let file = here.join("work.docx");
    strutt().args(["report", &gallery("oscillator-linkage"), "--lang", "ru", "--format", "docx", "-q", "-o"]).arg(&file).assert().success();
    let first = std::fs::read(&file).unwrap();
    assert_eq!(&first[..4], b"PK\x03\x04");
    strutt().args(["report", &gallery("oscillator-linkage"), "--lang", "ru", "--format", "docx", "-q", "-o"]).arg(&file).assert().success();
    assert_eq!(std::fs::read(&file).unwrap(), first);
    // pictures stand in the package and not beside it
    assert_eq!(std::fs::read_dir(&here).unwrap().count(), 1);
    for part in ["word/document.xml", "word/styles.xml", "word/media/figure-1.png", "[Content_Types].xml"] {
        assert!(first.windows(part.len()).any(|w| w == part.as_bytes()), "{part}");
    }
}

const COLLIDING: &str = r#"
[parameters]
m = "4 kg"
a = "0.5 m"
k = "2 kN/m"
n = "30 N s/m"
h = "60 N"
w = "10 rad/s"
[coordinates]
q = { unit = "rad", start = "0.1 rad" }
[bodies.rod]
angle = "q"
inertia = "4*m*a^2/3"
[springs.s]
along = "a*q"
stiffness = "k"
[dampers.d]
along = "2*a*q"
damping = "n"
[torques.load]
on = "rod"
value = "2*a*h*sin(w*t)"
[[study]]
kind = "modes"
[[study]]
kind = "transient"
until = "1 s"
"#;

#[test]
fn a_letter_of_the_file_never_stands_for_something_else() {
    let source = Source::new("model.toml", COLLIDING);
    let calculation = pipeline::run(&source, &[], &mut Watch::default()).unwrap_or_else(|_| panic!("a model"));
    let russian = spaced(&text(&pipeline::report(&calculation, Language::Ru)));
    // a, k, n, h are a length, a stiffness, a damping, a force in this file
    for wrong in ["a = 4 a", "n = b/(2 a)", "k = √(c/a)", "h = H/a", "a = J"] {
        assert!(!russian.contains(wrong), "{wrong}\n{russian}");
    }
    assert!(russian.contains("n_лин = b/(2 a_лин)") && russian.contains("k_лин = √(c/a_лин)"), "{russian}");
}

#[test]
fn bodies_have_the_numbers_that_their_labels_give_them() {
    let bars = spaced(&text(&document("manipulator", Language::Ru)));
    // masses and angles of the problem go by its own numbers: m at the end of bar 1
    assert!(bars.contains("Тело 1 (стержень) считается материальной точкой") && bars.contains("соединено с телом 3 (стержень)"), "{bars}");
    assert!(!bars.contains("стержень 3") || !bars.contains("Тело 1 (стержень 3)"), "{bars}");
    let loads = spaced(&text(&document("thread-pendulum", Language::Ru)));
    for line in ["T₁ = m₁", "T₂ = m₂", "T₃ = m₃", "T₄ = m₄", "Π₄ = −m₄"] {
        assert!(loads.contains(line), "{line}\n{loads}");
    }
    // an event of the file is told by its label
    let heads: Vec<String> = (document("thread-pendulum", Language::Ru).blocks.iter())
        .filter_map(|block| if let Block::Table(table) = block { Some(table) } else { None })
        .flat_map(|table| table.columns.iter().map(|column| column.head.plain(Language::Ru)).collect::<Vec<_>>())
        .collect();
    assert!(heads.iter().any(|head| head == "первое возвращение нити к вертикали"), "{heads:?}");
    assert!(!loads.contains("phi_0") && !heads.iter().any(|head| head.contains("phi")), "{heads:?}");
}

#[test]
fn what_time_switches_keeps_its_letter_in_the_linear_equation() {
    let russian = spaced(&text(&document("oscillator", Language::Ru)));
    assert!(russian.contains("a φ'' + c φ + 4 μ l² φ' = (l M₀/r) sin pt") || russian.contains("l M₀/r sin pt"), "{russian}");
    assert!(!russian.contains("4 l/r"), "{russian}");
    // tan ε = 2·10·15/(10² − 15²)
    assert!(russian.contains("= −2,4"), "{russian}");
    // M₀ stands where it is used, behind the forces and not behind T
    let at = |what: &str| russian.find(what).unwrap_or_else(|| panic!("{what}: {russian}"));
    assert!(at("M₀ = {") > at("Обобщённые силы"), "{russian}");
    for line in
        ["Амплитуда вынужденных колебаний величины «угол поворота стержня» при ω = 15 рад/с равна 0,05128 рад", "t достигает значения"]
    {
        assert!(russian.contains(line), "{line}\n{russian}");
    }
}

#[test]
fn a_frame_under_a_load_shows_its_shapes_with_dynamic_coefficients() {
    let document = document("three-rod-frame", Language::Ru);
    let russian = spaced(&text(&document));
    // the ratio u₂ l₂/u₁ of both modes and the static displacements of the problem's card
    for number in ["1,32307", "−2,26315", "1,84476·10⁻⁵", "0,296613", "сила в узле B"] {
        assert!(russian.contains(number), "{number}\n{russian}");
    }
    let titled = |block: &Block| match block {
        Block::Figure(figure) => figure.title.plain(Language::Ru).contains("при наибольшей нагрузке"),
        _ => false,
    };
    assert_eq!(document.blocks.iter().filter(|block| titled(block)).count(), 4);
}

#[test]
fn published_results_that_do_not_hold_are_named() {
    for (name, told) in [("manipulator", "−17,9"), ("oscillator", "16,16"), ("crank-hoist", "0,002884744")] {
        let russian = spaced(&text(&document(name, Language::Ru)));
        assert!(russian.contains(told) && russian.contains("✗ не подтверждено"), "{name}: {russian}");
    }
}
