//! One-sided contacts: impacts, infinitely many of them, ropes that go slack, bodies that lie on each other.

use crate::common;

use analysis::integrate::crossings::{Change, Switch};
use analysis::{GuardKind, Mode};
use common::*;

/// A product of two numbers: the last place.
const EXACT: f64 = 1e-16;
/// Instants and states by a few operations: units of the last place.
const ROUNDING: f64 = 1e-15;
/// An impact behind others: the rounding of each moves the next.
const LANDED: f64 = 1e-13;
/// The limit of infinitely many impacts, summed.
const LIMIT: f64 = 1e-12;
/// Speeds of the late impacts, whose flights are short: rounding of the places over the flight.
const RATE: f64 = 1e-11;
/// A hundred thousand impacts: units of the last place of times about 1e5 add up.
const COUNTED: f64 = 1e-7;
/// The place after them, at speeds of ten.
const BOUNCED: f64 = 1e-6;

fn contact(at: usize) -> [GuardKind; 2] {
    [GuardKind::Contact { force: at + 1 }, GuardKind::Bound { of: at, exit: Mode::Positive }]
}

fn at_zero(value: f64, k: usize) -> f64 {
    if k == 0 { value } else { 0.0 }
}

/// Ball over a floor that moves as floor(t) = a sin(w t): y'' = -g + λ; guards: gap, λ. Restitution e.
fn ball(g: f64, e: f64, a: f64, w: f64) -> Hand {
    let floor = move |t: f64, k: usize| {
        let fact: f64 = (1..=k).map(|j| j as f64).product();
        let turned = [(w * t).sin(), (w * t).cos(), -(w * t).sin(), -(w * t).cos()][k % 4];
        a * turned * w.powi(k as i32) / fact
    };
    // λ = g + floor''
    let force = move |s: &Work, k: usize| at_zero(g, k) + floor(s.t, k + 2) * ((k + 1) * (k + 2)) as f64;
    Hand::new(&["m", "m/s"], 1, move |s, k| {
        let lambda = if s.modes[0] == 0.0 { force(s, k) } else { 0.0 };
        vec![s.x[1][k], lambda - at_zero(g, k)]
    })
    .guarded(2, move |s, k| vec![s.x[0][k] - floor(s.t, k), force(s, k)])
    .kinds(&contact(0))
    .projected(move |t, x, modes| {
        if modes[0] == Mode::Zero {
            (x[0], x[1]) = (floor(t, 0), floor(t, 1));
        }
        0.0
    })
    .colliding(move |x, _, closing| {
        assert_eq!(closing, [0]);
        // the floor of these tests is at rest whenever it is hit
        let before = x[1];
        x[1] = -e * before;
        vec![x[1] - before]
    })
}

fn impacts(switches: &[Switch]) -> Vec<(f64, [f64; 2])> {
    let rates = |s: &Switch| if let Change::Impact { rates, .. } = s.change { Some((s.t, rates)) } else { None };
    switches.iter().filter_map(rates).collect()
}

#[test]
fn bouncing_ball_comes_to_rest_at_the_sum_of_its_flights() {
    for (e, height) in [(0.5_f64, 1.0_f64), (0.9, 3.0), (0.99, 0.2), (0.0, 1.0), (0.9, 1e-6)] {
        let g = 9.81;
        let fall = (2.0 * height / g).sqrt();
        let end = fall * (1.0 + e) / (1.0 - e);
        let (x, switches) = run(&mut ball(g, e, 0.0, 1.0), &[height, 0.0], 10.0 * end, 1e-12).unwrap();
        assert_eq!(x, vec![0.0, 0.0]);
        let hits = impacts(&switches);
        for (k, (t, rates)) in hits.iter().enumerate().take(50) {
            let speed = g * fall * e.powi(k as i32);
            let exact = fall * (1.0 + 2.0 * (1..=k).map(|j| e.powi(j as i32)).sum::<f64>());
            assert!((t - exact).abs() < LANDED * end, "{e} {k} {t} {exact}");
            assert!((rates[0] + speed).abs() < RATE * speed && (rates[1] - e * speed).abs() < RATE * speed, "{e} {k} {rates:?}");
        }
        if e > 0.0 {
            let last = switches.last().unwrap();
            let Change::Rests { limit } = last.change else { panic!("{last:?}") };
            assert!((limit - end).abs() < LIMIT * end, "{e}: {limit} {end}");
            assert_eq!((last.before, last.after), (Mode::Positive, Mode::Zero));
        } else {
            assert_eq!((switches.len(), switches[0].after), (1, Mode::Zero));
        }
    }
}

#[test]
fn ideal_ball_bounces_1e5_times() {
    let g = 2.0;
    let (x, switches) = run(&mut ball(g, 1.0, 0.0, 1.0), &[1.0, 0.0], 2e5, 1e-12).unwrap();
    assert_eq!(switches.len(), 100_000);
    // flights of 2 s between impacts at 1, 3, 5, ...
    assert!((switches[99_999].t - 199_999.0).abs() < COUNTED, "{}", switches[99_999].t);
    assert!((x[0] - 1.0).abs() < BOUNCED);
}

#[test]
fn ball_on_a_floor_starts_in_contact_and_is_thrown_off() {
    // at rest: stays bit by bit
    let (x, switches) = run(&mut ball(9.81, 0.5, 0.0, 1.0), &[0.0, 0.0], 1e6, 1e-12).unwrap();
    assert_eq!((x, switches), (vec![0.0, 0.0], vec![]));
    // thrown up from the floor; thrown down against it
    let (_, switches) = run(&mut ball(10.0, 0.0, 0.0, 1.0), &[0.0, 5.0], 3.0, 1e-12).unwrap();
    assert_eq!((switches.len(), switches[0].t, switches[0].after), (1, 1.0, Mode::Zero));
    let mut system = ball(10.0, 0.5, 0.0, 1.0);
    let flow = analysis::integrate::taylor::Flow::start(&mut system, 0.0, &[0.0, -4.0], &Default::default()).unwrap();
    assert_eq!((flow.state(), &flow.state_before()[..], flow.switches().len()), (&[0.0, 2.0][..], &[0.0, -4.0][..], 1));
    // a shaken floor throws it off when a w^2 sin(w t) = g
    let (a, w, g) = (0.2_f64, 8.0_f64, 9.81);
    let off = (g / (a * w * w)).asin() / w;
    let (_, switches) = run(&mut ball(g, 0.0, a, w), &[0.0, a * w], off + 0.05, 1e-13).unwrap();
    assert_eq!((switches.len(), switches[0].after, switches[0].guard), (1, Mode::Positive, 0));
    assert!((switches[0].t - off).abs() < LANDED, "{} {off}", switches[0].t);
}

#[test]
fn grazing_touches_without_an_impact() {
    // thrown up so that the top of the flight touches a ceiling at 1: y = 1 - g (t - t1)^2 / 2
    let g = 9.81_f64;
    let mut system = Hand::new(&["m", "m/s"], 1, move |s, k| vec![s.x[1][k], at_zero(-g, k)])
        .guarded(2, |s, k| vec![at_zero(1.0, k) - s.x[0][k], 0.0])
        .kinds(&contact(0))
        .colliding(|_, _, _| panic!("no impact"));
    let (_, switches) = run(&mut system, &[1.0 - g / 2.0, g], 1.5, 1e-12).unwrap();
    assert_eq!(switches, vec![]);
}

#[test]
fn nearly_grazing_is_an_impact() {
    // gap (t - 1)² - 1e-10: two roots 2e-5 apart in a step of the whole run
    let mut system = Hand::new(&["m", "m/s"], 1, |s, k| vec![s.x[1][k], at_zero(-2.0, k)])
        .guarded(2, |s, k| vec![at_zero(0.9999999999, k) - s.x[0][k], 0.0])
        .kinds(&contact(0))
        .colliding(|x, _, _| {
            let impulse = 2.0 * x[1];
            x[1] = -x[1];
            vec![impulse]
        });
    let (_, switches) = run(&mut system, &[0.0, 2.0], 2.0, 1e-12).unwrap();
    assert_eq!(switches.len(), 1);
    assert!((switches[0].t - 0.99999).abs() < RATE, "{}", switches[0].t);
}

/// Load on a rope of length 1 from (0, 0), y downwards: thrown up with u from hanging, the rope goes slack, the load falls and is caught.
#[test]
fn rope_goes_slack_and_catches() {
    let (g, u) = (10.0_f64, 4.0);
    let mut system = Hand::new(&["m", "m/s"], 1, move |s, k| {
        let tension = if s.modes[0] == 0.0 { at_zero(g, k) } else { 0.0 };
        vec![s.x[1][k], at_zero(g, k) - tension]
    })
    .guarded(2, move |s, k| vec![at_zero(1.0, k) - s.x[0][k], at_zero(g, k)])
    .kinds(&contact(0))
    .projected(|_, x, modes| {
        if modes[0] == Mode::Zero {
            (x[0], x[1]) = (1.0, 0.0);
        }
        0.0
    })
    .colliding(|x, _, _| {
        let impulse = x[1];
        x[1] = 0.0;
        vec![impulse]
    });
    let (x, switches) = run(&mut system, &[1.0, -u], 2.0, 1e-12).unwrap();
    assert_eq!(x, vec![1.0, 0.0]);
    assert_eq!(switches.len(), 1);
    assert!((switches[0].t - 2.0 * u / g).abs() < ROUNDING);
    assert_eq!(impacts(&switches)[0].1, [-u, 0.0]);
}

/// Balls on a line, radius 0, masses m; contacts between neighbours with restitution e. No forces.
fn line_of_balls(masses: &'static [f64], e: f64) -> Hand {
    let n = masses.len();
    let units: Vec<&str> = vec!["m"; n].into_iter().chain(vec!["m/s"; n]).collect();
    let kinds: Vec<GuardKind> = (0..n - 1).flat_map(|i| contact(2 * i)).collect();
    Hand::new(&units, n, move |s, k| {
        let rates: Vec<f64> = (0..n).map(|i| s.x[n + i][k]).collect();
        rates.into_iter().chain(vec![0.0; n]).collect()
    })
    .guarded(2 * (n - 1), move |s, k| (0..n - 1).flat_map(|i| [s.x[i + 1][k] - s.x[i][k], 0.0]).collect())
    .kinds(&kinds)
    .projected(move |_, x, modes| {
        for i in 0..n - 1 {
            if modes[2 * i] == Mode::Zero {
                let (place, rate) = (0.5 * (x[i] + x[i + 1]), 0.5 * (x[n + i] + x[n + i + 1]));
                (x[i], x[i + 1], x[n + i], x[n + i + 1]) = (place, place, rate, rate);
            }
        }
        0.0
    })
    .colliding(move |x, _, closing| {
        // the pairs that close fastest strike, until none closes
        let rate = |x: &[f64], i: usize| x[n + i + 1] - x[n + i];
        let mut impulses = vec![0.0; closing.len()];
        for _ in 0..2000 {
            let worst = closing.iter().map(|&c| rate(x, c / 2)).fold(0.0_f64, f64::min);
            let taking: Vec<usize> = (0..closing.len()).filter(|&j| rate(x, closing[j] / 2) <= worst.min(-1e-15)).collect();
            let target: Vec<f64> = taking.iter().map(|&j| -e * rate(x, closing[j] / 2)).collect();
            // [1/m ...] p = -(1 + e) rate, tridiagonal; relaxed until it stands
            for _ in 0..200 {
                for (&j, target) in taking.iter().zip(&target) {
                    let i = closing[j] / 2;
                    let p = (target - rate(x, i)) / (1.0 / masses[i] + 1.0 / masses[i + 1]);
                    impulses[j] += p;
                    x[n + i] -= p / masses[i];
                    x[n + i + 1] += p / masses[i + 1];
                }
            }
        }
        impulses
    })
}

#[test]
fn elastic_balls_exchange_their_speeds() {
    let (x, switches) = run(&mut line_of_balls(&[1.0, 1.0], 1.0), &[0.0, 1.0, 2.0, -1.0], 1.0, 1e-12).unwrap();
    let hits = impacts(&switches);
    assert_eq!((hits.len(), hits[0].1), (1, [-3.0, 3.0]));
    assert!((hits[0].0 - 1.0 / 3.0).abs() < EXACT && (x[2] + 1.0).abs() < ROUNDING && (x[3] - 2.0).abs() < ROUNDING);
}

#[test]
fn simultaneous_impacts_are_one_event() {
    // both outer balls reach the middle one at t = 1
    let (x, switches) = run(&mut line_of_balls(&[1.0, 2.0, 1.0], 0.5), &[-1.0, 0.0, 1.0, 1.0, 0.0, -1.0], 2.0, 1e-12).unwrap();
    assert_eq!(switches.len(), 2);
    assert!(impacts(&switches).iter().all(|hit| *hit == (1.0, [-1.0, 0.5])), "{switches:?}");
    assert!((x[0] + 0.5).abs() < ROUNDING && x[4].abs() < ROUNDING);
}

#[test]
fn contact_that_would_be_pulled_is_let_go() {
    // balls 2 and 3 touch and move together; ball 1 hits ball 2 from behind, ball 4 is hit by nothing: 3 is pushed, not pulled
    let start = [-1.0, 0.0, 0.0, 1.0, 0.0, 0.0];
    let (x, switches) = run(&mut line_of_balls(&[1.0, 1.0, 1.0], 0.0), &start, 2.0, 1e-12).unwrap();
    assert!(impacts(&switches).iter().any(|hit| hit.1 == [-1.0, 0.0]));
    // all three go on with a third of the speed
    assert!(x[3..].iter().all(|v| (v - 1.0 / 3.0).abs() < LIMIT), "{x:?}");
}

#[test]
fn a_start_inside_the_floor_is_a_named_fault() {
    let fault = run(&mut ball(9.81, 0.5, 0.0, 1.0), &[-1e-3, 0.0], 1.0, 1e-12).unwrap_err();
    assert_eq!(fault.code, "S012");
}
