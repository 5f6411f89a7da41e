//! Van der Pol's equation over two thousand (million) seconds by the implicit method: `cargo bench -p strutt-analysis --bench stiff`.

use analysis::integrate::stiff::Method;
use analysis::integrate::taylor::{Flow, Options};
use analysis::{Fault, Guard, Jacobian, Mode, Quantity, System};
use std::time::Instant;

/// x' = v, v' = mu (1 - x²) v - x.
struct VanDerPol {
    mu: f64,
    states: [Quantity; 2],
    x: Vec<f64>,
    v: Vec<f64>,
}

impl System for VanDerPol {
    fn states(&self) -> &[Quantity] {
        &self.states
    }
    fn n_coordinates(&self) -> usize {
        1
    }
    fn guards(&self) -> &[Guard] {
        &[]
    }
    fn outputs(&self) -> &[Quantity] {
        &self.states
    }
    fn expand(&mut self, _: f64, x: &[f64], _: &[Mode], order: usize) -> Result<(), Fault> {
        (self.x, self.v) = (vec![x[0]], vec![x[1]]);
        let mut damping = Vec::new();
        for k in 0..order {
            let square: f64 = (0..=k).map(|j| self.x[j] * self.x[k - j]).sum();
            damping.push(if k == 0 { 1.0 - square } else { -square });
            let product: f64 = (0..=k).map(|j| damping[j] * self.v[k - j]).sum();
            let next = (self.v[k], self.mu * product - self.x[k]);
            self.x.push(next.0 / (k + 1) as f64);
            self.v.push(next.1 / (k + 1) as f64);
        }
        Ok(())
    }
    fn state(&self, i: usize) -> &[f64] {
        if i == 0 { &self.x } else { &self.v }
    }
    fn guard(&self, _: usize) -> &[f64] {
        &[]
    }
    fn observe(&mut self, _: f64, x: &[f64], _: &[Mode], values: &mut [f64]) -> Result<(), Fault> {
        values.copy_from_slice(x);
        Ok(())
    }
    fn jacobian(&mut self, _: f64, x: &[f64], _: &[Mode], jacobian: &mut [f64]) -> Result<Jacobian, Fault> {
        jacobian.copy_from_slice(&[0.0, 1.0, -2.0 * self.mu * x[0] * x[1] - 1.0, self.mu * (1.0 - x[0] * x[0])]);
        Ok(Jacobian::Given)
    }
}

fn main() {
    for (mu, end, method) in [(1e3, 2e3, Method::Auto), (1e3, 2e3, Method::Stiff), (1e3, 2e3, Method::Taylor), (1e6, 2e6, Method::Auto)] {
        let states = [Quantity::new("x", "m"), Quantity::new("v", "m/s")];
        let mut system = VanDerPol { mu, states, x: Vec::new(), v: Vec::new() };
        let clock = Instant::now();
        let options = Options { span: end, method, ..Options::default() };
        let mut flow = Flow::start(&mut system, 0.0, &[2.0, 0.0], &options).expect("the start is regular");
        while !flow.reached(end) {
            flow.advance(end).expect("the motion is regular");
        }
        let ms = clock.elapsed().as_secs_f64() * 1e3;
        let work = flow.work();
        println!("mu = {mu:e}, {method:?}: {ms:9.2} ms, {} steps, {} implicit, x {:.12}", work.steps, work.implicit_steps, flow.state()[0]);
    }
}
