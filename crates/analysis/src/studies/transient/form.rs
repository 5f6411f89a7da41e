//! Equations of motion as M q'' + B q' + C q = f(t), exactly, where they are linear.
//!
//! Every expression is evaluated as a first-order form over the states whose coefficients are [`Load`]s. Unless a place of rest is given to
//! linearise about, nothing is approximated: a product
//! of two motions, a function of a motion or a coefficient that changes with time is a fault that names the expression. Loads that switch at
//! scheduled instants are taken as they are in the middle of the phase.

use super::load::Load;
use super::obstacle::{Obstacle, Reason, Result, connected};
use super::value::{Value, slope};
use crate::Fault;
use crate::rest::formulas;
use algebra::double::Double;
use algebra::lu::Lu;
use std::collections::HashMap;
use symbolic::{Derivation, Edge, Equations, Expr, Function, Node, SymbolId};

/// M q'' + B q' + C q = f(t) within a phase; matrices row-major.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Form {
    /// Number of coordinates.
    pub n: usize,
    /// M.
    pub mass: Vec<f64>,
    /// B.
    pub damping: Vec<f64>,
    /// C.
    pub stiffness: Vec<f64>,
    /// What C has below its last digits, row by row as C; empty where that is not known.
    pub below: Vec<f64>,
    /// f over the time t of the model.
    pub loads: Vec<Load>,
    /// Auxiliary states (angles of prescribed turning) over t.
    pub turns: Vec<Load>,
}

impl Form {
    /// q'' of the state x = (q, q', ...) at t; not numbers where M is singular.
    pub fn accelerations(&self, t: f64, x: &[f64]) -> Vec<f64> {
        let n = self.n;
        let row = |i: usize| {
            let held: f64 = (0..n).map(|j| self.stiffness[i * n + j] * x[j] + self.damping[i * n + j] * x[n + j]).sum();
            self.loads[i].at(t) - held
        };
        Lu::new(&self.mass, n).solve(&(0..n).map(row).collect::<Vec<f64>>()).unwrap_or_else(|| vec![f64::NAN; n])
    }
}

/// Forms of the phases between the given instants: phase k lasts from `instants[k]` to `instants[k + 1]`.
///
/// *Errors*: S074 connections, S070 not linear, S071 coefficients change with time, S072 a load without a closed form.
///
/// With a place of rest q0 the forms are those of small motions and small loads about it, still over q itself: f contains C q0. Products of
/// loads and motions are dropped.
pub fn forms(equations: &Equations, instants: &[f64], rest: Option<&[f64]>) -> std::result::Result<Vec<Form>, Fault> {
    // reactions of released bodies follow from the motion; all others take part in it
    if !equations.conditions.is_empty() || equations.reactions.iter().any(|r| !r.law.is_hidden()) {
        return Err(connected());
    }
    let mut turns: Vec<f64> = Vec::new();
    let mut found = Vec::new();
    for span in instants.windows(2) {
        let mut walk = Walk::new(equations, 0.5 * (span[0] + span[1]), rest);
        let form = walk.phase(span, &mut turns).map_err(|o| o.fault(span[0]))?;
        found.push(form);
    }
    Ok(found)
}

/// One phase.
struct Walk<'e> {
    equations: &'e Equations,
    /// An instant inside the phase, which decides the switches.
    inside: f64,
    /// Where to linearise.
    rest: Option<&'e [f64]>,
    values: HashMap<Expr, Result<Value>>,
    symbols: HashMap<SymbolId, Result<Value>>,
}

impl<'e> Walk<'e> {
    fn new(equations: &'e Equations, inside: f64, rest: Option<&'e [f64]>) -> Walk<'e> {
        let mut symbols = HashMap::new();
        symbols.insert(equations.time, Ok(Value::of(Load::time())));
        let n = equations.coordinates.len();
        for (i, c) in equations.coordinates.iter().enumerate() {
            symbols.insert(c.symbols[0], Ok(Value::state(i, rest.map_or(0.0, |q| q[i]))));
            symbols.insert(c.symbols[1], Ok(Value::state(n + i, 0.0)));
        }
        for p in &equations.parameters {
            symbols.insert(p.symbol, Ok(Value::just(p.value)));
        }
        Walk { equations, inside, rest, values: HashMap::new(), symbols }
    }

    /// `turns` are the auxiliary states at the start of the phase, on return at its end; empty before the first phase.
    fn phase(&mut self, span: &[f64], turns: &mut Vec<f64>) -> Result<Form> {
        let equations = self.equations;
        for d in &equations.definitions {
            let value = self.of(d.formula);
            self.symbols.insert(d.symbol, value);
        }
        if turns.is_empty() {
            for a in &equations.auxiliaries {
                let start = self.of(a.start)?;
                turns.push(start.constant.as_constant().unwrap_or(0.0));
            }
        }
        let mut angles = Vec::new();
        for (a, turn) in equations.auxiliaries.iter().zip(turns.iter_mut()) {
            let rate = self.of(a.rate)?;
            if !rate.slopes.is_empty() {
                return Err(Obstacle(Reason::NotLinear, a.rate));
            }
            let mut angle = rate.constant.integral();
            angle.add(&Load::constant(*turn - angle.at(span[0])), 1.0);
            *turn = angle.at(span[1]);
            self.symbols.insert(a.symbol, Ok(Value::of(angle.clone())));
            angles.push(angle);
        }
        Ok(Form { turns: angles, ..self.form()? })
    }

    fn form(&mut self) -> Result<Form> {
        let equations = self.equations;
        let n = equations.coordinates.len();
        let zeros = vec![0.0; n * n];
        let mut form = Form { n, mass: zeros.clone(), damping: zeros.clone(), stiffness: zeros, ..Form::default() };
        for i in 0..n {
            for j in 0..n {
                let e = equations.mass.get(i, j);
                let value = self.of(e)?;
                if !value.slopes.is_empty() && self.rest.is_none() {
                    return Err(Obstacle(Reason::NotLinear, e));
                }
                form.mass[i * n + j] = self.coefficient(&value.constant).ok_or(Obstacle(Reason::Varying, e))?;
            }
        }
        for (i, &force) in equations.force.iter().enumerate() {
            let value = self.of(force)?;
            let mut load = value.constant;
            for (state, slope) in value.slopes {
                let number = self.coefficient(&slope).ok_or(Obstacle(Reason::Varying, force))?;
                if let (Some(q), true) = (self.rest, state < n) {
                    load.add(&Load::constant(q[state]), -number);
                }
                let matrix = if state < n { &mut form.stiffness } else { &mut form.damping };
                // h stands on the right, C and B on the left
                matrix[i * n + state % n] = -number;
            }
            form.loads.push(load);
        }
        form.below = self.below(&form.stiffness).unwrap_or_default();
        Ok(form)
    }

    /// What C has below its last digits: a weak spring lies there beside a hard one. None where its entries hang on a place.
    fn below(&self, stiffness: &[f64]) -> Option<Vec<f64>> {
        let equations = self.equations;
        let mut graph = equations.graph.clone();
        let known = formulas::definitions(equations);
        let mut list = vec![graph.zero(); stiffness.len()];
        let n = equations.coordinates.len();
        for (j, coordinate) in equations.coordinates.iter().enumerate() {
            let mut by = Derivation::through(&mut graph, &known, coordinate.symbols[0]);
            for (i, force) in equations.force.iter().enumerate() {
                list[i * n + j] = by.apply(&mut graph, *force);
            }
        }
        // what a frame gives is rounded
        let mounted = |s: SymbolId| equations.mounted.as_ref().is_some_and(|m| m.numbers().contains(&s));
        let number = |s: SymbolId| {
            let own = equations.parameters.iter().find(|p| p.symbol == s && !mounted(s));
            if s == equations.time { Some(Double::from(self.inside)) } else { own.map(|p| Double::of(p.value, p.rest)) }
        };
        let mut defined: Vec<(SymbolId, Double)> = Vec::new();
        for (symbol, formula) in &known {
            let value = |s: SymbolId| number(s).or_else(|| defined.iter().find(|d| d.0 == s).map(|d| d.1));
            if let Some(found) = graph.evaluate_double(&[*formula], &value) {
                defined.push((*symbol, found[0]));
            }
        }
        let value = |s: SymbolId| number(s).or_else(|| defined.iter().find(|d| d.0 == s).map(|d| d.1));
        let fine = graph.evaluate_double(&list, &value)?;
        // h stands on the right, C on the left
        Some(fine.iter().zip(stiffness).map(|(slope, c)| slope.negated().less(Double::from(*c)).round()).collect())
    }

    /// A coefficient of the equations; about a place of rest its mean, since what varies is a product of a small load and a small motion.
    fn coefficient(&self, value: &Load) -> Option<f64> {
        match self.rest {
            None => value.as_constant(),
            Some(_) => Some(value.mean()),
        }
    }

    /// The value of an expression, that of its parts first.
    fn of(&mut self, root: Expr) -> Result<Value> {
        for e in self.equations.graph.reachable(&[root]) {
            if !self.values.contains_key(&e) {
                let value = self.node(e);
                self.values.insert(e, value);
            }
        }
        self.known(root)
    }

    fn known(&self, e: Expr) -> Result<Value> {
        self.values.get(&e).cloned().unwrap_or(Err(Obstacle(Reason::NoClosedForm, e)))
    }

    fn node(&self, e: Expr) -> Result<Value> {
        let graph = &self.equations.graph;
        match graph.node(e) {
            Node::Number(r) => Ok(Value::just(r.to_f64())),
            Node::Pi => Ok(Value::just(std::f64::consts::PI)),
            Node::Symbol(s) => self.symbols.get(s).cloned().unwrap_or(Err(Obstacle(Reason::NotLinear, e))),
            Node::Sum { constant, terms } => {
                let mut sum = Value::just(constant.to_f64());
                for (term, factor) in terms {
                    sum.add(&self.known(*term)?, factor.to_f64());
                }
                Ok(sum)
            }
            Node::Product { coefficient, factors } => {
                let mut product = Value::just(coefficient.to_f64());
                for (base, exponent) in factors {
                    let power = self.power(&self.known(*base)?, exponent.to_f64()).map_err(|r| Obstacle(r, e))?;
                    product = self.times(&product, &power).ok_or(Obstacle(Reason::NotLinear, e))?;
                }
                Ok(product)
            }
            Node::Power { base, exponent } => {
                let exponent = self.known(*exponent)?;
                let exponent = exponent.number().ok_or(Obstacle(exponent.reason(), e))?;
                self.power(&self.known(*base)?, exponent).map_err(|r| Obstacle(r, e))
            }
            Node::Call { function, arguments } => {
                let arguments: Vec<Value> = arguments.iter().map(|a| self.known(*a)).collect::<Result<_>>()?;
                self.call(*function, &arguments).map_err(|r| Obstacle(r, e))
            }
            Node::Switch { guard, edge, then, otherwise } => {
                let side = self.decide(&self.known(*guard)?).map_err(|r| Obstacle(r, e))?;
                self.known(if side > 0.0 || side == 0.0 && *edge == Edge::Closed { *then } else { *otherwise })
            }
        }
    }

    /// The sign of a guard within the phase.
    fn decide(&self, guard: &Value) -> std::result::Result<f64, Reason> {
        let moving = !guard.slopes.is_empty();
        if moving && (self.rest.is_none() || guard.constant.as_constant().is_none_or(|c| c == 0.0)) {
            return Err(Reason::NotLinear);
        }
        // an affine guard changes its sign at a scheduled instant only, and phases end there
        let (a, b) = guard.constant.as_affine().ok_or(Reason::NoClosedForm)?;
        Ok(a * self.inside + b)
    }

    fn call(&self, function: Function, x: &[Value]) -> std::result::Result<Value, Reason> {
        if let Some(numbers) = x.iter().map(Value::number).collect::<Option<Vec<f64>>>() {
            return Ok(Value::just(function.value(numbers[0], numbers.get(1).copied().unwrap_or(0.0))));
        }
        if x.iter().any(|v| !v.slopes.is_empty()) {
            return if self.rest.is_some() { self.small(function, x) } else { Err(Reason::NotLinear) };
        }
        let affine = || x[0].constant.as_affine().ok_or(Reason::NoClosedForm);
        let half_sum = |sign: f64, (a, b): (f64, f64)| {
            let mut sum = Load::default();
            sum.add(&Load::growth(a, b), 0.5);
            sum.add(&Load::growth(-a, -b), 0.5 * sign);
            sum
        };
        Ok(Value::of(match function {
            Function::Sin => affine().map(|(a, b)| Load::sine(a, b))?,
            Function::Cos => affine().map(|(a, b)| Load::cosine(a, b))?,
            Function::Exp => affine().map(|(a, b)| Load::growth(a, b))?,
            Function::Sinh => half_sum(-1.0, affine()?),
            Function::Cosh => half_sum(1.0, affine()?),
            Function::Sign => Load::constant(Function::Sign.value(self.decide(&x[0])?, 0.0)),
            Function::Abs => {
                let mut value = Load::default();
                value.add(&x[0].constant, Function::Sign.value(self.decide(&x[0])?, 0.0));
                value
            }
            Function::Min | Function::Max => {
                let mut difference = x[0].clone();
                difference.add(&x[1], -1.0);
                let first_is_less = self.decide(&difference)? < 0.0;
                x[usize::from(first_is_less != (function == Function::Min))].constant.clone()
            }
            _ => return Err(Reason::NoClosedForm),
        }))
    }

    /// The product; none when both contain the motion, unless products of small motions are dropped.
    fn times(&self, a: &Value, b: &Value) -> Option<Value> {
        if !a.slopes.is_empty() && !b.slopes.is_empty() && self.rest.is_none() {
            return None;
        }
        let mut product = Value::of(a.constant.times(&b.constant));
        for (one, other) in [(a, b), (b, a)] {
            let slopes = one.slopes.iter().map(|(s, slope)| (*s, slope.times(&other.constant))).filter(|(_, c)| !c.is_zero());
            product.add(&Value { constant: Load::default(), slopes: slopes.collect() }, 1.0);
        }
        Some(product)
    }

    /// A power; about a place of rest c^p + p c^(p-1) δ.
    fn power(&self, base: &Value, exponent: f64) -> std::result::Result<Value, Reason> {
        if exponent == 1.0 || base.slopes.is_empty() {
            return base.power(exponent);
        }
        if self.rest.is_none() {
            return Err(Reason::NotLinear);
        }
        let constant = Value::of(base.constant.clone());
        let mut slope = constant.power(exponent - 1.0)?;
        slope = self.times(&slope, &Value::just(exponent)).ok_or(Reason::NotLinear)?;
        let moving = Value { constant: Load::default(), slopes: base.slopes.clone() };
        let mut sum = constant.power(exponent)?;
        sum.add(&self.times(&slope, &moving).ok_or(Reason::NotLinear)?, 1.0);
        Ok(sum)
    }

    /// f(c) + f'(c) δ.
    fn small(&self, function: Function, x: &[Value]) -> std::result::Result<Value, Reason> {
        if matches!(function, Function::Min | Function::Max) {
            let mut difference = x[0].clone();
            difference.add(&x[1], -1.0);
            let first_is_less = self.decide(&difference)? < 0.0;
            return Ok(x[usize::from(first_is_less != (function == Function::Min))].clone());
        }
        let still: Vec<Value> = x.iter().map(|v| Value::of(v.constant.clone())).collect();
        let mut sum = self.call(function, &still)?;
        let numbers: Option<Vec<f64>> = still.iter().map(Value::number).collect();
        let mut add = |slope: Load, of: &Value| {
            let moving = of.slopes.iter().map(|(s, c)| (*s, c.times(&slope))).filter(|(_, c)| !c.is_zero()).collect();
            sum.add(&Value { constant: Load::default(), slopes: moving }, 1.0);
        };
        match (function, numbers.as_deref()) {
            (Function::Atan2, Some([a, b])) => {
                let r2 = a * a + b * b;
                add(Load::constant(b / r2), &x[0]);
                add(Load::constant(-a / r2), &x[1]);
            }
            (_, Some([c])) => add(Load::constant(slope(function, *c).ok_or(Reason::NotLinear)?), &x[0]),
            // an angle that turns with time: its derivative is a load again
            (Function::Sin, _) => add(self.call(Function::Cos, &still)?.constant, &x[0]),
            (Function::Cos, _) => {
                let mut sine = Load::default();
                sine.add(&self.call(Function::Sin, &still)?.constant, -1.0);
                add(sine, &x[0]);
            }
            _ => return Err(Reason::NoClosedForm),
        }
        Ok(sum)
    }
}
