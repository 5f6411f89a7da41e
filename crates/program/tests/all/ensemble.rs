//! Series of eight machines at once against those of each by itself.

use crate::common;
use common::*;
use program::ensemble::{Ensemble, LANES, Layout, Parts};
use program::{Bound, Mode, Tape, lower};
use std::sync::Arc;
use symbolic::{Equations, Function, Graph};

/// Sums in another order: units of the last place of the largest term, through recurrences of twenty orders.
const ROUNDING: f64 = 1e-11;
const ORDER: usize = 20;

/// x' = sin(a x + t) exp(-x²) + √(a + x²)/(1 + a x²) + (1 + x²)^a + log(2 + a x²) + tanh(a x) + if(t < a, x, a) + sinh(x/4)
fn equations() -> Equations {
    let mut e = empty(Graph::new());
    let (a, t) = (parameter(&mut e, "a", 1.0), e.graph.symbol(e.time));
    let zero = e.graph.zero();
    let x = auxiliary(&mut e, "x", zero);
    let g = &mut e.graph;
    let (one, two, square, ax) = (g.int(1), g.int(2), g.square(x), g.mul(a, x));
    let minus = g.neg(square);
    let phase = g.add(ax, t);
    let (sine, bell) = (g.call(Function::Sin, &[phase]), g.call(Function::Exp, &[minus]));
    let first = g.mul(sine, bell);
    let inside = g.add(a, square);
    let root = g.sqrt(inside);
    let scaled = g.mul(a, square);
    let below = g.add(one, scaled);
    let second = g.div(root, below);
    let base = g.add(one, square);
    let third = g.power(base, a);
    let argument = g.add(two, scaled);
    let (fourth, fifth) = (g.call(Function::Log, &[argument]), g.call(Function::Tanh, &[ax]));
    let four = g.int(4);
    let quarter = g.div(x, four);
    let sixth = g.call(Function::Sinh, &[quarter]);
    let rate = [second, third, fourth, fifth, sixth].into_iter().fold(first, |sum, term| g.add(sum, term));
    e.auxiliaries[0].rate = rate;
    e
}

fn bound(program: &Arc<program::Program>, a: f64) -> Bound {
    Bound::new(program, &[a]).unwrap().specialised().unwrap()
}

#[test]
fn every_lane_has_the_series_of_its_machine() {
    let program = Arc::new(lower::equations(&equations()).unwrap());
    let numbers: Vec<f64> = (0..LANES).map(|lane| 0.3 + 0.17 * lane as f64).collect();
    let nothing = Tape::default();
    let layouts: Vec<_> = numbers
        .iter()
        .map(|a| {
            let bound = bound(&program, *a);
            let tape = Arc::clone(&bound.program().dynamics);
            Layout::of(&Parts { dynamics: &tape, levels: &nothing, supply: &nothing, coordinates: 0 }).unwrap()
        })
        .collect();
    assert!(layouts.iter().all(|(layout, _)| *layout == layouts[0].0), "one structure for all values");
    let layout = Arc::new(layouts[0].0.clone());
    let mut ensemble = Ensemble::new(&layout, ORDER);
    let start: [f64; LANES] = std::array::from_fn(|lane| 0.4 - 0.1 * lane as f64);
    let times: [f64; LANES] = std::array::from_fn(|lane| 0.2 * lane as f64);
    (0..LANES).for_each(|lane| ensemble.load(lane, &layouts[lane].1));
    let mut values = ensemble.values();
    ensemble.evaluate(&times, &[start], &mut values);
    ensemble.expand(&values);
    for lane in 0..LANES {
        let mut bound = bound(&program, numbers[lane]);
        let modes: Vec<Mode> = bound.modes(times[lane], &[start[lane]]).unwrap();
        let mut jets = bound.jets(ORDER);
        jets.expand(times[lane], &[start[lane]], &modes, ORDER).unwrap();
        let largest = jets.state(0).iter().fold(0.0_f64, |m, c| m.max(c.abs()));
        for (k, (own, c)) in ensemble.state(0).iter().zip(jets.state(0)).enumerate() {
            assert!((own[lane] - c).abs() <= ROUNDING * largest.max(c.abs()), "lane {lane}, order {k}: {} against {c}", own[lane]);
        }
        assert!(values.rate(0)[lane].is_finite());
    }
}

/// What other lanes hold changes no bit.
#[test]
fn a_lane_does_not_see_its_neighbours() {
    let program = Arc::new(lower::equations(&equations()).unwrap());
    let nothing = Tape::default();
    let of = |a: f64| {
        let tape = Arc::clone(&bound(&program, a).program().dynamics);
        Layout::of(&Parts { dynamics: &tape, levels: &nothing, supply: &nothing, coordinates: 0 }).unwrap()
    };
    let layout = Arc::new(of(0.7).0);
    let series = |others: f64, lane: usize| {
        let mut ensemble = Ensemble::new(&layout, ORDER);
        (0..LANES).for_each(|l| ensemble.load(l, &of(if l == lane { 0.7 } else { others }).1));
        let mut values = ensemble.values();
        let start = std::array::from_fn(|l| if l == lane { 0.25 } else { others });
        ensemble.evaluate(&[0.5; LANES], &[start], &mut values);
        ensemble.expand(&values);
        ensemble.state(0).iter().map(|c| c[lane].to_bits()).collect::<Vec<_>>()
    };
    assert_eq!(series(0.4, 0), series(1e3, 7));
}

/// A number that overflows on the way to a finite rate is seen, in its lane alone: the scalar path refuses it.
#[test]
fn what_overflows_on_the_way_is_not_sound() {
    let mut e = empty(Graph::new());
    let zero = e.graph.zero();
    let x = auxiliary(&mut e, "x", zero);
    let g = &mut e.graph;
    let (one, large) = (g.int(1), g.call(Function::Exp, &[x]));
    let below = g.add(one, large);
    e.auxiliaries[0].rate = g.div(one, below);
    let program = Arc::new(lower::equations(&e).unwrap());
    let bound = Bound::new(&program, &[]).unwrap().specialised().unwrap();
    let nothing = Tape::default();
    let parts = Parts { dynamics: &bound.program().dynamics, levels: &nothing, supply: &nothing, coordinates: 0 };
    let (layout, numbers) = Layout::of(&parts).unwrap();
    let mut ensemble = Ensemble::new(&Arc::new(layout), ORDER);
    (0..LANES).for_each(|lane| ensemble.load(lane, &numbers));
    let mut values = ensemble.values();
    let start = std::array::from_fn(|lane| if lane == 3 { 800.0 } else { 1.0 });
    ensemble.evaluate(&[0.0; LANES], &[start], &mut values);
    assert_eq!(values.rate(0)[3], 0.0);
    assert_eq!(*values.sound(), std::array::from_fn(|lane| lane != 3));
}
