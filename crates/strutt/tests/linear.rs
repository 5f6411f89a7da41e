//! Linearisation: matrices of known machines, and derivatives against central differences over the gallery.

use analysis::System;
use analysis::linear::{LinearMachine, Place, parts};
use std::sync::Arc;
use strutt::gallery;
use studies::{Source, Watch, pipeline};
use symbolic::linear::About;

fn machine(name: &str) -> (pipeline::Machine, LinearMachine) {
    let source = Source::new("model.toml", gallery::find(name).expect("example").text);
    let machine = pipeline::build(&source, &[], &mut Watch::default()).expect("model");
    let linear = LinearMachine::new(&Arc::new(machine.equations.clone()), About::Rest).expect("linear");
    (machine, linear)
}

fn close(a: &[f64], b: &[f64], tolerance: f64) {
    for (x, y) in a.iter().zip(b) {
        assert!((x - y).abs() <= tolerance * (1.0 + y.abs()), "{a:?} {b:?}");
    }
    assert_eq!(a.len(), b.len());
}

/// M = [[(m1 + m2) l1², m2 l1 l2], [m2 l1 l2, m2 l2²]], C = diag((m1 + m2) g l1, m2 g l2).
#[test]
fn double_pendulum_about_its_lowest_place() {
    let (_, mut linear) = machine("double-pendulum");
    let m = linear.at(&Place::rest(&[0.0, 0.0])).unwrap();
    let g = 9.81;
    close(&m.mass, &[2.0, 1.0, 1.0, 1.0], 1e-15);
    close(&m.stiffness, &[2.0 * g, 0.0, 0.0, g], 1e-15);
    close(&m.damping, &[0.0; 4], 0.0);
    assert!(m.loads.is_empty());
}

/// Card 00: a = 0.72, b = 14.4, c = 72, H = 12 sin(15 t) with the amplitude of the first phase.
#[test]
fn oscillator_of_the_card() {
    let (_, mut linear) = machine("oscillator");
    let m = linear.at(&Place::rest(&[0.0])).unwrap();
    close(&[m.mass[0], m.damping[0], m.stiffness[0], m.force[0]], &[0.72, 14.4, 72.0, 0.0], 1e-14);
    assert_eq!(m.loads.len(), 1);
    close(&[m.loads[0].rate, m.loads[0].cos[0], m.loads[0].sin[0]], &[15.0, 0.0, 12.0], 1e-14);
    assert!(linear.timing().settled && !linear.timing().frozen);
}

/// B and C about a motion equal central differences of M q'' - h, for every machine whose equations do not depend on time.
#[test]
fn matrices_are_the_derivatives_of_the_equations() {
    let mut checked = 0;
    for example in gallery::EXAMPLES {
        let source = Source::new("model.toml", example.text);
        let Ok(built) = pipeline::build(&source, &[], &mut Watch::default()) else { continue };
        let n = built.equations.coordinates.len();
        if n > 4 || !built.equations.auxiliaries.is_empty() || !built.equations.conditions.is_empty() {
            continue;
        }
        if !built.equations.conditions.is_empty() {
            continue;
        }
        let Ok(mut linear) = LinearMachine::new(&Arc::new(built.equations.clone()), About::Motion) else { continue };
        if linear.timing().frozen || !linear.linear().loads.is_empty() {
            continue;
        }
        let at = |seed: f64| (0..n).map(|i| 0.3 * (1.0 + seed * (i as f64 + 1.7)).sin()).collect::<Vec<_>>();
        let place = Place { q: at(1.0), rates: at(2.0), accelerations: at(3.0), multipliers: Vec::new() };
        let Ok(found) = linear.at(&place) else { continue };
        let step = 1e-5;
        for j in 0..n {
            let moved = |which: usize, by: f64| {
                let mut p = place.clone();
                [&mut p.q, &mut p.rates][which][j] += by;
                p
            };
            for (which, matrix) in [(0, &found.stiffness), (1, &found.damping)] {
                let up = linear.at(&moved(which, step)).unwrap().force;
                let down = linear.at(&moved(which, -step)).unwrap().force;
                let difference: Vec<f64> = up.iter().zip(&down).map(|(a, b)| -(a - b) / (2.0 * step)).collect();
                let column: Vec<f64> = (0..n).map(|i| matrix[i * n + j]).collect();
                let scale = matrix.iter().fold(1e-3_f64, |m, v| m.max(v.abs()));
                for (a, b) in column.iter().zip(&difference) {
                    // central differences of step 1e-5 leave 1e-10 of truncation and 1e-11 of rounding
                    assert!((a - b).abs() < 1e-7 * scale, "{}: {column:?} {difference:?}", example.name);
                }
            }
        }
        checked += 1;
    }
    assert!(checked >= 3, "{checked}");
}

/// The force of the linear tape is the right-hand side that the dynamics see.
#[test]
fn linear_force_is_the_static_force() {
    let (mut built, mut linear) = machine("double-pendulum");
    let q = [0.4, -0.7];
    let (mut h, mut d) = ([0.0; 2], [0.0; 4]);
    built.system.statics(&[0.4, -0.7, 0.0, 0.0], &mut h, &mut d).unwrap();
    let m = linear.at(&Place::rest(&q)).unwrap();
    close(&m.force, &h, 1e-15);
    close(&m.stiffness, &d.map(|v| -v), 1e-15);
    let (even, odd) = parts(&m.stiffness, 2);
    close(&even, &m.stiffness, 1e-15);
    close(&odd, &[0.0; 4], 1e-15);
}

/// Only what cancels is rounding: a spring that is 1e-13 of another one keeps its oscillation, ω = sqrt(1e-4/1) = 0.01 rad/s.
#[test]
fn a_weak_spring_beside_a_strong_one_is_no_rounding() {
    let text = "[coordinates]\nx = \"m\"\ny = \"m\"\n[bodies.b]\norigin = [\"x\", \"y\"]\nmass = \"1 kg\"\n\
        [springs.s]\nalong = \"x\"\nstiffness = \"1e9 N/m\"\n[springs.w]\nalong = \"y\"\nstiffness = \"1e-4 N/m\"\n";
    let machine = pipeline::build(&Source::new("model.toml", text), &[], &mut Watch::default()).expect("model");
    let mut linear = LinearMachine::new(&Arc::new(machine.equations.clone()), About::Rest).expect("linear");
    let m = linear.at(&Place::rest(&[0.0, 0.0])).unwrap();
    close(&m.stiffness, &[1e9, 0.0, 0.0, 1e-4], 1e-15);
    assert!((m.stiffness[3] - 1e-4).abs() < 1e-18);
}

/// A gyroscope in a gimbal: the coupling Ja Ω θ' cos θ leaves its line with 1 - cos θ. Its largest share of the terms of the row over sixteen instants, by hand from
/// the amplitudes of `response`: 7.796 %, of both rows the larger one.
#[test]
fn gyroscopic_terms_count_in_the_measure_of_the_straight_line() {
    let book = include_str!("../../../tests/book/response.md");
    let section = book.split("## How far the straight line holds").nth(1).expect("section");
    let text = section.split("```toml").nth(1).and_then(|t| t.split("```").next()).expect("model");
    let mut watch = Watch::default();
    let mut machine = pipeline::build(&Source::new("model.toml", text), &[], &mut watch).expect("model");
    let asked = machine.model.studies[0].clone();
    let found = pipeline::study(&mut machine, &asked, &mut watch).expect("study");
    let note = found.data.notes.iter().find(|n| n.en.contains("straight line by")).expect("note").en.clone();
    let percent: f64 = note.split("straight line by ").nth(1).and_then(|t| t.split(' ').next()).expect("number").parse().unwrap();
    assert!((percent - 7.796).abs() < 0.01, "{note}");
}
