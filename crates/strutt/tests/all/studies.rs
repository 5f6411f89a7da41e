//! Studies from the command line: tables, JSON, overrides, folders of results.

use crate::common;

use common::{folder, gallery, in_parallel, is_written, stderr, stdout, strutt, table};
use predicates::str::contains;
use serde_json::Value;

fn json(command: &mut assert_cmd::Command) -> Value {
    serde_json::from_str(&stdout(command.arg("--json"))).unwrap()
}

#[test]
fn the_table_has_exactly_the_asked_times_and_columns() {
    let at = "0,0.1,0.30000000000000004,0.25,1e-3";
    let csv = stdout(strutt().args(["simulate", &gallery("double-pendulum"), "--at", at, "--outputs", "phi2',phi1,phi1''"]));
    let (head, rows) = table(&csv);
    assert_eq!(head, ["t [s]", "phi2' [rad/s]", "phi1 [rad]", "phi1'' [rad/s^2]"]);
    let times: Vec<f64> = rows.iter().map(|r| r[0]).collect();
    assert_eq!(times, [0.0, 0.1, 0.30000000000000004, 0.25, 1e-3]);
    let digits = csv.lines().nth(2).unwrap().split(',').next().unwrap();
    assert_eq!(digits.split('e').next().unwrap().chars().filter(char::is_ascii_digit).count(), 17, "{digits}");
}

#[test]
fn the_usual_columns_are_coordinates_rates_and_outputs() {
    let csv = stdout(strutt().args(["simulate", &gallery("scotch-yoke"), "--at", "0"]));
    let (head, rows) = table(&csv);
    assert_eq!(head[..3], ["t [s]", "phi1 [rad]", "y2 [m]"]);
    assert_eq!(head[6..8], ["phi1' [rad/s]", "y2' [m/s]"]);
    assert!(head.contains(&"eps1 [rad/s^2]".to_owned()) && !head.iter().any(|h| h.starts_with("phi1''")), "{head:?}");
    assert_eq!(rows, [rows[0].clone()]);
}

#[test]
fn every_makes_a_grid_to_the_end() {
    let csv = stdout(strutt().args(["simulate", &gallery("spherical-pendulum"), "--until", "0.3 s", "--every", "100 ms", "--csv"]));
    let times: Vec<f64> = table(&csv).1.iter().map(|r| r[0]).collect();
    assert_eq!(times, [0.0, 0.1, 0.2, 0.3]);
}

#[test]
fn overrides_change_parameters_starts_and_rates() {
    let run = |set: &[&str]| {
        let mut command = strutt();
        command.args(["simulate", &gallery("double-pendulum"), "--at", "0,0.2", "--outputs", "phi1,phi1'"]);
        set.iter().for_each(|s| {
            command.args(["--set", s]);
        });
        table(&stdout(&mut command)).1
    };
    let plain = run(&[]);
    let started = run(&["phi1=0.1", "phi1'=2 rad/s"]);
    assert_eq!((started[0][1], started[0][2]), (0.1, 2.0));
    assert_ne!(run(&["l1=0.7"])[1], plain[1]);
}

#[test]
fn wrong_overrides_point_into_the_override() {
    let model = gallery("double-pendulum");
    let set = |text: &str| stderr(strutt().args(["simulate", &model, "--until", "1", "--set", text]), 2);
    assert!(set("l9=1").contains("l9"));
    assert!(set("l1=1 kg").contains("^"));
    assert!(set("l1").contains("C009"));
}

#[test]
fn unknown_outputs_are_wrong_use_with_the_nearest_name() {
    let text = stderr(strutt().args(["simulate", &gallery("pendulum-on-shaft"), "--until", "1", "--outputs", "omegap"]), 2);
    assert!(text.contains("omega_p"), "{text}");
}

#[test]
fn bad_values_are_wrong_use() {
    let model = gallery("pendulum-on-shaft");
    for arguments in [["--until", "5 kg"], ["--until", "soon"], ["--at", "1,,2"], ["--tolerance", "tiny"]] {
        strutt().args(["simulate", &model]).args(arguments).assert().code(2).stderr(contains("C009"));
    }
    for arguments in [["--until", "-1"], ["--tolerance", "1"], ["--every", "0"]] {
        strutt().args(["simulate", &model]).args(arguments).assert().code(2).stderr(contains("C009"));
    }
}

#[test]
fn a_result_larger_than_memory_is_refused_at_once() {
    let text = stderr(strutt().args(["simulate", &gallery("top"), "--until", "1", "--every", "1e-12"]), 1);
    assert!(text.contains("S005"), "{text}");
}

#[test]
fn json_has_the_fields_of_every_study() {
    let value = json(strutt().args(["simulate", &gallery("scotch-yoke-dry"), "--at", "0,0.1", "--set", "m2=14 kg"]));
    for field in ["title", "version", "model_hash", "parameters", "counters", "audits", "events", "columns"] {
        assert!(!value[field].is_null(), "{field}");
    }
    assert_eq!(value["parameters"]["m2"]["value"], 14.0);
    assert_eq!(value["columns"]["t"]["values"].as_array().unwrap().len(), 2);
    for audit in value["audits"].as_array().unwrap() {
        assert!(audit["name"].is_string() && audit["value"].is_number() && audit["limit"].is_number(), "{audit}");
        assert_eq!(audit["ok"], true, "{audit}");
    }
    let plain = json(strutt().args(["simulate", &gallery("scotch-yoke-dry"), "--at", "0"]));
    assert_ne!(value["model_hash"], plain["model_hash"]);
}

#[test]
fn half_the_tolerance_is_one_more_audit() {
    let args = ["simulate", &gallery("scotch-yoke"), "--until", "0.2568", "--at", "0.2568", "--outputs", "phi1"];
    let audits = |value: &Value| value["audits"].as_array().unwrap().clone();
    let plain = json(strutt().args(args));
    let halved = json(strutt().args(args).arg("--halve-tolerance"));
    assert_eq!(audits(&halved).len(), audits(&plain).len() + 1);
    let last = audits(&halved).last().unwrap().clone();
    assert!(last["key"] == "tolerance_halving" && last["ok"] == true, "{last}");
    assert_eq!(halved["columns"], plain["columns"]);
}

#[test]
fn same_input_same_bytes() {
    let run = || stdout(strutt().args(["simulate", &gallery("scotch-yoke-dry"), "--json"]));
    assert_eq!(run(), run());
}

#[test]
fn every_model_of_the_gallery_runs_and_passes_its_audits() {
    let names: Vec<&str> = strutt::gallery::names().collect();
    in_parallel(&names, |name| {
        let out = folder(&format!("run-{name}"));
        let text = stdout(strutt().args(["run", &gallery(name), "--out"]).arg(&out));
        assert!(!text.contains("NaN"), "{text}");
        is_written(name, &out, "en");
    });
}

#[test]
fn equations_come_in_three_forms() {
    let model = gallery("pendulum-on-shaft");
    let text = stdout(strutt().args(["equations", &model]));
    assert!(text.contains("(3)"), "{text}");
    assert!(stdout(strutt().args(["equations", &model, "--form", "latex"])).contains("\\begin{equation}"));
    assert!(stdout(strutt().args(["equations", &model, "--form", "mathml"])).contains("<math"));
    let steps = stdout(strutt().args(["equations", &model, "--steps", "--lang", "ru"]));
    assert!(steps.lines().count() > text.lines().count() && steps.contains("инетическ"), "{steps}");
    let value = json(strutt().args(["equations", &model]));
    assert_eq!(value["equations"].as_array().unwrap().len(), 3);
    assert!(value["equations"][0]["latex"].is_string());
}

#[test]
fn a_pendulum_hangs_at_rest() {
    let value = json(strutt().args(["equilibrium", &gallery("double-pendulum")]));
    let places = value["equilibria"].as_array().unwrap();
    assert!(!places.is_empty());
    for place in places {
        assert!(place["coordinates"]["phi1"].is_number() && place["residual"].is_number(), "{place}");
    }
}

#[test]
fn a_disk_that_refuses_is_reported() {
    let here = folder("refused");
    std::fs::write(here.join("out"), "a file in the place of the folder").unwrap();
    strutt().current_dir(&here).args(["run", &gallery("top")]).assert().code(1).stderr(contains("C005"));
}

#[cfg(unix)]
#[test]
fn a_closed_pipe_is_no_error() {
    use std::process::{Command, Stdio};
    let mut child = Command::new(assert_cmd::cargo::cargo_bin!("strutt"))
        .args(["simulate", &gallery("top"), "--every", "1e-4"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
}

#[test]
fn a_run_that_fails_keeps_what_it_has() {
    let here = folder("partial");
    let text = "[parameters]\nm = \"1 kg\"\n[coordinates]\nx = { unit = \"m\", start = \"1 m\" }\n[bodies.b]\norigin = [\"x\", \"0\"]\nmass = \"m\"\n\
        [forces.f]\nalong = \"x\"\nvalue = \"-1 [N m^2]/x^2\"\n[[study]]\nkind = \"simulate\"\nuntil = \"10 s\"\n";
    std::fs::write(here.join("fall.toml"), text).unwrap();
    let output = strutt().current_dir(&here).args(["run", "fall.toml"]).assert().code(1).get_output().clone();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(stderr.contains("error[") && stderr.contains("so far"), "{stderr}");
    let csv = std::fs::read_to_string(here.join("out/fall/motion.csv")).unwrap();
    // the fall from rest at distance 1 with unit mass and strength takes π/(2√2) = 1.11 s
    let last = table(&csv).1.last().unwrap()[0];
    assert!((1.0..1.111).contains(&last), "{last}");
}

#[test]
fn a_regime_of_a_conservative_machine_is_said_to_be_one_of_a_family() {
    let dir = folder("family");
    let write = |damping: &str| {
        let path = dir.join("pendulum.toml");
        let text = format!(
            "[coordinates]\nphi = {{ unit = \"rad\", start = \"1.9 rad\" }}\n[bodies.bob]\nangle = \"phi\"\nmass = \"1 kg\"\ncenter = [\"0\", \"-0.7 m\"]\n\
             [forces.f]\nalong = \"phi\"\nvalue = \"{damping}\"\n[[study]]\nkind = \"periodic\"\nsection = \"phi\"\n"
        );
        std::fs::write(&path, text).unwrap();
        json(strutt().args(["periodic", path.to_str().unwrap()]))
    };
    assert_eq!(write("0 [N m]")["one_of_a_family"], Value::Bool(true));
    // van der Pol's damping singles out one amplitude
    assert_eq!(write("2 [N m s]*(1 - phi^2)*phi'")["one_of_a_family"], Value::Bool(false));
}

/// Models whose numbers overflow in each study, by its command.
const OVERFLOWING: [(&str, &[&str], &str); 12] = [
    ("modes", &[], OSCILLATOR),
    ("response", &[], OSCILLATOR),
    ("equilibrium", &[], OSCILLATOR),
    ("simulate", &["--until", "1"], OSCILLATOR),
    ("transient", &["--until", "1"], OSCILLATOR),
    ("run", &[], OSCILLATOR),
    ("periodic", &[], OSCILLATOR),
    ("sweep", &[], OSCILLATOR),
    ("kinematics", &[], CRANK),
    ("cycle", &[], WHEEL),
    ("inverse", &[], CRANK),
    ("statics", &[], HELD),
];

const OSCILLATOR: &str = r#"
[parameters]
m = "1 kg"
c = "1 N/m"
k = "1 N/m"
p = "0.7 rad/s"
[coordinates]
x = { unit = "m", start = "c/k*1 [m]" }
[bodies.a]
origin = ["x", "0"]
mass = "m"
[springs]
s = { along = "x", stiffness = "c*c/k" }
[forces]
f = { along = "x", value = "c*1 [m]*c/k*sin(p*t)" }
[[study]]
kind = "modes"
[[study]]
kind = "sweep"
of = "simulate"
over = "p = linspace(1 rad/s, 2 rad/s, 2)"
observe = ["max(x)"]
[[study]]
kind = "simulate"
until = "1 s"
[[study]]
kind = "periodic"
period = "2*pi/p"
"#;

const CRANK: &str = r#"
[parameters]
c = "1 m"
k = "1 m"
M = "1 N m"
[coordinates]
a = { unit = "rad", start = "0", rate = "1 rad/s" }
[bodies.crank]
angle = "a"
inertia = "1 kg m^2"
[torques.t]
on = "crank"
value = "M*cos(a)*c/k*c/k"
[motions.turning]
on = "crank"
rate = "1 [rad/s]"
[motors.drive]
on = "crank"
[outputs]
far = "c*c/k*c/k"
[[study]]
kind = "kinematics"
over = "a"
turns = 1
[[study]]
kind = "inverse"
until = "1 s"
"#;

const WHEEL: &str = r#"
[parameters]
c = "1 N m"
k = "1 N m"
[coordinates]
a = { unit = "rad", start = "0", rate = "1 rad/s" }
[bodies.crank]
angle = "a"
inertia = "1 kg m^2"
[torques.t]
on = "crank"
value = "cos(a)*c*c/k*c/k"
[[study]]
kind = "cycle"
angle = "a"
"#;

const HELD: &str = r#"
[parameters]
c = "1 N"
k = "1 N"
[bodies.a]
origin = ["0", "0"]
[supports.A]
at = "a"
directions = ["x", "y"]
[forces.f]
at = "a"
value = ["c*c/k*c/k", "0"]
"#;

#[test]
fn no_study_leaves_a_number_without_a_value_with_exit_0() {
    let place = folder("overflow");
    for (command, more, text) in OVERFLOWING {
        let model = place.join("model.toml");
        std::fs::write(&model, text).unwrap();
        let unit =
            |name: &str| text.lines().find_map(|l| l.strip_prefix(&format!("{name} = \"1 "))).unwrap().trim_end_matches('"').to_owned();
        let mut plain = strutt();
        plain.current_dir(&place).args([command, model.to_str().unwrap()]).args(more).assert().success();
        for set in [["c=1e200", "k=1e-200"], ["c=1e-300", "k=1e300"], ["c=1e300", "k=1"]] {
            let mut run = strutt();
            run.current_dir(&place).args([command, model.to_str().unwrap()]).args(more);
            set.iter().for_each(|s| {
                let name = &s[..1];
                run.args(["--set", &format!("{s} {}", unit(name))]);
            });
            let output = run.arg("--json").output().unwrap();
            assert!(matches!(output.status.code(), Some(0..=2)), "{command} {set:?}");
            if output.status.code() != Some(0) {
                continue;
            }
            let value: Value = serde_json::from_slice(&output.stdout).unwrap();
            let studies = value["studies"].as_array().cloned().unwrap_or_else(|| vec![value.clone()]);
            for study in &studies {
                let stated: Vec<&str> = study["stated"].as_array().into_iter().flatten().filter_map(|s| s["name"].as_str()).collect();
                for (name, column) in study["columns"].as_object().into_iter().flatten() {
                    let whole = column["values"].as_array().unwrap().iter().all(|v| v.is_number());
                    assert!(whole || stated.contains(&name.as_str()), "{command} {set:?}: {name} without a value: {column}");
                }
            }
        }
    }
}
