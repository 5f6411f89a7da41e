//! `strutt inverse` and `strutt statics` from the command line.

use crate::common;

use common::{folder, gallery, stderr, stdout, strutt, table};
use serde_json::Value;

/// Work of motors and what it lifts: two quadratures along one motion.
const WORK: f64 = 1e-11;
/// The same for motors that work against each other: ten times what is left.
const COUPLED: f64 = 1e-10;
/// Digits of the values here.
const PUBLISHED: f64 = 1e-9;

/// A load of 4 kg on a circle of 0.2 m, carried by two massless links with a motor in each joint.
const ARM: &str = r#"
[coordinates]
q1 = { unit = "rad", guess = "1 rad" }
q2 = { unit = "rad", guess = "-0.5 rad" }
[bodies.upper]
angle = "q1"
[bodies.lower]
origin = "E"
angle = "q2"
mass = "4 kg"
center = ["0.6 m", "0"]
[points]
E = { on = "upper", at = ["0.8 m", "0"] }
P = { on = "lower", at = ["0.6 m", "0"] }
[motions.x]
along = "x(P)"
value = "0.9 [m] + 0.2 [m]*cos(2 [rad/s]*t)"
[motions.y]
along = "y(P)"
value = "0.3 [m] + 0.2 [m]*sin(2 [rad/s]*t)"
[motors.shoulder]
on = "upper"
[motors.elbow]
between = ["upper", "lower"]
[outputs]
M1 = "force(shoulder)"
[[study]]
kind = "inverse"
until = "1 s"
"#;

fn json(command: &mut assert_cmd::Command) -> Value {
    serde_json::from_str(&stdout(command.arg("--json"))).unwrap()
}

/// The speed is constant, so the work of both motors lifts the load: m g 0.2 sin 2.
#[test]
fn the_work_of_all_motors_is_the_gain_of_energy() {
    let path = folder("inverse-arm").join("model.toml");
    std::fs::write(&path, ARM).unwrap();
    let value = json(strutt().arg("inverse").arg(&path));
    let work = value["work"].as_object().unwrap();
    assert_eq!(work.keys().collect::<Vec<_>>(), ["shoulder", "elbow"]);
    let sum: f64 = work.values().map(|w| w.as_f64().unwrap()).sum();
    let lifted = 4.0 * 9.81 * 0.2 * 2.0_f64.sin();
    assert!((sum - lifted).abs() < WORK * lifted, "{sum} {lifted}");
    assert_eq!(value["work(elbow)"], value["work"]["elbow"]);
}

/// The load of the manipulator ends where the lift by 2 v/p ended, at rest: the motors did m g times that.
#[test]
fn the_manipulator_lifts_its_load() {
    let value = json(strutt().args(["inverse", &gallery("manipulator")]));
    let sum: f64 = ["B", "D"].iter().map(|motor| value["work"][motor].as_f64().unwrap()).sum();
    let lifted = 17.0 * 9.81 * 2.0 * (std::f64::consts::PI / 7.0) / (std::f64::consts::PI / 1.68);
    assert!((sum - lifted).abs() < COUPLED * lifted, "{sum} {lifted}");
}

#[test]
fn the_table_has_the_asked_columns() {
    let csv = stdout(strutt().args(["inverse", &gallery("manipulator"), "--at", "0.56", "--outputs", "M_B,N_B", "--csv"]));
    let (head, rows) = table(&csv);
    // the plotted quantities follow
    assert_eq!(head[..3], ["t [s]", "M_B [N m]", "N_B [W]"]);
    assert!((rows[0][1] + 80.966_583_372_4).abs() < PUBLISHED, "{rows:?}");
}

#[test]
fn a_missing_motor_is_an_error_with_the_names() {
    let path = folder("inverse-missing").join("model.toml");
    std::fs::write(&path, ARM.replace("[motors.elbow]\nbetween = [\"upper\", \"lower\"]\n", "")).unwrap();
    let text = stderr(strutt().arg("inverse").arg(&path), 1);
    assert!(text.contains("M105") && text.contains("shoulder"), "{text}");
}

/// X = F sin 30°, and what the beams weigh on the clamp.
#[test]
fn statics_gives_reactions_and_degrees() {
    let value = json(strutt().args(["statics", &gallery("composite-beam")]));
    assert_eq!((value["indeterminacy"].as_u64(), value["mobility"].as_u64()), (Some(0), Some(0)));
    let of = |name: &str| value[name].as_f64().unwrap();
    assert!((of("force_x(A)") - 5000.0).abs() < PUBLISHED && (of("force_y(A)") - 14_830.127_018_922_193).abs() < PUBLISHED);
    assert!(value["reactions"].as_array().unwrap().iter().all(|r| r["unit"].is_string()));
}

/// Rows at switches are those of the same motion, jumps and their impulses included.
#[test]
fn rows_at_events_and_switches_are_those_of_simulate() {
    let path = folder("inverse-switches").join("model.toml");
    let model = "[coordinates]\np = \"rad\"\n[bodies.arm]\nangle = \"p\"\nmass = \"2 kg\"\ncenter = [\"0.3 m\", 0]\ninertia = \"0.1 kg m^2\"\n\
        [motions.p]\nalong = \"p\"\nrate = \"if(t < 0.5 [s], 1 [rad/s], 2 [rad/s])\"\n[motors.P]\nalong = \"p\"\n[outputs]\nM = \"force(P)\"\n\
        [[study]]\nkind = \"inverse\"\nuntil = \"1 s\"\nevery = \"0.25 s\"\noutputs = [\"p\", \"M\"]\n";
    std::fs::write(&path, model).unwrap();
    for option in ["--events", "--switches"] {
        let [asked, usual] = ["inverse", "simulate"].map(|study| stdout(strutt().arg(study).arg(&path).args([option, "--csv"])));
        assert_eq!(asked, usual, "{option}");
        // rows at events name them with their impulses
        assert_eq!(asked.contains("force(P) = 0.28 N m s"), option == "--events", "{asked}");
    }
    let plain = stdout(strutt().arg("inverse").arg(&path).arg("--csv"));
    assert_ne!(plain, stdout(strutt().arg("inverse").arg(&path).args(["--switches", "--csv"])));
}

/// A study of its own kind is that of a command, wherever others stand in the file: the work is that of a quarter, half or whole of the motion.
#[test]
fn each_command_takes_the_study_of_its_name() {
    let model = |studies: [(&str, &str); 2]| {
        let list: String = studies.iter().map(|(kind, until)| format!("[[study]]\nkind = \"{kind}\"\nuntil = \"{until}\"\n")).collect();
        format!(
            "gravity = false\n[coordinates]\nx = \"m\"\n[bodies.cart]\norigin = [\"x\", \"0\"]\nmass = \"2 kg\"\n[motions.x]\nalong = \"x\"\n\
             value = \"1 [m/s^2]*t^2/2\"\n[motors.drive]\nalong = \"x\"\n{list}"
        )
    };
    let path = folder("inverse-beside").join("model.toml");
    let both = [("simulate", "2 s"), ("inverse", "0.5 s")];
    for studies in [both, [both[1], both[0]]] {
        std::fs::write(&path, model(studies)).unwrap();
        // m v²/2 with v = t
        let inverse = json(strutt().arg("inverse").arg(&path));
        assert!((inverse["work"]["drive"].as_f64().unwrap() - 0.25).abs() < WORK, "{inverse}");
        let (_, rows) = table(&stdout(strutt().arg("simulate").arg(&path).args(["--csv", "--outputs", "x"])));
        assert!((rows[rows.len() - 1][0] - 2.0).abs() < WORK, "{rows:?}");
    }
}
