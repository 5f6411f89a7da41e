//! Linearisation: matrices of known machines, and derivatives against central differences over the gallery.

use analysis::System;
use analysis::linear::{LinearMachine, Place, parts};
use std::sync::Arc;
use strutt::gallery;
use studies::{Source, Watch, pipeline};
use symbolic::linear::About;

/// Units of the last place of 1e-4.
const SMALL: f64 = 1e-18;
/// Matrices of a few operations: units of the last place.
const ROUNDING: f64 = 1e-15;
/// The same with entries up to a hundred.
const SCALED: f64 = 1e-14;
/// Central differences of forces: step² and rounding over step.
const DIFFERENCE: f64 = 1e-7;
/// Digits with which the note prints its numbers.
const SHOWN: f64 = 1e-4;
/// The same with three digits.
const SHOWN_ROUNDED: f64 = 1e-3;

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
    close(&m.mass, &[2.0, 1.0, 1.0, 1.0], ROUNDING);
    close(&m.stiffness, &[2.0 * g, 0.0, 0.0, g], ROUNDING);
    close(&m.damping, &[0.0; 4], 0.0);
    assert!(m.loads.is_empty());
}

/// Card 00: a = 0.72, b = 14.4, c = 72, H = 12 sin(15 t) with the amplitude of the first phase.
#[test]
fn oscillator_of_the_card() {
    let (_, mut linear) = machine("oscillator");
    let m = linear.at(&Place::rest(&[0.0])).unwrap();
    close(&[m.mass[0], m.damping[0], m.stiffness[0], m.force[0]], &[0.72, 14.4, 72.0, 0.0], SCALED);
    assert_eq!(m.loads.len(), 1);
    close(&[m.loads[0].rate, m.loads[0].cos[0], m.loads[0].sin[0]], &[15.0, 0.0, 12.0], SCALED);
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
        let place = Place { q: at(1.0), rates: at(2.0), accelerations: at(3.0), ..Place::default() };
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
                    assert!((a - b).abs() < DIFFERENCE * scale, "{}: {column:?} {difference:?}", example.name);
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
    close(&m.force, &h, ROUNDING);
    close(&m.stiffness, &d.map(|v| -v), ROUNDING);
    let (even, odd) = parts(&m.stiffness, 2);
    close(&even, &m.stiffness, ROUNDING);
    close(&odd, &[0.0; 4], ROUNDING);
}

/// Only what cancels is rounding: a spring that is 1e-13 of another one keeps its oscillation, ω = sqrt(1e-4/1) = 0.01 rad/s.
#[test]
fn a_weak_spring_beside_a_strong_one_is_no_rounding() {
    let text = "[coordinates]\nx = \"m\"\ny = \"m\"\n[bodies.b]\norigin = [\"x\", \"y\"]\nmass = \"1 kg\"\n\
        [springs.s]\nalong = \"x\"\nstiffness = \"1e9 N/m\"\n[springs.w]\nalong = \"y\"\nstiffness = \"1e-4 N/m\"\n";
    let machine = pipeline::build(&Source::new("model.toml", text), &[], &mut Watch::default()).expect("model");
    let mut linear = LinearMachine::new(&Arc::new(machine.equations.clone()), About::Rest).expect("linear");
    let m = linear.at(&Place::rest(&[0.0, 0.0])).unwrap();
    close(&m.stiffness, &[1e9, 0.0, 0.0, 1e-4], ROUNDING);
    assert!((m.stiffness[3] - 1e-4).abs() < SMALL);
}

/// The remark on amplitudes of the first response of a file.
fn remark(text: &str) -> String {
    let mut watch = Watch::default();
    let mut machine = pipeline::build(&Source::new("model.toml", text), &[], &mut watch).expect("model");
    let asked = machine.model.studies[0].clone();
    let found = pipeline::study(&mut machine, &asked, &mut watch).expect("study");
    let note = found.data.notes.iter().find(|n| n.en.contains("equations are not linear") && !n.en.contains("higher degree"));
    note.map(|n| n.en.clone()).unwrap_or_default()
}

/// The amplitude that the remark gives, by small motions and by the whole equations.
fn amplitudes(note: &str) -> [f64; 2] {
    let number = |after: &str| -> f64 {
        let rest = note.split(after).nth(1).unwrap_or_else(|| panic!("{note}"));
        rest.split(' ').next().and_then(|t| t.parse().ok()).unwrap_or_else(|| panic!("{note}"))
    };
    [number("` is "), number("small motions and ")]
}

/// The first harmonic of the first coordinate of x'' = f(t, x, x') after `periods`, by Runge and Kutta's method with 2000 steps a period.
fn first_harmonic<const N: usize>(f: impl Fn(f64, [f64; N], [f64; N]) -> [f64; N], omega: f64, periods: usize) -> f64 {
    let h = std::f64::consts::TAU / omega / 2000.0;
    let plus = |a: [f64; N], k: f64, b: [f64; N]| -> [f64; N] { std::array::from_fn(|i| a[i] + k * b[i]) };
    let (mut x, mut v, mut c, mut s) = ([0.0; N], [0.0; N], 0.0, 0.0);
    for k in 0..2000 * (periods + 1) {
        let t = k as f64 * h;
        if k >= 2000 * periods {
            (c, s) = (c + x[0] * (omega * t).cos() / 1000.0, s + x[0] * (omega * t).sin() / 1000.0);
        }
        let l1 = f(t, x, v);
        let v2 = plus(v, 0.5 * h, l1);
        let l2 = f(t + 0.5 * h, plus(x, 0.5 * h, v), v2);
        let v3 = plus(v, 0.5 * h, l2);
        let l3 = f(t + 0.5 * h, plus(x, 0.5 * h, v2), v3);
        let v4 = plus(v, h, l3);
        let l4 = f(t + h, plus(x, h, v3), v4);
        x = std::array::from_fn(|i| x[i] + h / 6.0 * (v[i] + 2.0 * v2[i] + 2.0 * v3[i] + v4[i]));
        v = std::array::from_fn(|i| v[i] + h / 6.0 * (l1[i] + 2.0 * l2[i] + 2.0 * l3[i] + l4[i]));
    }
    f64::hypot(c, s)
}

/// One mass of 1 kg on 1 N/m with further forces, a load of 0.1 N at w, the response over w.
fn oscillator(w: f64, damping: f64, force: &str) -> String {
    format!(
        "[parameters]\nw = \"{w} rad/s\"\n[coordinates]\nx = \"m\"\n[bodies.b]\norigin = [\"x\", \"0\"]\nmass = \"1 kg\"\n\
         [springs.s]\nalong = \"x\"\nstiffness = \"1 N/m\"\n[dampers.d]\nalong = \"x\"\ndamping = \"{damping} N s/m\"\n\
         [forces]\nmore = {{ along = \"x\", value = \"{force}\" }}\nload = {{ along = \"x\", value = \"0.1 [N]*cos(w*t)\" }}\n\
         [[study]]\nkind = \"response\"\nover = \"w\"\nrange = [\"0.2 rad/s\", \"3 rad/s\"]\npoints = 15\n"
    )
}

/// A hardening spring below and at its resonance, drag by the square of the rate with dry friction smoothed by tanh: the amplitude by harmonic balance is that of the
/// motion, whatever share of the forces is bent.
#[test]
fn the_measure_of_small_motions_is_the_error_of_their_amplitudes() {
    let cubic = |k: f64, w: f64| move |t: f64, [x]: [f64; 1], [v]: [f64; 1]| [0.1 * (w * t).cos() - x - 0.1 * v - k * x * x * x];
    let drag = |t: f64, [x]: [f64; 1], [v]: [f64; 1]| [0.1 * t.cos() - x - 0.05 * v - 0.2 * v.abs() * v - 0.02 * (v / 0.05).tanh()];
    let cases: [(String, f64); 4] = [
        (oscillator(0.8, 0.1, "-0.5 [N/m^3]*x^3"), first_harmonic(cubic(0.5, 0.8), 0.8, 40)),
        (oscillator(1.0, 0.1, "-0.5 [N/m^3]*x^3"), first_harmonic(cubic(0.5, 1.0), 1.0, 60)),
        (oscillator(1.0, 0.1, "-5 [N/m^3]*x^3"), first_harmonic(cubic(5.0, 1.0), 1.0, 60)),
        (oscillator(1.0, 0.05, "-0.2 [N s^2/m^2]*abs(x')*x' - 0.02 [N]*tanh(x'/(0.05 [m/s]))"), first_harmonic(drag, 1.0, 60)),
    ];
    for (text, truth) in cases {
        let note = remark(&text);
        let [small, whole] = amplitudes(&note);
        assert!((whole - truth).abs() < 4.0 * SHOWN_ROUNDED * truth, "{truth}: {note}");
        assert!((small - truth).abs() > 0.05 * truth, "{truth}: {note}");
    }
}

/// A softening spring that jumps: the small amplitude 0.476 m does not hold, the motion settles at 0.848 m. Far above resonance the line holds to 0.4 %.
#[test]
fn an_amplitude_beyond_a_jump_is_said_to_be_lost() {
    let soft = oscillator(0.9, 0.1, "0.5 [N/m^3]*x^3");
    let truth = first_harmonic(|t, [x], [v]| [0.1 * (0.9 * t).cos() - x - 0.1 * v + 0.5 * x * x * x], 0.9, 60);
    assert!((truth - 0.8478).abs() < SHOWN_ROUNDED, "{truth}");
    let note = remark(&soft);
    assert!(note.contains("amplitudes do not hold") && note.contains("loses the motion"), "{note}");
}

/// A pendulum under 2 sin 2.5t N m, by its angle and by three coordinates on a pin: 0.6314 rad for the small motion's 0.55.
#[test]
fn the_measure_holds_with_reactions() {
    let study = "[[study]]\nkind = \"response\"\nover = \"w\"\nrange = [\"0.2 rad/s\", \"6 rad/s\"]\npoints = 15\n";
    let loads = "[dampers.d]\nalong = \"phi\"\ndamping = \"0.3 N m s\"\n[torques.f]\non = \"b\"\nvalue = \"2 [N m]*sin(w*t)\"\n";
    let angle = "gravity = [\"0\", \"-9.81 m/s^2\"]\n[parameters]\nw = \"2.5 rad/s\"\n[coordinates]\nphi = \"rad\"\n[bodies.b]\nangle = \"phi\"\nmass = \"1 kg\"\ncenter = [\"0\", \"-1 m\"]\n";
    let pinned = "gravity = [\"0\", \"-9.81 m/s^2\"]\n[parameters]\nw = \"2.5 rad/s\"\n[coordinates]\nx = \"m\"\ny = { unit = \"m\", start = \"-1 m\" }\nphi = \"rad\"\n\
        [bodies.b]\norigin = [\"x\", \"y\"]\nangle = \"phi\"\nmass = \"1 kg\"\n[points]\nP = { on = \"b\", at = [\"0\", \"1 m\"] }\nO = { on = \"ground\", at = [\"0\", \"0\"] }\n[pins.o]\nbetween = [\"P\", \"O\"]\n";
    let truth = first_harmonic(|t, [x], [v]| [2.0 * (2.5 * t).sin() - 9.81 * x.sin() - 0.3 * v], 2.5, 60);
    for model in [angle, pinned] {
        let note = remark(&format!("{model}{loads}{study}"));
        let [small, whole] = amplitudes(&note);
        assert!(
            (whole - truth).abs() < 2.0 * SHOWN_ROUNDED * truth && (small - 2.0 / f64::hypot(9.81 - 6.25, 0.75)).abs() < SHOWN_ROUNDED,
            "{truth}: {note}"
        );
    }
}

/// A gyroscope in a gimbal of the book, its equations by hand, J = 6e5 + 1050 cos² θ + 1500 sin² θ:
/// J φ'' + 900 φ' θ' sin θ cos θ + Ja Ω θ' cos θ + ... and 1050 θ'' - 450 φ'² sin θ cos θ - Ja Ω φ' cos θ + ...
#[test]
fn gyroscopic_terms_count_in_the_measure_of_small_motions() {
    let book = include_str!("../../../../tests/book/response.md");
    let section = book.split("## How far small motions hold").nth(1).expect("section");
    let text = section.split("```toml").nth(1).and_then(|t| t.split("```").next()).expect("model");
    let spin = 1500.0 * 73.3;
    let equations = |t: f64, [p, q]: [f64; 2], [pd, qd]: [f64; 2]| {
        let (s, c) = (q.sin(), q.cos());
        let inertia = 6e5 + 1050.0 * c * c + 1500.0 * s * s;
        let roll = 9e4 * t.sin() - 1.766e6 * p - 9e4 * pd - 900.0 * pd * qd * s * c - spin * qd * c;
        [roll / inertia, (450.0 * pd * pd * s * c - 2e3 * q - 3e3 * qd + spin * pd * c) / 1050.0]
    };
    let truth = first_harmonic(equations, 1.0, 80);
    let note = remark(text);
    let [small, whole] = amplitudes(&note);
    assert!(
        note.contains("`ph`") && (whole - truth).abs() < 4.0 * SHOWN_ROUNDED * truth && (small - 0.024).abs() < SHOWN,
        "{truth}: {note}"
    );
}
