//! Frames: exact numbers against machine numbers, order of convergence, limits of constraints, invariance.

use analysis::studies::structure_modes::{Modes, modes};
use analysis::studies::structure_statics::statics;
use structures::substructure::{Wish, substructure};
use structures::{Action, Assembly, Component, Displacement, Frame, Load, Node, Place, Rod, RodKind, Support};
use structures::{continuum, reduced::Condensation};
use symbolic::Rational;
use words::Text;

/// Sums over the elements of a frame: rounding times their number.
const ROUNDING: f64 = 1e-12;
/// Frequencies of a turned frame, whose matrices are rounded anew: rounding times the condition of the stiffness.
const FREQUENCY: f64 = 1e-11;
/// A reduction that loses nothing: what two eigenproblems of other size leave.
const LIMIT: f64 = 1e-9;
/// What a division into many parts leaves.
const REFINED: f64 = 1e-3;

fn node(name: &str, x: f64, y: f64) -> Node<f64> {
    Node { name: name.into(), at: [x, y], mass: 0.0, inertia: 0.0, springs: [0.0; 3] }
}

fn rod(frame: &Frame<f64>, a: usize, b: usize, kind: RodKind<f64>, mass: f64) -> Rod<f64> {
    let (p, q) = (frame.nodes[a].at, frame.nodes[b].at);
    let length = (q[0] - p[0]).hypot(q[1] - p[1]);
    let direction = [(q[0] - p[0]) / length, (q[1] - p[1]) / length];
    let name = format!("{}{}", frame.nodes[a].name, frame.nodes[b].name);
    Rod { name, ends: [a, b], length, direction, kind, mass, rotary: 0.0, hinged: [false; 2], divisions: 1 }
}

fn clamp(node: usize) -> Support<f64> {
    Support { name: format!("S{node}"), node, holds: [true; 3], axis: [1.0, 0.0] }
}

fn beam(bending: f64, axial: Option<f64>) -> RodKind<f64> {
    RodKind::Beam { bending, axial }
}

/// A clamped portal of three unlike rods, one of them inclined.
fn portal(axial: Option<f64>) -> Frame<f64> {
    let mut frame =
        Frame { nodes: vec![node("A", 0.0, 0.0), node("B", 0.3, 1.0), node("C", 1.5, 1.0), node("D", 1.5, -0.2)], ..Frame::default() };
    for (a, b, bending, mass) in [(0, 1, 1.0, 0.8), (1, 2, 2.0, 1.0), (2, 3, 1.5, 0.5)] {
        let rod = rod(&frame, a, b, beam(bending, axial), mass);
        frame.rods.push(rod);
    }
    frame.supports = vec![clamp(0), clamp(3)];
    frame
}

fn omegas(frame: &Frame<f64>, count: usize) -> Vec<f64> {
    let options = Modes { count, condensation: Condensation::Massless, ..Modes::default() };
    modes(frame, None, &options).unwrap().modes.iter().map(|m| m.omega).collect()
}

#[test]
fn frequencies_converge_with_the_fourth_power() {
    let frame = portal(None);
    let exact = continuum::frequencies(&frame, &omegas(&frame.divided(16), 3)).unwrap();
    let errors = |parts: usize| -> Vec<f64> { omegas(&frame.divided(parts), 3).iter().zip(&exact).map(|(w, e)| w / e - 1.0).collect() };
    let (coarse, fine) = (errors(4), errors(8));
    for (a, b) in coarse.iter().zip(&fine) {
        let order = (a / b).log2();
        assert!(*b > 0.0, "a mesh bends less than the continuum: {b:e}");
        assert!((order - 4.0).abs() < 0.15, "order {order}");
    }
}

#[test]
fn inextensible_rods_are_the_limit_of_stiff_ones() {
    let rigid = omegas(&portal(None).divided(4), 3);
    let near = |axial: f64| {
        let found = omegas(&portal(Some(axial)).divided(4), 3);
        found.iter().zip(&rigid).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
    };
    // the difference falls with 1/EA
    let (soft, stiff) = (near(1e5), near(1e7));
    // a hundred times the stiffness leaves a hundredth of the deviation: an order, not a value
    assert!(soft < 1e-2 && (soft / stiff - 100.0).abs() < 5.0, "{soft:e} {stiff:e}");
}

#[test]
fn a_turned_frame_oscillates_alike() {
    let frame = portal(Some(300.0)).divided(3);
    let mut turned = frame.clone();
    let (s, c) = 0.7_f64.sin_cos();
    let turn = |p: [f64; 2]| [c * p[0] - s * p[1], s * p[0] + c * p[1]];
    turned.nodes.iter_mut().for_each(|n| n.at = turn(n.at));
    turned.rods.iter_mut().for_each(|r| r.direction = turn(r.direction));
    for (a, b) in omegas(&frame, 6).iter().zip(omegas(&turned, 6)) {
        assert!((a / b - 1.0).abs() < FREQUENCY, "{a} {b}");
    }
}

#[test]
fn exact_and_machine_numbers_agree() {
    let mut frame = Frame { nodes: vec![node("A", 0.0, 0.0), node("B", 3.0, 4.0), node("C", 8.0, 4.0)], ..Frame::default() };
    for (a, b) in [(0, 1), (1, 2)] {
        let mut rod = rod(&frame, a, b, beam(2.0, None), 0.25);
        rod.direction = if a == 0 { [0.6, 0.8] } else { [1.0, 0.0] };
        frame.rods.push(rod);
    }
    frame.nodes[2].mass = 1.5;
    frame.supports = vec![clamp(0)];
    frame.loads = vec![
        Load { name: "F".into(), action: Action::Point { at: Place::Rod(1, 2.0), value: [0.0, -3.0, 0.5] } },
        Load { name: "q".into(), action: Action::Distributed { rod: 0, value: [[1.0, 0.0], [0.0, -2.0]] } },
    ];
    let component = Component::Along([0.0, 1.0]);
    let displacement =
        Displacement { name: "v".into(), symbol: "v".into(), label: Text::default(), place: Place::Node(2), component, loaded: false };
    frame.displacements.push(displacement);
    // 0.6 and 0.8 are meant as decimals
    let decimal = |v: &f64| Rational::parse_decimal(&format!("{v}"));
    let exact = frame.map(&decimal).unwrap();
    let (with, without) = (statics(&frame, Some(&exact)).unwrap(), statics(&frame, None).unwrap());
    let close = |a: f64, b: f64| (a - b).abs() <= ROUNDING * (1.0 + b.abs());
    for (a, b) in with.statics.ends.iter().flatten().zip(without.statics.ends.iter().flatten()) {
        assert!(close(*a, *b), "{a} {b}");
    }
    // the clamped end carries everything: moments of the loads about A = (0, 0). The force acts at (5, 4). Of the line load along AB (5 m) the
    // x part falls from 1 to 0 (2.5 at (1, 4/3)), the y part grows from 0 to -2 (-5 at (2, 8/3)).
    let loads = 5.0 * -3.0 + 0.5 - 4.0 / 3.0 * 2.5 + 2.0 * -5.0;
    assert!(close(with.statics.reactions[0][2], -loads), "{}", with.statics.reactions[0][2]);
    let found = modes(&frame, Some(&exact), &Modes::default()).unwrap();
    let equation = found.equation.unwrap();
    for mode in &found.modes {
        let square = mode.omega * mode.omega;
        let (mut value, mut size) = (0.0, 0.0_f64);
        for (k, c) in equation.iter().enumerate() {
            let term = c.to_f64() * square.powi(k as i32);
            value += term;
            size = size.max(term.abs());
        }
        assert!(value.abs() < ROUNDING * size, "{value:e} of {size:e}");
    }
}

#[test]
fn free_motions_are_named() {
    // the inclined post of the portal stands on a roller, the other on a hinge that slides: it moves along x
    let mut frame = portal(None);
    frame.supports.iter_mut().for_each(|s| s.holds = [false, true, false]);
    let fault = modes(&frame, None, &Modes::default()).unwrap_err();
    assert_eq!(fault.code, "S050");
    assert!(fault.what.en.contains("moves along"), "{}", fault.what.en);
    let mut hinged = portal(None);
    hinged.rods[0].hinged = [true, true];
    hinged.rods[1].hinged = [false, true];
    hinged.rods[2].hinged = [true, false];
    hinged.supports[1].holds = [true, true, false];
    let fault = statics(&hinged, None).unwrap_err();
    assert_eq!(fault.code, "S050");
}

#[test]
fn amplitudes_complete_the_named_displacements() {
    let mut frame = portal(Some(200.0)).divided(3);
    let component = Component::Along([1.0, 0.0]);
    frame.displacements.push(Displacement {
        name: "u".into(),
        symbol: "u".into(),
        label: Text::default(),
        place: Place::Node(1),
        component,
        loaded: false,
    });
    let assembly = Assembly::of(&frame);
    let all = omegas(&frame, 4);
    let with = |count: usize| {
        let found = substructure(&frame, &assembly, &Wish { count, ..Wish::default() }).unwrap();
        let n = found.named.len() + found.amplitudes;
        let modes = algebra::eigen::symmetric(n, &found.rounded(), &found.mass).unwrap();
        modes.values.iter().take(4).zip(&all).map(|(v, w)| (v.sqrt() / w - 1.0).abs()).fold(0.0, f64::max)
    };
    // with all amplitudes nothing is lost; with fewer the modes that span the space are kept, the next ones come out too high
    assert!(with(1000) < LIMIT, "{:e}", with(1000));
    assert!(with(4) < LIMIT && with(2) > 1e-6, "{:e} {:e}", with(4), with(2));
}

#[test]
fn large_frames_are_solved_sparse_and_converge() {
    // ladder of bays
    let build = |bays: usize| {
        let mut frame = Frame::default();
        for i in 0..=bays {
            for j in 0..3 {
                frame.nodes.push(node(&format!("N{i}_{j}"), i as f64, j as f64));
            }
        }
        for i in 0..=bays {
            for j in 0..2 {
                let one = rod(&frame, 3 * i + j, 3 * i + j + 1, beam(1.0, Some(1000.0)), 1.0);
                frame.rods.push(one);
            }
            for j in 1..3 {
                if i < bays {
                    let one = rod(&frame, 3 * i + j, 3 * i + 3 + j, beam(1.0, Some(1000.0)), 1.0);
                    frame.rods.push(one);
                }
            }
            frame.supports.push(clamp(3 * i));
        }
        frame
    };
    let small = build(20);
    let (coarse, fine) = (omegas(&small.divided(2), 4), omegas(&small.divided(4), 4));
    for (a, b) in coarse.iter().zip(&fine) {
        assert!(a > b && a / b - 1.0 < REFINED, "{a} {b}");
    }
}
