//! Further expressions of a linearised machine, lowered once and evaluated at places and instants.

use super::{LinearMachine, Place};
use crate::Fault;
use program::lower::{self, Inputs};
use program::{Evaluator, Point, Tape};
use std::sync::Arc;
use symbolic::{Derivation, Expr};

/// Prepared expressions.
#[derive(Clone, Debug)]
pub struct Values(pub(super) Arc<Tape>);

impl LinearMachine {
    /// Generalized forces (index of a coordinate, force) of the equations at rest over time, as a tape.
    ///
    /// *Errors*: a symbol without a meaning here.
    pub fn over_time(&mut self, forces: &[(usize, Expr)]) -> Result<Values, Fault> {
        let list = self.linear.over_time(forces);
        let named: Vec<(String, Expr)> = list.iter().enumerate().map(|(i, e)| (format!("force {}", i + 1), *e)).collect();
        let inputs = Inputs { time: Some(self.linear.time()), ..self.inputs.clone() };
        Ok(Values(Arc::new(lower::expressions(&self.linear.graph, "forces", &inputs, &named)?)))
    }

    /// Their values at a place and at instants, for the parameters as they are.
    ///
    /// *Errors*: no finite value there.
    pub fn values_over_time(&self, prepared: &Values, place: &Place, times: &[f64]) -> Result<Vec<Vec<f64>>, Fault> {
        let mut evaluator = Evaluator::new(&prepared.0, &self.values)?;
        let states = self.states(place);
        let mut at = |time: f64| -> Result<Vec<f64>, Fault> {
            Ok(evaluator.evaluate(&Point { time, states: &states, accelerations: &place.accelerations, ..Point::default() })?.to_vec())
        };
        times.iter().map(|t| at(*t)).collect()
    }

    /// Values of further expressions of the graph of the linear equations at a place, with the parameters as they are now.
    ///
    /// *Errors*: one of them has no finite value.
    pub fn values_of(&self, list: &[Expr], place: &Place) -> Result<Vec<f64>, Fault> {
        self.values(&self.prepare(list)?, place)
    }

    /// Expressions of the graph of the linear equations as a tape, to be evaluated often.
    ///
    /// *Errors*: a symbol without a meaning here.
    pub fn prepare(&self, list: &[Expr]) -> Result<Values, Fault> {
        let named: Vec<(String, Expr)> = list.iter().enumerate().map(|(i, e)| (format!("value {}", i + 1), *e)).collect();
        Ok(Values(Arc::new(lower::expressions(&self.linear.graph, "values", &self.inputs, &named)?)))
    }

    /// The values of prepared expressions.
    ///
    /// *Errors*: one of them has no finite value.
    pub fn values(&self, prepared: &Values, place: &Place) -> Result<Vec<f64>, Fault> {
        let mut evaluator = Evaluator::new(&prepared.0, &self.values)?;
        let states = self.states(place);
        Ok(evaluator.evaluate(&Point { states: &states, accelerations: &place.accelerations, ..Point::default() })?.to_vec())
    }

    /// The values of prepared expressions in many places.
    ///
    /// *Errors*: one of them has no finite value.
    pub fn values_at(&self, prepared: &Values, places: &[Place]) -> Result<Vec<Vec<f64>>, Fault> {
        let mut evaluator = Evaluator::new(&prepared.0, &self.values)?;
        let one = |place: &Place| -> Result<Vec<f64>, Fault> {
            let states = self.states(place);
            Ok(evaluator.evaluate(&Point { states: &states, accelerations: &place.accelerations, ..Point::default() })?.to_vec())
        };
        places.iter().map(one).collect()
    }

    /// The mean force along the first coordinate at rest, and its derivatives by that coordinate up to an order, as expressions of the graph of the linear
    /// equations; fewer where they are longer than so many nodes.
    pub fn force_series(&mut self, order: usize, longest: usize) -> Vec<Expr> {
        let linear = &mut self.linear;
        let mut list: Vec<Expr> = linear.force.first().copied().into_iter().collect();
        let Some(symbol) = linear.coordinates.first().map(|c| c[0]) else { return list };
        let mut derivation = Derivation::through(&mut linear.graph, &linear.definitions, symbol);
        while let Some(last) = list.last().copied().filter(|last| list.len() <= order && linear.graph.reachable(&[*last]).len() <= longest)
        {
            list.push(derivation.apply(&mut linear.graph, last));
        }
        list
    }

    /// The mean forces, their derivatives by parameters (parameter by parameter), and the reach of the reactions, as prepared expressions.
    ///
    /// *Errors*: a symbol without a meaning here.
    pub fn forces_by(&mut self, parameters: &[usize]) -> Result<Values, Fault> {
        let linear = &mut self.linear;
        let mut list = linear.force.clone();
        for p in parameters {
            let mut derivation = Derivation::through(&mut linear.graph, &linear.definitions, self.equations.parameters[*p].symbol);
            for force in &linear.force {
                list.push(derivation.apply(&mut linear.graph, *force));
            }
        }
        list.extend(linear.reach.entries().iter().copied());
        self.prepare(&list)
    }
}
