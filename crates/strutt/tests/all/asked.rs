//! What files ask: the keys of every kind of study, and what its values demand together.

use mechanics::asked::Asked;
use strutt::gallery;
use studies::Source;
use studies::cycle::Cycle;
use studies::kinematics::{Kinematics, KinematicsEnd};
use studies::periodic::{Periodic, Section};
use studies::sweep::Sweep;
use studies::{TABLE, simulate::Simulate};

const PENDULUM: &str = r#"
[parameters]
m = "2 kg"
l = "0.5 m"

[coordinates]
phi = { unit = "rad", start = "15 deg" }

[bodies.bob]
angle = "phi"
mass = "m"
center = ["0", "-l"]
"#;

fn findings(text: &str) -> Vec<&'static str> {
    match studies::read(&Source::new("m.toml", text), &[]) {
        Ok(reading) => reading.warnings.iter().map(|d| d.code).collect(),
        Err(found) => found.iter().map(|d| d.code).collect(),
    }
}

fn asked() -> Vec<Asked> {
    let text = include_str!("../data/studies.toml");
    let reading = studies::read(&Source::new("m.toml", text), &[]);
    reading.unwrap_or_else(|d| panic!("{:#?}", d.iter().map(|d| (d.code, &d.what.en)).collect::<Vec<_>>())).model.studies
}

#[test]
fn studies_keep_their_meaning() {
    let list = asked();
    assert_eq!((list[0].kind, Simulate::of(&list[0]).until), ("inverse", 1.0));
    let k = Kinematics::of(&list[2]).unwrap();
    assert_eq!((k.name.as_str(), k.to, k.points, k.with.len()), ("phi", KinematicsEnd::Turns(2.0), 73, 1));
    assert!(Kinematics::of(&list[3]).is_some_and(|k| k.to == KinematicsEnd::At(0.1) && k.from.is_none()));
    let p = Periodic::of(&list[4]);
    assert_eq!((p.section, p.settle), (Section::Turns { angle: k.over, turns: -1.0 }, 5.0));
    assert_eq!(p.tuned, Some(("F0".to_owned(), 0.2568)));
    assert!(matches!(Periodic::of(&list[5]), Periodic { section: Section::Zero(_), period: Some(8.0), .. }));
    assert_eq!(Periodic::of(&list[6]).section, Section::Time);
    let speed = Cycle::of(&list[8]).unwrap().speed.unwrap();
    // units of the last place of fifty
    assert!((speed - 4.0 * std::f64::consts::PI / 0.2568).abs() < 1e-12, "{speed}");
    let s = Sweep::of(&list[10]);
    assert_eq!((s.over.len(), s.over[0].values.len(), s.over[1].values[0]), (2, 2, 1000.0));
}

#[test]
fn every_key_of_every_kind_is_read_somewhere() {
    let mut read: Vec<Asked> = asked();
    for name in gallery::names() {
        let text = gallery::find(name).unwrap().text;
        read.extend(studies::read(&Source::new("m.toml", text), &[]).unwrap_or_else(|_| panic!("{name}")).model.studies);
    }
    for chapter in std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/book")).unwrap().flatten() {
        let text = std::fs::read_to_string(chapter.path()).unwrap_or_default();
        let models = text.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next());
        // patches and models that are wrong on purpose are no files
        read.extend(models.filter_map(|text| studies::read(&Source::new("m.toml", text), &[]).ok()).flat_map(|r| r.model.studies));
    }
    for kind in TABLE.iter().map(|study| study.kind()) {
        for key in kind.keys.iter().filter(|key| key.option.is_none()) {
            let is_read = |asked: &Asked| asked.kind == kind.name && asked.get(key.name).is_some();
            assert!(read.iter().any(is_read), "no file asks for {}.{}", kind.name, key.name);
        }
    }
}

/// What the kinds themselves demand; what any key of its type demands, tests of the reader hold (`mechanics/src/read/tests.rs`).
#[test]
fn studies_that_do_not_agree_are_refused() {
    for (study, code) in [
        ("kind = \"kinematics\"", "M006"),
        ("kind = \"kinematics\"\nover = \"phi\"\nto = \"1 m\"", "M024"),
        ("kind = \"kinematics\"\nover = \"phi\"\nto = \"1 rad\"\nturns = 1", "M071"),
        ("kind = \"kinematics\"\nover = \"phi\"\npoints = 1", "M071"),
        ("kind = \"periodic\"", "M071"),
        ("kind = \"periodic\"\nsection = \"phi\"\nunknown = \"m\"", "M071"),
        ("kind = \"periodic\"\nsection = \"phi\"\nunknown = \"M\"\nwanted_period = \"1 s\"", "M072"),
        ("kind = \"periodic\"\nperiod = \"1 s\"\nturns = 2", "M071"),
        ("kind = \"cycle\"", "M006"),
        ("kind = \"cycle\"\nangle = \"phi\"\nspeed = 0", "M071"),
        ("kind = \"cycle\"\nangle = \"phi\"\nspeed = \"1 rad/s\"\nperiod = \"1 s\"", "M071"),
        ("kind = \"cycle\"\nangle = \"phi\"\nirregularity = 3", "M071"),
        ("kind = \"cycle\"\nangle = \"phi\"\nflywheel = \"m\"", "M071"),
        ("kind = \"sweep\"", "M006"),
        ("kind = \"equilibrium\"\nover = \"phi\"", "M006"),
        ("kind = \"inverse\"", "M006"),
    ] {
        let found = findings(&format!("{PENDULUM}\n[[study]]\n{study}\n"));
        assert_eq!(found, [code], "{study}: {found:?}");
    }
}
