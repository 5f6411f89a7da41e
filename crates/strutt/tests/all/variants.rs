//! Courses: sheets, keys and grades from the command line.

use crate::common;

use common::{folder, stdout, strutt};
use predicates::str::contains;
use serde_json::Value;
use std::path::Path;

const MODEL: &str = r#"
title = { en = "Oscillator", ru = "Осциллятор" }
gravity = false
[parameters]
m = { value = "1 kg", label = { en = "mass", ru = "масса" } }
c = "100 N/m"
b = "4 N s/m"
[coordinates]
x = { unit = "m", start = "10 mm" }
[bodies.block]
origin = ["x", "0"]
mass   = "m"
[springs.s]
along     = "x"
stiffness = "c"
[dampers.d]
along   = "x"
damping = "b"
[variants]
N = "1..8"
m = "1 [kg] + 0.1 [kg]*N + 0.05 [kg]*n"
c = "c*(8 - N)/abs(8 - N)"
[[study]]
kind  = "simulate"
until = "3 s"
[[answers]]
id    = "k"
value = "modes.1.omega"
unit  = "rad/s"
gives = "c"
[[answers]]
id      = "T"
formula = "2*pi/k"
unit    = "s"
[[answers]]
id    = "v"
value = "max(x')"
unit  = "mm/s"
tolerance = "2 %"
"#;

fn class(name: &str) -> std::path::PathBuf {
    let here = folder(name);
    std::fs::write(here.join("m.toml"), MODEL.replace("gives = \"c\"\n", "")).unwrap();
    std::fs::write(here.join("list.csv"), "ФИО;вариант\nИванова Анна;1\n\"О'Хара <b>\";2\n../../etc;3\nПустой;8\nИванова Анна;4\n")
        .unwrap();
    here
}

fn make(here: &Path, out: &str, exit: i32) {
    let arguments = ["variants", "make", "m.toml", "--group", "3", "--names", "list.csv", "--lang", "ru", "--out", out];
    strutt().current_dir(here).args(arguments).assert().code(exit);
}

fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(here) = folders.pop() {
        for path in std::fs::read_dir(here).unwrap().flatten().map(|e| e.path()) {
            match path.is_dir() {
                true => folders.push(path),
                false => found.push((path.strip_prefix(folder).unwrap().display().to_string(), std::fs::read(&path).unwrap())),
            }
        }
    }
    found.sort();
    found
}

fn key(here: &Path, out: &str) -> Value {
    serde_json::from_slice(&std::fs::read(here.join(out).join("key.json")).unwrap()).unwrap()
}

fn grade(here: &Path, answers: &str) -> Value {
    serde_json::from_str(&stdout(strutt().current_dir(here).args(["variants", "grade", "out", answers, "--json"]))).unwrap()
}

#[test]
fn a_class_is_made_the_same_twice_and_a_variant_that_fails_says_so() {
    let here = class("class-made");
    make(&here, "out", 1);
    make(&here, "again", 1);
    let (first, second) = (files(&here.join("out")), files(&here.join("again")));
    assert!(first == second, "two runs differ");
    let names: Vec<&str> = first.iter().map(|f| f.0.as_str()).collect();
    for name in [
        "key.json",
        "key.csv",
        "answers.csv",
        "moodle.xml",
        "questions.gift",
        "tasks/01-Иванова-Анна.html",
        "solutions/02-О-Хара-b.html",
        "tasks/03-etc.html",
    ] {
        assert!(names.contains(&name), "{name} is not among {names:?}");
    }
    let text = |name: &str| String::from_utf8(first.iter().find(|f| f.0 == name).unwrap().1.clone()).unwrap();
    assert!(text("tasks/04-Пустой.html").contains("выдать нельзя") && text("tasks/04-Пустой.html").contains("C022"));
    assert!(!text("tasks/02-О-Хара-b.html").contains("<b>"), "a name is no markup");
    let key = key(&here, "out");
    let hash = key["entries"][0]["hash"].as_str().unwrap();
    assert!(text("tasks/01-Иванова-Анна.html").contains(hash) && text("solutions/01-Иванова-Анна.html").contains(hash));
    assert_eq!(key["entries"][3]["answers"], serde_json::json!([null, null, null]));
}

/// Right answers are accepted however they are written: decimal comma, other units, in the head or in the cell, Windows-1251.
#[test]
fn right_answers_are_accepted_in_every_writing() {
    let here = class("class-right");
    make(&here, "out", 1);
    let key = key(&here, "out");
    let truth = |i: usize, k: usize| key["entries"][i]["answers"][k].as_f64().unwrap();
    let comma = |x: f64| format!("{x:.5}").replace('.', ",");
    let turns = std::f64::consts::TAU;
    let rows = format!(
        "студент;вариант;k [rad/s];T [ms];v, мм/с\nиванова  анна;1;{};{};{}\nО'Хара <b>;2;{} Гц;{} с;{} м/с\n../../etc;3;{} 1/с;{}e3;≈ {}\n",
        comma(truth(0, 0)),
        comma(1e3 * truth(0, 1)),
        comma(truth(0, 2)),
        comma(truth(1, 0) / turns),
        comma(truth(1, 1)),
        comma(truth(1, 2) / 1e3),
        truth(2, 0),
        comma(truth(2, 1)),
        truth(2, 2),
    );
    std::fs::write(here.join("a.csv"), &rows).unwrap();
    let letters = |c: char| match c {
        'А'..='я' => u8::try_from(u32::from(c) - 0x410 + 0xc0).unwrap(),
        '≈' => b' ',
        c => u8::try_from(u32::from(c)).unwrap(),
    };
    std::fs::write(here.join("w.csv"), rows.chars().map(letters).collect::<Vec<u8>>()).unwrap();
    for file in ["a.csv", "w.csv"] {
        let found = grade(&here, file);
        for student in [0, 1, 2] {
            let items = found["students"][student]["items"].as_array().unwrap();
            assert!(items.iter().all(|i| i["verdict"] == "right"), "{file}: {items:?}");
        }
        assert_eq!(found["students"][3]["right"], Value::Null);
    }
}

#[test]
fn wrong_answers_have_their_likeness_and_later_ones_follow() {
    let here = class("class-wrong");
    make(&here, "out", 1);
    let key = key(&here, "out");
    let truth = |i: usize, k: usize| key["entries"][i]["answers"][k].as_f64().unwrap();
    let hz = truth(0, 0) / std::f64::consts::TAU;
    let rows = format!(
        "student,variant,k,T,v,note\nИванова Анна,1,{hz},{},{}\nО'Хара <b>,2,{},-{},{} kg\n../../etc,3,9,lots,\nNobody,77,1,2,3\n\"a, b\",3,1,2,3,4,5,6\n",
        std::f64::consts::TAU / hz,
        truth(0, 2) / 1000.0,
        truth(2, 0),
        truth(1, 1),
        truth(1, 2),
    );
    std::fs::write(here.join("a.csv"), rows).unwrap();
    let found = grade(&here, "a.csv");
    let item = |i: usize, k: usize| &found["students"][i]["items"][k];
    assert_eq!((&item(0, 0)["verdict"], item(0, 0)["likeness"].as_str().unwrap().contains("rad/s")), (&"wrong".into(), true));
    assert_eq!(item(0, 1)["verdict"], "follows");
    assert_eq!(item(0, 2)["verdict"], "unit");
    assert!(item(1, 0)["likeness"].as_str().unwrap().contains("variant 3"));
    assert!(item(1, 1)["likeness"].as_str().unwrap().contains("opposite sign"));
    assert_eq!(item(1, 2)["verdict"], "unit");
    assert_eq!(item(2, 1)["verdict"], "unreadable");
    assert_eq!(item(2, 2)["verdict"], "missing");
    let remarks = found["remarks"].to_string();
    for part in ["Nobody", "note", "8 cells"] {
        assert!(remarks.contains(part), "{part}: {remarks}");
    }
    strutt().current_dir(&here).args(["variants", "grade", "out", "a.csv", "--out", "graded"]).assert().success();
    assert!(files(&here.join("graded")).iter().any(|f| f.0 == "reports/01-Иванова-Анна.html"));
}

/// The table that `make` writes is read back, whatever the names; questions hold what the sheet does.
#[test]
fn the_empty_table_is_taken_back_with_any_names_and_questions_hold_all_data() {
    let here = class("class-names");
    std::fs::write(here.join("list.csv"), "name;variant\n\"Petrova \"\"Anna\"\" O'Neil\";1\n\"Müller; Jörg\";2\n=Sum;3\n").unwrap();
    make(&here, "out", 0);
    let key = key(&here, "out");
    let truth = |i: usize, k: usize| key["entries"][i]["answers"][k].as_f64().unwrap();
    let empty = std::fs::read_to_string(here.join("out/answers.csv")).unwrap();
    let filled = |(i, line): (usize, &str)| match line.strip_suffix(";;;") {
        Some(head) => format!("{head};{};{};{}\n", truth(i - 2, 0), truth(i - 2, 1), truth(i - 2, 2)),
        None => format!("{line}\n"),
    };
    std::fs::write(here.join("a.csv"), empty.lines().enumerate().map(filled).collect::<String>()).unwrap();
    let found = grade(&here, "a.csv");
    assert_eq!(found["remarks"].as_array().unwrap().len(), 0, "{found}");
    for row in found["students"].as_array().unwrap() {
        assert_eq!(row["right"], 3, "{row}");
    }
    for file in ["moodle.xml", "questions.gift"] {
        let text = std::fs::read_to_string(here.join("out").join(file)).unwrap();
        // the damping is the same for all and stands in no variant
        assert!(text.contains("b \\= 4") || text.contains("b = 4"), "{text}");
    }
    let quiz = std::fs::read_to_string(here.join("out/moodle.xml")).unwrap();
    let count = |what: &str| quiz.matches(what).count();
    // three students, three items each, none of which takes a unit
    assert_eq!([count("type=\"category\""), count("type=\"numerical\""), count("<showunits>3</showunits>")], [3, 9, 9], "{quiz}");
}

/// Of a key without names everyone who handed in is graded, two who took one variant too.
#[test]
fn a_key_without_names_grades_whoever_hands_in() {
    let here = class("class-unnamed");
    strutt().current_dir(&here).args(["variants", "make", "m.toml", "--group", "3", "--out", "out"]).assert().code(1);
    let key = key(&here, "out");
    let truth = |i: usize, k: usize| key["entries"][i]["answers"][k].as_f64().unwrap();
    let right = format!("{},{},{}", truth(4, 0), truth(4, 1), truth(4, 2));
    std::fs::write(
        here.join("a.csv"),
        format!("student,variant,k,T,v\nPetrov,5,{right}\nSidorov,5,1,2,3\n,2,1,2,3\npetrov ,5,1,2,3\nLost,,1,2,3\n"),
    )
    .unwrap();
    let found = grade(&here, "a.csv");
    let rows: Vec<_> =
        found["students"].as_array().unwrap().iter().map(|r| (r["student"].as_str(), r["variant"].as_str(), r["right"].as_u64())).collect();
    assert_eq!(rows, [(Some("Petrov"), Some("5"), Some(3)), (Some("Sidorov"), Some("5"), Some(0)), (Some(""), Some("2"), Some(0))]);
    let remarks = found["remarks"].as_array().unwrap();
    assert_eq!(remarks.len(), 2, "{remarks:?}");
    strutt().current_dir(&here).args(["variants", "grade", "out", "a.csv", "--out", "graded"]).assert().success();
    assert!(files(&here.join("graded")).iter().any(|f| f.0 == "reports/02-Sidorov.html"));
}

#[test]
fn a_key_of_another_model_and_a_changed_one_are_refused() {
    let here = class("class-other");
    make(&here, "out", 1);
    std::fs::write(here.join("foreign.csv"), "student;alpha;beta\nИванова Анна;1;2\n").unwrap();
    std::fs::write(here.join("hash.csv"), "# strutt 0.1.0, model 0123456789abcdef\nstudent;k\nИванова Анна;1\n").unwrap();
    std::fs::write(here.join("nobody.csv"), "k;T\n1;2\n").unwrap();
    std::fs::write(here.join("partly.csv"), "student;k;beta\nИванова Анна;1;2\n").unwrap();
    for (file, code) in
        [("foreign.csv", "C071"), ("partly.csv", "C071"), ("hash.csv", "C071"), ("nobody.csv", "C072"), ("none.csv", "C001")]
    {
        strutt().current_dir(&here).args(["variants", "grade", "out", file]).assert().failure().stderr(contains(code));
    }
    let changed = std::fs::read_to_string(here.join("out/key.json")).unwrap().replace("4 N s/m", "5 N s/m");
    std::fs::write(here.join("changed.json"), changed).unwrap();
    for file in ["changed.json", "m.toml"] {
        strutt().current_dir(&here).args(["variants", "grade", file, "foreign.csv"]).assert().failure().stderr(contains("C070"));
    }
    std::fs::write(here.join("long.csv"), "A\n".repeat(9)).unwrap();
    let arguments = ["variants", "make", "m.toml", "--group", "3", "--names", "long.csv", "--out", "none"];
    strutt().current_dir(&here).args(arguments).assert().failure().stderr(contains("C069"));
    assert!(!here.join("none").exists(), "nothing is written when the list does not fit");
}

const BEAM: &str = r#"
gravity = false
[parameters]
F = "3 kN"
l = "3 m"
[nodes]
A = { at = ["0", "0"] }
C = { at = ["l/3", "0"] }
B = { at = ["l", "0"] }
[rods]
AC = { between = ["A", "C"], EI = "1e4 N m^2", EA = "1e8 N" }
CB = { between = ["C", "B"], EI = "1e4 N m^2", EA = "1e8 N" }
[supports]
A = { at = "A", directions = ["x", "y"] }
B = { at = "B", directions = ["y"] }
[forces.F]
at = "C"
value = ["0", "-F"]
[[study]]
kind = "statics"
[variants]
N = "1..4"
F = "3 [kN]*N"
[[answers]]
id = "X"
value = "reactions.A.x"
unit = "N"
[[answers]]
id = "Y"
value = "reactions.A.y"
unit = "kN"
"#;

/// Y_A = 2F/3 = 2 kN in variant 1 and X_A = 0: one hundredth of 2 kN is 20 N.
#[test]
fn a_right_zero_is_graded_by_the_size_of_its_quantity() {
    let here = folder("class-zero");
    std::fs::write(here.join("m.toml"), BEAM).unwrap();
    strutt().current_dir(&here).args(["variants", "make", "m.toml", "--out", "out"]).assert().code(0);
    std::fs::write(here.join("a.csv"), "variant;X;Y\n1;0;2\n2;35;4\n3;-61;6\n4;1e-3;8\n").unwrap();
    let found = grade(&here, "a.csv");
    let verdicts: Vec<&str> = (0..4).map(|i| found["students"][i]["items"][0]["verdict"].as_str().unwrap()).collect();
    assert_eq!(verdicts, ["right", "right", "wrong", "right"]);
    let quiz = std::fs::read_to_string(here.join("out/questions.gift")).unwrap();
    assert!(quiz.contains("{#0:20}"), "{quiz}");
}
