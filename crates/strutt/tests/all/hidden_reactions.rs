//! Reactions of hidden directions over random machines, two ways to one number.
//!
//! A tree of bodies on slides and pivots is written twice: with one coordinate for each joint, so that its reactions are hidden and follow from balances of
//! released bodies; and with three coordinates for each body and the joints as connections, so that they follow from M q'' = h + Jᵀ λ. Springs, frictions, forces and
//! potentials act along the joint coordinates. In the second writing nothing is known of released bodies and of places of loads.

use std::fmt::Write;

use analysis::System;
use studies::pipeline::{self, Machine};
use studies::{Source, Watch};

/// Machines that are compared.
const MACHINES: u64 = 110;
/// Largest difference of reactions, relative to the greatest force of the machine.
const LIMIT: f64 = 1e-9;

/// Numbers between -1 and 1 (splitmix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        (z >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
    fn below(&mut self, n: usize) -> usize {
        ((self.next() + 1.0) * 0.5 * n as f64) as usize % n
    }
}

/// A body on a joint.
struct Body {
    /// Index of the parent plus one; 0 is the ground.
    parent: usize,
    slides: bool,
    /// Place of the joint on the parent, direction of the slide.
    joint: [f64; 3],
    /// Joint coordinate and its rate.
    q: [f64; 2],
    mass: [f64; 4],
    /// Load along the coordinate, by number.
    load: usize,
    force: [f64; 2],
}

fn machine(seed: u64) -> Vec<Body> {
    let mut random = Random(seed.wrapping_mul(0x0005_deec_e66d).wrapping_add(11));
    let count = 1 + random.below(3);
    (0..count)
        .map(|i| Body {
            parent: random.below(i + 1),
            slides: random.below(2) == 0,
            joint: [random.next(), random.next(), 2.0 * random.next()],
            q: [random.next(), 2.0 * random.next()],
            mass: [2.0 + random.next(), 1.0 + 0.5 * random.next(), 0.5 * random.next(), 0.5 * random.next()],
            load: random.below(6),
            force: [20.0 * random.next(), 20.0 * random.next()],
        })
        .collect()
}

/// A load along a pathway.
fn load(k: usize, body: &Body, pathway: &str) -> String {
    let (unit, power) = if body.slides { ("N", "") } else { ("N m", "") };
    let per = if body.slides { "N/m" } else { "N m" };
    let _ = power;
    let fourth = if body.slides { "N/m^3" } else { "N m" };
    match body.load {
        1 => format!(
            "[springs.L{k}]\nalong = \"{pathway}\"\nstiffness = \"40 {per}\"\nrest = \"0.3{}\"\n",
            if body.slides { " m" } else { "" }
        ),
        2 => format!("[forces.L{k}]\nalong = \"{pathway}\"\nvalue = \"15 {unit}\"\n"),
        3 => format!("[frictions.L{k}]\nalong = \"{pathway}\"\nkinetic = \"9 {unit}\"\n"),
        4 => format!("[potentials.L{k}]\nenergy = \"30 [{fourth}]*({pathway})^4/4\"\n"),
        5 => format!("[dampers.L{k}]\nalong = \"{pathway}\"\ndamping = \"7 {}\"\n", if body.slides { "N s/m" } else { "N m s" }),
        _ => String::new(),
    }
}

fn body(text: &mut String, k: usize, body: &Body) {
    let [mass, inertia, cx, cy] = body.mass;
    let _ = writeln!(text, "mass = \"{mass} kg\"\ninertia = \"{inertia} kg m^2\"\ncenter = [\"{cx} m\", \"{cy} m\"]");
    let [x, y] = body.force;
    let _ = writeln!(text, "[forces.F{k}]\nat = \"b{k}\"\nvalue = [\"{x} N\", \"{y} N\"]");
}

fn parent(body: &Body) -> String {
    if body.parent == 0 { "ground".to_owned() } else { format!("b{}", body.parent - 1) }
}

/// A coordinate for each joint.
fn hidden(bodies: &[Body]) -> String {
    let mut text = String::from("[coordinates]\n");
    for (k, b) in bodies.iter().enumerate() {
        let unit = if b.slides { "m" } else { "rad" };
        let _ = writeln!(text, "q{k} = {{ unit = \"{unit}\", start = \"{} {unit}\", rate = \"{} {unit}/s\" }}", b.q[0], b.q[1]);
    }
    for (k, b) in bodies.iter().enumerate() {
        let [x, y, angle] = b.joint;
        let _ = writeln!(text, "[frames.g{k}]\non = \"{}\"\norigin = [\"{x} m\", \"{y} m\"]\nangle = \"{angle}\"", parent(b));
        let place = if b.slides { format!("origin = [\"q{k}\", \"0\"]") } else { format!("angle = \"q{k}\"") };
        let _ = writeln!(text, "[bodies.b{k}]\non = \"g{k}\"\n{place}");
        body(&mut text, k, b);
        let held = if b.slides { format!("directions = [\"y\"]\naxes = \"g{k}\"") } else { "directions = [\"x\", \"y\"]".to_owned() };
        let _ = writeln!(text, "[supports.R{k}]\nat = \"b{k}\"\n{held}");
        text.push_str(&load(k, b, &format!("q{k}")));
    }
    outputs(&mut text, bodies, "force_y");
    text
}

fn outputs(text: &mut String, bodies: &[Body], slide: &str) {
    text.push_str("[outputs]\n");
    for (k, b) in bodies.iter().enumerate() {
        if b.slides {
            let _ = writeln!(text, "N{k} = \"{slide}(R{k})\"");
        } else {
            let _ = writeln!(text, "X{k} = \"force_x(R{k})\"\nY{k} = \"force_y(R{k})\"");
        }
    }
}

/// Where a body is: x, y, angle and their rates.
fn placements(bodies: &[Body]) -> Vec<[f64; 6]> {
    let mut list: Vec<[f64; 6]> = Vec::new();
    for b in bodies {
        let [px, py, pa, vx, vy, va] = if b.parent == 0 { [0.0; 6] } else { list[b.parent - 1] };
        let [ax, ay, angle] = b.joint;
        let ((s, c), (e, d)) = (pa.sin_cos(), (pa + angle).sin_cos());
        let (gx, gy) = (px + ax * c - ay * s, py + ax * s + ay * c);
        let (q, rate) = (b.q[0], b.q[1]);
        let (wx, wy) = (vx - va * (gy - py), vy + va * (gx - px));
        list.push(if b.slides {
            [gx + q * d, gy + q * e, pa + angle, wx + rate * d - va * q * e, wy + rate * e + va * q * d, va]
        } else {
            [gx, gy, pa + angle + q, wx, wy, va + rate]
        });
    }
    list
}

/// Three coordinates for each body, joints as connections.
fn connected(bodies: &[Body]) -> String {
    let mut text = String::from("[coordinates]\n");
    for (k, [x, y, f, vx, vy, w]) in placements(bodies).into_iter().enumerate() {
        let _ = writeln!(text, "x{k} = {{ unit = \"m\", start = \"{x} m\", rate = \"{vx} m/s\" }}");
        let _ = writeln!(text, "y{k} = {{ unit = \"m\", start = \"{y} m\", rate = \"{vy} m/s\" }}");
        let _ = writeln!(text, "f{k} = {{ unit = \"rad\", start = \"{f} rad\", rate = \"{w} rad/s\" }}");
    }
    for (k, b) in bodies.iter().enumerate() {
        let [ax, ay, angle] = b.joint;
        let _ = writeln!(text, "[points.G{k}]\non = \"{}\"\nat = [\"{ax} m\", \"{ay} m\"]", parent(b));
        let _ = writeln!(text, "[bodies.b{k}]\norigin = [\"x{k}\", \"y{k}\"]\nangle = \"f{k}\"");
        body(&mut text, k, b);
        let (px, py, pf) = match b.parent {
            0 => ("0 [m]".to_owned(), "0 [m]".to_owned(), "0 [rad]".to_owned()),
            p => (format!("x{}", p - 1), format!("y{}", p - 1), format!("f{}", p - 1)),
        };
        let on = parent(b);
        let pathway = if b.slides {
            let _ = writeln!(
                text,
                "[sliders.R{k}]\npoint = \"b{k}\"\non = \"{on}\"\nthrough = \"G{k}\"\ndirection = \"{angle}\"\nturns = false"
            );
            format!(
                "(x{k} - {px} - ({ax} [m])*cos({pf}) + ({ay} [m])*sin({pf}))*cos({pf} + ({angle})) + \
                 (y{k} - {py} - ({ax} [m])*sin({pf}) - ({ay} [m])*cos({pf}))*sin({pf} + ({angle}))"
            )
        } else {
            let _ = writeln!(text, "[pins.R{k}]\nbetween = [\"G{k}\", \"b{k}\"]");
            format!("f{k} - {pf} - ({angle})")
        };
        text.push_str(&load(k, b, &pathway));
    }
    outputs(&mut text, bodies, "force");
    text
}

fn build(text: &str) -> Machine {
    let source = Source::new("random.toml", text);
    match pipeline::build(&source, &[], &mut Watch::default()) {
        Ok(machine) => machine,
        Err(failure) => panic!("{failure:?}\n{text}"),
    }
}

/// The named outputs at the start.
fn reactions(machine: &mut Machine, text: &str) -> Vec<(String, f64)> {
    let x = machine.system.start().unwrap();
    let modes = machine.system.modes_by_value(0.0, &x).unwrap();
    let names: Vec<String> = machine.system.outputs().iter().map(|o| o.name.clone()).collect();
    let mut values = vec![0.0; names.len()];
    machine.system.observe(0.0, &x, &modes, &mut values).unwrap();
    let wanted = |n: &str| n.starts_with(['N', 'X', 'Y']);
    for (i, name) in names.iter().enumerate().filter(|(_, n)| wanted(n)) {
        assert!(machine.system.refusal(i).is_none(), "{name} is refused in\n{text}");
    }
    names.into_iter().zip(values).filter(|(n, _)| wanted(n)).collect()
}

#[test]
fn balances_of_released_bodies_give_the_reactions_of_connections() {
    let (mut compared, mut loaded) = (0, [0; 6]);
    for seed in 0..MACHINES {
        let bodies = machine(seed);
        bodies.iter().for_each(|b| loaded[b.load] += 1);
        let texts = [hidden(&bodies), connected(&bodies)];
        let [mut one, mut other] = texts.each_ref().map(|t| build(t));
        let (a, b) = (reactions(&mut one, &texts[0]), reactions(&mut other, &texts[1]));
        let weight: f64 = bodies.iter().map(|b| b.mass[0] * 9.81).sum();
        let scale = a.iter().chain(&b).fold(weight, |m, (_, v)| m.max(v.abs()));
        assert_eq!(a.len(), b.len());
        for ((name, hidden), (_, connected)) in a.iter().zip(&b) {
            assert!(
                (hidden - connected).abs() <= LIMIT * scale,
                "seed {seed}, {name}: {hidden} and {connected}\n{}\n{}",
                texts[0],
                texts[1]
            );
            compared += 1;
        }
    }
    assert!(compared > 2 * MACHINES && loaded.iter().all(|n| *n > 20), "{compared} {loaded:?}");
}

/// A wedge with a block on it, pulled at a point and held by a spring and a torsion spring on its joint.
const BROKEN: &str = r#"
[coordinates]
x = { unit = "m", start = "0.1 m", rate = "1 m/s" }
f = { unit = "rad", start = "0.4 rad", rate = "2 rad/s" }

[bodies.cart]
origin = ["x", "0"]
mass = "3 kg"
[bodies.rod]
on = "cart"
angle = "f"
mass = "2 kg"
inertia = "0.1 kg m^2"
center = ["0", "-0.5 m"]
[points]
A = { on = "cart", at = ["-0.3 m", "0"] }
B = { on = "cart", at = ["0.4 m", "0"] }

[springs.c]
along = "x(cart)"
stiffness = "50 N/m"
[forces.F]
at = "rod"
value = ["3 N", "2 N"]
[supports.A]
at = "A"
directions = ["y"]
[supports.B]
at = "B"
directions = ["y"]
[supports.O]
at = "rod"
directions = ["x", "y"]

[[study]]
kind = "simulate"
until = "1 s"
"#;

/// Results of the audits of a motion, with balances changed by `spoil`.
fn audits(spoil: impl Fn(&mut symbolic::Equations)) -> Vec<(String, bool)> {
    let mut machine = build(BROKEN);
    spoil(&mut machine.equations);
    machine.system = studies::machine::lower(&machine.equations).unwrap();
    let study = machine.model.studies[0].clone();
    let finding = pipeline::study(&mut machine, &study, &mut Watch::default()).unwrap();
    let data = &finding.data;
    data.audits.iter().map(|a| (a.key.clone(), a.ok)).collect()
}

fn passes(list: &[(String, bool)], key: &str) -> bool {
    list.iter().find(|(k, _)| k == key).unwrap_or_else(|| panic!("no audit {key}: {list:?}")).1
}

/// Adds to the balances of the first derivation and to their twins of the second alike, so that both derivations agree on the mistake.
fn spoiled(equations: &mut symbolic::Equations, row: usize, by: symbolic::Expr) {
    let n = equations.coordinates.len();
    let graph = &mut equations.graph;
    let rest = &mut equations.balances[row].rest;
    *rest = graph.add(*rest, by);
    let second = &mut equations.second[n + row];
    *second = graph.sub(*second, by);
}

#[test]
fn released_balance_passes_on_the_right_law() {
    let found = audits(|_| {});
    assert!(found.iter().all(|(_, passed)| *passed), "{found:?}");
    assert!(passes(&found, "released_balance"));
}

#[test]
fn released_balance_sees_a_load_left_out_of_every_balance() {
    let found = audits(|e| {
        let work = e.applied.iter().find(|a| a.name() == "F").unwrap().released.clone();
        assert!(!work.is_empty());
        for (row, w) in work {
            let against = e.graph.neg(w);
            spoiled(e, row, against);
        }
    });
    assert!(!passes(&found, "released_balance"), "{found:?}");
}

#[test]
fn released_balance_sees_inertia_left_out_of_every_balance() {
    let found = audits(|e| {
        for row in 0..e.balances.len() {
            let mut lost = e.graph.zero();
            for (j, column) in std::mem::take(&mut e.balances[row].columns) {
                let symbol = e.coordinates[j].symbols[2];
                let acceleration = e.graph.symbol(symbol);
                let term = e.graph.mul(column, acceleration);
                lost = e.graph.add(lost, term);
            }
            let n = e.coordinates.len();
            e.second[n + row] = e.graph.sub(e.second[n + row], lost);
        }
    });
    assert!(!passes(&found, "released_balance"), "{found:?}");
}

#[test]
fn released_balance_sees_a_moment_that_is_wrong() {
    let found = audits(|e| {
        let rows: Vec<usize> = (0..e.balances.len()).filter(|r| e.balances[*r].name.en.contains("moments about")).collect();
        assert!(!rows.is_empty());
        for row in rows {
            let by = e.graph.number(symbolic::Rational::HALF);
            spoiled(e, row, by);
        }
    });
    assert!(!passes(&found, "released_balance"), "{found:?}");
}
