//! Schemes: every machine of the gallery has one, each symbol stands in it for what the file says, nothing lies on anything else.
//!
//! `UPDATE_SCHEMES=1 cargo test -p strutt --test all schemes` writes the golden list and the sheet of symbols anew.

use crate::common;

use common::{folder, gallery, stderr, stdout, strutt};
use report::Scheme;
use report::scheme::sheet;
use std::path::PathBuf;
use studies::scheme::{Options, scheme};
use studies::{Source, Watch, pipeline};
use words::Language;

fn machines() -> Vec<String> {
    let mut names: Vec<String> = strutt::gallery::names().map(str::to_owned).collect();
    names.sort();
    names
}

fn drawn(name: &str) -> Option<Scheme> {
    drawn_of(&gallery(name), &std::fs::read_to_string(gallery(name)).unwrap())
}

fn drawn_of(name: &str, text: &str) -> Option<Scheme> {
    let machine = pipeline::build(&Source::new(name, text), &[], &mut Watch::default()).unwrap();
    scheme(&machine, &Options::default(), Language::En)
}

fn root(path: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..").join(path)
}

fn golden(path: &str, text: &str) {
    let file = root(path);
    if std::env::var_os("UPDATE_SCHEMES").is_some() {
        std::fs::write(&file, text).unwrap();
    }
    let known = std::fs::read_to_string(&file).unwrap_or_default();
    assert!(known == text, "{path} is not current: UPDATE_SCHEMES=1 cargo test -p strutt --test all schemes");
}

/// Which symbol stands for what, a line a machine.
#[test]
fn schemes_of_the_gallery_show_what_the_files_say() {
    let mut text = String::new();
    for name in machines() {
        let Some(scheme) = drawn(&name) else {
            text += &format!("{name}: nothing to draw\n");
            continue;
        };
        let mut items: Vec<String> = scheme.items.iter().map(|i| format!("{} {}", i.path, i.symbol.name)).collect();
        items.sort();
        text += &format!("{name}: {}\n", items.join(", "));
    }
    golden("crates/strutt/tests/data/schemes.txt", &text);
}

#[test]
fn every_element_and_connection_of_the_gallery_is_in_its_scheme() {
    for name in machines() {
        let Some(scheme) = drawn(&name) else { continue };
        let text = std::fs::read_to_string(gallery(&name)).unwrap();
        let machine = pipeline::build(&Source::new(&gallery(&name), &text), &[], &mut Watch::default()).unwrap();
        // a frame that is part of the machine is drawn by its rods
        let elements = machine.model.elements.iter().filter(|e| !e.span.is_empty()).map(|e| e.path.clone());
        // supports at a hinge that is drawn already, gears whose wheels show it
        let connections = machine.model.connections.iter().filter(|c| !matches!(c.table, "supports" | "gears" | "pins"));
        for path in elements.chain(connections.map(|c| format!("{}.{}", c.table, c.name))) {
            assert!(scheme.items.iter().any(|i| i.path == path), "{name}: {path} is not drawn");
        }
    }
}

/// Wheels without places stand beside each other: of a belt with its strands between them, of a gear so that they mesh. A wheel that stands is drawn, on a floor.
#[test]
fn wheels_without_places_are_apart_and_a_fixed_one_is_drawn() {
    let pair = |tie: &str| {
        let text = format!(
            "[coordinates]\np = \"rad\"\nq = \"rad\"\n[bodies.a]\nangle = \"p\"\ninertia = \"1 kg m^2\"\n[bodies.b]\nangle = \"q\"\ninertia = \"2 kg m^2\"\n\
             [{tie}.S]\nbetween = [\"a\", \"b\"]\nradii = [\"0.1 m\", \"0.2 m\"]\n"
        );
        let scheme = drawn_of("pair.toml", &text).unwrap();
        let wheel =
            |path: &str| scheme.items.iter().find(|i| i.path == path && i.place.size > 0.0).map(|i| (i.place.at, i.place.size)).unwrap();
        let ((a, r), (b, s)) = (wheel("bodies.a"), wheel("bodies.b"));
        ((a[0] - b[0]).hypot(a[1] - b[1]), r + s, scheme)
    };
    let (distance, sum, scheme) = pair("belts");
    assert!(distance > 1.2 * sum && scheme.items.iter().any(|i| i.symbol.name == "belt"), "{distance} {sum}");
    let (distance, sum, _) = pair("gears");
    // some thousand roundings of pixels
    assert!((distance - sum).abs() < 1e-6 * sum, "{distance} {sum}");
    let text = "[coordinates]\np = \"rad\"\n[bodies.sun]\nmass = \"1 kg\"\nshape = \"disc(0.1 m)\"\n[bodies.arm]\nangle = \"p\"\n[bodies.planet]\non = \"arm\"\n\
                origin = [\"0.16 m\", \"0\"]\nangle = \"p*5/3\"\nmass = \"1 kg\"\nshape = \"disc(0.06 m)\"\n";
    let scheme = drawn_of("planet.toml", text).unwrap();
    let has = |path: &str, symbol: &str| scheme.items.iter().any(|i| i.path == path && i.symbol.name == symbol);
    assert!(has("bodies.sun", "disc") && has("bodies.planet", "disc") && has("ground", "wall"));
}

#[test]
fn the_sheet_of_symbols_is_current() {
    golden("docs/pictures/symbols.svg", &sheet(Language::En).svg(Language::En));
}

#[test]
fn the_command_writes_svg_and_png_and_keeps_its_inputs() {
    let here = folder("schemes");
    let svg = stdout(strutt().args(["scheme", &gallery("four-bar")]));
    assert!(svg.starts_with("<svg ") && svg.contains("data-path=\"pins.B\""), "{svg}");
    let (vector, pixels) = (here.join("a.svg"), here.join("a.png"));
    strutt().args(["scheme", &gallery("four-bar"), "--svg"]).arg(&vector).arg("--png").arg(&pixels).assert().success();
    assert_eq!(std::fs::read_to_string(&vector).unwrap(), svg);
    assert!(std::fs::read(&pixels).unwrap().starts_with(b"\x89PNG"));
    let model = here.join("model.toml");
    std::fs::copy(gallery("four-bar"), &model).unwrap();
    let told = stderr(strutt().arg("scheme").arg(&model).arg("--svg").arg(&model), 1);
    assert!(told.contains("C052"), "{told}");
}

#[test]
fn a_body_alone_has_the_reactions_of_what_holds_it() {
    let piston = stdout(strutt().args(["scheme", &gallery("crank-hoist"), "--body", "piston"]));
    let groups: Vec<&str> = piston.split("data-path=\"").skip(1).filter_map(|g| g.split('"').next()).collect();
    // both components of the pin, the gas force, the guide and the weight, and no other body
    assert_eq!(groups.iter().filter(|g| **g == "pins.B").count(), 2, "{groups:?}");
    assert!(groups.contains(&"forces.gas") && groups.contains(&"gravity"), "{groups:?}");
    assert!(groups.iter().all(|g| !g.starts_with("bodies.") || *g == "bodies.piston"), "{groups:?}");
    let roller = stdout(strutt().args(["scheme", &gallery("thread-pendulum"), "--body", "roller"]));
    assert_eq!(roller.matches("data-path=\"rolling.P\"").count(), 2);
    assert_eq!(roller.matches("data-path=\"threads.S1\"").count(), 1);
    let told = stderr(strutt().args(["scheme", &gallery("four-bar"), "--body", "crnk"]), 1);
    assert!(told.contains("C055") && told.contains("`crank`"), "{told}");
}

#[test]
fn a_place_of_the_motion_can_be_drawn() {
    let start = stdout(strutt().args(["scheme", &gallery("double-pendulum")]));
    let later = stdout(strutt().args(["scheme", &gallery("double-pendulum"), "--at", "0.3 s"]));
    assert_ne!(start, later);
    assert_eq!(start, stdout(strutt().args(["scheme", &gallery("double-pendulum"), "--at", "0"])));
    let told = stderr(strutt().args(["scheme", &gallery("section-composite")]), 1);
    assert!(told.contains("C056"), "{told}");
}
