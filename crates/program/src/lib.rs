//! From equations to numbers: a flat tape, an interpreter, and Taylor coefficients.
//!
//! ```text
//! Equations --lower::equations--> Program (tapes) --Bound::new--> Bound (parameters in) --> Evaluator (a value), Jets (a series)
//! ```
//!
//! A [`Program`] holds one [`Tape`] for each question (dynamics, forces of connections, outputs, energy, second derivation,
//! statics, conditions, start). The [`Evaluator`]
//! interprets any of them and is the oracle; [`Jets`] expands the motion in a Taylor series, [`Tangent`] gives
//! its Jacobian. Switches are [`GuardOrigin`]s with [`Mode`]s.
//! Everything that can go wrong is a [`Fault`] with code, cause and cure. It knows no mechanics: what an expression means is nobody's business here.
//!
//! Rooms, in order of reading: `real`, `tape`, `builder`, `verify`, [`text`] (what a tape is) - [`lower`], [`passes`] (how expressions become one) - `interpret`, `abreast`, `solve`, `general`,
//! `spare`, `rounding` (values) - `mode`, `guard` (switches) - `jets`, `tangent` (series, Jacobian), [`ensemble`] (values and series of eight machines) - [`curve`], `behind` (whether polynomials are what they stand for) -
//! `program`, `fault`.
//!
//! ```
//! use program::{Evaluator, Point, lower, text};
//! use std::sync::Arc;
//! use symbolic::Graph;
//!
//! // m x + sin(x)²
//! let mut graph = Graph::new();
//! let (m, x) = (graph.symbol_id("m", 0), graph.symbol_id("x", 0));
//! let (mass, place) = (graph.symbol(m), graph.symbol(x));
//! let sine = graph.call(symbolic::Function::Sin, &[place]);
//! let square = graph.square(sine);
//! let product = graph.mul(mass, place);
//! let formula = graph.add(product, square);
//!
//! let inputs = lower::Inputs { parameters: vec![m], states: vec![x], ..Default::default() };
//! let tape = lower::expressions(&graph, "example", &inputs, &[("f".to_owned(), formula)]).unwrap();
//! assert_eq!(text::parse(&tape.to_string()).unwrap().to_string(), tape.to_string());
//!
//! let mut evaluator = Evaluator::new(&Arc::new(tape), &[2.0]).unwrap();
//! let value = evaluator.evaluate(&Point { states: &[0.5], ..Point::default() }).unwrap()[0];
//! assert_eq!(value, 2.0 * 0.5 + 0.5_f64.sin().powi(2));
//! ```
//!
//! The motion of a machine, once its equations are known (`Equations` come from `mechanics`):
//!
//! ```no_run
//! # fn equations() -> symbolic::Equations { unimplemented!() }
//! use program::{Bound, lower};
//! use std::sync::Arc;
//!
//! let program = Arc::new(lower::equations(&equations())?);
//! let mut bound = Bound::new(&program, &program.values)?;
//! let x = bound.start()?;
//! let modes = bound.modes(0.0, &x)?;
//! let mut jets = bound.jets(20);
//! jets.expand(0.0, &x, &modes, 20)?;
//! let later: f64 = jets.state(0).iter().rev().fold(0.0, |sum, c| sum * 0.01 + c); // x_0(0.01)
//! # Ok::<(), program::Fault>(())
//! ```

// the same bits on every machine: see clippy.toml
#![cfg_attr(not(test), deny(clippy::disallowed_methods, clippy::too_many_lines, clippy::fn_params_excessive_bools))]

mod abreast;
mod behind;
mod builder;
pub mod curve;
pub mod ensemble;
mod fault;
mod general;
mod guard;
mod interpret;
mod jets;
pub mod lower;
mod mode;
pub mod passes;
mod program;
mod real;
mod rounding;
mod solve;
mod spare;
mod tangent;
mod tape;
pub mod text;
mod verify;

pub use abreast::{ABREAST, Abreast, Lanes, Places};
pub use behind::{Acting, Behind, HELD, Node, Seen};
pub use fault::{DEPENDENT, Details, EXPLANATIONS, Fault, NO_SERIES, NOT_FINITE, Singular};
pub use guard::{Construct, GuardOrigin};
pub use interpret::{Evaluator, Point};
pub use jets::{Jets, RESOLUTION};

/// What polynomials are held against: the numbers that all who ask whether an operation can be believed have in common.
pub mod faithful {
    pub use crate::jets::faithful::{NEAR, NOTHING, RATIO};
}

pub use mode::Mode;
pub use program::{Bound, ConnectionRoots, ENERGY, LawRoots, Program, TouchRoots};
pub use real::Real;
pub use spare::Spare;
pub use tangent::Tangent;
pub use tape::{Bounded, By, Coefficient, Instruction, Operation, Register, Root, Shape, Tape, Unary};
pub use verify::verify;
