//! Equilibria with closed forms.

use analysis::studies::equilibrium::{Equilibrium, equilibrium};
use analysis::{Fault, Guard, Mode, Quantity, System};

/// Places in closed form: units of the last place.
const ROUNDING: f64 = 1e-15;
/// The same beside forces of ten.
const BALANCED: f64 = 1e-14;

type Forces = Box<dyn Fn(&[f64], &mut [f64], &mut [f64])>;

struct Static {
    states: Vec<Quantity>,
    forces: Forces,
}

impl Static {
    fn new(n: usize, forces: impl Fn(&[f64], &mut [f64], &mut [f64]) + 'static) -> Static {
        let states = (0..2 * n).map(|i| Quantity::new(&format!("q{i}"), "rad")).collect();
        Static { states, forces: Box::new(forces) }
    }
}

impl System for Static {
    fn states(&self) -> &[Quantity] {
        &self.states
    }
    fn n_coordinates(&self) -> usize {
        self.states.len() / 2
    }
    fn guards(&self) -> &[Guard] {
        &[]
    }
    fn outputs(&self) -> &[Quantity] {
        &[]
    }
    fn expand(&mut self, _: f64, _: &[f64], _: &[Mode], _: usize) -> Result<(), Fault> {
        Err(Fault::no_statics())
    }
    fn state(&self, _: usize) -> &[f64] {
        &[]
    }
    fn guard(&self, _: usize) -> &[f64] {
        &[]
    }
    fn observe(&mut self, _: f64, _: &[f64], _: &[Mode], _: &mut [f64]) -> Result<(), Fault> {
        Ok(())
    }
    fn statics(&mut self, x: &[f64], forces: &mut [f64], derivatives: &mut [f64]) -> Result<(), Fault> {
        (self.forces)(x, forces, derivatives);
        Ok(())
    }
}

#[test]
fn pendulum_hangs_stably_and_stands_unstably() {
    let mut system = Static::new(1, |x, h, k| {
        h[0] = -3.0 * x[0].sin();
        k[0] = -3.0 * x[0].cos();
    });
    let options = Equilibrium { guesses: vec![vec![3.0]], ..Equilibrium::default() };
    let outcome = equilibrium(&mut system, &[0.4, 0.0], &options);
    assert!(outcome.fault.is_none());
    let data = outcome.dataset;
    assert_eq!(data.columns[0].values.len(), 2);
    assert!(data.columns[0].values[0].abs() < ROUNDING);
    assert!((data.columns[0].values[1] - std::f64::consts::PI).abs() < ROUNDING);
    assert_eq!(data.column("stable").unwrap().values, vec![1.0, 0.0]);
    assert!(data.audits[0].ok);
}

#[test]
fn spring_of_any_stiffness_carries_its_weight() {
    for stiffness in [1e-6, 1.0, 1e9] {
        let mut system = Static::new(1, move |x, h, k| {
            h[0] = 9.81 * stiffness - stiffness * x[0];
            k[0] = -stiffness;
        });
        let data = equilibrium(&mut system, &[0.0, 0.0], &Equilibrium::default()).dataset;
        assert!((data.columns[0].values[0] - 9.81).abs() < BALANCED);
    }
}

#[test]
fn a_free_shaft_rests_anywhere() {
    // two discs on a shaft without bearing stiffness: together they may stand anywhere, and stay near where they begin
    let mut system = Static::new(2, |x, h, k| {
        h[0] = -5.0 * (x[0] - x[1]);
        h[1] = 5.0 * (x[0] - x[1]);
        k.copy_from_slice(&[-5.0, 5.0, 5.0, -5.0]);
    });
    let outcome = equilibrium(&mut system, &[0.5, 0.1, 0.0, 0.0], &Equilibrium::default());
    assert!(outcome.fault.is_none());
    let place = |i: usize| outcome.dataset.columns[i].values[0];
    assert!((place(0) - place(1)).abs() < BALANCED && (0.09..=0.51).contains(&place(0)), "{} {}", place(0), place(1));
}

#[test]
fn constant_force_without_resistance_has_no_equilibrium() {
    let mut system = Static::new(1, |x, h, k| {
        h[0] = 2.0 + x[0] * x[0];
        k[0] = 2.0 * x[0];
    });
    let fault = equilibrium(&mut system, &[1.0, 0.0], &Equilibrium::default()).fault.unwrap();
    assert_eq!(fault.code, "S007");
}
