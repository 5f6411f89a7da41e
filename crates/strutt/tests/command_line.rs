//! The command line as other programs see it: exit codes, streams, files.

mod common;

use common::{folder, gallery, stderr, stdout, strutt};
use predicates::prelude::*;
use predicates::str::{contains, is_empty};

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
        strutt().args(["explain", e.code]).assert().success().stdout(contains(e.title.en.clone()));
        strutt().args(["explain", e.code, "--lang", "ru"]).assert().success().stdout(contains(e.title.ru.clone()));
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
    std::fs::write(here.join("table.csv"), "variant,mass\n1,5\n").unwrap();
    let text = stderr(strutt().current_dir(&here).args(["check", "m.toml", "--variant", "1", "--lang", "ru"]), 1);
    assert!(text.contains("C022") && text.contains("table.csv"), "{text}");
    std::fs::remove_file(here.join("table.csv")).unwrap();
    let text = stderr(strutt().current_dir(&here).args(["check", "m.toml", "--variant", "1"]), 2);
    assert!(text.contains("C001") && text.contains("table.csv"), "{text}");
}
