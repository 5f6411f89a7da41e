//! The conditions of a machine at a state that is being put together.

use algebra::elementary;
use program::{Bound, ConnectionRoots, Evaluator, Point, Program};
use std::sync::Arc;
use symbolic::Equations;
use symbolic::connections::Law;
use words::Text;

use crate::Fault;

/// Share of its typical length below which a gradient is rounding.
const DEAD: f64 = 1e-7;

/// The conditions at a state that is being put together.
pub(super) struct Bench<'e> {
    pub(super) equations: &'e Equations,
    pub(super) conditions: Evaluator,
    pub(super) balances: Evaluator,
    pub(super) roots: ConnectionRoots,
    pub(super) n: usize,
    pub(super) x: Vec<f64>,
    /// Of the last evaluation.
    pub(super) values: Vec<f64>,
    /// Typical effect of each coordinate on the conditions, so that changes of angles and lengths can be compared.
    pub(super) reach: Vec<f64>,
    /// Typical size of the terms of each condition's place.
    pub(super) sizes: Vec<f64>,
    /// Typical length of each gradient over `reach`: in some positions a condition has no levers.
    pub(super) spans: Vec<f64>,
    /// Coordinates whose place was moved from the start of the file.
    pub(super) moved: Vec<bool>,
}

impl<'e> Bench<'e> {
    pub(super) fn new(program: &Arc<Program>, equations: &'e Equations, parameters: &[f64]) -> Result<Bench<'e>, Fault> {
        let bound = Bound::new(program, parameters)?;
        let x = bound.start()?;
        let n = program.coordinates;
        let mut bench = Bench {
            equations,
            conditions: bound.evaluator(&program.connections)?,
            balances: bound.evaluator(&program.balances)?,
            roots: program.connection_roots(),
            n,
            x,
            values: Vec::new(),
            reach: vec![1.0; n],
            sizes: vec![0.0; equations.conditions.len()],
            spans: vec![1.0; equations.conditions.len()],
            moved: vec![false; n],
        };
        bench.measure_reach();
        Ok(bench)
    }

    pub(super) fn evaluate(&mut self, x: &[f64]) -> Result<(), Fault> {
        let values = self.conditions.evaluate(&Point { states: x, ..Point::default() })?;
        self.values.clear();
        self.values.extend_from_slice(values);
        Ok(())
    }

    pub(super) fn row(&self, condition: usize) -> &[f64] {
        let start = self.roots.jacobian.start + condition * self.n;
        &self.values[start..start + self.n]
    }
    pub(super) fn place(&self, condition: usize) -> f64 {
        self.values[self.roots.places.start + condition]
    }
    pub(super) fn rate(&self, condition: usize) -> f64 {
        self.values[self.roots.rates.start + condition]
    }
    pub(super) fn is_angle(&self, coordinate: usize) -> bool {
        self.equations.coordinates[coordinate].unit == "rad"
    }

    /// Conditions that hold at all times: not those of contacts and frictions.
    pub(super) fn lasting(&self) -> Vec<usize> {
        let lasts = |c: &usize| match self.equations.conditions[*c].reaction {
            None => true,
            Some(r) => matches!(self.equations.reactions[r].law, Law::Ideal { .. }),
        };
        (0..self.equations.conditions.len()).filter(lasts).collect()
    }

    /// Largest entries of the columns of J around the start, and the sizes of its rows: a single configuration may hide a lever.
    pub(super) fn measure_reach(&mut self) {
        let mut random = algebra::random::Random::new(7);
        let mut reach = vec![0.0_f64; self.n];
        let mut sizes = vec![0.0_f64; self.equations.conditions.len()];
        let mut rows: Vec<(usize, Vec<f64>)> = Vec::new();
        for trial in 0..5 {
            let mut x = self.x.clone();
            if trial > 0 {
                for (j, x_j) in x.iter_mut().enumerate().take(self.n) {
                    let unit = random.between(-1.0, 1.0);
                    *x_j += if self.is_angle(j) { unit } else { 0.5 * unit * *x_j };
                }
            }
            if self.evaluate(&x).is_err() {
                continue;
            }
            for c in self.lasting() {
                let row = self.row(c);
                reach.iter_mut().zip(row).for_each(|(r, j)| *r = r.max(j.abs()));
                rows.push((c, row.to_vec()));
                sizes[c] = sizes[c].max(self.place_size_here(c, &x));
            }
        }
        self.reach = reach.into_iter().map(|r| if r > 0.0 && r.is_finite() { r } else { 1.0 }).collect();
        self.sizes = sizes;
        let mut spans = vec![0.0_f64; self.equations.conditions.len()];
        for (c, row) in rows {
            spans[c] = spans[c].max(self.over_reach(&row));
        }
        self.spans = spans.into_iter().map(|s| if s > 0.0 && s.is_finite() { s } else { 1.0 }).collect();
    }

    /// Length of a gradient over the reach of the coordinates.
    pub(super) fn over_reach(&self, row: &[f64]) -> f64 {
        row.iter().zip(&self.reach).map(|(a, r)| elementary::powi(a / r, 2)).sum::<f64>().sqrt()
    }

    /// Whether one of these conditions has no levers here; what is left of them is rounding.
    pub(super) fn has_dead(&self, rows: &[usize]) -> bool {
        rows.iter().any(|&c| self.over_reach(self.row(c)) < DEAD * self.spans[c])
    }

    /// How large the terms are that meet in the place of a condition.
    pub(super) fn place_size(&self, condition: usize, x: &[f64]) -> f64 {
        self.place_size_here(condition, x).max(self.sizes[condition]).max(f64::MIN_POSITIVE)
    }

    pub(super) fn place_size_here(&self, condition: usize, x: &[f64]) -> f64 {
        let largest = (0..self.n).filter(|j| !self.is_angle(*j)).fold(0.0_f64, |m, j| m.max(x[j].abs()));
        let size: f64 = self.row(condition).iter().enumerate().map(|(j, a)| a.abs() * if self.is_angle(j) { 1.0 } else { largest }).sum();
        // a slider at zero with nothing that turns: its reach is all there is
        if size > 0.0 { size } else { self.row(condition).iter().fold(0.0_f64, |m, a| m.max(a.abs())) }
    }

    pub(super) fn rate_size(&self, condition: usize, x: &[f64]) -> f64 {
        let moved: f64 = self.row(condition).iter().zip(&x[self.n..2 * self.n]).map(|(a, v)| a.abs() * v.abs()).sum();
        moved.max(self.rate(condition).abs()).max(f64::MIN_POSITIVE)
    }

    /// Terms of a rate by the typical levers of its condition.
    pub(super) fn typical_rate(&self, condition: usize, x: &[f64]) -> f64 {
        self.spans[condition] * self.reach.iter().zip(&x[self.n..2 * self.n]).map(|(r, v)| r * v.abs()).sum::<f64>()
    }

    pub(super) fn name(&self, condition: usize) -> &Text {
        &self.equations.conditions[condition].name
    }

    pub(super) fn coordinate(&self, j: usize) -> &str {
        &self.equations.graph.symbol_info(self.equations.coordinates[j].symbols[0]).name
    }

    /// `phi1 = 0.3 rad, x = 0.1 m`.
    pub(super) fn configuration(&self) -> Text {
        let (mut en, mut ru) = (Vec::new(), Vec::new());
        for j in 0..self.n {
            let value = words::digits::rounded(self.x[j]);
            let (name, unit) = (self.coordinate(j), Text::unit(&self.equations.coordinates[j].unit));
            en.push(format!("{name} = {} {}", value.en, unit.en));
            ru.push(format!("{name} = {} {}", value.ru, unit.ru));
        }
        Text::new(en.join(", "), ru.join(", "))
    }
}

/// Names in a row, in both languages.
pub(crate) fn listed<'t>(names: impl Iterator<Item = &'t Text>) -> Text {
    let (mut en, mut ru) = (Vec::new(), Vec::new());
    for name in names {
        en.push(name.en.clone());
        ru.push(name.ru.clone());
    }
    Text::new(en.join("; "), ru.join("; "))
}
