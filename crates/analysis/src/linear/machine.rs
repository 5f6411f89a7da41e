//! A linearised machine whose parameters can be changed.

mod accelerated;
pub mod values;

use std::sync::Arc;
use words::Message;

use program::lower::{self, Inputs};
use program::{Evaluator, Point, Tape};
use symbolic::linear::{About, Loads, Timing};
use symbolic::{Equations, Expr, Linear, SymbolId};
use words::Text;

use super::graded::hides;
use super::matrices::{Harmonic, Matrices, largest, parts, settle};
use super::sought::Seeking;
use crate::naming::notation;
use crate::rest::fine::Sought;
use crate::rest::near::{Found, Near};
use crate::rest::search::{FineRest, Statics, rest_near};
use crate::rest::system::ROUNDED;
use crate::waveform::Shape;
use crate::{Fault, Quantity};

/// A linearised machine with parameters that can be changed.
#[derive(Clone, Debug)]
pub struct LinearMachine {
    pub(super) linear: Linear,
    pub(super) equations: Arc<Equations>,
    pub(super) tape: Arc<Tape>,
    pub(super) evaluator: Evaluator,
    pub(super) inputs: Inputs,
    pub(super) names: Vec<Quantity>,
    pub(super) parameters: Vec<Quantity>,
    pub(super) values: Vec<f64>,
    /// Waveforms of [`Linear::forms`], with their rates as a tape.
    pub(super) shapes: Vec<Shape>,
    /// Rest with connections, made when it is first asked for.
    pub(super) near: Option<Box<Near>>,
    /// Whether all conditions on rates restrain places, once that is known.
    pub(super) placed: Option<bool>,
    /// Numbers that nobody gives.
    pub(super) seeking: Option<Seeking>,
}

/// Forces below this share of the terms that add up to them are rounding: some dozens of roundings.
const BALANCED: f64 = 64.0 * f64::EPSILON;

/// Everything that the tape gives.
struct Full {
    matrices: Matrices,
    remainders: Vec<f64>,
    reach: Vec<f64>,
}

/// A place of linearisation: q and, about a motion, q' and q''.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Place {
    /// q.
    pub q: Vec<f64>,
    /// q'; zeros at rest.
    pub rates: Vec<f64>,
    /// q''; zeros at rest.
    pub accelerations: Vec<f64>,
    /// λ of the ideal connections.
    pub multipliers: Vec<f64>,
    /// What q, and then λ, have below their last digits, where weak springs stand beside hard ones; else empty.
    pub below: Vec<f64>,
}

impl Place {
    /// At rest, without reactions.
    pub fn rest(q: &[f64]) -> Place {
        Place { q: q.to_vec(), rates: vec![0.0; q.len()], accelerations: vec![0.0; q.len()], ..Place::default() }
    }
    fn states(&self) -> Vec<f64> {
        self.q.iter().chain(&self.rates).chain(&self.multipliers).copied().collect()
    }
}

impl LinearMachine {
    /// Linearises equations of motion; parameters have the values of the model.
    ///
    /// *Errors*: formulas outside their domain for the parameters.
    pub fn new(equations: &Arc<Equations>, about: About) -> Result<LinearMachine, Fault> {
        let mut linear = Linear::new(equations, about);
        let symbols = |k: usize| linear.coordinates.iter().map(move |c| c[k]);
        let inputs = Inputs {
            parameters: equations.parameters.iter().map(|p| p.symbol).collect(),
            states: symbols(0)
                .chain(symbols(1))
                .chain(linear.multipliers.iter().copied())
                .chain(linear.forms.iter().map(|f| f.mean))
                .collect(),
            accelerations: symbols(2).collect(),
            definitions: linear.definitions.clone(),
            ..Inputs::default()
        };
        let tape = Arc::new(lower::expressions(&linear.graph, "linear", &inputs, &roots(&linear))?);
        let values: Vec<f64> = equations.parameters.iter().map(|p| p.value).collect();
        let shapes = shapes(&mut linear, &inputs, &values)?;
        let quantity = |symbol: SymbolId, unit: &str, label: &Text| {
            let name = &equations.graph.symbol_info(symbol).name;
            Quantity { label: label.clone(), symbol: notation(equations, name), ..Quantity::new(name, unit) }
        };
        Ok(LinearMachine {
            evaluator: Evaluator::new(&tape, &values)?,
            names: equations.coordinates.iter().map(|c| quantity(c.symbols[0], &c.unit, &c.label)).collect(),
            parameters: equations.parameters.iter().map(|p| quantity(p.symbol, &p.unit, &p.label)).collect(),
            equations: Arc::clone(equations),
            tape,
            inputs,
            values,
            linear,
            shapes,
            near: None,
            placed: None,
            seeking: None,
        })
    }

    /// The expressions.
    pub fn linear(&self) -> &Linear {
        &self.linear
    }
    /// The equations that were linearised.
    pub fn equations(&self) -> &Arc<Equations> {
        &self.equations
    }
    /// How time was treated.
    pub fn timing(&self) -> Timing {
        self.linear.timing
    }
    /// The coordinates.
    pub fn coordinates(&self) -> &[Quantity] {
        &self.names
    }
    /// The parameters.
    pub fn parameters(&self) -> &[Quantity] {
        &self.parameters
    }
    /// The number of a parameter now.
    pub fn value(&self, parameter: usize) -> f64 {
        self.values[parameter]
    }
    /// The position of a parameter by its name.
    pub fn parameter(&self, name: &str) -> Option<usize> {
        self.parameters.iter().position(|p| p.name == name)
    }

    /// Gives a parameter another number, and those that follow from it theirs.
    ///
    /// *Errors*: a formula over parameters has no value for it; S096 numbers of a frame that follow from it cannot be found for it. The machine is then as it
    /// was.
    pub fn set(&mut self, parameter: usize, value: f64) -> Result<(), Fault> {
        let mut values = self.values.clone();
        values[parameter] = value;
        self.renumber(&values)
    }

    /// The numbers of all parameters.
    pub fn numbers(&self) -> &[f64] {
        &self.values
    }

    /// Gives all parameters other numbers; those that follow from others without a formula are found anew.
    ///
    /// *Errors*: a formula over parameters has no value for them; S096. The machine is then as it was.
    pub fn renumber(&mut self, values: &[f64]) -> Result<(), Fault> {
        let values = self.followed(values)?;
        let before = std::mem::replace(&mut self.values, values);
        let put = self.put(&before);
        if put.is_err() {
            self.values = before;
            self.evaluator = Evaluator::new(&self.tape, &self.values)?;
            self.shapes.iter_mut().try_for_each(|shape| shape.bind(&self.values))?;
        }
        put
    }

    fn put(&mut self, before: &[f64]) -> Result<(), Fault> {
        self.evaluator = Evaluator::new(&self.tape, &self.values)?;
        let changed = |p: &usize| self.values.get(*p).map(|v| v.to_bits()) != before.get(*p).map(|v| v.to_bits());
        for shape in self.shapes.iter_mut().filter(|s| s.parameters.iter().any(changed)) {
            shape.bind(&self.values)?;
        }
        Ok(())
    }

    /// Values with the numbers that follow from them without a formula.
    pub(crate) fn followed(&self, values: &[f64]) -> Result<Vec<f64>, Fault> {
        let values = self.of_frame(values.to_vec())?;
        match &self.seeking {
            Some(seeking) => seeking.followed(values, &self.values),
            None => Ok(values),
        }
    }

    fn of_frame(&self, mut values: Vec<f64>) -> Result<Vec<f64>, Fault> {
        let Some(mounted) = &self.equations.mounted else { return Ok(values) };
        let index = |symbol: &SymbolId| self.equations.parameters.iter().position(|p| p.symbol == *symbol);
        let reach: Vec<usize> = mounted.reach().iter().filter_map(index).collect();
        if reach.iter().all(|i| values[*i].to_bits() == self.values[*i].to_bits()) {
            return Ok(values);
        }
        let found = mounted.renewed(&reach.iter().map(|i| values[*i]).collect::<Vec<_>>()).map_err(|message| Fault::new(*message))?;
        for (symbol, number) in mounted.numbers().iter().zip(found) {
            index(symbol).into_iter().for_each(|i| values[i] = number);
        }
        Ok(values)
    }

    /// The waveforms of loads and observed quantities for the parameters as they are.
    pub fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    /// A waveform at phases, for the parameters as they are.
    ///
    /// *Errors*: no finite value there.
    pub fn waveform(&self, form: usize, phases: &[f64]) -> Result<Vec<f64>, Fault> {
        self.shapes[form].values(&self.values, phases)
    }

    /// Waveforms that came up since the last call.
    pub(super) fn learn(&mut self) -> Result<(), Fault> {
        let known = self.shapes.len();
        self.inputs.states.extend(self.linear.forms[known..].iter().map(|f| f.mean));
        self.inputs.definitions.clone_from(&self.linear.definitions);
        let time = self.linear.time();
        for i in known..self.linear.forms.len() {
            let shape = self.linear.forms[i].wave.shape;
            self.shapes.push(Shape::new(&mut self.linear.graph, shape, time, &self.inputs, &self.values)?);
        }
        Ok(())
    }

    /// The matrices at a place.
    ///
    /// *Errors*: an entry has no finite value there.
    pub fn at(&mut self, place: &Place) -> Result<Matrices, Fault> {
        self.full(place).map(|f| f.matrices)
    }

    /// The largest rounding of an entry of B, and of C, where they were last evaluated.
    pub fn rounding(&self) -> [f64; 2] {
        let square = self.names.len() * self.names.len();
        let roundings = self.evaluator.root_roundings();
        [1, 2].map(|k| roundings.get(k * square..(k + 1) * square).map_or(0.0, largest))
    }

    fn full(&mut self, place: &Place) -> Result<Full, Fault> {
        let n = self.names.len();
        let (m, k) = (self.linear.conditions.len(), self.linear.multipliers.len());
        let states = self.states(place);
        let mut values =
            self.evaluator.evaluate(&Point { states: &states, accelerations: &place.accelerations, ..Point::default() })?.to_vec();
        settle(&mut values[2 * n * n..3 * n * n], &self.evaluator.root_roundings()[2 * n * n..]);
        let (mass, rest) = values.split_at(n * n);
        let (damping, rest) = rest.split_at(n * n);
        let (stiffness, rest) = rest.split_at(n * n);
        let (force, rest) = rest.split_at(n);
        let (_, rest) = rest.split_at(m);
        let (jacobian, rest) = rest.split_at(m * n);
        let (drift, rest) = rest.split_at(m * n);
        let (remainders, rest) = rest.split_at(self.linear.remainders.len());
        let (reach, rest) = rest.split_at(n * k);
        let (loads, shaped) = rest.split_at((2 * n + 1) * self.linear.loads.len());
        let shaped = self.linear.shaped.iter().zip(shaped.chunks_exact(n.max(1))).map(|((form, _), f)| (*form, f.to_vec()));
        let loads = loads.chunks_exact(2 * n + 1).map(|l| Harmonic { rate: l[0], cos: l[1..=n].to_vec(), sin: l[n + 1..].to_vec() });
        let low = if hides(&parts(damping, n).0, n) { self.damping_below(damping, place) } else { Some(Vec::new()) };
        let matrices = Matrices {
            n,
            jacobian: jacobian.to_vec(),
            drift: drift.to_vec(),
            on_rates: self.linear.on_rates.clone(),
            loads: loads.collect(),
            shaped: shaped.collect(),
            mass: mass.to_vec(),
            damping: damping.to_vec(),
            stiffness: stiffness.to_vec(),
            below: if hides(stiffness, n) { self.below(stiffness, place).unwrap_or_default() } else { Vec::new() },
            damping_open: low.is_none(),
            damping_below: low.unwrap_or_default(),
            force: force.to_vec(),
        };
        let mut full = Full { matrices, remainders: remainders.to_vec(), reach: reach.to_vec() };
        if !self.on_rates_restrain(&full.matrices, &place.q)? {
            return Ok(full);
        }
        (full.matrices.drift, full.matrices.on_rates) = (Vec::new(), Vec::new());
        Ok(full)
    }

    /// Whether the conditions on rates restrain places like the others.
    fn on_rates_restrain(&mut self, matrices: &Matrices, q: &[f64]) -> Result<bool, Fault> {
        if !self.linear.on_rates.contains(&true) {
            return Ok(true);
        }
        if matrices.drift.iter().any(|d| *d != 0.0) {
            return Ok(false);
        }
        if self.placed.is_none() {
            self.placed = Some(crate::rest::path::all_places(&self.equations, &self.values, q)?);
        }
        Ok(self.placed == Some(true))
    }

    /// States of a tape; reactions that are not known count as zero.
    pub(super) fn states(&self, place: &Place) -> Vec<f64> {
        let mut states = place.states();
        states.resize(2 * self.names.len() + self.linear.multipliers.len(), 0.0);
        states.extend(self.shapes.iter().map(|s| s.wave.mean));
        states
    }

    /// A place of rest near q, with the reactions that balance it.
    ///
    /// *Errors*: S007 when Newton's method finds none; S035 where a prescribed motion holds a coordinate.
    pub fn settle(&mut self, q: &[f64]) -> Result<Place, Fault> {
        if self.linear.conditions.is_empty() {
            let found = rest_near(self, q);
            return match self.fine_rest(found.as_ref().map_or(q, |x| x), if found.is_ok() { Sought::Found } else { Sought::Lost }) {
                Ok(Some(place)) => Ok(place),
                Err(fault) if found.is_ok() => Err(fault),
                _ => found.map(|q| Place::rest(&q)),
            };
        }
        self.with_near(|near, values| near.settle(values, q))
    }

    /// The place nearest to q that the connections allow, with the reactions that balance best there.
    ///
    /// *Errors*: S007 where there is none; S035 where a prescribed motion holds a coordinate.
    pub fn drawn(&mut self, q: &[f64]) -> Result<Place, Fault> {
        if self.linear.conditions.is_empty() {
            return Ok(Place::rest(q));
        }
        self.with_near(|near, values| near.drawn(values, q))
    }

    fn with_near(&mut self, find: impl FnOnce(&mut Near, &[f64]) -> Result<Found, Fault>) -> Result<Place, Fault> {
        if self.linear.multipliers.len() != self.linear.conditions.len() {
            return Err(driven());
        }
        let mut near = match self.near.take() {
            Some(near) => near,
            None => Box::new(Near::new(&self.equations)?),
        };
        let found = find(&mut near, &self.values);
        self.near = Some(near);
        let Found { q, reactions, below } = found?;
        let n = q.len();
        let index = |symbol: &SymbolId| reactions.iter().position(|(s, _)| s == symbol);
        let multipliers = self.linear.multipliers.iter();
        let low = |symbol: &SymbolId| index(symbol).map_or(0.0, |k| below[n + k]);
        let below: Vec<f64> = match below.is_empty() {
            true => Vec::new(),
            false => below[..n].iter().copied().chain(multipliers.clone().map(low)).collect(),
        };
        let of = |symbol: &SymbolId| index(symbol).map_or(0.0, |k| reactions[k].1);
        Ok(Place { multipliers: multipliers.map(of).collect(), below, ..Place::rest(&q) })
    }

    /// Whether M, B and C are the same in every place, so that small motions need no equilibrium.
    pub fn same_everywhere(&self) -> bool {
        let linear = &self.linear;
        let place = |s: SymbolId| linear.coordinates.iter().any(|c| c[0] == s);
        let entries = linear.mass.entries().iter().chain(linear.damping.entries()).chain(linear.stiffness.entries());
        linear.conditions.is_empty() && entries.copied().all(|e| !linear.graph.contains(e, place))
    }

    /// Whether the equations are anything but linear in coordinates, rates and accelerations.
    pub fn bends(&self) -> bool {
        !self.same_everywhere() || self.linear.timing.bent
    }

    /// Whether M, B, C, the mean forces or the conditions depend on a parameter, directly or through definitions and waveforms.
    pub fn depends_on(&self, parameter: usize) -> bool {
        let linear = &self.linear;
        let mut known = vec![self.equations.parameters[parameter].symbol];
        if self.equations.is_mounted_on(known[0]) || self.seeking.as_ref().is_some_and(|s| s.hangs_on(parameter)) {
            return true;
        }
        let on = |known: &[SymbolId], e: Expr| linear.graph.contains(e, |s| known.contains(&s));
        for (symbol, formula) in &linear.definitions {
            if on(&known, *formula) {
                known.push(*symbol);
            }
        }
        let squares = [&linear.mass, &linear.damping, &linear.stiffness, &linear.jacobian, &linear.drift, &linear.reach];
        let lists = [&linear.force, &linear.conditions, &linear.remainders];
        let mut all = squares.into_iter().flat_map(|m| m.entries()).chain(lists.into_iter().flatten());
        self.shapes.iter().any(|s| s.parameters.contains(&parameter)) || all.any(|e| on(&known, *e))
    }

    /// Derivatives of numbers that follow from a parameter without a formula, as (index of the number, derivative); empty where nothing follows.
    ///
    /// A central difference over the cube root of rounding: ten digits, of which Newton's method needs the first few.
    ///
    /// *Errors*: S096.
    pub fn followers(&self, parameter: usize) -> Result<Vec<(usize, f64)>, Fault> {
        if !self.equations.is_mounted_on(self.equations.parameters[parameter].symbol) {
            return Ok(Vec::new());
        }
        let step = algebra::elementary::cbrt(f64::EPSILON) * self.values[parameter].abs();
        let with = |change: f64| {
            let mut values = self.values.clone();
            values[parameter] += change;
            self.followed(&values)
        };
        let (low, high) = (with(-step)?, with(step)?);
        let slope = |i: usize| (i, (high[i] - low[i]) / (2.0 * step));
        Ok((0..low.len()).filter(|i| *i != parameter && low[*i].to_bits() != high[*i].to_bits()).map(slope).collect())
    }

    /// A zero of [`Linear::graph`] for each coordinate.
    pub fn zeros(&mut self) -> Vec<Expr> {
        let zero = self.linear.graph.zero();
        vec![zero; self.names.len()]
    }

    /// A symbol of the equations as a formula, that of a reaction say.
    pub fn symbol(&mut self, symbol: SymbolId) -> Expr {
        self.linear.graph.symbol(symbol)
    }

    /// The harmonics of generalized forces (by coordinate) of the equations that were linearised; none when they are not harmonic.
    ///
    /// *Errors*: a formula without a value somewhere in the period.
    pub fn harmonics_of(&mut self, forces: &[(usize, Expr)]) -> Result<Option<Loads>, Fault> {
        let found = self.linear.harmonics_of(&self.equations, forces);
        self.learn()?;
        Ok(found)
    }
}

fn shapes(linear: &mut Linear, inputs: &Inputs, values: &[f64]) -> Result<Vec<Shape>, Fault> {
    let time = linear.time();
    linear.forms.clone().iter().map(|f| Shape::new(&mut linear.graph, f.wave.shape, time, inputs, values)).collect()
}

fn roots(linear: &Linear) -> Vec<(String, Expr)> {
    let mut roots: Vec<(String, Expr)> = Vec::new();
    let mut push = |name: &str, list: &[Expr]| roots.extend(list.iter().enumerate().map(|(i, e)| (format!("{name} {}", i + 1), *e)));
    push("M", linear.mass.entries());
    push("B", linear.damping.entries());
    push("C", linear.stiffness.entries());
    push("force", &linear.force);
    push("condition", &linear.conditions);
    push("J", linear.jacobian.entries());
    push("drift", linear.drift.entries());
    push("remainder", &linear.remainders);
    push("reach", linear.reach.entries());
    for load in &linear.loads {
        push("rate", &[load.rate]);
        push("cos", &load.cos);
        push("sin", &load.sin);
    }
    for (_, factors) in &linear.shaped {
        push("factor", factors);
    }
    roots
}

/// Rest of a machine without connections; with them see [`crate::rest`].
impl Statics for LinearMachine {
    fn n_coordinates(&self) -> usize {
        self.names.len()
    }
    fn name(&self, i: usize) -> &str {
        &self.names[i].name
    }
    /// The mean force at rest and its derivatives.
    fn statics(&mut self, x: &[f64], forces: &mut [f64], derivatives: &mut [f64]) -> Result<(), Fault> {
        let found = self.full(&Place::rest(&x[..self.names.len()]))?;
        forces.copy_from_slice(&found.matrices.force);
        derivatives.iter_mut().zip(&found.matrices.stiffness).for_each(|(d, c)| *d = -c);
        Ok(())
    }
    fn unit(&self, i: usize) -> &str {
        &self.names[i].unit
    }
    fn fine(&mut self, q: &[f64], sought: Sought) -> Result<Option<FineRest>, Fault> {
        let Some(place) = self.fine_rest(q, sought)? else { return Ok(None) };
        let stable = self.at(&place)?.definite();
        Ok(Some(FineRest { q: place.q, stable }))
    }
    fn terms(&self) -> Vec<f64> {
        // the forces stand behind M, B and C
        let n = self.names.len();
        self.evaluator.root_roundings()[3 * n * n..3 * n * n + n].iter().map(|bound| bound / ROUNDED).collect()
    }
}

/// S035.
pub fn driven() -> Fault {
    Fault::new(Message {
        code: "S035",
        what: Text::new("a prescribed motion holds a coordinate", "заданное движение удерживает координату"),
        why: Text::new(
            "small motions are looked for about a state of rest, which a drive with an unknown force does not leave",
            "малые движения ищутся около состояния покоя, а привод с неизвестной силой его не допускает",
        ),
        help: Text::new(
            "write the prescribed motion as a formula of t in place of the coordinate",
            "запишите заданное движение формулой от t вместо координаты",
        ),
    })
}

impl Fault {
    /// A load, output or parameter that the model does not have.
    pub fn unknown(what: Text, names: &[String]) -> Fault {
        let list = names.join(", ");
        Fault::new(Message {
            code: "S030",
            what,
            why: Text::new(format!("the model offers: {list}"), format!("в модели есть: {list}")),
            help: Text::new("correct the name", "исправьте имя"),
        })
    }
}
