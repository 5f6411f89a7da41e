//! Maps: boundaries against closed forms, the same bytes for any number of threads and after a cut, places without a result, what cannot be mapped.

use crate::common::{folder, gallery, strutt};
use std::fs;
use std::path::{Path, PathBuf};

/// A free mass on a spring: it reaches v √(m/c).
const SPRING: &str = r#"
gravity = false
[parameters]
c = "25 N/m"
far = "0.25 m"
[coordinates]
x = { unit = "m", rate = "1 m/s" }
[bodies.b]
origin = ["x", "0"]
mass = "1 kg"
[springs.s]
along = "x"
stiffness = "c"
[outputs]
root = "sqrt(c/1 [N/m] - 5)*x/1 [m]"
[regimes]
near = "max(x, 0 s, 4 s) < far"
beyond = "max(x, 0 s, 4 s) >= far"
[[study]]
kind = "simulate"
until = "4 s"
tolerance = 1e-10
"#;
const MAP: [&str; 8] = ["map", "m.toml", "--x", "c=4 N/m..36 N/m", "--y", "x'=0.4 m/s..2 m/s", "--cells", "10"];

fn here(name: &str) -> PathBuf {
    let here = folder(name);
    fs::write(here.join("m.toml"), SPRING).unwrap();
    here
}

/// Points of `map-boundaries.csv`: x, y, left, right.
fn boundaries(folder: &Path) -> Vec<(f64, f64, String, String)> {
    let text = fs::read_to_string(folder.join("map-boundaries.csv")).unwrap();
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        (cells[1].parse().unwrap(), cells[2].parse().unwrap(), cells[3].to_owned(), cells[4].to_owned())
    };
    text.lines().skip(1).map(row).collect()
}

#[test]
fn a_boundary_lies_on_its_closed_form() {
    let here = here("map-boundary");
    strutt().current_dir(&here).args(MAP).args(["--regimes", "--accuracy", "1e-7", "--out", "out"]).assert().code(0);
    let points = boundaries(&here.join("out"));
    assert!(points.len() > 80, "{}", points.len());
    for (c, v, left, right) in &points {
        // 1e-7 of the longer range along an edge of either direction
        assert!((v - 0.25 * c.sqrt()).abs() < 1e-7 * 32.0 * 0.125 + 1e-7 * 1.5, "{c} {v}");
        // one side each
        assert_eq!([left.as_str(), right.as_str()].iter().filter(|name| **name == "near").count(), 1);
    }
    // near is met first, at the lower left: it lies on the left of its boundary, which runs with falling c
    assert!(points[0].2 == "near" && points[0].0 > points[points.len() - 1].0, "{:?}", points[0]);
    let page = fs::read_to_string(here.join("out/index.html")).unwrap();
    assert!(page.contains("data-field=") && page.contains("strutt simulate m.toml"));
    let table = fs::read_to_string(here.join("out/map.csv")).unwrap();
    assert!(table.lines().next().unwrap().ends_with(",regime"), "{}", table.lines().next().unwrap());
    // far fewer places of the lattice than it has
    let data: serde_json::Value = serde_json::from_slice(&fs::read(here.join("out/map.json")).unwrap()).unwrap();
    assert!(data["nodes"].as_f64().unwrap() < 81.0 * 81.0 / 4.0, "{}", data["nodes"]);
}

#[test]
fn a_map_is_the_same_for_any_number_of_threads_and_cut_anywhere() {
    let here = here("map-cut");
    let run = |out: &str, more: &[&str]| {
        let done = strutt().current_dir(&here).args(MAP).args(["--regimes", "--refine", "1", "--out", out]).args(more).output().unwrap();
        (done.status.code(), String::from_utf8(done.stderr).unwrap())
    };
    assert_eq!(run("whole", &["--threads", "1"]).0, Some(0));
    assert_eq!(run("three", &["--threads", "3"]).0, Some(0));
    let files = ["map.csv", "map-boundaries.csv", "map.json", "map.svg", "index.html"];
    let same = |out: &str| {
        files
            .iter()
            .for_each(|f| assert_eq!(fs::read(here.join("whole").join(f)).unwrap(), fs::read(here.join(out).join(f)).unwrap(), "{out}/{f}"))
    };
    same("three");
    assert!(!here.join("whole/map.rows").exists());
    // a kill leaves the beginning of the rows
    let rows = kept(&here);
    for length in (0..rows.len()).step_by(1 + rows.len() / 3).chain([rows.len() - 1]) {
        let _ = fs::remove_dir_all(here.join("again"));
        fs::create_dir_all(here.join("again")).unwrap();
        fs::write(here.join("again/map.rows"), &rows[..length]).unwrap();
        assert_eq!(run("again", &["--resume", "--threads", "2"]).0, Some(0), "cut at {length}");
        same("again");
    }
    fs::create_dir_all(here.join("other")).unwrap();
    fs::write(here.join("other/map.rows"), &rows).unwrap();
    assert!(run("other", &["--resume", "--set", "far=0.3 m"]).1.contains("S148"));
    assert!(run("other", &["--resume", "--accuracy", "1e-2"]).1.contains("S148"));
    assert_eq!(fs::read(here.join("other/map.rows")).unwrap(), rows);
}

/// The rows of a finished run: a folder stands where the table should be written, so that they stay.
fn kept(here: &Path) -> Vec<u8> {
    fs::create_dir_all(here.join("kept/map.csv/in-the-way")).unwrap();
    let done = strutt().current_dir(here).args(MAP).args(["--regimes", "--refine", "1", "--out", "kept"]).output().unwrap();
    assert_ne!(done.status.code(), Some(0));
    fs::read(here.join("kept/map.rows")).unwrap()
}

#[test]
fn places_without_a_result_are_rows_with_their_reason_and_a_region_of_their_own() {
    let here = here("map-failed");
    let done = strutt()
        .current_dir(&here)
        .args(MAP)
        .args(["--observe", "max(root, 0 s, 4 s)", "--level", "0.2", "--out", "out"])
        .output()
        .unwrap();
    assert_eq!(done.status.code(), Some(1), "{}", String::from_utf8_lossy(&done.stderr));
    let table = fs::read_to_string(here.join("out/map.csv")).unwrap();
    let failed: Vec<&str> = table.lines().skip(1).filter(|line| line.contains("no result,")).collect();
    assert!(!failed.is_empty() && failed.iter().all(|line| line.contains('[')), "{failed:?}");
    // the region without a result ends at c = 5 N/m, whatever the rate is
    let edge: Vec<f64> =
        boundaries(&here.join("out")).into_iter().filter(|p| p.2 == "no result" || p.3 == "no result").map(|p| p.0).collect();
    // a thousandth of the range of 32 N/m; the line of the level meets it in a place that is known to a finest cell
    let off = edge.iter().filter(|c| (**c - 5.0).abs() > 0.032).count();
    assert!(edge.len() > 20 && off <= 2, "{edge:?}");
    let pictures = fs::read_dir(here.join("out")).unwrap().filter(|e| e.as_ref().unwrap().path().extension().is_some_and(|e| e == "svg"));
    assert_eq!(pictures.count(), 1);
}

#[test]
fn boundaries_of_mathieus_equation_are_its_characteristic_values() {
    let here = folder("map-mathieu");
    let args = [
        "--of",
        "stability",
        "--x",
        "d=0.2..2",
        "--y",
        "e=0.2..0.5",
        "--set",
        "h=0",
        "--cells",
        "3",
        "--refine",
        "0",
        "--accuracy",
        "1e-5",
    ];
    strutt().current_dir(&here).args(["map", &gallery("mathieu")]).args(args).args(["--out", "out"]).assert().code(0);
    let points = boundaries(&here.join("out"));
    // b1 and a1 at e = 0.2, 0.4, 0.5 by scipy.special.mathieu_b, mathieu_a
    let known = [
        (0.2, [0.795_123_868_083_863_2, 1.194_874_059_204_461_5]),
        (0.4, [0.580_980_607_172_115_1, 1.378_986_736_961_652_2]),
        (0.5, [0.470_654_354_933_838_9, 1.466_766_842_556_051_6]),
    ];
    for (e, values) in known {
        for value in values {
            // a place of the lattice, but for its rounding
            let nearest = points.iter().filter(|p| (p.1 - e).abs() < 1e-12).map(|p| (p.0 - value).abs()).fold(f64::INFINITY, f64::min);
            // half of 1e-5 of the range of 1.8
            assert!(nearest < 1e-5, "{e} {value}: off by {nearest}");
        }
    }
    let picture = fs::read_to_string(here.join("out/map.svg")).unwrap();
    assert!(picture.contains(">unstable<"), "hatching has its entry");
}

#[test]
fn what_is_no_map_is_refused() {
    let here = here("no-map");
    for (args, code) in [
        (&["--x", "c=4 N/m..36 N/m", "--y", "c=4 N/m..36 N/m", "--regimes"][..], "M379"),
        (&["--x", "c=4 N/m..36 N/m", "--y", "x'=0.5 m/s..2 m/s", "--regimes", "--cells", "2000"], "M379"),
        (&["--x", "c=4 N/m..36 N/m", "--y", "x'=0.5 m/s..2 m/s", "--regimes", "--refine", "40"], "M379"),
        (&["--x", "c=4 N/m..36 N/m", "--y", "x'=0.5 m/s..2 m/s", "--level", "1 m"], "M379"),
        (&["--x", "c=36 N/m..4 N/m", "--y", "x'=0.5 m/s..2 m/s", "--regimes"], "M070"),
        (&["--x", "q=4 N/m..36 N/m", "--y", "x'=0.5 m/s..2 m/s", "--regimes"], "M068"),
        (&["--x", "c=4 m..36 m", "--y", "x'=0.5 m/s..2 m/s", "--regimes"], "M024"),
        (&["--regimes"], "C033"),
    ] {
        let done = strutt().current_dir(&here).args(["map", "m.toml"]).args(args).output().unwrap();
        let text = String::from_utf8_lossy(&done.stderr);
        assert!(done.status.code() != Some(0) && text.contains(code), "{args:?}: {text}");
    }
}
