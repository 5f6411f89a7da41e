//! The equations of rest with numbers: loads that repeat act by their means over a period.

use program::lower::Inputs;
use symbolic::equations::Parameter;
use symbolic::linear::{Timing, at_rest};
use symbolic::{Equations, SymbolId};
use words::Text;

use crate::Fault;
use crate::waveform::Shape;

/// Equations of rest whose means follow the parameters.
#[derive(Clone, Debug)]
pub struct Resting {
    equations: Equations,
    shapes: Vec<Shape>,
    own: usize,
    /// How time was treated.
    pub timing: Timing,
}

impl Resting {
    /// Of equations of motion, with the numbers of their parameters.
    ///
    /// *Errors*: a waveform without a value somewhere in its period.
    pub fn new(equations: &Equations) -> Result<Resting, Fault> {
        let mut found = at_rest(equations);
        let values: Vec<f64> = equations.parameters.iter().map(|p| p.value).collect();
        let inputs = Inputs {
            parameters: equations.parameters.iter().map(|p| p.symbol).collect(),
            states: equations.coordinates.iter().map(|c| c.symbols[0]).collect(),
            definitions: found.definitions,
            ..Inputs::default()
        };
        let mut shapes = Vec::new();
        for form in &found.forms {
            let shape = Shape::new(&mut found.equations.graph, form.wave.shape, equations.time, &inputs, &values)?;
            found.equations.parameters.push(mean(form.mean, shape.wave.mean));
            shapes.push(shape);
        }
        Ok(Resting { equations: found.equations, shapes, own: values.len(), timing: found.timing })
    }

    /// The equations; the means of waveforms are parameters behind the machine's own.
    pub fn equations(&self) -> &Equations {
        &self.equations
    }

    /// All parameters of these equations for parameters of the machine.
    ///
    /// *Errors*: a waveform without a value.
    pub fn values(&mut self, parameters: &[f64]) -> Result<Vec<f64>, Fault> {
        let mut all = parameters[..self.own].to_vec();
        for shape in &mut self.shapes {
            shape.bind(parameters)?;
            all.push(shape.wave.mean);
        }
        Ok(all)
    }
}

fn mean(symbol: SymbolId, value: f64) -> Parameter {
    let label = Text::new("mean of a load over its period", "среднее нагрузки за период");
    Parameter { symbol, value, rest: 0.0, written: format!("{value}"), unit: "1".into(), label }
}
