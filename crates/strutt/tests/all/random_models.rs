//! Invariants of derived equations over random machines: trees of bodies in the plane and in space with springs, dampers, loads and
//! prescribed turning. At random states, with accelerations that obey no equation:
//!
//! - Lagrange's and the projected Newton-Euler residuals are equal;
//! - dE/dt - (loads + drives - dissipated) = Σ q'_i R_i, the power identity off the equations of motion;
//! - the mass matrix is symmetric and positive.

use proptest::prelude::*;
use std::fmt::Write;
use symbolic::{Equations, Expr, SymbolId};

/// Two derivations at a random state: rounding of some thousand operations, relative to the largest term.
const DERIVED: f64 = 1e-11;

/// What a body of the tree is like.
#[derive(Clone, Debug)]
struct Body {
    parent: usize,
    at_point: bool,
    slide: bool,
    axes: Vec<usize>,
    spin: bool,
    center: [i32; 3],
    shape: usize,
    point: [i32; 3],
}

/// A random machine.
#[derive(Clone, Debug)]
struct Machine {
    space: bool,
    bodies: Vec<Body>,
    spring: bool,
    damper: bool,
    force: bool,
    torque: bool,
    free: bool,
}

fn machine() -> impl Strategy<Value = Machine> {
    let body = (
        any::<prop::sample::Index>(),
        any::<bool>(),
        any::<bool>(),
        prop::collection::vec(0usize..3, 1..3),
        prop::bool::weighted(0.15),
        prop::array::uniform3(-2i32..3),
        0usize..5,
        prop::array::uniform3(1i32..4),
    )
        .prop_map(|(parent, at_point, slide, axes, spin, center, shape, point)| {
            (parent, Body { parent: 0, at_point, slide, axes, spin, center, shape, point })
        });
    let bodies = prop::collection::vec(body, 1..4).prop_map(|list| {
        let mut bodies: Vec<Body> = Vec::new();
        for (i, (parent, mut body)) in list.into_iter().enumerate() {
            body.parent = parent.index(i + 1);
            bodies.push(body);
        }
        bodies
    });
    (any::<bool>(), bodies, prop::array::uniform5(any::<bool>()))
        .prop_map(|(space, bodies, [spring, damper, force, torque, free])| Machine { space, bodies, spring, damper, force, torque, free })
}

/// The model file of a machine.
fn write(machine: &Machine) -> String {
    let (mut coordinates, mut bodies, mut points) = (String::new(), String::new(), String::new());
    for (i, body) in machine.bodies.iter().enumerate() {
        let on = if body.parent == 0 { "ground".to_owned() } else { format!("b{}", body.parent - 1) };
        let _ = writeln!(bodies, "[bodies.b{i}]\non = \"{on}\"\nmass = \"{} kg\"", i + 1);
        let [a, b, c] = body.point;
        let third = if machine.space { format!(", \"0.{c} m\"") } else { String::new() };
        let _ = writeln!(points, "P{i} = {{ on = \"b{i}\", at = [\"0.{a} m\", \"-0.{b} m\"{third}] }}");
        if body.slide {
            let _ = writeln!(coordinates, "s{i} = {{ unit = \"m\" }}");
            let _ = writeln!(bodies, "origin = [\"s{i}\", \"s{i}^2/L + 0.1 [m]\"]");
        } else if body.at_point && body.parent > 0 {
            let _ = writeln!(bodies, "origin = \"P{}\"", body.parent - 1);
        }
        rotation(machine, body, i, &mut coordinates, &mut bodies);
        let c = body.center.map(|c| format!("\"{} cm\"", 10 * c));
        let center = if machine.space { c.join(", ") } else { c[..2].join(", ") };
        let _ = writeln!(bodies, "center = [{center}]");
        let tensor = "inertia = { xx = \"0.03 kg m^2\", yy = \"0.04 kg m^2\", zz = \"0.05 kg m^2\", xy = \"0.004 kg m^2\", xz = \"0.002 kg m^2\", yz = \"0.003 kg m^2\" }";
        let shapes =
            [tensor, "shape = \"box(L, 0.2 [m], 0.3 [m])\"", "shape = \"cylinder(0.2 [m], L)\"", "shape = \"sphere(L/3)\"", tensor];
        let _ = writeln!(bodies, "{}\n", shapes[body.shape]);
    }
    let last = machine.bodies.len() - 1;
    let mut text = format!("gravity = [\"1 m/s^2\", \"-g\"{}]\n", if machine.space { ", \"2 m/s^2\"" } else { "" });
    text.push_str("[parameters]\nL = \"0.7 m\"\nOmega = \"3 [rad/s] + 2 [rad/s^2]*t\"\n");
    let _ = write!(text, "[coordinates]\n{coordinates}\n{bodies}\n[points]\nQ = {{ on = \"ground\", at = [\"1 m\", \"2 m\"] }}\n{points}");
    if machine.spring {
        let _ = write!(text, "[springs.c]\nbetween = [\"Q\", \"P{last}\"]\nstiffness = \"50 N/m\"\nrest = \"0.4 m\"\npreload = \"2 N\"\n");
    }
    if machine.damper {
        let _ = write!(text, "[dampers.b]\nbetween = [\"Q\", \"P0\"]\ndamping = \"3 N s/m\"\n");
    }
    if machine.force {
        let _ = write!(text, "[forces.f]\nat = \"P{last}\"\nvalue = [\"3 [N] * sin(2 [1/s]*t)\", \"1 N\"]\naxes = \"b0\"\n");
    }
    if machine.torque {
        let reaction = if last > 0 { "reaction = \"b0\"\n" } else { "" };
        let _ = write!(text, "[torques.m]\non = \"b{last}\"\nvalue = \"0.5 [N m] + 0.1 [N m/s]*t\"\n{reaction}");
    }
    if machine.free {
        let (angle, rate) = if machine.bodies[0].slide { ("s0/L", "s0'/L") } else { ("a0", "a0'") };
        let _ = write!(text, "[potentials.p]\nenergy = \"2 [J] * sin({angle})^2 * exp(-t/(1 [s]))\"\n");
        let _ = write!(text, "[dissipations.d]\nfunction = \"0.3 [N m s] * ({rate})^2\"\n");
    }
    text
}

fn rotation(machine: &Machine, body: &Body, i: usize, coordinates: &mut String, bodies: &mut String) {
    if body.spin {
        let _ = writeln!(bodies, "spin = \"Omega\"");
    }
    let turning = !body.spin || !body.slide;
    if !turning {
        return;
    }
    let _ = writeln!(coordinates, "a{i} = {{ unit = \"rad\" }}");
    if !machine.space {
        let _ = writeln!(bodies, "angle = \"a{i}\"");
        return;
    }
    let axis = |k: usize| ["x", "y", "z"][k];
    let mut list = vec![format!("\"{}: a{i}\"", axis(body.axes[0]))];
    if let Some(second) = body.axes.get(1) {
        list.push(format!("\"{}: 0.3 + 0.5*a{i}\"", axis(*second)));
    }
    let _ = writeln!(bodies, "rotate = [{}]", list.join(", "));
}

/// Values of all symbols: given numbers for parameters and motion, formulas for the rest.
fn values(equations: &Equations, state: &[f64]) -> Vec<f64> {
    let mut values = vec![f64::NAN; equations.graph.symbol_count()];
    let mut next = state.iter().cycle();
    let mut draw = || next.next().copied().unwrap_or(0.0);
    values[equations.time.index()] = draw().abs();
    equations.parameters.iter().for_each(|p| values[p.symbol.index()] = p.value);
    equations.coordinates.iter().flat_map(|c| c.symbols).for_each(|s| values[s.index()] = draw());
    equations.auxiliaries.iter().for_each(|a| values[a.symbol.index()] = draw());
    for d in &equations.definitions {
        let known = |s: SymbolId| values[s.index()];
        values[d.symbol.index()] = equations.graph.evaluate(&[d.formula], &known)[0];
    }
    values
}

/// Whether the symmetric matrix is positive definite, by Cholesky's method.
fn positive(m: &[f64], n: usize) -> bool {
    let mut l = vec![0.0; n * n];
    for i in 0..n {
        for j in 0..=i {
            let s: f64 = m[i * n + j] - (0..j).map(|k| l[i * n + k] * l[j * n + k]).sum::<f64>();
            if i == j {
                if s <= 0.0 {
                    return false;
                }
                l[i * n + i] = s.sqrt();
            } else {
                l[i * n + j] = s / l[j * n + j];
            }
        }
    }
    true
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn two_derivations_and_the_power_identity_agree(machine in machine(), state in prop::collection::vec(-1.2f64..1.2, 23)) {
        let text = write(&machine);
        let reading = mechanics::read(&text, "random.toml", &[]);
        let reading = match reading {
            Ok(reading) => reading,
            Err(errors) => panic!("{text}\n{:#?}", errors.iter().map(|e| (e.code, &e.what.en)).collect::<Vec<_>>()),
        };
        let equations = match mechanics::derive::derive(&reading.model) {
            Ok(equations) => equations,
            // a body that turns only about an axis through a centre that does not move, and the like, cannot occur here: all have inertia
            Err(errors) => panic!("{text}\n{errors:#?}"),
        };
        let values = values(&equations, &state);
        let known = |s: SymbolId| values[s.index()];
        let n = equations.coordinates.len();
        let mut roots: Vec<Expr> = equations.mass.entries().to_vec();
        roots.extend(equations.force.iter().chain(&equations.second).copied());
        let e = &equations.energy;
        roots.extend([e.rate, e.loads, e.drives, e.dissipated]);
        let found = equations.graph.evaluate(&roots, &known);
        let (mass, rest) = found.split_at(n * n);
        let (force, rest) = rest.split_at(n);
        let (second, power) = rest.split_at(n);
        let value = |k: usize, i: usize| values[equations.coordinates[i].symbols[k].index()];
        prop_assert!(positive(mass, n), "{text}\n{mass:?}");
        let mut work = 0.0;
        let mut scale = power.iter().fold(0.0f64, |m, p| m.max(p.abs()));
        for i in 0..n {
            let inertial: Vec<f64> = (0..n).map(|j| mass[i * n + j] * value(2, j)).collect();
            let first = inertial.iter().sum::<f64>() - force[i];
            let size = inertial.iter().fold(force[i].abs(), |m, t| m.max(t.abs()));
            prop_assert!((first - second[i]).abs() <= DERIVED * size.max(1.0), "{text}\nequation {i}: {first} against {}", second[i]);
            work += value(1, i) * first;
            scale = scale.max((value(1, i) * size).abs());
        }
        let balance = power[0] - power[1] - power[2] + power[3];
        prop_assert!((balance - work).abs() <= DERIVED * scale.max(1.0), "{text}\npower {balance} against {work}");
    }
}
