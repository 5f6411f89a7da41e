//! The implicit method on systems and machines: Jacobians, exactness, agreement with the Taylor series.

use crate::linkage;
use crate::shaft;

use analysis::integrate::stiff::Method;
use analysis::integrate::taylor::{Flow, Options, Work};
use analysis::{Fault, Guard, Jacobian, Machine, Mode, Quantity, System};

/// A solution that the method reproduces: units of the last place of some steps.
const ROUNDING: f64 = 1e-14;
/// Two methods, each with the tolerance 1e-10.
const AGREED: f64 = 1e-9;
/// Central differences: step² and rounding over step.
const DIFFERENCE: f64 = 1e-7;

/// x' = fast (g(t) - x), by the Taylor coefficients of g: x_(k+1) = fast (g_k - x_k)/(k + 1).
struct Pulled {
    states: [Quantity; 1],
    fast: f64,
    g: fn(f64, usize) -> f64,
    series: Vec<f64>,
}

impl Pulled {
    fn new(fast: f64, g: fn(f64, usize) -> f64) -> Pulled {
        Pulled { states: [Quantity::new("x", "m")], fast, g, series: Vec::new() }
    }
}

impl System for Pulled {
    fn states(&self) -> &[Quantity] {
        &self.states
    }
    fn n_coordinates(&self) -> usize {
        0
    }
    fn guards(&self) -> &[Guard] {
        &[]
    }
    fn outputs(&self) -> &[Quantity] {
        &self.states
    }
    fn expand(&mut self, t: f64, x: &[f64], _: &[Mode], order: usize) -> Result<(), Fault> {
        self.series = vec![x[0]];
        for k in 0..order {
            self.series.push(self.fast * ((self.g)(t, k) - self.series[k]) / (k + 1) as f64);
        }
        Ok(())
    }
    fn state(&self, _: usize) -> &[f64] {
        &self.series
    }
    fn guard(&self, _: usize) -> &[f64] {
        &[]
    }
    fn observe(&mut self, _: f64, x: &[f64], _: &[Mode], values: &mut [f64]) -> Result<(), Fault> {
        values.copy_from_slice(x);
        Ok(())
    }
    fn jacobian(&mut self, _: f64, _: &[f64], _: &[Mode], jacobian: &mut [f64]) -> Result<Jacobian, Fault> {
        jacobian[0] = -self.fast;
        Ok(Jacobian::Given)
    }
}

fn flow(system: &mut impl System, x: &[f64], end: f64, options: &Options) -> (Vec<f64>, Work) {
    let mut flow = Flow::start(system, 0.0, x, options).unwrap();
    while !flow.reached(end) {
        flow.advance(end).unwrap();
    }
    (flow.state().to_vec(), flow.work().clone())
}

fn difference(system: &mut impl System, x: &[f64], modes: &[Mode]) -> f64 {
    let n = x.len();
    let mut exact = vec![0.0; n * n];
    assert_eq!(system.jacobian(0.3, x, modes, &mut exact).unwrap(), Jacobian::Given);
    let (mut worst, mut largest): (f64, f64) = (0.0, 0.0);
    for (j, x_j) in x.iter().enumerate() {
        let h = 1e-3 * (1.0 + x_j.abs());
        let mut at = |factor: f64| {
            let mut y = x.to_vec();
            y[j] += factor * h;
            system.expand(0.3, &y, modes, 1).unwrap();
            (0..n).map(|i| system.state(i)[1]).collect::<Vec<_>>()
        };
        let (a, b, c, d) = (at(-2.0), at(-1.0), at(1.0), at(2.0));
        let slope = |i: usize| (8.0 * (c[i] - b[i]) - (d[i] - a[i])) / (12.0 * h);
        for i in 0..n {
            worst = worst.max((slope(i) - exact[i * n + j]).abs());
            largest = largest.max(exact[i * n + j].abs());
        }
    }
    worst / largest
}

/// Fourth-order differences of smooth formulas err by about 1e-9 of the largest derivative.
#[test]
fn jacobians_of_machines_match_differences() {
    let mut machine = shaft::shaft(0.01);
    let x: Vec<f64> = (0..machine.states().len()).map(|i| 0.1 + 0.07 * i as f64).collect();
    let modes = machine.modes_by_value(0.3, &x).unwrap();
    let off = difference(&mut machine, &x, &modes);
    assert!(off < DIFFERENCE, "mass matrix: {off:e}");
    let mut machine = Machine::assembled(&linkage::slider_crank(5.0).e, &[], &|_| vec![]).unwrap();
    let x = machine.start().unwrap();
    let off = difference(&mut machine, &x, &[]);
    assert!(off < DIFFERENCE, "motion and reactions in one system: {off:e}");
}

/// Coefficient k about t of 1 + t - 2 t^4 + t^9.
fn polynomial(t: f64, k: usize) -> f64 {
    let binomial = |j: usize| (0..k).fold(1.0, |b, i| b * (j as f64 - i as f64) / (i + 1) as f64);
    [(0, 1.0), (1, 1.0), (4, -2.0), (9, 1.0)].iter().filter(|(j, _)| *j >= k).map(|(j, a)| a * binomial(*j) * t.powi((j - k) as i32)).sum()
}

/// x' = λ (p + p'/λ - x) has the solution p: a polynomial below the degree of the method is exact, and sets no limit to the step.
#[test]
fn polynomials_of_the_degree_of_the_method_are_exact() {
    let mut system = Pulled::new(1e6, |t, k| polynomial(t, k) + (k + 1) as f64 * polynomial(t, k + 1) / 1e6);
    let options = Options { method: Method::Stiff, span: 1.0, ..Options::default() };
    let (x, work) = flow(&mut system, &[1.0], 1.0, &options);
    assert!((x[0] - 1.0).abs() < ROUNDING, "{}", x[0] - 1.0);
    // a million time constants; the last coefficients are rounding, beside which a step grows by a quarter only
    assert!(work.implicit_steps <= 80 && work.stages == 13, "{work:?}");
}

/// x' = -λ (x - cos t), λ = 1e8: x = (cos t + sin t/λ)/(1 + 1/λ²) on the slow manifold (Prothero and Robinson).
#[test]
fn the_slow_manifold_is_followed_to_the_tolerance() {
    let cosine = |t: f64, k: usize| (t + k as f64 * std::f64::consts::FRAC_PI_2).cos() / (1..=k).map(|j| j as f64).product::<f64>();
    let want = |t: f64| (t.cos() + t.sin() * 1e-8) / (1.0 + 1e-16);
    for tolerance in [1e-4, 1e-8, 1e-12] {
        let mut system = Pulled::new(1e8, cosine);
        let (x, work) = flow(&mut system, &[want(0.0)], 20.0, &Options { tolerance, span: 20.0, ..Options::default() });
        assert!((x[0] - want(20.0)).abs() < 20.0 * tolerance, "{tolerance}: {}", x[0] - want(20.0));
        assert!(work.implicit_steps > 0 && work.steps < 400, "{work:?}");
    }
}

/// A linear oscillation is not stiff: no trial is kept, and the Taylor run is the same to the last bit.
#[test]
fn oscillation_that_carries_energy_stays_with_taylor() {
    let shaft_run = |method| {
        let mut machine = shaft::shaft(0.01);
        let x = machine.start().unwrap();
        flow(&mut machine, &x, 3.0, &Options { method, span: 3.0, ..Options::default() })
    };
    let (auto, taylor) = (shaft_run(Method::Auto), shaft_run(Method::Taylor));
    assert_eq!(auto.1.implicit_steps, 0);
    assert_eq!(auto.0, taylor.0);
    // and the implicit method, when it is asked for, finds the same motion
    let (stiff, work) = shaft_run(Method::Stiff);
    assert!(work.implicit_steps > 10, "{work:?}");
    let off = stiff.iter().zip(&taylor.0).map(|(a, b)| (a - b).abs() / (1.0 + b.abs())).fold(0.0, f64::max);
    assert!(off < AGREED, "{off:e}");
}
