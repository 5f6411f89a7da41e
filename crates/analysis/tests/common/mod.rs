//! Systems with hand-written Taylor recurrences and known motions.
#![allow(dead_code)]

use analysis::{Blow, Fault, Guard, GuardKind, Mode, Quantity, System};
use words::Text;

/// Series during an expansion: `x[i][0..=k]` are known, the recurrence gives `x[i][k + 1]`.
pub struct Work {
    pub t: f64,
    pub x: Vec<Vec<f64>>,
    pub aux: Vec<Vec<f64>>,
    pub modes: Vec<f64>,
}

impl Work {
    /// Coefficient k of the product of two rows.
    pub fn product(a: &[f64], b: &[f64], k: usize) -> f64 {
        (0..=k).map(|j| a[j] * b[k - j]).sum()
    }
    /// Coefficient k of time.
    pub fn time(&self, k: usize) -> f64 {
        match k {
            0 => self.t,
            1 => 1.0,
            _ => 0.0,
        }
    }
}

type Recurrence = Box<dyn Fn(&mut Work, usize) -> Vec<f64>>;
/// Moves (t, x) onto the conditions of the modes; returns the drift.
type Projection = Box<dyn Fn(f64, &mut [f64], &[Mode]) -> f64>;
/// Rates after an impact at the given guards; returns the impulses.
type ImpactLaw = Box<dyn Fn(&mut [f64], &[Mode], &[usize]) -> Vec<f64>>;
type GuardSeries = Box<dyn Fn(&Work, usize) -> Vec<f64>>;

/// A system by its recurrence: coefficient k of the rates of all states.
pub struct Hand {
    states: Vec<Quantity>,
    n: usize,
    guards: Vec<Guard>,
    n_aux: usize,
    rates: Recurrence,
    guard: GuardSeries,
    project: Projection,
    impact: ImpactLaw,
    work: Work,
    guard_values: Vec<Vec<f64>>,
    pub expansions: u64,
}

impl Hand {
    pub fn new(units: &[&str], n: usize, rates: impl Fn(&mut Work, usize) -> Vec<f64> + 'static) -> Hand {
        let states = units.iter().enumerate().map(|(i, unit)| Quantity::new(&format!("x{i}"), unit)).collect();
        let work = Work { t: 0.0, x: vec![], aux: vec![], modes: vec![] };
        let (rates, guard): (Recurrence, GuardSeries) = (Box::new(rates), Box::new(|_, _| vec![]));
        let (project, impact): (Projection, ImpactLaw) = (Box::new(|_, _, _| 0.0), Box::new(|_, _, _| vec![]));
        Hand { states, n, guards: vec![], n_aux: 0, rates, guard, project, impact, work, guard_values: vec![], expansions: 0 }
    }
    /// Number of auxiliary series of the recurrence.
    pub fn aux(mut self, n: usize) -> Hand {
        self.n_aux = n;
        self
    }
    pub fn guarded(mut self, n_guards: usize, guard: impl Fn(&Work, usize) -> Vec<f64> + 'static) -> Hand {
        self.guards = (0..n_guards).map(|i| Guard { name: Text::same(format!("g{i}")), ..Guard::default() }).collect();
        self.guard = Box::new(guard);
        self
    }
    pub fn kinds(mut self, kinds: &[GuardKind]) -> Hand {
        self.guards.iter_mut().zip(kinds).for_each(|(guard, kind)| guard.kind = kind.clone());
        self
    }
    pub fn projected(mut self, project: impl Fn(f64, &mut [f64], &[Mode]) -> f64 + 'static) -> Hand {
        self.project = Box::new(project);
        self
    }
    pub fn colliding(mut self, impact: impl Fn(&mut [f64], &[Mode], &[usize]) -> Vec<f64> + 'static) -> Hand {
        self.impact = Box::new(impact);
        self
    }
    pub fn scheduled(mut self, i: usize, t: f64) -> Hand {
        self.guards[i].scheduled = Some(t);
        self
    }
}

impl System for Hand {
    fn states(&self) -> &[Quantity] {
        &self.states
    }
    fn n_coordinates(&self) -> usize {
        self.n
    }
    fn guards(&self) -> &[Guard] {
        &self.guards
    }
    fn outputs(&self) -> &[Quantity] {
        &self.states
    }
    fn expand(&mut self, t: f64, x: &[f64], modes: &[Mode], order: usize) -> Result<(), Fault> {
        self.expansions += 1;
        self.work.t = t;
        self.work.modes = modes.iter().map(|m| m.sign()).collect();
        self.work.x = x.iter().map(|&x| vec![x]).collect();
        self.work.aux = vec![vec![]; self.n_aux];
        self.guard_values = vec![vec![]; self.guards.len()];
        for k in 0..=order {
            for (row, g) in self.guard_values.iter_mut().zip((self.guard)(&self.work, k)) {
                row.push(g);
            }
            if k < order {
                let rates = (self.rates)(&mut self.work, k);
                for (row, r) in self.work.x.iter_mut().zip(rates) {
                    row.push(r / (k + 1) as f64);
                }
            }
        }
        Ok(())
    }
    fn state(&self, i: usize) -> &[f64] {
        &self.work.x[i]
    }
    fn guard(&self, i: usize) -> &[f64] {
        &self.guard_values[i]
    }
    fn project(&mut self, t: f64, x: &mut [f64], modes: &[Mode]) -> Result<f64, Fault> {
        Ok((self.project)(t, x, modes))
    }
    fn impact(&mut self, _: f64, x: &mut [f64], modes: &[Mode], closing: &[usize]) -> Result<Blow, Fault> {
        let impulses = (self.impact)(x, modes, closing);
        Ok(Blow { impulses: closing.iter().copied().zip(impulses).collect(), ..Blow::default() })
    }
    fn observe(&mut self, _: f64, x: &[f64], _: &[Mode], values: &mut [f64]) -> Result<(), Fault> {
        values.copy_from_slice(x);
        Ok(())
    }
}

/// x'' = -w^2 x.
pub fn oscillator(w: f64) -> Hand {
    Hand::new(&["m", "m/s"], 1, move |s, k| vec![s.x[1][k], -w * w * s.x[0][k]])
}

/// x' = -x.
pub fn decay() -> Hand {
    Hand::new(&["1"], 0, |s, k| vec![-s.x[0][k]])
}

/// Plane Kepler problem, gravitational parameter 1. Aux: r^2, r^-3.
pub fn kepler() -> Hand {
    Hand::new(&["m", "m", "m/s", "m/s"], 2, |s, k| {
        let r2 = Work::product(&s.x[0], &s.x[0], k) + Work::product(&s.x[1], &s.x[1], k);
        s.aux[0].push(r2);
        // u = v^a:  k v_0 u_k = sum_{j<k} (a (k - j) - j) u_j v_{k-j}
        let u = if k == 0 {
            r2.powf(-1.5)
        } else {
            let (v, u) = (&s.aux[0], &s.aux[1]);
            (0..k).map(|j| (-1.5 * (k - j) as f64 - j as f64) * u[j] * v[k - j]).sum::<f64>() / (k as f64 * v[0])
        };
        s.aux[1].push(u);
        let ax = -Work::product(&s.x[0], &s.aux[1], k);
        let ay = -Work::product(&s.x[1], &s.aux[1], k);
        vec![s.x[2][k], s.x[3][k], ax, ay]
    })
    .aux(2)
}

/// Kepler's motion at the mean anomaly `m` from the perihelion, eccentricity e, semi-axis 1: (x, y).
pub fn kepler_position(e: f64, m: f64) -> (f64, f64) {
    let mut big_e = m;
    for _ in 0..200 {
        let step = (big_e - e * big_e.sin() - m) / (1.0 - e * big_e.cos());
        big_e -= step.clamp(-0.5, 0.5);
    }
    (big_e.cos() - e, (1.0 - e * e).sqrt() * big_e.sin())
}

fn constant(value: f64, k: usize) -> f64 {
    if k == 0 { value } else { 0.0 }
}

/// x'' = -a sign(x): parabolas; period 4 sqrt(2 X / a) for amplitude X.
pub fn relay_oscillator(a: f64) -> Hand {
    Hand::new(&["m", "m/s"], 1, move |s, k| vec![s.x[1][k], constant(-a * s.modes[0], k)]).guarded(1, |s, k| vec![s.x[0][k]])
}

/// Mass on a spring with dry friction by sign(v): x'' = -w^2 x - mu sign(v).
pub fn dry_oscillator(w: f64, mu: f64) -> Hand {
    Hand::new(&["m", "m/s"], 1, move |s, k| vec![s.x[1][k], -w * w * s.x[0][k] - constant(mu * s.modes[0], k)])
        .guarded(1, |s, k| vec![s.x[1][k]])
}

/// v' = f - mu sign(v).
pub fn pushed_block(f: f64, mu: f64) -> Hand {
    Hand::new(&["m", "m/s"], 1, move |s, k| vec![s.x[1][k], constant(f - mu * s.modes[0], k)]).guarded(1, |s, k| vec![s.x[1][k]])
}

/// Runs to `end` and returns the state there and the switches.
pub fn run(
    system: &mut Hand,
    x: &[f64],
    end: f64,
    tolerance: f64,
) -> Result<(Vec<f64>, Vec<analysis::integrate::crossings::Switch>), Fault> {
    let options = analysis::integrate::taylor::Options { tolerance, span: end, ..Default::default() };
    let mut flow = analysis::integrate::taylor::Flow::start(system, 0.0, x, &options)?;
    let mut switches = vec![];
    while !flow.reached(end) {
        flow.advance(end)?;
        switches.extend_from_slice(flow.switches());
    }
    Ok((flow.state().to_vec(), switches))
}

/// A clock c' = 1 and counters y_i' = sign(g_i(c)) for polynomials g_i given by their roots and a factor.
pub fn clocked(polynomials: &[(f64, &[f64])]) -> Hand {
    let n = polynomials.len();
    let units: Vec<&str> = std::iter::once("s").chain((0..n).map(|_| "1")).collect();
    let owned: Vec<(f64, Vec<f64>)> = polynomials.iter().map(|(f, r)| (*f, r.to_vec())).collect();
    Hand::new(&units, 0, move |s, k| {
        let mut rates = vec![constant(1.0, k)];
        rates.extend(s.modes.iter().map(|m| constant(*m, k)));
        rates
    })
    .guarded(n, move |s, k| {
        owned
            .iter()
            .map(|(factor, roots)| {
                let mut c = vec![*factor];
                for r in roots {
                    c.push(0.0);
                    for j in (0..c.len()).rev() {
                        c[j] = if j > 0 { c[j - 1] } else { 0.0 } + (s.x[0][0] - r) * c[j];
                    }
                }
                c.get(k).copied().unwrap_or(0.0)
            })
            .collect()
    })
}

/// v' = 1 + a e^(b t) K(t) with the pulses K = (1 - r^2) / (1 - 2 r cos t + r^2) = 1 + 2 sum r^n cos(n t). Aux: e^(b t), K.
pub fn swelling(a: f64, b: f64, r: f64) -> Hand {
    Hand::new(&["m/s"], 0, move |s, k| {
        let growth = if k == 0 { a * (b * s.t).exp() } else { b / k as f64 * s.aux[0][k - 1] };
        s.aux[0].push(growth);
        let mut power = 1.0;
        let u: Vec<f64> = (0..=k)
            .map(|j| {
                let turned = [s.t.cos(), -s.t.sin(), -s.t.cos(), s.t.sin()][j % 4];
                power /= j.max(1) as f64;
                constant(1.0 + r * r, j) - 2.0 * r * turned * power
            })
            .collect();
        let known = (1..=k).map(|j| u[j] * s.aux[1][k - j]).sum::<f64>();
        s.aux[1].push((constant(1.0 - r * r, k) - known) / u[0]);
        vec![constant(1.0, k) + Work::product(&s.aux[0], &s.aux[1], k)]
    })
    .aux(2)
}
