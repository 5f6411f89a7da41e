//! What a reader sees: written solutions that are whole, units beside every number, words that say what is meant.

use crate::common;

use common::{folder, gallery, stderr, stdout, strutt};
use serde_json::Value;

/// Two masses on springs under a harmonic load, a further harmonic, a constant and a ramp.
const TWO_MASSES: &str = r#"
[coordinates]
x = { unit = "m", start = "1 mm" }
y = { unit = "m" }
[bodies.a]
origin = ["x", "0"]
mass = "1 kg"
[bodies.b]
origin = ["y", "0"]
mass = "1 kg"
[springs.s]
along = "x"
stiffness = "100 N/m"
[dampers.s]
along = "x"
damping = "1 N s/m"
[springs.t]
along = "y - x"
stiffness = "200 N/m"
[dampers.t]
along = "y - x"
damping = "2 N s/m"
[forces.F]
along = "x"
value = "1[N]*sin(10[rad/s]*t) + 2[N]*cos(30[rad/s]*t) + 3[N] + 2[N/s]*t"
[[study]]
kind = "transient"
until = "3 s"
"#;

/// The motion of a principal coordinate from the numbers of JSON alone.
fn written(mode: &Value, t: f64) -> f64 {
    let c = |key: &str| mode["constants"][key].as_f64().unwrap_or_else(|| panic!("no {key}"));
    assert_eq!(mode["case"], "underdamped");
    let free = (-c("n") * t).exp() * (c("C1") * (c("k1") * t).cos() + c("C2") * (c("k1") * t).sin());
    let of = |v: &Value, key: &str| v[key].as_f64().unwrap();
    let list = |key: &str| mode[key].as_array().unwrap().clone();
    let waves: f64 = list("harmonics").iter().map(|h| of(h, "D") * (of(h, "p") * t + of(h, "delta") - of(h, "epsilon")).sin()).sum();
    let term = |f: &Value| {
        let wave = (of(f, "frequency") * t + of(f, "phase")).cos();
        of(f, "factor") * t.powi(of(f, "power") as i32) * (of(f, "rate") * t).exp() * wave
    };
    free + waves + c("static") + list("further").iter().map(term).sum::<f64>()
}

#[test]
fn the_written_solution_of_several_masses_is_the_motion() {
    let folder = folder("pages-two");
    let file = folder.join("two.toml");
    std::fs::write(&file, TWO_MASSES).unwrap();
    let file = file.to_str().unwrap();
    let json: Value = serde_json::from_str(&stdout(strutt().args(["transient", file, "--at", "0,0.7,3", "--json"]))).unwrap();
    let modes = json["phases"][0]["modes"].as_array().unwrap();
    assert_eq!(modes.len(), 2);
    let values = |name: &str| json["columns"][name]["values"].clone();
    for (i, t) in [0.0, 0.7, 3.0].into_iter().enumerate() {
        for name in ["x", "y"] {
            let sum: f64 = modes.iter().map(|m| m["shape"][name].as_f64().unwrap() * written(m, t)).sum();
            let computed = values(name)[i].as_f64().unwrap();
            // numbers of a page have all digits: what is left is rounding of the sum
            assert!((sum - computed).abs() < 1e-12, "{name}({t}): {sum} {computed}");
        }
    }
    // and it is printed: each principal coordinate with its ramp, the coordinates as their sums
    let run = stdout(strutt().args(["run", file, "--out", folder.join("out").to_str().unwrap()]));
    for piece in ["q₁ = ", "q₂ = ", "x = ", "y = "] {
        assert!(run.contains(piece), "{piece}: {run}");
    }
    let line = run.lines().skip_while(|l| !l.trim_start().starts_with("q₁ = ")).take(4).collect::<String>();
    assert!(line.contains(" t"), "no ramp in {line}");
}

#[test]
fn amplitudes_have_units_and_units_have_figures_of_their_own() {
    let text = stdout(strutt().args(["response", &gallery("absorber"), "--lang", "ru"]));
    let head = text.lines().find(|l| l.contains("амплитуда")).unwrap();
    assert!(head.contains("Единица"), "{head}");
    let folder = folder("pages-response");
    stdout(strutt().args(["run", &gallery("absorber"), "--out", folder.to_str().unwrap()]));
    let mut names: Vec<String> = std::fs::read_dir(&folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.retain(|n| n.contains("response-amplitude") && n.ends_with(".svg"));
    assert_eq!(names.len(), 2, "{names:?}");
}

#[test]
fn tied_coordinates_are_not_called_generalized() {
    let folder = folder("pages-tied");
    let run = |name: &str, lang: &str| {
        stdout(strutt().args(["run", &gallery(name), "--lang", lang, "--out", folder.join(name).to_str().unwrap()]))
    };
    let tied = run("atwood", "en");
    assert!(tied.contains("tied by connections") && !tied.contains("Generalized coordinates"), "{tied}");
    let free = run("double-pendulum", "ru");
    assert!(free.contains("Обобщённые координаты") && free.contains("Re λ") && !free.contains("growth"), "{free}");
}

#[test]
fn a_free_motion_along_a_condition_has_no_period() {
    let text = stdout(strutt().args(["modes", &gallery("thread-pendulum"), "--json"]));
    let json: Value = serde_json::from_str(&text).unwrap();
    assert_eq!((&json["modes"][0]["kind"], json["modes"][0]["omega"].as_f64()), (&Value::from("rigid_body"), Some(0.0)));
    assert!(json["modes"][0]["T"].is_null());
}

#[test]
fn a_wrong_name_of_a_range_is_told_by_its_own_key() {
    let words = stderr(strutt().args(["equilibrium", &gallery("double-pendulum"), "--over", "phi", "--range", "-3,3"]), 2);
    assert!(words.contains("--over phi") && !words.contains("--guess"), "{words}");
}

#[test]
fn events_are_told_in_the_language_of_the_reader() {
    let table = stdout(strutt().args(["simulate", &gallery("bouncing-ball"), "--events", "--lang", "ru", "--until", "1 s"]));
    assert!(table.lines().nth(1).unwrap().chars().any(|c| ('а'..='я').contains(&c)), "{table}");
}

/// x = 0.1 cos 2t of a mass on a spring, its table from 0.5 s to 1 s.
#[test]
fn columns_of_start_and_end_are_those_of_the_motion() {
    let model = r#"
[coordinates]
x = { unit = "m", start = "0.1 m" }
[bodies.a]
origin = ["x", "0"]
mass = "1 kg"
[springs.s]
along = "x"
stiffness = "4 N/m"
[[study]]
kind = "simulate"
until = "2 s"
at = ["0.5 s", "1 s"]
"#;
    let folder = folder("start-and-end");
    let file = folder.join("model.toml");
    std::fs::write(&file, model).unwrap();
    let text = stdout(strutt().args(["run", file.to_str().unwrap(), "--format", "text", "--out", folder.join("out").to_str().unwrap()]));
    let row = text.lines().find(|l| l.starts_with("x ")).unwrap_or_else(|| panic!("no row of x: {text}"));
    let cells: Vec<&str> = row.split_whitespace().collect();
    // 0.1 cos 4 = -0.06536 m; the least value is -0.1 m at π/2
    assert_eq!((cells[1], cells[2], cells[cells.len() - 1]), ("m", "0.1000", "−0.0654"), "{row}");
}
