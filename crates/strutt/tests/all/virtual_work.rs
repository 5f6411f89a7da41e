//! The audit of virtual work sees mistakes that both derivations of the equations share: it knows placements, loads and reactions only.

use studies::pipeline;
use studies::{Source, Watch};
use symbolic::{Equations, Expr};

/// A crank, a coupler and a rocker closed by a pin, driven by a torque and held by a spring.
const LINKAGE: &str = r#"
[coordinates]
a = { unit = "rad", start = "0.6 rad", rate = "3 rad/s" }
b = { unit = "rad", guess = "0.2 rad" }
c = { unit = "rad", guess = "1.4 rad" }

[bodies.crank]
angle = "a"
mass = "1 kg"
center = ["0.05 m", "0"]
inertia = "0.01 kg m^2"
[points]
A = { on = "crank", at = ["0.1 m", "0"] }
B = { on = "coupler", at = ["0.3 m", "0"] }
C = { on = "rocker", at = ["0.25 m", "0"] }
[bodies.coupler]
origin = "A"
angle = "b"
mass = "2 kg"
center = ["0.15 m", "0.02 m"]
inertia = "0.02 kg m^2"
[bodies.rocker]
origin = ["0.35 m", "0"]
angle = "c"
mass = "1.5 kg"
center = ["0.12 m", "0"]
inertia = "0.01 kg m^2"

[pins.p]
between = ["B", "C"]
[springs.c]
along = "c"
stiffness = "20 N m/rad"
[torques.drive]
on = "crank"
value = "2 N m"

[[study]]
kind = "simulate"
until = "0.5 s"
"#;

/// Audits of a motion by spoiled equations: key, whether it passes.
fn audits(model: &str, spoil: impl Fn(&mut Equations)) -> Vec<(String, bool)> {
    let source = Source::new("virtual-work.toml", model);
    let mut machine = pipeline::build(&source, &[], &mut Watch::default()).unwrap_or_else(|f| panic!("{f:?}"));
    spoil(&mut machine.equations);
    machine.system = studies::machine::lower(&machine.equations).unwrap_or_else(|f| panic!("{f:?}"));
    let study = machine.model.studies[0].clone();
    let finding = pipeline::study(&mut machine, &study, &mut Watch::default()).unwrap_or_else(|| panic!("no study"));
    finding.data.audits.iter().map(|a| (a.key.clone(), a.ok)).collect()
}

fn passes(list: &[(String, bool)], key: &str) -> bool {
    list.iter().find(|(k, _)| k == key).unwrap_or_else(|| panic!("no audit {key}: {list:?}")).1
}

/// Adds a generalized force to the first derivation and to the second alike: both agree on the mistake.
fn pushed(e: &mut Equations, coordinate: usize, by: Expr) {
    e.force[coordinate] = e.graph.add(e.force[coordinate], by);
    e.second[coordinate] = e.graph.sub(e.second[coordinate], by);
}

#[test]
fn the_right_law_passes() {
    let found = audits(LINKAGE, |_| {});
    assert!(found.iter().all(|(_, passed)| *passed), "{found:?}");
    assert!(passes(&found, "virtual_work"));
}

#[test]
fn a_load_that_both_derivations_know_and_nobody_gave_is_seen() {
    let found = audits(LINKAGE, |e| {
        let by = e.graph.number(symbolic::Rational::HALF);
        pushed(e, 1, by);
    });
    assert!(passes(&found, "two_derivations"), "{found:?}");
    assert!(!passes(&found, "virtual_work"), "{found:?}");
}

#[test]
fn an_inertia_force_with_the_wrong_sign_is_seen() {
    // terms with squared rates of the coupler, turned round in both derivations
    let found = audits(LINKAGE, |e| {
        let rates: Vec<_> = e.coordinates.iter().map(|c| (c.symbols[1], e.graph.zero())).collect();
        let still = symbolic::Substitution::new(rates).apply(&mut e.graph, e.force[1]);
        let carried = e.graph.sub(e.force[1], still);
        let two = e.graph.int(-2);
        let by = e.graph.mul(two, carried);
        pushed(e, 1, by);
    });
    assert!(passes(&found, "two_derivations"), "{found:?}");
    assert!(!passes(&found, "virtual_work"), "{found:?}");
}

#[test]
fn a_mass_that_is_heavier_on_paper_is_seen() {
    let found = audits(LINKAGE, |e| {
        let more = e.graph.number(symbolic::Rational::HALF);
        let body = e.released.bodies.iter_mut().find(|b| !e.graph.is_zero(b.mass)).unwrap_or_else(|| panic!("no mass"));
        body.mass = e.graph.add(body.mass, more);
    });
    assert!(!passes(&found, "virtual_work"), "{found:?}");
}

#[test]
fn a_reaction_that_acts_on_one_body_only_is_seen() {
    // the pin acts on the coupler and no more on the rocker, in the equations as in the second derivation
    let found = audits(LINKAGE, |e| {
        for k in 0..e.reactions.len() {
            let lost: Vec<(usize, Expr)> = e.reactions[k].forces.iter().filter(|(j, _)| *j == 2).copied().collect();
            for (j, factor) in lost {
                let symbol = e.graph.symbol(e.reactions[k].symbol);
                let force = e.graph.mul(factor, symbol);
                e.second[j] = e.graph.add(e.second[j], force);
                e.reactions[k].forces.retain(|(i, _)| *i != j);
            }
        }
    });
    assert!(!passes(&found, "virtual_work"), "{found:?}");
}
