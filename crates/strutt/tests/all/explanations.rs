//! `strutt explain`: the wrong examples raise the code that they stand for.

use strutt::explain;
use studies::{Failure, Source, Watch, pipeline};

/// A small machine for examples that are a fragment of one.
const MACHINE: &str = "[coordinates]\nx = \"m\"\nphi = \"rad\"\n\
    [bodies.b]\norigin = [\"x\", \"0\"]\nangle = \"phi\"\nmass = \"1 kg\"\ninertia = \"1 kg m^2\"\n\
    [parameters]\nm = \"1 kg\"\nl = \"1 m\"\nk = \"1 N/m\"\nR = \"1 m\"\nF = \"1 N\"\n\
    [points]\nA = { on = \"b\", at = [\"l\", \"0\"] }\n";

/// Places in which a fragment may stand, marked `@`.
const PLACES: &[&str] = &[
    "@",
    "[parameters]\n@",
    "[coordinates]\n@",
    "[bodies.c]\n@",
    "[frames.f]\n@",
    "[points]\n@",
    "[points.B]\non = \"b\"\n@",
    "[springs.s]\n@",
    "[springs.s]\nalong = \"x\"\nstiffness = \"k\"\n@",
    "[springs.s]\nstiffness = \"k\"\n@\n[bodies.crank]\nmass = \"1 kg\"\n[points.B]\non = \"b\"\nat = [\"0\", \"l\"]\n",
    "[dampers.d]\n@",
    "[forces.f]\n@",
    "[forces.f]\nalong = \"x\"\n@",
    "[forces.f]\nalong = \"x\"\nvalue = \"@\"",
    "[torques.t]\non = \"b\"\n@",
    "[torques.t]\non = \"b\"\nvalue = \"@\"",
    "[torsion_bars.t]\nbetween = [\"ground\", \"b\"]\n@",
    "[torsion_bars.t]\nbetween = [\"ground\", \"b\"]\nshear_modulus = \"80 GPa\"\nlength = \"1 m\"\n@",
    "[potentials.p]\n@",
    "[dissipations.d]\n@",
    "[outputs]\n@",
    "[outputs]\no = \"@\"",
    "[parameters]\nq = \"@\"",
    "[parameters]\na = \"1 m/s^2\"\nq = \"@\"",
    "[parameters]\nq = @",
    "[[study]]\n@",
    "[[study]]\nkind = \"simulate\"\n@",
    "[[study]]\nkind = \"simulate\"\nuntil = \"1 s\"\n@",
    "[[study]]\nkind = \"equilibrium\"\n@",
    "[[study]]\nkind = \"sweep\"\n@",
    "[[study]]\nkind = \"modes\"\n@",
    "[[study]]\nkind = \"response\"\n@",
    "[[phases]]\nuntil = \"1 s\"\n@",
    "[sections.a]\n@",
    "[nodes.A]\nat = [0, 0]\n[nodes.B]\nat = [\"1 m\", 0]\n@",
    "[nodes.A]\nat = [0, 0]\n[nodes.B]\nat = [\"1 m\", 0]\n@\nbetween = [\"A\", \"B\"]",
    "[nodes.A]\nat = [0, 0]\n[nodes.B]\nat = [\"1 m\", 0]\n@\nbetween = [\"A\", \"B\"]\nEI = \"1 N m^2\"",
    "[nodes.A]\nat = [0, 0]\n[nodes.B]\nat = [\"1 m\", 0]\n[rods.AB]\nbetween = [\"A\", \"B\"]\nEI = \"1 N m^2\"\n@",
    "[[study]]\nkind = \"cycle\"\nangle = \"phi\"\n@",
    "[bodies.crank]\nangle = \"2*phi\"\n[points.B]\non = \"crank\"\nat = [0, 0]\n@",
    "[bodies.crank]\nangle = \"2*phi\"\n[points.B]\non = \"crank\"\nat = [0, 0]\n[belts.s]\nbetween = [\"b\", \"crank\"]\n@",
    "[bodies.crank]\nangle = \"2*phi\"\n[points.B]\non = \"crank\"\nat = [0, 0]\n[distributed.q]\nvalue = [0, \"1 N/m\"]\n@",
    "[supports.s]\nat = \"A\"\n@",
    "[stops.s]\nalong = \"x\"\nat_least = 0\n@",
    "[constraints.c]\n@",
    "[frictions.f]\nalong = \"x\"\n@",
    "[frictions.floor]\nalong = \"x\"\nkinetic = \"1 N\"\n@",
    "[sliders.guide]\npoint = \"A\"\n[rods.AB]\nbetween = [\"A\", \"ground\"]\n@",
    "[sliders.guide]\npoint = \"A\"\n[rods.AB]\nbetween = [\"A\", \"ground\"]\n[outputs]\n@",
    "[pins.A]\nbetween = [\"A\", \"ground\"]\n[frictions.f]\nalong = \"x\"\ncoefficient = 0.2\n@",
];

/// Too long to be written out (M009, M032), or for the command line (M020, M068). The example of M035 reads as a quantity in tonnes
/// until a file gives it the dimension that it lacks.
const ABRIDGED: &[&str] = &["M009", "M032", "M020", "M068", "M035"];

fn codes(text: &str) -> Vec<&'static str> {
    match pipeline::build(&Source::new("example.toml", text), &[], &mut Watch::default()) {
        Ok(machine) => machine.warnings.iter().map(|d| d.code).collect(),
        Err(Failure::Findings { diagnostics, .. }) => diagnostics.iter().map(|d| d.code).collect(),
        Err(Failure::Trouble(t)) => vec![t.code],
        Err(_) => Vec::new(),
    }
}

#[test]
fn wrong_examples_raise_their_code() {
    let mut silent = Vec::new();
    for e in explain::all().filter(|e| !e.wrong.is_empty() && !ABRIDGED.contains(&e.code)) {
        let texts = PLACES.iter().flat_map(|place| {
            let fragment = place.replace('@', e.wrong);
            [format!("{fragment}\n{MACHINE}"), format!("{MACHINE}{fragment}\n"), format!("{fragment}\n")]
        });
        if !texts.into_iter().any(|text| codes(&text).contains(&e.code)) {
            silent.push(format!("{}: {}", e.code, e.wrong));
        }
    }
    assert!(silent.is_empty(), "\n{}", silent.join("\n"));
}
