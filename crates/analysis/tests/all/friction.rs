//! Dry friction with sticking: exact cycles, exact rest.

use crate::common;

use analysis::integrate::crossings::Switch;
use analysis::{Fault, GuardKind, Mode};
use common::*;

/// Closed forms of a few operations: units of the last place.
const ROUNDING: f64 = 1e-15;
/// The first break-away: a root of a series at times about ten.
const BREAK: f64 = 1e-14;
/// Differences of instants about a hundred, one cycle after another, and constants published with twelve digits.
const CYCLE: f64 = 1e-12;

/// Guards of a friction: sliding speed at `at`, its two limits after it.
fn friction(at: usize) -> [GuardKind; 3] {
    [
        GuardKind::Friction { limits: [at + 1, at + 2], pressed: Vec::new() },
        GuardKind::Bound { of: at, exit: Mode::Positive },
        GuardKind::Bound { of: at, exit: Mode::Negative },
    ]
}

fn at_zero(value: f64, k: usize) -> f64 {
    if k == 0 { value } else { 0.0 }
}

/// Mass 1 on a spring of stiffness 1 on a belt: x'' = -x - λ, λ = kinetic sign(x' - belt), or what holds x' at the belt's speed.
fn belt_oscillator(belt: f64, fixed: f64, kinetic: f64) -> Hand {
    let lambda = move |modes: &[f64], x: &[f64], k: usize| if modes[0] == 0.0 { -x[k] } else { at_zero(kinetic * modes[0], k) };
    Hand::new(&["m", "m/s"], 1, move |s, k| {
        let rest = lambda(&s.modes, &s.x[0], k);
        vec![s.x[1][k], -s.x[0][k] - rest]
    })
    .guarded(3, move |s, k| {
        let force = lambda(&s.modes, &s.x[0], k);
        vec![s.x[1][k] - at_zero(belt, k), at_zero(fixed, k) - force, at_zero(fixed, k) + force]
    })
    .kinds(&friction(0))
    .projected(move |_, x, modes| {
        if modes[0] == Mode::Zero {
            x[1] = belt;
        }
        0.0
    })
}

/// The instants at which guard 0 leaves `Zero`, and those at which it comes to `Zero`.
fn turns(switches: &[Switch]) -> (Vec<f64>, Vec<f64>) {
    let pick = |mode: fn(&Switch) -> Mode| switches.iter().filter(|s| s.guard == 0 && mode(s) == Mode::Zero).map(|s| s.t).collect();
    (pick(|s| s.before), pick(|s| s.after))
}

#[test]
fn belt_oscillator_has_the_period_of_the_card() {
    let exact = 5.0 + std::f64::consts::PI + 2.0 * 0.4_f64.atan();
    let (_, switches) = run(&mut belt_oscillator(0.2, 1.0, 0.5), &[0.0, 0.2], 100.0, 1e-13).unwrap();
    let (breaks, sticks) = turns(&switches);
    assert_eq!((breaks.len(), sticks.len()), (11, 11));
    assert!((breaks[0] - 5.0).abs() < BREAK);
    for (i, pair) in breaks.windows(2).enumerate() {
        assert!((pair[1] - pair[0] - exact).abs() < CYCLE, "{i}: {:e}", pair[1] - pair[0] - exact);
    }
    for pair in sticks.windows(2) {
        assert!((pair[1] - pair[0] - exact).abs() < CYCLE);
    }
}

/// Card P2: carriage of mass m pulled through a spring c by a driver of constant speed v; x measured from where the spring is relaxed at t = 0.
fn carriage(m: f64, c: f64, v: f64, limits: [f64; 2]) -> Hand {
    let [fixed, kinetic] = limits;
    let pull = move |s: &Work, k: usize| c * (v * s.time(k) - s.x[0][k]);
    let lambda = move |s: &Work, k: usize| if s.modes[0] == 0.0 { pull(s, k) } else { at_zero(kinetic * s.modes[0], k) };
    Hand::new(&["m", "m/s"], 1, move |s, k| vec![s.x[1][k], (pull(s, k) - lambda(s, k)) / m])
        .guarded(3, move |s, k| vec![s.x[1][k], at_zero(fixed, k) - lambda(s, k), at_zero(fixed, k) + lambda(s, k)])
        .kinds(&friction(0))
        .projected(move |_, x, modes| {
            if modes[0] == Mode::Zero {
                x[1] = 0.0;
            }
            0.0
        })
}

#[test]
fn carriage_of_card_p2_sticks_and_slips_on_time() {
    let (m, c, v, fixed, kinetic) = (8.0_f64, 250.0, 1.2, 600.0, 200.0);
    let k = (c / m).sqrt();
    let alpha = k * (fixed - kinetic) / (c * v);
    let slip = 2.0 * (std::f64::consts::PI - alpha.atan()) / k;
    let stick = 2.0 * (fixed - kinetic) / (c * v);
    let (x, switches) = run(&mut carriage(m, c, v, [fixed, kinetic]), &[0.0, 0.0], 20.0, 1e-13).unwrap();
    let (breaks, sticks) = turns(&switches);
    assert!((breaks[0] - fixed / (c * v)).abs() < BREAK);
    for (b, s) in breaks.iter().zip(&sticks) {
        assert!((s - b - slip).abs() < CYCLE, "{:e}", s - b - slip);
    }
    for pair in breaks.windows(2) {
        assert!((pair[1] - pair[0] - slip - stick).abs() < CYCLE);
    }
    assert!((slip - 0.609700249444).abs() < CYCLE && (slip + stick - 3.276366916111).abs() < CYCLE);
    assert!(x[0] > 0.0);
}

/// Block on a rough incline: gravity along the slope f, friction limits fixed and kinetic, all per unit mass.
fn incline(f: f64, fixed: f64, kinetic: f64) -> Hand {
    let lambda = move |modes: &[f64], k: usize| if modes[0] == 0.0 { at_zero(f, k) } else { at_zero(kinetic * modes[0], k) };
    Hand::new(&["m", "m/s"], 1, move |s, k| vec![s.x[1][k], at_zero(f, k) - lambda(&s.modes, k)])
        .guarded(3, move |s, k| vec![s.x[1][k], at_zero(fixed, k) - lambda(&s.modes, k), at_zero(fixed, k) + lambda(&s.modes, k)])
        .kinds(&friction(0))
        .projected(|_, x, modes| {
            if modes[0] == Mode::Zero {
                x[1] = 0.0;
            }
            0.0
        })
}

#[test]
fn block_below_the_friction_limit_never_creeps() {
    let x0 = 0.1 + 0.2;
    for (f, fixed) in [(4.9, 5.0), (-4.9, 5.0), (0.0, 5.0), (5.0, 5.0), (5.0 * (1.0 + 1e-14), 5.0), (0.0, 0.0)] {
        let (x, switches) = run(&mut incline(f, fixed, fixed), &[x0, 0.0], 1e6, 1e-12).unwrap();
        assert_eq!((x, switches), (vec![x0, 0.0], vec![]), "{f} {fixed}");
    }
}

#[test]
fn block_above_the_limit_slides_from_the_start_and_a_thrown_one_comes_to_rest() {
    let (x, switches) = run(&mut incline(6.0, 5.0, 4.0), &[0.0, 0.0], 2.0, 1e-12).unwrap();
    assert_eq!((x, switches.len()), (vec![4.0, 4.0], 0));
    // uphill: decelerates with f + kinetic, stops, stays
    let (x, switches) = run(&mut incline(3.0, 5.0, 4.0), &[0.0, -7.0], 1e3, 1e-12).unwrap();
    assert!((x[0] + 3.5).abs() < ROUNDING && x[1] == 0.0, "{x:?}");
    assert_eq!((switches.len(), switches[0].t, switches[0].after), (1, 1.0, Mode::Zero));
    // steep: stops for an instant and slides back
    let (x, switches) = run(&mut incline(6.0, 5.0, 4.0), &[0.0, -10.0], 3.0, 1e-12).unwrap();
    assert_eq!((switches.len(), switches[0].t, switches[0].after), (1, 1.0, Mode::Positive));
    assert!((x[0] + 1.0).abs() < BREAK && (x[1] - 4.0).abs() < BREAK, "{x:?}");
}

/// v' = F(t) - λ with F = ramp t.
fn ramped(ramp: f64, fixed: f64, kinetic: f64) -> Hand {
    let lambda = move |s: &Work, k: usize| if s.modes[0] == 0.0 { ramp * s.time(k) } else { at_zero(kinetic * s.modes[0], k) };
    Hand::new(&["m", "m/s"], 1, move |s, k| vec![s.x[1][k], ramp * s.time(k) - lambda(s, k)])
        .guarded(3, move |s, k| vec![s.x[1][k], at_zero(fixed, k) - lambda(s, k), at_zero(fixed, k) + lambda(s, k)])
        .kinds(&friction(0))
        .projected(|_, x, modes| {
            if modes[0] == Mode::Zero {
                x[1] = 0.0;
            }
            0.0
        })
}

#[test]
fn equal_limits_break_away_without_a_jump_of_the_acceleration() {
    // the limit is reached at a time that is not a number of the computer: the acceleration there is zero but for rounding
    for ramp in [0.3, 0.7, 1.1, -0.3, -1.3] {
        let t = 3.0 + 1.0 / 3.0;
        let limit = f64::abs(ramp) * t;
        let (x, switches) = run(&mut ramped(ramp, limit, limit), &[0.0, 0.0], t + 2.0, 1e-12).unwrap();
        assert_eq!(switches.len(), 1, "{ramp}: {switches:?}");
        assert!((switches[0].t - t).abs() < BREAK);
        // x''' = ramp from there on
        assert!((x[0] - ramp * 8.0 / 6.0).abs() < CYCLE && (x[1] - ramp * 2.0).abs() < CYCLE, "{ramp} {x:?}");
    }
}

#[test]
fn friction_that_admits_no_state_is_a_named_fault() {
    // a static limit below the kinetic one: the push of 4.5 exceeds the first but not the second
    let fault: Fault = run(&mut incline(4.5, 4.0, 5.0), &[0.0, 0.0], 1.0, 1e-12).unwrap_err();
    assert_eq!(fault.code, "S011");
}
