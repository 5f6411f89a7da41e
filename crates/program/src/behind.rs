//! What stands behind results that are sampled: the operations of their tapes that can hide something between the points of evaluation.
//!
//! A result is replaced by a polynomial through its values. A pulse narrower than the distance of the points leaves no trace in these values, but it
//! does in what leads to them: the argument of exp runs from -1e6 to 0 and back while its values are 0 at both ends. So a sample records, beside the
//! results, the operands and results of each such operation, and who interpolates holds f over the range of the operands against the interpolated
//! result ([`crate::curve`]), as the integrator does with its Taylor polynomials.

use crate::curve::Curve;
use crate::guard::needed;
use crate::rounding::Given;
use crate::{Bound, By, Evaluator, Fault, Instruction, Mode, Operation, Point, Register, Tape, Unary};

/// How an operation is judged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Seen {
    /// A choice by the sign of the first operand.
    Choice,
    /// By the range of its values.
    Range(Curve),
}

/// An operation: places of its operands and its result in the record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// How it is judged.
    pub seen: Seen,
    /// First operand.
    pub a: usize,
    /// Second operand, or the first again.
    pub b: usize,
    /// Result.
    pub c: usize,
}

/// The operations behind the roots of a tape.
#[derive(Clone, Debug, Default)]
pub struct Behind {
    /// All of them, in the order of computation.
    pub nodes: Vec<Node>,
    /// For each root the operations that lead to it.
    pub of: Vec<Vec<usize>>,
    /// For each root the accelerations and reactions that it reads.
    pub inputs: Vec<Vec<usize>>,
    record: Vec<Entry>,
    /// Place of each register in the record.
    places: Vec<Option<usize>>,
}

/// What a place of the record holds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Entry {
    Register(Register),
    /// What decides by the mode of a guard: its value where the sign of the value counts.
    Guard(u32, Option<Register>),
}

/// Recorded for a choice that is held by the mode of its guard.
pub const HELD: f64 = f64::INFINITY;

impl Behind {
    /// Of all roots of the tape.
    pub fn new(evaluator: &Evaluator) -> Behind {
        let tape = evaluator.tape();
        let mut found = Behind { places: vec![None; tape.registers()], ..Behind::default() };
        let mut owner = vec![Vec::new(); tape.registers()];
        for instruction in &tape.body {
            let first = found.nodes.len();
            found.add(evaluator, instruction.into, &instruction.operation);
            let into = instruction.into.index();
            owner[into..into + instruction.operation.width()].fill((first..found.nodes.len()).collect());
        }
        for root in &tape.roots {
            let (nodes, inputs) = upstream(tape, root.register, &owner);
            found.of.push(nodes);
            found.inputs.push(inputs);
        }
        found
    }

    /// Of all that is needed of the dynamics in these modes: one list for everything.
    pub(crate) fn acting(dynamics: &Evaluator, modes: &[Mode]) -> Behind {
        let tape = dynamics.tape();
        let (wanted, _) = needed(dynamics, modes);
        let mut found = Behind { places: vec![None; tape.registers()], ..Behind::default() };
        for Instruction { into, operation, .. } in &tape.body {
            let span = into.index()..into.index() + operation.width();
            // what a mode holds cannot change within a step
            let held = matches!(operation, Operation::Choose { .. });
            if !held && wanted[span].iter().any(|w| *w) {
                found.add(dynamics, *into, operation);
            }
        }
        found.of = vec![(0..found.nodes.len()).collect()];
        found
    }

    /// The operations of this tape with those of the one that gives its accelerations: `supplier[i]` is the root there that is input i here. A record
    /// is then that of the other tape followed by that of this one.
    pub fn after(&self, other: &Behind, supplier: &dyn Fn(usize) -> Option<usize>) -> Behind {
        let (places, count) = (other.record.len(), other.nodes.len());
        let moved = |n: &Node| Node { a: n.a + places, b: n.b + places, c: n.c + places, ..*n };
        let nodes = other.nodes.iter().copied().chain(self.nodes.iter().map(moved)).collect();
        let of = self.of.iter().zip(&self.inputs).map(|(own, inputs)| {
            let roots = inputs.iter().filter_map(|i| supplier(*i)).filter_map(|root| other.of.get(root));
            let mut list: Vec<usize> = roots.flatten().copied().chain(own.iter().map(|n| n + count)).collect();
            list.sort_unstable();
            list.dedup();
            list
        });
        let record = other.record.iter().chain(&self.record).copied().collect();
        Behind { nodes, of: of.collect(), inputs: self.inputs.clone(), record, places: Vec::new() }
    }

    /// The same for these of the roots, in this order.
    pub fn chosen(&self, roots: &[usize]) -> Behind {
        let of = roots.iter().map(|&i| self.of.get(i).cloned().unwrap_or_default()).collect();
        Behind { of, ..self.clone() }
    }

    /// Number of values in a record.
    pub fn width(&self) -> usize {
        self.record.len()
    }

    /// Appends the record of the last evaluation at `point`.
    pub fn record(&self, evaluator: &Evaluator, point: &Point, into: &mut Vec<f64>) {
        into.extend(self.record.iter().map(|entry| match entry {
            Entry::Register(r) => evaluator.value(*r),
            Entry::Guard(g, register) => match register {
                Some(r) if !is_held(*g, point) => evaluator.value(*r),
                _ => HELD,
            },
        }));
    }

    /// Appends bounds of the rounding of a record, after the last evaluation; the inputs may be off by `states` and `accelerations`. Returns those of
    /// the roots.
    pub fn rounding(&self, evaluator: &Evaluator, states: &[f64], accelerations: &[f64], into: &mut Vec<f64>) -> Vec<f64> {
        let bounds = evaluator.roundings(&Given::usual(states, accelerations));
        into.extend(self.record.iter().map(|entry| match entry {
            Entry::Register(r) | Entry::Guard(_, Some(r)) => bounds[r.index()],
            Entry::Guard(_, None) => 0.0,
        }));
        evaluator.tape().roots.iter().map(|root| bounds[root.register.index()]).collect()
    }

    fn add(&mut self, evaluator: &Evaluator, into: Register, operation: &Operation) {
        let next = Register(into.0 + 1);
        match operation {
            Operation::Multiply(a, b) => self.curve(Curve::Product, *a, *b, into),
            Operation::Square(a) => self.curve(Curve::Square, *a, *a, into),
            Operation::Divide(a, b) => self.curve(Curve::Quotient, *a, *b, into),
            Operation::Power(a, p) => {
                self.curve(Curve::Power(evaluator.coefficient(*p)), *a, *a, into);
            }
            Operation::Unary(Unary::Tan, _) | Operation::SinCos(_) => {}
            Operation::Unary(f, a) => self.curve(curve(*f), *a, *a, into),
            Operation::Atan2(a, b) => self.curve(Curve::Angle, *a, *b, into),
            Operation::SinhCosh(a) => {
                self.curve(Curve::Sinh, *a, *a, into);
                self.curve(Curve::Cosh, *a, *a, next);
            }
            Operation::Choose { by, .. } => {
                let a = match by {
                    By::Value(r) => self.place(*r),
                    By::Mode(g) => {
                        self.record.push(Entry::Guard(*g, evaluator.tape().guards.get(*g as usize).copied().flatten()));
                        self.record.len() - 1
                    }
                };
                let c = self.place(into);
                self.nodes.push(Node { seen: Seen::Choice, a, b: a, c });
            }
            Operation::Solve { matrix, right } => {
                // one unknown is a quotient
                if let ([Some(entry)], [right]) = (&matrix[..], &right[..]) {
                    self.curve(Curve::Quotient, *right, *entry, into);
                }
            }
            Operation::State(_) | Operation::System { .. } => {}
            Operation::Number(_) | Operation::Parameter(_) | Operation::Time | Operation::Acceleration(_) | Operation::Linear { .. } => {}
        }
    }

    fn curve(&mut self, curve: Curve, a: Register, b: Register, into: Register) {
        self.node(Seen::Range(curve), a, b, into);
    }

    fn node(&mut self, seen: Seen, a: Register, b: Register, c: Register) {
        let [a, b, c] = [a, b, c].map(|r| self.place(r));
        self.nodes.push(Node { seen, a, b, c });
    }

    fn place(&mut self, register: Register) -> usize {
        *self.places[register.index()].get_or_insert_with(|| {
            self.record.push(Entry::Register(register));
            self.record.len() - 1
        })
    }
}

/// The dynamics as they are sampled along a stretch of one combination of modes.
#[derive(Clone, Debug)]
pub struct Acting {
    dynamics: Evaluator,
    modes: Vec<Mode>,
    behind: std::sync::Arc<Behind>,
}

impl Acting {
    /// What acts in these modes.
    pub fn new(bound: &Bound, modes: &[Mode]) -> Acting {
        let behind = std::sync::Arc::new(Behind::acting(&bound.dynamics, modes));
        Acting { dynamics: bound.dynamics.clone(), modes: modes.to_vec(), behind }
    }

    /// Whether it is that of these modes.
    pub fn is_of(&self, modes: &[Mode]) -> bool {
        self.modes == modes
    }

    /// Its operations.
    pub fn behind(&self) -> &std::sync::Arc<Behind> {
        &self.behind
    }

    /// Appends the record of the operations at a point.
    ///
    /// *Errors*: those of the equations there.
    pub fn record(&mut self, point: &Point, into: &mut Vec<f64>) -> Result<(), Fault> {
        self.dynamics.evaluate(point)?;
        self.behind.record(&self.dynamics, point, into);
        Ok(())
    }

    /// Appends the rounding of the record at the last point, where the states may be off by `errors`.
    pub fn rounding(&self, errors: &[f64], into: &mut Vec<f64>) {
        self.behind.rounding(&self.dynamics, errors, &[], into);
    }
}

fn is_held(guard: u32, point: &Point) -> bool {
    point.modes.is_some() && point.active.is_none_or(|active| active.get(guard as usize) == Some(&true))
}

fn curve(f: Unary) -> Curve {
    match f {
        Unary::SquareRoot => Curve::Root,
        Unary::Exp => Curve::Exp,
        Unary::Log => Curve::Log,
        Unary::Asin => Curve::Asin,
        Unary::Acos => Curve::Acos,
        Unary::Atan | Unary::Tan => Curve::Atan,
        Unary::Tanh => Curve::Tanh,
        Unary::Asinh => Curve::Asinh,
        Unary::Acosh => Curve::Acosh,
        Unary::Atanh => Curve::Atanh,
    }
}

/// Operations and inputs that lead to a register.
fn upstream(tape: &Tape, register: Register, owner: &[Vec<usize>]) -> (Vec<usize>, Vec<usize>) {
    let mut wanted = vec![false; tape.registers()];
    wanted[register.index()] = true;
    let (mut nodes, mut inputs) = (Vec::new(), Vec::new());
    for instruction in tape.body.iter().rev() {
        let first = instruction.into.index();
        if !wanted[first..first + instruction.operation.width()].iter().any(|w| *w) {
            continue;
        }
        nodes.extend(owner[first].iter().copied());
        if let Operation::Acceleration(slot) = instruction.operation {
            inputs.push(slot as usize);
        }
        if let Operation::Choose { by: By::Mode(g), .. } = instruction.operation
            && let Some(guard) = tape.guards.get(g as usize).copied().flatten()
        {
            wanted[guard.index()] = true;
        }
        instruction.operation.operands(&mut |r| wanted[r.index()] = true);
    }
    nodes.sort_unstable();
    (nodes, inputs)
}
