//! The flat tape: instructions over numbered registers, each written once.
//!
//! A tape has two sections. The *prologue* depends on parameters only and runs once per set of parameters; its registers are constants
//! for everything after. The *body* runs once per state. Registers are numbered in the order of the instructions, so every operand
//! has a smaller number than the result ([`crate::verify`] checks it).

use algebra::elementary;
use std::sync::Arc;

use crate::real::Real;
use crate::spare::Spare;
use symbolic::Expr;

/// A value: the number of the register that holds it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Register(pub u32);

impl Register {
    /// Position in tables of length [`Tape::registers`].
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A factor that does not depend on the state.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Coefficient {
    /// A literal.
    Number(Real),
    /// A register of the prologue.
    Register(Register),
}

impl Coefficient {
    /// The literal `value`.
    pub fn number(value: f64) -> Coefficient {
        Coefficient::Number(Real(value))
    }

    /// Its value among those of the registers.
    pub(crate) fn among(self, registers: &[f64]) -> f64 {
        match self {
            Coefficient::Number(v) => v.0,
            Coefficient::Register(r) => registers[r.index()],
        }
    }
}

/// What decides a [`Operation::Choose`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum By {
    /// The mode of that guard.
    Mode(u32),
    /// The sign of a register.
    Value(Register),
}

/// Functions of one argument with one result.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[allow(missing_docs)]
pub enum Unary {
    SquareRoot,
    Exp,
    Log,
    Tan,
    Asin,
    Acos,
    Atan,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
}

impl Unary {
    /// Every function with its name in tape text.
    pub const ALL: [(Unary, &'static str); 11] = [
        (Unary::SquareRoot, "sqrt"),
        (Unary::Exp, "exp"),
        (Unary::Log, "log"),
        (Unary::Tan, "tan"),
        (Unary::Asin, "asin"),
        (Unary::Acos, "acos"),
        (Unary::Atan, "atan"),
        (Unary::Tanh, "tanh"),
        (Unary::Asinh, "asinh"),
        (Unary::Acosh, "acosh"),
        (Unary::Atanh, "atanh"),
    ];
    /// Value at `x`.
    pub fn apply(self, x: f64) -> f64 {
        match self {
            Unary::SquareRoot => x.sqrt(),
            Unary::Exp => elementary::exp(x),
            Unary::Log => elementary::ln(x),
            Unary::Tan => elementary::tan(x),
            Unary::Asin => elementary::asin(x),
            Unary::Acos => elementary::acos(x),
            Unary::Atan => elementary::atan(x),
            Unary::Tanh => elementary::tanh(x),
            Unary::Asinh => elementary::asinh(x),
            Unary::Acosh => elementary::acosh(x),
            Unary::Atanh => elementary::atanh(x),
        }
    }
}

/// What an instruction computes.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Operation {
    /// A literal (prologue).
    Number(Real),
    /// A parameter (prologue).
    Parameter(u32),
    /// Time.
    Time,
    /// A state: q, then q', then auxiliary states.
    State(u32),
    /// An acceleration given from outside.
    Acceleration(u32),
    /// constant + Σ coefficient·register.
    Linear {
        /// The constant.
        constant: Coefficient,
        /// (coefficient, register).
        terms: Box<[(Coefficient, Register)]>,
    },
    /// a·b.
    Multiply(Register, Register),
    /// a².
    Square(Register),
    /// a/b.
    Divide(Register, Register),
    /// a^p with a constant exponent.
    Power(Register, Coefficient),
    /// A function of one argument.
    Unary(Unary, Register),
    /// Angle of the point (second, first): atan2(first, second).
    Atan2(Register, Register),
    /// Two registers: sin a, cos a.
    SinCos(Register),
    /// Two registers: sinh a, cosh a.
    SinhCosh(Register),
    /// One of three registers for a negative, zero or positive guard. The others may hold anything, even not-a-number.
    Choose {
        /// What decides.
        by: By,
        /// Values for negative, zero, positive.
        sides: [Register; 3],
    },
    /// n registers a with M a = h, M symmetric.
    Solve {
        /// Lower triangle of M, row by row, n(n+1)/2 entries; `None` is zero.
        matrix: Box<[Option<Register>]>,
        /// h.
        right: Box<[Register]>,
    },
    /// n registers x with A x = b, A of any kind.
    System {
        /// A, row by row, n² entries; `None` is zero. Rows are eliminated in this order: what the first rows determine alone, they determine exactly.
        matrix: Box<[Option<Register>]>,
        /// b.
        right: Box<[Register]>,
        /// Rows of which some repeat others.
        spare: Option<Arc<Spare>>,
    },
}

impl Operation {
    /// Number of registers written.
    pub fn width(&self) -> usize {
        match self {
            Operation::SinCos(_) | Operation::SinhCosh(_) => 2,
            Operation::Solve { right, .. } | Operation::System { right, .. } => right.len(),
            _ => 1,
        }
    }

    /// The verb of the text form.
    pub fn kind(&self) -> &'static str {
        match self {
            Operation::Number(_) => "number",
            Operation::Parameter(_) => "parameter",
            Operation::Time => "time",
            Operation::State(_) => "state",
            Operation::Acceleration(_) => "acceleration",
            Operation::Linear { .. } => "linear",
            Operation::Multiply(..) => "multiply",
            Operation::Square(_) => "square",
            Operation::Divide(..) => "divide",
            Operation::Power(..) => "power",
            Operation::Unary(f, _) => Unary::ALL.iter().find(|row| row.0 == *f).map_or("?", |row| row.1),
            Operation::Atan2(..) => "atan2",
            Operation::SinCos(_) => "sincos",
            Operation::SinhCosh(_) => "sinhcosh",
            Operation::Choose { .. } => "choose",
            Operation::Solve { .. } => "solve",
            Operation::System { .. } => "solve-general",
        }
    }

    /// Calls `visit` with every register read, those of coefficients included.
    pub fn operands(&self, visit: &mut dyn FnMut(Register)) {
        match self {
            Operation::Number(_) | Operation::Parameter(_) | Operation::Time | Operation::State(_) | Operation::Acceleration(_) => {}
            Operation::Linear { constant, terms } => {
                coefficient_register(*constant).into_iter().for_each(&mut *visit);
                for (c, r) in terms {
                    coefficient_register(*c).into_iter().for_each(&mut *visit);
                    visit(*r);
                }
            }
            Operation::Multiply(a, b) | Operation::Divide(a, b) | Operation::Atan2(a, b) => [*a, *b].into_iter().for_each(visit),
            Operation::Power(a, p) => {
                coefficient_register(*p).into_iter().for_each(&mut *visit);
                visit(*a);
            }
            Operation::Square(a) | Operation::Unary(_, a) | Operation::SinCos(a) | Operation::SinhCosh(a) => visit(*a),
            Operation::Choose { by, sides } => {
                if let By::Value(r) = by {
                    visit(*r);
                }
                sides.iter().copied().for_each(visit);
            }
            Operation::Solve { matrix, right } | Operation::System { matrix, right, .. } => {
                matrix.iter().flatten().copied().for_each(&mut *visit);
                right.iter().copied().for_each(visit);
            }
        }
    }

    /// The same operation with every register replaced.
    pub fn rename(&self, name: &dyn Fn(Register) -> Register) -> Operation {
        let coefficient = |c: &Coefficient| match c {
            Coefficient::Number(_) => *c,
            Coefficient::Register(r) => Coefficient::Register(name(*r)),
        };
        match self {
            Operation::Linear { constant, terms } => Operation::Linear {
                constant: coefficient(constant),
                terms: terms.iter().map(|(c, r)| (coefficient(c), name(*r))).collect(),
            },
            Operation::Multiply(a, b) => Operation::Multiply(name(*a), name(*b)),
            Operation::Divide(a, b) => Operation::Divide(name(*a), name(*b)),
            Operation::Atan2(a, b) => Operation::Atan2(name(*a), name(*b)),
            Operation::Power(a, p) => Operation::Power(name(*a), coefficient(p)),
            Operation::Square(a) => Operation::Square(name(*a)),
            Operation::Unary(f, a) => Operation::Unary(*f, name(*a)),
            Operation::SinCos(a) => Operation::SinCos(name(*a)),
            Operation::SinhCosh(a) => Operation::SinhCosh(name(*a)),
            Operation::Choose { by, sides } => Operation::Choose {
                by: match by {
                    By::Mode(_) => *by,
                    By::Value(r) => By::Value(name(*r)),
                },
                sides: sides.map(name),
            },
            Operation::Solve { matrix, right } => {
                Operation::Solve { matrix: matrix.iter().map(|r| r.map(name)).collect(), right: right.iter().map(|r| name(*r)).collect() }
            }
            Operation::System { matrix, right, spare } => Operation::System {
                matrix: matrix.iter().map(|r| r.map(name)).collect(),
                right: right.iter().map(|r| name(*r)).collect(),
                spare: spare.clone(),
            },
            leaf => leaf.clone(),
        }
    }
}

fn coefficient_register(c: Coefficient) -> Option<Register> {
    match c {
        Coefficient::Number(_) => None,
        Coefficient::Register(r) => Some(r),
    }
}

/// One instruction: an operation and the first of the registers it writes.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Instruction {
    /// First register written; the others follow.
    pub into: Register,
    /// What is computed.
    pub operation: Operation,
    /// The expression it came from, for messages; not part of the text.
    pub origin: Option<Expr>,
}

/// A named result.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Root {
    /// Its name.
    pub name: String,
    /// Where it is.
    pub register: Register,
}

/// A guard without a choice: its sign matters only while another guard is zero (the limits of a friction that sticks, the force of a closed contact).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Bounded {
    /// The guard.
    pub guard: u32,
    /// The one that must be zero.
    pub of: u32,
}

/// How many inputs of each kind a tape may read.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Shape {
    /// Parameters.
    pub parameters: usize,
    /// States: q, q', auxiliary.
    pub states: usize,
    /// Accelerations given from outside.
    pub accelerations: usize,
    /// Guards whose modes are given.
    pub modes: usize,
}

/// A program for the machine of registers.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Tape {
    /// What it computes, one word.
    pub name: String,
    /// Sizes of its inputs.
    pub shape: Shape,
    /// Instructions that depend on parameters only.
    pub prologue: Vec<Instruction>,
    /// Instructions per state.
    pub body: Vec<Instruction>,
    /// Register of each guard function whose mode is an input, by guard; `None` when this tape does not compute it.
    pub guards: Vec<Option<Register>>,
    /// Guards that count only while another is zero.
    pub bounds: Vec<Bounded>,
    /// Results.
    pub roots: Vec<Root>,
}

impl Tape {
    /// Number of registers.
    pub fn registers(&self) -> usize {
        self.instructions().last().map_or(0, |i| i.into.index() + i.operation.width())
    }
    /// Number of registers of the prologue: the constants are those below.
    pub fn constants(&self) -> usize {
        self.prologue.last().map_or(0, |i| i.into.index() + i.operation.width())
    }
    /// Number of body instructions of each kind that occurs, by name.
    pub fn census(&self) -> Vec<(&'static str, usize)> {
        let mut counts = std::collections::BTreeMap::new();
        for instruction in &self.body {
            *counts.entry(instruction.operation.kind()).or_insert(0) += 1;
        }
        counts.into_iter().collect()
    }
    /// All instructions, prologue first.
    pub fn instructions(&self) -> impl DoubleEndedIterator<Item = &Instruction> {
        self.prologue.iter().chain(&self.body)
    }
}
