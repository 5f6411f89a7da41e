//! Assembly: what closes, what does not and why, what repeats.

use crate::linkage;

use analysis::connections::assemble;
use analysis::studies::simulate::{Simulate, simulate};
use analysis::{Fault, Machine, System};
use linkage::*;

/// A closed form of a few operations: units of the last place.
const ROUNDING: f64 = 1e-15;
/// What Newton leaves of lengths of some metres.
const CLOSED: f64 = 1e-14;
/// Digits that the value here is written with; the smallest change by a singular system.
const PUBLISHED: f64 = 1e-9;

fn assembled(b: &Build) -> Result<Machine, Fault> {
    Machine::assembled(&b.e, &[], &|_| vec![])
}

fn refused(b: &Build) -> Fault {
    assembled(b).err().unwrap()
}

/// Card D4: crank 0.087 from phi1 = 0, rod 0.087/0.123, slider on the line x = 0: r cos phi1 + l cos phi2 = 0.
fn hoist(phi2: Start) -> Build {
    let mut b = Build::new();
    let [phi1, w1] = b.coordinate("phi1", "rad", Start::Given(0.0), Start::Given(24.467));
    let [phi2, w2] = b.coordinate("phi2", "rad", phi2, Start::Guess(0.0));
    let (s1, s2) = (b.square(w1), b.square(w2));
    let (s1, s2) = (b.times(2.85, s1), b.times(0.1, s2));
    let t = b.add(&[s1, s2]);
    let zero = b.e.graph.zero();
    b.lagrange(t, zero, &[]);
    let (c1, c2) = (b.cos(phi1), b.cos(phi2));
    let (c1, c2) = (b.times(0.087, c1), b.times(0.087 / 0.123, c2));
    let place = b.add(&[c1, c2]);
    b.ideal("piston on its line", place);
    b
}

#[test]
fn published_angle_that_does_not_close_is_answered_by_the_one_that_does() {
    let fault = refused(&hoist(Start::Given(1.69)));
    assert_eq!(fault.code, "S015");
    assert!(fault.help.en.contains("phi2 = 1.694108602 rad"), "{fault}");
    assert!(fault.help.ru.contains("phi2 = 1,694108602 рад"), "{}", fault.help.ru);
    assert!(fault.what.en.contains("piston on its line"));
    // the printed value may be typed in
    let machine = assembled(&hoist(Start::Given(1.694108602))).unwrap();
    let x = machine.start().unwrap();
    assert!((x[1] - (std::f64::consts::FRAC_PI_2 + 0.123_f64.asin())).abs() < ROUNDING);
    assert!(machine.notes()[0].en.contains("is taken as"), "{:?}", machine.notes());
    // a guess leads to the nearest of the two configurations
    for (guess, want) in [(1.0, 1.694108602), (-1.0, -1.694108602), (2.5, 1.694108602), (4.0, 2.0 * std::f64::consts::PI - 1.694108602)] {
        let x = assembled(&hoist(Start::Guess(guess))).unwrap().start().unwrap();
        assert!((x[1] - want).abs() < PUBLISHED, "{guess}: {}", x[1]);
    }
    // a guess in line with the crank, where no small change helps
    let x = assembled(&hoist(Start::Guess(0.0))).unwrap().start().unwrap();
    assert!((x[1].abs() - 1.694108602).abs() < PUBLISHED, "{}", x[1]);
}

#[test]
fn inconsistent_rates_are_answered_too() {
    let mut b = hoist(Start::Guess(1.7));
    b.e.coordinates[1].rate = b.number(1.0);
    b.e.coordinates[1].given[1] = true;
    let fault = refused(&b);
    assert_eq!(fault.code, "S015");
    // at phi1 = 0 the crank moves along its own line: phi2' = 0; a finite phi1' cannot do
    assert!(fault.help.en.contains("phi2' = 0 rad/s"), "{fault}");
}

#[test]
fn lengths_that_do_not_reach_are_named_with_the_gap() {
    // rod of 0.3 from a crank pin on radius 0.1 to a pin 0.45 away
    let mut b = Build::new();
    let [a, w] = b.coordinate("a", "rad", Start::Given(0.3), Start::Given(1.0));
    let [c, v] = b.coordinate("c", "rad", Start::Guess(0.5), Start::Guess(0.0));
    let (w2, v2) = (b.square(w), b.square(v));
    let t = b.add(&[w2, v2]);
    let zero = b.e.graph.zero();
    b.lagrange(t, zero, &[]);
    let first = along(&mut b, [zero, zero], 0.1, a);
    let end = along(&mut b, first, 0.3, c);
    let far = b.number(0.45);
    let x = b.sub(end[0], far);
    b.ideal("pin D, x", x);
    b.ideal("pin D, y", end[1]);
    let fault = refused(&b);
    assert_eq!(fault.code, "S016", "{fault}");
    assert!(fault.what.en.contains("pin D") && fault.what.en.contains("left over"), "{fault}");
}

/// Point on a line: x, y with `conditions` of the form place = 0.
fn point(conditions: &[(&str, f64, f64, f64)]) -> Build {
    let mut b = Build::new();
    let [x, _] = b.coordinate("x", "m", Start::Guess(1.0), Start::Guess(0.0));
    let [y, _] = b.coordinate("y", "m", Start::Given(2.0), Start::Given(3.0));
    let t = kinetic(&mut b, 1.0, [x, y]);
    let zero = b.e.graph.zero();
    b.lagrange(t, zero, &[]);
    for (name, p, q, r) in conditions {
        let (p, q, r) = (b.times(*p, x), b.times(*q, y), b.number(*r));
        let place = b.add(&[p, q, r]);
        b.ideal(name, place);
    }
    b
}

#[test]
fn repeated_condition_is_left_out_and_its_reactions_are_open() {
    let b = point(&[("first", 1.0, -2.0, 0.0), ("second", -3.0, 6.0, 0.0)]);
    let mut machine = assembled(&b).unwrap();
    let notes: Vec<&str> = machine.notes().iter().map(|n| n.en.as_str()).collect();
    assert!(notes[0].contains("`second` repeats") && notes[0].contains("first; second"), "{notes:?}");
    assert!(notes[1].contains("first, second"), "{notes:?}");
    let start = machine.start().unwrap();
    assert!((start[0] - 4.0).abs() < CLOSED && (start[2] - 6.0).abs() < CLOSED);
    // an output that shows an open reaction is refused, the others are not
    assert_eq!(simulate(&mut machine, &start, Simulate::until(1.0)).fault.unwrap().code, "S019");
    let others = Simulate { outputs: Some(vec!["x".into(), "E".into()]), ..Simulate::until(1.0) };
    let outcome = simulate(&mut machine, &start, others);
    assert!(outcome.fault.is_none(), "{:?}", outcome.fault);
    assert!(outcome.fault.is_none() && outcome.dataset.column("x").is_some());
    assert!(outcome.dataset.notes.iter().any(|n| n.en.contains("their shares are open: first, second")));
}

#[test]
fn contradictory_conditions_are_named() {
    let fault = refused(&point(&[("first", 1.0, -2.0, 0.0), ("second", -3.0, 6.0, 0.5)]));
    assert_eq!(fault.code, "S017", "{fault}");
    assert!(fault.what.en.contains("first; second") || fault.what.en.contains("second; first"), "{fault}");
}

/// Parallelogram with equal cranks a = b, flat at the start: the coupler's conditions depend on each other there only.
fn parallelogram(angle: f64) -> Build {
    let mut b = Build::new();
    let [a, wa] = b.coordinate("a", "rad", Start::Given(angle), Start::Given(1.0));
    let [c, wc] = b.coordinate("b", "rad", Start::Guess(angle), Start::Guess(1.0));
    let [d, wd] = b.coordinate("c", "rad", Start::Guess(0.0), Start::Guess(0.0));
    let squares = [wa, wc, wd].map(|w| b.square(w));
    let t = b.add(&squares);
    let zero = b.e.graph.zero();
    b.lagrange(t, zero, &[]);
    let ground = b.number(0.4);
    let first = along(&mut b, [zero, zero], 0.1, a);
    let coupler = along(&mut b, first, 0.4, d);
    let other = along(&mut b, [ground, zero], 0.1, c);
    for (k, name) in ["pin, x", "pin, y"].into_iter().enumerate() {
        let place = b.sub(coupler[k], other[k]);
        b.ideal(name, place);
    }
    b
}

#[test]
fn flat_parallelogram_is_a_singular_start_and_others_are_not() {
    let fault = refused(&parallelogram(0.0));
    assert_eq!(fault.code, "S018", "{fault}");
    assert!(fault.what.en.contains("pin, x; pin, y") || fault.what.en.contains("pin, x"), "{fault}");
    let mut machine = assembled(&parallelogram(0.5)).unwrap();
    let start = machine.start().unwrap();
    assert!((start[1] - 0.5).abs() < CLOSED && start[2].abs() < CLOSED);
    // it runs through its flat positions with speed
    let outcome = simulate(&mut machine, &start, Simulate::until(7.0));
    assert!(outcome.fault.is_none(), "{:?}", outcome.fault);
    let a = outcome.dataset.column("a").unwrap().values.last().copied().unwrap();
    let b = outcome.dataset.column("b").unwrap().values.last().copied().unwrap();
    assert!((a - 7.5).abs() < PUBLISHED && (b - 7.5).abs() < PUBLISHED, "{a} {b}");
}

#[test]
fn redundant_loop_of_a_flat_mechanism_is_told_from_a_singular_one() {
    // the same coupler twice: four conditions of rank two everywhere
    let mut b = parallelogram(0.5);
    let place = b.e.conditions[0].place.unwrap();
    b.ideal("pin again, x", place);
    let assembly = assemble(&b.e, &[]).unwrap();
    let repeated = assembly.selection.repeated.unwrap();
    let members: Vec<usize> = repeated.members.iter().map(|(c, _)| *c).collect();
    assert_eq!((repeated.count, members), (1, vec![0, 1, 2]));
    assert_eq!((assembly.selection.conditions, assembly.undetermined.open), (vec![true; 3], vec![0, 2]));
}
