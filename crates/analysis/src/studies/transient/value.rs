//! First-order forms over the states, with loads as coefficients: what an expression of a linear system is.

use super::load::Load;
use super::obstacle::Reason;
use algebra::elementary;
use symbolic::Function;

/// constant + Σ coefficient · state.
#[derive(Clone, Debug, Default)]
pub struct Value {
    pub constant: Load,
    /// By state, ascending; q then q'.
    pub slopes: Vec<(usize, Load)>,
}

impl Value {
    pub fn of(constant: Load) -> Value {
        Value { constant, slopes: Vec::new() }
    }
    pub fn just(c: f64) -> Value {
        Value::of(Load::constant(c))
    }
    /// The number, when it is one.
    pub fn number(&self) -> Option<f64> {
        if self.slopes.is_empty() { self.constant.as_constant() } else { None }
    }
    /// Why it is no number.
    pub fn reason(&self) -> Reason {
        if self.slopes.is_empty() { Reason::NoClosedForm } else { Reason::NotLinear }
    }
    pub fn state(i: usize, at: f64) -> Value {
        Value { constant: Load::constant(at), slopes: vec![(i, Load::constant(1.0))] }
    }

    pub fn add(&mut self, other: &Value, factor: f64) {
        self.constant.add(&other.constant, factor);
        for (state, slope) in &other.slopes {
            let i = self.slopes.partition_point(|(s, _)| s < state);
            if self.slopes.get(i).is_none_or(|(s, _)| s != state) {
                self.slopes.insert(i, (*state, Load::default()));
            }
            self.slopes[i].1.add(slope, factor);
        }
        self.slopes.retain(|(_, slope)| !slope.is_zero());
    }

    /// The value to a power.
    ///
    /// *Errors*: why it has no closed form.
    pub fn power(&self, exponent: f64) -> Result<Value, Reason> {
        if exponent == 1.0 {
            return Ok(self.clone());
        }
        if !self.slopes.is_empty() {
            return Err(Reason::NotLinear);
        }
        if let Some(number) = self.number() {
            return Ok(Value::just(if exponent.fract() == 0.0 {
                elementary::powi(number, exponent as i32)
            } else {
                elementary::pow(number, exponent)
            }));
        }
        if exponent.fract() != 0.0 || !(2.0..=64.0).contains(&exponent) {
            return Err(Reason::NoClosedForm);
        }
        Ok(Value::of((1..exponent as u32).fold(self.constant.clone(), |p, _| p.times(&self.constant))))
    }
}

/// f'(x); none at a corner.
pub fn slope(function: Function, x: f64) -> Option<f64> {
    Some(match function {
        Function::Sin => elementary::cos(x),
        Function::Cos => -elementary::sin(x),
        Function::Tan => 1.0 / elementary::powi(elementary::cos(x), 2),
        Function::Asin => 1.0 / (1.0 - x * x).sqrt(),
        Function::Acos => -1.0 / (1.0 - x * x).sqrt(),
        Function::Atan => 1.0 / (1.0 + x * x),
        Function::Sinh => elementary::cosh(x),
        Function::Cosh => elementary::sinh(x),
        Function::Tanh => 1.0 / elementary::powi(elementary::cosh(x), 2),
        Function::Asinh => 1.0 / elementary::hypot(x, 1.0),
        Function::Acosh => 1.0 / ((x - 1.0) * (x + 1.0)).sqrt(),
        Function::Atanh => 1.0 / ((1.0 - x) * (1.0 + x)),
        Function::Exp => elementary::exp(x),
        Function::Log => 1.0 / x,
        Function::Abs if x != 0.0 => x.signum(),
        Function::Sign if x != 0.0 => 0.0,
        _ => return None,
    })
}
