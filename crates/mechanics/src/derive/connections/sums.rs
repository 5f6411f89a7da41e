//! Sums over the reactions that were found: forces on coordinates, powers, remainders of balances, everything that must be known.

use super::connected::Connected;
use crate::scene::Scene;
use symbolic::Expr;
use symbolic::connections::Law;
use symbolic::equations::{Output, Role};
use words::Text;

impl Connected {
    /// Σ λ · generalized force, by differentiation, on coordinate j.
    pub fn force(&self, scene: &mut Scene, j: usize) -> Expr {
        let mut terms = Vec::new();
        for reaction in self.reactions.iter().filter(|r| r.law.is_reaction()) {
            for (_, e) in reaction.forces.iter().filter(|(i, _)| *i == j) {
                let symbol = scene.graph.symbol(reaction.symbol);
                terms.push(scene.graph.mul(*e, symbol));
            }
        }
        scene.graph.sum(&terms)
    }

    /// Σ λ · generalized force, from geometry, in a direction.
    pub fn geometric_force(&self, scene: &mut Scene, j: usize) -> Expr {
        let mut terms = Vec::new();
        for (reaction, columns) in self.reactions.iter().zip(&self.geometric) {
            if matches!(reaction.law, Law::Support) && j < scene.n() {
                continue;
            }
            if let Some(e) = columns.get(&j) {
                let symbol = scene.graph.symbol(reaction.symbol);
                terms.push(scene.graph.mul(*e, symbol));
            }
        }
        scene.graph.sum(&terms)
    }

    /// Power of reactions on the motion: what frictions take, and what all others give (nothing, unless something moves in a prescribed way).
    pub fn powers(&self, scene: &mut Scene) -> (Expr, Expr) {
        let (mut given, mut taken) = (Vec::new(), Vec::new());
        for (reaction, columns) in self.reactions.iter().zip(&self.geometric) {
            let support = matches!(reaction.law, Law::Support);
            let n = scene.n();
            let mut terms = Vec::new();
            for (j, e) in columns.iter().filter(|(j, _)| !support || **j == n) {
                let rate = scene.rate(*j);
                terms.push(scene.graph.mul(*e, rate));
            }
            let speed = scene.graph.sum(&terms);
            let symbol = scene.graph.symbol(reaction.symbol);
            let power = scene.graph.mul(symbol, speed);
            match reaction.law {
                Law::Friction(_) => taken.push(scene.graph.neg(power)),
                _ => given.push(power),
            }
        }
        (scene.graph.sum(&given), scene.graph.sum(&taken))
    }

    /// Σ |λ columns_j q'_j| of the reactions that do work on the coordinates.
    pub fn power_sizes(&self, scene: &mut Scene) -> Vec<Expr> {
        let mut sizes = Vec::new();
        for (reaction, columns) in self.reactions.iter().zip(&self.geometric).filter(|(r, _)| !matches!(r.law, Law::Support)) {
            let symbol = scene.graph.symbol(reaction.symbol);
            for (j, e) in columns {
                let rate = scene.rate(*j);
                let power = scene.graph.product(&[symbol, *e, rate]);
                sizes.push(scene.graph.call(symbolic::Function::Abs, &[power]));
            }
        }
        sizes
    }

    /// Power of each motor, as a result that can be asked for: λ Σ forces q'.
    pub fn motor_powers(&self, scene: &mut Scene) -> Vec<Output> {
        let mut list = Vec::new();
        for reaction in self.reactions.iter().filter(|r| matches!(r.law, Law::Motor)) {
            let symbol = scene.graph.symbol(reaction.symbol);
            let mut terms = Vec::new();
            for (j, e) in &reaction.forces {
                let rate = scene.rate(*j);
                terms.push(scene.graph.product(&[symbol, *e, rate]));
            }
            let letter = scene.graph.symbol_info(reaction.symbol).name.clone();
            list.push(Output {
                name: reaction.name.replacen("force(", "power(", 1),
                symbol: scene.graph.symbol_id(&format!("P_{letter}"), 0),
                unit: "W".to_owned(),
                display: None,
                label: Text::new(format!("power of {}", reaction.label.en), format!("мощность: {}", reaction.label.ru)),
                role: Role::Power,
                formula: scene.graph.sum(&terms),
            });
        }
        list
    }

    /// Number of conditions that take a degree of freedom.
    pub fn ideal(&self) -> usize {
        self.reactions.iter().filter(|r| r.law.holds()).count()
    }

    /// Σ columns q'' - rest - Σ released λ of every balance.
    pub fn balance_residuals(&self, scene: &mut Scene) -> Vec<Expr> {
        let mut residuals = Vec::new();
        for (row, balance) in self.balances.iter().enumerate() {
            let mut terms = vec![scene.graph.neg(balance.rest)];
            for (j, e) in &balance.columns {
                terms.push(scene.graph.mul(*e, scene.q[*j][2]));
            }
            for reaction in &self.reactions {
                for (_, e) in reaction.released.iter().filter(|(i, _)| *i == row) {
                    let symbol = scene.graph.symbol(reaction.symbol);
                    let product = scene.graph.mul(*e, symbol);
                    terms.push(scene.graph.neg(product));
                }
            }
            residuals.push(scene.graph.sum(&terms));
        }
        residuals
    }

    /// Everything that must be known to evaluate it.
    pub fn expressions(&self) -> Vec<Expr> {
        let mut list = Vec::new();
        for condition in &self.conditions {
            list.extend(condition.place);
            list.extend([condition.rate, condition.remainder]);
            list.extend(condition.columns.iter().map(|(_, e)| *e));
        }
        for reaction in &self.reactions {
            list.extend(reaction.forces.iter().chain(&reaction.released).map(|(_, e)| *e));
            match &reaction.law {
                Law::Contact { gap, restitution, tangential, .. } => list.extend([*gap, *restitution, *tangential]),
                Law::Friction(friction) => {
                    list.extend([friction.sliding, friction.fixed]);
                    list.extend(friction.kinetic);
                    for normal in friction.components() {
                        list.push(normal.constant);
                        list.extend(normal.terms.iter().map(|(_, e)| *e));
                    }
                }
                Law::Ideal { .. } | Law::Rough { .. } | Law::Support | Law::Motor | Law::Place | Law::Transmission | Law::Tension => {}
            }
        }
        for balance in &self.balances {
            list.push(balance.rest);
            list.extend(balance.columns.iter().map(|(_, e)| *e));
        }
        list
    }

    /// Whether a condition moves the coordinate: it then needs no inertia.
    pub fn holds(&self, j: usize) -> bool {
        self.conditions.iter().any(|c| c.columns.iter().any(|(i, _)| *i == j))
    }
}
