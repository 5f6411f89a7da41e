//! The command line as other programs see it: exit codes, streams, files.

use crate::common;

use common::{folder, gallery, stderr, stdout, strutt};
use predicates::prelude::*;
use predicates::str::{contains, is_empty};

/// All digits are printed: what is left is rounding.
const PRINTED: f64 = 1e-12;
/// A table of a motion, of another file by far more.
const TABLE: f64 = 1e-9;

#[test]
fn help_starts_with_three_commands_and_states_the_exit_codes() {
    let help = stdout(strutt().arg("--help"));
    let first: Vec<&str> = help.lines().skip(1).take(3).map(|l| l.split_whitespace().next().unwrap()).collect();
    assert_eq!(first, ["strutt"; 3], "{help}");
    assert!(help.contains("Exit codes: 0 done"), "{help}");
}

#[test]
fn wrong_use_has_code_2_and_says_nothing_on_stdout() {
    for arguments in [&["run"][..], &["fly"], &["check", "a.toml", "--form", "x"], &["simulate", "a.toml", "--at", "1", "--every", "1"]] {
        strutt().args(arguments).assert().code(2).stdout(is_empty()).stderr(is_empty().not());
    }
    strutt().arg("simulte").assert().code(2).stderr(contains("'simulate'"));
}

#[test]
fn a_missing_file_is_wrong_use_and_the_nearest_is_named() {
    let text = stderr(strutt().args(["check", &gallery("pendulum-on-shaf")]), 2);
    assert!(text.contains("C001") && text.contains("pendulum-on-shaft"), "{text}");
    let here = folder("missing");
    std::fs::write(here.join("wheel.toml"), "").unwrap();
    let text = stderr(strutt().current_dir(&here).args(["check", "whel.toml"]), 2);
    assert!(text.contains("did you mean `wheel.toml`?"), "{text}");
}

#[test]
fn a_folder_stands_for_the_model_in_it_and_a_dash_for_stdin() {
    let model = gallery("top");
    strutt().args(["check", model.trim_end_matches("/model.toml")]).assert().success();
    let text = std::fs::read_to_string(&model).unwrap();
    strutt().args(["check", "-"]).write_stdin(text).assert().success().stdout(contains("stdin: ok"));
}

#[test]
fn files_that_are_no_text_are_refused() {
    let here = folder("no-text");
    std::fs::write(here.join("a.toml"), b"title = \"\xcc\xe0\xff\xf2\xed\xe8\xea\"").unwrap();
    let text = stderr(strutt().current_dir(&here).args(["check", "a.toml", "--lang", "ru"]), 1);
    assert!(text.contains("C004") && text.contains("1251"), "{text}");
    std::fs::write(here.join("b.toml"), vec![b'#'; 5 << 20]).unwrap();
    let text = stderr(strutt().current_dir(&here).args(["check", "b.toml"]), 1);
    assert!(text.contains("C003"), "{text}");
    strutt().current_dir(&here).args(["check", "."]).assert().code(2).stderr(contains("model.toml"));
}

#[test]
fn every_model_of_the_gallery_is_clean() {
    for name in strutt::gallery::names() {
        strutt().args(["check", &gallery(name)]).assert().success().stdout(contains(": ok: bodies")).stderr(contains("warning").not());
        strutt().args(["check", &gallery(name), "--lang", "ru", "--quiet"]).assert().success().stdout(contains("модель верна")).stderr("");
    }
}

#[test]
fn every_folder_of_the_gallery_is_embedded() {
    let root = format!("{}/../../gallery", env!("CARGO_MANIFEST_DIR"));
    for entry in std::fs::read_dir(root).unwrap().flatten() {
        if let Ok(text) = std::fs::read_to_string(entry.path().join("model.toml")) {
            let name = entry.file_name().to_string_lossy().into_owned();
            assert_eq!(strutt::gallery::find(&name).map(|e| e.text), Some(text.as_str()), "{name}");
        }
    }
}

#[test]
fn all_findings_come_at_once_with_the_users_lines() {
    let here = folder("findings");
    let text = "[parameters]\nm = \"2 kgg\"\nk = \"m + q\"\n[coordinates]\nx = { unit = \"m\" }\n[bodies.b]\norigin = [\"x\", \"0\"]\nmas = \"m\"\n";
    std::fs::write(here.join("a.toml"), text).unwrap();
    let found = stderr(strutt().current_dir(&here).args(["check", "a.toml"]), 1);
    for part in ["m = \"2 kgg\"", "k = \"m + q\"", "mas = \"m\"", "mass", "^", "a.toml:2:", "a.toml:3:", "strutt explain"] {
        assert!(found.contains(part), "{part}\n{found}");
    }
    let short = strutt().current_dir(&here).args(["check", "a.toml", "--format", "short"]).assert().code(1).get_output().stdout.clone();
    let short = String::from_utf8(short).unwrap();
    assert!(short.lines().count() >= 3 && short.lines().all(|l| l.starts_with("a.toml:") && l.contains(": error[M")), "{short}");
    let json = strutt().current_dir(&here).args(["check", "a.toml", "--json"]).assert().code(1).get_output().stdout.clone();
    let json: serde_json::Value = serde_json::from_slice(&json).unwrap();
    assert_eq!(json["ok"], false);
    assert_eq!(json["findings"].as_array().unwrap().len(), short.lines().count());
    assert_eq!(json["findings"][0]["place"]["line"], 2);
}

#[test]
fn colours_are_for_terminals() {
    strutt().args(["check", "/nowhere"]).env("TERM", "xterm-256color").assert().stderr(contains("\u{1b}").not());
}

#[test]
fn new_writes_running_models_and_never_overwrites() {
    let here = folder("new");
    for name in strutt::gallery::names().chain(["something"]) {
        strutt().current_dir(&here).args(["new", name]).assert().success();
        strutt().current_dir(&here).args(["check", &format!("{name}.toml")]).assert().success();
    }
    std::fs::write(here.join("mine.toml"), "mine").unwrap();
    strutt().current_dir(&here).args(["new", "mine"]).assert().code(1).stderr(contains("C006"));
    assert_eq!(std::fs::read_to_string(here.join("mine.toml")).unwrap(), "mine");
    strutt().current_dir(&here).args(["new", "chain", "--from", "n-pendulum", "--count", "3"]).assert().success();
    strutt().current_dir(&here).args(["check", "chain.toml"]).assert().success().stdout(contains("bodies 3, coordinates 3"));
    strutt().current_dir(&here).args(["new", "x", "--from", "topp"]).assert().code(2).stderr(contains("`top`"));
    strutt().current_dir(&here).args(["new", "n-pendulum2", "--from", "n-pendulum", "--count", "0"]).assert().code(2);
}

#[test]
fn examples_are_listed_and_printed_byte_for_byte() {
    let list = stdout(strutt().args(["examples", "--lang", "ru"]));
    for name in strutt::gallery::names() {
        assert!(list.lines().any(|l| l.starts_with(name) && l.chars().any(|c| ('а'..='я').contains(&c))), "{name}\n{list}");
    }
    assert_eq!(stdout(strutt().args(["examples", "top"])), strutt::gallery::find("top").unwrap().text);
    strutt().args(["examples", "oscilator"]).assert().code(2).stderr(contains("oscillator"));
}

#[test]
fn every_code_is_explained_in_both_languages() {
    let list = stdout(strutt().arg("explain"));
    for e in strutt::explain::all() {
        assert!(list.contains(e.code));
        strutt().args(["explain", e.code]).assert().success().stdout(contains(e.title.0));
        strutt().args(["explain", e.code, "--lang", "ru"]).assert().success().stdout(contains(e.title.1));
    }
    strutt().args(["explain", "Z999"]).assert().code(2).stderr(contains("Z999"));
}

#[test]
fn the_locale_chooses_the_language_and_lang_overrides_it() {
    strutt().env("LC_ALL", "ru_RU.UTF-8").args(["check", &gallery("top")]).assert().stdout(contains("модель верна"));
    strutt().env("LC_ALL", "ru_RU.UTF-8").args(["check", &gallery("top"), "--lang=en"]).assert().stdout(contains(": ok:"));
    strutt().env_remove("LC_ALL").env_remove("LC_MESSAGES").env("LANG", "ru").arg("fly").assert().code(2).stderr(contains("нет команды"));
}

#[test]
fn completions_are_printed() {
    for shell in ["bash", "zsh", "fish", "powershell"] {
        strutt().args(["completions", shell]).assert().success().stdout(contains("simulate"));
    }
}

#[test]
fn results_never_replace_what_they_are_made_of() {
    let here = folder("inputs");
    let model = "gravity = false\n[parameters]\nm = \"1 kg\"\n[coordinates]\nx = { unit = \"m\", rate = \"1 m/s\" }\n[bodies.b]\norigin = [\"x\", 0]\n\
                 mass = \"m\"\n[variants]\ntable = \"motion.csv\"\n[[study]]\nkind = \"simulate\"\nuntil = \"1 s\"\n";
    let table = "variant,m\n1,2\n";
    std::fs::write(here.join("index.html"), model).unwrap();
    std::fs::write(here.join("motion.csv"), table).unwrap();
    let before = std::fs::read_dir(&here).unwrap().count();
    for out in [".", "../inputs"] {
        let text = stderr(strutt().current_dir(&here).args(["run", "index.html", "--variant", "1", "--out", out]), 1);
        assert!(text.contains("C052") && text.contains("motion.csv"), "{text}");
    }
    std::fs::rename(here.join("motion.csv"), here.join("masses.csv")).unwrap();
    std::fs::write(here.join("index.html"), model.replace("motion.csv", "masses.csv")).unwrap();
    let text = stderr(strutt().current_dir(&here).args(["simulate", "index.html", "--out", "."]), 1);
    assert!(text.contains("C052") && text.contains("index.html"), "{text}");
    assert_eq!(std::fs::read_to_string(here.join("masses.csv")).unwrap(), table);
    assert!(std::fs::read_to_string(here.join("index.html")).unwrap().starts_with("gravity"));
    assert_eq!(std::fs::read_dir(&here).unwrap().count(), before, "half of the results was written");
    strutt().current_dir(&here).args(["run", "index.html", "--out", "results"]).assert().success();
}

#[test]
fn runs_into_one_folder_leave_the_results_of_one() {
    let here = folder("at-once");
    std::fs::write(
        here.join("a.toml"),
        "gravity = false\n[parameters]\nm = \"1 kg\"\n[coordinates]\nx = { unit = \"m\", rate = \"1 m/s\" }\n[bodies.b]\norigin = [\"x\", 0]\nmass = \"m\"\n\
         [springs.c]\nalong = \"x\"\nstiffness = \"1 N/m\"\n[[study]]\nkind = \"simulate\"\nuntil = \"1 s\"\nplot = [\"x\"]\n",
    )
    .unwrap();
    let run = |m: usize| {
        let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin!("strutt"));
        command.current_dir(&here).args(["-q", "run", "a.toml", "--out", "two", "--set", &format!("m={m} kg")]);
        command.stdout(std::process::Stdio::null()).spawn().unwrap()
    };
    let runs: Vec<_> = (1..=4).map(run).collect();
    for mut child in runs {
        assert!(child.wait().unwrap().success());
    }
    let last = |name: &str| std::fs::read_to_string(here.join("two").join(name)).unwrap();
    let json: serde_json::Value = serde_json::from_str(&last("motion.json")).unwrap();
    let m = json["parameters"]["m"]["value"].as_f64().unwrap();
    let (_, rows) = common::table(&last("motion.csv"));
    let (t, x) = (rows.last().unwrap()[0], rows.last().unwrap()[1]);
    // x = √m sin(t/√m)
    assert!((x - m.sqrt() * (t / m.sqrt()).sin()).abs() < TABLE, "the table is of another m than {m}");
    let hash = json["model_hash"].as_str().unwrap();
    assert!(last("index.html").contains(hash), "the page is of another m than {m}");
    let names = std::fs::read_dir(here.join("two")).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned());
    assert!(names.into_iter().all(|n| !n.contains("strutt-")), "parts are left");
}

#[test]
fn options_that_would_change_nothing_are_refused() {
    let wheel = gallery("crank-hoist");
    let slip = gallery("stick-slip");
    for arguments in [&["cycle", &wheel, "--flywheel", "nosuchname"][..], &["periodic", &slip, "--turns", "2"]] {
        let text = stderr(strutt().args(arguments), 2);
        assert!(text.contains("C054"), "{arguments:?}: {text}");
    }
    let rotor = gallery("gyroscopic-rotor");
    for arguments in [
        &["periodic", &slip, "--settle=-1"][..],
        &["modes", &rotor, "--over", "Omega", "--range", "0,600", "--points", "0"],
        &["modes", &rotor, "--points", "5"],
    ] {
        strutt().args(arguments).assert().code(2);
    }
}

#[test]
fn what_cannot_move_or_is_not_driven_has_a_code() {
    let beam = gallery("composite-beam");
    for (verb, code) in [("simulate", "S084"), ("transient", "S084"), ("inverse", "S101")] {
        let text = stderr(strutt().args([verb, &beam, "--until", "0.2s"]), 1);
        assert!(text.contains(code) && !text.contains("check failed"), "{verb}: {text}");
    }
    let text = stderr(strutt().args(["response", &beam]), 1);
    assert!(text.contains("S084"), "{text}");
}

#[test]
fn russian_troubles_have_russian_causes() {
    let here = folder("causes");
    std::fs::write(here.join("file"), "").unwrap();
    let top = gallery("top");
    let text = stderr(strutt().current_dir(&here).args(["--lang", "ru", "run", &top, "--out", "file/x"]), 1);
    assert!(text.contains("C005") && text.contains("стоит файл") && !text.contains("os error"), "{text}");
    let text = stderr(strutt().current_dir(&here).args(["--lang", "ru", "check", "file/x.toml"]), 1);
    assert!(text.contains("C002") && text.contains("стоит файл") && !text.contains("os error"), "{text}");
    for name in ["", " ", ".", "a/"] {
        let text = stderr(strutt().current_dir(&here).args(["new", name]), 2);
        assert!(text.contains("C053"), "{name}: {text}");
    }
}

#[test]
fn values_of_unknowns_are_told_by_statics() {
    let here = folder("unknowns");
    let model = "[unknowns]\nm = \"1 kg\"\n[coordinates]\ny = \"m\"\n[bodies.b]\norigin = [0, \"y\"]\nmass = \"m\"\n[springs.c]\nalong = \"y\"\n\
                 stiffness = \"98.1 N/m\"\nrest = \"0.5 m\"\n[supports.a]\nat = \"b\"\ndirections = [\"x\"]\n[[study]]\nkind = \"statics\"\n";
    std::fs::write(here.join("m.toml"), model).unwrap();
    // 98.1·0.5 = 9.81 m
    let text = stdout(strutt().current_dir(&here).args(["statics", "m.toml"]));
    assert!(text.contains("found from statics: m = "), "{text}");
}

#[test]
fn reactions_that_the_coordinates_hide_are_not_called_open_at_rest() {
    let here = folder("hidden-at-rest");
    let model = "[coordinates]\ns = \"m\"\ny = { unit = \"m\", start = \"0.3 m\" }\np = \"rad\"\n[bodies.cart]\norigin = [\"s\", \"y\"]\nmass = \"900 kg\"\n[points]\nA = { on = \"cart\", at = [0, 0] }\n\
                 [bodies.wheel]\norigin = \"A\"\nangle = \"p\"\nmass = \"60 kg\"\ninertia = \"1 kg m^2\"\n[rolling.K]\nbody = \"wheel\"\nradius = \"0.3 m\"\n\
                 [supports.O]\nat = \"wheel\"\ndirections = [\"x\", \"y\"]\n[frictions.k]\nalong = \"s\"\nkinetic = \"20 N\"\n\
                 [forces.f]\nalong = \"s\"\nvalue = \"5 N\"\n";
    std::fs::write(here.join("m.toml"), model).unwrap();
    let output = strutt().current_dir(&here).args(["equilibrium", "m.toml"]).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    // the axle carries 900·9.81 N
    assert!(text.contains("8829") && !text.contains('∞') && !text.contains("not determine"), "{text}");
}

#[test]
fn a_response_says_where_the_free_motion_grows() {
    let here = folder("growing");
    // internal damping d_i, external d_e = 2 d_i: a rotor of natural frequency 10 rad/s is unstable from 10 (1 + d_e/d_i) = 30 rad/s
    let model = "gravity = false\n[parameters]\nW = \"20 rad/s\"\nde = \"1 N s/m\"\ndi = \"0.5 N s/m\"\nk = \"100 N/m\"\n[coordinates]\nx = \"m\"\ny = \"m\"\n\
                 [bodies.b]\norigin = [\"x\", \"y\"]\nmass = \"1 kg\"\n[forces]\nfx = { along = \"x\", value = \"-k*x - (de + di)*x' - di*W*y + 1 [N]*cos(W*t)\" }\n\
                 fy = { along = \"y\", value = \"-k*y - (de + di)*y' + di*W*x + 1 [N]*sin(W*t)\" }\n[[study]]\nkind = \"response\"\nover = \"W\"\n";
    std::fs::write(here.join("m.toml"), model).unwrap();
    let text = stdout(strutt().current_dir(&here).args(["response", "m.toml", "--range", "15,50", "--json"]));
    assert!(text.contains("unstable for W = 30"), "{text}");
    let text = stdout(strutt().current_dir(&here).args(["response", "m.toml", "--range", "15,29", "--json"]));
    assert!(!text.contains("unstable for"), "{text}");
}

#[test]
fn over_on_the_command_line_keeps_what_the_file_observes() {
    let here = folder("sweep");
    let model = "gravity = false\n[parameters]\nv = \"1 m/s\"\n[coordinates]\nx = { unit = \"m\", rate = \"v\" }\n[bodies.b]\norigin = [\"x\", 0]\nmass = \"1 kg\"\n\
                 [[study]]\nkind = \"simulate\"\nuntil = \"3 s\"\n[[study]]\nkind = \"sweep\"\nover = \"v=linspace(1 m/s, 2 m/s, 3)\"\nobserve = [\"last(x)\"]\n";
    std::fs::write(here.join("m.toml"), model).unwrap();
    let text = stdout(strutt().current_dir(&here).args(["sweep", "m.toml", "--csv", "--over", "v=4 m/s, 5 m/s"]));
    let (head, rows) = common::table(&text);
    assert!(head[1].contains("last(x)"), "{head:?}");
    assert!(rows.iter().zip([12.0, 15.0]).all(|(row, x)| (row[1] - x).abs() < PRINTED), "{rows:?}");
}

#[test]
fn a_variant_replaces_values_and_set_counts_more() {
    let here = folder("variants");
    let model = "gravity = false\n[parameters]\nm = \"1 kg\"\nF = \"5 N\"\nN = 0\n[coordinates]\nx = \"m\"\n[bodies.b]\norigin = [\"x\", 0]\n\
                 mass = \"m\"\n[forces.f]\nalong = \"x\"\nvalue = \"F\"\n[outputs]\na = \"x''\"\nn = \"N*1 [m]/1 [m]\"\n\
                 [variants]\ntable = \"table.csv\"\nnumber = \"N\"\n[[study]]\nkind = \"simulate\"\nuntil = \"1 s\"\nat = [\"1 s\"]\noutputs = [\"a\", \"n\"]\n";
    std::fs::write(here.join("m.toml"), model).unwrap();
    std::fs::write(here.join("table.csv"), "# masses\nvariant;m [g];F\n1;500;6\n2;2,5 kg;10 N\n").unwrap();
    let row = |arguments: &[&str]| -> [f64; 2] {
        let text = stdout(strutt().current_dir(&here).args(["simulate", "m.toml", "--csv"]).args(arguments));
        let cells: Vec<f64> = text.lines().last().unwrap().split(',').map(|cell| cell.parse().unwrap()).collect();
        [cells[1], cells[2]]
    };
    assert_eq!(row(&[]), [5.0, 0.0]);
    assert_eq!(row(&["--variant", "1"]), [12.0, 1.0]);
    assert_eq!(row(&["--variant", "2"]), [4.0, 2.0]);
    assert_eq!(row(&["--variant", "2", "--set", "F=5"]), [2.0, 2.0]);
    for (arguments, code, exit) in [(&["m.toml", "--variant", "3"][..], "C021", 2), (&["top.toml", "--variant", "1"], "C020", 2)] {
        std::fs::write(here.join("top.toml"), std::fs::read_to_string(gallery("top")).unwrap()).unwrap();
        let text = stderr(strutt().current_dir(&here).arg("check").args(arguments), exit);
        assert!(text.contains(code), "{text}");
    }
    for (table, place) in [
        ("variant,m\n1,5\n\n1,6\n", "lines 2 and 4"),
        ("variant,m,m\n1,5,6\n", "columns 2 and 3"),
        ("variant,m\n1,1e999\n", "line 2, column `m`"),
    ] {
        std::fs::write(here.join("table.csv"), table).unwrap();
        let text = stderr(strutt().current_dir(&here).args(["check", "m.toml", "--variant", "1"]), 1);
        assert!(text.contains("C022") && text.contains("table.csv") && text.contains(place), "{text}");
    }
    std::fs::write(here.join("table.csv"), "variant,mass\n1,5\n").unwrap();
    let text = stderr(strutt().current_dir(&here).args(["check", "m.toml", "--variant", "1", "--lang", "ru"]), 1);
    assert!(text.contains("C022") && text.contains("table.csv"), "{text}");
    std::fs::remove_file(here.join("table.csv")).unwrap();
    let text = stderr(strutt().current_dir(&here).args(["check", "m.toml", "--variant", "1"]), 2);
    assert!(text.contains("C001") && text.contains("table.csv"), "{text}");
}

/// The file has no study `continue`: the command line writes one, with the period and the range in it.
#[test]
fn a_branch_is_followed_from_the_command_line_alone() {
    let range = ["--parameter", "omega", "--from", "110 rad/s", "--to", "112 rad/s"];
    let text = stdout(strutt().args(["continue", &gallery("kapitza"), "--period", "2*pi/omega", "--csv"]).args(range));
    let (head, rows) = common::table(&text);
    assert!(head[1].starts_with("omega") && rows.len() > 2, "{text}");
    assert_eq!([rows[0][1], rows[rows.len() - 1][1]], [110.0, 112.0]);
}
